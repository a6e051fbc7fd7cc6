//! Bounds of a joint spectral radius: a disc that holds an eigenvalue of a product, and a norm for every diagonal block.

use crate::case::matrix_list;
use crate::json::Node;
use crate::matrix::Matrix;
use crate::number::{Q, bits, spend};
use crate::poly::has_root_near;
use crate::{Accepted, Rejected, Verdict, at, reject};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Matrices `dim(from) x dim(to)` between the spaces of states.
pub struct System {
    /// The name of the file.
    pub name: String,
    /// The dimension of the space of every state.
    pub dims: Vec<usize>,
    /// The arrows: from, to, matrix.
    pub arrows: Vec<(usize, usize, Matrix)>,
}

/// Checks the proof of a certificate of the kind `jsr`.
pub fn check(text: &str, node: &Node<'_>) -> Result<Accepted, Rejected> {
    let system = matrix_list(text)?;
    let found = bounds(&system, node)?;
    let text = if found.lower == found.upper {
        format!("proved: the joint spectral radius is {}", found.lower)
    } else {
        format!("proved: the joint spectral radius is at least {} and at most {}", found.lower, found.upper)
    };
    Ok(Accepted { case: system.name, verdict: Verdict::Proved, claims: vec![text], points: found.blocks })
}

/// What is proved of a radius.
pub struct Bounds {
    /// It is at least this.
    pub lower: Q,
    /// It is at most this.
    pub upper: Q,
    /// One line for each block.
    pub blocks: Vec<String>,
}

/// Checks `{"lower", "upper", "bases", "blocks"}` for a system.
pub fn bounds(system: &System, node: &Node<'_>) -> Result<Bounds, Rejected> {
    let [lower, upper, bases, blocks] = node.fields(["lower", "upper", "bases", "blocks"])?;
    let lo = if lower.is_null() { Q::zero() } else { at(&lower.place, below(system, &lower))? };
    let hi = upper.rational()?;
    let frames = at(&bases.place, read_bases(system, &bases))?;
    let (mut lines, mut used) = (Vec::new(), vec![0_usize; system.dims.len()]);
    let mut conjugated = Vec::new();
    for (from, to, m) in &system.arrows {
        conjugated.push(frames[*from].1.times(&m.times(&frames[*to].0)?)?);
    }
    for item in blocks.list()? {
        let [dims, bound, norm] = item.fields(["dims", "bound", "norm"])?;
        let dims = dims.list()?.iter().map(|n| n.index(usize::MAX)).collect::<Result<Vec<_>, _>>()?;
        let bound = bound.rational()?;
        if dims.len() != used.len() || bound.is_negative() || bound > hi {
            return reject(
                "block",
                &item.place,
                "one size for each state, and a bound up to the upper one, are needed",
            );
        }
        let start = used.clone();
        used.iter_mut().zip(&dims).for_each(|(u, d)| *u = (*u).saturating_add(*d));
        if used.iter().zip(&system.dims).any(|(u, d)| u > d) {
            return reject("block", &item.place, "the blocks have more dimensions than the spaces");
        }
        // Nothing of the images of this block and those before lies after it.
        for ((from, to, _), m) in system.arrows.iter().zip(&conjugated) {
            let entry = |i: usize, j: usize| &m.data[i * m.cols + j];
            if (used[*from]..m.rows).any(|i| (start[*to]..used[*to]).any(|j| !entry(i, j).is_zero())) {
                return reject("block", &item.place, "the matrices are not block upper triangular in these bases");
            }
        }
        let part = |(k, (from, to, _)): (usize, &(usize, usize, Matrix))| {
            let all = |start: usize, size: usize| (start..start + size).collect::<Vec<_>>();
            let cols = conjugated[k].columns(&all(start[*to], dims[*to])).transpose();
            (*from, *to, cols.columns(&all(start[*from], dims[*from])).transpose())
        };
        let arrows: Vec<_> = system.arrows.iter().enumerate().map(part).collect();
        lines.push(at(&norm.place, Block { dims, arrows }.check(&norm, &bound))?);
    }
    if used != system.dims {
        return reject("block", &blocks.place, "the blocks do not fill the spaces");
    }
    if lo > hi {
        return reject("block", &upper.place, "the bounds contradict each other");
    }
    Ok(Bounds { lower: lo, upper: hi, blocks: lines })
}

