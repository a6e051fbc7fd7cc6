//! The rules for one branch: what its certificate proves about the tangent subspace of its germ.

use crate::germ::{Germ, Position, Root};
use crate::json::Node;
use crate::matrix::Matrix;
use crate::number::{Q, sign};
use crate::poly::{Field, Interval, Poly, combine, weighted};
use crate::ring::{Functional, Model};
use crate::shape::Address;
use crate::spectrum::{Chain, Top, not_parallel, seen, span_a_plane};
use crate::{Rejected, at, reject};
use num_traits::{One, Zero};

/// A proved tangent line, or a line in the tangent subspace.
pub struct Line {
    /// The field of its coordinates.
    pub field: Field,
    /// A vector of the line in the space where the shape is looked at.
    pub vector: Vec<Poly>,
    /// Enclosures of its coordinates.
    pub values: Vec<Interval>,
    /// The limit rays of earlier points as signs of the vector; none where they are not settled.
    pub left: Vec<i32>,
    /// The limit rays of later points.
    pub right: Vec<i32>,
}

/// What a branch's certificate proves.
pub enum Found {
    /// The tangent subspace is this line.
    Line(Line),
    /// The tangent subspace contains this line.
    Direction(Line),
    /// Its dimension is at least 2.
    Plane,
}

/// Reads an address as an object with prefix and cycle.
pub fn read_address(node: &Node<'_>) -> Result<Address, Rejected> {
    let [prefix, cycle] = node.fields(["prefix", "cycle"])?;
    let address = Address { prefix: prefix.word()?, cycle: cycle.word()? };
    if address.cycle.is_empty() { cycle.malformed("the cycle of an address is not empty") } else { Ok(address) }
}

struct Branch<'a> {
    model: &'a Model<'a>,
    germ: Germ,
    place: &'a str,
}

/// Checks the certificate of the branch with this address.
pub fn check(model: &Model<'_>, root: &Root, address: &Address, node: &Node<'_>) -> Result<Found, Rejected> {
    let germ = at(&node.place, Germ::new(model, root, address))?;
    let branch = Branch { model, germ, place: &node.place };
    at(
        &node.place,
        match node.tag("rule")? {
            "theorem-2" => branch.line(node, "theorem-2"),
            "theorem-3" => branch.line(node, "theorem-3"),
            "corollary-line" => branch.whole_line(node),
            "corollary" => branch.corollary(node),
            "null-point" => branch.null_point(node),
            "sign-change" => branch.sign_change(node),
            "orbit" => branch.orbit(node),
            "crossing" => branch.crossing(node),
            "direction" => branch.direction(node),
            _ => node.malformed("unknown rule for a branch"),
        },
    )
}

/// Evidence with real top eigenvalues and exactly one longest chain.
struct Leading {
    field: Field,
    chains: Vec<Chain>,
    longest: usize,
}

impl Leading {
    fn chain(&self) -> &Chain {
        &self.chains[self.longest]
    }

    /// The sign of the eigenvalue of the longest chain.
    fn eigenvalue_sign(&self) -> i32 {
        self.chain().sign * self.field.interval.sign()
    }

    /// The matrix of `L` applied from the left to a row over the field, minus the eigenvalue times the row.
    fn residual(&self, linear: &Matrix, row: &[Poly]) -> Result<Vec<Poly>, Rejected> {
        let theta = self.field.reduce(vec![Q::zero(), crate::number::whole(i64::from(self.chain().sign))])?;
        let entry = |j: usize| {
            let image = weighted(&linear.column(j), row)?;
            Ok(combine(&image, &-Q::one(), &self.field.times(&theta, &row[j])?))
        };
        (0..linear.cols).map(entry).collect()
    }
}

