//! Forms that are positive on the differences between parts of a star that do not meet (docs/certificate.md, section 8.1).

use super::cones::Part;
use crate::base::{Checked, Matrix, need, some, spend};
use crate::curve::Model;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive};

/// Most pairs of cells of a star, and how often its parts are divided at most.
const MAX_PAIRS: (usize, usize) = (40_000, 8);
/// Binary digits of values of the form, and of the room for points of smaller cells.
const DIGITS: (u64, u64) = (116, 3);

/// A cell: its face, how deep it lies, the map from its points, and points that hold it, rounded down to multiples of a unit, with
/// what the form makes of each and of each two of them.
struct Cell {
    face: usize,
    depth: usize,
    map: Matrix,
    below: Vec<usize>,
    points: Vec<Vec<i128>>,
    images: Vec<Vec<i128>>,
    own: Vec<Vec<i128>>,
}

struct Cells<'a> {
    model: &'a Model<'a>,
    form: Vec<Vec<i128>>,
    /// The sum of the moduli of the entries of the form.
    sum: i128,
    /// Points are multiplied by a power of two, and stay below this bound then.
    shift: u64,
    limit: i128,
    list: Vec<Cell>,
}

/// Rule `apart`: the parts are divided until for each two cells of parts that do not meet the form is seen to be positive on all
/// differences, by the points that hold them.
pub fn check(model: &Model<'_>, charts: &[Matrix], faces: &[usize], parts: &[Part], form: &Matrix) -> Checked<()> {
    need(form.den == BigInt::from(1), "apart", "the entries of a form are integers")?;
    let rows = |i: usize| form.integers(i).iter().map(ToPrimitive::to_i128).collect::<Option<Vec<_>>>();
    let entries: Option<Vec<_>> = (0..form.rows).map(rows).collect();
    let sum: BigInt = form.data.iter().map(Signed::abs).sum::<BigInt>() + 1;
    let room = DIGITS.0.checked_sub(sum.bits()).map(|left| left / 2);
    let (entries, room) = (some(entries, "limit", "long entries")?, some(room, "limit", "long entries")?);
    let sum = some(sum.to_i128(), "limit", "long entries")?;
    let mut cells = Cells { model, form: entries, sum, shift: 0, limit: 1 << room, list: Vec::new() };
    let mut maps = Vec::new();
    let mut size = 1;
    for part in parts {
        let [cell, letter] = part.from;
        let map = charts[cell].times(&model.shape.states[faces[cell]].pieces[letter].op)?;
        let points = map.times(&model.hull(part.face)?)?;
        let largest = some(points.data.iter().map(Signed::abs).max(), "apart", "a face without points")? / &points.den;
        size = size.max(largest.bits() + 1);
        maps.push(map);
    }
    cells.shift = some(room.checked_sub(size + DIGITS.1), "limit", "points that are far away")?;
    for (part, map) in parts.iter().zip(maps) {
        cells.add(part.face, 0, map)?;
    }
    let mut open: Vec<(usize, usize)> = Vec::new();
    for a in 0..parts.len() {
        open.extend((0..a).filter(|&b| !parts[a].meets(&parts[b])).map(|b| (a, b)));
    }
    let mut pairs = 0;
    while let Some((a, b)) = open.pop() {
        pairs += 1;
        need(pairs <= MAX_PAIRS.0, "limit", "too many pairs of cells")?;
        if !cells.positive(a, b)? {
            let (first, second) = (cells.below(a)?, cells.below(b)?);
            open.extend(first.iter().flat_map(|&x| second.iter().map(move |&y| (x, y))));
        }
    }
    Ok(())
}

impl Cells<'_> {
    fn add(&mut self, face: usize, depth: usize, map: Matrix) -> Checked<usize> {
        let hull = map.times(&self.model.hull(face)?)?;
        let mut points = Vec::new();
        for j in 0..hull.cols {
            let mut point = Vec::new();
            for i in 0..hull.rows {
                let x = (&hull.data[i * hull.cols + j] << self.shift).div_floor(&hull.den).to_i128();
                let x = some(x, "limit", "points that are far away")?;
                need(x.abs() < self.limit, "limit", "points that are far away")?;
                point.push(x);
            }
            points.push(point);
        }
        let n = self.form.len();
        spend(points.len() * n * (n + points.len()), 0)?;
        let images: Vec<Vec<i128>> =
            points.iter().map(|p| self.form.iter().map(|row| product(row, p)).collect()).collect();
        let own = images.iter().map(|x| points.iter().map(|y| product(x, y)).collect()).collect();
        self.list.push(Cell { face, depth, map, below: Vec::new(), points, images, own });
        Ok(self.list.len() - 1)
    }

    /// The pieces of a cell.
    fn below(&mut self, cell: usize) -> Checked<Vec<usize>> {
        if self.list[cell].below.is_empty() {
            let (face, depth) = (self.list[cell].face, self.list[cell].depth + 1);
            need(
                depth <= MAX_PAIRS.1,
                "apart",
                "the form is not seen to be positive on differences of parts that do not meet",
            )?;
            let model = self.model;
            for piece in &model.shape.states[face].pieces {
                let map = self.list[cell].map.times(&piece.op)?;
                let added = self.add(piece.target, depth, map)?;
                self.list[cell].below.push(added);
            }
        }
        Ok(self.list[cell].below.clone())
    }

    /// For points `a_i`, `b_j` of the two cells, `2 q(Σ λ_i a_i − Σ μ_j b_j)` is a mean of `2 q(a_i, a_k) + 2 q(b_j, b_l) − q(a_i, b_j)
    /// − q(a_i, b_l) − q(a_k, b_j) − q(a_k, b_l)`; rounding moves each value of `q` by at most `(2 limit + 1) sum`.
    fn positive(&self, a: usize, b: usize) -> Checked<bool> {
        let (a, b) = (&self.list[a], &self.list[b]);
        let (m, n) = (a.points.len(), b.points.len());
        // Most that are not positive are left early.
        spend(m * n * self.form.len() / 8 + m * m * n * n / 64, 0)?;
        let mixed: Vec<Vec<i128>> = a.images.iter().map(|x| b.points.iter().map(|y| product(x, y)).collect()).collect();
        let error = 8 * self.sum * (2 * self.limit + 1);
        for (i, row) in mixed.iter().enumerate() {
            for (k, other) in mixed.iter().enumerate().skip(i) {
                let both: Vec<i128> = row.iter().zip(other).map(|(x, y)| x + y).collect();
                let first = 2 * a.own[i][k] - error;
                for (own, here) in b.own.iter().zip(&both) {
                    if own.iter().zip(&both).any(|(x, y)| first - here + 2 * x - y <= 0) {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(true)
    }
}

fn product(a: &[i128], b: &[i128]) -> i128 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
