//! The spectrum of a matrix as text, JSON and LaTeX.

use crate::algebraic::{Elem, Root};
use crate::approx::ApproxSpectrum;
use crate::arith::{Interval, Rational, to_f64};
use crate::jordan::{Chain, Factor, Spectrum};
use crate::poly::Poly;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Chains are printed as text up to this size of the matrix; the JSON always has them.
pub const MAX_TEXT_SIZE: usize = 24;

/// Longest number that the text shows in full.
const MAX_NUMBER: usize = 40;

/// The factored form, such as `(x - 1)(2x - 1)^2`.
fn factored<'a>(parts: impl Iterator<Item = (&'a Poly, usize)>, latex: bool) -> String {
    let mut out = String::new();
    for (poly, exponent) in parts {
        let text = if latex { latex_poly(poly, "x") } else { poly.primitive_display("x") };
        let _ = write!(out, "({text})");
        if exponent > 1 {
            let _ = if latex { write!(out, "^{{{exponent}}}") } else { write!(out, "^{exponent}") };
        }
    }
    if out.is_empty() { "1".to_owned() } else { out }
}

fn char_factors(s: &Spectrum) -> impl Iterator<Item = (&Poly, usize)> {
    s.factors.iter().map(|f| (&f.poly, f.multiplicity))
}

fn min_factors(s: &Spectrum) -> impl Iterator<Item = (&Poly, usize)> {
    s.factors.iter().map(|f| (&f.poly, f.blocks.first().copied().unwrap_or(0)))
}

#[allow(clippy::float_arithmetic)] // a decimal for the eye
pub(super) fn decimal(root: &Root) -> String {
    let (re, im) = root.to_f64();
    match (root.is_real(), im < 0.0) {
        (true, _) => format!("{re:.10}"),
        (false, negative) => format!("{re:.10} {} {:.10}i", if negative { '-' } else { '+' }, im.abs()),
    }
}

/// A root as text: the rational number, or its place among the roots of its polynomial with a decimal.
#[must_use]
pub fn root_text(root: &Root) -> String {
    match root.rational() {
        Some(q) => q.to_string(),
        None => format!("{} (root {} of {})", decimal(root), root.index() + 1, root.minpoly().primitive_display("x")),
    }
}

pub(super) fn shortened(text: String) -> String {
    let count = text.chars().count();
    if count <= MAX_NUMBER {
        return text;
    }
    format!("{}… ({count} characters)", text.chars().take(MAX_NUMBER / 2).collect::<String>())
}

pub(super) fn modulus_text(root: &Root) -> String {
    match root.rational() {
        Some(q) => crate::arith::abs(&q).to_string(),
        None => format!("{:.10}", to_f64(&root.modulus(60).mid())),
    }
}

/// The spectrum as text; chains are left out above [`MAX_TEXT_SIZE`].
#[must_use]
pub fn text(s: &Spectrum) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "matrix of size {}", s.size);
    let _ = writeln!(out, "characteristic polynomial  {}", factored(char_factors(s), false));
    let _ = writeln!(out, "minimal polynomial         {}", factored(min_factors(s), false));
    let _ = writeln!(out, "\nmoduli, largest first");
    for (k, class) in s.classes.iter().enumerate() {
        let first = s.root(class.members[0]);
        let _ = writeln!(out, "  {}. |λ| = {}", k + 1, modulus_text(first));
        for e in &class.members {
            let f = s.factor(*e);
            let _ = writeln!(
                out,
                "       {}, multiplicity {}, {}",
                root_text(s.root(*e)),
                f.multiplicity,
                blocks_text(&f.blocks)
            );
        }
    }
    if s.size > MAX_TEXT_SIZE {
        let _ = writeln!(out, "\nthe chains of generalised eigenvectors are left out here; the JSON output has them");
        return out;
    }
    for f in &s.factors {
        let name = if f.roots.len() == 1 {
            format!("λ = {}", -f.poly.coeff(0))
        } else {
            format!("θ a root of {}", f.poly.primitive_display("x"))
        };
        let _ = writeln!(out, "\n{name}");
        chains_text(&mut out, "right", &f.right, |e| e.display("θ"));
        chains_text(&mut out, "left", &f.left, |e| e.display("θ"));
    }
    out
}

