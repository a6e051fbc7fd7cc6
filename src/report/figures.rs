//! The pictures of a report.

use super::document::{Block, Line, line, words};
use super::reported::Reported;
use super::text::math_line;
use super::values::{root_decimals, root_math};
use super::words::{addresses, count, listed, point_name};
use crate::algebraic::{Elem, Root};
use crate::arith::{Rational, to_f64};
use crate::case::Case;
use crate::jordan::{Eigenvalue, Spectral};
use crate::picture::{self, Arrow, CellBox, Dot, Drawing, Mark, MarkStyle, Picture};
use crate::shape::{CellKind, Shape, word_text};
use crate::theorem::{
    BranchReport, Certified, Discharged, Kind, Outcome, PointReport, Position, RingProof, Role, Verdict,
};

/// Most points that are marked in a picture.
const MAX_MARKS: usize = 12;

/// The attractor with the points examined and the rays found there; `None` where it cannot be drawn.
#[must_use]
pub fn attractor<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Option<Picture> {
    let marks: Vec<Mark> = found.points.iter().take(MAX_MARKS).map(mark).collect();
    let mut picture = picture::attractor(&E::drawn(&case.shape), &case.title, &marks)?;
    let named: Vec<String> =
        found.points.iter().map(|p| format!("{}: {}", point_name(&case.shape, p), verdict_word(p))).collect();
    if !named.is_empty() {
        picture.alt = format!("{} {}.", picture.alt, named.join("; "));
    }
    Some(picture)
}

/// The picture of [`attractor`] as a PNG file, so many pixels wide, without the words in it.
#[cfg(feature = "png")]
#[must_use]
pub fn attractor_png<E: Reported>(case: &Case<E>, found: &Certified<E>, pixels: u32) -> Option<Vec<u8>> {
    let marks: Vec<Mark> = found.points.iter().take(MAX_MARKS).map(mark).collect();
    picture::attractor_png(&E::drawn(&case.shape), &marks, pixels)
}

fn figure(drawing: Drawing, alt: String, caption: Line) -> Block {
    Block::Figure { svg: drawing.svg, tikz: drawing.tikz, alt, caption }
}

/// Most states of an automaton that is drawn.
const MAX_STATES: usize = 14;

/// The automaton as a graph, where there is more than one state.
#[must_use]
pub fn automaton<E: Reported>(shape: &Shape<E>) -> Option<Block> {
    let names: Vec<String> = shape.states.iter().map(|s| s.name.clone()).collect();
    if !(2..=MAX_STATES).contains(&names.len()) {
        return None;
    }
    let mut arrows: Vec<Arrow> = Vec::new();
    for (from, state) in shape.states.iter().enumerate() {
        for (letter, piece) in state.pieces.iter().enumerate() {
            let label = if piece.reversed { format!("{letter} back") } else { letter.to_string() };
            match arrows.iter_mut().find(|a| a.from == from && a.to == piece.target) {
                Some(arrow) => arrow.label = format!("{}, {label}", arrow.label),
                None => arrows.push(Arrow { from, to: piece.target, label }),
            }
        }
    }
    let told: Vec<String> =
        arrows.iter().map(|a| format!("from {} to {} by {}", names[a.from], names[a.to], a.label)).collect();
    let alt = format!("Graph of the automaton, started at {}: {}.", names[shape.start], told.join("; "));
    let caption =
        format!("The automaton; an arrow carries the letters of its pieces, and {} is the start.", names[shape.start]);
    Some(figure(picture::automaton(&names, shape.start, &arrows, "The automaton"), alt, words(caption)))
}

/// Most eigenvalues that are labelled.
const MAX_LABELS: usize = 8;

/// The eigenvalues of a cycle in the complex plane.
#[must_use]
pub fn spectrum<S: Spectral>(spectrum: &S) -> Option<Block> {
    let rational = |m: &Eigenvalue| spectrum.value(*m).rational().is_some();
    if spectrum.classes().iter().flat_map(|c| &c.members).all(rational) {
        return None;
    }
    let members: Vec<_> =
        spectrum.classes().iter().enumerate().flat_map(|(k, c)| c.members.iter().map(move |m| (k, *m))).collect();
    let mut dots = Vec::new();
    let mut told = Vec::new();
    for &(class, member) in &members {
        let root = spectrum.value(member);
        let (re, im) = root.enclosure(60);
        let text = math_line(&root_math(root));
        let short = if text.chars().count() <= 14 {
            text
        } else {
            let (re, im) = root_decimals(root);
            if root.is_real() { re } else { format!("{re} + {im} i").replace("+ -", "− ") }
        };
        let label = if members.len() <= MAX_LABELS { short.clone() } else { String::new() };
        told.push(short);
        dots.push(Dot { re: to_f64(&re.mid()), im: to_f64(&im.mid()), label, top: class == 0 });
    }
    let alt = format!("Eigenvalues in the complex plane: {}.", listed(&told));
    let text = "The eigenvalues in the complex plane, those of the largest modulus in green, with the circles of their moduli.";
    Some(figure(picture::spectrum(&dots, "Eigenvalues"), alt, words(text)))
}

