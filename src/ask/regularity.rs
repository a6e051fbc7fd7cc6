//! The smoothness of schemes, curves and scaling functions, from joint spectral radii.

use super::border::{border_answer, border_case, border_certified};
use super::lattice::{lattice_answer, lattice_case, lattice_certified};
use crate::algebraic::Real;
use crate::arith::{Rational, parse_rational};
use crate::case::{self, BorderCase, Case, LatticeCase, Origin};
use crate::certificate::Written;
use crate::diagnostic::{Problem, SourceText};
use crate::radius::{Options, Radial};
use crate::report::regularity as report;
use crate::report::regularity::Meaning;
use crate::report::values::decimal;
use crate::scheme::{self, Family, Laurent, Normalisation};
use crate::shape::{Contraction, Shape, Spaces};
use crate::theorem::Provable;
use crate::theorem::enclosed::enclosed;
use crate::theorem::filter::{Filter, FilterError, Understood, understood};
use crate::theorem::regularity as theorem_regularity;
use crate::theorem::smoothness::{CurveRegularity, curve_regularity};
use crate::theorem::wavelet::{MAX_MOMENTS, wavelet};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// What is asked about.
enum Subject {
    Wavelet(Family, usize),
    /// A mask, and whether it comes with control points, which it is not about.
    Mask(Understood, bool),
    Curve(Box<Shape>),
    /// With entries in a real number field.
    Over(Box<Shape<Real>>),
}

/// What is known about the smoothness of something, in both forms, and whether anything is decided.
#[derive(Debug, Clone)]
pub struct Smooth {
    /// For people.
    pub text: String,
    /// The same as data (docs/json.md), without the name of the input.
    pub data: Value,
    /// Whether an exponent, convergence or smoothness is decided.
    pub decided: bool,
}

/// The smoothness of a case file, a scheme with parameters such as `w=1/16`, a wavelet, a mask or a symbol.
///
/// # Errors
/// A [`Problem`] where the input is none of these, or no bounds were found.
///
/// # Examples
/// ```
/// let found = secant::ask::regularity("1/4,3/4,3/4,1/4", &[], 2)?;
/// assert_eq!(found.data["kind"], "mask");
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn regularity(what: &str, parameters: &[String], arity: usize) -> Result<Smooth, Problem> {
    dilated_regularity(what, parameters, arity, None)
}

/// As [`regularity`]; with a dilation such as `[[1,1],[1,-1]]` or `quincunx` for a symbol in several variables.
///
/// # Errors
/// As [`regularity`]; also where the input is no such symbol, or says its dilation itself.
///
/// # Examples
/// ```
/// let found = secant::ask::dilated_regularity("(1+x)^2*(1+y)^2/8", &[], 2, Some("quincunx"))?;
/// assert_eq!(found.data["smoothness"], 3);
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn dilated_regularity(
    what: &str,
    parameters: &[String],
    arity: usize,
    dilation: Option<&str>,
) -> Result<Smooth, Problem> {
    if let Some(case) = plain_border(what, parameters, dilation)? {
        return border_answer(case.scheme).map(|(smooth, _)| smooth);
    }
    match lattice_case(what, parameters, dilation)? {
        Some(case) => lattice_answer(case.mask).map(|(smooth, _)| smooth),
        None => answer(what, &subject(what, parameters, arity)?),
    }
}

/// As [`regularity`] for the text of a case; `name` is shown in diagnostics.
///
/// # Errors
/// As [`regularity`].
pub fn regularity_of_case(name: &str, text: &str) -> Result<Smooth, Problem> {
    if BorderCase::is_meant(text) {
        return border_answer(BorderCase::parse(name, text)?.scheme).map(|(smooth, _)| smooth);
    }
    if LatticeCase::is_meant(text) {
        return lattice_answer(LatticeCase::parse(name, text)?.mask).map(|(smooth, _)| smooth);
    }
    answer(name, &subject_of_case(name, text)?)
}

