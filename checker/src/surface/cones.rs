//! Cones around planes for the stars of a patch (docs/certificate.md, section 8.1, every point).

use super::apart;
use super::chart::Chart;
use super::faces::continuous;
use super::glue::seams;
use crate::base::{Checked, Matrix, Node, Q, need, primitive, some, spend};
use crate::curve::Model;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Most stars, most cells of one, and most coordinates of what is seen of one.
const MAX_STARS: (usize, usize, usize) = (64, 16, 64);
/// Most words of stars through which the view is looked at, and the longest.
const MAX_VIEWS: (usize, usize) = (5_000, 8);

/// Parts of a star that make a star.
struct Child {
    star: usize,
    cells: Vec<[usize; 2]>,
    ratio: Q,
}

/// Cells, each with its face and its nodes, and the form on what is seen of them.
struct Star<'n> {
    cells: Vec<(usize, Vec<usize>)>,
    form: Node<'n>,
    children: Vec<Child>,
}

/// A node of the parts of a star: the weights of the corners of a cell, by their numbers.
type Place = Vec<(usize, Q)>;

/// A piece of a cell of a star.
pub struct Part {
    /// The cell and the letter.
    pub from: [usize; 2],
    /// Its face.
    pub face: usize,
    /// The nodes at its corners.
    nodes: Vec<Place>,
}

impl Part {
    /// Whether they have a node in common.
    pub fn meets(&self, other: &Self) -> bool {
        self.nodes.iter().any(|n| other.nodes.contains(n))
    }
}

/// What is seen of a star: coordinates of differences of points, on the coordinates of each of its cells, and the maps from its
/// children.
struct Seen {
    cells: Vec<Matrix>,
    maps: Vec<Matrix>,
    form: Matrix,
}

/// Checks `{"by": "cones", "verdict", "stars"}`: it proves that the surface is G¹ or is rejected.
pub fn check(model: &Model<'_>, chart: &Chart, node: &Node<'_>) -> Checked<()> {
    let [_, _, list] = node.fields("by verdict stars")?;
    let items = list.list()?;
    list.need((2..=MAX_STARS.0).contains(&items.len()), "stars", "these are too few stars, or too many")?;
    let mut stars = Vec::new();
    for (s, item) in items.iter().enumerate() {
        stars.push(star(model, chart, item, s, items.len())?);
    }
    continuous(model, chart, items[0].at(seams(model, chart, &stars[0].cells))?)?;
    let mut all_parts = Vec::new();
    for (item, star) in items.iter().zip(&stars) {
        let own = parts(model, chart, star)?;
        item.at(divided(&stars, star, &own))?;
        all_parts.push(own);
    }
    let seen = seen(model, &stars)?;
    for (s, item) in items.iter().enumerate().skip(1) {
        let form = &seen[s].form;
        item.need(has_planes(form)?, "signature", "the form must have two positive squares and no zero")?;
        for (child, map) in stars[s].children.iter().zip(&seen[s].maps) {
            let image = map.transpose().times(form)?.times(map)?;
            let grows = image.plus(&-child.ratio.clone(), &seen[child.star].form).is_positive(true)?;
            item.need(child.ratio.is_positive() && grows, "growth", "the form does not grow from a child")?;
        }
        let faces: Vec<usize> = stars[s].cells.iter().map(|c| c.0).collect();
        item.at(apart::check(model, &seen[s].cells, &faces, &all_parts[s], form))?;
    }
    list.at(view(&stars, &seen))
}

fn star<'n>(model: &Model<'_>, chart: &Chart, node: &Node<'n>, s: usize, count: usize) -> Checked<Star<'n>> {
    let [cells, form, children] = node.fields("cells form children")?;
    let width = chart.corners().len();
    let cells = cells.each(|item| {
        let [face, corners] = item.fields("face corners")?;
        let face_index = face.index(model.shape.states.len())?;
        face.need(model.shape.reachable.contains(&face_index), "stars", "a face that is not reached")?;
        let corners = corners.exactly(width, "stars")?.iter().map(|c| c.index(1_000)).collect::<Checked<_>>()?;
        Ok((face_index, corners))
    })?;
    node.need((1..=MAX_STARS.1).contains(&cells.len()), "stars", "a star has some cells")?;
    let children = children.each(|item| {
        let [to, parts, ratio] = item.fields("star cells ratio")?;
        let to_index = to.index(count)?;
        to.need(to_index > 0, "stars", "the start is no child")?;
        let cells = parts.each(|pair| match pair.indices(1_000)?.as_slice() {
            [cell, letter] => Ok([*cell, *letter]),
            _ => pair.reject("stars", "a part is a cell and a letter"),
        })?;
        ratio.need(ratio.is_null() == (s == 0), "growth", "every child but those of the start has a number")?;
        let ratio = if s == 0 { Q::one() } else { ratio.rational()? };
        Ok(Child { star: to_index, cells, ratio })
    })?;
    Ok(Star { cells, form, children })
}

