//! One section for each different cycle: operator, spectrum, ring, and the statement that applies.

use super::super::document::{Block, Check, Inline, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::theorems;
use super::super::values::{elem_math, polynomial, root_math};
use super::super::words::{blocks as block_words, cell, count, eigenvalue, holder, listed, rate, witness};
use super::{equation, quoted};
use crate::algebraic::Elem;
use crate::arith::{Interval, Rational};
use crate::case::Case;
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use crate::report::values::decimal_math;
use crate::shape::{Spaces, word_text};
use crate::theorem::{BranchReport, Certified, Outcome, RingProof, Statement, Witness};

/// Most cells that are listed of a ring condition.
const MAX_CELLS: usize = 400;

/// One branch for each different analysis.
pub(super) fn distinct(found: &Certified) -> Vec<&BranchReport> {
    let mut out: Vec<&BranchReport> = Vec::new();
    for branch in found.points.iter().flat_map(|p| &p.branches) {
        if index_of(&out, branch).is_none() {
            out.push(branch);
        }
    }
    out
}

/// Which of the listed analyses is that of a branch.
pub(super) fn index_of(listed: &[&BranchReport], branch: &BranchReport) -> Option<usize> {
    listed.iter().position(|b| {
        b.state == branch.state
            && b.address.cycle == branch.address.cycle
            && b.chart == branch.chart
            && b.linear == branch.linear
            && std::mem::discriminant(&b.outcome) == std::mem::discriminant(&branch.outcome)
            && super::applied(b) == super::applied(branch)
    })
}

/// The name of the section of a cycle.
pub(super) fn name(case: &Case, branch: &BranchReport, k: usize) -> String {
    let state = if case.shape.states.len() > 1 {
        format!(" at state {}", case.shape.states[branch.state].name)
    } else {
        String::new()
    };
    format!("Cycle {}: ({}){state}", k + 1, word_text(&branch.address.cycle))
}

pub(super) fn section(case: &Case, spaces: &Spaces, branch: &BranchReport, k: usize) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(3, words(name(case, branch, k)))];
    blocks.push(equation("M", Math::matrix(&branch.cycle_operator)));
    blocks.push(Block::text(
        "with the fixed point $q=@$ (check: $M q=q$, coordinate sum 1).",
        [Math::vector(&branch.fixed)],
    ));
    blocks.extend(space_blocks(spaces, branch));
    if branch.linear.rows() > 0 {
        blocks.push(Block::text("On it $M$ acts by", []));
        blocks.push(equation("L", Math::matrix(&branch.linear)));
        blocks.extend(spectrum_blocks(&branch.spectrum));
        blocks.extend(ring_blocks(branch));
    }
    blocks.extend(statement_blocks(branch));
    blocks
}

fn space_blocks(spaces: &Spaces, branch: &BranchReport) -> Vec<Block> {
    let basis = &spaces.of(branch.state).basis;
    let mut blocks = Vec::new();
    if basis.cols() > 0 {
        let columns = (0..basis.cols()).map(|j| Math::vector(&basis.column(j))).collect::<Vec<_>>();
        let mut text = line("$V$ has the dimension $@$ and the basis ", [Math::count(branch.relevant)]);
        for (j, column) in columns.into_iter().enumerate() {
            if j > 0 {
                text.extend(words(", "));
            }
            text.push(Inline::Math(column));
        }
        text.extend(words("."));
        blocks.push(Block::Paragraph(text));
    }
    let seen = branch.linear.rows();
    if seen < branch.relevant {
        blocks.push(Block::text(
            "What the prefix and the control points send to 0 for ever is divided out: the quotient $Y$ has the dimension $@$.",
            [Math::count(seen)],
        ));
    }
    if seen > 0 {
        blocks.push(Block::text("Coordinates of a point $x$ of the attractor are $C(x-q)$ with", []));
        blocks.push(equation("C", Math::matrix(&branch.chart)));
    }
    blocks
}

