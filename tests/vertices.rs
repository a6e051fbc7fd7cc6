//! Subdivision matrices at extraordinary vertices against an outside oracle (FLINT) and the published eigenvalues.

use secant::arith::{Rational, parse_rational, ratio};
use secant::linalg::{Matrix, char_poly};
use secant::scheme::{LocalMatrix, MeshRule, SchemeError, Sector, local_matrix, local_matrix_of, mesh_rule};
use std::collections::BTreeMap;

fn scheme(name: &str, given: &[(&str, Rational)]) -> MeshRule {
    mesh_rule(name, &given.iter().map(|(k, x)| ((*k).to_owned(), x.clone())).collect()).unwrap()
}

fn characteristic(m: &Matrix) -> Vec<Rational> {
    char_poly(m).coeffs().to_vec()
}

fn local(rule: &MeshRule, valence: usize, rings: usize) -> LocalMatrix {
    let result = local_matrix(rule, valence, rings).unwrap_or_else(|e| panic!("valence {valence}: {e}"));
    let m = &result.matrix;
    for i in 0..m.rows() {
        assert_eq!(m.row(i).iter().fold(ratio(0, 1), |s, x| s + x), 1, "row sums");
    }
    assert_eq!(*result.rings.last().unwrap(), m.rows());
    result
}

/// `p(m)` for coefficients from the constant one upwards.
fn polynomial(m: &Matrix, p: &[Rational]) -> Matrix {
    let id = Matrix::identity(m.rows());
    p.iter().rev().fold(Matrix::zero(m.rows(), m.rows()), |v, c| &(&v * m) + &id.scale(c))
}

/// The dimension of the kernel of `p(m)`.
fn nullity(m: &Matrix, p: &[(i64, i64)]) -> usize {
    let p: Vec<Rational> = p.iter().map(|(a, b)| ratio(*a, *b)).collect();
    m.rows() - polynomial(m, &p).rank()
}

#[test]
fn characteristic_polynomials_agree_with_flint() {
    let oracle: BTreeMap<String, Vec<String>> =
        serde_json::from_str(include_str!("oracle/vertex_charpoly.json")).unwrap();
    assert_eq!(oracle.len(), 25);
    for (name, expected) in &oracle {
        let (family, valence) = name.split_once('_').unwrap();
        let valence: usize = valence.parse().unwrap();
        let (rule, rings) = match family {
            "cc1" => (scheme("catmull-clark", &[]), 1),
            "cc2" => (scheme("catmull-clark", &[]), 2),
            "loop1" => (scheme("loop-warren", &[]), 1),
            "loop2" => (scheme("loop-warren", &[]), 2),
            _ => (scheme("doo-sabin-catmull-clark", &[]), 1),
        };
        let found = local(&rule, valence, rings).matrix;
        let expected: Vec<Rational> = expected.iter().map(|c| parse_rational(c).unwrap()).collect();
        assert_eq!(characteristic(&found), expected, "{name}");
    }
}

#[test]
fn regular_valences_give_the_spline_spectra() {
    // Catmull–Clark of valence 4: 1, 1/2 twice, 1/4 three times, 1/8 twice, 1/16.
    let m = local(&scheme("catmull-clark", &[]), 4, 1).matrix;
    for (root, times) in [(1, 1), (2, 2), (4, 3), (8, 2), (16, 1)] {
        assert_eq!(nullity(&m, &[(-1, root), (1, 1)]), times, "1/{root}");
    }
    // Loop of valence 6: 1, 1/2 twice, 1/4 three times, 1/8.
    for name in ["loop", "loop-warren"] {
        let m = local(&scheme(name, &[]), 6, 1).matrix;
        for (root, times) in [(1, 1), (2, 2), (4, 3), (8, 1)] {
            assert_eq!(nullity(&m, &[(-1, root), (1, 1)]), times, "1/{root}");
        }
    }
    // The butterfly scheme reproduces cubics at valence 6: 1, 1/2 twice, 1/4 three times, 1/8 four times at least.
    let m = local(&scheme("butterfly-modified", &[("w", ratio(1, 16))]), 6, 2).matrix;
    for (root, times) in [(1, 1), (2, 2)] {
        assert_eq!(nullity(&m, &[(-1, root), (1, 1)]), times, "1/{root}");
    }
    assert!(nullity(&m, &[(-1, 4), (1, 1)]) >= 3);
}

