//! Cases with entries in a real number field, such as `sqrt(5)`.

use super::node::{File, Sample};
use super::{Case, Origin};
use crate::algebraic::field::{FieldBuilder, NumberField};
use crate::algebraic::{Elem, Real};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::Problem;
use crate::jordan::Scalar;
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::shape::{Boundary, CellKind, Piece, Shape, State, entries};
use std::borrow::Cow;
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// How many numbers beyond the degree of the field a case is read for, to see that its entries are linear in those of the file.
const MORE: usize = 1;

impl Case<Real> {
    /// Reads the text of a case whose operators, maps, masks and control points may have entries in a real number field;
    /// `name` is shown in diagnostics. All entries are put into one field, the smallest that holds them.
    ///
    /// # Errors
    /// As [`Case::parse`], also for expressions that cannot be read; for surfaces, and for schemes that are more than a mask.
    ///
    /// # Cost
    /// The case is read once more than the field has degrees: entries are polynomials in its generator, and everything that
    /// is checked is linear in them, so that values at as many rational numbers determine and check them.
    pub fn over_field(name: &str, text: &str) -> Result<Self, Problem> {
        let (mut case, built) = Self::as_written(name, &super::valued(name, text)?)?;
        let field = Real::base(entries(&case.shape));
        if !field.is_rational() && (built || case.numbers.is_none()) {
            // Operators over the generator of the field, whose roots and cosines lie in it.
            let flat = case.flat_text();
            let (again, _) = Self::as_written(name, &flat)?;
            case.numbers = again.numbers.filter(|_| Real::base(entries(&again.shape)).same(&field));
            case.flat = Some(flat);
        }
        Ok(case)
    }

    /// The case, and whether a scheme stands in it.
    fn as_written(name: &str, text: &str) -> Result<(Self, bool), Problem> {
        let mut builder = FieldBuilder::new();
        if let Ok(table) = DeTable::parse(text) {
            for key in ["pieces", "map", "state", "control", "scheme"] {
                if let Some(value) = table.get_ref().get(key) {
                    collect(value.get_ref(), &mut builder);
                }
            }
        }
        let field = builder.field().clone();
        let mut samples = Vec::with_capacity(field.degree() + MORE);
        for k in 0..field.degree() + MORE {
            let at = place(k);
            let sample = Sample { builder: builder.clone(), at: at.clone() };
            samples.push((at, Case::parse_as(name, text, |source| File::sampled(source, sample))?.closed()?));
        }
        let first = &samples[0].1;
        let plain = matches!(first.scheme, None | Some(Origin::Mask(_) | Origin::Filter(..) | Origin::Polygon(_)));
        let faces = first.shape.states.iter().any(|s| s.kind == CellKind::Face);
        let shapes: Vec<(&Rational, &Shape)> = samples.iter().map(|(t, case)| (t, &case.shape)).collect();
        let mut asked: Vec<Elem> = builder.asked().iter().map(|x| builder.elem(x)).collect();
        asked.sort_by(|a, b| a.0.coeffs().cmp(b.0.coeffs()));
        asked.dedup();
        let shape = if plain && !faces { over(&field, &shapes, &asked) } else { None };
        let Some((shape, numbers)) = shape else {
            let message = "irrational entries are read in curves and sets, and in masks";
            let help = "surfaces, shares of the parameter, and schemes that are no masks, need rational numbers";
            return Err(first.problem_at_state(first.shape.start, "secant::case::irrational-entry", message, help));
        };
        // What a scheme was built from was read with a rational number in the place of the generator.
        Ok((Self { numbers, ..first.with_shape(shape) }, first.scheme.is_some()))
    }

    /// The text that a checker reads: the file itself, or [`Case::flat`].
    #[must_use]
    pub fn checked_over_field(&self) -> Cow<'_, str> {
        self.flat.as_ref().map_or(Cow::Borrowed(&self.text.text), |text| Cow::Borrowed(text))
    }

    /// The case with its entries rounded to so many binary digits, for pictures: nothing is proved of it.
    #[must_use]
    pub fn rounded(&self, bits: u64) -> Case {
        self.with_shape(self.shape.rounded(bits))
    }
}

/// Rational numbers at which no entry of a file is likely to vanish.
fn place(k: usize) -> Rational {
    Rational::from(1 + k) + Rational::from_unsigneds(4_099u64, 7_919u64)
}

