//! The text of what is stated of a whole curve.

use super::curve::{Cones, Joints, Levels, Own, OwnJoint, Sights};
use super::write::{
    ABOUT, BY_COMPUTATION, GIVEN, branch, coordinates, evidence, finished, list, matrix, number, real, vector, word,
    words,
};
use super::{Model, Whole};
use crate::linalg::Matrix;
use std::fmt::Write;

/// The joints of all levels, every point, and that the curve is G¹, as far as they are stated.
pub(super) fn write(out: &mut String, model: &Model<'_>, curve: &Whole, names: &mut Vec<String>) {
    if let Ok(joints) = &curve.joints
        && (curve.levels.is_ok() || curve.smooth.is_ok())
    {
        own_joints(out, model, joints, names);
        if let Ok(levels) = &curve.levels {
            all_levels(out, model, (joints, levels), names);
        }
    }
    if let Ok(cones) = &curve.cones {
        every_point(out, cones);
        names.push("every_point".to_owned());
    }
    if let (Ok(joints), Ok(sights)) = (&curve.joints, &curve.smooth) {
        smooth_curve(out, model, joints, sights);
        names.push("smooth_curve".to_owned());
    }
}

fn joint_name(model: &Model<'_>, joint: &OwnJoint) -> String {
    format!("{}_{}_{}", model.number(joint.state), joint.pieces.0, joint.pieces.1)
}

fn sides(joint: &OwnJoint) -> (String, String) {
    let of = |b: &Own| branch(&b.prefix, &b.cycle);
    (of(&joint.before), of(&joint.after))
}

/// Every joint of a state, as it is seen in that state.
fn own_joints(out: &mut String, model: &Model<'_>, joints: &Joints, names: &mut Vec<String>) {
    let _ = writeln!(out, "(* The joints of all states, in what is seen of each state. *)");
    let _ = writeln!(out, "Definition views : list qmat := {}.\n", list(&joints.views, matrix));
    for joint in &joints.all {
        let state = model.number(joint.state);
        let name = format!("own_{}", joint_name(model, joint));
        evidence(out, &format!("{name}_before"), &joint.before.evidence);
        evidence(out, &format!("{name}_after"), &joint.after.evidence);
        let field = &joint.after.evidence.field;
        let (theorem, _) = words(field);
        let (b1, b2) = sides(joint);
        let named = format!("{name}_after");
        let (d, r) = (coordinates(field, &joint.after.direction), real(&named, field, &joint.after.direction));
        let word = if joint.cusp { "cusp" } else { "regular" };
        let claim =
            format!("{word} (automaton_of case) (qm (view_of views {state})) {state}\n    {b1}\n    {b2}\n    {r}");
        let proof = format!(
            "apply ({theorem}{word}_ok case centres radii spaces (view_of views {state}) {state} _ _ {name}_before {name}_after {} {d}); {BY_COMPUTATION}.",
            vector(&joint.point)
        );
        finished(out, &name, &claim, &proof);
        names.push(name);
    }
}

