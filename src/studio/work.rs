//! Work in threads of its own: within a time, a few at once, stopped when nobody waits for it any more.

use super::answer::Kept;
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::stop::stoppable;
use std::collections::{BTreeMap, VecDeque};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::{Semaphore, oneshot};
use tokio::time::timeout;

/// Answers that are kept for the files that the page may ask for.
const KEPT: usize = 8;
/// The stack of a thread; recursion over words is deep in some searches.
const STACK: usize = 64 << 20;
/// Longest name of a page.
const NAME: usize = 64;

/// The work that is going on, and the answers of late.
pub struct Work {
    /// Proofs at once.
    proving: Arc<Semaphore>,
    /// Drawings and files at once.
    light: Arc<Semaphore>,
    /// Searches for regions at once.
    searching: Arc<Semaphore>,
    /// The flag of the proof that each page waits for.
    running: Mutex<BTreeMap<String, Arc<AtomicBool>>>,
    kept: Mutex<(u64, VecDeque<(u64, Arc<Kept>)>)>,
}

/// Which slots a piece of work takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// A drawing, a file.
    Light,
    /// A proof.
    Proof,
    /// A search for the region of a parameter.
    Search,
}

/// Stops its work when it goes out of scope: the answer came, or nobody waits for it.
pub struct Stop {
    flag: Arc<AtomicBool>,
    page: Option<(Arc<Work>, String)>,
}

impl Stop {
    /// The flag of work that no page is waiting for by name.
    pub fn unnamed() -> Self {
        Self { flag: Arc::default(), page: None }
    }
}

impl Drop for Stop {
    fn drop(&mut self) {
        self.flag.store(true, Ordering::Relaxed);
        if let Some((work, page)) = &self.page {
            let mut running = locked(&work.running);
            if running.get(page).is_some_and(|flag| Arc::ptr_eq(flag, &self.flag)) {
                running.remove(page);
            }
        }
    }
}

/// The content of a lock; what is guarded here is whole at every moment, so that a panic elsewhere does no harm.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn problem(code: &str, message: &str, help: &str) -> Problem {
    Problem::new(format!("secant::studio::{code}"), message).with_help(help)
}

impl Work {
    /// No work yet; as many proofs at once as there are processors, two at least.
    pub fn new() -> Self {
        let processors = std::thread::available_parallelism().map_or(2, usize::from).max(2);
        Self {
            proving: Arc::new(Semaphore::new(processors)),
            light: Arc::new(Semaphore::new(processors)),
            searching: Arc::new(Semaphore::new(1)),
            running: Mutex::default(),
            kept: Mutex::default(),
        }
    }

    /// Takes the place of what the page has waited for until now, which is stopped.
    ///
    /// # Errors
    /// A [`Problem`] where the name of the page is no such name.
    pub fn newer(self: &Arc<Self>, page: &str) -> Result<Stop, Problem> {
        if page.is_empty() || page.len() > NAME {
            return Err(problem("page", "this is no name of a page", "reload the page"));
        }
        let flag = Arc::<AtomicBool>::default();
        let before = locked(&self.running).insert(page.to_owned(), Arc::clone(&flag));
        if let Some(before) = before {
            before.store(true, Ordering::Relaxed);
        }
        Ok(Stop { flag, page: Some((Arc::clone(self), page.to_owned())) })
    }

    /// Stops what a page waits for; whether there was anything.
    pub fn stop(&self, page: &str) -> bool {
        locked(&self.running).get(page).map(|flag| flag.store(true, Ordering::Relaxed)).is_some()
    }

    /// Does a piece of work in a thread of its own, within a time.
    ///
    /// # Errors
    /// Its own [`Problem`]; one that says so where it was stopped, took too long, failed, or found no free slot.
    pub async fn run<T: Send + 'static>(
        &self,
        weight: Weight,
        limit: Duration,
        stop: &Stop,
        work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let slots = Arc::clone(match weight {
            Weight::Proof => &self.proving,
            Weight::Light => &self.light,
            Weight::Search => &self.searching,
        });
        let busy = || problem("busy", "too much is asked at once", "wait a moment");
        let slot = timeout(limit, slots.acquire_owned()).await.map_err(|_| busy())?.map_err(|_| busy())?;
        let (tell, told) = oneshot::channel();
        let flag = Arc::clone(&stop.flag);
        let thread = std::thread::Builder::new().name("studio".to_owned()).stack_size(STACK).spawn(move || {
            let found = guarded(|| stoppable(Some(flag), work));
            drop(slot);
            // Nobody waits any more: the answer is not needed.
            let _ = tell.send(found);
        });
        thread.map_err(|_| busy())?;
        match timeout(limit, told).await {
            Ok(Ok(found)) => found,
            Ok(Err(_)) => Err(problem("lost", "the work ended without an answer", "ask again")),
            Err(_) => {
                stop.flag.store(true, Ordering::Relaxed);
                let message = format!("there was no answer within {} seconds", limit.as_secs());
                Err(problem("time", &message, "ask with less effort, or use `secant certify`, which has no such limit"))
            }
        }
    }

    /// Keeps an answer for its files; its number.
    pub fn keep(&self, kept: Arc<Kept>) -> u64 {
        let mut all = locked(&self.kept);
        all.0 += 1;
        let number = all.0;
        all.1.push_back((number, kept));
        while all.1.len() > KEPT {
            all.1.pop_front();
        }
        number
    }

    /// A kept answer.
    pub fn kept(&self, number: u64) -> Option<Arc<Kept>> {
        locked(&self.kept).1.iter().find(|(n, _)| *n == number).map(|(_, kept)| Arc::clone(kept))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<T>(future: impl Future<Output = T>) -> T {
        tokio::runtime::Builder::new_current_thread().enable_time().build().expect("a runtime").block_on(future)
    }

    const LONG: Duration = Duration::from_secs(20);

    fn endless() -> Result<(), Problem> {
        loop {
            crate::stop::check();
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_newer_question_of_a_page_stops_the_older_one_and_no_other() {
        let work = Arc::new(Work::new());
        wait(async {
            let old = work.newer("a").expect("a name");
            let other = work.newer("b").expect("a name");
            let newer = work.newer("a").expect("a name");
            let ended = work.run(Weight::Proof, LONG, &old, endless).await.expect_err("stopped");
            assert_eq!(ended.id(), Problem::STOPPED);
            assert!(work.run(Weight::Proof, LONG, &newer, || Ok(1)).await.is_ok());
            assert!(!other.flag.load(Ordering::Relaxed));
            drop(old);
            assert!(work.stop("a") && work.stop("b") && !work.stop("c"));
            drop((newer, other));
            assert!(locked(&work.running).is_empty());
        });
    }

    #[test]
    fn time_panics_and_names_have_limits() {
        let work = Arc::new(Work::new());
        wait(async {
            let soon = Duration::from_millis(30);
            let late = work.run(Weight::Proof, soon, &Stop::unnamed(), endless).await.expect_err("late");
            assert_eq!(late.id(), "secant::studio::time");
            let broken = work.run::<()>(Weight::Light, LONG, &Stop::unnamed(), || panic!("here")).await;
            assert!(broken.expect_err("a panic").is_internal());
            // The slots of both are free again.
            for _ in 0..64 {
                assert_eq!(work.run(Weight::Proof, LONG, &Stop::unnamed(), || Ok(7)).await.ok(), Some(7));
                assert_eq!(work.run(Weight::Light, LONG, &Stop::unnamed(), || Ok(7)).await.ok(), Some(7));
            }
        });
        assert!(work.newer("").is_err() && work.newer(&"x".repeat(65)).is_err());
    }
}
