//! How much some steps of a rule with a mask of factors shrink second differences (docs/theory.md, Lemma 4′).

use super::limit::{Regular, four, place, sources};
use super::mesh::Place;
use super::rule::{Lattice, Mask};
use crate::base::number::lcm;
use crate::base::{Checked, Q, need, some, spend};
use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};

/// The quotient of a mask by `1 + z^(−u)`.
fn quotient(mask: &Mask, u: Place) -> Checked<Mask> {
    // 1 + z^(−u) = z^(−u) (1 + z^u): the divisor begins at its least place.
    let (step, shift) = if u > (0, 0) { (u, u) } else { ((-u.0, -u.1), (0, 0)) };
    let (mut rest, mut found) = (mask.clone(), Mask::new());
    let most = mask.len() * mask.len();
    while let Some((p, c)) = rest.pop_first() {
        if c.is_zero() {
            continue;
        }
        need(found.len() <= most, "limits", "the mask has not the factors of second differences")?;
        *rest.entry((p.0 + step.0, p.1 + step.1)).or_insert_with(Q::zero) -= &c;
        found.insert((p.0 + shift.0, p.1 + shift.1), c);
    }
    Ok(found)
}

/// `R_0, …` from the factors of the mask (docs/theory.md, Lemma 4′).
pub fn by_factors(rule: &Lattice, regular: &Regular, pairs: &[[Place; 2]], count: usize) -> Checked<Vec<Q>> {
    need(rule.factor == 2, "limits", "factors are for rules that halve")?;
    let inside = |o: Place, pair: [Place; 2]| four(o, pair).iter().all(|p| regular.points.contains(p));
    let mut all = vec![Q::one()];
    all.resize(count + 1, Q::zero());
    for pair in pairs {
        let divided = quotient(&quotient(&rule.mask, pair[0])?, pair[1])?;
        for part in &regular.parts {
            for o in regular.points.iter().filter(|o| inside(**o, *pair)) {
                // In a part that lies upside down a difference begins at its opposite corner.
                let first = if part.1 == 1 { *o } else { four(*o, *pair)[3] };
                let known = sources(&divided, 2, place(part, first)).iter().all(|(q, _)| inside(*q, *pair));
                need(known, "limits", "second differences outside of a cell take part")?;
            }
        }
        let (whole, denominator) = numerators(&divided)?;
        let (mut product, mut unit) = (Grid { low: (0, 0), size: [1, 1], values: vec![1] }, Q::one());
        for step in 0..count {
            product = product.times(&whole, step)?;
            unit *= Q::from_integer(denominator.into()) / Q::from_integer(2.into());
            let worst = Q::from_integer(product.largest(2 << step)?.into()) / &unit;
            all[step + 1] = all[step + 1].clone().max(worst);
        }
    }
    Ok(all)
}

/// The weights of a mask times their common denominator.
fn numerators(mask: &Mask) -> Checked<(Vec<(Place, i128)>, i128)> {
    let denominator = mask.values().fold(BigInt::one(), |l, w| lcm(&l, w.denom()));
    let small = |x: BigInt| some(x.to_i128(), "limits", "weights are too long");
    let one = |(p, w): (&Place, &Q)| Ok((*p, small(w.numer() * &denominator / w.denom())?));
    let all = mask.iter().map(one).collect::<Checked<Vec<_>>>()?;
    need(!all.is_empty(), "limits", "a mask without weights")?;
    Ok((all, small(denominator)?))
}

/// Whole numbers on a rectangle of the lattice.
struct Grid {
    low: Place,
    size: [usize; 2],
    values: Vec<i128>,
}

fn overflow<T>(found: Option<T>) -> Checked<T> {
    some(found, "limit", "the weights of several steps are too long")
}

impl Grid {
    /// The product with a mask whose places are multiplied by `2^step`.
    fn times(&self, mask: &[(Place, i128)], step: usize) -> Checked<Self> {
        let bounds = |at: fn(&Place) -> i64| {
            let all = || mask.iter().map(|(p, _)| at(p));
            (all().fold(i64::MAX, i64::min), all().fold(i64::MIN, i64::max))
        };
        let ((left, right), (bottom, top)) = (bounds(|p| p.0), bounds(|p| p.1));
        let wide = |low: i64, high: i64| ((high - low) as usize) << step;
        let size = [self.size[0] + wide(left, right), self.size[1] + wide(bottom, top)];
        spend(self.values.len() * mask.len() + size[0] * size[1], 64)?;
        let mut values = vec![0_i128; size[0] * size[1]];
        for ((i, j), w) in mask {
            let corner = wide(left, *i) * size[1] + wide(bottom, *j);
            for (k, x) in self.values.iter().enumerate().filter(|(_, x)| **x != 0) {
                let value = &mut values[corner + k / self.size[1] * size[1] + k % self.size[1]];
                *value = overflow(x.checked_mul(*w).and_then(|product| value.checked_add(product)))?;
            }
        }
        Ok(Self { low: (self.low.0 + (left << step), self.low.1 + (bottom << step)), size, values })
    }

    /// The largest sum of absolute values on a class of places modulo a number.
    fn largest(&self, modulus: usize) -> Checked<i128> {
        let mut sums = vec![0_i128; modulus * modulus];
        for (k, x) in self.values.iter().enumerate() {
            let (i, j) = (self.low.0 + (k / self.size[1]) as i64, self.low.1 + (k % self.size[1]) as i64);
            let class = |v: i64| v.rem_euclid(modulus as i64) as usize;
            let sum = &mut sums[class(i) * modulus + class(j)];
            *sum = overflow(x.checked_abs().and_then(|size| sum.checked_add(size)))?;
        }
        overflow(sums.into_iter().max())
    }
}
