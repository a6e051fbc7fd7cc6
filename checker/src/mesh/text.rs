//! The text of a mesh: points with exact coordinates, and polygons, from an OBJ, an OFF or an ASCII PLY file.

use crate::base::{Checked, Q, bits, need, number::decimal_fraction, reject, some, spend, whole};

/// Most digits of a coordinate, its exponent counted as so many.
const MAX_DIGITS: usize = 400;

/// Tags that bear on borders or on texture coordinates only.
const TAGS: [&str; 4] =
    ["interpolateboundary", "creasemethod", "facevaryinginterpolateboundary", "facevaryingpropagatecorners"];

/// What stands in a file.
pub struct Text {
    /// The points.
    pub points: Vec<[Q; 3]>,
    /// The faces, as numbers of points.
    pub faces: Vec<Vec<u32>>,
}

fn lines(text: &str) -> Vec<Vec<&str>> {
    let text = text.trim_start_matches('\u{feff}');
    let (mut all, mut open) = (Vec::new(), false);
    for line in text.split('\n') {
        let (body, comment) = match line.split_once('#') {
            Some((body, _)) => (body, true),
            None => (line, false),
        };
        let mut words: Vec<&str> = body.split_ascii_whitespace().collect();
        // A line that ends with a backslash goes on.
        let goes_on = !comment && words.last() == Some(&"\\");
        if goes_on {
            words.pop();
        }
        match all.last_mut() {
            Some(last) if open => Vec::extend(last, words),
            _ => all.push(words),
        }
        open = goes_on;
    }
    all.retain(|words| !words.is_empty());
    all
}

/// The words of each property in a line, with no word left.
fn items<'w, 'a>(words: &'w [&'a str], properties: &[(&str, bool)]) -> Option<Vec<&'w [&'a str]>> {
    let (mut rest, mut all) = (words, Vec::new());
    for (_, list) in properties {
        let mut count = 1;
        if *list {
            let (first, others) = rest.split_first()?;
            (count, rest) = (first.parse().ok()?, others);
        }
        let (own, others) = rest.split_at_checked(count)?;
        all.push(own);
        rest = others;
    }
    rest.is_empty().then_some(all)
}

impl Text {
    /// Reads a file: the first word of an OFF file is `OFF`, that of a PLY file `ply`.
    pub fn read(text: &str) -> Checked<Self> {
        let lines = lines(text);
        let mut found = Self { points: Vec::new(), faces: Vec::new() };
        match lines.first().map(|words| words[0]) {
            Some("OFF") => found.off(&lines)?,
            Some("ply") => found.ply(&lines)?,
            _ => found.obj(&lines)?,
        }
        need(!found.faces.is_empty(), "case", "a mesh without faces")?;
        Ok(found)
    }

    fn obj(&mut self, lines: &[Vec<&str>]) -> Checked<()> {
        let mut pending = Vec::new();
        for words in lines {
            match words[0] {
                "v" => self.point(&words[1..])?,
                "f" => pending.push((&words[1..], self.points.len())),
                "vt" | "vn" | "vp" | "g" | "o" | "s" | "usemtl" | "mtllib" | "l" | "p" => {}
                // Of borders nothing is said.
                "t" if words.get(1).is_some_and(|name| TAGS.contains(name)) => {}
                "t" => return reject("case", "there are no certificates of meshes with such tags"),
                _ => return reject("case", "a line that is no part of a mesh"),
            }
        }
        let count = self.points.len();
        for (words, before) in pending {
            let corner = |word: &&str| {
                let number = word.split('/').next().and_then(|w| w.parse::<i64>().ok());
                let place = match number {
                    Some(k) if k > 0 => usize::try_from(k - 1).ok(),
                    Some(k) if k < 0 => usize::try_from(k.unsigned_abs()).ok().and_then(|k| before.checked_sub(k)),
                    _ => None,
                };
                let place = place.filter(|k| *k < count).and_then(|k| u32::try_from(k).ok());
                some(place, "case", "a corner that names no vertex")
            };
            let corners = words.iter().map(corner).collect::<Checked<_>>()?;
            self.face(corners)?;
        }
        Ok(())
    }

