//! The text of what is stated of a whole curve.

use super::curve::{Cones, Levels, Own, OwnJoint};
use super::write::{
    ABOUT, BY_COMPUTATION, GIVEN, branch, coordinates, evidence, finished, list, matrix, number, real, vector, word,
    words,
};
use super::{Model, Whole};
use crate::linalg::Matrix;
use std::fmt::Write;

/// The joints of all levels, every point, and that the curve is G¹, as far as they are stated.
pub(super) fn write(out: &mut String, model: &Model<'_>, curve: &Whole, names: &mut Vec<String>) {
    if let Ok(levels) = &curve.levels {
        all_levels(out, model, levels, names);
    }
    if let Ok(cones) = &curve.cones {
        every_point(out, cones);
        names.push("every_point".to_owned());
    }
    if let (Ok(levels), Ok(())) = (&curve.levels, &curve.smooth) {
        smooth_curve(out, model, levels);
        names.push("smooth_curve".to_owned());
    }
}

/// Theorem 5: every joint in its own state, and in all copies of the state.
fn all_levels(out: &mut String, model: &Model<'_>, levels: &Levels, names: &mut Vec<String>) {
    let pair = |(c, d): &(Matrix, Matrix)| format!("({}, {})", matrix(c), matrix(d));
    let (views, pairs) = (list(&levels.views, matrix), list(&levels.pairs, |of| list(of, pair)));
    let _ = writeln!(
        out,
        "(* The joints of all levels (Theorem 5): what is seen of each state, and that the control points and all operators show as much. *)"
    );
    let _ = writeln!(out, "Definition views : list qmat := {views}.");
    let _ = writeln!(out, "Definition pairs : list (list (qmat * qmat)) := {pairs}.");
    let _ = writeln!(out, "Definition net_pair : qmat * qmat := {}.\n", pair(&levels.net));
    for joint in &levels.joints {
        let state = model.number(joint.state);
        let OwnJoint { before, after, cusp, point, lift, .. } = joint;
        let name = joint_name(model, joint);
        evidence(out, &format!("{name}_before"), &before.evidence);
        evidence(out, &format!("{name}_after"), &after.evidence);
        let of = |b: &Own| branch(&b.prefix, &b.cycle);
        let field = &after.evidence.field;
        let (theorem, q) = words(field);
        let (b1, b2, d) = (of(before), of(after), coordinates(field, &after.direction));
        let named = format!("{name}_after");
        let (r, lifted) = (real(&named, field, &after.direction), real(&named, field, lift));
        let seen = if field.is_rational() {
            format!("lift_ok case spaces {state} views {} {d}", vector(&lift.plain))
        } else {
            format!("lift_pair_ok case spaces {state} views {named}_root {} {d}", coordinates(field, lift))
        };
        let word = if *cusp { "cusp" } else { "regular" };
        let values = format!("({q}value {name}_before) ({q}value {name}_after)");
        let claim = format!(
            "forall u, admw (automaton_of case) start u -> stw (automaton_of case) start u = {state}%nat ->\n  {word} {ABOUT}\n    (inside u {b1})\n    (inside u {b2})\n    (act (ambient case) (qm net) (Ww (automaton_of case) start u {lifted}))"
        );
        let proof = format!(
            "refine ({word}_levels {GIVEN} {state} views pairs net_pair _ _ {values} {lifted} {r} _ _ _ _); [exact contracts|vm_compute; reflexivity|apply ({seen}); vm_compute; reflexivity|].\n  apply ({theorem}{word}_ok case centres radii spaces (view_of views {state}) {state} _ _ {name}_before {name}_after {} {d}); {BY_COMPUTATION}.",
            vector(point)
        );
        finished(out, &name, &claim, &proof);
        names.push(name);
    }
    everywhere_dense(out, model, levels);
    names.push("dense".to_owned());
}

