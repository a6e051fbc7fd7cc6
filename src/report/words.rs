//! The words and formulas shared by all reports: points, branches, spectra, rates.

use super::document::{Inline, Line, Tone, line, words};
use super::math::Math;
use super::reasons;
use super::reported::{Reported, vector};
use super::values::{
    decimal_math, decimals_math, direction_decimals, direction_math, enclosed, exponent, is_rational, lambda_math,
    polynomial, root_math,
};
use crate::algebraic::Root;
use crate::arith::Rational;
use crate::jordan::{Eigenvalue, Spectral};
use crate::shape::{Contraction, Shape, word_text};
use crate::theorem::{
    BranchReport, Dimension, Direction, Holder, Kind, Outcome, PointReport, Rate, RingProof, Role, Statement, Verdict,
    Witness,
};

/// The colour of a verdict.
#[must_use]
pub fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Proved => Tone::Good,
        Verdict::Refuted => Tone::Bad,
        Verdict::Undetermined => Tone::Open,
    }
}

/// A verdict in its colour.
#[must_use]
pub fn mark(verdict: Verdict) -> Inline {
    Inline::Mark(tone(verdict), verdict.word().to_owned())
}

/// `a`, `b` and `c`.
#[must_use]
pub fn listed(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [head @ .., last] => format!("{} and {last}", head.join(", ")),
    }
}

/// `1 piece`, `2 pieces`.
#[must_use]
pub fn count(number: usize, noun: &str) -> String {
    let ending = if noun.ends_with('s') || noun.ends_with("ch") { "es" } else { "s" };
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}{ending}") }
}

/// What a point is called at the start of a sentence: `Left end`, `Joint of pieces 0 and 1`.
#[must_use]
pub fn point_name<E: Reported>(shape: &Shape<E>, point: &PointReport<E>) -> String {
    let phrase = point_phrase(shape, point);
    let mut letters = phrase.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// The same inside a sentence: `left end`, `joint of pieces 0 and 1`.
#[must_use]
pub fn point_phrase<S, E: Reported>(shape: &Shape<S>, point: &PointReport<E>) -> String {
    match &point.role {
        Role::LeftEnd => "left end".to_owned(),
        Role::RightEnd => "right end".to_owned(),
        Role::Interior => "interior point".to_owned(),
        Role::SetPoint => "point".to_owned(),
        Role::Joint { path, state, left, right } => {
            let mut name = format!("joint of pieces {left} and {right}");
            if shape.states.len() > 1 {
                name.push_str(&format!(" of state {}", shape.states[*state].name));
            }
            if !path.is_empty() {
                name.push_str(&format!(" in cell {}", word_text(path)));
            }
            name
        }
    }
}

/// The addresses of the branches, without repetition.
#[must_use]
pub fn addresses<E: Reported>(point: &PointReport<E>) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    for branch in &point.branches {
        let text = branch.address.to_string();
        if !out.contains(&text) {
            out.push(text);
        }
    }
    out
}

/// A direction, exactly, with decimals where it is irrational.
#[must_use]
pub fn direction(d: &Direction) -> Line {
    let exact = direction_math(d);
    if is_rational(d) {
        return vec![Inline::Math(exact)];
    }
    let decimals = decimals_math(&direction_decimals(d));
    let mut out = line("$@$ with $@$", [exact, lambda_math(&d.root)]);
    out.extend(root_of(&d.root));
    out.extend(line(", which is $≈@$", [decimals]));
    out
}

/// `, a root of x³ − 2` behind an eigenvalue that is written as a decimal; nothing behind others.
#[must_use]
pub fn root_of(root: &Root) -> Line {
    let rounded = matches!(root_math(root), Math::Row(row) if row.first() == Some(&Math::Symbol('≈')));
    if rounded { line(", the root of $@$ near it", [minimal_polynomial(root)]) } else { Line::new() }
}

