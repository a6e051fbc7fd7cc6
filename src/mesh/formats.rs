//! The lines of OBJ, OFF and PLY files.

use super::read::{Reader, Word};
use crate::diagnostic::Problem;
use std::ops::Range;

impl<'a> Reader<'a> {
    /// The lines with their words, comments left out; one that ends with a backslash goes on.
    fn lines(&self) -> impl Iterator<Item = (Range<usize>, Vec<Word<'a>>)> + use<'a> {
        let text: &'a str = &self.source.text;
        // A byte order mark begins the first word.
        let text = text.trim_start_matches('\u{feff}');
        let mut at = self.source.text.len() - text.len();
        let mut rest = text.split_inclusive('\n');
        std::iter::from_fn(move || {
            let (from, mut to) = (at, at);
            let mut words: Vec<Word<'a>> = Vec::new();
            for line in rest.by_ref() {
                let start = at;
                at += line.len();
                to = start + line.trim_end().len();
                let body = line.split_once('#').map_or(line, |(body, _)| body);
                words.extend(body.split_ascii_whitespace().map(|w| {
                    let from = start + (w.as_ptr() as usize - line.as_ptr() as usize);
                    (w, from..from + w.len())
                }));
                if body.len() < line.len() || words.last().is_none_or(|w| w.0 != "\\") {
                    break;
                }
                words.pop();
            }
            (at > from).then_some((from..to, words))
        })
        .filter(|(_, words)| !words.is_empty())
    }

    /// The word with which the file begins.
    pub(super) fn first_word(&self) -> Option<&'a str> {
        self.lines().next().map(|(_, words)| words[0].0)
    }

    /// An OBJ file.
    pub(super) fn obj(&mut self) -> Result<(), Problem> {
        let mut pending = Vec::new();
        for (span, words) in self.lines() {
            match words[0].0 {
                "v" => self.point(&span, &words[1..])?,
                "f" => pending.push((span, words, self.raw.points.len())),
                // What has no bearing on the limit surface.
                "vt" | "vn" | "vp" | "g" | "o" | "s" | "usemtl" | "mtllib" | "l" | "p" => {}
                "curv" | "curv2" | "surf" | "cstype" | "deg" => {
                    let help = "write the mesh as `v` and `f` lines";
                    return Err(self.fail(&words[0].1, "line", "curves and surfaces are no mesh", "here", help));
                }
                "t" => self.tags.push((span, words)),
                other => {
                    let message = format!("`{other}` begins no line of a mesh");
                    let help = "lines begin with v, f, t, vt, vn, g, o, s, usemtl or mtllib; `#` begins a comment";
                    return Err(self.fail(&words[0].1, "line", &message, "here", help));
                }
            }
        }
        for (span, words, before) in pending {
            let corners: Result<Vec<u32>, Problem> = words[1..].iter().map(|w| self.corner(w, before)).collect();
            self.face(span, corners?)?;
        }
        Ok(())
    }

    /// A corner of a face: `7`, `7/2`, `7//3`, `7/2/3`, counted from 1, or back from the last point before the line.
    fn corner(&self, (word, span): &Word<'_>, before: usize) -> Result<u32, Problem> {
        let first = word.split('/').next().filter(|w| !w.is_empty());
        let index: Option<i64> = first.and_then(|w| w.parse().ok());
        let count = self.raw.points.len();
        let zero_based = match index {
            Some(k) if k > 0 => usize::try_from(k - 1).ok(),
            Some(k) if k < 0 => usize::try_from(k.unsigned_abs()).ok().and_then(|k| before.checked_sub(k)),
            _ => None,
        };
        zero_based.filter(|k| *k < count).and_then(|k| u32::try_from(k).ok()).ok_or_else(|| {
            let message = format!("`{word}` names no vertex: the file has {count}");
            self.fail(
                span,
                "index",
                &message,
                "this corner",
                "vertices are counted from 1 in the order of the `v` lines",
            )
        })
    }

