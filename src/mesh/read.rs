//! Meshes from OBJ and OFF files, with exact coordinates: a decimal is the rational number that it says.

use super::tags::Tags;
use super::topology::{Fault, Topology};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::{Problem, SourceText};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Largest file that is read, in bytes.
pub const MAX_BYTES: usize = 256 << 20;
/// Largest number of faces.
pub const MAX_FACES: usize = 1_000_000;
/// Largest number of digits of a coordinate, its exponent counted as so many.
const MAX_DIGITS: usize = 400;

/// A point of space.
pub type Point = [Rational; 3];

/// A mesh as it was read: points, faces, and the lines on which they stand.
#[derive(Debug, Clone)]
pub struct Model {
    /// The name of the file.
    pub name: String,
    /// The coordinates.
    pub points: Vec<Point>,
    /// The line of each point, from 1.
    pub point_lines: Vec<usize>,
    /// The line of each face, from 1.
    pub face_lines: Vec<usize>,
    /// The faces and how they hang together.
    pub topology: Topology,
    /// What is sharp, and the rule of the border.
    pub tags: Tags,
    /// Whether the file has lines of tags.
    pub tagged: bool,
    /// The text of the file.
    pub text: Arc<str>,
}

struct Raw {
    points: Vec<Point>,
    point_spans: Vec<Range<usize>>,
    faces: Vec<Vec<u32>>,
    face_spans: Vec<Range<usize>>,
}

/// A word of a line with its place in the file.
type Word<'a> = (&'a str, Range<usize>);

struct Reader<'a> {
    source: &'a SourceText,
    raw: Raw,
    tags: Vec<(Range<usize>, Vec<Word<'a>>)>,
}

fn problem(source: &SourceText, span: Range<usize>, code: &str, message: &str, note: &str, help: &str) -> Problem {
    Problem::new(format!("secant::mesh::{code}"), message).with_source(source).with_label(span, note).with_help(help)
}

/// Whether a path has the ending of a mesh file.
#[must_use]
pub fn is_mesh(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    matches!(ending.as_deref(), Some("obj" | "off"))
}

