//! What holds of a curve at one value of its parameter, and on the interval around it on which nothing changes its sign.

use super::cones::Rays;
use super::curve::{CurveFamily, Germ, apply};
use super::fact::{CurveClaim, CurveEnd, Evidence, Fact, Why};
use super::signs::{Signs, adjugate, determinant, dot, horner, is_stable, scaled, without_root};
use super::symbol::Symbol;
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::linalg::Matrix;
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

/// A product along a word with its eigenvalues that are polynomials.
struct Word<P> {
    matrix: Matrix<P>,
    chi: Vec<P>,
    eigenvalues: Vec<P>,
}

/// The leading eigenvalue of a word, real, with one Jordan block and alone, with `ψ(λ) adj(λ − T)`, `ψ` the characteristic
/// polynomial without its factors `x − λ`: a positive multiple of the projection to its eigenvector, or, with a block of length 2, of
/// that to the block followed by `T − λ`.
pub(super) struct Leading<P> {
    pub value: P,
    pub positive: bool,
    /// Whether its block has the length 2.
    pub longer: bool,
    pub projection: Matrix<P>,
}

/// What is known of an end of the curve.
pub(super) enum EndGerm<P> {
    /// The line of the leading eigenvector: the ray on which the curve leaves the end, whether the eigenvalue is positive, and the
    /// leading coefficient where its cycle lives, positive on that side.
    Line {
        value: P,
        ray: Vec<P>,
        positive: bool,
        row: Vec<P>,
        forward: i32,
        /// Whether the eigenvalue has a block of length 2.
        longer: bool,
    },
    /// A plane.
    Plane,
    Unknown,
}

/// The two sides of a joint.
pub(super) struct Joint<P> {
    pub left: Option<(Vec<P>, bool)>,
    pub right: Option<(Vec<P>, bool)>,
}

/// The arguments about one family; products of words are kept.
pub(super) struct Arguments<'a, P> {
    pub family: &'a CurveFamily<P>,
    /// Whether rings are covered by cells, which takes longer.
    pub cells: bool,
    /// Searches for constant rays that are left.
    pub searches: Cell<usize>,
    /// Whether something was used that certificates of regions have no form for.
    beyond: Cell<bool>,
    words: RefCell<BTreeMap<Vec<usize>, Rc<Word<P>>>>,
}

impl<'a, P: Symbol> Arguments<'a, P> {
    pub fn new(family: &'a CurveFamily<P>, cells: bool) -> Self {
        Self { family, cells, searches: Cell::new(SEARCHES), beyond: Cell::new(false), words: RefCell::default() }
    }

    /// What is decided at a value. All of it rests on contraction.
    pub fn facts(&self, at: &impl Signs<P>) -> Vec<Fact<P>> {
        self.beyond.set(false);
        let other = at.clone();
        let Some((chord, span)) = self.premises(at) else { return self.on_a_line(&other) };
        let germs = [0, 1].map(|end| self.germ(at, &self.family.germs[end], &chord));
        let joints = self.joints(at, &germs);
        let mut facts = self.refuted(at, &germs, &joints);
        let known = |facts: &[Fact<P>], claim| facts.iter().any(|f: &Fact<P>| f.claim == claim);
        if !known(&facts, CurveClaim::G1) {
            facts.extend(self.jumps(at, &joints));
        }
        for rays in Rays::ALL {
            if CurveClaim::ALL.iter().all(|c| known(&facts, *c)) {
                break;
            }
            let own = at.clone();
            let Some(rays) = self.rays(&own, rays, &germs, &chord) else { continue };
            let found = self.in_cone(&own, &rays, &chord, &germs, &joints);
            facts.extend(found.into_iter().filter(|f| !known(&facts, f.claim)).collect::<Vec<_>>());
        }
        if self.cells && !known(&facts, CurveClaim::Ends) {
            let found = self.by_cells(&at.clone(), &chord, &germs, &joints);
            facts.extend(found.into_iter().filter(|f| !known(&facts, f.claim)).collect::<Vec<_>>());
        }
        let value = |germ: &EndGerm<P>| match germ {
            EndGerm::Line { value, .. } => Some(value.clone()),
            EndGerm::Plane | EndGerm::Unknown => None,
        };
        for fact in &mut facts {
            fact.evidence.span.clone_from(&span);
            fact.evidence.values = germs.each_ref().map(value);
            fact.evidence.beyond |= self.beyond.get();
        }
        facts
    }

