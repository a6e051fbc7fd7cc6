//! Checks a secant certificate against its case, by the rules of `docs/certificate.md` and without any search.
//!
//! No code is shared with secant: this crate reads the case file itself, computes everything that is plain linear algebra
//! (rational, or over a real number field) again, and takes from the certificate only what had to be found. All arithmetic is exact.

mod base;
mod claim;
mod curve;
mod jsr;
mod lattice;
mod literal;
mod mesh;
pub mod reader;
mod region;
mod regularity;
mod solve;
mod spectrum;
mod surface;
mod vertex;

pub use base::{Accepted, Checked, Rejected, Verdict, number};
use base::{Ground, Json, Node, Surd, need, reject, unreadable};
pub use claim::{Address, Claim, Decided, End, Joints, Place, Real, Subject};
use curve::case;

/// The version of the certificate format that is read.
pub const VERSION: usize = 1;
/// Largest case or certificate in bytes.
pub const MAX_BYTES: usize = 16 << 20;
/// Longest name of a case in bytes.
const MAX_NAME: usize = 200;

/// Checks a certificate (JSON) against the text of what it is about (a case, in TOML, where its kind is `certify`).
///
/// All kinds share the envelope that is read here; the rules of a kind are in a module of its own, which reads the first
/// text as that kind of input and says what `proof` proves about it.
///
/// # Errors
/// [`Rejected`] with the rule, the place and the reason; `unreadable` is set where one of the two texts could not be read.
///
/// # Cost
/// Bounded: the files by [`MAX_BYTES`], the nesting by 128, the numbers by 10000 digits, the arithmetic by a budget.
pub fn check(case: &str, certificate: &str) -> Checked<Accepted> {
    checked(case, certificate)
}

/// The same, with a function that is called now and then; where it unwinds, nothing is accepted.
///
/// # Errors
/// As [`check`].
pub fn check_while(case: &str, certificate: &str, look: fn()) -> Checked<Accepted> {
    number::looking(look, || checked(case, certificate))
}

/// A certificate about a curve or a set, over the rational numbers or over a field that it names.
fn certify(case: &str, proof: &Node<'_>) -> Checked<Accepted> {
    let Some(field) = proof.get("field") else {
        let [contraction, points, answers] = proof.fields("contraction points answers")?;
        return curve::check(&case::read(case, false)?, &(), [&contraction, &points, &answers]);
    };
    let [_, contraction, points, answers] = proof.fields("field contraction points answers")?;
    let ground = Ground::read(&field)?;
    let case = case::over::<Surd>(case, false, &ground)?;
    curve::check(&case, &ground, [&contraction, &points, &answers])
}

fn checked(case: &str, certificate: &str) -> Checked<Accepted> {
    unreadable(need(case.len().max(certificate.len()) <= MAX_BYTES, "limit", "a file is too large"))?;
    number::refill();
    let tree: Json = unreadable(serde_json::from_str(certificate).or_else(|error| reject("json", error)))?;
    let node = Node { value: &tree, place: "certificate".to_owned() };
    let [format, version, kind, name, verdict, proof] = node.fields("format version kind case verdict proof")?;
    let known = format.text()? == "secant certificate" && version.index(usize::MAX)? == VERSION;
    version.need(known, "format", format_args!("this checker reads version {VERSION} only"))?;
    let proof = Node { place: "proof".to_owned(), ..proof };
    let found = match kind.text()? {
        "certify" => certify(case, &proof)?,
        "regularity" => regularity::check(case, &proof)?,
        "region" => region::check(case, &proof)?,
        "solve" => solve::check(&case::read(case, true)?, &proof)?,
        "spectrum" => spectrum::check(case, &proof)?,
        "jsr" => jsr::check(case, &proof)?,
        "border" => lattice::border::check(case, &proof)?,
        "lattice" => lattice::check(case, &proof)?,
        "surface" => surface::check(case, &proof)?,
        "vertex" => vertex::check(case, &proof)?,
        "mesh" => mesh::check(case, &proof)?,
        _ => return kind.reject("format", "unknown kind of certificate"),
    };
    number::spend(0, 0)?;
    // Names are printed; one that ends its line, or goes on after a colon, could say what is proved.
    let plain = |c: char| c.is_alphanumeric() || " -_.,()/+'".contains(c);
    let plain = found.case.len() <= MAX_NAME && found.case.chars().all(plain);
    unreadable(need(plain, "case", "a name is made of letters, digits, spaces and -_.,()/+', and not too long"))?;
    name.need(name.text()? == found.case, "case", format_args!("the case is `{}`", found.case))?;
    verdict.follows("verdict", found.verdict.word())?;
    Ok(found)
}