/// The rays of one side.
#[must_use]
pub fn rays(list: &[Direction]) -> Line {
    let mut out = Line::new();
    for (k, ray) in list.iter().enumerate() {
        if k > 0 {
            out.extend(words(" and "));
        }
        out.extend(direction(ray));
    }
    out
}

/// The rays of both sides in one line.
#[must_use]
pub fn ray_line<E: Reported>(point: &PointReport<E>) -> Line {
    let mut out = Line::new();
    for (side, list) in [("left", &point.left), ("right", &point.right)] {
        if list.is_empty() {
            continue;
        }
        if !out.is_empty() {
            out.extend(words("; "));
        }
        if point.role != Role::SetPoint {
            out.extend(words(format!("{side} ")));
        }
        out.extend(rays(list));
    }
    out
}

/// An eigenvalue with its multiplicity and blocks, as in `1/2 (one block of size 2)`.
#[must_use]
pub fn eigenvalue<S: Spectral>(spectrum: &S, member: Eigenvalue) -> Line {
    let factor = spectrum.part(member.factor);
    let mut out = vec![Inline::Math(root_math(spectrum.value(member)))];
    if factor.multiplicity > 1 {
        out.extend(words(format!(" ({})", blocks(factor.blocks))));
    }
    out
}

/// `2 blocks of size 1`, `blocks of sizes 2 and 1`.
#[must_use]
pub fn blocks(sizes: &[usize]) -> String {
    match sizes {
        [one] => format!("1 Jordan block of size {one}"),
        _ if sizes.iter().all(|s| *s == sizes[0]) => format!("{} Jordan blocks of size {}", sizes.len(), sizes[0]),
        _ => format!("Jordan blocks of sizes {}", listed(&sizes.iter().map(ToString::to_string).collect::<Vec<_>>())),
    }
}

/// The eigenvalues by descending modulus, at most `most` classes of them.
#[must_use]
pub fn spectrum_line<S: Spectral>(spectrum: &S, most: usize) -> Line {
    let mut out = Line::new();
    for (k, class) in spectrum.classes().iter().take(most).enumerate() {
        if k > 0 {
            out.extend(words("; then "));
        }
        for (j, member) in class.members.iter().enumerate() {
            if j > 0 {
                out.extend(words(if j + 1 == class.members.len() { " and " } else { ", " }));
            }
            out.extend(eigenvalue(spectrum, *member));
        }
        if class.members.len() > 1 {
            out.extend(words(" of equal modulus"));
        }
    }
    if spectrum.classes().len() > most {
        out.extend(words(format!("; {} of smaller modulus", count(spectrum.classes().len() - most, "class"))));
    }
    out
}

/// The rate of convergence.
#[must_use]
pub fn rate(rate: &Rate) -> Line {
    match rate {
        Rate::Exact => line("0 from some turn on: $M^m A$ lies on the line", []),
        Rate::Harmonic => line("$O(1/m)$ after $m$ turns of the cycle", []),
        Rate::Geometric { slower, dominant, power } => {
            let prefix = match power {
                0 => String::new(),
                1 => "m ".to_owned(),
                k => format!("m^{k} "),
            };
            match ratio(slower, dominant) {
                Some(q) => line(&format!("$O({prefix}(@)^m)$ after $m$ turns of the cycle"), [Math::number(&q)]),
                None => {
                    let (a, b) = (slower.modulus(80).mid(), dominant.modulus(80).mid());
                    let template = format!(
                        "$O({prefix}r^m)$ after $m$ turns of the cycle, where $r≈@$ is the second modulus divided by the first"
                    );
                    line(&template, [decimal_math(&(a / b), 6)])
                }
            }
        }
    }
}

/// `|slower| / |dominant|` where both are rational.
#[must_use]
pub fn ratio(slower: &Root, dominant: &Root) -> Option<Rational> {
    let (a, b) = (slower.rational()?, dominant.rational()?);
    Some(crate::arith::abs(&a) / crate::arith::abs(&b))
}

