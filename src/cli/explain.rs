//! `secant explain`: the statements.

use super::output::{complain, print, stdout_colour};
use super::{BAD_INPUT, PROVED};
use crate::diagnostic::Problem;
use crate::report::document::{Block, Document, Inline, Line, line, words};
use crate::report::text;
use crate::statement::Statement;

/// Prints one statement, or the list of their names.
pub fn run(name: Option<&str>) -> u8 {
    let Some(name) = name else {
        let items = Statement::ALL.iter().map(|s| (s.id().to_owned(), words(s.name())));
        show("Statements", vec![Block::Facts(items.collect())]);
        return PROVED;
    };
    let Some(statement) = Statement::named(name) else {
        complain(&unknown(name));
        return BAD_INPUT;
    };
    let text = statement.text();
    let mut blocks = vec![Block::Statement(statement)];
    for (k, paragraph) in text.proof.iter().enumerate() {
        blocks.push(Block::Paragraph(if k == 0 { headed("Proof.", paragraph) } else { line(paragraph, []) }));
    }
    blocks.push(Block::Paragraph(headed("Reference.", &text.reference)));
    show(&text.name, blocks);
    PROVED
}

/// A paragraph after a word that stands out.
fn headed(head: &str, body: &str) -> Line {
    let mut text: Line = vec![Inline::Strong(head.to_owned()), Inline::Text(" ".to_owned())];
    text.extend(line(body, []));
    text
}

/// What to say about a name that is unknown, with the names that resemble it.
fn unknown(name: &str) -> Problem {
    let near = Statement::near(name);
    let help = if near.is_empty() {
        "`secant explain` without a name lists all statements".to_owned()
    } else {
        format!("did you mean {}?", near.join(", "))
    };
    Problem::new("secant::usage::explain", format!("there is no statement `{name}`")).with_help(help)
}

fn show(title: &str, blocks: Vec<Block>) {
    print(&text::render(&Document { title: title.to_owned(), blocks }, stdout_colour()));
}
