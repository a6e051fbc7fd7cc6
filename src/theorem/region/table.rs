//! The range of a family of curves in open intervals and single points.

#![allow(clippy::float_arithmetic, reason = "widths say what is tried next")]

use super::argue::Arguments;
use super::curve::CurveFamily;
use super::fact::{CurveClaim, Fact, Why};
use super::signs::At;
use super::{MEMBERS, Purse, RegionError};
use crate::algebraic::{Root, between, cmp_real, lies_within, roots_within, sorted};
use crate::answer::Verdict;
use crate::arith::{Rational, ratio, to_f64};
use crate::budget::Budget;
use crate::poly::Poly;
use crate::radius::family::{Below, Place, Search, below};
use crate::theorem::{Assertion, Certified, certify_within};
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// What a part of the range rests on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Basis {
    /// The joint spectral radius is below 1, by the hull with this index.
    Hull(usize),
    /// It is at least 1, by the word with this index.
    Word(usize),
    /// The system does not contract, or that is not decided: nothing is claimed of the curve.
    NoContraction,
    /// An argument about polynomials that have one sign there.
    Argument(Why),
    /// The member was asked by itself (`secant certify`).
    Member,
    /// An irrational value at which no argument decides.
    Irrational,
    /// No argument was found.
    Gap,
    /// Neither a hull nor a word was found; [`Below::ended`] says why no more were tried.
    Search,
}

/// An open interval, or a point where both ends are the same, with a verdict.
#[derive(Debug, Clone)]
pub struct CurvePart {
    /// The lower end.
    pub from: Root,
    /// The upper end.
    pub to: Root,
    /// The verdict.
    pub verdict: Verdict,
    /// Why.
    pub basis: Basis,
    /// The index in [`CurveRegions::facts`] of the argument, and the hull that proves contraction there.
    pub fact: Option<(usize, usize)>,
}

impl CurvePart {
    /// Whether it is a single point.
    #[must_use]
    pub fn is_point(&self) -> bool {
        self.from.same(&self.to)
    }
}

/// What is claimed in one table: contraction, or something of the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The system contracts.
    Contraction,
    /// A claim about the curve, where it does.
    Curve(CurveClaim),
}

/// A claim on the range.
#[derive(Debug, Clone)]
pub struct CurveTable {
    /// The claim.
    pub subject: Subject,
    /// The parts, ascending, each with one reason; together they are the range.
    pub fine: Vec<CurvePart>,
    /// The same with neighbours of one verdict and reason joined, where no single point is between.
    pub parts: Vec<CurvePart>,
}

impl CurveTable {
    /// What is said of a value of the range.
    #[must_use]
    pub fn at(&self, p: &Root) -> Option<Verdict> {
        self.parts.iter().find(|part| lies_within(p, &part.from, &part.to)).map(|part| part.verdict)
    }
}

/// The tables of a family of curves.
#[derive(Debug, Clone)]
pub struct CurveRegions {
    /// Contraction: words and hulls.
    pub radius: Below,
    /// The arguments.
    pub facts: Vec<Fact>,
    /// The tables: contraction, then the claims.
    pub tables: Vec<CurveTable>,
}

/// A fact with the open interval on which its polynomials do not vanish.
struct Known {
    fact: Fact,
    from: Root,
    to: Root,
}

struct Covering<'a> {
    family: &'a CurveFamily,
    range: (Rational, Rational),
    arguments: Arguments<'a, Poly>,
    radius: Below,
    known: Vec<Known>,
    failed: Vec<(CurveClaim, Root)>,
    roots: BTreeMap<Vec<Rational>, Vec<Root>>,
}

/// Members at which arguments are looked for.
const SAMPLES: usize = 90;

impl CurveFamily {
    /// Where in a closed range the curve contracts, has tangents at its ends and joints, and is G¹.
    ///
    /// # Errors
    /// [`RegionError::Range`].
    ///
    /// # Cost
    /// [`below`] once, linear algebra with polynomials at each of at most 90 members, and `certify` at every rational border.
    pub fn regions(
        &self,
        range: &(Rational, Rational),
        search: &Search,
        budget: &Budget,
    ) -> Result<CurveRegions, RegionError> {
        if range.0 >= range.1 {
            return Err(RegionError::Range);
        }
        let pencil = self.pencil().ok_or(RegionError::Length)?;
        let mut purse = Purse::new(search);
        let radius = below(&pencil, range, &purse.share(2));
        purse.pay(radius.spent);
        let mut covering = Covering {
            family: self,
            range: range.clone(),
            arguments: Arguments::new(self, true),
            radius,
            known: Vec::new(),
            failed: Vec::new(),
            roots: BTreeMap::new(),
        };
        for _ in 0..SAMPLES {
            let Some(hole) = covering.widest(&search.width) else { break };
            if purse.timed(|| covering.look(&hole)).is_none() {
                break;
            }
        }
        let mut borders = Borders { budget, purse, left: MEMBERS, members: Vec::new(), facts: Vec::new() };
        let mut tables = vec![covering.contraction()];
        for claim in CurveClaim::ALL {
            tables.push(covering.table(claim, &mut borders));
        }
        let facts = covering.known.into_iter().map(|k| k.fact).chain(borders.facts).collect();
        Ok(CurveRegions { radius: covering.radius, facts, tables })
    }
}