pub(super) fn spectrum_blocks(spectrum: &Spectrum) -> Vec<Block> {
    let mut blocks = vec![Block::text(
        "Characteristic polynomial $χ=@$. Its eigenvalues by descending modulus:",
        [polynomial(&spectrum.char_poly, 'x')],
    )];
    let mut rows = Vec::new();
    for (k, class) in spectrum.classes.iter().enumerate() {
        for member in &class.members {
            let factor = spectrum.factor(*member);
            let root = spectrum.root(*member);
            rows.push(vec![
                formula(Math::parse("ρ_@", &mut std::iter::once(Math::count(k + 1)))),
                formula(root_math(root)),
                formula(decimal_math(&root.modulus(60).mid(), 6)),
                formula(polynomial(&factor.poly, 'x')),
                formula(Math::count(factor.multiplicity)),
                words(listed(&factor.blocks.iter().map(ToString::to_string).collect::<Vec<_>>())),
            ]);
        }
    }
    let header = vec![
        words("modulus"),
        words("eigenvalue"),
        line("$|λ|≈$", []),
        words("minimal polynomial"),
        words("multiplicity"),
        words("Jordan blocks"),
    ];
    blocks.push(Block::Table(Table { caption: Line::new(), header, rows }));
    blocks
}

fn ring_blocks(branch: &BranchReport) -> Vec<Block> {
    let kept: Vec<String> =
        branch.ring.iter().filter(|p| !p.collapses).map(|p| format!("`{}`", word_text(&p.word))).collect();
    let dropped: Vec<String> =
        branch.ring.iter().filter(|p| p.collapses).map(|p| format!("`{}`", word_text(&p.word))).collect();
    let mut blocks = Vec::new();
    if kept.is_empty() {
        blocks.push(Block::text("No piece leaves the cycle: the ring is empty.", []));
    } else {
        let noun = if kept.len() == 1 { "the cell" } else { "the cells" };
        blocks.push(Block::text(&format!("The ring $K$ consists of {noun} {}.", listed(&kept)), []));
    }
    if !dropped.is_empty() {
        let text =
            format!("By Lemma 2 these cells, which fall into $q$ as a whole, are left out: {}.", listed(&dropped));
        blocks.push(Block::text(&text, []));
        blocks.push(super::quoted_id("lemma-2"));
    }
    blocks
}

/// Numerators of a vector over `Q(λ)` as a row.
fn elems(v: &[Elem]) -> Math {
    Math::tuple(v.iter().map(elem_math).collect())
}

/// The functional on points: its row on `x − q`.
fn row_on_points(functional: &[Elem], chart: &Matrix) -> Vec<Elem> {
    (0..chart.cols())
        .map(|j| {
            functional.iter().enumerate().fold(Elem::zero(), |sum, (k, f)| {
                let c = &chart[(k, j)];
                if *c == 0 { sum } else { sum.add(&f.scale(c)) }
            })
        })
        .collect()
}

fn check(tone: Tone, template: &str, values: Vec<Math>) -> Check {
    Check { tone, text: line(template, values) }
}

fn statement_blocks(branch: &BranchReport) -> Vec<Block> {
    match &branch.outcome {
        Outcome::Line { statement, .. } => {
            let mut blocks = vec![quoted(theorems::of(*statement))];
            blocks.extend(line_blocks(branch, *statement));
            blocks
        }
        Outcome::AtLeast { statement, .. } => {
            let mut blocks = vec![quoted(theorems::of(*statement))];
            blocks.extend(many_blocks(branch, *statement));
            blocks
        }
        Outcome::NoGerm { reason } => vec![Block::Paragraph(words(format!("There is no germ here: {reason}.")))],
        Outcome::Open { reason, place, at_least, .. } => {
            let place = place.as_ref().map(|p| format!(" The smallest cell in which it failed is {}.", cell(p)));
            let text =
                format!("**Not decided**: {reason}.{} What is proved is $\\dim D^*≥@$.", place.unwrap_or_default());
            vec![Block::text(&text, [Math::count(*at_least)])]
        }
    }
}

