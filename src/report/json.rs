//! The JSON report, version 1; documented in `docs/json.md`.

use super::claims;
use super::reasons;
use super::reported::Reported;
use super::text::math_line;
use super::values::{decimal, direction_decimals, elem_math, exponent, root_decimals};
use super::words::ratio;
use crate::algebraic::Root;
use crate::case::Case;
use crate::diagnostic::Problem;
use crate::jordan::Spectral;
use crate::prove::deciding_claims;
use crate::shape::{Contraction, word_text};
use crate::theorem::surface::{Spot, Subspace, SurfaceBranch, SurfacePoint, SurfaceWitness};
use crate::theorem::{
    BranchReport, Certified, Claim, Direction, Limit, Outcome, Parameter, PointReport, Position, Rate, Required, Role,
    Side, Verdict, Witness,
};
use serde_json::{Value, json};

/// The version of the format; it changes when a field changes its meaning or goes away.
pub const VERSION: u32 = 1;

/// Everything that was found, as data.
#[must_use]
pub fn report<E: Reported>(case: &Case<E>, found: &Certified<E>, required: &Required, verbose: bool) -> Value {
    let mut out = json!({
        "version": VERSION,
        "case": case.name,
        "title": case.title,
        "mask": case.mask().map(|m| json!({ "arity": m.arity(), "coefficients": rationals(m.coefficients()) })),
        "verdict": required.verdict(&deciding_claims(case, &found.claims, required)).word(),
        "required": required.to_string(),
        "tangents": found.verdict.word(),
        "claim": found.claims.first().map(|c| claims::assertion(&c.what)),
        "claims": found.claims.iter().map(|c| claim(case, found, c)).collect::<Vec<_>>(),
        "limits": found.limits().iter().map(limit).collect::<Vec<_>>(),
        "contraction": contraction(&found.contraction),
        "every_point": match &found.surface {
            Some(surface) => super::every_plane::value(surface),
            None => E::every_value(found),
        },
        "parameter": match &found.parameter {
            Some(Parameter::Orders(orders)) => super::regularity::curve_data(&case.shape, orders),
            _ => Value::Null,
        },
        "points": match &found.surface {
            Some(surface) => surface.points.iter().map(surface_point).collect::<Vec<_>>(),
            None => {
                let mut points: Vec<Value> = found.points.iter().map(|p| point(case, p)).collect();
                // Enclosures on many cells: only where they are asked for.
                let local = if verbose { E::local_sides(case, found) } else { Vec::new() };
                for (point, sides) in points.iter_mut().zip(&local) {
                    point["local"] = sides.iter().map(super::local::value).collect();
                }
                points
            }
        },
    });
    if let Some(field) = E::field_text(&case.shape) {
        out["field"] = json!(field);
    }
    out
}

fn surface_point(p: &SurfacePoint) -> Value {
    let (kind, side) = match p.spot {
        Spot::Corner(k) => ("corner", Some(k)),
        Spot::Side(k) => ("side", Some(k)),
        Spot::Inside => ("inside", None),
        Spot::Branch => ("branch", None),
    };
    json!({
        "address": p.branches.first().map(|b| b.address.to_string()),
        "addresses": p.branches.iter().map(|b| b.address.to_string()).collect::<Vec<_>>(),
        "role": { "kind": format!("surface-{kind}"), "number": side },
        "parameters": p.parameter.as_ref().map(|x| rationals(x)),
        "position": rationals(&p.position),
        "image": p.image.as_ref().map(|x| rationals(x)),
        "verdict": p.verdict.word(),
        "dimension": { "at_least": p.dimension.at_least, "exact": p.dimension.exact },
        "kind": match p.verdict {
            Verdict::Proved => "tangent-plane",
            Verdict::Refuted => "no tangent plane",
            Verdict::Undetermined => "undetermined",
        },
        "plane": p.tangent.as_ref().map(subspace),
        "theorem": p.statement.map(|s| s.id()),
        "reason": reasons::plane(p),
        "product": p.product.as_ref().map(|e| json!({
            "verdict": e.verdict.word(),
            "curves": [e.first.verdict.word(), e.second.verdict.word()],
            "plane": e.tangent.as_ref().map(subspace),
        })),
        "branches": p.branches.iter().map(surface_branch).collect::<Vec<_>>(),
    })
}

