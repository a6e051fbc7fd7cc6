//! Replay in Coq: what is written, what is refused, and, with SECANT_COQ=1 where coqc is installed, that Coq accepts the
//! files and no changed one.

use assert_cmd::Command;
use std::path::{Path, PathBuf};
use std::process::Command as Process;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn secant(case: &str, file: &Path) -> (Option<i32>, String) {
    let mut command = Command::cargo_bin("secant").expect("the program is built");
    let run = command.current_dir(root()).args(["certify", "-q", "--no-check", case, "--coq"]).arg(file);
    let out = run.output().expect("the program runs");
    (out.status.code(), String::from_utf8(out.stderr).expect("UTF-8"))
}

fn written(case: &str) -> String {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("case.v");
    let (code, said) = secant(case, &file);
    assert!(matches!(code, Some(0 | 1)), "{case}: {said}");
    std::fs::read_to_string(file).unwrap()
}

const REPLAYED: [(&str, &[&str]); 12] = [
    (
        "cases/thesis/half-tangent.toml",
        &["half_tangent", "cusp (automaton", "levels_0_0_1", "Not stated: the curve is G¹"],
    ),
    (
        "cases/two-parameter/quarter-quarter.toml",
        &["regular (automaton", "levels_0_0_1", "tangent_at_every_address", "g1 (automaton"],
    ),
    ("cases/classical/takagi.toml", &["lead := Block (1#2)", "cusp (automaton"]),
    ("cases/two-parameter/corner-3-5.toml", &["corner (automaton", "verdict: refuted"]),
    ("cases/bspline/degree-3.toml", &["regular (automaton", "tangent_at_every_address"]),
    ("cases/classical/koch-4.toml", &["no_tangent (automaton", "direction_evidence"]),
    // Control points that hide part of what the operators do.
    ("cases/control/bezier-cusp.toml", &["cusp (automaton", "ambient := 4", "turn := [["]),
    // Both sides of a point inside a cell; secants that turn for ever.
    ("cases/two-parameter/interior-periodic.toml", &["passes (automaton", "passes_ok"]),
    ("cases/classical/levy.toml", &["no_tangent (automaton"]),
    // Eigenvalues and tangents over Q(√2), the joints of all levels among them.
    (
        "cases/irrational/regular-sqrt-2.toml",
        &[
            "radicand := 2;",
            "quadratic_ray_ok",
            "quadratic_regular_ok",
            "levels_0_0_1",
            "(vval left_end_evidence_root ([1; 0], [0; 1#2]))",
        ],
    ),
    // Pieces that run backwards; contraction by polytopes.
    ("cases/reversed/barycentric-smooth.toml", &["list (list bool) := [[true", "g1 (automaton"]),
    ("cases/contraction/quarter-turns.toml", &["controlled_hulls", "shrink_by := "]),
];

/// The other kinds of points with such numbers.
const QUADRATIC: [(&str, &[&str]); 3] = [
    ("cases/irrational/cusp-sqrt-2.toml", &["quadratic_cusp_ok"]),
    ("cases/irrational/interior-01.toml", &["radicand := 73;", "quadratic_passes_ok"]),
    ("cases/irrational/lebesgue-sqrt-2.toml", &["quadratic_corner_ok"]),
];

/// A curve at whose ends a complex pair dominates that is no multiple of a root of unity.
const OBLIQUE: &str = r#"
name = "oblique"

[[map]]
linear = [["1/2", "-1/5"], ["1/5", "1/2"]]
shift = [0, 0]

[[map]]
linear = [["1/2", "1/5"], ["-1/5", "1/2"]]
shift = ["1/2", "1/5"]
"#;

fn oblique() -> String {
    let dir = tempfile::tempdir().unwrap();
    let case = dir.path().join("oblique.toml");
    std::fs::write(&case, OBLIQUE).unwrap();
    written(case.to_str().unwrap())
}

