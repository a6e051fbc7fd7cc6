use super::MarkStyle;
use super::frame::Frame;
use std::fmt::Write;

const WIDTH: f64 = 640.0;
const MARGIN: f64 = 36.0;
/// The margin of a thumbnail, and its greatest height.
const EDGE: f64 = 8.0;
const THUMBNAIL_HEIGHT: f64 = 420.0;
const RAY: f64 = 78.0;
/// Height of the legend.
const LEGEND: f64 = 26.0;

/// Colours that can be told apart on light and on dark paper.
pub(super) const STYLE: &str = ".sc-p{fill:none;stroke:#8a8f98;stroke-width:1;stroke-dasharray:4 3}\
.sc-k{fill:#8a8f98}.sc-c{fill:none;stroke:#1f5fbf;stroke-width:1.6;stroke-linejoin:round;stroke-linecap:round}\
.sc-s{fill:none;stroke:#1f5fbf;stroke-width:1.3;stroke-linecap:round}\
.sc-r{fill:none;stroke-width:2;stroke-linecap:round}.sc-d{stroke:none}\
.sc-t{font:12px sans-serif;fill:#3c4048}.sc-a{fill:none;stroke:#6b717b;stroke-width:1}\
.sc-x{fill:#1f5fbf;fill-opacity:.22;stroke:#1f5fbf;stroke-width:.8}\
.sc-y{fill:#b06a00;fill-opacity:.22;stroke:#b06a00;stroke-width:.8}\
.sc-tangent{stroke:#1a8a4a;fill:#1a8a4a}.sc-cusp{stroke:#b06a00;fill:#b06a00}\
.sc-corner{stroke:#c4332b;fill:#c4332b}.sc-none{stroke:#7a4fb5;fill:#7a4fb5}.sc-open{stroke:#6b717b}\
.sc-m{fill:none;stroke-linejoin:round;stroke:#1f5fbf;stroke-width:1}.sc-m.sc-m1{stroke:#1a8a4a;stroke-width:.8}\
.sc-m.sc-m2{stroke:#8a8f98;stroke-width:.6}\
path.sc-r{fill:none}\
@media screen and (prefers-color-scheme:dark){.sc-c,.sc-s{stroke:#7fb0ff}.sc-t{fill:#d4d8de}.sc-a{stroke:#9aa2ae}\
.sc-x{fill:#7fb0ff;stroke:#7fb0ff}.sc-y{fill:#f0b050;stroke:#f0b050}\
.sc-tangent{stroke:#5fd08f;fill:#5fd08f}.sc-cusp{stroke:#f0b050;fill:#f0b050}\
.sc-corner{stroke:#ff8077;fill:#ff8077}.sc-none{stroke:#c0a0f0;fill:#c0a0f0}.sc-open{stroke:#9aa2ae}\
.sc-m{stroke:#7fb0ff}.sc-m.sc-m1{stroke:#5fd08f}}";

