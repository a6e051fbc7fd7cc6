//! What follows for all values of an interval at which one eigenvalue leads.

use super::leader::{BITS, Kind, Leader, Window};
use super::model::Model;
use super::{Finding, Gap};
use crate::budget::Budget;
use crate::vertex::Ground;
use crate::vertex::field::{Enclosures, Fixed};
use crate::vertex::limit::Ring;
use crate::vertex::net::Signs;
use crate::vertex::ring::{Values, boundary, patches};
use crate::vertex::signs::{self, Map};
use crate::vertex::solve::eigenvector_of;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Findings about eigenvectors, those that are the same for every value kept.
pub(super) struct Judge<'a> {
    pub model: &'a Model,
    pub budget: &'a Budget,
    known: RefCell<BTreeMap<(usize, bool), Option<Finding>>>,
}

impl<'a> Judge<'a> {
    pub fn new(model: &'a Model, budget: &'a Budget) -> Self {
        Self { model, budget, known: RefCell::default() }
    }

    /// What holds at every value of the window at which the leader is smaller than 1 and all others are smaller in modulus.
    pub fn finding(&self, leader: &Leader, window: &Window) -> Option<Finding> {
        let piece = &self.model.pieces[leader.piece];
        let block = &self.model.blocks[piece.block];
        let between = 0 < block.frequency && 2 * block.frequency < self.model.vertex.valence;
        match (&leader.kind, between) {
            // With their conjugates in the block n − k four dimensions.
            (Kind::Pair, true) => return Some(Finding::By(Ground::Span)),
            // At valence 2 a pair in block 1 may wind once.
            (Kind::Pair, false) if self.model.vertex.valence == 2 && block.frequency == 1 => return None,
            // The function of the pair is the same in every sector, or in every second one.
            (Kind::Pair, false) => return Some(Finding::By(Ground::Sectors)),
            (Kind::Real { .. }, true) if block.frequency > 1 => {
                return Some(Finding::By(Ground::Winding(block.frequency)));
            }
            _ => {}
        }
        let constant = piece.is_constant() && block.is_constant();
        let place = (leader.piece, leader.is_negative());
        if let Some(found) = self.known.borrow().get(&place).filter(|_| constant) {
            return *found;
        }
        let found = self.by_signs(leader, window);
        if constant {
            self.known.borrow_mut().insert(place, found);
        }
        found
    }

    fn by_signs(&self, leader: &Leader, window: &Window) -> Option<Finding> {
        // At valence 2 block 1 belongs to ω = −1, and is no map to the plane.
        if self.model.vertex.valence < 3 {
            return None;
        }
        let (field, values, value) = self.values(leader, window)?;
        let k = self.model.blocks[self.model.pieces[leader.piece].block].frequency;
        if k == 1 { self.of_map(&field, &values, &value) } else { self.of_function(k, &field, &values) }
    }

    /// The eigenvector for all values of the window.
    fn values(&self, leader: &Leader, window: &Window) -> Option<(Enclosures, Values<Fixed>, Fixed)> {
        let Kind::Real { value, .. } = &leader.kind else { return None };
        let piece = &self.model.pieces[leader.piece];
        let block = &self.model.blocks[piece.block];
        let field = self.model.field(piece.block, BITS);
        let entries = block.on(&field, &field.interval(&window.interval()));
        let parts: Vec<&[usize]> = block.parts.iter().map(Vec::as_slice).collect();
        let values = eigenvector_of(&field, &entries, &parts, block.before, piece.part, value)?;
        // In block 0 nothing turns: ω = 1.
        let angle = if block.frequency == 0 { (0, 1) } else { (block.frequency, self.model.vertex.valence) };
        Some((Enclosures::of_angle(angle.0, angle.1, BITS), values, value.clone()))
    }

    /// The ring of a scheme without patches. Only the stencil of the centre depends on the parameter, and none of the points
    /// farther out that the ring needs follows from it.
    fn ring(&self, field: &Enclosures, values: &Values<Fixed>, value: &Fixed) -> Option<Ring> {
        Ring::new(&self.model.vertex, field, values, value, self.budget.ring_cells)
    }

    fn of_map(&self, field: &Enclosures, values: &Values<Fixed>, value: &Fixed) -> Option<Finding> {
        let map: Map = if self.model.vertex.rule.info().spline.is_some() {
            signs::map(field, &patches(&self.model.vertex, field, values)?, self.halvings())
        } else {
            signs::map_on_ring(&self.ring(field, values, value)?, field)
        };
        match (map.jacobian.strict(), map.half_plane) {
            (Some(_), Some(_)) => Some(Finding::By(Ground::Regular)),
            _ if map.jacobian.changes() => Some(Finding::By(Ground::Fold)),
            _ => None,
        }
    }

    fn of_function(&self, k: usize, field: &Enclosures, values: &Values<Fixed>) -> Option<Finding> {
        if self.model.vertex.rule.info().spline.is_none() {
            return Some(Finding::Open(Gap::Ring));
        }
        // In block 0 a closed path is enough.
        let path = k == 0;
        let nets = signs::function(&self.model.vertex, field, values, k)?;
        let nets = if path { boundary(&self.model.vertex.rule, &nets)? } else { nets };
        let signs: Signs = signs::signs_of(field, nets, self.halvings());
        signs.strict().map(|_| if path { Finding::By(Ground::Path) } else { Finding::By(Ground::Line) })
    }

    /// Windows are divided too.
    fn halvings(&self) -> usize {
        self.budget.halvings.min(HALVINGS)
    }
}

/// How often a patch is halved.
const HALVINGS: usize = 7;

/// What holds at a value at which two leaders have one modulus, smaller than 1, and all others are smaller.
pub(super) fn meeting(model: &Model, one: &Leader, other: &Leader) -> Finding {
    let block = |l: &Leader| &model.blocks[model.pieces[l.piece].block];
    let middle = |l: &Leader| block(l).frequency == 0 || 2 * block(l).frequency == model.vertex.valence;
    let dimension = |l: &Leader| {
        let own = if matches!(l.kind, Kind::Pair) { 2 } else { 1 };
        if middle(l) { own } else { 2 * own }
    };
    let real = |l: &Leader| matches!(l.kind, Kind::Real { .. });
    // Equal eigenvalues of one block may belong to one Jordan block.
    let alike = real(one) == real(other) && one.is_negative() == other.is_negative();
    if alike && block(one).frequency == block(other).frequency {
        return Finding::Open(Gap::Meeting);
    }
    match dimension(one) + dimension(other) {
        3.. => Finding::By(Ground::Span),
        _ if alike && real(one) => Finding::By(Ground::Sectors),
        _ => Finding::Open(Gap::Meeting),
    }
}
