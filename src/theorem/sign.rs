//! The leading coefficient takes both signs on a connected part of the ring: there is no tangent line (theory §5, Theorem 4′).

use super::branch::power;
use super::ring::{Functional, Ring, RingAnswer, RingProof, Witness};
use crate::arith::Rational;
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use crate::poly::Poly;

/// A sum `E_1 ⊕ … ⊕ E_i` of rational generalised eigenspaces of the largest moduli, not 0.
pub struct Depth {
    /// `i`.
    pub classes: usize,
    /// Rows whose common kernel is `F_i`, in echelon form.
    pub rows: Matrix,
    /// Columns that span `E_1 ⊕ … ⊕ E_i`.
    pub space: Matrix,
}

/// The rational sums of generalised eigenspaces, the largest first.
#[must_use]
pub fn depths(spectrum: &Spectrum, linear: &Matrix) -> Vec<Depth> {
    let mut found = Vec::new();
    let nonzero = spectrum.classes.iter().take_while(|c| !spectrum.root(c.members[0]).is_zero()).count();
    for classes in (1..=nonzero).rev() {
        let inside = |f: usize| {
            let members = spectrum.classes[..classes].iter().flat_map(|c| &c.members);
            members.filter(|m| m.factor == f).count()
        };
        let (mut killer, mut rational) = (Matrix::identity(linear.rows()), true);
        for (f, factor) in spectrum.factors.iter().enumerate() {
            match inside(f) {
                0 => killer = &killer * &power(&evaluated(&factor.poly, linear), factor.multiplicity),
                n => rational &= n == factor.roots.len(),
            }
        }
        if rational {
            found.push(Depth { classes, rows: killer.echelon().rows, space: killer });
        }
    }
    found
}

fn evaluated(p: &Poly, at: &Matrix) -> Matrix {
    let n = at.rows();
    let term = |c: &Rational| Matrix::identity(n).scale(c);
    p.coeffs().iter().rev().fold(Matrix::zero(n, n), |sum, c| &(&sum * at) + &term(c))
}

/// Theorem 4′ for the functional of the one longest block: a sum of eigenspaces on which the view is injective, whose projection
/// has no zero on the ring, and two points of a connected part at which the functional has opposite signs.
///
/// `isolation` is the proof for the deepest sum; `known` is what refutes the ring condition of the functional.
pub fn changes_sign(
    ring: &Ring,
    decide: &dyn Fn(&[Functional]) -> RingAnswer,
    (spectrum, linear, view): (&Spectrum, &Matrix, &Matrix),
    functional: &Functional,
    isolation: &RingProof,
    known: Option<&Witness>,
) -> Option<(RingProof, Witness)> {
    let all = depths(spectrum, linear);
    let deepest = all.first()?.classes;
    let injective = |d: &&Depth| (view * &d.space).rank() == d.space.rank();
    let usable: Vec<&Depth> = all.iter().filter(injective).collect();
    if usable.is_empty() {
        return None;
    }
    let change = match known {
        Some(change @ Witness::SignChange { .. }) => change.clone(),
        _ => ring.connected_sign_change(functional)?,
    };
    for depth in usable {
        if depth.classes == deepest {
            return Some((isolation.clone(), change));
        }
        let rows: Vec<Functional> = (0..depth.rows.rows()).map(|k| Functional::rational(depth.rows.row(k))).collect();
        if let RingAnswer::Holds(proof) = decide(&rows) {
            return Some((proof, change));
        }
    }
    None
}
