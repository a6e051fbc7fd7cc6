use super::Case;
use super::node::{File, Sample};
use crate::algebraic::Elem;
use crate::algebraic::field::{FieldBuilder, FieldMatrix, NumberField};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::poly::Poly;
use toml::de::{DeTable, DeValue};

/// A case whose matrices may have entries in a real number field, such as `sqrt(5)`.
///
/// Sizes and sums are checked as for rational cases. Verdicts are proved for rational operators only, so that such a case
/// is read for its spectra.
#[derive(Debug, Clone)]
pub struct FieldCase {
    /// The smallest field of all entries.
    pub field: NumberField,
    /// For each state its name and its pieces: the target and the operator (columns sum to 1).
    pub states: Vec<(String, Vec<(usize, FieldMatrix)>)>,
}

impl FieldCase {
    /// Reads the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`Case::parse`], also for expressions that cannot be read.
    ///
    /// # Cost
    /// The case is read once for each degree of the field: entries are polynomials in its generator, and everything that
    /// is checked is linear in them, so that values at as many rational numbers determine and check them.
    pub fn parse(name: &str, text: &str) -> Result<Self, Problem> {
        let mut builder = FieldBuilder::new();
        if let Ok(table) = DeTable::parse(text) {
            for key in ["pieces", "map", "state", "control"] {
                if let Some(value) = table.get_ref().get(key) {
                    collect(value.get_ref(), &mut builder);
                }
            }
        }
        let field = builder.field().clone();
        let mut samples = Vec::with_capacity(field.degree());
        for k in 0..field.degree() {
            let at = Rational::from(k);
            let sample = Sample { builder: builder.clone(), at: at.clone() };
            samples.push((at, Case::parse_as(name, text, |source| File::sampled(source, sample))?.closed()?));
        }
        let first = &samples[0].1.shape;
        let mut states = Vec::with_capacity(first.states.len());
        let mut elements = Vec::new();
        for (s, state) in first.states.iter().enumerate() {
            let mut pieces = Vec::with_capacity(state.pieces.len());
            for (p, piece) in state.pieces.iter().enumerate() {
                let values: Vec<(&Rational, &Matrix)> =
                    samples.iter().map(|(t, c)| (t, &c.shape.states[s].pieces[p].op)).collect();
                let matrix = interpolated(&field, &values);
                elements.extend(matrix.entries().iter().cloned());
                pieces.push((piece.target, matrix));
            }
            states.push((state.name.clone(), pieces));
        }
        let (small, moved) = field.shrunk(&elements);
        let mut moved = moved.into_iter();
        for (_, matrix) in states.iter_mut().flat_map(|(_, pieces)| pieces) {
            let data = moved.by_ref().take(matrix.rows() * matrix.cols()).collect();
            *matrix = FieldMatrix::new(&small, matrix.rows(), matrix.cols(), data);
        }
        Ok(Self { field: small, states })
    }
}

/// Puts the generators of all expressions into the field; what cannot be read is reported later, in its place.
fn collect(value: &DeValue<'_>, builder: &mut FieldBuilder) {
    match value {
        DeValue::String(text) if parse_rational(text).is_err() => {
            let _ = builder.parse(text);
        }
        DeValue::Array(items) => items.iter().for_each(|v| collect(v.get_ref(), builder)),
        DeValue::Table(table) => table.iter().for_each(|(_, v)| collect(v.get_ref(), builder)),
        _ => {}
    }
}

/// The matrix of polynomials of degree less than the number of samples with the given values.
fn interpolated(field: &NumberField, samples: &[(&Rational, &Matrix)]) -> FieldMatrix {
    let (rows, cols) = (samples[0].1.rows(), samples[0].1.cols());
    FieldMatrix::from_fn(field, rows, cols, |i, j| {
        // Newton's form: the value that is still missing at each next sample.
        let mut sum = Poly::zero();
        let mut basis = Poly::constant(Rational::from(1));
        for (t, matrix) in samples {
            let missing = &matrix[(i, j)] - sum.eval(t);
            if missing != 0 {
                sum = &sum + &basis.scale(&(missing / basis.eval(t)));
            }
            basis = &basis * &Poly::linear(t);
        }
        Elem(sum)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    const CURVE: &str = r#"
name = "golden"
convention = "columns"
pieces = [
  [["1", "sqrt(5)/8"], ["0", "1 - sqrt(5)/8"]],
  [["(3-sqrt(5))/4", 0], ["(1 + sqrt(5))/4", "1"]],
]
"#;

    #[test]
    fn operators_over_a_field_come_back() {
        let case = FieldCase::parse("golden.toml", CURVE).unwrap();
        assert_eq!(case.field.label(), Some("sqrt(5)"));
        let (_, op) = &case.states[0].1[0];
        assert_eq!(op[(1, 1)], Elem(Poly::new(vec![ratio(1, 1), ratio(-1, 8)])));
        assert_eq!(op[(1, 0)], Elem::zero());
    }

    #[test]
    fn verdicts_are_refused_with_a_way_on() {
        let problem = Case::parse("golden.toml", CURVE).unwrap_err();
        assert_eq!(problem.id(), "secant::case::irrational-entry");
        assert_eq!(problem.position(), Some((5, 10)));
        assert!(problem.remedy().unwrap().contains("secant spectrum"));
        let rational = CURVE.replace("sqrt(5)", "sqrt(4)");
        let problem = Case::parse("golden.toml", &rational).unwrap_err();
        assert_eq!((problem.id(), problem.remedy()), ("secant::case::expression", Some("write \"1/4\" here")));
        assert!(FieldCase::parse("golden.toml", &rational).unwrap().field.is_rational());
    }

    #[test]
    fn mistakes_in_expressions_are_told() {
        for (from, to, code) in [
            ("1 - sqrt(5)/8", "1 - sqrt(5)/9", "sum"),
            ("1 - sqrt(5)/8", "1 - sqrt(-5)/8", "number"),
            ("1 - sqrt(5)/8", "1 - sqrt(5)/(2-2)", "number"),
            ("1 - sqrt(5)/8", "1 - wurzel(5)/8", "number"),
            ("1 - sqrt(5)/8", "half", "number"),
        ] {
            let problem = FieldCase::parse("golden.toml", &CURVE.replace(from, to)).unwrap_err();
            assert_eq!(problem.id(), format!("secant::case::{code}"), "{to}");
        }
    }
}