/// The local Hölder exponent.
#[must_use]
pub fn holder(h: &Holder) -> Line {
    let modulus = h.eigenvalue.modulus(80);
    let value = Math::Digits(exponent(&modulus, &h.scale));
    let scale = Math::number(&h.scale);
    let mut out = match (exact_exponent(h), h.eigenvalue.rational()) {
        (Some(exact), Some(x)) => {
            line("$h=\\ln(@)/\\ln(@)=@$", [Math::number(&crate::arith::abs(&x)), scale, Math::number(&exact)])
        }
        (_, Some(x)) => line("$h=\\ln(@)/\\ln(@)≈@$", [Math::number(&crate::arith::abs(&x)), scale, value]),
        // The modulus is irrational: a decimal may not stand behind `=`.
        _ => line("$h=\\ln ρ_1/\\ln(@)≈@$", [scale, value]),
    };
    match h.power {
        0 => {}
        1 => out.extend(line("; the distance from $p$, divided by $|t|^h$, grows like $m$ after $m$ turns", [])),
        k => out.extend(line(
            "; the distance from $p$, divided by $|t|^h$, grows like $m^{@}$ after $m$ turns",
            [Math::count(k)],
        )),
    }
    out
}

/// A rational exponent `a/b` of small terms: `|λ|^b = s^a`.
fn exact_exponent(h: &Holder) -> Option<Rational> {
    use malachite_base::num::arithmetic::traits::Pow;
    let size = crate::arith::abs(&h.eigenvalue.rational()?);
    let fits = |(a, b): &(u64, u64)| (&size).pow(*b) == (&h.scale).pow(*a);
    let pairs = (1..=4u64).flat_map(|b| (1..=6 * b).map(move |a| (a, b)));
    pairs.into_iter().find(fits).map(|(a, b)| Rational::from(a) / Rational::from(b))
}

/// What a kind of point means, in brackets after its name; a set that is no curve has no sides.
#[must_use]
pub fn kind_meaning(kind: Kind, set: bool) -> &'static str {
    match kind {
        Kind::Oscillating if set => "the tangent line exists, and both of its rays are limit rays",
        Kind::SmoothEnd | Kind::HalfTangent => "one limit ray",
        Kind::Regular => "one ray on each side, opposite to one another",
        Kind::Cusp => "one ray on each side, the same",
        Kind::Oscillating => "the tangent line exists, and both of its rays are limit rays on a side",
        Kind::Corner => "one ray on each side, on different lines",
        Kind::Line | Kind::NoTangent | Kind::Undetermined => "",
    }
}

/// The dimension of the tangent subspace.
#[must_use]
pub fn dimension(d: Dimension) -> Line {
    if d.exact {
        line("$\\dim D^*=@$", [Math::count(d.at_least)])
    } else {
        line("$\\dim D^*≥@$", [Math::count(d.at_least)])
    }
}

/// A cell as an address prefix.
#[must_use]
pub fn cell(word: &[usize]) -> String {
    if word.is_empty() { "the whole cell".to_owned() } else { format!("`{}`", word_text(word)) }
}

/// A witness in words.
#[must_use]
pub fn witness<E: Reported>(w: &Witness<E>) -> Line {
    match w {
        Witness::Point { address, offset } => line(
            &format!(
                "the point of the ring with address `{address}` has no component in the leading part: its offset from $q$ is $x=@$ in \
                 coordinates of $V$, and the functional vanishes there exactly"
            ),
            [vector(offset)],
        ),
        Witness::SignChange { positive, above, negative, below } => {
            let mut out = line(
                &format!(
                    "the functional changes sign on a connected part of the ring: it is positive at the point with address `{positive}` ("
                ),
                [],
            );
            out.extend(enclosed(above));
            out.extend(line(&format!(") and negative at the one with address `{negative}` ("), []));
            out.extend(enclosed(below));
            out.extend(words("); both addresses are read from the state of the cycle"));
            out
        }
        Witness::Crossing { sign, positive, negative, cover, .. } => line(
            &format!(
                "the coefficient $c_2$ is positive at the point with address `{positive}` and negative at `{negative}` of a connected \
                 part of the ring, and on {} that cover that part either $c_2$ has a strict sign or $c_1$ is {}",
                count(cover.discharged.len(), "cell"),
                if *sign > 0 { "positive" } else { "negative" }
            ),
            [],
        ),
    }
}