/// A case with a border, which has neither parameters nor a dilation.
fn plain_border(what: &str, parameters: &[String], dilation: Option<&str>) -> Result<Option<BorderCase>, Problem> {
    let case = border_case(what)?;
    match case {
        Some(_) if !parameters.is_empty() || dilation.is_some() => {
            Err(wrong(format!("{what} has a [border], and neither parameters nor a dilation")))
        }
        other => Ok(other),
    }
}

fn wrong(message: String) -> Problem {
    Problem::new("secant::regularity", message).with_help(
        "name a case file, a scheme of `secant schemes`, a wavelet such as db2, haar or bior2.2, or write a mask as in \
         \"1/4,3/4,3/4,1/4\" or a symbol as in \"(1+z)^3/4\"",
    )
}

/// Why coefficients are no mask, with the remedy where the reader of numbers has one.
fn no_mask(place: &str, error: FilterError) -> Problem {
    let problem = wrong(format!("{place}{error}"));
    match error {
        FilterError::Read { help: Some(help), .. } => problem.with_help(help),
        _ => problem,
    }
}

fn answer(what: &str, subject: &Subject) -> Result<Smooth, Problem> {
    let options = Options::default();
    match subject {
        Subject::Wavelet(family, moments) => {
            let found = wavelet(*family, *moments, &options);
            let found = found.ok_or_else(|| wrong(format!("no bounds were found for {}{moments}", family.prefix())))?;
            let kind = match family {
                Family::Daubechies => "",
                Family::LeastAsymmetric => "least asymmetric ",
            };
            let title = format!(
                "Daubechies' {kind}scaling function with {moments} vanishing moments: a(z) = (1+z)^{moments} b(z), b = 2^{} q",
                1 - i64::try_from(*moments).map_err(|e| wrong(e.to_string()))?
            );
            let text = report::enclosed(&title, &found, Meaning::Limit);
            Ok(Smooth { text, data: report::enclosed_data(&found, Meaning::Limit), decided: true })
        }
        Subject::Mask(mask, points) => of_mask(what, (mask, *points), &options),
        Subject::Curve(shape) => Ok(of_curve(shape)?.0),
        Subject::Over(shape) => Ok(of_curve(shape)?.0),
    }
}

/// What is known of a curve that contracts, as it is said and as it was found.
fn of_curve<E: Radial>(shape: &Shape<E>) -> Result<(Smooth, CurveRegularity<E>, Spaces<E>), Problem> {
    let spaces = Spaces::new(shape).ok_or_else(|| wrong("a fixed point is not unique".to_owned()))?;
    let found = curve_regularity(shape, &spaces, &Options::default()).map_err(|e| wrong(e.to_string()))?;
    let decided = found.exponent.is_some() || found.polynomial;
    let text = report::curve_regularity(shape, &found);
    Ok((Smooth { text, data: report::curve_data(shape, &found), decided }, found, spaces))
}

fn of_mask(what: &str, (mask, points): (&Understood, bool), options: &Options) -> Result<Smooth, Problem> {
    let read = mask.remark.as_ref().map(|r| report::remark(r, mask.arity));
    let all = points.then(|| report::ALL_POINTS.to_owned());
    let remarks: Vec<String> = read.into_iter().chain(all).collect();
    let remark = (!remarks.is_empty()).then(|| remarks.join("; "));
    let noted = |text: String, mut data: Value, decided| {
        data["remark"] = json!(remark);
        let head = remark.as_ref().map_or_else(String::new, |r| format!("note        {r}\n"));
        Smooth { text: head + &text, data, decided }
    };
    let enclosures = match &mask.filter {
        Filter::Rational(coefficients) => {
            let found = theorem_regularity::regularity(coefficients, mask.arity, options);
            let found = found.map_err(|e| wrong(e.to_string()))?;
            let decided = found.converges().is_some() && found.exponent.is_some();
            return Ok(noted(report::regularity(&found), report::regularity_data(&found), decided));
        }
        Filter::Field(field) => (field.enclosures(), field.sum_rules),
        Filter::Near(near) => (near.enclosures(), near.sum_rules),
    };
    let found = enclosed(enclosures.0, mask.arity, enclosures.1, options);
    let found = found.ok_or_else(|| {
        wrong(format!("no bounds were found for {what}"))
            .with_help("the polytopes or norms that were found are too thin for coefficients that are only enclosed")
    })?;
    let (title, meaning) = match &mask.filter {
        Filter::Field(field) => (
            format!(
                "mask        {}\nin          {}",
                field.mask.iter().map(|x| field.field.expression(x)).collect::<Vec<_>>().join(", "),
                field.field.describe()
            ),
            // The translates of a continuous orthonormal scaling function are stable.
            if field.orthonormal && found.exponent.lo > 0 { Meaning::Limit } else { Meaning::Scheme },
        ),
        Filter::Near(near) => (
            format!("mask        near {}", near.mask.iter().map(|c| decimal(c, 10)).collect::<Vec<_>>().join(", ")),
            Meaning::Near(near),
        ),
        Filter::Rational(_) => return Err(wrong("a rational mask has no enclosures".to_owned())),
    };
    let decided = found.exponent.lo > 0 || found.exponent.hi <= 0;
    Ok(noted(report::enclosed(&title, &found, meaning), report::enclosed_data(&found, meaning), decided))
}

