//! `secant schemes NAME` for schemes with irrational weights: matrices and cases with expressions such as `sqrt(3)`, which
//! `secant spectrum` reads.

use crate::algebraic::field::FieldMatrix;
use crate::scheme::{FieldMask, MeshRule, RuleInfo, daubechies, field_local_matrix, mesh_rule, mesh_rules};
use std::fmt::Write as _;

/// A scheme over number fields.
pub struct Entry {
    name: String,
    summary: String,
    source: &'static str,
    kind: Kind,
}

enum Kind {
    Mesh(MeshRule),
    Filter(usize),
}

/// All of them, in alphabetical order: filters, and the mesh rules with irrational weights.
pub fn list() -> Vec<Entry> {
    let filter = |moments: usize, what: &str| Entry {
        name: format!("db{moments}"),
        summary: format!(
            "Daubechies's filter with {moments} vanishing moments and {} taps, as a = √2 h{what}; for `secant spectrum`",
            2 * moments
        ),
        source: "I. Daubechies, Comm. Pure Appl. Math. 41 (1988)",
        kind: Kind::Filter(moments),
    };
    let mesh = |info: &RuleInfo| {
        let summary = format!("{}; for `secant spectrum`", info.over_fields?);
        let rule = mesh_rule(info.name, &[].into()).ok()?;
        Some(Entry { name: format!("{}-original", info.name), summary, source: info.source, kind: Kind::Mesh(rule) })
    };
    let filters = [filter(2, " over Q(√3)"), filter(3, ", degree 4")];
    filters.into_iter().chain(mesh_rules().iter().filter_map(mesh)).collect()
}

/// The entry of the list.
pub fn entry(info: &Entry) -> String {
    let parameters = match info.kind {
        Kind::Mesh(_) => "    n: valence\n    rings (default 1): rings of faces\n",
        Kind::Filter(_) => "",
    };
    format!("{}\n    {}\n{parameters}    source: {}\n", info.name, info.summary, info.source)
}

/// The text of one of these schemes; `None` where the name is not among them.
pub fn written(name: &str, parameters: &[String]) -> Option<Result<String, String>> {
    let info = list().into_iter().find(|s| s.name == name)?;
    Some(match &info.kind {
        Kind::Mesh(rule) => mesh(&info, rule, parameters),
        Kind::Filter(moments) if parameters.is_empty() => {
            daubechies(*moments).map(|mask| case(&info, &mask)).map_err(|e| e.to_string())
        }
        Kind::Filter(_) => Err(format!("`{name}` has no parameters")),
    })
}

fn mesh(info: &Entry, rule: &MeshRule, parameters: &[String]) -> Result<String, String> {
    let (mut valence, mut rings) = (None, 1);
    for text in parameters {
        let (key, value) = text.split_once('=').ok_or_else(|| format!("`{text}` is not of the form name=value"))?;
        let number =
            value.trim().parse::<usize>().map_err(|_| format!("{key} must be a whole number, not `{value}`"))?;
        match key.trim() {
            "n" => valence = Some(number),
            "rings" => rings = number,
            other => return Err(format!("scheme `{}` has no parameter `{other}`; it has n and rings", info.name)),
        }
    }
    let n = valence.ok_or_else(|| format!("scheme `{}` needs the parameter `n`: the valence, as in n=7", info.name))?;
    let local = field_local_matrix(rule, n, rings).map_err(|e| e.to_string())?;
    let mut out = format!("# {} n={n} rings={rings}: {}\n# {}\n", info.name, info.summary, info.source);
    let _ = writeln!(out, "# new points (rows) from old points (columns); points up to each ring: {:?}", local.rings);
    let _ = writeln!(
        out,
        "# steps of the scheme: {}; entries in {}",
        local.steps,
        local.matrix.shrunk().field().describe()
    );
    let _ = writeln!(out, "{}", local.matrix.rows());
    for i in 0..local.matrix.rows() {
        let row: Vec<String> = local.matrix.row(i).iter().map(|x| local.matrix.field().expression(x)).collect();
        let _ = writeln!(out, "{}", row.join(" "));
    }
    Ok(out)
}

fn case(info: &Entry, mask: &FieldMask) -> String {
    let texts: Vec<String> = mask.coefficients.iter().map(|a| mask.field.expression(a)).collect();
    let mut out = format!("# a = ({})\nname = \"{}\"\ntitle = \"{}\"\n", texts.join(", "), info.name, info.summary);
    let _ = writeln!(out, "source = \"{}\"\nconvention = \"columns\"\npieces = [", info.source);
    for operator in mask.operators() {
        let _ = writeln!(out, "    {},", rows(&operator));
    }
    out.push_str("]\n");
    out
}

fn rows(m: &FieldMatrix) -> String {
    let entry = |x| format!("\"{}\"", m.field().expression(x));
    let row = |i| format!("[{}]", m.row(i).iter().map(entry).collect::<Vec<_>>().join(", "));
    format!("[{}]", (0..m.rows()).map(row).collect::<Vec<_>>().join(",\n     "))
}
