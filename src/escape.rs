//! Text in markup, for reports and pictures.

pub(crate) mod symbols;

/// Text with the characters that HTML reads as markup replaced, and without control characters.
#[must_use]
pub fn html(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if c.is_control() && c != '\n' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Text with TeX's special characters and the symbols that its fonts lack replaced.
#[must_use]
pub fn latex(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '^' => out.push_str("\\textasciicircum{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '"' => out.push_str("\\textquotedbl{}"),
            '′' => out.push_str("$'$"),
            '…' => out.push_str("\\dots{}"),
            c if c.is_control() => out.push(' '),
            // Letters of the Latin blocks are in the T1 fonts.
            c if (c as u32) < 0x180 => out.push(c),
            c => match symbols::latex(c) {
                Some(command) => out.push_str(&format!("$ {command} $").replace("$ ", "$").replace(" $", "$")),
                None => out.push('?'),
            },
        }
    }
    out
}
