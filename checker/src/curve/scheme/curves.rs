//! Named curves and sets of plane maps, Bézier curves, and corner cutting.

use crate::base::{Checked, Matrix, Node, Q, number, number::canonical, whole};
use num_traits::{One, ToPrimitive, Zero};

/// A curve of one state, or a set.
#[derive(Clone)]
pub struct Curve {
    /// The operators, with whether they run backwards.
    pub pieces: Vec<(Matrix, bool)>,
    /// Whether it is a curve.
    pub curve: bool,
    /// Control points, one a row.
    pub control: Option<Matrix>,
    /// Its vertex with the boundary operators.
    pub vertex: Option<Vertex>,
}

/// The vertex of a curve.
#[derive(Clone)]
pub struct Vertex {
    /// Its operator.
    pub op: Matrix,
    /// The boundary operators at the start and at the finish.
    pub ends: [Matrix; 2],
}

impl Curve {
    /// A curve of these pieces.
    pub fn new(operators: Vec<Matrix>) -> Self {
        let pieces = operators.into_iter().map(|op| (op, false)).collect();
        Self { pieces, curve: true, control: None, vertex: None }
    }
}

/// The parameters of a named scheme.
pub struct Parameters<'a> {
    node: Node<'a>,
    values: Vec<(&'static str, Q)>,
}

/// Reads the parameters with these names, and their values where they are not given; an empty text where one must be.
pub fn parameters<'a>(node: &Node<'a>, known: &[(&'static str, &str)]) -> Checked<Parameters<'a>> {
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).chain(["name", "vertices"]).collect();
    node.known(&names.join(" "))?;
    let value = |(name, otherwise): &(&'static str, &str)| {
        let value = match node.get(name) {
            Some(given) => number(&given)?,
            None => node.some(canonical(otherwise), "format", format_args!("the parameter `{name}` is missing"))?,
        };
        Ok((*name, value))
    };
    Ok(Parameters { node: node.clone(), values: known.iter().map(value).collect::<Checked<_>>()? })
}

impl Parameters<'_> {
    /// A number.
    pub fn number(&self, name: &str) -> Checked<&Q> {
        let found = self.values.iter().find(|(known, _)| *known == name);
        self.node.some(found.map(|(_, value)| value), "format", format_args!("no parameter `{name}`"))
    }

    /// A whole number up to a bound.
    pub fn count(&self, name: &str, most: usize) -> Checked<usize> {
        let value = self.number(name)?;
        let found = value.to_usize().filter(|k| value.is_integer() && *k <= most);
        self.node.some(found, "format", format_args!("`{name}` is a whole number up to {most}"))
    }

    /// A number between two others.
    fn between(&self, name: &str, low: i64, high: i64) -> Checked<&Q> {
        let value = self.number(name)?;
        let inside = *value > whole(low) && *value < whole(high);
        self.node.need(inside, "format", format_args!("`{name}` lies between {low} and {high}"))?;
        Ok(value)
    }
}

fn ratio(p: i64, q: i64) -> Q {
    whole(p) / whole(q)
}

/// A point of the plane.
type Point = [Q; 2];

/// The plane map that takes `(0, 0)`, `(1, 0)`, `(0, 1)` to three points, on barycentric coordinates.
fn placed(images: &[Point; 3]) -> Matrix {
    let column = |[x, y]: &Point| vec![Q::one() - x - y, x.clone(), y.clone()];
    Matrix::from_rows(3, &images.iter().map(column).collect::<Vec<_>>()).transpose()
}

/// A curve or a set of plane maps, which is seen in the plane.
fn plane(maps: Vec<[Point; 3]>, curve: bool) -> Curve {
    // The corners of the simplex: (0, 0), (1, 0), (0, 1).
    let corners = Matrix::ones(3, 2, |i, j| i == j + 1);
    let mut found = Curve::new(maps.iter().map(placed).collect());
    (found.curve, found.control) = (curve, Some(corners));
    found
}

/// The function graph through the points `(k/n, h_k)`, `h_k` the sum of the first `k` steps, each piece with its step as factor.
fn staircase(steps: &[Q]) -> Curve {
    let n = steps.len() as i64;
    let (mut maps, mut height) = (Vec::new(), Q::zero());
    for (k, step) in steps.iter().enumerate() {
        let (left, right) = (ratio(k as i64, n), ratio(k as i64 + 1, n));
        let above = &height + step;
        maps.push([[left.clone(), height.clone()], [right, height], [left, above.clone()]]);
        height = above;
    }
    plane(maps, true)
}

