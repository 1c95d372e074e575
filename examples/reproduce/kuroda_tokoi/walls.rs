//! The claim of §3.4: at a wall, no inbetween is drawn into the fast place.

use genga::edits::Edits;
use genga::keys::{self, LayerKeys};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Layer, Role};
use genga::signal::Signals;
use genga::timing::{Pace, Spacing};

use crate::Outcome;
use crate::part::Part;
use crate::samples;
use crate::table::number;
use crate::takes::Take;

/// Counts of inbetweens for which a wall makes a difference.
#[derive(Debug, Clone, Copy, Default)]
struct Told {
    /// All such inbetweens.
    all: usize,
    /// Number of those drawn where the body is faster than at their even place, by the nearer key alone and with the
    /// wall.
    nearer: usize,
    wall: usize,
}

/// Adds the sample's numbers for the prose.
pub(super) fn add_sample(part: &mut Part) -> Outcome<()> {
    add(part, "kt.walls", told(samples::clip("kuroda-pitch")?)?);
    Ok(())
}

/// Adds the real clips' numbers for the prose.
pub(super) fn add_takes(part: &mut Part, takes: &[Take]) -> Outcome<()> {
    let mut sum = Told::default();
    for take in takes {
        let Told { all, nearer, wall } = told(take.clip.clone())?;
        sum = Told { all: sum.all + all, nearer: sum.nearer + nearer, wall: sum.wall + wall };
    }
    add(part, "kt.clips.walls", sum);
    Ok(())
}

fn add(part: &mut Part, name: &str, told: Told) {
    let share = |count: usize| number(100.0 * count as f64 / told.all.max(1) as f64, 0);
    part.number(name, told.all);
    part.number(&format!("{name}.nearer"), share(told.nearer));
    part.number(&format!("{name}.wall"), share(told.wall));
}

/// Counts the inbetweens that the wall and the nearer key would move in opposite directions, with the default recipe.
fn told(clip: Clip) -> Outcome<Told> {
    let recipe = Recipe::default();
    let weights = keys::weights(&clip);
    let skeleton = clip.skeleton().clone();
    let mut engine = Engine::new(clip)?;
    let breakdown = engine.run(&recipe, &Edits::default())?;
    let speed = Sum { filtered: breakdown.filtered, weights: &weights };
    let koma = breakdown.spaced.length();
    let layer = |keys: &LayerKeys, weight| {
        let spacing = Spacing { weight, ..recipe.spacing.clone() };
        spacing.place(keys, &skeleton, breakdown.clock, koma, &Pace::default()).layer
    };
    let without = LayerKeys { walls: Vec::new(), ..breakdown.first_layer().keys.clone() };
    let even = layer(&without, 0.0);
    let nearer = layer(&without, recipe.spacing.weight);
    let wall = layer(breakdown.first_layer().keys, recipe.spacing.weight);
    let mut told = Told::default();
    for ((even, nearer), wall) in places(&even).zip(places(&nearer)).zip(places(&wall)) {
        if (nearer - even) * (wall - even) >= 0.0 {
            continue;
        }
        told.all += 1;
        told.nearer += usize::from(speed.at(nearer) > speed.at(even));
        told.wall += usize::from(speed.at(wall) > speed.at(even));
    }
    Ok(told)
}

/// The source places of the inbetweens.
fn places(layer: &Layer) -> impl Iterator<Item = f64> + '_ {
    let inbetweens = layer.drawings.iter().filter(|drawing| drawing.role == Role::Inbetween);
    inbetweens.map(|drawing| drawing.source.place())
}

/// The body's speed: the weighted sum of the joints' filtered speeds.
struct Sum<'a> {
    filtered: &'a Signals,
    weights: &'a [f64],
}

impl Sum<'_> {
    /// The speed at a place, interpolated linearly between two frames.
    fn at(&self, place: f64) -> f64 {
        let row = place - self.filtered.first.0 as f64;
        let (before, share) = (row.floor() as usize, row - row.floor());
        let after = (before + 1).min(self.filtered.frames() - 1);
        let sum = |row: usize| -> f64 {
            let speeds = self.filtered.values.row(row);
            speeds.iter().zip(self.weights).map(|(speed, weight)| speed * weight).sum()
        };
        (1.0 - share) * sum(before) + share * sum(after)
    }
}
