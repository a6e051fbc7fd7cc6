//! Certificates of the kind `spectrum`: roots, Jordan blocks and equal moduli of rational matrices, without factorisation.

use crate::case;
use crate::json::Node;
use crate::matrix::Matrix;
use crate::number::{Q, decimal_fraction, spend, whole};
use crate::poly::{Field, Interval, complex_values};
use crate::{Accepted, Rejected, Verdict, at, need, reject};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::rc::Rc;

/// Largest matrix of a file.
const MAX_SIZE: usize = 256;
/// The modulus of a determinant lies below this.
const MAX_MODULUS: usize = 1 << 31;

/// A disc with one root; where its centre is not real, it stands for its mirror image too.
struct Disc {
    factor: Rc<Vec<Q>>,
    centre: (Q, Q),
    error: Q,
}

impl Disc {
    fn is_real(&self) -> bool {
        self.centre.1.is_zero()
    }

    fn modulus_squared(&self) -> Q {
        &self.centre.0 * &self.centre.0 + &self.centre.1 * &self.centre.1
    }

    /// Whether the disc, moved by at most `slack`, misses another one and its mirror image.
    fn misses(&self, other: &Self, slack: &Q) -> bool {
        let (x, far) = (&self.centre.0 - &other.centre.0, &self.error + &other.error + slack);
        [-Q::one(), Q::one()].iter().all(|s| {
            let y = &self.centre.1 + s * &other.centre.1;
            &x * &x + &y * &y > &far * &far
        })
    }
}

/// Reads `n` and then `n` rows of numbers; `#` starts a comment.
fn plain(source: &str) -> Result<Matrix, Rejected> {
    let words = source.lines().flat_map(|line| line.split('#').next().unwrap_or("").split_ascii_whitespace());
    let mut words = words.map(decimal_fraction);
    let size = words.next().flatten().and_then(|n| if n.is_integer() { n.numer().to_usize() } else { None });
    let Some(n) = size.filter(|n| (1..=MAX_SIZE).contains(n)) else {
        return reject("matrix", "", "the size of a matrix is needed first");
    };
    match words.collect::<Option<Vec<Q>>>() {
        Some(entries) if entries.len() == n * n => Ok(Matrix::new(n, n, &entries)),
        _ => reject("matrix", "", "n rows of n exact numbers are needed after the size"),
    }
}

/// Checks the proof of a certificate of the kind `spectrum` about the text of a case or of a matrix.
pub fn check(source: &str, node: &Node<'_>) -> Result<Accepted, Rejected> {
    let [spectra] = node.fields(["spectra"])?;
    let items = spectra.list()?;
    let mut operators: Vec<(String, Matrix, Option<(usize, usize)>)> = Vec::new();
    let mut name = "matrix".to_owned();
    match items.first().map(|item| item.fields(["operator", "factors", "modulus", "classes"])) {
        Some(Ok([operator, ..])) if operator.is_null() => operators.push((name.clone(), plain(source)?, None)),
        _ => {
            let case = case::read(source).or_else(|why| reject("case", "", why))?;
            for (e, state) in case.shape.states.into_iter().enumerate() {
                for (k, piece) in state.pieces.into_iter().enumerate().filter(|(_, p)| p.target == e) {
                    operators.push((format!("operator {k} of state {e}"), piece.op, Some((e, k))));
                }
            }
            name = case.name;
        }
    }
    spectra.need(
        items.len() == operators.len() && !items.is_empty(),
        "spectrum",
        "one item for each operator is needed",
    )?;
    let mut claims = Vec::new();
    for (item, (of, matrix, place)) in items.iter().zip(&operators) {
        let [operator, factors, modulus, classes] = item.fields(["operator", "factors", "modulus", "classes"])?;
        if let Some((e, k)) = place {
            let [state, piece] = operator.fields(["state", "piece"])?;
            let same = (state.index(case::MAX_STATES)?, piece.index(case::MAX_PIECES)?) == (*e, *k);
            operator.need(same, "spectrum", &format!("{of} is expected here"))?;
        } else {
            operator.need(operator.is_null(), "spectrum", "a file has one matrix")?;
        }
        let (discs, lines) = at(&factors.place, roots_and_chains(matrix, &factors, &modulus))?;
        claims.extend(lines.into_iter().map(|line| format!("{of}: {line}")));
        let line = at(&classes.place, moduli(&discs, &classes))?;
        claims.push(format!("{of}: {line}"));
    }
    Ok(Accepted { case: name, verdict: Verdict::Proved, claims, points: Vec::new() })
}

