//! `[parameters]`: numbers that a case leaves to whoever asks.
//!
//! A parameter has a range (`w = "-1/2..1/2"`) or a value. Lists of numbers, and the keys of `[scheme]` and `[vertex]` that are
//! numbers, may be expressions in parameters. With a value for each of them the case is one case, written out; with one of them
//! left free a mask is a family.

use super::free::one_free;
use super::node::{File, Node, Table, clipped};
use super::scheme::refused;
use crate::algebraic::field::polynomial;
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::{Problem, SourceText};
use crate::poly::Poly;
use crate::scheme;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A mask with one parameter that is left free.
#[derive(Debug, Clone)]
pub struct MaskFamilyCase {
    /// The name of the case.
    pub name: String,
    /// The parameter.
    pub parameter: String,
    /// Its range, with the ends.
    pub range: (Rational, Rational),
    /// The arity.
    pub arity: usize,
    /// The coefficients, polynomials in the parameter.
    pub mask: Vec<Poly>,
}

/// What a parameter is set to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Setting {
    /// A number.
    Value(Rational),
    /// A range with its ends, left free.
    Range(Rational, Rational),
}

/// Reads `w=1/16` or `w=-1/2..1/2`.
///
/// # Errors
/// A [`Problem`] where it is neither.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, case::{Setting, setting}};
/// assert_eq!(setting("w=1/16")?, ("w".to_owned(), Setting::Value(ratio(1, 16))));
/// assert_eq!(setting("w = -1/2 .. 0.5")?.1, Setting::Range(ratio(-1, 2), ratio(1, 2)));
/// assert!(setting("w=1/2..0").is_err() && setting("w").is_err());
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn setting(text: &str) -> Result<(String, Setting), Problem> {
    let problem = |message: String| {
        Problem::new("secant::usage::parameter", message)
            .with_help("write NAME=VALUE, as in w=1/16, or NAME=FROM..TO, as in w=-1/2..1/2")
    };
    let (name, value) = text.split_once('=').ok_or_else(|| problem(format!("`{}` sets nothing", clipped(text))))?;
    let name = name.trim();
    if !is_name(name) {
        return Err(problem(format!("`{}` is not the name of a parameter", clipped(name))));
    }
    let value = value_of(value).map_err(|e| problem(format!("`{name}` cannot be set: {e}")))?;
    Ok((name.to_owned(), value))
}

fn is_name(name: &str) -> bool {
    name.chars().next().is_some_and(char::is_alphabetic)
        && name.chars().count() <= 40
        && name.chars().all(|c| c.is_alphanumeric() || c == '_')
}

fn value_of(text: &str) -> Result<Setting, String> {
    let number = |t: &str| parse_rational(t.trim()).map_err(|e| e.to_string());
    match text.split_once("..") {
        None => number(text).map(Setting::Value),
        Some((from, to)) => {
            let (from, to) = (number(from)?, number(to)?);
            if from < to {
                Ok(Setting::Range(from, to))
            } else {
                Err(format!("the range from {from} to {to} is empty"))
            }
        }
    }
}

/// Words in formulas of weights at vertices: the valence, the sector, a constant, and a function.
pub(super) const FORMULA_WORDS: [&str; 4] = ["n", "k", "pi", "cos"];
/// Variables of symbols.
const SYMBOL_LETTERS: [&str; 3] = ["x", "y", "z"];

/// The parameters of a case with what is set instead, in the order of the file.
pub(super) fn parameters(case: &Table<'_>, set: &[(String, Setting)]) -> Result<Vec<(String, Setting)>, Problem> {
    let Some(node) = case.get("parameters") else { return unknown(case, set, Vec::new()) };
    let table = node.table()?;
    let symbol = |key: &str| case.get(key).and_then(|n| n.table().ok()).is_some_and(|t| t.get("symbol").is_some());
    let letters = match case.get("vertex") {
        Some(_) => FORMULA_WORDS.as_slice(),
        None if symbol("scheme") || symbol("mask") => &SYMBOL_LETTERS,
        None => &[],
    };
    let mut all = Vec::new();
    for key in table.keys() {
        let Some(node) = table.get(&key) else { continue };
        if letters.contains(&key.as_str()) {
            return Err(node
                .problem(
                    "parameter",
                    format!("`{key}` has a meaning of its own in formulas of weights and in symbols"),
                    "this name",
                )
                .with_help("give the parameter another name"));
        }
        if !is_name(&key) {
            return Err(node
                .problem("parameter", format!("`{}` is not the name of a parameter", clipped(&key)), "this name")
                .with_help("a name begins with a letter and goes on with letters, digits and `_`"));
        }
        let own = match node.text() {
            Ok(text) => value_of(text).map_err(|e| {
                node.problem("parameter", format!("`{key}` is neither a number nor a range: {e}"), "this value")
                    .with_help("write a range such as \"-1/2..1/2\", or a number such as \"1/16\"")
            })?,
            Err(_) => Setting::Value(node.number()?),
        };
        all.push((key, own));
    }
    unknown(case, set, all)
}

