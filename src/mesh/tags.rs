//! Tags of a mesh: sharp edges and vertices, and the rule of its border, in the notation of a public renderer
//! (`t crease 2/1/0 3 7 10`): the numbers of integers, decimals and words, then these; vertices are counted from 0.

use super::read::Model;
use crate::arith::{Rational, parse_rational};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// From this sharpness on an edge or a vertex stays sharp for ever.
pub const INFINITE: i64 = 10;

/// The rule of the border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// The border is a cubic spline curve.
    Edge,
    /// The same, but vertices with one face stay where they are.
    EdgeAndCorner,
}

impl Boundary {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Edge, Self::EdgeAndCorner];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Edge => "edge",
            Self::EdgeAndCorner => "edge-and-corner",
        }
    }

    /// The rule of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|b| b.name() == name)
    }
}

/// What the tags of a file say.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tags {
    /// The sharpness of edges, by their ends in ascending order.
    pub edges: BTreeMap<(u32, u32), Rational>,
    /// The sharpness of vertices.
    pub vertices: BTreeMap<u32, Rational>,
    /// The rule of the border; without one the points on it have no limits.
    pub boundary: Option<Boundary>,
}

/// What is wrong with a tag: the word at fault (`None` for the whole line), code, message and remedy.
pub type Fault = (Option<usize>, &'static str, String, &'static str);

/// A word of a line with its place in the file.
type Word<'a> = (&'a str, Range<usize>);

const FORM: &str = "tags look like  t crease 2/1/0 3 7 10  (an edge by its two vertices, counted from 0, and its sharpness; 10 is \
                    for ever),  t corner 1/1/0 3 10  or  t interpolateboundary 1/0/0 2";

impl Tags {
    /// The sharpness of an edge.
    #[must_use]
    pub fn edge(&self, a: u32, b: u32) -> Option<&Rational> {
        self.edges.get(&(a.min(b), a.max(b)))
    }

    /// Whether anything is sharp for some steps only.
    #[must_use]
    pub fn semi_sharp(&self) -> bool {
        self.edges.values().chain(self.vertices.values()).any(|s| *s > 0 && *s < INFINITE)
    }

    /// Reads one line, of which the first word is `t`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(&mut self, words: &[Word<'_>], model: &Model, edges: &BTreeSet<(u32, u32)>) -> Result<(), Fault> {
        let word = |k: usize| words.get(k).map(|w| w.0);
        let Some(name) = word(1) else { return Err((None, "tag", "the tag has no name".to_owned(), FORM)) };
        let counts: Option<Vec<usize>> = word(2).and_then(|w| w.split('/').map(|n| n.parse().ok()).collect());
        let Some([integers, decimals, strings]) = counts.as_deref().and_then(|c| <[usize; 3]>::try_from(c).ok()) else {
            return Err((Some(2), "tag", "the tag does not say how many numbers it has".to_owned(), FORM));
        };
        if integers.checked_add(decimals).and_then(|n| n.checked_add(strings)) != Some(words.len() - 3) {
            let message = format!("the tag has {} values, not as many as it says", words.len() - 3);
            return Err((None, "tag", message, FORM));
        }
        let first = 3 + integers;
        match name {
            "crease" if integers >= 2 && integers.is_multiple_of(2) && strings == 0 => {
                for pair in 0..integers / 2 {
                    let at = 3 + 2 * pair;
                    let (a, b) = (vertex(words, at, model)?, vertex(words, at + 1, model)?);
                    let key = (a.min(b), a.max(b));
                    if !edges.contains(&key) {
                        let message = format!("no face has an edge from vertex {a} to vertex {b}");
                        let help =
                            "tags count vertices from 0, faces from 1; take the tag out, or name an edge of a face";
                        return Err((Some(at), "crease", message, help));
                    }
                    let own = if decimals == integers / 2 { first + pair } else { first };
                    self.edges.insert(key, sharpness(words, own, decimals)?);
                }
                Ok(())
            }
            "corner" if integers >= 1 && strings == 0 => {
                for k in 0..integers {
                    let v = vertex(words, 3 + k, model)?;
                    let own = if decimals == integers { first + k } else { first };
                    self.vertices.insert(v, sharpness(words, own, decimals)?);
                }
                Ok(())
            }
            "interpolateboundary" if (integers, decimals, strings) == (1, 0, 0) => {
                self.boundary = match word(3) {
                    Some("0") => None,
                    Some("1") => Some(Boundary::EdgeAndCorner),
                    Some("2") => Some(Boundary::Edge),
                    _ => {
                        let help = "0: none; 1: edge and corner; 2: edge only";
                        return Err((Some(3), "tag", "there is no such rule of the border".to_owned(), help));
                    }
                };
                Ok(())
            }
            "creasemethod" if matches!(word(3), Some("normal" | "uniform")) => Ok(()),
            // Of texture coordinates, which have no bearing on the limit surface.
            "facevaryinginterpolateboundary" | "facevaryingpropagatecorners" => Ok(()),
            "crease" | "corner" | "interpolateboundary" => {
                Err((None, "tag", format!("the tag `{name}` has not the numbers that it needs"), FORM))
            }
            _ => {
                let help = "take the line out if the rules without the tag are meant; read are crease, corner and \
                            interpolateboundary";
                Err((Some(1), "tag", format!("the tag `{name}` is not read"), help))
            }
        }
    }
}

fn vertex(words: &[Word<'_>], at: usize, model: &Model) -> Result<u32, Fault> {
    let count = model.points.len();
    let word = words[at].0;
    word.parse::<u32>().ok().filter(|v| (*v as usize) < count).ok_or_else(|| {
        let message = format!("`{word}` names no vertex: the file has {count}");
        (Some(at), "index", message, "tags count vertices from 0")
    })
}

fn sharpness(words: &[Word<'_>], at: usize, decimals: usize) -> Result<Rational, Fault> {
    let help = "a sharpness is a number from 0 on such as 2.5; 10 and more stay sharp for ever";
    if decimals == 0 {
        return Err((None, "tag", "the tag has no sharpness".to_owned(), help));
    }
    let word = words[at].0;
    // A decimal is short: an exponent could make it as long as memory.
    let plain = word.len() <= 40 && !word.contains(['/', 'e', 'E']);
    parse_rational(word).ok().filter(|s| plain && *s >= 0).ok_or_else(|| {
        let message = format!("`{}` is no sharpness", word.chars().take(40).collect::<String>());
        (Some(at), "number", message, help)
    })
}
