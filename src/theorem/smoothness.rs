//! Orders of smoothness of a curve in the uniform parameter (theory §11): radii on a descending chain of invariant spaces, and
//! the joint equations of every order.

use super::regularity::minus_log;
use crate::arith::{Interval, Rational};
use crate::linalg::Matrix;
use crate::radius::{Arrow, JointRadius, Options, System, joint_radius};
use crate::shape::{CellKind, End, Shape, Spaces, difference};
use thiserror::Error;

/// Why a curve has no table of orders.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CurveRegularityError {
    /// The uniform parameter needs curves with the same number of pieces everywhere.
    #[error("the uniform parameter needs a curve all of whose states have the same number of pieces, at least 2")]
    Pieces,
    /// Pieces run backwards.
    #[error("a piece runs backwards: the statement is about curves without reversed pieces")]
    Reversed,
    /// The attractor is a point, or an end point is not unique.
    #[error("the curve is a single point, or its end points are not unique")]
    Point,
}

/// The joint equation of one order at the first-level joints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum JointEquation {
    /// It holds at all of them.
    Holds,
    /// It fails: the derivative of this order has the two values at the joint before piece `right` of `state`.
    Fails {
        /// The state.
        state: usize,
        /// The piece after the joint.
        right: usize,
        /// The value from the left, in barycentric coordinates (a vector of sum 0).
        left_value: Vec<Rational>,
        /// The value from the right.
        right_value: Vec<Rational>,
    },
}

/// What is known of one order.
#[derive(Debug, Clone)]
pub struct CurveOrder {
    /// `k`.
    pub order: usize,
    /// `N^−k`.
    pub threshold: Rational,
    /// Dimensions of the spaces `F_e` of the differences of derivatives of order `k`.
    pub dims: Vec<usize>,
    /// The operators on them, arrows by state and letter; `None` where they are 0 (a polynomial).
    pub system: Option<System>,
    /// Their joint spectral radius.
    pub radius: Option<JointRadius>,
    /// Its enclosure; 0 on the space 0.
    pub enclosure: Option<Interval>,
    /// The joint equation, from order 1 on, where the radius is below the threshold.
    pub joints: Option<JointEquation>,
    /// Whether the curve is `C^k`; `None` where that is not decided by this statement.
    pub smooth: Option<bool>,
}

/// The orders of smoothness of a curve, in its barycentric spaces.
#[derive(Debug, Clone)]
pub struct CurveRegularity {
    /// `N`, the number of pieces.
    pub pieces: usize,
    /// The orders `0, 1, …` up to the first that fails or is open.
    pub orders: Vec<CurveOrder>,
    /// Enclosure of `−log_N` of the radius of the last order that holds: the Hölder exponent, where it is at most that order + 1.
    pub exponent: Option<Interval>,
    /// Whether the curve is a polynomial in the uniform parameter.
    pub polynomial: bool,
    /// Whether control points lose directions, so that the projected curve may be smoother.
    pub projected: bool,
}

impl CurveRegularity {
    /// The largest `k` for which the curve is proved `C^k`.
    #[must_use]
    pub fn smoothness(&self) -> usize {
        self.orders.iter().take_while(|o| o.smooth == Some(true)).map(|o| o.order).last().unwrap_or(0)
    }
}

/// Highest order that is examined.
const MAX_ORDER: usize = 24;

/// Analyses a curve whose pieces meet and which contracts (both are checked elsewhere).
///
/// # Errors
/// [`CurveRegularityError`].
///
/// # Cost
/// One joint spectral radius for each order.
pub fn curve_regularity(
    shape: &Shape,
    spaces: &Spaces,
    options: &Options,
) -> Result<CurveRegularity, CurveRegularityError> {
    let mut level = Level::first(shape, spaces)?;
    let states = shape.reachable();
    let projected = states.iter().any(|&e| spaces.of(e).visible.rows() < spaces.of(e).basis.cols());
    let mut found =
        CurveRegularity { pieces: level.pieces, orders: Vec::new(), exponent: None, polynomial: false, projected };
    let base = Rational::from(1) / Rational::from(level.pieces as u64);
    let mut threshold = Rational::from(1);
    for order in 0..=MAX_ORDER {
        let system = level.system();
        let (radius, enclosure) = radius_of(system.as_ref(), options);
        let below = enclosure.as_ref().is_some_and(|e| e.hi < threshold);
        let joints = (order > 0 && below).then(|| level.joints()).flatten();
        let smooth = match &joints {
            _ if order == 0 => Some(true),
            Some(JointEquation::Holds) => Some(true),
            Some(JointEquation::Fails { .. }) => Some(false),
            None => None,
        };
        if smooth == Some(true) {
            found.exponent = enclosure.as_ref().and_then(|e| minus_log(e, level.pieces));
        }
        let dims = level.families.iter().map(Matrix::rows).collect();
        found.orders.push(CurveOrder {
            order,
            threshold: threshold.clone(),
            dims,
            system,
            radius,
            enclosure,
            joints,
            smooth,
        });
        if smooth != Some(true) {
            break;
        }
        if level.families.iter().all(|f| f.rows() == 0) {
            found.polynomial = true;
            break;
        }
        let Some(next) = level.next() else { break };
        level = next;
        threshold *= &base;
    }
    Ok(found)
}

