//! Named masks on lattices.

use super::super::{self as scheme, Laurent, SchemeError};
use super::{Dilation, LatticeError, LatticeMask, MAX_COEFFICIENTS, Terms, dilation::MAX_DIMENSIONS};
use crate::arith::{Rational, parse_rational, ratio};
use std::collections::BTreeMap;

/// The directions of a box spline, each as often as it counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoxSpline {
    /// The directions.
    pub directions: Vec<Vec<i64>>,
}

/// Most directions.
const MAX_DIRECTIONS: usize = 24;
/// Largest coordinate of a direction.
const MAX_STEP: i64 = 16;

type Given = BTreeMap<String, String>;

struct Named {
    name: &'static str,
    parameters: &'static [&'static str],
    summary: &'static str,
    build: fn(&Given) -> Result<LatticeMask, LatticeError>,
}

const LIST: [Named; 6] = [
    Named {
        name: "box-spline",
        parameters: &["directions"],
        summary: "directions=\"(1,0)^2 (0,1)^2 (1,1)^2\": the box spline with these directions",
        build: box_spline,
    },
    Named {
        name: "butterfly",
        parameters: &["w"],
        summary: "w=1/16: the butterfly scheme on the regular net",
        build: butterfly,
    },
    Named {
        name: "four-eight",
        parameters: &[],
        summary: "one step of the 4-8 scheme on the regular net, with the quincunx dilation",
        build: |_| LatticeMask::new(Terms::parse("(1+x)^2*(1+y)^2/8", 2)?, Dilation::parse("quincunx")?),
    },
    Named {
        name: "loop",
        parameters: &[],
        summary: "Loop's scheme on the regular net, the box spline with (1,0), (0,1), (1,1) twice each",
        build: |_| spline(vec![vec![1, 0], vec![1, 0], vec![0, 1], vec![0, 1], vec![1, 1], vec![1, 1]]),
    },
    Named {
        name: "sqrt3",
        parameters: &["alpha"],
        summary: "alpha=1/3: one step of the √3 scheme on the regular net",
        build: sqrt3,
    },
    Named {
        name: "tensor",
        parameters: &["first", "second"],
        summary: "first=\"four-point w=1/16\" second=\"(1+z)^3/4\": the product of two masks in one variable of one arity",
        build: tensor,
    },
];

/// The names, each with its parameters.
#[must_use]
pub fn lattice_names() -> Vec<(&'static str, &'static str)> {
    LIST.iter().map(|n| (n.name, n.summary)).collect()
}

/// A named mask; `None` where there is none of this name.
///
/// # Errors
/// [`LatticeError`] where the parameters do not fit.
///
/// # Examples
/// ```
/// use secant::scheme::named_mask;
/// let butterfly = named_mask("butterfly", &["w=1/32".to_owned()]).expect("a name")?;
/// assert_eq!(butterfly.terms().len(), 25);
/// assert!(named_mask("chaikin", &[]).is_none());
/// # Ok::<(), secant::scheme::LatticeError>(())
/// ```
#[must_use]
pub fn named_mask(name: &str, parameters: &[String]) -> Option<Result<LatticeMask, LatticeError>> {
    let known = LIST.iter().find(|n| n.name == name)?;
    let read = parameters.iter().map(|text| {
        let (key, value) =
            text.split_once('=').ok_or_else(|| wrong(format!("`{text}` is not of the form name=value")))?;
        if known.parameters.contains(&key.trim()) {
            return Ok((key.trim().to_owned(), value.trim().to_owned()));
        }
        let has = if known.parameters.is_empty() { "no parameters".to_owned() } else { known.parameters.join(", ") };
        Err(wrong(format!("`{name}` has no parameter `{}`; it has {has}", key.trim())))
    });
    Some(read.collect::<Result<Given, _>>().and_then(|given| (known.build)(&given)))
}

fn wrong(message: String) -> LatticeError {
    LatticeError::Parameter(message)
}

fn number(given: &Given, name: &str, default: Rational) -> Result<Rational, LatticeError> {
    given.get(name).map_or(Ok(default), |text| Ok(parse_rational(text)?))
}

fn box_spline(given: &Given) -> Result<LatticeMask, LatticeError> {
    let Some(text) = given.get("directions") else {
        return Err(wrong("a box spline needs directions, as in directions=\"(1,0)^2 (0,1)^2 (1,1)^2\"".to_owned()));
    };
    spline(directions(text)?)
}

