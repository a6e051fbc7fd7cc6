//! Regions of a curve with a parameter (docs/certificate.md, section 9.2): contraction, tangents at the ends and joints, and G¹.

use super::argument::{Argument, Here};
use super::hull::{self, Hull};
use super::polynomial::{End, Poly, common_divisor, minus, trimmed};
use super::symbolic::{Rows, adjugate, apply, characteristic, column, divided, identity, plus, product, times};
use super::{Word, state, word};
use crate::base::{Accepted, Checked, Matrix, Node, Q, Verdict, file, need, some, together};
use crate::claim::{Claim, CurveRegion};
use num_traits::{One, Zero};

const MAX_PIECES: usize = 8;
const MAX_DIMENSION: usize = 4;

/// A curve of one state.
pub struct Family {
    name: String,
    parameter: String,
    range: [Q; 2],
    pub reversed: Vec<bool>,
    /// On differences, in all coordinates but the first.
    pub linear: Vec<Rows>,
    /// The chord times a positive square, and what must not vanish for it.
    pub chord: Vec<Poly>,
    pub sums: [Poly; 2],
    pub germs: [Germ; 2],
}

/// How an end of the curve is reached: letters, then a cycle at the start or the end.
pub struct Germ {
    pub at_start: bool,
    pub prefix: Vec<usize>,
    pub cycle: Vec<usize>,
}

fn germ(reversed: &[bool], start: bool) -> Checked<Germ> {
    let (mut side, mut seen, mut letters) = (start, Vec::new(), Vec::new());
    loop {
        if let Some(k) = seen.iter().position(|s| *s == side) {
            return Ok(Germ { at_start: side, prefix: letters[..k].to_vec(), cycle: letters[k..].to_vec() });
        }
        seen.push(side);
        let letter = if side { 0 } else { reversed.len() - 1 };
        letters.push(letter);
        side ^= reversed[letter];
    }
}

fn sum(v: &[Poly]) -> Poly {
    v.iter().fold(Vec::new(), |s: Poly, x| plus(&s, x))
}

fn read(source: &str) -> Checked<Family> {
    file(source, "name parameter range reversed control pieces", |node| {
        let name = node.field("name")?.text()?.to_owned();
        let parameter = node.field("parameter")?.text()?.to_owned();
        let ends = node.field("range")?.vector(2)?;
        let range = [ends[0].clone(), ends[1].clone()];
        let flags = node.field("reversed")?.each(Node::rational)?;
        let bits = flags.iter().all(|f| f.is_zero() || f.is_one());
        let reversed: Vec<bool> = flags.iter().map(One::is_one).collect();
        let entry = |item: &Node<'_>| -> Checked<Poly> { Ok(trimmed(item.each(Node::rational)?)) };
        let operators: Vec<Rows> = node.field("pieces")?.each(|m| m.each(|row| row.each(entry)))?;
        let d = match operators.first() {
            Some(first) => first.len(),
            None => 0,
        };
        let square = |m: &Rows| m.len() == d && m.iter().all(|row| row.len() == d);
        let sound = bits
            && range[0] < range[1]
            && (2..=MAX_DIMENSION + 1).contains(&d)
            && (2..=MAX_PIECES).contains(&operators.len())
            && operators.len() == reversed.len()
            && operators.iter().all(square);
        node.need(sound, "case", "a range, and 2 to 8 square pieces of one size from 2 to 5 are needed")?;
        let one = vec![Q::one()];
        let affine = operators.iter().all(|m| (0..d).all(|j| sum(&column(m, j)) == one));
        node.need(affine, "case", "the columns add up to 1 for every value")?;
        let control = node.field("control")?.each(|row| row.vector(d))?;
        if !control.is_empty() {
            let difference = |row: &Vec<Q>| (1..d).map(|j| &row[j] - &row[0]).collect::<Vec<Q>>();
            let rows: Vec<Vec<Q>> = control.iter().map(difference).collect();
            let apart = Matrix::from_rows(d - 1, &rows).rank()? == d - 1;
            node.need(apart, "case", "the control points hide a direction")?;
        }
        family(name, parameter, range, operators, reversed)
    })
}

