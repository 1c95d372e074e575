use std::f64::consts::TAU;
use std::path::Path;

use nalgebra::DMatrix;
use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use crate::motion::bvh;
use crate::real;
use crate::signal::{FilterKind, LowPass, Quantity, Spectrum, Speed};
use crate::time::FrameRate;

const FIRST: usize = 3;

fn signals(fps: f64, unit: Quantity, joints: &[Vec<f64>]) -> Signals {
    let frames = joints.first().map_or(0, Vec::len);
    let values = DMatrix::from_column_slice(frames, joints.len(), &joints.concat());
    Signals { values, unit, rate: FrameRate::new(fps).unwrap(), first: Frame(FIRST) }
}

fn finder(reading: Reading, steady: f64, persistence: f64) -> TurnFinder {
    TurnFinder {
        reading,
        steady: Steady::Acceleration(steady),
        persistence: Span::Frames(persistence),
        side: Side::After,
        ..TurnFinder::default()
    }
}

/// Returns the rows, from 0, of the turns of one kind.
fn rows(turns: &[Turn], kind: TurnKind) -> Vec<usize> {
    turns.iter().filter(|turn| turn.kind == kind).map(|turn| turn.frame.0 - FIRST).collect()
}

fn keys_and_walls(finder: &TurnFinder, fps: f64, speeds: &[f64]) -> (Vec<usize>, Vec<usize>) {
    let turns = &finder.find(&signals(fps, Quantity::Length, &[speeds.to_vec()]), 0.0)[0];
    (rows(turns, TurnKind::Key), rows(turns, TurnKind::Wall))
}

/// The method from its definition, frame by frame and run by run, with nothing clever.
struct Slow<'a> {
    finder: &'a TurnFinder,
    fps: f64,
    delay: f64,
    floor: f64,
    x: &'a [f64],
}

