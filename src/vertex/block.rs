//! The Fourier blocks of a scheme at a vertex: frequency `k` turns by `θ = 2πk/n` from sector to sector.
//!
//! A point of orbit `o` in sector `s` has the value `ω^s v_o`. In the blocks `k ≠ 0` the centre is 0 and the entries are
//! the same Laurent polynomials in `ω` for every valence, unless the weights at the centre depend on it. In the block 0 the
//! values do not change from sector to sector and the centre joins them; entries may there depend on `cos(2π/n)`.

use super::cosine::{gcd, minimal_polynomial};
use super::ring::RINGS;
use super::turning::Symbol;
use crate::arith::{Rational, ratio};
use crate::linalg::{Matrix, strong_components};
use crate::poly::Poly;
use crate::scheme::{Corners, MeshRule, SchemeError, SectorStencils, Weight, cosine_stencils, sector_stencils};
use std::ops::Add;

/// So many rings more are tried for a rule by stencils of one's own, until they determine themselves.
const MORE_RINGS: usize = 4;

/// A scheme at a vertex (for dual schemes: in a face) of one valence.
#[derive(Debug, Clone)]
pub struct Vertex {
    /// The rule.
    pub rule: MeshRule,
    /// The valence.
    pub valence: usize,
    /// The rings of points.
    pub rings: usize,
    /// The stencils; where weights at the centre are irrational, those of a rational stand-in.
    pub stencils: SectorStencils,
    /// The stencils of a rule by stencils of one's own where some are irrational, with weights in `t = 2cos(2π/n)`.
    irrational: Option<SectorStencils<Poly>>,
}

/// One Fourier block. Index 0 is the centre in the block 0 of a scheme that has one; then come the orbits.
#[derive(Debug, Clone)]
pub struct Block {
    /// The frequency.
    pub frequency: usize,
    /// The angle of `t = 2 cos θ` and `ω` in the entries, as a multiple of `2π/n`: the frequency; 1 in the block 0, and in all
    /// blocks where weights at the centre are irrational.
    pub angle: usize,
    /// The entries.
    pub entries: Vec<Vec<Symbol>>,
    /// How many indices stand before the orbits.
    pub before: usize,
    /// The strongly connected parts, each after those that it depends on.
    pub parts: Vec<Part>,
}

/// A strongly connected part of a block.
#[derive(Debug, Clone)]
pub struct Part {
    /// Its indices in the block.
    pub indices: Vec<usize>,
    /// Its characteristic polynomial, from the constant coefficient up; the coefficients are polynomials in `t`.
    pub poly: Vec<Poly>,
}

impl Vertex {
    /// The scheme at a vertex.
    ///
    /// # Errors
    /// As for [`crate::scheme::local_matrix`], but for the weights that may be irrational.
    pub fn new(rule: &MeshRule, valence: usize, rings: usize) -> Result<Self, SchemeError> {
        rule.check_at(valence)?;
        let (stencils, irrational) = match cosine_stencils(rule, valence, rings)? {
            Some(found) => match rational_stencils(&found) {
                (stencils, true) => (stencils, None),
                (stencils, false) => (stencils, Some(found)),
            },
            None => (sector_stencils(&stand_in(rule, valence, 0), valence, rings)?, None),
        };
        let vertex = Self { rule: rule.clone(), valence, rings, stencils, irrational };
        vertex.check()?;
        Ok(vertex)
    }

    /// The scheme on as few rings as determine themselves and hold what decides the ring of patches, or of cells.
    ///
    /// # Errors
    /// As for [`Vertex::new`].
    pub fn examined(rule: &MeshRule, valence: usize) -> Result<Self, SchemeError> {
        let least = match rule.info().spline {
            Some(_) => RINGS * rule.regular_from() as usize - (rule.regular_from() as usize - 1),
            None => RINGS,
        };
        if rule.own().is_none() {
            return Self::new(rule, valence, least);
        }
        for rings in least..least + MORE_RINGS {
            match Self::new(rule, valence, rings) {
                Err(SchemeError::Rings { .. }) => {}
                found => return found,
            }
        }
        Self::new(rule, valence, least + MORE_RINGS)
    }

    /// The weights of the new points of an orbit and that of the centre in them, where they are rational.
    #[must_use]
    pub fn rational_row(&self, orbit: usize) -> Option<(&[Weight], &Rational)> {
        let plain = |p: &Poly| p.degree().is_none_or(|d| d == 0);
        let known = self
            .irrational
            .as_ref()
            .is_none_or(|s| s.rows[orbit].iter().all(|(_, _, w)| plain(w)) && plain(&s.from_centre[orbit]));
        known.then(|| (self.stencils.rows[orbit].as_slice(), &self.stencils.from_centre[orbit]))
    }

