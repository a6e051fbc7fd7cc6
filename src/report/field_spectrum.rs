//! The spectrum of a matrix over a number field as text, JSON and LaTeX.

use super::spectrum::{
    MAX_TEXT_SIZE, blocks_text, chains_json, chains_text, coefficients, decimal, interval_json, latex_poly,
    latex_rational, latex_terms, modulus_text, root_json, root_text,
};
use crate::algebraic::Elem;
use crate::algebraic::field::NumberField;
use crate::jordan::{Chain, FieldFactor, FieldSpectrum};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// A polynomial over the field, with the texts of its coefficients: those of several terms in brackets, and a blank
/// between an irrational coefficient and the power, where nothing else parts them.
fn polynomial(f: &[Elem], power: impl Fn(usize) -> String, show: impl Fn(&Elem) -> String) -> String {
    let mut out = String::new();
    for (k, c) in f.iter().enumerate().rev().filter(|(_, c)| !c.is_zero()) {
        let several = c.0.coeffs().iter().filter(|x| **x != 0).count() > 1;
        let negative = !several && c.0.leading().is_some_and(|x| *x < 0);
        let size = if negative { c.neg() } else { c.clone() };
        let text = if several { format!("({})", show(&size)) } else { show(&size) };
        out.push_str(match (out.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        if k == 0 || text != "1" {
            out.push_str(&text);
            let open = size.is_rational().is_none() && text.ends_with(char::is_alphanumeric);
            out.push_str(if k > 0 && open { " " } else { "" });
        }
        out.push_str(&power(k));
    }
    out
}

fn plain_power(k: usize) -> String {
    match k {
        0 => String::new(),
        1 => "x".to_owned(),
        _ => format!("x^{k}"),
    }
}

fn factored(
    s: &FieldSpectrum,
    exponent: impl Fn(&FieldFactor) -> usize,
    factor: impl Fn(&FieldFactor) -> String,
) -> String {
    let mut out = String::new();
    for f in &s.factors {
        let _ = write!(out, "({})", factor(f));
        match exponent(f) {
            1 => {}
            e => {
                let _ = write!(out, "^{{{e}}}");
            }
        }
    }
    if out.is_empty() { "1".to_owned() } else { out }
}

fn largest_block(f: &FieldFactor) -> usize {
    f.blocks.first().copied().unwrap_or(0)
}

fn plain_factored(s: &FieldSpectrum, exponent: impl Fn(&FieldFactor) -> usize) -> String {
    factored(s, exponent, |f| polynomial(&f.poly, plain_power, |c| s.field.display(c))).replace(['{', '}'], "")
}

/// An eigenvalue: its text in the field where it lies there, with a decimal and its minimal polynomial.
fn eigenvalue(field: &NumberField, f: &FieldFactor, position: usize) -> String {
    let root = &f.roots[position];
    match (f.in_field(), root.rational()) {
        (true, None) => {
            let shown = field.display(&f.poly[0].neg());
            format!("{shown} = {}", root_text(root))
        }
        _ => root_text(root),
    }
}

/// The spectrum as text; chains are left out above [`MAX_TEXT_SIZE`].
#[must_use]
pub fn text(s: &FieldSpectrum) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "matrix of size {} over {}", s.size, s.field.describe());
    let _ = writeln!(out, "characteristic polynomial  {}", plain_factored(s, |f| f.multiplicity));
    let _ = writeln!(out, "minimal polynomial         {}", plain_factored(s, largest_block));
    let _ = writeln!(out, "\nmoduli, largest first");
    for (k, class) in s.classes.iter().enumerate() {
        let _ = writeln!(out, "  {}. |λ| = {}", k + 1, modulus_text(s.root(class.members[0])));
        for e in &class.members {
            let f = s.factor(*e);
            let value = eigenvalue(&s.field, f, e.root);
            let shown = format!("       {value}, multiplicity {}, {}", f.multiplicity, blocks_text(&f.blocks));
            // Long lines go on under the value.
            let long = shown.chars().count() > super::text::WIDTH;
            out.push_str(&if long { shown.replacen(" (root", "\n         (root", 1) } else { shown });
            out.push('\n');
        }
    }
    if s.size > MAX_TEXT_SIZE {
        let _ = writeln!(out, "\nthe chains of generalised eigenvectors are left out here; the JSON output has them");
        return out;
    }
    for f in &s.factors {
        if f.in_field() {
            let _ = writeln!(out, "\nλ = {}", s.field.display(&f.poly[0].neg()));
            chains_text(&mut out, "right", &f.right, |e| s.field.display(e));
            chains_text(&mut out, "left", &f.left, |e| s.field.display(e));
        } else {
            let (lambda, alpha) = (f.lambda.display("θ"), f.alpha.display("θ"));
            let generator = f.generator.primitive_display("x");
            let over = if s.field.is_rational() { String::new() } else { format!(", α = {alpha}") };
            let _ = writeln!(out, "\nλ = {lambda}{over}, θ a root of {generator}");
            chains_text(&mut out, "right", &f.right, |e| e.display("θ"));
            chains_text(&mut out, "left", &f.left, |e| e.display("θ"));
        }
    }
    out
}