    fn off(&mut self, lines: &[Vec<&str>]) -> Checked<()> {
        let words: Vec<&[&str]> =
            lines.iter().enumerate().map(|(k, l)| &l[usize::from(k == 0)..]).filter(|l| !l.is_empty()).collect();
        let count = |k: usize| words.first().and_then(|l| l.get(k)).and_then(|w| w.parse::<usize>().ok());
        let (Some(points), Some(faces)) = (count(0), count(1)) else {
            return reject("case", "the counts of points and faces are missing");
        };
        let all = points.checked_add(faces).and_then(|n| n.checked_add(1));
        need(all == Some(words.len()), "case", "the file has not the lines that it says")?;
        words[1..=points].iter().try_for_each(|words| self.point(words))?;
        for words in &words[1 + points..] {
            let size = words[0].parse::<usize>().ok().filter(|n| words.len() > *n);
            let size = some(size, "case", "a face has fewer corners than it says")?;
            let corner = |w: &&str| {
                let place = w.parse::<u32>().ok().filter(|k| (*k as usize) < points);
                some(place, "case", "a corner that names no vertex")
            };
            let corners = words[1..=size].iter().map(corner).collect::<Checked<_>>()?;
            self.face(corners)?;
        }
        Ok(())
    }

    fn ply(&mut self, lines: &[Vec<&str>]) -> Checked<()> {
        let end = some(lines.iter().position(|words| words[0] == "end_header"), "case", "the header does not end")?;
        // Elements with their number of items, and their properties, with whether each is a list.
        let mut elements: Vec<(&str, usize, Vec<(&str, bool)>)> = Vec::new();
        let mut ascii = false;
        for words in &lines[1..end] {
            match words[..] {
                ["comment" | "obj_info", ..] => {}
                ["format", "ascii", "1.0"] => ascii = true,
                ["element", name, count] => {
                    let known = elements.iter().any(|e| e.0 == name);
                    let count = count.parse().ok().filter(|_| !known);
                    elements.push((name, some(count, "case", "an element without a number, or twice")?, Vec::new()));
                }
                ["property", "list", _, _, name] | ["property", _, name] => {
                    let last = some(elements.last_mut(), "case", "a property of no element")?;
                    last.2.push((name, words.len() == 5));
                }
                _ => return reject("case", "a line that is no part of a header"),
            }
        }
        need(ascii, "case", "a PLY file that is not in ASCII")?;
        let points = elements.iter().find(|e| e.0 == "vertex").map(|e| e.1);
        let points = some(points, "case", "a PLY file without vertices")?;
        let mut rest = lines[end + 1..].iter();
        for (name, count, properties) in &elements {
            for _ in 0..*count {
                let words = some(rest.next(), "case", "the file ends too early")?;
                let values = some(items(words, properties), "case", "a line has not the values that it needs")?;
                let find = |name: &str, list| properties.iter().position(|p| *p == (name, list)).map(|k| values[k]);
                if *name == "vertex" {
                    let point = ["x", "y", "z"].map(|c| find(c, false).map(|v| v[0]));
                    let [Some(x), Some(y), Some(z)] = point else {
                        return reject("case", "a point without coordinates");
                    };
                    self.point(&[x, y, z])?;
                } else if *name == "face" {
                    let corners = find("vertex_indices", true).or_else(|| find("vertex_index", true));
                    let corner = |w: &&str| {
                        let place = w.parse::<u32>().ok().filter(|k| (*k as usize) < points);
                        some(place, "case", "a corner that names no vertex")
                    };
                    let corners = some(corners, "case", "a face without corners")?;
                    self.face(corners.iter().map(corner).collect::<Checked<_>>()?)?;
                }
            }
        }
        Ok(())
    }

    fn point(&mut self, words: &[&str]) -> Checked<()> {
        need(words.len() >= 3, "case", "a point has three coordinates")?;
        let weight = words.len() != 4 || decimal_fraction(words[3]).is_some_and(|w| w == whole(1));
        need(weight, "case", "a point with a weight")?;
        let mut point = Vec::new();
        for word in &words[..3] {
            let exponent = word.split_once(['e', 'E']).map(|(_, e)| e.trim_start_matches(['+', '-']).parse::<usize>());
            let digits = match exponent {
                None => Some(word.len()),
                Some(e) => e.ok().and_then(|e| e.checked_add(word.len())),
            };
            let plain = !word.contains('/') && digits.is_some_and(|d| d <= MAX_DIGITS);
            let number = if plain { decimal_fraction(word) } else { None };
            let number = some(number, "case", "a coordinate that is no decimal")?;
            spend(4, bits(&number))?;
            point.push(number);
        }
        let [Some(z), Some(y), Some(x)] = std::array::from_fn(|_| point.pop()) else {
            return reject("case", "a point has three coordinates");
        };
        self.points.push([x, y, z]);
        Ok(())
    }

    fn face(&mut self, corners: Vec<u32>) -> Checked<()> {
        need(corners.len() >= 3, "case", "a face with fewer than three corners")?;
        let mut sorted = corners.clone();
        sorted.sort_unstable();
        need(sorted.windows(2).all(|w| w[0] != w[1]), "case", "a face with a vertex twice")?;
        spend(8 * corners.len(), 64)?;
        self.faces.push(corners);
        Ok(())
    }
}
