//! How entries of a shape, rational or in a real number field, and what rests on them are written.

use super::top::{element, mirrored, rational_conformal};
use super::{Further, Unsupported, everywhere, frames, number, numbers, unsupported};
use crate::algebraic::field::NumberField;
use crate::algebraic::{Elem, Real};
use crate::arith::{Integer, Natural, Rational};
use crate::case::Case;
use crate::jordan::{Eigenvalue, FieldSpectrum, Spectral, Spectrum};
use crate::linalg::{Entry, Matrix};
use crate::shape::Shape;
use crate::theorem::{Certified, Frames, PointReport, Provable};
use malachite_base::num::arithmetic::traits::{Lcm, Pow};
use serde_json::{Value, json};

/// A chain at one of the eigenvalues of a class, over the field of the leading one: whether it belongs to that eigenvalue, or to
/// its opposite, and its vectors.
pub type Aligned = (bool, Vec<Vec<Elem>>);

/// Binary places of the interval of the generator of a field.
const WIDTH: u64 = 80;

/// The index of a point in the list of a certificate.
pub type Listed<'a, E> = &'a dyn Fn(&PointReport<E>) -> Result<usize, Unsupported>;

/// Entries of shapes for whose verdicts there are certificates.
pub trait Written: Provable {
    /// Binary places of the intervals of the generators of fields of eigenvalues.
    const PLACES: u64;
    /// Binary places of the intervals of coordinates that lines have in common.
    const COMMON: u64;

    /// Whether the entries may be irrational.
    const IRRATIONAL: bool;

    /// The number.
    fn value(&self) -> Value;
    /// What a certificate says of the field of a case; nothing of the rational numbers.
    ///
    /// # Errors
    /// [`Unsupported`] where the numbers of the text do not lie in the field of the entries.
    fn field(case: &Case<Self>) -> Result<Option<Value>, Unsupported>;
    /// What a certificate says of the field of numbers, which are the roots and cosines in a text; nothing of the rational numbers.
    fn ground(numbers: &[Self]) -> Option<Value>;
    /// The text of the case that is checked.
    fn text(case: &Case<Self>) -> String;
    /// The polynomial of the field of the eigenvalues of a factor.
    fn modulus(spectrum: &Self::Spectrum, factor: usize) -> Value;
    /// The characteristic polynomial of a matrix with a spectrum, lowest coefficient first.
    fn characteristic(spectrum: &Self::Spectrum) -> Vec<Self>;
    /// The chains of a class over the field of one of its eigenvalues; `None` where they are not known there.
    fn aligned(spectrum: &Self::Spectrum, lead: Eigenvalue) -> Option<Vec<Aligned>>;
    /// Evidence of the form `conformal` for the top of a spectrum.
    fn conformal(linear: &Matrix<Self>, spectrum: &Self::Spectrum, radius: &Rational) -> Option<Value>;
    /// What encloses the attractors besides balls, where that is the same for all states.
    fn simplex(shape: &Shape<Self>) -> Option<Value>;
    /// The frames of a dense set.
    ///
    /// # Errors
    /// [`Unsupported`] where the format cannot express them.
    fn frames(shape: &Shape<Self>, frames: &Frames) -> Result<Value, Unsupported>;
    /// The answer about every point of a curve.
    ///
    /// # Errors
    /// [`Unsupported`] where the format cannot express what was found.
    fn every(shape: &Shape<Self>, found: &Certified<Self>, position: Listed<'_, Self>) -> Further;
}

/// A vector of numbers.
pub fn values<E: Written>(v: &[E]) -> Value {
    v.iter().map(E::value).collect()
}

/// A matrix by rows.
pub fn matrix<E: Written>(m: &Matrix<E>) -> Value {
    (0..m.rows()).map(|i| values(m.row(i))).collect()
}

impl Written for Rational {
    const PLACES: u64 = 160;
    const COMMON: u64 = 100;
    const IRRATIONAL: bool = false;

    fn value(&self) -> Value {
        number(self)
    }

    fn field(_: &Case) -> Result<Option<Value>, Unsupported> {
        Ok(None)
    }

    fn ground(_: &[Self]) -> Option<Value> {
        None
    }

    fn text(case: &Case) -> String {
        case.checked_text().into_owned()
    }

    fn modulus(spectrum: &Spectrum, factor: usize) -> Value {
        numbers(spectrum.factors[factor].poly.coeffs())
    }

    fn characteristic(spectrum: &Spectrum) -> Vec<Self> {
        spectrum.char_poly.coeffs().to_vec()
    }

    fn aligned(spectrum: &Spectrum, lead: Eigenvalue) -> Option<Vec<Aligned>> {
        let mut chains = Vec::new();
        for &member in &spectrum.classes[0].members {
            let same = spectrum.root(member).same(spectrum.root(lead));
            let of = &spectrum.factor(member).right;
            chains.extend(of.iter().map(|c| (same, c.vectors.iter().map(|v| mirrored(v, same)).collect())));
        }
        Some(chains)
    }

    fn conformal(linear: &Matrix, spectrum: &Spectrum, radius: &Rational) -> Option<Value> {
        rational_conformal(linear, spectrum, radius)
    }

    fn simplex(_: &Shape) -> Option<Value> {
        None
    }

