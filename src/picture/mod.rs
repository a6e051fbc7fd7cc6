//! Pictures of attractors as SVG. Floats are used here and prove nothing; exact points only start the computation.
#![allow(clippy::float_arithmetic, reason = "pictures decide nothing")]

pub mod bar;
pub mod characteristic;
mod chart;
mod diagram;
mod field;
mod frame;
mod germ;
mod invariant;
pub mod mesh;
pub mod plane;
mod plot;
#[cfg(feature = "png")]
mod png;
mod projection;
mod svg;
mod tikz;
mod trace;

pub use chart::{CellBox, Turning, functional, turning as turning_chart};
pub use diagram::{Arrow, Dot, Drawing, automaton, spectrum};
pub use field::{ConeField, cone_field};
pub use germ::{profile, turning, zoom};
pub use invariant::polytope;
pub use plot::{PLOT_PIXELS, Plot};
pub use projection::{Projection, View};

use crate::arith::Rational;
use crate::shape::{CellKind, Shape};
use svg::Canvas;
use trace::Tracer;

/// The style sheet that every picture carries.
#[must_use]
pub fn style() -> &'static str {
    svg::STYLE
}

/// What is drawn at an examined point.
#[derive(Debug, Clone)]
pub struct Mark {
    /// The point, in the barycentric space of the start state.
    pub at: Vec<Rational>,
    /// Rays in the space where the shape is looked at (control points, or barycentric differences).
    pub rays: Vec<Vec<f64>>,
    /// The class of the mark.
    pub style: MarkStyle,
    /// A short label, such as an address.
    pub label: String,
}

/// How a mark looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MarkStyle {
    /// A tangent: half-tangent, regular point or oscillating point.
    Tangent,
    /// A cusp.
    Cusp,
    /// A corner.
    Corner,
    /// No tangent.
    Refuted,
    /// Not decided: a ring, so that it is told apart without colours too.
    Undecided,
}

impl MarkStyle {
    /// All of them, as a legend lists them.
    const ALL: [Self; 5] = [Self::Tangent, Self::Cusp, Self::Corner, Self::Refuted, Self::Undecided];

    /// The words of the legend.
    fn word(self) -> &'static str {
        match self {
            Self::Tangent => "tangent",
            Self::Cusp => "cusp",
            Self::Corner => "corner",
            Self::Refuted => "no tangent",
            Self::Undecided => "undetermined",
        }
    }
}

/// An SVG document of this crate at another width on the page; what it shows stays the same.
#[must_use]
pub fn resized(svg: &str, width: u32) -> String {
    let number = |key: &str, text: &str| -> Option<f64> {
        let (_, rest) = text.split_once(&format!(" {key}=\""))?;
        rest.split_once('"')?.0.parse().ok()
    };
    let Some((head, body)) = svg.split_once('>') else { return svg.to_owned() };
    let (Some(w), Some(h)) = (number("width", head), number("height", head)) else { return svg.to_owned() };
    let own = format!("width=\"{}\" height=\"{}\"", svg::fixed(w), svg::fixed(h));
    let new = format!("width=\"{width}\" height=\"{}\"", svg::fixed(h * f64::from(width) / w));
    format!("{}>{body}", head.replace(&own, &new))
}

/// A picture with the words that belong to it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// A complete SVG document; the same input gives the same bytes.
    pub svg: String,
    /// A small SVG of the shape alone, without marks.
    pub thumbnail: String,
    /// The same as a TikZ picture for LaTeX, with fewer points.
    pub tikz: String,
    /// What is to be seen and how it was projected.
    pub caption: String,
    /// The same for those who cannot see it.
    pub alt: String,
}

