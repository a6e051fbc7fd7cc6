//! Rational vectors that generate the cyclic summands of a primary component: proposed modulo primes, then exact.

use super::echelon::ModSpan;
use super::operator::{ModOperator, Operator, make_primitive};
use crate::arith::Integer;
use crate::arith::modular::{PrimeField, large_primes};
use crate::linalg::echelon::{ModEchelon, ModKernel};
use crate::linalg::lifting::Lifting;
use crate::linalg::reconstruct::Residues;
use crate::poly::{IntPoly, Poly, ints};

/// An integer vector with `F(N)^size u = 0`; it generates a cyclic module `Q[x] / (F^size)`, that is one Jordan block
/// of that size for every root of `F`.
#[derive(Debug, Clone)]
pub(super) struct Generator {
    pub vector: Vec<Integer>,
    pub size: usize,
}

/// A scaled irreducible factor (see [`Operator::scaled`]) and its exponent in the characteristic polynomial.
pub(super) struct Part {
    pub monic: Poly,
    pub poly: IntPoly,
    pub multiplicity: usize,
}

impl Part {
    fn degree(&self) -> usize {
        self.poly.len() - 1
    }
}

/// Generators of the component of part `which`, sizes descending.
///
/// What makes the result certain: `F(N)^size u = 0` holds exactly, the vectors `F(N)^(size-1) u` are independent over
/// `Q[x] / (F)` because they are so modulo a prime, and the sizes add up to the multiplicity.
pub(super) fn generators(operator: &Operator, parts: &[Part], which: usize) -> Vec<Generator> {
    let part = &parts[which];
    let rest: usize =
        parts.iter().map(|p| p.degree() * p.multiplicity).sum::<usize>() - part.degree() * part.multiplicity;
    if part.multiplicity == 1 && rest < part.degree() {
        return vec![projected(operator, parts, which)];
    }
    large_primes().find_map(|p| from_prime(operator, part, p)).expect("only finitely many primes are unlucky")
}

/// For a large factor the other factors, applied to a unit vector, give the generator.
fn projected(operator: &Operator, parts: &[Part], which: usize) -> Generator {
    let n = operator.size();
    for unit in 0..n {
        let mut v: Vec<Integer> = (0..n).map(|i| Integer::from(u8::from(i == unit))).collect();
        for (_, part) in parts.iter().enumerate().filter(|(i, _)| *i != which) {
            for _ in 0..part.multiplicity {
                v = operator.apply_poly(&part.poly, &v);
                make_primitive(&mut v);
            }
        }
        // By Cayley and Hamilton F(N) v = 0, and v is not 0.
        if v.iter().any(|x| *x != 0) {
            return Generator { vector: v, size: 1 };
        }
    }
    unreachable!("the other factors do not annihilate the space")
}

/// A kernel vector to reconstruct: a free column of `F(N)^size`.
struct Pick {
    size: usize,
    column: usize,
}

fn residues(part: &Part, field: &PrimeField) -> Vec<u64> {
    part.poly.iter().map(|c| field.from_integer(c)).collect()
}

/// Finds the structure modulo `p` and reconstructs it; `None` when the prime was unlucky.
fn from_prime(operator: &Operator, part: &Part, p: u64) -> Option<Vec<Generator>> {
    let image = operator.modulo(&PrimeField::new(p));
    let poly = residues(part, &image.field);
    let levels = levels(&image, &poly, part)?;
    let picks = picks(&image, &poly, part, &levels)?;
    let mut found: Vec<Generator> = Vec::with_capacity(picks.len());
    for size in (1..=levels.len()).rev() {
        let columns: Vec<usize> = picks.iter().filter(|p| p.size == size).map(|p| p.column).collect();
        if !columns.is_empty() {
            let first = (&image.field, &levels[size - 1]);
            // Short vectors are known from one prime.
            let vectors = match verified(operator, part, size, &residues_of(&columns, first)) {
                Some(vectors) => vectors,
                None => match lifted(operator, part, size, &columns, first) {
                    Some(answer) => answer?,
                    None => reconstruct(operator, part, size, &columns, first)?,
                },
            };
            found.extend(vectors.into_iter().map(|vector| Generator { vector, size }));
        }
    }
    Some(found)
}

