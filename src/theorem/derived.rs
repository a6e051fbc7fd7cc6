//! The derivatives of a curve in its visible quotients, order by order (theory §11, Theorem E): spaces of differences, values at the
//! ends, and the equations at the joints.

use super::frames::component;
use super::smoothness::{CurveOrder, CurveRegularityError, Jump, Outcome, Seen, Shares};
use crate::arith::{Interval, Rational, abs, binomial};
use crate::linalg::{Entry, Matrix, closures};
use crate::radius::{Arrow, JointRadius, Options, Radial, System, joint_radius};
use crate::shape::{CellKind, End, Frame, Piece, Shape, Spaces, difference};
use std::collections::VecDeque;

/// The difference of order `k` of the unit vectors from number `j` on.
fn alternating<E: Entry>(dim: usize, j: usize, k: usize) -> Vec<E> {
    let mut out = vec![E::zero(); dim];
    for i in 0..=k {
        let size = binomial(k, i);
        out[j + i] = E::of(&if (k - i).is_multiple_of(2) { size } else { -size });
    }
    out
}

pub(super) fn power(base: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(Rational::from(1), |p, _| p * base)
}

/// The joint spectral radius of these operators; 0 without them.
pub(super) fn radius_of<E: Radial>(
    system: Option<&System<E>>,
    options: &Options,
) -> (Option<JointRadius<E>>, Option<Interval>) {
    let Some(system) = system else { return (None, Some(Interval::point(Rational::from(0)))) };
    let Ok(radius) = joint_radius(system, options) else { return (None, None) };
    let enclosure = radius.upper.clone().map(|upper| match &radius.lower {
        Some(lower) if radius.exact => lower.enclosure(96),
        Some(lower) => Interval::new(lower.enclosure(96).lo, upper),
        None => Interval::new(Rational::from(0), upper),
    });
    (Some(radius), enclosure)
}

/// A curve in its visible quotients. Families and chords go by the position of a state among the reachable ones.
pub(super) struct Curve<'a, E: Radial = Rational> {
    shape: &'a Shape<E>,
    spaces: &'a Spaces<E>,
    states: Vec<usize>,
    /// By state of the shape, its position.
    positions: Vec<Option<usize>>,
    /// `N`, the number of pieces of the states that come back to themselves.
    pub(super) pieces: usize,
    /// Where the pieces of a state do not take equal shares of the parameter, what they take.
    shares: Option<Shares>,
    /// By position and letter: the map `W_to -> W_from`.
    operators: Vec<Vec<Matrix<E>>>,
}

pub(super) type Families<E = Rational> = Vec<Matrix<E>>;
pub(super) type Chords<E = Rational> = Vec<Vec<E>>;
pub(super) type Ends<E = Rational> = Vec<[Vec<E>; 2]>;

impl<'a, E: Radial> Curve<'a, E> {
    pub(super) fn new(shape: &'a Shape<E>, spaces: &'a Spaces<E>) -> Result<Self, CurveRegularityError> {
        let count = |e: &usize| shape.states[*e].pieces.len();
        let states = shape.reachable();
        if shape.has_shares() {
            let own = |e: &usize| (0..count(e)).map(|i| shape.states[*e].share(i)).collect();
            return Self::of(shape, spaces, 1, Some(states.iter().map(own).collect()));
        }
        let returning: Vec<usize> = states.iter().filter(|e| !component(shape, **e).is_empty()).map(count).collect();
        match returning.first() {
            Some(&first) if first >= 2 && returning.iter().all(|n| *n == first) => Self::of(shape, spaces, first, None),
            _ => Err(CurveRegularityError::Pieces),
        }
    }

    /// The curve with equal shares of the parameter, or with given ones, of which `pieces` says nothing.
    pub(super) fn of(
        shape: &'a Shape<E>,
        spaces: &'a Spaces<E>,
        pieces: usize,
        shares: Option<Shares>,
    ) -> Result<Self, CurveRegularityError> {
        let states = shape.reachable();
        if states.iter().any(|e| shape.states[*e].kind != CellKind::Edge || shape.states[*e].pieces.is_empty()) {
            return Err(CurveRegularityError::Pieces);
        }
        if spaces.of(shape.start).visible.rows() == 0 {
            return Err(CurveRegularityError::Point);
        }
        let mut positions = vec![None; shape.states.len()];
        for (k, &e) in states.iter().enumerate() {
            positions[e] = Some(k);
        }
        let of = |e: usize| shape.states[e].pieces.iter().map(|p| spaces.on_visible(&p.op, e, p.target)).collect();
        let operators: Option<Vec<Vec<Matrix<E>>>> = states.iter().map(|&e| of(e)).collect();
        let operators = operators.ok_or_else(|| CurveRegularityError::Ends(shape.states[shape.start].name.clone()))?;
        Ok(Self { shape, spaces, states, positions, pieces, shares, operators })
    }

