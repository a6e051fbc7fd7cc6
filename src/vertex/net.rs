//! Bernstein–Bézier nets of polynomials on triangles and squares: derivatives, products, halves, signs.

use super::field::Field;
use crate::arith::{Rational, binomial, ratio};

/// The Bernstein coefficients of a polynomial on a square or triangle.
///
/// `rows[r][s]` belongs to the `s`-th basis function of the first and the `r`-th of the second variable; on a triangle with
/// corners A, B, C to the weight `s` of B and `r` of C.
#[derive(Debug, Clone)]
pub struct Net<E> {
    /// On a triangle, row `r` is shorter than the first by `r`.
    pub triangle: bool,
    /// The coefficients.
    pub rows: Vec<Vec<E>>,
}

impl<E: Clone> Net<E> {
    /// The factor of the monomial behind a basis function.
    fn weight(&self, r: usize, s: usize) -> Rational {
        let (columns, rows) = (self.rows[0].len() - 1, self.rows.len() - 1);
        let inner = if self.triangle { columns - r } else { columns };
        binomial(rows, r) * binomial(inner, s)
    }

    /// The same net of other values.
    pub fn map<G>(&self, f: impl Fn(&E) -> G) -> Net<G> {
        let rows = self.rows.iter().map(|row| row.iter().map(&f).collect()).collect();
        Net { triangle: self.triangle, rows }
    }

    /// The derivatives in both variables, but for positive factors.
    pub fn derivatives<F: Field<E = E>>(&self, f: &F) -> (Self, Self) {
        let along: Vec<Vec<E>> =
            self.rows.iter().map(|row| row.windows(2).map(|w| f.sub(&w[1], &w[0])).collect()).collect();
        let across: Vec<Vec<E>> =
            self.rows.windows(2).map(|w| w[1].iter().zip(&w[0]).map(|(b, a)| f.sub(b, a)).collect()).collect();
        let along = along.into_iter().filter(|row: &Vec<E>| !row.is_empty()).collect();
        (Self { triangle: self.triangle, rows: along }, Self { triangle: self.triangle, rows: across })
    }

    /// `a b − c d`, where `a b` and `c d` have the same degrees.
    pub fn difference_of_products<F: Field<E = E>>(f: &F, (a, b): (&Self, &Self), (c, d): (&Self, &Self)) -> Self {
        let columns = a.rows[0].len() + b.rows[0].len() - 1;
        let rows = a.rows.len() + b.rows.len() - 1;
        let length = |r: usize| if a.triangle { columns - r } else { columns };
        let mut sum: Vec<Vec<E>> = (0..rows).map(|r| vec![f.zero(); length(r)]).collect();
        for (p, q, positive) in [(a, b, true), (c, d, false)] {
            let (p, q) = (p.scaled(f), q.scaled(f));
            for (r1, row1) in p.iter().enumerate() {
                for (s1, x) in row1.iter().enumerate() {
                    for (r2, row2) in q.iter().enumerate() {
                        for (s2, y) in row2.iter().enumerate() {
                            let product = f.mul(x, y);
                            let place = &mut sum[r1 + r2][s1 + s2];
                            *place = if positive { f.add(place, &product) } else { f.sub(place, &product) };
                        }
                    }
                }
            }
        }
        let mut net = Self { triangle: a.triangle, rows: sum };
        for r in 0..net.rows.len() {
            for s in 0..net.rows[r].len() {
                let factor = Rational::from(1) / net.weight(r, s);
                net.rows[r][s] = f.scale(&net.rows[r][s], &factor);
            }
        }
        net
    }

    fn scaled<F: Field<E = E>>(&self, f: &F) -> Vec<Vec<E>> {
        let scale =
            |(r, row): (usize, &Vec<E>)| row.iter().enumerate().map(|(s, x)| f.scale(x, &self.weight(r, s))).collect();
        self.rows.iter().enumerate().map(scale).collect()
    }

    /// The halves in the first variable; of a triangle, the parts A M C and M B C with the midpoint M of A B.
    pub fn halves<F: Field<E = E>>(&self, f: &F) -> (Self, Self) {
        let half = ratio(1, 2);
        self.halves_by(|a, b| f.scale(&f.add(a, b), &half))
    }

