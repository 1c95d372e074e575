//! From where movement is measured, on the command line.

use clap::Args;

/// From where movement is measured, over the recipe.
#[derive(Debug, Default, Args)]
pub(in crate::cli) struct SeenArgs {
    /// Measure movement on the screen (画面) of a camera instead of in the world: from front, side, three-quarter or
    /// auto (where most is seen); from a place, X,Y,Z:X,Y,Z (where it stands and what it looks at, in the
    /// file's unit); or of the first camera of a .glb or .gltf file, or the one named behind it:
    /// --seen-from cut.glb:Camera.001
    #[arg(long, value_name = "WORD|PLACE|FILE[:NAME]", allow_hyphen_values = true)]
    pub(in crate::cli) seen_from: Option<String>,
}
