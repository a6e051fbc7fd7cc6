//! Subspaces spanned by vectors with algebraic coordinates, and their dimensions.

use crate::algebraic::{Elem, Root};
use crate::arith::{Interval, Rational, abs};
use crate::jordan::{Factor, Over};
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::theorem::branch::apply;
use crate::theorem::{Direction, primitive};

/// Binary digits of the enclosures in which independence is looked for.
const BITS: u64 = 192;

/// A subspace of `R^d`, as the span of vectors over number fields, each seen at one root: a real root stands for the line of
/// the vector, a root that is not real for the span of its real and imaginary part.
#[derive(Debug, Clone, Default)]
pub struct Subspace {
    /// The vectors; see [`Subspace::reduced`].
    pub generators: Vec<Direction>,
}

/// What is known of a dimension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rank {
    /// A lower bound.
    pub at_least: usize,
    /// An upper bound.
    pub at_most: usize,
}

impl Rank {
    /// The dimension, where both bounds agree.
    #[must_use]
    pub fn exact(self) -> Option<usize> {
        (self.at_least == self.at_most).then_some(self.at_least)
    }
}

impl Subspace {
    /// The image under `view` of the span of `vectors` (over `Q[x]/(factor)`), each seen at all the `roots` listed.
    ///
    /// Where all roots of the factor are listed the span is rational: it is that of the coefficient vectors.
    #[must_use]
    pub fn of_vectors(view: &Matrix, factor: &Factor, roots: &[usize], vectors: &[&[Elem]]) -> Self {
        let over = Over { modulus: &factor.poly, alpha: None };
        let images = vectors.iter().map(|v| apply(view, v, over));
        let mut generators = Vec::new();
        for image in images {
            if factor.roots.iter().enumerate().all(|(k, _)| roots.contains(&k)) {
                for k in 0..factor.degree() {
                    let coords = image.iter().map(|e| Elem::from_rational(&e.0.coeff(k))).collect();
                    generators.push(Direction { root: Root::from_rational(&Rational::from(0)), coords });
                }
                continue;
            }
            for &r in roots {
                let root = &factor.roots[r];
                // Of two conjugate roots one is enough.
                let repeated = !root.is_real() && root.conjugate().index() < r && roots.contains(&(r - 1));
                if !repeated {
                    generators.push(Direction { root: root.clone(), coords: image.clone() });
                }
            }
        }
        Self { generators }.reduced()
    }

    /// The normal of a rational plane in space: its third coordinate is 1, or its last one that is not 0.
    #[must_use]
    pub fn normal(&self) -> Option<Vec<Rational>> {
        let rows: Vec<Vec<Rational>> = self.generators.iter().map(Direction::rational).collect::<Option<_>>()?;
        let [a, b] = rows.as_slice() else { return None };
        let ([a0, a1, a2], [b0, b1, b2]) = (a.as_slice(), b.as_slice()) else { return None };
        let cross = [a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0];
        let unit = cross.iter().rev().find(|x| **x != 0)?.clone();
        Some(cross.iter().map(|x| x / &unit).collect())
    }

    /// The span of both.
    #[must_use]
    pub fn join(&self, other: &Self) -> Self {
        let generators = self.generators.iter().chain(&other.generators).cloned().collect();
        Self { generators }.reduced()
    }

