//! Faces beside one another: along which edges they meet, and whether their points, or what else they have there, are the same.

use super::chart::Chart;
use super::derivative::column_norm;
use crate::base::{Checked, Matrix, Q, need, some};
use crate::curve::Model;
use num_traits::Zero;

/// Most pairs of faces.
const MAX_PAIRS: usize = 500;

/// The surfaces of all states: what pieces do to points or to derivatives, by state and letter, and vectors of each state, as rows.
pub struct Level {
    pub maps: Vec<Vec<Matrix>>,
}

/// Two faces that share an edge, with the place of the second one in the parameters of the first one.
#[derive(Clone, PartialEq)]
pub struct Pair {
    pub states: [usize; 2],
    pub place: Matrix,
}

/// A step along an edge: the two letters, and the pair of these pieces.
type Step = ([usize; 2], usize);

/// The faces that are reached.
pub struct Faces<'a> {
    model: &'a Model<'a>,
    chart: &'a Chart,
    /// `T_i` on barycentric coordinates.
    points: Level,
}

/// The pairs of faces that share an edge, how each is divided, and the edges between pieces of one state, with their pairs.
pub struct Edges {
    pairs: Vec<Pair>,
    steps: Vec<Vec<Step>>,
    inner: Vec<(usize, Step)>,
}

/// All faces are divided into the same number of parts along every side, and the points of parts that share an edge, or of pieces of the
/// start that are glued (their letters, and how they lie beside one another), are the same there.
pub fn continuous(model: &Model<'_>, chart: &Chart, seams: Vec<([usize; 2], Pair)>) -> Checked<()> {
    chart.share()?;
    let faces = Faces::new(model, chart);
    faces.edges(seams)?.meet(&faces.points, &|e, word| faces.point(e, word))
}

impl<'a> Faces<'a> {
    pub fn new(model: &'a Model<'a>, chart: &'a Chart) -> Self {
        let shape = model.shape;
        let mut maps = vec![Vec::new(); shape.states.len()];
        for (e, piece) in shape.pieces() {
            maps[e].push(piece.op.clone());
        }
        Self { model, chart, points: Level { maps } }
    }

    pub fn points(&self) -> &Level {
        &self.points
    }

    /// All edges inside faces, and those along which pieces of the start are glued; there are some inside.
    pub fn edges(&self, seams: Vec<([usize; 2], Pair)>) -> Checked<Edges> {
        let (mut pairs, mut steps, mut inner): (Vec<Pair>, Vec<Vec<Step>>, Vec<_>) = Default::default();
        let number = |pairs: &mut Vec<Pair>, pair: Pair| -> Checked<usize> {
            if let Some(known) = pairs.iter().position(|p| *p == pair) {
                return Ok(known);
            }
            need(pairs.len() < MAX_PAIRS, "limit", "too many pairs of faces")?;
            pairs.push(pair);
            Ok(pairs.len() - 1)
        };
        let shape = self.model.shape;
        for &e in shape.reachable.iter().filter(|&&e| e != shape.start || self.chart.is_patch()) {
            for ([i, j], pair, _) in self.divided(&Pair { states: [e, e], place: Matrix::identity(3) })? {
                if i < j {
                    inner.push((e, ([i, j], number(&mut pairs, pair)?)));
                }
            }
        }
        need(!inner.is_empty(), "every", "a face without inner edges")?;
        for (letters, pair) in seams {
            inner.push((shape.start, (letters, number(&mut pairs, pair)?)));
        }
        while steps.len() < pairs.len() {
            let whole = pairs[steps.len()].clone();
            let (mut own, mut parts) = (Vec::new(), Q::zero());
            for (letters, pair, length) in self.divided(&whole)? {
                own.push((letters, number(&mut pairs, pair)?));
                parts += length;
            }
            let edge = self.edge(&whole)?.map(|ends| length(&ends));
            need(edge == Some(parts), "every", "two faces are divided differently along an edge")?;
            steps.push(own);
        }
        Ok(Edges { pairs, steps, inner })
    }

