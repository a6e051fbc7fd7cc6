//! Meshes with known answers, and limits against subdivision in floats that shares no code with the library.

mod borders;

use assert_cmd::Command;
use secant::answer::Verdict::{self, Proved, Refuted, Undetermined};
use secant::budget::Budget;
use secant::mesh::{AtVertex, Found, Model, Reason, Rings, Scheme, Spot, certify};
use secant::vertex::{Second, Size};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

type P = [f64; 3];

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/meshes").join(name).with_extension("obj")
}

fn found(name: &str, scheme: Scheme) -> (Model, Found) {
    let model = Model::read(&file(name)).unwrap();
    let found = certify(&model, scheme, &Budget::default(), &|| {}).unwrap();
    (model, found)
}

const QUADS: Scheme = Scheme::CatmullClark;
const LOOP: Scheme = Scheme::Loop;

#[test]
fn every_mesh_has_its_answer() {
    let warren = Scheme::LoopWarren;
    // The mesh, the rule, C¹ at all vertices, a regular C¹ surface.
    let answers: [(&str, Scheme, Verdict, Verdict); 20] = [
        ("cube", QUADS, Proved, Proved),
        ("tetrahedron", QUADS, Proved, Proved),
        ("octahedron", QUADS, Proved, Proved),
        ("icosahedron", QUADS, Proved, Proved),
        ("torus", QUADS, Proved, Proved),
        ("klein", QUADS, Proved, Proved),
        ("valence-64", QUADS, Proved, Undetermined),
        ("folded", QUADS, Undetermined, Refuted),
        ("vanishing", QUADS, Undetermined, Undetermined),
        ("line", QUADS, Refuted, Refuted),
        ("strip", QUADS, Undetermined, Undetermined),
        ("plane", QUADS, Undetermined, Undetermined),
        ("triangle", QUADS, Undetermined, Undetermined),
        ("triangle", LOOP, Undetermined, Undetermined),
        ("tetrahedron", LOOP, Proved, Proved),
        ("octahedron", LOOP, Proved, Proved),
        ("octahedron", warren, Proved, Proved),
        ("icosahedron", LOOP, Proved, Proved),
        ("icosahedron", warren, Proved, Proved),
        ("line", LOOP, Refuted, Refuted),
    ];
    for (name, rule, smooth, regular) in answers {
        let (_, found) = found(name, rule);
        assert_eq!((found.smooth(), found.regular()), (smooth, regular), "{name} by {}", rule.name());
    }
}

#[test]
fn reasons_name_what_is_wrong() {
    let at = |found: &Found, k: usize| -> AtVertex {
        found.vertices.iter().find(|v| v.spot == Spot::Vertex(k)).unwrap().clone()
    };
    let (model, fold) = found("folded", QUADS);
    let bad: Vec<&AtVertex> = fold.vertices.iter().filter(|v| v.smooth != Proved).collect();
    assert_eq!(bad.len(), 12);
    for v in &bad {
        let Spot::Vertex(k) = v.spot else { panic!("a vertex of the file") };
        assert!(model.points[k][0] == 0 && v.reason == Reason::Dependent && v.line == k + 2);
    }
    // Patches on both sides of the fold are refuted at a corner.
    assert_eq!(fold.patches.bad.len(), 24);
    let (_, vanishing) = found("vanishing", QUADS);
    assert_eq!(at(&vanishing, 0).reason, Reason::Vanishing);
    assert_eq!(at(&vanishing, 25).smooth, Proved);
    let (_, strip) = found("strip", QUADS);
    assert!(strip.vertices.iter().all(|v| v.reason == Reason::Border) && !strip.closed);
    let (_, plane) = found("plane", QUADS);
    assert_eq!(plane.vertices.iter().filter(|v| v.smooth == Proved).count(), 16);
    let (_, klein) = found("klein", QUADS);
    assert_eq!((klein.parts.as_slice(), klein.closed), ([false].as_slice(), true));
    let (_, many) = found("valence-64", QUADS);
    assert_eq!((at(&many, 0).valence, at(&many, 0).smooth), (64, Proved));
}

/// A mesh in floats: points, and faces of their numbers.
#[derive(Clone)]
struct Naive {
    points: Vec<P>,
    faces: Vec<Vec<usize>>,
}

fn mean<'a>(all: impl IntoIterator<Item = &'a P>) -> P {
    let all: Vec<&P> = all.into_iter().collect();
    std::array::from_fn(|k| all.iter().map(|p| p[k]).sum::<f64>() / all.len() as f64)
}

