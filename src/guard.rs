//! Defects of the program itself, caught at the door: they cost the one result that they spoil, not all of them.

use crate::diagnostic::Problem;
use crate::stop::Stopped;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a piece of work whose failure must not take anything else with it: a panic becomes a [`Problem`] with the code
/// [`Problem::INTERNAL`], and no result.
///
/// The work must leave nothing half-done that others see; secant's caches are filled by whole entries only. Stack overflow and
/// lack of memory end the process and are not caught.
///
/// # Errors
/// The problem of the work itself, or that of its panic.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, Problem>) -> Result<T, Problem> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| Err(defect(payload.as_ref())))
}

fn defect(payload: &(dyn Any + Send)) -> Problem {
    if payload.is::<Stopped>() {
        return Problem::new(Problem::STOPPED, "stopped before there was a result").with_help("ask again");
    }
    let said = payload.downcast_ref::<&str>().map(|s| (*s).to_owned()).or_else(|| payload.downcast_ref().cloned());
    let said: String = said.unwrap_or_else(|| "no reason was given".to_owned());
    Problem::new(Problem::INTERNAL, format!("internal error, no verdict: {said}"))
        .with_help("this is a mistake in secant: please report it with the case")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_problem_of_its_own() {
        let problem = guarded(|| -> Result<(), Problem> { panic!("at {}", 7) }).expect_err("it panics");
        assert!(problem.is_internal() && problem.message().ends_with("at 7"), "{problem:?}");
        let problem = guarded(|| -> Result<(), Problem> { panic!("plain") }).expect_err("it panics");
        assert!(problem.is_internal() && problem.message().ends_with("plain"), "{problem:?}");
    }

    #[test]
    fn work_that_was_told_to_stop_is_no_defect() {
        let flag = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
        let case = crate::case::Question::ask("four-point").expect("a scheme");
        let proved = || crate::prove(&case, &crate::budget::Budget::default());
        let problem = guarded(|| crate::stop::stoppable(Some(flag), proved)).expect_err("it stops");
        assert!(problem.id() == Problem::STOPPED && !problem.is_internal(), "{problem:?}");
        assert!(guarded(proved).is_ok());
    }

    /// The checker looks at the flag too, and forgets it afterwards.
    #[test]
    fn a_check_that_was_told_to_stop_accepts_nothing() {
        let flag = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        let case = crate::case::Question::ask("four-point").expect("a scheme");
        let mut found = crate::prove(&case, &crate::budget::Budget::default()).expect("a proof");
        let text = crate::prove::unconfirmed(&found).expect("a certificate").text();
        let check = || secant_check::check_while(&case.text().text, &text, crate::stop::check);
        flag.store(true, std::sync::atomic::Ordering::Relaxed);
        let stopped = guarded(|| crate::stop::stoppable(Some(flag.clone()), || Ok(check().is_ok())));
        assert_eq!(stopped.expect_err("it stops").id(), Problem::STOPPED);
        assert!(secant_check::check(&case.text().text, &text).is_ok() && check().is_ok());
        assert!(crate::prove::confirm(&mut found).is_ok());
    }

    #[test]
    fn everything_else_passes() {
        assert_eq!(guarded(|| Ok(3)).ok(), Some(3));
        let problem = guarded(|| -> Result<(), _> { Err(Problem::new("secant::case::sum", "no")) });
        assert!(problem.is_err_and(|p| !p.is_internal() && p.id() == "secant::case::sum"));
    }
}
