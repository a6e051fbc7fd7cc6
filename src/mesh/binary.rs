//! Binary PLY files: integers and floats are exact rationals.

use super::formats::{Element, Header};
use super::read::{Model, Point, Raw, Reader};
use crate::arith::Rational;
use crate::diagnostic::{Problem, SourceText};

/// The end of the header.
const END: &[u8] = b"end_header";

/// The mesh of a binary PLY file, or what is wrong with it; `None` for other files.
pub(super) fn binary(name: &str, bytes: &[u8]) -> Option<Result<Model, Problem>> {
    let end = bytes.starts_with(b"ply").then(|| bytes.windows(END.len()).position(|w| w == END))??;
    let text = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let format = text.lines().find_map(|line| line.strip_prefix("format "))?;
    let little = match format.split_ascii_whitespace().next() {
        Some("binary_little_endian") => true,
        Some("binary_big_endian") => false,
        _ => return None,
    };
    // The line ends with one byte or two.
    let rest = &bytes[end + END.len()..];
    let body = rest.strip_prefix(b"\r\n").or_else(|| rest.strip_prefix(b"\n")).or_else(|| rest.strip_prefix(b"\r"))?;
    let source = SourceText::new(name, text);
    let reader = Reader { source: &source, raw: Raw::default(), tags: Vec::new() };
    Some(Body { little, rest: body }.mesh(reader))
}

/// What follows the header.
struct Body<'a> {
    little: bool,
    rest: &'a [u8],
}

impl Body<'_> {
    fn mesh(mut self, mut reader: Reader<'_>) -> Result<Model, Problem> {
        let source = reader.source;
        let (mut header, mut at) = (Header::default(), 0);
        for line in source.text.split_inclusive('\n') {
            let span = at..at + line.trim_end().len();
            at += line.len();
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            if !words.is_empty() {
                header.line(&words, span.clone()).map_err(|message| reader.in_header(&span, message))?;
            }
        }
        header.ended = true;
        if let Some(message) = header.fault() {
            return Err(reader.in_header(&(0..3), message));
        }
        let points = header.points();
        for element in &header.elements {
            for number in 0..element.count {
                let help = "write the file anew, or as ASCII, where every item has its line";
                let fault = |message: &str| {
                    let message = format!("{} {number}: {message}", element.name);
                    reader.fail(&element.span, "ply", &message, "announced here", help)
                };
                let values = self.item(element).ok_or_else(|| fault("the file ends too early, or a number is none"))?;
                match element.name.as_str() {
                    "vertex" => {
                        let point = element.coordinates().map(|k| values[k].first().cloned().flatten());
                        let [Some(x), Some(y), Some(z)] = point else { return Err(fault("a coordinate is no number")) };
                        let point: Point = [x, y, z];
                        reader.raw.points.push(point);
                        reader.raw.point_spans.push(element.span.clone());
                    }
                    "face" => {
                        let corner = |x: &Option<Rational>| {
                            x.as_ref().and_then(|x| u32::try_from(x).ok()).filter(|k| (*k as usize) < points)
                        };
                        let corners: Option<Vec<u32>> = values[element.corners()].iter().map(corner).collect();
                        let corners = corners.ok_or_else(|| fault("a corner names no vertex"))?;
                        reader.face(element.span.clone(), corners)?;
                    }
                    _ => {}
                }
            }
        }
        Ok(Model { text: None, ..reader.finish()? })
    }

    /// The values of each property of an item; a value that is no finite number is `None`.
    fn item(&mut self, element: &Element) -> Option<Vec<Vec<Option<Rational>>>> {
        let mut all = Vec::new();
        for property in &element.properties {
            let count = match &property.list {
                None => 1,
                Some(kind) => usize::try_from(&self.value(kind)??).ok()?,
            };
            let mut values = Vec::new();
            for _ in 0..count {
                values.push(self.value(&property.kind)?);
            }
            all.push(values);
        }
        Some(all)
    }

    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        let mut first = *first;
        if !self.little {
            first.reverse();
        }
        Some(first)
    }

    /// The next value of a type; `None` where there is none or no such type.
    fn value(&mut self, kind: &str) -> Option<Option<Rational>> {
        Some(match kind {
            "char" | "int8" => Some(i8::from_le_bytes(self.bytes()?).into()),
            "uchar" | "uint8" => Some(u8::from_le_bytes(self.bytes()?).into()),
            "short" | "int16" => Some(i16::from_le_bytes(self.bytes()?).into()),
            "ushort" | "uint16" => Some(u16::from_le_bytes(self.bytes()?).into()),
            "int" | "int32" => Some(i32::from_le_bytes(self.bytes()?).into()),
            "uint" | "uint32" => Some(u32::from_le_bytes(self.bytes()?).into()),
            "float" | "float32" => Rational::try_from(f64::from(f32::from_le_bytes(self.bytes()?))).ok(),
            "double" | "float64" => Rational::try_from(f64::from_le_bytes(self.bytes()?)).ok(),
            _ => return None,
        })
    }
}
