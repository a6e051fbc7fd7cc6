//! `secant-check CASE CERTIFICATE`: exit code 0 accepted, 1 rejected, 2 unreadable.
use std::io::{Read, Write};
use std::process::ExitCode;

fn read(path: &str) -> Result<String, String> {
    let file = std::fs::File::open(path).map_err(|e| format!("{path} cannot be read: {e}"))?;
    let mut text = String::new();
    match file.take(secant_check::MAX_BYTES as u64 + 1).read_to_string(&mut text) {
        Ok(_) => Ok(text),
        Err(e) => Err(format!("{path} cannot be read: {e}")),
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [case, certificate] = &arguments[..] else {
        eprintln!("usage: secant-check CASE.toml CERTIFICATE.json");
        return ExitCode::from(2);
    };
    let texts = read(case).and_then(|c| read(certificate).map(|t| (c, t)));
    let (case, certificate) = match texts {
        Ok(texts) => texts,
        Err(message) => {
            eprintln!("unreadable: {message}");
            return ExitCode::from(2);
        }
    };
    let checked = secant_check::check(&case, &certificate);
    let (text, code) = match checked {
        Ok(accepted) => {
            let head = format!("accepted: {}: {}\n", accepted.case, accepted.verdict.word());
            let lines = accepted.claims.iter().chain(&accepted.points).map(|line| format!("  {line}\n"));
            (head + &lines.collect::<String>(), 0)
        }
        Err(rejected) => (format!("{rejected}\n"), if rejected.unreadable { 2 } else { 1 }),
    };
    // The exit code tells the answer also where nobody reads the text.
    let _ = std::io::stdout().write_all(text.as_bytes());
    ExitCode::from(code)
}
