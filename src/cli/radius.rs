//! `secant jsr` and `secant regularity`.

use super::output::{complain, print};
use super::{BAD_INPUT, PROVED, RegularityArgs, UNDETERMINED};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::Problem;
use crate::radius::{Options, file, joint_radius};
use crate::report::radius as report;
use crate::scheme::Mask;
use crate::theorem::regularity::regularity;
use std::path::Path;

/// Prints bounds of the joint spectral radius of the matrices of a file.
pub fn jsr(path: &Path) -> u8 {
    let name = path.display();
    let wrong = |message: String, help: &str| Problem::new("secant::jsr", message).with_help(help);
    let found = std::fs::read_to_string(path)
        .map_err(|e| wrong(format!("{name} cannot be read: {e}"), "name a TOML file with `matrices = [...]`"))
        .and_then(|text| {
            file::parse(&text).map_err(|e| wrong(format!("{name}: {e}"), "see docs/radius.md for the format"))
        })
        .and_then(|file| {
            joint_radius(&file.system, &Options::default())
                .map_err(|e| wrong(format!("{name}: {e}"), "see docs/radius.md"))
        });
    match found {
        Ok(radius) => {
            print(&report::joint_radius(&radius));
            PROVED
        }
        Err(problem) => {
            complain(&problem);
            BAD_INPUT
        }
    }
}

/// Prints the regularity of the scheme of a mask.
pub fn mask(args: &RegularityArgs) -> u8 {
    let wrong = |message: String| {
        Problem::new("secant::mask", message)
            .with_help("write the coefficients as in \"1/4,3/4,3/4,1/4\" or the symbol as in \"(1+z)^3/4\"")
    };
    let coefficients = read_mask(&args.mask, args.arity).map_err(wrong);
    let found =
        coefficients.and_then(|c| regularity(&c, args.arity, &Options::default()).map_err(|e| wrong(e.to_string())));
    match found {
        Ok(found) => {
            print(&report::regularity(&found));
            if found.exponent.is_some() { PROVED } else { UNDETERMINED }
        }
        Err(problem) => {
            complain(&problem);
            BAD_INPUT
        }
    }
}

fn read_mask(text: &str, arity: usize) -> Result<Vec<Rational>, String> {
    if text.contains('z') {
        return Ok(Mask::from_symbol(arity, text).map_err(|e| e.to_string())?.coefficients().to_vec());
    }
    let inner = text.trim().trim_start_matches('[').trim_end_matches(']');
    let entries = inner.split(',').map(|t| parse_rational(t).map_err(|e| e.to_string()));
    let coefficients: Vec<Rational> = entries.collect::<Result<_, _>>()?;
    Ok(Mask::new(arity, coefficients).map_err(|e| e.to_string())?.coefficients().to_vec())
}