/// Where a label stands with respect to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// The text begins there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// Something drawn, in pixels with y pointing down.
pub(super) enum Element {
    /// A broken line of a class.
    Path { class: &'static str, points: Vec<[f64; 2]> },
    /// Points of a class.
    Cloud { class: &'static str, points: Vec<[f64; 2]> },
    /// A disc.
    Disc { class: &'static str, at: [f64; 2], radius: f64 },
    /// Words at a point of their base line.
    Label { at: [f64; 2], anchor: Anchor, text: String },
}

impl Element {
    /// Moves the element.
    pub fn shift(&mut self, by: [f64; 2]) {
        let moved = |p: &mut [f64; 2]| *p = [p[0] + by[0], p[1] + by[1]];
        match self {
            Self::Path { points, .. } | Self::Cloud { points, .. } => points.iter_mut().for_each(moved),
            Self::Disc { at, .. } | Self::Label { at, .. } => moved(at),
        }
    }
}

/// A drawing in the making; y points up in the coordinates given to it.
pub(super) struct Canvas {
    elements: Vec<Element>,
    title: String,
    scale: f64,
    shift: [f64; 2],
    height: f64,
}

impl Canvas {
    /// A canvas on which all the points fit.
    pub fn around(points: &[[f64; 2]], title: &str) -> Self {
        let bound = |k: usize, pick: fn(f64, f64) -> f64, from: f64| points.iter().map(|p| p[k]).fold(from, pick);
        let lo = [bound(0, f64::min, f64::INFINITY), bound(1, f64::min, f64::INFINITY)];
        let hi = [bound(0, f64::max, f64::NEG_INFINITY), bound(1, f64::max, f64::NEG_INFINITY)];
        let span = [(hi[0] - lo[0]).max(1e-9), (hi[1] - lo[1]).max(0.0)];
        let room = WIDTH - 2.0 * MARGIN;
        let scale = (room / span[0]).min(room / span[1].max(1e-9));
        let height = (span[1] * scale).max(80.0) + 2.0 * MARGIN;
        let middle = [(lo[0] + hi[0]) / 2.0, (lo[1] + hi[1]) / 2.0];
        let shift = [WIDTH / 2.0 - middle[0] * scale, height / 2.0 + middle[1] * scale];
        Self { elements: Vec::new(), title: title.to_owned(), scale, shift, height }
    }

    fn place(&self, p: [f64; 2]) -> [f64; 2] {
        [self.shift[0] + p[0] * self.scale, self.shift[1] - p[1] * self.scale]
    }

    fn placed(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|p| self.place(*p)).collect()
    }

    pub fn polygon(&mut self, corners: &[[f64; 2]]) {
        if corners.len() < 2 {
            return;
        }
        let points = self.placed(corners);
        self.elements.push(Element::Path { class: "sc-p", points: points.clone() });
        self.elements.extend(points.into_iter().map(|at| Element::Disc { class: "sc-k", at, radius: 2.5 }));
    }

    pub fn curve(&mut self, points: &[[f64; 2]]) {
        self.elements.push(Element::Path { class: "sc-c", points: self.placed(points) });
    }

    pub fn cloud(&mut self, points: &[[f64; 2]]) {
        self.elements.push(Element::Cloud { class: "sc-s", points: self.placed(points) });
    }

    /// A polygon with its inside.
    pub fn filled(&mut self, class: &'static str, corners: &[[f64; 2]]) {
        let mut points = self.placed(corners);
        points.extend(points.first().copied());
        self.elements.push(Element::Path { class, points });
    }

    /// A sector between two angles, of a radius in pixels.
    pub fn fan(&mut self, class: &'static str, at: [f64; 2], angles: (f64, f64), radius: f64) {
        let at = self.place(at);
        let arc = (0..=12).map(|k| angles.0 + (angles.1 - angles.0) * f64::from(k) / 12.0);
        let mut points = vec![at];
        points.extend(arc.map(|a| [at[0] + radius * a.cos(), at[1] - radius * a.sin()]));
        points.push(at);
        self.elements.push(Element::Path { class, points });
    }

    /// A small point.
    pub fn dot(&mut self, at: [f64; 2]) {
        let at = self.place(at);
        self.elements.push(Element::Disc { class: "sc-k", at, radius: 2.5 });
    }

    /// A point with its rays, each as an arrow of fixed length.
    pub fn mark(&mut self, style: MarkStyle, at: [f64; 2], rays: &[[f64; 2]]) {
        let class = mark_class(style);
        let at = self.place(at);
        for ray in rays {
            let norm = ray[0].hypot(ray[1]);
            if norm > 1e-12 {
                self.arrow(class, at, [ray[0] / norm, -ray[1] / norm]);
            }
        }
        self.elements.push(spot(style, at));
    }

    /// What the marks mean, in a line below the drawing: those that are there.
    pub fn legend(&mut self, styles: &[(MarkStyle, bool)]) {
        let there: Vec<MarkStyle> = styles.iter().filter(|(_, there)| *there).map(|(style, _)| *style).collect();
        if there.is_empty() {
            return;
        }
        self.height += LEGEND;
        let (mut x, y) = (MARGIN, self.height - LEGEND / 2.0);
        for style in there {
            self.elements.push(spot(style, [x, y]));
            let label = Element::Label { at: [x + 9.0, y + 4.0], anchor: Anchor::Start, text: style.word().to_owned() };
            x += 24.0 + Frame::of(&label).map_or(0.0, |f| f.hi[0] - f.lo[0]);
            self.elements.push(label);
        }
    }

    /// Words beside a point, where they cover least; left out where they would cover other words.
    pub fn label(&mut self, at: [f64; 2], text: &str) {
        let at = self.place(at);
        let spots = [
            ([8.0, -8.0], Anchor::Start),
            ([-8.0, -8.0], Anchor::End),
            ([8.0, 17.0], Anchor::Start),
            ([-8.0, 17.0], Anchor::End),
            ([0.0, -12.0], Anchor::Middle),
            ([0.0, 21.0], Anchor::Middle),
            ([10.0, 4.0], Anchor::Start),
            ([-10.0, 4.0], Anchor::End),
        ];
        let placed = spots.map(|(d, anchor)| ([at[0] + d[0], at[1] + d[1]], anchor));
        let cost = |(spot, anchor): &([f64; 2], Anchor)| self.covered(&Frame::label(*spot, *anchor, text));
        let costs: Vec<Option<usize>> = placed.iter().map(cost).collect();
        let best = (0..placed.len()).filter(|k| costs[*k].is_some()).min_by_key(|k| costs[*k]);
        if let Some(k) = best {
            let (at, anchor) = placed[k];
            self.elements.push(Element::Label { at, anchor, text: text.to_owned() });
        }
    }

    /// How much of the drawing a label would cover; `None` where it leaves the sheet or meets another one.
    fn covered(&self, frame: &Frame) -> Option<usize> {
        let sheet = Frame { lo: [2.0, 2.0], hi: [WIDTH - 2.0, self.height - 2.0] };
        if !sheet.holds(&frame.lo) || !sheet.holds(&frame.hi) {
            return None;
        }
        let mut cost = 0;
        for element in &self.elements {
            match element {
                Element::Label { .. } if Frame::of(element).is_some_and(|f| f.meets(frame)) => return None,
                Element::Disc { .. } if Frame::of(element).is_some_and(|f| f.meets(frame)) => cost += 8,
                Element::Path { class, points } => {
                    let weight = if *class == "sc-p" || *class == "sc-c" { 1 } else { 2 };
                    cost += weight * points.windows(2).map(|ends| inside(frame, ends[0], ends[1])).sum::<usize>();
                }
                Element::Cloud { points, .. } => cost += points.iter().filter(|p| frame.holds(p)).count(),
                Element::Label { .. } | Element::Disc { .. } => {}
            }
        }
        Some(cost)
    }

    fn arrow(&mut self, class: &'static str, from: [f64; 2], unit: [f64; 2]) {
        let at = |along: f64, across: f64| {
            [from[0] + unit[0] * along - unit[1] * across, from[1] + unit[1] * along + unit[0] * across]
        };
        self.elements.push(Element::Path { class, points: vec![from, at(RAY, 0.0)] });
        let head = vec![at(RAY - 9.0, 4.0), at(RAY, 0.0), at(RAY - 9.0, -4.0)];
        self.elements.push(Element::Path { class, points: head });
    }

    /// The drawing as a complete SVG document.
    pub fn svg(&self) -> String {
        document(&self.elements, WIDTH, self.height, &self.title)
    }

    /// The shape alone, with few points, as a small SVG document.
    ///
    /// The shape fills it, wherever it lies among its control points.
    pub fn thumbnail(&self) -> String {
        let shown = |e: &&Element| matches!(e, Element::Path { class: "sc-c", .. } | Element::Cloud { .. });
        let shapes: Vec<&Element> = self.elements.iter().filter(shown).collect();
        let frame = shapes.iter().filter_map(|e| Frame::of(e)).reduce(Frame::joined);
        let Frame { lo, hi } = frame.unwrap_or(Frame { lo: [0.0; 2], hi: [1.0; 2] });
        let span = [(hi[0] - lo[0]).max(1e-6), (hi[1] - lo[1]).max(1e-6)];
        let scale = ((WIDTH - 2.0 * EDGE) / span[0]).min((THUMBNAIL_HEIGHT - 2.0 * EDGE) / span[1]);
        let size = [0, 1].map(|k| (hi[k] - lo[k]) * scale + 2.0 * EDGE);
        let place = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().map(|p| [0, 1].map(|k| (p[k] - lo[k]) * scale + EDGE)).collect()
        };
        let mut body = String::new();
        for element in shapes {
            let small = match element {
                Element::Path { class, points } => Element::Path { class, points: spaced(&place(points), 5.0) },
                Element::Cloud { class, points } => Element::Cloud { class, points: spaced(&place(points), 7.0) },
                _ => continue,
            };
            body.push_str(&svg_element(&small));
        }
        let (w, h) = (fixed(size[0]), fixed(size[1].max(80.0)));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" aria-hidden=\"true\">\n{body}</svg>\n"
        )
    }

