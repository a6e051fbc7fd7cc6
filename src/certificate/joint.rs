//! Certificates of bounds of joint spectral radii.

use super::{Certificate, Unsupported, number, numbers, unsupported};
use crate::arith::{Interval, Rational};
use crate::linalg::Matrix;
use crate::radius::file::File;
use crate::radius::{Balanced, BlockProof, Body, JointRadius, Lower, Polytope, Proof, Quadratic, System, Tree};
use serde_json::{Value, json};

/// How close the bounds of the certificate are to those found, in binary places.
const BITS: u64 = 80;

/// The certificate of the bounds that were found for the matrices of a file.
///
/// # Errors
/// [`Unsupported`] where no word was found, or a block has no upper bound.
pub fn radius_certificate(file: &File, found: &JointRadius) -> Result<Certificate, Unsupported> {
    Ok(Certificate::new("jsr", &file.name, "proved", radius_proof(&file.system, found)?))
}

/// The bounds that were found for a system, with what proves them.
pub(super) fn radius_proof(system: &System, found: &JointRadius) -> Result<Value, Unsupported> {
    let lower = match &found.lower {
        Some(lower) => below(&system.product(&lower.path), lower)?,
        None => Value::Null,
    };
    let bases: Vec<Value> = (0..system.dims.len())
        .map(|s| {
            let columns = found.flag.iter().flat_map(|step| (0..step.frame[s].cols()).map(|j| step.frame[s].column(j)));
            columns.map(|c| numbers(&c)).collect()
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
    Ok(json!({"lower": lower, "upper": number(&upper), "bases": bases, "blocks": blocks}))
}

/// A disc that holds an eigenvalue of the product, and a rational below its modulus to the power `1/length`.
fn below(product: &Matrix, lower: &Lower) -> Result<Value, Unsupported> {
    let (re, im) = match lower.root.rational() {
        Some(x) => (Interval::point(x), Interval::point(Rational::from(0))),
        None => lower.root.enclosure(2 * BITS),
    };
    let (x, y) = (re.mid(), if lower.root.is_real() { Rational::from(0) } else { im.mid() });
    let error = match lower.root.rational() {
        Some(_) => Rational::from(0),
        None => Interval::point(disc(product, &x, &y)).outward(2 * BITS).hi,
    };
    let exact = if error == 0 { lower.rational() } else { None };
    let bound = match exact {
        Some(bound) => bound,
        None => {
            let square = &x * &x + &y * &y;
            let modulus = crate::radius::square_root(&square, 2 * BITS).lo - &error;
            crate::radius::root_floor(&modulus.max(Rational::from(0)), lower.length, BITS)
        }
    };
    Ok(json!({
        "word": lower.path,
        "centre": [number(&x), number(&y)],
        "error": number(&error),
        "bound": number(&bound),
    }))
}

/// An upper bound of `n |χ/χ'|` at `x + iy`.
fn disc(product: &Matrix, x: &Rational, y: &Rational) -> Rational {
    let chi = crate::jordan::Spectrum::of(product).char_poly;
    let value = |coeffs: &[Rational]| {
        let (a, b) = coeffs
            .iter()
            .rev()
            .fold((Rational::from(0), Rational::from(0)), |(a, b), c| (&a * x - &b * y + c, a * y + b * x));
        &a * &a + &b * &b
    };
    let derivative: Vec<Rational> =
        chi.coeffs().iter().enumerate().skip(1).map(|(k, c)| c * Rational::from(k as u64)).collect();
    let bottom = value(&derivative);
    if bottom == 0 {
        return Rational::from(1);
    }
    let n = Rational::from(product.rows() as u64);
    crate::radius::square_root(&(value(chi.coeffs()) / bottom), 4 * BITS).hi * n
}

fn above(proof: &BlockProof) -> Result<(Value, Rational), Unsupported> {
    let (Some(data), Some(bound)) = (&proof.proof, &proof.bound) else {
        return unsupported("a block without an upper bound", format!("{:?}", proof.block.states));
    };
    let names = Names { proof };
    let norm = match data {
        Proof::Polytope(p) => names.polytope(p),
        Proof::Quadratic(q) => names.quadratic(q),
        Proof::Balanced(p) => names.balanced(p),
        Proof::Tree(t) => names.tree(t),
    };
    Ok((norm, bound.clone()))
}

/// Names the states and arrows of a block as those of the whole system.
struct Names<'a> {
    proof: &'a BlockProof,
}

impl Names<'_> {
    fn state(&self, state: usize) -> usize {
        self.proof.block.states[state]
    }

    fn arrow(&self, arrow: usize) -> usize {
        self.proof.block.system.arrows[arrow].label
    }

    fn axes<T>(&self, axes: &[Vec<Vec<T>>], term: impl Fn(&T) -> Value) -> Value {
        let unit = |terms: &Vec<T>| terms.iter().map(&term).collect::<Value>();
        let state = |(s, units): (usize, &Vec<Vec<T>>)| json!({"state": self.state(s), "units": units.iter().map(unit).collect::<Value>()});
        axes.iter().enumerate().map(state).collect()
    }

    fn polytope(&self, p: &Polytope) -> Value {
        let term = |(k, c): &(usize, Rational)| json!([k, number(c)]);
        let points =
            p.points.iter().map(|q| json!({"state": self.state(q.state), "coordinates": numbers(&q.coordinates)}));
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

    fn quadratic(&self, q: &Quadratic) -> Value {
        let matrix = |m: &Matrix| (0..m.rows()).map(|i| numbers(m.row(i))).collect::<Value>();
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
