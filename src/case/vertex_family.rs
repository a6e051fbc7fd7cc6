//! Rules on meshes with a parameter that is left free: `[parameters]` with `[vertex]`.

use super::curve_family::at_value;
use super::free::{degree, one_free};
use super::node::{File, Table};
use super::parameters::Setting;
use super::{Valences, VertexCase, read};
use crate::arith::Rational;
use crate::diagnostic::{Problem, SourceText};
use crate::scheme::MeshRule;
use std::path::Path;

/// A rule on meshes with one parameter that is left free.
#[derive(Debug, Clone)]
pub struct VertexFamilyCase {
    /// The name of the case.
    pub name: String,
    /// The parameter.
    pub parameter: String,
    /// Its range, with the ends.
    pub range: (Rational, Rational),
    /// The name of the scheme.
    pub scheme: String,
    /// Its weights as polynomials in the parameter, where they are numbers of their own.
    pub weights: Vec<(String, String)>,
    /// The largest degree of an expression.
    pub degree: usize,
    /// The valences of the file.
    pub valences: Option<Valences>,
    /// The file.
    pub text: SourceText,
    set: Vec<(String, Setting)>,
}

/// Keys of `[vertex]` that are no weights.
const OTHERS: [&str; 3] = ["mesh", "valence", "cell"];
/// Highest degree of an expression.
const MAX_DEGREE: usize = 4;

impl VertexFamilyCase {
    /// Reads a case whose weights depend on a parameter; what is set stands instead of what the file says.
    ///
    /// # Errors
    /// A [`Problem`] where not exactly one parameter is left free, or the case has no `[vertex]` table about inner vertices.
    pub fn read(path: &Path, set: &[(String, Setting)]) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        Self::parse(&source.name, &source.text, set)
    }

    /// As [`VertexFamilyCase::read`] for the text of a case.
    ///
    /// # Errors
    /// As [`VertexFamilyCase::read`].
    ///
    /// # Examples
    /// ```
    /// use secant::{arith::ratio, case::VertexFamilyCase};
    /// let text = r#"
    /// name = "a"
    /// [parameters]
    /// b = "0..1/4"
    /// [vertex]
    /// mesh = "loop-variant"
    /// beta = "b/2"
    /// "#;
    /// let case = VertexFamilyCase::parse("a.toml", text, &[])?;
    /// assert_eq!(case.member(&ratio(1, 8))?.weights(), [("beta", "1/16".to_owned())]);
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(name: &str, text: &str, set: &[(String, Setting)]) -> Result<Self, Problem> {
        read::parsed(name, text, File::new, |file, case| Self::of_table(file, case, set))
    }

    fn of_table(file: &File, case: &Table<'_>, set: &[(String, Setting)]) -> Result<Self, Problem> {
        let (name, free) = (read::name(case)?, one_free(case, set)?);
        let degree = degree(case, &file.source.text, &free, MAX_DEGREE)?;
        let table = case.need("vertex", "{ mesh = \"loop-variant\", beta = \"b\" }")?.table()?;
        let mut weights = Vec::new();
        for key in table.keys().into_iter().filter(|k| !OTHERS.contains(&k.as_str())) {
            let found = table.get(&key).and_then(|node| node.polynomial(&free.names).ok());
            weights.extend(found.map(|f| (key, f.display(&free.parameter))));
        }
        let first =
            VertexCase::parse(&file.source.name, &at_value(&file.source, set, &[(&free.parameter, &free.range.0)])?)?;
        if first.border.is_some() {
            return Err(case
                .problem("parameters", "regions are found at vertices inside, not on the border", "this case")
                .with_help("leave out `boundary`, or give the parameter a value: `secant certify CASE p=1/16`"));
        }
        Ok(Self {
            name,
            parameter: free.parameter,
            range: free.range,
            scheme: first.scheme,
            weights,
            degree,
            valences: first.valences,
            text: file.source.clone(),
            set: set.to_vec(),
        })
    }

    /// The rule at a value of the parameter.
    ///
    /// # Errors
    /// A [`Problem`] where the rule does not take the value.
    pub fn member(&self, p: &Rational) -> Result<MeshRule, Problem> {
        let text = at_value(&self.text, &self.set, &[(&self.parameter, p)])?;
        Ok(VertexCase::parse(&self.text.name, &text)?.rule)
    }
}