impl Model {
    /// Reads an OBJ or OFF file, whichever its ending says.
    ///
    /// # Errors
    /// A [`Problem`] with the line: for words that are no numbers or no vertices, faces that repeat a vertex or one another,
    /// edges of three faces and more, vertices at which the faces do not form one fan.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        let name = path.display().to_string();
        let unreadable = |e: &dyn std::fmt::Display| {
            Problem::new("secant::mesh::unreadable", format!("{name} cannot be read: {e}"))
                .with_help("give the path of a mesh in the format OBJ or OFF, as text")
        };
        let file = std::fs::File::open(path).map_err(|e| unreadable(&e))?;
        let mut text = String::new();
        file.take(MAX_BYTES as u64 + 1).read_to_string(&mut text).map_err(|e| unreadable(&e))?;
        if text.len() > MAX_BYTES {
            return Err(unreadable(&format!("it has more than {MAX_BYTES} bytes")));
        }
        let off = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("off"));
        Self::parse(&SourceText::new(name.as_str(), text), off)
    }

    /// Reads the text of an OBJ file, or of an OFF file.
    ///
    /// # Errors
    /// As [`Model::read`].
    ///
    /// # Cost
    /// Linear in the text but for sorting the edges.
    ///
    /// # Examples
    /// ```
    /// use secant::{diagnostic::SourceText, mesh::Model};
    /// let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    /// let model = Model::parse(&SourceText::new("tetrahedron.obj", text), false)?;
    /// assert_eq!((model.points.len(), model.topology.faces(), model.face_lines[0]), (4, 4, 5));
    /// let torn = text.replace("f 3 1 4", "f 3 1 5");
    /// let problem = Model::parse(&SourceText::new("torn.obj", torn), false).unwrap_err();
    /// assert_eq!(problem.position(), Some((8, 7)));
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(source: &SourceText, off: bool) -> Result<Self, Problem> {
        let raw = Raw { points: Vec::new(), point_spans: Vec::new(), faces: Vec::new(), face_spans: Vec::new() };
        let mut reader = Reader { source, raw, tags: Vec::new() };
        if off {
            reader.off()?
        } else {
            reader.obj()?
        }
        reader.finish()
    }
}

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
            loop {
                let Some(line) = rest.next() else { break };
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

    fn fail(&self, span: &Range<usize>, code: &str, message: &str, note: &str, help: &str) -> Problem {
        problem(self.source, span.clone(), code, message, note, help)
    }

    fn obj(&mut self) -> Result<(), Problem> {
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

    fn off(&mut self) -> Result<(), Problem> {
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
            let corner = |w: &Word<'_>| {
                w.0.parse::<u32>().ok().filter(|k| (*k as usize) < points).ok_or_else(|| {
                    let message = format!("`{}` names no vertex: the file has {points}", w.0);
                    self.fail(&w.1, "index", &message, "this corner", "vertices are counted from 0 in an OFF file")
                })
            };
            let corners: Result<Vec<u32>, Problem> = words[1..=size].iter().map(corner).collect();
            self.face(span, corners?)?;
        }
        if let Some((span, _)) = lines.next() {
            return Err(self.fail(&span, "off", "the file goes on after the last face", "here", help));
        }
        Ok(())
    }

    fn point(&mut self, span: &Range<usize>, words: &[Word<'_>]) -> Result<(), Problem> {
        // A fourth number is a weight, which is 1 where nothing is rational in the projective sense; further ones are colours.
        if words.len() < 3 {
            let help = "a point has three coordinates";
            return Err(self.fail(span, "point", "the point has fewer than three coordinates", "here", help));
        }
        if words.len() == 4 && parse_rational(words[3].0).is_ok_and(|w| w != 1) {
            let help = "rational surfaces are not covered; the weight has to be 1";
            return Err(self.fail(&words[3].1, "weight", "the point has a weight", "here", help));
        }
        let mut point = Vec::new();
        for (word, place) in &words[..3] {
            let help = "coordinates are integers or decimals such as -0.25 or 1.5e-3, with at most 400 digits";
            let digits = word.len() + exponent(word);
            let value = parse_rational(word).ok().filter(|_| digits <= MAX_DIGITS && !word.contains('/'));
            let Some(value) = value else {
                let message = format!("`{}` is no coordinate", word.chars().take(40).collect::<String>());
                return Err(self.fail(place, "number", &message, "this number", help));
            };
            point.push(value);
        }
        let point: Point = point.try_into().map_err(|_| Problem::new(Problem::INTERNAL, "a point of three"))?;
        self.raw.points.push(point);
        self.raw.point_spans.push(span.clone());
        Ok(())
    }

    fn face(&mut self, span: Range<usize>, corners: Vec<u32>) -> Result<(), Problem> {
        if corners.len() < 3 {
            let help = "a face has three corners at least";
            return Err(self.fail(&span, "face", "the face has fewer than three corners", "here", help));
        }
        let mut sorted = corners.clone();
        sorted.sort_unstable();
        if sorted.windows(2).any(|w| w[0] == w[1]) {
            let help = "every corner of a face is another vertex";
            return Err(self.fail(&span, "face", "the face has a vertex twice", "here", help));
        }
        if self.raw.faces.len() == MAX_FACES {
            let message = format!("the mesh has more than {MAX_FACES} faces");
            return Err(self.fail(&span, "large", &message, "the first one too many", "take a part of the mesh"));
        }
        self.raw.faces.push(corners);
        self.raw.face_spans.push(span);
        Ok(())
    }

    fn finish(self) -> Result<Model, Problem> {
        let (source, raw) = (self.source, self.raw);
        if raw.faces.is_empty() {
            return Err(Problem::new("secant::mesh::empty", format!("{} has no faces", source.name))
                .with_source(source)
                .with_help("a mesh has `v` lines and `f` lines"));
        }
        let mut seen: BTreeMap<Vec<u32>, usize> = BTreeMap::new();
        for (f, face) in raw.faces.iter().enumerate() {
            let mut key = face.clone();
            key.sort_unstable();
            if let Some(first) = seen.insert(key, f) {
                let message = "the face has the corners of an earlier one";
                let help = "take one of the two faces out";
                return Err(problem(source, raw.face_spans[f].clone(), "duplicate", message, "this face", help)
                    .with_label(raw.face_spans[first].clone(), "the earlier one"));
            }
        }
        let topology = Topology::new(raw.points.len(), &raw.faces).map_err(|fault| faulty(source, &raw, &fault))?;
        let mut breaks: Vec<usize> =
            source.text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(k, _)| k).collect();
        breaks.push(source.text.len());
        let line = |span: &Range<usize>| breaks.partition_point(|b| *b < span.start) + 1;
        let mut model = Model {
            name: source.name.clone(),
            point_lines: raw.point_spans.iter().map(line).collect(),
            face_lines: raw.face_spans.iter().map(line).collect(),
            points: raw.points,
            topology,
            tags: Tags::default(),
            tagged: !self.tags.is_empty(),
            text: Arc::clone(&source.text),
        };
        model.tags = tags(source, &self.tags, &model)?;
        Ok(model)
    }
}

