//! `secant solve`.

use super::certify::json_text;
use super::files::Written;
use super::output::{print, settle};
use super::progress::Waiting;
use super::{PROVED, REFUTED, SolveArgs};
use crate::ask::solve;
use crate::case::Case;

/// Solves the case, prints what was found and writes the solved case.
pub fn run(args: &SolveArgs) -> u8 {
    let waiting = Waiting::with("solving …", args.quiet);
    let found = Case::read_open(&args.case).and_then(|case| solve(&case, &args.set, args.certificate.is_some()));
    waiting.finish();
    settle(found.map(|found| {
        let mut written = Written::default();
        for (path, text) in [(&args.certificate, &found.certificate), (&args.output, &found.case)] {
            if let (Some(path), Some(text)) = (path, text) {
                written.file(Some(path), |_| Ok(text));
            }
        }
        if args.json {
            print(&json_text(&found.json, true));
        } else if !args.quiet {
            print(&found.text);
        }
        written.code(if found.case.is_some() { PROVED } else { REFUTED })
    }))
}
