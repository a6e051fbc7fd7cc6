//! The range, divided until each part is decided or as narrow as was asked for.

use super::judge::{Judge, meeting};
use super::leader::{Leader, Window, leaders};
use super::model::{Model, RuleFamily};
use super::tie::{Against, tie};
use super::{Finding, Gap, Limits, Part, VertexRegion};
use crate::algebraic::{Root, between, cmp_real, roots_within, sorted};
use crate::answer::Verdict;
use crate::arith::{Interval, Rational, ratio};
use crate::budget::Budget;
use crate::vertex::Ground;
use std::cmp::Ordering;
use std::time::Instant;

/// A part of the range, and which of its ends belong to it.
struct Segment {
    from: Root,
    to: Root,
    closed: [bool; 2],
    finding: Finding,
}

impl Segment {
    fn holds(&self, p: &Root) -> bool {
        match (cmp_real(&self.from, p), cmp_real(p, &self.to)) {
            (Ordering::Equal, Ordering::Equal) => true,
            (Ordering::Equal, Ordering::Less) => self.closed[0],
            (Ordering::Less, Ordering::Equal) => self.closed[1],
            (Ordering::Less, Ordering::Less) => true,
            _ => false,
        }
    }
}

/// Binary places of a value at which two moduli meet, and the part of a window beside it at which they are compared.
const NEAR: u64 = 120;
const FAR: i64 = 1 << 30;

/// What a window gives.
enum Outcome {
    Found(Vec<Segment>),
    Divide,
}

struct Covering<'a> {
    model: &'a Model,
    judge: Judge<'a>,
}

pub(super) fn cover(model: &Model, family: &RuleFamily<'_>, limits: &Limits, budget: &Budget) -> VertexRegion {
    let begun = Instant::now();
    let covering = Covering { model, judge: Judge::new(model, budget) };
    let (lo, hi) = &family.range;
    // A little beyond the range, so that borders at its ends, and short fractions, lie inside a window.
    let (below, above) = ((hi - lo) * ratio(1, 37), (hi - lo) * ratio(1, 41));
    let mut stack = vec![Window { lo: lo - below, hi: hi + above }];
    let (mut segments, mut examined) = (Vec::new(), 0);
    while let Some(window) = stack.pop() {
        crate::stop::check();
        let late = limits.time.is_some_and(|t| begun.elapsed() >= t);
        if late || examined >= limits.windows {
            segments.push(whole(&window, Finding::Open(if late { Gap::Clock } else { Gap::Work })));
            continue;
        }
        examined += 1;
        match covering.window(&window) {
            Outcome::Found(found) => segments.extend(found),
            Outcome::Divide if window.width() <= limits.width => {
                segments.push(whole(&window, Finding::Open(Gap::Narrow)));
            }
            Outcome::Divide => {
                let middle = (&window.lo + &window.hi) / Rational::from(2);
                stack.push(Window { lo: middle.clone(), hi: window.hi });
                stack.push(Window { lo: window.lo, hi: middle });
            }
        }
    }
    VertexRegion { valence: model.vertex.valence, parts: parts(segments, &family.range), windows: examined }
}

fn whole(window: &Window, finding: Finding) -> Segment {
    let (from, to) = (Root::from_rational(&window.lo), Root::from_rational(&window.hi));
    Segment { from, to, closed: [true; 2], finding }
}

/// Where a modulus lies to 1 for all values of a window.
fn beside_one(square: &Interval) -> Option<Ordering> {
    if square.hi < 1 {
        Some(Ordering::Less)
    } else if square.lo >= 1 {
        Some(Ordering::Greater)
    } else {
        None
    }
}

