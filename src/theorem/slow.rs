//! Nested cones shrink along every address if positive products come back again and again, or the address ends in a cycle
//! that pulls the whole cone to one ray (Theorem 6′).

use super::cone::CommonCone;
use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::jordan::{Chain, Eigenvalue, Factor, Leading, ModulusClass, Spectrum};
use crate::linalg::Matrix;
use crate::shape::{Shape, Spaces};
use std::collections::BTreeMap;

/// A cycle along which no product of the matrices `B` is positive, and why its cones shrink to a ray all the same: on `V` one
/// positive eigenvalue has the one longest Jordan block of largest modulus, and its leading coefficient is positive on all rays but its
/// own eigenvector.
#[derive(Debug, Clone)]
pub struct SlowCycle {
    /// The state of the cycle.
    pub state: usize,
    /// The cycle.
    pub word: Vec<usize>,
    /// The product on `V`, with the orientation signs.
    pub linear: Matrix,
    /// Its spectrum.
    pub spectrum: Spectrum,
    /// The eigenvalue.
    pub lead: Eigenvalue,
    /// The leading coefficient as a row on `V`, positive on all rays but those along the eigenvector, which have the sign in
    /// which the others tend to it.
    pub functional: Vec<Elem>,
}

/// Longest window.
pub const MAX_WINDOW: usize = 6;
/// Most words of one window without a positive factor.
const MAX_WORDS: usize = 400;

/// A word from a state, with the patterns of the products of all its ends.
struct Word {
    state: usize,
    letters: Vec<usize>,
    end: usize,
    /// The pattern of the product of the letters from each position on.
    suffixes: Vec<Pattern>,
}

/// Which entries of a nonnegative matrix are positive.
#[derive(Clone, PartialEq, Eq)]
struct Pattern(Vec<Vec<bool>>);

impl Pattern {
    fn of(m: &Matrix) -> Self {
        Self((0..m.rows()).map(|i| m.row(i).iter().map(|x| *x > 0).collect()).collect())
    }

    fn times(&self, other: &Self) -> Self {
        let cols = other.0.first().map_or(0, Vec::len);
        let entry = |row: &[bool], j: usize| row.iter().zip(&other.0).any(|(a, b)| *a && b[j]);
        Self(self.0.iter().map(|row| (0..cols).map(|j| entry(row, j)).collect()).collect())
    }

    fn is_full(&self) -> bool {
        self.0.iter().flatten().all(|x| *x)
    }
}

/// The cycles of the addresses in which, from some place on, no factor of length up to `window` has a positive product; `None`
/// where these are not finitely many.
pub fn cycles(cone: &CommonCone, shape: &Shape, window: usize) -> Option<Vec<(usize, Vec<usize>)>> {
    let patterns: BTreeMap<(usize, usize), Pattern> =
        cone.maps.iter().map(|m| ((m.state, m.letter), Pattern::of(&m.matrix))).collect();
    let states = shape.reachable();
    let mut words: Vec<Word> =
        states.iter().map(|&state| Word { state, letters: Vec::new(), end: state, suffixes: Vec::new() }).collect();
    for _ in 0..window {
        let mut longer = Vec::new();
        for word in &words {
            for (letter, piece) in shape.states[word.end].pieces.iter().enumerate() {
                let last = patterns.get(&(word.end, letter))?;
                let mut suffixes: Vec<Pattern> = word.suffixes.iter().map(|s| s.times(last)).collect();
                suffixes.push(last.clone());
                if !suffixes.iter().any(Pattern::is_full) {
                    let letters = [word.letters.as_slice(), &[letter]].concat();
                    longer.push(Word { state: word.state, letters, end: piece.target, suffixes });
                }
            }
        }
        if longer.len() > MAX_WORDS {
            return None;
        }
        words = longer;
    }
    simple_cycles(&words, shape)
}