/// A basis of every state (columns) and its inverse.
fn read_bases(system: &System, node: &Node<'_>) -> Result<Vec<(Matrix, Matrix)>, Rejected> {
    let items = node.list()?;
    if items.len() != system.dims.len() {
        return node.malformed("one basis for each state is needed here");
    }
    let mut bases = Vec::new();
    for (item, &dim) in items.iter().zip(&system.dims) {
        let vectors = item.list()?.iter().map(|v| v.vector(dim)).collect::<Result<Vec<_>, _>>()?;
        if vectors.len() != dim {
            return item.malformed(&format!("{dim} vectors are needed here"));
        }
        let basis = Matrix::from_rows(dim, &vectors).transpose();
        let (solved, pivots) = basis.transpose().stack(&Matrix::identity(dim)).transpose().echelon()?;
        if pivots != (0..dim).collect::<Vec<_>>() {
            return reject("block", &item.place, "the vectors are no basis");
        }
        bases.push((basis, solved.columns(&(dim..2 * dim).collect::<Vec<_>>())));
    }
    Ok(bases)
}

/// A closed path and a disc around `z` in which its product has an eigenvalue, because `n |χ(z)| <= error |χ'(z)|`; the modulus is
/// at least `|z| − error >= bound^length`.
fn below(system: &System, node: &Node<'_>) -> Result<Q, Rejected> {
    let [word, centre, error, bound] = node.fields(["word", "centre", "error", "bound"])?;
    let word = word.list()?.iter().map(|n| n.index(system.arrows.len())).collect::<Result<Vec<_>, _>>()?;
    let (centre, e, bound) = (centre.vector(2)?, error.rational()?, bound.rational()?);
    let Some((first, rest)) = word.split_first() else { return reject("word", &node.place, "the word is empty") };
    if word.len() > crate::MAX_LETTERS || e.is_negative() || bound.is_negative() {
        return reject("word", &node.place, "a word of at most 1000 letters, and numbers from 0 on, are needed");
    }
    let (mut product, mut end) = (system.arrows[*first].2.clone(), system.arrows[*first].1);
    for &a in rest {
        if system.arrows[a].0 != end {
            return reject("word", &node.place, "the arrows form no path");
        }
        product = product.times(&system.arrows[a].2)?;
        end = system.arrows[a].1;
    }
    if end != system.arrows[*first].0 {
        return reject("word", &node.place, "the path is not closed");
    }
    if !has_root_near(&product.characteristic()?, &centre, &e)? {
        return reject("word", &error.place, "no eigenvalue is seen in this disc");
    }
    let reach = power(&bound, word.len())? + &e;
    if &reach * &reach > &centre[0] * &centre[0] + &centre[1] * &centre[1] {
        return reject("word", &node.place, "the bound is above the eigenvalue");
    }
    Ok(bound)
}

/// The largest size of the numbers.
fn largest<'a>(numbers: impl IntoIterator<Item = &'a Q>) -> u64 {
    numbers.into_iter().map(bits).max().unwrap_or(0)
}

fn power(x: &Q, exponent: usize) -> Result<Q, Rejected> {
    spend(exponent, bits(x).saturating_mul(exponent as u64))?;
    Ok(num_traits::pow(x.clone(), exponent))
}

/// An upper bound of a square root, about `2^-100` above it.
fn root_above(x: &Q) -> Result<Q, Rejected> {
    spend(16, bits(x) + 256)?;
    let scale = BigInt::one() << 100u32;
    let scaled = (x * Q::from_integer(&scale * &scale)).ceil().to_integer();
    Ok(Q::new(scaled.sqrt() + BigInt::one(), scale))
}

/// A diagonal block: the matrices of all arrows between its parts of the states.
struct Block {
    dims: Vec<usize>,
    arrows: Vec<(usize, usize, Matrix)>,
}

/// A point in a state; real points have imaginary parts 0.
struct Point {
    state: usize,
    re: Vec<Q>,
    im: Vec<Q>,
}

/// Coefficients of points: index, real part, imaginary part.
type Terms = Vec<(usize, Q, Q)>;

