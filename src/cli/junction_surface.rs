//! `secant junction A B --surface`: a strip of intermediate faces between two face schemes.

use super::certify::json_text;
use super::files::Written;
use super::junction::{JunctionArgs, both, control, keep, mistake, number, refused, side, wish};
use crate::arith::Rational;
use crate::case::Question;
use crate::diagnostic::Problem;
use crate::junction::surface::{Choice, FaceSide, Plan, SurfaceError, SurfaceFound, SurfaceMember, find};
use crate::junction::{JunctionError, row_text};
use crate::linalg::Matrix;
use crate::scheme::{Heading, complex_text};
use crate::theorem::surface::factors;
use serde_json::{Value, json};
use std::fmt::Write;

/// Joins two face schemes; as for two curves.
///
/// # Errors
/// The [`Problem`] of a scheme, of an option, or of an output.
pub fn answer(args: &JunctionArgs) -> Result<(bool, String, Written), Problem> {
    let names = both(&args.schemes, "doo-sabin catmull-clark --surface")?;
    let sides = [face(&names[0])?, face(&names[1])?];
    let plan = plan(args)?;
    let found = find(&sides[0], &sides[1], &plan).map_err(|e| wrong(&e))?;
    let mut written = Written::default();
    if let Some(member) = &found.member {
        keep(&case(member, &names, args)?, args, &mut written);
    }
    let shown = if args.json { json_text(&data(&found), true) } else { text(&found, &sides) };
    Ok((found.member.is_some(), shown, written))
}

fn wrong(error: &SurfaceError) -> Problem {
    let help = match error {
        SurfaceError::Curve(inner) => return refused(inner),
        SurfaceError::Arity(_) => "a scheme of one step cannot be joined to one of another arity along a border",
        SurfaceError::Backwards(_) => "take curves whose pieces all run forwards",
        SurfaceError::Stencil(_) => "without --row and --stencil they are computed; --pattern says how many are free",
        SurfaceError::Large(_) => "take a shorter --pattern",
    };
    Problem::new("secant::junction", error.to_string()).with_help(help)
}

/// A face scheme by its name, as the product of two curves (`quadratic x four-point`, the first across the border), or a case that is
/// such a product.
fn face(text: &str) -> Result<FaceSide, Problem> {
    let of = |across: &str, along: &str| {
        FaceSide::new(text, side(across.trim())?, side(along.trim())?).map_err(|e| wrong(&e))
    };
    let spline = match text {
        "doo-sabin" => Some("bspline degree=2"),
        "catmull-clark" => Some("bspline degree=3"),
        _ => None,
    };
    if let Some(spline) = spline {
        return of(spline, spline);
    }
    if let Some((across, along)) = text.split_once(" x ") {
        return of(across, along);
    }
    if let Ok(Question::Tangents { case, .. }) = Question::ask(text)
        && let Some((across, along)) = factors(&case.complex())
    {
        let curve = |shape| crate::junction::Side::of(text, &shape).map_err(|e| refused(&e));
        return FaceSide::new(text, curve(across)?, curve(along)?).map_err(|e| wrong(&e));
    }
    of(text, text)
}

fn plan(args: &JunctionArgs) -> Result<Plan, Problem> {
    let asked = wish(args)?;
    if let Some((name, _)) = asked.settings.first() {
        let known = "a surface is changed by --row or --stencil".to_owned();
        return Err(refused(&JunctionError::Slider { name: name.clone(), known }));
    }
    if asked.points.is_some() {
        return Err(Problem::new("secant::usage::points", "--points is about curves")
            .with_help("an intermediate face has the points of both its side edges"));
    }
    let stencils: Vec<Vec<Rational>> = args
        .stencil
        .iter()
        .map(|text| text.split(',').map(|x| number(x, &format!("--stencil {text}"))).collect())
        .collect::<Result<_, Problem>>()?;
    let choice = match (args.least, stencils.is_empty()) {
        (_, false) => Choice::Given(stencils),
        (true, true) => Choice::Least,
        (false, true) => Choice::SemiTensor(asked.rows),
    };
    Ok(Plan { pattern: asked.pattern, choice })
}

/// The joined surface as a case.
fn case(member: &SurfaceMember, names: &[String], args: &JunctionArgs) -> Result<String, Problem> {
    let family = &member.family;
    let mut complex = family.complex(&member.stencils, member.precise).map_err(|e| wrong(&e))?;
    let points = complex.shape.states[complex.shape.start].dim;
    if let Some(text) = &args.control {
        complex.shape.control = Some(control(text, points)?);
    }
    if let Some(text) = &args.heights {
        complex.shape.control = Some(over_positions(member, text)?);
    }
    complex.check().map_err(|e| mistake(&e))?;
    complex.shape.check().map_err(|e| mistake(&e))?;
    let heading = Heading {
        name: args.name.clone(),
        title: format!("{} joined to {} by faces I -> {}", names[0], names[1], faces(family.across.pattern)),
        source: "secant junction --surface".to_owned(),
        examine: Vec::new(),
    };
    Ok(complex_text(&complex, &heading))
}

