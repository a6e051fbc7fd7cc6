//! Trees of words: contraction codes, and covers of a ring by cells on which a functional keeps its sign (theory §1, §7).

use crate::germ::{Germ, Position};
use crate::json::{Json, Node};
use crate::matrix::Matrix;
use crate::number::{Q, bits, spend};
use crate::poly::{Enclosed, Field};
use crate::shape::{Shape, Spaces};
use crate::{Checked, at, need, reject};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// A shape with all that holds for its states, once contraction is proved.
pub struct Model<'a> {
    /// The shape.
    pub shape: &'a Shape,
    /// Its reachable states, breadth first.
    pub reachable: Vec<usize>,
    /// Their spaces.
    pub spaces: Spaces,
    radius: Vec<Q>,
    /// The vertices of the hulls as columns; none where a state has no hull.
    hulls: Vec<Matrix>,
}

/// The largest `½ Σ_k |t_ki − t_kj|`: the norm of an operator on zero-sum vectors.
fn dobrushin(op: &Matrix) -> Q {
    let entry = |i: usize, j: usize| &op.data[i * op.cols + j];
    let distance = |i: usize, j: usize| (0..op.rows).map(|k| (entry(k, i) - entry(k, j)).abs()).sum::<BigInt>();
    let pairs = (0..op.cols).flat_map(|i| (0..i).map(move |j| (i, j)));
    Q::new(pairs.map(|(i, j)| distance(i, j)).max().unwrap_or_default(), &op.den * 2)
}

/// `max − min`.
fn oscillation(row: &[BigInt]) -> BigInt {
    match (row.iter().max(), row.iter().min()) {
        (Some(hi), Some(lo)) => hi - lo,
        _ => BigInt::zero(),
    }
}

/// Rows on the points of the germ's state that vanish at its fixed point, and by how much each may be wrong on its attractor.
pub struct Functionals {
    rows: Matrix,
    errors: Vec<Q>,
}

/// A cell of a cover.
pub struct Cell {
    /// On which side of the germ's point it lies.
    pub position: Position,
    /// The index of the functional.
    pub functional: usize,
    /// Its sign there.
    pub sign: i32,
}

impl<'a> Model<'a> {
    /// The spaces of a shape, without anything that encloses the attractors: no cover may be checked with it.
    pub fn unenclosed(shape: &'a Shape) -> Checked<Self> {
        let reachable = shape.reachable();
        let spaces = Spaces::new(shape, &reachable)?;
        let radius = vec![Q::zero(); shape.states.len()];
        let hulls = shape.states.iter().map(|s| Matrix::empty(s.dim).transpose()).collect();
        Ok(Self { shape, reachable, spaces, radius, hulls })
    }

    /// Rule `contraction`: for each reachable state a complete prefix code of words with `τ < 1` (Lemma 1), and a radius
    /// with `radius_e ≥ ‖T_w q − q_e‖ + τ(T_w) radius` for all its words, so that a ball around `q_e` holds the attractor; or for
    /// all of them polytopes (Lemma 1′).
    pub fn read(shape: &'a Shape, node: &Node<'_>) -> Checked<Self> {
        let mut model = at(&node.place, Self::unenclosed(shape))?;
        let items = node.list()?;
        let one_each = "one entry for each reachable state is needed, breadth first";
        node.need(items.len() == model.reachable.len(), "contraction", one_each)?;
        let mut entries = Vec::new();
        for (item, &e) in items.iter().zip(&model.reachable) {
            let [state, bound, code, hull] = item.fields(["state", "radius", "code", "hull"])?;
            state.need(state.index(shape.states.len())? == e, "contraction", one_each)?;
            code.need(!matches!(code.value, Json::Text(_)), "contraction", "the empty word does not contract")?;
            model.radius[e] = bound.rational()?;
            entries.push((e, code, hull));
        }
        let by_polytopes = entries.iter().all(|(_, code, _)| matches!(code.value, Json::Object(_)));
        if by_polytopes {
            model.polytopes(entries.iter().map(|(e, code, _)| (*e, code)), true)?;
        } else {
            for (e, code, _) in &entries {
                at(&code.place, model.contracts(*e, *e, &Matrix::identity(shape.states[*e].dim), code.value))?;
            }
        }
        if entries.iter().all(|(_, _, hull)| matches!(hull.value, Json::Text(text) if text == "simplex")) {
            for &e in &model.reachable {
                let maps = shape.states[e].pieces.iter().flat_map(|p| &p.op.data).all(|x| !x.is_negative());
                node.need(maps, "hull", "the simplices are mapped into themselves by nonnegative operators only")?;
                model.hulls[e] = Matrix::identity(shape.states[e].dim);
            }
        } else if !entries.iter().all(|(_, _, hull)| matches!(hull.value, Json::Null)) {
            model.polytopes(entries.iter().map(|(e, _, hull)| (*e, hull)), false)?;
        }
        Ok(model)
    }

