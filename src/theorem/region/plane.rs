//! The plane of a curve with two parameters, in boxes.

use super::argue::Arguments;
use super::curve::CurveFamily;
use super::fact::{CurveClaim, Fact, Why};
use super::ledger::Ledger;
use super::line::LineRegion;
use super::plane_box::{Spot, Waiting, inside};
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::budget::Budget;
use crate::parallel;
use crate::poly::Two;
use crate::radius::Ended;
use crate::radius::family::Search;
use std::collections::{BTreeSet, VecDeque};
use std::time::{Duration, Instant};

/// A closed box of two parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Area {
    /// The range of the first parameter.
    pub first: (Rational, Rational),
    /// The range of the second.
    pub second: (Rational, Rational),
}

/// What is known of every value of a box.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Known {
    /// The curve contracts, and is G¹ or is not.
    Curve(Verdict, Why),
    /// The system does not contract: a word has an eigenvalue outside the unit disc.
    Expands(Vec<usize>),
    /// The curve contracts; nothing more is claimed.
    Contracts,
    /// Nothing is claimed.
    Open,
}

impl Known {
    /// The verdict on G¹.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Curve(verdict, _) => *verdict,
            Self::Expands(_) | Self::Contracts | Self::Open => Verdict::Undetermined,
        }
    }

    /// Whether something about the curve, or that it does not contract, is known.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        matches!(self, Self::Curve(..) | Self::Expands(_))
    }
}

/// A box with what is known of it.
#[derive(Debug, Clone)]
pub struct PlaneBox {
    /// The box.
    pub area: Area,
    /// What is known.
    pub known: Known,
}

/// What is known in the plane.
#[derive(Debug, Clone)]
pub struct PlaneRegion {
    /// Boxes that cover the whole, without common inner points.
    pub boxes: Vec<PlaneBox>,
    /// Polynomials whose zeros alone keep a box from being decided: borders, and curves on which nothing is said.
    pub borders: Vec<Two>,
    /// What is known on those borders that are straight lines.
    pub lines: Vec<LineRegion>,
    /// Why the search ended: `Exhausted` where boxes became as small as was asked for.
    pub ended: Ended,
}

/// How long the search goes on.
#[derive(Debug, Clone)]
pub struct PlaneLimits {
    /// How often the whole is halved in both directions.
    pub depth: usize,
    /// Boxes that are examined.
    pub boxes: usize,
    /// A guard by the clock.
    pub time: Option<Duration>,
    /// What is spent on borders that are straight lines, where these are examined.
    pub lines: Option<(Search, Budget)>,
}

struct Covering<'a> {
    arguments: Arguments<'a, Two>,
    ledger: Ledger<'a>,
    /// Looks for arguments that may still be in vain.
    looks: usize,
}

/// Boxes that are examined at a time, on all threads; arguments that are found in between are known to the next ones.
const AT_A_TIME: usize = 64;
/// Values at which no argument is found, before no more are looked for.
const LOOKS: usize = 200;
/// Boxes that are left whose guards are looked at for borders.
const UNSIGNED: usize = 800;
/// Shares of a box between which values lie at which arguments are looked for.
const SPOTS: [(i64, i64); 2] = [(23, 53), (31, 59)];

