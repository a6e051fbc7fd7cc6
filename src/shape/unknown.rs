//! Operators with unknown entries: all identities of a complex, solved exactly (theory §13).

use super::identities::{Complex, ComplexError, Identity, OpName};
use crate::arith::Rational;
use crate::linalg::{Matrix, char_poly};
use crate::poly::Poly;
use std::collections::{BTreeMap, BTreeSet};
use thiserror::Error;

/// A complex in which some entries are unknown.
#[derive(Debug, Clone)]
pub struct Problem {
    complex: Complex,
    names: Vec<String>,
    /// The unknown at each unknown entry.
    places: BTreeMap<(OpName, usize, usize), usize>,
}

/// Where an equation comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// An identity of the complex.
    Identity(Identity),
    /// The columns of an operator sum to 1.
    Sums(OpName),
}

/// Why a problem cannot be solved as a linear one.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum UnknownError {
    /// The identities cannot be written down.
    #[error(transparent)]
    Complex(#[from] ComplexError),
    /// Two unknown operators are multiplied.
    #[error("{text}: {first} and {second} both have unknown entries, so the identity is not linear; give one of them")]
    Nonlinear {
        /// The product.
        text: String,
        /// One factor.
        first: String,
        /// The other.
        second: String,
    },
    /// An entry that does not exist.
    #[error("{operator} has no entry ({row}, {column})")]
    Entry {
        /// The operator.
        operator: String,
        /// The row.
        row: usize,
        /// The column.
        column: usize,
    },
    /// Too many unknowns.
    #[error("{found} unknowns are over the limit of {MAX_UNKNOWNS}")]
    Many {
        /// Number of unknowns.
        found: usize,
    },
}

/// Largest number of unknowns.
pub const MAX_UNKNOWNS: usize = 4096;

/// The solutions of a problem.
#[derive(Debug, Clone)]
pub enum Solution {
    /// There is none: these equations contradict each other, and no proper part of them does.
    None(Vec<Source>),
    /// There is exactly one.
    One(Box<Complex>),
    /// An affine family.
    Family(Box<Family>),
}

/// All solutions of a problem, as an affine family.
#[derive(Debug, Clone)]
pub struct Family {
    /// The solution with every parameter 0.
    pub origin: Complex,
    /// Names of the free parameters.
    pub parameters: Vec<String>,
    /// For each parameter what it adds to the entries.
    directions: Vec<Vec<(OpName, usize, usize, Rational)>>,
}

/// What of the spectrum of an operator does not depend on the parameters of a family.
#[derive(Debug, Clone)]
pub struct Forced {
    /// Diagonal blocks (in a fixed rational basis) without parameters.
    pub blocks: Vec<Matrix>,
    /// The remaining block with every parameter 0.
    pub free: Matrix,
    /// The derivative of the remaining block by each parameter.
    pub derivatives: Vec<Matrix>,
}

type Row = BTreeMap<usize, Rational>;

/// A linear equation `Σ row = right`.
struct Equation {
    source: usize,
    row: Row,
    right: Rational,
}

impl Complex {
    /// Where an equation comes from, as two paths, or as the operator whose columns sum to 1.
    #[must_use]
    pub fn source_text(&self, source: &Source) -> String {
        match source {
            Source::Identity(identity) => self.identity_text(identity),
            Source::Sums(op) => format!("the columns of {} sum to 1", self.operator_text(*op)),
        }
    }
}

impl Problem {
    /// Number of unknowns; entries of one name count once.
    #[must_use]
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// The operators with unknown entries.
    #[must_use]
    pub fn operators(&self) -> Vec<OpName> {
        let all: BTreeSet<OpName> = self.places.keys().map(|(op, _, _)| *op).collect();
        all.into_iter().collect()
    }

    /// The unknown entries (operator, row, column) with the number of their unknown.
    pub fn entries(&self) -> impl Iterator<Item = ((OpName, usize, usize), usize)> {
        self.places.iter().map(|(place, unknown)| (*place, *unknown))
    }

    /// The problem without unknowns; see [`Problem::unknown`].
    #[must_use]
    pub fn new(complex: Complex) -> Self {
        Self { complex, names: Vec::new(), places: BTreeMap::new() }
    }