impl Slow<'_> {
    fn s(&self, k: usize) -> i32 {
        let d = self.x[k + 1] - self.x[k];
        let band = match self.finder.steady {
            Steady::Acceleration(size) => size,
            Steady::Share(share) => {
                let mut a: Vec<f64> =
                    self.x.windows(2).map(|w| (w[1] - w[0]).abs() * self.fps).collect();
                a.sort_by(f64::total_cmp);
                share * a[(0.95 * a.len() as f64).ceil() as usize - 1]
            }
        };
        if d.abs() <= self.floor || d.abs() * self.fps <= band {
            0
        } else if d > 0.0 {
            1
        } else {
            -1
        }
    }

    /// Whether frame b is faster than a (for a wall: slower).
    fn beyond(&self, kind: TurnKind, a: usize, b: usize) -> bool {
        match kind {
            TurnKind::Key => self.x[b] - self.x[a] > self.floor,
            TurnKind::Wall => self.x[a] - self.x[b] > self.floor,
        }
    }

    fn all_after(&self, kind: TurnKind, at: usize, m: usize, beyond_clip: bool) -> bool {
        (1..=m).all(
            |m| if at + m < self.x.len() { self.beyond(kind, at, at + m) } else { beyond_clip },
        )
    }

    fn all_before(&self, kind: TurnKind, at: usize, m: usize, beyond_clip: bool) -> bool {
        (1..=m).all(|m| if m <= at { self.beyond(kind, at, at - m) } else { beyond_clip })
    }

    fn rising(&self, kind: TurnKind, at: usize, m: usize) -> bool {
        at + m < self.x.len() && (at..at + m).all(|k| self.beyond(kind, k, k + 1))
    }

    fn literal(&self, m: usize) -> Vec<(usize, TurnKind)> {
        let mut found = vec![];
        for k in 1..=self.x.len() - 2 {
            let kind = match (self.s(k - 1), self.s(k)) {
                (-1, 1) | (0, 1) | (-1, 0) => TurnKind::Key,
                (1, -1) | (1, 0) => TurnKind::Wall,
                _ => continue,
            };
            let confirmed = match self.finder.side {
                Side::After => self.all_after(kind, k, m, false),
                Side::Both => {
                    self.all_after(kind, k, m, false) && self.all_before(kind, k, m, false)
                }
                Side::Rising => self.rising(kind, k, m),
            };
            if confirmed {
                found.push((k, kind));
            }
        }
        found
    }

    fn event(&self, m: usize) -> Vec<(usize, TurnKind)> {
        let last = self.x.len() - 1;
        let m = m.min(self.x.len());
        let inside = |row: f64| row.max(1.0).min(last as f64 - 1.0) as usize;
        let mut found = vec![];
        if (0..last).all(|k| self.s(k) == 0) {
            return found;
        }
        for kind in [TurnKind::Key, TurnKind::Wall] {
            let down = if kind == TurnKind::Key { -1 } else { 1 };
            for i in 0..=last {
                for j in i..=last {
                    let run = (i..j).all(|k| self.s(k) == 0)
                        && (i == 0 || self.s(i - 1) == down)
                        && (j == last || self.s(j) == -down);
                    if !run {
                        continue;
                    }
                    let end = self.all_before(kind, i, m, true);
                    let end_at = inside(i as f64 - (self.delay.round() + 1.0));
                    let start = self.all_after(kind, j, m, true);
                    let start_at = inside(j as f64 + self.delay.round());
                    if i == 0 {
                        if start && j > 0 {
                            found.push((start_at, kind));
                        }
                    } else if j == last {
                        if end && i < last {
                            found.push((end_at, kind));
                        }
                    } else if (j - i) as f64 / self.fps < 2.0 / 24.0 {
                        // The slowest frames: no frame of the run is slower.
                        let slowest: Vec<usize> = (i..=j)
                            .filter(|k| !(i..=j).any(|other| self.beyond(kind, other, *k)))
                            .collect();
                        let (first, last) = (slowest[0], slowest[slowest.len() - 1]);
                        if self.all_after(kind, last, m, true)
                            && self.all_before(kind, first, m, true)
                        {
                            found.push((first, kind));
                        }
                    } else {
                        if end {
                            found.push((end_at, kind));
                        }
                        if start {
                            found.push((start_at, kind));
                        }
                    }
                }
            }
        }
        found.sort();
        found.dedup();
        found
    }
}

#[test]
fn settings_refuse_what_is_no_band_and_no_length() {
    let refused = |finder: TurnFinder, name: &str| {
        let error = finder.validate().unwrap_err().to_string();
        assert!(error.starts_with(name), "{error}");
    };
    let default = TurnFinder::default;
    assert!(default().validate().is_ok());
    for steady in [
        Steady::Acceleration(-1.0),
        Steady::Acceleration(f64::NAN),
        Steady::Acceleration(f64::INFINITY),
        Steady::Share(-0.1),
        Steady::Share(1.1),
        Steady::Share(f64::NAN),
    ] {
        refused(TurnFinder { steady, ..default() }, "turns.steady: ");
    }
    for length in [-1.0, f64::NAN, f64::INFINITY] {
        refused(
            TurnFinder { persistence: Span::Frames(length), ..default() },
            "turns.persistence: ",
        );
        refused(
            TurnFinder { persistence: Span::Seconds(length), ..default() },
            "turns.persistence: ",
        );
    }
    for wrong in ["reading = \"words\"", "side = \"before\"", "steady = -1", "persistance = 5"] {
        assert!(toml::from_str::<TurnFinder>(wrong).is_err(), "{wrong}");
    }
    let text = "reading = \"literal\"\nsteady = \"5%\"\npersistence = 5\nside = \"rising\"";
    let read: TurnFinder = toml::from_str(text).unwrap();
    assert_eq!((read.reading, read.side), (Reading::Literal, Side::Rising));
    assert_eq!((read.steady, read.persistence), (Steady::Share(0.05), Span::Frames(5.0)));
}

