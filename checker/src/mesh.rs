//! Certificates of the kind `mesh`: the limit surface of the points of a mesh file (docs/certificate.md, section 12.3).

use crate::base::{Accepted, Checked, Node, Q, Verdict, need, number::total, reject, some, spend, unreadable, whole};
use crate::claim::Claim;
use crate::vertex::ball::Ball;
use crate::vertex::{Case, Leading};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

mod near;
mod net;
mod patch;
mod refuted;
mod surface;
mod tail;
mod text;

use near::{Near, PLACES, Point};
use net::{Net, Ring};
use text::Text;

/// Limit points are given up to this part of the largest coordinate, normals up to this: powers of 1/2.
const POINTS: u32 = 40;
const NORMALS: u32 = 30;

/// A mesh, in coordinates in which its first point is 0 and no other is larger than 1.
struct Model {
    text: Text,
    origin: [Q; 3],
    scale: Q,
    /// The largest coordinate of the file, in these.
    largest: Q,
    /// All faces are triangles, or, after a step where they are not yet, quadrangles.
    start: Net,
    /// The points of this mesh.
    exact: Vec<[Ball; 3]>,
    /// The vertices of the file, then the middles of faces that become extraordinary, as vertices of this mesh.
    spots: Vec<u32>,
    closed: bool,
}

/// `2^-k`.
fn power(k: u32) -> Q {
    Q::new(BigInt::one(), BigInt::one() << k)
}

fn largest<'a>(points: impl IntoIterator<Item = &'a [Q; 3]>) -> Q {
    points.into_iter().flatten().map(Q::abs).fold(Q::zero(), Q::max)
}

impl Model {
    fn new(source: &str, triangles: bool) -> Checked<Self> {
        let text = unreadable(Text::read(source))?;
        let fits = !triangles || text.faces.iter().all(|f| f.len() == 3);
        need(fits, "scheme", "the scheme is for triangles")?;
        let origin = text.points[0].clone();
        let moved: Vec<[Q; 3]> = text.points.iter().map(|p| std::array::from_fn(|k| &p[k] - &origin[k])).collect();
        let scale = largest(&moved);
        need(scale.is_positive(), "limit", "all points are one")?;
        let exact: Vec<[Ball; 3]> = moved.iter().map(|p| p.each_ref().map(|x| Ball::real(&(x / &scale)))).collect();
        let points: Vec<Point> = exact.iter().map(|p| p.each_ref().map(|x| Near::of(x)[0])).collect();
        let whole = unreadable(Net::new(text.faces.clone(), points))?;
        let closed = unreadable(whole.is_surface())?;
        let mut spots: Vec<u32> = (0..text.points.len() as u32).filter(|v| whole.is_used(*v)).collect();
        let largest = largest(&text.points) / &scale;
        if triangles || text.faces.iter().all(|f| f.len() == 4) {
            return Ok(Self { text, origin, scale, largest, start: whole, exact, spots, closed });
        }
        let start = whole.refined(false, &|_| Near::UNKNOWN)?;
        let first = start.points.len() - text.faces.len();
        spots.extend((0..text.faces.len()).filter(|f| text.faces[*f].len() != 4).map(|f| (first + f) as u32));
        let exact = start.points.iter().map(|p| p.map(ball)).collect();
        Ok(Self { text, origin, scale, largest, start, exact, spots, closed })
    }
}

fn ball(x: Near) -> Ball {
    let unit = |k: i128| Q::new(BigInt::from(k), BigInt::one() << PLACES);
    // Of an unknown number the error is larger than all that is asked.
    Ball::real(&unit(x.middle())).widened(&unit(x.error()))
}

