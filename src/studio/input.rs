//! What the page asks about: a scheme with parameters, a mesh rule, a text, or a mesh; always text, never a path.

use crate::arith::{Rational, parse_rational};
use crate::case::{Origin, Question, Subject, Valences, with_control, written};
use crate::diagnostic::{Problem, SourceText};
use crate::mesh::{Model, Scheme};
use crate::shape::Frame;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Most further points of one request.
const MAX_POINTS: usize = 16;
/// Control points of a suggested polygon beyond those of one span.
const MORE: usize = 3;
/// Masks with more control points for one span have one span.
const SMALL: usize = 4;

/// What the page sends.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Input {
    /// A named scheme.
    Scheme {
        name: String,
        #[serde(default)]
        parameters: BTreeMap<String, String>,
        #[serde(default)]
        ends: Option<String>,
        #[serde(default)]
        control: Control,
        #[serde(default)]
        at: Vec<String>,
    },
    /// A rule on meshes, at vertices.
    Rule {
        name: String,
        #[serde(default)]
        parameters: BTreeMap<String, String>,
        valence: String,
    },
    /// A case, or what stands for one.
    Text {
        text: String,
        #[serde(default)]
        control: Control,
        #[serde(default)]
        at: Vec<String>,
    },
    /// A mesh in the format OBJ, or OFF.
    Mesh {
        text: String,
        #[serde(default)]
        off: bool,
        scheme: String,
    },
}

/// The control points.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Control {
    /// Those of the text.
    #[default]
    AsWritten,
    /// Those of the text, or some polygon of a curve that has none.
    Suggested,
    /// None: the curve in barycentric space.
    None,
    /// These.
    Points(Vec<Vec<String>>),
}

/// A request, understood.
#[derive(Debug, Clone)]
pub enum Asked {
    /// A case: its question.
    Case(Question),
    /// A mesh with its scheme.
    Mesh {
        /// The mesh.
        model: Box<Model>,
        /// The scheme.
        scheme: Scheme,
        /// The text.
        text: SourceText,
    },
}

impl Asked {
    /// The text that is examined.
    pub fn text(&self) -> &SourceText {
        match self {
            Self::Case(question) => question.text(),
            Self::Mesh { text, .. } => text,
        }
    }
}

impl Input {
    /// What is meant, as a question.
    ///
    /// # Errors
    /// The [`Problem`] of the text, of a parameter, or of a control point.
    pub fn asked(&self) -> Result<Asked, Problem> {
        match self {
            Self::Scheme { name, parameters, ends, control, at } => {
                let ends = ends.iter().map(|ends| format!("ends = {}\n", quoted(ends)));
                let body: String = lines(parameters).chain(ends).collect();
                let text = case(name, parameters, &format!("[scheme]\nname = {}\n{body}", quoted(name)));
                question(&text, control, at)
            }
            Self::Rule { name, parameters, valence } => {
                let valence = Valences::parse(valence)
                    .map(|_| format!("valence = {}\n", quoted(valence)))
                    .map_err(|e| Problem::new("secant::usage::valence", e).with_help("write 5, 3..12 or 3,5,8"))?;
                let body: String = lines(parameters).collect();
                let text = case(name, parameters, &format!("[vertex]\nmesh = {}\n{valence}{body}", quoted(name)));
                Ok(Asked::Case(Question::parse("case.toml", &text)?))
            }
            Self::Text { text, control, at } => question(&written(text)?, control, at),
            Self::Mesh { text, off, scheme } => {
                let known = Scheme::ALL.map(Scheme::name).join(", ");
                let scheme = Scheme::named(scheme).ok_or_else(|| {
                    Problem::new("secant::usage::scheme", "meshes are not refined by this scheme")
                        .with_help(format!("the schemes for meshes are {known}"))
                })?;
                let text = SourceText::new(if *off { "mesh.off" } else { "mesh.obj" }, text.as_str());
                let model = Box::new(Model::parse(&text, *off)?);
                Ok(Asked::Mesh { model, scheme, text })
            }
        }
    }
}

/// A string of JSON, which is a string of TOML.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn lines(parameters: &BTreeMap<String, String>) -> impl Iterator<Item = String> + '_ {
    parameters.iter().map(|(key, value)| format!("{} = {}\n", quoted(key), quoted(value)))
}

fn case(name: &str, parameters: &BTreeMap<String, String>, body: &str) -> String {
    let title: Vec<String> = parameters.iter().map(|(key, value)| format!("{key}={value}")).collect();
    let title = format!("{name} {}", title.join(" "));
    format!("name = {}\ntitle = {}\n\n{body}", quoted(name), quoted(title.trim()))
}

