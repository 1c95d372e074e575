//! A long take is split into its actions: with the built program, and on every real clip.

use genga::edits::Edits;
use genga::keys::{Matching, SplitReason};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::Frame;
use genga_lab::study::Noise;

use crate::clips::{self, sample};
use crate::one_motion::every_other_frame;
use crate::rerig::Rerig;

/// The frames of a clip in order.
fn rows(clip: &Clip) -> Vec<&[f64]> {
    clip.rows().collect()
}

/// Concatenates clips of one skeleton.
fn joined(clips: &[&Clip]) -> Clip {
    let values: Vec<f64> = clips.iter().flat_map(|clip| rows(clip).concat()).collect();
    let frames = clips.iter().map(|clip| clip.len()).sum();
    let (skeleton, rate) = (clips[0].skeleton().clone(), clips[0].rate());
    Clip::new(skeleton, rate, Frame(0), frames, values).unwrap()
}

/// A kick, a stand of 1.25 seconds, and a tennis stroke, at 24 frames per second.
pub(crate) fn kick_and_tennis() -> Clip {
    let (kick, tennis) = (sample("kick.bvh"), sample("tennis.bvh"));
    let last = kick.clone().trimmed(kick.last(), Frame(kick.len())).unwrap();
    let stand = joined(&[&last; 30]);
    joined(&[&kick, &stand, &tennis])
}

/// The splits of a clip with the defaults.
fn splits(clip: &Clip) -> Vec<(f64, SplitReason)> {
    let mut engine = Engine::new(clip.clone()).unwrap();
    let actions = engine.find_actions(&Recipe::default(), &Edits::default()).unwrap();
    let seconds = |frame: Frame| (frame.0 - clip.first().0) as f64 / clip.rate().fps();
    actions.splits().iter().map(|split| (seconds(split.frame), split.why)).collect()
}

#[test]
fn two_movements_with_a_stand_between_them_are_two_actions() {
    let found = splits(&kick_and_tennis());
    let [(seconds, why)] = found[..] else { panic!("{found:?}") };
    assert_eq!(why, SplitReason::Rest);
    let frame = 24.0 * seconds;
    assert!((85.0..122.0).contains(&frame), "{frame}");
}

#[test]
fn the_samples_are_one_action_each() {
    for name in ["pitch", "kick", "tennis", "swing"] {
        assert_eq!(splits(&sample(&format!("{name}.bvh"))), [], "{name}");
    }
}

/// Seconds at which a clip is split.
fn seconds(clip: &Clip) -> Vec<f64> {
    splits(clip).into_iter().map(|(at, _)| at).collect()
}

/// Applies `find` to each of the real clips, by name.
fn on_real_clips(find: impl Fn(&Clip) -> Vec<f64>) -> Vec<(String, Vec<f64>)> {
    let of = |path: std::path::PathBuf| (clips::name(&path), find(&clips::read(&path)));
    clips::all().into_iter().map(of).collect()
}

/// Checks that the splits of all real clips agree within a koma with those found by `otherwise` (F1).
fn agree_on_real_clips(least: f64, otherwise: impl Fn(&Clip) -> Vec<f64>) {
    clips::with_all(|_| agree(least, otherwise));
}

fn agree(least: f64, otherwise: impl Fn(&Clip) -> Vec<f64>) {
    let fine = |seconds: &Vec<f64>| -> Vec<Frame> {
        seconds.iter().map(|at| Frame((2400.0 * at).round() as usize)).collect()
    };
    let (mut kept, mut all) = (0.0, 0);
    let (plain, other) = (on_real_clips(seconds), on_real_clips(otherwise));
    for ((_, plain), (_, other)) in plain.iter().zip(&other) {
        let count = plain.len() + other.len();
        if count > 0 {
            kept += Matching::between(&fine(plain), &fine(other), 101.0).kept() * count as f64;
        }
        all += count;
    }
    assert!(all > 0, "no take is split: {plain:?} {other:?}");
    let share = kept / all as f64;
    assert!(share >= least, "{share:.3}: {plain:?} {other:?}");
}

#[test]
fn long_takes_are_split_and_single_movements_are_not() {
    for (name, found) in on_real_clips(seconds) {
        let expected = match &name[..] {
            "cmu-01_06-playground-long" => 4..=9,
            "cmu-02_05-punch-strike" | "cmu-02_07-swordplay" => 2..=6,
            "cmu-135_04-front-kick" | "optitrack-arena-louise" => 3..=6,
            "cmu-131_03-start-hop-stop" | "rokoko-jesse-dance" => 0..=2,
            _ => 0..=0,
        };
        assert!(expected.contains(&found.len()), "{name}: {found:?}");
    }
}

