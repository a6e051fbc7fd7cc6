//! The rules for one branch: what its certificate proves about the tangent subspace of its germ.

use super::{Address, Chain, Germ, Model, Root, Top, outside, residual, span_a_plane};
use crate::base::{Checked, Enclosed, Field, Matrix, Node, Q, Whole, need};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// A proved tangent line, or a line in the tangent subspace.
#[derive(Clone)]
pub struct Line {
    /// The field of its coordinates.
    pub field: Field,
    /// A vector of the line in the space where the shape is looked at.
    pub vector: Matrix,
    /// Enclosures of its coordinates.
    pub values: Enclosed,
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
pub fn read_address(node: &Node<'_>) -> Checked<Address> {
    let [prefix, cycle] = node.fields("prefix cycle")?;
    let address = Address { prefix: prefix.word()?, cycle: cycle.word()? };
    cycle.need(!address.cycle.is_empty(), "format", "the cycle of an address is not empty")?;
    Ok(address)
}

/// A branch with its germ.
pub struct Branch<'a, T: Whole = BigInt> {
    /// The model.
    pub model: &'a Model<'a, T>,
    /// The germ.
    pub germ: Germ<T>,
}

/// Checks the certificate of the branch with this address.
pub fn check<T: Whole>(model: &Model<'_, T>, root: &Root<T>, address: &Address, node: &Node<'_>) -> Checked<Found> {
    let germ = node.at(Germ::new(model, root, address))?;
    let branch = Branch { model, germ };
    node.at(match node.tag("rule")? {
        rule @ ("theorem-2" | "theorem-3") => branch.line(node, rule),
        "corollary-line" => branch.whole_line(node),
        "corollary" => branch.corollary(node),
        "null-point" => branch.null_point(node),
        "sign-change" => branch.sign_change(node),
        "orbit" => branch.orbit(node),
        "crossing" => branch.crossing(node),
        "leading-sign" => branch.leading_sign(node),
        "direction" => branch.direction(node),
        _ => node.reject("format", "unknown rule for a branch"),
    })
}

/// Evidence with real top eigenvalues and exactly one longest chain.
pub struct Leading {
    /// The field of the eigenvalues.
    pub field: Field,
    /// The sign by which the root of the field is multiplied.
    sign: i32,
    /// The vectors of the longest chain.
    pub vectors: Vec<Matrix>,
    shorter: Vec<Chain>,
}

impl Leading {
    /// Reads and checks a top of this form.
    pub fn read<T: Whole>(node: &Node<'_>, linear: &Matrix<T>, ground: &T::Ground) -> Checked<Self> {
        let Top::Real { field, chains: mut shorter } = Top::read(node, linear, ground)? else {
            return node.reject("leading", "a real top is needed here");
        };
        shorter.sort_by_key(|c| c.vectors.len());
        let longest = shorter.pop().filter(|c| shorter.last().is_none_or(|d| d.vectors.len() < c.vectors.len()));
        let Chain { sign, vectors } = node.some(longest, "leading", "exactly one longest chain is needed here")?;
        Ok(Self { field, sign, vectors, shorter })
    }

    /// The sign of the eigenvalue of the longest chain.
    pub fn eigenvalue_sign(&self) -> i32 {
        self.sign * self.field.value_sign()
    }

    /// `g L − λ g` for a row over the field.
    fn residual<T: Whole>(&self, linear: &Matrix<T>, row: &Matrix) -> Checked<Matrix> {
        residual(&self.field, &linear.transpose(), self.sign, row)
    }

    /// Rule `leading`: a row `g` with `g L = λ g` that reads the coefficient of the last vector of the longest chain, up to
    /// a factor whose sign is returned.
    pub fn row<T: Whole>(&self, linear: &Matrix<T>, node: &Node<'_>) -> Checked<(Matrix, i32)> {
        let row = self.field.vector(node, linear.rows)?;
        let left = self.residual(linear, &row)?.is_zero();
        node.need(left, "leading", "the row is no left eigenvector")?;
        let on_last = |chain: &[Matrix]| self.field.dot(&row, &chain[chain.len() - 1]);
        for chain in &self.shorter {
            node.need(on_last(&chain.vectors)?.is_zero(), "leading", "the row sees a shorter chain")?;
        }
        let sign = self.field.sign(&on_last(&self.vectors)?)?;
        node.need(sign != 0, "leading", "the row is not seen to be nonzero")?;
        Ok((row, sign))
    }
}

