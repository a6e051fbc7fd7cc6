//! The ring of a branch, and the ring condition `0 ∉ π(X)` by branch and bound (theory §3, §7).

use crate::algebraic::{Elem, Root};
use crate::arith::{Integer, Interval, Rational};
use crate::jordan::{Over, Scalar};
use crate::linalg::Matrix;
use crate::shape::{Address, Balls, CellKind, Shape, Spaces, difference, oscillation, repetition};
use std::collections::{BTreeMap, VecDeque};

/// Where a piece lies with respect to the cycle's cell, in the order of its state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Position {
    /// Before it (`K⁻`).
    Before,
    /// After it (`K⁺`).
    After,
    /// The state is no curve.
    Unordered,
}

/// A piece of the ring: `op · A_end`.
#[derive(Debug, Clone)]
pub struct RingPiece<E = Rational> {
    /// The word that leaves the cycle in its last letter.
    pub word: Vec<usize>,
    /// The state where the word ends.
    pub end: usize,
    /// Its operator.
    pub op: Matrix<E>,
    /// Its place.
    pub position: Position,
    /// Whether the whole piece falls into `q` after finitely many turns (Lemma 2), so that the germ does not see it.
    pub collapses: bool,
}

/// Which real functional of an algebraic one is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// Its real part (the functional itself at a real root).
    Real,
    /// Its imaginary part.
    Imaginary,
}

/// A real functional on `Y`: a row over `Q(θ)` seen at a root; without a root the entries are rational.
#[derive(Debug, Clone)]
pub struct Functional {
    /// Entries.
    pub row: Vec<Elem>,
    /// The root.
    pub root: Option<Root>,
    /// The part.
    pub part: Part,
    /// The generator of the field of the shape as a polynomial in the root, where that is not the field of the rationals.
    pub alpha: Option<Elem>,
}

impl Functional {
    /// A rational functional.
    #[must_use]
    pub fn rational(row: &[Rational]) -> Self {
        Self::of(row, &())
    }

    /// A functional with entries in the field of the shape.
    #[must_use]
    pub fn of<E: Scalar>(row: &[E], base: &E::Base) -> Self {
        let row: Vec<Elem> = row.iter().map(E::elem).collect();
        let root = E::generator(base).filter(|_| row.iter().any(|x| x.is_rational().is_none())).cloned();
        let alpha = root.as_ref().map(|r| Elem::generator(r.minpoly()));
        Self { row, root, part: Part::Real, alpha }
    }

    /// A dyadic approximation of the entries and a bound of its error in each.
    pub(super) fn approximate(&self, bits: u64) -> (Vec<Rational>, Rational) {
        let exact: Option<Vec<Rational>> = self.row.iter().map(Elem::is_rational).collect();
        if let Some(row) = exact {
            return match self.part {
                Part::Real => (row, Rational::from(0)),
                Part::Imaginary => (vec![Rational::from(0); self.row.len()], Rational::from(0)),
            };
        }
        let root = self.root.as_ref().expect("irrational entries have a root");
        let entry = |e: &Elem| {
            let (re, im) = e.enclosure(root, bits + 2);
            let chosen = if self.part == Part::Real { re } else { im };
            // The width of the enclosure and the rounding add up to less than 2^-bits.
            Interval::point(chosen.mid()).outward(bits + 2).lo
        };
        let error = Rational::from(1) / Rational::from(Integer::from(1) << bits);
        (self.row.iter().map(entry).collect(), error)
    }

    /// Whether the algebraic functional vanishes at a vector of `Y`, exactly.
    #[must_use]
    pub fn vanishes<E: Scalar>(&self, y: &[E]) -> bool {
        let Some(root) = &self.root else {
            let entries = self.row.iter().map(|e| E::of(&e.is_rational().expect("irrational entries have a root")));
            return E::dot(&entries.collect::<Vec<E>>(), y).is_zero();
        };
        let over = Over { modulus: root.minpoly(), alpha: self.alpha.as_ref() };
        self.row.iter().zip(y).fold(Elem::zero(), |s, (e, x)| s.add(&x.scaled(e, over))).is_zero()
    }
}