/// The cones of Theorem 6 along the curve; `None` where there are none, or they are not seen in the plane of the drawing.
#[must_use]
pub fn cones(case: &Case, found: &Certified) -> Option<Block> {
    let every = found.everywhere.as_ref()?;
    let title = format!("{}: cones", case.title);
    let field = picture::cone_field(&case.shape, every.cone.as_ref()?, &title)?;
    let alt = format!(
        "The curve with {}; at the start of each of them a fan, the cone that holds its forward secants, and nested parallelograms around the cells.",
        count(field.cells, "cell")
    );
    let text = format!(
        "The cones along the curve, down to its cells of {}. The fan at the start of a cell $u$ is the cone $ε_u T_u C$ of its forward secants. Every cell \
         lies in the parallelogram in which this cone meets the reversed one at its end; cells of all levels down to the last are drawn.",
        count(field.level, "letter")
    );
    Some(figure(field.drawing, alt, line(&text, [])))
}

/// The interval of parameters of a cell of an edge state.
#[allow(clippy::float_arithmetic, reason = "pictures decide nothing")]
fn parameters<E: Reported>(shape: &Shape<E>, state: usize, word: &[usize]) -> (f64, f64) {
    let (mut from, mut width, mut back, mut at) = (0.0, 1.0, false, state);
    for &letter in word {
        let state = &shape.states[at];
        let (before, share) = (to_f64(&state.before(letter)), to_f64(&state.share(letter)));
        from += width * if back { 1.0 - before - share } else { before };
        width *= share;
        back ^= state.pieces[letter].reversed;
        at = state.pieces[letter].target;
    }
    (from, from + width)
}

/// The values of a functional on points as floats: its row, and its value at `q`.
#[allow(clippy::float_arithmetic, reason = "pictures decide nothing")]
fn float_row<E: Reported>(row: &[Elem], root: Option<&Root>, branch: &BranchReport<E>) -> (Vec<f64>, f64) {
    let entry = |e: &Elem| match (e.is_rational(), root) {
        (Some(x), _) => to_f64(&x),
        (None, Some(root)) => to_f64(&e.enclosure(root, 64).0.mid()),
        (None, None) => 0.0,
    };
    let on_y: Vec<f64> = row.iter().map(entry).collect();
    let row: Vec<f64> = (0..branch.chart.cols())
        .map(|j| on_y.iter().enumerate().map(|(k, f)| f * to_f64(&branch.chart[(k, j)].near())).sum())
        .collect();
    let at_q = row.iter().zip(&branch.fixed).map(|(a, x)| a * to_f64(&x.near())).sum();
    (row, at_q)
}

/// A factor that brings very large or very small values into the range of a drawing; 1 for all others.
fn drawn_scale(cells: &[Discharged]) -> Rational {
    let ends = cells.iter().flat_map(|d| [&d.bound.lo, &d.bound.hi]).map(crate::arith::abs);
    let large = Rational::from(1_000_000_000);
    match ends.max() {
        Some(most) if most > large || (most > 0 && Rational::from(1) / &most > large) => Rational::from(1) / most,
        _ => Rational::from(1),
    }
}

