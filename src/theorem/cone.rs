//! Theorem 6: strictly invariant cones, and what they say about every point of a curve.

use super::cone_search::{Frame, propose};
use crate::algebraic::Root;
use crate::arith::{Interval, Rational};
use crate::jordan::Spectrum;
use crate::linalg::{Matrix, dot};
use crate::shape::{CellKind, End, Shape, Spaces, difference};

/// The image of a cone by one piece: `ε T_i G_target = G_e B`, `B > 0`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConeMap {
    /// The state of the piece.
    pub state: usize,
    /// Its letter.
    pub letter: usize,
    /// `−1` for a piece run backwards, otherwise `1`.
    pub sign: i32,
    /// `B`.
    pub matrix: Matrix,
}

/// The cone of one state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cone {
    /// The state.
    pub state: usize,
    /// `G`: the rays as columns, in the barycentric coordinates of the state.
    pub rays: Matrix,
    /// `f` with `f G > 0`.
    pub functional: Vec<Rational>,
    /// `y >= 0`, not 0, with `chord = G y`.
    pub chord: Vec<Rational>,
}

/// The certificate of Theorem 6.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CommonCone {
    /// One cone for every reachable state.
    pub cones: Vec<Cone>,
    /// One map for every piece of a reachable state.
    pub maps: Vec<ConeMap>,
    /// `h` with `h P G > 0` for the start state, where control points are given and one was found.
    pub view: Option<Vec<Rational>>,
    /// The largest cross-ratio `B_ij B_kl / (B_kj B_il)`: the cones shrink by `(√D − 1)/(√D + 1)` a letter (Birkhoff).
    pub cross_ratio: Rational,
}

/// Why there is no cone.
#[derive(Debug, Clone)]
pub struct ConeObstacle {
    /// The state of a cycle.
    pub state: usize,
    /// The cycle.
    pub word: Vec<usize>,
    /// The linear part on `V`, times the orientation signs of the cycle.
    pub product: Matrix,
    /// Its eigenvalues of largest modulus.
    pub leading: Vec<Root>,
    /// What is wrong with them.
    pub reason: &'static str,
}

/// The answer to the search for a common cone.
#[derive(Debug, Clone)]
pub enum ConeAnswer {
    /// A proved cone: both half-tangents exist at every point, and the curve is G¹ if they agree at the first-level joints.
    Proved(CommonCone),
    /// No cone exists.
    Refuted(ConeObstacle),
    /// Neither was found.
    Undetermined,
}

/// Longest cycle examined for an obstacle.
const MAX_CYCLE: usize = 6;

/// Searches strictly invariant cones for all reachable edge states.
///
/// Returns `None` for shapes that are no curves, or whose end points are not unique. Adjacency is taken as checked.
///
/// # Cost
/// Some thousand small linear programs; spectra of a few hundred short cycles where no cone is found.
#[must_use]
pub fn common_cone(shape: &Shape, spaces: &Spaces) -> Option<ConeAnswer> {
    let frame = frame(shape, spaces)?;
    let attempts = if frame.dims.iter().any(|d| *d > 5) { 3 } else { 8 };
    for attempt in 0..attempts {
        if let Some(rays) = propose(&frame, attempt)
            && let Some(cone) = exact(shape, spaces, &frame, &rays)
            && cone.holds(shape, spaces)
        {
            return Some(ConeAnswer::Proved(cone));
        }
        if attempt == 1
            && let Some(obstacle) = obstacle(&frame)
        {
            return Some(ConeAnswer::Refuted(obstacle));
        }
    }
    Some(ConeAnswer::Undetermined)
}

fn frame(shape: &Shape, spaces: &Spaces) -> Option<Frame> {
    let states = shape.reachable();
    let mut frame = Frame { states: states.clone(), dims: Vec::new(), chords: Vec::new(), maps: Vec::new() };
    for (k, &e) in states.iter().enumerate() {
        let state = &shape.states[e];
        if state.kind != CellKind::Edge || spaces.of(e).basis.cols() == 0 {
            return None;
        }
        let chord = difference(&shape.end_point(e, End::Finish)?, &shape.end_point(e, End::Start)?);
        frame.chords.push(spaces.of(e).coordinates.apply(&chord));
        frame.dims.push(spaces.of(e).basis.cols());
        for (letter, piece) in state.pieces.iter().enumerate() {
            let sign = if piece.reversed { -1 } else { 1 };
            let to = states.iter().position(|s| *s == piece.target)?;
            let matrix = spaces.linear(&piece.op, e, piece.target).scale(&Rational::from(sign));
            frame.maps.push((k, letter, to, matrix));
        }
    }
    Some(frame)
}

