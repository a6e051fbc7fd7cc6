//! `[scheme]`: a case built from a name, a mask, a tensor product or a mesh rule.

use super::node::{Node, Table, clipped, suggest};
use super::{MAX_COORDINATES, Model, Origin, Places, StatePlace};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::scheme::{self, Ends, Interpolation, Laurent, Mask, Normalisation, SchemeError};
use crate::shape::{Complex, Shape};
use std::collections::BTreeMap;

/// The keys that say what is built; each table has exactly one.
const FORMS: [&str; 7] = ["name", "mask", "symbol", "filter", "tensor", "mesh", "interpolate"];

/// A curve built from a scheme table.
struct Built {
    shape: Shape,
    origin: Origin,
}

/// Reads the table `[scheme]`, which stands instead of `pieces`, `[[map]]` and `[[state]]`.
pub(super) fn read(case: &Table<'_>, node: &Node<'_>) -> Result<Model, Problem> {
    let others = ["pieces", "reversed", "shares", "interpolate", "map", "state", "start", "kind", "convention"];
    alone(case, "scheme", &others)?;
    let mut table = node.table().map_err(|problem| {
        problem.with_help(
            "a case has one [scheme]; `secant junction A B` joins two of them, and a [[state]] of an automaton may name one, as in  \
             scheme = \"bspline\"  (docs/case-format.md)",
        )
    })?;
    table.what = "`[scheme]`".to_owned();
    own_keys_only(&table)?;
    let (complex, origin) = match form(&table)? {
        "tensor" => tensor(case, &table)?,
        "mesh" => mesh(&table)?,
        "interpolate" => {
            if let Some(span) = case.key_span("control") {
                return Err(case
                    .file
                    .problem("two-forms", "`control` and `interpolate` exclude each other", span, "given besides")
                    .with_help("the curve goes through the points of `interpolate`"));
            }
            table.only(&["interpolate", "vertical", "polynomials"])?;
            super::interpolate::built(&table, "interpolate")?
        }
        form => {
            let built = curve(&table, form, table.flag("vertices")?)?;
            let built = polygon(case, &table, built)?;
            (Complex::of_curves(built.shape), built.origin)
        }
    };
    Ok(self::built(case, "scheme", node, complex, origin))
}

/// Refuses what a table that gives the operators cannot be combined with.
pub(super) fn alone(case: &Table<'_>, form: &str, others: &[&str]) -> Result<(), Problem> {
    for key in others {
        if let Some(span) = case.key_span(key) {
            let message = format!("`{key}` and `[{form}]` exclude each other");
            let problem = case.file.problem("two-forms", message, span, format!("cannot be combined with [{form}]"));
            return Err(problem
                .with_help(format!("the {form} gives the operators; `secant expand` writes them out, to be changed")));
        }
    }
    Ok(())
}

/// The model of a table that gives all operators.
pub(super) fn built(case: &Table<'_>, form: &str, node: &Node<'_>, complex: Complex, origin: Origin) -> Model {
    let span = case.key_span(form).unwrap_or_else(|| node.span());
    let place = |state: &crate::shape::State| StatePlace {
        name: span.clone(),
        pieces: vec![span.clone(); state.pieces.len()],
        ..StatePlace::default()
    };
    let places = Places { states: complex.shape.states.iter().map(place).collect(), control: None };
    Model { complex, places, unknown: Vec::new(), scheme: Some(origin) }
}

/// Keys of the case that stand below `[scheme]` belong to it for TOML.
fn own_keys_only(table: &Table<'_>) -> Result<(), Problem> {
    for key in ["control", "title", "source", "convention", "kind", "examine", "expect", "start"] {
        if let Some(span) = table.key_span(key) {
            let message = format!("`{key}` stands below [scheme], so that it belongs to the scheme");
            let problem = table.file.problem("misplaced-key", message, span, "a key of the case");
            return Err(problem.with_help(format!("move the line with `{key}` above the line [scheme]")));
        }
    }
    Ok(())
}

