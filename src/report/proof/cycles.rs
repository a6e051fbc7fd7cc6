//! One section for each different cycle: operator, spectrum, ring, and the statement that applies.

use super::super::document::{Block, Inline, Line, Table, formula, line, words};
use super::super::math::Math;
use super::super::values::{polynomial, root_math};
use super::super::words::listed;
use super::{Quoted, matrix, scheme, statements};
use crate::case::Case;
use crate::jordan::Spectral;
use crate::linalg::Matrix;
use crate::report::figures;
use crate::report::reported::{Reported, vector};
use crate::report::values::decimal_math;
use crate::shape::{Spaces, word_text};
use crate::statement::Statement;
use crate::theorem::{BranchReport, Certified};

/// One branch for each different analysis.
pub(super) fn distinct<E: Reported>(found: &Certified<E>) -> Vec<&BranchReport<E>> {
    let mut out: Vec<&BranchReport<E>> = Vec::new();
    for branch in found.points.iter().flat_map(|p| &p.branches) {
        if index_of(&out, branch).is_none() {
            out.push(branch);
        }
    }
    out
}

/// Which of the listed analyses is that of a branch.
pub(super) fn index_of<E: Reported>(listed: &[&BranchReport<E>], branch: &BranchReport<E>) -> Option<usize> {
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
pub(super) fn name<E: Reported>(case: &Case<E>, branch: &BranchReport<E>, k: usize) -> String {
    let state = if case.shape.states.len() > 1 {
        format!(" at state {}", case.shape.states[branch.state].name)
    } else {
        String::new()
    };
    let quotient = if branch.linear.rows() < branch.relevant {
        format!(", in a quotient of dimension {}", branch.linear.rows())
    } else {
        String::new()
    };
    format!("Cycle {}: ({}){state}{quotient}", k + 1, word_text(&branch.address.cycle))
}

pub(super) fn section<E: Reported>(
    case: &Case<E>,
    spaces: &Spaces<E>,
    branch: &BranchReport<E>,
    k: usize,
    seen: &mut Quoted,
) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(3, words(name(case, branch, k)))];
    blocks.extend(cycle_operator(case, branch.state, &branch.address.cycle, &branch.cycle_operator));
    blocks.push(Block::text("The fixed point is $q=@$: $M q=q$, with the coordinate sum 1.", [vector(&branch.fixed)]));
    blocks.extend(space_blocks(spaces, branch));
    if branch.linear.rows() > 0 {
        let on = if branch.linear.rows() < branch.relevant { "$Y$" } else { "$V$" };
        blocks.push(Block::text(&format!("In these coordinates $M$ acts on {on} by"), []));
        blocks.push(matrix(Math::Letter('L'), &branch.linear));
        blocks.extend(spectrum_blocks::<E>(&branch.spectrum));
        blocks.extend(figures::spectrum(&branch.spectrum));
        blocks.extend(ring_blocks(branch, seen));
    }
    blocks.extend(statements::blocks(case, branch, seen));
    blocks
}

/// `M` as a product of operators, with its entries unless it is one of them.
pub(super) fn cycle_operator<E: Reported>(case: &Case<E>, state: usize, cycle: &[usize], m: &Matrix<E>) -> Vec<Block> {
    let shape = &case.shape;
    let mut at = state;
    let mut factors = Vec::new();
    for &letter in cycle {
        let of = (shape.states.len() > 1).then(|| shape.states[at].name.as_str());
        factors.push(scheme::operator(letter, of));
        at = shape.states[at].pieces[letter].target;
    }
    if let [only] = factors.as_slice() {
        return vec![Block::text("The cycle has the operator $M=@$.", [only.clone()])];
    }
    let short = factors.len() <= MAX_FACTORS;
    let product = if short { Math::Row(factors) } else { Math::of("T_w") };
    let text = if short { "The cycle has the operator" } else { "The cycle $w$ has the operator" };
    vec![Block::text(text, []), matrix(Math::parse("M=@", &mut std::iter::once(product)), m)]
}

/// Most operators whose product is written out.
const MAX_FACTORS: usize = 8;

fn space_blocks<E: Reported>(spaces: &Spaces<E>, branch: &BranchReport<E>) -> Vec<Block> {
    let basis = &spaces.of(branch.state).basis;
    let mut blocks = Vec::new();
    if basis.cols() > 0 {
        let columns = (0..basis.cols()).map(|j| vector(&basis.column(j))).collect::<Vec<_>>();
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
            "The largest subspace $N_G$ of $V$ that is invariant under $L$ and killed on the way to the point (by the prefix and the control \
             points) is divided out; the quotient $Y=V/N_G$ has the dimension $@$ and takes the place of $V$ below, for the image germ (Transport \
             to the point).",
            [Math::count(seen)],
        ));
    }
    if seen > 0 {
        blocks.push(Block::text("Coordinates of a point $x$ of the attractor are $C(x-q)$ with", []));
        blocks.push(matrix(Math::Letter('C'), &branch.chart));
    }
    blocks
}

pub(super) fn spectrum_blocks<E: Reported>(spectrum: &E::Spectrum) -> Vec<Block> {
    let mut blocks = vec![Block::text(
        "The characteristic polynomial of $L$ is $χ(x)=@$. The eigenvalues by descending modulus:",
        [E::characteristic_math(spectrum)],
    )];
    let mut rows = Vec::new();
    for (k, class) in spectrum.classes().iter().enumerate() {
        for member in &class.members {
            let factor = spectrum.part(member.factor);
            let root = spectrum.value(*member);
            rows.push(vec![
                formula(Math::parse("ρ_@", &mut std::iter::once(Math::count(k + 1)))),
                formula(root_math(root)),
                formula(decimal_math(&root.modulus(60).mid(), 6)),
                formula(polynomial(factor.minpoly, 'x')),
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

fn ring_blocks<E: Reported>(branch: &BranchReport<E>, seen: &mut Quoted) -> Vec<Block> {
    // Lemma 2 is for maps that are not nilpotent; otherwise all pieces count.
    let nilpotent = branch.spectrum.classes().first().is_some_and(|c| branch.spectrum.value(c.members[0]).is_zero());
    let cells = |collapsing: bool| -> Vec<String> {
        let pieces = branch.ring.iter().filter(|p| (p.collapses && !nilpotent) == collapsing);
        pieces.map(|p| format!("`{}`", word_text(&p.word))).collect()
    };
    let (kept, dropped) = (cells(false), cells(true));
    let all: Vec<String> = branch.ring.iter().map(|p| format!("`{}`", word_text(&p.word))).collect();
    let consists = if all.is_empty() {
        "The ring $K$ is empty.".to_owned()
    } else {
        let noun = if all.len() == 1 { "the cell" } else { "the cells" };
        format!("The ring $K$ consists of {noun} {}.", listed(&all))
    };
    let mut blocks = vec![Block::text(&consists, [])];
    if !dropped.is_empty() {
        let mut text =
            format!("By Lemma 2 these cells, which fall into $q$ as a whole, are left out: {}.", listed(&dropped));
        text.push_str(if kept.is_empty() {
            " No cell is left in the ring."
        } else {
            " Below, $K$ and $X$ stand for the other cells."
        });
        blocks.extend(seen.once_id(Statement::Lemma2));
        blocks.push(Block::text(&text, []));
    }
    blocks
}
