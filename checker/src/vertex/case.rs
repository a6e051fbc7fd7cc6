//! Cases about the vertices of a mesh: which scheme, and which valences.

use super::mesh::{Centre, MAX_VALENCE, Spline};
use super::own::Own;
use super::rule::Rule;
use crate::base::{Checked, Json, Node, Q, index, number, spend};
use num_traits::{One, ToPrimitive};
use std::collections::BTreeSet;

/// Largest frequency of the weights in a face.
const MAX_FREQUENCY: usize = 1024;

/// What a case says of its scheme.
pub enum Scheme {
    /// A spline away from the centre, and the weights there by valence.
    Spline(Spline, Box<dyn Fn(usize) -> Centre>),
    /// A rule by stencils.
    Rule(Rule),
}

/// A case about the vertices of a mesh.
pub struct Case {
    /// The name.
    pub name: String,
    /// The scheme.
    pub scheme: Scheme,
    /// The valences of the case, which may name none; `None` where it asks for all that there are.
    pub asked: Option<BTreeSet<usize>>,
}

/// `5`, `"3..32"`, `"3,5,8..10"` or `"all"`.
pub fn read_valences(node: &Node<'_>) -> Checked<Option<BTreeSet<usize>>> {
    let valence = |n: &usize| (2..=MAX_VALENCE).contains(n);
    let Json::Text(text) = node.value else {
        let n = index(node, MAX_VALENCE + 1)?;
        node.need(valence(&n), "format", format_args!("a valence is a number from 2 to {MAX_VALENCE}"))?;
        return Ok(Some(BTreeSet::from([n])));
    };
    if text.trim() == "all" {
        return Ok(None);
    }
    let mut all = BTreeSet::new();
    for part in text.split(',') {
        let (low, high) = match part.split_once("..") {
            Some((low, high)) => (low, high.trim_start_matches('=')),
            None => (part, part),
        };
        let bound = |s: &str| s.trim().parse().ok().filter(valence);
        match (bound(low), bound(high)) {
            (Some(low), Some(high)) if low <= high => {
                // A long list of long ranges is no more than all valences.
                spend(high - low + 1, 0)?;
                all.extend(low..=high);
            }
            _ => return node.reject("format", "valences are numbers and ranges"),
        }
    }
    Ok(Some(all))
}

fn ratio(p: usize, q: usize) -> Q {
    Q::new(p.into(), q.into())
}

/// The weights at a central vertex: of all edge neighbours together, and of all opposite corners; it has what is left itself.
fn vertex(edges: Q, corners: Q) -> Centre {
    Centre::Vertex([Q::one() - &edges - &corners, edges, corners])
}

/// The weights in a central face of `n` corners: what all have, and what the own one and its two neighbours have beside.
fn face(n: usize, all: Q, own: Q, near: Q) -> Centre {
    let weight = |j: usize| match j {
        0 => &all + &own,
        _ if j == 1 || j + 1 == n => &all + &near,
        _ => all.clone(),
    };
    Centre::Face((0..n).map(weight).collect())
}

impl Case {
    /// Reads a case.
    pub fn read(root: &Node<'_>) -> Checked<Self> {
        let name = root.field("name")?.text()?.to_owned();
        let table = root.field("vertex")?;
        let (scheme, keys) = match by_stencils(&table)? {
            Some((rule, keys)) => (Scheme::Rule(rule), keys),
            None => spline(&table)?,
        };
        table.known(&format!("mesh valence {keys}"))?;
        let asked = match table.get("valence") {
            None => Some(BTreeSet::new()),
            Some(node) => read_valences(&node)?,
        };
        Ok(Self { name, scheme, asked })
    }
}

impl Case {
    /// The case of a mesh by a named scheme without parameters.
    pub fn of_mesh(scheme: &str) -> Checked<Self> {
        let table = Json::Object(vec![("mesh".to_owned(), Json::Text(scheme.to_owned()))]);
        let (scheme, _) = spline(&Node { value: &table, place: String::new() })?;
        Ok(Self { name: "mesh".to_owned(), scheme, asked: None })
    }
}

