//! What is asked of the ring of a sector, whether it has patches or cells.

use super::ball::Ball;
use super::cells::{Cells, Signs};
use super::limit::Regular;
use super::mesh::{Mesh, Net, Spline};
use super::patch::{Patch, boundary, patches};
use crate::base::{Checked, Q, need};
use num_traits::{One, Zero};

/// The ring of sector 0 of a function, between two distances from the centre.
pub enum Ring<'a> {
    /// Polynomials.
    Patches(Spline, Vec<Patch>),
    /// Cells on which the limit is enclosed.
    Cells(Cells<'a>),
}

/// Whether there are some signs, all of them strict and the same.
pub fn one_sign(signs: impl Iterator<Item = i32>) -> bool {
    let all: Vec<i32> = signs.collect();
    !all.is_empty() && all.iter().all(|s| *s != 0 && *s == all[0])
}

impl<'a> Ring<'a> {
    /// The patches of a net.
    pub fn of_patches(spline: Spline, mesh: &Mesh, net: &Net) -> Checked<Self> {
        let all = patches(spline, mesh, net)?;
        need(!all.is_empty(), "vertex", "a ring has patches")?;
        Ok(Self::Patches(spline, all))
    }

    /// The cells of a net.
    pub fn of_cells(regular: &'a Regular, mesh: &Mesh, net: &Net) -> Checked<Self> {
        Ok(Self::Cells(Cells::new(regular, mesh, net)?))
    }

    /// Whether it lies in the open half-plane of the points with a positive scalar product.
    pub fn lies_in(&self, half_plane: &(Q, Q)) -> Checked<bool> {
        match self {
            Self::Patches(_, all) => {
                let against = Ball::new(&half_plane.0, &half_plane.1).conjugate();
                Ok(all.iter().flat_map(Patch::points).all(|p| p.times(&against).real_sign() == 1))
            }
            Self::Cells(cells) => Ok(cells.functional(half_plane, false)? == Signs::One(1)),
        }
    }

    /// Whether the Jacobian determinant has one strict sign.
    pub fn is_regular(&self) -> Checked<bool> {
        match self {
            Self::Patches(_, all) => Ok(one_sign(all.iter().flat_map(Patch::jacobian).map(|c| c.0.imaginary_sign()))),
            Self::Cells(cells) => Ok(matches!(cells.jacobian()?, Signs::One(_))),
        }
    }

    /// Whether it takes both strict signs.
    pub fn folds(&self) -> Checked<bool> {
        match self {
            Self::Patches(_, all) => {
                let corners = all.iter().flat_map(Patch::jacobian).filter(|c| c.1);
                let signs: Vec<i32> = corners.map(|c| c.0.imaginary_sign()).collect();
                Ok(signs.contains(&1) && signs.contains(&-1))
            }
            Self::Cells(cells) => Ok(cells.jacobian()? == Signs::Both),
        }
    }

    /// Whether the real part has one strict sign, on all of the ring or on a closed path around the centre.
    pub fn is_one_sided(&self, path: bool) -> Checked<bool> {
        match (self, path) {
            (Self::Patches(_, all), false) => Ok(one_sign(all.iter().flat_map(Patch::points).map(Ball::real_sign))),
            (Self::Patches(spline, all), true) => Ok(one_sign(boundary(*spline, all).iter().map(Ball::real_sign))),
            (Self::Cells(cells), _) => Ok(matches!(cells.functional(&(Q::one(), Q::zero()), path)?, Signs::One(_))),
        }
    }
}
