//! Figures 7 to 10: a ball that rolls from A to B with three inbetweens, spaced by the library.

use std::f64::consts::PI;
use std::fmt::Write;

use genga::keys::{LayerKeys, Wall};
use genga::motion::{Clip, JointId, bvh};
use genga::sheet::Sheet;
use genga::signal::{LowPass, Measure, Signals, Spectrum, Speed, TurnFinder, TurnKind};
use genga::time::{Frame, KOMA_RATE, Span};
use genga::timing::{On, Pace, Spacing};
use genga_plot::SpacingPlot;

use crate::Outcome;
use crate::part::Part;
use crate::table::number;

/// Number of koma from A to B, both included, and frames per second.
const KOMA: usize = 9;
const RATE: f64 = 120.0;

/// Share of the time at which the ball of Fig. 10 is fastest.
const FASTEST: f64 = 0.85;
/// Its speed at A and B, as a share of the added peak speed.
const ROLLS: f64 = 0.25;

/// Makes both pictures and the numbers of the prose.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let even = clip(|share| share)?;
    let sheets = [0.0, 0.3, 0.6].map(|weight| sheet(&even, weight, &[]));
    let rows = [
        ("Fig. 7: even 均等割り, weight 0", &sheets[0]),
        ("Figs 8, 9: weighted 加減速, weight 0.3", &sheets[1]),
        ("the same, weight 0.6", &sheets[2]),
    ];
    part.picture("spacing", SpacingPlot::default().draw(&even, &rows, None, &[])?);

    let late = clip(gone)?;
    let speed = Speed { measure: Measure::Displacement }.measure(&late)?;
    let walls = walls(&speed);
    let weight = Spacing::default().weight;
    let (nearer, walled) = (sheet(&late, weight, &[]), sheet(&late, weight, &walls));
    let rows = [("the nearer key alone", &nearer), ("with the wall 壁", &walled)];
    let root = JointId(0);
    let picture = SpacingPlot::default().draw(&late, &rows, Some((&speed, root)), &walls)?;
    part.picture("spacing-wall", picture);
    let speeds = speed.joint(root);
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    for (name, sheet) in [("even", &sheet(&late, 0.0, &[])), ("nearer", &nearer), ("wall", &walled)]
    {
        let third = sheet.layers[0].drawings[3].source.place();
        let share = speeds[third.round() as usize] / fastest;
        part.number(&format!("kt.wall.{name}"), number(100.0 * share, 0));
    }
    Ok(())
}

/// Makes a clip of a ball that rolls along X; `way` maps the share of the time to the share of the distance.
fn clip(way: impl Fn(f64) -> f64) -> Outcome<Clip> {
    let frames = (KOMA - 1) * (RATE / KOMA_RATE) as usize + 1;
    let mut text = format!(
        "HIERARCHY\nROOT ball\n{{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n\
         End Site\n{{\nOFFSET 0 10 0\n}}\n}}\nMOTION\nFrames: {frames}\nFrame Time: {}\n",
        1.0 / RATE
    );
    for frame in 0..frames {
        writeln!(text, "{} 0 0", 100.0 * way(frame as f64 / (frames - 1) as f64))?;
    }
    Ok(bvh::read(text.as_bytes())?.clip)
}

/// Distance covered by a ball that rolls steadily while its speed swells as a squared sine up to [`FASTEST`], and falls
/// in the same way towards the end.
fn gone(share: f64) -> f64 {
    // Integral of sin²(πx/2a), from 0.
    let swell = |x: f64, a: f64| 0.5 * x - 0.5 * a / PI * libm::sin(PI * x / a) + ROLLS * x;
    let whole = swell(FASTEST, FASTEST) + swell(1.0 - FASTEST, 1.0 - FASTEST);
    let way = match share {
        before if before <= FASTEST => swell(before, FASTEST),
        after => whole - swell(1.0 - after, 1.0 - FASTEST),
    };
    way / whole
}

/// Frames at which the ball stops accelerating, as found by the library.
fn walls(speed: &Signals) -> Vec<Frame> {
    let unfiltered = LowPass { width: Span::Frames(0.0), ..LowPass::default() };
    let speed = unfiltered.apply(&Spectrum::new(speed));
    let turns = TurnFinder::default().find(&speed, 0.0);
    turns[0].iter().filter(|turn| turn.kind == TurnKind::Wall).map(|turn| turn.frame).collect()
}

/// Makes a sheet with three inbetweens between the ends of a clip.
fn sheet(clip: &Clip, weight: f64, walls: &[Frame]) -> Sheet {
    // Three inbetweens fit between balls as close as the paper's only if a drawing may stay for one koma.
    let (on, inbetweens) = (On::every(1), Some(3));
    let spacing = Spacing { on, inbetweens, weight, ..Spacing::default() };
    let walls = walls.iter().map(|frame| Wall { frame: *frame, strength: 1.0 }).collect();
    let keys = LayerKeys { walls, ..LayerKeys::default() };
    let clock = clip.clock(KOMA_RATE);
    let spaced = spacing.place(&keys, clip.skeleton(), clock, KOMA, &Pace::default());
    Sheet::new(clock, vec![spaced.layer])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_late_ball_has_one_wall_where_it_is_fastest_and_the_third_inbetween_before_it() {
        let late = clip(gone).unwrap();
        let speed = Speed { measure: Measure::Displacement }.measure(&late).unwrap();
        let [wall] = walls(&speed)[..] else { panic!("{:?}", walls(&speed)) };
        let share = wall.0 as f64 / (late.len() - 1) as f64;
        assert!((share - FASTEST).abs() < 0.04, "{share}");
        let places = |sheet: &Sheet| -> Vec<f64> {
            sheet.layers[0].drawings.iter().map(|drawing| drawing.source.place()).collect()
        };
        let (nearer, walled) = (sheet(&late, 0.3, &[]), sheet(&late, 0.3, &[wall]));
        assert!(places(&nearer)[3] > 30.0 && places(&walled)[3] < 30.0);
        assert_eq!(places(&nearer)[1], places(&walled)[1]);
    }
}
