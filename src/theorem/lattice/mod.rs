//! Regularity of the limits of masks on lattices (`docs/statements/lattice-mask.md`).

mod stability;
mod window;

pub use stability::{Cells, Samples, Stability};
pub use window::{MAX_RULES, MAX_WINDOW, Window, monomials};
pub(super) use window::{modulo, operators_keep};

use super::regularity::{Attained, minus_log};
use crate::arith::{Interval, Rational};
use crate::linalg::Matrix;
use crate::radius::{Growth, JointRadius, Lower, Options, System, joint_radius};
use crate::scheme::LatticeMask;
use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
use malachite_base::num::conversion::traits::IsInteger;
use std::cmp::Ordering;
use thiserror::Error;

/// Largest dimension of the quotient in which common invariant subspaces are looked for.
const MAX_SPLIT: usize = 48;
/// Work that is spent on the radius in larger dimensions, where more of it hardly helps.
const LARGE_WORK: u64 = 6_000_000_000;

/// Why the regularity of a mask is not looked at.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LatticeProblem {
    /// A window with too many points.
    #[error("the windows of this mask have more than {MAX_WINDOW} points")]
    Window,
    /// No bound of the radius at all.
    #[error("no bounds of the joint spectral radius were found")]
    Radius,
    /// Something that the statement excludes.
    #[error("the bounds of the radius contradict the sum rules: this is a mistake of the program")]
    Contradiction,
}

/// What is known of one order of smoothness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// All limits are of this order.
    Smooth,
    /// Some limit is not: the radius is too large, and shifts are stable (order 0: differences of some net do not tend to 0).
    Rough,
    /// Some limit is not: sum rules of a higher order would be needed, and shifts are stable.
    Rules,
    /// The radius, or the sum rules, exclude it for stable shifts; but these are not proved to be stable.
    Unstable,
    /// The bounds of the radius do not tell.
    Open,
}

/// The regularity of the limits of a mask.
#[derive(Debug, Clone)]
pub struct LatticeRegularity {
    /// The mask.
    pub mask: LatticeMask,
    /// `K`: the order of the sum rules, as far as they were looked at.
    pub sum_rules: usize,
    /// The window, for polynomials of degree `K − 1`.
    pub window: Window,
    /// The operators on nets modulo these polynomials, by digit.
    pub letters: Vec<Matrix>,
    /// Their joint spectral radius `J`.
    pub radius: JointRadius,
    /// What is known of the shifts of the limit function; nothing where the scheme is not proved to converge.
    pub stability: Stability,
    /// The answers for the orders 0, 1, …; the last one is the first that is not [`Answer::Smooth`].
    pub orders: Vec<Answer>,
    /// Enclosure of `−log_ρ J`.
    pub exponent: Option<Interval>,
    /// Whether products are bounded by `C J^m`, so that the exponent is attained.
    pub attained: Attained,
}

impl LatticeRegularity {
    /// Whether the scheme converges uniformly for all bounded nets; `None` where the bounds do not tell.
    #[must_use]
    pub fn converges(&self) -> Option<bool> {
        match self.orders.first() {
            Some(Answer::Smooth) => Some(true),
            Some(Answer::Rough) => Some(false),
            _ => None,
        }
    }

    /// The largest `k` for which all limits are proved to be `C^k`.
    #[must_use]
    pub fn smoothness(&self) -> Option<usize> {
        self.orders.iter().take_while(|a| **a == Answer::Smooth).count().checked_sub(1)
    }

    /// Whether the exponent is the supremum of those of all limits, and not only a lower bound.
    #[must_use]
    pub fn exponent_is_exact(&self) -> bool {
        self.stability.is_proved() && self.sum_rules < MAX_RULES
    }

    /// Whether the order after [`LatticeRegularity::smoothness`] is refuted.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        matches!(self.orders.last(), Some(Answer::Rough | Answer::Rules))
    }
}

/// Analyses a mask.
///
/// # Errors
/// [`LatticeProblem`].
///
/// # Cost
/// One joint spectral radius of as many matrices as the dilation has cosets, of about the size of the support of the limit function.
///
/// # Examples
/// ```
/// use secant::{radius::Options, scheme::LatticeMask, theorem::lattice::lattice_regularity};
/// let mask = LatticeMask::parse("(1+x)^2*(1+y)^2*(1+x*y)/8", None)?;
/// let found = lattice_regularity(mask, &Options::default())?;
/// assert_eq!((found.smoothness(), found.is_exact()), (Some(1), true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn lattice_regularity(mask: LatticeMask, options: &Options) -> Result<LatticeRegularity, LatticeProblem> {
    let sum_rules = window::sum_rules(&mask);
    // The coefficients of every coset sum to 1.
    let degree = sum_rules.checked_sub(1).ok_or(LatticeProblem::Contradiction)?;
    let window = Window::of(&mask, degree).ok_or(LatticeProblem::Window)?;
    let letters = window.quotient(&mask).ok_or(LatticeProblem::Contradiction)?;
    let system = System::plain(&letters).map_err(|_| LatticeProblem::Radius)?;
    let large = letters.iter().any(|m| m.rows() > MAX_SPLIT);
    let work = if large { options.work.or(Some(LARGE_WORK)) } else { options.work };
    let options = Options { split: options.split.min(MAX_SPLIT), work, ..options.clone() };
    let radius = joint_radius(&system, &options).map_err(|_| LatticeProblem::Radius)?;
    let size = Size {
        system: &system,
        radius: &radius,
        dimensions: mask.dilation().dimensions(),
        index: mask.dilation().index(),
    };
    if size.compare(sum_rules) == Some(Ordering::Less) {
        return Err(LatticeProblem::Contradiction);
    }
    let stable = if size.compare(0) == Some(Ordering::Less) {
        let operators: Vec<Matrix> = mask.dilation().digits().iter().map(|d| window.operator(&mask, d)).collect();
        stability::stability(&mask, &window, &operators)
    } else {
        Stability::Unknown
    };
    let orders = orders(&size, sum_rules, stable.is_proved());
    let exponent = size.exponent();
    let attained = attained(radius.growth, exponent.as_ref(), sum_rules);
    Ok(LatticeRegularity { sum_rules, orders, exponent, attained, stability: stable, mask, window, letters, radius })
}

