use super::MAX_BITS;
use crate::algebraic::field::FieldBuilder;
use crate::arith::{ParseNumberError, Rational, parse_rational};
use crate::diagnostic::{Problem, SourceText};
use malachite_base::num::logic::traits::SignificantBits;
use std::cell::Cell;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The file being read, and how many bits of numbers may still come.
pub(super) struct File {
    pub source: SourceText,
    bits: Cell<u64>,
    sample: Option<Sample>,
}

/// A rational number in the place of the generator of a number field: what is linear in the entries holds for them
/// exactly when it holds for enough samples.
pub(super) struct Sample {
    pub builder: FieldBuilder,
    pub at: Rational,
}

impl File {
    pub fn new(source: SourceText) -> Self {
        Self { source, bits: Cell::new(0), sample: None }
    }

    /// The file with a number in the place of the generator.
    pub fn sampled(source: SourceText, sample: Sample) -> Self {
        Self { sample: Some(sample), ..Self::new(source) }
    }

    pub fn is_sampled(&self) -> bool {
        self.sample.is_some()
    }

    pub fn problem(&self, code: &str, message: impl AsRef<str>, span: Range<usize>, note: impl AsRef<str>) -> Problem {
        Problem::new(format!("secant::case::{code}"), message).with_source(&self.source).with_label(span, note)
    }
}

/// A value of the file; `what` names it in messages.
#[derive(Clone)]
pub(super) struct Node<'a> {
    pub file: &'a File,
    pub what: String,
    value: &'a Spanned<DeValue<'a>>,
}

/// A table of the file.
pub(super) struct Table<'a> {
    pub file: &'a File,
    pub what: String,
    pub span: Range<usize>,
    table: &'a DeTable<'a>,
}

impl<'a> Node<'a> {
    /// The same value under another name.
    pub fn named(&self, what: impl Into<String>) -> Self {
        Self { what: what.into(), ..self.clone() }
    }

    pub fn span(&self) -> Range<usize> {
        self.value.span()
    }

    pub fn problem(&self, code: &str, message: impl AsRef<str>, note: impl AsRef<str>) -> Problem {
        self.file.problem(code, message, self.span(), note)
    }

    fn wrong_type(&self, wanted: &str) -> Problem {
        let found = kind_name(self.value.get_ref());
        self.problem("type", format!("{} must be {wanted}, not {found}", self.what), format!("this is {found}"))
            .with_help(format!("write {wanted} here"))
    }

