//! Every case under `cases/` is certified and compared with what its file expects.

mod corpus;

use corpus::case_files;
use secant::arith::Rational;
use secant::case::{Case, ExpectPoint, expected_error};
use secant::report::claims;
use secant::shape::Contraction;
use secant::theorem::surface::{Subspace, SurfacePoint, certify_complex};
use secant::theorem::{Certified, Direction, PointReport, Verdict};
use std::path::Path;

#[test]
fn every_case_comes_out_as_its_file_expects() {
    let mut files = Vec::new();
    case_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases"), &mut files);
    assert!(files.len() >= 60, "the corpus has only {} cases", files.len());
    let wrong: Vec<String> = files.iter().flat_map(|path| mistakes(path)).collect();
    assert!(wrong.is_empty(), "{} mistakes in {} cases:\n{}", wrong.len(), files.len(), wrong.join("\n"));
}

fn mistakes(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path).unwrap();
    let label = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap().display().to_string();
    let code = match Case::read(path) {
        Err(problem) => miette::Diagnostic::code(&problem).map(|c| c.to_string()),
        Ok(case) => match certify_complex(&case.complex(), &case.examine) {
            Err(error) => Some(error.code().to_owned()),
            Ok(found) => {
                return match &case.expect {
                    _ if expected_error(&text).is_some() => vec![format!("{label}: should be refused")],
                    None => vec![format!("{label}: expects nothing")],
                    Some(_) => compare(&case, &found).into_iter().map(|m| format!("{label}: {m}")).collect(),
                };
            }
        },
    };
    let wanted = expected_error(&text)
        .or_else(|| label.starts_with("cases/refused/empty").then(|| "secant::case::empty".to_owned()));
    if code == wanted { Vec::new() } else { vec![format!("{label}: refused with {code:?}, expected {wanted:?}")] }
}

fn compare(case: &Case, found: &Certified) -> Vec<String> {
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

fn compare_point(expect: &ExpectPoint, found: &PointReport) -> Vec<String> {
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
