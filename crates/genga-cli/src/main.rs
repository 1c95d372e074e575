//! The `genga` program: parse, run, one exit mapping.

use std::process::ExitCode;

fn main() -> ExitCode {
    genga_cli::main()
}