/// Whether a weight is a table by valence, or a formula in it.
fn is_formula(node: &Node<'_>) -> bool {
    match node.value {
        Json::Object(_) => true,
        Json::Text(text) => text.contains(['n', 'c', '(']),
        _ => false,
    }
}

/// A rule that is looked at without patches, and its keys.
fn by_stencils(table: &Node<'_>) -> Checked<Option<(Rule, &'static str)>> {
    let turned = |triangles, near| Rule::Turned { triangles, near };
    Ok(match table.field("mesh")?.text()? {
        name @ ("butterfly" | "butterfly-modified") => {
            let tension = match table.get("w") {
                Some(w) => number(&w)?,
                None => ratio(1, 16),
            };
            Some((Rule::Butterfly { tension, modified: name != "butterfly" }, "w"))
        }
        "sqrt3" => Some((turned(true, None), "")),
        "sqrt3-variant" => Some((turned(true, Some(number(&table.field("alpha")?)?)), "alpha")),
        "four-eight" => Some((turned(false, None), "")),
        "own" => Some((Rule::Own(Own::read(table)?), "split stencil centre")),
        "loop-variant" if is_formula(&table.field("beta")?) => {
            Some((Rule::Own(Own::of_loop(&table.field("beta")?)?), "beta"))
        }
        _ => None,
    })
}

/// A rule with patches, and its keys.
fn spline(table: &Node<'_>) -> Checked<(Scheme, &'static str)> {
    let (mesh, parameter) = (table.field("mesh")?.text()?, |key: &str| number(&table.field(key)?));
    let (spline, centre, keys): (_, Box<dyn Fn(usize) -> Centre>, _) = match mesh {
        "catmull-clark" => (Spline::Bicubic, Box::new(|n| vertex(ratio(3, 2 * n), ratio(1, 4 * n))), ""),
        "quad-triangle" => (Spline::Bicubic, Box::new(|_| vertex(ratio(3, 8), ratio(1, 16))), ""),
        "catmull-clark-variant" => {
            let (alpha, beta) = (parameter("alpha")?, parameter("beta")?);
            let gamma = Q::one() - alpha - &beta;
            if table.get("gamma").is_some() {
                table.need(parameter("gamma")? == gamma, "case", "the weights do not add up to 1")?;
            }
            let centre = move |_| vertex(beta.clone(), gamma.clone());
            (Spline::Bicubic, Box::new(centre), "alpha beta gamma")
        }
        "loop" => (Spline::Quartic, Box::new(|_| Centre::Loop), ""),
        "loop-warren" => {
            let edges = |n| if n == 3 { ratio(9, 16) } else { ratio(3, 8) };
            (Spline::Quartic, Box::new(move |n| vertex(edges(n), ratio(0, 1))), "")
        }
        "loop-variant" => {
            let beta = parameter("beta")?;
            (Spline::Quartic, Box::new(move |n| vertex(&beta * ratio(n, 1), ratio(0, 1))), "beta")
        }
        "doo-sabin" if table.get("weights").is_some() => {
            let list = table.field("weights")?.each(number)?;
            (Spline::Biquadratic, Box::new(move |_| Centre::Face(list.clone())), "weights")
        }
        "doo-sabin" => (Spline::Biquadratic, Box::new(|_| Centre::Frequency(1)), ""),
        "doo-sabin-frequency" => {
            let f = match table.get("frequency") {
                None => 2,
                Some(node) => {
                    let f = number(&node)?;
                    let f = f.to_usize().filter(|k| f.is_integer() && (1..=MAX_FREQUENCY).contains(k));
                    node.some(f, "format", format_args!("a whole number from 1 to {MAX_FREQUENCY} is needed here"))?
                }
            };
            (Spline::Biquadratic, Box::new(move |_| Centre::Frequency(f)), "frequency")
        }
        "doo-sabin-catmull-clark" => {
            (Spline::Biquadratic, Box::new(|n| face(n, ratio(1, 4 * n), ratio(1, 2), ratio(1, 8))), "")
        }
        "midedge" => (Spline::Quadratic, Box::new(|n| face(n, ratio(0, 1), ratio(1, 2), ratio(1, 4))), ""),
        _ => return table.reject("format", "a scheme for which there are no certificates"),
    };
    Ok((Scheme::Spline(spline, centre), keys))
}