/// The shape whose values these are, and some more numbers where they lie in the field of its entries; `None` where the values are
/// not those of polynomials of smaller degree than the field.
fn over(
    field: &NumberField,
    samples: &[(&Rational, &Shape)],
    asked: &[Elem],
) -> Option<(Shape<Real>, Option<Vec<Real>>)> {
    let mut matrices: Vec<Matrix<Elem>> = Vec::new();
    let mut read = |part: &dyn Fn(&Shape) -> Option<&Matrix>| -> Option<usize> {
        let values: Option<Vec<(&Rational, &Matrix)>> = samples.iter().map(|(t, s)| Some((*t, part(s)?))).collect();
        matrices.push(interpolated(field.degree(), &values?)?);
        Some(matrices.len() - 1)
    };
    let first = samples[0].1;
    let mut indices = Vec::new();
    for (s, state) in first.states.iter().enumerate() {
        let pieces: Option<Vec<usize>> =
            (0..state.pieces.len()).map(|p| read(&|x| Some(&x.states.get(s)?.pieces.get(p)?.op))).collect();
        let left = state.left.as_ref().map(|_| read(&|x| Some(&x.states.get(s)?.left.as_ref()?.op)));
        let right = state.right.as_ref().map(|_| read(&|x| Some(&x.states.get(s)?.right.as_ref()?.op)));
        indices.push((pieces?, left, right));
    }
    let control = first.control.as_ref().map(|_| read(&|x| x.control.as_ref()));
    let elements: Vec<Elem> = matrices.iter().flat_map(|m| m.entries().iter().cloned()).collect();
    let (small, moved) = field.shrunk(&elements);
    let small = Arc::new(small);
    let (all, every) = field.shrunk(&[elements.as_slice(), asked].concat());
    let numbers = (all.degree() == small.degree() && all.same(&small))
        .then(|| every[elements.len()..].iter().map(|x| Real::new(&small, x.clone())).collect());
    let mut moved = moved.into_iter();
    let matrices: Vec<Matrix<Real>> =
        matrices.iter().map(|m| m.map(|_| Real::new(&small, moved.next().expect("as many as before")))).collect();
    // Parts of the parameter are rational.
    for (s, state) in first.states.iter().enumerate() {
        for (p, piece) in state.pieces.iter().enumerate() {
            let other = |x: &Shape| x.states.get(s).and_then(|y| y.pieces.get(p)).map(|y| y.share.clone());
            if samples.iter().any(|(_, x)| other(x) != Some(piece.share.clone())) {
                return None;
            }
        }
    }
    let mut states = Vec::new();
    for (state, (pieces, left, right)) in first.states.iter().zip(indices) {
        let piece = |(p, k): (&Piece, usize)| Piece {
            target: p.target,
            op: matrices[k].clone(),
            reversed: p.reversed,
            share: p.share.clone(),
        };
        let boundary = |old: &Option<Boundary>, k: Option<Option<usize>>| match (old, k) {
            (Some(b), Some(k)) => Some(Some(Boundary { vertex: b.vertex, op: matrices[k?].clone() })),
            _ => Some(None),
        };
        states.push(State {
            name: state.name.clone(),
            kind: state.kind,
            dim: state.dim,
            pieces: state.pieces.iter().zip(pieces).map(piece).collect(),
            left: boundary(&state.left, left)?,
            right: boundary(&state.right, right)?,
        });
    }
    let control = match control {
        Some(k) => Some(matrices[k?].clone()),
        None => None,
    };
    Some((Shape { states, start: first.start, control, frame: first.frame }, numbers))
}

/// Whether a case is refused because an entry is not rational, or is not written as a rational.
#[must_use]
pub fn is_over_field(problem: &Problem) -> bool {
    matches!(problem.id(), "secant::case::irrational-entry" | "secant::case::expression")
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

/// The matrix of polynomials of degree less than `degree` with the given values; `None` where there is none.
fn interpolated(degree: usize, samples: &[(&Rational, &Matrix)]) -> Option<Matrix<Elem>> {
    let size = |m: &Matrix| (m.rows(), m.cols());
    let (rows, cols) = size(samples[0].1);
    if samples.iter().any(|(_, m)| size(m) != (rows, cols)) {
        return None;
    }
    let mut fits = true;
    let found = Matrix::from_fn(rows, cols, |i, j| {
        // Newton's form: the value that is still missing at each next sample.
        let mut sum = Poly::zero();
        let mut basis = Poly::constant(Rational::from(1));
        for (k, (t, matrix)) in samples.iter().enumerate() {
            let missing = &matrix[(i, j)] - sum.eval(t);
            fits &= k < degree || missing == 0;
            if missing != 0 {
                sum = &sum + &basis.scale(&(missing / basis.eval(t)));
            }
            basis = &basis * &Poly::linear(t);
        }
        Elem(sum)
    });
    fits.then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Entry;

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
        let case = Case::over_field("golden.toml", CURVE).unwrap();
        let op = &case.shape.states[0].pieces[0].op;
        assert_eq!(op[(1, 1)].field().unwrap().label(), Some("sqrt(5)"));
        assert_eq!(op[(1, 1)].elem(), Elem(Poly::new(vec![ratio(1, 1), ratio(-1, 8)])));
        assert_eq!(op[(1, 0)].rational(), Some(ratio(0, 1)));
    }

    #[test]
    fn irrational_shares_are_refused() {
        let maps = "name = \"shares\"\n[[map]]\nlinear = [[\"sqrt(2)/2\", 0], [\"1/2\", \"1/3\"]]\nshift = [0, 0]\nshare = \"A\"\n\
                    [[map]]\nlinear = [[\"1-sqrt(2)/2\", 0], [\"-1/2\", \"1/3\"]]\nshift = [\"sqrt(2)/2\", \"1/2\"]\nshare = \"B\"\n";
        let read = |a: &str, b: &str| Case::over_field("shares.toml", &maps.replace('A', a).replace('B', b));
        assert!(read("1/3", "2/3").is_ok());
        assert!(read("sqrt(2)/5", "1-sqrt(2)/5").is_err());
    }

    #[test]
    fn rational_cases_have_rational_entries() {
        let problem = Case::parse("golden.toml", CURVE).unwrap_err();
        assert_eq!(problem.id(), "secant::case::irrational-entry");
        assert_eq!(problem.position(), Some((5, 10)));
        let rational = CURVE.replace("sqrt(5)", "sqrt(4)");
        let problem = Case::parse("golden.toml", &rational).unwrap_err();
        assert_eq!((problem.id(), problem.remedy()), ("secant::case::expression", Some("write \"1/4\" here")));
        let case = Case::over_field("golden.toml", &rational).unwrap();
        assert!(case.shape.states[0].pieces.iter().all(|p| Real::field_of(p.op.entries()).is_none()));
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
            let problem = Case::over_field("golden.toml", &CURVE.replace(from, to)).unwrap_err();
            assert_eq!(problem.id(), format!("secant::case::{code}"), "{to}");
        }
    }
}
