//! §4: "more than 6 and it jumps", "a third is right": what grows with either number.

mod knee;
mod picture;

use genga::timing::Omission;

use crate::Outcome;
use crate::kitamura::Window;
use crate::kitamura::growth::knee::{knee, last_of_rise, last_within};
use crate::ones::{Ones, counts};
use crate::part::Part;
use crate::table::{Table, number, percent, spread};

/// The most left out that is shown, and the most that is tried: a knee that moves with the range is
/// none.
const NAKA_NASHI: [usize; 2] = [12, 24];
/// What the paper finds right: as many left out.
const PAPER: [usize; 2] = [4, 6];
/// The most held, in %.
const KOMA_DORI: usize = 60;
/// Rows of the table of koma-dori, in %.
const EACH: usize = 5;

/// What one number of one stage does to a clip, the other stage left out.
#[derive(Clone, Copy)]
struct Effect {
    /// The largest step from koma to koma, √SSD, against that of the source.
    step: f64,
    longest_hold: usize,
    a_second: f64,
    /// Koma held.
    held: usize,
}

impl Effect {
    fn of(ones: &Ones, settings: &Omission) -> Outcome<Self> {
        let done = ones.omit(settings)?;
        let layer = &done.sheet.layers[0];
        let seconds = ones.koma() as f64 / done.sheet.clock.koma_rate;
        Ok(Self {
            step: (done.peak / ones.peak()).sqrt(),
            longest_hold: done.longest_hold(),
            a_second: layer.exposures.len() as f64 / seconds,
            held: done.held(),
        })
    }
}

/// A clip with more and more left out, and with more and more held.
struct Growth {
    name: String,
    koma: usize,
    naka_nashi: Vec<Effect>,
    koma_dori: Vec<Effect>,
}

impl Growth {
    fn of(window: &Window<'_>) -> Outcome<Self> {
        let ones = &window.ones;
        let held = |share: usize| (share as f64 / 100.0 * ones.koma() as f64).round() as usize;
        let naka_nashi = (0..=NAKA_NASHI[1]).map(|most| Effect::of(ones, &counts(most, 0)));
        let koma_dori = (0..=KOMA_DORI).map(|share| Effect::of(ones, &counts(0, held(share))));
        Ok(Self {
            name: window.name.into(),
            koma: ones.koma(),
            naka_nashi: naka_nashi.collect::<Outcome<_>>()?,
            koma_dori: koma_dori.collect::<Outcome<_>>()?,
        })
    }
}

fn steps(effects: &[Effect]) -> Vec<f64> {
    effects.iter().map(|effect| effect.step).collect()
}

/// The middle step of all clips.
fn middle(clips: &[Growth], of: fn(&Growth) -> &[Effect]) -> Vec<f64> {
    let at = |number: usize| spread(clips.iter().map(|clip| of(clip)[number].step))[1];
    (0..of(&clips[0]).len()).map(at).collect()
}

