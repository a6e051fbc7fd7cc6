//! Regularity of the limits of a mask on a lattice (theory, Theorem 14): the window and the quotient are built again from the mask;
//! bounds of a joint spectral radius, the orders that follow, and why shifts are stable.

pub mod border;
mod read;
mod torus;

use crate::base::{Accepted, Checked, Matrix, Node, Q, Verdict, bits, need, some, spend, whole};
use crate::claim::{Claim, Decided};
use crate::jsr::{System, bounds};
use num_traits::{One, ToPrimitive, Zero};
use read::{Mask, minus, plus};

/// Highest order of sum rules.
const MAX_RULES: usize = 12;
/// Most points of a window.
const MAX_WINDOW: usize = 256;

/// Checks the proof of a certificate of the kind `lattice`.
pub fn check(source: &str, node: &Node<'_>) -> Checked<Accepted> {
    let mask = Mask::read(source)?;
    let Proved { claims, blocks } = proved(&mask, node)?;
    Ok(Accepted { case: mask.name, verdict: Verdict::Proved, claims, points: blocks })
}

/// What is said of blocks of a radius.
type Proof = Vec<Decided>;

/// What is proved about a mask.
struct Proved {
    claims: Vec<Decided>,
    blocks: Proof,
}

fn proved(mask: &Mask, node: &Node<'_>) -> Checked<Proved> {
    let [rules, window, radius, shifts, orders] = node.fields("rules window radius shifts orders")?;
    let k = rules.index(MAX_RULES + 1)?;
    rules.need(k > 0, "rules", "sum rules of order 1 at least are needed")?;
    for degree in 0..k {
        rules.need(mask.keeps(degree)?, "rules", format_args!("the sum rules of order {} fail", degree + 1))?;
    }
    let whole_rules = !mask.keeps(k)?;
    let points = read_points(&window, mask.dilation.dimensions())?;
    let window = Window { mask, points, degree: k - 1 };
    node.at(window.check())?;
    let letters = node.at(window.quotient())?;
    let dims = vec![letters[0].rows];
    let arrows = letters.into_iter().map(|m| (0, 0, m)).collect();
    let found = bounds(&System { name: String::new(), dims, arrows }, &(), &radius)?;
    let size = Size { low: found.lower, high: found.upper, mask };
    let stable = !shifts.is_null();
    if stable {
        shifts.need(size.is_below(0)?, "shifts", "the radius is not below 1: there need not be a limit function")?;
        shifts.at(window.stable(&shifts))?;
    }
    let mut claims = Vec::new();
    for (order, item) in orders.list()?.iter().enumerate() {
        orders.need(
            order <= k && claims.len() == order,
            "orders",
            "no order after one that fails, or beyond the sum rules",
        )?;
        match item.text()? {
            "smooth" => {
                item.need(
                    order < k && size.is_below(order)?,
                    "orders",
                    "the radius is not below the bound of this order",
                )?;
                claims.push(Claim::LatticeSmooth { order }.is(Verdict::Proved));
            }
            "rough" => {
                let known = order < k && (order == 0 || stable) && size.is_at_least(order)?;
                item.need(
                    known,
                    "orders",
                    "the radius does not reach the bound, or shifts are not proved to be stable",
                )?;
                claims.push(Claim::LatticeSmooth { order }.is(Verdict::Refuted));
                break;
            }
            "rules" => {
                let known = order == k && stable && whole_rules;
                item.need(known, "orders", "sum rules of a higher order hold, or shifts are not proved to be stable")?;
                claims.push(Claim::LatticeSmooth { order }.is(Verdict::Refuted));
                break;
            }
            _ => return item.reject("format", "an order is `smooth`, `rough` or `rules`"),
        }
    }
    let listed = orders.list()?.len();
    orders.need(listed > 0 && listed == claims.len(), "orders", "an order at least, and none after one that fails")?;
    if size.is_below(0)? {
        let (dimensions, index) = (mask.dilation.dimensions(), mask.dilation.digits.len());
        let (low, high) = (size.low.clone(), size.high.clone());
        let exact = stable && whole_rules;
        claims.push(Claim::LatticeExponent { dimensions, index, low, high, exact }.is(Verdict::Proved));
    }
    Ok(Proved { claims, blocks: found.blocks })
}

