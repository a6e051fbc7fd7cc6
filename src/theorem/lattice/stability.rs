//! Whether the integer shifts of a limit function are stable.

use super::window::Window;
use crate::arith::{Rational, abs, ratio};
use crate::linalg::Matrix;
use crate::scheme::LatticeMask;

/// Most cells of the torus that are looked at.
const MAX_CELLS: usize = 6000;
/// Smallest side of a cell, as a power of 1/2.
const MAX_DEPTH: usize = 12;
/// Most words at whose points the limit function is looked at.
const MAX_WORDS: usize = 40;

/// What is known of the shifts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stability {
    /// The mask is 1 at this point and 0 at all others of its coset: the limit function is 1 at one point and 0 at its shifts.
    Interpolatory(Vec<i64>),
    /// The mask is that of a box spline, all bases of directions have the determinant 1 or −1, and there is one.
    Unimodular,
    /// For every frequency one of the symbols of the values at some points is not 0.
    Samples(Samples),
    /// The mask is that of a box spline, and a basis of directions has a determinant that is not 1 or −1: the shifts are dependent.
    Dependent(i64),
    /// Nothing is known.
    Unknown,
}

impl Stability {
    /// Whether the shifts are proved to be stable.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        matches!(self, Self::Interpolatory(_) | Self::Unimodular | Self::Samples(_))
    }
}

/// Points where the limit function is looked at, and a cover of the torus by cells on which the symbol of one of them is not 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Samples {
    /// The points, as words of digits: the last letter counts most.
    pub words: Vec<Vec<usize>>,
    /// By chart: the cover of the half circles around 1 and −1, in all combinations, the first variable running slowest.
    pub charts: Vec<Cells>,
}

/// A cell, or the `2^s` parts of one halved along all axes, the first axis running slowest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cells {
    /// The symbol of this word is not 0.
    Leaf(usize),
    /// Smaller cells.
    Parts(Vec<Cells>),
}

/// Looks for a reason why the shifts of the limit function of a mask are stable, or why they are not. `operators` are those of the
/// window, by digit, and the scheme converges.
#[must_use]
pub fn stability(mask: &LatticeMask, window: &Window, operators: &[Matrix]) -> Stability {
    if let Some(splines) = mask.box_spline() {
        let determinants = splines.determinants();
        return match determinants.iter().find(|d| d.abs() > 1) {
            Some(d) => Stability::Dependent(*d),
            None if determinants.iter().any(|d| *d != 0) => Stability::Unimodular,
            None => Stability::Unknown,
        };
    }
    if let Some(at) = interpolated(mask) {
        return Stability::Interpolatory(at);
    }
    samples(window, operators).map_or(Stability::Unknown, Stability::Samples)
}

/// The point of the mask that is alone in its coset.
fn interpolated(mask: &LatticeMask) -> Option<Vec<i64>> {
    let m = mask.dilation();
    let mut counts = vec![0_usize; m.index()];
    mask.terms().iter().for_each(|(a, _)| counts[m.coset(a)] += 1);
    mask.terms().iter().find(|(a, c)| **c == 1 && counts[m.coset(a)] == 1).map(|(a, _)| a.clone())
}