    /// An OFF file.
    pub(super) fn off(&mut self) -> Result<(), Problem> {
        let mut lines = self.lines();
        let end = self.source.text.len()..self.source.text.len();
        let help = "an OFF file has the line OFF, a line of three counts, the points, then the faces with their number of \
                    corners before them";
        let short = |this: &Self| this.fail(&end, "off", "the file ends too early", "here", help);
        let (span, mut words) = lines.next().ok_or_else(|| short(self))?;
        if words[0].0 != "OFF" {
            return Err(self.fail(&span, "off", "the file does not begin with OFF", "here", help));
        }
        words.remove(0);
        let (span, words) = if words.is_empty() { lines.next().ok_or_else(|| short(self))? } else { (span, words) };
        let count = |k: usize| words.get(k).and_then(|w: &Word<'_>| w.0.parse::<usize>().ok());
        let (Some(points), Some(faces)) = (count(0), count(1)) else {
            return Err(self.fail(&span, "off", "the counts of points and faces are missing", "here", help));
        };
        for _ in 0..points {
            let (span, words) = lines.next().ok_or_else(|| short(self))?;
            self.point(&span, &words)?;
        }
        for _ in 0..faces {
            let (span, words) = lines.next().ok_or_else(|| short(self))?;
            let size: Option<usize> = words[0].0.parse().ok().filter(|n| words.len() > *n);
            let Some(size) = size else {
                return Err(self.fail(&span, "off", "the face has fewer corners than it says", "here", help));
            };
            let corner = |w: &Word<'_>| self.counted_from_0(w, points);
            let corners: Result<Vec<u32>, Problem> = words[1..=size].iter().map(corner).collect();
            self.face(span, corners?)?;
        }
        if let Some((span, _)) = lines.next() {
            return Err(self.fail(&span, "off", "the file goes on after the last face", "here", help));
        }
        Ok(())
    }

    /// A PLY file in ASCII: each point and each face has a line.
    pub(super) fn ply(&mut self) -> Result<(), Problem> {
        let mut lines = self.lines();
        let mut header = Header::default();
        for (span, words) in lines.by_ref() {
            if words[0].0 == "end_header" {
                header.ended = true;
                break;
            }
            let texts: Vec<&str> = words.iter().map(|w| w.0).collect();
            header.line(&texts, span.clone()).map_err(|message| self.in_header(&span, message))?;
        }
        let end = self.source.text.len()..self.source.text.len();
        if let Some(message) = header.fault() {
            return Err(self.in_header(&end, message));
        }
        if header.format != "ascii" {
            return Err(self.in_header(&end, "the header of the binary file has no end"));
        }
        let help = "a PLY file in ASCII has a line for each item that its header announces";
        let points = header.points();
        for element in &header.elements {
            for _ in 0..element.count {
                let Some((span, words)) = lines.next() else {
                    return Err(self.fail(&end, "ply", "the file ends too early", "here", help));
                };
                let Some(values) = element.values(&words) else {
                    return Err(self.fail(
                        &span,
                        "ply",
                        "the line has not the values that the header says",
                        "here",
                        help,
                    ));
                };
                match element.name.as_str() {
                    "vertex" => self.point(&span, &element.coordinates().map(|k| values[k][0].clone()))?,
                    "face" => {
                        let corner = |w: &Word<'_>| self.counted_from_0(w, points);
                        let corners = values[element.corners()].iter().map(corner).collect::<Result<_, _>>()?;
                        self.face(span, corners)?;
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// A corner of a face by the number of its vertex, from 0.
    pub(super) fn counted_from_0(&self, (word, span): &Word<'_>, points: usize) -> Result<u32, Problem> {
        word.parse::<u32>().ok().filter(|k| (*k as usize) < points).ok_or_else(|| {
            let message = format!("`{word}` names no vertex: the file has {points}");
            self.fail(span, "index", &message, "this corner", "vertices are counted from 0 in an OFF or PLY file")
        })
    }

    pub(super) fn in_header(&self, span: &Range<usize>, message: &str) -> Problem {
        let help = "the header says `ply`, `format ascii 1.0`, `element vertex N` with the properties x, y, z, `element face N` \
                    with the list vertex_indices, and `end_header`";
        self.fail(span, "ply", message, "in the header", help)
    }
}

/// A property of an element.
pub(super) struct Property {
    name: String,
    /// The type of its values.
    pub kind: String,
    /// The type of its length, where it is a list.
    pub list: Option<String>,
}

/// A kind of items.
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
    /// The line of the header that says so.
    pub span: Range<usize>,
}

/// What a PLY file says that it holds.
#[derive(Default)]
pub(super) struct Header {
    /// `ascii`, `binary_little_endian` or `binary_big_endian`.
    pub format: String,
    pub elements: Vec<Element>,
    pub ended: bool,
}

impl Header {
    /// Reads one of its lines.
    pub fn line(&mut self, words: &[&str], span: Range<usize>) -> Result<(), &'static str> {
        match words {
            ["ply"] | ["comment" | "obj_info", ..] => Ok(()),
            ["format", format, "1.0"] => {
                (*format).clone_into(&mut self.format);
                Ok(())
            }
            ["element", name, count] => {
                let count = count.parse().map_err(|_| "the element has no number of items")?;
                let twice = self.elements.iter().any(|e| e.name == *name);
                self.elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new(), span });
                if twice { Err("the element is announced twice") } else { Ok(()) }
            }
            ["property", rest @ ..] => {
                let (list, kind, name) = match rest {
                    ["list", length, kind, name] => (Some((*length).to_owned()), *kind, *name),
                    [kind, name] => (None, *kind, *name),
                    _ => return Err("the property has no type and name"),
                };
                let element = self.elements.last_mut().ok_or("a property of no element")?;
                element.properties.push(Property { name: name.to_owned(), kind: kind.to_owned(), list });
                Ok(())
            }
            _ => Err("the line is no part of a header"),
        }
    }

    /// What is missing.
    pub fn fault(&self) -> Option<&'static str> {
        let named = |name: &str| self.elements.iter().position(|e| e.name == name);
        let (Some(vertex), Some(face)) = (named("vertex"), named("face")) else {
            return Some("there are no elements `vertex` and `face`");
        };
        let coordinates = ["x", "y", "z"].iter().all(|name| self.elements[vertex].place(name, false).is_some());
        match self.format.as_str() {
            _ if !self.ended => Some("the header does not end"),
            // As many of them as one likes take no room in a file.
            _ if self.elements.iter().any(|e| e.properties.is_empty()) => Some("an element has no properties"),
            "ascii" | "binary_little_endian" | "binary_big_endian" if !coordinates => Some("a point has no x, y, z"),
            "ascii" | "binary_little_endian" | "binary_big_endian" => {
                let corners = |name: &&str| self.elements[face].place(name, true).is_some();
                (!LISTS.iter().any(corners)).then_some("a face has no list of vertices")
            }
            _ => Some("the format is none that is read"),
        }
    }

    /// The number of points.
    pub fn points(&self) -> usize {
        self.elements.iter().filter(|e| e.name == "vertex").map(|e| e.count).sum()
    }
}

/// The names under which files have the corners of faces.
const LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

impl Element {
    fn place(&self, name: &str, list: bool) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name && p.list.is_some() == list)
    }

    /// The places of the coordinates; [`Header::fault`] has seen that they are there.
    pub fn coordinates(&self) -> [usize; 3] {
        ["x", "y", "z"]
            .map(|name| self.place(name, false).unwrap_or_else(|| unreachable!("a point without coordinates")))
    }

    /// The place of the corners of a face, as seen there.
    pub fn corners(&self) -> usize {
        let all = LISTS.iter().find_map(|name| self.place(name, true));
        all.unwrap_or_else(|| unreachable!("a face without corners"))
    }

    /// The words of each property in a line; `None` where there are too few or too many.
    fn values<'w, 'a>(&self, words: &'w [Word<'a>]) -> Option<Vec<&'w [Word<'a>]>> {
        let (mut all, mut at) = (Vec::new(), 0);
        for property in &self.properties {
            let count = match &property.list {
                None => 1,
                Some(_) => {
                    at += 1;
                    words.get(at - 1)?.0.parse().ok()?
                }
            };
            all.push(words.get(at..usize::checked_add(at, count)?)?);
            at += count;
        }
        (at == words.len()).then_some(all)
    }
}
