use super::matrix::Matrix;
use super::strong::strong_components;
use crate::arith::modular::{PrimeField, large_primes};
use crate::arith::{Integer, Natural, Rational};
use crate::poly::ints::{self, CrtPoly};
use crate::poly::{IntPoly, Poly, modp};
use malachite_base::num::arithmetic::traits::{AddMulAssign, CeilingSqrt, Lcm, Pow};
use malachite_base::num::logic::traits::SignificantBits;

/// The characteristic polynomial `det(x - A)`, monic. For `n = 0` it is 1.
///
/// # Panics
/// If the matrix is not square.
///
/// # Cost
/// The matrix is split into its strongly connected components first. For one component of size `n` the integer
/// polynomial `det(x D - N)`, with `A = D^-1 N` or `N D^-1` and `D` diagonal, or `det(x - d A)` with one denominator
/// `d`, is computed modulo primes of 62 bits, `O(n^3)` each, as many as a bound for its coefficients needs (Hadamard's
/// inequality; Schur's for the eigenvalues of `d A`); the primes are shared among the threads.
///
/// Source: Cohen, *A Course in Computational Algebraic Number Theory*, algorithm 2.2.9, for the Hessenberg method.
///
/// # Examples
/// ```
/// use secant_exact::{arith::ratio, linalg::{Matrix, char_poly}};
/// let a = Matrix::from_fn(2, 2, |i, j| ratio([[1, 1], [1, 0]][i][j], 1));
/// assert_eq!(char_poly(&a).display("x"), "x^2 - x - 1");
/// ```
#[must_use]
pub fn char_poly(a: &Matrix) -> Poly {
    let product = char_poly_blocks(a).iter().fold(vec![Integer::from(1)], |acc, f| ints::mul(&acc, f));
    Poly::from_ints(&product).monic()
}

/// The characteristic polynomials of the strongly connected components, as primitive integer polynomials.
pub(crate) fn char_poly_blocks(a: &Matrix) -> Vec<IntPoly> {
    assert_eq!(a.rows(), a.cols(), "square matrix");
    strong_components(a).iter().map(|block| component(&Cleared::best(a, block))).collect()
}

/// `x D - N` for one component: `D` the row denominators, `N` the cleared rows.
struct Cleared {
    denominators: Vec<Natural>,
    entries: Vec<Vec<Integer>>,
    /// Bits that every coefficient of the determinant fits, without its sign.
    bound: u64,
    /// The determinant at `scale x` is the one looked for.
    scale: Natural,
}

impl Cleared {
    /// Clears by rows, by columns or by one denominator, whichever has the smallest bound.
    fn best(a: &Matrix, block: &[usize]) -> Self {
        let rows = Self::by_lines(block.len(), |i, j| &a[(block[i], block[j])]);
        if rows.bound <= 60 {
            return rows;
        }
        let columns = Self::by_lines(block.len(), |i, j| &a[(block[j], block[i])]);
        let lines = if rows.bound <= columns.bound { rows } else { columns };
        Self::by_one(&lines, |i, j| &a[(block[i], block[j])]).unwrap_or(lines)
    }

    /// Clears by one denominator, where that beats the bound of the others.
    fn by_one<'a>(others: &Self, entry: impl Fn(usize, usize) -> &'a Rational) -> Option<Self> {
        let n = others.entries.len();
        // A 1 x 1 block has no bound to beat, and its polynomial is read off its lines.
        if n < 2 {
            return None;
        }
        let scale = others.denominators.iter().fold(Natural::from(1u32), |acc, d| acc.lcm(d));
        // A long common denominator cannot pay; its powers would be long numbers for nothing.
        if scale.significant_bits() * n as u64 / 8 > others.bound {
            return None;
        }
        let row = |i: usize| (0..n).map(|j| ints::cleared(entry(i, j), &scale)).collect();
        let entries: Vec<Vec<Integer>> = (0..n).map(row).collect();
        let bound = spectral_bound(&entries);
        (bound < others.bound).then(|| Self { denominators: vec![Natural::from(1u32); n], entries, bound, scale })
    }

    fn by_lines<'a>(n: usize, entry: impl Fn(usize, usize) -> &'a Rational) -> Self {
        let mut denominators = Vec::with_capacity(n);
        let mut entries = Vec::with_capacity(n);
        let mut bound = 2;
        let mut product = Natural::from(1u32);
        for i in 0..n {
            let d = ints::common_denominator((0..n).map(|j| entry(i, j)));
            let row: Vec<Integer> = (0..n).map(|j| ints::cleared(entry(i, j), &d)).collect();
            // On the unit circle a row of x D - N is at most this long, and the coefficients are at most the maximum.
            let mut square = Natural::from(0u32);
            for (j, x) in row.iter().enumerate() {
                let size = if i == j { x.unsigned_abs_ref() + &d } else { x.unsigned_abs_ref().clone() };
                square += &size * &size;
            }
            product *= square;
            if product.significant_bits() > 4096 {
                bound += product.significant_bits();
                product = Natural::from(1u32);
            }
            denominators.push(d);
            entries.push(row);
        }
        bound += product.significant_bits();
        Self { denominators, entries, bound: bound / 2 + 1, scale: Natural::from(1u32) }
    }

    /// The coefficients of `det(x D - N)` modulo a prime; `None` when the prime divides a denominator.
    fn modulo(&self, field: &PrimeField) -> Option<Vec<u64>> {
        let mut determinant = field.one();
        let mut m = Vec::with_capacity(self.entries.len());
        for (row, d) in self.entries.iter().zip(&self.denominators) {
            let d = field.from_natural(d);
            if d == 0 {
                return None;
            }
            determinant = field.mul(determinant, d);
            let inverse = if d == field.one() { d } else { field.inverse(d) };
            m.push(row.iter().map(|x| if *x == 0 { 0 } else { field.mul(field.from_integer(x), inverse) }).collect());
        }
        let krylov = if m.len() < KRYLOV { None } else { krylov_char_poly(field, &m) };
        let monic = krylov.unwrap_or_else(|| hessenberg_char_poly(field, m));
        Some(monic.into_iter().map(|c| field.mul(c, determinant)).collect())
    }
}

