//! One section for each different cycle of a surface: its spectrum, its ring, and what follows for the tangent subspace.

use super::super::document::{Block, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::surface::{span, witness};
use super::super::values::lambda_math;
use super::super::words::{cell, dimension, listed};
use super::cycles::{cycle_operator, spectrum_blocks};
use super::evidence::Evidence;
use super::functionals::{cell_table, eigenvector_blocks, elems, functional_list, names, on_cells, one_of};
use super::{Quoted, matrix};
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::case::Case;
use crate::jordan::Spectrum;
use crate::report::figures;
use crate::report::reasons;
use crate::shape::{Address, word_text};
use crate::statement::Statement;
use crate::theorem::surface::{SurfaceBranch, SurfaceOutcome, SurfaceWitness, Winding, leading_functionals};
use crate::theorem::{krylov, restrict};

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
    blocks.extend(spectrum_blocks::<Rational>(&branch.spectrum));
    blocks.extend(figures::spectrum(&branch.spectrum));
    blocks.extend(ring(branch, quotes));
    for (statement, evidence) in applied(branch) {
        blocks.push(quotes.once(statement));
        blocks.push(evidence.block());
    }
    if longest(&branch.spectrum).is_none() {
        blocks.push(Block::text("$L$ is nilpotent.", []));
    }
    blocks.extend(own_coefficients(branch));
    if let Some((block, eigenvalues)) = longest(&branch.spectrum) {
        blocks.extend(eigenvector_blocks::<Rational>(&branch.spectrum, &eigenvalues, block));
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
        out.extend(words(format!("; not decided: {}", reasons::surface_branch(*reason))));
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

/// The statements that are applied to a branch, with what was verified of each.
fn applied(branch: &SurfaceBranch) -> Vec<(Statement, Evidence)> {
    let o = &branch.outcome;
    let mut out = Vec::new();
    if let Some(statement) = main_statement(branch) {
        out.push((statement, main_evidence(branch, statement)));
    }
    if let Some((depth, proof)) = &o.depth {
        let shown = format!(
            "{} {}, whose common zeros are those of $π_@$, has a constant sign.",
            on_cells(proof.discharged.len()),
            one_of('h', proof)
        );
        let space = || sum_of_spaces(*depth);
        let modulus = "$ρ_@>0$, and $0∉π_@(X)$: ";
        let theorem = isolated(branch, Evidence::of(Statement::Theorem1)).holds(
            "modulus",
            &format!("{modulus}{shown} So $D^*⊂@$."),
            [Math::count(*depth), Math::count(*depth), Math::count(*depth), space()],
        );
        out.push((Statement::Theorem1, theorem));
        if o.dimension.exact {
            let mut contained = line("$C$ is the space of ", []);
            contained.extend(span(&o.contains));
            contained.extend(words("."));
            let mut both = isolated(branch, Evidence::of(Statement::BothBounds)).holds(
                "ring",
                "$0∉π_@(X)$, as shown for Theorem 1.",
                [Math::count(*depth)],
            );
            both.push("contained", Tone::Good, contained);
            let both = both.holds("dimension", "$\\dim C=\\dim(@)=@$.", [space(), Math::count(o.dimension.at_least)]);
            out.push((Statement::BothBounds, both));
        }
    }
    out
}

/// The statement that gives the first bound; `None` for nilpotent maps.
fn main_statement(branch: &SurfaceBranch) -> Option<Statement> {
    let o = &branch.outcome;
    let (block, _) = longest(&branch.spectrum)?;
    match (o.statement?, &o.witness) {
        (Statement::Corollary | Statement::CorollaryLine, None) if o.dimension.exact => {
            Some(if branch.linear.rows() == 1 { Statement::CorollaryLine } else { Statement::CorollaryImage })
        }
        (Statement::Section6, Some(SurfaceWitness::Winding(_))) => Some(Statement::Section6TwoBlocks),
        (Statement::Section6, _) => Some(Statement::Section6Surface),
        // A zero that is only known to exist shows something where E_1 is spanned by eigenvectors.
        (Statement::Theorem4, Some(SurfaceWitness::SignChange(_) | SurfaceWitness::Winding(_))) => {
            Some(if block == 1 { Statement::NullExists } else { Statement::Corollary })
        }
        (statement, _) => Some(statement),
    }
}

/// The finding that the branch is isolated, where it was needed.
fn isolated(branch: &SurfaceBranch, evidence: Evidence) -> Evidence {
    match &branch.outcome.isolation {
        Some(proof) => {
            let text = format!(
                "{} {}, whose common zeros are the generalised kernel of $L$, has a constant sign.",
                on_cells(proof.discharged.len()),
                one_of('k', proof)
            );
            evidence.holds("isolated", &text, [])
        }
        None => evidence,
    }
}

fn main_evidence(branch: &SurfaceBranch, statement: Statement) -> Evidence {
    let o = &branch.outcome;
    let Some((block, eigenvalues)) = longest(&branch.spectrum) else { return Evidence::of(statement) };
    let shown = |mut evidence: Evidence, name: &'static str| {
        if let Some(w) = &o.witness {
            let mut text = witness(w);
            text.extend(words("."));
            evidence.push(name, Tone::Good, text);
        }
        evidence
    };
    let top = |text: &str| {
        let mut out = line(text, [Math::count(block)]);
        out.extend(names(&branch.spectrum, &eigenvalues));
        out.extend(words(format!(": {}.", reasons::top_row(o.row))));
        out
    };
    let mut evidence = Evidence::of(statement);
    if statement.text().hypotheses.iter().any(|h| h.name == "not-nilpotent") {
        let root = &branch.spectrum.factors[eigenvalues[0].0].roots[eigenvalues[0].1];
        evidence =
            evidence.holds("not-nilpotent", "$@$ is an eigenvalue of $L$, and it is not 0.", [lambda_math(root)]);
    }
    match statement {
        Statement::CorollaryLine => evidence
            .holds("line", "the space on which $L$ acts has the dimension 1.", [])
            .holds("nonzero", "$L≠0$.", []),
        Statement::CorollaryImage => evidence.holds("dimension", "both are @.", [Math::count(branch.view.rank())]),
        Statement::Theorem2 => {
            let text = top("the Jordan blocks of the largest modulus have the size @ and belong to ");
            evidence.push("semisimple", Tone::Good, text);
            ring_evidence(branch, evidence)
        }
        Statement::Theorem3 => {
            let text = top("the longest Jordan blocks of the largest modulus have the size $ℓ+1=@$ and belong to ");
            evidence.push("blocks", Tone::Good, text);
            ring_evidence(branch, evidence)
        }
        Statement::Theorem4 => shown(isolated(branch, evidence), "null"),
        Statement::Theorem4Sign | Statement::Theorem4Winding => {
            let text = top("the longest Jordan blocks of the largest modulus have the size $ℓ+1=@$ and belong to ");
            evidence.push("leading", Tone::Good, text);
            if let Some(proof) = &o.isolation {
                let text = format!(
                    "{} {}, whose common zeros are the generalised kernel of $L$, has a constant sign.",
                    on_cells(proof.discharged.len()),
                    one_of('k', proof)
                );
                evidence = evidence.holds("ring", &text, []);
            }
            let text = "$G$ has the rank @ on the space where $L$ acts, and loses nothing of the eigenspaces of eigenvalues that are not 0.";
            let evidence = evidence.holds("view", text, [Math::count(branch.view.rank())]);
            shown(evidence, if statement == Statement::Theorem4Sign { "signs" } else { "path" })
        }
        Statement::NullExists => {
            let text = top("the Jordan blocks of the largest modulus have the size @ and belong to ");
            evidence.push("semisimple", Tone::Good, text);
            shown(isolated(branch, evidence), "zero")
        }
        Statement::Section6Surface | Statement::Section6TwoBlocks => {
            let two = statement == Statement::Section6TwoBlocks;
            let text = top("the Jordan blocks of the largest modulus have the size @ and belong to ");
            evidence.push(if two { "blocks" } else { "block" }, Tone::Good, text);
            let evidence = evidence.holds("depth", "$0∉π_1(X)$, as shown below for Theorem 1.", []);
            shown(evidence, if two { "winding" } else { "crossing" })
        }
        _ => evidence,
    }
}

fn ring_evidence(branch: &SurfaceBranch, evidence: Evidence) -> Evidence {
    let Some(proof) = &branch.outcome.ring else { return evidence };
    let cells = on_cells(proof.discharged.len());
    let text = if proof.functionals.len() == 1 {
        format!("the leading functional $g$ below has no zero on $K$: {cells} it has a constant sign.")
    } else {
        format!(
            "the leading functionals $g_i$ below have no common zero on $K$: {cells} one of them has a constant sign."
        )
    };
    evidence.holds("ring", &format!("{text} (So the branch is isolated.)"), [])
}

/// The own leading coefficients of the points of the ring at which the leading functionals vanish.
fn own_coefficients(branch: &SurfaceBranch) -> Option<Block> {
    let Some(SurfaceWitness::Points(points)) = &branch.outcome.witness else { return None };
    let item = |(address, offset): &(Address, Vec<Rational>)| -> Option<Line> {
        let hull = krylov(&branch.linear, offset);
        let spectrum = Spectrum::of(&restrict(&branch.linear, &hull)?);
        let (block, eigenvalues) = longest(&spectrum)?;
        let mut out = words("the vectors ");
        out.extend(line(
            &format!("$L^m x$ of `{address}` span a space of dimension $@$; its largest modulus is that of "),
            [Math::count(hull.cols())],
        ));
        out.extend(names(&spectrum, &eigenvalues));
        out.extend(line(" with longest Jordan blocks of size $@$", [Math::count(block)]));
        for &(f, r) in &eigenvalues {
            let factor = &spectrum.factors[f];
            let chain = factor.right.iter().find(|c| c.vectors.len() == block)?;
            let vector: Vec<Elem> = (0..hull.rows())
                .map(|i| {
                    let terms = chain.vectors[0].iter().enumerate();
                    terms.fold(Elem::zero(), |s, (k, c)| s.add(&c.scale(&hull[(i, k)])))
                })
                .collect();
            out.extend(line(
                ", ended by the eigenvector $@$ in the coordinates of $L$, $@$",
                [elems::<Rational>(&vector, &factor.roots[r]), lambda_math(&factor.roots[r])],
            ));
        }
        out.extend(words("."));
        Some(out)
    };
    let items: Vec<Line> = points.iter().filter_map(item).collect();
    (!items.is_empty()).then_some(Block::List(items))
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
        blocks.push(cell_table(proof, "g"));
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
        blocks.push(cell_table(proof, letter));
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
    let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() }.beside());
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
