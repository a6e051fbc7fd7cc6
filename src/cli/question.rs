//! The question that the command line asks.

use super::CertifyArgs;
use crate::budget::Effort;
use crate::case::{Question, Valences};
use crate::diagnostic::Problem;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The question of a file with the addresses and valences of the command line.
///
/// # Errors
/// The [`Problem`] of the file, or of an option that does not go with it.
pub fn question(path: &Path, args: &CertifyArgs) -> Result<Question, Problem> {
    let question = match args.valence.as_deref() {
        None => Question::ask(&path.to_string_lossy())?,
        Some(text) => Question::at_valences(&path.to_string_lossy(), valences(text)?)?,
    };
    args.address.iter().try_fold(question, |question, text| question.with_address(text))
}

fn valences(text: &str) -> Result<Valences, Problem> {
    Valences::parse(text).map_err(|error| {
        Problem::new("secant::usage::valence", error)
            .with_help("write --valence 5, --valence 3..32 (both ends included), --valence 3,5,8 or --valence all")
    })
}

/// What is asked about, each parameter `name=value` joined to the scheme before it.
pub fn joined(given: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut cases: Vec<PathBuf> = Vec::new();
    for case in given {
        let parameter = case.to_str().is_some_and(is_parameter) && !case.exists();
        match cases.last_mut().filter(|_| parameter) {
            Some(scheme) => {
                let joined = scheme.as_mut_os_string();
                joined.push(" ");
                joined.push(case);
            }
            None => cases.push(case),
        }
    }
    cases
}

/// The arguments with a blank before each mask that begins with a minus sign, which would be read as an option.
pub fn with_masks(arguments: impl Iterator<Item = OsString>, program: &clap::Command) -> Vec<OsString> {
    let all: Vec<OsString> = arguments.collect();
    let command = all.get(1).and_then(|name| program.find_subcommand(name));
    let takes_value = |before: &OsString| {
        let named = |a: &&clap::Arg| {
            let long = before.to_str().and_then(|w| w.strip_prefix("--"));
            let short = before.to_str().filter(|w| w.len() == 2).and_then(|w| w.strip_prefix('-')?.chars().next());
            a.get_long().is_some_and(|l| long == Some(l)) || a.get_short().is_some_and(|s| short == Some(s))
        };
        command.is_some_and(|c| c.get_arguments().filter(named).any(|a| a.get_action().takes_values()))
    };
    let is_mask = |word: &str| {
        let first = word.strip_prefix('-').and_then(|rest| rest.chars().next());
        first.is_some_and(|c| c.is_ascii_digit() || c == '.') && word.contains([',', ' '])
    };
    let one = |(k, word): (usize, &OsString)| match word.to_str().filter(|w| is_mask(w)) {
        Some(mask) if k > 1 && !takes_value(&all[k - 1]) => OsString::from(format!(" {mask}")),
        _ => word.clone(),
    };
    all.iter().enumerate().map(one).collect()
}

/// Whether a word is of the form `name=value`.
pub fn is_parameter(text: &str) -> bool {
    let name = text.split_once('=').map(|(name, _)| name.trim());
    name.is_some_and(|n| !n.is_empty() && n.chars().all(|c| c.is_alphanumeric() || c == '_'))
}

/// The part and the number of parts of `I/N`.
pub fn shard(text: &str) -> Result<(usize, usize), String> {
    let (part, parts) = text.split_once('/').ok_or("write I/N, as in 3/16")?;
    let number = |s: &str| s.parse::<usize>().map_err(|_| format!("`{s}` is no whole number"));
    let (part, parts) = (number(part)?, number(parts)?);
    if part == 0 || part > parts { Err(format!("{part} is not from 1 to {parts}")) } else { Ok((part, parts)) }
}

/// The effort that a word names.
pub fn effort(word: &str) -> Result<Effort, String> {
    [Effort::Quick, Effort::Normal, Effort::Hard]
        .into_iter()
        .find(|e| e.word() == word)
        .ok_or_else(|| "it is quick, normal or hard".to_owned())
}
