//! The factors of the summands of a matrix over a field, with their chains, and how they come together.

use crate::algebraic::field::{Extension, FieldMatrix, NumberField, place};
use crate::algebraic::{Elem, Root, roots};
use crate::arith::Rational;
use crate::jordan::Chain;
use crate::jordan::summand::{Merged, Side, Summand, all_factors, decompose, decompose_some, embed_vector};
use crate::jordan::symmetry::Symmetry;
use crate::linalg::dependency::combination;
use crate::linalg::{Matrix, char_poly};
use crate::poly::Poly;
use std::collections::BTreeMap;

/// Above this degree eigenvectors are not divided by one of their entries.
const NORMALISED_DEGREE: usize = 32;

/// Above this degree over the rationals a factor is not split over the field by its norm.
const SPLIT_DEGREE: usize = 32;

type Embedding = Option<Vec<Vec<(usize, crate::arith::Integer)>>>;

/// The action on an invariant subspace of `K^n` (see [`Side`]).
struct FieldSide {
    matrix: FieldMatrix,
    embedding: Embedding,
}

/// One factor on one summand; the chains are in coordinates of the whole space.
struct Part {
    extension: Extension,
    multiplicity: usize,
    blocks: Vec<usize>,
    right: Vec<Chain>,
    left: Vec<Chain>,
}

/// A factor with its roots.
pub(super) struct Placed {
    pub extension: Extension,
    pub minpoly: Poly,
    pub multiplicity: usize,
    pub blocks: Vec<usize>,
    pub roots: Vec<Root>,
    pub generators: Vec<Root>,
    pub right: Vec<Chain>,
    pub left: Vec<Chain>,
}

/// `1, x, …, x^(count - 1)` modulo `m`.
pub(super) fn powers(x: &Elem, count: usize, m: &Poly) -> Vec<Elem> {
    let mut out = Vec::with_capacity(count);
    let mut power = Elem::from_rational(&Rational::from(1));
    for _ in 0..count {
        let next = power.mul(x, m);
        out.push(std::mem::replace(&mut power, next));
    }
    out
}

/// The value of a polynomial, given the powers of the point.
pub(super) fn substituted(x: &Elem, powers: &[Elem]) -> Elem {
    if x.is_rational().is_some() {
        return x.clone();
    }
    x.0.coeffs().iter().zip(powers).filter(|(c, _)| **c != 0).fold(Elem::zero(), |acc, (c, p)| acc.add(&p.scale(c)))
}

fn mapped(chains: &mut [Chain], f: impl Fn(&Elem) -> Elem) {
    chains.iter_mut().flat_map(|c| &mut c.vectors).flatten().for_each(|x| *x = f(x));
}

fn coordinates(x: &Elem, size: usize) -> Vec<Rational> {
    (0..size).map(|k| x.0.coeff(k)).collect()
}

/// The minimal polynomial over the rationals of an element of `Q[x] / (m)`.
fn minimal(x: &Elem, m: &Poly) -> Poly {
    if let Some(q) = x.is_rational() {
        return Poly::linear(&q);
    }
    let n = m.degree().unwrap_or(1);
    let t = Elem::generator(m);
    if *x == t {
        return m.monic();
    }
    let mut columns = Vec::with_capacity(n);
    let mut image = x.clone();
    for _ in 0..n {
        columns.push(coordinates(&image, n));
        image = image.mul(&t, m);
    }
    // The characteristic polynomial is a power of it.
    let power = char_poly(&Matrix::from_columns(n, &columns));
    power.div_rem(&power.gcd(&power.derivative())).0.monic()
}