impl Covering<'_> {
    fn window(&self, window: &Window) -> Outcome {
        if let Some(found) = leaders(self.model, window, 1) {
            return match self.alone(&found[0], window) {
                Some(found) => Outcome::Found(found),
                None => Outcome::Divide,
            };
        }
        let Some(both) = leaders(self.model, window, 2) else { return Outcome::Divide };
        match self.two(&both[0], &both[1], window) {
            Some(found) => Outcome::Found(found),
            None => Outcome::Divide,
        }
    }

    /// One eigenvalue leads on the whole window.
    fn alone(&self, leader: &Leader, window: &Window) -> Option<Vec<Segment>> {
        match beside_one(&leader.square) {
            Some(Ordering::Less) => Some(vec![whole(window, self.judge.finding(leader, window)?)]),
            Some(_) => Some(vec![whole(window, Finding::By(Ground::NoLimit))]),
            None => {
                let (at, up) = self.crossing(leader, Against::Unit, window)?;
                let inside = self.judge.finding(leader, window)?;
                Some(if up {
                    split(window, &at, inside, Finding::By(Ground::NoLimit), Finding::By(Ground::NoLimit))
                } else {
                    split(window, &at, Finding::By(Ground::NoLimit), Finding::By(Ground::NoLimit), inside)
                })
            }
        }
    }

    /// One of two eigenvalues leads, or both.
    fn two(&self, one: &Leader, other: &Leader, window: &Window) -> Option<Vec<Segment>> {
        match (beside_one(&one.square), beside_one(&other.square)) {
            (Some(Ordering::Less), Some(Ordering::Less)) => {}
            (Some(Ordering::Greater), _) | (_, Some(Ordering::Greater)) => {
                return Some(vec![whole(window, Finding::By(Ground::NoLimit))]);
            }
            _ => return None,
        }
        let f = tie(self.model, one, Against::Other(other))?;
        if f.is_zero() {
            return Some(vec![whole(window, Finding::Open(Gap::Same))]);
        }
        let inside = roots_within(&f, &(window.lo.clone(), window.hi.clone()));
        if inside.is_empty() {
            let first = self.larger(one, Some(other), &window.lo)?;
            if self.larger(one, Some(other), &window.hi)? != first {
                return None;
            }
            let leader = if first { one } else { other };
            return Some(vec![whole(window, self.judge.finding(leader, window)?)]);
        }
        let (at, up) = self.crossing(one, Against::Other(other), window)?;
        let (before, after) = if up { (other, one) } else { (one, other) };
        let (before, after) = (self.judge.finding(before, window)?, self.judge.finding(after, window)?);
        Some(split(window, &at, before, meeting(self.model, one, other), after))
    }

    /// The one value of a window at which a modulus reaches that of another, or 1, from one side to the other; whether it is
    /// larger above.
    fn crossing(&self, one: &Leader, against: Against<'_>, window: &Window) -> Option<(Root, bool)> {
        let other = match against {
            Against::Unit => None,
            Against::Other(other) => Some(other),
        };
        let up = [&window.lo, &window.hi].map(|p| self.larger(one, other, p));
        let [Some(before), Some(after)] = up else { return None };
        // One polynomial, which vanishes at one value only: the difference has no other zero.
        let f = tie(self.model, one, against).filter(|f| !f.is_zero())?;
        let inside = roots_within(&f, &(window.lo.clone(), window.hi.clone()));
        let [at] = inside.as_slice() else { return None };
        // The enclosures say so, too, of values close by.
        let (near, far) = (at.enclosure(NEAR).0, window.width() * ratio(1, FAR));
        let close = [near.lo - &far, near.hi + far].map(|p| self.larger(one, other, &p));
        (before != after && close == up).then(|| (at.clone(), after))
    }

    /// Whether a modulus is certainly larger than another, or 1, at a value; `None` where it is not certainly smaller either.
    fn larger(&self, one: &Leader, other: Option<&Leader>, p: &Rational) -> Option<bool> {
        let own = one.square_at(self.model, p)?;
        let other = match other {
            Some(other) => other.square_at(self.model, p)?,
            None => Interval::point(Rational::from(1)),
        };
        if own.lo > other.hi {
            Some(true)
        } else if own.hi < other.lo {
            Some(false)
        } else {
            None
        }
    }
}

fn split(window: &Window, at: &Root, before: Finding, meeting: Finding, after: Finding) -> Vec<Segment> {
    let (lo, hi) = (Root::from_rational(&window.lo), Root::from_rational(&window.hi));
    let part =
        |from: &Root, to: &Root, closed, finding| Segment { from: from.clone(), to: to.clone(), closed, finding };
    vec![part(&lo, at, [true, false], before), part(at, at, [true, true], meeting), part(at, &hi, [false, true], after)]
}

/// The segments, ascending, within the range as open intervals and points. A point between two that say the same is left out.
fn parts(segments: Vec<Segment>, range: &(Rational, Rational)) -> Vec<Part> {
    let mut merged: Vec<Segment> = Vec::new();
    for segment in segments {
        match merged.last_mut() {
            Some(last) if last.finding == segment.finding && (last.closed[1] || segment.closed[0]) => {
                (last.to, last.closed[1]) = (segment.to, segment.closed[1]);
            }
            _ => merged.push(segment),
        }
    }
    let mut marks: Vec<Root> = [&range.0, &range.1].map(Root::from_rational).to_vec();
    marks.extend(merged.iter().flat_map(|s| [s.from.clone(), s.to.clone()]));
    let marks = sorted(marks, range);
    // Of two windows that meet at a value the one that decides.
    let at = |p: &Root| {
        let own = || merged.iter().filter(|s| s.holds(p)).map(|s| s.finding);
        own().find(|f| f.verdict() != Verdict::Undetermined).or_else(|| own().next())
    };
    let mut all: Vec<Part> = Vec::new();
    for (k, mark) in marks.iter().enumerate() {
        all.extend(at(mark).map(|finding| Part { from: mark.clone(), to: mark.clone(), finding }));
        if let Some(next) = marks.get(k + 1) {
            let inside = Root::from_rational(&between(mark, next));
            all.extend(at(&inside).map(|finding| Part { from: mark.clone(), to: next.clone(), finding }));
        }
    }
    all
}
