//! One case of a case with `[parameters]`: with a value for each of them, written out.

use super::MAX_BYTES;
use super::node::{File, Table};
use super::parameters::{Setting, parameters};
use crate::algebraic::field::polynomial;
use crate::arith::parse_rational;
use crate::diagnostic::{Problem, SourceText};
use crate::poly::Poly;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// How the line of a member begins that stands in the place of its parameters.
const MEMBER: &str = "# Member of a family: ";

/// Keys that are words, and those below them.
const WORDS: [&str; 9] = ["name", "mesh", "cell", "normalisation", "valence", "arity", "to", "kind", "layout"];
/// Lists of words.
const LISTS: [&str; 2] = ["chain", "reversed"];

/// What a string of a case is in which numbers may be expressions.
pub(super) enum Expression {
    /// A polynomial in the names.
    Polynomial(Poly),
    /// Something else that holds one of them, such as `b/n` with the valence `n`, or a symbol.
    Formula(String),
}

/// The problem of a case whose `[parameters]` hold none.
pub(super) fn left_free(case: &Table<'_>) -> Option<Problem> {
    let span = case.key_span("parameters")?;
    let problem = case.file.problem("parameters", "[parameters] holds no parameter", span, "nothing is declared");
    Some(problem.with_help("leave it out, or write a line such as  w = \"-1/2..1/2\"  below it"))
}

/// The text of a case as one case: where it has parameters, with their values put in.
///
/// # Errors
/// A [`Problem`] where a parameter has a range and no value.
///
/// # Examples
/// ```
/// let text = "name = \"a\"\nparameters.w = \"1/16\"\n[scheme]\nname = \"four-point\"\nw = \"w\"\n";
/// assert!(secant::case::valued("a.toml", text)?.contains("w = \"1/16\""));
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn valued<'a>(name: &str, text: &'a str) -> Result<Cow<'a, str>, Problem> {
    if text.len() > MAX_BYTES || !text.contains("parameters") {
        return Ok(Cow::Borrowed(text));
    }
    Ok(member_text(name, text, &[])?.map_or(Cow::Borrowed(text), Cow::Owned))
}

/// Whether a text is that of a member, whose file is another one.
pub(super) fn is_member(text: &str) -> bool {
    text.lines().any(|line| line.starts_with(MEMBER))
}

/// The case with a value for every parameter, as text; `None` for a text without `[parameters]`. What is written `w/2 + 1` becomes
/// a number; everything else stays as it is, and in its line.
///
/// # Errors
/// A [`Problem`] where a parameter has a range and no value, where there is no such parameter, or the text is no case.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, case::{Setting, member_text}};
/// let text = "name = \"a\"\n[parameters]\nw = \"0..1\"\n[scheme]\nmask = [\"1/2 - w\", \"1/2\", \"1/2 + w\", \"1/2\"]\n";
/// let set = [("w".to_owned(), Setting::Value(ratio(1, 4)))];
/// let member = member_text("a.toml", text, &set)?.expect("it has a parameter");
/// assert!(member.contains("mask = [\"1/4\", \"1/2\", \"3/4\", \"1/2\"]") && !member.contains("parameters"));
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn member_text(name: &str, text: &str, set: &[(String, Setting)]) -> Result<Option<String>, Problem> {
    let Ok(table) = DeTable::parse(text) else {
        // The reader of cases says what is wrong.
        return Ok(None);
    };
    let file = File::new(SourceText::new(name, text));
    let case = Table::root(&file, &table);
    let all = parameters(&case, set)?;
    if all.is_empty() {
        return Ok(None);
    }
    let mut values = BTreeMap::new();
    for (name, setting) in &all {
        let Setting::Value(value) = setting else {
            let span = case.key_span("parameters").unwrap_or_default();
            return Err(file
                .problem(
                    "parameters",
                    format!("the parameter `{name}` has a range and no value"),
                    span,
                    "declared here",
                )
                .with_help(format!(
                    "give it a value behind the case, as in `CASE {name}=1/16`, or ask `secant region` about its range"
                )));
        };
        values.insert(name.clone(), Poly::constant(value.clone()));
    }
    let said: Vec<String> = all.iter().map(|(name, _)| format!("{name} = {}", values[name].coeff(0))).collect();
    let written = |e: &Expression| match e {
        Expression::Polynomial(f) => f.degree().is_none_or(|d| d == 0).then(|| format!("\"{}\"", f.coeff(0))),
        Expression::Formula(text) => Some(serde_json::Value::from(filled(text, &values)).to_string()),
    };
    let mut edits: Vec<(Range<usize>, String)> =
        expressions(&table, &values).into_iter().filter_map(|(span, e)| Some((span, written(&e)?))).collect();
    // The lines stay where they are, so that a problem is shown at the line of the file.
    let mut line = format!("{MEMBER}{}", said.join(", "));
    edits.extend(lines_of_parameters(&table, text).into_iter().map(|span| (span, std::mem::take(&mut line))));
    edits.sort_by_key(|(span, _)| span.start);
    let mut out = String::new();
    let mut at = 0;
    for (span, new) in edits {
        out.push_str(&text[at..span.start]);
        out.push_str(&new);
        at = span.end;
    }
    out.push_str(&text[at..]);
    Ok(Some(out))
}

