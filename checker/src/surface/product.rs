//! Tensor products of two curves: `p(s, t) = a(s) ⊗ b(t)` (docs/certificate.md, section 8.1).

use super::chart::Chart;
use crate::base::{Checked, Matrix, Node, Verdict, need, spend, together};
use crate::curve::{Address, Kind, Model, Piece, Place, Point, Root, Shape, State, kronecker, turns};

/// The operators of a curve of one state, whose columns sum to 1.
pub fn curve(node: &Node<'_>) -> Checked<Shape> {
    let [operators, _, _] = node.fields("operators contraction points")?;
    let mut pieces = Vec::new();
    for item in operators.list()? {
        let op = item.matrix(item.list()?.len())?;
        item.need(op.is_affine() && op.rows > 0, "product", "a matrix whose columns sum to 1 is needed")?;
        pieces.push(Piece { target: 0, op, reversed: false, share: None });
    }
    operators.need(!pieces.is_empty(), "product", "a curve has pieces")?;
    let dim = pieces[0].op.rows;
    operators.need(pieces.iter().all(|p| p.op.rows == dim), "product", "operators of one size are needed")?;
    let states = vec![State { kind: Kind::Edge, dim, pieces, ends: [None, None] }];
    Ok(Shape::new(states, 0, Matrix::identity(dim)))
}

/// Whether outside the smallest space `K` (rows) that holds all vectors which some operator takes into it there is a vector: what is
/// outside stays there, so no product of the operators is 0.
fn never_vanish(operators: &[Matrix]) -> Checked<bool> {
    let Some(size) = operators.first().map(|a| a.cols) else { return Ok(false) };
    let mut space = Matrix::empty(size);
    let mut grown = true;
    while std::mem::take(&mut grown) {
        for operator in operators {
            spend(1, 0)?;
            // (A | Kᵗ) (x, y) = 0.
            let into = operator.beside(&space.transpose()).kernel()?;
            let taken = into.part(0..into.rows, 0..size);
            if let Some((joined, _)) = space.joined(&taken)? {
                (space, grown) = (joined, true);
            }
        }
    }
    Ok(space.rows < size)
}

/// Two curves, no cell of which is a point, with points of them.
pub struct Product<'a> {
    curves: Vec<(Model<'a>, Vec<Point>)>,
}

impl<'a> Product<'a> {
    /// Checks that the patch of a case is the product of two curves, and the certificates of these.
    pub fn read(case: &Shape, chart: &Chart, curves: &'a [Shape], nodes: &[Node<'_>]) -> Checked<Self> {
        let [a, b] = [0, 1].map(|k| &curves[k].states[0].pieces);
        let pieces = &case.states[case.start].pieces;
        need(pieces.len() == a.len() * b.len(), "product", "the patch has another number of pieces")?;
        for (k, piece) in pieces.iter().enumerate() {
            let fits = piece.target == case.start && chart.is_plain(k, a.len(), b.len());
            let (first, second) = (&a[k % a.len()].op, &b[k / a.len()].op);
            let sized = first.rows * second.rows == piece.op.rows && first.cols * second.cols == piece.op.cols;
            need(
                fits && sized && kronecker(first, second)? == piece.op,
                "product",
                "a piece is not the product of pieces of the curves",
            )?;
        }
        let root = |shape: &Shape| Root { state: 0, view: shape.view.clone() };
        let mut read = Vec::new();
        for (shape, node) in curves.iter().zip(nodes) {
            let [_, contraction, points] = node.fields("operators contraction points")?;
            let model = Model::read(shape, &(), &contraction)?;
            shape.check_curves()?;
            // Along a cell that is a point the curve is constant, and the tangent subspace is that of the other curve.
            let pieces = &shape.states[0].pieces;
            let linear = pieces.iter().map(|p| model.spaces.linear(&p.op, 0, 0)).collect::<Checked<Vec<_>>>()?;
            let moves =
                never_vanish(&linear)? || never_vanish(&linear.iter().map(Matrix::transpose).collect::<Vec<_>>())?;
            node.need(!pieces.is_empty() && moves, "product", "the curve or one of its cells may be a point")?;
            let check = |item: &Node<'_>| Point::check(&model, &root(shape), item);
            let points = points.each(check)?;
            read.push((model, points));
        }
        Ok(Self { curves: read })
    }

    /// Whether both curves are G¹; one of them refutes it, and then nothing need be said of the other.
    pub fn every(&self, node: &Node<'_>) -> Checked<Verdict> {
        let mut found = Vec::new();
        for ((model, points), item) in self.curves.iter().zip(node.exactly(2, "every")?) {
            found.push(if item.is_null() { Verdict::Undetermined } else { item.at(turns(model, points, &item))? });
        }
        Ok(together(found))
    }

    /// Whether both curves are differentiable at the parameters of an address; their points are named by two indices.
    pub fn verdict(&self, address: &Address, node: &Node<'_>) -> Checked<Verdict> {
        let (columns, items) = (self.curves[0].0.shape.states[0].pieces.len(), node.exactly(2, "product")?);
        let mut both = Verdict::Proved;
        for (k, ((model, points), item)) in self.curves.iter().zip(&items).enumerate() {
            let part = |word: &[usize]| word.iter().map(|l| [l % columns, l / columns][k]).collect();
            let normal =
                Address { prefix: part(&address.prefix), cycle: part(&address.cycle) }.normalise(model.shape, 0);
            let (point, here) = (&points[item.index(points.len())?], normal.map(|a| Place::of_address(model, 0, &a)));
            item.need(
                Some(&point.place) == here.transpose()?.as_ref(),
                "product",
                "another point of the curve is needed",
            )?;
            both = both.min(point.verdict);
        }
        Ok(both)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Q;
    use num_traits::One;

    #[test]
    fn products_that_vanish() {
        let (zero, one, two) = (Q::from_integer(0.into()), Q::one(), -Q::one());
        let matrix = |entries: [usize; 4]| {
            Matrix::new(2, 2, &entries.map(|k| [zero.clone(), one.clone(), two.clone()][k].clone()))
        };
        // The image of the second one is killed by the first one.
        assert_eq!(never_vanish(&[matrix([1, 2, 0, 0]), matrix([1, 0, 1, 0])]), Ok(false));
        assert_eq!(never_vanish(&[matrix([1, 0, 0, 0]), matrix([1, 0, 1, 0])]), Ok(true));
        // Both kill a line, and keep another one.
        let (a, b) = (matrix([1, 1, 0, 0]), matrix([1, 2, 0, 0]));
        assert_eq!(never_vanish(&[a.clone(), b.clone()]), Ok(false));
        assert_eq!(never_vanish(&[a.transpose(), b.transpose()]), Ok(true));
        assert_eq!(never_vanish(&[]), Ok(false));
        assert_eq!(never_vanish(&[Matrix::zeros(0, 0)]), Ok(false));
    }
}
