//! Formulas as MathML.

use super::html::escaped;
use super::math::{Math, Spacing, parts, shortened, sign_and_size, spacing};

/// A formula as a `<math>` element; `block` puts it in a line of its own.
#[must_use]
pub fn math_element(math: &Math, block: bool) -> String {
    let display = if block { " display=\"block\"" } else { "" };
    format!("<math{display}>{}</math>", element(math))
}

/// Tuples with at least so many commas may be broken over lines.
const MANY: usize = 5;

/// A formula within a line, as one element, or as several that end with commas where it is a long tuple.
#[must_use]
pub fn inline_elements(math: &Math) -> Vec<String> {
    let mut parts = Vec::new();
    flatten(math, &mut parts);
    let comma = |m: &&Math| matches!(m, Math::Symbol(','));
    if parts.iter().filter(|m| comma(m)).count() < MANY {
        return vec![math_element(math, false)];
    }
    let pieces = parts.split_inclusive(comma);
    pieces.map(|piece| format!("<math><mrow>{}</mrow></math>", row(piece))).collect()
}

/// The parts of rows within rows.
fn flatten<'a>(math: &'a Math, out: &mut Vec<&'a Math>) {
    match math {
        Math::Row(parts) => parts.iter().for_each(|part| flatten(part, out)),
        other => out.push(other),
    }
}

fn element(math: &Math) -> String {
    match math {
        Math::Number(x) => number(x),
        Math::Digits(text) => format!("<mn>{}</mn>", escaped(text)),
        Math::Letter(c) => format!("<mi>{}</mi>", escaped(&c.to_string())),
        Math::Word(word) => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(word)),
        Math::Symbol(c) => symbol(*c),
        Math::Row(parts) => format!("<mrow>{}</mrow>", row(&parts.iter().collect::<Vec<_>>())),
        Math::Script { base, sub, sup } => {
            let base = element(base);
            match (sub, sup) {
                (Some(sub), Some(sup)) => format!("<msubsup>{base}{}{}</msubsup>", element(sub), element(sup)),
                (Some(sub), None) => format!("<msub>{base}{}</msub>", element(sub)),
                (None, Some(sup)) => format!("<msup>{base}{}</msup>", element(sup)),
                (None, None) => base,
            }
        }
        Math::Root(inner) => format!("<msqrt>{}</msqrt>", element(inner)),
        Math::Matrix(rows) => {
            let cell = |m: &Math| format!("<mtd>{}</mtd>", element(m));
            let row = |cells: &Vec<Math>| format!("<mtr>{}</mtr>", cells.iter().map(cell).collect::<String>());
            let body: String = rows.iter().map(row).collect();
            // The brackets are drawn by the style sheet: browsers without a font for formulas do not stretch them.
            format!("<mtable class=\"matrix\">{body}</mtable>")
        }
    }
}

/// The parts of a row: signs are told from operations, and names such as `dim` keep a distance.
fn row(parts: &[&Math]) -> String {
    let kind = |m: &Math| match m {
        Math::Symbol(c) => spacing(*c),
        _ => Spacing::Tight,
    };
    let name = |m: &Math| match m {
        Math::Word(_) => true,
        Math::Script { base, .. } => matches!(base.as_ref(), Math::Word(_)),
        _ => false,
    };
    let mut out = String::new();
    for (k, &part) in parts.iter().enumerate() {
        let before = k.checked_sub(1).map(|j| parts[j]);
        // Names keep a distance from what follows, and from a number before them.
        let after_number = name(part) && matches!(before, Some(Math::Digits(_) | Math::Number(_)));
        if before.is_some_and(name) && !matches!(part, Math::Symbol(_)) || after_number {
            out.push_str("<mspace width=\"0.17em\"/>");
        }
        let operand = before.is_some_and(|b| matches!(kind(b), Spacing::Tight | Spacing::Close));
        match part {
            Math::Symbol(c) if spacing(*c) == Spacing::Binary && !operand => {
                out.push_str(&format!(
                    "<mo form=\"prefix\" lspace=\"0\" rspace=\"0\">{}</mo>",
                    escaped(&c.to_string())
                ));
            }
            _ => out.push_str(&element(part)),
        }
    }
    out
}

fn number(x: &crate::arith::Rational) -> String {
    let (negative, size) = sign_and_size(x);
    let body = match parts(&size) {
        (p, None) => format!("<mn>{}</mn>", shortened(&p)),
        (p, Some(q)) => format!("<mfrac><mn>{}</mn><mn>{}</mn></mfrac>", shortened(&p), shortened(&q)),
    };
    if negative { format!("<mrow><mo form=\"prefix\">−</mo>{body}</mrow>") } else { body }
}

fn symbol(c: char) -> String {
    let text = escaped(&c.to_string());
    match spacing(c) {
        Spacing::Open | Spacing::Close => format!("<mo stretchy=\"false\">{text}</mo>"),
        _ if c == '…' => "<mi>…</mi>".to_owned(),
        _ if matches!(c, '|' | '‖' | '/') => format!("<mo stretchy=\"false\" lspace=\"0\" rspace=\"0\">{text}</mo>"),
        _ => format!("<mo>{text}</mo>"),
    }
}
