//! The verdict at one valence: is the surface C¹ at the vertex for almost all control points, and has it a tangent plane?

use super::block::{Block, Vertex};
use super::cosine::{gcd, minimal_polynomial};
use super::curvature::{Curvature, curvature};
use super::field::{Enclosures, Field, Fixed};
use super::limit::{self, Ring};
use super::net::{Net, Signs};
use super::reason::{BorderGround, VertexReason};
use super::regular::Regular;
use super::ring::{self, Values, patches};
use super::signs::{self, Map};
use super::top::{Top, TopError, leading_value, leading_values, top};
use super::turning::Turning;
use crate::answer::Verdict;
use crate::arith::{Interval, Rational, to_f64};
use crate::budget::Budget;
use crate::poly::{Poly, factor};
use crate::ring::{Field as _, Ordered as _};
use crate::scheme::{MeshRule, SchemeError};
use crate::statement::Statement;

/// Polynomials up to this degree are factored for display.
const DISPLAY_DEGREE: usize = 24;

/// What the verdict at one valence rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ground {
    /// Theorem 7: the characteristic map is regular and winds once.
    Regular,
    /// Theorem 8 (a): the leading eigenvectors live in this block, other than 1 and `n − 1`.
    Winding(usize),
    /// Theorem 8 (c): the Jacobian determinant changes its sign.
    Fold,
    /// Theorem 2 or 3, with Theorem 8 (e): one leading eigenvector, whose function on the ring has no zero.
    Line,
    /// Theorem 8 (e): the same on a closed path only.
    Path,
    /// Theorem 8 (b): the leading eigenvectors are the same in every second sector.
    Sectors,
    /// Theorem 8 (d): the leading eigenvectors span three dimensions or more.
    Span,
    /// An eigenvalue besides 1 is not smaller than 1 in modulus, so that the rings do not shrink.
    NoLimit,
}

impl Ground {
    /// The verdict on C¹ for almost all control points.
    #[must_use]
    pub fn verdict(self) -> Verdict {
        if self == Self::Regular { Verdict::Proved } else { Verdict::Refuted }
    }

    /// The statement about C¹.
    #[must_use]
    pub fn statement(self) -> Statement {
        match self {
            Self::Regular => Statement::Theorem7,
            Self::NoLimit => Statement::NoLimit,
            _ => Statement::Theorem8,
        }
    }
}

/// Enclosures of the leading eigenvector, as middles: with `ω = e^(2πik/n)`, a point of sector `s` has the value `ω^s (x + y ω)`.
#[derive(Debug, Clone)]
pub struct Eigenvector {
    /// The frequency `k`.
    pub frequency: usize,
    /// The rings of points.
    pub rings: usize,
    /// At the centre.
    pub centre: (Rational, Rational),
    /// `x` and `y` at the points of sector 0, by place.
    pub points: Vec<((usize, usize), (Rational, Rational))>,
}

/// Whether the independent checker proved verdicts again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Again {
    /// It was not asked.
    NotAsked,
    /// The certificate format has no rule for them.
    NoRule,
    /// It proved them.
    Proved,
}

/// What holds at one valence.
#[derive(Debug, Clone)]
pub struct AtValence {
    /// The valence; of a vertex on the border the number of its faces.
    pub valence: usize,
    /// On the border: whether that is a smooth curve there, or the vertex is a corner.
    pub border: Option<bool>,
    /// C¹ for almost all control points.
    pub smooth: Verdict,
    /// A tangent plane for almost all control points (the statement of Theorem 2 or 3).
    pub plane: Verdict,
    /// The largest eigenvalues below 1, where they were proved.
    pub top: Option<Top>,
    /// The minimal polynomial of the eigenvalue over the rationals, where it was computed.
    pub minimal: Option<Poly>,
    /// The Fourier block of the characteristic map.
    pub frequency: Option<usize>,
    /// The signs of the Jacobian determinant on the patches of one sector.
    pub jacobian: Option<Signs>,
    /// Whether the ring consists of polynomial patches; otherwise signs come from enclosures of the limit (Lemma 4).
    pub polynomial: bool,
    /// How often the boundary of the ring winds around 0, where the ring avoids 0.
    pub winding: Option<usize>,
    /// The functional that is positive on the sector, in the coordinates of `x + y ω`.
    pub half_plane: Option<(Rational, Rational)>,
    /// Why: what was found, or what failed.
    pub reason: VertexReason,
    /// What a decided verdict rests on, where it is one leading eigenvector with its conjugate.
    pub ground: Option<Ground>,
    /// That eigenvector.
    pub eigenvector: Option<Eigenvector>,
    /// The curvature for almost all control points, where the surface is C¹ for them and the ring has Bézier patches.
    pub curvature: Option<Curvature>,
    /// What the independent checker says of the verdicts.
    pub again: Again,
    /// The patches of sector 0 as floats `x, y`, for pictures: nets of points in the true plane.
    pub outline: Vec<Net<(f64, f64)>>,
}