/// The curve of the polygon of the control points: several spans, where there are more than one needs or its ends are told.
fn polygon(case: &Table<'_>, table: &Table<'_>, built: Built) -> Result<Built, Problem> {
    let ends = match table.word("ends", &["open", "closed", "clamped"])? {
        Some("closed") => Some(Ends::Closed),
        Some("clamped") => Some(Ends::Clamped),
        Some(_) => Some(Ends::Open),
        None => None,
    };
    let size = built.shape.states[built.shape.start].dim;
    let node = |key: &str| case.get(key).or_else(|| table.get(key));
    let Some(control) = case.get("control") else {
        let told = ["ends", "knots"].into_iter().find(|key| table.get(key).is_some());
        return match told.and_then(node) {
            Some(told) => Err(told
                .problem("polygon", format!("{} needs control points", told.what), "without a polygon")
                .with_help("add a line such as  control = [[0, 0], [1, 2], [3, 2], [4, 0]]  above [scheme]")),
            None => Ok(built),
        };
    };
    let count = control.array(|k| format!("control point {k}"))?.len();
    let step = match &built.origin {
        Origin::Mask(_) | Origin::Filter(..) => 1,
        Origin::Named(name) if name == "bezier" => size - 1,
        _ => return Ok(built),
    };
    if count <= size && ends.is_none() && table.get("knots").is_none() || table.flag("vertices")? {
        return Ok(built);
    }
    if count > MAX_COORDINATES {
        return Err(control
            .problem("limit", format!("{count} control points are over the limit of {MAX_COORDINATES}"), "too many")
            .with_help("divide the curve"));
    }
    let refused = |error: SchemeError| {
        match &error {
        SchemeError::Value { parameter, .. } if parameter == "control" => {
            control.problem("polygon", error.to_string(), format!("{count} points here")).with_help(
                "`ends` is open, closed or clamped; a polygon with more points than one span needs is a curve of several spans",
            )
        }
        _ => refused(table, &control, &error, &[]),
    }
    };
    let mut mask = None;
    let shape = match (ends, table.get("knots")) {
        (Some(Ends::Clamped), None) => {
            scheme::over_knots(count, spline_degree(table, size)?, &scheme::clamped_knots(count, size - 1))
        }
        (None, Some(list)) => {
            let knots = list.array(|k| format!("knot {k}"))?.iter().map(Node::number).collect::<Result<Vec<_>, _>>()?;
            scheme::over_knots(count, spline_degree(table, size)?, &knots)
        }
        (Some(_), Some(list)) => {
            return Err(list
                .problem("two-forms", "`knots` and `ends` exclude each other", "given besides `ends`")
                .with_help("the knots say what happens at the ends"));
        }
        (ends, None) => {
            mask = match built.origin {
                Origin::Mask(own) | Origin::Filter(own, _) => Some(own),
                _ => None,
            };
            scheme::windows(count, size, step, ends.unwrap_or(Ends::Open))
                .and_then(|spans| scheme::of_spans(built.shape, spans))
        }
    };
    Ok(Built { shape: shape.map_err(refused)?, origin: Origin::Polygon(mask) })
}

/// The degree of a scheme that is a B-spline by name.
fn spline_degree(table: &Table<'_>, size: usize) -> Result<usize, Problem> {
    let dyadic = table.get("arity").is_none_or(|n| n.index(2).is_ok_and(|m| m == 2));
    if table.optional_text("name")? == Some("bspline") && dyadic {
        return Ok(size - 1);
    }
    let key = if table.get("knots").is_some() { "knots" } else { "ends" };
    let node = table.need(key, "\"open\"")?;
    Err(node
        .problem("polygon", "knots and clamped ends are those of B-splines of arity 2", "not for this scheme")
        .with_help("take name = \"bspline\", or ends = \"open\" with end points that are repeated"))
}