    pub fn text(&self) -> Result<&'a str, Problem> {
        self.value.get_ref().as_str().ok_or_else(|| self.wrong_type("a string in quotes"))
    }

    /// Whether it is a whole number.
    pub fn is_integer(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Integer(_))
    }

    pub fn boolean(&self) -> Result<bool, Problem> {
        self.value.get_ref().as_bool().ok_or_else(|| self.wrong_type("true or false"))
    }

    pub fn table(&self) -> Result<Table<'a>, Problem> {
        match self.value.get_ref() {
            DeValue::Table(table) => Ok(Table { file: self.file, what: self.what.clone(), span: self.span(), table }),
            _ => Err(self.wrong_type("a table")),
        }
    }

    /// The elements, called `item(0)`, `item(1)`, ….
    pub fn array(&self, item: impl Fn(usize) -> String) -> Result<Vec<Node<'a>>, Problem> {
        let DeValue::Array(array) = self.value.get_ref() else { return Err(self.wrong_type("a list [ … ]")) };
        Ok(array.iter().enumerate().map(|(k, value)| Node { file: self.file, what: item(k), value }).collect())
    }

    /// The tables of `[[key]]`.
    pub fn tables(&self, item: impl Fn(usize) -> String) -> Result<Vec<Table<'a>>, Problem> {
        if matches!(self.value.get_ref(), DeValue::Table(_)) {
            return Err(self
                .problem("type", format!("{} must be a list of tables", self.what), "this is a single table")
                .with_help("use two pairs of brackets, as in [[state]]"));
        }
        self.array(item)?.iter().map(Node::table).collect()
    }

    /// A whole number of at most `max`.
    pub fn index(&self, max: usize) -> Result<usize, Problem> {
        let DeValue::Integer(digits) = self.value.get_ref() else {
            return Err(self.wrong_type("a whole number"));
        };
        match usize::from_str_radix(digits.as_str(), digits.radix()) {
            Ok(k) if k <= max => Ok(k),
            _ => Err(self
                .problem("range", format!("{} must be a whole number from 0 to {max}", self.what), "out of range")
                .with_help("whole numbers are written with digits only")),
        }
    }

    /// Whether it is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Array(_))
    }

    /// Whether this is the word `"?"`, for a whole operator that is unknown.
    pub fn is_question(&self) -> bool {
        self.value.get_ref().as_str() == Some("?")
    }

    /// `"?"` or `"?name"`: an unknown entry with its name; `None` for anything else.
    pub fn unknown(&self) -> Result<Option<Option<String>>, Problem> {
        let Some(name) = self.value.get_ref().as_str().and_then(|text| text.trim().strip_prefix('?')) else {
            return Ok(None);
        };
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
        if name.chars().count() > 40 || !name.chars().all(plain) {
            let message = format!("{} is not the name of an unknown", self.what);
            return Err(self
                .problem("unknown-name", message, "not a name")
                .with_help("an unknown entry is \"?\", or \"?a\" with a name of letters, digits, `_`, `-`, `.`"));
        }
        Ok(Some((!name.is_empty()).then(|| name.to_owned())))
    }

    /// An exact number: an integer, a fraction in quotes, or a decimal (read exactly, from its source text).
    pub fn number(&self) -> Result<Rational, Problem> {
        let text = match self.value.get_ref() {
            DeValue::String(text) => text.as_ref(),
            DeValue::Integer(digits) if digits.radix() == 10 => digits.as_str(),
            DeValue::Integer(_) => return Err(self.not_a_number("numbers are written in the decimal system")),
            DeValue::Float(digits) => digits.as_str(),
            _ => return Err(self.wrong_type("a number such as \"3/4\", -1 or 0.25")),
        };
        let number = parse_rational(text).or_else(|error| self.expression(text, &error))?;
        let bits = number.numerator_ref().significant_bits() + number.denominator_ref().significant_bits();
        let total = self.file.bits.get().saturating_add(bits);
        self.file.bits.set(total);
        if total > MAX_BITS {
            return Err(self
                .problem("limit", "the numbers of this file are too long taken together", "here the limit is passed")
                .with_help(format!("all numbers of a case together may have {MAX_BITS} bits")));
        }
        Ok(number)
    }

    /// A number such as `sqrt(5)`, where those are expected; otherwise a hint.
    fn expression(&self, text: &str, error: &ParseNumberError) -> Result<Rational, Problem> {
        let plain =
            matches!(self.value.get_ref(), DeValue::Float(_)) || !matches!(error, ParseNumberError::Malformed(_));
        if plain || is_infinite(text) {
            return Err(self.number_problem(error));
        }
        let mut builder = self.file.sample.as_ref().map_or_else(FieldBuilder::new, |s| s.builder.clone());
        let value = match builder.parse(text) {
            Ok(value) => value,
            Err(e) if e.code == "name" && !text.contains(['(', '[']) => return Err(self.number_problem(error)),
            Err(e) => {
                let column = text[..e.at.min(text.len())].chars().count() + 1;
                let message = format!("{} cannot be read: {e} (character {column} of it)", self.what);
                let problem = self.problem("number", message, "not a number");
                return Err(problem.with_help(e.help.as_deref().unwrap_or("see docs/case-format.md for what is read")));
            }
        };
        match (&self.file.sample, builder.is_rational(&value)) {
            (_, Some(q)) if self.file.sample.is_some() => Ok(q),
            (Some(sample), _) => Ok(builder.elem(&value).0.eval(&sample.at)),
            (None, Some(q)) => {
                let message = format!("{} is an expression with the rational value {q}", self.what);
                Err(self
                    .problem("expression", message, format!("this is {q}"))
                    .with_help(format!("write \"{q}\" here")))
            }
            (None, None) => {
                let field = builder.field().describe();
                let message = format!("{} is irrational, a number of {field}", self.what);
                Err(self.problem("irrational-entry", message, "an irrational number").with_help(
                    "`secant certify`, `render` and `spectrum` read curves and sets with entries in a real number field; everything \
                     else needs rational numbers",
                ))
            }
        }
    }

    fn not_a_number(&self, help: &str) -> Problem {
        self.problem("number", format!("{} is not an exact number", self.what), "not a number").with_help(help)
    }

    fn number_problem(&self, error: &ParseNumberError) -> Problem {
        match error {
            ParseNumberError::ZeroDenominator(_) => self
                .problem("zero-denominator", format!("{} divides by zero", self.what), "the denominator is 0")
                .with_help("give a fraction whose denominator is not 0"),
            ParseNumberError::TooLong(digits) => self
                .problem(
                    "number-too-long",
                    format!("{} has too many digits", self.what),
                    format!("{digits} characters"),
                )
                .with_help(format!("at most {} digits are read", crate::arith::MAX_DIGITS)),
            ParseNumberError::Exponent(_) => self
                .problem("number-too-long", format!("{} has too large an exponent", self.what), "this exponent")
                .with_help(format!("exponents of ten up to {} are read", crate::arith::MAX_DIGITS)),
            ParseNumberError::Malformed(text) if is_infinite(text) => self
                .not_a_number("infinite values and NaN are no exact numbers; give an integer, a fraction or a decimal"),
            ParseNumberError::Malformed(_) => {
                self.not_a_number("write an integer such as -1, a fraction such as \"3/4\", or a decimal such as 0.25")
            }
        }
    }
}

