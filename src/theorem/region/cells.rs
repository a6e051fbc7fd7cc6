//! Ring conditions at the ends by cells, with a box that holds the curve.

use super::argue::{Arguments, EndGerm, Joint};
use super::curve::{Germ, apply};
use super::fact::{CurveClaim, CurveEnd, Fact, Why};
use super::signs::{Signs, determinant, dot};
use super::symbol::Symbol;
use crate::answer::Verdict;
use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;

/// Most words of one length by which a box is mapped into itself.
const MAX_CODE: usize = 64;
/// Most cells of a ring, and most letters of their words.
const MAX_CELLS: usize = 64;
const MAX_LENGTH: usize = 12;
/// Steps until the smallest box is found.
const STEPS: usize = 4000;
/// What the images of a box leave free of it below and above, as parts of its sides: the more, the more values it serves, and the less,
/// the nearer it comes to the curve.
const SLACK: [[f64; 2]; 5] = [[0.06, 0.06], [0.003, 0.06], [0.06, 0.003], [0.003, 0.003], [0.0002, 0.0002]];
/// What a bound must be, as a part of the values of the functional.
const MARGIN: f64 = 0.02;

/// A word as a map of differences from the start: a shift and a linear part.
#[derive(Clone)]
struct Map<P> {
    word: Vec<usize>,
    shift: Vec<P>,
    linear: Matrix<P>,
}

/// The smallest and the largest coordinates, differences from the start.
#[derive(Clone)]
struct Bounds<T> {
    low: Vec<T>,
    high: Vec<T>,
}

/// A cell, the functional that has one sign on it, and the sign.
struct Signed<P> {
    cell: Map<P>,
    functional: usize,
    sign: i32,
}

impl<P: Symbol> Arguments<'_, P> {
    /// What the signs of the leading coefficients on cells of the rings say: a tangent line at both ends, or none at one of them.
    pub(super) fn by_cells(
        &self,
        at: &impl Signs<P>,
        chord: &[P],
        germs: &[EndGerm<P>; 2],
        joints: &[Joint<P>],
    ) -> Vec<Fact<P>> {
        let letters = self.letters(chord);
        let try_box = |slack| {
            let own = at.clone();
            let bounds = self.bounds(&own, &letters, slack)?;
            let found = self.in_box(&own, (&letters, &bounds), chord, germs, joints);
            (!found.is_empty()).then_some(found)
        };
        SLACK.into_iter().find_map(try_box).unwrap_or_else(Vec::new)
    }

    /// The same with a box.
    fn in_box(
        &self,
        at: &impl Signs<P>,
        (letters, bounds): (&[Map<P>], &Bounds<Rational>),
        chord: &[P],
        germs: &[EndGerm<P>; 2],
        joints: &[Joint<P>],
    ) -> Vec<Fact<P>> {
        let sides = [CurveEnd::Start, CurveEnd::Finish];
        let rings = self.family.germs.each_ref().map(|germ| Ring::new(germ, chord, letters, bounds));
        let mut facts = Vec::new();
        for (((germ, ring), own), end) in self.family.germs.iter().zip(&rings).zip(germs).zip(sides) {
            let apart = at.clone();
            if self.changes_sign(&apart, ring, germ, own) {
                let refuted = |claim| Fact::of(&apart, claim, Verdict::Refuted, Why::SignChange(end));
                facts.extend([CurveClaim::Ends, CurveClaim::G1].into_iter().filter_map(refuted));
                if self.is_at_a_joint(&apart, end) {
                    facts.extend(refuted(CurveClaim::Joints));
                }
                return marked(facts);
            }
        }
        let cover = at.clone();
        if !rings.iter().zip(germs).all(|(ring, own)| keeps_sign(&cover, ring, own)) {
            return Vec::new();
        }
        let longer = germs.iter().any(|g| matches!(g, EndGerm::Line { longer: true, .. }));
        facts.extend(Fact::of(&cover, CurveClaim::Ends, Verdict::Proved, Why::Cells { longer }));
        let agree = |j: &Joint<P>| matches!((&j.left, &j.right), (Some((a, _)), Some((b, _))) if cover.parallel(a, b));
        if joints.iter().all(agree) && self.family.linear.iter().all(|m| cover.sign(&determinant(m)) != 0) {
            facts.extend(Fact::of(&cover, CurveClaim::Joints, Verdict::Proved, Why::Cells { longer }));
        }
        marked(facts)
    }

    /// The pieces as maps of differences from the start. A piece run backwards takes the start to where it ends.
    fn letters(&self, chord: &[P]) -> Vec<Map<P>> {
        let family = self.family;
        let mut from = vec![P::nought(); chord.len()];
        let mut maps = Vec::new();
        for (l, m) in family.linear.iter().enumerate() {
            let step = apply(m, chord);
            let step = super::signs::scaled(&step, family.sign(&[l]));
            let to: Vec<P> = from.iter().zip(&step).map(|(a, b)| a.plus(b)).collect();
            let shift = if family.reversed[l] { to.clone() } else { from };
            maps.push(Map { word: vec![l], shift, linear: m.clone() });
            from = to;
        }
        maps
    }

    /// A box into which all words of one length map it. So it holds the curve, which contracts.
    fn bounds(&self, at: &impl Signs<P>, letters: &[Map<P>], slack: [f64; 2]) -> Option<Bounds<Rational>> {
        let mut code = letters.to_vec();
        while code.len() <= MAX_CODE {
            if let Some(bounds) = proposed(at, &code, slack)
                && code.iter().all(|map| into_itself(at, map, &bounds))
            {
                return Some(bounds);
            }
            code = code.iter().flat_map(|w| letters.iter().map(|l| then(w, l))).collect();
        }
        None
    }

    /// Whether the leading coefficient changes its sign on the ring of an end that is isolated (Theorem 4′): the cycle and what
    /// leads from it to the end are injective, and the ring does not meet the end.
    fn changes_sign(&self, at: &impl Signs<P>, ring: &Ring<'_, P>, germ: &Germ, own: &EndGerm<P>) -> bool {
        let EndGerm::Line { row, .. } = own else { return false };
        let value = |cell: &Map<P>| dot(row, &difference(&cell.shift, &ring.base));
        let Some((up, down)) = opposite(at, &ring.cells, ring.letters, value) else { return false };
        let injective = [&germ.cycle, &germ.prefix].map(|w| determinant(&self.family.product(w)));
        if injective.iter().any(|d| at.sign(d) == 0) || at.sign(&value(&up)) <= 0 || at.sign(&value(&down)) >= 0 {
            return false;
        }
        let n = ring.base.len();
        let unit = |k: usize| -> Vec<P> { (0..n).map(|i| P::number(Rational::from(u64::from(i == k)))).collect() };
        let functionals: Vec<Vec<P>> = std::iter::once(row.clone()).chain((0..n).map(unit)).collect();
        ring.is_covered(at, &functionals)
    }

    /// Whether an end is carried to a side of a joint by a piece that is injective.
    fn is_at_a_joint(&self, at: &impl Signs<P>, end: CurveEnd) -> bool {
        let family = self.family;
        let last = family.linear.len() - 1;
        let finish = end == CurveEnd::Finish;
        // The end of a piece is the end of the curve unless it runs backwards; the last piece has no joint behind it.
        (0..=last).any(|l| {
            let behind = finish != family.reversed[l];
            (if behind { l < last } else { l > 0 }) && at.sign(&determinant(&family.linear[l])) != 0
        })
    }
}

