//! Timing (タイミング): holds, fast passages, and the marks that a person made in six sources beforehand.

use genga::edits::Edits;
use genga::keys::Reference;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Layer, Sheet};

use crate::Outcome;
use crate::evidence::events::Event;
use crate::table::{Table, number, percent};
use crate::takes::{Take, named};

/// Koma from which on an exposure is a hold.
const HOLD: usize = 6;

/// Largest distance, in % of body height, at which neighbouring genga count as alike and one drawing could show both:
/// the default of `spacing.drift`.
const ALIKE: f64 = 3.3;

/// The recipes compared: the defaults, the defaults with ones, and twos without holds, as in most sheets of captures.
const RECIPES: [(&str, &[(&str, &str)]); 3] = [
    ("as it is", &[]),
    ("on ones to threes", &[("spacing.on", "1-3")]),
    ("on twos, nothing held", &[("spacing.on", "2"), ("spacing.drift", "0")]),
];

/// Counts of a sheet, or of several together.
#[derive(Default, Clone, Copy)]
struct Counts {
    koma: usize,
    held: usize,
    drawings: usize,
    genga_alike: usize,
    genga_pairs: usize,
    holds: usize,
    drawings_in_holds: usize,
    long_holds: usize,
    onset: usize,
    marks: usize,
    hits: usize,
    chance: f64,
    /// Sum of the rank correlations, and number of clips in it.
    ranks: f64,
    clips: f64,
}

/// A drawing on the sheet: its first koma, its length in koma, the koma of its source place, whether it is a genga.
#[derive(Clone, Copy)]
struct Shown {
    begin: usize,
    koma: usize,
    moment: usize,
    is_kept: bool,
}

/// Makes the table of the marked clips, and of all recipes.
pub(crate) fn table(takes: &[Take], events: &[Event]) -> Outcome<String> {
    let header = [
        "clip, recipe",
        ">koma",
        ">in holds",
        ">exposure and speed",
        ">drawings/s",
        ">neighbouring genga alike",
        ">holds marked",
        ">drawings in them",
        ">of 6 koma and more",
        ">begin off, koma",
        ">marks hit",
        ">chance",
    ];
    let mut table = Table::new(&header);
    for (name, settings) in RECIPES {
        let mut recipe = Recipe::default();
        settings.iter().try_for_each(|(knob, value)| recipe.set(knob, value))?;
        let mut all = Counts::default();
        for clip in clips(events) {
            let own: Vec<&Event> = events.iter().filter(|event| event.clip == clip).collect();
            let counts = counted(named(takes, clip)?, &recipe, &own)?;
            if settings.is_empty() {
                table.row(&cells(clip, &counts));
            }
            all.add(&counts);
        }
        table.row(&cells(&format!("**{name}**"), &all));
    }
    let mut rest = Counts::default();
    for take in takes {
        rest.add(&counted(take, &Recipe::default(), &[])?);
    }
    let mut last = cells(&format!("**all {} clips**", takes.len()), &rest);
    last.iter_mut().skip(6).for_each(|cell| *cell = "–".into());
    table.row(&last);
    Ok(table.text())
}

/// The clips of some events, in their order.
fn clips(events: &[Event]) -> Vec<&str> {
    let mut clips: Vec<&str> = events.iter().map(|event| event.clip.as_str()).collect();
    clips.dedup();
    clips
}

fn cells(name: &str, counts: &Counts) -> Vec<String> {
    let share = |part: usize, of: usize| part as f64 / of.max(1) as f64;
    vec![
        name.into(),
        counts.koma.to_string(),
        percent(share(counts.held, counts.koma)),
        number(counts.ranks / counts.clips, 2),
        number(24.0 * share(counts.drawings, counts.koma), 1),
        format!("{} of {}", counts.genga_alike, counts.genga_pairs),
        counts.holds.to_string(),
        counts.drawings_in_holds.to_string(),
        counts.long_holds.to_string(),
        number(share(counts.onset, counts.holds), 1),
        format!("{}/{}", counts.hits, counts.marks),
        percent(counts.chance / counts.marks.max(1) as f64),
    ]
}

fn counted(take: &Take, recipe: &Recipe, events: &[&Event]) -> Outcome<Counts> {
    let mut engine = Engine::new(take.clip.clone())?;
    let sheet = engine.run(recipe, &Edits::default())?.sheet.clone();
    let reference = Reference::new(&take.clip, sheet.clock);
    let shown = shown(&sheet, reference.koma());
    let mut counts = Counts {
        koma: sheet.length(),
        held: shown.iter().map(|shown| shown.koma).filter(|koma| *koma >= HOLD).sum(),
        drawings: shown.len(),
        ranks: with_speed(&shown, &reference),
        clips: 1.0,
        ..Counts::default()
    };
    let genga: Vec<&Shown> = shown.iter().filter(|shown| shown.is_kept).collect();
    for pair in genga.windows(2) {
        counts.genga_pairs += 1;
        let mut between = pair[0].moment + 1..=pair[1].moment;
        let is_alike = between.all(|koma| reference.unlike(pair[0].moment, koma) < ALIKE);
        counts.genga_alike += usize::from(is_alike);
    }
    let stretch = events.iter().find(|event| event.set == "stretch");
    let stretch = stretch.map_or([0, sheet.length()], |event| event.koma(&sheet.clock));
    for event in events {
        match event.set.as_str() {
            "hold" => counts.add_hold(&shown, event.koma(&sheet.clock)),
            "timing" => counts.add_mark(&shown, event, (event.koma(&sheet.clock), stretch)),
            _ => {}
        }
    }
    Ok(counts)
}

