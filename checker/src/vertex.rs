//! Certificates of the kind `vertex`: a subdivision scheme at an extraordinary vertex of a mesh (docs/theory.md §10.1, Theorems 2, 7
//! and 8), with polynomial patches or with enclosures of its limit (Lemma 4).

use crate::base::{Accepted, Checked, Node, Q, Verdict, file, need, reject, together};
use crate::claim::Claim;
pub mod ball;
mod case;
mod cells;
mod exact;
mod factors;
mod formula;
mod limit;
pub mod mesh;
mod own;
pub mod patch;
mod ring;
mod rule;

use ball::{Ball, Balls, deflated, dominated, dot, leading};
pub use case::Case;
use case::Scheme;
use exact::Operator;
use limit::Regular;
use mesh::{MAX_VALENCE, Mesh, Net, powers};
use num_traits::{One, Signed};
use ring::Ring;

/// The keys of a case about vertices.
pub const KEYS: &str = "name title source vertex expect";
/// Rings on which a block may live.
const MAX_RINGS: usize = 8;

/// A scheme at one valence with its leading eigenvector.
pub struct Leading {
    /// The scheme.
    pub mesh: Mesh,
    /// The eigenvalue.
    pub value: Ball,
    /// The eigenvector.
    pub net: Net,
}

/// Checks the proof of a certificate of the kind `vertex`.
pub fn check(source: &str, proof: &Node<'_>) -> Checked<Accepted> {
    let case = file(source, KEYS, Case::read)?;
    let (valences, regular) = match &case.scheme {
        Scheme::Spline(..) => {
            let [valences] = proof.fields("valences")?;
            (valences, None)
        }
        Scheme::Rule(rule) => {
            let [limits, valences] = proof.fields("limits valences")?;
            (valences, Some(limits.at(Regular::new(&rule.lattice(), &limits))?))
        }
    };
    let (mut listed, mut claims, mut counted) = (Vec::new(), Vec::new(), Vec::new());
    for item in valences.list()? {
        let (n, smooth, plane) = item.at(case.valence(&item, regular.as_ref()))?;
        item.need(listed.last().is_none_or(|m| *m < n), "vertex", "valences ascend")?;
        listed.push(n);
        claims.extend([Claim::SmoothAtVertex(n).is(smooth), Claim::PlaneAtVertex(n).is(plane)]);
        // Only valences that the case names count; one that names none leaves the choice to the certificate.
        if case.asked.as_ref().is_none_or(|asked| asked.is_empty() || asked.contains(&n)) {
            counted.push(smooth);
        }
    }
    valences.need(!listed.is_empty(), "vertex", "no valence is listed")?;
    let all = case.asked.is_some_and(|asked| asked.iter().all(|n| listed.contains(n)));
    // Where none of the listed valences counts nothing is proved.
    let verdict = match together(counted) {
        Verdict::Proved if !all => Verdict::Undetermined,
        found => found,
    };
    Ok(Accepted { case: case.name, verdict, claims, points: Vec::new() })
}

impl Case {
    /// What follows at one valence: C¹, and a tangent plane.
    fn valence(&self, node: &Node<'_>, regular: Option<&Regular>) -> Checked<(usize, Verdict, Verdict)> {
        if node.get("value").is_some() {
            return self.exact(node, regular);
        }
        self.simple(node, regular).map(|(leading, smooth, plane)| (leading.mesh.valence(), smooth, plane))
    }

    /// The leading eigenvector of a spline at a valence at which the certificate proves the surface C¹ by Theorem 7.
    pub fn smooth(&self, node: &Node<'_>) -> Checked<Leading> {
        let (leading, smooth, _) = self.simple(node, None)?;
        let holds = smooth == Verdict::Proved && leading.net.frequency == 1;
        node.need(holds, "theorem-7", "the scheme is not proved C¹ at this valence")?;
        Ok(leading)
    }