    /// Width and height.
    pub fn size(&self) -> [f64; 2] {
        [WIDTH, self.height]
    }

    /// The elements, for other formats.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }
}

fn mark_class(style: MarkStyle) -> &'static str {
    match style {
        MarkStyle::Tangent => "sc-tangent",
        MarkStyle::Cusp => "sc-cusp",
        MarkStyle::Corner => "sc-corner",
        MarkStyle::Refuted => "sc-none",
        MarkStyle::Undecided => "sc-open",
    }
}

/// The spot of a mark: a disc, or a ring where nothing is decided.
fn spot(style: MarkStyle, at: [f64; 2]) -> Element {
    let (class, radius) = (mark_class(style), 4.0);
    if style != MarkStyle::Undecided {
        return Element::Disc { class, at, radius };
    }
    let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / 16.0;
    let points = (0..=16).map(|k| [at[0] + radius * turn(k).cos(), at[1] + radius * turn(k).sin()]).collect();
    Element::Path { class, points }
}

/// About how many steps of some pixels of a segment lie in a frame.
fn inside(frame: &Frame, from: [f64; 2], to: [f64; 2]) -> usize {
    const STEP: f64 = 3.0;
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let steps = (length / STEP).ceil().clamp(1.0, 400.0) as u32;
    let at = |k: u32| {
        let s = f64::from(k) / f64::from(steps);
        [from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])]
    };
    (0..steps).filter(|k| frame.holds(&at(*k))).count()
}