#[test]
fn catmull_clark_eigenvalues_solve_their_quadratic() {
    // 16x² − (10 + 2c)x + 1, c = cos(2πk/n), for every frequency k.
    let rule = scheme("catmull-clark", &[]);
    assert_eq!(nullity(&local(&rule, 3, 1).matrix, &[(1, 1), (-9, 1), (16, 1)]), 4);
    assert_eq!(nullity(&local(&rule, 6, 1).matrix, &[(1, 1), (-11, 1), (16, 1)]), 4);
    // n = 5: A² + Ax − x² with A = 16x² − 10x + 1, the norm over the conjugates of c.
    let quartic = [(1, 1), (-19, 1), (121, 1), (-304, 1), (256, 1)];
    assert_eq!(nullity(&local(&rule, 5, 1).matrix, &quartic), 8);
    assert_eq!(nullity(&local(&rule, 5, 2).matrix, &quartic), 8);
    // The rings of the characteristic map: 12n + 1 points, the same leading part.
    let characteristic_ring = local(&rule, 5, 3);
    assert_eq!(characteristic_ring.rings, [1, 11, 31, 61]);
    assert_eq!(nullity(&characteristic_ring.matrix, &quartic), 8);
}

#[test]
fn catmull_clark_variants_move_the_symmetric_part() {
    // x² − (α − 1/4)x + (1/2 − β)/8 for frequency 0.
    for (n, a, b) in [(6, (1, 1), (0, 1)), (5, (3, 4), (1, 4)), (3, (1, 2), (1, 2)), (4, (7, 8), (1, 8))] {
        let (alpha, beta) = (ratio(a.0, a.1), ratio(b.0, b.1));
        let rule = scheme("catmull-clark-variant", &[("alpha", alpha.clone()), ("beta", beta.clone())]);
        let m = local(&rule, n, 1).matrix;
        let p = [(ratio(1, 2) - beta) / ratio(8, 1), ratio(1, 4) - alpha, ratio(1, 1)];
        assert_eq!(m.rows() - polynomial(&m, &p).rank(), 2, "n = {n}");
    }
}

#[test]
fn loop_eigenvalues_are_those_published() {
    let original = scheme("loop", &[]);
    // λ = 3/8 + cos(2π/n)/4 twice, μ₀ = (3/8 + c/4)².
    for (n, lambda, symmetric) in [(3, (1, 4), (1, 16)), (4, (3, 8), (9, 64)), (6, (1, 2), (1, 4))] {
        let m = local(&original, n, 1).matrix;
        let times = nullity(&m, &[(-lambda.0, lambda.1), (1, 1)]);
        assert_eq!(times, 2, "n = {n}");
        assert!(nullity(&m, &[(-symmetric.0, symmetric.1), (1, 1)]) >= 1, "n = {n}");
    }
    assert!(matches!(local_matrix(&original, 5, 1), Err(SchemeError::Irrational(_))));
    // n = 5: (5 ± √5)/16, each twice, 64x² − 40x + 5.
    let warren = local(&scheme("loop-warren", &[]), 5, 1).matrix;
    assert_eq!(nullity(&warren, &[(5, 1), (-40, 1), (64, 1)]), 4);
    // Given β: μ₀ = 5/8 − nβ.
    for (n, beta, mu) in [
        (6, (0, 1), (5, 8)),
        (3, (1, 8), (1, 4)),
        (4, (1, 16), (3, 8)),
        (4, (1, 20), (17, 40)),
        (4, (1, 40), (21, 40)),
        (5, (1, 32), (15, 32)),
        (5, (1, 40), (1, 2)),
        (5, (1, 100), (23, 40)),
        (8, (0, 1), (5, 8)),
        (12, (0, 1), (5, 8)),
        (6, (1, 4), (-7, 8)),
    ] {
        let rule = scheme("loop-variant", &[("beta", ratio(beta.0, beta.1))]);
        let m = local(&rule, n, 1).matrix;
        let shared = nullity(&m, &[(-mu.0, mu.1), (1, 1)]);
        // Where λ has the same value the eigenvalue is triple.
        let expected = if (n, mu) == (3, (1, 4)) || (n, mu) == (4, (3, 8)) { 3 } else { 1 };
        assert_eq!(shared, expected, "n = {n}");
    }
    assert_eq!(local(&original, 6, 3).rings, [1, 7, 19, 37]);
}

