//! The statement that applies to a cycle: its hypotheses one by one, the functional, the rays, and what follows.

use super::super::document::{Block, Line, Tone, line, words};
use super::super::math::Math;
use super::super::values::{lambda_math, polynomial, root_math};
use super::super::words::{cell, holder, listed, rate, root_of};
use super::evidence::Evidence;
use super::functionals::{cell_table, chain_of, eigen, elems, functional_block, on_cells};
use super::{Quoted, many};
use crate::algebraic::{Elem, Root};
use crate::case::Case;
use crate::jordan::{Part as Factor, Spectral};
use crate::report::figures;
use crate::report::reasons;
use crate::report::reported::Reported;
use crate::shape::CellKind;
use crate::statement::Statement;
use crate::theorem::{BranchReport, Outcome, Position, Rate, RingProof};

/// The part of a cycle's section that applies a statement.
pub(super) fn blocks<E: Reported>(case: &Case<E>, branch: &BranchReport<E>, seen: &mut Quoted) -> Vec<Block> {
    match &branch.outcome {
        Outcome::Line { statement, .. } => {
            let mut blocks = vec![seen.once(*statement)];
            blocks.extend(line_blocks(case, branch, *statement, seen));
            blocks
        }
        Outcome::AtLeast { .. } => many::blocks(case, branch, seen),
        Outcome::NoGerm { reason } => {
            let why = if branch.linear.rows() > 0 {
                " $L$ is nilpotent, so that near $q$ the shape consists of the finitely many sets $M^m K$ that contain $q$, and by enclosures \
                 none does."
            } else {
                ""
            };
            let reason = reasons::no_germ(*reason);
            vec![Block::text(&format!("There is no germ here: {reason}.{why}"), [])]
        }
        Outcome::Open { reason, place, at_least, .. } => {
            let mut blocks = Vec::new();
            let place =
                place.as_ref().map_or_else(String::new, |p| format!(" The cell in which it failed is {}.", cell(p)));
            let mut text = format!("**Not decided**: {}.{place}", reasons::branch(*reason));
            if *at_least > 0 {
                blocks.push(seen.once(Statement::Corollary));
                blocks.push(nilpotent_check(Statement::Corollary, branch).block());
                text.push_str(
                    " What is proved is $\\dim D^*≥@$, by the corollary: the way to the point does not kill $U$. Nothing more is claimed.",
                );
            } else {
                text.push_str(" Nothing is claimed about the tangent subspace here.");
            }
            blocks.push(Block::text(&text, [Math::count(*at_least)]));
            blocks
        }
    }
}

/// The finding that `L` is not nilpotent: an eigenvalue of the largest modulus.
pub(super) fn nilpotent_check<E: Reported>(statement: Statement, branch: &BranchReport<E>) -> Evidence {
    let evidence = Evidence::of(statement);
    match branch.spectrum.classes().first().map(|c| branch.spectrum.value(c.members[0])).filter(|r| !r.is_zero()) {
        Some(root) => {
            evidence.holds("not-nilpotent", "$@$ is an eigenvalue of $L$, and it is not 0.", [lambda_math(root)])
        }
        None => evidence,
    }
}

/// What was verified of the hypotheses of a statement that gives a line.
fn line_evidence<E: Reported>(
    branch: &BranchReport<E>,
    statement: Statement,
    root: &Root,
    block: usize,
    proof: Option<&RingProof>,
) -> Evidence {
    let next = branch.spectrum.classes().get(1).map(|c| branch.spectrum.value(c.members[0]));
    let rest = if next.is_some() { " The next modulus is that of $@$, which is smaller." } else { "" };
    let ring = |evidence: Evidence| match proof {
        Some(proof) => evidence.holds(
            "ring",
            &format!(
                "the functional $g$ below has no zero on $K$: {} $g$ has a constant sign. (So the branch is isolated.)",
                on_cells(proof.discharged.len())
            ),
            [],
        ),
        None => evidence,
    };
    match statement {
        Statement::CorollaryLine => Evidence::of(statement)
            .holds("line", "the space on which $L$ acts has the dimension 1.", [])
            .holds("nonzero", "$L≠0$: its eigenvalue is given by $@$.", [lambda_math(root)]),
        Statement::Theorem2 => {
            let values = [Some(root_math(root)), next.map(root_math)].into_iter().flatten();
            let text = format!("$@$ is real, simple, and alone in the largest modulus, so that $E_1$ is a line.{rest}");
            ring(nilpotent_check(statement, branch).holds("semisimple", &text, values))
        }
        Statement::Theorem3 => {
            let values = [Some(root_math(root)), Some(Math::count(block)), next.map(root_math)].into_iter().flatten();
            let text = format!(
                "$@$ is real, and the largest modulus has exactly one longest Jordan block, of size $ℓ+1=@$, so that $U$ is a line.{rest}"
            );
            ring(nilpotent_check(statement, branch).holds("blocks", &text, values))
        }
        other => Evidence::of(other),
    }
}

