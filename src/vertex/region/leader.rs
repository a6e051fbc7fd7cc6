//! The largest eigenvalues besides 1 for all values of the parameter in an interval.

#![allow(clippy::float_arithmetic, reason = "proposes eigenvalues and bounds; each is proved afterwards")]

use super::model::{Model, Piece};
use crate::arith::{Interval, Rational, to_f64};
use crate::ring::{Field as _, Ordered as _, Ring as _};
use crate::vertex::field::Fixed;
use crate::vertex::top::{all_below, deflate, float_roots, from_float, newton};

/// Binary places of enclosures.
pub(super) const BITS: u64 = 160;

/// A closed interval of the parameter.
#[derive(Debug, Clone)]
pub(super) struct Window {
    pub lo: Rational,
    pub hi: Rational,
}

impl Window {
    pub fn point(p: &Rational) -> Self {
        Self { lo: p.clone(), hi: p.clone() }
    }

    pub fn width(&self) -> Rational {
        &self.hi - &self.lo
    }

    fn mid(&self) -> Rational {
        (&self.lo + &self.hi) / Rational::from(2)
    }

    pub fn interval(&self) -> Interval {
        Interval::new(self.lo.clone(), self.hi.clone())
    }
}

/// What an eigenvalue is.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    /// A real root, alone in the start of Newton's method, with its enclosure.
    Real { start: Interval, value: Fixed },
    /// The two roots of a quadratic polynomial, which are not real.
    Pair,
}

/// One of the largest eigenvalues, or a pair of them.
#[derive(Debug, Clone)]
pub(super) struct Leader {
    /// The index of its piece.
    pub piece: usize,
    pub kind: Kind,
    /// The square of its modulus, for all values of the window.
    pub square: Interval,
}

impl Leader {
    /// Whether it is a negative number.
    pub fn is_negative(&self) -> bool {
        matches!(&self.kind, Kind::Real { value, .. } if value.hi < 0)
    }

    /// The square of its modulus at a value of its window.
    pub fn square_at(&self, model: &Model, p: &Rational) -> Option<Interval> {
        let piece = &model.pieces[self.piece];
        match &self.kind {
            Kind::Real { start, .. } => Some(real(model, piece, &Window::point(p), start)?.1),
            Kind::Pair => pair(model, piece, &Window::point(p)),
        }
    }
}

/// An eigenvalue in floating point; of a pair the upper one.
struct Guess {
    piece: usize,
    re: f64,
    im: f64,
    modulus: f64,
}

impl Guess {
    fn is_real(&self) -> bool {
        self.im.abs() < 1e-9 * self.modulus.max(1e-3)
    }
}

/// Guesses at a value, largest first.
fn guesses(model: &Model, p: &Rational) -> Vec<Guess> {
    let p = to_f64(p);
    let mut all = Vec::new();
    for (index, piece) in model.pieces.iter().enumerate() {
        let field = model.field(piece.block, 64);
        let t = field.to_f64(&crate::vertex::field::Field::twice_cosine(&field));
        let at = |c: &Vec<crate::poly::Poly>| {
            let in_t = |f: &crate::poly::Poly| f.coeffs().iter().rev().fold(0.0, |v, c| v * t + to_f64(c));
            c.iter().rev().fold(0.0, |v, f| v * p + in_t(f))
        };
        let coefficients: Vec<f64> = piece.poly.iter().map(at).collect();
        let roots = float_roots(&coefficients);
        let guess = |(re, im): (f64, f64)| Guess { piece: index, re, im, modulus: re.hypot(im) };
        all.extend(roots.into_iter().map(guess).filter(|g| g.is_real() || g.im > 0.0));
    }
    all.sort_by(|a, b| b.modulus.total_cmp(&a.modulus));
    all
}

fn real(model: &Model, piece: &Piece, window: &Window, start: &Interval) -> Option<(Fixed, Interval)> {
    let field = model.field(piece.block, BITS);
    let p = field.interval(&window.interval());
    let value = newton(&field, &model.coefficients(piece, &field, &p), start)?;
    let square = field.to_interval(&value).square();
    Some((value, square))
}