/// The pieces of all cells. A node has the same weights from both sides of a side.
fn parts(model: &Model<'_>, chart: &Chart, star: &Star<'_>) -> Checked<Vec<Part>> {
    let mut parts = Vec::new();
    for (cell, (face, corners)) in star.cells.iter().enumerate() {
        for (letter, piece) in model.shape.states[*face].pieces.iter().enumerate() {
            let mut nodes = Vec::new();
            for corner in chart.corners() {
                let x = chart.map(*face, letter).times(&corner)?;
                let (u, v) = (x.at(1, 0), x.at(2, 0));
                let weights = match corners.len() {
                    3 => vec![x.at(0, 0), u, v],
                    _ => {
                        let (w, z) = (Q::one() - &u, Q::one() - &v);
                        vec![&w * &z, &u * &z, &u * &v, &w * &v]
                    }
                };
                let mut node: Place = corners.iter().copied().zip(weights).filter(|(_, w)| !w.is_zero()).collect();
                node.sort();
                nodes.push(node);
            }
            parts.push(Part { from: [cell, letter], face: piece.target, nodes });
        }
    }
    Ok(parts)
}

/// The children are stars of the list with the same nodes, and any two parts with a common node lie in one of them.
fn divided(stars: &[Star<'_>], star: &Star<'_>, parts: &[Part]) -> Checked<()> {
    let mut sets = Vec::new();
    for child in &star.children {
        let wanted = &stars[child.star].cells;
        need(wanted.len() == child.cells.len(), "stars", "a child has another number of cells than its star")?;
        let mut set = Vec::new();
        let mut nodes: Vec<(usize, &Place)> = Vec::new();
        for ((face, corners), from) in wanted.iter().zip(&child.cells) {
            let found = some(parts.iter().position(|p| p.from == *from), "stars", "a part that does not exist")?;
            need(
                !set.contains(&found) && parts[found].face == *face,
                "stars",
                "a part is twice in a child, or another face",
            )?;
            set.push(found);
            nodes.extend(corners.iter().copied().zip(&parts[found].nodes));
        }
        spend(nodes.len() * nodes.len(), 0)?;
        let same = nodes.iter().all(|(n, x)| nodes.iter().all(|(m, y)| (n == m) == (x == y)));
        need(same, "stars", "the parts of a child do not meet as the cells of its star do")?;
        sets.push(set);
    }
    spend(parts.len() * parts.len() * (sets.len() + 16), 0)?;
    for (a, part) in parts.iter().enumerate() {
        for b in (0..=a).filter(|&b| part.meets(&parts[b])) {
            let both = sets.iter().any(|set| set.contains(&a) && set.contains(&b));
            need(both, "stars", format_args!("parts {a} and {b} meet and lie in no child"))?;
        }
    }
    Ok(())
}

/// Rows on the points of a star, carried to those of a child.
fn carried(model: &Model<'_>, star: &Star<'_>, blocks: &[Matrix], child: &Child) -> Checked<Matrix> {
    let mut all: Option<Matrix> = None;
    for &[cell, letter] in &child.cells {
        let block = blocks[cell].times(&model.shape.states[star.cells[cell].0].pieces[letter].op)?;
        all = Some(match all {
            None => block,
            Some(before) => before.beside(&block),
        });
    }
    some(all, "stars", "a child without cells")
}

/// Rows, cut into those on each cell.
fn blocks(model: &Model<'_>, star: &Star<'_>, rows: &Matrix) -> Vec<Matrix> {
    let mut from = 0;
    let mut block = |face: usize| {
        let to = from + model.shape.states[face].dim;
        let part = rows.part(0..rows.rows, from..to);
        from = to;
        part
    };
    star.cells.iter().map(|(face, _)| block(*face)).collect()
}

/// How the points of the start are seen, on the coordinates of its cells: a face alone, or the pieces of a set.
fn start(model: &Model<'_>, first: &Star<'_>) -> Checked<Matrix> {
    let (shape, view) = (&model.shape, &model.shape.view);
    if first.cells[0].0 == shape.start {
        return Ok(view.clone());
    }
    let mut all = view.part(0..view.rows, 0..0);
    for piece in &shape.states[shape.start].pieces {
        all = all.beside(&view.times(&piece.op)?);
    }
    Ok(all)
}

/// The visible quotients: rows that the view makes of all words of stars, on the span of the differences of points.
fn seen(model: &Model<'_>, stars: &[Star<'_>]) -> Checked<Vec<Seen>> {
    let size = |s: &Star<'_>| s.cells.iter().map(|(face, _)| model.shape.states[*face].dim).sum();
    let mut rows: Vec<Matrix> = stars.iter().map(|s| Matrix::empty(size(s))).collect();
    rows[0] = start(model, &stars[0])?.echelon()?.0;
    let mut grown = true;
    while std::mem::take(&mut grown) {
        for (s, star) in stars.iter().enumerate() {
            let own = blocks(model, star, &rows[s]);
            for child in &star.children {
                if let Some((joined, _)) = rows[child.star].joined(&carried(model, star, &own, child)?)? {
                    (rows[child.star], grown) = (joined, true);
                }
            }
        }
    }
    let (mut spans, mut leading) = (Vec::new(), Vec::new());
    for (star, rows) in stars.iter().zip(&rows) {
        let mut span = Matrix::empty(rows.rows);
        let mut first: Option<Matrix> = None;
        for ((face, _), block) in star.cells.iter().zip(blocks(model, star, rows)) {
            let space = model.spaces.of(*face)?;
            let point = block.times(&space.base)?;
            let shift = point.minus(first.get_or_insert_with(|| point.clone()));
            span = span.stack(&block.times(&space.basis)?.transpose()).stack(&shift.transpose());
        }
        spans.push(span.echelon()?);
        leading.push(rows.echelon()?.1);
    }
    let mut all = Vec::new();
    for (s, star) in stars.iter().enumerate() {
        let (span, pivots) = &spans[s];
        let chosen = |m: &Matrix| m.transpose().columns(pivots).transpose();
        let own = blocks(model, star, &rows[s]);
        let mut maps = Vec::new();
        for child in &star.children {
            let there = carried(model, star, &own, child)?;
            let onto = there.columns(&leading[child.star]);
            let image = onto.times(&spans[child.star].0.transpose())?;
            let map = chosen(&image);
            let acts = onto.times(&rows[child.star])? == there && span.transpose().times(&map)? == image;
            need(acts, "visible", "an operator does not act on the visible quotients of stars")?;
            maps.push(map);
        }
        let form = star.form.at(symmetric(&star.form, if s == 0 { 0 } else { pivots.len() }))?;
        all.push(Seen { cells: own.iter().map(chosen).collect(), maps, form });
    }
    Ok(all)
}

