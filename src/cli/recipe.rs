//! `genga recipe`: the commented default recipe.

use super::args::RecipeArgs;
use super::failure::Failure;
use super::io;
use crate::edits::Edits;
use crate::recipe::Recipe;
use crate::study;

pub(super) fn run(args: &RecipeArgs) -> Result<(), Failure> {
    let recipe = if args.study { study::table_1_recipe() } else { Recipe::default() };
    io::to_stdout(recipe.write(&Edits::default()).as_bytes())
}
