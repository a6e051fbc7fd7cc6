//! Reads `n` and then `n` rows of `n` expressions such as `1/2` or `(1+sqrt(5))/4`, and prints the exact spectrum.
//!
//!     cargo run --release -p secant-exact --example spectrum -- FILE
//!
//! One line for each irreducible factor: degree, multiplicity, block sizes, primitive polynomial; then the sizes of the
//! classes of equal modulus, and the time that it took.

use secant_exact::algebraic::field::{FieldMatrix, NumberField};
use secant_exact::jordan::{FieldSpectrum, ModulusClass, Spectrum};
use std::time::Instant;

fn classes(classes: &[ModulusClass]) -> String {
    classes.iter().map(|c| c.members.len().to_string()).collect::<Vec<_>>().join(",")
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in std::env::args().skip(1) {
        let text = std::fs::read_to_string(&path)?;
        let words: Vec<&str> =
            text.lines().filter_map(|line| line.split('#').next()).flat_map(str::split_whitespace).collect();
        let (size, entries) = words.split_first().ok_or("an empty file")?;
        let n: usize = size.parse()?;
        if entries.len() != n * n {
            return Err(format!("{path}: {} entries for size {n}", entries.len()).into());
        }
        let (field, entries) = NumberField::read(entries).map_err(|(k, e)| format!("{path}: entry {k}: {e}"))?;
        let matrix = FieldMatrix::new(&field, n, n, entries);
        let start = Instant::now();
        if let Some(rational) = matrix.rational() {
            let spectrum = Spectrum::of(&rational);
            let time = start.elapsed();
            for f in &spectrum.factors {
                let poly = f.poly.primitive_display("x");
                println!("{} {} {:?} {poly}", f.degree(), f.multiplicity, f.blocks);
            }
            println!("classes {}", classes(&spectrum.classes));
            eprintln!("{path}: {:.1} ms", time.as_secs_f64() * 1e3);
        } else {
            let spectrum = FieldSpectrum::of(&matrix);
            let time = start.elapsed();
            for f in &spectrum.factors {
                println!("{} {} {:?} {}", f.degree(), f.multiplicity, f.blocks, f.minpoly.primitive_display("x"));
            }
            println!("classes {}", classes(&spectrum.classes));
            eprintln!("{path}: {:.1} ms over {}", time.as_secs_f64() * 1e3, field.describe());
        }
    }
    Ok(())
}