#[test]
fn clips_of_up_to_two_frames_have_no_turns() {
    for reading in [Reading::Event, Reading::Literal] {
        for frames in 0..3 {
            let speeds = signals(24.0, Quantity::Angle, &[vec![1.0; frames], vec![2.0; frames]]);
            assert_eq!(finder(reading, 0.0, 1.0).find(&speeds, 2.0), [vec![], vec![]]);
        }
        assert_eq!(
            finder(reading, 0.0, 1.0).find(&signals(24.0, Quantity::Angle, &[]), 2.0),
            [[]; 0]
        );
        let three = keys_and_walls(&finder(reading, 0.0, 1.0), 24.0, &[1.0, 0.0, 1.0]);
        assert_eq!(three, (vec![1], vec![]));
    }
}

#[test]
fn a_joint_that_does_not_change_has_no_turns() {
    for reading in [Reading::Event, Reading::Literal] {
        for speed in [0.0, 5.0] {
            let found = keys_and_walls(&finder(reading, 0.0, 1.0), 24.0, &[speed; 30]);
            assert_eq!(found, (vec![], vec![]));
        }
    }
}

#[test]
fn a_step_is_steady_where_its_acceleration_lies_in_the_band() {
    let steady = |band, speeds: &[f64]| {
        let speeds = signals(10.0, Quantity::Length, &[vec![0.0; speeds.len()], speeds.to_vec()]);
        finder(Reading::Event, band, 1.0).steady_steps(&speeds, &[JointId(1)]).remove(0)
    };
    let speeds = [0.0, 2.0, 3.0, 3.0, 2.0, 0.0];
    assert_eq!(steady(10.0, &speeds), [false, true, true, true, false]);
    assert_eq!(steady(0.0, &speeds), [false, false, true, false, false]);
    assert!(steady(0.0, &[1.0]).is_empty());
    assert!(steady(0.0, &[]).is_empty());
}

#[test]
fn a_sine_has_keys_at_its_minima_and_walls_at_its_maxima() {
    let speed = |row: i32| 2.0 - (TAU * (f64::from(row) - 7.2) / 30.0).cos();
    let speeds: Vec<f64> = (0..150).map(speed).collect();
    for reading in [Reading::Event, Reading::Literal] {
        let found = keys_and_walls(&finder(reading, 0.0, 5.0), 24.0, &speeds);
        assert_eq!(found.0, [7, 37, 67, 97, 127]);
        assert_eq!(found.1, [22, 52, 82, 112, 142]);
    }
}

#[test]
fn the_literal_table_of_signs_is_the_papers() {
    let literal = finder(Reading::Literal, 0.0, 1.0);
    let sign = |slope: i32| f64::from(slope);
    for (before, after, key, wall) in [
        (-1, 1, true, false),
        (0, 1, true, false),
        (-1, 0, true, false),
        (1, -1, false, true),
        (1, 0, false, true),
        (0, -1, false, false),
        (0, 0, false, false),
        (1, 1, false, false),
        (-1, -1, false, false),
    ] {
        let speeds = [9.0, 9.0 + sign(before), 9.0 + sign(before) + sign(after)];
        let turns =
            &literal.candidates(&signals(1.0, Quantity::Length, &[speeds.to_vec()]), 5.0)[0];
        assert_eq!(!rows(turns, TurnKind::Key).is_empty(), key, "{before} {after}");
        assert_eq!(!rows(turns, TurnKind::Wall).is_empty(), wall, "{before} {after}");
    }
}

/// A hold of a second between two movements, at 24 frames a second.
fn stop_and_go() -> Vec<f64> {
    let ramp = (1..=12).map(f64::from);
    ramp.clone().rev().chain([0.0; 24]).chain(ramp).collect()
}

