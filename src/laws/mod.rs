//! Laws of verdicts: what must not change when the same shape is written in other words, and what nothing may contradict.
//!
//! Every [`Law`] makes, from a shape and a seed, a second shape about which the truth is the same or follows; both are
//! certified, and the two verdicts are held against each other. A decided verdict against the opposite one is *broken*; an
//! answer that only one of the two gives is *lost*, and is counted. [`check`] does it for one law, [`Law::ALL`] lists them.
//!
//! The laws are used by the property tests, by `secant fuzz`, and by whoever changes the engine.

mod compare;
mod forging;
mod sampling;
mod transform;

pub use compare::Agreement;
pub use transform::{Image, image};

use crate::shape::{Address, Shape};
use crate::theorem::{Certified, certify};

/// A law that verdicts obey.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Law {
    /// Other affine coordinates in the space of every state.
    Conjugated,
    /// Other units: coordinates multiplied by powers of ten between 10⁻⁷ and 10⁷.
    Scaled,
    /// States with other names and in another order.
    Reordered,
    /// The curve run backwards.
    Reversed,
    /// Words of two letters for the pieces.
    Words,
    /// A start state in front whose one piece is the whole shape.
    Wrapped,
    /// One more coordinate that nothing sees.
    Hidden,
    /// The curve as a set without an order: its germs at ends and at points inside one cell are the same.
    AsSet,
    /// Secants of exact points turn to the tangents that were proved.
    Sampled,
    /// The checker accepts what was proved or refuted, and accepts no changed case with a claim that is false of it.
    Certified,
    /// No local Hölder exponent is below the exponent of the whole curve.
    Exponents,
}

/// Two answers that cannot both be right.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{law:?}: {what}")]
pub struct Broken {
    /// The law.
    pub law: Law,
    /// What contradicts what.
    pub what: String,
}

impl Law {
    /// All laws, in the order in which they are checked.
    pub const ALL: [Self; 11] = [
        Self::Reordered,
        Self::Wrapped,
        Self::Reversed,
        Self::Conjugated,
        Self::Scaled,
        Self::Hidden,
        Self::Words,
        Self::AsSet,
        Self::Sampled,
        Self::Exponents,
        Self::Certified,
    ];

    /// One line for people.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Conjugated => "other affine coordinates",
            Self::Scaled => "other units",
            Self::Reordered => "states renamed and reordered",
            Self::Reversed => "the curve backwards",
            Self::Words => "words of two letters for the pieces",
            Self::Wrapped => "a start state in front",
            Self::Hidden => "a coordinate that nothing sees",
            Self::AsSet => "the curve as a set",
            Self::Sampled => "secants of exact points",
            Self::Certified => "the checker, and changed cases",
            Self::Exponents => "local and global Hölder exponents",
        }
    }
}

/// Addresses to examine besides those that [`certify`] finds itself: short periodic ones, behind prefixes of one letter.
///
/// Every letter exists; they are normalised, without repetition, at most `most` of them.
#[must_use]
pub fn probes(shape: &Shape, most: usize) -> Vec<Address> {
    let letters = shape.states[shape.start].pieces.len();
    let mut found = Vec::new();
    let cycles = (0..letters).flat_map(|i| std::iter::once(vec![i]).chain((0..letters).map(move |j| vec![i, j])));
    for cycle in cycles {
        for prefix in std::iter::once(Vec::new()).chain((0..letters).map(|i| vec![i])) {
            if let Ok(address) = (Address { prefix, cycle: cycle.clone() }).normalise(shape, shape.start)
                && !found.contains(&address)
            {
                found.push(address);
            }
        }
    }
    found.truncate(most);
    found
}

/// Checks one law on a shape that was certified with `addresses`.
///
/// `Ok(None)` where the law says nothing about the shape (a set has no direction in which it could be reversed).
///
/// # Errors
/// [`Broken`] with the contradiction.
///
/// # Cost
/// That of [`certify`] on a shape of the same size; for [`Law::Words`] with the square of the number of pieces.
pub fn check(
    law: Law,
    shape: &Shape,
    addresses: &[Address],
    found: &Certified,
    seed: u64,
) -> Result<Option<Agreement>, Broken> {
    match law {
        Law::Sampled => sampling::check(shape, found).map(Some),
        Law::Certified => forging::check(shape, addresses, found, seed),
        Law::Exponents => sampling::exponents(shape, found),
        Law::Conjugated
        | Law::Scaled
        | Law::Reordered
        | Law::Reversed
        | Law::Words
        | Law::Wrapped
        | Law::Hidden
        | Law::AsSet => {
            let Some(image) = image(law, shape, seed) else { return Ok(None) };
            let mapped: Vec<Address> = addresses.iter().filter_map(|a| image.address(shape, a)).collect();
            let other = match certify(&image.shape, &mapped) {
                Ok(other) => other,
                Err(error) => return compare::refused(law, found, &error).map(Some),
            };
            compare::compare(law, shape, found, &image, &other).map(Some)
        }
    }
}

/// What the laws saw of one shape.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tally {
    /// Answers that were compared.
    pub compared: usize,
    /// What only one of two answers decided, with the law.
    pub lost: Vec<(Law, String)>,
}

/// Certifies a shape and checks laws on it; `None` where the shape is refused (it does not contract, or its pieces do not
/// meet).
///
/// # Errors
/// The first [`Broken`] law.
///
/// # Cost
/// That of [`check`] for every law.
///
/// ```
/// use secant::arith::ratio;
/// use secant::laws::{Law, hold};
/// let curve = secant::scheme::takagi(&ratio(1, 2)).unwrap();
/// let tally = hold(&curve, &Law::ALL, 7).unwrap().unwrap();
/// assert!(tally.compared > 20);
/// ```
pub fn hold(shape: &Shape, laws: &[Law], seed: u64) -> Result<Option<Tally>, Broken> {
    let addresses = probes(shape, PROBES);
    let Ok(found) = certify(shape, &addresses) else { return Ok(None) };
    let mut tally = Tally::default();
    for &law in laws {
        if let Some(agreement) = check(law, shape, &addresses, &found, seed)? {
            tally.compared += agreement.compared;
            tally.lost.extend(agreement.lost.into_iter().map(|what| (law, what)));
        }
    }
    Ok(Some(tally))
}

/// Addresses that [`hold`] examines.
const PROBES: usize = 6;
