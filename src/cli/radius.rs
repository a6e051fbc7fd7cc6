//! `secant jsr`.

use super::output::{deliver, write_file};
use super::{JsrArgs, PROVED};
use crate::diagnostic::Problem;
use crate::picture::polytope;
use crate::radius::{Options, file, joint_radius};
use crate::report::radius as report;

/// Prints bounds of the joint spectral radius of the matrices of a file.
pub fn jsr(args: &JsrArgs) -> u8 {
    deliver(radius(args).map(|text| (text, PROVED)))
}

fn radius(args: &JsrArgs) -> Result<String, Problem> {
    let name = args.file.display();
    let wrong = |message: String, help: &str| Problem::new("secant::jsr", message).with_help(help);
    let text = std::fs::read_to_string(&args.file)
        .map_err(|e| wrong(format!("{name} cannot be read: {e}"), "name a TOML file with `matrices = [...]`"))?;
    let file = file::parse(&text).map_err(|e| wrong(format!("{name}: {e}"), "see docs/radius.md for the format"))?;
    let found = joint_radius(&file.system, &Options::default())
        .map_err(|e| wrong(format!("{name}: {e}"), "see docs/radius.md"))?;
    if let Some(path) = &args.svg {
        let drawn = polytope(&found).ok_or_else(|| {
            wrong("no polytope in two dimensions was used".to_owned(), "--svg draws invariant polytopes in the plane")
        })?;
        write_file(path, &drawn)?;
    }
    if let Some(path) = &args.certificate {
        let certificate = crate::certificate::radius_certificate(&file, &found)
            .map_err(|e| wrong(e.to_string(), "see docs/certificate.md; nothing was written"))?;
        let written = certificate.text();
        secant_check::check(&text, &written).map_err(|e| {
            wrong(format!("the certificate is not accepted: {e}"), "this is a mistake in secant: please report it")
        })?;
        write_file(path, &written)?;
    }
    Ok(report::joint_radius(&found))
}