    /// The whole spaces `W_e` and the chords of the curves in them.
    pub(super) fn first(&self) -> Result<(Families<E>, Chords<E>), CurveRegularityError> {
        let families = (0..self.states.len()).map(|e| Matrix::identity(self.dim(e))).collect();
        let chord = |&e: &usize| {
            let end = |end| self.shape.end_point(e, end);
            let (start, finish) = end(End::Start).zip(end(End::Finish))?;
            Some(self.spaces.in_visible(e, &difference(&finish, &start)))
        };
        let chord = |e| chord(e).ok_or_else(|| CurveRegularityError::Ends(self.shape.states[*e].name.clone()));
        Ok((families, self.states.iter().map(chord).collect::<Result<_, _>>()?))
    }

    /// The position of a state that is reached.
    pub(super) fn position(&self, state: usize) -> usize {
        self.positions[state].expect("a piece of a reachable state leads to a reachable state")
    }

    /// The dimension of `W_e`.
    fn dim(&self, position: usize) -> usize {
        self.spaces.of(self.states[position]).visible.rows()
    }

    /// All pieces: position, letter, piece, position of the target.
    fn arrows(&self) -> impl Iterator<Item = (usize, usize, &'a Piece<E>, usize)> {
        self.states.iter().enumerate().flat_map(move |(from, &e)| {
            let pieces = self.shape.states[e].pieces.iter().enumerate();
            pieces.map(move |(letter, p)| (from, letter, p, self.position(p.target)))
        })
    }

    /// `(ε N_e)^k`, or `(ε/s)^k` for a piece with the share `s`: what derivatives of order `k` are multiplied with on it.
    fn factor(&self, k: usize, from: usize, letter: usize) -> Rational {
        let pieces = &self.shape.states[self.states[from]].pieces;
        let one = match &self.shares {
            Some(shares) => Rational::from(1) / &shares[from][letter],
            None => Rational::from(pieces.len()),
        };
        power(&if pieces[letter].reversed { -one } else { one }, k)
    }

    pub(super) fn order(&self, k: usize, families: &[Matrix<E>], options: &Options) -> CurveOrder<E> {
        let system = self.system(k, families);
        let (radius, enclosure) = radius_of(system.as_ref(), options);
        let dims = families.iter().map(Matrix::rows).collect();
        let threshold = match self.shares {
            Some(_) => Rational::from(1),
            None => Rational::from(1) / power(&Rational::from(self.pieces), k),
        };
        let outcome = if k == 0 { Outcome::Curve } else { Outcome::Open };
        let shares = self.shares.clone();
        CurveOrder { order: k, threshold, shares, dims, system, radius, enclosure, outcome, polygons: None }
    }

    /// The operators on the families; with shares, those of the derivatives of order `k`, but for signs.
    fn system(&self, k: usize, families: &[Matrix<E>]) -> Option<System<E>> {
        let scaled = self.shares.is_some();
        self.scaled_system(families, |from, letter| scaled.then(|| abs(&self.factor(k, from, letter))))
    }

    /// The operators on the families, times factors by position and letter.
    pub(super) fn scaled_system(
        &self,
        families: &[Matrix<E>],
        factor: impl Fn(usize, usize) -> Option<Rational>,
    ) -> Option<System<E>> {
        if families.iter().all(|f| f.rows() == 0) {
            return None;
        }
        let pivots: Vec<Vec<usize>> = families.iter().map(|f| f.echelon().pivots).collect();
        let mut arrows = Vec::new();
        for (from, letter, _, to) in self.arrows() {
            let images = &families[to] * &self.operators[from][letter].transpose();
            let matrix =
                Matrix::from_fn(pivots[from].len(), images.rows(), |i, j| images[(j, pivots[from][i])].clone());
            let matrix = factor(from, letter).map_or(matrix.clone(), |factor| matrix.scale(&E::of(&factor)));
            arrows.push(Arrow { from, to, matrix, label: arrows.len() });
        }
        Some(System { dims: pivots.iter().map(Vec::len).collect(), arrows })
    }

