//! The section on every point of a curve: the cones, or why there are none.

use super::super::document::{Block, Check, Line, Table, Tone, formula, line, words};
use super::super::every;
use super::super::math::Math;
use super::super::radius::decimal;
use super::super::words::{count, mark, point_name, tone};
use super::{Quoted, matrix};
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::{Matrix, dot};
use crate::report::figures;
use crate::shape::word_text;
use crate::statement::Statement;
use crate::theorem::Certified;
use crate::theorem::cone::CommonCone;
use malachite_base::num::arithmetic::traits::Pow;

pub(super) fn section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let Some(result) = &found.everywhere else { return Vec::new() };
    let mut blocks = vec![Block::heading(2, "Every point")];
    if let Some(cone) = &result.cone {
        if !cone.slow.is_empty() {
            // Theorem 6′ refers to Theorem 6.
            blocks.extend(seen.once_id(Statement::Theorem6));
        }
        blocks.extend(seen.once_id(every::theorem(cone)));
        blocks.extend(cones(case, found, cone));
    }
    if let Some(order) = &result.derivative {
        blocks.extend(seen.once_id(Statement::Graph));
        blocks.push(Block::Checks(derivative(order)));
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
        blocks.push(Block::Checks(checks));
    }
    if let Some(o) = &result.obstacle {
        let text = format!(
            "In coordinates of $V$, with the orientation signs, the product of the operators along the cycle `{}` is",
            word_text(&o.word)
        );
        blocks.push(Block::text(&text, []));
        blocks.push(Block::Formula(Math::matrix(&o.product)));
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
        texts.push(format!("the joint spectral radius of the $T_i$ on $F$ is at most {hi}, which is below $1/N=@$"));
    }
    texts.push("the derivatives of the two sides are equal at every first-level joint".to_owned());
    let threshold = || std::iter::once(Math::number(&order.threshold));
    texts.into_iter().map(|text| Check { tone: Tone::Good, text: line(&text, threshold()) }).collect()
}

/// Most rays that are printed.
const MAX_RAYS: usize = 12;
/// Wider matrices of coefficients are not printed: about so many characters fit a line.
const MAX_WIDTH: usize = 54;

fn cones(case: &Case, found: &Certified, cone: &CommonCone) -> Vec<Block> {
    let mut blocks = Vec::new();
    let several = case.shape.states.len() > 1;
    let printed = cone.cones.iter().all(|c| c.rays.cols() <= MAX_RAYS);
    let mut checks = Vec::new();
    for own in &cone.cones {
        let name = Math::Word(case.shape.states[own.state].name.clone());
        let of = if several { format!(" of state {}", case.shape.states[own.state].name) } else { String::new() };
        let indexed = |letter: &str| Math::parse(&format!("{letter}_@"), &mut std::iter::once(name.clone()));
        let relevant = found.states.iter().find(|s| s.state == own.state).map_or(own.rays.rank(), |s| s.relevant);
        let mut head = line(&format!("The cone{of} is that of {}", count(own.rays.cols(), "ray")), []);
        if printed {
            head.extend(line(", the columns of", []));
        }
        blocks.push(Block::Paragraph(head));
        if printed {
            blocks.push(matrix(indexed("G"), &own.rays));
        }
        checks.push(Check {
            tone: Tone::Good,
            text: line("$@$ has the rank $@=\\dim V$.", [indexed("G"), Math::count(relevant)]),
        });
        let positive = dot_columns(&own.functional, &own.rays);
        let mut text = line("$@@>0$ for ", [indexed("f"), indexed("G")]);
        text.extend(line("$@=@$", [indexed("f"), Math::vector(&own.functional)]));
        if printed {
            text.extend(line(": $@@=@$", [indexed("f"), indexed("G"), Math::vector(&positive)]));
        }
        checks.push(Check { tone: Tone::Good, text });
        let mut text = line(
            "The chord, end minus start, is $@=@@$",
            [Math::vector(&own.rays.apply(&own.chord)), indexed("G"), indexed("y")],
        );
        let coefficients = if printed { " with $@=@≥0$." } else { " with $@≥0$." };
        let mut values = vec![indexed("y")];
        if printed {
            values.push(Math::vector(&own.chord));
        }
        text.extend(line(coefficients, values));
        checks.push(Check { tone: Tone::Good, text });
    }
    let strict = cone.slow.is_empty() && cone.window == 1;
    let text = if strict {
        "$ε_i T_i G_δ=G_e B_i$ with $B_i>0$ for every piece, as below."
    } else {
        "$ε_i T_i G_δ=G_e B_i$ with $B_i≥0$, without zero columns, for every piece, as below."
    };
    checks.push(Check { tone: Tone::Good, text: line(text, []) });
    if let Some(h) = &cone.view {
        let text = line("With the control points $P$: $h P G>0$ for the start and $h=@$.", [Math::vector(h)]);
        checks.push(Check { tone: Tone::Good, text });
    }
    for slow in &cone.slow {
        let text = format!(
            "Along the cycle `{}` no product of the matrices $B$ is positive; there one positive eigenvalue has the one longest \
             Jordan block of largest modulus, and its leading coefficient is positive on all rays.",
            word_text(&slow.word)
        );
        checks.push(Check { tone: Tone::Good, text: line(&text, []) });
    }
    blocks.push(Block::Checks(checks));
    blocks.extend(images(case, cone));
    blocks
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
            "Numbers that are not printed here are in the output of `secant certify CASE --json`, under `everywhere`.",
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
