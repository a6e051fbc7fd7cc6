//! Giving up: long work looks now and then whether somebody wants it to stop.
//!
//! Work that is stopped has no result: it unwinds to the caller of [`stoppable`], so that nothing half-done is seen.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::{Duration, Instant};

thread_local! {
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// What the unwinding of stopped work carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

/// The flag that was there before is put back, also when the work unwinds.
struct Restore(Option<Arc<AtomicBool>>);

impl Drop for Restore {
    fn drop(&mut self) {
        let before = self.0.take();
        FLAG.with(|flag| *flag.borrow_mut() = before);
    }
}

/// Does a piece of work that stops soon after `flag` is set, by unwinding with [`Stopped`] (see `secant::guard`).
///
/// ```
/// use secant_exact::stop::{Stopped, check, stoppable};
/// use std::sync::{Arc, atomic::AtomicBool};
/// let set = Arc::new(AtomicBool::new(true));
/// let ended = std::panic::catch_unwind(|| stoppable(Some(set), check));
/// assert_eq!(ended.unwrap_err().downcast_ref(), Some(&Stopped));
/// ```
pub fn stoppable<T>(flag: Option<Arc<AtomicBool>>, work: impl FnOnce() -> T) -> T {
    let _restore = Restore(FLAG.with(|own| own.replace(flag)));
    work()
}

/// The flag of the work that this thread does, to be handed to other threads that do a part of it.
#[must_use]
pub fn flag() -> Option<Arc<AtomicBool>> {
    FLAG.with(|flag| flag.borrow().clone())
}

/// Called in long loops: unwinds where the work is to stop, without the message of a panic.
pub fn check() {
    let set = FLAG.with(|flag| flag.borrow().as_ref().is_some_and(|f| f.load(Ordering::Relaxed)));
    if set {
        resume_unwind(Box::new(Stopped));
    }
}

/// How often the clock of [`within`] is looked at.
const TICK: Duration = Duration::from_millis(20);

/// Does a piece of work that must be done within a time; `None` where it was not. What stops the work around it stops it too.
///
/// The work must leave nothing half-done that others see.
///
/// ```
/// use secant_exact::stop::{check, within};
/// use std::time::Duration;
/// assert_eq!(within(Duration::from_secs(60), || 7), Some(7));
/// let found: Option<()> = within(Duration::from_millis(1), || loop { check() });
/// assert_eq!(found, None);
/// ```
pub fn within<T>(time: Duration, work: impl FnOnce() -> T) -> Option<T> {
    let (own, outer) = (Arc::new(AtomicBool::new(false)), flag());
    let (late, around) = (Arc::clone(&own), outer.clone());
    let (done, wait) = mpsc::channel::<()>();
    let begun = Instant::now();
    let clock = move || {
        let told = || around.as_ref().is_some_and(|f| f.load(Ordering::Relaxed));
        while begun.elapsed() < time && !told() {
            let rest = time.saturating_sub(begun.elapsed()).min(TICK);
            if wait.recv_timeout(rest) != Err(mpsc::RecvTimeoutError::Timeout) {
                return;
            }
        }
        late.store(true, Ordering::Relaxed);
    };
    thread::spawn(clock);
    let found = catch_unwind(AssertUnwindSafe(|| stoppable(Some(own), work)));
    drop(done);
    match found {
        Ok(value) => Some(value),
        Err(payload) if payload.is::<Stopped>() && !outer.is_some_and(|f| f.load(Ordering::Relaxed)) => None,
        Err(payload) => resume_unwind(payload),
    }
}
