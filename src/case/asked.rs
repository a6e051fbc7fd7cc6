//! What somebody writes instead of a file: the name of a scheme, a mask, a symbol, a wavelet, the matrices of the pieces.

use super::member::member_text;
use super::node::clipped;
use super::parameters::{twice, with_settings};
use super::{Case, Question, VertexCase};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::{Problem, SourceText};
use crate::scheme;
use std::path::Path;

/// Other names, each with what it stands for: a scheme, with parameters.
const ALIASES: [(&str, &str); 7] = [
    ("chaikin", "bspline degree=2"),
    ("lane-riesenfeld", "bspline"),
    ("4-point", "four-point"),
    ("6-point", "dubuc-deslauriers points=6"),
    ("six-point", "dubuc-deslauriers points=6"),
    ("cantor", "okamoto a=1/2"),
    ("heighway", "dragon"),
];

/// The same with a scheme's own name and its parameters where it begins with another name of it, such as `chaikin`.
#[must_use]
pub fn unaliased(text: &str) -> Option<String> {
    let (first, rest) = text.trim().split_once(char::is_whitespace).unwrap_or((text.trim(), ""));
    let (_, own) = ALIASES.iter().find(|(alias, _)| *alias == first.to_lowercase())?;
    Some(format!("{own} {rest}").trim_end().to_owned())
}

/// A string of TOML.
fn quoted(part: &str) -> String {
    serde_json::Value::from(part.trim()).to_string()
}

fn case(name: &str, title: &str, body: &str) -> String {
    format!("name = {}\ntitle = {}\n{body}\n", quoted(name), quoted(title))
}

/// What stands between the brackets around a whole text.
fn enclosed(text: &str) -> Option<&str> {
    let mut depth = 0_i64;
    let closes = text.char_indices().find(|(_, c)| {
        depth += match c {
            '[' | '(' => 1,
            ']' | ')' => -1,
            _ => 0,
        };
        depth <= 0
    });
    closes.filter(|(at, _)| *at > 0 && at + 1 == text.len()).map(|(at, _)| &text[1..at])
}

/// The coefficients of a list: separated by commas, or by blanks as NumPy prints them.
fn coefficients(text: &str) -> Option<Vec<&str>> {
    let mut inner = text.trim();
    while let Some(within) = enclosed(inner) {
        inner = within.trim();
    }
    let parts: Vec<&str> = if inner.contains(',') {
        inner.split(',').map(str::trim).filter(|w| !w.is_empty()).collect()
    } else {
        inner.split_whitespace().collect()
    };
    (parts.len() >= 2).then_some(parts)
}

/// The text of the case that something stands for; `None` for anything else.
pub(super) fn text_of(text: &str) -> Option<Result<String, Problem>> {
    let own = unaliased(text);
    let text = own.as_deref().unwrap_or(text);
    let mut words = text.split_whitespace();
    let first = words.next()?;
    if scheme::list().iter().any(|s| s.name == first) {
        let mut lines = vec![format!("name = {}", quoted(first))];
        for word in words {
            let Some((key, value)) = word.split_once('=') else {
                let problem =
                    Problem::new("secant::usage::parameter", format!("`{word}` is not of the form name=value"));
                return Some(Err(problem.with_help(format!("parameters follow the name, as in `{first} w=1/16`"))));
            };
            let line = format!("{} = ", quoted(key));
            if lines.iter().any(|l| l.starts_with(&line)) {
                return Some(Err(twice(key)));
            }
            lines.push(line + &quoted(value));
        }
        return Some(Ok(case(first, text, &format!("\n[scheme]\n{}", lines.join("\n")))));
    }
    if let Some(mask) = scheme::wavelet_mask(text) {
        let list: Vec<String> = mask.iter().map(|c| quoted(c)).collect();
        return Some(Ok(case(text, text, &format!("\n[scheme]\nmask = [{}]", list.join(", ")))));
    }
    if let Some((scheme::Family::Daubechies, moments @ 4..)) = scheme::Family::named(text) {
        let message = format!("the filter of db{moments} lies in no field that is small enough here");
        let help = "`secant regularity` bounds its smoothness; db2 and db3 are curves over number fields";
        return Some(Err(Problem::new("secant::usage::wavelet", message).with_help(help)));
    }
    if text.trim_start().starts_with("[[[") {
        return Some(pieces(text));
    }
    if scheme::Terms::is_meant(text) {
        return Some(Ok(case("mask", text, &format!("\n[mask]\nsymbol = {}", quoted(text)))));
    }
    if text.contains('z') && text.contains(['(', '^', '+']) {
        return Some(Ok(case("symbol", text, &format!("\n[scheme]\nsymbol = {}", quoted(text)))));
    }
    let parts = coefficients(text)?;
    let numbers = parts.iter().any(|w| parse_rational(&w.replace("//", "/")).is_ok() || w.contains("sqrt("));
    let list: Vec<String> = parts.iter().map(|w| quoted(&w.replace("//", "/"))).collect();
    numbers.then(|| Ok(case("mask", text, &format!("\n[scheme]\nmask = [{}]", list.join(", ")))))
}

