//! Patches that are C¹ in their parameters and immersed (theory §11.1, Derivative of a patch).

use super::branch::Setting;
use super::edges::{Pairs, agree};
use super::place::{Chart, Param};
use crate::arith::{Interval, Rational, abs};
use crate::linalg::{Matrix, closures};
use crate::radius::{Arrow, JointRadius, System};
use crate::scheme::kronecker;
use crate::shape::Piece;
use crate::theorem::derived::radius_of;
use crate::theorem::{Context, EverySurfaceGap};

/// Most coordinates of all visible quotients together for which this is tried.
const MAX_DIMENSIONS: usize = 120;

/// The hypotheses of the statement on the derivative of a patch, as found.
#[derive(Debug, Clone)]
pub struct PatchDerivative {
    /// `1/N`, by which every piece that leads back to its state shrinks the parameters.
    pub share: Rational,
    /// Dimensions of the spaces `F_e` of the differences of the derivative, by reachable state.
    pub dims: Vec<usize>,
    /// The operators on them, arrows by state and letter; `None` where all are 0.
    pub system: Option<System>,
    /// Their joint spectral radius.
    pub radius: Option<JointRadius>,
    /// Its enclosure; 0 on the space 0.
    pub enclosure: Interval,
    /// The positions in which two faces meet along an edge inside a face.
    pub edges: usize,
    /// With control points, where the differences of the derivative are not set apart: the cells on each of which two directions
    /// show that the derivative keeps its rank, a complete prefix code, and the length of the words by which it is bounded.
    pub cells: Option<(usize, Vec<Vec<usize>>)>,
}

/// A patch in its visible quotients; lists go by the position of a state among the reachable ones.
pub(super) struct Patch<'a> {
    pub cx: &'a Context<'a>,
    pub chart: &'a Chart<'a>,
    pub states: Vec<usize>,
    /// `1/N`.
    pub share: Rational,
    /// By state and letter: the map of the parameters `x ↦ A_i x + p_i`, on columns `1, u, v`.
    pub places: Vec<Vec<Matrix>>,
    /// By state and letter: `U_i^-t`, `U_i = N A_i`, which goes with the derivative as two rows.
    pub turns: Vec<Vec<Matrix>>,
    /// By state and letter: the positions of the targets.
    pub targets: Vec<Vec<usize>>,
    /// By state and letter: `N T_i` on the visible quotients.
    pub scaled: Vec<Vec<Matrix>>,
    /// By state: the differences of its corners 1 and last to corner 0, as rows.
    pub chords: Vec<Matrix>,
    /// By state: the differences of the derivative as rows in echelon form.
    pub families: Vec<Matrix>,
}

/// Proves that a patch is C¹ in its parameters, with a derivative of rank 2.
///
/// # Errors
/// The hypothesis that is not shown to hold.
pub fn derivative(setting: &Setting, chart: &Chart) -> Result<PatchDerivative, EverySurfaceGap> {
    let patch = Patch::new(&setting.cx, chart)?;
    let share = patch.share.clone();
    let system = patch.system();
    let (radius, enclosure) = radius_of(system.as_ref(), &setting.cx.budget.orders);
    let enclosure = enclosure.filter(|e| e.hi < share).ok_or(EverySurfaceGap::Radius)?;
    let pairs = Pairs::new(&patch).ok_or(EverySurfaceGap::Unequal)?;
    if let Some((state, letters)) = agree(&patch, &pairs).ok_or(EverySurfaceGap::Radius)? {
        return Err(EverySurfaceGap::Edge { state, letters });
    }
    let cells = match patch.stands_apart() {
        true => None,
        false => Some(patch.covered().ok_or(EverySurfaceGap::Rank)?),
    };
    let dims = patch.families.iter().map(Matrix::rows).collect();
    Ok(PatchDerivative { share, dims, system, radius, enclosure, edges: pairs.len(), cells })
}

