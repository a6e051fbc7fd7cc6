//! Case files about the vertices of a mesh: a `[vertex]` table names the rule on meshes, its weights and the valences.

use super::node::{File, Node, Table};
use super::own;
use crate::answer::Verdict;
use crate::arith::{Rational, ratio};
use crate::diagnostic::{Problem, SourceText};
use crate::scheme::{MAX_VALENCE, MeshRule, SchemeError, mesh_rule, mesh_rules};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The valences asked about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Valences {
    /// These, ascending.
    List(Vec<usize>),
    /// Every valence from 3 on.
    All,
}

impl Valences {
    /// Reads `5`, `3..32` (both ends included), `3,5,8..10` or `all`.
    ///
    /// # Errors
    /// What is wrong, in words.
    ///
    /// # Examples
    /// ```
    /// use secant::case::Valences;
    /// assert_eq!(Valences::parse("3..5, 8"), Ok(Valences::List(vec![3, 4, 5, 8])));
    /// assert_eq!(Valences::parse("all"), Ok(Valences::All));
    /// assert!(Valences::parse("1").is_err());
    /// ```
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.trim() == "all" {
            return Ok(Self::All);
        }
        Self::numbers(text, 2, "valence").map(Self::List)
    }

    fn numbers(text: &str, least: usize, what: &str) -> Result<Vec<usize>, String> {
        let number = |part: &str| {
            let n: usize = part.trim().parse().map_err(|_| format!("`{}` is no {what}", part.trim()))?;
            if (least..=MAX_VALENCE).contains(&n) {
                Ok(n)
            } else {
                Err(format!("the {what} {n} is not between {least} and {MAX_VALENCE}"))
            }
        };
        let mut all = BTreeSet::new();
        for part in text.split(',') {
            match part.split_once("..") {
                Some((from, to)) => {
                    let (from, to) = (number(from)?, number(to.trim_start_matches('='))?);
                    if from > to {
                        return Err(format!("the range {from}..{to} is empty"));
                    }
                    all.extend(from..=to);
                }
                None => {
                    all.insert(number(part)?);
                }
            }
        }
        Ok(all.into_iter().collect())
    }
}

/// A case about the vertices of a mesh.
#[derive(Debug, Clone)]
pub struct VertexCase {
    /// The name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Where the scheme and the claim come from.
    pub source: Option<String>,
    /// The name of the scheme.
    pub scheme: String,
    /// The rule.
    pub rule: MeshRule,
    /// The valences of the file.
    pub valences: Option<Valences>,
    /// The case is about vertices on the border: whether that is a smooth curve there, or the vertex is a corner. The valences
    /// are then numbers of faces.
    pub border: Option<bool>,
    /// What a test expects at which valences.
    pub expect: Vec<(usize, Verdict)>,
    /// Whether the file has a `[vertex]` table; asked for valences, a `[scheme]` of a mesh is a case about vertices too.
    pub declared: bool,
    /// The file.
    pub text: SourceText,
}

