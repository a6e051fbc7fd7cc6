//! Mesh rules by stencils in a `[vertex]` table: `mesh = "own"`, and weights of `loop-variant` as formulas or tables in the valence.

use super::node::{Node, Table};
use super::vertex::{Valences, valences};
use crate::diagnostic::Problem;
use crate::scheme::{Formula, MeshRule, OwnCentre, OwnRule, SchemeError};
use std::collections::{BTreeMap, BTreeSet};

/// The keys of a rule by stencils.
const KEYS: [&str; 6] = ["mesh", "valence", "cell", "split", "stencil", "centre"];
/// Valences at which weights are looked at where the case names none.
const LOOKED_AT: std::ops::RangeInclusive<usize> = 3..=12;

/// The rule of `mesh = "own"`.
pub(super) fn own_rule(table: &Table<'_>) -> Result<MeshRule, Problem> {
    table.only(&KEYS)?;
    let split = table.need("split", "\"quads\"")?;
    let mut own = OwnRule::new(split.text()?).ok_or_else(|| {
        split
            .problem("value", "no such way of dividing faces", "not known")
            .with_help(format!("write split = {}", OwnRule::splits().join(", or ")))
    })?;
    let node = table.need("stencil", "{ vertex = { vertex = 1 }, edge = { ends = \"1/2\" } }")?;
    let stencils = node.table()?;
    stencils.only(&keys(&own))?;
    for element in own.elements() {
        let stencil = stencils.need(element.key(), "{ vertex = 1 }")?;
        let weights = stencil.table()?;
        for key in weights.keys() {
            let Some(weight) = weights.get(&key) else { continue };
            let wrong = |message: String| {
                weight
                    .problem("stencil", message, "here")
                    .with_help("docs/case-format.md lists the neighbours of a stencil")
            };
            let places = own.places(*element, &key).map_err(wrong)?;
            own.add(*element, places, &weight.number()?).map_err(|e| wrong(e.to_string()))?;
        }
    }
    if let Some(node) = table.get("centre") {
        let tables = if node.is_list() { node.tables(|k| format!("`centre` {}", k + 1))? } else { vec![node.table()?] };
        for centre in tables {
            let read = self::centre(&own, &centre)?;
            own.add_centre(read);
        }
    }
    let rule = MeshRule::of_stencils(own).map_err(|e| refused(&node, &e))?;
    looked_at(table, rule)
}

fn keys(own: &OwnRule) -> Vec<&'static str> {
    own.elements().iter().map(|e| e.key()).collect()
}

fn refused(node: &Node<'_>, error: &SchemeError) -> Problem {
    node.problem("stencil", error.to_string(), "here").with_help(
        "a weight holds for each of the images of a neighbour; weights of a new point add up to 1 with all of them",
    )
}

fn centre(own: &OwnRule, table: &Table<'_>) -> Result<OwnCentre, Problem> {
    let known: Vec<&'static str> = keys(own).into_iter().chain(["valence"]).collect();
    table.only(&known)?;
    let mut stencils = BTreeMap::new();
    for element in own.elements() {
        let Some(node) = table.get(element.key()) else { continue };
        let weights = node.table()?;
        let mut terms = Vec::new();
        for key in weights.keys() {
            let Some(weight) = weights.get(&key) else { continue };
            let wrong = |message: String| weight.problem("stencil", message, "here");
            let term = own.term(&key, formula(&weight)?);
            terms.push(term.map_err(|e| wrong(e).with_help("docs/case-format.md lists the neighbours at the centre"))?);
        }
        stencils.insert(*element, terms);
    }
    let valences = table.get("valence").map(|node| numbers(&node)).transpose()?;
    Ok(OwnCentre { valences, stencils })
}

fn numbers(node: &Node<'_>) -> Result<BTreeSet<usize>, Problem> {
    match valences(node)? {
        Valences::List(list) => Ok(list.into_iter().collect()),
        Valences::All => Err(node
            .problem("value", "these stencils hold for some valences", "`all` is no list")
            .with_help("leave `valence` out for all but the regular one")),
    }
}

/// A number or a formula.
fn formula(node: &Node<'_>) -> Result<Formula, Problem> {
    match node.text() {
        Ok(text) => Formula::parse(text).map_err(|message| {
            node.problem("formula", format!("the formula cannot be read: {message}"), "not a formula").with_help(
                "formulas have numbers, n (the valence), k (the sector), pi, cos(…), brackets and + - * / ^, \
                 as in \"(1/4 + cos(2*pi*k/n))/n\"",
            )
        }),
        Err(_) => node.number().map(Formula::number),
    }
}

/// Whether the weight of `loop-variant` is a formula or a table by valence, which are rules by stencils.
pub(super) fn is_formula(node: &Node<'_>) -> bool {
    node.table().is_ok() || node.text().is_ok_and(|text| text.contains(['n', 'c', '(']))
}

/// `loop-variant` with a formula in `n`, or with a table such as `{ 3 = "3/16", else = "3/(8*n)" }`.
pub(super) fn loop_rule(table: &Table<'_>, node: &Node<'_>) -> Result<MeshRule, Problem> {
    table.only(&["mesh", "valence", "cell", "beta"])?;
    let mut weights = Vec::new();
    if let Ok(by_valence) = node.table() {
        let mut rest = None;
        for key in by_valence.keys() {
            let Some(weight) = by_valence.get(&key) else { continue };
            let weight_of = formula(&weight)?;
            if key == "else" {
                rest = Some(weight_of);
                continue;
            }
            let listed =
                Valences::parse(&key).ok().and_then(|v| if let Valences::List(l) = v { Some(l) } else { None });
            let Some(listed) = listed else {
                return Err(weight
                    .problem("value", format!("`{key}` is no valence"), "not a valence")
                    .with_help("write beta = { 3 = \"3/16\", \"4..8\" = \"3/(8*n)\", else = \"1/20\" }"));
            };
            weights.push((Some(listed.into_iter().collect()), weight_of));
        }
        // The weight holds at the regular valence too.
        let all = |w: Formula| [(Some(BTreeSet::from([6])), w.clone()), (None, w)];
        weights.extend(rest.into_iter().flat_map(all));
    } else {
        let weight = formula(node)?;
        weights = vec![(Some(BTreeSet::from([6])), weight.clone()), (None, weight)];
    }
    let rule = MeshRule::of_stencils(OwnRule::of_loop(weights)).map_err(|e| refused(node, &e))?;
    looked_at(table, rule)
}

/// The rule, where its weights have values at the valences that the case names.
fn looked_at(table: &Table<'_>, rule: MeshRule) -> Result<MeshRule, Problem> {
    let list = match table.get("valence").map(|node| valences(&node)).transpose()? {
        Some(Valences::List(list)) => list,
        _ => LOOKED_AT.collect(),
    };
    for n in list.into_iter().take(LOOKED_AT.count()) {
        rule.check_at(n).map_err(|e| {
            let at = table.get("centre").or_else(|| table.get("beta"));
            at.map_or_else(|| table.problem("stencil", e.to_string(), "here"), |node| refused(&node, &e))
        })?;
    }
    Ok(rule)
}
