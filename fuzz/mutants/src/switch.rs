//! The switches of the mutants: one of them is on, by the environment variable `SECANT_MUTANT`.
//!
//! With `SECANT_MUTANT_TRACE=FILE` the number of each switch that is reached is written to the file, once.
#![allow(missing_docs, clippy::all, clippy::disallowed_methods)]

use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};

static ON: LazyLock<u32> =
    LazyLock::new(|| std::env::var("SECANT_MUTANT").ok().and_then(|t| t.parse().ok()).unwrap_or(0));
static TRACE: LazyLock<Option<String>> = LazyLock::new(|| std::env::var("SECANT_MUTANT_TRACE").ok());
static REACHED: [AtomicBool; 16384] = [const { AtomicBool::new(false) }; 16384];

#[inline]
pub fn on(id: u32) -> bool {
    if TRACE.is_some() {
        reached(id);
    }
    *ON == id
}

#[cold]
fn reached(id: u32) {
    use std::io::Write;
    if let Some(path) = &*TRACE
        && !REACHED[id as usize].swap(true, Ordering::Relaxed)
        && let Ok(mut file) = std::fs::OpenOptions::new().append(true).create(true).open(path)
    {
        let _ = file.write_all(format!("{id}\n").as_bytes());
    }
}

pub fn lt<A: PartialOrd<B> + ?Sized, B: ?Sized>(id: u32, a: &A, b: &B) -> bool {
    if on(id) { a <= b } else { a < b }
}
pub fn le<A: PartialOrd<B> + ?Sized, B: ?Sized>(id: u32, a: &A, b: &B) -> bool {
    if on(id) { a < b } else { a <= b }
}
pub fn gt<A: PartialOrd<B> + ?Sized, B: ?Sized>(id: u32, a: &A, b: &B) -> bool {
    if on(id) { a >= b } else { a > b }
}
pub fn ge<A: PartialOrd<B> + ?Sized, B: ?Sized>(id: u32, a: &A, b: &B) -> bool {
    if on(id) { a > b } else { a >= b }
}
pub fn eq<A: PartialEq<B> + ?Sized, B: ?Sized>(id: u32, a: &A, b: &B) -> bool {
    on(id) != (a == b)
}
pub fn ne<A: PartialEq<B> + ?Sized, B: ?Sized>(id: u32, a: &A, b: &B) -> bool {
    on(id) != (a != b)
}
pub fn flag(id: u32, value: bool) -> bool {
    on(id) != value
}

pub trait Flip {
    fn flip(self) -> bool;
}
impl Flip for bool {
    fn flip(self) -> bool {
        !self
    }
}
impl Flip for &bool {
    fn flip(self) -> bool {
        !*self
    }
}
pub fn not<T: Flip>(id: u32, x: T) -> bool {
    on(id) != x.flip()
}

pub trait Small: Sized {
    fn next(self) -> Self;
}
macro_rules! small {
    ($($t:ty)*) => { $(impl Small for $t { fn next(self) -> Self { self + 1 } })* };
}
small!(u8 u16 u32 u64 u128 usize i8 i16 i32 i64 i128 isize);
#[inline]
pub fn int<T: Small>(id: u32, x: T) -> T {
    if on(id) { x.next() } else { x }
}

pub trait OrdPick: Ord + Sized {
    fn mutant_min(self, id: u32, other: Self) -> Self {
        if on(id) { Ord::max(self, other) } else { Ord::min(self, other) }
    }
    fn mutant_max(self, id: u32, other: Self) -> Self {
        if on(id) { Ord::min(self, other) } else { Ord::max(self, other) }
    }
}
impl<T: Ord> OrdPick for T {}
pub trait FloatPick {
    fn mutant_min(self, id: u32, other: f64) -> f64;
    fn mutant_max(self, id: u32, other: f64) -> f64;
}
impl FloatPick for f64 {
    fn mutant_min(self, id: u32, other: f64) -> f64 {
        if on(id) { f64::max(self, other) } else { f64::min(self, other) }
    }
    fn mutant_max(self, id: u32, other: f64) -> f64 {
        if on(id) { f64::min(self, other) } else { f64::max(self, other) }
    }
}
