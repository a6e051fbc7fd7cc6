//! Stars: the cells around the nodes of a divided patch, and the stars in which the neighbours among their parts lie (theory §11.1).

use super::place::{Chart, Param};
use crate::arith::Rational;
use crate::shape::{Layout, Shape};

/// Most stars of a patch.
const MAX_STARS: usize = 40;
/// Most cells of a star.
const MAX_CELLS: usize = 12;

/// Cells that meet in nodes and along sides.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Star {
    /// The state of each cell, and the nodes at its corners.
    pub cells: Vec<(usize, Vec<usize>)>,
}

/// Parts of a star that make a star.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Child {
    /// Its index.
    pub star: usize,
    /// For each of its cells the cell of the divided star, and the letter of the piece.
    pub cells: Vec<[usize; 2]>,
}

/// The start, number 0, and all stars into which it and they are divided: parts that have a node in common lie in one child.
#[derive(Debug, Clone)]
pub struct Stars {
    /// The stars.
    pub list: Vec<Star>,
    /// The children of each.
    pub children: Vec<Vec<Child>>,
}

/// A piece of a cell.
pub(super) struct Part {
    /// The cell and the letter.
    pub from: [usize; 2],
    pub state: usize,
    pub nodes: Vec<usize>,
}

impl Part {
    pub fn meets(&self, other: &Self) -> bool {
        self.nodes.iter().any(|n| other.nodes.contains(n))
    }
}

impl Stars {
    /// `None` where there are too many, or parts around a node are not linked by sides.
    pub fn of(shape: &Shape, chart: &Chart, start: Star) -> Option<Self> {
        let mut stars = Self { list: vec![start], children: Vec::new() };
        while stars.children.len() < stars.list.len() {
            crate::stop::check();
            let parts = parts(shape, chart, &stars.list[stars.children.len()]);
            let mut own = Vec::new();
            for set in around_nodes(&parts) {
                let chosen: Vec<&Part> = set.iter().map(|&k| &parts[k]).collect();
                let (star, order) = (0..chosen.len()).filter_map(|first| arranged(chart, &chosen, first)).min()?;
                let cells = order.iter().map(|&k| chosen[k].from).collect();
                own.push(Child { star: stars.index(star)?, cells });
            }
            stars.children.push(own);
        }
        Some(stars)
    }

    /// The cells of a star as words from the start, where it first occurs.
    pub(super) fn words(&self, shape: &Shape, star: usize) -> Vec<Vec<usize>> {
        let alone = |(k, (e, _)): (usize, &(usize, Vec<usize>))| if *e == shape.start { Vec::new() } else { vec![k] };
        let mut found: Vec<Option<Vec<Vec<usize>>>> = vec![None; self.list.len()];
        found[0] = Some(self.list[0].cells.iter().enumerate().map(alone).collect());
        // A star is listed after one of which it is a child.
        for (s, child) in self.arrows() {
            if let (None, Some(own)) = (&found[child.star], &found[s]) {
                let word = |&[cell, letter]: &[usize; 2]| [own[cell].as_slice(), &[letter]].concat();
                found[child.star] = Some(child.cells.iter().map(word).collect());
            }
        }
        found.swap_remove(star).into_iter().flatten().collect()
    }

    /// Along how many sides the cells of the start are glued.
    #[must_use]
    pub fn seams(&self) -> usize {
        let ends = |(_, nodes): &(usize, Vec<usize>)| {
            let next = nodes.iter().cycle().skip(1);
            nodes.iter().zip(next).map(|(a, b)| [*a.min(b), *a.max(b)]).collect::<Vec<_>>()
        };
        let all: Vec<[usize; 2]> = self.list.first().iter().flat_map(|s| s.cells.iter().flat_map(ends)).collect();
        (0..all.len()).filter(|&k| all[..k].contains(&all[k])).count()
    }

    fn index(&mut self, star: Star) -> Option<usize> {
        // The start itself is no star.
        if let Some(known) = self.list.iter().skip(1).position(|s| *s == star) {
            return Some(known + 1);
        }
        if self.list.len() > MAX_STARS || star.cells.len() > MAX_CELLS {
            return None;
        }
        self.list.push(star);
        Some(self.list.len() - 1)
    }

    /// All transitions: star, child, and the star of the child.
    pub fn arrows(&self) -> impl Iterator<Item = (usize, &Child)> {
        self.children.iter().enumerate().flat_map(|(s, own)| own.iter().map(move |child| (s, child)))
    }
}

/// The pieces of all cells of a star. A node is known by its weights among the corners of the cell, which are the same from both
/// sides of a side.
pub(super) fn parts(shape: &Shape, chart: &Chart, star: &Star) -> Vec<Part> {
    let mut nodes: Vec<Vec<(usize, Rational)>> = Vec::new();
    let mut number = |node: Vec<(usize, Rational)>| match nodes.iter().position(|n| *n == node) {
        Some(known) => known,
        None => {
            nodes.push(node);
            nodes.len() - 1
        }
    };
    let mut parts = Vec::new();
    for (cell, (state, corners)) in star.cells.iter().enumerate() {
        let layout = chart.layout(*state);
        for (letter, piece) in shape.states[*state].pieces.iter().enumerate() {
            let node = |at: &Param| {
                let mut weighted: Vec<_> = corners.iter().copied().zip(weights(layout, at)).collect();
                weighted.retain(|(_, w)| *w != 0);
                weighted.sort();
                weighted
            };
            let nodes = chart.piece_corners(*state, letter).iter().map(|at| number(node(at))).collect();
            parts.push(Part { from: [cell, letter], state: piece.target, nodes });
        }
    }
    parts
}

