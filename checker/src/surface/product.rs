//! Tensor products of two curves: `p(s, t) = a(s) ⊗ b(t)` (docs/certificate.md, section 8.1).

use super::chart::Chart;
use crate::base::{Checked, Matrix, Node, Verdict, need, together};
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

/// Two curves, neither of them constant, with points of them.
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
            let model = Model::read(shape, &contraction)?;
            shape.check_curves()?;
            // Along a piece that is a point the curve is constant, and its germ at a parameter is not that of the set.
            let pieces = shape.states[0].pieces.len();
            let moves = pieces > 0 && model.spaces.solid(0)?.len() == pieces && model.spaces.of(0)?.basis.cols > 0;
            node.need(moves, "product", "the curve or one of its pieces is a point")?;
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
            let (point, here) = (&points[item.index(points.len())?], normal.map(|a| Place::of_address(model, &a)));
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