/// A cell on which a functional keeps a strict sign.
#[derive(Debug, Clone)]
pub struct Discharged {
    /// The cell, as a word from the branch's state.
    pub word: Vec<usize>,
    /// The state where the word ends.
    pub end: usize,
    /// Index of the functional.
    pub functional: usize,
    /// Its sign there.
    pub sign: i32,
    /// Its place in the curve.
    pub position: Position,
    /// An enclosure of its values there.
    pub bound: Interval,
}

/// A proof that the functionals have no common zero on the ring: the discharged words cover it.
#[derive(Debug, Clone)]
pub struct RingProof {
    /// The functionals, on `Y`.
    pub functionals: Vec<Functional>,
    /// The cells.
    pub discharged: Vec<Discharged>,
    /// Binary digits used for irrational entries.
    pub bits: u64,
    /// Whether polygons were used instead of balls.
    pub polygons: bool,
}

/// A proof that the functionals do have a common zero on the ring.
#[derive(Debug, Clone)]
pub enum Witness<E = Rational> {
    /// A point with an eventually periodic address where all vanish exactly.
    Point {
        /// Its address from the branch's state.
        address: Address,
        /// The point minus `q`, in coordinates of `Y`.
        offset: Vec<E>,
    },
    /// Two points of one connected part of the ring at which the only functional has opposite signs.
    SignChange {
        /// Address, from the branch's state, of a point where it is positive.
        positive: Address,
        /// Bounds of its value there.
        above: Interval,
        /// Address of a point where it is negative.
        negative: Address,
        /// Bounds of its value there.
        below: Interval,
    },
    /// A connected part of the ring on which `c_2` changes sign while `c_1` has one strict sign wherever `c_2` vanishes
    /// (theory §6).
    Crossing {
        /// The part.
        part: Position,
        /// The sign of `c_1` at the zeros of `c_2`.
        sign: i32,
        /// Address of a point where `c_2` is positive.
        positive: Address,
        /// Address of a point where it is negative.
        negative: Address,
        /// Cells that cover the part, on each of which `c_2` (functional 0) or `c_1` (functional 1) has a strict sign.
        cover: RingProof,
    },
}

/// The answer to a ring condition.
#[derive(Debug, Clone)]
pub enum RingAnswer<E = Rational> {
    /// `0 ∉ π(X)`.
    Holds(RingProof),
    /// `0 ∈ π(X)`.
    Fails(Witness<E>),
    /// Not decided.
    Open {
        /// The cell in which it failed.
        place: Vec<usize>,
    },
}

/// The ring of a branch with what is needed to examine it.
pub struct Ring<'a, E: Scalar = Rational> {
    /// The shape.
    pub shape: &'a Shape<E>,
    /// The field of its entries.
    pub base: &'a E::Base,
    /// Its relevant spaces.
    pub spaces: &'a Spaces<E>,
    /// Its balls.
    pub balls: &'a Balls<E>,
    /// The state of the branch.
    pub state: usize,
    /// The fixed point.
    pub fixed: &'a [E],
    /// `Y`-coordinates: `chart (x − q)`.
    pub chart: &'a Matrix<E>,
    /// The pieces.
    pub pieces: &'a [RingPiece<E>],
}

/// A cell with the functionals carried to it.
pub(super) struct Node<E = Rational> {
    pub word: Vec<usize>,
    pub end: usize,
    pub position: Position,
    pub rows: Vec<Vec<E>>,
}

const MAX_BITS: u64 = 1_024;
/// Binary digits to which values at points are enclosed.
const SIGN_BITS: u64 = 256;
/// How many cells have their ends evaluated in search of a sign change.
const SIGN_NODES: usize = 1_000;
/// After how many cells points with short cycles are tried as witnesses, and then the limit of the cell at hand each time that
/// twice as many cells were looked at.
const PERIODIC_AT: usize = 128;
/// How many limits of cells are tried in the end.
const MAX_LIMITS: usize = 32;
/// How many cells have points with short cycles tried.
const PERIODIC_CELLS: usize = 60;
/// Levels of cells on which points are tried as witnesses although they are not the last ones.
const WITNESS_NODES: usize = 400;

