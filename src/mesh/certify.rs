//! How a mesh is examined: its vertices, its patches, and the rings around extraordinary vertices.

use super::found::{AtVertex, Bad, Found, Patches};
use super::interval::Float;
use super::open::{Opened, opened};
use super::patch::{Combination, Regular, bezier, combined, control, regular, regular_exactly};
use super::read::{MAX_FACES, Model, Point};
use super::refine::{Exact, Floats, Kind, Level, Space};
use super::scheme::Scheme;
use super::soft::Soft;
use super::tail::Tail;
use super::topology::Frame;
use crate::answer::Verdict;
use crate::budget::Budget;
use crate::diagnostic::Problem;
use crate::scheme::{MAX_VALENCE, MeshRule};
use crate::vertex::net::Spot as Parameter;
use crate::vertex::{AtValence, at_valence_within};
use std::collections::{BTreeMap, BTreeSet};

/// Halvings of a patch in floats, and exactly.
const DEPTH: usize = 8;
/// Patches that are tested exactly at most.
const EXACT: usize = 400;

/// A face whose patch floats did not decide, its control points, and where.
type Left = (usize, Vec<Combination>, Parameter);

/// The rule, its stencils and levels, while a mesh is examined.
pub(super) struct Work<'a> {
    pub model: &'a Model,
    pub scheme: Scheme,
    pub rule: MeshRule,
    pub budget: &'a Budget,
    pub step: &'a (dyn Fn() + Sync),
    pub triangles: bool,
    /// The mesh of the file, cut open along its sharp edges.
    pub opened: Opened,
    /// The same after one step, where it has faces without four corners.
    pub start: Level,
    /// How many steps that was.
    pub steps: usize,
    /// How many of them edges took that are sharp for some steps.
    pub soft_steps: usize,
    pub exact: Vec<Option<Point>>,
    near: Vec<[Float; 3]>,
    floats: Floats,
}

/// Proves or refutes that the limit surface of a mesh is C¹ at its vertices, and a regular C¹ surface as a whole.
///
/// `step` is called for each vertex, and for each extraordinary one once more.
///
/// # Errors
/// A [`Problem`] where the rule has no stencils here, or has no meaning on the faces.
///
/// # Cost
/// Linear in the faces, apart from the valences, each of which is examined once.
pub fn certify(model: &Model, scheme: Scheme, budget: &Budget, step: &(dyn Fn() + Sync)) -> Result<Found, Problem> {
    let rule = scheme.rule().map_err(|error| Problem::new("secant::mesh::scheme", error.to_string()))?;
    let triangles = scheme.triangles();
    let sizes = |n: usize| (0..model.topology.faces()).find(|f| model.topology.polygon(*f).len() != n);
    if let Some(face) = sizes(3).filter(|_| triangles) {
        let message = format!("{}:{}: the face is no triangle", model.name, model.face_lines[face]);
        return Err(Problem::new("secant::mesh::triangles", message)
            .with_help("Loop's scheme is for triangles; divide the face, or take --scheme catmull-clark"));
    }
    let opened = opened(model);
    let exact: Vec<Option<Point>> = opened.old.iter().map(|v| Some(model.points[*v as usize].clone())).collect();
    let floats = Floats::new(scheme, opened.level.kind.iter().map(|k| k.faces()).chain([6]));
    let soft = Soft::of(model, &opened);
    let soft_steps = soft.steps();
    let steps = soft_steps.max(usize::from(!triangles && sizes(4).is_some()));
    let first = if triangles { 4 * model.topology.faces() } else { model.topology.vertex.len() };
    let most = (1..steps).try_fold(first, |n, _| n.checked_mul(4)).filter(|n| steps == 0 || *n <= MAX_FACES);
    if most.is_none() {
        let message =
            format!("the sharpest semi-sharp edge takes {soft_steps} steps, which give more than {MAX_FACES} faces");
        return Err(Problem::new("secant::mesh::semi-sharp", message)
            .with_help("take a smaller mesh, a smaller sharpness, or 10, which stays sharp for ever"));
    }
    let (start, exact, near) = softened(scheme, &opened, soft, steps, &floats, exact);
    Ok(Work { model, scheme, rule, budget, step, triangles, opened, start, steps, soft_steps, exact, near, floats }
        .found())
}

