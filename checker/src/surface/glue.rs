//! The start as cells with nodes: a face alone, or the pieces of a set, glued along sides (docs/certificate.md, section 8.1).

use super::chart::Chart;
use super::faces::Pair;
use crate::base::{Checked, Matrix, need, some, spend};
use crate::curve::Model;

/// A side of a cell: the cell, and the corner at its beginning and at its end.
#[derive(Clone, Copy)]
struct Side {
    cell: usize,
    ends: [usize; 2],
}

/// A cell: its face and its nodes.
type Cell = (usize, Vec<usize>);

/// Rule `stars`: the cells are those of the start. The sides along which pieces of a set have two nodes in common, by the letters of the
/// pieces, each with the place of the second face beside the first one; there the points have to be the same.
pub fn seams(model: &Model<'_>, chart: &Chart, cells: &[Cell]) -> Checked<Vec<([usize; 2], Pair)>> {
    let (start, width) = (model.shape.start, chart.corners().len());
    if chart.is_patch() {
        let alone = cells == [(start, (0..width).collect::<Vec<_>>())];
        need(alone, "stars", "the first one is the start")?;
        return Ok(Vec::new());
    }
    let faces = model.shape.states[start].pieces.iter().map(|p| p.target);
    need(faces.eq(cells.iter().map(|c| c.0)), "stars", "the cells of the first one are the pieces of the start")?;
    spend(cells.len() * cells.len() * 64, 0)?;
    for (k, (_, nodes)) in cells.iter().enumerate() {
        let different = (0..width).all(|i| !nodes[..i].contains(&nodes[i]));
        let apart = cells[..k].iter().all(|c| nodes.iter().any(|n| !c.1.contains(n)));
        need(different && apart, "stars", "a cell has a node twice, or all nodes of another one")?;
    }
    let side = |cell: usize| (0..width).map(move |i| Side { cell, ends: [i, (i + 1) % width] });
    let sides: Vec<Side> = (0..cells.len()).flat_map(side).collect();
    let nodes = |s: &Side| s.ends.map(|i| cells[s.cell].1[i]);
    // The corners that seams make one node.
    let mut classes: Vec<usize> = (0..cells.len() * width).collect();
    let mut found = Vec::new();
    for (k, second) in sides.iter().enumerate() {
        let [from, to] = nodes(second);
        let same: Vec<&Side> = sides[..k].iter().filter(|s| [[from, to], [to, from]].contains(&nodes(s))).collect();
        need(same.len() < 2, "stars", "more than two cells along a side")?;
        let Some(first) = same.first() else { continue };
        let ends = if nodes(first) == [from, to] { second.ends } else { [second.ends[1], second.ends[0]] };
        found.push((
            [first.cell, second.cell],
            beside(chart, [cells[first.cell].0, cells[second.cell].0], first.ends, ends)?,
        ));
        for (i, j) in first.ends.iter().zip(ends) {
            let (x, y) = (classes[first.cell * width + i], classes[second.cell * width + j]);
            classes.iter_mut().filter(|c| **c == x.max(y)).for_each(|c| *c = x.min(y));
        }
    }
    let all: Vec<usize> = cells.iter().flat_map(|c| c.1.iter().copied()).collect();
    let linked = (0..all.len()).all(|x| (0..x).all(|y| (all[x] == all[y]) == (classes[x] == classes[y])));
    need(linked, "stars", "cells with a common node are not linked by sides there")?;
    Ok(found)
}

/// Two faces along a side of both: the corners at its ends, in the same order.
fn beside(chart: &Chart, states: [usize; 2], first: [usize; 2], second: [usize; 2]) -> Checked<Pair> {
    let corners = chart.corners();
    let width = corners.len();
    // The corner before or after the first end that is not the second one.
    let third = |[p, q]: [usize; 2]| if (p + 1) % width == q { (p + width - 1) % width } else { (p + 1) % width };
    let columns = |[p, q]: [usize; 2]| corners[p].beside(&corners[q]).beside(&corners[third([p, q])]);
    let (here, there) = (columns(first), columns(second));
    // Across the side of a triangle its third corner is that of a parallelogram, of a quadrangle the one next to the first end.
    let turned = |k: usize| match width {
        3 => here.at(k, 0) + here.at(k, 1) - here.at(k, 2),
        _ => here.at(k, 0) + here.at(k, 0) - here.at(k, 2),
    };
    let third = Matrix::new(3, 1, &[turned(0), turned(1), turned(2)]);
    let target = here.columns(&[0, 1]).beside(&third);
    let place = there.transpose().solve(&target.transpose())?;
    let place = some(place, "every", "a face without an inside")?.transpose();
    Ok(Pair { states, place })
}
