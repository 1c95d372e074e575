use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use crate::motion::{Axis, Beside, CameraPath, Channel, EndSite, Joint, Skeleton};
use crate::time::{Frame, FrameRate};

/// A still body at the origin, 100 frames at 24 a second, and a camera.
fn clip(frames: usize, pose: impl Fn(f64) -> CameraPose) -> Clip {
    let joint = Joint {
        name: "hips".into(),
        parent: None,
        offset: DVec3::ZERO,
        channels: vec![Channel::Rotation(Axis::X)],
        first_channel: 0,
        end_sites: vec![EndSite { name: "Site".into(), offset: DVec3::ZERO }],
    };
    let rate = FrameRate::new(24.0).unwrap();
    let skeleton = Skeleton { joints: vec![joint] };
    let clip = Clip::new(skeleton, rate, Frame(0), frames, vec![0.0; frames]).unwrap();
    let poses = (0..frames).map(|frame| pose(frame as f64)).collect();
    let camera = Some(CameraPath { name: "cut".into(), poses });
    clip.with_beside(Beside::new(camera))
}

fn pose(place: DVec3, degrees: [f64; 3], height: f64) -> CameraPose {
    let [yaw, pitch, roll] = degrees.map(f64::to_radians);
    let turn = DQuat::from_euler(glam::EulerRot::YXZ, yaw, pitch, roll);
    CameraPose { place, turn, lens: Lens::Perspective(height) }
}

fn camera_work(clip: &Clip, sheet: &Sheet) -> Vec<CameraWork> {
    Filmed::new(clip).map_or_else(Vec::new, |filmed| filmed.work(sheet))
}

/// The camera work on a sheet on ones: first koma, koma after the last, words.
fn work(frames: usize, pose: impl Fn(f64) -> CameraPose) -> Vec<(usize, usize, String)> {
    let clip = clip(frames, pose);
    let work = camera_work(&clip, &Sheet::on_ones(clip.clock(24.0), frames));
    assert!(work.iter().all(|work| work.is_guess));
    work.into_iter().map(|work| (work.begin, work.past(), work.words)).collect()
}

/// Goes evenly from 0 to 1 between two frames.
fn between(frame: f64, from: f64, to: f64) -> f64 {
    ((frame - from) / (to - from)).clamp(0.0, 1.0)
}

/// The same with an ease at both ends.
fn eased(frame: f64, from: f64, to: f64) -> f64 {
    let share = between(frame, from, to);
    share * share * (3.0 - 2.0 * share)
}

fn found(work: &[(usize, usize, String)]) -> Vec<(usize, usize, &str)> {
    work.iter().map(|(begin, past, words)| (*begin, *past, words.as_str())).collect()
}

/// Five units in front of the body.
const AT: DVec3 = DVec3::new(0.0, 0.0, 5.0);

#[test]
fn every_movement_of_a_camera_has_its_name_and_its_koma() {
    let way = |frame: f64| between(frame, 24.0, 72.0);
    let of = |pose: &dyn Fn(f64) -> CameraPose| work(100, |frame| pose(way(frame)));
    let moves: [(&str, &dyn Fn(f64) -> CameraPose); 10] = [
        ("PAN", &|way| pose(AT, [20.0 * way, 0.0, 0.0], 1.0)),
        ("PAN", &|way| pose(AT, [0.0, -10.0 * way, 0.0], 1.0)),
        ("PAN", &|way| pose(AT + way * DVec3::X, [0.0; 3], 1.0)),
        ("PAN", &|way| pose(AT + way * DVec3::Y, [0.0; 3], 1.0)),
        ("T.U", &|way| pose(AT - 2.0 * way * DVec3::Z, [0.0; 3], 1.0)),
        ("T.B", &|way| pose(AT + 2.0 * way * DVec3::Z, [0.0; 3], 1.0)),
        ("T.U", &|way| pose(AT, [0.0; 3], 1.0 - 0.4 * way)),
        ("T.B", &|way| pose(AT, [0.0; 3], 1.0 + 0.4 * way)),
        ("回転", &|way| pose(AT, [0.0, 0.0, 15.0 * way], 1.0)),
        ("PAN + T.U", &|way| pose(AT - 2.0 * way * DVec3::Z, [20.0 * way, 0.0, 0.0], 1.0)),
    ];
    for (at, (words, pose)) in moves.into_iter().enumerate() {
        let all = of(pose);
        assert_eq!(all.len(), 1, "{at}: {all:?}");
        let (begin, past, said) = &all[0];
        assert_eq!(said, words, "{at}");
        assert!(begin.abs_diff(24) <= 3 && past.abs_diff(72) <= 3, "{at}: {all:?}");
    }
    let even = of(&|way| pose(AT + way * DVec3::X, [0.0; 3], 1.0));
    assert_eq!(found(&even), [(24, 72, "PAN")], "to the koma");
}

#[test]
fn a_still_camera_and_one_that_shakes_give_nothing() {
    assert!(work(100, |_| pose(AT, [10.0, 5.0, 0.0], 1.0)).is_empty());
    // Half a percent of the picture, as a hand or a tracker shakes.
    let lots = |frame: f64| (frame * 12.9898).sin() * 43758.5453 % 1.0;
    let shaken = |frame: f64| pose(AT + 0.02 * lots(frame) * DVec3::X, [0.0; 3], 1.0);
    assert!(work(400, shaken).is_empty());
    // A fifth of the picture to and fro from koma to koma: a blow, and no camera work.
    let blow = |frame: f64| pose(AT + (frame % 2.0) * DVec3::Y, [0.0; 3], 1.0);
    assert!(work(100, |frame| if frame < 50.0 { blow(frame) } else { blow(0.0) }).is_empty());
}

