//! Polynomial curves: where the derivative vanishes, and whether the tangent turns continuously there (theory §11, Theorem 6″).

use super::branch::Context;
use crate::algebraic::{Root, roots};
use crate::arith::{Rational, sign};
use crate::linalg::Matrix;
use crate::poly::{Poly, factor};
use crate::shape::{Address, CellKind};

/// Most spans of a curve.
const MAX_SPANS: usize = 64;
/// Largest dimension of the relevant space of a state.
const MAX_DEGREE: usize = 32;
/// Binary digits after which a root is not told from an end.
const MAX_BITS: u64 = 4_096;

/// One polynomial stretch of a curve.
#[derive(Debug, Clone)]
pub struct Span {
    /// The path of its cell from the start state.
    pub path: Vec<usize>,
    /// Its coordinates in the space where the shape is looked at, as polynomials of its own parameter in `[0, 1]`.
    pub coordinates: Vec<Poly>,
    /// The greatest common divisor of their derivatives, monic.
    pub divisor: Poly,
}

/// A point where the derivative changes its sign along its direction.
#[derive(Debug, Clone)]
pub enum Turn {
    /// Inside a span: its index, and the parameter.
    Inside(usize, Root),
    /// Between a span and the next, whose directions of travel differ there.
    Between(usize),
}

/// A curve that is made of polynomial arcs, and what its derivative says.
#[derive(Debug, Clone)]
pub struct Hodograph {
    /// By state, the coordinates of its arc, where it has one.
    pub polynomials: Vec<Option<Vec<Poly>>>,
    /// The arcs, in the order of the parameter.
    pub spans: Vec<Span>,
    /// Cusps and corners.
    pub turns: Vec<Turn>,
}

/// The polynomial arcs of a curve and its cusps and corners; `None` where it is none, or an arc is a single point.
///
/// # Cost
/// Interpolation of every state, one check for each piece, and the factors of a polynomial for each arc.
#[must_use]
pub fn hodograph(cx: &Context) -> Option<Hodograph> {
    let reachable = cx.shape.reachable();
    if reachable.iter().any(|e| cx.shape.states[*e].kind != CellKind::Edge) {
        return None;
    }
    let polynomials = arcs(cx, &reachable);
    let mut spans = Vec::new();
    collect(cx, &polynomials, cx.from.map(), (cx.from.root(), &mut Vec::new(), false), &mut spans)?;
    let mut turns = Vec::new();
    for (k, span) in spans.iter().enumerate() {
        for (f, multiplicity) in factor(&span.divisor) {
            if multiplicity % 2 == 1 && f.degree().is_some_and(|d| d > 0) {
                for root in roots(&f) {
                    if root.is_real() && inside(&root)? {
                        turns.push(Turn::Inside(k, root));
                    }
                }
            }
        }
        if k + 1 < spans.len() && !same_ray(&span.travel(true)?, &spans[k + 1].travel(false)?) {
            turns.push(Turn::Between(k));
        }
    }
    Some(Hodograph { polynomials, spans, turns })
}

/// Whether a real root lies strictly between 0 and 1; `None` where that is not seen.
fn inside(root: &Root) -> Option<bool> {
    if let Some(x) = root.rational() {
        return Some(x > 0 && x < 1);
    }
    let mut bits = 32;
    while bits <= MAX_BITS {
        let x = root.enclosure(bits).0;
        if x.lo > 0 && x.hi < 1 {
            return Some(true);
        }
        if x.hi < 0 || x.lo > 1 {
            return Some(false);
        }
        bits *= 2;
    }
    None
}

fn same_ray(a: &[Rational], b: &[Rational]) -> bool {
    let parallel = (0..a.len()).all(|i| (0..i).all(|j| &a[i] * &b[j] == &a[j] * &b[i]));
    let forward = a.iter().zip(b).fold(Rational::from(0), |s, (x, y)| s + x * y);
    parallel && forward > 0
}

impl Span {
    /// The direction of travel at the end (or the start) of the arc.
    fn travel(&self, at_end: bool) -> Option<Vec<Rational>> {
        let t = Rational::from(u8::from(at_end));
        // The sign of the divisor just before the end, or just after the start.
        let mut rest = self.divisor.clone();
        let mut order = 0;
        while rest.eval(&t) == 0 {
            rest = rest.div_rem(&Poly::linear(&t)).0;
            order += 1;
        }
        let turned = if at_end && order % 2 == 1 { -1 } else { 1 };
        let factor = Rational::from(turned * sign(&rest.eval(&t)));
        let direction: Vec<Rational> =
            self.coordinates.iter().map(|c| c.derivative().div_rem(&self.divisor).0.eval(&t) * &factor).collect();
        direction.iter().any(|x| *x != 0).then_some(direction)
    }
}

type Arc = Option<Vec<Poly>>;

/// By state, polynomials that parametrise its attractor so that its pieces take equal shares of the parameter, where there are
/// such: interpolated, then checked against all pieces; a state counts only if all that it reaches do.
fn arcs(cx: &Context, reachable: &[usize]) -> Vec<Arc> {
    let mut found: Vec<Arc> = vec![None; cx.shape.states.len()];
    for &e in reachable {
        found[e] = interpolated(cx, e);
    }
    loop {
        let wrong: Vec<usize> =
            reachable.iter().copied().filter(|&e| found[e].is_some() && !reproduces(cx, e, &found)).collect();
        if wrong.is_empty() {
            return found;
        }
        for e in wrong {
            found[e] = None;
        }
    }
}

