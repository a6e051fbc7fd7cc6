//! Results kept between runs of `secant certify --resume DIR`.
//!
//! A result is taken from the directory only if the same program (by the digest of its file) wrote it about the same text
//! with the same options, nothing of it was changed since, and the checker accepts its certificate again.

use super::CertifyArgs;
use super::output::write_file;
use crate::case::{Case, Question};
use crate::certificate::sha256;
use crate::diagnostic::Problem;
use serde_json::{Value, json};
use std::path::{Component, Path, PathBuf};

/// A directory with one file of results for each case, and its certificate beside it.
pub struct Store {
    dir: PathBuf,
    /// What besides the text of a case decides its result: the program and the options; `None` where the program cannot read
    /// its own file, so that nothing is kept.
    maker: Option<String>,
}

/// A result that was kept.
pub struct Kept {
    /// The JSON report.
    pub report: Value,
    /// The kinds of its points, as the table shows them.
    pub kinds: String,
}

impl Store {
    /// Opens a directory, making it if needed.
    ///
    /// # Errors
    /// A [`Problem`] where it cannot be made.
    pub fn open(dir: &Path, args: &CertifyArgs) -> Result<Self, Problem> {
        std::fs::create_dir_all(dir).map_err(|error| {
            Problem::new("secant::output", format!("{} cannot be made: {error}", dir.display()))
                .with_help("--resume names a directory that can be written to")
        })?;
        let program = std::env::current_exe().and_then(std::fs::read).ok().map(sha256);
        let maker = program.map(|digest| {
            let version = env!("CARGO_PKG_VERSION");
            json!({"secant": version, "program": digest, "address": args.address, "unchecked": args.no_check, "effort": args.effort.word(), "cells": args.cells, "words": args.words, "require": args.require.to_string(), "verbose": args.verbose})
                .to_string()
        });
        Ok(Self { dir: dir.to_owned(), maker })
    }

    /// The result kept for a case, where it is up to date and whole, and its certificate still proves it.
    pub fn find(&self, path: &Path, question: &Question) -> Option<Kept> {
        let Question::Tangents { case, .. } = question else { return None };
        let stored: Value = serde_json::from_str(&std::fs::read_to_string(self.file(path, "result")?).ok()?).ok()?;
        let kept = Kept { report: stored["result"].clone(), kinds: stored["kinds"].as_str()?.to_owned() };
        let certificate = stored["certificate"].as_str();
        let whole = stored["seal"].as_str()? == self.seal(&case.text.text, &kept, certificate)?;
        let proved = match certificate {
            Some(digest) => self.proves(path, case, digest, kept.report["tangents"].as_str()?),
            // Without a certificate the report must not claim that there was one.
            None => kept.report["certificate"]["checked"] == false,
        };
        (whole && proved).then_some(kept)
    }

    /// Whether the certificate is the one written, and proves the verdict once more.
    fn proves(&self, path: &Path, case: &Case, digest: &str, verdict: &str) -> bool {
        let text = self.file(path, "certificate").and_then(|file| std::fs::read_to_string(file).ok());
        let text = text.filter(|text| sha256(text) == digest);
        let accepted = text.and_then(|text| secant_check::check(&case.checked_text(), &text).ok());
        accepted.is_some_and(|accepted| accepted.case == case.name && accepted.verdict.word() == verdict)
    }

    /// Keeps a result; the certificate is written before the result that names it.
    ///
    /// # Errors
    /// A [`Problem`] where a file cannot be written.
    pub fn keep(&self, path: &Path, text: &str, kept: &Kept, certificate: Option<&str>) -> Result<(), Problem> {
        let digest = certificate.map(sha256);
        let (Some(file), Some(seal)) = (self.file(path, "result"), self.seal(text, kept, digest.as_deref())) else {
            return Ok(());
        };
        if let (Some(file), Some(certificate)) = (self.file(path, "certificate"), certificate) {
            write_file(&file, certificate)?;
        }
        let stored = json!({"seal": seal, "certificate": digest, "kinds": kept.kinds, "result": kept.report});
        write_file(&file, format!("{stored}\n"))
    }

    /// The digest of everything that a result depends on, and of the result.
    fn seal(&self, text: &str, kept: &Kept, certificate: Option<&str>) -> Option<String> {
        let parts = json!([self.maker.as_ref()?, text, certificate, kept.kinds, kept.report]);
        Some(sha256(parts.to_string()))
    }

    /// `classical/levy.toml` is kept as `classical--levy.result.json`; the standard input is not kept.
    fn file(&self, path: &Path, what: &str) -> Option<PathBuf> {
        if path == Path::new("-") {
            return None;
        }
        let parts: Vec<String> = path
            .with_extension("")
            .components()
            .filter_map(|c| match c {
                Component::Normal(part) => Some(part.to_string_lossy().into_owned()),
                Component::ParentDir => Some("up".to_owned()),
                _ => None,
            })
            .collect();
        Some(self.dir.join(format!("{}.{what}.json", parts.join("--"))))
    }
}