/// The exact certificate for proposed rays (in coordinates of `V`).
fn exact(shape: &Shape, spaces: &Spaces, frame: &Frame, rays: &[Vec<Vec<Rational>>]) -> Option<CommonCone> {
    let mut cones = Vec::new();
    for (k, &state) in frame.states.iter().enumerate() {
        let local = Matrix::from_columns(frame.dims[k], &rays[k]);
        let chord = combine(&rays[k], &frame.chords[k])?;
        let functional = super::cone_search::functional(&rays[k])?;
        let functional = spaces.of(state).coordinates.apply_left(&functional);
        cones.push(Cone { state, rays: &spaces.of(state).basis * &local, functional, chord });
    }
    let mut maps = Vec::new();
    let mut cross_ratio = Rational::from(1);
    for (from, letter, to, matrix) in &frame.maps {
        let columns: Option<Vec<Vec<Rational>>> =
            rays[*to].iter().map(|r| interior(&rays[*from], &matrix.apply(r))).collect();
        let b = Matrix::from_columns(rays[*from].len(), &columns?);
        cross_ratio = cross_ratio.max(largest_cross_ratio(&b)?);
        let state = frame.states[*from];
        let sign = if shape.states[state].pieces[*letter].reversed { -1 } else { 1 };
        maps.push(ConeMap { state, letter: *letter, sign, matrix: b });
    }
    let view = shape.control.as_ref().and_then(|p| {
        let images = p * &cones[0].rays;
        super::cone_search::functional(&(0..images.cols()).map(|j| images.column(j)).collect::<Vec<_>>())
    });
    Some(CommonCone { cones, maps, view, cross_ratio })
}

/// Nonnegative exact coefficients of a vector of the cone.
fn combine(rays: &[Vec<Rational>], x: &[Rational]) -> Option<Vec<Rational>> {
    let basis = super::cone_search::carrier(rays, x)?;
    let columns: Vec<Vec<Rational>> = basis.iter().map(|k| rays[*k].clone()).collect();
    let right = Matrix::from_columns(x.len(), &[x.to_vec()]);
    let solution = Matrix::from_columns(x.len(), &columns).solve(&right)?.column(0);
    let mut out = vec![Rational::from(0); rays.len()];
    for (k, c) in basis.into_iter().zip(solution) {
        if c < 0 {
            return None;
        }
        out[k] = c;
    }
    Some(out)
}

/// Positive exact coefficients of an inner vector of the cone: a small share of every ray, the rest on a basis.
fn interior(rays: &[Vec<Rational>], x: &[Rational]) -> Option<Vec<Rational>> {
    let mut share = super::cone_search::share(rays, x)?;
    for _ in 0..24 {
        let mut rest = x.to_vec();
        for r in rays {
            rest.iter_mut().zip(r).for_each(|(a, b)| *a -= &share * b);
        }
        if let Some(c) = combine(rays, &rest) {
            return Some(c.into_iter().map(|v| v + &share).collect());
        }
        share /= Rational::from(2);
    }
    None
}

/// The largest `B_ij B_kl / (B_kj B_il)`; `None` where an entry is not positive.
fn largest_cross_ratio(b: &Matrix) -> Option<Rational> {
    let mut largest = Rational::from(1);
    for j in 0..b.cols() {
        for l in 0..j {
            let ratios: Option<Vec<Rational>> =
                (0..b.rows()).map(|i| (b[(i, j)] > 0 && b[(i, l)] > 0).then(|| &b[(i, j)] / &b[(i, l)])).collect();
            let ratios = ratios?;
            if let (Some(hi), Some(lo)) = (ratios.iter().max(), ratios.iter().min()) {
                largest = largest.max(hi / lo);
            }
        }
    }
    (0..b.rows()).all(|i| b.row(i).iter().all(|x| *x > 0)).then_some(largest)
}

