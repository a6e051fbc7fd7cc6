//! Block triangularisation: strongly connected parts of the coordinates, then common invariant subspaces, exactly.
//!
//! The joint spectral radius is the largest of the radii of the diagonal blocks.

use super::radial::Radial;
use super::{Arrow, System};
use crate::arith::Rational;
use crate::arith::modular::{PrimeField, large_primes};
use crate::jordan::Spectral;
use crate::linalg::Matrix;

/// A diagonal block: the arrows keep, as labels, their positions in the whole system.
#[derive(Debug, Clone)]
pub struct Block<E = Rational> {
    /// The block's own system.
    pub system: System<E>,
    /// For every state of the block, the state of the whole system.
    pub states: Vec<usize>,
    /// Whether it was shown that there is no common invariant family of subspaces over the field of the entries or, of
    /// nonnegative matrices, no common invariant face of the orthants. Either makes `‖T_w‖ <= C radius^|w|` (theory §11).
    pub irreducible: bool,
}

/// One step of a flag of invariant families of subspaces: the arrows act on the quotient by the steps before as a block.
#[derive(Debug, Clone)]
pub struct Step<E = Rational> {
    /// For every state of the whole system, vectors (columns) that span the step modulo the ones before.
    pub frame: Vec<Matrix<E>>,
    /// The block; `None` where all its products over long paths vanish (its matrices are 0).
    pub block: Option<Block<E>>,
}

/// A part of the system with its vectors in the whole system.
struct Part<E> {
    system: System<E>,
    states: Vec<usize>,
    /// By state of the part.
    frame: Vec<Matrix<E>>,
}

/// The diagonal blocks with a cyclic path; an empty list means that all products over long paths vanish.
///
/// # Cost
/// Polynomial; one characteristic polynomial and a few closures for each block and trial.
#[must_use]
pub fn blocks<E: Radial>(system: &System<E>) -> Vec<Block<E>> {
    flag(system).into_iter().filter_map(|step| step.block).collect()
}

/// A flag of invariant families of subspaces, as fine as it was found: in its frames, all arrows are block upper triangular.
#[must_use]
pub fn flag<E: Radial>(system: &System<E>) -> Vec<Step<E>> {
    let arrows = system.arrows.iter().enumerate().map(|(k, a)| Arrow { label: k, ..a.clone() }).collect();
    let whole = Part {
        system: System { dims: system.dims.clone(), arrows },
        states: (0..system.dims.len()).collect(),
        frame: system.dims.iter().map(|d| Matrix::identity(*d)).collect(),
    };
    let mut steps = Vec::new();
    refine(&whole, system, &mut steps);
    steps
}

/// The flag of one step: the whole system as one block.
#[must_use]
pub(super) fn undivided<E: Radial>(system: &System<E>) -> Vec<Step<E>> {
    let arrows = system.arrows.iter().enumerate().map(|(k, a)| Arrow { label: k, ..a.clone() }).collect();
    let own = System { dims: system.dims.clone(), arrows };
    let block = Block { system: own, states: (0..system.dims.len()).collect(), irreducible: false };
    vec![Step { frame: system.dims.iter().map(|d| Matrix::identity(*d)).collect(), block: Some(block) }]
}

fn refine<E: Radial>(part: &Part<E>, whole: &System<E>, steps: &mut Vec<Step<E>>) {
    for (component, cyclic) in components(part) {
        let frame = (0..whole.dims.len()).map(|s| {
            let own = component.states.iter().position(|k| *k == s);
            own.map_or_else(|| Matrix::zero(whole.dims[s], 0), |k| component.frame[k].clone())
        });
        let frame = frame.collect();
        if !cyclic {
            steps.push(Step { frame, block: None });
            continue;
        }
        let done =
            |irreducible| Block { system: component.system.clone(), states: component.states.clone(), irreducible };
        if component.system.is_nonnegative() {
            steps.push(Step { frame, block: Some(done(true)) });
            continue;
        }
        match split(&component) {
            Split::Irreducible => steps.push(Step { frame, block: Some(done(true)) }),
            Split::Unknown => steps.push(Step { frame, block: Some(done(false)) }),
            Split::Parts(sub, quotient) => {
                refine(&sub, whole, steps);
                refine(&quotient, whole, steps);
            }
        }
    }
}

