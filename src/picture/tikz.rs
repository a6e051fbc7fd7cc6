use super::svg::{Anchor, Element, fixed, spaced};
use std::fmt::Write;

/// Most points of a path; TeX's memory is small.
const MAX_POINTS: usize = 1_200;
/// Points per pixel.
const UNIT: &str = "0.52pt";

/// The drawing as a `tikzpicture`; the colours are those that the LaTeX report defines.
pub(super) fn picture(elements: &[Element]) -> String {
    let mut out = format!("\\begin{{tikzpicture}}[x={UNIT},y=-{UNIT},line join=round,line cap=round]\n");
    for element in elements {
        write_element(&mut out, element);
    }
    out.push_str("\\end{tikzpicture}\n");
    out
}

fn colour(class: &str) -> &'static str {
    match class {
        "sc-p" => "neutral,dashed",
        "sc-k" => "neutral",
        "sc-c" | "sc-s" => "curve",
        "sc-a" => "neutral",
        "sc-x" => "curve,fill=curve!20",
        "sc-y" => "cusp,fill=cusp!20",
        "sc-tangent" => "tangent,thick",
        "sc-cusp" => "cusp,thick",
        "sc-corner" => "corner,thick",
        "sc-open" => "neutral,thick",
        _ => "notangent,thick",
    }
}

fn write_element(out: &mut String, element: &Element) {
    let spot = |p: &[f64; 2]| format!("({},{})", fixed(p[0]), fixed(p[1]));
    match element {
        Element::Path { class, points } => {
            let _ = write!(out, "\\draw[{}] ", colour(class));
            for (k, p) in thinned(points).iter().enumerate() {
                let joint = if k == 0 { "" } else { "--" };
                // Lines of the file stay short.
                let end = if k % 8 == 7 { "\n" } else { "" };
                let _ = write!(out, "{joint}{}{end}", spot(p));
            }
            out.push_str(";\n");
        }
        Element::Cloud { class, points } => {
            for chunk in thinned(points).chunks(8) {
                let _ = write!(out, "\\fill[{}]", colour(class));
                for p in chunk {
                    let _ = write!(out, " {} circle[radius=0.3pt]", spot(p));
                }
                out.push_str(";\n");
            }
        }
        Element::Disc { class, at, radius } => {
            let radius = fixed(radius * 0.52);
            let _ = writeln!(out, "\\fill[{}] {} circle[radius={radius}pt];", colour(class), spot(at));
        }
        Element::Label { at, anchor, text } => {
            let side = match anchor {
                Anchor::Start => "base west",
                Anchor::Middle => "base",
                Anchor::End => "base east",
            };
            let text = crate::escape::latex(text);
            let _ = writeln!(out, "\\node[anchor={side},inner sep=0pt,font=\\scriptsize] at {} {{{text}}};", spot(at));
        }
    }
}

/// Drops points near the one kept before until few enough are left.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut distance = 0.7;
    loop {
        let out = spaced(points, distance);
        if out.len() <= MAX_POINTS || distance > 100.0 {
            return out;
        }
        distance *= 1.4;
    }
}
