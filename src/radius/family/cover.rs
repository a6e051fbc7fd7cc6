//! An interval of parameters, covered by words and hulls.

#![allow(clippy::float_arithmetic, reason = "widths and values of words say what is tried next")]

use super::proposal::{Word, grow, piece, words};
use super::{Cover, Crossing, Hull, Pencil};
use crate::algebraic::{Root, between, sorted};
use crate::arith::{Rational, abs, ratio};
use crate::radius::budget::Budget;
use crate::radius::{Ended, Options};
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;
use std::time::Duration;

/// How long the search goes on. What is left when it ends is not decided.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Parts that are narrower are left.
    pub width: Rational,
    /// Hulls that may be tried.
    pub hulls: usize,
    /// Letters of the longest word.
    pub longest: usize,
    /// Pieces of a hull.
    pub pieces: usize,
    /// Work that may be spent, in the units of [`Options::work`].
    pub work: u64,
    /// A guard by the clock, as in [`Options::time`].
    pub time: Option<Duration>,
}

impl Default for Search {
    fn default() -> Self {
        Self { width: ratio(1, 1_000_000), hulls: 120, longest: 12, pieces: 600, work: WORK, time: None }
    }
}

/// Work of a search unless it is told otherwise: about fifteen seconds.
const WORK: u64 = 15_000_000_000;

impl Search {
    /// A search that ends after about so many seconds.
    #[must_use]
    pub fn within(self, seconds: f64) -> Self {
        let options = Options::default().within(seconds);
        Self { hulls: usize::MAX, work: options.work_for(1), time: options.time, ..self }
    }
}

/// Where a parameter of the interval belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The joint spectral radius is below 1, by the cover with this index.
    Below(usize),
    /// It is at least 1, by the word with this index.
    AtLeast(usize),
    /// Not decided.
    Open,
}

/// What is known of the joint spectral radius on an interval.
#[derive(Debug, Clone)]
pub struct Below {
    /// The matrices, divided by the threshold.
    pub pencil: Pencil,
    /// The interval, with its ends.
    pub range: (Rational, Rational),
    /// Words with the parameters at which they have spectral radius at least 1.
    pub crossings: Vec<Crossing>,
    /// Hulls with the intervals on which they were checked.
    pub covers: Vec<Cover>,
    /// Why the search ended.
    pub ended: Ended,
    /// The work that was spent.
    pub spent: u64,
}

/// Finds words and hulls on a closed interval of parameters for the threshold 1.
///
/// # Cost
/// As many hulls as the search allows, each with up to so many pieces, and the crossings of the words.
#[must_use]
pub fn below(pencil: &Pencil, range: &(Rational, Rational), search: &Search) -> Below {
    let found = Below {
        pencil: pencil.clone(),
        range: range.clone(),
        crossings: Vec::new(),
        covers: Vec::new(),
        ended: Ended::Done,
        spent: 0,
    };
    let budget = Budget::new(&Options { work: Some(search.work), time: search.time, ..Options::default() }, 1);
    let mut covering =
        Covering { found, search, budget: &budget, tried: Vec::new(), failed: Vec::new(), left: search.hulls };
    covering.sample();
    loop {
        crate::stop::check();
        covering.borders();
        match covering.widest() {
            Some(hole) if covering.left > 0 && budget.left() > 0 => covering.inside(&hole),
            rest => {
                covering.found.ended = match (rest, budget.late(), budget.left()) {
                    (None, ..) => Ended::Done,
                    (_, true, _) => Ended::Clock,
                    (.., 0) => Ended::Work,
                    _ => Ended::Exhausted,
                };
                break;
            }
        }
    }
    covering.found.spent = search.work.saturating_sub(budget.left());
    covering.found
}

