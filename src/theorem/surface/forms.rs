//! Quadratic forms of signature (2, ·) on the stars of a patch, which keep all secants near planes (theory §11.1, Theorem 16).

use super::apart::pairs;
use super::branch::Setting;
use super::glue::start;
use super::place::Chart;
use super::star_space::StarSpaces;
use super::stars::{Part, Stars, parts};
use crate::approx::{FormArrow, FormProblem, ProposedForms};
use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;
use crate::radius::definite;
use crate::shape::difference;
use crate::theorem::{Context, EverySurfaceGap};
use malachite_base::num::arithmetic::traits::Floor;

/// Most points of a star between which secants are tried.
const MAX_SAMPLES: usize = 120;
/// Most words of stars through which control points are looked at, and the longest of them.
const MAX_VIEWS: (usize, usize) = (2_000, 5);
/// Binary digits of the entries of the forms, tried one after the other.
const DIGITS: [i64; 3] = [16, 24, 32];

/// The hypotheses of Theorem 16, as found.
#[derive(Debug, Clone)]
pub struct SurfaceForms {
    /// The start, number 0, and the stars.
    pub stars: Stars,
    /// The forms, of integers, in coordinates of the visible quotients; of the start there is none (0 × 0).
    pub forms: Vec<Matrix>,
    /// By star and child, `κ`; none for the start.
    pub ratios: Vec<Vec<Rational>>,
    /// How many pairs of cells that do not meet have been looked at.
    pub pairs: usize,
    /// After how many words of stars the control points, or the start, are seen not to fold the cones.
    pub views: usize,
}

/// Proves that a patch is G¹ by cones around planes.
///
/// # Errors
/// The hypothesis that is not shown to hold.
pub fn forms(setting: &Setting, chart: &Chart) -> Result<SurfaceForms, EverySurfaceGap> {
    let (cx, shape) = (&setting.cx, setting.cx.shape);
    let start = start(setting.complex, chart).ok_or(EverySurfaceGap::Unparametrised)?;
    chart.share(&shape.reachable()).ok_or(EverySurfaceGap::Unequal)?;
    let largest = shape.reachable().iter().map(|&e| cx.spaces.of(e).basis.cols()).max();
    let most = cx.budget.star_dimensions;
    if largest.is_none_or(|d| d > most) {
        return Err(EverySurfaceGap::LargeStars);
    }
    let stars = Stars::of(shape, chart, start).ok_or(EverySurfaceGap::LargeStars)?;
    let spaces = StarSpaces::new(cx, &stars).ok_or(EverySurfaceGap::LargeStars)?;
    let dims: Vec<usize> = (0..stars.list.len()).map(|s| spaces.dim(s)).collect();
    if dims.iter().any(|d| *d > most) {
        return Err(EverySurfaceGap::LargeStars);
    }
    let problem = problem(cx, chart, &stars, &spaces);
    let none = |star: usize| EverySurfaceGap::NoForms { star: stars.words(shape, star) };
    let mut reason = none(1);
    for proposal in problem.proposals() {
        let proposal = match proposal {
            Ok(proposal) => proposal,
            Err(spaces) => {
                if matches!(reason, EverySurfaceGap::NoForms { .. }) {
                    reason = none(spaces.first().map_or(1, |s| s + 1));
                }
                continue;
            }
        };
        for digits in DIGITS {
            let found = rounded(&stars, &spaces, &problem, &proposal, digits).filter(|f| f.holds(&spaces));
            let Some(mut found) = found else { continue };
            match found.apart(cx, chart, &spaces) {
                None => reason = EverySurfaceGap::Secants,
                Some(pairs) => {
                    found.pairs = pairs;
                    found.views = found.seen(&spaces).ok_or(EverySurfaceGap::Folds)?;
                    return Ok(found);
                }
            }
            break;
        }
    }
    Err(reason)
}

/// The search for forms in floats.
fn problem(cx: &Context, chart: &Chart, stars: &Stars, spaces: &StarSpaces) -> FormProblem {
    let floats = |m: &Matrix| m.entries().iter().map(to_f64).collect::<Vec<f64>>();
    let mut arrows = Vec::new();
    for (s, children) in stars.children.iter().enumerate().skip(1) {
        for (child, map) in children.iter().zip(&spaces.maps[s]) {
            arrows.push(FormArrow { from: s - 1, to: child.star - 1, map: floats(map) });
        }
    }
    let all = 1..stars.list.len();
    FormProblem {
        dims: all.clone().map(|s| spaces.dim(s)).collect(),
        products: all.clone().map(|s| floats(&(&spaces.bases[s] * &spaces.bases[s].transpose()))).collect(),
        arrows,
        secants: all.map(|s| secants(cx, chart, stars, spaces, s)).collect(),
    }
}

/// Differences of points of parts of a star that do not meet, as floats.
fn secants(cx: &Context, chart: &Chart, stars: &Stars, spaces: &StarSpaces, star: usize) -> Vec<Vec<f64>> {
    let cells = &stars.list[star].cells;
    let parts = parts(cx.shape, chart, &stars.list[star]);
    let pieces = |e: usize| &cx.shape.states[e].pieces;
    let fine = parts.iter().map(|p| pieces(p.state).len()).sum::<usize>() <= MAX_SAMPLES;
    let points = |part: &Part| {
        let [cell, letter] = part.from;
        let map = &spaces.cell(star, cell) * &pieces(cells[cell].0)[letter].op;
        let base = |map: &Matrix, e: usize| map.apply(&cx.spaces.of(e).base);
        match fine {
            true => pieces(part.state).iter().map(|p| base(&(&map * &p.op), p.target)).collect(),
            false => vec![base(&map, part.state)],
        }
    };
    let points: Vec<Vec<Vec<Rational>>> = parts.iter().map(points).collect();
    let apart = (0..parts.len()).flat_map(|a| (0..a).map(move |b| (a, b))).filter(|&(a, b)| !parts[a].meets(&parts[b]));
    let pairs = apart.flat_map(|(a, b)| {
        points[a].iter().flat_map(|x| points[b].iter().map(move |y| (x, y)).collect::<Vec<_>>()).collect::<Vec<_>>()
    });
    pairs.map(|(x, y)| difference(x, y).iter().map(to_f64).collect()).collect()
}

