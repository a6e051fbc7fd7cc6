//! Theorems 6 and 6′: invariant cones, and what they say about every point of a curve.

use super::cone_search::{ExactRays, Frame, propose, propose_closed};
use super::gap::Defect;
use super::slow::{self, MAX_WINDOW, SlowCycle};
use crate::algebraic::Root;
use crate::arith::{Integer, Interval, Rational};
use crate::jordan::leading_roots;
use crate::linalg::{Matrix, dot};
use crate::shape::{CellKind, End, Shape, Spaces, difference};
use crate::statement::Statement;
use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
use std::collections::BTreeSet;

/// The image of a cone by one piece: `ε T_i G_target = G_e B`, `B >= 0` without a zero column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConeMap<E = Rational> {
    /// The state of the piece.
    pub state: usize,
    /// Its letter.
    pub letter: usize,
    /// `−1` for a piece run backwards, otherwise `1`.
    pub sign: i32,
    /// `B`.
    pub matrix: Matrix<E>,
}

/// The cone of one state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cone<E = Rational> {
    /// The state.
    pub state: usize,
    /// `G`: the rays as columns, in the barycentric coordinates of the state.
    pub rays: Matrix<E>,
    /// `f` with `f G > 0`.
    pub functional: Vec<E>,
    /// `y >= 0`, not 0, with `chord = G y`.
    pub chord: Vec<E>,
}

/// The certificate of Theorem 6, or of Theorem 6′ where some `B` is not positive.
#[derive(Debug, Clone)]
pub struct CommonCone {
    /// One cone for every reachable state.
    pub cones: Vec<Cone>,
    /// One map for every piece of a reachable state.
    pub maps: Vec<ConeMap>,
    /// `h` with `h P G > 0` for the start state, where control points are given and one was found.
    pub view: Option<Vec<Rational>>,
    /// The length of the words in which factors with a positive product are looked for; 1 in Theorem 6.
    pub window: usize,
    /// The cycles that end all addresses without such factors; none in Theorem 6.
    pub slow: Vec<SlowCycle>,
    /// How fast the cones shrink; `None` where they do so at no uniform geometric rate that was found.
    pub rate: Option<ConeRate>,
}

/// Products of `length` letters have cross-ratios `B_ij B_kl / (B_kj B_il)` of at most `cross_ratio = D`, so that they shrink the
/// cones by `(√D − 1)/(√D + 1)` (Birkhoff).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConeRate {
    /// How many letters.
    pub length: usize,
    /// The largest cross-ratio.
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
    pub reason: Defect,
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
/// Some thousand small linear programs; leading eigenvalues of a few hundred short cycles where no cone is found.
#[must_use]
pub fn common_cone(shape: &Shape, spaces: &Spaces, steps: usize) -> Option<ConeAnswer> {
    let frame = frame(shape, spaces, steps)?;
    let attempts = match frame.dims.iter().max() {
        Some(0..=5) => 8,
        Some(0..=16) => 3,
        _ => 1,
    };
    for attempt in 0..attempts {
        if let Some(rays) = propose(&frame, attempt) {
            // Short numbers make short proofs; the margin of the proposal often allows them.
            let short = proved_cone(shape, spaces, &frame, &coarse(&rays), 1);
            if let Some(cone) = short.or_else(|| proved_cone(shape, spaces, &frame, &rays, 1)) {
                return Some(ConeAnswer::Proved(cone));
            }
        }
        if attempt == 1.min(attempts - 1)
            && let Some(obstacle) = obstacle(&frame)
        {
            let cone = closed_cone(shape, spaces, &frame);
            return Some(cone.map_or(ConeAnswer::Refuted(obstacle), ConeAnswer::Proved));
        }
    }
    Some(closed_cone(shape, spaces, &frame).map_or(ConeAnswer::Undetermined, ConeAnswer::Proved))
}

/// Cones of Theorem 6′.
fn closed_cone(shape: &Shape, spaces: &Spaces, frame: &Frame) -> Option<CommonCone> {
    proved_cone(shape, spaces, frame, &propose_closed(frame)?, MAX_WINDOW)
}

/// A complete prefix code, each word with a functional.
pub type Code = Vec<(Vec<usize>, Vec<Rational>)>;