/// The points of a window, ascending.
fn read_points(node: &Node<'_>, s: usize) -> Checked<Vec<Vec<i64>>> {
    let points = node.each(|p| read_point(p, s))?;
    let ascending = points.windows(2).all(|w| w[0] < w[1]);
    node.need(
        ascending && (1..=MAX_WINDOW).contains(&points.len()),
        "window",
        "1 to 256 points are needed, ascending",
    )?;
    Ok(points)
}

fn read_point(node: &Node<'_>, s: usize) -> Checked<Vec<i64>> {
    let parts = node.vector(s)?;
    let small = |x: &Q| if x.is_integer() { x.to_integer().to_i64().filter(|k| k.abs() < 1 << 20) } else { None };
    node.some(parts.iter().map(small).collect(), "format", "a point of the lattice is needed here")
}

/// Exponents of the monomials of degree up to `degree`, or of that degree only.
fn monomials(s: usize, degree: usize, only: bool) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..s {
        let longer = |a: &Vec<usize>| {
            let used: usize = a.iter().sum();
            let a = a.clone();
            (0..=degree - used).map(move |k| [a.as_slice(), &[k]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all.retain(|a| !only || a.iter().sum::<usize>() == degree);
    all
}

fn value(exponent: &[usize], at: &[i64]) -> Q {
    exponent.iter().zip(at).fold(Q::one(), |p, (e, x)| p * num_traits::pow(whole(*x), *e))
}

/// The values of the monomials (rows) at points (columns).
fn values(degree: usize, points: &[&Vec<i64>]) -> Checked<Matrix> {
    let s = some(points.first(), "window", "no points")?.len();
    let rows: Vec<Vec<Q>> =
        monomials(s, degree, false).iter().map(|a| points.iter().map(|p| value(a, p)).collect()).collect();
    spend(rows.len() * points.len(), 256)?;
    Ok(Matrix::from_rows(points.len(), &rows))
}

impl Mask {
    /// Whether all cosets have the same moments of this degree, of degree 0 equal to 1.
    fn keeps(&self, degree: usize) -> Checked<bool> {
        let s = self.dilation.dimensions();
        for exponent in monomials(s, degree, true) {
            let mut sums = vec![Q::zero(); self.dilation.digits.len()];
            for (a, c) in &self.terms {
                let coset = self.dilation.digits.iter().position(|d| self.dilation.divide(&minus(a, d)).is_some());
                let coset = some(coset, "case", "a point in no coset")?;
                spend(8, bits(c) + 256)?;
                sums[coset] += c * value(&exponent, a);
            }
            let equal = sums.iter().all(|x| *x == sums[0]);
            if !equal || degree == 0 && !sums[0].is_one() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// Operators modulo a space of nets, the rows: of a net its values at the points that are no leading columns of their echelon form,
/// after that multiple of each row is taken off which makes the value at its leading column 0.
fn modulo(nets: &Matrix, operators: &[Matrix]) -> Checked<Vec<Matrix>> {
    let (rows, pivots) = nets.echelon()?;
    let free: Vec<usize> = (0..nets.cols).filter(|j| !pivots.contains(j)).collect();
    need(!free.is_empty(), "window", "nothing is left of the nets on the window")?;
    let mut letters = Vec::new();
    for operator in operators {
        let turned = operator.transpose();
        let kept = turned.columns(&free).transpose();
        let taken = rows.columns(&free).transpose().times(&turned.columns(&pivots).transpose())?;
        let whole = kept.minus(&taken);
        need(whole.times(&rows.transpose())?.is_zero(), "window", "polynomials are not kept")?;
        letters.push(whole.columns(&free));
    }
    Ok(letters)
}

/// A window with the degree of the polynomials.
struct Window<'a> {
    mask: &'a Mask,
    points: Vec<Vec<i64>>,
    degree: usize,
}

impl Window<'_> {
    fn holds(&self, a: &[i64]) -> bool {
        self.points.binary_search_by(|p| p.as_slice().cmp(a)).is_ok()
    }

    /// New points depend on points of the window only, and neighbouring windows overlap enough.
    fn check(&self) -> Checked<()> {
        let dilation = &self.mask.dilation;
        spend(self.points.len() * dilation.digits.len() * self.mask.terms.len(), 0)?;
        for i in &self.points {
            for d in &dilation.digits {
                for a in self.mask.terms.keys() {
                    if let Some(j) = dilation.divide(&minus(&plus(i, d), a)) {
                        need(self.holds(&j), "window", format_args!("the point {j:?} is missing"))?;
                    }
                }
            }
        }
        let full = monomials(dilation.dimensions(), self.degree, false).len();
        for axis in 0..dilation.dimensions() {
            let before = |p: &&Vec<i64>| {
                let mut q = (*p).clone();
                q[axis] -= 1;
                self.holds(&q)
            };
            let common: Vec<&Vec<i64>> = self.points.iter().filter(before).collect();
            let enough = common.len() >= full && values(self.degree, &common)?.rank()? == full;
            need(enough, "window", format_args!("windows one step along axis {axis} apart do not overlap enough"))?;
        }
        Ok(())
    }

    /// `m(i + d − Mj)`.
    fn operator(&self, digit: &[i64]) -> Matrix {
        let dilation = &self.mask.dilation;
        let row = |i: &Vec<i64>| {
            self.points.iter().map(|j| self.mask.at(&minus(&plus(i, digit), &dilation.apply(j)))).collect::<Vec<Q>>()
        };
        Matrix::from_rows(self.points.len(), &self.points.iter().map(row).collect::<Vec<_>>())
    }

    /// The operators modulo polynomials.
    fn quotient(&self) -> Checked<Vec<Matrix>> {
        let all: Vec<&Vec<i64>> = self.points.iter().collect();
        let operators: Vec<Matrix> = self.mask.dilation.digits.iter().map(|d| self.operator(d)).collect();
        modulo(&values(self.degree, &all)?, &operators)
    }

    /// Why the shifts of the limit function are stable.
    fn stable(&self, node: &Node<'_>) -> Checked<()> {
        match node.tag("stable")? {
            "interpolatory" => {
                let [_, at] = node.fields("stable at")?;
                let at = read_point(&at, self.points[0].len())?;
                node.need(
                    self.mask.is_alone(&at),
                    "shifts",
                    "the mask is not 1 at this point and 0 at the rest of its coset",
                )
            }
            "unimodular" => {
                let [_] = node.fields("stable")?;
                node.need(
                    self.mask.is_unimodular()?,
                    "shifts",
                    "the case names no directions of a box spline that show it",
                )
            }
            "samples" => {
                let [_, words, charts] = node.fields("stable words charts")?;
                let operators: Vec<Matrix> = self.mask.dilation.digits.iter().map(|d| self.operator(d)).collect();
                torus::check(&self.points, &operators, &words, &charts)
            }
            _ => node.reject("format", "unknown reason why shifts are stable"),
        }
    }
}

/// Bounds of the radius `J`, compared with powers of `|det M|^(1/s)`.
struct Size<'a> {
    low: Q,
    high: Q,
    mask: &'a Mask,
}

impl Size<'_> {
    fn scaled(&self, x: &Q, order: usize) -> Checked<Q> {
        let dilation = &self.mask.dilation;
        spend(64, 4 * bits(x) + 8 * order as u64)?;
        let index = some(i64::try_from(dilation.digits.len()).ok(), "limit", "too many cosets")?;
        Ok(num_traits::pow(x.clone(), dilation.dimensions()) * num_traits::pow(whole(index), order))
    }

    /// Whether `J^s |det M|^order < 1`.
    fn is_below(&self, order: usize) -> Checked<bool> {
        Ok(self.scaled(&self.high, order)? < Q::one())
    }

    /// Whether `J^s |det M|^order >= 1`.
    fn is_at_least(&self, order: usize) -> Checked<bool> {
        Ok(self.scaled(&self.low, order)? >= Q::one())
    }
}
