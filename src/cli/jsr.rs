//! `secant jsr`.

use super::files::Written;
use super::output::{complain, print, settle};
use super::{BAD_INPUT, JsrArgs, PROVED, UNDETERMINED};
use crate::ask::{Radius, radius};
use crate::diagnostic::Problem;
use crate::radius::Options;
use serde_json::Value;
use std::path::Path;

/// Prints bounds of the joint spectral radii of the matrices of files.
pub fn jsr(args: &JsrArgs) -> u8 {
    if let ([path], false) = (args.files.as_slice(), args.jsonl) {
        return settle(answer(path, args).map(|found| {
            let written = files(&found, args);
            print(&shown(&found, args));
            written.code(code(&found))
        }));
    }
    let mut worst = PROVED;
    let mut list = Vec::new();
    for path in &args.files {
        let own = match answer(path, args) {
            Ok(found) if args.jsonl => {
                print(&format!("{}\n", found.json()));
                code(&found)
            }
            Ok(found) if args.json => {
                list.push(found.json());
                code(&found)
            }
            Ok(found) => {
                print(&format!("{}\n{}\n", path.display(), shown(&found, args)));
                code(&found)
            }
            Err(problem) => {
                complain(&problem);
                BAD_INPUT
            }
        };
        worst = if worst == BAD_INPUT || own == BAD_INPUT { BAD_INPUT } else { worst.max(own) };
    }
    if args.json && !args.jsonl {
        print(&format!("{:#}\n", Value::from(list)));
    }
    worst
}

fn code(found: &Radius) -> u8 {
    if found.is_bounded() { PROVED } else { UNDETERMINED }
}

fn shown(found: &Radius, args: &JsrArgs) -> String {
    if args.json { format!("{:#}\n", found.json()) } else { found.text() }
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

fn answer(path: &Path, args: &JsrArgs) -> Result<Radius, Problem> {
    let name = path.display().to_string();
    let wrong = |message: String, help: &str| Problem::new("secant::jsr", message).with_help(help);
    let read = match name.as_str() {
        "-" => std::io::read_to_string(std::io::stdin()),
        _ => std::fs::read_to_string(path),
    };
    let text = read.map_err(|e| {
        let scheme = !path.exists() && crate::case::Case::ask(&name).is_ok();
        let help = if scheme {
            "it is a scheme: `secant regularity` bounds the radii that say how smooth it is; here name a file with `matrices = [...]`"
        } else {
            "name a file with `matrices = [...]`"
        };
        wrong(format!("{name} cannot be read: {e}"), help)
    })?;
    radius(&name, &text, &options(args)?)
}

/// Writes what was asked for.
fn files(radius: &Radius, args: &JsrArgs) -> Written {
    let mut written = Written::default();
    written.file(args.svg.as_deref(), |_| {
        radius.picture().ok_or_else(|| {
            Problem::new("secant::jsr", "no polytope in two dimensions was used")
                .with_help("--svg draws invariant polytopes in the plane")
        })
    });
    written.file(args.certificate.as_deref(), |_| radius.certificate());
    written
}
