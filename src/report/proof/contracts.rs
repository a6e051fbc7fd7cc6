//! Why a system contracts, and what holds its attractors.

use super::super::document::{Block, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::words::{contraction, count, short_bound};
use super::evidence::Evidence;
use super::{Quoted, product};
use crate::arith::{Rational, abs};
use crate::report::reported::{Reported, vector};
use crate::shape::{Contracting, ContractingWord, Contraction, Polytopes, Shape, difference, word_text};
use crate::statement::Statement;
use crate::theorem::surface::SurfaceBranch;
use crate::theorem::{BranchReport, Certified, Outcome, StateReport, Witness};

/// Binary digits of the enclosures of irrational numbers.
const BITS: u64 = 300;

/// Most code words that are listed.
const MAX_WORDS: usize = 400;

/// The section on contraction.
pub(super) fn section<E: Reported>(shape: &Shape<E>, found: &Contraction, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = Vec::new();
    match found {
        Contraction::Product(proof) => {
            blocks.extend(seen.once_id(Statement::ProductContraction));
            let mut text = words("the first curve: ");
            text.extend(contraction(&proof.factors[0]));
            text.extend(words("; the second: "));
            text.extend(contraction(&proof.factors[1]));
            text.extend(words("."));
            let mut evidence = Evidence::of(Statement::ProductContraction);
            evidence.push("factors", Tone::Good, text);
            blocks.push(evidence.block());
        }
        Contraction::Proved(proof) => {
            blocks.extend(seen.once_id(Statement::Lemma1));
            blocks.push(code_evidence(proof).block());
            blocks.push(code_words(shape, proof));
        }
        Contraction::Polytopes(proof) => {
            blocks.extend(seen.once_id(Statement::Lemma1Prime));
            blocks.push(polytope_evidence(proof).block());
            blocks.push(shares(shape, proof));
        }
        Contraction::Refuted { .. } | Contraction::Undetermined { .. } => {
            let mut result = words("Contraction is ");
            result.extend(contraction(found));
            result.extend(words("."));
            blocks.push(Block::Paragraph(result));
        }
    }
    blocks
}

fn code_evidence(proof: &Contracting) -> Evidence {
    let total: usize = proof.codes.iter().map(Vec::len).sum();
    let text = format!(
        "{} of at most {}, listed below; every longer admissible word begins with exactly one of those of its state.",
        count(total, "word"),
        count(proof.length, "letter")
    );
    Evidence::of(Statement::Lemma1).holds("code", &text, []).holds(
        "bound",
        "$τ(T_w)$ is at most $@$ for each of them, as listed.",
        [short_bound(&proof.constant)],
    )
}

fn polytope_evidence(proof: &Polytopes) -> Evidence {
    Evidence::of(Statement::Lemma1Prime)
        .holds(
            "points",
            "the @ vertices listed below; those of each state span its space affinely (their rank is its dimension).",
            [Math::count(proof.count())],
        )
        .holds("pieces", "as in the table; the largest $1-m$ is at most $@$.", [short_bound(&proof.constant)])
}

/// `m` and `c` of every piece.
fn shares<E: Reported>(shape: &Shape<E>, proof: &Polytopes) -> Block {
    let mut rows = Vec::new();
    for e in shape.reachable() {
        for i in 0..shape.states[e].pieces.len() {
            let name = vec![words(shape.states[e].name.clone()), words(i.to_string())];
            let values = match proof.share(e, i) {
                Some((m, c)) => vec![formula(Math::number(&m)), formula(vector(&c))],
                None => vec![words("–"), words("–")],
            };
            rows.push([name, values].concat());
        }
    }
    let header = vec![words("state"), words("piece"), line("$m$", []), line("$c$", [])];
    let table = Block::Table(by_state(shape, Table { caption: Line::new(), header, rows }));
    let summary = line(
        "The shares of the pieces: $m=∑_k \\min w_k$ and $m c=∑_k (\\min w_k) h_k$, where $w_k$ is the weight of the vertex $h_k$ in the image of a \
         vertex under the piece, and the minimum is over all images; the weights are in the certificate, under `contraction`:",
        [],
    );
    Block::Details { summary, blocks: vec![table] }
}

/// A number exactly where that is short, otherwise as an upper bound.
pub(super) fn bounded(x: &Rational) -> Math {
    match short_bound(x) {
        exact @ Math::Number(_) => exact,
        above => Math::parse("≤@", &mut std::iter::once(above)),
    }
}

/// The words of the code with their coefficients.
fn code_words<E: Reported>(shape: &Shape<E>, proof: &Contracting) -> Block {
    let total: usize = proof.codes.iter().map(Vec::len).sum();
    let several = shape.states.len() > 1;
    let mut rows = Vec::new();
    for (e, code_of_state) in proof.codes.iter().enumerate() {
        for word in code_of_state {
            let mut row = vec![code(word_text(&word.word)), formula(bounded(&word.tau))];
            if several {
                row.insert(0, words(shape.states[e].name.clone()));
            }
            rows.push(row);
        }
    }
    let mut caption = words("The words of the prefix code");
    if total > MAX_WORDS {
        rows.truncate(MAX_WORDS);
        caption.extend(words(format!(", the first {MAX_WORDS} of {total}; the certificate has all")));
    }
    let mut header = vec![words("word"), line("$τ(T_w)$", [])];
    if several {
        header.insert(0, words("state"));
    }
    let table = Block::Table(Table { caption: Line::new(), header, rows }.beside());
    if total > 12 { Block::Details { summary: caption, blocks: vec![table] } } else { table }
}

/// Whether some proof of the report looks at the values of a functional on cells.
pub(super) fn uses_enclosures<E: Reported>(found: &Certified<E>) -> bool {
    let curve = |b: &BranchReport<E>| match &b.outcome {
        Outcome::Line { proof, .. } => proof.is_some(),
        Outcome::AtLeast { isolation, witness, .. } => {
            isolation.is_some() || matches!(witness, Some(Witness::Crossing { .. }))
        }
        Outcome::NoGerm { .. } | Outcome::Open { .. } => true,
    };
    let general = found.surface.iter().flat_map(|s| &s.points).filter(|p| !product::settles(p));
    let surface = |b: &SurfaceBranch| {
        let o = &b.outcome;
        o.ring.is_some() || o.isolation.is_some() || o.depth.is_some() || o.open.is_some()
    };
    found.points.iter().flat_map(|p| &p.branches).any(curve) || general.flat_map(|p| &p.branches).any(surface)
}

/// The statement on enclosures with its evidence, and the polygons where some are used.
pub(super) fn enclosures<E: Reported>(
    shape: &Shape<E>,
    found: &Contraction,
    states: &[StateReport<E>],
    polygons: Vec<Block>,
    seen: &mut Quoted,
) -> Vec<Block> {
    let mut blocks: Vec<Block> = seen.once_id(Statement::Enclosures).into_iter().collect();
    let mut evidence = Evidence::of(Statement::Enclosures);
    match found {
        Contraction::Proved(proof) => {
            for state in states {
                let of = if shape.states.len() > 1 {
                    format!(" of state {}", shape.states[state.state].name)
                } else {
                    String::new()
                };
                let (tone, text) = match largest_sum(shape, states, proof, state) {
                    Some(sum) if sum <= state.radius => {
                        let text = format!(
                            "for all code words{of} the right side is at most $@$, and the radius given is not smaller."
                        );
                        (Tone::Good, line(&text, [short_bound(&sum)]))
                    }
                    _ => (Tone::Bad, words(format!("the radius{of} is not confirmed by the code words."))),
                };
                evidence.push("balls", tone, text);
            }
        }
        Contraction::Product(_) => {
            let text = "the radius is that of a ball around the product of two balls (Contraction of a product).";
            evidence = evidence.holds("balls", text, []);
        }
        Contraction::Polytopes(_) => {
            let text = "the radius is the distance of the farthest vertex of the polytope (Lemma 1′).";
            evidence = evidence.holds("balls", text, []);
        }
        Contraction::Refuted { .. } | Contraction::Undetermined { .. } => {}
    }
    blocks.push(evidence.block());
    blocks.extend(polygons);
    blocks
}

/// The largest `‖T_w c_δ − c_e‖ + τ(T_w) r_δ` over the code words of a state; `None` where one of them cannot be computed.
fn largest_sum<E: Reported>(
    shape: &Shape<E>,
    states: &[StateReport<E>],
    proof: &Contracting,
    own: &StateReport<E>,
) -> Option<Rational> {
    // Of an irrational number an upper bound.
    let size = |x: &E| {
        let enclosure = x.enclosure(BITS);
        abs(&enclosure.lo).max(abs(&enclosure.hi))
    };
    let sum = |word: &ContractingWord| {
        let target = states.iter().find(|s| s.state == word.end)?;
        let (op, _) = shape.product(own.state, &word.word);
        let moved: Rational = difference(&op.apply(&target.base), &own.base).iter().map(size).sum();
        Some(moved + &word.tau * &target.radius)
    };
    proof.codes.get(own.state)?.iter().map(sum).collect::<Option<Vec<_>>>()?.into_iter().max()
}

/// The polygons that hold the attractors, where a ring condition used them.
pub(super) fn polygons<E: Reported>(shape: &Shape<E>, found: &Certified<E>) -> Vec<Block> {
    if let Contraction::Polytopes(proof) = &found.contraction {
        let text = "The attractors lie inside the polytopes that prove contraction; a functional takes its extreme values at vertices.";
        let table = vertices(shape, |e| &proof.vertices[e]);
        let summary = words("The vertices of the polytopes:");
        return vec![Block::text(text, []), Block::Details { summary, blocks: vec![table] }];
    }
    if !found.points.iter().flat_map(|p| &p.branches).any(uses_polygons) {
        return Vec::new();
    }
    let Some(hulls) = &found.polygons else { return Vec::new() };
    let table = vertices(shape, |e| &hulls[e]);
    vec![
        Block::text(
            "Where a ring condition needs sharper enclosures, these convex polygons are used: every map sends polygon into polygon, which is \
             checked exactly at the vertices, so that the attractors lie inside; a functional takes its extreme values at vertices.",
            [],
        ),
        Block::Details { summary: words("The vertices of the polygons:"), blocks: vec![table] },
    ]
}

/// The vertices of all reachable states.
pub(super) fn vertices<'a, E: Reported, X: Reported>(shape: &Shape<E>, of: impl Fn(usize) -> &'a [Vec<X>]) -> Block {
    let row = |(e, vertex): (usize, &Vec<_>)| vec![words(shape.states[e].name.clone()), formula(vector(vertex))];
    let rows = shape.reachable().into_iter().flat_map(|e| of(e).iter().map(move |v| (e, v))).map(row).collect();
    let header = vec![words("state"), words("vertex")];
    Block::Table(by_state(shape, Table { caption: Line::new(), header, rows }).beside())
}

fn uses_polygons<E: Reported>(branch: &BranchReport<E>) -> bool {
    match &branch.outcome {
        Outcome::Line { proof, .. } => proof.as_ref().is_some_and(|p| p.polygons),
        Outcome::AtLeast { isolation, witness, .. } => {
            let crossing = matches!(witness, Some(Witness::Crossing { cover, .. }) if cover.polygons);
            crossing || isolation.as_ref().is_some_and(|p| p.polygons)
        }
        Outcome::NoGerm { .. } | Outcome::Open { .. } => false,
    }
}

/// A table whose first column names states, without that column where there is one state only.
pub(super) fn by_state<E: Reported>(shape: &Shape<E>, mut table: Table) -> Table {
    if shape.states.len() == 1 {
        table.header.remove(0);
        table.rows.iter_mut().for_each(|row| drop(row.remove(0)));
    }
    table
}