/// The weights of the corners of a patch at a parameter.
fn weights(layout: Layout, [u, v]: &Param) -> Vec<Rational> {
    let one = Rational::from(1);
    match layout {
        Layout::Quad { .. } => {
            let (x, y) = (&one - u, &one - v);
            vec![&x * &y, u * &y, u * v, x * v]
        }
        Layout::Triangle => vec![one - u - v, u.clone(), v.clone()],
    }
}

/// The sets of parts around a node, without those that lie in another one.
fn around_nodes(parts: &[Part]) -> Vec<Vec<usize>> {
    let count = parts.iter().flat_map(|p| &p.nodes).max().map_or(0, |n| n + 1);
    let at = |node: usize| (0..parts.len()).filter(|&k| parts[k].nodes.contains(&node)).collect::<Vec<_>>();
    let sets: Vec<Vec<usize>> = (0..count).map(at).collect();
    let inside = |a: &Vec<usize>, b: &Vec<usize>| a.iter().all(|k| b.contains(k));
    let needed = |&k: &usize| {
        let other = |l: usize| l != k && inside(&sets[k], &sets[l]) && (l < k || !inside(&sets[l], &sets[k]));
        !(0..sets.len()).any(other)
    };
    (0..sets.len()).filter(needed).map(|k| sets[k].clone()).collect()
}

/// The parts in the order in which they are reached across sides from one of them, as a star with its own numbers of nodes.
fn arranged(chart: &Chart, parts: &[&Part], first: usize) -> Option<(Star, Vec<usize>)> {
    let mut order = vec![first];
    let mut at = 0;
    while at < order.len() {
        let part = parts[order[at]];
        for &(a, b) in chart.layout(part.state).sides() {
            let ends = [part.nodes[a], part.nodes[b]];
            let across = |k: &usize| !order.contains(k) && ends.iter().all(|n| parts[*k].nodes.contains(n));
            let next = (0..parts.len()).find(across);
            order.extend(next);
        }
        at += 1;
    }
    if order.len() < parts.len() {
        return None;
    }
    let mut known: Vec<usize> = Vec::new();
    let mut number = |node: &usize| match known.iter().position(|n| n == node) {
        Some(k) => k,
        None => {
            known.push(*node);
            known.len() - 1
        }
    };
    let cells = order.iter().map(|&k| (parts[k].state, parts[k].nodes.iter().map(&mut number).collect())).collect();
    Some((Star { cells }, order))
}

#[cfg(test)]
mod tests {
    use super::super::glue::start;
    use super::*;
    use crate::scheme::{mesh_rule, patch};

    fn stars(rule: &str, valence: usize) -> Stars {
        let complex = patch(&mesh_rule(rule, &[].into()).unwrap(), valence).unwrap();
        let chart = Chart::new(&complex).unwrap();
        Stars::of(&complex.shape, &chart, start(&complex, &chart).unwrap()).unwrap()
    }

    /// Two by two cells with nine children; at an extraordinary vertex one of them has it at its outer corner.
    #[test]
    fn stars_of_quadrangles() {
        let regular = stars("catmull-clark", 4);
        assert_eq!(regular.list.iter().map(|s| s.cells.len()).collect::<Vec<_>>(), [1, 4]);
        assert_eq!(regular.children.iter().map(Vec::len).collect::<Vec<_>>(), [1, 9]);
        let irregular = stars("catmull-clark", 5);
        assert_eq!(irregular.children.iter().map(Vec::len).collect::<Vec<_>>(), [1, 9, 9]);
        let own = irregular.children[1].iter().filter(|c| c.star == 1).count();
        assert_eq!((own, irregular.children[2].iter().all(|c| c.star == 2)), (1, true));
    }

    /// Parts of triangles that meet at the border only need stars of their own.
    #[test]
    fn all_parts_that_meet_lie_in_one_child() {
        for (rule, valence) in [("loop", 6), ("loop", 3), ("doo-sabin", 3)] {
            let complex = patch(&mesh_rule(rule, &[].into()).unwrap(), valence).unwrap();
            let chart = Chart::new(&complex).unwrap();
            let stars = Stars::of(&complex.shape, &chart, start(&complex, &chart).unwrap()).unwrap();
            for (star, children) in stars.list.iter().zip(&stars.children) {
                let parts = parts(&complex.shape, &chart, star);
                for a in &parts {
                    for b in parts.iter().filter(|b| a.meets(b)) {
                        let both = |c: &Child| c.cells.contains(&a.from) && c.cells.contains(&b.from);
                        assert!(children.iter().any(both), "{rule} {valence}");
                    }
                }
                for child in children {
                    let states: Vec<usize> = stars.list[child.star].cells.iter().map(|c| c.0).collect();
                    let of = |from: &[usize; 2]| parts.iter().find(|p| p.from == *from).unwrap().state;
                    assert_eq!(states, child.cells.iter().map(of).collect::<Vec<_>>());
                }
            }
        }
    }
}
