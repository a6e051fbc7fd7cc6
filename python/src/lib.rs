//! The extension module `secant._secant`: the doors of `secant::ask`, with JSON as the transport (docs/json.md).
//!
//! No mathematics is done here. Every call leaves the interpreter free (the GIL is released), does its work on a thread with a
//! large stack, answers to Ctrl-C, and turns a panic into an exception.

mod doors;
mod meshes;
mod numbers;
mod regions;
mod work;

use pyo3::prelude::*;

#[pymodule]
fn _secant(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("version", env!("CARGO_PKG_VERSION"))?;
    m.add_class::<doors::Findings>()?;
    m.add_class::<meshes::MeshFindings>()?;
    m.add_class::<regions::RegionFindings>()?;
    m.add_function(wrap_pyfunction!(doors::certify, m)?)?;
    m.add_function(wrap_pyfunction!(doors::spectra, m)?)?;
    m.add_function(wrap_pyfunction!(doors::jsr, m)?)?;
    m.add_function(wrap_pyfunction!(meshes::mesh, m)?)?;
    m.add_function(wrap_pyfunction!(regions::region, m)?)?;
    m.add_function(wrap_pyfunction!(doors::regularity, m)?)?;
    m.add_function(wrap_pyfunction!(doors::solve, m)?)?;
    m.add_function(wrap_pyfunction!(doors::check, m)?)?;
    m.add_function(wrap_pyfunction!(doors::wavelet_mask, m)?)?;
    m.add_function(wrap_pyfunction!(doors::case_text, m)?)?;
    m.add_function(wrap_pyfunction!(numbers::locate, m)?)?;
    m.add_function(wrap_pyfunction!(numbers::enclosure, m)?)?;
    Ok(())
}
