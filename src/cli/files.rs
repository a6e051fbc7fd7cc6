//! Which files a command reads and writes: no output takes the place of an input or of another output, and one that cannot be
//! made takes no other with it.

use super::output::{complain, remark, write_file};
use super::{BAD_INPUT, Command, INTERNAL};
use crate::certificate::sha256;
use crate::diagnostic::Problem;
use crate::guard::guarded;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The files that the command reads.
static INPUTS: OnceLock<Vec<PathBuf>> = OnceLock::new();

/// How the text of a case beside a certificate begins; the digest of the rest follows.
const BESIDE: &str = "# Written by secant beside a certificate; sha256 of the rest: ";

/// What a command may read, and the files that it is to write.
#[derive(Default)]
struct Files<'a> {
    inputs: Vec<&'a str>,
    outputs: Vec<&'a Path>,
    /// Outputs that may take the place of an input.
    in_place: Vec<&'a Path>,
}

fn of(command: &Command) -> Files<'_> {
    fn texts(paths: &[PathBuf]) -> Vec<&str> {
        paths.iter().filter_map(|p| p.to_str()).collect()
    }
    fn given<const N: usize>(outputs: [&Option<PathBuf>; N]) -> Vec<&Path> {
        outputs.into_iter().filter_map(Option::as_deref).collect()
    }
    let (inputs, outputs) = match command {
        Command::Certify(a) => (texts(&a.cases), given([&a.report, &a.svg, &a.png, &a.ply, &a.certificate, &a.coq])),
        Command::Spectrum(a) => (texts(&a.files), given([&a.certificate])),
        Command::Jsr(a) => (texts(&a.files), given([&a.svg, &a.certificate])),
        Command::Regularity(a) => (
            std::iter::once(a.what.as_str()).chain(a.more.iter().map(String::as_str)).collect(),
            given([&a.certificate]),
        ),
        Command::Region(a) => (vec![a.what.as_str()], given([&a.report, &a.svg, &a.certificate])),
        Command::Expand { cases, output, .. } => (texts(cases), given([output])),
        Command::Import { file, output, .. } => (file.to_str().into_iter().collect(), given([output])),
        Command::Render(a) => (texts(&a.cases), a.outputs()),
        Command::Junction(a) => (a.schemes.iter().map(String::as_str).collect(), given([&a.output, &a.report])),
        Command::Refine(a) => (vec![a.case.as_str()], given([&a.output])),
        Command::Solve(a) => {
            let (inputs, in_place) = (a.case.to_str().into_iter().collect(), given([&a.output]));
            return Files { inputs, outputs: given([&a.certificate]), in_place };
        }
        // These write nothing that the caller names as a file; every command is listed, so that a new one is not forgotten.
        Command::Schemes { .. }
        | Command::Explain { .. }
        | Command::Schema
        | Command::Init { .. }
        | Command::Gallery(_)
        | Command::Completions { .. }
        | Command::Man { .. } => return Files::default(),
        #[cfg(feature = "strategies")]
        Command::Fuzz(_) => return Files::default(),
        #[cfg(feature = "studio")]
        Command::Studio(_) => return Files::default(),
    };
    Files { inputs, outputs, in_place: Vec::new() }
}

/// The file that is read for an argument: a path, a path with values behind it, or what the standard input comes from.
fn read_for(text: &str) -> Option<PathBuf> {
    let ends = text.match_indices(char::is_whitespace).map(|(at, _)| at).chain([text.len()]);
    let named = if text == "-" { "/dev/stdin" } else { text };
    let candidates = if text == "-" { vec![named] } else { ends.map(|at| &text[..at]).collect() };
    candidates.into_iter().filter(|p| Path::new(p).is_file()).find_map(|p| std::fs::canonicalize(p).ok())
}

/// The place where an output comes to lie; `None` of the standard output and of devices.
fn place(path: &Path) -> Option<PathBuf> {
    if path.as_os_str() == "-" {
        return None;
    }
    if let Ok(there) = std::fs::canonicalize(path) {
        return there.is_file().then_some(there);
    }
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Some(std::fs::canonicalize(directory).ok()?.join(path.file_name()?))
}

fn itself(path: &Path) -> Problem {
    Problem::new("secant::output::input", format!("{} is the case itself; nothing was written", path.display()))
        .with_help("name another file: an output never takes the place of what was read")
}

/// Makes sure that no output of a command is one of its inputs, or another output.
///
/// # Errors
/// A [`Problem`] that names the file; nothing was written.
pub fn keep_apart(command: &Command) -> Result<(), Problem> {
    let files = of(command);
    let inputs: Vec<PathBuf> = files.inputs.iter().filter_map(|text| read_for(text)).collect();
    let mut taken: Vec<PathBuf> = Vec::new();
    for (path, in_place) in files.outputs.iter().map(|p| (*p, false)).chain(files.in_place.iter().map(|p| (*p, true))) {
        let Some(place) = place(path) else { continue };
        if !in_place && inputs.contains(&place) {
            return Err(itself(path));
        }
        if taken.contains(&place) {
            let message = format!("two outputs are to be written to {}; nothing was written", path.display());
            return Err(Problem::new("secant::output::twice", message).with_help("give each a file of its own"));
        }
        taken.push(place);
    }
    // Set once: a process runs one command.
    let _ = INPUTS.set(inputs);
    Ok(())
}

