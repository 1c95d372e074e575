//! Completions and the manual page, made from the definition that parses the arguments.

use clap::Command;

use crate::failure::Failure;
use crate::files;

/// Prints completions for a shell. They are made in memory first: writing them straight to a closed pipe would panic.
pub(super) fn completions(
    shell: clap_complete::Shell,
    mut program: Command,
) -> Result<(), Failure> {
    let mut page = Vec::new();
    clap_complete::generate(shell, &mut program, "genga", &mut page);
    files::to_stdout(&page)
}

/// Prints the manual page, followed by a page for each command.
pub(super) fn man(mut program: Command) -> Result<(), Failure> {
    program.build();
    let commands =
        program.get_subcommands().filter(|command| command.get_name() != "help").cloned();
    let mut page = Vec::new();
    for command in std::iter::once(program.clone()).chain(commands) {
        clap_mangen::Man::new(command)
            .render(&mut page)
            .map_err(|error| Failure::CouldNot(error.to_string()))?;
    }
    files::to_stdout(&page)
}
