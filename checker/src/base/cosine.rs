//! Cosines of parts of a turn, and the roots of a polynomial in an interval.

use super::{Checked, Matrix, Q, Surd, bits, spend, whole};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Binary places with which cosines are compared.
pub const PLACES: u64 = 96;

/// `T_q(x)`, the cosine of `q` times the angle with the cosine `x`.
pub fn chebyshev(x: &Matrix<Surd>, q: usize) -> Checked<Matrix<Surd>> {
    let (mut before, mut now) = (Matrix::identity(1), x.clone());
    for _ in 1..q {
        spend(1, now.bits())?;
        let next = now.multiple(x).scaled(&whole(2)).minus(&before).reduced();
        (before, now) = (now, next);
    }
    Ok(now)
}

/// An interval that holds `cos 2πp/q`, `0 <= p/q <= 1/2`.
pub fn cosine(p: usize, q: usize) -> Checked<[Q; 2]> {
    // 2^s times an arctangent of 1/k, by its series, with an error of less than 2^-s times that of one more term.
    let scale = BigInt::one() << (PLACES + 16);
    let arctangent = |k: u32| {
        let (mut sum, mut power, mut n) = (BigInt::zero(), &scale / k, 1u32);
        while !Zero::is_zero(&power) {
            let term = &power / n;
            sum += if n % 4 == 1 { term } else { -term };
            power /= k * k;
            n += 2;
        }
        sum
    };
    // Machin: π/4 = 4 arctan 1/5 − arctan 1/239. Each of fewer than 100 terms is wrong by less than 2.
    let pi = (arctangent(5) * 4 - arctangent(239)) * 4;
    let angle: BigInt = pi * (2 * p) / q;
    // The derivative is at most 1; the angle is wrong by less than 2^12, and the terms, fewer than 100, by less than 8 each.
    let square = &angle * &angle;
    let (mut sum, mut term, mut n) = (scale.clone(), scale.clone(), 0u32);
    while !Zero::is_zero(&term) {
        let next: BigInt = &term * &square / &scale / &scale;
        term = -next / ((n + 1) * (n + 2));
        sum += &term;
        n += 2;
        spend(4, 2 * PLACES)?;
    }
    let wrong = BigInt::from(1u32 << 14);
    Ok([Q::new(&sum - &wrong, scale.clone()), Q::new(sum + wrong, scale)])
}

/// Whether a polynomial has exactly one real root in a closed interval: the sign changes of its Sturm chain. No end may be a
/// root.
pub fn alone(p: &[Q], lo: &Q, hi: &Q) -> Checked<bool> {
    let trimmed = |mut p: Vec<Q>| {
        while p.last().is_some_and(Zero::is_zero) {
            p.pop();
        }
        p
    };
    let derivative = p.iter().enumerate().skip(1).map(|(k, c)| c * whole(k as i64)).collect();
    let (mut chain, mut next) = (vec![trimmed(p.to_vec())], trimmed(derivative));
    while !next.is_empty() {
        let mut rest = chain[chain.len() - 1].clone();
        while rest.len() >= next.len() {
            spend(rest.len(), 2 * bits(&rest[0]))?;
            let (factor, shift) = (&rest[rest.len() - 1] / &next[next.len() - 1], rest.len() - next.len());
            next.iter().enumerate().for_each(|(k, c)| rest[k + shift] -= &factor * c);
            rest.pop();
            rest = trimmed(rest);
        }
        chain.push(std::mem::replace(&mut next, rest.into_iter().map(|c| -c).collect()));
    }
    let value = |p: &Vec<Q>, x: &Q| p.iter().rev().fold(Q::zero(), |sum, c| sum * x + c);
    let changes = |x: &Q| {
        let signs: Vec<bool> =
            chain.iter().map(|p| value(p, x)).filter(|v| !v.is_zero()).map(|v| v.is_positive()).collect();
        signs.windows(2).filter(|w| w[0] != w[1]).count()
    };
    let ends = chain[0].len() > 1 && !value(&chain[0], lo).is_zero() && !value(&chain[0], hi).is_zero();
    Ok(ends && changes(lo) == changes(hi) + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosines_are_enclosed() {
        for (p, q, twice) in [(0, 1, 2), (1, 6, 1), (1, 4, 0), (1, 3, -1), (1, 2, -2)] {
            let [lo, hi] = cosine(p, q).unwrap();
            let exact = whole(twice) / whole(2);
            assert!(lo <= exact && exact <= hi && hi - lo < whole(1) / whole(1_000_000_000), "{p}/{q}");
        }
    }

    #[test]
    fn one_root_in_an_interval() {
        let p: Vec<Q> = [2, 0, -3, 0, 1].map(whole).into();
        // (x² − 1)(x² − 2)
        for (lo, hi, one) in [(0, 3, false), (-3, 3, false), (5, 6, false), (1, 2, false)] {
            assert_eq!(alone(&p, &whole(lo), &whole(hi)).unwrap(), one, "{lo} {hi}");
        }
        let half = |k: i64| whole(k) / whole(4);
        assert!(alone(&p, &half(3), &half(5)).unwrap() && alone(&p, &half(5), &half(6)).unwrap());
        // A double root is one.
        assert!(alone(&[1, -2, 1].map(whole), &whole(0), &whole(2)).unwrap());
    }
}
