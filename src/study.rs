//! Sweeps over recipes: how many keys a filter width and a persistence leave [KT11 Table 1].

use crate::edits::Edits;
use crate::error::Error;
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::signal::{Reading, Steady, Turn, TurnKind};
use crate::time::{Frame, Span};

/// One cell of the sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyRow {
    /// Filter width.
    pub filter_width: Span,
    /// Persistence.
    pub persistence: Span,
    /// Distinct frames that are a key of any joint: what the paper counts.
    pub union: usize,
    /// Keys summed over the joints.
    pub total: usize,
    /// Keys of the layer.
    pub layer_keys: usize,
}

/// The recipe of a Table 1 study: the paper to the letter, with the dead band of 0.03 °/frame² at
/// 100 fps (300 °/s²) that its counts imply.
pub fn table_1_recipe() -> Recipe {
    let mut recipe = Recipe::default();
    recipe.turns.reading = Reading::Literal;
    recipe.turns.steady = Steady::Acceleration(300.0);
    // The paper knows no limit to what it finds.
    recipe.keys.per_second = f64::INFINITY;
    recipe
}

/// A row for each filter width and persistence, persistence fastest. The forward transform of the
/// speeds is made once, each filter width once.
///
/// # Errors
/// Those of [`Engine::run`].
pub fn sweep(
    engine: &mut Engine,
    recipe: &Recipe,
    filter_widths: &[Span],
    persistences: &[Span],
) -> Result<Vec<StudyRow>, Error> {
    let mut recipe = recipe.clone();
    let mut rows = Vec::with_capacity(filter_widths.len() * persistences.len());
    for &filter_width in filter_widths {
        recipe.filter.width = filter_width;
        for &persistence in persistences {
            recipe.turns.persistence = persistence;
            let (turns, keys) = engine.find_keys(&recipe, &Edits::default())?;
            rows.push(StudyRow {
                filter_width,
                persistence,
                union: union(turns),
                total: total(turns),
                layer_keys: keys.keys.len(),
            });
        }
    }
    Ok(rows)
}

/// Keys summed over the joints.
pub fn total(turns: &[Vec<Turn>]) -> usize {
    keys(turns).count()
}

/// Distinct frames that are a key of any joint.
pub fn union(turns: &[Vec<Turn>]) -> usize {
    let mut frames: Vec<Frame> = keys(turns).map(|turn| turn.frame).collect();
    frames.sort_unstable();
    frames.dedup();
    frames.len()
}

fn keys(turns: &[Vec<Turn>]) -> impl Iterator<Item = &Turn> {
    turns.iter().flatten().filter(|turn| turn.kind == TurnKind::Key)
}
