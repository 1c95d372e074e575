//! `genga recipe`: the commented default recipe.

use clap::Args;

use crate::cli::failure::Failure;
use crate::cli::files;
use crate::edits::Edits;
use crate::recipe::Recipe;
use crate::study;

#[derive(Debug, Args)]
pub(super) struct RecipeArgs {
    /// The settings of the first paper's Table 1 instead.
    #[arg(long)]
    study: bool,
}

pub(super) fn run(args: &RecipeArgs) -> Result<(), Failure> {
    let recipe = if args.study { study::table_1_recipe() } else { Recipe::default() };
    files::to_stdout(recipe.write(&Edits::default()).as_bytes())
}
