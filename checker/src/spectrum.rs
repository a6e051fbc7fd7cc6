//! Certificates of the kind `spectrum`: roots, Jordan blocks and equal moduli of rational matrices, without factorisation.

use crate::base::{
    Accepted, Checked, Field, MAX_PIECES, Matrix, Node, Q, Rejected, Verdict, bits, has_root_near, need, some, spend,
};
use crate::claim::Claim;
use crate::curve::{case, chain};
use crate::literal;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::rc::Rc;

/// The modulus of a determinant lies below this.
const MAX_MODULUS: usize = 1 << 31;

/// The discs of a matrix, each with one root of its factor: the centre (two numbers) and the error, over one denominator. Where
/// the centre is not real, a disc stands for its mirror image too.
struct Discs {
    rows: Matrix,
    factors: Vec<Rc<Matrix>>,
}

/// Whether a disc, moved by at most `slack` (over the denominator of the discs), misses another one and its mirror image.
fn misses(a: &[BigInt], b: &[BigInt], slack: &Q) -> bool {
    let far = (&a[2] + &b[2]) * slack.denom() + slack.numer();
    let x = (&a[0] - &b[0]) * slack.denom();
    [&a[1] - &b[1], &a[1] + &b[1]].into_iter().all(|y| {
        let y = y * slack.denom();
        &x * &x + &y * &y > &far * &far
    })
}

fn modulus_squared(disc: &[BigInt]) -> BigInt {
    &disc[0] * &disc[0] + &disc[1] * &disc[1]
}

/// Checks the proof of a certificate of the kind `spectrum` about the text of a case or of a matrix.
pub fn check(source: &str, node: &Node<'_>) -> Checked<Accepted> {
    let [spectra] = node.fields("spectra")?;
    let items = spectra.each(|item| item.fields::<4>("operator factors modulus classes"));
    let mut operators: Vec<(Matrix, Option<(usize, usize)>)> = Vec::new();
    let mut name = "matrix".to_owned();
    if items.as_ref().is_ok_and(|items| items.first().is_some_and(|[operator, ..]| operator.is_null())) {
        operators.push((literal::matrix(source)?, None));
    } else {
        let case = case::read(source, false).map_err(|r| Rejected { unreadable: false, ..r })?;
        for (e, state) in case.shape.states.into_iter().enumerate() {
            for (k, piece) in state.pieces.into_iter().enumerate().filter(|(_, p)| p.target == e) {
                operators.push((piece.op, Some((e, k))));
            }
        }
        name = case.name;
    }
    let items = items?;
    let all = items.len() == operators.len() && !items.is_empty();
    spectra.need(all, "spectrum", "one item for each operator is needed")?;
    let mut claims = Vec::new();
    for ([operator, factors, modulus, classes], (matrix, place)) in items.iter().zip(&operators) {
        let same = match place {
            None => operator.is_null(),
            Some(place) => {
                let [state, piece] = operator.fields("state piece")?;
                (state.index(case::MAX_STATES)?, piece.index(MAX_PIECES)?) == *place
            }
        };
        operator.need(same, "spectrum", "another operator is expected here")?;
        let (discs, found) = factors.at(roots_and_chains(matrix, factors, modulus))?;
        let sizes = classes.at(moduli(&discs, classes))?;
        let jordan = |(factor, blocks)| Claim::Jordan { operator: *place, factor, blocks }.is(Verdict::Proved);
        claims.extend(found.into_iter().map(jordan));
        claims.push(Claim::Moduli { operator: *place, sizes }.is(Verdict::Proved));
    }
    Ok(Accepted { case: name, verdict: Verdict::Proved, claims, points: Vec::new() })
}

/// Factors with the sizes of the Jordan blocks of their roots.
type Blocks = Vec<(Vec<Q>, Vec<usize>)>;