/// Checks the proof of a certificate of the kind `mesh`.
pub fn check(source: &str, proof: &Node<'_>) -> Checked<Accepted> {
    let [scheme, valences, limits, line, all] = proof.fields("scheme valences limits line whole")?;
    let name = scheme.text()?;
    let known = ["catmull-clark", "loop", "loop-warren"].contains(&name);
    scheme.need(known, "format", "a scheme for which there are no certificates of meshes")?;
    let (case, triangles) = (Case::of_mesh(name)?, name != "catmull-clark");
    let model = scheme.at(Model::new(source, triangles))?;
    let mut leading = BTreeMap::new();
    let mut last = 0;
    for item in valences.list()? {
        let found = item.at(case.smooth(&item))?;
        let n = found.mesh.valence();
        item.need(last < n, "vertex", "valences ascend")?;
        last = n;
        leading.insert(n, found);
    }
    let (mut listed, mut claims) = (0, Vec::new());
    for (spot, limit) in model.spots.iter().zip(limits.exactly(model.spots.len(), "limits")?) {
        if !limit.is_null() {
            limit.at(model.has_limit(*spot, &leading, &limit.vector(6)?))?;
            listed += 1;
        }
    }
    let count = model.spots.len();
    let smooth = Claim::MeshSmooth { scheme: name.to_owned(), listed, all: count };
    let verdict = if line.is_null() {
        need(listed > 0, "limits", "no limit is listed")?;
        claims.push(smooth.is(Verdict::Proved));
        if listed == count { Verdict::Proved } else { Verdict::Undetermined }
    } else {
        line.at(model.on_a_line(line.index(model.text.points.len())?))?;
        claims.push(Claim::MeshSmooth { scheme: name.to_owned(), listed: count, all: count }.is(Verdict::Refuted));
        Verdict::Refuted
    };
    if listed > 0 {
        claims.push(Claim::MeshLimits { listed, points: POINTS, normals: NORMALS }.is(Verdict::Proved));
    }
    let regular = |verdict| Claim::MeshRegular { scheme: name.to_owned() }.is(verdict);
    if verdict == Verdict::Refuted {
        all.need(all.is_null(), "whole", "a surface that is not C¹ is not regular")?;
        claims.push(regular(Verdict::Refuted));
    } else if all.get("face").is_some() {
        all.at(model.is_dependent(&all, triangles))?;
        claims.push(regular(Verdict::Refuted));
    } else if !all.is_null() {
        all.need(all.text()? == "regular", "format", "unknown claim about the whole mesh")?;
        let holds = verdict == Verdict::Proved && model.closed;
        all.need(holds, "whole", "a mesh with a border, or with vertices that are left out")?;
        all.at(surface::regular(&model.start, triangles, &leading))?;
        claims.push(regular(Verdict::Proved));
    }
    Ok(Accepted { case: "mesh".to_owned(), verdict, claims, points: Vec::new() })
}

impl Model {
    /// Demands that the leading coefficients at a vertex are independent, with this limit point and this unit normal.
    fn has_limit(&self, v: u32, leading: &BTreeMap<usize, Leading>, given: &[Q]) -> Checked<()> {
        let ring = some(self.start.ring(v), "limits", "the vertex lies on the border")?;
        let n = ring.spokes.len();
        let leading = some(leading.get(&n), "limits", format_args!("valence {n} is not listed"))?;
        spend(80 * n, 256)?;
        let [own, edges, corners] = tail::mean(leading)?;
        let part = Ball::real(&(Q::one() / whole(n as i64)));
        let (edges, corners) = (edges.times(&part), corners.times(&part));
        let at = |v: u32| &self.exact[v as usize];
        let mut point = at(v).each_ref().map(|x| x.times(&own));
        let mut a = [Ball::zero(), Ball::zero(), Ball::zero()];
        let mut add = |v: u32, weight: &Ball, share: &Ball| {
            for (k, x) in at(v).iter().enumerate() {
                (a[k], point[k]) = (a[k].plus(&x.times(weight)), point[k].plus(&x.times(share)));
            }
        };
        for s in 0..n {
            let [beside, opposite] = tail::coefficient(leading, s);
            add(ring.spokes[s], &beside, &edges);
            if !leading.mesh.triangles() {
                add(ring.across[s], &opposite, &corners);
            }
        }
        // a × b for A = a − ib.
        let product = |k: usize| a[(k + 2) % 3].conjugate().times(&a[(k + 1) % 3]);
        let normal: [Ball; 3] = std::array::from_fn(product);
        let some = normal.iter().any(|x| x.imaginary_sign() != 0);
        need(some, "limit", "the leading coefficients are not seen to be independent")?;
        for (k, x) in point.iter().enumerate() {
            let off = Ball::real(&((&given[k] - &self.origin[k]) / &self.scale)).minus(x).at_most();
            need(off <= &self.largest * power(POINTS), "limits", "another limit point")?;
        }
        is_normal(&normal, &given[3..], ring.alike)
    }

