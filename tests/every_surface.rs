//! Every point of a surface: proved, refuted with a witness, or open, and certificates that the checker proves again.

use secant::answer::Answer;
use secant::budget::Budget;
use secant::case::{Case, Question};
use secant::certificate::confirm;
use secant::prove::prove;
use secant::theorem::surface::{EverySurfaceBreak, EverySurfaceProof, Surface, certify_complex};
use secant::theorem::{Assertion, Certified, EverySurfaceGap, Kind, Required, Statement, Verdict};
use serde_json::{Value, json};
use std::sync::Arc;

fn parse(text: &str) -> Case {
    Case::parse("every.toml", &format!("name = \"every\"\nsource = \"test\"\n{text}\n")).unwrap()
}

fn product(first: &str, second: &str, more: &str) -> Case {
    parse(&format!("{more}\n[scheme]\ntensor = [{{ {first} }}, {{ {second} }}]"))
}

fn corners(a: &str, b: &str) -> String {
    format!("name = \"corner-cutting\", a = \"{a}\", b = \"{b}\"")
}

fn square(a: &str, b: &str) -> Case {
    product(&corners(a, b), &corners(a, b), "")
}

fn file(name: &str) -> Case {
    Case::read(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name)).unwrap()
}

fn found(case: &Case) -> Certified {
    certify_complex(&case.complex(), &case.examine).unwrap()
}

fn surface(found: &Certified) -> &Surface {
    found.surface.as_ref().expect("a surface")
}

fn verdict(case: &Case) -> Verdict {
    let found = found(case);
    let claim = found.claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).expect("a claim on every point");
    assert_eq!(claim.verdict(), surface(&found).every.verdict());
    assert_eq!(Required::parse("g1").unwrap().verdict(&found.claims), claim.verdict());
    claim.verdict()
}

#[test]
fn products_of_smooth_curves_are_smooth_everywhere() {
    // The last one has a Jordan block at the joint of its curves (Theorem 6′): rates do not matter.
    for (a, b) in [("3/10", "1/4"), ("1/4", "1/4"), ("1/5", "3/10"), ("1/10", "1/5"), ("1/5", "2/5")] {
        let case = square(a, b);
        let found = found(&case);
        assert!(matches!(surface(&found).every, Answer::Proved(EverySurfaceProof::Product(_))), "({a}, {b})");
        let claim = found.claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).unwrap();
        assert_eq!(claim.statement(), Some(Statement::TensorEveryPoint));
    }
    // Of two different curves, one of them in three pieces.
    let three = "name = \"bspline\", degree = 2, arity = 3";
    assert_eq!(verdict(&product(&corners("3/10", "1/4"), three, "")), Verdict::Proved);
}

#[test]
fn a_corner_or_a_cusp_of_a_curve_refutes_the_product() {
    // (2/5, 1/4) has strictly invariant cones and a corner between its pieces; (−1/4, 1/2) has a cusp there.
    for (a, b, kind) in [("2/5", "1/4", Kind::Corner), ("-1/4", "1/2", Kind::Cusp)] {
        let found = found(&product(&corners("1/4", "1/4"), &corners(a, b), ""));
        let Answer::Refuted(EverySurfaceBreak::Curve { curves, curve: 1, point }) = &surface(&found).every else {
            panic!("({a}, {b}) is refuted by its second curve")
        };
        assert_eq!(curves[1].points[*point].kind, kind);
    }
    // What decides by default are the tangents that were examined.
    assert_eq!(Required::default().verdict(&found(&square("3/10", "1/4")).claims), Verdict::Proved);
}

