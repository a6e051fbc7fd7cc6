//! Identities generated from cells, and operators solved from them.

use secant::arith::{Rational, parse_rational, ratio};
use secant::linalg::{Matrix, char_poly};
use secant::scheme::{self, tensor};
use secant::shape::{
    Boundary, CellKind, Complex, ComplexError, Frame, IdentityKind, OpName, Piece, Problem, Shape, Solution, Source,
    State, UnknownError,
};

fn characteristic(m: &Matrix) -> Vec<Rational> {
    char_poly(m).coeffs().to_vec()
}

fn matrix(rows: &[&str]) -> Matrix {
    let rows: Vec<Vec<Rational>> =
        rows.iter().map(|r| r.split_whitespace().map(|x| parse_rational(x).unwrap()).collect()).collect();
    Matrix::from_rows(rows[0].len(), rows)
}

fn count(complex: &Complex, state: usize, kind: IdentityKind) -> usize {
    complex.identities().unwrap().iter().filter(|i| i.state == state && i.kind == kind).count()
}

fn bicubic() -> Complex {
    let curve = scheme::bspline(3, 2).unwrap().curve_with_vertices().unwrap();
    tensor(&curve, &curve).unwrap()
}

#[test]
fn the_bicubic_patch_has_its_twelve_identities() {
    let patch = bicubic();
    let dims: Vec<usize> = patch.shape.states.iter().map(|s| s.dim).collect();
    assert_eq!(dims, [16, 12, 12, 9]);
    assert_eq!(count(&patch, 0, IdentityKind::Incidence), 8);
    assert_eq!(count(&patch, 0, IdentityKind::Adjacency), 4);
    assert_eq!(count(&patch, 0, IdentityKind::Corner), 4);
    // Two edge states with three identities each.
    assert_eq!(patch.check().unwrap(), 16 + 6);
}

#[test]
fn a_wrong_entry_is_found_with_both_products() {
    let mut patch = bicubic();
    let op = patch.operator_mut(OpName::Piece { state: 0, letter: 2 }).unwrap();
    op[(5, 0)] += ratio(1, 64);
    op[(6, 0)] -= ratio(1, 64);
    let failures = patch.failures().unwrap();
    assert!(!failures.is_empty());
    let first = &failures[0];
    assert_eq!(&first.left[(first.row, first.column)] - &first.right[(first.row, first.column)], first.residual);
    assert!(first.text.contains("T_2[A⊗A]"), "{}", first.text);
    assert!(matches!(patch.check(), Err(ComplexError::Fails(_))));
}

#[test]
fn tensor_products_of_different_curves_are_complexes() {
    let quadratic = scheme::bspline(2, 2).unwrap().curve_with_vertices().unwrap();
    let ternary = scheme::bspline(3, 3).unwrap().curve_with_vertices().unwrap();
    let bezier = scheme::bezier(3, &ratio(1, 3)).unwrap();
    let patch = tensor(&quadratic, &ternary).unwrap();
    // 2 x 3 pieces: 2·(2 + 3) on the boundary and 3 + 4 inside.
    assert_eq!(count(&patch, 0, IdentityKind::Incidence), 10);
    assert_eq!(count(&patch, 0, IdentityKind::Adjacency), 7);
    patch.check().unwrap();
    tensor(&bezier, &quadratic).unwrap().check().unwrap();
    // A curve whose second piece runs backwards.
    let mut dragon = scheme::build("dragon", &[].into()).unwrap();
    let ends = [secant::shape::End::Start, secant::shape::End::Finish].map(|e| dragon.end_point(0, e).unwrap());
    let [left, right] = ends.map(|p| Some(Boundary { vertex: 1, op: Matrix::from_columns(3, &[p]) }));
    (dragon.states[0].left, dragon.states[0].right) = (left, right);
    dragon.states.push(State {
        name: "v".into(),
        kind: CellKind::Vertex,
        dim: 1,
        pieces: vec![Piece { target: 1, op: Matrix::identity(1), reversed: false, share: None }],
        left: None,
        right: None,
    });
    let patch = tensor(&dragon, &bezier).unwrap();
    assert_eq!(count(&patch, 0, IdentityKind::Incidence) + count(&patch, 0, IdentityKind::Adjacency), 12);
    patch.check().unwrap();
    assert!(tensor(&scheme::build("dragon", &[].into()).unwrap(), &bezier).is_err());
}

/// A zero operator, to be solved for.
fn blank(rows: usize, cols: usize) -> Matrix {
    Matrix::zero(rows, cols)
}

