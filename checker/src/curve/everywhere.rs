//! Every point of a curve: invariant cones (Theorems 6 and 6′), joints at which the half-tangents agree, or a point that has
//! no tangent that turns continuously.

use super::rate::Bounds;
use super::{End, Kind, Leading, Line, Model, Place, Point, complete};
use crate::base::{Checked, Matrix, Node, Q, Verdict, Whole, disjoint_cycles, list, need, some, whole};
use crate::claim::{Claim, Decided};
use num_bigint::BigInt;

/// Longest window, and most words of one window without a positive factor.
pub const MAX_WINDOW: usize = 8;
const MAX_WORDS: usize = 1_000;
/// Longest words and most products from which a rate is computed.
const MAX_RATE: (usize, usize) = (12, 5_000);

/// What follows from the answer to "every point": the verdict on G¹, the point used, and the claims.
pub struct Answer {
    /// The index of the point that refutes it.
    pub witness: Option<usize>,
    /// The claims, that on G¹ first.
    pub claims: Vec<Decided>,
}

/// The cones of states that no piece leaves, breadth first, and the matrices of the images of their rays.
pub struct Cones<'a, T: Whole = BigInt> {
    model: &'a Model<'a, T>,
    states: Vec<usize>,
    /// By state: the rays, one a row.
    pub rays: Vec<Matrix<T>>,
    /// By state and letter.
    maps: Vec<Vec<Matrix<T>>>,
}

/// Checks `{"question": "every point", …}`.
pub fn check<T: Whole>(model: &Model<'_, T>, points: &[Point<T>], node: &Node<'_>) -> Checked<Answer> {
    let [_, _, cones, maps, view, window, slow, rate, together, witness] =
        node.fields("question verdict cones maps view window slow rate joints witness")?;
    let start = &model.shape.states[model.shape.start];
    node.need(start.kind == Kind::Edge, "every-point", "only of a curve it is asked whether it is G¹")?;
    let witness = refuting(points, &witness)?;
    let answer = |verdict, rate, more: Option<Claim>| {
        let claims = [Claim::TangentTurns { rate }.is(verdict)].into_iter();
        let claims = claims.chain(more.map(|claim| claim.is(Verdict::Proved))).collect();
        Ok(Answer { witness, claims })
    };
    if cones.list()?.is_empty() {
        let empty = [&maps, &slow, &together].into_iter().all(|n| n.list().is_ok_and(|l| l.is_empty()));
        let nothing = empty && view.is_null() && rate.is_null() && window.index(1)? == 0;
        node.need(nothing && witness.is_some(), "every-point", "without cones only a point can refute")?;
        return answer(Verdict::Refuted, None, None);
    }
    let found = cones.at(Cones::read(model, &model.shape.reachable, &cones, &maps))?;
    let seen = view.at(found.seen(&cones, &view))?;
    slow.at(found.shrink(window.index(MAX_WINDOW + 1)?, &slow))?;
    let rate = rate.at(found.rate(&rate))?;
    // A curve that is more than a point has joints.
    node.need(!model.joints()?.is_empty(), "every-point", "a curve without joints")?;
    let agree = !together.list()?.is_empty();
    if agree {
        together.at(regular_joints(model, points, &together))?;
    }
    if witness.is_none() && seen && agree {
        return answer(Verdict::Proved, rate, None);
    }
    let verdict = if witness.is_some() { Verdict::Refuted } else { Verdict::Undetermined };
    answer(verdict, None, Some(Claim::HalfTangents { projected: !seen }))
}

/// The index of a point at which the tangent does not exist or does not turn continuously.
fn refuting<T: Whole>(points: &[Point<T>], node: &Node<'_>) -> Checked<Option<usize>> {
    let listed = node.indices(points.len())?;
    node.need(listed.len() <= 1, "format", "at most one point is needed here")?;
    let broken = |&k: &usize| points[k].verdict == Verdict::Refuted || matches!(points[k].kind, "cusp" | "oscillating");
    let why = "the point has a tangent like any other";
    node.list()?.iter().try_for_each(|item| item.need(listed.iter().all(broken), "every-point", why))?;
    Ok(listed.first().copied())
}

