//! The size of the curvature at a vertex for almost all control points, C² and the shapes that are excluded: the eigenvalues after
//! `1, λ, λ` against `λ²`, for every rule whose ring has Bézier patches (docs/theory.md, “Size of the curvature”).

use super::block::{Block, Vertex};
use super::field::{Enclosures, Field as _, Fixed};
use super::net::Net;
use super::ring::patches;
use super::solve::{leading_vector, longest_blocks};
use super::top::{
    Guess, Piece, Top, all_below, around, coefficients, convert, deflate, evaluate, field_of, from_float, guess,
    leading_value, leading_values, newton, number_field, pieces,
};
use super::turning::{Rotation, Turning};
use crate::arith::{Interval, Rational, abs, ratio, to_f64};
use crate::ring::{Field as _, Ordered as _, Ring as _};
use crate::scheme::Spline;

/// Binary places of the eigenvalues that are compared.
const PLACES: u64 = 192;
/// Valences up to which equal moduli are looked at, block by block in number fields.
const EXACT: usize = 40;
/// Relative distance in floats below which two moduli may be equal.
const NEAR: f64 = 1e-9;

/// What becomes of the principal curvatures on late rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// They tend to 0.
    Vanishing,
    /// They are bounded, and not all tend to 0.
    Bounded,
    /// They are unbounded.
    Unbounded,
}

/// Whether the surface is C² at the vertex, for almost all points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Second {
    /// It is, and all curvatures are 0 there.
    Flat,
    /// It is, as everywhere on the spline: the vertex is regular.
    Regular,
    /// It is not.
    No,
    /// Not decided.
    Open,
}

/// The curvature at a vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct Curvature {
    /// Their size.
    pub size: Size,
    /// Whether the surface is C².
    pub second: Second,
    /// Bounds of `ρ/λ²`; curvatures of ring `m` grow like its power `m`, times `m` to the power `power`.
    pub ratio: Interval,
    /// The length of the longest Jordan block of `ρ`, less 1.
    pub power: usize,
    /// Of unbounded curvatures the exponent `p*`: they are in `L^p` for `p < p*`; all `p` where it is infinite. A decimal.
    pub exponent: Option<f64>,
    /// The Fourier blocks up to `n/2` with a longest chain of modulus `ρ`, where they are known.
    pub blocks: Option<Vec<usize>>,
}

impl Curvature {
    /// Whether surfaces that are convex near the vertex are excluded for almost all points (Theorem A3 (a)): no chain in block 0.
    #[must_use]
    pub fn excludes_convex(&self) -> bool {
        self.blocks.as_ref().is_some_and(|blocks| !blocks.contains(&0))
    }

    /// Whether ordinary saddles are excluded for almost all points (b): all chains are in block 0.
    #[must_use]
    pub fn excludes_saddles(&self) -> bool {
        self.blocks.as_ref().is_some_and(|blocks| blocks.as_slice() == [0])
    }
}

/// The eigenvalues of a vertex besides 1, and its two leading ones.
struct Rest<'a> {
    vertex: &'a Vertex,
    blocks: &'a [Block],
    top: &'a Top,
    pieces: Vec<Piece>,
    guesses: Vec<Guess>,
    /// `λ²`.
    square: Interval,
    lambda: Fixed,
}

/// The curvature at a vertex at which Theorem 7 holds with simple leading eigenvalues; `None` where the ring has no Bézier patches
/// that tell nets apart, where eigenvalues are too close, or a leading Jordan block is longer.
#[must_use]
pub fn curvature(vertex: &Vertex, blocks: &[Block], top: &Top) -> Option<Curvature> {
    let [only] = top.members.as_slice() else { return None };
    let spline = vertex.rule.info().spline?;
    if only.frequency != 1 || only.negative || only.blocks != [1] || spline == Spline::Quadratic {
        return None;
    }
    // A net that is 0 but at the centre is no eigenvector: the ring of patches tells all others apart.
    if vertex.rule.regular_from() > 1 && vertex.stencils.from_centre.iter().all(|w| *w == 0) {
        return None;
    }
    let rest = Rest::new(vertex, blocks, top)?;
    let smooth = matches!(spline, Spline::Bicubic | Spline::Quartic);
    let mut found = rest.size()?;
    found.second = match found.size {
        Size::Unbounded => Second::No,
        Size::Vanishing if smooth => Second::Flat,
        Size::Bounded if smooth => rest.quadratic(&found),
        _ => Second::Open,
    };
    Some(found)
}