/// A proposal in integers and short fractions.
fn rounded(
    stars: &Stars,
    spaces: &StarSpaces,
    problem: &FormProblem,
    proposal: &ProposedForms,
    digits: i64,
) -> Option<SurfaceForms> {
    let short = |x: f64, digits: i64| {
        let half = Rational::from(1) / Rational::from(2);
        Some(Rational::from(((Rational::try_from(x).ok()? << digits) + half).floor()))
    };
    let mut forms = vec![Matrix::zero(0, 0)];
    for (s, form) in proposal.forms.iter().enumerate() {
        let d = spaces.dim(s + 1);
        let entries: Vec<Rational> = form.iter().map(|x| short(*x, digits)).collect::<Option<_>>()?;
        forms.push(Matrix::from_fn(d, d, |i, j| entries[i.min(j) * d + i.max(j)].clone()));
    }
    let mut ratios = vec![Vec::new(); stars.list.len()];
    for (arrow, ratio) in problem.arrows.iter().zip(&proposal.ratios) {
        ratios[arrow.from + 1].push(short(*ratio, 20)? >> 20_i64);
    }
    Some(SurfaceForms { stars: stars.clone(), forms, ratios, pairs: 0, views: 0 })
}

impl SurfaceForms {
    /// *signature* and *growth*.
    fn holds(&self, spaces: &StarSpaces) -> bool {
        let planes = self.forms.iter().skip(1).all(|q| inertia(q) == Some([2, q.rows().saturating_sub(2)]));
        planes && self.stars.list.len() > 1 && (1..self.stars.list.len()).all(|s| self.grows(spaces, s))
    }

    fn grows(&self, spaces: &StarSpaces, s: usize) -> bool {
        let children = self.stars.children[s].iter().zip(&spaces.maps[s]).zip(&self.ratios[s]);
        let full = self.ratios[s].len() == self.stars.children[s].len() && !self.ratios[s].is_empty();
        full && children.into_iter().all(|((child, map), ratio)| {
            let image = &(&map.transpose() * &self.forms[s]) * map;
            *ratio > 0 && definite(&(&image - &self.forms[child.star].scale(ratio)), true)
        })
    }

    /// *apart*: how many pairs of cells show it.
    fn apart(&self, cx: &Context, chart: &Chart, spaces: &StarSpaces) -> Option<usize> {
        let mut all = 0;
        for (s, star) in self.stars.list.iter().enumerate().skip(1) {
            let states: Vec<usize> = star.cells.iter().map(|c| c.0).collect();
            all += pairs(cx, spaces, s, &parts(cx.shape, chart, star), &states, &self.forms[s])?;
        }
        Some(all)
    }

    /// *view*: how many words of stars show it.
    fn seen(&self, spaces: &StarSpaces) -> Option<usize> {
        let (mut open, mut done) = (vec![(Matrix::identity(spaces.dim(0)), 0, 0)], 0);
        while let Some((product, s, length)) = open.pop() {
            crate::stop::check();
            if s > 0 && folds_nothing(&product, &self.forms[s]) {
                done += 1;
                continue;
            }
            if length == MAX_VIEWS.1 || done + open.len() > MAX_VIEWS.0 {
                return None;
            }
            for (child, map) in self.stars.children[s].iter().zip(&spaces.maps[s]) {
                open.push((&product * map, child.star, length + 1));
            }
        }
        Some(done)
    }
}

/// Whether a form is negative on what a map takes to 0.
fn folds_nothing(map: &Matrix, form: &Matrix) -> bool {
    let kernel = map.kernel();
    let inside = &(&kernel.transpose() * form) * &kernel;
    definite(&inside.scale(&Rational::from(-1)), true)
}

/// The numbers of positive and of negative squares of a form; `None` where it is degenerate, or elimination finds only zeros on the
/// diagonal.
fn inertia(form: &Matrix) -> Option<[usize; 2]> {
    let mut rest = form.clone();
    let mut found = [0, 0];
    while rest.rows() > 0 {
        let n = rest.rows();
        let pivot = (0..n).find(|&k| rest[(k, k)] != 0)?;
        found[usize::from(rest[(pivot, pivot)] < 0)] += 1;
        let others: Vec<usize> = (0..n).filter(|k| *k != pivot).collect();
        rest = Matrix::from_fn(n - 1, n - 1, |i, j| {
            let (i, j) = (others[i], others[j]);
            &rest[(i, j)] - &rest[(i, pivot)] * &rest[(pivot, j)] / &rest[(pivot, pivot)]
        });
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn inertia_of_forms() {
        let form = |rows: [[i64; 3]; 3]| Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 1));
        assert_eq!(inertia(&form([[13, 30, 40], [30, 12, 30], [40, 30, 8]])), Some([1, 2]));
        assert_eq!(inertia(&form([[0, 1, 0], [1, 1, 0], [0, 0, 3]])), Some([2, 1]));
        assert_eq!(inertia(&form([[1, 1, 0], [1, 1, 0], [0, 0, 3]])), None);
        assert_eq!(inertia(&form([[0, 1, 0], [1, 0, 0], [0, 0, 3]])), None);
    }
}
