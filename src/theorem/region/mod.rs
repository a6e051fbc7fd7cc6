//! For which values of a parameter the scheme of a mask converges and its limits are `C^k`: the range in open intervals and
//! single points.
//!
//! The mask is `(1 + … + z^{N−1})^K b` with polynomials in the parameter as coefficients. Order `k < K` holds where the joint
//! spectral radius of the matrices of `b` is below `N^{−k}` (theory §11), and fails where it is not, if the translates of the
//! limit are independent on a unit interval; the latter is so where one polynomial does not vanish. Where it does, and where a
//! further sum rule holds, the member itself is asked.

mod argue;
mod cells;
mod cones;
mod curve;
mod fact;
mod independence;
mod ledger;
mod line;
mod plane;
mod plane_box;
mod signs;
mod symbol;
mod table;

pub use curve::{CurveFamily, CurveFamilyError};
pub use fact::{CurveClaim, CurveEnd, Evidence, Fact, Why};
pub use independence::Independence;
pub use line::{LineRegion, PlaneLine};
pub use plane::{Area, Known, PlaneBox, PlaneLimits, PlaneRegion};
pub use symbol::Symbol;
pub use table::{Basis, CurvePart, CurveRegions, CurveTable, Subject, member_verdict};

use super::regularity::{Regularity, digits, regularity};
use crate::algebraic::{Root, between, lies_within, roots_within, sorted};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::radius::Options;
use crate::radius::family::{Below, Pencil, Place, Search, below};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Why a mask with a parameter has no regions.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RegionError {
    /// An arity below 2.
    #[error("the arity is {0}, but must be at least 2")]
    Arity(usize),
    /// A mask of zeros, or too long.
    #[error("a mask with a parameter has from 1 to {MAX_LENGTH} coefficients, and not all are zero")]
    Length,
    /// Coefficients that do not add up to 1 on a coset for every value of the parameter.
    #[error(
        "the coefficients with index {coset} modulo {arity} add up to {sum}, not to 1 for every value of the parameter"
    )]
    SumRule {
        /// The arity.
        arity: usize,
        /// The coset.
        coset: usize,
        /// Their sum.
        sum: String,
    },
    /// A range whose ends are not in order.
    #[error("the range is empty: its first number must be below the second")]
    Range,
}

/// Longest mask handled.
pub const MAX_LENGTH: usize = 24;

/// A mask whose coefficients are polynomials in a parameter.
#[derive(Debug, Clone)]
pub struct MaskFamily {
    /// The arity `N`.
    pub arity: usize,
    /// The coefficients; neither the first nor the last is 0 for every value.
    pub mask: Vec<Poly>,
    /// `K`: the sum rules that hold for every value.
    pub sum_rules: usize,
    /// The coefficients of `b`.
    pub factor: Vec<Poly>,
    /// Where this does not vanish, the translates of the limit are independent on a unit interval; `None` where they are for no
    /// value, as far as this shows.
    pub independent: Option<Independence>,
    /// Where a further sum rule holds, all these vanish.
    pub further: Vec<Poly>,
}

/// What is said of a part of the range.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Finding {
    /// Proved, by the hull with this index.
    Proved(usize),
    /// Refuted by the word with this index.
    Word(usize),
    /// Refuted: no more than `K` sum rules hold.
    SumRules,
    /// The member was asked: proved or refuted.
    Member(bool),
    /// Not decided: no hull was found.
    Gap,
    /// Not decided: the word refutes for independent translates only, or the member is irrational or was not decided.
    Special,
}

impl Finding {
    /// Whether the order holds, where that is decided.
    #[must_use]
    pub fn answer(&self) -> Option<bool> {
        match self {
            Self::Proved(_) => Some(true),
            Self::Word(_) | Self::SumRules => Some(false),
            Self::Member(holds) => Some(*holds),
            Self::Gap | Self::Special => None,
        }
    }
}

/// A part of the range: an open interval, or a point where both ends are the same.
#[derive(Debug, Clone)]
pub struct Part {
    /// The lower end.
    pub from: Root,
    /// The upper end.
    pub to: Root,
    /// What is said of it.
    pub finding: Finding,
}

