//! TOML files: cases, whose numbers are decimals and fractions.

use super::number::decimal_fraction;
use super::{Checked, Json, Matrix, Node, Q, Rejected, Whole, bits, spend};
use toml::de::{DeTable, DeValue};

/// The rule about the numbers that a certificate lists for the roots and cosines of a case.
pub const NUMBERS: &str = "numbers";

/// Most coordinates of a state.
pub const MAX_COORDINATES: usize = 96;

/// A value of a TOML file: numbers keep the text in which they are written.
fn tree(value: &DeValue<'_>) -> Json {
    match value {
        DeValue::String(text) => Json::Text(text.to_string()),
        DeValue::Integer(digits) if digits.radix() == 10 => Json::Number(digits.as_str().to_owned()),
        // Counts may be written in another system; numbers are not.
        DeValue::Integer(digits) => match u64::from_str_radix(digits.as_str(), digits.radix()) {
            Ok(k) => Json::Index(k),
            Err(_) => Json::Null,
        },
        DeValue::Float(digits) => Json::Number(digits.as_str().to_owned()),
        DeValue::Boolean(flag) => Json::Flag(*flag),
        DeValue::Array(items) => Json::List(items.iter().map(|v| tree(v.get_ref())).collect()),
        DeValue::Table(table) => fields(table),
        _ => Json::Null,
    }
}

fn fields(table: &DeTable<'_>) -> Json {
    Json::Object(table.iter().map(|(k, v)| (k.get_ref().to_string(), tree(v.get_ref()))).collect())
}

/// Reads a TOML file with these keys at its top by a function; what is wrong makes the file unreadable.
pub fn file<T>(source: &str, keys: &str, read: impl FnOnce(&Node<'_>) -> Checked<T>) -> Checked<T> {
    let unreadable = |place: String, why: String| Rejected { rule: "case".to_owned(), place, why, unreadable: true };
    let parsed = DeTable::parse(source).map_err(|e| unreadable(String::new(), format!("not TOML: {}", e.message())))?;
    let value = fields(parsed.get_ref());
    let node = Node { value: &value, place: "case".to_owned() };
    // What a certificate does not say of the numbers of a case is no mistake of the case.
    let named = |r: Rejected| if r.rule == NUMBERS { r } else { unreadable(r.place, r.why) };
    node.known(keys).and_then(|()| read(&node)).map_err(named)
}

/// A whole number of a TOML file below a bound.
pub fn index(node: &Node<'_>, bound: usize) -> Checked<usize> {
    let digits = match node.value {
        Json::Number(digits) => digits.parse().ok(),
        Json::Index(k) => usize::try_from(*k).ok(),
        _ => None,
    };
    node.some(digits.filter(|k| *k < bound), "format", format_args!("a whole number below {bound} is needed here"))
}

/// Whether a key is set to true.
pub fn flag(node: &Node<'_>, key: &str) -> Checked<bool> {
    match node.get(key) {
        None => Ok(false),
        Some(Node { value: Json::Flag(flag), .. }) => Ok(*flag),
        Some(n) => n.reject("format", "true or false is needed here"),
    }
}

/// A text that may be left out.
pub fn word<'a>(node: &Node<'a>, key: &str) -> Checked<Option<&'a str>> {
    node.get(key).map(|n| n.text()).transpose()
}

/// A list that may be left out: its elements.
pub fn items<'a>(node: &Node<'a>, key: &str) -> Checked<Vec<Node<'a>>> {
    match node.get(key) {
        None => Ok(Vec::new()),
        Some(n) => n.list(),
    }
}

/// A number: a text or a number of the file.
pub fn number(node: &Node<'_>) -> Checked<Q> {
    let text = if let Json::Text(text) | Json::Number(text) = node.value { Some(text) } else { None };
    let number = node.some(text.and_then(|t| decimal_fraction(t)), "format", "an exact number is needed here")?;
    spend(40, bits(&number))?;
    Ok(number)
}

/// Reads a matrix of 1 to 96 rows and columns.
pub fn matrix<T: Whole>(node: &Node<'_>, ground: &T::Ground) -> Checked<Matrix<T>> {
    let rows = node.each(|row| row.each(|x| T::given(x, ground)))?;
    node.need(!rows.is_empty(), "case", "a matrix without rows")?;
    let cols = rows[0].len();
    let fits = |n: usize| (1..=MAX_COORDINATES).contains(&n);
    let regular = fits(rows.len()) && fits(cols) && rows.iter().all(|r| r.len() == cols);
    node.need(regular, "case", format_args!("not a matrix of 1 to {MAX_COORDINATES} rows and columns"))?;
    Ok(Matrix::fractions(rows.len(), cols, &rows.concat()))
}
