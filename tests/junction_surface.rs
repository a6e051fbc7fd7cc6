//! Junctions of two surfaces: all identities, the worked members, and what is proved of the joined surfaces.

use secant::answer::Answer;
use secant::arith::{Rational, abs, parse_rational, ratio};
use secant::case::Question;
use secant::certificate::confirm;
use secant::junction::surface::{Choice, FaceSide, Plan, SurfaceError, SurfaceJunction, SurfaceMember, find};
use secant::junction::{Pattern, Side, refine};
use secant::linalg::Matrix;
use secant::prelude::{Findings, prove};
use secant::scheme::bspline;
use secant::shape::{Address, CellKind, Complex, Shape};
use secant::theorem::surface::{Surface, certify_complex};
use secant::theorem::{Assertion, Certified, Verdict};

fn spline(degree: usize) -> Side {
    Side::of("spline", &bspline(degree, 2).unwrap().curve().unwrap()).unwrap()
}

fn product(degree: usize) -> FaceSide {
    FaceSide::new("product", spline(degree), spline(degree)).unwrap()
}

fn row(text: &str) -> Vec<Rational> {
    text.split(',').map(|x| parse_rational(x.trim()).unwrap()).collect()
}

fn pattern(text: &str) -> Pattern {
    Pattern::parse(text).unwrap()
}

fn member(text: &str, choice: Choice) -> Option<SurfaceMember> {
    let plan = Plan { pattern: Some(pattern(text)), choice };
    find(&product(2), &product(3), &plan).unwrap().member
}

/// The member of thesis §5.2 with the sparse curve row.
fn semi_tensor() -> SurfaceMember {
    member("a,I", Choice::SemiTensor(vec![row("0, 1/4, 3/16, 1/2, 1/16")])).expect("it passes")
}

fn complex(member: &SurfaceMember) -> Complex {
    let complex = member.family.complex(&member.stencils, member.precise).unwrap();
    complex.check().unwrap();
    complex.shape.check().unwrap();
    complex
}

fn certified(complex: &Complex) -> Certified {
    let question = Question::of_complex("joined", complex).unwrap();
    let Findings::Tangents { case, found } = prove(&question, &secant::budget::Budget::default()).unwrap() else {
        unreachable!("a surface")
    };
    confirm(&case, &found).unwrap();
    *found
}

fn surface(found: &Certified) -> &Surface {
    found.surface.as_ref().unwrap()
}

/// The copies of the intermediate face in itself, on columns.
fn copies(complex: &Complex) -> Vec<Matrix> {
    complex.shape.states[1].pieces.iter().filter(|p| p.target == 1).map(|p| p.op.clone()).collect()
}

#[test]
fn the_families_have_the_right_size() {
    let (two, three) = (product(2), product(3));
    for (text, free, parameters, unknowns) in [("a,I", 2, 24, 1219), ("I,b", 2, 19, 1549), ("a,I,b", 4, 43, 0)] {
        let family = SurfaceJunction::new(&two, &three, pattern(text)).unwrap();
        assert_eq!((family.points(), family.free.len(), family.parameters()), ([18, 13], free, parameters), "{text}");
        let plain: Vec<Vec<Rational>> = family.free.iter().map(|f| first(f, &family)).collect();
        let complex = family.complex(&plain, false).unwrap();
        complex.check().unwrap();
        let size = |e: usize| complex.shape.states[e].pieces.iter().map(|p| p.op.rows() * p.op.cols()).sum::<usize>();
        if unknowns > 0 {
            // The face and its edge across the border.
            assert_eq!(size(1) + size(2), unknowns, "{text}");
        }
    }
}

/// The stencil that takes the first point it may use.
fn first(free: &secant::junction::surface::Free, family: &SurfaceJunction) -> Vec<Rational> {
    let mut stencil = vec![ratio(0, 1); family.points()[1]];
    // Points of the edge: two of each column of the one scheme, three of the other.
    let index = |(c, r): (usize, usize)| if c < 2 { 2 * c + r } else { 4 + 3 * (c - 2) + r };
    stencil[index(free.support[0])] = ratio(1, 1);
    stencil
}

