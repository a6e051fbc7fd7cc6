//! Regions of a mask with a parameter: open intervals and single points at which the scheme converges and has limits of an order
//! of smoothness, or not (docs/certificate.md, section 9.2).

mod argument;
mod curve;
mod hull;
mod model;
pub mod polynomial;
mod symbolic;

use crate::base::{Accepted, Checked, Matrix, Node, Q, Verdict, file, index, need, together, whole};
use crate::claim::{Claim, Real};
use hull::Hull;
use num_traits::{One, Zero};
use polynomial::{End, Poly, common_divisor, is_free, is_stable, minus, places, through, trimmed, value};

/// Most coefficients of a mask, and most letters of a word.
const MAX_LENGTH: usize = 64;
const MAX_ARITY: usize = 16;

/// A mask by powers of its parameter.
struct Family {
    name: String,
    parameter: String,
    range: [Q; 2],
    arity: usize,
    mask: Vec<Poly>,
    /// The sum rules that hold for every value, the factor, and what is left of a further division.
    sum_rules: usize,
    factor: Vec<Poly>,
    further: Vec<Poly>,
}

fn read(source: &str) -> Checked<Family> {
    file(source, "name parameter range arity mask", |node| {
        let name = node.field("name")?.text()?.to_owned();
        let parameter = node.field("parameter")?.text()?.to_owned();
        let ends = node.field("range")?.vector(2)?;
        let range = [ends[0].clone(), ends[1].clone()];
        let arity = index(&node.field("arity")?, MAX_ARITY + 1)?;
        let coefficient = |item: &Node<'_>| Ok(trimmed(item.each(Node::rational)?));
        let mask = node.field("mask")?.each(coefficient)?;
        let sound = arity >= 2 && range[0] < range[1] && !mask.is_empty() && mask.len() <= MAX_LENGTH;
        node.need(sound, "case", "an arity from 2, a range, and up to 64 coefficients are needed")?;
        let full = mask.first().is_some_and(|f| !f.is_empty()) && mask.last().is_some_and(|f| !f.is_empty());
        node.need(full, "case", "the first and the last coefficient are not 0")?;
        let (mut sum_rules, mut factor) = (0, mask.clone());
        let further = loop {
            let (quotient, rest) = divided(&factor, arity);
            if quotient.is_empty() || rest.iter().any(|f| !f.is_empty()) {
                break rest;
            }
            (sum_rules, factor) = (sum_rules + 1, quotient);
        };
        let one = vec![Q::one()];
        let sum = |coset: usize| mask.iter().skip(coset).step_by(arity).fold(Vec::new(), |s: Poly, f| plus(&s, f));
        let rules = (0..arity).all(|coset| sum(coset) == one) && sum_rules > 0;
        node.need(rules, "case", "the coefficients of every residue class add up to 1 for every value")?;
        Ok(Family { name, parameter, range, arity, mask, sum_rules, factor, further })
    })
}

fn plus(a: &[Q], b: &[Q]) -> Poly {
    minus(a, &minus(&[], b))
}

/// Quotient and rest by `1 + z + … + z^{N−1}`.
fn divided(a: &[Poly], arity: usize) -> (Vec<Poly>, Vec<Poly>) {
    if a.len() < arity {
        return (Vec::new(), a.to_vec());
    }
    let (mut rest, mut quotient) = (a.to_vec(), Vec::new());
    for k in 0..=a.len() - arity {
        let c = rest[k].clone();
        rest[k..k + arity].iter_mut().for_each(|entry| *entry = minus(entry, &c));
        quotient.push(c);
    }
    (quotient, rest)
}

/// `T_e[i][j] = b_{N i − j + e}`, times a factor.
fn digits(mask: &[Poly], arity: usize, factor: &Q) -> Vec<Vec<Vec<Poly>>> {
    let size = (mask.len() - 1).div_ceil(arity - 1).max(1);
    let entry = |e: usize, i: usize, j: usize| match (arity * i + e).checked_sub(j).and_then(|k| mask.get(k)) {
        Some(f) => trimmed(f.iter().map(|c| c * factor).collect()),
        None => Vec::new(),
    };
    (0..arity).map(|e| (0..size).map(|i| (0..size).map(|j| entry(e, i, j)).collect()).collect()).collect()
}

