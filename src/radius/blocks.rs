//! Block triangularisation: strongly connected parts of the coordinates, then common invariant subspaces, exactly.
//!
//! The joint spectral radius is the largest of the radii of the diagonal blocks.

use super::{Arrow, System};
use crate::arith::Rational;
use crate::jordan::Spectrum;
use crate::linalg::Matrix;

/// A diagonal block: the arrows keep, as labels, their positions in the whole system.
#[derive(Debug, Clone)]
pub struct Block {
    /// The block's own system.
    pub system: System,
    /// For every state of the block, the state of the whole system.
    pub states: Vec<usize>,
    /// Whether it was shown that there is no common invariant subspace over the rationals.
    pub irreducible: bool,
}

/// The diagonal blocks with a cyclic path; an empty list means that all products over long paths vanish.
///
/// # Cost
/// Polynomial; one characteristic polynomial and a few closures for each block and trial.
#[must_use]
pub fn blocks(system: &System) -> Vec<Block> {
    let arrows = system.arrows.iter().enumerate().map(|(k, a)| Arrow { label: k, ..a.clone() }).collect();
    let whole = System { dims: system.dims.clone(), arrows };
    let states: Vec<usize> = (0..system.dims.len()).collect();
    let nonnegative = system.is_nonnegative();
    let mut done = Vec::new();
    let mut open = components(&whole, &states);
    while let Some((part, states)) = open.pop() {
        if nonnegative {
            done.push(Block { system: part, states, irreducible: true });
            continue;
        }
        match split(&part) {
            Split::Irreducible => done.push(Block { system: part, states, irreducible: true }),
            Split::Unknown => done.push(Block { system: part, states, irreducible: false }),
            Split::Parts(sub, quotient) => {
                open.extend(components(&sub, &states));
                open.extend(components(&quotient, &states));
            }
        }
    }
    done
}

