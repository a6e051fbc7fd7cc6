//! The proof-style report: every statement applied, with every number that it needs, in an order in which it can be
//! checked by hand.

mod components;
mod cones;
mod contracts;
mod cycles;
mod dense;
mod every;
mod every_plane;
mod evidence;
mod frames;
mod functionals;
mod given;
mod many;
mod orders;
mod points;
mod product;
mod results;
mod scheme;
mod statements;
mod surface;
mod surface_cycle;
mod vertex;

pub(super) use every::{of_curve as every_section, over_field as cones_section};
pub use results::parameter;
pub(super) use results::table as results_table;
pub use vertex::vertex_document;

use super::document::{Block, Document, Inline, Line, line, words};
use super::figures;
use super::math::Math;
use super::reported::{Reported, entries};
use super::summary::{claim_line, mask_line, overall_line, shape_line};
use super::text::plain;
use crate::case::Case;
use crate::linalg::Matrix;
use crate::shape::{CellKind, Spaces};
use crate::statement::Statement;
use crate::theorem::surface::Surface;
use crate::theorem::{BranchReport, Certified, Required, Verdict};

/// Matrices with more rows or columns than this are folded.
const LARGE: usize = 8;

/// How much of a proof a report has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Level {
    /// The first page: statement, results, picture, verdict, digests.
    Summary,
    /// The whole proof; long tables can be folded.
    #[default]
    Proof,
    /// The same with everything unfolded.
    Full,
}

/// The whole proof as a document.
#[must_use]
pub fn document<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Document {
    document_at(case, found, Level::Proof)
}

/// Blocks with all that may be skipped laid open.
fn unfolded(blocks: Vec<Block>) -> Vec<Block> {
    let open = |block| match block {
        Block::Details { summary, blocks } => {
            let mut out = vec![Block::Paragraph(summary)];
            out.extend(unfolded(blocks));
            out
        }
        other => vec![other],
    };
    blocks.into_iter().flat_map(open).collect()
}

/// The proof, or its first page, as a document.
#[must_use]
pub fn document_at<E: Reported>(case: &Case<E>, found: &Certified<E>, level: Level) -> Document {
    let mut blocks = opening(case, found);
    blocks.extend(certificate_section(case, found));
    if level == Level::Summary {
        return Document { title: case.title.clone(), blocks };
    }
    let first_page = blocks.len();
    let mut seen = Quoted::default();
    let start = case.shape.states[case.shape.start].kind;
    blocks.extend(scheme::section(case, found, &mut seen));
    let cycles = cycles::distinct(found);
    if let Some(spaces) = Spaces::new(&case.shape).filter(|_| !found.points.is_empty()) {
        blocks.extend(definitions(start, true));
        blocks.push(Block::heading(2, "The cycles"));
        for (k, branch) in cycles.iter().enumerate() {
            blocks.extend(cycles::section(case, &spaces, branch, k, &mut seen));
        }
        blocks.extend(points::section(case, found, &cycles, &mut seen));
    }
    if let Some(surface) = &found.surface {
        blocks.extend(definitions(start, surface.unparametrised.is_none()));
        blocks.extend(E::surface_section(case, surface, true, &mut seen));
    }
    blocks.extend(dense::section(case, found, &mut seen));
    blocks.extend(E::every_section(case, found, &mut seen));
    blocks.extend(orders::section(case, found, &mut seen));
    blocks.extend(references(&seen));
    let blocks = if level == Level::Full { unfolded(blocks) } else { blocks };
    let mut document = Document { title: case.title.clone(), blocks };
    document.insert_contents(first_page);
    document
}

/// What the proof says of one examined point, by its number: its cycles, and what follows at the point; `None` where there is no
/// such point.
#[must_use]
pub fn point_document<E: Reported>(case: &Case<E>, found: &Certified<E>, number: usize) -> Option<Document> {
    let mut seen = Quoted::default();
    let start = case.shape.states[case.shape.start].kind;
    let (title, mut blocks, parametrised) = match &found.surface {
        Some(surface) => {
            let point = surface.points.get(number)?;
            let one = Surface { points: vec![point.clone()], ..surface.clone() };
            let title = plain(&super::surface::head(point));
            (title, E::surface_section(case, &one, false, &mut seen), surface.unparametrised.is_none())
        }
        None => {
            let point = found.points.get(number)?;
            let one = Certified { points: vec![point.clone()], ..found.clone() };
            let cycles = cycles::distinct(&one);
            let spaces = Spaces::new(&case.shape)?;
            let mut blocks = vec![Block::heading(2, "The cycles")];
            for (k, branch) in cycles.iter().enumerate() {
                blocks.extend(cycles::section(case, &spaces, branch, k, &mut seen));
            }
            blocks.extend(points::section(case, &one, &cycles, &mut seen));
            (super::words::point_name(&case.shape, point), blocks, true)
        }
    };
    blocks.extend(definitions(start, parametrised));
    Some(Document { title: format!("{}: {title}", case.title), blocks })
}

