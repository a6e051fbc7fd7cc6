//! The largest eigenvalues below 1: which Fourier blocks they live in, their Jordan blocks, and the proof that they strictly
//! dominate all others.

use super::block::{Block, Vertex};
use super::cosine::{gcd, minimal_polynomial, twice_cosine};
use super::field::{Enclosures, Field, Fixed, NumberField};
use super::reason::VertexReason;
use super::ring::Values;
use super::solve::{eigenvector, leading_vector, longest_blocks};
use super::turning::Turning;
use crate::algebraic::Elem;
use crate::algebraic::field::NumberField as Numbers;
use crate::arith::{Interval, Rational, abs, ratio, to_f64};
use crate::poly::Poly;
use crate::ring::{Field as _, Ordered as _, Ring as _};
use crate::scheme::SchemeError;
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;

/// What the largest modulus consists of in one block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Member {
    /// The frequency; `n − k` has the same unless `k` is 0 or `n/2`.
    pub frequency: usize,
    /// Whether the eigenvalue is the negative of the one of the class.
    pub negative: bool,
    /// The sizes of its Jordan blocks, descending.
    pub blocks: Vec<usize>,
}

/// The eigenvalues of the largest modulus below 1.
#[derive(Debug, Clone)]
pub struct Top {
    /// The value, where it is rational.
    pub rational: Option<Rational>,
    /// An enclosure.
    pub enclosure: Interval,
    /// The polynomial that has it as a root: coefficients from the constant one up, in `t = 2cos(2πk/n)`, `k` being
    /// [`Top::angle`].
    pub poly: Vec<Poly>,
    /// The `k` of the angle in the polynomial.
    pub angle: usize,
    /// The blocks with this eigenvalue or its negative.
    pub members: Vec<Member>,
    /// A bound that all other eigenvalues but 1 stay strictly below.
    pub others: Rational,
    /// Where the eigenvalue was found: the block, and the part of a simple one.
    place: (usize, Option<usize>),
}

/// Why there is no answer.
#[derive(Debug, Clone)]
pub enum TopError {
    /// The blocks cannot be built.
    Scheme(SchemeError),
    /// Nothing was proved.
    Open(VertexReason),
}

impl From<SchemeError> for TopError {
    fn from(error: SchemeError) -> Self {
        Self::Scheme(error)
    }
}

/// A factor of the characteristic polynomials, without the eigenvalue 1.
pub(super) struct Piece {
    pub block: usize,
    pub part: usize,
    pub poly: Vec<Poly>,
}

/// An eigenvalue in floating point.
pub(super) struct Guess {
    pub piece: usize,
    pub re: f64,
    pub im: f64,
    pub modulus: f64,
}

impl Top {
    /// The size of the longest Jordan blocks, and the real dimension of the span of the eigenvectors that end their chains.
    #[must_use]
    pub fn longest(&self, valence: usize) -> (usize, usize) {
        let length = self.members.iter().filter_map(|m| m.blocks.first()).max().map_or(0, |length| *length);
        let count = |m: &Member| {
            let twice = if m.frequency == 0 || 2 * m.frequency == valence { 1 } else { 2 };
            twice * m.blocks.iter().filter(|b| **b == length).count()
        };
        (length, self.members.iter().map(count).sum())
    }

    /// The members with a longest Jordan block.
    pub fn leading(&self, valence: usize) -> Vec<&Member> {
        let length = self.longest(valence).0;
        self.members.iter().filter(|m| m.blocks.first() == Some(&length)).collect()
    }
}

/// Finds the largest eigenvalues of a scheme at a vertex and proves that they dominate.
///
/// # Errors
/// [`TopError`].
pub fn top(vertex: &Vertex, blocks: &[Block], bits: u64) -> Result<Top, TopError> {
    let pieces = pieces(blocks);
    let mut guesses = guess(vertex, blocks, &pieces);
    guesses.sort_by(|a, b| b.modulus.total_cmp(&a.modulus));
    let Some(first) = guesses.first() else { return Err(TopError::Open(VertexReason::NoSecond)) };
    let next = guesses.get(1).map_or(0.0, |g| g.modulus);
    #[allow(clippy::float_arithmetic, reason = "proposes which proof to try")]
    let apart = first.modulus - next > 1e-12 && first.im.abs() < 1e-9;
    if apart && let Some(found) = simple(vertex, blocks, &pieces, first, next, bits) {
        return Ok(found);
    }
    tied(vertex, blocks, &pieces, &guesses, bits)
}

