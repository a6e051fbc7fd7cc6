//! Formulas as trees, so that MathML, LaTeX and plain text are written from the same thing.

use crate::arith::{Integer, Rational};

/// A formula.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Math {
    /// An exact rational number.
    Number(Rational),
    /// A number already written as digits (decimals).
    Digits(String),
    /// A letter.
    Letter(char),
    /// A word set upright, such as `dim`.
    Word(String),
    /// An operator, relation, bracket or comma.
    Symbol(char),
    /// Parts side by side.
    Row(Vec<Math>),
    /// A base with subscript and superscript.
    Script {
        /// What carries them.
        base: Box<Math>,
        /// The subscript.
        sub: Option<Box<Math>>,
        /// The superscript.
        sup: Option<Box<Math>>,
    },
    /// A square root.
    Root(Box<Math>),
    /// A matrix, by rows.
    Matrix(Vec<Vec<Math>>),
}

impl Math {
    /// An exact number.
    #[must_use]
    pub fn number(x: &Rational) -> Self {
        Self::Number(x.clone())
    }

    /// A whole number.
    #[must_use]
    pub fn count(k: usize) -> Self {
        Self::Number(Rational::from(k))
    }

    /// `(a, b, c)`.
    #[must_use]
    pub fn tuple(parts: Vec<Self>) -> Self {
        let mut row = vec![Self::Symbol('(')];
        for (k, part) in parts.into_iter().enumerate() {
            if k > 0 {
                row.push(Self::Symbol(','));
            }
            row.push(part);
        }
        row.push(Self::Symbol(')'));
        Self::Row(row)
    }

    /// A rational vector.
    #[must_use]
    pub fn vector(v: &[Rational]) -> Self {
        Self::tuple(v.iter().map(Self::number).collect())
    }

    /// A rational matrix.
    #[must_use]
    pub fn matrix(m: &crate::linalg::Matrix) -> Self {
        Self::Matrix((0..m.rows()).map(|i| m.row(i).iter().map(Self::number).collect()).collect())
    }

    /// A polynomial with rational coefficients, lowest degree first, in the given variable.
    #[must_use]
    pub fn polynomial(coefficients: &[Rational], variable: char) -> Self {
        let mut row = Vec::new();
        for (degree, c) in coefficients.iter().enumerate().rev() {
            if *c == 0 {
                continue;
            }
            let negative = *c < 0;
            if negative || !row.is_empty() {
                row.push(Self::Symbol(if negative { '−' } else { '+' }));
            }
            let size = if negative { -c.clone() } else { c.clone() };
            if degree == 0 || size != 1 {
                row.push(Self::Number(size));
            }
            if degree > 0 {
                row.push(power(Self::Letter(variable), degree));
            }
        }
        if row.is_empty() {
            return Self::Number(Rational::from(0));
        }
        if let [Self::Symbol('−'), Self::Number(x)] = row.as_slice() {
            return Self::Number(-x.clone());
        }
        Self::Row(row)
    }

    /// The formula written in a small notation: letters stand for themselves, `\word` and
    /// `\operatorname{word}` are upright, `\sqrt` takes the next letter, number or `{group}` as a root, `_` and `^` take it
    /// as a script, and `@` stands for the next of `values`.
    ///
    /// It never fails: a stray brace or `@` is dropped.
    #[must_use]
    pub fn parse(notation: &str, values: &mut dyn Iterator<Item = Self>) -> Self {
        let mut chars = notation.chars().peekable();
        parse_row(&mut chars, values, 0)
    }

    /// [`Math::parse`] without values.
    #[must_use]
    pub fn of(notation: &str) -> Self {
        Self::parse(notation, &mut std::iter::empty())
    }
}

/// `base` to a positive power; the first power is not written.
pub(super) fn power(base: Math, degree: usize) -> Math {
    if degree == 1 {
        return base;
    }
    Math::Script { base: Box::new(base), sub: None, sup: Some(Box::new(Math::count(degree))) }
}

type Chars<'a> = std::iter::Peekable<std::str::Chars<'a>>;

fn parse_row(chars: &mut Chars<'_>, values: &mut dyn Iterator<Item = Math>, depth: usize) -> Math {
    let mut row: Vec<Math> = Vec::new();
    while let Some(&c) = chars.peek() {
        match c {
            '}' => {
                chars.next();
                if depth > 0 {
                    break;
                }
            }
            '_' | '^' => {
                chars.next();
                let script = parse_atom(chars, values, depth);
                let base = row.pop().unwrap_or_else(|| Math::Row(Vec::new()));
                row.push(with_script(base, script, c == '_'));
            }
            c if c.is_whitespace() => {
                chars.next();
            }
            _ => row.extend(parse_atom(chars, values, depth)),
        }
    }
    if row.len() == 1 { row.remove(0) } else { Math::Row(row) }
}

fn with_script(base: Math, script: Option<Math>, below: bool) -> Math {
    let (base, mut sub, mut sup) = match base {
        Math::Script { base, sub, sup } => (base, sub, sup),
        other => (Box::new(other), None, None),
    };
    let slot = if below { &mut sub } else { &mut sup };
    *slot = script.map(Box::new);
    Math::Script { base, sub, sup }
}

