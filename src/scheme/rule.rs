//! What a mesh rule is: a row of the table in `rules`, with the numbers that it was given.
//!
//! A row says how a step divides the faces, which weights the new points have, and which they have at the centre, as
//! functions of the number `n` of faces there. Stencils, Fourier blocks, patches and proofs are computed from it.

use super::SchemeError;
use super::mesh::Sector;
use super::own::OwnRule;
use super::registry::{Parameter, Values};
use crate::arith::{Rational, ratio};
use crate::poly::Poly;
use std::sync::Arc;

/// How a step divides the faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Split {
    /// Every quadrangle into four, with points at vertices, on edges and inside.
    Quads,
    /// Every triangle into four, with points at vertices and on edges.
    Triangles,
    /// Quadrangles and triangles into four, linearly; then every point is averaged with its neighbours.
    Averaged,
    /// Dual: a smaller copy of every face, joined across edges and vertices.
    Corners,
    /// A point in every triangle, joined across the edges; two steps divide in nine.
    TurnedTriangles,
    /// A point in every quadrangle, joined across the edges; two steps divide in four.
    TurnedQuads,
}

impl Split {
    /// The faces around a vertex where they are all of one kind.
    #[must_use]
    pub fn sector(self) -> Sector {
        match self {
            Self::Triangles | Self::TurnedTriangles => Sector::Triangles,
            Self::Quads | Self::Averaged | Self::Corners | Self::TurnedQuads => Sector::Quads,
        }
    }

    /// Steps after which the mesh has its old directions again.
    #[must_use]
    pub fn steps(self) -> usize {
        if matches!(self, Self::TurnedTriangles | Self::TurnedQuads) { 2 } else { 1 }
    }

    /// How many times finer the lattice is after [`Split::steps`].
    #[must_use]
    pub fn factor(self) -> i64 {
        if self == Self::TurnedTriangles { 3 } else { 2 }
    }
}

/// The spline that a scheme is away from the centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Spline {
    /// Bicubic.
    Bicubic,
    /// Biquadratic.
    Biquadratic,
    /// Loop's quartic box spline on triangles.
    Quartic,
    /// Zwart's and Powell's quadratic box spline, four triangles in a square.
    Quadratic,
}

/// The weights of the new point at an old vertex, as polynomials in `t = 2cos(2π/n)`; constant where they are rational.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Star {
    /// Of the vertex itself.
    pub own: Poly,
    /// Of all edge neighbours together.
    pub near: Poly,
    /// Of all opposite corners of quadrangles together.
    pub opposite: Poly,
}

impl Star {
    /// Some weight for all neighbours together, the rest for the vertex.
    pub fn near(near: Poly) -> Self {
        Self { own: &Poly::constant(ratio(1, 1)) - &near, near, opposite: Poly::zero() }
    }

    /// Weights that are numbers, in the order of the fields.
    pub fn numbers(own: Rational, near: Rational, opposite: Rational) -> Self {
        let [own, near, opposite] = [own, near, opposite].map(Poly::constant);
        Self { own, near, opposite }
    }

    /// The weights where they are rational.
    pub fn rational(&self, n: usize) -> Option<[Rational; 3]> {
        let value = |p: &Poly| match p.degree() {
            None | Some(0) => Some(p.coeff(0)),
            Some(_) => Some(p.eval(&(ratio(2, 1) * rational_cosine(1, n)?))),
        };
        Some([value(&self.own)?, value(&self.near)?, value(&self.opposite)?])
    }
}

/// The weights of the new point on an edge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Edge {
    /// Of each end.
    pub end: Rational,
    /// Of each further corner of the two faces at the edge.
    pub side: Rational,
    /// Of the corners of the triangles beyond those faces.
    pub far: Rational,
}

/// Weights all around a centre, from the own spoke or corner on:
/// `w_j = own δ_j + next (δ_{j,1} + δ_{j,n−1}) + (1/n) Σ_k ŵ_k ω^{jk}`, `ω = e^{2πi/n}`, over all frequencies `k`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Wheel {
    /// What the own one has beside the waves.
    pub own: Rational,
    /// What the two next to it have beside the waves.
    pub next: Rational,
    /// Frequencies from 0 to `n/2`, each standing for its negative too, with `ŵ`.
    pub waves: Vec<(usize, Rational)>,
}

impl Wheel {
    /// The sum of the weights.
    pub fn total(&self) -> Rational {
        self.wave(0) + &self.own + &self.next * ratio(2, 1)
    }

    fn wave(&self, k: usize) -> Rational {
        self.waves.iter().filter(|(f, _)| *f == k).fold(ratio(0, 1), |sum, (_, w)| sum + w)
    }

