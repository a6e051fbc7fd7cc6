//! The field of the radius `ρ`: vertices as its elements, and the signs of numbers in it.

use super::closing::Closing;
use super::exact::{LeadingVector, axis_point};
use super::grow::{Inside, Origin};
use super::leading::{Lower, real_sign};
use super::radial::Radial;
use super::simplex::Body;
use crate::algebraic::field::FieldBuilder;
use crate::algebraic::{Elem, Real, Root, real_roots};
use crate::arith::{Interval, Rational};
use crate::jordan::Scalar;
use crate::linalg::Matrix;
use crate::poly::{Poly, factor};
use crate::ring::{Field as _, Ring as _};
use malachite_base::num::logic::traits::SignificantBits;

/// A field that holds the radius `ρ` and the entries.
pub struct Over {
    modulus: Poly,
    /// The root of the polynomial that generates it; `None` where it is the radius.
    place: Option<Root>,
    /// The generator of the field of the entries.
    alpha: Option<Elem>,
    radius: Elem,
    /// The leading eigenvectors.
    vectors: Vec<Vec<Elem>>,
}

/// The field of the radius and the entries, with all vertices as elements.
pub(super) struct Field<'a, E = Rational> {
    closing: &'a Closing<'a, E>,
    over: Over,
    points: Vec<Vec<Elem>>,
    inverse: Elem,
}

/// Largest degree of a field in which boundary points are solved.
const MAX_DEGREE: usize = 24;

/// The field of the radius of rational matrices.
pub(super) fn rational(closing: &Closing) -> Option<Over> {
    let modulus = minimal(closing)?;
    let vector = |r: &LeadingVector| {
        let reduce = |c: &Vec<Rational>| Elem::reduced(&in_radius(c, &r.root, r.lower.length), &modulus);
        r.vector.coordinates.iter().map(reduce).collect()
    };
    let vectors = closing.roots.iter().map(vector).collect();
    Some(Over { radius: Elem::generator(&modulus), place: None, alpha: None, vectors, modulus })
}

/// The field of the radius and the entries of matrices over a number field.
pub(super) fn real(closing: &Closing<Real>) -> Option<Over> {
    let base = Real::base(closing.system.arrows.iter().flat_map(|a| a.matrix.entries()));
    let radius = located(&minimal(closing)?, closing.radius)?;
    let mut builder = FieldBuilder::new();
    let (alpha, radius) = (builder.adjoin(base.generator()).ok()?, builder.adjoin(&radius).ok()?);
    let field = builder.field();
    let (alpha, radius) = (builder.elem(&alpha), builder.elem(&radius));
    let vector = |r: &LeadingVector| {
        let product = closing.system.product(&r.lower.path);
        let power = (0..r.lower.length).fold(field.one(), |p, _| field.mul(&p, &radius));
        let value = if real_sign(&r.root) < 0 { field.neg(&power) } else { power };
        let entry = |i: usize, j: usize| {
            let x = field.eval(&product[(i, j)].elem().0, &alpha);
            if i == j { field.sub(&x, &value) } else { x }
        };
        let kernel = Matrix::from_fn(product.rows(), product.cols(), entry).kernel_over(field)?;
        // The one of the line that has the known rational coordinate.
        let known = r.vector.coordinates.iter().position(|c| matches!(&c[..], [c] if *c != 0))?;
        let unit = (kernel.cols() == 1).then(|| kernel.column(0))?;
        let factor = field.scale(&field.inv(&unit[known])?, &r.vector.coordinates[known][0]);
        Some(unit.iter().map(|x| field.mul(x, &factor)).collect())
    };
    let vectors = closing.roots.iter().map(vector).collect::<Option<_>>()?;
    let (modulus, place) = (field.poly().clone(), Some(field.generator().clone()));
    Some(Over { modulus, place, alpha: Some(alpha), radius, vectors })
}

/// The minimal polynomial of the radius over the rationals; `None` where its degree is too large, or the budget does not suffice.
fn minimal<E: Radial>(closing: &Closing<E>) -> Option<Poly> {
    let mut common = Poly::zero();
    for r in closing.roots {
        common = common.gcd(&in_radius(r.root.minpoly().coeffs(), &r.root, r.lower.length));
    }
    if common.degree()? > 4 * MAX_DEGREE || !closing.budget.spend(factoring(&common)) {
        return None;
    }
    let factors = factor(&common).into_iter().map(|f| f.0).collect();
    vanishing(factors, closing.radius).filter(|m| m.degree() <= Some(MAX_DEGREE))
}

