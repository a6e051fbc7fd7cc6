//! Schemes on the plane with a border: one mask to its left, another one to its right, own weights on it and beside it.

use super::lattice::{Dilation, LatticeError, LatticeMask, Terms};
use crate::arith::{Rational, ratio};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use thiserror::Error;

/// Farthest column with weights of its own.
pub const MAX_COLUMN: i64 = 6;

/// Why there is no scheme with a border.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BorderError {
    /// The mask of a side.
    #[error(transparent)]
    Mask(#[from] LatticeError),
    /// Another dilation.
    #[error("the masks beside a border have two variables and twice the unit matrix as dilation")]
    Dilation,
    /// A chart that is turned over or flat.
    #[error("the first coordinate of `place`, the distance of column 1 from the border, is positive")]
    Place,
    /// No weights on the border itself.
    #[error("there are no weights for new points ({column}, 2k + {phase}), and none are known for these two masks")]
    Missing {
        /// The column.
        column: i64,
        /// The row modulo 2.
        phase: usize,
    },
    /// A rule that reads the other side.
    #[error("new points of column {column} would read points of column {read}, on the other side of the border")]
    Across {
        /// The column of the new point.
        column: i64,
        /// That of a point that is read.
        read: i64,
    },
    /// A column that is too far away.
    #[error(
        "columns with weights of their own are from -{MAX_COLUMN} to {MAX_COLUMN}, and so are those that they read"
    )]
    Far,
    /// Weights that do not sum to 1.
    #[error("the weights of new points ({column}, 2k + {phase}) sum to {sum}, not to 1")]
    Sum {
        /// The column.
        column: i64,
        /// The row modulo 2.
        phase: usize,
        /// The sum.
        sum: Rational,
    },
}

/// What lies on one side.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BorderSide {
    /// The mask, with twice the unit matrix as dilation.
    pub mask: LatticeMask,
    /// Where `(1, 0)` lies in the chart in which both sides are looked at: `(c, r)` is at `c · place + (0, r)`.
    pub place: [Rational; 2],
}

/// A scheme on points `(c, r)` of `Z²`, column `c` and row `r`: the border is column 0, and a shift by a row is a symmetry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BorderScheme {
    sides: [BorderSide; 2],
    stencils: BTreeMap<(i64, usize), Terms>,
}

/// The two named sides, for which weights on the border are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NamedSide {
    /// Bicubic splines on squares.
    CatmullClark,
    /// Loop's box spline on triangles.
    Loop,
}

