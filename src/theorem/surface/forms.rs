//! Quadratic forms of signature (2, ·) on the stars of a patch, which keep all secants near planes (theory §11.1, Theorem 16).

use super::apart::pairs;
use super::branch::Setting;
use super::place::Chart;
use super::star_space::StarSpaces;
use super::stars::{Stars, parts};
use crate::approx::{FormArrow, FormProblem, ProposedForms};
use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;
use crate::radius::definite;
use crate::shape::difference;
use crate::theorem::{Context, EverySurfaceGap};
use malachite_base::num::arithmetic::traits::Floor;

/// Most dimensions of what is seen of a star.
const MAX_DIMENSIONS: usize = 16;
/// Most points of a star between which secants are tried.
const MAX_SAMPLES: usize = 100;
/// Most words of stars through which control points are looked at, and the longest of them.
const MAX_VIEWS: (usize, usize) = (2_000, 5);
/// Binary digits of the entries of the forms, tried one after the other.
const DIGITS: [i64; 3] = [16, 22, 28];

/// The hypotheses of Theorem 16, as found.
#[derive(Debug, Clone)]
pub struct SurfaceForms {
    /// The face, number 0, and the stars.
    pub stars: Stars,
    /// The forms, of integers, in coordinates of the visible quotients; of the face there is none (0 × 0).
    pub forms: Vec<Matrix>,
    /// By star and child, `κ`; none for the face.
    pub ratios: Vec<Vec<Rational>>,
    /// How many pairs of cells that do not meet have been looked at.
    pub pairs: usize,
    /// After how many words of stars the control points, or the face, are seen not to fold the cones.
    pub views: usize,
}

/// Proves that a patch is G¹ by cones around planes.
///
/// # Errors
/// The hypothesis that is not shown to hold.
pub fn forms(setting: &Setting, chart: &Chart) -> Result<SurfaceForms, EverySurfaceGap> {
    let (cx, shape) = (&setting.cx, setting.cx.shape);
    chart.share(&shape.reachable()).ok_or(EverySurfaceGap::Unequal)?;
    let largest = shape.reachable().iter().map(|&e| cx.spaces.of(e).basis.cols()).max();
    if largest.is_none_or(|d| d > MAX_DIMENSIONS) {
        return Err(EverySurfaceGap::LargeStars);
    }
    let stars = Stars::of(shape, chart).ok_or(EverySurfaceGap::LargeStars)?;
    let spaces = StarSpaces::new(cx, &stars).ok_or(EverySurfaceGap::LargeStars)?;
    let dims: Vec<usize> = (0..stars.list.len()).map(|s| spaces.dim(s)).collect();
    if dims.iter().any(|d| *d > MAX_DIMENSIONS) {
        return Err(EverySurfaceGap::LargeStars);
    }
    let problem = problem(cx, &stars, &spaces);
    let mut reason = EverySurfaceGap::NoForms;
    for proposal in problem.proposals() {
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
fn problem(cx: &Context, stars: &Stars, spaces: &StarSpaces) -> FormProblem {
    let floats = |m: &Matrix| m.entries().iter().map(to_f64).collect::<Vec<f64>>();
    let mut arrows = Vec::new();
    for (s, children) in stars.children.iter().enumerate().skip(1) {
        for (child, map) in children.iter().zip(&spaces.maps[s]) {
            arrows.push(FormArrow { from: s - 1, to: child.star - 1, map: floats(map) });
        }
    }
    let secants = (1..stars.list.len()).map(|s| secants(cx, stars, spaces, s)).collect();
    FormProblem { dims: (1..stars.list.len()).map(|s| spaces.dim(s)).collect(), arrows, secants }
}

/// Differences of points of a star, as floats.
fn secants(cx: &Context, stars: &Stars, spaces: &StarSpaces, star: usize) -> Vec<Vec<f64>> {
    let cells = stars.list[star].cells.iter().enumerate();
    let mut layer: Vec<(Matrix, usize)> = cells.map(|(cell, (e, _))| (spaces.cell(star, cell), *e)).collect();
    let pieces = |e: usize| &cx.shape.states[e].pieces;
    while layer.iter().map(|(_, e)| pieces(*e).len()).sum::<usize>() <= MAX_SAMPLES {
        let divided =
            |(map, e): &(Matrix, usize)| pieces(*e).iter().map(|p| (map * &p.op, p.target)).collect::<Vec<_>>();
        layer = layer.iter().flat_map(divided).collect();
    }
    let points: Vec<Vec<Rational>> = layer.iter().map(|(map, e)| map.apply(&cx.spaces.of(*e).base)).collect();
    let both = (0..points.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    both.map(|(a, b)| difference(&points[a], &points[b]).iter().map(to_f64).collect()).collect()
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
