//! The tests in one program (those of the corpus are `cases`): a program for each file would cost a link for each.

mod automata;
mod chains;
mod corpus;
#[path = "../fuzz/entries.rs"]
mod entries;

#[path = "architecture.rs"]
mod architecture;
#[path = "browser.rs"]
mod browser;
#[path = "case_forms.rs"]
mod case_forms;
#[path = "claims.rs"]
mod claims;
#[path = "cli.rs"]
mod cli;
#[path = "coq.rs"]
mod coq;
#[path = "every_point.rs"]
mod every_point;
#[path = "every_surface.rs"]
mod every_surface;
#[path = "extraordinary.rs"]
mod extraordinary;
#[path = "field.rs"]
mod field;
#[path = "frames.rs"]
mod frames;
#[path = "garbage.rs"]
mod garbage;
#[path = "identities.rs"]
mod identities;
#[path = "inputs.rs"]
mod inputs;
#[path = "junction.rs"]
mod junction;
#[path = "junction_surface.rs"]
mod junction_surface;
#[path = "latex.rs"]
mod latex;
#[path = "lattice.rs"]
mod lattice;
#[path = "laws.rs"]
mod laws;
#[path = "meshes.rs"]
mod meshes;
#[path = "outputs.rs"]
mod outputs;
#[path = "questions.rs"]
mod questions;
#[path = "radius.rs"]
mod radius;
#[path = "radius_field.rs"]
mod radius_field;
#[path = "readers.rs"]
mod readers;
#[path = "refinement.rs"]
mod refinement;
#[path = "regions.rs"]
mod regions;
#[path = "regions_plane.rs"]
mod regions_plane;
#[path = "regions_vertex.rs"]
mod regions_vertex;
#[path = "regularity.rs"]
mod regularity;
#[path = "render.rs"]
mod render;
#[path = "reports.rs"]
mod reports;
#[path = "schema.rs"]
mod schema;
#[path = "schemes.rs"]
mod schemes;
#[path = "solve.rs"]
mod solve;
#[path = "spectrum.rs"]
mod spectrum;
#[path = "studio.rs"]
mod studio;
#[path = "surface_cones.rs"]
mod surface_cones;
#[path = "surfaces.rs"]
mod surfaces;
#[path = "theory.rs"]
mod theory;
#[path = "units.rs"]
mod units;
#[path = "verdict_laws.rs"]
mod verdict_laws;
#[path = "vertices.rs"]
mod vertices;
