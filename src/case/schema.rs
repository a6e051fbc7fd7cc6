//! The case format as a JSON Schema, for completion and checks in editors.

use super::{MAX_ADDRESSES, MAX_COORDINATES, MAX_PIECES, MAX_STATES};
use crate::scheme;
use serde_json::{Map, Value, json};

/// The schema (draft 2020-12) of case files.
#[must_use]
pub fn schema() -> Value {
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A case of secant",
        "description": "Self-similar shapes and what is asked about them: docs/case-format.md",
        "type": "object",
        "required": ["name"],
        "additionalProperties": false,
        "properties": root(),
        "$defs": {
            "number": {
                "description": "an integer, a decimal (read exactly), or a fraction in quotes",
                "type": ["integer", "number", "string"]
            },
            "point": {"type": "array", "items": {"$ref": "#/$defs/number"}},
            "matrix": {"description": "a list of rows", "type": "array", "items": {"$ref": "#/$defs/point"}, "minItems": 1},
            "operator": {
                "anyOf": [
                    {"$ref": "#/$defs/matrix"},
                    {"const": "?", "description": "an operator of which nothing is known, for `secant solve`"}
                ]
            },
            "boundary": object(&[
                ("vertex", json!({"type": "string"})),
                ("edge", json!({"type": "string"})),
                ("matrix", reference("operator")),
                ("points", json!({"type": "array", "items": {"type": "integer", "minimum": 0}})),
            ]),
            "address": {
                "description": "letters, and the repeated ones in brackets, as in 0(1)",
                "type": "string",
                "pattern": "\\("
            },
            "verdict": words(&["proved", "refuted", "undetermined"]),
        }
    })
}

fn reference(name: &str) -> Value {
    json!({"$ref": format!("#/$defs/{name}")})
}

fn words(list: &[&str]) -> Value {
    json!({"enum": list})
}

fn text(description: &str) -> Value {
    json!({"type": "string", "description": description})
}

fn flag(description: &str) -> Value {
    json!({"type": "boolean", "description": description})
}

fn properties(list: &[(&str, Value)]) -> Value {
    Value::Object(list.iter().map(|(key, value)| ((*key).to_owned(), value.clone())).collect::<Map<_, _>>())
}

/// A table with these keys and no others.
fn object(list: &[(&str, Value)]) -> Value {
    json!({"type": "object", "additionalProperties": false, "properties": properties(list)})
}

fn list_of(item: &Value, most: usize) -> Value {
    json!({"type": "array", "items": item, "maxItems": most})
}

fn root() -> Value {
    let map = object(&[
        ("linear", reference("matrix")),
        ("shift", reference("point")),
        ("reversed", flag("the piece runs backwards")),
        ("share", share()),
    ]);
    let examine = object(&[("address", reference("address"))]);
    let reversed = json!({"type": "array", "items": {"type": "integer", "minimum": 0}});
    properties(&[
        ("name", json!({"type": "string", "pattern": "^[A-Za-z0-9_-][A-Za-z0-9._-]{0,99}$"})),
        ("title", text("one line for people")),
        ("source", text("where the shape and the claim come from")),
        ("kind", words(&["curve", "set"])),
        (
            "convention",
            json!({
                "enum": ["columns", "rows"],
                "description": "columns: operators on columns of barycentric coordinates, columns sum to 1; rows: subdivision \
                                matrices on rows of control points, rows sum to 1"
            }),
        ),
        ("pieces", list_of(&reference("operator"), MAX_PIECES)),
        ("reversed", reversed),
        ("shares", reference("point")),
        ("interpolate", interpolate()),
        ("map", list_of(&map, MAX_PIECES)),
        ("scheme", scheme_table()),
        ("mask", mask_table()),
        ("border", border_table()),
        ("start", text("the state whose shape is asked about")),
        ("state", list_of(&state(), MAX_STATES)),
        ("control", reference("matrix")),
        ("examine", list_of(&examine, MAX_ADDRESSES)),
        ("expect", expect()),
        ("vertex", vertex()),
        (
            "parameters",
            json!({
                "type": "object",
                "description": "numbers that are left to whoever asks: a range \"-1/2..1/2\", or a value",
                "additionalProperties": reference("number")
            }),
        ),
    ])
}

