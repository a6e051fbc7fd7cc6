//! The proof-style report: every statement applied, with every number that it needs, in an order in which it can be
//! checked by hand.

mod cycles;
mod dense;
mod every;
mod points;
mod scheme;
mod surface;

use super::document::{Block, Document, Inline, Line, line, words};
use super::figures;
use super::math::Math;
use super::summary::{claim_line, shape_line};
use super::theorems::{THEOREMS, Theorem};
use super::words::{mark, statement};
use crate::case::Case;
use crate::shape::Spaces;
use crate::theorem::{BranchReport, Certified, Verdict};

/// The whole proof as a document.
#[must_use]
pub fn document(case: &Case, found: &Certified) -> Document {
    let mut blocks = opening(case, found);
    blocks.extend(scheme::section(case, found));
    let cycles = cycles::distinct(found);
    if let Some(spaces) = Spaces::new(&case.shape).filter(|_| !found.points.is_empty()) {
        blocks.push(Block::heading(2, "The cycles"));
        blocks.push(Block::text(
            "Every point examined has one or two branches: addresses $u w^ω$ with a prefix $u$ and a cycle $w$. What follows depends on the \
             cycle alone: $M=T_w$ has the fixed point $q$, $V$ is the span of the differences of the attractor, $L$ is $M$ on $V$ (on the part of \
             $V$ that is seen, where control points do not see all of it), the ring $K$ is what leaves the cycle during its first turn, \
             and $X=K-q$. All points near $q$ are images $M^m x$ of points of the ring.",
            [],
        ));
        for (k, branch) in cycles.iter().enumerate() {
            blocks.extend(cycles::section(case, &spaces, branch, k));
        }
        blocks.extend(points::section(case, found, &cycles));
    }
    if let Some(surface) = &found.surface {
        blocks.extend(surface::section(case, surface));
    }
    blocks.extend(dense::section(case, found));
    blocks.extend(every::section(case, found));
    blocks.extend(closing(found));
    Document { title: case.title.clone(), blocks }
}

fn opening(case: &Case, found: &Certified) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "What is claimed")];
    let mut shape = line("Let $A$ be the attractor of the case ", []);
    shape.push(Inline::Code(case.name.clone()));
    shape.extend(words(": a "));
    shape.extend(shape_line(case));
    shape.extend(words("."));
    blocks.push(Block::Paragraph(shape));
    if let Some(source) = &case.source {
        blocks.push(Block::Paragraph(words(format!("Source of the case: {source}."))));
    }
    blocks.push(Block::List(found.claims.iter().map(claim_line).collect()));
    let mut verdict = words("Verdict on all claims together: ");
    verdict.push(mark(found.verdict));
    verdict.extend(words(match found.verdict {
        Verdict::Proved => ". Every number below is exact unless it is marked by ≈ or given as a decimal bound rounded outwards.",
        Verdict::Refuted => ". The witness is given below. Every number is exact unless it is marked by ≈ or given as a decimal bound rounded outwards.",
        Verdict::Undetermined => ". What was established, and where the proof stopped, is given below.",
    }));
    blocks.push(Block::Paragraph(verdict));
    if let Some(picture) = figures::attractor(case, found) {
        blocks.push(Block::Figure {
            svg: picture.svg,
            tikz: picture.tikz,
            alt: picture.alt,
            caption: words(picture.caption),
        });
    }
    blocks
}

/// A statement, quoted.
fn quoted(theorem: &Theorem) -> Block {
    Block::Statement { name: theorem.name.to_owned(), body: line(theorem.body, []) }
}

/// The statement with an id, quoted.
fn quoted_id(id: &str) -> Block {
    quoted(THEOREMS.iter().find(|t| t.id == id).unwrap_or(&THEOREMS[0]))
}

fn closing(found: &Certified) -> Vec<Block> {
    let mut used: Vec<&str> = Vec::new();
    for branch in found.points.iter().flat_map(|p| &p.branches) {
        if let Some(s) = applied(branch) {
            let name = statement(s);
            if !used.contains(&name) {
                used.push(name);
            }
        }
    }
    let of_surface = found.surface.iter().flat_map(|s| &s.points).flat_map(|p| &p.branches);
    for name in of_surface.filter_map(|b| b.outcome.statement).map(statement) {
        if !used.contains(&name) {
            used.push(name);
        }
    }
    for name in found.claims.iter().filter_map(|c| c.statement).map(statement) {
        if !used.contains(&name) {
            used.push(name);
        }
    }
    let mut blocks = vec![Block::heading(2, "References")];
    let mut items: Vec<Line> = vec![words(
        "S. Podkorytov, Tangent spaces for self-similar shapes, PhD thesis, Université de Bourgogne, Dijon 2013, tel-01005330; chapter 3 for the \
         models, chapter 4 for the conditions.",
    )];
    if !used.is_empty() {
        let text = format!("Statements applied: {}. Proofs: docs/theory.md, or `secant explain`.", used.join("; "));
        items.push(line(&text, []));
    }
    let version = env!("CARGO_PKG_VERSION");
    items.push(words(format!("Computed by secant {version} in exact rational and algebraic arithmetic.")));
    blocks.push(Block::List(items));
    blocks
}

/// The statement applied at a branch.
fn applied(branch: &BranchReport) -> Option<crate::theorem::Statement> {
    use crate::theorem::Outcome;
    match &branch.outcome {
        Outcome::Line { statement, .. } | Outcome::AtLeast { statement, .. } => Some(*statement),
        Outcome::NoGerm { .. } | Outcome::Open { .. } => None,
    }
}

/// `name = value` as a formula in a line of its own.
fn equation(name: &str, value: Math) -> Block {
    Block::Formula(Math::parse(&format!("{name}=@"), &mut std::iter::once(value)))
}
