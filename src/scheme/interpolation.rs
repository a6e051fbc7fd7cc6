//! Fractal interpolation: the function through given points with given vertical factors (theory §11, Theorem 10).

use super::SchemeError;
use crate::arith::{Rational, abs};
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Complex, End, Frame, Piece, Shape, State};

/// Most coordinates of a shape that interpolates: the powers of the abscissa and the values.
pub const MAX_INTERPOLATION: usize = 16;

/// Data, and what the function does between them: with the affine maps `L_j` of the whole interval onto the intervals,
/// `f(L_j(x)) = α_j f(x) + q_j(x)` with matrices `α_j` and polynomials `q_j` (M. F. Barnsley, *Fractal functions and interpolation*,
/// Constr. Approx. 2, 1986; vector-valued: P. R. Massopust).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interpolation {
    /// Abscissas, which increase.
    abscissas: Vec<Rational>,
    /// The values there.
    values: Vec<Vec<Rational>>,
    /// `α_j`, one for each interval.
    factors: Vec<Matrix>,
    /// By interval and coordinate of the values: the coefficients of `q_j` in the abscissa, from degree 0 on.
    polynomials: Vec<Vec<Vec<Rational>>>,
}

impl Interpolation {
    /// The function whose `q_j` are the affine functions that make it pass through the points `(x, y)`, `y` of one or more
    /// coordinates.
    ///
    /// # Errors
    /// [`SchemeError::Value`] where there are fewer than 3 points, abscissas do not increase, sizes do not match, or a factor that
    /// is a number is not smaller than 1 in modulus; [`SchemeError::Large`].
    ///
    /// ```
    /// use secant::{arith::ratio, linalg::Matrix, scheme::Interpolation};
    /// let points = [[0, 0], [1, 1], [2, 0]].map(|p| p.map(|x| ratio(x, 1)).to_vec());
    /// let half = Matrix::from_rows(1, vec![vec![ratio(1, 2)]]);
    /// let takagi = Interpolation::affine(&points, vec![half.clone(), half])?.shape()?;
    /// assert_eq!(takagi.states[0].pieces.len(), 2);
    /// # Ok::<(), secant::scheme::SchemeError>(())
    /// ```
    pub fn affine(points: &[Vec<Rational>], factors: Vec<Matrix>) -> Result<Self, SchemeError> {
        let mut new = Self::without_polynomials(points, factors)?;
        let (from, to) = (&new.abscissas[0], new.last_abscissa());
        let (start, finish) = (&new.values[0], &new.values[new.factors.len()]);
        let through = |j: usize| -> Vec<Vec<Rational>> {
            let (left, right) = (new.factors[j].apply(start), new.factors[j].apply(finish));
            let coordinate = |i: usize| {
                let (p, q) = (&new.values[j][i] - &left[i], &new.values[j + 1][i] - &right[i]);
                let slope = (&q - &p) / (to - from);
                vec![p - &slope * from, slope]
            };
            (0..start.len()).map(coordinate).collect()
        };
        new.polynomials = (0..new.factors.len()).map(through).collect();
        Ok(new)
    }

    /// The abscissas, which increase.
    #[must_use]
    pub fn abscissas(&self) -> &[Rational] {
        &self.abscissas
    }

    /// The values at the abscissas.
    #[must_use]
    pub fn values(&self) -> &[Vec<Rational>] {
        &self.values
    }

    /// The factors `α_j`, one for each interval.
    #[must_use]
    pub fn factors(&self) -> &[Matrix] {
        &self.factors
    }

    /// The polynomials `q_j`: by interval and coordinate of the values, their coefficients from degree 0 on.
    #[must_use]
    pub fn polynomials(&self) -> &[Vec<Vec<Rational>>] {
        &self.polynomials
    }

    /// The function with given polynomials: by interval and coordinate, coefficients from degree 0 on.
    ///
    /// # Errors
    /// As [`Interpolation::affine`]; where a piece does not pass through its points.
    pub fn new(
        points: &[Vec<Rational>],
        factors: Vec<Matrix>,
        polynomials: Vec<Vec<Vec<Rational>>>,
    ) -> Result<Self, SchemeError> {
        let mut new = Self::without_polynomials(points, factors)?;
        let dim = new.values[0].len();
        if polynomials.len() != new.factors.len() || polynomials.iter().any(|q| q.len() != dim) {
            let expected = "one polynomial for each interval and coordinate of the values is needed";
            return Err(SchemeError::value("polynomials", &polynomials.len(), expected));
        }
        new.polynomials = polynomials;
        for j in 0..new.factors.len() {
            let ends = [(0, &new.abscissas[0], j), (new.factors.len(), new.last_abscissa(), j + 1)];
            for (end, x, wanted) in ends {
                let found = new.step(j, x, &new.values[end]);
                if found != new.values[wanted] {
                    let what =
                        format!("q_{j} with its factor leads to ({}) at x = {}", tuple(&found), new.abscissas[wanted]);
                    let expected = format!("the data have ({}) there", tuple(&new.values[wanted]));
                    return Err(SchemeError::value("polynomials", &what, &expected));
                }
            }
        }
        if new.degree() + dim > MAX_INTERPOLATION {
            let size = new.degree() + dim;
            return Err(SchemeError::Large { what: "number of coordinates", size, limit: MAX_INTERPOLATION });
        }
        Ok(new)
    }

