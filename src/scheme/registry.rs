//! Schemes by name.

use super::mask::with_vertices;
use super::{Mask, SchemeError, curves, univariate};
use crate::arith::{Rational, parse_rational};
use crate::poly::Poly;
use crate::ring::{Fraction, Functions};
use crate::shape::Shape;
use std::collections::BTreeMap;

/// A parameter of a named scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its value where none is given; `None`: it must be given.
    pub default: Option<&'static str>,
    /// What it is.
    pub summary: &'static str,
}

/// A named scheme.
#[derive(Debug, Clone, Copy)]
pub struct SchemeInfo {
    /// Its name.
    pub name: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Where it was published.
    pub source: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    build: Build,
}

/// What a named scheme is built from.
#[derive(Debug, Clone, Copy)]
enum Build {
    Mask(fn(&Values) -> Result<Mask, SchemeError>),
    /// A mask of this arity whose coefficients are polynomials in one parameter.
    Family(Family),
    Shape(fn(&Values) -> Result<Shape, SchemeError>),
}

/// A mask whose coefficients depend on one parameter.
#[derive(Debug, Clone, Copy)]
struct Family {
    arity: usize,
    parameter: &'static str,
    member: fn(&Rational) -> Result<Mask, SchemeError>,
    coefficients: fn(&Functions, &Fraction) -> Vec<Fraction>,
}

/// Values of parameters by name, defaults filled in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Values(BTreeMap<&'static str, Rational>);

impl Values {
    pub(super) fn none() -> Self {
        Self(BTreeMap::new())
    }

    pub(super) fn number(&self, name: &str) -> &Rational {
        &self.0[name]
    }

    /// What is missing to a sum of 1.
    pub(super) fn rest(&self) -> Rational {
        self.0.values().fold(Rational::from(1), |rest, x| rest - x)
    }

    fn count(&self, name: &str) -> Result<usize, SchemeError> {
        let value = self.number(name);
        usize::try_from(value)
            .ok()
            .filter(|n| *n <= 1_000_000)
            .ok_or_else(|| SchemeError::value(name, value, "a whole number from 0 is needed"))
    }
}

pub(super) const fn p(name: &'static str, default: Option<&'static str>, summary: &'static str) -> Parameter {
    Parameter { name, default, summary }
}

/// All named schemes, in alphabetical order.
#[must_use]
pub fn list() -> &'static [SchemeInfo] {
    LIST
}

/// Builds a named scheme; parameters that are not given take their defaults.
///
/// # Errors
/// [`SchemeError::Unknown`], [`SchemeError::Parameter`], [`SchemeError::Missing`], and those of the scheme.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, scheme};
/// let shape = scheme::build("bspline", &[("degree".to_owned(), ratio(3, 1))].into())?;
/// assert_eq!(shape.states[0].dim, 4);
/// # Ok::<(), scheme::SchemeError>(())
/// ```
pub fn build(name: &str, parameters: &BTreeMap<String, Rational>) -> Result<Shape, SchemeError> {
    let (build, values) = find(name, parameters)?;
    match build {
        Build::Mask(mask) => mask(&values)?.curve(),
        Build::Family(family) => family.mask(&values)?.curve(),
        Build::Shape(shape) => shape(&values),
    }
}

/// The same curve with vertex states at its ends, as tensor products need it: on all coordinates where the scheme has a
/// mask ([`Mask::curve_with_vertices`]), with its end points as vertices on one coordinate otherwise.
///
/// # Errors
/// As for [`build`]; [`SchemeError::Value`] where the scheme is no curve.
pub fn build_with_vertices(name: &str, parameters: &BTreeMap<String, Rational>) -> Result<Shape, SchemeError> {
    let (build, values) = find(name, parameters)?;
    match build {
        Build::Mask(mask) => mask(&values)?.curve_with_vertices(),
        Build::Family(family) => family.mask(&values)?.curve_with_vertices(),
        Build::Shape(shape) => with_vertices(shape(&values)?),
    }
}

