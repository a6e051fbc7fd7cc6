//! The section on the points of a surface.

use super::super::document::{Block, Check, Inline, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::surface::{head, outcome, product_line, span, verdict, witness};
use super::super::theorems;
use super::super::values::{elem_math, root_math};
use super::super::words::{count, listed, mark, tone};
use super::cycles::spectrum_blocks;
use super::statements::cell_table;
use super::{equation, quoted, quoted_id};
use crate::case::Case;
use crate::shape::word_text;
use crate::theorem::surface::{Surface, SurfaceBranch, SurfaceDense, SurfaceWitness};
use crate::theorem::{Part, Statement};

/// One analysis for each different cycle as it is seen, and the points that they give.
pub(super) fn section(case: &Case, surface: &Surface) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "The cycles")];
    blocks.push(Block::text(
        "A point has one branch for each cell that contains it: an address $u w^ω$ with a prefix $u$ and a cycle $w$. $M=T_w$ has the fixed \
         point $q$, $V$ is the span of the differences of the attractor, $L$ is $M$ on $V$ (on the part that is seen), the ring $K$ is what \
         leaves the cycle during its first turn, and $X=K-q$.",
        [],
    ));
    if surface.simplex {
        let text = "All operators are nonnegative, so that every attractor lies in the simplex of its coordinates: a functional lies between \
                    the smallest and the largest entry of its row on a cell.";
        blocks.push(Block::text(text, []));
    }
    let mut known: Vec<&SurfaceBranch> = Vec::new();
    for branch in surface.points.iter().flat_map(|p| &p.branches) {
        if index_of(&known, branch).is_none() {
            blocks.extend(cycle(case, branch, known.len()));
            known.push(branch);
        }
    }
    blocks.push(Block::heading(2, "The points"));
    if surface.points.iter().any(|p| p.branches.len() > 1) {
        blocks.push(quoted_id("surface-point"));
    }
    if surface.points.iter().any(|p| p.product.is_some()) {
        blocks.push(quoted_id("tensor-product"));
    }
    for point in &surface.points {
        blocks.push(Block::Heading(3, head(point)));
        let place = match &point.image {
            Some(image) => {
                line("The point is $p=@$, that is $@$.", [Math::vector(&point.position), Math::vector(image)])
            }
            None => line("The point is $p=@$.", [Math::vector(&point.position)]),
        };
        blocks.push(Block::Paragraph(place));
        let mut checks = Vec::new();
        for branch in &point.branches {
            let number = index_of(&known, branch).map_or(0, |k| k + 1);
            let mut text = line(&format!("Branch `{}`, cycle {number}: ", branch.address), []);
            text.extend(subspace(branch));
            let good = branch.outcome.dimension.exact;
            checks.push(Check { tone: if good { Tone::Good } else { Tone::Open }, text });
        }
        if let Some(product) = &point.product {
            let mut text = words("Tensor product: ");
            text.extend(product_line(product));
            checks.push(Check { tone: tone(product.verdict), text });
        }
        blocks.push(Block::Checks(checks));
        let mut conclusion = line("**Conclusion.** ", []);
        conclusion.extend(verdict(point));
        if let Some(space) = point.tangent.as_ref().filter(|s| !s.generators.is_empty()) {
            conclusion.extend(line("; $D^*$ is spanned by ", []));
            conclusion.extend(span(space));
        }
        conclusion.extend(words("."));
        blocks.push(Block::Paragraph(conclusion));
    }
    blocks.extend(surface.dense.as_ref().map(|d| dense(case, d)).unwrap_or_default());
    blocks
}

fn index_of(known: &[&SurfaceBranch], branch: &SurfaceBranch) -> Option<usize> {
    known.iter().position(|b| {
        b.state == branch.state
            && b.address.cycle == branch.address.cycle
            && b.chart == branch.chart
            && b.linear == branch.linear
            && b.outcome.dimension == branch.outcome.dimension
    })
}

/// `G D*` of a branch, or what is known of it.
fn subspace(branch: &SurfaceBranch) -> Line {
    let o = &branch.outcome;
    let mut out = Line::new();
    if o.contains.generators.is_empty() {
        out.extend(line("$\\dim D^*≥@$", [Math::count(o.dimension.at_least)]));
        return out;
    }
    out.extend(line(if o.dimension.exact { "$D^*$ is spanned by " } else { "$D^*$ contains " }, []));
    out.extend(span(&o.contains));
    out
}

