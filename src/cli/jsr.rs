//! `secant jsr`.

use super::output::{complain, deliver, print, write_file};
use super::{BAD_INPUT, JsrArgs, PROVED, UNDETERMINED};
use crate::diagnostic::{Problem, SourceText};
use crate::picture::polytope;
use crate::radius::{JointRadius, Options, file, joint_radius};
use crate::report::radius as report;
use serde_json::Value;
use std::path::Path;

/// Prints bounds of the joint spectral radii of the matrices of files.
pub fn jsr(args: &JsrArgs) -> u8 {
    if let ([path], false) = (args.files.as_slice(), args.jsonl) {
        return deliver(answer(path, args).map(|found| (found.text(args), found.code())));
    }
    let mut worst = PROVED;
    let mut list = Vec::new();
    for path in &args.files {
        let code = match answer(path, args) {
            Ok(found) if args.jsonl => {
                print(&format!("{}\n", found.json()));
                found.code()
            }
            Ok(found) if args.json => {
                list.push(found.json());
                found.code()
            }
            Ok(found) => {
                print(&format!("{}\n{}\n", path.display(), found.text(args)));
                found.code()
            }
            Err(problem) => {
                complain(&problem);
                BAD_INPUT
            }
        };
        worst = if worst == BAD_INPUT || code == BAD_INPUT { BAD_INPUT } else { worst.max(code) };
    }
    if args.json && !args.jsonl {
        print(&format!("{:#}\n", Value::from(list)));
    }
    worst
}

/// What was found for one file.
struct Answer {
    name: String,
    radius: JointRadius,
}

impl Answer {
    fn code(&self) -> u8 {
        if self.radius.upper.is_some() { PROVED } else { UNDETERMINED }
    }

    fn json(&self) -> Value {
        report::radius_json(&self.name, &self.radius)
    }

    fn text(&self, args: &JsrArgs) -> String {
        if args.json { format!("{:#}\n", self.json()) } else { report::joint_radius(&self.radius) }
    }
}

/// The options that the arguments ask for.
fn options(args: &JsrArgs) -> Result<Options, Problem> {
    let wrong = |message: String| Err(Problem::new("secant::jsr", message).with_help("see `secant jsr --help`"));
    if args.files.len() > 1 && (args.svg.is_some() || args.certificate.is_some()) {
        return wrong("--svg and --certificate are about one file".to_owned());
    }
    let mut options = Options::default();
    if let Some(longest) = args.longest {
        if !(1..=200).contains(&longest) {
            return wrong(format!("--longest {longest} is not from 1 to 200"));
        }
        options.longest = longest;
    }
    if let Some(width) = args.width {
        if !(0.0..1.0).contains(&width) {
            return wrong(format!("--width {width} is not from 0 to 1"));
        }
        options.width = width;
    }
    match args.time {
        Some(seconds) if seconds > 0.0 && seconds.is_finite() => Ok(options.within(seconds)),
        Some(seconds) => wrong(format!("--time {seconds} is no positive number of seconds")),
        None => Ok(options),
    }
}

fn answer(path: &Path, args: &JsrArgs) -> Result<Answer, Problem> {
    let name = path.display().to_string();
    let wrong = |message: String, help: &str| Problem::new("secant::jsr", message).with_help(help);
    let text = std::fs::read_to_string(path)
        .map_err(|e| wrong(format!("{name} cannot be read: {e}"), "name a file with `matrices = [...]`"))?;
    let file = file::parse(&text).map_err(|e| {
        let source = SourceText::new(&name, text.as_str());
        wrong(e.problem.to_string(), "see docs/radius.md for the format").with_source(&source).with_mark(e.span)
    })?;
    let found =
        joint_radius(&file.system, &options(args)?).map_err(|e| wrong(format!("{name}: {e}"), "see docs/radius.md"))?;
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
            let help = match text.trim_start().starts_with(['{', '[']) || !text.contains('=') {
                true => "certificates are about TOML files: write the matrices as one",
                false => "this is a mistake in secant: please report it",
            };
            wrong(format!("the certificate is not accepted: {e}"), help)
        })?;
        write_file(path, &written)?;
    }
    let name = if file.name.is_empty() { name } else { file.name };
    Ok(Answer { name, radius: found })
}
