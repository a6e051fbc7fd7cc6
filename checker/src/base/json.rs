//! A strict JSON reader: no floats, no negative integers, no repeated keys, and the fields of every object in their order.

use super::number::canonical;
use super::{Checked, MAX_LETTERS, MAX_PIECES, Matrix, Q, Rejected, Whole, charge, need, reject, some};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt::{Display, Formatter};

/// A JSON value as certificates use it.
#[derive(Debug, Clone)]
pub enum Json {
    /// `null`.
    Null,
    /// A natural number: an index or a count.
    Index(u64),
    /// A string.
    Text(String),
    /// The text of a number of a case file; certificates have none.
    Number(String),
    /// A truth value of a case file.
    Flag(bool),
    /// A list.
    List(Vec<Json>),
    /// An object with its fields in order.
    Object(Vec<(String, Json)>),
}

impl<'de> Deserialize<'de> for Json {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Reader)
    }
}

/// Most fields of an object; none in the format has more.
const MAX_FIELDS: usize = 16;

/// A certificate has at most a million values, as each takes its share of the budget.
fn room<E: Error>() -> Result<(), E> {
    if charge(250, 0) { Ok(()) } else { Err(E::custom("too many values")) }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Json;

    fn expecting(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str("null, a natural number, a string, a list or an object")
    }
    fn visit_unit<E: Error>(self) -> Result<Json, E> {
        Ok(Json::Null)
    }
    fn visit_u64<E: Error>(self, value: u64) -> Result<Json, E> {
        Ok(Json::Index(value))
    }
    fn visit_str<E: Error>(self, value: &str) -> Result<Json, E> {
        Ok(Json::Text(value.to_owned()))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Json, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            room()?;
            list.push(item);
        }
        Ok(Json::List(list))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut items: A) -> Result<Json, A::Error> {
        let mut fields: Vec<(String, Json)> = Vec::new();
        while let Some((key, value)) = items.next_entry::<String, Json>()? {
            room()?;
            if fields.len() == MAX_FIELDS || fields.iter().any(|(k, _)| *k == key) {
                return Err(A::Error::custom(format!("the key `{key}` is repeated, or one too many")));
            }
            fields.push((key, value));
        }
        Ok(Json::Object(fields))
    }
}

/// A value of the certificate with the place where it stands. What a rule demands of it is stated by [`Node::need`],
/// [`Node::some`] and [`Node::reject`]; the readers below demand what the format says (rule `format`).
#[derive(Clone)]
pub struct Node<'a> {
    /// The value.
    pub value: &'a Json,
    /// Its place, such as `points[1].branches[0].cover`.
    pub place: String,
}

impl<'a> Node<'a> {
    /// Gives a rejection that has no place yet this one.
    pub fn at<T>(&self, result: Checked<T>) -> Checked<T> {
        result.map_err(|r| if r.place.is_empty() { Rejected { place: self.place.clone(), ..r } } else { r })
    }

    /// A rejection of this value unless a premise holds.
    pub fn need(&self, holds: bool, rule: &str, why: impl Display) -> Checked<()> {
        self.at(need(holds, rule, why))
    }

    /// What must exist; a rejection of this value if it does not.
    pub fn some<T>(&self, found: Option<T>, rule: &str, why: impl Display) -> Checked<T> {
        self.at(some(found, rule, why))
    }

    /// A rejection of this value.
    pub fn reject<T>(&self, rule: &str, why: impl Display) -> Checked<T> {
        self.at(reject(rule, why))
    }

    /// What the format has here.
    fn form<T>(&self, found: Option<T>, what: &str) -> Checked<T> {
        self.some(found, "format", format_args!("{what} is needed here"))
    }

    /// Demands that this text is the one that follows.
    pub fn follows(&self, rule: &str, word: &str) -> Checked<()> {
        self.need(self.text()? == word, rule, format_args!("what follows is \"{word}\""))
    }

    /// Whether this is `null`.
    pub fn is_null(&self) -> bool {
        matches!(self.value, Json::Null)
    }

