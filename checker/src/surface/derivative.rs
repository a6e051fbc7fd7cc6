//! Patches that are C¹ in their parameters and immersed (docs/certificate.md, section 8.1, every point).

use super::chart::Chart;
use super::faces::{Faces, Level};
use crate::base::{Checked, Matrix, Node, Q, need, some, whole};
use crate::curve::{Model, Way, close, kronecker};
use crate::jsr::{System, bounds};
use num_traits::{One, Signed, Zero};

/// Longest words by which the derivative is bounded, and the most products.
const MAX_WORDS: (usize, usize) = (6, 5_000);
/// Most cells of a cover, and the most letters of one.
const MAX_CELLS: (usize, usize) = (20_000, 12);
/// A patch whose pieces are placed by `x ↦ U x / N + p`, `U` a turn where a piece leads back to its face.
struct Patch<'a> {
    model: &'a Model<'a>,
    chart: &'a Chart,
    faces: Faces<'a>,
    /// `1/N`.
    share: Q,
    /// By state and letter: `U^-t`, which goes with the derivative as two rows.
    turns: Vec<Vec<Matrix>>,
    /// `N T_i` on the visible quotients.
    scaled: Vec<Vec<Matrix>>,
    /// What pieces make of derivatives, one row after the other.
    derivatives: Level,
    /// By state: the two differences of corners as rows, and the differences of the derivative in echelon form.
    chords: Vec<Matrix>,
    families: Vec<Matrix>,
}

/// Checks `{"by": "derivative", "verdict", "radius", "length", "cells"}`: it proves that the surface is G¹ or is rejected.
pub fn check(model: &Model<'_>, chart: &Chart, node: &Node<'_>) -> Checked<()> {
    let [_, _, radius, length, cells] = node.fields("by verdict radius length cells")?;
    let patch = Patch::read(model, chart)?;
    radius.need(patch.radius(&radius)? < patch.share, "every", "the radius is not below 1/N")?;
    let edges = patch.faces.edges(Vec::new())?;
    edges.meet(patch.faces.points(), &|e, word| patch.faces.point(e, word))?;
    edges.meet(&patch.derivatives, &|e, word| patch.derivative(e, word))?;
    if cells.is_null() {
        length.need(length.is_null(), "every", "words bound the derivative where there are cells")?;
        let seen = patch.view()?.transpose();
        let start = model.shape.start;
        let family = patch.families[start].times(&seen)?;
        let all = family.stack(&patch.chords[start].times(&seen)?).rank()?;
        return cells.need(all == family.rank()? + 2, "every", "the derivative is not seen to have rank 2");
    }
    let radii = length.at(patch.radii(length.index(MAX_WORDS.0 + 1)?))?;
    cells.at(patch.covered(&radii, &cells))
}

impl<'a> Patch<'a> {
    fn read(model: &'a Model<'a>, chart: &'a Chart) -> Checked<Self> {
        let shape = model.shape;
        let none = || vec![Vec::new(); shape.states.len()];
        let mut patch = Self {
            model,
            chart,
            faces: Faces::new(model, chart),
            share: chart.share()?,
            turns: none(),
            scaled: none(),
            derivatives: Level { maps: none() },
            chords: shape.no_rows(),
            families: shape.no_rows(),
        };
        for (e, piece) in shape.pieces() {
            let scale = patch.share.recip();
            let turn = chart.linear(e, patch.turns[e].len()).scaled(&scale);
            let turn = some(turn.solve(&Matrix::identity(2))?, "every", "a piece that is no cell")?.transpose();
            let scaled = model.spaces.on_visible(e, piece)?.scaled(&scale);
            patch.derivatives.maps[e].push(kronecker(&turn, &scaled)?);
            patch.scaled[e].push(scaled);
            patch.turns[e].push(turn);
        }
        for &e in &shape.reachable {
            let (chords, defect) = patch.corners(e)?;
            (patch.chords[e], patch.families[e]) = (chords, defect);
        }
        for (e, i, d) in patch.arrows() {
            let image = patch.carried(e, i, d)?;
            patch.families[e] = patch.families[e].stack(&image.minus(&patch.chords[e]));
        }
        let image = |e: usize, p: &_, span: &Matrix| span.times(&model.spaces.on_visible(e, p)?.transpose());
        patch.families = close(shape, patch.families, Way::Up, image)?;
        Ok(patch)
    }

    /// What a piece makes of the differences of corners of its target.
    fn carried(&self, e: usize, i: usize, d: usize) -> Checked<Matrix> {
        self.turns[e][i].times(&self.chords[d])?.times(&self.scaled[e][i].transpose())
    }