impl<'a> Patch<'a> {
    fn new(cx: &'a Context<'a>, chart: &'a Chart<'a>) -> Result<Self, EverySurfaceGap> {
        let (shape, states) = (cx.shape, cx.shape.reachable());
        if states.iter().map(|&e| cx.spaces.of(e).visible.rows()).sum::<usize>() > MAX_DIMENSIONS {
            return Err(EverySurfaceGap::Large);
        }
        let position = |e: usize| states.iter().position(|s| *s == e).ok_or(EverySurfaceGap::Radius);
        let share = chart.share(&states).ok_or(EverySurfaceGap::Unequal)?;
        let scale = Rational::from(1) / &share;
        let mut patch = Self {
            cx,
            chart,
            states: states.clone(),
            share,
            places: Vec::new(),
            turns: Vec::new(),
            targets: Vec::new(),
            scaled: Vec::new(),
            chords: Vec::new(),
            families: Vec::new(),
        };
        for &e in &states {
            let pieces = &shape.states[e].pieces;
            let places: Vec<Matrix> = (0..pieces.len()).map(|letter| chart.placement(e, letter)).collect();
            let turn = |place: &Matrix| Matrix::from_fn(2, 2, |i, j| &place[(i + 1, j + 1)] * &scale).inverse();
            let turns: Option<Vec<Matrix>> = places.iter().map(|p| Some(turn(p)?.transpose())).collect();
            let on = |p: &Piece| Some(cx.spaces.on_visible(&p.op, e, p.target)?.scale(&scale));
            patch.turns.push(turns.ok_or(EverySurfaceGap::Unequal)?);
            patch.places.push(places);
            patch.targets.push(pieces.iter().map(|p| position(p.target)).collect::<Result<_, _>>()?);
            patch.scaled.push(pieces.iter().map(on).collect::<Option<_>>().ok_or(EverySurfaceGap::Radius)?);
            patch.chords.push(corner_differences(cx, chart, e).ok_or(EverySurfaceGap::Radius)?);
        }
        patch.families = patch.differences();
        // Of the fourth corner of a quadrangle only its difference to the parallelogram is needed, as a difference.
        patch.chords = patch.chords.iter().map(first_two).collect();
        Ok(patch)
    }

    /// All pieces: position, letter, position of the target.
    fn arrows(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        self.targets.iter().enumerate().flat_map(|(e, to)| to.iter().enumerate().map(move |(i, &d)| (e, i, d)))
    }

    /// The smallest families with `N T_i c_δ U_i^-1 − c_e ∈ F_e` and `T_i F_δ ⊂ F_e`, and with the defects of quadrangles.
    fn differences(&self) -> Vec<Matrix> {
        let defect = |c: &Matrix| rows_from(c, 2);
        let mut families: Vec<Matrix> = self.chords.iter().map(defect).collect();
        for (e, i, d) in self.arrows() {
            let image = self.carried(e, i, &first_two(&self.chords[d]));
            families[e] = families[e].stack(&(&image - &first_two(&self.chords[e])));
        }
        let arrows: Vec<_> = self.arrows().map(|(e, i, d)| (d, e, self.scaled[e][i].transpose())).collect();
        closures(families, &arrows)
    }

    /// What a piece makes of a derivative, two rows.
    fn carried(&self, e: usize, letter: usize, rows: &Matrix) -> Matrix {
        &(&self.turns[e][letter] * rows) * &self.scaled[e][letter].transpose()
    }

    /// The same on derivatives as columns, one row after the other.
    pub fn on_derivatives(&self, e: usize, letter: usize) -> Matrix {
        kronecker(&self.turns[e][letter], &self.scaled[e][letter])
    }

    /// The coordinates of vectors of `F_e` (rows), in its echelon basis.
    fn local(&self, e: usize, vectors: &Matrix) -> Matrix {
        let pivots = self.families[e].echelon().pivots;
        Matrix::from_fn(vectors.rows(), pivots.len(), |i, j| vectors[(i, pivots[j])].clone())
    }

    /// `N T_i : F_δ → F_e` in coordinates, on columns.
    fn on_family(&self, e: usize, letter: usize) -> Matrix {
        let images = &self.families[self.targets[e][letter]] * &self.scaled[e][letter].transpose();
        self.local(e, &images).transpose()
    }

    /// `N T_i c_δ U_i^-1 − c_e` in coordinates, as columns.
    fn offset(&self, e: usize, letter: usize) -> Matrix {
        let image = self.carried(e, letter, &self.chords[self.targets[e][letter]]);
        self.local(e, &(&image - &self.chords[e])).transpose()
    }

    /// What a word makes of derivatives, as columns, one row after the other.
    fn product(&self, from: usize, word: &[usize]) -> Matrix {
        let start = Matrix::identity(2 * self.chords[from].cols());
        let step =
            |(product, at): (Matrix, usize), &i: &usize| (&product * &self.on_derivatives(at, i), self.targets[at][i]);
        word.iter().fold((start, from), step).0
    }