    /// The leading eigenvalue, which is simple and alone, and what follows.
    fn simple(&self, node: &Node<'_>, regular: Option<&Regular>) -> Checked<(Leading, Verdict, Verdict)> {
        let [valence, rule, frequency, turn, others, rings, vector, half_plane] = match regular {
            Some(_) => node.fields("valence rule frequency turn others rings vector half_plane")?,
            None => {
                let [n, rule, k, turn, others, vector, half_plane] =
                    node.fields("valence rule frequency turn others vector half_plane")?;
                // Splines have two rings, which the format does not say.
                [n, rule, k, turn, others, node.clone(), vector, half_plane]
            }
        };
        let (n, k, radius) = (valence.index(MAX_VALENCE + 1)?, frequency.index(MAX_VALENCE)?, others.rational()?);
        node.need(n >= 3 && 2 * k <= n && radius.is_positive(), "vertex", "no such vertex, block or bound")?;
        let (mesh, last) = self.mesh(regular, powers(n, &pair(&turn)?)?)?;
        let near = vector.list()?.iter().map(pair).collect::<Checked<Vec<_>>>()?;
        let rings = if regular.is_some() { rings.index(MAX_RINGS + 1)? as i64 } else { 2 };
        let (value, net) = top(&mesh, k, &near, &radius, [rings, last])?;
        let ring = self.ring(regular, &mesh, &net)?;
        let (smooth, plane) = judged(&ring, &rule, &half_plane, [n, k, 1])?;
        Ok((Leading { mesh, value, net }, smooth, plane))
    }

    /// The same with rational weights and a rational leading eigenvalue, which may be one of several blocks or have Jordan blocks.
    fn exact(&self, node: &Node<'_>, regular: Option<&Regular>) -> Checked<(usize, Verdict, Verdict)> {
        let [valence, rule, turn, value, others, unit, half_plane] =
            node.fields("valence rule turn value others unit half_plane")?;
        let (n, value) = (valence.index(MAX_VALENCE + 1)?, value.rational()?);
        node.need(n >= 3, "vertex", "no such vertex")?;
        let (mesh, last) = self.mesh(regular, powers(n, &pair(&turn)?)?)?;
        let operator = Operator::new(&self.scheme, &mesh)?;
        let leading = operator.leading(&value, &others.rational()?)?;
        if rule.text()? == "theorem-8-span" {
            let holds = leading.count() >= 3 && unit.is_null() && half_plane.is_null();
            rule.need(holds, "theorem-8-span", "a premise of this rule does not hold")?;
            return Ok((n, Verdict::Refuted, Verdict::Refuted));
        }
        let mut net = operator.net(&mesh, &leading)?;
        let k = net.frequency;
        if !unit.is_null() {
            let places = mesh.places(operator.rings);
            let scale = mesh.at(&net, Some((places[unit.index(places.len())?], 0)))?.inverse()?;
            net.values.values_mut().for_each(|value| *value = value.times(&scale));
            net.centre = net.centre.times(&scale);
        }
        let net = mesh.continued(&Ball::real(&value), net, last.max(operator.rings))?;
        let ring = self.ring(regular, &mesh, &net)?;
        let (smooth, plane) = judged(&ring, &rule, &half_plane, [n, k, leading.length])?;
        Ok((n, smooth, plane))
    }

    /// The scheme at one valence, and the rings that the ring of patches or cells needs.
    fn mesh(&self, regular: Option<&Regular>, powers: Vec<Ball>) -> Checked<(Mesh, i64)> {
        match (&self.scheme, regular) {
            (Scheme::Spline(spline, centre), _) => Ok((Mesh::new(*spline, centre(powers.len()), powers)?, 3)),
            (Scheme::Rule(rule), Some(regular)) => {
                let stencils = rule.stencils(&powers)?;
                let last = regular.rings(&stencils.special.keys().copied().collect())?;
                Ok((Mesh::of_stencils(stencils, powers), last))
            }
            (Scheme::Rule(_), None) => reject("limits", "a rule by stencils without bounds of its limits"),
        }
    }

    fn ring<'a>(&self, regular: Option<&'a Regular>, mesh: &Mesh, net: &Net) -> Checked<Ring<'a>> {
        match (&self.scheme, regular) {
            (Scheme::Spline(spline, _), _) => Ring::of_patches(*spline, mesh, net),
            (Scheme::Rule(_), Some(regular)) => Ring::of_cells(regular, mesh, net),
            (Scheme::Rule(_), None) => reject("limits", "a rule by stencils without bounds of its limits"),
        }
    }
}

fn pair(node: &Node<'_>) -> Checked<(Q, Q)> {
    node.vector(2).map(|mut v| (v.remove(0), v.remove(0)))
}

