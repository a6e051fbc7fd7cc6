//! `secant region`.

use super::files::Written;
use super::output::{print, settle, shown};
use super::progress::Progress;
use super::question::effort;
use super::{PROVED, REFUTED, UNDETERMINED};
use crate::answer::Verdict;
use crate::arith::{Rational, parse_rational};
use crate::ask::{Asked, DEPTH, Family, MAX_DEPTH};
use crate::budget::{Budget, Effort};
use crate::case::{Valences, setting};
use crate::diagnostic::Problem;
use crate::radius::family::Search;
use crate::report::document::Document;
use crate::report::{html, latex, markdown};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct RegionArgs {
    /// A case file with `[parameters]` and a mask, maps, operators or a `[vertex]` table, or the name of a scheme, with the range of its parameter behind it, as in
    /// `four-point w=-1/2..1/2`.
    #[arg(value_name = "CASE")]
    pub(super) what: String,
    /// A range or a value of a parameter, instead of what the file says.
    #[arg(value_name = "NAME=FROM..TO|NAME=VALUE")]
    parameters: Vec<String>,
    /// The same.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The highest order of smoothness of masks that is asked about; without it all that the sum rules allow.
    #[arg(long, value_name = "K")]
    order: Option<usize>,
    /// The valences of a case about vertices, in the place of those of the file: 5, 3..12 or 3,5,8.
    #[arg(long, value_name = "LIST", value_parser = Valences::parse)]
    valence: Option<Valences>,
    /// With two parameters: how often the plane is halved in both directions, at most 10; 7 without it.
    #[arg(long, value_name = "COUNT")]
    depth: Option<usize>,
    /// No progress bar.
    #[arg(long, short)]
    quiet: bool,
    /// Gaps that are narrower are left.
    #[arg(long, value_name = "WIDTH", value_parser = width, default_value = "1e-6")]
    width: Rational,
    /// Hulls that may be tried for each order.
    #[arg(long, value_name = "COUNT")]
    hulls: Option<usize>,
    /// How much is tried: quick, normal or hard.
    #[arg(long, value_name = "EFFORT", value_parser = effort, default_value = "normal")]
    effort: Effort,
    /// Search for about this long, and no longer. Without it a fixed amount of work is spent, so that the same case gives the
    /// same bytes.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "effort")]
    time: Option<f64>,
    /// Print data (docs/json.md).
    #[arg(long)]
    json: bool,
    /// Write the tables with the statements to a file: .html, .md or .tex.
    #[arg(long, value_name = "FILE")]
    pub(super) report: Option<PathBuf>,
    /// Draw a bar for each order, claim or valence, or the plane of two parameters, coloured by verdict.
    #[arg(long, value_name = "FILE")]
    pub(super) svg: Option<PathBuf>,
    /// Write a certificate that secant-check proves again (docs/certificate.md), and the family beside it.
    #[arg(long, value_name = "FILE")]
    pub(super) certificate: Option<PathBuf>,
}

fn width(text: &str) -> Result<Rational, String> {
    let width = parse_rational(text).map_err(|e| e.to_string())?;
    if width > 0 { Ok(width) } else { Err("a positive number is needed".to_owned()) }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("a positive number of seconds is needed".to_owned()),
    }
}

/// Prints the regions of a scheme.
pub fn run(args: &RegionArgs) -> u8 {
    settle(answered(args))
}

fn answered(args: &RegionArgs) -> Result<u8, Problem> {
    let render = args.report.as_deref().map(format_of).transpose()?;
    let set = args.parameters.iter().chain(&args.set).map(|t| setting(t)).collect::<Result<Vec<_>, _>>()?;
    let mut search = Search { width: args.width.clone(), ..Budget::of(args.effort).regions };
    if let Some(seconds) = args.time {
        search = search.within(seconds);
    }
    search.hulls = args.hulls.unwrap_or(search.hulls);
    let asked = Asked { order: args.order, valences: args.valence.clone(), depth: args.depth };
    let bar = Progress::of(1 << (2 * args.depth.unwrap_or(DEPTH).min(MAX_DEPTH)), "boxes", args.quiet);
    let step = |count| bar.advance(count);
    let found = Family::ask(&args.what, &set, &asked, &search, &Budget::of(args.effort), &step);
    bar.finish();
    let found = found?;
    let written = files(args, &found, render);
    if args.json {
        print(&format!("{:#}\n", found.data()));
    } else {
        print(&shown(&found.document()));
    }
    Ok(written.code(match found.verdict() {
        Verdict::Proved => PROVED,
        Verdict::Refuted => REFUTED,
        Verdict::Undetermined => UNDETERMINED,
    }))
}

fn files(args: &RegionArgs, found: &Family, render: Option<fn(&Document) -> String>) -> Written {
    let mut written = Written::default();
    let report = args.report.as_deref().zip(render);
    written.file(report.map(|r| r.0), |_| Ok(report.map(|r| r.1(&found.report())).unwrap_or_default()));
    written.file(args.svg.as_deref(), |_| {
        found.svg().ok_or_else(|| Problem::new("secant::region", "there is nothing to draw"))
    });
    written.certificate(args.certificate.as_deref(), || found.certificate().map(|(text, family)| (text, Some(family))));
    written
}

/// The writer of a report that its ending names.
fn format_of(path: &Path) -> Result<fn(&Document) -> String, Problem> {
    match path.extension().and_then(|e| e.to_str()) {
        Some("html") => Ok(html::render),
        Some("md") => Ok(markdown::render),
        Some("tex") => Ok(latex::render),
        _ => Err(Problem::new("secant::usage::report", format!("no format is known for {}", path.display()))
            .with_help("the ending of --report says the format: .html, .md or .tex")),
    }
}