impl AtValence {
    fn new(valence: usize) -> Self {
        Self {
            valence,
            border: None,
            smooth: Verdict::Undetermined,
            plane: Verdict::Undetermined,
            top: None,
            minimal: None,
            frequency: None,
            jacobian: None,
            polynomial: true,
            winding: None,
            half_plane: None,
            reason: VertexReason::Unexamined,
            ground: None,
            eigenvector: None,
            curvature: None,
            again: Again::NotAsked,
            outline: Vec::new(),
        }
    }

    /// What holds at a vertex of the border with so many faces; `curve` is whether the border is a smooth curve there.
    #[must_use]
    pub fn on_border(faces: usize, curve: bool, ground: BorderGround, verdict: Verdict) -> Self {
        let plane = match (verdict, ground) {
            (Verdict::Proved, _) => Verdict::Proved,
            (Verdict::Refuted, BorderGround::Sides) => Verdict::Refuted,
            _ => Verdict::Undetermined,
        };
        let open = verdict == Verdict::Undetermined;
        let reason = if open { VertexReason::BorderOpen } else { VertexReason::Border(ground) };
        Self { border: Some(curve), smooth: verdict, plane, reason, ..Self::new(faces) }
    }

    /// The statements that the verdicts are instances of, in the order of the theory.
    #[must_use]
    pub fn statements(&self) -> Vec<Statement> {
        if let VertexReason::Border(ground) = self.reason {
            return vec![ground.statement()];
        }
        let length = self.top.as_ref().map_or(1, |top| top.longest(self.valence).0);
        let simple = if length > 1 { Statement::Theorem3 } else { Statement::Theorem2 };
        let decided = self.smooth != Verdict::Undetermined;
        let mut out = match self.ground.filter(|_| decided) {
            Some(Ground::NoLimit) => vec![Statement::NoLimit],
            Some(Ground::Regular) => vec![Statement::Lemma3, Statement::Theorem7],
            Some(Ground::Span) => vec![Statement::Corollary, Statement::Theorem8],
            Some(Ground::Line) => vec![simple, Statement::Theorem8],
            Some(Ground::Winding(_) | Ground::Fold | Ground::Path | Ground::Sectors) => vec![Statement::Theorem8],
            None => Vec::new(),
        };
        if self.plane == Verdict::Proved {
            out.extend([simple, Statement::Lemma3]);
        }
        if !self.polynomial && (self.jacobian.is_some() || self.half_plane.is_some() || self.ground.is_some()) {
            out.push(Statement::Lemma4);
        }
        out.extend(self.curvature.as_ref().map(|_| Statement::CurvatureSize));
        out.sort_unstable();
        out.dedup();
        out
    }

    /// Whether the characteristic map is regular, where that is known.
    #[must_use]
    pub fn regular(&self) -> Option<bool> {
        let signs = self.jacobian.as_ref()?;
        if signs.strict().is_some() {
            Some(true)
        } else if signs.changes() {
            Some(false)
        } else {
            None
        }
    }

    /// Whether it is injective, where that is known.
    #[must_use]
    pub fn injective(&self) -> Option<bool> {
        match (self.regular(), self.frequency, self.winding) {
            // A pair of blocks other than 1 and n − 1; in the blocks 0 and n/2 there is no characteristic map.
            (_, Some(k), _) if k > 1 && 2 * k < self.valence => Some(false),
            (_, Some(k), _) if k != 1 => None,
            (Some(false), _, _) => Some(false),
            (Some(true), Some(1), Some(1)) => Some(true),
            _ => None,
        }
    }