fn elements(values: &[Elem]) -> Value {
    values.iter().map(|e| coefficients(e.0.coeffs())).collect()
}

/// The whole spectrum as JSON. Numbers are strings; an element of a field is its list of coefficients in powers of the
/// generator, the constant one first; enclosures are pairs of rationals.
#[must_use]
pub fn json(s: &FieldSpectrum) -> Value {
    let generator = s.field.generator();
    let factor = |f: &FieldFactor| {
        json!({
            "polynomial": elements(&f.poly),
            "text": polynomial(&f.poly, plain_power, |c| s.field.display(c)),
            "minimal_polynomial": coefficients(f.minpoly.coeffs()),
            "multiplicity": f.multiplicity,
            "blocks": f.blocks,
            "roots": f.roots.iter().map(root_json).collect::<Value>(),
            "theta": {
                "polynomial": coefficients(f.generator.coeffs()),
                "indices": f.generators.iter().map(crate::algebraic::Root::index).collect::<Vec<_>>(),
                "alpha": coefficients(f.alpha.0.coeffs()),
                "lambda": coefficients(f.lambda.0.coeffs()),
            },
            "right": chains_json(&f.right),
            "left": chains_json(&f.left),
        })
    };
    let member = |e: &crate::jordan::Eigenvalue| json!({ "factor": e.factor, "root": e.root });
    json!({
        "size": s.size,
        "field": {
            "text": s.field.describe(),
            "polynomial": coefficients(s.field.poly().coeffs()),
            "index": generator.index(),
            "value": interval_json(&generator.enclosure(64).0),
            "label": s.field.label(),
        },
        "characteristic_polynomial": elements(&s.char_poly()),
        "minimal_polynomial": elements(&s.min_poly()),
        "factors": s.factors.iter().map(factor).collect::<Value>(),
        "modulus_classes": s.classes.iter().map(|c| c.members.iter().map(member).collect::<Value>()).collect::<Value>(),
    })
}

fn latex_power(k: usize) -> String {
    match k {
        0 => String::new(),
        1 => "x".to_owned(),
        _ => format!("x^{{{k}}}"),
    }
}