/// Every first-level joint of every reachable state is regular, seen in the visible quotient of its own state, or as a listed
/// point through a map that is injective on that quotient.
fn regular_joints<T: Whole>(model: &Model<'_, T>, points: &[Point<T>], node: &Node<'_>) -> Checked<()> {
    let mut listed = Vec::new();
    for item in node.list()? {
        let own;
        let (point, root) = if item.get("listed").is_some() {
            let [state, index] = item.fields("state listed")?;
            let point = &points[index.index(points.len())?];
            let sees = injective(model, point, state.index(model.shape.states.len())?)?;
            item.need(sees, "every-point", "the joint of another state, or directions are lost where it is looked at")?;
            (point, model.shape.start)
        } else {
            let (e, point) = Point::in_own_state(model, &item, "every-point")?;
            own = point;
            (&own, e)
        };
        let regular = point.verdict == Verdict::Proved && point.kind == "regular";
        item.need(regular, "every-point", "the joint must be regular")?;
        listed.extend(point.place.joint(model, root));
    }
    complete(model, &listed, node, "every-point")
}

/// Whether a point is a joint of a state, and the map along its path to where it is looked at is injective on the quotient.
fn injective<T: Whole>(model: &Model<'_, T>, point: &Point<T>, e: usize) -> Checked<bool> {
    let Place::Joint { path, .. } = &point.place else { return Ok(false) };
    let (op, end) = model.shape.product(model.shape.start, path)?;
    let space = model.spaces.of(e)?;
    let seen = model.shape.view.times(&op)?;
    Ok(end == e && seen.times(&space.basis)?.rank()? == space.visible.rows)
}

impl<'a, T: Whole> Cones<'a, T> {
    /// The cones of some states, which no piece leaves, are pointed, span the relevant spaces, hold the chords, and are mapped
    /// into each other.
    pub fn read(model: &'a Model<'a, T>, states: &[usize], cones: &Node<'_>, maps: &Node<'_>) -> Checked<Self> {
        let shape = model.shape;
        let own = states.iter().copied().zip(cones.exactly(states.len(), "cone")?);
        let images = states.iter().copied().zip(maps.exactly(states.len(), "format")?);
        let mut rays = shape.no_rows();
        for (e, item) in own {
            rays[e] = item.at(Self::cone(model, e, &item))?;
        }
        let mut all: Vec<Vec<Matrix<T>>> = shape.states.iter().map(|_| Vec::new()).collect();
        for (e, list) in images {
            let pieces = &shape.states[e].pieces;
            for (item, piece) in list.exactly(pieces.len(), "format")?.iter().zip(pieces) {
                let b: Matrix<T> = item.entries(rays[piece.target].rows, &model.ground)?;
                item.need(b.rows == rays[e].rows, "format", "one row for each ray is needed here")?;
                let fits = !b.has_negative() && (0..b.cols).all(|j| !b.columns(&[j]).is_zero());
                item.need(fits, "cone", "coefficients are not negative, and no column is 0")?;
                let turned = whole(if piece.reversed { -1 } else { 1 });
                let image = piece.op.times(&rays[piece.target].transpose())?;
                let combined = rays[e].transpose().times(&b)?.scaled(&turned);
                item.need(image == combined, "cone", "the images of the rays are other vectors")?;
                all[e].push(b);
            }
        }
        Ok(Self { model, states: states.to_vec(), rays, maps: all })
    }

