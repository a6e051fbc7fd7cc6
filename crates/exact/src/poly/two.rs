//! Polynomials in two variables over the rationals.

use super::Poly;
use crate::arith::{Rational, abs, sign};

/// A polynomial in two variables: by powers of the second, with polynomials in the first as coefficients.
///
/// ```
/// use secant_exact::{arith::ratio, poly::Two};
/// let (p, q) = (Two::first(), Two::second());
/// let f = p.times(&q).minus(&Two::number(ratio(1, 2)));
/// assert_eq!(f.display(["p", "q"]), "p q - 1/2");
/// assert_eq!(f.eval(&ratio(1, 1), &ratio(2, 1)), ratio(3, 2));
/// assert_eq!(f.strict_sign(&(ratio(0, 1), ratio(1, 2)), &(ratio(0, 1), ratio(1, 2))), Some(-1));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Two {
    rows: Vec<Poly>,
}

impl Two {
    /// The polynomial with these coefficients by powers of the second variable.
    #[must_use]
    pub fn new(mut rows: Vec<Poly>) -> Self {
        while rows.last().is_some_and(Poly::is_zero) {
            rows.pop();
        }
        Self { rows }
    }

    /// The polynomial that is each of some polynomials in the first variable at a value of the second, of the lowest degree in the
    /// second.
    #[must_use]
    pub fn through(at: &[Rational], lines: &[Poly]) -> Self {
        let degree = lines.iter().filter_map(Poly::degree).fold(0, usize::max);
        let across = |i: usize| Poly::through(at, lines.iter().map(|f| f.coeff(i)).collect());
        let columns: Vec<Poly> = (0..=degree).map(across).collect();
        Self::new((0..at.len()).map(|j| Poly::new(columns.iter().map(|f| f.coeff(j)).collect())).collect())
    }

    /// A number.
    #[must_use]
    pub fn number(q: Rational) -> Self {
        Self::new(vec![Poly::constant(q)])
    }

    /// The first variable.
    #[must_use]
    pub fn first() -> Self {
        Self::new(vec![Poly::linear(&Rational::from(0))])
    }

    /// The second variable.
    #[must_use]
    pub fn second() -> Self {
        Self::new(vec![Poly::zero(), Poly::constant(Rational::from(1))])
    }

    /// The coefficients by powers of the second variable.
    #[must_use]
    pub fn rows(&self) -> &[Poly] {
        &self.rows
    }

