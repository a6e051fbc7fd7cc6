//! `secant regularity`.

use super::output::{complain, print, settle, write_certificate};
use super::{BAD_INPUT, PROVED, RegularityArgs, UNDETERMINED};
use crate::arith::{Rational, parse_rational};
use crate::case::{Case, Origin};
use crate::diagnostic::{Problem, SourceText};
use crate::radius::Options;
use crate::report::regularity as report;
use crate::report::regularity::Meaning;
use crate::scheme::{self, Laurent, Normalisation};
use crate::shape::{Contraction, Shape, Spaces};
use crate::theorem::enclosed::enclosed;
use crate::theorem::filter::{Filter, Understood, understood};
use crate::theorem::regularity;
use crate::theorem::smoothness::curve_regularity;
use crate::theorem::wavelet::{MAX_MOMENTS, wavelet};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// What is asked about.
enum Subject {
    Wavelet(usize),
    Mask(Understood),
    Curve(Box<Shape>),
}

/// An answer in both forms, and whether it decides something.
struct Answer {
    text: String,
    data: Value,
    decided: bool,
}

/// Prints the regularity of schemes, curves or scaling functions.
pub fn run(args: &RegularityArgs) -> u8 {
    let inputs = inputs(args);
    let [(what, parameters)] = inputs.as_slice() else { return settle(many(args, &inputs)) };
    let answer = match &args.certificate {
        Some(path) => certified(what, parameters, args, path),
        None => subject(what, parameters, args.arity).and_then(|s| answer(what, &s)),
    };
    settle(answer.map(|a| {
        print(&shown(args, what, &a));
        if a.decided { PROVED } else { UNDETERMINED }
    }))
}

/// The inputs, each with the parameters behind it.
fn inputs(args: &RegularityArgs) -> Vec<(String, Vec<String>)> {
    let mut list = vec![(args.what.trim().to_owned(), Vec::new())];
    for text in &args.more {
        let text = text.trim();
        match list.last_mut() {
            Some((_, parameters)) if super::is_parameter(text) && !Path::new(text).exists() => {
                parameters.push(text.to_owned())
            }
            _ => list.push((text.to_owned(), Vec::new())),
        }
    }
    list
}

fn shown(args: &RegularityArgs, what: &str, answer: &Answer) -> String {
    match (args.json, args.jsonl) {
        (true, _) => format!("{:#}\n", named(what, answer.data.clone())),
        (_, true) => format!("{}\n", named(what, answer.data.clone())),
        _ => answer.text.clone(),
    }
}

/// The data with the input before them.
fn named(what: &str, data: Value) -> Value {
    let mut whole = serde_json::Map::from_iter([("input".to_owned(), json!(what))]);
    if let Value::Object(fields) = data {
        whole.extend(fields);
    }
    Value::Object(whole)
}

/// Several inputs: one that cannot be read takes no others with it.
fn many(args: &RegularityArgs, inputs: &[(String, Vec<String>)]) -> Result<u8, Problem> {
    if args.certificate.is_some() {
        return Err(wrong("--certificate is for one case".to_owned()).with_help("write the certificates one by one"));
    }
    let (mut code, mut list) = (PROVED, Vec::new());
    for (what, parameters) in inputs {
        let made = subject(what, parameters, args.arity).and_then(|s| answer(what, &s));
        let answer = made.unwrap_or_else(|problem| {
            code = BAD_INPUT;
            if !args.json && !args.jsonl {
                complain(&problem);
            }
            let data = json!({"error": problem.message(), "help": problem.remedy()});
            Answer { text: format!("error       {}\n", problem.message()), data, decided: true }
        });
        if !answer.decided && code == PROVED {
            code = UNDETERMINED;
        }
        if args.json {
            list.push(named(what, answer.data));
        } else if args.jsonl {
            print(&shown(args, what, &answer));
        } else {
            let head = parameters.iter().fold(what.clone(), |s, p| format!("{s} {p}"));
            print(&format!("== {head}\n{}\n", answer.text));
        }
    }
    if args.json {
        print(&format!("{:#}\n", Value::Array(list)));
    }
    Ok(code)
}

fn wrong(message: String) -> Problem {
    Problem::new("secant::regularity", message).with_help(
        "name a case file, a scheme of `secant schemes`, a wavelet such as db2, haar or bior2.2, or write a mask as in \
         \"1/4,3/4,3/4,1/4\" or a symbol as in \"(1+z)^3/4\"",
    )
}

fn answer(what: &str, subject: &Subject) -> Result<Answer, Problem> {
    let options = Options::default();
    match subject {
        Subject::Wavelet(moments) => {
            let found = wavelet(*moments, &options);
            let found = found.ok_or_else(|| wrong(format!("no bounds were found for db{moments}")))?;
            let title = format!(
                "Daubechies' scaling function with {moments} vanishing moments: a(z) = (1+z)^{moments} b(z), b = 2^{} q",
                1 - i64::try_from(*moments).map_err(|e| wrong(e.to_string()))?
            );
            let text = report::enclosed(&title, &found, Meaning::Limit);
            Ok(Answer { text, data: report::enclosed_data(&found, Meaning::Limit), decided: true })
        }
        Subject::Mask(mask) => of_mask(what, mask, &options),
        Subject::Curve(shape) => {
            let spaces = Spaces::new(shape).ok_or_else(|| wrong("a fixed point is not unique".to_owned()))?;
            let found = curve_regularity(shape, &spaces, &options).map_err(|e| wrong(e.to_string()))?;
            let decided = found.exponent.is_some() || found.polynomial;
            let text = report::curve_regularity(shape, &found);
            Ok(Answer { text, data: report::curve_data(shape, &found), decided })
        }
    }
}

