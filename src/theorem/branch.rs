//! One branch `u w^ω`: its visible quotient, spectrum, ring, and the statement that applies (theory §3–§9).

use super::direction::Direction;
use super::gap::{BranchGap, NoGerm};
use super::provable::Provable;
use super::ring::{Functional, Part, Position, Ring, RingAnswer, RingPiece, RingProof, Witness, standard_ring};
use super::sign::changes_sign;
use super::verdict::{BranchReport, Holder, Outcome, Rate, Rays, Side};
use super::viewpoint::Viewpoint;
use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::budget::Budget;
use crate::jordan::{Chain, Eigenvalue, Over, Part as Factor, Scalar, Spectral};
use crate::linalg::Matrix;
use crate::shape::{Address, Balls, CellKind, HullWeights, Shape, Spaces, difference};
use crate::statement::Statement;
use std::cell::OnceCell;

/// What all branches of a shape share.
pub struct Context<'a, E: Scalar = Rational> {
    /// The shape.
    pub shape: &'a Shape<E>,
    /// The field of its entries.
    pub base: &'a E::Base,
    /// Its relevant spaces.
    pub spaces: &'a Spaces<E>,
    /// Balls that hold its attractors.
    pub balls: &'a Balls<E>,
    /// The same with convex polygons, tried where the balls do not suffice.
    pub hulls: &'a OnceCell<Option<Balls<E>>>,
    /// Where addresses are read from, and how the shape is seen there.
    pub from: Viewpoint<E>,
    /// How long the search may go on.
    pub budget: &'a Budget,
}

impl<E: Scalar> Context<'_, E> {
    /// The convex polygons by state, where they were made.
    pub(super) fn polygons(&self) -> Option<Vec<Vec<Vec<E>>>> {
        let balls = self.hulls.get()?.as_ref()?;
        (0..self.shape.states.len()).map(|e| balls.hull(e).map(<[_]>::to_vec)).collect()
    }

    /// How the images of their vertices are combined, where that was found with them.
    pub(super) fn polygon_weights(&self) -> Option<HullWeights> {
        self.hulls.get()?.as_ref()?.hull_weights().cloned()
    }
}

/// The largest `L`-invariant subspace in the kernel of `view`, divided out.
pub struct Quotient<E> {
    /// `Y <- V`, reduced echelon form.
    pub chart: Matrix<E>,
    /// `V <- Y`, a right inverse.
    pub lift: Matrix<E>,
}

impl<E: Scalar> Quotient<E> {
    /// Of a space on which `linear` acts and that is seen through `view`.
    #[must_use]
    pub fn new(view: &Matrix<E>, linear: &Matrix<E>) -> Self {
        let rows = view.closure(&[linear]).echelon();
        let lift = Matrix::from_fn(linear.rows(), rows.pivots.len(), |i, k| E::integer(i64::from(rows.pivots[k] == i)));
        Self { chart: rows.rows, lift }
    }
}

/// What every branch of a curve, a set or a surface starts from: the fixed point of its cycle, and `L` on the visible quotient.
pub(super) struct Local<E: Scalar = Rational> {
    pub state: usize,
    pub cycle_operator: Matrix<E>,
    pub fixed: Vec<E>,
    pub transport: Matrix<E>,
    pub relevant: usize,
    pub chart: Matrix<E>,
    pub linear: Matrix<E>,
    pub view: Matrix<E>,
    pub spectrum: E::Spectrum,
    pub ring: Vec<RingPiece<E>>,
}