    /// As [`Net::halves`] of values of any kind, of which two have a mean.
    pub fn halves_by(&self, mean: impl Fn(&E, &E) -> E) -> (Self, Self) {
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for row in &self.rows {
            let mut level = row.clone();
            let (mut first, mut last) = (vec![level[0].clone()], vec![level[level.len() - 1].clone()]);
            while level.len() > 1 {
                level = level.windows(2).map(|w| mean(&w[0], &w[1])).collect();
                first.push(level[0].clone());
                last.push(level[level.len() - 1].clone());
            }
            last.reverse();
            left.push(first);
            right.push(last);
        }
        (Self { triangle: self.triangle, rows: left }, Self { triangle: self.triangle, rows: right })
    }

    /// The variables exchanged; of a triangle A B C, the same polynomial on B C A.
    #[must_use]
    pub fn turned(&self) -> Self {
        let size = self.rows[0].len();
        let entry = |r: usize, s: usize| {
            // On B C A: s is the weight of C, r that of A, and what remains that of B.
            if self.triangle { self.rows[s][size - 1 - r - s].clone() } else { self.rows[s][r].clone() }
        };
        let count = if self.triangle { size } else { self.rows[0].len() };
        let length = |r: usize| if self.triangle { size - r } else { self.rows.len() };
        let rows = (0..count).map(|r| (0..length(r)).map(|s| entry(r, s)).collect()).collect();
        Self { triangle: self.triangle, rows }
    }

    /// The values at the corners: A, B, C, and of a square the fourth.
    pub fn corners(&self) -> Vec<&E> {
        let (first, last) = (&self.rows[0], &self.rows[self.rows.len() - 1]);
        let mut all = vec![&first[0], &first[first.len() - 1], &last[0]];
        if !self.triangle {
            all.push(&last[last.len() - 1]);
        }
        all
    }
}

/// A point of a square or triangle: the two variables; on a triangle the weights of B and C.
pub type Spot = (Rational, Rational);

/// The corners of a whole square or triangle, in the order of [`Net::corners`].
#[must_use]
pub fn corners(triangle: bool) -> Vec<Spot> {
    let at = |u: i64, v: i64| (ratio(u, 1), ratio(v, 1));
    if triangle { vec![at(0, 0), at(1, 0), at(0, 1)] } else { vec![at(0, 0), at(1, 0), at(0, 1), at(1, 1)] }
}

fn middle(a: &Spot, b: &Spot) -> Spot {
    let half = ratio(1, 2);
    ((&a.0 + &b.0) * &half, (&a.1 + &b.1) * &half)
}

/// The corners of the halves of [`Net::halves`], each followed by [`Net::turned`].
#[must_use]
pub fn halved_corners(c: &[Spot]) -> (Vec<Spot>, Vec<Spot>) {
    let m = middle(&c[0], &c[1]);
    if c.len() == 3 {
        return (vec![m.clone(), c[2].clone(), c[0].clone()], vec![c[1].clone(), c[2].clone(), m]);
    }
    let n = middle(&c[2], &c[3]);
    (vec![c[0].clone(), c[2].clone(), m.clone(), n.clone()], vec![m, n, c[1].clone(), c[3].clone()])
}

/// What is known about the sign of a polynomial on squares and triangles.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Signs {
    /// A place where it is positive: the number of the patch, and the spot.
    pub positive: Option<(usize, Spot)>,
    /// A place where it is negative.
    pub negative: Option<(usize, Spot)>,
    /// A corner where it is exactly 0.
    pub zero: Option<(usize, Spot)>,
    /// A place whose surroundings were not decided.
    pub open: Option<(usize, Spot)>,
    /// The number of pieces on which all Bernstein coefficients had one sign.
    pub pieces: usize,
    /// The depth to which patches were halved.
    pub depth: usize,
}

impl Signs {
    /// The one sign of the polynomial everywhere, where it has one.
    #[must_use]
    pub fn strict(&self) -> Option<i32> {
        match (&self.positive, &self.negative, &self.zero, &self.open) {
            (Some(_), None, None, None) => Some(1),
            (None, Some(_), None, None) => Some(-1),
            _ => None,
        }
    }