fn of_mask(what: &str, mask: &Understood, options: &Options) -> Result<Answer, Problem> {
    let remark = mask.remark.as_ref().map(|r| report::remark(r, mask.arity));
    let noted = |text: String, mut data: Value, decided| {
        data["remark"] = json!(remark);
        let head = remark.as_ref().map_or_else(String::new, |r| format!("note        {r}\n"));
        Answer { text: head + &text, data, decided }
    };
    let enclosures = match &mask.filter {
        Filter::Rational(coefficients) => {
            let found = regularity::regularity(coefficients, mask.arity, options);
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
        Filter::Near(near) => (format!("mask        near {what}"), Meaning::Near(near)),
        Filter::Rational(_) => return Err(wrong("a rational mask has no enclosures".to_owned())),
    };
    let decided = found.exponent.lo > 0 || found.exponent.hi <= 0;
    Ok(noted(report::enclosed(&title, &found, meaning), report::enclosed_data(&found, meaning), decided))
}

fn subject(what: &str, parameters: &[String], arity: usize) -> Result<Subject, Problem> {
    if scheme::list().iter().any(|s| s.name == what) {
        return scheme_named(what, parameters);
    }
    if let Some(extra) = parameters.first() {
        return Err(wrong(format!("`{extra}` is a parameter, but only named schemes have parameters")));
    }
    let mask = |texts: &[String], arity, scale| {
        understood(texts, arity, scale).map(Subject::Mask).map_err(|e| wrong(e.to_string()))
    };
    if let Some(texts) = scheme::wavelet_mask(what) {
        return mask(&texts, 2, None);
    }
    if let Some(moments) = what.strip_prefix("db").and_then(|n| n.parse::<usize>().ok()) {
        if (2..=MAX_MOMENTS).contains(&moments) {
            return Ok(Subject::Wavelet(moments));
        }
        return Err(wrong(format!("{what} is not known: db1 to db{MAX_MOMENTS} are")));
    }
    if what.starts_with("bior") || what.starts_with("rbio") {
        return Err(wrong(format!("{what} is not known"))
            .with_help(format!("known are {}", scheme::wavelet_names().join(", "))));
    }
    if what == "-" {
        let source = SourceText::read(Path::new("-"))?;
        let is_case = source.text.contains("name") && source.text.contains('=');
        return if is_case {
            of_case(Case::parse(&source.name, &source.text)?)
        } else {
            subject(source.text.trim(), &[], arity)
        };
    }
    if what.starts_with("[[[") {
        return of_case(Case::ask(what)?);
    }
    if what.ends_with(".toml") || Path::new(what).is_file() {
        return case(Path::new(what));
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
        return Err(crate::case::nothing(what));
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
        values.insert(key.trim().to_owned(), parse_rational(value).map_err(|e| wrong(e.to_string()))?);
    }
    match scheme::mask(name, &values).map_err(|e| wrong(e.to_string()))? {
        Some(mask) => Ok(Subject::Mask(given(&mask))),
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
fn case(path: &Path) -> Result<Subject, Problem> {
    if let Some((texts, arity, scale)) = written_mask(path) {
        return understood(&texts, arity, scale)
            .map(Subject::Mask)
            .map_err(|e| wrong(format!("{}: {e}", path.display())));
    }
    of_case(Case::read(path)?)
}

fn of_case(case: Case) -> Result<Subject, Problem> {
    if let Some(Origin::Mask(mask)) = &case.scheme {
        return Ok(Subject::Mask(given(mask)));
    }
    contracting(&case)?;
    Ok(Subject::Curve(Box::new(case.shape)))
}

/// The coefficients under `[scheme]`, their arity and normalisation, where they are plainly written; whatever is not is left to
/// the reader of cases, which says what is wrong.
fn written_mask(path: &Path) -> Option<(Vec<String>, usize, Option<Normalisation>)> {
    let text = std::fs::read_to_string(path).ok()?;
    let table = DeTable::parse(&text).ok()?;
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
fn contracting(case: &Case) -> Result<Contraction, Problem> {
    case.shape.check_curves().map_err(|e| crate::prove::model_problem(case, &e.into()))?;
    let found = crate::theorem::contraction_of(&case.shape).map_err(|e| crate::prove::model_problem(case, &e))?;
    if !found.is_proved() {
        return Err(wrong(format!("{}: contraction is not decided", case.name)));
    }
    Ok(found)
}

/// Writes the certificate of a curve, and gives its table; of a mask after the table of the mask.
fn certified(what: &str, parameters: &[String], args: &RegularityArgs, path: &Path) -> Result<Answer, Problem> {
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
    let data = report::curve_data(shape, &found);
    if matches!(case.scheme, Some(Origin::Mask(_))) {
        let mask = subject(what, parameters, args.arity).and_then(|s| answer(what, &s))?;
        let text = format!("{}\nThe certificate is about the curve:\n{own}", mask.text);
        return Ok(Answer { text, data: mask.data, decided: mask.decided });
    }
    Ok(Answer { text: own, data, decided })
}