/// A parameter that is given two values.
pub(super) fn twice(name: &str) -> Problem {
    Problem::new("secant::usage::parameter", format!("`{}` is given twice", clipped(name)))
        .with_help("give each parameter one value")
}

fn unknown(
    case: &Table<'_>,
    set: &[(String, Setting)],
    mut all: Vec<(String, Setting)>,
) -> Result<Vec<(String, Setting)>, Problem> {
    for (k, (name, setting)) in set.iter().enumerate() {
        if set[..k].iter().any(|(earlier, _)| earlier == name) {
            return Err(twice(name));
        }
        match all.iter_mut().find(|(own, _)| own == name) {
            Some((_, own)) => own.clone_from(setting),
            None => {
                let known: Vec<&str> = all.iter().map(|(n, _)| n.as_str()).collect();
                let known = if known.is_empty() { "it has none".to_owned() } else { known.join(", ") };
                return Err(case
                    .problem("parameter", format!("the case has no parameter `{}`", clipped(name)), "this case")
                    .with_help(format!("its parameters stand under [parameters]: {known}")));
            }
        }
    }
    Ok(all)
}

/// A file with settings behind it, as in `six-point.toml t=1/50`; `None` of anything else.
///
/// # Errors
/// A [`Problem`] where a setting cannot be read.
pub(super) fn with_settings(text: &str) -> Result<Option<(PathBuf, Vec<(String, Setting)>)>, Problem> {
    for (at, _) in text.match_indices(char::is_whitespace) {
        let (path, rest) = (Path::new(&text[..at]), text[at..].split_whitespace());
        if path.is_file() && rest.clone().count() > 0 && rest.clone().all(|word| word.contains('=')) {
            return Ok(Some((path.to_owned(), rest.map(setting).collect::<Result<_, _>>()?)));
        }
    }
    Ok(None)
}

impl MaskFamilyCase {
    /// Reads a case whose mask depends on a parameter; what is set stands instead of what the file says.
    ///
    /// # Errors
    /// A [`Problem`] where the case has no mask, or not exactly one parameter that is left free.
    pub fn read(path: &Path, set: &[(String, Setting)]) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        Self::parse(&source.name, &source.text, set)
    }

    /// As [`MaskFamilyCase::read`] for the text of a case.
    ///
    /// # Errors
    /// As [`MaskFamilyCase::read`].
    ///
    /// # Examples
    /// ```
    /// use secant::case::MaskFamilyCase;
    /// let text = "name = \"a\"\n[parameters]\nw = \"0..1\"\n[scheme]\nname = \"four-point\"\nw = \"w/4\"\n";
    /// let case = MaskFamilyCase::parse("a.toml", text, &[])?;
    /// assert_eq!(case.mask[0].display("w"), "-1/4w");
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(name: &str, text: &str, set: &[(String, Setting)]) -> Result<Self, Problem> {
        super::read::parsed(name, text, File::new, |_, case| Self::of_table(case, set))
    }

    fn of_table(case: &Table<'_>, set: &[(String, Setting)]) -> Result<Self, Problem> {
        let name = super::read::name(case)?;
        let free = one_free(case, set)?;
        if let Some(span) = case.key_span("interpolate") {
            let message = "regions are found of masks, of curves by maps or operators, and of weights at vertices";
            return Err(case
                .file
                .problem("parameters", message, span, "not of data that are interpolated")
                .with_help("give the parameter a value behind the case, as in `secant certify CASE w=1/16`"));
        }
        let node = case.need("scheme", "{ mask = [ … ] }")?;
        let mut table = node.table()?;
        table.what = "`[scheme]`".to_owned();
        let (arity, mask) = coefficients(&table, &free.names)?;
        Ok(Self { name, parameter: free.parameter, range: free.range, arity, mask })
    }

    /// The family in its plain form, which a checker reads.
    #[must_use]
    pub fn plain(&self) -> String {
        let list = |f: &Poly| {
            let numbers: Vec<String> = f.coeffs().iter().map(|c| format!("\"{c}\"")).collect();
            format!("[{}]", numbers.join(", "))
        };
        let mask: Vec<String> = self.mask.iter().map(|f| format!("    {},\n", list(f))).collect();
        let (from, to) = &self.range;
        format!(
            "# Coefficients of a mask by powers of the parameter, the lowest first.\nname = \"{}\"\nparameter = \"{}\"\n\
             range = [\"{from}\", \"{to}\"]\narity = {}\nmask = [\n{}]\n",
            self.name,
            self.parameter,
            self.arity,
            mask.concat()
        )
    }
}

