//! Trees of words: contraction codes, and covers of a ring by cells on which a functional keeps its sign (theory §1, §7).

use super::{Germ, Shape, Spaces};
use crate::base::{
    Checked, Enclosed, Field, Fraction, Json, Matrix, Node, Q, Whole, absolute, bits, ceiling, largest, list, need,
    reject, spend,
};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// A shape with all that holds for its states, once contraction is proved.
pub struct Model<'a, T: Whole = BigInt> {
    /// The shape.
    pub shape: &'a Shape<T>,
    /// What is known of the field of its entries.
    pub ground: T::Ground,
    /// Their spaces.
    pub spaces: Spaces<T>,
    radius: Vec<Q>,
    /// The vertices of the hulls as columns; none where a state has no hull.
    hulls: Vec<Matrix<T>>,
}

/// The largest `½ Σ_k |t_ki − t_kj|`: the norm of an operator on zero-sum vectors; 0 where there is one column, as those are 0
/// then.
fn dobrushin<T: Whole>(op: &Matrix<T>) -> Matrix<T> {
    let entry = |i: usize, j: usize| &op.data[i * op.cols + j];
    let zero = || T::integer(BigInt::zero());
    let distance =
        |i: usize, j: usize| (0..op.rows).fold(zero(), |sum, k| sum.plus(&absolute(&entry(k, i).minus(entry(k, j)))));
    let pairs = (0..op.cols).flat_map(|i| (0..i).map(move |j| (i, j)));
    let most = largest(pairs.map(|(i, j)| distance(i, j)));
    Matrix { rows: 1, cols: 1, data: vec![most], den: &op.den * 2 }
}

/// `max − min`; a row without entries is 0 everywhere.
fn oscillation<T: Whole>(row: &[T]) -> T {
    let Some(first) = row.first() else { return T::integer(BigInt::zero()) };
    // Differences to the first entry, which is one of them.
    let above = largest(row.iter().map(|x| x.minus(first)));
    above.plus(&largest(row.iter().map(|x| first.minus(x))))
}

/// Rows on the points of the germ's state that vanish at its fixed point, and by how much each may be wrong on its attractor.
pub struct Functionals<T = BigInt> {
    rows: Matrix<T>,
    errors: Vec<Q>,
}

/// A cell of a cover.
pub struct Cell {
    /// On which side of the germ's point it lies: that of its piece.
    pub side: i32,
    /// The index of the functional.
    pub functional: usize,
    /// Its sign there.
    pub sign: i32,
}

/// What is done with a leaf of a tree of words.
type Visit<'v, T> = dyn FnMut(&Matrix<T>, usize, &str) -> Checked<()> + 'v;

impl<'a, T: Whole> Model<'a, T> {
    /// The spaces of a shape, without anything that encloses the attractors: no cover may be checked with it.
    pub fn unenclosed(shape: &'a Shape<T>, ground: &T::Ground) -> Checked<Self> {
        let spaces = Spaces::new(shape)?;
        let radius = vec![Q::zero(); shape.states.len()];
        let hulls = shape.states.iter().map(|s| Matrix::zeros(s.dim, 0)).collect();
        Ok(Self { shape, ground: ground.clone(), spaces, radius, hulls })
    }

