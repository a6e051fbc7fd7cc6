//! Runs the tests that reach a mutant, the fastest first, until one fails.

use crate::rewrite::Mutant;
use crate::{Outcome, ROOMS, text};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The tests: a package, and one of its targets.
const TARGETS: [(&str, &[&str]); 6] = [
    ("secant", &["--lib"]),
    ("secant", &["--test", "cases"]),
    ("secant", &["--test", "suite"]),
    ("secant-check", &["--test", "forged"]),
    ("secant-check", &["--test", "spectrum"]),
    ("secant-check", &["--lib"]),
];
/// Modules of the program `suite` that are about what no room of mutants does, or start other programs.
const OTHERS: [&str; 16] = [
    "architecture", "browser", "cli", "coq", "entries", "garbage", "inputs", "latex", "laws", "readers", "render", "reports",
    "schema", "studio", "theory", "verdict_laws",
];
/// A test that takes longer than this without a mutant is not among the fast ones.
const FAST: Duration = Duration::from_millis(2500);
/// Seconds of tests that are spent on one mutant.
const SPENT: f64 = 25.0;

struct Test {
    binary: PathBuf,
    folder: PathBuf,
    name: String,
    seconds: f64,
    reached: BTreeSet<u32>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Ran {
    Passed,
    Failed,
    Late,
}

/// What became of a mutant.
enum Fate {
    /// A test failed, or did not end.
    Killed(String),
    /// No fast test reaches it.
    Unreached,
    /// All tests that reach it passed (or as many as there was time for).
    Survived { tests: usize, of: usize },
}

/// Tries mutants for so many seconds, drawn at random with a seed, by turns from each room; or those with these numbers.
pub fn run(scratch: &Path, seconds: u64, seed: u64, only: &[u32]) -> Outcome<()> {
    let mutants = read(scratch)?;
    let mut tests = known(scratch)?;
    if tests.is_empty() {
        for (folder, binary) in binaries(scratch)? {
            look(&binary, &folder, scratch, &mut tests)?;
        }
        keep(scratch, &tests)?;
    }
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    println!("{} mutants, {} fast tests", mutants.len(), tests.len());
    let begun = Instant::now();
    let mut results = std::fs::File::create(scratch.join("results.tsv")).map_err(text)?;
    let mut score: BTreeMap<&str, [usize; 3]> = BTreeMap::new();
    for mutant in order(&mutants, seed, only) {
        if begun.elapsed().as_secs() > seconds {
            break;
        }
        let (word, column) = match fate(mutant, &tests) {
            Fate::Killed(by) => (format!("killed\t{by}"), 0),
            Fate::Unreached => ("unreached\t".to_owned(), 1),
            Fate::Survived { tests, of } => (format!("survived\t{tests} of {of} tests"), 2),
        };
        score.entry(mutant.room.as_str()).or_default()[column] += 1;
        let Mutant { id, room, file, line, what } = mutant;
        writeln!(results, "{id}\t{room}\t{file}:{line}\t{what}\t{word}").map_err(text)?;
    }
    println!("room          tried  killed  unreached  survived");
    for (room, [killed, unreached, survived]) in score {
        println!("{room:12} {:6} {killed:7} {unreached:10} {survived:9}", killed + unreached + survived);
    }
    Ok(())
}

fn read(scratch: &Path) -> Outcome<Vec<Mutant>> {
    let list = std::fs::read_to_string(scratch.join("mutants.tsv")).map_err(text)?;
    let row = |line: &str| {
        let [id, room, file, at, what] = line.split('\t').collect::<Vec<_>>()[..] else { return None };
        let (id, line) = (id.parse().ok()?, at.parse().ok()?);
        Some(Mutant { id, line, room: room.to_owned(), file: file.to_owned(), what: what.to_owned() })
    };
    list.lines().map(|line| row(line).ok_or_else(|| format!("mutants.tsv: {line}"))).collect()
}

/// Mutants by turns from each room, in a random order.
fn order<'a>(mutants: &'a [Mutant], seed: u64, only: &[u32]) -> Vec<&'a Mutant> {
    if !only.is_empty() {
        return mutants.iter().filter(|m| only.contains(&m.id)).collect();
    }
    let mut random = oorandom::Rand64::new(u128::from(seed));
    let mut rooms: Vec<Vec<&Mutant>> =
        ROOMS.iter().map(|(room, _)| mutants.iter().filter(|m| m.room == *room).collect()).collect();
    for room in &mut rooms {
        for k in (1..room.len()).rev() {
            room.swap(k, usize::try_from(random.rand_range(0..k as u64 + 1)).expect("an index"));
        }
    }
    let longest = rooms.iter().map(Vec::len).fold(0, usize::max);
    (0..longest).flat_map(|k| rooms.iter().filter_map(move |room| room.get(k).copied())).collect()
}