/// The lines on which parameters are declared: under a heading, with dots, or in braces.
fn lines_of_parameters(table: &Spanned<DeTable<'_>>, text: &str) -> Vec<Range<usize>> {
    let mut spans = Vec::new();
    for (key, value) in table.get_ref().iter().filter(|(k, _)| k.get_ref() == "parameters") {
        spans.push(key.span());
        spans.extend(Some(value.span()).filter(|s| text[s.clone()].starts_with('{')));
        if let DeValue::Table(inner) = value.get_ref() {
            spans.extend(inner.iter().map(|(k, v)| k.span().start..v.span().end));
        }
    }
    let start_of = |at: usize| text[..at].rfind('\n').map_or(0, |k| k + 1);
    let starts: BTreeSet<usize> = spans
        .iter()
        .flat_map(|s| {
            std::iter::once(start_of(s.start)).chain(text[s.clone()].match_indices('\n').map(|(k, _)| s.start + k + 1))
        })
        .collect();
    starts.into_iter().map(|at| at..text[at..].find('\n').map_or(text.len(), |k| at + k)).collect()
}

/// The identifiers of an expression, where they stand.
fn identifiers(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for (at, c) in text.char_indices() {
        let end = at + c.len_utf8();
        match found.last_mut().filter(|r| r.end == at) {
            Some(open) if c.is_alphanumeric() || c == '_' => open.end = end,
            _ if c.is_alphabetic() => found.push(at..end),
            _ => {}
        }
    }
    found
}

pub(super) fn mentions(text: &str, is_meant: impl Fn(&str) -> bool) -> bool {
    identifiers(text).into_iter().any(|span| is_meant(&text[span]))
}

/// An expression with numbers in brackets in the place of names, and signs of products where none stand, as in `2w z`.
fn filled(text: &str, values: &BTreeMap<String, Poly>) -> String {
    let mut out = String::new();
    let mut at = 0;
    for span in identifiers(text) {
        let Some(value) = values.get(&text[span.clone()]) else { continue };
        out.push_str(&text[at..span.start]);
        let factor = |c: char| c.is_alphanumeric() || matches!(c, '(' | ')');
        if out.trim_end().ends_with(|c: char| factor(c) && c != '(') {
            out.push('*');
        }
        out.push_str(&format!("({})", value.coeff(0)));
        at = span.end;
        if text[at..].trim_start().starts_with(|c: char| factor(c) && c != ')') {
            out.push('*');
        }
    }
    out.push_str(&text[at..]);
    out
}

/// All expressions of a case that hold names, or are numbers: where they stand, and what they are.
pub(super) fn expressions(
    table: &Spanned<DeTable<'_>>,
    values: &BTreeMap<String, Poly>,
) -> Vec<(Range<usize>, Expression)> {
    let mut found = Vec::new();
    for (key, value) in table.get_ref() {
        let key: &str = key.get_ref();
        match key {
            "parameters" | "name" | "title" | "source" | "expect" | "examine" => {}
            "scheme" | "vertex" => collect(value, true, values, &mut found),
            _ => collect(value, false, values, &mut found),
        }
    }
    found
}

/// Every string in a list, and in a table of numbers every string, that is an expression in the names.
fn collect(
    value: &Spanned<DeValue<'_>>,
    direct: bool,
    values: &BTreeMap<String, Poly>,
    found: &mut Vec<(Range<usize>, Expression)>,
) {
    let named = |text: &str| mentions(text, |word| values.contains_key(word));
    match value.get_ref() {
        DeValue::Array(items) => items.iter().for_each(|item| collect(item, true, values, found)),
        DeValue::Table(table) => {
            for (key, value) in table {
                let key: &str = key.get_ref();
                match value.get_ref() {
                    DeValue::String(text) if key == "symbol" => {
                        found.extend(named(text).then(|| (value.span(), Expression::Formula(text.to_string()))));
                    }
                    _ if LISTS.contains(&key) => {}
                    _ => collect(value, direct && !WORDS.contains(&key), values, found),
                }
            }
        }
        DeValue::String(text) if direct && parse_rational(text).is_err() => match polynomial(text, values) {
            Ok(f) => found.push((value.span(), Expression::Polynomial(f))),
            Err(_) if named(text) => found.push((value.span(), Expression::Formula(text.to_string()))),
            Err(_) => {}
        },
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn whole_names_are_filled_in() {
        let values: BTreeMap<String, Poly> =
            [("w", ratio(-1, 16)), ("w2", ratio(3, 1))].map(|(n, x)| (n.to_owned(), Poly::constant(x))).into();
        for (text, expected) in [
            ("w/n", "(-1/16)/n"),
            ("2w z", "2*(-1/16)* z"),
            ("w2*cos(2*pi*k/n)", "(3)*cos(2*pi*k/n)"),
            ("(1+z)w(1-w z)", "(1+z)*(-1/16)*(1-(-1/16)* z)"),
            ("w_ + ww + pi", "w_ + ww + pi"),
        ] {
            assert_eq!(filled(text, &values), expected);
        }
    }

    #[test]
    fn parameters_are_found_however_they_are_declared() {
        let scheme = "[scheme]\nname = \"four-point\"\nw = \"w\"\n";
        for head in [
            "[parameters] # mine\nw = \"1/16\"\n",
            "parameters = { w = \"1/16\" }\n\n",
            "parameters.w = \"1/16\"\n\n",
            "[ \"parameters\" ]\n# note\nw = \"\"\"1/16\"\"\" # [x]\n",
        ] {
            let text = format!("name = \"a\"\n{head}{scheme}");
            let member = member_text("a.toml", &text, &[]).unwrap_or_else(|e| panic!("{e}"));
            let member = member.unwrap_or_else(|| panic!("{head}"));
            assert!(is_member(&member) && member.ends_with(&scheme.replace("\"w\"", "\"1/16\"")), "{member}");
            assert_eq!(member.lines().count(), text.lines().count(), "{member}");
            let read = DeTable::parse(&member).map(|t| t.get_ref().contains_key("parameters"));
            assert_eq!(read.ok(), Some(false), "{member}");
        }
    }
}