#[test]
fn files_state_what_was_found_about_the_matrices_of_the_case() {
    for (case, pieces) in REPLAYED.into_iter().chain(QUADRATIC) {
        let text = written(case);
        for piece in pieces {
            assert!(text.contains(piece), "{case}: {piece} is missing in\n{text}");
        }
    }
    let spiral = oblique();
    assert!(spiral.contains("spiral_ok") && spiral.contains("trace := 1; norm := 29#100"), "{spiral}");
    let thesis = written(REPLAYED[0].0);
    assert!(thesis.contains("[[5#4; 1#2; 0]; [-1#4; 1#2; 5#4]; [0; 0; -1#4]]"), "{thesis}");
    assert!(thesis.contains("(qv [-1; 1; 0])") && thesis.contains("= qv [2; -1; 0]"), "{thesis}");
}

#[test]
fn what_has_no_formal_theorem_is_refused_and_nothing_is_written() {
    for (case, why) in [
        ("cases/fields/db2.toml", "irrational entries"),
        ("cases/irrational/two-fields.toml", "irrational numbers of two fields"),
        ("cases/counterexamples/uniformity.toml", "refutation other than"),
        ("cases/surfaces/bicubic-space.toml", "surface"),
        ("cases/two-parameter/sign-change.toml", "ring condition that takes too many cells"),
    ] {
        if !root().join(case).exists() {
            panic!("{case} is gone");
        }
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("case.v");
        let (code, said) = secant(case, &file);
        assert_eq!(code, Some(2), "{case}: {said}");
        let line = said.split_whitespace().collect::<Vec<_>>().join(" ").replace("│ ", "");
        assert!(line.contains("no formal theorem") && line.contains(why), "{case}: {line}");
        assert!(!file.exists(), "{case}: something was written");
    }
}

/// Whether Coq accepts a text, and what it says.
fn coqc(text: &str) -> (bool, String) {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("replayed.v");
    std::fs::write(&file, text).unwrap();
    let theories = root().join("proofs/theories");
    let mut run = Process::new("coqc");
    let out = run.args(["-w", "none", "-Q"]).arg(theories).arg("Secant").arg(&file).output().expect("coqc runs");
    (out.status.success(), String::from_utf8_lossy(&out.stderr).into_owned())
}

fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from} is not in\n{text}");
    text.replacen(from, to, 1)
}