    /// Declares an entry unknown. Entries with the same name are equal; without a name each is on its own. The number
    /// that the operator has there is ignored.
    ///
    /// # Errors
    /// [`UnknownError::Entry`], [`UnknownError::Many`].
    pub fn unknown(&mut self, op: OpName, row: usize, column: usize, name: Option<&str>) -> Result<(), UnknownError> {
        let operator = self.complex.operator_text(op);
        let Some(entry) = self
            .complex
            .operator_mut(op)
            .filter(|m| row < m.rows() && column < m.cols())
            .map(|m| &mut m[(row, column)])
        else {
            return Err(UnknownError::Entry { operator, row, column });
        };
        *entry = Rational::from(0);
        let known = name.and_then(|n| self.names.iter().position(|m| m == n));
        let index = known.unwrap_or_else(|| {
            self.names.push(name.map_or_else(|| format!("{operator}({row},{column})"), str::to_owned));
            self.names.len() - 1
        });
        self.places.insert((op, row, column), index);
        let found = self.names.len();
        if found > MAX_UNKNOWNS { Err(UnknownError::Many { found }) } else { Ok(()) }
    }

    /// Declares all entries of an operator unknown.
    ///
    /// # Errors
    /// As for [`Problem::unknown`].
    pub fn unknown_operator(&mut self, op: OpName) -> Result<(), UnknownError> {
        let (rows, cols) = self.complex.operator(op).map_or((0, 0), |m| (m.rows(), m.cols()));
        for row in 0..rows {
            for column in 0..cols {
                self.unknown(op, row, column, None)?;
            }
        }
        Ok(())
    }

    /// Solves all identities and column sums.
    ///
    /// # Errors
    /// [`UnknownError::Nonlinear`], and those of [`Complex::identities`].
    ///
    /// # Cost
    /// Sparse elimination over the rationals; on a contradiction once more for every identity.
    pub fn solve(&self) -> Result<Solution, UnknownError> {
        let mut sources: Vec<Source> = self.complex.identities()?.into_iter().map(Source::Identity).collect();
        let operators: BTreeSet<OpName> = self.places.keys().map(|(op, _, _)| *op).collect();
        sources.extend(operators.into_iter().map(Source::Sums));
        let mut equations = Vec::new();
        for (index, source) in sources.iter().enumerate() {
            match source {
                Source::Identity(identity) => self.identity_equations(index, identity, &mut equations)?,
                Source::Sums(op) => self.sum_equations(index, *op, &mut equations),
            }
        }
        let everything = vec![true; sources.len()];
        let Some(pivots) = eliminate(&equations, &everything) else {
            return Ok(Solution::None(conflict(&equations, sources)));
        };
        Ok(self.solution(&pivots))
    }

    fn identity_equations(&self, source: usize, id: &Identity, all: &mut Vec<Equation>) -> Result<(), UnknownError> {
        let mut rows: BTreeMap<(usize, usize), (Row, Rational)> = BTreeMap::new();
        let mut size = None;
        for (path, sign) in [(&id.left, 1), (&id.right, -1)] {
            let constant = self.complex.path_product(path)?;
            let expected = *size.get_or_insert((constant.rows(), constant.cols()));
            if expected != (constant.rows(), constant.cols()) {
                let text = self.complex.identity_text(id);
                let operator = self.complex.path_text(path);
                return Err(ComplexError::Size { text, operator, expected: expected.1, found: constant.cols() }.into());
            }
            for i in 0..constant.rows() {
                for j in 0..constant.cols() {
                    let entry = rows.entry((i, j)).or_default();
                    entry.1 -= &constant[(i, j)] * Rational::from(sign);
                }
            }
            self.unknown_terms(path, sign, &mut rows)?;
        }
        let equations = rows.into_values().map(|(row, right)| Equation { source, row: nonzero(row), right });
        all.extend(equations.filter(|e| !e.row.is_empty() || e.right != 0));
        Ok(())
    }