/// A symmetric matrix, given by what lies on and right of the diagonal.
fn symmetric(node: &Node<'_>, n: usize) -> Checked<Matrix> {
    node.need(n <= MAX_STARS.2, "limit", "too many coordinates")?;
    let mut entries = vec![Q::zero(); n * n];
    for (i, row) in node.exactly(n, "signature")?.iter().enumerate() {
        for (k, x) in row.vector(n - i)?.into_iter().enumerate() {
            entries[(i + k) * n + i].clone_from(&x);
            entries[i * n + i + k] = x;
        }
    }
    Ok(Matrix::new(n, n, &entries))
}

/// Whether a form has two positive squares and no zero: elimination with pivots on the diagonal.
fn has_planes(form: &Matrix) -> Checked<bool> {
    let (mut a, mut positive) = (form.data.clone(), 0);
    for n in (1..=form.rows).rev() {
        spend(2 * n * n, crate::base::longest(&a))?;
        let Some(p) = (0..n).find(|&p| !a[p * n + p].is_zero()) else { return Ok(false) };
        let (pivot, up) = (a[p * n + p].abs(), a[p * n + p].is_positive());
        positive += usize::from(up);
        let others = (0..n).filter(|&i| i != p);
        let entry = |i: usize, j: usize| {
            let product = &a[i * n + p] * &a[p * n + j];
            &pivot * &a[i * n + j] - if up { product } else { -product }
        };
        let rest: Vec<BigInt> =
            others.clone().flat_map(|i| others.clone().map(move |j| (i, j))).map(|(i, j)| entry(i, j)).collect();
        a = primitive(rest);
    }
    Ok(positive == 2)
}