/// Bits that every coefficient of `det(x - N)` fits.
///
/// By Schur's inequality the squares of the moduli of the `n` eigenvalues add up to at most `F^2`, the sum of the squares
/// of the entries, and by Maclaurin's inequality the `k`-th elementary symmetric function of the moduli is at most
/// `C(n, k) (F^2 / n)^(k/2)`, all of them together at most `(1 + F / sqrt n)^n`. Where all columns have the sum `s`, the
/// vectors of sum 0 are mapped among themselves, the other eigenvalue is `s`, and `F^2` there is that of `N (1 - J/n)`
/// (`J` all ones), which is the sum of the squares less the squares of the row sums over `n`. Rows likewise.
fn spectral_bound(entries: &[Vec<Integer>]) -> u64 {
    let n = entries.len();
    let zero = || vec![Integer::from(0); n];
    let (mut rows, mut columns, mut square) = (zero(), zero(), Integer::from(0));
    for (i, row) in entries.iter().enumerate() {
        for (j, x) in row.iter().enumerate().filter(|(_, x)| **x != 0) {
            rows[i] += x;
            columns[j] += x;
            square.add_mul_assign(x, x);
        }
    }
    let constant = |sums: &[Integer]| sums.iter().all(|s| *s == sums[0]);
    let (known, others) = if constant(&columns) {
        (Some(&columns[0]), &rows)
    } else if constant(&rows) {
        (Some(&rows[0]), &columns)
    } else {
        (None, &rows)
    };
    let Some(known) = known else { return power_bits(&square, n) };
    let sums: Integer = others.iter().map(|s| s * s).sum();
    // n F^2 is an integer; the bits of a fraction below one are not worth keeping.
    let rest = (square * Integer::from(n) - sums) / Integer::from(n) + Integer::from(1);
    power_bits(&rest, n - 1) + known.significant_bits() + 1
}

/// Bits of `(1 + sqrt(square / n))^n`, rounded up.
fn power_bits(square: &Integer, n: usize) -> u64 {
    const FRACTION: u64 = 10;
    let scaled = (square.unsigned_abs_ref() << (2 * FRACTION)) / Natural::from(n) + Natural::from(1u32);
    let base = scaled.ceiling_sqrt() + (Natural::from(1u32) << FRACTION);
    (base.pow(n as u64) >> (FRACTION * n as u64)).significant_bits() + 1
}

fn component(cleared: &Cleared) -> IntPoly {
    let n = cleared.entries.len();
    if n == 1 {
        return ints::primitive(vec![-&cleared.entries[0][0], Integer::from(&cleared.denominators[0])]);
    }
    let mut image = CrtPoly::default();
    let mut primes = large_primes();
    // The signed coefficient must be below half the modulus.
    while image.modulus == 0 || image.modulus.significant_bits() < cleared.bound + 2 {
        crate::stop::check();
        let missing = (cleared.bound + 2).saturating_sub(image.modulus.significant_bits());
        let batch: Vec<u64> = primes.by_ref().take(missing.div_ceil(61).max(1) as usize).collect();
        let compute = |p: &u64| {
            let field = PrimeField::new(*p);
            cleared.modulo(&field).map(|r| (field, r))
        };
        let images = crate::parallel::map(&batch, batch.len() > 1 && n >= 24, compute);
        for (field, residues) in images.into_iter().flatten() {
            image.absorb(&field, &residues);
        }
    }
    let mut power = Natural::from(1u32);
    for c in image.coeffs.iter_mut().filter(|_| cleared.scale != 1) {
        *c *= Integer::from(&power);
        power *= &cleared.scale;
    }
    ints::primitive(image.coeffs)
}