/// Cones for Theorem 11″: of all states that can be reached from `start`, with a complete prefix code of at most `most` words of
/// at most `longest` letters, each with a functional that is positive on its cone as it is seen through `view`, a map of `start`;
/// the search takes at most `steps` steps of linear programs.
pub fn cone_in_sight(
    shape: &Shape,
    spaces: &Spaces,
    start: usize,
    view: &Matrix,
    (longest, most, steps): (usize, usize, usize),
) -> Option<(CommonCone, Code)> {
    let own = Shape { start, control: None, ..shape.clone() };
    let frame = frame(&own, spaces, steps)?;
    let proposals: [&dyn Fn() -> Option<Proposal>; 4] =
        [&|| polygons(&own, spaces, &frame), &|| propose_closed(&frame), &|| propose(&frame, 0), &|| {
            propose(&frame, 1)
        }];
    proposals.into_iter().find_map(|proposal| {
        let cone = exact(&own, spaces, &frame, &proposal()?, true).filter(|c| c.invariant(&own, spaces))?;
        let cone = CommonCone { window: 0, ..cone };
        let code = code(&own, &cone, view, (longest, most))?;
        Some((cone, code))
    })
}

/// Rays by state, in coordinates of `V`.
type Proposal = Vec<Vec<Vec<Rational>>>;

/// The steps from each control point of a state to the next, where all of them are relevant.
fn polygons(shape: &Shape, spaces: &Spaces, frame: &Frame) -> Option<Proposal> {
    let of_state = |&e: &usize| {
        let (n, space) = (shape.states[e].dim, spaces.of(e));
        let step = |k: usize| {
            let entry = |i: usize| Rational::from(i32::from(i == k + 1) - i32::from(i == k));
            let v: Vec<Rational> = (0..n).map(entry).collect();
            let local = space.coordinates.apply(&v);
            (space.basis.apply(&local) == v).then_some(local)
        };
        (0..n - 1).map(step).collect::<Option<Vec<_>>>()
    };
    frame.states.iter().map(of_state).collect()
}

/// Words are made longer until a functional sees the cone behind each.
fn code(shape: &Shape, cone: &CommonCone, view: &Matrix, (longest, most): (usize, usize)) -> Option<Code> {
    let mut open: std::collections::VecDeque<Vec<usize>> = [Vec::new()].into();
    let mut found = Vec::new();
    while let Some(word) = open.pop_front() {
        crate::stop::check();
        let (product, end) = shape.product(shape.start, &word);
        let rays = &cone.cones.iter().find(|c| c.state == end)?.rays;
        let images = &(view * &product) * rays;
        let columns: Vec<Vec<Rational>> = (0..images.cols()).map(|j| images.column(j)).collect();
        if let Some(functional) = super::cone_search::functional(&columns) {
            found.push((word, functional));
        } else if word.len() == longest || found.len() + open.len() >= most {
            return None;
        } else {
            open.extend((0..shape.states[end].pieces.len()).map(|letter| [word.as_slice(), &[letter]].concat()));
        }
    }
    Some(found)
}

/// The rays with entries rounded to a few binary places.
fn coarse(rays: &[Vec<Vec<Rational>>]) -> Vec<Vec<Vec<Rational>>> {
    let rounded = |x: &Rational| {
        let twice: Rational = x * Rational::from(1u32 << (PLACES + 1));
        Rational::from((twice.floor() + Integer::from(1)) >> 1u64) / Rational::from(1u32 << PLACES)
    };
    rays.iter().map(|c| c.iter().map(|r| r.iter().map(rounded).collect()).collect()).collect()
}

/// Binary places of the rays that are tried first.
const PLACES: u32 = 9;

fn proved_cone(
    shape: &Shape,
    spaces: &Spaces,
    frame: &Frame,
    rays: &[Vec<Vec<Rational>>],
    longest: usize,
) -> Option<CommonCone> {
    let mut cone = exact(shape, spaces, frame, rays, longest > 1)?;
    for window in 1..=longest {
        let Some(cycles) = slow::cycles(&cone, shape, window) else { continue };
        let slow = cycles.iter().map(|(state, word)| SlowCycle::find(&cone, shape, spaces, *state, word));
        let Some(slow) = slow.collect::<Option<Vec<_>>>() else { continue };
        cone.window = window;
        cone.slow = slow;
        cone.rate = cone.best_rate(shape);
        return cone.holds(shape, spaces).then_some(cone);
    }
    None
}

