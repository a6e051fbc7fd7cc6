//! Certificates of the kind `solve`: the unknown entries of a case, from the identities of its curves and the column sums.

use crate::case::{Case, Hole};
use crate::json::Node;
use crate::matrix::Matrix;
use crate::number::{Q, spend};
use crate::shape::{Op, Shape};
use crate::{Accepted, Checked, Verdict, need, reject};
use num_traits::{One, Zero};

/// Most unknowns.
const MAX_UNKNOWNS: usize = 512;

/// The equations `M x = b` of an open case: the rows of `M` with `b` as their last entry, by source.
struct Equations {
    /// For each identity and each operator with unknown entries, its rows.
    sources: Vec<Matrix>,
    unknowns: usize,
}

impl Equations {
    /// All equations are affine, because no product has two factors with unknown entries; so they are known from their values
    /// at 0 and at the unit vectors.
    fn of(case: Case) -> Checked<Self> {
        let Case { mut shape, holes, .. } = case;
        let unknowns = holes.iter().map(|h| h.unknown + 1).max().unwrap_or(0);
        need(unknowns > 0, "solve", "no entry is unknown")?;
        need(unknowns <= MAX_UNKNOWNS, "limit", "too many unknowns")?;
        let mut identities = Vec::new();
        for e in 0..shape.states.len() {
            identities.extend(shape.identities(e)?);
        }
        let is_open = |op: &Op| holes.iter().any(|h| h.op == *op);
        for [a, b, c, d] in &identities {
            let squared = is_open(a) && is_open(b) || is_open(c) && is_open(d);
            need(!squared, "solve", "two operators with unknown entries are multiplied")?;
        }
        let mut sums: Vec<Op> = holes.iter().map(|h| h.op).collect();
        sums.dedup();
        let at_zero = residuals(&shape, &identities, &sums)?;
        let mut sources: Vec<Matrix> = at_zero.iter().map(|r| r.transpose()).collect();
        for unknown in (0..unknowns).rev() {
            let set = |shape: &mut Shape, value: &Q| {
                holes.iter().filter(|h| h.unknown == unknown).for_each(|h: &Hole| shape.set(h.op, h.row, h.col, value));
            };
            set(&mut shape, &Q::one());
            let values = residuals(&shape, &identities, &sums)?;
            set(&mut shape, &Q::zero());
            for (source, (value, zero)) in sources.iter_mut().zip(values.iter().zip(&at_zero)) {
                *source = value.minus(zero).transpose().stack(source);
            }
        }
        // The last row holds the values at 0, which are −b.
        let close = |m: Matrix| {
            let last = m.rows - 1;
            let right = m.row(last).scaled(&-Q::one());
            m.transpose().columns(&(0..last).collect::<Vec<_>>()).transpose().stack(&right).transpose()
        };
        Ok(Self { sources: sources.into_iter().map(close).collect(), unknowns })
    }

    /// The rank of the equations of some sources, without and with their right sides.
    fn ranks(&self, chosen: impl Iterator<Item = usize>) -> Checked<(usize, usize)> {
        let all = chosen.fold(Matrix::empty(self.unknowns + 1), |all, k| all.stack(&self.sources[k]));
        let pivots = all.echelon()?.1;
        Ok((pivots.iter().filter(|j| **j < self.unknowns).count(), pivots.len()))
    }
}

/// What should be 0: the entries of the differences of two products, and of column sums and 1.
fn residuals(shape: &Shape, identities: &[[Op; 4]], sums: &[Op]) -> Checked<Vec<Matrix>> {
    let mut all = Vec::new();
    for [a, b, c, d] in identities {
        let difference = shape.op(*a).times(shape.op(*b))?.minus(&shape.op(*c).times(shape.op(*d))?);
        all.push(Matrix { rows: difference.data.len(), cols: 1, ..difference });
    }
    for op in sums {
        let m = shape.op(*op);
        spend(m.rows * m.cols, m.bits())?;
        let ones = |n: usize| Matrix::ones(1, n, |_, _| true);
        all.push(ones(m.rows).times(m)?.minus(&ones(m.cols)).transpose());
    }
    Ok(all)
}

/// Checks the proof of a certificate of the kind `solve`.
pub fn check(open: Case, node: &Node<'_>) -> Checked<Accepted> {
    let [solutions, values, directions, conflict] = node.fields(["solutions", "values", "directions", "conflict"])?;
    let case = open.name.clone();
    let equations = Equations::of(open)?;
    let (n, count) = (equations.unknowns, equations.sources.len());
    let (rank, extended) = equations.ranks(0..count)?;
    let chosen = conflict.list()?.iter().map(|k| k.index(count)).collect::<Checked<Vec<_>>>()?;
    let (verdict, claim) = match solutions.text()? {
        "none" => {
            let empty = values.is_null() && directions.list()?.is_empty();
            need(
                empty && chosen.windows(2).all(|w| w[0] < w[1]),
                "solve",
                "only a conflict, in ascending order, is needed",
            )?;
            let contradict = |left_out: Option<usize>| {
                let (rank, extended) = equations.ranks(chosen.iter().copied().filter(|k| Some(*k) != left_out))?;
                Ok(rank < extended)
            };
            conflict.need(contradict(None)?, "solve", "these equations do not contradict each other")?;
            for &k in &chosen {
                conflict.need(
                    !contradict(Some(k))?,
                    "solve",
                    "a part of these equations is a contradiction already",
                )?;
            }
            (
                Verdict::Refuted,
                format!("refuted: the {n} unknowns have values; the equations {chosen:?} contradict each other"),
            )
        }
        kind @ ("one" | "family") => {
            need(chosen.is_empty() && rank == extended, "solve", "the equations contradict each other")?;
            let point = values.vector(n)?;
            let along = directions.matrix(n)?;
            let free = along.rows;
            need((kind == "one") == (free == 0), "solve", "a family has directions, one solution has none")?;
            let independent = along.rank()? == free && rank + free == n;
            directions.need(independent, "solve", &format!("{} independent directions are needed", n - rank))?;
            // (x, −1) and (d, 0) are in the kernel of the extended rows.
            let mut columns = Matrix::from_rows(n + 1, &[point.into_iter().chain([-Q::one()]).collect()]);
            if free > 0 {
                columns = columns.stack(&along.transpose().stack(&Matrix::ones(1, free, |_, _| false)).transpose());
            }
            for source in &equations.sources {
                let solved = source.times(&columns.transpose())?.is_zero();
                values.need(solved, "solve", "an equation does not hold")?;
            }
            let text =
                if free == 0 { "are determined".to_owned() } else { format!("form a family of {free} parameters") };
            (
                Verdict::Proved,
                format!("proved: the {n} unknowns have values that satisfy {count} matrix equations; they {text}"),
            )
        }
        _ => return reject("format", &solutions.place, "one, family or none"),
    };
    Ok(Accepted { case, verdict, claims: vec![claim], points: Vec::new() })
}