impl NamedSide {
    /// Their names.
    pub const ALL: [(&'static str, Self); 2] = [("catmull-clark", Self::CatmullClark), ("loop", Self::Loop)];

    /// The side of this name.
    #[must_use]
    pub fn named(text: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| *name == text).map(|(_, side)| *side)
    }

    /// Its mask, and its chart: squares, and triangles that are symmetric in the border.
    ///
    /// # Errors
    /// None.
    pub fn side(self) -> Result<BorderSide, LatticeError> {
        let (symbol, slope) = match self {
            Self::CatmullClark => ("(1+x)^4*(1+y)^4/64/(x^2*y^2)", ratio(0, 1)),
            Self::Loop => ("(1+x)^2*(1+y)^2*(1+x*y)^2/16/(x^2*y^2)", ratio(-1, 2)),
        };
        Ok(BorderSide { mask: LatticeMask::parse(symbol, None)?, place: [ratio(1, 1), slope] })
    }

    /// The mean over the faces around a point of the border on this side (`step` is 1 to the right), as weights of the points of
    /// the net that is divided linearly.
    fn averaged(self, step: i64) -> Vec<([i64; 2], Rational)> {
        let ends = [([0, 1], ratio(1, 8)), ([0, -1], ratio(1, 8))];
        let others = match self {
            Self::CatmullClark => vec![
                ([0, 0], ratio(1, 4)),
                ([step, 0], ratio(1, 4)),
                ([step, 1], ratio(1, 8)),
                ([step, -1], ratio(1, 8)),
            ],
            Self::Loop => vec![([0, 0], ratio(1, 4)), ([step, 0], ratio(1, 4)), ([step, step], ratio(1, 4))],
        };
        ends.into_iter().chain(others).collect()
    }

    /// A point of the net that is divided linearly, as weights of old points.
    fn divided(self, [c, r]: [i64; 2]) -> Vec<([i64; 2], Rational)> {
        let halves =
            |x: i64| if x.rem_euclid(2) == 0 { vec![x / 2] } else { vec![x.div_euclid(2), x.div_euclid(2) + 1] };
        let (columns, rows) = (halves(c), halves(r));
        let ends: Vec<[i64; 2]> = match self {
            // The diagonal (1, 1) is an edge.
            Self::Loop if columns.len() == 2 && rows.len() == 2 => {
                columns.into_iter().zip(rows).map(|(a, b)| [a, b]).collect()
            }
            _ => columns.iter().flat_map(|a| rows.iter().map(move |b| [*a, *b])).collect(),
        };
        let share = Rational::from(1) / Rational::from(ends.len() as u64);
        ends.into_iter().map(|p| (p, share.clone())).collect()
    }
}

/// The weights of J. Stam and C. Loop on the border between two sides: the mean over the faces, weighted by their angles, of the
/// net that is divided linearly.
#[must_use]
pub fn averaged_border(sides: [NamedSide; 2]) -> Vec<((i64, usize), Terms)> {
    let row = |phase: usize| {
        let mut terms = Vec::new();
        for (side, step) in sides.iter().zip([-1, 1]) {
            for (at, weight) in side.averaged(step) {
                for (old, share) in side.divided([at[0], at[1] + phase as i64]) {
                    terms.push((old.to_vec(), &weight * share * ratio(1, 2)));
                }
            }
        }
        ((0, phase), Terms::new(2, terms))
    };
    vec![row(0), row(1)]
}

impl BorderScheme {
    /// The scheme with these sides (left, right) and, for columns and rows modulo 2, weights of its own: new points `(c, 2k + s)`
    /// are sums of old points `(a, k + b)`, `(a, b)` being the exponents.
    ///
    /// # Errors
    /// [`BorderError`].
    pub fn new(
        sides: [BorderSide; 2],
        stencils: impl IntoIterator<Item = ((i64, usize), Terms)>,
    ) -> Result<Self, BorderError> {
        let twice = Dilation::scalar(2, 2)?;
        for side in &sides {
            if *side.mask.dilation() != twice {
                return Err(BorderError::Dilation);
            }
            if side.place[0] <= 0 {
                return Err(BorderError::Place);
            }
        }
        let made = Self { sides, stencils: stencils.into_iter().collect() };
        for ((column, phase), terms) in &made.stencils {
            let sum = terms.iter().fold(Rational::from(0), |s, (_, c)| s + c);
            if column.abs() > MAX_COLUMN
                || *phase > 1
                || terms.iter().any(|(a, _)| a.iter().any(|x| x.abs() > MAX_COLUMN))
            {
                return Err(BorderError::Far);
            }
            if sum != 1 {
                return Err(BorderError::Sum { column: *column, phase: *phase, sum });
            }
        }
        for phase in 0..2 {
            if !made.stencils.contains_key(&(0, phase)) {
                return Err(BorderError::Missing { column: 0, phase });
            }
        }
        let farthest = made.sides.iter().filter_map(|s| s.mask.terms().corners());
        let farthest = farthest.fold(1, |most, (low, high)| most.max(low[0].abs()).max(high[0].abs()));
        for column in (-farthest..=farthest).filter(|c| *c != 0) {
            for row in 0..2_i64 {
                let own = made.stencils.contains_key(&(column, row as usize));
                let read = made.rule(column, row).into_iter().map(|(a, _)| a[0]).find(|a| a * column < 0);
                if let (false, Some(read)) = (own, read) {
                    return Err(BorderError::Across { column, read });
                }
            }
        }
        Ok(made)
    }

    /// The sides, left and right.
    #[must_use]
    pub fn sides(&self) -> &[BorderSide; 2] {
        &self.sides
    }

