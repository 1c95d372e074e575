//! Effects of exaggeration on known motions, and on odd ones.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::cartoon::MET_BEST;
use super::smooth::Smooth;
use super::*;
use crate::motion::{
    Axis, Body, Channel, Joint, JointId, Landmarks, Poser, Skeleton, bvh, local_rotation,
    turn_columns,
};
use crate::time::{Frame, FrameRate};

const ORDERS: [[Axis; 3]; 3] =
    [[Axis::Z, Axis::X, Axis::Y], [Axis::X, Axis::Y, Axis::Z], [Axis::Y, Axis::Z, Axis::X]];

fn joint(parent: Option<usize>, channels: Vec<Channel>, first_channel: usize) -> Joint {
    Joint {
        name: "joint".into(),
        parent: parent.map(JointId),
        offset: DVec3::Y,
        channels,
        first_channel,
        end_sites: vec![],
    }
}

fn clip_of(skeleton: Skeleton, fps: f64, values: Vec<f64>) -> Clip {
    let frames = values.len() / skeleton.channels();
    Clip::new(skeleton, FrameRate::new(fps).unwrap(), Frame(5), frames, values).unwrap()
}

/// Builds two freely rotating joints, the second on the first.
pub(super) fn chain(axes: [Axis; 3], values: &[[f64; 6]]) -> Clip {
    let turns = axes.map(Channel::Rotation).to_vec();
    let joints = vec![joint(None, turns.clone(), 0), joint(Some(0), turns, 3)];
    clip_of(Skeleton { joints }, 100.0, values.concat())
}

/// Builds a joint that moves along X and turns only about Z, both by one signal.
fn carried(signal: &[f64]) -> Clip {
    let channels = vec![Channel::Position(Axis::X), Channel::Rotation(Axis::Z)];
    let values = signal.iter().flat_map(|value| [*value, *value]).collect();
    clip_of(Skeleton { joints: vec![joint(None, channels, 0)] }, 100.0, values)
}

fn cartoon(strength: f64, width: f64) -> Exaggerate {
    let cartoon_width = Span::Frames(width);
    let cartoon_parts = CartoonParts::Body;
    Exaggerate { cartoon: strength, cartoon_width, cartoon_parts, ..Exaggerate::default() }
}

fn ease(strength: f64, reach: f64) -> Exaggerate {
    Exaggerate { ease: strength, ease_reach: Span::Frames(reach), ..Exaggerate::default() }
}

fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh");
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

fn column(clip: &Clip, column: usize) -> Vec<f64> {
    clip.rows().map(|row| row[column]).collect()
}

/// Returns the rotation of a joint at each frame.
fn rotations(clip: &Clip, at: usize) -> Vec<DQuat> {
    clip.rows().map(|row| local_rotation(&clip.skeleton().joints[at], row)).collect()
}

fn same(a: DQuat, b: DQuat) -> bool {
    (a.dot(b).abs() - 1.0).abs() < 1e-9
}

#[test]
fn every_setting_out_of_its_range_is_refused_by_its_name() {
    Exaggerate::default().validate().unwrap();
    for (name, wrong) in [
        ("cartoon", cartoon(-0.1, 20.0)),
        ("cartoon", cartoon(3.1, 20.0)),
        ("cartoon", cartoon(f64::NAN, 20.0)),
        ("cartoon_width", cartoon(1.0, -1.0)),
        ("cartoon_width", cartoon(1.0, f64::INFINITY)),
        ("ease", ease(-0.1, 10.0)),
        ("ease", ease(1.1, 10.0)),
        ("ease", ease(f64::NAN, 10.0)),
        ("ease_reach", ease(1.0, -1.0)),
        ("ease_reach", ease(1.0, f64::NAN)),
    ] {
        let error = wrong.validate().unwrap_err().to_string();
        assert!(error.starts_with(&format!("exaggerate.{name}: ")), "{error}");
        assert_eq!(wrong.apply(&kick()).unwrap_err().to_string(), error);
    }
    cartoon(3.0, 0.0).validate().unwrap();
    ease(1.0, 0.0).validate().unwrap();
}

#[test]
fn nothing_asked_for_changes_nothing() {
    let clip = kick();
    assert!(Exaggerate::default().is_off());
    for off in [Exaggerate::default(), cartoon(1.0, 0.0), ease(1.0, 0.0)] {
        assert_eq!(off.apply(&clip).unwrap(), clip);
    }
}

#[test]
fn who_stands_still_keeps_every_digit() {
    let row = [0.1, 33.3, -77.7, 181.0, -200.2, 1e-7];
    let clip = chain(ORDERS[0], &[row; 60]);
    let both = Exaggerate { ease: 1.0, ..cartoon(2.0, 20.0) };
    assert_eq!(both.apply(&clip).unwrap(), clip);
}

