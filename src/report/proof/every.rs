//! The section on every point of a curve: the cones, or why there are none.

use super::super::document::{Block, Check, Line, Table, Tone, formula, line, words};
use super::super::every;
use super::super::math::Math;
use super::super::radius::decimal;
use super::super::values::{elem_math, lambda_math};
use super::super::words::{count, listed, mark, point_name, root_of, tone};
use super::evidence::Evidence;
use super::{Quoted, components, matrix};
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::{Matrix, dot};
use crate::report::figures;
use crate::shape::{Spaces, word_text};
use crate::statement::Statement;
use crate::theorem::cone::{CommonCone, most_pieces};
use crate::theorem::{Certified, SlowCycle};
use malachite_base::num::arithmetic::traits::Pow;

pub(super) fn section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let blocks = curve(case, found, seen);
    let heading = (!blocks.is_empty()).then(|| Block::heading(2, "Every point"));
    heading.into_iter().chain(blocks).collect()
}

/// The same of one curve, which may be a factor of a surface.
pub(super) fn curve(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let Some(result) = &found.everywhere else { return Vec::new() };
    let mut blocks = Vec::new();
    if let Some(cone) = &result.cone {
        let statement = cone.statement();
        if statement == Statement::Theorem6Slow {
            // Theorem 6′ refers to Theorem 6.
            blocks.extend(seen.once_id(Statement::Theorem6));
        }
        blocks.extend(seen.once_id(statement));
        blocks.extend(rays(case, cone));
        blocks.push(evidence(case, found, cone, statement).block());
        blocks.extend(images(case, cone));
    }
    if let Some(order) = &result.derivative {
        blocks.extend(seen.once_id(Statement::Graph));
        blocks.push(Block::Checks(derivative(order)));
    }
    if let Some(parts) = &result.components {
        blocks.extend(seen.once_id(Statement::Theorem6));
        blocks.extend(seen.once_id(Statement::Components));
        blocks.push(components::evidence(case, parts).block());
        blocks.extend(components::loops(case, parts));
    }
    let checks = result.joints.iter().map(|joint| {
        let point = joint.report(found);
        let mut text = words(format!("{}: ", point_name(&case.shape, point)));
        text.push(mark(point.verdict));
        text.extend(words(format!(", {}", point.kind.word())));
        Check { tone: tone(point.verdict), text }
    });
    let checks: Vec<Check> = checks.collect();
    if !checks.is_empty() {
        blocks.push(Block::text("The first-level joints of all reachable states:", []));
        blocks.push(Block::Checks(checks));
    }
    if let Some(o) = result.obstacle.as_ref().filter(|_| result.witness.is_none()) {
        let text = format!(
            "In coordinates of $V$, with the orientation signs, the product of the operators along the cycle `{}` is",
            word_text(&o.word)
        );
        blocks.push(Block::text(&text, []));
        blocks.push(Block::Formula(Math::matrix(&o.product)));
    }
    if let (Some(_), Some(rate)) = (&result.exponent, result.cone.as_ref().and_then(|c| c.rate.as_ref())) {
        blocks.extend(seen.once_id(Statement::ConeExponent));
        let values = [Math::count(rate.length), Math::number(&rate.cross_ratio), Math::count(most_pieces(&case.shape))];
        let evidence = Evidence::of(Statement::ConeExponent).holds("cones", "as shown above.", []).holds(
            "cross-ratios",
            "$k=@$, $D=@$, $N=@$.",
            values,
        );
        blocks.push(evidence.block());
    }
    blocks.push(Block::Facts(every::facts(case, found, result)));
    blocks.extend(figures::cones(case, found));
    blocks
}

/// The hypotheses of Theorem 12 as they were verified.
fn derivative(order: &crate::theorem::smoothness::CurveOrder) -> Vec<Check> {
    let dims: Vec<String> = order.dims.iter().map(ToString::to_string).collect();
    let mut texts = vec![format!(
        "the spaces $F$ of the differences of the derivative have the dimensions {}, state by state; no chord lies in \
         them, nor the chord of the start, as it is seen, among what is seen of them",
        dims.join(", ")
    )];
    if let Some(bound) = &order.enclosure {
        let hi = decimal(&bound.hi, true, 6);
        texts.push(match order.shares {
            None => format!("the joint spectral radius of the $T_i$ on $F$ is at most {hi}, which is below $1/N=@$"),
            Some(_) => format!("the joint spectral radius of the $T_i/s_i$ on $F$ is at most {hi}, which is below $@$"),
        });
    }
    if let Some(shares) = &order.shares {
        let each: Vec<String> = shares.iter().map(|s| crate::report::words::listed(&texts_of(s))).collect();
        texts.insert(0, format!("the pieces take the shares {} of the parameter, state by state", each.join("; ")));
    }
    texts.push("the derivatives of the two sides are equal at every first-level joint".to_owned());
    let threshold = || std::iter::once(Math::number(&order.threshold));
    texts.into_iter().map(|text| Check { tone: Tone::Good, text: line(&text, threshold()) }).collect()
}

