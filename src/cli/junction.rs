//! `secant junction`: an intermediate curve between two schemes; with `--surface` see `junction_surface`.

use super::certify::{json_text, known_format, rendered};
use super::files::Written;
use super::output::{print, settle};
use super::progress::Waiting;
use super::{PROVED, REFUTED};
use crate::algebraic::Root;
use crate::arith::{Rational, parse_rational};
use crate::budget::Budget;
use crate::case::Question;
use crate::diagnostic::Problem;
use crate::junction::{Attempt, Found, JunctionError, Member, Pattern, PointOrder, Side, Wish, row_text, search};
use crate::linalg::Matrix;
use crate::prove::prove;
use crate::report::proof::Level;
use crate::scheme::{Heading, complex_text};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub struct JunctionArgs {
    /// Two curve schemes: names with parameters (bspline degree=2), masks, symbols or case files of a single state; also
    /// quadratic, cubic, quintic, chaikin and six-point.
    #[arg(required = true, value_name = "SCHEME")]
    pub(super) schemes: Vec<String>,
    /// The pieces of the intermediate curve, as in a,I,b; by default the shortest that has room.
    #[arg(long, value_name = "PATTERN")]
    pattern: Option<String>,
    /// The number of points of the intermediate curve; by default those of its two ends.
    #[arg(long, value_name = "COUNT")]
    points: Option<usize>,
    /// Move a slider, as in tau1=1/10; tau moves all of them.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// A free row of your own, as in "0,1/4,3/16,1/2,1/16"; give as many as are free (needs --pattern).
    #[arg(long, value_name = "ROW", allow_hyphen_values = true)]
    row: Vec<String>,
    /// Put the intermediate curve on the points of its pieces, so many times, which leaves more free rows to change.
    #[arg(long, value_name = "STEPS", default_value_t = 0, conflicts_with = "surface")]
    inside: usize,
    /// Control points of the joined shape for the case that is written, as in "0,0; 1,2; 3,3".
    #[arg(long, value_name = "POINTS", allow_hyphen_values = true)]
    pub(super) control: Option<String>,
    /// Join face schemes: doo-sabin, catmull-clark, products such as "quadratic x four-point" (the first across the border), or cases
    /// of such products.
    #[arg(long)]
    pub(super) surface: bool,
    /// Of a surface, take the stencils of least weighted norm instead of products of rows.
    #[arg(long, requires = "surface", conflicts_with_all = ["row", "stencil"])]
    pub(super) least: bool,
    /// Of a surface, a free stencil of your own on the points of the edge across the border; give as many as are free (needs --pattern).
    #[arg(long, value_name = "STENCIL", requires = "surface", allow_hyphen_values = true, conflicts_with = "row")]
    pub(super) stencil: Vec<String>,
    /// Of a surface, control points over its positions, by their heights, as in "0, 0, 1, …".
    #[arg(long, value_name = "NUMBERS", requires = "surface", allow_hyphen_values = true, conflicts_with = "control")]
    pub(super) heights: Option<String>,
    /// The name of the case.
    #[arg(long, default_value = "junction")]
    pub(super) name: String,
    /// Write the joined shape as a case.
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Certify the joined shape and write the proof: .html, .md or .tex.
    #[arg(long, value_name = "FILE")]
    pub(super) report: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    pub(super) json: bool,
    /// Print nothing but problems.
    #[arg(short, long, conflicts_with = "json")]
    pub(super) quiet: bool,
}

/// Joins two schemes, prints the member that was found and writes its case.
pub fn run(args: &JunctionArgs) -> u8 {
    let waiting = Waiting::with("joining …", args.quiet);
    let answer = if args.surface { super::junction_surface::answer } else { answer };
    let done = args.report.as_deref().map_or(Ok(()), known_format).and_then(|()| answer(args));
    waiting.finish();
    settle(done.map(|(passes, shown, written)| {
        if args.json || !args.quiet {
            print(&shown);
        }
        written.code(if passes { PROVED } else { REFUTED })
    }))
}

