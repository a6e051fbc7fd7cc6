//! Smoothness of curves in the uniform parameter, in the visible quotients: worked values, and systems with killed directions
//! against systems without them, closed forms and exact difference quotients.

use proptest::prelude::*;
use secant::arith::{Integer, Rational, abs, ratio, to_f64};
use secant::linalg::Matrix;
use secant::radius::Options;
use secant::scheme::Interpolation;
use secant::shape::{Address, CellKind, End, Frame, Piece, Shape, Spaces, State};
use secant::theorem::Side;
use secant::theorem::characteristic::Characteristic;
use secant::theorem::local::{LocalContext, LocalLimit, LocalSide};
use secant::theorem::smoothness::{CurveRegularity, Outcome, Seen, curve_regularity};

/// An affine map `R^m -> R^n` as rows `[shift, coefficients…]`, on the simplices `0, e_1, …`.
fn map(rows: &[Vec<Rational>]) -> Matrix {
    let inputs = rows[0].len() - 1;
    let image = |j: usize| -> Vec<Rational> {
        let x = rows.iter().map(|r| if j == 0 { r[0].clone() } else { &r[0] + &r[j] }).collect::<Vec<_>>();
        let rest = Rational::from(1) - x.iter().fold(Rational::from(0), |s, v| s + v);
        std::iter::once(rest).chain(x).collect()
    };
    Matrix::from_columns(rows.len() + 1, &(0..=inputs).map(image).collect::<Vec<_>>())
}

fn integers(rows: &[&[(i64, i64)]]) -> Matrix {
    map(&rows.iter().map(|r| r.iter().map(|&(p, q)| ratio(p, q)).collect()).collect::<Vec<_>>())
}

fn state(name: &str, pieces: Vec<(usize, Matrix)>) -> State {
    let dim = pieces[0].1.rows();
    let pieces = pieces.into_iter().map(|(target, op)| Piece { target, op, reversed: false, share: None }).collect();
    State { name: name.into(), kind: CellKind::Edge, dim, pieces, left: None, right: None }
}

fn automaton(states: Vec<State>) -> Shape {
    let shape = Shape { states, start: 0, control: None, frame: Frame::Barycentric };
    shape.check().unwrap();
    shape.check_curves().unwrap();
    shape
}

fn analysed(shape: &Shape) -> CurveRegularity {
    curve_regularity(shape, &Spaces::new(shape).unwrap(), &Options::default()).unwrap()
}

/// `S` sees the first coordinate of Takagi–Landsberg curves only, whose jumps the path from the start kills.
fn killed_jump(factor: &Rational) -> Shape {
    let half = || ratio(1, 2);
    let zero = || ratio(0, 1);
    let left = map(&[vec![zero(), half(), zero()], vec![zero(), half(), factor.clone()]]);
    let right = map(&[vec![half(), half(), zero()], vec![half(), -half(), factor.clone()]]);
    let seen = |shift: i64| integers(&[&[(shift, 2), (1, 2), (0, 1)]]);
    automaton(vec![state("S", vec![(1, seen(0)), (1, seen(1))]), state("B", vec![(1, left), (1, right)])])
}

#[test]
fn a_jump_that_the_path_from_the_start_kills() {
    for factor in [ratio(1, 3), ratio(2, 3), ratio(3, 4), ratio(-1, 2)] {
        let found = analysed(&killed_jump(&factor));
        assert!(found.polynomial, "{factor}");
        assert_eq!(found.orders[0].dims, [1, 1]);
        assert_eq!(found.orders[1].dims, [0, 0]);
        assert!(found.orders.iter().all(|o| o.smooth() == Some(true)));
    }
}

#[test]
fn powers_in_a_transient_state_are_smooth() {
    // (t, t², t³) in its two halves.
    let power = |from: i64| {
        let (a, h) = (ratio(from, 2), ratio(1, 2));
        let of = |k: usize| (0..k).fold(ratio(1, 1), |p, _| p * &a);
        let half = |k: usize| (0..k).fold(ratio(1, 1), |p, _| p * &h);
        let z = || ratio(0, 1);
        vec![
            vec![a.clone(), h.clone(), z(), z()],
            vec![of(2), ratio(2, 1) * &a * &h, half(2), z()],
            vec![of(3), ratio(3, 1) * of(2) * &h, ratio(3, 1) * &a * half(2), half(3)],
        ]
    };
    let curve = || state("a", vec![(1, map(&power(0))), (1, map(&power(1)))]);
    for degree in [2_usize, 3] {
        let seen = |from: i64| map(&[power(from)[degree - 1].clone()]);
        let own = || map(&[vec![ratio(0, 1), ratio(1, 1 << degree)]]);
        // I -> I, a and s -> a, a.
        for first in [(0, own()), (1, seen(0))] {
            let found = analysed(&automaton(vec![state("I", vec![first, (1, seen(1))]), curve()]));
            assert!(found.polynomial && found.smoothness() == degree, "{degree}: {:?}", found.orders);
        }
        let found = analysed(&automaton(vec![state("I", vec![(0, own()), (1, seen(1))]), curve()]));
        let dims: Vec<usize> = found.orders.iter().map(|o| o.dims[0]).collect();
        assert_eq!(dims, [vec![1; degree], vec![0]].concat());
    }
}