    /// Whether both signs occur.
    #[must_use]
    pub fn changes(&self) -> bool {
        self.positive.is_some() && self.negative.is_some()
    }

    /// Examines one more patch, halving it where coefficients differ in sign, until both signs have been met.
    ///
    /// # Cost
    /// At most `2^(depth + 1)` nets.
    pub fn examine<F: Field>(&mut self, f: &F, patch: usize, net: Net<F::E>, depth: usize) {
        let places = corners(net.triangle);
        let mut stack = vec![(net, places, 0)];
        while let Some((net, places, level)) = stack.pop() {
            if self.changes() {
                return;
            }
            let one_sign = |wanted: i32| net.rows.iter().flatten().all(|c| f.sign(c) == Some(wanted));
            let leaf = if one_sign(1) {
                Some(1)
            } else if one_sign(-1) {
                Some(-1)
            } else {
                None
            };
            for (value, place) in net.corners().into_iter().zip(&places) {
                let mark = match f.sign(value) {
                    Some(0) => &mut self.zero,
                    Some(s) if s > 0 => &mut self.positive,
                    Some(_) => &mut self.negative,
                    None => continue,
                };
                mark.get_or_insert_with(|| (patch, place.clone()));
            }
            self.depth = self.depth.max(level);
            if leaf.is_some() {
                self.pieces += 1;
            } else if level == depth {
                self.open.get_or_insert_with(|| (patch, places[0].clone()));
            } else {
                let (left, right) = net.halves(f);
                let (first, second) = halved_corners(&places);
                stack.push((right.turned(), second, level + 1));
                stack.push((left.turned(), first, level + 1));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::Field as _;
    use crate::vertex::field::Enclosures;

    fn net(triangle: bool, rows: &[&[i64]], f: &Enclosures) -> Net<super::super::field::Fixed> {
        Net { triangle, rows: rows.iter().map(|r| r.iter().map(|x| f.rational(&ratio(*x, 1))).collect()).collect() }
    }

    #[test]
    fn signs_of_polynomials() {
        let f = Enclosures::of_angle(1, 4, 64);
        // x² + y² − xy/2-like saddles: mixed coefficients, positive values.
        let mut signs = Signs::default();
        signs.examine(&f, 0, net(false, &[&[4, -1, 4]], &f), 10);
        assert_eq!(signs.strict(), Some(1));
        assert!(signs.depth > 0);
        let mut signs = Signs::default();
        signs.examine(&f, 3, net(true, &[&[1, 1, 1], &[1, -5], &[1]], &f), 10);
        let (patch, spot) = signs.negative.clone().unwrap();
        assert!(signs.changes() && patch == 3);
        // 1 − 12·u·v at the witness, the product of the weights of B and C.
        assert!(ratio(1, 1) - ratio(12, 1) * spot.0 * spot.1 < 0);
        let mut signs = Signs::default();
        signs.examine(&f, 0, net(false, &[&[0, 1]], &f), 6);
        assert!(signs.strict().is_none() && signs.zero.is_some());
    }

    #[test]
    fn turning_three_times_is_nothing() {
        let f = Enclosures::of_angle(1, 4, 64);
        let n = net(true, &[&[1, 2, 3], &[4, 5], &[6]], &f);
        let once = n.turned();
        assert_eq!(once.rows[0], vec![n.rows[0][2].clone(), n.rows[1][1].clone(), n.rows[2][0].clone()]);
        assert_eq!(once.turned().turned().rows, n.rows);
        // x² y-like product on a triangle: (u)(v) has the coefficient 1/2 at the edge B C.
        let u = net(true, &[&[0, 1], &[0]], &f);
        let v = net(true, &[&[0, 0], &[1]], &f);
        let zero = net(true, &[&[0, 0], &[0]], &f);
        let product = Net::difference_of_products(&f, (&u, &v), (&zero, &zero));
        assert_eq!(product.rows[1][1], f.rational(&ratio(1, 2)));
    }
}