/// The radius `J` beside the powers of `ρ = |det M|^(1/s)`.
struct Size<'a> {
    system: &'a System,
    radius: &'a JointRadius,
    dimensions: usize,
    index: usize,
}

impl Size<'_> {
    /// `|det M|^(-k)`.
    fn threshold(&self, k: usize) -> Rational {
        let base = Rational::from(1) / Rational::from(self.index as u64);
        power(&base, k)
    }

    /// `J` compared with `ρ^(−order)`, that is `J^s` with `|det M|^(−order)`; [`Ordering::Greater`] means at least. `None` where the
    /// bounds do not tell.
    fn compare(&self, order: usize) -> Option<Ordering> {
        let s = self.dimensions;
        if self.is_at_least(order) {
            return Some(Ordering::Greater);
        }
        if self.radius.exact {
            return self.decided(order).then_some(Ordering::Less);
        }
        let upper = self.radius.upper.as_ref()?;
        (power(upper, s) < self.threshold(order)).then_some(Ordering::Less)
    }

    /// Whether the word of the radius is at least `ρ^(−order)`: its eigenvalue to the power `s`, which is one of the word `s` times
    /// over, is compared with a rational number.
    fn is_at_least(&self, order: usize) -> bool {
        let Some(lower) = &self.radius.lower else { return false };
        let long = self.threshold(order * lower.length);
        match self.repeated(lower).as_ref().and_then(Lower::root) {
            Some(root) => root.cmp_modulus_rational(&long) != Ordering::Less,
            None => power(&lower.enclosure(64).lo, self.dimensions * lower.length) >= long,
        }
    }

    /// Whether [`Size::is_at_least`] is false because the value of the word is below, not because it is enclosed too widely.
    fn decided(&self, order: usize) -> bool {
        let Some(lower) = &self.radius.lower else { return true };
        let exactly = self.repeated(lower).is_some_and(|l| l.root().is_some());
        exactly || power(&lower.enclosure(64).hi, self.dimensions) < self.threshold(order)
    }

    fn repeated(&self, lower: &Lower) -> Option<Lower> {
        Lower::of(self.system, &lower.path.repeat(self.dimensions))
    }

    /// An enclosure of `−log_ρ J = −s log_|det M| J`; of width 0 where `J²` is a power of the determinant.
    fn exponent(&self) -> Option<Interval> {
        let s = Rational::from(self.dimensions as u64);
        let square = self.radius.lower.as_ref().filter(|_| self.radius.exact).and_then(Lower::square);
        let (x, factor) = match square {
            Some(square) => (Interval::point(square), s / Rational::from(2)),
            None => (self.radius.enclosure(96)?, s),
        };
        minus_log(&x, self.index).map(|e| Interval::new(e.lo * &factor, e.hi * &factor))
    }
}

fn power(x: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(Rational::from(1), |p, _| p * x)
}

fn orders(size: &Size<'_>, sum_rules: usize, stable: bool) -> Vec<Answer> {
    let mut rows = Vec::new();
    for order in 0..=sum_rules {
        let answer = match size.compare(order) {
            // Beyond the sum rules the radius decides nothing by itself.
            _ if order == sum_rules && sum_rules == MAX_RULES => Answer::Open,
            _ if order == sum_rules => {
                if stable {
                    Answer::Rules
                } else {
                    Answer::Unstable
                }
            }
            Some(Ordering::Less) => Answer::Smooth,
            // Whether differences of nets tend to 0 has nothing to do with shifts of limits.
            Some(_) if order == 0 || stable => Answer::Rough,
            Some(_) => Answer::Unstable,
            None => Answer::Open,
        };
        rows.push(answer);
        if answer != Answer::Smooth {
            break;
        }
    }
    rows
}

/// With bounded products the exponent is attained, but in the Zygmund sense only where it is an integer below the order of the sum
/// rules.
fn attained(growth: Growth, exponent: Option<&Interval>, sum_rules: usize) -> Attained {
    let integer =
        exponent.and_then(|e| match (e.lo == e.hi && e.lo.is_integer(), (&e.lo).ceiling() > (&e.hi).floor()) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        });
    match (growth, integer) {
        (Growth::Unbounded(_), _) => Attained::No,
        (Growth::Bounded, Some(true)) if exponent.is_some_and(|e| e.lo == sum_rules as u64) => Attained::Yes,
        (Growth::Bounded, Some(true)) => Attained::Zygmund,
        (Growth::Bounded, Some(false)) => Attained::Yes,
        (Growth::Bounded, None) | (Growth::Unknown, _) => Attained::Unknown,
    }
}
