//! Orders of smoothness of a curve in the uniform parameter (theory §11, Theorem E): radii on a descending chain of invariant
//! spaces, and the joint equations of every order, all in the visible quotients `W_e` of §9.

use super::frames::component;
use super::regularity::minus_log;
use crate::arith::{Interval, Rational, abs};
use crate::linalg::{Matrix, closures};
use crate::radius::{Arrow, Growth, JointRadius, Options, System, joint_radius};
use crate::shape::{CellKind, End, Piece, Shape, Spaces, difference};
use std::collections::VecDeque;
use thiserror::Error;

/// Why a curve has no table of orders.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CurveRegularityError {
    /// The uniform parameter needs the same number of pieces in all states that come back to themselves.
    #[error(
        "the uniform parameter needs a curve all of whose states that come back to themselves have the same number of pieces, \
         at least 2"
    )]
    Pieces,
    /// The curve that is seen is a point.
    #[error("the curve is a single point")]
    Point,
    /// An end point is not unique, or an operator does not act on the visible quotients: the system does not contract.
    #[error("an end point of the curve of state {0} is not unique")]
    Ends(String),
}

/// What the statement says of one order `k`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// `k = 0`: the curve itself.
    Curve,
    /// The radius is below the threshold and the joint equations hold: `C^k`.
    Holds,
    /// The radius is below the threshold and a joint equation fails: not `C^k`.
    Joint(Jump),
    /// The leading word of the radius is a cycle whose spectral radius is not below the threshold: not `C^k`.
    Cycle,
    /// In this state, which belongs to a strongly connected part that no arrow leaves, the chord of order `k−1` lies in `F_e`,
    /// and the curve of order `k−1` is more than a point: not `C^k`.
    Chord(usize),
    /// The supremum of the exponents of the order before is below `k`: not `C^k`.
    Exponent,
    /// Not decided by this statement.
    Open,
}

/// A joint at which the derivative of some order has two values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Jump {
    /// The state.
    pub state: usize,
    /// The piece after the joint.
    pub right: usize,
    /// Where the curve of the start state has this joint, and its values there.
    pub seen: Option<Seen>,
}

/// The two values of a derivative of the curve of the start state, as it is seen: with control points in their space, otherwise
/// vectors of sum 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seen {
    /// The path from the start to the state of the joint, along which the two values stay different.
    pub path: Vec<usize>,
    /// The value from the left.
    pub left: Vec<Rational>,
    /// The value from the right.
    pub right: Vec<Rational>,
}

/// What is known of one order.
#[derive(Debug, Clone)]
pub struct CurveOrder {
    /// `k`.
    pub order: usize,
    /// `N^−k`, or 1 where the parameter has shares of its own, by which the operators are divided.
    pub threshold: Rational,
    /// By reachable state and letter, the part of the parameter that a piece takes, where these are not all `1/N`.
    pub shares: Option<Shares>,
    /// Dimensions of the spaces `F_e ⊂ W_e` of the differences of derivatives of order `k`.
    pub dims: Vec<usize>,
    /// The operators on them, arrows by state and letter; `None` where all are 0 (a polynomial).
    pub system: Option<System>,
    /// Their joint spectral radius.
    pub radius: Option<JointRadius>,
    /// Its enclosure; 0 on the space 0.
    pub enclosure: Option<Interval>,
    /// The conclusion.
    pub outcome: Outcome,
}

impl CurveOrder {
    /// Whether the curve is `C^k`; `None` where that is not decided.
    #[must_use]
    pub fn smooth(&self) -> Option<bool> {
        match self.outcome {
            Outcome::Curve | Outcome::Holds => Some(true),
            Outcome::Joint(_) | Outcome::Cycle | Outcome::Chord(_) | Outcome::Exponent => Some(false),
            Outcome::Open => None,
        }
    }
}

/// The orders of smoothness of the curve of the start state, as it is seen.
#[derive(Debug, Clone)]
pub struct CurveRegularity {
    /// `N`, the number of pieces of the states that come back to themselves.
    pub pieces: usize,
    /// The orders `0, 1, …` up to the first that fails or is open, at most [`MAX_ORDER`].
    pub orders: Vec<CurveOrder>,
    /// Enclosure of the supremum of the Hölder exponents `k + α`, `0 < α <= 1`, for the last order `k` that holds; `None` for a
    /// polynomial, or where no bound is known.
    pub exponent: Option<Interval>,
    /// Whether that exponent is attained; `None` where that is not decided.
    pub attained: Option<bool>,
    /// Whether the curve is a polynomial in the uniform parameter.
    pub polynomial: bool,
}