    fn frames(shape: &Shape, found: &Frames) -> Result<Value, Unsupported> {
        frames::frames(shape, found)
    }

    fn every(shape: &Shape, found: &Certified, position: Listed<'_, Self>) -> Further {
        everywhere::answer(shape, found, position)
    }
}

/// A positive integer that makes the generator of a field an algebraic integer.
fn denominator(field: &NumberField) -> Rational {
    let denominators = field.poly().coeffs().iter().map(|c| c.denominator_ref().clone());
    Rational::from(denominators.fold(Natural::from(1u32), Lcm::lcm))
}

/// The element as one in the multiple of the generator by a number.
fn in_multiple(x: &Elem, factor: &Rational) -> Value {
    let mut power = Rational::from(1);
    let mut coefficients = Vec::new();
    for c in x.0.coeffs() {
        coefficients.push(c / &power);
        power *= factor;
    }
    numbers(&coefficients)
}

/// What a certificate says of a field.
fn ground(field: &NumberField, numbers: &[Real]) -> Value {
    let factor = denominator(field);
    let degree = field.degree() as u64;
    let scaled = field.poly().coeffs().iter().zip(0..).map(|(c, k): (_, u64)| c * (&factor).pow(degree - k));
    // Wide enough for enclosures of the generator in other fields.
    let interval = field.generator().enclosure(2 * WIDTH).0.outward(WIDTH);
    let more = Rational::from(1) / Rational::from(Integer::from(1) << WIDTH);
    json!({
        "polynomial": super::numbers(&scaled.collect::<Vec<_>>()),
        "interval": [number(&((interval.lo - &more) * &factor)), number(&((interval.hi + &more) * &factor))],
        "numbers": values(numbers),
    })
}

impl Written for Real {
    const PLACES: u64 = 256;
    const COMMON: u64 = 60;
    const IRRATIONAL: bool = true;

    fn value(&self) -> Value {
        match self.field() {
            Some(field) => in_multiple(&self.elem(), &denominator(field)),
            // Without a field it is rational.
            None => number(&self.elem().0.coeff(0)),
        }
    }

    fn field(case: &Case<Self>) -> Result<Option<Value>, Unsupported> {
        let field = crate::theorem::field(&case.shape);
        if field.is_rational() {
            return unsupported("rational entries that are written as expressions", case.name.clone());
        }
        let Some(written) = &case.numbers else {
            return unsupported("roots and cosines that do not lie in the field of the entries", case.name.clone());
        };
        Ok(Some(ground(&field, written)))
    }

    fn ground(numbers: &[Self]) -> Option<Value> {
        Some(ground(&*Self::field_of(numbers)?, numbers))
    }

    fn text(case: &Case<Self>) -> String {
        case.checked_over_field().into_owned()
    }

    fn modulus(spectrum: &FieldSpectrum, factor: usize) -> Value {
        let f = &spectrum.factors[factor];
        json!({
            "modulus": numbers(f.generator.coeffs()),
            "alpha": element(&f.alpha.scale(&denominator(&spectrum.field))),
            "value": element(&f.lambda),
        })
    }

    fn characteristic(spectrum: &FieldSpectrum) -> Vec<Self> {
        let field = std::sync::Arc::new(spectrum.field.clone());
        let mut product = vec![Self::integer(1)];
        for f in &spectrum.factors {
            let factor: Vec<Self> = f.poly.iter().map(|c| Self::new(&field, c.clone())).collect();
            for _ in 0..f.multiplicity {
                let mut next = vec![Self::zero(); product.len() + factor.len() - 1];
                for (i, a) in product.iter().enumerate() {
                    for (j, b) in factor.iter().enumerate() {
                        next[i + j] = next[i + j].plus(&a.times(b));
                    }
                }
                product = next;
            }
        }
        product
    }

    fn aligned(spectrum: &FieldSpectrum, lead: Eigenvalue) -> Option<Vec<Aligned>> {
        let leading = spectrum.part(lead.factor);
        let (theta, lambda) = (&leading.places[lead.root], &leading.roots[lead.root]);
        let mut chains = Vec::new();
        for &member in &spectrum.classes()[0].members {
            let part = spectrum.part(member.factor);
            let own = part.places[member.root].same(theta) && part.over.alpha == leading.over.alpha;
            let same = part.roots[member.root].same(lambda);
            chains.extend(own.then(|| part.right.iter().map(move |c| (same, c.vectors.clone())))?);
        }
        Some(chains)
    }

    fn conformal(_: &Matrix<Self>, _: &FieldSpectrum, _: &Rational) -> Option<Value> {
        None
    }

    fn simplex(shape: &Shape<Self>) -> Option<Value> {
        let mut entries = shape.reachable().into_iter().flat_map(|e| &shape.states[e].pieces).map(|p| p.op.entries());
        entries.all(|op| op.iter().all(|x| x.sign() >= 0)).then(|| json!("simplex"))
    }

    fn frames(shape: &Shape<Self>, _: &Frames) -> Result<Value, Unsupported> {
        unsupported("frames over a number field", shape.states[shape.start].name.clone())
    }

    fn every(shape: &Shape<Self>, found: &Certified<Self>, position: Listed<'_, Self>) -> Further {
        everywhere::over_field(shape, found, position)
    }
}