fn degree(letters: &[Vec<Vec<Poly>>]) -> usize {
    letters.iter().flatten().flatten().map(|f| f.len().saturating_sub(1)).fold(0, usize::max)
}

fn member(letters: &[Vec<Vec<Poly>>], p: &Q) -> Vec<Matrix> {
    let matrix = |m: &Vec<Vec<Poly>>| {
        let rows: Vec<Vec<Q>> = m.iter().map(|row| row.iter().map(|f| value(f, p)).collect()).collect();
        Matrix::from_rows(m.len(), &rows)
    };
    letters.iter().map(matrix).collect()
}

/// A word of matrices, divided by the threshold.
struct Word<'a> {
    letters: &'a [Vec<Vec<Poly>>],
    word: Vec<usize>,
    /// `χ(1)`, `χ(−1)`, `det(1 − Λ²)`.
    critical: [Poly; 3],
}

impl<'a> Word<'a> {
    fn new(letters: &'a [Vec<Vec<Poly>>], word: &[usize]) -> Checked<Self> {
        let known = !word.is_empty() && word.iter().all(|l| *l < letters.len());
        need(known, "word", "a word has letters that exist")?;
        let mut found = Self { letters, word: word.to_vec(), critical: [Vec::new(), Vec::new(), Vec::new()] };
        let (n, entry) = (letters[0].len(), degree(letters) * word.len());
        let at = places((n * entry).max(n * (n - 1) * entry) + 1);
        let mut values: [Vec<Q>; 3] = [Vec::new(), Vec::new(), Vec::new()];
        for p in &at {
            let m = found.product(p)?;
            let chi = m.characteristic()?;
            let sum = |sign: i64| {
                (0..chi.cols).fold(Q::zero(), |s, k| s + chi.at(0, k) * whole(if k % 2 == 1 { sign } else { 1 }))
            };
            values[0].push(sum(1));
            values[1].push(sum(-1));
            let exterior = exterior(&m).characteristic()?;
            values[2].push((0..exterior.cols).fold(Q::zero(), |s, k| s + exterior.at(0, k)));
        }
        for (f, v) in found.critical.iter_mut().zip(values) {
            *f = through(&at, v)?;
        }
        Ok(found)
    }

    fn product(&self, p: &Q) -> Checked<Matrix> {
        let letters = member(self.letters, p);
        self.word.iter().try_fold(Matrix::identity(self.letters[0].len()), |m, l| m.times(&letters[*l]))
    }

    /// Whether two eigenvalues, or one with itself, have the product 1 for every value.
    fn is_always_large(&self) -> bool {
        self.critical.iter().any(Vec::is_empty)
    }

    /// Whether the spectral radius is below 1 (`Some(true)`) or at least 1 strictly between two ends; `None` where a critical value
    /// lies between them.
    fn between(&self, from: &End, to: &End) -> Checked<Option<bool>> {
        if self.is_always_large() {
            return Ok(Some(false));
        }
        for f in &self.critical {
            if !is_free(f, from, to)? {
                return Ok(None);
            }
        }
        let middle = (&from.hi + &to.lo) / whole(2);
        is_stable(&self.product(&middle)?).map(Some)
    }

    /// The same at one value.
    fn at(&self, end: &End) -> Checked<Option<bool>> {
        if self.is_always_large() {
            return Ok(Some(false));
        }
        for f in &self.critical {
            if end.is_root_of(f)? {
                return Ok(Some(false));
            }
        }
        for f in &self.critical {
            if !end.is_far_from(f)? {
                return Ok(None);
            }
        }
        is_stable(&self.product(&end.lo)?).map(Some)
    }
}

/// The second exterior power; of a matrix of size 1 the one of size 1 that is 0.
fn exterior(m: &Matrix) -> Matrix {
    let n = m.rows;
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    if pairs.is_empty() {
        return Matrix::zeros(1, 1);
    }
    let entry = |(i, j): (usize, usize), (k, l): (usize, usize)| m.at(i, k) * m.at(j, l) - m.at(i, l) * m.at(j, k);
    let rows: Vec<Vec<Q>> = pairs.iter().map(|r| pairs.iter().map(|c| entry(*r, *c)).collect()).collect();
    Matrix::from_rows(pairs.len(), &rows)
}