fn cycle(case: &Case, branch: &SurfaceBranch, k: usize) -> Vec<Block> {
    let state = &case.shape.states[branch.state].name;
    let title = format!("Cycle {}: ({}) at state {state}", k + 1, word_text(&branch.address.cycle));
    let mut blocks = vec![Block::heading(3, &title)];
    let seen = branch.linear.rows();
    blocks.push(Block::text(
        "The fixed point is $q=@$. $V$ has the dimension $@$, of which $@$ are seen.",
        [Math::vector(&branch.fixed), Math::count(branch.relevant), Math::count(seen)],
    ));
    if seen == 0 {
        blocks.push(Block::Paragraph(words("The cell is a single point.")));
        return blocks;
    }
    let matrices = vec![
        equation("M", Math::matrix(&branch.cycle_operator)),
        Block::text("Coordinates of a point $x$ of the attractor are $C(x-q)$ with", []),
        equation("C", Math::matrix(&branch.chart)),
        Block::text("and $M$ acts on them by", []),
        equation("L", Math::matrix(&branch.linear)),
    ];
    blocks.push(Block::Details { summary: words("The matrices"), blocks: matrices });
    blocks.extend(spectrum_blocks(&branch.spectrum));
    let pieces = |collapsed: bool| -> Vec<String> {
        let kept = branch.ring.iter().filter(|p| p.collapses == collapsed);
        kept.map(|p| format!("`{}`", word_text(&p.word))).collect()
    };
    blocks.push(Block::text(&format!("The ring consists of the cells {}.", listed(&pieces(false))), []));
    if !pieces(true).is_empty() {
        blocks.push(quoted_id("lemma-2"));
        blocks.push(Block::text(&format!("It leaves out the cells {}.", listed(&pieces(true))), []));
    }
    let o = &branch.outcome;
    if let Some(s) = o.statement {
        blocks.push(quoted(theorems::of(s)));
    }
    let mut checks = vec![Check { tone: Tone::Neutral, text: words(format!("Top of the spectrum: {}.", o.row)) }];
    for (k, g) in o.ring.iter().flat_map(|proof| &proof.functionals).enumerate() {
        let row = Math::tuple(g.row.iter().map(elem_math).collect());
        let part = match (g.part, g.root.as_ref().is_some_and(|r| !r.is_real())) {
            (_, false) => "",
            (Part::Real, true) => "the real part of ",
            (Part::Imaginary, true) => "the imaginary part of ",
        };
        let (at, mut values) = match g.root.as_ref().filter(|r| r.rational().is_none()) {
            Some(root) => (" with $λ=@$", vec![root_math(root)]),
            None => ("", Vec::new()),
        };
        values.splice(0..0, [Math::count(k + 1), row]);
        let text = line(&format!("Leading functional: $g_@(x)$ is {part}$@·C(x-q)${at}."), values);
        checks.push(Check { tone: Tone::Neutral, text });
    }
    if let Some(proof) = &o.ring {
        let cells = count(proof.discharged.len(), "cell");
        let text =
            format!("Ring condition: the leading functionals have no common zero on K, by {cells} that cover it.");
        checks.push(Check { tone: Tone::Good, text: words(text) });
    }
    if let Some(w) = &o.witness {
        let mut text = words("The ring condition fails: ");
        text.extend(witness(w));
        checks.push(Check { tone: Tone::Bad, text });
    }
    if let Some((depth, proof)) = &o.depth {
        let cells = count(proof.discharged.len(), "cell");
        let text =
            line(&format!("$0∉π_@(X)$, by {cells}: $D^*⊂E_1⊕…⊕E_@$."), [Math::count(*depth), Math::count(*depth)]);
        checks.push(Check { tone: Tone::Good, text });
    }
    blocks.push(Block::Checks(checks));
    for proof in o.ring.iter().chain(&o.isolation).chain(o.depth.iter().map(|d| &d.1)) {
        blocks.push(cell_table(proof));
    }
    if let Some(SurfaceWitness::Winding(winding)) = &o.witness {
        let rows = winding.path.iter().map(|d| {
            let half = if d.sign > 0 { "positive" } else { "negative" };
            let name = formula(Math::parse("g_@", &mut std::iter::once(Math::count(d.functional + 1))));
            vec![code(word_text(&d.word)), name, words(half)]
        });
        let header = vec![words("cell"), words("functional"), words("sign")];
        let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() });
        blocks.push(Block::Details {
            summary: words("The cells along the boundary, in cyclic order:"),
            blocks: vec![table],
        });
    }
    let mut conclusion = line("**Conclusion.** ", []);
    conclusion.extend(outcome(o));
    conclusion.extend(words("."));
    blocks.push(Block::Paragraph(conclusion));
    blocks
}

fn dense(case: &Case, dense: &SurfaceDense) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    blocks.push(quoted(theorems::of(Statement::Theorem5Surface)));
    let name = |e: usize| case.shape.states[e].name.clone();
    let mut checks = Vec::new();
    for (state, point) in &dense.vertices {
        let mut text = words(format!("before the projection, a vertex inside state {}, address ", name(*state)));
        text.push(Inline::Code(point.branches.first().map(|b| b.address.to_string()).unwrap_or_default()));
        text.extend(words(": "));
        text.push(mark(point.verdict));
        checks.push(Check { tone: tone(point.verdict), text });
    }
    let failing: Vec<String> =
        dense.injective.iter().filter(|x| !x.2).map(|(e, i, _)| format!("$T_{{{i}}}$ of state {}", name(*e))).collect();
    let (good, text) = if failing.is_empty() {
        (true, "all operators are injective on the visible relevant spaces".to_owned())
    } else {
        (false, format!("not injective: {}", listed(&failing)))
    };
    checks.push(Check { tone: if good { Tone::Good } else { Tone::Bad }, text: line(&text, []) });
    if case.shape.control.is_some() {
        let verb = if dense.view_injective { "is" } else { "is not" };
        let text = words(format!("the projection by the control points {verb} injective on the relevant space"));
        checks.push(Check { tone: if dense.view_injective { Tone::Good } else { Tone::Neutral }, text });
        if !dense.view_injective {
            let text = if dense.everywhere {
                "the bivectors of the planes span an invariant family of equal dimensions that the control points do not kill: every cell \
                 contains a vertex with a tangent plane"
            } else {
                "it was not shown that every cell contains such a vertex"
            };
            let tone = if dense.everywhere { Tone::Good } else { Tone::Open };
            checks.push(Check { tone, text: words(text) });
        }
    }
    blocks.push(Block::Checks(checks));
    blocks
}