#[test]
fn dual_schemes_have_their_published_eigenvalues() {
    for n in [3, 4, 6] {
        let m = local(&scheme("doo-sabin", &[]), n, 1).matrix;
        assert_eq!(nullity(&m, &[(-1, 2), (1, 1)]), 2, "n = {n}");
        assert_eq!(nullity(&m, &[(-1, 4), (1, 1)]), n - 3, "n = {n}");
        let wide = local(&scheme("doo-sabin", &[]), n, 3);
        assert_eq!(wide.rings, [0, n, 4 * n, 9 * n]);
        assert_eq!(nullity(&wide.matrix, &[(-1, 2), (1, 1)]), 2, "n = {n}");
    }
    assert!(matches!(local_matrix(&scheme("doo-sabin", &[]), 5, 1), Err(SchemeError::Irrational(_))));
    // Midedge: cos²(π k/n); n = 5: (3 ± √5)/8, 16x² − 12x + 1; n = 6: 3/4.
    let midedge = scheme("midedge", &[]);
    assert_eq!(nullity(&local(&midedge, 5, 1).matrix, &[(1, 1), (-12, 1), (16, 1)]), 4);
    assert_eq!(nullity(&local(&midedge, 6, 1).matrix, &[(-3, 4), (1, 1)]), 2);
    assert_eq!(nullity(&local(&midedge, 4, 1).matrix, &[(-1, 2), (1, 1)]), 2);
    // n = 3, two rings: x(x−1)(4x−1)² once and x(4x−1)³ twice, with a block of size 2 in each of the latter.
    let m = local(&midedge, 3, 2).matrix;
    assert_eq!(m.rows(), 12);
    let expected = {
        let mut p = vec![ratio(1, 1)];
        let roots = [(0, 3), (1, 1)].map(|(r, k)| (ratio(r, 1), k)).into_iter().chain([(ratio(1, 4), 8)]);
        for (root, times) in roots {
            for _ in 0..times {
                let mut next = vec![ratio(0, 1); p.len() + 1];
                for (k, c) in p.iter().enumerate() {
                    next[k + 1] += c;
                    next[k] -= c * &root;
                }
                p = next;
            }
        }
        p
    };
    assert_eq!(characteristic(&m), expected);
    assert_eq!(nullity(&m, &[(-1, 4), (1, 1)]), 2 + 2 * 2);
    assert_eq!(nullity(&m, &[(1, 16), (-1, 2), (1, 1)]), 8);
}

#[test]
fn turning_schemes_have_their_published_eigenvalues() {
    // √3, two steps: λ = (2 + 2cos(2π/n))/9.
    for (n, lambda) in [(3, (1, 9)), (4, (2, 9)), (6, (1, 3))] {
        let result = local(&scheme("sqrt3", &[]), n, 1);
        assert_eq!(result.steps, 2);
        assert_eq!(nullity(&result.matrix, &[(-lambda.0, lambda.1), (1, 1)]), 2, "n = {n}");
    }
    // n = 5 with given weight: (3 ± √5)/18, 81x² − 27x + 1.
    let m = local(&scheme("sqrt3-variant", &[("alpha", ratio(3, 8))]), 5, 1).matrix;
    assert_eq!(nullity(&m, &[(1, 1), (-27, 1), (81, 1)]), 4);
    // 4-8: at valence 4 the double eigenvalue is 1/2; at valence 6 (c = 1/2) and 3 (c = −1/2) the published quintic divides.
    assert_eq!(nullity(&local(&scheme("four-eight", &[]), 4, 2).matrix, &[(-1, 2), (1, 1)]), 2);
    for (n, c) in [(3, ratio(-1, 2)), (6, ratio(1, 2)), (4, ratio(0, 1))] {
        let c2 = &c * &c;
        let p = [
            -(&c2 * (ratio(1, 1) + &c)) / ratio(1 << 21, 1),
            (ratio(8, 1) + ratio(3, 1) * &c + ratio(3, 1) * &c2) / ratio(32768, 1),
            -(ratio(50, 1) + ratio(13, 1) * &c + ratio(3, 1) * &c2) / ratio(4096, 1),
            (ratio(42, 1) + ratio(10, 1) * &c + &c2) / ratio(256, 1),
            -(ratio(25, 1) + ratio(5, 1) * &c) / ratio(32, 1),
            ratio(1, 1),
        ];
        let m = local(&scheme("four-eight", &[]), n, 2).matrix;
        let found = m.rows() - polynomial(&m, &p).rank();
        assert!(found >= 8, "n = {n}: {found}");
    }
}