/// Theorem 5: every joint in all copies of its state.
fn all_levels(out: &mut String, model: &Model<'_>, (joints, levels): (&Joints, &Levels), names: &mut Vec<String>) {
    let pair = |(c, d): &(Matrix, Matrix)| format!("({}, {})", matrix(c), matrix(d));
    let pairs = list(&levels.pairs, |of| list(of, pair));
    let _ = writeln!(
        out,
        "(* The joints of all levels (Theorem 5): the control points and all operators show as much as is seen of each state. *)"
    );
    let _ = writeln!(out, "Definition pairs : list (list (qmat * qmat)) := {pairs}.");
    let _ = writeln!(out, "Definition net_pair : qmat * qmat := {}.\n", pair(&levels.net));
    for joint in &joints.all {
        let state = model.number(joint.state);
        let (own, name) = (format!("own_{}", joint_name(model, joint)), format!("levels_{}", joint_name(model, joint)));
        let field = &joint.after.evidence.field;
        let (_, q) = words(field);
        let (b1, b2) = sides(joint);
        let (d, lift) = (coordinates(field, &joint.after.direction), &joint.lift);
        let named = format!("{own}_after");
        let (r, lifted) = (real(&named, field, &joint.after.direction), real(&named, field, lift));
        let seen = if field.is_rational() {
            format!("lift_ok case spaces {state} views {} {d}", vector(&lift.plain))
        } else {
            format!("lift_pair_ok case spaces {state} views {named}_root {} {d}", coordinates(field, lift))
        };
        let word = if joint.cusp { "cusp" } else { "regular" };
        let values = format!("({q}value {own}_before) ({q}value {own}_after)");
        let claim = format!(
            "forall u, admw (automaton_of case) start u -> stw (automaton_of case) start u = {state}%nat ->\n  {word} {ABOUT}\n    (inside u {b1})\n    (inside u {b2})\n    (act (ambient case) (qm net) (Ww (automaton_of case) start u {lifted}))"
        );
        let proof = format!(
            "refine ({word}_levels {GIVEN} {state} views pairs net_pair _ _ {values} {lifted} {r} _ _ _ _); [exact contracts|vm_compute; reflexivity|apply ({seen}); vm_compute; reflexivity|exact {own}]."
        );
        finished(out, &name, &claim, &proof);
        names.push(name);
    }
    everywhere_dense(out, model, joints, levels);
    names.push("dense".to_owned());
}

/// That the joints of all levels come near every point.
fn everywhere_dense(out: &mut String, model: &Model<'_>, joints: &Joints, levels: &Levels) {
    let listed = list(&joints.all, |joint| {
        let state = model.number(joint.state);
        let (_, q) = words(&joint.before.evidence.field);
        let named = format!("own_{}_before", joint_name(model, joint));
        format!("({state}%nat, ({}, {q}value {named}))", sides(joint).0)
    });
    let _ = writeln!(
        out,
        "(* They come as near as one likes to every point: a word from each state to one with a joint. *)"
    );
    let _ = writeln!(out, "Definition joints : list (nat * (branch * qvec)) := {listed}.");
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
    let _ = writeln!(
        out,
        "Lemma in_cones : check_cones case backwards common net start = true.\nProof. vm_compute; reflexivity. Qed.\n"
    );
    let claim = "tangent_at_every_address (automaton_of case) (listed backwards) (qm net) start";
    let proof = "exact (cones_ok case centres radii spaces backwards common net start contracts in_cones).";
    finished(out, "every_point", claim, proof);
}

/// Theorem 6 with the joints: the curve is G¹.
fn smooth_curve(out: &mut String, model: &Model<'_>, joints: &Joints, sights: &Sights) {
    let listed = list(&joints.all, |joint| {
        let (b1, b2) = sides(joint);
        format!("({}%nat, {}%nat, ({b1}, {b2}))", model.number(joint.state), joint.pieces.0)
    });
    let _ = writeln!(
        out,
        "(* The curve is G¹: the rays of both sides agree at the joints, and nothing else meets (Theorem 6). *)"
    );
    let _ = writeln!(out, "Definition joined : joints_of := {listed}.");
    let _ = writeln!(
        out,
        "Definition sees : sights := {{|\n  own_rows := {};\n  into_start := {};\n  into_state := {} |}}.",
        list(&sights.own_rows, |v| vector(v)),
        matrix(&sights.into_start),
        list(&sights.into_state, |of| list(of, matrix)),
    );
    let each =
        joints.all.iter().rev().fold("I".to_owned(), |rest, joint| {
            format!("(conj (ex_intro _ _ own_{}) {rest})", joint_name(model, joint))
        });
    let proof = format!(
        "apply (g1_ok case centres radii spaces backwards common net start views sees joined contracts in_cones); [vm_compute; reflexivity|vm_compute; reflexivity|exact {each}]."
    );
    finished(out, "smooth_curve", "g1 (automaton_of case) (listed backwards) (qm net) start", &proof);
}
