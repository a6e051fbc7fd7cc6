//! Edges and vertices that are sharp for some steps only. Each step takes 1 from their sharpness; where less than 1 is left, the
//! sharp and the smooth point are mixed. Afterwards nothing is left of them but the points.

use super::open::Opened;
use super::read::Model;
use super::refine::{Kind, Level, Space};
use super::tags::INFINITE;
use super::topology::NONE;
use crate::arith::{Rational, ratio};
use std::collections::BTreeMap;

/// What is sharp for some more steps.
#[derive(Debug, Clone, Default)]
pub struct Soft {
    edges: BTreeMap<(u32, u32), Rational>,
    vertices: BTreeMap<u32, Rational>,
}

/// The rule of a vertex while edges at it are sharp.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rule {
    /// What its kind says.
    Own,
    /// A curve through these neighbours.
    Crease(u32, u32),
    /// It stays.
    Fixed,
}

fn key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

fn ends(level: &Level, c: u32) -> [u32; 2] {
    let t = &level.topology;
    [t.vertex[c as usize], t.vertex[t.next(c) as usize]]
}

impl Soft {
    /// What the tags of a file say.
    #[must_use]
    pub fn of(model: &Model, opened: &Opened) -> Self {
        let soft = |s: &&Rational| **s > 0 && **s < INFINITE;
        let mut own = Self::default();
        for [c, other] in &opened.level.topology.edges {
            let [a, b] = ends(&opened.level, *c);
            let sharpness = model.tags.edge(opened.old[a as usize], opened.old[b as usize]);
            if let Some(s) = sharpness.filter(soft).filter(|_| *other != NONE) {
                own.edges.insert(key(a, b), s.clone());
            }
        }
        for (v, old) in opened.old.iter().enumerate() {
            if let Some(s) = model.tags.vertices.get(old).filter(soft) {
                own.vertices.insert(v as u32, s.clone());
            }
        }
        own
    }

    /// How many steps it takes until nothing is left.
    #[must_use]
    pub fn steps(&self) -> usize {
        let most = self.edges.values().chain(self.vertices.values()).max();
        // All of them are below INFINITE.
        (0..INFINITE).find(|k| most.is_none_or(|s| *s <= *k)).map_or(INFINITE as usize, |k| k as usize)
    }

    /// What is left after a step.
    #[must_use]
    pub fn next(&self, level: &Level) -> Self {
        let t = &level.topology;
        let one = ratio(1, 1);
        let mut edges = BTreeMap::new();
        for (e, [c, _]) in t.edges.iter().enumerate() {
            let [a, b] = ends(level, *c);
            if let Some(s) = self.edges.get(&key(a, b)).filter(|s| **s > 1) {
                let middle = (t.vertices() + e) as u32;
                [a, b].into_iter().for_each(|v| drop(edges.insert(key(v, middle), s - &one)));
            }
        }
        let left = self.vertices.iter().filter(|(_, s)| **s > 1).map(|(v, s)| (*v, s - &one)).collect();
        Self { edges, vertices: left }
    }

    /// The points of one step. `site` is the vertex of the file behind a vertex: all its sides move together.
    #[must_use]
    pub fn points<S: Space>(
        &self,
        level: &Level,
        site: &dyn Fn(u32) -> u32,
        space: &S,
        triangles: bool,
        old: &[S::P],
    ) -> Vec<S::P> {
        let t = &level.topology;
        let mut new = level.points(space, triangles, old);
        let mut sharp: BTreeMap<u32, Vec<(u32, &Rational)>> = BTreeMap::new();
        for (e, [c, _]) in t.edges.iter().enumerate() {
            let [a, b] = ends(level, *c);
            let Some(s) = self.edges.get(&key(a, b)) else { continue };
            sharp.entry(site(a)).or_default().push((b, s));
            sharp.entry(site(b)).or_default().push((a, s));
            let at = t.vertices() + e;
            let middle = space.sum(&[(1, &old[a as usize]), (1, &old[b as usize])], 2);
            new[at] = if *s >= 1 { middle } else { space.between(&middle, &new[at], s) };
        }
        for v in 0..t.vertices() as u32 {
            let edges = sharp.get(&site(v)).map_or(&[][..], Vec::as_slice);
            if let Some(point) = self.moved(level, space, old, &new, v, edges) {
                new[v as usize] = point;
            }
        }
        new
    }

    /// The new point of a vertex, where it is not the one that its kind gives.
    fn moved<S: Space>(
        &self,
        level: &Level,
        space: &S,
        old: &[S::P],
        new: &[S::P],
        v: u32,
        edges: &[(u32, &Rational)],
    ) -> Option<S::P> {
        let own = self.vertices.get(&v);
        let now: Vec<u32> = edges.iter().map(|e| e.0).collect();
        let later: Vec<u32> = edges.iter().filter(|e| *e.1 > 1).map(|e| e.0).collect();
        let before = rule(level, v, &now, own.is_some());
        let after = rule(level, v, &later, own.is_some_and(|s| *s > 1));
        let point = |rule: Rule| match rule {
            Rule::Own => new[v as usize].clone(),
            Rule::Fixed => old[v as usize].clone(),
            Rule::Crease(a, b) => space.sum(&[(6, &old[v as usize]), (1, &old[a as usize]), (1, &old[b as usize])], 8),
        };
        if before == Rule::Own {
            return None;
        }
        if before == after {
            return Some(point(before));
        }
        // The mean of what ends with this step, at most 1.
        let ending: Vec<&Rational> = edges.iter().map(|e| e.1).chain(own).filter(|s| **s <= 1).collect();
        let share = ending.iter().fold(ratio(0, 1), |sum, s| sum + *s) / Rational::from(ending.len().max(1) as u64);
        Some(space.between(&point(before), &point(after), &share))
    }
}

/// The rule of a vertex with these neighbours along edges that are sharp for some steps.
fn rule(level: &Level, v: u32, sharp: &[u32], fixed: bool) -> Rule {
    let for_ever = match level.kind[v as usize] {
        Kind::Inside(_) => 0,
        Kind::Dart(_) => 1,
        Kind::Smooth(_) => 2,
        Kind::Corner(_) | Kind::Tip(_) | Kind::Unknown => return Rule::Own,
    };
    match (for_ever, sharp) {
        _ if fixed => Rule::Fixed,
        (0, [a, b]) => Rule::Crease(*a, *b),
        (1, [a]) => Rule::Crease(*a, level.topology.around(v as usize).spokes[0]),
        _ if for_ever + sharp.len() > 2 => Rule::Fixed,
        _ => Rule::Own,
    }
}