pub(super) fn blocks_text(blocks: &[usize]) -> String {
    let sizes: Vec<String> = blocks.iter().map(ToString::to_string).collect();
    format!("{} {}", if sizes.len() == 1 { "block" } else { "blocks" }, sizes.join(", "))
}

pub(super) fn chains_text(out: &mut String, side: &str, chains: &[Chain], show: impl Fn(&Elem) -> String) {
    for (k, chain) in chains.iter().enumerate() {
        for (j, v) in chain.vectors.iter().enumerate() {
            let entries: Vec<String> = v.iter().map(|e| shortened(show(e))).collect();
            let _ = writeln!(out, "  {side} {}.{}  ({})", k + 1, j + 1, entries.join(", "));
        }
    }
}

pub(super) fn interval_json(x: &Interval) -> Value {
    json!([x.lo.to_string(), x.hi.to_string()])
}

pub(super) fn coefficients(values: &[Rational]) -> Value {
    values.iter().map(|c| Value::String(c.to_string())).collect()
}

fn vector_json(v: &[Elem]) -> Value {
    v.iter().map(|e| coefficients(e.0.coeffs())).collect()
}

pub(super) fn chains_json(chains: &[Chain]) -> Value {
    chains.iter().map(|c| c.vectors.iter().map(|v| vector_json(v)).collect::<Value>()).collect()
}

pub(super) fn root_json(root: &Root) -> Value {
    let (re, im) = root.enclosure(64);
    let modulus = root.modulus(64);
    json!({ "index": root.index(), "real": root.is_real(), "re": interval_json(&re), "im": interval_json(&im), "modulus": interval_json(&modulus) })
}

/// The whole spectrum as JSON. Numbers are strings; an element of `Q[x] / (f)` is its list of coefficients, the constant
/// one first; enclosures are pairs of rationals.
#[must_use]
pub fn json(s: &Spectrum) -> Value {
    let factor = |f: &Factor| {
        json!({
            "polynomial": coefficients(f.poly.coeffs()),
            "text": f.poly.primitive_display("x"),
            "multiplicity": f.multiplicity,
            "blocks": f.blocks,
            "roots": f.roots.iter().map(root_json).collect::<Value>(),
            "right": chains_json(&f.right),
            "left": chains_json(&f.left),
        })
    };
    let member = |e: &crate::jordan::Eigenvalue| json!({ "factor": e.factor, "root": e.root });
    json!({
        "size": s.size,
        "characteristic_polynomial": coefficients(s.char_poly.coeffs()),
        "minimal_polynomial": coefficients(s.min_poly().coeffs()),
        "factors": s.factors.iter().map(factor).collect::<Value>(),
        "modulus_classes": s.classes.iter().map(|c| c.members.iter().map(member).collect::<Value>()).collect::<Value>(),
    })
}

pub(super) fn latex_rational(q: &Rational) -> String {
    if *q.denominator_ref() == 1 {
        return q.to_string();
    }
    let sign = if *q < 0 { "-" } else { "" };
    format!("{sign}\\frac{{{}}}{{{}}}", q.numerator_ref(), q.denominator_ref())
}

/// A polynomial in LaTeX, in primitive integer form.
pub(super) fn latex_poly(f: &Poly, variable: &str) -> String {
    latex_terms(&Poly::from_ints(&f.primitive()), variable)
}

pub(super) fn latex_terms(f: &Poly, variable: &str) -> String {
    let mut out = String::new();
    for (k, c) in f.coeffs().iter().enumerate().rev().filter(|(_, c)| **c != 0) {
        let size = crate::arith::abs(c);
        if *c < 0 {
            out.push('-');
        } else if !out.is_empty() {
            out.push('+');
        }
        if k == 0 || size != 1 {
            out.push_str(&latex_rational(&size));
        }
        match k {
            0 => {}
            1 => out.push_str(variable),
            _ => {
                let _ = write!(out, "{variable}^{{{k}}}");
            }
        }
    }
    if out.is_empty() { "0".to_owned() } else { out }
}

