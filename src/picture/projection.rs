use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;
use crate::shape::{Frame, Shape};
use nalgebra::DMatrix;

/// From where a shape in space is seen: two angles in degrees, as a map has them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The angle of the eye around the third axis, 0 on the first axis and 90 on the second.
    pub azimuth: f64,
    /// The angle of the eye above the plane of the first two axes, from −90 to 90.
    pub elevation: f64,
}

impl View {
    /// Reads `30,20`, or one of `front`, `back`, `left`, `right`, `top`, `bottom`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let named = match text {
            "front" => Some((-90.0, 0.0)),
            "back" => Some((90.0, 0.0)),
            "left" => Some((180.0, 0.0)),
            "right" => Some((0.0, 0.0)),
            "top" => Some((-90.0, 90.0)),
            "bottom" => Some((-90.0, -90.0)),
            _ => None,
        };
        let angles = || {
            let (a, e) = text.split_once(',')?;
            Some((a.trim().parse().ok()?, e.trim().parse().ok()?))
        };
        let (azimuth, elevation): (f64, f64) = named.or_else(angles)?;
        let fits = (-360.0..=360.0).contains(&azimuth) && (-90.0..=90.0).contains(&elevation);
        fits.then_some(Self { azimuth, elevation })
    }

    /// The directions to the right and up in the picture, and the one to the eye.
    fn axes(self) -> [[f64; 3]; 3] {
        let ((sa, ca), (se, ce)) = (self.azimuth.to_radians().sin_cos(), self.elevation.to_radians().sin_cos());
        [[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]]
    }
}

/// The direction to the eye where nobody says another: that of [`slanted`], roughly.
const EYE: [f64; 3] = [0.35, -1.0, 0.35];

/// A linear map from the barycentric space of the start state to the plane of the drawing.
#[derive(Debug, Clone)]
pub struct Projection {
    /// From the space where the shape is looked at to the plane.
    plane: DMatrix<f64>,
    /// From barycentric coordinates to the plane.
    whole: DMatrix<f64>,
    words: &'static str,
    corners: usize,
    eye: [f64; 3],
}

pub(super) fn floats(m: &Matrix) -> DMatrix<f64> {
    DMatrix::from_fn(m.rows(), m.cols(), |i, j| to_f64(&m[(i, j)]))
}

impl Projection {
    /// Chooses the projection: control points in the plane as they are, in space from a fixed direction; barycentric
    /// coordinates with the control points at the corners of a regular polygon.
    #[must_use]
    pub fn of(shape: &Shape) -> Self {
        Self::seen(shape, None)
    }

    /// The same, with control points in space seen as is said.
    #[must_use]
    pub fn seen(shape: &Shape, view: Option<View>) -> Self {
        let n = shape.states[shape.start].dim;
        let Some(control) = &shape.control else {
            let plane = regular(n);
            let words = match n {
                0..=2 => "Barycentric coordinates are drawn on a line.",
                3 => "Barycentric coordinates are drawn in the plane triangle of the control points.",
                _ => {
                    "Barycentric coordinates are projected to the plane with the control points at the corners of a regular polygon."
                }
            };
            return Self { whole: plane.clone(), plane, words, corners: n, eye: EYE };
        };
        let (plane, words) = match control.rows() {
            1 => (DMatrix::from_row_slice(2, 1, &[1.0, 0.0]), "The points lie on a line."),
            2 if shape.frame == Frame::Affine => (DMatrix::identity(2, 2), "Drawn in its plane."),
            2 => (DMatrix::identity(2, 2), "Drawn in the plane of the control points."),
            d => match view {
                Some(view) => {
                    let axes = view.axes();
                    let plane = DMatrix::from_fn(2, d, |i, j| if j < 3 { axes[i][j] } else { 0.0 });
                    (plane, "Drawn from the given direction in space.")
                }
                None => (slanted(d), "Drawn from a fixed direction in space."),
            },
        };
        let whole = &plane * floats(control);
        let corners = if shape.frame == Frame::Affine { 0 } else { n };
        Self { plane, whole, words, corners, eye: view.map_or(EYE, |v| v.axes()[2]) }
    }

    /// The direction to the eye.
    pub(super) fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// The projection in one sentence.
    #[must_use]
    pub fn words(&self) -> &'static str {
        self.words
    }

    /// The map from barycentric coordinates of the start state.
    pub(super) fn matrix(&self) -> &DMatrix<f64> {
        &self.whole
    }

    /// The corners of the control polygon; none where the case has affine maps.
    pub(super) fn polygon(&self) -> Vec<[f64; 2]> {
        (0..self.corners).map(|j| [self.whole[(0, j)], self.whole[(1, j)]]).collect()
    }

    /// Where a point of the start state is drawn.
    #[must_use]
    pub fn point(&self, x: &[Rational]) -> [f64; 2] {
        let x = DMatrix::from_fn(x.len(), 1, |i, _| to_f64(&x[i]));
        let p = &self.whole * x;
        [p[0], p[1]]
    }

    /// The drawn direction of a vector of the space where the shape is looked at; 0 where the sizes differ.
    #[must_use]
    pub fn direction(&self, v: &[f64]) -> [f64; 2] {
        if v.len() != self.plane.ncols() {
            return [0.0, 0.0];
        }
        let p = &self.plane * DMatrix::from_column_slice(v.len(), 1, v);
        [p[0], p[1]]
    }
}

/// The corners of a regular polygon, the first and the last at the bottom.
fn regular(n: usize) -> DMatrix<f64> {
    use std::f64::consts::PI;
    if n <= 2 {
        return DMatrix::from_fn(2, n, |i, j| if i == 0 { j as f64 } else { 0.0 });
    }
    let step = 2.0 * PI / n as f64;
    DMatrix::from_fn(2, n, |i, j| {
        let angle = -PI / 2.0 - step * (j as f64 + 0.5);
        if i == 0 { angle.cos() } else { angle.sin() }
    })
}

/// The first three coordinates seen from a fixed direction.
fn slanted(d: usize) -> DMatrix<f64> {
    let axes = [[0.94, -0.15], [-0.34, -0.42], [0.0, 0.9]];
    DMatrix::from_fn(2, d, |i, j| if j < 3 { axes[j][i] } else { 0.0 })
}