/// Rules `roots` and `chains`: discs that hold one root each of the factors, and a Jordan basis over `Q[x]/(factor)`.
fn roots_and_chains(matrix: &Matrix, node: &Node<'_>, modulus: &Node<'_>) -> Checked<(Discs, Blocks)> {
    let (mut numbers, mut factors, mut found) = (Vec::new(), Vec::new(), Vec::new());
    let mut basis = Matrix::empty(matrix.rows);
    for item in node.list()? {
        let [polynomial, roots, chains] = item.fields("polynomial roots chains")?;
        let p = Field::monic(&polynomial, matrix.rows)?;
        let factor = Rc::new(Matrix::new(1, p.len(), &p));
        let mut counted = 0;
        for root in roots.list()? {
            let [centre, error] = root.fields("centre error")?;
            let (c, e) = (centre.vector(2)?, error.rational()?);
            let placed = !e.is_negative() && (c[1].is_zero() || c[1] > e);
            root.need(placed, "roots", "a disc is centred on the real axis or lies above it")?;
            root.need(has_root_near(&factor, &c, &e)?, "roots", "no root is seen to lie in this disc")?;
            counted += if c[1].is_zero() { 1 } else { 2 };
            numbers.extend(c.into_iter().chain([e]));
            factors.push(Rc::clone(&factor));
        }
        roots.need(counted == p.len() - 1, "roots", "the discs must be as many as the degree")?;
        let field = Field::of(Field::companion(&p), [Q::zero(), Q::zero()]);
        let mut blocks: Vec<usize> = Vec::new();
        for item in chains.list()? {
            let vectors = chain(&item, matrix, &field, 1, "chains")?;
            let coefficients = vectors.len() * (p.len() - 1);
            item.need(basis.rows + coefficients <= matrix.rows, "chains", "there are more vectors than dimensions")?;
            basis = vectors.iter().fold(basis, |all, v| all.stack(&v.transpose()));
            blocks.push(vectors.len());
        }
        let descend = !blocks.is_empty() && blocks.windows(2).all(|w| w[0] >= w[1]);
        chains.need(descend, "chains", "there are chains, and the longest come first")?;
        found.push((p, blocks));
    }
    let discs = Discs { rows: Matrix::new(factors.len(), 3, &numbers), factors };
    for k in 0..discs.factors.len() {
        spend(8 * k, discs.rows.bits())?;
        let apart = (0..k).all(|j| misses(discs.rows.integers(k), discs.rows.integers(j), &Q::zero()));
        need(apart, "roots", "two discs meet")?;
    }
    let why = format_args!("the chains have {} vectors, the matrix has size {}", basis.rows, matrix.rows);
    node.need(basis.rows == matrix.rows, "chains", why)?;
    let independent = invertible(&basis, modulus)?;
    modulus.need(independent, "chains", "the vectors are not seen to be independent for this modulus")?;
    Ok((discs, found))
}

/// Whether the determinant is a unit modulo a number: elimination finds invertible pivots. The number need not be prime.
fn invertible(basis: &Matrix, modulus: &Node<'_>) -> Checked<bool> {
    let (n, p) = (basis.rows, modulus.index(MAX_MODULUS)? as u64);
    if p < 2 {
        return Ok(false);
    }
    spend(n * n * n, 64)?;
    let residue = |x: &BigInt| ((x % p + p) % p).to_u64();
    let rows = (0..n).map(|i| basis.integers(i).iter().map(residue).collect()).collect::<Option<Vec<Vec<u64>>>>();
    let mut rows = some(rows, "chains", "an entry has no residue")?;
    for j in 0..n {
        let Some((i, inverse)) = (j..n).find_map(|i| Some((i, inverse(rows[i][j], p)?))) else { return Ok(false) };
        rows.swap(i, j);
        let pivot = rows[j].clone();
        for row in rows.iter_mut().skip(j + 1).filter(|row| row[j] != 0) {
            let factor = row[j] * inverse % p;
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x = (*x + (p - factor) * y) % p);
        }
    }
    Ok(true)
}

/// The inverse of `a` modulo `p < 2^31`, if there is one.
fn inverse(a: u64, p: u64) -> Option<u64> {
    let found = (a as i64).extended_gcd(&(p as i64));
    (found.gcd == 1).then(|| found.x.rem_euclid(p as i64) as u64)
}

