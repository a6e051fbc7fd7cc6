//! Reports over the rationals and over a real number field: what each can say.

use super::document::{Block, Line, line};
use super::math::Math;
use super::{every, proof, reasons};
use crate::algebraic::Real;
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::{Entry, Matrix};
use crate::shape::Shape;
use crate::theorem::cone::{Cone, ConeMap};
use crate::theorem::local::{LocalContext, LocalSide};
use crate::theorem::{Certified, PointReport, Provable, Statement, field};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Binary digits of the entries from which a shape over a field is drawn.
const PICTURE_BITS: u64 = 64;

/// Entries of shapes on which there are reports.
pub trait Reported: Provable {
    /// The number as a formula.
    fn math(&self) -> Math;
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

impl Reported for Rational {
    fn math(&self) -> Math {
        Math::number(self)
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

impl Reported for Real {
    /// A polynomial in `α`; in a quadratic field of a square root, with that root.
    fn math(&self) -> Math {
        let Some(field) = self.field() else {
            return Math::number(&self.enclosure(0).lo);
        };
        let coefficients = self.elem().0.coeffs().to_vec();
        let square = match field.poly().coeffs() {
            [c, linear, _] if *linear == 0 && field.label().is_some() => -c,
            _ => return Math::polynomial(&coefficients, 'α'),
        };
        let mut row = Vec::new();
        if coefficients[0] != 0 {
            row.push(Math::number(&coefficients[0]));
        }
        match (coefficients[1] < 0, row.is_empty()) {
            (true, _) => row.push(Math::Symbol('−')),
            (false, false) => row.push(Math::Symbol('+')),
            (false, true) => {}
        }
        let size = crate::arith::abs(&coefficients[1]);
        if size != 1 {
            row.push(Math::number(&size));
        }
        row.push(Math::Root(Box::new(Math::number(&square))));
        Math::Row(row)
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
