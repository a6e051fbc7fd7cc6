//! The text of the file.

use super::curve::{Cones, Levels, Own, OwnJoint};
use super::evidence::{Chart, Evidence, Top};
use super::field::{Field, Pair, Pairs};
use super::refuted::{Limit, Refuted, Spiral};
use super::{Model, Replayed, Stated, Statement, Whole};
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Matrix;
use crate::shape::Address;
use crate::theorem::{Certified, Kind};
use std::fmt::Write;

fn number(x: &Rational) -> String {
    x.to_string().replace('/', "#")
}

fn list<T>(items: impl IntoIterator<Item = T>, text: impl Fn(T) -> String) -> String {
    let items: Vec<String> = items.into_iter().map(text).collect();
    format!("[{}]", items.join("; "))
}

fn vector(v: &[Rational]) -> String {
    list(v, number)
}

fn matrix(m: &Matrix) -> String {
    list(0..m.rows(), |i| vector(m.row(i)))
}

fn word(w: &[usize]) -> String {
    list(w, |letter| format!("{letter}%nat"))
}

fn branch(prefix: &[usize], cycle: &[usize]) -> String {
    format!("{{| prefix := {}; cycle := {} |}}", word(prefix), word(cycle))
}

/// Text inside a comment.
fn plain(text: &str) -> String {
    text.replace("(*", "( *").replace("*)", "* )").replace('"', "'")
}

const ABOUT: &str = "(automaton_of case) (qm net) start";
const GIVEN: &str = "case centres radii spaces net start";
const BY_COMPUTATION: &str = "[exact contracts|vm_compute; reflexivity]";

/// The file: definitions, theorems, and one theorem that holds them all.
pub(super) fn file(case: &Case, found: &Certified, model: &Model<'_>, theorems: &[Stated], whole: &Whole) -> String {
    let mut out = String::new();
    heading(&mut out, case, found, whole);
    definitions(&mut out, model);
    let mut names = Vec::new();
    for theorem in theorems {
        let (claim, proof) = stated(&mut out, theorem);
        let _ = writeln!(out, "(* {}. *)", plain(&theorem.place));
        finished(&mut out, &theorem.name, &claim, &proof);
        names.push(theorem.name.clone());
    }
    if let Ok(levels) = &whole.levels {
        all_levels(&mut out, model, levels, &mut names);
    }
    if let Ok(cones) = &whole.cones {
        every_point(&mut out, cones);
        names.push("every_point".to_owned());
    }
    let all = names.iter().map(|n| format!("{n}_statement")).collect::<Vec<_>>().join(" /\\\n  ");
    let mut proof = String::new();
    for (k, name) in names.iter().enumerate() {
        let last = k + 1 == names.len();
        proof += &if last { format!("exact {name}.") } else { format!("split; [exact {name}|]. ") };
    }
    let _ = write!(out, "Theorem verdict :\n  {all}.\nProof. {proof} Qed.\n\nPrint Assumptions verdict.\n");
    out
}

fn heading(out: &mut String, case: &Case, found: &Certified, whole: &Whole) {
    let levels = match &whole.levels {
        Ok(_) => "Stated as well: the joints of all levels.".to_owned(),
        Err(why) => format!("Not stated: the joints of all levels ({}).", why.what),
    };
    let cones = match &whole.cones {
        Ok(_) => "Stated as well: one ray for both sides at every address.".to_owned(),
        Err(why) => format!("Not stated: every point ({}).", why.what),
    };
    let _ = write!(
        out,
        "(* Case {}: {}\n   secant's verdict: {}. This file states and proves what it says of single points: rays and lines of the\n   branches below.\n   {}\n   {}\n   Exponents and rates are never stated. Every number is checked by computation; the theorems are those of proofs/\n   (see proofs/README.md): coqc -Q proofs/theories Secant FILE.v *)\n",
        plain(&case.name),
        plain(&case.title),
        found.verdict.word(),
        plain(&levels),
        plain(&cones),
    );
    out.push_str(
        "From Coq Require Import List QArith.\nFrom Secant Require Import Replay Dense Refute Spiral Quadratic Everywhere.\nImport ListNotations.\nOpen Scope Q_scope.\nOpen Scope list_scope.\n\n",
    );
}