/// Whether a member passes, and what is printed of it; its case and proof are written.
fn answer(args: &JunctionArgs) -> Result<(bool, String, Written), Problem> {
    let example = "bspline degree=2 four-point  or with quotation marks around each scheme";
    let names = both(&args.schemes, example)?;
    let sides = [side(&names[0])?, side(&names[1])?];
    let mut found = search(&sides[0], &sides[1], &wish(args)?).map_err(|e| refused(&e))?;
    for _ in 0..args.inside {
        found.member = found.member.map(|m| m.refined_inside()).transpose().map_err(|e| refused(&e))?;
    }
    let mut written = Written::default();
    if let Some(member) = &found.member {
        keep(&case(member, &names, args)?, args, &mut written);
    }
    let shown = if args.json { json_text(&data(&found, &sides), true) } else { text(&found, &sides) };
    Ok((found.member.is_some(), shown, written))
}

/// Writes the case and its proof where that was asked for.
pub(super) fn keep(case: &str, args: &JunctionArgs, written: &mut Written) {
    written.file(args.report.as_deref(), |path| report(case, path));
    written.file(args.output.as_deref(), |_| Ok(case));
}

/// The two schemes that are joined, each with the parameters behind it.
pub(super) fn both(words: &[String], example: &str) -> Result<[String; 2], Problem> {
    schemes(words).try_into().map_err(|names: Vec<String>| {
        let message = format!("{} schemes are given, but a junction has two", names.len());
        Problem::new("secant::usage::junction", message).with_help(format!("as in  secant junction {example}"))
    })
}

/// The schemes, each with the parameters behind it.
fn schemes(words: &[String]) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    for word in words {
        match list.last_mut() {
            Some(last) if word.contains('=') && !Path::new(word).exists() && !word.contains(' ') => {
                last.push(' ');
                last.push_str(word);
            }
            _ => list.push(word.clone()),
        }
    }
    list
}

/// A side by what somebody writes for a scheme.
pub(super) fn side(text: &str) -> Result<Side, Problem> {
    let meant = match text {
        "quadratic" | "chaikin" => "bspline degree=2",
        "cubic" => "bspline degree=3",
        "quintic" => "bspline degree=5",
        "six-point" => "dubuc-deslauriers points=6",
        other => other,
    };
    match Question::ask(meant)? {
        Question::Tangents { case, .. } => Side::of(text, &case.shape).map_err(|e| refused(&e).with_source(&case.text)),
        _ => Err(refused(&JunctionError::NotOneCurve(text.to_owned()))),
    }
}

/// What a junction or a refinement refuses, with a way to mend it.
pub(super) fn refused(error: &JunctionError) -> Problem {
    let help = match error {
        JunctionError::NotOneCurve(_) => "surfaces, sets and automata of several states cannot be sides",
        JunctionError::NoCurve { .. } => "`secant certify` says more about it",
        JunctionError::Pattern(_) => "write --pattern a,a,I,b for I -> a, a, I, b",
        JunctionError::Points { .. } | JunctionError::Contradiction { .. } => {
            "leave --points out for all points of both ends, or take a longer --pattern"
        }
        JunctionError::Rows(_) => "without --row the rows are computed; --pattern and --points say how many are free",
        JunctionError::Slider { .. } => "without --set the canonical member is taken, and its sliders are printed",
        JunctionError::Refinement(_) => "docs/case-format.md describes the boundaries of states",
        JunctionError::Large(_) => "take a shorter --pattern",
    };
    Problem::new("secant::junction", error.to_string()).with_help(help)
}

/// A number of an option.
pub(super) fn number(text: &str, what: &str) -> Result<Rational, Problem> {
    parse_rational(text.trim()).map_err(|e| {
        Problem::new("secant::usage::number", format!("{what}: {e}")).with_help("write numbers as 1/10 or 0.1")
    })
}