fn form(table: &Table<'_>) -> Result<&'static str, Problem> {
    let given: Vec<&'static str> = FORMS.into_iter().filter(|k| table.get(k).is_some()).collect();
    match given.as_slice() {
        [only] => Ok(only),
        [] => Err(misspelt(table).unwrap_or_else(|| table
            .problem("missing-key", format!("{} does not say what is built", table.what), "no scheme")
            .with_help("give one of  name = \"bspline\",  mask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"],  symbol = \"(1+z)^3/4\",  \
                        filter = [ … ],  tensor = [ … ],  mesh = \"catmull-clark\",  interpolate = [[0, 0], [1, 2], [3, 1]]"))),
        [first, second, ..] => {
            let span = table.key_span(second).unwrap_or_default();
            let message = format!("`{first}` and `{second}` of {} exclude each other", table.what);
            Err(table
                .file
                .problem("two-forms", message, span, "given besides")
                .with_help(format!("a scheme is given by one of {}", FORMS.join(", "))))
        }
    }
}

/// A key that is nearly one of those that say what is built.
fn misspelt(table: &Table<'_>) -> Option<Problem> {
    table.keys().into_iter().find_map(|key| {
        let form = FORMS.iter().find(|form| strsim::jaro_winkler(&clipped(&key).to_lowercase(), form) > 0.85)?;
        let span = table.key_span(&key)?;
        let message = format!("{} has no key `{}`", table.what, clipped(&key));
        Some(
            table
                .file
                .problem("unknown-key", message, span, "unknown key")
                .with_help(format!("did you mean `{form}`?")),
        )
    })
}

/// The parameters of a named scheme: every other key.
pub(super) fn parameters(table: &Table<'_>, but: &[&str]) -> Result<BTreeMap<String, Rational>, Problem> {
    let keys = table.keys().into_iter().filter(|k| !but.contains(&k.as_str()));
    keys.filter_map(|key| table.get(&key).map(|node| Ok((key, node.number()?)))).collect()
}

fn curve(table: &Table<'_>, form: &str, vertices: bool) -> Result<Built, Problem> {
    if form == "name" {
        let node = table.need("name", "\"bspline\"")?;
        let name = node.text()?;
        let values = parameters(table, &["name", "vertices", "ends", "knots"])?;
        let build = if vertices { scheme::build_with_vertices } else { scheme::build };
        let known = || scheme::list().iter().map(|s| s.name).collect::<Vec<_>>();
        let shape = build(name, &values).map_err(|e| refused(table, &node, &e, &known()))?;
        let mask = scheme::mask(name, &values).ok().flatten();
        let origin = mask.map_or_else(|| Origin::Named(name.to_owned()), Origin::Mask);
        return Ok(Built { shape, origin });
    }
    let node = table.need(form, "[ … ]")?;
    let (mask, taken) = mask(table, form, &node)?;
    let shape = if vertices { mask.curve_with_vertices() } else { mask.curve() };
    let shape = shape.map_err(|e| refused(table, &node, &e, &[]))?;
    let origin = match taken {
        Some(taken) => Origin::Filter(mask, taken),
        None => Origin::Mask(mask),
    };
    Ok(Built { shape, origin })
}

/// The mask; of a filter also the normalisation in which it was read, where that is not the one that it names.
fn mask(table: &Table<'_>, form: &str, node: &Node<'_>) -> Result<(Mask, Option<Normalisation>), Problem> {
    let known: &[&'static str] = if form == "filter" {
        &["filter", "arity", "normalisation", "vertices", "ends"]
    } else {
        &["mask", "symbol", "arity", "vertices", "ends"]
    };
    table.only(known)?;
    let arity_node = table.get("arity");
    let arity = arity_node.as_ref().map_or(Ok(2), |n| n.index(scheme::MAX_ARITY))?;
    let problem = |error: SchemeError| {
        let place = arity_node.as_ref().filter(|_| matches!(error, SchemeError::Arity(_)));
        refused(table, place.unwrap_or(node), &error, &[])
    };
    if form == "symbol" {
        let text = node.text()?;
        let symbol = Laurent::parse(text).map_err(|e| refused(table, node, &e, &[]))?;
        return Ok((Mask::new(arity, symbol.coefficients().to_vec()).map_err(problem)?, None));
    }
    let entries = node.array(|k| format!("coefficient {k} of `{form}`"))?;
    if form == "mask" {
        let entries = entries.iter().map(Node::number).collect::<Result<_, _>>()?;
        return Ok((Mask::new(arity, entries).map_err(problem)?, None));
    }
    let scale = table.need("normalisation", "\"root\"").map_err(|p| {
        p.with_help(
            "say how the filter is scaled: normalisation = \"arity\" (its sum is the arity), \"one\" (its sum is 1), or \
             \"root\" (its sum is the root of the arity; entries are given as multiples of that root, 1/8 for √2/8)",
        )
    })?;
    let scale = match table.word("normalisation", &["arity", "one", "root"])? {
        Some("arity") => Normalisation::Arity,
        Some("one") => Normalisation::One,
        Some("root") => Normalisation::Root,
        _ => return Err(scale.problem("value", "this normalisation is not known", "unknown")),
    };
    let filter = entries.iter().map(Node::number).collect::<Result<Vec<_>, _>>()?;
    let read = |scale| Mask::from_filter(arity, &filter, scale);
    match read(scale) {
        // The sums of a mask leave no choice.
        Err(error @ SchemeError::SumRule { .. }) => {
            let others = [Normalisation::Arity, Normalisation::One, Normalisation::Root];
            let fits = |other: Normalisation| Some((read(other).ok()?, Some(other)));
            others.into_iter().find_map(fits).ok_or_else(|| problem(error))
        }
        found => Ok((found.map_err(problem)?, None)),
    }
}