/// The whole matrix, or its components by a rotational symmetry, on both sides.
fn split(a: &FieldMatrix) -> Vec<(FieldSide, FieldSide)> {
    let whole = |matrix| FieldSide { matrix, embedding: None };
    let mut numbers: BTreeMap<&[Rational], usize> = BTreeMap::new();
    for x in a.entries() {
        let next = numbers.len();
        numbers.entry(x.0.coeffs()).or_insert(next);
    }
    let pattern = Matrix::from_fn(a.rows(), a.cols(), |i, j| Rational::from(numbers[a[(i, j)].0.coeffs()]));
    let Some(symmetry) = Symmetry::detect(&pattern) else {
        return vec![(whole(a.clone()), whole(a.transpose()))];
    };
    let mut layers: Vec<Vec<Summand>> = (0..a.field().degree()).map(|k| symmetry.split(&a.coefficient(k))).collect();
    let count = layers[0].len();
    let joined = |sides: Vec<Side>| {
        let entry = |i: usize, j: usize| Elem(Poly::new(sides.iter().map(|s| s.matrix[(i, j)].clone()).collect()));
        let (rows, cols) = (sides[0].matrix.rows(), sides[0].matrix.cols());
        let matrix = FieldMatrix::from_fn(a.field(), rows, cols, entry);
        let embedding = sides.into_iter().next().and_then(|s| s.embedding);
        FieldSide { matrix, embedding }
    };
    let mut out = Vec::with_capacity(count);
    for _ in 0..count {
        let (right, left) = layers.iter_mut().map(|l| l.remove(0)).map(|s| (s.right, s.left)).unzip();
        out.push((joined(right), joined(left)));
    }
    out
}

/// All factors of a matrix that is not rational, in order.
pub(super) fn all(a: &FieldMatrix) -> Vec<Placed> {
    let field = a.field();
    let mut found: BTreeMap<(Poly, usize), Placed> = BTreeMap::new();
    for (right, left) in split(a) {
        let parts = match (right.matrix.rational(), left.matrix.rational()) {
            (Some(r), Some(l)) => rational_parts(field, r, l),
            _ => None,
        };
        let parts = parts.unwrap_or_else(|| field_parts(field, &right.matrix, &left.matrix));
        for mut part in parts {
            embed(&mut part.right, &right.embedding, a.rows());
            embed(&mut part.left, &left.embedding, a.rows());
            let placed = part.canonical(field).placed(field);
            let key = (placed.minpoly.clone(), placed.roots[0].index());
            match found.get_mut(&key) {
                Some(old) => old.absorb(placed),
                None => {
                    found.insert(key, placed);
                }
            }
        }
    }
    let mut all: Vec<Placed> = found.into_values().collect();
    all.iter_mut().for_each(Placed::ordered);
    all
}

fn embed(chains: &mut [Chain], embedding: &Embedding, size: usize) {
    if let Some(places) = embedding {
        for v in chains.iter_mut().flat_map(|c| &mut c.vectors) {
            *v = embed_vector(v, places, size);
        }
    }
}

/// The parts of a rational summand: its spectrum over the rationals, every factor split over the field; `None` where that is
/// more work than the restriction of scalars.
fn rational_parts(field: &NumberField, right: Matrix, left: Matrix) -> Option<Vec<Part>> {
    let side = |matrix| Side { matrix, embedding: None };
    let summand = Summand { right: side(right), left: side(left) };
    let mut out = Vec::new();
    for merged in decompose(&[summand]) {
        let degree = merged.poly.degree().unwrap_or(1);
        if degree > 1 && degree * field.degree() > SPLIT_DEGREE {
            return None;
        }
        for extension in field.all_extensions(&merged.poly) {
            let values = powers(&extension.lambda, degree, &extension.poly);
            let (mut right, mut left) = (merged.right.clone(), merged.left.clone());
            mapped(&mut right, |x| substituted(x, &values));
            mapped(&mut left, |x| substituted(x, &values));
            out.push(Part { extension, multiplicity: merged.multiplicity, blocks: merged.blocks.clone(), right, left });
        }
    }
    Some(out)
}

/// 0, 1, -1, 2, …
fn shifts() -> impl Iterator<Item = i64> {
    std::iter::once(0).chain((1..).flat_map(|s| [s, -s]))
}