/// The matrix that puts `cols` coordinates at `shift`.
fn inclusion(rows: usize, cols: usize, shift: usize) -> Matrix {
    Matrix::from_fn(rows, cols, |i, j| ratio(i64::from(i == j + shift), 1))
}

fn edge(name: &str, dim: usize, pieces: Vec<(usize, Matrix)>, left: (usize, Matrix), right: (usize, Matrix)) -> State {
    let pieces = pieces.into_iter().map(|(target, op)| Piece { target, op, reversed: false, share: None }).collect();
    let boundary = |(vertex, op)| Some(Boundary { vertex, op });
    State { name: name.into(), kind: CellKind::Edge, dim, pieces, left: boundary(left), right: boundary(right) }
}

fn vertex(name: &str, index: usize, op: Matrix) -> State {
    let dim = op.rows();
    let pieces = vec![Piece { target: index, op, reversed: false, share: None }];
    State { name: name.into(), kind: CellKind::Vertex, dim, pieces, left: None, right: None }
}

const I: usize = 0;
const QUADRATIC: usize = 1;
const CUBIC: usize = 2;
const T0: OpName = OpName::Piece { state: I, letter: 0 };
const T1: OpName = OpName::Piece { state: I, letter: 1 };

/// States: intermediate edge on `n` points, quadratic edge, cubic edge, quadratic vertex, cubic vertex; the intermediate
/// edge goes to the given states.
fn junction(n: usize, targets: [usize; 2]) -> Complex {
    let (q, c) = (3, 4);
    let q0 = matrix(&["3/4 1/4 0", "1/4 3/4 3/4", "0 0 1/4"]);
    let q1 = matrix(&["1/4 0 0", "3/4 3/4 1/4", "0 1/4 3/4"]);
    let c0 = matrix(&["1/2 1/8 0 0", "1/2 3/4 1/2 1/8", "0 1/8 1/2 3/4", "0 0 0 1/8"]);
    let c1 = matrix(&["1/8 0 0 0", "3/4 1/2 1/8 0", "1/8 1/2 3/4 1/2", "0 0 1/8 1/2"]);
    let dims = [n, 3, 4];
    let pieces = targets.map(|t| (t, blank(n, dims[t]))).to_vec();
    let states = vec![
        edge("I", n, pieces, (q, inclusion(n, 2, 0)), (c, inclusion(n, 3, n - 3))),
        edge("Q", 3, vec![(1, q0), (1, q1)], (q, inclusion(3, 2, 0)), (q, inclusion(3, 2, 1))),
        edge("C", 4, vec![(2, c0), (2, c1)], (c, inclusion(4, 3, 0)), (c, inclusion(4, 3, 1))),
        vertex("q", q, matrix(&["3/4 1/4", "1/4 3/4"])),
        vertex("c", c, matrix(&["1/2 1/8 0", "1/2 3/4 1/2", "0 1/8 1/2"])),
    ];
    Complex::of_curves(Shape { states, start: I, control: None, frame: Frame::Barycentric })
}

fn solve(complex: Complex) -> Solution {
    let mut problem = Problem::new(complex);
    problem.unknown_operator(T0).unwrap();
    problem.unknown_operator(T1).unwrap();
    problem.solve().unwrap()
}

#[test]
fn the_junction_on_four_points_is_forced() {
    let Solution::One(solved) = solve(junction(4, [I, CUBIC])) else { panic!("one solution") };
    let t0 = matrix(&["3/4 1/4 0 0", "1/4 3/4 1/2 1/8", "0 0 1/2 3/4", "0 0 0 1/8"]);
    let t1 = matrix(&["1/4 0 0 0", "3/4 1/2 1/8 0", "0 1/2 3/4 1/2", "0 0 1/8 1/2"]);
    assert_eq!((solved.operator(T0), solved.operator(T1)), (Some(&t0), Some(&t1)));
    solved.check().unwrap();

    let Solution::One(solved) = solve(junction(4, [QUADRATIC, I])) else { panic!("one solution") };
    let t0 = matrix(&["3/4 1/4 0", "1/4 3/4 1/2", "0 0 1/2", "0 0 0"]);
    let t1 = matrix(&["1/4 0 0 0", "3/4 1/2 1/8 0", "0 1/2 3/4 1/2", "0 0 1/8 1/2"]);
    assert_eq!((solved.operator(T0), solved.operator(T1)), (Some(&t0), Some(&t1)));
}