impl CurveRegularity {
    /// The largest `k` for which the curve is proved `C^k`.
    #[must_use]
    pub fn smoothness(&self) -> usize {
        self.orders.iter().filter(|o| o.smooth() == Some(true)).count() - 1
    }

    /// Whether the curve is `C^k`; `None` where that is not decided.
    #[must_use]
    pub fn is_smooth(&self, order: usize) -> Option<bool> {
        if self.polynomial || order <= self.smoothness() {
            return Some(true);
        }
        self.orders.iter().any(|o| o.order <= order && o.smooth() == Some(false)).then_some(false)
    }
}

/// Highest order that is examined.
pub const MAX_ORDER: usize = 31;

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
    let curve = Curve::new(shape, spaces)?;
    let (mut families, mut chords) = curve.first()?;
    let mut found = CurveRegularity {
        pieces: curve.pieces,
        orders: vec![curve.order(0, &families, options)],
        exponent: None,
        attained: None,
        polynomial: false,
    };
    for k in 1..=MAX_ORDER {
        let smaller = curve.differences(k, &chords);
        let mut order = curve.order(k, &smaller, options);
        found.polynomial = smaller.iter().all(|f| f.rows() == 0);
        let values = if order.is_below() { curve.ends(k, &smaller, &chords) } else { None };
        order.outcome = match &values {
            Some(values) => curve.joints(k, values).map_or(Outcome::Holds, Outcome::Joint),
            None => match curve.refuted(&order, &families, &smaller, &chords) {
                Outcome::Open if found.orders[k - 1].is_above(&order.threshold) => Outcome::Exponent,
                outcome => outcome,
            },
        };
        let holds = order.smooth() == Some(true);
        found.polynomial &= holds;
        found.orders.push(order);
        if !holds || found.polynomial {
            break;
        }
        families = smaller;
        chords = values.iter().flatten().map(|[start, finish]| difference(finish, start)).collect();
    }
    if !found.polynomial {
        let last = &found.orders[found.smoothness()];
        found.exponent = last.exponent(curve.pieces);
        found.attained = last.radius.as_ref().and_then(|r| match r.growth {
            Growth::Bounded => Some(true),
            Growth::Unbounded(_) if r.exact => Some(false),
            _ => None,
        });
    }
    Ok(found)
}

impl CurveOrder {
    pub(super) fn is_below(&self) -> bool {
        self.enclosure.as_ref().is_some_and(|e| e.hi < self.threshold)
    }

    /// Whether the radius is proved to be greater than a number.
    fn is_above(&self, bound: &Rational) -> bool {
        self.enclosure.as_ref().is_some_and(|e| e.lo > *bound)
    }

    /// Whether the leading word of the radius is a cycle with `ρ(N^(k|w|) T_w) >= 1`.
    fn has_slow_cycle(&self) -> bool {
        self.radius.as_ref().and_then(|r| r.lower.as_ref()).is_some_and(|lower| lower.is_at_least(&self.threshold))
    }

    /// Enclosure of `−log_N` of the radius, cut with `[k, k+1]`, where it lies if this order holds and its differences are not 0.
    pub(super) fn exponent(&self, pieces: usize) -> Option<Interval> {
        let radius = self.enclosure.as_ref()?;
        let (least, most) = (Rational::from(self.order as u64), Rational::from(self.order as u64 + 1));
        let own = minus_log(radius, pieces)?;
        let (lo, hi) = (own.lo.max(least.clone()), own.hi.min(most.clone()));
        (lo <= hi).then(|| Interval::new(lo, hi))
    }
}

fn power(base: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(Rational::from(1), |p, _| p * base)
}

/// The joint spectral radius of these operators; 0 without them.
pub(super) fn radius_of(system: Option<&System>, options: &Options) -> (Option<JointRadius>, Option<Interval>) {
    let Some(system) = system else { return (None, Some(Interval::point(Rational::from(0)))) };
    let Ok(radius) = joint_radius(system, options) else { return (None, None) };
    let enclosure = radius.upper.clone().map(|upper| match &radius.lower {
        Some(lower) if radius.exact => lower.enclosure(96),
        Some(lower) => Interval::new(lower.enclosure(96).lo, upper),
        None => Interval::new(Rational::from(0), upper),
    });
    (Some(radius), enclosure)
}

