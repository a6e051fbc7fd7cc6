//! Certificates of bounds of joint spectral radii.

use super::written::{Written, matrix, values};
use super::{Certificate, Unsupported, number, numbers, unsupported};
use crate::algebraic::Root;
use crate::arith::{Interval, Rational};
use crate::linalg::Matrix;
use crate::radius::file::File;
use crate::radius::{
    Balanced, BlockProof, Body, Disc, JointRadius, Leading, Lower, Polytope, Proof, Quadratic, System, Tree,
};
use serde_json::{Value, json};

/// How close the bounds of the certificate are to those found, in binary places.
const BITS: u64 = 80;

/// The certificate of the bounds that were found for the matrices of a file.
///
/// # Errors
/// [`Unsupported`] where no word was found, or a block has no upper bound.
pub fn radius_certificate<E: Written>(file: &File<E>, found: &JointRadius<E>) -> Result<Certificate, Unsupported> {
    let proof = headed(E::ground(&file.numbers), radius_proof(&file.system, found)?);
    Ok(Certificate::new("jsr", &file.name, "proved", proof))
}

/// A proof with what is said of a field before all else.
pub(super) fn headed(field: Option<Value>, proof: Value) -> Value {
    match (field, proof) {
        (Some(field), Value::Object(own)) => {
            Value::Object(std::iter::once(("field".to_owned(), field)).chain(own).collect())
        }
        (_, proof) => proof,
    }
}

/// The bounds that were found for a system, with what proves them.
pub(super) fn radius_proof<E: Written>(system: &System<E>, found: &JointRadius<E>) -> Result<Value, Unsupported> {
    let lower = match &found.lower {
        Some(lower) => below(&system.product(&lower.path), lower)?.0,
        None => Value::Null,
    };
    let bases: Vec<Value> = (0..system.dims.len())
        .map(|s| {
            let columns = found.flag.iter().flat_map(|step| (0..step.frame[s].cols()).map(|j| step.frame[s].column(j)));
            columns.map(|c| values(&c)).collect()
        })
        .collect();
    let mut proofs = found.blocks.iter();
    let mut blocks = Vec::new();
    let mut upper = Rational::from(0);
    for step in &found.flag {
        let dims: Vec<usize> = step.frame.iter().map(Matrix::cols).collect();
        let (norm, bound) = match &step.block {
            None => (json!({"norm": "zero"}), Rational::from(0)),
            Some(_) => match proofs.next() {
                Some(proof) => above(proof)?,
                None => return unsupported("a block without a proof", "blocks"),
            },
        };
        upper = upper.max(bound.clone());
        blocks.push(json!({"dims": dims, "bound": number(&bound), "norm": norm}));
    }
    if proofs.next().is_some() {
        return unsupported("a proof without a block", "blocks");
    }
    Ok(json!({"lower": lower, "upper": number(&upper), "bases": bases, "blocks": blocks}))
}

/// What a certificate says of a lower bound, with that bound: it may be smaller than the value of the word.
///
/// # Errors
/// [`Unsupported`] where the format cannot express the eigenvalue.
pub(super) fn stated<E: Written>(system: &System<E>, lower: &Lower) -> Result<Rational, Unsupported> {
    Ok(below(&system.product(&lower.path), lower)?.1)
}

/// Two eigenvalues of equal modulus with a rational bound; or a disc that holds an eigenvalue of the product, and a rational below
/// its modulus to the power `1/length`.
fn below<E: Written>(product: &Matrix<E>, lower: &Lower) -> Result<(Value, Rational), Unsupported> {
    let irrational = lower.root().filter(|root| root.rational().is_none());
    if let (Some(root), Some(bound)) = (irrational, lower.rational()) {
        // Its minimal polynomial has degree 2.
        let pair: Vec<Rational> = root.minpoly().monic().coeffs().iter().take(2).cloned().collect();
        return Ok((json!({"word": lower.path, "pair": numbers(&pair), "bound": number(&bound)}), bound));
    }
    let disc = match (&lower.eigenvalue, lower.root().and_then(Root::rational)) {
        (_, Some(x)) => Disc { centre: (x, Rational::from(0)), error: Rational::from(0) },
        (Leading::Disc(disc), None) => disc.clone(),
        (Leading::Exact(root), None) => {
            let (re, im) = root.enclosure(2 * BITS);
            let y = if root.is_real() { Rational::from(0) } else { im.mid() };
            match Disc::around(&E::char_poly(product), &re.mid(), &y) {
                Some(disc) => disc,
                None => return unsupported("a multiple eigenvalue", format!("{:?}", lower.path)),
            }
        }
    };
    let error = Interval::point(disc.error.clone()).outward(4 * BITS).hi;
    let exact = if error == 0 { lower.rational() } else { None };
    let bound = exact.unwrap_or_else(|| {
        let square = &disc.centre.0 * &disc.centre.0 + &disc.centre.1 * &disc.centre.1;
        let modulus = crate::radius::square_root(&square, 2 * BITS).lo - &error;
        crate::radius::root_floor(&modulus.max(Rational::from(0)), lower.length, BITS)
    });
    let value = json!({
        "word": lower.path,
        "centre": [number(&disc.centre.0), number(&disc.centre.1)],
        "error": number(&error),
        "bound": number(&bound),
    });
    Ok((value, bound))
}

