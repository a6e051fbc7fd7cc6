//! Whether the limit surface of a closed mesh is immersed: the patches of regular faces, those that appear after one step around the
//! other ones, and all rings around extraordinary vertices.

use super::near::{Near, Point};
use super::net::Net;
use super::outside;
use super::patch::{Patch, places};
use super::tail::{DEPTH, Tail};
use crate::base::{Checked, need};
use crate::vertex::Leading;
use crate::vertex::mesh::Place;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The directions of the neighbours of a point, anticlockwise; of quadrangles with the corners opposite to it.
const SIX: [Place; 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];
const EIGHT: [Place; 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];

/// The vertices on which the patch of a face with regular corners depends, in the order of [`places`].
pub fn control(net: &Net, face: usize, triangles: bool) -> Checked<Vec<u32>> {
    let own = &net.faces[face];
    let (corners, directions): (&[Place], &[Place]) =
        if triangles { (&[(0, 0), (1, 0), (0, 1)], &SIX) } else { (&[(0, 0), (1, 0), (1, 1), (0, 1)], &EIGHT) };
    need(own.len() == corners.len(), "whole", "a face with other corners")?;
    let mut all: BTreeMap<Place, u32> = BTreeMap::new();
    for (k, (v, (i, j))) in own.iter().zip(corners).enumerate() {
        all.insert((*i, *j), *v);
        let Some(ring) = net.ring_from(*v, face as u32, own[(k + 1) % own.len()]) else { return outside() };
        need(ring.is_regular(triangles), "whole", "a vertex that is not regular")?;
        let neighbours: Vec<u32> = if triangles {
            ring.spokes
        } else {
            ring.spokes.iter().zip(&ring.across).flat_map(|(a, b)| [*a, *b]).collect()
        };
        for (m, w) in neighbours.into_iter().enumerate() {
            // The first direction is that of the next corner.
            let (a, b) = directions[(m + 2 * k) % directions.len()];
            all.entry((i + a, j + b)).or_insert(w);
        }
    }
    match places(triangles).iter().map(|place| all.get(place).copied()).collect::<Option<Vec<u32>>>() {
        Some(vertices) => Ok(vertices),
        None => outside(),
    }
}

fn is_regular(net: &Net, face: usize, triangles: bool) -> Checked<()> {
    let points: Vec<Point> = control(net, face, triangles)?.iter().map(|v| net.points[*v as usize]).collect();
    let shown = Patch::new(triangles, &points).is_regular(DEPTH)?;
    need(shown, "limit", "a patch is not seen to be regular")
}

/// The net of two rings around a vertex, in the order of three rings; the points of the third are not known.
fn around(net: &Net, vertex: u32, triangles: bool, places: &[Place]) -> Checked<Vec<Point>> {
    let Some(ring) = net.ring(vertex) else { return outside() };
    let mut all = vec![net.points[vertex as usize]];
    for s in 0..ring.spokes.len() {
        let (a, b, face) = (ring.spokes[s], ring.spokes[(s + 1) % ring.spokes.len()], ring.faces[s]);
        let Some(at_a) = net.ring_from(a, face, vertex).filter(|r| r.is_regular(triangles)) else { return outside() };
        let mut known: BTreeMap<Place, u32> = BTreeMap::from([((1, 0), a)]);
        if triangles {
            known.extend([((1, 1), at_a.spokes[2]), ((2, 0), at_a.spokes[3])]);
        } else {
            let d = ring.across[s];
            let others = [net.ring_from(b, face, vertex), net.ring_from(d, face, a)];
            let [Some(at_b), Some(at_d)] = others.map(|r| r.filter(|r| r.is_regular(false))) else { return outside() };
            known.extend([((1, 1), d), ((2, 0), at_a.spokes[2]), ((2, 1), at_a.across[1])]);
            known.extend([((1, 2), at_b.across[1]), ((2, 2), at_d.across[2])]);
        }
        let point = |place: &Place| match known.get(place) {
            Some(v) => net.points[*v as usize],
            None => [Near::UNKNOWN; 3],
        };
        all.extend(places.iter().map(point));
    }
    Ok(all)
}

/// Demands that the limit surface of a closed mesh is immersed, with the schemes at its valences, at each of which the surface is C¹.
pub fn regular(start: &Net, triangles: bool, leading: &BTreeMap<usize, Leading>) -> Checked<()> {
    let usual = if triangles { 6 } else { 4 };
    let valence = |v: u32| match start.ring(v) {
        Some(ring) => ring.spokes.len(),
        None => 0,
    };
    let valences: Vec<usize> = (0..start.points.len() as u32).map(valence).collect();
    let irregular: Vec<bool> =
        start.faces.iter().map(|face| face.iter().any(|v| valences[*v as usize] != usual)).collect();
    for face in (0..start.faces.len()).filter(|f| !irregular[*f]) {
        is_regular(start, face, triangles)?;
    }
    let mut touched = vec![false; start.points.len()];
    for (face, _) in start.faces.iter().zip(&irregular).filter(|(_, i)| **i) {
        face.iter().for_each(|v| touched[*v as usize] = true);
    }
    let weight = |n: usize| match leading.get(&n) {
        Some(leading) => Near::of(&leading.mesh.at_centre()[1])[0],
        None => Near::UNKNOWN,
    };
    let (part, old, kept) = start.part(&touched)?;
    let fine = part.refined(triangles, &weight)?;
    for (at, face) in kept.iter().enumerate().filter(|(_, f)| irregular[**f as usize]) {
        let corners = &start.faces[*face as usize];
        for (k, _) in corners.iter().enumerate().filter(|(_, v)| valences[**v as usize] == usual) {
            is_regular(&fine, 4 * at + k, triangles)?;
        }
        if triangles {
            is_regular(&fine, 4 * at + 3, true)?;
        }
    }
    let mut tails: BTreeMap<usize, Tail> = BTreeMap::new();
    for (number, v) in old.iter().enumerate() {
        let n = valences[*v as usize];
        if n == usual {
            continue;
        }
        let Some(leading) = leading.get(&n) else { return outside() };
        let tail = match tails.entry(n) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(Tail::new(leading)?),
        };
        tail.are_immersed(&around(&fine, number as u32, triangles, tail.places())?)?;
    }
    Ok(())
}