    /// Reads the hulls of all states, and the images of their vertices. With `shrinking` they prove contraction (Lemma 1′): the
    /// vertices of each state span its space, all images under a piece have a vertex of positive weight in common, and the
    /// vertices lie in the ball of the state.
    fn polytopes<'n>(&mut self, hulls: impl Iterator<Item = (usize, &'n Node<'n>)>, shrinking: bool) -> Checked<()> {
        let mut entries = Vec::new();
        for (e, hull) in hulls {
            let [points, images] = hull.fields(["points", "images"])?;
            self.hulls[e] = points.matrix(self.shape.states[e].dim)?.transpose();
            entries.push((e, points, images));
        }
        for (e, points, images) in entries {
            at(&images.place, self.hull_maps_into(e, &images, shrinking))?;
            if shrinking {
                let spans = self.hulls[e].rank()? == self.shape.states[e].dim;
                points.need(spans, "contraction", "the points do not span the space of the state")?;
                let (hull, base) = (&self.hulls[e], &self.spaces.of(e)?.base);
                let ones = Matrix::ones(1, hull.cols, |_, _| true);
                let shift = hull.minus(&base.times(&ones)?);
                let column = |j: usize| (0..hull.rows).map(|i| shift.data[i * hull.cols + j].abs()).sum::<BigInt>();
                let largest = Q::new((0..hull.cols).map(column).max().unwrap_or_default(), shift.den.clone());
                points.need(
                    largest <= self.radius[e],
                    "contraction",
                    "the ball of this radius does not hold the points",
                )?;
            }
        }
        Ok(())
    }

    /// Rule `hull`: the image of each vertex of the target's hull under each piece is a convex combination of vertices, so
    /// that the hulls, mapped into themselves by a contracting system, hold the attractors.
    fn hull_maps_into(&self, e: usize, images: &Node<'_>, shrinking: bool) -> Checked<()> {
        let (own, images, pieces) = (&self.hulls[e], images.list()?, &self.shape.states[e].pieces);
        let sums = Matrix::ones(1, own.rows, |_, _| true).times(own)?;
        let affine = sums == Matrix::ones(1, own.cols, |_, _| true);
        need(affine && images.len() == pieces.len(), "hull", "images of each piece, and points of sum 1, are needed")?;
        for (piece, list) in pieces.iter().zip(&images) {
            let (target, list) = (&self.hulls[piece.target], list.list()?);
            let all = list.len() == target.cols && !list.is_empty();
            need(all, "hull", "one image for each vertex of the target's hull is needed")?;
            let mut weights = vec![vec![Q::zero(); own.cols]; target.cols];
            for (row, combination) in weights.iter_mut().zip(&list) {
                let mut next = 0;
                for term in combination.list()? {
                    let [index, weight] = term.fields(["vertex", "weight"])?;
                    let (k, weight) = (index.index(own.cols)?, weight.rational()?);
                    term.need(k >= next && weight.is_positive(), "hull", "vertices ascend, weights are positive")?;
                    (row[k], next) = (weight, k + 1);
                }
            }
            let common = |k: usize| weights.iter().all(|w| w[k].is_positive());
            let shrinks = !shrinking || (0..own.cols).any(common);
            need(shrinks, "contraction", "the images under a piece have no vertex in common")?;
            let weights = Matrix::from_rows(own.cols, &weights).transpose();
            let sums = Matrix::ones(1, own.cols, |_, _| true).times(&weights)?;
            let one = sums == Matrix::ones(1, target.cols, |_, _| true);
            need(one, "hull", "the weights do not add up to 1")?;
            let combined = own.times(&weights)?;
            need(piece.op.times(target)? == combined, "hull", "an image is not this convex combination")?;
        }
        Ok(())
    }

    /// Checks a tree below a word from `from` to `end` with its product.
    fn contracts(&self, from: usize, end: usize, product: &Matrix, tree: &Json) -> Checked<()> {
        match tree {
            Json::List(children) if children.len() == self.shape.states[end].pieces.len() => {
                for (piece, child) in self.shape.states[end].pieces.iter().zip(children) {
                    self.contracts(from, piece.target, &product.times(&piece.op)?, child)?;
                }
                Ok(())
            }
            Json::Text(leaf) if leaf == "." => {
                let radii = bits(&self.radius[end]) + bits(&self.radius[from]);
                spend(product.rows * product.cols * product.cols + 64, product.bits() + radii)?;
                let tau = dobrushin(product);
                need(tau < Q::one(), "contraction", "a word of the code does not contract")?;
                let shift = product.times(&self.spaces.of(end)?.base)?.minus(&self.spaces.of(from)?.base);
                let norm = Q::new(shift.data.iter().map(Signed::abs).sum(), shift.den);
                let holds = norm + tau * &self.radius[end] <= self.radius[from];
                need(holds, "contraction", "the ball of this radius does not hold the image of a ball")
            }
            _ => reject("contraction", "", "a code is a tree with one child for each letter and \".\" at its leaves"),
        }
    }

    /// Functionals on the germ's quotient, given over a number field, as rows on points.
    pub fn functionals(&self, germ: &Germ, field: &Field, rows: &[&Matrix]) -> Checked<Functionals> {
        self.enclosed(germ, &rows.iter().map(|row| field.enclose(row)).collect::<Checked<Vec<_>>>()?)
    }

    /// Functionals on the germ's quotient, given by enclosures of their entries, as rows on points.
    pub fn enclosed(&self, germ: &Germ, rows: &[Enclosed]) -> Checked<Functionals> {
        let (mut middles, mut errors) = (Matrix::empty(germ.dim()), Vec::new());
        for values in rows {
            middles = middles.stack(&values.lo.plus(&Q::one(), &values.hi).transpose());
            // |chart_k (x − q)| is at most osc(chart_k) times the radius, because both points lie in the ball.
            let spread = |k: usize| (&values.hi.data[k] - &values.lo.data[k]) * oscillation(germ.chart.integers(k));
            let sum: BigInt = (0..germ.dim()).map(spread).sum();
            errors.push(Q::new(sum, &values.lo.den * &germ.chart.den * 2) * &self.radius[germ.state]);
        }
        self.rows(germ, &middles.scaled(&Q::new(1.into(), 2.into())), errors)
    }

    /// Rational functionals on the germ's quotient, given as rows.
    pub fn rows(&self, germ: &Germ, on_quotient: &Matrix, errors: Vec<Q>) -> Checked<Functionals> {
        let rows = on_quotient.times(&germ.chart)?;
        let at_fixed = rows.times(&germ.fixed)?;
        Ok(Functionals { rows: rows.minus(&at_fixed.times(&Matrix::ones(1, rows.cols, |_, _| true))?), errors })
    }

    /// Whether a functional, given by its row on the points of a state, keeps a sign on the attractor of the state.
    fn keeps(&self, rows: &Matrix, k: usize, error: &Q, state: usize, sign: i32) -> Checked<bool> {
        let (row, base, radius) = (rows.integers(k), &self.spaces.of(state)?.base, &self.radius[state]);
        let hull = &self.hulls[state];
        spend(row.len() * (2 + hull.cols), rows.bits().max(base.bits()).max(hull.bits()) + bits(radius) + bits(error))?;
        let product = |v: &Matrix, j: usize| -> BigInt {
            row.iter().enumerate().map(|(i, x)| x * &v.data[i * v.cols + j]).sum::<BigInt>() * sign
        };
        // Both bounds are compared with 0 after multiplication by 2, the denominators and the sign.
        let margin = &rows.den * error.numer();
        let (r, s, t) = (radius.numer(), radius.denom(), error.denom());
        let spread = (oscillation(row) * r * t + &margin * s * 2) * &base.den;
        let by_ball = product(base, 0) * s * t * 2 > spread;
        let beyond = |j: usize| product(hull, j) * t > &margin * &hull.den;
        Ok(by_ball || (hull.cols > 0 && (0..hull.cols).all(beyond)))
    }

    /// Rule `cover`: every piece of the ring that is seen is cut into cells on each of which one of the functionals has one
    /// strict sign. The pieces come in the order of the ring (of one part of it, where `part` is given); leaves are `"+0"`,
    /// `"-0"`, `"+1"`, ….
    pub fn cover(
        &self,
        germ: &Germ,
        functionals: &Functionals,
        part: Option<Position>,
        node: &Node<'_>,
    ) -> Checked<Vec<Cell>> {
        let items = node.list()?;
        let pieces: Vec<_> = germ.ring.iter().filter(|p| part.is_none_or(|part| p.position == part)).collect();
        let all = items.len() == pieces.len();
        node.need(all, "cover", &format!("{} pieces of the ring are seen here", pieces.len()))?;
        let mut cells = Vec::new();
        for (item, piece) in items.iter().zip(pieces) {
            let [word, tree] = item.fields(["piece", "cells"])?;
            let same = word.word()? == piece.word;
            word.need(same, "cover", &format!("the piece {:?} of the ring is expected here", piece.word))?;
            let moved = functionals.rows.times(&piece.op)?;
            let covered = self.covers(&moved, &functionals.errors, piece.end, tree.value, &mut |functional, sign| {
                cells.push(Cell { position: piece.position, functional, sign });
            });
            at(&tree.place, covered)?;
        }
        Ok(cells)
    }

    fn covers(
        &self,
        rows: &Matrix,
        errors: &[Q],
        state: usize,
        tree: &Json,
        found: &mut dyn FnMut(usize, i32),
    ) -> Checked<()> {
        match tree {
            Json::List(children) if children.len() == self.shape.states[state].pieces.len() => {
                for (piece, child) in self.shape.states[state].pieces.iter().zip(children) {
                    self.covers(&rows.times(&piece.op)?, errors, piece.target, child, found)?;
                }
                Ok(())
            }
            Json::Text(leaf) => {
                let named = (0..rows.rows).flat_map(|k| [(k, 1, format!("+{k}")), (k, -1, format!("-{k}"))]);
                let Some((k, sign, _)) = named.into_iter().find(|(_, _, name)| name == leaf) else {
                    return reject("cover", "", "a leaf is a sign and the index of a functional, such as \"+0\"");
                };
                let keeps = self.keeps(rows, k, &errors[k], state, sign)?;
                need(keeps, "cover", "a functional does not keep the sign of its cell")?;
                found(k, sign);
                Ok(())
            }
            _ => reject("cover", "", "cells form a tree with one child for each letter"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::whole;
    use crate::poly::Interval;
    use crate::shape::{Kind, Piece, State};

    fn row(entries: &[i64]) -> Matrix {
        Matrix::new(1, entries.len(), &entries.iter().map(|&x| whole(x)).collect::<Vec<_>>())
    }

    /// A segment with middle `(1/2, 1/2)`: one piece, half as long.
    fn segment() -> Shape {
        let op = row(&[3, 1]).stack(&row(&[1, 3])).scaled(&(whole(1) / whole(4)));
        let pieces = vec![Piece { target: 0, op, reversed: false }];
        let states = vec![State { kind: Kind::Set, dim: 2, pieces, ends: [None, None] }];
        Shape { states, start: 0, view: Matrix::identity(2) }
    }

    fn model(shape: &Shape, radius: i64, hull: Matrix) -> Model<'_> {
        let spaces = Spaces::new(shape, &[0]).unwrap();
        Model { shape, reachable: vec![0], spaces, radius: vec![whole(radius)], hulls: vec![hull] }
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
        let germ = Germ { state: 0, prefix_sign: 1, turn: 1, fixed, chart, linear, view, ring: Vec::new() };
        // The root of 2 lies within 1/2 of 3/2; two points of the ball differ by at most 6, their chart by 6.
        let by_root = Field::companion(&[-2, 0, 1].map(whole));
        let root = Field { interval: Interval { lo: whole(1), hi: whole(2) }, by_root };
        let found = ball.functionals(&germ, &root, &[&row(&[0, 1])]).unwrap();
        assert_eq!(found.errors, [whole(3)]);
    }
}
