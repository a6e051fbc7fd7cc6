//! Certificates of a scheme at the vertices of a mesh.

use super::confirm::{accepted, same_verdict};
use super::{Certificate, Doubt, Unsupported, number, unsupported};
use crate::algebraic::sqrt_down;
use crate::arith::{Rational, abs};
use crate::case::{Valences, VertexCase};
use crate::scheme::{MeshRule, Sector, sector_stencils};
use crate::theorem::Verdict;
use crate::vertex::field::{Enclosures, Field};
use crate::vertex::regular::Regular;
use crate::vertex::top::Top;
use crate::vertex::{Again, AtValence, Eigenvector, Ground};
use malachite_base::num::arithmetic::traits::Floor;
use secant_check::Claim;
use serde_json::{Value, json};

/// Binary places of eigenvectors and of roots of unity in a certificate.
const PLACES: u64 = 96;
/// Binary places of half-planes.
const SHORT: u64 = 24;
/// Binary places of the bound of the other eigenvalues, which was proposed in floating point: few enough for the same certificate
/// everywhere, and more than [`apart`] asks for.
const BOUND: u64 = 40;

/// So many steps together shrink second differences that have factors in the mask (Lemma 4′): enough, and cheap.
const FACTOR_STEPS: usize = 6;

/// Differences shrink slowly in these steps where they keep more than this part.
const SLOW: (i64, i64) = (9, 20);

/// So many words of steps the checker looks at.
const MAX_WORDS: usize = 1000;

/// The size of an operator on all sectors of which the checker computes the characteristic polynomial.
const MAX_EXACT: usize = 48;

/// A complex number.
type Complex = (Rational, Rational);

fn times(a: &Complex, b: &Complex) -> Complex {
    (&a.0 * &b.0 - &a.1 * &b.1, &a.0 * &b.1 + &a.1 * &b.0)
}

fn conjugate(a: &Complex) -> Complex {
    (a.0.clone(), -&a.1)
}

fn square(a: &Complex) -> Rational {
    &a.0 * &a.0 + &a.1 * &a.1
}

fn scaled(a: &Complex, factor: &Rational) -> Complex {
    (&a.0 * factor, &a.1 * factor)
}

fn rounded(x: &Rational, places: u64) -> Value {
    number(&(Rational::from((x << places).floor()) >> places))
}

fn written(a: &Complex, places: u64) -> Value {
    json!([rounded(&a.0, places), rounded(&a.1, places)])
}

/// `e^(2πik/n)`, nearly, for `0 ≤ k ≤ n/2`.
fn unity(k: usize, n: usize) -> Complex {
    let field = Enclosures::of_angle(k, n, 2 * PLACES);
    let cosine = field.to_interval(&field.twice_cosine()).mid() >> 1;
    let sine = sqrt_down(&(Rational::from(1) - &cosine * &cosine), 2 * PLACES);
    (cosine, sine)
}

/// The values on the first rings, in the order of the format.
fn all_values(rule: &MeshRule, vector: &Eigenvector, n: usize) -> Result<Vec<Complex>, Unsupported> {
    // Splines have two rings in the format.
    let rings = if by_stencils(rule) { vector.rings } else { 2 };
    let inside = |&(i, j): &(usize, usize)| match (rule.dual(), rule.sector()) {
        (true, _) => i < rings && j < rings,
        (false, Sector::Quads) => i > 0,
        (false, Sector::Triangles) => i > 0 && i + j <= rings,
    };
    let turn = unity(vector.frequency, n);
    let value = |(x, y): &Complex| (x + y * &turn.0, y * &turn.1);
    let places = (0..=rings).flat_map(|i| (0..=rings).map(move |j| (i, j))).filter(inside);
    let known = places.map(|place| match vector.points.iter().find(|(p, _)| *p == place) {
        Some((_, v)) => Ok(value(v)),
        None => unsupported(format!("an eigenvector without a value at {place:?}"), valence(n)),
    });
    known.collect()
}