/// Every word of stars begins with one on the kernel of whose operator the form is negative definite.
fn view(stars: &[Star<'_>], seen: &[Seen]) -> Checked<()> {
    let width = some(seen[0].maps.first(), "stars", "the start has no children")?.rows;
    let (mut open, mut steps) = (vec![(Matrix::identity(width), 0, 0)], 0);
    while let Some((product, s, length)) = open.pop() {
        steps += 1;
        let kernel = product.kernel()?;
        let minus = seen[s].form.scaled(&-Q::one());
        if s > 0 && kernel.times(&minus)?.times(&kernel.transpose())?.is_positive(true)? {
            continue;
        }
        let more = steps <= MAX_VIEWS.0 && length < MAX_VIEWS.1;
        need(more, "view", "the view is not seen to keep the cones of stars apart from 0")?;
        for (child, map) in stars[s].children.iter().zip(&seen[s].maps) {
            open.push((product.times(map)?, child.star, length + 1));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Json, whole};
    use crate::curve::{Kind, Piece, Shape, State};

    fn matrix(rows: &[&[i64]]) -> Matrix {
        let rows: Vec<Vec<Q>> = rows.iter().map(|r| r.iter().map(|x| whole(*x)).collect()).collect();
        Matrix::from_rows(rows[0].len(), &rows)
    }

    /// A bilinear square in four.
    fn square() -> Shape {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let at = |u: i64, v: i64| [(2 - u) * (2 - v), u * (2 - v), u * v, (2 - u) * v].map(whole).to_vec();
        let op = |k: i64| {
            let columns: Vec<Vec<Q>> = corners.iter().map(|[u, v]| at(k % 2 + u, k / 2 + v)).collect();
            Matrix::from_rows(4, &columns).transpose().scaled(&Q::new(1.into(), 4.into()))
        };
        let pieces = (0..4).map(|k| Piece { target: 0, op: op(k), reversed: false, share: None }).collect();
        let states = vec![State { kind: Kind::Set, dim: 4, pieces, ends: [None, None] }];
        Shape::new(states, 0, Matrix::identity(4))
    }

    /// Two squares at a distance, with the form of Minkowski in either direction; from the simplex or from a ball.
    #[test]
    fn forms_between_cells_that_do_not_meet() {
        let shape = square();
        for (hull, far) in [("\"simplex\"", 3), ("null", 60)] {
            let text = format!(r#"[{{"state": 0, "radius": "6", "code": [".", ".", ".", "."], "hull": {hull}}}]"#);
            let json: Json = serde_json::from_str(&text).unwrap();
            let model = Model::read(&shape, &(), &Node { value: &json, place: String::new() }).unwrap();
            let across: &[i64] = &[0, 0, 1, 1];
            let places = [matrix(&[&[0, 1, 1, 0], across]), matrix(&[&[far, far + 1, far + 1, far], across])];
            let part = |cell: usize, letter: usize| Part {
                from: [cell, letter],
                face: 0,
                nodes: vec![vec![(cell, Q::one())]],
            };
            let parts: Vec<Part> = (0..2).flat_map(|c| (0..4).map(move |l| part(c, l))).collect();
            let check = |form: &Matrix| apart::check(&model, &places, &[0, 0], &parts, form);
            assert_eq!(check(&matrix(&[&[1, 0], &[0, -1]])), Ok(()), "{hull}");
            assert!(check(&matrix(&[&[-1, 0], &[0, 1]])).is_err());
            // The form is 0 in the direction between two corners, and just positive there.
            let near = (far - 1) * (far - 1);
            assert!(check(&matrix(&[&[1, 0], &[0, -near]])).is_err());
            assert_eq!(check(&matrix(&[&[1, 0], &[0, 1 - near]])).is_ok(), hull != "null");
        }
    }

    #[test]
    fn squares_of_forms() {
        assert!(has_planes(&matrix(&[&[0, 1, 0], &[1, 1, 0], &[0, 0, 3]])).unwrap());
        assert!(has_planes(&matrix(&[&[5, 1], &[1, 1]])).unwrap());
        assert!(!has_planes(&matrix(&[&[13, 30, 40], &[30, 12, 30], &[40, 30, 8]])).unwrap());
        assert!(!has_planes(&matrix(&[&[1, 0, 0], &[0, 2, 0], &[0, 0, 3]])).unwrap());
        assert!(!has_planes(&matrix(&[&[1, 1, 0], &[1, 1, 0], &[0, 0, 3]])).unwrap());
    }
}