/// From this size on the Krylov method is tried first: all its inner loops are sums of products.
const KRYLOV: usize = 16;

/// The characteristic polynomial over a prime field from the Krylov vectors `v, M v, ..., M^n v` of one fixed vector:
/// where the first `n` are independent, it is the relation among all of them. `None` where that elimination, which
/// does not pivot, meets a zero.
fn krylov_char_poly(field: &PrimeField, m: &[Vec<u64>]) -> Option<Vec<u64>> {
    let n = m.len();
    let mut seed = 1;
    let mut v: Vec<u64> = (0..n).map(|_| field.from_u64(modp::next_random(&mut seed))).collect();
    let mut lower: Vec<Vec<u64>> = Vec::with_capacity(n);
    let mut upper: Vec<Vec<u64>> = vec![Vec::with_capacity(n); n];
    let mut inverses = Vec::with_capacity(n);
    for j in 0..n {
        // Row j of L U is the j-th vector; the columns of U are stored as lists.
        let mut row = Vec::with_capacity(j);
        for i in 0..j {
            let rest = field.sub(v[i], field.dot(&row, &upper[i][..i]));
            row.push(field.mul(rest, inverses[i]));
        }
        for (column, x) in upper[j..].iter_mut().zip(&v[j..]) {
            let product = field.dot(&row, column);
            column.push(field.sub(*x, product));
        }
        let pivot = upper[j][j];
        if pivot == 0 {
            return None;
        }
        inverses.push(field.inverse(pivot));
        lower.push(row);
        v = m.iter().map(|row| field.dot(row, &v)).collect();
    }
    let mut c: Vec<u64> = Vec::with_capacity(n + 1);
    for i in 0..n {
        let rest = field.sub(v[i], field.dot(&upper[i][..i], &c));
        c.push(field.mul(rest, inverses[i]));
    }
    for k in (0..n).rev() {
        let factor = c[k];
        for (x, l) in c.iter_mut().zip(&lower[k]) {
            *x = field.sub(*x, field.mul(*l, factor));
        }
    }
    c.iter_mut().for_each(|x| *x = field.neg(*x));
    c.push(field.one());
    Some(c)
}