/// A list of matrices: operators on columns where columns add up to 1, otherwise subdivision matrices on rows.
fn pieces(text: &str) -> Result<String, Problem> {
    let wrong = |message: String| {
        Problem::new("secant::usage::pieces", message)
            .with_help("write the matrices of the pieces as in [[[1, 1/2], [0, 1/2]], [[1/2, 0], [1/2, 1]]]")
    };
    let (mut quoted_entries, mut entry, mut columns, mut matrix) = (String::new(), String::new(), true, Vec::new());
    let (mut row, mut depth): (Vec<Rational>, usize) = (Vec::new(), 0);
    for c in text.chars() {
        if matches!(c, ',' | ']') && !entry.trim().is_empty() {
            let value = parse_rational(&entry.trim().replace("//", "/")).map_err(|e| wrong(e.to_string()))?;
            quoted_entries.push_str(&quoted(&value.to_string()));
            row.push(value);
        }
        match c {
            '[' => depth += 1,
            ']' => {
                depth =
                    depth.checked_sub(1).ok_or_else(|| wrong("a bracket is closed that was not opened".to_owned()))?;
                if depth == 2 {
                    matrix.push(std::mem::take(&mut row));
                } else if depth == 1 {
                    columns &= sums_to_one(&std::mem::take(&mut matrix));
                }
            }
            _ => {}
        }
        match c {
            ',' | '[' | ']' => {
                quoted_entries.push(c);
                entry.clear();
            }
            '"' => {}
            other => entry.push(other),
        }
    }
    if depth != 0 {
        return Err(wrong("a bracket is not closed".to_owned()));
    }
    let convention = if columns { "columns" } else { "rows" };
    Ok(case("pieces", "pieces", &format!("convention = {}\npieces = {quoted_entries}", quoted(convention))))
}

fn sums_to_one(rows: &[Vec<Rational>]) -> bool {
    let width = rows.first().map_or(0, Vec::len);
    (0..width).all(|j| rows.iter().filter_map(|r| r.get(j)).fold(Rational::from(0), |s, x| s + x) == 1)
}

/// The text of the case that somebody means: that of a file; of a file with values of its parameters behind it (`six-point.toml
/// t=1/50`) the member; from the standard input (`-`) a case, or what stands for one, in a
/// line; what is written instead of a file becomes a case.
///
/// # Errors
/// A [`Problem`] where a file cannot be read, or a text is none of these, with what is near.
pub fn asked(text: &str) -> Result<SourceText, Problem> {
    if let Some((path, set)) = with_settings(text)? {
        let source = SourceText::read(&path)?;
        let member = member_text(&source.name, &source.text, &set)?;
        return Ok(member.map_or(source.clone(), |text| SourceText::new(&source.name, text)));
    }
    let path = Path::new(text);
    if text == "-" {
        let source = SourceText::read(path)?;
        let line = Some(source.text.trim()).filter(|line| !is_case(line) && !line.contains('\n'));
        return match line.and_then(text_of) {
            Some(case) => Ok(SourceText::new(&source.name, case?)),
            None => Ok(source),
        };
    }
    if path.exists() || path.extension().is_some_and(|e| e == "toml") {
        return SourceText::read(path);
    }
    match text_of(text) {
        Some(case) => Ok(SourceText::new(text, case?)),
        None => Err(nothing(text)),
    }
}

/// The text of the case that a text is or stands for, where no file can be meant: none is read.
///
/// # Errors
/// A [`Problem`] where the text is no case and stands for none, with what is near.
pub fn written(text: &str) -> Result<String, Problem> {
    if text.contains('=') && text.trim().contains('\n') {
        return Ok(text.to_owned());
    }
    text_of(text.trim()).unwrap_or_else(|| if is_case(text) { Ok(text.to_owned()) } else { Err(nothing(text.trim())) })
}

/// Whether a text is meant to be a case.
#[must_use]
pub fn is_case(text: &str) -> bool {
    text.contains("name") && text.contains('=')
}

impl Question {
    /// The question of what somebody writes: a file or `-`, the name of a scheme with parameters, a wavelet, a mask, a symbol,
    /// or the matrices of the pieces.
    ///
    /// # Errors
    /// As [`Question::read`]; what is none of these is told so, with what is near.
    ///
    /// # Examples
    /// ```
    /// use secant::case::{Question, Subject};
    /// for text in ["four-point w=1/16", "1/4,3/4,3/4,1/4", "[0.25 0.75 0.75 0.25]", "(1+z)^3/4", "bior2.2",
    ///     "[[[1, 1/2], [0, 1/2]], [[1/2, 0], [1/2, 1]]]", "cases/thesis/half-tangent.toml"] {
    ///     assert_eq!(Question::ask(text)?.subject(), Subject::Curve, "{text}");
    /// }
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn ask(text: &str) -> Result<Self, Problem> {
        let source = asked(text)?;
        Self::parse(&source.name, &source.text)
    }
}

