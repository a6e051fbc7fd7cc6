//! Writing: whole files or none, colours only for people.

use super::{BAD_INPUT, INTERNAL, PROVED};
use crate::diagnostic::Problem;
use crate::report::document::Document;
use crate::report::text::{self, Look};
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU8, Ordering};

/// Writes a file so that it is either there in full or not touched: a temporary file beside it, then a rename. `-` is the
/// standard output.
///
/// A target that exists and is no regular file (such as `/dev/stdout`) is written to directly.
///
/// # Errors
/// A [`Problem`] that names the file.
pub fn write_file(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Problem> {
    if path.as_os_str() == "-" {
        return to_standard_output(content.as_ref());
    }
    let problem = |error: &std::io::Error| {
        // The name of a temporary file says nothing to anybody.
        let error = error.to_string();
        let why = error.split(" at path ").next().unwrap_or(&error);
        Problem::new("secant::output", format!("{} cannot be written: {why}", path.display()))
            .with_help("the directory must exist and be writable; nothing was left half-written")
    };
    // A link stays a link: what it points to is replaced.
    let target: PathBuf = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if std::fs::metadata(&target).is_ok_and(|m| !m.is_file()) {
        return std::fs::write(&target, content.as_ref()).map_err(|e| problem(&e));
    }
    let directory = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".secant-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(&target).map_or(0o666, |m| m.permissions().mode() & 0o777);
        builder.permissions(std::fs::Permissions::from_mode(mode));
    }
    let mut file = builder.tempfile_in(directory).map_err(|e| problem(&e))?;
    file.write_all(content.as_ref()).and_then(|()| file.flush()).map_err(|e| problem(&e))?;
    file.persist(&target).map_err(|e| problem(&e.error))?;
    Ok(())
}

/// The options for files of a format, each with its endings.
type Slots<'a> = [(&'a [&'a str], &'a mut Option<PathBuf>)];

/// Puts a file at the option of the format that its ending says.
///
/// # Errors
/// A [`Problem`] where no option has this ending, or it is taken.
pub fn by_ending(path: PathBuf, slots: &mut Slots<'_>) -> Result<(), Problem> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let known: Vec<String> = slots.iter().flat_map(|(endings, _)| endings.iter().map(|e| format!(".{e}"))).collect();
    let Some((_, slot)) = slots.iter_mut().find(|(endings, _)| endings.contains(&ending.as_str())) else {
        return Err(Problem::new("secant::usage::format", format!("no format is known for {}", path.display()))
            .with_help(format!("the ending says the format: {}", known.join(", "))));
    };
    if slot.is_some() {
        return Err(Problem::new(
            "secant::usage::format",
            format!("{} is the second file of its format", path.display()),
        )
        .with_help("one file of each format is written"));
    }
    **slot = Some(path);
    Ok(())
}

/// Whether one of several outputs goes to the standard output.
///
/// # Errors
/// A [`Problem`] where more than one does.
pub fn to_stdout<const N: usize>(outputs: [&Option<PathBuf>; N]) -> Result<bool, Problem> {
    match outputs.iter().filter(|o| o.as_deref().is_some_and(|p| p.as_os_str() == "-")).count() {
        0 => Ok(false),
        1 => Ok(true),
        n => Err(Problem::new("secant::usage::output", format!("{n} files are to be written to the standard output"))
            .with_help("give `-` once, and names to the others")),
    }
}

/// Says something beside a file that may be on the standard output.
pub fn say(text: &str, piped: bool) {
    if piped {
        let _ = std::io::stderr().lock().write_all(text.as_bytes());
    } else {
        print(text);
    }
}

/// A remark on the standard error.
pub fn remark(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// The first problem of the standard output, with which the program ends.
static LOST: OnceLock<Problem> = OnceLock::new();

/// Prints to the standard output. A reader that went away is no mistake; any other failure ends the program with exit code 2.
pub fn print(text: &str) {
    if let Err(problem) = to_standard_output(text.as_bytes()) {
        LOST.get_or_init(|| problem);
    }
}

fn to_standard_output(bytes: &[u8]) -> Result<(), Problem> {
    let mut out = std::io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).or_else(|e| lost(&e))
}

fn lost(error: &std::io::Error) -> Result<(), Problem> {
    if error.kind() == ErrorKind::BrokenPipe {
        return Ok(());
    }
    Err(Problem::new("secant::output", format!("the standard output cannot be written: {error}"))
        .with_help("what was printed is not complete"))
}