/// The same without the constant part in block 0.
fn values(rule: &MeshRule, vector: &Eigenvector, n: usize) -> Result<Vec<Complex>, Unsupported> {
    let mut all = all_values(rule, vector, n)?;
    if vector.frequency == 0 {
        // ω = 1 there.
        let centre = (&vector.centre.0 + &vector.centre.1, Rational::from(0));
        let own = if rule.dual() { all.remove(0) } else { centre };
        all.iter_mut().for_each(|v| *v = (&v.0 - &own.0, &v.1 - &own.1));
    }
    Ok(all)
}

fn valence(n: usize) -> String {
    format!("valence {n}")
}

/// Whether the leading eigenvalue is so far from all others that the checker sees it in some forty squarings.
fn apart(top: &Top) -> bool {
    let size = abs(&top.enclosure.lo).min(abs(&top.enclosure.hi));
    (&size - &top.others) << 24 > size
}

fn named(ground: Ground, n: usize) -> Result<&'static str, Unsupported> {
    Ok(match ground {
        Ground::Regular => "theorem-7",
        Ground::Winding(_) => "theorem-8-winding",
        Ground::Fold => "theorem-8-fold",
        Ground::Line => "theorem-2",
        Ground::Path => "theorem-8-path",
        Ground::Span => "theorem-8-span",
        Ground::Sectors | Ground::NoLimit => return unsupported("this evidence", valence(n)),
    })
}

/// The half-plane of a sector, for the vector divided by one of its entries.
fn half_plane(found: &AtValence, vector: &Eigenvector, divisor: &Complex) -> Option<Value> {
    let (a, b) = found.half_plane.as_ref()?;
    // a x + b y = Re(conj(h) (x + yω)).
    let turn = unity(vector.frequency, found.valence);
    let h = times(&(a.clone(), (b - a * &turn.0) / &turn.1), &conjugate(divisor));
    let size = square(&h);
    let unit = Rational::from(1) / sqrt_down(&size, SHORT).max(Rational::from(1) >> SHORT);
    Some(written(&scaled(&h, &unit), SHORT))
}

/// Whether the checker has the operator on all sectors exactly, and it is not too large for a characteristic polynomial.
fn has_exact_operator(rule: &MeshRule, n: usize) -> bool {
    let butterfly = rule.info().name == "butterfly";
    let known = if by_stencils(rule) { butterfly } else { true };
    let stencils = sector_stencils(rule, n, if butterfly { 3 } else { 2 });
    known && stencils.is_ok_and(|s| n * s.places.len() < MAX_EXACT)
}

/// The evidence where the leading eigenvalue is in several blocks, or has Jordan blocks: it is rational, and all weights are.
fn tied(rule: &MeshRule, found: &AtValence, top: &Top, ground: Ground) -> Result<Value, Unsupported> {
    let n = found.valence;
    let alone = top.members.iter().all(|m| !m.negative);
    let Some(value) = top.rational.as_ref().filter(|_| alone && has_exact_operator(rule, n)) else {
        let what = "irrational leading eigenvalues or weights, where several blocks or Jordan blocks have them";
        return unsupported(what, valence(n));
    };
    // No simple number, at which the recursion of Schur and Cohn may stop: 1/4 between 1/8 and 3/8.
    let bound = (&top.others * Rational::from(4) + abs(value) * Rational::from(3)) / Rational::from(7);
    let (mut unit, mut plane) = (None, None);
    if ground != Ground::Span {
        let Some(vector) = &found.eigenvector else {
            return unsupported("a verdict that does not rest on one leading eigenvector", valence(n));
        };
        let values = all_values(rule, vector, n)?;
        let Some((index, largest)) = values.iter().enumerate().max_by_key(|(_, v)| square(v)) else {
            return unsupported("an eigenvector without values", valence(n));
        };
        (unit, plane) = (Some(index), half_plane(found, vector, largest));
    }
    Ok(json!({
        "valence": n,
        "rule": named(ground, n)?,
        "turn": written(&unity(1, n), PLACES),
        "value": number(value),
        "others": rounded(&bound, BOUND),
        "unit": unit,
        "half_plane": plane,
    }))
}

