//! Enclosures of limits of the butterfly scheme, which is no spline.
//!
//! Let `D_j` bound the differences along edges at level `j`. The scheme (tension 1/16) puts a new point within `D_j/4` of the
//! middle of its edge (four terms of weight 1/16, each a difference along an edge). Dividing its symbol by `1 + z` in the
//! direction of an edge gives the scheme of the differences, with norms `D_{j+1} ≤ 7/8 D_j` and `D_{j+2} ≤ 31/64 D_j`
//! (tests/oracle/butterfly.py). So the limit differs from the polygon of level `j` by at most
//! `D_j/4 · (1 + 7/8) / (1 − 31/64) < D_j`.

use super::block::Vertex;
use super::field::{Enclosures, Field, Fixed};
use super::ring::Control;
use super::solve::leading_vector;
use super::top::{convert, number_field};
use crate::arith::{Integer, Rational, ratio};
use crate::scheme::MeshRule;
use std::collections::BTreeMap;

type Place = (i64, i64);

/// The edge path at this distance from the centre is examined; its surroundings are regular.
const RADIUS: i64 = 5;
/// Points up to this distance from the path are kept; stencils of new points at most that far reach no farther.
const REACH: i64 = 4;
/// Steps of subdivision.
const LEVELS: u32 = 5;
/// The neighbours in order.
const AROUND: [Place; 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];

fn plus(a: Place, b: Place) -> Place {
    (a.0 + b.0, a.1 + b.1)
}

/// The distance in edges.
fn distance((i, j): Place) -> i64 {
    i.abs().max(j.abs()).max((i + j).abs())
}

/// The sign of the function of a rational eigenvalue in block 0 on a closed path around the centre, where it is certain
/// that it has no zero there. `None` for other schemes and tensions too.
#[must_use]
pub fn sign_on_path(vertex: &Vertex, value: &Rational, bits: u64) -> Option<i32> {
    let MeshRule::Butterfly { w, .. } = &vertex.rule else { return None };
    if *w != ratio(1, 16) {
        return None;
    }
    let rings = usize::try_from(RADIUS + REACH).ok()?;
    let wide = Vertex::new(&vertex.rule, vertex.valence, rings).ok()?;
    let block = wide.block(0).ok()?;
    let exact = number_field(&wide, &block);
    let field = Enclosures::of_angle(0, 1, bits);
    let values = convert(&exact, &field, &leading_vector(&exact, &block, value)?);
    let control = Control { vertex: &wide, field: &field, values: &values };
    let path = |level: u32| (0..=RADIUS << level).map(move |t| ((RADIUS << level) - t, t));
    let near = |p: Place, level: u32| path(level).any(|q| distance((p.0 - q.0, p.1 - q.1)) <= REACH);
    let mut net = BTreeMap::new();
    for i in -REACH..=RADIUS + REACH {
        for j in -REACH..=RADIUS + REACH {
            if near((i, j), 0) {
                let at = control.at(i, j)?;
                net.insert((i, j), field.add(&at.x, &at.y));
            }
        }
    }
    for level in 1..=LEVELS {
        net = refined(&field, &net, |p| near(p, level));
    }
    let ends = |x: &Fixed, y: &Fixed| {
        let d = field.sub(x, y);
        d.hi.max(-d.lo)
    };
    let mut difference = Integer::from(0);
    for q in path(LEVELS) {
        for i in -REACH..=REACH {
            for j in -REACH..=REACH {
                let p = plus(q, (i, j));
                if distance((i, j)) > REACH {
                    continue;
                }
                let own = net.get(&p)?;
                for d in &AROUND[..3] {
                    if let Some(other) = net.get(&plus(p, *d)) {
                        difference = difference.max(ends(own, other));
                    }
                }
            }
        }
    }
    let values: Option<Vec<&Fixed>> = path(LEVELS).map(|p| net.get(&p)).collect();
    let values = values?;
    if values.iter().all(|v| v.lo > difference) {
        Some(1)
    } else if values.iter().all(|v| -&v.hi > difference) {
        Some(-1)
    } else {
        None
    }
}

/// One step of the regular rule wherever all points of a stencil are known.
fn refined(f: &Enclosures, net: &BTreeMap<Place, Fixed>, keep: impl Fn(Place) -> bool) -> BTreeMap<Place, Fixed> {
    let mut fresh = BTreeMap::new();
    for (a, value) in net {
        let doubled = (2 * a.0, 2 * a.1);
        if keep(doubled) {
            fresh.insert(doubled, value.clone());
        }
        for k in 0..3 {
            let turn = |s: usize| AROUND[(k + s) % 6];
            let b = plus(*a, AROUND[k]);
            let at = plus(*a, b);
            if !keep(at) {
                continue;
            }
            let stencil = [
                (*a, 8),
                (b, 8),
                (plus(*a, turn(1)), 2),
                (plus(*a, turn(5)), 2),
                (plus(*a, turn(2)), -1),
                (plus(b, turn(1)), -1),
                (plus(*a, turn(4)), -1),
                (plus(b, turn(5)), -1),
            ];
            let sum = stencil
                .iter()
                .try_fold(f.zero(), |sum, (p, weight)| Some(f.add(&sum, &f.scale(net.get(p)?, &ratio(*weight, 16)))));
            if let Some(sum) = sum {
                fresh.insert(at, sum);
            }
        }
    }
    fresh
}
