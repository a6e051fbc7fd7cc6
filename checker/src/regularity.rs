//! Orders of smoothness of a curve in its parameter: joint spectral radii on a descending chain of invariant spaces, and
//! the joint equation of every order, in the visible quotients (theory §11, Theorem E).

use crate::base::{
    Accepted, Checked, Ground, Matrix, Node, Q, Surd, Verdict, Whole, bits, list, need, number, some, spend, total,
    whole,
};
use crate::claim::Claim;
use crate::curve::case;
use crate::curve::{Case, End, Kind, Model, Piece, Shape, Spaces, Way, close};
use crate::jsr::{System, bounds};
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// Most orders of one certificate.
const MAX_ORDERS: usize = 32;

/// The curves in their visible quotients, and the derivatives of one order.
struct Level<'a, T: Whole> {
    shape: &'a Shape<T>,
    spaces: &'a Spaces<T>,
    ground: &'a T::Ground,
    /// `N`, the number of pieces of every state that comes back to itself.
    pieces: usize,
    /// By state and letter, what pieces take of the parameter, where that is not `1/N`.
    shares: Option<Vec<Vec<Q>>>,
    /// The order `k`.
    order: usize,
    /// By state: the differences of the derivatives of this order as rows in echelon form.
    families: Vec<Matrix<T>>,
    /// By state: the derivative of the order before at the finish minus that at the start; for order 0 and 1 the chord.
    chords: Vec<Matrix<T>>,
}

/// Checks the proof of a certificate of the kind `regularity`.
pub fn check(text: &str, node: &Node<'_>) -> Checked<Accepted> {
    let Some(field) = node.get("field") else {
        return checked(&case::read(text, false)?, &(), false, node);
    };
    let ground = Ground::read(&field)?;
    checked(&case::over::<Surd>(text, false, &ground)?, &ground, true, node)
}

fn checked<T: Whole>(case: &Case<T>, ground: &T::Ground, field: bool, node: &Node<'_>) -> Checked<Accepted> {
    let shared = case.shape.pieces().any(|(_, p)| p.share.is_some());
    let (contraction, orders, exponents) = match (field, shared) {
        (false, true) => {
            let [contraction, orders, exponents] = node.fields("contraction orders exponent")?;
            (contraction, orders, Some(exponents))
        }
        (false, false) => {
            let [contraction, orders] = node.fields("contraction orders")?;
            (contraction, orders, None)
        }
        (true, true) => {
            let [_, contraction, orders, exponents] = node.fields("field contraction orders exponent")?;
            (contraction, orders, Some(exponents))
        }
        (true, false) => {
            let [_, contraction, orders] = node.fields("field contraction orders")?;
            (contraction, orders, None)
        }
    };
    let model = Model::read(&case.shape, ground, &contraction)?;
    contraction.at(case.shape.check_curves())?;
    let mut level = node.at(Level::own(&model))?;
    let mut last = level.families.clone();
    let (items, mut claims, mut lines) = (orders.list()?, Vec::new(), Vec::new());
    orders.need((1..=MAX_ORDERS).contains(&items.len()), "orders", "orders from 0 on are needed")?;
    let (mut exponent, mut least) = (None, Q::zero());
    for (k, item) in items.iter().enumerate() {
        let [order, dims, radius, outcome] = item.fields("order dims radius outcome")?;
        order.need(order.index(MAX_ORDERS)? == k, "orders", "the orders come one after the other")?;
        let before = level.families.clone();
        if k > 0 {
            level = item.at(level.next())?;
        }
        let found: Vec<usize> = level.shape.reachable.iter().map(|&e| level.families[e].rows).collect();
        dims.need(dims.indices(usize::MAX)? == found, "orders", format_args!("the dimensions are {}", list(&found)))?;
        let (low, high) = level.radius(&radius)?;
        lines.push(Claim::RadiusOfOrder(k, low.clone(), high.clone()).is(Verdict::Proved));
        let (smooth, ends_here) = match outcome.text()? {
            "curve" if k == 0 => (true, false),
            word @ ("holds" | "joint") if k > 0 => {
                radius.need(
                    &high * &level.power(k) < Q::one(),
                    "orders",
                    "the radius is not below N to the power -k",
                )?;
                let ends = item.at(level.ends())?;
                let agree = level.joined(&ends)?;
                outcome.need(agree == (word == "holds"), "orders", "the joint equations say something else")?;
                level.chords = ends.iter().map(|[start, finish]| finish.minus(start)).collect();
                (agree, found.iter().all(|d| *d == 0) || !agree)
            }
            "cycle" if k > 0 => {
                let slow = &low * &level.power(k) >= Q::one();
                radius.need(slow, "orders", "no cycle with a radius of N to the power -k or more")?;
                (false, true)
            }
            "exponent" if k > 0 => {
                let slow = &least * &level.power(k) > Q::one();
                outcome.need(slow, "orders", "the radius of the order before is not above N to the power -k")?;
                (false, true)
            }
            "chord" if k > 0 => {
                outcome.need(level.turns_back(&before)?, "orders", "no chord among the differences")?;
                (false, true)
            }
            _ => return outcome.reject("orders", "an outcome that this order cannot have"),
        };
        orders.need(!ends_here || k + 1 == items.len(), "orders", "there is nothing after this order")?;
        let verdict = if smooth { Verdict::Proved } else { Verdict::Refuted };
        claims.push(Claim::Smooth { order: k }.is(verdict));
        least.clone_from(&low);
        if smooth {
            exponent = (!found.iter().all(|d| *d == 0)).then_some((k, low, high));
            last.clone_from(&level.families);
        }
    }
    let smoothest = match (exponent, exponents) {
        (None, _) => Claim::Polynomial,
        (Some((order, ..)), Some(bounds)) => {
            level.families = last;
            level.exponents(order, &bounds)?
        }
        (Some((order, low, high)), None) => Claim::Exponent { order, pieces: level.pieces, low, high },
    };
    claims.push(smoothest.is(Verdict::Proved));
    Ok(Accepted { case: case.name.clone(), verdict: Verdict::Proved, claims, points: lines })
}