#[test]
fn the_butterfly_scheme_has_its_cubic() {
    // 64x³ + (64h⁴ − 96h² − 16)x² + (23h² − 12h⁴ + 1)x − h² with h = cos(πk/n), so h² = (1 + cos(2πk/n))/2.
    let rule = scheme("butterfly", &[("w", ratio(1, 16))]);
    assert!(matches!(local_matrix(&rule, 6, 1), Err(SchemeError::Rings { .. })));
    for (n, h2) in [(3, ratio(1, 4)), (4, ratio(1, 2)), (6, ratio(3, 4))] {
        let h4 = &h2 * &h2;
        let p = [
            -&h2,
            ratio(23, 1) * &h2 - ratio(12, 1) * &h4 + ratio(1, 1),
            ratio(64, 1) * &h4 - ratio(96, 1) * &h2 - ratio(16, 1),
            ratio(64, 1),
        ];
        let m = local(&rule, n, 2).matrix;
        assert_eq!(m.rows(), 3 * n + 1);
        let found = m.rows() - polynomial(&m, &p).rank();
        assert!(found >= 6 - usize::from(n == 3), "n = {n}: {found}");
    }
    for n in [3, 4] {
        let m = local(&scheme("butterfly-modified", &[("w", ratio(1, 16))]), n, 2).matrix;
        assert_eq!(nullity(&m, &[(-1, 2), (1, 1)]), 2, "modified, n = {n}");
    }
    assert!(matches!(
        local_matrix(&scheme("butterfly-modified", &[("w", ratio(1, 16))]), 7, 2),
        Err(SchemeError::Irrational(_))
    ));
}

#[test]
fn mixed_meshes_contain_both_regular_schemes() {
    let mixed = scheme("quad-triangle", &[]);
    let quads = local_matrix_of(&mixed, &[Sector::Quads; 4], 2).unwrap().matrix;
    assert_eq!(quads, local(&scheme("catmull-clark", &[]), 4, 2).matrix);
    let triangles = local_matrix_of(&mixed, &[Sector::Triangles; 6], 2).unwrap().matrix;
    assert_eq!(triangles, local(&scheme("loop-warren", &[]), 6, 2).matrix);
    // Two quadrangles and three triangles: regular, 1/2 twice.
    use Sector::{Quads, Triangles};
    let seam = local_matrix_of(&mixed, &[Quads, Quads, Triangles, Triangles, Triangles], 2).unwrap();
    assert_eq!(nullity(&seam.matrix, &[(-1, 2), (1, 1)]), 2);
}

#[test]
fn limits_are_diagnosed() {
    let rule = scheme("catmull-clark", &[]);
    assert!(matches!(local_matrix(&rule, 2, 1), Err(SchemeError::Value { .. })));
    assert!(matches!(local_matrix(&rule, 5, 0), Err(SchemeError::Value { .. })));
    assert!(matches!(local_matrix(&rule, 100_000, 1), Err(SchemeError::Large { .. })));
    assert!(matches!(local_matrix(&rule, 5, 100_000), Err(SchemeError::Large { .. })));
    let short = scheme("doo-sabin", &[]).with_weights(vec![ratio(1, 1)]).unwrap();
    assert!(matches!(local_matrix(&short, 5, 1), Err(SchemeError::Mesh { .. })));
    assert!(matches!(local_matrix_of(&rule, &[Sector::Triangles; 5], 1), Err(SchemeError::Mesh { .. })));
}