fn definitions(out: &mut String, model: &Model<'_>) {
    let table = model.states.iter().map(|e| {
        let state = &model.shape.states[*e];
        let pieces = list(&state.pieces, |p| format!("\n      ({}%nat, {})", model.number(p.target), matrix(&p.op)));
        format!("({}%nat, {pieces})", state.dim)
    });
    let _ = writeln!(out, "(* States with their dimension and pieces: target and matrix, row by row. *)");
    let _ = writeln!(
        out,
        "Definition case : system := {{| ambient := {}; table := {} |}}.",
        model.ambient,
        list(table, |t| format!("\n    {t}"))
    );
    let _ = writeln!(out, "(* The control points, one a column; the identity where the case has none. *)");
    let _ = writeln!(out, "Definition net : qmat := {}.", matrix(&model.net));
    let _ = writeln!(out, "Definition start : nat := {}.\n", model.number(model.shape.start));
    let _ = writeln!(out, "(* Balls that hold the attractors, and contraction by words (Lemma 1). *)");
    let centres = list(&model.states, |e| vector(&model.balls.centre[*e]));
    let radii = list(&model.states, |e| number(&model.balls.radius[*e]));
    let space = |e: &usize| &model.spaces.of(*e).basis * &model.spaces.of(*e).coordinates;
    let spaces = list(&model.states, |e| matrix(&space(e)));
    let _ = writeln!(out, "Definition centres : list qvec := {centres}.\nDefinition radii : list Q := {radii}.");
    let _ = writeln!(
        out,
        "(* Spaces of the differences of the attractors: the vectors that these matrices do not change. *)"
    );
    let _ = writeln!(out, "Definition spaces : list qmat := {spaces}.");
    let _ = writeln!(out, "Lemma contracts : controlled case centres radii spaces.");
    let _ = writeln!(
        out,
        "Proof. apply (controlled_ok case centres radii spaces ({}) {}); vm_compute; reflexivity. Qed.\n",
        number(&model.constant),
        model.length
    );
}

fn top(t: &Top) -> String {
    let (value, row, lead) = (number(&t.value.plain), vector(&t.row.plain), vector(&t.vector.plain));
    match &t.chain {
        None => format!("Simple ({value}) {row} {lead}"),
        Some((other, second)) => format!("Block ({value}) {} {row} {lead} {}", vector(other), vector(second)),
    }
}

fn pair(x: &Pair) -> String {
    format!("({}, {})", number(&x.plain), number(&x.rooted))
}

/// A vector, or the pair of its parts where numbers are irrational.
fn coordinates(field: &Field, v: &Pairs) -> String {
    if field.is_rational() { vector(&v.plain) } else { format!("({}, {})", vector(&v.plain), vector(&v.rooted)) }
}

/// The real vector that a statement is about.
fn real(name: &str, field: &Field, v: &Pairs) -> String {
    let coordinates = coordinates(field, v);
    if field.is_rational() { format!("(qv {coordinates})") } else { format!("(vval {name}_root {coordinates})") }
}

/// What is put before the names of theorems, and of fields of evidence.
fn words(field: &Field) -> (&'static str, &'static str) {
    if field.is_rational() { ("", "") } else { ("quadratic_", "q_") }
}

fn chart(c: &Chart) -> String {
    let [coordinates, turn, seen] = [&c.coordinates, &c.turn, &c.seen].map(matrix);
    format!("{{| coordinates := {coordinates}; turn := {turn}; seen := {seen} |}}")
}