/// The ring of an end, with the box that holds the curve.
struct Ring<'a, P> {
    cells: Vec<Map<P>>,
    letters: &'a [Map<P>],
    bounds: &'a Bounds<Rational>,
    /// The end as a difference from the start.
    base: Vec<P>,
}

impl<'a, P: Symbol> Ring<'a, P> {
    fn new(germ: &Germ, chord: &[P], letters: &'a [Map<P>], bounds: &'a Bounds<Rational>) -> Self {
        let base = if germ.at_start { vec![P::nought(); chord.len()] } else { chord.to_vec() };
        Self { cells: ring(letters, germ), letters, bounds, base }
    }

    /// Whether cells cover the ring, on each of which one of the functionals has one sign; of a single functional it is positive.
    fn is_covered(&self, at: &impl Signs<P>, functionals: &[Vec<P>]) -> bool {
        let cells = cover(at, self, functionals);
        cells.is_some_and(|cells| {
            cells.iter().all(|c| is_strict(at, c, self.bounds, &functionals[c.functional], &self.base))
        })
    }
}

/// Whether the leading coefficient is positive on the whole ring of an end.
fn keeps_sign<P: Symbol>(at: &impl Signs<P>, ring: &Ring<'_, P>, own: &EndGerm<P>) -> bool {
    let EndGerm::Line { row, .. } = own else { return false };
    ring.is_covered(at, std::slice::from_ref(row))
}

/// Facts for which certificates of regions have no form.
fn marked<P>(facts: Vec<Fact<P>>) -> Vec<Fact<P>> {
    facts
        .into_iter()
        .map(|mut fact| {
            fact.evidence.beyond = true;
            fact
        })
        .collect()
}

fn difference<P: Symbol>(a: &[P], b: &[P]) -> Vec<P> {
    a.iter().zip(b).map(|(x, y)| x.minus(y)).collect()
}

/// First one word, then in its cell another.
fn then<P: Symbol>(first: &Map<P>, second: &Map<P>) -> Map<P> {
    let moved = apply(&first.linear, &second.shift);
    Map {
        word: [first.word.as_slice(), &second.word].concat(),
        shift: first.shift.iter().zip(&moved).map(|(a, b)| a.plus(b)).collect(),
        linear: first.linear.mul_over(&P::ring(), &second.linear),
    }
}