impl<E: Scalar> Local<E> {
    /// `None` where the fixed point of the cycle is not unique.
    pub fn new(cx: &Context<E>, address: &Address) -> Option<Self> {
        let (prefix, state) = cx.shape.product(cx.from.root(), &address.prefix);
        let (cycle_operator, _) = cx.shape.product(state, &address.cycle);
        let fixed = crate::shape::fixed_point(&cycle_operator)?;
        let transport = cx.from.map() * &prefix;
        let space = cx.spaces.of(state);
        let on_v = &transport * &space.basis;
        let linear_v = cx.spaces.linear(&cycle_operator, state, state);
        let quotient = Quotient::new(&on_v, &linear_v);
        let linear = &(&quotient.chart * &linear_v) * &quotient.lift;
        let view = &on_v * &quotient.lift;
        let chart = &quotient.chart * &space.coordinates;
        let spectrum = E::spectrum(&linear, cx.base);
        let mut ring = standard_ring(cx.shape, cx.spaces, state, &address.cycle, &fixed);
        mark_collapsing(cx, &chart, &linear, &fixed, &mut ring);
        let relevant = space.basis.cols();
        Some(Self { state, cycle_operator, fixed, transport, relevant, chart, linear, view, spectrum, ring })
    }
}

/// Examines the branch `address` from the root state; `side` says which part of the curve it describes there.
///
/// Returns `None` where the fixed point of the cycle is not unique.
#[must_use]
pub fn examine<E: Provable>(cx: &Context<E>, address: &Address, side: Side) -> Option<BranchReport<E>> {
    let shape = cx.shape;
    let Local { state, cycle_operator, fixed, transport, relevant, chart, linear, view, spectrum, ring } =
        Local::new(cx, address)?;
    let sign_along = |from: usize, word: &[usize]| -> i32 {
        let states = shape.path(from, word);
        word.iter().zip(&states).map(|(&i, &e)| if shape.states[e].pieces[i].reversed { -1 } else { 1 }).product()
    };
    let mut report = BranchReport {
        side,
        address: address.clone(),
        state,
        prefix_sign: sign_along(cx.from.root(), &address.prefix),
        cycle_sign: sign_along(state, &address.cycle),
        cycle_operator,
        fixed,
        transport,
        relevant,
        chart,
        linear,
        view,
        spectrum,
        ring,
        outcome: Outcome::NoGerm { reason: NoGerm::NoSpace },
    };
    let seen: Vec<RingPiece<E>> = report.ring.iter().filter(|p| !p.collapses).cloned().collect();
    report.outcome = Analysis { cx, branch: &report, seen: &seen }.outcome();
    Some(report)
}

/// Marks the pieces that fall into `q` as a whole (Lemma 2).
fn mark_collapsing<E: Scalar>(
    cx: &Context<E>,
    chart: &Matrix<E>,
    linear: &Matrix<E>,
    fixed: &[E],
    ring: &mut [RingPiece<E>],
) {
    let falls = &invertible_rows(linear) * chart;
    for piece in ring {
        let space = cx.spaces.of(piece.end);
        let point = falls.apply(&difference(&piece.op.apply(&space.base), fixed));
        piece.collapses = point.iter().all(E::is_zero) && (&falls * &(&piece.op * &space.basis)).is_zero();
    }
}

/// The reduced rows of all large powers: a vector is in the generalised kernel where they vanish on it.
fn invertible_rows<E: Scalar>(m: &Matrix<E>) -> Matrix<E> {
    let mut rows = Matrix::identity(m.rows());
    loop {
        let next = (&rows * m).echelon().rows;
        if next.rows() == rows.rows() {
            return rows;
        }
        rows = next;
    }
}

pub(super) fn power<E: Scalar>(m: &Matrix<E>, exponent: usize) -> Matrix<E> {
    (0..exponent).fold(Matrix::identity(m.rows()), |p, _| &p * m)
}

struct Analysis<'a, E: Scalar> {
    cx: &'a Context<'a, E>,
    branch: &'a BranchReport<E>,
    /// The ring without the pieces that collapse.
    seen: &'a [RingPiece<E>],
}

/// The part of the spectrum with the largest modulus.
struct Top<'a> {
    /// Length of the longest block.
    block: usize,
    /// Factor and root of every eigenvalue with a block of that length, once per such block.
    longest: Vec<(usize, usize)>,
    /// The factor of the first of them.
    factor: Factor<'a>,
    /// Its root.
    root: &'a Root,
    /// The generator of the field of its chains that belongs to the root.
    place: &'a Root,
}

