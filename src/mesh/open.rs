//! A mesh cut open along its edges that stay sharp: every fan of faces at a vertex gets a vertex of its own.

use super::read::Model;
use super::refine::{Kind, Level};
use super::tags::{Boundary, INFINITE};
use super::topology::{Frame, NONE, Star, Topology};
use std::collections::BTreeMap;

/// The mesh that was cut open.
#[derive(Debug, Clone)]
pub struct Opened {
    /// Its faces in their order, and the rules at its vertices.
    pub level: Level,
    /// The vertex of the file behind each vertex.
    pub old: Vec<u32>,
    /// The number of its fan, from 0.
    pub fan: Vec<u32>,
    /// How many fans a vertex of the file has, where there are several.
    fans: BTreeMap<u32, usize>,
    /// How many inner edges were cut.
    pub cuts: usize,
}

impl Opened {
    /// The vertex of the file behind one of the cut mesh, or that of the first of its sides; further vertices are their own.
    #[must_use]
    pub fn site(&self, v: u32) -> u32 {
        self.old.get(v as usize).map_or(v, |old| *old)
    }

    /// The number of fans at a vertex of the file.
    #[must_use]
    pub fn sides(&self, v: u32) -> usize {
        self.fans.get(&v).map_or(1, |n| *n)
    }
}

/// Cuts a mesh open.
#[must_use]
pub fn opened(model: &Model) -> Opened {
    let mut t = model.topology.clone();
    let ends = |t: &Topology, c: u32| [t.vertex[c as usize], t.vertex[t.next(c) as usize]];
    // Sharp edges at each vertex, and whether it lies on the border of the mesh.
    let (mut sharp, mut border) = (vec![0_u32; t.vertices()], vec![false; t.vertices()]);
    let mut cut = Vec::new();
    for (e, [c, other]) in t.edges.iter().enumerate() {
        let [a, b] = ends(&t, *c);
        let outer = *other == NONE;
        let stays = model.tags.edge(a, b).is_some_and(|s| *s >= INFINITE);
        if outer || stays {
            [a, b].into_iter().for_each(|v| sharp[v as usize] += 1);
        }
        if outer {
            [a, b].into_iter().for_each(|v| border[v as usize] = true);
        } else if stays {
            cut.push(e);
        }
    }
    let mut parted: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for e in &cut {
        let [c, other] = t.edges[*e];
        ends(&t, c).into_iter().for_each(|v| drop(parted.insert(v, Vec::new())));
        t.edge[other as usize] = t.edges.len() as u32;
        t.edges[*e] = [c, NONE];
        t.edges.push([other, NONE]);
    }
    for (c, v) in t.vertex.iter().enumerate() {
        if let Some(corners) = parted.get_mut(v) {
            corners.push(c as u32);
        }
    }
    let mut old: Vec<u32> = (0..t.vertices() as u32).collect();
    let mut fan = vec![0; t.vertices()];
    for (v, corners) in &parted {
        part(&mut t, *v, corners, &mut old, &mut fan);
    }
    let kind = (0..t.vertices()).map(|v| kind(model, &t, v, old[v], &sharp, &border)).collect();
    let mut fans: BTreeMap<u32, usize> = BTreeMap::new();
    old.iter().zip(&fan).for_each(|(v, f)| {
        if *f > 0 {
            fans.insert(*v, *f as usize + 1);
        }
    });
    Opened { level: Level::of(t, kind), old, fan, fans, cuts: cut.len() }
}

/// Gives the fans at a vertex, after the first one, numbers of their own.
fn part(t: &mut Topology, v: u32, corners: &[u32], old: &mut Vec<u32>, fan: &mut Vec<u32>) {
    let mut seen: Vec<u32> = Vec::new();
    let mut fans = 0;
    for c in corners {
        if seen.contains(c) {
            continue;
        }
        let star: Star = t.whole(Frame { corner: *c, ahead: true });
        let own: Vec<u32> = star.frames.iter().map(|f| f.corner).collect();
        if fans == 0 {
            t.corner[v as usize] = *c;
        } else {
            let number = t.corner.len() as u32;
            own.iter().for_each(|c| t.vertex[*c as usize] = number);
            t.corner.push(*c);
            old.push(v);
            fan.push(fans);
        }
        fans += 1;
        seen.extend(own);
    }
}

/// The rule at a vertex of the mesh that was cut open.
fn kind(model: &Model, t: &Topology, v: usize, old: u32, sharp: &[u32], border: &[bool]) -> Kind {
    if t.corner[v] == NONE || (border[old as usize] && model.tags.boundary.is_none()) {
        return Kind::Unknown;
    }
    let n = t.around(v).frames.len() as u32;
    let fixed = model.tags.vertices.get(&old).is_some_and(|s| *s >= INFINITE);
    let lone = border[old as usize] && n == 1 && model.tags.boundary == Some(Boundary::EdgeAndCorner);
    match sharp[old as usize] {
        0 if fixed => Kind::Tip(n),
        0 => Kind::Inside(n),
        1 if !fixed => Kind::Dart(n),
        2 if !fixed && !lone => Kind::Smooth(n),
        _ => Kind::Corner(n),
    }
}
