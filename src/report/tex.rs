//! Formulas as LaTeX.

use super::math::{Math, parts, shortened, sign_and_size};
use super::symbols::latex;

/// A formula in LaTeX's mathematics mode.
#[must_use]
pub fn math_tex(math: &Math) -> String {
    match math {
        Math::Number(x) => {
            let (negative, size) = sign_and_size(x);
            let minus = if negative { "-" } else { "" };
            match parts(&size) {
                (p, None) => format!("{minus}{}", digits(&p)),
                (p, Some(q)) => format!("{minus}\\frac{{{}}}{{{}}}", digits(&p), digits(&q)),
            }
        }
        Math::Digits(text) => text.replace('−', "-").replace('…', "\\ldots ").replace('½', "\\tfrac12 "),
        Math::Letter('|') | Math::Symbol('|') => "\\vert ".to_owned(),
        Math::Letter(c) | Math::Symbol(c) => latex(*c).map_or_else(|| plain(*c), spaced),
        Math::Word(word) if matches!(word.as_str(), "dim" | "ln" | "max" | "min" | "ker" | "det" | "cos") => {
            format!("\\{word} ")
        }
        Math::Word(word) => {
            // Names of states are words too, and may hold any character.
            let letter = |c: char| if c.is_ascii_alphanumeric() { None } else { latex(c) };
            let word: String = word.chars().map(|c| letter(c).map_or_else(|| plain(c), spaced)).collect();
            format!("\\operatorname{{{word}}}")
        }
        Math::Row(parts) => join(parts.iter().map(math_tex)),
        Math::Script { base, sub, sup } => {
            let base = match base.as_ref() {
                Math::Row(_) | Math::Matrix(_) => format!("{{{}}}", math_tex(base)),
                other => math_tex(other).trim_end().to_owned(),
            };
            let sub = sub.as_ref().map(|s| format!("_{{{}}}", math_tex(s).trim_end())).unwrap_or_default();
            let sup = sup.as_ref().map(|s| format!("^{{{}}}", math_tex(s).trim_end())).unwrap_or_default();
            format!("{base}{sub}{sup}")
        }
        Math::Root(inner) => format!("\\sqrt{{{}}}", math_tex(inner)),
        Math::Matrix(rows) => {
            let row = |cells: &Vec<Math>| cells.iter().map(math_tex).collect::<Vec<_>>().join(" & ");
            let body = rows.iter().map(row).collect::<Vec<_>>().join(" \\\\ ");
            format!("\\begin{{pmatrix}} {body} \\end{{pmatrix}}")
        }
    }
}

fn digits(text: &str) -> String {
    shortened(text).replace('…', "\\ldots ")
}

/// A control word must not run into the next letter.
fn spaced(s: &str) -> String {
    if s.ends_with(|c: char| c.is_ascii_alphabetic()) { format!("{s} ") } else { s.to_owned() }
}

fn plain(c: char) -> String {
    if c.is_control() { " ".to_owned() } else { c.to_string() }
}

fn join(parts: impl Iterator<Item = String>) -> String {
    let mut out = String::new();
    for part in parts {
        // Relations read better with a space before them, too.
        if part.starts_with('\\') && !out.is_empty() && !out.ends_with([' ', '(', '{']) {
            out.push(' ');
        }
        out.push_str(&part);
    }
    out.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn control_words_do_not_swallow_letters() {
        assert_eq!(math_tex(&Math::of("λx∈ρ_{i+1}")), "\\lambda x \\in \\rho_{i+1}");
        assert_eq!(math_tex(&Math::number(&ratio(-3, 4))), "-\\frac{3}{4}");
        assert_eq!(math_tex(&Math::of("\\dim D^*")), "\\dim D^{*}");
        assert_eq!(math_tex(&Math::Word("u⊗w_1".to_owned())), "\\operatorname{u\\otimes w\\_1}");
    }
}