#[test]
fn the_karateka_s_kicks_part_in_the_stance_between_them() {
    // Rests and begins of kicks as marked by eye: docs/lab/evidence/events.csv.
    clips::with(["cmu-135_04-front-kick"], |[kicks]| {
        let found = seconds(&clips::read(&kicks));
        let frames: Vec<f64> = found.iter().map(|at| 5.0 + 120.0 * at).collect();
        assert!(frames.iter().any(|frame| (450.0..510.0).contains(frame)), "{frames:?}");
        assert!(frames.iter().any(|frame| (680.0..745.0).contains(frame)), "{frames:?}");
    });
}

#[test]
fn half_the_rate_parts_a_take_at_the_same_places() {
    agree_on_real_clips(0.9, |clip| seconds(&every_other_frame(clip)));
}

#[test]
fn a_little_noise_parts_a_take_at_the_same_places() {
    agree_on_real_clips(0.9, |clip| seconds(&Noise { degrees: 0.1, seed: 1 }.on(clip)));
}

#[test]
fn another_rig_parts_a_take_at_the_same_places() {
    let rerig = Rerig { first_order: 4, other_axes: true, scale: 2.54 };
    agree_on_real_clips(1.0, |clip| seconds(&rerig.apply(clip)));
}

#[test]
fn backwards_a_take_parts_at_the_same_places() {
    let backwards = |clip: &Clip| {
        let values: Vec<f64> = rows(clip).into_iter().rev().flatten().copied().collect();
        Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), clip.len(), values).unwrap()
    };
    let mirrored = |clip: &Clip| {
        let seconds = clip.len() as f64 / clip.rate().fps();
        let found = splits(&backwards(clip));
        found.into_iter().rev().map(|(at, _)| seconds - at).collect()
    };
    agree_on_real_clips(0.9, mirrored);
}

#[test]
fn a_walk_and_a_dance_that_are_joined_part_within_a_second_of_where_they_meet() {
    clips::with(["cmu-07_01-walk", "cmu-05_11-dance-pirouette"], |paths| {
        let [walk, dance] = paths.map(|path| clips::read(&path));
        parts_where_they_meet(&walk, &dance);
    });
}

fn parts_where_they_meet(walk: &Clip, dance: &Clip) {
    // The dance begins where the walk ends, and the body takes 0.4 s to get into it: a step in one frame would be
    // faster than everything else.
    let (end, begin) = (walk.row(walk.last()), dance.row(dance.first()));
    let way = |column: usize| match column {
        0..3 => 0.0,
        _ => (begin[column] - end[column] + 180.0).rem_euclid(360.0) - 180.0,
    };
    let mut values = rows(walk).concat();
    for step in 1..48 {
        let share = f64::from(step) / 48.0;
        values.extend((0..end.len()).map(|column| end[column] + share * way(column)));
    }
    for row in dance.rows() {
        let carried = |(column, value): (usize, &f64)| match column {
            0..3 => value + end[column] - begin[column],
            _ => *value,
        };
        values.extend(row.iter().enumerate().map(carried));
    }
    let frames = walk.len() + 47 + dance.len();
    let take = Clip::new(walk.skeleton().clone(), walk.rate(), Frame(0), frames, values).unwrap();
    let found = splits(&take);
    let met = (walk.len() + 24) as f64 / 120.0;
    assert!(found.iter().any(|(at, _)| (at - met).abs() < 1.0), "{found:?}, met at {met}");
}

mod by_the_program {
    use std::fs;

    use genga::motion::bvh;

    use super::*;
    use crate::program::{Place, column};

    /// A place that contains the take.
    fn place() -> Place {
        let place = Place::new();
        fs::write(place.path("take.bvh"), bvh::write(&kick_and_tennis())).unwrap();
        place
    }

    fn read(place: &Place, file: &str) -> String {
        fs::read_to_string(place.path(file)).unwrap()
    }

    /// The motion rows of a BVH as text.
    fn motion(text: &str) -> Vec<&str> {
        let (_, motion) = text.split_once("Frame Time:").unwrap();
        motion.lines().skip(1).collect()
    }

    #[test]
    fn without_a_folder_the_actions_are_only_listed() {
        let place = place();
        let table = place.done("split take.bvh");
        let lines: Vec<_> = table.lines().collect();
        assert!(lines[0].starts_with("action 動作"), "{table}");
        assert!(lines[1].contains("the clip クリップの頭"), "{table}");
        assert!(lines[2].contains("a rest 止め"), "{table}");
        assert_eq!((lines.len(), place.files("").len()), (3, 1), "{table}");
    }