fn line_blocks<E: Reported>(
    case: &Case<E>,
    branch: &BranchReport<E>,
    statement: Statement,
    seen: &mut Quoted,
) -> Vec<Block> {
    let Outcome::Line { eigenvalue, block, functional, proof, .. } = &branch.outcome else {
        return Vec::new();
    };
    let (factor, root, place) = eigen(&branch.spectrum, *eigenvalue);
    let mut blocks = vec![line_evidence(branch, statement, root, *block, proof.as_ref()).block()];
    if root.rational().is_none() {
        let mut text = line("Here $@$ is a root of $@$.", [lambda_math(root), polynomial(root.minpoly(), 'x')]);
        let chains = chain_of(factor.right, *block).into_iter().flat_map(|c| c.vectors.iter().flatten());
        text.extend(E::letters(factor, place, &chains.chain(functional).collect::<Vec<_>>()));
        blocks.push(Block::Paragraph(text));
    }
    blocks.extend(vector_blocks(branch, *eigenvalue, *block, functional));
    let on = if branch.linear.rows() < branch.relevant { " of the image germ in $Y$" } else { "" };
    let conclusion = format!("**Conclusion.** The tangent subspace $D^*${on} is the line of $v$.");
    if let Some(proof) = proof {
        blocks.push(figures::functional(case, branch, functional, place, Some(proof)));
        blocks.push(cell_table(proof, "g"));
        blocks.push(Block::text(&conclusion, []));
        blocks.extend(ray_blocks(case, branch, *eigenvalue, (*block, functional), proof, seen));
        blocks.extend(rate_blocks(case, branch, *block, seen));
    } else {
        blocks
            .push(Block::text(&format!("{conclusion} The ring condition was not used; the rays are not settled."), []));
    }
    blocks
}

/// How fast the secants turn, and the exponent of a curve.
fn rate_blocks<E: Reported>(case: &Case<E>, branch: &BranchReport<E>, block: usize, seen: &mut Quoted) -> Vec<Block> {
    let Outcome::Line { rate: speed, holder: exponent, .. } = &branch.outcome else { return Vec::new() };
    let mut blocks = Vec::new();
    let mut text = words("The angular deviation of the secants is ");
    text.extend(rate(speed));
    text.extend(words("."));
    let depth = "by the ring condition above, with $i=1$.";
    match speed {
        Rate::Exact => {}
        Rate::Geometric { power, .. } => {
            blocks.extend(seen.once_id(Statement::Rates));
            let sizes = "in the largest modulus $j+1=1$, in the next one $k+1=@$.";
            let evidence = Evidence::of(Statement::Rates).holds("depth", depth, []);
            blocks.push(evidence.holds("blocks", sizes, [Math::count(power + 1)]).block());
        }
        Rate::Harmonic => {
            blocks.extend(seen.once_id(Statement::Rates));
            let sizes = "in the largest modulus $j+1=@$; Theorem 3 is applied with $ℓ=@$.";
            let values = [Math::count(block), Math::count(block - 1)];
            let evidence = Evidence::of(Statement::Rates).holds("depth", depth, []);
            blocks.push(evidence.holds("blocks", sizes, values).block());
        }
    }
    blocks.push(Block::Paragraph(text));
    if case.shape.states[branch.state].kind == CellKind::Edge {
        blocks.extend(seen.once_id(Statement::Holder));
        let scale = Math::number(&exponent.scale);
        let evidence = Evidence::of(Statement::Holder)
            .holds("curve", "one turn of the cycle shrinks the parameter by $s=@$.", [scale])
            .holds("ring", "it is the ring condition above.", []);
        blocks.push(evidence.block());
        let mut text = words("The local Hölder exponent is ");
        text.extend(holder(exponent));
        text.extend(root_of(&exponent.eigenvalue));
        text.extend(words("."));
        blocks.push(Block::Paragraph(text));
    }
    blocks
}

/// `g` on the last vector of the chain of the eigenvector.
fn pairing(factor: &Factor<'_>, block: usize, functional: &[Elem]) -> Option<Elem> {
    let last = chain_of(factor.right, block)?.vectors.get(block.checked_sub(1)?)?;
    Some(functional.iter().zip(last).fold(Elem::zero(), |s, (a, b)| s.add(&a.mul(b, factor.over.modulus))))
}