/// The joint spectral radius of these operators; 0 without them.
fn radius_of(system: Option<&System>, options: &Options) -> (Option<JointRadius>, Option<Interval>) {
    let Some(system) = system else { return (None, Some(Interval::point(Rational::from(0)))) };
    let Ok(radius) = joint_radius(system, options) else { return (None, None) };
    let enclosure = radius.upper.clone().map(|upper| match &radius.lower {
        Some(lower) if radius.exact => lower.enclosure(96),
        Some(lower) => Interval::new(lower.enclosure(96).lo, upper),
        None => Interval::point(upper),
    });
    (Some(radius), enclosure)
}

/// The derivatives of one order: their differences span `families`, and `chords` are their values over a state: of order 0 the
/// difference of the end points.
struct Level<'a> {
    shape: &'a Shape,
    states: Vec<usize>,
    pieces: usize,
    /// The power `N^order` by which operators are multiplied.
    scale: Rational,
    /// Rows that span `F_e` in barycentric coordinates, in the order of `states`.
    families: Vec<Matrix>,
    /// The values at the start and at the finish of every state: points of order 0, derivatives of higher orders.
    ends: Vec<[Vec<Rational>; 2]>,
}

impl<'a> Level<'a> {
    fn first(shape: &'a Shape, spaces: &Spaces) -> Result<Self, CurveRegularityError> {
        let states = shape.reachable();
        let pieces = shape.states[shape.start].pieces.len();
        let curve = |e: &usize| shape.states[*e].kind == CellKind::Edge && shape.states[*e].pieces.len() == pieces;
        if pieces < 2 || !states.iter().all(curve) {
            return Err(CurveRegularityError::Pieces);
        }
        if states.iter().any(|e| shape.states[*e].pieces.iter().any(|p| p.reversed)) {
            return Err(CurveRegularityError::Reversed);
        }
        if spaces.of(shape.start).basis.cols() == 0 {
            return Err(CurveRegularityError::Point);
        }
        let ends = |e: &usize| Some([shape.end_point(*e, End::Start)?, shape.end_point(*e, End::Finish)?]);
        let ends = states.iter().map(ends).collect::<Option<Vec<_>>>().ok_or(CurveRegularityError::Point)?;
        let families = states.iter().map(|e| spaces.of(*e).basis.transpose().echelon().rows).collect();
        Ok(Self { shape, states, pieces, scale: Rational::from(1), families, ends })
    }

    fn position(&self, state: usize) -> usize {
        self.states.iter().position(|s| *s == state).unwrap_or(0)
    }

    /// The operators on the families, not scaled.
    fn system(&self) -> Option<System> {
        if self.families.iter().all(|f| f.rows() == 0) {
            return None;
        }
        let pivots: Vec<Vec<usize>> = self.families.iter().map(|f| f.echelon().pivots).collect();
        let mut arrows = Vec::new();
        for (from, &e) in self.states.iter().enumerate() {
            for piece in &self.shape.states[e].pieces {
                let to = self.position(piece.target);
                let images = &self.families[to] * &piece.op.transpose();
                let matrix =
                    Matrix::from_fn(pivots[from].len(), images.rows(), |i, j| images[(j, pivots[from][i])].clone());
                arrows.push(Arrow { from, to, matrix, label: arrows.len() });
            }
        }
        Some(System { dims: pivots.iter().map(Vec::len).collect(), arrows })
    }