    /// A basis of the subspace as far as that can be told without a common field: rational vectors first, in reduced
    /// echelon form; vectors over one field reduced over it, and by the rational ones.
    #[must_use]
    pub fn reduced(&self) -> Self {
        let (mut rational, mut groups) = (Vec::new(), Vec::<(Root, Vec<Vec<Elem>>)>::new());
        for g in &self.generators {
            if g.rational().is_some() {
                rational.push(g.coords.clone());
                continue;
            }
            // Conjugates span the same real subspace.
            let mirrored = !g.root.is_real() && g.root.conjugate().index() < g.root.index();
            let root = if mirrored { g.root.conjugate() } else { g.root.clone() };
            match groups.iter_mut().find(|(known, _)| known.same(&root)) {
                Some((_, group)) => group.push(g.coords.clone()),
                None => groups.push((root, vec![g.coords.clone()])),
            }
        }
        let line = Poly::linear(&Rational::from(0));
        rational = echelon(rational, &line);
        loop {
            // Vectors that turn out to be rational are moved, which may reduce the others further.
            let mut moved = Vec::new();
            for (root, group) in &mut groups {
                let mut rows = rational.clone();
                rows.append(group);
                let reduced = echelon(rows, root.minpoly());
                let (plain, rest): (Vec<_>, Vec<_>) =
                    reduced.into_iter().partition(|v| v.iter().all(|e| e.is_rational().is_some()));
                let new = independent(&rational, plain, &line);
                let base = [rational.as_slice(), &new].concat();
                *group = independent(&base, rest, root.minpoly());
                moved.extend(new);
            }
            groups.retain(|(_, group)| !group.is_empty());
            if moved.is_empty() {
                break;
            }
            rational.extend(moved);
            rational = echelon(rational, &line);
        }
        let mut generators: Vec<Direction> = rational.into_iter().map(integral).collect();
        for (root, group) in groups {
            for coords in group {
                let new = Direction { root: root.clone(), coords };
                let known =
                    new.root.is_real() && generators.iter().any(|g| g.root.is_real() && g.same_line(&new).is_some());
                if !known {
                    generators.push(new);
                }
            }
        }
        Self { generators }
    }

    /// Bounds of the dimension; they agree where all vectors are over one real field, and nearly always otherwise.
    #[must_use]
    pub fn rank(&self) -> Rank {
        let reduced = self.reduced();
        let at_most: usize = reduced.generators.iter().map(|g| if g.root.is_real() { 1 } else { 2 }).sum();
        let mut fields: Vec<&Root> = Vec::new();
        for g in reduced.generators.iter().filter(|g| g.rational().is_none()) {
            if !fields.iter().any(|r| r.same(&g.root)) {
                fields.push(&g.root);
            }
        }
        let at_least = match fields[..] {
            [] => at_most,
            [only] if only.is_real() => at_most,
            _ => independent_in_enclosures(reduced.real_boxes()),
        };
        Rank { at_least, at_most }
    }

    /// Enclosures of real vectors that span the subspace.
    fn real_boxes(&self) -> Vec<Vec<Interval>> {
        let mut rows = Vec::new();
        for g in &self.generators {
            let (re, im): (Vec<_>, Vec<_>) = g.coords.iter().map(|e| e.enclosure(&g.root, BITS)).unzip();
            rows.push(re);
            if !g.root.is_real() {
                rows.push(im);
            }
        }
        rows
    }

    /// Decimals, for display: vectors that span the subspace.
    #[must_use]
    pub fn to_f64(&self) -> Vec<Vec<f64>> {
        let number = |x: &Interval| crate::arith::to_f64(&x.mid());
        self.real_boxes().iter().map(|row| row.iter().map(number).collect()).collect()
    }

    /// Whether both are the same subspace; `None` where their dimensions are not settled.
    #[must_use]
    pub fn same(&self, other: &Self) -> Option<bool> {
        let both = self.join(other).rank();
        let (a, b) = (self.rank().exact()?, other.rank().exact()?);
        if a != b || both.at_least > a {
            return Some(false);
        }
        (both.at_most == a).then_some(true)
    }
}

/// The rational vector as coprime integers.
fn integral(v: Vec<Elem>) -> Direction {
    let numbers: Vec<Rational> = v.iter().map(|e| e.is_rational().expect("a rational vector")).collect();
    Direction {
        root: Root::from_rational(&Rational::from(0)),
        coords: primitive(&numbers).iter().map(Elem::from_rational).collect(),
    }
}

/// The nonzero rows of the reduced echelon form over `Q[x]/(f)`.
fn echelon(mut rows: Vec<Vec<Elem>>, f: &Poly) -> Vec<Vec<Elem>> {
    let width = rows.first().map_or(0, Vec::len);
    let mut done = 0;
    for col in 0..width {
        let Some(pivot) = (done..rows.len()).find(|&i| !rows[i][col].is_zero()) else { continue };
        rows.swap(done, pivot);
        let Some(inverse) = rows[done][col].inv(f) else { continue };
        let lead: Vec<Elem> = rows[done].iter().map(|e| e.mul(&inverse, f)).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != done && !row[col].is_zero() {
                let factor = row[col].clone();
                for (x, y) in row.iter_mut().zip(&lead) {
                    *x = x.sub(&factor.mul(y, f));
                }
            }
        }
        rows[done] = lead;
        done += 1;
    }
    rows.truncate(done);
    rows
}

