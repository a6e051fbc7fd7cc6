//! Smoothness across a border between two masks (theory, Theorem 15): the operators over both halves of an edge, and the nets that
//! are polynomials on either side, are built again from the case.

use super::read::Mask;
use super::{MAX_RULES, Proof, modulo, monomials, proved, read_points};
use crate::base::{Accepted, Checked, Matrix, Node, Q, Verdict, file, items, need, number, some, spend, whole, word};
use crate::claim::Claim;
use crate::jsr::{System, bounds};
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// Farthest column with weights of its own, and farthest that these read.
const MAX_COLUMN: i64 = 6;
/// Largest reach.
const MAX_REACH: usize = 12;

type Weights = Vec<(Vec<i64>, Q)>;

/// Two masks, where column 1 lies on either side, and weights by column and row modulo 2.
struct Border {
    name: String,
    sides: [Mask; 2],
    places: [[Q; 2]; 2],
    own: BTreeMap<(i64, i64), Weights>,
}

/// Checks the proof of a certificate of the kind `border`.
pub fn check(source: &str, node: &Node<'_>) -> Checked<Accepted> {
    let border = Border::read(source)?;
    let [sides, orders] = node.fields("sides orders")?;
    let list = sides.exactly(2, "format")?;
    let sides = [proved(&border.sides[0], &list[0])?, proved(&border.sides[1], &list[1])?];
    let says = |k: usize, order: usize, verdict: Verdict| {
        sides[k].claims.iter().any(|d| d.claim == Claim::LatticeSmooth { order } && d.verdict == verdict)
    };
    let (mut claims, mut blocks) = (Vec::new(), Vec::new());
    let listed = orders.list()?;
    orders.need((1..=MAX_RULES + 1).contains(&listed.len()), "orders", "an order at least is needed")?;
    for (order, item) in listed.iter().enumerate() {
        let tag = item.tag("by")?;
        if let Some(k) = ["left", "right"].iter().position(|word| *word == tag) {
            let [_] = item.fields("by")?;
            item.need(
                says(k, order, Verdict::Refuted),
                "orders",
                "the limits on this side are not proved to be rough",
            )?;
            claims.push(Claim::BorderSmooth { order }.is(Verdict::Refuted));
            break;
        }
        let both = (0..2).all(|k| says(k, order, Verdict::Proved));
        item.need(both, "orders", "the limits on both sides are not proved to be of this order")?;
        let [_, reach, window, radius] = item.fields("by reach window radius")?;
        let model = item.at(Model::new(&border, read_points(&window, 2)?, reach.index(MAX_REACH + 1)?, order))?;
        match tag {
            "radius" => {
                let n = monomials(2, order, false).len();
                let free = kernel(&model.equal.part(0..n, 0..model.equal.cols))?.cols;
                item.need(free == 0, "window", "the sides do not determine the points on the border")?;
                let found = model.below(&model.equal, &radius, order)?;
                blocks.extend(found);
                claims.push(Claim::BorderSmooth { order }.is(Verdict::Proved));
            }
            "jump" => {
                item.need(model.pairs.cols > model.equal.cols, "orders", "both polynomials are equal in all triples")?;
                claims.push(Claim::BorderSmooth { order }.is(Verdict::Refuted));
                if !radius.is_null() {
                    blocks.extend(model.below(&model.pairs, &radius, order)?);
                    claims.push(Claim::BorderSided { order }.is(Verdict::Proved));
                }
                break;
            }
            _ => return item.reject("format", "an order is known by `radius`, `jump`, `left` or `right`"),
        }
    }
    let used = claims.iter().filter(|d| matches!(d.claim, Claim::BorderSmooth { .. })).count();
    orders.need(used == listed.len(), "orders", "none after one that fails")?;
    Ok(Accepted { case: border.name, verdict: Verdict::Proved, claims, points: blocks })
}

