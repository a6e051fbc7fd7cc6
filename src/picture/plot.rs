//! Plain drawings of exact points, coloured by address: SVG, PNG, OBJ and PLY. Points become floats here and nowhere before.
#![allow(clippy::float_arithmetic, reason = "pictures decide nothing")]

use super::svg::fixed;
use super::{Projection, View};
use crate::arith::to_f64;
use crate::shape::{Frame, Sample, Shape};
use std::fmt::Write;

const SIZE: f64 = 800.0;
const MARGIN: f64 = 24.0;
/// The width of an image where nobody says another, in pixels.
pub const PLOT_PIXELS: u32 = 800;
/// Number of colours.
const COLOURS: usize = 48;

/// Points of an attractor, ready to be written.
pub struct Plot {
    /// Three coordinates each.
    solid: Vec<[f64; 3]>,
    /// Pixels, y pointing down.
    flat: Vec<[f64; 2]>,
    colours: Vec<[u8; 3]>,
    faces: Vec<(Vec<usize>, [u8; 3])>,
    curve: bool,
    height: f64,
    eye: [f64; 3],
}

/// A part of the drawing in one colour.
enum Stroked<'a> {
    Line(Vec<[f64; 2]>, [u8; 3]),
    Dots(Vec<[f64; 2]>, [u8; 3]),
    Face(&'a [usize], [u8; 3]),
}

/// A colour of the wheel for a number in `[0, 1]`.
fn colour(t: f64) -> [u8; 3] {
    let bin = (t.clamp(0.0, 1.0) * (COLOURS - 1) as f64).round() / COLOURS as f64;
    // Not the whole wheel: the first and the last address stay apart.
    let hue = bin * 5.0;
    let ramp = |shift: f64| {
        let x = (hue + shift) % 6.0;
        (2.0 - (x - 3.0).abs()).clamp(0.0, 1.0)
    };
    [3.0, 1.0, 5.0].map(|shift| (ramp(shift) * 175.0 + 30.0).round() as u8)
}

