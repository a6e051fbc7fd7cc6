//! How a mesh is examined: its vertices, its patches, and the rings around extraordinary vertices.

use super::found::{AtVertex, Bad, Found, Patches, Reason, Spot};
use super::interval::Float;
use super::limit::{Limit, Stencil, collinear};
use super::patch::{Regular, bezier, control, regular, regular_exactly};
use super::read::{Model, Point};
use super::refine::{Exact, Floats, Level, Space};
use super::scheme::Scheme;
use super::tail::Tail;
use super::topology::Frame;
use crate::answer::Verdict;
use crate::budget::Budget;
use crate::diagnostic::Problem;
use crate::scheme::{MAX_VALENCE, MeshRule};
use crate::vertex::net::Spot as Parameter;
use crate::vertex::{AtValence, at_valence_within, every};
use std::collections::{BTreeMap, BTreeSet};

/// Halvings of a patch in floats, and exactly.
const DEPTH: usize = 8;
/// Patches that are tested exactly at most.
const EXACT: usize = 400;

/// The largest valence that is examined.
const LARGEST: usize = 512;

/// The rule, its stencils and levels, while a mesh is examined.
struct Work<'a> {
    model: &'a Model,
    scheme: Scheme,
    rule: MeshRule,
    budget: &'a Budget,
    step: &'a (dyn Fn() + Sync),
    triangles: bool,
    /// The mesh of the file after one step, where it has faces without four corners.
    start: Level,
    /// How many steps that was.
    steps: usize,
    exact: Vec<Option<Point>>,
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
    let file = Level::of(model.topology.clone());
    let exact: Vec<Option<Point>> = model.points.iter().cloned().map(Some).collect();
    let mut floats = Floats::new(scheme, file.valence.iter().map(|n| *n as usize));
    let (start, exact, steps) = if triangles || sizes(4).is_none() {
        (file, exact, 0)
    } else {
        let next = file.points(&Exact::new(scheme), false, &exact);
        (file.refined(false), next, 1)
    };
    if triangles {
        floats = Floats::new(scheme, start.valence.iter().map(|n| *n as usize).chain([6]));
    }
    Ok(Work { model, scheme, rule, budget, step, triangles, start, steps, exact, floats }.found())
}