fn parse_atom(chars: &mut Chars<'_>, values: &mut dyn Iterator<Item = Math>, depth: usize) -> Option<Math> {
    let c = chars.next()?;
    Some(match c {
        '@' => return values.next(),
        '{' if depth < 16 => parse_row(chars, values, depth + 1),
        '\\' => {
            let mut word = String::new();
            while let Some(c) = chars.next_if(|c| c.is_alphabetic()) {
                word.push(c);
            }
            match word.as_str() {
                "sqrt" => Math::Root(Box::new(parse_atom(chars, values, depth)?)),
                "operatorname" | "mathrm" => Math::Word(braced(chars)),
                // A space, as in `\\,`.
                "" => {
                    chars.next();
                    return parse_atom(chars, values, depth);
                }
                _ => Math::Word(word),
            }
        }
        '-' => Math::Symbol('−'),
        '½' => Math::Digits("½".to_owned()),
        c if c.is_ascii_digit() => {
            let mut digits = c.to_string();
            while let Some(c) = chars.next_if(|c| c.is_ascii_digit() || *c == '.') {
                digits.push(c);
            }
            Math::Digits(digits)
        }
        c if c.is_alphabetic() => Math::Letter(c),
        c => Math::Symbol(c),
    })
}

/// What stands between the braces that follow, literally.
fn braced(chars: &mut Chars<'_>) -> String {
    let mut out = String::new();
    if chars.next_if_eq(&'{').is_some() {
        while let Some(c) = chars.next_if(|c| *c != '}') {
            out.push(c);
        }
        chars.next();
    }
    out
}

/// How a symbol stands between its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Spacing {
    /// `=`, `∈`, `->`: wide space on both sides.
    Relation,
    /// `+`, `·`: some space where something stands on both sides.
    Binary,
    /// `,`: space after.
    Comma,
    /// `(`.
    Open,
    /// `)`.
    Close,
    /// Everything else.
    Tight,
}

/// The spacing of a symbol.
pub(super) fn spacing(c: char) -> Spacing {
    match c {
        '=' | '<' | '>' | '≤' | '≥' | '≠' | '≈' | '∈' | '∉' | '⊂' | '⊄' | '⊇' | '→' | '←' | '↦' | '⟹' | '⟺' | ':'
        | '∼' => Spacing::Relation,
        '+' | '−' | '·' | '×' | '∪' | '∩' | '⊕' | '⊗' | '∖' | '±' => Spacing::Binary,
        ',' | ';' => Spacing::Comma,
        '(' | '[' | '⟨' => Spacing::Open,
        ')' | ']' | '⟩' => Spacing::Close,
        _ => Spacing::Tight,
    }
}

/// Whether the number is written with a minus sign, and its absolute value.
pub(super) fn sign_and_size(x: &Rational) -> (bool, Rational) {
    if *x < 0 { (true, -x.clone()) } else { (false, x.clone()) }
}

/// Digits of more than this many are shortened in the middle.
const MAX_DIGITS: usize = 40;

/// The digits of a whole number, shortened in the middle where they are many: the certificate has them in full.
#[must_use]
pub fn shortened(digits: &str) -> String {
    if digits.len() <= MAX_DIGITS {
        return digits.to_owned();
    }
    format!("{}…{}", &digits[..12], &digits[digits.len() - 6..])
}

/// Whether some number of the formula is shortened.
#[must_use]
pub fn is_shortened(math: &Math) -> bool {
    match math {
        Math::Number(x) => {
            let (_, size) = sign_and_size(x);
            let (p, q) = parts(&size);
            p.len() > MAX_DIGITS || q.is_some_and(|q| q.len() > MAX_DIGITS)
        }
        Math::Digits(_) | Math::Letter(_) | Math::Word(_) | Math::Symbol(_) => false,
        Math::Row(parts) => parts.iter().any(is_shortened),
        Math::Script { base, sub, sup } => {
            is_shortened(base) || sub.as_deref().is_some_and(is_shortened) || sup.as_deref().is_some_and(is_shortened)
        }
        Math::Root(inner) => is_shortened(inner),
        Math::Matrix(rows) => rows.iter().flatten().any(is_shortened),
    }
}

/// Numerator and denominator of a rational that is not negative; `None` for the denominator of an integer.
pub(super) fn parts(x: &Rational) -> (String, Option<String>) {
    let denominator = x.denominator_ref();
    let shown = if *denominator == 1 { None } else { Some(denominator.to_string()) };
    (Integer::from(x.numerator_ref()).to_string(), shown)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::report::text::math_line;

    fn shown(notation: &str) -> String {
        math_line(&Math::of(notation))
    }

    #[test]
    fn the_notation_reads_back_as_text() {
        assert_eq!(shown("0∉π_1(X)"), "0 ∉ π₁(X)");
        assert_eq!(shown("ρ_{i+1}/ρ_i"), "ρ_(i+1)/ρ_i");
        assert_eq!(shown("\\dim D^*=r"), "dim D* = r");
        assert_eq!(shown("-x^2+1"), "−x² + 1");
        assert_eq!(shown("½ \\operatorname{osc}(h)"), "½ osc(h)");
        assert!(shown("\\sqrt{D}").starts_with('√'), "{}", shown("\\sqrt{D}"));
        let mut values = [Math::number(&ratio(-3, 4))].into_iter();
        assert_eq!(math_line(&Math::parse("λ=@", &mut values)), "λ = −3/4");
    }

    #[test]
    fn polynomials_are_written_as_people_do() {
        let line = |c: &[i64]| {
            let c: Vec<Rational> = c.iter().map(|&k| ratio(k, 1)).collect();
            math_line(&Math::polynomial(&c, 'x'))
        };
        assert_eq!(line(&[-1, -1, 1]), "x² − x − 1");
        assert_eq!(line(&[0]), "0");
        assert_eq!(line(&[-5]), "−5");
        assert_eq!(line(&[2, -1]), "−x + 2");
        assert_eq!(line(&[0, 0, 0, 12]), "12 x³");
    }

    #[test]
    fn stray_braces_do_no_harm() {
        for text in ["}", "{", "_", "^", "@", "a_", "{{{{", "a^{b_{c", "\\"] {
            let _ = shown(text);
        }
    }
}