    /// The differences of the derivatives of order `k`: the smallest families with `(ε N)^k T_i c_δ − c_e ∈ F_e` for the chords
    /// of order `k−1`, and `T_i F_δ ⊂ F_e`. Rows in echelon form.
    pub(super) fn differences(&self, k: usize, chords: &Chords<E>) -> Families<E> {
        let mut families: Families<E> = chords.iter().map(|c| Matrix::zero(0, c.len())).collect();
        for (from, letter, _, to) in self.arrows() {
            let image = self.scaled(k, from, letter).apply(&chords[to]);
            let offset = Matrix::from_rows(image.len(), vec![difference(&image, &chords[from])]);
            families[from] = families[from].stack(&offset).echelon().rows;
        }
        let arrow = |(from, letter, _, to): (usize, usize, &Piece<E>, usize)| {
            (to, from, self.operators[from][letter].transpose())
        };
        let arrows: Vec<_> = self.arrows().map(arrow).collect();
        closures(families, &arrows)
    }

    /// The values of the derivative of order `k` at the two ends of every curve.
    pub(super) fn ends(&self, k: usize, families: &[Matrix<E>], chords: &Chords<E>) -> Option<Ends<E>> {
        let both = |&e: &usize| {
            Some([self.limit(k, e, End::Start, families, chords)?, self.limit(k, e, End::Finish, families, chords)?])
        };
        self.states.iter().map(both).collect()
    }

    /// The limit of `(ε N)^k T c` along the address of an end: the fixed vector of its cycle in `c + F`, unique because the
    /// radius on `F` is below `N^−k`, carried along the prefix.
    fn limit(&self, k: usize, state: usize, end: End, families: &[Matrix<E>], chords: &Chords<E>) -> Option<Vec<E>> {
        let address = self.shape.end_address(state, end, |_| false)?;
        let (prefix, home) = self.product(k, self.position(state), &address.prefix);
        let (cycle, _) = self.product(k, home, &address.cycle);
        // (M − 1)(c + Fᵗ y) = 0.
        let shifted = &cycle - &Matrix::identity(cycle.rows());
        let family = families[home].transpose();
        let right: Vec<E> = shifted.apply(&chords[home]).iter().map(E::negated).collect();
        let y = (&shifted * &family).solve(&Matrix::from_columns(right.len(), &[right]))?.column(0);
        let fixed: Vec<E> = chords[home].iter().zip(family.apply(&y)).map(|(c, f)| c.plus(&f)).collect();
        Some(prefix.apply(&fixed))
    }

    /// The operator of a piece as derivatives of order `k` are multiplied with it.
    fn scaled(&self, k: usize, from: usize, letter: usize) -> Matrix<E> {
        self.operators[from][letter].scale(&E::of(&self.factor(k, from, letter)))
    }

    /// The product of the scaled operators along a word, and the position where it ends.
    fn product(&self, k: usize, from: usize, word: &[usize]) -> (Matrix<E>, usize) {
        let start = Matrix::identity(self.dim(from));
        word.iter().fold((start, from), |(product, at), &letter| {
            let piece = &self.shape.states[self.states[at]].pieces[letter];
            (&product * &self.scaled(k, at, letter), self.position(piece.target))
        })
    }

    /// The first joint of the first level at which the derivative of order `k` has two values.
    pub(super) fn joints(&self, k: usize, ends: &Ends<E>) -> Option<Jump<E>> {
        for (from, &state) in self.states.iter().enumerate() {
            let value = |letter: usize, end: End| {
                let piece = &self.shape.states[state].pieces[letter];
                let own = &ends[self.position(piece.target)][usize::from(end.in_piece(piece) == End::Finish)];
                self.scaled(k, from, letter).apply(own)
            };
            for right in 1..self.operators[from].len() {
                let (before, after) = (value(right - 1, End::Finish), value(right, End::Start));
                if before != after {
                    return Some(Jump { state, right, seen: self.seen(k, from, [before, after]) });
                }
            }
        }
        None
    }