    /// The pieces of two faces that share an edge, and how long it is in the parameters of the first face.
    fn divided(&self, pair: &Pair) -> Checked<Vec<([usize; 2], Pair, Q)>> {
        let pieces = |k: usize| &self.model.shape.states[pair.states[k]].pieces;
        let mut found = Vec::new();
        for (i, first) in pieces(0).iter().enumerate() {
            for (j, second) in pieces(1).iter().enumerate() {
                let map = self.chart.map(pair.states[0], i);
                let there = pair.place.times(self.chart.map(pair.states[1], j))?;
                let place = some(map.solve(&there)?, "every", "a place that is no cell")?;
                let inner = Pair { states: [first.target, second.target], place };
                if let Some([p, q]) = self.edge(&inner)? {
                    found.push(([i, j], inner, length(&[map.times(&p)?, map.times(&q)?])));
                }
            }
        }
        Ok(found)
    }

    /// The two corners that two faces share, where they share two, in the parameters of the first one.
    fn edge(&self, pair: &Pair) -> Checked<Option<[Matrix; 2]>> {
        let corners = self.chart.corners();
        let mut common = Vec::new();
        for corner in &corners {
            let there = pair.place.times(corner)?;
            if corners.contains(&there) {
                common.push(there);
            }
        }
        Ok(common.try_into().ok())
    }

    /// The point with an eventually periodic address, as a row.
    pub fn point(&self, e: usize, [prefix, cycle]: &[Vec<usize>; 2]) -> Checked<Matrix> {
        let (before, home) = self.model.shape.product(e, prefix)?;
        let (turn, _) = self.model.shape.product(home, cycle)?;
        let fixed = some(turn.fixed_point()?, "every", "the fixed point of a cycle is not unique")?;
        Ok(before.times(&fixed)?.transpose())
    }
}

impl Edges {
    /// Whether what two pieces of a face that share an edge have along it is the same, for every such edge: on the span of the values
    /// at both sides, which is the closure of those at one of its points.
    pub fn meet(&self, level: &Level, value: &dyn Fn(usize, &[Vec<usize>; 2]) -> Checked<Matrix>) -> Checked<()> {
        let Self { pairs, steps, inner } = self;
        let mut spans = Vec::new();
        for (start, pair) in pairs.iter().enumerate() {
            let [first, second] = along(steps, start);
            let both = value(pair.states[0], &first)?.beside(&value(pair.states[1], &second)?);
            spans.push(both.echelon()?.0);
        }
        let mut grown = true;
        while std::mem::take(&mut grown) {
            for (from, own) in steps.iter().enumerate() {
                for &([i, j], to) in own {
                    let [e, d] = pairs[from].states;
                    let width = level.maps[e][i].cols;
                    let (a, b) = (
                        spans[to].part(0..spans[to].rows, 0..width),
                        spans[to].part(0..spans[to].rows, width..spans[to].cols),
                    );
                    let image =
                        a.times(&level.maps[e][i].transpose())?.beside(&b.times(&level.maps[d][j].transpose())?);
                    if let Some((joined, _)) = spans[from].joined(&image)? {
                        (spans[from], grown) = (joined, true);
                    }
                }
            }
        }
        for (e, ([i, j], pair)) in inner {
            let width = level.maps[*e][*i].cols;
            let span = &spans[*pair];
            let first = span.part(0..span.rows, 0..width).times(&level.maps[*e][*i].transpose())?;
            let second = span.part(0..span.rows, width..span.cols).times(&level.maps[*e][*j].transpose())?;
            need(
                first == second,
                "every",
                format_args!("pieces {i} and {j} of state {e} do not fit along their edge"),
            )?;
        }
        Ok(())
    }
}

/// The length of a segment, of two points; of segments of one line only, as the sum of those of its coordinates.
fn length([p, q]: &[Matrix; 2]) -> Q {
    column_norm(&p.minus(q))
}

/// The addresses on both sides of an edge, along its first parts: prefix and cycle of each.
fn along(steps: &[Vec<Step>], start: usize) -> [[Vec<usize>; 2]; 2] {
    let (mut seen, mut letters): (Vec<usize>, Vec<[usize; 2]>) = (vec![start], Vec::new());
    loop {
        let (pair, next) = steps[seen[seen.len() - 1]][0];
        letters.push(pair);
        if let Some(k) = seen.iter().position(|p| *p == next) {
            let side = |s: usize| {
                let all: Vec<usize> = letters.iter().map(|l| l[s]).collect();
                [all[..k].to_vec(), all[k..].to_vec()]
            };
            return [side(0), side(1)];
        }
        seen.push(next);
    }
}