    /// Adds `sign * before * X * after` for the factor `X` of the path that has unknown entries.
    fn unknown_terms(
        &self,
        path: &[OpName],
        sign: i64,
        rows: &mut BTreeMap<(usize, usize), (Row, Rational)>,
    ) -> Result<(), UnknownError> {
        let is_unknown = |op: &OpName| self.places.range((*op, 0, 0)..=(*op, usize::MAX, usize::MAX)).next().is_some();
        let positions: Vec<usize> = (0..path.len()).filter(|&k| is_unknown(&path[k])).collect();
        let &[at] = positions.as_slice() else {
            let [first, second, ..] = positions.as_slice() else { return Ok(()) };
            return Err(UnknownError::Nonlinear {
                text: self.complex.path_text(path),
                first: self.complex.operator_text(path[*first]),
                second: self.complex.operator_text(path[*second]),
            });
        };
        let op = path[at];
        let (height, width) = self.complex.operator(op).map_or((0, 0), |m| (m.rows(), m.cols()));
        let factor = |part: &[OpName], size: usize| {
            if part.is_empty() { Ok(Matrix::identity(size)) } else { self.complex.path_product(part) }
        };
        let (before, after) = (factor(&path[..at], height)?, factor(&path[at + 1..], width)?);
        for ((_, row, column), unknown) in self.places.range((op, 0, 0)..=(op, usize::MAX, usize::MAX)) {
            for i in (0..before.rows()).filter(|&i| before[(i, *row)] != 0) {
                for j in (0..after.cols()).filter(|&j| after[(*column, j)] != 0) {
                    let term = &before[(i, *row)] * &after[(*column, j)] * Rational::from(sign);
                    let entry = rows.entry((i, j)).or_default();
                    *entry.0.entry(*unknown).or_default() += term;
                }
            }
        }
        Ok(())
    }

    fn sum_equations(&self, source: usize, op: OpName, all: &mut Vec<Equation>) {
        let Some(matrix) = self.complex.operator(op) else { return };
        for column in 0..matrix.cols() {
            let mut row = Row::new();
            let mut right = Rational::from(1);
            for i in 0..matrix.rows() {
                match self.places.get(&(op, i, column)) {
                    Some(unknown) => *row.entry(*unknown).or_default() += Rational::from(1),
                    None => right -= &matrix[(i, column)],
                }
            }
            all.push(Equation { source, row: nonzero(row), right });
        }
    }

    fn solution(&self, pivots: &BTreeMap<usize, (Row, Rational)>) -> Solution {
        let free: Vec<usize> = (0..self.names.len()).filter(|u| !pivots.contains_key(u)).collect();
        let mut origin = self.complex.clone();
        let mut directions = vec![Vec::new(); free.len()];
        for ((op, row, column), unknown) in &self.places {
            let (value, slopes) = match pivots.get(unknown) {
                Some((rest, value)) => {
                    let slope = |k: usize| rest.get(&free[k]).map(|c| -c);
                    (value.clone(), (0..free.len()).filter_map(|k| Some((k, slope(k)?))).collect())
                }
                None => {
                    let k = free.iter().position(|f| f == unknown).expect("an unknown is a pivot or free");
                    (Rational::from(0), vec![(k, Rational::from(1))])
                }
            };
            if let Some(matrix) = origin.operator_mut(*op) {
                matrix[(*row, *column)] = value;
            }
            for (k, slope) in slopes {
                let direction: &mut Vec<_> = &mut directions[k];
                direction.push((*op, *row, *column, slope));
            }
        }
        if free.is_empty() {
            return Solution::One(Box::new(origin));
        }
        let parameters = free.iter().map(|&u| self.names[u].clone()).collect();
        Solution::Family(Box::new(Family { origin, parameters, directions }))
    }
}

fn nonzero(row: Row) -> Row {
    row.into_iter().filter(|(_, c)| *c != 0).collect()
}

/// Reduced row echelon form of the equations of the sources in use: for each pivot the rest of its row (free unknowns
/// only) and the right side. `None`: contradiction.
fn eliminate(equations: &[Equation], used: &[bool]) -> Option<BTreeMap<usize, (Row, Rational)>> {
    let mut pivots: BTreeMap<usize, (Row, Rational)> = BTreeMap::new();
    for equation in equations.iter().filter(|e| used[e.source]) {
        let (mut row, mut right) = (equation.row.clone(), equation.right.clone());
        let known: Vec<usize> = row.keys().copied().filter(|u| pivots.contains_key(u)).collect();
        for unknown in known {
            let factor = row.remove(&unknown).expect("a key of the row");
            let (rest, value) = &pivots[&unknown];
            subtract(&mut row, &mut right, &factor, rest, value);
        }
        let Some((pivot, lead)) = row.pop_first() else {
            if right != 0 {
                return None;
            }
            continue;
        };
        for c in row.values_mut() {
            *c /= &lead;
        }
        right /= lead;
        for (rest, value) in pivots.values_mut() {
            if let Some(factor) = rest.remove(&pivot) {
                subtract(rest, value, &factor, &row, &right);
            }
        }
        pivots.insert(pivot, (row, right));
    }
    Some(pivots)
}

