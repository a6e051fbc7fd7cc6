//! The statement that applies to a cycle: its hypotheses one by one, the functional, the rays, and what follows.

use super::super::document::{Block, Check, Inline, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::values::{decimal_math, elem_math, polynomial, root_math};
use super::super::words::{cell, count, holder, listed, rate, witness};
use super::Quoted;
use crate::algebraic::Elem;
use crate::arith::{Interval, Rational};
use crate::case::Case;
use crate::jordan::{Chain, Factor, Spectrum};
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
            let mut blocks = vec![seen.once(*statement)];
            blocks.extend(line_blocks(case, branch, *statement, seen));
            blocks
        }
        Outcome::AtLeast { statement, .. } => {
            let mut blocks = vec![seen.once(*statement)];
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
                blocks.extend(seen.once_id(Statement::Corollary));
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
            conclusion.extend(words("; local Hölder exponent: "));
            conclusion.extend(holder(exponent));
        }
    }
    conclusion.extend(words("."));
    blocks.push(Block::Paragraph(conclusion));
    blocks
}

/// `the functional $k$ below`, `one of the functionals $k_i$ below`.
pub(super) fn one_of(letter: char, proof: &RingProof) -> String {
    if proof.functionals.len() == 1 {
        format!("the functional ${letter}$ below")
    } else {
        format!("one of the functionals ${letter}_i$ below")
    }
}

/// `3 cells cover $K$, and on each of them`.
pub(super) fn on_cells(number: usize) -> String {
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
        blocks.push(Block::Paragraph(chain_line(&chain.vectors)));
    }
    blocks.push(functional_block("The left functional is", functional, branch));
    let last = &chain.vectors[block - 1];
    let pairing = functional.iter().zip(last).fold(Elem::zero(), |s, (a, b)| s.add(&a.mul(b, &factor.poly)));
    blocks.push(if block == 1 {
        Block::text("Since $g(v)=@$, the component of $x$ along $v$ is $c(x)=g(x)/g(v)$.", [elem_math(&pairing)])
    } else {
        let values = [Math::count(block), elem_math(&pairing), Math::count(block - 1)];
        Block::text(
            "On the last vector $w_@$ of the chain $g$ has the value $g_0=@$, so that the leading coefficient is $u(x)=c(x) v$ with \
             $c(x)=λ^{-@} g(x)/g_0$.",
            values,
        )
    });
    blocks
}

/// The generalised eigenvectors `w_2, w_3, …` above the eigenvector `v` of a chain.
fn chain_line(chain: &[Vec<Elem>]) -> Line {
    let mut out = line("It ends a Jordan chain of length $@$: $(L-λ)w_2=v$", [Math::count(chain.len())]);
    for k in 3..=chain.len() {
        out.extend(line("$, (L-λ)w_@=w_@$", [Math::count(k), Math::count(k - 1)]));
    }
    out.extend(words(" with "));
    for (k, vector) in chain.iter().enumerate().skip(1) {
        let comma = if k > 1 { "$, w_@=@$" } else { "$w_@=@$" };
        out.extend(line(comma, [Math::count(k + 1), elems(vector)]));
    }
    out.extend(words("."));
    out
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
    let mut blocks: Vec<Block> = seen.once_id(Statement::Rays).into_iter().collect();
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
    top.extend(names(&branch.spectrum, eigenvalues));
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
            "The branch is isolated: {} {}, whose common zeros are the generalised kernel of $L$, has a constant sign.",
            on_cells(proof.discharged.len()),
            one_of('k', proof)
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
    blocks.extend(eigenvector_blocks(&branch.spectrum, eigenvalues, block));
    if found.is_some() {
        blocks.extend(witness_blocks(case, branch, factor, r, block));
    }
    if let Some(proof) = isolation {
        blocks.push(Block::text("The functionals that show that the branch is isolated:", []));
        blocks.push(functional_list("k", &proof.functionals, &branch.chart));
        blocks.push(cell_table_of(proof, "k"));
    }
    if let Some(Witness::Crossing { cover, .. }) = found {
        blocks.push(Block::text(
            "For the witness: $c_2$ reads the coefficient of the second vector of the chain and $c_1$ that of the first one where $c_2=0$, \
             up to one positive factor; below they are $h_1$ and $h_2$.",
            [],
        ));
        blocks.push(functional_list("h", &cover.functionals, &branch.chart));
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
        (Statement::Theorem4Sign, _) => {
            "on that connected part the coefficient of $v_1$ in $L^m x$ has a zero for every large $m$; the directions of these points accumulate off the line \
             $U$, where the map to the point loses none of them, so that"
        }
        (_, Some(Witness::SignChange { .. })) => {
            "$g$ has a zero on that connected part; the orbit of such a point stays in $F_1$ and is never 0, so that its limit directions lie in $F_1$, \
             outside the line $U⊂D^*$, and"
        }
        _ => {
            "the orbit of the witness stays in $F_1$ and is never 0, so that its limit directions lie in $F_1$, outside the line $U⊂D^*$, and"
        }
    };
    line(
        &format!("**Conclusion.** There is no tangent line on this branch: {reason} $\\dim D^*≥@$."),
        [Math::count(dimension)],
    )
}

