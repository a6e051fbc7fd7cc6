//! `secant man`: manual pages of the program and of its commands.

use super::output::{print, settle, write_file};
use super::{Cli, PROVED};
use crate::diagnostic::Problem;
use clap::CommandFactory;
use clap_mangen::Man;
use std::path::Path;

/// Prints the page of the program or of a command, or writes all pages to a directory.
pub fn run(command: Option<&str>, out: Option<&Path>) -> u8 {
    let done = match out {
        Some(directory) => written(directory),
        None => page(command).map(|text| print(&text)),
    };
    settle(done.map(|()| PROVED))
}

/// The program with its commands, each with its whole name, as in `secant-certify`.
fn commands() -> (clap::Command, Vec<clap::Command>) {
    let mut program = Cli::command().disable_help_subcommand(true);
    program.build();
    let shown = program.get_subcommands().filter(|c| !c.is_hide_set());
    let all = shown.map(|c| c.clone().version(env!("CARGO_PKG_VERSION"))).collect();
    (program, all)
}

fn page(name: Option<&str>) -> Result<String, Problem> {
    let (program, all) = commands();
    let Some(name) = name else { return Ok(roff(program)) };
    let known: Vec<String> = all.iter().map(|c| c.get_name().to_owned()).collect();
    let found = all.into_iter().find(|c| c.get_name() == name);
    found.map(roff).ok_or_else(|| {
        Problem::new("secant::usage::man", format!("there is no command `{name}`"))
            .with_help(format!("the commands are {}", known.join(", ")))
    })
}

fn written(directory: &Path) -> Result<(), Problem> {
    std::fs::create_dir_all(directory).map_err(|e| {
        Problem::new("secant::output", format!("{} cannot be made: {e}", directory.display()))
            .with_help("name a directory that can be written to")
    })?;
    let (program, all) = commands();
    for command in [vec![program], all].concat() {
        let file = directory.join(format!("{}.1", command.get_display_name().unwrap_or(command.get_name())));
        write_file(&file, roff(command))?;
    }
    Ok(())
}

fn roff(command: clap::Command) -> String {
    let mut text = Vec::new();
    // Writing to memory does not fail.
    let _ = Man::new(command).render(&mut text);
    String::from_utf8_lossy(&text).into_owned()
}