    fn without_polynomials(points: &[Vec<Rational>], factors: Vec<Matrix>) -> Result<Self, SchemeError> {
        let dim = points.first().map_or(0, |p| p.len().saturating_sub(1));
        if points.len() < 3 {
            return Err(SchemeError::value("points", &points.len(), "at least 3 points are needed"));
        }
        if dim == 0 || points.iter().any(|p| p.len() != dim + 1) {
            let expected = "a point is (x, y), with the same number of coordinates everywhere";
            return Err(SchemeError::value("points", &points.len(), expected));
        }
        if points.windows(2).any(|w| w[0][0] >= w[1][0]) {
            let expected = "points with increasing abscissas are needed";
            return Err(SchemeError::value("points", &points.len(), expected));
        }
        if dim + 1 > MAX_INTERPOLATION {
            let what = "number of coordinates";
            return Err(SchemeError::Large { what, size: dim + 1, limit: MAX_INTERPOLATION });
        }
        if factors.len() + 1 != points.len() || factors.iter().any(|a| (a.rows(), a.cols()) != (dim, dim)) {
            let expected = "one factor of the size of the values for each interval is needed";
            return Err(SchemeError::value("vertical", &factors.len(), expected));
        }
        let number = |a: &Matrix| (dim == 1).then(|| a[(0, 0)].clone());
        if let Some(bad) = factors.iter().filter_map(number).find(|a| abs(a) >= 1) {
            return Err(SchemeError::value("vertical", &bad, "the factors lie between −1 and 1"));
        }
        let abscissas = points.iter().map(|p| p[0].clone()).collect();
        let values = points.iter().map(|p| p[1..].to_vec()).collect();
        Ok(Self { abscissas, values, factors, polynomials: Vec::new() })
    }

    fn last_abscissa(&self) -> &Rational {
        &self.abscissas[self.factors.len()]
    }

    /// `α_j y + q_j(x)`.
    fn step(&self, j: usize, x: &Rational, y: &[Rational]) -> Vec<Rational> {
        let own = self.polynomials[j].iter().map(|q| value(q, x));
        self.factors[j].apply(y).into_iter().zip(own).map(|(a, b)| a + b).collect()
    }

    /// The largest degree of a polynomial, at least 1.
    fn degree(&self) -> usize {
        let degree = |q: &Vec<Rational>| q.iter().rposition(|c| *c != 0);
        self.polynomials.iter().flatten().filter_map(degree).fold(1, usize::max)
    }

    /// The part of the whole interval that each interval takes.
    #[must_use]
    pub fn shares(&self) -> Vec<Rational> {
        let width = self.last_abscissa() - &self.abscissas[0];
        self.abscissas.windows(2).map(|w| (&w[1] - &w[0]) / &width).collect()
    }

    /// The numbers of Theorem 10 of one order; `None` where values have several coordinates.
    #[must_use]
    pub fn matching(&self, order: usize) -> Option<Matching> {
        let number = |j: usize| &self.factors[j][(0, 0)];
        if self.values[0].len() != 1 {
            return None;
        }
        let power = |s: &Rational| (0..order).fold(Rational::from(1), |p, _| p * s);
        let scales: Vec<Rational> = self.shares().iter().map(power).collect();
        let derived = |j: usize| (0..order).fold(self.polynomials[j][0].clone(), |q, _| derivative(&q));
        let count = self.factors.len();
        let ratios = (0..count).map(|j| abs(number(j)) / &scales[j]).collect::<Vec<_>>();
        if ratios.iter().any(|r| *r >= 1) {
            return Some(Matching { ratios, ends: None, joints: Vec::new() });
        }
        let fixed = |j: usize, x: &Rational| value(&derived(j), x) / (&scales[j] - number(j));
        let ends = [fixed(0, &self.abscissas[0]), fixed(count - 1, self.last_abscissa())];
        let step = |j: usize, x: &Rational, y: &Rational| (number(j) * y + value(&derived(j), x)) / &scales[j];
        let joint = |j: usize| [step(j - 1, self.last_abscissa(), &ends[1]), step(j, &self.abscissas[0], &ends[0])];
        let joints = (1..count).map(joint).collect();
        Some(Matching { ratios, ends: Some(ends), joints })
    }

