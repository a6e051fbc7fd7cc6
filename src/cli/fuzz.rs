//! `secant fuzz`: the laws of verdicts on random shapes, from the command line.

use super::output::{complain, print};
use super::progress::Progress;
use super::{BAD_INPUT, PROVED, REFUTED};
use crate::case::VertexCase;
use crate::certificate::{Doubt, confirm_vertices};
use crate::diagnostic::Problem;
use crate::jordan::Spectrum;
use crate::laws::{Broken, Law, Tally, hold};
use crate::scheme::{Heading, case_text};
use crate::shape::Shape;
use crate::strategies::{
    AutomatonOptions, PlantedJordan, VertexPlan, automaton, mask, plane_set, planted_jordan, vertex_weights,
};
use clap::{Args, ValueEnum};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use std::cell::RefCell;

/// What is fuzzed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FuzzKind {
    /// Curves of one state in the plane.
    Curve,
    /// Automata of curves in spaces of several dimensions, with reversed, singular and transient parts and control points.
    Automaton,
    /// Sets of the plane, some seen through a projection.
    Set,
    /// The curves of binary masks with sum rules.
    Mask,
    /// Mesh rules with random weights at vertices: the checker confirms what is decided.
    Vertex,
    /// Column-stochastic matrices with a planted Jordan structure.
    Matrix,
}

/// What `secant fuzz` is asked.
#[derive(Debug, Args)]
pub struct FuzzArgs {
    /// What is fuzzed.
    #[arg(long, value_enum, default_value_t = FuzzKind::Automaton)]
    kind: FuzzKind,
    /// How many random cases.
    #[arg(long, default_value_t = 100)]
    count: u32,
    /// The seed; the same one gives the same cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only these laws, as in `--laws scaled,reversed`; by default all.
    #[arg(long, value_delimiter = ',', value_name = "LAW")]
    laws: Vec<String>,
    /// Print nothing but a failing case.
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// List the answers that only one of two equal cases got.
    #[arg(short, long)]
    verbose: bool,
}

/// What was seen so far.
#[derive(Default)]
struct Seen {
    cases: usize,
    refused: usize,
    tally: Tally,
}

/// Runs the command: exit code 0 where every law holds, 1 with the simplest failing case otherwise.
pub fn run(args: &FuzzArgs) -> u8 {
    let laws = match chosen(&args.laws) {
        Ok(laws) => laws,
        Err(problem) => {
            complain(&problem);
            return BAD_INPUT;
        }
    };
    let fuzz = Fuzz { args, laws, seen: RefCell::default(), progress: Progress::new(args.count as usize, args.quiet) };
    let curve = AutomatonOptions { states: 1..=1, dimensions: 2..=2, transient: false, ..AutomatonOptions::default() };
    let shapes = |shape: &Shape| fuzz.shape(shape);
    let failure = match args.kind {
        FuzzKind::Curve => fuzz.search(&automaton(curve), shapes, written),
        FuzzKind::Automaton => fuzz.search(&automaton(AutomatonOptions::default()), shapes, written),
        FuzzKind::Set => fuzz.search(&plane_set(), shapes, written),
        FuzzKind::Mask => {
            let curve = mask(4).prop_filter_map("no curve", |plan| plan.mask().and_then(|m| m.curve()).ok());
            fuzz.search(&curve, shapes, written)
        }
        FuzzKind::Vertex => fuzz.search(&vertex_weights(12), |plan| fuzz.vertex(plan), VertexPlan::case),
        FuzzKind::Matrix => fuzz.search(&planted_jordan(4), |plan| fuzz.matrix(plan), matrix_text),
    };
    fuzz.progress.finish();
    fuzz.report(failure)
}

fn chosen(names: &[String]) -> Result<Vec<Law>, Problem> {
    if names.is_empty() {
        return Ok(Law::ALL.to_vec());
    }
    let name = |law: Law| format!("{law:?}").to_lowercase();
    names
        .iter()
        .map(|wanted| {
            Law::ALL.into_iter().find(|law| name(*law) == wanted.to_lowercase()).ok_or_else(|| {
                let known: Vec<String> = Law::ALL.into_iter().map(name).collect();
                Problem::new("secant::fuzz::law", format!("there is no law `{wanted}`"))
                    .with_help(format!("the laws are {}", known.join(", ")))
            })
        })
        .collect()
}

