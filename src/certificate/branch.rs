//! Points and branches: which rule proves them, and the evidence it needs.

use super::top::{element, elements, longest, top};
use super::written::{Written, matrix};
use super::{Unsupported, address_json, number, numbers, tree, unsupported};
use crate::algebraic::locate;
use crate::jordan::{Eigenvalue, Spectral};
use crate::linalg::Matrix;
use crate::shape::Address;
use crate::shape::Shape;
use crate::theorem::{
    BranchReport, Depth, Direction, Kind, Outcome, PointReport, Position, RingProof, Statement, Verdict, Witness,
    depths, field,
};
use serde_json::{Value, json};

/// A decided point.
pub fn point<E: Written>(shape: &Shape<E>, point: &PointReport<E>, place: &Value) -> Result<Value, Unsupported> {
    let mut common = Value::Null;
    let mut branches = Vec::new();
    let plane = |b: &&BranchReport<E>| matches!(b.outcome, Outcome::AtLeast { dimension: 2.., .. });
    let rule = match (point.verdict, point.branches.iter().find(plane)) {
        (Verdict::Proved, _) => {
            if let Some(vector) = point.tangent.as_ref().and_then(crate::theorem::Direction::rational) {
                common = numbers(&vector);
            } else if let [a, b] = &point.branches[..] {
                let (Some(first), Some(second)) = (line(a), line(b)) else {
                    return unsupported("a branch without a line", branch_name(a));
                };
                common = algebraic(&[first, second], E::COMMON, &branch_name(a))?;
            }
            "line"
        }
        (_, Some(refuted)) => {
            for b in &point.branches {
                let chosen = std::ptr::eq(b, refuted);
                branches.push(if chosen { branch(shape, b)? } else { Value::Null });
            }
            "plane"
        }
        _ => "differ",
    };
    if branches.is_empty() {
        branches = point.branches.iter().map(|b| branch(shape, b)).collect::<Result<_, _>>()?;
    }
    Ok(json!({
        "place": place,
        "verdict": point.verdict.word(),
        "kind": match point.kind {
            Kind::SmoothEnd => Kind::HalfTangent.word(),
            kind if kind.has_rays() => kind.word(),
            _ => "none",
        },
        "rule": rule,
        "common": common,
        "branches": branches,
    }))
}

pub fn branch_name<E: Written>(b: &BranchReport<E>) -> String {
    format!("branch {}", b.address)
}

fn line<E: Written>(b: &BranchReport<E>) -> Option<&Direction> {
    match &b.outcome {
        Outcome::Line { direction, .. } => Some(direction),
        _ => None,
    }
}

/// The coordinates of one line that several directions have in common, as algebraic numbers with the elements of the fields
/// of the directions that they are.
fn algebraic(directions: &[&Direction], places: u64, place: &str) -> Result<Value, Unsupported> {
    // The first coordinate that is not 0 becomes 1.
    let unit = |d: &&Direction| {
        let d = d.normalised();
        match d.coords.iter().find(|c| !c.is_zero()) {
            Some(lead) => Ok(d.times(lead.sign(&d.root))),
            None => unsupported("a line without a direction", place),
        }
    };
    let normal: Vec<Direction> = directions.iter().map(unit).collect::<Result<_, _>>()?;
    let number = |k: usize| {
        let x = locate(&normal[0].coords[k], &normal[0].root);
        let interval = x.enclosure(places).0;
        json!({
            "polynomial": numbers(x.minpoly().coeffs()),
            "interval": [number(&interval.lo), number(&interval.hi)],
            "elements": normal.iter().map(|d| element(&d.coords[k])).collect::<Value>(),
        })
    };
    Ok((0..normal[0].coords.len()).map(number).collect())
}

fn eigenvalue(pair: &(usize, usize)) -> Eigenvalue {
    Eigenvalue { factor: pair.0, root: pair.1 }
}

