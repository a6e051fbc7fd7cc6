//! The limit over a cell of the lattice as a patch: a face with its edges and corners.

use super::{LatticeError, LatticeMask};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::scheme::MAX_COORDINATES;
use crate::shape::{Boundary, CellKind, Complex, Face, Frame, Layout, Piece, Shape, Side, State};
use std::collections::{BTreeMap, BTreeSet};

type Points = BTreeSet<Vec<i64>>;

/// The patch of a mask in two variables with a multiple `k` of the unit matrix as dilation: the limit over the unit square, in
/// `k × k` pieces. Points on which it depends are ascending; `(0, 0)` need not be among them, as the limit function of a point may
/// lie anywhere.
///
/// # Errors
/// [`LatticeError::Patch`] for other dilations, [`LatticeError::Scheme`] where there are too many coordinates.
///
/// # Examples
/// ```
/// use secant::scheme::{LatticeMask, lattice_patch};
/// let bicubic = LatticeMask::parse("(1+x)^4*(1+y)^4/64", None)?;
/// let (patch, points) = lattice_patch(&bicubic)?;
/// assert_eq!((patch.shape.states[0].dim, points.len()), (16, 16));
/// patch.check().expect("all identities hold");
/// # Ok::<(), secant::scheme::LatticeError>(())
/// ```
pub fn lattice_patch(mask: &LatticeMask) -> Result<(Complex, Vec<Vec<i64>>), LatticeError> {
    let k = match mask.dilation().rows() {
        [first, second] if first[0] > 1 && first[1] == 0 && *second == [0, first[0]] => first[0],
        _ => return Err(LatticeError::Patch),
    };
    let Some((low, high)) = mask.terms().corners() else { return Err(LatticeError::Zero) };
    // The middle of those whose limit functions are not 0 at the corner.
    let middle: Vec<i64> = low.iter().zip(&high).map(|(a, b)| -(a + b).div_euclid(2 * (k - 1))).collect();
    let (right, up) = ([1, 0], [0, 1]);
    let vertex = closed(mask, Points::from([middle]), &[vec![0, 0]])?;
    let along = |step: [i64; 2]| -> Vec<Vec<i64>> { (0..k).map(|i| vec![i * step[0], i * step[1]]).collect() };
    let edge = |step| closed(mask, &vertex | &moved(&vertex, step), &along(step));
    let (bottom, left) = (edge(right)?, edge(up)?);
    let both = |points: &Points, step| points | &moved(points, step);
    let digits: Vec<Vec<i64>> = (0..k).flat_map(|j| (0..k).map(move |i| vec![i, j])).collect();
    let face = closed(mask, &both(&bottom, up) | &both(&left, right), &digits)?;
    let side = |edge: usize, part: &Points| Side { edge, op: inclusion(&face, part) };
    let end = |whole: &Points, part: &Points| Some(Boundary { vertex: 3, op: inclusion(whole, part) });
    let state = |name: &str, kind, points: &Points, target, digits: &[Vec<i64>]| State {
        name: name.to_owned(),
        kind,
        dim: points.len(),
        pieces: digits
            .iter()
            .map(|d| Piece { target, op: operator(mask, points, d), reversed: false, share: None })
            .collect(),
        left: None,
        right: None,
    };
    let with_ends = |state: State, points: &Points, step| State {
        left: end(points, &vertex),
        right: end(points, &moved(&vertex, step)),
        ..state
    };
    let states = vec![
        state("face", CellKind::Face, &face, 0, &digits),
        with_ends(state("bottom", CellKind::Edge, &bottom, 1, &along(right)), &bottom, right),
        with_ends(state("left", CellKind::Edge, &left, 2, &along(up)), &left, up),
        state("corner", CellKind::Vertex, &vertex, 3, &[vec![0, 0]]),
    ];
    let count = usize::try_from(k).map_err(|_| LatticeError::Patch)?;
    let sides = vec![side(1, &bottom), side(2, &moved(&left, right)), side(1, &moved(&bottom, up)), side(2, &left)];
    let boundary = Face { layout: Layout::Quad { columns: count, rows: count }, sides, placement: Vec::new() };
    let shape = Shape { states, start: 0, control: None, frame: Frame::Barycentric };
    shape.check().map_err(super::SchemeError::from)?;
    let complex = Complex { shape, faces: BTreeMap::from([(0, boundary)]), reversals: BTreeMap::new() };
    Ok((complex, face.into_iter().collect()))
}