impl VertexCase {
    /// Reads and checks a case file; `-` is the standard input.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with it.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        Self::parse(&source.name, &source.text)
    }

    /// Reads and checks the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`VertexCase::read`].
    pub fn parse(name: &str, text: &str) -> Result<Self, Problem> {
        super::read::parsed(name, &super::valued(name, text)?, File::new, Self::of_table)
    }

    /// The case of a table that was parsed.
    pub(super) fn of_table(file: &File, root: &Table<'_>) -> Result<Self, Problem> {
        super::member::left_free(root).map_or(Ok(()), Err)?;
        // With --valence a `[scheme]` of a mesh is a case about vertices too.
        let mesh = |t: &Table<'_>| t.get("mesh").is_some();
        let scheme = root.get("scheme").map(|node| node.table()).transpose()?.filter(mesh);
        if root.get("vertex").is_none() && scheme.is_none() {
            let name = &file.source.name;
            let message = format!("{name} has no [vertex] table, so that there are no valences to go through");
            return Err(Problem::new("secant::case::missing-key", message).with_help(
                "--valence is for cases such as cases/surfaces/catmull-clark.toml; see docs/case-format.md",
            ));
        }
        if scheme.is_none() {
            root.only(&["name", "title", "source", "vertex", "expect"])?;
        }
        let case_name = super::read::name(root)?;
        let title = root.optional_text("title")?.unwrap_or(&case_name).to_owned();
        let expects = scheme.is_none();
        let mut vertex = match scheme {
            Some(table) => table,
            None => root.need("vertex", "{ mesh = \"catmull-clark\" }")?.table()?,
        };
        vertex.what = if expects { "`[vertex]`" } else { "`[scheme]`" }.to_owned();
        let (scheme, rule) = rule(&vertex)?;
        let border = border(&vertex, &scheme)?;
        let asked = match (vertex.get("valence"), vertex.get("faces"), border) {
            (Some(node), None, None) => Some(valences(&node)?),
            (None, Some(node), Some(_)) => Some(faces(&node)?),
            (None, None, _) => None,
            (Some(node), ..) => {
                return Err(node
                    .problem("value", "on the border there is no valence", "not here")
                    .with_help("write faces = \"1..12\", the numbers of faces at the vertex"));
            }
            (None, Some(node), None) => {
                return Err(node
                    .problem("value", "faces are counted on the border only", "not here")
                    .with_help("write boundary = \"smooth\" or \"corner\" beside it, or valence = \"3..12\""));
            }
        };
        let read = if border.is_some() { faces } else { valences };
        let expect =
            root.get("expect").filter(|_| expects).map(|node| expect(&node, read)).transpose()?.unwrap_or_default();
        let source = root.optional_text("source")?.map(str::to_owned);
        let (name, text) = (case_name, file.source.clone());
        Ok(Self { name, title, source, scheme, rule, valences: asked, border, expect, declared: expects, text })
    }
}

/// Whether the case is about the border, and of what kind it is there.
fn border(table: &Table<'_>, scheme: &str) -> Result<Option<bool>, Problem> {
    let Some(node) = table.get("boundary") else { return Ok(None) };
    if !ON_BORDERS.contains(&scheme) {
        return Err(node
            .problem("value", format!("{scheme} has no rules of the border"), "not with this rule")
            .with_help(format!("those of {} are known", ON_BORDERS.join(", "))));
    }
    match node.text()? {
        "smooth" => Ok(Some(true)),
        "corner" => Ok(Some(false)),
        other => Err(node
            .problem("value", format!("`{other}` is no kind of border"), "not known")
            .with_help("write boundary = \"smooth\" (a spline curve) or \"corner\" (a vertex that stays)")),
    }
}

/// The rules of which the border is known.
const ON_BORDERS: [&str; 3] = ["catmull-clark", "loop", "loop-warren"];

/// Numbers of faces on the border.
fn faces(node: &Node<'_>) -> Result<Valences, Problem> {
    let text = match node.index(MAX_VALENCE) {
        Ok(n) => n.to_string(),
        Err(_) => node.text()?.to_owned(),
    };
    Valences::numbers(&text, 1, "number of faces").map(Valences::List).map_err(|error| {
        node.problem("value", error, "no numbers of faces")
            .with_help("write faces = 3, \"1..12\" (both ends included) or \"1,2,5..7\"")
    })
}

pub(super) fn valences(node: &Node<'_>) -> Result<Valences, Problem> {
    if node.is_integer() && node.index(MAX_VALENCE).is_err() {
        return Err(node
            .problem("range", format!("a valence is between 2 and {MAX_VALENCE}"), "out of range")
            .with_help("write valence = 5, \"3..32\" (both ends included), \"3,5,8\" or \"all\""));
    }
    let text = match node.index(MAX_VALENCE) {
        Ok(n) => n.to_string(),
        Err(_) => node.text()?.to_owned(),
    };
    Valences::parse(&text).map_err(|error| {
        node.problem("value", error, "not a range of valences")
            .with_help("write valence = 5, \"3..32\" (both ends included), \"3,5,8\" or \"all\"")
    })
}

