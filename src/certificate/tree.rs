//! Prefix codes as trees: a list with one child for each letter, or a text at a leaf.

use super::{Unsupported, unsupported};
use crate::shape::{ContractingWord, Shape};
use crate::theorem::{Position, RingPiece, RingProof};
use serde_json::{Value, json};

/// JSON readers refuse deeper nesting.
const MAX_DEPTH: usize = 100;

fn grow<E>(
    shape: &Shape<E>,
    state: usize,
    word: &mut Vec<usize>,
    depth: usize,
    leaf: &dyn Fn(&[usize]) -> Option<Value>,
) -> Result<Value, Unsupported> {
    if let Some(value) = leaf(word) {
        return Ok(value);
    }
    if depth == MAX_DEPTH {
        return unsupported("a word this long", format!("{word:?}"));
    }
    let mut children = Vec::new();
    for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
        word.push(letter);
        children.push(grow(shape, piece.target, word, depth + 1, leaf)?);
        word.pop();
    }
    Ok(Value::Array(children))
}

/// The contraction code of a state.
pub fn code<E>(shape: &Shape<E>, state: usize, words: &[ContractingWord]) -> Result<Value, Unsupported> {
    let mut sorted: Vec<&[usize]> = words.iter().map(|w| w.word.as_slice()).collect();
    sorted.sort_unstable();
    let leaf = |word: &[usize]| sorted.binary_search(&word).is_ok().then(|| json!("."));
    grow(shape, state, &mut Vec::new(), 0, &leaf)
}

/// The cover of the ring of a branch (or of one part of it) by discharged cells, piece by piece.
pub fn cover<E>(
    shape: &Shape<E>,
    ring: &[RingPiece<E>],
    proof: &RingProof,
    part: Option<Position>,
) -> Result<Value, Unsupported> {
    let mut cells: Vec<(&[usize], Value)> = Vec::new();
    for cell in &proof.discharged {
        let sign = if cell.sign > 0 { "+" } else { "-" };
        cells.push((&cell.word, json!(format!("{sign}{}", cell.functional))));
    }
    cells.sort_unstable_by(|a, b| a.0.cmp(b.0));
    let leaf = |word: &[usize]| cells.binary_search_by(|c| c.0.cmp(word)).ok().map(|k| cells[k].1.clone());
    let mut pieces = Vec::new();
    let wanted = |p: Position| part.is_none_or(|part| p == part);
    for piece in ring.iter().filter(|p| !p.collapses && wanted(p.position)) {
        let tree = grow(shape, piece.end, &mut piece.word.clone(), 0, &leaf)?;
        pieces.push(json!({"piece": piece.word, "cells": tree}));
    }
    Ok(Value::Array(pieces))
}