#[test]
fn a_swing_grows_by_what_the_filter_lets_through() {
    for (swings, width) in [(3.0, 30.0), (8.0, 12.0), (5.0, 90.5), (40.0, 3.0)] {
        let frames = 201;
        let omega = PI * swings / (frames - 1) as f64;
        let swing: Vec<f64> = (0..frames).map(|at| 40.0 * (omega * f64::from(at)).sin()).collect();
        let sigma = 0.5 * width;
        let bend = 4.0 * (0.5 * omega).sin().powi(2) * sigma * sigma;
        let gain = 1.0 + 0.8 * MET_BEST * bend * Smooth::new(sigma).response(omega);
        let by_columns = cartoon(0.8, width).apply(&carried(&swing)).unwrap();
        // About an oblique axis, in a rig whose channels are not aligned with it.
        let tilt = DQuat::from_scaled_axis(DVec3::new(0.3, -0.8, 0.5));
        let axis = DVec3::new(1.0, 2.0, -2.0) / 3.0;
        let turned = |degrees: f64| tilt * DQuat::from_axis_angle(axis, degrees.to_radians());
        let any_way =
            of_rotations(ORDERS[0], &swing.iter().map(|way| turned(*way)).collect::<Vec<_>>());
        let any_way = rotations(&cartoon(0.8, width).apply(&any_way).unwrap(), 0);
        for (at, way) in swing.iter().enumerate() {
            for column in 0..2 {
                let found = by_columns.row(Frame(5 + at))[column];
                assert!((found - gain * way).abs() < 1e-8, "{found} {}", gain * way);
            }
            assert!(same(any_way[at], turned(gain * way)), "{swings} {width} {at}");
        }
    }
}

/// Builds a single joint with these rotations.
fn of_rotations(axes: [Axis; 3], rotations: &[DQuat]) -> Clip {
    let joint = joint(None, axes.map(Channel::Rotation).to_vec(), 0);
    let mut values = vec![0.0; 3];
    for rotation in rotations {
        let mut row = [0.0; 3];
        row.copy_from_slice(&values[values.len() - 3..]);
        turn_columns(&joint, axes, *rotation, &mut row);
        values.extend(row);
    }
    clip_of(Skeleton { joints: vec![joint] }, 100.0, values.split_off(3))
}

#[test]
fn the_period_that_is_met_best_is_twice_as_wide_at_strength_1() {
    let frames = 1001;
    let widest = |period: f64| {
        let swings = (2.0 * f64::from(frames - 1) / period).round();
        let omega = PI * swings / f64::from(frames - 1);
        let swing: Vec<f64> = (0..frames).map(|at| (omega * f64::from(at)).sin()).collect();
        let found = cartoon(1.0, 30.0).apply(&carried(&swing)).unwrap();
        column(&found, 0).into_iter().fold(0.0, f64::max)
    };
    let [slower, best, faster] = [80.0, 71.0, 62.0].map(widest);
    assert!(
        (best - 2.0).abs() < 0.01 && best > slower && best > faster,
        "{slower} {best} {faster}"
    );
    assert!(widest(25.0) < 1.7 && widest(200.0) < 1.5, "{} {}", widest(25.0), widest(200.0));
}

#[test]
fn a_sudden_movement_goes_back_before_and_beyond_after() {
    let sudden: Vec<f64> = (0..200).map(|at| if at < 100 { 10.0 } else { 70.0 }).collect();
    let found = cartoon(1.0, 30.0).apply(&carried(&sudden)).unwrap();
    for column in [column(&found, 0), column(&found, 1)] {
        let (back, low) = column.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        let (beyond, high) = column.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        assert!(
            (10.0 - low - 21.8).abs() < 0.7 && (high - 70.0 - 21.8).abs() < 0.7,
            "{low} {high}"
        );
        assert!((beyond - back).abs_diff(30) <= 2, "{back} {beyond}");
        assert_eq!((column[20], column[180]), (10.0, 70.0), "far from it nothing is changed");
    }
}

