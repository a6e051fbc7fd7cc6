//! Every case under `cases/` is a test of its own name: it is certified once and compared with what its file expects, and its
//! certificate is proved again by the independent checker. `cargo test --test cases -- surfaces/` runs those of a directory.
//! `SECANT_WRITE_CERTIFICATES=DIR` keeps the certificates.

mod corpus;

use libtest_mimic::{Arguments, Failed, Trial};
use secant::answer::Verdict;
use secant::arith::Rational;
use secant::budget::Budget;
use secant::case::{Case, ExpectPoint, Question, Valences, VertexCase, expected_error};
use secant::certificate::{Certificate, Doubt};
use secant::prove::{Findings, confirm, prove, unconfirmed};
use secant::report::claims;
use secant::report::reported::Reported;
use secant::shape::Contraction;
use secant::theorem::surface::{Subspace, SurfacePoint};
use secant::theorem::{Certified, Direction, PointReport};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut files = Vec::new();
    corpus::all_files(&root, &mut files);
    let name = |path: &Path| path.strip_prefix(&root).map(|p| p.with_extension("").display().to_string());
    let mut trials: Vec<Trial> = files
        .iter()
        .map(|path| {
            let path = path.clone();
            Trial::test(name(&path).expect("a file below cases"), move || passes(&path))
        })
        .collect();
    // A corpus that shrinks, or that is not found, is no success.
    let count = files.len();
    trials.push(Trial::test("the_corpus_is_there", move || {
        if count >= 235 { Ok(()) } else { Err(format!("only {count} cases").into()) }
    }));
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

fn passes(path: &Path) -> Result<(), Failed> {
    let wrong = mistakes(path);
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}

fn mistakes(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path).expect("the case can be read");
    let wanted = expected_error(&text).or_else(|| {
        path.file_stem().is_some_and(|s| s == "empty" || s == "empty-comment").then(|| "secant::case::empty".to_owned())
    });
    let refused = |code: Option<&str>| match (code, wanted.as_deref()) {
        (code, wanted) if code == wanted => Vec::new(),
        (code, wanted) => vec![format!("refused with {code:?}, expected {wanted:?}")],
    };
    let question = match Question::read(path) {
        Err(problem) => return refused(Some(problem.id())),
        Ok(Question::Vertices { case, .. }) => expected_valences(case),
        Ok(question) => question,
    };
    let mut findings = match prove(&question, &Budget::default()) {
        Err(problem) => return refused(Some(problem.id())),
        Ok(findings) => findings,
    };
    if let Some(code) = wanted {
        return vec![format!("should be refused with {code}")];
    }
    let mut wrong = match &findings {
        Findings::Tangents { case, .. } if case.expect.is_none() => vec!["expects nothing".to_owned()],
        Findings::Tangents { case, found } => compare(case, found),
        Findings::OverField { case, .. } if case.expect.is_none() => vec!["expects nothing".to_owned()],
        Findings::OverField { case, found } => compare(case, found),
        Findings::Vertices { case, .. } if case.expect.is_empty() => vec!["expects nothing".to_owned()],
        Findings::Vertices { case, found, .. } => {
            let differs = |(n, verdict): &(usize, Verdict)| match found.iter().find(|f| f.valence == *n) {
                Some(f) if f.smooth == *verdict => None,
                Some(f) => Some(format!("valence {n}: {} instead of {verdict}: {:?}", f.smooth, f.reason)),
                None => Some(format!("valence {n} was not examined")),
            };
            case.expect.iter().filter_map(differs).collect()
        }
        _ => vec!["findings of an unknown kind".to_owned()],
    };
    wrong.extend(again(path, &mut findings).err());
    wrong
}

/// The question at the valences for which the file expects something.
fn expected_valences(case: Arc<VertexCase>) -> Question {
    let mut list: Vec<usize> = case.expect.iter().map(|(n, _)| *n).collect();
    list.sort_unstable();
    Question::Vertices { case, valences: Some(Valences::List(list)) }
}

/// Has the certificate proved again. Tangents always have one, also where only some points are decided.
fn again(path: &Path, findings: &mut Findings) -> Result<(), String> {
    let tangents = matches!(findings, Findings::Tangents { .. });
    match confirm(findings) {
        Ok(certificate) => keep(path, &certificate),
        Err(Doubt::Unsupported(_)) if !tangents => Ok(()),
        Err(doubt) => Err(format!("{doubt} {:?}", unconfirmed(findings).err())),
    }
}

fn keep(path: &Path, certificate: &Certificate) -> Result<(), String> {
    let Ok(dir) = std::env::var("SECANT_WRITE_CERTIFICATES") else { return Ok(()) };
    let part = |p: Option<&std::ffi::OsStr>| p.map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let name = format!("{}--{}.json", part(path.parent().and_then(Path::file_name)), part(path.file_stem()));
    std::fs::write(Path::new(&dir).join(name), certificate.text()).map_err(|error| error.to_string())
}