fn texts_of(numbers: &[crate::arith::Rational]) -> Vec<String> {
    numbers.iter().map(ToString::to_string).collect()
}

/// Most rays that are printed.
const MAX_RAYS: usize = 12;
/// Wider matrices of coefficients are not printed: about so many characters fit a line.
const MAX_WIDTH: usize = 54;

/// Whether the rays are few enough to be printed.
fn printed(cone: &CommonCone) -> bool {
    cone.cones.iter().all(|c| c.rays.cols() <= MAX_RAYS)
}

/// `G_e` with the name of its state.
fn indexed(case: &Case, state: usize, letter: &str) -> Math {
    let name = Math::Word(case.shape.states[state].name.clone());
    Math::parse(&format!("{letter}_@"), &mut std::iter::once(name))
}

/// The cones and their rays.
fn rays(case: &Case, cone: &CommonCone) -> Vec<Block> {
    let mut blocks = Vec::new();
    for own in &cone.cones {
        let of = if case.shape.states.len() > 1 {
            format!(" of state {}", case.shape.states[own.state].name)
        } else {
            String::new()
        };
        let mut head = words(format!("The cone{of} is that of {}", count(own.rays.cols(), "ray")));
        if printed(cone) {
            head.extend(words(", the columns of"));
            blocks.push(Block::Paragraph(head));
            blocks.push(matrix(indexed(case, own.state, "G"), &own.rays));
        } else {
            head.extend(words("."));
            blocks.push(Block::Paragraph(head));
        }
    }
    blocks
}

/// What was verified of Theorem 6 or 6′. All that 6′ takes over from 6 stands under its hypothesis *cones*.
fn evidence(case: &Case, found: &Certified, cone: &CommonCone, statement: Statement) -> Evidence {
    let slow = statement == Statement::Theorem6Slow;
    let name = |plain: &'static str| if slow { "cones" } else { plain };
    let mut evidence = Evidence::of(statement);
    let meet = "every piece begins where the one before ends, as in the table of identities above.";
    evidence.push(name("meet"), Tone::Good, words(meet));
    for own in &cone.cones {
        let indexed = |letter: &str| indexed(case, own.state, letter);
        let relevant = found.states.iter().find(|s| s.state == own.state).map_or(own.rays.rank(), |s| s.relevant);
        evidence.push(
            "cones",
            Tone::Good,
            line("$@$ has the rank $@=\\dim V$.", [indexed("G"), Math::count(relevant)]),
        );
        let positive = dot_columns(&own.functional, &own.rays);
        let mut text = line("$@@>0$ for ", [indexed("f"), indexed("G")]);
        text.extend(line("$@=@$", [indexed("f"), Math::vector(&own.functional)]));
        if printed(cone) {
            text.extend(line(": $@@=@$", [indexed("f"), indexed("G"), Math::vector(&positive)]));
        }
        evidence.push("cones", Tone::Good, text);
        let mut text = line(
            "the chord, end minus start, is $@=@@$",
            [Math::vector(&own.rays.apply(&own.chord)), indexed("G"), indexed("y")],
        );
        let coefficients = if printed(cone) { " with $@=@≥0$." } else { " with $@≥0$." };
        let mut values = vec![indexed("y")];
        if printed(cone) {
            values.push(Math::vector(&own.chord));
        }
        text.extend(line(coefficients, values));
        evidence.push(name("chords"), Tone::Good, text);
    }
    let images = if slow {
        "$ε_i T_i G_δ=G_e B_i$ with $B_i≥0$, without zero columns, for every piece, as below."
    } else {
        "$ε_i T_i G_δ=G_e B_i$ with $B_i>0$ for every piece, as below."
    };
    evidence.push(name("positive"), Tone::Good, line(images, []));
    evidence.push(
        name("view"),
        if cone.view.is_none() && case.shape.control.is_some() { Tone::Open } else { Tone::Good },
        view(case, cone),
    );
    if slow {
        evidence.push("factors", Tone::Good, factors(cone));
        if cone.slow.is_empty() {
            evidence.push(
                "cycles",
                Tone::Neutral,
                words("there is none, since the products of that many letters are all positive somewhere."),
            );
        }
        let spaces = Spaces::new(&case.shape);
        for cycle in &cone.slow {
            match spaces.as_ref().and_then(|spaces| cycle.on_rays(cone, spaces)) {
                Some(values) => evidence.push("cycles", Tone::Good, pulled(cycle, &values)),
                None => evidence.push("cycles", Tone::Bad, words("the rays were not examined.")),
            }
        }
    }
    evidence
}

fn view(case: &Case, cone: &CommonCone) -> Line {
    match (&cone.view, case.shape.control.is_some()) {
        (Some(h), _) => line("$h P G>0$ for the start state and $h=@$.", [Math::vector(h)]),
        (None, false) => words("there are no control points."),
        (None, true) => {
            words("no functional h was found, so that the conclusions are about the curve before the projection.")
        }
    }
}