/// The cells that leave the cycle in its first turn.
fn ring<P: Symbol>(letters: &[Map<P>], germ: &Germ) -> Vec<Map<P>> {
    let mut cells = Vec::new();
    let mut before: Option<Map<P>> = None;
    for &own in &germ.cycle {
        let step = |l: usize| before.as_ref().map_or_else(|| letters[l].clone(), |b| then(b, &letters[l]));
        cells.extend((0..letters.len()).filter(|l| *l != own).map(step));
        before = Some(step(own));
    }
    cells
}

/// Whether a map takes a box strictly into itself: signs of entries, then of the four-sided bounds.
fn into_itself<P: Symbol>(at: &impl Signs<P>, map: &Map<P>, bounds: &Bounds<Rational>) -> bool {
    (0..map.shift.len()).all(|i| {
        let range = range_of(at, map.linear.row(i), bounds);
        let top = P::number(bounds.high[i].clone()).minus(&map.shift[i].plus(&range.1));
        let bottom = map.shift[i].plus(&range.0).minus(&P::number(bounds.low[i].clone()));
        at.sign(&top) > 0 && at.sign(&bottom) > 0
    })
}

/// The smallest and the largest value of a row on a box, for the signs that its entries have.
fn range_of<P: Symbol>(at: &impl Signs<P>, row: &[P], bounds: &Bounds<Rational>) -> (P, P) {
    let (mut least, mut most) = (P::nought(), P::nought());
    for (k, x) in row.iter().enumerate().filter(|(_, x)| !x.vanishes()) {
        let (a, b) = match at.sign(x) {
            s if s >= 0 => (&bounds.low[k], &bounds.high[k]),
            _ => (&bounds.high[k], &bounds.low[k]),
        };
        least = least.plus(&x.multiple(a));
        most = most.plus(&x.multiple(b));
    }
    (least, most)
}

/// Whether a functional has the sign that was proposed on a cell.
fn is_strict<P: Symbol>(
    at: &impl Signs<P>,
    own: &Signed<P>,
    bounds: &Bounds<Rational>,
    functional: &[P],
    base: &[P],
) -> bool {
    let row: Vec<P> = (0..functional.len()).map(|k| dot(functional, &own.cell.linear.column(k))).collect();
    let (least, most) = range_of(at, &row, bounds);
    let value = dot(functional, &difference(&own.cell.shift, base));
    match own.sign {
        1 => at.sign(&value.plus(&least)) > 0,
        _ => at.sign(&value.plus(&most)) < 0,
    }
}

fn near<P: Symbol>(at: &impl Signs<P>, v: &[P]) -> Vec<f64> {
    v.iter().map(|x| to_f64(&at.near(x))).collect()
}

/// A box that floats propose: the smallest one that the words map into itself coordinate by coordinate, and wider by parts of its
/// sides below and above.
#[allow(clippy::float_arithmetic, reason = "a proposal; signs of polynomials decide")]
fn proposed<P: Symbol>(at: &impl Signs<P>, code: &[Map<P>], slack: [f64; 2]) -> Option<Bounds<Rational>> {
    let n = code.first()?.shift.len();
    let maps: Vec<(Vec<f64>, Vec<Vec<f64>>)> =
        code.iter().map(|m| (near(at, &m.shift), (0..n).map(|i| near(at, m.linear.row(i))).collect())).collect();
    let start = Bounds { low: vec![0.0; n], high: vec![0.0; n] };
    let least = closed(&maps, start, &vec![[0.0; 2]; n])?;
    let size = largest_side(&least);
    if size <= 0.0 {
        return None;
    }
    let add: Vec<[f64; 2]> =
        (0..n).map(|i| slack.map(|s| s * (least.high[i] - least.low[i]).max(size / 64.0))).collect();
    let own = closed(&maps, least, &add)?;
    // Half of what was added is left for rounding.
    let finest = add.iter().flatten().fold(size, |a, b| a.min(*b));
    let grid = f64::exp2(4.0 - finest.log2().floor());
    let rational = |x: f64| Some(Rational::try_from((x * grid).round()).ok()? / Rational::try_from(grid).ok()?);
    let low = (0..n).map(|i| rational(own.low[i])).collect::<Option<_>>()?;
    let high = (0..n).map(|i| rational(own.high[i])).collect::<Option<_>>()?;
    Some(Bounds { low, high })
}

