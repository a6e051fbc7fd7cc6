//! Logarithms and exponentials of rational numbers, enclosed.

use super::{Interval, Rational, abs};

/// Binary places of the enclosures, and a few more inside.
const PLACES: u64 = 72;

fn rounded(x: &Interval) -> Interval {
    x.outward(PLACES)
}

/// `2 artanh z` for `|z| <= 1/3`: the terms `z^(2k+1)/(2k+1)`, and a geometric bound for the rest.
fn twice_artanh(z: &Rational) -> Interval {
    let z = rounded(&Interval::point(z.clone()));
    let square = rounded(&z.square());
    let (mut power, mut sum) = (z.clone(), Interval::point(Rational::from(0)));
    const TERMS: u64 = 26;
    for k in 0..TERMS {
        sum = &sum + &(&power * &(Rational::from(1) / Rational::from(2 * k + 1)));
        power = rounded(&(&power * &square));
    }
    // |z|^(2n+1) (1 + 1/9 + …) / (2n+1)
    let rest = Interval::symmetric(power.magnitude() * Rational::from(9) / Rational::from(8 * (2 * TERMS + 1)));
    rounded(&(&(&sum + &rest) * &Rational::from(2)))
}

/// An enclosure of the natural logarithm of a positive number, of width about `2^-60` for numbers of moderate size; `None` for
/// others.
///
/// # Examples
/// ```
/// use secant_exact::arith::{ln, ratio, to_f64};
/// let two = ln(&ratio(2, 1)).unwrap();
/// assert!(to_f64(&two.lo) <= std::f64::consts::LN_2 && to_f64(&two.width()) < 1e-18);
/// assert!(ln(&ratio(0, 1)).is_none());
/// ```
#[must_use]
pub fn ln(x: &Rational) -> Option<Interval> {
    if *x <= 0 {
        return None;
    }
    let (one, two) = (Rational::from(1), Rational::from(2));
    let (mut m, mut exponent) = (x.clone(), 0i64);
    while m >= two {
        m /= &two;
        exponent += 1;
    }
    while m < one {
        m *= &two;
        exponent -= 1;
    }
    let part = twice_artanh(&((&m - &one) / (&m + &one)));
    let whole = &twice_artanh(&(one / Rational::from(3))) * &Rational::from(exponent);
    Some(&part + &whole)
}

/// An enclosure of the exponentials of the members of an interval.
///
/// # Examples
/// ```
/// use secant_exact::arith::{Interval, exp, ln, ratio};
/// let again = exp(&ln(&ratio(7, 3)).unwrap());
/// assert!(again.lo <= ratio(7, 3) && again.hi >= ratio(7, 3) && again.width() < ratio(1, 1 << 50));
/// ```
#[must_use]
pub fn exp(x: &Interval) -> Interval {
    Interval { lo: exp_of(&x.lo).lo, hi: exp_of(&x.hi).hi }
}

/// `e^x = (e^(x/2^k))^(2^k)` with `|x/2^k| <= 1/2`.
fn exp_of(x: &Rational) -> Interval {
    let (mut small, mut doublings) = (x.clone(), 0u32);
    while abs(&small) * Rational::from(2) > 1 {
        small /= Rational::from(2);
        doublings += 1;
    }
    let fine = |y: &Interval| y.outward(PLACES + 32);
    let small = fine(&Interval::point(small));
    const TERMS: u64 = 24;
    let (mut term, mut sum) = (Interval::point(Rational::from(1)), Interval::point(Rational::from(0)));
    for k in 1..=TERMS {
        sum = &sum + &term;
        term = fine(&(&(&term * &small) * &(Rational::from(1) / Rational::from(k))));
    }
    // The rest is at most twice the first term left out.
    sum = fine(&(&sum + &Interval::symmetric(term.magnitude() * Rational::from(2))));
    for _ in 0..doublings {
        sum = sum.square();
        sum = fine(&sum);
    }
    Interval { lo: sum.lo.max(Rational::from(0)), hi: sum.hi }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{ratio, to_f64};

    #[test]
    fn enclosures_hold_the_floats() {
        for (p, q) in [(1, 3), (2, 1), (7, 5), (999, 1000), (1, 1_000_000), (123_456, 7)] {
            let x = ratio(p, q);
            let (own, float) = (ln(&x).unwrap(), to_f64(&x).ln());
            assert!(
                to_f64(&own.lo) <= float + 1e-14 && float <= to_f64(&own.hi) + 1e-14 && own.width() < ratio(1, 1 << 50)
            );
            let back = exp(&own);
            assert!(back.lo <= x && x <= back.hi, "{x}");
            assert!(to_f64(&(back.width() / &x)) < 1e-9, "{x}");
        }
        assert_eq!(ln(&ratio(1, 1)).unwrap().mid(), ratio(0, 1));
        for y in [ratio(-20, 1), ratio(-1, 3), ratio(0, 1), ratio(5, 2)] {
            let (own, float) = (exp(&Interval::point(y.clone())), to_f64(&y).exp());
            assert!(to_f64(&own.lo) <= float * (1.0 + 1e-12) && float <= to_f64(&own.hi) * (1.0 + 1e-12), "{y}");
        }
    }
}