impl Block {
    /// Checks that the norm shows that products of `k` matrices are at most a constant times `bound^k`; says so.
    fn check(&self, node: &Node<'_>, bound: &Q) -> Result<String, Rejected> {
        let kind = node.tag("norm")?;
        match kind {
            "zero" => {
                node.fields(["norm"])?;
                if self.arrows.iter().any(|a| !a.2.is_zero()) {
                    return reject("zero", &node.place, "a matrix of the block is not 0");
                }
            }
            "symmetric" | "monotone" | "balanced" => self.polytope(node, kind, bound)?,
            "quadratic" => self.quadratic(node, bound)?,
            "tree" => self.tree(node, bound)?,
            _ => return node.malformed("unknown kind of norm"),
        }
        Ok(format!("block of dimensions {:?}: {kind}, at most {bound}", self.dims))
    }

    fn terms(&self, node: &Node<'_>, complex: bool, points: &[Point], state: usize) -> Result<Terms, Rejected> {
        let mut terms = Vec::new();
        for item in node.list()? {
            let parts = item.list()?;
            let (k, re, im) = match (&parts[..], complex) {
                ([k, re], false) => (k, re.rational()?, Q::zero()),
                ([k, re, im], true) => (k, re.rational()?, im.rational()?),
                _ => return item.malformed("an index and a coefficient are needed here"),
            };
            let k = k.index(points.len())?;
            if points[k].state != state {
                return reject("inclusion", &item.place, "a point of another state");
            }
            terms.push((k, re, im));
        }
        Ok(terms)
    }

    /// `Σ |c|`, rounded upwards.
    fn total(terms: &Terms) -> Result<Q, Rejected> {
        terms.iter().try_fold(Q::zero(), |s, (_, re, im)| {
            Ok(s + if im.is_zero() { re.abs() } else { root_above(&(re * re + im * im))? })
        })
    }

    /// `x − Σ c q`, real and imaginary parts.
    fn rest(x: (Vec<Q>, Vec<Q>), terms: &Terms, points: &[Point]) -> Result<(Vec<Q>, Vec<Q>), Rejected> {
        let (mut re, mut im) = x;
        for (k, a, b) in terms {
            let q = &points[*k];
            spend(4 * re.len(), largest(&q.re).max(largest(&re)) + bits(a))?;
            for i in 0..re.len() {
                re[i] -= a * &q.re[i] - b * &q.im[i];
                im[i] -= a * &q.im[i] + b * &q.re[i];
            }
        }
        Ok((re, im))
    }

    /// `T Q ⊂ bound Q` for the hull `Q` of points: `{Σ c q : Σ|c| <= 1}` for real or complex `c`, or what lies below such a
    /// combination with `c >= 0` (everything being nonnegative).
    fn polytope(&self, node: &Node<'_>, kind: &str, bound: &Q) -> Result<(), Rejected> {
        let [_, points, inclusions, axes] = node.fields(["norm", "points", "inclusions", "axes"])?;
        let complex = kind == "balanced";
        let mut read = Vec::new();
        for item in points.list()? {
            let [state, coordinates] = item.fields(["state", "coordinates"])?;
            let state = state.index(self.dims.len())?;
            let items = coordinates.list()?;
            if items.len() != self.dims[state] {
                return coordinates.malformed("another number of coordinates is needed here");
            }
            let (mut re, mut im) = (Vec::new(), Vec::new());
            for x in items {
                if complex {
                    let z = x.vector(2)?;
                    re.push(z[0].clone());
                    im.push(z[1].clone());
                } else {
                    re.push(x.rational()?);
                    im.push(Q::zero());
                }
            }
            read.push(Point { state, re, im });
        }
        let interior = if kind == "monotone" {
            self.positive(&read, points.place.as_str())?;
            vec![Q::zero(); self.dims.len()]
        } else {
            self.interiors(&axes, complex, &read)?
        };
        let mut open: Vec<(usize, usize)> = Vec::new();
        for (k, p) in read.iter().enumerate() {
            let arrows = (0..self.arrows.len()).filter(|&a| self.arrows[a].1 == p.state && !self.arrows[a].2.is_zero());
            open.extend(arrows.map(|a| (k, a)));
        }
        for item in inclusions.list()? {
            let [point, arrow, terms] = item.fields(["point", "arrow", "terms"])?;
            let (k, a) = (point.index(read.len())?, arrow.index(self.arrows.len())?);
            let (from, to, matrix) = &self.arrows[a];
            if *to != read[k].state {
                return reject("inclusion", &item.place, "the arrow does not end in the state of the point");
            }
            let terms = self.terms(&terms, complex, &read, *from)?;
            let image = |x: &[Q]| Ok(matrix.times(&Matrix::new(x.len(), 1, x))?.entries());
            let image = (image(&read[k].re)?, image(&read[k].im)?);
            let (re, im) = Self::rest(image, &terms, &read)?;
            let mut total = Self::total(&terms)?;
            if kind == "monotone" {
                if re.iter().any(Signed::is_positive) || terms.iter().any(|t| t.1.is_negative()) {
                    return reject("inclusion", &item.place, "the image does not lie below the combination");
                }
            } else {
                total += &interior[*from] * re.iter().chain(&im).map(Signed::abs).sum::<Q>();
            }
            if total > *bound {
                return reject("inclusion", &item.place, "the image lies outside the multiple of the polytope");
            }
            open.retain(|o| *o != (k, a));
        }
        match open.first() {
            None => Ok(()),
            Some((k, a)) => {
                reject("inclusion", &inclusions.place, format!("the image of point {k} under arrow {a} is missing"))
            }
        }
    }