/// Theorem 12: the curve is C¹ in the uniform parameter, or in the one with the given shares, and a graph over it in its visible
/// quotients and as it is seen.
pub fn graph<T: Whole>(model: &Model<'_, T>, shares: Option<&Node<'_>>, radius: &Node<'_>) -> Checked<()> {
    let first = match shares {
        None => Level::uniform(model)?,
        Some(node) => Level::first(model, 1, Some(node.at(read_shares(model, node))?))?,
    };
    let level = first.next()?;
    let (_, high) = level.radius(radius)?;
    let bound = if shares.is_some() { high } else { &high * &level.power(1) };
    radius.need(bound < Q::one(), "graph", "the radius is not below 1/N, or below 1 where shares are given")?;
    need(level.joined(&level.ends()?)?, "graph", "the derivatives at a joint are not equal")?;
    let outside = |rows: &Matrix<T>, chord: &Matrix<T>| Ok(rows.stack(&chord.transpose()).rank()? > rows.rank()?);
    for &e in &level.shape.reachable {
        let free = outside(&level.families[e], &level.chords[e])?;
        need(free, "graph", format_args!("the chord of state {e} lies among the differences of the derivative"))?;
    }
    let (start, shape) = (model.spaces.of(level.shape.start)?, level.shape);
    // Any lift of a vector of the visible quotient is seen as the same vector.
    let view = shape.view.times(&start.basis)?.columns(&start.leading);
    let seen = level.families[shape.start].times(&view.transpose())?;
    let seen = outside(&seen, &view.times(&level.chords[shape.start])?)?;
    need(seen, "graph", "the projection of the chord lies among those of the differences of the derivative")
}

/// Positive shares of the pieces of every reachable state, of sum 1.
fn read_shares<T: Whole>(model: &Model<'_, T>, node: &Node<'_>) -> Checked<Vec<Vec<Q>>> {
    let shape = model.shape;
    let mut all = vec![Vec::new(); shape.states.len()];
    for (item, &e) in node.exactly(shape.reachable.len(), "graph")?.iter().zip(&shape.reachable) {
        let shares = item.vector(shape.states[e].pieces.len())?;
        let whole = shares.iter().all(Signed::is_positive) && total(shares.iter().cloned())? == Q::one();
        item.need(whole, "graph", "the shares of the pieces of a state are positive and sum to 1")?;
        all[e] = shares;
    }
    Ok(all)
}

/// Most bits of the powers with which a factor is compared with a power of a share.
const MAX_POWER_BITS: u64 = 1 << 23;

