//! The Fourier blocks of a rule with a parameter, at one valence.

use super::RegionError;
use crate::arith::Rational;
use crate::poly::Poly;
use crate::ring::{Field as _, Ring as _};
use crate::scheme::MeshRule;
use crate::vertex::block::{Vertex, strong_parts};
use crate::vertex::cosine::{gcd, minimal_polynomial};
use crate::vertex::field::{Enclosures, Field as _, Fixed};
use crate::vertex::ring::RINGS;
use crate::vertex::turning::{Symbol, Turning};

/// A rule on meshes whose weights are polynomials in a parameter.
pub struct RuleFamily<'a> {
    /// The range of the parameter, with its ends.
    pub range: (Rational, Rational),
    /// The largest degree of a weight.
    pub degree: usize,
    /// The rule at a value.
    pub member: &'a dyn Fn(&Rational) -> Result<MeshRule, RegionError>,
}

/// A polynomial in the parameter, by powers of it, whose coefficients are polynomials in `t`.
pub(super) type Moving = Vec<Poly>;

/// A factor of the characteristic polynomial of a block, without the eigenvalue 1.
pub(super) struct Piece {
    /// The index of the block.
    pub block: usize,
    /// The index of its part.
    pub part: usize,
    /// The coefficients from the constant one up.
    pub poly: Vec<Moving>,
}

impl Piece {
    /// Whether it is the same for every value of the parameter.
    pub fn is_constant(&self) -> bool {
        self.powers() <= 1
    }

    /// How many powers of the parameter occur in a coefficient.
    pub fn powers(&self) -> usize {
        self.poly.iter().map(Vec::len).fold(0, usize::max)
    }

    /// Whether `t` occurs.
    pub fn turns(&self) -> bool {
        self.poly.iter().flatten().any(|c| c.degree().is_some_and(|d| d > 0))
    }
}

/// A Fourier block. The indices are those of [`crate::vertex::block::Block`].
pub(super) struct MovingBlock {
    pub frequency: usize,
    pub angle: usize,
    pub before: usize,
    /// By row, column and power of the parameter.
    pub entries: Vec<Vec<Vec<Symbol>>>,
    pub parts: Vec<Vec<usize>>,
}

impl MovingBlock {
    /// Whether it is the same for every value of the parameter.
    pub fn is_constant(&self) -> bool {
        self.entries.iter().flatten().all(|e| e.len() <= 1)
    }

    /// The entries at a value.
    fn at(&self, p: &Rational) -> Vec<Vec<Symbol>> {
        let zero = Symbol::constant(&Rational::from(0));
        let value = |e: &Vec<Symbol>| e.iter().rev().fold(zero.clone(), |v, c| v.scale(p).add(c));
        self.entries.iter().map(|row| row.iter().map(value).collect()).collect()
    }

    /// The entries for all values of an interval.
    pub fn on(&self, field: &Enclosures, p: &Fixed) -> Vec<Vec<Turning<Fixed>>> {
        let along = |e: &Vec<Symbol>, side: fn(&Symbol) -> &Poly| {
            let t = field.twice_cosine();
            e.iter().rev().fold(field.zero(), |v, c| field.add(&field.mul(&v, p), &field.eval(side(c), &t)))
        };
        let value = |e: &Vec<Symbol>| Turning { x: along(e, |s| &s.x), y: along(e, |s| &s.y) };
        self.entries.iter().map(|row| row.iter().map(value).collect()).collect()
    }
}

/// A rule with a parameter at one valence.
pub(super) struct Model {
    /// A member; places and patches are those of all.
    pub vertex: Vertex,
    pub blocks: Vec<MovingBlock>,
    pub pieces: Vec<Piece>,
}

/// Members beyond those that determine the entries, to compare with.
const FURTHER: usize = 2;

impl Model {
    /// Entries are polynomials in the weights of a degree not above the number of steps.
    pub fn new(family: &RuleFamily<'_>, valence: usize) -> Result<Self, RegionError> {
        let (lo, hi) = &family.range;
        let first = (family.member)(lo)?;
        let degree = family.degree * first.steps();
        let count = degree + 1 + FURTHER;
        let share = |k: usize| Rational::from_unsigneds(k as u64, count as u64);
        let at: Vec<Rational> = (0..count).map(|k| lo + (hi - lo) * share(k)).collect();
        let mut members = Vec::new();
        for p in &at {
            let rule = (family.member)(p)?;
            if rule.lattice() != first.lattice() {
                return Err(RegionError::Everywhere);
            }
            members.push(Vertex::new(&rule, valence, RINGS)?);
        }
        let vertex = members.remove(0);
        let all = [std::slice::from_ref(&vertex), &members].concat();
        let blocks: Vec<MovingBlock> =
            vertex.frequencies().map(|k| block(&all, &at, degree, k)).collect::<Result<_, _>>()?;
        let mut model = Self { vertex, blocks, pieces: Vec::new() };
        model.pieces = model.factors(degree)?;
        Ok(model)
    }

