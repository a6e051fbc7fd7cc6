//! The laws of verdicts on random shapes of all kinds: with a fixed budget here, with a larger one in
//! `SECANT_STRESS=200 cargo test --release --test verdict_laws` and in `secant fuzz`.
#![cfg(feature = "strategies")]

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use secant::jordan::Spectrum;
use secant::laws::{Law, hold};
use secant::scheme::{Heading, case_text};
use secant::shape::Shape;
use secant::strategies::{AutomatonOptions, automaton, mask, plane_set, planted_jordan};

/// How often a strategy is asked: `SECANT_STRESS` times as often as usual.
fn runner(cases: u32, seed: u8) -> TestRunner {
    let stress = std::env::var("SECANT_STRESS").ok().map(|s| s.parse::<u32>().expect("SECANT_STRESS is a number"));
    let config = Config { cases: cases * stress.unwrap_or(1), failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

fn keeps(shape: &Shape) -> Result<(), TestCaseError> {
    match hold(shape, &Law::ALL, 11) {
        Ok(_) => Ok(()),
        Err(broken) => {
            let heading = Heading { name: "broken".to_owned(), ..Heading::default() };
            Err(TestCaseError::fail(format!("{broken}\n{}", case_text(shape, &heading))))
        }
    }
}

fn run<S: Strategy>(cases: u32, seed: u8, strategy: &S, test: impl Fn(S::Value) -> Result<(), TestCaseError>) {
    if let Err(failure) = runner(cases, seed).run(strategy, test) {
        panic!("{failure}");
    }
}

#[test]
fn curves_of_one_state_keep_the_laws() {
    let options =
        AutomatonOptions { states: 1..=1, dimensions: 2..=2, transient: false, ..AutomatonOptions::default() };
    run(8, 1, &automaton(options), |shape| keeps(&shape));
}

#[test]
fn automata_keep_the_laws() {
    run(8, 2, &automaton(AutomatonOptions::default()), |shape| keeps(&shape));
}

#[test]
fn sets_keep_the_laws() {
    run(8, 3, &plane_set(), |shape| keeps(&shape));
}

#[test]
fn masks_keep_the_laws() {
    run(4, 4, &mask(4), |plan| match plan.mask().and_then(|m| m.curve()) {
        Ok(shape) => keeps(&shape),
        Err(_) => Ok(()),
    });
}

#[test]
fn planted_jordan_blocks_are_found() {
    run(48, 5, &planted_jordan(3), |plan| {
        let spectrum = Spectrum::of(&plan.matrix);
        for (poly, blocks) in &plan.blocks {
            let factor = spectrum.factors.iter().find(|f| f.poly == *poly);
            prop_assert_eq!(factor.map(|f| &f.blocks), Some(blocks));
        }
        prop_assert_eq!(spectrum.factors.len(), plan.blocks.len());
        Ok(())
    });
}