fn frame(shape: &Shape, spaces: &Spaces, steps: usize) -> Option<Frame> {
    let states = shape.reachable();
    let mut frame = Frame {
        states: states.clone(),
        dims: Vec::new(),
        chords: Vec::new(),
        maps: Vec::new(),
        steps,
        budget: std::cell::Cell::new(steps),
    };
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
///
/// With `boundary`, images may lie on the boundary of the cone.
fn exact(
    shape: &Shape,
    spaces: &Spaces,
    frame: &Frame,
    rays: &[Vec<Vec<Rational>>],
    boundary: bool,
) -> Option<CommonCone> {
    let mut cones = Vec::new();
    let fans: Vec<ExactRays> = rays.iter().map(|r| ExactRays::of(r.clone())).collect();
    for (k, &state) in frame.states.iter().enumerate() {
        let local = Matrix::from_columns(frame.dims[k], &rays[k]);
        let chord = fans[k].combine(&frame.chords[k])?;
        let functional = super::cone_search::functional(&rays[k])?;
        let functional = spaces.of(state).coordinates.apply_left(&functional);
        cones.push(Cone { state, rays: &spaces.of(state).basis * &local, functional, chord });
    }
    let sums: Vec<Vec<Rational>> = fans.iter().map(|fan| sum(&fan.rays)).collect();
    let mut maps = Vec::new();
    for (from, letter, to, matrix) in &frame.maps {
        let images = matrix * &Matrix::from_columns(frame.dims[*to], &rays[*to]);
        let column = |j: usize| {
            let image = images.column(j);
            interior(&fans[*from], &sums[*from], &image)
                .or_else(|| if boundary { fans[*from].combine(&image) } else { None })
        };
        let columns: Option<Vec<Vec<Rational>>> = (0..images.cols()).map(column).collect();
        let b = Matrix::from_columns(rays[*from].len(), &columns?);
        let state = frame.states[*from];
        let sign = if shape.states[state].pieces[*letter].reversed { -1 } else { 1 };
        maps.push(ConeMap { state, letter: *letter, sign, matrix: b });
    }
    let view = shape.control.as_ref().and_then(|p| {
        let images = p * &cones[0].rays;
        super::cone_search::functional(&(0..images.cols()).map(|j| images.column(j)).collect::<Vec<_>>())
    });
    Some(CommonCone { cones, maps, view, window: 1, slow: Vec::new(), rate: None })
}

/// The sum of vectors.
fn sum(vectors: &[Vec<Rational>]) -> Vec<Rational> {
    let mut total = vec![Rational::from(0); vectors.first().map_or(0, Vec::len)];
    vectors.iter().for_each(|v| total.iter_mut().zip(v).for_each(|(t, x)| *t += x));
    total
}

/// Positive exact coefficients of an inner vector of the cone: a small share of every ray, the rest on a basis.
fn interior(fan: &ExactRays, sum: &[Rational], x: &[Rational]) -> Option<Vec<Rational>> {
    let mut share = super::cone_search::share(fan.rays.len(), x)?;
    for _ in 0..24 {
        let rest: Vec<Rational> = x.iter().zip(sum).map(|(a, b)| a - &share * b).collect();
        if let Some(c) = fan.combine(&rest) {
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
    /// The theorem that gives the cones: where single pieces have coefficients 0 it is Theorem 6′.
    #[must_use]
    pub fn statement(&self) -> Statement {
        if self.slow.is_empty() && self.window == 1 { Statement::Theorem6 } else { Statement::Theorem6Slow }
    }

    /// Whether all hypotheses of Theorem 6 (or 6′) on the cones hold, by multiplication.
    #[must_use]
    pub fn holds(&self, shape: &Shape, spaces: &Spaces) -> bool {
        self.invariant(shape, spaces) && self.shrinks(shape, spaces) && self.seen(shape)
    }

    /// Whether every address without positive factors ends in one of the slow cycles, and these shrink.
    fn shrinks(&self, shape: &Shape, spaces: &Spaces) -> bool {
        let Some(cycles) = slow::cycles(self, shape, self.window) else { return false };
        cycles.len() == self.slow.len()
            && cycles.iter().zip(&self.slow).all(|((e, w), s)| (*e, w) == (s.state, &s.word))
            && self.slow.iter().all(|s| s.holds(self, shape, spaces))
    }

    /// Whether `h P G > 0`, where `h` is given.
    fn seen(&self, shape: &Shape) -> bool {
        let (Some(h), Some(p)) = (&self.view, &shape.control) else { return self.view.is_none() };
        let images = self.cones.iter().find(|c| c.state == shape.start).map(|c| p * &c.rays);
        images.is_some_and(|m| h.len() == m.rows() && (0..m.cols()).all(|j| dot(h, &m.column(j)) > 0))
    }

    fn invariant(&self, shape: &Shape, spaces: &Spaces) -> bool {
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
                        && (0..b.rows()).all(|i| b.row(i).iter().all(|x| *x >= 0))
                        && (0..b.cols()).all(|j| b.column(j).iter().any(|x| *x > 0))
                        && (&piece.op * &to.rays).scale(&Rational::from(sign)) == &from.rays * b
                })
            })
    }

    /// The product of the matrices `B` of a word, and the state where it ends.
    fn coefficients(&self, shape: &Shape, state: usize, word: &[usize]) -> Option<(Matrix, usize)> {
        let mut at = state;
        let mut product = Matrix::identity(self.cones.iter().find(|c| c.state == state)?.rays.cols());
        for &letter in word {
            product = &product * &self.maps.iter().find(|m| (m.state, m.letter) == (at, letter))?.matrix;
            at = shape.states[at].pieces[letter].target;
        }
        Some((product, at))
    }

    /// The largest cross-ratio of the products of `length` letters; `None` where one is not positive.
    #[must_use]
    pub fn cross_ratio(&self, shape: &Shape, length: usize) -> Option<Rational> {
        let mut layer: Vec<(usize, Matrix)> = Vec::new();
        for &e in &shape.reachable() {
            layer.push((e, self.coefficients(shape, e, &[])?.0));
        }
        for _ in 0..length {
            let mut longer = Vec::new();
            for (at, product) in &layer {
                for (letter, piece) in shape.states[*at].pieces.iter().enumerate() {
                    let (step, _) = self.coefficients(shape, *at, &[letter])?;
                    longer.push((piece.target, product * &step));
                }
            }
            layer = longer;
        }
        layer.iter().map(|(_, b)| largest_cross_ratio(b)).collect::<Option<Vec<_>>>()?.into_iter().max()
    }

    /// The rate with the best bound of the exponent, over products of few letters.
    fn best_rate(&self, shape: &Shape) -> Option<ConeRate> {
        let pieces = most_pieces(shape);
        let states = shape.reachable().len();
        let rays = self.cones.iter().map(|c| c.rays.cols()).fold(1, usize::max);
        let mut best: Option<(Rational, ConeRate)> = None;
        for length in 1..=MAX_RATE_LENGTH {
            let words = pieces.checked_pow(length).and_then(|w| w.checked_mul(states));
            if words.is_none_or(|w| w > MAX_RATE_WORDS || w * rays.pow(3) > MAX_RATE_WORK) {
                break;
            }
            let length = length as usize;
            let Some(cross_ratio) = self.cross_ratio(shape, length) else { continue };
            let rate = ConeRate { length, cross_ratio: rounded_up(&cross_ratio) };
            let Some(exponent) = rate.exponent(pieces) else { continue };
            if best.as_ref().is_none_or(|(old, _)| exponent > *old) {
                best = Some((exponent, rate));
            }
        }
        best.map(|b| b.1)
    }
}