/// Similarities that take the segment from 0 to 1 to those between neighbours among points `x + y√−n`, given over a denominator.
/// The pieces in `mirrored` are reflected before; those in `backwards` begin at their second point.
fn polyline(n: i64, of: i64, points: &[[i64; 2]], mirrored: &[usize], backwards: &[usize]) -> Curve {
    let segment = |(k, ends): (usize, &[[i64; 2]])| {
        let (from, to) = if backwards.contains(&k) { (ends[1], ends[0]) } else { (ends[0], ends[1]) };
        let (p, q) = (to[0] - from[0], to[1] - from[1]);
        // √−n times p + q√−n, after a reflection its negative.
        let sign = if mirrored.contains(&k) { -1 } else { 1 };
        let third = [from[0] - sign * n * q, from[1] + sign * p];
        [from, to, third].map(|[x, y]| [ratio(x, of), ratio(y, of)])
    };
    let mut curve = plane(points.windows(2).enumerate().map(segment).collect(), true);
    backwards.iter().for_each(|k| curve.pieces[*k].1 = true);
    curve
}

/// Maps of the square given by the images of its corners `(0, 0)`, `(1, 0)`, `(0, 1)` over a denominator.
fn squares(of: i64, corners: &[[[i64; 2]; 3]], curve: bool) -> Curve {
    plane(corners.iter().map(|c| c.map(|[x, y]| [ratio(x, of), ratio(y, of)])).collect(), curve)
}

/// Peano's curve: nine squares, up, down and up again, turned so that they join.
fn peano() -> Curve {
    let cell = |k: i64| {
        let (i, step) = (k / 3, k % 3);
        let j = if i % 2 == 0 { step } else { 2 - step };
        // The curve of a square goes from one corner to the opposite one.
        let (left, low) = (j % 2 == 0, i % 2 == 0);
        let (x, dx) = if left { (i, 1) } else { (i + 1, -1) };
        let (y, dy) = if low { (j, 1) } else { (j + 1, -1) };
        [[x, y], [x + dx, y], [x, y + dy]]
    };
    squares(3, &(0..9).map(cell).collect::<Vec<_>>(), true)
}

