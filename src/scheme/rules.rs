//! Mesh rules by name.

use super::registry::{Parameter, Values, p, resolve, unknown};
use super::{DualWeights, LoopWeights, MeshRule, SchemeError, VertexWeights};
use crate::arith::{Rational, ratio};
use std::collections::BTreeMap;

/// A named mesh rule.
#[derive(Debug, Clone, Copy)]
pub struct RuleInfo {
    /// Its name.
    pub name: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Where it was published.
    pub source: &'static str,
    /// What it is, in one line; for which valences its weights are rational.
    pub summary: &'static str,
    build: fn(&Values) -> MeshRule,
}

/// All named mesh rules, in alphabetical order.
#[must_use]
pub fn mesh_rules() -> &'static [RuleInfo] {
    RULES
}

/// A mesh rule by name; see [`super::local_matrix`] and [`super::patch()`].
///
/// # Errors
/// [`SchemeError::Unknown`], [`SchemeError::Parameter`], [`SchemeError::Missing`].
pub fn mesh_rule(name: &str, parameters: &BTreeMap<String, Rational>) -> Result<MeshRule, SchemeError> {
    let info = RULES.iter().find(|r| r.name == name);
    let info = info.ok_or_else(|| unknown(name, RULES.iter().map(|r| r.name)))?;
    Ok((info.build)(&resolve(name, info.parameters, parameters)?))
}

const RULES: &[RuleInfo] = &[
    RuleInfo {
        name: "butterfly",
        parameters: &[p("w", Some("1/16"), "tension")],
        source: "N. Dyn, J. Gregory, D. Levin, ACM Trans. Graphics 9 (1990)",
        summary: "interpolatory, triangles; two rings at least",
        build: |v| MeshRule::Butterfly { w: v.number("w").clone(), modified: false },
    },
    RuleInfo {
        name: "butterfly-modified",
        parameters: &[p("w", Some("1/16"), "tension of the regular rule")],
        source: "D. Zorin, P. Schröder, W. Sweldens, SIGGRAPH 1996",
        summary: "interpolatory, triangles; rational for valences 3, 4, 6",
        build: |v| MeshRule::Butterfly { w: v.number("w").clone(), modified: true },
    },
    RuleInfo {
        name: "catmull-clark",
        parameters: &[],
        source: "E. Catmull, J. Clark, Computer-Aided Design 10 (1978)",
        summary: "quadrangles; every valence",
        build: |_| MeshRule::CatmullClark(None),
    },
    RuleInfo {
        name: "catmull-clark-variant",
        parameters: &[
            p("alpha", None, "weight of the vertex"),
            p("beta", None, "sum of the weights of the edge neighbours; the opposite corners have the rest"),
        ],
        source: "A. Ball, D. Storry, ACM Trans. Graphics 7 (1988); J. Peters, U. Reif, SIAM J. Numer. Anal. 35 (1998)",
        summary: "quadrangles, other weights at the vertex; every valence",
        build: |v| {
            let (alpha, beta) = (v.number("alpha").clone(), v.number("beta").clone());
            let gamma = ratio(1, 1) - &alpha - &beta;
            MeshRule::CatmullClark(Some(VertexWeights { alpha, beta, gamma }))
        },
    },
    RuleInfo {
        name: "doo-sabin",
        parameters: &[],
        source: "D. Doo, M. Sabin, Computer-Aided Design 10 (1978)",
        summary: "dual, around a face; rational for valences 3, 4, 6",
        build: |_| MeshRule::DooSabin(DualWeights::Original),
    },
    RuleInfo {
        name: "doo-sabin-catmull-clark",
        parameters: &[],
        source: "E. Catmull, J. Clark, Computer-Aided Design 10 (1978)",
        summary: "dual, means of corner, midpoints and centre; every valence",
        build: |_| MeshRule::DooSabin(DualWeights::CatmullClark),
    },
    RuleInfo {
        name: "doo-sabin-frequency",
        parameters: &[p("frequency", Some("2"), "how often the weights turn around the face")],
        source: "a counter-example: its characteristic map winds as often as the frequency says",
        summary: "dual, Doo and Sabin's weights with another frequency; rational for valences 3, 4, 6",
        build: |v| {
            let frequency = usize::try_from(v.number("frequency")).unwrap_or(1).clamp(1, 1024);
            MeshRule::DooSabin(DualWeights::Frequency(frequency))
        },
    },
    RuleInfo {
        name: "four-eight",
        parameters: &[],
        source: "L. Velho, D. Zorin, CAGD 18 (2001)",
        summary: "quadrangles, two steps; every valence, two rings at least",
        build: |_| MeshRule::FourEight,
    },
    RuleInfo {
        name: "loop",
        parameters: &[],
        source: "C. Loop, master's thesis, Utah (1987)",
        summary: "triangles; rational for valences 3, 4, 6",
        build: |_| MeshRule::Loop(LoopWeights::Original),
    },
    RuleInfo {
        name: "loop-variant",
        parameters: &[p("beta", None, "weight of each neighbour in the vertex rule")],
        source: "C. Loop, master's thesis, Utah (1987)",
        summary: "triangles, given weight at the vertex; every valence",
        build: |v| MeshRule::Loop(LoopWeights::Given(v.number("beta").clone())),
    },
    RuleInfo {
        name: "loop-warren",
        parameters: &[],
        source: "J. Warren, Subdivision methods for geometric design (1995)",
        summary: "triangles, weights 3/(8n); every valence",
        build: |_| MeshRule::Loop(LoopWeights::Warren),
    },
    RuleInfo {
        name: "midedge",
        parameters: &[],
        source: "J. Peters, U. Reif, ACM Trans. Graphics 16 (1997); A. Habib, J. Warren, CAGD 16 (1999)",
        summary: "dual, around a face, two steps at once; every valence",
        build: |_| MeshRule::DooSabin(DualWeights::Midedge),
    },
    RuleInfo {
        name: "quad-triangle",
        parameters: &[],
        source: "J. Stam, C. Loop, Computer Graphics Forum 22 (2003), without the correction at extraordinary vertices",
        summary: "quadrangles and triangles: linear subdivision and averaging",
        build: |_| MeshRule::QuadTriangle,
    },
    RuleInfo {
        name: "sqrt3",
        parameters: &[],
        source: "L. Kobbelt, SIGGRAPH 2000",
        summary: "triangles, two steps; rational for valences 3, 4, 6",
        build: |_| MeshRule::Sqrt3(None),
    },
    RuleInfo {
        name: "sqrt3-variant",
        parameters: &[p("alpha", None, "weight of all neighbours together in the vertex rule")],
        source: "L. Kobbelt, SIGGRAPH 2000",
        summary: "triangles, two steps, given weight at the vertex; every valence",
        build: |v| MeshRule::Sqrt3(Some(v.number("alpha").clone())),
    },
];