struct Fuzz<'a> {
    args: &'a FuzzArgs,
    laws: Vec<Law>,
    seen: RefCell<Seen>,
    progress: Progress,
}

impl Fuzz<'_> {
    /// Asks the strategy for cases until one breaks a law; the simplest failing case as a text, with what it breaks.
    fn search<S: Strategy>(
        &self,
        strategy: &S,
        test: impl Fn(&S::Value) -> Result<(), String>,
        text: impl Fn(&S::Value) -> String,
    ) -> Option<(String, String)> {
        let config = Config { cases: self.args.count, failure_persistence: None, ..Config::default() };
        let mut seed = [0; 32];
        seed[..8].copy_from_slice(&self.args.seed.to_le_bytes());
        let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &seed));
        let run = runner.run(strategy, |value| {
            self.progress.step();
            self.seen.borrow_mut().cases += 1;
            test(&value).map_err(TestCaseError::fail)
        });
        match run {
            Ok(()) => None,
            Err(TestError::Fail(reason, value)) => Some((reason.to_string(), text(&value))),
            Err(TestError::Abort(reason)) => Some((format!("the search was given up: {reason}"), String::new())),
        }
    }

    fn shape(&self, shape: &Shape) -> Result<(), String> {
        match hold(shape, &self.laws, self.args.seed) {
            Ok(Some(tally)) => {
                let mut seen = self.seen.borrow_mut();
                seen.tally.compared += tally.compared;
                seen.tally.lost.extend(tally.lost);
                Ok(())
            }
            Ok(None) => {
                self.seen.borrow_mut().refused += 1;
                Ok(())
            }
            Err(Broken { law, what }) => Err(format!("{}: {what}", law.words())),
        }
    }

    /// The checker accepts what is decided at a vertex.
    fn vertex(&self, plan: &VertexPlan) -> Result<(), String> {
        let case = VertexCase::parse("fuzz.toml", &plan.case()).map_err(|p| p.to_string())?;
        let mut found = [crate::vertex::at_valence(&case.rule, plan.valence).map_err(|e| e.to_string())?];
        match confirm_vertices(&case, &mut found) {
            Ok(_) => self.seen.borrow_mut().tally.compared += 1,
            Err(Doubt::Unsupported(_)) => {}
            Err(doubt) => return Err(doubt.to_string()),
        }
        Ok(())
    }

    fn matrix(&self, plan: &PlantedJordan) -> Result<(), String> {
        let spectrum = Spectrum::of(&plan.matrix);
        for (poly, blocks) in &plan.blocks {
            let found = spectrum.factors.iter().find(|f| f.poly == *poly).map(|f| &f.blocks);
            if found != Some(blocks) {
                return Err(format!("the factor {poly:?} has blocks {blocks:?}, found were {found:?}"));
            }
            self.seen.borrow_mut().tally.compared += 1;
        }
        Ok(())
    }

    fn report(&self, failure: Option<(String, String)>) -> u8 {
        let seen = self.seen.borrow();
        if let Some((reason, text)) = failure {
            print(&text);
            complain(&Problem::new("secant::fuzz::broken", reason).with_help("the simplest failing case was printed"));
            return REFUTED;
        }
        if !self.args.quiet {
            let (cases, refused, compared) = (seen.cases, seen.refused, seen.tally.compared);
            print(&format!(
                "{cases} cases, {refused} of them no models; {compared} answers compared, none contradicts\n"
            ));
            for law in &self.laws {
                let lost = seen.tally.lost.iter().filter(|(l, _)| l == law).count();
                if lost > 0 {
                    print(&format!("  {}: {lost} answers given by one side only\n", law.words()));
                }
            }
            if self.args.verbose {
                for (law, what) in &seen.tally.lost {
                    print(&format!("  {}: {what}\n", law.words()));
                }
            }
        }
        PROVED
    }
}

fn written(shape: &Shape) -> String {
    case_text(shape, &Heading { name: "broken".to_owned(), ..Heading::default() })
}

fn matrix_text(plan: &PlantedJordan) -> String {
    let m = &plan.matrix;
    let rows = (0..m.rows()).map(|i| m.row(i).iter().map(ToString::to_string).collect::<Vec<_>>().join(" "));
    format!("{}\n{}\n", m.rows(), rows.collect::<Vec<_>>().join("\n"))
}