    fn cone(model: &Model<'_, T>, e: usize, node: &Node<'_>) -> Checked<Matrix<T>> {
        let [rays, functional, chord] = node.fields("rays functional chord")?;
        let (state, space) = (&model.shape.states[e], model.spaces.of(e)?);
        let curve = state.kind == Kind::Edge && space.basis.cols > 0;
        node.need(curve, "cone", "only curves that are more than a point have cones")?;
        let rows: Matrix<T> = rays.entries(state.dim, &model.ground)?;
        let held = space.basis.times(&space.reading.times(&rows.transpose())?)? == rows.transpose();
        rays.need(held && rows.rank()? == space.basis.cols, "cone", "the rays do not span the relevant space")?;
        let values = rows.times(&functional.column(state.dim, &model.ground)?)?;
        functional.need(values.all_positive(), "cone", "the functional is not positive on every ray")?;
        let y: Matrix<T> = chord.column(rows.rows, &model.ground)?;
        let difference = model.shape.end_point(e, End::Finish)?.minus(&model.shape.end_point(e, End::Start)?);
        let combines = !y.is_zero() && !y.has_negative() && rows.transpose().times(&y)? == difference;
        chord.need(combines, "cone", "the chord is no such combination of the rays")?;
        Ok(rows)
    }

    /// Whether a functional is given that is positive on the cone of the start as it is looked at.
    fn seen(&self, cones: &Node<'_>, view: &Node<'_>) -> Checked<bool> {
        if view.is_null() {
            return Ok(false);
        }
        let images = self.model.shape.view.times(&self.rays[self.model.shape.start].transpose())?;
        let row: Matrix<T> = view.column(images.rows, &self.model.ground)?;
        let values = row.transpose().times(&images)?;
        cones.need(values.all_positive(), "cone", "the functional of the view is not positive on every ray")?;
        Ok(true)
    }

    /// All words of `length` letters whose factors have no positive product, by state and then by letters, with the state.
    fn idle_words(&self, length: usize) -> Checked<Vec<(usize, Vec<usize>)>> {
        // With each word where it ends, and where the products of its ends are positive.
        let none = |&e: &usize| (e, e, Vec::new(), Vec::new());
        let mut words: Vec<(usize, usize, Vec<usize>, Vec<Matrix>)> = self.states.iter().map(none).collect();
        for _ in 0..length {
            let mut longer = Vec::new();
            for (from, to, word, ends) in words {
                for (letter, piece) in self.model.shape.states[to].pieces.iter().enumerate() {
                    let step = pattern(&self.maps[to][letter]);
                    let next =
                        ends.iter().map(|end: &Matrix| Ok(pattern(&end.times(&step)?))).chain([Ok(step.clone())]);
                    let next = next.collect::<Checked<Vec<_>>>()?;
                    if !next.iter().any(Matrix::all_positive) {
                        longer.push((from, piece.target, [word.as_slice(), &[letter]].concat(), next));
                    }
                }
            }
            need(longer.len() <= MAX_WORDS, "limit", "too many words without a positive factor")?;
            words = longer;
        }
        Ok(words.into_iter().map(|(from, _, word, _)| (from, word)).collect())
    }

    /// Every address meets positive products again and again, or ends in one of the listed cycles, which pull to a ray.
    pub fn shrink(&self, window: usize, slow: &Node<'_>) -> Checked<()> {
        slow.need(window > 0, "slow", "the window must be positive")?;
        let cycles = self.idle_cycles(&self.idle_words(window)?)?;
        for (item, (e, word)) in slow.exactly(cycles.len(), "slow")?.iter().zip(&cycles) {
            item.at(self.pulls(item, *e, word))?;
        }
        Ok(())
    }