/// Rules `roots` and `chains`: discs that hold one root each of the factors, and a Jordan basis over `Q[x]/(factor)`.
fn roots_and_chains(
    matrix: &Matrix,
    node: &Node<'_>,
    modulus: &Node<'_>,
) -> Result<(Vec<Disc>, Vec<String>), Rejected> {
    let (mut discs, mut basis, mut lines): (Vec<Disc>, _, _) = (Vec::new(), Matrix::empty(matrix.rows), Vec::new());
    for item in node.list()? {
        let [polynomial, roots, chains] = item.fields(["polynomial", "roots", "chains"])?;
        let p = polynomial.list()?.iter().map(Node::rational).collect::<Result<Vec<Q>, _>>()?;
        let monic = (2..=matrix.rows + 1).contains(&p.len()) && p[p.len() - 1].is_one();
        polynomial.need(monic, "roots", "a monic polynomial of degree at least 1 is needed")?;
        let (before, p) = (discs.len(), Rc::new(p));
        for root in roots.list()? {
            discs.push(disc(&p, &root)?);
        }
        let counted: usize = discs[before..].iter().map(|d| if d.is_real() { 1 } else { 2 }).sum();
        roots.need(counted == p.len() - 1, "roots", "the discs must be as many as the degree")?;
        let by_root = Field::companion(&p);
        let mut blocks: Vec<usize> = Vec::new();
        for chain in chains.list()? {
            let mut vectors: Vec<Matrix> = Vec::new();
            for item in chain.list()? {
                let v = Field::coordinates(p.len() - 1, &item, matrix.rows)?;
                let rest = matrix.times(&v)?.minus(&v.times(&by_root)?);
                let continues = vectors.last().map_or(rest.is_zero(), |before| rest == *before);
                item.need(continues, "chains", "the vector does not continue the Jordan chain")?;
                basis = basis.stack(&v.transpose());
                vectors.push(v);
            }
            blocks.push(vectors.len());
        }
        let descend = blocks.windows(2).all(|w| w[0] >= w[1]) && blocks.last().is_some_and(|b| *b > 0);
        chains.need(descend, "chains", "chains are not empty, and the longest come first")?;
        lines.push(format!("each root of {} has Jordan blocks of the sizes {blocks:?}", text(&p)));
    }
    for (k, a) in discs.iter().enumerate() {
        spend(discs.len(), discs.iter().map(|d| crate::number::bits(&d.centre.0)).max().unwrap_or(0))?;
        need(discs[..k].iter().all(|b| a.misses(b, &Q::zero())), "roots", "two discs meet")?;
    }
    let square = basis.rows == matrix.rows;
    node.need(
        square,
        "chains",
        &format!("the chains have {} vectors, the matrix has size {}", basis.rows, matrix.rows),
    )?;
    modulus.need(
        invertible(&basis, modulus)?,
        "chains",
        "the vectors are not seen to be independent for this modulus",
    )?;
    Ok((discs, lines))
}

fn text(p: &[Q]) -> String {
    let terms = p.iter().enumerate().rev().filter(|(_, c)| !c.is_zero()).map(|(k, c)| format!("({c}) x^{k}"));
    terms.collect::<Vec<_>>().join(" + ")
}

/// A disc that holds a root: `p` of degree `n` has one within `n |p(c)/p'(c)|` of `c`.
fn disc(p: &Rc<Vec<Q>>, node: &Node<'_>) -> Result<Disc, Rejected> {
    let [centre, error] = node.fields(["centre", "error"])?;
    let (c, e) = (centre.vector(2)?, error.rational()?);
    let placed = !e.is_negative() && (c[1].is_zero() || c[1] > e);
    node.need(placed, "roots", "a disc is centred on the real axis or lies above it")?;
    let derivative: Vec<Q> = p.iter().enumerate().skip(1).map(|(k, a)| a * whole(k as i64)).collect();
    let point = (Interval::point(&c[0]), Interval::point(&c[1]));
    let square = |p: &[Q]| complex_values(p, &point).map(|(re, im)| &re.lo * &re.lo + &im.lo * &im.lo);
    let (n, slope) = (whole(p.len() as i64 - 1), square(&derivative)?);
    let near = !slope.is_zero() && &n * &n * square(p)? <= &e * &e * slope;
    node.need(near, "roots", "no root is seen to lie in this disc")?;
    Ok(Disc { factor: Rc::clone(p), centre: (c[0].clone(), c[1].clone()), error: e })
}

