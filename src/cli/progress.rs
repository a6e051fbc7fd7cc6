//! Progress on the standard error, for people, on anything that takes more than a second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long it takes until progress is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar over a number of cases.
pub struct Progress {
    bar: ProgressBar,
    begun: Instant,
    quiet: bool,
}

impl Progress {
    /// A bar of `count` cases, not shown yet; never shown when `quiet`, or where the standard error is no terminal.
    pub fn new(count: usize, quiet: bool) -> Self {
        Self::of(count, "cases", quiet)
    }

    /// A bar of `count` things of a kind; 0: it is not known how many.
    pub fn of(count: usize, what: &str, quiet: bool) -> Self {
        let length = u64::try_from(count).ok().filter(|n| *n > 0);
        let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::hidden());
        let template = match length {
            Some(_) => format!("  {{bar:40}} {{pos}}/{{len}} {what}, {{elapsed}}"),
            None => format!("  {{spinner}} {{pos}} {what}, {{elapsed}}"),
        };
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        Self { bar, begun: Instant::now(), quiet }
    }

    /// One case is done.
    pub fn step(&self) {
        self.advance(1);
    }

    /// Several are done.
    pub fn advance(&self, count: usize) {
        if !self.quiet && self.bar.is_hidden() && self.begun.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.inc(count as u64);
    }

    /// All are done.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A sign of life while one case is certified.
pub struct Waiting {
    done: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Waiting {
    /// Starts waiting for a certificate.
    pub fn new(quiet: bool) -> Self {
        Self::with("certifying …", quiet)
    }

    /// Starts waiting for what the message says.
    pub fn with(message: &'static str, quiet: bool) -> Self {
        use std::io::IsTerminal;
        if quiet || !std::io::stderr().is_terminal() {
            return Self { done: None };
        }
        let (sender, receiver) = channel::<()>();
        let thread = std::thread::spawn(move || {
            if receiver.recv_timeout(PATIENCE).is_ok() {
                return;
            }
            let spinner = ProgressBar::new_spinner().with_message(message);
            spinner.enable_steady_tick(Duration::from_millis(120));
            // An error means that the sender is gone, which ends the waiting as well.
            let _ = receiver.recv();
            spinner.finish_and_clear();
        });
        Self { done: Some((sender, thread)) }
    }

    /// The case is done.
    pub fn finish(self) {
        if let Some((sender, thread)) = self.done {
            let _ = sender.send(());
            let _ = thread.join();
        }
    }
}
