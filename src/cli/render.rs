//! `secant render`: exact points of a shape, drawn.

use super::PROVED;
use super::certify::{extension, mistaken};
use super::output::{self, say, settle, to_stdout, write_file};
use super::progress::Progress;
use super::question::joined;
use crate::arith::{parse_rational, to_f64};
use crate::case::{Case, Question, asked};
use crate::diagnostic::Problem;
use crate::linalg::char_poly;
use crate::picture::{PLOT_PIXELS, Plot, View, resized};
use crate::shape::{
    CellKind, Contraction, MAX_CELLS, MAX_SAMPLES, Sample, Shape, adaptive_sample, contraction, depth_within, level,
    random_sample, sample, words_of_length,
};
use clap::Args;
use std::path::{Path, PathBuf};

/// Longest words.
const MAX_DEPTH: usize = 64;
/// Cells drawn where no depth is given.
const DEFAULT_POINTS: usize = 20_000;
/// Binary digits to which irrational entries are rounded.
const ROUNDED_BITS: u64 = 128;

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// A case file, or what stands for one, as for `certify`.
    #[arg(required = true, value_name = "CASE")]
    pub(super) cases: Vec<PathBuf>,
    /// Write a file, the format of which its ending says: .svg, .png, .obj or .ply; may be given several times.
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Write an SVG drawing; surfaces are projected.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write a PNG image.
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// The width of the picture in pixels (800).
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=8192))]
    size: Option<u32>,
    /// Write a Wavefront OBJ file.
    #[arg(long, value_name = "FILE")]
    obj: Option<PathBuf>,
    /// Write a PLY file, with colours.
    #[arg(long, value_name = "FILE")]
    ply: Option<PathBuf>,
    /// The direction from which a shape in space is seen: front, back, left, right, top, bottom, or two angles in degrees
    /// (around the third axis from the first one, and above the plane of the first two), as in `30,20`.
    #[arg(long, value_name = "VIEW", allow_hyphen_values = true)]
    view: Option<String>,
    /// Draw the cells of all words of so many letters. By default cells of about one size are drawn, 20 000 at most, and of a
    /// surface all words of a length.
    #[arg(long, conflicts_with = "chaos", value_parser = clap::value_parser!(usize))]
    depth: Option<usize>,
    /// Draw so many letters that no point of the shape is farther than this from a drawn one; the bound is proved and printed.
    #[arg(long, value_name = "DISTANCE", conflicts_with_all = ["chaos", "depth"])]
    error: Option<String>,
    /// Draw this many points with random addresses instead (the chaos game).
    #[arg(long, value_name = "POINTS")]
    chaos: Option<usize>,
    /// The seed of the chaos game.
    #[arg(long, default_value_t = 1, requires = "chaos")]
    seed: u64,
}

/// Renders the case into the files asked for.
pub fn run(args: RenderArgs) -> u8 {
    let done = by_ending(args).and_then(|args| {
        let piped = to_stdout([&args.svg, &args.png, &args.obj, &args.ply])?;
        Ok((render(&args)?, piped))
    });
    settle(done.map(|(text, piped)| {
        say(&text, piped);
        PROVED
    }))
}

/// The files of `--output` at the options of their formats.
fn by_ending(mut args: RenderArgs) -> Result<RenderArgs, Problem> {
    for path in std::mem::take(&mut args.output) {
        output::by_ending(
            path,
            &mut [
                (&["svg"], &mut args.svg),
                (&["png"], &mut args.png),
                (&["obj"], &mut args.obj),
                (&["ply"], &mut args.ply),
            ],
        )?;
    }
    Ok(RenderArgs { cases: joined(args.cases), ..args })
}

impl RenderArgs {
    /// The files that are to be written.
    pub(super) fn outputs(&self) -> Vec<&Path> {
        let named = [&self.svg, &self.png, &self.obj, &self.ply].into_iter().flatten();
        self.output.iter().chain(named).map(PathBuf::as_path).collect()
    }
}

