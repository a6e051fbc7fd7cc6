//! The section on orders of smoothness in the parameter of a curve.

use super::super::document::{Block, Line, Table, formula, line, words};
use super::super::math::Math;
use super::super::radius::interval;
use super::super::regularity;
use super::super::reported::Reported;
use super::super::words::mark;
use super::Quoted;
use super::evidence::Evidence;
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::case::{Case, Origin};
use crate::scheme::Matching;
use crate::statement::Statement;
use crate::theorem::smoothness::{CurveOrder, CurveRegularity};
use crate::theorem::{Certified, Measure, Parameter};

pub(super) fn section<E: Reported>(case: &Case<E>, found: &Certified<E>, seen: &mut Quoted) -> Vec<Block> {
    let orders = match &found.parameter {
        Some(Parameter::Orders(orders)) => orders,
        _ => return Vec::new(),
    };
    let mut blocks = vec![Block::heading(2, "Smoothness in the parameter"), seen.once(Statement::Smoothness)];
    blocks.push(evidence(orders).block());
    blocks.push(table(orders));
    let notes: Vec<Line> = orders
        .orders
        .iter()
        .filter_map(|o| Some(words(format!("Order {}: {}.", o.order, regularity::outcome(&case.shape, o)?))))
        .collect();
    if !notes.is_empty() {
        blocks.push(Block::List(notes));
    }
    blocks.extend(polygons(case, orders, seen));
    blocks.extend(matching(case, orders, seen));
    blocks
}

/// What the control polygons do, in the orders that hold.
fn polygons<E: Reported>(case: &Case<E>, orders: &CurveRegularity<E>, seen: &mut Quoted) -> Vec<Block> {
    let known = orders.orders.iter().filter(|o| o.polygons.is_some());
    let notes: Vec<Line> = known
        .filter_map(|o| Some(words(format!("Order {}: {}.", o.order, regularity::polygons(&case.shape, o)?))))
        .collect();
    if notes.is_empty() {
        return Vec::new();
    }
    let proof = Evidence::of(Statement::DifferencePolygons)
        .holds("smooth", "the orders below are proved above.", [])
        .holds("polygon", "$μ_e$ is the factor of the derivative below, and was found by linear algebra.", []);
    vec![seen.once(Statement::DifferencePolygons), proof.block(), Block::List(notes)]
}

/// What Theorem 10 says of data that are interpolated, by its own numbers.
fn matching<E: Reported>(case: &Case<E>, orders: &CurveRegularity<E>, seen: &mut Quoted) -> Vec<Block> {
    let Some(Origin::Interpolation(data)) = &case.scheme else { return Vec::new() };
    let rows: Vec<(usize, Matching)> = (1..orders.orders.len()).filter_map(|k| Some((k, data.matching(k)?))).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let proof = Evidence::of(Statement::Theorem10)
        .holds("intervals", "the abscissas of the data increase.", [])
        .holds("factors", "the factors are numbers below 1 in modulus, and the $q_j$ polynomials.", [])
        .holds("order-0", "the pieces meet at the points of the data.", []);
    let row = |(k, m): &(usize, Matching)| {
        let numbers = |list: &[Rational]| line("$@$", [Math::vector(list)]);
        let pair = |[a, b]: &[Rational; 2]| [a.clone(), b.clone()];
        let joints: Vec<Rational> = m.joints.iter().flat_map(pair).collect();
        vec![
            formula(Math::count(*k)),
            numbers(&m.ratios),
            m.ends.as_ref().map_or_else(|| words("–"), |ends| numbers(ends)),
            if joints.is_empty() { words("–") } else { numbers(&joints) },
        ]
    };
    let header = vec![
        line("$k$", []),
        line("$|α_j|/a_j^k$", []),
        line("$y_{0,k}$, $y_{N,k}$", []),
        line("both sides of the equations at the inner points", []),
    ];
    let table = Table { caption: Line::new(), header, rows: rows.iter().map(row).collect() };
    vec![seen.once(Statement::Theorem10), proof.block(), Block::Table(table)]
}

fn evidence<E>(orders: &CurveRegularity<E>) -> Evidence {
    let uniform =
        "every state that leads back to itself has $N=@$ pieces; they meet, and the system contracts, as shown above.";
    let shares =
        "the pieces take the given shares of the parameter; they meet, and the system contracts, as shown above.";
    let proof = Evidence::of(Statement::Smoothness);
    let proof = match orders.measure() {
        Measure::Uniform => proof.holds("pieces", uniform, [Math::count(orders.pieces)]),
        Measure::Shares => proof.holds("pieces", shares, []),
    };
    proof.holds("seen", "the visible quotient of the start is not 0.", []).holds(
        "differences",
        "the dimensions of the $F^k_e$, state by state, stand in the table.",
        [],
    )
}

fn table<E>(orders: &CurveRegularity<E>) -> Block {
    let row = |o: &CurveOrder<E>| {
        let dims: Vec<String> = o.dims.iter().map(ToString::to_string).collect();
        let verdict = match o.smooth() {
            Some(true) => Verdict::Proved,
            Some(false) => Verdict::Refuted,
            None => Verdict::Undetermined,
        };
        vec![
            formula(Math::count(o.order)),
            words(dims.join(", ")),
            words(o.enclosure.as_ref().map_or_else(|| "–".to_owned(), interval)),
            formula(Math::number(&o.threshold)),
            vec![mark(verdict)],
        ]
    };
    let (radius, bound) = match orders.measure() {
        Measure::Uniform => ("joint spectral radius on $F^k$", "bound $N^{-k}$"),
        Measure::Shares => ("joint spectral radius of the $s_i^{-k}T_i$ on $F^k$", "bound"),
    };
    let header = vec![line("$k$", []), line("$\\dim F^k$", []), line(radius, []), line(bound, []), line("$C^k$", [])];
    Block::Table(Table { caption: Line::new(), header, rows: orders.orders.iter().map(row).collect() })
}
