//! The section on every point of a curve: the cones, or why there are none.

use super::super::document::{Block, Check, Line, Tone, line, words};
use super::super::every;
use super::super::math::Math;
use super::super::radius::decimal;
use super::super::values::{elem_math, lambda_math};
use super::super::words::{count, listed, mark, point_name, root_of, tone};
use super::cones::Cones;
use super::evidence::Evidence;
use super::{Quoted, components};
use crate::algebraic::{Elem, Real};
use crate::arith::Rational;
use crate::case::Case;
use crate::report::figures;
use crate::report::reported::Reported;
use crate::shape::{Spaces, word_text};
use crate::statement::Statement;
use crate::theorem::cone::{CommonCone, most_pieces};
use crate::theorem::{Certified, PointReport, SlowCycle};

/// The section on every point of a curve.
pub(in crate::report) fn of_curve(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let blocks = curve(case, found, seen);
    let heading = (!blocks.is_empty()).then(|| Block::heading(2, "Every point"));
    heading.into_iter().chain(blocks).collect()
}

/// The section on every point of a curve with entries in a number field.
pub(in crate::report) fn over_field(case: &Case<Real>, found: &Certified<Real>, seen: &mut Quoted) -> Vec<Block> {
    if let Some(order) = &found.graph {
        let heading = Block::heading(2, "Every point");
        return std::iter::once(heading)
            .chain(seen.once_id(Statement::Graph))
            .chain([Block::Checks(derivative(order))])
            .collect();
    }
    let Some(cones) = &found.cones else { return Vec::new() };
    let mut blocks = vec![Block::heading(2, "Every point")];
    blocks.extend(seen.once_id(Statement::Theorem6));
    let all = Cones { cones: &cones.cones, maps: &cones.maps, view: cones.view.as_deref() };
    blocks.extend(all.rays(case));
    blocks.push(all.evidence(case, found, Statement::Theorem6).block());
    blocks.extend(all.images(case));
    blocks.extend(joints(case, &cones.joints.iter().collect::<Vec<_>>()));
    blocks
}

/// The first-level joints with what was found there.
fn joints<E: Reported>(case: &Case<E>, points: &[&PointReport<E>]) -> Vec<Block> {
    if points.is_empty() {
        return Vec::new();
    }
    let check = |point: &&PointReport<E>| {
        let mut text = words(format!("{}: ", point_name(&case.shape, point)));
        text.push(mark(point.verdict));
        text.extend(words(format!(", {}", point.kind.word())));
        Check { tone: tone(point.verdict), text }
    };
    vec![
        Block::text("The first-level joints of all reachable states:", []),
        Block::Checks(points.iter().map(check).collect()),
    ]
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
        blocks.extend(shown(cone).rays(case));
        blocks.push(evidence(case, found, cone, statement).block());
        blocks.extend(shown(cone).images(case));
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
    blocks.extend(joints(case, &result.joints.iter().map(|joint| joint.report(found)).collect::<Vec<_>>()));
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
fn derivative<E: Reported>(order: &crate::theorem::smoothness::CurveOrder<E>) -> Vec<Check> {
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

/// The cones as all pages show them.
fn shown(cone: &CommonCone) -> Cones<'_, Rational> {
    Cones { cones: &cone.cones, maps: &cone.maps, view: cone.view.as_deref() }
}

/// What was verified of Theorem 6 or 6′. All that 6′ takes over from 6 stands under its hypothesis *cones*.
fn evidence(case: &Case, found: &Certified, cone: &CommonCone, statement: Statement) -> Evidence {
    let mut evidence = shown(cone).evidence(case, found, statement);
    if statement == Statement::Theorem6Slow {
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
