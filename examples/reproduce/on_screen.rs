//! Measures the screen: its distance from the source, the share of each stage in it, and that of evenly spaced keys.

use genga::edits::{Edits, Pin};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, KOMA_RATE};
use genga_lab::quality::Evaluation;

use crate::Outcome;
use crate::part::Part;
use crate::table::{Table, number, spread};
use crate::takes::Take;

/// A recipe, as the settings that differ from the default.
type Variant = (&'static str, &'static [(&'static str, &'static str)]);

const NO_GAPS: (&str, &str) = ("omission.naka_nashi", "0");
const NO_HOLDS: (&str, &str) = ("omission.koma_dori", "0");
const EVEN: (&str, &str) = ("spacing.weight", "0");
const NO_RESTS: (&str, &str) = ("spacing.drift", "0");

const VARIANTS: [Variant; 7] = [
    ("the recipe", &[]),
    ("without naka-nashi", &[NO_GAPS]),
    ("without koma-dori", &[NO_HOLDS]),
    ("even spacing", &[EVEN]),
    ("rests not held", &[NO_RESTS]),
    ("without all of these", &[NO_GAPS, NO_HOLDS, EVEN, NO_RESTS]),
    ("the same on ones", &[NO_GAPS, NO_HOLDS, EVEN, NO_RESTS, ("spacing.on", "1")]),
];

/// The figures of a sheet.
struct Shown {
    mean: f64,
    per_second: f64,
}

/// Makes the table of variants, and the numbers of the prose.
pub(crate) fn add(takes: &[Take], part: &mut Part) -> Outcome<()> {
    let mut table = Table::new(&["sheet", ">drawings/s", ">off", ">× even", ">better on"]);
    for (name, settings) in VARIANTS {
        let mut recipe = Recipe::default();
        settings.iter().try_for_each(|(knob, value)| recipe.set(knob, value))?;
        let pairs = takes.iter().map(|take| pair(&take.clip, &recipe));
        let pairs = pairs.collect::<Outcome<Vec<_>>>()?;
        let own = |of: fn(&Shown) -> f64| {
            pairs.iter().map(|(own, _)| of(own)).sum::<f64>() / pairs.len() as f64
        };
        let of_even =
            |(own, even): &(Shown, Shown)| (even.mean > 1e-9).then(|| own.mean / even.mean);
        let ratios: Vec<f64> = pairs.iter().filter_map(of_even).collect();
        let better = ratios.iter().filter(|ratio| **ratio < 1.0).count();
        table.row(&[
            name.into(),
            number(own(|shown| shown.per_second), 1),
            number(own(|shown| shown.mean), 2),
            number(spread(ratios)[1], 2),
            better.to_string(),
        ]);
    }
    part.table("on-screen", table);
    Ok(())
}

/// Measures a recipe's sheet of a clip, and one with as many evenly spaced keys.
fn pair(clip: &Clip, recipe: &Recipe) -> Outcome<(Shown, Shown)> {
    let mut engine = Engine::new(clip.clone())?;
    let mut shown = |edits: &Edits| {
        let sheet = engine.run(recipe, edits)?.sheet.clone();
        let found = Evaluation::new(clip, &sheet, None, 1.0)?;
        let shown = Shown { mean: found.shown.mean, per_second: found.pace.drawings_per_second };
        Ok::<_, Box<dyn std::error::Error>>((found.pace.genga, shown))
    };
    let (genga, own) = shown(&Edits::default())?;
    let (_, even) = shown(&at_even_distances(clip, genga - 2))?;
    Ok((own, even))
}

/// Pins `count` evenly spaced koma, with no other keys.
fn at_even_distances(clip: &Clip, count: usize) -> Edits {
    let clock = clip.clock(KOMA_RATE);
    let last = clip.rate().koma_from_frames(clip.len(), KOMA_RATE).saturating_sub(1);
    let koma = |at: usize| (at * last) as f64 / (count + 1) as f64;
    let frame =
        |at: usize| Frame(clock.place_from_koma(koma(at).round() as usize).round() as usize);
    let pin = |frame| Pin { frame, name: None, weight: None };
    Edits {
        pins: (1..=count).map(frame).map(pin).collect(),
        only_pins: count > 0,
        ..Edits::default()
    }
}
