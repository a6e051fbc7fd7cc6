//! What can be chosen on the page: schemes with the values of their sliders, mesh rules, and examples.

use crate::arith::{Rational, parse_rational, ratio};
use crate::mesh::Scheme;
use crate::scheme::{self, Parameter};
use serde_json::{Value, json};

/// Examples: title, and text. They are files of the corpus and of the README.
const EXAMPLES: [(&str, &str); 10] = [
    ("Mask: Chaikin's corner cutting", "1/4, 3/4, 3/4, 1/4"),
    ("Symbol: cubic B-spline", "(1+z)^4/8"),
    ("Matrices: the thesis's half-tangent", include_str!("../../cases/thesis/half-tangent.toml")),
    ("Control points: a Bézier curve with a cusp", include_str!("../../cases/control/bezier-cusp.toml")),
    ("Maps: an interpolation function", include_str!("../../cases/fif/integral.toml")),
    ("Maps: Koch's curve, with √3", include_str!("../../cases/fields/koch-sqrt3.toml")),
    ("Maps: Sierpiński's triangle", include_str!("../../cases/sets/sierpinski.toml")),
    ("Automaton: three states", include_str!("../../cases/automata/three-states.toml")),
    ("Surface: a bicubic patch in space", include_str!("../../cases/surfaces/bicubic-space.toml")),
    ("Vertex: Catmull and Clark with other weights", include_str!("../../cases/surfaces/catmull-clark-12-12.toml")),
];

/// Meshes: title, and text.
const MESHES: [(&str, &str); 4] = [
    ("octahedron", include_str!("../../cases/meshes/octahedron.obj")),
    ("cube", include_str!("../../cases/meshes/cube.obj")),
    ("torus", include_str!("../../cases/meshes/torus.obj")),
    ("folded", include_str!("../../cases/meshes/folded.obj")),
];

/// Everything that can be chosen.
pub fn catalogue() -> Value {
    let curve = |s: &scheme::SchemeInfo| entry(s.name, s.summary, s.source, s.parameters);
    let rule = |s: &scheme::RuleInfo| entry(s.name, s.summary, s.source, s.parameters);
    let examples = EXAMPLES.map(|(title, text)| json!({"title": title, "text": text}));
    let meshes = MESHES.map(|(title, text)| json!({"title": title, "text": text}));
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "schemes": scheme::list().iter().map(curve).collect::<Vec<_>>(),
        "rules": scheme::mesh_rules().iter().map(rule).collect::<Vec<_>>(),
        "refined_by": Scheme::ALL.map(Scheme::name),
        "examples": examples,
        "meshes": meshes,
    })
}

fn entry(name: &str, summary: &str, source: &str, parameters: &[Parameter]) -> Value {
    let parameter = |p: &Parameter| {
        let values = values(name, p);
        let first = p.default.and_then(|text| parse_rational(text).ok());
        let first = first.or_else(|| values.get(values.len() / 4).cloned());
        json!({
            "name": p.name,
            "summary": p.summary,
            "value": first.map(|x| x.to_string()),
            "needed": p.default.is_none(),
            "values": values.iter().map(ToString::to_string).collect::<Vec<_>>(),
        })
    };
    json!({
        "name": name,
        "summary": summary,
        "source": source,
        "parameters": parameters.iter().map(parameter).collect::<Vec<_>>(),
    })
}

/// The values of the slider of a scheme's parameter; `None` where there is no such scheme or parameter.
pub fn slider(scheme: &str, parameter: &str) -> Option<Vec<Rational>> {
    let info = scheme::list().iter().find(|s| s.name == scheme)?;
    Some(values(scheme, info.parameters.iter().find(|p| p.name == parameter)?))
}

/// The exact values of a slider, in ascending order, the default among them. Other values can be typed.
fn values(scheme: &str, parameter: &Parameter) -> Vec<Rational> {
    let steps = |from: i64, to: i64, over: i64| (from..=to).map(|k| ratio(k, over)).collect::<Vec<_>>();
    let mut values = match (scheme, parameter.name) {
        (_, "degree" | "k") => steps(1, 8, 1),
        (_, "arity") => steps(2, 5, 1),
        (_, "points") => (1..=5).map(|k| ratio(2 * k, 1)).collect(),
        (_, "pieces") => vec![ratio(2, 1), ratio(4, 1)],
        ("four-point", "w") => steps(-50, 100, 400),
        (_, "mu") => steps(1, 98, 495),
        ("ternary-three-point", "b") => steps(9, 40, 90),
        ("corner-cutting", _) => steps(-24, 36, 48),
        ("de-rham", _) => steps(1, 23, 48),
        (_, "alpha") => steps(-47, 47, 48),
        ("bezier" | "lebesgue" | "okamoto", _) => steps(1, 47, 48),
        _ => around(parameter),
    };
    if let Some(default) = parameter.default.and_then(|text| parse_rational(text).ok()) {
        values.push(default);
    }
    values.sort();
    values.dedup();
    values
}

/// Values around the default, where nothing is known of a parameter.
fn around(parameter: &Parameter) -> Vec<Rational> {
    let middle = parameter.default.and_then(|text| parse_rational(text).ok()).unwrap_or_else(|| ratio(1, 4));
    (-48..=48).map(|k| &middle + ratio(k, 48)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sliders_hold_the_default_and_exact_numbers() {
        let all = catalogue();
        let all: Vec<&Value> = ["schemes", "rules"].iter().flat_map(|k| all[*k].as_array().expect("a list")).collect();
        assert_eq!(all.len(), scheme::list().len() + scheme::mesh_rules().len());
        for entry in all {
            for parameter in entry["parameters"].as_array().expect("a list") {
                let values = parameter["values"].as_array().expect("a list");
                assert!(values.contains(&parameter["value"]), "{} of {}", parameter["name"], entry["name"]);
                let number = |v: &Value| parse_rational(v.as_str().expect("text")).expect("a number");
                assert!(values.windows(2).all(|w| number(&w[0]) < number(&w[1])));
            }
        }
    }
}
