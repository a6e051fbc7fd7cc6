//! Named filters of wavelets whose coefficients are rational or in a small field, as masks with the sum 2: Haar's, those of
//! Daubechies with 4 and 6 taps, the coiflet of 6 taps, and the filters of Cohen, Daubechies and Feauveau.
//!
//! Source: A. Cohen, I. Daubechies, J.-C. Feauveau, *Biorthogonal bases of compactly supported wavelets*, Comm. Pure Appl. Math.
//! 45 (1992). `biorP.Q` is the filter of the reconstruction, with `P` vanishing moments of the dual; `rbioP.Q` that of the
//! decomposition.

use super::Laurent;
use crate::arith::{Rational, ratio};

/// Pairs `P.Q` of splines that are known.
const SPLINES: [(usize, usize); 12] =
    [(1, 1), (1, 3), (1, 5), (2, 2), (2, 4), (2, 6), (2, 8), (3, 1), (3, 3), (3, 5), (3, 7), (3, 9)];

/// The names.
#[must_use]
pub fn wavelet_names() -> Vec<String> {
    let splines = SPLINES.iter().flat_map(|(p, q)| [format!("bior{p}.{q}"), format!("rbio{p}.{q}")]);
    ["haar", "db1", "db2", "db3", "coif1", "bior4.4", "rbio4.4"].into_iter().map(str::to_owned).chain(splines).collect()
}

/// The coefficients of a named filter, as expressions; `None` for another name.
#[must_use]
pub fn wavelet_mask(name: &str) -> Option<Vec<String>> {
    let texts = |symbol: &Laurent| symbol.coefficients().iter().map(ToString::to_string).collect();
    match name {
        "haar" | "db1" => Some(vec!["1".to_owned(); 2]),
        "db2" => super::daubechies_texts(2),
        "db3" => super::daubechies_texts(3),
        "coif1" => Some(
            ["(-3+sqrt(7))/16", "(1-sqrt(7))/16", "(7-sqrt(7))/8", "(7+sqrt(7))/8", "(5+sqrt(7))/16", "(1-sqrt(7))/16"]
                .map(str::to_owned)
                .to_vec(),
        ),
        "bior4.4" => Some(nine_seven(false)),
        "rbio4.4" => Some(nine_seven(true)),
        _ => SPLINES.iter().find_map(|&(p, q)| {
            if name == format!("bior{p}.{q}") {
                return Some(texts(&spline(p)));
            }
            (name == format!("rbio{p}.{q}")).then(|| texts(&dual(p, q)))
        }),
    }
}

/// The orthonormal filters of Daubechies, by the roots that they take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// `dbN`: those outside the unit circle (extremal phase).
    Daubechies,
    /// `symN`: those of the least asymmetric filters, as tables have them.
    LeastAsymmetric,
}

impl Family {
    /// The family and the number of vanishing moments that a name such as `db4` or `sym8` stands for.
    #[must_use]
    pub fn named(name: &str) -> Option<(Self, usize)> {
        let of = |family: Self| Some((family, name.strip_prefix(family.prefix())?.parse::<usize>().ok()?));
        of(Self::Daubechies).or_else(|| of(Self::LeastAsymmetric))
    }

    /// The letters before the number.
    #[must_use]
    pub fn prefix(self) -> &'static str {
        match self {
            Self::Daubechies => "db",
            Self::LeastAsymmetric => "sym",
        }
    }
}

/// `2 ((1+z)/2)^p`.
fn spline(p: usize) -> Laurent {
    let half = Laurent::new(0, vec![ratio(1, 2), ratio(1, 2)]);
    half.pow(p).scale(&Rational::from(2))
}

/// `y = −(1−z)²/(4z)`.
fn y() -> Laurent {
    Laurent::new(-1, vec![ratio(-1, 4), ratio(1, 2), ratio(-1, 4)])
}

/// `2 ((1+z)/2)^q Σ_{n<m} C(m−1+n, n) y^n`, `m = (p+q)/2`.
fn dual(p: usize, q: usize) -> Laurent {
    let m = p.midpoint(q);
    let (mut sum, mut power, mut binomial) =
        (Laurent::new(0, Vec::new()), Laurent::constant(1.into()), Rational::from(1));
    for n in 0..m {
        sum = sum.add(&power.scale(&binomial));
        power = power.mul(&y());
        binomial = binomial * Rational::from((m + n) as u64) / Rational::from((n + 1) as u64);
    }
    spline(q).mul(&sum)
}

/// The filters of 7 and of 9 taps: `1 + 4y + 10y² + 20y³ = (1 − y/r)(1 − 20 r (r + 1/2) y − 20 r y²)` with its real root `r`,
/// `1/r = −(20 r² + 10 r + 4)`.
fn nine_seven(nine: bool) -> Vec<String> {
    let root = "root(20*x^3+10*x^2+4*x+1, -1, 0)";
    let parts: Vec<(Laurent, String)> = if nine {
        vec![(y(), format!("(-20*{root}*({root}+1/2))")), (y().pow(2), format!("(-20*{root})"))]
    } else {
        vec![(y(), format!("(20*{root}^2+10*{root}+4)"))]
    };
    let smooth = spline(4);
    let low = smooth.low() - if nine { 2 } else { 1 };
    let width = if nine { 9 } else { 7 };
    let at = |p: &Laurent, k: i64| -> Rational {
        let place = usize::try_from(low + k - p.low()).ok();
        place.and_then(|i| p.coefficients().get(i)).cloned().unwrap_or_else(|| Rational::from(0))
    };
    (0..width)
        .map(|k| {
            let terms = parts.iter().map(|(p, factor)| format!(" + ({})*{factor}", at(&smooth.mul(p), k)));
            format!("({}){}", at(&smooth, k), terms.collect::<String>())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The low-pass filters of the pair 2.2 and of 3.1 as they are printed.
    #[test]
    fn splines_and_their_duals() {
        let of = |name: &str| wavelet_mask(name).unwrap().join(" ");
        assert_eq!(of("bior2.2"), "1/2 1 1/2");
        assert_eq!(of("rbio2.2"), "-1/4 1/2 3/2 1/2 -1/4");
        assert_eq!(of("bior3.1"), "1/4 3/4 3/4 1/4");
        assert_eq!(of("rbio3.1"), "-1/2 3/2 3/2 -1/2");
        assert_eq!(of("bior1.1"), of("rbio1.1"));
        assert!(wavelet_mask("bior2.3").is_none());
    }
}
