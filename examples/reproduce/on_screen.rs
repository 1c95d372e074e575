//! What is on screen: how far it is from the source, what each stage adds to that, and how keys at even distances do.

use genga::edits::{Edits, Pin};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::quality::Evaluation;
use genga::recipe::Recipe;
use genga::time::{Frame, KOMA_RATE};

use crate::Outcome;
use crate::part::Part;
use crate::table::{Table, number, spread};
use crate::takes::Take;

/// A recipe by the settings that differ from the default.
type Variant = (&'static str, &'static [(&'static str, &'static str)]);

const NO_GAPS: (&str, &str) = ("omission.naka_nashi", "0");
const NO_HOLDS: (&str, &str) = ("omission.koma_dori", "0");
const EVEN: (&str, &str) = ("spacing.weight", "0");
const NO_RESTS: (&str, &str) = ("spacing.drift", "0");

const VARIANTS: [Variant; 8] = [
    ("the recipe", &[]),
    ("without naka-nashi", &[NO_GAPS]),
    ("without koma-dori", &[NO_HOLDS]),
    ("without both", &[NO_GAPS, NO_HOLDS]),
    ("even spacing", &[EVEN]),
    ("rests not held", &[NO_RESTS]),
    ("without all of these", &[NO_GAPS, NO_HOLDS, EVEN, NO_RESTS]),
    ("the same on ones", &[NO_GAPS, NO_HOLDS, EVEN, NO_RESTS, ("spacing.on", "1")]),
];

/// A sheet by what is counted of it.
struct Shown {
    mean: f64,
    per_second: f64,
    /// Exposures, of them those of one koma and the longest.
    exposures: [usize; 2],
    longest: usize,
}

/// The table of variants, and what of the sheets the prose tells.
pub(crate) fn add(takes: &[Take], part: &mut Part) -> Outcome<()> {
    let header = ["sheet", ">drawings/s", ">off", ">× even", ">better on", ">one koma", ">longest"];
    let mut table = Table::new(&header);
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
        let count = |of: fn(&Shown) -> usize| pairs.iter().map(|(own, _)| of(own)).sum::<usize>();
        let all = count(|shown| shown.exposures[0]).max(1);
        let longest = pairs.iter().map(|(own, _)| own.longest).max().unwrap_or(0);
        table.row(&[
            name.into(),
            number(own(|shown| shown.per_second), 1),
            number(own(|shown| shown.mean), 2),
            number(spread(ratios)[1], 2),
            better.to_string(),
            format!(
                "{} %",
                number(100.0 * count(|shown| shown.exposures[1]) as f64 / all as f64, 1)
            ),
            longest.to_string(),
        ]);
    }
    part.table("on-screen", table);
    Ok(())
}

/// What a recipe shows of a clip, and what it shows with as many keys at even distances.
fn pair(clip: &Clip, recipe: &Recipe) -> Outcome<(Shown, Shown)> {
    let mut engine = Engine::new(clip.clone())?;
    let mut shown = |edits: &Edits| {
        let sheet = engine.run(recipe, edits)?.sheet.clone();
        let found = Evaluation::of(clip, &sheet, None, 1.0)?;
        let exposures = &sheet.layers[0].exposures;
        let ones = exposures.iter().filter(|exposure| exposure.koma == 1).count();
        let shown = Shown {
            mean: found.shown.mean,
            per_second: found.pace.drawings_per_second,
            exposures: [exposures.len(), ones],
            longest: sheet.layers[0].longest_hold(),
        };
        Ok::<_, Box<dyn std::error::Error>>((found.pace.genga, shown))
    };
    let (genga, own) = shown(&Edits::default())?;
    let (_, even) = shown(&at_even_distances(clip, genga - 2))?;
    Ok((own, even))
}

/// So many pins on koma at even distances, and no other keys.
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
