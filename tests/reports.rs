//! Reports as documents: well-formed, accessible, legible, and careful with what they claim.

use roxmltree::{Document, Node, ParsingOptions};
use secant::case::Valences;
use secant::prelude::*;
use secant::statement::Statement;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

/// A case of each kind: cusp, oscillating, complex pair, Jordan block, null component, joints that disagree, undetermined,
/// space, projected, affine maps, similarities, reversed pieces, interpolation, irrational, automaton, set; surfaces with a
/// tensor product, a null component, a complex pair, extraordinary faces; cones that shrink slowly; irrational entries.
const KINDS: [&str; 30] = [
    "thesis/half-tangent",
    "counterexamples/cycle-twice",
    "classical/levy",
    "classical/takagi",
    "counterexamples/null-witness",
    "counterexamples/uniformity",
    "two-parameter/corner-34-100",
    "counterexamples/own-end-point",
    "control/bezier-space",
    "control/bezier-cusp",
    "self-affine/bk-1",
    "classical/koch-2",
    "reversed/parabola",
    "fif/c1-plane",
    "irrational/regular-sqrt-2",
    "junction/m1-5-jordan-3",
    "sets/carpet-line",
    "two-parameter/sign-change",
    "surfaces/bicubic-space",
    "surfaces/null-refuted",
    "surfaces/spiral",
    "surfaces/double-real",
    "faces/catmull-clark-5",
    "control/cubic-null",
    "fif/vector",
    "fields/koch-sqrt3",
    "fields/db2",
    "fields/de-rham-golden",
    "fields/de-rham-tie",
    "fields/cosine-set",
];

/// Cases about vertices: proved, not C¹ by winding, by a line, by Jordan blocks, no spline.
const VERTICES: [&str; 5] = ["catmull-clark", "doo-sabin-frequency-2", "loop-zero", "catmull-clark-12-12", "sqrt3"];

fn report(name: &str) -> secant::report::document::Document {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
    let mut question = Question::read(&path).expect("the case is read");
    if let Question::Vertices { valences, .. } = &mut question {
        *valences = Some(Valences::List(match valences {
            Some(Valences::List(list)) => list.iter().copied().take(4).collect(),
            _ => vec![3, 5],
        }));
    }
    findings::proof(&prove(&question, &Budget::default()).expect("the case is certified"))
}

fn vertex_report(name: &str) -> secant::report::document::Document {
    report(&format!("surfaces/{name}"))
}

