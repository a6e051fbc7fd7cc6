//! `secant expand`: a case with every operator written out.

use super::PROVED;
use super::output::{print_or_write, settle};
use crate::case::Case;
use std::path::Path;

/// Writes the expanded case to the standard output or to a file.
pub fn run(path: &Path, output: Option<&Path>) -> u8 {
    settle(Case::read(path).and_then(|case| print_or_write(&case.expanded(), output)).map(|()| PROVED))
}