/// A named scheme that is given by its operators.
pub fn named(node: &Node<'_>) -> Checked<Curve> {
    let known = |keys: &[(&'static str, &str)]| parameters(node, keys);
    match node.field("name")?.text()? {
        "bezier" => {
            let v = known(&[("degree", "3"), ("split", "1/2")])?;
            let degree = v.count("degree", 48)?;
            node.need(degree > 0, "format", "a curve has degree 1 at least")?;
            Ok(bezier(degree, v.between("split", 0, 1)?))
        }
        "corner-cutting" => {
            let v = known(&[("a", ""), ("b", "")])?;
            Ok(corner_cutting(v.number("a")?, v.number("b")?))
        }
        "de-rham" => {
            let v = known(&[("a", "1/3")])?;
            Ok(corner_cutting(v.number("a")?, v.number("a")?))
        }
        "takagi" => {
            let v = known(&[("alpha", "1/2")])?;
            let (a, h, o) = (v.between("alpha", -1, 1)?.clone(), ratio(1, 2), Q::zero());
            let first = [[o.clone(), o.clone()], [h.clone(), h.clone()], [o, a.clone()]];
            let second = [[h.clone(), h.clone()], [Q::one(), Q::zero()], [h.clone(), h + a]];
            Ok(plane(vec![first, second], true))
        }
        "okamoto" => {
            let v = known(&[("a", "2/3")])?;
            let a = v.between("a", 0, 1)?;
            Ok(staircase(&[a.clone(), Q::one() - a - a, a.clone()]))
        }
        "lebesgue" => {
            let v = known(&[("a", "1/3")])?;
            let a = v.between("a", 0, 1)?;
            Ok(staircase(&[a.clone(), Q::one() - a]))
        }
        "koch" => match known(&[("pieces", "4")])?.count("pieces", 4)? {
            2 => Ok(polyline(3, 6, &[[0, 0], [3, 1], [6, 0]], &[0, 1], &[])),
            4 => Ok(polyline(3, 6, &[[0, 0], [2, 0], [3, 1], [4, 0], [6, 0]], &[], &[])),
            _ => node.reject("format", "Koch's curve is built from 2 or 4 pieces"),
        },
        name => {
            let found = plain(name);
            known(&[])?;
            node.some(found, "scheme", format_args!("there is no scheme `{name}`"))
        }
    }
}

/// A named scheme without parameters.
fn plain(name: &str) -> Option<Curve> {
    Some(match name {
        "levy" => polyline(1, 2, &[[0, 0], [1, 1], [2, 0]], &[], &[]),
        "dragon" => polyline(1, 2, &[[0, 0], [1, 1], [2, 0]], &[], &[1]),
        "terdragon" => polyline(3, 6, &[[0, 0], [3, -1], [3, 1], [6, 0]], &[], &[]),
        "arrowhead" => polyline(3, 4, &[[0, 0], [1, 1], [3, 1], [4, 0]], &[0, 2], &[]),
        "minkowski-sausage" => {
            let points = [[0, 0], [1, 0], [1, 1], [2, 1], [2, 0], [2, -1], [3, -1], [3, 0], [4, 0]];
            polyline(1, 4, &points, &[], &[])
        }
        "hilbert" => {
            let first = [[[0, 0], [0, 1], [1, 0]], [[0, 1], [1, 1], [0, 2]]];
            let second = [[[1, 1], [2, 1], [1, 2]], [[2, 1], [2, 0], [1, 1]]];
            squares(2, &[first, second].concat(), true)
        }
        "peano" => peano(),
        "sierpinski" => {
            let corners = [[[0, 0], [1, 0], [0, 1]], [[1, 0], [2, 0], [1, 1]], [[0, 1], [1, 1], [0, 2]]];
            squares(2, &corners, false)
        }
        "fern" => {
            let corners = [
                [[0, 0], [0, 0], [0, 16]],
                [[0, 160], [85, 156], [4, 245]],
                [[0, 160], [20, 183], [-26, 182]],
                [[0, 44], [-15, 70], [28, 68]],
            ];
            squares(100, &corners, false)
        }
        _ => return None,
    })
}

/// `C(n, k)`.
fn choose(n: usize, k: usize) -> Q {
    (0..k).fold(Q::one(), |c, i| c * whole((n - i) as i64) / whole(i as i64 + 1))
}

/// De Casteljau's division of a Bézier curve: control point `j` of the first part is the value of the blossom at `j` times `t`
/// and otherwise 0.
fn bezier(degree: usize, t: &Q) -> Curve {
    let n = degree + 1;
    let part = |x: &Q, k: usize| num_traits::pow(x.clone(), k);
    // A mean of d + 1 points by the Bernstein polynomials of degree d.
    let weight = |d: usize, i: usize| choose(d, i) * part(t, i) * part(&(Q::one() - t), d - i);
    let left = |i: usize, j: usize| if i <= j { weight(j, i) } else { Q::zero() };
    let right = |i: usize, j: usize| if i >= j { weight(degree - j, i - j) } else { Q::zero() };
    let matrix = |entry: &dyn Fn(usize, usize) -> Q| {
        Matrix::new(n, n, &(0..n * n).map(|k| entry(k / n, k % n)).collect::<Vec<_>>())
    };
    let ends = [0, degree].map(|at| Matrix::ones(n, 1, |i, _| i == at));
    let vertex = Some(Vertex { op: Matrix::identity(1), ends });
    Curve { vertex, ..Curve::new(vec![matrix(&left), matrix(&right)]) }
}

/// `p'_{2i} = (1−a) p_i + a p_{i+1}`, `p'_{2i+1} = b p_i + (1−b) p_{i+1}`: three points give four, the first piece has the first
/// three of them.
fn corner_cutting(a: &Q, b: &Q) -> Curve {
    let (ca, cb) = (Q::one() - a, Q::one() - b);
    // New point k by the old points.
    let points = [
        [ca.clone(), a.clone(), Q::zero()],
        [b.clone(), cb.clone(), Q::zero()],
        [Q::zero(), ca, a.clone()],
        [Q::zero(), b.clone(), cb],
    ];
    let piece = |first: usize| {
        Matrix::from_rows(3, &points[first..first + 3].iter().map(|p| p.to_vec()).collect::<Vec<_>>()).transpose()
    };
    Curve::new(vec![piece(0), piece(1)])
}
