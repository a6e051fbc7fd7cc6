//! Curves that are chains of polynomial arcs: the zeros of their derivatives decide whether the tangent turns continuously
//! (Theorem 6″).

use super::{Kind, Model};
use crate::base::{Checked, Matrix, Node, Q, Verdict, need, some, whole};
use crate::region::polynomial::{Poly, common_divisor, derivative, roots, trimmed, value};
use num_traits::{One, Zero};

/// Highest degree of an arc, and most arcs of a curve.
const MAX_DEGREE: usize = 32;
const MAX_ARCS: usize = 256;

/// Checks the degree and the arcs of the answer, and says whether the curve is G¹.
pub fn check(model: &Model<'_>, degree: &Node<'_>, arcs: &Node<'_>) -> Checked<Verdict> {
    let curves = model.shape.reachable.iter().all(|&e| model.shape.states[e].kind == Kind::Edge);
    arcs.need(curves, "arc", "only curves are made of arcs")?;
    let width = degree.index(MAX_DEGREE + 1)? + 1;
    let mut found: Vec<Option<Matrix>> = vec![None; model.shape.states.len()];
    for (e, item) in model.for_states(arcs, "arc")? {
        if !item.is_null() {
            let arc = item.matrix(width)?;
            item.need(arc.rows == model.shape.states[e].dim, "arc", "one polynomial for each coordinate is needed")?;
            let sum = Matrix::row_of_ones(arc.rows).times(&arc)?;
            item.need(sum == constant(width), "arc", "the coordinates do not add up to 1")?;
            found[e] = Some(arc);
        }
    }
    let arcs_of = Arcs { model, width, found };
    for (e, item) in model.for_states(arcs, "arc")? {
        item.at(arcs_of.runs(e))?;
    }
    let mut chain = Vec::new();
    let start = model.shape.start;
    arcs.at(arcs_of.collect(&model.shape.view, (start, false), &mut Vec::new(), &mut chain))?;
    let mut smooth = true;
    for (k, arc) in chain.iter().enumerate() {
        smooth &= !turns(arc)?;
        if let Some(next) = chain.get(k + 1) {
            // Backwards from its end the arc runs against its direction of travel.
            let (before, after) = (departure(&reversed(arc)?)?.scaled(&whole(-1)), departure(next)?);
            smooth &= same_ray(&before, &after)?;
        }
    }
    Ok(if smooth { Verdict::Proved } else { Verdict::Refuted })
}

/// The polynomial 1 as a row.
fn constant(width: usize) -> Matrix {
    Matrix::ones(1, width, |_, j| j == 0)
}

/// The matrix that takes the coefficients of `p(t)` to those of `p(a + b t)`: its rows are the powers of `a + b t`.
fn line(width: usize, a: &Q, b: &Q) -> Checked<Matrix> {
    let shift = Matrix::ones(width, width, |i, j| j == i + 1).scaled(b).plus(a, &Matrix::identity(width));
    let mut powers = constant(width);
    for k in 1..width {
        powers = powers.stack(&powers.row(k - 1).times(&shift)?);
    }
    Ok(powers)
}

fn reversed(arc: &Matrix) -> Checked<Matrix> {
    arc.times(&line(arc.cols, &Q::one(), &whole(-1))?)
}

struct Arcs<'a> {
    model: &'a Model<'a>,
    width: usize,
    /// By state: its polynomials as rows, lowest coefficients first.
    found: Vec<Option<Matrix>>,
}

impl Arcs<'_> {
    /// The arc of a state, if it has one, fulfils the equations of its pieces, which have arcs.
    fn runs(&self, e: usize) -> Checked<()> {
        let Some(arc) = &self.found[e] else { return Ok(()) };
        let pieces = &self.model.shape.states[e].pieces;
        let count = whole(pieces.len() as i64);
        for (i, piece) in pieces.iter().enumerate() {
            let inner = some(self.found[piece.target].as_ref(), "arc", "a piece leads to a state without an arc")?;
            let (first, step) = if piece.reversed { (i + 1, -1) } else { (i, 1) };
            let part = line(self.width, &(whole(first as i64) / &count), &(whole(step) / &count))?;
            let same = arc.times(&part)? == piece.op.times(inner)?;
            need(same, "arc", format_args!("piece {i} does not run along the arc of its state"))?;
        }
        Ok(())
    }

    /// The arcs of a cell as they are seen, in the order of the parameter.
    fn collect(
        &self,
        view: &Matrix,
        (state, backwards): (usize, bool),
        path: &mut Vec<usize>,
        chain: &mut Vec<Matrix>,
    ) -> Checked<()> {
        if let Some(arc) = &self.found[state] {
            let seen = view.times(arc)?;
            let seen = if backwards { reversed(&seen)? } else { seen };
            need(!slope(&seen).is_zero(), "arc", "an arc is a single point where it is looked at")?;
            need(chain.len() < MAX_ARCS, "limit", "too many arcs")?;
            chain.push(seen);
            return Ok(());
        }
        need(!path.contains(&state), "arc", "a state without an arc comes back to itself")?;
        path.push(state);
        let mut pieces: Vec<_> = self.model.shape.states[state].pieces.iter().collect();
        if backwards {
            pieces.reverse();
        }
        for piece in pieces {
            let view = view.times(&piece.op)?;
            self.collect(&view, (piece.target, backwards != piece.reversed), path, chain)?;
        }
        path.pop();
        Ok(())
    }
}