fn evidence(out: &mut String, name: &str, e: &Evidence) {
    let field = &e.field;
    let lead = if field.is_rational() {
        format!("lead := {}", top(&e.top))
    } else {
        let [radicand, below, above] = [&field.radicand, &field.below, &field.above].map(number);
        let _ = writeln!(
            out,
            "Definition {name}_root : Quadratic.root := {{| radicand := {radicand}; below := {below}; above := {above} |}}."
        );
        format!(
            "q_root := {name}_root; q_lead := {}; q_row := {}; q_vector := {}",
            pair(&e.top.value),
            coordinates(field, &e.top.row),
            coordinates(field, &e.top.vector)
        )
    };
    let (_, q) = words(field);
    let scale = if field.is_rational() { number(&e.scale.plain) } else { pair(&e.scale) };
    let _ = writeln!(
        out,
        "Definition {name} : {} := {{| {q}value := {}; {q}view := {}; {lead}; {q}power := {}; {q}rate := {}; {q}low := {}; {q}depth := {}; {q}exit := {}; {q}scale := {scale} |}}.",
        if field.is_rational() { "evidence" } else { "quadratic" },
        vector(&e.point),
        chart(&e.chart),
        e.power,
        number(&e.rate),
        number(&e.low),
        e.depth,
        word(&e.exit),
    );
}

fn finished(out: &mut String, name: &str, claim: &str, proof: &str) {
    let _ = writeln!(
        out,
        "Definition {name}_statement : Prop :=\n  {claim}.\nTheorem {name} : {name}_statement.\nProof.\n  {proof}\nQed.\n"
    );
}

/// The evidence of a theorem is written; its claim and its proof are returned.
fn stated(out: &mut String, theorem: &Stated) -> (String, String) {
    let Stated { name, statement, image, .. } = theorem;
    let image = vector(image);
    let at = |of: &str, value: &str| {
        (
            format!("point {ABOUT} {of} = qv {image} /\\\n  "),
            format!("split; [apply (check_point_ok {GIVEN} _ {value}); {BY_COMPUTATION}|].\n  "),
        )
    };
    match statement {
        Statement::Ray { branch: b } => single(out, name, b, ("half_tangent", "ray"), &at),
        Statement::Passes { branch: b } => single(out, name, b, ("passes", "passes"), &at),
        Statement::Line { branch: b } => single(out, name, b, ("tangent_line", "line"), &at),
        Statement::Joint { kind, before, after, minor } => {
            joint(out, name, &image, (*kind, before, after, *minor), &at)
        }
        Statement::NoTangent { address, point, refuted } => no_tangent(out, name, address, point, refuted, &at),
    }
}

type At<'a> = dyn Fn(&str, &str) -> (String, String) + 'a;

/// One branch: the word of the statement, and that of the theorem for irrational numbers.
fn single(
    out: &mut String,
    name: &str,
    b: &Replayed,
    (said, irrational): (&str, &str),
    at: &At<'_>,
) -> (String, String) {
    let own = format!("{name}_evidence");
    let field = &b.evidence.field;
    evidence(out, &own, &b.evidence);
    let of = branch(&b.prefix, &b.cycle);
    let (_, q) = words(field);
    let (claim, proof) = at(&of, &format!("({q}value {own})"));
    let theorem = if field.is_rational() { format!("{said}_ok") } else { format!("quadratic_{irrational}_ok") };
    (
        format!("{claim}{said} {ABOUT} {of} {}", real(&own, field, &b.direction)),
        format!("{proof}apply ({theorem} {GIVEN} _ {own}); [exact contracts|vm_compute; reflexivity..]."),
    )
}