    /// The eigenvalue of the weights on nets of frequency `k` from 0 to `n/2`, in `t = 2cos(2πk/n)`.
    pub fn eigenvalue(&self, k: usize) -> Poly {
        if k == 0 {
            return Poly::constant(self.total());
        }
        Poly::new(vec![self.wave(k) + &self.own, self.next.clone()])
    }

    /// Whether weights have cosines in them.
    pub fn waving(&self) -> bool {
        self.waves.iter().any(|(k, w)| *k > 0 && *w != 0)
    }

    /// The weight of the `j`-th: a number, and multiples of `cos(2πm/n)` by `m`.
    pub fn weight(&self, j: usize, n: usize) -> (Rational, Vec<(usize, Rational)>) {
        let mut plain = if j == 0 { self.own.clone() } else { ratio(0, 1) };
        if j == 1 || j + 1 == n {
            plain += &self.next;
        }
        let mut cosines = Vec::new();
        for (k, wave) in &self.waves {
            let both = if *k == 0 || 2 * k == n { 1 } else { 2 };
            let weight = wave * ratio(both, 1) / Rational::from(n as u64);
            if *k == 0 {
                plain += weight;
            } else {
                cosines.push((k * j % n, weight));
            }
        }
        (plain, cosines)
    }

    /// All weights, where they are rational.
    pub fn rational(&self, n: usize) -> Option<Vec<Rational>> {
        let weight = |j| {
            let (plain, cosines) = self.weight(j, n);
            cosines.into_iter().try_fold(plain, |sum, (m, w)| Some(sum + rational_cosine(m, n)? * w))
        };
        (0..n).map(weight).collect()
    }
}

/// The weights of the corners of a face.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Corners {
    /// By a formula.
    Wheel(Wheel),
    /// One for each corner.
    List(Vec<Rational>),
}

/// How faces are divided, and the weights of new points at vertices, on edges and in corners where all is regular.
pub(crate) type Lattice = (Split, Option<Star>, Option<Edge>, Option<Corners>, Option<OwnRule>);

pub(super) type StarOf = fn(&Values, usize) -> Star;
pub(super) type WheelOf = fn(&Values, usize) -> Wheel;

/// The weights of the new points of a rule; where `centre` is given, it holds for the centre in place of the usual ones.
#[derive(Debug, Clone, Copy)]
pub(super) enum Points {
    /// At vertices; on edges, where the split has points there; on the edges at the centre of an extraordinary vertex.
    Kept { star: StarOf, centre: Option<StarOf>, edge: Option<fn(&Values) -> Edge>, spokes: Option<WheelOf> },
    /// In the corners of faces.
    Corners { wheel: WheelOf, centre: Option<WheelOf> },
    /// Of [`Split::Averaged`].
    Averaged,
    /// Given by stencils beside the row.
    Own,
}

/// The characteristic map at all valences: a parameter that covers `t = 2cos(2π/n)` of every valence from some valence on
/// (docs/theory.md, Theorem 9).
#[derive(Debug, Clone)]
pub struct AllValences {
    /// The first valence.
    pub from: usize,
    /// `t` in the parameter: numerator and denominator.
    pub twice_cosine: (Poly, Poly),
    /// The leading eigenvalue of block 1 in the parameter.
    pub eigenvalue: Poly,
    /// Where the parameter lies.
    pub interval: (Rational, Rational),
    /// What the parameter is.
    pub setting: &'static str,
    /// What positive polynomials in the parameter say of the other eigenvalues.
    pub claims: Vec<(&'static str, Poly)>,
}

/// A named mesh rule: a row of the table.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct RuleInfo {
    /// Its name.
    pub name: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// A weight that is 1 minus all parameters, and may be written too.
    pub rest: Option<&'static str>,
    /// The name under which all weights of the centre may be given one by one.
    pub list: Option<&'static str>,
    /// Where it was published.
    pub source: &'static str,
    /// What it is, in one line; for which valences its weights are rational.
    pub summary: &'static str,
    /// What its matrices over number fields are, where its weights are irrational.
    pub over_fields: Option<&'static str>,
    /// The name of its family, for messages.
    pub family: &'static str,
    /// How it divides faces.
    pub split: Split,
    /// What it is away from the centre.
    pub spline: Option<Spline>,
    /// What else its parameters must be.
    pub(super) check: fn(&Values) -> Result<(), SchemeError>,
    pub(super) points: Points,
    /// Its characteristic map at all valences, where that is a rational function of a parameter.
    pub(super) every: Option<fn() -> AllValences>,
}

impl RuleInfo {
    /// Whether its characteristic map is known at all valences at once.
    #[must_use]
    pub fn has_all_valences(&self) -> bool {
        self.every.is_some()
    }
}

/// What stands in for the weights of the row at the centre.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Centre {
    /// Nothing.
    Row,
    /// The weights of all other places.
    Usual,
    /// A weight of all neighbours together.
    Near(Rational),
    /// The weights of the corners of the central face.
    List(Vec<Rational>),
}