/// Subtracts `factor` times the row `other`.
fn subtract(row: &mut Row, right: &mut Rational, factor: &Rational, other: &Row, value: &Rational) {
    *right -= factor * value;
    for (unknown, c) in other {
        let entry = row.entry(*unknown).or_default();
        *entry -= factor * c;
        if *entry == 0 {
            row.remove(unknown);
        }
    }
}

/// A contradictory set of sources no proper part of which contradicts itself, by leaving out one after the other.
fn conflict(equations: &[Equation], sources: Vec<Source>) -> Vec<Source> {
    let mut used = vec![true; sources.len()];
    for k in 0..sources.len() {
        used[k] = false;
        if eliminate(equations, &used).is_some() {
            used[k] = true;
        }
    }
    sources.into_iter().zip(used).filter_map(|(s, keep)| keep.then_some(s)).collect()
}

impl Family {
    /// The member with the given parameters; missing ones are 0.
    #[must_use]
    pub fn at(&self, values: &[Rational]) -> Complex {
        let mut complex = self.origin.clone();
        for (direction, value) in self.directions.iter().zip(values) {
            for (op, row, column, slope) in direction {
                if let Some(matrix) = complex.operator_mut(*op) {
                    matrix[(*row, *column)] += slope * value;
                }
            }
        }
        complex
    }

    /// The derivative of an operator by each parameter; empty where the complex does not have the operator.
    #[must_use]
    pub fn derivatives(&self, op: OpName) -> Vec<Matrix> {
        let Some(size) = self.origin.operator(op).map(|m| (m.rows(), m.cols())) else { return Vec::new() };
        let derivative = |direction: &Vec<(OpName, usize, usize, Rational)>| {
            let mut m = Matrix::zero(size.0, size.1);
            for (_, row, column, slope) in direction.iter().filter(|d| d.0 == op) {
                m[(*row, *column)] = slope.clone();
            }
            m
        };
        self.directions.iter().map(derivative).collect()
    }

    /// The part of the spectrum of a square operator that no parameter changes: invariant subspaces on which, and quotients
    /// by invariant subspaces where, it does not depend on them, taken off in turn. `None` for other operators.
    #[must_use]
    pub fn forced(&self, op: OpName) -> Option<Forced> {
        let origin = self.origin.operator(op).filter(|m| m.rows() == m.cols())?.clone();
        let mut rest = Forced { blocks: Vec::new(), free: origin, derivatives: self.derivatives(op) };
        loop {
            let before = rest.free.rows();
            rest.split();
            rest.transpose();
            rest.split();
            rest.transpose();
            if rest.free.rows() == before {
                return Some(rest);
            }
        }
    }
}

impl Forced {
    /// The characteristic polynomial of all forced blocks.
    #[must_use]
    pub fn polynomial(&self) -> Poly {
        self.blocks.iter().fold(Poly::constant(Rational::from(1)), |product, block| &product * &char_poly(block))
    }

    fn transpose(&mut self) {
        self.free = self.free.transpose();
        for d in &mut self.derivatives {
            *d = d.transpose();
        }
        for b in &mut self.blocks {
            *b = b.transpose();
        }
    }

    /// Takes off the largest invariant subspace in the kernel of all derivatives.
    fn split(&mut self) {
        let n = self.free.rows();
        let rows = self.derivatives.iter().fold(Matrix::zero(0, n), |all, d| all.stack(d)).closure(&[&self.free]);
        let kernel = rows.kernel();
        let k = kernel.cols();
        if k == 0 {
            return;
        }
        // The functionals `rows` are coordinates of the quotient; complete the kernel to a basis dual to them.
        let basis = Matrix::from_fn(n, n, |i, j| {
            if j < k { kernel[(i, j)].clone() } else { Rational::from(u8::from(rows_pivot(&rows, j - k) == i)) }
        });
        let Some(inverse) = basis.inverse() else { return };
        let changed = |m: &Matrix| &(&inverse * m) * &basis;
        let corner =
            |m: &Matrix, from: usize, size: usize| Matrix::from_fn(size, size, |i, j| m[(from + i, from + j)].clone());
        let moved = changed(&self.free);
        self.blocks.push(corner(&moved, 0, k));
        self.free = corner(&moved, k, n - k);
        self.derivatives = self.derivatives.iter().map(|d| corner(&changed(d), k, n - k)).collect();
    }
}

/// The column of the leading one of a row of an echelon form.
fn rows_pivot(rows: &Matrix, row: usize) -> usize {
    rows.row(row).iter().position(|x| *x != 0).expect("a row of an echelon form is not 0")
}