    /// The graph as a curve of one state: affine maps of `(x, y)`, or, with polynomials of a degree `g > 1`, on the coordinates
    /// `t, t², …, t^g, y` with the part `t` of the whole interval, looked at in `(x, y)`. The abscissa is its parameter.
    ///
    /// # Errors
    /// [`SchemeError::Divergent`] where an end is not one point, and others of the shape.
    pub fn shape(&self) -> Result<Shape, SchemeError> {
        let (mut shape, shares) = if self.degree() == 1 { self.affine_maps() } else { self.with_powers() };
        if shares.iter().any(|s| *s != shares[0]) {
            shape.states[0].pieces.iter_mut().zip(shares).for_each(|(piece, share)| piece.share = Some(share));
        }
        super::mask::verify(&shape)?;
        Ok(shape)
    }

    /// [`Interpolation::shape`] with its end points as vertices of one point, as a side of a tensor product needs them.
    ///
    /// # Errors
    /// As [`Interpolation::shape`].
    pub fn with_vertices(&self) -> Result<Shape, SchemeError> {
        let mut shape = self.shape()?;
        let ends = [End::Start, End::Finish].map(|end| shape.end_point(0, end));
        let [Some(start), Some(finish)] = ends else {
            return Err(SchemeError::Divergent("an end is not one point".to_owned()));
        };
        let boundary = |x: Vec<Rational>| Some(Boundary { vertex: 1, op: Matrix::from_columns(x.len(), &[x]) });
        (shape.states[0].left, shape.states[0].right) = (boundary(start), boundary(finish));
        let pieces = vec![Piece { target: 1, op: Matrix::identity(1), reversed: false, share: None }];
        let name = "v".to_owned();
        shape.states.push(State { name, kind: CellKind::Vertex, dim: 1, pieces, left: None, right: None });
        Ok(shape)
    }

    /// Affine maps of `(x, y)`.
    fn affine_maps(&self) -> (Shape, Vec<Rational>) {
        let (dim, shares) = (self.values[0].len(), self.shares());
        let operator = |(j, share): (usize, &Rational)| {
            let at = |i: usize, m: usize| self.polynomials[j][i].get(m).map_or_else(|| Rational::from(0), Clone::clone);
            let linear = Matrix::from_fn(dim + 1, dim + 1, |r, c| match (r, c) {
                (0, 0) => share.clone(),
                (0, _) => Rational::from(0),
                (_, 0) => at(r - 1, 1),
                _ => self.factors[j][(r - 1, c - 1)].clone(),
            });
            let mut shift = vec![&self.abscissas[j] - share * &self.abscissas[0]];
            shift.extend((0..dim).map(|i| at(i, 0)));
            Shape::affine_operator(&linear, &shift)
        };
        let mut shape = Shape::single(CellKind::Edge, shares.iter().enumerate().map(operator).collect());
        shape.frame = Frame::Affine;
        shape.control = Some(Shape::affine_control(dim + 1));
        (shape, shares)
    }

    /// The coordinates `t, t², …, t^g, y`.
    fn with_powers(&self) -> (Shape, Vec<Rational>) {
        let (degree, dim, shares) = (self.degree(), self.values[0].len(), self.shares());
        let (from, width) = (&self.abscissas[0], self.last_abscissa() - &self.abscissas[0]);
        let size = degree + dim;
        let mut operators = Vec::new();
        let mut begin = Rational::from(0);
        for (j, share) in shares.iter().enumerate() {
            let mut linear = Matrix::zero(size, size);
            let mut shift = vec![Rational::from(0); size];
            let rows = (1..=degree).map(|m| power_of(&begin, share, m));
            let values = self.polynomials[j].iter().map(|q| substituted(q, from, &width));
            for (row, coefficients) in rows.chain(values).enumerate() {
                for (m, c) in coefficients.into_iter().enumerate().filter(|(_, c)| *c != 0) {
                    match m.checked_sub(1) {
                        Some(column) => linear[(row, column)] = c,
                        None => shift[row] = c,
                    }
                }
            }
            for (i, k) in (0..dim).flat_map(|i| (0..dim).map(move |k| (i, k))) {
                linear[(degree + i, degree + k)] = self.factors[j][(i, k)].clone();
            }
            operators.push(Shape::affine_operator(&linear, &shift));
            begin += share;
        }
        let mut shape = Shape::single(CellKind::Edge, operators);
        shape.control = Some(Matrix::from_fn(dim + 1, size + 1, |i, j| match (i, j) {
            (0, 1) => from + &width,
            (0, _) => from.clone(),
            _ => Rational::from(u8::from(j == degree + i)),
        }));
        (shape, shares)
    }
}