/// Draws the attractor of the start state with its control polygon and the marks.
///
/// Returns `None` where no point of the shape can be computed (it does not contract) or nothing finite results.
///
/// # Cost
/// At most a few times 10 000 small matrix products.
#[must_use]
pub fn attractor(shape: &Shape, title: &str, marks: &[Mark]) -> Option<Picture> {
    let projection = Projection::of(shape);
    let mut canvas = draw(shape, &projection, title, marks)?;
    canvas.legend(&MarkStyle::ALL.map(|style| (style, marks.iter().any(|m| m.style == style))));
    let what = match shape.states[shape.start].kind {
        CellKind::Edge => "curve",
        CellKind::Face => "face",
        CellKind::Vertex | CellKind::Set => "set",
    };
    let drawn = match marks.len() {
        0 => String::new(),
        1 => " One examined point is marked.".to_owned(),
        n => format!(" {n} examined points are marked."),
    };
    let framed = polygon(shape, &projection).len() >= 2;
    let with = if framed { " with its control polygon" } else { "" };
    let seen = match (framed, marks.iter().any(|m| !m.rays.is_empty())) {
        (true, true) => ", its control polygon and the limit rays found",
        (true, false) => " and its control polygon",
        (false, true) => " and the limit rays found",
        (false, false) => "",
    };
    let caption = format!("The {what}{seen}. {}{drawn}", projection.words());
    let alt = format!("Drawing of the {what} “{title}”{with}. {}{drawn}", projection.words());
    Some(Picture {
        svg: canvas.svg(),
        thumbnail: canvas.thumbnail(),
        tikz: tikz::picture(canvas.elements()),
        caption,
        alt,
    })
}

/// A shape as points of the plane, for a drawing that is made elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Points of the shape: of a curve in its order.
    pub points: Vec<[f64; 2]>,
    /// The corners of the control polygon; none of affine maps.
    pub polygon: Vec<[f64; 2]>,
    /// How it was projected, in one sentence.
    pub words: &'static str,
}

/// The points that [`attractor`] draws; `None` where it draws nothing.
#[must_use]
pub fn outline(shape: &Shape) -> Option<Outline> {
    let projection = Projection::of(shape);
    let points = Tracer::new(shape)?.points(&projection);
    let polygon = polygon(shape, &projection);
    let finite = points.iter().chain(&polygon).flatten().all(|x| x.is_finite());
    (finite && !points.is_empty()).then(|| Outline { points, polygon, words: projection.words() })
}

/// The drawing of [`attractor`] as a PNG file on white, without the words, so many pixels wide; the same input gives the same bytes.
///
/// Returns `None` where [`attractor`] does.
#[cfg(feature = "png")]
#[must_use]
pub fn attractor_png(shape: &Shape, marks: &[Mark], pixels: u32) -> Option<Vec<u8>> {
    let canvas = draw(shape, &Projection::of(shape), "", marks)?;
    let [width, height] = canvas.size();
    png::render(canvas.elements(), [width, height], f64::from(pixels) / width)
}

/// The control polygon; the control points of a surface have no such order.
fn polygon(shape: &Shape, projection: &Projection) -> Vec<[f64; 2]> {
    if shape.states[shape.start].kind == CellKind::Face { Vec::new() } else { projection.polygon() }
}

fn draw(shape: &Shape, projection: &Projection, title: &str, marks: &[Mark]) -> Option<Canvas> {
    let tracer = Tracer::new(shape)?;
    let points = tracer.points(projection);
    let polygon = polygon(shape, projection);
    let spots: Vec<[f64; 2]> = marks.iter().map(|m| projection.point(&m.at)).collect();
    let all: Vec<[f64; 2]> = points.iter().chain(&polygon).chain(&spots).copied().collect();
    if points.is_empty() || !all.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    let mut canvas = Canvas::around(&all, title);
    canvas.polygon(&polygon);
    if shape.states[shape.start].kind == CellKind::Edge {
        canvas.curve(&points);
    } else {
        canvas.cloud(&points);
    }
    for (mark, at) in marks.iter().zip(&spots) {
        let rays: Vec<[f64; 2]> = mark.rays.iter().map(|r| projection.direction(r)).collect();
        canvas.mark(mark.style, *at, &rays);
    }
    for (mark, at) in marks.iter().zip(&spots) {
        canvas.label(*at, &mark.label);
    }
    Some(canvas)
}

