//! Systematic tampering: a certificate with one thing changed is rejected, or still proves the same statement.
#![allow(clippy::disallowed_methods, reason = "what a test leaves out proves nothing")]

use secant_check::number::{Q, canonical, whole};
use secant_check::{Accepted, Claim, Decided, Place, Verdict};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

fn stored(kind: &str) -> Vec<(PathBuf, String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs").join(kind);
    let mut names: Vec<PathBuf> = std::fs::read_dir(root).unwrap().map(|e| e.unwrap().path()).collect();
    names.sort();
    let read = |p: &Path| std::fs::read_to_string(p).unwrap();
    let pairs = names.into_iter().filter(|p| p.extension().is_some_and(|e| e == "json"));
    pairs.map(|p| (p.clone(), read(&p.with_extension("toml")), read(&p))).collect()
}

/// All places of a value, as JSON pointers.
fn places(value: &Value, at: &str, found: &mut Vec<String>) {
    found.push(at.to_owned());
    match value {
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                places(item, &format!("{at}/{k}"), found);
            }
        }
        Value::Object(fields) => {
            for (key, item) in fields {
                places(item, &format!("{at}/{key}"), found);
            }
        }
        _ => {}
    }
}

const WORDS: [&str; 60] = [
    "smooth",
    "rough",
    "rules",
    "interpolatory",
    "unimodular",
    "samples",
    "proved",
    "refuted",
    "undetermined",
    "half-tangent",
    "regular",
    "cusp",
    "oscillating",
    "corner",
    "none",
    "line",
    "differ",
    "plane",
    "theorem-2",
    "theorem-3",
    "corollary-line",
    "corollary",
    "null-point",
    "sign-change",
    "orbit",
    "crossing",
    "real",
    "pair",
    "conformal",
    "left end",
    "right end",
    "joint",
    "inside",
    "of set",
    "ends",
    "joints",
    "address",
    "any point",
    "every point",
    "every point by polynomials",
    "every point by components",
    "cones",
    "loop",
    "transient",
    "zero",
    "symmetric",
    "monotone",
    "balanced",
    "quadratic",
    "tree",
    "space",
    "leading",
    "group",
    "simplex",
    "5",
    "5'",
    "theorem-7",
    "theorem-8-winding",
    "theorem-8-fold",
    "theorem-8-path",
];

/// What may stand in the place of a value.
fn replacements(value: &Value) -> Vec<Value> {
    let mut new = match value {
        Value::Number(k) => {
            let k = k.as_u64().unwrap();
            let mut new = vec![json!(k + 1), json!(-1), json!(0.5), json!(u64::MAX)];
            if k > 0 {
                new.push(json!(k - 1));
            }
            new
        }
        Value::String(text) if secant_check::number::canonical(text).is_some() => numbers(text),
        Value::String(text) => words(text),
        Value::Array(items) => lists(items),
        Value::Object(fields) => {
            let mut new = Vec::new();
            let entries: Vec<(String, Value)> = fields.iter().map(|(k, v)| (k.clone(), v.clone())).collect();
            let object = |entries: &[(String, Value)]| Value::Object(entries.iter().cloned().collect());
            for k in 0..entries.len() {
                let mut changed = entries.clone();
                changed.remove(k);
                new.push(object(&changed));
                let mut changed = entries.clone();
                changed[k].0 += "x";
                new.push(object(&changed));
                let mut changed = entries.clone();
                changed.rotate_left(k + 1);
                new.push(object(&changed));
            }
            let mut changed = entries;
            changed.push(("trusted".to_owned(), json!("yes")));
            new.push(object(&changed));
            new
        }
        _ => vec![json!(true), json!([]), json!("0")],
    };
    new.push(Value::Null);
    new.retain(|v| v != value);
    new
}

fn numbers(text: &str) -> Vec<Value> {
    let x = secant_check::number::canonical(text).unwrap();
    let whole = secant_check::number::whole;
    let tiny = secant_check::number::Q::new(1.into(), 1024.into());
    let changed =
        [-x.clone(), &x + whole(1), &x - whole(1), &x * whole(2), &x / whole(2), &x + tiny, whole(0), whole(1)];
    let mut new: Vec<Value> = changed.iter().map(|y| json!(y.to_string())).collect();
    new.extend([json!(format!("{text}0")), json!(format!("0{text}")), json!(""), json!(format!("{text}/1"))]);
    new
}