    /// The cycles of the graph of overlapping words, which must not meet; each from its first word on.
    fn idle_cycles(&self, words: &[(usize, Vec<usize>)]) -> Checked<Vec<(usize, Vec<usize>)>> {
        let shape = self.model.shape;
        let follows = |(e, a): &(usize, Vec<usize>), (f, b): &(usize, Vec<usize>)| {
            shape.states[*e].pieces[a[0]].target == *f && a[1..] == b[..b.len() - 1]
        };
        let next = |a| (0..words.len()).filter(|&k| follows(a, &words[k])).collect();
        let next: Vec<Vec<usize>> = words.iter().map(next).collect();
        let cycles = some(disjoint_cycles(&next), "slow", "two cycles without positive products meet")?;
        let word = |cycle: &Vec<usize>| cycle.iter().map(|k| words[*k].1[0]).collect();
        Ok(cycles.iter().map(|cycle| (words[cycle[0]].0, word(cycle))).collect())
    }

    /// The cycle has one positive leading eigenvalue with one longest chain; each ray has a positive leading coefficient, or
    /// is the ray to which the others are pulled.
    fn pulls(&self, node: &Node<'_>, e: usize, word: &[usize]) -> Checked<()> {
        let [state, letters, top, functional] = node.fields("state word top functional")?;
        let same = state.index(usize::MAX)? == e && letters.word()? == word;
        node.need(same, "slow", format_args!("the cycle {} of state {e} is expected here", list(word)))?;
        let model = self.model;
        let (product, _) = model.shape.product(e, word)?;
        let turn = whole(i64::from(model.shape.orientation(e, word)?));
        let linear = model.spaces.linear(&product, e, e)?.scaled(&turn);
        let leading = Leading::read(&top, &linear, &model.ground)?;
        top.need(leading.eigenvalue_sign() > 0, "slow", "the leading eigenvalue must be positive")?;
        let (row, pairing) = leading.row(&linear, &functional)?;
        let (field, v) = (&leading.field, &leading.vectors[0]);
        let rays = self.rays[e].times(&model.spaces.of(e)?.reading.transpose())?;
        for k in 0..rays.rows {
            let ray = rays.row(k);
            if field.sign(&field.applied(&ray, &row)?)? <= 0 {
                // The others tend to this ray, and this one must be it already.
                let limit = Line::new(field, v.scaled(&whole(i64::from(pairing))))?;
                let there = limit.along(&field.embedded(&ray.transpose())?)? == Some(1);
                functional.need(there, "slow", format_args!("ray {k} is not pulled to the ray of the cycle"))?;
            }
        }
        Ok(())
    }

    /// Products of `length` letters have cross-ratios of at most `cross_ratio`; says what follows.
    fn rate(&self, node: &Node<'_>) -> Checked<Option<(usize, Q)>> {
        if node.is_null() {
            return Ok(None);
        }
        let [length, bound] = node.fields("length cross_ratio")?;
        let (length, most) = (length.index(MAX_RATE.0 + 1)?, bound.rational()?);
        bound.need(most >= whole(1), "rate", "no cross-ratio is smaller than 1 together with its inverse")?;
        let rounded: Vec<Vec<Bounds>> = self.maps.iter().map(|maps| maps.iter().map(Bounds::of).collect()).collect();
        let identity = |&e: &usize| (e, Bounds::of(&Matrix::<T>::identity(self.rays[e].rows)));
        let mut layer: Vec<(usize, Bounds)> = self.states.iter().map(identity).collect();
        for _ in 0..length {
            let mut longer = Vec::new();
            for (e, product) in &layer {
                for (piece, b) in self.model.shape.states[*e].pieces.iter().zip(&rounded[*e]) {
                    longer.push((piece.target, product.times(b)?));
                }
            }
            bound.need(longer.len() <= MAX_RATE.1, "limit", "too many products")?;
            layer = longer;
        }
        for (_, product) in &layer {
            let within = length > 0 && product.within(&most)?;
            bound.need(within, "rate", "a product is not seen to be positive, or to have so small a cross-ratio")?;
        }
        Ok(Some((length, most)))
    }
}

/// 1 where an entry is positive, otherwise 0.
fn pattern<T: Whole>(m: &Matrix<T>) -> Matrix {
    Matrix::ones(m.rows, m.cols, |i, j| m.data[i * m.cols + j].sgn() > 0)
}