#[test]
fn patches_at_extraordinary_vertices_are_complexes() {
    use secant::scheme::patch;
    let face_dim = |rule: &MeshRule, n: usize| {
        let complex = patch(rule, n).unwrap_or_else(|e| panic!("valence {n}: {e}"));
        assert!(complex.check().unwrap() > 12);
        complex.shape.states[0].dim
    };
    let cc = scheme("catmull-clark", &[]);
    let warren = scheme("loop-warren", &[]);
    assert_eq!([3, 4, 5, 6, 9].map(|n| face_dim(&cc, n)), [14, 16, 18, 20, 26]);
    assert_eq!([3, 4, 5, 6, 7].map(|n| face_dim(&warren, n)), [9, 10, 11, 12, 13]);
    let dual = scheme("doo-sabin-catmull-clark", &[]);
    assert_eq!([3, 4, 5, 8].map(|n| face_dim(&dual, n)), [8, 9, 10, 13]);
    let given = scheme("loop-variant", &[("beta", ratio(1, 20))]);
    assert_eq!(face_dim(&given, 6), 12);
    assert!(matches!(patch(&scheme("four-eight", &[]), 5), Err(SchemeError::Mesh { .. })));
}

#[test]
fn the_regular_patches_are_the_splines() {
    use secant::scheme::{bspline, patch, tensor};
    let complex = patch(&scheme("catmull-clark", &[]), 4).unwrap();
    let dims: Vec<usize> = complex.shape.states.iter().map(|s| s.dim).collect();
    assert_eq!(dims, [16, 12, 12, 9]);
    let curve = bspline(3, 2).unwrap().curve_with_vertices().unwrap();
    let product = tensor(&curve, &curve).unwrap();
    for letter in 0..4 {
        let op = |c: &secant::shape::Complex| characteristic(&c.shape.states[0].pieces[letter].op);
        assert_eq!(op(&complex), op(&product), "piece {letter}");
    }
    let quadratic = bspline(2, 2).unwrap().curve_with_vertices().unwrap();
    let product = tensor(&quadratic, &quadratic).unwrap();
    let complex = patch(&scheme("doo-sabin", &[]), 4).unwrap();
    let dims: Vec<usize> = complex.shape.states.iter().map(|s| s.dim).collect();
    assert_eq!(dims, [9, 6, 6, 4]);
    for letter in 0..4 {
        let op = |c: &secant::shape::Complex| characteristic(&c.shape.states[0].pieces[letter].op);
        assert_eq!(op(&complex), op(&product), "piece {letter}");
    }
    let loops = patch(&scheme("loop", &[]), 6).unwrap();
    let dims: Vec<usize> = loops.shape.states.iter().map(|s| s.dim).collect();
    assert_eq!(dims, [12, 12, 10, 10, 10, 7]);
    // Corner pieces: 1, 1/2, 1/2, 1/4, 1/4, 1/4, and 1/8 three times, 1/16 three times.
    let corner = &loops.shape.states[0].pieces[0].op;
    for (root, times) in [(1, 1), (2, 2), (4, 3)] {
        assert_eq!(nullity(corner, &[(-1, root), (1, 1)]), times, "1/{root}");
    }
}

#[test]
fn irregular_patches_keep_the_vertex_spectrum() {
    use secant::scheme::patch;
    let rule = scheme("catmull-clark", &[]);
    let complex = patch(&rule, 5).unwrap();
    let quartic = [(1, 1), (-19, 1), (121, 1), (-304, 1), (256, 1)];
    let state = |name: &str| complex.shape.states.iter().find(|s| s.name == name).unwrap();
    assert_eq!(nullity(&state("vertex*").pieces[0].op, &quartic), 8);
    assert_eq!(nullity(&state("face*").pieces[0].op, &quartic), 8);
    assert_eq!(state("vertex*").pieces[0].op, local(&rule, 5, 1).matrix.transpose());
}

#[test]
fn mesh_rules_have_names() {
    use secant::scheme::{mesh_rule, mesh_rules};
    let given: BTreeMap<String, Rational> =
        [("alpha", ratio(3, 4)), ("beta", ratio(1, 16))].map(|(k, v)| (k.to_owned(), v)).into();
    assert!(mesh_rules().iter().map(|r| r.name).is_sorted());
    for info in mesh_rules() {
        let own: BTreeMap<String, Rational> = given
            .iter()
            .filter(|(k, _)| info.parameters.iter().any(|p| p.name == *k))
            .map(|(k, v)| (k.clone(), v.clone()))
            .collect();
        let rule = mesh_rule(info.name, &own).unwrap_or_else(|e| panic!("{}: {e}", info.name));
        local(&rule, 4, 2);
    }
    assert!(matches!(mesh_rule("loop-variant", &BTreeMap::new()), Err(SchemeError::Missing { .. })));
    assert!(
        matches!(mesh_rule("catmul-clark", &BTreeMap::new()), Err(SchemeError::Unknown { near, .. }) if near.as_deref() == Some("catmull-clark"))
    );
}

