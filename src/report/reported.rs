//! Reports over the rationals and over a real number field: what each can say.

use super::document::{Block, Line, line, words};
use super::math::Math;
use super::proof::Quoted;
use super::values::{elem_math, lambda_math, polynomial};
use super::words::root_of;
use super::{every, proof, reasons};
use crate::algebraic::{Elem, Real, Root};
use crate::arith::Rational;
use crate::case::Case;
use crate::certificate::{self, Certificate, Unsupported, Written};
use crate::jordan::Part;
use crate::linalg::{Entry, Matrix};
use crate::shape::Shape;
use crate::theorem::cone::{Cone, ConeMap};
use crate::theorem::local::{LocalContext, LocalSide};
use crate::theorem::surface::Surface;
use crate::theorem::{Certified, PointReport, Statement, field};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Binary digits of the entries from which a shape over a field is drawn.
const PICTURE_BITS: u64 = 64;

/// Entries of shapes on which there are reports.
pub trait Reported: Written {
    /// The number as a formula.
    fn math(&self) -> Math;
    /// An element of the field of an eigenvalue, where its generator has this place.
    fn element(x: &Elem, place: &Root) -> Math;
    /// What stands for the generator of that field where some of these elements are irrational.
    fn letters(factor: Part<'_>, place: &Root, elements: &[&Elem]) -> Line;
    /// The generator of the field of a functional, after a comma.
    fn place_line(place: &Root) -> Line;
    /// The characteristic polynomial.
    fn characteristic_math(spectrum: &Self::Spectrum) -> Math;
    /// The certificate.
    ///
    /// # Errors
    /// What it cannot hold.
    fn certificate(case: &Case<Self>, found: &Certified<Self>) -> Result<Certificate, Unsupported>;
    /// The sections of a proof about the points of a surface; with `whole` also about every point.
    fn surface_section(_: &Case<Self>, _: &Surface, _whole: bool, _: &mut Quoted) -> Vec<Block> {
        Vec::new()
    }
    /// The section of a proof about every point of a curve.
    fn every_section(case: &Case<Self>, found: &Certified<Self>, seen: &mut Quoted) -> Vec<Block>;
    /// The shape with rational entries, to be drawn: nothing is proved of it.
    fn drawn(shape: &Shape<Self>) -> Cow<'_, Shape>;
    /// A rational number where this one is drawn.
    fn near(&self) -> Rational;
    /// The field of the entries, where they are not rational.
    fn field_text(_: &Shape<Self>) -> Option<String> {
        None
    }
    /// What is known of every point of a curve.
    fn every_facts(_: &Case<Self>, _: &Certified<Self>) -> Option<Vec<(String, Line)>> {
        None
    }
    /// The same in one sentence.
    fn every_sentence(_: &Certified<Self>) -> Option<String> {
        None
    }
    /// The same as data.
    fn every_value(_: &Certified<Self>) -> Value {
        Value::Null
    }
    /// Critical orders and local derivatives, by point.
    fn local_sides(_: &Case<Self>, _: &Certified<Self>) -> Vec<Vec<LocalSide>> {
        Vec::new()
    }
    /// The table of results where there is none of points.
    fn results(_: &Case<Self>, _: &Certified<Self>) -> Option<Block> {
        None
    }
}

/// A point or vector as a tuple.
#[must_use]
pub fn vector<E: Reported>(v: &[E]) -> Math {
    Math::tuple(v.iter().map(E::math).collect())
}

/// A matrix as a formula.
#[must_use]
pub fn entries<E: Reported>(m: &Matrix<E>) -> Math {
    Math::Matrix((0..m.rows()).map(|i| m.row(i).iter().map(E::math).collect()).collect())
}

impl Reported for Rational {
    fn math(&self) -> Math {
        Math::number(self)
    }

    fn element(x: &Elem, _: &Root) -> Math {
        elem_math(x)
    }

    fn letters(_: Part<'_>, _: &Root, _: &[&Elem]) -> Line {
        words(" Coordinates that contain λ are polynomials in it.")
    }

    fn place_line(place: &Root) -> Line {
        let mut out = line(", $@$", [lambda_math(place)]);
        out.extend(root_of(place));
        out
    }

    fn characteristic_math(spectrum: &Self::Spectrum) -> Math {
        polynomial(&spectrum.char_poly, 'x')
    }

    fn certificate(case: &Case, found: &Certified) -> Result<Certificate, Unsupported> {
        certificate::certificate(case, found)
    }

    fn surface_section(case: &Case, surface: &Surface, whole: bool, seen: &mut Quoted) -> Vec<Block> {
        proof::surface_section(case, surface, whole, seen)
    }