impl CommonCone {
    /// Whether all hypotheses of Theorem 6 on the cones hold, by multiplication.
    #[must_use]
    pub fn holds(&self, shape: &Shape, spaces: &Spaces) -> bool {
        let cone = |state: usize| self.cones.iter().find(|c| c.state == state);
        let states = shape.reachable();
        states.iter().all(|&e| cone(e).is_some_and(|c| c.holds(shape, spaces)))
            && states.iter().all(|&e| {
                shape.states[e].pieces.iter().enumerate().all(|(letter, piece)| {
                    let map = self.maps.iter().find(|m| (m.state, m.letter) == (e, letter));
                    let (Some(map), Some(from), Some(to)) = (map, cone(e), cone(piece.target)) else { return false };
                    let sign = if piece.reversed { -1 } else { 1 };
                    let b = &map.matrix;
                    map.sign == sign
                        && (b.rows(), b.cols()) == (from.rays.cols(), to.rays.cols())
                        && (0..b.rows()).all(|i| b.row(i).iter().all(|x| *x > 0))
                        && (&piece.op * &to.rays).scale(&Rational::from(sign)) == &from.rays * b
                })
            })
    }

    /// The factor `(√D − 1)/(√D + 1)` by which the cones shrink with every letter.
    #[must_use]
    pub fn shrink(&self) -> Interval {
        let one = Interval::point(Rational::from(1));
        let root = crate::radius::square_root(&self.cross_ratio, 64);
        let (top, bottom) = (&root - &one, &root + &one);
        Interval::new(&top.lo / &bottom.hi, &top.hi / &bottom.lo)
    }

    /// A lower bound of the Hölder exponent of the tangent in the uniform parameter, where every state has `arity` pieces.
    #[must_use]
    pub fn tangent_exponent(&self, arity: usize) -> Option<Rational> {
        super::regularity::minus_log(&self.shrink(), arity).map(|e| e.lo)
    }
}

impl Cone {
    fn holds(&self, shape: &Shape, spaces: &Spaces) -> bool {
        let space = spaces.of(self.state);
        let ends = (shape.end_point(self.state, End::Start), shape.end_point(self.state, End::Finish));
        let (Some(start), Some(finish)) = ends else { return false };
        let inside = &space.basis * &(&space.coordinates * &self.rays) == self.rays;
        shape.states[self.state].kind == CellKind::Edge
            && self.rays.rows() == shape.states[self.state].dim
            && inside
            && self.rays.rank() == space.basis.cols()
            && (0..self.rays.cols()).all(|j| dot(&self.functional, &self.rays.column(j)) > 0)
            && self.chord.len() == self.rays.cols()
            && self.chord.iter().all(|y| *y >= 0)
            && self.chord.iter().any(|y| *y > 0)
            && self.rays.apply(&self.chord) == difference(&finish, &start)
    }
}

/// A short cycle whose product admits no strictly invariant pointed cone.
fn obstacle(frame: &Frame) -> Option<ConeObstacle> {
    let mut layer: Vec<(usize, usize, Vec<usize>, Matrix)> =
        (0..frame.dims.len()).map(|s| (s, s, Vec::new(), Matrix::identity(frame.dims[s]))).collect();
    for _ in 0..MAX_CYCLE {
        let mut next = Vec::new();
        for (start, end, word, product) in layer {
            for (_, letter, to, matrix) in frame.maps.iter().filter(|m| m.0 == end) {
                let mut word = word.clone();
                word.push(*letter);
                let product = &product * matrix;
                if *to == start
                    && let Some((leading, reason)) = defect(&product)
                {
                    return Some(ConeObstacle { state: frame.states[start], word, product, leading, reason });
                }
                next.push((start, *to, word, product));
            }
        }
        layer = next;
        if layer.len() > 400 {
            return None;
        }
    }
    None
}

fn defect(product: &Matrix) -> Option<(Vec<Root>, &'static str)> {
    let spectrum = Spectrum::of(product);
    let members = &spectrum.classes.first()?.members;
    let leading: Vec<Root> = members.iter().map(|e| spectrum.root(*e).clone()).collect();
    let first = &leading[0];
    let reason = if first.is_zero() {
        "nilpotent"
    } else if leading.iter().any(|r| !r.is_real()) {
        "complex eigenvalues of largest modulus"
    } else if leading.len() > 1 {
        "eigenvalues of equal largest modulus"
    } else if spectrum.factors[members[0].factor].multiplicity > 1 {
        "a multiple eigenvalue of largest modulus"
    } else if first.sign() < 0 {
        "a negative leading eigenvalue"
    } else {
        return None;
    };
    Some((leading, reason))
}
