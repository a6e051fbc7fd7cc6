//! Contraction by polytopes that all pieces map into one another with a common share (theory §1, Lemma 1′).

use super::Shape;
use super::contraction::norm1;
use super::hull::Hulls;
use super::space::difference;
use crate::arith::Rational;
use crate::linalg::Matrix;

/// Positive weights of some vertices of a state: index and weight.
pub type Weights = Vec<(usize, Rational)>;

/// For every reachable state a polytope, and what shows that the pieces shrink them.
#[derive(Debug, Clone)]
pub struct Polytopes {
    /// Vertices by state, as points of its barycentric space; none for states that cannot be reached.
    pub vertices: Hulls,
    /// By state, piece and vertex of the piece's target: the image of the vertex as a convex combination of vertices.
    pub weights: Vec<Vec<Vec<Weights>>>,
    /// `1 − m < 1`, where all images under a piece have weights in common that add up to at least `m`: every operator maps the
    /// differences of the points of one polytope into this multiple of those of another.
    pub constant: Rational,
}

impl Polytopes {
    /// Checks the data against a shape, exactly, and computes the constant; `None` where they prove nothing.
    ///
    /// # Cost
    /// One product of an operator and a vector for each piece and vertex, and one rank for each state.
    #[must_use]
    pub fn checked(shape: &Shape, vertices: Hulls, weights: Vec<Vec<Vec<Weights>>>) -> Option<Self> {
        let mut constant = Rational::from(0);
        for e in shape.reachable() {
            let (dim, own) = (shape.states[e].dim, vertices.get(e)?);
            let spans = Matrix::from_rows(dim, own.clone()).echelon().rows.rows() == dim;
            let affine = own.iter().all(|v| v.iter().fold(Rational::from(0), |s, x| s + x) == 1);
            let pieces = &shape.states[e].pieces;
            let images = weights.get(e).filter(|w| w.len() == pieces.len())?;
            if !spans || !affine {
                return None;
            }
            for (piece, list) in pieces.iter().zip(images) {
                let target = vertices.get(piece.target)?;
                let fits = list.len() == target.len()
                    && list.iter().zip(target).all(|(w, v)| is_combination(own, w, &piece.op.apply(v)));
                if !fits {
                    return None;
                }
                constant = constant.max(Rational::from(1) - common(list, own.len()));
            }
        }
        (constant < 1).then_some(Self { vertices, weights, constant })
    }

    /// The same polytopes in the coordinates of a shape of which these are polytopes by its own points; the constant stays.
    #[must_use]
    pub fn outwards(self, own: &super::OwnPoints) -> Self {
        let vertices = self.vertices.iter().enumerate().map(|(e, points)| own.outwards(e, points)).collect();
        Self { vertices, ..self }
    }

    /// The largest distance, in the 1-norm, of a vertex of a state from a point.
    #[must_use]
    pub fn reach(&self, state: usize, from: &[Rational]) -> Rational {
        self.vertices[state].iter().map(|v| norm1(&difference(v, from))).max().expect("a polytope has vertices")
    }

    /// How many vertices there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.vertices.iter().map(Vec::len).sum()
    }
}

/// Whether positive weights that add up to 1 combine the vertices to the point.
fn is_combination(vertices: &[Vec<Rational>], weights: &Weights, point: &[Rational]) -> bool {
    let mut sum = Rational::from(0);
    let mut rest = point.to_vec();
    for (k, w) in weights {
        let Some(vertex) = vertices.get(*k).filter(|_| *w > 0) else { return false };
        sum += w;
        rest.iter_mut().zip(vertex).for_each(|(r, x)| *r -= w * x);
    }
    sum == 1 && rest.iter().all(|r| *r == 0)
}

/// `Σ_k min w_k` over all combinations of a list.
fn common(list: &[Weights], count: usize) -> Rational {
    let column = |weights: &Weights| {
        let mut all = vec![Rational::from(0); count];
        weights.iter().for_each(|(k, w)| all[*k] += w);
        all
    };
    let least = list.iter().map(column).reduce(|a, b| a.into_iter().zip(b).map(|(x, y)| x.min(y)).collect());
    least.into_iter().flatten().fold(Rational::from(0), |s, x| s + x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::shape::CellKind;

    /// A map of the line about the middle of a segment, with slope `s`, and the ends of the segment as polytope.
    fn of(s: Rational) -> Option<Polytopes> {
        let one = Rational::from(1);
        let (near, far) = ((&one + &s) / Rational::from(2), (&one - &s) / Rational::from(2));
        let op = Matrix::from_rows(2, vec![vec![near.clone(), far.clone()], vec![far.clone(), near.clone()]]);
        let shape = Shape::single(CellKind::Set, vec![op]);
        let ends = vec![vec![one.clone(), Rational::from(0)], vec![Rational::from(0), one.clone()]];
        let list =
            |a: &Rational, b: &Rational| [(0, a.clone()), (1, b.clone())].into_iter().filter(|t| t.1 != 0).collect();
        Polytopes::checked(&shape, vec![ends], vec![vec![vec![list(&near, &far), list(&far, &near)]]])
    }

    #[test]
    fn a_share_in_common_is_needed() {
        assert_eq!(of(ratio(3, 4)).map(|p| p.constant), Some(ratio(3, 4)));
        assert_eq!(of(ratio(-3, 4)).map(|p| p.constant), Some(ratio(3, 4)));
        assert!(of(ratio(1, 1)).is_none() && of(ratio(-1, 1)).is_none() && of(ratio(5, 4)).is_none());
    }
}