/// The squared modulus of the roots of a quadratic polynomial that are certainly not real.
fn pair(model: &Model, piece: &Piece, window: &Window) -> Option<Interval> {
    let field = model.field(piece.block, BITS);
    let p = field.interval(&window.interval());
    let poly = model.coefficients(piece, &field, &p);
    let [c, b, _] = poly.as_slice() else { return None };
    let spiral = field.sub(&field.mul(b, b), &field.scale(c, &Rational::from(4)));
    (field.sign(&spiral) == Some(-1)).then(|| field.to_interval(c))
}

/// Where a real root moves on a window: the roots nearest to it at both ends.
fn start(own: &Guess, ends: [&[Guess]; 2], widened: f64) -> Interval {
    let mut all = vec![own.re];
    for end in ends {
        let real = end.iter().filter(|g| g.piece == own.piece && g.is_real());
        let near = real.map(|g| g.re).min_by(|a, b| (a - own.re).abs().total_cmp(&(b - own.re).abs()));
        all.extend(near);
    }
    let (lo, hi) = all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
    let margin = (hi - lo) * widened + 1e-7;
    Interval::new(from_float(lo - margin), from_float(hi + margin))
}

/// So many of the largest eigenvalues, each a simple one for all values of the window, or a pair of two; all others but 1 are
/// smaller there. `None` where that does not show.
pub(super) fn leaders(model: &Model, window: &Window, count: usize) -> Option<Vec<Leader>> {
    let all = guesses(model, &window.mid());
    let ends = [guesses(model, &window.lo), guesses(model, &window.hi)];
    let chosen = all.get(..count)?;
    let near = [ends[0].as_slice(), ends[1].as_slice()];
    let mut found = Vec::new();
    for own in chosen {
        let piece = &model.pieces[own.piece];
        let leader = if own.is_real() {
            let attempt = |widened| {
                let start = start(own, near, widened);
                let (value, square) = real(model, piece, window, &start)?;
                Some(Leader { piece: own.piece, kind: Kind::Real { start, value }, square })
            };
            [0.3, 1.5].into_iter().find_map(attempt)?
        } else {
            Leader { piece: own.piece, kind: Kind::Pair, square: pair(model, piece, window)? }
        };
        found.push(leader);
    }
    let least = found.iter().map(|l| to_f64(&l.square.lo)).fold(f64::INFINITY, f64::min).max(0.0).sqrt();
    let next = [&all, &ends[0], &ends[1]].into_iter().filter_map(|g| g.get(count)).map(|g| g.modulus);
    let others = from_float(f64::midpoint(least, next.fold(0.0, f64::max)));
    let apart = others > 0 && found.iter().all(|l| &others * &others < l.square.lo);
    (apart && distinct(&found) && are_below(model, window, &found, &others)).then_some(found)
}

/// Whether roots of one piece are different ones.
fn distinct(found: &[Leader]) -> bool {
    let apart = |a: &Leader, b: &Leader| match (&a.kind, &b.kind) {
        (Kind::Real { value: x, .. }, Kind::Real { value: y, .. }) => x.hi < y.lo || y.hi < x.lo,
        // The piece is quadratic and has no other roots.
        _ => false,
    };
    let pairs = (0..found.len()).flat_map(|k| (0..k).map(move |l| (k, l)));
    { pairs }.all(|(k, l)| found[k].piece != found[l].piece || apart(&found[k], &found[l]))
}

/// Whether all eigenvalues but these and 1 are below a bound in modulus, for all values of the window.
fn are_below(model: &Model, window: &Window, found: &[Leader], others: &Rational) -> bool {
    model.pieces.iter().enumerate().all(|(index, piece)| {
        let field = model.field(piece.block, BITS);
        let p = field.interval(&window.interval());
        let mut poly = model.coefficients(piece, &field, &p);
        for leader in found.iter().filter(|l| l.piece == index) {
            match &leader.kind {
                Kind::Real { value, .. } => poly = deflate(&field, &poly, value),
                Kind::Pair => poly = vec![field.one()],
            }
        }
        all_below(&field, &poly, others)
    })
}
