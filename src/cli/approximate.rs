//! `secant certify --approx`: the float fallback, always labelled approximate, never exit code 0.

use super::certify::json_text;
use super::many::gravest;
use super::output::{complain, print, problem_code, shown};
use super::{CertifyArgs, UNDETERMINED};
use crate::approx::{PointLook, look};
use crate::case::{Case, Question};
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::report::document::{Block, Document, Inline, Tone, code, words};
use crate::report::json;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// Looks at every case in floating point.
pub fn run(args: &CertifyArgs) -> u8 {
    let mut worst = UNDETERMINED;
    for path in &args.cases {
        match guarded(|| one(path, args)) {
            Ok((case, seen)) if args.json || args.jsonl => print(&json_text(&value(&case, &seen), args.json)),
            Ok((case, seen)) if !args.quiet => print(&shown(&document(&case, &seen))),
            Ok(_) => {}
            Err(problem) => {
                complain(&problem);
                worst = gravest([worst, problem_code(&problem)].into_iter());
            }
        }
    }
    worst
}

fn one(path: &Path, args: &CertifyArgs) -> Result<(Arc<Case>, Vec<PointLook>), Problem> {
    let Question::Tangents { case, further } = super::question::question(path, args)? else {
        return Err(Problem::new("secant::usage", "--approx is for rational entries, and not for vertices of a mesh")
            .with_help("without it the answer is exact; --json and --report hold the evidence"));
    };
    let addresses = [case.examine.as_slice(), &further].concat();
    let seen = look(&case.shape, &addresses).ok_or_else(|| {
        let message = "an operator has no unique fixed point, so that there is no point to look at";
        case.problem_at_state(case.shape.start, "secant::approx", message, "the system does not contract")
    })?;
    Ok((case, seen))
}

fn document(case: &Case, seen: &[PointLook]) -> Document {
    let warning = "approximate: floating point, no proof, no verdict".to_owned();
    let mut blocks = vec![Block::Paragraph(vec![Inline::Mark(Tone::Open, warning)])];
    for point in seen {
        let mut facts = vec![
            ("address".to_owned(), code(point.address.to_string())),
            ("point".to_owned(), words(format!("≈ {}", tuple(&point.position)))),
        ];
        let values: Vec<String> = point.eigenvalues.iter().map(|&(re, im)| complex(re, im)).collect();
        facts.push(("eigenvalues".to_owned(), words(format!("≈ {}", values.join(", ")))));
        let direction = match &point.direction {
            Some(d) => format!("secants seem to turn to ± {}", tuple(d)),
            None => format!("secants do not seem to agree (sine of the largest angle ≈ {:.3})", point.spread),
        };
        facts.push(("direction".to_owned(), words(direction)));
        blocks.push(Block::heading(3, "Point"));
        blocks.push(Block::Facts(facts));
    }
    Document { title: format!("{} (approximate)", case.name), blocks }
}

fn tuple(v: &[f64]) -> String {
    let parts: Vec<String> = v.iter().map(|&x| real(x)).collect();
    format!("({})", parts.join(", "))
}

fn real(x: f64) -> String {
    let text = format!("{x:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

fn complex(re: f64, im: f64) -> String {
    if im.abs() < 1e-12 {
        return real(re);
    }
    let sign = if im < 0.0 { '−' } else { '+' };
    format!("{} {sign} {} i", real(re), real(im.abs()))
}

fn value(case: &Case, seen: &[PointLook]) -> Value {
    let points: Vec<Value> = seen
        .iter()
        .map(|p| {
            json!({
                "address": p.address.to_string(),
                "position": p.position,
                "eigenvalues": p.eigenvalues.iter().map(|(re, im)| json!({ "re": re, "im": im })).collect::<Vec<_>>(),
                "direction": p.direction,
                "spread": p.spread,
            })
        })
        .collect();
    json!({
        "version": json::VERSION,
        "case": case.name,
        "verdict": "undetermined",
        "approximate": true,
        "points": points,
    })
}