    fn factors(&self, degree: usize) -> Result<Vec<Piece>, RegionError> {
        let (mut all, mut divided) = (Vec::new(), false);
        for (b, block) in self.blocks.iter().enumerate() {
            for (k, indices) in block.parts.iter().enumerate() {
                let at: Vec<Rational> = (0..=degree * indices.len()).map(|j| Rational::from(j as u64)).collect();
                let value = |p: &Rational| self.vertex.characteristic(&block.at(p), indices, block.angle);
                let values: Vec<Vec<Poly>> = at.iter().map(value).collect::<Result<_, _>>()?;
                let coefficient = |c: usize| {
                    let own: Vec<&Poly> = values.iter().map(|v| &v[c]).collect();
                    trimmed(through(&at, &own))
                };
                let mut poly: Vec<Moving> = (0..=indices.len()).map(coefficient).collect();
                if block.frequency == 0 && !divided && self.vanishes_at_one(block, &poly) {
                    divided = true;
                    poly = without_one(&poly);
                }
                if poly.len() > 1 {
                    all.push(Piece { block: b, part: k, poly });
                }
            }
        }
        if divided { Ok(all) } else { Err(RegionError::One) }
    }

    /// Whether 1 is an eigenvalue for every value of the parameter.
    fn vanishes_at_one(&self, block: &MovingBlock, poly: &[Moving]) -> bool {
        let modulus = minimal_polynomial(self.vertex.valence / gcd(block.angle, self.vertex.valence));
        let powers = poly.iter().map(Vec::len).fold(0, usize::max);
        (0..powers).all(|j| {
            let sum = poly.iter().filter_map(|c| c.get(j)).fold(Poly::zero(), |s, c| &s + c);
            sum.div_rem(&modulus).1.is_zero()
        })
    }

    /// The coefficients of a piece for all values of an interval.
    pub fn coefficients(&self, piece: &Piece, field: &Enclosures, p: &Fixed) -> Vec<Fixed> {
        let t = field.twice_cosine();
        let value =
            |c: &Moving| c.iter().rev().fold(field.zero(), |v, f| field.add(&field.mul(&v, p), &field.eval(f, &t)));
        piece.poly.iter().map(value).collect()
    }

    /// The field of a block.
    pub fn field(&self, block: usize, bits: u64) -> Enclosures {
        Enclosures::of_angle(self.blocks[block].angle, self.vertex.valence, bits)
    }
}

/// A block of a frequency, from members at values that are more than enough.
fn block(members: &[Vertex], at: &[Rational], degree: usize, frequency: usize) -> Result<MovingBlock, RegionError> {
    let all = members.iter().map(|m| m.entries(frequency)).collect::<Result<Vec<_>, _>>()?;
    let (first, before, angle) = &all[0];
    let size = first.len();
    if all.iter().any(|(entries, b, a)| (entries.len(), b, a) != (size, before, angle)) {
        return Err(RegionError::Polynomial);
    }
    let entry = |i: usize, j: usize| {
        let side = |side: fn(&Symbol) -> &Poly| {
            let own: Vec<&Poly> = all[..=degree].iter().map(|(e, ..)| side(&e[i][j])).collect();
            through(&at[..=degree], &own)
        };
        let (x, y) = (side(|s| &s.x), side(|s| &s.y));
        let mut powers: Vec<Symbol> = x.into_iter().zip(y).map(|(x, y)| Symbol { x, y }).collect();
        while powers.last().is_some_and(Symbol::is_zero) {
            powers.pop();
        }
        powers
    };
    let entries: Vec<Vec<Vec<Symbol>>> = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
    let parts = strong_parts(size, |i, j| !entries[i][j].is_empty());
    let block = MovingBlock { frequency, angle: *angle, before: *before, entries, parts };
    let fits = at.iter().zip(&all).all(|(p, (own, ..))| block.at(p) == *own);
    if fits { Ok(block) } else { Err(RegionError::Polynomial) }
}

/// Polynomials in `t` with given values, by powers of the parameter.
fn through(at: &[Rational], values: &[&Poly]) -> Moving {
    let length = values.iter().map(|v| v.coeffs().len()).fold(0, usize::max);
    let along: Vec<Poly> =
        (0..length).map(|d| Poly::through(at, values.iter().map(|v| v.coeff(d)).collect())).collect();
    (0..at.len()).map(|power| Poly::new(along.iter().map(|f| f.coeff(power)).collect())).collect()
}

fn trimmed(mut powers: Moving) -> Moving {
    while powers.last().is_some_and(Poly::is_zero) {
        powers.pop();
    }
    powers
}

/// The quotient by `x − 1`.
fn without_one(poly: &[Moving]) -> Vec<Moving> {
    let mut quotient: Vec<Moving> = Vec::new();
    let mut carry: Moving = Vec::new();
    for c in poly.iter().skip(1).rev() {
        let length = carry.len().max(c.len());
        let zero = Poly::zero();
        let term = |v: &Moving, k: usize| v.get(k).map_or_else(|| zero.clone(), Clone::clone);
        carry = trimmed((0..length).map(|k| &term(&carry, k) + &term(c, k)).collect());
        quotient.push(carry.clone());
    }
    quotient.reverse();
    quotient
}
