//! `secant regularity`.

use super::output::{deliver, write_certificate};
use super::{PROVED, RegularityArgs, UNDETERMINED};
use crate::arith::{Rational, parse_rational};
use crate::case::{Case, Origin};
use crate::diagnostic::Problem;
use crate::radius::Options;
use crate::report::radius as report;
use crate::scheme::{self, Mask};
use crate::shape::{Contraction, Spaces};
use crate::theorem::regularity;
use crate::theorem::smoothness::curve_regularity;
use crate::theorem::wavelet::{MAX_MOMENTS, wavelet};
use std::collections::BTreeMap;
use std::path::Path;

/// What `secant regularity` is asked about.
enum Subject {
    Wavelet(usize),
    Mask(Mask),
    Curve(Box<crate::shape::Shape>),
}

/// Prints the regularity of a scheme, a curve or a scaling function.
pub fn regularity(args: &RegularityArgs) -> u8 {
    let made = match &args.certificate {
        Some(path) => certified(args, path),
        None => subject(args).and_then(|subject| table(&subject)),
    };
    deliver(made.map(|(text, decided)| (text, if decided { PROVED } else { UNDETERMINED })))
}

fn wrong(message: String) -> Problem {
    Problem::new("secant::regularity", message).with_help(
        "name a case file, a scheme of `secant schemes`, a wavelet such as db2, or write a mask as in \
         \"1/4,3/4,3/4,1/4\" or a symbol as in \"(1+z)^3/4\"",
    )
}

fn table(subject: &Subject) -> Result<(String, bool), Problem> {
    let options = Options::default();
    match subject {
        Subject::Wavelet(moments) => match wavelet(*moments, &options) {
            Some(found) => Ok((report::wavelet(&found), true)),
            None => Err(wrong(format!("no bounds were found for db{moments}"))),
        },
        Subject::Mask(mask) => {
            let found = regularity::regularity(mask.coefficients(), mask.arity(), &options);
            let found = found.map_err(|e| wrong(e.to_string()))?;
            Ok((report::regularity(&found), found.exponent.is_some()))
        }
        Subject::Curve(shape) => {
            let spaces = Spaces::new(shape).ok_or_else(|| wrong("a fixed point is not unique".to_owned()))?;
            let found = curve_regularity(shape, &spaces, &options).map_err(|e| wrong(e.to_string()))?;
            let decided = found.exponent.is_some() || found.polynomial;
            Ok((report::curve_regularity(shape, &found), decided))
        }
    }
}

fn subject(args: &RegularityArgs) -> Result<Subject, Problem> {
    let what = args.what.trim();
    let no_parameters = || match args.parameters.first() {
        Some(extra) => Err(wrong(format!("`{extra}` is a parameter, but only named schemes have parameters"))),
        None => Ok(()),
    };
    if let Some(moments) = what.strip_prefix("db").and_then(|n| n.parse::<usize>().ok()) {
        no_parameters()?;
        if (2..=MAX_MOMENTS).contains(&moments) {
            return Ok(Subject::Wavelet(moments));
        }
        return Err(wrong(format!("{what} is not known: db2 to db{MAX_MOMENTS} are")));
    }
    if scheme::list().iter().any(|s| s.name == what) {
        return named(what, &args.parameters);
    }
    no_parameters()?;
    if what.ends_with(".toml") || Path::new(what).is_file() {
        return case(Path::new(what));
    }
    mask(what, args.arity).map(Subject::Mask).map_err(wrong)
}

fn named(name: &str, parameters: &[String]) -> Result<Subject, Problem> {
    let mut values: BTreeMap<String, Rational> = BTreeMap::new();
    for text in parameters {
        let Some((key, value)) = text.split_once('=') else {
            return Err(wrong(format!("`{text}` is not of the form name=value")));
        };
        values.insert(key.trim().to_owned(), parse_rational(value).map_err(|e| wrong(e.to_string()))?);
    }
    match scheme::mask(name, &values).map_err(|e| wrong(e.to_string()))? {
        Some(mask) => Ok(Subject::Mask(mask)),
        None => {
            let shape = scheme::build(name, &values).map_err(|e| wrong(e.to_string()))?;
            Ok(Subject::Curve(Box::new(shape)))
        }
    }
}

/// The mask of a case with one, or its curve, which must be a model that contracts.
fn case(path: &Path) -> Result<Subject, Problem> {
    let case = Case::read(path)?;
    if let Some(Origin::Mask(mask)) = &case.scheme {
        return Ok(Subject::Mask(mask.clone()));
    }
    contracting(&case)?;
    Ok(Subject::Curve(Box::new(case.shape)))
}

/// Why the curve of a case contracts.
fn contracting(case: &Case) -> Result<Contraction, Problem> {
    case.shape.check_curves().map_err(|e| crate::prove::model_problem(case, &e.into()))?;
    let found = crate::theorem::contraction_of(&case.shape).map_err(|e| crate::prove::model_problem(case, &e))?;
    if !found.is_proved() {
        return Err(wrong(format!("{}: contraction is not decided", case.name)));
    }
    Ok(found)
}

/// Writes the certificate of a curve, and prints its table; of a mask after the table of the mask.
fn certified(args: &RegularityArgs, path: &Path) -> Result<(String, bool), Problem> {
    let what = args.what.trim();
    if !what.ends_with(".toml") && !Path::new(what).is_file() {
        return Err(Problem::new("secant::regularity", format!("{what} is no case file, which a certificate is about"))
            .with_help("write the case first: `secant schemes NAME > FILE.toml`, or `secant expand`; wavelets have no certificates"));
    }
    let case = Case::read(Path::new(what))?;
    let contraction = contracting(&case)?;
    let shape = &case.shape;
    let spaces = Spaces::new(shape).ok_or_else(|| wrong("a fixed point is not unique".to_owned()))?;
    let found = curve_regularity(shape, &spaces, &Options::default()).map_err(|e| wrong(e.to_string()))?;
    let nothing = |e: String| wrong(e).with_help("see docs/certificate.md; nothing was written");
    let certificate = crate::certificate::regularity_certificate(&case, &spaces, &contraction, &found);
    let certificate = certificate
        .map_err(|e| nothing(e.to_string()))
        .and_then(|c| crate::certificate::checked(&case.checked_text(), c).map_err(|e| nothing(e.to_string())))?;
    write_certificate(path, certificate.text(), case.beside())?;
    let decided = found.exponent.is_some() || found.polynomial;
    let own = report::curve_regularity(shape, &found);
    match &case.scheme {
        Some(Origin::Mask(mask)) => {
            let (text, decided) = table(&Subject::Mask(mask.clone()))?;
            Ok((format!("{text}\nThe certificate is about the curve:\n{own}"), decided))
        }
        _ => Ok((own, decided)),
    }
}

fn mask(text: &str, arity: usize) -> Result<Mask, String> {
    if text.contains('z') {
        return Mask::from_symbol(arity, text).map_err(|e| e.to_string());
    }
    let inner = text.trim().trim_start_matches('[').trim_end_matches(']');
    let entries = inner.split(',').map(|t| parse_rational(t).map_err(|e| e.to_string()));
    let coefficients: Vec<Rational> = entries.collect::<Result<_, _>>()?;
    Mask::new(arity, coefficients).map_err(|e| e.to_string())
}