    /// Whether some weights are irrational that stencils of one's own give.
    #[must_use]
    pub fn is_irrational(&self) -> bool {
        self.irrational.is_some()
    }

    /// The weights of new points add up to 1.
    fn check(&self) -> Result<(), SchemeError> {
        if let Some(s) = &self.irrational {
            let modulus = minimal_polynomial(self.valence);
            let one = Poly::constant(ratio(1, 1));
            for (row, own) in s.rows.iter().zip(&s.from_centre) {
                let sum = row.iter().fold(own.clone(), |sum, (_, _, w)| &sum + w).div_rem(&modulus).1;
                if sum != one {
                    return Err(SchemeError::Weights { rule: self.rule.name(), sum: sum.coeff(0) });
                }
            }
            return Ok(());
        }
        let s = &self.stencils;
        for (row, own) in s.rows.iter().zip(&s.from_centre) {
            let sum = row.iter().fold(own.clone(), |sum, (_, _, w)| sum + w);
            if sum != 1 {
                return Err(SchemeError::Weights { rule: self.rule.name(), sum });
            }
        }
        Ok(())
    }

    /// The frequencies `0 … n/2`; the others are their mirror images.
    #[must_use]
    pub fn frequencies(&self) -> std::ops::RangeInclusive<usize> {
        0..=self.valence / 2
    }

    /// The orbit at a place.
    #[must_use]
    pub fn orbit(&self, place: (usize, usize)) -> Option<usize> {
        self.stencils.places.iter().position(|p| *p == place)
    }

    /// The block of a frequency.
    ///
    /// # Errors
    /// [`SchemeError`] of the stencils; [`SchemeError::Asymmetric`] where a characteristic polynomial is not real (a scheme
    /// without mirror symmetry).
    pub fn block(&self, frequency: usize) -> Result<Block, SchemeError> {
        let (entries, before, angle) = self.entries(frequency)?;
        let part = |indices: Vec<usize>| {
            let poly = self.characteristic(&entries, &indices, angle)?;
            Ok(Part { indices, poly })
        };
        let parts = strong_parts(entries.len(), |i, j| !entries[i][j].is_zero());
        let parts = parts.into_iter().map(part).collect::<Result<_, SchemeError>>()?;
        Ok(Block { frequency, angle, entries, before, parts })
    }

    /// The entries of a block, how many indices stand before the orbits, and the angle of `t` in the entries.
    pub(super) fn entries(&self, frequency: usize) -> Result<(Vec<Vec<Symbol>>, usize, usize), SchemeError> {
        match (&self.irrational, frequency) {
            (Some(s), 0) => Ok(still_over(s)),
            (Some(s), k) => Ok((self.turning_over(s, k), 0, 1)),
            (None, 0) => self.still(),
            (None, k) => Ok((self.turning(k), 0, k)),
        }
    }

    /// The characteristic polynomial of the entries among some indices.
    pub(super) fn characteristic(
        &self,
        entries: &[Vec<Symbol>],
        indices: &[usize],
        angle: usize,
    ) -> Result<Vec<Poly>, SchemeError> {
        let inner: Vec<Vec<Symbol>> =
            indices.iter().map(|i| indices.iter().map(|j| entries[*i][*j].clone()).collect()).collect();
        let modulus = self.is_irrational().then(|| minimal_polynomial(self.valence));
        let coefficients = characteristic(&inner, modulus.as_ref());
        let angle_polynomial = minimal_polynomial(self.valence / gcd(angle, self.valence));
        if coefficients.iter().any(|c| !c.y.div_rem(&angle_polynomial).1.is_zero()) {
            return Err(SchemeError::Asymmetric { rule: self.rule.name() });
        }
        Ok(coefficients.into_iter().map(|c| c.x).collect())
    }

