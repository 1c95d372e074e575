//! `genga recipe`: prints the commented default recipe.

use clap::Args;

use crate::failure::Failure;
use crate::files;
use genga::edits::Edits;
use genga::recipe::Recipe;
use genga_lab::study;

#[derive(Debug, Args)]
pub(super) struct RecipeArgs {
    /// Print the recipe of Table 1 of the first paper instead.
    #[arg(long)]
    study: bool,
}

pub(super) fn run(args: &RecipeArgs) -> Result<(), Failure> {
    let recipe = if args.study { study::table_1_recipe() } else { Recipe::default() };
    files::to_stdout(recipe.write(&Edits::default()).as_bytes())
}