/// The evidence for one valence.
pub(super) fn evidence(rule: &MeshRule, found: &AtValence) -> Result<Value, Unsupported> {
    let n = found.valence;
    if found.border.is_some() {
        return unsupported("a vertex on the border", format!("{n} faces"));
    }
    if n < 3 {
        return unsupported("a valence below 3", valence(n));
    }
    if rule.own().is_some() && rule.steps() > 1 {
        return unsupported("stencils of one's own for two steps that turn the mesh", valence(n));
    }
    let (Some(top), Some(ground)) = (&found.top, found.ground) else {
        return unsupported("a verdict that does not rest on leading eigenvectors", valence(n));
    };
    if !apart(top) {
        return unsupported("eigenvalues this close", valence(n));
    }
    if !matches!(top.members.as_slice(), [only] if only.blocks == [1]) {
        return tied(rule, found, top, ground);
    }
    let name = named(ground, n)?;
    let Some(vector) = &found.eigenvector else {
        return unsupported("a verdict that does not rest on one leading eigenvector", valence(n));
    };
    let values = values(rule, vector, n)?;
    let Some(largest) = values.iter().max_by_key(|v| square(v)).filter(|v| square(v) > 0) else {
        return unsupported("an eigenvector that is 0", valence(n));
    };
    let inverse = scaled(&conjugate(largest), &(Rational::from(1) / square(largest)));
    let half_plane = half_plane(found, vector, largest);
    let mut evidence = json!({
        "valence": n,
        "rule": name,
        "frequency": vector.frequency,
        "turn": written(&unity(1, n), PLACES),
        "others": rounded(&top.others, BOUND),
    });
    if by_stencils(rule) {
        evidence["rings"] = json!(vector.rings);
    }
    evidence["vector"] = values.iter().map(|v| written(&times(v, &inverse), PLACES)).collect();
    evidence["half_plane"] = json!(half_plane);
    Ok(evidence)
}

/// Whether the checker looks at the rule by its stencils, without patches.
fn by_stencils(rule: &MeshRule) -> bool {
    rule.info().spline.is_none() || rule.own().is_some()
}

/// How second differences are seen to shrink where the checker does without patches; it computes itself how much.
fn limits(case: &VertexCase) -> Result<Option<Value>, Unsupported> {
    if !by_stencils(&case.rule) {
        return Ok(None);
    }
    let Some(regular) = Regular::of(&case.rule) else {
        return unsupported("a regular rule without bounds of its limits", case.name.clone());
    };
    let length = regular.shrinks.length;
    let words = (0..length).try_fold(1_usize, |all, _| all.checked_mul(regular.parts.len()));
    // The bounds of the checker are somewhat wider: where differences shrink slowly they may not do.
    if &regular.shrinks.to * Rational::from(SLOW.1) > SLOW.0 {
        return unsupported("second differences that shrink this slowly", case.name.clone());
    }
    Ok(Some(if regular.shrinks.by_factors {
        json!({ "by": "factors", "steps": FACTOR_STEPS, "changes": FACTOR_STEPS / 2 })
    } else if regular.shrinks_along_axes(&case.rule) {
        json!({ "by": "axes", "steps": FACTOR_STEPS, "changes": FACTOR_STEPS / 2 })
    } else if words.is_some_and(|all| all <= MAX_WORDS) {
        json!({ "by": "words", "steps": length, "changes": length })
    } else {
        return unsupported("second differences that shrink this slowly", case.name.clone());
    }))
}

/// A certificate, the valences that it is about, and its verdict.
struct Covered {
    certificate: Certificate,
    listed: Vec<usize>,
    verdict: Verdict,
}

