//! Compares ways to pick the genga (marks, noise, rigs and known keys at several densities), and lists the reasons of
//! the genga.

use std::collections::BTreeMap;

use genga::edits::Edits;
use genga::keys::{Key, Matching, Origin};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Reason;
use genga::target::{Target, meet};
use genga::time::Frame;
use genga_lab::study::Noise;

use crate::Outcome;
use crate::evidence::events::Event;
use crate::evidence::rigs::RIGS;
use crate::known;
use crate::table::{Table, number, percent, spread};
use crate::takes::Take;

/// Median genga per second at which the ways to pick are compared.
const DENSITIES: [f64; 2] = [4.8, 3.5];

/// Bisection steps in the search for a density.
const HALVINGS: usize = 12;

/// Longest clip, in frames, whose keys are searched again under noise.
const LONGEST: usize = 3000;

/// Ways to pick, each as settings.
const WAYS: [(&str, &[(&str, &str)]); 3] = [
    ("turns of the body", &[]),
    ("turns of the body alone", &[("keys.fill", "off")]),
    ("union of the joints", &[("keys.merge", "union")]),
];

/// A clip with an engine that has run.
struct Bench<'a> {
    take: &'a Take,
    engine: Engine,
}

impl Bench<'_> {
    fn keys(&mut self, recipe: &Recipe) -> Outcome<Vec<Key>> {
        Ok(self.engine.find_keys(recipe, &Edits::default())?.keys.keys.clone())
    }

    fn seconds(&self) -> f64 {
        let clip = &self.take.clip;
        clip.rate().koma_from_frames(clip.len(), 24.0) as f64 / 24.0
    }
}

/// Makes the tables, by name.
pub(crate) fn tables(takes: &[Take], events: &[Event]) -> Outcome<Vec<(&'static str, String)>> {
    let bench = |take| -> Outcome<Bench<'_>> {
        let take: &Take = take;
        Ok(Bench { take, engine: Engine::new(take.clip.clone())? })
    };
    let mut benches = takes.iter().map(bench).collect::<Outcome<Vec<_>>>()?;
    let mut ways = Table::new(&[
        "what picks",
        ">a second, median",
        ">72 marks: hits",
        ">chance",
        ">second eye: hits",
        ">chance",
        ">steady at 0.1°",
        ">at 0.3°",
        ">two rigs, F1",
    ]);
    let mut densities = vec![("as it is".to_owned(), Recipe::default())];
    for (name, settings) in WAYS {
        for density in DENSITIES {
            let recipe = at_density(&mut benches, settings, density)?;
            ways.row(&scored(&mut benches, events, name, &recipe)?);
            if settings.is_empty() {
                densities.push((format!("{density} a second"), recipe));
            }
        }
    }
    let known = WAYS.iter().map(|(name, settings)| Ok((*name, known_keys(takes, settings)?)));
    let mut found = Table::new(&["what picks", ">known keys found again, F1"]);
    for (name, share) in known.collect::<Outcome<Vec<_>>>()? {
        found.row(&[name.into(), number(share, 2)]);
    }
    Ok(vec![
        ("ways", ways.text()),
        ("known", found.text()),
        ("kinds", kinds(&mut benches, events, &densities)?),
        ("reasons", reasons(&mut benches)?),
        ("widths", widths(&mut benches)?),
    ])
}

fn recipe_with(settings: &[(&str, &str)]) -> Outcome<Recipe> {
    let mut recipe = Recipe::default();
    for (name, value) in settings {
        recipe.set(name, value)?;
    }
    Ok(recipe)
}