/// The strongly connected parts of the graph on (state, coordinate) pairs, those before that are reached, and whether they
/// contain a cycle.
fn components<E: Radial>(part: &Part<E>) -> Vec<(Part<E>, bool)> {
    let system = &part.system;
    let offsets: Vec<usize> = system
        .dims
        .iter()
        .scan(0, |sum, d| {
            let o = *sum;
            *sum += d;
            Some(o)
        })
        .collect();
    let count: usize = system.dims.iter().sum();
    let mut reach = vec![vec![false; count]; count];
    for a in &system.arrows {
        for i in 0..a.matrix.rows() {
            for (j, x) in a.matrix.row(i).iter().enumerate() {
                reach[offsets[a.from] + i][offsets[a.to] + j] |= !x.is_zero();
            }
        }
    }
    for k in 0..count {
        let through = reach[k].clone();
        for row in &mut reach {
            if row[k] {
                row.iter_mut().zip(&through).for_each(|(r, t)| *r |= t);
            }
        }
    }
    let together = |i: usize, j: usize| i == j || (reach[i][j] && reach[j][i]);
    let mut tops: Vec<usize> = (0..count).filter(|&t| (0..t).all(|i| !together(i, t))).collect();
    // `reach[i][j]`: axis j is mapped to axis i in the end. What is reached by fewer comes first.
    tops.sort_by_key(|&t| ((0..count).filter(|&i| reach[i][t]).count(), !reach[t][t], t));
    tops.into_iter()
        .map(|top| {
            let own = |s: usize| (0..system.dims[s]).filter(|i| together(offsets[s] + i, top)).collect();
            let kept: Vec<Vec<usize>> = (0..system.dims.len()).map(own).collect();
            (restrict(part, &kept), reach[top][top])
        })
        .collect()
}

/// The principal part on some coordinates of every state; states without coordinates and zero arrows are dropped.
fn restrict<E: Radial>(part: &Part<E>, kept: &[Vec<usize>]) -> Part<E> {
    let system = &part.system;
    let alive: Vec<usize> = (0..kept.len()).filter(|s| !kept[*s].is_empty()).collect();
    let renamed = |s: usize| alive.iter().position(|a| *a == s);
    let arrows = system
        .arrows
        .iter()
        .filter_map(|a| {
            let (from, to) = (renamed(a.from)?, renamed(a.to)?);
            let (rows, cols) = (&kept[a.from], &kept[a.to]);
            let matrix = Matrix::from_fn(rows.len(), cols.len(), |i, j| a.matrix[(rows[i], cols[j])].clone());
            (!matrix.is_zero()).then_some(Arrow { from, to, matrix, label: a.label })
        })
        .collect();
    let frame = |s: &usize| {
        let old = &part.frame[*s];
        Matrix::from_fn(old.rows(), kept[*s].len(), |i, j| old[(i, kept[*s][j])].clone())
    };
    Part {
        system: System { dims: alive.iter().map(|s| kept[*s].len()).collect(), arrows },
        states: alive.iter().map(|s| part.states[*s]).collect(),
        frame: alive.iter().map(frame).collect(),
    }
}

enum Split<E> {
    Irreducible,
    Unknown,
    Parts(Part<E>, Part<E>),
}

/// Looks for a common invariant family of subspaces (Norton's criterion on random elements of the algebra of a state).
fn split<E: Radial>(part: &Part<E>) -> Split<E> {
    let system = &part.system;
    let Some(home) = (0..system.dims.len()).min_by_key(|s| system.dims[*s]) else { return Split::Unknown };
    let whole = Matrix::identity(system.dims[home]);
    // What one state generates, and what never returns to it.
    for (left, family) in [(false, spin(system, home, &whole, false)), (true, spin(system, home, &whole, true))] {
        if proper(system, &family) {
            return parts(part, &oriented(system, family, left));
        }
    }
    if system.dims[home] == 1 {
        return Split::Irreducible;
    }
    // The field over which nothing splits: that of all entries, not of the element alone.
    let field = E::base(system.arrows.iter().flat_map(|a| a.matrix.entries()));
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for trial in 0..12 {
        let Some(element) = random_element(system, home, &mut random, trial) else { return Split::Unknown };
        let spectrum = E::spectrum(&element, &field);
        let degree = |k: usize| spectrum.part(k).roots.len();
        let mut factors: Vec<usize> = (0..spectrum.factor_count()).collect();
        factors.sort_by_key(|k| (degree(*k), spectrum.part(*k).multiplicity));
        for factor in factors.into_iter().take(3) {
            let value = E::factor_at(&spectrum, factor, &element);
            let kernel = value.kernel();
            if kernel.cols() == 0 {
                continue;
            }
            let seed = Matrix::from_rows(system.dims[home], vec![kernel.column(0)]);
            let family = spin(system, home, &seed, false);
            if proper(system, &family) {
                return parts(part, &family);
            }
            let cokernel = value.transpose().kernel();
            let seed = Matrix::from_rows(system.dims[home], vec![cokernel.column(0)]);
            let family = spin(system, home, &seed, true);
            if proper(system, &family) {
                return parts(part, &oriented(system, family, true));
            }
            if degree(factor) == kernel.cols() {
                return Split::Irreducible;
            }
        }
    }
    Split::Unknown
}

