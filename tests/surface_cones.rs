//! Cones around planes (Theorem 16): patches that no other statement decides, certificates, and what must not be proved.
#![allow(clippy::float_arithmetic, reason = "normals of samples")]

use secant::answer::Answer;
use secant::arith::to_f64;
use secant::case::Case;
use secant::certificate::confirm;
use secant::theorem::surface::{EverySurfaceProof, SurfaceForms, certify_complex};
use secant::theorem::{Assertion, Certified, EverySurfaceGap, Statement};
use serde_json::{Value, json};

/// A mask in two variables that is no product: curves with weights (a, b) times themselves, bent a little.
fn bent(a: &str, b: &str, more: &str) -> Case {
    let factor = |x: &str| format!("(1+{x})*({a}+(1-{a}-{b})*{x}+{b}*{x}^2)");
    let symbol = format!("{}*{}+1/50*(1-x^2)*(1-y^2)", factor("x"), factor("y"));
    let text = format!("name = \"bent\"\nsource = \"test\"\n{more}\n[mask]\nsymbol = \"{symbol}\"\n");
    Case::parse("bent.toml", &text).unwrap()
}

fn control(points: impl Fn(i64, i64) -> [i64; 3]) -> String {
    let point = |k: i64| format!("{:?}", points(k / 3, k % 3));
    format!("control = [{}]", (0..9).map(point).collect::<Vec<_>>().join(", "))
}

fn found(case: &Case) -> Certified {
    certify_complex(&case.complex(), &case.examine).unwrap()
}

fn cones(found: &Certified) -> Option<&SurfaceForms> {
    match &found.surface.as_ref()?.every {
        Answer::Proved(EverySurfaceProof::Forms(forms)) => Some(forms),
        _ => None,
    }
}

fn gaps(found: &Certified) -> Vec<EverySurfaceGap> {
    match &found.surface.as_ref().unwrap().every {
        Answer::Open(gaps) => gaps.clone(),
        other => panic!("{other:?}"),
    }
}

/// The largest angle between normals of neighbours among the cells of a level, in degrees, of the control points in space.
fn turning(case: &Case, level: usize) -> f64 {
    let shape = &case.shape;
    let state = &shape.states[shape.start];
    let base = secant::shape::Spaces::new(shape).unwrap().of(shape.start).base.clone();
    let float = |m: &secant::linalg::Matrix| -> Vec<Vec<f64>> {
        (0..m.rows()).map(|i| m.row(i).iter().map(to_f64).collect()).collect()
    };
    let times = |a: &[Vec<f64>], b: &[Vec<f64>]| -> Vec<Vec<f64>> {
        a.iter().map(|r| (0..b[0].len()).map(|j| r.iter().zip(b).map(|(x, y)| x * y[j]).sum()).collect()).collect()
    };
    let side = 1 << level;
    let mut points = vec![[0.0; 3]; side * side];
    let mut open = vec![(float(shape.control.as_ref().unwrap()), 0, 0, 0)];
    let pieces: Vec<_> = state.pieces.iter().map(|p| float(&p.op)).collect();
    while let Some((map, i, j, depth)) = open.pop() {
        if depth == level {
            points[j * side + i] = std::array::from_fn(|k| map[k].iter().zip(&base).map(|(x, y)| x * to_f64(y)).sum());
            continue;
        }
        for (letter, op) in pieces.iter().enumerate() {
            open.push((times(&map, op), 2 * i + letter % 2, 2 * j + letter / 2, depth + 1));
        }
    }
    let normal = |i: usize, j: usize| {
        let at = |i: usize, j: usize| points[j * side + i];
        let d = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
        let (u, v) = (d(at(i + 1, j), at(i, j)), d(at(i, j + 1), at(i, j)));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
        n.map(|x| x / length)
    };
    let mut most = 0.0_f64;
    for i in 0..side - 2 {
        for j in 0..side - 2 {
            for (k, l) in [(i + 1, j), (i, j + 1)] {
                let cosine: f64 =
                    normal(i, j).iter().zip(normal(k.min(side - 2), l.min(side - 2))).map(|(x, y)| x * y).sum();
                most = most.max(cosine.min(1.0).acos().to_degrees());
            }
        }
    }
    most
}