/// The strongly connected parts of the graph on (state, coordinate) pairs that contain a cycle.
fn components(system: &System, states: &[usize]) -> Vec<(System, Vec<usize>)> {
    let offsets: Vec<usize> = system.dims.iter().scan(0, |sum, d| { let o = *sum; *sum += d; Some(o) }).collect();
    let count: usize = system.dims.iter().sum();
    let mut reach = vec![vec![false; count]; count];
    for a in &system.arrows {
        for i in 0..a.matrix.rows() {
            for (j, x) in a.matrix.row(i).iter().enumerate() {
                reach[offsets[a.from] + i][offsets[a.to] + j] |= *x != 0;
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
    let mut parts = Vec::new();
    for top in 0..count {
        let mutual = |i: usize| reach[top][i] && reach[i][top];
        if mutual(top) && (0..top).all(|i| !mutual(i)) {
            let kept: Vec<Vec<usize>> =
                (0..system.dims.len()).map(|s| (0..system.dims[s]).filter(|i| mutual(offsets[s] + i)).collect()).collect();
            parts.push(restrict(system, states, &kept));
        }
    }
    parts
}

/// The principal part on some coordinates of every state; states without coordinates and zero arrows are dropped.
fn restrict(system: &System, states: &[usize], kept: &[Vec<usize>]) -> (System, Vec<usize>) {
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
    let dims = alive.iter().map(|s| kept[*s].len()).collect();
    (System { dims, arrows }, alive.iter().map(|s| states[*s]).collect())
}

enum Split {
    Irreducible,
    Unknown,
    Parts(System, System),
}

/// Looks for a common invariant family of subspaces (Norton's criterion on random elements of the algebra of a state).
fn split(system: &System) -> Split {
    let home = (0..system.dims.len()).min_by_key(|s| system.dims[*s]).unwrap_or(0);
    let whole = Matrix::identity(system.dims[home]);
    // What one state generates, and what never returns to it.
    for (left, family) in [(false, spin(system, home, &whole, false)), (true, spin(system, home, &whole, true))] {
        if proper(system, &family) {
            return parts(system, &oriented(system, family, left));
        }
    }
    if system.dims[home] == 1 {
        return Split::Irreducible;
    }
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for trial in 0..12 {
        let Some(element) = random_element(system, home, &mut random, trial) else { return Split::Unknown };
        let spectrum = Spectrum::of(&element);
        let mut factors: Vec<_> = spectrum.factors.iter().collect();
        factors.sort_by_key(|f| (f.poly.degree(), f.multiplicity));
        for factor in factors.into_iter().take(3) {
            let value = super::leading::polynomial_at(factor.poly.coeffs(), &element);
            let kernel = value.kernel();
            if kernel.cols() == 0 {
                continue;
            }
            let seed = Matrix::from_rows(system.dims[home], vec![kernel.column(0)]);
            let family = spin(system, home, &seed, false);
            if proper(system, &family) {
                return parts(system, &family);
            }
            let cokernel = value.transpose().kernel();
            let seed = Matrix::from_rows(system.dims[home], vec![cokernel.column(0)]);
            let family = spin(system, home, &seed, true);
            if proper(system, &family) {
                return parts(system, &oriented(system, family, true));
            }
            if factor.poly.degree() == Some(kernel.cols()) {
                return Split::Irreducible;
            }
        }
    }
    Split::Unknown
}

/// A small generator of pseudo-random numbers, so that runs agree.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from((self.0 >> 33) % n.max(1) as u64).unwrap_or(0)
    }
}

/// A small combination of products over cycles at a state.
fn random_element(system: &System, home: usize, random: &mut Random, trial: usize) -> Option<Matrix> {
    let dim = system.dims[home];
    let mut sum = Matrix::zero(dim, dim);
    for _ in 0..(2 + trial % 3) {
        let cycle = random_cycle(system, home, random)?;
        let factor = [1, -1, 2, 3, -2][random.below(5)];
        sum = &sum + &system.product(&cycle).scale(&Rational::from(factor));
    }
    Some(sum)
}

fn random_cycle(system: &System, home: usize, random: &mut Random) -> Option<Vec<usize>> {
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

/// The smallest invariant family that contains the rows of `seed` at a state; with `dual`, of the transposed system.
fn spin(system: &System, state: usize, seed: &Matrix, dual: bool) -> Vec<Matrix> {
    let mut family: Vec<Matrix> = system.dims.iter().map(|d| Matrix::zero(0, *d)).collect();
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

fn proper(system: &System, family: &[Matrix]) -> bool {
    family.iter().any(|f| f.rows() > 0) && family.iter().zip(&system.dims).any(|(f, d)| f.rows() < *d)
}

/// The invariant family itself, or the annihilator of one of the transposed system.
fn oriented(system: &System, family: Vec<Matrix>, left: bool) -> Vec<Matrix> {
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
fn parts(system: &System, family: &[Matrix]) -> Split {
    // A basis of every state whose first vectors span the family: columns; and its inverse.
    let frames: Option<Vec<(usize, Matrix, Matrix)>> = family
        .iter()
        .zip(&system.dims)
        .map(|(f, &dim)| {
            let pivots = f.echelon().pivots;
            let rest = (0..dim).filter(|i| !pivots.contains(i));
            let mut columns: Vec<Vec<Rational>> = (0..f.rows()).map(|i| f.row(i).to_vec()).collect();
            columns.extend(rest.map(|i| (0..dim).map(|k| Rational::from(u8::from(k == i))).collect()));
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
            let matrix = Matrix::from_fn(rows.len(), cols.len(), |i, j| whole[(rows.start + i, cols.start + j)].clone());
            Arrow { matrix, ..a.clone() }
        });
        System { arrows: arrows.collect(), dims: (0..system.dims.len()).map(|s| range(s).len()).collect() }
    };
    Split::Parts(block(true), block(false))
}