    /// The place of a witness in the lattice of sector 0.
    #[must_use]
    pub fn lattice(&self, rule: &MeshRule, at: &(usize, (Rational, Rational))) -> Option<(Rational, Rational)> {
        if rule.info().spline.is_none() {
            return limit::lattice_point(rule, at.0, &at.1);
        }
        ring::lattice_point(rule, at.0, &at.1)
    }
}

/// Examines a scheme at a vertex (for dual schemes: in a face) of one valence.
///
/// # Errors
/// [`SchemeError`] where the scheme cannot be built there.
///
/// # Examples
/// ```
/// use secant::{scheme::mesh_rule, theorem::Verdict, vertex::at_valence};
/// let found = at_valence(&mesh_rule("catmull-clark", &[].into())?, 5)?;
/// assert_eq!((found.smooth, found.winding), (Verdict::Proved, Some(1)));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
///
/// # Cost
/// For a few dozen valences a few milliseconds each, apart from the minimal polynomial of the eigenvalue.
pub fn at_valence(rule: &MeshRule, valence: usize) -> Result<AtValence, SchemeError> {
    at_valence_within(rule, valence, &Budget::default())
}

/// As [`at_valence`] with a budget of its own.
///
/// # Errors
/// As [`at_valence`].
pub fn at_valence_within(rule: &MeshRule, valence: usize, budget: &Budget) -> Result<AtValence, SchemeError> {
    let mut found = AtValence::new(valence);
    found.polynomial = rule.info().spline.is_some();
    let vertex = Vertex::examined(rule, valence)?;
    let blocks: Vec<Block> = match vertex.frequencies().map(|k| vertex.block(k)).collect() {
        Ok(blocks) => blocks,
        Err(error @ (SchemeError::Mesh { .. } | SchemeError::Asymmetric { .. })) => {
            found.reason = VertexReason::Block(error);
            return Ok(found);
        }
        Err(error) => return Err(error),
    };
    let top = match top(&vertex, &blocks, budget.places[0]) {
        Ok(top) => top,
        Err(TopError::Scheme(error)) => return Err(error),
        Err(TopError::Open(reason)) => {
            found.reason = reason;
            return Ok(found);
        }
    };
    found.minimal = minimal(&vertex, &top);
    Judge { vertex: &vertex, blocks: &blocks, top: &top, found: &mut found, budget }.judge();
    if found.smooth == Verdict::Proved && found.ground == Some(Ground::Regular) {
        found.curvature = curvature(&vertex, &blocks, &top);
    }
    found.top = Some(top);
    Ok(found)
}

struct Judge<'a> {
    vertex: &'a Vertex,
    blocks: &'a [Block],
    top: &'a Top,
    found: &'a mut AtValence,
    budget: &'a Budget,
}

