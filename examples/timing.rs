//! times
fn main() {
    for path in std::env::args().skip(1) {
        let Ok(case) = secant::case::Case::read(std::path::Path::new(&path)) else { continue };
        let t = std::time::Instant::now();
        let c = secant::shape::contraction(&case.shape, |_| false);
        let t1 = t.elapsed();
        let info = if let secant::shape::Contraction::Proved(p) = &c {
            format!(
                "len {} words {} c {:.3}",
                p.length,
                p.codes.iter().map(Vec::len).sum::<usize>(),
                secant::arith::to_f64(&p.constant)
            )
        } else {
            String::new()
        };
        let r = secant::theorem::certify(&case.shape, &case.examine);
        println!(
            "{:>8.1?} {:>8.1?} {} {info} {}",
            t1,
            t.elapsed() - t1,
            path,
            r.map(|r| r.verdict.word().to_owned()).unwrap_or_else(|e| e.to_string())
        );
    }
}
