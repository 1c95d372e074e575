//! Completions and the manual page, made from the same definition that parses the arguments.

use clap::CommandFactory;

use super::args::Args;
use super::failure::Failure;
use super::io;

/// Completions for a shell. Made in memory first: writing them straight to a closed pipe would panic.
pub(super) fn completions(shell: clap_complete::Shell) -> Result<(), Failure> {
    let mut page = Vec::new();
    clap_complete::generate(shell, &mut Args::command(), "genga", &mut page);
    io::to_stdout(&page)
}

/// The manual page, with a page for each command after it.
pub(super) fn man() -> Result<(), Failure> {
    let mut program = Args::command();
    program.build();
    let commands =
        program.get_subcommands().filter(|command| command.get_name() != "help").cloned();
    let mut page = Vec::new();
    for command in std::iter::once(program.clone()).chain(commands) {
        clap_mangen::Man::new(command)
            .render(&mut page)
            .map_err(|error| Failure::CouldNot(error.to_string()))?;
    }
    io::to_stdout(&page)
}
