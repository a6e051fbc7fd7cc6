//! The text of case files, whole and within limits.

use super::MAX_BYTES;
use crate::diagnostic::{Problem, SourceText};
use std::io::Read;
use std::path::Path;

impl SourceText {
    /// The text of a file; `-` is the standard input.
    ///
    /// # Errors
    /// A [`Problem`] where it cannot be read, has more than [`MAX_BYTES`] bytes, or is not UTF-8 text.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        if path.as_os_str() == "-" {
            return Self::from_reader("<stdin>", std::io::stdin().lock());
        }
        let name = path.display().to_string();
        let file = std::fs::File::open(path).map_err(|e| unreadable(&name, &e))?;
        if file.metadata().is_ok_and(|m| m.is_dir()) {
            return Err(Problem::new("secant::case::unreadable", format!("{name} is a directory"))
                .with_help("give the path of a case file, such as cases/thesis/half-tangent.toml"));
        }
        Self::from_reader(&name, file)
    }

    /// The text of a stream; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`SourceText::read`].
    pub fn from_reader(name: &str, stream: impl Read) -> Result<Self, Problem> {
        let mut bytes = Vec::new();
        stream.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(|e| unreadable(name, &e))?;
        if bytes.len() > MAX_BYTES {
            return Err(too_large(name));
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => {
                let at = error.utf8_error().valid_up_to();
                let valid = String::from_utf8_lossy(&error.as_bytes()[..at]).into_owned();
                let (line, column) = Self::new(name, valid).position(at);
                Err(Problem::new("secant::case::encoding", format!("{name}:{line}:{column}: this is not UTF-8 text"))
                    .with_help("case files are UTF-8 text in the TOML format"))
            }
        }
    }
}

pub(super) fn too_large(name: &str) -> Problem {
    Problem::new("secant::case::too-large", format!("{name} is larger than {MAX_BYTES} bytes"))
        .with_help("case files are at most 4 MiB long")
}

fn unreadable(name: &str, error: &std::io::Error) -> Problem {
    Problem::new("secant::case::unreadable", format!("{name} cannot be read: {error}"))
        .with_help("give the path of a case file, or `-` for the standard input")
}