    /// Rule `contraction`: for each reachable state a complete prefix code of words with `τ < 1` (Lemma 1), and a radius
    /// with `radius_e ≥ ‖T_w q − q_e‖ + τ(T_w) radius` for all its words, so that a ball around `q_e` holds the attractor; or for
    /// all of them polytopes (Lemma 1′).
    pub fn read(shape: &'a Shape<T>, ground: &T::Ground, node: &Node<'_>) -> Checked<Self> {
        let mut model = node.at(Self::unenclosed(shape, ground))?;
        let mut entries = Vec::new();
        for (e, item) in model.for_states(node, "contraction")? {
            let [state, bound, code, hull] = item.fields("state radius code hull")?;
            state.need(state.index(shape.states.len())? == e, "contraction", "states come breadth first")?;
            code.need(!matches!(code.value, Json::Text(_)), "contraction", "the empty word does not contract")?;
            model.radius[e] = bound.rational()?;
            entries.push((e, code, hull));
        }
        if entries.iter().all(|(_, code, _)| matches!(code.value, Json::Object(_))) {
            model.polytopes(entries.iter().map(|(e, code, _)| (*e, code)), true)?;
        } else {
            for (e, code, _) in &entries {
                let identity = Matrix::identity(shape.states[*e].dim);
                let mut leaf = |product: &Matrix<T>, end: usize, leaf: &str| {
                    need(leaf == ".", "contraction", "a leaf of a code is \".\"")?;
                    model.contracts(*e, end, product)
                };
                code.at(model.leaves(&identity, *e, code.value, "contraction", &mut leaf))?;
            }
        }
        if entries.iter().all(|(_, _, hull)| matches!(hull.value, Json::Text(text) if text == "simplex")) {
            for &e in &shape.reachable {
                let maps = shape.states[e].pieces.iter().all(|p| !p.op.has_negative());
                node.need(maps, "hull", "the simplices are mapped into themselves by nonnegative operators only")?;
                model.hulls[e] = Matrix::identity(shape.states[e].dim);
            }
        } else if !entries.iter().all(|(_, _, hull)| hull.is_null()) {
            model.polytopes(entries.iter().map(|(e, _, hull)| (*e, hull)), false)?;
        }
        Ok(model)
    }

    /// Points whose convex hull holds the attractor of a state, as columns: the vertices of its hull, or those of a simplex around its
    /// ball.
    pub fn hull(&self, state: usize) -> Checked<Matrix<T>> {
        if self.hulls[state].cols > 0 {
            return Ok(self.hulls[state].clone());
        }
        // Of coordinates of sum 0 and 1-norm r none is below −r/2.
        let (n, half) = (self.shape.states[state].dim, &self.radius[state] / Q::from_integer(2.into()));
        let corners = Matrix::identity(n).scaled(&(&half * Q::from_integer(n.into())));
        let base = self.spaces.of(state)?.base.times(&Matrix::row_of_ones(n))?;
        Ok(base.plus(&Q::one(), &corners).minus(&Matrix::ones(n, n, |_, _| true).scaled(&half)))
    }

