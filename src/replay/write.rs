//! The text of the file.

use super::evidence::{Chart, Evidence, Top};
use super::field::{Field, Pair, Pairs};
use super::refuted::{Limit, Refuted, Spiral};
use super::{Model, NoTheorem, Replayed, Shrinks, Stated, Statement, Whole, whole};
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Matrix;
use crate::shape::Address;
use crate::theorem::{Certified, Kind};
use std::fmt::Write;

pub(super) fn number(x: &Rational) -> String {
    x.to_string().replace('/', "#")
}

pub(super) fn list<T>(items: impl IntoIterator<Item = T>, text: impl Fn(T) -> String) -> String {
    let items: Vec<String> = items.into_iter().map(text).collect();
    format!("[{}]", items.join("; "))
}

pub(super) fn vector(v: &[Rational]) -> String {
    list(v, number)
}

pub(super) fn matrix(m: &Matrix) -> String {
    list(0..m.rows(), |i| vector(m.row(i)))
}

pub(super) fn word(w: &[usize]) -> String {
    list(w, |letter| format!("{letter}%nat"))
}

pub(super) fn branch(prefix: &[usize], cycle: &[usize]) -> String {
    format!("{{| prefix := {}; cycle := {} |}}", word(prefix), word(cycle))
}

/// Text inside a comment.
fn plain(text: &str) -> String {
    text.replace("(*", "( *").replace("*)", "* )").replace('"', "'")
}

pub(super) const ABOUT: &str = "(automaton_of case) (qm net) start";
pub(super) const GIVEN: &str = "case centres radii spaces net start";
pub(super) const BY_COMPUTATION: &str = "[exact contracts|vm_compute; reflexivity]";

/// The file: definitions, theorems, and one theorem that holds them all.
pub(super) fn file(case: &Case, found: &Certified, model: &Model<'_>, theorems: &[Stated], curve: &Whole) -> String {
    let mut out = String::new();
    heading(&mut out, case, found, curve);
    definitions(&mut out, model);
    let mut names = Vec::new();
    for theorem in theorems {
        let (claim, proof) = stated(&mut out, theorem);
        let _ = writeln!(out, "(* {}. *)", plain(&theorem.place));
        finished(&mut out, &theorem.name, &claim, &proof);
        names.push(theorem.name.clone());
    }
    whole::write(&mut out, model, curve, &mut names);
    let all = names.iter().map(|n| format!("{n}_statement")).collect::<Vec<_>>().join(" /\\\n  ");
    let mut proof = String::new();
    for (k, name) in names.iter().enumerate() {
        let last = k + 1 == names.len();
        proof += &if last { format!("exact {name}.") } else { format!("split; [exact {name}|]. ") };
    }
    let _ = write!(out, "Theorem verdict :\n  {all}.\nProof. {proof} Qed.\n\nPrint Assumptions verdict.\n");
    out
}

fn heading(out: &mut String, case: &Case, found: &Certified, curve: &Whole) {
    let said = |stated: Option<&NoTheorem>, what: &str| match stated {
        None => format!("Stated as well: {what}."),
        Some(why) => format!("Not stated: {what} ({}).", why.what),
    };
    let levels = said(curve.levels.as_ref().err(), "the joints of all levels");
    let cones = said(curve.cones.as_ref().err(), "one ray for both sides at every address");
    let smooth = said(curve.smooth.as_ref().err(), "the curve is G¹");
    let _ = write!(
        out,
        "(* Case {}: {}\n   secant's verdict: {}. This file states and proves what it says of single points: rays and lines of the\n   branches below.\n   {}\n   {}\n   {}\n   Exponents and rates are never stated. Every number is checked by computation; the theorems are those of proofs/\n   (see proofs/README.md): coqc -Q proofs/theories Secant FILE.v *)\n",
        plain(&case.name),
        plain(&case.title),
        found.verdict.word(),
        plain(&levels),
        plain(&cones),
        plain(&smooth),
    );
    out.push_str(
        "From Coq Require Import List QArith.\nFrom Secant Require Import Replay Dense Refute Spiral Quadratic Everywhere Hulls.\nImport ListNotations.\nOpen Scope Q_scope.\nOpen Scope list_scope.\n\n",
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
    let _ = writeln!(
        out,
        "(* Balls that hold the attractors, and contraction by words (Lemma 1) or polytopes (Lemma 1′). *)"
    );
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
    let applied = match &model.shrinks {
        Shrinks::Words { constant, length } => {
            format!("controlled_ok case centres radii spaces ({}) {length}", number(constant))
        }
        Shrinks::Hulls(hulls) => {
            let vectors = |of: &Vec<Vec<Rational>>| list(of, |v| vector(v));
            let _ = writeln!(
                out,
                "(* Polytopes by state: vertices, their images as combinations by piece, the weights that all images have in common, and coordinates in the vertices. *)"
            );
            let _ = writeln!(
                out,
                "Definition polytopes : hulls := {{|\n  corners := {};\n  images_of := {};\n  shared := {};\n  inverses := {};\n  shrink_by := {} |}}.",
                list(&hulls.corners, vectors),
                list(&hulls.images, |of| list(of, vectors)),
                list(&hulls.shared, vectors),
                list(&hulls.inverses, matrix),
                number(&hulls.constant),
            );
            "controlled_hulls case centres radii spaces polytopes".to_owned()
        }
    };
    let _ = writeln!(out, "Lemma contracts : controlled case centres radii spaces.");
    let _ = writeln!(out, "Proof. apply ({applied}); vm_compute; reflexivity. Qed.\n");
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
pub(super) fn coordinates(field: &Field, v: &Pairs) -> String {
    if field.is_rational() { vector(&v.plain) } else { format!("({}, {})", vector(&v.plain), vector(&v.rooted)) }
}

/// The real vector that a statement is about.
pub(super) fn real(name: &str, field: &Field, v: &Pairs) -> String {
    let coordinates = coordinates(field, v);
    if field.is_rational() { format!("(qv {coordinates})") } else { format!("(vval {name}_root {coordinates})") }
}

/// What is put before the names of theorems, and of fields of evidence.
pub(super) fn words(field: &Field) -> (&'static str, &'static str) {
    if field.is_rational() { ("", "") } else { ("quadratic_", "q_") }
}

fn chart(c: &Chart) -> String {
    let [coordinates, turn, seen] = [&c.coordinates, &c.turn, &c.seen].map(matrix);
    format!("{{| coordinates := {coordinates}; turn := {turn}; seen := {seen} |}}")
}

pub(super) fn evidence(out: &mut String, name: &str, e: &Evidence) {
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

pub(super) fn finished(out: &mut String, name: &str, claim: &str, proof: &str) {
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
