//! From what stars begin: a face, or the faces of a set, glued along sides on which they have the same points (theory §11.1).

use super::edges::diagonal;
use super::place::Chart;
use super::stars::Star;
use crate::arith::Rational;
use crate::linalg::{Matrix, closures};
use crate::shape::{Address, CellKind, Complex};

/// A side of a cell of the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Side {
    cell: usize,
    side: usize,
}

/// Two sides that have the same points; the second one is followed from its end where it is turned.
struct Seam {
    first: Side,
    second: Side,
    turned: bool,
}

/// The start as cells with nodes: a face alone; of a set its pieces, all of them faces. Cells have nodes in common along sides on which
/// they have the same points. `None` for other starts, and where sides do not make up a surface.
pub(super) fn start(complex: &Complex, chart: &Chart) -> Option<Star> {
    let shape = &complex.shape;
    if shape.states[shape.start].kind == CellKind::Face {
        let corners = (0..chart.corners(shape.start).len()).collect();
        return Some(Star { cells: vec![(shape.start, corners)] });
    }
    let pieces = &shape.states[shape.start].pieces;
    if pieces.is_empty() || pieces.iter().any(|p| !complex.faces.contains_key(&p.target)) {
        return None;
    }
    let mut star = Star { cells: Vec::new() };
    let mut next = 0;
    for piece in pieces {
        let width = chart.corners(piece.target).len();
        star.cells.push((piece.target, (next..next + width).collect()));
        next += width;
    }
    let points = corner_points(complex, chart, &star)?;
    let seams = seams(complex, chart, &star, &points);
    for seam in &seams {
        for k in 0..2 {
            let x = ends(chart, &star, seam.first, false)[k];
            let y = ends(chart, &star, seam.second, seam.turned)[k];
            let corners = star.cells.iter_mut().flat_map(|c| &mut c.1);
            corners.filter(|n| **n == x.max(y)).for_each(|n| *n = x.min(y));
        }
    }
    (is_surface(chart, &star, &seams) && touches_along_seams(&star, &points)).then(|| renumbered(star))
}

/// The points of the corners of all cells; `None` where a corner has none.
fn corner_points(complex: &Complex, chart: &Chart, star: &Star) -> Option<Vec<Vec<Vec<Rational>>>> {
    let shape = &complex.shape;
    let of = |(cell, (state, _)): (usize, &(usize, Vec<usize>))| {
        let op = &shape.states[shape.start].pieces[cell].op;
        let point = |corner| Some(op.apply(&shape.point(*state, chart.addresses(*state, corner)?.first()?)?));
        chart.corners(*state).iter().map(point).collect::<Option<Vec<Vec<Rational>>>>()
    };
    star.cells.iter().enumerate().map(of).collect()
}

/// Whether corners at one point are one node.
fn touches_along_seams(star: &Star, points: &[Vec<Vec<Rational>>]) -> bool {
    let all = star.cells.iter().zip(points).flat_map(|((_, nodes), points)| nodes.iter().zip(points));
    all.clone().all(|(node, point)| all.clone().all(|(n, p)| p != point || n == node))
}

/// The nodes at the ends of a side, in its direction or against it.
fn ends(chart: &Chart, star: &Star, at: Side, turned: bool) -> [usize; 2] {
    let (state, corners) = &star.cells[at.cell];
    let (from, to) = chart.layout(*state).sides()[at.side];
    if turned { [corners[to], corners[from]] } else { [corners[from], corners[to]] }
}

/// The sides of all cells.
fn sides(chart: &Chart, star: &Star) -> Vec<Side> {
    let of = |(cell, (state, _)): (usize, &(usize, Vec<usize>))| {
        (0..chart.layout(*state).sides().len()).map(move |side| Side { cell, side })
    };
    star.cells.iter().enumerate().flat_map(of).collect()
}

/// All sides of different cells that have the same points.
fn seams(complex: &Complex, chart: &Chart, star: &Star, points: &[Vec<Vec<Rational>>]) -> Vec<Seam> {
    let tips = |at: Side, turned: bool| {
        let (from, to) = chart.layout(star.cells[at.cell].0).sides()[at.side];
        let own = &points[at.cell];
        if turned { [&own[to], &own[from]] } else { [&own[from], &own[to]] }
    };
    let all = sides(chart, star);
    let mut found = Vec::new();
    for &first in &all {
        for &second in all.iter().filter(|s| s.cell > first.cell) {
            for turned in [false, true] {
                crate::stop::check();
                let seam = Seam { first, second, turned };
                if tips(first, false) == tips(second, turned) && fits(complex, star, &seam) {
                    found.push(seam);
                }
            }
        }
    }
    found
}