/// Refuses what cannot be written before anything is computed.
fn check(args: &RenderArgs) -> Result<(), Problem> {
    let targets = [&args.svg, &args.png, &args.obj, &args.ply];
    if targets.iter().all(|t| t.is_none()) {
        return Err(Problem::new("secant::usage::render", "no file to write is given")
            .with_help("add --output FILE.svg, .png, .obj or .ply; `--svg -` writes to the standard output"));
    }
    for (option, path, other) in [("--svg", &args.svg, "png"), ("--png", &args.png, "svg")] {
        if let Some(path) = path.as_deref().filter(|p| extension(p) == other) {
            return Err(mistaken(option, path, other));
        }
    }
    Ok(())
}

/// The direction from which the shape is seen, where one is given.
fn view(case: &Case, args: &RenderArgs) -> Result<Option<View>, Problem> {
    let Some(text) = &args.view else { return Ok(None) };
    let view = View::parse(text).ok_or_else(|| {
        Problem::new("secant::usage::view", format!("--view {text} is no direction")).with_help(
            "write front, back, left, right, top, bottom, or two angles such as 30,20 (the second from -90 to 90)",
        )
    })?;
    if case.shape.control.as_ref().is_none_or(|c| c.rows() < 3) {
        let message = format!("--view: {} is not in space", case.name);
        return Err(Problem::new("secant::usage::view", message)
            .with_help("control points with three coordinates, or maps of space, are seen from a direction"));
    }
    Ok(Some(view))
}

fn render(args: &RenderArgs) -> Result<String, Problem> {
    check(args)?;
    let [path] = args.cases.as_slice() else {
        return Err(Problem::new("secant::usage::render", "one case is drawn at a time")
            .with_help("parameters follow the name of a scheme, as in `four-point w=1/16`"));
    };
    let (case, rounded) = drawn(&path.to_string_lossy())?;
    if rounded && args.error.is_some() {
        let message = "irrational entries are rounded to be drawn, so that no error is proved";
        return Err(Problem::new("secant::render", message).with_help("leave out --error"));
    }
    let view = view(&case, args)?;
    let contracts = contraction(&case.shape, |_| false);
    let proved = args.error.as_deref().map(|text| bounded(&case, &contracts, text)).transpose()?;
    let (found, how) = points(&case, args, proved)?;
    let contracts = contracts.is_proved();
    let note = if contracts { "" } else { "; contraction is not proved, so there may be no attractor" };
    let curve = case.shape.states[case.shape.start].kind == CellKind::Edge && args.chaos.is_none();
    let plot = Plot::new(&case.shape, &found, curve, view).ok_or_else(|| {
        Problem::new("secant::render", format!("{} cannot be drawn", case.name))
            .with_help("its points are too large, or there are none at this depth; try --depth")
    })?;
    write(&plot, &case.title, args)?;
    let faces = if found.faces.is_empty() { String::new() } else { format!(" and {} polygons", found.faces.len()) };
    let near = args.error.as_ref().filter(|_| proved.is_some()).map_or_else(String::new, |distance| {
        format!("; they are points of the shape, and none of its points is farther than {distance} from all of them")
    });
    let exact = if rounded { "rounded" } else { "exact" };
    Ok(format!("{}: {} {exact} points{faces}, {how}{near}{note}\n", case.name, found.points.len()))
}

/// Writes all files; each is made before the first is written.
fn write(plot: &Plot, title: &str, args: &RenderArgs) -> Result<(), Problem> {
    let mut files: Vec<(&Path, Vec<u8>)> = Vec::new();
    if let Some(path) = &args.svg {
        let svg = plot.svg(title);
        files.push((path, args.size.map_or(svg.clone(), |width| resized(&svg, width)).into_bytes()));
    }
    if let Some(path) = &args.png {
        let image = plot
            .png(args.size.unwrap_or(PLOT_PIXELS))
            .ok_or_else(|| Problem::new("secant::render", "the image cannot be encoded").with_help("try --svg"))?;
        files.push((path, image));
    }
    if let Some(path) = &args.obj {
        files.push((path, plot.obj(title).into_bytes()));
    }
    if let Some(path) = &args.ply {
        files.push((path, plot.ply(title).into_bytes()));
    }
    files.iter().try_for_each(|(path, content)| write_file(path, content))
}

/// The case, and whether its entries are irrational and rounded to be drawn.
fn drawn(text: &str) -> Result<(Case, bool), Problem> {
    let source = asked(text)?;
    match Question::parse(&source.name, &source.text) {
        Ok(Question::OverField { case, .. }) => Ok((case.rounded(ROUNDED_BITS), true)),
        _ => Ok((Case::parse(&source.name, &source.text)?, false)),
    }
}