impl Part {
    /// Whether it is a single point.
    #[must_use]
    pub fn is_point(&self) -> bool {
        self.from.same(&self.to)
    }
}

/// One order of smoothness on the range.
#[derive(Debug, Clone)]
pub struct OrderRegion {
    /// `k`: convergence for 0, then `C^k`.
    pub order: usize,
    /// What the parts rest on, but for the order `K`.
    pub radius: Option<Below>,
    /// The parts, ascending, each with one reason; together they are the range.
    pub fine: Vec<Part>,
    /// The same with neighbours of one verdict joined, where no single point is between.
    pub parts: Vec<Part>,
}

impl OrderRegion {
    /// What is said of a value of the range.
    #[must_use]
    pub fn at(&self, p: &Root) -> Option<&Finding> {
        self.parts.iter().find(|part| lies_within(p, &part.from, &part.to)).map(|part| &part.finding)
    }
}

impl MaskFamily {
    /// A mask with polynomials in a parameter of this name as coefficients.
    ///
    /// # Errors
    /// [`RegionError`].
    pub fn new(arity: usize, mask: &[Poly], parameter: &str) -> Result<Self, RegionError> {
        if arity < 2 {
            return Err(RegionError::Arity(arity));
        }
        let first = mask.iter().position(|f| !f.is_zero()).ok_or(RegionError::Length)?;
        let last = mask.iter().rposition(|f| !f.is_zero()).ok_or(RegionError::Length)?;
        let mask = mask[first..=last].to_vec();
        if mask.len() > MAX_LENGTH {
            return Err(RegionError::Length);
        }
        for coset in 0..arity {
            let sum = mask.iter().skip(coset).step_by(arity).fold(Poly::zero(), |s, f| &s + f);
            if sum != Poly::constant(Rational::from(1)) {
                return Err(RegionError::SumRule { arity, coset, sum: sum.display(parameter) });
            }
        }
        let (mut sum_rules, mut factor) = (0, mask.clone());
        let further = loop {
            let (quotient, rest) = divided(&factor, arity);
            if rest.iter().any(|f| !f.is_zero()) || quotient.is_empty() {
                break rest;
            }
            (sum_rules, factor) = (sum_rules + 1, quotient);
        };
        let independent = Pencil::new(digits_over(&mask, arity)).as_ref().and_then(Independence::of);
        Ok(Self { arity, mask, sum_rules, factor, independent, further })
    }

    /// The coefficients of a member.
    #[must_use]
    pub fn member(&self, p: &Rational) -> Vec<Rational> {
        self.mask.iter().map(|f| f.eval(p)).collect()
    }

    /// The matrices of `b`.
    #[must_use]
    pub fn matrices(&self) -> Vec<Matrix<Poly>> {
        digits_over(&self.factor, self.arity)
    }

    /// The orders from convergence to `C^K` on a closed range, no more than `most + 1` of them.
    ///
    /// # Errors
    /// [`RegionError::Range`].
    ///
    /// # Cost
    /// [`below`] once for each order below `K`, and a joint spectral radius for every special member.
    pub fn regions(
        &self,
        range: &(Rational, Rational),
        most: usize,
        search: &Search,
    ) -> Result<Vec<OrderRegion>, RegionError> {
        if range.0 >= range.1 {
            return Err(RegionError::Range);
        }
        let pencil = Pencil::new(self.matrices()).ok_or(RegionError::Length)?;
        let mut threshold = Rational::from(1);
        let mut purse = Purse::new(search);
        let mut members = Members { family: self, known: Vec::new(), left: MEMBERS };
        let mut orders = Vec::new();
        let last = most.min(self.sum_rules);
        for order in 0..=last {
            let radius = (order < self.sum_rules).then(|| {
                // The last order rests on no search.
                let share = purse.share(self.sum_rules.min(last + 1) - order);
                let found = below(&pencil.divided(&threshold), range, &share);
                purse.pay(found.spent);
                found
            });
            let fine = self.parts(order, range, radius.as_ref(), &mut |p| members.ask(p, order, &purse));
            orders.push(OrderRegion { order, radius, parts: joined(fine.clone()), fine });
            threshold /= Rational::from(self.arity as u64);
        }
        Ok(orders)
    }