/// The statements quoted so far, in order: each is quoted in full where it is first used.
#[derive(Default)]
pub struct Quoted(Vec<Statement>);

impl Quoted {
    /// Whether the statement was not quoted before; from now on it was.
    fn is_new(&mut self, statement: Statement) -> bool {
        let new = !self.0.contains(&statement);
        if new {
            self.0.push(statement);
        }
        new
    }

    /// The statement in full, or a reference to where it stands.
    fn once(&mut self, statement: Statement) -> Block {
        if self.is_new(statement) {
            return quoted(statement);
        }
        Block::text(&format!("**{}** (above) applies:", statement.short_name()), [])
    }

    /// The statement in full, or nothing where it was quoted before.
    fn once_id(&mut self, statement: Statement) -> Option<Block> {
        self.is_new(statement).then(|| quoted(statement))
    }
}

/// The sections about the points of a surface, with `whole` also about every point.
pub(super) fn surface_section(case: &Case, surface: &Surface, whole: bool, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = surface::section(case, surface, seen);
    if whole {
        blocks.extend(every_plane::section(case, surface, seen));
    }
    blocks
}

/// The words that the statements use.
fn definitions(start: CellKind, parametrised: bool) -> Vec<Block> {
    let (dimension, branches) = match (start, parametrised) {
        (CellKind::Face, true) => (
            "There is a **tangent plane** if and only if $\\dim D^*=2$.",
            "Every point examined has one **branch** for each cell that contains it: an address $u w^ω$ with a prefix $u$ and a cycle $w$.",
        ),
        (CellKind::Face, false) => (
            "There is a **tangent plane** if and only if $\\dim D^*=2$.",
            "Of every point examined one **branch** is looked at: an address $u w^ω$ with a prefix $u$ and a cycle $w$. Other addresses of the same \
             point are not looked at.",
        ),
        _ => (
            "There is a **tangent line** if and only if $\\dim D^*=1$.",
            "Every point examined has one or two **branches**: addresses $u w^ω$ with a prefix $u$ and a cycle $w$.",
        ),
    };
    let limits = format!(
        "A unit vector $d$ is a **limit direction** at $p$ if $(a_k-p)/|a_k-p|→d$ for points $a_k≠p$ of the shape whose addresses tend to that of $p$; \
         the **tangent subspace** $D^*$ is the span of the limit directions. {dimension}"
    );
    let cycle = format!(
        "{branches} What follows depends on the \
         cycle alone, up to the map $T_u$ of the prefix: $M=T_w$ has the fixed point $q$, $V$ is the span of the differences of the attractor, $L$ is $M$ on $V$, \
         the **ring** $K$ is what leaves the cycle during its first turn, and $X=K-q$. The points of the branch near $q$, other than $q$, are images $M^m x$ of \
         points $x$ of the ring."
    );
    let mut items = vec![
        limits.as_str(),
        cycle.as_str(),
        "$ρ_1>ρ_2>…$ are the different moduli of the eigenvalues of $L$, $E_i$ is the real generalised eigenspace of modulus $ρ_i$, \
         $F_i=E_{i+1}⊕E_{i+2}⊕…$, and $π_i$ is the projection of $V$ to $E_1⊕…⊕E_i$ along $F_i$. The smallest $i$ with $0∉π_i(X)$ is the **depth**. \
         $U$ is the span of the eigenvectors that end the longest Jordan chains of modulus $ρ_1$, of length $ℓ+1$; the **leading coefficient** of $x$ is \
         $u(x)=∑_{|λ|=ρ_1} λ^{-ℓ}(L-λ)^ℓ x_λ$, a vector of $U$.",
        "A branch is **isolated** if no point of $X$ lies in the generalised kernel of $L$. The **hull** of a vector is the smallest $L$-invariant \
         subspace that contains it.",
    ];
    if start != CellKind::Face {
        items.push(
            "The **angular deviation** after $m$ turns is the largest angle between the tangent line and a secant from $p$ to a point of the branch behind \
             $m$ turns of its cycle.",
        );
    }
    if start == CellKind::Edge {
        items.push(
            "**Kinds of points** of a curve with a tangent line: a smooth end (one limit ray); of a set, a half-tangent (the same); inside, regular (one ray on each side, opposite to \
             one another), a cusp (one ray on each side, the same), oscillating (both rays on a side). A corner has one ray on each side, on different lines.",
        );
    }
    vec![Block::heading(2, "Definitions"), Block::List(items.iter().map(|t| line(t, [])).collect())]
}