fn moved(points: &Points, step: [i64; 2]) -> Points {
    points.iter().map(|p| vec![p[0] + step[0], p[1] + step[1]]).collect()
}

/// The smallest set with these points from which new points at it and a digit depend on its points only.
fn closed(mask: &LatticeMask, seed: Points, digits: &[Vec<i64>]) -> Result<Points, LatticeError> {
    let mut open: Vec<Vec<i64>> = seed.iter().cloned().collect();
    let mut found = seed;
    while let Some(i) = open.pop() {
        for d in digits {
            for (a, _) in mask.terms().iter() {
                let old = mask.dilation().divide(&[i[0] + d[0] - a[0], i[1] + d[1] - a[1]]);
                if let Some(j) = old
                    && found.insert(j.clone())
                {
                    open.push(j);
                }
            }
        }
        let (what, size, limit) = ("a patch with coordinates", found.len(), MAX_COORDINATES);
        if size > limit {
            return Err(super::SchemeError::Large { what, size, limit }.into());
        }
    }
    Ok(found)
}

/// The new points at a digit, as columns.
fn operator(mask: &LatticeMask, points: &Points, digit: &[i64]) -> Matrix {
    let list: Vec<&Vec<i64>> = points.iter().collect();
    Matrix::from_fn(list.len(), list.len(), |j, i| {
        let new = [list[i][0] + digit[0], list[i][1] + digit[1]];
        mask.weight(&new, list[j]).map_or_else(|| Rational::from(0), Clone::clone)
    })
}

fn inclusion(whole: &Points, part: &Points) -> Matrix {
    let (whole, part): (Vec<_>, Vec<_>) = (whole.iter().collect(), part.iter().collect());
    Matrix::from_fn(whole.len(), part.len(), |i, j| Rational::from(u64::from(whole[i] == part[j])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(text: &str) -> Vec<usize> {
        let (patch, _) = lattice_patch(&LatticeMask::parse(text, None).unwrap()).unwrap();
        patch.check().unwrap();
        patch.shape.states.iter().map(|s| s.dim).collect()
    }

    #[test]
    fn points_of_known_patches() {
        assert_eq!(sizes("(1+x)^4*(1+y)^4/64"), [16, 12, 12, 9]);
        assert_eq!(sizes("(1+x)^4*(1+y)^4/64/(x^2*y^2)"), [16, 12, 12, 9]);
        assert_eq!(sizes("(1+x)^3*(1+y)^3/16"), [9, 6, 6, 4]);
        assert_eq!(sizes("(1+x)^2*(1+y)^2/4"), [4, 2, 2, 1]);
        // Loop's box spline: two triangles of 12 points each that share their long edge.
        assert_eq!(sizes("(1+x)^2*(1+y)^2*(1+x*y)^2/16"), [14, 10, 10, 7]);
    }

    #[test]
    fn other_dilations_have_no_patches() {
        let mask = |text: &str, dilation: &str| {
            LatticeMask::parse(text, Some(super::super::Dilation::parse(dilation).unwrap())).unwrap()
        };
        assert!(matches!(lattice_patch(&mask("(1+x)^2*(1+y)^2/8", "quincunx")), Err(LatticeError::Patch)));
        let (three, _) = lattice_patch(&mask("(1+x+x^2)^2*(1+y+y^2)^2/9", "3")).unwrap();
        assert_eq!((three.shape.states[0].dim, three.shape.states[0].pieces.len()), (4, 9));
    }
}