impl Border {
    fn read(source: &str) -> Checked<Self> {
        file(source, "name title source border", |node| {
            let name = some(word(node, "name")?, "case", "a name is needed")?.to_owned();
            let table = node.field("border")?;
            table.known("left right stencil")?;
            let mut sides = Vec::new();
            for key in ["left", "right"] {
                let side = table.field(key)?;
                side.known("grid origin place")?;
                let mask = side.at(Mask::table(&name, &side))?;
                let twice = mask.dilation.dimensions() == 2 && mask.dilation.apply(&[1, 0]) == [2, 0];
                side.need(
                    twice && mask.dilation.apply(&[0, 1]) == [0, 2],
                    "case",
                    "the dilation is not twice the unit",
                )?;
                let place = side.field("place")?.each(number)?;
                let place = side.some(<[Q; 2]>::try_from(place).ok(), "case", "two coordinates are needed")?;
                side.need(place[0].is_positive(), "case", "column 1 lies at a positive distance")?;
                sides.push((mask, place));
            }
            let mut own = BTreeMap::new();
            for item in items(&table, "stencil")? {
                item.known("at weights")?;
                let at = small(&item.field("at")?.each(number)?)?;
                let [column, phase] = item.some(<[i64; 2]>::try_from(at).ok(), "case", "a column and a row")?;
                let weights = item.field("weights")?.each(read_weight)?;
                let sum = weights.iter().fold(Q::zero(), |s, (_, c)| s + c);
                let near = weights.iter().all(|(a, _)| a.iter().all(|x| x.abs() <= MAX_COLUMN));
                let fits = column.abs() <= MAX_COLUMN && (0..2).contains(&phase) && near && sum.is_one();
                item.need(fits, "case", "weights near the border that sum to 1 are needed")?;
                item.need(own.insert((column, phase), weights).is_none(), "case", "weights twice")?;
            }
            table.need((0..2).all(|s| own.contains_key(&(0, s))), "case", "column 0 has weights of its own")?;
            let (right, left) = (some(sides.pop(), "case", "a side")?, some(sides.pop(), "case", "a side")?);
            let made = Self { name, sides: [left.0, right.0], places: [left.1, right.1], own };
            made.stays()?;
            Ok(made)
        })
    }

    /// The rules of masks read nothing across the border; columns beyond the largest exponents need no test.
    fn stays(&self) -> Checked<()> {
        let exponents = self.sides.iter().flat_map(|m| m.terms.keys()).map(|a| a[0].abs());
        let most = exponents.fold(1, i64::max);
        for column in (-most..=most).filter(|c| *c != 0) {
            for row in 0..2 {
                let across = self.rule(column, row)?.iter().any(|(a, _)| a[0] * column < 0);
                need(self.own.contains_key(&(column, row)) || !across, "case", "a rule reads across the border")?;
            }
        }
        Ok(())
    }

    /// The old points on which a new one depends, with their weights.
    fn rule(&self, column: i64, row: i64) -> Checked<Weights> {
        if let Some(weights) = self.own.get(&(column, row.rem_euclid(2))) {
            return Ok(weights.iter().map(|(a, c)| (vec![a[0], a[1] + row.div_euclid(2)], c.clone())).collect());
        }
        need(column != 0, "case", "column 0 has weights of its own")?;
        let mask = &self.sides[usize::from(column > 0)];
        spend(mask.terms.len(), 64)?;
        let mut found = Vec::new();
        for (a, c) in &mask.terms {
            // The coefficients of other cosets belong to other new points.
            if let Some(old) = mask.dilation.divide(&[column - a[0], row - a[1]]) {
                found.push((old, c.clone()));
            }
        }
        Ok(found)
    }
}

fn small(numbers: &[Q]) -> Checked<Vec<i64>> {
    let one = |x: &Q| if x.is_integer() { x.to_integer().to_i64().filter(|k| k.abs() <= 1000) } else { None };
    some(numbers.iter().map(one).collect(), "case", "whole numbers of at most 1000 are needed")
}

fn read_weight(node: &Node<'_>) -> Checked<(Vec<i64>, Q)> {
    let numbers = node.each(number)?;
    node.need(numbers.len() == 3, "case", "a weight is [column, row, number]")?;
    Ok((small(&numbers[..2])?, numbers[2].clone()))
}

/// The values of the monomials of degree up to `degree` (columns) at points (rows).
fn table(degree: usize, points: &[[Q; 2]]) -> Checked<Matrix> {
    let all = monomials(2, degree, false);
    spend(points.len() * all.len(), 512)?;
    let value = |p: &[Q; 2], a: &Vec<usize>| num_traits::pow(p[0].clone(), a[0]) * num_traits::pow(p[1].clone(), a[1]);
    let rows: Vec<Vec<Q>> = points.iter().map(|p| all.iter().map(|a| value(p, a)).collect()).collect();
    Ok(Matrix::from_rows(all.len(), &rows))
}

fn place(p: &[i64]) -> [Q; 2] {
    [whole(p[0]), whole(p[1])]
}

/// The points whose coordinates are the exponents: they determine polynomials.
fn simplex(degree: usize) -> Vec<[Q; 2]> {
    let exact = |k: usize| Q::from_integer(k.into());
    monomials(2, degree, false).iter().map(|a| [exact(a[0]), exact(a[1])]).collect()
}

/// The coefficients of the polynomials with these values (columns) at the points of the simplex.
fn through(degree: usize, values: &Matrix) -> Checked<Matrix> {
    some(table(degree, &simplex(degree))?.solve(values)?, "window", "polynomials are not determined")
}

