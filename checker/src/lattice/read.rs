//! Reads a mask on a lattice from a case, with its dilation.

use crate::base::{Checked, Node, Q, file, need, number, some, whole, word};
use num_traits::{One, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// Most dimensions.
const MAX_DIMENSIONS: usize = 4;
/// Largest entry of a dilation, and largest determinant.
const MAX_ENTRY: i64 = 64;
/// Largest coordinate of a point.
const MAX_PLACE: i64 = 1000;
/// Most coefficients.
const MAX_COEFFICIENTS: usize = 4096;
/// Most directions of a box spline.
const MAX_DIRECTIONS: usize = 24;

/// A mask with its dilation.
pub struct Mask {
    /// The name of the case.
    pub name: String,
    /// The coefficients that are not 0.
    pub terms: BTreeMap<Vec<i64>, Q>,
    /// The dilation.
    pub dilation: Dilation,
    /// The directions, where it is said to be that of a box spline; that it is one is checked where they are used.
    pub directions: Option<Vec<Vec<i64>>>,
}

/// An integer matrix, diagonalisable and with eigenvalues of one modulus above 1, and a point of every coset.
pub struct Dilation {
    rows: Vec<Vec<i64>>,
    determinant: i64,
    adjugate: Vec<Vec<i64>>,
    /// In the order in which steps along the axes reach new cosets from 0.
    pub digits: Vec<Vec<i64>>,
}

impl Mask {
    /// Reads a case with a grid of coefficients.
    pub fn read(source: &str) -> Checked<Self> {
        file(source, "name title source mask", |node| {
            let name = some(word(node, "name")?, "case", "a name is needed")?.to_owned();
            let mask = node.field("mask")?;
            mask.known("dilation grid origin directions")?;
            Self::table(&name, &mask)
        })
    }

    /// Reads a table with a grid of coefficients.
    pub fn table(name: &str, mask: &Node<'_>) -> Checked<Self> {
        let name = name.to_owned();
        let origin = places(&mask.field("origin")?)?;
        let s = origin.len();
        mask.need((1..=MAX_DIMENSIONS).contains(&s), "case", "1 to 4 dimensions are read")?;
        let dilation = match mask.get("dilation") {
            Some(node) => node.at(Dilation::new(node.each(places)?))?,
            None => Dilation::new((0..s).map(|i| (0..s).map(|j| if i == j { 2 } else { 0 }).collect()).collect())?,
        };
        mask.need(dilation.rows.len() == s, "case", "the dilation has another dimension than the grid")?;
        let (mut terms, mut place) = (BTreeMap::new(), Vec::new());
        grid(&mask.field("grid")?, &origin, &mut place, &mut terms)?;
        let directions = match mask.get("directions") {
            Some(node) => Some(node.each(places)?),
            None => None,
        };
        Ok(Self { name, terms, dilation, directions })
    }

    /// The coefficient at a point.
    pub fn at(&self, a: &[i64]) -> Q {
        match self.terms.get(a) {
            Some(c) => c.clone(),
            None => Q::zero(),
        }
    }

    /// Whether the coset of a point has no other coefficient than a 1 there.
    pub fn is_alone(&self, at: &[i64]) -> bool {
        let same = |a: &&Vec<i64>| self.dilation.divide(&minus(a, at)).is_some();
        self.terms.keys().filter(same).eq([&at.to_vec()]) && self.at(at).is_one()
    }

    /// Whether this is a shift of the mask of a box spline, with twice the unit matrix as dilation, whose directions span the space
    /// and have only determinants 0, 1 and −1.
    pub fn is_unimodular(&self) -> Checked<bool> {
        let Some(directions) = &self.directions else { return Ok(false) };
        let s = self.dilation.rows.len();
        let twice = (0..s).all(|i| (0..s).all(|j| self.dilation.rows[i][j] == if i == j { 2 } else { 0 }));
        let fits = |v: &Vec<i64>| v.len() == s && v.iter().any(|x| *x != 0);
        if !twice || !(1..=MAX_DIRECTIONS).contains(&directions.len()) || !directions.iter().all(fits) {
            return Ok(false);
        }
        let mut product: BTreeMap<Vec<i64>, Q> = [(vec![0; s], num_traits::pow(whole(2), s))].into();
        for v in directions {
            let mut next: BTreeMap<Vec<i64>, Q> = BTreeMap::new();
            for (a, c) in &product {
                for b in [a.clone(), a.iter().zip(v).map(|(x, y)| x + y).collect()] {
                    *next.entry(b).or_insert_with(Q::zero) += c / whole(2);
                }
            }
            need(next.len() <= MAX_COEFFICIENTS, "limit", "too many coefficients")?;
            product = next;
        }
        // Both are moved so that their first points are equal.
        let same = match (product.keys().next(), self.terms.keys().next()) {
            (Some(p), Some(q)) => {
                let moved = |a: &Vec<i64>| a.iter().zip(p).zip(q).map(|((x, y), z)| x - y + z).collect::<Vec<i64>>();
                product
                    .iter()
                    .map(|(a, c)| (moved(a), c.clone()))
                    .eq(self.terms.iter().map(|(a, c)| (a.clone(), c.clone())))
            }
            _ => false,
        };
        let mut determinants = Vec::new();
        choices(directions, s, &mut Vec::new(), &mut determinants);
        Ok(same && determinants.iter().all(|d| d.abs() <= 1) && determinants.iter().any(|d| *d != 0))
    }
}

fn choices(rest: &[Vec<i64>], s: usize, chosen: &mut Vec<Vec<i64>>, found: &mut Vec<i64>) {
    if chosen.len() == s {
        found.push(determinant(chosen));
        return;
    }
    for k in 0..rest.len() {
        chosen.push(rest[k].clone());
        choices(&rest[k + 1..], s, chosen, found);
        chosen.pop();
    }
}

/// By the first row; of at most four rows.
fn determinant(rows: &[Vec<i64>]) -> i64 {
    let n = rows.len();
    if n == 0 {
        return 1;
    }
    (0..n)
        .map(|k| if k.is_multiple_of(2) { rows[0][k] * minor(rows, 0, k) } else { -rows[0][k] * minor(rows, 0, k) })
        .sum()
}

fn minor(rows: &[Vec<i64>], i: usize, j: usize) -> i64 {
    let without = |skip: usize, n: usize| (0..n).filter(move |k| *k != skip);
    let n = rows.len();
    determinant(&without(i, n).map(|a| without(j, n).map(|b| rows[a][b]).collect()).collect::<Vec<Vec<i64>>>())
}

/// A list of whole numbers.
fn places(node: &Node<'_>) -> Checked<Vec<i64>> {
    node.each(|x| {
        let value = number(x)?;
        let small = if value.is_integer() { value.to_integer().to_i64() } else { None };
        x.some(small.filter(|k| k.abs() <= MAX_PLACE), "case", "a whole number of at most 1000 is needed here")
    })
}

fn grid(node: &Node<'_>, origin: &[i64], place: &mut Vec<i64>, terms: &mut BTreeMap<Vec<i64>, Q>) -> Checked<()> {
    if place.len() == origin.len() {
        let c = number(node)?;
        if !c.is_zero() {
            terms.insert(place.clone(), c);
        }
        return node.need(terms.len() <= MAX_COEFFICIENTS, "limit", "too many coefficients");
    }
    for (item, k) in node.list()?.iter().zip(origin[place.len()]..) {
        place.push(k);
        grid(item, origin, place, terms)?;
        place.pop();
    }
    Ok(())
}

/// `a − b`.
pub fn minus(a: &[i64], b: &[i64]) -> Vec<i64> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

/// `a + b`.
pub fn plus(a: &[i64], b: &[i64]) -> Vec<i64> {
    a.iter().zip(b).map(|(x, y)| x + y).collect()
}

impl Dilation {
    fn new(rows: Vec<Vec<i64>>) -> Checked<Self> {
        let s = rows.len();
        let square = (1..=MAX_DIMENSIONS).contains(&s) && rows.iter().all(|r| r.len() == s);
        need(square, "case", "a dilation is a square matrix of at most 4 rows")?;
        need(rows.iter().flatten().all(|x| x.abs() <= MAX_ENTRY), "case", "an entry of the dilation is too large")?;
        let determinant = determinant(&rows);
        need((2..=MAX_ENTRY).contains(&determinant.abs()), "case", "the determinant is not from 2 to 64 in modulus")?;
        need(is_similarity(&rows, determinant), "case", "the dilation is no similarity in any coordinates")?;
        let cofactor =
            |i: usize, j: usize| if (i + j).is_multiple_of(2) { minor(&rows, j, i) } else { -minor(&rows, j, i) };
        let adjugate = (0..s).map(|i| (0..s).map(|j| cofactor(i, j)).collect()).collect();
        let mut made = Self { rows, determinant, adjugate, digits: vec![vec![0; s]] };
        let mut next = 0;
        while next < made.digits.len() {
            for axis in 0..s {
                let mut step = made.digits[next].clone();
                step[axis] += 1;
                if made.digits.iter().all(|d| made.divide(&minus(&step, d)).is_none()) {
                    made.digits.push(step);
                }
            }
            next += 1;
        }
        let all = i64::try_from(made.digits.len()).is_ok_and(|n| n == made.determinant.abs());
        need(all, "case", "the cosets are not as many as the determinant says")?;
        Ok(made)
    }

    /// The number of dimensions.
    pub fn dimensions(&self) -> usize {
        self.rows.len()
    }

    /// `M a`.
    pub fn apply(&self, a: &[i64]) -> Vec<i64> {
        times(&self.rows, a)
    }

    /// `M^{-1} a` where that is a point of the lattice.
    pub fn divide(&self, a: &[i64]) -> Option<Vec<i64>> {
        let scaled = times(&self.adjugate, a);
        let whole = scaled.iter().all(|x| x % self.determinant == 0);
        whole.then(|| scaled.iter().map(|x| x / self.determinant).collect())
    }
}

fn times(rows: &[Vec<i64>], a: &[i64]) -> Vec<i64> {
    rows.iter().map(|row| row.iter().zip(a).map(|(x, y)| x * y).sum()).collect()
}

/// Whether a power up to the 24th is a multiple of the unit matrix, or two eigenvalues are conjugate and not real: then the matrix
/// is diagonalisable and its eigenvalues have one modulus.
fn is_similarity(rows: &[Vec<i64>], determinant: i64) -> bool {
    let s = rows.len();
    if s == 2 && (rows[0][0] + rows[1][1]).pow(2) < 4 * determinant {
        return true;
    }
    let wide = |x: i64| Q::from_integer(x.into());
    let own: Vec<Vec<Q>> = rows.iter().map(|r| r.iter().map(|x| wide(*x)).collect()).collect();
    let mut power = own.clone();
    for _ in 0..24 {
        let scalar =
            (0..s).all(|i| (0..s).all(|j| if i == j { power[i][j] == power[0][0] } else { power[i][j].is_zero() }));
        if scalar {
            return true;
        }
        let entry = |i: usize, j: usize| (0..s).fold(Q::zero(), |sum, k| sum + &power[i][k] * &own[k][j]);
        power = (0..s).map(|i| (0..s).map(|j| entry(i, j)).collect()).collect();
    }
    false
}