/// The parts of a summand by restriction of scalars.
fn field_parts(field: &NumberField, right: &FieldMatrix, left: &FieldMatrix) -> Vec<Part> {
    let d = field.degree();
    let restricted = |a: &FieldMatrix, s: i64| {
        let alpha = Elem::generator(field.poly()).scale(&Rational::from(s));
        let matrix = a.add(&FieldMatrix::identity(field, a.rows()).scale(&alpha)).restricted();
        Side { matrix, embedding: None }
    };
    let mut out: Vec<Part> = Vec::new();
    let mut found = 0;
    for s in shifts() {
        let summands = [Summand { right: restricted(right, s), left: restricted(left, s) }];
        let known: Vec<Poly> = out
            .iter()
            .map(|p| {
                let e = &p.extension;
                minimal(&e.lambda.add(&e.alpha.scale(&Rational::from(s))), &e.poly)
            })
            .collect();
        let wanted = |m: &Poly| m.degree().is_some_and(|n| n.is_multiple_of(d)) && !known.contains(m);
        for merged in decompose_some(&summands, &all_factors(&summands), &wanted) {
            if let Some(part) = separated(field, merged, s) {
                found += part.multiplicity * part.extension.poly.degree().unwrap_or(0) / d;
                out.push(part);
            }
        }
        if found == right.rows() {
            return out;
        }
    }
    unreachable!("only finitely many shifts fail")
}

/// The part of a factor for which `α` acts as a number on all eigenvectors.
fn separated(field: &NumberField, merged: Merged, shift: i64) -> Option<Part> {
    let m = &merged.poly;
    let alpha = action(field, &merged.right[0].vectors[0], m)?;
    let eigenvectors = || merged.right.iter().chain(&merged.left).map(|c| &c.vectors[0]);
    let scalar = |v: &Vec<Elem>| times_alpha(field, v).iter().zip(v).all(|(y, x)| *y == alpha.mul(x, m));
    // One eigenvector is mapped to a multiple of itself, because α commutes with the matrix.
    if merged.right.len() > 1 && !eigenvectors().all(scalar) {
        return None;
    }
    let lambda = Elem::generator(m).sub(&alpha.scale(&Rational::from(shift)));
    let extension = Extension { poly: m.clone(), alpha, lambda, shift };
    let values = powers(&extension.alpha, field.degree(), m);
    let project = |chain: &Chain| Chain { vectors: chain.vectors.iter().map(|v| projected(v, &values, m)).collect() };
    let right: Vec<Chain> = merged.right.iter().map(project).collect();
    let left: Vec<Chain> = merged.left.iter().map(project).collect();
    Some(Part { extension, multiplicity: merged.multiplicity, blocks: merged.blocks, right, left })
}

/// `α v` for a vector in the coordinates of the restriction of scalars.
fn times_alpha(field: &NumberField, v: &[Elem]) -> Vec<Elem> {
    let f = field.poly();
    let mut out = Vec::with_capacity(v.len());
    for block in v.chunks_exact(field.degree()) {
        let last = &block[block.len() - 1];
        for k in 0..block.len() {
            let carried = last.scale(&-f.coeff(k));
            out.push(if k == 0 { carried } else { block[k - 1].add(&carried) });
        }
    }
    out
}

/// The number by which `α` acts on a vector, if any, from one of its entries.
fn action(field: &NumberField, v: &[Elem], m: &Poly) -> Option<Elem> {
    let n = m.degree().unwrap_or(1);
    let size = |x: &Elem| x.0.coeffs().len();
    let (i, entry) = v.iter().enumerate().filter(|(_, x)| !x.is_zero()).min_by_key(|(_, x)| size(x))?;
    let image = &times_alpha(field, v)[i];
    if let Some(q) = entry.is_rational() {
        return Some(image.scale(&(Rational::from(1) / q)));
    }
    let theta = Elem::generator(m);
    let mut columns = Vec::with_capacity(n);
    let mut column = entry.clone();
    for _ in 0..n {
        columns.push(coordinates(&column, n));
        column = column.mul(&theta, m);
    }
    Some(Elem(Poly::new(combination(&columns, &coordinates(image, n))?)))
}

/// The image of a vector under the map that takes `α` to its value.
fn projected(v: &[Elem], values: &[Elem], m: &Poly) -> Vec<Elem> {
    let entry = |block: &[Elem]| block.iter().zip(values).fold(Elem::zero(), |sum, (x, p)| sum.add(&x.mul(p, m)));
    v.chunks_exact(values.len()).map(entry).collect()
}

