//! Contraction by polytopes, as Coq checks it (`proofs/theories/Hulls.v`).

use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{Polytopes, Shape, difference, norm1};

/// Polytopes by state, in the order of the file.
pub(super) struct Hulls {
    /// Their vertices.
    pub corners: Vec<Vec<Vec<Rational>>>,
    /// By piece and vertex of its target, the weights of the image.
    pub images: Vec<Vec<Vec<Vec<Rational>>>>,
    /// By piece, the weights that all images have in common.
    pub shared: Vec<Vec<Vec<Rational>>>,
    /// Coordinates of vectors in the vertices, one row for each.
    pub inverses: Vec<Matrix>,
    /// What all pieces shrink differences to.
    pub constant: Rational,
}

impl Hulls {
    /// `None` where the vertices of a state do not span.
    pub fn new(shape: &Shape, states: &[usize], polytopes: &Polytopes) -> Option<Self> {
        let corners: Vec<_> = states.iter().map(|e| polytopes.vertices[*e].clone()).collect();
        let dense = |count: usize, weights: &[(usize, Rational)]| {
            let mut all = vec![Rational::from(0); count];
            weights.iter().for_each(|(l, w)| all[*l] += w);
            all
        };
        let of_state = |(e, own): (&usize, &Vec<Vec<Rational>>)| {
            let of_piece = |images: &Vec<_>| images.iter().map(|w: &Vec<_>| dense(own.len(), w)).collect::<Vec<_>>();
            polytopes.weights[*e].iter().map(of_piece).collect::<Vec<_>>()
        };
        let images: Vec<Vec<Vec<Vec<Rational>>>> = states.iter().zip(&corners).map(of_state).collect();
        let least = |of: &Vec<Vec<Rational>>| {
            let (first, rest) = of.split_first()?;
            let smaller =
                |a: Vec<Rational>, b: &Vec<Rational>| a.into_iter().zip(b).map(|(x, y)| x.min(y.clone())).collect();
            Some(rest.iter().fold(first.clone(), smaller))
        };
        let shared = images.iter().map(|of| of.iter().map(least).collect()).collect::<Option<Vec<_>>>()?;
        let inverse = |(e, own): (&usize, &Vec<Vec<Rational>>)| {
            let dim = shape.states[*e].dim;
            let all = Matrix::from_columns(dim, own);
            let chosen = all.pivots();
            let columns: Vec<_> = chosen.iter().map(|l| own[*l].clone()).collect();
            let small = (chosen.len() == dim).then(|| Matrix::from_columns(dim, &columns).inverse()).flatten()?;
            let row = |l: usize| chosen.iter().position(|c| *c == l);
            let entry = |l: usize, j: usize| row(l).map_or_else(|| Rational::from(0), |k| small[(k, j)].clone());
            Some(Matrix::from_fn(own.len(), dim, entry))
        };
        let inverses = states.iter().zip(&corners).map(inverse).collect::<Option<Vec<_>>>()?;
        Some(Self { corners, images, shared, inverses, constant: polytopes.constant.clone() })
    }
}

/// The radius of a ball around a centre that holds a polytope.
pub(super) fn radius(centre: &[Rational], vertices: &[Vec<Rational>]) -> Rational {
    vertices.iter().map(|v| norm1(&difference(v, centre))).fold(Rational::from(0), Rational::max)
}