fn mix(terms: &[(f64, P)]) -> P {
    std::array::from_fn(|k| terms.iter().map(|(w, p)| w * p[k]).sum())
}

impl Naive {
    /// The two faces at each edge.
    fn edges(&self) -> BTreeMap<(usize, usize), Vec<usize>> {
        let mut all: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for (k, a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                all.entry((*a.min(&b), *a.max(&b))).or_default().push(f);
            }
        }
        all
    }

    fn step(&self, triangles: bool) -> Self {
        let edges = self.edges();
        let count = self.points.len();
        let number: BTreeMap<(usize, usize), usize> = edges.keys().enumerate().map(|(k, e)| (*e, count + k)).collect();
        let centres: Vec<P> = self.faces.iter().map(|f| mean(f.iter().map(|v| &self.points[*v]))).collect();
        let mut points: Vec<P> = (0..count).map(|v| self.vertex(v, &edges, &centres, triangles)).collect();
        for ((a, b), faces) in &edges {
            let (p, q) = (self.points[*a], self.points[*b]);
            points.push(if triangles {
                let across = |f: &usize| self.points[*self.faces[*f].iter().find(|v| *v != a && *v != b).unwrap()];
                mix(&[(0.375, p), (0.375, q), (0.125, across(&faces[0])), (0.125, across(&faces[1]))])
            } else {
                mean([&p, &q, &centres[faces[0]], &centres[faces[1]]])
            });
        }
        let mut faces = Vec::new();
        for (f, face) in self.faces.iter().enumerate() {
            let n = face.len();
            let edge = |k: usize| number[&(face[k % n].min(face[(k + 1) % n]), face[k % n].max(face[(k + 1) % n]))];
            for (k, v) in face.iter().enumerate() {
                let corner = [*v, edge(k), edge(k + n - 1)];
                faces.push(if triangles {
                    corner.to_vec()
                } else {
                    vec![corner[0], corner[1], count + edges.len() + f, corner[2]]
                });
            }
            if triangles {
                faces.push((0..n).map(edge).collect());
            }
        }
        if !triangles {
            points.extend(centres);
        }
        Self { points, faces }
    }

    fn vertex(&self, v: usize, edges: &BTreeMap<(usize, usize), Vec<usize>>, centres: &[P], triangles: bool) -> P {
        let own: Vec<(&(usize, usize), &Vec<usize>)> = edges.iter().filter(|((a, b), _)| *a == v || *b == v).collect();
        let n = own.len() as f64;
        let ring = mean(own.iter().map(|((a, b), _)| &self.points[if *a == v { *b } else { *a }]));
        if triangles {
            let share = 0.375 + (2.0 * std::f64::consts::PI / n).cos() / 4.0;
            let w = 0.625 - share * share;
            return mix(&[(1.0 - w, self.points[v]), (w, ring)]);
        }
        let mut faces: Vec<usize> = own.iter().flat_map(|(_, f)| f.iter().copied()).collect();
        faces.sort_unstable();
        faces.dedup();
        let middle = mean(
            own.iter()
                .map(|((a, b), _)| [self.points[*a], self.points[*b]])
                .map(|[a, b]| mean([&a, &b]))
                .collect::<Vec<_>>()
                .iter(),
        );
        let face = mean(faces.iter().map(|f| &centres[*f]));
        mix(&[(1.0 / n, face), (2.0 / n, middle), ((n - 3.0) / n, self.points[v])])
    }

    /// The part within the faces that touch the faces at a vertex, with the vertex as number 0: all that its surroundings need.
    fn near(&self, v: usize) -> Self {
        let touch = |of: &[usize]| -> Vec<usize> {
            (0..self.faces.len()).filter(|f| self.faces[*f].iter().any(|w| of.contains(w))).collect()
        };
        let first: Vec<usize> = touch(&[v]).iter().flat_map(|f| self.faces[*f].clone()).collect();
        let mut old = vec![v];
        let mut faces = Vec::new();
        for f in touch(&first) {
            let face = self.faces[f].iter().map(|w| {
                old.iter().position(|o| o == w).unwrap_or_else(|| {
                    old.push(*w);
                    old.len() - 1
                })
            });
            faces.push(face.collect());
        }
        Self { points: old.iter().map(|v| self.points[*v]).collect(), faces }
    }
}

