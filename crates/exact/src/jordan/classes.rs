//! Eigenvalues grouped by exact absolute value.

use super::{Eigenvalue, Factor, ModulusClass};
use crate::algebraic::Root;
use crate::arith::Interval;
use std::cmp::Ordering;

struct Entry<'a> {
    eigenvalue: Eigenvalue,
    root: &'a Root,
    range: Interval,
}

/// The classes of the roots of all factors, strictly descending.
pub(super) fn modulus_classes(factors: &[Factor]) -> Vec<ModulusClass> {
    group(&factors.iter().map(|f| f.roots.as_slice()).collect::<Vec<_>>())
}

pub(super) fn group(factors: &[&[Root]]) -> Vec<ModulusClass> {
    let mut entries: Vec<Entry> = Vec::new();
    for (factor, roots) in factors.iter().enumerate() {
        for (root, r) in roots.iter().enumerate() {
            // A conjugate shares the range of its partner.
            let mirrored = !r.is_real() && r.conjugate().index() < r.index();
            if !mirrored {
                entries.push(Entry { eigenvalue: Eigenvalue { factor, root }, root: r, range: r.modulus(48) });
            }
        }
    }
    entries.sort_by(|a, b| compare(b, a));
    let mut classes: Vec<ModulusClass> = Vec::new();
    let mut last: Option<&Entry> = None;
    for entry in &entries {
        if last.is_none_or(|l| compare(l, entry) != Ordering::Equal) {
            classes.push(ModulusClass { members: Vec::new() });
        }
        let members = &mut classes.last_mut().expect("a class was opened").members;
        members.push(entry.eigenvalue);
        if !entry.root.is_real() {
            members.push(Eigenvalue { root: entry.eigenvalue.root + 1, ..entry.eigenvalue });
        }
        last = Some(entry);
    }
    for class in &mut classes {
        class.members.sort_unstable();
    }
    classes
}

fn compare(a: &Entry, b: &Entry) -> Ordering {
    if a.range.disjoint(&b.range) {
        return a.range.lo.cmp(&b.range.lo);
    }
    a.root.cmp_modulus(b.root)
}