fn compare<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Vec<String> {
    let expect = case.expect.as_ref().unwrap();
    let mut wrong = Vec::new();
    if expect.verdict.as_deref().is_some_and(|v| v != found.verdict.word()) {
        let reasons: Vec<_> = found.claims.iter().filter_map(|c| claims::reason(case, found, c)).collect();
        wrong.push(format!("verdict {} instead of {:?} {reasons:?}", found.verdict.word(), expect.verdict));
    }
    let contraction = match found.contraction {
        Contraction::Proved(_) | Contraction::Polytopes(_) | Contraction::Product(_) => "proved",
        Contraction::Refuted { .. } => "refuted",
        Contraction::Undetermined { .. } => "undetermined",
    };
    if expect.contraction.as_deref().is_some_and(|c| c != contraction) {
        wrong.push(format!("contraction {contraction}"));
    }
    if let Some(surface) = &found.surface {
        for point in &expect.points {
            let address = point.address.normalise(&case.shape, case.shape.start).unwrap();
            let here = surface.points.iter().find(|p| p.branches.iter().any(|b| b.address == address));
            match here {
                None => wrong.push(format!("point {address} was not examined")),
                Some(p) => wrong.extend(compare_surface(point, p).into_iter().map(|m| format!("point {address}: {m}"))),
            }
        }
        return wrong;
    }
    for point in &expect.points {
        let address = point.address.normalise(&case.shape, case.shape.start).unwrap();
        let here = found.points.iter().find(|p| {
            p.branches.iter().any(|b| b.address.normalise(&case.shape, case.shape.start).as_ref() == Ok(&address))
        });
        match here {
            None => wrong.push(format!("point {address} was not examined")),
            Some(p) => wrong.extend(compare_point(point, p).into_iter().map(|m| format!("point {address}: {m}"))),
        }
    }
    wrong
}

fn compare_surface(expect: &ExpectPoint, found: &SurfacePoint) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut check = |what: &str, wanted: Option<String>, got: String| {
        if wanted.as_ref().is_some_and(|w| *w != got) {
            wrong.push(format!("{what} is {got}, expected {} ({:?})", wanted.unwrap_or_default(), found.reason));
        }
    };
    let kind = match found.verdict {
        Verdict::Proved => "tangent-plane",
        Verdict::Refuted => "no tangent plane",
        Verdict::Undetermined => "undetermined",
    };
    check("kind", expect.kind.clone(), kind.to_owned());
    check("verdict", expect.verdict.clone(), found.verdict.word().to_owned());
    check("dimension", expect.dimension.map(|d| d.to_string()), found.dimension.at_least.to_string());
    if let Some(wanted) = &expect.plane {
        let line = |v: &Vec<Rational>| Direction {
            root: secant::algebraic::Root::from_rational(&Rational::from(0)),
            coords: v.iter().map(secant::algebraic::Elem::from_rational).collect(),
        };
        let wanted = Subspace { generators: wanted.iter().map(line).collect() };
        let ok = found.tangent.as_ref().is_some_and(|t| t.same(&wanted) == Some(true));
        check(
            "plane",
            Some("as expected".into()),
            if ok { "as expected".into() } else { format!("{:?}", found.tangent) },
        );
    }
    wrong
}

fn compare_point<E: Reported>(expect: &ExpectPoint, found: &PointReport<E>) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut check = |what: &str, wanted: Option<String>, got: String| {
        if wanted.as_ref().is_some_and(|w| *w != got) {
            wrong.push(format!("{what} is {got}, expected {} ({:?})", wanted.unwrap_or_default(), found.reason));
        }
    };
    check("kind", expect.kind.clone(), found.kind.word().to_owned());
    check("verdict", expect.verdict.clone(), found.verdict.word().to_owned());
    check("dimension", expect.dimension.map(|d| d.to_string()), found.dimension.at_least.to_string());
    if let Some(wanted) = &expect.tangent {
        let ok = found.tangent.as_ref().is_some_and(|t| parallel(t, wanted) != 0);
        check(
            "tangent",
            Some("as expected".into()),
            if ok { "as expected".into() } else { shown(found.tangent.iter()) },
        );
    }
    for (side, wanted, got) in [("left", &expect.left, &found.left), ("right", &expect.right, &found.right)] {
        if let Some(wanted) = wanted {
            let ok = wanted.len() == got.len() && wanted.iter().all(|w| got.iter().any(|g| parallel(g, w) > 0));
            check(side, Some("as expected".into()), if ok { "as expected".into() } else { shown(got.iter()) });
        }
    }
    wrong
}

fn shown<'a>(rays: impl Iterator<Item = &'a Direction>) -> String {
    rays.map(|d| format!("{:?}", d.rational().unwrap_or_default())).collect::<Vec<_>>().join(" and ")
}

/// `1` for the same ray, `-1` for opposite rays, `0` for different lines.
fn parallel(direction: &Direction, wanted: &[Rational]) -> i32 {
    let wanted = Direction {
        root: direction.root.clone(),
        coords: wanted.iter().map(secant::algebraic::Elem::from_rational).collect(),
    };
    direction.same_line(&wanted).unwrap_or(0)
}
