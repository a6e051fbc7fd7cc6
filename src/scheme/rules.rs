//! The table of mesh rules: how a step divides faces, the weights of new points, those at the centre as functions of the
//! valence, and what is known of the rule. A new rule is a new row.

use super::SchemeError;
use super::registry::{Values, p, resolve, unknown};
use super::rule::{AllValences, Edge, MeshRule, Points, RuleInfo, Spline, Split, Star, Wheel};
use crate::arith::{Rational, ratio};
use crate::poly::Poly;
use std::collections::BTreeMap;

/// All named mesh rules, in alphabetical order.
#[must_use]
pub fn mesh_rules() -> &'static [RuleInfo] {
    RULES
}

/// A mesh rule by name; see [`super::local_matrix`] and [`super::patch()`].
///
/// # Errors
/// [`SchemeError::Unknown`], [`SchemeError::Parameter`], [`SchemeError::Missing`]; [`SchemeError::Value`] for a frequency that
/// is no whole number.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, scheme::mesh_rule};
/// let butterfly = mesh_rule("butterfly", &[].into())?;
/// assert_eq!(butterfly.weights(), [("w", "1/16".to_owned())]);
/// assert!(mesh_rule("butterfly", &[("tension".to_owned(), ratio(1, 16))].into()).is_err());
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn mesh_rule(name: &str, parameters: &BTreeMap<String, Rational>) -> Result<MeshRule, SchemeError> {
    let info = RULES.iter().find(|r| r.name == name);
    let info = info.ok_or_else(|| unknown(name, RULES.iter().map(|r| r.name)))?;
    MeshRule::new(info, resolve(name, info.parameters, parameters)?)
}

/// What most rows leave out.
const BLANK: RuleInfo = RuleInfo {
    name: "",
    parameters: &[],
    rest: None,
    list: None,
    source: "",
    summary: "",
    over_fields: None,
    family: "",
    split: Split::Quads,
    spline: None,
    check: |_| Ok(()),
    points: Points::Averaged,
    every: None,
};