impl Below {
    /// Where a parameter of the interval belongs: below only where the words of the hull are known to be small.
    #[must_use]
    pub fn place(&self, p: &Root) -> Place {
        if let Some(k) = self.crossings.iter().position(|c| c.holds_at(p)) {
            return Place::AtLeast(k);
        }
        let known = |word: &[usize]| self.crossings.iter().any(|c| c.word == word);
        let holds = |c: &Cover| c.hull.words().all(known) && c.contains(p);
        self.covers.iter().position(holds).map_or(Place::Open, Place::Below)
    }

    /// All ends of parts, ascending: two of them with nothing between bound an open interval of one place.
    #[must_use]
    pub fn marks(&self) -> Vec<Root> {
        let rational = Root::from_rational;
        let mut marks = vec![rational(&self.range.0), rational(&self.range.1)];
        for cover in &self.covers {
            let (lo, hi) = cover.range();
            marks.extend([lo, hi].map(rational));
        }
        marks.extend(self.crossings.iter().flat_map(|c| c.ends.iter().cloned()));
        sorted(marks, &self.range)
    }
}

/// An open interval without an answer.
struct Hole {
    from: Root,
    to: Root,
    width: f64,
}

struct Covering<'a> {
    found: Below,
    search: &'a Search,
    budget: &'a Budget<'a>,
    /// Borders from which a hull was tried.
    tried: Vec<Root>,
    /// Parameters at which no hull was found.
    failed: Vec<Root>,
    left: usize,
}