fn is_infinite(text: &str) -> bool {
    matches!(text.trim_start_matches(['+', '-']).to_ascii_lowercase().as_str(), "inf" | "infinity" | "nan")
}

fn kind_name(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) => "an integer",
        DeValue::Float(_) => "a decimal number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

impl<'a> Table<'a> {
    pub fn root(file: &'a File, table: &'a Spanned<DeTable<'a>>) -> Self {
        Self { file, what: "the case".to_owned(), span: 0..0, table: table.get_ref() }
    }

    pub fn problem(&self, code: &str, message: impl AsRef<str>, note: impl AsRef<str>) -> Problem {
        self.file.problem(code, message, self.span.clone(), note)
    }

    pub fn get(&self, key: &str) -> Option<Node<'a>> {
        let value = self.table.get(key)?;
        Some(Node { file: self.file, what: format!("`{key}`"), value })
    }

    /// Where the key itself stands.
    pub fn key_span(&self, key: &str) -> Option<Range<usize>> {
        self.table.keys().find(|k| k.get_ref() == key).map(Spanned::span)
    }

    /// All keys, in the order of the file.
    pub fn keys(&self) -> Vec<String> {
        self.table.keys().map(|k| k.get_ref().to_string()).collect()
    }

    pub fn need(&self, key: &str, example: &str) -> Result<Node<'a>, Problem> {
        self.get(key).ok_or_else(|| {
            let message = format!("{} needs the key `{key}`", self.what);
            self.problem("missing-key", message, format!("`{key}` is missing"))
                .with_help(format!("add a line such as  {key} = {example}"))
        })
    }

    pub fn text(&self, key: &str, example: &str) -> Result<&'a str, Problem> {
        self.need(key, example)?.text()
    }

    pub fn optional_text(&self, key: &str) -> Result<Option<&'a str>, Problem> {
        self.get(key).map(|node| node.text()).transpose()
    }

    pub fn flag(&self, key: &str) -> Result<bool, Problem> {
        self.get(key).map_or(Ok(false), |node| node.boolean())
    }

    /// One of a few words.
    pub fn word(&self, key: &str, words: &[&'static str]) -> Result<Option<&'static str>, Problem> {
        let Some(node) = self.get(key) else { return Ok(None) };
        let text = node.text()?;
        match words.iter().find(|w| **w == text) {
            Some(word) => Ok(Some(word)),
            None => Err(node
                .problem("value", format!("{} cannot be {text:?}", node.what), "not one of the known words")
                .with_help(suggest(text, words, "it may be"))),
        }
    }

    /// Refuses keys that are not in `known`.
    pub fn only(&self, known: &[&'static str]) -> Result<(), Problem> {
        for key in self.table.keys() {
            let name: &str = key.get_ref();
            if !known.contains(&name) {
                let message = format!("{} has no key `{}`", self.what, clipped(name));
                return Err(self.file.problem("unknown-key", message, key.span(), "unknown key").with_help(suggest(
                    name,
                    known,
                    "known keys are",
                )));
            }
        }
        Ok(())
    }
}

/// The first characters of a text that may be long.
pub(super) fn clipped(text: &str) -> String {
    if text.chars().count() <= 60 { text.to_owned() } else { text.chars().take(57).chain("...".chars()).collect() }
}

/// “did you mean …?” where a word is near, the whole list otherwise.
pub(super) fn suggest(found: &str, known: &[&str], otherwise: &str) -> String {
    let near = known
        .iter()
        .map(|k| (strsim::jaro_winkler(&clipped(found).to_lowercase(), k), *k))
        .filter(|(score, _)| *score > 0.8)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    match near {
        Some((_, word)) => format!("did you mean `{word}`?"),
        None => format!("{otherwise} {}", known.join(", ")),
    }
}