#[test]
fn a_long_pause_has_an_end_and_a_start_and_only_the_start_is_literal() {
    let (speeds, event) = (stop_and_go(), finder(Reading::Event, 0.0, 3.0));
    assert_eq!(keys_and_walls(&event, 24.0, &speeds), (vec![11, 35], vec![]));
    let literal = finder(Reading::Literal, 0.0, 3.0);
    assert_eq!(keys_and_walls(&literal, 24.0, &speeds), (vec![35], vec![]));
}

#[test]
fn a_pause_shorter_than_two_koma_is_one_key_at_its_slowest_frame() {
    let event = finder(Reading::Event, 24.0, 1.0);
    let pause = [9.0, 3.0, 2.5, 2.0, 2.0, 9.0, 9.5];
    assert_eq!(keys_and_walls(&event, 48.0, &pause).0, [3], "1.5 koma");
    let found = keys_and_walls(&event, 24.0, &pause);
    assert_eq!(found.0, [1, 4], "the same 3 frames are 3 koma, and its end is one frame earlier");
}

#[test]
fn a_pause_of_just_two_koma_is_long() {
    let pause = |steps| [vec![9.0], vec![0.0; steps + 1], vec![9.0]].concat();
    for (fps, frames) in [(24.0, 2), (48.0, 4), (60.0, 5), (120.0, 10)] {
        let event = finder(Reading::Event, 0.0, 1.0);
        assert_eq!(keys_and_walls(&event, fps, &pause(frames)).0, [1, 1 + frames], "{fps}");
        assert_eq!(keys_and_walls(&event, fps, &pause(frames - 1)).0, [1], "{fps}");
    }
}

#[test]
fn the_delay_moves_ends_back_and_starts_on_and_leaves_single_keys() {
    let event = finder(Reading::Event, 0.0, 3.0);
    let moved = |speeds: &[f64], delay| {
        rows(
            &event.find(&signals(24.0, Quantity::Length, &[speeds.to_vec()]), delay)[0],
            TurnKind::Key,
        )
    };
    assert_eq!(moved(&stop_and_go(), 2.4), [12 - 3, 35 + 2]);
    assert_eq!(moved(&stop_and_go(), 2.5), [12 - 4, 35 + 3]);
    assert_eq!(moved(&stop_and_go(), 99.0), [1, 46], "never to the clip's first or last frame");
    assert_eq!(moved(&[5.0, 4.0, 3.0, 2.0, 3.0, 4.0, 5.0], 2.0), [3]);
}

#[test]
fn a_filtered_stop_is_found_where_it_was() {
    let speeds = signals(24.0, Quantity::Length, &[stop_and_go()]);
    for width in [3.0, 4.8, 7.0] {
        let filter = LowPass { kind: FilterKind::Box, width: Span::Frames(width) };
        let filtered = filter.apply(&Spectrum::new(&speeds));
        let found = finder(Reading::Event, 0.0, 2.0).find(&filtered, filter.delay(speeds.rate));
        let keys = rows(&found[0], TurnKind::Key);
        assert!(keys[0].abs_diff(11) <= 1 && keys[1].abs_diff(35) <= 1, "{width}: {keys:?}");
        assert_eq!(keys.len(), 2);
    }
}

#[test]
fn the_delay_is_what_a_filter_eats_of_a_hold() {
    // 100 °/s, stopped within 0.1 s, a second of hold, and off again.
    let ramp = (1..=12).map(|step| f64::from(step) / 12.0);
    let speeds = [1.0; 60].into_iter().chain(ramp.clone().rev()).chain([0.0; 120]).chain(ramp);
    let speeds: Vec<f64> =
        speeds.chain([1.0; 60]).map(|speed| (100.0 * speed).to_radians()).collect();
    let speeds = signals(120.0, Quantity::Angle, &[speeds]);
    let keys = |filter: &LowPass, delay| {
        let filtered = filter.apply(&Spectrum::new(&speeds));
        rows(&TurnFinder::default().find(&filtered, delay)[0], TurnKind::Key)
    };
    use FilterKind::{Box, Butterworth, Gaussian, Ideal};
    for kind in [Box, Gaussian, Ideal, Butterworth] {
        let filter = LowPass { kind, width: Span::Frames(12.0) };
        let found = keys(&filter, filter.delay(speeds.rate));
        assert!(found[0].abs_diff(71) <= 2 && found[1].abs_diff(191) <= 2, "{kind:?}: {found:?}");
        let unmoved = keys(&filter, 0.0);
        assert!(unmoved[0] >= 71 + 3 && unmoved[1] <= 191 - 3, "{kind:?}: {unmoved:?}");
    }
}

