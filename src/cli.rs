//! The `genga` program. A command is a file of `commands`: what it takes, and what it does. What several of them
//! share stands beside.
//!
//! ```text
//! commands    the commands, a file each
//! asked       the command line, and what to type where it was not understood
//! batch       many clips at once: which, who works on them, what is finished
//! clip        the motion: which, which part of it, and how it is read
//! corrections the recipe, and what a person corrects
//! pins        keys that are marked in a file
//! seen        from where movement is measured
//! plan        all of these together, and what the sheet is to be
//! formats     the formats that are asked for, and their files
//! results     what a run writes into its folder
//! paths       what a path means, and which must not be written to
//! files       reading, and writing whole or not at all
//! staging     files that take their places together
//! folder      a results folder: which of its files are of the run before, and which a person changed
//! stop        Ctrl-C: nothing unfinished is left
//! words       what a person is told, tables among it
//! failure     why the program stops, and its exit code
//! ```

mod asked;
mod batch;
mod clip;
mod commands;
mod corrections;
mod failure;
mod files;
mod folder;
mod formats;
mod frozen;
mod paths;
mod pins;
mod plan;
mod results;
mod seen;
mod staging;
mod stop;
mod words;

use std::process::ExitCode;

use failure::Failure;
use words::Words;

#[cfg(feature = "studio-files")]
pub use commands::Disk;

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let args = asked::args();
    let words = Words::new(args.quiet);
    match args.run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader has what it wanted.
        Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            words.error(&failure);
            ExitCode::from(failure.code())
        }
    }
}
