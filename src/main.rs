//! The program `secant`; everything is in the library's `cli`.

fn main() -> std::process::ExitCode {
    secant::cli::main()
}