fn family(
    name: String,
    parameter: String,
    range: [Q; 2],
    operators: Vec<Rows>,
    reversed: Vec<bool>,
) -> Checked<Family> {
    let d = operators[0].len();
    let less = |m: &Rows| -> Rows { (1..d).map(|i| (1..d).map(|j| minus(&m[i][j], &m[i][0])).collect()).collect() };
    let linear: Vec<Rows> = operators.iter().map(less).collect();
    let germs = [germ(&reversed, true)?, germ(&reversed, false)?];
    let point = |germ: &Germ| -> Checked<Vec<Poly>> {
        let cycle = germ.cycle.iter().try_fold(identity(d), |m, l| product(&m, &operators[*l]))?;
        let adjoint = adjugate(&characteristic(&cycle)?.1, &[Q::one()])?;
        let fixed = (0..d).map(|j| column(&adjoint, j)).find(|v| !sum(v).is_empty());
        let fixed = some(fixed, "case", "an end is not one point for any value")?;
        let common = fixed
            .iter()
            .filter(|f| !f.is_empty())
            .try_fold(Vec::new(), |g: Poly, f| if g.is_empty() { Ok(f.clone()) } else { common_divisor(&g, f) })?;
        let fixed = fixed.iter().map(|f| divided(f, &common)).collect::<Checked<Vec<_>>>()?;
        germ.prefix.iter().rev().try_fold(fixed, |v, l| apply(&operators[*l], &v))
    };
    let points = [point(&germs[0])?, point(&germs[1])?];
    let sums = [sum(&points[0]), sum(&points[1])];
    for l in 1..operators.len() {
        let end = |letter: usize, start: bool| {
            let own = start != reversed[letter];
            apply(&operators[letter], &points[usize::from(!own)])
        };
        let (a, b) = (end(l - 1, false)?, end(l, true)?);
        let (s, t) = (sum(&a), sum(&b));
        for (x, y) in a.iter().zip(&b) {
            need(times(x, &t)? == times(y, &s)?, "case", "neighbouring pieces do not meet for every value")?;
        }
    }
    let both = times(&sums[0], &sums[1])?;
    let difference = |i: usize| -> Checked<Poly> {
        let (a, b) = (times(&points[1][i], &sums[0])?, times(&points[0][i], &sums[1])?);
        times(&minus(&a, &b), &both)
    };
    let chord = (1..d).map(difference).collect::<Checked<_>>()?;
    Ok(Family { name, parameter, range, reversed, linear, chord, sums, germs })
}

/// What is claimed, as it is named.
const CLAIMS: [&str; 3] = ["ends", "joints", "g1"];

/// Checks the proof of a certificate about a curve.
pub fn check(source: &str, node: &Node<'_>) -> Checked<Accepted> {
    let family = read(source)?;
    let [hulls, contraction, facts, claims] = node.fields("hulls contraction facts claims")?;
    let hulls: Vec<Hull> = hulls.each(|h| hull::check(&family.linear, h))?;
    let mut table = Table { family: &family, hulls, words: Vec::new(), facts: facts.list()? };
    let (mut found, mut verdicts) = (Vec::new(), Vec::new());
    let mut add = |claim: usize, parts: Vec<Part>| {
        for (from, to, verdict) in parts {
            verdicts.push(verdict);
            let (parameter, what) = (family.parameter.clone(), CurveRegion::ALL[claim]);
            found.push(Claim::CurveRegion { what, parameter, from: from.real(), to: to.real() }.is(verdict));
        }
    };
    add(0, table.parts(&contraction, None)?);
    let list = claims.exactly(CLAIMS.len(), "claims")?;
    for (k, item) in list.iter().enumerate() {
        let [claim, parts] = item.fields("claim parts")?;
        claim.need(claim.text()? == CLAIMS[k], "claims", "the claims are ends, joints and g1")?;
        add(k + 1, table.parts(&parts, Some(CLAIMS[k]))?);
    }
    let verdict = together(verdicts);
    Ok(Accepted { case: family.name.clone(), verdict, claims: found, points: Vec::new() })
}