/// The vectors of `candidates` that enlarge the span of `base`, one after the other.
fn independent(base: &[Vec<Elem>], candidates: Vec<Vec<Elem>>, f: &Poly) -> Vec<Vec<Elem>> {
    let (mut span, mut kept) = (base.to_vec(), Vec::new());
    for v in candidates {
        let mut rows = span.clone();
        rows.push(v.clone());
        let grown = echelon(rows, f);
        if grown.len() > span.len() {
            span = grown;
            kept.push(v);
        }
    }
    kept
}

/// How many vectors are certainly independent, by elimination in enclosures with the largest pivots.
fn independent_in_enclosures(mut rows: Vec<Vec<Interval>>) -> usize {
    let least = |x: &Interval| if x.contains_zero() { Rational::from(0) } else { abs(&x.lo).min(abs(&x.hi)) };
    let mut count = 0;
    loop {
        let mut best: Option<(usize, usize, Rational)> = None;
        for (i, row) in rows.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                let size = least(x);
                if size > best.as_ref().map_or(Rational::from(0), |b| b.2.clone()) {
                    best = Some((i, j, size));
                }
            }
        }
        let Some((i, j, _)) = best else { return count };
        count += 1;
        let lead = rows.swap_remove(i);
        let pivot = &lead[j];
        let inverse = Interval::new(Rational::from(1) / &pivot.lo, Rational::from(1) / &pivot.hi);
        for row in &mut rows {
            let factor = (&row[j] * &inverse).outward(BITS);
            for (k, x) in row.iter_mut().enumerate() {
                *x = if k == j {
                    Interval::point(Rational::from(0))
                } else {
                    (&*x - &(&factor * &lead[k])).outward(BITS)
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebraic::roots;

    fn rational(v: &[i64]) -> Direction {
        let coords = v.iter().map(|x| Elem::from_rational(&Rational::from(*x))).collect();
        Direction { root: Root::from_rational(&Rational::from(0)), coords }
    }

    fn surd(square: i64, v: &[(i64, i64)]) -> Direction {
        let f = Poly::new(vec![(-square).into(), 0.into(), 1.into()]);
        let coords = v.iter().map(|(a, b)| Elem(Poly::new(vec![(*a).into(), (*b).into()]))).collect();
        Direction { root: roots(&f).pop().unwrap(), coords }
    }

    fn span(generators: &[Direction]) -> Subspace {
        Subspace { generators: generators.to_vec() }
    }

    #[test]
    fn dimensions_are_exact_over_one_field() {
        let plane = span(&[rational(&[1, 2, 3]), rational(&[2, 4, 7])]);
        assert_eq!(plane.rank().exact(), Some(2));
        let s = surd(2, &[(0, 1), (2, 0), (0, 0)]);
        let multiple = surd(2, &[(2, 0), (0, 2), (0, 0)]);
        assert_eq!(span(&[s.clone(), multiple]).rank().exact(), Some(1));
        assert_eq!(
            span(&[s, rational(&[1, 0, 0])]).same(&span(&[rational(&[1, 0, 0]), rational(&[0, 1, 0])])),
            Some(true)
        );
    }

    #[test]
    fn vectors_over_different_fields_are_compared() {
        let a = surd(2, &[(1, 0), (0, 1), (0, 0)]);
        let b = surd(8, &[(2, 0), (0, 1), (0, 0)]);
        assert_eq!(span(&[a.clone(), b]).rank().exact(), Some(1));
        let c = surd(3, &[(1, 0), (0, 1), (0, 0)]);
        assert_eq!(span(&[a.clone(), c]).rank().exact(), Some(2));
        let i = surd(-1, &[(1, 0), (0, 1), (0, 0)]);
        let both = span(std::slice::from_ref(&i)).rank();
        assert_eq!((both.at_least, both.at_most), (2, 2));
        let tilted = surd(-1, &[(0, 1), (0, 0), (1, 1)]);
        assert!(span(&[i, tilted]).rank().at_least >= 3);
    }
}
