//! Row echelon forms over a prime field, and the kernels of the powers of a matrix from one of them.

use crate::arith::modular::PrimeField;

/// The nonzero rows of an echelon form, with leading ones, and their columns.
pub(crate) struct ModEchelon {
    rows: Vec<Vec<u64>>,
    pub pivots: Vec<usize>,
    width: usize,
    /// What was done to the rows, so that it can be done to a right-hand side.
    steps: Vec<Step>,
    /// The rows of the matrix that became 0.
    rest: Vec<usize>,
}

/// One step of an elimination: row `row` times `inverse`, then added to the others with factors.
struct Step {
    row: usize,
    inverse: u64,
    factors: Vec<(usize, u64)>,
}

/// The kernel of a square matrix or of a power of one: for each free column the vector with a 1 there, 0 at the other free
/// columns, and 0 behind it.
pub(crate) struct ModKernel {
    pub pivots: Vec<usize>,
    free: Vec<usize>,
    vectors: Vec<Vec<u64>>,
}

impl ModEchelon {
    pub fn new(field: &PrimeField, m: Vec<Vec<u64>>) -> Self {
        let width = m.first().map_or(0, Vec::len);
        let mut m: Vec<(usize, Vec<u64>)> = m.into_iter().enumerate().collect();
        let mut rows: Vec<Vec<u64>> = Vec::new();
        let mut pivots = Vec::new();
        let mut steps = Vec::new();
        for col in 0..width {
            let Some(found) = m.iter().position(|(_, row)| row[col] != 0) else { continue };
            let (own, mut top) = m.swap_remove(found);
            let inverse = field.inverse(top[col]);
            top[col..].iter_mut().for_each(|x| *x = field.mul(*x, inverse));
            let mut factors = Vec::new();
            for (other, row) in m.iter_mut().filter(|(_, row)| row[col] != 0) {
                let factor = field.neg(row[col]);
                factors.push((*other, factor));
                for (x, y) in row[col..].iter_mut().zip(&top[col..]) {
                    *x = field.add(*x, field.mul(factor, *y));
                }
            }
            steps.push(Step { row: own, inverse, factors });
            rows.push(top);
            pivots.push(col);
            if m.is_empty() {
                break;
            }
        }
        Self { rows, pivots, width, steps, rest: m.into_iter().map(|(k, _)| k).collect() }
    }

    /// The kernel of the matrix.
    pub fn kernel(&self, field: &PrimeField) -> ModKernel {
        let free: Vec<usize> = self.free_columns().collect();
        let vectors = free.iter().map(|f| self.kernel_vector(field, *f)).collect();
        ModKernel { pivots: self.pivots.clone(), free, vectors }
    }

    /// The vectors that the matrix, a square one, maps into a kernel of one of its powers: the kernel of the next power.
    pub fn next_kernel(&self, field: &PrimeField, known: &ModKernel) -> ModKernel {
        let mut sides = known.vectors.clone();
        sides.iter_mut().for_each(|b| self.reduce(field, b));
        // Combinations of the right-hand sides that the matrix attains.
        let conditions: Vec<Vec<u64>> = self.rest.iter().map(|i| sides.iter().map(|b| b[*i]).collect()).collect();
        let attained = Self::new(field, conditions).kernel(field).vectors;
        let mut vectors = self.kernel(field).vectors;
        for c in attained {
            let mut side = vec![0; self.width];
            for (factor, b) in c.iter().zip(&sides).filter(|(factor, _)| **factor != 0) {
                side.iter_mut().zip(b).for_each(|(x, y)| *x = field.add(*x, field.mul(*factor, *y)));
            }
            vectors.push(self.back(field, &side));
        }
        ModKernel::spanned(field, self.width, vectors)
    }

    /// Does to a right-hand side what was done to the rows.
    fn reduce(&self, field: &PrimeField, b: &mut [u64]) {
        for Step { row, inverse, factors } in &self.steps {
            let value = field.mul(b[*row], *inverse);
            b[*row] = value;
            if value != 0 {
                factors.iter().for_each(|(i, f)| b[*i] = field.add(b[*i], field.mul(*f, value)));
            }
        }
    }

    /// The solution for a reduced right-hand side whose free unknowns are 0.
    fn back(&self, field: &PrimeField, b: &[u64]) -> Vec<u64> {
        let mut x = vec![0; self.width];
        for ((row, &pivot), step) in self.rows.iter().zip(&self.pivots).zip(&self.steps).rev() {
            x[pivot] = field.sub(b[step.row], field.dot(&row[pivot + 1..], &x[pivot + 1..]));
        }
        x
    }

