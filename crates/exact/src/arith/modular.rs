//! Arithmetic modulo a word-size prime, in Montgomery form.

use super::{Integer, Natural, Rational};

/// The field of residues modulo an odd prime below `2^62`.
///
/// Elements are plain `u64` in Montgomery form, that is `x * 2^64 mod p`; zero is 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PrimeField {
    p: u64,
    neg_inverse: u64,
    r2: u64,
    one: u64,
}

impl PrimeField {
    /// The field with `p` elements.
    ///
    /// # Panics
    /// If `p` is even, below 3 or not below `2^62`. Primality is the caller's duty.
    #[must_use]
    pub fn new(p: u64) -> Self {
        assert!(p % 2 == 1 && (3..1 << 62).contains(&p), "modulus");
        let mut inverse = p;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
        }
        let one = (u64::MAX % p + 1) % p;
        let mut field = Self { p, neg_inverse: inverse.wrapping_neg(), r2: one, one };
        // From 2^64 to 2^128 modulo p: Montgomery squaring six times from 2^64 * 2 costs no long division.
        let mut power = field.add(one, one);
        for _ in 0..6 {
            power = field.mul(power, power);
        }
        field.r2 = power;
        field
    }

    /// The modulus.
    #[must_use]
    pub fn modulus(&self) -> u64 {
        self.p
    }

    /// The element 1.
    #[must_use]
    pub fn one(&self) -> u64 {
        self.one
    }

    /// `x / 2^64 mod p` for `x < p * 2^64`.
    #[inline]
    #[must_use]
    pub fn reduce(&self, x: u128) -> u64 {
        let m = (x as u64).wrapping_mul(self.neg_inverse);
        let t = ((x + u128::from(m) * u128::from(self.p)) >> 64) as u64;
        if t >= self.p { t - self.p } else { t }
    }

    /// `x / 2^64 mod p` for a sum `x` of at most eight products of elements.
    #[inline]
    #[must_use]
    pub fn reduce_wide(&self, x: u128) -> u64 {
        // x < 8 p^2 <= 2 p 2^64 and m p < 2^64 p, so the sum fits and its high word is below 3 p.
        let m = (x as u64).wrapping_mul(self.neg_inverse);
        let t = ((x + u128::from(m) * u128::from(self.p)) >> 64) as u64;
        let t = if t >= 2 * self.p { t - 2 * self.p } else { t };
        if t >= self.p { t - self.p } else { t }
    }

    /// `a * b`.
    #[inline]
    #[must_use]
    pub fn mul(&self, a: u64, b: u64) -> u64 {
        self.reduce(u128::from(a) * u128::from(b))
    }

    /// `a + b`.
    #[inline]
    #[must_use]
    pub fn add(&self, a: u64, b: u64) -> u64 {
        let s = a + b;
        if s >= self.p { s - self.p } else { s }
    }

    /// `a - b`.
    #[inline]
    #[must_use]
    pub fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    /// `-a`.
    #[inline]
    #[must_use]
    pub fn neg(&self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.p - a }
    }

    /// `a^e`.
    #[must_use]
    pub fn pow(&self, mut a: u64, mut e: u64) -> u64 {
        let mut out = self.one;
        while e > 0 {
            if e & 1 == 1 {
                out = self.mul(out, a);
            }
            a = self.mul(a, a);
            e >>= 1;
        }
        out
    }

    /// `1 / a`; 0 for `a = 0`.
    #[must_use]
    pub fn inverse(&self, a: u64) -> u64 {
        self.pow(a, self.p - 2)
    }

    /// The sum of the products of corresponding entries.
    #[must_use]
    pub fn dot(&self, a: &[u64], b: &[u64]) -> u64 {
        // Four products are below 4 p^2 <= 2^64 p, so the sum stays below 8 p^2.
        let limit = u128::from(self.p) << 64;
        let wide = |x: &u64, y: &u64| u128::from(*x) * u128::from(*y);
        let length = a.len().min(b.len());
        let (a, b) = (&a[..length], &b[..length]);
        let (mut left, mut right) = (a.chunks_exact(4), b.chunks_exact(4));
        let tail: u128 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| wide(x, y)).sum();
        let mut sum = if tail >= limit { tail - limit } else { tail };
        for (x, y) in left.by_ref().zip(right.by_ref()) {
            sum += wide(&x[0], &y[0]) + wide(&x[1], &y[1]) + wide(&x[2], &y[2]) + wide(&x[3], &y[3]);
            if sum >= limit {
                sum -= limit;
            }
        }
        self.reduce(sum)
    }

    /// The element of a small number.
    #[must_use]
    pub fn from_u64(&self, x: u64) -> u64 {
        self.reduce(u128::from(x) * u128::from(self.r2))
    }

    /// The residue in `0..p`.
    #[must_use]
    pub fn to_u64(&self, a: u64) -> u64 {
        self.reduce(u128::from(a))
    }

    /// The residue of a natural number.
    #[must_use]
    pub fn from_natural(&self, x: &Natural) -> u64 {
        // A limb times r2 is below p 2^64, so that its residue needs no division; r2 is also the element 2^64.
        x.as_limbs_asc().iter().rev().fold(0, |acc, limb| {
            let shifted = self.mul(acc, self.r2);
            self.add(shifted, self.reduce(u128::from(*limb) * u128::from(self.r2)))
        })
    }

    /// The residue of an integer.
    #[must_use]
    pub fn from_integer(&self, x: &Integer) -> u64 {
        let a = self.from_natural(x.unsigned_abs_ref());
        if *x < 0 { self.neg(a) } else { a }
    }

    /// The residue of a rational, or `None` when `p` divides the denominator.
    #[must_use]
    pub fn from_rational(&self, x: &Rational) -> Option<u64> {
        let mut a = self.from_natural(x.numerator_ref());
        if *x.denominator_ref() != 1 {
            let q = self.from_natural(x.denominator_ref());
            if q == 0 {
                return None;
            }
            a = self.mul(a, self.inverse(q));
        }
        Some(if *x < 0 { self.neg(a) } else { a })
    }

    /// The residue of least absolute value.
    #[must_use]
    pub fn to_signed(&self, a: u64) -> i64 {
        let x = self.to_u64(a);
        if x > self.p / 2 { x as i64 - self.p as i64 } else { x as i64 }
    }
}

