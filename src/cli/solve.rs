//! `secant solve`.

use super::certify::json_text;
use super::output::{print, settle, write_file};
use super::progress::Waiting;
use super::{PROVED, REFUTED, SolveArgs};
use crate::ask::solve;
use crate::case::Case;

/// Solves the case, prints what was found and writes the solved case.
pub fn run(args: &SolveArgs) -> u8 {
    let waiting = Waiting::with("solving …", args.quiet);
    let found = Case::read_open(&args.case).and_then(|case| solve(&case, &args.set, args.certificate.is_some()));
    waiting.finish();
    let done = found.and_then(|found| {
        for (path, text) in [(&args.certificate, &found.certificate), (&args.output, &found.case)] {
            if let (Some(path), Some(text)) = (path, text) {
                write_file(path, text)?;
            }
        }
        Ok(found)
    });
    settle(done.map(|found| {
        if args.json {
            print(&json_text(&found.json, true));
        } else if !args.quiet {
            print(&found.text);
        }
        if found.case.is_some() { PROVED } else { REFUTED }
    }))
}
