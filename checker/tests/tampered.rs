//! Systematic tampering: a certificate with one thing changed is rejected, or still proves the same statement.

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

const WORDS: [&str; 49] = [
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

/// Whether a certificate states the same as another one: the order in which points are listed does not matter, and a bound may
/// be further from the truth, which lies within the bounds of the original.
fn same(found: &secant_check::Accepted, original: &secant_check::Accepted) -> bool {
    // Inside a curve a refuted point is a witness for the answer about every point, which any other witness is as well.
    let named = |line: &String| if line.starts_with("refuted: Inside") { "a witness".to_owned() } else { line.clone() };
    let sorted = |x: &secant_check::Accepted| {
        let mut points: Vec<String> = x.points.iter().map(named).collect();
        points.sort();
        points
    };
    if original.claims[0].contains("C^0") {
        // Orders of smoothness: fewer of them, with weaker bounds of the radii, are a weaker statement.
        let weaker = |(a, b): (&String, &String)| {
            let split =
                |line: &str| Some((line.split(" is ").next()?.to_owned(), line.split_once(" is ")?.1.to_owned()));
            let (Some((text, a)), Some((other, b))) = (split(a), split(b)) else { return false };
            let bounds = |x: &str| radius(&format!("proved: the joint spectral radius is {x}"));
            text == other && bounds(&a).zip(bounds(&b)).is_some_and(|((l, h), (low, high))| l <= high && low <= h)
        };
        return original.claims.starts_with(&found.claims)
            && found.case == original.case
            && found.points.len() == found.claims.len()
            && found.points.iter().zip(&original.points).all(weaker);
    }
    if original.claims[0].contains("almost all") {
        // Vertices: fewer valences, or no plane without a half-plane.
        let open = |claim: &String| claim.starts_with("undetermined");
        let known = found.claims.iter().all(|c| open(c) || original.claims.contains(c));
        return known && (found.verdict == original.verdict || found.verdict.word() == "undetermined");
    }
    if original.claims[0].contains("tangent plane") {
        // Of a surface, points may be left open where others refute the same.
        let weaker = |(a, b): (&String, &String)| {
            a == b || a.strip_prefix("undetermined") == b.find(':').map(|colon| &b[colon..])
        };
        return (&found.case, found.verdict, &found.claims) == (&original.case, original.verdict, &original.claims)
            && found.points.len() == original.points.len()
            && found.points.iter().zip(&original.points).all(weaker);
    }
    // The answers about every point and about any point may be left out, whatever they are.
    let given = |of: &str| found.claims.iter().any(|claim| claim.contains(of));
    let asked = |c: &&String| ["G¹", "some point of the shape"].iter().all(|of| !c.contains(of) || given(of));
    let claims: Vec<&String> = original.claims.iter().filter(asked).collect();
    let head = (&found.case, found.verdict, found.claims.len()) == (&original.case, original.verdict, claims.len());
    // Of a spectrum each claim is about one factor, in any order.
    if original.claims[0].contains("Jordan blocks") {
        return head && found.claims.iter().all(|c| original.claims.contains(c));
    }
    let mut both = found.claims.iter().zip(claims);
    match radius(&original.claims[0]) {
        Some((low, high)) => head && radius(&found.claims[0]).is_some_and(|(l, h)| l <= high && low <= h),
        None => {
            // Half-tangents of the curve before the projection, instead of those that are seen.
            let unseen = |a: &str, b: &str| a.replacen("before the projection ", "", 1) == b;
            // The same without a rate.
            let unrated = |a: &str, b: &str| b.split_once(" (cones shrink").is_some_and(|(text, _)| text == a);
            let weaker = |(a, b): (&String, &String)| a == b || unseen(a, b) || unrated(a, b) || weaker_rate(a, b);
            head && sorted(found) == sorted(original) && both.all(weaker)
        }
    }
}

fn number(text: &str) -> secant_check::number::Q {
    secant_check::number::canonical(text).unwrap()
}

/// The bounds of a joint spectral radius that a claim states.
fn radius(claim: &str) -> Option<(secant_check::number::Q, secant_check::number::Q)> {
    let bounds = claim.strip_prefix("proved: the joint spectral radius is ")?;
    let (low, high) = match bounds.strip_prefix("at least ") {
        Some(both) => both.split_once(" and at most ")?,
        None => (bounds, bounds),
    };
    Some((number(low), number(high)))
}

/// Whether a claim is the same but for a cross-ratio that is no smaller (the original is rounded up a little).
fn weaker_rate(found: &str, original: &str) -> bool {
    let split = |claim: &str| {
        let (text, rate) = claim.split_once("with every ")?;
        let (letters, ratio) = rate.strip_suffix(')')?.split_once(" letters, D = ")?;
        Some((text.to_owned(), letters.parse::<usize>().ok()?, number(ratio)))
    };
    let (Some((text, letters, ratio)), Some((other, least, low))) = (split(found), split(original)) else {
        return false;
    };
    let room = secant_check::number::whole(1) + number("1/1073741824");
    // More letters with no better a ratio say less.
    text == other && letters >= least && ratio * room >= low
}

/// Tries every mutant of the stored certificates, or every `step`-th.
fn tamper(step: usize) -> (usize, usize, Vec<(PathBuf, String)>, Vec<String>) {
    let (mut tried, mut rejected, mut harmless, mut wrong) = (0, 0, Vec::new(), Vec::new());
    let mut count = 0;
    let only = std::env::var("SECANT_MUTANT_ONLY").unwrap_or_default();
    let chosen = stored("pass").into_iter().filter(|(path, ..)| path.to_string_lossy().contains(&only));
    for (path, case, text) in chosen {
        let original: Value = serde_json::from_str(&text).unwrap();
        let statement = secant_check::check(&case, &text).unwrap_or_else(|r| panic!("{}: {r}", path.display()));
        // The detour through the parsed value must change nothing, or every mutant would be rejected for its form.
        assert_eq!(secant_check::check(&case, &original.to_string()).as_ref(), Ok(&statement));
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
                tried += 1;
                match secant_check::check(&case, &mutant) {
                    Err(_) => rejected += 1,
                    Ok(found) if same(&found, &statement) => harmless.push((path.clone(), mutant)),
                    Ok(_) => wrong.push(format!("{} at {pointer}", path.display())),
                }
            }
        }
    }
    (tried, rejected, harmless, wrong)
}

#[test]
fn tampered_certificates_are_rejected_or_harmless() {
    let step = std::env::var("SECANT_MUTANT_STEP").ok().and_then(|s| s.parse().ok()).unwrap_or(17);
    let (tried, rejected, harmless, wrong) = tamper(step);
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
