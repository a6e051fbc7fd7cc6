//! All valences at once: the characteristic map with `t = 2cos(2π/n)` as a variable (docs/theory.md, Theorem 9).
//!
//! The blocks of frequency 1 have the same entries in `t` for every valence. Everything is computed over the rational
//! functions of a parameter that covers all valences, and the signs are proved on its whole interval.

use super::block::Vertex;
use super::field::{Field, Fraction, Functions};
use super::net::Net;
use super::reason::Requirement;
use super::ring::{RINGS, jacobian, patches};
use super::solve::eigenvector;
use super::turning::{Rotation, Turning};
use crate::arith::{Rational, ratio};
use crate::poly::{Poly, factor};
use crate::ring::{Field as _, Ring as _};
use crate::scheme::{AllValences, MeshRule, SchemeError};

/// A valence at which no stencil meets itself around the vertex.
const LARGE: usize = 12;
/// How often patches and the interval are halved at most, together.
const DEPTH: usize = 12;
/// How often an interval is halved to find the sign of one polynomial.
const HALVINGS: usize = 8;

/// A condition with its outcome.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition {
    /// What is claimed.
    pub claim: Requirement,
    /// Whether it was proved.
    pub holds: bool,
}

/// What holds at every valence from some valence on.
#[derive(Debug, Clone)]
pub struct Every {
    /// The first valence covered.
    pub from: usize,
    /// The parameter, the eigenvalue and `t` in it, and the interval, in words.
    pub setting: &'static str,
    /// The conditions of Theorem 9.
    pub conditions: Vec<Condition>,
    /// Pieces of patch and interval on which all Bernstein coefficients of the Jacobian determinant are positive.
    pub pieces: usize,
}

impl Every {
    /// Whether all conditions hold, so that the scheme is C¹ at every valence from [`Every::from`] on.
    #[must_use]
    pub fn proved(&self) -> bool {
        self.conditions.iter().all(|c| c.holds)
    }
}

/// A scheme as a family over a parameter.
struct Family {
    row: AllValences,
    twice_cosine: Fraction,
    eigenvalue: Fraction,
}

impl Family {
    fn new(row: AllValences) -> Self {
        let (num, den) = row.twice_cosine.clone();
        Self { twice_cosine: Fraction::new(num, den), eigenvalue: Fraction::polynomial(row.eigenvalue.clone()), row }
    }
}

/// The one strict sign of a polynomial on an interval, proved by its Bernstein coefficients on halves.
#[must_use]
pub fn strict_sign(p: &Poly, (low, high): &(Rational, Rational)) -> Option<i32> {
    fn at(p: &Poly, low: &Rational, high: &Rational, depth: usize) -> Option<i32> {
        let signs: Vec<i32> = bernstein(p, low, high).iter().map(crate::arith::sign).collect();
        let first = *signs.first()?;
        if first != 0 && signs.iter().all(|s| *s == first) {
            return Some(first);
        }
        // The first and the last coefficient are values.
        let last = signs[signs.len() - 1];
        if depth == 0 || first * last <= 0 {
            return None;
        }
        let middle = (low + high) / Rational::from(2);
        let left = at(p, low, &middle, depth - 1)?;
        (at(p, &middle, high, depth - 1)? == left).then_some(left)
    }
    at(p, low, high, HALVINGS)
}

/// The Bernstein coefficients on an interval.
fn bernstein(p: &Poly, low: &Rational, high: &Rational) -> Vec<Rational> {
    let width = high - low;
    let mut power = Rational::from(1);
    let mut coefficients: Vec<Rational> = Vec::new();
    for c in p.shifted(low).coeffs() {
        coefficients.push(c * &power);
        power *= &width;
    }
    let degree = coefficients.len().saturating_sub(1);
    // a_k / C(d, k), then sums with binomials: b_i = Σ C(i, k) a_k / C(d, k).
    let mut binomial = Rational::from(1);
    for (k, c) in coefficients.iter_mut().enumerate() {
        *c /= &binomial;
        binomial = binomial * Rational::from((degree - k) as u64) / Rational::from((k + 1) as u64);
    }
    for step in 1..=degree {
        for k in (step..=degree).rev() {
            let below = coefficients[k - 1].clone();
            coefficients[k] += below;
        }
    }
    coefficients
}

fn positive(value: &Fraction, interval: &(Rational, Rational)) -> bool {
    let mut num = value.num.clone();
    // t = 2 belongs to no valence: a zero there is divided out. (The interval of λ ends elsewhere.)
    let end = ratio(2, 1);
    while interval.1 == end && !num.is_zero() && num.eval(&end) == 0 {
        num = num.div_rem(&Poly::new(vec![end.clone(), ratio(-1, 1)])).0;
    }
    match (strict_sign(&num, interval), strict_sign(&value.den, interval)) {
        (Some(a), Some(b)) => a * b > 0,
        _ => false,
    }
}