/// The mesh after the steps in which edges are still sharp that do not stay so, its points, and bounds of them.
fn softened(
    scheme: Scheme,
    opened: &Opened,
    mut soft: Soft,
    steps: usize,
    floats: &Floats,
    mut exact: Vec<Option<Point>>,
) -> (Level, Vec<Option<Point>>, Vec<[Float; 3]>) {
    let (triangles, site) = (scheme.triangles(), |v: u32| opened.site(v));
    let mut level = opened.level.clone();
    let mut near: Vec<[Float; 3]> = exact.iter().map(floating).collect();
    for _ in 0..steps {
        exact = soft.points(&level, &site, &Exact::new(scheme), triangles, &exact);
        let bounds = soft.points(&level, &site, floats, triangles, &near);
        near = exact.iter().zip(bounds).map(|(p, bounds)| if p.is_some() { floating(p) } else { bounds }).collect();
        (soft, level) = (soft.next(&level), level.refined(triangles));
    }
    (level, exact, near)
}

impl Work<'_> {
    fn found(&self) -> Found {
        let valences = self.valences();
        let mut vertices = self.vertices(&valences);
        let near = &self.near;
        let mut patches = Patches::default();
        let whole: Vec<usize> = (0..self.start.topology.faces()).collect();
        let irregular = self.patches(&self.start, &whole, near, &self.exact, self.steps, &mut patches);
        if !irregular.is_empty() {
            let (old, level) = self.beside(&self.start, &irregular);
            let known = pick(near, &old);
            let next = level.points(&self.floats, self.triangles, &known);
            let exactly = || level.points(&Exact::new(self.scheme), self.triangles, &pick(&self.exact, &old));
            self.around(
                &mut vertices,
                &valences,
                (&level.refined(self.triangles), &next, &exactly),
                &old,
                &mut patches,
            );
        }
        let key = |b: &Bad| (b.face, b.level);
        patches.bad.sort_by_key(key);
        let (part, parts) = self.model.topology.parts();
        let curvature = valences.iter().filter_map(|(n, a)| Some((*n, a.curvature.clone()?))).collect();
        Found {
            valences,
            curvature,
            vertices,
            patches,
            closed: self.model.topology.closed(),
            parts,
            part,
            cuts: self.opened.cuts,
            soft_steps: self.soft_steps,
            boundary: self.model.tags.boundary,
        }
    }

    /// The verdicts for almost all points at each valence that occurs.
    fn valences(&self) -> BTreeMap<usize, AtValence> {
        let all: BTreeSet<usize> = self.start.kind.iter().filter_map(|k| k.inside()).filter(|n| *n >= 3).collect();
        let all: Vec<usize> = all.into_iter().filter(|n| *n <= MAX_VALENCE).collect();
        let found = super::each(&all, |n| at_valence_within(&self.rule, *n, self.budget).ok());
        all.into_iter().zip(found).filter_map(|(n, found)| Some((n, found?))).collect()
    }

    /// Tests the patches of the regular ones of some faces; the other faces.
    fn patches(
        &self,
        level: &Level,
        faces: &[usize],
        near: &[[Float; 3]],
        exact: &[Option<Point>],
        steps: usize,
        out: &mut Patches,
    ) -> Vec<usize> {
        let one = |f: &usize| {
            let points = control(level, *f, self.triangles)?;
            let own: Vec<[Float; 3]> = points.iter().map(|c| combined(&self.floats, near, c)).collect();
            let first = own[0];
            let moved: Vec<[Float; 3]> = own.iter().map(|p| std::array::from_fn(|k| p[k] - first[k])).collect();
            Some((points, regular(&self.floats, bezier(&self.floats, self.triangles, &moved), DEPTH)))
        };
        let mut irregular = Vec::new();
        let mut open = Vec::new();
        for (face, found) in faces.iter().zip(super::each(faces, one)) {
            match found {
                None => irregular.push(*face),
                Some((_, Ok(_))) => (out.tested, out.by_floats) = (out.tested + 1, out.by_floats + 1),
                Some((points, Err(places))) => open.push((*face, points, places[0].clone())),
            }
        }
        self.exactly(level, open, exact, steps, out);
        irregular
    }

    /// The exact test of what floats left open; beyond a number of patches it stays open.
    fn exactly(&self, level: &Level, open: Vec<Left>, exact: &[Option<Point>], steps: usize, out: &mut Patches) {
        let space = Exact::new(self.scheme);
        let budget = EXACT.saturating_sub(out.bad.len());
        let test = |(k, (_, points, spot)): &(usize, Left)| {
            let net = || {
                let own: Vec<Option<Point>> = points.iter().map(|c| combined(&space, exact, c)).collect();
                regular_exactly(&space, &bezier(&space, self.triangles, &own), DEPTH)
            };
            let found = if *k < budget && !exact.is_empty() { net() } else { None };
            match found {
                Some(found) => found,
                None => Regular::Open(spot.clone()),
            }
        };
        let open: Vec<(usize, Left)> = open.into_iter().enumerate().collect();
        let found = super::each(&open, test);
        for ((_, (face, ..)), found) in open.into_iter().zip(found) {
            out.tested += 1;
            if matches!(found, Regular::Proved(_)) {
                out.exactly += 1;
                continue;
            }
            let face = level.origin[face] as usize;
            out.bad.push(Bad { face, line: self.model.face_lines[face], level: steps, found });
        }
    }

    /// The part of a mesh that some faces and their neighbours are, with the old numbers of its vertices.
    fn beside(&self, level: &Level, faces: &[usize]) -> (Vec<u32>, Level) {
        let t = &level.topology;
        let mut touched = vec![false; t.vertices()];
        faces.iter().flat_map(|f| t.polygon(*f)).for_each(|v| touched[*v as usize] = true);
        let keep: Vec<bool> = (0..t.faces()).map(|f| t.polygon(f).iter().any(|v| touched[*v as usize])).collect();
        let (part, old) = level.restricted(&keep);
        (old, part)
    }

    /// The patches that appear after one more step around the irregular faces, and the rings around extraordinary vertices.
    fn around(
        &self,
        vertices: &mut [AtVertex],
        valences: &BTreeMap<usize, AtValence>,
        (level, near, exactly): (&Level, &[[Float; 3]], &dyn Fn() -> Vec<Option<Point>>),
        old: &[u32],
        out: &mut Patches,
    ) {
        // The faces of the part whose children are looked at: those with an extraordinary corner.
        let special = |k: Kind| k != Kind::Unknown && !k.regular(self.triangles);
        let children: Vec<usize> = self.children(level, old);
        let before = out.bad.len();
        let irregular = self.patches(level, &children, near, &[], self.steps + 1, out);
        if out.bad.len() > before {
            // Once more with exact points: floats left something open.
            let again: Vec<Bad> = out.bad.split_off(before);
            let faces: BTreeSet<usize> = again.iter().map(|b| b.face).collect();
            out.tested -= again.len();
            let exact = exactly();
            let open: Vec<usize> =
                children.iter().copied().filter(|f| faces.contains(&(level.origin[*f] as usize))).collect();
            let mut second = Patches::default();
            self.patches(level, &open, near, &exact, self.steps + 1, &mut second);
            out.tested += second.tested - second.by_floats;
            out.exactly += second.exactly;
            out.bad.extend(second.bad);
        }
        let border: Vec<usize> = irregular
            .iter()
            .copied()
            .filter(|f| !level.topology.polygon(*f).iter().any(|v| special(level.kind[*v as usize])))
            .collect();
        out.tested += border.len();
        for f in border {
            let face = level.origin[f] as usize;
            let found = Regular::Open((0.into(), 0.into()));
            out.bad.push(Bad { face, line: self.model.face_lines[face], level: self.steps + 1, found });
        }
        self.rings(vertices, valences, level, near, &irregular, old);
    }

    /// The children of the faces that were irregular one step before: those at an old vertex that is a corner of such a face.
    fn children(&self, level: &Level, old: &[u32]) -> Vec<usize> {
        let t = &self.start.topology;
        let mut irregular = vec![false; t.faces()];
        for (f, place) in irregular.iter_mut().enumerate() {
            *place = t.polygon(f).iter().any(|v| !self.start.kind[*v as usize].regular(self.triangles));
        }
        // Faces of the part keep their order: those with a touched vertex; children follow face by face.
        let mut touched = vec![false; t.vertices()];
        (0..t.faces()).filter(|f| irregular[*f]).flat_map(|f| t.polygon(f)).for_each(|v| touched[*v as usize] = true);
        let kept = (0..t.faces()).filter(|f| t.polygon(*f).iter().any(|v| touched[*v as usize]));
        debug_assert!(old.len() <= t.vertices());
        let all = kept.enumerate().filter(|(_, f)| irregular[*f]).flat_map(|(at, _)| 4 * at..4 * at + 4);
        all.filter(|f| *f < level.topology.faces()).collect()
    }

    /// The rings around every extraordinary vertex, after one more step.
    fn rings(
        &self,
        vertices: &mut [AtVertex],
        valences: &BTreeMap<usize, AtValence>,
        level: &Level,
        near: &[[Float; 3]],
        irregular: &[usize],
        old: &[u32],
    ) {
        let (second, part) = self.beside(level, irregular);
        let points = part.points(&self.floats, self.triangles, &pick(near, &second));
        let fine = part.refined(self.triangles);
        // From a vertex of the start to the number it has after both steps.
        let mut number: BTreeMap<u32, u32> = BTreeMap::new();
        for (at, v) in second.iter().enumerate() {
            if let Some(v) = old.get(*v as usize) {
                number.insert(*v, at as u32);
            }
        }
        let used: BTreeSet<usize> = vertices
            .iter()
            .filter(|v| v.smooth == Verdict::Proved && v.extraordinary)
            .filter_map(|v| v.kind.inside())
            .collect();
        let used: Vec<usize> = used.into_iter().collect();
        let tails: BTreeMap<usize, Result<Tail, String>> =
            used.iter().copied().zip(super::each_one(&used, |n| self.tail(*n, valences))).collect();
        let found = super::each_one(vertices, |v| {
            let tail = tails.get(&v.kind.inside()?).filter(|_| v.smooth == Verdict::Proved)?;
            let tail = match tail {
                Ok(tail) => tail,
                Err(why) => return Some(Err(why.clone())),
            };
            let net = number.get(&(v.own as u32)).and_then(|at| net(&fine, *at, tail, self.triangles));
            let Some(net) = net else { return Some(Err("the points around the vertex are not known".to_owned())) };
            let own: Vec<[Float; 3]> = net.iter().map(|i| points[*i as usize]).collect();
            let found = tail.rings(&own);
            (self.step)();
            Some(Ok(found))
        });
        vertices.iter_mut().zip(found).for_each(|(v, found)| v.rings = found);
    }

    fn tail(&self, n: usize, valences: &BTreeMap<usize, AtValence>) -> Result<Tail, String> {
        let top = valences.get(&n).and_then(|a| a.top.as_ref());
        let top = top.ok_or_else(|| format!("the spectrum at valence {n} was not computed"))?;
        Tail::new(self.scheme, n, top, &self.floats)
    }
}