/// `γ_e(b_i + s_i t) = T_i γ_δ(t)`, with `1 − t` for a piece that runs backwards.
fn reproduces(cx: &Context, e: usize, found: &[Arc]) -> bool {
    let Some(own) = &found[e] else { return false };
    let pieces = &cx.shape.states[e].pieces;
    pieces.iter().enumerate().all(|(i, piece)| {
        let Some(inner) = &found[piece.target] else { return false };
        let share = cx.shape.states[e].share(i);
        let start = cx.shape.states[e].before(i + usize::from(piece.reversed));
        let slope = if piece.reversed { -share } else { share };
        own.iter().enumerate().all(|(row, p)| substituted(p, &start, &slope) == combined(piece.op.row(row), inner))
    })
}

/// `p(start + slope t)`.
fn substituted(p: &Poly, start: &Rational, slope: &Rational) -> Poly {
    let line = Poly::new(vec![start.clone(), slope.clone()]);
    p.coeffs().iter().rev().fold(Poly::zero(), |sum, c| &(&sum * &line) + &Poly::constant(c.clone()))
}

fn combined(row: &[Rational], polynomials: &[Poly]) -> Poly {
    row.iter().zip(polynomials).fold(Poly::zero(), |sum, (c, p)| &sum + &p.scale(c))
}

/// The polynomial curve of degree at most `dim V` through the joints of some level.
fn interpolated(cx: &Context, e: usize) -> Arc {
    let degree = cx.spaces.of(e).basis.cols();
    if degree > MAX_DEGREE {
        return None;
    }
    let mut nodes = vec![(Rational::from(0), cx.shape.end_point(e, crate::shape::End::Start)?)];
    let mut level = vec![(Vec::new(), e, false)];
    while nodes.len() <= degree {
        let mut next = Vec::new();
        for (path, state, backwards) in &level {
            let pieces = cx.shape.states[*state].pieces.iter().enumerate();
            let mut parts: Vec<(Vec<usize>, usize, bool)> =
                pieces.map(|(i, p)| ([path.as_slice(), &[i]].concat(), p.target, *backwards != p.reversed)).collect();
            if *backwards {
                parts.reverse();
            }
            // All states must divide the parameter alike for the joints of a level to be equally spaced.
            if parts.len() != cx.shape.states[e].pieces.len() || parts.len() < 2 {
                return None;
            }
            next.extend(parts);
        }
        let share = Rational::from(1) / Rational::from(next.len());
        nodes.truncate(1);
        for (k, (path, state, backwards)) in next.iter().enumerate() {
            let end = if *backwards { crate::shape::End::Start } else { crate::shape::End::Finish };
            let (op, _) = cx.shape.product(e, path);
            nodes.push((Rational::from(k + 1) * &share, op.apply(&cx.shape.end_point(*state, end)?)));
        }
        level = next;
    }
    nodes.truncate(degree + 1);
    let rows = nodes.iter().map(|(t, _)| powers(t, degree + 1)).collect();
    let values = nodes.into_iter().map(|(_, p)| p).collect();
    let coefficients = Matrix::from_rows(degree + 1, rows).solve(&Matrix::from_rows(cx.shape.states[e].dim, values))?;
    Some((0..coefficients.cols()).map(|j| Poly::new(coefficients.column(j))).collect())
}

fn powers(t: &Rational, count: usize) -> Vec<Rational> {
    let mut out = vec![Rational::from(1)];
    while out.len() < count {
        out.push(&out[out.len() - 1] * t);
    }
    out
}

/// The arcs of a cell in the order of the parameter of the start state.
fn collect(
    cx: &Context,
    arcs: &[Arc],
    view: &Matrix,
    (state, path, backwards): (usize, &mut Vec<usize>, bool),
    out: &mut Vec<Span>,
) -> Option<()> {
    if let Some(own) = &arcs[state] {
        let along = |p: Poly| if backwards { substituted(&p, &Rational::from(1), &Rational::from(-1)) } else { p };
        let coordinates: Vec<Poly> = (0..view.rows()).map(|i| along(combined(view.row(i), own))).collect();
        let divisor = coordinates.iter().fold(Poly::zero(), |g, c| g.gcd(&c.derivative()));
        // An arc that is a single point has no direction.
        if divisor.is_zero() || out.len() >= MAX_SPANS {
            return None;
        }
        out.push(Span { path: path.clone(), coordinates, divisor });
        return Some(());
    }
    // A state that comes back to itself never ends.
    if path.len() > cx.shape.states.len() {
        return None;
    }
    let pieces: Vec<(usize, &crate::shape::Piece)> = cx.shape.states[state].pieces.iter().enumerate().collect();
    let order: Vec<_> = if backwards { pieces.into_iter().rev().collect() } else { pieces };
    for (letter, piece) in order {
        path.push(letter);
        collect(cx, arcs, &(view * &piece.op), (piece.target, path, backwards != piece.reversed), out)?;
        path.pop();
    }
    Some(())
}

impl Hodograph {
    /// The address of a turn from the start state, where its parameter is rational.
    #[must_use]
    pub fn address(&self, cx: &Context, turn: &Turn) -> Option<Address> {
        let Turn::Inside(k, root) = turn else { return None };
        let mut t = root.rational()?;
        let span = &self.spans[*k];
        let mut word = span.path.clone();
        let state = *cx.shape.path(cx.from.root(), &word).last()?;
        let mut backwards = false;
        let mut at = cx.from.root();
        for &letter in &span.path {
            let piece = &cx.shape.states[at].pieces[letter];
            backwards ^= piece.reversed;
            at = piece.target;
        }
        if backwards {
            t = Rational::from(1) - t;
        }
        let inner = cx.shape.address_of(state, &t)?;
        word.extend(inner.prefix);
        Some(Address { prefix: word, cycle: inner.cycle })
    }
}