fn branch<E: Written>(shape: &Shape<E>, b: &BranchReport<E>) -> Result<Value, Unsupported> {
    match &b.outcome {
        Outcome::Line { statement: Statement::CorollaryLine, .. } => Ok(json!({"rule": "corollary-line"})),
        Outcome::Line { eigenvalue: lead, block, functional, proof: Some(proof), .. } => Ok(json!({
            "rule": if *block == 1 { "theorem-2" } else { "theorem-3" },
            "top": top::<E>(&b.linear, &b.spectrum, eigenvalue(lead), &branch_name(b))?,
            "functional": elements(functional),
            "cover": tree::cover(shape, &b.ring, proof, None)?,
        })),
        Outcome::AtLeast { statement, eigenvalues, isolation, witness, .. } => {
            let lead = eigenvalue(&eigenvalues[0]);
            let top = top::<E>(&b.linear, &b.spectrum, lead, &branch_name(b))?;
            match (statement, witness, isolation) {
                (Statement::Corollary, _, _) => Ok(json!({"rule": "corollary", "top": top})),
                (Statement::Theorem4, Some(witness), Some(isolation)) => {
                    theorem4(shape, b, lead, &top, witness, isolation)
                }
                (Statement::Section6, Some(Witness::Crossing { part, positive, negative, cover, .. }), _) => {
                    let Some(chain) = longest(b.spectrum.part(lead.factor).left) else {
                        return unsupported("an empty chain", branch_name(b));
                    };
                    Ok(json!({
                        "rule": "crossing",
                        "top": top,
                        "second": elements(&chain.vectors[0]),
                        "first": elements(&chain.vectors[1]),
                        "positive": address_json(positive),
                        "negative": address_json(negative),
                        "cover": tree::cover(shape, &b.ring, cover, Some(*part))?,
                    }))
                }
                (Statement::Theorem4Sign, Some(Witness::SignChange { positive, negative, .. }), Some(proof)) => {
                    leading_sign(shape, b, &top, proof, [positive, negative])
                }
                _ => unsupported("this evidence", branch_name(b)),
            }
        }
        Outcome::Open { direction: Some(_), .. } => {
            let members = &b.spectrum.classes()[0].members;
            let longest = members.iter().max_by_key(|m| b.spectrum.part(m.factor).blocks[0]);
            let Some(&lead) = longest else { return unsupported("an empty spectrum", branch_name(b)) };
            Ok(json!({"rule": "direction", "top": top::<E>(&b.linear, &b.spectrum, lead, &branch_name(b))?}))
        }
        _ => unsupported("a branch that is not decided", branch_name(b)),
    }
}

/// Theorem 4′: the change of sign, and the rows whose common kernel meets the ring nowhere.
fn leading_sign<E: Written>(
    shape: &Shape<E>,
    b: &BranchReport<E>,
    top: &Value,
    proof: &RingProof,
    [positive, negative]: [&Address; 2],
) -> Result<Value, Unsupported> {
    let lead = b.spectrum.classes()[0].members.iter().max_by_key(|m| b.spectrum.part(m.factor).blocks[0]);
    let Some(chain) = lead.and_then(|m| longest(b.spectrum.part(m.factor).left)) else {
        return unsupported("an empty chain", branch_name(b));
    };
    let space = |d: &Depth<E>| proof.functionals.len() == d.rows.rows();
    let Some(depth) = depths::<E>(&b.spectrum, &b.linear).into_iter().find(space) else {
        return unsupported("irrational functionals of several moduli", branch_name(b));
    };
    let images = &depth.rows * &b.linear;
    let (k, pivots) = (depth.rows.rows(), depth.rows.echelon().pivots);
    let inner = Matrix::from_fn(k, k, |i, j| images[(i, pivots[j])].clone());
    let inner = E::characteristic(&E::spectrum(&inner, &field(shape)));
    let Some(radius) = super::radius::below::<E>(&b.spectrum, depth.classes, &inner) else {
        return unsupported("moduli this close", branch_name(b));
    };
    let letters =
        |a: &Address| -> Vec<usize> { a.prefix.iter().chain(a.cycle.iter().cycle()).take(64).copied().collect() };
    let piece = b.ring.iter().find(|p| letters(positive).starts_with(&p.word));
    let links = match piece {
        Some(p) if p.position == Position::Unordered => {
            let Some(links) = shape.links(p.end) else {
                return unsupported("a piece that is not linked", branch_name(b));
            };
            let pair = |(x, y): &(Address, Address)| json!([address_json(x), address_json(y)]);
            links.iter().map(|(_, pairs)| pairs.iter().map(pair).collect::<Value>()).collect()
        }
        Some(_) => Value::Null,
        None => return unsupported("a witness outside the ring", branch_name(b)),
    };
    Ok(json!({
        "rule": "leading-sign",
        "top": top,
        "functional": elements(&chain.vectors[0]),
        "radius": number(&radius),
        "rows": matrix(&depth.rows),
        "cover": tree::cover(shape, &b.ring, proof, None)?,
        "positive": address_json(positive),
        "negative": address_json(negative),
        "links": links,
    }))
}

