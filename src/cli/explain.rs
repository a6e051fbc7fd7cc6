//! `secant explain`: the statements.

use super::output::{complain, print, stdout_colour};
use super::{BAD_INPUT, PROVED};
use crate::diagnostic::Problem;
use crate::report::document::{Block, Document, Inline, Line, line};
use crate::report::text;
use crate::report::theorems::{THEOREMS, find};

/// Prints one statement, or the list of their names.
pub fn run(name: Option<&str>) -> u8 {
    let Some(name) = name else {
        let items = THEOREMS.iter().map(|t| (t.id.to_owned(), line(t.name, [])));
        show("Statements", vec![Block::Facts(items.collect())]);
        return PROVED;
    };
    match find(name) {
        Ok(theorem) => {
            let part = |head: &str, body: &str| -> Block {
                let mut text: Line = vec![Inline::Strong(head.to_owned()), Inline::Text(" ".to_owned())];
                text.extend(line(body, []));
                Block::Paragraph(text)
            };
            let body = Block::Paragraph(line(theorem.body, []));
            show(theorem.name, vec![body, part("Proof.", theorem.proof), part("Reference.", theorem.reference)]);
            PROVED
        }
        Err(names) => {
            let problem = Problem::new("secant::usage::explain", format!("there is no statement `{name}`"))
                .with_help(format!("the statements are {}", names.join(", ")));
            complain(&problem);
            BAD_INPUT
        }
    }
}

fn show(title: &str, blocks: Vec<Block>) {
    print(&text::render(&Document { title: title.to_owned(), blocks }, stdout_colour()));
}
