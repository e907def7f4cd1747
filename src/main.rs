//! The `greyfield` binary: hands the command line to [`greyfield::cli`].
#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    greyfield::cli::main()
}