/// The depth at which no cell is larger than was asked.
fn bounded(case: &Case, contracts: &Contraction, text: &str) -> Result<usize, Problem> {
    let error = parse_rational(text).ok().filter(|x| *x > 0).ok_or_else(|| {
        Problem::new("secant::usage::error", format!("--error {text}: a positive number is needed"))
            .with_help("write --error 1/1000 or --error 0.001")
    })?;
    let found = level(&case.shape, contracts, &error);
    found.map(|(depth, _)| depth).ok_or_else(|| {
        Problem::new("secant::render", format!("{} cannot be drawn with that error", case.name)).with_help(format!(
            "contraction must be proved, and there may be {MAX_CELLS} cells at most; take a larger --error"
        ))
    })
}

fn points(case: &Case, args: &RenderArgs, proved: Option<usize>) -> Result<(Sample, String), Problem> {
    let failed = |help: &str| {
        Problem::new("secant::render", format!("no points of {} can be computed", case.name)).with_help(help)
    };
    if let Some(count) = args.chaos {
        if count > MAX_SAMPLES {
            return Err(failed(&format!("at most {MAX_SAMPLES} points are drawn")));
        }
        let progress = Progress::of(count, "points", false);
        let weights: Vec<Vec<f64>> = (0..case.shape.states.len()).map(|e| weights(&case.shape, e)).collect();
        let mut random = oorandom::Rand64::new(u128::from(args.seed));
        let mut next = |state: usize| pick(&weights[state], random.rand_float());
        let found = random_sample(&case.shape, count, &mut next, &mut |_| progress.step());
        progress.finish();
        let how = format!("chaos game with seed {}", args.seed);
        return Ok((found.ok_or_else(|| failed("the shape must contract"))?, how));
    }
    let complex = case.complex();
    if proved.is_none()
        && args.depth.is_none()
        && let Some(found) = adaptive_sample(&case.shape, DEFAULT_POINTS)
    {
        return Ok((found, "in cells of about one size".to_owned()));
    }
    let depth = proved.or(args.depth).unwrap_or_else(|| depth(&case.shape));
    if depth > MAX_DEPTH {
        return Err(failed(&format!("a depth of at most {MAX_DEPTH} is drawn")));
    }
    if args.depth.is_some() && words_of_length(&case.shape, depth) > MAX_SAMPLES {
        return Err(failed(&format!(
            "there are more than {MAX_SAMPLES} words of {depth} letters; take a smaller --depth, or --chaos"
        )));
    }
    let progress = Progress::of(0, "points", false);
    let found = sample(&complex, depth, &mut |n| progress.advance(n));
    progress.finish();
    let help = format!("the shape must contract, and have at most {MAX_SAMPLES} points at this depth; try --depth");
    Ok((found.ok_or_else(|| failed(&help))?, format!("all words of {depth} letters")))
}

/// The largest depth with not too many words, and a patch not finer than can be seen.
fn depth(shape: &Shape) -> usize {
    let faces = shape.states.iter().any(|s| s.kind == CellKind::Face);
    depth_within(shape, if faces { 3_000 } else { DEFAULT_POINTS })
}

/// How often each piece is drawn: by its determinant where it has one, and never too seldom.
#[allow(clippy::float_arithmetic, reason = "weights of a picture")]
fn weights(shape: &Shape, state: usize) -> Vec<f64> {
    let pieces = &shape.states[state].pieces;
    let size = |op: &crate::linalg::Matrix| {
        if op.rows() == op.cols() { to_f64(&char_poly(op).coeff(0)).abs() } else { 0.0 }
    };
    let sizes: Vec<f64> = pieces.iter().map(|p| size(&p.op)).collect();
    let total: f64 = sizes.iter().sum();
    let least = if total > 0.0 { total / 50.0 } else { 1.0 };
    sizes.iter().map(|s| s.max(least)).collect()
}

#[allow(clippy::float_arithmetic, reason = "draws of a picture")]
fn pick(weights: &[f64], draw: f64) -> usize {
    let mut rest = draw * weights.iter().sum::<f64>();
    for (k, w) in weights.iter().enumerate() {
        rest -= w;
        if rest < 0.0 {
            return k;
        }
    }
    weights.len().saturating_sub(1)
}
