//! The statement that applies to a cycle: its hypotheses one by one, the functional, the rays, and what follows.

use super::super::document::{Block, Check, Inline, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::theorems;
use super::super::values::{decimal_math, elem_math, polynomial, root_math};
use super::super::words::{cell, count, holder, listed, rate, witness};
use super::Quoted;
use crate::algebraic::Elem;
use crate::arith::{Interval, Rational};
use crate::case::Case;
use crate::jordan::{Chain, Factor};
use crate::linalg::Matrix;
use crate::report::figures;
use crate::shape::{CellKind, word_text};
use crate::theorem::{BranchReport, Functional, Outcome, Part, Position, RingProof, Statement, Witness};

/// Most cells that are listed of a ring condition.
const MAX_CELLS: usize = 400;

/// The part of a cycle's section that applies a statement.
pub(super) fn blocks(case: &Case, branch: &BranchReport, seen: &mut Quoted) -> Vec<Block> {
    match &branch.outcome {
        Outcome::Line { statement, .. } => {
            let mut blocks = seen.once(theorems::of(*statement));
            blocks.extend(line_blocks(case, branch, *statement, seen));
            blocks
        }
        Outcome::AtLeast { statement, .. } => {
            let mut blocks = seen.once(theorems::of(*statement));
            blocks.extend(many_blocks(case, branch, *statement));
            blocks
        }
        Outcome::NoGerm { reason } => {
            let why = if branch.linear.rows() > 0 {
                " $L$ is nilpotent, so that near $q$ the shape consists of the finitely many sets $M^m K$ that contain $q$, and by enclosures \
                 none does."
            } else {
                ""
            };
            vec![Block::text(&format!("There is no germ here: {reason}.{why}"), [])]
        }
        Outcome::Open { reason, place, at_least, .. } => {
            let mut blocks = Vec::new();
            let place = place.as_ref().map(|p| format!(" The cell in which it failed is {}.", cell(p)));
            let mut text = format!("**Not decided**: {reason}.{}", place.unwrap_or_default());
            if *at_least > 0 {
                blocks.extend(seen.once_id("corollary"));
                text.push_str(
                    " What is proved is $\\dim D^*≥@$, by the corollary: $L$ is not nilpotent, so that $U⊂D^*$, and the way to the point \
                     does not kill $U$. Nothing more is claimed.",
                );
            } else {
                text.push_str(" Nothing is claimed about the tangent subspace here.");
            }
            blocks.push(Block::text(&text, [Math::count(*at_least)]));
            blocks
        }
    }
}

/// A vector over `Q(λ)` as a row.
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

fn chain_of(chains: &[Chain], block: usize) -> Option<&Chain> {
    chains.iter().find(|c| c.vectors.len() == block)
}

/// `g(x) = …` in both coordinates, after some words.
fn functional_block(before: &str, functional: &[Elem], branch: &BranchReport) -> Block {
    let template = format!("{before} $g(x)=@·C(x-q)=@·(x-q)$.");
    Block::text(&template, [elems(functional), elems(&row_on_points(functional, &branch.chart))])
}

fn top_checks(branch: &BranchReport, statement: Statement, factor: &Factor, root: usize, block: usize) -> Vec<Check> {
    let lambda = || root_math(&factor.roots[root]);
    if statement == Statement::CorollaryLine {
        return vec![
            check(Tone::Good, "$\\dim V=1$.", vec![]),
            check(Tone::Good, "$L≠0$: its eigenvalue is $λ=@$.", vec![lambda()]),
        ];
    }
    let mut checks = vec![check(Tone::Good, "$L$ is not nilpotent: $λ=@≠0$.", vec![lambda()])];
    let (what, mut values) = if block == 1 {
        ("$λ=@$ is real, simple, and alone in the largest modulus, so that $E_1$ is a line.", vec![lambda()])
    } else {
        let values = vec![lambda(), Math::count(block)];
        (
            "$λ=@$ is real, and the largest modulus has exactly one longest Jordan block, of size $@$, so that $U$ is a line.",
            values,
        )
    };
    let next = branch.spectrum.classes.get(1).map(|c| branch.spectrum.root(c.members[0]));
    let rest = if next.is_some() { " The next modulus is that of $@$, which is smaller." } else { "" };
    values.extend(next.map(root_math));
    checks.push(check(Tone::Good, &format!("{what}{rest}"), values));
    checks
}

fn line_blocks(case: &Case, branch: &BranchReport, statement: Statement, seen: &mut Quoted) -> Vec<Block> {
    let Outcome::Line { eigenvalue: (f, r), block, functional, proof, rate: speed, holder: exponent, .. } =
        &branch.outcome
    else {
        return Vec::new();
    };
    let factor = &branch.spectrum.factors[*f];
    let root = &factor.roots[*r];
    let mut checks = top_checks(branch, statement, factor, *r, *block);
    checks.push(match proof {
        Some(proof) => {
            let text = format!(
                "Ring condition: the functional $g$ below has no zero on $K$: {} $g$ has a constant sign. This also proves that the branch is \
                 isolated.",
                on_cells(proof.discharged.len())
            );
            check(Tone::Good, &text, vec![])
        }
        None => check(Tone::Neutral, "Ring condition: not used; the rays are not settled.", vec![]),
    });
    let mut blocks = vec![Block::Checks(checks)];
    if root.rational().is_none() {
        blocks.push(Block::text("Here $λ=@$ is a root of $@$.", [root_math(root), polynomial(root.minpoly(), 'x')]));
    }
    blocks.extend(vector_blocks(branch, factor, *block, functional));
    if let Some(proof) = proof {
        blocks.push(figures::functional(case, branch, functional, root, Some(proof)));
        blocks.push(cell_table(proof));
        blocks.extend(ray_blocks(case, branch, root.sign(), proof, seen));
    }
    let mut conclusion = line("**Conclusion.** $D^*$ is the line of $v$", []);
    if proof.is_some() {
        conclusion.extend(words("; angular deviation of the secants: "));
        conclusion.extend(rate(speed));
        if case.shape.states[branch.state].kind == CellKind::Edge {
            conclusion.extend(words(
                "; local Hölder exponent of this branch in the uniform parameter, in which the pieces of a cell take equal parts of its \
                 interval: ",
            ));
            conclusion.extend(holder(exponent));
        }
    }
    conclusion.extend(words("."));
    blocks.push(Block::Paragraph(conclusion));
    blocks
}

/// `3 cells cover $K$, and on each of them`.
fn on_cells(number: usize) -> String {
    if number == 1 {
        "1 cell covers $K$, and on it".to_owned()
    } else {
        format!("{number} cells cover $K$, and on each of them")
    }
}

/// The eigenvector, its chain, and the functional that reads the leading coefficient.
fn vector_blocks(branch: &BranchReport, factor: &Factor, block: usize, functional: &[Elem]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let Some(chain) = chain_of(&factor.right, block) else { return blocks };
    blocks.push(Block::text("The right eigenvector, in the coordinates of $L$, is $v=@$.", [elems(&chain.vectors[0])]));
    if block > 1 {
        let rest = chain.vectors[1..].iter().map(|v| elems(v)).collect::<Vec<_>>();
        blocks.push(Block::text(
            "It ends the chain of generalised eigenvectors $@$, of which $L-λ$ sends the first to $v$ and each other one to the one before.",
            [Math::tuple(rest)],
        ));
    }
    blocks.push(functional_block("The left functional is", functional, branch));
    let last = &chain.vectors[block - 1];
    let pairing = functional.iter().zip(last).fold(Elem::zero(), |s, (a, b)| s.add(&a.mul(b, &factor.poly)));
    blocks.push(if block == 1 {
        Block::text("Since $g(v)=@$, the component of $x$ along $v$ is $c(x)=g(x)/g(v)$.", [elem_math(&pairing)])
    } else {
        let values = [elem_math(&pairing), Math::count(block - 1)];
        Block::text(
            "On the last vector of the chain $g$ has the value $g_0=@$, so that $u(x)=c(x) v$ with $c(x)=λ^{-@} g(x)/g_0$.",
            values,
        )
    });
    blocks
}

/// The data of the rule for rays.
fn ray_blocks(case: &Case, branch: &BranchReport, sign: i32, proof: &RingProof, seen: &mut Quoted) -> Vec<Block> {
    let curve = case.shape.states[branch.state].kind == CellKind::Edge;
    let on = |wanted: &[Position]| -> Option<&'static str> {
        let mut signs = proof.discharged.iter().filter(|d| wanted.contains(&d.position)).map(|d| d.sign);
        let first = signs.next()?;
        Some(match (signs.all(|s| s == first), first > 0) {
            (false, _) => "of both signs",
            (true, true) => "positive",
            (true, false) => "negative",
        })
    };
    let mut facts = vec![format!("$λ{}0$", if sign > 0 { ">" } else { "<" })];
    if curve {
        facts.push(format!("$ε={}1$", if branch.cycle_sign > 0 { "" } else { "-" }));
        facts.extend(on(&[Position::Before]).map(|s| format!("$g$ is {s} on the cells before $q$")));
        facts.extend(on(&[Position::After]).map(|s| format!("$g$ is {s} on the cells after $q$")));
    } else {
        facts.extend(on(&[Position::Unordered]).map(|s| format!("$g$ is {s} on the ring")));
    }
    let mut blocks = seen.once_id("rays");
    let text = format!("For the rays: {}. The rays that follow are listed with the points.", listed(&facts));
    blocks.push(Block::text(&text, []));
    blocks
}