fn opening<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Statement")];
    let mut shape = line("Let $A$ be the shape of the case ", []);
    shape.push(Inline::Code(case.name.clone()));
    shape.extend(words(": a "));
    shape.extend(shape_line(case, found));
    if let Some(mask) = mask_line(case) {
        shape.extend(words(", made of the "));
        shape.extend(mask);
    }
    if let Some(field) = E::field_text(&case.shape) {
        shape.extend(words(format!("; its entries lie in {field}")));
    }
    shape.extend(words("."));
    blocks.push(Block::Paragraph(shape));
    if let Some(source) = &case.source {
        blocks.push(Block::Paragraph(words(format!("Source of the case: {source}."))));
    }
    blocks.push(Block::List(found.claims.iter().map(|c| claim_line(case, found, c)).collect()));
    let required = Required::default();
    let mut verdict = words("Verdict: ");
    verdict.extend(overall_line(case, found, &required));
    verdict.extend(words(match required.verdict(&found.claims) {
        Verdict::Proved => " Every number below is exact unless it is marked by ≈ or given as a decimal bound rounded outwards.",
        Verdict::Refuted => " The witness is given below. Every number is exact unless it is marked by ≈ or given as a decimal bound rounded outwards.",
        Verdict::Undetermined => " What was established, and where the proof stopped, is given below.",
    }));
    if has_long_numbers(case) {
        verdict.extend(words(
            " Numbers of more than 40 digits are shortened in the middle by …; the case file and the certificate have them in full.",
        ));
    }
    blocks.push(Block::Paragraph(verdict));
    blocks.extend(results::table(case, found));
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

fn has_long_numbers<E: Reported>(case: &Case<E>) -> bool {
    let pieces = case.shape.states.iter().flat_map(|s| &s.pieces);
    pieces.map(|p| &p.op).any(|m| crate::report::math::is_shortened(&entries(m)))
}

/// A statement, quoted.
fn quoted(statement: Statement) -> Block {
    Block::Statement(statement)
}

/// What identifies the case and its certificate.
fn certificate_section<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Vec<Block> {
    let digest = |text: &str| Line::from([Inline::Code(crate::certificate::sha256(text))]);
    let mut facts = vec![("case file, SHA-256".to_owned(), digest(&case.text.text))];
    match E::certificate(case, found) {
        Ok(certificate) => {
            facts.push(("certificate, SHA-256".to_owned(), digest(&certificate.text())));
            facts.push((
                "how to check".to_owned(),
                line(
                    &format!(
                        "`secant certify CASE --certificate FILE` writes the certificate; `secant-check CASE FILE`, which shares no code with \
                         secant, proves {} again from it and the case file.",
                        if found.verdict == Verdict::Undetermined { "what is decided" } else { "the verdict" }
                    ),
                    [],
                ),
            ));
            let once = certificate.left_out().iter().map(|why| words(format!("{why}.")));
            facts.extend(once.map(|why| ("proved once only".to_owned(), why)));
        }
        Err(unsupported) => facts.push(("certificate".to_owned(), words(format!("none: {unsupported}.")))),
    }
    vec![Block::heading(2, "Certificate"), Block::Facts(facts)]
}

/// The thesis, the statements that were quoted, and the program.
fn references(seen: &Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "References")];
    let mut items: Vec<Line> = vec![words(
        "S. Podkorytov, Tangent spaces for self-similar shapes, PhD thesis, Université de Bourgogne, Dijon 2013, tel-01005330; chapter 3 for the \
         models, chapter 4 for the conditions.",
    )];
    if !seen.0.is_empty() {
        let used: Vec<&str> = seen.0.iter().map(|s| s.name()).collect();
        let text = format!("Statements applied: {}. Proofs: docs/theory.md, or `secant explain`.", used.join("; "));
        items.push(line(&text, []));
    }
    let version = env!("CARGO_PKG_VERSION");
    items.push(words(format!("Computed by secant {version} in exact rational and algebraic arithmetic.")));
    blocks.push(Block::List(items));
    blocks
}

/// The statement applied at a branch.
fn applied<E: Reported>(branch: &BranchReport<E>) -> Option<crate::theorem::Statement> {
    use crate::theorem::Outcome;
    match &branch.outcome {
        Outcome::Line { statement, .. } | Outcome::AtLeast { statement, .. } => Some(*statement),
        Outcome::NoGerm { .. } | Outcome::Open { .. } => None,
    }
}

/// `name = matrix` as a formula in a line of its own, folded where it is large.
fn matrix<E: Reported>(name: Math, m: &Matrix<E>) -> Block {
    let block = Block::Formula(Math::parse("@=@", &mut [name.clone(), entries(m)].into_iter()));
    if m.rows().max(m.cols()) <= LARGE {
        return block;
    }
    let summary = line("$@$, a matrix of size $@×@$", [name, Math::count(m.rows()), Math::count(m.cols())]);
    Block::Details { summary, blocks: vec![block] }
}