/// The parts of all blocks; the eigenvalue 1 of the block 0 is divided out once.
pub(super) fn pieces(blocks: &[Block]) -> Vec<Piece> {
    let mut all = Vec::new();
    let mut divided = false;
    for (b, block) in blocks.iter().enumerate() {
        for (p, part) in block.parts.iter().enumerate() {
            let mut poly = part.poly.clone();
            let at_one = poly.iter().fold(Poly::zero(), |s, c| &s + c);
            if block.frequency == 0 && !divided && at_one.is_zero() {
                divided = true;
                poly = deflate_one(&poly);
            }
            if poly.len() > 1 {
                all.push(Piece { block: b, part: p, poly });
            }
        }
    }
    all
}

/// The quotient by `x − 1`.
fn deflate_one(poly: &[Poly]) -> Vec<Poly> {
    let mut quotient = Vec::new();
    let mut carry = Poly::zero();
    for c in poly.iter().skip(1).rev() {
        carry = &carry + c;
        quotient.push(carry.clone());
    }
    quotient.reverse();
    quotient
}

#[allow(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "proposes eigenvalues; each is proved afterwards"
)]
pub(super) fn guess(vertex: &Vertex, blocks: &[Block], pieces: &[Piece]) -> Vec<Guess> {
    let mut all = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        let angle = std::f64::consts::TAU * blocks[piece.block].angle as f64 / vertex.valence as f64;
        let t = 2.0 * angle.cos();
        let value = |p: &Poly| p.coeffs().iter().rev().fold(0.0, |v, c| v * t + to_f64(c));
        let coefficients: Vec<f64> = piece.poly.iter().map(value).collect();
        for (re, im) in float_roots(&coefficients) {
            all.push(Guess { piece: index, re, im, modulus: re.hypot(im) });
        }
    }
    all
}

/// All roots of a monic polynomial (Durand and Kerner).
#[allow(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "proposes eigenvalues; each is proved afterwards"
)]
pub(super) fn float_roots(c: &[f64]) -> Vec<(f64, f64)> {
    let degree = c.len() - 1;
    let radius = 1.0 + c.iter().take(degree).fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut z: Vec<(f64, f64)> = (0..degree)
        .map(|k| {
            let angle = 0.4 + std::f64::consts::TAU * k as f64 / degree as f64;
            (0.7 * radius * angle.cos(), 0.7 * radius * angle.sin())
        })
        .collect();
    let mul = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    for _ in 0..500 {
        let mut change = 0.0_f64;
        for k in 0..degree {
            let value = c.iter().rev().fold((0.0, 0.0), |v, x| {
                let p = mul(v, z[k]);
                (p.0 + x, p.1)
            });
            let mut below = (1.0, 0.0);
            for l in (0..degree).filter(|l| *l != k) {
                below = mul(below, (z[k].0 - z[l].0, z[k].1 - z[l].1));
            }
            let size = (below.0 * below.0 + below.1 * below.1).max(1e-300);
            let step = mul(value, (below.0 / size, -below.1 / size));
            z[k] = (z[k].0 - step.0, z[k].1 - step.1);
            change = change.max(step.0.abs() + step.1.abs());
        }
        if change < 1e-16 {
            break;
        }
    }
    z
}

pub(super) fn from_float(x: f64) -> Rational {
    Rational::try_from(x).unwrap_or_else(|_| Rational::from(0))
}

pub(super) fn field_of(vertex: &Vertex, block: &Block, bits: u64) -> Enclosures {
    Enclosures::of_angle(block.angle, vertex.valence, bits)
}

pub(super) fn coefficients(field: &Enclosures, poly: &[Poly]) -> Vec<Fixed> {
    poly.iter().map(|c| field.eval(c, &field.twice_cosine())).collect()
}