fn subject(what: &str, parameters: &[String], arity: usize) -> Result<Subject, Problem> {
    if let Some(own) = case::unaliased(what) {
        return subject(&own, parameters, arity);
    }
    let mut words = what.split_whitespace();
    if let Some(name) = words.next().filter(|word| scheme::list().iter().any(|s| s.name == *word)) {
        let own = words.map(str::to_owned);
        return scheme_named(name, &own.chain(parameters.iter().cloned()).collect::<Vec<_>>());
    }
    if !parameters.is_empty() && Path::new(what).is_file() {
        let source = case::asked(&format!("{what} {}", parameters.join(" ")))?;
        return subject_of_case(&source.name, &source.text);
    }
    if let Some(extra) = parameters.first() {
        return Err(wrong(format!("`{extra}` is a parameter, but only named schemes have parameters")));
    }
    let mask = |texts: &[String], arity, scale| {
        understood(texts, arity, scale).map(|m| Subject::Mask(m, false)).map_err(|e| no_mask("", e))
    };
    if let Some((family, moments)) = Family::named(what).filter(|(_, n)| *n != 1) {
        if (2..=MAX_MOMENTS).contains(&moments) {
            return Ok(Subject::Wavelet(family, moments));
        }
        return Err(wrong(format!("{what} is not known: db1 to db{MAX_MOMENTS} and sym2 to sym{MAX_MOMENTS} are")));
    }
    if let Some(texts) = scheme::wavelet_mask(what) {
        return mask(&texts, 2, None);
    }
    if what.starts_with("bior") || what.starts_with("rbio") {
        return Err(wrong(format!("{what} is not known"))
            .with_help(format!("known are {}", scheme::wavelet_names().join(", "))));
    }
    if what == "-" {
        let source = SourceText::read(Path::new(what))?;
        return match case::is_case(&source.text) {
            true => subject_of_case(&source.name, &source.text),
            false => subject(source.text.trim(), &[], arity),
        };
    }
    if what.starts_with("[[[") {
        return of_read(Case::ask(what)?);
    }
    if what.ends_with(".toml") || Path::new(what).exists() {
        return match std::fs::read_to_string(what) {
            Ok(text) => subject_of_case(what, &text),
            // What cannot be read is said by the reader of cases.
            Err(_) => of_read(Case::read(Path::new(what))?),
        };
    }
    if what.contains('z') {
        let symbol = Laurent::parse(what).map_err(|e| wrong(e.to_string()))?;
        return mask(&symbol_texts(&symbol), arity, None);
    }
    let inner = what.trim_start_matches('[').trim_end_matches(']');
    let blanks = !inner.contains([',', '(', '*', '+']);
    let parts: Vec<&str> = if blanks { inner.split_whitespace().collect() } else { inner.split(',').collect() };
    let texts: Vec<String> = parts.iter().map(|t| t.trim().replace("//", "/")).collect();
    if let [word] = texts.as_slice()
        && word.chars().any(char::is_alphabetic)
    {
        return Err(case::nothing(what));
    }
    mask(&texts, arity, None)
}

fn symbol_texts(symbol: &Laurent) -> Vec<String> {
    symbol.coefficients().iter().map(ToString::to_string).collect()
}

