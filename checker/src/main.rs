//! `secant-check CASE CERTIFICATE`: exit code 0 accepted, 1 rejected, 2 unreadable.
use std::process::ExitCode;

fn read(path: &str) -> Result<String, String> {
    use std::io::Read;
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
    match secant_check::check(&case, &certificate) {
        Ok(accepted) => {
            println!("accepted: {}: {}", accepted.case, accepted.verdict.word());
            for claim in accepted.claims.iter().chain(&accepted.points) {
                println!("  {claim}");
            }
            ExitCode::SUCCESS
        }
        Err(rejected) => {
            println!("{rejected}");
            ExitCode::from(if rejected.unreadable { 2 } else { 1 })
        }
    }
}
