//! `secant studio`: serves the page, says where it is, and opens it.

use super::output::{complain, print};
use super::{BAD_INPUT, INTERNAL};
use crate::studio::Studio;
use clap::Args;

/// A page to play on.
#[derive(Debug, Args)]
pub struct StudioArgs {
    /// The port of 127.0.0.1; any free one where none is given.
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Only print the address; do not open it in a browser.
    #[arg(long)]
    no_open: bool,
}

/// Serves until the process ends.
pub fn run(args: &StudioArgs) -> u8 {
    let studio = match Studio::bind(args.port) {
        Ok(studio) => studio,
        Err(problem) => {
            complain(&problem);
            return BAD_INPUT;
        }
    };
    let address = studio.address();
    print(&format!("{address}\n"));
    eprintln!("The studio is at this address, for this machine only, until Ctrl-C ends it.");
    if !args.no_open && opener::open(&address).is_err() {
        eprintln!("No browser could be opened: open the address yourself.");
    }
    match studio.serve() {
        Ok(never) => match never {},
        Err(problem) => {
            complain(&problem);
            INTERNAL
        }
    }
}
