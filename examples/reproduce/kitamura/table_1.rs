//! Table 1: amounts asked for in the four actions, amounts done, times, and the result of the pseudo-code taken
//! literally.

use std::hint::black_box;
use std::time::Instant;

use genga::timing::Stills;

use crate::kitamura::letter::Frames;
use crate::ones::{Ones, counts};
use crate::part::Part;
use crate::table::{Table, number, spread};
use crate::{Outcome, samples};

/// A row of the paper.
pub(super) struct Action {
    /// The sample that stands in for the capture.
    pub(super) sample: &'static str,
    /// The action's name in the paper.
    pub(super) name: &'static str,
    pub(super) koma: usize,
    pub(super) naka_nashi: usize,
    pub(super) koma_dori: usize,
    pub(super) milliseconds: usize,
}

/// The four rows.
pub(super) const ACTIONS: [Action; 4] = [
    row("pitch", "Pitch", [129, 4, 33, 69]),
    row("kick", "Kick", [92, 4, 30, 28]),
    row("tennis", "Tennis", [88, 4, 29, 27]),
    row("swing", "Baseball swing", [120, 6, 40, 63]),
];

const fn row(sample: &'static str, name: &'static str, figures: [usize; 4]) -> Action {
    let [koma, naka_nashi, koma_dori, milliseconds] = figures;
    Action { sample, name, koma, naka_nashi, koma_dori, milliseconds }
}

impl Action {
    /// Reads the sample, and checks that it is as long as the paper's action.
    pub(super) fn ones(&self) -> Outcome<Ones> {
        let ones = Ones::new(samples::clip(self.sample)?);
        let (sample, koma) = (self.sample, self.koma);
        if ones.koma() != koma {
            let found = ones.koma();
            return Err(format!("{sample} has {found} koma, the paper's action has {koma}").into());
        }
        Ok(ones)
    }
}

/// Makes the tables.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let mut omission = Table::new(&[
        "action",
        ">koma",
        ">N_io done/asked",
        ">N_hf done/asked",
        ">longest hold",
        ">to the letter: koma held",
        ">copies that change nothing",
    ]);
    let mut times = Table::new(&[
        "action",
        ">paper",
        ">the letter, both stages",
        ">genga, both stages",
        ">genga with positions",
        ">letter / genga",
    ]);
    let mut idle = Vec::new();
    for action in ACTIONS {
        let ones = action.ones()?;
        let (naka_nashi, koma_dori) = (action.naka_nashi, action.koma_dori);
        let done = ones.omit(&counts(naka_nashi, koma_dori))?;
        let report = &done.report;
        let mut frames = to_the_letter(&ones, &action, false);
        let held_before = frames.held();
        frames.algorithm_2(koma_dori);
        idle.push(frames.idle);
        omission.row(&[
            action.name.into(),
            action.koma.to_string(),
            format!("{}/{}", report.naka_nashi.done, report.naka_nashi.asked),
            format!("{}/{}", report.koma_dori.done, report.koma_dori.asked),
            done.longest_hold().to_string(),
            (frames.held() - held_before).to_string(),
            frames.idle.to_string(),
        ]);
        times.row(&times_of(&action, &ones));
    }
    part.table("table-1-omission", omission);
    part.measured("table-1-times", times);
    part.number("km.letter.pitch", idle[0]);
    part.number("km.pitch.holds", ACTIONS[0].koma_dori);
    part.number("km.paper.pitch.ms", ACTIONS[0].milliseconds);
    let held = ACTIONS.map(|action| 100.0 * action.koma_dori as f64 / action.koma as f64);
    let [least, _, most] = spread(held);
    part.number("km.paper.held.least", number(least, 0));
    part.number("km.paper.held.most", number(most, 0));
    Ok(())
}

fn to_the_letter(ones: &Ones, action: &Action, both: bool) -> Frames {
    let mut frames = Frames::from_stills(&ones.stills, ones.clip.skeleton().len());
    frames.algorithm_1(action.naka_nashi);
    if both {
        frames.algorithm_2(action.koma_dori);
    }
    frames
}

fn times_of(action: &Action, ones: &Ones) -> [String; 6] {
    let settings = counts(action.naka_nashi, action.koma_dori);
    let layer = &ones.sheet.layers[0];
    let letter = milliseconds(|| to_the_letter(ones, action, true));
    let stages = milliseconds(|| settings.apply(layer, &ones.stills, 1));
    let all = milliseconds(|| settings.apply(layer, &Stills::from_layer(&ones.clip, layer), 1));
    [
        action.name.into(),
        action.milliseconds.to_string(),
        number(letter, 3),
        number(stages, 3),
        number(all, 3),
        number(letter / stages, 0),
    ]
}

/// The median of 21 runs after a warm-up run.
fn milliseconds<T>(run: impl Fn() -> T) -> f64 {
    black_box(run());
    let mut times: Vec<f64> = (0..21)
        .map(|_| {
            let started = Instant::now();
            black_box(run());
            1e3 * started.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