fn top<S: Spectral>(spectrum: &S) -> Option<Top<'_>> {
    let class = spectrum.classes().first()?;
    let block = class.members.iter().map(|m| spectrum.part(m.factor).blocks[0]).max()?;
    let longest: Vec<(usize, usize)> = class
        .members
        .iter()
        .flat_map(|m| {
            let count = spectrum.part(m.factor).blocks.iter().filter(|&&b| b == block).count();
            std::iter::repeat_n((m.factor, m.root), count)
        })
        .collect();
    let &(f, r) = longest.first()?;
    let factor = spectrum.part(f);
    Some(Top { block, longest, factor, root: &factor.roots[r], place: &factor.places[r] })
}

impl<E: Provable> Analysis<'_, E> {
    fn ring(&self) -> Ring<'_, E> {
        Ring {
            shape: self.cx.shape,
            base: self.cx.base,
            spaces: self.cx.spaces,
            balls: self.cx.balls,
            state: self.branch.state,
            fixed: &self.branch.fixed,
            chart: &self.branch.chart,
            pieces: self.seen,
        }
    }

    /// The ring condition with balls, then with polygons where there are any.
    fn decide(&self, functionals: &[Functional]) -> RingAnswer<E> {
        let small = self.branch.relevant <= 2;
        let cx = self.cx;
        let answer = self.ring().decide(functionals, if small { cx.budget.first_cells } else { cx.budget.cells });
        if !matches!(answer, RingAnswer::Open { .. }) {
            return answer;
        }
        match cx.hulls.get_or_init(|| E::enclosures(cx.shape, cx.spaces, cx.balls)) {
            Some(hulls) => Ring { balls: hulls, ..self.ring() }.decide(functionals, self.cx.budget.cells),
            None if small => self.ring().decide(functionals, self.cx.budget.cells),
            None => answer,
        }
    }

    fn outcome(&self) -> Outcome<E> {
        let b = self.branch;
        if b.linear.rows() == 0 {
            return Outcome::NoGerm { reason: NoGerm::SinglePoint };
        }
        let Some(top) = top(&b.spectrum) else {
            return Outcome::NoGerm { reason: NoGerm::NoSpace };
        };
        if top.root.is_zero() {
            return self.nilpotent();
        }
        if top.longest.len() >= 2 {
            return self.many_directions(&top);
        }
        self.one_direction(&top)
    }

    /// `L` is nilpotent: the germ is that of the finitely many `M^m K` that contain `q`.
    fn nilpotent(&self) -> Outcome<E> {
        let n = self.branch.linear.rows();
        let coordinates: Vec<Functional> = (0..n).map(|k| Functional::rational(Matrix::identity(n).row(k))).collect();
        let mut images = self.branch.ring.clone();
        let mut turns = 0;
        // From the index of nilpotency on, the images of the ring are the point itself.
        while !power(&self.branch.linear, turns).is_zero() {
            let ring = Ring { pieces: &images, ..self.ring() };
            match ring.decide(&coordinates, self.cx.budget.first_cells) {
                RingAnswer::Holds(_) => {}
                RingAnswer::Fails(_) => {
                    let reason = BranchGap::NilpotentRing;
                    return Outcome::Open { reason, place: None, at_least: 0, direction: None };
                }
                RingAnswer::Open { place } => {
                    let reason = BranchGap::NilpotentOpen;
                    return Outcome::Open { reason, place: Some(place), at_least: 0, direction: None };
                }
            }
            for piece in &mut images {
                piece.op = &self.branch.cycle_operator * &piece.op;
                piece.word.splice(0..0, self.branch.address.cycle.iter().copied());
            }
            turns += 1;
        }
        Outcome::NoGerm { reason: NoGerm::Isolated { shape: self.branch.is_shape() } }
    }

    /// `dim U >= 2`: the corollary refutes without the ring, if the view does not fold `U`.
    fn many_directions(&self, top: &Top) -> Outcome<E> {
        let spectrum = &self.branch.spectrum;
        let dimension = visible_dimension(&self.branch.view, spectrum, &top.longest, top.block);
        if dimension >= 2 {
            return Outcome::AtLeast {
                dimension,
                statement: Statement::Corollary,
                eigenvalues: top.longest.clone(),
                isolation: None,
                witness: None,
            };
        }
        Outcome::Open { reason: BranchGap::Folded, place: None, at_least: 1, direction: None }
    }

    /// `dim U = 1`: one real eigenvalue with one longest block.
    fn one_direction(&self, top: &Top) -> Outcome<E> {
        let b = self.branch;
        let (factor, root) = top.longest[0];
        let functional = Functional {
            row: leading_functional(top.factor, top.block),
            root: Some(top.place.clone()),
            part: Part::Real,
            alpha: top.factor.over.alpha.cloned(),
        };
        let answer = self.decide(std::slice::from_ref(&functional));
        let statement = if top.block == 1 { Statement::Theorem2 } else { Statement::Theorem3 };
        let line = |statement, proof: Option<RingProof>| {
            let direction = self.direction(top).normalised();
            let flip = self.sense(top, &direction);
            let rays = match (&proof, flip) {
                (Some(proof), Some(flip)) => self.rays(top, &direction, flip, proof),
                _ => Rays { left: Vec::new(), right: Vec::new() },
            };
            Outcome::Line {
                statement,
                eigenvalue: (factor, root),
                block: top.block,
                functional: functional.row.clone(),
                proof,
                direction,
                rays,
                rate: rate(&b.spectrum, top),
                holder: self.holder(top),
            }
        };
        if let RingAnswer::Holds(proof) = answer {
            return line(statement, Some(proof));
        }
        if b.linear.rows() == 1 {
            return line(Statement::CorollaryLine, None);
        }
        self.ring_fails(top, &functional, answer)
    }

    /// The ring condition fails or is open: isolation first, then what the witness gives.
    fn ring_fails(&self, top: &Top, functional: &Functional, answer: RingAnswer<E>) -> Outcome<E> {
        let open = |reason, place| Outcome::Open {
            reason,
            place,
            at_least: 1,
            direction: Some(self.direction(top).normalised()),
        };
        let isolation = match self.decide(&isolation_functionals(&self.branch.linear, self.cx.base)) {
            RingAnswer::Holds(proof) => proof,
            RingAnswer::Fails(Witness::Point { address, .. }) => {
                let mut place = address.prefix;
                place.extend(address.cycle);
                return open(BranchGap::KernelPoint, Some(place));
            }
            RingAnswer::Fails(_) => return open(BranchGap::NotIsolated, None),
            RingAnswer::Open { place } => return open(BranchGap::IsolationOpen, Some(place)),
        };
        let injective = self.branch.view.rank() == self.branch.linear.rows();
        let refuted = |statement, witness| Outcome::AtLeast {
            dimension: 2,
            statement,
            eigenvalues: top.longest.clone(),
            isolation: Some(isolation.clone()),
            witness: Some(witness),
        };
        let (place, witness) = match answer {
            RingAnswer::Open { place } => (place, None),
            RingAnswer::Fails(witness) => (Vec::new(), Some(witness)),
            RingAnswer::Holds(_) => return open(BranchGap::RingOpen, None),
        };
        if let Some(witness) = &witness {
            let leaves = matches!(witness, Witness::Point { offset, .. } if self.leaves_line(top, offset));
            // On a set a change of sign is one on a piece that is connected: Theorem 4′.
            let ordered = self.seen.iter().all(|p| p.position != Position::Unordered);
            let zero = ordered || matches!(witness, Witness::Point { .. });
            if leaves || top.block == 1 && injective && zero {
                return refuted(Statement::Theorem4, witness.clone());
            }
            if top.block == 2 && injective && self.is_single_block(top) {
                let c1 = Functional { row: second_functional(top.factor), ..functional.clone() };
                if let Some(crossing) = self.ring().crossing(&c1, functional, self.cx.budget.cells) {
                    return refuted(Statement::Section6, crossing);
                }
            }
        }
        // On the parts of a curve the search for a change of sign was part of the ring condition.
        if (witness.is_some() || self.seen.iter().any(|p| p.position == Position::Unordered))
            && let Some((proof, change)) = self.changes_sign(functional, &isolation, witness.as_ref())
        {
            return Outcome::AtLeast {
                dimension: 2,
                statement: Statement::Theorem4Sign,
                eigenvalues: top.longest.clone(),
                isolation: Some(proof),
                witness: Some(change),
            };
        }
        let Some(witness) = witness else {
            return open(BranchGap::RingOpen, Some(place));
        };
        let place = match witness {
            Witness::Point { address, .. } => address.prefix.into_iter().chain(address.cycle).collect(),
            Witness::SignChange { positive, .. } => positive.prefix.into_iter().chain(positive.cycle).collect(),
            Witness::Crossing { positive, .. } => positive.prefix,
        };
        open(BranchGap::RingFails, Some(place))
    }

    /// Theorem 4′.
    fn changes_sign(
        &self,
        functional: &Functional,
        isolation: &RingProof,
        known: Option<&Witness<E>>,
    ) -> Option<(RingProof, Witness<E>)> {
        let b = self.branch;
        let decide = |functionals: &[Functional]| self.decide(functionals);
        changes_sign(&self.ring(), &decide, (&b.spectrum, &b.linear, &b.view), functional, isolation, known)
    }

    /// Whether `E_1` is exactly one real block.
    fn is_single_block(&self, top: &Top) -> bool {
        self.branch.spectrum.classes()[0].members.len() == 1 && top.factor.blocks.len() == 1
    }

    /// Whether the orbit of a witness proves a second visible direction: its cyclic hull has a top of smaller modulus, whose
    /// directions the view does not send into the line.
    fn leaves_line(&self, top: &Top, offset: &[E]) -> bool {
        let hull = krylov(&self.branch.linear, offset);
        let Some(restricted) = restrict(&self.branch.linear, &hull) else { return false };
        let spectrum = E::spectrum(&restricted, self.cx.base);
        let Some(own) = self::top(&spectrum) else { return false };
        if own.root.is_zero() || own.root.cmp_modulus(top.root) != std::cmp::Ordering::Less {
            return false;
        }
        let view = &self.branch.view * &hull;
        let line = self.direction(top);
        own.longest.iter().any(|&(f, r)| {
            let factor = spectrum.part(f);
            let chain = longest_chain(factor.right, own.block);
            if factor.roots[r].is_real() {
                let coords = apply(&view, &chain.vectors[0], factor.over);
                let second = Direction { root: factor.places[r].clone(), coords };
                second.coords.iter().any(|c| !c.is_zero()) && line.same_line(&second).is_none()
            } else {
                visible_dimension(&view, &spectrum, &[(f, r)], own.block) >= 2
            }
        })
    }

    /// `G v` for the eigenvector `v` at the end of the longest chain.
    fn direction(&self, top: &Top) -> Direction {
        let chain = longest_chain(top.factor.right, top.block);
        Direction { root: top.place.clone(), coords: apply(&self.branch.view, &chain.vectors[0], top.factor.over) }
    }

    /// The sign `s` such that points with a positive functional tend to `s` times the given ray: it compares the functional
    /// with the top of the longest chain, and the normalised direction with `G v`.
    fn sense(&self, top: &Top, direction: &Direction) -> Option<i32> {
        let f = top.factor.over.modulus;
        let chain = longest_chain(top.factor.right, top.block);
        let row = leading_functional(top.factor, top.block);
        let last = &chain.vectors[top.block - 1];
        let zero = Elem::from_rational(&Rational::from(0));
        let pairing = row.iter().zip(last).fold(zero, |s, (a, b)| s.add(&a.mul(b, f)));
        let orientation = self.direction(top).same_line(direction)?;
        // λ^{-ℓ} in the leading coefficient u.
        let parity = if top.block.is_multiple_of(2) { top.root.sign() } else { 1 };
        Some(pairing.sign(top.place) * orientation * parity)
    }

    /// The limit rays per side of the point: the signs on the ring, closed under the map of one turn.
    fn rays(&self, top: &Top, direction: &Direction, flip: i32, proof: &RingProof) -> Rays {
        let ordered = self.cx.shape.states[self.branch.state].kind == CellKind::Edge;
        let turn = if ordered { self.branch.cycle_sign } else { 1 };
        let mut pairs: Vec<(i32, i32)> = Vec::new();
        for cell in &proof.discharged {
            let side = match cell.position {
                Position::Before => -1,
                Position::After | Position::Unordered => 1,
            };
            let (mut side, mut sign) = (side, cell.sign * flip);
            for _ in 0..4 {
                if !pairs.contains(&(side, sign)) {
                    pairs.push((side, sign));
                }
                side *= turn;
                sign *= top.root.sign();
            }
        }
        let on = |wanted: i32| -> Vec<Direction> {
            [1, -1].into_iter().filter(|s| pairs.contains(&(wanted, *s))).map(|s| direction.times(s)).collect()
        };
        let (before, after) = (on(-self.branch.prefix_sign), on(self.branch.prefix_sign));
        match (ordered, self.branch.side) {
            (false, _) => Rays { left: Vec::new(), right: [before, after].concat() },
            (true, _) => Rays { left: before, right: after },
        }
    }

    fn holder(&self, top: &Top) -> Holder {
        let shape = self.cx.shape;
        let states = shape.path(self.branch.state, &self.branch.address.cycle);
        let turns = self.branch.address.cycle.iter().zip(&states);
        let scale = turns.fold(Rational::from(1), |s, (&letter, &e)| s * shape.states[e].share(letter));
        Holder { eigenvalue: top.root.clone(), scale, power: top.block - 1 }
    }
}