/// Finds the recipe whose price gives the clips the wanted median genga per second.
fn at_density(
    benches: &mut [Bench<'_>],
    settings: &[(&str, &str)],
    density: f64,
) -> Outcome<Recipe> {
    let mut recipe = recipe_with(settings)?;
    recipe.keys.per_second = f64::INFINITY;
    let (mut low, mut high) = (0.1_f64, 60.0_f64);
    for _ in 0..HALVINGS {
        recipe.keys.min_price = (low * high).sqrt();
        let rates = benches
            .iter_mut()
            .map(|bench| Ok(bench.keys(&recipe)?.len() as f64 / bench.seconds()))
            .collect::<Outcome<Vec<_>>>()?;
        *if spread(rates)[1] > density { &mut low } else { &mut high } = recipe.keys.min_price;
    }
    recipe.keys.min_price = high;
    Ok(recipe)
}

/// The row of a way to pick at a density.
fn scored(
    benches: &mut [Bench<'_>],
    events: &[Event],
    name: &str,
    recipe: &Recipe,
) -> Outcome<Vec<String>> {
    let mut rates = Vec::new();
    let mut found = BTreeMap::new();
    let mut steady = [Vec::new(), Vec::new()];
    for bench in benches.iter_mut() {
        let keys = bench.keys(recipe)?;
        rates.push(keys.len() as f64 / bench.seconds());
        if bench.take.clip.len() < LONGEST {
            for (degrees, steady) in [0.1, 0.3].into_iter().zip(&mut steady) {
                steady.push(kept_under_noise(&bench.take.clip, &keys, recipe, degrees)?);
            }
        }
        found.insert(bench.take.name.as_str(), keys);
    }
    let [first, second] =
        RIGS.map(|rig| found[rig].iter().map(|key| key.frame).collect::<Vec<Frame>>());
    let mut row = vec![name.to_owned(), number(spread(rates)[1], 1)];
    for sets in [&["chosen-with", "held-out"][..], &["second-eye"]] {
        let asked = |event: &&Event| sets.contains(&event.set.as_str());
        let (hits, count, chance) = hits(benches, events.iter().filter(asked), &found, events);
        row.extend([format!("{hits}/{count}"), percent(chance)]);
    }
    row.extend(steady.map(|shares| number(spread(shares)[1], 2)));
    let in_koma = benches[0].take.clip.clock(24.0).frames_in_koma();
    row.push(number(Matching::between(&first, &second, in_koma).kept(), 2));
    Ok(row)
}

/// Number of events hit, number of events, and the expected share by chance.
fn hits<'a>(
    benches: &[Bench<'_>],
    asked: impl Iterator<Item = &'a Event>,
    found: &BTreeMap<&str, Vec<Key>>,
    events: &[Event],
) -> (usize, usize, f64) {
    let (mut hits, mut count, mut chance) = (0, 0, 0.0);
    for event in asked {
        let Some(bench) = benches.iter().find(|bench| bench.take.name == event.clip) else {
            continue;
        };
        let clip = &bench.take.clip;
        let clock = clip.clock(24.0);
        let koma = |frame: Frame| clock.koma_from_frame(frame);
        let genga: Vec<usize> =
            found[event.clip.as_str()].iter().map(|key| koma(key.frame)).collect();
        let marked = |other: &&Event| other.set == "stretch" && other.clip == event.clip;
        let [from, past] = match events.iter().find(marked) {
            Some(stretch) if event.set == "second-eye" => {
                let [from, to] = stretch.koma(&clock);
                [from, to + 1]
            }
            _ => [0, clip.rate().koma_from_frames(clip.len(), 24.0)],
        };
        hits += usize::from(event.is_hit_by(&genga, &clock));
        count += 1;
        chance += event.chance_among(&genga, &clock, from..past);
    }
    (hits, count, chance / count.max(1) as f64)
}

/// Share of keys that stay within a koma with noise on the clip, the mean of two seeds.
fn kept_under_noise(clip: &Clip, keys: &[Key], recipe: &Recipe, degrees: f64) -> Outcome<f64> {
    let own: Vec<Frame> = keys.iter().map(|key| key.frame).collect();
    let mut sum = 0.0;
    for seed in 0..2 {
        let mut engine = Engine::new(Noise { degrees, seed }.on(clip))?;
        let keys = engine.find_keys(recipe, &Edits::default())?.keys;
        let noisy: Vec<Frame> = keys.keys.iter().map(|key| key.frame).collect();
        sum += Matching::between(&own, &noisy, clip.clock(24.0).frames_in_koma()).kept();
    }
    Ok(sum / 2.0)
}

/// Share of the known keys of synthetic clips that are found again, the mean over clips and two seeds.
fn known_keys(takes: &[Take], settings: &[(&str, &str)]) -> Outcome<f64> {
    let mut recipe = recipe_with(settings)?;
    recipe.keys.per_second = f64::INFINITY;
    let mut shares = Vec::new();
    for take in takes {
        let noise = known::noise_of(&take.clip);
        for seed in 0..2 {
            let (dense, keys) = known::made(&take.clip, seed, noise);
            let mut engine = Engine::new(dense)?;
            let asked = [Target::Keys(keys.len() + 2)];
            let met = meet(&mut engine, &recipe, &Edits::default(), &asked)?;
            let found = engine.find_keys(&met.recipe, &Edits::default())?.keys;
            let found: Vec<Frame> = found.keys.iter().map(|key| key.frame).collect();
            shares.push(Matching::between(&keys, &found, known::FRAMES as f64).kept());
        }
    }
    Ok(shares.iter().sum::<f64>() / shares.len() as f64)
}

/// A table of hits by kind of event, for the second eye and the gaits.
fn kinds(
    benches: &mut [Bench<'_>],
    events: &[Event],
    densities: &[(String, Recipe)],
) -> Outcome<String> {
    let mut kinds: Vec<(&str, &str)> = Vec::new();
    for event in events.iter().filter(|event| ["second-eye", "gait"].contains(&event.set.as_str()))
    {
        let kind = (event.set.as_str(), event.kind.as_str());
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds.sort_unstable_by_key(|(set, kind)| (*set != "second-eye", *kind));
    let names: Vec<String> = densities.iter().map(|(name, _)| format!(">{name}")).collect();
    let header: Vec<&str> =
        ["set", "kind"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let mut table = Table::new(&header);
    let mut found = Vec::new();
    for (_, recipe) in densities {
        let of_clip = |bench: &mut Bench<'_>| Ok((bench.take.name.clone(), bench.keys(recipe)?));
        found.push(benches.iter_mut().map(of_clip).collect::<Outcome<BTreeMap<_, _>>>()?);
    }
    for (set, kind) in kinds {
        let asked = |event: &&Event| event.set == set && event.kind == kind;
        let cells = found.iter().map(|found| {
            let found = found.iter().map(|(name, keys)| (name.as_str(), keys.clone())).collect();
            let (hits, count, _) = hits(benches, events.iter().filter(asked), &found, events);
            format!("{hits}/{count}")
        });
        let cells: Vec<String> = cells.collect();
        table.row(&[vec![set.to_owned(), kind.to_owned()], cells].concat());
    }
    Ok(table.text())
}

/// A table of the genga of each clip by reason.
fn reasons(benches: &mut [Bench<'_>]) -> Outcome<String> {
    let shown = [Reason::Turn, Reason::Fill, Reason::Rest, Reason::Step];
    let names = shown.map(|reason| format!(">{}", reason.word()));
    let header: Vec<&str> =
        ["clip", ">genga"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let mut table = Table::new(&header);
    let mut all = [0; 4];
    for bench in benches.iter_mut() {
        let keys = bench.keys(&Recipe::default())?;
        let counts =
            shown.map(|reason| keys.iter().filter(|key| key.origin.reason() == reason).count());
        all.iter_mut().zip(counts).for_each(|(all, count)| *all += count);
        let cells = counts.map(|count| count.to_string());
        table.row(&[&[bench.take.name.clone(), keys.len().to_string()][..], &cells].concat());
    }
    let sum: usize = all.iter().sum();
    let cells = all.map(|count| format!("{count} = {}", percent(count as f64 / sum as f64)));
    table.row(&[&["**all**".to_owned(), sum.to_string()][..], &cells].concat());
    Ok(table.text())
}

/// A table of turns of the body, genga and fills of all clips by filter width.
fn widths(benches: &mut [Bench<'_>]) -> Outcome<String> {
    let mut table =
        Table::new(&["`filter.width`", ">turns of the body", ">genga", ">of these fills"]);
    for width in ["0.05s", "0.1s", "0.15s", "0.2s", "0.3s", "0.5s"] {
        let recipe = recipe_with(&[("filter.width", width)])?;
        let [mut turns, mut genga, mut fills] = [0; 3];
        for bench in benches.iter_mut() {
            let found = bench.engine.find_keys(&recipe, &Edits::default())?;
            turns += found.body.turns.len();
            genga += found.keys.keys.len();
            fills += found.keys.keys.iter().filter(|key| key.origin == Origin::Fill).count();
        }
        let counts = [turns, genga, fills].map(|count| count.to_string());
        table.row(&[&[width.to_owned()][..], &counts].concat());
    }
    Ok(table.text())
}
