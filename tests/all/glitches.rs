//! Every command finds impossible motion: single frames that fly off, a tracker at the origin. A body that never moves
//! gets one drawing.

use std::fs;

use genga::edits::Edits;
use genga::motion::bvh::read;
use genga::motion::clean::glitches;
use genga::motion::{Channel, Clip};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, FrameRate};
use proptest::prelude::*;

use crate::cases::cases;
use crate::program::{Place, column, text};

fn kick() -> Clip {
    let file = crate::clips::here("data/kick.bvh");
    read(&fs::read(file).unwrap()).unwrap().clip
}

/// Changes some values of a clip, given as row, column and difference.
fn thrown(clip: &Clip, off: &[(usize, usize, f64)]) -> Clip {
    let width = clip.skeleton().channels();
    let mut values: Vec<f64> = clip.rows().flatten().copied().collect();
    for (row, column, way) in off {
        values[row * width + column] += way;
    }
    Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), clip.len(), values).unwrap()
}

/// The columns of joint rotations.
fn turning(clip: &Clip) -> Vec<usize> {
    let joints = clip.skeleton().joints.iter();
    let of = |joint: &genga::motion::Joint| {
        let first = joint.first_channel;
        let turns = |(at, channel): (usize, &Channel)| {
            matches!(channel, Channel::Rotation(_)).then_some(first + at)
        };
        joint.channels.iter().enumerate().filter_map(turns).collect::<Vec<_>>()
    };
    joints.flat_map(of).collect()
}

/// The joint that a column belongs to.
fn joint_of(clip: &Clip, column: usize) -> &genga::motion::Joint {
    let is_of = |joint: &&genga::motion::Joint| {
        (joint.first_channel..joint.first_channel + joint.channels.len()).contains(&column)
    };
    clip.skeleton().joints.iter().find(is_of).unwrap()
}

#[test]
fn a_frame_that_flies_off_is_replaced_with_a_note_unless_it_is_to_be_kept() {
    let place = Place::new();
    let clip = kick();
    let off = thrown(&clip, &[(40, turning(&clip)[9], 150.0), (70, 0, 300.0)]);
    fs::write(place.path("off.bvh"), genga::motion::bvh::write(&off)).unwrap();
    let said = text(&place.genga("run off.bvh --out mended").stderr);
    assert!(said.contains("[W_GLITCH]") && said.contains("--keep-glitches"), "{said}");
    assert!(said.contains("frame 40 flies off for a single frame (the first of 2)"), "{said}");
    let kept = text(&place.genga("run off.bvh --out kept --keep-glitches").stderr);
    assert!(!kept.contains("W_GLITCH"), "{kept}");
    let (mended, kept) = (place.path("mended/limited.bvh"), place.path("kept/limited.bvh"));
    assert_ne!(fs::read(&mended).unwrap(), fs::read(kept).unwrap());
    // The genga are those of the kick without a fault. A repaired frame halfway between its neighbours is not the
    // original pose, so a genga near it may move by a frame.
    let frames = |clip: &str| -> Vec<f64> {
        let frames = column(&place.done(&format!("keys {clip}")), "source_frame");
        frames.iter().map(|frame| frame.parse().unwrap()).collect()
    };
    let (found, sound) = (frames("off.bvh"), frames("data/kick.bvh"));
    assert_eq!(found.len(), sound.len());
    assert!(found.iter().zip(&sound).all(|(a, b)| (a - b).abs() <= 1.0), "{found:?} {sound:?}");
    // Delivering a sheet uses the same repaired motion.
    let made = fs::read(&mended).unwrap();
    fs::remove_file(&mended).unwrap();
    place.done("deliver mended/sheet.json off.bvh --to bvh");
    assert_eq!(fs::read(&mended).unwrap(), made);
    let said = text(&place.genga("inspect off.bvh --warnings").stdout);
    assert!(said.contains("W_GLITCH"), "{said}");
    assert!(place.genga("run off.bvh --strict --out strict").status.success());
}