#[test]
fn coq_accepts_the_files_and_no_changed_one() {
    if std::env::var_os("SECANT_COQ").is_none() {
        eprintln!("skipped: set SECANT_COQ=1 to replay in Coq");
        return;
    }
    let program = assert_cmd::cargo::cargo_bin("secant");
    let out = Process::new(root().join("proofs/replay.sh")).arg(program).output().expect("the script runs");
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(out.status.success(), "{said}{}", String::from_utf8_lossy(&out.stderr));
    if said.contains("skipped: no coqc") {
        eprintln!("{said}");
        return;
    }
    assert_eq!(said.lines().filter(|l| l.starts_with("replayed:")).count(), REPLAYED.len(), "{said}");

    let thesis = written("cases/thesis/half-tangent.toml");
    let smooth = written("cases/two-parameter/quarter-quarter.toml");
    let corner = written("cases/two-parameter/corner-3-5.toml");
    let koch = written("cases/classical/koch-4.toml");
    let seen = written("cases/control/bezier-cusp.toml");
    let inside = written("cases/two-parameter/interior-periodic.toml");
    let spiral = oblique();
    let irrational = written("cases/irrational/regular-sqrt-2.toml");
    let backwards = written("cases/reversed/barycentric-smooth.toml");
    let hulls = written("cases/contraction/quarter-turns.toml");
    for accepted in QUADRATIC.map(|(case, _)| written(case)).iter().chain([&spiral]) {
        assert!(coqc(accepted).0, "{accepted}");
    }
    for (text, from, to) in [
        // Another matrix, with columns that still sum to 1; a column that does not.
        (&thesis, "[5#4; 1#2; 0]; [-1#4; 1#2; 5#4]", "[5#4; 1#4; 0]; [-1#4; 3#4; 5#4]"),
        (&thesis, "[5#4; 1#2; 0]", "[5#4; 1#3; 0]"),
        // Another ray, the opposite ray, another point, another cycle.
        (&thesis, "(qv [-1; 1; 0])", "(qv [-1; 2; -1])"),
        (&thesis, "(qv [-1; 1; 0])", "(qv [1; -1; 0])"),
        (&thesis, "= qv [2; -1; 0]", "= qv [1; 0; 0]"),
        (&thesis, "cycle := [0%nat]", "cycle := [1%nat]"),
        // A cusp that is called smooth, a smooth joint that is called a cusp or a corner.
        (&thesis, "  cusp (automaton_of case)", "  regular (automaton_of case)"),
        (&smooth, "  regular (automaton_of case)", "  cusp (automaton_of case)"),
        (&corner, "  corner (automaton_of case)", "  regular (automaton_of case)"),
        // A dropped joint: the theorem is missing, or its proof is.
        (&smooth, "exact joint_0_1|", "exact left_end|"),
        (&smooth, "joint_0_1_statement /\\", "True /\\"),
        // A joint that is left out of those of the whole curve; a piece that runs the other way; a polytope that is too small.
        (&smooth, "joined : joints_of := [(0%nat, 0%nat", "joined : joints_of := [(1%nat, 0%nat"),
        (&smooth, "list (list bool) := [[false", "list (list bool) := [[true"),
        (&backwards, "list (list bool) := [[true", "list (list bool) := [[false"),
        (&hulls, "shrink_by := ", "shrink_by := (1#2) * "),
        // A piece that does not meet the one before; a lower bound that does not hold; a ray outside the cone.
        (&smooth, "firsts := [[", "firsts := [[1; 0; 0]; ["),
        (&smooth, "low := 1", "low := 900"),
        (&koch, "turns_power := 1", "turns_power := 0"),
        // A space that leaves out differences, a chart that is not kept, a tail whose offset leaves its space.
        (&seen, "spaces : list qmat := [[[", "spaces : list qmat := [[]; [["),
        (&seen, "coordinates := [[1", "coordinates := [[2"),
        (&koch, "stays := [[", "stays := [[1; 1; 1]; ["),
        // The opposite direction inside a cell; another pair.
        (&inside, "(qv [-2; 1; 1])", "(qv [2; -1; -1])"),
        (&spiral, "trace := 1;", "trace := 2;"),
        (&spiral, "norm := 29#100", "norm := 1#5"),
        // Irrational numbers: another ray, its conjugate, another matrix, the root of another number, an interval without the root,
        // another eigenvalue, another vector of what is seen of a joint at all levels.
        (
            &irrational,
            "(vval left_end_evidence_root ([1; 0], [0; 1#2]))",
            "(vval left_end_evidence_root ([1; 0], [0; 1#3]))",
        ),
        (
            &irrational,
            "(vval left_end_evidence_root ([1; 0], [0; 1#2]))",
            "(vval left_end_evidence_root ([1; 0], [0; -1#2]))",
        ),
        (&irrational, "[1; 11#20; 1#2]; [0; 2#5; 1#10]", "[1; 13#20; 1#2]; [0; 3#10; 1#10]"),
        (&irrational, "radicand := 2;", "radicand := 3;"),
        (&irrational, "radicand := 2; below := ", "radicand := 2; below := 2 + "),
        (&irrational, "q_lead := (2#5, 1#20)", "q_lead := (2#5, -1#20)"),
        (&irrational, "views : list qmat := [[[", "views : list qmat := [[]; [["),
    ] {
        let (accepted, said) = coqc(&changed(text, from, to));
        assert!(!accepted, "Coq accepts the file with {to} in the place of {from}");
        assert!(said.contains("Error"), "{said}");
    }
}