fn words(text: &str) -> Vec<Value> {
    let mut new: Vec<Value> = match text.split_at_checked(1) {
        Some(("+", rest)) => vec![json!(format!("-{rest}")), json!(format!("+{rest}1")), json!([text, text])],
        Some(("-", rest)) => vec![json!(format!("+{rest}")), json!(format!("-{rest}1")), json!([text, text])],
        _ if text == "." => vec![json!([".", "."]), json!([".", [".", "."]]), json!("+0"), json!([])],
        _ => WORDS.iter().map(|w| json!(w)).collect(),
    };
    new.push(json!(format!("{text} ")));
    new
}

fn lists(items: &[Value]) -> Vec<Value> {
    let mut new = vec![json!([])];
    for k in 0..items.len() {
        let mut changed = items.to_vec();
        changed.remove(k);
        new.push(json!(changed));
        let mut changed = items.to_vec();
        changed.insert(k, items[k].clone());
        new.push(json!(changed));
        if k > 0 {
            let mut changed = items.to_vec();
            changed.swap(k - 1, k);
            new.push(json!(changed));
        }
        new.push(items[k].clone());
    }
    let mut changed = items.to_vec();
    changed.push(json!("0"));
    new.push(json!(changed));
    new
}

/// Whether bounds are no better than others.
fn wider(found: (&Q, &Q), original: (&Q, &Q)) -> bool {
    found.0 <= original.0 && original.1 <= found.1
}

/// Whether a claim says no more than another one: the same, a wider bound, a slower rate.
fn weaker(found: &Decided, original: &Decided) -> bool {
    let verdicts = found.verdict == original.verdict;
    match (&found.claim, &original.claim) {
        (Claim::Radius(a, b), Claim::Radius(c, d)) => verdicts && wider((a, b), (c, d)),
        (Claim::RadiusOfOrder(k, a, b), Claim::RadiusOfOrder(l, c, d)) => verdicts && k == l && wider((a, b), (c, d)),
        (
            Claim::LatticeExponent { low: a, high: b, exact, dimensions: s, index: n },
            Claim::LatticeExponent { low: c, high: d, exact: best, dimensions: t, index: m },
        ) => verdicts && s == t && n == m && wider((a, b), (c, d)) && (*best || !exact),
        (Claim::TangentTurns { rate: None }, Claim::TangentTurns { .. }) => verdicts,
        // More letters with no better a ratio say less; the original is rounded up a little.
        (Claim::TangentTurns { rate: Some((n, d)) }, Claim::TangentTurns { rate: Some((least, low)) }) => {
            let room = whole(1) + canonical("1/1073741824").unwrap();
            verdicts && n >= least && d * room >= *low
        }
        // Half-tangents of the curve before the projection, instead of those that are seen.
        (Claim::HalfTangents { projected: true }, Claim::HalfTangents { .. }) => verdicts,
        // A point of a surface may be left open where others refute the same.
        (Claim::PlaneOfCells(a), Claim::PlaneOfCells(b)) => {
            a == b && (verdicts || found.verdict == Verdict::Undetermined)
        }
        _ => found == original,
    }
}

/// Whether an exponent is known no better: fewer orders say less, and so do wider bounds.
fn exponent(found: &Decided, original: &Decided) -> bool {
    let verdicts = found.verdict == original.verdict;
    match (&found.claim, &original.claim) {
        (Claim::Exponent { order: k, low: a, high: b, .. }, Claim::Exponent { order: l, low: c, high: d, .. }) => {
            verdicts && (k < l || k == l && wider((a, b), (c, d)))
        }
        (Claim::Exponent { .. }, Claim::Polynomial) => verdicts,
        _ => found == original,
    }
}

fn all_weaker(found: &[Decided], original: &[Decided]) -> bool {
    found.len() == original.len() && found.iter().zip(original).all(|(a, b)| weaker(a, b))
}