impl Branch<'_> {
    fn fails<T>(&self, rule: &str, why: &str) -> Result<T, Rejected> {
        reject(rule, self.place, why)
    }

    fn leading(&self, node: &Node<'_>) -> Result<Leading, Rejected> {
        let Top::Real { field, chains } = Top::read(node, &self.germ.linear)? else {
            return reject("leading", &node.place, "a real top is needed here");
        };
        let length = chains.iter().map(|c| c.vectors.len()).max().unwrap_or(0);
        let longest: Vec<usize> = (0..chains.len()).filter(|&k| chains[k].vectors.len() == length).collect();
        match longest[..] {
            [longest] => Ok(Leading { field, chains, longest }),
            _ => reject("leading", &node.place, "exactly one longest chain is needed here"),
        }
    }

    /// Rule `leading`: a row `g` with `g L = λ g` that reads the coefficient of the last vector of the longest chain, up to
    /// a factor whose sign is returned.
    fn leading_row(&self, top: &Leading, node: &Node<'_>) -> Result<(Vec<Poly>, i32), Rejected> {
        let row = top.field.vector(node, self.germ.dim())?;
        if top.residual(&self.germ.linear, &row)?.iter().any(|r| !r.is_empty()) {
            return reject("leading", &node.place, "the row is no left eigenvector");
        }
        for (k, chain) in top.chains.iter().enumerate() {
            let pairing = top.field.dot(&row, &chain.vectors[chain.vectors.len() - 1])?;
            if k != top.longest && !pairing.is_empty() {
                return reject("leading", &node.place, "the row sees a shorter chain");
            }
        }
        let chain = top.chain();
        let pairing = top.field.enclose(&top.field.dot(&row, &chain.vectors[chain.vectors.len() - 1])?)?.sign();
        if pairing == 0 {
            reject("leading", &node.place, "the row is not seen to be nonzero")
        } else {
            Ok((row, pairing))
        }
    }

    /// Theorems 2 and 3.
    fn line(&self, node: &Node<'_>, rule: &str) -> Result<Found, Rejected> {
        let [_, top, functional, cover] = node.fields(["rule", "top", "functional", "cover"])?;
        let top = self.leading(&top)?;
        let length = top.chain().vectors.len();
        if (length == 1) != (rule == "theorem-2") {
            return self.fails(rule, "Theorem 2 is about chains of length 1, Theorem 3 about longer ones");
        }
        let (row, pairing) = self.leading_row(&top, &functional)?;
        let functional = self.model.functional(&self.germ, &top.field, &row)?;
        let cells = self.model.cover(&self.germ, &[functional], None, &cover)?;
        // L^m x is about C(m, l) λ^(m-l) (g x / g v) v_1 with l = length - 1; m runs over all large numbers.
        let lambda = top.eigenvalue_sign();
        let parity = if length % 2 == 0 { lambda } else { 1 };
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for cell in cells {
            let after = cell.position != Position::Before;
            for m in 0..2 {
                let flips = |s: i32| if m == 1 { s } else { 1 };
                let side = if after { 1 } else { -1 } * flips(self.germ.turn) * self.germ.prefix_sign;
                let rays = if side < 0 { &mut left } else { &mut right };
                let ray = cell.sign * pairing * parity * flips(lambda);
                if !rays.contains(&ray) {
                    rays.push(ray);
                }
            }
        }
        self.found_line(&top.field, &top.chain().vectors[0], left, right)
    }

    fn found_line(&self, field: &Field, v: &[Poly], left: Vec<i32>, right: Vec<i32>) -> Result<Found, Rejected> {
        let vector =
            (0..self.germ.view.rows).map(|i| weighted(self.germ.view.row(i), v)).collect::<Result<Vec<_>, _>>()?;
        let values = seen(field, &self.germ.view, v)?;
        if values.iter().all(|x| x.sign() == 0) {
            return self.fails("line", "the direction is not seen to be nonzero");
        }
        Ok(Found::Line(Line { field: field.clone(), vector, values, left, right }))
    }

    /// The corollary on a line: `dim Y = 1` and `L ≠ 0`; the rays stay open.
    fn whole_line(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        node.fields(["rule"])?;
        if self.germ.dim() != 1 || self.germ.linear.is_zero() {
            return self.fails("corollary-line", "the visible quotient is no line, or L is 0");
        }
        let field = Field { m: vec![Q::zero(), Q::one()], interval: Interval::point(&Q::zero()) };
        self.found_line(&field, &[vec![Q::one()]], Vec::new(), Vec::new())
    }

    fn plane(&self, rule: &str, vectors: &[Vec<Interval>]) -> Result<Found, Rejected> {
        if span_a_plane(vectors) {
            Ok(Found::Plane)
        } else {
            self.fails(rule, "the directions are not seen to span a plane")
        }
    }

    /// The corollary: `U ⊂ D*` and `dim G U ≥ 2`.
    fn corollary(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        let [_, top] = node.fields(["rule", "top"])?;
        let top = Top::read(&top, &self.germ.linear)?;
        self.plane("corollary", &top.directions(&self.germ.view)?)
    }

    /// `G` is injective on `Y`.
    fn injective(&self, rule: &str) -> Result<(), Rejected> {
        if self.germ.view.rank()? == self.germ.dim() {
            Ok(())
        } else {
            self.fails(rule, "the map into the space where the shape is looked at is not injective on the quotient")
        }
    }

    /// The coordinates of a point of the ring with an address.
    fn ring_point(&self, node: &Node<'_>) -> Result<Vec<Q>, Rejected> {
        Ok(self.placed_point(node)?.0)
    }

    /// The coordinates of a point of the ring with an address, and the part of the ring where it lies.
    fn placed_point(&self, node: &Node<'_>) -> Result<(Vec<Q>, Position), Rejected> {
        let address = read_address(node)?;
        let letters = self.germ.ring.iter().map(|p| p.word.len()).max().unwrap_or(0);
        let word: Vec<usize> = (0..letters).map(|k| address.letter(k)).collect();
        let Some(piece) = self.germ.ring.iter().find(|p| word.starts_with(&p.word)) else {
            return reject("ring", &node.place, "the address begins with no piece of the ring that is seen");
        };
        let point = at(&node.place, self.model.shape.point(self.germ.state, &address))?;
        Ok((self.germ.coordinates(&point)?, piece.position))
    }

    /// The part of the ring in which a row is positive at one point and negative at another.
    fn changing_part(
        &self,
        field: &Field,
        row: &[Poly],
        positive: &Node<'_>,
        negative: &Node<'_>,
    ) -> Result<Position, Rejected> {
        let mut parts = Vec::new();
        for (node, wanted) in [(positive, 1), (negative, -1)] {
            let (y, part) = self.placed_point(node)?;
            parts.push(part);
            if field.enclose(&weighted(&y, row)?)?.sign() != wanted {
                return reject("sign-change", &node.place, "the functional does not have this sign at the point");
            }
        }
        if parts[0] != parts[1] || parts[0] == Position::Unordered {
            return self.fails("sign-change", "the points do not lie in one connected part of the ring");
        }
        Ok(parts[0])
    }

    /// Theorem 4 with a point of the ring at which the leading functional vanishes.
    fn null_point(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        let [_, top, functional, address] = node.fields(["rule", "top", "functional", "address"])?;
        let top = self.leading(&top)?;
        if top.chain().vectors.len() != 1 {
            return self.fails("null-point", "a simple eigenvalue is needed");
        }
        let (row, _) = self.leading_row(&top, &functional)?;
        let y = self.ring_point(&address)?;
        if !weighted(&y, &row)?.is_empty() {
            return reject("null-point", &address.place, "the functional does not vanish at the point");
        }
        if self.germ.linear.power(self.germ.dim())?.apply(&y)?.iter().all(Zero::is_zero) {
            return reject("null-point", &address.place, "the orbit of the point ends in the germ's point");
        }
        self.injective("null-point")?;
        Ok(Found::Plane)
    }

    /// Theorem 4 with two points of one connected part of the ring at which the leading functional has opposite signs.
    fn sign_change(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        let [_, top, functional, isolation, positive, negative] =
            node.fields(["rule", "top", "functional", "isolation", "positive", "negative"])?;
        let top = self.leading(&top)?;
        if top.chain().vectors.len() != 1 {
            return self.fails("sign-change", "a simple eigenvalue is needed");
        }
        let (row, _) = self.leading_row(&top, &functional)?;
        self.changing_part(&top.field, &row, &positive, &negative)?;
        // Isolation: the rows of L^dim have no common zero on the ring.
        let rows = self.germ.linear.power(self.germ.dim())?.echelon()?.0;
        let rows = (0..rows.rows).map(|i| self.model.rational_functional(&self.germ, rows.row(i)));
        self.model.cover(&self.germ, &rows.collect::<Result<Vec<Functional>, _>>()?, None, &isolation)?;
        self.injective("sign-change")?;
        Ok(Found::Plane)
    }

    /// Lower bound from the orbit of one point of the ring: its own leading directions and those of the corollary.
    fn orbit(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        let [_, top, address, own] = node.fields(["rule", "top", "address", "own"])?;
        let top = Top::read(&top, &self.germ.linear)?;
        let y = self.ring_point(&address)?;
        let n = self.germ.dim();
        let (mut hull, mut pivots) = Matrix::from_rows(n, &[y]).echelon()?;
        loop {
            let (grown, grown_pivots) = hull.stack(&hull.times(&self.germ.linear.transpose())?).echelon()?;
            if grown_pivots.len() == pivots.len() {
                break;
            }
            (hull, pivots) = (grown, grown_pivots);
        }
        if pivots.is_empty() {
            return reject("orbit", &address.place, "this is the germ's point itself");
        }
        let images = hull.times(&self.germ.linear.transpose())?;
        let linear = Matrix::from_fn(hull.rows, hull.rows, |i, j| images.at(j, pivots[i]).clone());
        let own = Top::read(&own, &linear)?;
        let mut vectors = top.directions(&self.germ.view)?;
        vectors.extend(own.directions(&self.germ.view.times(&hull.transpose())?)?);
        self.plane("orbit", &vectors)
    }

    /// Section 6: one real block of length 2, and a connected part of the ring on which `c_2` takes both signs while `c_1` has
    /// one sign wherever `c_2` vanishes.
    fn crossing(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        let [_, top, second, first, positive, negative, cover] =
            node.fields(["rule", "top", "second", "first", "positive", "negative", "cover"])?;
        let top = self.leading(&top)?;
        if top.chains.len() != 1 || top.chain().vectors.len() != 2 {
            return self.fails("crossing", "one block of length 2 is needed");
        }
        let (c2, _) = self.leading_row(&top, &second)?;
        let c1 = top.field.vector(&first, self.germ.dim())?;
        if top.residual(&self.germ.linear, &c1)? != c2 {
            return reject("crossing", &first.place, "g_1 L = λ g_1 + g_2 does not hold");
        }
        let part = self.changing_part(&top.field, &c2, &positive, &negative)?;
        let rows = [&c2, &c1].map(|row| self.model.functional(&self.germ, &top.field, row));
        let [f2, f1] = rows;
        let cells = self.model.cover(&self.germ, &[f2?, f1?], Some(part), &cover)?;
        let mut signs = cells.iter().filter(|c| c.functional == 1).map(|c| c.sign);
        let first_sign = signs.next();
        if signs.any(|s| Some(s) != first_sign) {
            return reject("crossing", &cover.place, "g_1 takes both signs where g_2 may vanish");
        }
        let vectors = top.chain().vectors.iter().map(|v| seen(&top.field, &self.germ.view, v));
        self.plane("crossing", &vectors.collect::<Result<Vec<_>, _>>()?)
    }

    /// The corollary for one direction: `G v_1` lies in `D*`.
    fn direction(&self, node: &Node<'_>) -> Result<Found, Rejected> {
        let [_, top] = node.fields(["rule", "top"])?;
        let top = self.leading(&top)?;
        match self.found_line(&top.field, &top.chain().vectors[0], Vec::new(), Vec::new())? {
            Found::Line(line) => Ok(Found::Direction(line)),
            other => Ok(other),
        }
    }
}

