//! Giving up: long work looks now and then whether somebody wants it to stop.
//!
//! Work that is stopped has no result: it unwinds to the caller of [`stoppable`], so that nothing half-done is seen.

use std::cell::RefCell;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

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
