//! The question that the command line asks.

use super::CertifyArgs;
use crate::case::{Question, Valences};
use crate::diagnostic::Problem;
use std::path::Path;

/// The question of a file with the addresses and valences of the command line.
///
/// # Errors
/// The [`Problem`] of the file, or of an option that does not go with it.
pub fn question(path: &Path, args: &CertifyArgs) -> Result<Question, Problem> {
    let question = match args.valence.as_deref() {
        None => Question::ask(&path.to_string_lossy())?,
        Some(text) => Question::at_valences(path, valences(text)?)?,
    };
    args.address.iter().try_fold(question, |question, text| question.with_address(text))
}

fn valences(text: &str) -> Result<Valences, Problem> {
    Valences::parse(text).map_err(|error| {
        Problem::new("secant::usage::valence", error)
            .with_help("write --valence 5, --valence 3..32 (both ends included), --valence 3,5,8 or --valence all")
    })
}