/// The standard ring of the cycle `w` at `state`, without pieces that lie in `M A_e` or repeat a kept one (theory §3).
#[must_use]
pub fn standard_ring<E: Scalar>(
    shape: &Shape<E>,
    spaces: &Spaces<E>,
    state: usize,
    cycle: &[usize],
    fixed: &[E],
) -> Vec<RingPiece<E>> {
    let mut ring: Vec<RingPiece<E>> = Vec::new();
    let mut product = Matrix::identity(shape.states[state].dim);
    let (mut at, mut orientation) = (state, 1);
    for (i, &turn) in cycle.iter().enumerate() {
        let pieces = &shape.states[at].pieces;
        let ordered = shape.states[at].kind == CellKind::Edge;
        let kept_from = ring.len();
        for (letter, piece) in pieces.iter().enumerate().filter(|(j, _)| *j != turn) {
            let op = &product * &piece.op;
            let position = match (ordered, (letter < turn) == (orientation > 0)) {
                (false, _) => Position::Unordered,
                (true, true) => Position::Before,
                (true, false) => Position::After,
            };
            let same = |other: &Matrix<E>, target: usize| target == piece.target && *other == piece.op;
            let repeated = !ordered
                && (same(&pieces[turn].op, pieces[turn].target)
                    || ring[kept_from..].iter().any(|r| r.end == piece.target && r.op == op));
            let is_fixed_point = (&piece.op * &spaces.of(piece.target).basis).is_zero()
                && op.apply(&spaces.of(piece.target).base) == fixed;
            if !repeated && !is_fixed_point {
                let mut word = cycle[..i].to_vec();
                word.push(letter);
                ring.push(RingPiece { word, end: piece.target, op, position, collapses: false });
            }
        }
        product = &product * &pieces[turn].op;
        if pieces[turn].reversed {
            orientation = -orientation;
        }
        at = pieces[turn].target;
    }
    ring
}