/// Kernels of the powers of `F(N)`, until one is the whole component.
fn levels(image: &ModOperator, poly: &[u64], part: &Part) -> Option<Vec<ModKernel>> {
    let goal = part.degree() * part.multiplicity;
    let echelon = ModEchelon::new(&image.field, image.poly(poly));
    let mut kernel = echelon.kernel(&image.field);
    let mut levels: Vec<ModKernel> = Vec::new();
    loop {
        let (nullity, before) = (kernel.nullity(), levels.last().map_or(0, ModKernel::nullity));
        if nullity > goal || nullity <= before || nullity % part.degree() != 0 {
            return None;
        }
        levels.push(kernel);
        if nullity == goal {
            return Some(levels);
        }
        if levels.len() >= part.multiplicity {
            return None;
        }
        kernel = echelon.next_kernel(&image.field, &levels[levels.len() - 1]);
    }
}

/// Chooses kernel vectors whose images in the socle are independent over the field.
fn picks(image: &ModOperator, poly: &[u64], part: &Part, levels: &[ModKernel]) -> Option<Vec<Pick>> {
    let degree = part.degree();
    let mut picks = Vec::new();
    if levels.len() == 1 && (degree == 1 || levels[0].nullity() == degree) {
        // Vectors of an echelon basis are independent, and one nonzero vector always is.
        let columns = levels[0].free_columns().take(levels[0].nullity() / degree);
        return Some(columns.map(|column| Pick { size: 1, column }).collect());
    }
    let mut span = ModSpan::default();
    for size in (1..=levels.len()).rev() {
        let below = if size == 1 { 0 } else { levels[size - 2].nullity() };
        let count = (levels[size - 1].nullity() - below) / degree;
        for column in levels[size - 1].free_columns() {
            if picks.len() == count {
                break;
            }
            let mut socle = levels[size - 1].vector(column).to_vec();
            for _ in 1..size {
                socle = image.apply_poly(poly, &socle);
            }
            if socle.iter().any(|x| *x != 0) && span.extend(image, socle, degree) {
                picks.push(Pick { size, column });
            }
        }
        if picks.len() != count {
            return None;
        }
    }
    Some(picks)
}

/// The exact kernel vectors of `F(N)^size` at the given free columns, by lifting; `None` where that cannot be done in words,
/// `Some(None)` where the prime was unlucky.
fn lifted(
    operator: &Operator,
    part: &Part,
    size: usize,
    columns: &[usize],
    (field, kernel): (&PrimeField, &ModKernel),
) -> Option<Option<Vec<Vec<Integer>>>> {
    let rows = operator.power_in_words(&part.poly, size)?;
    let Some(lifting) = Lifting::new(&rows, *field, &kernel.pivots) else { return Some(None) };
    let mut vectors: Vec<_> = columns.iter().map(|c| lifting.start(*c)).collect();
    let (p, mut power) = (Integer::from(field.modulus()), Integer::from(1));
    let mut next_try = 1;
    for count in 1..=lifting.enough() {
        vectors.iter_mut().for_each(|v| lifting.step(v, &power));
        power *= &p;
        if count >= next_try || count == lifting.enough() {
            let known: Vec<Residues> = vectors.iter().map(|v| lifting.residues(v, &power)).collect();
            if let Some(found) = verified(operator, part, size, &known) {
                return Some(Some(found));
            }
            next_try = count + count / 4 + 1;
        }
    }
    Some(None)
}

/// The most primes tried before the first one is suspected of being unlucky.
const MAX_PRIMES: usize = 100_000;

/// The exact kernel vectors of `F(N)^size` at the given free columns.
fn reconstruct(
    operator: &Operator,
    part: &Part,
    size: usize,
    columns: &[usize],
    first: (&PrimeField, &ModKernel),
) -> Option<Vec<Vec<Integer>>> {
    let (first_field, first_kernel) = first;
    let mut known = residues_of(columns, first);
    let (mut count, mut next_try) = (1, 1);
    let mut primes = large_primes().filter(|p| *p != first_field.modulus());
    loop {
        if count >= next_try {
            if let Some(vectors) = verified(operator, part, size, &known) {
                return Some(vectors);
            }
            next_try = count + count / 4 + 1;
        }
        if count > MAX_PRIMES {
            return None;
        }
        let field = PrimeField::new(primes.next()?);
        let kernel = kernel_of_power(operator, part, size, &field);
        if kernel.pivots.len() > first_kernel.pivots.len() {
            return None;
        }
        if kernel.pivots == first_kernel.pivots {
            absorb(&mut known, columns, (&field, &kernel));
            count += 1;
        } else if kernel.pivots < first_kernel.pivots {
            // Pivots can only move right modulo an unlucky prime, so the first one was.
            return None;
        }
    }
}