#[test]
fn what_is_not_decided_says_why() {
    // Takagi–Landsberg with factor 1/3 has kinks, and a Koch curve has no tangents at all.
    assert_eq!(verdict(&product("name = \"takagi\", alpha = \"1/3\"", &corners("1/4", "1/4"), "")), Verdict::Refuted);
    let fold = "control = [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]]";
    let flat = found(&product(&corners("3/10", "1/4"), &corners("3/10", "1/4"), fold));
    // No product is seen injectively in the plane; cones around the plane decide.
    assert_eq!(surface(&flat).every.verdict(), Verdict::Proved);
    let fold = fold.replace("[2, 0]", "[0, 0]").replace("[2, 1]", "[0, 1]").replace("[2, 2]", "[0, 2]");
    let folded = found(&product(&corners("3/10", "1/4"), &corners("3/10", "1/4"), &fold));
    assert_ne!(surface(&folded).every.verdict(), Verdict::Proved);
}

#[test]
fn discs_around_a_vertex_are_open() {
    for text in ["mesh = \"catmull-clark\"\nvalence = 5", "mesh = \"doo-sabin-frequency\"\nfrequency = 2\nvalence = 6"]
    {
        let case = parse(&format!("[scheme]\n{text}\ncell = \"disc\""));
        let found = found(&case);
        assert_ne!(surface(&found).every.verdict(), Verdict::Proved, "{text}");
    }
}

/// What is found of a case of a mesh rule with all that is known of its vertex.
fn around(text: &str) -> (Verdict, Option<Statement>) {
    let case = parse(&format!("[scheme]\n{text}"));
    let question = Question::Tangents { case: Arc::new(case), further: Vec::new() };
    let findings = prove(&question, &Budget::default()).unwrap();
    let claims = findings.claims();
    let claim = claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).expect("a claim on every point");
    (claim.verdict(), claim.statement())
}

#[test]
fn discs_and_patches_at_a_vertex_are_smooth_everywhere_by_their_characteristic_maps() {
    let by = Some(Statement::VertexEveryPoint);
    for (mesh, valence, cell) in [
        ("catmull-clark", 5, "disc"),
        ("catmull-clark", 5, "face"),
        ("catmull-clark", 3, "disc"),
        ("loop-warren", 7, "disc"),
        ("doo-sabin", 6, "disc"),
    ] {
        let text = format!("mesh = \"{mesh}\"\nvalence = {valence}\ncell = \"{cell}\"");
        assert_eq!(around(&text), (Verdict::Proved, by), "{text}");
    }
    // Regular patches have their own proof, with a certificate.
    assert_eq!(around("mesh = \"loop\"\nvalence = 6").1, Some(Statement::PatchDerivative));
    assert_eq!(around("mesh = \"loop\"\nvalence = 6\ncell = \"disc\""), (Verdict::Proved, by));
}

#[test]
fn discs_whose_characteristic_map_is_not_injective_are_not_proved() {
    let twice = "mesh = \"doo-sabin-frequency\"\nfrequency = 2\nvalence = 6";
    assert_ne!(around(&format!("{twice}\ncell = \"disc\"")).0, Verdict::Proved);
}

#[test]
#[allow(clippy::float_arithmetic, reason = "points of an example")]
fn discs_that_are_seen_folded_are_open_and_others_have_their_checked_part() {
    let text = "[scheme]\nmesh = \"catmull-clark\"\nvalence = 5\ncell = \"disc\"";
    let line: Vec<String> = (0..31).map(|k| format!("[{k}, {}]", k * k)).collect();
    let verdict = |case: Case| {
        let question = Question::Tangents { case: Arc::new(case), further: Vec::new() };
        let mut findings = prove(&question, &Budget::default()).unwrap();
        let claims = findings.claims();
        let claim = claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).unwrap().verdict();
        (claim, secant::prove::confirm(&mut findings).map(|c| c.json()["proof"]["every"].clone()))
    };
    assert_ne!(verdict(parse(&format!("control = [{}]\n{text}", line.join(", ")))).0, Verdict::Proved);
    // These points lie on a cone, almost.
    let ring = |count: usize, r: f64, k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        format!("[{}, {}, {}]", (r * angle.cos()).round(), (r * angle.sin()).round(), k % 2)
    };
    let inner = (0..10).map(|k| ring(10, 20.0, k));
    let round: Vec<String> =
        std::iter::once("[0, 0, 9]".to_owned()).chain(inner).chain((0..20).map(|k| ring(20, 40.0, k))).collect();
    assert_eq!(verdict(parse(&format!("control = [{}]\n{text}", round.join(", ")))).0, Verdict::Proved);
    // The certificate of the point (0) stands, and says nothing of every point.
    let (claim, every) = verdict(parse(text));
    assert_eq!((claim, every.unwrap()), (Verdict::Proved, Value::Null));
}