    /// All matrices and points are nonnegative, and every coordinate of every state is positive at some point.
    fn positive(&self, points: &[Point], place: &str) -> Result<(), Rejected> {
        let reached = |s: usize, i: usize| points.iter().any(|p| p.state == s && p.re[i].is_positive());
        if points.iter().flat_map(|p| &p.re).any(Signed::is_negative)
            || self.arrows.iter().flat_map(|a| &a.2.data).any(Signed::is_negative)
            || !self.dims.iter().enumerate().all(|(s, &d)| (0..d).all(|i| reached(s, i)))
        {
            return reject("monotone", place, "something is negative, or a coordinate is nowhere positive");
        }
        Ok(())
    }

    /// By state, `K` with all unit vectors in `K Q`.
    fn interiors(&self, node: &Node<'_>, complex: bool, points: &[Point]) -> Result<Vec<Q>, Rejected> {
        let mut found: Vec<Option<Q>> = self.dims.iter().map(|d| (*d == 0).then(Q::zero)).collect();
        for item in node.list()? {
            let [state, units] = item.fields(["state", "units"])?;
            let s = state.index(self.dims.len())?;
            let units = units.list()?;
            if units.len() != self.dims[s] {
                return reject("interior", &item.place, "one combination for each axis is needed");
            }
            let (mut largest, mut error) = (Q::zero(), Q::zero());
            for (axis, unit) in units.iter().enumerate() {
                let terms = self.terms(unit, complex, points, s)?;
                let one = |i: usize| if i == axis { Q::one() } else { Q::zero() };
                let x = ((0..self.dims[s]).map(one).collect(), vec![Q::zero(); self.dims[s]]);
                let (re, im) = Self::rest(x, &terms, points)?;
                error = error.max(re.iter().chain(&im).map(Signed::abs).sum());
                largest = largest.max(Self::total(&terms)?);
            }
            if error >= Q::one() {
                return reject("interior", &item.place, "the combinations are too far from the axes");
            }
            found[s] = Some(largest / (Q::one() - error));
        }
        match found.into_iter().collect::<Option<Vec<Q>>>() {
            Some(found) => Ok(found),
            None => reject("interior", &node.place, "a state without combinations of the axes"),
        }
    }

    /// Positive definite forms with `Tᵗ P T <= square P`, `square <= bound²`.
    fn quadratic(&self, node: &Node<'_>, bound: &Q) -> Result<(), Rejected> {
        let [_, forms, square] = node.fields(["norm", "forms", "square"])?;
        let square = square.rational()?;
        let mut read: Vec<Matrix> = self.dims.iter().map(|d| Matrix::identity(*d)).collect();
        for item in forms.list()? {
            let [state, form] = item.fields(["state", "form"])?;
            let s = state.index(self.dims.len())?;
            read[s] = crate::spectrum::positive_definite(&form, self.dims[s])?;
        }
        if square > bound * bound {
            return reject("quadratic", &node.place, "the bound is below the root of the square");
        }
        for (from, to, m) in &self.arrows {
            let image = m.transpose().times(&read[*from])?.times(m)?;
            if !semidefinite(&read[*to].scaled(&square).minus(&image))? {
                return reject("quadratic", &node.place, "a matrix expands the form");
            }
        }
        Ok(())
    }