/// The kernel vectors at the given free columns, modulo one prime.
fn residues_of(columns: &[usize], kernel: (&PrimeField, &ModKernel)) -> Vec<Residues> {
    let mut known: Vec<Residues> = columns.iter().map(|_| Residues::default()).collect();
    absorb(&mut known, columns, kernel);
    known
}

fn absorb(known: &mut [Residues], columns: &[usize], (field, kernel): (&PrimeField, &ModKernel)) {
    for (residues, column) in known.iter_mut().zip(columns) {
        residues.absorb(field, kernel.vector(*column));
    }
}

fn kernel_of_power(operator: &Operator, part: &Part, size: usize, field: &PrimeField) -> ModKernel {
    let image = operator.modulo(field);
    let echelon = ModEchelon::new(field, image.poly(&residues(part, field)));
    (1..size).fold(echelon.kernel(field), |kernel, _| echelon.next_kernel(field, &kernel))
}

/// The reconstructed vectors, when all of them are in the kernel exactly.
fn verified(operator: &Operator, part: &Part, size: usize, known: &[Residues]) -> Option<Vec<Vec<Integer>>> {
    let mut vectors = Vec::with_capacity(known.len());
    for residues in known {
        let mut vector = residues.vector()?;
        make_primitive(&mut vector);
        let mut image = vector.clone();
        for _ in 0..size {
            image = operator.apply_poly(&part.poly, &image);
        }
        if image.iter().any(|x| *x != 0) {
            return None;
        }
        vectors.push(vector);
    }
    debug_assert!(vectors.iter().all(|v| ints::content(v) == 1));
    Some(vectors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;
    use crate::poly::factor;

    #[test]
    fn lifting_and_remainders_give_the_same_vectors() {
        // Blocks 3, 1 for 2; 2 for the golden ratio; 1 for 1/3 scaled by the operator.
        let blocks = [(0, 2), (1, 2), (2, 2), (3, 2)];
        let mut a = Matrix::zero(9, 9);
        for (i, x) in blocks {
            a[(i, i)] = ratio(x, 1);
        }
        a[(0, 1)] = ratio(1, 1);
        a[(1, 2)] = ratio(1, 1);
        for k in [4, 6] {
            (a[(k, k + 1)], a[(k + 1, k)], a[(k + 1, k + 1)]) = (ratio(1, 1), ratio(1, 1), ratio(1, 1));
        }
        (a[(4, 6)], a[(5, 7)], a[(8, 8)]) = (ratio(1, 1), ratio(1, 1), ratio(1, 3));
        let mut seed = 3;
        let mut p = Matrix::identity(9);
        for i in 0..9 {
            for j in 0..i {
                p[(i, j)] = ratio((crate::poly::modp::next_random(&mut seed) % 5) as i64 - 2, 1);
            }
        }
        let a = &(&p * &a) * &p.inverse().unwrap();
        let operator = Operator::new(&a);
        let mut compared = 0;
        for (f, multiplicity) in factor(&crate::linalg::char_poly(&a)) {
            let part = Part { poly: operator.scaled(&f), monic: f, multiplicity };
            let image = operator.modulo(&PrimeField::new(large_primes().next().unwrap()));
            let poly = residues(&part, &image.field);
            let levels = levels(&image, &poly, &part).unwrap();
            for (k, level) in levels.iter().enumerate() {
                let columns: Vec<usize> = level.free_columns().collect();
                let first = (&image.field, level);
                let one = lifted(&operator, &part, k + 1, &columns, first).expect("short").expect("lucky");
                assert_eq!(one, reconstruct(&operator, &part, k + 1, &columns, first).unwrap());
                compared += one.len();
            }
        }
        assert_eq!(compared, 1 + (2 + 3 + 4) + (2 + 4));
    }
}