fn cross(a: P, b: P) -> P {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: P, b: P) -> P {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The ring of a vertex in order, `(e_0, f_0, e_1, …)` for quadrangles, refined by itself until it is small: the limit and the
/// unit normal.
fn limit(mesh: &Naive, v: usize, triangles: bool) -> (P, P) {
    let mut at: Vec<(usize, usize, usize)> = mesh
        .faces
        .iter()
        .filter_map(|f| {
            let k = f.iter().position(|w| *w == v)?;
            let n = f.len();
            Some((f[(k + 1) % n], f[(k + 2) % n], f[(k + n - 1) % n]))
        })
        .collect();
    let mut order = vec![at.remove(0)];
    while let Some(k) = at.iter().position(|a| a.0 == order[order.len() - 1].2) {
        order.push(at.remove(k));
    }
    assert!(at.is_empty());
    let n = order.len();
    let (mut own, mut e): (P, Vec<P>) = (mesh.points[v], order.iter().map(|a| mesh.points[a.0]).collect());
    let mut f: Vec<P> = order.iter().map(|a| mesh.points[a.1]).collect();
    let mut normal = [0.0; 3];
    let (mut centre, mut scale) = ([0.0; 3], 1.0);
    for _ in 0..6000 {
        // Coordinates around the vertex, in units of the ring.
        let size = e.iter().map(|p| minus(*p, own).iter().map(|x| x * x).sum::<f64>().sqrt()).fold(0.0, f64::max);
        centre = mix(&[(1.0, centre), (scale, own)]);
        let shrink = |p: &P| minus(*p, own).map(|x| x / size);
        (e, f, own, scale) = (e.iter().map(shrink).collect(), f.iter().map(shrink).collect(), [0.0; 3], scale * size);
        normal = (0..n).map(|s| cross(e[s], e[(s + 1) % n])).fold([0.0; 3], |a, b| mix(&[(1.0, a), (1.0, b)]));
        let (next, ring): (Vec<P>, P) = if triangles {
            let edge =
                |s: usize| mix(&[(0.375, own), (0.375, e[s]), (0.125, e[(s + 1) % n]), (0.125, e[(s + n - 1) % n])]);
            ((0..n).map(edge).collect(), mean(&e))
        } else {
            f = (0..n).map(|s| mean([&own, &e[s], &f[s], &e[(s + 1) % n]])).collect();
            ((0..n).map(|s| mean([&own, &e[s], &f[s], &f[(s + n - 1) % n]])).collect(), mean(&e))
        };
        own = if triangles {
            let share = 0.375 + (2.0 * std::f64::consts::PI / n as f64).cos() / 4.0;
            let w = 0.625 - share * share;
            mix(&[(1.0 - w, own), (w, ring)])
        } else {
            let n = n as f64;
            mix(&[((n - 2.0) / n, own), (1.0 / n, ring), (1.0 / n, mean(&f))])
        };
        e = next;
    }
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    (centre, normal.map(|x| x / length))
}

#[test]
fn limits_and_normals_agree_with_subdivision() {
    let quads = ["cube", "tetrahedron", "octahedron", "icosahedron", "torus", "valence-64"];
    let all = quads.iter().map(|q| (*q, QUADS)).chain(["tetrahedron", "octahedron", "icosahedron"].map(|t| (t, LOOP)));
    for (name, rule) in all {
        let triangles = rule == LOOP;
        let (model, found) = found(name, rule);
        let number = |v: &u32| *v as usize;
        let mesh = Naive {
            points: model.points.iter().map(|p| [0, 1, 2].map(|k| secant::arith::to_f64(&p[k]))).collect(),
            faces: (0..model.topology.faces())
                .map(|f| model.topology.polygon(f).iter().map(number).collect())
                .collect(),
        };
        let mut seen = 0;
        for v in found.vertices.iter().filter(|v| !triangles || v.valence < 40) {
            let Spot::Vertex(k) = v.spot else { continue };
            if name == "valence-64" && k % 13 > 0 {
                continue;
            }
            // Two steps of the whole neighbourhood first, then the ring alone.
            let mut near = mesh.near(k);
            if mesh.faces.len() < 30 {
                near = mesh.clone().step(triangles).step(triangles);
            }
            let at = if mesh.faces.len() < 30 { k } else { 0 };
            if near.faces.iter().any(|f| f.len() != 4) && !triangles {
                near = mesh.clone().step(false);
            }
            let at = if near.points.len() > mesh.points.len() { k } else { at };
            let (point, normal) = limit(&near, at, triangles);
            let own = v.limit.as_ref().unwrap();
            for c in 0..3 {
                let bounds = own.near[c];
                assert!((bounds.mid() - point[c]).abs() < 1e-6, "{name}, {:?}: {:?} {point:?}", v.spot, own.near);
                assert!(
                    (own.unit.unwrap()[c] - normal[c]).abs() < 1e-6,
                    "{name}, {:?}: {:?} {normal:?}",
                    v.spot,
                    own.unit
                );
            }
            seen += 1;
        }
        assert!(seen >= 4, "{name}");
    }
}

/// Where the whole surface is proved regular, the faces of a fine subdivision have no corner without extent.
#[test]
fn proved_surfaces_have_no_flat_corner() {
    for (name, rule) in [("cube", QUADS), ("octahedron", QUADS), ("octahedron", LOOP), ("icosahedron", LOOP)] {
        let (model, found) = found(name, rule);
        assert_eq!(found.regular(), Proved);
        assert!(
            found.vertices.iter().filter(|v| v.extraordinary).all(|v| matches!(v.rings, Some(Ok(Rings::Immersed(_)))))
        );
        let mut mesh = Naive {
            points: model.points.iter().map(|p| [0, 1, 2].map(|k| secant::arith::to_f64(&p[k]))).collect(),
            faces: (0..model.topology.faces())
                .map(|f| model.topology.polygon(f).iter().map(|v| *v as usize).collect())
                .collect(),
        };
        for _ in 0..3 {
            mesh = mesh.step(rule == LOOP);
        }
        for face in &mesh.faces {
            let p = |k: usize| mesh.points[face[k % face.len()]];
            let n = cross(minus(p(1), p(0)), minus(p(face.len() - 1), p(0)));
            assert!(n.iter().map(|x| x * x).sum::<f64>() > 0.0, "{name}");
        }
    }
}

#[test]
fn the_curvature_of_each_valence() {
    let (_, drum) = found("valence-64", QUADS);
    let second = |n: usize| drum.curvature[&n].second;
    assert_eq!((second(3), second(4), second(64)), (Second::Flat, Second::Regular, Second::No));
    let (_, octahedron) = found("octahedron", LOOP);
    assert_eq!((octahedron.curvature[&4].size, octahedron.curvature[&4].second), (Size::Bounded, Second::No));
}

fn secant() -> Command {
    Command::cargo_bin("secant").unwrap()
}

#[test]
fn the_command_line() {
    let dir = tempfile::tempdir().unwrap();
    let (report, ply, svg) = (dir.path().join("r.html"), dir.path().join("m.ply"), dir.path().join("m.svg"));
    let run = secant()
        .args(["certify", "--scheme", "catmull-clark", "--json", "--report"])
        .args([&report, Path::new("--ply"), &ply, Path::new("--svg"), &svg, &file("folded")])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(1), "{}", String::from_utf8_lossy(&run.stderr));
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!((&json["regular"], &json["smooth"]), (&"refuted".into(), &"undetermined".into()));
    assert_eq!(json["vertices"].as_array().unwrap().len(), 72);
    assert_eq!(json["vertices"][18]["line"], 20);
    let text = |path: &Path| std::fs::read_to_string(path).unwrap();
    assert!(text(&report).contains("<svg") && text(&report).contains("vertex 19 (line 20)"));
    assert!(text(&ply).contains("element vertex 72") && text(&ply).contains(" 122 79 181\n"));
    assert_eq!(text(&svg).matches("<polygon").count(), 72);
    let run = secant().args(["certify", "--scheme", "loop", "-q"]).arg(file("octahedron")).output().unwrap();
    assert_eq!((run.status.code(), run.stdout.len()), (Some(0), 0));
    let run = secant().args(["certify", "--scheme", "catmull-clark"]).arg(file("cube")).output().unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(text.contains("proved: the limit surface of this mesh is a regular C¹ surface"));
    let words: Vec<&str> = text.split_whitespace().collect();
    assert!(words.join(" ").contains("The independent checker proved the claims again, from the file itself"));
    let run = secant().args(["certify", "--scheme", "catmull-clark", "--no-check"]).arg(file("cube")).output().unwrap();
    assert!(String::from_utf8(run.stdout).unwrap().contains("The independent checker was not asked"));
}