#[test]
fn a_short_hold_of_equal_frames_is_confirmed() {
    // Four koma of hold at 120 frames a second, of which the filter leaves less than two.
    let movement = |speed: f64| (1..=30).map(move |step| speed * f64::from(step));
    let speeds: Vec<f64> = movement(100.0).rev().chain([0.0; 20]).chain(movement(100.0)).collect();
    let speeds = signals(120.0, Quantity::Length, &[speeds]);
    let filter = LowPass::default();
    let filtered = filter.apply(&Spectrum::new(&speeds));
    let turns = TurnFinder::default().find(&filtered, filter.delay(speeds.rate));
    let keys = rows(&turns[0], TurnKind::Key);
    assert!(keys.len() == 1 && (30..50).contains(&keys[0]), "{keys:?}");
}

#[test]
fn a_pause_inside_an_acceleration_is_a_key_to_the_letter_alone() {
    let speeds = [1.0, 2.0, 3.0, 3.0, 3.0, 3.0, 4.0, 5.0, 6.0];
    assert_eq!(keys_and_walls(&finder(Reading::Event, 0.0, 1.0), 24.0, &speeds), (vec![], vec![]));
    let literal = keys_and_walls(&finder(Reading::Literal, 0.0, 1.0), 24.0, &speeds);
    assert_eq!(literal, (vec![5], vec![]));
}

#[test]
fn what_touches_an_edge_of_the_clip_gives_its_inner_side_alone() {
    let event = finder(Reading::Event, 0.0, 2.0);
    let found = |speeds: &[f64]| keys_and_walls(&event, 24.0, speeds);
    assert_eq!(found(&[0.0, 0.0, 0.0, 0.0, 1.0, 2.0]), (vec![3], vec![]));
    assert_eq!(found(&[2.0, 1.0, 0.0, 0.0, 0.0, 0.0]), (vec![1], vec![]));
    assert_eq!(found(&[5.0, 5.0, 5.0, 5.0, 4.0, 3.0]), (vec![], vec![3]));
    assert_eq!(found(&[3.0, 4.0, 5.0, 5.0, 5.0, 5.0]), (vec![], vec![1]));
    assert_eq!(found(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0]), (vec![], vec![]), "one long movement");
}

#[test]
fn frames_beyond_the_clip_count_against_the_letter_alone() {
    let speeds = [3.0, 2.0, 1.0, 0.0, 1.0, 2.0];
    for persistence in [1.0, 2.0, 3.0, 50.0] {
        let event = keys_and_walls(&finder(Reading::Event, 0.0, persistence), 24.0, &speeds);
        assert_eq!(event, (vec![3], vec![]), "{persistence}");
        let literal = keys_and_walls(&finder(Reading::Literal, 0.0, persistence), 24.0, &speeds);
        assert_eq!(literal.0.len(), usize::from(persistence <= 2.0), "{persistence}");
    }
    let event = finder(Reading::Event, 0.0, 1.0);
    let turns = event.candidates(&signals(24.0, Quantity::Length, &[speeds.to_vec()]), 0.0);
    assert_eq!(turns[0][0].confirmed_for, 6, "the clip's length");
}

