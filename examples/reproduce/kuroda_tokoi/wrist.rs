//! Figures 2, 3, 4 and 6: the skeleton, and the left wrist's speed from the capture to its keys.

use genga::signal::{Side, Signals, Spectrum, Speed, Turn, TurnKind};
use genga_plot::{SkeletonPlot, SpeedCurves, SpeedPlot};

use super::readings::{STUDY, Way};
use crate::part::Part;
use crate::table::Table;
use crate::{Outcome, samples};

/// Joint of the left wrist, and the paper's keys of it.
const WRIST: &str = "LeftHand";
const PAPER: [usize; 5] = [12, 150, 251, 397, 473];

/// The paper's filter range of Fig. 4, and the persistence. The paper states none for it, so the shorter one of its
/// table is used.
const RANGE: f64 = 20.0;
const PERSISTENCE: f64 = 5.0;

/// Makes the pictures, the wrist's keys, and the numbers of the prose.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let clip = samples::clip("kuroda-pitch")?;
    part.picture("skeleton", SkeletonPlot::default().draw("kuroda-pitch", &clip)?);
    part.number("kt.joints", clip.skeleton().len());
    part.number("kt.frames", clip.len());
    part.number("kt.rate", clip.rate());
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    let wrist = clip.skeleton().find(WRIST).ok_or("the sample has no left wrist")?;
    let speed = Speed::default().measure(&clip)?;
    let spectrum = Spectrum::new(&speed);
    let filtered = STUDY.filter(RANGE).apply(&spectrum);
    let turns = keys(STUDY, &filtered);
    let none = vec![Vec::new(); names.len()];
    for (name, curves, turns) in [
        ("speed-measured", SpeedCurves::Measured, &none),
        ("speed-filtered", SpeedCurves::Filtered, &none),
        ("speed-keys", SpeedCurves::Kept, &turns),
    ] {
        let plot = SpeedPlot { height: 320, joints: 1, curves, ..SpeedPlot::default() };
        part.picture(name, plot.draw(&names, &speed, &filtered, turns, &[], &[wrist])?);
    }
    let mut table = Table::new(&["left wrist, W = 20", ">keys", "frames"]);
    table.row(&row("the paper", &PAPER));
    for (words, way) in
        [("the words of §3.3", STUDY), ("M rising", Way { side: Side::Rising, ..STUDY })]
    {
        table.row(&row(words, &frames(&keys(way, &filtered)[wrist.0])));
    }
    part.table("left-wrist", table);
    part.number("kt.wrist.range", RANGE);
    part.number("kt.wrist.persistence", PERSISTENCE);
    part.number("kt.wrist.paper", PAPER.len());
    part.number("kt.wrist.keys", turns[wrist.0].len());
    part.number("kt.wrist.valleys.measured", valleys(speed.joint(wrist)));
    part.number("kt.wrist.valleys.filtered", valleys(filtered.joint(wrist)));
    Ok(())
}

/// Finds each joint's keys with one way of reading.
fn keys(way: Way, filtered: &Signals) -> Vec<Vec<Turn>> {
    let mut turns = way.finder(PERSISTENCE).find(filtered, 0.0);
    turns.iter_mut().for_each(|turns| turns.retain(|turn| turn.kind == TurnKind::Key));
    turns
}

fn frames(turns: &[Turn]) -> Vec<usize> {
    turns.iter().map(|turn| turn.frame.0).collect()
}

fn row(words: &str, frames: &[usize]) -> [String; 3] {
    let list: Vec<String> = frames.iter().map(usize::to_string).collect();
    [words.into(), frames.len().to_string(), list.join(", ")]
}

/// Number of local minima of a speed.
fn valleys(speed: &[f64]) -> usize {
    speed.windows(3).filter(|three| three[1] < three[0] && three[1] < three[2]).count()
}
