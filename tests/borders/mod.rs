//! Borders, creases and corners: every row of the table, limits against fans refined in floats, the rules against a second
//! implementation that counts sharp edges.

use oorandom::Rand64;
use secant::answer::Verdict::{self, Proved, Refuted, Undetermined};
use secant::budget::Budget;
use secant::diagnostic::SourceText;
use secant::mesh::{AtVertex, Boundary, Found, Kind, Model, Reason, Scheme, Spot, certify, refined};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

type P = [f64; 3];

fn mix(terms: &[(f64, P)]) -> P {
    std::array::from_fn(|k| terms.iter().map(|(w, p)| w * p[k]).sum())
}

fn minus(a: P, b: P) -> P {
    mix(&[(1.0, a), (-1.0, b)])
}

fn cross(a: P, b: P) -> P {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: P) -> P {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}

fn far(a: P, b: P) -> f64 {
    minus(a, b).iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// A fan of random points: the vertex, its neighbours, and of quadrangles the opposite corners.
struct Fan {
    own: P,
    spokes: Vec<P>,
    across: Vec<P>,
    smooth: bool,
}

impl Fan {
    fn random(faces: usize, triangles: bool, smooth: bool, seed: u128) -> Self {
        let mut random = Rand64::new(seed);
        let mut point = || -> P { [0, 1, 2].map(|_| (random.rand_float() * 64.0).round() / 8.0 - 4.0) };
        let own = point();
        let spokes = (0..=faces).map(|_| point()).collect();
        Self { own, spokes, across: (0..if triangles { 0 } else { faces }).map(|_| point()).collect(), smooth }
    }

    fn obj(&self) -> String {
        let mut text = String::new();
        let mut point = |p: &P| writeln!(text, "v {} {} {}", p[0], p[1], p[2]).unwrap();
        point(&self.own);
        self.spokes.iter().for_each(&mut point);
        self.across.iter().for_each(&mut point);
        let n = self.spokes.len();
        for k in 0..n - 1 {
            let middle = if self.across.is_empty() { String::new() } else { format!("{} ", 2 + n + k) };
            writeln!(text, "f 1 {} {middle}{}", 2 + k, 3 + k).unwrap();
        }
        text += "t interpolateboundary 1/0/0 2\n";
        if !self.smooth {
            text += "t corner 1/1/0 0 10\n";
        }
        text
    }

    fn found(&self) -> AtVertex {
        let scheme = if self.across.is_empty() { Scheme::Loop } else { Scheme::CatmullClark };
        at(&certified(&self.obj(), scheme), 0).clone()
    }

    /// One step, in coordinates around the new vertex, which is returned.
    fn step(&mut self) -> P {
        let (n, e) = (self.spokes.len(), &self.spokes);
        let half = |p: &P| p.map(|x| x / 2.0);
        let new = if self.smooth { mix(&[(0.125, e[0]), (0.125, e[n - 1])]) } else { [0.0; 3] };
        let f: Vec<P> =
            self.across.iter().enumerate().map(|(k, f)| mix(&[(0.25, *f), (0.25, e[k]), (0.25, e[k + 1])])).collect();
        let spokes: Vec<P> = (0..n)
            .map(|k| match k {
                0 => half(&e[0]),
                k if k == n - 1 => half(&e[k]),
                k if f.is_empty() => mix(&[(0.375, e[k]), (0.125, e[k - 1]), (0.125, e[k + 1])]),
                k => mix(&[(0.25, e[k]), (0.25, f[k - 1]), (0.25, f[k])]),
            })
            .collect();
        self.spokes = spokes.into_iter().map(|p| minus(p, new)).collect();
        self.across = f.into_iter().map(|p| minus(p, new)).collect();
        new
    }

    /// The limit point, and the normal after so many steps: from the border and the sum of the points inside.
    fn refined(&mut self, steps: usize) -> (P, P) {
        let own = self.own;
        for p in self.spokes.iter_mut().chain(&mut self.across) {
            *p = minus(*p, own);
        }
        let mut limit = own;
        for _ in 0..steps {
            limit = mix(&[(1.0, limit), (1.0, self.step())]);
        }
        let n = self.spokes.len();
        let inside =
            self.spokes[1..n - 1].iter().chain(&self.across).fold([0.0; 3], |s, p| mix(&[(1.0, s), (1.0, *p)]));
        let normal = if self.smooth {
            cross(unit(minus(self.spokes[0], self.spokes[n - 1])), unit(inside))
        } else {
            cross(unit(self.spokes[0]), unit(self.spokes[n - 1]))
        };
        (limit, unit(normal))
    }
}

fn certified(text: &str, scheme: Scheme) -> Found {
    let model = Model::parse(&SourceText::new("m.obj", text), false).unwrap();
    certify(&model, scheme, &Budget::default(), &|| {}).unwrap()
}

fn at(found: &Found, k: usize) -> &AtVertex {
    found.vertices.iter().find(|v| v.spot == Spot::Vertex(k)).unwrap()
}

/// The rows of the table, by the number of faces: `p` proved, `r` refuted.
const ROWS: [(bool, bool, &str); 4] = [
    (false, true, "pppprrrrrrrr"),
    (true, true, "pppppprrrrrr"),
    (false, false, "pprrrrrrrrrr"),
    (true, false, "ppprrrrrrrrr"),
];

#[test]
fn limits_and_normals_of_every_row() {
    for (triangles, smooth, row) in ROWS {
        for (k, letter) in row.chars().enumerate() {
            let faces = k + 1;
            let mut fan = Fan::random(faces, triangles, smooth, 7 + k as u128);
            let found = fan.found();
            let place = format!("triangles {triangles}, smooth {smooth}, {faces} faces");
            assert_eq!(found.smooth, if letter == 'p' { Proved } else { Refuted }, "{place}: {:?}", found.reason);
            let limit = found.limit.unwrap();
            // With a Jordan block normals converge like 1/m.
            let slow = smooth && faces == if triangles { 6 } else { 4 } || smooth && faces == 1 && !triangles;
            let (point, normal) = fan.refined(900);
            assert!(far(point, limit.near.map(|x| x.mid())) < 1e-9, "{place}");
            let Some(unit) = limit.unit else {
                assert_eq!(letter, 'r', "{place}");
                continue;
            };
            if smooth && faces == 1 {
                // The points inside tend to the border: what decides is the difference.
                let fan = Fan::random(faces, triangles, smooth, 7 + k as u128);
                let bend = minus(mix(&[(0.5, fan.spokes[0]), (0.5, fan.spokes[1])]), fan.own);
                let osculating = self::unit(cross(minus(fan.spokes[0], fan.spokes[1]), bend));
                assert!(far(osculating, unit) < 1e-9, "{place}");
                continue;
            }
            assert!(far(normal, unit) < if slow { 2e-2 } else { 1e-6 }, "{place}: {normal:?} {unit:?}");
        }
    }
}

/// Where a row is refuted, the normals inside keep an angle with those on the border.
#[test]
fn refuted_fans_have_two_normals() {
    for (faces, triangles) in [(5, false), (6, false), (7, true)] {
        let mut fan = Fan::random(faces, triangles, true, 3);
        // Not more steps: the second direction would be lost in the rounding of the first.
        let (_, border) = fan.refined(70);
        let e = &fan.spokes;
        let inside = unit(cross(e[1], minus(e[2], e[1])));
        let angle = border.iter().zip(&inside).map(|(a, b)| a * b).sum::<f64>().abs().acos().to_degrees();
        assert!(angle > 2.0, "{faces}: {angle}");
    }
}

/// A plane net is not refuted, and a fan on a line has no tangent plane.
#[test]
fn plane_fans_and_lines() {
    for (faces, smooth) in [(5, true), (3, false)] {
        let mut fan = Fan::random(faces, false, smooth, 5);
        fan.own[2] = 0.0;
        fan.spokes.iter_mut().chain(&mut fan.across).for_each(|p| p[2] = 0.0);
        let found = fan.found();
        assert_eq!((found.smooth, found.reason), (Undetermined, Reason::Flat));
        fan.spokes.iter_mut().chain(&mut fan.across).for_each(|p| p[1] = 0.0);
        fan.own[1] = 0.0;
        let found = fan.found();
        assert_eq!((found.smooth, found.reason), (Refuted, Reason::Line));
    }
    // One quadrangle whose border has no curvature there: the plane of the next order.
    let text = "v 0 0 0\nv 2 0 0\nv 0 3 5\nv -2 0 0\nf 1 2 3 4\nt interpolateboundary 1/0/0 2\n";
    let found = certified(text, Scheme::CatmullClark);
    let found = at(&found, 0);
    assert_eq!(found.smooth, Proved);
    let length = 34.0_f64.sqrt();
    assert!(far(found.limit.as_ref().unwrap().unit.unwrap(), [0.0, -5.0 / length, 3.0 / length]) < 1e-12);
}

/// Faces and points in floats, with sharpness; a border edge, and what is sharp for ever, has a very large one.
struct Naive {
    points: Vec<P>,
    faces: Vec<Vec<usize>>,
    sharp: BTreeMap<(usize, usize), f64>,
    fixed: BTreeMap<usize, f64>,
}

const FOR_EVER: f64 = 1e9;

fn key(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

fn mean(all: &[P]) -> P {
    mix(&all.iter().map(|p| (1.0 / all.len() as f64, *p)).collect::<Vec<_>>())
}

fn less(s: f64) -> f64 {
    if s >= 10.0 { FOR_EVER } else { s - 1.0 }
}

type Edges = BTreeMap<(usize, usize), Vec<usize>>;

impl Naive {
    fn middle(&self, f: usize) -> P {
        mean(&self.faces[f].iter().map(|v| self.points[*v]).collect::<Vec<_>>())
    }

    fn sharpness(&self, e: &(usize, usize), faces: &[usize]) -> f64 {
        if faces.len() == 1 { FOR_EVER } else { self.sharp.get(e).copied().unwrap_or(0.0) }
    }

    /// The vertex by the rule for given sharpness of its edges and itself.
    fn ruled(&self, v: usize, own: &[((usize, usize), Vec<usize>, f64)], fixed: f64, triangles: bool) -> (u8, P) {
        let other = |e: &(usize, usize)| self.points[if e.0 == v { e.1 } else { e.0 }];
        let hard: Vec<P> = own.iter().filter(|e| e.2 > 0.0).map(|e| other(&e.0)).collect();
        let (n, p) = (own.len() as f64, self.points[v]);
        let ring = mean(&own.iter().map(|e| other(&e.0)).collect::<Vec<_>>());
        if fixed > 0.0 || hard.len() > 2 {
            (2, p)
        } else if hard.len() == 2 {
            (1, mix(&[(0.75, p), (0.125, hard[0]), (0.125, hard[1])]))
        } else if triangles {
            let share = 0.375 + (2.0 * std::f64::consts::PI / n).cos() / 4.0;
            (0, mix(&[(0.375 + share * share, p), (0.625 - share * share, ring)]))
        } else {
            let around: BTreeSet<usize> = own.iter().flat_map(|e| e.1.iter().copied()).collect();
            let faces = mean(&around.iter().map(|f| self.middle(*f)).collect::<Vec<_>>());
            (0, mix(&[(1.0 / n, faces), (1.0 / n, ring), ((n - 2.0) / n, p)]))
        }
    }

    fn vertex(&self, v: usize, edges: &Edges, triangles: bool) -> P {
        let own = edges.iter().filter(|((a, b), _)| *a == v || *b == v);
        let now: Vec<_> = own.map(|(e, f)| (*e, f.clone(), self.sharpness(e, f))).collect();
        let fixed = self.fixed.get(&v).copied().unwrap_or(0.0);
        let later: Vec<_> = now.iter().map(|(e, f, s)| (*e, f.clone(), less(*s))).collect();
        let (before, after) = (self.ruled(v, &now, fixed, triangles), self.ruled(v, &later, less(fixed), triangles));
        if before.0 == after.0 || before.0 == 0 {
            return before.1;
        }
        let ending: Vec<f64> = now.iter().map(|e| e.2).chain([fixed]).filter(|s| *s > 0.0 && *s <= 1.0).collect();
        let share = ending.iter().sum::<f64>() / ending.len() as f64;
        mix(&[(share, before.1), (1.0 - share, after.1)])
    }

    fn step(&self, triangles: bool) -> Self {
        let mut edges: Edges = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for k in 0..face.len() {
                edges.entry(key(face[k], face[(k + 1) % face.len()])).or_default().push(f);
            }
        }
        let mut points: Vec<P> = (0..self.points.len()).map(|v| self.vertex(v, &edges, triangles)).collect();
        let mut number = BTreeMap::new();
        let mut sharp = BTreeMap::new();
        for (e, f) in &edges {
            let (p, q) = (self.points[e.0], self.points[e.1]);
            number.insert(*e, points.len());
            let s = self.sharpness(e, f);
            sharp.extend([e.0, e.1].map(|v| (key(v, points.len()), less(s))));
            let straight = mean(&[p, q]);
            points.push(if s >= 1.0 {
                straight
            } else {
                let round = if triangles {
                    let across =
                        |f: &usize| self.points[*self.faces[*f].iter().find(|v| **v != e.0 && **v != e.1).unwrap()];
                    mix(&[(0.375, p), (0.375, q), (0.125, across(&f[0])), (0.125, across(&f[1]))])
                } else {
                    mean(&[p, q, self.middle(f[0]), self.middle(f[1])])
                };
                let s = s.max(0.0);
                mix(&[(s, straight), (1.0 - s, round)])
            });
        }
        let mut faces = Vec::new();
        for (f, face) in self.faces.iter().enumerate() {
            let n = face.len();
            let edge = |k: usize| number[&key(face[k % n], face[(k + 1) % n])];
            for (k, v) in face.iter().enumerate() {
                let middle = (!triangles).then_some(points.len());
                faces.push([*v, edge(k)].into_iter().chain(middle).chain([edge(k + n - 1)]).collect());
            }
            if triangles {
                faces.push((0..n).map(edge).collect());
            } else {
                points.push(self.middle(f));
            }
        }
        Self { points, faces, sharp, fixed: self.fixed.iter().map(|(v, s)| (*v, less(*s))).collect() }
    }
}

fn sorted(points: &[P], used: impl Iterator<Item = usize>) -> BTreeSet<[i64; 3]> {
    used.map(|v| points[v].map(|x| (x * 1e7).round() as i64)).collect()
}

/// The rules on a whole mesh: the same points as those of an implementation that shares no code.
#[test]
fn rules_agree_with_a_count_of_sharp_edges() {
    let cube = std::fs::read_to_string(super::file("cube")).unwrap();
    let octahedron = std::fs::read_to_string(super::file("octahedron")).unwrap();
    let strip = std::fs::read_to_string(super::file("strip")).unwrap();
    let loop_of = "t crease 2/1/0 4 5 10\nt crease 2/1/0 5 6 10\nt crease 2/1/0 6 7 10\nt crease 2/1/0 7 4 12.5\n";
    // A dart–dart edge, a corner between three edges that end at darts, a fixed vertex.
    let darts = "t crease 2/1/0 6 5 10\nt crease 2/1/0 6 7 10\nt crease 2/1/0 6 2 10\nt crease 2/1/0 0 3 10\n";
    let single = "t crease 2/1/0 0 2 10\nt corner 1/1/0 5 10\n";
    for (text, tags, triangles) in [
        (&cube, loop_of, false),
        (&cube, darts, false),
        (&octahedron, single, true),
        (&octahedron, "t crease 4/1/0 0 2 2 1 10\nt corner 1/1/0 4 11\n", true),
        (&strip, "t interpolateboundary 1/0/0 1\nt crease 2/1/0 2 3 10\n", false),
        (&strip, "t interpolateboundary 1/0/0 2\n", false),
        // Sharp for some steps: alone, at a vertex, beside an edge that stays sharp, and running into a border.
        (
            &cube,
            "t crease 2/1/0 4 5 2.5\nt crease 2/1/0 5 6 1.25\nt crease 2/1/0 6 7 0.5\nt corner 1/1/0 0 1.75\n",
            false,
        ),
        (&cube, "t crease 2/1/0 4 5 10\nt crease 2/1/0 5 6 1.5\nt crease 2/1/0 6 2 10\nt crease 2/1/0 6 7 10\n", false),
        (&octahedron, "t crease 2/1/0 0 2 0.25\nt crease 2/1/0 2 1 1.5\nt crease 2/1/0 2 4 1.5\n", true),
        (&strip, "t interpolateboundary 1/0/0 2\nt crease 2/1/0 2 3 1.5\n", false),
    ] {
        let text = format!("{text}{tags}");
        let model = Model::parse(&SourceText::new("m.obj", text.as_str()), false).unwrap();
        let scheme = if triangles { Scheme::Loop } else { Scheme::CatmullClark };
        let number = |v: &u32| *v as usize;
        let faces: Vec<Vec<usize>> =
            (0..model.topology.faces()).map(|f| model.topology.polygon(f).iter().map(number).collect()).collect();
        let number_of = |s: &secant::arith::Rational| secant::arith::to_f64(s);
        let mut fixed: BTreeMap<usize, f64> =
            model.tags.vertices.iter().map(|(v, s)| (*v as usize, number_of(s))).collect();
        if model.tags.boundary == Some(Boundary::EdgeAndCorner) {
            let count = |v: &usize| faces.iter().filter(|f| f.contains(v)).count();
            fixed.extend((0..model.points.len()).filter(|v| count(v) == 1).map(|v| (v, FOR_EVER)));
        }
        let mut naive = Naive {
            points: model.points.iter().map(|p| [0, 1, 2].map(|k| secant::arith::to_f64(&p[k]))).collect(),
            faces,
            sharp: model.tags.edges.iter().map(|((a, b), s)| ((*a as usize, *b as usize), number_of(s))).collect(),
            fixed,
        };
        for _ in 0..3 {
            naive = naive.step(triangles);
        }
        let (points, faces) = refined(&model, scheme, 3);
        assert_eq!(faces.len(), naive.faces.len());
        let own = sorted(&points, faces.iter().flatten().map(|v| *v as usize));
        assert_eq!(own, sorted(&naive.points, naive.faces.iter().flatten().copied()), "{tags}");
    }
}

#[test]
fn meshes_with_borders_and_sharp_edges() {
    let with = |name: &str, tags: &str, scheme: Scheme| {
        certified(&format!("{}{tags}", std::fs::read_to_string(super::file(name)).unwrap()), scheme)
    };
    let quads = Scheme::CatmullClark;
    let (edge, corner) = ("t interpolateboundary 1/0/0 2\n", "t interpolateboundary 1/0/0 1\n");
    let both = |found: &Found| -> (Verdict, Verdict) { (found.smooth(), found.regular()) };
    // Corners are regular; a single face on a smooth border is C¹ there, but its rings have no common bound.
    assert_eq!(both(&with("strip", corner, quads)), (Proved, Proved));
    assert_eq!(both(&with("strip", edge, quads)), (Proved, Undetermined));
    assert_eq!(both(&with("plane", corner, quads)), (Proved, Proved));
    assert_eq!(both(&with("triangle", corner, Scheme::Loop)), (Proved, Proved));
    let crease = with("cube-sharp-loop", "", quads);
    assert_eq!(both(&crease), (Proved, Undetermined));
    let kinds: Vec<Kind> = crease.vertices.iter().map(|v| v.kind).collect();
    let count = |kind: Kind| kinds.iter().filter(|k| **k == kind).count();
    assert_eq!((count(Kind::Inside(3)), count(Kind::Smooth(1)), count(Kind::Smooth(2))), (4, 4, 4));
    assert_eq!((crease.cuts, at(&crease, 6).sides), (4, 2));
    let darts = with("cube-corner", "", quads);
    assert_eq!(at(&darts, 2).reason, Reason::Dart);
    assert_eq!((at(&darts, 6).sides, at(&darts, 6).smooth, at(&darts, 6).kind), (3, Proved, Kind::Corner(1)));
    assert_eq!(with("cube", "t corner 1/1/0 0 10\n", quads).vertices[0].reason, Reason::Tip);
    // Semi-sharp edges are taken by steps; afterwards all is as if there had been none, at other points.
    let soft = with("cube", "t crease 2/1/0 4 5 1.5\n", quads);
    assert_eq!((both(&soft), soft.soft_steps), ((Proved, Proved), 2));
    let model = Model::parse(
        &SourceText::new(
            "m.obj",
            format!("{}t crease 2/1/0 4 5 9.5\n", std::fs::read_to_string(super::file("cube")).unwrap()),
        ),
        false,
    );
    let problem = certify(&model.unwrap(), quads, &Budget::default(), &|| {}).unwrap_err();
    assert_eq!(problem.id(), "secant::mesh::semi-sharp");
}