/// The characteristic polynomial over a prime field, monic, through a similar Hessenberg matrix.
fn hessenberg_char_poly(field: &PrimeField, mut m: Vec<Vec<u64>>) -> Vec<u64> {
    let n = m.len();
    for k in 1..n.saturating_sub(1) {
        let Some(pivot) = (k..n).find(|&i| m[i][k - 1] != 0) else { continue };
        if pivot != k {
            m.swap(pivot, k);
            for row in &mut m {
                row.swap(pivot, k);
            }
        }
        let inverse = field.inverse(m[k][k - 1]);
        let pivot_row = m[k].clone();
        let mut factors = vec![0; n];
        for i in k + 1..n {
            if m[i][k - 1] == 0 {
                continue;
            }
            let factor = field.mul(m[i][k - 1], inverse);
            factors[i] = factor;
            for (x, y) in m[i][k - 1..].iter_mut().zip(&pivot_row[k - 1..]) {
                *x = field.sub(*x, field.mul(factor, *y));
            }
        }
        for row in &mut m {
            row[k] = field.add(row[k], field.dot(&row[k + 1..], &factors[k + 1..]));
        }
    }
    let mut polys: Vec<Vec<u64>> = vec![vec![field.one()]];
    for k in 0..n {
        let mut next = vec![0; k + 2];
        next[1..].copy_from_slice(&polys[k]);
        let mut weight = field.one();
        for i in (0..=k).rev() {
            let c = field.mul(m[i][k], weight);
            if c != 0 {
                for (x, y) in next.iter_mut().zip(&polys[i]) {
                    *x = field.sub(*x, field.mul(c, *y));
                }
            }
            if i > 0 {
                weight = field.mul(weight, m[i][i - 1]);
                if weight == 0 {
                    break;
                }
            }
        }
        polys.push(next);
    }
    polys.pop().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn evaluate(f: &Poly, a: &Matrix) -> Matrix {
        let n = a.rows();
        f.coeffs().iter().rev().fold(Matrix::zero(n, n), |acc, c| &(&acc * a) + &Matrix::identity(n).scale(c))
    }

    #[test]
    fn cayley_hamilton() {
        let mut seed = 3;
        for n in 0..9 {
            let a = Matrix::from_fn(n, n, |_, _| {
                let r = crate::poly::modp::next_random(&mut seed);
                if r.is_multiple_of(3) {
                    ratio(0, 1)
                } else {
                    ratio((r >> 20) as i64 % 50 - 25, 1 + (r >> 40) as i64 % 30)
                }
            });
            let f = char_poly(&a);
            assert_eq!(f.degree(), Some(n));
            assert!(evaluate(&f, &a).is_zero());
            if n > 0 {
                let trace: Rational = (0..n).map(|i| a[(i, i)].clone()).sum();
                assert_eq!(f.coeff(n - 1), -trace);
            }
        }
    }

    #[test]
    fn products_commute_in_the_characteristic_polynomial() {
        let a = Matrix::from_fn(2, 4, |i, j| ratio((3 * i + j * j) as i64 - 4, 1 + i as i64));
        let b = Matrix::from_fn(4, 2, |i, j| ratio((i * j) as i64 - 2, 1 + j as i64));
        let (f, g) = (char_poly(&(&a * &b)), char_poly(&(&b * &a)));
        assert_eq!(&f * &Poly::new(vec![0.into(), 0.into(), 1.into()]), g);
    }

    #[test]
    fn the_two_methods_agree() {
        let field = PrimeField::new((1 << 62) - 57);
        let mut seed = 9;
        for n in [1, 2, 7, 23, 40] {
            let random: Vec<Vec<u64>> = (0..n)
                .map(|_| (0..n).map(|_| field.from_u64(crate::poly::modp::next_random(&mut seed))).collect())
                .collect();
            assert_eq!(krylov_char_poly(&field, &random), Some(hessenberg_char_poly(&field, random.clone())));
        }
        let derogatory = vec![vec![field.one(), 0], vec![0, field.one()]];
        assert_eq!(krylov_char_poly(&field, &derogatory), None);
    }

    #[test]
    #[allow(clippy::needless_range_loop)] // The last row is written from the others.
    fn the_bounds_hold() {
        let mut seed = 11;
        for n in [2usize, 3, 8, 30] {
            for kind in 0..3 {
                let mut entries: Vec<Vec<Integer>> = (0..n)
                    .map(|_| {
                        (0..n).map(|_| Integer::from(modp::next_random(&mut seed) % 9) - Integer::from(kind)).collect()
                    })
                    .collect();
                if kind == 2 {
                    for j in 0..n {
                        let sum: Integer = (0..n - 1).map(|i| entries[i][j].clone()).sum();
                        entries[n - 1][j] = Integer::from(7) - sum;
                    }
                }
                let a = Matrix::from_fn(n, n, |i, j| Rational::from(&entries[i][j]));
                assert!(ints::height_bits(&char_poly(&a).primitive()) <= spectral_bound(&entries), "{n} {kind}");
                let transposed: Vec<Vec<Integer>> =
                    (0..n).map(|i| (0..n).map(|j| entries[j][i].clone()).collect()).collect();
                assert_eq!(spectral_bound(&entries), spectral_bound(&transposed));
            }
        }
    }

    #[test]
    fn a_single_entry_keeps_its_denominator() {
        let long = Rational::from_integers(Integer::from(7), Integer::from(10).pow(400) + Integer::from(1));
        let p = char_poly(&Matrix::from_fn(1, 1, |_, _| long.clone()));
        assert_eq!(p.eval(&long), 0);
    }

    #[test]
    fn one_denominator_gives_the_same_polynomial() {
        let mut seed = 4;
        let entry = |seed: &mut u64| ratio((modp::next_random(seed) % 7) as i64, 320);
        let a = Matrix::from_fn(30, 30, |_, _| entry(&mut seed));
        let block: Vec<usize> = (0..30).collect();
        let one = Cleared::best(&a, &block);
        assert_ne!(one.scale, 1);
        let rows = Cleared::by_lines(30, |i, j| &a[(i, j)]);
        assert_eq!(component(&one), component(&rows));
    }

    #[test]
    fn large_entries_need_several_primes() {
        let big = Rational::from(Integer::from(3)) << 200i64;
        let a = Matrix::from_fn(2, 2, |i, j| if i == j { big.clone() } else { ratio(1, 7) });
        let f = char_poly(&a);
        assert_eq!(f.coeff(0), &big * &big - ratio(1, 49));
        assert_eq!(f.coeff(1), -(&big * ratio(2, 1)));
    }
}