    /// A curve on the line of its chord whose pieces all go forwards: a segment.
    fn on_a_line(&self, at: &impl Signs<P>) -> Vec<Fact<P>> {
        let family = self.family;
        if family.chord_guards.iter().any(|f| at.sign(f) == 0) {
            return Vec::new();
        }
        let Some(chord) = at.primitive(&family.chord) else { return Vec::new() };
        let forwards = |letter: usize| {
            let image = apply(&family.linear[letter], &chord);
            at.parallel(&image, &chord) && at.sign(&dot(&image, &chord)) * family.sign(&[letter]) > 0
        };
        if !(0..family.linear.len()).all(forwards) {
            return Vec::new();
        }
        let facts = CurveClaim::ALL.into_iter().filter_map(|c| Fact::of(at, c, Verdict::Proved, Why::Segment));
        facts.map(|f| Fact { evidence: Evidence { beyond: true, ..f.evidence }, ..f }).collect()
    }

    /// The chord, where the relevant space is the space of all differences and no piece is a point.
    fn premises(&self, at: &impl Signs<P>) -> Option<(Vec<P>, Vec<Vec<usize>>)> {
        let family = self.family;
        if family.chord_guards.iter().any(|f| at.sign(f) == 0) {
            return None;
        }
        let chord = at.primitive(&family.chord)?;
        if !family.linear.iter().all(|m| at.is_not_zero(m.entries())) {
            return None;
        }
        // Words are chosen at a rational value near by; the determinant decides.
        let n = family.dim();
        let mut queue: std::collections::VecDeque<Vec<usize>> = [Vec::new()].into();
        let (mut columns, mut words, mut rows) = (Vec::new(), Vec::new(), Matrix::zero(0, n));
        while columns.len() < n {
            let word = queue.pop_front().filter(|w| w.len() <= n + 1)?;
            let image = word.iter().rev().fold(chord.clone(), |v, &l| apply(&family.linear[l], &v));
            let value: Vec<Rational> = image.iter().map(|f| at.near(f)).collect();
            let joined = rows.stack(&Matrix::from_rows(n, vec![value]));
            if joined.rank() > rows.rows() {
                rows = joined;
                columns.push(image);
                words.push(word.clone());
            }
            queue.extend((0..family.linear.len()).map(|l| [&[l], word.as_slice()].concat()));
        }
        let whole = Matrix::from_fn(n, n, |i, j| columns[j][i].clone());
        (at.sign(&determinant(&whole)) != 0).then_some((chord, words))
    }

    fn word(&self, word: &[usize]) -> Rc<Word<P>> {
        if let Some(known) = self.words.borrow().get(word) {
            return Rc::clone(known);
        }
        let matrix = self.family.product(word);
        let chi = matrix.char_poly_over(&P::ring());
        let eigenvalues = P::eigenvalues(&matrix, &chi);
        let made = Rc::new(Word { matrix, chi, eigenvalues });
        self.words.borrow_mut().insert(word.to_vec(), Rc::clone(&made));
        made
    }

    /// The leading eigenvalue, where it is a polynomial with one Jordan block of length 1 or 2, and larger than all others in
    /// modulus.
    pub fn leading(&self, at: &impl Signs<P>, word: &[usize]) -> Option<Leading<P>> {
        let own = self.word(word);
        own.eigenvalues.iter().find_map(|value| {
            let mark = at.mark();
            let found = self.leads(at, &own, value);
            if found.is_none() {
                at.forget(mark);
            }
            found
        })
    }

    fn leads(&self, at: &impl Signs<P>, own: &Word<P>, value: &P) -> Option<Leading<P>> {
        let sign = at.sign(value);
        if sign == 0 {
            return None;
        }
        let mut rest = without_root(&own.chi, value);
        let chain = horner(&rest, value).vanishes();
        if chain {
            rest = without_root(&rest, value);
        }
        let mut power = P::number(Rational::from(1));
        let mut shrunk = Vec::new();
        for c in &rest {
            shrunk.push(c.times(&power));
            power = power.times(value);
        }
        if !is_stable(at, shrunk) {
            return None;
        }
        let side = at.sign(&horner(&rest, value));
        let projection = adjugate(&own.matrix, &own.chi, value).map(|f| f.multiple(&Rational::from(side)));
        if side == 0 || (chain && !at.is_not_zero(projection.entries())) {
            return None;
        }
        self.beyond.set(self.beyond.get() || chain);
        Some(Leading { value: value.clone(), positive: sign > 0, longer: chain, projection })
    }

    /// Differences from an end to points of the curve.
    fn differences(&self, chord: &[P], germ: &Germ) -> Vec<Vec<P>> {
        let family = self.family;
        let forward = if germ.at_start { 1 } else { -1 };
        let mut all = vec![scaled(chord, forward)];
        let letters: Vec<usize> =
            if germ.at_start { (0..family.linear.len()).collect() } else { (0..family.linear.len()).rev().collect() };
        let mut sum: Vec<P> = vec![P::nought(); chord.len()];
        for l in &letters[..letters.len() - 1] {
            let step = scaled(&apply(&family.linear[*l], chord), forward * family.sign(&[*l]));
            sum = sum.iter().zip(&step).map(|(a, b)| a.plus(b)).collect();
            all.push(sum.clone());
        }
        all
    }