/// The common divisor of determinants of `x` and differences `T_u x − x`: where it does not vanish, translates are independent.
fn independence(family: &Family, node: &Node<'_>) -> Checked<Poly> {
    let letters = digits(&family.mask, family.arity, &Q::one());
    let (n, degree) = (letters[0].len(), degree(&letters));
    let mut guard: Poly = Vec::new();
    for item in node.list()? {
        let [column, words] = item.fields("column words")?;
        let (column, words) = (column.index(n)?, words.each(Node::word)?);
        let sound = words.len() + 1 == n && words.iter().flatten().all(|l| *l < letters.len());
        item.need(sound, "independent", "one word less than coordinates, of letters that exist")?;
        let at = places(degree * (n * (n - 1) + words.iter().map(Vec::len).sum::<usize>()) + 1);
        let mut values = Vec::new();
        for p in &at {
            let here = member(&letters, p);
            let x = adjugate_column(&here[0], column)?;
            let mut rows = x.transpose();
            for word in &words {
                let image = word.iter().rev().try_fold(x.clone(), |v, l| here[*l].times(&v))?;
                rows = rows.stack(&image.minus(&x).transpose());
            }
            let chi = rows.characteristic()?;
            values.push(chi.at(0, 0) * whole(if n % 2 == 0 { 1 } else { -1 }));
        }
        let own = through(&at, values)?;
        guard = if guard.is_empty() { own } else { common_divisor(&guard, &own)? };
    }
    Ok(guard)
}

/// A column of the adjugate of `1 − T`: `Σ y_k`, `y_{n−1} = e`, `y_{k−1} = T y_k + c_k e`.
fn adjugate_column(m: &Matrix, column: usize) -> Checked<Matrix> {
    let (n, chi) = (m.rows, m.characteristic()?);
    let e = Matrix::ones(n, 1, |i, _| i == column);
    let (mut y, mut sum) = (e.clone(), e.clone());
    for power in (1..n).rev() {
        y = m.times(&y)?.plus(&chi.at(0, power), &e);
        sum = sum.plus(&Q::one(), &y);
    }
    Ok(sum)
}

/// Checks the proof of a certificate of the kind `region`.
pub fn check(source: &str, node: &Node<'_>) -> Checked<Accepted> {
    if node.get("claims").is_some() {
        return curve::check(source, node);
    }
    let family = read(source)?;
    let [independent, orders] = node.fields("independent orders")?;
    let guard = independent.at(independence(&family, &independent))?;
    let (mut claims, mut verdicts) = (Vec::new(), Vec::new());
    let list = orders.list()?;
    orders.need(!list.is_empty(), "orders", "orders from 0 on are needed")?;
    for (k, item) in list.iter().enumerate() {
        let [order, hulls, parts] = item.fields("order hulls parts")?;
        let known = order.index(MAX_LENGTH)? == k && k <= family.sum_rules;
        order.need(known, "orders", "the orders come one after the other, up to the sum rules")?;
        let threshold = (0..k).fold(Q::one(), |t, _| t * whole(family.arity as i64));
        let letters = digits(&family.factor, family.arity, &threshold);
        let level = Level { family: &family, guard: &guard, order: k, letters: &letters };
        for (from, to, verdict) in level.parts(&hulls, &parts)? {
            verdicts.push(verdict);
            claims.push(Claim::Region { order: k, parameter: family.parameter.clone(), from, to }.is(verdict));
        }
    }
    let verdict = together(verdicts);
    Ok(Accepted { case: family.name, verdict, claims, points: Vec::new() })
}

/// One order of smoothness; the matrices are divided by its threshold.
struct Level<'a> {
    family: &'a Family,
    guard: &'a Poly,
    order: usize,
    letters: &'a [Vec<Vec<Poly>>],
}

