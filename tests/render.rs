//! `secant render`, `secant expand`, `secant import`: files, the same bytes every time, points on the limit.

use assert_cmd::Command;
use secant::arith::{Rational, ratio};
use secant::case::Case;
use secant::scheme::{bezier, bspline};
use secant::shape::{Complex, sample};
use std::path::Path;

fn secant(args: &[&str], code: i32) -> (String, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = Command::cargo_bin("secant").unwrap().current_dir(root).args(args).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    assert_eq!(out.status.code(), Some(code), "{args:?}\n{}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

/// The cubic B-spline through its basis functions on one interval, in the order of `Mask::curve`.
fn cubic(t: &Rational) -> Vec<Rational> {
    let (one, six) = (ratio(1, 1), ratio(6, 1));
    let u = &one - t;
    let n = |k: i64| ratio(k, 1);
    let basis = [
        &u * &u * &u,
        n(3) * t * t * t - n(6) * t * t + n(4),
        n(-3) * t * t * t + n(3) * t * t + n(3) * t + n(1),
        t * t * t,
    ];
    basis.into_iter().map(|b| b / &six).collect()
}

#[test]
fn sampled_points_lie_on_the_limit() {
    let depth = 5;
    let curve = Complex::of_curves(bspline(3, 2).unwrap().curve().unwrap());
    let found = sample(&curve, depth, &mut |_| ()).unwrap();
    assert_eq!(found.points.len(), (1 << depth) + 1);
    for (point, t) in found.points.iter().zip(&found.parameters) {
        assert_eq!(point, &cubic(t), "t = {t}");
    }
    // De Casteljau's curve of degree 4 at the dyadic points of its own formula.
    let curve = Complex::of_curves(bezier(4, &ratio(1, 2)).unwrap());
    let found = sample(&curve, depth, &mut |_| ()).unwrap();
    for (point, t) in found.points.iter().zip(&found.parameters) {
        let u = ratio(1, 1) - t;
        let power = |x: &Rational, k: usize| (0..k).fold(ratio(1, 1), |p, _| p * x);
        let bernstein = |i: usize| ratio([1, 4, 6, 4, 1][i], 1) * power(t, i) * power(&u, 4 - i);
        assert_eq!(point, &(0..5).map(bernstein).collect::<Vec<_>>(), "t = {t}");
    }
}

#[test]
fn a_patch_is_a_closed_mesh_of_limit_points() {
    let case = Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/faces/bicubic.toml")).unwrap();
    let found = sample(&case.complex(), 3, &mut |_| ()).unwrap();
    assert_eq!((found.points.len(), found.faces.len()), (81, 64));
    for point in &found.points {
        // A point of the patch is a product of two points of the curve.
        let sums = |by_row: bool| -> Vec<Rational> {
            let index = |i: usize, j: usize| if by_row { 4 * i + j } else { 4 * j + i };
            (0..4).map(|i| (0..4).fold(ratio(0, 1), |s, j| s + &point[index(i, j)])).collect()
        };
        let (u, v) = (sums(true), sums(false));
        for i in 0..4 {
            for j in 0..4 {
                assert_eq!(point[4 * i + j], &u[i] * &v[j]);
            }
        }
    }
    let triangle = Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/faces/loop-triangle.toml")).unwrap();
    let found = sample(&triangle.complex(), 3, &mut |_| ()).unwrap();
    assert_eq!((found.points.len(), found.faces.len()), (45, 64));
    // All triangles run the same way: every inner edge is met once in each direction.
    let mut edges = std::collections::BTreeSet::new();
    for (c, _) in &found.faces {
        assert!((0..3).all(|k| edges.insert((c[k], c[(k + 1) % 3]))), "an edge is run through twice");
    }
}

#[test]
fn files_are_written_and_the_same_every_time() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    for (case, more) in [
        ("cases/thesis/half-tangent.toml", &["--depth", "6"][..]),
        ("cases/sets/sierpinski.toml", &["--chaos", "200", "--seed", "7"][..]),
        ("cases/faces/loop-triangle.toml", &["--depth", "2"][..]),
    ] {
        let mut twice = Vec::new();
        for run in ["a", "b"] {
            let [svg, png, obj, ply] = ["svg", "png", "obj", "ply"].map(|e| file(&format!("{run}.{e}")));
            let files = ["--svg", &svg, "--png", &png, "--obj", &obj, "--ply", &ply];
            let (out, _) = secant(&[&["render", case][..], &files[..], more].concat(), 0);
            assert!(out.contains("exact points"), "{out}");
            twice.push([svg, png, obj, ply].map(|f| std::fs::read(f).unwrap()));
        }
        assert_eq!(twice[0], twice[1], "{case}");
        assert!(twice[0][0].starts_with(b"<svg") && twice[0][1].starts_with(b"\x89PNG"));
        assert!(twice[0][3].starts_with(b"ply\nformat ascii"));
    }
    let (a, b) = (file("1.obj"), file("2.obj"));
    for (seed, path) in [("1", &a), ("2", &b)] {
        secant(&["render", "cases/sets/sierpinski.toml", "--chaos", "50", "--seed", seed, "--obj", path], 0);
    }
    assert_ne!(std::fs::read(a).unwrap(), std::fs::read(b).unwrap());
    let (_, err) = secant(&["render", "cases/sets/sierpinski.toml"], 2);
    assert!(err.contains("--output"), "{err}");
    let (_, err) = secant(&["render", "cases/sets/sierpinski.toml", "--depth", "60", "--svg", &file("x.svg")], 2);
    assert!(err.contains("--depth") && !dir.path().join("x.svg").exists(), "{err}");
}

#[test]
fn imports_state_their_convention_and_give_cases() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("two.ifs");
    let levy = "levy { .5 -.5 .5 .5 0 0 .5\n .5 .5 -.5 .5 .5 .5 .5 }\n";
    std::fs::write(&path, format!("{levy}tri {{ .5 0 0 .5 0 0\n .5 0 0 .5 .5 0\n .5 0 0 .5 0 .5 }}\n")).unwrap();
    let (_, err) = secant(&["import", path.to_str().unwrap()], 2);
    assert!(err.contains("levy, tri"), "{err}");
    let (out, _) = secant(&["import", path.to_str().unwrap(), "--entry", "tri"], 0);
    assert!(out.starts_with("# Convention: Fractint") && out.contains("[[map]]") && !out.contains("pieces"), "{out}");
    assert_eq!(Case::parse("t.toml", &out).unwrap().shape.states[0].pieces.len(), 3);
    let path = dir.path().join("segment.json");
    std::fs::write(
        &path,
        r#"{ "convention": "rows", "pieces": [[[1, 0], ["1/2", "1/2"]], [["1/2", "1/2"], [0, 1]]] }"#,
    )
    .unwrap();
    let (out, _) = secant(&["import", path.to_str().unwrap()], 0);
    assert!(out.contains("Convention: JSON") && Case::parse("t.toml", &out).is_ok(), "{out}");
    let (_, err) = secant(&["import", "cases/README.md"], 2);
    assert!(err.contains("secant::import"), "{err}");
    let (out, _) = secant(&["expand", "cases/faces/bicubic-tensor.toml"], 0);
    assert_eq!(Case::parse("t.toml", &out).unwrap().faces.len(), 1);
}

