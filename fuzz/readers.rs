//! A case as secant and its checker read it, which share no code, written out for comparison.

use secant::case::Case;
use secant::linalg::Matrix;
use secant::shape::CellKind;
use secant_check::reader;
use std::fmt::Write;

fn matrix(out: &mut String, rows: impl Iterator<Item = Vec<String>>) {
    rows.for_each(|row| write!(out, "[{}]", row.join(",")).unwrap());
}

fn own(m: &Matrix) -> impl Iterator<Item = Vec<String>> + '_ {
    (0..m.rows()).map(|i| m.row(i).iter().map(ToString::to_string).collect())
}

/// What secant reads, written out.
pub fn secants(text: &str) -> Result<String, String> {
    let case = Case::parse("case", text).map_err(|p| p.id().to_owned())?;
    let shape = &case.shape;
    let mut out = format!("{} start {}\n", case.name, shape.start);
    for state in &shape.states {
        let kind = match state.kind {
            CellKind::Vertex => "vertex",
            CellKind::Edge => "edge",
            CellKind::Set | CellKind::Face => "set",
        };
        writeln!(out, "{kind} {}", state.dim).unwrap();
        for piece in &state.pieces {
            write!(out, " {} {} ", piece.target, piece.reversed).unwrap();
            matrix(&mut out, own(&piece.op));
        }
        for end in [&state.left, &state.right] {
            match end {
                None => out.push_str(" none"),
                Some(b) => {
                    write!(out, " end {} ", b.vertex).unwrap();
                    matrix(&mut out, own(&b.op));
                }
            }
        }
        out.push('\n');
    }
    let view = shape.control.clone().unwrap_or_else(|| Matrix::identity(shape.states[shape.start].dim));
    matrix(&mut out, own(&view));
    for address in &case.examine {
        write!(out, " {}", address.normalise(shape, shape.start).map_err(|e| e.to_string())?).unwrap();
    }
    Ok(out)
}

/// What the checker reads, in the same form, and whether it is a curve to it.
pub fn checkers(text: &str) -> Result<(String, bool), String> {
    let system = reader::system(text).map_err(|r| r.to_string())?;
    let rows = |m: &reader::Rows| {
        m.clone().into_iter().map(|row| row.iter().map(ToString::to_string).collect()).collect::<Vec<Vec<String>>>()
    };
    let mut out = format!("{} start {}\n", system.name, system.start);
    for state in &system.states {
        writeln!(out, "{} {}", state.kind, state.dimension).unwrap();
        for (target, op, reversed) in &state.pieces {
            write!(out, " {target} {reversed} ").unwrap();
            matrix(&mut out, rows(op).into_iter());
        }
        for end in &state.ends {
            match end {
                None => out.push_str(" none"),
                Some((vertex, op)) => {
                    write!(out, " end {vertex} ").unwrap();
                    matrix(&mut out, rows(op).into_iter());
                }
            }
        }
        out.push('\n');
    }
    matrix(&mut out, rows(&system.view).into_iter());
    system.examine.iter().for_each(|address| write!(out, " {address}").unwrap());
    Ok((out, system.curves))
}

/// Where the readers differ, and may: the checker reads no meshes and no states that are built, has room for less, and does not look at what no rule of a
/// certificate uses. It never reads another system.
pub fn differ(text: &str) -> Option<String> {
    match (secants(text), checkers(text)) {
        // The checker takes symmetries among the maps of a set for maps; certificates are about the set that is written out.
        (Ok(a), Ok((b, _))) => (a != b && !is_written_out(text)).then(|| format!("two systems:\n{a}\n{b}")),
        (Ok(_), Err(why)) => {
            let room = ["limit", "not built here", "rows and columns", "pieces or coordinates"];
            let vertex = text.contains("[vertex]");
            // Of states that name schemes or are chains, and of data to interpolate, the checker reads the expanded form.
            let expands = ["\nchain = ", "\nscheme = ", "\n[interpolate]"];
            let built = why.contains("unknown key") && expands.iter().any(|key| text.contains(key));
            (!vertex && !built && !room.iter().any(|r| why.contains(r))).then(|| format!("the checker refuses: {why}"))
        }
        // What is no curve has no certificate.
        (Err(_), Ok((_, false))) => None,
        (Err(id), Ok(_)) => {
            let unused = [
                "expect",
                "identity",
                "value",
                "too-large",
                "limit",
                "face",
                "unknown-key",
                "side",
                "reversal",
                "layout",
            ];
            (!unused.iter().any(|u| id.contains(u))).then(|| format!("secant refuses: {id}"))
        }
        (Err(_), Err(_)) => None,
    }
}

/// Whether certificates of a case are about another text.
fn is_written_out(text: &str) -> bool {
    secant::case::Case::parse("a.toml", text).is_ok_and(|case| case.beside().is_some())
}

/// Stops where both read a text, as two systems.
#[allow(dead_code)]
pub fn compare(text: &str) {
    if let (Ok(own), Ok((theirs, _))) = (secants(text), checkers(text)) {
        assert!(own == theirs || is_written_out(text), "two systems:\n{own}\n{theirs}");
    }
}