/// Tables, the picture and what the prose says.
pub(super) fn add(part: &mut Part, windows: &[Window<'_>]) -> Outcome<()> {
    let clips = windows.iter().map(Growth::of).collect::<Outcome<Vec<_>>>()?;
    part.table("growth-naka-nashi", naka_nashi(&clips));
    part.table("growth-koma-dori", koma_dori(&clips));
    part.table("knees", knees(&clips));
    part.picture("growth", picture::draw(&clips)?);
    numbers(part, &clips);
    Ok(())
}

/// The words of a row but the first.
fn row(effects: &[Effect]) -> [String; 5] {
    let peak = spread(effects.iter().map(|effect| effect.step.powi(2)))[1];
    let [least, middle, most] = spread(effects.iter().map(|effect| effect.step));
    let hold = spread(effects.iter().map(|effect| effect.longest_hold as f64))[1];
    let a_second = spread(effects.iter().map(|effect| effect.a_second))[1];
    [
        number(peak, 1),
        number(middle, 2),
        format!("{}–{}", number(least, 1), number(most, 1)),
        number(hold, 0),
        number(a_second, 1),
    ]
}

fn table(first: &str) -> Table {
    Table::new(&[
        first,
        ">peak SSD, times",
        ">largest step, times",
        ">of the clips",
        ">longest hold",
        ">drawings a second",
    ])
}

fn naka_nashi(clips: &[Growth]) -> Table {
    let mut table = table(">N_io");
    for most in 0..=NAKA_NASHI[0] {
        let effects: Vec<_> = clips.iter().map(|clip| clip.naka_nashi[most]).collect();
        table.row(&[&[most.to_string()][..], &row(&effects)].concat());
    }
    table
}

fn koma_dori(clips: &[Growth]) -> Table {
    let mut table = table(">N_hf");
    for share in (0..=KOMA_DORI).step_by(EACH) {
        let effects: Vec<_> = clips.iter().map(|clip| clip.koma_dori[share]).collect();
        table.row(&[&[format!("{share} %")][..], &row(&effects)].concat());
    }
    table
}

fn knees(clips: &[Growth]) -> Table {
    let mut table = Table::new(&[
        "clip",
        ">knee of N_io up to 12",
        ">up to 24",
        ">N_io after which the step grows no more",
        ">N_hf without a step longer than the source's",
        ">most that can be held",
    ]);
    let [near, far] = NAKA_NASHI;
    let row = |table: &mut Table, name: &str, naka: &[f64], koma: &[f64], most: String| {
        table.row(&[
            name.into(),
            knee(&naka[..=near]).to_string(),
            knee(&naka[..=far]).to_string(),
            last_of_rise(naka).map_or_else(|| "–".into(), |at| at.to_string()),
            format!("{} %", last_within(koma)),
            most,
        ]);
    };
    for clip in clips {
        let held = clip.koma_dori[KOMA_DORI].held as f64 / clip.koma as f64;
        row(
            &mut table,
            &clip.name,
            &steps(&clip.naka_nashi),
            &steps(&clip.koma_dori),
            percent(held),
        );
    }
    let [naka, koma] =
        [middle(clips, |clip| &clip.naka_nashi), middle(clips, |clip| &clip.koma_dori)];
    row(&mut table, "of the middle curve", &naka, &koma, String::new());
    table
}

fn numbers(part: &mut Part, clips: &[Growth]) {
    let mut spread_of = |name: &str, values: Vec<f64>| {
        let [least, middle, most] = spread(values);
        for (word, value) in [("least", least), ("middle", middle), ("most", most)] {
            part.number(&format!("km.growth.{name}.{word}"), number(value, 0));
        }
    };
    let [near, far] = NAKA_NASHI.map(|most| {
        let knee_of = |clip: &Growth| knee(&steps(&clip.naka_nashi[..=most])) as f64;
        clips.iter().map(knee_of).collect::<Vec<_>>()
    });
    spread_of("knee", near);
    spread_of("knee.far", far);
    let within = |clip: &Growth| last_within(&steps(&clip.koma_dori)) as f64;
    spread_of("within", clips.iter().map(within).collect());
    let held = |clip: &Growth| 100.0 * clip.koma_dori[KOMA_DORI].held as f64 / clip.koma as f64;
    spread_of("held", clips.iter().map(held).collect());
    let naka = middle(clips, |clip| &clip.naka_nashi);
    for most in NAKA_NASHI {
        part.number(&format!("km.growth.knee.to{most}"), knee(&naka[..=most]));
    }
    part.number("km.paper.least", PAPER[0]);
    part.number("km.paper.most", PAPER[1]);
    part.number("km.growth.near", NAKA_NASHI[0]);
    part.number("km.growth.far", NAKA_NASHI[1]);
    part.number("km.growth.share", KOMA_DORI);
    part.number("km.growth.clips", clips.len());
    for most in [PAPER[0], PAPER[1], NAKA_NASHI[0]] {
        part.number(&format!("km.growth.step{most}"), number(naka[most], 1));
    }
    part.number("km.growth.last", last_of_rise(&naka).unwrap_or(0));
}
