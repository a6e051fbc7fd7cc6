//! One section for each different cycle of a surface: its spectrum, its ring, and what follows for the tangent subspace.

use super::super::document::{Block, Check, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::surface::witness;
use super::super::words::{cell, dimension, listed};
use super::cycles::{cycle_operator, spectrum_blocks};
use super::statements::{cell_table_of, eigenvector_blocks, functional_list, names, on_cells, one_of};
use super::{Quoted, matrix};
use crate::case::Case;
use crate::jordan::Spectrum;
use crate::report::figures;
use crate::shape::word_text;
use crate::theorem::Statement;
use crate::theorem::surface::{SurfaceBranch, SurfaceOutcome, SurfaceWitness, Winding, leading_functionals};

pub(super) fn section(case: &Case, branch: &SurfaceBranch, k: usize, quotes: &mut Quoted) -> Vec<Block> {
    let shape = &case.shape;
    let of =
        if shape.states.len() > 1 { format!(" at state {}", shape.states[branch.state].name) } else { String::new() };
    let title = format!("Cycle {}: ({}){of}", k + 1, word_text(&branch.address.cycle));
    let mut blocks = vec![Block::Heading(3, words(title))];
    let seen = branch.linear.rows();
    let dimension = match (seen == branch.relevant, seen) {
        (true, _) => "$V$ has the dimension $@$.",
        (false, 0) => "$V$ has the dimension $@$, of which nothing is seen: the cell is a single point.",
        (false, _) => "$V$ has the dimension $@$, of which $@$ are seen; $L$ is $M$ on the quotient that is seen.",
    };
    let operator = cycle_operator(case, branch.state, &branch.address.cycle, &branch.cycle_operator);
    let fixed = Block::text(
        &format!("The fixed point is $q=@$. {dimension}"),
        [Math::vector(&branch.fixed), Math::count(branch.relevant), Math::count(seen)],
    );
    blocks.extend(operator);
    blocks.push(fixed);
    if seen == 0 {
        return blocks;
    }
    blocks.push(Block::Details {
        summary: line("Coordinates of a point $x$ of the attractor are $C(x-q)$, and $M$ acts on them by $L$:", []),
        blocks: vec![matrix(Math::Letter('C'), &branch.chart), matrix(Math::Letter('L'), &branch.linear)],
    });
    blocks.extend(spectrum_blocks(&branch.spectrum));
    if seen > 1 {
        blocks.push(figures::spectrum(&branch.spectrum));
    }
    blocks.extend(ring(branch, quotes));
    blocks.extend(cited(&branch.outcome, seen).into_iter().map(|t| quotes.once(t)));
    blocks.push(Block::Checks(checks(branch)));
    if let Some((block, eigenvalues)) = longest(&branch.spectrum) {
        blocks.extend(eigenvector_blocks(&branch.spectrum, &eigenvalues, block));
    }
    blocks.extend(evidence(branch));
    blocks.push(Block::Paragraph(conclusion(&branch.outcome)));
    blocks
}

/// What is known of the dimension of the tangent subspace of the branch, and what is not decided.
fn conclusion(o: &SurfaceOutcome) -> Line {
    let mut out = line("**Conclusion.** On this branch ", []);
    out.extend(dimension(o.dimension));
    if let Some(most) = o.at_most.filter(|most| !o.dimension.exact && *most > o.dimension.at_least) {
        out.extend(line(" and $\\dim D^*≤@$", [Math::count(most)]));
    }
    if let Some((reason, place)) = &o.open {
        out.extend(words(format!("; not decided: {reason}")));
        if let Some(place) = place {
            out.extend(line(&format!(" (cell {})", cell(place)), []));
        }
    }
    out.extend(words("."));
    out
}

fn ring(branch: &SurfaceBranch, quotes: &mut Quoted) -> Vec<Block> {
    let pieces = |collapsed: bool| -> Vec<String> {
        let kept = branch.ring.iter().filter(|p| p.collapses == collapsed);
        kept.map(|p| format!("`{}`", word_text(&p.word))).collect()
    };
    let (kept, dropped) = (pieces(false), pieces(true));
    let mut blocks = Vec::new();
    blocks.push(match kept.len() {
        0 => Block::text("No cell is left in the ring $K$.", []),
        1 => Block::text(&format!("The ring $K$ consists of the cell {}.", listed(&kept)), []),
        _ => Block::text(&format!("The ring $K$ consists of the cells {}.", listed(&kept)), []),
    });
    if !dropped.is_empty() {
        blocks.extend(quotes.once_id(Statement::Lemma2));
        let text =
            format!("By Lemma 2 these cells, which fall into $q$ as a whole, are left out: {}.", listed(&dropped));
        blocks.push(Block::text(&text, []));
    }
    blocks
}

/// The statements that are applied to a branch.
fn cited(o: &SurfaceOutcome, seen: usize) -> Vec<Statement> {
    let mut cited = Vec::new();
    match o.statement {
        // The image of U is all that is seen.
        Some(Statement::Corollary) if o.dimension.exact && o.dimension.at_least == seen => {
            cited.push(Statement::CorollaryImage);
        }
        Some(Statement::Section6) => cited.push(Statement::Section6Surface),
        Some(s) => cited.push(s),
        None => {}
    }
    if o.depth.is_some() {
        cited.push(Statement::Theorem1);
        if o.dimension.exact {
            cited.push(Statement::BothBounds);
        }
    }
    cited
}

/// The length of the longest Jordan blocks of the largest modulus, and their eigenvalues, once for each block; `None` where
/// there is no eigenvalue but 0.
fn longest(spectrum: &Spectrum) -> Option<(usize, Vec<(usize, usize)>)> {
    let class = spectrum.classes.first()?;
    if spectrum.root(*class.members.first()?).is_zero() {
        return None;
    }
    let sizes = |factor: usize| &spectrum.factors[factor].blocks;
    let block = class.members.iter().filter_map(|m| sizes(m.factor).first().copied()).max()?;
    let times = |factor: usize| sizes(factor).iter().filter(|b| **b == block).count();
    let eigenvalues =
        class.members.iter().flat_map(|m| std::iter::repeat_n((m.factor, m.root), times(m.factor))).collect();
    Some((block, eigenvalues))
}

fn good(text: Line) -> Check {
    Check { tone: Tone::Good, text }
}

fn checks(branch: &SurfaceBranch) -> Vec<Check> {
    let o = &branch.outcome;
    let mut checks = Vec::new();
    match longest(&branch.spectrum) {
        None => checks.push(Check { tone: Tone::Neutral, text: line("$L$ is nilpotent.", []) }),
        Some((block, eigenvalues)) => {
            checks.push(good(line("$L$ is not nilpotent.", [])));
            let mut top = line(
                "The longest Jordan blocks of the largest modulus have the size $@$ and belong to ",
                [Math::count(block)],
            );
            top.extend(names(&branch.spectrum, &eigenvalues));
            top.extend(words(format!(": {}.", o.row)));
            checks.push(good(top));
        }
    }
    if let Some(proof) = &o.ring {
        let cells = on_cells(proof.discharged.len());
        let text = if proof.functionals.len() == 1 {
            format!(
                "Ring condition: the leading functional $g$ below has no zero on $K$: {cells} it has a constant sign."
            )
        } else {
            format!(
                "Ring condition: the leading functionals $g_i$ below have no common zero on $K$: {cells} one of them has a constant sign."
            )
        };
        checks.push(good(line(&format!("{text} This also proves that the branch is isolated."), [])));
    }
    if let Some(proof) = &o.isolation {
        let text = format!(
            "The branch is isolated: {} {}, whose common zeros are the generalised kernel of $L$, has a constant sign.",
            on_cells(proof.discharged.len()),
            one_of('k', proof)
        );
        checks.push(good(line(&text, [])));
    }
    if let Some(w) = &o.witness {
        let mut text = words("Witness: ");
        text.extend(witness(w));
        text.extend(words(". So the ring condition fails."));
        checks.push(good(text));
    }
    if let Some((depth, proof)) = &o.depth {
        let text = format!(
            "$0∉π_@(X)$: {} {}, whose common zeros are those of $π_@$, has a constant sign. So $D^*⊂@$.",
            on_cells(proof.discharged.len()),
            one_of('h', proof)
        );
        checks.push(good(line(&text, [Math::count(*depth), Math::count(*depth), sum_of_spaces(*depth)])));
    }
    checks
}

/// `E_1⊕E_2⊕…` up to a number.
fn sum_of_spaces(depth: usize) -> Math {
    let notation: Vec<&str> = std::iter::repeat_n("E_@", depth).collect();
    Math::parse(&notation.join("⊕"), &mut (1..=depth).map(Math::count))
}

/// The functionals with their values on the cells, and the path of a winding.
fn evidence(branch: &SurfaceBranch) -> Vec<Block> {
    let o = &branch.outcome;
    let mut blocks = Vec::new();
    if let Some(proof) = &o.ring {
        blocks.push(Block::text("The functionals that read the leading coefficient:", []));
        blocks.push(functional_list("g", &proof.functionals, &branch.chart));
        blocks.push(cell_table_of(proof, "g"));
    } else if o.witness.is_some() {
        blocks.push(Block::text("The functionals that read the leading coefficient:", []));
        blocks.push(functional_list("g", &leading_functionals(&branch.spectrum), &branch.chart));
    }
    if let Some(SurfaceWitness::Winding(winding)) = &o.witness {
        blocks.push(path(winding));
    }
    let others = [("isolation", "k", o.isolation.as_ref()), ("upper bound", "h", o.depth.as_ref().map(|d| &d.1))];
    for (what, letter, proof) in others {
        let Some(proof) = proof else { continue };
        blocks.push(Block::text(&format!("The functionals of the {what}:"), []));
        blocks.push(functional_list(letter, &proof.functionals, &branch.chart));
        blocks.push(cell_table_of(proof, letter));
    }
    blocks
}

/// The cells along the boundary of a cell whose image winds around 0.
fn path(winding: &Winding) -> Block {
    let rows = winding.path.iter().map(|d| {
        let half = if d.sign > 0 { "positive" } else { "negative" };
        let name = formula(Math::parse("g_@", &mut std::iter::once(Math::count(d.functional + 1))));
        vec![code(word_text(&d.word)), name, words(half)]
    });
    let header = vec![words("cell"), words("functional"), words("sign")];
    let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() });
    Block::Details { summary: words("The cells along the boundary, in cyclic order:"), blocks: vec![table] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::math_line;

    #[test]
    fn sums_of_spaces_are_written_out() {
        assert_eq!(math_line(&sum_of_spaces(1)), "E₁");
        assert_eq!(math_line(&sum_of_spaces(3)), "E₁ ⊕ E₂ ⊕ E₃");
    }
}