    /// The derivative at an eventually periodic address, one row after the other: that of the cycle is the fixed one in `c + F`, unique
    /// because the radius on `F` is below `1/N`.
    pub fn limit(&self, from: usize, prefix: &[usize], home: usize, cycle: &[usize]) -> Option<Vec<Rational>> {
        let product = self.product(home, cycle);
        let shifted = &product - &Matrix::identity(product.rows());
        let family = kronecker(&Matrix::identity(2), &self.families[home].transpose());
        let chords = self.chords[home].entries().to_vec();
        // (M − 1)(c + Fᵗ y) = 0.
        let right: Vec<Rational> = shifted.apply(&chords).into_iter().map(|x| -x).collect();
        let y = (&shifted * &family).solve(&Matrix::from_columns(right.len(), &[right]))?.column(0);
        let fixed: Vec<Rational> = chords.iter().zip(family.apply(&y)).map(|(c, f)| c + f).collect();
        Some(self.product(from, prefix).apply(&fixed))
    }

    /// The operators `T_i` on the differences, as a certificate has them.
    fn system(&self) -> Option<System> {
        if self.families.iter().all(|f| f.rows() == 0) {
            return None;
        }
        let mut arrows = Vec::new();
        for (from, i, to) in self.arrows() {
            let matrix = self.on_family(from, i).scale(&self.share);
            arrows.push(Arrow { from, to, matrix, label: arrows.len() });
        }
        Some(System { dims: self.families.iter().map(Matrix::rows).collect(), arrows })
    }

    /// How the visible quotient of the start is seen: any lift of one of its vectors is seen as the same vector.
    fn view(&self) -> Matrix {
        let start = self.cx.spaces.of(self.states[0]);
        let pivots = start.visible.echelon().pivots;
        let view = self.cx.from.map() * &start.basis;
        Matrix::from_fn(view.rows(), pivots.len(), |i, j| view[(i, pivots[j])].clone())
    }

    /// Whether the differences of the corners of the start, as they are seen, are independent modulo those of the derivative.
    fn stands_apart(&self) -> bool {
        let seen = self.view().transpose();
        let family = &self.families[0] * &seen;
        family.stack(&(&self.chords[0] * &seen)).rank() == family.rank() + 2
    }

    /// Words such that on the cell of each the derivative, as it is seen, keeps its rank, and the length of the words that bound it.
    fn covered(&self) -> Option<(usize, Vec<Vec<usize>>)> {
        // Words that shrink the differences well make fewer cells.
        let by = |least: &Rational| (1..=MAX_LENGTH).find_map(|m| Some((m, self.radii(m, least)?)));
        let half = Rational::from(1) / Rational::from(2);
        let (length, radii) = by(&half).or_else(|| by(&Rational::from(0)))?;
        let (mut open, mut found) = (vec![(Vec::new(), self.view(), 0)], Vec::new());
        while let Some((word, seen, e)) = open.pop() {
            crate::stop::check();
            if self.keeps_rank(&seen, e, &radii[e]) {
                found.push(word);
                continue;
            }
            if word.len() == MAX_DEPTH || found.len() + open.len() > MAX_CELLS {
                return None;
            }
            for i in (0..self.targets[e].len()).rev() {
                let word = [word.as_slice(), &[i]].concat();
                open.push((word, &seen * &self.scaled[e][i], self.targets[e][i]));
            }
        }
        Some((length, found))
    }