/// What the file expects: a list of valences for each verdict.
fn expect(node: &Node<'_>, read: fn(&Node<'_>) -> Result<Valences, Problem>) -> Result<Vec<(usize, Verdict)>, Problem> {
    let table = node.table()?;
    table.only(&["proved", "refuted", "undetermined"])?;
    let mut all = Vec::new();
    for (key, verdict) in
        [("proved", Verdict::Proved), ("refuted", Verdict::Refuted), ("undetermined", Verdict::Undetermined)]
    {
        if let Some(node) = table.get(key)
            && let Valences::List(list) = read(&node)?
        {
            all.extend(list.into_iter().map(|n| (n, verdict)));
        }
    }
    Ok(all)
}

fn rule(table: &Table<'_>) -> Result<(String, MeshRule), Problem> {
    let scheme = table.text("mesh", "\"catmull-clark\"")?;
    if scheme == "own" {
        return Ok((scheme.to_owned(), own::own_rule(table)?));
    }
    if let Some(node) = table.get("beta").filter(|node| scheme == "loop-variant" && own::is_formula(node)) {
        return Ok((scheme.to_owned(), own::loop_rule(table, &node)?));
    }
    let Some(info) = mesh_rules().iter().find(|r| r.name == scheme) else {
        let error = mesh_rule(scheme, &BTreeMap::new()).err().map(|e| e.to_string()).unwrap_or_default();
        let names: Vec<&str> = mesh_rules().iter().map(|r| r.name).collect();
        return Err(table
            .need("mesh", "\"catmull-clark\"")?
            .problem("value", error, "not a scheme on meshes")
            .with_help(format!("the schemes are {}, and own, with stencils", names.join(", "))));
    };
    let mut known = vec!["mesh", "valence", "cell", "boundary", "faces"];
    known.extend(info.parameters.iter().map(|p| p.name));
    known.extend(info.rest.iter().chain(&info.list));
    table.only(&known).map_err(|problem| {
        let own = mesh_rules().iter().filter(|r| r.list.is_some() || r.rest.is_some() || !r.parameters.is_empty());
        let own: Vec<&str> = own.map(|r| r.name).collect();
        let more = format!("rules with weights of your own are {}", own.join(", "));
        let help = problem.remedy().map_or_else(|| more.clone(), |help| format!("{help}; {more}"));
        problem.with_help(help)
    })?;
    let refused = |error: SchemeError| {
        table.problem("value", error.to_string(), "here").with_help("`secant schemes` lists schemes and parameters")
    };
    if let Some(node) = info.list.and_then(|key| table.get(key)) {
        let weights: Vec<Rational> =
            node.array(|k| format!("weight {k}"))?.iter().map(Node::number).collect::<Result<_, _>>()?;
        let rule = mesh_rule(scheme, &BTreeMap::new()).and_then(|rule| rule.with_weights(weights)).map_err(refused)?;
        return Ok((scheme.to_owned(), rule));
    }
    let mut parameters = BTreeMap::new();
    for parameter in info.parameters {
        if let Some(node) = table.get(parameter.name) {
            parameters.insert(parameter.name.to_owned(), node.number()?);
        }
    }
    if let Some((key, node)) = info.rest.and_then(|key| Some((key, table.get(key)?))) {
        let names: Vec<&str> = info.parameters.iter().map(|p| p.name).chain([key]).collect();
        let names = names.join(" + ");
        let sum = parameters.values().fold(node.number()?, |s, x| s + x);
        if sum != ratio(1, 1) {
            return Err(node
                .problem("value", format!("{names} is {sum}, not 1"), "the weights do not add up to 1")
                .with_help(format!("the weights are shares of a mean; leave {key} out to have it computed")));
        }
    }
    let rule = mesh_rule(scheme, &parameters).map_err(refused)?;
    Ok((scheme.to_owned(), rule))
}