fn shown(sheet: &Sheet, koma: usize) -> Vec<Shown> {
    let layer: &Layer = &sheet.layers[0];
    let shown = |(begin, shown): (usize, genga::sheet::Exposure)| {
        let drawing = &layer.drawings[shown.drawing];
        let moment = sheet.clock.koma_from_place(drawing.source.place()).min(koma - 1);
        Shown { begin, koma: shown.koma, moment, is_kept: drawing.role.is_kept() }
    };
    layer.timed().map(shown).collect()
}

/// Rank correlation (Spearman) between the length of exposures and the speed of the source meanwhile.
fn with_speed(shown: &[Shown], reference: &Reference) -> f64 {
    let last = reference.koma() - 1;
    let step = |koma: usize| if koma == 0 { 0.0 } else { reference.apart(koma - 1, koma) };
    let speed = |shown: &Shown| {
        let koma = shown.begin..shown.begin + shown.koma;
        koma.map(|koma| step(koma.min(last))).sum::<f64>() / shown.koma as f64
    };
    let stays = ranks(shown.iter().map(|shown| shown.koma as f64));
    correlation(&stays, &ranks(shown.iter().map(speed)))
}

/// Rank of each value, the mean rank on a tie.
fn ranks(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let values: Vec<f64> = values.collect();
    let below = |own: &f64| values.iter().filter(|other| *other < own).count();
    let equal = |own: &f64| values.iter().filter(|other| *other == own).count();
    values.iter().map(|own| below(own) as f64 + 0.5 * (equal(own) - 1) as f64).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (of_a, of_b) = (mean(a), mean(b));
    let both: f64 = a.iter().zip(b).map(|(a, b)| (a - of_a) * (b - of_b)).sum();
    let square =
        |values: &[f64], mean: f64| values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    both / (square(a, of_a) * square(b, of_b)).sqrt().max(f64::MIN_POSITIVE)
}

impl Counts {
    fn add(&mut self, other: &Self) {
        self.koma += other.koma;
        self.held += other.held;
        self.drawings += other.drawings;
        self.genga_alike += other.genga_alike;
        self.genga_pairs += other.genga_pairs;
        self.holds += other.holds;
        self.drawings_in_holds += other.drawings_in_holds;
        self.long_holds += other.long_holds;
        self.onset += other.onset;
        self.marks += other.marks;
        self.hits += other.hits;
        self.chance += other.chance;
        self.ranks += other.ranks;
        self.clips += other.clips;
    }

    /// Adds a marked hold: counts the drawings within it, and checks the length of the one that covers most of it.
    fn add_hold(&mut self, shown: &[Shown], [from, to]: [usize; 2]) {
        let within =
            shown.iter().filter(|shown| shown.begin < to && shown.begin + shown.koma > from + 1);
        let covers =
            |shown: &&Shown| (shown.begin + shown.koma).min(to + 1) - shown.begin.max(from);
        self.holds += 1;
        self.drawings_in_holds += within.clone().count();
        if let Some(longest) = within.max_by_key(covers) {
            self.long_holds += usize::from(longest.koma >= HOLD);
            self.onset += longest.begin.abs_diff(from);
        }
    }

    /// Adds a mark. It is hit by a genga within a koma. A start or an end of a movement is hit by a change of drawing
    /// within a koma, because its pose is the one that is held.
    fn add_mark(
        &mut self,
        shown: &[Shown],
        event: &Event,
        ([from, to], stretch): ([usize; 2], [usize; 2]),
    ) {
        let moments: Vec<usize> = match event.kind.as_str() {
            "start" | "end" => shown.iter().map(|shown| shown.begin).collect(),
            _ => shown.iter().filter(|shown| shown.is_kept).map(|shown| shown.moment).collect(),
        };
        let is_hit = |from: usize, to: usize| {
            moments.iter().any(|moment| moment + 1 >= from && *moment <= to + 1)
        };
        self.marks += 1;
        self.hits += usize::from(is_hit(from, to));
        let places = stretch[0]..(stretch[1] + 1).saturating_sub(to - from);
        let count = places.len().max(1) as f64;
        self.chance +=
            places.filter(|place| is_hit(*place, place + to - from)).count() as f64 / count;
    }
}