const RULES: &[RuleInfo] = &[
    RuleInfo {
        name: "butterfly",
        parameters: &[p("w", Some("1/16"), "tension")],
        source: "N. Dyn, J. Gregory, D. Levin, ACM Trans. Graphics 9 (1990)",
        summary: "interpolatory, triangles; two rings at least",
        family: "butterfly",
        split: Split::Triangles,
        points: Points::Kept { star: kept, centre: None, edge: Some(butterfly_edge), spokes: None },
        ..BLANK
    },
    RuleInfo {
        name: "butterfly-modified",
        parameters: &[p("w", Some("1/16"), "tension of the regular rule")],
        source: "D. Zorin, P. Schröder, W. Sweldens, SIGGRAPH 1996",
        summary: "interpolatory, triangles; rational for valences 3, 4, 6",
        family: "butterfly",
        split: Split::Triangles,
        points: Points::Kept { star: kept, centre: None, edge: Some(butterfly_edge), spokes: Some(zorin) },
        ..BLANK
    },
    RuleInfo {
        name: "catmull-clark",
        source: "E. Catmull, J. Clark, Computer-Aided Design 10 (1978)",
        summary: "quadrangles; every valence",
        every: Some(every_catmull_clark),
        ..CATMULL_CLARK
    },
    RuleInfo {
        name: "catmull-clark-variant",
        parameters: &[
            p("alpha", None, "weight of the vertex"),
            p("beta", None, "sum of the weights of the edge neighbours; the opposite corners have the rest"),
        ],
        rest: Some("gamma"),
        source: "A. Ball, D. Storry, ACM Trans. Graphics 7 (1988); J. Peters, U. Reif, SIAM J. Numer. Anal. 35 (1998)",
        summary: "quadrangles, other weights at the vertex; every valence",
        points: Points::Kept {
            star: catmull_clark,
            centre: Some(|v, _| Star::numbers(v.number("alpha").clone(), v.number("beta").clone(), v.rest())),
            edge: Some(bicubic_edge),
            spokes: None,
        },
        ..CATMULL_CLARK
    },
    RuleInfo {
        name: "doo-sabin",
        list: Some("weights"),
        source: "D. Doo, M. Sabin, Computer-Aided Design 10 (1978)",
        summary: "dual, around a face; rational for valences 3, 4, 6",
        over_fields: Some("local matrix with the published cosine weights around a face of every valence"),
        every: Some(every_doo_sabin),
        ..DOO_SABIN
    },
    RuleInfo {
        name: "doo-sabin-catmull-clark",
        source: "E. Catmull, J. Clark, Computer-Aided Design 10 (1978)",
        summary: "dual, means of corner, midpoints and centre; every valence",
        points: Points::Corners { wheel: |_, _| wheel((1, 2), (1, 8), &[(0, (1, 4))]), centre: None },
        every: Some(every_means),
        ..DOO_SABIN
    },
    RuleInfo {
        name: "doo-sabin-frequency",
        parameters: &[p("frequency", Some("2"), "how often the weights turn around the face")],
        source: "a counter-example: its characteristic map winds as often as the frequency says",
        summary: "dual, Doo and Sabin's weights with another frequency; rational for valences 3, 4, 6",
        check: |v| match frequency(v) {
            Some(_) => Ok(()),
            None => Err(SchemeError::value("frequency", v.number("frequency"), "a whole number from 1 to 1024")),
        },
        points: Points::Corners {
            wheel: |_, n| doo_sabin(1, n),
            // The check has seen the number.
            centre: Some(|v, n| doo_sabin(frequency(v).unwrap_or(0), n)),
        },
        ..DOO_SABIN
    },
    RuleInfo {
        name: "four-eight",
        source: "L. Velho, D. Zorin, CAGD 18 (2001)",
        summary: "quadrangles, two steps; every valence, two rings at least",
        family: "4-8",
        split: Split::TurnedQuads,
        points: Points::Kept { star: |_, _| Star::near(poly(&[(1, 2)])), centre: None, edge: None, spokes: None },
        ..BLANK
    },
    RuleInfo {
        name: "loop",
        source: "C. Loop, master's thesis, Utah (1987)",
        summary: "triangles; rational for valences 3, 4, 6",
        over_fields: Some("local matrix with the published weights at a vertex of every valence"),
        // 5/8 − (3/8 + t/8)².
        points: Points::Kept {
            star: |_, _| Star::near(poly(&[(31, 64), (-3, 32), (-1, 64)])),
            centre: None,
            edge: Some(loop_edge),
            spokes: None,
        },
        every: Some(every_loop),
        ..LOOP
    },
    RuleInfo {
        name: "loop-variant",
        parameters: &[p("beta", None, "weight of each neighbour in the vertex rule")],
        source: "C. Loop, master's thesis, Utah (1987)",
        summary: "triangles, given weight at the vertex; every valence",
        points: Points::Kept {
            star: |v, n| if n == 6 { Star::near(poly(&[(3, 8)])) } else { loop_given(v, n) },
            centre: Some(loop_given),
            edge: Some(loop_edge),
            spokes: None,
        },
        ..LOOP
    },
    RuleInfo {
        name: "loop-warren",
        source: "J. Warren, Subdivision methods for geometric design (1995)",
        summary: "triangles, weights 3/(8n); every valence",
        points: Points::Kept {
            star: |_, n| Star::near(poly(if n == 3 { &[(9, 16)] } else { &[(3, 8)] })),
            centre: None,
            edge: Some(loop_edge),
            spokes: None,
        },
        every: Some(every_warren),
        ..LOOP
    },
    RuleInfo {
        name: "midedge",
        source: "J. Peters, U. Reif, ACM Trans. Graphics 16 (1997); A. Habib, J. Warren, CAGD 16 (1999)",
        summary: "dual, around a face, two steps at once; every valence",
        spline: Some(Spline::Quadratic),
        points: Points::Corners { wheel: |_, _| wheel((1, 2), (1, 4), &[]), centre: None },
        every: Some(every_midedge),
        ..DOO_SABIN
    },
    RuleInfo {
        name: "quad-triangle",
        source: "J. Stam, C. Loop, Computer Graphics Forum 22 (2003), without the correction at extraordinary vertices",
        summary: "quadrangles and triangles: linear subdivision and averaging",
        family: "quad/triangle",
        split: Split::Averaged,
        // Only quadrangles are around a vertex where it is asked for patches.
        spline: Some(Spline::Bicubic),
        ..BLANK
    },
    RuleInfo {
        name: "sqrt3",
        summary: "triangles, two steps; rational for valences 3, 4, 6",
        over_fields: Some("local matrix of two steps with the published weights at a vertex of every valence"),
        ..SQRT3
    },
    RuleInfo {
        name: "sqrt3-variant",
        parameters: &[p("alpha", None, "weight of all neighbours together in the vertex rule")],
        summary: "triangles, two steps, given weight at the vertex; every valence",
        points: Points::Kept {
            star: kobbelt,
            centre: Some(|v, _| Star::near(Poly::constant(v.number("alpha").clone()))),
            edge: None,
            spokes: None,
        },
        ..SQRT3
    },
];