#[test]
fn a_steady_band_is_in_degrees_for_angles_and_as_it_is_for_lengths() {
    let speeds = stop_and_go();
    let keys = |unit, steady| {
        finder(Reading::Event, steady, 3.0)
            .find(&signals(24.0, unit, std::slice::from_ref(&speeds)), 0.0)[0]
            .len()
    };
    assert_eq!((keys(Quantity::Length, 23.9), keys(Quantity::Length, 24.1)), (2, 0));
    assert_eq!((keys(Quantity::Ratio, 23.9), keys(Quantity::Ratio, 24.1)), (2, 0));
    let degrees = 24f64.to_degrees();
    assert_eq!(
        (keys(Quantity::Angle, 0.999 * degrees), keys(Quantity::Angle, 1.001 * degrees)),
        (2, 0)
    );
}

#[test]
fn a_share_is_of_the_joints_own_acceleration() {
    let small: Vec<f64> = stop_and_go().iter().map(|speed| speed / 1000.0).collect();
    let both = signals(24.0, Quantity::Angle, &[stop_and_go(), small]);
    let share = |share| TurnFinder { steady: Steady::Share(share), ..TurnFinder::default() };
    let turns = share(0.05).find(&both, 0.0);
    assert_eq!(rows(&turns[0], TurnKind::Key), [11, 35]);
    assert_eq!(rows(&turns[1], TurnKind::Key), [11, 35]);
    assert_eq!(share(1.0).find(&both, 0.0), [vec![], vec![]], "nothing exceeds all of it");
}

#[test]
fn rounding_makes_no_turns_on_a_joint_that_does_not_move() {
    let fast: Vec<f64> = stop_and_go().iter().map(|speed| 1e3 * speed).collect();
    let dust: Vec<f64> = (0..48).map(|row| 1e-7 * f64::from(row % 3)).collect();
    for reading in [Reading::Event, Reading::Literal] {
        let both = signals(24.0, Quantity::Length, &[fast.clone(), dust.clone()]);
        let turns = finder(reading, 0.0, 1.0).candidates(&both, 0.0);
        assert!(!turns[0].is_empty() && turns[1].is_empty(), "{reading:?}");
        let alone = signals(24.0, Quantity::Length, std::slice::from_ref(&dust));
        assert!(!finder(reading, 0.0, 1.0).candidates(&alone, 0.0)[0].is_empty(), "{reading:?}");
    }
}

#[test]
fn faster_means_by_more_than_rounding() {
    let speeds = [2.0, 1.0, 2.0, 1.0 + 5e-10, 2.0, 2.0];
    let turns = finder(Reading::Literal, 0.0, 1.0)
        .candidates(&signals(24.0, Quantity::Length, &[speeds.to_vec()]), 0.0);
    assert_eq!((turns[0][0].frame, turns[0][0].confirmed_for), (Frame(FIRST + 1), 1));
}

#[test]
fn turns_moved_onto_one_frame_are_one_with_the_longer_confirmation() {
    let pause = [0.0; 4];
    let speeds = [&pause[..], &[5.0], &pause, &[9.0, 9.5]].concat();
    let event = finder(Reading::Event, 0.0, 1.0);
    let turns = &event.candidates(&signals(24.0, Quantity::Length, &[speeds]), 1.0)[0];
    let keys: Vec<_> = turns.iter().filter(|turn| turn.kind == TurnKind::Key).collect();
    let frames: Vec<_> = keys.iter().map(|turn| turn.frame.0 - FIRST).collect();
    assert_eq!(frames, [3, 4, 9], "an end from 5 to 3, starts from 3 to 4 and from 8 to 9");
    let turns = &event.candidates(
        &signals(24.0, Quantity::Length, &[[&pause[..], &[5.0], &pause, &[9.0, 9.5]].concat()]),
        20.0,
    )[0];
    let keys: Vec<_> = turns.iter().filter(|turn| turn.kind == TurnKind::Key).collect();
    assert_eq!(keys.len(), 2, "both starts at the last frame but one: {keys:?}");
    assert_eq!((keys[1].frame, keys[1].confirmed_for), (Frame(FIRST + 9), 11));
}