/// Vectors that span a subspace; a vector whose `lambda` is not real stands for its real and imaginary part.
fn subspace(space: &Subspace) -> Value {
    let decimals = |d: &Direction| {
        let real = Subspace { generators: vec![d.clone()] }.to_f64();
        json!(real.iter().map(|v| v.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>()).collect::<Vec<_>>())
    };
    let one = |d: &Direction| {
        let rational = d.rational();
        let exact: Vec<String> = match &rational {
            Some(v) => rationals(v),
            None => d.coords.iter().map(|c| math_line(&elem_math(c)).replace('−', "-")).collect(),
        };
        let generator = if rational.is_some() { Value::Null } else { root_value(&d.root) };
        json!({ "exact": exact, "lambda": generator, "coordinates": coordinates(d), "decimals": decimals(d) })
    };
    space.generators.iter().map(one).collect()
}

fn surface_branch(b: &SurfaceBranch) -> Value {
    let o = &b.outcome;
    let witness = o.witness.as_ref().map(|w| match w {
        SurfaceWitness::Points(points) => json!({
            "kind": "points",
            "points": points.iter().map(|(a, x)| json!({ "address": a.to_string(), "offset": rationals(x) })).collect::<Vec<_>>(),
        }),
        SurfaceWitness::SignChange(w) => witness_value(w),
        SurfaceWitness::Winding(w) => json!({
            "kind": "winding",
            "cell": word_text(&w.cell),
            "number": w.number,
            "path": w.path.iter().map(|d| json!({
                "cell": word_text(&d.word), "functional": d.functional, "sign": d.sign,
            })).collect::<Vec<_>>(),
        }),
    });
    json!({
        "address": b.address.to_string(),
        "relevant": b.relevant,
        "visible": b.linear.rows(),
        "spectrum": spectrum_value(&b.spectrum),
        "top": reasons::top_row(o.row),
        "theorem": o.statement.map(|s| s.id()),
        "dimension": { "at_least": o.dimension.at_least, "exact": o.dimension.exact, "at_most": o.at_most },
        "contains": subspace(&o.contains),
        "cells": o.ring.as_ref().map(|r| r.discharged.len()),
        "depth": o.depth.as_ref().map(|(depth, proof)| json!({ "depth": depth, "cells": proof.discharged.len() })),
        "witness": witness,
        "reason": o.open.as_ref().map(|(reason, _)| reasons::surface_branch(*reason)),
        "cell": o.open.as_ref().and_then(|(_, place)| place.as_ref().map(|w| word_text(w))),
    })
}

fn spectrum_value<S: Spectral>(spectrum: &S) -> Value {
    let member = |m: &crate::jordan::Eigenvalue| {
        let mut value = root_value(spectrum.value(*m));
        value["multiplicity"] = json!(spectrum.part(m.factor).multiplicity);
        value["blocks"] = json!(spectrum.part(m.factor).blocks);
        value
    };
    spectrum.classes().iter().map(|class| class.members.iter().map(member).collect::<Value>()).collect()
}

/// A refused case as data.
#[must_use]
pub fn refusal(name: &str, problem: &Problem) -> Value {
    let (line, column) = problem.position().unzip();
    json!({
        "version": VERSION,
        "case": name,
        "path": name,
        "verdict": Value::Null,
        "error": {
            "code": problem.id(),
            "message": problem.message(),
            "file": problem.file(),
            "line": line,
            "column": column,
            "help": problem.remedy(),
        },
    })
}

fn limit(limit: &Limit) -> Value {
    match limit {
        Limit::Cells { branch, cell } => {
            json!({ "limit": limit.name(), "branch": branch.to_string(), "cell": word_text(cell) })
        }
        _ => json!({ "limit": limit.name() }),
    }
}

fn claim<E: Reported>(case: &Case<E>, found: &Certified<E>, c: &Claim) -> Value {
    json!({
        "kind": c.what.id(),
        "about": c.what.topic().map(|t| t.to_string()),
        "claim": claims::assertion(&c.what),
        "verdict": c.verdict().word(),
        "theorem": c.statement().map(|s| s.id()),
        "address": c.what.asked().map(|(address, _)| address.to_string()),
        "reason": claims::reason(case, found, c),
    })
}