const CATMULL_CLARK: RuleInfo = RuleInfo {
    family: "Catmull–Clark",
    split: Split::Quads,
    spline: Some(Spline::Bicubic),
    points: Points::Kept { star: catmull_clark, centre: None, edge: Some(bicubic_edge), spokes: None },
    ..BLANK
};

const DOO_SABIN: RuleInfo = RuleInfo {
    family: "Doo–Sabin",
    split: Split::Corners,
    spline: Some(Spline::Biquadratic),
    points: Points::Corners { wheel: |_, n| doo_sabin(1, n), centre: None },
    ..BLANK
};

const LOOP: RuleInfo = RuleInfo { family: "Loop", split: Split::Triangles, spline: Some(Spline::Quartic), ..BLANK };

const SQRT3: RuleInfo = RuleInfo {
    source: "L. Kobbelt, SIGGRAPH 2000",
    family: "√3",
    split: Split::TurnedTriangles,
    points: Points::Kept { star: kobbelt, centre: None, edge: None, spokes: None },
    ..BLANK
};

/// Rows of rules by stencils, which have no name in the table.
const OWN: RuleInfo =
    RuleInfo { name: "own", family: "own", points: Points::Own, summary: "stencils of one's own", ..BLANK };

const OWN_ROWS: [RuleInfo; 6] = [
    OWN,
    RuleInfo { spline: Some(Spline::Bicubic), ..OWN },
    RuleInfo { split: Split::Triangles, ..OWN },
    RuleInfo { split: Split::Triangles, spline: Some(Spline::Quartic), ..OWN },
    RuleInfo { split: Split::TurnedQuads, ..OWN },
    RuleInfo { split: Split::TurnedTriangles, ..OWN },
];

/// The row of a rule by stencils.
pub(super) fn own_row(split: Split, spline: Option<Spline>) -> &'static RuleInfo {
    static ROWS: [RuleInfo; 6] = OWN_ROWS;
    ROWS.iter().find(|r| r.split == split && r.spline == spline).unwrap_or(&ROWS[0])
}

fn poly(coefficients: &[(i64, i64)]) -> Poly {
    Poly::new(coefficients.iter().map(|(p, q)| ratio(*p, *q)).collect())
}

/// An interpolatory rule: vertices stay where they are.
fn kept(_: &Values, _: usize) -> Star {
    Star::near(Poly::zero())
}

fn catmull_clark(_: &Values, n: usize) -> Star {
    let share = |p, q| ratio(p, q) / Rational::from(n as u64);
    Star::numbers(ratio(1, 1) - share(7, 4), share(3, 2), share(1, 4))
}

fn loop_given(v: &Values, n: usize) -> Star {
    Star::near(Poly::constant(v.number("beta") * Rational::from(n as u64)))
}

/// `(4 − t)/9`.
fn kobbelt(_: &Values, _: usize) -> Star {
    Star::near(poly(&[(4, 9), (-1, 9)]))
}

fn bicubic_edge(_: &Values) -> Edge {
    Edge { end: ratio(3, 8), side: ratio(1, 16), far: ratio(0, 1) }
}

fn loop_edge(_: &Values) -> Edge {
    Edge { end: ratio(3, 8), side: ratio(1, 8), far: ratio(0, 1) }
}

fn butterfly_edge(v: &Values) -> Edge {
    let w = v.number("w");
    Edge { end: ratio(1, 2), side: w * ratio(2, 1), far: -w }
}

fn wheel(own: (i64, i64), next: (i64, i64), waves: &[(usize, (i64, i64))]) -> Wheel {
    let waves = waves.iter().map(|(k, (p, q))| (*k, ratio(*p, *q))).collect();
    Wheel { own: ratio(own.0, own.1), next: ratio(next.0, next.1), waves }
}

/// `3/4` at the vertex, and around it `(1/4 + cos(2πj/n) + cos(4πj/n)/2)/n`; at valences 3 and 4, where frequencies
/// coincide, Zorin's special weights.
fn zorin(_: &Values, n: usize) -> Wheel {
    let all = [(0, (1, 4)), (1, (1, 2)), (2, (1, 4))];
    wheel((0, 1), (0, 1), &all[..if n == 3 { 2 } else { 3 }])
}

/// `δ_j/4 + (3 + 2cos(2πfj/n))/(4n)`.
fn doo_sabin(f: usize, n: usize) -> Wheel {
    let own = (f % n).min(n - f % n);
    // The frequencies f and −f may coincide.
    let both = if own == 0 || 2 * own == n { 2 } else { 1 };
    wheel((1, 4), (0, 1), &[(0, (3, 4)), (own, (both, 4))])
}

