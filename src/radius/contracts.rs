//! Contraction by norms, where the coefficients of short words do not show it (theory §1).

use super::budget::Budget;
use super::search::candidates;
use super::{Arrow, JointRadius, Options, System, joint_radius};
use crate::arith::Rational;
use crate::shape::{Polytopes, Shape, linear_part};

/// Whether the linear parts of a shape's operators contract.
#[derive(Debug, Clone)]
pub enum NormContraction {
    /// They do, and polytopes that are mapped into one another enclose the attractors.
    Enclosed(Polytopes),
    /// They do: the joint spectral radius is proved to be below 1.
    Proved(Box<JointRadius>),
    /// They do not: a cycle whose linear part has spectral radius at least 1.
    Refuted {
        /// The state of the cycle.
        state: usize,
        /// The cycle.
        word: Vec<usize>,
        /// The joint spectral radius as far as it is known.
        radius: Box<JointRadius>,
    },
    /// Not decided.
    Undetermined(Box<JointRadius>),
}

/// The linear parts of all operators of the reachable states, in the bases `e_k − e_0` of the zero-sum vectors, and for every
/// arrow its state and letter.
#[must_use]
pub fn linear_system(shape: &Shape) -> (System, Vec<(usize, usize)>) {
    let reachable = shape.reachable();
    let number = |state: usize| reachable.iter().position(|s| *s == state).expect("a reachable state");
    let mut arrows = Vec::new();
    let mut letters = Vec::new();
    for &state in &reachable {
        for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
            let matrix = linear_part(&piece.op);
            arrows.push(Arrow { from: number(state), to: number(piece.target), matrix, label: arrows.len() });
            letters.push((state, letter));
        }
    }
    let dims = reachable.iter().map(|s| shape.states[*s].dim.saturating_sub(1)).collect();
    (System { dims, arrows }, letters)
}

/// Longest words looked at before polytopes are tried.
const WORDS: usize = 12;

/// Polytopes around the attractors that all pieces shrink; `None` where none with few vertices was found.
///
/// # Cost
/// A search for words, and a few hundred small linear programs.
#[must_use]
pub fn polytopes(shape: &Shape) -> Option<Polytopes> {
    let (system, _) = linear_system(shape);
    let budget = Budget::new(&Options::default(), 1);
    let value = candidates(&system, WORDS, 1e-9, &budget).iter().map(|c| c.value).fold(0.0, f64::max);
    if value < 1.0 { super::enclose::polytopes(shape, value) } else { None }
}

/// Decides contraction by polytopes, or through the joint spectral radius constrained by the automaton.
///
/// # Cost
/// A few polytopes; one joint spectral radius where they do not close.
#[must_use]
pub fn contraction_by_norms(shape: &Shape, options: &Options) -> Option<NormContraction> {
    if let Some(found) = polytopes(shape) {
        return Some(NormContraction::Enclosed(found));
    }
    let (system, letters) = linear_system(shape);
    let radius = Box::new(joint_radius(&system, options).ok()?);
    if let Some(lower) = &radius.lower
        && lower.is_at_least(&Rational::from(1))
    {
        let state = letters[lower.path[0]].0;
        let word = lower.path.iter().map(|a| letters[*a].1).collect();
        return Some(NormContraction::Refuted { state, word, radius });
    }
    let below = |bound: &Option<Rational>| bound.as_ref().is_some_and(|b| *b < 1);
    let proved = radius.exact || below(&radius.upper);
    Some(if proved { NormContraction::Proved(radius) } else { NormContraction::Undetermined(radius) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;
    use crate::shape::CellKind;

    fn family(a: (i64, i64), b: (i64, i64)) -> Shape {
        let (one, o) = (Rational::from(1), Rational::from(0));
        let (a, b) = (ratio(a.0, a.1), ratio(b.0, b.1));
        let t0 = vec![
            vec![&one - &a, b.clone(), o.clone()],
            vec![a.clone(), &one - &b, &one - &a],
            vec![o.clone(), o.clone(), a.clone()],
        ];
        let t1 =
            vec![vec![b.clone(), o.clone(), o.clone()], vec![&one - &b, &one - &a, b.clone()], vec![o, a, &one - &b]];
        Shape::single(CellKind::Edge, vec![Matrix::from_rows(3, t0), Matrix::from_rows(3, t1)])
    }

    #[test]
    fn generators_of_small_radius_may_not_contract() {
        let Some(NormContraction::Refuted { word, .. }) =
            contraction_by_norms(&family((-3, 5), (7, 10)), &Options::default())
        else {
            panic!("expands")
        };
        assert!(word.len() > 1);
        let answer = contraction_by_norms(&family((-3, 5), (41, 50)), &Options::default());
        assert!(matches!(answer, Some(NormContraction::Enclosed(_))));
        let answer = contraction_by_norms(&family((1, 1), (0, 1)), &Options::default());
        assert!(matches!(answer, Some(NormContraction::Refuted { .. })));
    }
}