impl Work<'_> {
    fn regular_valence(&self) -> usize {
        if self.triangles { 6 } else { 4 }
    }

    fn found(&self) -> Found {
        let valences = self.valences();
        let mut vertices = self.vertices(&valences);
        let near: Vec<[Float; 3]> = self.exact.iter().map(floating).collect();
        let mut patches = Patches::default();
        let whole: Vec<usize> = (0..self.start.topology.faces()).collect();
        let irregular = self.patches(&self.start, &whole, &near, &self.exact, self.steps, &mut patches);
        if !irregular.is_empty() {
            let (old, level) = self.beside(&self.start, &irregular);
            let known = pick(&near, &old);
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
        let curvature = valences
            .iter()
            .filter(|(_, a)| a.smooth == Verdict::Proved && a.frequency == Some(1))
            .filter_map(|(n, _)| Some((*n, super::curvature::curvature(self.scheme, *n)?)))
            .collect();
        Found { valences, curvature, vertices, patches, closed: self.model.topology.closed(), parts, part }
    }

    /// The verdicts for almost all points at each valence that occurs.
    fn valences(&self) -> BTreeMap<usize, AtValence> {
        let all: BTreeSet<usize> = self.start.valence.iter().map(|n| *n as usize).filter(|n| *n >= 3).collect();
        let all: Vec<usize> = all.into_iter().filter(|n| *n <= MAX_VALENCE).collect();
        let found = super::each(&all, |n| at_valence_within(&self.rule, *n, self.budget).ok());
        all.into_iter().zip(found).filter_map(|(n, found)| Some((n, found?))).collect()
    }

    /// The vertices of the file, and the middles of faces that become extraordinary.
    fn vertices(&self, valences: &BTreeMap<usize, AtValence>) -> Vec<AtVertex> {
        let t = &self.model.topology;
        let used = (0..t.vertices()).filter(|v| t.corner[*v] != super::topology::NONE);
        let mut spots: Vec<(Spot, usize)> = used.map(|v| (Spot::Vertex(v), v)).collect();
        if self.steps > 0 {
            let middles = (0..t.faces()).filter(|f| t.polygon(*f).len() != 4);
            spots.extend(middles.map(|f| (Spot::Face(f), t.vertices() + t.edges.len() + f)));
        }
        let used: BTreeSet<usize> =
            self.start.valence.iter().map(|n| *n as usize).filter(|n| (3..=LARGEST).contains(n)).collect();
        let stencils: BTreeMap<usize, Stencil> = used.iter().map(|n| (*n, Stencil::new(self.scheme, *n))).collect();
        let common = match used.iter().next_back() {
            Some(n) if *n > MAX_VALENCE => every(&self.rule).ok().flatten().is_some_and(|e| e.proved()),
            _ => false,
        };
        super::each(&spots, |(spot, v)| {
            let found = self.vertex(*spot, *v, valences, &stencils, common);
            (self.step)();
            found
        })
    }

    fn vertex(
        &self,
        spot: Spot,
        v: usize,
        valences: &BTreeMap<usize, AtValence>,
        stencils: &BTreeMap<usize, Stencil>,
        common: bool,
    ) -> AtVertex {
        let line = match spot {
            Spot::Vertex(v) => self.model.point_lines[v],
            Spot::Face(f) => self.model.face_lines[f],
        };
        let n = self.start.valence[v] as usize;
        let mut found = AtVertex {
            spot,
            line,
            valence: n,
            limit: None,
            smooth: Verdict::Undetermined,
            reason: Reason::Border,
            extraordinary: n != self.regular_valence(),
            rings: None,
        };
        let Some(stencil) = stencils.get(&n).filter(|_| n > 0) else {
            if n > LARGEST {
                found.reason = Reason::Valence(format!("valences over {LARGEST} are not examined"));
            } else if n > 0 {
                found.reason = Reason::Valence(format!("no statement is about vertices of valence {n}"));
            }
            return found;
        };
        let Some(limit) = self.limit(stencil, v) else { return found };
        let holds = if n > MAX_VALENCE {
            common
                .then_some(())
                .ok_or_else(|| format!("the valence is over {MAX_VALENCE}, and no proof for all valences is known"))
        } else {
            let known = valences.get(&n).filter(|a| a.smooth == Verdict::Proved && a.frequency == Some(1));
            known.map(|_| ()).ok_or_else(|| format!("for almost all points of valence {n} it is not proved"))
        };
        (found.smooth, found.reason) = match (holds, limit.dependent) {
            (Err(why), _) => (Verdict::Undetermined, Reason::Valence(why)),
            (Ok(()), Some((false, _))) => (Verdict::Proved, Reason::Independent),
            (Ok(()), Some((true, _))) if self.on_a_line(v) => (Verdict::Refuted, Reason::Line),
            (Ok(()), Some((true, true))) => (Verdict::Undetermined, Reason::Vanishing),
            (Ok(()), Some((true, false))) => (Verdict::Undetermined, Reason::Dependent),
            (Ok(()), None) => (Verdict::Undetermined, Reason::Undecided),
        };
        found.limit = Some(limit);
        found
    }

    /// The limit at a vertex; `None` where a point around the middle of a face lies on the border, for which there is no rule.
    fn limit(&self, stencil: &Stencil, v: usize) -> Option<Limit> {
        let t = &self.start.topology;
        let star = t.around(v);
        let at = |v: u32| self.exact.get(v as usize)?.as_ref();
        let spokes = star.spokes.iter().map(|v| at(*v)).collect::<Option<Vec<&Point>>>()?;
        let across = star.frames.iter().filter(|_| !self.triangles).map(|f| at(t.diagonal(f.corner)));
        Some(stencil.limit(at(v as u32)?, &spokes, &across.collect::<Option<Vec<&Point>>>()?))
    }

    /// Whether all points lie on a line on which the surface depends in the faces at a vertex.
    fn on_a_line(&self, v: usize) -> bool {
        let t = &self.start.topology;
        let own: Vec<u32> =
            t.around(v).frames.iter().flat_map(|f| t.polygon(t.face[f.corner as usize] as usize)).copied().collect();
        let faces = own.iter().flat_map(|w| t.around(*w as usize).frames);
        let all: BTreeSet<u32> =
            faces.flat_map(|f| t.polygon(t.face[f.corner as usize] as usize).iter().copied()).collect();
        let points: Option<Vec<&Point>> = all.into_iter().map(|w| self.exact[w as usize].as_ref()).collect();
        points.is_some_and(|points| collinear(&points))
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
            let own: Vec<[Float; 3]> = points.iter().map(|v| near[*v as usize]).collect();
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
    fn exactly(
        &self,
        level: &Level,
        open: Vec<(usize, Vec<u32>, Parameter)>,
        exact: &[Option<Point>],
        steps: usize,
        out: &mut Patches,
    ) {
        let space = Exact::new(self.scheme);
        let budget = EXACT.saturating_sub(out.bad.len());
        let test = |(k, (_, points, spot)): &(usize, (usize, Vec<u32>, Parameter))| {
            let own: Vec<Option<Point>> = points.iter().map(|v| exact.get(*v as usize).cloned().flatten()).collect();
            let found =
                if *k < budget { regular_exactly(&space, &bezier(&space, self.triangles, &own), DEPTH) } else { None };
            match found {
                Some(found) => found,
                None => Regular::Open(spot.clone()),
            }
        };
        let open: Vec<(usize, (usize, Vec<u32>, Parameter))> = open.into_iter().enumerate().collect();
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
        let special = |n: u32| n != 0 && n as usize != self.regular_valence();
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
            .filter(|f| !level.topology.polygon(*f).iter().any(|v| special(level.valence[*v as usize])))
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
        let regular = self.regular_valence() as u32;
        let t = &self.start.topology;
        let mut irregular = vec![false; t.faces()];
        for (f, place) in irregular.iter_mut().enumerate() {
            *place = t.polygon(f).iter().any(|v| self.start.valence[*v as usize] != regular);
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
            .filter(|v| v.smooth == Verdict::Proved && v.valence != self.regular_valence())
            .map(|v| v.valence)
            .collect();
        let used: Vec<usize> = used.into_iter().collect();
        let tails: BTreeMap<usize, Result<Tail, String>> =
            used.iter().copied().zip(super::each_one(&used, |n| self.tail(*n, valences))).collect();
        let t = &self.model.topology;
        let found = super::each_one(vertices, |v| {
            let tail = tails.get(&v.valence).filter(|_| v.smooth == Verdict::Proved)?;
            let tail = match tail {
                Ok(tail) => tail,
                Err(why) => return Some(Err(why.clone())),
            };
            let own = match v.spot {
                Spot::Vertex(v) => v,
                Spot::Face(f) => t.vertices() + t.edges.len() + f,
            };
            let net = number.get(&(own as u32)).and_then(|at| net(&fine, *at, tail, self.triangles));
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
