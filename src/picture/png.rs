//! Pictures as PNG, on white, without the words: what a font looks like depends on the machine.

use super::svg::Element;
use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

/// Pixels of the image for each unit of the drawing.
const SCALE: f32 = 2.0;

/// How a class of elements looks.
struct Look {
    colour: [u8; 3],
    width: f32,
    dashed: bool,
}

fn look(class: &str) -> Look {
    let (colour, width, dashed) = match class {
        "sc-p" => ([0x8a, 0x8f, 0x98], 1.0, true),
        "sc-k" => ([0x8a, 0x8f, 0x98], 1.0, false),
        "sc-c" => ([0x1f, 0x5f, 0xbf], 1.6, false),
        "sc-s" => ([0x1f, 0x5f, 0xbf], 1.3, false),
        "sc-tangent" => ([0x1a, 0x8a, 0x4a], 2.0, false),
        "sc-cusp" => ([0xb0, 0x6a, 0x00], 2.0, false),
        "sc-corner" => ([0xc4, 0x33, 0x2b], 2.0, false),
        _ => ([0x7a, 0x4f, 0xb5], 2.0, false),
    };
    Look { colour, width, dashed }
}

/// The elements as a PNG file; the same input gives the same bytes. `None` where nothing finite can be drawn.
pub(super) fn render(elements: &[Element], width: f64, height: f64) -> Option<Vec<u8>> {
    let pixels = |x: f64| (x as f32 * SCALE).ceil() as u32;
    let mut image = Pixmap::new(pixels(width), pixels(height))?;
    image.fill(Color::WHITE);
    for element in elements {
        match element {
            Element::Path { class, points } => {
                if let Some(path) = line(points) {
                    stroke(&mut image, &path, &look(class));
                }
            }
            Element::Cloud { class, points } => {
                let look = look(class);
                for p in points {
                    disc(&mut image, *p, f64::from(look.width) / 2.0, &look);
                }
            }
            Element::Disc { class, at, radius } => disc(&mut image, *at, *radius, &look(class)),
            Element::Label { .. } => {}
        }
    }
    image.encode_png().ok()
}

fn paint(look: &Look) -> Paint<'static> {
    let [r, g, b] = look.colour;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, 255);
    paint
}

fn line(points: &[[f64; 2]]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let (x, y) = (*x as f32, *y as f32);
        if k == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.finish()
}

fn stroke(image: &mut Pixmap, path: &Path, look: &Look) {
    let dash = if look.dashed { StrokeDash::new(vec![4.0, 3.0], 0.0) } else { None };
    let stroke = Stroke {
        width: look.width,
        line_cap: if look.dashed { LineCap::Butt } else { LineCap::Round },
        line_join: LineJoin::Round,
        dash,
        ..Stroke::default()
    };
    image.stroke_path(path, &paint(look), &stroke, Transform::from_scale(SCALE, SCALE), None);
}

fn disc(image: &mut Pixmap, at: [f64; 2], radius: f64, look: &Look) {
    if let Some(path) = PathBuilder::from_circle(at[0] as f32, at[1] as f32, radius as f32) {
        image.fill_path(&path, &paint(look), FillRule::Winding, Transform::from_scale(SCALE, SCALE), None);
    }
}