fn theorem4<E: Written>(
    shape: &Shape<E>,
    b: &BranchReport<E>,
    lead: Eigenvalue,
    top: &Value,
    witness: &Witness<E>,
    isolation: &RingProof,
) -> Result<Value, Unsupported> {
    let Some(chain) = longest(b.spectrum.part(lead.factor).left) else {
        return unsupported("an empty chain", branch_name(b));
    };
    let functional = elements(&chain.vectors[0]);
    let simple = chain.vectors.len() == 1 && b.view.rank() == b.linear.rows();
    match witness {
        Witness::Point { address, .. } if simple => Ok(json!({
            "rule": "null-point",
            "top": top,
            "functional": functional,
            "address": address_json(address),
        })),
        Witness::Point { address, offset } => Ok(json!({
            "rule": "orbit",
            "top": top,
            "address": address_json(address),
            "own": orbit_top(&b.linear, offset, &field(shape), &branch_name(b))?,
        })),
        Witness::SignChange { positive, negative, .. } if simple => Ok(json!({
            "rule": "sign-change",
            "top": top,
            "functional": functional,
            "isolation": tree::cover(shape, &b.ring, isolation, None)?,
            "positive": address_json(positive),
            "negative": address_json(negative),
        })),
        Witness::SignChange { positive, .. } => {
            unsupported("a change of sign seen through a map that is not injective", positive.to_string())
        }
        Witness::Crossing { positive, .. } => unsupported("this evidence", positive.to_string()),
    }
}

/// The top of the spectrum of `linear` on the cyclic hull of `x`.
pub fn orbit_top<E: Written>(linear: &Matrix<E>, x: &[E], base: &E::Base, place: &str) -> Result<Value, Unsupported> {
    let hull = krylov(linear, x);
    let images = &hull.rows * &linear.transpose();
    let k = hull.rows.rows();
    let own = Matrix::from_fn(k, k, |i, j| images[(j, hull.pivots[i])].clone());
    let spectrum = E::spectrum(&own, base);
    let members = spectrum.classes().first().map(|class| &class.members);
    match members.and_then(|m| m.iter().max_by_key(|m| spectrum.part(m.factor).blocks[0])) {
        Some(&lead) => super::top::top::<E>(&own, &spectrum, lead, place),
        None => unsupported("an empty hull", place),
    }
}

/// The cyclic hull of `x`, as rows in echelon form.
fn krylov<E: Written>(linear: &Matrix<E>, x: &[E]) -> crate::linalg::Echelon<E> {
    Matrix::from_rows(x.len(), vec![x.to_vec()]).closure(&[&linear.transpose()]).echelon()
}