/// A binary PLY file of a mesh: doubles as coordinates, and a colour at each point that is passed over.
fn binary_ply(points: &[[f64; 3]], faces: &[Vec<i32>], little: bool) -> Vec<u8> {
    let (count, all) = (points.len(), faces.len());
    let format = if little { "little" } else { "big" };
    let mut bytes = format!(
        "ply\nformat binary_{format}_endian 1.0\ncomment made here\nelement vertex {count}\nproperty double x\n\
         property double y\nproperty double z\nproperty uchar red\nelement face {all}\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let mut put = |mut own: Vec<u8>| {
        if !little {
            own.reverse();
        }
        bytes.extend(own);
    };
    for p in points {
        p.iter().for_each(|x| put(x.to_le_bytes().to_vec()));
        put(vec![200]);
    }
    for face in faces {
        put(vec![face.len() as u8]);
        face.iter().for_each(|v| put(v.to_le_bytes().to_vec()));
    }
    bytes
}

/// The same mesh in all formats has the same answers; what is wrong with a binary file is said with the number of the item.
#[test]
fn ply_files() {
    let dir = tempfile::tempdir().unwrap();
    let points = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]];
    let faces: Vec<Vec<i32>> = vec![vec![0, 3, 1], vec![0, 1, 2], vec![0, 2, 3], vec![1, 3, 2]];
    let read = |name: &str, bytes: &[u8]| {
        let path = dir.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        Model::read(&path)
    };
    let plain = Model::read(&file("tetrahedron")).unwrap();
    let good = binary_ply(&points, &faces, true);
    let ascii = "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n\
        element face 4\r\nproperty list uchar uint vertex_index\r\nend_header\r\n1 1 1\r\n-1 -1 1\r\n-1 1 -1\r\n1 -1 -1\r\n\
        3 0 3 1\r\n3 0 1 2\r\n3 0 2 3\r\n3 1 3 2\r\n";
    for model in
        [read("l.ply", &good), read("b.ply", &binary_ply(&points, &faces, false)), read("a.ply", ascii.as_bytes())]
    {
        let model = model.unwrap();
        assert_eq!(model.points, plain.points);
        assert_eq!(model.topology.polygon(3), plain.topology.polygon(3));
        let found = certify(&model, LOOP, &Budget::default(), &|| {}).unwrap();
        assert_eq!(found.regular(), Proved);
        let certificate = secant::certificate::confirm_mesh(&model, LOOP, &found);
        assert_eq!(certificate.is_ok(), model.text.is_some());
    }
    // Decimals of ASCII are decimals, floats are what they are.
    let tenth = read("t.ply", ascii.replace("-1 -1 1", "-1 -1 0.1").as_bytes()).unwrap();
    assert_eq!(tenth.points[1][2].to_string(), "1/10");
    let mut moved = points;
    moved[1][2] = 0.1;
    let tenth = read("t.ply", &binary_ply(&moved, &faces, true)).unwrap();
    assert_eq!(tenth.points[1][2].to_string(), "3602879701896397/36028797018963968");
    moved[1][2] = f64::NAN;
    let mut beyond = faces.clone();
    beyond[2][1] = 4;
    let without_values = "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n\
        element face 0\nproperty list uchar int vertex_indices\nelement nothing 1000000000000000\nend_header\n";
    for (bytes, line, words) in [
        (good[..good.len() - 3].to_vec(), 9, "face 3"),
        (binary_ply(&moved, &faces, true), 4, "vertex 1"),
        (binary_ply(&points, &beyond, true), 9, "face 2"),
        (ascii.replace("3 1 3 2", "3 1 3").into_bytes(), 17, "not the values"),
        (ascii.replace("3 1 3 2", "3 1 3 4").into_bytes(), 17, "names no vertex"),
        (ascii.replace("3 1 3 2\r\n", "").into_bytes(), 17, "too early"),
        (ascii.replace("float x", "float w").into_bytes(), 17, "no x, y, z"),
        (ascii.replace("ascii 1.0", "ascii 2.0").into_bytes(), 2, "no part of a header"),
        // Nothing to read, ten to the fifteenth times.
        (without_values.as_bytes().to_vec(), 1, "has no properties"),
    ] {
        let problem = read("bad.ply", &bytes).unwrap_err();
        let at = problem.position().map(|p| p.0);
        assert!(at == Some(line) || line == 17 && at == Some(18), "{words}: {at:?}");
        assert!(format!("{problem}").contains(words) && problem.remedy().is_some(), "{problem}");
    }
    // A comment in another encoding.
    let mut latin = b"# caf\xe9\n".to_vec();
    latin.extend(std::fs::read(file("tetrahedron")).unwrap());
    assert_eq!(read("latin.obj", &latin).unwrap().points, plain.points);
}