/// That the joints of all levels come near every point.
fn everywhere_dense(out: &mut String, model: &Model<'_>, levels: &Levels) {
    let joints = list(&levels.joints, |joint| {
        let state = model.number(joint.state);
        let (_, q) = words(&joint.before.evidence.field);
        let named = format!("{}_before", joint_name(model, joint));
        format!("({state}%nat, ({}, {q}value {named}))", branch(&joint.before.prefix, &joint.before.cycle))
    });
    let _ = writeln!(
        out,
        "(* They come as near as one likes to every point: a word from each state to one with a joint. *)"
    );
    let _ = writeln!(out, "Definition joints : list (nat * (branch * qvec)) := {joints}.");
    let _ = writeln!(out, "Definition ways : list (list nat) := {}.", list(&levels.ways, |w| word(w)));
    let proof = format!("apply (joints_dense_ok case centres radii spaces net start joints ways); {BY_COMPUTATION}.");
    finished(out, "dense", "joints_dense case net start joints", &proof);
}

/// Theorem 6.
fn every_point(out: &mut String, cones: &Cones) {
    let columns = |m: &Matrix| list(0..m.cols(), |j| vector(&m.column(j)));
    let _ = writeln!(
        out,
        "(* Every point (Theorem 6): the pieces that run backwards, rays, their images, end points, chords. *)"
    );
    let turned = list(&cones.backwards, |of| list(of, ToString::to_string));
    let _ = writeln!(out, "Definition backwards : list (list bool) := {turned}.");
    let _ = writeln!(
        out,
        "Definition common : cones := {{|\n  rays_of := {};\n  maps_of := {};\n  firsts := {};\n  lasts := {};\n  chords := {};\n  ratio := {}; seen_by := {} |}}.",
        list(&cones.rays, columns),
        list(&cones.maps, |of| list(of, matrix)),
        list(&cones.firsts, |v| vector(v)),
        list(&cones.lasts, |v| vector(v)),
        list(&cones.chords, |v| vector(v)),
        number(&cones.ratio),
        vector(&cones.seen_by),
    );
    let claim = format!("tangent_at_every_address (automaton_of case) (listed backwards) (qm net) start");
    let proof = format!("apply (cones_ok case centres radii spaces backwards common net start); {BY_COMPUTATION}.");
    finished(out, "every_point", &claim, &proof);
}

fn joint_name(model: &Model<'_>, joint: &OwnJoint) -> String {
    format!("levels_{}_{}_{}", model.number(joint.state), joint.pieces.0, joint.pieces.1)
}

/// Theorem 6 with the joints: the curve is G¹.
fn smooth_curve(out: &mut String, model: &Model<'_>, levels: &Levels) {
    let joints = list(&levels.joints, |joint| {
        let of = |b: &Own| branch(&b.prefix, &b.cycle);
        format!(
            "({}%nat, {}%nat, ({}, {}))",
            model.number(joint.state),
            joint.pieces.0,
            of(&joint.before),
            of(&joint.after)
        )
    });
    let _ = writeln!(
        out,
        "(* The curve is G¹: the rays of both sides agree at the joints, and nothing else meets (Theorem 6). *)"
    );
    let _ = writeln!(out, "Definition joined : joints_of := {joints}.");
    let copies = levels.joints.iter().rev().fold("I".to_owned(), |rest, joint| {
        let name = joint_name(model, joint);
        format!("(conj (fun u inner to => ex_intro _ _ ({name} u inner to)) {rest})")
    });
    let claim = "g1 (automaton_of case) (listed backwards) (qm net) start";
    let proof = format!(
        "apply (g1_ok case centres radii spaces backwards common net start joined); {BY_COMPUTATION_TWICE}.\n  exact {copies}."
    );
    finished(out, "smooth_curve", claim, &proof);
}

/// Two hypotheses by computation; one is left.
const BY_COMPUTATION_TWICE: &str = "[exact contracts|vm_compute; reflexivity|vm_compute; reflexivity|]";