/// Control points over the positions of the joined surface, with the given heights.
fn over_positions(member: &SurfaceMember, text: &str) -> Result<Matrix, Problem> {
    let problem = |message: String| {
        Problem::new("secant::usage::heights", message).with_help("give one number for every point: \"0, 0, 1, …\"")
    };
    let positions = member.family.all_positions().filter(|_| member.precise);
    let Some([u, v]) = positions else { return Err(problem("the stencils do not reproduce positions".to_owned())) };
    let heights: Vec<Rational> = text.split(',').map(|x| number(x, "--heights")).collect::<Result<_, _>>()?;
    if heights.len() != u.len() {
        return Err(problem(format!("{} heights are given for {} points", heights.len(), u.len())));
    }
    Ok(Matrix::from_rows(u.len(), vec![u, v, heights]))
}

fn text(found: &SurfaceFound, sides: &[FaceSide; 2]) -> String {
    let mut out = String::new();
    for (letter, side) in ["D", "C"].into_iter().zip(sides) {
        let sizes = |s: &crate::junction::Side| format!("{} points, {} at each end", s.points(), s.shared);
        let _ = writeln!(
            out,
            "{letter} = {}: across the border {}; along it {}; {} pieces",
            side.name,
            sizes(&side.across),
            sizes(&side.along),
            side.across.arity()
        );
    }
    for (pattern, degree, bound) in &found.tried {
        let what = match bound {
            Some(bound) => format!("on what positions do not see the radius is bounded by {} only", decimal(bound)),
            None => "no bound of the radius was found".to_owned(),
        };
        let _ = writeln!(out, "  not {} with degree {degree}: {what}", faces(*pattern));
    }
    let Some(member) = &found.member else {
        out.push_str("no member passes\n");
        return out;
    };
    let (family, [face, edge]) = (&member.family, member.family.points());
    let _ = writeln!(
        out,
        "I -> {} across the border, {} rows along it, on {face} points, its edge across the border on {edge}; {} new points are free, \
         with {} parameters",
        faces(family.across.pattern),
        family.arity(),
        family.free.len(),
        family.parameters()
    );
    for (k, (free, stencil)) in family.free.iter().zip(&member.stencils).enumerate() {
        let _ = writeln!(out, "stencil {k}, column {} row {}  ({})", free.column, free.row, row_text(stencil));
    }
    out.push_str(&checked(member));
    out
}

/// A pattern in the letters of faces.
fn faces(pattern: crate::junction::Pattern) -> String {
    pattern.to_string().replace('a', "D").replace('b', "C")
}

fn checked(member: &SurfaceMember) -> String {
    let check = &member.check;
    let what = if member.precise { "affine functions are reproduced; beside positions" } else { "beside constants" };
    let bound = check.bound.as_ref().map_or_else(|| "not bounded".to_owned(), |b| format!("at most {}", decimal(b)));
    format!(
        "check  {what}, in {} dimensions, the joint spectral radius of the pieces of I in itself is {bound}, below {}\nwhat it means for \
         tangent planes, `secant certify` proves of the case that --output writes\n",
        check.dim, check.threshold
    )
}

fn decimal(x: &Rational) -> String {
    crate::report::radius::decimal(x, true, 6)
}

fn data(found: &SurfaceFound) -> Value {
    let row = |r: &[Rational]| r.iter().map(ToString::to_string).collect::<Vec<_>>();
    let text = |x: &Option<Rational>| x.as_ref().map(ToString::to_string);
    let tried = found
        .tried
        .iter()
        .map(|(pattern, degree, bound)| json!({"pattern": faces(*pattern), "degree": degree, "bound": text(bound)}));
    let member =
        found.member.as_ref().map(|m| {
            let free =
                m.family.free.iter().zip(&m.stencils).map(
                    |(f, s)| json!({"column": f.column, "row": f.row, "at_vertex": f.at_vertex, "stencil": row(s)}),
                );
            json!({
                "pattern": faces(m.family.across.pattern),
                "points": m.family.points(),
                "parameters": m.family.parameters(),
                "stencils": free.collect::<Vec<_>>(),
                "positions": m.positions.as_ref().map(|p| p.each_ref().map(|x| row(x))),
                "precise": m.precise,
                "dimension": m.check.dim,
                "bound": text(&m.check.bound),
                "threshold": m.check.threshold.to_string(),
                "passes": m.check.passes,
            })
        });
    json!({"format": "secant junction surface", "version": 1, "member": member, "tried": tried.collect::<Vec<_>>()})
}