fn samples(window: &Window, operators: &[Matrix]) -> Option<Samples> {
    // The value at 0 as a functional: fixed by the operator of the digit 0, with the sum 1.
    let n = window.points.len();
    let shifted = &operators.first()?.transpose() + &Matrix::identity(n).scale(&ratio(-1, 1));
    let kernel = shifted.kernel();
    if kernel.cols() != 1 {
        return None;
    }
    let column = kernel.column(0);
    let sum = column.iter().fold(Rational::from(0), |s, x| s + x);
    if sum == 0 {
        return None;
    }
    let start: Vec<Rational> = column.iter().map(|x| x / &sum).collect();
    let mut words: Vec<(Vec<usize>, Vec<Rational>)> = vec![(Vec::new(), start)];
    let mut next = 0;
    while words.len() < MAX_WORDS && next < words.len() {
        for (digit, operator) in operators.iter().enumerate().skip(1) {
            let (word, row) = &words[next];
            words.push(([word.as_slice(), &[digit]].concat(), operator.apply_left(row)));
        }
        if next > 0 {
            let (word, row) = &words[next];
            words.push(([word.as_slice(), &[0]].concat(), operators[0].apply_left(row)));
        }
        next += 1;
    }
    let symbols: Vec<Symbol> = words.iter().map(|(_, row)| Symbol::new(&window.points, row)).collect();
    let s = window.points.first()?.len();
    let mut left = MAX_CELLS;
    let charts = (0..1_usize << s).map(|chart| {
        let signs: Vec<i64> = (0..s).map(|k| if chart >> (s - 1 - k) & 1 == 0 { 1 } else { -1 }).collect();
        cover(&symbols, &signs, &vec![Rational::from(0); s], 0, 0, &mut left)
    });
    let mut charts = charts.collect::<Option<Vec<_>>>()?;
    // Words that are not used are left out.
    let mut used = vec![false; words.len()];
    charts.iter().for_each(|c| c.mark(&mut used));
    let renamed: Vec<usize> = used.iter().scan(0, |k, u| Some(std::mem::replace(k, *k + usize::from(*u)))).collect();
    charts.iter_mut().for_each(|c| c.rename(&renamed));
    let words = words.into_iter().zip(used).filter(|(_, u)| *u).map(|((word, _), _)| word).collect();
    Some(Samples { words, charts })
}

impl Cells {
    fn mark(&self, used: &mut [bool]) {
        match self {
            Self::Leaf(k) => used[*k] = true,
            Self::Parts(parts) => parts.iter().for_each(|p| p.mark(used)),
        }
    }

    fn rename(&mut self, names: &[usize]) {
        match self {
            Self::Leaf(k) => *k = names[*k],
            Self::Parts(parts) => parts.iter_mut().for_each(|p| p.rename(names)),
        }
    }

    /// The number of cells that are not divided.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Leaf(_) => 1,
            Self::Parts(parts) => parts.iter().map(Self::count).sum(),
        }
    }
}

/// `Σ c_a z^a`, moved so that its largest coefficient is at 0, which changes no modulus on the torus.
struct Symbol {
    terms: Vec<(Vec<i64>, Rational)>,
    /// By variable, `Σ |c_a| |a_k|`.
    slopes: Vec<Rational>,
}

impl Symbol {
    fn new(points: &[Vec<i64>], row: &[Rational]) -> Self {
        let s = points.first().map_or(0, Vec::len);
        let top = row.iter().map(abs).max().unwrap_or_else(|| Rational::from(0));
        let centre = row.iter().position(|x| abs(x) == top).map_or_else(|| vec![0; s], |k| points[k].clone());
        let moved = |p: &Vec<i64>| p.iter().zip(&centre).map(|(x, c)| x - c).collect::<Vec<i64>>();
        let terms: Vec<(Vec<i64>, Rational)> =
            points.iter().zip(row).filter(|(_, c)| **c != 0).map(|(p, c)| (moved(p), c.clone())).collect();
        let slope =
            |k: usize| terms.iter().fold(Rational::from(0), |sum, (a, c)| sum + abs(c) * Rational::from(a[k].abs()));
        Self { slopes: (0..s).map(slope).collect(), terms }
    }

    /// Whether it has no zero where the parameters differ from `centre` by at most `half`: a point of the circle moves by at most
    /// twice the change of its parameter.
    fn is_far(&self, powers: &[Vec<Complex>], reach: i64, half: &Rational) -> bool {
        let mut value = Complex { re: Rational::from(0), im: Rational::from(0) };
        for (a, c) in &self.terms {
            let power = a.iter().zip(powers).try_fold(None::<Complex>, |p, (k, list)| {
                let next = list.get(usize::try_from(k + reach).ok()?)?;
                Some(Some(p.map_or_else(|| next.clone(), |p| p.times(next))))
            });
            let Some(Some(power)) = power else { return false };
            value.re += &power.re * c;
            value.im += &power.im * c;
        }
        let slack = self.slopes.iter().fold(Rational::from(0), |sum, x| sum + x) * half * Rational::from(2);
        &value.re * &value.re + &value.im * &value.im > &slack * &slack
    }
}

