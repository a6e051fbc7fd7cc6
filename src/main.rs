//! The program `secant`; everything is in the library's `cli`.

/// Proofs are many small numbers: a third of the time went into the allocator of the C library.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    secant::cli::main()
}