/// A factor of a tensor product: a curve with vertices, or data that are interpolated.
enum Factor {
    Curve(Shape),
    Data(Box<Interpolation>),
}

fn tensor(case: &Table<'_>, table: &Table<'_>) -> Result<(Complex, Origin), Problem> {
    table.only(&["tensor"])?;
    let node = table.need("tensor", "[{ name = \"bspline\" }, { name = \"bspline\" }]")?;
    let factors = node.array(|k| format!("factor {k} of `tensor`"))?;
    let [a, b] = factors.as_slice() else {
        return Err(node
            .problem("value", format!("{} factors are given", factors.len()), "two are needed")
            .with_help("a tensor product has two curves, as in [{ name = \"bspline\" }, { name = \"bspline\" }]"));
    };
    match (factor(a)?, factor(b)?) {
        (Factor::Curve(a), Factor::Curve(b)) => {
            let (a, b) = (renamed(a, "u"), renamed(b, "w"));
            let built = scheme::tensor(&a, &b).map_err(|e| refused(table, &node, &e, &[]))?;
            Ok((built, Origin::Tensor))
        }
        (Factor::Data(a), Factor::Data(b)) => {
            if let Some(span) = case.key_span("control") {
                return Err(case
                    .file
                    .problem("two-forms", "`control` and `interpolate` exclude each other", span, "given besides")
                    .with_help("the surface is (x, y, f(x) g(y))"));
            }
            let built = scheme::product_surface(&a, &b).map_err(|e| refused(table, &node, &e, &[]))?;
            Ok((built, Origin::Graphs))
        }
        _ => Err(node
            .problem("value", "one factor interpolates data and the other does not", "two of one kind are needed")
            .with_help("a function of x is multiplied with a function of y: give `interpolate` in both factors")),
    }
}

fn factor(node: &Node<'_>) -> Result<Factor, Problem> {
    let table = node.table()?;
    match form(&table)? {
        "tensor" | "mesh" => Err(node
            .problem("value", format!("{} is no curve", node.what), "a surface")
            .with_help("the factors of a tensor product are curves")),
        "interpolate" => {
            table.only(&["interpolate", "vertical", "polynomials"])?;
            match super::interpolate::built(&table, "interpolate")? {
                (_, Origin::Interpolation(data)) => Ok(Factor::Data(data)),
                (complex, _) => Ok(Factor::Curve(complex.shape)),
            }
        }
        form => Ok(Factor::Curve(curve(&table, form, true)?.shape)),
    }
}

fn renamed(mut shape: Shape, name: &str) -> Shape {
    for state in shape.states.iter_mut().filter(|s| s.name != "v") {
        name.clone_into(&mut state.name);
    }
    shape
}

