//! Every decided case gets a certificate, and the checker accepts it.

mod corpus;

use corpus::case_files;
use secant::case::Case;
use secant::certificate::certificate;
use secant::theorem::surface::certify_complex;
use std::path::{Path, PathBuf};

fn corpus() -> Vec<PathBuf> {
    let mut files = Vec::new();
    case_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases"), &mut files);
    files.retain(|f| !f.components().any(|c| c.as_os_str() == "refused" || c.as_os_str() == "solve"));
    files
}

#[test]
fn every_case_has_a_certificate_that_passes() {
    let (mut mistakes, mut times) = (Vec::new(), Vec::new());
    let (mut bytes, mut count, mut prove, mut check) = (0, 0, std::time::Duration::ZERO, std::time::Duration::ZERO);
    for path in corpus() {
        let family = path.parent().unwrap().file_name().unwrap().to_string_lossy().into_owned();
        let name = format!("{family}--{}", path.file_stem().unwrap().to_string_lossy());
        let case = Case::read(&path).unwrap();
        let begin = std::time::Instant::now();
        let Ok(found) = certify_complex(&case.complex(), &case.examine) else { continue };
        let proved = begin.elapsed();
        let text = match certificate(&case, &found) {
            Ok(certificate) => certificate.text(),
            Err(error) => {
                mistakes.push(format!("{name}: {error}"));
                continue;
            }
        };
        if let Ok(dir) = std::env::var("SECANT_WRITE_CERTIFICATES") {
            std::fs::write(Path::new(&dir).join(format!("{name}.json")), &text).unwrap();
        }
        (bytes, count) = (bytes + text.len(), count + 1);
        let begin = std::time::Instant::now();
        let checked = secant_check::check(&case.checked_text(), &text);
        (prove, check) = (prove + proved, check + begin.elapsed());
        times.push((proved, begin.elapsed(), text.len(), name.clone()));
        match checked {
            Ok(accepted) if accepted.verdict.word() == found.verdict.word() => {}
            Ok(accepted) => {
                mistakes.push(format!("{name}: {} instead of {}", accepted.verdict.word(), found.verdict.word()))
            }
            Err(rejected) => mistakes.push(format!("{name}: {rejected}")),
        }
    }
    times.sort_by_key(|t| std::cmp::Reverse(t.1));
    for (proved, checked, size, name) in &times[..10] {
        println!("{name}: {size} bytes; proved in {proved:?}, checked in {checked:?}");
    }
    println!("{count} certificates, {bytes} bytes; proved in {prove:?}, checked in {check:?}");
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
    assert!(count >= 60, "only {count} certificates");
}