/// Whether `n` is prime (Miller–Rabin with bases that decide all of `u64`).
#[must_use]
pub fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 {
        return false;
    }
    for q in BASES {
        if n.is_multiple_of(q) {
            return n == q;
        }
    }
    // Without a factor up to 37 a composite number is at least 41 squared.
    if n < 41 * 41 {
        return true;
    }
    let s = (n - 1).trailing_zeros();
    if n < 1 << 62 {
        // Powers in Montgomery form need no division; the formulas hold for every odd modulus.
        let ring = PrimeField::new(n);
        let (one, minus) = (ring.one(), ring.neg(ring.one()));
        let base = |b: u64| ring.pow(ring.from_u64(b), (n - 1) >> s);
        return BASES.iter().all(|b| is_probable(base(*b), one, minus, s, |x| ring.mul(x, x)));
    }
    let mul = |a: u64, b: u64| (u128::from(a) * u128::from(b) % u128::from(n)) as u64;
    let power = |b: u64| {
        let (mut x, mut b, mut e) = (1, b, (n - 1) >> s);
        while e > 0 {
            if e & 1 == 1 {
                x = mul(x, b);
            }
            b = mul(b, b);
            e >>= 1;
        }
        x
    };
    BASES.iter().all(|b| is_probable(power(*b), 1, n - 1, s, |x| mul(x, x)))
}

/// Whether `x`, an odd power of a base, is 1, or one of the first `s` repeated squares of it is -1.
fn is_probable(mut x: u64, one: u64, minus: u64, s: u32, square: impl Fn(u64) -> u64) -> bool {
    if x == one || x == minus {
        return true;
    }
    for _ in 1..s {
        x = square(x);
        if x == minus {
            return true;
        }
    }
    false
}

/// The first primes are `2^62 - k` with these `k`; a test says that none is left out.
const KNOWN: [u64; 32] = [
    57, 87, 117, 143, 153, 167, 171, 195, 203, 273, 287, 317, 443, 483, 495, 575, 581, 603, 633, 663, 765, 773, 777,
    791, 813, 831, 923, 981, 993, 1001, 1007, 1017,
];

/// The large primes below `2^62`, descending: the sequence of moduli of every modular method here.
pub fn large_primes() -> impl Iterator<Item = u64> {
    let rest = (KNOWN[KNOWN.len() - 1] + 2..).step_by(2).map(|k| (1 << 62) - k).filter(|p| is_prime(*p));
    KNOWN.into_iter().map(|k| (1 << 62) - k).chain(rest)
}

/// The primes above `start`, ascending.
pub fn primes_above(start: u64) -> impl Iterator<Item = u64> {
    (start + 1..).filter(|n| is_prime(*n))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn montgomery_agrees_with_plain_arithmetic() {
        for p in [3, 101, 65_537, (1 << 62) - 57] {
            assert!(is_prime(p));
            let f = PrimeField::new(p);
            for (a, b) in [(0, 1), (2, 2), (p - 1, p - 1), (p / 2, p / 3), (12_345 % p, p - 2)] {
                let (x, y) = (f.from_u64(a), f.from_u64(b));
                assert_eq!(u128::from(f.to_u64(f.mul(x, y))), u128::from(a) * u128::from(b) % u128::from(p));
                assert_eq!(f.to_u64(f.sub(f.add(x, y), y)), a);
                if a != 0 {
                    assert_eq!(f.mul(x, f.inverse(x)), f.one());
                }
            }
        }
    }

    #[test]
    fn residues_of_large_numbers() {
        let f = PrimeField::new((1 << 62) - 57);
        let big = (Integer::from(7) << 200u64) - Integer::from(5);
        let expected = f.sub(f.mul(f.from_u64(7), f.pow(f.from_u64(2), 200)), f.from_u64(5));
        assert_eq!(f.from_integer(&big), expected);
        assert_eq!(f.from_integer(&-big), f.neg(expected));
        let half = f.from_rational(&ratio(-1, 2)).unwrap();
        assert_eq!(f.add(half, half), f.neg(f.one()));
        assert_eq!(f.dot(&[f.one(); 20], &[half; 20]), f.neg(f.from_u64(10)));
    }

    #[test]
    fn prime_sequences() {
        assert_eq!(primes_above(100).take(3).collect::<Vec<_>>(), [101, 103, 107]);
        let plain = |n: u64| n > 1 && (2..).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
        assert!((0..20_000).all(|n| is_prime(n) == plain(n)));
        // Strong pseudoprimes to several bases, and the largest prime of a word.
        assert!([3_215_031_751, 3_825_123_056_546_413_051, u64::MAX].iter().all(|n| !is_prime(*n)));
        assert!(is_prime(u64::MAX - 58));
        let p: Vec<u64> = large_primes().take(2).collect();
        assert!(p[0] == (1 << 62) - 57 && p[1] < p[0] && is_prime(p[1]));
        let sought: Vec<u64> = (0..600).map(|k| (1 << 62) - 1 - 2 * k).filter(|p| is_prime(*p)).collect();
        assert_eq!(large_primes().take(sought.len()).collect::<Vec<_>>(), sought);
        assert!(sought.len() > KNOWN.len());
    }
}