/// What became of the files that were asked for.
#[derive(Debug, Default)]
#[must_use]
pub struct Written {
    problems: Vec<Problem>,
}

impl Written {
    /// Makes and writes a file; where that fails the others are written all the same.
    pub fn file<C: AsRef<[u8]>>(&mut self, path: Option<&Path>, make: impl FnOnce(&Path) -> Result<C, Problem>) {
        let Some(path) = path else { return };
        self.done(guarded(|| write_file(path, make(path)?)));
    }

    /// Writes a certificate, and the case beside it, as [`write_certificate`].
    pub fn certificate(
        &mut self,
        path: Option<&Path>,
        make: impl FnOnce() -> Result<(String, Option<String>), Problem>,
    ) {
        let Some(path) = path else { return };
        self.done(guarded(|| {
            let (certificate, beside) = make()?;
            write_certificate(path, certificate, beside)
        }));
    }

    /// Keeps the problem of a file.
    pub fn done(&mut self, done: Result<(), Problem>) {
        self.problems.extend(done.err());
    }

    /// Says which files there are not, after the answer; the exit code of the answer, or 2 where a file is missing.
    pub fn code(self, code: u8) -> u8 {
        self.problems.iter().for_each(complain);
        match self.problems.iter().any(Problem::is_internal) || code == INTERNAL {
            true => INTERNAL,
            false if self.problems.is_empty() => code,
            false => BAD_INPUT,
        }
    }
}

/// Writes a certificate, and beside it the case as the checker reads it where that is not the file itself.
///
/// # Errors
/// A [`Problem`] where a file cannot be written, or the one beside it is a case of somebody else; then neither is written.
fn write_certificate(path: &Path, certificate: String, expanded: Option<String>) -> Result<(), Problem> {
    let Some(case) = expanded else { return write_file(path, certificate) };
    if path.as_os_str() == "-" {
        write_file(path, certificate)?;
        remark("note: the certificate is about the expanded case: `secant expand` writes it");
        return Ok(());
    }
    let beside = path.with_extension("case.toml");
    free(&beside, &case)?;
    write_file(path, certificate)?;
    write_file(&beside, format!("{BESIDE}{}\n{case}", sha256(&case)))?;
    let (case, path) = (beside.display(), path.display());
    remark(&format!(
        "note: the certificate is about the expanded case, which is in {case}: secant-check {case} {path}"
    ));
    Ok(())
}

/// Whether the case beside a certificate may be written: there is none yet, or one that was written in this way.
fn free(beside: &Path, case: &str) -> Result<(), Problem> {
    if place(beside).is_some_and(|p| INPUTS.get().is_some_and(|inputs| inputs.contains(&p))) {
        return Err(itself(beside));
    }
    let Ok(old) = std::fs::read_to_string(beside) else {
        return if beside.exists() { Err(foreign(beside)) } else { Ok(()) };
    };
    let rest = old.strip_prefix(BESIDE).and_then(|rest| rest.split_once('\n'));
    if old == case || rest.is_some_and(|(digest, text)| sha256(text) == digest.trim_end()) {
        return Ok(());
    }
    Err(foreign(beside))
}

fn foreign(beside: &Path) -> Problem {
    let message =
        format!("{} is another file, in whose place the case of the certificate would be written", beside.display());
    Problem::new("secant::output::beside", message).with_help(
        "the case is written beside its certificate: give that another name, or move the file; neither was written",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_beside_a_certificate_is_replaced_only_where_it_was_written_there() {
        let dir = tempfile::tempdir().unwrap_or_else(|e| panic!("{e}"));
        let (path, beside) = (dir.path().join("a.json"), dir.path().join("a.case.toml"));
        let write = |case: &str| write_certificate(&path, "{}".to_owned(), Some(case.to_owned()));
        assert!(write("name = 1\n").is_ok() && write("name = 2\n").is_ok());
        let edited = std::fs::read_to_string(&beside).unwrap_or_default().replace("name = 2", "name = 3");
        for mine in [edited.as_str(), "name = 4\n"] {
            std::fs::write(&beside, mine).unwrap_or_else(|e| panic!("{e}"));
            std::fs::remove_file(&path).unwrap_or_else(|e| panic!("{e}"));
            let problem = write("name = 5\n").err().unwrap_or_else(|| panic!("replaced {mine}"));
            assert_eq!(problem.id(), "secant::output::beside");
            assert_eq!(std::fs::read_to_string(&beside).unwrap_or_default(), mine);
            assert!(!path.exists());
            std::fs::write(&path, "").unwrap_or_else(|e| panic!("{e}"));
        }
        assert!(write("name = 4\n").is_ok());
    }
}