/// The derivative, with a column of zeros behind.
fn slope(arc: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| if j + 1 < arc.cols { arc.at(i, j + 1) * whole(j as i64 + 1) } else { Q::zero() };
    let rows: Vec<Vec<Q>> = (0..arc.rows).map(|i| (0..arc.cols).map(|j| entry(i, j)).collect()).collect();
    Matrix::from_rows(arc.cols, &rows)
}

/// Whether the common divisor of the components of the derivative has a root of odd multiplicity strictly between 0 and 1.
///
/// A root of multiplicity `m` is one of `f_0 = g` and of the next `m − 1` of `f_{k+1} = gcd(f_k, f_k')`: the numbers of their
/// different roots, with alternating signs, add up to the number of roots of odd multiplicity.
fn turns(arc: &Matrix) -> Checked<bool> {
    let slope = slope(arc);
    let mut f: Poly = Vec::new();
    for i in 0..slope.rows {
        f = common_divisor(&f, &trimmed((0..slope.cols).map(|j| slope.at(i, j)).collect()))?;
    }
    let (mut odd, mut even) = (0, 0);
    while f.len() > 1 {
        let at_end = usize::from(value(&f, &Q::one()).is_zero());
        odd += roots(&f, &Q::zero(), &Q::one())? - at_end;
        (odd, even) = (even, odd);
        f = common_divisor(&f, &derivative(&f))?;
    }
    Ok(odd != even)
}

/// The direction of travel at the start of an arc: the first coefficients of its derivative that are not all 0.
fn departure(arc: &Matrix) -> Checked<Matrix> {
    let slope = slope(arc);
    let first = (0..slope.cols).map(|j| slope.columns(&[j])).find(|c| !c.is_zero());
    some(first, "arc", "an arc is a single point where it is looked at")
}

fn same_ray(a: &Matrix, b: &Matrix) -> Checked<bool> {
    let product = a.transpose().times(b)?.at(0, 0);
    Ok(a.beside(b).rank()? == 1 && product > Q::zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane curve from its polynomials.
    fn arc(x: &[i64], y: &[i64]) -> Matrix {
        let row = |c: &[i64]| c.iter().map(|k| whole(*k)).collect::<Vec<_>>();
        Matrix::from_rows(x.len(), &[row(x), row(y)])
    }

    #[test]
    fn roots_of_odd_multiplicity_turn() {
        crate::base::number::refill();
        // (1 − 2t)^k integrated, beside 0: a zero of order k at 1/2.
        let power = |k: usize| {
            let f = line(k + 2, &Q::one(), &whole(-2)).unwrap().row(k);
            let rows: Vec<Q> =
                (0..k + 2).map(|j| if j == 0 { Q::zero() } else { f.at(0, j - 1) / whole(j as i64) }).collect();
            Matrix::from_rows(k + 2, &[rows, vec![Q::zero(); k + 2]])
        };
        let turned: Vec<bool> = (1..=6).map(|k| turns(&power(k)).unwrap()).collect();
        assert_eq!(turned, [true, false, true, false, true, false]);
        // Zeros of the derivative at the ends are none inside: t² and (1 − t)².
        assert!(!turns(&arc(&[0, 0, 1], &[0, 0, 3])).unwrap() && !turns(&arc(&[1, -2, 1], &[0, 0, 0])).unwrap());
        // 2t − 4t² + … : roots of the components at 1/2 and at 1/3 are not common.
        assert!(!turns(&arc(&[0, 1, -1], &[0, 2, -3])).unwrap());
        // Simple at 1/4 and double at 1/2: (1 − 4t)(1 − 2t)² = 1 − 8t + 20t² − 16t³.
        assert!(turns(&arc(&[0, 3, -12, 20, -12], &[0, 0, 0, 0, 0])).unwrap());
    }

    #[test]
    fn directions_at_the_ends() {
        crate::base::number::refill();
        let cusp = arc(&[0, 0, 1, 0], &[0, 0, 0, 1]);
        assert_eq!(departure(&cusp).unwrap(), arc(&[2], &[0]));
        let end = departure(&reversed(&cusp).unwrap()).unwrap().scaled(&whole(-1));
        assert!(same_ray(&end, &arc(&[2], &[3])).unwrap() && !same_ray(&end, &arc(&[-2], &[-3])).unwrap());
        assert!(!same_ray(&end, &arc(&[2], &[4])).unwrap());
    }
}
