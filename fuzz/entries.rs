//! Every function that reads text from outside, by name; the fuzz targets and the test `garbage` drive the same list.

#[path = "readers.rs"]
#[allow(dead_code)]
pub mod readers;

use secant::arith::parse_rational;
use secant::case::{Case, matrix_file};
use secant::scheme::{Laurent, Mask, parse_fractint, parse_json};
use secant::shape::Address;

/// A case for the certificates that are read.
const CASE: &str = include_str!("../tests/certs/run/case.toml");

/// The parsers. What they return does not matter; they must return. `readers` compares two of them.
pub const ENTRIES: [(&str, fn(&str)); 12] = [
    ("case", |text| drop(Case::parse("garbage", text))),
    ("case_open", |text| drop(Case::parse_open("garbage", text))),
    ("matrix", |text| drop(matrix_file::parse(text))),
    ("symbol", |text| drop((Laurent::parse(text), Mask::from_symbol(2, text)))),
    ("fractint", |text| drop(parse_fractint(text))),
    ("json_import", |text| drop(parse_json(text))),
    ("radius", |text| drop(secant::radius::file::parse(text))),
    ("number", |text| drop(parse_rational(text))),
    ("address", |text| drop(Address::parse(text))),
    ("certificate", |text| drop(secant_check::check(CASE, text))),
    ("checked_case", |text| drop(secant_check::check(text, include_str!("../tests/certs/run/0-itself.json")))),
    ("readers", readers::compare),
];

/// Feeds a text to the parser of this name.
pub fn feed(name: &str, text: &str) {
    for (entry, read) in ENTRIES {
        if entry == name {
            read(text);
        }
    }
}