pub(super) fn wish(args: &JunctionArgs) -> Result<Wish, Problem> {
    let setting = |text: &String| {
        let parts = text.split_once('=').ok_or_else(|| {
            Problem::new("secant::usage::set", format!("--set {text}: a slider gets its value by ="))
                .with_help("write --set tau1=1/10")
        })?;
        Ok((parts.0.trim().to_owned(), number(parts.1, &format!("--set {text}"))?))
    };
    let row = |text: &String| text.split(',').map(|x| number(x, &format!("--row {text}"))).collect();
    // Faces may be written as D,I,C.
    let pattern =
        args.pattern.as_ref().map(|p| if args.surface { p.replace('D', "a").replace('C', "b") } else { p.clone() });
    Ok(Wish {
        pattern: pattern.as_deref().map(Pattern::parse).transpose().map_err(|e| refused(&e))?,
        points: args.points,
        rows: args.row.iter().map(row).collect::<Result<_, Problem>>()?,
        settings: args.set.iter().map(setting).collect::<Result<_, Problem>>()?,
    })
}

/// The joined shape as a case.
fn case(member: &Member, names: &[String], args: &JunctionArgs) -> Result<String, Problem> {
    let mut complex = member.junction.complex(&member.array);
    if let Some(text) = &args.control {
        complex.shape.control = Some(control(text, complex.shape.states[0].dim)?);
    }
    complex.check().map_err(|e| mistake(&e))?;
    complex.shape.check().map_err(|e| mistake(&e))?;
    let heading = Heading {
        name: args.name.clone(),
        title: format!("{} joined to {} by I -> {}", names[0], names[1], member.junction.pattern),
        source: "secant junction".to_owned(),
        examine: Vec::new(),
    };
    Ok(complex_text(&complex, &heading))
}

pub(super) fn mistake(error: &dyn std::fmt::Display) -> Problem {
    Problem::new("secant::junction::mistake", format!("the joined shape does not satisfy its identities: {error}"))
        .with_help("this is a mistake in secant: please report it with the command")
}

pub(super) fn control(text: &str, count: usize) -> Result<Matrix, Problem> {
    let wrong = |message: String| {
        Problem::new("secant::usage::control", message).with_help(format!(
            "write {count} points, their coordinates apart by commas and the points by semicolons: \"0,0; 1,2; …\""
        ))
    };
    let point = |part: &str| -> Result<Vec<Rational>, Problem> {
        part.split(',').map(|x| parse_rational(x.trim()).map_err(|e| wrong(format!("--control: {e}")))).collect()
    };
    let points = text.split(';').map(point).collect::<Result<Vec<_>, _>>()?;
    let same = points.iter().all(|p| p.len() == points[0].len());
    if points.len() != count || !same {
        return Err(wrong(format!("{} control points of one dimension are needed, {} are given", count, points.len())));
    }
    Ok(Matrix::from_columns(points[0].len(), &points))
}

pub(super) fn report(case: &str, path: &Path) -> Result<String, Problem> {
    let question = Question::parse("junction", case)?;
    let findings = prove(&question, &Budget::default())?;
    Ok(rendered(path, &findings, Level::Proof))
}

/// An eigenvalue: exactly where it is rational, otherwise about.
fn eigenvalue(root: &Root) -> String {
    if let Some(x) = root.rational() {
        return x.to_string();
    }
    let (re, im) = root.to_f64();
    if root.is_real() {
        format!("≈ {re:.4}")
    } else {
        format!("≈ {re:.4} {} {:.4}i", if im < 0.0 { '−' } else { '+' }, im.abs())
    }
}

fn spectrum(classes: &[Vec<Root>]) -> Vec<String> {
    classes.iter().flatten().map(eigenvalue).collect()
}