/// Whether a certificate states the same as another one, or less: the order in which points are listed does not matter, and a
/// bound may be further from the truth, which lies within the bounds of the original.
fn same(found: &Accepted, original: &Accepted) -> bool {
    if found.case != original.case {
        return false;
    }
    let verdicts = found.verdict == original.verdict;
    match original.claims[0].claim {
        // Fewer orders, with weaker bounds of the radii, and what they say of the exponent.
        Claim::Smooth { .. } => {
            let (Some((last, smooth)), Some((end, all))) = (found.claims.split_last(), original.claims.split_last())
            else {
                return false;
            };
            all.starts_with(smooth)
                && smooth.len() == found.points.len()
                && all_weaker(&found.points, &original.points[..smooth.len()])
                && exponent(last, end)
        }
        // Fewer orders; a wider exponent, or only a bound of it.
        Claim::LatticeSmooth { .. } => {
            let is_order = |d: &&Decided| matches!(d.claim, Claim::LatticeSmooth { .. });
            let [mine, all] = [found, original].map(|x| x.claims.iter().filter(is_order).cloned().collect::<Vec<_>>());
            let known =
                found.claims.iter().filter(|d| !is_order(d)).all(|d| original.claims.iter().any(|o| weaker(d, o)));
            verdicts && all.starts_with(&mine) && known
        }
        // Fewer orders; whatever bounds of the radii.
        Claim::BorderSmooth { .. } => verdicts && original.claims.starts_with(&found.claims),
        // Fewer valences, or no plane without a half-plane.
        Claim::SmoothAtVertex(_) => {
            let open = |claim: &Decided| claim.verdict == Verdict::Undetermined;
            let known = found.claims.iter().all(|c| open(c) || original.claims.contains(c));
            known && (verdicts || found.verdict == Verdict::Undetermined)
        }
        Claim::PlaneAtVertices | Claim::PlaneAt(_) | Claim::PlaneOfBranch(_) => {
            verdicts && found.claims == original.claims && all_weaker(&found.points, &original.points)
        }
        // Each claim is about one factor, in any order.
        Claim::Jordan { .. } => verdicts && found.claims.iter().all(|c| original.claims.contains(c)),
        Claim::Radius(..) => verdicts && all_weaker(&found.claims, &original.claims),
        _ => verdicts && answers(found, original) && sorted(found) == sorted(original),
    }
}

/// The answers about every point and about any point may be left out, whatever they are.
fn answers(found: &Accepted, original: &Accepted) -> bool {
    let turns = |d: &Decided| matches!(d.claim, Claim::TangentTurns { .. } | Claim::HalfTangents { .. });
    let given = [found.claims.iter().any(turns), found.claims.iter().any(|d| d.claim == Claim::TangentSomewhere)];
    let asked = |d: &&Decided| (given[0] || !turns(d)) && (given[1] || d.claim != Claim::TangentSomewhere);
    let claims: Vec<Decided> = original.claims.iter().filter(asked).cloned().collect();
    // What is said of half-tangents is part of the answer about every point.
    let half =
        found.claims.iter().filter(|d| !matches!(d.claim, Claim::HalfTangents { .. })).cloned().collect::<Vec<_>>();
    all_weaker(&found.claims, &claims) || all_weaker(&half, &claims)
}

/// The points in any order. Inside a curve a refuted point is a witness for the answer about every point, which any other is as
/// well.
fn sorted(x: &Accepted) -> Vec<String> {
    let named = |d: &Decided| match &d.claim {
        Claim::Point { place: Place::Inside(_), .. } if d.verdict == Verdict::Refuted => "a witness".to_owned(),
        _ => d.to_string(),
    };
    let mut points: Vec<String> = x.points.iter().map(named).collect();
    points.sort();
    points
}

/// What became of mutants.
#[derive(Default)]
struct Tally {
    tried: usize,
    rejected: usize,
    harmless: Vec<(PathBuf, String)>,
    wrong: Vec<String>,
}

/// Tries every mutant of the stored certificates, or every `step`-th, on two threads.
fn tamper(step: usize) -> Tally {
    let only = std::env::var("SECANT_MUTANT_ONLY").unwrap_or_default();
    // Of families the ends of the parts may lie elsewhere, which is another true statement; of borders a small one is enough.
    let left_out = ["region-", "border-stam-loop"];
    let name = |path: &Path| path.file_name().map(|n| n.to_string_lossy().into_owned());
    let fixed = |path: &Path| name(path).is_some_and(|n| left_out.iter().all(|start| !n.starts_with(start)));
    let mut chosen = stored("pass");
    chosen.retain(|(path, ..)| path.to_string_lossy().contains(&only) && fixed(path));
    let half = |k: usize| tamper_some(chosen.iter().skip(k).step_by(2), step);
    let [mut all, more] = std::thread::scope(|s| [0, 1].map(|k| s.spawn(move || half(k))).map(|t| t.join().unwrap()));
    all.tried += more.tried;
    all.rejected += more.rejected;
    all.harmless.extend(more.harmless);
    all.wrong.extend(more.wrong);
    all
}