/// The rows that vanish on the generalised kernel of `linear` (theory §3, Isolation): all coordinates where it is invertible.
pub(super) fn isolation_functionals<E: Scalar>(linear: &Matrix<E>, base: &E::Base) -> Vec<Functional> {
    let rows = invertible_rows(linear);
    (0..rows.rows()).map(|k| Functional::of(rows.row(k), base)).collect()
}

pub(super) fn longest_chain(chains: &[Chain], block: usize) -> &Chain {
    chains.iter().find(|c| c.vectors.len() == block).expect("a chain of every block size")
}

/// The functional whose value is the coefficient of the last vector of the longest right chain, up to a factor.
fn leading_functional(factor: Factor<'_>, block: usize) -> Vec<Elem> {
    longest_chain(factor.left, block).vectors[0].clone()
}

/// For a single block of length 2: the functional that reads the coefficient of `v_1` where that of `v_2` vanishes, with the
/// sign for which `c_1 c_2` is that of the chain.
fn second_functional(factor: Factor<'_>) -> Vec<Elem> {
    longest_chain(factor.left, 2).vectors[1].clone()
}

/// `matrix v` for a vector over a field that holds the entries of the matrix.
pub(super) fn apply<E: Scalar>(matrix: &Matrix<E>, v: &[Elem], over: Over<'_>) -> Vec<Elem> {
    (0..matrix.rows())
        .map(|i| {
            let terms = matrix.row(i).iter().zip(v).filter(|(a, _)| !a.is_zero());
            terms.fold(Elem::zero(), |s, (a, x)| s.add(&a.scaled(x, over)))
        })
        .collect()
}