/// Builds the tests; the folder that each runs in, and its program.
fn binaries(scratch: &Path) -> Outcome<Vec<(PathBuf, PathBuf)>> {
    let mut found = Vec::new();
    for (package, target) in TARGETS {
        let mut cargo = Command::new("cargo");
        cargo.args(["test", "--no-run", "--offline", "--message-format=json", "-p", package]).args(target);
        let output = cargo.current_dir(scratch).output().map_err(text)?;
        let programs = String::from_utf8_lossy(&output.stdout).lines().filter_map(|line| {
            let value: serde_json::Value = serde_json::from_str(line).ok()?;
            let wanted = value["profile"]["test"] == true && value["manifest_path"].as_str()?.contains(&*scratch.to_string_lossy());
            if wanted { value["executable"].as_str().map(PathBuf::from) } else { None }
        }).collect::<Vec<_>>();
        if programs.is_empty() {
            return Err(format!("{package} {target:?}: {}", String::from_utf8_lossy(&output.stderr)));
        }
        let folder = if package == "secant" { scratch.to_owned() } else { scratch.join("checker") };
        found.extend(programs.into_iter().map(|p| (folder.clone(), p)));
    }
    Ok(found)
}

/// Runs every test of a program once by itself, and writes down which switches it reaches.
fn look(binary: &Path, folder: &Path, scratch: &Path, tests: &mut Vec<Test>) -> Outcome<()> {
    let list = Command::new(binary).arg("--list").current_dir(folder).output().map_err(text)?;
    for line in String::from_utf8_lossy(&list.stdout).lines() {
        let Some(name) = line.strip_suffix(": test") else { continue };
        if name.split_once("::").is_some_and(|(module, _)| OTHERS.contains(&module)) {
            continue;
        }
        let trace = scratch.join("trace.txt");
        let _ = std::fs::remove_file(&trace);
        let mut test = Test {
            binary: binary.to_owned(),
            folder: folder.to_owned(),
            name: name.to_owned(),
            seconds: 0.0,
            reached: BTreeSet::new(),
        };
        let begun = Instant::now();
        let ran = execute(&test, FAST, |c| c.env("SECANT_MUTANT_TRACE", &trace))?;
        if ran == Ran::Passed {
            test.seconds = begun.elapsed().as_secs_f64();
            let reached = std::fs::read_to_string(&trace).unwrap_or_default();
            test.reached = reached.lines().filter_map(|l| l.parse().ok()).collect();
            tests.push(test);
        }
    }
    Ok(())
}

fn execute(test: &Test, limit: Duration, with: impl Fn(&mut Command) -> &mut Command) -> Outcome<Ran> {
    let mut command = Command::new(&test.binary);
    command.args(["--exact", &test.name, "--test-threads=1"]).current_dir(&test.folder);
    command.stdout(Stdio::null()).stderr(Stdio::null()).env("RAYON_NUM_THREADS", "1");
    let mut child = with(&mut command).spawn().map_err(text)?;
    let begun = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(text)? {
            return Ok(if status.success() { Ran::Passed } else { Ran::Failed });
        }
        if begun.elapsed() > limit {
            let _ = child.kill();
            let _ = child.wait();
            return Ok(Ran::Late);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn fate(mutant: &Mutant, tests: &[Test]) -> Fate {
    let reaching: Vec<&Test> = tests.iter().filter(|t| t.reached.contains(&mutant.id)).collect();
    let (mut spent, mut done) = (0.0, 0);
    for test in &reaching {
        if spent > SPENT {
            break;
        }
        let limit = Duration::from_secs_f64(8.0 * test.seconds + 4.0);
        let begun = Instant::now();
        let id = mutant.id.to_string();
        match execute(test, limit, |c| c.env("SECANT_MUTANT", &id)) {
            Ok(Ran::Passed) => done += 1,
            Ok(Ran::Failed) => return Fate::Killed(test.name.clone()),
            Ok(Ran::Late) => return Fate::Killed(format!("{} (does not end)", test.name)),
            Err(_) => {}
        }
        spent += begun.elapsed().as_secs_f64();
    }
    if reaching.is_empty() { Fate::Unreached } else { Fate::Survived { tests: done, of: reaching.len() } }
}

/// The tests as they were looked at before.
fn known(scratch: &Path) -> Outcome<Vec<Test>> {
    let Ok(list) = std::fs::read_to_string(scratch.join("tests.tsv")) else { return Ok(Vec::new()) };
    let row = |line: &str| {
        let [binary, folder, name, seconds, reached] = line.split('\t').collect::<Vec<_>>()[..] else { return None };
        Some(Test {
            binary: binary.into(),
            folder: folder.into(),
            name: name.to_owned(),
            seconds: seconds.parse().ok()?,
            reached: reached.split(' ').filter_map(|id| id.parse().ok()).collect(),
        })
    };
    list.lines().map(|line| row(line).ok_or_else(|| format!("tests.tsv: {line}"))).collect()
}

fn keep(scratch: &Path, tests: &[Test]) -> Outcome<()> {
    let row = |t: &Test| {
        let reached: Vec<String> = t.reached.iter().map(ToString::to_string).collect();
        let Test { binary, folder, name, seconds, .. } = t;
        format!("{}\t{}\t{name}\t{seconds}\t{}\n", binary.display(), folder.display(), reached.join(" "))
    };
    std::fs::write(scratch.join("tests.tsv"), tests.iter().map(row).collect::<String>()).map_err(text)
}