    /// The columns and rows modulo 2 with weights of their own.
    pub fn stencils(&self) -> impl Iterator<Item = (&(i64, usize), &Terms)> {
        self.stencils.iter()
    }

    /// The old points on which the new point of a column and a row depends, with their weights.
    #[must_use]
    pub fn rule(&self, column: i64, row: i64) -> Vec<(Vec<i64>, Rational)> {
        let phase = usize::from(row.rem_euclid(2) == 1);
        if let Some(terms) = self.stencils.get(&(column, phase)) {
            let moved = |a: &Vec<i64>| vec![a[0], a[1] + row.div_euclid(2)];
            return terms.iter().map(|(a, c)| (moved(a), c.clone())).collect();
        }
        let mask = &self.sides[usize::from(column > 0)].mask;
        let old =
            |(a, c): (&Vec<i64>, &Rational)| Some((mask.dilation().divide(&[column - a[0], row - a[1]])?, c.clone()));
        mask.terms().iter().filter_map(old).collect()
    }

    /// The case file of the scheme, with all coefficients (docs/case-format.md).
    #[must_use]
    pub fn case_text(&self, name: &str) -> String {
        let mut out = format!("name = {name:?}\n");
        for (word, side) in ["left", "right"].into_iter().zip(&self.sides) {
            let [x, y] = &side.place;
            let _ =
                writeln!(out, "\n[border.{word}]\nplace = [\"{x}\", \"{y}\"]\n{}", side.mask.grid_text().trim_end());
        }
        for ((column, phase), terms) in &self.stencils {
            let weights: Vec<String> = terms.iter().map(|(a, c)| format!("[{}, {}, \"{c}\"]", a[0], a[1])).collect();
            let _ = write!(out, "\n[[border.stencil]]\nat = [{column}, {phase}]\nweights = [{}]\n", weights.join(", "));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_two_equal_sides_is_their_mask() {
        for (_, named) in NamedSide::ALL {
            let side = named.side().unwrap();
            let scheme = BorderScheme::new([side.clone(), side.clone()], averaged_border([named, named])).unwrap();
            for row in 0..2 {
                let mut rule = scheme.rule(0, row);
                rule.sort();
                let plain = side.mask.terms().iter();
                let old = |(a, c): (&Vec<i64>, &Rational)| {
                    Some((side.mask.dilation().divide(&[-a[0], row - a[1]])?, c.clone()))
                };
                let mut wanted: Vec<_> = plain.filter_map(old).collect();
                wanted.sort();
                assert_eq!(rule, wanted);
            }
        }
    }

    #[test]
    fn what_is_refused() {
        let [quads, triangles] = NamedSide::ALL.map(|(_, s)| s.side().unwrap());
        let sides = [quads.clone(), triangles];
        let border = averaged_border([NamedSide::CatmullClark, NamedSide::Loop]);
        assert!(BorderScheme::new(sides.clone(), border.clone()).is_ok());
        let missing = BorderScheme::new(sides.clone(), border.clone().into_iter().skip(1));
        assert_eq!(missing, Err(BorderError::Missing { column: 0, phase: 0 }));
        let half = Terms::new(2, [(vec![0, 0], ratio(1, 2))]);
        let short = BorderScheme::new(sides, border.clone().into_iter().chain([((1, 0), half)]));
        assert!(matches!(short, Err(BorderError::Sum { column: 1, .. })));
        let wide = LatticeMask::parse("(1+x)^6*(1+y)^2/64/(x^3*y)", None).unwrap();
        let wide = BorderSide { mask: wide, place: [ratio(1, 1), ratio(0, 1)] };
        let across = BorderScheme::new([quads.clone(), wide], border.clone());
        assert!(matches!(across, Err(BorderError::Across { column: 1, read: -1 })));
        let turned = BorderSide { place: [ratio(-1, 1), ratio(0, 1)], ..quads.clone() };
        assert_eq!(BorderScheme::new([turned, quads], border), Err(BorderError::Place));
    }
}
