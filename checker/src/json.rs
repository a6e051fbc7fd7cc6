//! A strict JSON reader: no floats, no negative integers, no repeated keys, and the fields of every object in their order.

use crate::matrix::Matrix;
use crate::number::{Q, canonical, charge};
use crate::{Checked, reject};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// A JSON value as certificates use it.
#[derive(Debug)]
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

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
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
            if fields.iter().any(|(k, _)| *k == key) {
                return Err(A::Error::custom(format!("the key {key:?} is repeated")));
            }
            if fields.len() == MAX_FIELDS {
                return Err(A::Error::custom("too many fields"));
            }
            room()?;
            fields.push((key, value));
        }
        Ok(Json::Object(fields))
    }
}

/// A value of the certificate with the place where it stands.
#[derive(Clone)]
pub struct Node<'a> {
    /// The value.
    pub value: &'a Json,
    /// Its place, such as `points[1].branches[0].cover`.
    pub place: String,
}

impl<'a> Node<'a> {
    /// A rejection of this value by the rules of the format.
    pub fn malformed<T>(&self, why: &str) -> Checked<T> {
        reject("format", &self.place, why)
    }

    /// A rejection of this value unless a premise holds.
    pub fn need(&self, holds: bool, rule: &str, why: &str) -> Checked<()> {
        if holds { Ok(()) } else { reject(rule, &self.place, why) }
    }

    /// A rejection of this value where something holds.
    pub fn refuse(&self, holds: bool, rule: &str, why: impl Into<String>) -> Checked<()> {
        if holds { reject(rule, &self.place, why) } else { Ok(()) }
    }

    /// Whether this is `null`.
    pub fn is_null(&self) -> bool {
        matches!(self.value, Json::Null)
    }

    /// The values of an object with exactly these fields in this order.
    pub fn fields<const K: usize>(&self, names: [&str; K]) -> Checked<[Node<'a>; K]> {
        let Json::Object(fields) = self.value else { return self.malformed("an object is needed here") };
        if !fields.iter().map(|(k, _)| k.as_str()).eq(names) {
            return self.malformed(&format!("the fields must be exactly {names:?}, in this order"));
        }
        Ok(std::array::from_fn(|k| Node { value: &fields[k].1, place: format!("{}.{}", self.place, names[k]) }))
    }

    /// The text of the first field, which must have the given name: the tag that says which fields follow.
    pub fn tag(&self, name: &str) -> Checked<&'a str> {
        match self.value {
            Json::Object(fields) => match fields.first() {
                Some((key, Json::Text(text))) if key == name => Ok(text),
                _ => self.malformed(&format!("the first field must be the text {name:?}")),
            },
            _ => self.malformed("an object is needed here"),
        }
    }

    /// The value of a field, where there is one.
    pub fn get(&self, name: &str) -> Option<Node<'a>> {
        let Json::Object(fields) = self.value else { return None };
        let (_, value) = fields.iter().find(|(key, _)| key == name)?;
        Some(Node { value, place: format!("{}.{name}", self.place) })
    }

    /// The value of a field.
    pub fn field(&self, name: &str) -> Checked<Node<'a>> {
        self.get(name).map_or_else(|| self.malformed(&format!("the field {name:?} is missing")), Ok)
    }

    /// Whether this is an object with no other keys than these.
    pub fn known(&self, names: &[&str]) -> Checked<()> {
        let Json::Object(fields) = self.value else { return self.malformed("a table is needed here") };
        match fields.iter().find(|(key, _)| !names.contains(&key.as_str())) {
            Some((key, _)) => self.malformed(&format!("unknown key `{key}`")),
            None => Ok(()),
        }
    }

    /// The elements of a list.
    pub fn list(&self) -> Checked<Vec<Node<'a>>> {
        let Json::List(items) = self.value else { return self.malformed("a list is needed here") };
        let item = |(k, value)| Node { value, place: format!("{}[{k}]", self.place) };
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// A text.
    pub fn text(&self) -> Checked<&'a str> {
        match self.value {
            Json::Text(text) => Ok(text),
            _ => self.malformed("a text is needed here"),
        }
    }

    /// A natural number below `bound`.
    pub fn index(&self, bound: usize) -> Checked<usize> {
        match self.value {
            Json::Index(k) if usize::try_from(*k).is_ok_and(|k| k < bound) => Ok(*k as usize),
            _ => self.malformed(&format!("a natural number below {bound} is needed here")),
        }
    }

    /// A rational number in its canonical form.
    pub fn rational(&self) -> Checked<Q> {
        match canonical(self.text()?) {
            Some(number) => Ok(number),
            None => self.malformed("not a rational number in lowest terms, such as \"-3/4\" or \"2\""),
        }
    }

    /// A list of exactly `count` rational numbers.
    pub fn vector(&self, count: usize) -> Checked<Vec<Q>> {
        let items = self.list()?;
        if items.len() != count {
            return self.malformed(&format!("{count} numbers are needed here"));
        }
        items.iter().map(Node::rational).collect()
    }

    /// A matrix as a list of its rows, of which each has `cols` entries.
    pub fn matrix(&self, cols: usize) -> Checked<Matrix> {
        let rows = self.list()?.iter().map(|row| row.vector(cols)).collect::<Checked<Vec<_>>>()?;
        Ok(Matrix::from_rows(cols, &rows))
    }

    /// A word: a list of at most 1000 letters below 64.
    pub fn word(&self) -> Checked<Vec<usize>> {
        let items = self.list()?;
        self.refuse(items.len() > crate::MAX_LETTERS, "limit", "the word is too long")?;
        items.iter().map(|n| n.index(crate::case::MAX_PIECES)).collect()
    }
}