    fn every_section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
        proof::every_section(case, found, seen)
    }

    fn drawn(shape: &Shape) -> Cow<'_, Shape> {
        Cow::Borrowed(shape)
    }

    fn near(&self) -> Rational {
        self.clone()
    }

    fn every_facts(case: &Case, found: &Certified) -> Option<Vec<(String, Line)>> {
        Some(every::facts(case, found, found.everywhere.as_ref()?))
    }

    fn every_sentence(found: &Certified) -> Option<String> {
        reasons::everywhere(found, found.everywhere.as_ref()?)
    }

    fn every_value(found: &Certified) -> Value {
        every::value(found)
    }

    fn local_sides(case: &Case, found: &Certified) -> Vec<Vec<LocalSide>> {
        let Some(context) = LocalContext::new(&case.shape, found) else { return Vec::new() };
        let of = |p: &PointReport| p.branches.iter().flat_map(|b| context.sides(b)).collect();
        found.points.iter().map(of).collect()
    }

    fn results(case: &Case, found: &Certified) -> Option<Block> {
        proof::results_table(case, found)
    }
}

/// `d` where a generator of a field is the positive square root of `d`.
fn square_root(place: &Root) -> Option<Rational> {
    match place.minpoly().coeffs() {
        [c, linear, _] if *linear == 0 && place.sign() > 0 => Some(-c),
        _ => None,
    }
}

/// `a + b √d`.
fn in_root(coefficients: &[Rational], d: &Rational) -> Math {
    let part = |k: usize| coefficients.get(k).cloned().unwrap_or_default();
    let (a, b) = (part(0), part(1));
    if b == 0 {
        return Math::number(&a);
    }
    let mut row = Vec::new();
    if a != 0 {
        row.push(Math::number(&a));
    }
    match (b < 0, row.is_empty()) {
        (true, _) => row.push(Math::Symbol('−')),
        (false, false) => row.push(Math::Symbol('+')),
        (false, true) => {}
    }
    let size = crate::arith::abs(&b);
    if size != 1 {
        row.push(Math::number(&size));
    }
    row.push(Math::Root(Box::new(Math::number(d))));
    Math::Row(row)
}

/// An element of a field in a square root, or in a letter for the generator.
fn in_letter(x: &Elem, place: &Root, letter: char) -> Math {
    match (x.is_rational(), square_root(place)) {
        (Some(q), _) => Math::number(&q),
        (None, Some(d)) => in_root(x.0.coeffs(), &d),
        (None, None) => polynomial(&x.0, letter),
    }
}

/// A polynomial over a number field, its constant coefficient first; coefficients of several terms in brackets.
fn over_field(coefficients: &[Math]) -> Math {
    let mut row = Vec::new();
    for (k, c) in coefficients.iter().enumerate().rev() {
        if *c == Math::count(0) {
            continue;
        }
        let negative = matches!(c, Math::Number(x) if *x < 0);
        if negative || !row.is_empty() {
            row.push(Math::Symbol(if negative { '−' } else { '+' }));
        }
        match c {
            one if k > 0 && *one == Math::count(1) => {}
            Math::Number(x) => row.push(Math::Number(crate::arith::abs(x))),
            _ => row.extend([Math::Symbol('('), c.clone(), Math::Symbol(')')]),
        }
        if k > 0 {
            row.push(super::math::power(Math::Letter('x'), k));
        }
    }
    Math::Row(row)
}

impl Reported for Real {
    /// A polynomial in `α`; in a quadratic field of a square root, with that root.
    fn math(&self) -> Math {
        let Some(field) = self.field() else {
            return Math::number(&self.enclosure(0).lo);
        };
        let coefficients = self.elem().0.coeffs().to_vec();
        match field.poly().coeffs() {
            [c, linear, _] if *linear == 0 && field.label().is_some() => in_root(&coefficients, &-c),
            _ => Math::polynomial(&coefficients, 'α'),
        }
    }

    fn element(x: &Elem, place: &Root) -> Math {
        in_letter(x, place, 'θ')
    }

