//! Rectangles around what is drawn, so that labels keep clear of one another.

use super::svg::{Anchor, Element};

/// About the width of a character of a label, in pixels.
const LETTER: f64 = 6.7;
/// The height of a label above and below its base line.
const LINE: [f64; 2] = [10.0, 3.0];

/// A rectangle with sides along the axes, in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub lo: [f64; 2],
    pub hi: [f64; 2],
}

impl Frame {
    /// The rectangle around an element; none for an element without points.
    pub fn of(element: &Element) -> Option<Self> {
        match element {
            Element::Path { points, .. } | Element::Cloud { points, .. } => {
                points.iter().map(|p| Self { lo: *p, hi: *p }).reduce(Self::joined)
            }
            Element::Disc { at, radius, .. } => Some(Self { lo: at.map(|x| x - radius), hi: at.map(|x| x + radius) }),
            Element::Label { at, anchor, text } => Some(Self::label(*at, *anchor, text)),
        }
    }

    /// About the rectangle of a label.
    pub fn label(at: [f64; 2], anchor: Anchor, text: &str) -> Self {
        let width = LETTER * text.chars().count() as f64;
        let left = match anchor {
            Anchor::Start => at[0],
            Anchor::Middle => at[0] - width / 2.0,
            Anchor::End => at[0] - width,
        };
        Self { lo: [left, at[1] - LINE[0]], hi: [left + width, at[1] + LINE[1]] }
    }

    /// The smallest rectangle that holds both.
    pub fn joined(self, other: Self) -> Self {
        Self {
            lo: [self.lo[0].min(other.lo[0]), self.lo[1].min(other.lo[1])],
            hi: [self.hi[0].max(other.hi[0]), self.hi[1].max(other.hi[1])],
        }
    }

    pub fn meets(&self, other: &Self) -> bool {
        (0..2).all(|k| self.lo[k] < other.hi[k] && other.lo[k] < self.hi[k])
    }

    pub fn holds(&self, p: &[f64; 2]) -> bool {
        (0..2).all(|k| self.lo[k] < p[k] && p[k] < self.hi[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stand_beside_their_points() {
        let start = Frame::label([10.0, 20.0], Anchor::Start, "ab");
        let end = Frame::label([10.0, 20.0], Anchor::End, "ab");
        assert!(start.lo[0] == 10.0 && end.hi[0] == 10.0 && !start.meets(&end));
        assert!(Frame::label([10.0, 20.0], Anchor::Middle, "ab").meets(&start));
        assert!(start.holds(&[11.0, 19.0]) && !start.holds(&[9.0, 19.0]));
        assert!(Frame::of(&Element::Path { class: "sc-a", points: Vec::new() }).is_none());
    }
}