fn text(found: &Found, sides: &[Side; 2]) -> String {
    // A member may take several steps of a scheme at once.
    let own = |m: &Member| [m.junction.left.clone(), m.junction.right.clone()];
    let [a, b] = found.member.as_ref().map_or_else(|| sides.clone(), own);
    let mut out = format!("a = {}: {}\nb = {}: {}\n", a.name, points(&a), b.name, points(&b));
    for attempt in &found.tried {
        let _ = writeln!(out, "  not {}", failed(attempt));
    }
    let Some(member) = &found.member else {
        out.push_str("no member passes\n");
        return out;
    };
    let (junction, check) = (&member.junction, &member.check);
    let _ = writeln!(
        out,
        "I -> {} on {} points; {} of {} new points are free, each with {} parameters",
        junction.pattern,
        junction.points,
        member.free.len(),
        junction.rows(),
        junction.points - 1
    );
    if let Some(placed) = &member.placed {
        let what = match (placed.precise, placed.degree()) {
            (true, 1) => "affine functions are reproduced".to_owned(),
            (true, d) => format!("polynomials of degree {d} are reproduced"),
            (false, _) => "they increase, and so do those of the new points".to_owned(),
        };
        let _ = writeln!(out, "positions  ({}), shrinking by {}; {what}", row_text(placed.positions()), placed.shrinks);
    }
    for (k, row) in member.free.iter().enumerate() {
        let _ = writeln!(out, "row {k}  ({})", row_text(row));
    }
    for slider in &member.sliders {
        let _ = writeln!(out, "{}  moves row {} by ({})", slider.name, slider.free, row_text(&slider.direction));
    }
    let _ = writeln!(out, "eigenvalues of I in I  {}", spectrum(&check.eigenvalues).join(", "));
    out.push_str(&checked(member));
    out
}

fn checked(member: &Member) -> String {
    let check = &member.check;
    let largest = check.rest.first().and_then(|c| c.first()).map_or_else(|| "0".to_owned(), eigenvalue);
    let what = match (&member.placed, check.passes) {
        (Some(_), true) => {
            format!("passes: beside positions the largest eigenvalue is {largest}, below {}", check.threshold)
        }
        (Some(_), false) => {
            format!("beside positions the largest eigenvalue is {largest}, not below {}", check.threshold)
        }
        (None, _) => format!("it contracts: the largest eigenvalue but 1 is {largest}"),
    };
    let injective = if check.injective { "" } else { "; some operator of I is singular" };
    format!(
        "check  {what}{injective}\nwhat it means for tangents, `secant certify` proves of the case that --output writes\n"
    )
}

fn points(side: &Side) -> String {
    let order = match side.order {
        PointOrder::Given => "",
        PointOrder::Backwards => ", from left to right",
        PointOrder::OwnPoints => ", points of the curve",
    };
    format!("{} points{order}, {} at each end, {} pieces", side.points(), side.shared, side.arity())
}

fn failed(attempt: &Attempt) -> String {
    let what = format!("{} with degree {}", attempt.pattern, attempt.degree);
    match &attempt.largest {
        Some(root) => {
            format!("{what}: an eigenvalue {} is not below {}", eigenvalue(root), attempt.threshold)
        }
        None => format!("{what}: no stencils take the positions that it needs"),
    }
}

fn side_data(side: &Side) -> Value {
    json!({"name": side.name, "points": side.points(), "shared": side.shared, "pieces": side.arity()})
}

fn data(found: &Found, sides: &[Side; 2]) -> Value {
    let row = |r: &[Rational]| r.iter().map(ToString::to_string).collect::<Vec<_>>();
    let tried = found.tried.iter().map(|t| {
        json!({"pattern": t.pattern.to_string(), "degree": t.degree, "largest": t.largest.as_ref().map(eigenvalue),
               "threshold": t.threshold.to_string()})
    });
    let member = found.member.as_ref().map(|m| {
        json!({
            "pattern": m.junction.pattern.to_string(),
            "points": m.junction.points,
            "positions": m.placed.as_ref().map(|p| row(p.positions())),
            "degree": m.placed.as_ref().map(crate::junction::Placed::degree),
            "precise": m.placed.as_ref().is_some_and(|p| p.precise),
            "free": m.free.iter().map(|r| row(r)).collect::<Vec<_>>(),
            "sliders": m.sliders.iter().map(|s| json!({"name": s.name, "row": s.free, "direction": row(&s.direction)}))
                .collect::<Vec<_>>(),
            "eigenvalues": spectrum(&m.check.eigenvalues),
            "largest": m.check.rest.first().and_then(|c| c.first()).map(eigenvalue),
            "threshold": m.check.threshold.to_string(),
            "passes": m.check.passes,
            "contracts": m.check.contracts,
        })
    });
    json!({"format": "secant junction", "version": 1, "a": side_data(&sides[0]), "b": side_data(&sides[1]),
           "member": member, "tried": tried.collect::<Vec<_>>()})
}