/// One real simple eigenvalue alone in its modulus, among the blocks `0 … n/2`.
fn simple(vertex: &Vertex, blocks: &[Block], pieces: &[Piece], first: &Guess, next: f64, bits: u64) -> Option<Top> {
    let own = &pieces[first.piece];
    let block = &blocks[own.block];
    let field = field_of(vertex, block, bits);
    let value = newton(&field, &coefficients(&field, &own.poly), &around(&from_float(first.re)))?;
    let enclosure = field.to_interval(&value);
    let size = abs(&enclosure.lo).min(abs(&enclosure.hi));
    #[allow(clippy::float_arithmetic, reason = "proposes a bound between the eigenvalues")]
    let others = from_float(f64::midpoint(first.modulus, next));
    if others >= size || enclosure.contains_zero() {
        return None;
    }
    for (index, piece) in pieces.iter().enumerate() {
        let field = field_of(vertex, &blocks[piece.block], bits);
        let mut poly = coefficients(&field, &piece.poly);
        if index == first.piece {
            poly = deflate(&field, &poly, &value);
        }
        if !all_below(&field, &poly, &others) {
            return None;
        }
    }
    let members = vec![Member { frequency: block.frequency, negative: false, blocks: vec![1] }];
    let rational =
        rational_root(vertex, block, &own.poly, first.re).filter(|q| enclosure.lo <= *q && *q <= enclosure.hi);
    let place = (own.block, Some(own.part));
    let modulus = minimal_polynomial(vertex.valence / gcd(block.angle, vertex.valence));
    let poly = own.poly.iter().map(|c| c.div_rem(&modulus).1).collect();
    Some(Top { rational, enclosure, poly, angle: block.angle, members, others, place })
}

/// A short interval around a number.
pub(super) fn around(near: &Rational) -> Interval {
    Interval::new(near - ratio(1, 1 << 24), near + ratio(1, 1 << 24))
}

/// The root in an interval, enclosed by Newton's method on intervals: where the step maps it into itself it holds exactly one
/// root, of every polynomial with coefficients in the enclosures.
pub(super) fn newton(field: &Enclosures, poly: &[Fixed], start: &Interval) -> Option<Fixed> {
    let derivative: Vec<Fixed> =
        poly.iter().enumerate().skip(1).map(|(k, c)| field.scale(c, &Rational::from(k as u64))).collect();
    let at = |p: &[Fixed], x: &Fixed| p.iter().rev().fold(field.zero(), |v, c| field.add(&field.mul(&v, x), c));
    let mut x = field.interval(start);
    let mut proved = false;
    for _ in 0..16 {
        let middle: crate::arith::Integer = (&x.lo + &x.hi) >> 1_u32;
        let middle = Fixed { lo: middle.clone(), hi: middle };
        let step = field.mul(&at(poly, &middle), &field.inv(&at(&derivative, &x))?);
        let next = field.sub(&middle, &step);
        proved = proved || (next.lo > x.lo && next.hi < x.hi);
        if next.hi < x.lo || next.lo > x.hi {
            return None;
        }
        let cut = Fixed { lo: next.lo.max(x.lo.clone()), hi: next.hi.min(x.hi.clone()) };
        if cut == x {
            break;
        }
        x = cut;
    }
    proved.then_some(x)
}

/// The quotient by `x − value`, for a root.
pub(super) fn deflate<F: Field>(field: &F, poly: &[F::E], value: &F::E) -> Vec<F::E> {
    let mut quotient = Vec::new();
    let mut carry = field.zero();
    for c in poly.iter().skip(1).rev() {
        carry = field.add(&field.mul(&carry, value), c);
        quotient.push(carry.clone());
    }
    quotient.reverse();
    quotient
}

/// Whether all roots are certainly smaller than `bound` in modulus (Schur and Cohn).
pub(super) fn all_below(field: &Enclosures, poly: &[Fixed], bound: &Rational) -> bool {
    let mut power = Rational::from(1);
    let mut a: Vec<Fixed> = Vec::new();
    for c in poly {
        a.push(field.scale(c, &power));
        power *= bound;
    }
    while a.len() > 1 {
        let (constant, lead) = (a[0].clone(), a[a.len() - 1].clone());
        let Some(inverse) = field.inv(&lead) else { return false };
        // Of the monic polynomial only the size of the constant coefficient matters.
        let k = field.mul(&constant, &inverse);
        let one = field.one();
        if field.sign(&field.sub(&one, &k)) != Some(1) || field.sign(&field.add(&one, &k)) != Some(1) {
            return false;
        }
        let size = a.len();
        let next = (0..size - 1)
            .map(|i| field.mul(&inverse, &field.sub(&a[i + 1], &field.mul(&k, &a[size - 2 - i]))))
            .collect();
        a = next;
    }
    true
}

/// The value of a root near a float, where it is rational.
fn rational_root(vertex: &Vertex, block: &Block, poly: &[Poly], near: f64) -> Option<Rational> {
    let candidate = simplest_near(&from_float(near), &ratio(1, 1 << 26));
    let modulus = minimal_polynomial(vertex.valence / gcd(block.angle, vertex.valence));
    let value = poly.iter().rev().fold(Poly::zero(), |v, c| &v.scale(&candidate) + c);
    value.div_rem(&modulus).1.is_zero().then_some(candidate)
}