/// Whether a polynomial on a patch is positive for all parameters of an interval; counts the pieces.
fn positive_on(field: &Functions, net: Net<Fraction>, interval: (Rational, Rational), pieces: &mut usize) -> bool {
    let mut stack = vec![(net, interval, 0)];
    while let Some((net, interval, depth)) = stack.pop() {
        if net.rows.iter().flatten().all(|c| positive(c, &interval)) {
            *pieces += 1;
        } else if depth == DEPTH {
            return false;
        } else if depth % 3 == 2 {
            let middle = (&interval.0 + &interval.1) / Rational::from(2);
            stack.push((net.clone(), (middle.clone(), interval.1), depth + 1));
            stack.push((net, (interval.0, middle), depth + 1));
        } else {
            let (left, right) = net.halves(field);
            stack.push((right.turned(), interval.clone(), depth + 1));
            stack.push((left.turned(), interval, depth + 1));
        }
    }
    true
}

/// Proves a scheme C¹ at all valences from some valence on; `None` where no family is known for the rule.
///
/// # Errors
/// [`SchemeError`] of the stencils.
///
/// # Cost
/// A few seconds.
pub fn every(rule: &MeshRule) -> Result<Option<Every>, SchemeError> {
    let Some(family) = rule.all_valences().map(Family::new) else { return Ok(None) };
    let field = Functions::new(crate::ring::Functions::anywhere(), family.twice_cosine.clone());
    let vertex = Vertex::new(rule, LARGE, RINGS)?;
    let block = vertex.block(1)?;
    let mut conditions: Vec<Condition> = Vec::new();
    let mut check = |claim, holds: bool| conditions.push(Condition { claim, holds });
    let root = |part: &super::block::Part| {
        let value = part.poly.iter().rev().fold(field.zero(), |v, c| {
            field.add(&field.mul(&v, &family.eigenvalue), &field.eval(c, &family.twice_cosine))
        });
        value.num.is_zero()
    };
    let part = block.parts.iter().position(root);
    check(Requirement::Eigenvalue, part.is_some());
    for (claim, p) in &family.row.claims {
        check(Requirement::Row(claim), strict_sign(p, &family.row.interval) == Some(1));
    }
    check(Requirement::Constants, constants(&vertex, &family, part)?);
    let values = part.and_then(|p| eigenvector(&field, &block, p, &family.eigenvalue));
    let nets = values.and_then(|v| patches(&vertex, &field, &v));
    let Some(nets) = nets else {
        check(Requirement::Known, false);
        return Ok(Some(Every { from: family.row.from, setting: family.row.setting, conditions, pieces: 0 }));
    };
    let finite =
        |p: &Turning<Fraction>| [&p.x, &p.y].into_iter().all(|e| strict_sign(&e.den, &family.row.interval).is_some());
    check(Requirement::Denominators, nets.iter().flat_map(|n| n.rows.iter().flatten()).all(finite));
    let mut pieces = 0;
    let regular =
        nets.iter().all(|net| positive_on(&field, jacobian(&field, net), family.row.interval.clone(), &mut pieces));
    check(Requirement::Jacobian, regular);
    check(Requirement::HalfPlane, half_plane(&field, &nets, &family));
    Ok(Some(Every { from: family.row.from, setting: family.row.setting, conditions, pieces }))
}

/// The parts of the blocks that are the same for all frequencies, against a bound below λ.
fn constants(vertex: &Vertex, family: &Family, own: Option<usize>) -> Result<bool, SchemeError> {
    let turning = vertex.block(1)?;
    let still = vertex.block(0)?;
    // The centre of block 0 is covered by the claims; in dual schemes its part has the eigenvalue 1 only.
    let centre = |p: &&super::block::Part| {
        let one = p.poly.len() == 2 && p.poly[0] == Poly::constant(ratio(-1, 1));
        if still.before == 1 { p.indices.contains(&0) } else { one && p.indices == [0] }
    };
    let others = turning.parts.iter().enumerate().filter(|(k, _)| Some(*k) != own).map(|(_, p)| p);
    let mut bound = Rational::from(0);
    for part in others.chain(still.parts.iter().filter(|p| !centre(p))) {
        // In all families these eigenvalues are rational.
        if part.poly.iter().any(|c| c.degree().is_some_and(|d| d > 0)) {
            return Ok(false);
        }
        for (linear, _) in factor(&Poly::new(part.poly.iter().map(|c| c.coeff(0)).collect())) {
            if linear.degree() != Some(1) {
                return Ok(false);
            }
            bound = bound.max(crate::arith::abs(&linear.coeff(0)));
        }
    }
    let difference =
        Fraction::new(&family.eigenvalue.num - &family.eigenvalue.den.scale(&bound), family.eigenvalue.den.clone());
    Ok(positive(&difference, &family.row.interval))
}