#[test]
fn discs_are_covered_by_their_pieces() {
    use secant::scheme::{disc, patch};
    for (rule, n) in [
        (scheme("catmull-clark", &[]), 3),
        (scheme("catmull-clark", &[]), 4),
        (scheme("catmull-clark", &[]), 5),
        (scheme("loop-warren", &[]), 3),
        (scheme("loop-warren", &[]), 5),
        (scheme("loop-warren", &[]), 6),
        (scheme("doo-sabin-catmull-clark", &[]), 3),
        (scheme("doo-sabin-catmull-clark", &[]), 4),
        (scheme("doo-sabin-catmull-clark", &[]), 5),
        (scheme("midedge", &[]), 3),
    ] {
        let shape = disc(&rule, n).unwrap_or_else(|e| panic!("valence {n}: {e}"));
        let complex = patch(&rule, n).unwrap();
        assert_eq!(shape.states[0].pieces.len(), 1 + 3 * n);
        // The corner 0 of the patch, in its own coordinates and in those of every sector, is the centre of the disc.
        let at = secant::shape::Address::periodic(vec![0]);
        let centre = shape.point(0, &at).unwrap();
        let corner = complex.shape.point(0, &at).unwrap();
        let sectors: Vec<Matrix> = (0..n).map(|k| sector(&shape, &complex, 3 * k)).collect();
        for inclusion in &sectors {
            assert_eq!(inclusion.apply(&corner), centre, "valence {n}");
            // The step of the disc and of the patch agree on the sector.
            let disc_step = &shape.states[0].pieces[0].op;
            assert_eq!(disc_step * inclusion, inclusion * &complex.shape.states[0].pieces[0].op, "valence {n}");
        }
        // Neighbouring sectors share an edge: left side of one, bottom (or first) side of the next.
        let last = complex.faces[&0].sides.len() - 1;
        let (first, side) = (&complex.faces[&0].sides[0], &complex.faces[&0].sides[last]);
        let (bottom, left) = (curve(&complex, first, &[0, 1, 1]), curve(&complex, side, &[0, 1, 1]));
        for k in 0..n {
            assert_eq!(sectors[k].apply(&left), sectors[(k + 1) % n].apply(&bottom), "valence {n}, sector {k}");
        }
    }
}

/// The inclusion of a sector, from the pieces `sector * T_j` of the disc and the `T_j` of the patch.
fn sector(shape: &secant::shape::Shape, complex: &secant::shape::Complex, offset: usize) -> Matrix {
    let stacked = |pieces: Vec<&Matrix>| pieces.into_iter().map(Matrix::transpose).reduce(|a, b| a.stack(&b)).unwrap();
    let disc = stacked((1..4).map(|j| &shape.states[0].pieces[offset + j].op).collect());
    let patch = stacked((1..4).map(|j| &complex.shape.states[0].pieces[j].op).collect());
    // patch * inclusionᵀ = disc, and the three pieces together span the patch's points.
    patch.solve(&disc).unwrap().transpose()
}

/// A point of a side of a face, by the address `word (0)` of its edge.
fn curve(complex: &secant::shape::Complex, side: &secant::shape::Side, word: &[usize]) -> Vec<Rational> {
    let address = secant::shape::Address { prefix: word.to_vec(), cycle: vec![0] };
    let address = address.normalise(&complex.shape, side.edge).unwrap();
    side.op.apply(&complex.shape.point(side.edge, &address).unwrap())
}