/// Both sides of a joint.
fn joint(
    out: &mut String,
    name: &str,
    image: &str,
    (kind, before, after, minor): (Kind, &Replayed, &Replayed, (usize, usize)),
    at: &At<'_>,
) -> (String, String) {
    let [first, second] = ["before", "after"].map(|side| format!("{name}_{side}"));
    evidence(out, &first, &before.evidence);
    evidence(out, &second, &after.evidence);
    let field = &after.evidence.field;
    let (b1, b2) = (branch(&before.prefix, &before.cycle), branch(&after.prefix, &after.cycle));
    let (theorem, q) = words(field);
    let (claim, proof) = at(&b2, &format!("({q}value {second})"));
    let [d1, d2] = [before, after].map(|b| coordinates(field, &b.direction));
    let [r1, r2] = [before, after].map(|b| real(&second, field, &b.direction));
    let (word, dirs, last) = match kind {
        Kind::Corner => ("corner", format!("{r1} {r2}"), format!("{d1} {d2} {} {}", minor.0, minor.1)),
        Kind::Cusp => ("cusp", r2, d2),
        _ => ("regular", r2, d2),
    };
    (
        format!("{claim}{word} {ABOUT}\n    {b1}\n    {b2} {dirs}"),
        format!("{proof}apply ({theorem}{word}_ok {GIVEN} _ _ {first} {second} {image} {last}); {BY_COMPUTATION}."),
    )
}

fn no_tangent(
    out: &mut String,
    name: &str,
    address: &Address,
    point: &[Rational],
    refuted: &Refuted,
    at: &At<'_>,
) -> (String, String) {
    let of = branch(&address.prefix, &address.cycle);
    let q = vector(point);
    let (claim, proof) = at(&of, &q);
    let applied = match refuted {
        Refuted::Lines { limits, minor } => {
            for (k, l) in limits.iter().enumerate() {
                limit(out, &format!("{name}_limit_{k}"), l);
            }
            let [d1, d2] = [0, 1].map(|k| vector(&limits[k].direction));
            let [r1, r2] = [0, 1].map(|k| limits[k].turns);
            let (i, j) = minor;
            format!("(no_tangent_ok {GIVEN} _ {q} {r1} {r2} {name}_limit_0 {name}_limit_1 {d1} {d2} {i} {j})")
        }
        Refuted::Spiral(s) => {
            spiral(out, &format!("{name}_spiral"), s);
            format!("(spiral_ok {GIVEN} _ {q} {name}_spiral)")
        }
    };
    (format!("{claim}no_tangent {ABOUT} {of}"), format!("{proof}apply {applied}; {BY_COMPUTATION}."))
}

fn limit(out: &mut String, name: &str, limit: &Limit) {
    let _ = writeln!(
        out,
        "Definition {name} : direction_evidence := {{| tail := {}; tail_value := {}; stays := {}; along := {}; proj := {}; eigen := {}; turns_power := {}; turns_rate := {}; multiple := {} |}}.",
        branch(&limit.tail.prefix, &limit.tail.cycle),
        vector(&limit.value),
        matrix(&limit.stays),
        chart(&limit.chart),
        matrix(&limit.top.matrix),
        number(&limit.top.eigenvalue),
        limit.top.power,
        number(&limit.top.rate),
        number(&limit.multiple),
    );
}

fn spiral(out: &mut String, name: &str, s: &Spiral) {
    let _ = writeln!(
        out,
        "Definition {name} : spiral_evidence := {{| around := {}; around_value := {}; around_stays := {}; around_chart := {}; plane := {}; trace := {}; norm := {}; plane_power := {}; plane_rate := {}; minor_of := ({}%nat, {}%nat) |}}.",
        branch(&s.tail.prefix, &s.tail.cycle),
        vector(&s.value),
        matrix(&s.stays),
        chart(&s.chart),
        matrix(&s.plane),
        number(&s.trace),
        number(&s.norm),
        s.power,
        number(&s.rate),
        s.minor.0,
        s.minor.1,
    );
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
        let OwnJoint { pieces, before, after, cusp, point, lift, .. } = joint;
        let name = format!("levels_{state}_{}_{}", pieces.0, pieces.1);
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
        let named = format!("levels_{state}_{}_{}_before", joint.pieces.0, joint.pieces.1);
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
    let _ = writeln!(out, "(* Every point (Theorem 6): rays, their images, end points, chords. *)");
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
    let claim = format!("tangent_at_every_address {ABOUT}");
    let proof = format!("apply (cones_ok case centres radii spaces common net start); {BY_COMPUTATION}.");
    finished(out, "every_point", &claim, &proof);
}