fn factors(cone: &CommonCone) -> Line {
    let window = count(cone.window, "letter");
    let cycles: Vec<String> = cone.slow.iter().map(|s| format!("`{}`", word_text(&s.word))).collect();
    if cycles.is_empty() {
        return words(format!("every word of {window} has a factor with a positive product of the matrices B."));
    }
    let text = format!(
        "the graph of the words of {window} none of whose factors has a positive product has only the cycles of {}, and these do not meet.",
        listed(&cycles)
    );
    line(&text, [])
}

/// The eigenvalue of a slow cycle and the leading coefficients of the rays.
fn pulled(cycle: &SlowCycle, values: &[(Elem, bool)]) -> Line {
    let (root, factor) = (cycle.spectrum.root(cycle.lead), cycle.spectrum.factor(cycle.lead));
    let text = format!(
        "along `{}` the product has $@>0$ with the one longest Jordan block, of length $@$, of largest modulus",
        word_text(&cycle.word)
    );
    let mut out = line(&text, [lambda_math(root), Math::count(factor.blocks[0])]);
    out.extend(root_of(root));
    let coefficients = Math::tuple(values.iter().map(|(value, _)| elem_math(value)).collect());
    out.extend(line("; $g x=@$ on the rays", [coefficients]));
    let own: Vec<String> =
        values.iter().enumerate().filter(|(_, v)| v.0.sign(root) <= 0).map(|(k, _)| (k + 1).to_string()).collect();
    let all_positive = values.iter().all(|(value, _)| value.sign(root) > 0);
    out.extend(words(match (all_positive, own.as_slice()) {
        (true, _) => ", all positive.".to_owned(),
        (false, [one]) => format!(", positive but on ray {one}, which is a multiple of the eigenvector with the sign in which the others tend to it."),
        (false, _) => format!(", positive but on the rays {}, which are multiples of the eigenvector with the sign in which the others tend to it.", listed(&own)),
    }));
    out
}

/// The values of a functional on the columns of a matrix.
fn dot_columns(functional: &[Rational], columns: &Matrix) -> Vec<Rational> {
    (0..columns.cols()).map(|j| dot(functional, &columns.column(j))).collect()
}

/// The matrices of coefficients: small ones with their entries, of others the size.
fn images(case: &Case, cone: &CommonCone) -> Vec<Block> {
    let several = case.shape.states.len() > 1;
    let fits = cone.maps.iter().all(|m| width(&m.matrix) <= MAX_WIDTH);
    let rows = cone.maps.iter().map(|m| {
        let mut row = vec![words(m.letter.to_string()), words(m.sign.to_string().replace('-', "−"))];
        if several {
            row.insert(0, words(case.shape.states[m.state].name.clone()));
        }
        row.push(if fits {
            formula(Math::matrix(&m.matrix))
        } else {
            line("$@×@$", [Math::count(m.matrix.rows()), Math::count(m.matrix.cols())])
        });
        row.push(formula(least(&m.matrix)));
        row
    });
    let what = if fits { "$B_i$" } else { "size of $B_i$" };
    let mut header = vec![words("piece"), line("$ε_i$", []), line(what, []), words("smallest entry")];
    if several {
        header.insert(0, words("state"));
    }
    let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() });
    let summary = line("The images of the cones, $ε_i T_i G_δ=G_e B_i$:", []);
    let mut blocks = vec![Block::Details { summary, blocks: vec![table] }];
    if !fits || cone.cones.iter().any(|c| c.rays.cols() > MAX_RAYS) {
        blocks.push(Block::text(
            "Numbers that are not printed here are in the output of `secant certify CASE --json`, under `every_point.cone`.",
            [],
        ));
    }
    blocks
}

/// About how many characters a row of a matrix takes, fractions being stacked.
fn width(m: &Matrix) -> usize {
    let cell = |x: &Rational| x.numerator_ref().to_string().len().max(x.denominator_ref().to_string().len());
    (0..m.cols()).map(|j| (0..m.rows()).map(|i| cell(&m[(i, j)])).max().unwrap_or(0) + 2).sum()
}

/// The smallest entry of a matrix, rounded downwards where it is long.
fn least(m: &Matrix) -> Math {
    let Some(least) = (0..m.rows()).flat_map(|i| m.row(i).iter()).min() else { return Math::count(0) };
    let keeps_sign = |places: &u64| *least >= Rational::from(1) / Rational::from(10).pow(*places);
    match [6, 12, 24].into_iter().find(keeps_sign) {
        Some(places) if least.to_string().len() > SHORT => {
            let digits = Math::Digits(decimal(least, false, places));
            Math::parse("≥@", &mut std::iter::once(digits))
        }
        _ => Math::number(least),
    }
}

/// Numbers of at most so many characters are written exactly.
const SHORT: usize = 16;
