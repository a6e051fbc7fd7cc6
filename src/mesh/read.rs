//! Meshes from OBJ, OFF and PLY files, with exact coordinates: a decimal, or a float, is the rational number that it says.

use super::binary::binary;
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
    /// Whether the file has tags of sharp edges or vertices.
    pub sharp: bool,
    /// The text of the file, where it is a text.
    pub text: Option<Arc<str>>,
}

/// Points and faces with their places in the file.
#[derive(Default)]
pub(super) struct Raw {
    pub points: Vec<Point>,
    pub point_spans: Vec<Range<usize>>,
    pub faces: Vec<Vec<u32>>,
    pub face_spans: Vec<Range<usize>>,
}

/// A word of a line with its place in the file.
pub(super) type Word<'a> = (&'a str, Range<usize>);

/// A file while it is read.
pub(super) struct Reader<'a> {
    pub source: &'a SourceText,
    pub raw: Raw,
    pub tags: Vec<(Range<usize>, Vec<Word<'a>>)>,
}

fn problem(source: &SourceText, span: Range<usize>, code: &str, message: &str, note: &str, help: &str) -> Problem {
    Problem::new(format!("secant::mesh::{code}"), message).with_source(source).with_label(span, note).with_help(help)
}

/// Whether a path has the ending of a mesh file.
#[must_use]
pub fn is_mesh(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    matches!(ending.as_deref(), Some("obj" | "off" | "ply"))
}

impl Model {
    /// Reads an OBJ, OFF or PLY file: an OFF file by its ending, a PLY file by its first word.
    ///
    /// # Errors
    /// A [`Problem`] with the line: for words that are no numbers or no vertices, faces that repeat a vertex or one another,
    /// edges of three faces and more, vertices at which the faces do not form one fan.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        let name = path.display().to_string();
        let unreadable = |e: &dyn std::fmt::Display| {
            Problem::new("secant::mesh::unreadable", format!("{name} cannot be read: {e}"))
                .with_help("give the path of a mesh in the format OBJ, OFF or PLY")
        };
        let file = std::fs::File::open(path).map_err(|e| unreadable(&e))?;
        let mut bytes = Vec::new();
        file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(|e| unreadable(&e))?;
        if bytes.len() > MAX_BYTES {
            return Err(unreadable(&format!("it has more than {MAX_BYTES} bytes")));
        }
        if let Some(found) = binary(&name, &bytes) {
            return found;
        }
        let off = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("off"));
        // Comments and names may be in any encoding; what is not the text of the file is not kept.
        match String::from_utf8(bytes) {
            Ok(text) => Self::parse(&SourceText::new(name.as_str(), text), off),
            Err(other) => {
                let text = String::from_utf8_lossy(other.as_bytes()).into_owned();
                Ok(Self { text: None, ..Self::parse(&SourceText::new(name.as_str(), text), off)? })
            }
        }
    }

    /// Reads the text of an OBJ file, of an OFF file, or of a PLY file, which begins with `ply`.
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
        let mut reader = Reader { source, raw: Raw::default(), tags: Vec::new() };
        match reader.first_word() {
            Some("ply") => reader.ply()?,
            _ if off => reader.off()?,
            _ => reader.obj()?,
        }
        reader.finish()
    }
}

impl<'a> Reader<'a> {
    pub(super) fn fail(&self, span: &Range<usize>, code: &str, message: &str, note: &str, help: &str) -> Problem {
        problem(self.source, span.clone(), code, message, note, help)
    }

    /// A point with its three coordinates, and whatever else stands in its line.
    pub(super) fn point(&mut self, span: &Range<usize>, words: &[Word<'_>]) -> Result<(), Problem> {
        // A fourth number is a weight, which is 1 where nothing is rational in the projective sense; further ones are colours.
        if words.len() < 3 {
            let help = "a point has three coordinates";
            return Err(self.fail(span, "point", "the point has fewer than three coordinates", "here", help));
        }
        if words.len() == 4 && !parse_rational(words[3].0).is_ok_and(|w| w == 1) {
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

    /// A face of some corners.
    pub(super) fn face(&mut self, span: Range<usize>, corners: Vec<u32>) -> Result<(), Problem> {
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

    /// The mesh, if it is one.
    pub(super) fn finish(self) -> Result<Model, Problem> {
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
            sharp: self.tags.iter().any(|(_, words)| matches!(words.get(1), Some(("crease" | "corner", _)))),
            text: Some(Arc::clone(&source.text)),
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
            ("v 1 2 3 x", "weight", 6),
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
