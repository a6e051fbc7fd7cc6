//! Theorem 6 over a real number field: cones proposed by a curve with rational entries nearby, and checked exactly.

use super::branch::Context;
use super::cone::{Cone, ConeAnswer, ConeMap, common_cone};
use super::dense::first_level_joint;
use super::point::joint_pairs;
use super::provable::Provable;
use super::verdict::{Kind, PointReport, Verdict};
use crate::arith::Rational;
use crate::jordan::Scalar;
use crate::linalg::Matrix;
use crate::shape::{CellKind, End, Shape, Spaces, difference};

/// The certificate of Theorem 6 with entries in a number field.
#[derive(Debug, Clone)]
pub struct ConesOver<E: Scalar> {
    /// One cone for every reachable state.
    pub cones: Vec<Cone<E>>,
    /// One map for every piece of a reachable state, with positive entries.
    pub maps: Vec<ConeMap<E>>,
    /// `h` with `h P G > 0` for the start state, where control points are given.
    pub view: Option<Vec<E>>,
    /// The first-level joints of all reachable states in their visible quotients, which are regular.
    pub joints: Vec<PointReport<E>>,
}

/// Whether a curve is G¹ by Theorem 6: cones that the control points, if any, see, and regular first-level joints. `near` is the
/// curve with rational entries nearby.
pub fn cones_over<E: Provable>(cx: &Context<E>, near: &Shape) -> Option<ConesOver<E>> {
    let edges = cx.shape.reachable().into_iter().all(|e| cx.shape.states[e].kind == CellKind::Edge);
    let mut found = if edges { proposed(cx, near)? } else { return None };
    for e in cx.shape.reachable() {
        for pair in joint_pairs(cx, e) {
            let joint = first_level_joint(cx, e, pair)?;
            if (joint.verdict, joint.kind) != (Verdict::Proved, Kind::Regular) {
                return None;
            }
            found.joints.push(joint);
        }
    }
    Some(found)
}

fn proposed<E: Provable>(cx: &Context<E>, near: &Shape) -> Option<ConesOver<E>> {
    let Some(ConeAnswer::Proved(cone)) = common_cone(near, &Spaces::new(near)?, cx.budget.cone_steps) else {
        return None;
    };
    let lifted = |m: &Matrix| m.map(E::of);
    let mut cones: Vec<Cone<E>> = Vec::new();
    for old in &cone.cones {
        let space = cx.spaces.of(old.state);
        // Into V, in case the space nearby is another one.
        let rays = &space.basis * &(&space.coordinates * &lifted(&old.rays));
        let functional: Vec<E> = old.functional.iter().map(E::of).collect();
        let (shape, state) = (cx.shape, old.state);
        let chord = difference(&shape.end_point(state, End::Finish)?, &shape.end_point(state, End::Start)?);
        let y = corrected(&rays, &Matrix::from_columns(chord.len(), &[chord]), &lifted(&column(&old.chord)))?;
        let holds = rays.rank() == space.basis.cols()
            && functional.len() == rays.rows()
            && (0..rays.cols()).all(|j| E::dot(&functional, &rays.column(j)).sign() > 0)
            && y.entries().iter().all(|x| x.sign() >= 0)
            && !y.is_zero();
        if !holds {
            return None;
        }
        cones.push(Cone { state, rays, functional, chord: y.column(0) });
    }
    let of = |state: usize| cones.iter().find(|c| c.state == state);
    let mut maps = Vec::new();
    for e in cx.shape.reachable() {
        for (letter, piece) in cx.shape.states[e].pieces.iter().enumerate() {
            let old = cone.maps.iter().find(|m| (m.state, m.letter) == (e, letter))?;
            let (from, to) = (of(e)?, of(piece.target)?);
            let sign = if piece.reversed { -1 } else { 1 };
            let images = (&piece.op * &to.rays).scale(&E::integer(sign.into()));
            let matrix = corrected(&from.rays, &images, &lifted(&old.matrix))?;
            if matrix.entries().iter().any(|x| x.sign() <= 0) || &from.rays * &matrix != images {
                return None;
            }
            maps.push(ConeMap { state: e, letter, sign, matrix });
        }
    }
    let view = match &cx.shape.control {
        None => None,
        Some(p) => {
            let images = p * &of(cx.shape.start)?.rays;
            let h: Vec<E> = cone.view.as_ref()?.iter().map(E::of).collect();
            let seen = (0..images.cols()).all(|j| E::dot(&h, &images.column(j)).sign() > 0);
            Some(if seen { h } else { return None })
        }
    };
    Some(ConesOver { cones, maps, view, joints: Vec::new() })
}

fn column(v: &[Rational]) -> Matrix {
    Matrix::from_columns(v.len(), &[v.to_vec()])
}

/// A solution `X` of `rays X = images` near a given matrix.
fn corrected<E: Provable>(rays: &Matrix<E>, images: &Matrix<E>, near: &Matrix<E>) -> Option<Matrix<E>> {
    if (near.rows(), near.cols()) != (rays.cols(), images.cols()) {
        return None;
    }
    let missing = images - &(rays * near);
    Some(near + &rays.solve(&missing)?)
}
