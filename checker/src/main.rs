//! `secant-check CASE CERTIFICATE`: exit code 0 accepted, 1 rejected, 2 unreadable.
use secant_check::{MAX_BYTES, check};
use std::io::{Read, Write};
use std::process::ExitCode;

fn read(path: &str) -> Result<String, String> {
    let mut text = String::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(MAX_BYTES as u64 + 1).read_to_string(&mut text));
    read.map(|_| text).map_err(|e| format!("{path} cannot be read: {e}"))
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let texts = match &arguments[..] {
        [case, certificate] => {
            read(case).and_then(|c| Ok((c, read(certificate)?))).map_err(|e| format!("unreadable: {e}"))
        }
        _ => Err("usage: secant-check CASE.toml CERTIFICATE.json".to_owned()),
    };
    let (case, certificate) = match texts {
        Ok(texts) => texts,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let (text, code) = match check(&case, &certificate) {
        Ok(accepted) => {
            let lines: String = accepted.claims.iter().chain(&accepted.points).map(|d| format!("  {d}\n")).collect();
            (format!("accepted: {}: {}\n{lines}", accepted.case, accepted.verdict.word()), 0)
        }
        Err(rejected) => (format!("{rejected}\n"), if rejected.unreadable { 2 } else { 1 }),
    };
    // The exit code tells the answer also where nobody reads the text.
    let _ = std::io::stdout().write_all(text.as_bytes());
    ExitCode::from(code)
}
