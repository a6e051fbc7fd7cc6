//! The orthonormal scaling functions of Daubechies: `a(z) = 2 ((1+z)/2)^N q(z)`, where `q(z) q(1/z) = Σ_k C(N−1+k, k) y^k`,
//! `y = (2 − z − 1/z)/4`, `q(1) = 1`, and `q` takes one root of each pair `r, 1/r`: all outside the unit circle, or those of the
//! least asymmetric filter.

use super::enclosed::{BITS, Enclosed, enclosed};
use crate::algebraic::roots;
use crate::arith::{Integer, Interval, Rational, to_f64};
use crate::poly::{Poly, factor};
use crate::radius::Options;
use crate::scheme::Family;

/// Largest `N` handled.
pub const MAX_MOMENTS: usize = 20;

/// Bit `i` says whether the roots inside the circle are taken of the group `i`: groups `r, 1/r` and their conjugates, in the order of
/// the angle of `y` at them, from 0 to π.
fn inside(family: Family, moments: usize) -> u32 {
    match family {
        Family::Daubechies => 0,
        Family::LeastAsymmetric => SYMLETS[moments - 2],
    }
}

/// The choices of the least asymmetric filters with 2, 3, …, 20 moments, by which the filters of I. Daubechies, *Ten lectures on
/// wavelets* (1992), table 6.3, and those of the common tables beyond it were matched.
const SYMLETS: [u32; MAX_MOMENTS - 1] = [0, 0, 1, 1, 2, 3, 5, 6, 10, 12, 21, 14, 26, 28, 101, 113, 154, 92, 357];

/// Bounds the Hölder exponent of the scaling function with `moments` vanishing moments; `None` for `moments` outside
/// `2..=`[`MAX_MOMENTS`], or where the bounds could not be established.
///
/// # Cost
/// One joint spectral radius of matrices of size `moments − 1`.
///
/// # Examples
/// ```
/// use secant::{radius::Options, scheme::Family, theorem::wavelet::wavelet};
/// let found = wavelet(Family::LeastAsymmetric, 4, &Options::default()).expect("bounds");
/// assert!(found.exponent.lo > 1);
/// ```
#[must_use]
pub fn wavelet(family: Family, moments: usize, options: &Options) -> Option<Enclosed> {
    if !(2..=MAX_MOMENTS).contains(&moments) {
        return None;
    }
    enclosed(coefficients(family, moments)?, 2, moments, options)
}

/// Enclosures of the coefficients of `2^{1−N} q`.
fn coefficients(family: Family, moments: usize) -> Option<Vec<Interval>> {
    // z^{N−1} Σ_k C(N−1+k, k) ((2 − z − 1/z)/4)^k, where (2 − z − 1/z) z = −(1 − z)².
    let mut symbol = Poly::zero();
    let mut binomial = Rational::from(1);
    let mut power = Poly::constant(Rational::from(1));
    let square = Poly::new([-1, 2, -1].into_iter().map(|c| Rational::from(c) / Rational::from(4)).collect());
    for k in 0..moments {
        let mut shifted = vec![Rational::from(0); moments - 1 - k];
        shifted.extend_from_slice(power.scale(&binomial).coeffs());
        symbol = &symbol + &Poly::new(shifted);
        power = &power * &square;
        binomial = binomial * Rational::from((moments + k) as u64) / Rational::from((k + 1) as u64);
    }
    let zero = || Interval::point(Rational::from(0));
    let one = || Interval::point(Rational::from(1));
    // A complex polynomial, as enclosures of real and imaginary parts.
    let mut q: Vec<(Interval, Interval)> = vec![(one(), zero())];
    let mut all = Vec::new();
    for (minpoly, multiplicity) in factor(&symbol) {
        let places = roots(&minpoly).into_iter().map(|root| {
            let outside = root.cmp_modulus_rational(&Rational::from(1)) == std::cmp::Ordering::Greater;
            (outside, root.enclosure(BITS + 80))
        });
        all.extend(places.flat_map(|place| std::iter::repeat_n(place, multiplicity)));
    }
    let inside = inside(family, moments);
    for ((outside, (re, im)), group) in all.iter().zip(groups(&all)?) {
        if *outside != (inside >> group & 1 == 1) {
            q = times_linear(&q, re, im);
        }
    }
    if q.len() != moments {
        return None;
    }
    // q is real because roots come in conjugate pairs; scale to 2^{1−N} at z = 1.
    let sum = q.iter().fold(zero(), |s, c| &s + &c.0);
    if sum.contains_zero() {
        return None;
    }
    let scale = Rational::from(1) / Rational::from(Integer::from(1) << (moments as u64 - 1));
    let inverse = &Interval::new(Rational::from(1) / &sum.lo, Rational::from(1) / &sum.hi) * &scale;
    Some(q.iter().map(|c| (&c.0 * &inverse).outward(BITS + 40)).collect())
}

/// A root, and whether it lies outside the unit circle.
type Place = (bool, (Interval, Interval));