#[test]
fn a_patch_that_is_no_product_and_not_smooth_in_its_parameters_has_cones_around_planes() {
    let case = bent("3/10", "1/4", "");
    let found = found(&case);
    let forms = cones(&found).expect("a proof by cones");
    assert_eq!((forms.stars.list.len(), forms.forms[1].rows(), forms.ratios[1].len()), (2, 15, 9));
    let claim = found.claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).unwrap();
    assert_eq!(claim.statement(), Some(Statement::SurfaceCones));
    assert_eq!(says(&forged(&case, &found, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved));
}

#[test]
fn control_points_are_looked_at_through_words_of_stars() {
    let bump = bent("3/10", "1/4", &control(|i, j| [4 * i + 3 * i64::from((i, j) == (1, 1)), 4 * j, 6 * i * j]));
    let smooth = found(&bump);
    assert_eq!(cones(&smooth).expect("a proof by cones").views, 1);
    assert_eq!(says(&forged(&bump, &smooth, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved));
    // The normals of neighbours come together; the cones shrink by 2/3 or so with each level.
    let angles = [4, 6].map(|level| turning(&bump, level));
    assert!(angles[1] < 0.6 * angles[0], "{angles:?}");
    let folded = bent("3/10", "1/4", &control(|i, j| [[0, 1, 0][i as usize], j, 0]));
    assert!(cones(&found(&folded)).is_none());
}

#[test]
fn corners_and_creases_have_no_forms() {
    // (2/5, 1/4): cells with good cones and a corner between them.
    let corner = found(&bent("2/5", "1/4", ""));
    assert!(cones(&corner).is_none());
    let points = control(|i, j| [4 * i, 4 * j, i * i + i64::from((i, j) == (1, 1))]);
    let seen = bent("2/5", "1/4", &points);
    assert!(cones(&found(&seen)).is_none());
    let angles = [4, 6].map(|level| turning(&seen, level));
    assert!(angles[1] > 0.6 * angles[0], "{angles:?}");
    // Two triangles in each square: a crease everywhere along the diagonal, with every growth equal.
    let text = "name = \"a\"\nsource = \"test\"\n[mask]\nsymbol = \"(1+x)*(1+y)*(1+x*y)/2\"\n";
    assert!(cones(&found(&Case::parse("a.toml", text).unwrap())).is_none());
    // Growth (1/5, 2/5) ties: the second and the third are equal.
    let tie = found(&bent("1/5", "2/5", ""));
    let star = vec![vec![0], vec![1], vec![2], vec![3]];
    assert!(cones(&tie).is_none() && gaps(&tie).contains(&EverySurfaceGap::NoForms { star }), "{:?}", gaps(&tie));
}

/// Copies of the first state of a case, a face, as the pieces of a set: by copy and point, the points of the set with their weights.
fn set_of(case: &Case, points: &[Vec<Vec<(usize, i64)>>]) -> Case {
    let face = &case.shape.states[0].name;
    let count = points.iter().flatten().flatten().map(|p| p.0).max().unwrap() + 1;
    let weight = |point: &[(usize, i64)], k: usize| point.iter().filter(|p| p.0 == k).map(|p| p.1).sum::<i64>();
    let piece = |own: &Vec<Vec<(usize, i64)>>| {
        let row = |k: usize| format!("{:?}", own.iter().map(|point| weight(point, k)).collect::<Vec<_>>());
        let rows: Vec<String> = (0..count).map(row).collect();
        format!("[[state.piece]]\nto = \"{face}\"\nmatrix = [{}]\n", rows.join(", "))
    };
    let pieces: String = points.iter().map(piece).collect();
    let start = format!("start = \"{face}\"");
    let text = case.expanded();
    assert!(text.contains(&start), "{text}");
    let text = text.replacen(&start, "start = \"all\"", 1);
    let set = format!("[[state]]\nname = \"all\"\nkind = \"set\"\ndimension = {count}\n{pieces}");
    Case::parse("set.toml", &format!("{text}\n{set}")).unwrap()
}

/// Points of copies of a face that are glued: numbers for all points of all copies, those that are paired made one.
fn joined(copies: usize, width: usize, pairs: &[[usize; 2]]) -> Vec<Vec<Vec<(usize, i64)>>> {
    let mut class: Vec<usize> = (0..copies * width).collect();
    for pair in pairs {
        let [x, y] = pair.map(|k| class[k]);
        class.iter_mut().filter(|c| **c == x.max(y)).for_each(|c| *c = x.min(y));
    }
    let mut known = class.clone();
    known.sort_unstable();
    known.dedup();
    let number = |k: usize| known.iter().position(|c| *c == class[k]).unwrap();
    (0..copies).map(|copy| (0..width).map(|i| vec![(number(copy * width + i), 1)]).collect()).collect()
}

/// The points of a side of the first state of a case.
fn side(case: &Case, side: usize) -> Vec<usize> {
    let op = &case.complex().faces[&0].sides[side].op;
    (0..op.cols()).map(|j| (0..op.rows()).find(|&i| op[(i, j)] != 0).unwrap()).collect()
}

/// Two copies of a face: the left side of the second one on the right side of the first one, or on its points from the left.
fn two(case: &Case, on_one_side: bool) -> Case {
    let (width, right, left) = (case.shape.states[0].dim, side(case, 1), side(case, 3));
    let there = if on_one_side { &left } else { &right };
    set_of(case, &joined(2, width, &there.iter().zip(&left).map(|(a, b)| [*a, width + b]).collect::<Vec<_>>()))
}

fn expanded_mesh(valence: usize) -> Case {
    let scheme = format!("[scheme]\nmesh = \"catmull-clark\"\nvalence = {valence}\n");
    Case::parse("patch.toml", &format!("name = \"patch\"\nsource = \"test\"\n{scheme}")).unwrap()
}

#[test]
fn a_bicubic_patch_at_a_vertex_has_stars_of_many_dimensions() {
    let patch = expanded_mesh(5);
    let at_vertex = found(&patch);
    let forms = cones(&at_vertex).expect("a proof by cones");
    assert_eq!(forms.forms.iter().skip(1).map(secant::linalg::Matrix::rows).collect::<Vec<_>>(), [17, 24]);
    // The checker accepts it, or there is none.
    let certificate = confirm(&patch, &at_vertex).unwrap();
    assert_eq!(certificate.json()["proof"]["every"]["by"], json!("cones"));
}

#[test]
fn faces_of_a_set_are_glued_along_sides() {
    let face = bent("3/10", "1/4", "");
    let pair = two(&face, false);
    let smooth = found(&pair);
    let forms = cones(&smooth).expect("a proof by cones");
    assert_eq!((forms.stars.seams(), forms.stars.list[0].cells.len(), forms.stars.list.len()), (1, 2, 2));
    assert_eq!(says(&forged(&pair, &smooth, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved));
    let refused = |change: &dyn Fn(&mut Value)| match forged(&pair, &smooth, change) {
        Ok(_) => panic!("a forgery is accepted"),
        Err(rejected) => rejected.rule,
    };
    // Not glued, glued at one corner, along another side, and turned.
    for nodes in [[4, 5, 6, 7], [1, 4, 5, 6], [4, 1, 2, 5], [2, 4, 5, 1]] {
        let rule = refused(&|e| e["stars"][0]["cells"][1]["corners"] = json!(nodes));
        assert!(["stars", "every"].contains(&rule.as_str()), "{nodes:?} {rule}");
    }
    refused(&|e| drop(e["stars"][0]["cells"].as_array_mut().unwrap().pop()));
    refused(&|e| e["stars"][0]["cells"].as_array_mut().unwrap().swap(0, 1));
    // The same face twice, folded over along its left side: two sheets on one another.
    assert!(cones(&found(&two(&face, true))).is_none());
}

#[test]
fn a_crease_between_two_patches_has_no_forms() {
    let text = "name = \"a\"\nsource = \"test\"\n[mask]\nsymbol = \"(1+x)^3*(1+y)^3/16\"\n";
    let face = Case::parse("a.toml", text).unwrap();
    assert!(cones(&found(&two(&face, false))).is_some());
    // The same border curve, the means of two lines of points, with a derivative of its own across it.
    let (left, right) = (side(&face, 3), side(&face, 1));
    let line = |own: &[usize], other: &[usize], both: bool| -> Vec<usize> {
        own.iter().copied().filter(|k| other.contains(k) == both).collect()
    };
    let (first, middle, last) = (line(&left, &right, false), line(&left, &right, true), line(&right, &left, false));
    let mut second = vec![Vec::new(); 9];
    for r in 0..3 {
        second[first[r]] = vec![(9 + r, 1)];
        second[middle[r]] = vec![(middle[r], 1), (last[r], 1), (9 + r, -1)];
        second[last[r]] = vec![(12 + r, 1)];
    }
    let crease = set_of(&face, &[(0..9).map(|k| vec![(k, 1)]).collect(), second]);
    let gaps = gaps(&found(&crease));
    assert!(matches!(&gaps[..], [EverySurfaceGap::NoForms { star }] if star.len() == 4), "{gaps:?}");
}

fn forged(
    case: &Case,
    found: &Certified,
    change: &dyn Fn(&mut Value),
) -> Result<secant_check::Accepted, secant_check::Rejected> {
    let mut value = confirm(case, found).unwrap().json().clone();
    change(&mut value["proof"]["every"]);
    secant_check::check(&case.checked_text(), &value.to_string())
}

fn says(accepted: &secant_check::Accepted) -> Option<secant_check::Verdict> {
    accepted.claims.iter().find(|d| d.claim == secant_check::Claim::PlaneTurns).map(|d| d.verdict)
}

#[test]
fn forged_cones_are_rejected() {
    let case = bent("3/10", "1/4", "");
    let found = found(&case);
    let refused = |rule: &str, change: &dyn Fn(&mut Value)| match forged(&case, &found, change) {
        Ok(_) => panic!("{rule} is accepted"),
        Err(rejected) => assert_eq!(rejected.rule, rule, "{}", rejected.why),
    };
    refused("stars", &|e| drop(e["stars"].as_array_mut().unwrap().pop()));
    // A child too few, one twice over another, and one whose cells stand in another order.
    refused("stars", &|e| drop(e["stars"][1]["children"].as_array_mut().unwrap().pop()));
    refused("stars", &|e| e["stars"][1]["children"][0]["cells"] = e["stars"][1]["children"][1]["cells"].clone());
    refused("stars", &|e| e["stars"][1]["children"][0]["cells"].as_array_mut().unwrap().swap(0, 1));
    refused("stars", &|e| e["stars"][1]["cells"][0]["corners"] = json!([0, 1, 2, 4]));
    refused("stars", &|e| e["stars"][0]["children"] = json!([]));
    refused("stars", &|e| e["stars"][1]["children"][0]["star"] = json!(0));
    refused("signature", &|e| {
        let form = e["stars"][1]["form"].as_array_mut().unwrap();
        let turned = |x: &Value| match x.as_str().unwrap() {
            "0" => json!("0"),
            text => json!(text.strip_prefix('-').map_or_else(|| format!("-{text}"), str::to_owned)),
        };
        form.iter_mut().for_each(|row| row.as_array_mut().unwrap().iter_mut().for_each(|x| *x = turned(x)));
    });
    refused("growth", &|e| e["stars"][1]["children"][3]["ratio"] = json!("1/2"));
    refused("growth", &|e| e["stars"][1]["children"][3]["ratio"] = json!("1/100"));
    refused("growth", &|e| e["stars"][1]["children"][3]["ratio"] = json!("-1/8"));
    refused("growth", &|e| e["stars"][1]["children"][3]["ratio"] = Value::Null);
    refused("growth", &|e| e["stars"][0]["children"][0]["ratio"] = json!("1/8"));
    // The cones of one mask prove nothing of another one.
    let certificate = confirm(&case, &found).unwrap().json().to_string();
    assert!(secant_check::check(&bent("2/5", "1/4", "").checked_text(), &certificate).is_err());
}
