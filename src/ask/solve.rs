//! The entries of a case that its identities force.

use crate::arith::{Rational, parse_rational};
use crate::case::Case;
use crate::certificate::{self, Doubt};
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::poly::factor;
use crate::shape::{self, Complex, ComplexError, Family, OpName, Solution, Source, UnknownError};
use serde_json::{Value, json};
use std::fmt::Write;

/// What was found about the unknown entries of a case.
#[derive(Debug, Clone)]
pub struct Solved {
    /// For people.
    pub text: String,
    /// The same as data.
    pub json: Value,
    /// The case with the solution; `None` where there is none.
    pub case: Option<String>,
    /// The certificate that the checker accepted, where it was asked for.
    pub certificate: Option<String>,
}

/// Solves the identities of a case for its unknown entries; `set` gives free parameters values, as in `a=1/2`, in the case that
/// is written. With `certificate` the solutions are proved again by the checker.
///
/// # Errors
/// A [`Problem`] where the identities are no linear equations or the case has no unknown entries that they concern, where a
/// setting does not fit, and where there is no certificate.
///
/// # Examples
/// ```
/// use secant::{ask, case::Case};
/// let solved = ask::solve(&Case::read_open("cases/solve/chaikin.toml".as_ref())?, &[], true)?;
/// assert!(solved.case.is_some() && solved.certificate.is_some());
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn solve(case: &Case, set: &[String], certificate: bool) -> Result<Solved, Problem> {
    let problem = case.unknowns().map_err(|e| unsolvable(case, &e))?;
    let solution = problem.solve().map_err(|e| unsolvable(case, &e))?;
    let written = certificate.then(|| certified(case, &problem, &solution)).transpose()?;
    Ok(Solved { certificate: written, ..shown(case, &problem, solution, set)? })
}

/// The certificate of the solutions, accepted by the checker.
fn certified(case: &Case, problem: &shape::Problem, solution: &Solution) -> Result<String, Problem> {
    let written = certificate::solve_certificate(case, problem, solution).map_err(Doubt::from);
    let accepted = written.and_then(|c| certificate::checked(&case.text.text, c));
    let none = |doubt: Doubt| {
        Problem::new("secant::certificate::none", doubt.to_string())
            .with_help("see docs/certificate.md; no certificate was written")
    };
    Ok(accepted.map_err(none)?.text())
}

fn shown(case: &Case, problem: &shape::Problem, solution: Solution, set: &[String]) -> Result<Solved, Problem> {
    let complex = case.complex();
    let identities = complex.identities().map_err(|e| unsolvable(case, &UnknownError::Complex(e)))?.len();
    let mut head = format!(
        "{}: {} and {}\n",
        case.name,
        counted(problem.count(), "unknown", "unknowns"),
        counted(identities, "identity", "identities")
    );
    let start = |solutions: &str| {
        json!({ "format": "secant solve", "version": 1, "case": case.name, "solutions": solutions,
                "unknowns": problem.count(), "identities": identities })
    };
    if !matches!(solution, Solution::Family(_)) {
        refuse_settings(set)?;
    }
    match solution {
        Solution::None(conflict) => {
            let list: Vec<String> = conflict.iter().map(|s| complex.source_text(s)).collect();
            head.push_str("no solution: these contradict each other, and no part of them does\n");
            for (source, text) in conflict.iter().zip(&list) {
                let _ = writeln!(head, "  {text}{}", kind(&complex, source));
            }
            let mut json = start("none");
            json["conflict"] = json!(list);
            Ok(Solved { text: head, json, case: None, certificate: None })
        }
        Solution::One(solved) => {
            head.push_str("exactly one solution\n");
            let mut json = start("one");
            let shown = Shown { complex: &solved, family: None, short: Vec::new() };
            shown.write(&problem.operators(), &mut head, &mut json);
            finished(case, &solved, "", head, json)
        }
        Solution::Family(family) => {
            let mut json = start("family");
            let shown = Shown::of(&family);
            shown.parameters(&mut head, &mut json);
            shown.write(&problem.operators(), &mut head, &mut json);
            let values = shown.settings(set)?;
            let member = family.at(&values);
            let list: Vec<String> = shown.short.iter().zip(&values).map(|(n, v)| format!("{n} = {v}")).collect();
            let _ = writeln!(head, "the member written: {}", list.join(", "));
            finished(
                case,
                &member,
                &format!("# Of the family of solutions, the member with {}.\n", list.join(", ")),
                head,
                json,
            )
        }
    }
}