#[test]
fn the_ending_says_the_format() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    let files = ["a.svg", "a.png", "a.obj", "a.PLY"].map(file);
    let given: Vec<&str> = files.iter().flat_map(|f| ["-o", f.as_str()]).collect();
    secant(&[&["render", "koch", "--depth", "3"][..], &given].concat(), 0);
    let starts = files.each_ref().map(|f| std::fs::read(f).unwrap()[..4].to_vec());
    assert_eq!(starts.map(|s| String::from_utf8_lossy(&s).into_owned()), ["<svg", "\u{fffd}PNG", "# ko", "ply\n"]);
    for wrong in [&["-o", "a.gif"][..], &["-o", "a.svg", "--svg", "b.svg"], &["-o", "a.png", "-o", "b.png"]] {
        secant(&[&["render", "koch"][..], wrong].concat(), 2);
    }
    let both = ["a.html", "b.svg"].map(file);
    secant(&["certify", "-q", "bspline degree=2", "-o", &both[0], "-o", &both[1]], 0);
    assert!(std::fs::read_to_string(&both[0]).unwrap().starts_with("<!DOCTYPE html>"));
    assert!(std::fs::read_to_string(&both[1]).unwrap().starts_with("<svg"));
    let (_, err) = secant(&["certify", "koch", "-o", "a.doc"], 2);
    assert!(err.contains(".html"), "{err}");
}

#[test]
fn a_shape_in_space_is_seen_from_a_direction() {
    let patch = "cases/surfaces/bicubic-space.toml";
    let drawn = |view: &[&str]| secant(&[&["render", patch, "--depth", "2", "--svg", "-"][..], view].concat(), 0).0;
    let front = drawn(&["--view", "front"]);
    assert_ne!(front, drawn(&[]));
    assert_eq!(front, drawn(&["--view=-90,0"]));
    assert_ne!(front, drawn(&["--view", "top"]));
    for (case, view) in [(patch, "sideways"), (patch, "1,100"), (patch, "NaN,0"), (patch, "3"), ("koch", "top")] {
        let (_, err) = secant(&["render", case, "--svg", "-", "--view", view], 2);
        assert!(err.contains("--view"), "{err}");
    }
}

/// Seen from above a patch shows its first two coordinates as they are: the corners of its border at their places.
#[test]
fn the_top_view_shows_the_first_two_coordinates() {
    let shown = |case: &str, view: &[&str]| {
        let (svg, _) = secant(&[&["render", case, "--depth", "4", "--svg", "-"][..], view].concat(), 0);
        svg.lines().filter(|l| l.starts_with("<path")).map(str::to_owned).collect::<Vec<_>>()
    };
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, points: &str| {
        let path = dir.path().join(name);
        let text = format!("name = \"a\"\ncontrol = [{points}]\n[scheme]\nname = \"bezier\"\ndegree = 2\n");
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let plane = write("plane.toml", "[0, 0], [1, 2], [3, 1]");
    let space = write("space.toml", "[0, 0, 5], [1, 2, -7], [3, 1, 1]");
    assert_eq!(shown(&plane, &[]), shown(&space, &["--view", "top"]));
    assert_ne!(shown(&plane, &[]), shown(&space, &["--view", "bottom"]));
}

#[test]
fn a_drawing_within_an_error_says_so() {
    let file = std::env::temp_dir().join(format!("secant-error-{}.svg", std::process::id()));
    let path = file.to_str().unwrap();
    let (out, _) = secant(&["render", "cases/control/two-spans.toml", "--svg", path, "--error", "1/50"], 0);
    assert!(out.contains("none of its points is farther than 1/50"), "{out}");
    let (coarse, _) = secant(&["render", "cases/control/two-spans.toml", "--svg", path, "--error", "1"], 0);
    assert_ne!(out, coarse);
    for wrong in ["0", "-1", "many", "1/1000000000000"] {
        let (_, err) =
            secant(&["render", "cases/control/two-spans.toml", "--svg", path, &format!("--error={wrong}")], 2);
        assert!(err.contains("--error") && !err.contains("internal"), "{err}");
    }
    std::fs::remove_file(file).unwrap();
}