/// What the substitution `p(s (x, y + shift))` makes of coefficients.
fn substituted(degree: usize, scale: &Q, shift: i64) -> Checked<Matrix> {
    let moved: Vec<[Q; 2]> = simplex(degree).iter().map(|[x, y]| [x * scale, (y + whole(shift)) * scale]).collect();
    through(degree, &table(degree, &moved)?)
}

/// By the coefficients of `p` in the chart those of the net whose limit is `p`.
fn nets_of(mask: &Mask, at: &[Q; 2], degree: usize) -> Checked<Matrix> {
    let all = monomials(2, degree, false);
    let mut images = Vec::new();
    for a in &all {
        let point = [a[0] as i64, a[1] as i64];
        let mut row = Matrix::zeros(1, all.len());
        for (b, c) in &mask.terms {
            if let Some(old) = mask.dilation.divide(&[point[0] - b[0], point[1] - b[1]]) {
                row = row.plus(c, &table(degree, &[place(&old)])?);
            }
        }
        images.push(row);
    }
    let images = images.iter().fold(Matrix::empty(all.len()), |m, row| m.stack(row));
    let step = through(degree, &images)?;
    let charted: Vec<[Q; 2]> = simplex(degree).iter().map(|[c, r]| [c * &at[0], c * &at[1] + r]).collect();
    let chart = through(degree, &table(degree, &charted)?)?;
    let order = |a: &Vec<usize>| a.iter().sum::<usize>();
    let mut columns = Matrix::empty(all.len());
    for (j, a) in all.iter().enumerate() {
        let value = num_traits::pow(Q::new(1.into(), 2.into()), order(a));
        let shifted = step.minus(&Matrix::identity(all.len()).scaled(&value));
        let lower: Vec<usize> = (0..all.len()).filter(|k| order(&all[*k]) < order(a)).collect();
        let leading = chart.columns(&[j]);
        let right = shifted.times(&leading)?.scaled(&whole(-1));
        let mut net = leading;
        if lower.is_empty() {
            need(right.is_zero(), "window", "constants are not kept")?;
        } else {
            let rest = some(shifted.columns(&lower).solve(&right)?, "window", "polynomials are not kept")?;
            let full = |i: usize| match lower.iter().position(|k| *k == i) {
                Some(k) => rest.at(k, 0),
                None => Q::zero(),
            };
            let rows: Vec<Vec<Q>> = (0..all.len()).map(|i| vec![full(i)]).collect();
            net = net.plus(&Q::one(), &Matrix::from_rows(1, &rows));
        }
        columns = columns.stack(&net.transpose());
    }
    Ok(columns.transpose())
}

/// The vectors (columns) that rows kill.
fn kernel(rows: &Matrix) -> Checked<Matrix> {
    let (reduced, pivots) = rows.echelon()?;
    let free = (0..rows.cols).filter(|j| !pivots.contains(j));
    let mut found = Vec::new();
    for f in free {
        let mut v = vec![Q::zero(); rows.cols];
        v[f] = Q::one();
        for (i, p) in pivots.iter().enumerate() {
            v[*p] = -reduced.at(i, f);
        }
        found.push(v);
    }
    Ok(Matrix::from_rows(rows.cols, &found).transpose())
}

/// A window with its operators and the triples of two polynomials and a net.
struct Model {
    points: Vec<Vec<i64>>,
    operators: [Matrix; 2],
    nets: Matrix,
    pairs: Matrix,
    equal: Matrix,
}

