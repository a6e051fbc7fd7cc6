//! The plane of a curve with two parameters, in boxes.

use super::argue::Arguments;
use super::curve::CurveFamily;
use super::fact::{CurveClaim, Fact, Why};
use super::signs::{Signs, determinant};
use super::symbol::Symbol;
use crate::answer::Verdict;
use crate::arith::{Interval, Rational, ratio};
use crate::linalg::Matrix;
use crate::poly::Two;
use crate::radius::Ended;
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;
use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
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
    /// Nothing is claimed.
    Open,
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
}

/// Signs at a rational value of two parameters.
struct Spot<'a> {
    at: &'a (Rational, Rational),
    guards: RefCell<Vec<Two>>,
    special: Cell<bool>,
}

impl<'a> Spot<'a> {
    fn new(at: &'a (Rational, Rational)) -> Self {
        Self { at, guards: RefCell::default(), special: Cell::new(false) }
    }
}

impl Signs<Two> for Spot<'_> {
    fn fork(&self) -> Self {
        let guards = RefCell::new(self.guards.borrow().clone());
        Self { at: self.at, guards, special: Cell::new(self.special.get()) }
    }

    fn kept(&self) -> Option<Vec<Two>> {
        (!self.special.get()).then(|| self.guards.borrow().clone())
    }

    fn sign(&self, f: &Two) -> i32 {
        let sign = crate::arith::sign(&self.near(f));
        if f.is_number() {
            return sign;
        }
        if sign == 0 {
            self.special.set(true);
        }
        let mut guards = self.guards.borrow_mut();
        let f = f.monic();
        if !guards.contains(&f) {
            guards.push(f);
        }
        sign
    }

    fn primitive(&self, v: &[Two]) -> Option<Vec<Two>> {
        self.is_not_zero(v).then(|| v.to_vec())
    }

    fn near(&self, f: &Two) -> Rational {
        f.eval(&self.at.0, &self.at.1)
    }

    fn is_around(&self) -> bool {
        true
    }
}

/// A fact about G¹ with the indices of its guards and their signs.
struct Held {
    verdict: Verdict,
    why: Why,
    guards: Vec<(usize, i32)>,
}

/// A box that waits, with the signs of guards that are known there.
struct Waiting {
    area: Area,
    depth: usize,
    signs: Vec<Option<i32>>,
    contracts: bool,
}

struct Covering<'a> {
    family: &'a CurveFamily<Two>,
    arguments: Arguments<'a, Two>,
    guards: Vec<Two>,
    facts: Vec<Held>,
    /// By word the guards of which one that is negative refutes contraction.
    words: Vec<(Vec<usize>, Vec<usize>)>,
}

/// Words that are looked at for an eigenvalue outside the unit disc.
const LETTERS: usize = 2;
/// Products that are formed to show contraction on a box.
const PRODUCTS: usize = 160;
/// Boxes that are left whose guards are looked at for borders.
const UNSIGNED: usize = 800;
/// Denominators of values at which arguments are looked for.
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
        let signs = vec![None; covering.guards.len()];
        let first = Waiting { area: whole.clone(), depth: 0, signs, contracts: false };
        let mut queue: VecDeque<Waiting> = [first].into();
        let (mut boxes, mut examined, mut ended) = (Vec::new(), 0, Ended::Done);
        let mut unsigned: Vec<Vec<usize>> = Vec::new();
        while let Some(mut own) = queue.pop_front() {
            crate::stop::check();
            let late = limits.time.is_some_and(|t| begun.elapsed() >= t);
            let known = if late || examined >= limits.boxes {
                ended = if late { Ended::Clock } else { Ended::Work };
                Known::Open
            } else {
                examined += 1;
                covering.known(&mut own)
            };
            let size = 1_usize << (2 * (limits.depth - own.depth));
            if known == Known::Open && own.depth < limits.depth && ended == Ended::Done {
                queue.extend(own.quarters());
                continue;
            }
            if known == Known::Open {
                if unsigned.len() < UNSIGNED {
                    unsigned.push(covering.unsigned(&mut own));
                }
            }
            step(size);
            boxes.push(PlaneBox { area: own.area, known });
        }
        let open = boxes.iter().any(|b| b.known == Known::Open);
        let ended = if open && ended == Ended::Done { Ended::Exhausted } else { ended };
        PlaneRegion { boxes, borders: covering.borders(&unsigned), ended }
    }
}

