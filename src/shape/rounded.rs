//! Shapes with rational entries near those of a shape over a number field.

use super::{Boundary, Piece, Shape, State};
use crate::algebraic::Real;
use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};

impl Shape<Real> {
    /// The shape with its entries rounded to so many binary digits, for pictures and proposals: nothing is proved of it.
    #[must_use]
    pub fn rounded(&self, bits: u64) -> Shape {
        let near = |m: &Matrix<Real>| m.map(|x| x.enclosure(bits + 1).outward(bits + 1).mid());
        // The last row makes up for what the sums of columns lose.
        let operator = |m: &Matrix<Real>| {
            let mut op = near(m);
            let last = op.rows() - 1;
            for j in 0..op.cols() {
                let sum = (0..op.rows()).fold(Rational::from(0), |s, i| s + &op[(i, j)]);
                op[(last, j)] += Rational::from(1) - sum;
            }
            op
        };
        let boundary =
            |b: &Option<Boundary<Real>>| b.as_ref().map(|b| Boundary { vertex: b.vertex, op: operator(&b.op) });
        let state = |s: &State<Real>| State {
            name: s.name.clone(),
            kind: s.kind,
            dim: s.dim,
            pieces: s
                .pieces
                .iter()
                .map(|p| Piece { target: p.target, op: operator(&p.op), reversed: p.reversed, share: p.share.clone() })
                .collect(),
            left: boundary(&s.left),
            right: boundary(&s.right),
        };
        let states = self.states.iter().map(state).collect();
        Shape { states, start: self.start, control: self.control.as_ref().map(near), frame: self.frame }
    }
}