/// Whether the points of two sides are the same: on the span of those at both sides, which is the closure of those at one place.
fn fits(complex: &Complex, star: &Star, seam: &Seam) -> bool {
    let shape = &complex.shape;
    let side = |at: Side| {
        let side = &complex.faces[&star.cells[at.cell].0].sides[at.side];
        (side.edge, &shape.states[shape.start].pieces[at.cell].op * &side.op)
    };
    let ((first, there), (second, here)) = (side(seam.first), side(seam.second));
    let jump = there.beside(&here.scale(&Rational::from(-1)));
    along(complex, (first, second, seam.turned)).is_some_and(|span| (&span * &jump.transpose()).is_zero())
}

/// Two edges, and whether the second one is followed from its end.
type Pair = (usize, usize, bool);

/// The span of the points of two edges at the same places, those of both one after the other, as rows; `None` where they are divided
/// differently.
fn along(complex: &Complex, start: Pair) -> Option<Matrix> {
    let shape = &complex.shape;
    let mut pairs = vec![start];
    // By pair: the letters of both, and their pair.
    let mut steps: Vec<Vec<([usize; 2], usize)>> = Vec::new();
    while steps.len() < pairs.len() {
        let (first, second, turned) = pairs[steps.len()];
        let (a, b) = (&shape.states[first].pieces, &shape.states[second].pieces);
        if a.is_empty() || a.len() != b.len() || a.iter().chain(b).any(|p| p.share.is_some()) {
            return None;
        }
        let mut own = Vec::new();
        for (k, piece) in a.iter().enumerate() {
            let l = if turned { b.len() - 1 - k } else { k };
            let pair = (piece.target, b[l].target, turned ^ piece.reversed ^ b[l].reversed);
            own.push(([k, l], index(&mut pairs, pair)));
        }
        steps.push(own);
    }
    let mut spaces = Vec::new();
    let mut arrows = Vec::new();
    for (from, own) in steps.iter().enumerate() {
        let row = one_point(complex, &pairs, &steps, from)?;
        spaces.push(Matrix::from_rows(row.len(), vec![row]));
        for &([k, l], to) in own {
            let (a, b) = (&shape.states[pairs[from].0].pieces[k].op, &shape.states[pairs[from].1].pieces[l].op);
            arrows.push((to, from, diagonal(a, b).transpose()));
        }
    }
    closures(spaces, &arrows).into_iter().next()
}

/// The place of an item in a list, at whose end it is put if it is new.
fn index<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    match list.iter().position(|x| *x == item) {
        Some(known) => known,
        None => {
            list.push(item);
            list.len() - 1
        }
    }
}

/// The points of both edges of a pair at one place: along the first parts, until a pair comes back.
fn one_point(
    complex: &Complex,
    pairs: &[Pair],
    steps: &[Vec<([usize; 2], usize)>],
    start: usize,
) -> Option<Vec<Rational>> {
    let (mut seen, mut letters) = (vec![start], Vec::new());
    loop {
        let &(both, next) = steps[*seen.last()?].first()?;
        letters.push(both);
        if let Some(k) = seen.iter().position(|p| *p == next) {
            let word = |side: usize| letters.iter().map(|l| l[side]).collect::<Vec<usize>>();
            let point = |state: usize, word: &[usize]| {
                complex.shape.point(state, &Address { prefix: word[..k].to_vec(), cycle: word[k..].to_vec() })
            };
            return Some([point(pairs[start].0, &word(0))?, point(pairs[start].1, &word(1))?].concat());
        }
        seen.push(next);
    }
}

/// Whether the corners of each cell are different nodes, no two cells have all nodes in common, and sides with the same ends are seams,
/// at most two of them in one place.
fn is_surface(chart: &Chart, star: &Star, seams: &[Seam]) -> bool {
    let distinct = |nodes: &[usize]| (0..nodes.len()).all(|k| !nodes[..k].contains(&nodes[k]));
    let apart = |k: usize| (0..k).all(|l| star.cells[k].1.iter().any(|n| !star.cells[l].1.contains(n)));
    let cells = (0..star.cells.len()).all(|k| distinct(&star.cells[k].1) && apart(k));
    let all = sides(chart, star);
    let place = |at: Side| {
        let [a, b] = ends(chart, star, at, false);
        [a.min(b), a.max(b)]
    };
    cells
        && all.iter().enumerate().all(|(k, &here)| {
            let same: Vec<Side> = all[..k].iter().copied().filter(|&s| place(s) == place(here)).collect();
            same.len() < 2 && same.iter().all(|&s| seams.iter().any(|m| m.first == s && m.second == here))
        })
}

/// The same star with its nodes numbered in the order of the corners.
fn renumbered(mut star: Star) -> Star {
    let mut known: Vec<usize> = Vec::new();
    for node in star.cells.iter_mut().flat_map(|c| &mut c.1) {
        *node = index(&mut known, *node);
    }
    star
}