    /// Whether it is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.rows.is_empty()
    }

    /// Whether no variable occurs.
    #[must_use]
    pub fn is_number(&self) -> bool {
        self.rows.len() <= 1 && self.degree() == 0
    }

    /// The degree in the first variable; 0 of the polynomial 0.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.rows.iter().filter_map(Poly::degree).fold(0, usize::max)
    }

    /// `self + other`.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let length = self.rows.len().max(other.rows.len());
        let row = |f: &Self, k: usize| f.rows.get(k).map_or_else(Poly::zero, Clone::clone);
        Self::new((0..length).map(|k| &row(self, k) + &row(other, k)).collect())
    }

    /// `self - other`.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.scale(&Rational::from(-1)))
    }

    /// `self * other`.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let length = (self.rows.len() + other.rows.len()).saturating_sub(1);
        let mut rows = vec![Poly::zero(); length];
        for (i, a) in self.rows.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (j, b) in other.rows.iter().enumerate().filter(|(_, b)| !b.is_zero()) {
                rows[i + j] = &rows[i + j] + &(a * b);
            }
        }
        Self::new(rows)
    }

    /// `q self`.
    #[must_use]
    pub fn scale(&self, q: &Rational) -> Self {
        Self::new(self.rows.iter().map(|r| r.scale(q)).collect())
    }

    /// The value.
    #[must_use]
    pub fn eval(&self, p: &Rational, q: &Rational) -> Rational {
        self.at_first(p).eval(q)
    }

    /// The polynomial in the second variable at a value of the first.
    #[must_use]
    pub fn at_first(&self, p: &Rational) -> Poly {
        Poly::new(self.rows.iter().map(|r| r.eval(p)).collect())
    }

    /// The polynomial in the first variable at a value of the second.
    #[must_use]
    pub fn at_second(&self, q: &Rational) -> Poly {
        self.rows.iter().rev().fold(Poly::zero(), |v, r| &v.scale(q) + r)
    }

    /// The polynomial in the first variable where the second is a polynomial in it.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, poly::{Poly, Two}};
    /// let square = Poly::new(vec![ratio(0, 1), ratio(0, 1), ratio(1, 1)]);
    /// let f = Two::first().times(&Two::second());
    /// assert_eq!(f.along(&square).display("p"), "p^3");
    /// ```
    #[must_use]
    pub fn along(&self, second: &Poly) -> Poly {
        self.rows.iter().rev().fold(Poly::zero(), |v, r| &(&v * second) + r)
    }

    /// The same polynomial with the variables in the other order.
    #[must_use]
    pub fn swapped(&self) -> Self {
        let row = |i: usize| Poly::new(self.rows.iter().map(|r| r.coeff(i)).collect());
        Self::new((0..=self.degree()).map(row).collect())
    }

    /// What the second variable is where this vanishes, as a polynomial in the first, if it is one.
    #[must_use]
    pub fn solved(&self) -> Option<Poly> {
        let [rest, lead] = self.rows.as_slice() else { return None };
        (lead.degree() == Some(0)).then(|| rest.scale(&(Rational::from(-1) / lead.coeff(0))))
    }

    /// The leading coefficient: of the highest power of the second variable, and in it of the first.
    #[must_use]
    pub fn leading(&self) -> Option<&Rational> {
        self.rows.last()?.leading()
    }

    /// A multiple with leading coefficient 1; 0 stays.
    #[must_use]
    pub fn monic(&self) -> Self {
        self.leading().map_or_else(|| self.clone(), |c| self.scale(&(Rational::from(1) / c)))
    }

    /// The multiple whose coefficients are integers without a common divisor, the leading one positive; 0 stays.
    #[must_use]
    pub fn primitive(&self) -> Self {
        let columns = self.degree() + 1;
        let all = self.rows.iter().flat_map(|r| (0..columns).map(|k| r.coeff(k)));
        let whole = Poly::from_ints(&Poly::new(all.collect()).primitive());
        let row = |j: usize| Poly::new((0..columns).map(|k| whole.coeff(j * columns + k)).collect());
        Self::new((0..self.rows.len()).map(row).collect())
    }

    /// The quotient, where there is no rest.
    #[must_use]
    pub fn divided(&self, by: &Self) -> Option<Self> {
        let top = |f: &Self| Some((f.rows.len().checked_sub(1)?, f.rows.last()?.degree()?, f.leading()?.clone()));
        let (row, degree, lead) = top(by)?;
        let (mut rest, mut quotient) = (self.clone(), Self::new(Vec::new()));
        while let Some((r, d, c)) = top(&rest) {
            let (up, along) = (r.checked_sub(row)?, d.checked_sub(degree)?);
            let mut coefficients = vec![Rational::from(0); along];
            coefficients.push(c / &lead);
            let mut rows = vec![Poly::zero(); up];
            rows.push(Poly::new(coefficients));
            let term = Self::new(rows);
            rest = rest.minus(&term.times(by));
            quotient = quotient.plus(&term);
        }
        Some(quotient)
    }

    /// The greatest common divisor, up to a number: remainders in the second variable, without their divisors in the first.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, poly::Two};
    /// let (p, q) = (Two::first(), Two::second());
    /// let (f, g) = (p.plus(&q), p.minus(&q));
    /// assert_eq!(f.times(&p).times(&g).gcd(&g.times(&g).times(&p)), g.times(&p).primitive());
    /// ```
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return self.plus(other).primitive();
        }
        let (mut a, of_a) = self.without_content();
        let (mut b, of_b) = other.without_content();
        if a.rows.len() < b.rows.len() {
            std::mem::swap(&mut a, &mut b);
        }
        while !b.is_zero() {
            let rest = a.pseudo_remainder(&b);
            a = std::mem::replace(&mut b, rest.without_content().0);
        }
        a.times(&Self::new(vec![of_a.gcd(&of_b)])).primitive()
    }

    /// The polynomial without the largest divisor in the first variable alone, and that divisor.
    fn without_content(&self) -> (Self, Poly) {
        let content = self.rows.iter().fold(Poly::zero(), |g, r| g.gcd(r));
        if content.is_zero() {
            return (self.clone(), content);
        }
        (Self::new(self.rows.iter().map(|r| r.div_rem(&content).0).collect()).primitive(), content)
    }

    /// The rest of a multiple of the polynomial after division in the second variable.
    fn pseudo_remainder(&self, by: &Self) -> Self {
        let (mut rest, degree) = (self.clone(), by.rows.len());
        while rest.rows.len() >= degree && !rest.is_zero() {
            let lead = Self::new(vec![by.rows[degree - 1].clone()]);
            let mut up = vec![Poly::zero(); rest.rows.len() - degree];
            up.push(rest.rows[rest.rows.len() - 1].clone());
            rest = rest.times(&lead).minus(&Self::new(up).times(by));
        }
        rest
    }

    /// The strict sign on a closed box, where all Bernstein coefficients have it.
    #[must_use]
    pub fn strict_sign(&self, first: &(Rational, Rational), second: &(Rational, Rational)) -> Option<i32> {
        let columns = self.degree() + 1;
        let along: Vec<Vec<Rational>> = self.rows.iter().map(|r| bernstein(r, first, columns)).collect();
        let mut one = None;
        for k in 0..columns {
            let f = Poly::new(along.iter().map(|row| row[k].clone()).collect());
            for c in bernstein(&f, second, self.rows.len()) {
                let s = sign(&c);
                if s == 0 || one.is_some_and(|o| o != s) {
                    return None;
                }
                one = Some(s);
            }
        }
        one
    }

    /// Text with the names of the variables.
    #[must_use]
    pub fn display(&self, names: [&str; 2]) -> String {
        let mut out = String::new();
        for (j, row) in self.rows.iter().enumerate().rev() {
            for (i, c) in row.coeffs().iter().enumerate().rev().filter(|(_, c)| **c != 0) {
                let minus = *c < 0;
                out.push_str(match (out.is_empty(), minus) {
                    (true, true) => "-",
                    (true, false) => "",
                    (false, true) => " - ",
                    (false, false) => " + ",
                });
                let power = |name: &str, k: usize| match k {
                    0 => String::new(),
                    1 => name.to_owned(),
                    _ => format!("{name}^{k}"),
                };
                let factors: Vec<String> =
                    [power(names[0], i), power(names[1], j)].into_iter().filter(|f| !f.is_empty()).collect();
                let size = abs(c);
                if size != 1 || factors.is_empty() {
                    out.push_str(&size.to_string());
                }
                out.push_str(&factors.join(" "));
            }
        }
        if out.is_empty() { "0".to_owned() } else { out }
    }
}