fn frequency(v: &Values) -> Option<usize> {
    usize::try_from(v.number("frequency")).ok().filter(|f| (1..=1024).contains(f))
}

/// A family whose parameter is `t` itself, up to 2.
fn plain(
    from: usize,
    low: i64,
    eigenvalue: &[(i64, i64)],
    setting: &'static str,
    claims: &[(&'static str, &[(i64, i64)])],
) -> AllValences {
    AllValences {
        from,
        twice_cosine: (poly(&[(0, 1), (1, 1)]), poly(&[(1, 1)])),
        eigenvalue: poly(eigenvalue),
        interval: (ratio(low, 1), ratio(2, 1)),
        setting,
        claims: claims.iter().map(|(claim, p)| (*claim, poly(p))).collect(),
    }
}

fn every_catmull_clark() -> AllValences {
    let claims: [(&str, &[(i64, i64)]); 3] = [
        ("λ > 1/4: with λ < 1, the blocks k ≥ 2 have smaller eigenvalues (t_k < t)", &[(-1, 4), (1, 1)]),
        ("λ > 3/8 and (7/4 − 5/6)λ > 3/16: the block 0 has smaller eigenvalues", &[(-3, 8), (1, 1)]),
        ("(7/4 − 5/6)λ > 3/16", &[(-3, 16), (11, 12)]),
    ];
    AllValences {
        from: 3,
        // 16λ² − (10 + t)λ + 1 = 0.
        twice_cosine: (poly(&[(1, 1), (-10, 1), (16, 1)]), poly(&[(0, 1), (1, 1)])),
        eigenvalue: poly(&[(0, 1), (1, 1)]),
        interval: (ratio(13, 32), ratio(131, 200)),
        setting: "parameter λ, t = (16λ² − 10λ + 1)/λ, 13/32 ≤ λ ≤ 131/200, which covers −1 ≤ t ≤ 2",
        claims: claims.into_iter().map(|(claim, p)| (claim, poly(p))).collect(),
    }
}

fn every_loop() -> AllValences {
    let claims: [(&str, &[(i64, i64)]); 2] = [
        ("λ + (3/8 − 2/8) > 0: the blocks k ≥ 2 have 3/8 + t_k/8 in (−λ, λ)", &[(1, 2), (1, 8)]),
        ("λ − λ² > 0 for t < 2, as 1 − λ ≥ 3/8: the block 0 has λ²", &[(3, 8), (1, 8)]),
    ];
    plain(3, -1, &[(3, 8), (1, 8)], "parameter t = 2cos(2π/n), λ = 3/8 + t/8, −1 ≤ t ≤ 2", &claims)
}

fn every_warren() -> AllValences {
    let claims: [(&str, &[(i64, i64)]); 2] = [
        ("λ + (3/8 − 2/8) > 0: the blocks k ≥ 2 have 3/8 + t_k/8 in (−λ, λ)", &[(1, 2), (1, 8)]),
        ("λ − 1/4 > 0: the block 0 has 5/8 − 3/8", &[(1, 8), (1, 8)]),
    ];
    plain(4, 0, &[(3, 8), (1, 8)], "parameter t = 2cos(2π/n), λ = 3/8 + t/8, 0 ≤ t ≤ 2", &claims)
}

fn every_doo_sabin() -> AllValences {
    let claims: [(&str, &[(i64, i64)]); 1] = [("λ − 1/4 > 0: the blocks k ≥ 2 have 1/4", &[(1, 4)])];
    plain(3, -1, &[(1, 2)], "parameter t = 2cos(2π/n), λ = 1/2, −1 ≤ t ≤ 2", &claims)
}

fn every_means() -> AllValences {
    let claims: [(&str, &[(i64, i64)]); 1] =
        [("λ + (1/2 − 2/8) > 0: the blocks k ≥ 2 have 1/2 + t_k/8 in (−λ, λ)", &[(3, 4), (1, 8)])];
    plain(3, -1, &[(1, 2), (1, 8)], "parameter t = 2cos(2π/n), λ = 1/2 + t/8, −1 ≤ t ≤ 2", &claims)
}

fn every_midedge() -> AllValences {
    let claims: [(&str, &[(i64, i64)]); 1] =
        [("λ + (1/2 − 2/4) > 0: the blocks k ≥ 2 have 1/2 + t_k/4 in (−λ, λ)", &[(1, 2), (1, 4)])];
    plain(4, 0, &[(1, 2), (1, 4)], "parameter t = 2cos(2π/n), λ = 1/2 + t/4, 0 ≤ t ≤ 2", &claims)
}
