//! `secant explain`: the statements, and the words of the glossary.

use super::output::{complain, print, shown};
use super::{BAD_INPUT, PROVED};
use crate::diagnostic::Problem;
use crate::glossary;
use crate::report::document::{Block, Document, Inline, Line, line, words};
use crate::statement::Statement;
use serde_json::{Value, json};

/// Prints one statement or word, or the list of their names, as text or as data.
pub fn run(name: Option<&str>, json: bool) -> u8 {
    if json {
        return match data(name) {
            Ok(found) => {
                print(&format!("{found:#}\n"));
                PROVED
            }
            Err(problem) => {
                complain(&problem);
                BAD_INPUT
            }
        };
    }
    let Some(name) = name else {
        let items = Statement::ALL.iter().map(|s| (s.id().to_owned(), words(s.name())));
        let names: Vec<&str> = glossary::words().iter().map(|w| w.name.as_str()).collect();
        let listed = format!("Words: {}.", names.join(", "));
        show("Statements and words", vec![Block::Facts(items.collect()), Block::Paragraph(words(listed))]);
        return PROVED;
    };
    let Some(statement) = Statement::named(name) else {
        if let Some(word) = glossary::word(name) {
            show(&word.name, vec![Block::text(&word.text, [])]);
            return PROVED;
        }
        complain(&unknown(name));
        return BAD_INPUT;
    };
    let text = statement.text();
    let mut blocks = vec![Block::Statement(statement)];
    for (k, paragraph) in text.proof.iter().enumerate() {
        blocks.push(Block::Paragraph(if k == 0 { headed("Proof.", paragraph) } else { line(paragraph, []) }));
    }
    blocks.push(Block::Paragraph(headed("Reference.", &text.reference)));
    let symbols = "$V, L, K, X, q, E_i, F_i, π_i, U, u, G, D^*$ are defined in docs/theory.md §§2–5; words such as `ring` have an entry of their own here.";
    blocks.push(Block::Paragraph(headed("Symbols.", symbols)));
    show(&text.name, blocks);
    PROVED
}

/// A statement or a word as data (docs/json.md), or the names of all.
fn data(name: Option<&str>) -> Result<Value, Problem> {
    let Some(name) = name else {
        let statements = Statement::ALL.iter().map(|s| json!({"id": s.id(), "name": s.name()}));
        let names = glossary::words().iter().map(|w| w.name.as_str());
        return Ok(json!({"statements": statements.collect::<Vec<_>>(), "words": names.collect::<Vec<_>>()}));
    };
    if let Some(statement) = Statement::named(name) {
        let text = statement.text();
        let hypotheses = text.hypotheses.iter().map(|h| json!({"name": h.name, "text": h.text}));
        return Ok(json!({
            "id": statement.id(),
            "name": text.name,
            "hypotheses": hypotheses.collect::<Vec<_>>(),
            "statement": text.body,
            "proof": text.proof,
            "reference": text.reference,
        }));
    }
    match glossary::word(name) {
        Some(word) => Ok(json!({"word": word.name, "text": word.text})),
        None => Err(unknown(name)),
    }
}

/// A paragraph after a word that stands out.
fn headed(head: &str, body: &str) -> Line {
    let mut text: Line = vec![Inline::Strong(head.to_owned()), Inline::Text(" ".to_owned())];
    text.extend(line(body, []));
    text
}

/// What to say about a name that is unknown, with the names that resemble it.
fn unknown(name: &str) -> Problem {
    let mut near = Statement::near(name);
    let small = name.trim().to_lowercase();
    let like = |w: &&glossary::Word| strsim::jaro_winkler(&w.name.to_lowercase(), &small) > 0.85;
    near.extend(glossary::words().iter().filter(like).map(|w| w.name.as_str()));
    let help = if near.is_empty() {
        "`secant explain` without a name lists all statements and words".to_owned()
    } else {
        format!("did you mean {}?", near.join(", "))
    };
    Problem::new("secant::usage::explain", format!("there is no statement or word `{name}`")).with_help(help)
}

fn show(title: &str, blocks: Vec<Block>) {
    print(&shown(&Document { title: title.to_owned(), blocks }));
}
