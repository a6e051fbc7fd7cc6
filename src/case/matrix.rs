use super::node::Node;
use super::{Convention, MAX_COORDINATES};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use std::ops::Range;

/// A matrix as it stands in the file, with the place of every entry.
pub(super) struct Written {
    pub what: String,
    pub rows: Vec<Vec<Rational>>,
    places: Vec<Vec<Range<usize>>>,
    span: Range<usize>,
    holes: Vec<Hole>,
}

/// An entry that is left open: where it is in the operator, and its name where it has one.
#[derive(Debug, Clone)]
pub(super) struct Hole {
    pub row: usize,
    pub column: usize,
    pub name: Option<String>,
    pub span: Range<usize>,
}

/// An operator on columns with its open entries, which are 0 in the matrix.
pub(super) struct Operator {
    pub matrix: Matrix,
    pub holes: Vec<Hole>,
}

impl Operator {
    /// An operator all of whose entries are open.
    pub fn unknown(rows: usize, cols: usize, span: &Range<usize>) -> Self {
        let entries = (0..rows).flat_map(|row| (0..cols).map(move |column| (row, column)));
        let holes = entries.map(|(row, column)| Hole { row, column, name: None, span: span.clone() }).collect();
        Self { matrix: Matrix::zero(rows, cols), holes }
    }
}

impl Written {
    /// Reads a list of equally long, nonempty rows of numbers.
    pub fn read(node: &Node<'_>) -> Result<Self, Problem> {
        let written = Self::open(node)?;
        match written.holes.first() {
            None => Ok(written),
            Some(hole) => {
                let message = format!("{} cannot have unknown entries", node.what);
                Err(node
                    .file
                    .problem("unknown-entry", message, hole.span.clone(), "unknown")
                    .with_help("only the operators of pieces, boundaries and reversals may have unknown entries"))
            }
        }
    }

    /// Reads a list of equally long, nonempty rows; entries may be unknown (`"?"`, `"?name"`).
    pub fn open(node: &Node<'_>) -> Result<Self, Problem> {
        let row_name = |i: usize| format!("row {i} of {}", node.what);
        let mut rows: Vec<Vec<Rational>> = Vec::new();
        let mut places = Vec::new();
        let mut holes = Vec::new();
        for row in node.array(row_name)? {
            let entries = row.array(|j| format!("entry {j} of {}", row.what))?;
            if entries.is_empty() {
                return Err(empty(&row));
            }
            let width = rows.first().map_or(entries.len(), Vec::len);
            if entries.len() != width {
                let note = format!("{} here, {width} in the first row", entries_text(entries.len()));
                return Err(row
                    .problem("ragged", format!("the rows of {} have different lengths", node.what), note)
                    .with_help("every row of a matrix has the same number of entries"));
            }
            if entries.len() > MAX_COORDINATES || rows.len() == MAX_COORDINATES {
                return Err(node
                    .problem("limit", format!("{} is too large", node.what), "too many rows or columns")
                    .with_help(format!("matrices of at most {MAX_COORDINATES} rows and columns are read")));
            }
            let mut numbers = Vec::with_capacity(width);
            for (column, entry) in entries.iter().enumerate() {
                numbers.push(match entry.unknown()? {
                    None => entry.number()?,
                    Some(name) => {
                        holes.push(Hole { row: rows.len(), column, name, span: entry.span() });
                        Rational::from(0)
                    }
                });
            }
            rows.push(numbers);
            places.push(entries.iter().map(Node::span).collect());
        }
        if rows.is_empty() {
            return Err(empty(node));
        }
        Ok(Self { what: node.what.clone(), rows, places, span: node.span(), holes })
    }

    pub fn height(&self) -> usize {
        self.rows.len()
    }

    pub fn width(&self) -> usize {
        self.rows[0].len()
    }

    /// The matrix as written.
    pub fn matrix(&self) -> Matrix {
        Matrix::from_rows(self.width(), self.rows.clone())
    }

    /// Refuses another size than `expected` (rows, columns).
    pub fn sized(&self, node: &Node<'_>, expected: (usize, usize), why: &str) -> Result<(), Problem> {
        let found = (self.height(), self.width());
        if found == expected {
            return Ok(());
        }
        let message = format!(
            "{} has {} and {}, but {} and {} are needed",
            self.what,
            count(found.0, "row"),
            count(found.1, "column"),
            expected.0,
            expected.1
        );
        let note = format!("{} x {} instead of {} x {}", found.0, found.1, expected.0, expected.1);
        Err(node.problem("size", message, note).with_help(why))
    }

    /// The operator on columns: transposed for [`Convention::Rows`]. Its columns without open entries must sum to 1.
    pub fn operator(&self, node: &Node<'_>, convention: Convention) -> Result<Operator, Problem> {
        let by_rows = convention == Convention::Rows;
        let matrix = if by_rows { self.matrix().transpose() } else { self.matrix() };
        let mut holes = self.holes.clone();
        if by_rows {
            holes.iter_mut().for_each(|h| std::mem::swap(&mut h.row, &mut h.column));
        }
        let open = |column: usize| holes.iter().any(|h| h.column == column);
        let bad = bad_columns(&matrix).find(|(column, _)| !open(*column));
        match bad {
            None => Ok(Operator { matrix, holes }),
            Some((line, sum)) => Err(self.sum_problem(node, convention, line, &sum, &matrix)),
        }
    }

    fn sum_problem(
        &self,
        node: &Node<'_>,
        convention: Convention,
        line: usize,
        sum: &Rational,
        op: &Matrix,
    ) -> Problem {
        let (this, other, other_word) = match convention {
            Convention::Rows => ("row", "column", "columns"),
            _ => ("column", "row", "rows"),
        };
        let message = format!("{this} {line} of {} sums to {}, not to 1", self.what, short(sum));
        let marks: Vec<Range<usize>> = match convention {
            Convention::Rows => {
                let row = &self.places[line];
                std::iter::once(row[0].start..row[self.width() - 1].end).collect()
            }
            _ => self.places.iter().map(|row| row[line].clone()).collect(),
        };
        let mut problem =
            node.file.problem("sum", message, marks[0].clone(), format!("the {this} sums to {}", short(sum)));
        for mark in marks.into_iter().skip(1) {
            problem = problem.with_mark(mark);
        }
        let declared = format!("the case declares convention = {:?}, so every {this} must sum to 1", convention.name());
        let hint = if bad_columns(&op.transpose()).next().is_none() {
            format!("{declared}; here every {other} does: is convention = {other_word:?} meant?")
        } else {
            declared
        };
        problem.with_help(hint)
    }

    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }
}

fn empty(node: &Node<'_>) -> Problem {
    node.problem("empty-matrix", format!("{} is empty", node.what), "no entries")
        .with_help("a matrix is a list of rows, as in [[\"1/2\", 0], [\"1/2\", 1]]")
}

fn bad_columns(op: &Matrix) -> impl Iterator<Item = (usize, Rational)> {
    let sum = |j| (0..op.rows()).fold(Rational::from(0), |s, i| s + &op[(i, j)]);
    (0..op.cols()).map(move |j| (j, sum(j))).filter(|(_, sum)| *sum != 1)
}

fn entries_text(count: usize) -> String {
    if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") }
}

fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}

/// The number, or its first digits where it is long.
fn short(x: &Rational) -> String {
    let text = x.to_string();
    if text.len() <= 48 { text } else { format!("{}… ({} characters)", &text[..24], text.len()) }
}