#[test]
fn rotations_are_displaced_by_the_definition() {
    let row = |at: usize| {
        [1.0, 0.7, 1.3, 0.4, 2.0, 0.9].map(|pace| 120.0 * (pace * at as f64 * 0.2).sin())
    };
    let clip = chain(ORDERS[0], &(0..50).map(row).collect::<Vec<_>>());
    let found = cartoon(0.5, 9.0).apply(&clip).unwrap();
    let bell = Smooth::new(4.5).bell();
    let middle = bell.len() as isize / 2;
    for joint in 0..2 {
        let own = rotations(&clip, joint);
        let way = |from: usize, to: usize| {
            let turn = own[from].conjugate() * own[to];
            (if turn.w < 0.0 { -turn } else { turn }).to_scaled_axis()
        };
        let bend = |at: isize| match at.rem_euclid(98) as usize {
            0 | 49 => DVec3::ZERO,
            at if at < 49 => way(at, at + 1) + way(at, at - 1),
            at => -(way(98 - at, 99 - at) + way(98 - at, 97 - at)),
        };
        for (at, found) in rotations(&found, joint).into_iter().enumerate() {
            let near = bell.iter().enumerate();
            let smooth: DVec3 =
                near.map(|(by, w)| *w * bend(at as isize + by as isize - middle)).sum();
            let turn = DQuat::from_scaled_axis(-0.5 * MET_BEST * 4.5 * 4.5 * smooth);
            assert!(same(found, own[at] * turn), "{joint} {at}");
        }
    }
}

#[test]
fn one_axis_runs_on_past_half_a_turn() {
    let round: Vec<f64> = (0..40).map(|at| 15.0 * f64::from(at)).collect();
    let wrapped: Vec<f64> = round.iter().map(|way| (way + 180.0) % 360.0 - 180.0).collect();
    let found = cartoon(1.0, 8.0).apply(&carried(&wrapped)).unwrap();
    for (found, way) in column(&found, 1).iter().zip(&wrapped) {
        assert!((found - way).abs() < 1e-9, "an even turn is not exaggerated: {found} {way}");
    }
}

#[test]
fn standing_feet_stay_where_they_are_unless_the_whole_body_is_asked_for() {
    let clip = kick();
    let feet = Landmarks::new(&clip).feet;
    let soles = |clip: &Clip| -> Vec<DVec3> {
        let (mut poser, mut body) = (Poser::new(clip), Body::new(clip.skeleton()));
        let mut soles = Vec::new();
        for frame in clip.first().0..=clip.last().0 {
            body.place(poser.frame(Frame(frame)));
            soles.extend(feet.iter().map(|foot| foot.sole.position(&body)));
        }
        soles
    };
    let upper = Exaggerate { cartoon: 1.0, ..Exaggerate::default() }.apply(&clip).unwrap();
    assert_eq!(soles(&upper), soles(&clip));
    assert_ne!(upper, clip);
    let body =
        Exaggerate { cartoon_parts: CartoonParts::Body, cartoon: 1.0, ..Exaggerate::default() };
    assert_ne!(soles(&body.apply(&clip).unwrap()), soles(&clip));
}

#[test]
fn poses_gather_round_the_extremes_which_keep_their_time() {
    let period = 80.0;
    let row = |at: usize| {
        let way = 40.0 * (2.0 * PI * at as f64 / period).cos();
        [way, 0.0, 0.0, 0.0, 0.5 * way, 0.0]
    };
    let clip = chain(ORDERS[1], &(0..161).map(row).collect::<Vec<_>>());
    let places = super::ease::places(&clip, 1.0, 12.0).unwrap();
    for extreme in [0, 40, 80, 120, 160] {
        assert!((places[extreme] - extreme as f64).abs() < 1e-9, "{extreme}: {}", places[extreme]);
    }
    let pace = |at: usize| 0.5 * (places[at + 1] - places[at - 1]);
    assert!(pace(40) < 0.75 && pace(80) < 0.75, "{} {}", pace(40), pace(80));
    assert!(pace(20) > 1.15 && pace(60) > 1.15, "{} {}", pace(20), pace(60));
    let half = super::ease::places(&clip, 0.5, 12.0).unwrap();
    for (at, (half, whole)) in half.iter().zip(&places).enumerate() {
        assert!((half - 0.5 * (whole + at as f64)).abs() < 1e-9);
    }
}

#[test]
fn an_even_movement_is_not_eased_away_from_its_ends() {
    let clip = chain(
        ORDERS[0],
        &std::array::from_fn::<_, 120, _>(|at| [at as f64, 0.0, 0.0, 0.0, 0.0, 0.0]),
    );
    let places = super::ease::places(&clip, 1.0, 8.0).unwrap();
    for (at, place) in places.iter().enumerate().take(90).skip(30) {
        assert!((place - at as f64).abs() < 1e-6, "{at}: {place}");
    }
}

#[test]
fn a_rest_is_left_later_and_reached_earlier() {
    let way = |at: usize| ((at as f64 - 40.0) / 20.0).clamp(0.0, 1.0);
    let clip = chain(
        ORDERS[0],
        &std::array::from_fn::<_, 100, _>(|at| [60.0 * way(at), 0.0, 0.0, 0.0, 0.0, 0.0]),
    );
    let places = super::ease::places(&clip, 1.0, 8.0).unwrap();
    assert!(places[43] < 42.5 && places[57] > 57.5, "{} {}", places[43], places[57]);
}