/// Checks all identities once more before the solution is shown.
fn finished(case: &Case, solved: &Complex, remark: &str, text: String, json: Value) -> Result<Solved, Problem> {
    let mistake = |e: &dyn std::fmt::Display| {
        Problem::new("secant::solve::mistake", format!("the solution does not satisfy the identities: {e}"))
            .with_help("this is a mistake in secant: please report it with the case")
    };
    solved.check().map_err(|e| mistake(&e))?;
    solved.shape.check().map_err(|e| mistake(&e))?;
    let case = Some(format!("{remark}{}", case.written_with(solved)));
    Ok(Solved { text, json, case, certificate: None })
}

fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

fn kind(complex: &Complex, source: &Source) -> String {
    match source {
        Source::Identity(i) => format!("   ({} of state `{}`)", i.kind, complex.shape.states[i.state].name),
        Source::Sums(_) => String::new(),
    }
}

fn refuse_settings(set: &[String]) -> Result<(), Problem> {
    match set.first() {
        None => Ok(()),
        Some(text) => Err(Problem::new("secant::usage::set", format!("--set {text}: there is no free parameter"))
            .with_help("leave --set out")),
    }
}

/// Why the entries cannot be solved for, with the place in the file.
pub fn unsolvable(case: &Case, error: &UnknownError) -> Problem {
    let (code, help) = match error {
        UnknownError::Complex(ComplexError::Fails(_)) => {
            ("secant::shape::identity", "the operators that are given contradict each other")
        }
        UnknownError::Complex(_) => ("secant::shape::identity", "the cells of the case do not fit together"),
        UnknownError::Nonlinear { .. } => {
            ("secant::solve::nonlinear", "identities are solved where they are linear: give the boundaries")
        }
        UnknownError::Entry { .. } | UnknownError::Many { .. } => {
            ("secant::case::limit", "give more entries, or name those that are equal")
        }
    };
    match case.unknown.first() {
        Some(first) => case.problem_at_unknown(first, code, &error.to_string(), help),
        None => Problem::new(code, error.to_string()).with_source(&case.text).with_help(help),
    }
}

/// A solution with short names for its parameters.
struct Shown<'a> {
    complex: &'a Complex,
    family: Option<&'a Family>,
    short: Vec<String>,
}

impl<'a> Shown<'a> {
    fn of(family: &'a Family) -> Self {
        // Entries without a name are called after their place, which is too long for a matrix.
        let short = |(k, name): (usize, &String)| if name.contains('[') { format!("p{}", k + 1) } else { name.clone() };
        let short = family.parameters.iter().enumerate().map(short).collect();
        Self { complex: &family.origin, family: Some(family), short }
    }

    fn parameters(&self, text: &mut String, json: &mut Value) {
        let Some(family) = self.family else { return };
        let count = counted(self.short.len(), "free parameter", "free parameters");
        let _ = writeln!(text, "a family of solutions with {count}");
        for (short, name) in self.short.iter().zip(&family.parameters).filter(|(s, n)| s != n) {
            let _ = writeln!(text, "  {short} = {name}");
        }
        json["parameters"] = self
            .short
            .iter()
            .zip(&family.parameters)
            .map(|(short, name)| json!({ "name": short, "entry": name }))
            .collect();
    }