#[test]
fn the_junction_on_five_points_has_four_parameters() {
    let Solution::Family(family) = solve(junction(5, [I, CUBIC])) else { panic!("a family") };
    assert_eq!(family.parameters.len(), 4);
    // The third column of T_0 is free; the named member is chosen by its own entries.
    let wanted = [ratio(0, 1), ratio(15, 16), ratio(1, 8), ratio(-1, 16), ratio(0, 1)];
    let rows: Vec<usize> = family
        .parameters
        .iter()
        .map(|p| (0..5).find(|r| p.ends_with(&format!("({r},2)")) || p.ends_with(&format!("({r},0)"))).unwrap())
        .collect();
    let values: Vec<Rational> = rows.iter().map(|r| wanted[*r].clone()).collect();
    let member = family.at(&values);
    let t0 = matrix(&["3/4 1/4 0 0 0", "1/4 3/4 15/16 0 0", "0 0 1/8 1/2 1/8", "0 0 -1/16 1/2 3/4", "0 0 0 0 1/8"]);
    let t1 = matrix(&["0 0 0 0", "15/16 0 0 0", "1/8 1/2 1/8 0", "-1/16 1/2 3/4 1/2", "0 0 1/8 1/2"]);
    assert_eq!((member.operator(T0), member.operator(T1)), (Some(&t0), Some(&t1)));
    member.check().unwrap();
    // Forced: the vertex's 1 and 1/2.
    let forced = family.forced(T0).unwrap();
    assert_eq!(forced.polynomial().coeffs(), characteristic(&matrix(&["1 0", "0 1/2"])));
    assert_eq!(forced.free.rows(), 3);
}

#[test]
fn forced_spectrum_divides_every_member() {
    // With the last entry of the free column fixed to 0, 1/8 is forced as well.
    let mut problem = Problem::new(junction(5, [I, CUBIC]));
    for row in 0..5 {
        for column in 0..5 {
            if (row, column) != (4, 2) {
                problem.unknown(T0, row, column, None).unwrap();
            }
        }
    }
    problem.unknown_operator(T1).unwrap();
    let Solution::Family(family) = problem.solve().unwrap() else { panic!("a family") };
    assert_eq!(family.parameters.len(), 3);
    let forced = family.forced(T0).unwrap();
    let root = |p: &[Rational], x: Rational| p.iter().rev().fold(ratio(0, 1), |v, c| v * &x + c);
    for eigenvalue in [ratio(1, 1), ratio(1, 2), ratio(1, 8)] {
        assert_eq!(root(forced.polynomial().coeffs(), eigenvalue.clone()), ratio(0, 1));
        for k in 0..4 {
            let member = family.at(&[ratio(k, 3), ratio(-k, 5), ratio(k * k, 7)]);
            let all = characteristic(member.operator(T0).unwrap());
            assert_eq!(root(&all, eigenvalue.clone()), ratio(0, 1));
        }
    }
    assert_eq!(forced.polynomial().degree(), Some(3));
}

#[test]
fn curves_with_p_points_at_their_ends() {
    // Thesis, figure 3.12: n points, p at each vertex, vertex operator unknown too.
    let vertex_op = OpName::Piece { state: 1, letter: 0 };
    // For n >= 2p: p columns of the vertex with p − 1 parameters each, the p shared columns and the n − 2p other ones of
    // each operator with n − 1. For (3, 2) the overlap forces all but the vertex, for (4, 3) three of its parameters too.
    for (n, p, expected) in [(3, 1, 6), (4, 2, 8), (5, 2, 18), (3, 2, 2), (4, 3, 3)] {
        let piece = || (0, blank(n, n));
        let states = vec![
            edge("E", n, vec![piece(), piece()], (1, inclusion(n, p, 0)), (1, inclusion(n, p, n - p))),
            vertex("v", 1, blank(p, p)),
        ];
        let shape = Shape { states, start: 0, control: None, frame: Frame::Barycentric };
        let mut problem = Problem::new(Complex::of_curves(shape));
        for op in [T0, T1, vertex_op] {
            problem.unknown_operator(op).unwrap();
        }
        let Solution::Family(family) = problem.solve().unwrap() else { panic!("n = {n}, p = {p}") };
        assert_eq!(family.parameters.len(), expected, "n = {n}, p = {p}");
        let values: Vec<Rational> = (1..=expected as i64).map(|k| ratio(k, 7)).collect();
        assert_eq!(family.at(&values).check().unwrap(), 3);
    }
}