    /// Demands that the derivatives of the patch of a face of the file are dependent at a parameter.
    fn is_dependent(&self, node: &Node<'_>, triangles: bool) -> Checked<()> {
        let [face, at] = node.fields("face at")?;
        let face = face.index(self.text.faces.len())?;
        node.need(self.start.faces.len() == self.text.faces.len(), "whole", "a mesh that takes a step first")?;
        let control = surface::control(&self.start, face, triangles)?;
        let points: Vec<&[Q; 3]> = control.iter().map(|v| &self.text.points[*v as usize]).collect();
        let at = at.vector(2)?;
        refuted::is_dependent(triangles, &points, &at[0], &at[1])
    }

    /// Demands that all points lie on one line on which the surface depends in the faces at a vertex.
    fn on_a_line(&self, v: usize) -> Checked<()> {
        let faces = &self.text.faces;
        let mut touched = vec![false; self.text.points.len()];
        touched[v] = true;
        for _ in 0..2 {
            let before = touched.clone();
            for face in faces.iter().filter(|face| face.iter().any(|w| before[*w as usize])) {
                face.iter().for_each(|w| touched[*w as usize] = true);
            }
        }
        let used = faces.iter().flatten().any(|w| *w as usize == v);
        need(used, "line", "no face has this vertex")?;
        let origin = &self.text.points[v];
        let from = |p: &[Q; 3]| -> [Q; 3] { std::array::from_fn(|k| &p[k] - &origin[k]) };
        let all: Vec<[Q; 3]> =
            self.text.points.iter().zip(&touched).filter(|(_, t)| **t).map(|(p, _)| from(p)).collect();
        let Some(line) = all.iter().find(|p| p.iter().any(|x| !x.is_zero())) else { return Ok(()) };
        spend(60 * all.len(), 1024)?;
        let minor = |p: &[Q; 3], k: usize| &p[k] * &line[(k + 1) % 3] - &p[(k + 1) % 3] * &line[k];
        let holds = all.iter().all(|p| (0..3).all(|k| minor(p, k).is_zero()));
        need(holds, "line", "the points around this vertex are on no line")
    }
}

/// Demands that a vector is the unit vector in the direction of the imaginary parts, but for a small error; where the faces are not all
/// oriented alike, it may have the opposite one.
fn is_normal(normal: &[Ball; 3], given: &[Q], alike: bool) -> Checked<()> {
    // Errors of this size in each product make less than four times that together.
    let small = power(NORMALS + 3);
    let square = total(given.iter().map(|x| x * x))?;
    need((square - Q::one()).abs() <= small, "limits", "the normal is no unit vector")?;
    let given: Vec<Ball> = given.iter().map(Ball::real).collect();
    // Multiplied by −i, whose real part is the imaginary part.
    let part = |k: usize| real_part(&normal[k]);
    let size = (0..3).map(|k| part(k).at_least()).fold(Q::zero(), Q::max);
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let off = part(i).times(&given[j]).minus(&part(j).times(&given[i])).at_most();
        need(off <= &size * &small, "limits", "another normal")?;
    }
    let along = (0..3).fold(Ball::zero(), |sum, k| sum.plus(&part(k).times(&given[k]))).real_sign();
    need(along == 1 || (along == -1 && !alike), "limits", "the opposite normal")
}

/// The imaginary part of a number, as a real one.
fn real_part(z: &Ball) -> Ball {
    z.minus(&z.conjugate()).times(&Ball::new(&Q::zero(), &Q::new((-1).into(), 2.into())))
}

impl Ring {
    /// Whether the vertex has the valence of the regular mesh.
    fn is_regular(&self, triangles: bool) -> bool {
        self.spokes.len() == if triangles { 6 } else { 4 }
    }
}

/// A rejection of what lies outside a part of a mesh.
fn outside<T>() -> Checked<T> {
    reject("whole", "a point outside the part of the mesh")
}
