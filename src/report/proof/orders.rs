//! The section on orders of smoothness in the uniform parameter.

use super::super::document::{Block, Line, Table, formula, line, words};
use super::super::math::Math;
use super::super::radius::interval;
use super::super::regularity;
use super::super::words::mark;
use super::Quoted;
use super::evidence::Evidence;
use crate::answer::Verdict;
use crate::case::Case;
use crate::statement::Statement;
use crate::theorem::smoothness::{CurveOrder, CurveRegularity};
use crate::theorem::{Certified, Parameter};

pub(super) fn section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
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
    blocks
}

fn evidence(orders: &CurveRegularity) -> Evidence {
    let pieces =
        "every state that leads back to itself has $N=@$ pieces; they meet, and the system contracts, as shown above.";
    Evidence::of(Statement::Smoothness)
        .holds("pieces", pieces, [Math::count(orders.pieces)])
        .holds("seen", "the visible quotient of the start is not 0.", [])
        .holds("differences", "the dimensions of the $F^k_e$, state by state, stand in the table.", [])
}

fn table(orders: &CurveRegularity) -> Block {
    let row = |o: &CurveOrder| {
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
    let header = vec![
        line("$k$", []),
        line("$\\dim F^k$", []),
        line("joint spectral radius on $F^k$", []),
        line("bound $N^{-k}$", []),
        line("$C^k$", []),
    ];
    Block::Table(Table { caption: Line::new(), header, rows: orders.orders.iter().map(row).collect() })
}