impl Waiting {
    fn quarters(&self) -> Vec<Self> {
        let halves = |(lo, hi): &(Rational, Rational)| {
            let middle = (lo + hi) / Rational::from(2);
            [(lo.clone(), middle.clone()), (middle, hi.clone())]
        };
        let (first, second) = (halves(&self.area.first), halves(&self.area.second));
        let quarter = |p: &(Rational, Rational), q: &(Rational, Rational)| Self {
            area: Area { first: p.clone(), second: q.clone() },
            depth: self.depth + 1,
            signs: self.signs.clone(),
            contracts: self.contracts,
        };
        first.iter().flat_map(|p| second.iter().map(move |q| quarter(p, q))).collect()
    }
}

impl<'a> Covering<'a> {
    fn new(family: &'a CurveFamily<Two>) -> Self {
        let arguments = Arguments::new(family);
        let mut covering = Self { family, arguments, guards: Vec::new(), facts: Vec::new(), words: Vec::new() };
        let letters = family.linear.len();
        let mut words: Vec<Vec<usize>> = vec![Vec::new()];
        for _ in 0..LETTERS {
            let longer: Vec<Vec<usize>> =
                words.iter().flat_map(|w| (0..letters).map(move |l| [w.as_slice(), &[l]].concat())).collect();
            for word in &longer {
                covering.word(word);
            }
            words = longer;
        }
        covering
    }

    fn guard(&mut self, f: &Two) -> usize {
        if let Some(k) = self.guards.iter().position(|g| g == f) {
            return k;
        }
        self.guards.push(f.clone());
        self.guards.len() - 1
    }

    /// `χ(1) < 0`, or `(−1)ⁿ χ(−1) < 0`, or `1 − d < 0` or `1 + d < 0` for the determinant `d`: then an eigenvalue lies outside the
    /// unit disc.
    fn word(&mut self, word: &[usize]) {
        let m = self.family.product(word);
        let chi = m.char_poly_over(&Two::ring());
        let one = Two::number(Rational::from(1));
        let at = |x: i64| chi.iter().rev().fold(Two::nought(), |v, c| v.multiple(&ratio(x, 1)).plus(c));
        let minus = if m.rows().is_multiple_of(2) { at(-1) } else { at(-1).multiple(&ratio(-1, 1)) };
        let d = determinant(&m);
        let own = [at(1), minus, one.minus(&d), one.plus(&d)];
        let indices = own.iter().filter(|f| !f.is_number()).map(|f| self.guard(f)).collect();
        self.words.push((word.to_vec(), indices));
    }

    /// The sign of a guard on a box.
    fn sign(&self, own: &mut Waiting, k: usize) -> Option<i32> {
        own.signs.resize(self.guards.len(), None);
        if own.signs[k].is_none() {
            own.signs[k] = self.guards[k].strict_sign(&own.area.first, &own.area.second);
        }
        own.signs[k]
    }

    fn known(&mut self, own: &mut Waiting) -> Known {
        if !own.contracts {
            let words = std::mem::take(&mut self.words);
            let found = words.iter().find(|(_, all)| all.iter().any(|k| self.sign(own, *k) == Some(-1)));
            let found = found.map(|(word, _)| word.clone());
            self.words = words;
            if let Some(word) = found {
                return Known::Expands(word);
            }
            own.contracts = self.contracts(&own.area);
            if !own.contracts {
                return Known::Open;
            }
        }
        if let Some(k) = self.fact_on(own) {
            return Known::Curve(self.facts[k].verdict, self.facts[k].why.clone());
        }
        let (p, q) = (inside(&own.area.first, SPOTS[0]), inside(&own.area.second, SPOTS[1]));
        if self.holds_at(&p, &q) || !self.look(&(p, q)) {
            return Known::Open;
        }
        match self.fact_on(own) {
            Some(k) => Known::Curve(self.facts[k].verdict, self.facts[k].why.clone()),
            None => Known::Open,
        }
    }

    /// A fact whose guards have its signs on the whole box.
    fn fact_on(&self, own: &mut Waiting) -> Option<usize> {
        (0..self.facts.len()).find(|f| self.facts[*f].guards.iter().all(|(k, s)| self.sign(own, *k) == Some(*s)))
    }

    /// Whether a fact holds at a value: then another look would find nothing new.
    fn holds_at(&self, p: &Rational, q: &Rational) -> bool {
        let sign = |k: usize| crate::arith::sign(&self.guards[k].eval(p, q));
        self.facts.iter().any(|f| f.guards.iter().all(|(k, s)| sign(*k) == *s))
    }

