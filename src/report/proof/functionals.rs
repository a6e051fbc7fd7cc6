//! Functionals, eigenvectors and cells as the reports print them.

use super::super::document::{Block, Inline, Line, Table, code, formula, line, words};
use super::super::math::Math;
use super::super::reported::Reported;
use super::super::values::{lambda_math, outward, polynomial, root_math};
use super::super::words::count;
use crate::algebraic::{Elem, Root};
use crate::jordan::{Chain, Eigenvalue, Over, Part as Factor, Spectral};
use crate::linalg::Matrix;
use crate::shape::word_text;
use crate::theorem::{BranchReport, Functional, Part, RingProof};

/// Most cells that are listed of a ring condition.
const MAX_CELLS: usize = 400;

/// A vector over the field of an eigenvalue as a row, at the place of the generator of the field.
pub(super) fn elems<E: Reported>(v: &[Elem], place: &Root) -> Math {
    Math::tuple(v.iter().map(|x| E::element(x, place)).collect())
}

/// What belongs to an eigenvalue: its factor, the number, and the place of the generator of its field.
pub(super) fn eigen<S: Spectral>(spectrum: &S, (f, r): (usize, usize)) -> (Factor<'_>, &Root, &Root) {
    let factor = spectrum.part(f);
    (factor, &factor.roots[r], &factor.places[r])
}

/// The functional on points: its row on `x − q`.
fn row_on_points<E: Reported>(functional: &[Elem], chart: &Matrix<E>, over: Over<'_>) -> Vec<Elem> {
    (0..chart.cols())
        .map(|j| {
            functional.iter().enumerate().fold(Elem::zero(), |sum, (k, f)| {
                let c = &chart[(k, j)];
                if c.is_zero() { sum } else { sum.add(&c.scaled(f, over)) }
            })
        })
        .collect()
}

pub(super) fn chain_of(chains: &[Chain], block: usize) -> Option<&Chain> {
    chains.iter().find(|c| c.vectors.len() == block)
}

/// `g(x) = …` in both coordinates, after some words.
pub(super) fn functional_block<E: Reported>(
    before: &str,
    functional: &[Elem],
    branch: &BranchReport<E>,
    eigenvalue: (usize, usize),
) -> Block {
    let (factor, _, place) = eigen(&branch.spectrum, eigenvalue);
    let on_points = row_on_points(functional, &branch.chart, factor.over);
    let template = format!("{before} $g(x)=@·C(x-q)=@·(x-q)$.");
    Block::text(&template, [elems::<E>(functional, place), elems::<E>(&on_points, place)])
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

/// The different eigenvalues, once each.
pub(super) fn names<S: Spectral>(spectrum: &S, eigenvalues: &[(usize, usize)]) -> Line {
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
        out.push(Inline::Math(root_math(spectrum.value(Eigenvalue { factor: f, root: r }))));
        if times > 1 {
            out.extend(words(format!(" ({times} blocks)")));
        }
        shown.push((f, r));
    }
    out
}

/// The eigenvectors that span `U`, by irreducible factor.
pub(super) fn eigenvector_blocks<E: Reported>(
    spectrum: &E::Spectrum,
    eigenvalues: &[(usize, usize)],
    block: usize,
) -> Vec<Block> {
    let mut done: Vec<usize> = Vec::new();
    let mut blocks = Vec::new();
    for &(f, r) in eigenvalues {
        if done.contains(&f) {
            continue;
        }
        done.push(f);
        let (factor, root, place) = eigen(spectrum, (f, r));
        for chain in factor.right.iter().filter(|c| c.vectors.len() == block) {
            let mut values = vec![lambda_math(root)];
            let of = if root.rational().is_none() {
                values.push(polynomial(factor.minpoly, 'x'));
                ", a root of $@$"
            } else {
                ""
            };
            values.push(elems::<E>(&chain.vectors[0], place));
            let plane = if root.is_real() { "" } else { "; its real and imaginary parts span a plane" };
            let text = format!("An eigenvector for $@${of}, in the coordinates of $L$, is $@${plane}.");
            let mut text = line(&text, values);
            if factor.over.alpha.is_some() {
                text.extend(E::letters(factor, place, &chain.vectors[0].iter().collect::<Vec<_>>()));
            }
            blocks.push(Block::Paragraph(text));
        }
    }
    blocks
}

/// Functionals on points `x`, each with its number.
pub(super) fn functional_list<E: Reported>(letter: &str, functionals: &[Functional], chart: &Matrix<E>) -> Block {
    let item = |(k, f): (usize, &Functional)| {
        let name = if functionals.len() == 1 { letter.to_owned() } else { format!("{letter}_@") };
        let complex = f.root.as_ref().is_some_and(|r| !r.is_real());
        let part = match (f.part, complex) {
            (Part::Imaginary, _) => " is the imaginary part of ",
            (Part::Real, true) => " is the real part of ",
            (Part::Real, false) => "",
        };
        let mut values = vec![on_points(f, chart)];
        if functionals.len() > 1 {
            values.insert(0, Math::count(k + 1));
        }
        let mut out = if part.is_empty() {
            line(&format!("${name}(x)=@·(x-q)$"), values)
        } else {
            line(&format!("${name}(x)${part}$@·(x-q)$"), values)
        };
        if let Some(root) = f.root.as_ref().filter(|r| r.rational().is_none()) {
            out.extend(E::place_line(root));
        }
        out
    };
    Block::List(functionals.iter().enumerate().map(item).collect())
}

/// The row of a functional on `x − q`.
fn on_points<E: Reported>(f: &Functional, chart: &Matrix<E>) -> Math {
    match &f.root {
        Some(root) => {
            let over = Over { modulus: root.minpoly(), alpha: f.alpha.as_ref() };
            elems::<E>(&row_on_points(&f.row, chart, over), root)
        }
        None => {
            // Without a root the entries are rational.
            let rational = |x: &Elem| x.is_rational().map_or_else(E::zero, |q| E::of(&q));
            let row: Vec<E> = f.row.iter().map(rational).collect();
            super::super::reported::vector(&E::apply_left(&row, chart))
        }
    }
}

/// The cells on which the functionals keep their signs.
pub(super) fn cell_table(proof: &RingProof, letter: &str) -> Block {
    let several = proof.functionals.len() > 1;
    let rows = proof.discharged.iter().take(MAX_CELLS).map(|d| {
        let (lo, hi) = outward(&d.bound);
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
    let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() }.beside());
    let shown = proof.discharged.len().min(MAX_CELLS);
    let what = if several { "The values of one functional".to_owned() } else { format!("The values of ${letter}$") };
    let all = if shown < proof.discharged.len() {
        format!(" (the first {shown} of {}, the certificate has all)", count(proof.discharged.len(), "cell"))
    } else {
        String::new()
    };
    let summary =
        line(&format!("{what} on the discharged words, cells that cover the ring; bounds rounded outwards{all}:"), []);
    Block::Details { summary, blocks: vec![table] }
}
