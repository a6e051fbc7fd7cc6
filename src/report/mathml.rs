//! Formulas as MathML.

use super::html::escaped;
use super::math::{Math, Spacing, parts, shortened, sign_and_size, spacing};

/// A formula as a `<math>` element; `block` puts it in a line of its own.
#[must_use]
pub fn math_element(math: &Math, block: bool) -> String {
    let display = if block { " display=\"block\"" } else { "" };
    format!("<math{display}>{}</math>", element(math))
}

fn element(math: &Math) -> String {
    match math {
        Math::Number(x) => number(x),
        Math::Digits(text) => format!("<mn>{}</mn>", escaped(text)),
        Math::Letter(c) => format!("<mi>{}</mi>", escaped(&c.to_string())),
        Math::Word(word) => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(word)),
        Math::Symbol(c) => symbol(*c),
        Math::Row(parts) => format!("<mrow>{}</mrow>", parts.iter().map(element).collect::<String>()),
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
            format!("<mrow><mo>(</mo><mtable>{body}</mtable><mo>)</mo></mrow>")
        }
    }
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
        _ if matches!(c, '|' | '‖') => format!("<mo stretchy=\"false\" lspace=\"0\" rspace=\"0\">{text}</mo>"),
        _ => format!("<mo>{text}</mo>"),
    }
}