fn floating(p: &Option<Point>) -> [Float; 3] {
    match p {
        Some(p) => std::array::from_fn(|k| Float::of(&p[k])),
        None => Floats::default().unknown(),
    }
}

fn pick<P: Clone>(points: &[P], of: &[u32]) -> Vec<P> {
    of.iter().map(|v| points[*v as usize].clone()).collect()
}

/// The net of a vertex in the order of its tail: the vertex, then sector by sector; `None` where the mesh around it is not
/// regular far enough.
fn net(level: &Level, vertex: u32, tail: &Tail, triangles: bool) -> Option<Vec<u32>> {
    let t = &level.topology;
    let star = t.around(vertex as usize);
    let regular = if triangles { 6 } else { 4 };
    if !star.closed || star.frames.len() != tail.valence {
        return None;
    }
    let far = |pivot: Frame, k: usize| {
        let star = t.star(pivot);
        (star.closed && star.frames.len() == regular).then(|| star.frames[k])
    };
    let right = |frame: Frame| far(t.first_side(frame), if triangles { 4 } else { 3 });
    let up = |frame: Frame| far(t.last_side(frame), if triangles { 2 } else { 1 });
    let mut all = vec![vertex];
    for sector in &star.frames {
        for (i, j) in &tail.places {
            // Of quadrangles the point is opposite in the face before, or at the end of its first side.
            let rows = if triangles || *j == 0 { *j } else { j - 1 };
            let mut frame = *sector;
            for _ in 1..*i {
                frame = right(frame)?;
            }
            for _ in 0..rows {
                frame = up(frame)?;
            }
            let point = if triangles || *j == 0 {
                t.vertex[t.first_side(frame).corner as usize]
            } else {
                t.diagonal(frame.corner)
            };
            all.push(point);
        }
    }
    Some(all)
}