/// The arity and the coefficients of `[scheme]`: a mask, or a name with a mask.
fn coefficients(table: &Table<'_>, names: &BTreeMap<String, Poly>) -> Result<(usize, Vec<Poly>), Problem> {
    if let Some(node) = table.get("mask") {
        table.only(&["mask", "arity"])?;
        let arity = table.get("arity").map_or(Ok(2), |n| n.index(scheme::MAX_ARITY))?;
        let entries = node.array(|k| format!("coefficient {k} of `mask`"))?;
        return Ok((arity, entries.iter().map(|n| n.polynomial(names)).collect::<Result<_, _>>()?));
    }
    if let Some(node) = table.get("symbol") {
        return Err(node
            .problem("scheme", "regions are found of masks that are written as a list", "a symbol")
            .with_help("write its coefficients, as in mask = [\"-w\", …]; single values can be asked: `secant certify CASE w=1/16`"));
    }
    let node = table.need("name", "\"four-point\"")?;
    let name = node.text()?;
    let known: Vec<&str> = scheme::list().iter().map(|s| s.name).collect();
    let keys: Vec<String> = table.keys().into_iter().filter(|k| k != "name").collect();
    let [key] = keys.as_slice() else {
        return Err(node
            .problem(
                "scheme-parameter",
                format!("`{}` needs one parameter that is an expression", clipped(name)),
                "this scheme",
            )
            .with_help("add a line such as  w = \"w\"  to [scheme], or write the mask as a list"));
    };
    let value = table.need(key, "\"w\"")?.polynomial(names)?;
    let found = scheme::mask_family(name, key, &value).map_err(|e| refused(table, &node, &e, &known))?;
    found.ok_or_else(|| {
        node.problem("scheme", format!("`{}` has no mask with a parameter", clipped(name)), "this scheme").with_help(
            "regions are found for four-point, ternary-four-point, ternary-three-point, and masks written as a list",
        )
    })
}

impl Node<'_> {
    /// A number, or an expression in the names.
    pub(super) fn polynomial(&self, names: &BTreeMap<String, Poly>) -> Result<Poly, Problem> {
        let text = match self.text() {
            Ok(text) if parse_rational(text).is_err() => text,
            _ => return Ok(Poly::constant(self.number()?)),
        };
        polynomial(text, names).map_err(|e| {
            let column = text[..e.at.min(text.len())].chars().count() + 1;
            let message = format!("{} cannot be read: {e} (character {column} of it)", self.what);
            let help = e.help.unwrap_or_else(|| "see docs/case-format.md for what is read".to_owned());
            self.problem("number", message, "not an expression").with_help(help)
        })
    }
}

/// The case text of a named scheme with settings, as in `four-point w=-1/2..1/2`.
///
/// # Errors
/// A [`Problem`] where nothing is left free.
pub fn named_family(name: &str, set: &[(String, Setting)]) -> Result<MaskFamilyCase, Problem> {
    let quoted = |s: &str| serde_json::Value::from(s).to_string();
    let mut text = format!("name = {}\n\n[parameters]\n", quoted(name));
    for (key, setting) in set {
        let value = match setting {
            Setting::Value(q) => q.to_string(),
            Setting::Range(from, to) => format!("{from}..{to}"),
        };
        text.push_str(&format!("{key} = \"{value}\"\n"));
    }
    text.push_str(&format!("\n[scheme]\nname = {}\n", quoted(name)));
    for (key, _) in set {
        text.push_str(&format!("{key} = {}\n", quoted(key)));
    }
    MaskFamilyCase::parse(name, &text, &[])
}