/// The spectrum as a LaTeX fragment: the field, polynomials, a table of eigenvalues by modulus, the chains.
#[must_use]
pub fn latex(s: &FieldSpectrum) -> String {
    let mut out = String::new();
    let in_alpha = |e: &Elem| latex_terms(&e.0, "\\alpha");
    let over = |f: &FieldFactor| polynomial(&f.poly, latex_power, in_alpha);
    let value = s.field.to_f64(&Elem::generator(s.field.poly()));
    let _ = writeln!(
        out,
        "\\[ K = \\mathbb{{Q}}(\\alpha),\\quad {} = 0,\\quad \\alpha \\approx {value:.10} \\]",
        latex_poly(s.field.poly(), "\\alpha")
    );
    let _ = writeln!(out, "\\[ \\chi(x) = {} \\]", factored(s, |f| f.multiplicity, over));
    let _ = writeln!(out, "\\[ \\mu(x) = {} \\]", factored(s, largest_block, over));
    out.push_str("\\begin{tabular}{lllll}\n$|\\lambda|$ & $\\lambda$ & minimal polynomial & multiplicity & blocks \\\\\n\\hline\n");
    for class in &s.classes {
        for e in &class.members {
            let (root, f) = (s.root(*e), s.factor(*e));
            let value = match (root.rational(), f.in_field()) {
                (Some(q), _) => latex_rational(&q),
                (None, true) => in_alpha(&f.poly[0].neg()),
                (None, false) => decimal(root),
            };
            let modulus =
                root.rational().map_or_else(|| modulus_text(root), |q| latex_rational(&crate::arith::abs(&q)));
            let sizes: Vec<String> = f.blocks.iter().map(ToString::to_string).collect();
            let poly = latex_poly(&f.minpoly, "x");
            let _ =
                writeln!(out, "${modulus}$ & ${value}$ & ${poly}$ & {} & {} \\\\", f.multiplicity, sizes.join(", "));
        }
    }
    out.push_str("\\end{tabular}\n");
    if s.size <= MAX_TEXT_SIZE {
        for f in &s.factors {
            let variable = if f.in_field() { "\\alpha" } else { "\\theta" };
            let _ = writeln!(
                out,
                "\\[ \\lambda = {},\\quad \\alpha = {},\\quad {} = 0 \\]",
                latex_terms(&f.lambda.0, variable),
                latex_terms(&f.alpha.0, variable),
                latex_poly(&f.generator, variable)
            );
            for (letter, chains) in [('v', &f.right), ('w', &f.left)] {
                latex_chains(&mut out, letter, chains, variable);
            }
        }
    }
    out
}

fn latex_chains(out: &mut String, letter: char, chains: &[Chain], variable: &str) {
    for (k, chain) in chains.iter().enumerate() {
        for (j, v) in chain.vectors.iter().enumerate() {
            let entries: Vec<String> = v.iter().map(|e| latex_terms(&e.0, variable)).collect();
            let _ = writeln!(out, "\\[ {letter}_{{{},{}}} = ({}) \\]", k + 1, j + 1, entries.join(",\\ "));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jordan::FieldSpectrum;

    fn sample() -> FieldSpectrum {
        let text = "4 sqrt(5) 1 0 0  0 sqrt(5) 0 0  0 0 0 sqrt(5)  0 0 1 0";
        FieldSpectrum::of(&crate::case::matrix_file::parse_field("m", text).unwrap().matrix)
    }

    #[test]
    fn text_names_the_field_and_the_factors() {
        let text = text(&sample());
        assert!(text.contains("over Q(α), α = sqrt(5) = 2.2360679775"), "{text}");
        assert!(text.contains("(x - sqrt(5))^2(x^2 - sqrt(5))"), "{text}");
        assert!(text.contains("sqrt(5) = 2.2360679775 (root 2 of x^2 - 5), multiplicity 2, block 2"), "{text}");
        assert!(text.contains("θ a root of x^4 - 5"), "{text}");
    }

    #[test]
    fn json_has_everything() {
        let value = json(&sample());
        assert_eq!(value["field"]["polynomial"], json!(["-5", "0", "1"]));
        assert_eq!(value["factors"].as_array().unwrap().len(), 2);
        assert_eq!(value["factors"][0]["polynomial"], json!([["0", "-1"], ["1"]]));
        assert_eq!(value["modulus_classes"].as_array().unwrap().len(), 2);
    }

    #[test]
    fn latex_has_balanced_braces() {
        let text = latex(&sample());
        assert!(text.contains("(x-\\alpha)^{2}") || text.contains("(x - \\alpha)^{2}"), "{text}");
        assert_eq!(text.matches('{').count(), text.matches('}').count());
    }
}