    /// By state, the 1-norm of the coordinates of each column of `D_e − c_e` is at most this number, by words of a length; `None` where
    /// there are too many, or the product of one leaves 1 − `wanted` of the differences or more.
    fn radii(&self, length: usize, wanted: &Rational) -> Option<Vec<Rational>> {
        let one = Rational::from(1);
        let (mut largest, mut least) = (vec![Rational::from(0); self.states.len()], one.clone());
        let all = |e: usize| 0..self.targets[e].len();
        let steps: Vec<Vec<Matrix>> =
            (0..self.states.len()).map(|e| all(e).map(|i| self.on_family(e, i)).collect()).collect();
        let offsets: Vec<Vec<Matrix>> =
            (0..self.states.len()).map(|e| all(e).map(|i| self.offset(e, i)).collect()).collect();
        for (e, most) in largest.iter_mut().enumerate() {
            // Products on the differences, and what `D − c` is but for them.
            let k = self.families[e].rows();
            let mut layer = vec![(Matrix::identity(k), Matrix::identity(2), Matrix::zero(k, 2), e)];
            for _ in 0..length {
                let mut next = Vec::new();
                for (product, turn, offset, at) in &layer {
                    crate::stop::check();
                    for (i, &to) in self.targets[*at].iter().enumerate() {
                        let moved = offset + &(&(product * &offsets[*at][i]) * &turn.transpose());
                        next.push((product * &steps[*at][i], turn * &self.turns[*at][i], moved, to));
                    }
                }
                if next.len() > MAX_WORDS {
                    return None;
                }
                layer = next;
            }
            for (product, turn, offset, _) in &layer {
                *most = most.clone().max(norm1(offset));
                least = least.min(&one - norm1(product) * norm1(&turn.transpose()));
            }
        }
        if least <= *wanted {
            return None;
        }
        let bound = largest.iter().max()? / &least;
        Some(largest.iter().map(|own| own + (&one - &least) * &bound).collect())
    }

    /// Whether the two columns of `seen (c_e + f)` are independent for all differences `f` up to a radius: a 2-form that is made of
    /// the columns at `f = 0` is positive on them.
    fn keeps_rank(&self, seen: &Matrix, e: usize, radius: &Rational) -> bool {
        let centre = &self.chords[e] * &seen.transpose();
        let differences = &self.families[e] * &seen.transpose();
        let (x, y) = (&centre * &centre.transpose(), &differences * &centre.transpose());
        let form = |a: &Matrix, i: usize, b: &Matrix, j: usize| &a[(i, 0)] * &b[(j, 1)] - &a[(i, 1)] * &b[(j, 0)];
        let largest =
            |values: &mut dyn Iterator<Item = Rational>| values.fold(Rational::from(0), |most, v| most.max(abs(&v)));
        let n = y.rows();
        let first = largest(&mut (0..n).map(|k| form(&y, k, &x, 1)));
        let second = largest(&mut (0..n).map(|k| form(&x, 0, &y, k)));
        let both = largest(&mut (0..n).flat_map(|k| (0..k).map(move |l| (k, l))).map(|(k, l)| form(&y, k, &y, l)));
        form(&x, 0, &x, 1) > radius * (first + second) + radius * radius * both
    }
}

/// Longest words by which the derivative is bounded.
const MAX_LENGTH: usize = 5;
/// Most of these words from one state.
const MAX_WORDS: usize = 2000;
/// Most letters of a cell.
const MAX_DEPTH: usize = 7;
/// Most cells.
const MAX_CELLS: usize = 4000;

/// The rows of a matrix from some row on.
fn rows_from(m: &Matrix, first: usize) -> Matrix {
    Matrix::from_fn(m.rows() - first, m.cols(), |i, j| m[(first + i, j)].clone())
}

/// The first two rows of a matrix.
fn first_two(m: &Matrix) -> Matrix {
    Matrix::from_fn(2, m.cols(), |i, j| m[(i, j)].clone())
}

/// The largest 1-norm of a column.
fn norm1(m: &Matrix) -> Rational {
    let column = |j: usize| (0..m.rows()).fold(Rational::from(0), |s, i| s + abs(&m[(i, j)]));
    (0..m.cols()).map(column).fold(Rational::from(0), Rational::max)
}

/// The differences of the corners 1 and last to corner 0 in the visible quotient, and of a quadrangle the one by which its corner 2
/// misses the parallelogram, as rows.
fn corner_differences(cx: &Context, chart: &Chart, e: usize) -> Option<Matrix> {
    let point = |param: &Param| cx.shape.point(e, chart.addresses(e, param)?.first()?);
    let points: Vec<Vec<Rational>> = chart.corners(e).iter().map(point).collect::<Option<_>>()?;
    let minus = |a: &[Rational], b: &[Rational]| crate::shape::difference(a, b);
    let last = points.len() - 1;
    let mut rows = vec![minus(&points[1], &points[0]), minus(&points[last], &points[0])];
    if last == 3 {
        rows.push(minus(&minus(&points[2], &points[1]), &rows[1]));
    }
    let rows: Vec<Vec<Rational>> = rows.iter().map(|v| cx.spaces.in_visible(e, v)).collect();
    Some(Matrix::from_rows(cx.spaces.of(e).visible.rows(), rows))
}