impl Model {
    fn new(border: &Border, points: Vec<Vec<i64>>, reach: usize, degree: usize) -> Checked<Self> {
        let find = |p: &[i64]| points.binary_search_by(|q| q.as_slice().cmp(p)).ok();
        let far = some(i64::try_from(reach).ok(), "window", "too far")?;
        reaches(border, far)?;
        need((-far..=far).all(|c| find(&[c, 0]).is_some()), "window", "a column within the reach is missing")?;
        let mut operators = Vec::new();
        for half in 0..2 {
            let mut rows = Vec::new();
            for p in &points {
                let mut row = vec![Q::zero(); points.len()];
                for (old, c) in border.rule(p[0], p[1] + half)? {
                    row[some(find(&old), "window", format_args!("the point {old:?} is missing"))?] += c;
                }
                rows.push(row);
            }
            operators.push(Matrix::from_rows(points.len(), &rows));
        }
        let n = monomials(2, degree, false).len();
        let middle: Vec<usize> = (0..points.len()).filter(|i| points[*i][0] == 0).collect();
        let width = 2 * n + middle.len();
        let sides = [
            nets_of(&border.sides[0], &border.places[0], degree)?,
            nets_of(&border.sides[1], &border.places[1], degree)?,
        ];
        let mut rows = Vec::new();
        for (i, p) in points.iter().enumerate() {
            let mut row = vec![Q::zero(); width];
            if let Some(k) = middle.iter().position(|m| *m == i) {
                row[2 * n + k] = Q::one();
            } else {
                let side = usize::from(p[0] > 0);
                let values = table(degree, &[place(p)])?.times(&sides[side])?;
                (0..n).for_each(|j| row[side * n + j] = values.at(0, j));
            }
            rows.push(row);
        }
        let nets = Matrix::from_rows(width, &rows);
        let (mut broken, mut steps) = (Matrix::empty(width), Vec::new());
        for (half, operator) in (0..).zip(&operators) {
            let image = operator.times(&nets)?;
            let turned = substituted(degree, &Q::new(1.into(), 2.into()), half)?;
            let zero = |rows: usize, cols: usize| Matrix::zeros(rows, cols);
            let first = turned.beside(&zero(n, n + middle.len()));
            let second = zero(n, n).beside(&turned).beside(&zero(n, middle.len()));
            let mut step = first.stack(&second);
            for m in &middle {
                step = step.stack(&image.row(*m));
            }
            broken = broken.stack(&image.minus(&nets.times(&step)?));
            steps.push(step);
        }
        let apart = Matrix::identity(n).beside(&Matrix::identity(n).scaled(&whole(-1)));
        let apart = apart.beside(&Matrix::zeros(n, middle.len()));
        let pairs = kernel(&closed(&broken, &steps)?)?;
        let equal = kernel(&closed(&broken.stack(&apart), &steps)?)?;
        let (first, second) = (operators.remove(0), operators.remove(0));
        let made = Self { points, operators: [first, second], nets, pairs, equal };
        made.overlaps(degree)?;
        Ok(made)
    }

    /// Neighbouring windows with equal nets on their common points have the same polynomials.
    fn overlaps(&self, degree: usize) -> Checked<()> {
        let n = monomials(2, degree, false).len();
        let values = self.nets.times(&self.pairs)?;
        let mut rows = Matrix::empty(2 * values.cols);
        for (i, p) in self.points.iter().enumerate() {
            if let Ok(j) = self.points.binary_search(&vec![p[0], p[1] - 1]) {
                rows = rows.stack(&values.row(i).beside(&values.row(j).scaled(&whole(-1))));
            }
        }
        let same = kernel(&rows)?;
        let own = self.pairs.times(&same.part(0..values.cols, 0..same.cols))?;
        let next = self.pairs.times(&same.part(values.cols..2 * values.cols, 0..same.cols))?;
        let moved = substituted(degree, &Q::one(), 1)?;
        for k in 0..2 {
            let part = |m: &Matrix| m.part(k * n..(k + 1) * n, 0..m.cols);
            let fits = moved.times(&part(&own))?.minus(&part(&next)).is_zero();
            need(fits, "window", "neighbouring windows do not overlap enough")?;
        }
        Ok(())
    }

    /// Whether the radius modulo the nets of triples is below `2^-order`.
    fn below(&self, triples: &Matrix, radius: &Node<'_>, order: usize) -> Checked<Proof> {
        let letters = modulo(&self.nets.times(triples)?.transpose(), &self.operators)?;
        let dims = vec![letters[0].rows];
        let arrows = letters.into_iter().map(|m| (0, 0, m)).collect();
        let found = bounds(&System { name: String::new(), dims, arrows }, &(), radius)?;
        let bound = num_traits::pow(Q::new(1.into(), 2.into()), order);
        radius.need(found.upper < bound, "orders", "the radius is not below the bound of this order")?;
        Ok(found.blocks)
    }
}

/// The smallest space of rows with these that is kept by matrices from the right.
fn closed(rows: &Matrix, steps: &[Matrix]) -> Checked<Matrix> {
    let mut space = rows.echelon()?.0;
    loop {
        let mut next = space.clone();
        for step in steps {
            next = next.stack(&space.times(step)?);
        }
        let next = next.echelon()?.0;
        if next.rows == space.rows {
            return Ok(next);
        }
        space = next;
    }
}

/// New points of columns beyond the reach have the rule of their side, and read only nearer columns of it: a shift by two columns
/// moves what is read by one.
fn reaches(border: &Border, reach: i64) -> Checked<()> {
    need(reach >= 1 && border.own.keys().all(|(c, _)| c.abs() <= reach), "window", "own weights beyond the reach")?;
    for column in [reach + 1, reach + 2, -reach - 1, -reach - 2] {
        for row in 0..2 {
            let rule = border.rule(column, row)?;
            let near = rule.iter().all(|(a, _)| (1..column.abs()).contains(&(a[0] * column.signum())));
            need(near, "window", format_args!("column {column} reads a column that is not nearer"))?;
        }
    }
    Ok(())
}