fn line_blocks(branch: &BranchReport, statement: Statement) -> Vec<Block> {
    let Outcome::Line { eigenvalue: (f, r), block, functional, proof, rate: speed, holder: exponent, .. } =
        &branch.outcome
    else {
        return Vec::new();
    };
    let factor = &branch.spectrum.factors[*f];
    let root = &factor.roots[*r];
    let lambda = || root_math(root);
    let next = branch.spectrum.classes.get(1).map(|c| branch.spectrum.root(c.members[0]));
    let mut checks = Vec::new();
    if statement == Statement::CorollaryLine {
        checks.push(check(Tone::Good, "$\\dim V=1$.", vec![]));
        checks.push(check(Tone::Good, "$L≠0$: its eigenvalue is $λ=@$.", vec![lambda()]));
    } else {
        checks.push(check(Tone::Good, "$L$ is not nilpotent: $λ=@≠0$.", vec![lambda()]));
        let alone = match next {
            Some(next) => (" The next modulus is that of $@$, which is smaller.", vec![root_math(next)]),
            None => ("", vec![]),
        };
        let (what, mut values) = if *block == 1 {
            (
                "$λ=@$ is real, simple, and the only eigenvalue of the largest modulus, so that $E_1$ is a line.",
                vec![lambda()],
            )
        } else {
            let values = vec![lambda(), Math::count(*block)];
            (
                "$λ=@$ is real, and the largest modulus has exactly one longest Jordan block, of size $@$, so that $U$ is a line.",
                values,
            )
        };
        values.extend(alone.1);
        checks.push(check(Tone::Good, &format!("{what}{}", alone.0), values));
    }
    match proof {
        Some(proof) => checks.push(check(
            Tone::Good,
            &format!(
                "Ring condition: the functional $g$ below has no zero on $K$; its sign is constant on each of {} that cover $K$. This also proves \
                 that the branch is isolated.",
                count(proof.discharged.len(), "cell")
            ),
            vec![],
        )),
        None => checks.push(check(Tone::Neutral, "Ring condition: not used; the rays are not settled.", vec![])),
    }
    let chain = factor.right.iter().find(|c| c.vectors.len() == *block);
    let mut blocks = vec![Block::Checks(checks)];
    if let Some(chain) = chain {
        blocks.push(Block::text("The right eigenvector in coordinates of $V$ is $v=@$.", [elems(&chain.vectors[0])]));
        if *block > 1 {
            let rest = chain.vectors[1..].iter().map(|v| elems(v)).collect::<Vec<_>>();
            blocks.push(Block::text(
                "It ends the chain of generalised eigenvectors $@$, each sent to the one before by $L-λ$.",
                [Math::tuple(rest)],
            ));
        }
    }
    blocks.push(Block::text(
        "The left functional is $g(x)=@·C(x-q)=@·(x-q)$.",
        [elems(functional), elems(&row_on_points(functional, &branch.chart))],
    ));
    if let Some(last) = chain.and_then(|c| c.vectors.last()) {
        let pairing = functional.iter().zip(last).fold(Elem::zero(), |s, (a, b)| s.add(&a.mul(b, &factor.poly)));
        blocks.push(if *block == 1 {
            Block::text("Since $g(v)=@$, the component of $x$ along $v$ is $g(x)/g(v)$.", [elem_math(&pairing)])
        } else {
            let values = [elem_math(&pairing), Math::count(*block - 1)];
            Block::text(
                "On the last vector of the chain $g$ has the value $c=@$, so that $u(x)=λ^{-@}(g(x)/c) v$.",
                values,
            )
        });
    }
    if root.rational().is_none() {
        blocks.push(Block::text("Here $λ=@$ is a root of $@$.", [lambda(), polynomial(root.minpoly(), 'x')]));
    }
    blocks.extend(proof.as_ref().map(cell_table));
    let mut conclusion = line("**Conclusion.** $D^*$ is the line of $v$. Angular deviation: ", []);
    conclusion.extend(rate(speed));
    conclusion.extend(words(". Local Hölder exponent: "));
    conclusion.extend(holder(exponent));
    conclusion.extend(words("."));
    blocks.push(Block::Paragraph(conclusion));
    blocks
}