fn tamper_some<'a>(chosen: impl Iterator<Item = &'a (PathBuf, String, String)>, step: usize) -> Tally {
    let mut tally = Tally::default();
    let mut count = 0;
    for (path, case, text) in chosen {
        let original: Value = serde_json::from_str(text).unwrap();
        let statement = secant_check::check(case, text).unwrap_or_else(|r| panic!("{}: {r}", path.display()));
        // The detour through the parsed value must change nothing, or every mutant would be rejected for its form.
        assert_eq!(secant_check::check(case, &original.to_string()).as_ref(), Ok(&statement));
        let mut pointers = Vec::new();
        places(&original, "", &mut pointers);
        for pointer in pointers {
            for new in replacements(original.pointer(&pointer).unwrap()) {
                count += 1;
                if count % step != 0 {
                    continue;
                }
                let mut mutant = original.clone();
                *mutant.pointer_mut(&pointer).unwrap() = new;
                let mutant = mutant.to_string();
                tally.tried += 1;
                match secant_check::check(case, &mutant) {
                    Err(_) => tally.rejected += 1,
                    Ok(found) if same(&found, &statement) => tally.harmless.push((path.clone(), mutant)),
                    Ok(_) => tally.wrong.push(format!("{} at {pointer}", path.display())),
                }
            }
        }
    }
    tally
}

#[test]
fn tampered_certificates_are_rejected_or_harmless() {
    let step = std::env::var("SECANT_MUTANT_STEP").ok().and_then(|s| s.parse().ok()).unwrap_or(61);
    let Tally { tried, rejected, harmless, wrong } = tamper(step);
    println!("{tried} mutants: {rejected} rejected, {} harmless, {} wrong", harmless.len(), wrong.len());
    assert!(wrong.is_empty(), "accepted with another statement:\n{}", wrong.join("\n"));
    assert!(tried >= 4_000 || std::env::var("SECANT_MUTANT_ONLY").is_ok(), "only {tried} mutants");
    assert!(rejected > tried / 2);
    if let Ok(dir) = std::env::var("SECANT_WRITE_MUTANTS") {
        for (k, (path, text)) in harmless.iter().enumerate() {
            let name = path.file_stem().unwrap().to_string_lossy();
            std::fs::write(Path::new(&dir).join(format!("{k}-{name}.json")), text).unwrap();
        }
    }
}

#[test]
fn forged_certificates_are_rejected() {
    let forged = stored("fail");
    assert!(forged.len() >= 80, "only {} forgeries", forged.len());
    for (path, case, text) in forged {
        let rejected = secant_check::check(&case, &text).expect_err(&path.display().to_string());
        let wanted = path.file_stem().unwrap().to_string_lossy().into_owned();
        // The name of the file says which rule finds it: `RULE--what.json`.
        let rule = wanted.split("--").next().unwrap();
        assert_eq!(rejected.rule, rule, "{}: {rejected}", path.display());
    }
}

#[test]
fn garbage_is_refused_quickly() {
    let case = stored("pass").swap_remove(0).1;
    let deep = "[".repeat(200_000);
    let long = format!("{{\"format\": \"{}\"}}", "9".repeat(1 << 20));
    let texts = ["", "{", "null", "[]", "{}", "\u{0}", "1e999999999", deep.as_str(), long.as_str()];
    for text in texts {
        assert!(secant_check::check(&case, text).is_err());
        assert!(secant_check::check(text, &case).is_err());
    }
    let (_, case, text) = stored("pass").swap_remove(0);
    for cut in (0..text.len()).step_by(97).filter(|&k| text.is_char_boundary(k)) {
        assert!(secant_check::check(&case, &text[..cut]).is_err());
        let mut bytes = text.clone().into_bytes();
        bytes[cut] ^= 1 << (cut % 7);
        let _ = secant_check::check(&case, &String::from_utf8_lossy(&bytes));
    }
    for cut in (0..case.len()).step_by(13).filter(|&k| case.is_char_boundary(k)) {
        let _ = secant_check::check(&case[..cut], &text);
    }
}