    /// The elements of a list with one for each reachable state, breadth first, with the state.
    pub fn for_states<'n>(&self, node: &Node<'n>, rule: &str) -> Checked<Vec<(usize, Node<'n>)>> {
        let items = node.list()?;
        let all = items.len() == self.shape.reachable.len();
        node.need(all, rule, "one entry for each reachable state is needed, breadth first")?;
        Ok(self.shape.reachable.iter().copied().zip(items).collect())
    }

    /// Visits the leaves of a tree with one child for each letter of the state that is reached: the rows times the product of
    /// the word that leads to the leaf, the state there, and what stands at the leaf.
    fn leaves(&self, rows: &Matrix<T>, state: usize, tree: &Json, rule: &str, visit: &mut Visit<'_, T>) -> Checked<()> {
        let pieces = &self.shape.states[state].pieces;
        match tree {
            Json::Text(leaf) => visit(rows, state, leaf),
            Json::List(children) if children.len() == pieces.len() => {
                let mut both = pieces.iter().zip(children);
                both.try_for_each(|(p, child)| self.leaves(&rows.times(&p.op)?, p.target, child, rule, visit))
            }
            _ => reject(rule, "a tree has one child for each letter of its state, and texts as leaves"),
        }
    }

    /// A word from `from` to `end` contracts by its `τ`, and the ball of `from` holds the image of that of `end`.
    fn contracts(&self, from: usize, end: usize, product: &Matrix<T>) -> Checked<()> {
        let radii = bits(&self.radius[end]) + bits(&self.radius[from]);
        spend(product.rows * product.cols * product.cols + 64, product.bits() + radii)?;
        let tau = dobrushin(product);
        need(Matrix::identity(1).minus(&tau).all_positive(), "contraction", "a word of the code does not contract")?;
        let shift = product.times(&self.spaces.of(end)?.base)?.minus(&self.spaces.of(from)?.base);
        let holds = self.holds(from, &shift, &tau.scaled(&self.radius[end]));
        need(holds, "contraction", "the ball of this radius does not hold the image of a ball")
    }

    /// Whether the ball of a state holds another one of which the centre is shifted.
    fn holds(&self, state: usize, shift: &Matrix<T>, radius: &Matrix<T>) -> bool {
        let size = Matrix { rows: 1, cols: 1, data: vec![shift.size()], den: shift.den.clone() };
        !Matrix::identity(1).scaled(&self.radius[state]).minus(&size).minus(radius).has_negative()
    }

    /// Reads the hulls of all states, and the images of their vertices. With `shrinking` they prove contraction (Lemma 1′): the
    /// vertices of each state span its space, all images under a piece have a vertex of positive weight in common, and the
    /// vertices lie in the ball of the state.
    fn polytopes<'n>(&mut self, hulls: impl Iterator<Item = (usize, &'n Node<'n>)>, shrinking: bool) -> Checked<()> {
        let mut entries = Vec::new();
        for (e, hull) in hulls {
            let [points, images] = hull.fields("points images")?;
            self.hulls[e] = points.entries(self.shape.states[e].dim, &self.ground)?.transpose();
            points.need(self.hulls[e].cols > 0, "hull", "a hull has points")?;
            entries.push((e, points, images));
        }
        for (e, points, images) in entries {
            images.at(self.hull_maps_into(e, &images, shrinking))?;
            if shrinking {
                let hull = &self.hulls[e];
                points.need(hull.rank()? == hull.rows, "contraction", "the points do not span the space")?;
                let shift = hull.minus(&self.spaces.of(e)?.base.times(&Matrix::row_of_ones(hull.cols))?);
                let near = (0..hull.cols).all(|j| self.holds(e, &shift.columns(&[j]), &Matrix::zeros(1, 1)));
                points.need(near, "contraction", "the ball of this radius does not hold the points")?;
            }
        }
        Ok(())
    }

    /// Rule `hull`: the image of each vertex of the target's hull under each piece is a convex combination of vertices, so
    /// that the hulls, mapped into themselves by a contracting system, hold the attractors.
    fn hull_maps_into(&self, e: usize, images: &Node<'_>, shrinking: bool) -> Checked<()> {
        let (own, pieces) = (&self.hulls[e], &self.shape.states[e].pieces);
        need(own.is_affine(), "hull", "points have the sum 1")?;
        for (piece, list) in pieces.iter().zip(&images.exactly(pieces.len(), "hull")?) {
            let target = &self.hulls[piece.target];
            spend(own.cols * target.cols, 0)?;
            let zero = || (T::integer(BigInt::zero()), BigInt::one());
            let mut weights: Vec<Vec<Fraction<T>>> = vec![vec![zero(); own.cols]; target.cols];
            for (row, combination) in weights.iter_mut().zip(&list.exactly(target.cols, "hull")?) {
                let mut next = 0;
                for term in combination.list()? {
                    let [index, weight] = term.fields("vertex weight")?;
                    let (k, weight) = (index.index(own.cols)?, T::entry(&weight, &self.ground)?);
                    term.need(k >= next && weight.0.sgn() > 0, "hull", "vertices ascend, weights are positive")?;
                    (row[k], next) = (weight, k + 1);
                }
            }
            let common = (0..own.cols).any(|k| weights.iter().all(|w| w[k].0.sgn() > 0));
            need(common || !shrinking, "contraction", "the images under a piece have no vertex in common")?;
            let weights = Matrix::fractions(target.cols, own.cols, &weights.concat()).transpose();
            need(weights.is_affine(), "hull", "the weights do not add up to 1")?;
            let combined = own.times(&weights)?;
            need(piece.op.times(target)? == combined, "hull", "an image is not this convex combination")?;
        }
        Ok(())
    }

    /// Functionals on the germ's quotient, given over a number field, as rows on points.
    pub fn functionals(&self, germ: &Germ<T>, field: &Field, rows: &[&Matrix]) -> Checked<Functionals<T>> {
        self.enclosed(germ, &rows.iter().map(|row| field.enclose(row)).collect::<Checked<Vec<_>>>()?)
    }

    /// Functionals on the germ's quotient, given by enclosures of their entries, as rows on points.
    pub fn enclosed(&self, germ: &Germ<T>, rows: &[Enclosed]) -> Checked<Functionals<T>> {
        let (mut middles, mut errors) = (Matrix::empty(germ.dim()), Vec::new());
        for values in rows {
            middles = middles.stack(&values.lo.plus(&Q::one(), &values.hi).transpose());
            // |chart_k (x − q)| is at most osc(chart_k) times the radius, because both points lie in the ball.
            let spread =
                |k: usize| oscillation(germ.chart.integers(k)).multiple(&(&values.hi.data[k] - &values.lo.data[k]));
            let sum = (0..germ.dim()).fold(T::integer(BigInt::zero()), |sum, k| sum.plus(&spread(k)));
            let error = ceiling(&sum, &(&values.lo.den * &germ.chart.den * 2));
            errors.push(error * &self.radius[germ.state]);
        }
        self.rows(germ, &Matrix::lifted(&middles.scaled(&Q::new(1.into(), 2.into()))), errors)
    }

    /// Functionals on the germ's quotient over the field of the case, given as rows.
    pub fn rows(&self, germ: &Germ<T>, on_quotient: &Matrix<T>, errors: Vec<Q>) -> Checked<Functionals<T>> {
        let rows = on_quotient.times(&germ.chart)?;
        let at_fixed = rows.times(&germ.fixed)?;
        Ok(Functionals { rows: rows.minus(&at_fixed.times(&Matrix::row_of_ones(rows.cols))?), errors })
    }

    /// Whether a functional, given by its row on the points of a state, keeps a sign on the attractor of the state.
    fn keeps(&self, rows: &Matrix<T>, k: usize, error: &Q, state: usize, sign: i32) -> Checked<bool> {
        let (row, base, radius) = (rows.integers(k), &self.spaces.of(state)?.base, &self.radius[state]);
        let hull = &self.hulls[state];
        spend(row.len() * (2 + hull.cols), rows.bits().max(base.bits()).max(hull.bits()) + bits(radius) + bits(error))?;
        let product = |v: &Matrix<T>, j: usize| {
            let mut sum = T::integer(BigInt::zero());
            row.iter().enumerate().for_each(|(i, x)| sum.add_product(x, &v.data[i * v.cols + j]));
            sum.multiple(&BigInt::from(sign))
        };
        // Both bounds are compared with 0 after multiplication by 2, the denominators and the sign.
        let margin = &rows.den * error.numer();
        let (r, s, t) = (radius.numer(), radius.denom(), error.denom());
        let wide = oscillation(row).multiple(&(r * t)).plus(&T::integer(&margin * s * 2));
        let by_ball = product(base, 0).multiple(&(s * t * 2)).minus(&wide.multiple(&base.den)).sgn() > 0;
        let least = T::integer(&margin * &hull.den);
        let beyond = |j: usize| product(hull, j).multiple(t).minus(&least).sgn() > 0;
        Ok(by_ball || (hull.cols > 0 && (0..hull.cols).all(beyond)))
    }

    /// Rule `cover`: every piece of the ring that is seen is cut into cells on each of which one of the functionals has one
    /// strict sign. The pieces come in the order of the ring (of one part of it, where `part` is given); leaves are `"+0"`,
    /// `"-0"`, `"+1"`, ….
    pub fn cover(&self, germ: &Germ<T>, by: &Functionals<T>, part: Option<i32>, node: &Node<'_>) -> Checked<Vec<Cell>> {
        let pieces: Vec<_> = germ.ring.iter().filter(|p| part.is_none_or(|part| p.side == part)).collect();
        // Where no piece were left, no leaf would say anything. (Then the germ were a point, or `L` nilpotent.)
        node.need(
            !pieces.is_empty() && by.rows.rows > 0,
            "cover",
            "no piece of the ring is seen, or no functional given",
        )?;
        let mut cells = Vec::new();
        for (item, piece) in node.exactly(pieces.len(), "cover")?.iter().zip(pieces) {
            let [word, tree] = item.fields("piece cells")?;
            let same = word.word()? == piece.word;
            word.need(same, "cover", format_args!("the piece {} of the ring is expected here", list(&piece.word)))?;
            let mut leaf = |rows: &Matrix<T>, state: usize, leaf: &str| {
                let named = (0..rows.rows).flat_map(|k| [(k, 1, format!("+{k}")), (k, -1, format!("-{k}"))]);
                let Some((functional, sign, _)) = named.into_iter().find(|(_, _, name)| name == leaf) else {
                    return reject("cover", "a leaf is a sign and the index of a functional, such as \"+0\"");
                };
                let keeps = self.keeps(rows, functional, &by.errors[functional], state, sign)?;
                cells.push(Cell { side: piece.side, functional, sign });
                need(keeps, "cover", "a functional does not keep the sign of its cell")
            };
            tree.at(self.leaves(&by.rows.times(&piece.op)?, piece.end, tree.value, "cover", &mut leaf))?;
        }
        Ok(cells)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Kind, Piece, State};
    use super::*;
    use crate::base::whole;

    fn row(entries: &[i64]) -> Matrix {
        Matrix::new(1, entries.len(), &entries.iter().map(|&x| whole(x)).collect::<Vec<_>>())
    }

    /// A segment with middle `(1/2, 1/2)`: one piece, half as long.
    fn segment() -> Shape {
        let op = row(&[3, 1]).stack(&row(&[1, 3])).scaled(&(whole(1) / whole(4)));
        let pieces = vec![Piece { target: 0, op, reversed: false, share: None }];
        let states = vec![State { kind: Kind::Set, dim: 2, pieces, ends: [None, None] }];
        Shape::new(states, 0, Matrix::identity(2))
    }

    fn model(shape: &Shape, radius: i64, hull: Matrix) -> Model<'_> {
        let spaces = Spaces::new(shape).unwrap();
        Model { shape, ground: (), spaces, radius: vec![whole(radius)], hulls: vec![hull] }
    }

    #[test]
    fn bounds_over_a_ball_are_sharp() {
        let shape = segment();
        let ball = model(&shape, 1, Matrix::empty(2).transpose());
        let keeps = |x: &[i64], error: Q| ball.keeps(&row(x), 0, &error, 0, 1).unwrap();
        // On the segment between the unit vectors a row is as small as its smaller entry.
        assert!(keeps(&[1000, 1], Q::zero()) && !keeps(&[1000, 0], Q::zero()) && !keeps(&[1000, -1], Q::zero()));
        assert!(keeps(&[1000, 1], whole(999) / whole(1000)) && !keeps(&[1000, 1], whole(1)));
        let hull = model(&shape, 100, Matrix::identity(2));
        let keeps = |x: &[i64], error: Q| hull.keeps(&row(x), 0, &error, 0, 1).unwrap();
        assert!(keeps(&[3, 1], whole(999) / whole(1000)) && !keeps(&[3, 1], whole(1)) && !keeps(&[3, 0], Q::zero()));
    }

    #[test]
    fn errors_of_functionals_allow_for_the_whole_ball() {
        let (shape, one) = (segment(), Matrix::identity(1));
        let ball = model(&shape, 3, Matrix::empty(2).transpose());
        let fixed = ball.spaces.of(0).unwrap().base.clone();
        let (chart, linear, view) = (row(&[1, -1]), one.clone(), one);
        let germ =
            Germ { state: 0, prefix_sign: 1, turn: 1, fixed, chart, linear, view, ring: Vec::new(), collapses: false };
        // The root of 2 lies within 1/2 of 3/2; two points of the ball differ by at most 6, their chart by 6.
        let by_root = Field::companion(&[-2, 0, 1].map(whole));
        let root = Field::of(by_root, [whole(1), whole(2)]);
        let found = ball.functionals(&germ, &root, &[&row(&[0, 1])]).unwrap();
        assert_eq!(found.errors, [whole(3)]);
    }
}
