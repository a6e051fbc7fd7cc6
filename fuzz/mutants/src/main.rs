//! Mutants of secant and its checker, all in one build: `prepare` writes it, `run` tries a sample of them.

mod rewrite;
mod tests;

use rewrite::{Mutant, rewrite};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Rooms that prove or check, and where they are.
const ROOMS: [(&str, &str); 5] = [
    ("theorem", "src/theorem"),
    ("vertex", "src/vertex"),
    ("radius", "src/radius"),
    ("certificate", "src/certificate"),
    ("checker", "checker/src"),
];
/// What holds the switches in both crates.
const SWITCH: &str = include_str!("switch.rs");
/// How often lines that do not compile are left alone.
const ATTEMPTS: usize = 12;

/// The result of a step, with a message for people.
type Outcome<T> = Result<T, String>;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["prepare", root, scratch] => prepare(Path::new(root), Path::new(scratch)),
        ["run", scratch, seconds, seed] => match (seconds.parse(), seed.parse()) {
            (Ok(seconds), Ok(seed)) => tests::run(Path::new(scratch), seconds, seed, &[]),
            _ => Err("SECONDS and SEED are whole numbers".to_owned()),
        },
        ["only", scratch, ids @ ..] => match ids.iter().map(|id| id.parse()).collect::<Result<Vec<u32>, _>>() {
            Ok(ids) => tests::run(Path::new(scratch), u64::MAX, 0, &ids),
            Err(_) => Err("the numbers of mutants are whole numbers".to_owned()),
        },
        _ => Err("usage: secant-mutants prepare ROOT SCRATCH | run SCRATCH SECONDS SEED | only SCRATCH ID...".to_owned()),
    };
    if let Err(message) = done {
        eprintln!("{message}");
        std::process::exit(2);
    }
}

/// Copies the repository, makes every place a switch, and leaves those alone that do not compile.
fn prepare(root: &Path, scratch: &Path) -> Outcome<()> {
    let listed = Command::new("git").arg("-C").arg(root).arg("ls-files").output().map_err(text)?;
    for file in String::from_utf8_lossy(&listed.stdout).lines() {
        let (from, to) = (root.join(file), scratch.join(file));
        std::fs::create_dir_all(to.parent().ok_or("a file without a folder")?).map_err(text)?;
        std::fs::copy(&from, &to).map_err(|e| format!("{}: {e}", from.display()))?;
    }
    for library in ["src", "checker/src"] {
        std::fs::write(scratch.join(library).join("mutant.rs"), SWITCH).map_err(text)?;
        let path = scratch.join(library).join("lib.rs");
        let own = std::fs::read_to_string(&path).map_err(text)?;
        std::fs::write(&path, format!("{own}\n#[allow(missing_docs)]\npub mod mutant;\n")).map_err(text)?;
    }
    let mut skip: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
    for attempt in 1..=ATTEMPTS {
        let mutants = rewritten(root, scratch, &skip)?;
        let errors = errors(scratch)?;
        eprintln!("attempt {attempt}: {} mutants, {} lines do not compile", mutants.len(), errors.len());
        if errors.is_empty() {
            return listing(scratch, &mutants);
        }
        for (file, line) in errors {
            skip.entry(file).or_default().insert(line);
        }
    }
    Err("the switches do not compile".to_owned())
}

fn rewritten(root: &Path, scratch: &Path, skip: &BTreeMap<String, BTreeSet<usize>>) -> Outcome<Vec<Mutant>> {
    let mut mutants = Vec::new();
    for (room, folder) in ROOMS {
        let mut files = Vec::new();
        below(&root.join(folder), &mut files)?;
        files.sort();
        for path in files {
            let file = path.strip_prefix(root).map_err(text)?.display().to_string();
            let source = std::fs::read_to_string(&path).map_err(text)?;
            let nothing = BTreeSet::new();
            let lines = skip.get(&file).unwrap_or(&nothing);
            let changed = rewrite(&source, room, &file, lines, &mut mutants)?;
            let changed = if file == "checker/src/lib.rs" { format!("{changed}\n#[allow(missing_docs)]\npub mod mutant;\n") } else { changed };
            std::fs::write(scratch.join(&file), changed).map_err(text)?;
        }
    }
    Ok(mutants)
}

/// The files of a room; tests and programs are none of it.
fn below(folder: &Path, files: &mut Vec<PathBuf>) -> Outcome<()> {
    for entry in std::fs::read_dir(folder).map_err(text)? {
        let path = entry.map_err(text)?.path();
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        if path.is_dir() && name != "tests" {
            below(&path, files)?;
        } else if name.ends_with(".rs") && !["main.rs", "tests.rs", "mutant.rs"].contains(&name.as_str()) {
            files.push(path);
        }
    }
    Ok(())
}

/// The places at which the rewritten libraries do not compile.
fn errors(scratch: &Path) -> Outcome<Vec<(String, usize)>> {
    let arguments = ["check", "--workspace", "--lib", "--message-format=json", "--offline"];
    let output = Command::new("cargo").args(arguments).current_dir(scratch).output();
    let output = output.map_err(text)?;
    let mut places = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let value: serde_json::Value = serde_json::from_str(line).map_err(text)?;
        let message = &value["message"];
        if message["level"] != "error" {
            continue;
        }
        // A path below the checker is given from the root of the workspace.
        for span in message["spans"].as_array().into_iter().flatten() {
            let (file, start, end) = (span["file_name"].as_str(), span["line_start"].as_u64(), span["line_end"].as_u64());
            if let (Some(file), Some(start), Some(end)) = (file, start, end) {
                places.extend((start..=end).map(|line| (file.to_owned(), usize::try_from(line).expect("a line"))));
            }
        }
    }
    places.sort();
    places.dedup();
    if places.is_empty() && !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(places)
}

fn listing(scratch: &Path, mutants: &[Mutant]) -> Outcome<()> {
    let row = |m: &Mutant| format!("{}\t{}\t{}\t{}\t{}\n", m.id, m.room, m.file, m.line, m.what);
    std::fs::write(scratch.join("mutants.tsv"), mutants.iter().map(row).collect::<String>()).map_err(text)
}

/// An error as a message.
fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}