/// Directions in brackets, `(1,0)^2 (0,1)`, with or without commas between them and brackets around all.
fn directions(text: &str) -> Result<Vec<Vec<i64>>, LatticeError> {
    let bad = || wrong(format!("`{text}` is no list of directions such as (1,0)^2 (0,1)^2 (1,1)^2"));
    let inner = text.trim().strip_prefix("[[").and_then(|t| t.strip_suffix("]]")).map(|t| format!("[{t}]"));
    let text_of = inner.as_deref().unwrap_or(text);
    let mut all: Vec<Vec<i64>> = Vec::new();
    for part in text_of.split(['(', '[']).skip(1) {
        let (numbers, rest) = part.split_once([')', ']']).ok_or_else(bad)?;
        let direction = numbers.split(',').map(|x| x.trim().parse::<i64>());
        let direction = direction.collect::<Result<Vec<_>, _>>().map_err(|_| bad())?;
        let rest = rest.trim_matches([' ', ',']);
        let times = match rest.strip_prefix('^') {
            Some(power) => power.trim().parse::<usize>().map_err(|_| bad())?,
            None if rest.is_empty() => 1,
            None => return Err(bad()),
        };
        all.extend(std::iter::repeat_n(direction, times.min(MAX_DIRECTIONS + 1)));
    }
    if all.is_empty() {
        return Err(bad());
    }
    Ok(all)
}

/// The mask `2^s Π (1 + z^v)/2` of a box spline, with twice the unit matrix as dilation.
pub(super) fn spline(directions: Vec<Vec<i64>>) -> Result<LatticeMask, LatticeError> {
    let s = directions.first().map_or(0, Vec::len);
    let fits = |v: &Vec<i64>| v.len() == s && v.iter().all(|x| x.abs() <= MAX_STEP) && v.iter().any(|x| *x != 0);
    if !(1..=MAX_DIRECTIONS).contains(&directions.len()) || s > MAX_DIMENSIONS || !directions.iter().all(fits) {
        return Err(wrong(format!(
            "a box spline has 1 to {MAX_DIRECTIONS} directions, not 0, of coordinates up to {MAX_STEP}"
        )));
    }
    let half = ratio(1, 2);
    let start = Terms::new(s, [(vec![0; s], Rational::from(1 << s.min(8)))]);
    let terms = directions.iter().try_fold(start, |p, v| {
        let p = p.times(&Terms::binomial(v)).scaled(&half);
        let (found, most) = (p.len(), MAX_COEFFICIENTS);
        if found > most { Err(LatticeError::Large { found, most }) } else { Ok(p) }
    })?;
    Ok(LatticeMask::new(terms, Dilation::scalar(s, 2)?)?.of_splines(BoxSpline { directions }))
}

impl BoxSpline {
    /// The determinants of all choices of `s` directions.
    pub(crate) fn determinants(&self) -> Vec<i64> {
        let s = self.directions.first().map_or(0, Vec::len);
        let mut found = Vec::new();
        choose(&self.directions, s, &mut Vec::new(), &mut found);
        found
    }
}

fn choose(rest: &[Vec<i64>], s: usize, chosen: &mut Vec<Vec<i64>>, found: &mut Vec<i64>) {
    if chosen.len() == s {
        found.push(determinant(chosen));
        return;
    }
    for (k, v) in rest.iter().enumerate() {
        chosen.push(v.clone());
        choose(&rest[k + 1..], s, chosen, found);
        chosen.pop();
    }
}

/// By expansion along the first row.
fn determinant(rows: &[Vec<i64>]) -> i64 {
    let Some((top, below)) = rows.split_first() else { return 1 };
    let minor = |k: usize| {
        let without = |row: &Vec<i64>| row.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, x)| *x).collect();
        determinant(&below.iter().map(without).collect::<Vec<Vec<i64>>>())
    };
    let sign = |k: usize| if k.is_multiple_of(2) { 1 } else { -1 };
    top.iter().enumerate().filter(|(_, x)| **x != 0).map(|(k, x)| sign(k) * x * minor(k)).sum()
}

/// The six neighbours in the net of triangles with the edges (1,0), (1,1), (0,1), anticlockwise.
const NEIGHBOURS: [[i64; 2]; 6] = [[1, 0], [1, 1], [0, 1], [-1, 0], [-1, -1], [0, -1]];

/// New points at the middle of edges: half the ends, `2w` the opposite vertices of the two triangles, `−w` the four behind them.
fn butterfly(given: &Given) -> Result<LatticeMask, LatticeError> {
    let w = number(given, "w", ratio(1, 16))?;
    let mut terms = vec![(vec![0, 0], Rational::from(1))];
    for (k, u) in NEIGHBOURS.iter().enumerate() {
        // Of the edge from 0 to u, the point 0 has the weight m(u), and so on by turns of the net: each orbit once.
        let (l, r) = (NEIGHBOURS[(k + 1) % 6], NEIGHBOURS[(k + 5) % 6]);
        let at = |b: [i64; 2]| vec![u[0] - 2 * b[0], u[1] - 2 * b[1]];
        terms.push((at([0, 0]), ratio(1, 2)));
        terms.push((at(l), &w * ratio(2, 1)));
        for b in [[l[0] + u[0], l[1] + u[1]], [r[0] + u[0], r[1] + u[1]]] {
            terms.push((at(b), -&w));
        }
    }
    LatticeMask::new(Terms::new(2, terms), Dilation::scalar(2, 2)?)
}