impl Part {
    /// The same with the generator `α` where `λ` is in the field, and with short eigenvectors.
    fn canonical(mut self, field: &NumberField) -> Self {
        let (m, f) = (&self.extension.poly, field.poly());
        if m.degree() == f.degree() && !self.extension.is_own(field) {
            let d = field.degree();
            let columns: Vec<Vec<Rational>> =
                powers(&self.extension.alpha, d, m).iter().map(|p| coordinates(p, d)).collect();
            let solved = combination(&columns, &coordinates(&self.extension.lambda, d));
            let lambda = Elem(Poly::new(solved.expect("the powers of the generator are a basis")));
            let alpha = Elem::generator(f);
            let theta = lambda.add(&alpha.scale(&Rational::from(self.extension.shift)));
            let values = powers(&theta, d, f);
            mapped(&mut self.right, |x| substituted(x, &values));
            mapped(&mut self.left, |x| substituted(x, &values));
            self.extension = Extension { poly: f.clone(), alpha, lambda, shift: 0 };
        }
        let m = &self.extension.poly;
        if m.degree().is_some_and(|n| n <= NORMALISED_DEGREE) {
            for chain in self.right.iter_mut().chain(&mut self.left) {
                let first = chain.vectors[0].iter().find(|x| !x.is_zero());
                if let Some(inverse) = first.and_then(|x| x.inv(m)) {
                    chain.vectors.iter_mut().flatten().for_each(|x| *x = x.mul(&inverse, m));
                }
            }
        }
        self
    }

    fn placed(self, field: &NumberField) -> Placed {
        let Self { extension, multiplicity, blocks, right, left } = self;
        let minpoly = minimal(&extension.lambda, &extension.poly);
        let thetas =
            if extension.is_own(field) { vec![field.generator().clone()] } else { extension.roots_over(field) };
        let all = roots(&minpoly);
        let mut pairs: Vec<(Root, Root)> = thetas
            .into_iter()
            .map(|theta| {
                let value = if all.len() == 1 { &all[0] } else { place(&extension.lambda, &theta, &all) };
                (value.clone(), theta)
            })
            .collect();
        pairs.sort_by_key(|(root, _)| root.index());
        let (roots, generators) = pairs.into_iter().unzip();
        Placed { extension, minpoly, multiplicity, blocks, roots, generators, right, left }
    }
}

impl Placed {
    /// Adds the same factor of another summand.
    fn absorb(&mut self, mut other: Self) {
        if other.extension.poly != self.extension.poly || other.extension.lambda != self.extension.lambda {
            let e = &self.extension;
            // The other generator is λ + sα as well, with another s.
            let shift = Rational::from(other.extension.shift);
            let image = e.lambda.add(&e.alpha.scale(&shift));
            let values = powers(&image, other.extension.poly.degree().unwrap_or(1), &e.poly);
            mapped(&mut other.right, |x| substituted(x, &values));
            mapped(&mut other.left, |x| substituted(x, &values));
        }
        self.multiplicity += other.multiplicity;
        self.right.extend(other.right);
        self.left.extend(other.left);
    }

    fn ordered(&mut self) {
        let descending = |chains: &mut Vec<Chain>| chains.sort_by_key(|c| std::cmp::Reverse(c.vectors.len()));
        descending(&mut self.right);
        descending(&mut self.left);
        self.blocks = self.right.iter().map(|c| c.vectors.len()).collect();
    }

    /// The minimal polynomial of `λ` over the field: `λ^e` as a combination of the `α^i λ^j` with `j < e`.
    pub fn factor_over(&self, field: &NumberField) -> Vec<Elem> {
        let (e, d) = (self.roots.len(), field.degree());
        let Extension { poly: m, alpha, lambda, .. } = &self.extension;
        let one = Elem::from_rational(&Rational::from(1));
        if e == 1 {
            return vec![lambda.neg(), one];
        }
        if self.minpoly.degree() == Some(e) {
            return self.minpoly.coeffs().iter().map(Elem::from_rational).collect();
        }
        let n = e * d;
        let (alphas, lambdas) = (powers(alpha, d, m), powers(lambda, e + 1, m));
        let columns: Vec<Vec<Rational>> =
            lambdas[..e].iter().flat_map(|l| alphas.iter().map(move |a| coordinates(&a.mul(l, m), n))).collect();
        let solved = combination(&columns, &coordinates(&lambdas[e], n)).expect("these products are a basis");
        let mut out: Vec<Elem> = solved.chunks_exact(d).map(|c| Elem(Poly::new(c.to_vec())).neg()).collect();
        out.push(one);
        out
    }
}