#[test]
fn the_butterfly_scheme_fails_at_high_valences() {
    // Subdominant eigenvalue of frequency 2 (n = 9, 10) and 3 (n = 14), so the characteristic map winds more than once
    // (D. Zorin, Ph.D. thesis, Caltech 1998). A change of sign within 10^-9 of the value, and none from there to 1.
    let rule = scheme("butterfly", &[("w", ratio(1, 16))]);
    for (n, value) in [(9, 497_294_073), (10, 506_675_611), (14, 501_978_319)] {
        let m = local(&rule, n, 2).matrix;
        let factors = secant::poly::factor(&char_poly(&m));
        let billion = |k: i64| ratio(k, 1_000_000_000);
        let (low, high) = (billion(value - 1), billion(value + 1));
        let signs = |p: &secant::poly::Poly, a: &Rational, b: &Rational| (p.eval(a) > 0) != (p.eval(b) > 0);
        let found: Vec<usize> = factors.iter().filter(|(p, _)| signs(p, &low, &high)).map(|(_, k)| *k).collect();
        assert_eq!(found.len(), 1, "n = {n}");
        assert!(found[0].is_multiple_of(2), "n = {n}: {found:?}");
        assert!(factors.iter().all(|(p, _)| p.degree() == Some(1) || !signs(p, &high, &ratio(1, 1))), "n = {n}");
    }
}

fn own(text: &str) -> secant::case::VertexCase {
    secant::case::VertexCase::parse("own.toml", text).unwrap_or_else(|e| panic!("{e:?}"))
}

fn own_case(name: &str) -> secant::case::VertexCase {
    let path =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/surfaces").join(name).with_extension("toml");
    secant::case::VertexCase::read(&path).unwrap_or_else(|e| panic!("{name}: {e:?}"))
}

/// Catmull and Clark's rule written as stencils has the matrices of the named one, at regular and other valences.
#[test]
fn stencils_give_the_matrices_of_named_rules() {
    let quads = own("name = \"a\"\n[vertex]\nmesh = \"own\"\nsplit = \"quads\"\n[vertex.stencil]\n\
         vertex = { vertex = \"9/16\", neighbours = \"3/32\", opposite = \"1/64\" }\n\
         edge = { ends = \"3/8\", sides = \"1/16\" }\nface = { corners = \"1/4\" }\n[vertex.centre]\n\
         vertex = { vertex = \"1 - 7/(4*n)\", neighbours = \"3/(2*n^2)\", opposite = \"1/(4*n^2)\" }\n");
    let triangles = own("name = \"a\"\n[vertex]\nmesh = \"own\"\nsplit = \"triangles\"\n[vertex.stencil]\n\
         vertex = { vertex = 1 }\nedge = { ends = \"1/2\", sides = \"1/8\", wings = \"-1/16\" }\n\
         [vertex.centre]\nedge = { vertex = \"1/2\", \"neighbours@0\" = \"1/2\", \"neighbours@1\" = \"1/8\", \
         \"neighbours@-1\" = \"1/8\", \"neighbours@2\" = \"-1/16\", \"neighbours@-2\" = \"-1/16\", \"1,1@0\" = \"-1/16\", \
         \"1,1@-1\" = \"-1/16\" }\n");
    let turned = own("name = \"a\"\n[vertex]\nmesh = \"own\"\nsplit = \"turned-quads\"\n[vertex.stencil]\n\
         vertex = { vertex = \"1/2\", neighbours = \"1/8\" }\nface = { corners = \"1/4\" }\n\
         [vertex.centre]\nvertex = { vertex = \"1/2\", neighbours = \"1/(2*n)\" }\n");
    for (case, name) in [(quads, "catmull-clark"), (triangles, "butterfly"), (turned, "four-eight")] {
        let rule = scheme(name, &[]);
        for n in [3, 4, 5, 6, 7] {
            assert_eq!(local(&case.rule, n, 2).matrix, local(&rule, n, 2).matrix, "{name} at {n}");
        }
    }
}

/// Irrational weights: Zorin's on spokes, and Loop's own, have the characteristic polynomials of the named rules.
#[test]
fn formulas_give_the_blocks_of_named_rules() {
    use secant::vertex::at_valence;
    let zorin =
        own("name = \"a\"\n[vertex]\nmesh = \"own\"\nsplit = \"triangles\"\nvalence = \"5,7\"\n[vertex.stencil]\n\
         vertex = { vertex = 1 }\nedge = { ends = \"1/2\", sides = \"1/8\", wings = \"-1/16\" }\n\
         [vertex.centre]\nedge = { vertex = \"3/4\", neighbours = \"(1/4 + cos(2*pi*k/n) + cos(4*pi*k/n)/2)/n\" }\n");
    let pairs = [(zorin, "butterfly-modified", vec![5, 7]), (own_case("loop-formula"), "loop", vec![5, 8, 9])];
    for (case, name, valences) in pairs {
        for n in valences {
            let (found, named) = (at_valence(&case.rule, n).unwrap(), at_valence(&scheme(name, &[]), n).unwrap());
            assert_eq!((found.smooth, found.winding), (named.smooth, named.winding), "{name} at {n}");
            let (a, b) = (found.top.unwrap().enclosure, named.top.unwrap().enclosure);
            assert!(a.lo <= b.hi && b.lo <= a.hi, "{name} at {n}");
            let (x, y) = (found.eigenvector.map(|v| v.points), named.eigenvector.map(|v| v.points));
            let far = |x: &Rational, y: &Rational| (x - y) * (x - y) > ratio(1, 1 << 60);
            if let (Some(x), Some(y)) = (x, y) {
                assert!(x.iter().zip(&y).all(|(p, q)| !far(&p.1.0, &q.1.0) && !far(&p.1.1, &q.1.1)), "{name} at {n}");
            }
        }
    }
}