/// The question of a text, with its control points and further points.
fn question(text: &str, control: &Control, at: &[String]) -> Result<Asked, Problem> {
    let with = |points: Option<&[Vec<Rational>]>| {
        let text = with_control(text, points).unwrap_or_else(|| text.to_owned());
        Question::parse("case.toml", &text)
    };
    let question = match control {
        Control::AsWritten => Question::parse("case.toml", text)?,
        Control::None => with(None)?,
        Control::Points(points) => with(Some(&numbers(points)?))?,
        Control::Suggested => {
            let question = Question::parse("case.toml", text)?;
            match suggested(&question) {
                // Where a polygon is no help, the text stays as it is.
                Some(points) => with(Some(&points)).unwrap_or(question),
                None => question,
            }
        }
    };
    if at.len() > MAX_POINTS {
        return Err(Problem::new("secant::studio::limit", format!("{} points are too many", at.len()))
            .with_help(format!("ask about {MAX_POINTS} at most")));
    }
    at.iter().try_fold(question, |question, address| question.with_address(address.trim())).map(Asked::Case)
}

fn numbers(points: &[Vec<String>]) -> Result<Vec<Vec<Rational>>, Problem> {
    let number = |text: &String| {
        parse_rational(text.trim()).map_err(|e| {
            Problem::new("secant::studio::number", format!("`{}` is no exact number: {e}", clipped(text)))
                .with_help("write 3, -1/2 or 0.25")
        })
    };
    points.iter().map(|p| p.iter().map(number).collect()).collect()
}

/// The first letters of what was sent.
fn clipped(text: &str) -> String {
    text.chars().take(24).collect()
}

/// A polygon for a curve in barycentric space.
fn suggested(question: &Question) -> Option<Vec<Vec<Rational>>> {
    let Question::Tangents { case, .. } = question else { return None };
    let shape = &case.shape;
    let free = shape.control.is_none() && shape.frame == Frame::Barycentric && question.subject() == Subject::Curve;
    let one = shape.states[shape.start].dim;
    if !free || one < 2 {
        return None;
    }
    // A curve of a mask has several spans, so that joints of them are seen too.
    let spans = matches!(case.scheme, Some(Origin::Mask(_) | Origin::Filter(..))) && one <= SMALL;
    let count = if spans { one + MORE } else { one };
    let height = |k: usize| match k {
        0 => 0,
        k if k + 1 == count => 0,
        k if k % 2 == 1 => 2,
        _ => 1,
    };
    Some((0..count).map(|k| vec![Rational::from(k), Rational::from(height(k))]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(json: serde_json::Value) -> Result<Asked, Problem> {
        serde_json::from_value::<Input>(json).expect("an input").asked()
    }

    fn control(asked: &Asked) -> Option<usize> {
        let Asked::Case(Question::Tangents { case, .. }) = asked else { panic!("a case") };
        case.shape.control.as_ref().map(crate::linalg::Matrix::cols)
    }

    #[test]
    fn control_points_are_as_written_suggested_none_or_given() {
        let scheme = |control: serde_json::Value| {
            asked(
                serde_json::json!({"kind": "scheme", "name": "bspline", "parameters": {"degree": "2"}, "control": control}),
            )
        };
        assert_eq!(scheme("as-written".into()).map(|a| control(&a)).ok(), Some(None));
        assert_eq!(scheme("suggested".into()).map(|a| control(&a)).ok(), Some(Some(3 + MORE)));
        let points = serde_json::json!({"points": [["0", "0"], ["1/3", "0.5"], ["2", "0"]]});
        assert_eq!(scheme(points).map(|a| control(&a)).ok(), Some(Some(3)));
        let broken = serde_json::json!({"points": [["0", "zero"]]});
        assert_eq!(scheme(broken).err().map(|p| p.id().to_owned()).as_deref(), Some("secant::studio::number"));
        let text =
            "name = \"a\"\ncontrol = [[0, 0], [1, 1], [2, 0]]\n[scheme]\nmask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\n";
        let text = asked(serde_json::json!({"kind": "text", "text": text, "control": "none"}));
        assert_eq!(text.map(|a| control(&a)).ok(), Some(None));
    }

    #[test]
    fn what_looks_like_a_file_is_not_read() {
        for text in ["cases/thesis/half-tangent.toml", "Cargo.toml", "-", "/etc/passwd", "../secret.toml"] {
            let asked = asked(serde_json::json!({"kind": "text", "text": text}));
            assert!(asked.is_err(), "{text}");
        }
    }

    #[test]
    fn every_scheme_can_be_asked_about() {
        for info in crate::scheme::list() {
            let missing = info.parameters.iter().filter(|p| p.default.is_none());
            let parameters: BTreeMap<&str, &str> = missing.map(|p| (p.name, "1/4")).collect();
            for control in ["as-written", "suggested"] {
                let input = serde_json::json!({"kind": "scheme", "name": info.name, "parameters": parameters, "control": control});
                asked(input).unwrap_or_else(|p| panic!("{}: {}", info.name, p.message()));
            }
        }
    }
}