/// New points at the centres of triangles, old ones `1 − alpha` of themselves and `alpha/6` of each neighbour; the edges are (1,0),
/// (0,1), (1,−1).
fn sqrt3(given: &Given) -> Result<LatticeMask, LatticeError> {
    let alpha = number(given, "alpha", ratio(1, 3))?;
    let dilation = Dilation::parse("sqrt3")?;
    let mut terms = vec![(vec![0, 0], Rational::from(1) - &alpha)];
    for e in [[1, 0], [0, 1], [1, -1], [-1, 0], [0, -1], [-1, 1]] {
        terms.push((e.to_vec(), ratio(1, 3)));
        terms.push((dilation.apply(&e), &alpha / ratio(6, 1)));
    }
    LatticeMask::new(Terms::new(2, terms), dilation)
}

fn tensor(given: &Given) -> Result<LatticeMask, LatticeError> {
    let part = |name: &str| {
        given
            .get(name)
            .ok_or_else(|| wrong(format!("a product needs `{name}`, as in {name}=four-point or {name}=\"(1+z)^3/4\"")))
    };
    let (first, second) = (univariate(part("first")?)?, univariate(part("second")?)?);
    if first.1 != second.1 {
        return Err(wrong("the two masks have different arities".to_owned()));
    }
    LatticeMask::new(Terms::product_of(&[first.0, second.0]), Dilation::scalar(2, first.1)?)
}

/// A mask in one variable with its arity: a named scheme with parameters, a symbol of arity 2, or coefficients.
fn univariate(text: &str) -> Result<(Laurent, i64), LatticeError> {
    let mut words = text.split_whitespace();
    let name = words.next().unwrap_or_default();
    if scheme::list().iter().any(|s| s.name == name) {
        let mut values = BTreeMap::new();
        for word in words {
            let (key, value) =
                word.split_once('=').ok_or_else(|| wrong(format!("`{word}` is not of the form name=value")))?;
            values.insert(key.to_owned(), parse_rational(value)?);
        }
        let mask = scheme::mask(name, &values)?.ok_or_else(|| wrong(format!("`{name}` has no mask")))?;
        let arity = i64::try_from(mask.arity()).map_err(|_| SchemeError::Arity(mask.arity()))?;
        return Ok((Laurent::new(0, mask.coefficients().to_vec()), arity));
    }
    if text.contains('z') {
        return Ok((Laurent::parse(text)?, 2));
    }
    let numbers = text.trim_matches(['[', ']']).split(',').map(|t| parse_rational(t.trim()));
    Ok((Laurent::new(0, numbers.collect::<Result<Vec<_>, _>>()?), 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(name: &str, parameters: &[&str]) -> LatticeMask {
        let parameters: Vec<String> = parameters.iter().map(|p| (*p).to_owned()).collect();
        named_mask(name, &parameters).unwrap().unwrap()
    }

    #[test]
    fn names_are_what_the_symbols_say() {
        let symbol = LatticeMask::parse("(1+x)^2*(1+y)^2*(1+x*y)^2/16", None).unwrap();
        assert_eq!(made("loop", &[]).terms(), symbol.terms());
        assert_eq!(made("box-spline", &["directions=(1,0)^2 (0,1)^2, (1,1)^2"]), made("loop", &[]));
        assert_eq!(made("box-spline", &["directions=[[1,0],[1,0],[0,1],[0,1],[1,1],[1,1]]"]), made("loop", &[]));
        let bicubic = LatticeMask::parse("(1+x)^4*(1+y)^4/64", None).unwrap();
        assert_eq!(made("tensor", &["first=bspline degree=3", "second=(1+z)^4/8"]).terms(), bicubic.terms());
        assert!(named_mask("butterfly", &["tension=1".to_owned()]).unwrap().is_err());
        assert!(named_mask("box-spline", &["directions=(1,0) (0,1)^x".to_owned()]).unwrap().is_err());
    }

    #[test]
    fn determinants_of_directions() {
        let zwart_powell = made("box-spline", &["directions=(1,0)(0,1)(1,1)(1,-1)"]);
        let found = zwart_powell.box_spline().unwrap().determinants();
        assert_eq!(found.iter().filter(|d| d.abs() == 1).count(), 5);
        assert_eq!(found.iter().map(|d| d.abs()).max(), Some(2));
    }
}
