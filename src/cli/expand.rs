//! `secant expand`: a case with every operator written out.

use super::output::{complain, print, write_file};
use super::{BAD_INPUT, PROVED};
use crate::case::Case;
use crate::diagnostic::Problem;
use std::path::Path;

/// Writes the expanded case to the standard output or to a file.
pub fn run(path: &Path, output: Option<&Path>) -> u8 {
    match Case::read(path).and_then(|case| deliver(&case.expanded(), output)) {
        Ok(()) => PROVED,
        Err(problem) => {
            complain(&problem);
            BAD_INPUT
        }
    }
}

/// Prints the text, or writes it to a file, whole or not at all.
///
/// # Errors
/// A [`Problem`] that names the file.
pub fn deliver(text: &str, output: Option<&Path>) -> Result<(), Problem> {
    match output {
        Some(path) => write_file(path, text),
        None => {
            print(text);
            Ok(())
        }
    }
}
