//! What holds of a curve with two parameters where which polynomials have which signs.

use super::curve::CurveFamily;
use super::fact::{Fact, Why};
use super::plane::Known;
use super::plane_box::Waiting;
use super::signs::{determinant, horner};
use super::symbol::Symbol;
use crate::answer::Verdict;
use crate::arith::{Rational, ratio, sign};
use crate::poly::{Poly, Two, factor};

/// A fact about G¹ with the indices of its guards and their signs.
struct Held {
    verdict: Verdict,
    why: Why,
    guards: Vec<(usize, i32)>,
}

/// A polynomial that refutes contraction where it is negative, with its factors.
struct Test {
    whole: usize,
    factors: Vec<usize>,
}

/// Facts and words with their guards.
pub(super) struct Ledger<'a> {
    family: &'a CurveFamily<Two>,
    /// Polynomials whose signs are asked for on boxes.
    guards: Vec<Two>,
    /// The indices of those that divide others.
    base: Vec<usize>,
    facts: Vec<Held>,
    words: Vec<(Vec<usize>, Vec<Test>)>,
}

/// Words that are looked at for an eigenvalue outside the unit disc.
const LETTERS: usize = 2;

impl<'a> Ledger<'a> {
    pub fn new(family: &'a CurveFamily<Two>) -> Self {
        let mut ledger = Self { family, guards: Vec::new(), base: Vec::new(), facts: Vec::new(), words: Vec::new() };
        // Entries are factors of much that is asked for.
        for f in family.linear.iter().flat_map(|m| m.entries()).filter(|f| !f.is_zero()) {
            ledger.factors(f);
        }
        let letters = family.linear.len();
        let mut words: Vec<Vec<usize>> = vec![Vec::new()];
        for _ in 0..LETTERS {
            let longer: Vec<Vec<usize>> =
                words.iter().flat_map(|w| (0..letters).map(move |l| [w.as_slice(), &[l]].concat())).collect();
            for word in &longer {
                ledger.word(word);
            }
            words = longer;
        }
        ledger
    }

    fn index(&mut self, f: &Two) -> usize {
        if let Some(k) = self.guards.iter().position(|g| g == f) {
            return k;
        }
        self.guards.push(f.clone());
        self.guards.len() - 1
    }

    /// Factors of a polynomial other than 0, each once: it has no other zeros than theirs.
    fn factors(&mut self, f: &Two) -> Vec<usize> {
        let (mut rest, mut found) = (f.primitive(), Vec::new());
        let known = self.base.clone();
        for k in known {
            while !rest.is_number()
                && let Some(quotient) = rest.divided(&self.guards[k])
            {
                rest = quotient;
                if !found.contains(&k) {
                    found.push(k);
                }
            }
        }
        for swapped in [false, true] {
            let turned = if swapped { rest.swapped() } else { rest.clone() };
            let content = turned.rows().iter().fold(Poly::zero(), |g, r| g.gcd(r));
            if content.degree().is_none_or(|d| d == 0) {
                continue;
            }
            let whole = Two::new(vec![content.clone()]);
            if let Some(quotient) = turned.divided(&whole) {
                rest = if swapped { quotient.swapped() } else { quotient };
            }
            for (g, _) in factor(&content) {
                let own = Two::new(vec![g]);
                found.push(self.divisor(&if swapped { own.swapped() } else { own }));
            }
        }
        if !rest.is_number() {
            found.push(self.divisor(&rest));
        }
        found
    }

    fn divisor(&mut self, f: &Two) -> usize {
        let k = self.index(&f.primitive());
        if !self.base.contains(&k) {
            self.base.push(k);
        }
        k
    }