impl Plot {
    /// The drawing of a sample, of a shape in space as it is seen; `None` where a coordinate is too large for a float, or there is
    /// no point.
    #[must_use]
    pub fn new(shape: &Shape, sample: &Sample, curve: bool, view: Option<View>) -> Option<Self> {
        let projection = Projection::seen(shape, view);
        let coordinates: Vec<Vec<f64>> = sample.points.iter().map(|p| p.iter().map(to_f64).collect()).collect();
        let drawn: Vec<[f64; 2]> = coordinates.iter().map(|p| projection.direction(p)).collect();
        // Barycentric coordinates have no place in space of their own: they are written as they are drawn.
        let place = |(p, d): (&Vec<f64>, &[f64; 2])| {
            if shape.control.is_none() && shape.frame == Frame::Barycentric {
                return [d[0], d[1], 0.0];
            }
            [0, 1, 2].map(|k| p.get(k).copied().unwrap_or(0.0))
        };
        let solid: Vec<[f64; 3]> = coordinates.iter().zip(&drawn).map(place).collect();
        if drawn.is_empty() || !solid.iter().flatten().all(|x| x.is_finite()) {
            return None;
        }
        let bound = |k: usize, pick: fn(f64, f64) -> f64, from: f64| drawn.iter().map(|p| p[k]).fold(from, pick);
        let low = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY));
        let high = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
        let span = [(high[0] - low[0]).max(1e-9), (high[1] - low[1]).max(1e-9)];
        let room = SIZE - 2.0 * MARGIN;
        let scale = (room / span[0]).min(room / span[1]);
        let height = ((high[1] - low[1]) * scale + 2.0 * MARGIN).max(2.0 * MARGIN);
        let left = (SIZE - (high[0] - low[0]) * scale) / 2.0;
        let flat = drawn.iter().map(|p| [left + (p[0] - low[0]) * scale, height - MARGIN - (p[1] - low[1]) * scale]);
        Some(Self {
            flat: flat.collect(),
            colours: sample.parameters.iter().map(|t| colour(to_f64(t))).collect(),
            faces: sample.faces.iter().map(|(c, t)| (c.clone(), colour(to_f64(t)))).collect(),
            solid,
            curve,
            height,
            eye: projection.eye(),
        })
    }

    /// The polygons, those in front last.
    fn painted(&self) -> Vec<&(Vec<usize>, [u8; 3])> {
        let near = |face: &(Vec<usize>, [u8; 3])| {
            let mean = |k: usize| face.0.iter().map(|v| self.solid[*v][k]).sum::<f64>() / face.0.len().max(1) as f64;
            (0..3).map(|k| self.eye[k] * mean(k)).sum::<f64>()
        };
        let mut order: Vec<_> = self.faces.iter().collect();
        order.sort_by(|a, b| near(a).total_cmp(&near(b)));
        order
    }

    fn strokes(&self) -> Vec<Stroked<'_>> {
        if !self.faces.is_empty() {
            return self.painted().into_iter().map(|(c, colour)| Stroked::Face(c, *colour)).collect();
        }
        if !self.curve {
            let mut dots: std::collections::BTreeMap<[u8; 3], Vec<[f64; 2]>> = std::collections::BTreeMap::new();
            for (p, c) in self.flat.iter().zip(&self.colours) {
                dots.entry(*c).or_default().push(*p);
            }
            return dots.into_iter().map(|(c, p)| Stroked::Dots(p, c)).collect();
        }
        let mut lines = Vec::new();
        let mut first = 0;
        for k in 1..self.flat.len() {
            if self.colours[k] != self.colours[first] || k + 1 == self.flat.len() {
                lines.push(Stroked::Line(self.flat[first..=k].to_vec(), self.colours[first]));
                first = k;
            }
        }
        lines
    }

    /// A complete SVG document.
    #[must_use]
    pub fn svg(&self, title: &str) -> String {
        let (w, h) = (fixed(SIZE), fixed(self.height));
        let mut body = String::new();
        for stroke in self.strokes() {
            let path = |points: &mut dyn Iterator<Item = [f64; 2]>, dots: bool| {
                let mut d = String::new();
                for (k, [x, y]) in points.enumerate() {
                    let letter = if k == 0 || dots { 'M' } else { 'L' };
                    let _ = write!(d, "{letter}{} {}{}", fixed(x), fixed(y), if dots { "h0" } else { "" });
                }
                d
            };
            let _ = match stroke {
                Stroked::Line(points, c) => {
                    writeln!(body, "<path stroke=\"{}\" d=\"{}\"/>", hex(c), path(&mut points.into_iter(), false))
                }
                Stroked::Dots(points, c) => {
                    writeln!(body, "<path stroke=\"{}\" d=\"{}\"/>", hex(c), path(&mut points.into_iter(), true))
                }
                Stroked::Face(corners, c) => {
                    let d = path(&mut corners.iter().map(|v| self.flat[*v]), false);
                    writeln!(body, "<path fill=\"{}\" stroke=\"#333\" stroke-width=\".4\" d=\"{d}Z\"/>", hex(c))
                }
            };
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\">\n\
             <title>{}</title>\n<g fill=\"none\" stroke-width=\"1.5\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
             {body}</g>\n</svg>\n",
            super::svg::escaped(title)
        )
    }

    /// A PNG image on white, so many pixels wide; `None` where it cannot be encoded.
    #[cfg(feature = "png")]
    #[must_use]
    pub fn png(&self, width: u32) -> Option<Vec<u8>> {
        use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};
        let scale = f64::from(width) / SIZE;
        let place = Transform::from_scale(scale as f32, scale as f32);
        let step = |path: &mut PathBuilder, k: usize, [x, y]: [f64; 2]| {
            if k == 0 { path.move_to(x as f32, y as f32) } else { path.line_to(x as f32, y as f32) }
        };
        let mut pixels = Pixmap::new(width, ((self.height * scale - 1e-6).ceil() as u32).max(1))?;
        pixels.fill(Color::WHITE);
        let mut stroke =
            Stroke { width: 1.5, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
        for part in self.strokes() {
            let mut path = PathBuilder::new();
            let (colour, close) = match &part {
                Stroked::Line(points, c) => {
                    points.iter().enumerate().for_each(|(k, p)| step(&mut path, k, *p));
                    (*c, false)
                }
                Stroked::Dots(points, c) => {
                    for [x, y] in points {
                        path.move_to(*x as f32, *y as f32);
                        path.line_to(*x as f32 + 0.01, *y as f32);
                    }
                    (*c, false)
                }
                Stroked::Face(corners, c) => {
                    corners.iter().enumerate().for_each(|(k, v)| step(&mut path, k, self.flat[*v]));
                    path.close();
                    (*c, true)
                }
            };
            let Some(path) = path.finish() else { continue };
            let mut paint = Paint::default();
            paint.set_color_rgba8(colour[0], colour[1], colour[2], 255);
            if close {
                pixels.fill_path(&path, &paint, FillRule::Winding, place, None);
                paint.set_color_rgba8(51, 51, 51, 255);
                stroke.width = 0.4;
            }
            pixels.stroke_path(&path, &paint, &stroke, place, None);
        }
        pixels.encode_png().ok()
    }

    /// A Wavefront OBJ file: polygons of a surface, a line of a curve, points of a set.
    #[must_use]
    pub fn obj(&self, title: &str) -> String {
        let mut out = format!("# {}\n", title.replace(['\n', '\r'], " "));
        for [x, y, z] in &self.solid {
            let _ = writeln!(out, "v {x} {y} {z}");
        }
        let numbers =
            |list: &mut dyn Iterator<Item = usize>| list.map(|k| (k + 1).to_string()).collect::<Vec<_>>().join(" ");
        for (corners, _) in &self.faces {
            let _ = writeln!(out, "f {}", numbers(&mut corners.iter().copied()));
        }
        if self.faces.is_empty() {
            let letter = if self.curve { 'l' } else { 'p' };
            let _ = writeln!(out, "{letter} {}", numbers(&mut (0..self.solid.len())));
        }
        out
    }

    /// A PLY file (ASCII) with the colours of points and polygons.
    #[must_use]
    pub fn ply(&self, title: &str) -> String {
        let edges = if self.curve { self.solid.len().saturating_sub(1) } else { 0 };
        let colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
        let mut out = format!(
            "ply\nformat ascii 1.0\ncomment {}\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
             {colour}",
            title.replace(['\n', '\r'], " "),
            self.solid.len()
        );
        if !self.faces.is_empty() {
            let _ = write!(out, "element face {}\nproperty list uchar int vertex_indices\n{colour}", self.faces.len());
        }
        if edges > 0 {
            let _ = write!(out, "element edge {edges}\nproperty int vertex1\nproperty int vertex2\n");
        }
        out.push_str("end_header\n");
        for ([x, y, z], [r, g, b]) in self.solid.iter().zip(&self.colours) {
            let _ = writeln!(out, "{x} {y} {z} {r} {g} {b}");
        }
        for (corners, [r, g, b]) in &self.faces {
            let list: Vec<String> = corners.iter().map(ToString::to_string).collect();
            let _ = writeln!(out, "{} {} {r} {g} {b}", list.len(), list.join(" "));
        }
        (0..edges).for_each(|k| {
            let _ = writeln!(out, "{k} {}", k + 1);
        });
        out
    }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
