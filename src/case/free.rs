//! Parameters that are left free, and the degrees of expressions in them.

use super::member::{Expression, expressions, mentions};
use super::node::{Table, clipped};
use super::parameters::{FORMULA_WORDS, Setting, parameters};
use crate::algebraic::field::MAX_FIELD_DEGREE;
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::poly::Poly;
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::DeTable;

/// The one parameter that is left free, and what every name stands for: the free one for itself.
pub(super) struct Free {
    pub parameter: String,
    pub range: (Rational, Rational),
    pub names: BTreeMap<String, Poly>,
}

/// The parameters of a family.
pub(super) fn one_free(case: &Table<'_>, set: &[(String, Setting)]) -> Result<Free, Problem> {
    let all = parameters(case, set)?;
    let free: Vec<(&String, &Rational, &Rational)> = all
        .iter()
        .filter_map(|(n, s)| match s {
            Setting::Range(from, to) => Some((n, from, to)),
            Setting::Value(_) => None,
        })
        .collect();
    let [(parameter, from, to)] = free.as_slice() else {
        let message = format!("{} parameters are left free, and exactly one is needed", free.len());
        return Err(case.problem("parameters", message, "this case").with_help(
            "give one of them a range, behind the case as in  w=-1/2..1/2  or under [parameters] as in  w = \"-1/2..1/2\", and the \
             others values",
        ));
    };
    let variable = Poly::linear(&Rational::from(0));
    let value = |(n, s): &(String, Setting)| match s {
        Setting::Value(q) => (n.clone(), Poly::constant(q.clone())),
        Setting::Range(..) => (n.clone(), variable.clone()),
    };
    let names = all.iter().map(value).collect();
    Ok(Free { parameter: (*parameter).clone(), range: ((*from).clone(), (*to).clone()), names })
}

/// Two parameters that are left free.
pub(super) struct TwoFree {
    pub parameters: [String; 2],
    pub ranges: [(Rational, Rational); 2],
    /// What the other names stand for.
    names: BTreeMap<String, Poly>,
}

/// The parameters of a family with two that are left free; `None` where it is not two.
pub(super) fn two_free(case: &Table<'_>, set: &[(String, Setting)]) -> Result<Option<TwoFree>, Problem> {
    let (mut names, mut free) = (BTreeMap::new(), Vec::new());
    for (name, setting) in parameters(case, set)? {
        match setting {
            Setting::Value(q) => {
                names.insert(name, Poly::constant(q));
            }
            Setting::Range(from, to) => free.push((name, (from, to))),
        }
    }
    let Ok([(p, first), (q, second)]) = <[_; 2]>::try_from(free) else { return Ok(None) };
    Ok(Some(TwoFree { parameters: [p, q], ranges: [first, second], names }))
}

/// So many values of a range in equal steps, from its lower end on.
pub(super) fn samples((lo, hi): &(Rational, Rational), count: usize) -> Vec<Rational> {
    (0..count).map(|k| lo + (hi - lo) * Rational::from_unsigneds(k as u64, count as u64)).collect()
}

/// Highest degree of the expressions in the free parameter, from 1 to `most`.
///
/// # Errors
/// A [`Problem`] where it is another, or an expression is no polynomial, such as `1/(1+p^2)`.
pub(super) fn degree(case: &Table<'_>, text: &str, free: &Free, most: usize) -> Result<usize, Problem> {
    let Ok(table) = DeTable::parse(text) else { return Ok(0) };
    within(case, along(case, &table, &free.names, &[&free.parameter])?, most, &format!("`{}`", free.parameter))
}

/// Highest degree of the expressions in two free parameters together, from 1 to `most`.
///
/// # Errors
/// As [`degree`].
pub(super) fn total_degree(case: &Table<'_>, text: &str, free: &TwoFree, most: usize) -> Result<usize, Problem> {
    let Ok(table) = DeTable::parse(text) else { return Ok(0) };
    let [p, q] = &free.parameters;
    let variable = Poly::linear(&Rational::from(0));
    // Along the lines `q = k p`: the part of highest degree vanishes on no more of them than its degree, and a divisor with
    // parameters is a number on no more of them than its own.
    let degrees = (1..=MAX_FIELD_DEGREE as u64 + 1).map(|k| {
        let mut names = free.names.clone();
        names.extend([(p.clone(), variable.clone()), (q.clone(), variable.scale(&Rational::from(k)))]);
        along(case, &table, &names, &[p, q])
    });
    let highest = degrees.collect::<Result<Vec<_>, _>>()?.into_iter().fold(0, usize::max);
    within(case, highest, most, &format!("`{p}` and `{q}`"))
}

fn within(case: &Table<'_>, degree: usize, most: usize, of: &str) -> Result<usize, Problem> {
    if (1..=most).contains(&degree) {
        return Ok(degree);
    }
    let message = format!("the expressions are polynomials of degree {degree} in {of}");
    Err(case
        .problem("parameters", message, "this case")
        .with_help(format!("regions of such cases are found for degrees from 1 to {most}")))
}

/// Highest degree of the expressions with what names stand for.
///
/// # Errors
/// A [`Problem`] at an expression that holds a free parameter and is no polynomial.
fn along(
    case: &Table<'_>,
    table: &Spanned<DeTable<'_>>,
    names: &BTreeMap<String, Poly>,
    free: &[&String],
) -> Result<usize, Problem> {
    let mut degree = 0;
    for (span, expression) in expressions(table, names) {
        match expression {
            Expression::Polynomial(f) => degree = degree.max(f.degree().unwrap_or(0)),
            Expression::Formula(text) => {
                let Some(name) = free.iter().find(|name| mentions(&text, |word| word == name.as_str())) else {
                    continue;
                };
                let formula = case.get("vertex").is_some() && mentions(&text, |word| FORMULA_WORDS.contains(&word));
                let message = match formula {
                    true => format!(
                        "`{}` has the parameter `{name}` and the valence in one weight, which regions do not take yet",
                        clipped(&text)
                    ),
                    false => format!("`{}` is no polynomial in `{name}`", clipped(&text)),
                };
                let single =
                    "regions are found for polynomials; single values can be asked: `secant certify CASE p=1/16`";
                return Err(case.file.problem("parameters", message, span, "this expression").with_help(single));
            }
        }
    }
    Ok(degree)
}