/// A complete SVG document.
pub(super) fn document(elements: &[Element], width: f64, height: f64, title: &str) -> String {
    let (w, h) = (fixed(width), fixed(height));
    let body: String = elements.iter().map(svg_element).collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\">\n\
         <title>{}</title>\n<style>{STYLE}</style>\n{body}</svg>\n",
        escaped(title)
    )
}

/// Drops points near the one kept before.
pub(super) fn spaced(points: &[[f64; 2]], distance: f64) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::new();
    for (k, p) in points.iter().enumerate() {
        let near = |q: &[f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) < distance;
        if !out.last().is_some_and(near) || k + 1 == points.len() {
            out.push(*p);
        }
    }
    out
}

fn svg_element(element: &Element) -> String {
    let mut d = String::new();
    match element {
        Element::Path { class, points } => {
            for (k, [x, y]) in points.iter().enumerate() {
                let _ = write!(d, "{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(*x), fixed(*y));
            }
            let own = matches!(*class, "sc-p" | "sc-c" | "sc-a" | "sc-x" | "sc-y");
            let ray = if own { String::new() } else { "sc-r ".to_owned() };
            format!("<path class=\"{ray}{class}\" d=\"{d}\"/>\n")
        }
        Element::Cloud { class, points } => {
            for [x, y] in points {
                let _ = write!(d, "M{} {}h0", fixed(*x), fixed(*y));
            }
            format!("<path class=\"{class}\" d=\"{d}\"/>\n")
        }
        Element::Disc { class, at: [x, y], radius } => {
            let (x, y, r) = (fixed(*x), fixed(*y), fixed(*radius));
            format!("<circle class=\"sc-d {class}\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>\n")
        }
        Element::Label { at: [x, y], anchor, text } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let (x, y, text) = (fixed(*x), fixed(*y), escaped(text));
            format!("<text class=\"sc-t\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>\n")
        }
    }
}

/// Two digits after the point, without trailing zeros and without a negative zero.
pub(super) fn fixed(x: f64) -> String {
    let text = format!("{x:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// Text for SVG and HTML.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
