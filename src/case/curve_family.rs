//! Curves with a parameter that is left free: `[parameters]` with maps or operators.

use super::free::{degree, one_free, samples};
use super::member::member_text;
use super::node::{File, Table};
use super::parameters::Setting;
use super::{Case, read};
use crate::arith::Rational;
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::shape::{CellKind, Shape};
use std::path::Path;
use toml::de::DeTable;

/// A curve with one parameter that is left free.
#[derive(Debug, Clone)]
pub struct CurveFamilyCase {
    /// The name of the case.
    pub name: String,
    /// The parameter.
    pub parameter: String,
    /// Its range, with the ends.
    pub range: (Rational, Rational),
    /// The operators of the pieces, polynomials in the parameter.
    pub operators: Vec<Matrix<Poly>>,
    /// Which pieces are run backwards.
    pub reversed: Vec<bool>,
    /// The control points.
    pub control: Option<Matrix>,
}

/// How a case with parameters is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FamilyForm {
    /// With `[scheme]`.
    Mask,
    /// With maps or operators.
    Curve,
    /// With `[vertex]`.
    Vertex,
}

impl FamilyForm {
    /// The form of the text of a case; what is no case at all is left to the reader of masks to complain about.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let Ok(table) = DeTable::parse(text) else { return Self::Mask };
        let has = |key: &str| table.get_ref().keys().any(|k| *k.get_ref() == key);
        if has("vertex") {
            Self::Vertex
        } else if ["map", "pieces", "state"].into_iter().any(has) {
            Self::Curve
        } else {
            Self::Mask
        }
    }
}

/// Highest degree of an expression.
const MAX_DEGREE: usize = 8;
/// Members beyond those that determine the entries, to compare with.
const FURTHER: usize = 4;

impl CurveFamilyCase {
    /// Reads a case whose maps or operators depend on a parameter; what is set stands instead of what the file says.
    ///
    /// # Errors
    /// A [`Problem`] where not exactly one parameter is left free, or the case is no curve with one state.
    pub fn read(path: &Path, set: &[(String, Setting)]) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        Self::parse(&source.name, &source.text, set)
    }

    /// As [`CurveFamilyCase::read`] for the text of a case.
    ///
    /// # Errors
    /// As [`CurveFamilyCase::read`].
    ///
    /// # Examples
    /// ```
    /// use secant::case::CurveFamilyCase;
    /// let text = r#"
    /// name = "a"
    /// [parameters]
    /// r = "-1..1"
    /// [[map]]
    /// linear = [["1/2", 0], ["1/2", "r"]]
    /// shift = [0, 0]
    /// [[map]]
    /// linear = [["1/2", 0], ["-1/2", "r"]]
    /// shift = ["1/2", "1/2"]
    /// "#;
    /// let case = CurveFamilyCase::parse("a.toml", text, &[])?;
    /// assert_eq!(case.operators[1][(2, 2)].display("r"), "r + 1/2");
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(name: &str, text: &str, set: &[(String, Setting)]) -> Result<Self, Problem> {
        read::parsed(name, text, File::new, |file, case| Self::of_table(file, case, set))
    }

    fn of_table(file: &File, case: &Table<'_>, set: &[(String, Setting)]) -> Result<Self, Problem> {
        let (name, free) = (read::name(case)?, one_free(case, set)?);
        let text = &file.source.text;
        let degree = degree(case, text, &free, MAX_DEGREE)?;
        let at = samples(&free.range, degree + 1 + FURTHER);
        let member =
            |p: &Rational| Case::parse(&file.source.name, &at_value(&file.source, set, &[(&free.parameter, p)])?);
        let members = at.iter().map(member).collect::<Result<Vec<_>, _>>()?;
        let shapes: Vec<&Shape> = members.iter().map(|m| &m.shape).collect();
        // Entries of operators and maps that are written out are sums of products of numbers of the file with constants, so that
        // their degree is no higher; those of a scheme may be of any.
        let written = members.iter().all(|m| m.scheme.is_none());
        let Some((operators, control)) = family(&at, &shapes, degree).filter(|_| written) else {
            return Err(case
                .problem(
                    "parameters",
                    "regions are found for curves with one state, written as maps or operators, whose control points do not \
                     depend on the parameter",
                    "this case",
                )
                .with_help("give the parameter a value behind the case, as in `secant certify CASE w=1/16`"));
        };
        let reversed = shapes[0].states[0].pieces.iter().map(|p| p.reversed).collect();
        Ok(Self { name, parameter: free.parameter, range: free.range, operators, reversed, control })
    }

    /// The family in its plain form, which a checker reads.
    #[must_use]
    pub fn plain(&self) -> String {
        let quoted = |q: &Rational| format!("\"{q}\"");
        let list = |items: Vec<String>| format!("[{}]", items.join(", "));
        let entry = |f: &Poly| list(f.coeffs().iter().map(quoted).collect());
        let piece = |m: &Matrix<Poly>| {
            let rows = (0..m.rows()).map(|i| format!("    {},\n", list(m.row(i).iter().map(entry).collect())));
            format!("  [\n{}  ],\n", rows.collect::<String>())
        };
        let control =
            self.control.iter().flat_map(|p| (0..p.rows()).map(|i| list(p.row(i).iter().map(quoted).collect())));
        let reversed = self.reversed.iter().map(|r| format!("\"{}\"", u8::from(*r)));
        let (from, to) = &self.range;
        format!(
            "# Operators of a curve; entries by powers of the parameter, the lowest first.\nname = \"{}\"\nparameter = \"{}\"\n\
             range = [\"{from}\", \"{to}\"]\nreversed = {}\ncontrol = {}\npieces = [\n{}]\n",
            self.name,
            self.parameter,
            list(reversed.collect()),
            list(control.collect()),
            self.operators.iter().map(piece).collect::<String>()
        )
    }
}

