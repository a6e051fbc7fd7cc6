//! The field of the radius `ρ`: vertices as its elements, and the signs of numbers in it.

use super::closing::Closing;
use super::exact::axis_point;
use super::grow::{Inside, Origin};
use super::leading::{Lower, real_sign};
use super::simplex::Body;
use crate::algebraic::{Elem, Root};
use crate::arith::{Interval, Rational};
use crate::linalg::Matrix;
use crate::poly::{Poly, factor};
use malachite_base::num::logic::traits::SignificantBits;

/// The field of the radius `ρ`, with all vertices as elements.
pub(super) struct Field<'a> {
    closing: &'a Closing<'a>,
    modulus: Poly,
    points: Vec<Vec<Elem>>,
    inverse: Elem,
}

/// Largest degree of a field in which boundary points are solved.
const MAX_DEGREE: usize = 24;

impl<'a> Field<'a> {
    /// `None` where the degree is too large, or the budget does not suffice.
    pub fn new(closing: &'a Closing<'a>) -> Option<Self> {
        let mut common = Poly::zero();
        for r in closing.roots {
            common = common.gcd(&in_radius(r.root.minpoly().coeffs(), &r.root, r.lower.length));
        }
        if common.degree()? > 4 * MAX_DEGREE || !closing.budget.spend(factoring(&common)) {
            return None;
        }
        let factors = factor(&common).into_iter().map(|f| f.0).collect();
        let modulus = vanishing(factors, closing.radius).filter(|m| m.degree() <= Some(MAX_DEGREE))?;
        let inverse = Elem::generator(&modulus).inv(&modulus)?;
        let mut field = Self { closing, modulus, points: Vec::new(), inverse };
        for v in &closing.grown.vertices {
            let n = closing.system.dims[v.state];
            field.afford(n * n)?;
            let point = match &v.origin {
                Origin::Root(r) => {
                    let root = &closing.roots[*r];
                    let reduce =
                        |c: &Vec<Rational>| Elem::reduced(&in_radius(c, &root.root, root.lower.length), &field.modulus);
                    root.vector.coordinates.iter().map(reduce).collect()
                }
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
        let degree = self.modulus.degree().map_or(1, |d| d as u64 + 1);
        let work = (products as u64).saturating_mul(degree * degree).saturating_mul(200 + bits * bits / 64);
        self.closing.budget.spend(work).then_some(())
    }

    /// The sign of an element at the radius; `None` where it is smaller than `2^-4000`.
    fn sign(&self, e: &Elem) -> Option<i32> {
        sign_at(&e.0, self.closing.radius)
    }

    /// `T v / ρ`.
    fn image(&self, matrix: &Matrix, v: &[Elem]) -> Vec<Elem> {
        (0..matrix.rows())
            .map(|i| {
                let row = matrix.row(i).iter().zip(v).filter(|(a, _)| **a != 0);
                row.fold(Elem::zero(), |s, (a, x)| s.add(&x.scale(a))).mul(&self.inverse, &self.modulus)
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
                .fold(Elem::zero(), |s, (k, e)| s.add(&e.mul(&self.points[*k][i], &self.modulus)));
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
            let inverse = a[col][col].inv(&self.modulus)?;
            a[col] = a[col].iter().map(|e| e.mul(&inverse, &self.modulus)).collect();
            let pivot = a[col].clone();
            for (_, row) in a.iter_mut().enumerate().filter(|(r, row)| *r != col && !row[col].is_zero()) {
                let factor = row[col].clone();
                *row = row.iter().zip(&pivot).map(|(e, p)| e.sub(&factor.mul(p, &self.modulus))).collect();
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
