//! `secant studio`: a page on this machine to play on. The page draws; what it shows was asked of the library by the server
//! here, through the same door as everything else ([`crate::ask`], [`crate::prove()`]).
//!
//! The server listens on the loopback address only, answers only to whom knows the random token in the address, and reads no
//! file: what the page sends is text, and what it gets is text.

mod answer;
mod catalogue;
mod door;
mod drawing;
mod input;
mod region;
mod server;
mod work;

pub use server::Studio;