/// The text of a case with values for what is left free.
pub(super) fn at_value(
    source: &SourceText,
    set: &[(String, Setting)],
    values: &[(&String, &Rational)],
) -> Result<String, Problem> {
    let mut set = set.to_vec();
    set.retain(|(n, _)| values.iter().all(|(name, _)| *name != n));
    set.extend(values.iter().map(|(name, value)| ((*name).clone(), Setting::Value((*value).clone()))));
    Ok(member_text(&source.name, &source.text, &set)?.unwrap_or_else(|| source.text.to_string()))
}

/// Operators whose entries have at most this degree, and the control points, from members; `None` where they are no such family.
fn family(at: &[Rational], shapes: &[&Shape], degree: usize) -> Option<(Vec<Matrix<Poly>>, Option<Matrix>)> {
    let first = shapes.first()?;
    let alike = |s: &&Shape| {
        let [state] = s.states.as_slice() else { return false };
        let edge = state.kind == CellKind::Edge && state.left.is_none() && state.right.is_none();
        edge && s.control == first.control && state.pieces.len() == first.states[0].pieces.len()
    };
    if !shapes.iter().all(alike) {
        return None;
    }
    let known = &at[..=degree];
    let operator = |k: usize| {
        let own: Vec<&Matrix> = shapes.iter().map(|s| &s.states[0].pieces[k].op).collect();
        let entry =
            |i: usize, j: usize| Poly::through(known, own[..=degree].iter().map(|m| m[(i, j)].clone()).collect());
        let found = Matrix::from_fn(own[0].rows(), own[0].cols(), entry);
        let fits = at.iter().zip(&own).all(|(p, m)| found.map(|f| f.eval(p)) == **m);
        fits.then_some(found)
    };
    let operators = (0..first.states[0].pieces.len()).map(operator).collect::<Option<Vec<_>>>()?;
    Some((operators, first.control.clone()))
}