fn mesh(table: &Table<'_>) -> Result<(Complex, Origin), Problem> {
    let node = table.need("mesh", "\"catmull-clark\"")?;
    let name = node.text()?;
    let valence_node = table.need("valence", "5")?;
    let valence = valence_node.index(scheme::MAX_VALENCE)?;
    let disc = table.word("cell", &["face", "disc"])? == Some("disc");
    let values = parameters(table, &["mesh", "valence", "cell"])?;
    let known = || scheme::mesh_rules().iter().map(|r| r.name).collect::<Vec<_>>();
    let rule = scheme::mesh_rule(name, &values).map_err(|e| refused(table, &node, &e, &known()))?;
    let problem = |error: SchemeError| {
        let place = if matches!(error, SchemeError::Value { .. }) { &valence_node } else { &node };
        refused(table, place, &error, &[])
    };
    let complex = if disc {
        scheme::disc_complex(&rule, valence).map_err(problem)?
    } else {
        scheme::patch(&rule, valence).map_err(problem)?
    };
    Ok((complex, Origin::Mesh { rule, valence, disc }))
}

/// What the library refuses, shown at the value of the table that it concerns.
pub(super) fn refused(table: &Table<'_>, node: &Node<'_>, error: &SchemeError, known: &[&str]) -> Problem {
    let at = |key: &str, code: &str, help: &str| {
        let span = table.key_span(key).unwrap_or_else(|| node.span());
        table.file.problem(code, error.to_string(), span, "here").with_help(help)
    };
    match error {
        SchemeError::Unknown { name, .. } => {
            let message = format!("there is no scheme `{}`", clipped(name));
            let help = match super::asked::unaliased(name) {
                // Files have one name for each scheme; a checker reads them too.
                Some(own) => {
                    let mut parts = own.split_whitespace();
                    let scheme = parts.next().unwrap_or_default();
                    let settings = parts.filter_map(|p| p.split_once('=')).map(|(k, v)| format!("  {k} = \"{v}\""));
                    format!("write  name = \"{scheme}\"{}", settings.collect::<String>())
                }
                None => format!("{}; `secant schemes` describes them", suggest(name, known, "the schemes are")),
            };
            node.problem("scheme", message, "not a known name").with_help(help)
        }
        SchemeError::Parameter { parameter, .. } => {
            at(parameter, "scheme-parameter", "`secant schemes` lists every scheme with its parameters")
        }
        SchemeError::Missing { parameter, .. } => node
            .problem("scheme-parameter", error.to_string(), "a parameter is missing")
            .with_help(format!("add a line such as  {parameter} = \"1/4\"  to {}", table.what)),
        SchemeError::Value { parameter, .. } => {
            at(parameter, "scheme-parameter", "`secant schemes` lists every scheme with its parameters")
        }
        SchemeError::SumRule { arity, .. } => {
            node.problem("sum-rule", error.to_string(), "these coefficients").with_help(sum_rule_help(*arity))
        }
        SchemeError::Symbol { position, .. } => {
            // Behind the opening quotation mark; exact unless the string has escapes.
            let span = node.span();
            let start = (span.start + 1 + position).min(span.end);
            table
                .file
                .problem("symbol", error.to_string(), start..(start + 1).min(span.end), "here")
                .with_help("a symbol is written as \"(1+z)^4/8\" or \"-1/16 + 9/16 z^2 + z^3 + 9/16 z^4 - 1/16 z^6\"")
        }
        SchemeError::Irrational(_) => node
            .problem("irrational", error.to_string(), "irrational weights")
            .with_help("take a variant with a rational parameter, such as loop-warren or loop-variant"),
        SchemeError::Large { .. } => node
            .problem("limit", error.to_string(), "too large")
            .with_help("what is over a limit is refused, never built in part"),
        _ => node
            .problem("scheme", error.to_string(), "this scheme")
            .with_help("docs/schemes.md says how operators are built from a scheme, and what is checked"),
    }
}

fn sum_rule_help(arity: usize) -> String {
    let which = if arity == 2 {
        "the even and the odd coefficients"
    } else {
        "the coefficients of each class modulo the arity"
    };
    format!(
        "{which} must each add up to 1 (the scheme must reproduce constants); another `arity`, or a filter with its \
         `normalisation`, may be meant"
    )
}