    /// Two values that differ in `W_e`, carried to the start along the first path that keeps them apart.
    fn seen(&self, k: usize, place: usize, [before, after]: [Vec<E>; 2]) -> Option<Seen<E>> {
        let space = self.spaces.of(self.shape.start);
        // Any lift of a vector of the visible quotient is seen as the same vector.
        let pivots = space.visible.echelon().pivots;
        let view = &self.shape.view() * &space.basis;
        let view = Matrix::from_fn(view.rows(), pivots.len(), |i, j| view[(i, pivots[j])].clone());
        let jump = difference(&before, &after);
        let mut queue = VecDeque::from([(Vec::new(), true)]);
        let mut known: Families<E> = (0..self.states.len()).map(|e| Matrix::zero(0, self.dim(e))).collect();
        while let Some((path, forwards)) = queue.pop_front() {
            let (product, at) = self.product(k, 0, &path);
            let rows = &view * &product;
            if at == place && rows.apply(&jump).iter().any(|x| !x.is_zero()) {
                let (left, right) = if forwards { (before, after) } else { (after, before) };
                return Some(Seen { path, left: rows.apply(&left), right: rows.apply(&right) });
            }
            // Only paths whose rows are new lead to anything new.
            let joined = known[at].stack(&rows).echelon().rows;
            if joined.rows() > known[at].rows() {
                known[at] = joined;
                for (letter, piece) in self.shape.states[self.states[at]].pieces.iter().enumerate() {
                    queue.push_back(([path.as_slice(), &[letter]].concat(), forwards != piece.reversed));
                }
            }
        }
        None
    }

    /// What refutes an order whose radius is not known to be below the threshold.
    pub(super) fn refuted(
        &self,
        order: &CurveOrder<E>,
        before: &Families<E>,
        now: &Families<E>,
        chords: &Chords<E>,
    ) -> Outcome<E> {
        if order.has_slow_cycle() {
            return Outcome::Cycle;
        }
        let turns_back = |k: usize| {
            let inside = now[k].stack(&Matrix::from_rows(chords[k].len(), vec![chords[k].clone()]));
            before[k].rows() > 0 && inside.rank() == now[k].rows() && self.is_closed(k)
        };
        match (0..self.states.len()).find(|&k| turns_back(k)) {
            Some(k) => Outcome::Chord(self.states[k]),
            None => Outcome::Open,
        }
    }

    /// For an order `k` that holds, the numbers `μ_e` of “Difference polygons” by state; `None` where a state has none.
    pub(super) fn polygons(&self, k: usize, families: &[Matrix<E>], chords: &Chords<E>) -> Option<Vec<E>> {
        let of = |place: usize| {
            let (state, dim) = (self.states[place], self.shape.states[self.states[place]].dim);
            // c and a basis of F, as columns.
            let chord = Matrix::from_columns(chords[place].len(), &[chords[place].clone()]);
            let spanned = chord.beside(&families[place].transpose());
            let mut common: Option<E> = None;
            for j in 0..dim.checked_sub(k)? {
                let vector = self.spaces.in_visible_if_relevant(state, &alternating(dim, j, k))?;
                let found = spanned.solve(&Matrix::from_columns(vector.len(), &[vector]))?;
                let multiple = found[(0, 0)].clone();
                if common.as_ref().is_some_and(|c| *c != multiple) {
                    return None;
                }
                common = Some(multiple);
            }
            // The multiple is one number only where the chord is not in F.
            let independent = spanned.rank() == 1 + families[place].rows();
            common.filter(|c| independent && !c.is_zero())
        };
        (self.shape.frame == Frame::Barycentric).then(|| (0..self.states.len()).map(of).collect())?
    }

    /// Whether all states that are reached from this one lead back to it.
    fn is_closed(&self, place: usize) -> bool {
        let reached = |from: usize| {
            let mut list = vec![from];
            let mut next = 0;
            while next < list.len() {
                for piece in &self.shape.states[self.states[list[next]]].pieces {
                    let to = self.position(piece.target);
                    if !list.contains(&to) {
                        list.push(to);
                    }
                }
                next += 1;
            }
            list
        };
        reached(place).into_iter().all(|k| reached(k).contains(&place))
    }
}
