//! Meshes: certificates changed by hand, and meshes that were changed under their certificates.

use serde_json::{Value, json};
use std::path::Path;

fn stored(mesh: &str, name: &str) -> (String, Value) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |path: String| std::fs::read_to_string(root.join(path)).unwrap();
    let certificate = serde_json::from_str(&read(format!("tests/certs/mesh/{name}.json"))).unwrap();
    (read(format!("cases/meshes/{mesh}.obj")), certificate)
}

fn rule(mesh: &str, certificate: &Value) -> String {
    match secant_check::check(mesh, &certificate.to_string()) {
        Ok(accepted) => panic!("accepted: {accepted:?}"),
        Err(rejected) => rejected.rule,
    }
}

/// The rule that refuses a certificate in which some values below `proof` were replaced.
fn changed(mesh: &str, certificate: &Value, changes: &[(&str, Value)]) -> String {
    let mut forged = certificate.clone();
    for (pointer, value) in changes {
        *forged["proof"].pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value.clone();
    }
    rule(mesh, &forged)
}

#[test]
fn certificates_that_were_changed() {
    let (mesh, good) = stored("tetrahedron", "tetrahedron-catmull-clark");
    let accepted = secant_check::check(&mesh, &good.to_string()).unwrap();
    assert_eq!((accepted.claims.len(), accepted.verdict), (3, secant_check::Verdict::Proved));
    let limit = good["proof"]["limits"][1].clone();
    let with = |k: usize, x: Value| {
        let mut limit = limit.clone();
        limit[k] = x;
        limit
    };
    let minus = |x: &Value| {
        let text = x.as_str().unwrap();
        json!(if text == "0" {
            text.to_owned()
        } else {
            text.strip_prefix('-').map_or(format!("-{text}"), str::to_owned)
        })
    };
    let opposite: Vec<Value> = (0..6).map(|k| if k < 3 { limit[k].clone() } else { minus(&limit[k]) }).collect();
    let valences = good["proof"]["valences"].clone();
    let limits = good["proof"]["limits"].as_array().unwrap().clone();
    let count = limits.len();
    let forgeries: Vec<(&str, Vec<(&str, Value)>)> = vec![
        // Another limit point, the opposite normal, another one, one that is longer.
        ("limits", vec![("/limits/1", with(0, json!("1/1000000000")))]),
        ("limits", vec![("/limits/1", json!(opposite))]),
        ("limits", vec![("/limits/1", json!([limit[0], limit[1], limit[2], "1", "0", "0"]))]),
        ("limits", vec![("/limits/1", json!([limit[0], limit[1], limit[2], "0", "0", "0"]))]),
        ("limits", vec![("/limits/1", json!([limit[0], limit[1], limit[2], "2", "0", "0"]))]),
        ("limits", vec![("/limits/1", limits[0].clone())]),
        ("format", vec![("/limits/1", json!([]))]),
        // Vertices left out, or one too many.
        ("limits", vec![("/limits", json!(limits[1..]))]),
        ("limits", vec![("/limits", json!([limits.clone(), vec![Value::Null]].concat()))]),
        ("limits", vec![("/limits", json!([]))]),
        ("limits", vec![("/limits", json!(vec![Value::Null; count])), ("/whole", Value::Null)]),
        // The whole surface, where one vertex is left out.
        ("whole", vec![("/limits/1", Value::Null)]),
        ("verdict", vec![("/limits/1", Value::Null), ("/whole", Value::Null)]),
        // Another scheme, valences left out, twice, or of another scheme.
        ("vertex", vec![("/scheme", json!("loop"))]),
        ("format", vec![("/scheme", json!("doo-sabin"))]),
        ("limits", vec![("/valences", json!([]))]),
        ("limits", vec![("/valences", json!([valences[1]]))]),
        ("vertex", vec![("/valences", json!([valences[0], valences[0], valences[1]]))]),
        ("theorem-8-winding", vec![("/valences/0/rule", json!("theorem-8-winding"))]),
        ("line", vec![("/line", json!(0))]),
        ("format", vec![("/line", json!(4))]),
        ("format", vec![("/whole", json!("smooth"))]),
        ("whole", vec![("/whole", json!({"face": 0, "at": ["0", "0"]}))]),
        ("format", vec![("/whole", json!({"face": 4, "at": ["0", "0"]}))]),
    ];
    for (wanted, changes) in &forgeries {
        assert_eq!(changed(&mesh, &good, changes), *wanted, "{changes:.400?}");
    }
}

/// Where a patch is not regular.
#[test]
fn parameters_that_were_changed() {
    let (mesh, good) = stored("folded", "folded-catmull-clark");
    let accepted = secant_check::check(&mesh, &good.to_string()).unwrap();
    assert_eq!((accepted.claims.len(), accepted.verdict), (3, secant_check::Verdict::Undetermined));
    let whole = &good["proof"]["whole"];
    let other = |face: Value, at: Value| vec![("/whole", json!({"face": face, "at": at}))];
    for (wanted, changes) in [
        ("whole", other(json!(10), whole["at"].clone())),
        ("whole", other(whole["face"].clone(), json!(["1/2", "1/3"]))),
        ("whole", other(whole["face"].clone(), json!(["2", "0"]))),
        ("whole", vec![("/whole", json!("regular"))]),
    ] {
        assert_eq!(changed(&mesh, &good, &changes), wanted, "{changes:?}");
    }
    let mut forged = good.clone();
    forged["verdict"] = json!("proved");
    assert_eq!(rule(&mesh, &forged), "verdict");
}