/// The smallest box that holds one with the start, and its images with so much beside them; `None` where it is not found.
#[allow(clippy::float_arithmetic, reason = "a proposal")]
fn closed(maps: &[(Vec<f64>, Vec<Vec<f64>>)], mut own: Bounds<f64>, add: &[[f64; 2]]) -> Option<Bounds<f64>> {
    for _ in 0..STEPS {
        let before = own.clone();
        let mut change = 0.0_f64;
        for (i, [below, above]) in add.iter().enumerate() {
            let ranges = maps.iter().map(|(shift, linear)| {
                let (least, most) = float_range(&linear[i], &before);
                (shift[i] + least, shift[i] + most)
            });
            let (least, most) = ranges.fold((0.0_f64, 0.0_f64), |(a, b), (l, m)| (a.min(l), b.max(m)));
            own.low[i] = before.low[i].min(least - below);
            own.high[i] = before.high[i].max(most + above);
            change = change.max(before.low[i] - own.low[i]).max(own.high[i] - before.high[i]);
        }
        let size = largest_side(&own);
        if !size.is_finite() || size > 1e9 {
            return None;
        }
        if change <= 1e-9 * size {
            return Some(own);
        }
    }
    None
}

#[allow(clippy::float_arithmetic, reason = "a proposal")]
fn largest_side(own: &Bounds<f64>) -> f64 {
    own.low.iter().zip(&own.high).map(|(a, b)| b - a).fold(0.0, f64::max)
}

#[allow(clippy::float_arithmetic, reason = "a proposal")]
fn float_range(row: &[f64], bounds: &Bounds<f64>) -> (f64, f64) {
    let (mut least, mut most) = (0.0, 0.0);
    for (k, x) in row.iter().enumerate() {
        let (a, b) = (x * bounds.low[k], x * bounds.high[k]);
        least += a.min(b);
        most += a.max(b);
    }
    (least, most)
}

/// Cells that cover a ring, each with a functional that seems to have one sign there.
#[allow(clippy::float_arithmetic, reason = "a proposal; signs of polynomials decide")]
fn cover<P: Symbol>(at: &impl Signs<P>, ring: &Ring<'_, P>, functionals: &[Vec<P>]) -> Option<Vec<Signed<P>>> {
    let [low, high] = [&ring.bounds.low, &ring.bounds.high].map(|v| v.iter().map(to_f64).collect());
    let box_near = Bounds { low, high };
    let rows: Vec<Vec<f64>> = functionals.iter().map(|f| near(at, f)).collect();
    let end = near(at, &ring.base);
    let mut queue = ring.cells.clone();
    let mut out = Vec::new();
    while let Some(cell) = queue.pop() {
        let shift = near(at, &cell.shift);
        let linear: Vec<Vec<f64>> = (0..shift.len()).map(|i| near(at, cell.linear.row(i))).collect();
        let signed = rows.iter().enumerate().find_map(|(k, f)| {
            let value: f64 = f.iter().zip(shift.iter().zip(&end)).map(|(f, (a, b))| f * (a - b)).sum();
            let row: Vec<f64> = (0..shift.len()).map(|j| f.iter().zip(&linear).map(|(f, r)| f * r[j]).sum()).collect();
            let (least, most) = float_range(&row, &box_near);
            let size = value.abs().max(most - least);
            match (value + least > MARGIN * size, value + most < -MARGIN * size) {
                (true, _) => Some((k, 1)),
                (_, true) => Some((k, -1)),
                _ => None,
            }
        });
        match signed {
            Some((_, -1)) if rows.len() == 1 => return None,
            Some((functional, sign)) => out.push(Signed { cell, functional, sign }),
            None if cell.word.len() >= MAX_LENGTH => return None,
            None => queue.extend(ring.letters.iter().map(|l| then(&cell, l))),
        }
        if out.len() + queue.len() > MAX_CELLS {
            return None;
        }
    }
    Some(out)
}

/// Two cells of a ring at whose beginnings a functional has opposite signs.
#[allow(clippy::float_arithmetic, reason = "a proposal; signs of polynomials decide")]
fn opposite<P: Symbol>(
    at: &impl Signs<P>,
    ring: &[Map<P>],
    letters: &[Map<P>],
    value: impl Fn(&Map<P>) -> P,
) -> Option<(Map<P>, Map<P>)> {
    let mut cells = ring.to_vec();
    loop {
        let values: Vec<f64> = cells.iter().map(|c| to_f64(&at.near(&value(c)))).collect();
        let size = values.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
        let most = (0..cells.len()).max_by(|a, b| values[*a].total_cmp(&values[*b]))?;
        let least = (0..cells.len()).min_by(|a, b| values[*a].total_cmp(&values[*b]))?;
        if values[most] > MARGIN * size && values[least] < -MARGIN * size {
            return Some((cells[most].clone(), cells[least].clone()));
        }
        if cells.len() * letters.len() > MAX_CELLS {
            return None;
        }
        cells = cells.iter().flat_map(|c| letters.iter().map(|l| then(c, l))).collect();
    }
}