/// A small generator of pseudo-random numbers, so that runs agree.
struct Random(u64);

impl Random {
    /// Below `n`, which is not 0.
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from((self.0 >> 33) % n as u64).expect("31 bits")
    }
}

/// A small combination of products over cycles at a state.
fn random_element<E: Radial>(system: &System<E>, home: usize, random: &mut Random, trial: usize) -> Option<Matrix<E>> {
    let dim = system.dims[home];
    let mut sum: Matrix<E> = Matrix::zero(dim, dim);
    for _ in 0..(2 + trial % 3) {
        let cycle = random_cycle(system, home, random)?;
        let factor = [1, -1, 2, 3, -2][random.below(5)];
        sum = &sum + &system.product(&cycle).scale(&E::integer(factor));
    }
    Some(sum)
}

fn random_cycle<E>(system: &System<E>, home: usize, random: &mut Random) -> Option<Vec<usize>> {
    for _ in 0..64 {
        let mut path = Vec::new();
        let mut state = home;
        let wanted = 1 + random.below(2);
        let mut returns = 0;
        while path.len() < 64 {
            let next: Vec<usize> = (0..system.arrows.len()).filter(|&a| system.arrows[a].from == state).collect();
            if next.is_empty() {
                break;
            }
            let arrow = next[random.below(next.len())];
            path.push(arrow);
            state = system.arrows[arrow].to;
            if state == home {
                returns += 1;
                if returns == wanted {
                    return Some(path);
                }
            }
        }
    }
    None
}

/// Whether the smallest invariant family of [`spin`] is everything, seen modulo a prime: ranks modulo a prime are at most those over
/// the rationals. `false` says nothing.
fn spins_to_all<E: Radial>(system: &System<E>, state: usize, seed: &Matrix<E>, dual: bool) -> bool {
    let Some(field) = large_primes().next().map(PrimeField::new) else { return false };
    let residues = |m: &Matrix<E>| -> Option<Vec<Vec<u64>>> {
        (0..m.rows()).map(|i| m.row(i).iter().map(|x| field.from_rational(&x.rational()?)).collect()).collect()
    };
    let turned = |a: &Arrow<E>| residues(&if dual { a.matrix.clone() } else { a.matrix.transpose() });
    let maps: Option<Vec<Vec<Vec<u64>>>> = system.arrows.iter().map(turned).collect();
    let (Some(maps), Some(rows)) = (maps, residues(seed)) else { return false };
    let mut spaces: Vec<ModSpan> = system.dims.iter().map(|_| ModSpan::default()).collect();
    let mut open: Vec<(usize, Vec<u64>)> = rows.into_iter().map(|row| (state, row)).collect();
    while let Some((s, row)) = open.pop() {
        let Some(own) = spaces[s].extend(&field, row) else { continue };
        for (a, map) in system.arrows.iter().zip(&maps) {
            let (source, target) = if dual { (a.from, a.to) } else { (a.to, a.from) };
            if source == s && spaces[target].rows.len() < system.dims[target] {
                let mut image = vec![0; system.dims[target]];
                for (x, line) in own.iter().zip(map).filter(|(x, _)| **x != 0) {
                    image.iter_mut().zip(line).for_each(|(y, m)| *y = field.add(*y, field.mul(*x, *m)));
                }
                open.push((target, image));
            }
        }
    }
    spaces.iter().zip(&system.dims).all(|(space, dim)| space.rows.len() == *dim)
}

/// A space of rows modulo a prime, in echelon form: each with its leading column, where it has a one.
#[derive(Default)]
struct ModSpan {
    rows: Vec<(usize, Vec<u64>)>,
}