/// By reachable state and letter, the part of the parameter that a piece takes.
pub type Shares = Vec<Vec<Rational>>;

/// A curve in its visible quotients. Families and chords go by the position of a state among the reachable ones.
pub(super) struct Curve<'a> {
    shape: &'a Shape,
    spaces: &'a Spaces,
    states: Vec<usize>,
    /// By state of the shape, its position.
    positions: Vec<Option<usize>>,
    /// `N`, the number of pieces of the states that come back to themselves.
    pieces: usize,
    /// Where the pieces of a state do not take equal shares of the parameter, what they take.
    shares: Option<Shares>,
    /// By position and letter: the map `W_to -> W_from`.
    operators: Vec<Vec<Matrix>>,
}

pub(super) type Families = Vec<Matrix>;
pub(super) type Chords = Vec<Vec<Rational>>;
pub(super) type Ends = Vec<[Vec<Rational>; 2]>;

impl<'a> Curve<'a> {
    pub(super) fn new(shape: &'a Shape, spaces: &'a Spaces) -> Result<Self, CurveRegularityError> {
        let count = |e: &usize| shape.states[*e].pieces.len();
        let states = shape.reachable();
        let returning: Vec<usize> = states.iter().filter(|e| !component(shape, **e).is_empty()).map(count).collect();
        match returning.first() {
            Some(&first) if first >= 2 && returning.iter().all(|n| *n == first) => Self::of(shape, spaces, first, None),
            _ => Err(CurveRegularityError::Pieces),
        }
    }

    /// The curve with equal shares of the parameter, or with given ones, of which `pieces` says nothing.
    pub(super) fn of(
        shape: &'a Shape,
        spaces: &'a Spaces,
        pieces: usize,
        shares: Option<Shares>,
    ) -> Result<Self, CurveRegularityError> {
        let states = shape.reachable();
        if states.iter().any(|e| shape.states[*e].kind != CellKind::Edge || shape.states[*e].pieces.is_empty()) {
            return Err(CurveRegularityError::Pieces);
        }
        if spaces.of(shape.start).visible.rows() == 0 {
            return Err(CurveRegularityError::Point);
        }
        let mut positions = vec![None; shape.states.len()];
        for (k, &e) in states.iter().enumerate() {
            positions[e] = Some(k);
        }
        let of = |e: usize| shape.states[e].pieces.iter().map(|p| spaces.on_visible(&p.op, e, p.target)).collect();
        let operators: Option<Vec<Vec<Matrix>>> = states.iter().map(|&e| of(e)).collect();
        let operators = operators.ok_or_else(|| CurveRegularityError::Ends(shape.states[shape.start].name.clone()))?;
        Ok(Self { shape, spaces, states, positions, pieces, shares, operators })
    }

    /// The whole spaces `W_e` and the chords of the curves in them.
    pub(super) fn first(&self) -> Result<(Families, Chords), CurveRegularityError> {
        let families = (0..self.states.len()).map(|e| Matrix::identity(self.dim(e))).collect();
        let chord = |&e: &usize| {
            let end = |end| self.shape.end_point(e, end);
            let (start, finish) = end(End::Start).zip(end(End::Finish))?;
            Some(self.spaces.in_visible(e, &difference(&finish, &start)))
        };
        let chord = |e| chord(e).ok_or_else(|| CurveRegularityError::Ends(self.shape.states[*e].name.clone()));
        Ok((families, self.states.iter().map(chord).collect::<Result<_, _>>()?))
    }

    /// The position of a state that is reached.
    pub(super) fn position(&self, state: usize) -> usize {
        self.positions[state].expect("a piece of a reachable state leads to a reachable state")
    }

    /// The dimension of `W_e`.
    fn dim(&self, position: usize) -> usize {
        self.spaces.of(self.states[position]).visible.rows()
    }

    /// All pieces: position, letter, piece, position of the target.
    fn arrows(&self) -> impl Iterator<Item = (usize, usize, &'a Piece, usize)> {
        self.states.iter().enumerate().flat_map(move |(from, &e)| {
            let pieces = self.shape.states[e].pieces.iter().enumerate();
            pieces.map(move |(letter, p)| (from, letter, p, self.position(p.target)))
        })
    }