impl<T: Whole> Branch<'_, T> {
    /// A top with exactly one longest chain.
    fn leading(&self, node: &Node<'_>) -> Checked<Leading> {
        Leading::read(node, &self.germ.linear, &self.model.ground)
    }

    /// Theorems 2 and 3.
    fn line(&self, node: &Node<'_>, rule: &str) -> Checked<Found> {
        let [_, top, functional, cover] = node.fields("rule top functional cover")?;
        let top = self.leading(&top)?;
        let fits = (top.vectors.len() == 1) == (rule == "theorem-2");
        need(fits, rule, "Theorem 2 is about chains of length 1, Theorem 3 about longer ones")?;
        let (row, pairing) = top.row(&self.germ.linear, &functional)?;
        let functional = self.model.functionals(&self.germ, &top.field, &[&row])?;
        let cells = self.model.cover(&self.germ, &functional, None, &cover)?;
        let mut line = self.found_line(&top.field, &top.vectors[0])?;
        // L^m x is about C(m, l) λ^(m-l) (g x / g v) v_1 with l = length - 1; m runs over all large numbers.
        let lambda = top.eigenvalue_sign();
        let factor = if top.vectors.len() % 2 == 0 { pairing * lambda } else { pairing };
        for cell in cells {
            let after = if cell.side < 0 { -1 } else { 1 };
            // An even and an odd number of turns.
            for (turn, power) in [(1, 1), (self.germ.turn, lambda)] {
                let before = after * turn * self.germ.prefix_sign < 0;
                let (rays, ray) = (if before { &mut line.left } else { &mut line.right }, cell.sign * factor * power);
                if !rays.contains(&ray) {
                    rays.push(ray);
                }
            }
        }
        Ok(Found::Line(line))
    }

    /// The line of a vector of `Y`, seen through `G`.
    fn found_line(&self, field: &Field, v: &Matrix) -> Checked<Line> {
        Line::new(field, field.applied(&self.germ.view, v)?)
    }

    /// The corollary on a line: `dim Y = 1` and `L ≠ 0`; the rays stay open.
    fn whole_line(&self, node: &Node<'_>) -> Checked<Found> {
        let [_] = node.fields("rule")?;
        let fits = self.germ.dim() == 1 && !self.germ.linear.is_zero();
        need(fits, "corollary-line", "the visible quotient is no line, or L is 0")?;
        let own = T::own(&self.model.ground)?;
        Ok(Found::Line(self.found_line(&own, &own.one())?))
    }

    /// The corollary for one direction: `G v_1` lies in `D*`.
    fn direction(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top] = node.fields("rule top")?;
        let top = self.leading(&top)?;
        Ok(Found::Direction(self.found_line(&top.field, &top.vectors[0])?))
    }

    fn plane(rule: &str, vectors: &[Enclosed]) -> Checked<Found> {
        need(span_a_plane(vectors), rule, "the directions are not seen to span a plane")?;
        Ok(Found::Plane)
    }

    /// The corollary: `U ⊂ D*` and `dim G U ≥ 2`.
    fn corollary(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top] = node.fields("rule top")?;
        let top = Top::read(&top, &self.germ.linear, &self.model.ground)?;
        Self::plane("corollary", &top.directions(&self.germ.view)?)
    }

    /// The coordinates of a point of the ring with an address, and the part of the ring where it lies.
    fn ring_point(&self, node: &Node<'_>) -> Checked<(Matrix<T>, i32)> {
        let address = read_address(node)?;
        let letters = self.germ.ring.iter().map(|p| p.word.len()).max();
        let letters = node.some(letters, "ring", "no piece of the ring is seen")?;
        let word: Vec<usize> = (0..letters).map(|k| address.letter(k)).collect();
        let piece = self.germ.ring.iter().find(|p| word.starts_with(&p.word));
        let piece = node.some(piece, "ring", "the address begins with no piece of the ring that is seen")?;
        let point = node.at(self.model.shape.point(self.germ.state, &address))?;
        Ok((self.germ.coordinates(&point)?, piece.side))
    }

    /// The part of the ring in which a row is positive at one point and negative at another.
    fn changing_part(&self, field: &Field, row: &Matrix, points: [&Node<'_>; 2]) -> Checked<i32> {
        let mut parts = Vec::new();
        for (node, wanted) in points.into_iter().zip([1, -1]) {
            let (y, part) = self.ring_point(node)?;
            parts.push(part);
            let has = field.sign(&field.applied(&y.transpose(), row)?)? == wanted;
            node.need(has, "sign-change", "the functional does not have this sign at the point")?;
        }
        let connected = parts[0] == parts[1] && parts[0] != 0;
        need(connected, "sign-change", "the points do not lie in one connected part of the ring")?;
        Ok(parts[0])
    }

    /// Two points of one piece of the ring that is connected because its pieces share points.
    fn changing_piece(&self, field: &Field, row: &Matrix, points: [&Node<'_>; 2], links: &Node<'_>) -> Checked<()> {
        let mut ends = Vec::new();
        for (node, wanted) in points.into_iter().zip([1, -1]) {
            let (y, _) = self.ring_point(node)?;
            let has = field.sign(&field.applied(&y.transpose(), row)?)? == wanted;
            node.need(has, "sign-change", "the functional does not have this sign at the point")?;
            let address = read_address(node)?;
            let piece = self.germ.ring.iter().find(|p| (0..p.word.len()).all(|k| address.letter(k) == p.word[k]));
            ends.push(node.some(piece, "ring", "the address begins with no piece of the ring that is seen")?);
        }
        need(ends[0].word == ends[1].word, "sign-change", "the points do not lie in one piece of the ring")?;
        links.at(connected(self.model, ends[0].end, links))
    }

    /// Theorem 4′: the leading coefficient takes both signs on a connected part of the ring.
    fn leading_sign(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top, functional, radius, rows, cover, positive, negative, links] =
            node.fields("rule top functional radius rows cover positive negative links")?;
        let top = self.leading(&top)?;
        let (row, _) = top.row(&self.germ.linear, &functional)?;
        if links.is_null() {
            self.changing_part(&top.field, &row, [&positive, &negative])?;
        } else {
            self.changing_piece(&top.field, &row, [&positive, &negative], &links)?;
        }
        let (dimension, list) = outer(&self.germ, &self.model.ground, &radius, &rows)?;
        let functionals = self.model.rows(&self.germ, &list, vec![Q::zero(); list.rows])?;
        self.model.cover(&self.germ, &functionals, None, &cover)?;
        let space = complement(&self.germ.linear, &list)?;
        let injective = dimension > 0 && self.germ.view.times(&space)?.rank()? == dimension;
        rows.need(injective, "leading-sign", "directions are lost where the shape is looked at")?;
        Ok(Found::Plane)
    }

    /// What both forms of Theorem 4 need: a simple eigenvalue, and `G` injective on `Y`.
    fn theorem_4(&self, top: &Leading, rule: &str) -> Checked<Found> {
        need(top.vectors.len() == 1, rule, "a simple eigenvalue is needed")?;
        let injective = self.germ.view.rank()? == self.germ.dim();
        need(injective, rule, "the map into the space where the shape is looked at is not injective on the quotient")?;
        Ok(Found::Plane)
    }

    /// Theorem 4 with a point of the ring at which the leading functional vanishes.
    fn null_point(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top, functional, address] = node.fields("rule top functional address")?;
        let top = self.leading(&top)?;
        let (row, _) = top.row(&self.germ.linear, &functional)?;
        let (y, _) = self.ring_point(&address)?;
        let vanishes = top.field.applied(&y.transpose(), &row)?.is_zero();
        address.need(vanishes, "null-point", "the functional does not vanish at the point")?;
        let ends = self.germ.linear.power(self.germ.dim())?.times(&y)?.is_zero();
        address.need(!ends, "null-point", "the orbit of the point ends in the germ's point")?;
        self.theorem_4(&top, "null-point")
    }

    /// Theorem 4 with two points of one connected part of the ring at which the leading functional has opposite signs.
    fn sign_change(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top, functional, isolation, positive, negative] =
            node.fields("rule top functional isolation positive negative")?;
        let top = self.leading(&top)?;
        let (row, _) = top.row(&self.germ.linear, &functional)?;
        self.changing_part(&top.field, &row, [&positive, &negative])?;
        // Isolation: the rows of L^dim have no common zero on the ring.
        let rows = self.germ.linear.power(self.germ.dim())?.echelon()?.0;
        let rows = self.model.rows(&self.germ, &rows, vec![Q::zero(); rows.rows])?;
        self.model.cover(&self.germ, &rows, None, &isolation)?;
        self.theorem_4(&top, "sign-change")
    }

    /// Lower bound from the orbit of one point of the ring: its own leading directions and those of the corollary.
    fn orbit(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top, address, own] = node.fields("rule top address own")?;
        let top = Top::read(&top, &self.germ.linear, &self.model.ground)?;
        let (own, view) = self.orbit_top(&address, &own)?;
        let mut vectors = top.directions(&self.germ.view)?;
        vectors.extend(own.directions(&view)?);
        Self::plane("orbit", &vectors)
    }

    /// The top of `L` on the cyclic hull of a point of the ring, and `G` on that hull.
    pub fn orbit_top(&self, address: &Node<'_>, own: &Node<'_>) -> Checked<(Top<T>, Matrix<T>)> {
        let (y, _) = self.ring_point(address)?;
        let transposed = self.germ.linear.transpose();
        let (hull, pivots) = y.transpose().hull(&transposed)?;
        address.need(!pivots.is_empty(), "orbit", "this is the germ's point itself")?;
        let linear = hull.times(&transposed)?.columns(&pivots).transpose();
        let own = Top::read(own, &linear, &self.model.ground)?;
        Ok((own, self.germ.view.times(&hull.transpose())?))
    }

    /// Section 6: one real block of length 2, and a connected part of the ring on which `c_2` takes both signs while `c_1` has
    /// one sign wherever `c_2` vanishes.
    fn crossing(&self, node: &Node<'_>) -> Checked<Found> {
        let [_, top, second, first, positive, negative, cover] =
            node.fields("rule top second first positive negative cover")?;
        let top = self.leading(&top)?;
        need(top.shorter.is_empty() && top.vectors.len() == 2, "crossing", "one block of length 2 is needed")?;
        let (c2, _) = top.row(&self.germ.linear, &second)?;
        let c1 = top.field.vector(&first, self.germ.dim())?;
        first.need(top.residual(&self.germ.linear, &c1)? == c2, "crossing", "g_1 L = λ g_1 + g_2 does not hold")?;
        let part = self.changing_part(&top.field, &c2, [&positive, &negative])?;
        let rows = self.model.functionals(&self.germ, &top.field, &[&c2, &c1])?;
        let cells = self.model.cover(&self.germ, &rows, Some(part), &cover)?;
        let signs: Vec<i32> = cells.iter().filter(|c| c.functional == 1).map(|c| c.sign).collect();
        let one = !signs.is_empty() && signs.windows(2).all(|s| s[0] == s[1]);
        cover.need(one, "crossing", "g_1 takes both signs where g_2 may vanish, or is used nowhere")?;
        let vectors = top.vectors.iter().map(|v| top.field.enclose(&top.field.applied(&self.germ.view, v)?));
        Self::plane("crossing", &vectors.collect::<Checked<Vec<_>>>()?)
    }
}