impl Level<'_> {
    /// The parts: they begin and end with the range and leave nothing out.
    fn parts(&self, hulls: &Node<'_>, parts: &Node<'_>) -> Checked<Vec<(Real, Real, Verdict)>> {
        let hulls: Vec<Hull> = hulls.each(|h| hull::check(self.letters, h))?;
        let mut words: Vec<Word<'_>> = Vec::new();
        let (mut found, mut last): (Vec<(Real, Real, Verdict)>, Option<End>) = (Vec::new(), None);
        let items = parts.list()?;
        parts.need(items.len() % 2 == 1, "parts", "points and intervals take turns, a point at both ends")?;
        for (number, item) in items.iter().enumerate() {
            let [from, to, verdict, rule, by] = item.fields("from to verdict rule by")?;
            let (low, high) = (from.at(End::read(&from))?, to.at(End::read(&to))?);
            let follows = match &last {
                None => low.is(&End::rational(&self.family.range[0])),
                Some(end) => low.is(end),
            };
            from.need(follows, "parts", "a part begins where the one before ends, the first with the range")?;
            let point = number % 2 == 0;
            let shaped = if point { low.is(&high) } else { low.hi < high.lo };
            to.need(shaped, "parts", "points and intervals take turns, and intervals are not empty")?;
            let proved = match rule.text()? {
                "none" => Verdict::Undetermined,
                "sum-rules" => {
                    rule.need(self.order == self.family.sum_rules, "sum-rules", "not this order")?;
                    by.need(by.list()?.is_empty(), "sum-rules", "nothing is named")?;
                    item.at(self.no_more_sum_rules(&low, &high, point))?;
                    Verdict::Refuted
                }
                "word" => {
                    let at = by.at(word(self.letters, &mut words, &by.word()?))?;
                    let large = item.at(state(&words[at], &low, &high, point))? == Some(false);
                    item.need(large, "word", "the spectral radius is not seen to be at least 1")?;
                    item.at(self.is_independent(&low, &high, point))?;
                    rule.need(self.order < self.family.sum_rules, "word", "not this order")?;
                    Verdict::Refuted
                }
                "hull" => {
                    rule.need(self.order < self.family.sum_rules, "hull", "not this order")?;
                    let named = by.exactly(1, "hull")?;
                    let hull = &hulls[named[0].index(hulls.len())?];
                    item.need(hull.covers(&low, &high), "hull", "the hull was not checked on all of the part")?;
                    for word in &hull.words {
                        let at = self::word(self.letters, &mut words, word)?;
                        let small = item.at(state(&words[at], &low, &high, point))? == Some(true);
                        item.need(small, "hull", "the spectral radius of a word is not seen to be below 1")?;
                    }
                    Verdict::Proved
                }
                _ => return rule.reject("parts", "a rule that does not exist"),
            };
            verdict.follows("parts", proved.word())?;
            found.push((low.real(), high.real(), proved));
            last = Some(high);
        }
        let whole = last.is_some_and(|end| end.is(&End::rational(&self.family.range[1])));
        parts.need(whole, "parts", "the last part ends with the range")?;
        Ok(found)
    }

    /// Convergence fails whether translates are independent or not; smoothness only where they are.
    fn is_independent(&self, from: &End, to: &End, point: bool) -> Checked<()> {
        if self.order == 0 {
            return Ok(());
        }
        need(!self.guard.is_empty(), "independent", "the translates may be dependent")?;
        need(free(self.guard, from, to, point)?, "independent", "the translates may be dependent on this part")
    }

    /// Some coefficient of the rest of a further division is not 0.
    fn no_more_sum_rules(&self, from: &End, to: &End, point: bool) -> Checked<()> {
        self.is_independent(from, to, point)?;
        let mut common: Poly = Vec::new();
        for f in self.family.further.iter().filter(|f| !f.is_empty()) {
            common = if common.is_empty() { f.clone() } else { common_divisor(&common, f)? };
        }
        need(!common.is_empty(), "sum-rules", "a further sum rule holds for every value")?;
        need(free(&common, from, to, point)?, "sum-rules", "a further sum rule may hold on this part")
    }
}

fn free(f: &Poly, from: &End, to: &End, point: bool) -> Checked<bool> {
    if point { from.is_far_from(f) } else { is_free(f, from, to) }
}

fn state(word: &Word<'_>, from: &End, to: &End, point: bool) -> Checked<Option<bool>> {
    if point { word.at(from) } else { word.between(from, to) }
}

/// The place of a word in the list, to which it is added.
fn word<'a>(letters: &'a [Vec<Vec<Poly>>], words: &mut Vec<Word<'a>>, word: &[usize]) -> Checked<usize> {
    if let Some(at) = words.iter().position(|w| w.word == word) {
        return Ok(at);
    }
    words.push(Word::new(letters, word)?);
    Ok(words.len() - 1)
}
