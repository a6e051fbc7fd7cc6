//! Certificates of spectra: discs with one root each, Jordan chains, and what shows that moduli are equal or different.

use super::{Certificate, Unsupported, number, numbers, top::elements, unsupported};
use crate::algebraic::Root;
use crate::arith::modular::{PrimeField, primes_above};
use crate::arith::{Integer, Interval, Rational, abs};
use crate::jordan::{Eigenvalue, Factor, Spectrum};
use crate::poly::Poly;
use serde_json::{Value, json};

/// Primes at which the vectors of the chains are independent are sought above this number; they must stay below 2^31.
const FIRST_PRIME: u64 = 1_000_000_000;
/// The finest enclosures that are written, in bits.
const MAX_BITS: u64 = 4096;

/// A matrix of which the spectrum was found: `None` for a matrix file, or the state and the piece of a case.
pub struct Operator<'a> {
    /// State and piece.
    pub place: Option<(usize, usize)>,
    /// The spectrum.
    pub spectrum: &'a Spectrum,
}

/// Writes the certificate of the spectra of the operators of a case that map a state into itself, in the order of the case,
/// or of the one matrix of a plain file (whose name in the certificate is `matrix`).
///
/// # Errors
/// [`Unsupported`] where equal moduli have no rule in the format.
///
/// # Cost
/// Linear in the chains, and the refinement of the roots until their discs are disjoint.
pub fn spectra(name: &str, operators: &[Operator<'_>]) -> Result<Certificate, Unsupported> {
    let items = operators.iter().map(of_operator).collect::<Result<Vec<Value>, _>>()?;
    Ok(Certificate::new("spectrum", name, "proved", json!({"spectra": items})))
}

/// The roots of a factor that are written: the real ones, and of each pair the one in the upper half plane.
fn written(factor: &Factor) -> Vec<usize> {
    (0..factor.roots.len()).filter(|&k| factor.roots[k].is_real() || is_upper(&factor.roots[k])).collect()
}

fn is_upper(root: &Root) -> bool {
    root.enclosure(64).1.lo > 0
}

fn of_operator(operator: &Operator<'_>) -> Result<Value, Unsupported> {
    let spectrum = operator.spectrum;
    let place = match operator.place {
        Some((state, piece)) => json!({"state": state, "piece": piece}),
        None => Value::Null,
    };
    let bits = precision(spectrum)?;
    let mut factors = Vec::new();
    let mut position = Vec::new();
    for (k, factor) in spectrum.factors.iter().enumerate() {
        let roots: Vec<Value> = written(factor).iter().map(|&r| disc(&factor.roots[r], bits)).collect();
        position.extend(written(factor).into_iter().map(|root| Eigenvalue { factor: k, root }));
        let chain = |c: &crate::jordan::Chain| -> Value { c.vectors.iter().map(|v| elements(v)).collect() };
        let chains: Vec<Value> = factor.right.iter().map(chain).collect();
        factors.push(json!({"polynomial": numbers(factor.poly.coeffs()), "roots": roots, "chains": chains}));
    }
    let mut classes = Vec::new();
    for (k, class) in spectrum.classes.iter().enumerate() {
        let members = position.iter().enumerate().filter(|(_, e)| class.members.contains(e));
        let (indices, members): (Vec<usize>, Vec<Eigenvalue>) = members.map(|(i, e)| (i, *e)).unzip();
        let below = match spectrum.classes.get(k + 1) {
            Some(next) => number(&between(spectrum.root(class.members[0]), spectrum.root(next.members[0]))?),
            None => Value::Null,
        };
        classes.push(json!({"members": indices, "square": square(spectrum, &members)?, "below": below}));
    }
    Ok(json!({"operator": place, "factors": factors, "modulus": modulus(spectrum)?, "classes": classes}))
}

/// How fine the discs must be: finer than a part of the distance of any two roots, and of any two moduli.
fn precision(spectrum: &Spectrum) -> Result<u64, Unsupported> {
    let roots: Vec<&Root> = spectrum.factors.iter().flat_map(|f| &f.roots).collect();
    let mut bits = 64;
    let apart = |bits: u64| {
        let boxes: Vec<(Interval, Interval)> = roots.iter().map(|r| r.enclosure(bits / 2)).collect();
        let wide = |x: &Interval, y: &Interval| x.lo <= y.hi && y.lo <= x.hi;
        (0..boxes.len()).all(|i| (0..i).all(|j| !wide(&boxes[i].0, &boxes[j].0) || !wide(&boxes[i].1, &boxes[j].1)))
    };
    let moduli = |bits: u64| {
        let pairs = spectrum.classes.windows(2);
        let lo = |e: &Eigenvalue| spectrum.root(*e).modulus(bits / 2);
        pairs.into_iter().all(|w| lo(&w[0].members[0]).lo > lo(&w[1].members[0]).hi)
    };
    while !(apart(bits) && moduli(bits)) {
        if bits >= MAX_BITS {
            return unsupported("eigenvalues this close", format!("{MAX_BITS} bits"));
        }
        bits *= 2;
    }
    Ok(2 * bits)
}

/// A disc around a short centre near the root.
fn disc(root: &Root, bits: u64) -> Value {
    if let Some(value) = root.rational() {
        return json!({"centre": [number(&value), "0"], "error": "0"});
    }
    let (re, im) = root.enclosure(2 * bits);
    let short = |x: &Interval| number(&Interval::point(x.mid()).outward(2 * bits).lo);
    let error = Rational::from(1) / Rational::from(Integer::from(1) << bits);
    let imaginary = if root.is_real() { json!("0") } else { short(&im) };
    json!({"centre": [short(&re), imaginary], "error": number(&error)})
}

/// A short rational between two moduli.
fn between(upper: &Root, lower: &Root) -> Result<Rational, Unsupported> {
    let mut bits = 32;
    loop {
        let (hi, lo) = (upper.modulus(bits).lo, lower.modulus(bits).hi);
        if lo < hi {
            return Ok((hi + lo) / Rational::from(2));
        }
        if bits > MAX_BITS {
            return unsupported("moduli this close", format!("{MAX_BITS} bits"));
        }
        bits *= 2;
    }
}

/// The rational square of the modulus of a class, where one is needed.
fn square(spectrum: &Spectrum, members: &[Eigenvalue]) -> Result<Value, Unsupported> {
    let poly = |e: &Eigenvalue| &spectrum.factor(*e).poly;
    let reflected = |p: &Poly, q: &Poly| {
        let d = degree_of(p);
        let sign = |k: usize| Rational::from(if (d - k).is_multiple_of(2) { 1 } else { -1 });
        q.degree() == Some(d) && (0..=d).all(|k| q.coeff(k) == p.coeff(k) * sign(k))
    };
    let opposite = |e: &Eigenvalue| {
        let (a, b) = (spectrum.root(members[0]), spectrum.root(*e));
        let (x, y) = (a.enclosure(128).0, b.enclosure(128).0);
        reflected(poly(&members[0]), poly(e)) && -&x.hi <= y.hi && y.lo <= -&x.lo
    };
    if members[1..].iter().all(opposite) {
        return Ok(Value::Null);
    }
    let p = poly(&members[0]);
    let d = degree_of(p);
    let guess = spectrum.factors.iter().enumerate().find_map(|(k, f)| {
        let constant = abs(&f.poly.coeff(0));
        match (members.iter().any(|m| m.factor == k), f.poly.degree()) {
            (true, Some(1)) => Some(&constant * &constant),
            (true, Some(2)) => Some(constant),
            _ => None,
        }
    });
    let guess = guess.or_else(|| (p.coeff(0) == 1 || p.coeff(0) == -1).then(|| Rational::from(1)));
    let Some(s) = guess else {
        return unsupported("equal moduli without a rational square", format!("a factor of degree {d}"));
    };
    let closed = |e: &Eigenvalue| {
        let p = poly(e);
        let d = degree_of(p);
        let power = |k: usize| (0..k).fold(Rational::from(1), |x, _| x * &s);
        (0..=d).all(|j| p.coeff(d - j) * power(d - j) == p.coeff(0) * p.coeff(j))
    };
    if members.iter().all(closed) {
        Ok(number(&s))
    } else {
        unsupported("equal moduli of roots that are not closed under inversion", format!("a factor of degree {d}"))
    }
}

/// A prime at which the determinant of the chains does not vanish.
fn modulus(spectrum: &Spectrum) -> Result<u64, Unsupported> {
    let mut rows: Vec<Vec<Rational>> = Vec::new();
    for factor in &spectrum.factors {
        let degree = degree_of(&factor.poly);
        for v in factor.right.iter().flat_map(|c| &c.vectors) {
            rows.extend((0..degree).map(|k| v.iter().map(|e| e.0.coeff(k)).collect()));
        }
    }
    match primes_above(FIRST_PRIME).take(64).find(|&p| is_regular(&rows, &PrimeField::new(p))) {
        Some(prime) => Ok(prime),
        None => unsupported("chains that are dependent at all primes tried", "modulus"),
    }
}

fn is_regular(rows: &[Vec<Rational>], field: &PrimeField) -> bool {
    let reduced = |row: &Vec<Rational>| row.iter().map(|x| field.from_rational(x)).collect::<Option<Vec<u64>>>();
    let Some(mut rows) = rows.iter().map(reduced).collect::<Option<Vec<_>>>() else { return false };
    for j in 0..rows.len() {
        let Some(i) = (j..rows.len()).find(|&i| rows[i][j] != 0) else { return false };
        rows.swap(i, j);
        let (inverse, pivot) = (field.inverse(rows[j][j]), rows[j].clone());
        for row in rows.iter_mut().skip(j + 1).filter(|row| row[j] != 0) {
            let factor = field.mul(row[j], inverse);
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x = field.sub(*x, field.mul(factor, *p)));
        }
    }
    true
}

/// The degree of a factor.
fn degree_of(p: &Poly) -> usize {
    p.degree().expect("a factor is not 0")
}