/// The different eigenvalues, once each.
pub(super) fn names(spectrum: &Spectrum, eigenvalues: &[(usize, usize)]) -> Line {
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
        out.push(Inline::Math(root_math(&spectrum.factors[f].roots[r])));
        if times > 1 {
            out.extend(words(format!(" ({times} blocks)")));
        }
        shown.push((f, r));
    }
    out
}

/// The eigenvectors that span `U`, by irreducible factor.
pub(super) fn eigenvector_blocks(spectrum: &Spectrum, eigenvalues: &[(usize, usize)], block: usize) -> Vec<Block> {
    let mut done: Vec<usize> = Vec::new();
    let mut blocks = Vec::new();
    for &(f, r) in eigenvalues {
        if done.contains(&f) {
            continue;
        }
        done.push(f);
        let factor = &spectrum.factors[f];
        for chain in factor.right.iter().filter(|c| c.vectors.len() == block) {
            let root = &factor.roots[r];
            let mut values = vec![root_math(root)];
            let of = if root.rational().is_none() {
                values.push(polynomial(&factor.poly, 'x'));
                ", a root of $@$"
            } else {
                ""
            };
            values.push(elems(&chain.vectors[0]));
            let plane = if root.is_real() { "" } else { "; its real and imaginary parts span a plane" };
            let text = format!("An eigenvector for $λ=@${of}, in the coordinates of $L$, is $@${plane}.");
            blocks.push(Block::text(&text, values));
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

/// Functionals on points `x`, each with its number.
pub(super) fn functional_list(letter: &str, functionals: &[Functional], chart: &Matrix) -> Block {
    let item = |(k, f): (usize, &Functional)| {
        let name = if functionals.len() == 1 { letter.to_owned() } else { format!("{letter}_@") };
        let complex = f.root.as_ref().is_some_and(|r| !r.is_real());
        let part = match (f.part, complex) {
            (Part::Imaginary, _) => " is the imaginary part of ",
            (Part::Real, true) => " is the real part of ",
            (Part::Real, false) => "",
        };
        let row = elems(&row_on_points(&f.row, chart));
        let mut values = vec![row];
        if functionals.len() > 1 {
            values.insert(0, Math::count(k + 1));
        }
        let mut out = if part.is_empty() {
            line(&format!("${name}(x)=@·(x-q)$"), values)
        } else {
            line(&format!("${name}(x)${part}$@·(x-q)$"), values)
        };
        if let Some(root) = f.root.as_ref().filter(|r| r.rational().is_none()) {
            out.extend(line(", $λ=@$", [root_math(root)]));
        }
        out
    };
    Block::List(functionals.iter().enumerate().map(item).collect())
}

/// The cells on which a functional keeps its sign.
fn cell_table(proof: &RingProof) -> Block {
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
    let what = if several { "The values of one functional".to_owned() } else { format!("The values of ${letter}$") };
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