    #[test]
    fn the_parts_hold_every_row_of_the_take_to_the_digit() {
        let place = place();
        place.done("split take.bvh --out parts");
        let files = place.files("parts");
        let names: Vec<_> = files.keys().map(String::as_str).collect();
        assert_eq!(names, ["take-01.bvh", "take-02.bvh", "take-actions.csv"]);
        let (take, one, two) = (
            read(&place, "take.bvh"),
            read(&place, "parts/take-01.bvh"),
            read(&place, "parts/take-02.bvh"),
        );
        assert_eq!([motion(&one), motion(&two)].concat(), motion(&take));
        let table = read(&place, "parts/take-actions.csv");
        assert_eq!(column(&table, "file"), ["take-01.bvh", "take-02.bvh"]);
        assert_eq!(column(&table, "why"), ["", "rest"]);
        let [from, past] = ["from_frame", "past_frame"].map(|name| column(&table, name));
        assert_eq!((&from[0][..], &past[0]), ("0", &from[1]));
        assert_eq!(motion(&one).len().to_string(), past[0]);
        assert_eq!(motion(&take).len().to_string(), past[1]);
    }

    #[test]
    fn a_person_s_frames_part_the_take_and_what_an_earlier_split_left_is_named() {
        let place = place();
        place.done("split take.bvh --at 150,40,90 --out parts");
        assert_eq!(place.files("parts").len(), 5);
        let table = read(&place, "parts/take-actions.csv");
        assert_eq!(column(&table, "from_frame"), ["0", "40", "90", "150"]);
        assert_eq!(column(&table, "why"), ["", "asked", "asked", "asked"]);
        let again = place.genga("split take.bvh --at 40 --out parts");
        let said = String::from_utf8(again.stderr).unwrap();
        assert!(said.contains("not of this one: take-03.bvh take-04.bvh"), "{said}");
    }

    #[test]
    fn what_cannot_be_split_is_refused_with_the_way_out() {
        let place = place();
        let refused = |args: &str| place.refused(2, args);
        assert!(refused("split take.bvh --at 0").contains("begins at frame 0 anyway"));
        assert!(refused("split take.bvh --at 9999").contains("frame 9999"));
        assert!(refused("split take.bvh --at 1.5").contains("as in 310"));
        assert!(refused("split take.bvh --out -").contains("without --out it lists"));
        assert!(refused("split take.bvh --set actions.shortest=-1").contains("actions.shortest"));
        assert!(refused("run take.bvh --split 0").contains("leave it out"));
    }

    #[test]
    fn a_run_counts_what_is_left_out_in_each_action_and_shows_where_they_part() {
        let place = place();
        let run = |args: &str, out: &str| {
            let output = place.genga(&format!("run take.bvh --out {out} {args}"));
            assert!(output.status.success(), "{output:?}");
            let report = read(&place, &format!("{out}/report.json"));
            let report: serde_json::Value = serde_json::from_str(&report).unwrap();
            let pictures =
                ["sheet", "speed"].map(|name| read(&place, &format!("{out}/{name}.svg")));
            (report, pictures, String::from_utf8(output.stderr).unwrap())
        };
        let (report, pictures, said) = run("", "found");
        let actions = report["actions"].as_array().unwrap();
        assert_eq!(actions.len(), 2);
        assert_eq!(
            (&actions[0]["why"], &actions[1]["why"]),
            (&serde_json::Value::Null, &"rest".into())
        );
        assert!(said.contains("actions     動作       2, which begin at frames 0, "), "{said}");
        assert!(pictures.iter().all(|picture| picture.contains("区切り")));
        let asked = &report["omission"]["naka_nashi_asked"];
        assert!(asked.as_u64().unwrap() > 6, "{asked}: 6 is for one action");
        let (report, pictures, said) = run("--set actions.split=false", "whole");
        assert!(report.get("actions").is_none() && !said.contains("動作"), "{said}");
        assert!(!pictures.iter().any(|picture| picture.contains("区切り")));
        assert_eq!(report["omission"]["naka_nashi_asked"], 6);
        let (report, ..) = run("--split 60,120", "asked");
        assert_eq!(report["actions"].as_array().unwrap().len(), 3);
        assert!(read(&place, "asked/recipe.toml").contains("splits = [60, 120]"));
        let (again, ..) = run("--recipe asked/recipe.toml", "again");
        assert_eq!(again, report);
        for file in ["sheet.json", "speed.svg", "limited.bvh"] {
            let [one, other] = ["asked", "again"].map(|out| read(&place, &format!("{out}/{file}")));
            assert!(one == other, "{file}");
        }
    }
}
