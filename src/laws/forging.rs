//! The checker against the prover: it accepts what was decided, and no changed case with a false claim.

use super::{Agreement, Broken, Law};
use crate::arith::ratio;
use crate::case::Case;
use crate::certificate::{Doubt, confirm, sha256};
use crate::linalg::Matrix;
use crate::scheme::{Heading, case_text};
use crate::shape::{Address, CellKind, Shape};
use crate::theorem::{Certified, Verdict, certify};
use oorandom::Rand32;
use serde_json::Value;

/// Whether the checker accepts the certificate of a decided verdict, and what it says of changed cases.
///
/// A changed case (another start state, exchanged operators or targets, a lost control coordinate, a moved entry) comes with
/// the old certificate, whose digest is made to fit. Where the checker accepts, its verdict must not contradict the prover's
/// on the changed case.
pub(super) fn check(
    shape: &Shape,
    addresses: &[Address],
    found: &Certified,
    seed: u64,
) -> Result<Option<Agreement>, Broken> {
    let broken = |what: String| Broken { law: Law::Certified, what };
    if shape.states.iter().any(|s| matches!(s.kind, CellKind::Face | CellKind::Vertex)) {
        return Ok(None);
    }
    let text = written(shape, addresses);
    let case = Case::parse("law.toml", &text).map_err(|p| broken(format!("its own text is refused: {p}")))?;
    let certificate = match confirm(&case, found) {
        Ok(certificate) => certificate,
        Err(Doubt::Unsupported(what)) => {
            let lost = if found.verdict == Verdict::Undetermined { Vec::new() } else { vec![what.to_string()] };
            return Ok(Some(Agreement { compared: 0, lost }));
        }
        Err(doubt) => return Err(broken(doubt.to_string())),
    };
    let mut agreement = Agreement { compared: 1, lost: Vec::new() };
    for (what, changed) in changes(shape, seed) {
        let text = written(&changed, addresses);
        let mut json = certificate.json().clone();
        json["case"] = Value::String(sha256(&text));
        let Ok(accepted) = secant_check::check(&text, &json.to_string()) else { continue };
        agreement.compared += 1;
        let truth = certify(&changed, addresses)
            .map_err(|error| broken(format!("accepted with {what}, where the case is no model: {error}")))?;
        let contradicts = matches!(
            (accepted.verdict.word(), truth.verdict),
            ("proved", Verdict::Refuted) | ("refuted", Verdict::Proved)
        );
        if contradicts {
            let (said, is) = (accepted.verdict.word(), truth.verdict.word());
            return Err(broken(format!("accepted with {what}: {said}, but it is {is}")));
        }
    }
    Ok(Some(agreement))
}

fn written(shape: &Shape, addresses: &[Address]) -> String {
    let heading = Heading { name: "law".to_owned(), examine: addresses.to_vec(), ..Heading::default() };
    case_text(shape, &heading)
}

/// Changes of the meaning of a case that keep its form.
fn changes(shape: &Shape, seed: u64) -> Vec<(&'static str, Shape)> {
    let mut random = Rand32::new(seed ^ 0x5eca);
    let mut all = Vec::new();
    let state = random.rand_range(0..shape.states.len() as u32) as usize;
    let dim = shape.states[state].dim;
    if let Some(start) =
        (0..shape.states.len()).find(|&e| e != shape.start && shape.states[e].dim == shape.view().cols())
    {
        all.push(("another start", Shape { start, ..shape.clone() }));
    }
    let pieces = &shape.states[state].pieces;
    if let Some(j) = (1..pieces.len()).find(|&j| pieces[j].op.cols() == pieces[0].op.cols()) {
        let mut changed = shape.clone();
        let other = changed.states[state].pieces[j].op.clone();
        changed.states[state].pieces[j].op = std::mem::replace(&mut changed.states[state].pieces[0].op, other);
        all.push(("exchanged operators", changed));
        if pieces[j].target != pieces[0].target {
            let mut changed = shape.clone();
            changed.states[state].pieces[0].target = pieces[j].target;
            all.push(("another target", changed));
        }
    }
    if let Some(control) = &shape.control {
        let lost = random.rand_range(0..control.rows() as u32) as usize;
        let mut flat = control.clone();
        (0..control.cols()).for_each(|j| flat[(lost, j)] = ratio(0, 1));
        all.push(("a lost coordinate", Shape { control: Some(flat), ..shape.clone() }));
    }
    if dim > 1 {
        let mut changed = shape.clone();
        let letter = random.rand_range(0..pieces.len() as u32) as usize;
        let op: &mut Matrix = &mut changed.states[state].pieces[letter].op;
        let column = random.rand_range(0..op.cols() as u32) as usize;
        let row = random.rand_range(0..dim as u32) as usize;
        op[(row, column)] += ratio(1, 16);
        op[((row + 1) % dim, column)] -= ratio(1, 16);
        all.push(("a moved entry", changed));
    }
    all
}