/// The name of a statement.
#[must_use]
pub fn statement(s: Statement) -> &'static str {
    s.name()
}

/// How the ring condition was proved.
#[must_use]
pub fn ring_proof(proof: &RingProof) -> String {
    format!("ring condition proved on {}", count(proof.discharged.len(), "cell"))
}

/// What follows at a branch, in one line.
#[must_use]
pub fn outcome<E: Reported>(branch: &BranchReport<E>) -> Line {
    match &branch.outcome {
        Outcome::Line { statement: s, proof, .. } => {
            let how = proof.as_ref().map_or_else(|| "no ring condition needed".to_owned(), ring_proof);
            words(format!("{}; {how}", statement(*s)))
        }
        Outcome::AtLeast { dimension, statement: s, witness: w, .. } => {
            let mut out = line(&format!("{}: $\\dim D^*≥@$", statement(*s)), [Math::count(*dimension)]);
            if let Some(w) = w {
                out.extend(words("; "));
                out.extend(witness(w));
            }
            out
        }
        Outcome::NoGerm { reason } => words(reasons::no_germ(*reason)),
        Outcome::Open { reason, place, .. } => match place {
            Some(place) => line(&format!("not decided: {} (cell {})", reasons::branch(*reason), cell(place)), []),
            None => words(format!("not decided: {}", reasons::branch(*reason))),
        },
    }
}

/// The minimal polynomial of an eigenvalue.
#[must_use]
pub fn minimal_polynomial(root: &Root) -> Math {
    polynomial(root.minpoly(), 'x')
}

/// The finding on contraction, in one line.
#[must_use]
pub fn contraction(c: &Contraction) -> Line {
    match c {
        Contraction::Proved(proof) => {
            let total: usize = proof.codes.iter().map(Vec::len).sum();
            line(
                &format!(
                    "proved by {} of at most {}: $τ(T_w)≤@$ for each",
                    count(total, "word"),
                    count(proof.length, "letter")
                ),
                [short_bound(&proof.constant)],
            )
        }
        Contraction::Polytopes(proof) => line(
            &format!(
                "proved by polytopes with {} vertices: in the norms whose unit balls are $H_e-H_e$ every piece shrinks differences to \
                 at most $@$ of their size",
                proof.count()
            ),
            [short_bound(&proof.constant)],
        ),
        Contraction::Product(proof) => {
            let mut text = words("proved for both curves whose tensor product the surface is: ");
            for (k, factor) in proof.factors.iter().enumerate() {
                text.extend(words(["the first: ", "; the second: "][k.min(1)]));
                text.extend(contraction(factor));
            }
            text
        }
        Contraction::Refuted { word, .. } => {
            line(&format!("refuted: the cycle `{}` has spectral radius at least 1", word_text(word)), [])
        }
        Contraction::Undetermined { length, open } => {
            words(format!("not decided: {} of length {length} are left", count(*open, "word")))
        }
    }
}

/// A bound, exactly where it is short, otherwise rounded upwards.
#[must_use]
pub fn short_bound(x: &Rational) -> Math {
    if x.to_string().len() <= 16 {
        return Math::number(x);
    }
    use malachite_base::num::arithmetic::traits::Ceiling;
    let million = Rational::from(1_000_000);
    decimal_math(&(Rational::from((x * &million).ceiling()) / million), 6)
}

/// A vertex on the border with so many faces.
#[must_use]
pub fn on_border(smooth: bool, faces: &str) -> String {
    if smooth { format!("a vertex of a smooth border with {faces}") } else { format!("a corner with {faces}") }
}
