//! `secant-check CASE CERTIFICATE`: exit code 0 accepted, 1 rejected, 2 unreadable.
use secant_check::{Accepted, MAX_BYTES, VERSION, Verdict, check};
use std::io::{Read, Write};
use std::process::ExitCode;

const HELP: &str = "\
Proves the verdict of a secant certificate again, from the case file itself and without secant.

Usage: secant-check CASE CERTIFICATE.json
       secant-check --help | --version

CASE         what the certificate is about: a case (TOML), a mesh (OBJ, OFF, PLY), a file of matrices, or a matrix in plain text
CERTIFICATE  what `secant certify CASE --certificate FILE` wrote (also `secant jsr`, `regularity`, `spectrum`, `solve`)

Everything that is plain linear algebra, rational or over a real number field, is computed again from the case, a `[scheme]` of curves included; from the
certificate comes only what had to be found. A case with a mesh in `[scheme]`, a polygon of several spans or states that are
chains is checked in its expanded form, which secant writes beside the certificate (FILE.case.toml). The rules are in docs/certificate.md.

Exit codes: 0 accepted (the claims are printed, each with its verdict), 1 rejected (with the rule, the place in the
certificate and the reason), 2 one of the files cannot be read.

Example:
    secant certify chaikin.toml --certificate chaikin.json
    secant-check chaikin.toml chaikin.json
";

fn read(path: &str) -> Result<String, String> {
    let mut text = String::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(MAX_BYTES as u64 + 1).read_to_string(&mut text));
    read.map(|_| text).map_err(|e| format!("unreadable: {path}: {e}"))
}

/// What was accepted, for people: the verdict, the claims, and what they rest on.
fn words(accepted: &Accepted) -> String {
    let mut text = format!("accepted: {}: {}\n", accepted.case, accepted.verdict.word());
    accepted.claims.iter().for_each(|claim| text += &format!("  {claim}\n"));
    let decided = accepted.points.iter().filter(|d| d.verdict != Verdict::Undetermined);
    let lines: Vec<String> = decided.map(|d| format!("    {d}\n")).collect();
    if !lines.is_empty() {
        text += "  by\n";
        text.extend(lines);
    }
    text
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words_of: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (text, code) = match words_of[..] {
        ["--help" | "-h"] => (HELP.to_owned(), 0),
        ["--version" | "-V"] => {
            (format!("secant-check {} (certificate format {VERSION})\n", env!("CARGO_PKG_VERSION")), 0)
        }
        [case, certificate] => match read(case).and_then(|c| Ok((c, read(certificate)?))) {
            Err(message) => (format!("{message}\n"), 2),
            Ok((case, certificate)) => match check(&case, &certificate) {
                Ok(accepted) => (words(&accepted), 0),
                Err(rejected) => (format!("{rejected}\n"), if rejected.unreadable { 2 } else { 1 }),
            },
        },
        _ => ("usage: secant-check CASE CERTIFICATE.json (`secant-check --help` says more)\n".to_owned(), 2),
    };
    // The exit code tells the answer also where nobody reads the text.
    let _ = if code == 2 {
        std::io::stderr().write_all(text.as_bytes())
    } else {
        std::io::stdout().write_all(text.as_bytes())
    };
    ExitCode::from(code)
}
