//! The leading coefficient takes both signs on a connected part of the ring: there is no tangent line (theory §5, Theorem 4′).

use super::branch::power;
use super::ring::{Functional, Ring, RingAnswer, RingProof, Witness};
use crate::arith::Rational;
use crate::jordan::{Scalar, Spectral};
use crate::linalg::Matrix;

/// A sum `E_1 ⊕ … ⊕ E_i` of generalised eigenspaces of the largest moduli, not 0.
pub struct Depth<E = Rational> {
    /// `i`.
    pub classes: usize,
    /// Rows whose common kernel is `F_i`, in echelon form.
    pub rows: Matrix<E>,
    /// Columns that span `E_1 ⊕ … ⊕ E_i`.
    pub space: Matrix<E>,
}

/// The sums of generalised eigenspaces with bases over the field of the entries, the largest first.
#[must_use]
pub fn depths<E: Scalar>(spectrum: &E::Spectrum, linear: &Matrix<E>) -> Vec<Depth<E>> {
    let mut found = Vec::new();
    let nonzero = spectrum.classes().iter().take_while(|c| !spectrum.value(c.members[0]).is_zero()).count();
    for classes in (1..=nonzero).rev() {
        let inside = |f: usize| {
            let members = spectrum.classes()[..classes].iter().flat_map(|c| &c.members);
            members.filter(|m| m.factor == f).count()
        };
        let (mut killer, mut whole) = (Matrix::identity(linear.rows()), true);
        for f in 0..spectrum.factor_count() {
            match inside(f) {
                0 => killer = &killer * &power(&E::factor_at(spectrum, f, linear), spectrum.part(f).multiplicity),
                n => whole &= n == spectrum.part(f).roots.len(),
            }
        }
        if whole {
            found.push(Depth { classes, rows: killer.echelon().rows, space: killer });
        }
    }
    found
}

/// Theorem 4′ for the functional of the one longest block: a sum of eigenspaces on which the view is injective, whose projection
/// has no zero on the ring, and two points of a connected part at which the functional has opposite signs.
///
/// `isolation` is the proof for the deepest sum; `known` is what refutes the ring condition of the functional.
pub fn changes_sign<E: Scalar>(
    ring: &Ring<E>,
    decide: &dyn Fn(&[Functional]) -> RingAnswer<E>,
    (spectrum, linear, view): (&E::Spectrum, &Matrix<E>, &Matrix<E>),
    functional: &Functional,
    isolation: &RingProof,
    known: Option<&Witness<E>>,
) -> Option<(RingProof, Witness<E>)> {
    let all = depths(spectrum, linear);
    let deepest = all.first()?.classes;
    let injective = |d: &&Depth<E>| (view * &d.space).rank() == d.space.rank();
    let usable: Vec<&Depth<E>> = all.iter().filter(injective).collect();
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
        let rows: Vec<Functional> =
            (0..depth.rows.rows()).map(|k| Functional::of(depth.rows.row(k), ring.base)).collect();
        if let RingAnswer::Holds(proof) = decide(&rows) {
            return Some((proof, change));
        }
    }
    None
}