#[test]
fn what_grows_beyond_all_measure_is_refused() {
    let wild: Vec<f64> = (0..50).map(|at| if at == 25 { 9e11 } else { 0.0 }).collect();
    let error = cartoon(3.0, 4.0).apply(&carried(&wild)).unwrap_err().to_string();
    assert!(error.contains("which is no motion"), "{error}");
}

/// Generates motions of few frames, with jumps of half a turn and stretches of stillness.
fn any_rows() -> impl Strategy<Value = Vec<[f64; 6]>> {
    let value = prop_oneof![
        Just(0.0),
        Just(180.0),
        Just(-180.0),
        Just(90.0),
        -400.0..400.0f64,
        Just(1e9),
        Just(1e-300)
    ];
    let few = [[0.0; 6], [90.0, 0.0, 0.0, 180.0, 0.0, 0.0], [0.0, 20.0, 0.0, 5.0, 0.0, 0.0]];
    prop_oneof![
        prop::collection::vec(prop::array::uniform6(value), 1..40),
        prop::collection::vec(prop::sample::select(few.to_vec()), 3..40),
        prop::array::uniform6(-400.0..400.0f64).prop_map(|row| vec![row; 7]),
    ]
}

fn any_exaggeration() -> impl Strategy<Value = Exaggerate> {
    let width = || prop_oneof![Just(0.0), 0.0..3.0, 0.0..60.0, Just(1e300)];
    let parts = prop::sample::select(&[CartoonParts::Upper, CartoonParts::Body][..]);
    (0.0..3.0, width(), parts, 0.0..=1.0, width()).prop_map(
        |(cartoon, width, cartoon_parts, ease, reach)| Exaggerate {
            cartoon,
            cartoon_width: Span::Frames(width),
            cartoon_parts,
            ease,
            ease_reach: Span::Frames(reach),
        },
    )
}

proptest! {
    #[test]
    fn whatever_the_motion_it_stays_one_of_the_same_frames_and_ends(
        rows in any_rows(),
        exaggerate in any_exaggeration(),
    ) {
        let clip = chain(ORDERS[0], &rows);
        let found = exaggerate.apply(&clip).unwrap();
        prop_assert!(found.rows().flatten().all(|value| value.is_finite()));
        prop_assert_eq!((found.len(), found.first(), found.rate()), (clip.len(), clip.first(), clip.rate()));
        prop_assert_eq!(found.skeleton(), clip.skeleton());
        for end in [clip.first(), clip.last()] {
            prop_assert_eq!(found.row(end), clip.row(end));
        }
    }

    #[test]
    fn time_never_goes_back_and_the_ends_stay(
        rows in any_rows(),
        strength in 0.0..=1.0,
        reach in 0.1..30.0,
    ) {
        let clip = chain(ORDERS[2], &rows);
        if let Some(places) = super::ease::places(&clip, strength, reach) {
            prop_assert_eq!(places.len(), clip.len());
            prop_assert_eq!((places[0], places[places.len() - 1]), (0.0, (clip.len() - 1) as f64));
            prop_assert!(places.windows(2).all(|pair| pair[0] <= pair[1]), "{:?}", places);
        }
    }

    #[test]
    fn it_does_not_matter_how_the_whole_body_is_turned_nor_in_which_order_angles_are_written(
        paces in prop::array::uniform6(0.1..1.5f64),
        turned in prop::array::uniform3(-3.0..3.0f64),
        order in 0..3usize,
    ) {
        let row = |at: usize| paces.map(|pace| 60.0 * (pace * at as f64 * 0.3).sin());
        let clip = chain(ORDERS[0], &(0..30).map(row).collect::<Vec<_>>());
        let turn = DQuat::from_scaled_axis(DVec3::from_array(turned));
        let own = rotations(&clip, 0);
        let settings = Exaggerate { ease: 0.7, ease_reach: Span::Frames(4.0), ..cartoon(0.4, 8.0) };
        let plain = of_rotations(ORDERS[0], &own);
        let other = of_rotations(ORDERS[order], &own.iter().map(|own| turn * *own).collect::<Vec<_>>());
        let plain = rotations(&settings.apply(&plain).unwrap(), 0);
        let other = rotations(&settings.apply(&other).unwrap(), 0);
        for (plain, other) in plain.iter().zip(&other) {
            prop_assert!((other.dot(turn * *plain).abs() - 1.0).abs() < 1e-7, "{} {}", plain, other);
        }
    }
}