fn scheme_named(name: &str, parameters: &[String]) -> Result<Subject, Problem> {
    let mut values: BTreeMap<String, Rational> = BTreeMap::new();
    for text in parameters {
        let Some((key, value)) = text.split_once('=') else {
            return Err(wrong(format!("`{text}` is not of the form name=value")));
        };
        let value = parse_rational(value).map_err(|e| wrong(e.to_string()))?;
        if values.insert(key.trim().to_owned(), value).is_some() {
            return Err(wrong(format!("`{}` is given twice", key.trim())).with_help("give each parameter one value"));
        }
    }
    match scheme::mask(name, &values).map_err(|e| wrong(e.to_string()))? {
        Some(mask) => Ok(Subject::Mask(given(&mask), false)),
        None => {
            let shape = scheme::build(name, &values).map_err(|e| wrong(e.to_string()))?;
            Ok(Subject::Curve(Box::new(shape)))
        }
    }
}

fn given(mask: &scheme::Mask) -> Understood {
    let filter = Filter::Rational(mask.coefficients().to_vec());
    Understood { filter, arity: mask.arity(), remark: None }
}

/// The mask of a case with one, whether its curve converges or not; otherwise its curve, which must be a model that contracts.
fn subject_of_case(name: &str, text: &str) -> Result<Subject, Problem> {
    let text = &*case::valued(name, text)?;
    if let Some((texts, arity, scale)) = written_mask(text) {
        let points = DeTable::parse(text).is_ok_and(|table| table.get_ref().contains_key("control"));
        let mask = understood(&texts, arity, scale).map_err(|e| no_mask(&format!("{name}: "), e))?;
        return Ok(Subject::Mask(mask, points));
    }
    match Case::parse(name, text) {
        Err(problem) if case::is_over_field(&problem) => {
            let case = over_field(name, text, problem)?;
            contracting(&case)?;
            Ok(Subject::Over(Box::new(case.shape)))
        }
        read => of_read(read?),
    }
}

/// The case over the field of its entries; without an irrational one the problem that was found with it stands.
fn over_field(name: &str, text: &str, problem: Problem) -> Result<Case<Real>, Problem> {
    let case = Case::over_field(name, text)?;
    let irrational = crate::shape::entries(&case.shape).any(|x| x.field().is_some());
    if irrational { Ok(case) } else { Err(problem) }
}

fn of_read(case: Case) -> Result<Subject, Problem> {
    if let Some(Origin::Mask(mask) | Origin::Filter(mask, _)) = &case.scheme {
        return Ok(Subject::Mask(given(mask), case.shape.control.is_some()));
    }
    contracting(&case)?;
    Ok(Subject::Curve(Box::new(case.shape)))
}

/// The coefficients under `[scheme]`, their arity and normalisation, where they are plainly written; whatever is not is left to
/// the reader of cases, which says what is wrong.
fn written_mask(text: &str) -> Option<(Vec<String>, usize, Option<Normalisation>)> {
    let table = DeTable::parse(text).ok()?;
    let DeValue::Table(scheme) = table.get_ref().get("scheme")?.get_ref() else { return None };
    let known = ["mask", "symbol", "filter", "arity", "normalisation", "vertices"];
    if !scheme.keys().all(|k| known.contains(&k.get_ref().as_ref())) {
        return None;
    }
    let word = |key: &str| scheme.get(key).and_then(|v| v.get_ref().as_str());
    let arity = match scheme.get("arity").map(|v| v.get_ref()) {
        None => 2,
        Some(DeValue::Integer(digits)) => usize::from_str_radix(digits.as_str(), digits.radix()).ok()?,
        Some(_) => return None,
    };
    let entry = |v: &DeValue<'_>| match v {
        DeValue::String(s) => Some(s.to_string()),
        DeValue::Integer(digits) if digits.radix() == 10 => Some(digits.as_str().to_owned()),
        DeValue::Float(digits) => Some(digits.as_str().to_owned()),
        _ => None,
    };
    let list = |key: &str| match scheme.get(key)?.get_ref() {
        DeValue::Array(items) => items.iter().map(|v| entry(v.get_ref())).collect::<Option<Vec<_>>>(),
        _ => None,
    };
    match (list("mask"), list("filter"), word("symbol")) {
        (Some(mask), None, None) => Some((mask, arity, Some(Normalisation::Arity))),
        (None, Some(filter), None) => {
            let scale = match word("normalisation")? {
                "arity" => Normalisation::Arity,
                "one" => Normalisation::One,
                "root" => Normalisation::Root,
                _ => return None,
            };
            Some((filter, arity, Some(scale)))
        }
        (None, None, Some(symbol)) => {
            Some((symbol_texts(&Laurent::parse(symbol).ok()?), arity, Some(Normalisation::Arity)))
        }
        _ => None,
    }
}