#[test]
fn one_column_of_sums_is_a_signal_like_any_other() {
    let summed: Vec<f64> = stop_and_go().iter().map(|speed| speed * 30.0).collect();
    let layer = signals(24.0, Quantity::Angle, &[summed]);
    let filter = LowPass::default();
    let filtered = filter.apply(&Spectrum::new(&layer));
    let turns = TurnFinder::default().find(&filtered, filter.delay(layer.rate));
    assert_eq!(turns.len(), 1);
    assert_eq!(rows(&turns[0], TurnKind::Key).len(), 2);
}

#[test]
fn on_real_clips_both_readings_equal_their_words() {
    real::with(["cmu-09_01-run", "cmu-10_03-soccer-kick"], |paths| {
        paths.iter().for_each(|path| reads_as_the_words_say(path));
    });
}

fn reads_as_the_words_say(path: &Path) {
    let name = real::name(path);
    let (clip, _) =
        crate::motion::clean::lead_in::strip(bvh::read(&real::bytes(path)).unwrap().clip);
    let speeds = Speed::default().measure(&clip).unwrap();
    let filter = LowPass::default();
    let (filtered, delay) = (filter.apply(&Spectrum::new(&speeds)), filter.delay(speeds.rate));
    let floor = DUST * filtered.values.amax();
    let steady = Steady::Acceleration(100.0);
    for (reading, side, persistence) in [
        (Reading::Event, Side::After, 12),
        (Reading::Event, Side::After, 1),
        (Reading::Literal, Side::After, 5),
        (Reading::Literal, Side::Both, 10),
        (Reading::Literal, Side::Rising, 5),
    ] {
        let span = Span::Frames(persistence as f64);
        let finder =
            TurnFinder { reading, steady, persistence: span, side, ..TurnFinder::default() };
        // The oracle knows no units: its band is in radians.
        let band = Steady::Acceleration(100f64.to_radians());
        let in_radians = TurnFinder { steady: band, ..finder.clone() };
        let fps = clip.rate().fps();
        let mut turns = 0;
        for (joint, found) in finder.find(&filtered, delay).into_iter().enumerate() {
            let x = filtered.joint(JointId(joint));
            let slow = Slow { finder: &in_radians, fps, delay, floor, x };
            let expected = match reading {
                Reading::Event => slow.event(persistence),
                Reading::Literal => slow.literal(persistence),
            };
            let first = clip.first().0;
            let found: Vec<_> =
                found.iter().map(|turn| (turn.frame.0 - first, turn.kind)).collect();
            turns += found.len();
            assert_eq!(found, expected, "{name}, joint {joint}, {finder:?}");
        }
        assert!(turns > 20, "{name}: only {turns} turns, {finder:?}");
    }
}

fn any_side() -> impl Strategy<Value = Side> {
    prop::sample::select(&[Side::After, Side::Both, Side::Rising][..])
}

/// Plateaus, ties and zeros: few values, each for a few frames.
fn stepped() -> impl Strategy<Value = Vec<f64>> {
    let piece = (0..5i32, 1..6usize);
    let pieces = prop::collection::vec(piece, 1..14).prop_map(|pieces| {
        let frames = pieces.into_iter().flat_map(|(value, count)| vec![f64::from(value); count]);
        frames.collect::<Vec<_>>()
    });
    let walk = prop::collection::vec(-2..=2i32, 1..40).prop_map(|steps| {
        let mut value = 20;
        steps
            .into_iter()
            .map(|step| {
                value += step;
                f64::from(value)
            })
            .collect()
    });
    prop_oneof![pieces, walk].prop_filter("three frames", |speeds: &Vec<f64>| speeds.len() > 2)
}

