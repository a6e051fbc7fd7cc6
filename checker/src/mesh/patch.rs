//! Polynomial patches in Bernstein form, and functionals that show that their derivatives are independent.

use super::near::{Near, Point, difference, mixed};
use crate::base::{Checked, spend};
use crate::vertex::patch::quartic;

/// A side of a piece, in units of `2^-12` of those of the patch.
type Side = [i64; 2];

/// Control points: `rows[j][i]`, `i` along the first side, `j` along the second; in a triangle rows get shorter by one.
#[derive(Clone)]
pub struct Patch {
    rows: Vec<Vec<Point>>,
    triangle: bool,
    /// From the first corner to the second and to the third.
    sides: [Side; 2],
}

/// The size of a patch in units of its sides.
const UNIT: i64 = 1 << 12;
/// Bits of the derivatives from which functionals are made.
const SHORT: u32 = 30;

/// A linear functional.
type Functional = [i128; 3];

/// Differences of neighbouring control points in both variables, and a functional for each.
struct Tried {
    along: Vec<Point>,
    across: Vec<Point>,
    f: Functional,
    g: Functional,
}

fn cross(a: &Functional, b: &Functional) -> Functional {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

/// By how many bits the numbers have to be shortened.
fn excess(all: &[Functional], bits: u32) -> u32 {
    let size = all.iter().flatten().fold(0, |most: u128, x| most.max(x.unsigned_abs()));
    (128 - size.leading_zeros()).saturating_sub(bits)
}

fn shortened(v: &Functional, by: u32) -> Functional {
    v.map(|x| x >> by)
}

/// Bounds of a functional at a vector: its value for the middle, and how far others may be from it.
fn value(f: &Functional, v: &Point) -> Option<(i128, i128)> {
    let mut both = (0, 0);
    for (f, x) in f.iter().zip(v) {
        if !x.known() {
            return None;
        }
        both = (both.0 + f * x.middle(), both.1 + f.abs() * x.error());
    }
    Some(both)
}

/// A lower bound of `f(v) − |g(v)|`.
fn least(f: &Functional, g: &Functional, v: &Point) -> Option<i128> {
    let ((x, e), (y, d)) = (value(f, v)?, value(g, v)?);
    Some(x - e - y.abs() - d)
}

/// An upper bound of the length of a functional.
fn length(f: &Functional) -> i128 {
    f.iter().map(|x| x * x).sum::<i128>().isqrt() + 1
}

fn halves_of(row: &[Point]) -> [Vec<Point>; 2] {
    let (mut left, mut right, mut rest) = (Vec::new(), Vec::new(), row.to_vec());
    while let (Some(first), Some(last)) = (rest.first(), rest.last()) {
        left.push(*first);
        right.push(*last);
        rest = rest.windows(2).map(|w| mixed(&[(1, &w[0]), (1, &w[1])], 2)).collect();
    }
    right.reverse();
    [left, right]
}

impl Patch {
    /// The patch of the points in the places of [`places`].
    pub fn new(triangle: bool, points: &[Point]) -> Self {
        let rows = if triangle {
            let known = places(true);
            let control = |mask: &Vec<((i64, i64), i64)>| {
                let term = |(place, w): &((i64, i64), i64)| Some((*w, &points[known.iter().position(|p| p == place)?]));
                match mask.iter().map(term).collect::<Option<Vec<_>>>() {
                    Some(terms) => mixed(&terms, 24),
                    None => [Near::UNKNOWN; 3],
                }
            };
            let mut all = quartic().iter().map(control).collect::<Vec<_>>().into_iter();
            (0..5).map(|j| all.by_ref().take(5 - j).collect()).collect()
        } else {
            let line = |p: [&Point; 4]| {
                [
                    mixed(&[(1, p[0]), (4, p[1]), (1, p[2])], 6),
                    mixed(&[(2, p[1]), (1, p[2])], 3),
                    mixed(&[(1, p[1]), (2, p[2])], 3),
                    mixed(&[(1, p[1]), (4, p[2]), (1, p[3])], 6),
                ]
            };
            let along: Vec<[Point; 4]> = points.chunks(4).map(|p| line([&p[0], &p[1], &p[2], &p[3]])).collect();
            let columns: Vec<[Point; 4]> =
                (0..4).map(|i| line([&along[0][i], &along[1][i], &along[2][i], &along[3][i]])).collect();
            (0..4).map(|j| columns.iter().map(|c| c[j]).collect()).collect()
        };
        Self { rows, triangle, sides: [[UNIT, 0], [0, UNIT]] }
    }

    /// Both halves of the first side, turned so that another side is divided next: of triangles that opposite to the new corner.
    fn halves(&self) -> [Self; 2] {
        let [along, across] = self.sides;
        let all: Vec<[Vec<Point>; 2]> = self.rows.iter().map(|row| halves_of(row)).collect();
        let side = |k: usize| all.iter().map(|both| both[k].clone()).collect::<Vec<_>>();
        let half = along.map(|x| x / 2);
        if !self.triangle {
            let turned = |rows: Vec<Vec<Point>>| {
                let columns = (0..rows[0].len()).map(|i| rows.iter().map(|row| row[i]).collect()).collect();
                Self { rows: columns, triangle: false, sides: [across, half] }
            };
            return [turned(side(0)), turned(side(1))];
        }
        let d = self.rows.len() - 1;
        let turned = |rows: &[Vec<Point>], old: &dyn Fn(usize, usize) -> (usize, usize), sides: [Side; 2]| {
            let row = |j: usize| (0..=d - j).map(|i| old(i, j)).map(|(j, i)| rows[j][i]).collect();
            Self { rows: (0..=d).map(row).collect(), triangle: true, sides }
        };
        let minus = |a: Side, b: Side| [a[0] - b[0], a[1] - b[1]];
        // Corners A, B, C, and M between A and B: C A M, and B C M.
        [
            turned(&side(0), &|i, j| (d - i - j, j), [minus([0, 0], across), minus(half, across)]),
            turned(&side(1), &|i, j| (i, d - i - j), [minus(across, along), minus(half, along)]),
        ]
    }

    fn tried(&self) -> Option<Tried> {
        let along: Vec<Point> =
            self.rows.iter().flat_map(|row| row.windows(2).map(|w| difference(&w[1], &w[0]))).collect();
        let pairs = self.rows.windows(2).flat_map(|w| w[1].iter().zip(&w[0]));
        let across: Vec<Point> = pairs.map(|(b, a)| difference(b, a)).collect();
        let sum = |all: &[Point]| -> Option<Functional> {
            let known = all.iter().flatten().all(|x| x.known());
            known.then(|| std::array::from_fn(|k| all.iter().map(|v| v[k].middle()).sum()))
        };
        let both = [sum(&along)?, sum(&across)?];
        let by = excess(&both, SHORT);
        let [u, v] = both.map(|w| shortened(&w, by));
        let w = cross(&u, &v);
        let w = shortened(&w, excess(&[w], SHORT));
        let [f, g] = [cross(&v, &w), cross(&w, &u)];
        let by = excess(&[f, g], SHORT + 10);
        Some(Tried { along, across, f: shortened(&f, by), g: shortened(&g, by) })
    }

    /// Whether two functionals show that the derivatives are independent everywhere: `f > |g|` on all differences in the first
    /// variable, `g > |f|` on all in the second. If not, both halves are looked at, up to a depth.
    pub fn is_regular(&self, depth: usize) -> Checked<bool> {
        spend(300, 128)?;
        let shown = self.tried().is_some_and(|t| {
            let holds = |f, g, all: &[Point]| all.iter().all(|v| least(f, g, v).is_some_and(|x| x > 0));
            holds(&t.f, &t.g, &t.along) && holds(&t.g, &t.f, &t.across)
        });
        if shown || depth == 0 {
            return Ok(shown);
        }
        let [left, right] = self.halves();
        Ok(left.is_regular(depth - 1)? && right.is_regular(depth - 1)?)
    }

    /// How far each point of a plane net with this patch may be moved, so that two functionals still show the same on all pieces of a
    /// depth, in units; `None` where they do not without that.
    pub fn room(&self, depth: usize) -> Checked<Option<i128>> {
        spend(300, 128)?;
        if depth > 0 {
            let [left, right] = self.halves();
            return Ok(match (left.room(depth - 1)?, right.room(depth - 1)?) {
                (Some(a), Some(b)) => Some(a.min(b)),
                _ => None,
            });
        }
        Ok(self.tried().and_then(|t| {
            // Differences along d move by less than 2 |d|_1 times that.
            let both = 2 * (length(&t.f) + length(&t.g));
            let one = |f, g, side: &Side, v: &Point| {
                let most = both * i128::from(side[0].abs() + side[1].abs());
                least(f, g, v).filter(|x| *x > 0).map(|x| x * i128::from(UNIT) / most)
            };
            let along = t.along.iter().map(|v| one(&t.f, &t.g, &self.sides[0], v));
            let across = t.across.iter().map(|v| one(&t.g, &t.f, &self.sides[1], v));
            along.chain(across).collect::<Option<Vec<_>>>()?.into_iter().min()
        }))
    }
}

/// The places of the points of a patch around its first corner.
pub fn places(triangle: bool) -> Vec<(i64, i64)> {
    let all = (-1..=2).flat_map(|j| (-1..=2).map(move |i| (i, j)));
    // The corners of the triangle (0, 0), (1, 0), (0, 1), and their neighbours.
    all.filter(|(i, j)| !triangle || (-1..=2).contains(&(i + j))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::near::PLACES;
    use super::*;
    use crate::base::whole;
    use crate::vertex::ball::Ball;

    fn patch(triangle: bool, at: impl Fn(i64, i64) -> [i64; 3]) -> Patch {
        let near = |x: i64| Near::of(&Ball::real(&(whole(x) / whole(64))))[0];
        let points: Vec<Point> = places(triangle).into_iter().map(|(i, j)| at(i, j).map(near)).collect();
        Patch::new(triangle, &points)
    }

    #[test]
    fn patches_with_known_answers() {
        assert_eq!((places(false).len(), places(true).len()), (16, 12));
        let holds = |triangle, at: &dyn Fn(i64, i64) -> [i64; 3]| patch(triangle, at).is_regular(8).unwrap();
        for triangle in [false, true] {
            assert!(holds(triangle, &|i, j| [i, j, 0]) && holds(triangle, &|i, j| [i, j, i * i * j]));
            assert!(holds(triangle, &|i, j| [3 * i * i - 2 * i, j, i + j]));
            // Constant in one variable; a patch that is folded.
            assert!(!holds(triangle, &|i, _| [i, 2 * i, i * i]) && !holds(triangle, &|i, j| [3 * i * i - 2 * i, j, 0]));
        }
    }

    /// The pieces of a linear patch are linear, and their sides are those that they say.
    #[test]
    fn halves_keep_their_sides() {
        for triangle in [false, true] {
            let mut all = vec![patch(triangle, |i, j| [i, j, 0])];
            for _ in 0..4 {
                all = all.iter().flat_map(Patch::halves).collect();
                for piece in &all {
                    let d = piece.rows.len() as i64 - 1;
                    let t = piece.tried().unwrap();
                    for (all, side) in [(&t.along, piece.sides[0]), (&t.across, piece.sides[1])] {
                        for v in all {
                            for k in 0..2 {
                                let exact = i128::from(side[k]) * (1 << (PLACES - 18)) / i128::from(d);
                                assert!((v[k].middle() - exact).abs() < 200, "{triangle} {side:?} {v:?}");
                            }
                        }
                    }
                }
            }
            assert_eq!(all.len(), 16);
        }
    }
}
