//! Certificates of the kind `solve`: the unknown entries of a case, from the identities of its curves and the column sums.

use crate::base::{Accepted, Checked, Matrix, Node, Q, Verdict, need, spend};
use crate::claim::Claim;
use crate::curve::{Case, Op};
use num_bigint::BigInt;
use num_traits::One;

/// Most unknowns.
const MAX_UNKNOWNS: usize = 512;

/// The equations `M x = b` of an open case: the rows of `M` with `b` as their last entry, by source.
struct Equations {
    /// For each identity and each operator with unknown entries, its rows.
    sources: Vec<Matrix>,
    unknowns: usize,
}

impl Equations {
    /// All equations are affine, because no product has two factors with unknown entries.
    fn of(case: &Case) -> Checked<Self> {
        let Case { shape, holes, .. } = case;
        let unknowns = holes.iter().fold(0, |most, h| most.max(h.unknown + 1));
        need(unknowns > 0, "solve", "no entry is unknown")?;
        need(unknowns <= MAX_UNKNOWNS, "limit", "too many unknowns")?;
        let is_open = |op: Op| holes.iter().any(|h| h.op == op);
        // The factor by which an unknown is multiplied in an operator.
        let slope = |op: Op, unknown: usize| {
            let Matrix { rows, cols, .. } = *shape.op(op)?;
            let mut slope = Matrix::zeros(rows, cols);
            for h in holes.iter().filter(|h| (h.op, h.unknown) == (op, unknown)) {
                slope.data[h.row * cols + h.col] = BigInt::one();
            }
            Ok(slope)
        };
        let mut sources = Vec::new();
        for e in 0..shape.states.len() {
            for [a, b, c, d] in shape.identities(e)? {
                spend(4 * unknowns * holes.len(), 0)?;
                let squared = is_open(a) && is_open(b) || is_open(c) && is_open(d);
                need(!squared, "solve", "two operators with unknown entries are multiplied")?;
                let change = |x: Op, y: Op, k: usize| match is_open(x) {
                    true => slope(x, k)?.times(shape.op(y)?),
                    false => shape.op(x)?.times(&slope(y, k)?),
                };
                let columns = (0..unknowns).map(|k| Ok(change(a, b, k)?.minus(&change(c, d, k)?)));
                let columns = columns.collect::<Checked<Vec<_>>>()?;
                let right = shape.op(c)?.times(shape.op(d)?)?.minus(&shape.op(a)?.times(shape.op(b)?)?);
                sources.push(rows(&columns, right));
            }
        }
        let mut sums: Vec<Op> = holes.iter().map(|h| h.op).collect();
        sums.dedup();
        for op in sums {
            let (matrix, ones) = (shape.op(op)?, Matrix::row_of_ones(shape.op(op)?.rows));
            let columns = (0..unknowns).map(|k| ones.times(&slope(op, k)?)).collect::<Checked<Vec<_>>>()?;
            sources.push(rows(&columns, Matrix::row_of_ones(matrix.cols).minus(&ones.times(matrix)?)));
        }
        Ok(Self { sources, unknowns })
    }

    /// The rank of the equations of some sources, without and with their right sides.
    fn ranks(&self, chosen: impl Iterator<Item = usize>) -> Checked<(usize, usize)> {
        // Each source is put below all before it.
        let rows: usize = self.sources.iter().map(|s| s.rows).sum();
        spend(self.sources.len() * rows * (self.unknowns + 1), 0)?;
        let all = chosen.fold(Matrix::empty(self.unknowns + 1), |all, k| all.stack(&self.sources[k]));
        let pivots = all.echelon()?.1;
        Ok((pivots.iter().filter(|j| **j < self.unknowns).count(), pivots.len()))
    }

    fn contradict(&self, chosen: impl Iterator<Item = usize>) -> Checked<bool> {
        let (rank, extended) = self.ranks(chosen)?;
        Ok(rank < extended)
    }
}

/// One equation for each entry of the matrices: those by which the unknowns are multiplied, and the right side.
fn rows(columns: &[Matrix], right: Matrix) -> Matrix {
    let flat = |m: &Matrix| Matrix { rows: 1, cols: m.data.len(), ..m.clone() };
    columns.iter().fold(Matrix::empty(right.data.len()), |all, c| all.stack(&flat(c))).stack(&flat(&right)).transpose()
}

/// Checks the proof of a certificate of the kind `solve`.
pub fn check(case: &Case, node: &Node<'_>) -> Checked<Accepted> {
    let [solutions, values, directions, conflict] = node.fields("solutions values directions conflict")?;
    let equations = Equations::of(case)?;
    let (n, count) = (equations.unknowns, equations.sources.len());
    let chosen = conflict.indices(count)?;
    let claim = match solutions.text()? {
        "none" => {
            let only = values.is_null() && directions.list()?.is_empty() && chosen.windows(2).all(|w| w[0] < w[1]);
            need(only && !chosen.is_empty(), "solve", "only a conflict, in ascending order, is needed")?;
            let all = equations.contradict(chosen.iter().copied())?;
            conflict.need(all, "solve", "these equations do not contradict each other")?;
            for k in &chosen {
                let part = equations.contradict(chosen.iter().copied().filter(|other| other != k))?;
                conflict.need(!part, "solve", "a part of these equations is a contradiction already")?;
            }
            let claim = Claim::Solvable { unknowns: n, equations: count, free: None, conflict: chosen };
            claim.is(Verdict::Refuted)
        }
        kind @ ("one" | "family") => {
            let (rank, extended) = equations.ranks(0..count)?;
            need(chosen.is_empty() && rank == extended, "solve", "the equations contradict each other")?;
            let point = Matrix::new(1, n, &values.vector(n)?);
            let along = directions.matrix(n)?;
            let free = along.rows;
            need((kind == "one") == (free == 0), "solve", "a family has directions, one solution has none")?;
            let independent = along.rank()? == free && rank + free == n;
            directions.need(independent, "solve", format_args!("{} independent directions are needed", n - rank))?;
            // (x, −1) and (d, 0) are in the kernel of the extended rows.
            let last = Matrix::ones(1 + free, 1, |i, _| i == 0).scaled(&-Q::one());
            let kernel = point.stack(&along).beside(&last).transpose();
            for source in &equations.sources {
                values.need(source.times(&kernel)?.is_zero(), "solve", "an equation does not hold")?;
            }
            let claim = Claim::Solvable { unknowns: n, equations: count, free: Some(free), conflict: Vec::new() };
            claim.is(Verdict::Proved)
        }
        _ => return solutions.reject("format", "one, family or none"),
    };
    Ok(Accepted { case: case.name.clone(), verdict: claim.verdict, claims: vec![claim], points: Vec::new() })
}