/// How many products are formed to find how fast cones shrink.
const MAX_RATE_WORDS: usize = 300;
/// How many multiplications of numbers these may cost.
const MAX_RATE_WORK: usize = 30_000;
/// Longer words improve the bound slowly and cost much, here and in the checker.
const MAX_RATE_LENGTH: u32 = 3;

/// The largest number of pieces of a state; where pieces have shares of their own, a number whose reciprocal none is below.
#[must_use]
pub fn most_pieces(shape: &Shape) -> usize {
    let states = shape.reachable().into_iter().map(|e| &shape.states[e]);
    let parts = states.flat_map(|s| (0..s.pieces.len()).map(|i| (Rational::from(1) / s.share(i)).ceiling()));
    let number = |n: Integer| match usize::try_from(&n) {
        Ok(n) => n,
        Err(_) => usize::MAX,
    };
    parts.map(number).fold(1, usize::max)
}

/// A short number not below one that is at least 1.
fn rounded_up(x: &Rational) -> Rational {
    let short = Interval::point(x.clone()).outward(40).hi;
    if x.to_string().len() <= 24 { x.clone() } else { short.max(x.clone()) }
}

impl ConeRate {
    /// The factor `(√D − 1)/(√D + 1)` by which the cones shrink with every `length` letters.
    #[must_use]
    pub fn shrink(&self) -> Interval {
        let one = Interval::point(Rational::from(1));
        let root = crate::radius::square_root(&self.cross_ratio, 64);
        let (top, bottom) = (&root - &one, &root + &one);
        Interval::new(&top.lo / &bottom.hi, &top.hi / &bottom.lo)
    }