/// An open interval on which a claim is not decided.
struct Hole {
    claim: CurveClaim,
    from: Root,
    to: Root,
    width: f64,
}

/// Borders that are asked by themselves.
struct Borders<'a> {
    budget: &'a Budget,
    purse: Purse<'a>,
    /// Members that may still be asked.
    left: usize,
    members: Vec<(Rational, Option<Certified>)>,
    /// Arguments at irrational ones.
    facts: Vec<Fact>,
}

impl Borders<'_> {
    /// What a rational member by itself says.
    fn member(&mut self, family: &CurveFamily, q: &Rational, claim: CurveClaim) -> Verdict {
        if self.members.iter().all(|(known, _)| known != q) {
            let budget = Budget { radius: self.purse.options(), ..self.budget.clone() };
            let asked = || certify_within(&family.member(q), &[], &budget).ok();
            let found = if self.left > 0 { self.purse.timed(asked).flatten() } else { None };
            self.left = self.left.saturating_sub(1);
            self.members.push((q.clone(), found));
        }
        let found = self.members.iter().find(|(known, _)| known == q).and_then(|(_, c)| c.as_ref());
        found.map_or(Verdict::Undetermined, |c| member_verdict(c, claim))
    }
}

impl Covering<'_> {
    /// The ends of parts that belong to a claim, ascending.
    fn marks(&self, claim: CurveClaim) -> Vec<Root> {
        let own = self.known.iter().filter(|k| k.fact.claim == claim).flat_map(|k| [k.from.clone(), k.to.clone()]);
        let mut marks = self.radius.marks();
        marks.extend(own);
        sorted(marks, &self.range)
    }

    /// The fact that decides a claim on an open part without marks inside, or at a point.
    fn fact(&self, claim: CurveClaim, from: &Root, to: &Root) -> Option<usize> {
        let point = from.same(to);
        let covers = |k: &&Known| {
            let (low, high) = (cmp_real(&k.from, from), cmp_real(to, &k.to));
            k.fact.claim == claim && if point { low.is_lt() && high.is_lt() } else { low.is_le() && high.is_le() }
        };
        self.known.iter().position(|k| covers(&k))
    }

    fn widest(&self, least: &Rational) -> Option<Hole> {
        let least = to_f64(least);
        let mut all: Vec<Hole> = Vec::new();
        for claim in CurveClaim::ALL {
            let mut marks = self.marks(claim);
            marks.extend(self.failed.iter().filter(|f| f.0 == claim).map(|f| f.1.clone()));
            for pair in sorted(marks, &self.range).windows(2) {
                let inside = Root::from_rational(&between(&pair[0], &pair[1]));
                let contracts = matches!(self.radius.place(&inside), Place::Below(_));
                let width = pair[1].to_f64().0 - pair[0].to_f64().0;
                if contracts && width > least && self.fact(claim, &pair[0], &pair[1]).is_none() {
                    all.push(Hole { claim, from: pair[0].clone(), to: pair[1].clone(), width });
                }
            }
        }
        all.into_iter().max_by(|a, b| a.width.total_cmp(&b.width))
    }

    /// Arguments at a member inside a hole.
    fn look(&mut self, hole: &Hole) {
        let (from, to) = (hole.from.enclosure(64).0.hi, hole.to.enclosure(64).0.lo);
        let at = |part| &from + (&to - &from) * part;
        let p = Rational::simplest_rational_in_open_interval(&at(ratio(2, 5)), &at(ratio(3, 5)));
        let point = Root::from_rational(&p);
        for fact in self.arguments.facts(&At::new(&point, true)) {
            let (from, to) = self.component(&fact, &point);
            self.known.push(Known { fact, from, to });
        }
        if !self.known.iter().any(|k| k.fact.claim == hole.claim && inside(&point, k)) {
            self.failed.push((hole.claim, point));
        }
    }

    /// The largest open interval around a value on which no polynomial of a fact vanishes, within the range or a little beyond.
    fn component(&mut self, fact: &Fact, point: &Root) -> (Root, Root) {
        let one = Rational::from(1);
        // Beyond the range, so that its ends may lie inside.
        let wide = (&self.range.0 - &one, &self.range.1 + &one);
        let (mut low, mut high) = (Root::from_rational(&wide.0), Root::from_rational(&wide.1));
        for guard in &fact.guards {
            let roots = self.roots.entry(guard.coeffs().to_vec()).or_insert_with(|| roots_within(guard, &wide));
            for root in roots.iter() {
                match cmp_real(root, point) {
                    Ordering::Less if cmp_real(root, &low).is_gt() => low = root.clone(),
                    Ordering::Greater if cmp_real(root, &high).is_lt() => high = root.clone(),
                    _ => {}
                }
            }
        }
        (low, high)
    }

    fn contraction(&self) -> CurveTable {
        let find = |p: &Root| match self.radius.place(p) {
            Place::Below(k) => (Verdict::Proved, Basis::Hull(k), None),
            Place::AtLeast(k) => (Verdict::Refuted, Basis::Word(k), None),
            Place::Open => (Verdict::Undetermined, Basis::Search, None),
        };
        let fine = split(&self.radius.marks(), |_, _, inside| find(inside));
        CurveTable { subject: Subject::Contraction, parts: joined(fine.clone()), fine }
    }

    fn table(&self, claim: CurveClaim, borders: &mut Borders<'_>) -> CurveTable {
        let mut fine = split(&self.marks(claim), |from, to, inside| {
            let Place::Below(hull) = self.radius.place(inside) else {
                return (Verdict::Undetermined, Basis::NoContraction, None);
            };
            match self.fact(claim, from, to) {
                Some(k) => {
                    let fact = &self.known[k].fact;
                    (fact.verdict, Basis::Argument(fact.why.clone()), Some((k, hull)))
                }
                None => (Verdict::Undetermined, Basis::Gap, None),
            }
        });
        // Ends of hulls inside a gap are no borders.
        let decided = |fine: &[CurvePart], at: Option<usize>| {
            at.and_then(|at| fine.get(at)).is_some_and(|part| matches!(part.basis, Basis::Argument(_)))
        };
        for k in 0..fine.len() {
            let beside = decided(&fine, k.checked_sub(1)) || decided(&fine, Some(k + 1));
            if !beside || !fine[k].is_point() || fine[k].basis != Basis::Gap {
                continue;
            }
            let p = fine[k].from.clone();
            let Place::Below(hull) = self.radius.place(&p) else { continue };
            (fine[k].verdict, fine[k].basis, fine[k].fact) = self.border(claim, &p, hull, borders);
        }
        CurveTable { subject: Subject::Curve(claim), parts: joined(fine.clone()), fine }
    }

    /// A border by itself: a rational one as a case of its own, any other by the arguments there.
    fn border(&self, claim: CurveClaim, p: &Root, hull: usize, borders: &mut Borders<'_>) -> Said {
        if let Some(q) = p.rational() {
            return (borders.member(self.family, &q, claim), Basis::Member, None);
        }
        let found = borders.purse.timed(|| self.arguments.facts(&At::new(p, false)));
        match found.into_iter().flatten().find(|f| f.claim == claim) {
            Some(fact) => {
                let said = (fact.verdict, Basis::Argument(fact.why.clone()));
                let index = self.known.len() + borders.facts.len();
                borders.facts.push(fact);
                (said.0, said.1, Some((index, hull)))
            }
            None => (Verdict::Undetermined, Basis::Irrational, None),
        }
    }
}