/// What the largest modulus looks like, in the words of the thesis's cases.
fn pattern(branch: &BranchReport, eigenvalues: &[(usize, usize)]) -> &'static str {
    let roots: Vec<_> = eigenvalues.iter().map(|&(f, r)| &branch.spectrum.factors[f].roots[r]).collect();
    let real = roots.iter().filter(|r| r.is_real()).count();
    let same = eigenvalues.windows(2).all(|w| w[0] == w[1]);
    match (real, roots.len()) {
        (0, _) => "a complex pair, so that the leading part turns with every turn of the cycle",
        (n, m) if n < m => "real and complex eigenvalues of equal modulus",
        (_, _) if same => "one real eigenvalue with several longest blocks",
        _ => "real eigenvalues of equal modulus, $λ$ and $-λ$",
    }
}

fn many_blocks(case: &Case, branch: &BranchReport, statement: Statement) -> Vec<Block> {
    let Outcome::AtLeast { dimension, eigenvalues, isolation, witness: found, .. } = &branch.outcome else {
        return Vec::new();
    };
    let Some(&(f, r)) = eigenvalues.first() else { return Vec::new() };
    let factor = &branch.spectrum.factors[f];
    let block = factor.blocks[0];
    let mut top =
        line("The longest Jordan blocks of the largest modulus have the size $@$ and belong to ", [Math::count(block)]);
    top.extend(names(branch, eigenvalues));
    if statement == Statement::Corollary {
        top.extend(line(&format!(": {}", pattern(branch, eigenvalues)), []));
    }
    top.extend(words("."));
    let mut checks = vec![check(Tone::Good, "$L$ is not nilpotent.", vec![]), Check { tone: Tone::Good, text: top }];
    if statement == Statement::Corollary {
        let injective = branch.view.rank() == branch.view.cols();
        let text = if injective {
            "Their eigenvectors span $U$ with $\\dim U≥@$, and the way $G$ to the point is injective."
        } else {
            "On the way $G$ to the point the images of their eigenvectors still span a plane, a minor of two of them not being 0: \
             $\\dim G U≥@$."
        };
        checks.push(check(Tone::Good, text, vec![Math::count(*dimension)]));
    }
    if let Some(proof) = isolation {
        let text = format!(
            "The branch is isolated: {} one of the functionals $g_i$ below, whose common zeros are the generalised kernel of $L$, has a \
             constant sign.",
            on_cells(proof.discharged.len())
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
    blocks.extend(eigenvector_blocks(branch, eigenvalues, block));
    if found.is_some() {
        blocks.extend(witness_blocks(case, branch, factor, r, block));
    }
    if let Some(proof) = isolation {
        blocks.extend(functional_list("g", &proof.functionals, branch));
        blocks.push(cell_table(proof));
    }
    if let Some(Witness::Crossing { cover, .. }) = found {
        blocks.push(Block::text(
            "For the witness: $c_2$ reads the coefficient of the second vector of the chain and $c_1$ that of the first one where $c_2=0$, \
             up to one positive factor; below they are $h_1$ and $h_2$.",
            [],
        ));
        blocks.extend(functional_list("h", &cover.functionals, branch));
        blocks.push(cell_table_of(cover, "h"));
    }
    blocks.push(Block::Paragraph(why(*dimension, statement, found.as_ref())));
    blocks
}

/// The conclusion of a refutation with the reason in words.
fn why(dimension: usize, statement: Statement, found: Option<&Witness>) -> Line {
    let reason = match (statement, found) {
        (Statement::Corollary, _) => "the image of $U$ at the point is contained in $D^*$, so that",
        (Statement::Section6, _) => {
            "going along that part one meets zeros of $c_2$ from both sides, and from one of them the criterion gives limit directions off the line \
             $U$, so that"
        }
        (_, Some(Witness::SignChange { .. })) => {
            "$g$ has a zero on that connected part; the orbit of such a point stays in $F_1$ and is never 0, so that its limit directions lie outside \
             the line $U⊂D^*$, and"
        }
        _ => {
            "the orbit of the witness stays in $F_1$ and is never 0, so that its limit directions lie outside the line $U⊂D^*$, and"
        }
    };
    line(
        &format!("**Conclusion.** There is no tangent line on this branch: {reason} $\\dim D^*≥@$."),
        [Math::count(dimension)],
    )
}

/// The different eigenvalues, once each.
fn names(branch: &BranchReport, eigenvalues: &[(usize, usize)]) -> Line {
    let mut shown: Vec<(usize, usize)> = Vec::new();
    let mut out = Line::new();
    for &(f, r) in eigenvalues {
        if shown.contains(&(f, r)) {
            continue;
        }
        if !shown.is_empty() {
            out.extend(words(" and "));
        }
        let times = eigenvalues.iter().filter(|&&e| e == (f, r)).count();
        out.push(Inline::Math(root_math(&branch.spectrum.factors[f].roots[r])));
        if times > 1 {
            out.extend(words(format!(" ({times} blocks)")));
        }
        shown.push((f, r));
    }
    out
}

/// The eigenvectors that span `U`, by irreducible factor.
fn eigenvector_blocks(branch: &BranchReport, eigenvalues: &[(usize, usize)], block: usize) -> Vec<Block> {
    let mut done: Vec<usize> = Vec::new();
    let mut blocks = Vec::new();
    for &(f, r) in eigenvalues {
        if done.contains(&f) {
            continue;
        }
        done.push(f);
        let factor = &branch.spectrum.factors[f];
        for chain in factor.right.iter().filter(|c| c.vectors.len() == block) {
            let root = &factor.roots[r];
            let values = [root_math(root), polynomial(&factor.poly, 'x'), elems(&chain.vectors[0])];
            let text = match (root.rational(), root.is_real()) {
                (Some(_), _) => "An eigenvector for $λ=@$ (a root of $@$), in the coordinates of $L$, is $@$.",
                (None, true) => "An eigenvector for $λ=@$, a root of $@$, in the coordinates of $L$, is $@$.",
                (None, false) => {
                    "An eigenvector for $λ=@$, a root of $@$, in the coordinates of $L$, is $@$; its real and imaginary parts span a plane."
                }
            };
            blocks.push(Block::text(
                &text.replace(" (a root of $@$)", ""),
                match root.rational() {
                    Some(_) => vec![values[0].clone(), values[2].clone()],
                    None => values.to_vec(),
                },
            ));
        }
    }
    blocks
}

/// The functional that vanishes at a witness.
fn witness_blocks(case: &Case, branch: &BranchReport, factor: &Factor, root: usize, block: usize) -> Vec<Block> {
    let Some(chain) = chain_of(&factor.left, block) else { return Vec::new() };
    let functional = &chain.vectors[0];
    let mut blocks = vec![functional_block("The functional that reads the leading coefficient is", functional, branch)];
    if case.shape.states[branch.state].kind == CellKind::Edge {
        blocks.push(figures::functional(case, branch, functional, &factor.roots[root], None));
    }
    blocks
}

fn functional_list(letter: &str, functionals: &[Functional], branch: &BranchReport) -> Vec<Block> {
    let item = |(k, f): (usize, &Functional)| {
        let part = if f.part == Part::Imaginary { ", imaginary part" } else { "" };
        line(
            &format!("${letter}_@(x)=@·(x-q)${part}"),
            [Math::count(k + 1), elems(&row_on_points(&f.row, &branch.chart))],
        )
    };
    vec![Block::List(functionals.iter().enumerate().map(item).collect())]
}

/// The cells on which a functional keeps its sign.
pub(super) fn cell_table(proof: &RingProof) -> Block {
    cell_table_of(proof, "g")
}

pub(super) fn cell_table_of(proof: &RingProof, letter: &str) -> Block {
    let several = proof.functionals.len() > 1;
    let rows = proof.discharged.iter().take(MAX_CELLS).map(|d| {
        let (lo, hi) = bounds(&d.bound);
        let mut row = vec![code(word_text(&d.word)), formula(lo), formula(hi)];
        if several {
            row.insert(
                1,
                formula(Math::parse(&format!("{letter}_@"), &mut std::iter::once(Math::count(d.functional + 1)))),
            );
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
        format!(" (the first {shown} of {})", count(proof.discharged.len(), "cell"))
    } else {
        String::new()
    };
    let summary =
        line(&format!("{what} on the discharged words, cells that cover the ring; bounds rounded outwards{all}:"), []);
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