/// Kobbelt's scheme by rows and columns of new points, in floating point by a script.
#[test]
fn kobbelts_eigenvalues_are_those_of_rows_and_columns() {
    use secant::vertex::block::Vertex;
    let case = own_case("own-kobbelt");
    for (n, expected) in
        [(3, 0.426_330_909), (5, 0.537_943_860), (6, 0.559_684_520), (7, 0.573_197_038), (8, 0.582_134_302)]
    {
        let vertex = Vertex::examined(&case.rule, n).unwrap();
        let block = vertex.block(1).unwrap();
        let t = 2.0 * (std::f64::consts::TAU / n as f64).cos();
        let at = |p: &secant::poly::Poly| p.coeffs().iter().rev().fold(0.0, |v, c| v * t + secant::arith::to_f64(c));
        let value = |x: f64| {
            let parts = block.parts.iter().map(|p| p.poly.iter().rev().fold(0.0, |v, c| v * x + at(c)));
            parts.fold(f64::INFINITY, |m: f64, v| if v.abs() < m.abs() { v } else { m })
        };
        assert!(value(expected - 1e-7) * value(expected + 1e-7) < 0.0, "valence {n}");
    }
}

#[test]
fn stencils_are_checked() {
    let refused = |text: &str| {
        let head = "name = \"a\"\n[vertex]\nmesh = \"own\"\nvalence = 5\n";
        let error = secant::case::VertexCase::parse("own.toml", &format!("{head}{text}"));
        error.err().map(|p| p.to_string()).unwrap_or_default()
    };
    let stencil = "split = \"triangles\"\n[vertex.stencil]\nvertex = { vertex = 1 }\nedge = { ends = \"1/2\" }\n";
    for (text, said) in [
        ("split = \"hexagons\"\n", "no such way"),
        ("split = \"triangles\"\n[vertex.stencil]\nvertex = { vertex = 1 }\n", "edge"),
        (
            "split = \"triangles\"\n[vertex.stencil]\nvertex = { vertex = 1 }\nedge = { ends = \"1/2\", tips = 0 }\n",
            "`tips`",
        ),
        (
            "split = \"triangles\"\n[vertex.stencil]\nvertex = { vertex = 1 }\nedge = { ends = \"1/2\", \"1,0\" = 0 }\n",
            "two weights",
        ),
        (&format!("{stencil}[vertex.centre]\nedge = {{ vertex = \"1/2\" }}\n"), "add up to 1/2"),
        (&format!("{stencil}[vertex.centre]\nedge = {{ vertex = \"cos(pi/7)\" }}\n"), "field"),
        (&format!("{stencil}[vertex.centre]\nvertex = {{ \"neighbours@0\" = 1 }}\n"), "not symmetric"),
    ] {
        assert!(refused(text).contains(said), "{text}: {}", refused(text));
    }
    // A stencil that reaches around the centre, and none for it.
    let wide = own(
        "name = \"a\"\n[vertex]\nmesh = \"own\"\nsplit = \"triangles\"\nvalence = 5\n[vertex.stencil]\nvertex = { vertex = 1 }\n\
         edge = { ends = \"9/16\", beyond = \"-1/16\" }\n",
    );
    let error = secant::vertex::at_valence(&wide.rule, 5).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(error.contains("reaches around the centre"), "{error}");
    assert!(secant::vertex::block::Vertex::new(&wide.rule, 6, 4).is_ok());
}