    /// A block of a frequency other than 0 over `Q(2cos(2π/n))`.
    fn turning_over(&self, s: &SectorStencils<Poly>, k: usize) -> Vec<Vec<Symbol>> {
        let modulus = minimal_polynomial(self.valence);
        let n = self.valence as i64;
        let mut powers = vec![Symbol::constant(&ratio(1, 1))];
        for _ in 1..n {
            powers.push(powers[powers.len() - 1].mul(&Symbol::power(1, &ratio(1, 1))).reduced(&modulus));
        }
        let size = s.rows.len();
        let mut entries = vec![vec![Symbol::constant(&ratio(0, 1)); size]; size];
        for (own, weights) in entries.iter_mut().zip(&s.rows) {
            for (orbit, shift, weight) in weights {
                let power = &powers[(shift * k as i64).rem_euclid(n) as usize];
                own[*orbit] = own[*orbit].add(&power.mul(&Symbol::real(weight.clone())).reduced(&modulus));
            }
        }
        entries
    }

    /// A block of a frequency other than 0.
    fn turning(&self, k: usize) -> Vec<Vec<Symbol>> {
        let size = self.stencils.rows.len();
        let mut entries = vec![vec![Symbol::constant(&ratio(0, 1)); size]; size];
        let central = self.central(k);
        for (own, (row, weights)) in entries.iter_mut().zip(&self.stencils.rows).enumerate() {
            if let Some((_, weight)) = central.as_ref().filter(|c| c.0 == own) {
                row[own] = weight.clone();
                continue;
            }
            for (orbit, shift, weight) in weights {
                row[*orbit] = row[*orbit].add(&Symbol::power(*shift, weight));
            }
        }
        if 2 * k == self.valence {
            // ω = −1 and t = −2.
            let collapse = |s: &Symbol| {
                let at = ratio(-2, 1);
                Symbol::constant(&(s.x.eval(&at) - s.y.eval(&at)))
            };
            entries = entries.iter().map(|row| row.iter().map(collapse).collect()).collect();
        }
        entries
    }

    /// The orbit whose new points depend on their own orbit only, with weights that depend on the frequency.
    fn central(&self, k: usize) -> Option<(usize, Symbol)> {
        let (place, wheel) = match self.rule.corners(self.valence, true) {
            Some(Corners::Wheel(wheel)) => ((0, 0), wheel),
            Some(Corners::List(_)) => return None,
            None => ((1, 0), self.rule.spokes(self.valence)?),
        };
        Some((self.orbit(place)?, Symbol::real(wheel.eigenvalue(k))))
    }

    /// The block 0: entries, the indices before the orbits, the angle.
    fn still(&self) -> Result<(Vec<Vec<Symbol>>, usize, usize), SchemeError> {
        let Some(weight) = irrational_weight(&self.rule, self.valence) else {
            let rational = self.still_rational(&self.stencils);
            let entries = rational.iter().map(|row| row.iter().map(Symbol::constant).collect()).collect();
            return Ok((entries, usize::from(self.stencils.centre.is_some()), 1));
        };
        // The entries are polynomials in the weight of a degree not above the number of steps: interpolate.
        let steps = self.rule.steps();
        let mut samples = Vec::new();
        // The own stencils are those of the weight 0.
        samples.push(self.still_rational(&self.stencils));
        for w in 1..=steps {
            let stencils = sector_stencils(&stand_in(&self.rule, self.valence, w), self.valence, self.rings)?;
            samples.push(self.still_rational(&stencils));
        }
        let size = samples[0].len();
        let entry = |i: usize, j: usize| {
            let values: Vec<&Rational> = samples.iter().map(|s| &s[i][j]).collect();
            let polynomial = interpolate(&values);
            Symbol::real(compose(&polynomial, &weight))
        };
        let entries = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
        Ok((entries, usize::from(self.stencils.centre.is_some()), 1))
    }

    fn still_rational(&self, s: &SectorStencils) -> Vec<Vec<Rational>> {
        let before = usize::from(s.centre.is_some());
        let mut entries = summed(s, &ratio(0, 1));
        if let Some((orbit, weight)) = self.central(0) {
            let own = weight.x.coeff(0);
            entries[orbit + before].fill(ratio(0, 1));
            if before == 1 {
                entries[orbit + before][0] = ratio(1, 1) - &own;
            }
            entries[orbit + before][orbit + before] = own;
        }
        entries
    }
}

/// The block 0 over `Q(2cos(2π/n))`.
fn still_over(s: &SectorStencils<Poly>) -> (Vec<Vec<Symbol>>, usize, usize) {
    let entries = summed(s, &Poly::zero());
    let before = usize::from(s.centre.is_some());
    (entries.into_iter().map(|row| row.into_iter().map(Symbol::real).collect()).collect(), before, 1)
}