fn contraction(c: &Contraction) -> Value {
    match c {
        Contraction::Proved(proof) => json!({
            "verdict": "proved",
            "length": proof.length,
            "words": proof.codes.iter().map(Vec::len).sum::<usize>(),
            "constant": proof.constant.to_string(),
        }),
        Contraction::Polytopes(proof) => json!({
            "verdict": "proved",
            "vertices": proof.count(),
            "constant": proof.constant.to_string(),
        }),
        Contraction::Product(proof) => json!({
            "verdict": "proved",
            "factors": proof.factors.iter().map(contraction).collect::<Vec<_>>(),
        }),
        Contraction::Refuted { state, word } => {
            json!({ "verdict": "refuted", "state": state, "word": word_text(word) })
        }
        Contraction::Undetermined { length, open } => {
            json!({ "verdict": "undetermined", "length": length, "open": open })
        }
    }
}

fn point<E: Reported>(case: &Case<E>, p: &PointReport<E>) -> Value {
    let lead = p.branches.iter().find(|b| matches!(b.outcome, Outcome::AtLeast { .. } | Outcome::Open { .. }));
    let lead = lead.or_else(|| p.branches.first());
    let mut out = json!({
        "address": p.branches.first().map(|b| b.address.to_string()),
        "addresses": p.branches.iter().map(|b| b.address.to_string()).collect::<Vec<_>>(),
        "role": role(case, &p.role),
        "position": rationals(&p.position),
        "image": p.image.as_ref().map(|x| rationals(x)),
        "verdict": p.verdict.word(),
        "dimension": { "at_least": p.dimension.at_least, "exact": p.dimension.exact },
        "kind": p.kind.word(),
        "about": p.about().word(),
        "rays": {
            "left": p.left.iter().map(direction).collect::<Vec<_>>(),
            "right": p.right.iter().map(direction).collect::<Vec<_>>(),
        },
        "tangent": p.tangent.as_ref().map(direction),
    });
    if let (Value::Object(map), Some(branch)) = (&mut out, lead) {
        for (key, value) in branch_fields(branch) {
            map.insert(key.to_owned(), value);
        }
        if p.verdict != Verdict::Proved {
            map.insert("reason".to_owned(), json!(reasons::point(p)));
        }
        map.insert("branches".to_owned(), p.branches.iter().map(branch_value).collect());
    }
    out
}

fn role<E>(case: &Case<E>, role: &Role) -> Value {
    match role {
        Role::LeftEnd => json!({ "kind": "left-end" }),
        Role::RightEnd => json!({ "kind": "right-end" }),
        Role::Interior => json!({ "kind": "interior" }),
        Role::SetPoint => json!({ "kind": "set-point" }),
        Role::Joint { path, state, left, right } => json!({
            "kind": "joint",
            "cell": word_text(path),
            "state": case.shape.states[*state].name,
            "pieces": [left, right],
        }),
    }
}

/// What is said of a branch: eigenvalue, Jordan block, theorem, rate, Hölder exponent, witness or reason.
fn branch_fields<E: Reported>(b: &BranchReport<E>) -> Vec<(&'static str, Value)> {
    match &b.outcome {
        Outcome::Line { statement, eigenvalue, block, rate, holder, proof, .. } => {
            // Rates need the ring condition; exponents besides a parameter.
            let curve = b.ring.iter().all(|p| p.position != Position::Unordered);
            let where_known = |value: Value, known: bool| if known { value } else { Value::Null };
            let part = b.spectrum.part(eigenvalue.0);
            let root = &part.roots[eigenvalue.1];
            let exponent = exponent(&holder.eigenvalue.modulus(80), &holder.scale);
            vec![
                ("eigenvalue", root_value(root)),
                ("jordan", json!({ "block": block, "blocks": part.blocks })),
                ("theorem", json!(statement.id())),
                ("rate", where_known(rate_value(rate), proof.is_some())),
                (
                    "holder",
                    where_known(
                        json!({ "decimal": exponent, "scale": holder.scale.to_string(), "power": holder.power }),
                        proof.is_some() && curve,
                    ),
                ),
            ]
        }
        Outcome::AtLeast { statement, eigenvalues, witness, .. } => {
            let mut fields = vec![("theorem", json!(statement.id()))];
            if let Some(&(f, r)) = eigenvalues.first() {
                fields.insert(0, ("eigenvalue", root_value(&b.spectrum.part(f).roots[r])));
                fields.insert(1, ("jordan", json!({ "blocks": b.spectrum.part(f).blocks })));
            }
            fields.push(("witness", witness.as_ref().map_or_else(|| spanning(b, eigenvalues), witness_value)));
            fields
        }
        Outcome::NoGerm { reason } => vec![("reason", json!(reasons::no_germ(*reason)))],
        Outcome::Open { reason, place, .. } => {
            vec![("reason", json!(reasons::branch(*reason))), ("cell", json!(place.as_ref().map(|w| word_text(w))))]
        }
    }
}