/// A lower bound, up to 2, of the dimension of the image under `view` of the real span of the eigenvectors that end the
/// longest chains.
///
/// Exact where the view is injective; otherwise a nonzero 2x2 minor of two spanning vectors is looked for in enclosures.
fn visible_dimension<E: Scalar>(
    view: &Matrix<E>,
    spectrum: &E::Spectrum,
    members: &[(usize, usize)],
    block: usize,
) -> usize {
    if view.rank() == view.cols() {
        return real_dimension(spectrum, members, block);
    }
    let mut vectors: Vec<Vec<crate::arith::Interval>> = Vec::new();
    let mut done: Vec<(usize, usize)> = Vec::new();
    for &(f, r) in members {
        if done.contains(&(f, r)) {
            continue;
        }
        done.push((f, r));
        let factor = spectrum.part(f);
        for chain in factor.right.iter().filter(|c| c.vectors.len() == block) {
            let image = apply(view, &chain.vectors[0], factor.over);
            let boxes: Vec<_> = image.iter().map(|e| e.enclosure(&factor.places[r], 128)).collect();
            vectors.push(boxes.iter().map(|(re, _)| re.clone()).collect());
            if !factor.roots[r].is_real() {
                vectors.push(boxes.into_iter().map(|(_, im)| im).collect());
            }
        }
    }
    let independent = |a: &[crate::arith::Interval], b: &[crate::arith::Interval]| {
        (0..a.len()).any(|i| (0..i).any(|j| !(&(&a[i] * &b[j]) - &(&a[j] * &b[i])).contains_zero()))
    };
    let found = (0..vectors.len()).any(|i| (0..i).any(|j| independent(&vectors[i], &vectors[j])));
    if found { 2 } else { 1 }
}

