//! `secant schemes NAME` for schemes with irrational weights: matrices and cases with expressions such as `sqrt(3)`, which
//! `secant spectrum` reads.

use crate::algebraic::field::FieldMatrix;
use crate::scheme::{DualWeights, FieldMask, LoopWeights, MeshRule, daubechies, field_local_matrix};
use std::fmt::Write as _;

/// A scheme over number fields.
pub struct Entry {
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    kind: Kind,
}

enum Kind {
    Mesh(MeshRule),
    Filter(usize),
}

/// All of them, in alphabetical order.
pub const LIST: &[Entry] = &[
    Entry {
        name: "db2",
        summary: "Daubechies's filter with 2 vanishing moments and 4 taps, as a = √2 h over Q(√3); for `secant spectrum`",
        source: "I. Daubechies, Comm. Pure Appl. Math. 41 (1988)",
        kind: Kind::Filter(2),
    },
    Entry {
        name: "db3",
        summary: "Daubechies's filter with 3 vanishing moments and 6 taps, as a = √2 h, degree 4; for `secant spectrum`",
        source: "I. Daubechies, Comm. Pure Appl. Math. 41 (1988)",
        kind: Kind::Filter(3),
    },
    Entry {
        name: "doo-sabin-original",
        summary: "local matrix with the published cosine weights around a face of every valence; for `secant spectrum`",
        source: "D. Doo, M. Sabin, Computer-Aided Design 10 (1978)",
        kind: Kind::Mesh(MeshRule::DooSabin(DualWeights::Original)),
    },
    Entry {
        name: "loop-original",
        summary: "local matrix with the published weights at a vertex of every valence; for `secant spectrum`",
        source: "C. Loop, master's thesis, Utah (1987)",
        kind: Kind::Mesh(MeshRule::Loop(LoopWeights::Original)),
    },
    Entry {
        name: "sqrt3-original",
        summary: "local matrix of two steps with the published weights at a vertex of every valence; for `secant spectrum`",
        source: "L. Kobbelt, SIGGRAPH 2000",
        kind: Kind::Mesh(MeshRule::Sqrt3(None)),
    },
];

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
    let info = LIST.iter().find(|s| s.name == name)?;
    Some(match &info.kind {
        Kind::Mesh(rule) => mesh(info, rule, parameters),
        Kind::Filter(moments) if parameters.is_empty() => {
            daubechies(*moments).map(|mask| case(info, &mask)).map_err(|e| e.to_string())
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