/// `r` compared with `s^(-p/q)`: `r^q s^p` with 1.
fn compared(factor: &Q, share: &Q, exponent: &Q) -> Checked<Ordering> {
    need(factor.is_positive(), "orders", "a factor is not positive")?;
    let (p, q) = (exponent.numer().to_u64(), exponent.denom().to_u64());
    let (p, q) = (some(p, "orders", "a long exponent")?, some(q, "orders", "a long exponent")?);
    let size = bits(factor).saturating_mul(q).saturating_add(bits(share).saturating_mul(p));
    need(size <= MAX_POWER_BITS, "limit", "long powers of shares")?;
    // Repeated squares, and two products at the end.
    spend(2, size)?;
    let power = |x: &Q, n: u64| {
        (num_traits::pow(x.numer().clone(), n as usize), num_traits::pow(x.denom().clone(), n as usize))
    };
    let ((a, b), (c, d)) = (power(factor, q), power(share, p));
    Ok((a * c).cmp(&(b * d)))
}

/// The states that can be reached from one, itself among them.
fn reached<T: Whole>(shape: &Shape<T>, from: usize) -> Vec<usize> {
    let (mut list, mut next) = (vec![from], 0);
    while next < list.len() {
        for piece in &shape.states[list[next]].pieces {
            if !list.contains(&piece.target) {
                list.push(piece.target);
            }
        }
        next += 1;
    }
    list
}

impl<'a, T: Whole> Level<'a, T> {
    /// The curve itself, where the states that come back to themselves have the same number of pieces.
    fn uniform(model: &'a Model<'a, T>) -> Checked<Self> {
        let shape = model.shape;
        let returning = |e: &&usize| shape.states[**e].pieces.iter().any(|p| reached(shape, p.target).contains(*e));
        let counts: Vec<usize> =
            shape.reachable.iter().filter(returning).map(|&e| shape.states[e].pieces.len()).collect();
        let pieces = *some(counts.first(), "orders", "no state comes back to itself")?;
        let uniform = counts.iter().all(|n| *n == pieces);
        need(uniform && pieces >= 2, "orders", "a curve of one number of pieces is needed")?;
        Self::first(model, pieces, None)
    }

    /// The curve itself: every reachable state is an edge, and more than a point is seen.
    fn first(model: &'a Model<'a, T>, pieces: usize, shares: Option<Vec<Vec<Q>>>) -> Checked<Self> {
        let (shape, spaces) = (model.shape, &model.spaces);
        let edges = shape.reachable.iter().all(|&e| shape.states[e].kind == Kind::Edge);
        need(edges, "orders", "a curve is needed")?;
        let mut families = shape.no_rows();
        let mut chords = shape.no_rows();
        for &e in &shape.reachable {
            let space = spaces.of(e)?;
            families[e] = Matrix::identity(space.visible.rows);
            let chord = shape.end_point(e, End::Finish)?.minus(&shape.end_point(e, End::Start)?);
            chords[e] = space.visible.times(&space.reading.times(&chord)?)?;
        }
        need(families[shape.start].rows > 0, "orders", "the curve is a point")?;
        Ok(Self { shape, spaces, ground: &model.ground, pieces, shares, order: 0, families, chords })
    }

    /// The curve in the parameter of the case: with its shares where it gives some.
    fn own(model: &'a Model<'a, T>) -> Checked<Self> {
        let shape = model.shape;
        if shape.pieces().all(|(_, p)| p.share.is_none()) {
            return Self::uniform(model);
        }
        let mut all = vec![Vec::new(); shape.states.len()];
        for &e in &shape.reachable {
            let pieces = &shape.states[e].pieces;
            let equal = whole(pieces.len() as i64).recip();
            let share = |p: &Piece<T>| match &p.share {
                Some(share) => share.clone(),
                None => equal.clone(),
            };
            all[e] = pieces.iter().map(share).collect();
        }
        Self::first(model, 1, Some(all))
    }

