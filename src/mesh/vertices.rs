//! The verdict at every vertex of a mesh, for its very points.

use super::border::{BorderStencil, Fan, Points};
use super::certify::Work;
use super::fan::Row;
use super::found::{AtVertex, Reason, Spot};
use super::limit::{Limit, Stencil, collinear};
use super::read::Point;
use super::refine::Kind;
use super::topology::NONE;
use crate::answer::Verdict;
use crate::scheme::MAX_VALENCE;
use crate::vertex::{AtValence, every};
use std::collections::{BTreeMap, BTreeSet};

/// The largest valence that is examined.
const LARGEST: usize = MAX_VALENCE;

/// What is the same at all vertices of one kind.
struct Known<'a> {
    valences: &'a BTreeMap<usize, AtValence>,
    stencils: BTreeMap<usize, Stencil>,
    fans: BTreeMap<Fan, (BorderStencil, Row)>,
    /// Whether the scheme is proved C¹ at all valences.
    common: bool,
}

impl Work<'_> {
    /// The vertices of the file by their fans, and the middles of faces that become extraordinary.
    pub(super) fn vertices(&self, valences: &BTreeMap<usize, AtValence>) -> Vec<AtVertex> {
        let t = &self.opened.level.topology;
        let used = (0..t.vertices()).filter(|v| t.corner[*v] != NONE);
        let mut spots: Vec<(Spot, usize)> = used.map(|v| (Spot::Vertex(self.opened.old[v] as usize), v)).collect();
        spots.sort_unstable();
        if self.steps > 0 && !self.triangles {
            let middles = (0..t.faces()).filter(|f| t.polygon(*f).len() != 4);
            spots.extend(middles.map(|f| (Spot::Face(f), t.vertices() + t.edges.len() + f)));
        }
        let kinds: BTreeSet<Kind> = spots.iter().map(|(_, v)| self.start.kind[*v]).collect();
        let inside: BTreeSet<usize> =
            kinds.iter().filter_map(|k| k.inside()).filter(|n| (3..=LARGEST).contains(n)).collect();
        let fans: Vec<Fan> = kinds.iter().filter_map(|k| self.fan(*k)).collect();
        let rows = super::each_one(&fans, |fan| (BorderStencil::new(*fan), fan.row(self.budget)));
        let common = match inside.iter().next_back() {
            Some(n) if *n > MAX_VALENCE => every(&self.rule).ok().flatten().is_some_and(|e| e.proved()),
            _ => false,
        };
        let known = Known {
            valences,
            stencils: inside.iter().map(|n| (*n, Stencil::new(self.scheme, *n))).collect(),
            fans: fans.into_iter().zip(rows).collect(),
            common,
        };
        super::each(&spots, |(spot, v)| {
            let found = self.vertex(*spot, *v, &known);
            (self.step)();
            found
        })
    }

    /// The fan of a vertex on the border.
    fn fan(&self, kind: Kind) -> Option<Fan> {
        let (smooth, n) = match kind {
            Kind::Smooth(n) => (true, n as usize),
            Kind::Corner(n) => (false, n as usize),
            _ => return None,
        };
        (n <= LARGEST).then_some(Fan { triangles: self.triangles, smooth, faces: n })
    }

    fn vertex(&self, spot: Spot, v: usize, known: &Known<'_>) -> AtVertex {
        let line = match spot {
            Spot::Vertex(v) => self.model.point_lines[v],
            Spot::Face(f) => self.model.face_lines[f],
        };
        let kind = self.start.kind[v];
        let mut found = AtVertex {
            spot,
            line,
            own: v,
            kind,
            side: self.opened.fan.get(v).copied().filter(|_| matches!(spot, Spot::Vertex(_))),
            sides: match spot {
                Spot::Vertex(v) => self.opened.sides(v as u32),
                Spot::Face(_) => 1,
            },
            valence: kind.faces(),
            limit: None,
            smooth: Verdict::Undetermined,
            reason: Reason::Border,
            extraordinary: !kind.regular(self.triangles),
            rings: None,
        };
        match kind {
            Kind::Unknown => {}
            Kind::Dart(_) => found.reason = Reason::Dart,
            Kind::Tip(_) => found.reason = Reason::Tip,
            Kind::Inside(_) => self.inside(&mut found, known),
            Kind::Smooth(_) | Kind::Corner(_) => self.on_border(&mut found, known),
        }
        found
    }

    fn inside(&self, found: &mut AtVertex, known: &Known<'_>) {
        let (n, v) = (found.valence, found.own);
        let Some(stencil) = known.stencils.get(&n) else {
            found.reason = Reason::Valence(if n > LARGEST {
                format!("valences over {LARGEST} are not examined")
            } else {
                format!("no statement is about vertices of valence {n}")
            });
            return;
        };
        let Some(limit) = self.points(v, |at| stencil.limit(at.own, at.spokes, at.across)) else {
            found.reason = self.unknown();
            return;
        };
        let holds = if n > MAX_VALENCE {
            known
                .common
                .then_some(())
                .ok_or_else(|| format!("the valence is over {MAX_VALENCE}, and no proof for all valences is known"))
        } else {
            let proved = |a: &&AtValence| a.smooth == Verdict::Proved && a.frequency == Some(1);
            let found = known.valences.get(&n).filter(proved);
            found.map(|_| ()).ok_or_else(|| format!("for almost all points of valence {n} it is not proved"))
        };
        (found.smooth, found.reason) = match holds {
            Err(why) => (Verdict::Undetermined, Reason::Valence(why)),
            Ok(()) => self.judged(v, &limit, Reason::Independent),
        };
        found.limit = Some(limit);
    }

    /// Why a point around a vertex is not known.
    fn unknown(&self) -> Reason {
        if self.soft_steps > 0 && self.triangles { Reason::Irrational } else { Reason::Border }
    }

    /// The verdict where almost all points have a tangent plane.
    fn judged(&self, v: usize, limit: &Limit, why: Reason) -> (Verdict, Reason) {
        match limit.dependent {
            Some((false, _)) => (Verdict::Proved, why),
            Some((true, _)) if self.on_a_line(v) => (Verdict::Refuted, Reason::Line),
            Some((true, true)) => (Verdict::Undetermined, Reason::Vanishing),
            Some((true, false)) => (Verdict::Undetermined, Reason::Dependent),
            None => (Verdict::Undetermined, Reason::Undecided),
        }
    }

    fn on_border(&self, found: &mut AtVertex, known: &Known<'_>) {
        let v = found.own;
        let Some((stencil, row)) = self.fan(found.kind).and_then(|fan| known.fans.get(&fan)) else {
            found.reason = Reason::Valence(format!("more than {LARGEST} faces at the border are not examined"));
            return;
        };
        let read = |at: Points<'_>| {
            let three = row.verdict == Verdict::Refuted && stencil.three_directions(at);
            (stencil.limit(at), three)
        };
        let Some((mut limit, three)) = self.points(v, read) else {
            found.reason = self.unknown();
            return;
        };
        (found.smooth, found.reason) = match row.verdict {
            Verdict::Proved => self.judged(v, &limit, Reason::Fan(row.ground)),
            Verdict::Refuted if three => (Verdict::Refuted, Reason::Fan(row.ground)),
            Verdict::Refuted if self.on_a_line(v) => (Verdict::Refuted, Reason::Line),
            Verdict::Refuted => (Verdict::Undetermined, Reason::Flat),
            Verdict::Undetermined => {
                (Verdict::Undetermined, Reason::Valence("the signs of the characteristic map are open".to_owned()))
            }
        };
        if row.verdict != Verdict::Proved {
            // There is no normal, or it is not known to be one.
            limit.unit = None;
        }
        found.limit = Some(limit);
    }

    /// What a stencil reads off around a vertex; `None` where a point around it has no rule.
    fn points<R>(&self, v: usize, read: impl FnOnce(Points<'_>) -> R) -> Option<R> {
        let t = &self.start.topology;
        let star = t.around(v);
        let at = |v: u32| self.exact.get(v as usize)?.as_ref();
        let spokes = star.spokes.iter().map(|v| at(*v)).collect::<Option<Vec<&Point>>>()?;
        let across = star.frames.iter().filter(|_| !self.triangles).map(|f| at(t.diagonal(f.corner)));
        let across = across.collect::<Option<Vec<&Point>>>()?;
        Some(read(Points { own: at(v as u32)?, spokes: &spokes, across: &across }))
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
}