fn many_blocks(branch: &BranchReport, statement: Statement) -> Vec<Block> {
    let Outcome::AtLeast { dimension, eigenvalues, isolation, witness: found, .. } = &branch.outcome else {
        return Vec::new();
    };
    let mut shown: Vec<(usize, usize)> = Vec::new();
    let mut names = Line::new();
    for &(f, r) in eigenvalues {
        if shown.contains(&(f, r)) {
            continue;
        }
        if !shown.is_empty() {
            names.extend(words(" and "));
        }
        shown.push((f, r));
        names.extend(eigenvalue(&branch.spectrum, crate::jordan::Eigenvalue { factor: f, root: r }));
    }
    let mut top = words("The longest Jordan blocks of the largest modulus belong to ");
    top.extend(names);
    let sizes: Vec<String> = shown.iter().map(|&(f, _)| block_words(&branch.spectrum.factors[f].blocks)).collect();
    top.extend(words(format!(" ({}).", listed(&sizes))));
    let mut checks = vec![check(Tone::Good, "$L$ is not nilpotent.", vec![]), Check { tone: Tone::Good, text: top }];
    if statement == Statement::Corollary {
        let text = "Their eigenvectors span, after transport to the point, at least a plane: $\\dim G U≥@$.";
        checks.push(check(Tone::Good, text, vec![Math::count(*dimension)]));
    }
    if let Some(proof) = isolation {
        let text = format!(
            "The branch is isolated: {} cover $K$ on which not all functionals vanish.",
            count(proof.discharged.len(), "cell")
        );
        checks.push(check(Tone::Good, &text, vec![]));
    }
    if let Some(found) = found {
        let mut text = words("Witness: ");
        text.extend(witness(found));
        text.extend(words("."));
        checks.push(Check { tone: Tone::Good, text });
    }
    let mut blocks = vec![Block::Checks(checks)];
    blocks.extend(isolation.as_ref().map(cell_table));
    if let Some(Witness::Crossing { cover, .. }) = found {
        blocks.push(cell_table(cover));
    }
    blocks.push(Block::text(
        "**Conclusion.** $\\dim D^*≥@$: there is no tangent line on this branch.",
        [Math::count(*dimension)],
    ));
    blocks
}

/// The cells on which a functional keeps its sign.
pub(super) fn cell_table(proof: &RingProof) -> Block {
    let several = proof.functionals.len() > 1;
    let rows = proof.discharged.iter().take(MAX_CELLS).map(|d| {
        let (lo, hi) = bounds(&d.bound);
        let mut row = vec![code(word_text(&d.word)), formula(lo), formula(hi)];
        if several {
            row.insert(1, formula(Math::parse("g_@", &mut std::iter::once(Math::count(d.functional + 1)))));
        }
        row
    });
    let mut header = vec![words("cell"), words("from"), words("to")];
    if several {
        header.insert(1, words("functional"));
    }
    let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() });
    let shown = proof.discharged.len().min(MAX_CELLS);
    let what = if several { "The values of one functional" } else { "The values of $g$" };
    let all = if shown < proof.discharged.len() {
        format!(" (the first {shown} of {})", proof.discharged.len())
    } else {
        String::new()
    };
    let summary = line(&format!("{what} on the cells that cover the ring, bounds rounded outwards{all}:"), []);
    Block::Details { summary, blocks: vec![table] }
}

/// Both ends as decimals rounded outwards, or exactly where six digits would lose the sign.
fn bounds(x: &Interval) -> (Math, Math) {
    use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
    let million = Rational::from(1_000_000);
    let lo = Rational::from((&x.lo * &million).floor()) / &million;
    let hi = Rational::from((&x.hi * &million).ceiling()) / &million;
    if crate::arith::sign(&lo) == crate::arith::sign(&x.lo) && crate::arith::sign(&hi) == crate::arith::sign(&x.hi) {
        (decimal_math(&lo, 6), decimal_math(&hi, 6))
    } else {
        (Math::number(&x.lo), Math::number(&x.hi))
    }
}