/// The dimension of `U`: every block counts once per eigenvalue, conjugates included.
fn real_dimension<S: Spectral>(spectrum: &S, members: &[(usize, usize)], block: usize) -> usize {
    let mut done: Vec<(usize, usize)> = Vec::new();
    for &m in members {
        if !done.contains(&m) {
            done.push(m);
        }
    }
    let per_root = |f: usize| spectrum.part(f).blocks.iter().filter(|&&b| b == block).count();
    let listed: usize = done.iter().map(|&(f, _)| per_root(f)).sum();
    // A complex eigenvalue listed without its conjugate still spans a plane.
    let lonely = done.iter().filter(|&&(f, r)| {
        let root = &spectrum.part(f).roots[r];
        !root.is_real() && !done.iter().any(|&(g, s)| g == f && spectrum.part(g).roots[s].same(&root.conjugate()))
    });
    listed + lonely.map(|&(f, _)| per_root(f)).sum::<usize>()
}

/// A basis of the cyclic hull of `x`, as columns.
pub fn krylov<E: Scalar>(linear: &Matrix<E>, x: &[E]) -> Matrix<E> {
    let mut rows = Matrix::zero(0, x.len());
    let mut v = x.to_vec();
    loop {
        let grown = rows.stack(&Matrix::from_rows(x.len(), vec![v.clone()])).echelon().rows;
        if grown.rows() == rows.rows() {
            return rows.transpose();
        }
        rows = grown;
        v = linear.apply(&v);
    }
}

/// The matrix of `linear` on an invariant subspace.
pub fn restrict<E: Scalar>(linear: &Matrix<E>, basis: &Matrix<E>) -> Option<Matrix<E>> {
    basis.solve(&(linear * basis))
}

fn rate<S: Spectral>(spectrum: &S, top: &Top) -> Rate {
    if top.block > 1 {
        return Rate::Harmonic;
    }
    let Some(next) = spectrum.classes().get(1) else { return Rate::Exact };
    let slower = spectrum.value(next.members[0]);
    if slower.is_zero() {
        return Rate::Exact;
    }
    let longest = next.members.iter().map(|m: &Eigenvalue| spectrum.part(m.factor).blocks[0]).fold(1, usize::max);
    Rate::Geometric { slower: slower.clone(), dominant: top.root.clone(), power: longest - 1 }
}