impl Covering<'_> {
    /// Words that are too large at a few members.
    fn sample(&mut self) {
        let (lo, hi) = self.found.range.clone();
        for k in 0..=8 {
            let p = &lo + (&hi - &lo) * ratio(k, 8);
            let point = Root::from_rational(&p);
            if self.found.place(&point) == Place::Open {
                let best = self.words(&p);
                self.refute(&point, &best);
            }
        }
    }

    /// Words that grow fastest at a member, for a small part of the work.
    fn words(&self, p: &Rational) -> Vec<Word> {
        words(&self.found.pencil, p, self.search.longest, &self.budget.part(SAMPLE))
    }

    /// Where a word is too large; `None` where the polynomials would be too large, or nothing may be spent any more.
    fn crossing(&self, word: &[usize]) -> Option<Crossing> {
        let (n, letters) = (self.found.pencil.dim() as u64, word.len() as u64);
        let values = self.found.pencil.degree() as u64 * letters * n * n + 1;
        // A characteristic polynomial of exact numbers for each value, of the exterior power too.
        let enough = self.budget.spend(values * (letters * n.pow(3) + n.pow(5)) * EXACT);
        enough.then(|| Crossing::of(&self.found.pencil, word, &self.found.range)).flatten()
    }

    /// Adds a word that is proved to be too large at a parameter; false where there is none.
    fn refute(&mut self, p: &Root, best: &[Word]) -> bool {
        for w in best.iter().take(6).filter(|w| w.value > 0.999_999) {
            if self.found.crossings.iter().any(|c| c.word == w.word) {
                continue;
            }
            let Some(crossing) = self.crossing(&w.word) else { continue };
            if crossing.holds_at(p) {
                self.found.crossings.push(crossing);
                return true;
            }
        }
        false
    }

    /// The open intervals without an answer.
    fn holes(&self) -> Vec<Hole> {
        let mut marks = self.found.marks();
        marks.extend(self.failed.iter().cloned());
        let marks = sorted(marks, &self.found.range);
        let hole = |pair: &[Root]| {
            let inside = Root::from_rational(&between(&pair[0], &pair[1]));
            let open = self.found.place(&inside) == Place::Open;
            let width = pair[1].to_f64().0 - pair[0].to_f64().0;
            open.then(|| Hole { from: pair[0].clone(), to: pair[1].clone(), width })
        };
        marks.windows(2).filter_map(hole).collect()
    }

    fn widest(&self) -> Option<Hole> {
        let least = crate::arith::to_f64(&self.search.width);
        let wide = self.holes().into_iter().filter(|h| h.width > least);
        wide.max_by(|a, b| a.width.total_cmp(&b.width))
    }

    /// Hulls around the ends of words that bound what is left.
    fn borders(&mut self) {
        for hole in self.holes() {
            for border in [&hole.from, &hole.to] {
                let is_end = self.found.crossings.iter().any(|c| c.ends.iter().any(|e| e.same(border)));
                if !is_end || self.tried.iter().any(|t| t.same(border)) || self.left == 0 {
                    continue;
                }
                self.tried.push(border.clone());
                let near = border.rational().unwrap_or_else(|| border.enclosure(48).0.mid());
                let best = self.words(&near);
                self.hull(&near, &hole, &best, true);
            }
        }
    }

    /// A word or a hull in the middle of a hole.
    fn inside(&mut self, hole: &Hole) {
        let (from, to) = (hole.from.enclosure(48).0.mid(), hole.to.enclosure(48).0.mid());
        let at = |part| &from + (&to - &from) * part;
        let p = Rational::simplest_rational_in_open_interval(&at(ratio(2, 5)), &at(ratio(3, 5)));
        let best = self.words(&p);
        let point = Root::from_rational(&p);
        if self.refute(&point, &best) || self.hull(&p, hole, &best, false) {
            return;
        }
        self.failed.push(point);
    }

    /// A hull around a parameter; whether one was found.
    fn hull(&mut self, p: &Rational, hole: &Hole, best: &[Word], border: bool) -> bool {
        let Some(top) = best.first().map(|w| w.value) else { return false };
        for attempt in attempts(border || top > 0.97) {
            crate::stop::check();
            if self.left == 0 {
                return false;
            }
            self.left -= 1;
            let near = |w: &&Word| attempt.tolerance > 0.0 && w.value >= top * (1.0 - attempt.tolerance);
            let chosen: Vec<&[usize]> = best.iter().filter(near).take(4).map(|w| w.word.as_slice()).collect();
            // What a hull says depends on where its words are small.
            if !chosen.iter().all(|w| self.knows(w)) {
                continue;
            }
            let Some(hull) = grow(&self.found.pencil, p, &chosen, &attempt, self.budget) else { continue };
            let pieces = self.march(&hull, p, hole);
            if !pieces.is_empty() {
                self.found.covers.push(Cover { hull, pieces });
                return true;
            }
        }
        false
    }

    /// Whether it is known where a word is too large; it is found out where that can be done.
    fn knows(&mut self, word: &[usize]) -> bool {
        if self.found.crossings.iter().all(|c| c.word != word) {
            match self.crossing(word) {
                Some(crossing) => self.found.crossings.push(crossing),
                None => return false,
            }
        }
        true
    }

    /// Pieces around a parameter, as far as the hull holds.
    fn march(&self, hull: &Hull, p: &Rational, hole: &Hole) -> Vec<super::Piece> {
        let (lo, hi) = &self.found.range;
        let make = |from: &Rational, to: &Rational| piece(&self.found.pencil, hull, from, to, self.budget);
        // A short grid, so that ends stay short.
        let whole = hole.to.enclosure(48).0.mid() - hole.from.enclosure(48).0.mid();
        let mut half = power_below(&(whole / Rational::from(4)));
        let mut first = None;
        for _ in 0..14 {
            crate::stop::check();
            let (from, to) = ((p - &half).max(lo.clone()), (p + &half).min(hi.clone()));
            first = make(&from, &to);
            if first.is_some() {
                break;
            }
            half /= Rational::from(4);
        }
        let Some(first) = first else { return Vec::new() };
        let least = &half / Rational::from(256);
        let mut pieces = vec![first];
        for up in [false, true] {
            let end = if up { hole.to.enclosure(48).0.hi } else { hole.from.enclosure(48).0.lo };
            let mut step = &half * Rational::from(2);
            while pieces.len() < self.search.pieces && self.budget.left() > 0 {
                crate::stop::check();
                let at = if up { &pieces[pieces.len() - 1].to } else { &pieces[0].from }.clone();
                if if up { at > end || at >= *hi } else { at < end || at <= *lo } {
                    break;
                }
                let next = if up { (&at + &step).min(hi.clone()) } else { (&at - &step).max(lo.clone()) };
                let made = if up { make(&at, &next) } else { make(&next, &at) };
                match made {
                    Some(made) if up => pieces.push(made),
                    Some(made) => pieces.insert(0, made),
                    None if step > least => {
                        step /= Rational::from(2);
                        continue;
                    }
                    None => break,
                }
                step *= Rational::from(2);
            }
        }
        pieces
    }
}

