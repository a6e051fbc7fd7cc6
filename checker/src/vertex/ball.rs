//! Complex numbers known up to an error, and matrices of them: bounds of spectral radii, and eigenvectors near given ones.

use crate::base::{Checked, Q, need, reject, spend, whole};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Binary places.
const PLACES: usize = 256;
/// How often a matrix is squared at most.
const SQUARINGS: usize = 40;

/// All complex numbers within `error` of `x + iy`, in units of `2^-256`.
#[derive(Debug, Clone)]
pub struct Ball {
    x: BigInt,
    y: BigInt,
    error: BigInt,
}

impl Ball {
    /// A complex number with rational parts.
    pub fn new(x: &Q, y: &Q) -> Self {
        let units = |q: &Q| (q.numer() << PLACES) / q.denom();
        Self { x: units(x), y: units(y), error: BigInt::from(2) }
    }

    /// A rational number.
    pub fn real(x: &Q) -> Self {
        Self::new(x, &Q::zero())
    }

    /// The number 0.
    pub fn zero() -> Self {
        Self { x: BigInt::zero(), y: BigInt::zero(), error: BigInt::zero() }
    }

    /// The same with a larger error.
    pub fn widened(mut self, error: &Q) -> Self {
        self.error += ((error.numer() << PLACES) / error.denom()) + 1;
        self
    }

    /// The sum.
    pub fn plus(&self, other: &Self) -> Self {
        Self { x: &self.x + &other.x, y: &self.y + &other.y, error: &self.error + &other.error }
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        Self { x: &self.x - &other.x, y: &self.y - &other.y, error: &self.error + &other.error }
    }

    /// The complex conjugate.
    pub fn conjugate(&self) -> Self {
        Self { y: -&self.y, ..self.clone() }
    }

    /// The product. Each part is rounded down by less than a unit.
    pub fn times(&self, other: &Self) -> Self {
        let error = self.centre() * &other.error + &self.error * other.size();
        Self {
            x: (&self.x * &other.x - &self.y * &other.y) >> PLACES,
            y: (&self.x * &other.y + &self.y * &other.x) >> PLACES,
            error: (error >> PLACES) + 3,
        }
    }

    /// The inverse: `|1/z − 1/c| ≤ error / (l (l − error))` where `|c| ≥ l`.
    pub fn inverse(&self) -> Checked<Self> {
        let low = self.x.abs().max(self.y.abs());
        need(low > self.error, "vertex", "a number that is divided by may be 0")?;
        let square = &self.x * &self.x + &self.y * &self.y;
        let part = |v: &BigInt| (v << (2 * PLACES)) / &square;
        let error = (&self.error << (2 * PLACES)) / (&low * (&low - &self.error)) + 3;
        Ok(Self { x: part(&self.x), y: -part(&self.y), error })
    }

    /// An upper bound of the modulus of the centre, in units.
    fn centre(&self) -> BigInt {
        self.x.abs() + self.y.abs()
    }

    /// An upper bound of the modulus, in units.
    fn size(&self) -> BigInt {
        self.centre() + &self.error
    }

    /// An upper bound of the modulus.
    pub fn at_most(&self) -> Q {
        Q::new(self.size(), BigInt::one() << PLACES)
    }

    /// A lower bound of the modulus.
    pub fn at_least(&self) -> Q {
        Q::new(self.x.abs().max(self.y.abs()) - &self.error, BigInt::one() << PLACES)
    }

    /// The parts rounded to whole numbers of units `2^-places`, and an error of each; `None` where one of them has `size` bits or more.
    pub fn units(&self, places: usize, size: usize) -> Option<(i128, i128, i128)> {
        let all = [&self.x, &self.y, &self.error].map(|v| (v >> (PLACES - places)).to_i128());
        let [Some(x), Some(y), Some(error)] = all else { return None };
        [x, y, error].iter().all(|v| v.abs() < 1 << size).then_some((x, y, error + 2))
    }

    /// The sign of the real part, 0 where it is not certain.
    pub fn real_sign(&self) -> i32 {
        certain(&self.x, &self.error)
    }

    /// The sign of the imaginary part, 0 where it is not certain.
    pub fn imaginary_sign(&self) -> i32 {
        certain(&self.y, &self.error)
    }
}

fn certain(v: &BigInt, error: &BigInt) -> i32 {
    i32::from(v > error) - i32::from(-v > *error)
}

/// A square matrix, by rows.
pub type Balls = Vec<Vec<Ball>>;