/// The entries of block 0: the weights of an orbit in all sectors together, the centre first where it is a point.
fn summed<W: Clone>(s: &SectorStencils<W>, zero: &W) -> Vec<Vec<W>>
where
    for<'a> &'a W: Add<Output = W>,
{
    let before = usize::from(s.centre.is_some());
    let size = s.rows.len() + before;
    let mut entries = vec![vec![zero.clone(); size]; size];
    if let Some((own, sums)) = &s.centre {
        // The stencil of the centre has every sector's weights already.
        entries[0][0].clone_from(own);
        entries[0][1..].clone_from_slice(sums);
    }
    for (i, weights) in s.rows.iter().enumerate() {
        if before == 1 {
            entries[i + 1][0].clone_from(&s.from_centre[i]);
        }
        for (orbit, _, weight) in weights {
            let entry = &mut entries[i + before][orbit + before];
            *entry = &*entry + weight;
        }
    }
    entries
}

/// The stencils with their rational weights, and whether that is all of them; a row with others is left empty.
fn rational_stencils(s: &SectorStencils<Poly>) -> (SectorStencils, bool) {
    let number = |w: &Poly| w.degree().is_none_or(|d| d == 0).then(|| w.coeff(0));
    let mut all = true;
    let (mut rows, mut from_centre) = (Vec::new(), Vec::new());
    for (row, own) in s.rows.iter().zip(&s.from_centre) {
        let plain: Option<Vec<Weight>> = row.iter().map(|(o, shift, w)| Some((*o, *shift, number(w)?))).collect();
        let found = plain.zip(number(own));
        all &= found.is_some();
        let (row, own) = found.unwrap_or_else(|| (Vec::new(), ratio(0, 1)));
        rows.push(row);
        from_centre.push(own);
    }
    let centre = s.centre.as_ref().map(|(own, sums)| {
        let found = number(own).zip(sums.iter().map(number).collect::<Option<Vec<_>>>());
        all &= found.is_some();
        found.unwrap_or_else(|| (ratio(0, 1), vec![ratio(0, 1); sums.len()]))
    });
    (SectorStencils { places: s.places.clone(), rows, from_centre, centre, sector: s.sector, steps: s.steps }, all)
}

/// The irrational weight at the centre as a polynomial in `t = 2cos(2π/n)`: the weight of all neighbours together.
fn irrational_weight(rule: &MeshRule, valence: usize) -> Option<Poly> {
    Some(rule.star(valence, true)?.near).filter(|p| p.degree().is_some_and(|d| d > 0))
}

/// A rule with rational weights; `weight` takes the place of [`irrational_weight`].
fn stand_in(rule: &MeshRule, valence: usize, weight: usize) -> MeshRule {
    if irrational_weight(rule, valence).is_some() {
        return rule.with_near(Rational::from(weight as u64));
    }
    match rule.corners(valence, true) {
        Some(Corners::Wheel(wheel)) if wheel.waving() => {
            rule.with_corners(vec![Rational::from(1) / Rational::from(valence as u64); valence])
        }
        _ if rule.spokes(valence).is_some() => rule.regular(),
        _ => rule.clone(),
    }
}

/// The polynomial with the given values at 0, 1, 2, ….
fn interpolate(values: &[&Rational]) -> Poly {
    let mut sum = Poly::zero();
    for (k, value) in values.iter().enumerate() {
        let mut basis = Poly::constant((*value).clone());
        for l in (0..values.len()).filter(|l| *l != k) {
            let factor = Poly::linear(&Rational::from(l as u64)).scale(&ratio(1, k as i64 - l as i64));
            basis = &basis * &factor;
        }
        sum = &sum + &basis;
    }
    sum
}

fn compose(outer: &Poly, inner: &Poly) -> Poly {
    outer.coeffs().iter().rev().fold(Poly::zero(), |v, c| &(&v * inner) + &Poly::constant(c.clone()))
}

/// The strongly connected parts of a matrix with these entries other than 0, each after those that it depends on.
pub(super) fn strong_parts(size: usize, entry: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    strong_components(&Matrix::from_fn(size, size, |i, j| ratio(i64::from(entry(i, j)), 1)))
}

