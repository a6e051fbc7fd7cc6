//! Certificates of the kind `vertex`: a subdivision scheme at an extraordinary vertex of a mesh, for schemes that are splines away
//! from it (docs/theory.md §10.1, Theorems 2, 7 and 8).

use crate::base::{Accepted, Checked, Json, Node, Q, Verdict, file, index, need, number, reject, spend, together};
use crate::claim::Claim;
use std::collections::BTreeSet;
mod ball;
mod mesh;
mod patch;

use ball::{Ball, Balls, deflated, dominated, dot, leading};
use mesh::{Centre, MAX_VALENCE, Mesh, Net, Spline, powers};
use num_traits::{One, Signed, ToPrimitive};
use patch::{Patch, boundary, patches};

/// Largest frequency of the weights in a face.
const MAX_FREQUENCY: usize = 1024;

/// The keys of a case about vertices.
pub const KEYS: &str = "name title source vertex expect";

/// A case about the vertices of a mesh.
pub struct Case {
    /// The name.
    pub name: String,
    spline: Spline,
    /// The weights at the centre, by valence.
    centre: Box<dyn Fn(usize) -> Centre>,
    /// The valences of the case, which may name none; `None` where it asks for all that there are.
    pub asked: Option<BTreeSet<usize>>,
}

/// Checks the proof of a certificate of the kind `vertex`.
pub fn check(source: &str, proof: &Node<'_>) -> Checked<Accepted> {
    let case = file(source, KEYS, Case::read)?;
    let [valences] = proof.fields("valences")?;
    let (mut listed, mut claims, mut counted) = (Vec::new(), Vec::new(), Vec::new());
    for item in valences.list()? {
        let (n, smooth, plane) = item.at(case.valence(&item))?;
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

/// `5`, `"3..32"`, `"3,5,8..10"` or `"all"`.
fn read_valences(node: &Node<'_>) -> Checked<Option<BTreeSet<usize>>> {
    let valence = |n: &usize| (2..=MAX_VALENCE).contains(n);
    let Json::Text(text) = node.value else {
        let n = index(node, MAX_VALENCE + 1)?;
        node.need(valence(&n), "format", format_args!("a valence is a number from 2 to {MAX_VALENCE}"))?;
        return Ok(Some(BTreeSet::from([n])));
    };
    if text.trim() == "all" {
        return Ok(None);
    }
    let mut all = BTreeSet::new();
    for part in text.split(',') {
        let (low, high) = match part.split_once("..") {
            Some((low, high)) => (low, high.trim_start_matches('=')),
            None => (part, part),
        };
        let bound = |s: &str| s.trim().parse().ok().filter(valence);
        match (bound(low), bound(high)) {
            (Some(low), Some(high)) if low <= high => {
                // A long list of long ranges is no more than all valences.
                spend(high - low + 1, 0)?;
                all.extend(low..=high);
            }
            _ => return node.reject("format", "valences are numbers and ranges"),
        }
    }
    Ok(Some(all))
}

fn ratio(p: usize, q: usize) -> Q {
    Q::new(p.into(), q.into())
}

/// The weights at a central vertex: of all edge neighbours together, and of all opposite corners; it has what is left itself.
fn vertex(edges: Q, corners: Q) -> Centre {
    Centre::Vertex([Q::one() - &edges - &corners, edges, corners])
}

/// The weights in a central face of `n` corners: what all have, and what the own one and its two neighbours have beside.
fn face(n: usize, all: Q, own: Q, near: Q) -> Centre {
    let weight = |j: usize| match j {
        0 => &all + &own,
        _ if j == 1 || j + 1 == n => &all + &near,
        _ => all.clone(),
    };
    Centre::Face((0..n).map(weight).collect())
}

impl Case {
    /// Reads a case.
    pub fn read(root: &Node<'_>) -> Checked<Self> {
        let name = root.field("name")?.text()?.to_owned();
        let table = root.field("vertex")?;
        let (mesh, parameter) = (table.field("mesh")?.text()?, |key: &str| number(&table.field(key)?));
        let (spline, centre, keys): (_, Box<dyn Fn(usize) -> Centre>, _) = match mesh {
            "catmull-clark" => (Spline::Bicubic, Box::new(|n| vertex(ratio(3, 2 * n), ratio(1, 4 * n))), ""),
            "quad-triangle" => (Spline::Bicubic, Box::new(|_| vertex(ratio(3, 8), ratio(1, 16))), ""),
            "catmull-clark-variant" => {
                let (alpha, beta) = (parameter("alpha")?, parameter("beta")?);
                let gamma = Q::one() - alpha - &beta;
                if table.get("gamma").is_some() {
                    table.need(parameter("gamma")? == gamma, "case", "the weights do not add up to 1")?;
                }
                let centre = move |_| vertex(beta.clone(), gamma.clone());
                (Spline::Bicubic, Box::new(centre), "alpha beta gamma")
            }
            "loop" => (Spline::Quartic, Box::new(|_| Centre::Loop), ""),
            "loop-warren" => {
                let edges = |n| if n == 3 { ratio(9, 16) } else { ratio(3, 8) };
                (Spline::Quartic, Box::new(move |n| vertex(edges(n), ratio(0, 1))), "")
            }
            "loop-variant" => {
                let beta = parameter("beta")?;
                (Spline::Quartic, Box::new(move |n| vertex(&beta * ratio(n, 1), ratio(0, 1))), "beta")
            }
            "doo-sabin" if table.get("weights").is_some() => {
                let list = table.field("weights")?.each(number)?;
                (Spline::Biquadratic, Box::new(move |_| Centre::Face(list.clone())), "weights")
            }
            "doo-sabin" => (Spline::Biquadratic, Box::new(|_| Centre::Frequency(1)), ""),
            "doo-sabin-frequency" => {
                let f = match table.get("frequency") {
                    None => 2,
                    Some(node) => {
                        let f = number(&node)?;
                        let f = f.to_usize().filter(|k| f.is_integer() && (1..=MAX_FREQUENCY).contains(k));
                        node.some(f, "format", format_args!("a whole number from 1 to {MAX_FREQUENCY} is needed here"))?
                    }
                };
                (Spline::Biquadratic, Box::new(move |_| Centre::Frequency(f)), "frequency")
            }
            "doo-sabin-catmull-clark" => {
                (Spline::Biquadratic, Box::new(|n| face(n, ratio(1, 4 * n), ratio(1, 2), ratio(1, 8))), "")
            }
            "midedge" => (Spline::Quadratic, Box::new(|n| face(n, ratio(0, 1), ratio(1, 2), ratio(1, 4))), ""),
            _ => return table.reject("format", "a scheme for which there are no certificates"),
        };
        table.known(&format!("mesh valence {keys}"))?;
        let asked = match table.get("valence") {
            None => Some(BTreeSet::new()),
            Some(node) => read_valences(&node)?,
        };
        Ok(Self { name, spline, centre, asked })
    }

    /// What follows at one valence: C¹, and a tangent plane.
    fn valence(&self, node: &Node<'_>) -> Checked<(usize, Verdict, Verdict)> {
        let [valence, rule, frequency, turn, others, vector, half_plane] =
            node.fields("valence rule frequency turn others vector half_plane")?;
        let (n, k, radius) = (valence.index(MAX_VALENCE + 1)?, frequency.index(MAX_VALENCE)?, others.rational()?);
        node.need(n >= 3 && 2 * k <= n && radius.is_positive(), "vertex", "no such vertex, block or bound")?;
        let pair = |node: &Node<'_>| node.vector(2).map(|mut v| (v.remove(0), v.remove(0)));
        let mesh = Mesh::new(self.spline, (self.centre)(n), powers(n, &pair(&turn)?)?)?;
        let near = vector.list()?.iter().map(pair).collect::<Checked<Vec<_>>>()?;
        let net = top(&mesh, k, &near, &radius)?;
        let ring = patches(&mesh, &net)?;
        let held = if half_plane.is_null() {
            false
        } else {
            let (x, y) = pair(&half_plane)?;
            let against = Ball::new(&x, &y).conjugate();
            need(!ring.is_empty(), "vertex", "a ring has patches")?;
            let positive = ring.iter().flat_map(Patch::points).all(|p| p.times(&against).real_sign() == 1);
            half_plane.need(positive && 0 < k && 2 * k < n, "half-plane", "the ring of a sector does not lie in it")?;
            true
        };
        let holds = match rule.text()? {
            "theorem-7" => {
                k == 1 && held && one_sign(ring.iter().flat_map(Patch::jacobian).map(|c| c.0.imaginary_sign()))
            }
            "theorem-8-winding" => 2 <= k && 2 * k < n,
            "theorem-8-fold" => {
                let corners = ring.iter().flat_map(Patch::jacobian).filter(|c| c.1);
                let signs: Vec<i32> = corners.map(|c| c.0.imaginary_sign()).collect();
                0 < k && 2 * k < n && signs.contains(&1) && signs.contains(&-1)
            }
            "theorem-2" => k == 0 && one_sign(ring.iter().flat_map(Patch::points).map(Ball::real_sign)),
            "theorem-8-path" => k == 0 && one_sign(boundary(&mesh, &ring).iter().map(Ball::real_sign)),
            _ => return rule.reject("format", "unknown rule for a vertex"),
        };
        rule.need(holds, rule.text()?, "a premise of this rule does not hold")?;
        let (smooth, plane) = match rule.text()? {
            "theorem-7" => (Verdict::Proved, Verdict::Proved),
            "theorem-2" => (Verdict::Refuted, Verdict::Refuted),
            _ if held => (Verdict::Refuted, Verdict::Proved),
            _ => (Verdict::Refuted, Verdict::Undetermined),
        };
        Ok((n, smooth, plane))
    }
}

fn one_sign(signs: impl Iterator<Item = i32>) -> bool {
    let all: Vec<i32> = signs.collect();
    !all.is_empty() && all.iter().all(|s| *s != 0 && *s == all[0])
}

/// Proves that the block `k` has exactly one eigenvalue of modulus `radius` or more but the 1 of block 0, that it is simple and smaller
/// than 1, and that the other blocks have none; and returns its eigenvector on three rings.
fn top(mesh: &Mesh, k: usize, near: &[(Q, Q)], radius: &Q) -> Checked<Net> {
    let mut found = None;
    for other in 0..=mesh.valence() / 2 {
        let block = mesh.block(other)?;
        let ones = vec![Ball::real(&Q::one()); block.len()];
        // The weights add up to 1: on the quotient by the constant net the eigenvalue 1 is gone.
        let rest: Balls = if other == 0 { deflated(&block, &ones, 0) } else { block.clone() };
        if other != k {
            dominated(&rest, radius)?;
            continue;
        }
        need(near.len() == rest.len(), "vertex", "the vector has one entry for each point of the first two rings")?;
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
    let places = mesh.places(2);
    let centre = if vector.len() > places.len() { vector.remove(0) } else { Ball::zero() };
    let values = places.into_iter().zip(vector).collect();
    mesh.continued(&value, Net { frequency: k, centre, values })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::whole;
    use mesh::Place;

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
            let mesh = Mesh::new(case.spline, (case.centre)(n), powers(n, &turn).unwrap()).unwrap();
            let near: Vec<_> = item.field("vector").unwrap().list().unwrap().iter().map(pair).collect();
            let radius = item.field("others").unwrap().rational().unwrap();
            let block = mesh.block(k).unwrap();
            let (value, _) = leading(&block, &near, &radius).unwrap();
            let net = top(&mesh, k, &near, &radius).unwrap();
            let ring = patches(&mesh, &net).unwrap();
            let small = Q::one() / num_traits::pow(whole(2), 60);
            let (small_edge, outer) = (half(&edge(&ring)), boundary(&mesh, &ring));
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
            let net = top(&mesh, 1, &near, &(whole(3) / whole(10))).unwrap();
            let ring = patches(&mesh, &net).unwrap();
            assert!(one_sign(ring.iter().flat_map(Patch::jacobian).map(|c| c.0.imaginary_sign())), "{spline:?}");
            // The outer boundary begins at distance 2 on the first spoke.
            let scale = Ball::new(&first.0, &first.1);
            let corner = boundary(&mesh, &ring)[0].times(&scale).minus(&Ball::real(&whole(2)));
            assert!(corner.at_most() < Q::one() / num_traits::pow(whole(2), 60), "{spline:?}");
        }
    }
}