    pub fn free_columns(&self) -> impl Iterator<Item = usize> {
        let mut pivots = self.pivots.iter().peekable();
        (0..self.width).filter(move |c| pivots.next_if(|p| *p == c).is_none())
    }

    /// The vector of the kernel with a 1 at one free column and 0 at the others.
    pub fn kernel_vector(&self, field: &PrimeField, free: usize) -> Vec<u64> {
        let mut v = vec![0; self.width];
        v[free] = field.one();
        for (row, &pivot) in self.rows.iter().zip(&self.pivots).rev() {
            if pivot < free {
                v[pivot] = field.neg(field.dot(&row[pivot + 1..=free], &v[pivot + 1..=free]));
            }
        }
        v
    }
}

impl ModKernel {
    /// The space that vectors span.
    fn spanned(field: &PrimeField, width: usize, mut open: Vec<Vec<u64>>) -> Self {
        let (mut free, mut vectors): (Vec<usize>, Vec<Vec<u64>>) = (Vec::new(), Vec::new());
        for col in (0..width).rev() {
            let Some(found) = open.iter().position(|v| v[col] != 0) else { continue };
            let mut own = open.swap_remove(found);
            let inverse = field.inverse(own[col]);
            own.iter_mut().for_each(|x| *x = field.mul(*x, inverse));
            for v in open.iter_mut().chain(&mut vectors).filter(|v| v[col] != 0) {
                let factor = field.neg(v[col]);
                v.iter_mut().zip(&own).for_each(|(x, y)| *x = field.add(*x, field.mul(factor, *y)));
            }
            free.push(col);
            vectors.push(own);
        }
        free.reverse();
        vectors.reverse();
        let pivots = (0..width).filter(|c| free.binary_search(c).is_err()).collect();
        Self { pivots, free, vectors }
    }

    pub fn nullity(&self) -> usize {
        self.free.len()
    }

    pub fn free_columns(&self) -> impl Iterator<Item = usize> {
        self.free.iter().copied()
    }

    /// The vector with a 1 at a free column.
    pub fn vector(&self, free: usize) -> &[u64] {
        &self.vectors[self.free.binary_search(&free).expect("a free column")]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::poly::modp::next_random;

    #[test]
    fn kernels_of_powers_without_powers() {
        let field = PrimeField::new((1 << 62) - 57);
        let mut seed = 8;
        // Nilpotent blocks 4, 2, 2, 1 and an invertible part, in mixed coordinates.
        let n = 13;
        let chain = [1, 2, 3, 5, 7];
        let mut m = vec![vec![0; n]; n];
        chain.iter().for_each(|k| m[*k - 1][*k] = field.one());
        (9..n).for_each(|k| m[k][k] = field.from_u64(k as u64));
        let add = |x: &mut u64, f: u64, y: u64| *x = field.add(*x, field.mul(f, y));
        for _ in 0..60 {
            // A shear and its inverse.
            let mut index = || (next_random(&mut seed) % n as u64) as usize;
            let (i, j) = (index(), index());
            if i != j {
                let f = field.from_u64(next_random(&mut seed) % 5);
                let from = m[j].clone();
                for (entry, y) in m[i].iter_mut().zip(from) {
                    add(entry, f, y);
                }
                for row in &mut m {
                    let y = row[i];
                    add(&mut row[j], field.neg(f), y);
                }
            }
        }
        let times = |a: &[Vec<u64>]| -> Vec<Vec<u64>> {
            let column = |j: usize| m.iter().map(|row| row[j]).collect::<Vec<u64>>();
            a.iter().map(|row| (0..n).map(|j| field.dot(row, &column(j))).collect()).collect()
        };
        let echelon = ModEchelon::new(&field, m.clone());
        let (mut kernel, mut power) = (echelon.kernel(&field), m.clone());
        for nullity in [4, 7, 8, 9, 9] {
            let plain = ModEchelon::new(&field, power.clone());
            assert_eq!((kernel.nullity(), &kernel.pivots), (nullity, &plain.pivots));
            for free in plain.free_columns() {
                assert_eq!(kernel.vector(free), plain.kernel_vector(&field, free));
            }
            kernel = echelon.next_kernel(&field, &kernel);
            power = times(&power);
        }
    }
}