    /// Complete prefix codes of words whose norms are at most `bound^length`, for weighted sums of absolute values.
    fn tree(&self, node: &Node<'_>, bound: &Q) -> Result<(), Rejected> {
        let [_, codes] = node.fields(["norm", "codes"])?;
        let mut weights: Vec<Option<Vec<Q>>> = self.dims.iter().map(|d| (*d == 0).then(Vec::new)).collect();
        let mut words: Vec<Vec<Vec<usize>>> = vec![Vec::new(); self.dims.len()];
        for item in codes.list()? {
            let [state, w, list] = item.fields(["state", "weights", "words"])?;
            let s = state.index(self.dims.len())?;
            let w = w.vector(self.dims[s])?;
            if w.iter().any(|x| !x.is_positive()) {
                return reject("tree", &item.place, "weights are positive");
            }
            weights[s] = Some(w);
            for word in list.list()? {
                let letters = word.list()?;
                // The empty word has norm 1 whatever the matrices are: it would be a code that proves every bound.
                word.need((1..=crate::MAX_LETTERS).contains(&letters.len()), "tree", "words have 1 to 1000 letters")?;
                words[s].push(letters.iter().map(|n| n.index(self.arrows.len())).collect::<Result<_, _>>()?);
            }
            words[s].sort();
        }
        let Some(weights) = weights.into_iter().collect::<Option<Vec<_>>>() else {
            return reject("tree", &codes.place, "a state without a code");
        };
        for s in (0..self.dims.len()).filter(|&s| self.dims[s] > 0) {
            let mut used = 0;
            self.descend(s, s, &mut Vec::new(), &Matrix::identity(self.dims[s]), &words[s], &mut used, &weights, bound)
                .map_err(|r| if r.place.is_empty() { Rejected { place: codes.place.clone(), ..r } } else { r })?;
            if used != words[s].len() {
                return reject("tree", &codes.place, "a word that is no path, or begins with another");
            }
        }
        Ok(())
    }

    #[allow(clippy::too_many_arguments, reason = "one walk over a tree")]
    fn descend(
        &self,
        from: usize,
        at: usize,
        word: &mut Vec<usize>,
        product: &Matrix,
        code: &[Vec<usize>],
        used: &mut usize,
        weights: &[Vec<Q>],
        bound: &Q,
    ) -> Result<(), Rejected> {
        if product.is_zero() && !word.is_empty() && code.binary_search(word).is_err() {
            // What follows is 0, whatever the code says about it.
            *used += code.iter().filter(|w| w.starts_with(word)).count();
            return Ok(());
        }
        if code.binary_search(word).is_ok() {
            *used += 1;
            let column = |j: usize| {
                (0..product.rows).map(|i| product.at(i, j).abs() * &weights[from][i]).sum::<Q>() / &weights[at][j]
            };
            let norm = (0..product.cols).map(column).max().unwrap_or_else(Q::zero);
            return if norm <= power(bound, word.len())? {
                Ok(())
            } else {
                reject("tree", "", format!("the norm of the word {word:?} is too large"))
            };
        }
        let next = code.partition_point(|w| w.as_slice() < word.as_slice());
        if !code.get(next).is_some_and(|w| w.starts_with(word)) {
            return reject("tree", "", format!("no word of the code begins with {word:?}"));
        }
        for a in (0..self.arrows.len()).filter(|&a| self.arrows[a].0 == at && self.dims[self.arrows[a].1] > 0) {
            word.push(a);
            let longer = product.times(&self.arrows[a].2)?;
            self.descend(from, self.arrows[a].1, word, &longer, code, used, weights, bound)?;
            word.pop();
        }
        Ok(())
    }
}

/// Whether a symmetric matrix is positive semidefinite, by elimination.
fn semidefinite(difference: &Matrix) -> Result<bool, Rejected> {
    let n = difference.rows;
    let mut a: Vec<Vec<Q>> = (0..n).map(|i| difference.row(i).entries()).collect();
    for k in 0..n {
        spend(n * n, largest(a.iter().flatten()))?;
        let pivot = a[k][k].clone();
        if pivot.is_negative() || (pivot.is_zero() && (k..n).any(|j| !a[k][j].is_zero())) {
            return Ok(false);
        }
        if pivot.is_zero() {
            continue;
        }
        for i in k + 1..n {
            let factor = &a[i][k] / &pivot;
            let row = a[k].clone();
            a[i].iter_mut().zip(&row).for_each(|(x, p)| *x -= &factor * p);
        }
    }
    Ok(true)
}