/// The characteristic polynomial, from the constant coefficient up (Faddeev and LeVerrier); with coordinates modulo a polynomial,
/// where one is given.
fn characteristic(a: &[Vec<Symbol>], modulus: Option<&Poly>) -> Vec<Symbol> {
    let n = a.len();
    let zero = || Symbol::constant(&ratio(0, 1));
    let mut coefficients = vec![Symbol::constant(&ratio(1, 1))];
    // M_1 = 1, c_{n−k} = −tr(A M_k)/k, M_{k+1} = A M_k + c_{n−k}.
    let mut m: Vec<Vec<Symbol>> =
        (0..n).map(|i| (0..n).map(|j| Symbol::constant(&ratio(i64::from(i == j), 1))).collect()).collect();
    for k in 1..=n {
        let mut product = vec![vec![zero(); n]; n];
        for (i, row) in product.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                for (l, inner) in m.iter().enumerate() {
                    *entry = entry.add(&a[i][l].mul(&inner[j]));
                }
                if let Some(modulus) = modulus {
                    *entry = entry.reduced(modulus);
                }
            }
        }
        let trace = (0..n).fold(zero(), |s, i| s.add(&product[i][i]));
        let c = trace.scale(&ratio(-1, k as i64));
        for (i, row) in product.iter_mut().enumerate() {
            row[i] = row[i].add(&c);
        }
        coefficients.push(c);
        m = product;
    }
    coefficients.reverse();
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(name: &str) -> MeshRule {
        crate::scheme::mesh_rule(name, &[].into()).unwrap()
    }

    fn text(part: &Part) -> Vec<String> {
        part.poly.iter().map(|p| p.display("t")).collect()
    }

    #[test]
    fn the_published_polynomials() {
        let cc = Vertex::new(&rule("catmull-clark"), 5, 3).unwrap();
        let block = cc.block(1).unwrap();
        // x² − (10 + 2c)/16 x + 1/16.
        let inner = block.parts.iter().find(|p| p.indices.len() == 2).unwrap();
        assert_eq!(text(inner), ["1/16", "-1/16t - 5/8", "1"]);
        let lp = Vertex::new(&rule("loop"), 5, 3).unwrap();
        assert!(lp.block(2).unwrap().parts.iter().any(|p| text(p) == ["-1/8t - 3/8", "1"]));
        let still = lp.block(0).unwrap();
        // (x − 1)(x − (3/8 + c/4)²).
        let inner = still.parts.iter().find(|p| p.indices.contains(&0)).unwrap();
        assert_eq!(text(inner), ["1/64t^2 + 3/32t + 9/64", "-1/64t^2 - 3/32t - 73/64", "1"]);
        let sqrt3 = Vertex::new(&rule("sqrt3"), 7, 3).unwrap();
        assert!(sqrt3.block(3).unwrap().parts.iter().any(|p| text(p) == ["-1/9t - 2/9", "1"]));
        let midedge = Vertex::new(&rule("midedge"), 5, 3).unwrap();
        assert!(midedge.block(2).unwrap().parts.iter().any(|p| text(p) == ["-1/4t - 1/2", "1"]));
    }

    #[test]
    fn the_blocks_of_a_variant() {
        let weights = [("alpha".to_owned(), ratio(3, 4)), ("beta".to_owned(), ratio(1, 4))].into();
        let v = Vertex::new(&crate::scheme::mesh_rule("catmull-clark-variant", &weights).unwrap(), 5, 3).unwrap();
        let block = v.block(0).unwrap();
        let inner = block.parts.iter().find(|p| p.indices.contains(&0)).unwrap();
        // (x − 1)(x² − (α − 1/4)x + (1/2 − β)/8).
        let p = &Poly::linear(&ratio(1, 1)) * &Poly::new(vec![ratio(1, 32), ratio(-1, 2), ratio(1, 1)]);
        let found: Vec<Rational> = inner.poly.iter().map(|c| c.coeff(0)).collect();
        assert_eq!(found, p.coeffs());
    }

    #[test]
    fn rows_add_up_to_one_and_all_blocks_exist() {
        for info in crate::scheme::mesh_rules().iter().filter(|r| r.parameters.iter().all(|p| p.default.is_some())) {
            for n in [3, 4, 5, 6, 9] {
                let v = Vertex::new(&rule(info.name), n, 3).unwrap_or_else(|e| panic!("{} at {n}: {e}", info.name));
                for k in v.frequencies() {
                    let block = v.block(k).unwrap_or_else(|e| panic!("{} at {n}, block {k}: {e}", info.name));
                    if k == 0 {
                        for row in &block.entries {
                            let sum = row.iter().fold(Symbol::constant(&ratio(0, 1)), |s, e| s.add(e));
                            assert_eq!(sum, Symbol::constant(&ratio(1, 1)), "{} at {n}", info.name);
                        }
                    }
                }
            }
        }
    }
}
