//! Smoothness across a border between two schemes (`docs/statements/border.md`).

mod model;

pub use model::BorderModel;

use super::lattice::{self, LatticeProblem, LatticeRegularity, MAX_RULES, lattice_regularity};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::radius::{JointRadius, Options, System, joint_radius};
use crate::scheme::BorderScheme;

/// What is known of one order of smoothness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BorderAnswer {
    /// All limits are of this order.
    Smooth,
    /// The limits beside the border, on side 0 (left) or 1, are not.
    Side(usize),
    /// There is a net whose limit is one polynomial on the left and another one on the right.
    Jump,
    /// Not decided: for this reason.
    Open(BorderGap),
}

/// Why an order is not decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BorderGap {
    /// That of the limits on side 0 or 1 is not.
    Side(usize),
    /// No window was found that is small enough and overlaps enough.
    Window,
    /// The bounds of the radius are not below that of the order.
    Radius,
}

/// One order.
#[derive(Debug, Clone)]
pub struct BorderOrder {
    /// The order `k`.
    pub order: usize,
    /// The window and its polynomials of degree `k`, where the sides are of this order.
    pub model: Option<BorderModel>,
    /// The operators on nets modulo those of one polynomial; with a jump, of a pair of polynomials.
    pub letters: Vec<Matrix>,
    /// Their joint spectral radius.
    pub radius: Option<JointRadius>,
    /// The answer.
    pub answer: BorderAnswer,
    /// With a jump: whether all limits are of this order up to the border on either side, and the pairs of their Taylor polynomials
    /// of this degree are among those of the model.
    pub sided: bool,
}

/// The smoothness of the limits of a scheme with a border.
#[derive(Debug, Clone)]
pub struct BorderRegularity {
    /// The scheme.
    pub scheme: BorderScheme,
    /// The limits of the masks of both sides by themselves.
    pub sides: [LatticeRegularity; 2],
    /// The orders 0, 1, …; the last one is the first that is not [`BorderAnswer::Smooth`].
    pub orders: Vec<BorderOrder>,
}

impl BorderRegularity {
    /// The largest `k` for which all limits are proved to be `C^k`.
    #[must_use]
    pub fn smoothness(&self) -> Option<usize> {
        self.orders.iter().take_while(|o| o.answer == BorderAnswer::Smooth).count().checked_sub(1)
    }

    /// Whether the order after [`BorderRegularity::smoothness`] is refuted.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.orders.last().is_some_and(|o| matches!(o.answer, BorderAnswer::Side(_) | BorderAnswer::Jump))
    }
}

/// Analyses a scheme with a border.
///
/// # Errors
/// [`LatticeProblem`] where the mask of a side cannot be analysed.
///
/// # Cost
/// That of [`lattice_regularity`] for both masks, and for each order a joint spectral radius of two matrices.
///
/// # Examples
/// ```
/// use secant::radius::Options;
/// use secant::scheme::{BorderScheme, NamedSide, averaged_border};
/// use secant::theorem::border::border_regularity;
/// let sides = [NamedSide::Loop, NamedSide::Loop];
/// let scheme = BorderScheme::new([sides[0].side()?, sides[1].side()?], averaged_border(sides))?;
/// let found = border_regularity(scheme, &Options::default())?;
/// assert_eq!((found.smoothness(), found.is_exact()), (Some(2), true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn border_regularity(scheme: BorderScheme, options: &Options) -> Result<BorderRegularity, LatticeProblem> {
    let [left, right] = scheme.sides();
    let first = lattice_regularity(left.mask.clone(), options)?;
    let second = if right.mask == left.mask { first.clone() } else { lattice_regularity(right.mask.clone(), options)? };
    let sides = [first, second];
    let mut orders = Vec::new();
    for order in 0..=MAX_RULES {
        let found = examine(&scheme, &sides, order, options);
        let ends = found.answer != BorderAnswer::Smooth;
        orders.push(found);
        if ends {
            break;
        }
    }
    Ok(BorderRegularity { scheme, sides, orders })
}

fn examine(scheme: &BorderScheme, sides: &[LatticeRegularity; 2], order: usize, options: &Options) -> BorderOrder {
    let mut found = BorderOrder {
        order,
        model: None,
        letters: Vec::new(),
        radius: None,
        answer: BorderAnswer::Open(BorderGap::Window),
        sided: false,
    };
    let answers = [0, 1].map(|k: usize| sides[k].orders.get(order));
    let rough = |a: &Option<&lattice::Answer>| matches!(a, Some(lattice::Answer::Rough | lattice::Answer::Rules));
    if let Some(k) = answers.iter().position(rough) {
        found.answer = BorderAnswer::Side(k);
        return found;
    }
    // A side that is smooth has sum rules of a higher order.
    if let Some(k) = answers.iter().position(|a| *a != Some(&lattice::Answer::Smooth)) {
        found.answer = BorderAnswer::Open(BorderGap::Side(k));
        return found;
    }
    let Some(model) = BorderModel::of(scheme, order) else { return found };
    let jump = model.pairs.cols() > model.equal.cols();
    let below = match model.quotient(if jump { &model.pairs } else { &model.equal }) {
        Some(letters) => {
            found.radius = System::plain(&letters).ok().and_then(|system| joint_radius(&system, options).ok());
            found.letters = letters;
            let bound = Rational::from(1) / Rational::from(1_i64 << order);
            found.radius.as_ref().and_then(|r| r.upper.as_ref()).is_some_and(|upper| *upper < bound)
        }
        None => false,
    };
    found.model = Some(model);
    found.sided = jump && below;
    found.answer = match (jump, below) {
        (true, _) => BorderAnswer::Jump,
        (false, true) => BorderAnswer::Smooth,
        (false, false) => BorderAnswer::Open(BorderGap::Radius),
    };
    found
}
