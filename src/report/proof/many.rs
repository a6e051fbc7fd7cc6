//! Cycles at which the tangent subspace has more dimensions than a line.

use super::super::document::{Block, Line, Tone, line, words};
use super::super::math::Math;
use super::super::words::witness;
use super::Quoted;
use super::evidence::Evidence;
use super::functionals::{
    cell_table, chain_of, eigen, eigenvector_blocks, functional_block, functional_list, names, on_cells, one_of,
};
use super::statements::nilpotent_check;
use crate::case::Case;
use crate::jordan::Spectral;
use crate::report::figures;
use crate::report::reported::Reported;
use crate::shape::CellKind;
use crate::statement::Statement;
use crate::theorem::{BranchReport, Outcome, RingProof, Witness};

/// The statement that is applied: a zero that is only known to exist has a corollary of its own.
fn applied<E: Reported>(statement: Statement, found: Option<&Witness<E>>) -> Statement {
    match (statement, found) {
        (Statement::Theorem4, Some(Witness::SignChange { .. })) => Statement::NullExists,
        _ => statement,
    }
}

pub(super) fn blocks<E: Reported>(case: &Case<E>, branch: &BranchReport<E>, seen: &mut Quoted) -> Vec<Block> {
    let Outcome::AtLeast { dimension, statement, eigenvalues, isolation, witness: found } = &branch.outcome else {
        return Vec::new();
    };
    let Some(&(f, r)) = eigenvalues.first() else { return Vec::new() };
    let (factor, _, place) = eigen(&branch.spectrum, (f, r));
    let block = factor.blocks[0];
    let statement = applied(*statement, found.as_ref());
    let mut blocks = vec![seen.once(statement)];
    blocks.push(evidence(branch, statement, block, isolation.as_ref(), found.as_ref()).block());
    let mut top =
        line("The longest Jordan blocks of the largest modulus have the size $@$ and belong to ", [Math::count(block)]);
    top.extend(names(&branch.spectrum, eigenvalues));
    if statement == Statement::Corollary {
        top.extend(line(&format!(": {}", pattern(branch, eigenvalues)), []));
    }
    top.extend(words("."));
    blocks.push(Block::Paragraph(top));
    blocks.extend(eigenvector_blocks::<E>(&branch.spectrum, eigenvalues, block));
    if let (Some(_), Some(chain)) = (found, chain_of(factor.left, block)) {
        let functional = &chain.vectors[0];
        blocks.push(functional_block(
            "The functional that reads the leading coefficient is",
            functional,
            branch,
            (f, r),
        ));
        if case.shape.states[branch.state].kind == CellKind::Edge {
            blocks.push(figures::functional(case, branch, functional, place, None));
        }
    }
    if let Some(proof) = isolation.as_ref().filter(|_| statement != Statement::Section6) {
        blocks.push(Block::text("The functionals that show that the branch is isolated:", []));
        blocks.push(functional_list("k", &proof.functionals, &branch.chart));
        blocks.push(cell_table(proof, "k"));
    }
    if let Some(Witness::Crossing { cover, .. }) = found {
        blocks.push(Block::text(
            "$c_2$ reads the coefficient of the second vector of the chain and $c_1$ that of the first one where $c_2=0$, up to one positive \
             factor; below they are $h_1$ and $h_2$.",
            [],
        ));
        blocks.push(functional_list("h", &cover.functionals, &branch.chart));
        blocks.push(cell_table(cover, "h"));
    }
    blocks.push(Block::Paragraph(why(branch, *dimension, statement)));
    blocks
}

/// What was verified, hypothesis by hypothesis.
fn evidence<E: Reported>(
    branch: &BranchReport<E>,
    statement: Statement,
    block: usize,
    isolation: Option<&RingProof>,
    found: Option<&Witness<E>>,
) -> Evidence {
    let isolated = |evidence: Evidence| match isolation {
        Some(proof) => evidence.holds(
            "isolated",
            &format!(
                "{} {}, whose common zeros are the generalised kernel of $L$, has a constant sign.",
                on_cells(proof.discharged.len()),
                one_of('k', proof)
            ),
            [],
        ),
        None => evidence,
    };
    let shown = |mut evidence: Evidence, name: &'static str| {
        if let Some(found) = found {
            let mut text = witness(found);
            text.extend(words("."));
            evidence.push(name, Tone::Good, text);
        }
        evidence
    };
    match statement {
        Statement::Corollary => nilpotent_check(statement, branch),
        Statement::Theorem4 => shown(isolated(Evidence::of(statement)), "null"),
        Statement::NullExists => {
            let evidence = isolated(Evidence::of(statement));
            let semisimple = "the blocks of the largest modulus have the size $@$.";
            shown(
                if block == 1 { evidence.holds("semisimple", semisimple, [Math::count(block)]) } else { evidence },
                "zero",
            )
        }
        Statement::Section6 => section_6(branch, found),
        Statement::Theorem4Sign => shown(theorem_4_sign(branch, block, isolation), "signs"),
        other => Evidence::of(other),
    }
}