#[test]
fn masks_in_two_variables_are_patches() {
    let mask = |symbol: &str| parse(&format!("[mask]\nsymbol = \"{symbol}\""));
    // The product of two curves and the mask have the same operators.
    let curve = "name = \"bspline\", degree = 2";
    let (patch, by_curves) = (mask("(1+x)^3*(1+y)^3/16").complex(), product(curve, curve, "").complex());
    let operators = |c: &secant::shape::Complex| {
        let state = &c.shape.states[c.shape.start];
        state.pieces.iter().map(|p| p.op.clone()).collect::<Vec<_>>()
    };
    assert_eq!(operators(&patch), operators(&by_curves));
    // Loop's box spline, seen from the square, and the Zwart–Powell element, which has creases of its second derivatives only.
    for symbol in ["(1+x)^2*(1+y)^2*(1+x*y)^2/16", "(1+x)*(1+y)*(1+x*y)*(1+x/y)/4", "(1+x)^2*(1+y)^2/4"] {
        let case = mask(symbol);
        assert_eq!(verdict(&case), Verdict::Proved, "{symbol}");
        assert_eq!(says(&forged(&case, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved), "{symbol}");
    }
    // Two triangles meet in a crease along the diagonal.
    assert_eq!(verdict(&mask("(1+x)*(1+y)*(1+x*y)/2")), Verdict::Refuted);
    // The same as a graph over the plane.
    let points: Vec<String> = (0..4).map(|k| format!("[{}, {}, {}]", k / 2, k % 2, u8::from(k == 3))).collect();
    let graph = format!("control = [{}]\n[mask]\nsymbol = \"(1+x)^2*(1+y)^2/4\"", points.join(", "));
    assert_eq!(verdict(&parse(&graph)), Verdict::Proved);
    let text = "name = \"a\"\n[mask]\nsymbol = \"(1+x)^2*(1+y)^2/8\"\ndilation = \"quincunx\"\n";
    let problem = Case::parse("a.toml", text).unwrap_err();
    assert!(problem.message().contains("multiple of the unit matrix"), "{}", problem.message());
}

/// What the checker says of a certificate that was changed.
fn forged(case: &Case, change: &dyn Fn(&mut Value)) -> Result<secant_check::Accepted, secant_check::Rejected> {
    let mut value = confirm(case, &found(case)).unwrap().json().clone();
    change(&mut value["proof"]);
    secant_check::check(&case.checked_text(), &value.to_string())
}

fn says(accepted: &secant_check::Accepted) -> Option<secant_check::Verdict> {
    accepted.claims.iter().find(|d| d.claim == secant_check::Claim::PlaneTurns).map(|d| d.verdict)
}

#[test]
fn certificates_of_products_are_proved_again_and_forgeries_are_not() {
    let (smooth, broken) = (square("3/10", "1/4"), square("2/5", "1/4"));
    assert_eq!(says(&forged(&smooth, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved));
    assert_eq!(says(&forged(&broken, &|_| ()).unwrap()), Some(secant_check::Verdict::Refuted));
    let refused = |case: &Case, change: &dyn Fn(&mut Value)| assert!(forged(case, change).is_err());
    refused(&smooth, &|p| p["every"]["verdict"] = json!("refuted"));
    refused(&smooth, &|p| p["every"]["curves"][1] = Value::Null);
    refused(&smooth, &|p| p["every"]["curves"] = json!([]));
    refused(&smooth, &|p| p["every"]["by"] = json!("point"));
    refused(&smooth, &|p| p["every"] = json!({"by": "point", "verdict": "refuted", "point": 0}));
    refused(&smooth, &|p| p["every"]["curves"][0]["joints"] = json!([]));
    refused(&smooth, &|p| p["every"]["curves"][0]["maps"][0][0][0][0] = json!("7"));
    refused(&smooth, &|p| p["product"] = Value::Null);
    refused(&broken, &|p| p["every"]["verdict"] = json!("proved"));
    refused(&broken, &|p| p["every"]["curves"][0]["witness"] = json!([0]));
    refused(&broken, &|p| p["every"]["curves"][0] = Value::Null);
    // Without the answer nothing is said of every point, and the rest stands.
    let without = forged(&smooth, &|p| drop(p.as_object_mut().unwrap().remove("every"))).unwrap();
    assert_eq!(says(&without), None);
    // The certificate of one product proves nothing of another one.
    let certificate = confirm(&smooth, &found(&smooth)).unwrap().json().to_string();
    assert!(secant_check::check(&broken.checked_text(), &certificate).is_err());
}

#[test]
fn a_point_without_a_tangent_plane_refutes_with_a_certificate() {
    let case = file("surfaces/collapsed-line.toml");
    let found = found(&case);
    assert!(matches!(surface(&found).every, Answer::Refuted(EverySurfaceBreak::Point(_))));
    assert_eq!(says(&forged(&case, &|_| ()).unwrap()), Some(secant_check::Verdict::Refuted));
    assert!(forged(&case, &|p| p["every"]["point"] = json!(99)).is_err());
    assert!(forged(&case, &|p| p["every"]["verdict"] = json!("proved")).is_err());
}

#[test]
fn patches_with_a_derivative_of_rank_2_are_smooth_everywhere() {
    let loops = parse("[scheme]\nmesh = \"loop\"\nvalence = 6");
    let quads = parse("[scheme]\nmesh = \"catmull-clark\"\nvalence = 4");
    let files = ["surfaces/bicubic-space.toml", "surfaces/biquadratic-space.toml", "faces/bicubic.toml"];
    for case in files.map(file).iter().chain([&loops, &quads, &bumpy()]) {
        let found = found(case);
        match &surface(&found).every {
            Answer::Proved(EverySurfaceProof::Derivative(d)) => {
                assert!(d.enclosure.hi < d.share && d.edges > 0);
                assert!(d.cells.is_none() || case.shape.control.is_some());
            }
            // A product of curves is decided by these first.
            Answer::Proved(EverySurfaceProof::Product(_)) => assert!(case.shape.control.is_none()),
            other => panic!("{}: {other:?}", case.name),
        }
        assert_eq!(verdict(case), Verdict::Proved);
        assert_eq!(says(&forged(case, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved), "{}", case.name);
    }
}

/// A biquadratic patch on points that are no even grid.
fn bumpy() -> Case {
    let point = |k: i64| {
        let (i, j) = (k / 3, k % 3);
        format!("[{}, {}, {}]", 4 * i + i64::from(k == 4), 4 * j - i64::from(k == 5), i * j + i64::from(k == 0))
    };
    let points: Vec<String> = (0..9).map(point).collect();
    let spline = "name = \"bspline\", degree = 2";
    product(spline, spline, &format!("control = [{}]", points.join(", ")))
}

#[test]
fn a_fold_of_the_control_points_is_not_proved() {
    let spline = "name = \"bspline\", degree = 2";
    let fold = |x: [i64; 3]| {
        let points: Vec<String> = (0..9).map(|k| format!("[{}, {}]", x[k / 3], k % 3)).collect();
        product(spline, spline, &format!("control = [{}]", points.join(", ")))
    };
    assert_eq!(verdict(&fold([0, 1, 2])), Verdict::Proved);
    assert_ne!(verdict(&fold([0, 1, 0])), Verdict::Proved);
    assert_ne!(verdict(&fold([0, 1, 1])), Verdict::Proved, "the derivative is 0 at one side");
}

fn rows(m: &[Vec<String>]) -> String {
    let row = |r: &Vec<String>| format!("[{}]", r.iter().map(|x| format!("\"{x}\"")).collect::<Vec<_>>().join(", "));
    format!("[{}]", m.iter().map(row).collect::<Vec<_>>().join(", "))
}

/// De Casteljau's halves of a quadratic curve, in quarters; columns are the new points.
const HALVES: [[[i64; 3]; 3]; 2] = [[[4, 2, 1], [0, 2, 2], [0, 0, 1]], [[1, 0, 0], [2, 2, 0], [1, 2, 4]]];

/// A face of 2 x 2 biquadratic patches that meet along their edges, with the heights of 25 control points over a plane grid.
fn four_patches(height: &dyn Fn(usize, usize) -> i64) -> Case {
    let mut text = String::from("convention = \"columns\"\nstart = \"X\"\n");
    let points: Vec<String> = (0..25).map(|k| format!("[{}, {}, {}]", k % 5, k / 5, height(k % 5, k / 5))).collect();
    text += &format!("control = [{}]\n", points.join(", "));
    let side =
        |of: [usize; 2], n: usize| (0..n).map(|k| (of[0] + k * of[1]).to_string()).collect::<Vec<_>>().join(", ");
    let face = |name: &str, n: usize, edge: &str| {
        let sides = [("bottom", [0, 1]), ("right", [n - 1, n]), ("top", [n * (n - 1), 1]), ("left", [0, n])];
        let sides: Vec<String> =
            sides.map(|(s, of)| format!("{s} = {{ edge = \"{edge}\", points = [{}] }}\n", side(of, n))).into();
        format!(
            "[[state]]\nname = \"{name}\"\nkind = \"face\"\ndimension = {}\nlayout = \"2x2\"\n{}",
            n * n,
            sides.join("")
        )
    };
    let piece = |to: &str, m: Vec<Vec<String>>| format!("[[state.piece]]\nto = \"{to}\"\nmatrix = {}\n", rows(&m));
    let quarter = |x: i64, d: i64| format!("{x}/{d}");
    text += &face("X", 5, "L");
    for k in 0..4 {
        let at = |c: usize| (2 * (k / 2) + c / 3) * 5 + 2 * (k % 2) + c % 3;
        text += &piece("R", (0..25).map(|r| (0..9).map(|c| quarter(i64::from(at(c) == r), 1)).collect()).collect());
    }
    text += &face("R", 3, "q");
    for k in 0..4 {
        let (u, v) = (HALVES[k % 2], HALVES[k / 2]);
        let entry = |r: usize, c: usize| quarter(u[r % 3][c % 3] * v[r / 3][c / 3], 16);
        text += &piece("R", (0..9).map(|r| (0..9).map(|c| entry(r, c)).collect()).collect());
    }
    text += "[[state]]\nname = \"L\"\nkind = \"edge\"\ndimension = 5\n";
    for k in 0..2 {
        text += &piece("q", (0..5).map(|r| (0..3).map(|c| quarter(i64::from(2 * k + c == r), 1)).collect()).collect());
    }
    text += "[[state]]\nname = \"q\"\nkind = \"edge\"\ndimension = 3\n";
    for half in HALVES {
        text += &piece("q", half.iter().map(|r| r.iter().map(|x| quarter(*x, 4)).collect()).collect());
    }
    parse(&text)
}

#[test]
fn two_smooth_patches_that_meet_in_a_crease_are_not_proved() {
    // One plane in four patches, and a paraboloid.
    assert_eq!(verdict(&four_patches(&|x, y| (x + 2 * y) as i64)), Verdict::Proved);
    assert_eq!(verdict(&four_patches(&|x, y| [4, 0, 0, 0, 4][x] + [4, 0, 0, 0, 4][y])), Verdict::Proved);
    // A roof: the middle line is a crease.
    assert_eq!(verdict(&four_patches(&|x, _| [0, 1, 2, 1, 0][x])), Verdict::Refuted);
    // (u − 1/2)⁺ b(v): a crease along u = 1/2 that vanishes at the vertices of the first level.
    let hidden = four_patches(&|x, y| [0, 0, 0, 2, 4][x] * [0, 1, 0, -1, 0][y]);
    let found = found(&hidden);
    let Answer::Open(gaps) = &surface(&found).every else { panic!("{:?}", surface(&found).every) };
    let state = hidden.shape.start;
    assert!(gaps.contains(&EverySurfaceGap::Edge { state, letters: [0, 1] }), "{gaps:?}");
}

#[test]
fn forged_derivatives_are_rejected() {
    let case = bumpy();
    match &surface(&found(&case)).every {
        Answer::Proved(EverySurfaceProof::Derivative(d)) => assert!(d.cells.as_ref().is_some_and(|c| c.1.len() > 1)),
        other => panic!("{other:?}"),
    }
    let no_cells = file("surfaces/bicubic-space.toml");
    assert!(forged(&no_cells, &|p| p["every"]["cells"] = json!([[]])).is_err());
    let refused = |change: &dyn Fn(&mut Value)| assert!(forged(&case, &|p| change(&mut p["every"])).is_err());
    assert!(forged(&case, &|_| ()).is_ok());
    refused(&|e| e["radius"] = Value::Null);
    refused(&|e| e["radius"]["upper"] = json!("1/100"));
    refused(&|e| e["verdict"] = json!("refuted"));
    refused(&|e| e["length"] = json!(0));
    refused(&|e| drop(e["cells"].as_array_mut().unwrap().pop()));
    refused(&|e| e["cells"] = json!([]));
    refused(&|e| e["cells"] = Value::Null);
    // The certificate of a plane in four patches, about the same patches with creases.
    let plane = |x: usize, y: usize| (x + 2 * y) as i64;
    let flat = four_patches(&plane);
    let certificate = confirm(&flat, &found(&flat)).unwrap().json().clone();
    let every = certificate["proof"]["every"].clone();
    assert_eq!(every["by"], "derivative");
    let hidden = four_patches(&|x, y| [0, 0, 0, 2, 4][x] * [0, 1, 0, -1, 0][y]);
    let mut own = confirm(&hidden, &found(&hidden)).unwrap().json().clone();
    let proof = own["proof"].as_object_mut().unwrap();
    let answers = proof.remove("answers").unwrap();
    proof.insert("every".to_owned(), every);
    proof.insert("answers".to_owned(), answers);
    assert!(secant_check::check(&hidden.checked_text(), &own.to_string()).is_err());
}

/// A bilinear patch, and one in three parts along each side, of which there are many words.
#[test]
fn patches_of_few_and_of_many_words() {
    let hat = "mask = [\"1/2\", 1, \"1/2\"]";
    let three = "name = \"bspline\", degree = 2, arity = 3";
    let grid = |n: i64, bump: i64| {
        let point = |k: i64| format!("[{}, {}, {}]", 5 * (k / n) + bump * (k % 2), 5 * (k % n), (k / n) * (k % n));
        format!("control = [{}]", (0..n * n).map(point).collect::<Vec<_>>().join(", "))
    };
    assert_eq!(verdict(&product(hat, hat, &grid(2, 1))), Verdict::Proved);
    assert_eq!(verdict(&product(three, three, &grid(3, 1))), Verdict::Proved);
}