/// Reads rows over the field of the case that span an invariant space of rows on which all eigenvalues lie outside the disc, of as many dimensions
/// as there are outside, and returns that number: their common kernel is the sum of the generalised eigenspaces inside.
pub fn outer<T: Whole>(
    germ: &Germ<T>,
    ground: &T::Ground,
    radius: &Node<'_>,
    rows: &Node<'_>,
) -> Checked<(usize, Matrix<T>)> {
    let list: Matrix<T> = rows.entries(germ.dim(), ground)?;
    let (space, pivots) = list.echelon()?;
    let images = space.times(&germ.linear)?;
    let inner = images.columns(&pivots);
    rows.need(inner.times(&space)? == images, "group", "the space of the rows is not invariant")?;
    let (_, all) = outside(&germ.linear.characteristic()?, radius)?;
    let (_, own) = outside(&inner.characteristic()?, radius)?;
    let fits = all > 0 && space.rows == all && own == all;
    rows.need(fits, "group", "as many independent rows as eigenvalues outside the disc, and with these, are needed")?;
    Ok((all, list))
}

/// Columns that span the sum of the other generalised eigenspaces: the image of `χ(L)`, `χ` the characteristic polynomial of `L`
/// on the common kernel of the rows.
fn complement<T: Whole>(linear: &Matrix<T>, rows: &Matrix<T>) -> Checked<Matrix<T>> {
    let n = linear.rows;
    let (space, pivots) = rows.echelon()?;
    let free: Vec<usize> = (0..n).filter(|k| !pivots.contains(k)).collect();
    if free.is_empty() {
        return Ok(Matrix::identity(n));
    }
    // The vector of the kernel that has 1 at one free column and 0 at the others.
    let unit = Matrix::ones(n, free.len(), |i, j| free[j] == i);
    let at_pivots = Matrix::ones(n, pivots.len(), |i, j| pivots[j] == i);
    let kernel = unit.minus(&at_pivots.times(&space.columns(&free))?);
    let images = linear.times(&kernel)?;
    let own = images.transpose().columns(&free).transpose();
    let chi = own.characteristic()?;
    let mut sum = Matrix::zeros(n, n);
    for k in (0..chi.cols).rev() {
        sum = sum.times(linear)?.plus(&Q::one(), &Matrix::identity(n).multiple(&chi.columns(&[k])));
    }
    Ok(sum)
}

