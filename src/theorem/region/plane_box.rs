//! What is known of one box of two parameters: signs of polynomials, and contraction.

use super::plane::{Area, Known};
use super::signs::Signs;
use crate::arith::{Interval, Rational, ratio};
use crate::linalg::Matrix;
use crate::poly::Two;
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;
use std::cell::{Cell, RefCell};
use std::collections::VecDeque;

/// Signs at a rational value of two parameters.
pub(super) struct Spot<'a> {
    at: &'a (Rational, Rational),
    guards: RefCell<Vec<Two>>,
    special: Cell<bool>,
}

impl<'a> Spot<'a> {
    pub fn new(at: &'a (Rational, Rational)) -> Self {
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

/// A box that waits, with the signs of guards that are known there.
#[derive(Clone)]
pub(super) struct Waiting {
    pub area: Area,
    pub depth: usize,
    pub contracts: bool,
    signs: Vec<Option<i32>>,
}

impl Waiting {
    pub fn new(area: Area) -> Self {
        Self { area, depth: 0, contracts: false, signs: Vec::new() }
    }

    pub fn quarters(&self) -> Vec<Self> {
        let halves = |(lo, hi): &(Rational, Rational)| {
            let middle = (lo + hi) / Rational::from(2);
            [(lo.clone(), middle.clone()), (middle, hi.clone())]
        };
        let (first, second) = (halves(&self.area.first), halves(&self.area.second));
        let quarter = |p: &(Rational, Rational), q: &(Rational, Rational)| Self {
            area: Area { first: p.clone(), second: q.clone() },
            depth: self.depth + 1,
            ..self.clone()
        };
        first.iter().flat_map(|p| second.iter().map(move |q| quarter(p, q))).collect()
    }

    /// The sign of a guard on the box.
    pub fn sign(&mut self, guards: &[Two], k: usize) -> Option<i32> {
        if self.signs.len() <= k {
            self.signs.resize(guards.len(), None);
        }
        if self.signs[k].is_none() {
            self.signs[k] = guards[k].strict_sign(&self.area.first, &self.area.second);
        }
        self.signs[k]
    }

    /// What is known of a box that is not examined any more.
    pub fn left(self) -> (Self, Known) {
        let known = if self.contracts { Known::Contracts } else { Known::Open };
        (self, known)
    }
}

/// Products that are formed to show contraction on a box.
const PRODUCTS: usize = 160;

impl Area {
    /// Whether products of operators shrink all differences for every value of the box: along every infinite word one of finitely many
    /// words occurs first, and all of these shrink.
    pub(super) fn contracts(&self, operators: &[Matrix<Two>]) -> bool {
        let bounds = [&self.first, &self.second].map(|(lo, hi)| Interval::new(lo.clone(), hi.clone()));
        let letters: Vec<Matrix<Interval>> = operators.iter().map(|m| m.map(|f| on(f, &bounds))).collect();
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
}

/// A short value inside a range.
pub(super) fn inside((lo, hi): &(Rational, Rational), (a, b): (i64, i64)) -> Rational {
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