    /// The values of the range at which the general argument against an order may be missing; `None` where it always is.
    fn special(&self, order: usize, range: &(Rational, Rational)) -> Option<Vec<Root>> {
        let mut special = Vec::new();
        if order > 0 {
            special.extend(roots_within(&self.independent.as_ref()?.guard, range));
        }
        if order == self.sum_rules {
            let common = self.further.iter().fold(Poly::zero(), |g, f| g.gcd(f));
            special.extend(roots_within(&common, range));
        }
        Some(special)
    }

    fn parts(
        &self,
        order: usize,
        range: &(Rational, Rational),
        radius: Option<&Below>,
        ask: &mut dyn FnMut(&Root) -> Finding,
    ) -> Vec<Part> {
        let special = self.special(order, range);
        let ends = [&range.0, &range.1].map(Root::from_rational);
        let mut marks: Vec<Root> = radius.map_or_else(|| ends.to_vec(), Below::marks);
        marks.extend(special.iter().flatten().cloned());
        let marks = sorted(marks, range);
        let mut find = |p: &Root, is_point: bool| {
            let general = radius.map_or(Finding::SumRules, |r| match r.place(p) {
                Place::Below(k) => Finding::Proved(k),
                Place::AtLeast(k) => Finding::Word(k),
                Place::Open => Finding::Gap,
            });
            if general.answer() != Some(false) {
                return general;
            }
            match &special {
                None => Finding::Special,
                Some(points) if is_point && points.iter().any(|s| s.same(p)) => ask(p),
                Some(_) => general,
            }
        };
        let mut parts: Vec<Part> = Vec::new();
        for (k, mark) in marks.iter().enumerate() {
            parts.push(Part { from: mark.clone(), to: mark.clone(), finding: find(mark, true) });
            if let Some(next) = marks.get(k + 1) {
                let inside = Root::from_rational(&between(mark, next));
                parts.push(Part { from: mark.clone(), to: next.clone(), finding: find(&inside, false) });
            }
        }
        parts
    }
}

/// Points that say what both intervals beside them say become part of these; the ends of the range stay.
fn joined(parts: Vec<Part>) -> Vec<Part> {
    let mut all: Vec<Part> = Vec::new();
    let mut rest = parts.into_iter().peekable();
    while let Some(part) = rest.next() {
        let own = part.finding.answer();
        let member = matches!(part.finding, Finding::Member(_) | Finding::Special);
        let kind = std::mem::discriminant(&part.finding);
        let same = |other: &Part| own.is_some() || std::mem::discriminant(&other.finding) == kind;
        let like = |other: &Part| !other.is_point() && other.finding.answer() == own && same(other);
        let between = part.is_point() && !member && all.last().is_some_and(like) && rest.peek().is_some_and(like);
        if between && let (Some(before), Some(after)) = (all.last_mut(), rest.next()) {
            before.to = after.to;
            continue;
        }
        all.push(part);
    }
    all
}

/// What a search may spend on all orders together.
struct Purse<'a> {
    search: &'a Search,
    work: u64,
    begun: Option<(Instant, Duration)>,
}

impl<'a> Purse<'a> {
    fn new(search: &'a Search) -> Self {
        Self { search, work: search.work, begun: search.time.map(|time| (Instant::now(), time)) }
    }

    fn time(&self) -> Option<Duration> {
        self.begun.map(|(since, time)| time.saturating_sub(since.elapsed()))
    }

    /// The part of one of so many orders that are to come.
    fn share(&self, orders: usize) -> Search {
        let parts = orders.clamp(1, 1 << 20) as u32;
        Search { work: self.work / u64::from(parts), time: self.time().map(|t| t / parts), ..self.search.clone() }
    }

    /// A piece of work, where there is time for all of it.
    fn timed<T>(&self, work: impl FnOnce() -> T) -> Option<T> {
        match self.time() {
            Some(time) if time.is_zero() => None,
            Some(time) => crate::stop::within(time, work),
            None => Some(work()),
        }
    }

    fn pay(&mut self, spent: u64) {
        self.work = self.work.saturating_sub(spent);
    }