/// The radius as a root of its minimal polynomial.
fn located(minimal: &Poly, radius: &Lower) -> Option<Root> {
    let mut near = real_roots(minimal);
    for bits in [64, 256, 1024] {
        near.retain(|r| !r.enclosure(bits).0.disjoint(&radius.enclosure(bits)));
        if near.len() <= 1 {
            break;
        }
    }
    <[Root; 1]>::try_from(near).ok().map(|[r]| r)
}

impl<'a, E: Radial> Field<'a, E> {
    /// `None` where the degree is too large, or the budget does not suffice.
    pub fn new(closing: &'a Closing<'a, E>) -> Option<Self> {
        let over = E::over_radius(closing)?;
        let inverse = over.radius.inv(&over.modulus)?;
        let mut field = Self { closing, over, points: Vec::new(), inverse };
        for v in &closing.grown.vertices {
            let n = closing.system.dims[v.state];
            field.afford(n * n)?;
            let point = match &v.origin {
                Origin::Root(r) => field.over.vectors[*r].clone(),
                Origin::Axis { axis, exponent } => {
                    axis_point(n, *axis, *exponent).iter().map(Elem::from_rational).collect()
                }
                Origin::Free(point) => point.iter().map(Elem::from_rational).collect(),
                Origin::Image { parent, arrow } => {
                    field.image(&closing.system.arrows[*arrow].matrix, &field.points[*parent])
                }
            };
            field.points.push(point);
        }
        Some(field)
    }

    /// Spends the work of a number of products of elements, as large as the last point.
    fn afford(&self, products: usize) -> Option<()> {
        let size = |x: &Rational| x.numerator_ref().significant_bits() + x.denominator_ref().significant_bits();
        let bits = |e: &Elem| e.0.coeffs().iter().map(size).max().map_or(64, |b| b + 64);
        let bits = self.points.last().and_then(|p| p.iter().map(bits).max()).map_or(64, |b| b);
        let degree = self.over.modulus.degree().map_or(1, |d| d as u64 + 1);
        let work = (products as u64).saturating_mul(degree * degree).saturating_mul(200 + bits * bits / 64);
        self.closing.budget.spend(work).then_some(())
    }

    /// The sign of an element; `None` where it is smaller than `2^-4000` at the radius.
    fn sign(&self, e: &Elem) -> Option<i32> {
        match &self.over.place {
            Some(place) => Some(e.sign(place)),
            None => sign_at(&e.0, self.closing.radius),
        }
    }

    /// An entry times an element.
    fn times(&self, entry: &E, x: &Elem) -> Elem {
        match entry.rational() {
            Some(q) => x.scale(&q),
            None => {
                entry.scaled(x, crate::jordan::Over { modulus: &self.over.modulus, alpha: self.over.alpha.as_ref() })
            }
        }
    }

    /// `T v / ρ`.
    fn image(&self, matrix: &Matrix<E>, v: &[Elem]) -> Vec<Elem> {
        (0..matrix.rows())
            .map(|i| {
                let row = matrix.row(i).iter().zip(v).filter(|(a, _)| !a.is_zero());
                row.fold(Elem::zero(), |s, (a, x)| s.add(&self.times(a, x))).mul(&self.inverse, &self.over.modulus)
            })
            .collect()
    }