impl ModSpan {
    /// What is left of a row, which then belongs to the space; `None` where nothing is left.
    fn extend(&mut self, field: &PrimeField, mut row: Vec<u64>) -> Option<Vec<u64>> {
        for (column, known) in &self.rows {
            let factor = field.neg(row[*column]);
            if factor != 0 {
                row.iter_mut().zip(known).for_each(|(x, y)| *x = field.add(*x, field.mul(factor, *y)));
            }
        }
        let column = row.iter().position(|x| *x != 0)?;
        let inverse = field.inverse(row[column]);
        row.iter_mut().for_each(|x| *x = field.mul(*x, inverse));
        self.rows.push((column, row.clone()));
        Some(row)
    }
}

/// The smallest invariant family that contains the rows of `seed` at a state; with `dual`, of the transposed system.
fn spin<E: Radial>(system: &System<E>, state: usize, seed: &Matrix<E>, dual: bool) -> Vec<Matrix<E>> {
    if spins_to_all(system, state, seed, dual) {
        return system.dims.iter().map(|d| Matrix::identity(*d)).collect();
    }
    let mut family: Vec<Matrix<E>> = system.dims.iter().map(|d| Matrix::zero(0, *d)).collect();
    family[state] = seed.echelon().rows;
    let mut changed = vec![state];
    while let Some(s) = changed.pop() {
        for a in &system.arrows {
            let (source, target) = if dual { (a.from, a.to) } else { (a.to, a.from) };
            if source != s || family[target].rows() == system.dims[target] {
                continue;
            }
            let images = if dual { &family[s] * &a.matrix } else { &family[s] * &a.matrix.transpose() };
            let joined = family[target].stack(&images).echelon().rows;
            if joined.rows() > family[target].rows() {
                family[target] = joined;
                if !changed.contains(&target) {
                    changed.push(target);
                }
                if target == s && !changed.contains(&s) {
                    changed.push(s);
                }
            }
        }
    }
    family
}

fn proper<E: Radial>(system: &System<E>, family: &[Matrix<E>]) -> bool {
    family.iter().any(|f| f.rows() > 0) && family.iter().zip(&system.dims).any(|(f, d)| f.rows() < *d)
}

/// The invariant family itself, or the annihilator of one of the transposed system.
fn oriented<E: Radial>(system: &System<E>, family: Vec<Matrix<E>>, left: bool) -> Vec<Matrix<E>> {
    if !left {
        return family;
    }
    family
        .into_iter()
        .zip(&system.dims)
        .map(|(f, d)| if f.rows() == 0 { Matrix::identity(*d) } else { f.kernel().transpose() })
        .collect()
}

/// The systems induced on an invariant family and on its quotient.
fn parts<E: Radial>(part: &Part<E>, family: &[Matrix<E>]) -> Split<E> {
    let system = &part.system;
    // A basis of every state whose first vectors span the family: columns; and its inverse.
    let frames: Option<Vec<(usize, Matrix<E>, Matrix<E>)>> = family
        .iter()
        .zip(&system.dims)
        .map(|(f, &dim)| {
            let pivots = f.echelon().pivots;
            let rest = (0..dim).filter(|i| !pivots.contains(i));
            let mut columns: Vec<Vec<E>> = (0..f.rows()).map(|i| f.row(i).to_vec()).collect();
            columns.extend(rest.map(|i| (0..dim).map(|k| E::integer(i64::from(k == i))).collect()));
            let basis = Matrix::from_columns(dim, &columns);
            let inverse = basis.inverse()?;
            Some((f.rows(), basis, inverse))
        })
        .collect();
    let Some(frames) = frames else { return Split::Unknown };
    let block = |upper: bool| {
        let range = |s: usize| if upper { 0..frames[s].0 } else { frames[s].0..system.dims[s] };
        let arrows = system.arrows.iter().map(|a| {
            let whole = &(&frames[a.from].2 * &a.matrix) * &frames[a.to].1;
            let (rows, cols) = (range(a.from), range(a.to));
            let matrix =
                Matrix::from_fn(rows.len(), cols.len(), |i, j| whole[(rows.start + i, cols.start + j)].clone());
            Arrow { matrix, ..a.clone() }
        });
        let frame = |s: usize| {
            let basis = &part.frame[s] * &frames[s].1;
            Matrix::from_fn(basis.rows(), range(s).len(), |i, j| basis[(i, range(s).start + j)].clone())
        };
        Part {
            system: System { arrows: arrows.collect(), dims: (0..system.dims.len()).map(|s| range(s).len()).collect() },
            states: part.states.clone(),
            frame: (0..system.dims.len()).map(frame).collect(),
        }
    };
    Split::Parts(block(true), block(false))
}
