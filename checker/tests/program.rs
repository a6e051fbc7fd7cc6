//! The program `secant-check`: exit codes, and a second opinion from the Python script.

use std::path::{Path, PathBuf};
use std::process::Command;

fn certs(kind: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs").join(kind);
    let mut found: Vec<PathBuf> = std::fs::read_dir(root).unwrap().map(|e| e.unwrap().path()).collect();
    found.retain(|p| p.extension().is_some_and(|e| e == "json"));
    found.sort();
    found
}

fn code(case: &Path, certificate: &Path) -> i32 {
    let output = Command::new(env!("CARGO_BIN_EXE_secant-check")).args([case, certificate]).output().unwrap();
    output.status.code().unwrap()
}

#[test]
fn exit_codes() {
    for path in certs("pass") {
        assert_eq!(code(&path.with_extension("toml"), &path), 0, "{}", path.display());
    }
    for path in certs("fail") {
        assert_eq!(code(&path.with_extension("toml"), &path), 1, "{}", path.display());
    }
    let runs = certs("run");
    assert!(runs.len() >= 10);
    for path in runs {
        let wanted = path.file_name().unwrap().to_string_lossy().split('-').next().unwrap().parse::<i32>().unwrap();
        assert_eq!(code(&path.with_file_name("case.toml"), &path), wanted, "{}", path.display());
    }
    assert_eq!(code(Path::new("missing.toml"), Path::new("missing.json")), 2);
}

#[test]
fn people_are_told_what_it_does_and_what_was_proved() {
    let run = |arguments: &[&Path]| {
        let output = Command::new(env!("CARGO_BIN_EXE_secant-check")).args(arguments).output().unwrap();
        let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        (output.status.code().unwrap(), text[0].clone(), text[1].clone())
    };
    let (code, help, _) = run(&[Path::new("--help")]);
    assert!(code == 0 && help.contains("Usage:") && help.contains("Exit codes:"), "{help}");
    let (code, version, _) = run(&[Path::new("--version")]);
    assert!(code == 0 && version.starts_with("secant-check "), "{version}");
    let (code, out, usage) = run(&[]);
    assert!(code == 2 && out.is_empty() && usage.contains("--help"), "{usage}");
    let named = |name: &str, end: &str| {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs/pass").join(format!("{name}.{end}"))
    };
    // No debug text: no brackets or quotes of Rust.
    for path in certs("pass") {
        let (_, text, _) = run(&[&path.with_extension("toml"), &path]);
        assert!(!text.contains(['[', '{', '"']) && !text.contains("Some"), "{}: {text}", path.display());
    }
    let (_, text, _) = run(&[&named("scheme-chaikin", "toml"), &named("scheme-chaikin", "json")]);
    assert!(
        text.starts_with(
            "accepted: scheme-chaikin: proved\n  proved: the curve has a tangent line at both end points\n"
        )
    );
}

/// The kind of a certificate.
fn kind(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let rest = text.split_once("\"kind\"").unwrap().1;
    rest.split('"').nth(1).unwrap().to_owned()
}

/// Whether the operators of a case are written in it: the scripts build none.
fn is_written_out(case: &Path) -> bool {
    let text = std::fs::read_to_string(case).unwrap();
    !["[scheme]", "[interpolate]"].iter().any(|table| text.lines().any(|line| line.trim() == *table))
}

/// The script and the program accept and reject the same certificates of these kinds, at least so many of either.
fn agree(script: &str, kinds: &[&str], least: [usize; 2]) {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("python").join(script);
    for ((folder, wanted), least) in [("pass", 0), ("fail", 1)].into_iter().zip(least) {
        let mut asked = 0;
        for path in certs(folder) {
            let case = path.with_extension("toml");
            // No script knows number fields.
            let over_a_field = std::fs::read_to_string(&path).unwrap().contains("\"field\": {");
            if !kinds.contains(&kind(&path).as_str()) || !is_written_out(&case) || over_a_field {
                continue;
            }
            // Without a second opinion this test does not pass; who has no python3 leaves it out by name.
            let output = Command::new("python3").arg("-B").args([&script, &case, &path]).output();
            let output =
                output.expect("python3 is needed here (`-- --skip the_python_scripts_agree` leaves these tests out)");
            let text = String::from_utf8_lossy(&output.stdout);
            assert_eq!(output.status.code(), Some(wanted), "{}: {text}", path.display());
            asked += 1;
        }
        assert!(asked >= least, "{}: {asked} of {folder}", script.display());
    }
}

#[test]
fn the_python_scripts_agree_on_curves_and_spectra() {
    // One forgery is of a kind that does not exist.
    agree("check_curves.py", &["certify", "spectrum", "solve", "spectral"], [30, 90]);
}

#[test]
fn the_python_scripts_agree_on_radii_and_orders() {
    agree("check_radii.py", &["jsr", "regularity"], [15, 3]);
}

#[test]
fn the_python_scripts_agree_on_vertices() {
    agree("check_vertices.py", &["vertex"], [7, 0]);
}

#[test]
fn the_python_scripts_agree_on_lattices_and_borders() {
    agree("check_lattices.py", &["lattice", "border"], [4, 4]);
}

#[test]
fn the_python_scripts_agree_on_regions() {
    agree("check_regions.py", &["region"], [3, 5]);
}

#[test]
fn the_python_scripts_agree_on_surfaces() {
    agree("check_surfaces.py", &["surface"], [9, 8]);
}
