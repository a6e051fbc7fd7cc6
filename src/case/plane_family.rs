//! Curves with two parameters that are left free.

use super::node::{File, Table};
use super::parameters::{Setting, expressions, member_text, two_free};
use super::{Case, read};
use crate::arith::Rational;
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Matrix;
use crate::poly::{Poly, Two};
use crate::shape::{CellKind, Shape};
use std::path::Path;
use toml::de::DeTable;

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

/// Highest degree of an expression in one parameter.
const MAX_DEGREE: usize = 4;

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
        let degree = |k: usize| {
            DeTable::parse(&file.source.text).map_or(0, |table| {
                expressions(&table, &free.names[k]).iter().filter_map(|(_, f)| f.degree()).fold(0, usize::max)
            })
        };
        let degrees = [degree(0), degree(1)];
        if degrees.iter().any(|d| !(1..=MAX_DEGREE).contains(d)) {
            return Err(case
                .problem(
                    "parameters",
                    format!("the entries have the degrees {} and {}", degrees[0], degrees[1]),
                    "this case",
                )
                .with_help(format!("regions in the plane are found for degrees from 1 to {MAX_DEGREE}")));
        }
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
        // One value more than the degrees need, to compare with.
        let at = |k: usize| -> Vec<Rational> {
            let (lo, hi) = &found.ranges[k];
            let count = degrees[k] as u64 + 2;
            (0..count).map(|j| lo + (hi - lo) * Rational::from_unsigneds(j + 1, count + 1)).collect()
        };
        let at = [at(0), at(1)];
        let row =
            |q: &Rational| at[0].iter().map(|p| Ok(found.member(p, q)?.shape)).collect::<Result<Vec<_>, Problem>>();
        let shapes = at[1].iter().map(row).collect::<Result<Vec<_>, _>>()?;
        let Some((operators, reversed, control)) = family(&at, &shapes) else {
            return Err(case
                .problem(
                    "parameters",
                    "regions are found for curves with one state, whose control points do not depend on the parameters",
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
        let mut set = self.set.clone();
        set.retain(|(n, _)| !self.parameters.contains(n));
        for (name, value) in self.parameters.iter().zip([p, q]) {
            set.push((name.clone(), Setting::Value(value.clone())));
        }
        match member_text(&self.text.name, &self.text.text, &set)? {
            Some(own) => Case::parse(&self.text.name, &own),
            None => Case::parse(&self.text.name, &self.text.text),
        }
    }
}

type Operators = (Vec<Matrix<Two>>, Vec<bool>, Option<Matrix>);

/// Operators from members on a grid, by the second parameter and then the first; `None` where they are no such family.
fn family(at: &[Vec<Rational>; 2], shapes: &[Vec<Shape>]) -> Option<Operators> {
    let first = shapes.first()?.first()?;
    let state = first.states.first()?;
    let alike = |s: &Shape| {
        let [own] = s.states.as_slice() else { return false };
        let edge = own.kind == CellKind::Edge && own.left.is_none() && own.right.is_none();
        edge && s.control == first.control && own.pieces.len() == state.pieces.len()
    };
    if !shapes.iter().flatten().all(alike) {
        return None;
    }
    let (columns, rows) = (at[0].len() - 1, at[1].len() - 1);
    let operator = |k: usize| {
        let own = |j: usize, i: usize| &shapes[j][i].states[0].pieces[k].op;
        let entry = |r: usize, c: usize| {
            let along =
                |j: usize| Poly::through(&at[0][..columns], (0..columns).map(|i| own(j, i)[(r, c)].clone()).collect());
            let lines: Vec<Poly> = (0..rows).map(along).collect();
            let across = |i: usize| Poly::through(&at[1][..rows], lines.iter().map(|f| f.coeff(i)).collect());
            let powers: Vec<Poly> = (0..columns).map(across).collect();
            Two::new((0..rows).map(|j| Poly::new(powers.iter().map(|f| f.coeff(j)).collect())).collect())
        };
        let size = own(0, 0);
        let found = Matrix::from_fn(size.rows(), size.cols(), entry);
        let fits = |j: usize, i: usize| found.map(|f| f.eval(&at[0][i], &at[1][j])) == *own(j, i);
        (0..=rows).all(|j| (0..=columns).all(|i| fits(j, i))).then_some(found)
    };
    let operators = (0..state.pieces.len()).map(operator).collect::<Option<Vec<_>>>()?;
    Some((operators, state.pieces.iter().map(|p| p.reversed).collect(), first.control.clone()))
}
