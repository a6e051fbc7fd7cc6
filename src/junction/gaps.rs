//! Linear programs in exact numbers: the largest `g` for which a system of equations and inequalities has a solution.

use crate::arith::Rational;

/// `maximise x_0` subject to `A x = b`, `x >= 0`, by the simplex method with Bland's rule, in two phases; `None` where there is no
/// solution, or no largest value.
pub(super) fn largest(equations: &[(Vec<Rational>, Rational)]) -> Option<Vec<Rational>> {
    let unknowns = equations.first()?.0.len();
    let total = unknowns + equations.len();
    let mut table = Table { rows: Vec::new(), basis: Vec::new(), width: total };
    for (k, (row, right)) in equations.iter().enumerate() {
        let turned = *right < 0;
        let sign = |x: &Rational| if turned { -x } else { x.clone() };
        let mut line: Vec<Rational> = row.iter().map(sign).collect();
        line.extend((0..equations.len()).map(|j| Rational::from(u8::from(j == k))));
        line.push(sign(right));
        table.rows.push(line);
        table.basis.push(unknowns + k);
    }
    // First the sum of the artificial unknowns is made 0, which Bland's rule reaches without cycling.
    let mut cost = vec![Rational::from(0); total];
    cost[unknowns..].fill(Rational::from(-1));
    table.optimise(&cost, total)?;
    let left = table.basis.iter().zip(&table.rows).filter(|(b, _)| **b >= unknowns);
    if left.map(|(_, row)| &row[total]).any(|x| *x != 0) {
        return None;
    }
    table.drive_out(unknowns);
    let mut cost = vec![Rational::from(0); total];
    cost[0] = Rational::from(1);
    table.optimise(&cost, unknowns)?;
    let mut x = vec![Rational::from(0); unknowns];
    for (b, row) in table.basis.iter().zip(&table.rows) {
        if *b < unknowns {
            x[*b] = row[total].clone();
        }
    }
    Some(x)
}

struct Table {
    rows: Vec<Vec<Rational>>,
    basis: Vec<usize>,
    width: usize,
}

impl Table {
    /// Maximises `cost · x` over the first `columns` unknowns; `None` where it grows without bound.
    fn optimise(&mut self, cost: &[Rational], columns: usize) -> Option<()> {
        loop {
            let gain = |j: usize| {
                let used = self.basis.iter().zip(&self.rows).fold(Rational::from(0), |s, (b, r)| s + &cost[*b] * &r[j]);
                &cost[j] - used
            };
            let Some(column) = (0..columns).find(|&j| !self.basis.contains(&j) && gain(j) > 0) else { return Some(()) };
            let ratio = |r: &Vec<Rational>| &r[self.width] / &r[column];
            let rows = (0..self.rows.len()).filter(|&k| self.rows[k][column] > 0);
            let row = rows.min_by(|&i, &j| {
                ratio(&self.rows[i]).cmp(&ratio(&self.rows[j])).then(self.basis[i].cmp(&self.basis[j]))
            })?;
            self.pivot(row, column);
        }
    }

    /// Takes artificial unknowns, which are 0, out of the basis; rows in which nothing else stands are dropped.
    fn drive_out(&mut self, unknowns: usize) {
        let mut k = 0;
        while k < self.rows.len() {
            if self.basis[k] < unknowns {
                k += 1;
            } else if let Some(column) = (0..unknowns).find(|&j| self.rows[k][j] != 0) {
                self.pivot(k, column);
                k += 1;
            } else {
                self.rows.remove(k);
                self.basis.remove(k);
            }
        }
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let by = self.rows[row][column].clone();
        self.rows[row].iter_mut().for_each(|x| *x /= &by);
        let pivot = self.rows[row].clone();
        for (k, line) in self.rows.iter_mut().enumerate() {
            if k != row && line[column] != 0 {
                let factor = line[column].clone();
                line.iter_mut().zip(&pivot).filter(|(_, p)| **p != 0).for_each(|(x, p)| *x -= &factor * p);
            }
        }
        self.basis[row] = column;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn row(entries: &[i64], right: i64) -> (Vec<Rational>, Rational) {
        (entries.iter().map(|x| ratio(*x, 1)).collect(), ratio(right, 1))
    }

    #[test]
    fn a_largest_value_and_none() {
        // x + y + s = 4, x + 3y + t = 6, x - u = 1: the largest x is 4.
        let system = [row(&[1, 1, 1, 0, 0], 4), row(&[1, 3, 0, 1, 0], 6), row(&[1, 0, 0, 0, -1], 1)];
        assert_eq!(largest(&system).unwrap()[0], 4);
        // Twice the same equation.
        assert_eq!(largest(&[row(&[1, 1], 2), row(&[1, 1], 2)]).unwrap()[0], 2);
        assert!(largest(&[row(&[1, 1], 2), row(&[1, 1], 3)]).is_none());
        assert!(largest(&[row(&[1, -1], 0)]).is_none());
        assert!(largest(&[row(&[1, 1], -1)]).is_none());
    }
}