/// Whether the attractor of a state is connected: for it and all states reached from it, breadth first, pairs of addresses of
/// one point join all pieces.
fn connected<T: Whole>(model: &Model<'_, T>, from: usize, node: &Node<'_>) -> Checked<()> {
    let mut order = vec![from];
    let lists = node.list()?;
    let mut next = 0;
    while next < order.len() {
        let e = order[next];
        let list = node.some(lists.get(next), "links", "each state that is reached has a list of pairs")?;
        let pieces = &model.shape.states[e].pieces;
        let mut part: Vec<usize> = (0..pieces.len()).collect();
        for pair in list.list()? {
            let both = pair.exactly(2, "links")?;
            let (a, b) = (read_address(&both[0])?, read_address(&both[1])?);
            let same = model.shape.point(e, &a)? == model.shape.point(e, &b)?;
            pair.need(same, "links", "the addresses are those of different points")?;
            let (a, b) = (part[a.letter(0)], part[b.letter(0)]);
            part.iter_mut().filter(|p| **p == b).for_each(|p| *p = a);
        }
        list.need(part.iter().all(|p| *p == part[0]), "links", "the pieces are not all joined")?;
        for piece in pieces {
            if !order.contains(&piece.target) {
                order.push(piece.target);
            }
        }
        next += 1;
    }
    node.need(lists.len() == order.len(), "links", "one list for each state that is reached is needed")
}

impl Line {
    /// The line of a vector that is not 0; its rays are open.
    pub fn new(field: &Field, vector: Matrix) -> Checked<Self> {
        let values = field.enclose(&vector)?;
        need(values.is_nonzero(), "line", "the direction is not seen to be nonzero")?;
        Ok(Self { field: field.clone(), vector, values, left: Vec::new(), right: Vec::new() })
    }

    /// Whether a vector over the field of the line lies on it: `1` and `-1` for its two rays.
    pub fn along(&self, w: &Matrix) -> Checked<Option<i32>> {
        for i in 0..w.rows {
            for j in 0..i {
                let product = |i, j| self.field.dot(&self.vector.row(i), &w.row(j));
                if product(i, j)? != product(j, i)? {
                    return Ok(None);
                }
            }
        }
        let values = self.field.enclose(w)?;
        let relations = (0..w.rows).map(|k| self.values.sign(k) * values.sign(k));
        Ok(relations.into_iter().find(|r| *r != 0))
    }

    /// Whether two lines are certainly different.
    pub fn differs(&self, other: &Self) -> bool {
        self.values.not_parallel(&other.values)
    }
}