impl Line {
    /// Whether a rational vector lies on the line: `1` and `-1` for its two rays.
    pub fn along(&self, common: &[Q]) -> Result<Option<i32>, Rejected> {
        let constant = |x: &Q| if x.is_zero() { Poly::new() } else { vec![x.clone()] };
        self.parallel(&self.field, &common.iter().map(constant).collect::<Vec<_>>(), &|k| sign(&common[k]))
    }

    /// The same for another line over the same field.
    pub fn agrees(&self, other: &Self) -> Result<Option<i32>, Rejected> {
        if !self.field.same(&other.field) {
            return Ok(None);
        }
        self.parallel(&self.field, &other.vector, &|k| other.values[k].sign())
    }

    fn parallel(&self, field: &Field, w: &[Poly], sign_of: &dyn Fn(usize) -> i32) -> Result<Option<i32>, Rejected> {
        for i in 0..w.len() {
            for j in 0..i {
                let (a, b) = (field.times(&self.vector[i], &w[j])?, field.times(&self.vector[j], &w[i])?);
                if a != b {
                    return Ok(None);
                }
            }
        }
        let relation = |k: usize| self.values[k].sign() * sign_of(k);
        Ok((0..w.len()).map(relation).find(|r| *r != 0))
    }

    /// Whether two lines are certainly different.
    pub fn differs(&self, other: &Self) -> bool {
        not_parallel(&self.values, &other.values)
    }
}
