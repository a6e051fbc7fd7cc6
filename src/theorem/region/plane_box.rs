//! What is known of one box of two parameters: signs of polynomials, and contraction.

use super::plane::{Area, Known};
use super::signs::{Asked, Signs};
use crate::arith::{Integer, Interval, Rational, ratio};
use crate::linalg::Matrix;
use crate::poly::{Poly, Two};
use crate::ring::{Enclosures, Field, Fixed, Ring};
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;
use std::collections::VecDeque;

/// Signs at a rational value of two parameters.
#[derive(Clone)]
pub(super) struct Spot<'a> {
    at: &'a (Rational, Rational),
    asked: Asked<Two>,
}

impl<'a> Spot<'a> {
    pub fn new(at: &'a (Rational, Rational)) -> Self {
        Self { at, asked: Asked::new() }
    }
}

impl Signs<Two> for Spot<'_> {
    fn mark(&self) -> (usize, bool) {
        self.asked.mark()
    }

    fn forget(&self, mark: (usize, bool)) {
        self.asked.forget(mark);
    }

    fn kept(&self) -> Option<Vec<Two>> {
        self.asked.kept()
    }

    fn sign(&self, f: &Two) -> i32 {
        let sign = crate::arith::sign(&self.near(f));
        if f.is_number() {
            return sign;
        }
        self.asked.note(f.monic(), sign == 0);
        sign
    }

    fn primitive(&self, v: &[Two]) -> Option<Vec<Two>> {
        let common = v.iter().fold(Two::number(Rational::from(0)), |g, x| g.gcd(x));
        let sign = self.sign(&common);
        let divided: Option<Vec<Two>> = v.iter().map(|x| x.divided(&common)).collect();
        divided.map(|v| super::signs::scaled(&v, sign)).filter(|v| sign != 0 && self.is_not_zero(v))
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
    /// 0 for those that have no strict sign here.
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
            contracts: self.contracts,
            signs: self.signs.iter().map(|s| s.filter(|s| *s != 0)).collect(),
        };
        first.iter().flat_map(|p| second.iter().map(move |q| quarter(p, q))).collect()
    }

    /// The sign of a guard on the box.
    pub fn sign(&mut self, guards: &[Two], k: usize) -> Option<i32> {
        if self.signs.len() <= k {
            self.signs.resize(guards.len(), None);
        }
        let (first, second) = (&self.area.first, &self.area.second);
        // 0 where it has none.
        let sign = *self.signs[k].get_or_insert_with(|| guards[k].strict_sign(first, second).into_iter().sum());
        Some(sign).filter(|s| *s != 0)
    }

    /// What is known of a box that is not examined any more.
    pub fn left(self) -> (Self, Known) {
        let known = if self.contracts { Known::Contracts } else { Known::Open };
        (self, known)
    }
}

/// Enclosures of what products of operators are on a box.
const FIXED: Enclosures = Enclosures { bits: 64 };
/// Products that are formed to show contraction on a box.
const PRODUCTS: usize = 160;

impl Area {
    /// Whether products of operators shrink all differences for every value of the box: along every infinite word one of finitely many
    /// words occurs first, and all of these shrink.
    pub(super) fn contracts(&self, operators: &[Matrix<Two>]) -> bool {
        let bounds = [&self.first, &self.second].map(|(lo, hi)| FIXED.interval(&Interval::new(lo.clone(), hi.clone())));
        let letters: Vec<Matrix<Fixed>> = operators.iter().map(|m| m.map(|f| on(f, &bounds))).collect();
        let mut queue: VecDeque<Matrix<Fixed>> = letters.iter().cloned().collect();
        let mut formed = letters.len();
        while let Some(m) = queue.pop_front() {
            if shrinks(&m) {
                continue;
            }
            formed += letters.len();
            if formed > PRODUCTS {
                return false;
            }
            queue.extend(letters.iter().map(|l| m.mul_over(&FIXED, l)));
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
fn on(f: &Two, [p, q]: &[Fixed; 2]) -> Fixed {
    let row = |r: &Poly| FIXED.eval(r, p);
    f.rows().iter().rev().fold(FIXED.zero(), |v, r| FIXED.add(&FIXED.mul(&v, q), &row(r)))
}

/// Whether half the largest sum of differences of two columns is below 1.
fn shrinks(m: &Matrix<Fixed>) -> bool {
    let two = FIXED.integer(&Integer::from(2)).lo;
    let size = |x: Fixed| (-x.lo).max(x.hi);
    let apart =
        |j: usize, k: usize| (0..m.rows()).fold(Integer::from(0), |s, i| s + size(FIXED.sub(&m[(i, j)], &m[(i, k)])));
    (0..m.cols()).all(|j| (0..j).all(|k| apart(j, k) < two))
}