impl CurveFamily<Two> {
    /// Where in a box of two parameters the curve contracts and is G¹. `step` is told how much of the whole was done, in boxes of
    /// the smallest size.
    ///
    /// # Cost
    /// Signs of polynomials on each box by Bernstein coefficients, products of matrices of intervals, and linear algebra with
    /// polynomials in two parameters where a new argument is looked for.
    #[must_use]
    pub fn plane(&self, whole: &Area, limits: &PlaneLimits, step: &dyn Fn(usize)) -> PlaneRegion {
        let begun = Instant::now();
        let mut covering = Covering::new(self);
        let mut queue: VecDeque<Waiting> = [Waiting::new(whole.clone())].into();
        let (mut boxes, mut examined, mut ended) = (Vec::new(), 0, Ended::Done);
        let (mut borders, mut left) = (BTreeSet::new(), 0);
        while !queue.is_empty() {
            crate::stop::check();
            if limits.time.is_some_and(|t| begun.elapsed() >= t) {
                ended = Ended::Clock;
            } else if examined >= limits.boxes {
                ended = Ended::Work;
            }
            let some =
                queue.len().min(if ended == Ended::Done { AT_A_TIME.min(limits.boxes - examined) } else { usize::MAX });
            let wave: Vec<Waiting> = queue.drain(..some).collect();
            examined += wave.len();
            let found = if ended == Ended::Done {
                covering.examined(wave)
            } else {
                wave.into_iter().map(Waiting::left).collect()
            };
            for (own, known) in found {
                if !known.is_decided() && own.depth < limits.depth && ended == Ended::Done {
                    queue.extend(own.quarters());
                    continue;
                }
                if !known.is_decided() && left < UNSIGNED {
                    left += 1;
                    borders.extend(covering.ledger.border(&own));
                }
                step(1 << (2 * (limits.depth - own.depth)));
                boxes.push(PlaneBox { area: own.area, known });
            }
        }
        let open = boxes.iter().any(|b| !b.known.is_decided());
        let ended = if open && ended == Ended::Done { Ended::Exhausted } else { ended };
        let borders: Vec<Two> = borders.into_iter().collect();
        let lines = limits.lines.as_ref().filter(|_| ended != Ended::Clock);
        let lines = lines.map_or_else(Vec::new, |(search, budget)| self.on_lines(&borders, whole, (search, budget)));
        PlaneRegion { boxes, borders, lines, ended }
    }
}

impl<'a> Covering<'a> {
    fn new(family: &'a CurveFamily<Two>) -> Self {
        Self { arguments: Arguments::new(family, false), ledger: Ledger::new(family), looks: LOOKS }
    }

    /// Some boxes with what is known of them; new arguments are looked for in those that are left.
    fn examined(&mut self, wave: Vec<Waiting>) -> Vec<(Waiting, Known)> {
        let ledger = &self.ledger;
        let mut found = parallel::map(&wave, true, |own| ledger.known(own.clone()));
        let before = ledger.count();
        for (own, known) in found.iter_mut().filter(|(_, known)| *known == Known::Contracts) {
            let at = (inside(&own.area.first, SPOTS[0]), inside(&own.area.second, SPOTS[1]));
            if !self.ledger.holds_at(&at) {
                self.look(&at);
            }
            if let Some(fact) = self.ledger.fact_on(own, before) {
                *known = fact;
            }
        }
        if self.ledger.count() > before {
            let ledger = &self.ledger;
            found = parallel::map(&found, true, |(own, known)| {
                let mut own = own.clone();
                let more = if *known == Known::Contracts { ledger.fact_on(&mut own, before) } else { None };
                (own, more.unwrap_or_else(|| known.clone()))
            });
        }
        found
    }

    /// Looks for an argument about G¹ at a value.
    fn look(&mut self, at: &(Rational, Rational)) {
        if self.looks == 0 {
            return;
        }
        let facts: Vec<Fact<Two>> = self.arguments.facts(&Spot::new(at));
        let Some(fact) = facts.into_iter().find(|f| f.claim == CurveClaim::G1) else {
            self.looks -= 1;
            return;
        };
        self.ledger.hold(fact, at);
    }
}

impl PlaneRegion {
    /// What is said of a value: of the boxes that hold it the first that decides.
    #[must_use]
    pub fn at(&self, p: &Rational, q: &Rational) -> Option<&Known> {
        let holds = |b: &&PlaneBox| {
            let within = |(lo, hi): &(Rational, Rational), x: &Rational| lo <= x && x <= hi;
            within(&b.area.first, p) && within(&b.area.second, q)
        };
        let own = || self.boxes.iter().filter(holds).map(|b| &b.known);
        own().find(|k| k.is_decided()).or_else(|| own().next())
    }
}