impl Judge<'_> {
    fn judge(&mut self) {
        let n = self.vertex.valence;
        let known = self.top.rational.clone().map(Interval::point);
        let Interval { lo, hi } = known.unwrap_or_else(|| self.top.enclosure.clone());
        if !(lo > -1 && hi < 1) {
            self.no_limit(lo >= 1 || hi <= -1);
            return;
        }
        if !self.found.polynomial && Regular::of(&self.vertex.rule).is_none() {
            self.found.reason = VertexReason::RegularRule;
            return;
        }
        let (length, dimension) = self.top.longest(n);
        let leading: Vec<(usize, bool)> = self.top.leading(n).iter().map(|m| (m.frequency, m.negative)).collect();
        match (dimension, leading.as_slice()) {
            (3.., _) => {
                self.found.ground = Some(Ground::Span);
                self.refute(VertexReason::Span { length, dimension });
            }
            (1, [(k, false)]) => self.line(*k, length),
            (2, [(k, false)]) if 0 < *k && 2 * *k < n => self.pair(*k, length),
            // At valence 2 a map of which both parts are in block 1 may wind once.
            (2, all) if n == 2 && all.iter().all(|(k, _)| *k == 1) => self.found.reason = VertexReason::TwoFaces,
            (2, all) if length == 1 && all.iter().all(|(_, negative)| !negative) => {
                self.found.ground = Some(Ground::Sectors);
                self.refute(VertexReason::Sectors);
                self.found.plane = Verdict::Undetermined;
            }
            _ => self.found.reason = VertexReason::Uncovered { length },
        }
    }

    fn refute(&mut self, reason: VertexReason) {
        self.found.smooth = Verdict::Refuted;
        self.found.plane = Verdict::Refuted;
        self.found.reason = reason;
    }

    /// An eigenvalue besides 1, counted once, that is not smaller: the theorems ask for rings that shrink to a point.
    fn no_limit(&mut self, certain: bool) {
        if certain {
            self.found.ground = Some(Ground::NoLimit);
            self.refute(VertexReason::NoLimit);
        } else {
            self.found.reason = VertexReason::LimitOpen;
        }
    }

    /// One leading eigenvector: all limit directions are parallel to it where its function on the ring has no zero.
    fn line(&mut self, k: usize, length: usize) {
        self.found.frequency = Some(k);
        let Some((signs, boundary)) = self.signs_of_function(k) else {
            self.found.reason = VertexReason::LineOpen { length, block: k };
            return;
        };
        if signs.strict().is_some() {
            self.found.ground = Some(Ground::Line);
            self.refute(VertexReason::Line { length, block: k });
        } else if k == 0 && boundary.strict().is_some() {
            self.one_sided(length);
        } else {
            self.found.reason = VertexReason::LineZero { length, block: k };
        }
    }

    fn one_sided(&mut self, length: usize) {
        self.refute(VertexReason::Path { length });
        self.found.plane = Verdict::Undetermined;
        self.found.ground = Some(Ground::Path);
    }

    /// The ring of the leading eigenvector of block `k` for a scheme without Bézier patches.
    fn ring(&mut self, k: usize, bits: u64) -> Option<Ring> {
        let (field, values) = self.values(k, bits)?;
        self.note(k, &field, &values);
        let eigenvalue = leading_value(self.vertex, self.blocks, self.top, k, bits)?;
        Ring::new(self.vertex, &field, &values, &eigenvalue, self.budget.ring_cells)
    }

    /// The signs of the function of block 0 or n/2 on the ring, and on its outer boundary or its innermost cells.
    fn signs_of_function(&mut self, k: usize) -> Option<(Signs, Signs)> {
        if !self.found.polynomial {
            let ring = self.ring(k, self.budget.places[0])?;
            return Some((signs::function_on_ring(&ring, k, false), signs::function_on_ring(&ring, k, true)));
        }
        let (field, values) = self.values(k, self.budget.places[0])?;
        self.note(k, &field, &values);
        let nets = signs::function(self.vertex, &field, &values, k)?;
        let boundary = ring::boundary(&self.vertex.rule, &nets)?;
        let signs = |nets| signs::signs_of(&field, nets, self.budget.halvings);
        Some((signs(nets), signs(boundary)))
    }

    fn values(&self, k: usize, bits: u64) -> Option<(Enclosures, Values<Fixed>)> {
        let values = leading_values(self.vertex, self.blocks, self.top, k, bits)?;
        if k == 0 {
            // The orbits do not turn: ω = 1.
            return Some((Enclosures::of_angle(0, 1, bits), values));
        }
        Some((Enclosures::of_angle(k, self.vertex.valence, bits), values))
    }

    fn note(&mut self, frequency: usize, field: &Enclosures, values: &Values<Fixed>) {
        let middle = |v: &Turning<Fixed>| (field.to_interval(&v.x).mid(), field.to_interval(&v.y).mid());
        let points = self.vertex.stencils.places.iter().copied().zip(values.orbits.iter().map(middle)).collect();
        self.found.eigenvector =
            Some(Eigenvector { frequency, rings: self.vertex.rings, centre: middle(&values.centre), points });
    }

    /// A pair of leading eigenvectors in the blocks `k` and `n − k`: the characteristic map.
    fn pair(&mut self, k: usize, length: usize) {
        self.found.frequency = Some(k);
        let known = self.budget.places.into_iter().any(|bits| self.characteristic(k, bits));
        if self.found.winding.is_some() {
            self.found.plane = Verdict::Proved;
        }
        if k != 1 && length > 1 && self.found.winding.is_none() {
            self.found.reason = VertexReason::RingOpen { block: k };
            return;
        }
        if k != 1 {
            self.found.ground = Some(Ground::Winding(k));
            self.found.smooth = Verdict::Refuted;
            self.found.reason = VertexReason::Winding { length, block: k, times: self.found.winding };
            return;
        }
        if !known && self.found.jacobian.is_none() {
            self.found.reason = VertexReason::Derivatives { length };
            return;
        }
        match (self.found.regular(), self.found.winding) {
            (Some(true), Some(1)) => {
                self.found.smooth = Verdict::Proved;
                self.found.ground = Some(Ground::Regular);
                self.found.reason = VertexReason::Regular { length };
            }
            (Some(false), _) => {
                self.found.smooth = Verdict::Refuted;
                self.found.ground = Some(Ground::Fold);
                self.found.reason = VertexReason::Fold;
            }
            (None, _) => self.found.reason = VertexReason::JacobianOpen,
            _ => self.found.reason = VertexReason::HalfPlane,
        }
    }

    /// Examines the characteristic map; whether nothing was left open.
    fn characteristic(&mut self, k: usize, bits: u64) -> bool {
        if !self.found.polynomial {
            return self.enclosed(k, bits);
        }
        let Some((field, values)) = self.values(k, bits) else { return false };
        self.note(k, &field, &values);
        let Some(patches) = patches(self.vertex, &field, &values) else { return false };
        let map = signs::map(&field, &patches, self.budget.halvings);
        let point = |p: &Turning<Fixed>| (field.to_f64(&p.x), field.to_f64(&p.y));
        self.found.outline = outline(&field, &patches.iter().map(|p| p.map(point)).collect::<Vec<_>>());
        self.known(k, map)
    }

    /// The same for a scheme without Bézier patches, from enclosures.
    fn enclosed(&mut self, k: usize, bits: u64) -> bool {
        let Some(ring) = self.ring(k, bits) else { return false };
        let field = Enclosures::of_angle(k, self.vertex.valence, bits);
        self.found.outline = outline(&field, &ring.corners());
        self.known(k, signs::map_on_ring(&ring, &field))
    }

    fn known(&mut self, k: usize, map: Map) -> bool {
        let decided = map.jacobian.strict().is_some() || map.jacobian.changes();
        self.found.winding = map.half_plane.is_some().then_some(k);
        (self.found.jacobian, self.found.half_plane) = (Some(map.jacobian), map.half_plane);
        decided && self.found.winding.is_some()
    }
}