    fn object(&self) -> Checked<&'a [(String, Json)]> {
        self.form(if let Json::Object(fields) = self.value { Some(fields.as_slice()) } else { None }, "an object")
    }

    fn child(&self, (name, value): &'a (String, Json)) -> Node<'a> {
        Node { value, place: format!("{}.{name}", self.place) }
    }

    /// The values of an object with exactly these fields (separated by spaces) in this order.
    pub fn fields<const K: usize>(&self, names: &str) -> Checked<[Node<'a>; K]> {
        let fields = self.object()?;
        let same = fields.len() == K && fields.iter().map(|(key, _)| key.as_str()).eq(names.split(' '));
        self.need(same, "format", format_args!("the fields must be exactly `{names}`, in this order"))?;
        Ok(std::array::from_fn(|k| self.child(&fields[k])))
    }

    /// The text of the first field, which must have the given name: the tag that says which fields follow.
    pub fn tag(&self, name: &str) -> Checked<&'a str> {
        match self.object()?.first() {
            Some((key, Json::Text(text))) if key == name => Ok(text),
            _ => self.reject("format", format_args!("the first field must be the text `{name}`")),
        }
    }

    /// The value of a field, where there is one.
    pub fn get(&self, name: &str) -> Option<Node<'a>> {
        self.object().ok()?.iter().find(|(key, _)| key == name).map(|field| self.child(field))
    }

    /// The value of a field.
    pub fn field(&self, name: &str) -> Checked<Node<'a>> {
        self.form(self.get(name), &format!("the field `{name}`"))
    }

    /// Demands an object with no other keys than these (separated by spaces).
    pub fn known(&self, names: &str) -> Checked<()> {
        match self.object()?.iter().find(|(key, _)| names.split_ascii_whitespace().all(|name| name != key)) {
            None => Ok(()),
            Some((key, _)) => self.reject("format", format_args!("unknown key `{key}`")),
        }
    }

    /// The elements of a list.
    pub fn list(&self) -> Checked<Vec<Node<'a>>> {
        let Json::List(items) = self.value else { return self.reject("format", "a list is needed here") };
        let item = |(k, value)| Node { value, place: format!("{}[{k}]", self.place) };
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// The elements of a list of this length.
    pub fn exactly(&self, count: usize, rule: &str) -> Checked<Vec<Node<'a>>> {
        let items = self.list()?;
        self.need(items.len() == count, rule, format_args!("{count} items are needed here"))?;
        Ok(items)
    }

    /// What is read from each element of a list.
    pub fn each<T>(&self, read: impl FnMut(&Node<'a>) -> Checked<T>) -> Checked<Vec<T>> {
        self.list()?.iter().map(read).collect()
    }

    /// A text.
    pub fn text(&self) -> Checked<&'a str> {
        self.form(if let Json::Text(text) = self.value { Some(text.as_str()) } else { None }, "a text")
    }

    /// A natural number below `bound`.
    pub fn index(&self, bound: usize) -> Checked<usize> {
        match self.value {
            Json::Index(k) if usize::try_from(*k).is_ok_and(|k| k < bound) => Ok(*k as usize),
            _ => self.reject("format", format_args!("a natural number below {bound} is needed here")),
        }
    }

    /// A list of natural numbers below `bound`.
    pub fn indices(&self, bound: usize) -> Checked<Vec<usize>> {
        self.each(|item| item.index(bound))
    }

    /// A rational number in its canonical form.
    pub fn rational(&self) -> Checked<Q> {
        self.form(canonical(self.text()?), "a rational number in lowest terms, such as \"-3/4\" or \"2\",")
    }

    /// A list of exactly `count` rational numbers.
    pub fn vector(&self, count: usize) -> Checked<Vec<Q>> {
        self.exactly(count, "format")?.iter().map(Node::rational).collect()
    }

    /// A matrix as a list of its rows, of which each has `cols` entries.
    pub fn matrix(&self, cols: usize) -> Checked<Matrix> {
        Ok(Matrix::from_rows(cols, &self.each(|row| row.vector(cols))?))
    }

    /// A list of exactly `count` numbers of the field of a case, as a column.
    pub fn column<T: Whole>(&self, count: usize, ground: &T::Ground) -> Checked<Matrix<T>> {
        let numbers =
            self.exactly(count, "format")?.iter().map(|n| T::entry(n, ground)).collect::<Checked<Vec<_>>>()?;
        Ok(Matrix::fractions(count, 1, &numbers))
    }

    /// The same for a matrix as a list of its rows, of which each has `cols` entries.
    pub fn entries<T: Whole>(&self, cols: usize, ground: &T::Ground) -> Checked<Matrix<T>> {
        let rows = self.list()?;
        let mut all = Vec::new();
        for row in &rows {
            for number in row.exactly(cols, "format")? {
                all.push(T::entry(&number, ground)?);
            }
        }
        Ok(Matrix::fractions(rows.len(), cols, &all))
    }

    /// A word: a list of at most 1000 letters below 64.
    pub fn word(&self) -> Checked<Vec<usize>> {
        let letters = self.indices(MAX_PIECES)?;
        self.need(letters.len() <= MAX_LETTERS, "limit", "the word is too long")?;
        Ok(letters)
    }
}