    /// Bounds of the supremum of the exponents by factors on the safe side of the powers of the shares.
    fn exponents(&self, order: usize, node: &Node<'_>) -> Checked<Claim> {
        let [below, above] = node.fields("below above")?;
        let mut bounds = [whole(order as i64), whole(order as i64 + 1)];
        for (side, node) in [below, above].iter().enumerate().filter(|(_, n)| !n.is_null()) {
            let [at, factors, radius] = node.fields("at factors radius")?;
            let exponent = number(&at)?;
            let inside = bounds[0] < exponent && exponent < bounds[1];
            at.need(inside, "orders", "the exponents lie between the order and the next one, in their order")?;
            let mut all = vec![Vec::new(); self.shape.states.len()];
            for (item, &e) in factors.exactly(self.shape.reachable.len(), "orders")?.iter().zip(&self.shape.reachable) {
                all[e] = item.vector(self.shape.states[e].pieces.len())?;
                for (letter, factor) in all[e].iter().enumerate() {
                    let share = self.share(e, letter)?;
                    let compared = compared(factor, share, &exponent)?;
                    let safe = compared != if side == 0 { Ordering::Less } else { Ordering::Greater };
                    item.need(safe, "orders", "a factor is not on the safe side of the power of the share")?;
                }
            }
            let (low, high) = self.radius_with(&radius, |e, letter| Ok(all[e][letter].clone()))?;
            let holds = if side == 0 { high < Q::one() } else { low >= Q::one() };
            radius.need(holds, "orders", "the radius does not show the bound of the exponent")?;
            bounds[side] = exponent;
        }
        let [low, high] = bounds;
        Ok(Claim::ExponentBetween { low, high })
    }

    fn share(&self, e: usize, letter: usize) -> Checked<&Q> {
        let shares = some(self.shares.as_ref(), "orders", "the case has no shares")?;
        some(shares[e].get(letter), "orders", "a piece of another state")
    }

    /// `N^k`, or 1 with shares, by which the operators are divided.
    fn power(&self, k: usize) -> Q {
        num_traits::pow(whole(self.pieces as i64), k)
    }

    /// `N_e^k`, or `s^-k` for a piece with the share `s`.
    fn stretch(&self, e: usize, piece: &Piece<T>) -> Checked<Q> {
        let pieces = &self.shape.states[e].pieces;
        let Some(shares) = &self.shares else { return Ok(num_traits::pow(whole(pieces.len() as i64), self.order)) };
        let letter = self.letter(e, piece)?;
        Ok(num_traits::pow(shares[e][letter].recip(), self.order))
    }

    fn letter(&self, e: usize, piece: &Piece<T>) -> Checked<usize> {
        let place = self.shape.states[e].pieces.iter().position(|p| std::ptr::eq(p, piece));
        some(place, "orders", "a piece of another state")
    }

    /// `(ε N_e)^k T_i : W_δ -> W_e`, what the derivatives of order `k` are multiplied with on a piece of a state.
    fn scaled(&self, e: usize, piece: &Piece<T>) -> Checked<Matrix<T>> {
        let one = if piece.reversed && self.order % 2 == 1 { -Q::one() } else { Q::one() };
        Ok(self.spaces.on_visible(e, piece)?.scaled(&(one * self.stretch(e, piece)?)))
    }

    /// Bounds of the joint spectral radius of the operators on the families; 0 where these are 0.
    fn radius(&self, node: &Node<'_>) -> Checked<(Q, Q)> {
        // With shares it is the scaled operators whose radius is bounded.
        self.radius_with(node, |e, letter| match &self.shares {
            Some(_) => self.stretch(e, &self.shape.states[e].pieces[letter]),
            None => Ok(Q::one()),
        })
    }

    /// The same of the operators times factors by state and letter.
    fn radius_with(&self, node: &Node<'_>, factor: impl Fn(usize, usize) -> Checked<Q>) -> Checked<(Q, Q)> {
        let reachable = &self.shape.reachable;
        if node.is_null() {
            let zero = reachable.iter().all(|&e| self.families[e].rows == 0);
            node.need(zero, "orders", "bounds of a radius are needed here")?;
            return Ok((Q::zero(), Q::zero()));
        }
        let place = |e: usize| some(reachable.iter().position(|r| *r == e), "orders", "a state that is not reached");
        let mut arrows = Vec::new();
        for (e, piece) in self.shape.pieces() {
            let pivots = self.families[e].echelon()?.1;
            let images = self.families[piece.target].times(&self.spaces.on_visible(e, piece)?.transpose())?;
            let matrix = images.columns(&pivots);
            let closed = matrix.times(&self.families[e])? == images;
            need(closed, "orders", "an operator does not act on the differences")?;
            let stretch = factor(e, self.letter(e, piece)?)?;
            arrows.push((place(e)?, place(piece.target)?, matrix.transpose().scaled(&stretch)));
        }
        let dims = reachable.iter().map(|&e| self.families[e].rows).collect();
        let found = bounds(&System { name: String::new(), dims, arrows }, self.ground, node)?;
        Ok((found.lower, found.upper))
    }