/// Points `x + y ω` in the true plane.
#[allow(clippy::float_arithmetic, reason = "pictures only")]
fn outline(field: &Enclosures, patches: &[Net<(f64, f64)>]) -> Vec<Net<(f64, f64)>> {
    let cosine = field.to_f64(&field.twice_cosine()) / 2.0;
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    patches.iter().map(|p| p.map(|(x, y)| (x + y * cosine, y * sine))).collect()
}

/// The minimal polynomial of the leading eigenvalue, where its equation is linear in `t` and of moderate degree.
fn minimal(vertex: &Vertex, top: &Top) -> Option<Poly> {
    if let Some(q) = &top.rational {
        return Some(Poly::linear(q));
    }
    let modulus = minimal_polynomial(vertex.valence / gcd(top.angle, vertex.valence));
    let degree = modulus.degree()?;
    if top.poly.iter().any(|c| c.degree().is_some_and(|d| d > 1)) || degree * (top.poly.len() - 1) > DISPLAY_DEGREE {
        return None;
    }
    // P = A + t B vanishes with t a root of ψ where B^d ψ(−A/B) does.
    let a = Poly::new(top.poly.iter().map(|c| c.coeff(0)).collect());
    let b = Poly::new(top.poly.iter().map(|c| c.coeff(1)).collect());
    let mut norm = Poly::zero();
    for (i, c) in modulus.coeffs().iter().enumerate() {
        norm = &norm + &(&(-&a).pow(i) * &b.pow(degree - i)).scale(c);
    }
    let vanishes = |f: &Poly| {
        let field = Enclosures::with_twice_cosine(&Interval::point(Rational::from(0)), 160);
        let value = field.eval(f, &field.interval(&top.enclosure));
        field.sign(&value).is_none_or(|s| s == 0)
    };
    let mut near = factor(&norm).into_iter().map(|(f, _)| f).filter(vanishes);
    let found = near.next()?;
    near.next().is_none().then_some(found)
}

/// The leading eigenvalue in floating point, for display.
#[must_use]
pub fn decimal(top: &Top) -> f64 {
    to_f64(&top.enclosure.mid())
}
