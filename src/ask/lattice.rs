//! The smoothness of the limits of masks on lattices.

use super::Smooth;
use crate::case::LatticeCase;
use crate::certificate::{checked, lattice_certificate};
use crate::diagnostic::{Problem, SourceText};
use crate::radius::Options;
use crate::report::lattice as report;
use crate::scheme::{Dilation, LatticeError, LatticeMask, Terms, lattice_names, named_mask};
use crate::theorem::lattice::{LatticeRegularity, lattice_regularity};
use std::path::Path;

fn wrong(message: String) -> Problem {
    let names: Vec<String> = lattice_names().iter().map(|(name, summary)| format!("{name} ({summary})")).collect();
    Problem::new("secant::regularity", message).with_help(format!(
        "write a symbol such as \"(1+x)^2*(1+y)^2/4\", with --dilation \"[[1,1],[1,-1]]\" where it is not twice the unit matrix, \
         name a file with a [mask], or one of {}",
        names.join(", ")
    ))
}

fn refused(error: &LatticeError) -> Problem {
    wrong(error.to_string())
}

/// A mask on a lattice with the name of its case: a symbol in several variables, one of the named masks, or a case file with a
/// `[mask]`. `None` where the input is meant as something else; a dilation says that it is not.
///
/// # Errors
/// A [`Problem`] where it is meant so and wrong.
pub(super) fn lattice_case(
    what: &str,
    parameters: &[String],
    dilation: Option<&str>,
) -> Result<Option<LatticeCase>, Problem> {
    let read = |text: &str| Dilation::parse(text).map_err(|e| refused(&e));
    // The parameters may stand behind the name in one word.
    let (name, behind) = what.split_once(' ').unwrap_or((what, ""));
    let given: Vec<String> = behind.split_whitespace().map(str::to_owned).chain(parameters.iter().cloned()).collect();
    if let Some(made) = named_mask(name, &given) {
        if dilation.is_some() {
            return Err(wrong(format!("`{what}` has its own dilation")));
        }
        let mask = made.map_err(|e| refused(&e))?;
        return Ok(Some(LatticeCase { name: name.to_owned(), mask }));
    }
    if Terms::is_meant(what) && !Path::new(what).exists() {
        if let Some(extra) = parameters.first() {
            return Err(wrong(format!("`{extra}` is a parameter, but only named schemes have parameters")));
        }
        let mask = LatticeMask::parse(what, dilation.map(read).transpose()?).map_err(|e| refused(&e))?;
        return Ok(Some(LatticeCase { name: "mask".to_owned(), mask }));
    }
    let text = Some(what).filter(|w| w.ends_with(".toml") || Path::new(w).is_file());
    let source = text.and_then(|w| SourceText::read(Path::new(w)).ok()).filter(|s| LatticeCase::is_meant(&s.text));
    match (source, dilation) {
        (Some(source), None) => LatticeCase::parse(&source.name, &source.text).map(Some),
        (Some(_), Some(_)) => Err(wrong(format!("{what} says its dilation itself"))),
        (None, Some(_)) => Err(wrong(format!("`{what}` is no mask on a lattice, which a dilation is for"))),
        (None, None) => Ok(None),
    }
}

/// What is known of a mask on a lattice.
pub(super) fn lattice_answer(mask: LatticeMask) -> Result<(Smooth, LatticeRegularity), Problem> {
    let found = lattice_regularity(mask, &Options::default()).map_err(|e| wrong(e.to_string()))?;
    let decided = found.converges().is_some() && (found.converges() == Some(false) || found.exponent.is_some());
    let smooth = Smooth { text: report::lattice(&found), data: report::lattice_data(&found), decided };
    Ok((smooth, found))
}

/// The same with its certificate, accepted by the checker, and the case file that it is about.
pub(super) fn lattice_certified(case: LatticeCase) -> Result<(Smooth, String, Option<String>), Problem> {
    let source = case.mask.case_text(&case.name);
    let (smooth, found) = lattice_answer(case.mask)?;
    let nothing = |e: String| wrong(e).with_help("see docs/certificate.md; no certificate was written");
    let certificate = lattice_certificate(&case.name, &found).map_err(|e| nothing(e.to_string()))?;
    let certificate = checked(&source, certificate).map_err(|e| nothing(e.to_string()))?;
    Ok((smooth, certificate.text(), Some(source)))
}
