use super::MarkStyle;
use std::fmt::Write;

const WIDTH: f64 = 640.0;
const MARGIN: f64 = 36.0;
const RAY: f64 = 78.0;

/// Colours that can be told apart on light and on dark paper.
const STYLE: &str = ".sc-p{fill:none;stroke:#8a8f98;stroke-width:1;stroke-dasharray:4 3}\
.sc-k{fill:#8a8f98}.sc-c{fill:none;stroke:#1f5fbf;stroke-width:1.6;stroke-linejoin:round;stroke-linecap:round}\
.sc-s{fill:none;stroke:#1f5fbf;stroke-width:1.3;stroke-linecap:round}\
.sc-r{fill:none;stroke-width:2;stroke-linecap:round}.sc-d{stroke:none}\
.sc-t{font:12px sans-serif;fill:#3c4048}\
.sc-tangent{stroke:#1a8a4a;fill:#1a8a4a}.sc-cusp{stroke:#b06a00;fill:#b06a00}\
.sc-corner{stroke:#c4332b;fill:#c4332b}.sc-open{stroke:#7a4fb5;fill:#7a4fb5}\
@media (prefers-color-scheme:dark){.sc-c,.sc-s{stroke:#7fb0ff}.sc-t{fill:#d4d8de}\
.sc-tangent{stroke:#5fd08f;fill:#5fd08f}.sc-cusp{stroke:#f0b050;fill:#f0b050}\
.sc-corner{stroke:#ff8077;fill:#ff8077}.sc-open{stroke:#c0a0f0;fill:#c0a0f0}}";

/// An SVG document being drawn; y points up in the coordinates given to it.
pub(super) struct Canvas {
    body: String,
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
        Self { body: String::new(), title: escaped(title), scale, shift, height }
    }

    fn place(&self, p: [f64; 2]) -> [f64; 2] {
        [self.shift[0] + p[0] * self.scale, self.shift[1] - p[1] * self.scale]
    }

    fn path(&self, points: &[[f64; 2]]) -> String {
        let mut d = String::new();
        for (k, p) in points.iter().enumerate() {
            let [x, y] = self.place(*p);
            let _ = write!(d, "{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(x), fixed(y));
        }
        d
    }

    pub fn polygon(&mut self, corners: &[[f64; 2]]) {
        if corners.len() < 2 {
            return;
        }
        let _ = writeln!(self.body, "<path class=\"sc-p\" d=\"{}\"/>", self.path(corners));
        for p in corners {
            let [x, y] = self.place(*p);
            let _ = writeln!(self.body, "<circle class=\"sc-k\" cx=\"{}\" cy=\"{}\" r=\"2.5\"/>", fixed(x), fixed(y));
        }
    }

    pub fn curve(&mut self, points: &[[f64; 2]]) {
        let _ = writeln!(self.body, "<path class=\"sc-c\" d=\"{}\"/>", self.path(points));
    }

    pub fn cloud(&mut self, points: &[[f64; 2]]) {
        let mut d = String::new();
        for p in points {
            let [x, y] = self.place(*p);
            let _ = write!(d, "M{} {}h0", fixed(x), fixed(y));
        }
        let _ = writeln!(self.body, "<path class=\"sc-s\" d=\"{d}\"/>");
    }

    /// A point with its rays, each as an arrow of fixed length.
    pub fn mark(&mut self, style: MarkStyle, at: [f64; 2], rays: &[[f64; 2]], label: &str) {
        let class = match style {
            MarkStyle::Tangent => "sc-tangent",
            MarkStyle::Cusp => "sc-cusp",
            MarkStyle::Corner => "sc-corner",
            MarkStyle::Open => "sc-open",
        };
        let [x, y] = self.place(at);
        for ray in rays {
            let norm = ray[0].hypot(ray[1]);
            if norm > 1e-12 {
                self.arrow(class, [x, y], [ray[0] / norm, -ray[1] / norm]);
            }
        }
        let (cx, cy) = (fixed(x), fixed(y));
        let _ = writeln!(self.body, "<circle class=\"sc-d {class}\" cx=\"{cx}\" cy=\"{cy}\" r=\"4\"/>");
        let (anchor, dx) = if x > WIDTH - 90.0 { ("end", -8.0) } else { ("start", 8.0) };
        let _ = writeln!(
            self.body,
            "<text class=\"sc-t\" x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{}</text>",
            fixed(x + dx),
            fixed((y - 8.0).max(14.0)),
            escaped(label)
        );
    }

    fn arrow(&mut self, class: &str, from: [f64; 2], unit: [f64; 2]) {
        let at = |along: f64, across: f64| {
            let x = from[0] + unit[0] * along - unit[1] * across;
            let y = from[1] + unit[1] * along + unit[0] * across;
            format!("{} {}", fixed(x), fixed(y))
        };
        let (tip, left, right) = (at(RAY, 0.0), at(RAY - 9.0, 4.0), at(RAY - 9.0, -4.0));
        let _ = writeln!(
            self.body,
            "<path class=\"sc-r {class}\" d=\"M{}L{}M{left}L{tip}L{right}\" style=\"fill:none\"/>",
            at(0.0, 0.0),
            tip
        );
    }

    pub fn finish(self) -> String {
        let (w, h) = (fixed(WIDTH), fixed(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\">\n\
             <title>{}</title>\n<style>{STYLE}</style>\n{}</svg>\n",
            self.title, self.body
        )
    }
}

/// Two digits after the point, without trailing zeros and without a negative zero.
fn fixed(x: f64) -> String {
    let text = format!("{x:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// Text for SVG and HTML.
fn escaped(text: &str) -> String {
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