/// The fraction with the smallest denominator within `error` (Stern and Brocot).
fn simplest_near(x: &Rational, error: &Rational) -> Rational {
    Rational::simplest_rational_in_closed_interval(&(x - error), &(x + error))
}

/// Eigenvalues of equal modulus, proved equal where they are one rational number or its negative.
#[allow(clippy::float_arithmetic, reason = "proposes the class, its value and a bound; all are proved")]
fn tied(vertex: &Vertex, blocks: &[Block], pieces: &[Piece], guesses: &[Guess], bits: u64) -> Result<Top, TopError> {
    let largest = guesses[0].modulus;
    let class: Vec<&Guess> = guesses.iter().filter(|g| largest - g.modulus < 1e-4).collect();
    let next = guesses.iter().find(|g| largest - g.modulus >= 1e-4).map_or(0.0, |g| g.modulus);
    let mean = class.iter().map(|g| g.modulus).sum::<f64>() / class.len() as f64;
    let open = || {
        let place = |g: &&Guess| (g.re, blocks[pieces[g.piece].block].frequency);
        TopError::Open(VertexReason::Close(class.iter().map(place).collect()))
    };
    let value = simplest_near(&from_float(mean), &ratio(1, 100_000));
    let others = from_float(f64::midpoint(mean, next));
    if value <= 0 || value >= 1 || others >= value {
        return Err(open());
    }
    let mut counts = vec![[0_usize; 2]; blocks.len()];
    for piece in pieces {
        let block = &blocks[piece.block];
        let field = number_field(vertex, block);
        let mut poly: Vec<Elem> = piece.poly.iter().map(|c| field.eval(c, &field.twice_cosine())).collect();
        for (side, root) in [value.clone(), -&value].iter().enumerate() {
            let root = field.rational(root);
            while poly.len() > 1 && evaluate(&field, &poly, &root).is_zero() {
                poly = deflate(&field, &poly, &root);
                counts[piece.block][side] += 1;
            }
        }
        let enclosures = field_of(vertex, block, bits);
        let rest: Vec<Fixed> = poly.iter().map(|c| enclose(&field, &enclosures, c)).collect();
        if !all_below(&enclosures, &rest, &others) {
            return Err(open());
        }
    }
    let mut members = Vec::new();
    let mut place = None;
    for (b, block) in blocks.iter().enumerate() {
        for (side, root) in [value.clone(), -&value].iter().enumerate() {
            if counts[b][side] > 0 {
                let sizes = longest_blocks(&number_field(vertex, block), block, root);
                if sizes.iter().sum::<usize>() != counts[b][side] {
                    return Err(open());
                }
                place = place.or(Some((b, None)));
                members.push(Member { frequency: block.frequency, negative: side == 1, blocks: sizes });
            }
        }
    }
    let Some(place) = place else { return Err(open()) };
    let enclosure = Interval::point(value.clone());
    let poly = vec![Poly::constant(-&value), Poly::constant(ratio(1, 1))];
    Ok(Top { rational: Some(value), enclosure, poly, angle: 1, members, others, place })
}

pub(super) fn evaluate<F: Field>(field: &F, poly: &[F::E], x: &F::E) -> F::E {
    poly.iter().rev().fold(field.zero(), |v, c| field.add(&field.mul(&v, x), c))
}

/// The field of `2 cos θ` of a block.
#[must_use]
pub fn number_field(vertex: &Vertex, block: &Block) -> NumberField {
    let root = twice_cosine(block.angle, vertex.valence);
    let twice_cosine = Elem::generator(root.minpoly());
    NumberField::new(Numbers::generated(&root).expect("cosines are real"), twice_cosine)
}

fn enclose(field: &NumberField, enclosures: &Enclosures, x: &Elem) -> Fixed {
    enclosures.interval(&field.enclosure(x, enclosures.bits))
}

/// The leading eigenvalue in a frequency; `None` where it is not the one of the block, or enclosures are too wide.
#[must_use]
pub fn leading_value(vertex: &Vertex, blocks: &[Block], top: &Top, frequency: usize, bits: u64) -> Option<Fixed> {
    let block = blocks.iter().find(|b| b.frequency == frequency)?;
    let enclosures = field_of(vertex, block, bits);
    if top.place.1.is_some() && blocks[top.place.0].frequency != frequency {
        return None;
    }
    match &top.rational {
        Some(q) => Some(enclosures.rational(q)),
        None => newton(&enclosures, &coefficients(&enclosures, &top.poly), &around(&top.enclosure.mid())),
    }
}