/// What the tags of a file say of its mesh.
fn tags(source: &SourceText, lines: &[(Range<usize>, Vec<Word<'_>>)], model: &Model) -> Result<Tags, Problem> {
    let mut tags = Tags::default();
    let t = &model.topology;
    let edge = |[c, _]: &[u32; 2]| {
        let (a, b) = (t.vertex[*c as usize], t.vertex[t.next(*c) as usize]);
        (a.min(b), a.max(b))
    };
    let edges: BTreeSet<(u32, u32)> =
        if lines.is_empty() { BTreeSet::new() } else { t.edges.iter().map(edge).collect() };
    for (span, words) in lines {
        tags.read(words, model, &edges).map_err(|(word, code, message, help)| {
            let place = word.and_then(|k| words.get(k)).map_or(span, |w| &w.1);
            problem(source, place.clone(), code, &message, "here", help)
        })?;
    }
    Ok(tags)
}

fn exponent(word: &str) -> usize {
    let digits = word.split_once(['e', 'E']).map(|(_, e)| e.trim_start_matches(['+', '-']));
    match digits {
        // More digits than a number has room for are too many in any case.
        Some(e) => e.parse().map_or(usize::MAX / 2, |e: usize| e.min(usize::MAX / 2)),
        None => 0,
    }
}

fn faulty(source: &SourceText, raw: &Raw, fault: &Fault) -> Problem {
    match fault {
        Fault::Edge { ends: (a, b), faces } => {
            let message = format!("{} faces share the edge from vertex {} to vertex {}", faces.len(), a + 1, b + 1);
            let mut found = problem(
                source,
                raw.face_spans[faces[2]].clone(),
                "edge",
                &message,
                "one too many",
                "an edge of a surface has one face or two; split the mesh there",
            );
            for f in &faces[..2] {
                found = found.with_label(raw.face_spans[*f].clone(), "here too");
            }
            found
        }
        Fault::Vertex { vertex, faces } => {
            let message = format!("the faces at vertex {} do not form one fan", vertex + 1);
            problem(
                source,
                raw.point_spans[*vertex].clone(),
                "vertex",
                &message,
                "at this vertex the mesh is no surface",
                "give the two parts a vertex of their own each",
            )
            .with_label(raw.face_spans[faces.0].clone(), "a face of one part")
            .with_label(raw.face_spans[faces.1].clone(), "a face of another")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Model, Problem> {
        Model::parse(&SourceText::new("m.obj", text), false)
    }

    #[test]
    fn decimals_are_exact() {
        let text = "# a comment\nv 0.1 -2.5e-1 1e2 # another\nv 1 0 0\nv 0 1 0\nf -3/1/1 2//7 3\n";
        let model = parse(text).unwrap();
        assert_eq!(
            model.points[0],
            [Rational::from_signeds(1, 10), Rational::from_signeds(-1, 4), Rational::from(100)]
        );
        assert_eq!((model.point_lines[0], model.face_lines[0]), (2, 5));
    }

    #[test]
    fn mistakes_have_their_line() {
        let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n";
        for (lines, code, line) in [
            ("f 1 2 9", "index", 6),
            ("f 1 2 0", "index", 6),
            ("f 1 2 -6", "index", 6),
            ("f 1 2", "face", 6),
            ("f 1 2 2", "face", 6),
            ("f 1 2 3\nf 3 1 2", "duplicate", 7),
            ("f 1 2 3\nf 2 1 4\nf 1 2 5", "edge", 8),
            ("v nan 0 0", "number", 6),
            ("v inf 0 0", "number", 6),
            ("v 1e9999999 0 0", "number", 6),
            ("v 1 2", "point", 6),
            ("v 1 2 3 2", "weight", 6),
            ("f 1 2 3\nt crease 2/1/0 0 3 10", "crease", 7),
            ("f 1 2 3\nt crease 2/1/0 0 9 10", "index", 7),
            ("f 1 2 3\nt crease 2/1/0 0 1 nan", "number", 7),
            ("f 1 2 3\nt crease 2/1/0 0 1 -2", "number", 7),
            ("f 1 2 3\nt crease 2/1/0 0 1", "tag", 7),
            ("f 1 2 3\nt crease 1/1/0 0 1", "tag", 7),
            ("f 1 2 3\nt crease", "tag", 7),
            ("f 1 2 3\nt corner 1/1/0 x 10", "index", 7),
            ("f 1 2 3\nt interpolateboundary 1/0/0 7", "tag", 7),
            ("f 1 2 3\nt smoothtriangles 0/0/1 smooth", "tag", 7),
            ("f 1 2 3\nt hole 1/0/0 0", "tag", 7),
            ("vertex 1 2 3", "line", 6),
            ("v 1 0 2\nv 2 0 2\nf 1 2 3\nf 1 6 7", "vertex", 1),
        ] {
            let problem = parse(&format!("{points}{lines}\n")).unwrap_err();
            assert_eq!(problem.id(), format!("secant::mesh::{code}"), "{lines}");
            assert_eq!(problem.position().map(|p| p.0), Some(line), "{lines}");
            assert!(problem.remedy().is_some());
        }
        assert_eq!(parse("v 0 0 0\n").unwrap_err().id(), "secant::mesh::empty");
    }

    #[test]
    fn lines_go_on_after_a_backslash() {
        let text = "v 0 0 \\\n  0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2 \\\n3\n# a comment \\\nf 1 2 x\n";
        let problem = parse(text).unwrap_err();
        assert_eq!(problem.position(), Some((9, 7)));
        let model = parse(&text.replace("f 1 2 x", "")).unwrap();
        assert_eq!((model.points.len(), model.face_lines[0]), (3, 5));
    }

    #[test]
    fn off_files() {
        let text = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 0.5\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
        let model = Model::parse(&SourceText::new("t.off", text), true).unwrap();
        assert_eq!((model.topology.faces(), model.face_lines[0]), (4, 7));
        for (bad, line) in [("3 2 0 4", 10), ("4 2 0 3", 10), ("OFF", 11), ("", 11)] {
            let text = text
                .replace("3 2 0 3\n", &if bad == "OFF" { "3 2 0 3\n3 0 1 2\n".to_owned() } else { format!("{bad}\n") });
            let text = if bad.is_empty() { text.replace("\n\n", "\n") } else { text };
            let problem = Model::parse(&SourceText::new("t.off", text), true).unwrap_err();
            assert!(problem.position().is_some_and(|p| p.0 == line || p.0 == line - 1), "{bad}: {problem:?}");
        }
    }
}