    /// The values of the parameters: 0 where none is given.
    fn settings(&self, given: &[String]) -> Result<Vec<Rational>, Problem> {
        let mut values = vec![Rational::from(0); self.short.len()];
        let problem = |text: &str, message: &str| {
            Problem::new("secant::usage::set", format!("--set {text}: {message}"))
                .with_help(format!("the free parameters are {}", self.short.join(", ")))
        };
        let long = self.family.map_or(&[][..], |f| &f.parameters);
        for text in given {
            let (name, value) = text.split_once('=').ok_or_else(|| problem(text, "NAME=VALUE is expected"))?;
            let at = self.short.iter().position(|s| s == name).or_else(|| long.iter().position(|s| s == name));
            let at = at.ok_or_else(|| problem(text, "there is no such free parameter"))?;
            values[at] = parse_rational(value).map_err(|e| problem(text, &e.to_string()))?;
        }
        Ok(values)
    }

    fn write(&self, operators: &[OpName], text: &mut String, json: &mut Value) {
        let mut list = Vec::new();
        for &op in operators {
            let (Some(origin), name) = (self.complex.operator(op), self.complex.operator_text(op)) else { continue };
            let entries = self.entries(op, origin);
            let _ = writeln!(text, "{name} =");
            text.push_str(&aligned(&entries));
            let mut object = json!({ "operator": name, "matrix": entries });
            if let Some(forced) = self.family.and_then(|f| f.forced(op)) {
                let factors = factor(&forced.polynomial());
                let written = |(p, k): &(crate::poly::Poly, usize)| {
                    let root = if p.degree() == Some(1) { (-p.coeff(0)).to_string() } else { p.primitive_display("x") };
                    if *k == 1 { root } else { format!("{root} ({k} times)") }
                };
                let known: Vec<String> = factors.iter().map(written).collect();
                let free = forced.free.rows();
                let shown = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
                let _ = writeln!(text, "  forced eigenvalues: {shown}; {free} depend on the parameters");
                object["forced"] = factors
                    .iter()
                    .map(|(p, k)| json!({ "factor": p.primitive_display("x"), "multiplicity": k }))
                    .collect();
                object["free"] = json!(free);
            }
            list.push(object);
        }
        json["operators"] = Value::Array(list);
    }

    /// The entries of an operator as affine expressions in the parameters.
    fn entries(&self, op: OpName, origin: &Matrix) -> Vec<Vec<String>> {
        let slopes = self.family.map(|f| f.derivatives(op)).unwrap_or_default();
        let entry = |i: usize, j: usize| {
            let terms = slopes.iter().zip(&self.short).map(|(m, name)| (&m[(i, j)], name.as_str()));
            affine(&origin[(i, j)], terms.filter(|(c, _)| **c != 0))
        };
        (0..origin.rows()).map(|i| (0..origin.cols()).map(|j| entry(i, j)).collect()).collect()
    }
}

/// `1/2 - 3 a + b`.
fn affine<'a>(constant: &Rational, terms: impl Iterator<Item = (&'a Rational, &'a str)>) -> String {
    let mut out = if *constant == 0 { String::new() } else { constant.to_string() };
    for (slope, name) in terms {
        let negative = *slope < 0;
        let size = if negative { -slope } else { slope.clone() };
        out.push_str(match (out.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => "+",
            (false, true) => "-",
        });
        if size != 1 {
            let _ = write!(out, "{size} ");
        }
        out.push_str(name);
    }
    if out.is_empty() { "0".to_owned() } else { out }
}

fn aligned(entries: &[Vec<String>]) -> String {
    let width = |j: usize| entries.iter().map(|r| r[j].chars().count()).max().unwrap_or(0);
    let row = |r: &Vec<String>| {
        let cells: Vec<String> = r.iter().enumerate().map(|(j, x)| format!("{x:>0$}", width(j))).collect();
        format!("    {}\n", cells.join("  "))
    };
    entries.iter().map(row).collect()
}
