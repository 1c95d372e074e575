//! The `genga` program. Each command is a file of `commands`: its arguments, and what it does. The modules beside it
//! are shared by several commands.
//!
//! ```text
//! commands    the commands, a file each
//! arguments   parses the command line and suggests corrections
//! batch       many clips at once: the list, the workers, the journal
//! clip        the motion: which clip, which part of it, and how it is read
//! corrections the recipe and a person's corrections
//! pins        keys that are marked in a file, and which of them are pinned
//! seen        the camera in which movement is measured
//! plan        all of these together, and the targets of the sheet
//! formats     the output formats and their files
//! results     what a run writes into its folder
//! paths       the meaning of paths, and which must not be overwritten
//! files       reading, and writing whole files or none
//! staging     files that take their places together
//! folder      a results folder: files of the previous run, and those that a person changed
//! stop        Ctrl-C: removes unfinished files
//! console     messages and tables for people
//! failure     why the program stops, and its exit code
//! ```

mod arguments;
mod batch;
mod camera_args;
mod clip;
mod commands;
mod console;
mod corrections;
mod cut_args;
mod earlier_settings;
mod failure;
mod files;
mod folder;
mod format_args;
mod found_settings;
mod freeze_args;
mod headings;
mod into_args;
mod kept;
mod listed;
mod look_args;
mod marked_keys;
mod numbers;
mod outcomes;
mod part_of_take;
mod paths;
mod pin_args;
mod plan;
mod results;
mod several;
mod sheets;
mod shell;
mod staging;
mod stop;
mod whose_corrections;

use std::process::ExitCode;

use console::Words;
use failure::Failure;

#[cfg(feature = "studio-files")]
pub use commands::Disk;

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let args = arguments::args();
    let words = Words::new(args.quiet);
    match args.run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader closed the pipe: it has what it wanted.
        Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            words.error(&failure);
            ExitCode::from(failure.code())
        }
    }
}