    fn germ(&self, at: &impl Signs<P>, germ: &Germ, chord: &[P]) -> EndGerm<P> {
        let through = self.family.product(&germ.prefix);
        let Some(lead) = self.leading(at, &germ.cycle) else {
            let own = self.word(&germ.cycle);
            let [c, b, _] = own.chi.as_slice() else { return EndGerm::Unknown };
            let spiral = b.times(b).minus(&c.multiple(&Rational::from(4)));
            let plane = at.sign(&spiral) < 0 && at.sign(&determinant(&through)) != 0;
            return if plane { EndGerm::Plane } else { EndGerm::Unknown };
        };
        for a in self.differences(chord, germ) {
            let Some(local) = at.primitive(&apply(&lead.projection, &a)) else { continue };
            let Some(k) = (0..local.len()).find(|&k| at.sign(&local[k]) != 0) else { continue };
            let row = scaled(lead.projection.row(k), at.sign(&local[k]));
            return match at.primitive(&apply(&through, &local)) {
                Some(ray) => {
                    let forward = if germ.at_start { 1 } else { -1 };
                    EndGerm::Line { value: lead.value, ray, positive: lead.positive, row, forward, longer: lead.longer }
                }
                None => EndGerm::Unknown,
            };
        }
        EndGerm::Unknown
    }

    fn joints(&self, at: &impl Signs<P>, germs: &[EndGerm<P>; 2]) -> Vec<Joint<P>> {
        let family = self.family;
        let side = |letter: usize, finish: bool| match &germs[usize::from(finish != family.reversed[letter])] {
            EndGerm::Line { ray, positive, .. } => {
                at.primitive(&apply(&family.linear[letter], ray)).map(|d| (d, *positive))
            }
            EndGerm::Plane | EndGerm::Unknown => None,
        };
        let joint = |letter: usize| Joint { left: side(letter, true), right: side(letter + 1, false) };
        (0..family.linear.len() - 1).map(joint).collect()
    }

    /// What known directions refute, without a ring condition.
    fn refuted(&self, at: &impl Signs<P>, germs: &[EndGerm<P>; 2], joints: &[Joint<P>]) -> Vec<Fact<P>> {
        let mut facts: Vec<Fact<P>> = Vec::new();
        let mut push = |claim, why| {
            if !facts.iter().any(|f: &Fact<P>| f.claim == claim) {
                facts.extend(Fact::of(at, claim, Verdict::Refuted, why));
            }
        };
        for (germ, end) in germs.iter().zip([CurveEnd::Start, CurveEnd::Finish]) {
            match germ {
                EndGerm::Plane => {
                    push(CurveClaim::Ends, Why::Spiral(end));
                    push(CurveClaim::G1, Why::Spiral(end));
                }
                EndGerm::Line { positive: false, .. } => push(CurveClaim::G1, Why::Alternates(end)),
                _ => {}
            }
        }
        for (k, joint) in joints.iter().enumerate() {
            let (Some((a, up)), Some((b, on))) = (&joint.left, &joint.right) else { continue };
            if !at.parallel(a, b) {
                push(CurveClaim::Joints, Why::Corner(k));
                push(CurveClaim::G1, Why::Corner(k));
            } else if *up && *on && at.sign(&dot(a, b)) > 0 {
                push(CurveClaim::G1, Why::Cusp(k));
            }
        }
        facts
    }

    /// A cycle at which a tangent line is that of its leading eigenvector, while a joint that comes nearer keeps another direction.
    fn jumps(&self, at: &impl Signs<P>, joints: &[Joint<P>]) -> Option<Fact<P>> {
        let letters = self.family.linear.len();
        let pairs = (0..letters).flat_map(|a| (0..letters).map(move |b| vec![a, b]));
        let words: Vec<Vec<usize>> = (0..letters).map(|l| vec![l]).chain(pairs.filter(|w| w[0] != w[1])).collect();
        let sides = joints.iter().enumerate().flat_map(|(k, j)| [((k, 0), &j.left), ((k, 1), &j.right)]);
        for (place, side) in sides {
            let Some((line, _)) = side else { continue };
            for word in &words {
                let own = at.clone();
                let Some(lead) = self.leading(&own, word) else { continue };
                let image = apply(&self.word(word).matrix, line);
                let Some(image) = own.primitive(&image) else { continue };
                if !own.parallel(&image, line) {
                    continue;
                }
                let column = (0..line.len()).find_map(|c| own.primitive(&lead.projection.column(c)));
                if column.is_some_and(|v| !own.parallel(&v, line))
                    && let Some(mut fact) = Fact::of(&own, CurveClaim::G1, Verdict::Refuted, Why::Jumps(word.clone()))
                {
                    fact.evidence.cycles = vec![(word.clone(), lead.value)];
                    fact.evidence.place = Some(place);
                    return Some(fact);
                }
            }
        }
        None
    }
}

/// Searches for constant rays.
const SEARCHES: usize = 40;