/// The number of the group of each root; `None` where two groups are not told apart by floats.
#[allow(clippy::float_arithmetic, reason = "angles that differ by much put the groups into an order")]
fn groups(all: &[Place]) -> Option<Vec<usize>> {
    const SAME: f64 = 1e-9;
    const APART: f64 = 1e-5;
    let angle = |(_, (re, im)): &Place| {
        // y = (2 − z − 1/z)/4, and 1/z has the numerator z̄.
        let (a, b) = (to_f64(&re.mid()), to_f64(&im.mid()));
        let size = a.mul_add(a, b * b);
        (b * (1.0 / size - 1.0)).atan2(2.0 - a - a / size).abs()
    };
    let angles: Vec<f64> = all.iter().map(angle).collect();
    let mut sorted = angles.clone();
    sorted.sort_by(f64::total_cmp);
    if sorted.windows(2).any(|w| (SAME..APART).contains(&(w[1] - w[0]))) {
        return None;
    }
    sorted.dedup_by(|b, a| *b - *a < SAME);
    Some(angles.iter().map(|x| sorted.iter().filter(|y| x - *y > SAME).count()).collect())
}

/// `q(z) (z − r)`.
fn times_linear(q: &[(Interval, Interval)], re: &Interval, im: &Interval) -> Vec<(Interval, Interval)> {
    let zero = Interval::point(Rational::from(0));
    let at = |k: usize| q.get(k).cloned().unwrap_or_else(|| (zero.clone(), zero.clone()));
    (0..=q.len())
        .map(|k| {
            let (a, b) = at(k);
            let before = if k == 0 { (zero.clone(), zero.clone()) } else { at(k - 1) };
            let real = &(&before.0 - &(&a * re)) + &(&b * im);
            let imaginary = &(&before.1 - &(&a * im)) - &(&b * re);
            (real.outward(BITS + 80), imaginary.outward(BITS + 80))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SYM4: [f64; 8] = [
        0.032_223_100_604_0,
        -0.012_603_967_262_0,
        -0.099_219_543_576_8,
        0.297_857_795_605_3,
        0.803_738_751_805_9,
        0.497_618_667_632_0,
        -0.029_635_527_646_0,
        -0.075_765_714_789_3,
    ];
    const SYM5: [f64; 10] = [
        0.019_538_882_735_3,
        -0.021_101_834_024_8,
        -0.175_328_089_908_5,
        0.016_602_105_764_5,
        0.633_978_963_458_2,
        0.723_407_690_402_4,
        0.199_397_533_977_4,
        -0.039_134_249_302_4,
        0.029_519_490_925_8,
        0.027_333_068_345_1,
    ];
    const SYM8: [f64; 16] = [
        0.001_889_950_332_8,
        -0.000_302_920_514_7,
        -0.014_952_258_337_0,
        0.003_808_752_013_9,
        0.049_137_179_673_6,
        -0.027_219_029_917_1,
        -0.051_945_838_107_7,
        0.364_441_894_835_3,
        0.777_185_751_700_5,
        0.481_359_651_258_4,
        -0.061_273_359_067_7,
        -0.143_294_238_350_8,
        0.007_607_487_324_9,
        0.031_695_087_811_5,
        -0.000_542_132_331_8,
        -0.003_382_415_951_0,
    ];

    /// The filters as they are printed (PyWavelets 1.9), from either end.
    #[test]
    fn least_asymmetric_filters_are_those_of_the_tables() {
        let tables: [(usize, &[f64]); 3] = [(4, &SYM4), (5, &SYM5), (8, &SYM8)];
        for (moments, table) in tables {
            let q = coefficients(Family::LeastAsymmetric, moments).expect("coefficients");
            // a(z)/√2 = √2 2^{-N} (1+z)^N q(z), and q is scaled by 2^{1-N}.
            let own: Vec<f64> = q.iter().map(|c| to_f64(&c.mid()) / std::f64::consts::SQRT_2).collect();
            let filter = (0..moments).fold(own, |f, _| {
                let (first, second) = ([f.as_slice(), &[0.0]].concat(), [&[0.0], f.as_slice()].concat());
                first.iter().zip(&second).map(|(a, b)| a + b).collect()
            });
            let near = |a: &[f64]| a.iter().zip(table).all(|(x, y)| (x - y).abs() < 1e-9);
            let turned: Vec<f64> = filter.iter().rev().copied().collect();
            assert!(filter.len() == table.len() && (near(&filter) || near(&turned)), "sym{moments}: {filter:?}");
        }
    }

    /// The polytope of db8 is so thin that coefficients of 50 places bound nothing well.
    #[test]
    fn thin_polytopes_are_computed_with_more_places() {
        let exponent = wavelet(Family::Daubechies, 8, &Options::default()).unwrap().exponent;
        assert!((to_f64(&exponent.lo) - 2.760_818_386_681).abs() < 1e-9, "{}", to_f64(&exponent.lo));
        assert!(to_f64(&exponent.width()) < 1e-9, "{}", to_f64(&exponent.width()));
    }
}