#[derive(Clone)]
struct Complex {
    re: Rational,
    im: Rational,
}

impl Complex {
    fn times(&self, other: &Self) -> Self {
        Self { re: &self.re * &other.re - &self.im * &other.im, im: &self.re * &other.im + &self.im * &other.re }
    }
}

/// The powers from `−reach` to `reach` of `±(1 + it)²/(1 + t²)`.
fn powers(sign: i64, t: &Rational, reach: i64) -> Vec<Complex> {
    let (one, square) = (Rational::from(1), t * t);
    let size = (&one + &square) * Rational::from(sign);
    let z = Complex { re: (&one - &square) / &size, im: t * Rational::from(2) / &size };
    let mut up = vec![Complex { re: one, im: Rational::from(0) }];
    for _ in 0..reach {
        up.push(up[up.len() - 1].times(&z));
    }
    let down = up.iter().skip(1).rev().map(|p| Complex { re: p.re.clone(), im: -&p.im });
    down.chain(up.iter().cloned()).collect()
}

fn cover(
    symbols: &[Symbol],
    signs: &[i64],
    centre: &[Rational],
    depth: usize,
    first: usize,
    left: &mut usize,
) -> Option<Cells> {
    *left = left.checked_sub(1)?;
    crate::stop::check();
    let half = Rational::from(1) / Rational::from(1_i64 << depth);
    let reach = symbols.iter().flat_map(|s| s.terms.iter().flat_map(|(a, _)| a)).fold(0, |m, k| m.max(k.abs()));
    let lists: Vec<Vec<Complex>> = signs.iter().zip(centre).map(|(sign, t)| powers(*sign, t, reach)).collect();
    let order = std::iter::once(first).chain((0..symbols.len()).filter(|k| *k != first));
    // In large cells the slopes are too steep to try them all.
    let tried = if depth < 2 { 4 } else { symbols.len() };
    if let Some(k) = order.take(tried).find(|k| symbols[*k].is_far(&lists, reach, &half)) {
        return Some(Cells::Leaf(k));
    }
    if depth == MAX_DEPTH {
        return None;
    }
    let quarter = &half / Rational::from(2);
    let s = centre.len();
    let part = |k: usize| {
        let moved =
            |(axis, t): (usize, &Rational)| if k >> (s - 1 - axis) & 1 == 0 { t - &quarter } else { t + &quarter };
        centre.iter().enumerate().map(moved).collect::<Vec<Rational>>()
    };
    let parts = (0..1_usize << s).map(|k| cover(symbols, signs, &part(k), depth + 1, first, left));
    parts.collect::<Option<Vec<_>>>().map(Cells::Parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Stability {
        let mask = LatticeMask::parse(text, None).unwrap();
        let window = Window::of(&mask, super::super::window::sum_rules(&mask) - 1).unwrap();
        let operators: Vec<Matrix> = mask.dilation().digits().iter().map(|d| window.operator(&mask, d)).collect();
        stability(&mask, &window, &operators)
    }

    #[test]
    fn splines_by_their_values() {
        // The values at the integers are not enough: their symbol is 0 at -1.
        let Stability::Samples(biquadratic) = found("(1+x)^3*(1+y)^3/16") else { panic!("stable") };
        assert!(biquadratic.words.len() > 1 && biquadratic.charts.len() == 4);
        assert!(matches!(found("(1+x)^2*(1+y)^2*(1+x*y)^2/16"), Stability::Samples(_)));
        assert_eq!(found("(1+x)^2*(1+y)^2/4/(x*y)"), Stability::Interpolatory(vec![0, 0]));
    }

    #[test]
    fn the_zwart_powell_element_is_not_stable() {
        assert_eq!(found("(1+x)*(1+y)*(1+x*y)*(1+x/y)/4"), Stability::Unknown);
        let splines = crate::scheme::named_mask("box-spline", &["directions=(1,0)(0,1)(1,1)(1,-1)".to_owned()]);
        let mask = splines.unwrap().unwrap();
        let window = Window::of(&mask, 1).unwrap();
        assert!(matches!(stability(&mask, &window, &[]), Stability::Dependent(d) if d.abs() == 2));
    }
}