impl<'a> Rest<'a> {
    #[allow(
        clippy::float_arithmetic,
        reason = "proposes which piece has the leading eigenvalue; the bounds are proved"
    )]
    fn new(vertex: &'a Vertex, blocks: &'a [Block], top: &'a Top) -> Option<Self> {
        let lambda = leading_value(vertex, blocks, top, 1, PLACES)?;
        let near = Enclosures::of_angle(1, vertex.valence, PLACES).to_interval(&lambda);
        let square = Interval::new(&near.lo * &near.lo, &near.hi * &near.hi);
        let pieces = pieces(blocks);
        let mut guesses = guess(vertex, blocks, &pieces);
        let value = to_f64(&near.mid());
        let own = |g: &Guess| blocks[pieces[g.piece].block].frequency == 1 && (g.re - value).abs() + g.im.abs() < NEAR;
        let at = guesses.iter().position(own)?;
        let leading = guesses.swap_remove(at).piece;
        guesses.sort_by(|a, b| b.modulus.total_cmp(&a.modulus));
        let mut rest = Self { vertex, blocks, top, pieces, guesses, square, lambda };
        rest.pieces.swap(0, leading);
        for g in &mut rest.guesses {
            g.piece = if g.piece == leading {
                0
            } else if g.piece == 0 {
                leading
            } else {
                g.piece
            };
        }
        Some(rest)
    }

    /// The polynomial of a piece without the leading eigenvalue, which is in the first.
    fn poly(&self, index: usize) -> (Enclosures, Vec<Fixed>) {
        let field = field_of(self.vertex, &self.blocks[self.pieces[index].block], PLACES);
        let poly = coefficients(&field, &self.pieces[index].poly);
        let poly = if index == 0 { deflate(&field, &poly, &self.lambda) } else { poly };
        (field, poly)
    }

    /// Whether all eigenvalues of all pieces but some are certainly below a bound.
    fn below(&self, bound: &Rational, but: &[usize]) -> bool {
        (0..self.pieces.len()).filter(|i| !but.contains(i)).all(|i| {
            let (field, poly) = self.poly(i);
            all_below(&field, &poly, bound)
        })
    }

    #[allow(clippy::float_arithmetic, reason = "proposes the case; each is proved")]
    fn size(&self) -> Option<Curvature> {
        let square = to_f64(&self.square.mid());
        let most = self.guesses.first().map_or(0.0, |g| g.modulus);
        if most < square * (1.0 - NEAR) {
            let bound = from_float(f64::midpoint(most, square)).min(self.square.lo.clone());
            self.below(&bound, &[]).then_some(())?;
            let ratio = Interval::new(Rational::from(0), &bound / &self.square.lo);
            return Some(self.of(Size::Vanishing, ratio, None));
        }
        if most > square * (1.0 + NEAR) { self.unbounded() } else { self.equal() }
    }

    fn of(&self, size: Size, ratio: Interval, blocks: Option<Vec<usize>>) -> Curvature {
        Curvature { size, second: Second::Open, ratio, power: 0, exponent: None, blocks }
    }

    /// The largest eigenvalue is real, simple in its block and certainly larger than `λ²`.
    #[allow(
        clippy::float_arithmetic,
        reason = "proposes the eigenvalue and a bound beyond it; the exponent is a decimal"
    )]
    fn unbounded(&self) -> Option<Curvature> {
        let first = self.guesses.first().filter(|g| g.im.abs() < NEAR)?;
        let (field, poly) = self.poly(first.piece);
        let value = newton(&field, &poly, &around(&from_float(first.re)))?;
        let value = field.to_interval(&value);
        let (low, high) = (abs(&value.lo).min(abs(&value.hi)), abs(&value.lo).max(abs(&value.hi)));
        if value.contains_zero() || low <= self.square.hi {
            return None;
        }
        let beyond = from_float(first.modulus * (1.0 + 1e-6)).max(high.clone());
        self.below(&beyond, &[]).then_some(())?;
        let next = self.guesses.get(1).map_or(0.0, |g| g.modulus);
        let lower = from_float(f64::midpoint(next, first.modulus));
        // Alone in its modulus: all others are below a bound, where this one is divided out.
        let alone = lower < low && self.below(&lower, &[first.piece]) && {
            let (field, poly) = self.poly(first.piece);
            let exact = newton(&field, &poly, &around(&from_float(first.re)))?;
            all_below(&field, &deflate(&field, &poly, &exact), &lower)
        };
        let blocks = alone.then(|| vec![self.blocks[self.pieces[first.piece].block].frequency]);
        let lambda = to_f64(&self.square.mid()).sqrt();
        let exponent = -2.0 * lambda.ln() / (first.modulus.ln() - 2.0 * lambda.ln());
        let ratio = Interval::new(
            &low / &self.square.hi,
            if alone { &high / &self.square.lo } else { &beyond / &self.square.lo },
        );
        Some(Curvature { exponent: Some(exponent), ..self.of(Size::Unbounded, ratio, blocks) })
    }

    fn equal(&self) -> Option<Curvature> {
        if self.vertex.valence > EXACT {
            return None;
        }
        match &self.top.rational {
            Some(q) => self.equal_rational(&(q * q)),
            None => self.equal_in_block_0(),
        }
    }

    /// All eigenvalues of the largest modulus are `q` and `−q`.
    #[allow(clippy::float_arithmetic, reason = "proposes a bound of the others")]
    fn equal_rational(&self, q: &Rational) -> Option<Curvature> {
        let square = to_f64(q);
        let next = self.guesses.iter().find(|g| g.modulus < square * (1.0 - 1e-4)).map_or(0.0, |g| g.modulus);
        let bound = from_float(f64::midpoint(square, next));
        let mut chains: Vec<(usize, bool, usize)> = Vec::new();
        for (b, block) in self.blocks.iter().enumerate() {
            let field = number_field(self.vertex, block);
            let mut counts = [0_usize; 2];
            for (i, piece) in self.pieces.iter().enumerate().filter(|(_, p)| p.block == b) {
                let mut poly: Vec<_> = piece.poly.iter().map(|c| field.eval(c, &field.twice_cosine())).collect();
                for (side, root) in [q.clone(), -q].iter().enumerate() {
                    let root = field.rational(root);
                    while poly.len() > 1 && evaluate(&field, &poly, &root).is_zero() {
                        poly = deflate(&field, &poly, &root);
                        counts[side] += 1;
                    }
                }
                let enclosures = field_of(self.vertex, block, PLACES);
                let near: Vec<Fixed> =
                    poly.iter().map(|c| enclosures.interval(&field.enclosure(c, enclosures.bits))).collect();
                let near = if i == 0 { deflate(&enclosures, &near, &self.lambda) } else { near };
                if !all_below(&enclosures, &near, &bound) {
                    return None;
                }
            }
            for (side, root) in [q.clone(), -q].iter().enumerate().filter(|(side, _)| counts[*side] > 0) {
                let sizes = longest_blocks(&field, block, root);
                if sizes.iter().sum::<usize>() != counts[side] {
                    return None;
                }
                chains.extend(sizes.into_iter().map(|size| (block.frequency, side == 1, size)));
            }
        }
        let longest = chains.iter().map(|c| c.2).max()?;
        chains.retain(|c| c.2 == longest);
        let mut blocks: Vec<usize> = chains.iter().map(|c| c.0).collect();
        blocks.dedup();
        let one = Interval::point(Rational::from(1));
        let size = if longest > 1 { Size::Unbounded } else { Size::Bounded };
        let mut found = self.of(size, one, Some(blocks));
        found.power = longest - 1;
        found.exponent = (longest > 1).then_some(f64::INFINITY);
        if longest == 1 && chains.iter().any(|c| c.1) {
            found.second = Second::No;
        }
        Some(found)
    }

    /// `λ²` is a simple eigenvalue of block 0: the remainder of its polynomial at `x²` by that of `λ` is 0.
    #[allow(clippy::float_arithmetic, reason = "proposes a bound of the others")]
    fn equal_in_block_0(&self) -> Option<Curvature> {
        let near: Vec<&Guess> =
            self.guesses.iter().filter(|g| g.modulus > to_f64(&self.square.mid()) * (1.0 - 1e-6)).collect();
        let [only] = near.as_slice() else { return None };
        let block = &self.blocks[self.pieces[only.piece].block];
        if block.frequency != 0 || self.top.angle != block.angle {
            return None;
        }
        let field = number_field(self.vertex, block);
        let at = |p: &crate::poly::Poly| field.eval(p, &field.twice_cosine());
        let (own, leading): (Vec<_>, Vec<_>) =
            (self.pieces[only.piece].poly.iter().map(at).collect(), self.top.poly.iter().map(at).collect());
        let mut squares = vec![field.zero(); 2 * own.len() - 1];
        own.into_iter().enumerate().for_each(|(i, c)| squares[2 * i] = c);
        if leading.len() < 2 || leading[leading.len() - 1] != field.one() {
            return None;
        }
        while squares.len() >= leading.len() {
            let last = squares.pop()?;
            let start = squares.len() + 1 - leading.len();
            for (i, c) in leading[..leading.len() - 1].iter().enumerate() {
                squares[start + i] = field.sub(&squares[start + i], &field.mul(&last, c));
            }
        }
        if squares.iter().any(|c| !c.is_zero()) {
            return None;
        }
        let (enclosures, poly) = self.poly(only.piece);
        let value = newton(&enclosures, &poly, &around(&from_float(only.re)))?;
        let next = self.guesses.iter().find(|g| g.modulus < only.modulus * (1.0 - 1e-6)).map_or(0.0, |g| g.modulus);
        let bound = from_float(f64::midpoint(only.modulus, next));
        let apart = bound < self.square.lo
            && self.below(&bound, &[only.piece])
            && all_below(&enclosures, &deflate(&enclosures, &poly, &value), &bound);
        apart.then(|| self.of(Size::Bounded, Interval::point(Rational::from(1)), Some(vec![0])))
    }

    /// Whether eigenfunctions of `λ²` are quadratic in the characteristic map: two points with different quotients refute it.
    fn quadratic(&self, found: &Curvature) -> Second {
        let n = self.vertex.valence;
        if self.vertex.rule.regular_at(n) {
            return Second::Regular;
        }
        let Some(blocks) = &found.blocks else { return Second::Open };
        // The frequency 2 among those up to n/2.
        let double = if n == 3 { 1 } else { 2 };
        if found.second == Second::No || blocks.iter().any(|k| *k != 0 && *k != double) {
            return Second::No;
        }
        let differs = blocks.iter().any(|k| (*k == 0 || (*k == 2 && 4 < n)) && self.differs(*k).is_some_and(|d| d));
        if differs { Second::No } else { Second::Open }
    }

    /// The eigenfunction of `λ²` in a block.
    fn height(&self, k: usize) -> Option<Vec<Turning<Fixed>>> {
        let block = self.blocks.iter().find(|b| b.frequency == k)?;
        let field = field_of(self.vertex, block, PLACES);
        let values = match &self.top.rational {
            Some(q) => {
                let exact = number_field(self.vertex, block);
                convert(&exact, &field, &leading_vector(&exact, block, &(q * q))?)
            }
            None => {
                // The only one that is not certainly smaller.
                let piece = &self.pieces[self.guesses.first()?.piece];
                if piece.block != self.blocks.iter().position(|b| b.frequency == k)? {
                    return None;
                }
                super::solve::eigenvector(&field, block, piece.part, &field.mul(&self.lambda, &self.lambda))?
            }
        };
        let values =
            if k == 0 || block.angle == k { values } else { super::top::turned(self.vertex, &values, k, PLACES)? };
        let angle = if k == 0 {
            Enclosures::of_angle(0, 1, PLACES)
        } else {
            Enclosures::of_angle(k, self.vertex.valence, PLACES)
        };
        Some(spots(&angle, patches(self.vertex, &angle, &values)?))
    }

    /// Whether the eigenfunction `H` of block 0 or 2 is no multiple of `|Ψ|²` or `Ψ²`.
    fn differs(&self, k: usize) -> Option<bool> {
        let f = Enclosures::of_angle(1, self.vertex.valence, PLACES);
        let rotation = Rotation(&f);
        let map = leading_values(self.vertex, self.blocks, self.top, 1, PLACES)?;
        let places = spots(&f, patches(self.vertex, &f, &map)?);
        let quadratic = |z: &Turning<Fixed>| if k == 0 { rotation.plain(rotation.norm(z)) } else { rotation.mul(z, z) };
        // ω of block 0 is 1, and that of block 2 is ω² = tω − 1.
        let t = f.twice_cosine();
        let own = |h: &Turning<Fixed>| {
            if k == 0 {
                rotation.plain(f.add(&h.x, &h.y))
            } else {
                Turning { x: f.sub(&h.x, &h.y), y: f.mul(&t, &h.y) }
            }
        };
        let all: Vec<_> = self.height(k)?.iter().map(own).zip(places.iter().map(quadratic)).collect();
        let (h, z) = all.first()?;
        Some(all.iter().any(|(g, w)| {
            let difference = rotation.sub(&rotation.mul(h, w), &rotation.mul(g, z));
            [&difference.x, &difference.y].into_iter().any(|c| f.sign(c).is_some_and(|s| s != 0))
        }))
    }
}

/// The values at the corners of patches and of their halves.
fn spots(k: &Enclosures, nets: Vec<Net<Turning<Fixed>>>) -> Vec<Turning<Fixed>> {
    let half = |a: &Turning<Fixed>, b: &Turning<Fixed>| Rotation(k).scale(&Rotation(k).add(a, b), &ratio(1, 2));
    nets.into_iter()
        .flat_map(|net| {
            let (left, right) = net.halves_by(half);
            [left, right].into_iter().flat_map(|n| n.corners().into_iter().cloned().collect::<Vec<_>>())
        })
        .collect()
}