/// A mesh that is C¹ at its vertices, with patches that are not regular: the checker does not say that the whole surface is.
#[test]
fn a_surface_that_is_not_regular_is_not_certified() {
    let text = std::fs::read_to_string(file("icosahedron")).unwrap();
    // The first two vertices change places.
    let text = text.replacen("v 0 1 1.618034\nv 0 -1 1.618034", "v 0 -1 1.618034\nv 0 1 1.618034", 1);
    let model = Model::parse(&secant::diagnostic::SourceText::new("moved.obj", text), false).unwrap();
    for (rule, count) in [(LOOP, 12), (QUADS, 32)] {
        let found = certify(&model, rule, &Budget::default(), &|| {}).unwrap();
        assert_eq!(found.smooth(), Proved);
        assert_ne!(found.regular(), Proved);
        let certificate = secant::certificate::confirm_mesh(&model, rule, &found).unwrap();
        assert_eq!(certificate.json()["proof"]["limits"].as_array().unwrap().len(), count);
        let mut forged = certificate.json().clone();
        forged["proof"]["whole"] = "regular".into();
        let rejected = secant_check::check(model.text.as_ref().unwrap(), &forged.to_string()).unwrap_err();
        assert_eq!((rejected.rule.as_str(), rejected.place.as_str()), ("limit", "proof.whole"), "{rejected}");
    }
}

