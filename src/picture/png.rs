//! Pictures as PNG, on white, without the words: what a font looks like depends on the machine.

use super::svg::Element;
use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

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
        "sc-open" => ([0x6b, 0x71, 0x7b], 2.0, false),
        _ => ([0x7a, 0x4f, 0xb5], 2.0, false),
    };
    Look { colour, width, dashed }
}

/// The elements as a PNG file, with so many pixels for each unit of the drawing; the same input gives the same bytes. `None`
/// where nothing finite can be drawn.
pub(super) fn render(elements: &[Element], [width, height]: [f64; 2], scale: f64) -> Option<Vec<u8>> {
    // Rounding never adds a pixel to a whole number of them.
    let pixels = |x: f64| (x * scale - 1e-6).ceil() as u32;
    let mut pixmap = Pixmap::new(pixels(width), pixels(height))?;
    pixmap.fill(Color::WHITE);
    let mut image = Sheet { pixmap, transform: Transform::from_scale(scale as f32, scale as f32) };
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
    image.pixmap.encode_png().ok()
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

/// The image in the making.
struct Sheet {
    pixmap: Pixmap,
    transform: Transform,
}

fn stroke(image: &mut Sheet, path: &Path, look: &Look) {
    let dash = if look.dashed { StrokeDash::new(vec![4.0, 3.0], 0.0) } else { None };
    let stroke = Stroke {
        width: look.width,
        line_cap: if look.dashed { LineCap::Butt } else { LineCap::Round },
        line_join: LineJoin::Round,
        dash,
        ..Stroke::default()
    };
    image.pixmap.stroke_path(path, &paint(look), &stroke, image.transform, None);
}

fn disc(image: &mut Sheet, at: [f64; 2], radius: f64, look: &Look) {
    if let Some(path) = PathBuilder::from_circle(at[0] as f32, at[1] as f32, radius as f32) {
        image.pixmap.fill_path(&path, &paint(look), FillRule::Winding, image.transform, None);
    }
}