    /// All pieces: state, letter, target.
    fn arrows(&self) -> Vec<(usize, usize, usize)> {
        let shape = self.model.shape;
        let of = |&e: &usize| shape.states[e].pieces.iter().enumerate().map(move |(i, p)| (e, i, p.target));
        shape.reachable.iter().flat_map(of).collect()
    }

    /// The differences of the corners 1 and last to corner 0 in the visible quotient, and the defect of the parallelogram.
    fn corners(&self, e: usize) -> Checked<(Matrix, Matrix)> {
        let (shape, space) = (self.model.shape, self.model.spaces.of(e)?);
        let mut points = Vec::new();
        for corner in self.chart.corners() {
            let addresses = self.chart.addresses(e, &corner)?;
            points.push(shape.point(e, some(addresses.first(), "every", "a corner without an address")?)?);
        }
        let seen = |v: &Matrix| Ok(space.visible.times(&space.reading.times(v)?)?.transpose());
        let last = points.len() - 1;
        let (first, second) = (points[1].minus(&points[0]), points[last].minus(&points[0]));
        let chords = seen(&first)?.stack(&seen(&second)?);
        let defect = match last {
            3 => seen(&points[2].minus(&points[1]).minus(&second))?,
            _ => Matrix::empty(space.visible.rows),
        };
        Ok((chords, defect))
    }

    /// Coordinates of vectors of `F_e` (rows) in its echelon basis.
    fn local(&self, e: usize, vectors: &Matrix) -> Checked<Matrix> {
        let pivots = self.families[e].echelon()?.1;
        let local = vectors.columns(&pivots);
        let inside = local.times(&self.families[e])? == *vectors;
        need(inside, "every", "an operator does not act on the differences of the derivative")?;
        Ok(local)
    }

    /// `N T_i` on the differences, on columns.
    fn step(&self, e: usize, i: usize, d: usize) -> Checked<Matrix> {
        let images = self.families[d].times(&self.scaled[e][i].transpose())?;
        Ok(self.local(e, &images)?.transpose())
    }

    /// An upper bound of the joint spectral radius of the `T_i` on the differences.
    fn radius(&self, node: &Node<'_>) -> Checked<Q> {
        let reachable = &self.model.shape.reachable;
        if node.is_null() {
            let zero = reachable.iter().all(|&e| self.families[e].rows == 0);
            node.need(zero, "every", "bounds of a radius are needed here")?;
            return Ok(Q::zero());
        }
        let place = |e: usize| some(reachable.iter().position(|r| *r == e), "every", "a state that is not reached");
        let mut arrows = Vec::new();
        for (e, i, d) in self.arrows() {
            arrows.push((place(e)?, place(d)?, self.step(e, i, d)?.scaled(&self.share)));
        }
        let dims = reachable.iter().map(|&e| self.families[e].rows).collect();
        Ok(bounds(&System { name: String::new(), dims, arrows }, &(), node)?.upper)
    }

    /// The derivative there, one row after the other: that of the cycle is the fixed one in `c + F`.
    fn derivative(&self, e: usize, [prefix, cycle]: &[Vec<usize>; 2]) -> Checked<Matrix> {
        let (before, home) = self.product(e, prefix)?;
        let (turn, back) = self.product(home, cycle)?;
        need(home == back, "every", "the cycle of an edge does not return to its state")?;
        let shifted = turn.minus(&Matrix::identity(turn.rows));
        let family = kronecker(&Matrix::identity(2), &self.families[home].transpose())?;
        let chords = self.chords[home].row(0).beside(&self.chords[home].row(1)).transpose();
        let y = shifted.times(&family)?.solve(&shifted.times(&chords.scaled(&-Q::one()))?)?;
        let y = some(y, "every", "the derivative is not unique at a point of an edge")?;
        Ok(before.times(&chords.plus(&Q::one(), &family.times(&y)?))?.transpose())
    }

    /// What a word makes of derivatives, and where it ends.
    fn product(&self, from: usize, word: &[usize]) -> Checked<(Matrix, usize)> {
        let (mut product, mut at) = (Matrix::identity(2 * self.chords[from].cols), from);
        for &i in word {
            let map = some(self.derivatives.maps[at].get(i), "word", "a letter that does not exist")?;
            product = product.times(map)?;
            at = self.model.shape.states[at].pieces[i].target;
        }
        Ok((product, at))
    }

    /// Any lift of a vector of the visible quotient of the start is seen as the same vector.
    fn view(&self) -> Checked<Matrix> {
        let space = self.model.spaces.of(self.model.shape.start)?;
        Ok(self.model.shape.view.times(&space.basis)?.columns(&space.leading))
    }