    /// The derivative: `F` of codimension 1 below the families, and its values at the ends, as limits of `N T c`.
    fn next(&self) -> Option<Self> {
        let chords: Vec<Vec<Rational>> = self.ends.iter().map(|[start, finish]| difference(finish, start)).collect();
        let scale = &self.scale * Rational::from(self.pieces as u64);
        let mut families: Vec<Matrix> = self.families.iter().map(|f| Matrix::zero(0, f.cols())).collect();
        loop {
            let mut grown = false;
            for (k, &e) in self.states.iter().enumerate() {
                for piece in &self.shape.states[e].pieces {
                    let to = self.position(piece.target);
                    let image: Vec<Rational> = piece.op.apply(&chords[to]).iter().map(|x| x * &scale).collect();
                    let offset = Matrix::from_rows(image.len(), vec![difference(&image, &chords[k])]);
                    let joined = families[k].stack(&offset).stack(&(&families[to] * &piece.op.transpose()));
                    let joined = joined.echelon().rows;
                    grown |= joined.rows() > families[k].rows();
                    families[k] = joined;
                }
            }
            if !grown {
                break;
            }
        }
        if families.iter().zip(&self.families).any(|(f, v)| f.rows() + 1 != v.rows()) {
            return None;
        }
        let mut next = Self { ends: Vec::new(), families, scale, states: self.states.clone(), ..*self };
        for &e in &self.states {
            next.ends.push([next.limit(e, End::Start, &chords)?, next.limit(e, End::Finish, &chords)?]);
        }
        Some(next)
    }

    /// The limit of `N^k T_{σ|k} c` along the address of an end: the fixed vector of the scaled cycle in `c + F`, carried along
    /// the prefix.
    fn limit(&self, state: usize, end: End, chords: &[Vec<Rational>]) -> Option<Vec<Rational>> {
        let address = self.shape.end_address(state, end, |_| false)?;
        let power = |n: usize| (0..n).fold(Rational::from(1), |p, _| p * &self.scale);
        let (prefix, home) = self.shape.product(state, &address.prefix);
        let (cycle, _) = self.shape.product(home, &address.cycle);
        let cycle = cycle.scale(&power(address.cycle.len()));
        let k = self.position(home);
        // (M − 1)(c + Fᵗ y) = 0.
        let shifted = &cycle - &Matrix::identity(cycle.rows());
        let family = self.families[k].transpose();
        let right: Vec<Rational> = shifted.apply(&chords[k]).into_iter().map(|x| -x).collect();
        let y = (&shifted * &family).solve(&Matrix::from_columns(right.len(), &[right]))?.column(0);
        let fixed: Vec<Rational> = chords[k].iter().zip(family.apply(&y)).map(|(c, f)| c + f).collect();
        Some(prefix.scale(&power(address.prefix.len())).apply(&fixed))
    }

    /// Whether `N T_{j−1} v_R = N T_j v_L` at all first-level joints.
    fn joints(&self) -> Option<JointEquation> {
        for &state in &self.states {
            for (j, pair) in self.shape.states[state].pieces.windows(2).enumerate() {
                let value = |piece: &crate::shape::Piece, end: usize| -> Vec<Rational> {
                    let image = piece.op.apply(&self.ends[self.position(piece.target)][end]);
                    image.into_iter().map(|x| x * &self.scale).collect()
                };
                let (left_value, right_value) = (value(&pair[0], 1), value(&pair[1], 0));
                if left_value != right_value {
                    return Some(JointEquation::Fails { state, right: j + 1, left_value, right_value });
                }
            }
        }
        Some(JointEquation::Holds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::scheme;

    fn takagi_landsberg(alpha: Rational) -> CurveRegularity {
        let shape = scheme::build("takagi", &[("alpha".to_owned(), alpha)].into()).unwrap();
        curve_regularity(&shape, &Spaces::new(&shape).unwrap(), &Options::default()).unwrap()
    }

    /// With factor 1/3 the radius is below 1/2, but the slopes at 1/2 are not equal; with 1/4 the curve is a parabola.
    #[test]
    fn the_joint_equation_decides() {
        let third = takagi_landsberg(ratio(1, 3));
        assert_eq!(third.smoothness(), 0);
        let last = third.orders.last().unwrap();
        assert_eq!((last.order, last.smooth), (1, Some(false)));
        assert!(last.enclosure.as_ref().unwrap().hi < last.threshold);
        assert!(matches!(last.joints, Some(JointEquation::Fails { .. })));
        let quarter = takagi_landsberg(ratio(1, 4));
        assert!(quarter.polynomial && quarter.smoothness() >= 2);
    }

    #[test]
    fn splines_and_the_four_point_scheme() {
        let of = |name: &str, parameters: &[(&str, i64)]| {
            let values = parameters.iter().map(|(k, v)| ((*k).to_owned(), ratio(*v, 1))).collect();
            let shape = scheme::build(name, &values).unwrap();
            curve_regularity(&shape, &Spaces::new(&shape).unwrap(), &Options::default()).unwrap()
        };
        assert!(of("bspline", &[("degree", 3)]).smoothness() >= 2);
        assert_eq!(of("four-point", &[]).smoothness(), 1);
    }
}