/// Whether the determinant is a unit modulo a number: elimination finds invertible pivots. The number need not be prime.
fn invertible(basis: &Matrix, modulus: &Node<'_>) -> Result<bool, Rejected> {
    let (n, p) = (basis.rows, modulus.index(MAX_MODULUS)? as u64);
    if p < 2 {
        return Ok(false);
    }
    spend(n * n * n, 64)?;
    let residue = |x: &BigInt| ((x % p + p) % p).to_u64().unwrap_or(0);
    let mut rows: Vec<Vec<u64>> = (0..n).map(|i| basis.integers(i).iter().map(residue).collect()).collect();
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
    let (mut r, mut s) = ((p as i64, a as i64), (0, 1));
    while r.1 != 0 {
        let q = r.0 / r.1;
        (r, s) = ((r.1, r.0 - q * r.1), (s.1, s.0 - q * s.1));
    }
    (r.0 == 1).then(|| s.0.rem_euclid(p as i64) as u64)
}

/// Rule `moduli`: classes of equal modulus, the largest first, with radii that separate them.
fn moduli(discs: &[Disc], node: &Node<'_>) -> Result<String, Rejected> {
    let (mut listed, mut sizes) = (vec![false; discs.len()], Vec::new());
    let mut above: Option<Q> = None;
    let items = node.list()?;
    for (k, item) in items.iter().enumerate() {
        let [members, square, below] = item.fields(["members", "square", "below"])?;
        let chosen = members.list()?.iter().map(|m| m.index(discs.len())).collect::<Result<Vec<_>, _>>()?;
        members.need(!chosen.is_empty(), "moduli", "a class is not empty")?;
        for &m in &chosen {
            members.need(!std::mem::replace(&mut listed[m], true), "moduli", "a root stands in two classes")?;
        }
        let below = if k + 1 == items.len() && below.is_null() { None } else { Some(below.rational()?) };
        for disc in chosen.iter().map(|&m| &discs[m]) {
            let (r, e) = (disc.modulus_squared(), &disc.error);
            let inside = above.as_ref().is_none_or(|a| a > e && r < (a - e) * (a - e));
            let outside = below.as_ref().is_none_or(|b| !b.is_negative() && r > (b + e) * (b + e));
            item.need(inside && outside, "moduli", "the radii do not separate the classes")?;
        }
        let equal = if square.is_null() {
            chosen[1..].iter().all(|&m| opposite(discs, chosen[0], m))
        } else {
            let s = square.rational()?;
            chosen.iter().all(|&m| inverted(discs, m, &s))
        };
        item.need(equal, "moduli", "the roots of a class are not seen to have one modulus")?;
        sizes.push(chosen.iter().map(|&m| if discs[m].is_real() { 1 } else { 2 }).sum::<usize>());
        above = below;
    }
    node.need(listed.iter().all(|l| *l), "moduli", "a root stands in no class")?;
    Ok(format!("different eigenvalues by modulus, the largest first: {sizes:?}"))
}

/// Whether the root of disc `b` is minus that of disc `a`, or minus its mirror image: the factor of `b` is `±p(−x)`, and of
/// its discs only `b` meets the reflected disc.
fn opposite(discs: &[Disc], a: usize, b: usize) -> bool {
    let (p, q) = (&discs[a].factor, &discs[b].factor);
    let sign = |k: usize| if (p.len() - 1 - k).is_multiple_of(2) { Q::one() } else { -Q::one() };
    let reflected = p.len() == q.len() && (0..p.len()).all(|k| q[k] == &p[k] * sign(k));
    let (x, y) = &discs[a].centre;
    let mirror = Disc { factor: Rc::clone(q), centre: (-x, y.clone()), error: discs[a].error.clone() };
    reflected && others(discs, b).all(|d| mirror.misses(d, &Q::zero()))
}

/// The other discs of the same factor.
fn others(discs: &[Disc], m: usize) -> impl Iterator<Item = &Disc> {
    let same = move |(k, d): &(usize, &Disc)| *k != m && Rc::ptr_eq(&d.factor, &discs[m].factor);
    discs.iter().enumerate().filter(same).map(|(_, d)| d)
}

/// Whether the root `λ` of disc `m` has `|λ|² = s`: the roots of its factor are closed under `λ -> s/λ`, and `s/conj(λ)`, which
/// is the multiple `s/|λ|²` of `λ`, is nearer to `λ` than the other roots.
fn inverted(discs: &[Disc], m: usize, s: &Q) -> bool {
    let (p, disc) = (&discs[m].factor, &discs[m]);
    let d = p.len() - 1;
    let closed = s.is_positive() && (0..=d).all(|j| &p[d - j] * num_traits::pow(s.clone(), d - j) == &p[0] * &p[j]);
    let (x, y, e) = (disc.centre.0.abs(), disc.centre.1.abs(), &disc.error);
    let least = (if x > y { x.clone() } else { y.clone() }) - e;
    if !closed || !least.is_positive() {
        return false;
    }
    let moved = ((s - disc.modulus_squared()).abs() + (x + y) * e * whole(2) + e * e) / least;
    others(discs, m).all(|d| disc.misses(d, &moved))
}