fn above<E: Written>(proof: &BlockProof<E>) -> Result<(Value, Rational), Unsupported> {
    let (Some(data), Some(bound)) = (&proof.proof, &proof.bound) else {
        return unsupported("a block without an upper bound", format!("{:?}", proof.block.states));
    };
    let names = Names { proof };
    Ok((names.norm(data), bound.clone()))
}

/// Names the states and arrows of a block as those of the whole system.
struct Names<'a, E> {
    proof: &'a BlockProof<E>,
}

impl<E: Written> Names<'_, E> {
    fn state(&self, state: usize) -> usize {
        self.proof.block.states[state]
    }

    fn arrow(&self, arrow: usize) -> usize {
        self.proof.block.system.arrows[arrow].label
    }

    fn norm(&self, data: &Proof<E>) -> Value {
        match data {
            Proof::Polytope(p) => self.polytope(p),
            Proof::Quadratic(q) => self.quadratic(q),
            Proof::Balanced(p) => self.balanced(p),
            Proof::Tree(t) => self.tree(t),
            Proof::Transposed(inner) => json!({"norm": "transposed", "of": self.norm(inner)}),
        }
    }

    fn axes<T>(&self, axes: &[Vec<Vec<T>>], term: impl Fn(&T) -> Value) -> Value {
        let unit = |terms: &Vec<T>| terms.iter().map(&term).collect::<Value>();
        let state = |(s, units): (usize, &Vec<Vec<T>>)| json!({"state": self.state(s), "units": units.iter().map(unit).collect::<Value>()});
        axes.iter().enumerate().map(state).collect()
    }

    fn polytope(&self, p: &Polytope<E>) -> Value {
        let term = |(k, c): &(usize, E)| json!([k, c.value()]);
        let points =
            p.points.iter().map(|q| json!({"state": self.state(q.state), "coordinates": values(&q.coordinates)}));
        let inclusions = p.inclusions.iter().map(|i| {
            let terms: Value = i.terms.iter().map(term).collect();
            json!({"point": i.point, "arrow": self.arrow(i.arrow), "terms": terms})
        });
        json!({
            "norm": if p.body == Body::Symmetric { "symmetric" } else { "monotone" },
            "points": points.collect::<Value>(),
            "inclusions": inclusions.collect::<Value>(),
            "axes": self.axes(&p.axes, term),
        })
    }

    fn balanced(&self, p: &Balanced) -> Value {
        let complex = |z: &(Rational, Rational)| json!([number(&z.0), number(&z.1)]);
        let term = |(k, c): &(usize, (Rational, Rational))| json!([k, number(&c.0), number(&c.1)]);
        let points = p.points.iter().map(|q| {
            json!({"state": self.state(q.state), "coordinates": q.coordinates.iter().map(complex).collect::<Value>()})
        });
        let inclusions = p.inclusions.iter().map(|i| {
            let terms: Value = i.terms.iter().map(term).collect();
            json!({"point": i.point, "arrow": self.arrow(i.arrow), "terms": terms})
        });
        json!({
            "norm": "balanced",
            "points": points.collect::<Value>(),
            "inclusions": inclusions.collect::<Value>(),
            "axes": self.axes(&p.axes, term),
        })
    }

    fn quadratic(&self, q: &Quadratic<E>) -> Value {
        let forms = q.forms.iter().enumerate();
        let forms = forms.map(|(s, m)| json!({"state": self.state(s), "form": matrix(m)}));
        json!({"norm": "quadratic", "forms": forms.collect::<Value>(), "square": number(&q.square)})
    }

    fn tree(&self, t: &Tree) -> Value {
        let word = |w: &Vec<usize>| w.iter().map(|a| self.arrow(*a)).collect::<Vec<_>>();
        let codes = t.codes.iter().zip(&t.weights).enumerate().map(|(s, (code, weights))| {
            json!({"state": self.state(s), "weights": numbers(weights), "words": code.iter().map(word).collect::<Vec<_>>()})
        });
        json!({"norm": "tree", "codes": codes.collect::<Value>()})
    }
}