/// A functional that is positive on the ring of a sector for all parameters: `x + y`, or `x + y t/2` where the sector begins
/// before the first axis.
fn half_plane(field: &Functions, nets: &[Net<Turning<Fraction>>], family: &Family) -> bool {
    let half = field.scale(&field.twice_cosine(), &ratio(1, 2));
    let rotation = Rotation(field);
    [field.one(), half].into_iter().any(|weight| {
        let mut pieces = 0;
        nets.iter().all(|net| {
            let values = net.map(|p| {
                let p = rotation.add(p, &rotation.zero());
                field.add(&p.x, &field.mul(&weight, &p.y))
            });
            positive_on(field, values, family.row.interval.clone(), &mut pieces)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vertex::cosine::minimal_polynomial;

    fn rule(name: &str) -> MeshRule {
        crate::scheme::mesh_rule(name, &[].into()).unwrap()
    }

    fn poly(coefficients: &[(i64, i64)]) -> Poly {
        Poly::new(coefficients.iter().map(|(p, q)| ratio(*p, *q)).collect())
    }

    #[test]
    fn signs_on_intervals() {
        let unit = (ratio(0, 1), ratio(1, 1));
        // x² − x + 3/10 > 0, x² − x + 1/5 not.
        assert_eq!(strict_sign(&poly(&[(3, 10), (-1, 1), (1, 1)]), &unit), Some(1));
        assert_eq!(strict_sign(&poly(&[(1, 5), (-1, 1), (1, 1)]), &unit), None);
        assert_eq!(strict_sign(&poly(&[(0, 1), (1, 1)]), &unit), None);
        assert_eq!(bernstein(&poly(&[(1, 1), (2, 1), (3, 1)]), &ratio(0, 1), &ratio(1, 1)), [1, 2, 6]);
    }

    /// The entries of block 1 at small valences are those at a large one, modulo the equation of `t`.
    #[test]
    fn the_blocks_are_the_same_at_every_valence() {
        let rules =
            [rule("catmull-clark"), rule("loop"), rule("doo-sabin"), rule("doo-sabin-catmull-clark"), rule("midedge")];
        for rule in rules {
            let large = Vertex::new(&rule, LARGE, RINGS).unwrap().block(1).unwrap();
            for n in [3, 4, 5, 7] {
                let small = Vertex::new(&rule, n, RINGS).unwrap().block(1).unwrap();
                let modulus = minimal_polynomial(n);
                for (a, b) in large.entries.iter().flatten().zip(small.entries.iter().flatten()) {
                    assert!((&a.x - &b.x).div_rem(&modulus).1.is_zero(), "{rule:?} at {n}");
                    assert!((&a.y - &b.y).div_rem(&modulus).1.is_zero(), "{rule:?} at {n}");
                }
            }
        }
    }

    /// The polynomial of block 0 that the proof of Theorem 9 uses, and the weights of Loop's.
    #[test]
    fn block_0_is_the_one_of_the_proof() {
        for n in [3, 4, 5, 8, 13] {
            let m = ratio(1, n as i64);
            let block = Vertex::new(&rule("catmull-clark"), n, RINGS).unwrap().block(0).unwrap();
            let part = block.parts.iter().find(|p| p.indices.contains(&0)).unwrap();
            let found = Poly::new(part.poly.iter().map(|c| c.coeff(0)).collect());
            let linear = ratio(7, 4) * &m - ratio(3, 4);
            let constant = (ratio(1, 1) - ratio(3, 1) * &m) / ratio(16, 1);
            assert_eq!(found, &Poly::linear(&ratio(1, 1)) * &Poly::new(vec![constant, linear, ratio(1, 1)]), "{n}");
            let block = Vertex::new(&rule("loop-warren"), n, RINGS).unwrap().block(0).unwrap();
            let part = block.parts.iter().find(|p| p.indices.contains(&0)).unwrap();
            let other = if n == 3 { ratio(1, 16) } else { ratio(1, 4) };
            assert_eq!(part.poly[0].coeff(0), other, "{n}");
        }
    }

    #[test]
    fn every_valence_of_the_classical_schemes() {
        for (rule, from) in [
            (rule("doo-sabin"), 3),
            (rule("doo-sabin-catmull-clark"), 3),
            (rule("midedge"), 4),
            (rule("loop"), 3),
            (rule("loop-warren"), 4),
            (rule("catmull-clark"), 3),
        ] {
            let found = every(&rule).unwrap().unwrap();
            let failed: Vec<&Condition> = found.conditions.iter().filter(|c| !c.holds).collect();
            assert!(found.proved() && found.from == from, "{rule:?}: {failed:?}");
        }
    }
}