/// The cycles of the graph of overlapping words, if no two of them meet.
fn simple_cycles(words: &[Word], shape: &Shape) -> Option<Vec<(usize, Vec<usize>)>> {
    let follows = |a: &Word, b: &Word| {
        shape.states[a.state].pieces[a.letters[0]].target == b.state
            && a.letters[1..] == b.letters[..b.letters.len() - 1]
    };
    let next: Vec<Vec<usize>> =
        words.iter().map(|a| (0..words.len()).filter(|&k| follows(a, &words[k])).collect()).collect();
    let reach: Vec<Vec<bool>> = (0..words.len()).map(|k| reached(&next, k)).collect();
    let mut found = Vec::new();
    let mut seen = vec![false; words.len()];
    for k in (0..words.len()).filter(|&k| reach[k][k]) {
        let inside: Vec<usize> = next[k].iter().copied().filter(|&j| reach[j][k]).collect();
        if inside.len() != 1 {
            return None;
        }
        if seen[k] {
            continue;
        }
        let (mut at, mut word) = (k, Vec::new());
        while !seen[at] {
            seen[at] = true;
            word.push(words[at].letters[0]);
            at = next[at].iter().copied().find(|&j| reach[j][at])?;
        }
        found.push((words[k].state, word));
    }
    Some(found)
}

/// What can be reached in at least one step.
fn reached(next: &[Vec<usize>], from: usize) -> Vec<bool> {
    let mut seen = vec![false; next.len()];
    let mut open = next[from].clone();
    while let Some(k) = open.pop() {
        if !seen[k] {
            seen[k] = true;
            open.extend(&next[k]);
        }
    }
    seen
}

impl SlowCycle {
    /// The evidence for a cycle, or `None` where it does not pull the cone to one ray.
    #[must_use]
    pub fn find(cone: &CommonCone, shape: &Shape, spaces: &Spaces, state: usize, word: &[usize]) -> Option<Self> {
        let linear = signed_product(shape, spaces, state, word)?;
        let spectrum = Spectrum::of(&linear);
        let lead = leading(&spectrum)?;
        let longest = spectrum.factor(lead).blocks[0];
        let functional = longest_chain(&spectrum.factor(lead).left, longest)?.vectors[0].clone();
        for sign in [1, -1] {
            let functional: Vec<Elem> = functional.iter().map(|x| x.scale(&Rational::from(sign))).collect();
            let found = Self {
                state,
                word: word.to_vec(),
                linear: linear.clone(),
                spectrum: spectrum.clone(),
                lead,
                functional,
            };
            if found.positive(cone, spaces) {
                return Some(found);
            }
        }
        None
    }

    /// The evidence for a piece from a state to itself and rays in coordinates of its relevant space: the functional is positive on
    /// all of them, or negative on all of them and then turned round.
    pub(super) fn of_rays(
        shape: &Shape,
        spaces: &Spaces,
        (state, letter): (usize, usize),
        rays: &Matrix,
    ) -> Option<Self> {
        let word = vec![letter];
        let linear = signed_product(shape, spaces, state, &word)?;
        let spectrum = Spectrum::of(&linear);
        let lead = leading(&spectrum)?;
        let functional =
            longest_chain(&spectrum.factor(lead).left, spectrum.factor(lead).blocks[0])?.vectors[0].clone();
        let root = spectrum.root(lead).clone();
        let zero = || Elem::from_rational(&Rational::from(0));
        let value = |j: usize| {
            let column = rays.column(j);
            functional.iter().zip(&column).fold(zero(), |s, (g, x)| s.add(&g.scale(x))).sign(&root)
        };
        let sign = (rays.cols() > 0).then(|| value(0)).filter(|s| *s != 0)?;
        if (1..rays.cols()).any(|j| value(j) != sign) {
            return None;
        }
        let functional = functional.iter().map(|x| x.scale(&Rational::from(sign))).collect();
        Some(Self { state, word, linear, spectrum, lead, functional })
    }

    /// Whether the cycle belongs to the shape, and every ray has a positive leading coefficient or is the one to which the
    /// others are pulled.
    #[must_use]
    pub fn holds(&self, cone: &CommonCone, shape: &Shape, spaces: &Spaces) -> bool {
        signed_product(shape, spaces, self.state, &self.word).as_ref() == Some(&self.linear)
            && leading(&self.spectrum) == Some(self.lead)
            && self.positive(cone, spaces)
    }

    /// Whether every ray has a positive leading coefficient, or is the ray to which the others are pulled.
    fn positive(&self, cone: &CommonCone, spaces: &Spaces) -> bool {
        let root = self.spectrum.root(self.lead);
        self.on_rays(cone, spaces).is_some_and(|all| all.iter().all(|(value, along)| value.sign(root) > 0 || *along))
    }