/// The mask of a named scheme; `None` where it has none.
///
/// # Errors
/// As for [`build`].
pub fn mask(name: &str, parameters: &BTreeMap<String, Rational>) -> Result<Option<Mask>, SchemeError> {
    let (build, values) = find(name, parameters)?;
    match build {
        Build::Mask(mask) => mask(&values).map(Some),
        Build::Family(family) => family.mask(&values).map(Some),
        Build::Shape(_) => Ok(None),
    }
}

/// The arity and the coefficients of the mask of a named scheme whose parameter is a polynomial in another one; `None` where
/// the scheme has no mask with such a parameter.
///
/// # Errors
/// [`SchemeError::Unknown`]; [`SchemeError::Parameter`] for a parameter that the scheme does not have.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, poly::Poly, scheme};
/// let w = Poly::new(vec![ratio(0, 1), ratio(1, 1)]);
/// let (arity, mask) = scheme::mask_family("four-point", "w", &w)?.expect("a mask");
/// assert_eq!((arity, mask[2].eval(&ratio(1, 16))), (2, ratio(9, 16)));
/// # Ok::<(), scheme::SchemeError>(())
/// ```
pub fn mask_family(name: &str, parameter: &str, value: &Poly) -> Result<Option<(usize, Vec<Poly>)>, SchemeError> {
    let given = [(parameter.to_owned(), Rational::from(0))].into();
    let Build::Family(family) = find(name, &given)?.0 else { return Ok(None) };
    let field = Functions::anywhere();
    let all = (family.coefficients)(&field, &Fraction::polynomial(value.clone()));
    let whole = |f: Fraction| (f.den.degree() == Some(0)).then_some(f.num);
    Ok(all.into_iter().map(whole).collect::<Option<Vec<_>>>().map(|mask| (family.arity, mask)))
}

impl Family {
    fn mask(&self, values: &Values) -> Result<Mask, SchemeError> {
        (self.member)(values.number(self.parameter))
    }
}

fn find(name: &str, parameters: &BTreeMap<String, Rational>) -> Result<(Build, Values), SchemeError> {
    let info = LIST.iter().find(|s| s.name == name);
    let info = info.ok_or_else(|| unknown(name, LIST.iter().map(|s| s.name)))?;
    Ok((info.build, resolve(name, info.parameters, parameters)?))
}

/// Fills in the defaults and refuses what the scheme does not have.
pub(super) fn resolve(
    scheme: &str,
    wanted: &'static [Parameter],
    given: &BTreeMap<String, Rational>,
) -> Result<Values, SchemeError> {
    if let Some(parameter) = given.keys().find(|k| wanted.iter().all(|p| p.name != k.as_str())) {
        let names: Vec<&str> = wanted.iter().map(|p| p.name).collect();
        let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        return Err(SchemeError::Parameter { scheme: scheme.to_owned(), parameter: parameter.clone(), known });
    }
    let mut values = BTreeMap::new();
    for parameter in wanted {
        let own = given.get(parameter.name).cloned();
        let value = own.or_else(|| parameter.default.and_then(|text| parse_rational(text).ok()));
        let missing = || SchemeError::Missing {
            scheme: scheme.to_owned(),
            parameter: parameter.name.to_owned(),
            summary: parameter.summary.to_owned(),
        };
        values.insert(parameter.name, value.ok_or_else(missing)?);
    }
    Ok(Values(values))
}

/// The error for a name that is not among `known`.
pub(super) fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> SchemeError {
    // One letter in three may be wrong.
    let near = known.map(|k| (distance(name, k), k)).filter(|(d, k)| 3 * d <= k.len().max(3)).min();
    SchemeError::Unknown { name: name.to_owned(), near: near.map(|(_, k)| k.to_owned()) }
}

/// The number of single-letter changes between two words (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().take(64).enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let change = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