/// The hypotheses of Theorem 4′, but for the change of sign.
fn theorem_4_sign<E: Reported>(branch: &BranchReport<E>, block: usize, isolation: Option<&RingProof>) -> Evidence {
    let mut evidence = Evidence::of(Statement::Theorem4Sign).holds(
        "leading",
        "the largest modulus has exactly one longest Jordan block, of one real eigenvalue, of size $ℓ+1=@$.",
        [Math::count(block)],
    );
    if let Some(proof) = isolation {
        let text = format!(
            "{} {}, whose common zeros are those of $π_i$, has a constant sign.",
            on_cells(proof.discharged.len()),
            one_of('k', proof)
        );
        evidence = evidence.holds("ring", &text, []);
    }
    evidence.holds(
        "view",
        "$G$, given with the point, has the rank $@$ on the space of dimension $@$ where $L$ acts, and loses nothing of these eigenspaces.",
        [Math::count(branch.view.rank()), Math::count(branch.view.cols())],
    )
}

/// The hypotheses of the criterion of §6.
fn section_6<E: Reported>(branch: &BranchReport<E>, found: Option<&Witness<E>>) -> Evidence {
    let evidence = Evidence::of(Statement::Section6);
    let Some(Witness::Crossing { sign, positive, negative, cover, .. }) = found else { return evidence };
    let members = branch.spectrum.classes().first().map_or(0, |c| c.members.len());
    let positive_or = if *sign > 0 { "positive" } else { "negative" };
    evidence
        .holds("block", "the largest modulus has @ eigenvalue, real, with one Jordan block of length 2.", [Math::count(members)])
        .holds(
            "crossing",
            &format!("$c_2$ is positive at the point with address `{positive}` and negative at `{negative}` of a connected part of the ring."),
            [],
        )
        .holds(
            "sign",
            &format!("@ cells cover that part, and on each of them $c_2$ has a strict sign or $c_1$ is {positive_or}."),
            [Math::count(cover.discharged.len())],
        )
}

/// What the largest modulus looks like, in the words of the thesis's cases.
fn pattern<E: Reported>(branch: &BranchReport<E>, eigenvalues: &[(usize, usize)]) -> &'static str {
    let roots: Vec<_> = eigenvalues.iter().map(|&e| eigen(&branch.spectrum, e).1).collect();
    let real = roots.iter().filter(|r| r.is_real()).count();
    let same = eigenvalues.windows(2).all(|w| w[0] == w[1]);
    match (real, roots.len()) {
        (0, _) => "a complex pair, so that the leading part turns with every turn of the cycle",
        (n, m) if n < m => "real and complex eigenvalues of equal modulus",
        (_, _) if same => "one real eigenvalue with several longest blocks",
        _ => "real eigenvalues of equal modulus, $λ$ and $-λ$",
    }
}

/// The conclusion of a refutation: what is known on the branch, and why it is not lost on the way to the point.
fn why<E: Reported>(branch: &BranchReport<E>, dimension: usize, statement: Statement) -> Line {
    let (rank, of) = (branch.view.rank(), branch.view.cols());
    let values = [Math::count(dimension), Math::count(rank)];
    let text = match (statement, rank == of) {
        (Statement::Theorem4Sign, false) => {
            "**Conclusion.** There is no tangent line on this branch: its tangent subspace at the point has at least $@$ dimensions. (The rank of \
             $G$ is $@$.)"
        }
        (_, true) => {
            "**Conclusion.** There is no tangent line on this branch: $\\dim D^*≥@$, and the way $G$ to the point, given with the point, has the \
             rank $@$ on the space where $L$ acts, that is, it is injective."
        }
        (Statement::Corollary, false) => {
            "**Conclusion.** There is no tangent line on this branch: the images of these eigenvectors under the way $G$ to the point, given with \
             the point, span at least $@$ dimensions."
        }
        (_, false) => {
            "**Conclusion.** There is no tangent line on this branch: $\\dim D^*≥@$, and the way $G$ to the point, given with the point, takes an \
             eigenvector at the end of a longest chain of the hull of $x$ to another line than $v$."
        }
    };
    line(text, values)
}
