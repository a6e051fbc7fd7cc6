//! `secant schemes`: the named schemes, and each of them written as a case.

use super::PROVED;
use super::irrational;
use super::output::{deliver, print};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::Problem;
use crate::scheme::{self, Heading, case_text};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Lists the schemes, or writes one as a case file to the standard output.
pub fn run(name: Option<&str>, parameters: &[String]) -> u8 {
    let Some(name) = name else {
        let curves = scheme::list().iter().map(|i| entry(i.name, i.summary, i.parameters, i.source));
        let meshes = scheme::mesh_rules().iter().map(|i| entry(i.name, i.summary, i.parameters, i.source));
        let curves: String = curves.chain(irrational::list().iter().map(irrational::entry)).collect();
        let meshes: String = meshes.collect();
        print(&format!("{curves}\nMesh rules, for `mesh = …` and `valence = …` under [scheme] in a case:\n\n{meshes}"));
        return PROVED;
    };
    let text = irrational::written(name, parameters).unwrap_or_else(|| written(name, parameters));
    let problem = |message| {
        Problem::new("secant::scheme", message)
            .with_help("`secant schemes` lists the schemes; parameters are written as in degree=3")
    };
    deliver(text.map(|text| (text, PROVED)).map_err(problem))
}

/// Prints the list as JSON.
pub fn data() -> u8 {
    let parameter = |p: &scheme::Parameter| json!({ "name": p.name, "default": p.default, "summary": p.summary });
    let one = |kind: &str, name: &str, summary: &str, parameters: &[scheme::Parameter], source: &str| {
        let parameters: Vec<Value> = parameters.iter().map(parameter).collect();
        json!({ "kind": kind, "name": name, "summary": summary, "source": source, "parameters": parameters })
    };
    let curves = scheme::list().iter().map(|i| one("curve", i.name, i.summary, i.parameters, i.source));
    let meshes = scheme::mesh_rules().iter().map(|i| one("mesh", i.name, i.summary, i.parameters, i.source));
    print(&format!("{:#}\n", curves.chain(meshes).collect::<Value>()));
    PROVED
}

fn entry(name: &str, summary: &str, parameters: &[scheme::Parameter], source: &str) -> String {
    let parameter = |p: &scheme::Parameter| match p.default {
        Some(value) => format!("    {} (default {value}): {}\n", p.name, p.summary),
        None => format!("    {}: {}\n", p.name, p.summary),
    };
    let parameters: String = parameters.iter().map(parameter).collect();
    format!("{name}\n    {summary}\n{parameters}    source: {source}\n")
}

fn written(name: &str, parameters: &[String]) -> Result<String, String> {
    if let Some(own) = crate::case::unaliased(name) {
        let words: Vec<String> = own.split_whitespace().map(str::to_owned).collect();
        return written(&words[0], &[&words[1..], parameters].concat());
    }
    if scheme::mesh_rules().iter().any(|r| r.name == name) {
        return Err(format!("`{name}` is a mesh rule: write a case with [scheme] mesh = \"{name}\" and its valence"));
    }
    let mut values: BTreeMap<String, Rational> = BTreeMap::new();
    for text in parameters {
        let (key, value) = text.split_once('=').ok_or_else(|| format!("`{text}` is not of the form name=value"))?;
        values.insert(key.trim().to_owned(), parse_rational(value).map_err(|e| e.to_string())?);
    }
    let shape = scheme::build(name, &values).map_err(|e| e.to_string())?;
    let info = scheme::list().iter().find(|s| s.name == name);
    let tail: String = values.iter().map(|(k, v)| format!("-{k}-{}", v.to_string().replace('/', "o"))).collect();
    let heading = Heading {
        name: format!("{name}{tail}"),
        title: info.map(|i| i.summary.to_owned()).unwrap_or_default(),
        source: info.map(|i| i.source.to_owned()).unwrap_or_default(),
        ..Heading::default()
    };
    Ok(case_text(&shape, &heading))
}