/// A rule on meshes: a row of the table ([`super::mesh_rules`]) with the numbers that it was given, which hold for the
/// centre; all other vertices take the regular rule.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, scheme::{Split, mesh_rule}};
/// let rule = mesh_rule("loop-variant", &[("beta".to_owned(), ratio(1, 20))].into())?;
/// assert_eq!((rule.name(), rule.info().split), ("Loop", Split::Triangles));
/// assert_eq!(rule.weights(), [("beta", "1/20".to_owned())]);
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct MeshRule {
    info: &'static RuleInfo,
    given: Values,
    centre: Centre,
    own: Option<Arc<OwnRule>>,
}

impl PartialEq for MeshRule {
    fn eq(&self, other: &Self) -> bool {
        let parts = |r: &Self| (r.info.name, r.given.clone(), r.centre.clone(), r.own.clone());
        parts(self) == parts(other)
    }
}

impl Eq for MeshRule {}

impl MeshRule {
    pub(super) fn new(info: &'static RuleInfo, given: Values) -> Result<Self, SchemeError> {
        (info.check)(&given)?;
        Ok(Self { info, given, centre: Centre::Row, own: None })
    }

    /// A rule by stencils of one's own.
    ///
    /// # Errors
    /// [`SchemeError::Mesh`] where a stencil is missing or its weights do not add up to 1. Those of the centre are looked at for
    /// each valence ([`MeshRule::check_at`]).
    pub fn of_stencils(own: OwnRule) -> Result<Self, SchemeError> {
        let info = own.row()?;
        Ok(Self { info, given: Values::none(), centre: Centre::Row, own: Some(Arc::new(own)) })
    }

    pub(super) fn own_stencils(&self) -> Option<&Arc<OwnRule>> {
        self.own.as_ref()
    }

    /// The least distance from the centre, in faces of the mesh, from which on the rule is its spline: 1, or 2 where points on the
    /// edges or in the faces at the centre have stencils of their own.
    #[must_use]
    pub fn regular_from(&self) -> i64 {
        if self.own.as_ref().is_some_and(|own| own.widened()) { 2 } else { 1 }
    }

