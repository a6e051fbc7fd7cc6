//! Whole verdicts: curves of high degree, of many pieces and of many states, a patch, vertices of high valence.

use criterion::{Criterion, criterion_group, criterion_main};
use secant::arith::{Rational, ratio};
use secant::case::{Question, Valences};
use secant::linalg::Matrix;
use secant::prelude::*;
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

/// Corner cutting with 64 different parameters in turn.
fn states() -> String {
    let mut text = "name = \"states\"\nconvention = \"columns\"\nstart = \"s0\"\n".to_owned();
    for k in 0..64 {
        // a = 1/4 + k/1280.
        let (a, rest) = (320 + k, 960 - k);
        let q = |n: i32| format!("\"{n}/1280\"");
        let (a, rest) = (q(a), q(rest));
        let next = (k + 1) % 64;
        let first = format!("[[{rest}, {a}, 0], [{a}, {rest}, {rest}], [0, 0, {a}]]");
        let second = format!("[[{a}, 0, 0], [{rest}, {rest}, {a}], [0, {a}, {rest}]]");
        write!(text, "[[state]]\nname = \"s{k}\"\n").expect("a string");
        for matrix in [first, second] {
            write!(text, "[[state.piece]]\nto = \"s{next}\"\nmatrix = {matrix}\n").expect("a string");
        }
    }
    text
}

/// 64 pieces: the words of six letters of a corner cutting scheme with other weights in each letter.
fn words() -> String {
    let weights = [3, 4, 5, 4, 3, 5];
    let mut pieces = vec![Matrix::identity(3)];
    for weight in weights {
        let (a, r, zero) = (ratio(weight, 17), ratio(17 - weight, 17), ratio(0, 1));
        let row = |entries: [&Rational; 3]| entries.map(Rational::clone).to_vec();
        let first = vec![row([&r, &a, &zero]), row([&a, &r, &r]), row([&zero, &zero, &a])];
        let second = vec![row([&a, &zero, &zero]), row([&r, &r, &a]), row([&zero, &a, &r])];
        let letters = [first, second].map(|rows| Matrix::from_rows(3, rows));
        pieces = pieces.iter().flat_map(|word| letters.iter().map(move |letter| word * letter)).collect();
    }
    let line = |m: &Matrix, i: usize| {
        let entries: Vec<String> = m.row(i).iter().map(|x| format!("\"{x}\"")).collect();
        format!("[{}]", entries.join(", "))
    };
    let matrix = |m: &Matrix| format!("[{}]", (0..3).map(|i| line(m, i)).collect::<Vec<_>>().join(", "));
    let list: Vec<String> = pieces.iter().map(matrix).collect();
    format!("name = \"words\"\nconvention = \"columns\"\npieces = [\n{}\n]\n", list.join(",\n"))
}

fn case(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name)
}

fn group(c: &mut Criterion, title: &str, questions: Vec<(&str, Question)>) {
    let mut group = c.benchmark_group(title);
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for (name, question) in &questions {
        group.bench_function(*name, |b| b.iter(|| black_box(prove(question, &Budget::default()).expect("an answer"))));
    }
    group.finish();
}

fn benches(c: &mut Criterion) {
    let named = |text: &'static str| (text, Question::ask(text).expect("a scheme"));
    let curves = [
        "bspline degree=15",
        "bspline degree=25",
        "dubuc-deslauriers points=8",
        "dubuc-deslauriers points=12",
        "dubuc-deslauriers points=16",
        "bspline degree=3 arity=64",
        "corner-cutting a=-1/4 b=1/2",
    ];
    let mut list: Vec<_> = curves.into_iter().map(named).collect();
    list.push(("64 words", Question::parse("words", &words()).expect("a case")));
    list.push(("64 states", Question::parse("states", &states()).expect("a case")));
    group(c, "curves", list);
    let read = |name: &str| Question::read(&case(name)).expect("a case");
    group(
        c,
        "patches",
        vec![
            ("Catmull–Clark, valence 5", read("faces/catmull-clark-5.toml")),
            ("bicubic", read("surfaces/bicubic-space.toml")),
            ("four-point ⊗ four-point", read("surfaces/four-point-product.toml")),
        ],
    );
    let vertex = |name: &str, valences: &str| {
        let valences = Valences::parse(valences).expect("valences");
        Question::at_valences(&case(name).display().to_string(), valences).expect("a case")
    };
    group(
        c,
        "vertices",
        vec![
            ("Doo–Sabin, 200", vertex("surfaces/doo-sabin.toml", "200")),
            ("√3, 200", vertex("surfaces/sqrt3.toml", "200")),
            ("Catmull–Clark, 3..32", vertex("surfaces/catmull-clark.toml", "3..32")),
        ],
    );
}

criterion_group!(certify, benches);
criterion_main!(certify);