    /// For every ray of the cone the value of the functional, and whether the ray is a multiple of the eigenvector with the sign
    /// in which the others tend to it. `None` where there is no cone or no chain.
    #[must_use]
    pub fn on_rays(&self, cone: &CommonCone, spaces: &Spaces) -> Option<Vec<(Elem, bool)>> {
        let own = cone.cones.iter().find(|c| c.state == self.state)?;
        let rays = &spaces.of(self.state).coordinates * &own.rays;
        let (root, factor) = (self.spectrum.root(self.lead), self.spectrum.factor(self.lead));
        let chain = longest_chain(&factor.right, factor.blocks[0])?;
        let last = chain.vectors.last()?;
        let zero = || Elem::from_rational(&Rational::from(0));
        let pairing = self.functional.iter().zip(last).fold(zero(), |s, (g, v)| s.add(&g.mul(v, &factor.poly)));
        let pairing = pairing.sign(root);
        let of = |ray: Vec<Rational>| {
            let value = self.functional.iter().zip(&ray).fold(zero(), |s, (g, x)| s.add(&g.scale(x)));
            (value, along(&chain.vectors[0], &ray, root) == Some(pairing))
        };
        Some((0..rays.cols()).map(|j| of(rays.column(j))).collect())
    }
}

/// The sign of the factor by which a vector is a multiple of `v`; `None` where it is none.
fn along(v: &[Elem], ray: &[Rational], root: &Root) -> Option<i32> {
    for i in 0..v.len() {
        for j in 0..i {
            if !v[j].scale(&ray[i]).sub(&v[i].scale(&ray[j])).is_zero() {
                return None;
            }
        }
    }
    let k = (0..v.len()).find(|&k| ray[k] != 0 && !v[k].is_zero())?;
    Some(v[k].sign(root) * if ray[k] > 0 { 1 } else { -1 })
}

/// The positive eigenvalue of largest modulus with the one longest block.
fn leading(spectrum: &Spectrum) -> Option<Eigenvalue> {
    longest_block(&spectrum.factors, spectrum.classes.first()?)
}

/// The same from the factors of the eigenvalues of largest modulus.
fn longest_block(factors: &[Factor], class: &ModulusClass) -> Option<Eigenvalue> {
    let blocks = |m: &Eigenvalue| &factors[m.factor].blocks;
    let longest = class.members.iter().map(|m| blocks(m)[0]).max()?;
    let count = |m: &Eigenvalue| blocks(m).iter().filter(|b| **b == longest).count();
    let with: Vec<Eigenvalue> = class.members.iter().copied().filter(|m| count(m) > 0).collect();
    let [lead] = with[..] else { return None };
    let root = &factors[lead.factor].roots[lead.root];
    (count(&lead) == 1 && root.is_real() && root.sign() > 0).then_some(lead)
}

fn longest_chain(chains: &[Chain], length: usize) -> Option<&Chain> {
    chains.iter().find(|c| c.vectors.len() == length)
}

/// The product of a cycle on `V`, times its orientation signs.
fn signed_product(shape: &Shape, spaces: &Spaces, state: usize, word: &[usize]) -> Option<Matrix> {
    let (product, end) = shape.product(state, word);
    if end != state {
        return None;
    }
    let states = shape.path(state, word);
    let reversed = word.iter().zip(&states).filter(|(i, e)| shape.states[**e].pieces[**i].reversed).count();
    let sign = if reversed % 2 == 0 { 1 } else { -1 };
    Some(spaces.linear(&product, state, state).scale(&Rational::from(sign)))
}

/// The ray to which a cycle pulls most of the space, on the side of `chord`, where it is rational: a proposal.
pub fn limit_ray(product: &Matrix, chord: &[Rational]) -> Option<Vec<Rational>> {
    let top = Leading::of(product)?;
    let factor = &top.factors[longest_block(&top.factors, &top.class)?.factor];
    let longest = factor.blocks[0];
    let plain = |v: &[Elem]| v.iter().map(Elem::is_rational).collect::<Option<Vec<Rational>>>();
    let right = longest_chain(&factor.right, longest)?;
    let (ray, last) = (plain(&right.vectors[0])?, plain(right.vectors.last()?)?);
    let row = plain(&longest_chain(&factor.left, longest)?.vectors[0])?;
    let sign = crate::linalg::dot(&row, chord) * crate::linalg::dot(&row, &last);
    (sign != 0).then(|| ray.into_iter().map(|x| if sign > 0 { x } else { -x }).collect())
}