type Part = (End, End, Verdict);

/// The parts of the range, and what they rest on.
struct Table<'a> {
    family: &'a Family,
    hulls: Vec<Hull>,
    words: Vec<Word<'a>>,
    facts: Vec<Node<'a>>,
}

impl<'a> Table<'a> {
    /// The parts: they begin and end with the range and leave nothing out.
    fn parts(&mut self, parts: &Node<'_>, claim: Option<&str>) -> Checked<Vec<Part>> {
        let (mut found, items): (Vec<Part>, _) = (Vec::new(), parts.list()?);
        parts.need(items.len() % 2 == 1, "parts", "points and intervals take turns, a point at both ends")?;
        for (number, item) in items.iter().enumerate() {
            let [from, to, verdict, rule, by] = item.fields("from to verdict rule by")?;
            let (low, high) = (from.at(End::read(&from))?, to.at(End::read(&to))?);
            let follows = match found.last() {
                None => low.is(&End::rational(&self.family.range[0])),
                Some((_, end, _)) => low.is(end),
            };
            from.need(follows, "parts", "a part begins where the one before ends, the first with the range")?;
            let point = number % 2 == 0;
            let shaped = if point { low.is(&high) } else { low.hi < high.lo };
            to.need(shaped, "parts", "points and intervals take turns, and intervals are not empty")?;
            let own = match (rule.text()?, claim) {
                ("none", _) => Verdict::Undetermined,
                ("word", None) => {
                    let at = by.at(word(&self.family.linear, &mut self.words, &by.word()?))?;
                    let large = item.at(state(&self.words[at], &low, &high, point))? == Some(false);
                    item.need(large, "word", "the spectral radius is not seen to be at least 1")?;
                    Verdict::Refuted
                }
                ("hull", None) => {
                    let named = by.exactly(1, "hull")?;
                    item.at(self.contracts(&named[0], &low, &high, point))?;
                    Verdict::Proved
                }
                ("fact", Some(claim)) => {
                    let named = by.exactly(2, "fact")?;
                    item.at(self.contracts(&named[1], &low, &high, point))?;
                    let fact = &self.facts[named[0].index(self.facts.len())?];
                    let here = Here { from: &low, to: &high, point };
                    item.at(self.argument(fact, claim, here))?
                }
                _ => return rule.reject("parts", "a rule that does not exist"),
            };
            verdict.follows("parts", own.word())?;
            found.push((low, high, own));
        }
        let whole = found.last().is_some_and(|(_, end, _)| end.is(&End::rational(&self.family.range[1])));
        parts.need(whole, "parts", "the last part ends with the range")?;
        Ok(found)
    }

    /// The hull with this number proves contraction on the part.
    fn contracts(&mut self, number: &Node<'_>, low: &End, high: &End, point: bool) -> Checked<()> {
        let hull = &self.hulls[number.index(self.hulls.len())?];
        number.need(hull.covers(low, high), "hull", "the hull was not checked on all of the part")?;
        for own in &hull.words {
            let at = self::word(&self.family.linear, &mut self.words, own)?;
            let small = state(&self.words[at], low, high, point)? == Some(true);
            number.need(small, "hull", "the spectral radius of a word is not seen to be below 1")?;
        }
        Ok(())
    }

    fn argument(&self, fact: &Node<'_>, claim: &str, here: Here<'_>) -> Checked<Verdict> {
        let [own, why, span] = [fact.field("claim")?, fact.field("why")?, fact.field("span")?];
        own.need(own.text()? == claim, "fact", "a fact about another claim")?;
        let argument = Argument::new(self.family, here, &span)?;
        Ok(if argument.holds(claim, why.text()?, fact)? { Verdict::Proved } else { Verdict::Refuted })
    }
}