/// The spectrum as a LaTeX fragment: polynomials, a table of eigenvalues by modulus, the chains.
#[must_use]
pub fn latex(s: &Spectrum) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "\\[ \\chi(x) = {} \\]", factored(char_factors(s), true));
    let _ = writeln!(out, "\\[ \\mu(x) = {} \\]", factored(min_factors(s), true));
    out.push_str("\\begin{tabular}{lllll}\n$|\\lambda|$ & $\\lambda$ & minimal polynomial & multiplicity & blocks \\\\\n\\hline\n");
    for class in &s.classes {
        for e in &class.members {
            let (root, f) = (s.root(*e), s.factor(*e));
            let value = root.rational().map_or_else(|| decimal(root), |q| latex_rational(&q));
            let modulus =
                root.rational().map_or_else(|| modulus_text(root), |q| latex_rational(&crate::arith::abs(&q)));
            let sizes: Vec<String> = f.blocks.iter().map(ToString::to_string).collect();
            let poly = latex_poly(&f.poly, "x");
            let _ =
                writeln!(out, "${modulus}$ & ${value}$ & ${poly}$ & {} & {} \\\\", f.multiplicity, sizes.join(", "));
        }
    }
    out.push_str("\\end{tabular}\n");
    if s.size <= MAX_TEXT_SIZE {
        for f in &s.factors {
            for (letter, chains) in [('v', &f.right), ('w', &f.left)] {
                latex_chains(&mut out, letter, f, chains);
            }
        }
    }
    out
}

fn latex_chains(out: &mut String, letter: char, f: &Factor, chains: &[Chain]) {
    let _ = writeln!(out, "\\[ \\theta:\\ {} = 0 \\]", latex_poly(&f.poly, "\\theta"));
    for (k, chain) in chains.iter().enumerate() {
        for (j, v) in chain.vectors.iter().enumerate() {
            let entries: Vec<String> = v.iter().map(|e| latex_terms(&e.0, "\\theta")).collect();
            let _ = writeln!(out, "\\[ {letter}_{{{},{}}} = ({}) \\]", k + 1, j + 1, entries.join(",\\ "));
        }
    }
}

/// An approximate spectrum as text, which says that it is one.
#[must_use]
pub fn approximate_text(s: &ApproxSpectrum) -> String {
    let mut out = String::from("APPROXIMATE eigenvalues in double precision; nothing here is proved\n");
    let _ = writeln!(out, "residual |AQ - QT| / |A| = {:.2e}", s.residual);
    if s.ill_conditioned {
        out.push_str("warning: some eigenvalues are so close together that their last digits, up to half of them or more, are wrong\n");
    }
    for e in &s.eigenvalues {
        let _ = writeln!(out, "  {:+.10} {:+.10}i   gap {:.1e}", e.re, e.im, e.gap);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;

    fn sample() -> Spectrum {
        let entries = [[1, 1, 0, 0], [0, 1, 0, 0], [0, 0, 0, 2], [0, 0, 1, 0]];
        Spectrum::of(&Matrix::from_fn(4, 4, |i, j| ratio(entries[i][j], 2)))
    }

    #[test]
    fn text_names_blocks_and_moduli() {
        let text = text(&sample());
        assert!(text.contains("(2x - 1)^2(2x^2 - 1)"), "{text}");
        assert!(text.contains("1/2, multiplicity 2, block 2"), "{text}");
        assert!(text.contains("|λ| = 0.7071067812"), "{text}");
        assert!(text.contains("θ a root of 2x^2 - 1"), "{text}");
    }

    #[test]
    fn json_has_everything() {
        let value = json(&sample());
        assert_eq!(value["size"], 4);
        assert_eq!(value["factors"][0]["blocks"], json!([2]));
        assert_eq!(value["factors"][0]["right"][0].as_array().unwrap().len(), 2);
        assert_eq!(value["modulus_classes"].as_array().unwrap().len(), 2);
    }

    #[test]
    fn latex_has_balanced_braces() {
        let text = latex(&sample());
        assert!(text.contains("(2x-1)^{2}"), "{text}");
        assert_eq!(text.matches('{').count(), text.matches('}').count());
    }
}