const LIST: &[SchemeInfo] = &[
    SchemeInfo {
        name: "arrowhead",
        parameters: &[],
        source: "W. Sierpiński, C. R. Acad. Sci. Paris 160 (1915)",
        summary: "Sierpiński's arrowhead, 3 pieces, in the coordinates x + y√−3",
        build: Build::Shape(|_| curves::arrowhead()),
    },
    SchemeInfo {
        name: "bezier",
        parameters: &[
            p("degree", Some("3"), "degree, from 1"),
            p("split", Some("1/2"), "parameter at which de Casteljau's algorithm divides, between 0 and 1"),
        ],
        source: "P. de Casteljau (1959); G. Farin, Curves and Surfaces for CAGD, ch. 4",
        summary: "Bézier curve with de Casteljau's subdivision",
        build: Build::Shape(|v| curves::bezier(v.count("degree")?, v.number("split"))),
    },
    SchemeInfo {
        name: "bspline",
        parameters: &[p("degree", Some("3"), "degree, from 1"), p("arity", Some("2"), "number of pieces, from 2")],
        source: "J. Lane, R. Riesenfeld, IEEE PAMI 2 (1980)",
        summary: "uniform B-spline",
        build: Build::Mask(|v| univariate::bspline(v.count("degree")?, v.count("arity")?)),
    },
    SchemeInfo {
        name: "corner-cutting",
        parameters: &[p("a", None, "p'_2i = (1−a) p_i + a p_i+1"), p("b", None, "p'_2i+1 = b p_i + (1−b) p_i+1")],
        source: "G. de Rham (1956); J. Gregory, R. Qu, CAGD 13 (1996); S. Podkorytov, thesis (2013), §2.1",
        summary: "corner cutting with two parameters; a = −1/4, b = 1/2 is the thesis's half-tangent",
        build: Build::Shape(|v| curves::corner_cutting(v.number("a"), v.number("b"))),
    },
    SchemeInfo {
        name: "de-rham",
        parameters: &[p("a", Some("1/3"), "part of each edge that is cut off at both ends")],
        source: "G. de Rham, J. Math. Pures Appl. 35 (1956)",
        summary: "de Rham's corner cutting; a = 1/4 is Chaikin's",
        build: Build::Shape(|v| curves::corner_cutting(v.number("a"), v.number("a"))),
    },
    SchemeInfo {
        name: "dragon",
        parameters: &[],
        source: "C. Davis, D. Knuth, Number representations and dragon curves (1970)",
        summary: "Heighway's dragon; its second piece runs backwards",
        build: Build::Shape(|_| curves::dragon()),
    },
    SchemeInfo {
        name: "dubuc-deslauriers",
        parameters: &[p("points", Some("4"), "number of points of the interpolating polynomial, even")],
        source: "G. Deslauriers, S. Dubuc, Constr. Approx. 5 (1989)",
        summary: "symmetric interpolatory subdivision on 2n points",
        build: Build::Mask(|v| univariate::dubuc_deslauriers(v.count("points")?)),
    },
    SchemeInfo {
        name: "fern",
        parameters: &[],
        source: "M. Barnsley, Fractals Everywhere (1988), table III.3",
        summary: "Barnsley's fern, a set",
        build: Build::Shape(|_| curves::fern()),
    },
    SchemeInfo {
        name: "four-point",
        parameters: &[p("w", Some("1/16"), "tension")],
        source: "N. Dyn, D. Levin, J. Gregory, CAGD 4 (1987)",
        summary: "interpolatory 4-point scheme with tension",
        build: Build::Family(Family {
            arity: 2,
            parameter: "w",
            member: univariate::four_point,
            coefficients: univariate::four_point_over,
        }),
    },
    SchemeInfo {
        name: "hilbert",
        parameters: &[],
        source: "D. Hilbert, Math. Ann. 38 (1891)",
        summary: "Hilbert's curve",
        build: Build::Shape(|_| curves::hilbert()),
    },
    SchemeInfo {
        name: "hormann-sabin",
        parameters: &[p("k", Some("4"), "number of smoothing factors, from 1")],
        source: "K. Hormann, M. Sabin, CAGD 25 (2008)",
        summary: "family of schemes with cubic precision",
        build: Build::Mask(|v| univariate::hormann_sabin(v.count("k")?)),
    },
    SchemeInfo {
        name: "koch",
        parameters: &[p("pieces", Some("4"), "4, or 2 mirrored ones")],
        source: "H. von Koch, Arkiv för Matematik 1 (1904)",
        summary: "Koch's curve, in the coordinates x + y√−3",
        build: Build::Shape(|v| curves::koch(v.count("pieces")?)),
    },
    SchemeInfo {
        name: "lebesgue",
        parameters: &[p("a", Some("1/3"), "first step, between 0 and 1")],
        source: "G. de Rham, Rend. Sem. Mat. Torino 16 (1957)",
        summary: "singular function with steps a, 1 − a",
        build: Build::Shape(|v| curves::lebesgue(v.number("a"))),
    },
    SchemeInfo {
        name: "levy",
        parameters: &[],
        source: "P. Lévy, J. École Polytechnique (1938)",
        summary: "Lévy's C curve",
        build: Build::Shape(|_| curves::levy()),
    },
    SchemeInfo {
        name: "minkowski-sausage",
        parameters: &[],
        source: "B. Mandelbrot, The Fractal Geometry of Nature (1982), plate 49",
        summary: "quadratic Koch curve of 8 pieces",
        build: Build::Shape(|_| curves::minkowski_sausage()),
    },
    SchemeInfo {
        name: "okamoto",
        parameters: &[p("a", Some("2/3"), "first step, between 0 and 1")],
        source: "H. Okamoto, Proc. Japan Acad. 81 (2005)",
        summary: "Okamoto's function with steps a, 1 − 2a, a",
        build: Build::Shape(|v| curves::okamoto(v.number("a"))),
    },
    SchemeInfo {
        name: "peano",
        parameters: &[],
        source: "G. Peano, Math. Ann. 36 (1890)",
        summary: "Peano's curve, 9 pieces",
        build: Build::Shape(|_| curves::peano()),
    },
    SchemeInfo {
        name: "sierpinski",
        parameters: &[],
        source: "W. Sierpiński, C. R. Acad. Sci. Paris 160 (1915)",
        summary: "Sierpiński's triangle, a set",
        build: Build::Shape(|_| curves::sierpinski()),
    },
    SchemeInfo {
        name: "takagi",
        parameters: &[p("alpha", Some("1/2"), "vertical factor, between −1 and 1")],
        source: "T. Takagi (1903); G. Landsberg (1908)",
        summary: "Takagi's and Landsberg's curve; alpha = 1/4 is a parabola",
        build: Build::Shape(|v| curves::takagi(v.number("alpha"))),
    },
    SchemeInfo {
        name: "terdragon",
        parameters: &[],
        source: "C. Davis, D. Knuth, Number representations and dragon curves (1970)",
        summary: "terdragon, 3 pieces, in the coordinates x + y√−3",
        build: Build::Shape(|_| curves::terdragon()),
    },
    SchemeInfo {
        name: "ternary-four-point",
        parameters: &[p("mu", Some("1/11"), "tension; C² for 1/15 < mu < 1/9")],
        source: "M. Hassan, I. Ivrissimtzis, N. Dodgson, M. Sabin, CAGD 19 (2002)",
        summary: "ternary interpolatory 4-point scheme",
        build: Build::Family(Family {
            arity: 3,
            parameter: "mu",
            member: univariate::ternary_four_point,
            coefficients: univariate::ternary_four_point_over,
        }),
    },
    SchemeInfo {
        name: "ternary-three-point",
        parameters: &[p("b", Some("4/15"), "tension; C¹ for 2/9 < b < 1/3")],
        source: "M. Hassan, N. Dodgson, Curve and Surface Fitting: Saint-Malo 2002",
        summary: "ternary interpolatory 3-point scheme",
        build: Build::Family(Family {
            arity: 3,
            parameter: "b",
            member: univariate::ternary_three_point,
            coefficients: univariate::ternary_three_point_over,
        }),
    },
];