/// Work for the words of a member.
const SAMPLE: u64 = 400_000_000;
/// Work for an operation with exact numbers.
const EXACT: u64 = 200;

/// What is tried at a parameter.
pub(super) struct Attempt {
    /// How far below the fastest word others count as seeds; 0 for no words.
    pub tolerance: f64,
    /// The size of axes that are seeds.
    pub axes: Option<Rational>,
    /// Images whose gauge is below this count as inside.
    pub inside: f64,
}

fn attempts(leading: bool) -> Vec<Attempt> {
    let attempt = |(tolerance, axes, inside): (f64, Option<i64>, f64)| Attempt {
        tolerance,
        axes: axes.map(|q| ratio(1, q)),
        inside,
    };
    let list: &[(f64, Option<i64>, f64)] = if leading {
        &[
            (1e-6, None, 0.985),
            (1e-6, Some(8), 0.985),
            (1e-6, None, 0.998),
            (0.02, None, 0.985),
            (0.02, Some(8), 0.99),
            (1e-6, Some(64), 0.998),
            (0.0, Some(1), 0.985),
        ]
    } else {
        &[(0.0, Some(1), 0.985), (1e-6, None, 0.985), (1e-6, Some(8), 0.985), (0.02, Some(8), 0.985)]
    };
    list.iter().copied().map(attempt).collect()
}

/// The largest power of two that is not above a positive number.
fn power_below(x: &Rational) -> Rational {
    let (one, two) = (Rational::from(1), Rational::from(2));
    let mut power = one;
    while power > abs(x) {
        power /= &two;
    }
    while &power * &two <= *x {
        power *= &two;
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Matrix;
    use crate::poly::Poly;

    /// The matrices of differences of order two of the four-point scheme: the mask `(−w, 2w, 1/2 − 2w, 2w, −w)`.
    fn four_points() -> Pencil {
        let f = |c: [i64; 2]| Poly::new(vec![ratio(c[0], 2), ratio(c[1], 1)]);
        let mask = [f([0, -1]), f([0, 2]), f([1, -2]), f([0, 2]), f([0, -1])];
        let entry = |e: usize, i: usize, j: usize| {
            (2 * i + e).checked_sub(j).and_then(|k| mask.get(k)).map_or_else(Poly::zero, Clone::clone)
        };
        Pencil::new((0..2).map(|e| Matrix::from_fn(4, 4, |i, j| entry(e, i, j))).collect()).unwrap()
    }

    #[test]
    fn four_points_are_c1_between_0_and_a_root() {
        let range = (ratio(-1, 2), ratio(1, 2));
        let found = below(&four_points().divided(&ratio(1, 2)), &range, &Search::default());
        let at = |p, q| found.place(&Root::from_rational(&ratio(p, q)));
        assert!(matches!(at(0, 1), Place::AtLeast(_)));
        assert!(matches!(at(1, 1_000_000_000), Place::Below(_)));
        assert!(matches!(at(192_729_249, 1_000_000_000), Place::Below(_)));
        assert!(matches!(at(192_729_250, 1_000_000_000), Place::AtLeast(_)));
        assert!(matches!(at(-1, 1_000_000_000), Place::AtLeast(_)));
        assert!(found.covers.iter().all(|c| c.pieces.iter().all(|p| c.hull.holds(&found.pencil, p))));
    }
}