/// Why the curve of a case contracts.
fn contracting<E: Provable>(case: &Case<E>) -> Result<Contraction, Problem> {
    case.shape.check_curves().map_err(|e| crate::prove::model_problem(case, &e.into()))?;
    let found = crate::theorem::contraction_of(&case.shape).map_err(|e| crate::prove::model_problem(case, &e))?;
    if !found.is_proved() {
        return Err(wrong(format!("{}: contraction is not decided", case.name)));
    }
    Ok(found)
}

/// The smoothness of the curve of a case file with its certificate, accepted by the checker, and the expanded case that the
/// certificate is about where that is not the file itself; of a mask after the table of the mask. Of a mask on a lattice the
/// certificate is about the mask, which need not be in a file.
///
/// # Errors
/// As [`regularity`]; where the input is no case file, and where there is no certificate.
pub fn certified_regularity(
    what: &str,
    parameters: &[String],
    arity: usize,
    dilation: Option<&str>,
) -> Result<(Smooth, String, Option<String>), Problem> {
    if let Some(case) = plain_border(what, parameters, dilation)? {
        return border_certified(case);
    }
    if let Some(case) = lattice_case(what, parameters, dilation)? {
        return lattice_certified(case);
    }
    if !what.ends_with(".toml") && !Path::new(what).is_file() {
        return Err(Problem::new("secant::regularity", format!("{what} is no case file, which a certificate is about"))
            .with_help("write the case first: `secant schemes NAME > FILE.toml`, or `secant expand`; of wavelets db2 and db3 are written so, the others have no certificates"));
    }
    let source = match parameters {
        [] => SourceText::read(Path::new(what))?,
        set => case::asked(&format!("{what} {}", set.join(" ")))?,
    };
    let mask = || regularity(what, parameters, arity);
    match Case::parse(&source.name, &source.text) {
        Err(problem) if case::is_over_field(&problem) => {
            let case = over_field(&source.name, &source.text, problem)?;
            let (smooth, certificate) = certified_curve(&case, mask)?;
            Ok((smooth, certificate, case.flat))
        }
        read => {
            let case = read?;
            let (smooth, certificate) = certified_curve(&case, mask)?;
            let beside = case.beside();
            Ok((smooth, certificate, beside))
        }
    }
}

/// The smoothness of the curve of a case, after that of its mask where it has one, and the certificate about the curve.
fn certified_curve<E: Written>(
    case: &Case<E>,
    mask: impl FnOnce() -> Result<Smooth, Problem>,
) -> Result<(Smooth, String), Problem> {
    let contraction = contracting(case)?;
    let (smooth, found, spaces) = of_curve(&case.shape)?;
    let nothing = |e: String| wrong(e).with_help("see docs/certificate.md; no certificate was written");
    let certificate = crate::certificate::regularity_certificate(case, &spaces, &contraction, &found);
    let certificate = certificate
        .map_err(|e| nothing(e.to_string()))
        .and_then(|c| crate::certificate::checked(&E::text(case), c).map_err(|e| nothing(e.to_string())))?;
    if !matches!(case.scheme, Some(Origin::Mask(_) | Origin::Filter(..))) {
        return Ok((smooth, certificate.text()));
    }
    let mask = mask()?;
    let text = format!("{}\nThe certificate is about the curve:\n{}", mask.text, smooth.text);
    Ok((Smooth { text, ..mask }, certificate.text()))
}
