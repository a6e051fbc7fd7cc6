//! Curves with two parameters that are left free.

use super::curve_family::at_value;
use super::free::{samples, total_degree, two_free};
use super::node::{File, Table};
use super::parameters::Setting;
use super::{Case, read};
use crate::arith::Rational;
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Matrix;
use crate::poly::{Poly, Two};
use crate::shape::{CellKind, Shape};
use std::path::Path;

/// A curve with two parameters that are left free.
#[derive(Debug, Clone)]
pub struct PlaneFamilyCase {
    /// The name of the case.
    pub name: String,
    /// The parameters.
    pub parameters: [String; 2],
    /// Their ranges, with the ends.
    pub ranges: [(Rational, Rational); 2],
    /// The operators of the pieces, polynomials in the parameters.
    pub operators: Vec<Matrix<Two>>,
    /// Which pieces are run backwards.
    pub reversed: Vec<bool>,
    /// The control points.
    pub control: Option<Matrix>,
    text: SourceText,
    set: Vec<(String, Setting)>,
}

/// Highest degree of an expression in both parameters together.
const MAX_DEGREE: usize = 6;
/// Values of each parameter beyond those that determine the entries, to compare with.
const FURTHER: usize = 2;

impl PlaneFamilyCase {
    /// Reads a case whose maps or operators depend on two parameters; `None` where not exactly two are left free.
    ///
    /// # Errors
    /// A [`Problem`] where the case is no curve with one state.
    pub fn read(path: &Path, set: &[(String, Setting)]) -> Result<Option<Self>, Problem> {
        let source = SourceText::read(path)?;
        Self::parse(&source.name, &source.text, set)
    }

    /// As [`PlaneFamilyCase::read`] for the text of a case.
    ///
    /// # Errors
    /// As [`PlaneFamilyCase::read`].
    pub fn parse(name: &str, text: &str, set: &[(String, Setting)]) -> Result<Option<Self>, Problem> {
        read::parsed(name, text, File::new, |file, case| Self::of_table(file, case, set))
    }

    fn of_table(file: &File, case: &Table<'_>, set: &[(String, Setting)]) -> Result<Option<Self>, Problem> {
        let Some(free) = two_free(case, set)? else { return Ok(None) };
        let name = read::name(case)?;
        let degree = total_degree(case, &file.source.text, &free, MAX_DEGREE)?;
        let mut found = Self {
            name,
            parameters: free.parameters,
            ranges: free.ranges,
            operators: Vec::new(),
            reversed: Vec::new(),
            control: None,
            text: file.source.clone(),
            set: set.to_vec(),
        };
        let at = found.ranges.each_ref().map(|range| samples(range, degree + 1 + FURTHER));
        let row = |q: &Rational| at[0].iter().map(|p| found.member(p, q)).collect::<Result<Vec<_>, _>>();
        let members = at[1].iter().map(row).collect::<Result<Vec<_>, _>>()?;
        // Entries of operators and maps that are written out have no higher degree than the expressions; those of a scheme may.
        let written = members.iter().flatten().all(|m| m.scheme.is_none());
        let Some((operators, reversed, control)) = family(&at, &members, degree).filter(|_| written) else {
            return Err(case
                .problem(
                    "parameters",
                    "regions are found for curves with one state, written as maps or operators, whose control points do not \
                     depend on the parameters",
                    "this case",
                )
                .with_help("give the parameters values behind the case, as in `secant certify CASE a=1/4 b=1/3`"));
        };
        (found.operators, found.reversed, found.control) = (operators, reversed, control);
        Ok(Some(found))
    }

    /// The case with values for both parameters.
    ///
    /// # Errors
    /// A [`Problem`] where it is no case.
    pub fn member(&self, p: &Rational, q: &Rational) -> Result<Case, Problem> {
        let [first, second] = &self.parameters;
        Case::parse(&self.text.name, &at_value(&self.text, &self.set, &[(first, p), (second, q)])?)
    }
}

type Operators = (Vec<Matrix<Two>>, Vec<bool>, Option<Matrix>);

/// Operators whose entries have at most this degree, from members on a grid, by the second parameter and then the first; `None`
/// where they are no such family.
fn family(at: &[Vec<Rational>; 2], members: &[Vec<Case>], degree: usize) -> Option<Operators> {
    let shapes: Vec<Vec<&Shape>> = members.iter().map(|row| row.iter().map(|m| &m.shape).collect()).collect();
    let first = *shapes.first()?.first()?;
    let state = first.states.first()?;
    let reversed = |s: &Shape| -> Vec<bool> { s.states[0].pieces.iter().map(|p| p.reversed).collect() };
    let alike = |s: &&Shape| {
        let [own] = s.states.as_slice() else { return false };
        let edge = own.kind == CellKind::Edge && own.left.is_none() && own.right.is_none();
        edge && s.control == first.control && reversed(s) == reversed(first)
    };
    if !shapes.iter().flatten().all(alike) {
        return None;
    }
    let known = [&at[0][..=degree], &at[1][..=degree]];
    let operator = |k: usize| {
        let own = |j: usize, i: usize| &shapes[j][i].states[0].pieces[k].op;
        let entry = |r: usize, c: usize| {
            let along = |j: usize| Poly::through(known[0], (0..=degree).map(|i| own(j, i)[(r, c)].clone()).collect());
            let lines: Vec<Poly> = (0..=degree).map(along).collect();
            Two::through(known[1], &lines)
        };
        let size = own(0, 0);
        let found = Matrix::from_fn(size.rows(), size.cols(), entry);
        let fits = |j: usize, i: usize| found.map(|f| f.eval(&at[0][i], &at[1][j])) == *own(j, i);
        let everywhere = (0..at[1].len()).all(|j| (0..at[0].len()).all(|i| fits(j, i)));
        everywhere.then_some(found)
    };
    let operators = (0..state.pieces.len()).map(operator).collect::<Option<Vec<_>>>()?;
    Some((operators, reversed(first), first.control.clone()))
}