/// What is said of a part.
type Said = (Verdict, Basis, Option<(usize, usize)>);

fn inside(p: &Root, known: &Known) -> bool {
    cmp_real(&known.from, p).is_lt() && cmp_real(p, &known.to).is_lt()
}

/// What a member by itself says of a claim.
#[must_use]
pub fn member_verdict(found: &Certified, claim: CurveClaim) -> Verdict {
    let mut of = found.claims.iter().filter(|c| match claim {
        CurveClaim::Ends => c.what == Assertion::TangentAtEnds,
        CurveClaim::Joints => c.what == Assertion::DenseJoints,
        CurveClaim::G1 => c.what == Assertion::G1,
    });
    match of.next() {
        Some(own) => own.verdict(),
        None => Verdict::Undetermined,
    }
}

/// Points and open intervals between marks, in turn.
fn split(marks: &[Root], mut find: impl FnMut(&Root, &Root, &Root) -> Said) -> Vec<CurvePart> {
    let mut parts = Vec::new();
    let mut push = |from: &Root, to: &Root, inside: &Root| {
        let (verdict, basis, fact) = find(from, to, inside);
        parts.push(CurvePart { from: from.clone(), to: to.clone(), verdict, basis, fact });
    };
    for (k, mark) in marks.iter().enumerate() {
        push(mark, mark, mark);
        if let Some(next) = marks.get(k + 1) {
            push(mark, next, &Root::from_rational(&between(mark, next)));
        }
    }
    parts
}

/// Points that say what both intervals beside them say, for one kind of reason, become part of these.
fn joined(parts: Vec<CurvePart>) -> Vec<CurvePart> {
    let mut all: Vec<CurvePart> = Vec::new();
    let mut rest = parts.into_iter().peekable();
    while let Some(part) = rest.next() {
        let alike = |other: &CurvePart| {
            let hulls = matches!((&other.basis, &part.basis), (Basis::Hull(_), Basis::Hull(_)));
            !other.is_point() && other.verdict == part.verdict && (hulls || other.basis == part.basis)
        };
        if part.is_point()
            && all.last().is_some_and(alike)
            && rest.peek().is_some_and(alike)
            && let (Some(before), Some(after)) = (all.last_mut(), rest.next())
        {
            before.to = after.to;
            continue;
        }
        all.push(part);
    }
    all
}