/// A certificate is about one mesh: a point that is moved, a vertex or a face that is left out, and tags are seen.
#[test]
fn meshes_that_were_changed() {
    let names = [("tetrahedron", "tetrahedron-catmull-clark"), ("icosahedron", "icosahedron-loop")];
    for (mesh, name) in names {
        let (text, good) = stored(mesh, name);
        assert!(secant_check::check(&text, &good.to_string()).is_ok(), "{name}");
        let lines: Vec<&str> = text.lines().collect();
        let mut seen = 0;
        for (k, line) in lines.iter().enumerate().filter(|(_, l)| l.starts_with("v ") || l.starts_with("f ")) {
            let without: Vec<&str> = lines.iter().enumerate().filter(|(m, _)| *m != k).map(|(_, l)| *l).collect();
            rule(&without.join("\n"), &good);
            let words: Vec<&str> = line.split_whitespace().collect();
            let moved = if words[0] == "v" {
                format!("v {} {} {}.000001", words[1], words[2], words[3].split('.').next().unwrap())
            } else {
                // Two corners change places, in one face only: it has a side with a third face, or the vertices have other rings.
                format!("f {} {} {}", words[1], words[2], (words[3].parse::<usize>().unwrap() % 4) + 1)
            };
            let changed: Vec<&str> =
                lines.iter().enumerate().map(|(m, l)| if m == k { moved.as_str() } else { *l }).collect();
            if moved != *line {
                rule(&changed.join("\n"), &good);
                seen += 1;
            }
        }
        assert!(seen > 4, "{name}");
        // Mirrored, the surface has the opposite normals.
        let mirrored: Vec<String> = lines
            .iter()
            .map(|l| match l.split_whitespace().collect::<Vec<_>>()[..] {
                ["f", a, b, c] => format!("f {a} {c} {b}"),
                _ => (*l).to_owned(),
            })
            .collect();
        assert_eq!(rule(&mirrored.join("\n"), &good), "limits", "{name}");
        for more in ["t crease 2/1/0 0 1 10", "t corner 1/1/0 0 10", "t hole 1/0/0 2", "t", "curv 0 1 2", "f 1 2 3"] {
            assert_eq!(rule(&format!("{text}\n{more}\n"), &good), "case", "{name}: {more}");
        }
        // A vertex that no face has changes nothing; comments and texture coordinates neither.
        let more = format!("# a comment\n{text}\nvt 0 0\nt interpolateboundary 1/0/0 2\n\nv 1 2 3\n");
        assert!(secant_check::check(&more, &good.to_string()).is_ok(), "{name}");
    }
}

#[test]
fn texts_that_are_no_meshes() {
    let (_, good) = stored("tetrahedron", "tetrahedron-catmull-clark");
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nv 2 1 3\nv 4 1 2\n";
    for faces in [
        "",
        "f 1 2",
        "f 1 2 2",
        "f 1 2 9",
        "f 0 1 2",
        "f 1 2 -9",
        "f 1 2 x",
        "f 1 2 3\nf 2 1 4\nf 1 2 5",
        "f 1 2 3\nf 1 4 5",
        "v nan 0 0",
        "v 1/2 0 0\nf 1 2 3",
        "v 1e999 0 0\nf 1 2 3",
        "v 1 2\nf 1 2 3",
        "v 1 2 3 2\nf 1 2 3",
        "vertex 1 2 3",
    ] {
        let rejected = secant_check::check(&format!("{points}{faces}\n"), &good.to_string()).unwrap_err();
        assert!(rejected.unreadable && rejected.rule == "case", "{faces}: {rejected:?}");
    }
    // The same tetrahedron in three formats.
    let (mesh, _) = stored("tetrahedron", "tetrahedron-catmull-clark");
    let ply = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float y\nproperty float x\nproperty float z\n\
        element face 4\nproperty uchar flag\nproperty list uchar int vertex_indices\nend_header\n";
    let body =
        |points: [&str; 4]| points.map(|p| format!("{p}\n")).concat() + "7 3 0 3 1\n7 3 0 1 2\n7 3 0 2 3\n7 3 1 3 2\n";
    let ply = ply.to_owned() + &body(["1 1 1", "-1 -1 1", "1 -1 -1", "-1 1 -1"]);
    let same = mesh.replace("f 1 4 2", "f 4 2 1");
    for text in [&same, &ply] {
        assert!(secant_check::check(text, &good.to_string()).is_ok(), "{text}");
    }
    for (from, to) in [
        ("format ascii 1.0", "format binary_little_endian 1.0"),
        ("format ascii 1.0\n", ""),
        ("end_header\n", ""),
        ("element vertex 4", "element vertex 5"),
        ("element face 4", "element face 5"),
        ("element face 4", "element vertex 4"),
        ("property float x", "property float w"),
        ("vertex_indices", "others"),
        ("7 3 1 3 2", "7 3 1 3"),
        ("7 3 1 3 2", "7 3 1 3 2 4"),
        ("7 3 1 3 2", "7 3 1 3 4"),
        ("1 1 1\n", "1 1 nan\n"),
    ] {
        assert!(ply.contains(from));
        let rejected = secant_check::check(&ply.replacen(from, to, 1), &good.to_string()).unwrap_err();
        assert!(rejected.unreadable && rejected.rule == "case", "{from} {to}: {rejected:?}");
    }
    let off = "OFF\n4 4 6\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";
    for bad in [
        off.replace("4 4 6", "5 4 6"),
        off.replace("4 4 6", "4 5 6"),
        off.replace("3 1 3 2", "3 1 3 4"),
        off.replace("3 1 3 2", "4 1 3 2"),
    ] {
        let rejected = secant_check::check(&bad, &good.to_string()).unwrap_err();
        assert!(rejected.unreadable, "{bad}: {rejected:?}");
    }
}