#[test]
fn ends_at_which_the_tracker_is_at_the_origin_are_left_out_unless_they_are_to_be_kept() {
    let place = Place::new();
    let clip = kick();
    let width = clip.skeleton().channels();
    let mut values: Vec<f64> = clip.rows().flatten().copied().collect();
    let last = clip.len() - 1;
    for (row, share) in [(0, 0.0), (1, 0.3), (2, 0.6), (last - 1, 0.5), (last, 0.0)] {
        values[row * width..row * width + 3].iter_mut().for_each(|place| *place *= share);
    }
    let ramped =
        Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), clip.len(), values).unwrap();
    fs::write(place.path("ramped.bvh"), genga::motion::bvh::write(&ramped)).unwrap();
    let out = place.genga("run ramped.bvh --out cleaned");
    let said = text(&out.stderr);
    let expected = format!("frames 0 to 2 and frames {} to {last}: the tracker", last - 1);
    assert!(said.contains(&expected), "{said}");
    let frames =
        column(&fs::read_to_string(place.path("cleaned/keys.csv")).unwrap(), "source_frame");
    let ends = (frames.first().unwrap().as_str(), frames.last().unwrap().as_str());
    assert_eq!(ends, ("3", &*(last - 2).to_string()));
    let kept = text(&place.genga("run ramped.bvh --out kept --keep-glitches").stderr);
    assert!(!kept.contains("W_RAMP"), "{kept}");
    place.done("deliver cleaned/sheet.json ramped.bvh --to bvh --out again");
    let bytes = |file: &str| fs::read(place.path(file)).unwrap();
    assert_eq!(bytes("again/limited.bvh"), bytes("cleaned/limited.bvh"));
}

/// A body that never moves needs one drawing. The end is a separate row in every table.
#[test]
fn a_body_that_never_moves_gets_one_drawing() {
    for fps in [24.0, 30.0, 60.0, 120.0] {
        for tremble in [0.0, 0.01] {
            let clip = still(fps, tremble);
            let mut engine = Engine::new(clip).unwrap();
            let result = engine.run(&Recipe::default(), &Edits::default()).unwrap();
            let drawings = result.sheet.layers[0].drawings.len();
            assert_eq!(drawings, 1, "{fps} frames a second, {tremble} degrees");
        }
    }
}

/// Three seconds of the kick's first pose, in which every joint trembles with the given amplitude in degrees.
fn still(fps: f64, tremble: f64) -> Clip {
    let clip = kick();
    let frames = (3.0 * fps) as usize;
    let turning = turning(&clip);
    let mut values = Vec::new();
    for frame in 0..frames {
        let mut row = clip.row(Frame(0)).to_vec();
        for (at, column) in turning.iter().enumerate() {
            let hertz = 3.0 + (at * 37 % 61) as f64 / 10.0;
            let seconds = frame as f64 / fps;
            row[*column] += tremble * (std::f64::consts::TAU * hertz * seconds + at as f64).sin();
        }
        values.extend(row);
    }
    let rate = FrameRate::new(fps).unwrap();
    Clip::new(clip.skeleton().clone(), rate, Frame(0), frames, values).unwrap()
}

proptest! {
    #![proptest_config(cases(8, 64))]

    /// Any joint thrown out of a sound clip for a frame is found, in that frame alone, and the sound frames stay as
    /// they are. Around it the joint turns less than a sixth of the throw.
    #[test]
    fn frames_that_are_thrown_are_found_and_no_others(
        rows in prop::collection::btree_set(1_usize..8, 1..4),
        column in 0_usize..60,
        degrees in prop_oneof![-179.0..-120.0, 120.0..179.0],
    ) {
        let clip = kick();
        let turning = turning(&clip);
        let column = turning[column % turning.len()];
        let rows: Vec<usize> = rows.into_iter().map(|at| 10 * at).collect();
        let step = |row: usize| {
            let of = |row: usize| genga::motion::local_rotation(joint_of(&clip, column), clip.row(Frame(row)));
            of(row).angle_between(of(row + 1)).to_degrees()
        };
        let is_slow = |row: &usize| (row - 6..row + 6).all(|row| step(row) < 12.0);
        prop_assume!(rows.iter().all(is_slow));
        let off: Vec<_> = rows.iter().map(|row| (*row, column, degrees)).collect();
        let off = thrown(&clip, &off);
        let expected: Vec<Frame> = rows.iter().map(|row| Frame(*row)).collect();
        prop_assert_eq!(glitches::find(&off), expected);
        let (mended, note) = glitches::mend(off);
        prop_assert!(note.is_some());
        prop_assert_eq!(glitches::find(&mended), vec![]);
        for (row, (was, is)) in clip.rows().zip(mended.rows()).enumerate() {
            prop_assert!(rows.contains(&row) || was == is);
        }
    }

    /// However fast a joint goes from pose to pose, held or not, it is no glitch.
    #[test]
    fn what_goes_somewhere_or_stays_there_is_no_glitch(
        row in 12_usize..70,
        stays in 2_usize..12,
        column in 0_usize..60,
        degrees in 20.0..170.0_f64,
    ) {
        let clip = kick();
        let turning = turning(&clip);
        let column = turning[column % turning.len()];
        let moved: Vec<_> = (row..row + stays).map(|row| (row, column, degrees)).collect();
        prop_assert_eq!(glitches::find(&thrown(&clip, &moved)), vec![]);
    }
}