fn covered(case: &VertexCase, found: &[AtValence]) -> Result<Covered, Unsupported> {
    if !case.declared {
        return unsupported("vertices without a [vertex] table", case.name.clone());
    }
    let (mut claims, mut valences, mut left_out) = (Vec::new(), Vec::new(), Vec::new());
    for f in found {
        let decided = f.smooth != Verdict::Undetermined || f.plane != Verdict::Undetermined;
        match evidence(&case.rule, f) {
            Ok(evidence) => {
                claims.push((f.valence, f.smooth));
                valences.push(evidence);
            }
            Err(why) if decided => left_out.push(why),
            Err(_) => {}
        }
    }
    if claims.is_empty() {
        return match left_out.into_iter().next() {
            Some(why) => Err(why),
            None => unsupported("vertices at which nothing is decided", case.name.clone()),
        };
    }
    let verdict = together(case, &claims);
    let proof = match limits(case)? {
        Some(limits) => json!({ "limits": limits, "valences": valences }),
        None => json!({ "valences": valences }),
    };
    let certificate = Certificate::new("vertex", &case.name, verdict.word(), proof);
    let certificate = certificate.without(left_out);
    Ok(Covered { certificate, listed: claims.into_iter().map(|(n, _)| n).collect(), verdict })
}

/// The certificate of the valences for which the format has a rule; the others are left out. `found` is in ascending order.
///
/// # Errors
/// [`Unsupported`] where there is none of them.
pub fn vertex_certificate(case: &VertexCase, found: &[AtValence]) -> Result<Certificate, Unsupported> {
    covered(case, found).map(|c| c.certificate)
}

/// Has the verdicts at the valences for which the format has a rule checked by `secant-check`, and marks them as checked. `found` is
/// in ascending order.
///
/// # Errors
/// [`Doubt::Unsupported`] where the format has a rule for none of them; the other doubts where the checker does not accept the
/// certificate, or comes to other verdicts.
///
/// # Cost
/// That of [`secant_check::check`].
pub fn confirm_vertices(case: &VertexCase, found: &mut [AtValence]) -> Result<Certificate, Doubt> {
    found.iter_mut().for_each(|f| f.again = Again::NoRule);
    let Covered { certificate, listed, verdict } = covered(case, found)?;
    let accepted = accepted(&case.text.text, &certificate)?;
    // Both claims about each valence that the certificate lists, in its order, and nothing else.
    let mut claims = accepted.claims.iter();
    let mut said = |claim: Claim, verdict: Verdict| {
        claims.next().is_some_and(|d| d.claim == claim && same_verdict(verdict, d.verdict))
    };
    for f in found.iter_mut().filter(|f| listed.contains(&f.valence)) {
        let smooth = said(Claim::SmoothAtVertex(f.valence), f.smooth);
        if !(said(Claim::PlaneAtVertex(f.valence), f.plane) && smooth) {
            return Err(Doubt::Differs(accepted.verdict.word()));
        }
        f.again = Again::Proved;
    }
    if claims.next().is_some() || !same_verdict(verdict, accepted.verdict) {
        return Err(Doubt::Differs(accepted.verdict.word()));
    }
    Ok(certificate)
}

/// The verdict of the certificate: about the valences that the case names, or about all where it names none.
fn together(case: &VertexCase, claims: &[(usize, Verdict)]) -> Verdict {
    let (all, counts): (bool, &dyn Fn(usize) -> bool) = match &case.valences {
        Some(Valences::List(list)) => (list.iter().all(|n| claims.iter().any(|c| c.0 == *n)), &|n| list.contains(&n)),
        Some(Valences::All) => (false, &|_| true),
        None => (true, &|_| true),
    };
    let counted: Vec<Verdict> = claims.iter().filter(|c| counts(c.0)).map(|c| c.1).collect();
    let missing = usize::from(!all);
    Verdict::all(counted.len() + missing, counted)
}