    /// Whether an image on the boundary is a combination, with `Σ|c| <= 1`, of the points found for it.
    /// `None` where it was not decided.
    pub fn reaches(&self, inside: &Inside) -> Option<bool> {
        let (system, body) = (self.closing.system, self.closing.grown.body);
        let (n, terms) = (system.arrows[inside.arrow].matrix.rows(), inside.combination.terms.len());
        self.afford(n * (n + terms * terms))?;
        let x = self.image(&system.arrows[inside.arrow].matrix, &self.points[inside.vertex]);
        let columns: Vec<usize> = inside.combination.terms.iter().map(|t| t.0).collect();
        let rows: Vec<usize> = match body {
            Body::Symmetric => (0..x.len()).collect(),
            Body::Monotone => (0..x.len()).filter(|i| !inside.combination.loose.contains(i)).collect(),
        };
        let Some(c) = self.solve(&rows, &columns, &x) else { return Some(false) };
        let signs: Vec<i32> = c.iter().map(|e| self.sign(e)).collect::<Option<_>>()?;
        let sum = c.iter().zip(&signs).fold(Elem::zero(), |s, (e, sign)| s.add(&e.scale(&Rational::from(*sign))));
        let small = self.sign(&sum.sub(&Elem::from_rational(&Rational::from(1))))? <= 0;
        let dominates = |i: usize| {
            let reach = columns
                .iter()
                .zip(&c)
                .fold(Elem::zero(), |s, (k, e)| s.add(&e.mul(&self.points[*k][i], &self.over.modulus)));
            Some(self.sign(&reach.sub(&x[i]))? >= 0)
        };
        if !small || body == Body::Symmetric {
            return Some(small);
        }
        let dominated = (0..x.len()).map(dominates).collect::<Option<Vec<_>>>()?;
        Some(signs.iter().all(|s| *s >= 0) && dominated.into_iter().all(|d| d))
    }

    /// The solution of `Σ c_k q_k = x` on some rows, if there is one and it is unique.
    fn solve(&self, rows: &[usize], columns: &[usize], x: &[Elem]) -> Option<Vec<Elem>> {
        let mut a: Vec<Vec<Elem>> = rows
            .iter()
            .map(|&i| columns.iter().map(|&k| self.points[k][i].clone()).chain([x[i].clone()]).collect())
            .collect();
        for col in 0..columns.len() {
            let found = (col..a.len()).find(|&r| !a[r][col].is_zero())?;
            a.swap(col, found);
            let inverse = a[col][col].inv(&self.over.modulus)?;
            a[col] = a[col].iter().map(|e| e.mul(&inverse, &self.over.modulus)).collect();
            let pivot = a[col].clone();
            for (_, row) in a.iter_mut().enumerate().filter(|(r, row)| *r != col && !row[col].is_zero()) {
                let factor = row[col].clone();
                *row = row.iter().zip(&pivot).map(|(e, p)| e.sub(&factor.mul(p, &self.over.modulus))).collect();
            }
        }
        let consistent = a[columns.len()..].iter().all(|row| row[columns.len()].is_zero());
        consistent.then(|| a[..columns.len()].iter().map(|row| row[columns.len()].clone()).collect())
    }
}

/// `c(μ)` as a polynomial in the radius `ρ`, `μ = ± ρ^length`.
fn in_radius(coeffs: &[Rational], root: &Root, length: usize) -> Poly {
    let negative = real_sign(root) < 0;
    let mut out = vec![Rational::from(0); coeffs.len().saturating_sub(1) * length + 1];
    for (k, c) in coeffs.iter().enumerate() {
        out[k * length] = if negative && k % 2 == 1 { -c } else { c.clone() };
    }
    Poly::new(out)
}

/// About the work of factoring a polynomial, in nanoseconds.
fn factoring(p: &Poly) -> u64 {
    let size = |x: &Rational| x.numerator_ref().significant_bits();
    let bits = p.coeffs().iter().map(size).max().map_or(1, |b| b + 64);
    let degree = p.degree().map_or(1, |d| d as u64 + 1);
    degree.pow(3).saturating_mul(bits) * 10
}

/// The one of some irreducible polynomials that vanishes at the radius; `None` where several seem to.
fn vanishing(mut factors: Vec<Poly>, radius: &Lower) -> Option<Poly> {
    for bits in [64, 256, 1024] {
        let x = radius.enclosure(bits);
        factors.retain(|f| value(f, &x, bits).contains_zero());
        if factors.len() <= 1 {
            break;
        }
    }
    <[Poly; 1]>::try_from(factors).ok().map(|[f]| f)
}

fn value(p: &Poly, x: &Interval, bits: u64) -> Interval {
    let zero = Interval::point(Rational::from(0));
    p.coeffs().iter().rev().fold(zero, |sum, c| (&(&sum * x) + &Interval::point(c.clone())).outward(bits + 64))
}

/// The sign of a polynomial at the radius, of a smaller degree than its minimal polynomial: 0 only for the zero polynomial.
fn sign_at(p: &Poly, radius: &Lower) -> Option<i32> {
    if p.is_zero() {
        return Some(0);
    }
    [64, 256, 1000, 4000]
        .into_iter()
        .find_map(|bits| value(p, &radius.enclosure(bits), bits).sign().filter(|s| *s != 0))
}
