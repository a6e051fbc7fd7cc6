use crate::arith::Rational;
use crate::shape::{CurveError, ShapeError};
use thiserror::Error;

/// Why a scheme could not be built.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SchemeError {
    /// No scheme of that name.
    #[error("there is no scheme `{name}`{}", near.as_ref().map_or_else(String::new, |near| format!("; did you mean `{near}`?")))]
    Unknown {
        /// The name given.
        name: String,
        /// The listed name nearest to it, where one is near.
        near: Option<String>,
    },
    /// A parameter that the scheme does not have.
    #[error("scheme `{scheme}` has no parameter `{parameter}`; it has {known}")]
    Parameter {
        /// The scheme.
        scheme: String,
        /// The name given.
        parameter: String,
        /// The names it has.
        known: String,
    },
    /// A parameter without a default was not given.
    #[error("scheme `{scheme}` needs the parameter `{parameter}`: {summary}")]
    Missing {
        /// The scheme.
        scheme: String,
        /// The parameter.
        parameter: String,
        /// What it is.
        summary: String,
    },
    /// The weights of a new point do not add up to 1.
    #[error("{rule}: the weights of a new point add up to {sum}, not to 1")]
    Weights {
        /// The rule.
        rule: &'static str,
        /// Their sum.
        sum: Rational,
    },
    /// Points on too few rings around a vertex depend on points farther out.
    #[error("{rule}: {rings} ring(s) do not determine their successors; take {}", rings + 1)]
    Rings {
        /// The rule.
        rule: &'static str,
        /// The rings.
        rings: usize,
    },
    /// The eigenvalues of a rule around a vertex are not real.
    #[error("{rule}: the weights have no mirror symmetry, and the eigenvalues are not real")]
    Asymmetric {
        /// The rule.
        rule: &'static str,
    },
    /// A parameter out of range.
    #[error("{parameter} = {value}: {expected}")]
    Value {
        /// The parameter.
        parameter: String,
        /// The value given.
        value: String,
        /// What it must be.
        expected: String,
    },
    /// The arity is not in the range that is built.
    #[error("a mask of arity {0} cannot be used; the arity is an integer from 2 to 64")]
    Arity(usize),
    /// A mask too short for a curve.
    #[error(
        "the limit of this mask is constant between the integers, with jumps there, and no curve; a curve needs at least \
         {needed} coefficients between the first and last nonzero one, and the mask has {found}"
    )]
    Short {
        /// Coefficients needed.
        needed: usize,
        /// Coefficients found.
        found: usize,
    },
    /// More than is built.
    #[error("{what} {size} is over the limit of {limit}")]
    Large {
        /// What is too large.
        what: &'static str,
        /// Its size.
        size: usize,
        /// The limit.
        limit: usize,
    },
    /// A sum rule fails: the scheme does not reproduce constants.
    #[error(
        "the mask violates a sum rule: the coefficients with index {residue} modulo {arity} add up to {sum}, not to 1{hint}"
    )]
    SumRule {
        /// The arity.
        arity: usize,
        /// The residue class.
        residue: usize,
        /// Its sum.
        sum: Rational,
        /// How to mend it, where the cause is plain.
        hint: String,
    },
    /// A Laurent symbol that cannot be read.
    #[error("the symbol cannot be read at character {position}: {message}")]
    Symbol {
        /// Position of the character, from 0.
        position: usize,
        /// What is wrong.
        message: String,
    },
    /// Irrational numbers are needed.
    #[error("{0} needs irrational weights, and the operators of a shape are rational")]
    Irrational(String),
    /// The operators do not contract, so there is no curve.
    #[error("the scheme does not converge: {0}")]
    Divergent(String),
    /// The pieces do not meet.
    #[error(transparent)]
    Curve(Box<CurveError>),
    /// The result is not a model.
    #[error(transparent)]
    Shape(Box<ShapeError>),
    /// A mesh rule that cannot be applied.
    #[error("{rule}: {message}")]
    Mesh {
        /// The rule.
        rule: String,
        /// What is wrong.
        message: String,
    },
    /// An import that cannot be read.
    #[error("line {line}: {message}")]
    Import {
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
}

impl From<CurveError> for SchemeError {
    fn from(error: CurveError) -> Self {
        Self::Curve(Box::new(error))
    }
}

impl From<ShapeError> for SchemeError {
    fn from(error: ShapeError) -> Self {
        Self::Shape(Box::new(error))
    }
}

impl SchemeError {
    /// A [`SchemeError::Value`].
    pub(crate) fn value(parameter: &str, value: &impl ToString, expected: &str) -> Self {
        Self::Value { parameter: parameter.to_owned(), value: value.to_string(), expected: expected.to_owned() }
    }
}
