//! Results kept between runs of `secant certify --resume DIR`.

use super::CertifyArgs;
use super::output::write_file;
use crate::certificate::sha256;
use crate::diagnostic::Problem;
use serde_json::{Value, json};
use std::path::{Component, Path, PathBuf};

/// A directory with one file of results for each case, and its certificate beside it.
pub struct Store {
    dir: PathBuf,
    /// What besides the text of a case decides its result.
    options: String,
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
        let options = format!("{:?} {}", args.address, args.no_check);
        Ok(Self { dir: dir.to_owned(), options })
    }

    /// The result kept for a case, where the text of the case, the options and the version are the same.
    pub fn find(&self, path: &Path) -> Option<Value> {
        let text = std::fs::read_to_string(path).ok()?;
        let stored: Value = serde_json::from_str(&std::fs::read_to_string(self.file(path, "result")?).ok()?).ok()?;
        let current = stored["secant"] == env!("CARGO_PKG_VERSION") && stored["digest"] == self.digest(&text);
        let certificate = match stored["certificate"].as_str() {
            Some(digest) => {
                let text = std::fs::read_to_string(self.file(path, "certificate")?).ok()?;
                sha256(&text) == digest
            }
            None => true,
        };
        (current && certificate).then(|| stored["result"].clone())
    }

    /// Keeps a result; the certificate is written before the result that names it.
    ///
    /// # Errors
    /// A [`Problem`] where a file cannot be written.
    pub fn keep(&self, path: &Path, text: &str, result: &Value, certificate: Option<&str>) -> Result<(), Problem> {
        if let (Some(file), Some(certificate)) = (self.file(path, "certificate"), certificate) {
            write_file(&file, certificate)?;
        }
        let Some(file) = self.file(path, "result") else { return Ok(()) };
        let stored = json!({
            "secant": env!("CARGO_PKG_VERSION"),
            "digest": self.digest(text),
            "certificate": certificate.map(sha256),
            "result": result,
        });
        write_file(&file, format!("{stored}\n"))
    }

    fn digest(&self, text: &str) -> String {
        sha256(&format!("{}\n{text}", self.options))
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