fn share() -> Value {
    json!({"$ref": "#/$defs/number", "description": "the part of the parameter that the piece takes"})
}

fn interpolate() -> Value {
    object(&[
        ("points", reference("matrix")),
        ("vertical", list_of(&factor(), MAX_PIECES)),
        ("polynomials", list_of(&polynomial(), MAX_PIECES)),
    ])
}

fn factor() -> Value {
    json!({"anyOf": [{"$ref": "#/$defs/number"}, {"$ref": "#/$defs/matrix"}]})
}

fn polynomial() -> Value {
    json!({"anyOf": [{"$ref": "#/$defs/point"}, {"$ref": "#/$defs/matrix"}]})
}

fn state() -> Value {
    let piece = object(&[
        ("to", text("the state that the piece is an image of")),
        ("matrix", reference("operator")),
        ("reversed", flag("the piece runs backwards")),
        ("share", share()),
        ("corners", json!({"type": "array", "items": {"type": "integer", "minimum": 0, "maximum": 3}})),
    ]);
    let side = || reference("boundary");
    object(&[
        ("name", text("1 to 40 characters")),
        ("kind", words(&["edge", "vertex", "set", "face"])),
        ("dimension", json!({"type": "integer", "minimum": 1, "maximum": MAX_COORDINATES})),
        ("left", side()),
        ("right", side()),
        ("reversal", side()),
        ("layout", json!({"type": "string", "pattern": "^([0-9]+x[0-9]+|triangle)$"})),
        ("bottom", side()),
        ("top", side()),
        ("side01", side()),
        ("side12", side()),
        ("side02", side()),
        ("piece", list_of(&piece, MAX_PIECES)),
    ])
}

/// The keys of `[scheme]` that are no parameters, and the parameters of all schemes.
fn scheme_table() -> Value {
    let names: Vec<&str> = scheme::list().iter().map(|s| s.name).collect();
    let meshes: Vec<&str> = scheme::mesh_rules().iter().map(|s| s.name).collect();
    let numbers = list_of(&reference("number"), usize::from(u16::MAX));
    let own = [
        ("name", words(&names)),
        ("mask", numbers.clone()),
        ("symbol", text("a Laurent polynomial in z, as in (1+z)^3/4")),
        ("filter", numbers.clone()),
        ("normalisation", words(&["arity", "one", "root"])),
        ("arity", json!({"type": ["integer", "number", "string"]})),
        ("vertices", flag("adds the vertex states of a curve")),
        ("ends", words(&["open", "closed", "clamped"])),
        ("knots", numbers),
        ("tensor", json!({"type": "array", "items": {"type": "object"}, "minItems": 2, "maxItems": 2})),
        ("interpolate", reference("matrix")),
        ("vertical", list_of(&factor(), MAX_PIECES)),
        ("polynomials", list_of(&polynomial(), MAX_PIECES)),
        ("mesh", words(&meshes)),
        ("valence", json!({"type": "integer", "minimum": 3, "maximum": scheme::MAX_VALENCE})),
        ("cell", words(&["face", "disc"])),
    ];
    let mut all: Map<String, Value> = own.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
    let curves = scheme::list().iter().flat_map(|s| s.parameters);
    for parameter in curves.chain(scheme::mesh_rules().iter().flat_map(|s| s.parameters)) {
        let entry = json!({"$ref": "#/$defs/number", "description": parameter.summary});
        all.entry(parameter.name).or_insert(entry);
    }
    json!({"type": "object", "properties": all, "additionalProperties": false})
}

/// `[mask]`: a mask in several variables.
fn mask_table() -> Value {
    let names: Vec<&str> = scheme::lattice_names().into_iter().map(|(name, _)| name).collect();
    object(&[
        ("dilation", json!({"type": ["array", "string", "integer"]})),
        ("grid", json!({"type": "array"})),
        ("origin", json!({"type": "array", "items": {"type": "integer"}})),
        ("symbol", text("a Laurent polynomial in x and y, as in (1+x)^2*(1+y)^2/4")),
        ("name", words(&names)),
        ("parameters", json!({"type": "array", "items": {"type": "string"}})),
        ("directions", json!({"type": "array", "items": {"type": "array"}})),
    ])
}

