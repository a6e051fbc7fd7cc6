//! `secant certify` of a case about the vertices of a mesh.

use super::CertifyArgs;
use super::certify::{exit_code, extension, json_text, rejected};
use super::output::{print, settle, stdout_colour, write_file};
use super::progress::{Progress, Waiting};
use crate::case::{Valences, VertexCase};
use crate::certificate::{Certificate, confirm_vertices, vertex_certificate};
use crate::diagnostic::Problem;
use crate::picture::characteristic::sheet;
use crate::report::proof::vertex_document;
use crate::report::{html, latex, markdown, text, vertex as report};
use crate::scheme::SchemeError;
use crate::vertex::{AtValence, Every, at_valence, every};
use rayon::prelude::*;
use std::path::Path;

/// Whether a file has a `[vertex]` table.
pub fn is_about_vertices(path: &Path) -> bool {
    path.as_os_str() != "-"
        && std::fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() <= crate::case::MAX_BYTES as u64)
        && std::fs::read_to_string(path).is_ok_and(|text| VertexCase::is_one(&text))
}

/// Certifies every valence that was asked for.
pub fn run(path: &Path, args: &CertifyArgs) -> u8 {
    settle(certified(path, args))
}

fn certified(path: &Path, args: &CertifyArgs) -> Result<u8, Problem> {
    if !args.address.is_empty() || args.approx {
        return Err(Problem::new("secant::usage", "--address and --approx are not for vertices of a mesh")
            .with_help("--json and --report hold the evidence: signs, half-planes, winding numbers"));
    }
    let case = VertexCase::read(path)?;
    let asked = valences(&case, args.valence.as_deref())?;
    let (mut found, every) = at(&case, &asked, args.quiet)?;
    let every = every.as_ref();
    let certificate = if args.no_check { vertex_certificate(&case, &found) } else { confirmed(&case, &mut found)? };
    let certified = certificate_file(args, certificate.as_ref())?;
    let reported = args.report.as_deref().map(|path| {
        let document = vertex_document(&case, &found, every);
        let written = match extension(path).as_str() {
            "md" => markdown::render(&document),
            "tex" => latex::render(&document),
            _ => html::render(&document),
        };
        (path, written)
    });
    let drawn = args.svg.as_deref().map(|path| {
        let panels: Vec<_> = found.iter().filter_map(report::panel).collect();
        (path, sheet(&panels, &case.title))
    });
    for (path, content) in reported.into_iter().chain(drawn).chain(certified) {
        write_file(path, &content)?;
    }
    if !args.quiet {
        let shown = if args.json || args.jsonl {
            json_text(&report::json(&case, &found, every), args.json)
        } else {
            text::render(&report::document(&case, &found, every, args.verbose), stdout_colour())
        };
        print(&shown);
    }
    Ok(exit_code(report::overall(&found, every)))
}

/// Has the verdicts proved again by the independent checker where the certificate format has rules for them.
///
/// # Errors
/// The [`Problem`] of a certificate that the checker does not accept.
pub fn confirmed(case: &VertexCase, found: &mut [AtValence]) -> Result<Option<Certificate>, Problem> {
    confirm_vertices(case, found).map_err(|doubt| rejected(&case.name, &doubt))
}

/// The certificate as a file, where one is asked for.
fn certificate_file<'a>(
    args: &'a CertifyArgs,
    certificate: Option<&Certificate>,
) -> Result<Option<(&'a Path, String)>, Problem> {
    let Some(path) = args.certificate.as_deref() else { return Ok(None) };
    match certificate {
        Some(certificate) => Ok(Some((path, certificate.text()))),
        None => {
            Err(Problem::new("secant::certificate::none", "no rule of the certificate format covers these vertices")
                .with_help("see docs/certificate.md, “What is not covered”; nothing was written"))
        }
    }
}

/// What is found at the valences that were asked for; for all of them, the common proof and the small ones it leaves out.
///
/// # Errors
/// A [`Problem`] where the scheme has no such vertex, or no common proof is known.
pub fn at(case: &VertexCase, asked: &Valences, quiet: bool) -> Result<(Vec<AtValence>, Option<Every>), Problem> {
    match asked {
        Valences::List(list) => Ok((examine(case, list, quiet)?, None)),
        Valences::All => {
            let every = all_at_once(case, quiet)?;
            let rest: Vec<usize> = (3..every.from).collect();
            Ok((examine(case, &rest, quiet)?, Some(every)))
        }
    }
}

/// The proof for all valences from some valence on.
fn all_at_once(case: &VertexCase, quiet: bool) -> Result<Every, Problem> {
    let waiting = Waiting::new(quiet);
    let found = every(&case.rule);
    waiting.finish();
    let found = found
        .map_err(|error| Problem::new("secant::scheme", format!("{}: {error}", case.name)).with_source(&case.text))?;
    found.ok_or_else(|| {
        Problem::new(
            "secant::usage::valence",
            format!("no proof for all valences at once is known for {}", case.scheme),
        )
        .with_help(
            "there is one for catmull-clark, loop, loop-warren, doo-sabin, doo-sabin-catmull-clark and midedge; give a \
                 range such as --valence 3..32",
        )
    })
}

/// The valences asked for by the option, or by the case itself.
///
/// # Errors
/// A [`Problem`] where there are none, or the option is not understood.
pub fn valences(case: &VertexCase, option: Option<&str>) -> Result<Valences, Problem> {
    match (option, &case.valences) {
        (Some(text), _) => Valences::parse(text).map_err(|error| {
            Problem::new("secant::usage::valence", error)
                .with_help("write --valence 5, --valence 3..32 (both ends included), --valence 3,5,8 or --valence all")
        }),
        (None, Some(list)) => Ok(list.clone()),
        (None, None) => Err(Problem::new("secant::usage::valence", "no valence is given")
            .with_help("add --valence 3..32, or a line such as  valence = \"3..32\"  to the [vertex] table")),
    }
}

fn examine(case: &VertexCase, list: &[usize], quiet: bool) -> Result<Vec<AtValence>, Problem> {
    let progress = Progress::new(list.len(), quiet);
    let found: Vec<Result<AtValence, SchemeError>> = list
        .par_iter()
        .map(|n| {
            let found = at_valence(&case.rule, *n);
            progress.step();
            found
        })
        .collect();
    progress.finish();
    let mut all = Vec::new();
    for (n, result) in list.iter().zip(found) {
        all.push(result.map_err(|error| {
            Problem::new("secant::scheme", format!("{} at valence {n}: {error}", case.name)).with_source(&case.text)
        })?);
    }
    Ok(all)
}