    fn letters(factor: Part<'_>, place: &Root, elements: &[&Elem]) -> Line {
        if square_root(place).is_some() || elements.iter().all(|x| x.is_rational().is_some()) {
            return Line::new();
        }
        let mut out = line(
            " Coordinates that contain $θ$ are polynomials in it: it is the root of $@$ near $@$, ",
            [
                polynomial(place.minpoly(), 'x'),
                super::values::decimal_math(&place.enclosure(PICTURE_BITS).0.mid(), super::values::DIGITS),
            ],
        );
        let named = [('α', factor.over.alpha), ('λ', factor.lambda)];
        for (k, (letter, x)) in named.into_iter().filter_map(|(l, x)| Some((l, x?))).enumerate() {
            let and = if k > 0 { " and $@=@$" } else { "and $@=@$" };
            out.extend(line(and, [Math::Letter(letter), polynomial(&x.0, 'θ')]));
        }
        out.extend(words("."));
        out
    }

    fn place_line(place: &Root) -> Line {
        if square_root(place).is_some() {
            return Line::new();
        }
        line(
            ", $θ$ the root of $@$ near $@$",
            [
                polynomial(place.minpoly(), 'x'),
                super::values::decimal_math(&place.enclosure(PICTURE_BITS).0.mid(), super::values::DIGITS),
            ],
        )
    }

    /// The product of the factors that are irreducible over the field of the matrix.
    fn characteristic_math(spectrum: &Self::Spectrum) -> Math {
        let place = spectrum.field.generator();
        let factor = |f: &crate::jordan::FieldFactor| {
            let coefficients: Vec<Math> = f.poly.iter().map(|c| in_letter(c, place, 'α')).collect();
            let bracket = Math::Row(vec![Math::Symbol('('), over_field(&coefficients), Math::Symbol(')')]);
            super::math::power(bracket, f.multiplicity)
        };
        Math::Row(spectrum.factors.iter().map(factor).collect())
    }

    fn certificate(case: &Case<Self>, found: &Certified<Self>) -> Result<Certificate, Unsupported> {
        certificate::flat_certificate(case, found)
    }

    fn every_section(case: &Case<Self>, found: &Certified<Self>, seen: &mut Quoted) -> Vec<Block> {
        proof::cones_section(case, found, seen)
    }

    fn drawn(shape: &Shape<Self>) -> Cow<'_, Shape> {
        Cow::Owned(shape.rounded(PICTURE_BITS))
    }

    fn near(&self) -> Rational {
        self.enclosure(PICTURE_BITS).mid()
    }

    fn every_facts(case: &Case<Self>, found: &Certified<Self>) -> Option<Vec<(String, Line)>> {
        let mut facts = Vec::new();
        if found.graph.is_some() {
            facts.push(("derivative".to_owned(), line(every::GRAPH, [])));
        }
        let Some(cones) = found.cones.as_ref() else { return (!facts.is_empty()).then_some(facts) };
        for cone in &cones.cones {
            let place = if case.shape.states.len() > 1 {
                format!(" of state {}", case.shape.states[cone.state].name)
            } else {
                String::new()
            };
            let rays = Math::Row(
                (0..cone.rays.cols())
                    .flat_map(|j| {
                        let comma = (j > 0).then_some(Math::Symbol(','));
                        comma.into_iter().chain([vector(&cone.rays.column(j))])
                    })
                    .collect(),
            );
            let text = "every piece maps the cone of its target into the inside of this one, and the first-level joints are \
                        regular; rays $@$";
            facts.push((format!("cone{place}"), line(text, [rays])));
        }
        Some(facts)
    }

    fn every_value(found: &Certified<Self>) -> Value {
        if found.graph.is_some() {
            return json!({"verdict": "proved", "theorem": Statement::Graph.id()});
        }
        let Some(found) = &found.cones else { return Value::Null };
        let texts = |v: &[Self]| v.iter().map(ToString::to_string).collect::<Vec<_>>();
        let rows = |m: &Matrix<Self>| (0..m.rows()).map(|i| texts(m.row(i))).collect::<Vec<_>>();
        let cone = |c: &Cone<Self>| {
            let rays: Vec<_> = (0..c.rays.cols()).map(|j| texts(&c.rays.column(j))).collect();
            json!({"state": c.state, "rays": rays, "functional": texts(&c.functional), "chord": texts(&c.chord)})
        };
        let map = |m: &ConeMap<Self>| json!({"state": m.state, "letter": m.letter, "sign": m.sign, "matrix": rows(&m.matrix)});
        json!({
            "verdict": "proved",
            "theorem": Statement::Theorem6.id(),
            "cones": found.cones.iter().map(cone).collect::<Vec<_>>(),
            "maps": found.maps.iter().map(map).collect::<Vec<_>>(),
            "view": found.view.as_ref().map(|h| texts(h)),
        })
    }

    fn field_text(shape: &Shape<Self>) -> Option<String> {
        Some(field(shape).describe()).filter(|text| text != "Q")
    }
}