    /// `χ(1) < 0`, or `(−1)ⁿ χ(−1) < 0`, or `1 − d < 0` or `1 + d < 0` for the determinant `d`: then an eigenvalue lies outside the
    /// unit disc.
    fn word(&mut self, word: &[usize]) {
        let m = self.family.product(word);
        let chi = m.char_poly_over(&Two::ring());
        let number = |x: i64| Two::number(ratio(x, 1));
        let turned = if m.rows().is_multiple_of(2) { 1 } else { -1 };
        let minus = horner(&chi, &number(-1)).multiple(&ratio(turned, 1));
        let d = determinant(&m);
        let own = [horner(&chi, &number(1)), minus, number(1).minus(&d), number(1).plus(&d)];
        let tests: Vec<Test> = own
            .iter()
            .filter(|f| !f.is_number())
            .map(|f| Test { whole: self.index(f), factors: self.factors(f) })
            .collect();
        self.words.push((word.to_vec(), tests));
    }

    pub fn count(&self) -> usize {
        self.facts.len()
    }

    /// Keeps a fact that was found at a value.
    pub fn hold(&mut self, fact: Fact<Two>, (p, q): &(Rational, Rational)) {
        let mut all: Vec<usize> = fact.guards.iter().flat_map(|f| self.factors(f)).collect();
        all.sort_unstable();
        all.dedup();
        // No guard vanishes there, so that no factor does.
        let guards = all.into_iter().map(|k| (k, sign(&self.guards[k].eval(p, q)))).collect();
        self.facts.push(Held { verdict: fact.verdict, why: fact.why, guards });
    }

    /// What is known of a box.
    pub fn known(&self, mut own: Waiting) -> (Waiting, Known) {
        if !own.contracts {
            let mut negative = |t: &Test| own.sign(&self.guards, t.whole) == Some(-1);
            if let Some((word, _)) = self.words.iter().find(|(_, tests)| tests.iter().any(&mut negative)) {
                let word = word.clone();
                return (own, Known::Expands(word));
            }
            own.contracts = own.area.contracts(&self.family.operators);
            if !own.contracts {
                return (own, Known::Open);
            }
        }
        // Without a fact no more is known.
        match self.fact_on(&mut own, 0) {
            Some(fact) => (own, fact),
            None => (own, Known::Contracts),
        }
    }

    /// A fact, of those from one on, whose guards have its signs on the whole box.
    pub fn fact_on(&self, own: &mut Waiting, first: usize) -> Option<Known> {
        let holds = |f: &&Held| f.guards.iter().all(|(k, s)| own.sign(&self.guards, *k) == Some(*s));
        self.facts[first..].iter().find(holds).map(|f| Known::Curve(f.verdict, f.why.clone()))
    }

    /// Whether a fact holds at a value: then another look would find nothing new.
    pub fn holds_at(&self, (p, q): &(Rational, Rational)) -> bool {
        let own = |k: usize| sign(&self.guards[k].eval(p, q));
        self.facts.iter().any(|f| f.guards.iter().all(|(k, s)| own(*k) == *s))
    }

    /// The only factor of guards of a fact, or of a word where the box does not contract, that has no strict sign on a box that was
    /// left, where it takes both signs or 0 at the corners.
    pub fn border(&self, own: &Waiting) -> Option<Two> {
        let (area, contracts, mut own) = (&own.area, own.contracts, own.clone());
        let mut only = |all: &[usize]| {
            let mut open = all.iter().filter(|k| own.sign(&self.guards, **k).is_none());
            let first = open.next().copied();
            first.filter(|_| open.next().is_none())
        };
        let lists: Vec<Vec<usize>> = if contracts {
            self.facts.iter().map(|f| f.guards.iter().map(|g| g.0).collect()).collect()
        } else {
            self.words.iter().flat_map(|w| &w.1).map(|t| t.factors.clone()).collect()
        };
        let crosses = |f: &Two| {
            let corners =
                [&area.first.0, &area.first.1].map(|p| [&area.second.0, &area.second.1].map(|q| sign(&f.eval(p, q))));
            let all = corners.as_flattened();
            all.iter().any(|s| *s <= 0) && all.iter().any(|s| *s >= 0)
        };
        lists.iter().filter_map(|all| only(all)).map(|k| &self.guards[k]).find(|f| crosses(f)).cloned()
    }
}
