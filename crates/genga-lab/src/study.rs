//! **Study** (調べる): one or two settings varied over a clip, with the counts in each cell. With `union`, this is the
//! study of the first paper [KT11 Table 1].
//!
//! An [`Axis`] is a setting with its values, a [`Study`] runs the chain for every pair of them, and a [`Grid`] holds
//! the counts.

mod axis;
mod grid;
mod measure;
mod noise;
mod plateau;
mod range;
mod seconds;
mod steadiness;
mod sweep;

#[cfg(test)]
mod tests;

use genga::keys::Merge;
use genga::recipe::Recipe;
use genga::signal::{Reading, Steady, Turn, TurnKind};
use genga::time::Frame;

pub use axis::{Axis, Setting};
pub use grid::{Cell, Grid, Spread, spreads};
pub use measure::Measure;
pub use noise::Noise;
pub use plateau::Plateau;
pub use steadiness::{Steadiness, steadiness};
pub use sweep::{Study, Walk};

/// Returns the recipe of a Table 1 study: the paper to the letter, with the dead band of 0.03 °/frame² at 100 fps (300
/// °/s²) that its counts imply.
pub fn table_1_recipe() -> Recipe {
    let mut recipe = Recipe::default();
    recipe.turns.reading = Reading::Literal;
    recipe.turns.steady = Steady::Acceleration(300.0);
    // In the paper the turns of joints are the keys, and their number is unlimited.
    recipe.keys.merge = Merge::Union;
    recipe.keys.per_second = f64::INFINITY;
    recipe
}

/// Whether axes are those of Table 1: filter width and persistence, in either order.
pub fn is_table_1(x: &Axis, y: Option<&Axis>) -> bool {
    let names = [Some(x.name()), y.map(Axis::name)];
    let both = [Some("filter.width"), Some("turns.persistence")];
    both.into_iter().all(|name| names.contains(&name))
}

/// Counts keys summed over the joints.
pub fn total(turns: &[Vec<Turn>]) -> usize {
    keys(turns).count()
}

/// Counts distinct frames that are a key of any joint.
pub fn union(turns: &[Vec<Turn>]) -> usize {
    let first = keys(turns).map(|turn| turn.frame).min().unwrap_or(Frame(0)).0;
    let mut is_key = Vec::new();
    for turn in keys(turns) {
        let row = turn.frame.0 - first;
        if row >= is_key.len() {
            is_key.resize(row + 1, false);
        }
        is_key[row] = true;
    }
    is_key.into_iter().filter(|is_key| *is_key).count()
}

/// Counts the keys of each joint.
pub fn of_each(turns: &[Vec<Turn>]) -> Vec<usize> {
    let of_joint = |turns: &Vec<Turn>| keys(std::slice::from_ref(turns)).count();
    turns.iter().map(of_joint).collect()
}

fn keys(turns: &[Vec<Turn>]) -> impl Iterator<Item = &Turn> {
    turns.iter().flatten().filter(|turn| turn.kind == TurnKind::Key)
}