fn takagi(factor: Rational) -> CurveRegularity {
    analysed(&secant::scheme::build("takagi", &[("alpha".to_owned(), factor)].into()).unwrap())
}

fn jump(found: &CurveRegularity) -> &Seen {
    match &found.orders.last().unwrap().outcome {
        Outcome::Joint(jump) => jump.seen.as_ref().unwrap(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn takagi_and_landsberg() {
    // Factor 1/4: a parabola; 1/2: products along a letter do not tend to 0; 1/3 and 1/8: the slopes at the joint differ.
    let quarter = takagi(ratio(1, 4));
    assert!(quarter.polynomial && quarter.smoothness() == 2);
    let half = takagi(ratio(1, 2));
    assert_eq!((half.smoothness(), &half.orders[1].outcome), (0, &Outcome::Cycle));
    assert_eq!(half.exponent.as_ref().unwrap().lo, 1);
    assert_eq!(half.attained, Some(false));
    for (factor, left, right) in [(ratio(1, 3), -1, 1), (ratio(1, 8), 2, -2)] {
        let found = takagi(factor.clone());
        let scale = if factor == ratio(1, 8) { 3 } else { 1 };
        let seen = jump(&found);
        assert_eq!(seen.path, Vec::<usize>::new());
        let height = |v: &[Rational]| v.last().unwrap().clone();
        assert_eq!((height(&seen.left), height(&seen.right)), (ratio(left, scale), ratio(right, scale)), "{factor}");
        assert_eq!(found.smoothness(), 0);
    }
    let rough = takagi(ratio(2, 3));
    assert_eq!(rough.orders[1].outcome, Outcome::Cycle);
    assert!((to_f64(&rough.exponent.unwrap().lo) - 0.584_962_500_721).abs() < 1e-9);
}

/// The second integral of the Takagi function: C², its second derivative has the exponent 1 as a supremum only.
#[test]
fn twice_integrated() {
    let left: &[&[(i64, i64)]] = &[
        &[(0, 1), (1, 2), (0, 1), (0, 1), (0, 1)],
        &[(0, 1), (0, 1), (1, 4), (0, 1), (0, 1)],
        &[(0, 1), (0, 1), (0, 1), (1, 8), (0, 1)],
        &[(0, 1), (0, 1), (0, 1), (1, 48), (1, 8)],
    ];
    let right: &[&[(i64, i64)]] = &[
        &[(1, 2), (1, 2), (0, 1), (0, 1), (0, 1)],
        &[(1, 4), (1, 2), (1, 4), (0, 1), (0, 1)],
        &[(1, 8), (3, 8), (3, 8), (1, 8), (0, 1)],
        &[(5, 96), (1, 8), (1, 16), (-1, 48), (1, 8)],
    ];
    let found = analysed(&automaton(vec![state("A", vec![(0, integers(left)), (0, integers(right))])]));
    assert_eq!(found.smoothness(), 2);
    assert_eq!(found.orders.iter().map(|o| o.dims[0]).collect::<Vec<_>>(), [4, 3, 2, 1]);
    assert_eq!(found.orders[3].outcome, Outcome::Cycle);
    assert_eq!(found.exponent.unwrap(), secant::arith::Interval::point(ratio(3, 1)));
    assert_eq!(found.attained, Some(false));
}

#[test]
fn splines_and_the_four_point_scheme() {
    let of = |name: &str, parameters: &[(&str, i64)]| {
        let values = parameters.iter().map(|(k, v)| ((*k).to_owned(), ratio(*v, 1))).collect();
        analysed(&secant::scheme::build(name, &values).unwrap())
    };
    // One span of a B-spline is a polynomial.
    for degree in 1..=5 {
        let spline = of("bspline", &[("degree", degree)]);
        assert!(spline.polynomial && spline.smoothness() == usize::try_from(degree).unwrap());
    }
    let four = of("four-point", &[]);
    assert_eq!((four.smoothness(), four.attained), (1, Some(false)));
}

/// A curve that comes back to where it begins has the chord 0.
#[test]
fn a_closed_curve_has_a_chord_among_the_differences() {
    let found = analysed(&secant::scheme::build("koch", &[].into()).unwrap());
    assert!(matches!(found.orders[1].outcome, Outcome::Cycle | Outcome::Chord(_)));
    assert_eq!(found.smoothness(), 0);
}

/// A function over the parameter: `y ↦ factor y + first x + second x² + shift` on the halves, from `(0, 0)` over
/// `(1/2, height)` to `(1, end)`.
#[derive(Debug, Clone)]
struct Function {
    factors: [Rational; 2],
    second: [Rational; 2],
    height: Rational,
    end: Rational,
}

impl Function {
    /// `[shift, x, x², y]` of a half.
    fn row(&self, piece: usize) -> Vec<Rational> {
        let (a, d) = (&self.factors[piece], &self.second[piece]);
        let (shift, target) = match piece {
            0 => (ratio(0, 1), self.height.clone()),
            _ => (self.height.clone(), self.end.clone()),
        };
        let first = target - &shift - a * &self.end - d;
        vec![shift, first, d.clone(), a.clone()]
    }

    /// The slopes of the two pieces at 1/2, where both factors are below 1/2.
    fn slopes(&self) -> [Rational; 2] {
        let rows = [self.row(0), self.row(1)];
        let slope = |piece: usize, x: i64| &rows[piece][1] + ratio(2 * x, 1) * &rows[piece][2];
        let end = |piece: usize, x: i64| slope(piece, x) / (ratio(1, 2) - &self.factors[piece]);
        let (start, finish) = (end(0, 0), end(1, 1));
        let at = |piece: usize, x: i64, y: &Rational| (&self.factors[piece] * y + slope(piece, x)) * ratio(2, 1);
        [at(0, 1, &finish), at(1, 0, &start)]
    }
}

fn parabola(piece: i64) -> [Vec<Rational>; 2] {
    let q = |p: i64, r: i64| ratio(p, r);
    [vec![q(piece, 2), q(1, 2), q(0, 1)], vec![q(piece, 4), q(piece, 2), q(1, 4)]]
}

/// Rows of a map of `(x, x², y)` or, with a function below it that nobody sees, of `(x, x², y, z)`.
fn rows(top: &Function, below: Option<(&Function, &[Rational; 2])>, piece: usize) -> Vec<Vec<Rational>> {
    let size = if below.is_some() { 5 } else { 4 };
    let mut out = parabola(i64::try_from(piece).unwrap()).to_vec();
    out.push(top.row(piece));
    if let Some((function, mixed)) = below {
        // z ↦ … + c (y − end x) keeps the values at the ends.
        let mut row = function.row(piece);
        let own = row.pop().unwrap();
        row[1] -= &mixed[piece] * &top.end;
        row.extend([mixed[piece].clone(), own]);
        out.push(row);
    }
    out.iter_mut().for_each(|r| r.resize(size, ratio(0, 1)));
    out
}

fn small(numerator: i64) -> impl Strategy<Value = Rational> {
    (-numerator..=numerator, 1i64..=4).prop_map(|(p, q)| ratio(p, q))
}

fn function() -> impl Strategy<Value = Function> {
    let factor = || (-9i64..=9).prop_map(|p| ratio(p, 10));
    (factor(), factor(), small(3), small(3), small(3), small(3), prop::bool::ANY).prop_map(
        |(a, b, c, d, height, end, joined)| {
            let mut f = Function { factors: [a, b], second: [c, d], height, end };
            if joined && f.factors.iter().all(|x| abs(x) < ratio(1, 2)) {
                // The slopes at 1/2 are affine in the height.
                let gap = |f: &Function| {
                    let [l, r] = f.slopes();
                    l - r
                };
                let at = |h: i64| gap(&Function { height: ratio(h, 1), ..f.clone() });
                let (g, step) = (at(0), at(1) - at(0));
                if step != 0 {
                    f.height = -g / step;
                }
            }
            f
        },
    )
}

fn shear() -> impl Strategy<Value = Matrix> {
    prop::collection::vec((0usize..5, 0usize..5, -2i64..=2), 6).prop_map(|moves| {
        let mut s = Matrix::identity(5);
        for (i, j, c) in moves {
            // Columns keep their sums: subtract a row from two.
            let k = (0..5).find(|k| *k != i && *k != j).unwrap();
            if i != j {
                for col in 0..5 {
                    let change = &s[(j, col)] * ratio(c, 1);
                    s[(i, col)] += &change;
                    s[(k, col)] -= change;
                }
            }
        }
        s
    })
}

/// The same outcomes, where both are decided. `same_spaces`: the last states see the same directions.
fn agree(a: &CurveRegularity, b: &CurveRegularity, same_spaces: bool) {
    for (x, y) in a.orders.iter().zip(&b.orders) {
        assert!(x.smooth().is_none() || y.smooth().is_none() || x.smooth() == y.smooth(), "{x:?}\n{y:?}");
        assert!(x.dims.last() == y.dims.last() || !same_spaces, "{x:?}\n{y:?}");
        let (p, q) = (x.enclosure.as_ref().unwrap(), y.enclosure.as_ref().unwrap());
        assert!(p.lo <= q.hi && q.lo <= p.hi, "{p:?} {q:?}");
    }
    assert_eq!(a.polynomial, b.polynomial);
}

/// Difference quotients of a curve at a joint tend to the two values.
fn quotients(shape: &Shape, right: usize, seen: &Seen) {
    let view = shape.view();
    let chord = |word: &[usize]| -> Vec<Rational> {
        let (product, state) = shape.product(shape.start, word);
        let end = |end| shape.end_point(state, end).unwrap();
        let (start, finish) = (end(End::Start), end(End::Finish));
        let scale = Rational::from(Integer::from(1) << (word.len() as u64));
        let d: Vec<Rational> = finish.iter().zip(&start).map(|(a, b)| (a - b) * &scale).collect();
        view.apply(&product.apply(&d))
    };
    let distance = |depth: usize| {
        let word = |side: usize, letter: usize| [seen.path.clone(), vec![right - side], vec![letter; depth]].concat();
        let far =
            |a: Vec<Rational>, b: &[Rational]| a.iter().zip(b).map(|(x, y)| to_f64(&(x - y)).abs()).fold(0.0, f64::max);
        far(chord(&word(1, 1)), &seen.left).max(far(chord(&word(0, 0)), &seen.right))
    };
    let (near, far) = (distance(60), distance(5));
    assert!(near < 1e-6 || near < far / 2.0, "{far} {near}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Directions that no path from the start sees change nothing, in whatever coordinates they are written.
    #[test]
    fn killed_directions(
        top in function(),
        below in function(),
        mixed in [small(2), small(2)],
        shear in shear(),
        only_height in prop::bool::ANY,
        levels in 1usize..=2,
    ) {
        let plain = {
            let pieces = (0..2).map(|k| (0, map(&rows(&top, None, k)))).collect();
            let mut shape = automaton(vec![state("E", pieces)]);
            if only_height {
                shape.control = Some(Matrix::from_fn(1, 4, |_, j| ratio(i64::from(j == 3), 1)));
            }
            shape
        };
        let killed = {
            let inverse = shear.inverse().unwrap();
            let whole: Vec<Matrix> = (0..2).map(|k| map(&rows(&top, Some((&below, &mixed)), k))).collect();
            let inside = whole.iter().map(|m| (levels, &(&shear * m) * &inverse)).collect();
            let keep = |rows: Vec<Vec<Rational>>| if only_height { vec![rows[2].clone()] } else { rows[..3].to_vec() };
            let seen = (0..2).map(|k| (levels, &map(&keep(rows(&top, Some((&below, &mixed)), k))) * &inverse)).collect();
            let mut states = vec![state("S", seen), state("B", inside)];
            if levels == 2 {
                // Two levels of the curve of B in one state more.
                let upper = (0..2).map(|k| {
                    let one = map(&keep(rows(&top, Some((&below, &mixed)), k)));
                    (1, one)
                }).collect();
                let middle = (0..2).map(|k| (2, &whole[k] * &inverse)).collect();
                states = vec![state("S", upper), state("M", middle), states.pop().unwrap()];
            }
            automaton(states)
        };
        if Spaces::new(&plain).unwrap().of(0).visible.rows() == 0 {
            return Ok(());
        }
        let (a, b) = (analysed(&plain), analysed(&killed));
        // Where both factors are 0 no letter sees the height: the start alone does, and it is the last state of `plain` only.
        agree(&a, &b, top.factors.iter().any(|f| *f != 0));
        // Barnsley and Harrington: C¹ if and only if the factors are below 1/2 and the slopes agree, but for polynomials.
        let steep = top.factors.iter().any(|f| abs(f) >= ratio(1, 2));
        for found in [&a, &b] {
            if !found.polynomial {
                let expected = !steep && { let [l, r] = top.slopes(); l == r };
                prop_assert_eq!(found.orders[1].smooth(), Some(expected));
            }
        }
        for (shape, found) in [(&plain, &a), (&killed, &b)] {
            // Of the first derivative, which chords of cells approach.
            if let Outcome::Joint(jump) = &found.orders[1].outcome {
                quotients(shape, jump.right, jump.seen.as_ref().unwrap());
            }
        }
    }
}

fn numbers(list: &[(i64, i64)]) -> Vec<Rational> {
    list.iter().map(|&(p, q)| ratio(p, q)).collect()
}

fn factors(list: &[Rational]) -> Vec<Matrix> {
    list.iter().map(|a| Matrix::from_rows(1, vec![vec![a.clone()]])).collect()
}

#[test]
fn interpolation_that_is_c2_and_not_c3() {
    let points = [[(0, 1), (0, 1)], [(1, 3), (4, 5)], [(1, 1), (1, 1)]].map(|p| numbers(&p));
    let cubic = numbers(&[(0, 1), (3060, 2716), (-1089, 2716), (66, 2716)]);
    let polynomials = vec![vec![cubic], vec![numbers(&[(4, 5)])]];
    let data = Interpolation::new(&points, factors(&numbers(&[(1, 20), (1, 5)])), polynomials).unwrap();
    let found = analysed(&data.shape().unwrap());
    assert_eq!((found.smoothness(), found.is_smooth(3), found.polynomial), (2, Some(false), false));
    assert_eq!(found.orders.iter().map(|o| o.dims[0]).collect::<Vec<_>>(), [4, 3, 2, 1]);
    assert_eq!(found.orders[3].outcome, Outcome::Cycle);
    assert_eq!(found.orders[3].radius.as_ref().unwrap().lower.as_ref().unwrap().rational(), Some(ratio(27, 20)));
    // The derivatives by Theorem 10, at the ends and at the inner point.
    for (k, ends, middle) in [(1, [(2700, 679), (0, 1)], (810, 679)), (2, [(-8910, 679), (0, 1)], (-8019, 1358))] {
        let own = data.matching(k).unwrap();
        let middle = ratio(middle.0, middle.1);
        assert_eq!(own.ends.unwrap().to_vec(), numbers(&ends), "order {k}");
        assert_eq!(own.joints, [[middle.clone(), middle]], "order {k}");
    }
    assert_eq!(data.matching(3).unwrap().ratios[0], ratio(27, 20));
    holds_exponent(&found, (20f64.ln() / 3f64.ln()).min(5f64.ln() / 1.5f64.ln()));
}

/// The enclosure holds the number, and is as narrow as it is said to be.
fn holds_exponent(found: &CurveRegularity, expected: f64) {
    let bounds = found.exponent.as_ref().unwrap();
    let (lo, hi) = (to_f64(&bounds.lo), to_f64(&bounds.hi));
    assert!(lo <= expected + 1e-12 && expected <= hi + 1e-12 && hi - lo < 6e-3, "{expected} in {lo}..{hi}");
}

/// The function with the derivatives `slopes` at the points: cubic pieces that Hermite's conditions give.
fn hermite(xs: &[Rational], ys: &[Rational], slopes: &[Rational], alpha: &[Rational]) -> Vec<Vec<Vec<Rational>>> {
    let last = alpha.len();
    let (from, width) = (&xs[0], &xs[last] - &xs[0]);
    let piece = |j: usize| {
        let share = (&xs[j + 1] - &xs[j]) / &width;
        let value = |end: usize, y: usize| &ys[y] - &alpha[j] * &ys[end];
        let slope = |end: usize, y: usize| (&slopes[y] * &share - &alpha[j] * &slopes[end]) * &width;
        let ([p, q], [u, v]) = ([value(0, j), value(last, j + 1)], [slope(0, j), slope(last, j + 1)]);
        let three = ratio(3, 1) * (&q - &p);
        let cubic = [p.clone(), u.clone(), &three - ratio(2, 1) * &u - &v, ratio(2, 1) * (&p - &q) + &u + &v];
        // In t = (x − from)/width; from is 0 in the tests, so that x = width t.
        assert_eq!(*from, 0);
        let scaled = cubic.iter().scan(ratio(1, 1), |w, c| {
            let own = c / &*w;
            *w *= &width;
            Some(own)
        });
        vec![scaled.collect()]
    };
    (0..last).map(piece).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Theorem E and the numbers of Theorem 10 decide alike.
    #[test]
    fn interpolation_is_decided_as_by_barnsley_and_harrington(
        gaps in prop::collection::vec(1i64..5, 2..4),
        ys in prop::collection::vec(-3i64..4, 4),
        slopes in prop::collection::vec(-3i64..4, 4),
        sizes in prop::collection::vec(-7i64..8, 3),
        moved in prop::bool::ANY,
    ) {
        let n = gaps.len();
        let xs: Vec<Rational> = (0..=n).map(|k| ratio(gaps[..k].iter().sum(), 1)).collect();
        let (mut ys, slopes): (Vec<_>, Vec<_>) = (0..=n).map(|k| (ratio(ys[k], 1), ratio(slopes[k], 2))).unzip();
        let alpha: Vec<Rational> = sizes[..n].iter().map(|s| ratio(*s, 8)).collect();
        let cubics = hermite(&xs, &ys, &slopes, &alpha);
        let points = |ys: &[Rational]| -> Vec<Vec<Rational>> {
            xs.iter().zip(ys).map(|(x, y)| vec![x.clone(), y.clone()]).collect()
        };
        let data = if moved {
            ys[0] += ratio(1, 3);
            Interpolation::affine(&points(&ys), factors(&alpha)).unwrap()
        } else {
            Interpolation::new(&points(&ys), factors(&alpha), cubics).unwrap()
        };
        let found = analysed(&data.shape().unwrap());
        let mut smooth = true;
        for (k, order) in found.orders.iter().enumerate().skip(1) {
            let own = data.matching(k).unwrap();
            smooth &= match own.ends {
                Some(_) => own.joints.iter().all(|[a, b]| a == b),
                None => found.polynomial,
            };
            prop_assert_eq!(order.smooth(), Some(smooth), "order {} of {:?}", k, data);
        }
        // Hermite's conditions make it C¹ where the factors allow it.
        let shares = data.shares();
        if !moved && alpha.iter().zip(&shares).all(|(a, s)| abs(a) < *s) {
            prop_assert!(found.smoothness() >= 1);
        }
        // The exponent of what is no polynomial is that of its largest factor, or of the order whose equations fail.
        if !found.polynomial {
            let exponent = |(a, s): (&Rational, &Rational)| to_f64(&abs(a)).ln() / to_f64(s).ln();
            let least = alpha.iter().zip(&shares).filter(|(a, _)| **a != 0).map(exponent).fold(f64::INFINITY, f64::min);
            holds_exponent(&found, least.min(found.smoothness() as f64 + 1.0));
        }
    }
}

#[test]
fn equal_shares_are_the_uniform_parameter() {
    for (name, parameters) in
        [("four-point", vec![]), ("bspline", vec![("degree".to_owned(), ratio(3, 1))]), ("takagi", vec![])]
    {
        let shape = secant::scheme::build(name, &parameters.into_iter().collect()).unwrap();
        let mut shared = shape.clone();
        for state in &mut shared.states {
            let share = ratio(1, state.pieces.len() as i64);
            state.pieces.iter_mut().for_each(|p| p.share = Some(share.clone()));
        }
        let (uniform, own) = (analysed(&shape), analysed(&shared));
        assert_eq!((uniform.smoothness(), uniform.polynomial), (own.smoothness(), own.polynomial), "{name}");
        for (a, b) in uniform.orders.iter().zip(&own.orders) {
            assert_eq!((a.smooth(), &a.dims), (b.smooth(), &b.dims), "{name}");
        }
        if let (Some(a), Some(b)) = (&uniform.exponent, &own.exponent) {
            assert!(a.lo <= b.hi && b.lo <= a.hi, "{name}: {a:?} {b:?}");
        }
    }
}

#[test]
fn certificates_of_exponents_in_shares_are_checked() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/fif/unequal.toml");
    let (_, certificate, expanded) = secant::ask::certified_regularity(case, &[], 2, None).unwrap();
    // The checker builds the case itself.
    assert!(expanded.is_none());
    let expanded = std::fs::read_to_string(case).unwrap();
    let accepted = secant_check::check(&expanded, &certificate).unwrap();
    let between = |c: &secant_check::Decided| matches!(c.claim, secant_check::Claim::ExponentBetween { .. });
    assert!(accepted.claims.iter().any(between));
    let value: serde_json::Value = serde_json::from_str(&certificate).unwrap();
    let bounds = "/proof/exponent";
    for (place, new) in [
        ("/below/at", serde_json::json!("1300/2048")),
        ("/below/factors/0/0", serde_json::json!("1")),
        ("/above/factors/0/0", serde_json::json!("3")),
        ("/above/at", serde_json::json!("1/2")),
        ("/below/radius", value.pointer("/proof/exponent/above/radius").unwrap().clone()),
    ] {
        let mut forged = value.clone();
        *forged.pointer_mut(&format!("{bounds}{place}")).unwrap() = new;
        assert!(secant_check::check(&expanded, &forged.to_string()).is_err(), "{place}");
    }
    // Other shares are another case.
    let other = expanded.replace("[\"1/3\", 1]", "[\"1/2\", 1]");
    assert_ne!(other, expanded);
    assert!(secant_check::check(&other, &certificate).is_err());
}

/// The sides of the points of a curve: by point, those of all branches.
fn sides(shape: &Shape, addresses: &[&str]) -> Vec<Vec<LocalSide>> {
    let addresses: Vec<_> = addresses.iter().map(|a| Address::parse(a).unwrap()).collect();
    let found = secant::theorem::certify(shape, &addresses).unwrap();
    let context = LocalContext::new(shape, &found).unwrap();
    found.points.iter().map(|p| p.branches.iter().flat_map(|b| context.sides(b)).collect()).collect()
}

#[test]
fn characteristic_maps() {
    let curve = |p, q| secant::scheme::build("takagi", &[("alpha".to_owned(), ratio(p, q))].into()).unwrap();
    // Of 2x − 2x² the leading coefficient is the abscissa.
    for side in sides(&curve(1, 4), &["(01)"]).iter().flatten() {
        assert!(matches!(side.characteristic, Some(Characteristic::Injective { cells: 1.. })), "{side:?}");
    }
    // Above 1/2 it is the height, which is monotone nowhere; the chords of the two cells have opposite signs.
    let curve = curve(3, 5);
    let found = secant::theorem::certify(&curve, &[]).unwrap();
    let secant::theorem::Outcome::Line { functional, .. } = &found.points[0].branches[0].outcome else {
        panic!("a line at 0")
    };
    let side = &sides(&curve, &[])[0][0];
    let Some(Characteristic::Not { words }) = &side.characteristic else { panic!("{side:?}") };
    let change = |word: &Vec<usize>| {
        let at = |end: &str| curve.point(0, &Address::parse(&format!("{}{end}", text(word))).unwrap()).unwrap();
        let chord: Vec<_> = at("(1)").iter().zip(at("(0)")).map(|(a, b)| a - b).collect();
        let row = found.points[0].branches[0].chart.apply(&chord);
        let values = row.iter().zip(functional).map(|(x, f)| f.is_rational().unwrap() * x);
        values.fold(ratio(0, 1), |sum, x| sum + x)
    };
    let changes: Vec<_> = words.iter().map(change).collect();
    assert!(changes.len() == 2 && changes[0] > 0 && changes[1] < 0, "{words:?}: {changes:?}");
}

fn text(word: &[usize]) -> String {
    word.iter().map(ToString::to_string).collect()
}

#[test]
fn difference_polygons_tend_to_derivatives() {
    let orders = |name: &str, degree: i64| {
        let shape = secant::scheme::build(name, &[("degree".to_owned(), ratio(degree, 1))].into()).unwrap();
        let spaces = Spaces::new(&shape).unwrap();
        curve_regularity(&shape, &spaces, &Options::default()).unwrap().orders
    };
    // Of a Bézier curve of degree n the derivative of order k is n … (n−k+1) times the differences; every rate above 1/2.
    let mut factor = ratio(1, 1);
    for (k, order) in orders("bezier", 4).iter().enumerate().skip(1) {
        factor /= Rational::from(5 - k);
        assert_eq!(order.polygons, Some(vec![factor.clone()]), "order {k}");
        assert_eq!(order.rate(), Some(if k == 4 { ratio(0, 1) } else { ratio(1, 2) }), "order {k}");
    }
    // Of uniform B-splines, differences of unit knots.
    for (k, order) in orders("bspline", 4).iter().enumerate().skip(1) {
        let sign = order.polygons.as_ref().unwrap()[0].clone();
        assert_eq!(abs(&sign), 1, "order {k}");
    }
    // In numbers, for t³: the first differences of the cell at t, divided by its length, are t² up to C 2^−m.
    let shape = secant::scheme::build("bezier", &[("degree".to_owned(), ratio(3, 1))].into()).unwrap();
    let word: Vec<usize> = (0..14).map(|k| (k * k / 3) % 2).collect();
    let operator = word.iter().fold(Matrix::identity(4), |m, &l| &m * &shape.states[0].pieces[l].op);
    let (length, t) = shape.parameter_map(0, &word).unwrap();
    for j in 0..3 {
        let difference = (&operator[(3, j + 1)] - &operator[(3, j)]) / &length;
        let error = difference - &t * &t;
        assert!(error < &length * ratio(3, 1) && error > &length * ratio(-3, 1), "{j}");
    }
}

fn values(point: &[LocalSide]) -> Vec<(Side, Option<usize>, Vec<Rational>)> {
    let value = |s: &LocalSide| match &s.limit {
        LocalLimit::Value(v) => v.clone(),
        other => panic!("{other:?}"),
    };
    point.iter().map(|s| (s.side, s.integer, value(s))).collect()
}

#[test]
fn local_derivatives_of_takagi_curves() {
    let curve = |p, q| secant::scheme::build("takagi", &[("alpha".to_owned(), ratio(p, q))].into()).unwrap();
    // 2x − 2x² at 0, at 1, at the joint 1/2, and at 1/3 from both sides.
    let parabola = sides(&curve(1, 4), &["(01)"]);
    let expected = [
        vec![(Side::Right, [(1, 1), (2, 1)])],
        vec![(Side::Left, [(-1, 1), (2, 1)])],
        vec![(Side::Left, [(-1, 1), (0, 1)]), (Side::Right, [(1, 1), (0, 1)])],
        vec![(Side::Left, [(-1, 1), (-2, 3)]), (Side::Right, [(1, 1), (2, 3)])],
    ];
    for (point, wanted) in parabola.iter().zip(expected) {
        let wanted: Vec<_> = wanted.into_iter().map(|(side, v)| (side, Some(1), numbers(&v))).collect();
        assert_eq!(values(point), wanted);
    }
    // Takagi's own curve: a block of length 2.
    let takagi = sides(&curve(1, 2), &[]);
    assert_eq!((takagi[0][0].integer, &takagi[0][0].limit), (Some(1), &LocalLimit::Diverges(1)));
    // Factor 2/3: the order ln(2/3)/ln(1/2), and a band that dense values of (y + 3x)/x^h fill.
    let rough = &sides(&curve(2, 3), &[])[0][0];
    let h = 1.5f64.ln() / 2f64.ln();
    assert!(to_f64(&rough.order.lo) <= h + 1e-14 && h <= to_f64(&rough.order.hi) + 1e-14 && rough.integer.is_none());
    let LocalLimit::Band { direction, least, most } = &rough.limit else { panic!("{rough:?}") };
    assert_eq!(*direction, numbers(&[(0, 1), (1, 1)]));
    fn height(x: f64, depth: u32) -> f64 {
        let x = x.min(1.0 - x);
        if depth == 0 { 0.0 } else { x + 2.0 / 3.0 * height(2.0 * x, depth - 1) }
    }
    let sampled = (2048..=4096).map(|k| f64::from(k) / 4096.0).map(|x| (height(x, 40) + 3.0 * x) / x.powf(h));
    let (lo, hi) = sampled.fold((f64::INFINITY, 0f64), |(lo, hi), b| (lo.min(b), hi.max(b)));
    assert!(to_f64(&least.lo) <= lo + 1e-9 && lo <= to_f64(&least.hi) + 1e-9, "{lo} {least:?}");
    assert!(to_f64(&most.lo) <= hi + 1e-9 && hi <= to_f64(&most.hi) + 1e-9, "{hi} {most:?}");
    assert!(hi - lo > 0.1 && to_f64(&least.width()) < 0.7 && to_f64(&most.width()) < 0.7, "{least:?} {most:?}");
}

#[test]
fn local_derivatives_in_a_parameter_with_shares() {
    let points = [[(0, 1), (0, 1)], [(1, 3), (4, 5)], [(1, 1), (1, 1)]].map(|p| numbers(&p));
    let cubic = numbers(&[(0, 1), (3060, 2716), (-1089, 2716), (66, 2716)]);
    let polynomials = vec![vec![cubic], vec![numbers(&[(4, 5)])]];
    let data = Interpolation::new(&points, factors(&numbers(&[(1, 20), (1, 5)])), polynomials).unwrap();
    let found = sides(&data.shape().unwrap(), &[]);
    let seen: Vec<_> =
        found.iter().take(3).flat_map(|p| values(p)).map(|(side, h, v)| (side, h, v[1].clone())).collect();
    let expected =
        [(Side::Right, (2700, 679)), (Side::Left, (0, 1)), (Side::Left, (-810, 679)), (Side::Right, (810, 679))];
    assert_eq!(seen, expected.map(|(side, (p, q))| (side, Some(1), ratio(p, q))));
}

/// A vertex state is no part of the curve, and orders are integers beyond 8 as well.
#[test]
fn local_derivatives_beside_vertices_and_of_high_order() {
    let shape = |text: &str| secant::case::Case::parse("case.toml", text).unwrap().shape;
    let spline = "name = \"spline\"\n[scheme]\nname = \"bspline\"\ndegree = 2\n";
    let (plain, with) = (sides(&shape(spline), &[]), sides(&shape(&format!("{spline}vertices = true\n")), &[]));
    assert_eq!((plain.len(), with.len()), (3, 3));
    for (a, b) in plain.iter().zip(&with) {
        assert_eq!(values(a), values(b));
        assert!(!a.is_empty());
    }
    let control = format!("control = [{}[1, 2]]", "[0, 0], ".repeat(9));
    let power = shape(&format!("name = \"power\"\n{control}\n[scheme]\nname = \"bezier\"\ndegree = 9\n"));
    assert_eq!(values(&sides(&power, &[])[0]), [(Side::Right, Some(9), numbers(&[(1, 1), (2, 1)]))]);
}

/// A curve that is C¹ in a parameter of other shares is not claimed to be C¹ in the uniform one.
#[test]
fn orders_in_other_shares_are_not_adopted() {
    for name in ["chaikin-four-point", "m1-5-smooth"] {
        let file = format!("{}/cases/junction/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let shape = secant::case::Case::read(file.as_ref()).unwrap().shape;
        let found = secant::theorem::certify(&shape, &[]).unwrap();
        let derivative = found.everywhere.as_ref().and_then(|e| e.derivative.as_ref()).unwrap();
        assert!(derivative.shares.is_some(), "{name}");
        if let Some(secant::theorem::Parameter::Orders(orders)) = &found.parameter {
            assert!(orders.orders.iter().all(|o| o.shares.is_none()), "{name}");
            assert_eq!(orders.orders[1].threshold, ratio(1, 2), "{name}");
            assert_ne!(orders.orders[1].smooth(), Some(true), "{name}");
        }
        // With the shares written down it is the case's own parameter (of the smaller one, for time).
        if name == "chaikin-four-point" {
            continue;
        }
        let mut shared = shape.clone();
        for (e, own) in shape.reachable().into_iter().zip(derivative.shares.as_ref().unwrap()) {
            shared.states[e].pieces.iter_mut().zip(own).for_each(|(p, s)| p.share = Some(s.clone()));
        }
        assert!(analysed(&shared).smoothness() >= 1, "{name}");
    }
}

/// Here the curve is a cubic polynomial, although the mask is not C².
#[test]
fn a_mask_in_a_case_with_control_points_says_that_it_is_not_about_them() {
    let case = |points: &str| {
        format!("name = \"four\"\n{points}\n[scheme]\nmask = [\"-1/16\", 0, \"9/16\", 1, \"9/16\", 0, \"-1/16\"]\n")
    };
    let found = |points: &str| secant::ask::regularity_of_case("four", &case(points)).unwrap();
    assert!(found("").data["remark"].is_null());
    let about = found("control = [[-8], [-1], [0], [1], [8], [27]]");
    assert!(about.data["remark"].as_str().is_some_and(|r| r.contains("not looked at")));
    assert!(about.text.starts_with("note"));
    assert_eq!(about.data["smoothness"], 1);
}