/// The surface `(x, y, f(x) g(y))` over the product of two intervals, of two functions with one value each: the tensor product of
/// their graphs, seen through the coordinates `x`, `y` and the product of the values.
///
/// # Errors
/// [`SchemeError::Value`] where a function has several values, and as [`Interpolation::shape`].
///
/// ```
/// use secant::{arith::ratio, linalg::Matrix, scheme::{Interpolation, product_surface}};
/// let points = [[0, 0], [1, 1], [2, 0]].map(|p| p.map(|x| ratio(x, 1)).to_vec());
/// let half = Matrix::from_rows(1, vec![vec![ratio(1, 2)]]);
/// let takagi = Interpolation::affine(&points, vec![half.clone(), half])?;
/// let surface = product_surface(&takagi, &takagi)?;
/// assert_eq!((surface.shape.states[0].dim, surface.shape.control.unwrap().rows()), (9, 3));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn product_surface(first: &Interpolation, second: &Interpolation) -> Result<Complex, SchemeError> {
    let (a, b) = (first.with_vertices()?, second.with_vertices()?);
    let (Some(p), Some(q)) = (&a.control, &b.control) else {
        return Err(SchemeError::value("tensor", &"a graph", "coordinates of its points are needed"));
    };
    if let Some(more) = [p, q].into_iter().find(|m| m.rows() != 2) {
        let expected = "functions of one value are multiplied";
        return Err(SchemeError::value("tensor", &format!("{} values", more.rows() - 1), expected));
    }
    let ones = |n: usize| Matrix::from_rows(n, vec![vec![Rational::from(1); n]]);
    let row = |m: &Matrix, i: usize| Matrix::from_rows(m.cols(), vec![m.row(i).to_vec()]);
    let x = super::tensor::kronecker(&row(p, 0), &ones(q.cols()));
    let y = super::tensor::kronecker(&ones(p.cols()), &row(q, 0));
    let z = super::tensor::kronecker(&row(p, 1), &row(q, 1));
    let mut complex = super::tensor::tensor(&a, &b)?;
    complex.shape.control = Some(x.stack(&y).stack(&z));
    Ok(complex)
}

/// What Theorem 10 compares in one order `k`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Matching {
    /// The `|α_j| / a_j^k`.
    pub ratios: Vec<Rational>,
    /// `y_{0,k}` and `y_{N,k}`, the derivatives at the ends; `None` where a ratio is not below 1.
    pub ends: Option<[Rational; 2]>,
    /// The derivatives before and behind each inner point; none where a ratio is not below 1.
    pub joints: Vec<[Rational; 2]>,
}

fn derivative(q: &[Rational]) -> Vec<Rational> {
    q.iter().enumerate().skip(1).map(|(m, c)| c * Rational::from(m)).collect()
}

fn tuple(v: &[Rational]) -> String {
    v.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

fn value(q: &[Rational], x: &Rational) -> Rational {
    q.iter().rev().fold(Rational::from(0), |sum, c| sum * x + c)
}

/// Coefficients of `(b + s t)^m`.
fn power_of(b: &Rational, s: &Rational, m: usize) -> Vec<Rational> {
    (0..m).fold(vec![Rational::from(1)], |p, _| times_line(&p, b, s))
}

/// Coefficients of `p(t) (b + s t)`.
fn times_line(p: &[Rational], b: &Rational, s: &Rational) -> Vec<Rational> {
    let mut out = vec![Rational::from(0); p.len() + 1];
    for (m, c) in p.iter().enumerate() {
        out[m] += c * b;
        out[m + 1] += c * s;
    }
    out
}

/// Coefficients of `q(b + s t)`.
fn substituted(q: &[Rational], b: &Rational, s: &Rational) -> Vec<Rational> {
    let mut out = Vec::new();
    for c in q.iter().rev() {
        out = times_line(&out, b, s);
        out[0] += c;
    }
    while out.len() > 1 && out.last().is_some_and(|c| *c == 0) {
        out.pop();
    }
    out
}