/// Whatever the stencils are, all identities hold; a stencil must not use a point that a vertex which sees it does not have.
#[test]
fn every_array_satisfies_the_identities() {
    let family = SurfaceJunction::new(&product(2), &product(3), pattern("a,I,b")).unwrap();
    let mut seed = 7_i64;
    let mut next = || {
        seed = (seed * 1103 + 12345) % 65536;
        ratio(seed % 7 - 3, 5)
    };
    let index = |(c, r): (usize, usize)| if c < 2 { 2 * c + r } else { 4 + 3 * (c - 2) + r };
    let mut stencils = Vec::new();
    for free in &family.free {
        let mut stencil = vec![ratio(0, 1); 13];
        free.support[1..].iter().for_each(|p| stencil[index(*p)] = next());
        let sum = stencil.iter().fold(ratio(0, 1), |s, x| s + x);
        stencil[index(free.support[0])] = ratio(1, 1) - sum;
        stencils.push(stencil);
    }
    let complex = family.complex(&stencils, false).unwrap();
    assert!(complex.check().unwrap() > 80);
    let shared = family.free.iter().position(|f| f.support.len() == 8).unwrap();
    let mut wrong = stencils.clone();
    wrong[shared] = (0..13).map(|k| ratio(i64::from(k == 0), 1)).collect();
    // Point 0 is there, point 1, in the upper row of the same column, is not.
    assert!(family.complex(&wrong, false).is_ok());
    wrong[shared] = (0..13).map(|k| ratio(i64::from(k == 1), 1)).collect();
    assert!(matches!(family.complex(&wrong, false), Err(SurfaceError::Stencil(_))));
    let mut broken = complex;
    let op = &mut broken.shape.states[1].pieces[0].op;
    let (x, y) = (op[(2, 8)].clone() + ratio(1, 1), op[(3, 8)].clone() - ratio(1, 1));
    (op[(2, 8)], op[(3, 8)]) = (x, y);
    assert!(broken.check().is_err());
}

#[test]
fn the_semi_tensor_member() {
    let found = semi_tensor();
    let b = [ratio(3, 16), ratio(1, 2), ratio(1, 16)];
    let along = [ratio(7, 24), ratio(2, 3), ratio(1, 24)];
    let mut wanted = vec![ratio(0, 1), ratio(0, 1), ratio(3, 16), ratio(1, 16)];
    wanted.extend(b.iter().flat_map(|x| along.iter().map(move |y| x * y)));
    assert_eq!(found.stencils[0], wanted);
    // The mirror image.
    let mirrored = |s: &[Rational]| -> Vec<Rational> {
        [&s[..2], &s[2..4], &s[4..7], &s[7..10], &s[10..]].iter().flat_map(|c| c.iter().rev().cloned()).collect()
    };
    assert_eq!(found.stencils[1], mirrored(&wanted));
    assert!(found.precise && found.check.passes && found.check.dim == 15);
    let complex = complex(&found);
    for op in copies(&complex) {
        for (n, count) in [(1, 1), (2, 2), (4, 5), (8, 5), (16, 4), (32, 1)] {
            let mut power = &op - &Matrix::identity(18).scale(&ratio(1, n));
            for _ in 0..3 {
                power = &power * &power;
            }
            assert_eq!(18 - power.rank(), count, "1/{n}");
        }
        assert!(op.rank() == 18 && (0..18).all(|i| op.row(i).iter().all(|x| *x >= 0)));
    }
    // The products of six copies on what positions do not see.
    let [u, v] = found.positions.clone().unwrap();
    let kernel = Matrix::from_rows(18, vec![vec![ratio(1, 1); 18], u, v]).kernel();
    let steps: Vec<Matrix> = copies(&complex).iter().map(|op| kernel.solve(&(op * &kernel)).unwrap()).collect();
    let mut products = vec![Matrix::identity(15)];
    for _ in 0..6 {
        products = products.iter().flat_map(|p| steps.iter().map(move |s| p * s)).collect();
    }
    let norm = |m: &Matrix| (0..15).map(|j| m.column(j).iter().fold(ratio(0, 1), |s, x| s + abs(x))).max().unwrap();
    let largest = products.iter().map(norm).max().unwrap();
    assert!(largest <= ratio(488_663, 524_288) / ratio(64, 1), "{largest}");
}

fn claim(found: &Certified, what: &Assertion) -> Verdict {
    found.claims.iter().find(|c| c.what == *what).unwrap().verdict()
}

fn dense(found: &Certified) -> Verdict {
    found.claims.iter().find(|c| matches!(c.what, Assertion::DensePlanes { .. })).unwrap().verdict()
}

#[test]
fn the_strip_has_a_plane_at_every_point() {
    let complex = complex(&semi_tensor());
    assert_eq!(complex.shape.states[0].dim, 32);
    let found = certified(&complex);
    assert_eq!(surface(&found).points.len(), 12);
    assert_eq!(claim(&found, &Assertion::PlaneAtVertices), Verdict::Proved);
    assert_eq!(dense(&found), Verdict::Proved);
    assert_eq!(claim(&found, &Assertion::PlaneEverywhere), Verdict::Proved, "{:?}", surface(&found).every);
}