/// The eigenvalues whose directions span more than a line: they are the witness of the corollary.
fn spanning<E: Reported>(b: &BranchReport<E>, eigenvalues: &[(usize, usize)]) -> Value {
    let roots: Vec<Value> = eigenvalues.iter().map(|&(f, r)| root_value(&b.spectrum.part(f).roots[r])).collect();
    json!({ "kind": "eigenvalues", "eigenvalues": roots })
}

fn branch_value<E: Reported>(b: &BranchReport<E>) -> Value {
    let mut out = json!({
        "address": b.address.to_string(),
        "side": match b.side { Side::Left => "left", Side::Right => "right", Side::Both => "both" },
        "relevant": b.relevant,
        "visible": b.linear.rows(),
        "spectrum": spectrum_value(&b.spectrum),
    });
    if let Value::Object(map) = &mut out {
        for (key, value) in branch_fields(b) {
            map.insert(key.to_owned(), value);
        }
    }
    out
}

pub(super) fn root_value(root: &Root) -> Value {
    let (re, im) = root.enclosure(64);
    let interval = |x: &crate::arith::Interval| json!([x.lo.to_string(), x.hi.to_string()]);
    let (re_decimal, im_decimal) = root_decimals(root);
    json!({
        "minimal_polynomial": root.minpoly().display("x"),
        "coefficients": rationals(root.minpoly().coeffs()),
        "index": root.index(),
        "enclosure": { "re": interval(&re), "im": interval(&im) },
        "decimal": { "re": re_decimal, "im": im_decimal },
        "exact": root.rational().map(|x| x.to_string()),
    })
}

/// The coordinates of an irrational direction as polynomials in `lambda`, coefficients from the lowest degree up.
fn coordinates(d: &Direction) -> Value {
    if d.rational().is_some() { Value::Null } else { d.coords.iter().map(|c| rationals(c.0.coeffs())).collect() }
}

fn direction(d: &Direction) -> Value {
    let exact: Vec<String> = match d.rational() {
        Some(v) => v.iter().map(ToString::to_string).collect(),
        None => d.coords.iter().map(|c| math_line(&elem_math(c)).replace('−', "-")).collect(),
    };
    let generator = if d.rational().is_some() { Value::Null } else { root_value(&d.root) };
    json!({ "exact": exact, "lambda": generator, "coordinates": coordinates(d), "decimal": direction_decimals(d) })
}

fn rate_value(rate: &Rate) -> Value {
    match rate {
        Rate::Exact => json!({ "kind": "exact" }),
        Rate::Harmonic => json!({ "kind": "harmonic" }),
        Rate::Geometric { slower, dominant, power } => {
            let decimals = decimal(&(slower.modulus(80).mid() / dominant.modulus(80).mid()), 6);
            let exact = ratio(slower, dominant).map(|x| x.to_string());
            json!({ "kind": "geometric", "power": power, "factor": { "exact": exact, "decimal": decimals } })
        }
    }
}

fn witness_value<E: Reported>(w: &Witness<E>) -> Value {
    match w {
        Witness::Point { address, offset } => {
            json!({ "kind": "point", "address": address.to_string(), "offset": rationals(offset) })
        }
        Witness::SignChange { positive, above, negative, below } => json!({
            "kind": "sign-change",
            "positive": { "address": positive.to_string(), "values": [above.lo.to_string(), above.hi.to_string()] },
            "negative": { "address": negative.to_string(), "values": [below.lo.to_string(), below.hi.to_string()] },
        }),
        Witness::Crossing { sign, positive, negative, .. } => json!({
            "kind": "crossing",
            "sign": sign,
            "positive": { "address": positive.to_string() },
            "negative": { "address": negative.to_string() },
        }),
    }
}

fn rationals<E: ToString>(v: &[E]) -> Vec<String> {
    v.iter().map(ToString::to_string).collect()
}