/// The certificates of all meshes: how many limits they list, whether the whole surface is in them, and what is left out.
#[test]
fn certificates_of_meshes() {
    let answers: [(&str, Scheme, Option<(usize, usize)>, bool, usize); 15] = [
        ("cube", QUADS, Some((8, 8)), true, 0),
        ("tetrahedron", QUADS, Some((8, 8)), true, 0),
        ("octahedron", QUADS, Some((14, 14)), true, 0),
        ("icosahedron", QUADS, Some((32, 32)), true, 0),
        ("torus", QUADS, Some((60, 60)), true, 0),
        ("klein", QUADS, Some((192, 192)), true, 0),
        ("octahedron", LOOP, Some((6, 6)), true, 0),
        ("icosahedron", LOOP, Some((12, 12)), true, 0),
        ("tetrahedron", Scheme::LoopWarren, Some((4, 4)), true, 0),
        ("valence-64", QUADS, Some((258, 258)), false, 0),
        ("folded", QUADS, Some((60, 72)), true, 0),
        ("line", QUADS, Some((0, 14)), false, 0),
        ("line", LOOP, Some((0, 6)), false, 0),
        ("plane", QUADS, Some((16, 36)), false, 0),
        ("strip", QUADS, None, false, 0),
    ];
    for (name, rule, listed, whole, left_out) in answers {
        let (model, found) = found(name, rule);
        let certificate = match (secant::certificate::confirm_mesh(&model, rule, &found), listed) {
            (Ok(certificate), Some(_)) => certificate,
            (Err(secant::certificate::Doubt::Unsupported(_)), None) => continue,
            (other, _) => panic!("{name} by {}: {other:?}", rule.name()),
        };
        let proof = &certificate.json()["proof"];
        let limits = proof["limits"].as_array().unwrap();
        let own = Some((limits.iter().filter(|l| !l.is_null()).count(), limits.len()));
        assert_eq!((own, !proof["whole"].is_null()), (listed, whole), "{name} by {}", rule.name());
        assert_eq!(certificate.left_out().len(), left_out, "{name}: {:?}", certificate.left_out());
        assert_eq!(certificate.json()["verdict"], found.smooth().word(), "{name} by {}", rule.name());
    }
}

#[test]
fn what_does_not_go_with_a_mesh_is_refused() {
    for (args, code) in [
        (vec!["--scheme", "loop"], "secant::mesh::triangles"),
        (vec![], "secant::usage::scheme"),
        (vec!["--scheme", "butterfly"], "secant::usage::scheme"),
        (vec!["--scheme", "none"], "secant::usage::scheme"),
        (vec!["--scheme", "catmull-clark", "--valence", "5"], "secant::usage"),
    ] {
        let run = secant().arg("certify").arg(file("cube")).args(&args).output().unwrap();
        let text = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && text.contains(code), "{args:?}: {text}");
    }
    let run = secant().args(["certify", "cases/thesis/half-tangent.toml", "--ply", "m.ply"]).output().unwrap();
    assert_eq!(run.status.code(), Some(2));
}
