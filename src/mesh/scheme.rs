//! The schemes of which the limits are known by formulas.

use crate::arith::{Rational, ratio};
use crate::scheme::{MeshRule, SchemeError, mesh_rule, rational_cosine};
use std::collections::BTreeMap;

/// A scheme by which a mesh is refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// Catmull and Clark's.
    CatmullClark,
    /// Loop's, with his weights.
    Loop,
    /// Loop's, with Warren's weights.
    LoopWarren,
}

impl Scheme {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::CatmullClark, Self::Loop, Self::LoopWarren];

    /// The name of its rule in the table of mesh rules.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::CatmullClark => "catmull-clark",
            Self::Loop => "loop",
            Self::LoopWarren => "loop-warren",
        }
    }

    /// The scheme of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name)
    }

    /// Its rule.
    ///
    /// # Errors
    /// [`SchemeError`] if the table of mesh rules had no such row.
    pub fn rule(self) -> Result<MeshRule, SchemeError> {
        mesh_rule(self.name(), &BTreeMap::new())
    }

    /// Whether its faces are triangles.
    #[must_use]
    pub fn triangles(self) -> bool {
        self != Self::CatmullClark
    }

    /// The weight of all neighbours together in the new point of a vertex, where the faces are triangles and it is rational.
    #[must_use]
    pub fn weight(self, n: usize) -> Option<Rational> {
        match self {
            Self::CatmullClark => None,
            Self::LoopWarren => Some(if n == 3 { ratio(9, 16) } else { ratio(3, 8) }),
            Self::Loop => {
                let own = ratio(3, 8) + rational_cosine(1, n)? * ratio(1, 4);
                Some(ratio(5, 8) - &own * &own)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::sector_stencils;

    /// The weights are those of the table, wherever its stencils are rational.
    #[test]
    fn the_weights_are_those_of_the_rules() {
        for scheme in [Scheme::Loop, Scheme::LoopWarren] {
            for n in [3, 4, 6] {
                let stencils = sector_stencils(&scheme.rule().unwrap(), n, 3).unwrap();
                assert_eq!(stencils.centre.unwrap().0, ratio(1, 1) - scheme.weight(n).unwrap(), "{scheme:?} at {n}");
            }
        }
    }
}