    /// `(ε N_e)^k`, or `(ε/s)^k` for a piece with the share `s`: what derivatives of order `k` are multiplied with on it.
    fn factor(&self, k: usize, from: usize, letter: usize) -> Rational {
        let pieces = &self.shape.states[self.states[from]].pieces;
        let one = match &self.shares {
            Some(shares) => Rational::from(1) / &shares[from][letter],
            None => Rational::from(pieces.len()),
        };
        power(&if pieces[letter].reversed { -one } else { one }, k)
    }

    pub(super) fn order(&self, k: usize, families: &[Matrix], options: &Options) -> CurveOrder {
        let system = self.system(k, families);
        let (radius, enclosure) = radius_of(system.as_ref(), options);
        let dims = families.iter().map(Matrix::rows).collect();
        let threshold = match self.shares {
            Some(_) => Rational::from(1),
            None => Rational::from(1) / power(&Rational::from(self.pieces), k),
        };
        let outcome = if k == 0 { Outcome::Curve } else { Outcome::Open };
        CurveOrder { order: k, threshold, shares: self.shares.clone(), dims, system, radius, enclosure, outcome }
    }

    /// The operators on the families; with shares, those of the derivatives of order `k`, but for signs.
    fn system(&self, k: usize, families: &[Matrix]) -> Option<System> {
        if families.iter().all(|f| f.rows() == 0) {
            return None;
        }
        let pivots: Vec<Vec<usize>> = families.iter().map(|f| f.echelon().pivots).collect();
        let mut arrows = Vec::new();
        for (from, letter, _, to) in self.arrows() {
            let images = &families[to] * &self.operators[from][letter].transpose();
            let matrix =
                Matrix::from_fn(pivots[from].len(), images.rows(), |i, j| images[(j, pivots[from][i])].clone());
            let scale = self.shares.is_some().then(|| abs(&self.factor(k, from, letter)));
            let matrix = scale.map_or(matrix.clone(), |factor| matrix.scale(&factor));
            arrows.push(Arrow { from, to, matrix, label: arrows.len() });
        }
        Some(System { dims: pivots.iter().map(Vec::len).collect(), arrows })
    }

    /// The differences of the derivatives of order `k`: the smallest families with `(ε N)^k T_i c_δ − c_e ∈ F_e` for the chords
    /// of order `k−1`, and `T_i F_δ ⊂ F_e`. Rows in echelon form.
    pub(super) fn differences(&self, k: usize, chords: &Chords) -> Families {
        let mut families: Vec<Matrix> = chords.iter().map(|c| Matrix::zero(0, c.len())).collect();
        for (from, letter, _, to) in self.arrows() {
            let image = self.operators[from][letter].scale(&self.factor(k, from, letter)).apply(&chords[to]);
            let offset = Matrix::from_rows(image.len(), vec![difference(&image, &chords[from])]);
            families[from] = families[from].stack(&offset).echelon().rows;
        }
        let arrow =
            |(from, letter, _, to): (usize, usize, &Piece, usize)| (to, from, self.operators[from][letter].transpose());
        let arrows: Vec<_> = self.arrows().map(arrow).collect();
        closures(families, &arrows)
    }

    /// The values of the derivative of order `k` at the two ends of every curve.
    pub(super) fn ends(&self, k: usize, families: &[Matrix], chords: &Chords) -> Option<Ends> {
        let both = |&e: &usize| {
            Some([self.limit(k, e, End::Start, families, chords)?, self.limit(k, e, End::Finish, families, chords)?])
        };
        self.states.iter().map(both).collect()
    }

    /// The limit of `(ε N)^k T c` along the address of an end: the fixed vector of its cycle in `c + F`, unique because the
    /// radius on `F` is below `N^−k`, carried along the prefix.
    fn limit(&self, k: usize, state: usize, end: End, families: &[Matrix], chords: &Chords) -> Option<Vec<Rational>> {
        let address = self.shape.end_address(state, end, |_| false)?;
        let (prefix, home) = self.product(k, self.position(state), &address.prefix);
        let (cycle, _) = self.product(k, home, &address.cycle);
        // (M − 1)(c + Fᵗ y) = 0.
        let shifted = &cycle - &Matrix::identity(cycle.rows());
        let family = families[home].transpose();
        let right: Vec<Rational> = shifted.apply(&chords[home]).into_iter().map(|x| -x).collect();
        let y = (&shifted * &family).solve(&Matrix::from_columns(right.len(), &[right]))?.column(0);
        let fixed: Vec<Rational> = chords[home].iter().zip(family.apply(&y)).map(|(c, f)| c + f).collect();
        Some(prefix.apply(&fixed))
    }

