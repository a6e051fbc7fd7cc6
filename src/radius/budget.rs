//! How much is tried: every number that limits a search of joint spectral radii, and the counter of what was spent.

use std::cell::Cell;
use std::time::{Duration, Instant};

/// How hard to try. The defaults answer within a few seconds; the same options give the same answer on every machine unless
/// [`Options::time`] cuts the search short.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Longest word of the search; powers of the best words with a short word inserted may become longer.
    pub longest: usize,
    /// Most vertices of a polytope.
    pub vertices: usize,
    /// Largest dimension in which common invariant subspaces are looked for: in large ones that takes long, and the coordinates
    /// that come of it spoil norms.
    pub split: usize,
    /// Relative width of the bounds that is good enough: the search ends when it is reached. 0 goes on until the radius is exact
    /// or the budget is spent.
    pub width: f64,
    /// Work that may be spent, in units of about a nanosecond (a multiplication and an addition of floats is one unit); `None`
    /// for an amount that suits the dimension ([`Options::work_for`]).
    pub work: Option<u64>,
    /// A guard by the clock, for those who cannot wait; an answer that it cut short says so (`--time`).
    pub time: Option<Duration>,
}

impl Default for Options {
    fn default() -> Self {
        Self { longest: 16, vertices: 10_000, split: usize::MAX, width: 1e-11, work: None, time: None }
    }
}

/// Work of one second, for [`Options::within`].
const SECOND: f64 = 1e9;

impl Options {
    /// The work for a dimension: three seconds up to 8, ten from 26 on.
    #[must_use]
    pub fn work_for(&self, dim: usize) -> u64 {
        if let Some(work) = self.work {
            return work;
        }
        let extra = dim.saturating_sub(8).min(18) as u64;
        3_000_000_000 + 400_000_000 * extra
    }

    /// The options for a number of seconds: the work of about that time, and the clock as a guard.
    #[must_use]
    #[allow(clippy::float_arithmetic, reason = "a time, no bound")]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped before")]
    pub fn within(self, seconds: f64) -> Self {
        let seconds = seconds.clamp(0.0, 1e6);
        Self { work: Some((seconds * SECOND) as u64), time: Some(Duration::from_secs_f64(seconds)), ..self }
    }
}

/// What is left to be spent, by a search or a part of it.
#[derive(Debug)]
pub(super) struct Budget<'a> {
    left: Cell<u64>,
    whole: Option<&'a Budget<'a>>,
    deadline: Option<Instant>,
    late: Cell<bool>,
    since: Cell<u64>,
}

/// Work between two looks at the clock.
const TICK: u64 = 2_000_000;

impl<'a> Budget<'a> {
    pub fn new(options: &Options, dim: usize) -> Self {
        let deadline = options.time.and_then(|t| Instant::now().checked_add(t));
        Self {
            left: Cell::new(options.work_for(dim)),
            whole: None,
            deadline,
            late: Cell::new(false),
            since: Cell::new(0),
        }
    }

    /// A part of this budget: at most `work`, which is spent of the whole too.
    pub fn part(&'a self, work: u64) -> Self {
        let left = Cell::new(work.min(self.left()));
        Self { left, whole: Some(self), deadline: None, late: Cell::new(false), since: Cell::new(0) }
    }

    /// What is left.
    pub fn left(&self) -> u64 {
        let outer = self.whole.map_or(u64::MAX, Budget::left);
        if self.late() { 0 } else { self.left.get().min(outer) }
    }

    /// Whether the clock stopped the search.
    pub fn late(&self) -> bool {
        self.whole.map_or_else(|| self.late.get(), Budget::late)
    }

    /// Spends work; false where it was not there, and the caller must stop.
    pub fn spend(&self, work: u64) -> bool {
        crate::stop::check();
        let outer = self.whole.is_none_or(|b| b.spend(work));
        let enough = self.left.get() >= work;
        self.left.set(self.left.get().saturating_sub(work));
        if let Some(deadline) = self.deadline {
            self.since.set(self.since.get().saturating_add(work));
            if self.since.get() >= TICK {
                self.since.set(0);
                self.late.set(self.late.get() || Instant::now() >= deadline);
            }
        }
        outer && enough && !self.late.get()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_spent_of_the_whole() {
        let whole = Budget::new(&Options { work: Some(100), ..Options::default() }, 2);
        {
            let part = whole.part(60);
            assert!(part.spend(50) && !part.spend(20) && part.left() == 0);
        }
        assert_eq!(whole.left(), 30);
        assert_eq!(whole.part(1000).left(), 30);
        assert!(!whole.spend(31) && whole.left() == 0 && !whole.late());
    }

    #[test]
    fn the_clock_is_seen_while_work_is_spent() {
        let guard = Budget::new(&Options { time: Some(Duration::ZERO), ..Options::default() }, 2);
        assert!(!guard.spend(TICK) && guard.late() && guard.left() == 0);
    }
}