#[test]
fn contradictions_are_named() {
    // A vertex operator with another eigenvalue cannot be part of a quadratic B-spline whose T_0 is given.
    let mut complex = junction(4, [I, CUBIC]);
    *complex.operator_mut(OpName::Piece { state: I, letter: 0 }).unwrap() =
        matrix(&["1/2 1/4 0 0", "1/2 3/4 1/2 1/8", "0 0 1/2 3/4", "0 0 0 1/8"]);
    let mut problem = Problem::new(complex);
    problem.unknown_operator(T1).unwrap();
    let Solution::None(conflict) = problem.solve().unwrap() else { panic!("no solution") };
    let [Source::Identity(identity)] = conflict.as_slice() else { panic!("{conflict:?}") };
    assert_eq!((identity.kind, identity.state), (IdentityKind::Incidence, I));
    // Two unknown factors in a product.
    let mut problem = Problem::new(junction(4, [I, CUBIC]));
    problem.unknown_operator(T0).unwrap();
    problem.unknown_operator(OpName::Left(I)).unwrap();
    assert!(matches!(problem.solve(), Err(UnknownError::Nonlinear { .. })));
    assert!(matches!(problem.unknown(T0, 9, 0, None), Err(UnknownError::Entry { .. })));
    // Boundaries of different vertices where pieces should meet.
    let wrong = Problem::new(junction(4, [CUBIC, QUADRATIC]));
    assert!(matches!(wrong.solve(), Err(UnknownError::Complex(ComplexError::Different { .. }))));
}

#[test]
fn equal_names_are_equal_entries() {
    // A symmetric curve on three points with one unknown: T_1 is T_0 mirrored, entries named alike.
    let states = vec![
        edge("E", 3, vec![(0, blank(3, 3)), (0, blank(3, 3))], (1, inclusion(3, 2, 0)), (1, inclusion(3, 2, 1))),
        vertex("v", 1, matrix(&["3/4 1/4", "1/4 3/4"])),
    ];
    let shape = Shape { states, start: 0, control: None, frame: Frame::Barycentric };
    let mut problem = Problem::new(Complex::of_curves(shape));
    for i in 0..3 {
        for j in 0..3 {
            let name = format!("t{i}{j}");
            problem.unknown(T0, i, j, Some(&name)).unwrap();
            problem.unknown(T1, 2 - i, 2 - j, Some(&name)).unwrap();
        }
    }
    let Solution::One(solved) = problem.solve().unwrap() else { panic!("Chaikin's curve") };
    assert_eq!(solved.operator(T0), Some(&matrix(&["3/4 1/4 0", "1/4 3/4 3/4", "0 0 1/4"])));
}

#[test]
fn broken_complexes_are_diagnosed() {
    let broken = |change: &dyn Fn(&mut Complex)| {
        let mut patch = bicubic();
        change(&mut patch);
        let Err(ComplexError::Cell { state, message }) = patch.check() else { panic!("must be refused") };
        format!("{state}: {message}")
    };
    let text = broken(&|c| c.shape.states[0].pieces[1].target = 99);
    assert!(text.contains("T_1[A⊗A] comes from state 99"), "{text}");
    let text = broken(&|c| c.faces.get_mut(&0).unwrap().sides[2].edge = 0);
    assert!(text.contains("∂_top") && text.contains("wrong kind (face)"), "{text}");
    let text = broken(&|c| c.faces.get_mut(&0).unwrap().sides[0].op = blank(16, 11));
    assert!(text.contains("(16, 11), but must be (16, 12)"), "{text}");
    let text = broken(&|c| c.shape.states[1].left.as_mut().unwrap().vertex = 7);
    assert!(text.contains("∂_0") && text.contains("does not exist"), "{text}");
    let text = broken(&|c| drop(c.shape.states[0].pieces.pop()));
    assert!(text.contains("has 4 pieces, not 3"), "{text}");
    let text = broken(&|c| drop(c.faces.get_mut(&0).unwrap().sides.pop()));
    assert!(text.contains("has 4 sides, not 3"), "{text}");
    let text = broken(&|c| c.faces.get_mut(&0).unwrap().layout = secant::shape::Layout::Triangle);
    assert!(text.contains("sides"), "{text}");
    let text = broken(&|c| c.faces.get_mut(&0).unwrap().placement = vec![vec![0, 0, 1, 2]; 4]);
    assert!(text.contains("placement"), "{text}");
    let text = broken(&|c| c.faces.get_mut(&0).unwrap().placement = vec![vec![1, 0, 3, 2]; 4]);
    assert!(text.contains("no reversal"), "{text}");
    let text = broken(&|c| {
        let face = c.faces[&0].clone();
        c.faces.insert(44, face);
    });
    assert!(text.contains("number 44"), "{text}");
    let text = broken(&|c| drop(c.shape.states[1].pieces.pop()));
    assert!(text.contains("1 pieces, but needs 2"), "{text}");
}