#[test]
fn heights_over_the_positions() {
    let found = semi_tensor();
    let mut complex = complex(&found);
    let [u, v] = found.family.all_positions().unwrap();
    let height = |k: usize| ratio(i64::try_from((k * k * 7 + 3 * k) % 11).unwrap(), 4);
    complex.shape.control = Some(Matrix::from_rows(32, vec![u, v, (0..32).map(height).collect()]));
    assert_eq!(claim(&certified(&complex), &Assertion::PlaneEverywhere), Verdict::Proved);
    // A plane of heights: the surface is that plane.
    let [u, v] = found.family.all_positions().unwrap();
    let sum: Vec<Rational> = u.iter().zip(&v).map(|(x, y)| x + y).collect();
    complex.shape.control = Some(Matrix::from_rows(32, vec![u, v, sum]));
    let flat = certify_complex(&complex, &[]).unwrap();
    let images: Vec<&Vec<Rational>> = surface(&flat).points.iter().filter_map(|p| p.image.as_ref()).collect();
    assert!(images.len() == 12 && images.iter().all(|x| x[2] == &x[0] + &x[1]));
}

/// Three columns of pieces: the edges across the border are divided as the positions are, not evenly.
#[test]
fn a_pattern_with_both_schemes() {
    let rows = vec![row("0, 7/10, 1/5, 1/10, 0"), row("0, 3/10, 11/20, 3/20, 0")];
    let found = member("a,I,b", Choice::SemiTensor(rows)).expect("it passes");
    let complex = complex(&found);
    let shares: Vec<Rational> = (0..3).map(|i| complex.shape.states[2].share(i)).collect();
    assert_eq!(shares, [ratio(1, 4), ratio(1, 2), ratio(1, 4)]);
    let certified = certified(&complex);
    assert_eq!(claim(&certified, &Assertion::PlaneEverywhere), Verdict::Proved, "{:?}", surface(&certified).every);
    // Divided evenly the same surface is not C¹ in its parameters, and nothing is claimed.
    let even = found.family.complex(&found.stencils, false).unwrap();
    let even = certify_complex(&even, &[]).unwrap();
    assert!(matches!(surface(&even).every, Answer::Open(_)));
}

#[test]
fn the_least_members() {
    let bound = |m: &SurfaceMember| m.check.bound.clone().unwrap();
    let two = member("a,I", Choice::Least).expect("it passes");
    assert_eq!(two.degree, 2);
    assert!(bound(&two) < ratio(485, 1000), "{:?}", two.check.about());
    let three = member("a,I,b", Choice::Least).expect("it passes");
    assert!(three.degree == 2 && bound(&three) < ratio(38, 100), "{:?}", three.check.about());
    // The stencil that two vertices see has one row of the quadratic scheme, whose weights cancel.
    let shared = three.family.free.iter().position(|f| f.support.len() == 8).unwrap();
    let stencil = &three.stencils[shared];
    assert_eq!((&stencil[0] + &stencil[2], abs(&stencil[0])), (ratio(0, 1), ratio(15, 173)));
    // The quadratic scheme cannot be left out.
    assert!(member("I,b", Choice::Least).is_none());
}

/// Without affine precision planes at vertices and a dense set are proved, and nothing at every point.
#[test]
fn a_stencil_without_positions() {
    let stencil = "0, 0, 3/16, 1/16, 3/16, 9/16, 0, 0, 0, 0, 0, 0, 0";
    let mirrored = "0, 0, 1/16, 3/16, 0, 9/16, 3/16, 0, 0, 0, 0, 0, 0";
    let found = member("a,I", Choice::Given(vec![row(stencil), row(mirrored)])).expect("it contracts");
    assert!(!found.precise);
    let found = certified(&complex(&found));
    assert_eq!(claim(&found, &Assertion::PlaneAtVertices), Verdict::Proved);
    assert_eq!(dense(&found), Verdict::Proved);
    assert_eq!(claim(&found, &Assertion::PlaneEverywhere), Verdict::Undetermined);
}

#[test]
fn the_strip_refined() {
    let mut before = complex(&semi_tensor());
    let [u, v] = semi_tensor().family.all_positions().unwrap();
    before.shape.control = Some(Matrix::from_rows(32, vec![u.clone(), v, u.iter().map(|x| x * x).collect()]));
    let refined = refine(&before).unwrap();
    let (shape, after) = (&before.shape, &refined.complex);
    let start = &after.shape.states[after.shape.start];
    // Six columns and four rows of cells.
    assert_eq!((start.kind, start.pieces.len(), refined.embedding.rank()), (CellKind::Face, 24, 32));
    for (piece, word) in start.pieces.iter().zip(&refined.cells) {
        let (product, target) = shape.product(shape.start, word);
        assert_eq!((&refined.embedding * &piece.op, piece.target), (product, target), "E T' = T E");
    }
    assert!(after.check().unwrap() > before.check().unwrap());
    let again = refine(after).unwrap();
    again.complex.check().unwrap();
    // A point on the border is the same by the address that the refined surface gives it.
    let (old, new) = (Address::parse("01(3)").unwrap(), Address::parse("1(3)").unwrap());
    let image = |shape: &Shape, address: &Address| {
        shape.control.as_ref().unwrap().apply(&shape.point(shape.start, address).unwrap())
    };
    assert_eq!(refined.cells[1], [0, 1]);
    assert_eq!(image(&before.shape, &old), image(&after.shape, &new));
}