fn any_steady() -> impl Strategy<Value = Steady> {
    prop::sample::select(
        &[
            Steady::Acceleration(0.0),
            Steady::Acceleration(24.0),
            Steady::Acceleration(25.0),
            Steady::Acceleration(60.0),
            Steady::Share(0.05),
            Steady::Share(0.5),
            Steady::Share(1.0),
        ][..],
    )
}

proptest! {
    #![proptest_config(cases(100, 400))]

    #[test]
    fn both_readings_equal_their_words(
        speeds in stepped(),
        steady in any_steady(),
        side in any_side(),
        fps in prop::sample::select(&[24.0, 48.0, 100.0][..]),
        delay in prop::sample::select(&[0.0, 0.4, 1.0, 2.5, 9.0][..]),
    ) {
        for reading in [Reading::Event, Reading::Literal] {
            for m in [1, 2, 3, 5, 8, 30, 500] {
                let finder =
                    TurnFinder { reading, steady, persistence: Span::Frames(m as f64), side, ..TurnFinder::default() };
                let found = finder.find(&signals(fps, Quantity::Length, std::slice::from_ref(&speeds)), delay);
                let found: Vec<_> =
                    found[0].iter().map(|turn| (turn.frame.0 - FIRST, turn.kind)).collect();
                let floor = DUST * speeds.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
                let slow = Slow { finder: &finder, fps, delay, floor, x: &speeds };
                let expected =
                    if reading == Reading::Event { slow.event(m) } else { slow.literal(m) };
                prop_assert_eq!(found, expected, "{:?}", finder);
            }
        }
    }

    #[test]
    fn a_larger_persistence_never_adds_a_turn(
        speeds in prop::collection::vec(0.0..10.0, 3..120),
        steady in any_steady(),
        side in any_side(),
        delay in 0.0..9.0,
    ) {
        let speeds = signals(24.0, Quantity::Length, &[speeds]);
        for reading in [Reading::Event, Reading::Literal] {
            let find = |m: usize| {
                let persistence = Span::Frames(m as f64);
                TurnFinder { reading, steady, persistence, side, ..TurnFinder::default() }.find(&speeds, delay)
            };
            for m in 1..12 {
                let (less, more) = (find(m), find(m + 1));
                prop_assert!(more[0].iter().all(|turn| less[0].contains(turn)));
            }
        }
    }

    #[test]
    fn turns_lie_in_order_strictly_inside_the_clip(
        speeds in stepped(),
        steady in any_steady(),
        delay in 0.0..20.0,
    ) {
        let frames = speeds.len();
        let speeds = signals(24.0, Quantity::Length, &[speeds]);
        for reading in [Reading::Event, Reading::Literal] {
            let finder = TurnFinder { reading, steady, ..TurnFinder::default() };
            let turns = &finder.candidates(&speeds, delay)[0];
            prop_assert!(turns.windows(2).all(|w| (w[0].frame, w[0].kind) < (w[1].frame, w[1].kind)));
            for turn in turns {
                prop_assert!((FIRST + 1..FIRST + frames - 1).contains(&turn.frame.0));
                prop_assert!(turn.confirmed_for <= frames);
            }
        }
    }

    #[test]
    fn a_hill_is_a_valley_upside_down_in_the_event_reading(
        speeds in stepped(),
        steady in any_steady(),
        delay in 0.0..9.0,
    ) {
        let finder = TurnFinder { steady, ..TurnFinder::default() };
        let upside_down: Vec<f64> = speeds.iter().map(|speed| -speed).collect();
        let one = finder.candidates(&signals(48.0, Quantity::Length, &[speeds]), delay);
        let other = finder.candidates(&signals(48.0, Quantity::Length, &[upside_down]), delay);
        prop_assert_eq!(rows(&one[0], TurnKind::Key), rows(&other[0], TurnKind::Wall));
        prop_assert_eq!(rows(&one[0], TurnKind::Wall), rows(&other[0], TurnKind::Key));
    }
}