#[test]
fn a_pan_is_found_under_a_shake_and_a_slow_one_too() {
    let lots = |frame: f64| (frame * 12.9898).sin() * 43758.5453 % 1.0;
    let pan = |frame: f64| eased(frame, 30.0, 90.0) + 0.02 * lots(frame);
    let all = work(150, |frame| pose(AT + pan(frame) * DVec3::X, [0.0; 3], 1.0));
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(all[0].0.abs_diff(30) <= 9 && all[0].1.abs_diff(90) <= 9, "{all:?}");
    // A tenth of the picture in ten seconds.
    let slow = work(240, |frame| pose(AT * (1.0 - 0.1 * frame / 240.0), [0.0; 3], 1.0));
    assert_eq!(found(&slow), [(0, 240, "T.U")]);
}

#[test]
fn a_long_movement_is_one_and_a_long_shake_takes_no_time() {
    let long = work(5000, |frame| pose(AT + 0.002 * frame * DVec3::X, [0.0; 3], 1.0));
    assert_eq!(found(&long), [(0, 5000, "PAN")]);
    let shake = |frame: f64| pose(AT + (frame % 2.0) * DVec3::Y, [0.0; 3], 1.0);
    assert!(work(20_000, shake).is_empty());
}

#[test]
fn movements_one_after_another_stand_one_after_another() {
    let camera = |frame: f64| {
        let (pan, near) = (between(frame, 10.0, 70.0), between(frame, 40.0, 100.0));
        pose(AT + 2.0 * pan * DVec3::X - 2.0 * near * DVec3::Z, [0.0; 3], 1.0)
    };
    let all = work(120, camera);
    let words: Vec<&str> = all.iter().map(|(_, _, words)| words.as_str()).collect();
    assert_eq!(words, ["PAN", "PAN + T.U", "T.U"], "{all:?}");
    assert!(all.windows(2).all(|pair| pair[0].1 == pair[1].0), "{all:?}");
    assert!(all[1].0.abs_diff(40) <= 2 && all[1].1.abs_diff(70) <= 2, "{all:?}");
}

#[test]
fn a_cut_is_no_movement_and_what_comes_before_and_after_it_is() {
    let camera = |frame: f64| {
        let place = if frame < 50.0 { frame / 50.0 } else { 30.0 };
        pose(AT + place * DVec3::X, [0.0; 3], 1.0)
    };
    assert_eq!(found(&work(100, camera)), [(0, 50, "PAN")]);
    let back = |frame: f64| {
        let place = if frame < 50.0 { frame / 50.0 } else { 30.0 - frame / 50.0 };
        pose(AT + place * DVec3::X, [0.0; 3], 1.0)
    };
    assert_eq!(found(&work(100, back)), [(0, 50, "PAN"), (50, 100, "PAN")], "two shots");
}

#[test]
fn the_koma_are_those_of_the_sheet_s_time() {
    let clip = clip(100, |frame| pose(AT + between(frame, 40.0, 60.0) * DVec3::X, [0.0; 3], 1.0));
    let mut sheet = Sheet::on_ones(clip.clock(24.0), 100);
    // The first twenty frames are left out, so everything comes twenty koma earlier.
    sheet.layers[0].exposures.drain(..20);
    let work = camera_work(&clip, &sheet);
    assert_eq!((work[0].begin, work[0].past()), (20, 40));
    assert!(camera_work(&clip, &Sheet::on_ones(clip.clock(24.0), 30)).is_empty());
    let bare = clip.with_beside(Beside::default());
    assert!(camera_work(&bare, &sheet).is_empty());
}

#[test]
fn an_orthographic_camera_comes_no_nearer_and_sees_less() {
    let flat = |place, height| CameraPose {
        lens: Lens::Orthographic(height),
        ..pose(place, [0.0; 3], 1.0)
    };
    assert!(work(100, |frame| flat(AT - 0.02 * frame * DVec3::Z, 5.0)).is_empty());
    let near = work(100, |frame| flat(AT, 5.0 - 0.02 * frame));
    assert_eq!(found(&near), [(0, 100, "T.U")]);
    let slid = work(100, |frame| flat(AT + 0.02 * frame * DVec3::X, 5.0));
    assert_eq!(found(&slid), [(0, 100, "PAN")]);
}

proptest! {
    #![proptest_config(cases(32, 128))]

    #[test]
    fn whatever_a_camera_does_its_work_stands_on_the_sheet_in_order(
        steps in prop::collection::vec((-2.0..2.0, -90.0..90.0, 0.2..4.0), 1..80),
    ) {
        let at = |frame: f64| steps[frame as usize];
        let camera = |frame: f64| {
            let (x, degrees, height) = at(frame);
            pose(AT + x * DVec3::X, [degrees, 0.5 * degrees, degrees], height)
        };
        let all = work(steps.len(), camera);
        prop_assert!(all.iter().all(|(begin, past, words)| begin < past && !words.is_empty()));
        prop_assert!(all.iter().all(|(_, past, _)| *past <= steps.len()));
        prop_assert!(all.windows(2).all(|pair| pair[0].1 <= pair[1].0));
    }
}