impl Case {
    /// The case of what somebody writes, as [`Question::ask`].
    ///
    /// # Errors
    /// As [`Case::read`]; what is none of these is told so.
    pub fn ask(text: &str) -> Result<Self, Problem> {
        let source = asked(text)?;
        Self::parse(&source.name, &source.text)
    }
}

impl VertexCase {
    /// Whether a name is that of a mesh rule.
    fn is_rule(name: &str) -> bool {
        scheme::mesh_rules().iter().any(|r| r.name == name)
    }
}

/// What a text might have been.
#[must_use]
pub fn nothing(text: &str) -> Problem {
    let name = text.split_whitespace().next().unwrap_or_default();
    let shown = clipped(text);
    if VertexCase::is_rule(name) {
        return Problem::new("secant::usage::mesh", format!("`{shown}` is a mesh rule, no curve")).with_help(format!(
            "write a file with  name = \"{name}\"  and  [vertex]  mesh = \"{name}\"  valence = \"3..12\", and certify that"
        ));
    }
    if text.ends_with(['/', '\\']) || text.contains(['/', '\\']) && !text.contains(',') {
        return Problem::new("secant::case::unreadable", format!("{shown} cannot be read: there is no such file"))
            .with_help("give the path of a case file, or `-` for the standard input");
    }
    let problem = Problem::new(
        "secant::case::unreadable",
        format!("`{shown}` is no file, no scheme and no wavelet that is known"),
    );
    let small = name.to_lowercase();
    let filter = ["sym", "coif", "bior", "rbio", "dmey"].iter().any(|family| small.starts_with(family));
    let help = match near(name) {
        _ if scheme::Family::named(&small).is_some_and(|(_, n)| (2..=20).contains(&n)) => {
            format!("the coefficients of {small} are irrational: `secant regularity {small}` bounds its smoothness")
        }
        _ if filter => format!(
            "the filter {small} is not known by name: `secant regularity` takes its coefficients, also in decimals, as in \
             \"-0.0757657, -0.0296355, 0.4976187, …\""
        ),
        Some(other) => format!("did you mean `{other}`?"),
        None => "name a case file, a scheme of `secant schemes` with its parameters, a wavelet such as bior2.2, or write a mask as in \
              \"1/4,3/4,3/4,1/4\" or a symbol as in \"(1+z)^3/4\""
            .to_owned(),
    };
    problem.with_help(help)
}

/// A scheme or wavelet whose name is near.
fn near(name: &str) -> Option<String> {
    let known = scheme::list().iter().map(|s| s.name.to_owned()).chain(scheme::wavelet_names());
    let scored = known.map(|k| (strsim::jaro_winkler(&clipped(name).to_lowercase(), &k), k));
    scored.filter(|(score, _)| *score > 0.85).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, k)| k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_suggested_and_nothing_else() {
        let help = |text: &str| nothing(text).remedy().unwrap_or_default().to_owned();
        assert_eq!(help("four-pont"), "did you mean `four-point`?");
        assert!(help("db2").contains("secant regularity db2") && help("sym5").contains("coefficients"));
        assert!(help("nope").starts_with("name a case file"), "{}", help("nope"));
        assert!(nothing("some/where.txt").message().contains("no such file"));
        assert!(nothing("catmull-clark").message().contains("mesh rule"));
    }

    #[test]
    fn other_names_of_a_scheme_are_known() {
        for (alias, own) in ALIASES {
            let [a, b] = [alias, own].map(|text| Case::ask(text).expect("a curve").shape);
            let ops = |s: &crate::shape::Shape| s.states[0].pieces.iter().map(|p| p.op.clone()).collect::<Vec<_>>();
            assert_eq!(ops(&a), ops(&b), "{alias}");
        }
        assert_eq!(Case::ask("Lane-Riesenfeld degree=4").expect("a curve").shape.states[0].dim, 5);
        // Cantor's staircase stands still on its middle third.
        let cantor = Case::ask("cantor").expect("a curve").shape;
        assert_eq!(crate::linalg::char_poly(&cantor.states[0].pieces[1].op).coeff(0), 0);
    }

    #[test]
    fn matrices_of_pieces_tell_their_convention() {
        let convention = |text: &str| Case::ask(text).map(|c| c.convention.name()).map_err(|p| p.message().to_owned());
        assert_eq!(convention("[[[1, 1/2], [0, 1/2]], [[1/2, 0], [1/2, 1]]]"), Ok("columns"));
        assert_eq!(convention("[[[1, 0], [1/2, 1/2]], [[1/2, 1/2], [0, 1]]]"), Ok("rows"));
        assert!(convention("[[[1, 0], [1/2, 1/2]]").is_err() && convention("[[[1, x]]]").is_err());
    }
}