    /// The product of the scaled operators along a word, and the position where it ends.
    fn product(&self, k: usize, from: usize, word: &[usize]) -> (Matrix, usize) {
        let start = Matrix::identity(self.dim(from));
        word.iter().fold((start, from), |(product, at), &letter| {
            let piece = &self.shape.states[self.states[at]].pieces[letter];
            let step = self.operators[at][letter].scale(&self.factor(k, at, letter));
            (&product * &step, self.position(piece.target))
        })
    }

    /// The first joint of the first level at which the derivative of order `k` has two values.
    pub(super) fn joints(&self, k: usize, ends: &Ends) -> Option<Jump> {
        for (from, &state) in self.states.iter().enumerate() {
            let value = |letter: usize, end: End| {
                let piece = &self.shape.states[state].pieces[letter];
                let own = &ends[self.position(piece.target)][usize::from(end.in_piece(piece) == End::Finish)];
                self.operators[from][letter].scale(&self.factor(k, from, letter)).apply(own)
            };
            for right in 1..self.operators[from].len() {
                let (before, after) = (value(right - 1, End::Finish), value(right, End::Start));
                if before != after {
                    return Some(Jump { state, right, seen: self.seen(k, from, [before, after]) });
                }
            }
        }
        None
    }

    /// Two values that differ in `W_e`, carried to the start along the first path that keeps them apart.
    fn seen(&self, k: usize, place: usize, [before, after]: [Vec<Rational>; 2]) -> Option<Seen> {
        let space = self.spaces.of(self.shape.start);
        // Any lift of a vector of the visible quotient is seen as the same vector.
        let pivots = space.visible.echelon().pivots;
        let view = &self.shape.view() * &space.basis;
        let view = Matrix::from_fn(view.rows(), pivots.len(), |i, j| view[(i, pivots[j])].clone());
        let jump = difference(&before, &after);
        let mut queue = VecDeque::from([(Vec::new(), true)]);
        let mut known: Vec<Matrix> = (0..self.states.len()).map(|e| Matrix::zero(0, self.dim(e))).collect();
        while let Some((path, forwards)) = queue.pop_front() {
            let (product, at) = self.product(k, 0, &path);
            let rows = &view * &product;
            if at == place && rows.apply(&jump).iter().any(|x| *x != 0) {
                let (left, right) = if forwards { (before, after) } else { (after, before) };
                return Some(Seen { path, left: rows.apply(&left), right: rows.apply(&right) });
            }
            // Only paths whose rows are new lead to anything new.
            let joined = known[at].stack(&rows).echelon().rows;
            if joined.rows() > known[at].rows() {
                known[at] = joined;
                for (letter, piece) in self.shape.states[self.states[at]].pieces.iter().enumerate() {
                    queue.push_back(([path.as_slice(), &[letter]].concat(), forwards != piece.reversed));
                }
            }
        }
        None
    }

    /// What refutes an order whose radius is not known to be below the threshold.
    fn refuted(&self, order: &CurveOrder, before: &Families, now: &Families, chords: &Chords) -> Outcome {
        if order.has_slow_cycle() {
            return Outcome::Cycle;
        }
        let turns_back = |k: usize| {
            let inside = now[k].stack(&Matrix::from_rows(chords[k].len(), vec![chords[k].clone()]));
            before[k].rows() > 0 && inside.rank() == now[k].rows() && self.is_closed(k)
        };
        match (0..self.states.len()).find(|&k| turns_back(k)) {
            Some(k) => Outcome::Chord(self.states[k]),
            None => Outcome::Open,
        }
    }

    /// Whether all states that are reached from this one lead back to it.
    fn is_closed(&self, place: usize) -> bool {
        let reached = |from: usize| {
            let mut list = vec![from];
            let mut next = 0;
            while next < list.len() {
                for piece in &self.shape.states[self.states[list[next]]].pieces {
                    let to = self.position(piece.target);
                    if !list.contains(&to) {
                        list.push(to);
                    }
                }
                next += 1;
            }
            list
        };
        reached(place).into_iter().all(|k| reached(k).contains(&place))
    }
}
