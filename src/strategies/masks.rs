//! Random masks with sum rules, and random weights at extraordinary vertices.

use super::matrices::below;
use crate::arith::{Rational, ratio};
use crate::scheme::{Mask, SchemeError};
use proptest::prelude::*;
use std::fmt::Write;

/// A binary mask `(1 + z)^m / 2^(m−1) · b(z)` with `b(1) = 1`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MaskPlan {
    /// The power of the smoothing factor, 1 at least.
    pub smoothing: usize,
    /// The coefficients of `b`, which sum to 1.
    pub factor: Vec<Rational>,
}

impl MaskPlan {
    /// The coefficients of the mask.
    #[must_use]
    pub fn coefficients(&self) -> Vec<Rational> {
        let mut mask: Vec<Rational> = self.factor.iter().map(|c| c * ratio(2, 1)).collect();
        for _ in 0..self.smoothing {
            let half = ratio(1, 2);
            let mut next = vec![ratio(0, 1); mask.len() + 1];
            for (i, c) in mask.iter().enumerate() {
                next[i] += c * &half;
                next[i + 1] += c * &half;
            }
            mask = next;
        }
        mask
    }

    /// The mask.
    ///
    /// # Errors
    /// [`SchemeError`] where it has no curve, as one of a single coefficient.
    pub fn mask(&self) -> Result<Mask, SchemeError> {
        Mask::new(2, self.coefficients())
    }
}

/// Binary masks that fulfil the sum rules of order 1 to `most`.
pub fn mask(most: usize) -> impl Strategy<Value = MaskPlan> {
    (1..=most.max(1), prop::collection::vec(below(ratio(1, 2)), 0..4)).prop_map(|(smoothing, mut factor)| {
        let sum = factor.iter().fold(ratio(0, 1), |s, c| s + c);
        factor.push(ratio(1, 1) - sum);
        MaskPlan { smoothing, factor }
    })
}

/// A mesh rule with weights of one's own at a vertex.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VertexPlan {
    /// The name of the mesh rule.
    pub mesh: &'static str,
    /// The valence.
    pub valence: usize,
    /// Its parameters.
    pub parameters: Vec<(&'static str, Rational)>,
}

impl VertexPlan {
    /// The plan as a case file.
    #[must_use]
    pub fn case(&self) -> String {
        let mut text =
            format!("name = \"vertex\"\n\n[vertex]\nmesh = \"{}\"\nvalence = \"{}\"\n", self.mesh, self.valence);
        for (name, value) in &self.parameters {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{name} = \"{value}\"");
        }
        text
    }
}

/// Named mesh rules, Loop's with a random `β`, the butterfly scheme with a random tension, at valences 3 to `most`.
pub fn vertex_weights(most: usize) -> impl Strategy<Value = VertexPlan> {
    let rule = prop_oneof![
        Just(("catmull-clark", Vec::new())),
        Just(("loop", Vec::new())),
        Just(("doo-sabin", Vec::new())),
        (1i64..40).prop_map(|k| ("loop-variant", vec![("beta", ratio(k, 64))])),
        (1i64..16).prop_map(|k| ("butterfly", vec![("w", ratio(k, 128))])),
    ];
    (rule, 3..=most.max(3)).prop_map(|((mesh, parameters), valence)| VertexPlan { mesh, valence, parameters })
}
