//! The text of the file.

use super::evidence::{Evidence, Top};
use super::{Model, Replayed, Stated, Statement};
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Matrix;
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

/// Text inside a comment.
fn plain(text: &str) -> String {
    text.replace("(*", "( *").replace("*)", "* )").replace('"', "'")
}

pub(super) fn file(case: &Case, found: &Certified, model: &Model<'_>, theorems: &[Stated]) -> String {
    let mut out = String::new();
    heading(&mut out, case, found);
    definitions(&mut out, model);
    for theorem in theorems {
        stated(&mut out, theorem);
    }
    let names: Vec<&str> = theorems.iter().map(|t| t.name.as_str()).collect();
    let all = names.iter().map(|n| format!("{n}_statement")).collect::<Vec<_>>().join(" /\\\n  ");
    let _ = write!(out, "Theorem verdict :\n  {all}.\nProof. {} Qed.\n\nPrint Assumptions verdict.\n", conjunction(&names));
    out
}

fn conjunction(names: &[&str]) -> String {
    match names {
        [one] => format!("exact {one}."),
        [first, rest @ ..] => format!("split; [exact {first}|]. {}", conjunction(rest)),
        [] => String::new(),
    }
}

fn heading(out: &mut String, case: &Case, found: &Certified) {
    let _ = write!(
        out,
        "(* Case {}: {}\n   secant's verdict: {}. This file states and proves what it says of single points: limit rays and lines\n   of the branches below. What it says beyond them (all joints of all levels, every point, exponents) is not stated here.\n   Every number is checked by computation; the theorems are those of proofs/ (see proofs/README.md):\n   coqc -Q proofs/theories Secant FILE.v *)\n",
        plain(&case.name),
        plain(&case.title),
        found.verdict.word(),
    );
    out.push_str(
        "From Coq Require Import List QArith.\nFrom Secant Require Import Replay.\nImport ListNotations.\nOpen Scope Q_scope.\nOpen Scope list_scope.\n\n",
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
    let _ = writeln!(out, "Definition centres : list qvec := {centres}.\nDefinition radii : list Q := {radii}.");
    let _ = writeln!(out, "Lemma contracts : controlled case centres radii.");
    let _ = writeln!(
        out,
        "Proof. apply (controlled_ok case centres radii ({}) {}); vm_compute; reflexivity. Qed.\n",
        number(&model.constant),
        model.length
    );
}

fn branch(b: &Replayed) -> String {
    format!("{{| prefix := {}; cycle := {} |}}", word(&b.prefix), word(&b.cycle))
}

fn top(t: &Top) -> String {
    let (value, row, lead) = (number(&t.value), vector(&t.row), vector(&t.vector));
    match &t.chain {
        None => format!("Simple ({value}) {row} {lead}"),
        Some((other, second)) => format!("Block ({value}) {} {row} {lead} {}", vector(other), vector(second)),
    }
}

fn evidence(out: &mut String, name: &str, e: &Evidence) {
    let _ = writeln!(
        out,
        "Definition {name} : evidence := {{| value := {}; lead := {}; power := {}; rate := {}; low := {}; depth := {}; exit := {}; scale := {} |}}.",
        vector(&e.point),
        top(&e.top),
        e.power,
        number(&e.rate),
        number(&e.low),
        e.depth,
        word(&e.exit),
        number(&e.scale),
    );
}

fn stated(out: &mut String, theorem: &Stated) {
    let Stated { name, place, statement, image } = theorem;
    let _ = writeln!(out, "(* {}. *)", plain(place));
    let about = "(automaton_of case) (qm net) start";
    let given = "case centres radii net start _";
    let image = vector(image);
    let (claim, proof) = match statement {
        Statement::Ray { branch: b } | Statement::Line { branch: b } => {
            evidence(out, &format!("{name}_evidence"), &b.evidence);
            let d = vector(&b.direction);
            let of = branch(b);
            let (word, lemma) = match statement {
                Statement::Ray { .. } => ("half_tangent", "half_tangent_ok"),
                _ => ("tangent_line", "tangent_line_ok"),
            };
            let claim = format!("point {about} {of} = qv {image} /\\\n  {word} {about} {of} (qv {d})");
            let at = format!("apply (check_point_ok {given} (value {name}_evidence)); [exact contracts|vm_compute; reflexivity]");
            let proof = format!("split; [{at}|].\n  apply ({lemma} {given} {name}_evidence); [exact contracts|vm_compute; reflexivity..].");
            (claim, proof)
        }
        Statement::Joint { kind, before, after, minor } => {
            evidence(out, &format!("{name}_before"), &before.evidence);
            evidence(out, &format!("{name}_after"), &after.evidence);
            let (b1, b2, d1, d2) = (branch(before), branch(after), vector(&before.direction), vector(&after.direction));
            let cells = format!("\n    {b1}\n    {b2}");
            let pair = format!("{name}_before {name}_after {image}");
            let (claim, lemma, last) = match kind {
                Kind::Corner => (format!("corner {about}{cells} (qv {d1}) (qv {d2})"), "corner_ok", format!("{d1} {d2} {} {}", minor.0, minor.1)),
                Kind::Cusp => (format!("cusp {about}{cells} (qv {d2})"), "cusp_ok", d2),
                _ => (format!("regular {about}{cells} (qv {d2})"), "regular_ok", d2),
            };
            let at = format!("apply (check_point_ok {given} (value {name}_after)); [exact contracts|vm_compute; reflexivity]");
            let claim = format!("point {about} {b2} = qv {image} /\\\n  {claim}");
            (claim, format!("split; [{at}|].\n  apply ({lemma} {given} _ {pair} {last}); [exact contracts|vm_compute; reflexivity]."))
        }
    };
    let _ = writeln!(out, "Definition {name}_statement : Prop :=\n  {claim}.\nTheorem {name} : {name}_statement.\nProof.\n  {proof}\nQed.\n");
}