/// The eigenvector, its chain, and the functional that reads the leading coefficient.
fn vector_blocks<E: Reported>(
    branch: &BranchReport<E>,
    eigenvalue: (usize, usize),
    block: usize,
    functional: &[Elem],
) -> Vec<Block> {
    let mut blocks = Vec::new();
    let (factor, _, place) = eigen(&branch.spectrum, eigenvalue);
    let Some((chain, value)) = chain_of(factor.right, block).zip(pairing(&factor, block, functional)) else {
        return blocks;
    };
    blocks.push(Block::text(
        "The right eigenvector, in the coordinates of $L$, is $v=@$.",
        [elems::<E>(&chain.vectors[0], place)],
    ));
    if block > 1 {
        blocks.push(Block::Paragraph(chain_line::<E>(&chain.vectors, place)));
    }
    blocks.push(functional_block("The left functional is", functional, branch, eigenvalue));
    blocks.push(if block == 1 {
        Block::text("Since $g(v)=@$, the component of $x$ along $v$ is $c(x)=g(x)/g(v)$.", [E::element(&value, place)])
    } else {
        let values = [Math::count(block), E::element(&value, place), Math::count(block - 1)];
        Block::text(
            "On the last vector $w_@$ of the chain $g$ has the value $g_0=@$, so that the leading coefficient is $u(x)=c(x) v$ with \
             $c(x)=λ^{-@} g(x)/g_0$.",
            values,
        )
    });
    blocks
}

/// The generalised eigenvectors `w_2, w_3, …` above the eigenvector `v` of a chain.
fn chain_line<E: Reported>(chain: &[Vec<Elem>], place: &Root) -> Line {
    let mut out = line("It ends a Jordan chain of length $@$: $(L-λ)w_2=v$", [Math::count(chain.len())]);
    for k in 3..=chain.len() {
        out.extend(line("$, (L-λ)w_@=w_@$", [Math::count(k), Math::count(k - 1)]));
    }
    out.extend(words(" with "));
    for (k, vector) in chain.iter().enumerate().skip(1) {
        let comma = if k > 1 { "$, w_@=@$" } else { "$w_@=@$" };
        out.extend(line(comma, [Math::count(k + 1), elems::<E>(vector, place)]));
    }
    out.extend(words("."));
    out
}

/// The data of the rule for rays: the sign of `λ`, the orientation, and the signs of `c` on the parts of the ring.
fn ray_blocks<E: Reported>(
    case: &Case<E>,
    branch: &BranchReport<E>,
    eigenvalue: (usize, usize),
    (block, functional): (usize, &[Elem]),
    proof: &RingProof,
    seen: &mut Quoted,
) -> Vec<Block> {
    let curve = case.shape.states[branch.state].kind == CellKind::Edge;
    let mut blocks: Vec<Block> = seen.once_id(Statement::Rays).into_iter().collect();
    let mut evidence = Evidence::of(Statement::Rays).holds("line", "as concluded above.", []);
    // c is g divided by its value on the last vector of the chain and by λ^ℓ.
    let (factor, root, place) = eigen(&branch.spectrum, eigenvalue);
    let Some(value) = pairing(&factor, block, functional) else { return blocks };
    let turns = if block % 2 == 0 { root.sign() } else { 1 };
    let flip = value.sign(place) * turns;
    let on = |wanted: Position| -> Option<&'static str> {
        let mut signs = proof.discharged.iter().filter(|d| d.position == wanted).map(|d| d.sign);
        let first = signs.next()?;
        Some(match (signs.all(|s| s == first), first * flip > 0) {
            (false, _) => "takes both signs",
            (true, true) => "is positive",
            (true, false) => "is negative",
        })
    };
    let mut facts = vec![format!("$λ{}0$", if root.sign() > 0 { ">" } else { "<" })];
    let same = if flip > 0 { "the sign of $g$" } else { "the opposite sign of $g$" };
    facts.push(format!("$c$ has {same}"));
    if curve {
        facts.push(format!("$ε={}1$", if branch.cycle_sign > 0 { "" } else { "-" }));
        facts.extend(on(Position::Before).map(|s| format!("$c$ {s} on the cells before $q$")));
        facts.extend(on(Position::After).map(|s| format!("$c$ {s} on the cells after $q$")));
    } else {
        facts.extend(on(Position::Unordered).map(|s| format!("$c$ {s} on the ring")));
    }
    evidence.push("signs", Tone::Good, line(&format!("{}.", listed(&facts)), []));
    blocks.push(evidence.block());
    blocks.push(Block::text("The rays that follow are listed with the points.", []));
    blocks
}