/// `Σ a_k b_k`.
pub fn dot<'a>(a: impl IntoIterator<Item = &'a Ball>, b: impl IntoIterator<Item = &'a Ball>) -> Ball {
    a.into_iter().zip(b).fold(Ball::zero(), |sum, (x, y)| sum.plus(&x.times(y)))
}

/// The largest sum of the sizes of a row.
fn norm(m: &Balls) -> Q {
    let row = |row: &Vec<Ball>| row.iter().map(Ball::size).sum::<BigInt>();
    Q::new(m.iter().map(row).fold(BigInt::zero(), BigInt::max), BigInt::one() << PLACES)
}

/// Proves that all eigenvalues are smaller than `radius` in modulus, and returns a bound of `Σ ‖(M/radius)^k‖`, `k ≥ 0`.
///
/// With `P = M/radius` and `n_i = ‖P^(2^i)‖`: where `n_j < 1`, the sum is at most `Π_{i<j} (1 + n_i) / (1 − n_j)`.
pub fn dominated(matrix: &Balls, radius: &Q) -> Checked<Q> {
    need(!matrix.is_empty(), "vertex", "a block without rows")?;
    let inverse = Ball::real(&(Q::one() / radius));
    let mut power: Balls = matrix.iter().map(|row| row.iter().map(|x| x.times(&inverse)).collect()).collect();
    let (half, large) = (Q::one() / whole(2), whole(1 << 32));
    let (mut sum, n) = (Q::one(), matrix.len());
    for _ in 0..SQUARINGS {
        let size = norm(&power);
        if size < half {
            return Ok(sum / (Q::one() - size));
        }
        if size > large {
            break;
        }
        spend(4 * n * n * n, PLACES as u64)?;
        sum *= Q::one() + size;
        let column = |j: usize| power.iter().map(move |row| &row[j]);
        power = power.iter().map(|row| (0..n).map(|j| dot(row, column(j))).collect()).collect();
    }
    reject("vertex", "another eigenvalue is not seen to be smaller than the bound")
}

/// The matrix on the quotient by a vector with `v_p = 1` that spans an invariant line.
pub fn deflated(matrix: &Balls, v: &[Ball], p: usize) -> Balls {
    let rest = || (0..v.len()).filter(|&k| k != p);
    let entry = |i: usize, j: usize| matrix[i][j].minus(&v[i].times(&matrix[p][j]));
    rest().map(|i| rest().map(|j| entry(i, j)).collect()).collect()
}

/// The eigenvalue larger than `radius`, which is simple and the only one, with its eigenvector near `near`, `v_p = 1`.
///
/// In the basis `near, e_i` the matrix is `[[λ', r], [s, B]]`, and an eigenvector is `near + z` with `(λ' − B) z = s − (r z) z`.
/// With `‖(λ' − B)^-1‖ ≤ N` and `4 N² ‖r‖ |s| ≤ 1/2` the right side contracts the ball of radius `2 N |s|` (maximum norm).
pub fn leading(matrix: &Balls, near: &[(Q, Q)], radius: &Q) -> Checked<(Ball, Vec<Ball>)> {
    let Some(p) = near.iter().position(|(x, y)| x.is_one() && y.is_zero()) else {
        return reject("vertex", "some entry of the vector must be 1");
    };
    let exact: Vec<Ball> = near.iter().map(|(x, y)| Ball::new(x, y)).collect();
    let bound = dominated(&deflated(matrix, &exact, p), radius)? / radius;
    let value = dot(&matrix[p], &exact);
    let residual = |(row, v): (&Vec<Ball>, &Ball)| dot(row, &exact).minus(&value.times(v)).at_most();
    let off = matrix.iter().zip(&exact).map(residual).fold(Q::zero(), Q::max);
    let row: Q = matrix[p].iter().map(Ball::at_most).sum();
    need(value.at_least() >= *radius, "vertex", "the eigenvalue is not larger than the bound for the others")?;
    let small = &bound * &bound * &row * &off * whole(8) <= Q::one();
    need(small, "vertex", "the vector is not near enough to an eigenvector")?;
    let error = bound * off * whole(2);
    let wide = |(k, v): (usize, Ball)| if k == p { v } else { v.widened(&error) };
    let vector: Vec<Ball> = exact.into_iter().enumerate().map(wide).collect();
    let value = value.widened(&(row * error));
    dominated(&deflated(matrix, &vector, p), radius)?;
    need(value.at_least() > *radius, "vertex", "the eigenvalue is not larger than the bound for the others")?;
    Ok((value, vector))
}