/// All of them, made once for all tests.
fn all_reports() -> &'static [(&'static str, secant::report::document::Document)] {
    static MADE: OnceLock<Vec<(&'static str, secant::report::document::Document)>> = OnceLock::new();
    MADE.get_or_init(|| {
        let vertices = VERTICES.iter().map(|name| (*name, vertex_report(name)));
        KINDS.iter().map(|name| (*name, report(name))).chain(vertices).collect()
    })
}

#[test]
fn pages_are_well_formed_and_accessible() {
    for (name, document) in all_reports() {
        let (name, page) = (*name, html::render(document));
        // Where there is no characteristic map there is none to draw.
        assert!(page.contains("<figure>") || name == "loop-zero" || name == "sqrt3", "{name} has no picture");
        let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
        let tree = Document::parse_with_options(&page, options).unwrap_or_else(|e| panic!("{name}: {e}"));
        let wrong = faults(&tree);
        assert!(wrong.is_empty(), "{name}:\n{}", wrong.join("\n"));
    }
}

fn faults(tree: &Document) -> Vec<String> {
    let mut wrong = Vec::new();
    let html = tree.root_element();
    if html.attribute("lang").is_none_or(str::is_empty) {
        wrong.push("the language is not said".to_owned());
    }
    let elements = || tree.descendants().filter(Node::is_element);
    let mut level = 0;
    for heading in elements().filter_map(|n| heading_level(&n)) {
        if heading > level + 1 || (heading == 1) != (level == 0) {
            wrong.push(format!("h{heading} after h{level}"));
        }
        level = heading;
    }
    for node in elements() {
        let name = node.tag_name().name();
        let label = node.attribute("aria-label").unwrap_or_default();
        match name {
            "svg" if node.attribute("role") != Some("img") || label.chars().count() < 20 => {
                wrong.push(format!("a picture without a description: {label:?}"));
            }
            "math" if node.text().unwrap_or_default().is_empty() && node.children().count() == 0 => {
                wrong.push("an empty formula".to_owned());
            }
            "th" if node.attribute("scope").is_none() => wrong.push("a head of a column without scope".to_owned()),
            "script" | "link" | "iframe" | "img" => wrong.push(format!("<{name}> is not needed")),
            _ => {}
        }
        if node.attribute("class").is_some_and(|c| c.split(' ').any(|c| c == "mark")) && label.is_empty() {
            wrong.push("a tick without words".to_owned());
        }
        for attribute in node.attributes().filter(|a| matches!(a.name(), "href" | "src")) {
            if attribute.value().contains("//") {
                wrong.push(format!("the network: {}", attribute.value()));
            }
        }
    }
    for name in ["title", "main", "h1", "math"] {
        if !elements().any(|n| n.tag_name().name() == name) {
            wrong.push(format!("no <{name}>"));
        }
    }
    wrong
}

fn heading_level(node: &Node) -> Option<u32> {
    let digit = node.tag_name().name().strip_prefix('h')?;
    digit.parse().ok().filter(|d| (1..=6).contains(d))
}

/// The relation of the brighter to the darker of two colours, as the Web Content Accessibility Guidelines define it.
fn contrast(a: &str, b: &str) -> f64 {
    let luminance = |text: &str| -> f64 {
        let digits = text.trim_start_matches('#');
        let channel = |k: usize| {
            let width = digits.len() / 3;
            let part = &digits[k * width..(k + 1) * width];
            let full = if width == 1 { part.repeat(2) } else { part.to_owned() };
            let x = f64::from(u8::from_str_radix(&full, 16).expect("a colour")) / 255.0;
            if x <= 0.03928 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2)
    };
    let (x, y) = (luminance(a), luminance(b));
    (x.max(y) + 0.05) / (x.min(y) + 0.05)
}

#[test]
fn text_has_contrast_in_light_and_dark() {
    let css = include_str!("../src/report/style.css");
    let schemes: Vec<BTreeMap<&str, &str>> = css
        .split(":root {")
        .skip(1)
        .take(2)
        .map(|block| {
            let body = block.split('}').next().unwrap_or_default();
            body.split(';').filter_map(|d| d.trim().strip_prefix("--")?.split_once(": ")).collect()
        })
        .collect();
    assert_eq!(schemes.len(), 2, "light and dark");
    for colours in &schemes {
        for text in ["ink", "good", "bad", "open", "neutral", "link"] {
            for paper in ["paper", "soft"] {
                let ratio = contrast(colours[text], colours[paper]);
                assert!(ratio >= 4.5, "{text} on {paper}: {ratio:.2}");
            }
        }
    }
    // Lines and labels of the pictures.
    let style = secant::picture::style();
    let (light, dark) = style.split_once("@media").expect("a dark scheme");
    for (rules, scheme) in [(light, &schemes[0]), (dark, &schemes[1])] {
        for class in ["sc-c", "sc-t", "sc-tangent", "sc-cusp", "sc-corner", "sc-open"] {
            let rule = rules.split(&format!(".{class}")).nth(1).expect("a rule for every class");
            let colour = rule.split('#').nth(1).and_then(|c| c.get(..6)).expect("a colour");
            let least = if class == "sc-t" { 4.5 } else { 3.0 };
            assert!(contrast(colour, scheme["paper"]) >= least, "{class} {colour}");
        }
    }
}

#[test]
fn no_theorem_is_named_for_what_it_does_not_prove() {
    let text = markdown::render(&report("two-parameter/corner-34-100"));
    assert!(text.contains("it is false that the curve has a tangent line at every joint"), "{text}");
    assert!(!text.contains("Theorem 5"), "a corner is no instance of Theorem 5");
    let open = markdown::render(&report("counterexamples/own-end-point"));
    assert!(open.contains("It is not applied"), "{open}");
    assert!(!open.contains("Statements applied: Theorem 2 (complete set of eigenvectors); Theorem 5"));
}

/// What is cited: the number or name after words such as `Theorem`, and the statements that the references list.
fn citations(text: &str) -> Vec<String> {
    let mut cited = Vec::new();
    for word in ["Theorem", "Lemma"] {
        for (at, _) in text.match_indices(&format!("{word} ")) {
            let rest = &text[at + word.len() + 1..];
            let number: String = rest.chars().take_while(|c| c.is_ascii_digit() || "′″".contains(*c)).collect();
            // A theorem of somebody else has an author before it, such as `Nonlinearity 24 (2011), Theorem 1`.
            if !number.is_empty() && !text[..at].trim_end().ends_with("),") && !text[..at].ends_with("0881, ") {
                cited.push(format!("{word} {number}"));
            }
        }
    }
    cited
}

#[test]
fn what_the_case_gives_is_shown_as_it_was_given() {
    let text = |name: &str| {
        let found = all_reports().iter().find(|(n, _)| *n == name);
        markdown::render(&found.expect("the report is made").1)
    };
    let data = text("fif/vector");
    // The second factor is 1/7, the third polynomial goes through (1, 1/2, 2).
    assert!(data.contains("The case gives the points") && data.contains("They are made of these data."), "{data}");
    assert!(data.contains(r"\begin{pmatrix} \frac{1}{7} & 0 \\ 0 & \frac{1}{7} \end{pmatrix}"), "{data}");
    let maps = text("fields/koch-sqrt3");
    assert!(
        maps.contains("The maps:")
            && maps.contains(r"map 0: $x \mapsto \begin{pmatrix} \frac{1}{3} & 0 \\ 0 & \frac{1}{3}")
    );
    assert!(text("thesis/half-tangent").contains("The case gives them in this form."));
}

#[test]
fn reports_over_a_field_are_proofs() {
    let headings = ["## Contraction", "## The cycles", "## The points", "## References"];
    for (name, document) in all_reports().iter().filter(|(name, _)| name.starts_with("fields/")) {
        let text = markdown::render(document);
        for heading in headings {
            assert!(text.contains(heading), "{name}: {heading}");
        }
        assert!(text.contains("its entries lie in Q(α), α = "), "{name}");
        assert!(!text.contains("is not confirmed by the code words"), "{name}");
    }
}

#[test]
fn every_citation_resolves() {
    for (name, document) in all_reports() {
        let text = markdown::render(document);
        for cited in citations(&text) {
            assert!(Statement::named(&cited).is_some(), "{name} cites {cited}, which `secant explain` does not know");
        }
        assert!(!text.contains("This report is not complete"), "{name} leaves out a hypothesis");
        let listed = text.lines().find_map(|l| l.strip_prefix("- Statements applied: "));
        assert!(listed.is_some() || !text.contains("\n> **"), "{name}: a statement is quoted and not listed");
        for statement in listed.iter().flat_map(|l| l.split(". Proofs:").next()).flat_map(|l| l.split("; ")) {
            assert!(Statement::ALL.iter().any(|s| s.name() == statement), "{name}: {statement}");
            assert!(text.contains(&format!("> **{statement}.**")), "{name}: {statement} is not quoted");
        }
    }
    for statement in Statement::ALL {
        for cited in citations(statement.source()) {
            assert!(Statement::named(&cited).is_some(), "{} cites {cited}", statement.id());
        }
    }
}

#[test]
fn a_statement_is_quoted_once_and_every_symbol_of_functionals_is_listed() {
    for (name, document) in all_reports() {
        let text = markdown::render(document);
        for statement in Statement::ALL {
            let quoted = text.matches(&format!("> **{}.**", statement.name())).count();
            assert!(quoted <= 1, "{name}: {} is quoted {quoted} times", statement.name());
        }
        // Tables that name functionals follow a list of these functionals.
        for letter in ["g", "h", "k"] {
            let used = text.contains(&format!("| ${letter}_{{1}}$ |"));
            assert!(!used || text.contains(&format!("- ${letter}_{{1}}(x)")), "{name}: {letter} is not defined");
        }
    }
}

#[test]
fn what_rests_on_the_ring_is_not_claimed_without_it() {
    // On a line the tangent needs no ring condition, but rays, rates and exponents do.
    let text = markdown::render(&report("counterexamples/mirrored-third"));
    let without = text.split("### Cycle").find(|part| part.contains("Corollary on a line"));
    let section = without.expect("a cycle on a line");
    assert!(!section.contains("Hölder") && !section.contains("angular deviation"), "{section}");
    // A set has no parameter, and no exponent in it.
    let set = markdown::render(&report("sets/carpet-line"));
    assert!(!set.contains("Hölder") && !set.contains("it in the order of the curve"), "{set}");
}

#[test]
fn the_same_case_gives_the_same_bytes() {
    for name in ["classical/takagi", "sets/carpet-line"] {
        let (a, b) = (report(name), report(name));
        assert_eq!(html::render(&a), html::render(&b));
        assert_eq!(latex::render(&a), latex::render(&b));
    }
}

#[test]
fn the_readme_shows_what_works() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    // Its program is that of the crate's documentation, which is compiled and run as a test.
    let program = readme.split("```rust\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a program");
    let library = std::fs::read_to_string(root.join("src/lib.rs")).unwrap();
    for line in program.lines().filter(|l| !l.trim().is_empty()) {
        assert!(library.contains(&format!("//! {line}")), "the crate's documentation lacks: {line}");
    }
}

/// What is said of a product at every point rests on what is said of its curves, which is shown.
#[test]
fn the_report_of_a_product_proves_its_curves_smooth() {
    let page = html::render(&report("surfaces/de-rham-product"));
    let at = |text: &str| page.find(text).unwrap_or_else(|| panic!("{text} is missing"));
    let (first, second) = (at("Every point of the first curve"), at("Every point of the second curve"));
    let theorem = at(Statement::TensorEveryPoint.name());
    assert!(
        first < second && page.contains(Statement::Theorem6Slow.name()) && page.contains(Statement::Theorem6.name())
    );
    assert!(
        page[first..second].contains("<strong>positive</strong>")
            && page[second..].contains("<strong>positive</strong>")
    );
    assert!(theorem > 0);
}
