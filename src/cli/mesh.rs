//! `secant certify` of a mesh.

use super::certify::{exit_code, extension, json_text};
use super::files::Written;
use super::output::{self, say, to_stdout};
use super::progress::Progress;
use super::{CertifyArgs, Drawn};
use crate::certificate::{Certificate, Doubt, Unsupported, confirm_mesh};
use crate::diagnostic::Problem;
use crate::mesh::{Boundary, Found, Model, Scheme, certify};
use crate::picture::mesh::{ply, svg};
use crate::report::mesh::Again;
use crate::report::{findings, html, latex, markdown, mesh as report};
use std::path::Path;

/// What the checker said.
type Checked = Result<Certificate, Unsupported>;

/// Certifies one mesh, prints and writes what was asked for; the exit code.
///
/// # Errors
/// The [`Problem`] of the file, of an option, or of an output.
pub fn run(path: &Path, args: &CertifyArgs) -> Result<u8, Problem> {
    check(args)?;
    let piped = to_stdout([&args.report, &args.svg, &args.ply, &args.certificate])?;
    let names = Scheme::ALL.map(Scheme::name).join(", ");
    let name = args.scheme.as_deref().ok_or_else(|| {
        Problem::new("secant::usage::scheme", "a mesh has no scheme of its own")
            .with_help(format!("add --scheme with one of {names}"))
    })?;
    let scheme = Scheme::named(name).ok_or_else(|| {
        Problem::new("secant::usage::scheme", format!("meshes are not refined by `{name}`"))
            .with_help(format!("the schemes for meshes are {names}"))
    })?;
    let mut model = Model::read(path)?;
    if let Some(rule) = &args.boundary {
        let known = Boundary::named(rule).ok_or_else(|| {
            let names = Boundary::ALL.map(Boundary::name).join(" and ");
            Problem::new("secant::usage::boundary", format!("there is no rule `{rule}` of the border"))
                .with_help(format!("the rules are {names}"))
        })?;
        model.tags.boundary = Some(known);
    }
    let progress = Progress::of(0, "vertices", args.quiet);
    let found = certify(&model, scheme, &args.budget(), &|| progress.step());
    progress.finish();
    let found = found?;
    let again = again(&model, scheme, &found, args)?;
    let written = write(&model, name, &found, again.as_ref(), args);
    if !args.quiet {
        say(&shown(&model, name, &found, again.as_ref(), args), piped);
    }
    Ok(written.code(exit_code(args.require.at_vertices(found.smooth(), found.regular()))))
}

/// What the checker says of what was found; `None` where it is not asked.
fn again(model: &Model, scheme: Scheme, found: &Found, args: &CertifyArgs) -> Result<Option<Checked>, Problem> {
    if args.no_check && args.certificate.is_none() {
        return Ok(None);
    }
    match confirm_mesh(model, scheme, found) {
        Ok(certificate) => Ok(Some(Ok(certificate))),
        Err(Doubt::Unsupported(why)) => Ok(Some(Err(why))),
        Err(doubt) => Err(Problem::new("secant::certificate::rejected", format!("{}: {doubt}", model.name))
            .with_help("this is a mistake in secant: please report it with the mesh; --no-check leaves the check out")),
    }
}

fn check(args: &CertifyArgs) -> Result<(), Problem> {
    let strange = [
        (args.png.is_some(), "--png", "--svg draws the mesh"),
        (!args.address.is_empty(), "--address", "the report lists every vertex"),
        (args.valence.is_some(), "--valence", "the valences are those of the mesh"),
        (args.size.is_some(), "--size", "the picture of a mesh has one size"),
        (args.approx, "--approx", "there is no quick look at a mesh"),
        (args.resume.is_some(), "--resume", "a mesh is certified anew"),
        (args.coq.is_some(), "--coq", "no formal theorem of proofs/ covers the vertices of a mesh"),
        (args.draw == Drawn::Cones, "--draw cones", "the picture of a mesh has its vertices coloured by verdict"),
    ];
    match strange.iter().find(|(given, _, _)| *given) {
        Some((_, option, help)) => {
            Err(Problem::new("secant::usage", format!("{option} does not go with a mesh")).with_help(help))
        }
        None => Ok(()),
    }
}

/// A certificate that was asked for, and that there is not.
fn none(why: String) -> Problem {
    Problem::new("secant::certificate::none", why)
        .with_help("see docs/certificate.md, “What is not covered”; no certificate was written")
}

fn shown(model: &Model, scheme: &str, found: &Found, again: Again<'_>, args: &CertifyArgs) -> String {
    if args.json || args.jsonl {
        return json_text(&report::json(model, scheme, found, again), args.json);
    }
    let mut document = report::document(model, scheme, found, again, false);
    let verdict = args.require.at_vertices(found.smooth(), found.regular());
    document.blocks.extend(findings::of_vertices(&args.require, verdict));
    output::shown(&document)
}

fn write(model: &Model, scheme: &str, found: &Found, again: Again<'_>, args: &CertifyArgs) -> Written {
    let mut written = Written::default();
    written.file(args.report.as_deref(), |path| {
        let document = report::document(model, scheme, found, again, true);
        Ok(match extension(path).as_str() {
            "md" => markdown::render(&document),
            "tex" => latex::render(&document),
            _ => html::render(&document),
        })
    });
    written.file(args.svg.as_deref(), |_| {
        svg(model, found, &model.name).ok_or_else(|| {
            Problem::new("secant::picture", "the mesh cannot be drawn")
                .with_help("it has more than 20000 faces, or no extent")
        })
    });
    written.file(args.ply.as_deref(), |_| Ok(ply(model, found)));
    written.certificate(args.certificate.as_deref(), || match again {
        Some(Ok(certificate)) => Ok((certificate.text(), None)),
        Some(Err(why)) => Err(none(why.to_string())),
        None => Err(none("the checker was not asked".to_owned())),
    });
    written
}