    /// The row of the table.
    #[must_use]
    pub fn info(&self) -> &'static RuleInfo {
        self.info
    }

    /// The name of its family, used in messages.
    #[allow(clippy::misnamed_getters, reason = "rows of one family have one name in messages")]
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.info.family
    }

    /// The weights that the rule was given, by the names of the parameters; none of a rule with fixed weights.
    #[must_use]
    pub fn weights(&self) -> Vec<(&'static str, String)> {
        if let Some(own) = &self.own {
            return vec![("stencils", own.describe())];
        }
        if let (Centre::List(list), Some(name)) = (&self.centre, self.info.list) {
            return vec![(name, list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))];
        }
        let numbers = self.info.parameters.iter().map(|p| (p.name, self.given.number(p.name)));
        let rest = self.info.rest.map(|name| (name, self.given.rest().to_string()));
        numbers.map(|(name, value)| (name, value.to_string())).chain(rest).collect()
    }

    /// The same rule with weights of the corners of the central face, from the own corner on.
    ///
    /// # Errors
    /// [`SchemeError::Mesh`] where the row does not take a list ([`RuleInfo::list`]). How many weights are needed, and that
    /// they add up to 1, is looked at for each valence.
    pub fn with_weights(self, weights: Vec<Rational>) -> Result<Self, SchemeError> {
        match self.info.list {
            Some(_) => Ok(Self { centre: Centre::List(weights), ..self }),
            None => Err(self.error("this rule takes no list of weights")),
        }
    }

    /// The faces around a vertex where they are all of one kind.
    #[must_use]
    pub fn sector(&self) -> Sector {
        self.info.split.sector()
    }

    /// Steps after which the mesh has its old directions again.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.info.split.steps()
    }

    /// Whether the centre is a face.
    #[must_use]
    pub fn dual(&self) -> bool {
        self.info.split == Split::Corners
    }

    /// What holds for all valences at once, where the row says so.
    #[must_use]
    pub fn all_valences(&self) -> Option<AllValences> {
        self.info.every.filter(|_| self.centre == Centre::Row).map(|family| family())
    }

    /// The rule of all places but the centre.
    pub(crate) fn regular(&self) -> Self {
        let own = self.own.as_ref().map(|own| Arc::new(own.without_centre()));
        Self { centre: Centre::Usual, own, ..self.clone() }
    }

    /// What the rule does away from the centre: rules that agree in this have the same regular meshes.
    pub(crate) fn lattice(&self) -> Lattice {
        let regular = self.regular();
        let n = self.regular_valence();
        let own = self.own.as_ref().map(|own| own.without_centre());
        (self.info.split, regular.star(n, false), regular.edge(), regular.corners(n, false), own)
    }

    fn regular_valence(&self) -> usize {
        if self.sector() == Sector::Triangles { 6 } else { 4 }
    }

    /// The rule with this weight of all neighbours of the centre together.
    pub(crate) fn with_near(&self, weight: Rational) -> Self {
        Self { centre: Centre::Near(weight), ..self.clone() }
    }

    /// The rule with these weights of the corners of the central face.
    pub(crate) fn with_corners(&self, weights: Vec<Rational>) -> Self {
        Self { centre: Centre::List(weights), ..self.clone() }
    }

    /// Whether the centre has weights of its own, at the regular valence too.
    pub(crate) fn own_weights(&self) -> bool {
        let own = match self.info.points {
            Points::Kept { centre, spokes, .. } => centre.is_some() || spokes.is_some(),
            Points::Corners { centre, .. } => centre.is_some(),
            Points::Averaged => false,
            Points::Own => true,
        };
        match self.centre {
            Centre::Row => own,
            Centre::Usual => false,
            Centre::Near(_) | Centre::List(_) => true,
        }
    }

    /// Whether all is regular at a centre of a valence.
    pub(crate) fn regular_at(&self, n: usize) -> bool {
        let own = match &self.own {
            Some(own) => own.has_centre(n),
            None => self.own_weights(),
        };
        n == self.regular_valence() && !own
    }

    /// The weights of the new point at a vertex of `n` faces; `None` where a row has none.
    pub(crate) fn star(&self, n: usize, central: bool) -> Option<Star> {
        let Points::Kept { star, centre, .. } = self.info.points else { return None };
        Some(match (&self.centre, central) {
            (Centre::Near(weight), true) => Star::near(Poly::constant(weight.clone())),
            (Centre::Row, true) => centre.unwrap_or(star)(&self.given, n),
            _ => star(&self.given, n),
        })
    }

    /// The weights of the new point on an edge.
    pub(crate) fn edge(&self) -> Option<Edge> {
        match self.info.points {
            Points::Kept { edge, .. } => edge.map(|edge| edge(&self.given)),
            Points::Corners { .. } | Points::Averaged | Points::Own => None,
        }
    }

    /// The weights of the neighbours of the centre in the new point on a spoke, where they are not those of other edges.
    pub(crate) fn spokes(&self, n: usize) -> Option<Wheel> {
        let Points::Kept { spokes: Some(wheel), .. } = self.info.points else { return None };
        (self.centre == Centre::Row && n != self.regular_valence()).then(|| wheel(&self.given, n))
    }

    /// The weights of the corners of a face in a new corner.
    pub(crate) fn corners(&self, n: usize, central: bool) -> Option<Corners> {
        let Points::Corners { wheel, centre } = self.info.points else { return None };
        Some(match (&self.centre, central) {
            (Centre::List(weights), true) => Corners::List(weights.clone()),
            (Centre::Row, true) => Corners::Wheel(centre.unwrap_or(wheel)(&self.given, n)),
            _ => Corners::Wheel(wheel(&self.given, n)),
        })
    }

    /// Whether the weights at the centre add up to 1 at a valence, and stencils of one's own are symmetric there.
    ///
    /// # Errors
    /// What is wrong.
    pub fn check_at(&self, n: usize) -> Result<(), SchemeError> {
        if let Some(own) = &self.own {
            return own.elements().iter().try_for_each(|element| own.central(*element, n).map(|_| ()));
        }
        match self.corners(n, true) {
            Some(Corners::Wheel(wheel)) if wheel.total() != 1 => {
                let expected = "weights of a frequency that is a multiple of the valence do not add up to 1";
                let (name, value) = self.weights().into_iter().next().unwrap_or(("weights", wheel.total().to_string()));
                Err(SchemeError::value(name, &value, expected))
            }
            _ => Ok(()),
        }
    }

    pub(super) fn error(&self, message: &str) -> SchemeError {
        SchemeError::Mesh { rule: self.name().to_owned(), message: message.to_owned() }
    }

    pub(super) fn irrational(&self, valence: usize) -> SchemeError {
        SchemeError::Irrational(format!("the rule {} at valence {valence} (cos(2π/{valence}))", self.name()))
    }
}

/// `cos(2πk/n)` where it is rational.
#[must_use]
pub fn rational_cosine(k: usize, n: usize) -> Option<Rational> {
    // The angle in twelfths of a turn, where it is a whole number of them.
    if n == 0 || !(12 * k).is_multiple_of(n) {
        return None;
    }
    match (12 * k / n) % 12 {
        0 => Some(ratio(1, 1)),
        2 | 10 => Some(ratio(1, 2)),
        3 | 9 => Some(ratio(0, 1)),
        4 | 8 => Some(ratio(-1, 2)),
        6 => Some(ratio(-1, 1)),
        _ => None,
    }
}