/// What a rule says of the ring of the function in block `k` that ends chains of a length: C¹, and a tangent plane.
fn judged(
    ring: &Ring<'_>,
    rule: &Node<'_>,
    half_plane: &Node<'_>,
    [n, k, length]: [usize; 3],
) -> Checked<(Verdict, Verdict)> {
    let held = if half_plane.is_null() {
        false
    } else {
        let inside = ring.lies_in(&pair(half_plane)?)? && 0 < k && 2 * k < n;
        half_plane.need(inside, "half-plane", "the ring of a sector does not lie in it")?;
        true
    };
    let holds = match rule.text()? {
        "theorem-7" => k == 1 && held && ring.is_regular()?,
        "theorem-8-winding" => 2 <= k && 2 * k < n && (held || length == 1),
        "theorem-8-fold" => 0 < k && 2 * k < n && ring.folds()?,
        "theorem-2" => k == 0 && ring.is_one_sided(false)?,
        "theorem-8-path" => k == 0 && ring.is_one_sided(true)?,
        _ => return rule.reject("format", "unknown rule for a vertex"),
    };
    rule.need(holds, rule.text()?, "a premise of this rule does not hold")?;
    Ok(match rule.text()? {
        "theorem-7" => (Verdict::Proved, Verdict::Proved),
        "theorem-2" => (Verdict::Refuted, Verdict::Refuted),
        _ if held => (Verdict::Refuted, Verdict::Proved),
        _ => (Verdict::Refuted, Verdict::Undetermined),
    })
}