/// Rule `moduli`: classes of equal modulus, the largest first, with radii that separate them.
fn moduli(discs: &Discs, node: &Node<'_>) -> Checked<Vec<usize>> {
    let (mut listed, mut sizes) = (vec![false; discs.factors.len()], Vec::new());
    let mut above: Option<Q> = None;
    let items = node.list()?;
    for (k, item) in items.iter().enumerate() {
        let [members, square, below] = item.fields("members square below")?;
        let chosen = members.indices(listed.len())?;
        members.need(!chosen.is_empty(), "moduli", "a class is not empty")?;
        for &m in &chosen {
            members.need(!std::mem::replace(&mut listed[m], true), "moduli", "a root stands in two classes")?;
        }
        let below = if k + 1 == items.len() && below.is_null() { None } else { Some(below.rational()?) };
        for &m in &chosen {
            // Nothing bounds the first class from above, or the last one from below.
            let side = |radius: &Option<Q>, side| match radius {
                Some(radius) => discs.beyond(m, radius, side),
                None => Ok(true),
            };
            let (inside, outside) = (side(&above, -1)?, side(&below, 1)?);
            item.need(inside && outside, "moduli", "the radii do not separate the classes")?;
        }
        let square = if square.is_null() { None } else { Some(square.rational()?) };
        // The first member has the modulus of the class, which where no square is given is its own.
        for &m in &chosen[usize::from(square.is_none())..] {
            let equal = match &square {
                None => discs.opposite(chosen[0], m)?,
                Some(s) => discs.inverted(m, s)?,
            };
            item.need(equal, "moduli", "the roots of a class are not seen to have one modulus")?;
        }
        sizes.push(chosen.iter().map(|&m| if discs.rows.integers(m)[1].is_zero() { 1 } else { 2 }).sum::<usize>());
        above = below;
    }
    let all = !listed.is_empty() && listed.iter().all(|l| *l);
    node.need(all, "moduli", "a root stands in no class")?;
    Ok(sizes)
}

impl Discs {
    /// Whether the modulus of the root of disc `m` lies above the radius (`side = 1`) or below it (`side = -1`).
    fn beyond(&self, m: usize, radius: &Q, side: i64) -> Checked<bool> {
        spend(16, self.rows.bits() + bits(radius))?;
        let disc = self.rows.integers(m);
        let r = radius.numer() * &self.rows.den + &disc[2] * radius.denom() * side;
        let modulus = modulus_squared(disc) * radius.denom() * radius.denom();
        let positive = !radius.is_negative() && !r.is_negative();
        Ok(positive && if side > 0 { modulus > &r * &r } else { modulus < &r * &r })
    }

    /// Whether the root of disc `b` is minus that of disc `a`, or minus its mirror image: the factor of `b` is `±p(−x)`, and
    /// of its discs only `b` meets the reflected disc.
    fn opposite(&self, a: usize, b: usize) -> Checked<bool> {
        let (p, q) = (&self.factors[a], &self.factors[b]);
        let sign = |k: usize| if (p.cols - 1 - k).is_multiple_of(2) { 1 } else { -1 };
        let reflected = p.cols == q.cols && (0..p.cols).all(|k| &q.data[k] * &p.den == &p.data[k] * &q.den * sign(k));
        let mut mirror = self.rows.integers(a).to_vec();
        mirror[0] = -&mirror[0];
        Ok(reflected && self.others_miss(&mirror, b, &Q::zero())?)
    }

    /// Whether the other discs of the factor of disc `m` miss a disc that may move by at most `slack`.
    fn others_miss(&self, disc: &[BigInt], m: usize, slack: &Q) -> Checked<bool> {
        spend(8 * self.factors.len(), self.rows.bits() + bits(slack))?;
        let mut others = (0..self.factors.len()).filter(|&k| k != m && Rc::ptr_eq(&self.factors[k], &self.factors[m]));
        Ok(others.all(|k| misses(disc, self.rows.integers(k), slack)))
    }

    /// Whether the root `λ` of disc `m` has `|λ|² = s`: the roots of its factor are closed under `λ -> s/λ`, and `s/conj(λ)`,
    /// which is the multiple `s/|λ|²` of `λ`, is nearer to `λ` than the other roots.
    fn inverted(&self, m: usize, s: &Q) -> Checked<bool> {
        let (disc, den, p) = (self.rows.integers(m), &self.rows.den, &self.factors[m]);
        let d = p.cols - 1;
        spend(4 * p.cols, p.bits() + bits(s) * d as u64)?;
        // a_(d-j) s^(d-j) = a_0 a_j for all j.
        let (mut n, mut q, mut closed) = (BigInt::one(), BigInt::one(), s.is_positive());
        for k in 0..=d {
            closed &= &p.data[k] * &n * &p.den == &p.data[0] * &p.data[d - k] * &q;
            n *= s.numer();
            q *= s.denom();
        }
        let (x, y, e) = (disc[0].abs(), disc[1].abs(), &disc[2]);
        let least = x.clone().max(y.clone()) - e;
        if !closed || !least.is_positive() {
            return Ok(false);
        }
        // | s - |c|^2 | + 2 (|x| + |y|) e + e^2 over the least modulus.
        let apart = s.numer() * den * den - modulus_squared(disc) * s.denom();
        let moved = apart.abs() + ((x + y) * e * 2 + e * e) * s.denom();
        self.others_miss(disc, m, &Q::new_raw(moved, least * s.denom()))
    }
}