/// The exit code of the program: that of the command, or 2 where not all of its answer could be printed.
pub fn finished(code: u8) -> u8 {
    let Some(problem) = LOST.get() else { return code };
    complain(problem);
    if code == INTERNAL { INTERNAL } else { BAD_INPUT }
}

/// The exit code of a message about the command line, such as the help that was asked for, which is printed.
pub fn explained(error: &clap::Error) -> u8 {
    match error.print().or_else(|e| lost(&e).map_err(|p| complain(&p))) {
        Ok(()) if !error.use_stderr() => PROVED,
        _ => BAD_INPUT,
    }
}

/// The exit code of a command that prints a text, or that of bad input with its diagnostic.
pub fn deliver(made: Result<(String, u8), Problem>) -> u8 {
    settle(made.map(|(text, code)| {
        print(&text);
        code
    }))
}

/// The exit code of a command, or that of its problem, which is printed.
pub fn settle(done: Result<u8, Problem>) -> u8 {
    done.unwrap_or_else(|problem| {
        complain(&problem);
        problem_code(&problem)
    })
}

/// The exit code of a problem.
#[must_use]
pub fn problem_code(problem: &Problem) -> u8 {
    if problem.is_internal() { INTERNAL } else { BAD_INPUT }
}

/// Prints a text, or writes it to a file, whole or not at all.
///
/// # Errors
/// A [`Problem`] that names the file.
pub fn print_or_write(text: &str, output: Option<&Path>) -> Result<(), Problem> {
    match output {
        Some(path) => write_file(path, text)?,
        None => print(text),
    }
    Ok(())
}

/// Prints a problem to the standard error.
pub fn complain(problem: &Problem) {
    let colour = colour_for(std::io::stderr().is_terminal());
    let mut err = std::io::stderr().lock();
    let _ = err.write_all(problem.render(colour).as_bytes());
}

/// How text is shown on the standard output: of a terminal as wide as it is, within what can be read.
#[must_use]
pub fn stdout_look() -> Look {
    let out = std::io::stdout();
    let terminal = out.is_terminal();
    let columns = terminal_size::terminal_size_of(&out).filter(|_| terminal).map(|(width, _)| usize::from(width.0));
    Look { colour: colour_for(terminal), width: columns.map_or(text::WIDTH, |c| c.clamp(40, 120)) }
}

/// A document as the standard output shows it.
#[must_use]
pub fn shown(document: &Document) -> String {
    text::render_as(document, stdout_look())
}

/// Whether colours are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Colour {
    /// On a terminal, unless `NO_COLOR` is set or it is a dumb one.
    #[default]
    Auto,
    /// Everywhere.
    Always,
    /// Nowhere.
    Never,
}

impl Colour {
    /// What the arguments say, before they are parsed; the parser complains of what is wrong with them.
    pub fn of_arguments(arguments: impl Iterator<Item = std::ffi::OsString>) -> Self {
        let words: Vec<String> = arguments.skip(1).map(|a| a.to_string_lossy().into_owned()).collect();
        let until = words.iter().position(|w| w == "--").unwrap_or(words.len());
        let value = |k: usize| match words[k].strip_prefix("--color") {
            Some("") => words.get(k + 1).map(String::as_str),
            Some(rest) => rest.strip_prefix('='),
            None => None,
        };
        match (0..until).find_map(value) {
            Some("always") => Self::Always,
            Some("never") => Self::Never,
            _ => Self::Auto,
        }
    }

    /// The same for the messages of the command line.
    pub fn of_help(self) -> clap::ColorChoice {
        match self {
            Self::Auto => clap::ColorChoice::Auto,
            Self::Always => clap::ColorChoice::Always,
            Self::Never => clap::ColorChoice::Never,
        }
    }
}

static COLOUR: AtomicU8 = AtomicU8::new(Colour::Auto as u8);

/// Says for the whole run of the program whether colours are used.
pub fn choose(colour: Colour) {
    COLOUR.store(colour as u8, Ordering::Relaxed);
}

fn colour_for(terminal: bool) -> bool {
    match COLOUR.load(Ordering::Relaxed) {
        x if x == Colour::Always as u8 => return true,
        x if x == Colour::Never as u8 => return false,
        _ => {}
    }
    let no_color = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|t| t == "dumb");
    terminal && !no_color && !dumb
}