impl<E: Scalar> Ring<'_, E> {
    /// Decides whether the functionals have a common zero on the ring.
    ///
    /// # Cost
    /// At most `budget` products of a row and an operator per precision.
    #[must_use]
    pub fn decide(&self, functionals: &[Functional], budget: usize) -> RingAnswer<E> {
        let mut bits = 64;
        loop {
            match self.attempt(functionals, bits, budget) {
                Attempt::Answer(answer) => return answer,
                Attempt::MoreBits(place) if bits >= MAX_BITS => return RingAnswer::Open { place },
                Attempt::MoreBits(_) => bits *= 2,
            }
        }
    }

    /// A bound of the 1-norm of `chart (x − q)` over the attractor.
    pub(super) fn chart_bound(&self) -> Rational {
        let radius = self.balls.radius(self.state);
        (0..self.chart.rows()).fold(Rational::from(0), |s, k| s + oscillation(self.chart.row(k)) * radius)
    }

    /// A functional on `Y` as a row on `R^n` that vanishes at `q`.
    pub(super) fn row_on_points(&self, on_y: &[Rational]) -> Vec<E> {
        let row = self.chart.apply_left(&on_y.iter().map(E::of).collect::<Vec<E>>());
        let at_q = E::dot(&row, self.fixed);
        row.iter().map(|x| x.minus(&at_q)).collect()
    }

    /// What is added by rounding irrational numbers to so many binary digits.
    fn rounding(&self, bits: u64) -> Rational {
        match E::generator(self.base) {
            Some(_) => Rational::from(1) >> bits,
            None => Rational::from(0),
        }
    }

    fn attempt(&self, functionals: &[Functional], bits: u64, budget: usize) -> Attempt<E> {
        let bound = self.chart_bound();
        let approximations: Vec<(Vec<Rational>, Rational)> = functionals.iter().map(|f| f.approximate(bits)).collect();
        let errors: Vec<Rational> = approximations.iter().map(|(_, e)| e * &bound).collect();
        let rows: Vec<Vec<E>> = approximations.iter().map(|(row, _)| self.row_on_points(row)).collect();
        let mut queue = self.roots(&rows);
        let mut discharged: Vec<Discharged> = Vec::new();
        let mut signs = Signs::default();
        let mut count: usize = 0;
        while let Some(node) = queue.pop_front() {
            crate::stop::check();
            count += 1;
            let bounds: Vec<Interval> = node
                .rows
                .iter()
                .zip(&errors)
                .map(|(row, e)| &self.balls.enclose(self.spaces, node.end, row, bits) + &Interval::symmetric(e.clone()))
                .collect();
            if functionals.len() == 1
                && node.position != Position::Unordered
                && count <= SIGN_NODES
                && let Some(witness) = self.sign_change(&mut signs, &node, &errors[0])
            {
                return Attempt::Answer(RingAnswer::Fails(witness));
            }
            let mut strict = bounds.iter().enumerate().filter_map(|(k, b)| Some((k, b.sign().filter(|s| *s != 0)?)));
            if let Some((functional, sign)) = strict.next() {
                let bound = bounds[functional].clone();
                let Node { word, end, position, .. } = node;
                discharged.push(Discharged { word, end, functional, sign, position, bound });
                continue;
            }
            if count <= WITNESS_NODES
                && let Some(witness) = self.point_witness(functionals, &node, &errors)
            {
                return Attempt::Answer(RingAnswer::Fails(witness));
            }
            if count == PERIODIC_AT
                && let Some(witness) = self.early_witness(functionals, &rows, &errors)
            {
                return Attempt::Answer(RingAnswer::Fails(witness));
            }
            if count >= PERIODIC_AT
                && count.is_power_of_two()
                && let Some(witness) = self.limit_witness(functionals, &node.word)
            {
                return Attempt::Answer(RingAnswer::Fails(witness));
            }
            if count * functionals.len() > budget {
                let words = std::iter::once(&node).chain(&queue).map(|n| n.word.as_slice());
                return Attempt::Answer(match self.limit_witnesses(functionals, words) {
                    Some(witness) => RingAnswer::Fails(witness),
                    None => RingAnswer::Open { place: node.word },
                });
            }
            let rounding = self.rounding(bits);
            let hopeless = |(b, e): (&Interval, &Rational)| {
                let e = e + &rounding;
                e > 0 && b.width() < e * Rational::from(16)
            };
            if bounds.iter().zip(&errors).all(hopeless) {
                return Attempt::MoreBits(node.word);
            }
            queue.extend(self.children(&node));
        }
        Attempt::Answer(RingAnswer::Holds(RingProof {
            functionals: functionals.to_vec(),
            discharged,
            bits,
            polygons: self.balls.hull(self.state).is_some(),
        }))
    }

    /// Points of opposite sign of one functional in one connected part, looked for among the ends of the first cells.
    fn find_sign_change(&self, functional: &Functional, cells: usize) -> Option<Witness<E>> {
        let (row, error) = functional.approximate(256);
        let error = error * self.chart_bound();
        let mut queue = self.roots(&[self.row_on_points(&row)]);
        let mut signs = Signs::default();
        for _ in 0..cells {
            let node = queue.pop_front()?;
            if let Some(witness) = self.sign_change(&mut signs, &node, &error) {
                return Some(witness);
            }
            queue.extend(self.children(&node));
        }
        None
    }

    /// Points of opposite sign of one functional on one piece of the ring, for pieces that are connected.
    pub(super) fn sign_change_on_piece(&self, functional: &Functional, cells: usize) -> Option<Witness<E>> {
        self.pieces
            .iter()
            .find_map(|piece| Ring { pieces: std::slice::from_ref(piece), ..*self }.find_sign_change(functional, cells))
    }

    /// The pieces of the ring as cells, with the rows carried to them.
    pub(super) fn roots(&self, rows: &[Vec<E>]) -> VecDeque<Node<E>> {
        let node = |p: &RingPiece<E>| Node {
            word: p.word.clone(),
            end: p.end,
            position: p.position,
            rows: rows.iter().map(|r| p.op.apply_left(r)).collect(),
        };
        self.pieces.iter().map(node).collect()
    }

    pub(super) fn children(&self, node: &Node<E>) -> Vec<Node<E>> {
        let pieces = self.shape.states[node.end].pieces.iter().enumerate();
        pieces
            .map(|(letter, piece)| {
                let mut word = node.word.clone();
                word.push(letter);
                let rows = node.rows.iter().map(|r| piece.op.apply_left(r)).collect();
                Node { word, end: piece.target, position: node.position, rows }
            })
            .collect()
    }

    /// Evaluates the only functional at the ends of the cell and compares with the signs met before in the same part.
    fn sign_change(&self, signs: &mut Signs, node: &Node<E>, error: &Rational) -> Option<Witness<E>> {
        let part = usize::from(node.position == Position::After);
        for (address, point) in &self.spaces.of(node.end).landmarks {
            let value = E::dot(&node.rows[0], point).enclosure(SIGN_BITS);
            let bound = &value + &Interval::symmetric(error.clone());
            let Some(sign) = bound.sign().filter(|s| *s != 0) else { continue };
            let known = &mut signs.0[part][usize::from(sign > 0)];
            if known.is_none() {
                let prefix = [node.word.as_slice(), &address.prefix].concat();
                let address = Address { prefix, cycle: address.cycle.clone() };
                *known = Some((address, bound));
            }
        }
        let [Some((negative, below)), Some((positive, above))] = signs.0[part].clone() else { return None };
        Some(Witness::SignChange { positive, above, negative, below })
    }

    /// Tries the points of the cell with known addresses as exact common zeros.
    pub(super) fn point_witness(
        &self,
        functionals: &[Functional],
        node: &Node<E>,
        errors: &[Rational],
    ) -> Option<Witness<E>> {
        let landmarks = self.spaces.of(node.end).landmarks.iter();
        landmarks.into_iter().find_map(|(address, local)| self.zero(functionals, node, errors, address, local))
    }

    /// The point of a cell, if all functionals vanish there exactly.
    fn zero(
        &self,
        functionals: &[Functional],
        node: &Node<E>,
        errors: &[Rational],
        address: &Address,
        local: &[E],
    ) -> Option<Witness<E>> {
        if node.rows.iter().zip(errors).any(|(row, e)| E::dot(row, local).absolute() > E::of(e)) {
            return None;
        }
        let prefix = [node.word.as_slice(), &address.prefix].concat();
        self.zero_at(functionals, &Address { prefix, cycle: address.cycle.clone() })
    }

    fn zero_at(&self, functionals: &[Functional], address: &Address) -> Option<Witness<E>> {
        let address = address.normalise(self.shape, self.state).ok()?;
        let offset = self.chart.apply(&difference(&self.shape.point(self.state, &address)?, self.fixed));
        functionals.iter().all(|f| f.vanishes(&offset)).then_some(Witness::Point { address, offset })
    }

    /// What is tried once where the condition is not decided soon: points with short cycles, and a change of sign on a connected
    /// piece of a set.
    fn early_witness(&self, functionals: &[Functional], rows: &[Vec<E>], errors: &[Rational]) -> Option<Witness<E>> {
        let found = self.periodic_witness(functionals, rows, errors);
        match functionals {
            [only] if found.is_none() && self.pieces.iter().all(|p| p.position == Position::Unordered) => {
                self.connected_sign_change(only)
            }
            _ => found,
        }
    }

    /// The limits of the cells that are left, each once.
    fn limit_witnesses<'w>(
        &self,
        functionals: &[Functional],
        words: impl Iterator<Item = &'w [usize]>,
    ) -> Option<Witness<E>> {
        let mut tried: Vec<(&[usize], &[usize])> = Vec::new();
        for word in words {
            let Some((head, cycle, _)) = repetition(word) else { continue };
            if tried.contains(&(head, cycle)) {
                continue;
            }
            if tried.len() >= MAX_LIMITS {
                return None;
            }
            tried.push((head, cycle));
            let found = self.zero_at(functionals, &Address { prefix: head.to_vec(), cycle: cycle.to_vec() });
            if found.is_some() {
                return found;
            }
        }
        None
    }

    /// Points of the first cells whose cycles have at most two letters.
    fn periodic_witness(&self, functionals: &[Functional], rows: &[Vec<E>], errors: &[Rational]) -> Option<Witness<E>> {
        let mut known: BTreeMap<usize, Vec<(Address, Vec<E>)>> = BTreeMap::new();
        let mut queue = self.roots(rows);
        for _ in 0..PERIODIC_CELLS {
            let node = queue.pop_front()?;
            let points = known.entry(node.end).or_insert_with(|| self.shape.short_cycles(node.end));
            let found = points.iter().find_map(|(a, local)| self.zero(functionals, &node, errors, a, local));
            if found.is_some() {
                return found;
            }
            queue.extend(self.children(&node));
        }
        None
    }

    /// The point to which the cell shrinks if the letters at its end, repeated three times or more, go on for ever.
    fn limit_witness(&self, functionals: &[Functional], word: &[usize]) -> Option<Witness<E>> {
        let (head, cycle, _) = repetition(word)?;
        self.zero_at(functionals, &Address { prefix: head.to_vec(), cycle: cycle.to_vec() })
    }

    /// Two points of one connected part of the ring at which a functional has opposite signs: of a curve before or after the
    /// cycle's cell, otherwise of one piece that is connected because its pieces share points.
    pub(super) fn connected_sign_change(&self, functional: &Functional) -> Option<Witness<E>> {
        let ordered = |p: &&RingPiece<E>| p.position != Position::Unordered;
        let pieces: Vec<RingPiece<E>> = self.pieces.iter().filter(ordered).cloned().collect();
        if let Some(found) = (Ring { pieces: &pieces, ..*self }).find_sign_change(functional, SIGN_NODES) {
            return Some(found);
        }
        let mut connected: BTreeMap<usize, bool> = BTreeMap::new();
        let mut joined = |p: &&RingPiece<E>| {
            p.position == Position::Unordered
                && *connected.entry(p.end).or_insert_with(|| self.shape.links(p.end).is_some())
        };
        let pieces: Vec<RingPiece<E>> = self.pieces.iter().filter(|p| joined(p)).cloned().collect();
        Ring { pieces: &pieces, ..*self }.sign_change_on_piece(functional, PERIODIC_CELLS)
    }

    /// Looks for a connected part of the ring on which `c_2` takes both signs while `c_1` has one strict sign wherever `c_2`
    /// vanishes (theory §6).
    #[must_use]
    pub fn crossing(&self, c1: &Functional, c2: &Functional, budget: usize) -> Option<Witness<E>> {
        [Position::Before, Position::After].into_iter().find_map(|part| {
            let pieces: Vec<RingPiece<E>> = self.pieces.iter().filter(|p| p.position == part).cloned().collect();
            let ring = Ring { pieces: &pieces, ..*self };
            let Witness::SignChange { positive, negative, .. } = ring.find_sign_change(c2, SIGN_NODES)? else {
                return None;
            };
            let RingAnswer::Holds(cover) = ring.decide(&[c2.clone(), c1.clone()], budget) else { return None };
            let mut signs = cover.discharged.iter().filter(|d| d.functional == 1).map(|d| d.sign);
            let sign = signs.next()?;
            signs.all(|s| s == sign).then_some(Witness::Crossing { part, sign, positive, negative, cover })
        })
    }
}

/// A point of negative and one of positive sign, for the parts before and after.
#[derive(Default)]
struct Signs([[Option<(Address, Interval)>; 2]; 2]);

enum Attempt<E> {
    Answer(RingAnswer<E>),
    MoreBits(Vec<usize>),
}