/// The functional of a ring condition over the cells: the enclosures of a proof, or only its graph.
#[must_use]
#[allow(clippy::float_arithmetic, reason = "pictures decide nothing")]
pub fn functional<E: Reported>(
    case: &Case<E>,
    branch: &BranchReport<E>,
    row: &[Elem],
    root: &Root,
    proof: Option<&RingProof>,
) -> Block {
    let shape = &case.shape;
    let curve = shape.states[branch.state].kind == CellKind::Edge;
    let cells = proof.map(|p| p.discharged.as_slice()).unwrap_or_default();
    let scale = drawn_scale(cells);
    let row: Vec<Elem> = row.iter().map(|e| e.scale(&scale)).collect();
    let total = cells.len().max(1) as f64;
    let boxes: Vec<CellBox> = cells
        .iter()
        .enumerate()
        .map(|(k, d)| {
            let (from, to) = match d.position {
                Position::Unordered => (k as f64 / total, (k as f64 + 0.9) / total),
                _ => parameters(shape, branch.state, &d.word),
            };
            let (lo, hi) = (to_f64(&(&d.bound.lo * &scale)), to_f64(&(&d.bound.hi * &scale)));
            CellBox { from, to, lo, hi, label: word_text(&d.word) }
        })
        .collect();
    let (profile, spot) = if curve {
        let (row, at_q) = float_row(&row, Some(root), branch);
        let turns = branch.address.cycle.repeat(60 / branch.address.cycle.len().max(1) + 1);
        (picture::profile(&E::drawn(shape), branch.state, &row, at_q), Some(parameters(shape, branch.state, &turns).0))
    } else {
        (Vec::new(), None)
    };
    let scaled = if scale == 1 { "" } else { ", divided by the largest of them," };
    let place = if curve { "over the parameter of the cell, with $g$ itself" } else { "cell by cell" };
    let (alt, caption) = if cells.is_empty() {
        (
            "Graph of the functional, which takes both signs on the ring.".to_owned(),
            "$g$ over the parameter of the cell; it is 0 at $q$ and has zeros on the ring.".to_owned(),
        )
    } else {
        let signs: Vec<&str> = cells.iter().map(|d| if d.sign > 0 { "positive" } else { "negative" }).collect();
        let up = signs.iter().filter(|s| **s == "positive").count();
        (
            format!(
                "Boxes that enclose the functional on {}: positive on {up}, negative on {}.",
                count(cells.len(), "cell"),
                cells.len() - up
            ),
            format!("The enclosures of $g${scaled} on the cells that cover the ring, {place}: no box meets 0."),
        )
    };
    figure(picture::functional(&boxes, &profile, spot, "The functional on the cells"), alt, line(&caption, []))
}

/// A point closer and closer, and how fast the secants turn there.
#[must_use]
pub fn germ<E: Reported>(case: &Case<E>, point: &PointReport<E>) -> Vec<Block> {
    let mut out = Vec::new();
    let branches: Vec<&BranchReport<E>> =
        point.branches.iter().filter(|b| !matches!(b.outcome, Outcome::NoGerm { .. })).collect();
    if branches.is_empty() {
        return out;
    }
    let tangent = point.tangent.as_ref().map(|t| t.to_f64());
    if let Some(drawing) = picture::zoom(
        (&case.shape, &E::drawn(&case.shape)),
        &point.position,
        &branches,
        tangent.as_deref(),
        "Zoom series",
    ) {
        let what = if tangent.is_some() { " and the tangent line" } else { "" };
        let alt =
            format!("Four enlargements of the shape around the point{what}, after 0, 2, 4 and 6 turns of the cycle.");
        let text = format!("The cells $T_u M^m A$ around the point{what}, each enlarged to the same size.");
        out.push(figure(drawing, alt, line(&text, [])));
    }
    let turnings: Vec<picture::Turning> = branches
        .iter()
        .enumerate()
        .filter_map(|(k, b)| {
            let name = match (branches.len(), k) {
                (1, _) => "",
                (_, 0) => "left",
                _ => "right",
            };
            picture::turning(&E::drawn(&case.shape), b, name)
        })
        .filter(|t| !t.bound.is_empty())
        .collect();
    if !turnings.is_empty() {
        let drawing = picture::turning_chart(&turnings, "Angular deviation");
        let alt = "Chart of the largest angle between secants and the tangent line by turns of the cycle, on a logarithmic scale, \
                   under the curve of the proved rate."
            .to_owned();
        let text = "The largest angle (in radians) between the tangent line of the branch and sampled secants after $m$ turns: dots. The line is \
                    the proved rate, with a constant fitted to the dots; the dots prove nothing.";
        out.push(figure(drawing, alt, line(text, [])));
    }
    out
}

fn verdict_word<E: Reported>(point: &PointReport<E>) -> &'static str {
    point.kind.word()
}

/// What is drawn at an examined point of a curve or a set.
#[must_use]
pub fn mark<E: Reported>(point: &PointReport<E>) -> Mark {
    let style = match (point.verdict, point.kind) {
        (_, Kind::Cusp) => MarkStyle::Cusp,
        (_, Kind::Corner) => MarkStyle::Corner,
        (Verdict::Proved, _) => MarkStyle::Tangent,
        (Verdict::Refuted, _) => MarkStyle::Refuted,
        (Verdict::Undetermined, _) => MarkStyle::Undecided,
    };
    let mut rays: Vec<Vec<f64>> = point.left.iter().chain(&point.right).map(|d| d.to_f64()).collect();
    if rays.is_empty()
        && let Some(line) = &point.tangent
    {
        rays = vec![line.to_f64(), line.negated().to_f64()];
    }
    let label = match point.role {
        Role::LeftEnd | Role::RightEnd | Role::Interior | Role::SetPoint => addresses(point).join(" = "),
        Role::Joint { .. } => addresses(point).join(" = "),
    };
    Mark { at: point.position.iter().map(E::near).collect(), rays, style, label }
}