    /// Looks for an argument about G¹ at a value.
    fn look(&mut self, at: &(Rational, Rational)) -> bool {
        let facts: Vec<Fact<Two>> = self.arguments.facts(&Spot::new(at));
        let Some(fact) = facts.into_iter().find(|f| f.claim == CurveClaim::G1) else { return false };
        let guards = fact.guards.iter().map(|f| (self.guard(f), crate::arith::sign(&f.eval(&at.0, &at.1)))).collect();
        self.facts.push(Held { verdict: fact.verdict, why: fact.why, guards });
        true
    }

    /// Whether products of operators shrink all differences for every value of a box: along every infinite word one of finitely many
    /// words occurs first, and all of these shrink.
    fn contracts(&self, area: &Area) -> bool {
        let bounds = [&area.first, &area.second].map(|(lo, hi)| Interval::new(lo.clone(), hi.clone()));
        let letters: Vec<Matrix<Interval>> = self.family.operators.iter().map(|m| m.map(|f| on(f, &bounds))).collect();
        let mut queue: VecDeque<Matrix<Interval>> = letters.iter().cloned().collect();
        let mut formed = letters.len();
        while let Some(m) = queue.pop_front() {
            if shrinks(&m) {
                continue;
            }
            formed += letters.len();
            if formed > PRODUCTS {
                return false;
            }
            queue.extend(letters.iter().map(|l| product(&m, l)));
        }
        true
    }

    /// The guards without a sign on a box.
    fn unsigned(&self, own: &mut Waiting) -> Vec<usize> {
        (0..self.guards.len()).filter(|k| self.sign(own, *k).is_none()).collect()
    }

    /// Factors of guards that are the only ones without a sign on some box that was left.
    fn borders(&self, unsigned: &[Vec<usize>]) -> Vec<Two> {
        let mut base: Vec<Two> = Vec::new();
        let mut guards: Vec<&Two> = self.guards.iter().collect();
        guards.sort_by_key(|f| f.degree() + f.rows().len());
        for f in guards {
            let rest = base.iter().fold(f.clone(), |mut rest, g| {
                while let Some(quotient) = rest.divided(g) {
                    rest = quotient;
                }
                rest
            });
            if !rest.is_number() {
                base.push(rest.monic());
            }
        }
        let divides = |g: &Two, k: usize| self.guards[k].divided(g).is_some();
        let mut found: Vec<Two> = Vec::new();
        for all in unsigned {
            let own: Vec<&Two> = base.iter().filter(|g| all.iter().any(|k| divides(g, *k))).collect();
            // Every guard without a sign has such a factor: one factor alone explains them all.
            for g in &own {
                if all.iter().all(|k| divides(g, *k)) && !found.contains(g) {
                    found.push((*g).clone());
                }
            }
        }
        found.sort();
        found
    }
}

/// A short value inside a range.
fn inside((lo, hi): &(Rational, Rational), (a, b): (i64, i64)) -> Rational {
    let at = |share: Rational| lo + (hi - lo) * share;
    Rational::simplest_rational_in_open_interval(&at(ratio(a, b)), &at(ratio(a + 2, b)))
}

/// The values of a polynomial on a box.
fn on(f: &Two, [p, q]: &[Interval; 2]) -> Interval {
    let zero = || Interval::point(Rational::from(0));
    let number = |c: &Rational| Interval::point(c.clone());
    let row = |r: &crate::poly::Poly| r.coeffs().iter().rev().fold(zero(), |v, c| &(&v * p) + &number(c));
    f.rows().iter().rev().fold(zero(), |v, r| &(&v * q) + &row(r))
}

fn product(a: &Matrix<Interval>, b: &Matrix<Interval>) -> Matrix<Interval> {
    let zero = || Interval::point(Rational::from(0));
    let entry = |i: usize, j: usize| (0..a.cols()).fold(zero(), |s, l| &s + &(&a[(i, l)] * &b[(l, j)]));
    Matrix::from_fn(a.rows(), b.cols(), entry)
}

/// Whether half the largest sum of differences of two columns is below 1.
fn shrinks(m: &Matrix<Interval>) -> bool {
    let apart =
        |j: usize, k: usize| (0..m.rows()).fold(Rational::from(0), |s, i| s + (&m[(i, j)] - &m[(i, k)]).magnitude());
    (0..m.cols()).all(|j| (0..j).all(|k| apart(j, k) < 2))
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
        own().find(|k| **k != Known::Open).or_else(|| own().next())
    }
}