    /// By state: a bound of the 1-norm of the coordinates of each column of `D_e − c_e`, by words of a length.
    fn radii(&self, length: usize) -> Checked<Vec<Q>> {
        let states = &self.model.shape.states;
        let (mut offsets, mut largest) = (vec![Q::zero(); states.len()], Q::zero());
        for &e in &self.model.shape.reachable {
            let size = self.families[e].rows;
            let mut layer = vec![(Matrix::identity(size), Matrix::identity(2), Matrix::zeros(size, 2), e)];
            for _ in 0..length {
                let mut next = Vec::new();
                for (product, turn, offset, at) in &layer {
                    for (i, piece) in states[*at].pieces.iter().enumerate() {
                        let d = piece.target;
                        let own = self.local(*at, &self.carried(*at, i, d)?.minus(&self.chords[*at]))?.transpose();
                        let moved = offset.plus(&Q::one(), &product.times(&own)?.times(&turn.transpose())?);
                        let turned = turn.times(&self.turns[*at][i])?;
                        next.push((product.times(&self.step(*at, i, d)?)?, turned, moved, d));
                    }
                }
                need(next.len() <= MAX_WORDS.1, "limit", "too many words")?;
                layer = next;
            }
            for (product, turn, offset, _) in &layer {
                offsets[e] = offsets[e].clone().max(column_norm(offset));
                largest = largest.max(column_norm(product) * column_norm(&turn.transpose()));
            }
        }
        need(length > 0 && largest < Q::one(), "every", "words of this length do not shrink the differences")?;
        let most = offsets.iter().fold(Q::zero(), |m, own| m.max(own.clone())) / (Q::one() - &largest);
        Ok(offsets.iter().map(|own| own + &largest * &most).collect())
    }

    /// The words are a complete prefix code, and on the cell of each the columns of the derivative stay independent.
    fn covered(&self, radii: &[Q], node: &Node<'_>) -> Checked<()> {
        let mut words = node.list()?.into_iter();
        let mut open = vec![(Vec::new(), self.view()?, self.model.shape.start)];
        let mut given = words.next();
        let mut steps = 0;
        while let Some((word, seen, e)) = open.pop() {
            steps += 1;
            need(steps <= MAX_CELLS.0, "limit", "too many cells")?;
            let item = node.some(given.as_ref(), "every", "the cells are no cover")?;
            let wanted = item.word()?;
            if wanted == word {
                item.need(self.keeps_rank(&seen, e, &radii[e])?, "every", "the derivative may lose its rank here")?;
                given = words.next();
                continue;
            }
            let below = wanted.len() > word.len() && wanted.starts_with(&word) && word.len() < MAX_CELLS.1;
            item.need(below, "every", "the cells are no cover, in their order")?;
            for (i, piece) in self.model.shape.states[e].pieces.iter().enumerate().rev() {
                let longer = [word.as_slice(), &[i]].concat();
                open.push((longer, seen.times(&self.scaled[e][i])?, piece.target));
            }
        }
        node.need(given.is_none(), "every", "a cell twice")
    }

    /// The 2-form `(x·p)(y·q) − (x·q)(y·p)`, `p` and `q` the columns for no differences, is positive on the columns `x`, `y` of the
    /// derivative, which are these up to differences of 1-norm `radius`.
    fn keeps_rank(&self, seen: &Matrix, e: usize, radius: &Q) -> Checked<bool> {
        let centre = self.chords[e].times(&seen.transpose())?;
        let moved = self.families[e].times(&seen.transpose())?.times(&centre.transpose())?;
        let own = centre.times(&centre.transpose())?;
        let form = |a: &Matrix, i: usize, b: &Matrix, j: usize| a.at(i, 0) * b.at(j, 1) - a.at(i, 1) * b.at(j, 0);
        let (mut first, mut second, mut both) = (Q::zero(), Q::zero(), Q::zero());
        for k in 0..moved.rows {
            first = first.max(form(&moved, k, &own, 1).abs());
            second = second.max(form(&own, 0, &moved, k).abs());
            for l in 0..k {
                both = both.max(form(&moved, k, &moved, l).abs());
            }
        }
        Ok(form(&own, 0, &own, 1) > radius * (first + second) + radius * radius * both)
    }
}

/// The largest 1-norm of a column.
pub fn column_norm(m: &Matrix) -> Q {
    let column = |j: usize| (0..m.rows).fold(whole(0), |s, i| s + m.at(i, j).abs());
    (0..m.cols).map(column).fold(Q::zero(), Q::max)
}
