//! A mesh as a drawing and as a PLY file, its vertices coloured by verdict.

use crate::answer::Verdict;
use crate::arith::to_f64;
use crate::escape::html as escaped;
use crate::mesh::{Found, Model, Spot};
use std::fmt::Write;

/// Faces that are drawn at most.
const MOST: usize = 20_000;
/// Vertices whose proved ones get a dot too.
const DOTS: usize = 1_500;
const SIZE: f64 = 640.0;

fn colour(verdict: Verdict) -> (&'static str, [u8; 3]) {
    match verdict {
        Verdict::Proved => ("#1a8a4a", [0x1a, 0x8a, 0x4a]),
        Verdict::Refuted => ("#c4332b", [0xc4, 0x33, 0x2b]),
        Verdict::Undetermined => ("#7a4fb5", [0x7a, 0x4f, 0xb5]),
    }
}

/// The verdict of each vertex of the file: of the vertex, and of the rings around it.
fn verdicts(model: &Model, found: &Found) -> Vec<Option<Verdict>> {
    let mut all = vec![None; model.points.len()];
    for v in &found.vertices {
        if let Spot::Vertex(k) = v.spot {
            let own = if v.smooth == Verdict::Proved && !v.surrounded() { Verdict::Undetermined } else { v.smooth };
            // Of several sides the worst one.
            all[k] = Some(all[k].map_or(own, |other: Verdict| other.and(own)));
        }
    }
    all
}

/// The mesh as a PLY file; grey vertices belong to no face.
#[must_use]
pub fn ply(model: &Model, found: &Found) -> String {
    let mut out = format!(
        "ply\nformat ascii 1.0\ncomment green: C1 is proved there; red: refuted; violet: undetermined\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar green\n\
         property uchar blue\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        model.points.len(),
        model.topology.faces()
    );
    for (point, verdict) in model.points.iter().zip(verdicts(model, found)) {
        let [r, g, b] = verdict.map_or([0x8a, 0x8f, 0x98], |v| colour(v).1);
        let [x, y, z] = [0, 1, 2].map(|k| to_f64(&point[k]));
        let _ = writeln!(out, "{x} {y} {z} {r} {g} {b}");
    }
    for f in 0..model.topology.faces() {
        let corners: Vec<String> = model.topology.polygon(f).iter().map(ToString::to_string).collect();
        let _ = writeln!(out, "{} {}", corners.len(), corners.join(" "));
    }
    out
}

/// The mesh seen from above at an angle; `None` where it is too large to be drawn.
#[must_use]
#[allow(clippy::float_arithmetic, reason = "a picture")]
pub fn svg(model: &Model, found: &Found, title: &str) -> Option<String> {
    if model.topology.faces() > MOST {
        return None;
    }
    let seen = |p: &[f64; 3]| {
        let (x, y) = (0.82 * p[0] - 0.57 * p[1], 0.57 * p[0] + 0.82 * p[1]);
        [x, 0.42 * y + 0.91 * p[2], -0.91 * y + 0.42 * p[2]]
    };
    let points: Vec<[f64; 3]> = model.points.iter().map(|p| seen(&[0, 1, 2].map(|k| to_f64(&p[k])))).collect();
    let used: Vec<&[f64; 3]> = model.topology.vertex.iter().map(|v| &points[*v as usize]).collect();
    let range = |k: usize| used.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[k]), b.max(p[k])));
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    let scale = (SIZE - 40.0) / (x1 - x0).max(y1 - y0);
    if !scale.is_finite() {
        return None;
    }
    let place = |p: &[f64; 3]| (20.0 + (p[0] - x0) * scale, 20.0 + (y1 - p[1]) * scale);
    let height = 40.0 + (y1 - y0) * scale;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {height:.1}\" role=\"img\"><title>{}</title>\n",
        escaped(title)
    );
    let bad: Vec<usize> = found.patches.bad.iter().map(|b| b.face).collect();
    let depth = |f: usize| {
        let corners = model.topology.polygon(f);
        corners.iter().map(|v| points[*v as usize][2]).sum::<f64>() / corners.len() as f64
    };
    let mut order: Vec<usize> = (0..model.topology.faces()).collect();
    order.sort_by(|a, b| depth(*a).total_cmp(&depth(*b)));
    for f in order {
        let corners: Vec<String> = model
            .topology
            .polygon(f)
            .iter()
            .map(|v| {
                let (x, y) = place(&points[*v as usize]);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        let fill = if bad.contains(&f) { "#f3c4c0" } else { "#dfe6f0" };
        let _ = writeln!(
            out,
            "<polygon points=\"{}\" fill=\"{fill}\" fill-opacity=\".75\" stroke=\"#6b717b\" stroke-width=\".6\"/>",
            corners.join(" ")
        );
    }
    for (point, verdict) in points.iter().zip(verdicts(model, found)) {
        let Some(verdict) = verdict.filter(|v| *v != Verdict::Proved || model.points.len() <= DOTS) else { continue };
        let (x, y) = place(point);
        let radius = if verdict == Verdict::Proved { 2.5 } else { 5.0 };
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{}\"/>", colour(verdict).0);
    }
    out.push_str("</svg>\n");
    Some(out)
}