    /// For a member that is asked by itself.
    fn options(&self) -> Options {
        Options { work: Some(self.search.work / MEMBER_SHARE), time: self.time(), ..Options::default() }
    }
}

/// A member that is asked by itself may spend this part of all.
const MEMBER_SHARE: u64 = 16;

/// Members that may be asked by themselves.
const MEMBERS: usize = 40;

/// Members that were asked.
struct Members<'a> {
    family: &'a MaskFamily,
    known: Vec<(Rational, Option<Regularity>)>,
    /// How many more may be asked.
    left: usize,
}

impl Members<'_> {
    /// Whether a member has an order, from its own joint spectral radius.
    fn ask(&mut self, p: &Root, order: usize, purse: &Purse<'_>) -> Finding {
        let Some(p) = p.rational() else { return Finding::Special };
        if !self.known.iter().any(|(q, _)| *q == p) {
            let asked = || regularity(&self.family.member(&p), self.family.arity, &purse.options()).ok();
            let found = if self.left > 0 { purse.timed(asked).flatten() } else { None };
            self.left = self.left.saturating_sub(1);
            self.known.push((p.clone(), found));
        }
        let found = self.known.iter().find(|(q, _)| *q == p).and_then(|(_, r)| r.as_ref());
        let Some(found) = found else { return Finding::Special };
        // The list ends with the first order that fails or is open.
        let row = found.orders.iter().find(|o| o.order == order || o.smooth != Some(true));
        match row.and_then(|o| o.smooth) {
            Some(true) => Finding::Member(true),
            // Convergence fails whether translates are independent or not.
            Some(false) if found.independent || row.is_some_and(|o| o.order == 0) => Finding::Member(false),
            _ => Finding::Special,
        }
    }
}

/// Quotient and rest of the division by `1 + z + … + z^{N−1}`, from the lowest coefficient up.
fn divided(a: &[Poly], arity: usize) -> (Vec<Poly>, Vec<Poly>) {
    if a.len() < arity {
        return (Vec::new(), a.to_vec());
    }
    let (mut rest, mut quotient) = (a.to_vec(), Vec::new());
    for k in 0..=a.len() - arity {
        let c = rest[k].clone();
        for entry in &mut rest[k..k + arity] {
            *entry = &*entry - &c;
        }
        quotient.push(c);
    }
    (quotient, rest)
}

/// The matrices `T_e[i][j] = b_{N i − j + e}` with polynomials as entries, placed as those of a member are.
fn digits_over(mask: &[Poly], arity: usize) -> Vec<Matrix<Poly>> {
    // The places of the coefficients: their numbers, from 1.
    let numbers: Vec<Rational> = (1..=mask.len()).map(|k| Rational::from(k as u64)).collect();
    let coefficient = |x: &Rational| usize::try_from(x).ok().and_then(|k| k.checked_sub(1)).map(|k| mask[k].clone());
    let entry = |x: &Rational| match coefficient(x) {
        Some(f) => f,
        None => Poly::zero(),
    };
    digits(&numbers, arity).iter().map(|m| m.map(entry)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn four_point() -> MaskFamily {
        let w = Poly::new(vec![ratio(0, 1), ratio(1, 1)]);
        let (arity, mask) = crate::scheme::mask_family("four-point", "w", &w).unwrap().unwrap();
        MaskFamily::new(arity, &mask, "w").unwrap()
    }

    #[test]
    fn the_translates_of_four_points_depend_at_0_only() {
        let family = four_point();
        assert_eq!((family.sum_rules, family.factor.len()), (2, 5));
        let found = family.independent.clone().unwrap();
        let roots = roots_within(&found.guard, &(ratio(-1, 2), ratio(1, 2)));
        assert!(roots.iter().any(|r| r.rational() == Some(ratio(0, 1))));
        for p in [ratio(1, 16), ratio(1, 10), ratio(-1, 3), ratio(2, 7)] {
            let own = regularity(&family.member(&p), 2, &Options::default()).unwrap();
            assert!(own.independent || found.guard.eval(&p) == 0, "{p}");
        }
        println!("{:?}", roots.iter().map(|r| r.to_f64().0).collect::<Vec<_>>());
    }
}
