//! `secant regularity`.

use super::files::Written;
use super::output::{complain, print, settle};
use super::{BAD_INPUT, PROVED, RegularityArgs, UNDETERMINED};
use crate::ask::{Smooth, certified_regularity, dilated_regularity};
use crate::diagnostic::Problem;
use serde_json::{Value, json};
use std::path::Path;

/// Prints the regularity of schemes, curves or scaling functions.
pub fn run(args: &RegularityArgs) -> u8 {
    let inputs = inputs(args);
    let [(what, parameters)] = inputs.as_slice() else { return settle(many(args, &inputs)) };
    let mut written = Written::default();
    let answer = match &args.certificate {
        Some(path) => certified(what, parameters, args, path, &mut written),
        None => dilated_regularity(what, parameters, args.arity, args.dilation.as_deref()),
    };
    settle(answer.map(|a| {
        print(&shown(args, what, &a));
        written.code(if a.decided { PROVED } else { UNDETERMINED })
    }))
}

/// The inputs, each with the parameters behind it.
fn inputs(args: &RegularityArgs) -> Vec<(String, Vec<String>)> {
    let mut list = vec![(args.what.trim().to_owned(), Vec::new())];
    for text in &args.more {
        let text = text.trim();
        match list.last_mut() {
            Some((_, parameters)) if super::question::is_parameter(text) && !Path::new(text).exists() => {
                parameters.push(text.to_owned())
            }
            _ => list.push((text.to_owned(), Vec::new())),
        }
    }
    list
}

fn shown(args: &RegularityArgs, what: &str, answer: &Smooth) -> String {
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
        return Err(Problem::new("secant::regularity", "--certificate is for one case")
            .with_help("write the certificates one by one"));
    }
    let (mut code, mut list) = (PROVED, Vec::new());
    for (what, parameters) in inputs {
        let made = dilated_regularity(what, parameters, args.arity, args.dilation.as_deref());
        let answer = made.unwrap_or_else(|problem| {
            code = BAD_INPUT;
            if !args.json && !args.jsonl {
                complain(&problem);
            }
            let data = json!({"error": problem.message(), "help": problem.remedy()});
            Smooth { text: format!("error       {}\n", problem.message()), data, decided: true }
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

/// The answer for a case file, whose certificate is written; where there is none the answer without it.
fn certified(
    what: &str,
    parameters: &[String],
    args: &RegularityArgs,
    path: &Path,
    written: &mut Written,
) -> Result<Smooth, Problem> {
    match certified_regularity(what, parameters, args.arity, args.dilation.as_deref()) {
        Ok((smooth, certificate, beside)) => {
            written.certificate(Some(path), || Ok((certificate, beside)));
            Ok(smooth)
        }
        Err(problem) => {
            let smooth = dilated_regularity(what, parameters, args.arity, args.dilation.as_deref())?;
            written.done(Err(problem));
            Ok(smooth)
        }
    }
}
