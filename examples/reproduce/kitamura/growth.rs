//! §4, "more than 6 and it jumps" and "a third is right": measures the effect of growing either number.

mod knee;
mod picture;

use genga::timing::Omission;

use crate::Outcome;
use crate::kitamura::Window;
use crate::kitamura::growth::knee::{knee, last_within};
use crate::ones::{Ones, counts};
use crate::part::Part;
use crate::table::{Table, number, spread};

/// Largest number left out that is shown, and largest that is tried. A knee that moves with the range is no knee.
const NAKA_NASHI: [usize; 2] = [12, 24];
/// Numbers left out that the paper finds right.
const PAPER: [usize; 2] = [4, 6];
/// Largest share held, in %.
const KOMA_DORI: usize = 60;
/// Step between rows of the koma-dori table, in %.
const EACH: usize = 10;
/// Header of both tables' second column.
const STEP: &str = ">largest step, times";

/// The effect of one stage's number on a clip, without the other stage.
struct Effect {
    /// Largest step from koma to koma, √SSD, relative to the source.
    step: f64,
    /// Number of koma held.
    held: usize,
}

impl Effect {
    fn new(ones: &Ones, settings: &Omission) -> Outcome<Self> {
        let done = ones.omit(settings)?;
        Ok(Self { step: (done.peak / ones.peak()).sqrt(), held: done.held() })
    }
}

/// The effects on a clip as more and more is left out, and as more and more is held.
struct Growth {
    koma: usize,
    naka_nashi: Vec<Effect>,
    koma_dori: Vec<Effect>,
}

impl Growth {
    fn new(ones: &Ones) -> Outcome<Self> {
        let held = |share: usize| (share as f64 / 100.0 * ones.koma() as f64).round() as usize;
        let naka_nashi = (0..=NAKA_NASHI[1]).map(|most| Effect::new(ones, &counts(most, 0)));
        let koma_dori = (0..=KOMA_DORI).map(|share| Effect::new(ones, &counts(0, held(share))));
        Ok(Self {
            koma: ones.koma(),
            naka_nashi: naka_nashi.collect::<Outcome<_>>()?,
            koma_dori: koma_dori.collect::<Outcome<_>>()?,
        })
    }
}

fn steps(effects: &[Effect]) -> Vec<f64> {
    effects.iter().map(|effect| effect.step).collect()
}

/// The median step over all clips.
fn middle(clips: &[Growth], of: fn(&Growth) -> &[Effect]) -> Vec<f64> {
    let at = |number: usize| spread(clips.iter().map(|clip| of(clip)[number].step))[1];
    (0..of(&clips[0]).len()).map(at).collect()
}

/// Makes the tables, the picture and the numbers of the prose.
pub(super) fn add(part: &mut Part, windows: &[Window<'_>]) -> Outcome<()> {
    let clips = windows.iter().map(|window| Growth::new(&window.ones));
    let clips = clips.collect::<Outcome<Vec<_>>>()?;
    part.table("growth-naka-nashi", naka_nashi(&clips));
    part.table("growth-koma-dori", koma_dori(&clips));
    part.picture("growth", picture::draw(&clips)?);
    numbers(part, &clips);
    Ok(())
}

fn naka_nashi(clips: &[Growth]) -> Table {
    let mut table = Table::new(&[">N_io", STEP]);
    let steps = middle(clips, |clip| &clip.naka_nashi);
    for (most, step) in steps[..=NAKA_NASHI[0]].iter().enumerate() {
        table.row(&[most.to_string(), number(*step, 2)]);
    }
    table
}

fn koma_dori(clips: &[Growth]) -> Table {
    let mut table = Table::new(&[">N_hf", STEP]);
    let steps = middle(clips, |clip| &clip.koma_dori);
    for (share, step) in steps.iter().enumerate().step_by(EACH) {
        table.row(&[format!("{share} %"), number(*step, 2)]);
    }
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
    part.number("km.growth.clips", clips.len());
    for most in [PAPER[0], PAPER[1], NAKA_NASHI[0]] {
        part.number(&format!("km.growth.step{most}"), number(naka[most], 1));
    }
}
