//! What is found of a mesh: C¹ at every vertex of these points, and the regularity of the whole limit surface.

use super::fan::Ground;
use super::limit::Limit;
use super::patch::Regular;
use super::refine::Kind;
use super::tags::Boundary;
use super::tail::Rings;
use crate::answer::Verdict;
use crate::scheme::MAX_VALENCE;
use crate::statement::Statement;
use crate::vertex::{AtValence, Curvature};
use std::collections::{BTreeMap, BTreeSet};

/// A point of the limit surface that belongs to a vertex or to a face of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Spot {
    /// The vertex of this number, from 0.
    Vertex(usize),
    /// The middle of the face of this number: of a face without four corners it becomes an extraordinary vertex.
    Face(usize),
}

/// Why a vertex has its verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reason {
    /// The leading coefficients of these points are independent.
    Independent,
    /// They are dependent, one a multiple of the other.
    Dependent,
    /// The leading coefficient is 0.
    Vanishing,
    /// Whether they are dependent was not decided.
    Undecided,
    /// All points on which the surface depends near the vertex lie on one line.
    Line,
    /// The valence has no theorem, with the words why.
    Valence(String),
    /// The vertex lies on the border, for which no rule is given.
    Border,
    /// The statement about its fan of faces on the border.
    Fan(Ground),
    /// The coefficients that would refute it are not certainly independent, as those of a plane net.
    Flat,
    /// A point around it has irrational coordinates after the steps of semi-sharp edges, or no rule.
    Irrational,
    /// One sharp edge ends there.
    Dart,
    /// The vertex is fixed, with faces all around and no sharp edge.
    Tip,
}

/// What was found at a vertex, or in the middle of a face.
#[derive(Debug, Clone)]
pub struct AtVertex {
    /// Where.
    pub spot: Spot,
    /// The line in the file.
    pub line: usize,
    /// The rule there.
    pub kind: Kind,
    /// The side of its sharp edges on which the faces lie, by a number from 0; `None` in the middle of a face.
    pub side: Option<u32>,
    /// How many sides there are.
    pub sides: usize,
    /// Its number in the mesh that was cut open and refined.
    pub(super) own: usize,
    /// The number of its faces: inside, the valence; 0 where no rule is given.
    pub valence: usize,
    /// The limit, where there are stencils for it.
    pub limit: Option<Limit>,
    /// C¹ there, for these points.
    pub smooth: Verdict,
    /// Why.
    pub reason: Reason,
    /// Whether the surface around it is no spline of the scheme, continued by reflection over the border.
    pub extraordinary: bool,
    /// The rings around an extraordinary vertex, or why there is no bound for them.
    pub rings: Option<Result<Rings, String>>,
}

impl AtVertex {
    /// Whether the surface around the vertex is proved regular: the vertex, and all rings where it is extraordinary.
    #[must_use]
    pub fn surrounded(&self) -> bool {
        let rings = match &self.rings {
            None => !self.extraordinary,
            Some(found) => matches!(found, Ok(Rings::Immersed(_))),
        };
        self.smooth == Verdict::Proved && rings
    }
}

/// A patch that is not proved regular.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bad {
    /// The face of the file in which it lies.
    pub face: usize,
    /// Its line.
    pub line: usize,
    /// The steps of refinement before the patch appears.
    pub level: usize,
    /// What was found.
    pub found: Regular,
}

/// What was found on the patches.
#[derive(Debug, Clone, Default)]
pub struct Patches {
    /// How many were tested, and how many of them are proved regular.
    pub tested: usize,
    /// Proved by floats with bounds.
    pub by_floats: usize,
    /// Proved in exact arithmetic.
    pub exactly: usize,
    /// The others, in the order of the faces.
    pub bad: Vec<Bad>,
}

/// What was found of a mesh.
#[derive(Debug, Clone)]
pub struct Found {
    /// The valences with their verdicts for almost all points.
    pub valences: BTreeMap<usize, AtValence>,
    /// The size of the curvature for almost all points at the valences at which the scheme is proved C¹.
    pub curvature: BTreeMap<usize, Curvature>,
    /// Every vertex of the file that a face has, then the middles of faces that become extraordinary.
    pub vertices: Vec<AtVertex>,
    /// The polynomial patches.
    pub patches: Patches,
    /// Whether the mesh has no border.
    pub closed: bool,
    /// How many inner edges are sharp: the surface is cut open along them.
    pub cuts: usize,
    /// How many steps were taken in which edges or vertices are sharp that do not stay so.
    pub soft_steps: usize,
    /// The rule of the border.
    pub boundary: Option<Boundary>,
    /// The parts that hang together, and whether each has two sides.
    pub parts: Vec<bool>,
    /// The part of each face.
    pub part: Vec<usize>,
}

impl Found {
    /// C¹ at every vertex, for these points.
    #[must_use]
    pub fn smooth(&self) -> Verdict {
        Verdict::all(self.vertices.len(), self.vertices.iter().map(|v| v.smooth))
    }

    /// Whether the limit surface of this mesh is a regular C¹ surface.
    #[must_use]
    pub fn regular(&self) -> Verdict {
        let around = self.vertices.iter().map(|v| match v.smooth {
            Verdict::Proved if !v.surrounded() => Verdict::Undetermined,
            verdict => verdict,
        });
        let refuted = |b: &Bad| matches!(b.found, Regular::Refuted(_) | Regular::Folded(..));
        let patches = if self.patches.bad.iter().any(refuted) {
            Verdict::Refuted
        } else if self.patches.tested > self.patches.by_floats + self.patches.exactly {
            Verdict::Undetermined
        } else {
            Verdict::Proved
        };
        Verdict::all(self.vertices.len(), around).and(patches)
    }

    /// The first patch that is refuted, or else the first that is open.
    #[must_use]
    pub fn first_bad(&self) -> Option<&Bad> {
        let refuted = |b: &&Bad| matches!(b.found, Regular::Refuted(_) | Regular::Folded(..));
        self.patches.bad.iter().find(refuted).or(self.patches.bad.first())
    }

    /// The statements of which the verdicts are instances.
    #[must_use]
    pub fn statements(&self) -> Vec<Statement> {
        let mut all = BTreeSet::new();
        for v in self.vertices.iter().filter(|v| v.smooth != Verdict::Undetermined) {
            all.insert(match v.reason {
                Reason::Fan(ground) => ground.statement(),
                _ => Statement::MeshVertex,
            });
            if v.kind.inside().is_some() {
                all.insert(if v.valence > MAX_VALENCE { Statement::Theorem9 } else { Statement::Theorem7 });
            }
        }
        if self.patches.tested > 0 {
            all.insert(Statement::MeshSurface);
        }
        if !self.curvature.is_empty() {
            all.insert(Statement::CurvatureSize);
        }
        all.into_iter().collect()
    }
}
