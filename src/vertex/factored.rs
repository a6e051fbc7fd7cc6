//! Schemes whose masks are products: how much one step shrinks second differences (docs/theory.md, Lemma 4′).

use super::regular::{Cell, Place, place};
use crate::arith::{Integer, Natural, Rational};
use malachite_base::num::arithmetic::traits::{Abs, Lcm};
use std::collections::BTreeMap;

/// A mask: the weight of the point `q` in the point `p` of the finer lattice at `p − N q`.
pub type Mask = BTreeMap<Place, Rational>;

/// Steps taken together at most.
const MAX_STEPS: u32 = 6;
/// Steps are enough where they shrink differences to the first part of the second.
const ENOUGH: (i64, i64) = (1, 4);

/// The quotient of the mask by `1 + z^u`, for `u` with entries 0 and ±1; `None` where that is no factor.
fn quotient(mask: &Mask, u: Place) -> Option<Mask> {
    // A line in the direction of u, and the position on it.
    let split = |(i, j): Place| if u.0 == 1 { (j - u.1 * i, i) } else { (i - u.0 * j, j) };
    let join = |(line, t): Place| if u.0 == 1 { (t, line + u.1 * t) } else { (line + u.0 * t, t) };
    let mut lines: BTreeMap<i64, BTreeMap<i64, &Rational>> = BTreeMap::new();
    for (p, weight) in mask {
        let (line, t) = split(*p);
        lines.entry(line).or_default().insert(t, weight);
    }
    let mut found = Mask::new();
    for (line, weights) in lines {
        let (first, last) = (*weights.keys().next()?, *weights.keys().next_back()?);
        let mut carry = Rational::from(0);
        for t in first..=last {
            carry = weights.get(&t).map_or(Rational::from(0), |w| (*w).clone()) - carry;
            if carry != 0 {
                found.insert(join((line, t)), carry.clone());
            }
        }
        if carry != 0 {
            return None;
        }
    }
    Some(found)
}

/// The largest sum of absolute weights of one point after `steps` steps by a mask, each times 2.
fn norm(mask: &Mask, steps: u32) -> Rational {
    let denominator = mask.values().fold(Natural::from(1_u32), |d, w| d.lcm(w.denominator_ref()));
    let unit = Rational::from(denominator);
    let whole = |w: &Rational| Integer::try_from(w * &unit).expect("a multiple of the common denominator");
    let mask: Vec<(Place, Integer)> = mask.iter().map(|(p, w)| (*p, whole(w))).collect();
    let mut all: BTreeMap<Place, Integer> = [((0, 0), Integer::from(1))].into();
    for step in 0..steps {
        let mut next = BTreeMap::new();
        for (p, x) in &all {
            for (q, w) in &mask {
                *next.entry((p.0 + (q.0 << step), p.1 + (q.1 << step))).or_insert(Integer::from(0)) += x * w;
            }
        }
        all = next;
    }
    let size = 1 << steps;
    let mut sums: BTreeMap<Place, Integer> = BTreeMap::new();
    for ((i, j), x) in all {
        *sums.entry((i.rem_euclid(size), j.rem_euclid(size))).or_default() += x.abs();
    }
    let scale = (0..steps).fold(Rational::from(1), |s, _| s * Rational::from(2) / &unit);
    Rational::from(sums.into_values().fold(Integer::from(0), Integer::max)) * scale
}

/// For a mask with `N = 2` that has the factors `(1 + z^u)(1 + z^v)` for all of some pairs of directions: bounds `R_0 = 1, R_1, …` of the
/// second differences in a part of a cell after so many steps, times `2^steps`, by those in the cell before. `None` where there is no
/// such factor, or where differences outside of the cell take part.
///
/// # Cost
/// Products of masks up to 6 steps: some ten thousand terms each.
#[must_use]
pub fn shrinking(mask: &Mask, pairs: &[(Place, Place)], points: &[Place], parts: &[Cell]) -> Option<Vec<Rational>> {
    let mut divided_masks: Vec<Mask> = Vec::new();
    for (u, v) in pairs {
        let divided = quotient(&quotient(mask, *u)?, *v)?;
        let corners = |o: Place, s: i64| {
            [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(a, b)| (o.0 + s * (a * u.0 + b * v.0), o.1 + s * (a * u.1 + b * v.1)))
        };
        let inside = |o: Place| corners(o, 1).iter().all(|p| points.contains(p));
        for part in parts {
            // In a part that lies upside down a difference begins at its opposite corner.
            let own = points.iter().filter(|o| inside(**o)).map(|o| place(part, *o));
            let first = |o: Place| if part.1 == 1 { o } else { corners(o, -1)[3] };
            if own.map(first).any(|o| sources(&divided, (*u, *v), o).any(|q| !inside(q))) {
                return None;
            }
        }
        if !divided_masks.contains(&divided) {
            divided_masks.push(divided);
        }
    }
    let mut bounds = vec![Rational::from(1)];
    for steps in 1..=MAX_STEPS {
        let worst = divided_masks.iter().map(|m| norm(m, steps)).max()?;
        let enough = &worst * Rational::from(ENOUGH.1) <= ENOUGH.0;
        bounds.push(worst);
        if enough {
            break;
        }
    }
    Some(bounds)
}

/// The places of the second differences in the directions `u`, `v` from which that of the finer net at `place` follows: the symbol
/// of second differences is the quotient of the mask, shifted by `u + v`.
fn sources(divided: &Mask, (u, v): (Place, Place), place: Place) -> impl Iterator<Item = Place> {
    let (x, y) = (place.0 - u.0 - v.0, place.1 - u.1 - v.1);
    let even = move |k: &Place| {
        let (i, j) = (x - k.0, y - k.1);
        (i.rem_euclid(2) == 0 && j.rem_euclid(2) == 0).then_some((i / 2, j / 2))
    };
    divided.keys().filter_map(even)
}