/// So many Bernstein coefficients of a polynomial on an interval.
fn bernstein(f: &Poly, (low, high): &(Rational, Rational), count: usize) -> Vec<Rational> {
    let width = high - low;
    let mut power = Rational::from(1);
    let shifted = f.shifted(low);
    let mut binomial = Rational::from(1);
    let degree = count.saturating_sub(1);
    let mut all = Vec::with_capacity(count);
    for k in 0..count {
        // a_k width^k / C(d, k), then sums with binomials.
        all.push(shifted.coeff(k) * &power / &binomial);
        power *= &width;
        binomial = binomial * Rational::from((degree - k) as u64) / Rational::from((k + 1) as u64);
        if binomial == 0 {
            binomial = Rational::from(1);
        }
    }
    for step in 1..count {
        for k in (step..count).rev() {
            let below = all[k - 1].clone();
            all[k] += below;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn quotients_and_signs() {
        let (p, q) = (Two::first(), Two::second());
        let one = Two::number(ratio(1, 1));
        let line = p.plus(&q.scale(&ratio(2, 1))).minus(&one);
        let f = line.times(&p.times(&p).plus(&q));
        assert_eq!(f.divided(&line), Some(p.times(&p).plus(&q)));
        assert_eq!((f.divided(&p), f.plus(&one).divided(&line)), (None, None));
        let unit = (ratio(0, 1), ratio(1, 1));
        // p² − pq + q² + 1/10 > 0 on the unit square; the line has both signs there.
        let g = p.times(&p).minus(&p.times(&q)).plus(&q.times(&q)).plus(&Two::number(ratio(1, 1)));
        assert_eq!((g.strict_sign(&unit, &unit), line.strict_sign(&unit, &unit)), (Some(1), None));
        assert_eq!(line.strict_sign(&(ratio(0, 1), ratio(1, 5)), &(ratio(0, 1), ratio(1, 5))), Some(-1));
        assert_eq!(line.scale(&ratio(-3, 7)).primitive(), line);
        assert_eq!(line.display(["a", "b"]), "2b + a - 1");
        assert_eq!(line.solved().map(|f| f.display("a")), Some("-1/2a + 1/2".to_owned()));
        assert_eq!(line.swapped().display(["a", "b"]), "b + 2a - 1");
        assert!(f.solved().is_none() && line.along(&line.solved().unwrap()).is_zero());
    }
}