    /// A lower bound of the Hölder exponent of the tangent in the parameter of a curve whose pieces take at least `1/pieces` of
    /// it: two points closer than `pieces^-k` lie in one cell of level `k` or in two that meet, and the tangents in
    /// a cell differ by at most a constant times `shrink^(k/length)`. `None` where the cones are rays (a straight line) or `pieces < 2`.
    #[must_use]
    pub fn exponent(&self, pieces: usize) -> Option<Rational> {
        if pieces < 2 {
            return None;
        }
        let lo = super::regularity::minus_log(&self.shrink(), pieces)?.lo / Rational::from(self.length);
        (lo > 0).then_some(lo)
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
    let mut seen = BTreeSet::new();
    let mut layer: Vec<(usize, usize, Vec<usize>, Matrix)> =
        (0..frame.dims.len()).map(|s| (s, s, Vec::new(), Matrix::identity(frame.dims[s]))).collect();
    for _ in 0..MAX_CYCLE {
        let mut next = Vec::new();
        for (start, end, word, product) in layer {
            for (_, letter, to, matrix) in frame.maps.iter().filter(|m| m.0 == end) {
                let mut word = word.clone();
                word.push(*letter);
                let product = &product * matrix;
                // What leads depends neither on where a cycle begins nor on how often it is run through.
                if *to == start
                    && turned(frame, start, &word).is_some_and(|cycle| seen.insert(cycle))
                    && crate::approx::may_have_several_leaders(&product)
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

/// The least of the turned cycles with the states of their letters; `None` of a cycle that is run through several times.
fn turned(frame: &Frame, start: usize, word: &[usize]) -> Option<Vec<(usize, usize)>> {
    let mut at = start;
    let mut cycle = Vec::with_capacity(word.len());
    for letter in word {
        cycle.push((at, *letter));
        at = frame.maps.iter().find(|m| (m.0, m.1) == (at, *letter))?.2;
    }
    let n = cycle.len();
    let turn = |k: usize| [&cycle[k..], &cycle[..k]].concat();
    let repeated = (1..n).any(|k| n.is_multiple_of(k) && turn(k) == cycle);
    if repeated { None } else { (0..n).map(turn).min() }
}

fn defect(product: &Matrix) -> Option<(Vec<Root>, Defect)> {
    let (leading, multiplicities): (Vec<Root>, Vec<usize>) = leading_roots(product).into_iter().unzip();
    let first = leading.first()?;
    let reason = if first.is_zero() {
        Defect::Nilpotent
    } else if leading.iter().any(|r| !r.is_real()) {
        Defect::Complex
    } else if leading.len() > 1 {
        Defect::Several
    } else if multiplicities[0] > 1 {
        Defect::Multiple
    } else if first.sign() < 0 {
        Defect::Negative
    } else {
        return None;
    };
    Some((leading, reason))
}