/// Proves that the block `k` has exactly one eigenvalue of modulus `radius` or more but the 1 of block 0, that it is simple and smaller
/// than 1, and that the other blocks have none; all on the first rings. It returns the eigenvector on as many rings as are asked for.
fn top(mesh: &Mesh, k: usize, near: &[(Q, Q)], radius: &Q, [rings, last]: [i64; 2]) -> Checked<(Ball, Net)> {
    let mut found = None;
    for other in 0..=mesh.valence() / 2 {
        let block = mesh.block(other, rings)?;
        let ones = vec![Ball::real(&Q::one()); block.len()];
        // The weights add up to 1: on the quotient by the constant net the eigenvalue 1 is gone.
        let rest: Balls = if other == 0 { deflated(&block, &ones, 0) } else { block.clone() };
        if other != k {
            dominated(&rest, radius)?;
            continue;
        }
        need(near.len() == rest.len(), "vertex", "the vector has one entry for each point of the first rings")?;
        let (value, mut vector) = leading(&rest, near, radius)?;
        need(value.at_most() < Q::one(), "vertex", "the eigenvalue is not smaller than 1")?;
        if k == 0 {
            // u on the quotient has B u = λ u + d; the eigenvector is u + d/(λ − 1).
            let d = dot(&block[0][1..], &vector);
            let shift = d.times(&value.minus(&ones[0]).inverse()?);
            vector = std::iter::once(shift.clone()).chain(vector.iter().map(|u| u.plus(&shift))).collect();
        }
        found = Some((value, vector));
    }
    let Some((value, mut vector)) = found else { return reject("vertex", "no such block") };
    let places = mesh.places(rings);
    let centre = if vector.len() > places.len() { vector.remove(0) } else { Ball::zero() };
    let values = places.into_iter().zip(vector).collect();
    let net = mesh.continued(&value, Net { frequency: k, centre, values }, last.max(rings))?;
    Ok((value, net))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Json, whole};
    use mesh::{Centre, Place, Spline};
    use patch::{Patch, boundary, patches};
    use ring::one_sign;

    /// The first half of a curve in Bernstein form.
    fn half(curve: &[Ball]) -> Vec<Ball> {
        let (mut left, mut rest, part) = (Vec::new(), curve.to_vec(), Ball::real(&(Q::one() / whole(2))));
        while let Some(first) = rest.first() {
            left.push(first.clone());
            rest = rest.windows(2).map(|w| w[0].plus(&w[1]).times(&part)).collect();
        }
        left
    }

    /// `Ψ(x/2) = λ Ψ(x)`: the first half of the inner boundary of the ring is the first piece of the outer one, made smaller. This
    /// ties masks and patches together.
    #[test]
    fn the_inner_boundary_is_the_outer_one_made_smaller() {
        let inner: [(&str, fn(&[Patch]) -> Vec<Ball>); 4] = [
            ("catmull-clark", |p| p[0].rows().iter().map(|row| row[0].clone()).collect()),
            ("frequency", |p| p[0].rows().iter().map(|row| row[0].clone()).collect()),
            // The triangle from (1, 1) has (0, 1) as its second corner and (1, 0) as its third one.
            ("loop", |p| p[1].rows().iter().rev().map(|row| row[row.len() - 1].clone()).collect()),
            // The left quarter of the first cell, from its corner (1, 1) to (1, 0).
            ("midedge", |p| p[3].rows()[0].iter().rev().cloned().collect()),
        ];
        for (name, edge) in inner {
            let read = |end: &str| {
                let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs/pass");
                std::fs::read_to_string(root.join(format!("vertex-{name}.{end}"))).unwrap()
            };
            let tree: Json = serde_json::from_str(&read("json")).unwrap();
            let place = String::new();
            let proof = Node { value: &tree, place }.field("proof").unwrap();
            let item = proof.field("valences").unwrap().list().unwrap().pop().unwrap();
            let case = file(&read("toml"), "name vertex", Case::read).unwrap();
            let pair = |n: &Node<'_>| (n.vector(2).unwrap().remove(0), n.vector(2).unwrap().remove(1));
            let n = item.field("valence").unwrap().index(100).unwrap();
            let k = item.field("frequency").unwrap().index(100).unwrap();
            let turn = pair(&item.field("turn").unwrap());
            let Scheme::Spline(spline, centre) = &case.scheme else { panic!("{name} is a spline") };
            let mesh = Mesh::new(*spline, centre(n), powers(n, &turn).unwrap()).unwrap();
            let near: Vec<_> = item.field("vector").unwrap().list().unwrap().iter().map(pair).collect();
            let radius = item.field("others").unwrap().rational().unwrap();
            let block = mesh.block(k, 2).unwrap();
            let (value, _) = leading(&block, &near, &radius).unwrap();
            let (_, net) = top(&mesh, k, &near, &radius, [2, 3]).unwrap();
            let ring = patches(*spline, &mesh, &net).unwrap();
            let small = Q::one() / num_traits::pow(whole(2), 60);
            let (small_edge, outer) = (half(&edge(&ring)), boundary(*spline, &ring));
            for (a, b) in small_edge.iter().zip(&outer) {
                assert!(a.minus(&b.times(&value)).at_most() < small, "{name}");
            }
            assert!(small_edge.iter().all(|a| a.at_least() > small), "{name}");
        }
    }

    /// At a regular vertex the leading eigenvector is the lattice itself.
    #[test]
    fn regular_vertices_give_the_lattice() {
        for (spline, centre, n) in [
            (Spline::Bicubic, Centre::Vertex([9, 6, 1].map(|w| whole(w) / whole(16))), 4),
            (Spline::Quartic, Centre::Loop, 6),
            (Spline::Biquadratic, Centre::Frequency(1), 4),
        ] {
            let sixth =
                (whole(1) / whole(2), "866025403784438646763723170752936183/1000000000000000000000000000000000000");
            let parsed = crate::number::canonical(sixth.1).unwrap();
            let turn = if n == 4 { (whole(0), whole(1)) } else { (sixth.0, parsed) };
            let mesh = Mesh::new(spline, centre, powers(n, &turn).unwrap()).unwrap();
            let own = if spline == Spline::Biquadratic { whole(1) / whole(2) } else { whole(0) };
            let point = |(i, j): Place| {
                let (a, b) = (whole(i) + &own, whole(j) + &own);
                (&a + &b * &turn.0, b * &turn.1)
            };
            let places = mesh.places(2);
            let first = point(places[0]);
            // Divided by the first point, so that this is 1.
            let size = &first.0 * &first.0 + &first.1 * &first.1;
            let near = |p: &Place| {
                let (x, y) = point(*p);
                ((&x * &first.0 + &y * &first.1) / &size, (&y * &first.0 - &x * &first.1) / &size)
            };
            let near: Vec<_> = places.iter().map(near).collect();
            let (_, net) = top(&mesh, 1, &near, &(whole(3) / whole(10)), [2, 3]).unwrap();
            let ring = patches(spline, &mesh, &net).unwrap();
            assert!(one_sign(ring.iter().flat_map(Patch::jacobian).map(|c| c.0.imaginary_sign())), "{spline:?}");
            // The outer boundary begins at distance 2 on the first spoke.
            let scale = Ball::new(&first.0, &first.1);
            let corner = boundary(spline, &ring)[0].times(&scale).minus(&Ball::real(&whole(2)));
            assert!(corner.at_most() < Q::one() / num_traits::pow(whole(2), 60), "{spline:?}");
        }
    }
}