    /// The differences of the next derivative: the smallest families with `(ε N)^k T_i c_δ − c_e ∈ F_e`, `T_i F_δ ⊂ F_e`. The
    /// chords are still those of the derivative before.
    fn next(self) -> Checked<Self> {
        let next = Self { order: self.order + 1, ..self };
        let mut families = next.shape.no_rows();
        for &e in &next.shape.reachable {
            families[e] = Matrix::empty(next.spaces.of(e)?.visible.rows);
        }
        for (e, piece) in next.shape.pieces() {
            let image = next.scaled(e, piece)?.times(&next.chords[piece.target])?;
            families[e] = families[e].stack(&image.minus(&next.chords[e]).transpose());
        }
        let image = |e: usize, p: &Piece<T>, span: &Matrix<T>| span.times(&next.spaces.on_visible(e, p)?.transpose());
        let families = close(next.shape, families, Way::Up, image)?;
        Ok(Self { families, ..next })
    }

    /// Whether, in a strongly connected part that no arrow leaves, a chord lies among the differences of its derivative, although
    /// the curve of the order before, whose differences are given, is more than a point.
    fn turns_back(&self, before: &[Matrix<T>]) -> Checked<bool> {
        let reached = |from: usize| reached(self.shape, from);
        for &e in &self.shape.reachable {
            let inside = self.families[e].stack(&self.chords[e].transpose()).rank()? == self.families[e].rows;
            if before[e].rows > 0 && inside && reached(e).iter().all(|&d| reached(d).contains(&e)) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The derivatives at the start and the finish, by state.
    fn ends(&self) -> Checked<Vec<[Matrix<T>; 2]>> {
        let mut ends: Vec<[Matrix<T>; 2]> = self.chords.iter().map(|c| [c.clone(), c.clone()]).collect();
        for &e in &self.shape.reachable {
            ends[e] = [self.limit(e, End::Start)?, self.limit(e, End::Finish)?];
        }
        Ok(ends)
    }

    /// Along the address of an end `(ε N)^k T c` tends to the fixed vector of the scaled cycle in `c + F`, which is unique because
    /// the radius on `F` is below `N^-k`.
    fn limit(&self, e: usize, end: End) -> Checked<Matrix<T>> {
        let address = some(self.shape.end_address(e, end, &|_, _| false), "orders", "a state without pieces")?;
        let (prefix, home) = self.product(e, &address.prefix)?;
        let (cycle, back) = self.product(home, &address.cycle)?;
        need(home == back, "orders", "the cycle of an end does not return to its state")?;
        let shifted = cycle.minus(&Matrix::identity(cycle.rows));
        let (chord, family) = (&self.chords[home], self.families[home].transpose());
        // c + F y is fixed.
        let y = shifted.times(&family)?.solve(&shifted.times(&chord.scaled(&-Q::one()))?)?;
        let y = some(y, "orders", "the derivative at an end is not unique")?;
        let fixed = family.times(&y)?.plus(&Q::one(), chord);
        prefix.times(&fixed)
    }

    /// The product of the scaled operators along a word, and the state where it ends.
    fn product(&self, from: usize, word: &[usize]) -> Checked<(Matrix<T>, usize)> {
        let (mut product, mut at) = (Matrix::identity(self.spaces.of(from)?.visible.rows), from);
        for &letter in word {
            let piece = some(self.shape.states[at].pieces.get(letter), "word", "a letter that does not exist")?;
            (product, at) = (product.times(&self.scaled(at, piece)?)?, piece.target);
        }
        Ok((product, at))
    }

    /// The joint equation: at the first-level joints of all states the derivatives of the two sides agree.
    fn joined(&self, ends: &[[Matrix<T>; 2]]) -> Checked<bool> {
        let mut joined = true;
        for &e in &self.shape.reachable {
            for pair in self.shape.states[e].pieces.windows(2) {
                let value = |piece: &Piece<T>, end: End| {
                    self.scaled(e, piece)?.times(&ends[piece.target][end.in_piece(piece) as usize])
                };
                joined &= value(&pair[0], End::Finish)? == value(&pair[1], End::Start)?;
            }
        }
        Ok(joined)
    }
}
