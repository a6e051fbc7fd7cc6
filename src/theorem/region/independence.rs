//! Where the translates of the limit of a mask with a parameter are independent on a unit interval.

use crate::arith::{Rational, ratio};
use crate::linalg::{Matrix, char_poly};
use crate::poly::Poly;
use crate::radius::family::{Pencil, interpolated};
use crate::ring::Rationals;

/// Polynomials in the parameter one of which does not vanish where the values `T_u x − x` span all vectors of sum 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Independence {
    /// Words `u`, and the column of the adjugate of `1 − T_0` that `x` is: the determinant of `x` and the differences is one of the
    /// polynomials.
    pub choices: Vec<(usize, Vec<Vec<usize>>)>,
    /// The common divisor.
    pub guard: Poly,
}

/// Members at which words are chosen.
const CHOICES: [(i64, i64); 4] = [(37, 101), (-53, 211), (2, 3), (1, 29)];

impl Independence {
    /// `None` where the translates are dependent for every value, as far as this shows.
    pub(super) fn of(pencil: &Pencil) -> Option<Self> {
        let mut found: Option<Self> = None;
        for (k, (p, q)) in CHOICES.into_iter().enumerate() {
            let Some(choice) = chosen(&pencil.at(&ratio(p, q)), k) else { continue };
            let own = determinant(pencil, &choice);
            let (mut choices, guard) = found.take().map_or((Vec::new(), Poly::zero()), |f| (f.choices, f.guard));
            let common = guard.gcd(&own);
            if guard.is_zero() || common.degree() < guard.degree() {
                choices.push(choice);
            }
            found = Some(Self { choices, guard: common });
        }
        found.filter(|f| !f.guard.is_zero())
    }
}

/// A vector that a matrix fixes, as it has the eigenvalue 1: a column of the adjugate of `1 − T`.
fn fixed(m: &Matrix, column: usize) -> Vec<Rational> {
    m.adjugate_column_over(&Rationals, char_poly(m).coeffs(), column, &Rational::from(1))
}

/// `T_u x − x`.
fn moved(matrices: &[Matrix], word: &[usize], x: &[Rational]) -> Vec<Rational> {
    let image = word.iter().rev().fold(x.to_vec(), |v, &letter| matrices[letter].apply(&v));
    crate::shape::difference(&image, x)
}

/// A column and words whose differences span at a member; other numbers prefer other columns and letters.
fn chosen(matrices: &[Matrix], number: usize) -> Option<(usize, Vec<Vec<usize>>)> {
    let n = matrices[0].rows();
    let sum = |v: &[Rational]| v.iter().fold(Rational::from(0), |s, c| s + c);
    let order = (0..n).map(|k| (k + number * n / 2) % n);
    let column = order.into_iter().find(|&c| sum(&fixed(&matrices[0], c)) != 0)?;
    let x = fixed(&matrices[0], column);
    let mut queue = std::collections::VecDeque::from([Vec::new()]);
    let (mut words, mut rows): (Vec<Vec<usize>>, Matrix) = (Vec::new(), Matrix::zero(0, n));
    while words.len() + 1 < n {
        let word: Vec<usize> = queue.pop_front()?;
        if !word.is_empty() {
            let joined = rows.stack(&Matrix::from_rows(n, vec![moved(matrices, &word, &x)]));
            if joined.rank() == rows.rows() {
                continue;
            }
            rows = joined;
            words.push(word.clone());
        }
        let letters = matrices.len();
        queue.extend((0..letters).map(|l| [&[(l + number) % letters], word.as_slice()].concat()));
    }
    Some((column, words))
}

/// The determinant of `x` and the differences as a polynomial.
fn determinant(pencil: &Pencil, (column, words): &(usize, Vec<Vec<usize>>)) -> Poly {
    let n = pencil.dim();
    let letters = words.iter().fold(0, |s, w| s + w.len());
    // Every column has the degree of x, a column of an adjugate; a letter adds that of an entry.
    let most = pencil.degree() * (n * (n - 1) + letters);
    let value = |p: &Rational| {
        let here = pencil.at(p);
        let x = fixed(&here[0], *column);
        let mut columns = vec![x.clone()];
        columns.extend(words.iter().map(|w| moved(&here, w, &x)));
        [Matrix::from_columns(n, &columns).determinant()]
    };
    let [found] = interpolated(most, value);
    found
}