/// `[border]`: two masks that meet along a line.
fn border_table() -> Value {
    let side = || json!({"type": ["string", "object"]});
    let stencil = object(&[
        ("at", json!({"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2})),
        ("weights", json!({"type": "array", "items": {"type": "array"}})),
    ]);
    object(&[("left", side()), ("right", side()), ("stencil", json!({"type": "array", "items": stencil}))])
}

fn vertex() -> Value {
    let meshes: Vec<&str> = scheme::mesh_rules().iter().map(|s| s.name).collect();
    let meshes: Vec<&str> = meshes.into_iter().chain(["own"]).collect();
    let mut all = own_stencils();
    all.insert("mesh".to_owned(), words(&meshes));
    // Of `loop-variant` it may be a formula or a table by valence.
    all.insert(
        "beta".to_owned(),
        json!({"type": ["number", "string", "object"], "description": "weight, or a formula in n"}),
    );
    all.insert(
        "valence".to_owned(),
        json!({"type": ["integer", "string"], "description": "5, \"3..32\", \"3,5,8\" or \"all\""}),
    );
    all.insert("boundary".to_owned(), words(&["smooth", "corner"]));
    all.insert(
        "faces".to_owned(),
        json!({"type": ["integer", "string"], "description": "3, \"1..12\" or \"1,2,5..7\""}),
    );
    all.insert("cell".to_owned(), words(&["face", "disc"]));
    all.insert("weights".to_owned(), json!({"type": "array", "items": reference("number")}));
    for parameter in scheme::mesh_rules().iter().flat_map(|s| s.parameters) {
        let entry = json!({"$ref": "#/$defs/number", "description": parameter.summary});
        all.entry(parameter.name).or_insert(entry);
    }
    for key in scheme::mesh_rules().iter().flat_map(|s| s.rest.iter().chain(&s.list)) {
        all.entry(*key).or_insert(json!({"description": "weights"}));
    }
    json!({"type": "object", "properties": all, "additionalProperties": false})
}

/// The keys of `mesh = "own"`.
fn own_stencils() -> Map<String, Value> {
    let weights = || json!({"type": "object", "additionalProperties": {"type": ["number", "string"]}});
    let stencils = |more: Vec<(&str, Value)>| {
        let elements = ["vertex", "edge", "face"].map(|key| (key, weights()));
        object(&elements.into_iter().chain(more).collect::<Vec<_>>())
    };
    let centre = stencils(vec![("valence", json!({"type": ["integer", "string"]}))]);
    let keys = [
        ("split", words(&scheme::OwnRule::splits())),
        ("stencil", stencils(Vec::new())),
        ("centre", json!({"anyOf": [centre.clone(), {"type": "array", "items": centre}]})),
    ];
    keys.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

fn expect() -> Value {
    let rays = json!({"type": "array", "items": reference("point")});
    let point = object(&[
        ("address", reference("address")),
        ("kind", text("such as `smooth end`, `regular` or `cusp`")),
        ("verdict", reference("verdict")),
        ("dimension", json!({"type": "integer", "minimum": 0})),
        ("plane", rays.clone()),
        ("tangent", reference("point")),
        ("left", rays.clone()),
        ("right", rays),
        ("eigenvalue", text("its minimal polynomial, such as x - 3/4")),
    ]);
    let valences = || json!({"type": ["integer", "string"]});
    object(&[
        ("verdict", reference("verdict")),
        ("contraction", reference("verdict")),
        ("error", text("the code of the diagnostic with which the case is refused")),
        ("point", json!({"type": "array", "items": point})),
        ("solve", json!({"type": "object"})),
        ("proved", valences()),
        ("refuted", valences()),
        ("undetermined", valences()),
    ])
}