/// The eigenvector of the leading member of a frequency: of a simple eigenvalue its own, of a longer Jordan block the one
/// that ends its chain. `None` where the block has several, or where enclosures are too wide.
#[must_use]
pub fn leading_values(
    vertex: &Vertex,
    blocks: &[Block],
    top: &Top,
    frequency: usize,
    bits: u64,
) -> Option<Values<Fixed>> {
    let block = blocks.iter().find(|b| b.frequency == frequency)?;
    let enclosures = field_of(vertex, block, bits);
    let found = if let (_, Some(part)) = top.place {
        let value = leading_value(vertex, blocks, top, frequency, bits)?;
        eigenvector(&enclosures, block, part, &value)?
    } else {
        let field = number_field(vertex, block);
        let exact = leading_vector(&field, block, top.rational.as_ref()?)?;
        convert(&field, &enclosures, &exact)
    };
    if frequency == 0 || block.angle == frequency {
        return Some(found);
    }
    turned(vertex, &found, frequency, bits)
}

/// Numbers `x + y ω` with `ω = e^(2πi/n)` in the same form with `e^(2πik/n)`; of the frequency `n/2` they are real.
pub(super) fn turned(vertex: &Vertex, values: &Values<Fixed>, k: usize, bits: u64) -> Option<Values<Fixed>> {
    if 2 * k == vertex.valence {
        return Some(values.clone());
    }
    let one = Enclosures::of_angle(1, vertex.valence, bits);
    let (t, turned) = (one.twice_cosine(), Enclosures::of_angle(k, vertex.valence, bits).twice_cosine());
    // sin(kθ)/sin(θ) by U_0 = 1, U_1 = t, U_(j+1) = t U_j − U_(j−1).
    let (mut before, mut now) = (one.zero(), one.one());
    for _ in 1..k {
        (before, now) = (now.clone(), one.sub(&one.mul(&t, &now), &before));
    }
    // ω = a + b ω^k.
    let b = one.inv(&now)?;
    let a = one.scale(&one.sub(&t, &one.mul(&b, &turned)), &ratio(1, 2));
    let convert = |v: &Turning<Fixed>| Turning { x: one.add(&v.x, &one.mul(&a, &v.y)), y: one.mul(&b, &v.y) };
    Some(Values { centre: convert(&values.centre), orbits: values.orbits.iter().map(convert).collect() })
}

/// Exact values as enclosures.
pub(super) fn convert(field: &NumberField, enclosures: &Enclosures, exact: &Values<Elem>) -> Values<Fixed> {
    let one = |v: &Turning<Elem>| Turning { x: enclose(field, enclosures, &v.x), y: enclose(field, enclosures, &v.y) };
    Values { centre: one(&exact.centre), orbits: exact.orbits.iter().map(one).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_simplest_fraction() {
        for (p, q) in [(1, 4), (3, 8), (1, 2), (-5, 16), (17, 40)] {
            let near = ratio(p, q) + ratio(1, 10_000_019);
            assert_eq!(simplest_near(&near, &ratio(1, 1_000_000)), ratio(p, q));
        }
        assert_eq!(simplest_near(&ratio(1, 1000), &ratio(1, 500)), 0);
    }

    #[test]
    fn the_circle_test() {
        let f = Enclosures::of_angle(1, 4, 128);
        let p = |c: &[i64]| c.iter().map(|x| f.rational(&ratio(*x, 1))).collect::<Vec<_>>();
        // x² + 1 and (x − 1)(x − 2)(x + 3).
        assert!(all_below(&f, &p(&[1, 0, 1]), &ratio(101, 100)));
        assert!(!all_below(&f, &p(&[1, 0, 1]), &ratio(99, 100)));
        assert!(all_below(&f, &p(&[6, -7, 0, 1]), &ratio(31, 10)));
        assert!(!all_below(&f, &p(&[6, -7, 0, 1]), &ratio(29, 10)));
        assert!(!all_below(&f, &p(&[6, -7, 0, 1]), &ratio(3, 2)));
        // The last step decides about x − 2, alone and beside a root 0.
        for x_minus_2 in [p(&[-2, 1]), p(&[0, -2, 1])] {
            assert!(all_below(&f, &x_minus_2, &ratio(21, 10)) && !all_below(&f, &x_minus_2, &ratio(19, 10)));
        }
    }
}
