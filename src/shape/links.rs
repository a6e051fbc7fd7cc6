//! Connected attractors: pieces that share points with known addresses (theory §7, Linked pieces).

use super::{Address, Shape};
use crate::linalg::Entry;
use std::collections::BTreeMap;

/// Pairs of addresses of one point, whose first letters join the pieces of a state to one another.
pub type StateLinks = Vec<(Address, Address)>;

/// Most pieces of a state whose points are compared.
const MAX_PIECES: usize = 12;
/// Most pieces for which points behind two letters are compared too.
const FEW_PIECES: usize = 5;

impl<E: Entry> Shape<E> {
    /// For `from` and every state that can be reached from it, in breadth-first order, pairs of addresses of one point that join
    /// all pieces of the state: then the attractor of `from` is connected. `None` where the points with short addresses do not
    /// join them.
    ///
    /// # Cost
    /// One fixed point for each pair of a piece and a piece of its target.
    #[must_use]
    pub fn links(&self, from: usize) -> Option<Vec<(usize, StateLinks)>> {
        let mut order = vec![from];
        let mut found = Vec::new();
        let mut next = 0;
        while next < order.len() {
            let e = order[next];
            found.push((e, self.links_of(e)?));
            for piece in &self.states[e].pieces {
                if !order.contains(&piece.target) {
                    order.push(piece.target);
                }
            }
            next += 1;
        }
        Some(found)
    }

    fn links_of(&self, e: usize) -> Option<StateLinks> {
        let pieces = &self.states[e].pieces;
        if pieces.len() > MAX_PIECES {
            return None;
        }
        // The part of each piece in what is joined already.
        let mut part: Vec<usize> = (0..pieces.len()).collect();
        let mut known: BTreeMap<Vec<E>, (usize, Address)> = BTreeMap::new();
        let mut links = Vec::new();
        for (letter, piece) in pieces.iter().enumerate() {
            let mut inner = self.landmarks(piece.target);
            let few = pieces.len() <= FEW_PIECES;
            for (second, deeper) in self.states[piece.target].pieces.iter().enumerate().filter(|_| few) {
                inner.extend(self.landmarks(deeper.target).into_iter().map(|a| prefixed(second, a)));
            }
            for address in inner {
                let address = prefixed(letter, address);
                let point = self.point(e, &address)?;
                let (other, there) = known.entry(point).or_insert_with(|| (letter, address.clone()));
                let (a, b) = (part[*other], part[letter]);
                if a != b {
                    links.push((there.clone(), address));
                    part.iter_mut().filter(|p| **p == b).for_each(|p| *p = a);
                }
            }
        }
        part.iter().all(|p| *p == part[0]).then_some(links)
    }
}

fn prefixed(letter: usize, mut address: Address) -> Address {
    address.prefix.insert(0, letter);
    address
}

#[cfg(test)]
mod tests {
    use super::super::CellKind;
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;

    fn of(maps: &[(i64, i64, i64)]) -> Shape {
        let op = |(n, d, s): &(i64, i64, i64)| {
            Shape::affine_operator(&Matrix::from_rows(1, vec![vec![ratio(*n, *d)]]), &[ratio(*s, *d)])
        };
        Shape::single(CellKind::Set, maps.iter().map(op).collect())
    }

    /// Three thirds of a segment hang together; without the middle one it is Cantor's set.
    #[test]
    fn thirds_of_a_segment() {
        let links = of(&[(1, 3, 0), (1, 3, 1), (1, 3, 2)]).links(0).unwrap();
        assert_eq!(links[0].1.len(), 2);
        let shape = of(&[(1, 3, 0), (1, 3, 1), (1, 3, 2)]);
        for (a, b) in &links[0].1 {
            assert_eq!(shape.point(0, a), shape.point(0, b));
        }
        assert!(of(&[(1, 3, 0), (1, 3, 2)]).links(0).is_none());
    }
}