/// The width of an image where nobody says another, in pixels.
pub const PIXELS: u32 = 1280;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;

    fn spline() -> Shape {
        let m = |rows: [[i64; 3]; 3]| Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 4));
        Shape::single(CellKind::Edge, vec![m([[3, 1, 0], [1, 3, 3], [0, 0, 1]]), m([[1, 0, 0], [3, 3, 1], [0, 1, 3]])])
    }

    #[test]
    fn the_same_bytes_every_time() {
        let mark = Mark {
            at: vec![ratio(1, 2), ratio(1, 2), ratio(0, 1)],
            rays: vec![vec![-1.0, 1.0, 0.0]],
            style: MarkStyle::Tangent,
            label: "(0) <&>".into(),
        };
        let a = attractor(&spline(), "a & b", std::slice::from_ref(&mark)).unwrap();
        let b = attractor(&spline(), "a & b", &[mark]).unwrap();
        assert_eq!(a, b);
        assert!(a.svg.contains("a &amp; b") && a.svg.contains("(0) &lt;&amp;&gt;"));
        assert!(a.caption.contains("triangle"));
        assert!(a.svg.len() < 200_000, "{}", a.svg.len());
    }

    #[test]
    fn what_is_not_decided_is_not_drawn_as_refuted() {
        let at =
            |style| Mark { at: vec![ratio(1, 2), ratio(1, 2), ratio(0, 1)], rays: vec![], style, label: String::new() };
        let drawn = |styles: &[MarkStyle]| {
            attractor(&spline(), "t", &styles.iter().map(|s| at(*s)).collect::<Vec<_>>()).unwrap().svg
        };
        let body = |svg: String| svg.split_once("</style>").unwrap().1.to_owned();
        let (refuted, open) = (body(drawn(&[MarkStyle::Refuted])), body(drawn(&[MarkStyle::Undecided])));
        assert!(refuted.contains("no tangent") && refuted.contains("sc-none") && !refuted.contains("sc-open"));
        assert!(open.contains("undetermined") && open.contains("sc-open") && !open.contains("sc-none"));
        let both = body(drawn(&[MarkStyle::Refuted, MarkStyle::Undecided]));
        assert!(both.contains("no tangent") && both.contains("undetermined") && !both.contains(">cusp<"));
        assert!(!body(drawn(&[])).contains("<text"));
    }

    #[test]
    fn a_picture_of_another_size_shows_the_same() {
        let svg = attractor(&spline(), "t", &[]).unwrap().svg;
        let large = resized(&svg, 1280);
        assert!(svg.contains(" width=\"640\"") && large.contains(" width=\"1280\""));
        let rest = |text: &str| text.split_once('>').unwrap().1.to_owned();
        assert_eq!(rest(&svg), rest(&large));
        let view = |text: &str| text.split("viewBox").nth(1).unwrap().split('"').nth(1).unwrap().to_owned();
        assert_eq!(view(&svg), view(&large));
    }

    #[cfg(feature = "png")]
    #[test]
    fn an_image_has_the_same_bytes_every_time() {
        let png = attractor_png(&spline(), &[], PIXELS).unwrap();
        assert!(png.starts_with(b"\x89PNG") && attractor_png(&spline(), &[], PIXELS).unwrap() == png);
        for pixels in [100, 1000] {
            let png = attractor_png(&spline(), &[], pixels).unwrap();
            assert_eq!(u32::from_be_bytes(png[16..20].try_into().unwrap()), pixels);
        }
    }

    #[test]
    fn a_set_is_a_cloud_of_points() {
        let mut shape = spline();
        shape.states[0].kind = CellKind::Set;
        let picture = attractor(&shape, "t", &[]).unwrap();
        assert!(picture.svg.contains("h0"));
    }

    #[test]
    fn no_picture_of_what_does_not_contract() {
        let shape = Shape::single(CellKind::Edge, vec![Matrix::identity(3)]);
        assert!(attractor(&shape, "t", &[]).is_none());
    }
}
