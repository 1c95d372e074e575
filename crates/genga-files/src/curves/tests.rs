//! Laws of the curves: close to the take, through every genga, as close as tangents can be.

use glam::{DVec3, DVec4};
use proptest::prelude::*;

use super::samples::{Samples, Take};
use super::spline::{RIDGE, Span, Tangents};
use super::*;
use genga::edits::Edits;
use genga::motion::{Axis, Channel, EndSite, Joint, JointId, Skeleton};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Drawing, Exposure, Layer, Role, Source};
use genga::time::{Frame, FrameRate};

const ZXY: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

fn joint(parent: Option<usize>, channels: Vec<Channel>, first_channel: usize) -> Joint {
    Joint {
        name: format!("joint{first_channel}"),
        parent: parent.map(JointId),
        offset: DVec3::new(0.0, 10.0, 0.0),
        channels,
        first_channel,
        end_sites: vec![EndSite { name: "Site".into(), offset: DVec3::new(0.0, 8.0, 0.0) }],
    }
}

/// A root that moves and an arm of two joints. `channel(column, frame)` gives the values.
fn arm(frames: usize, channel: impl Fn(usize, usize) -> f64) -> Clip {
    let moves = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
    let joints = vec![
        joint(None, [&moves[..], &ZXY].concat(), 0),
        joint(Some(0), ZXY.to_vec(), 6),
        joint(Some(1), ZXY.to_vec(), 9),
    ];
    let values = (0..frames).flat_map(|frame| (0..12).map(move |column| (column, frame)));
    let values = values.map(|(column, frame)| channel(column, frame)).collect();
    let rate = FrameRate::new(24.0).unwrap();
    Clip::new(Skeleton { joints }, rate, Frame(0), frames, values).unwrap()
}

/// A sheet with genga on some places.
fn sheet(clip: &Clip, places: &[f64]) -> Sheet {
    let drawing = |place: &f64| Drawing::new(Source::At(*place), Role::Genga, Default::default());
    let exposures = (0..places.len()).map(|drawing| Exposure { drawing, koma: 2 });
    let layer = Layer {
        name: "A".into(),
        joints: vec![],
        drawings: places.iter().map(drawing).collect(),
        exposures: exposures.collect(),
        gone: vec![],
    };
    Sheet::new(clip.clock(24.0), vec![layer])
}

fn wave(column: usize, frame: usize, speeds: &[f64]) -> f64 {
    let speed = speeds[column % speeds.len()];
    40.0 * (column as f64 + speed * frame as f64).sin()
}

/// The sum of squares that the tangents of a track make small.
fn loss(samples: Samples<'_>, keys: &[f64], values: &[DVec4], tangents: &[DVec4]) -> f64 {
    let shape = Shape::Cubic { values: values.to_vec(), tangents: tangents.to_vec() };
    let frames = keys[0].ceil() as usize..keys[keys.len() - 1].ceil() as usize;
    let off = frames.map(|frame| {
        let found = shape.value(Span::new(keys, frame as f64));
        found.distance_squared(samples.at(frame as f64))
    });
    let slopes = keys.iter().zip(tangents);
    let slopes = slopes.map(|(key, slope)| slope.distance_squared(samples.velocity(*key)));
    off.sum::<f64>() + RIDGE * slopes.sum::<f64>()
}

proptest! {
    #[test]
    fn curves_stay_as_close_as_asked_and_go_through_every_genga(
        speeds in prop::collection::vec(0.0..1.5, 4),
        frames in 8usize..60,
        inner in prop::collection::vec(0.0..1.0, 0..4),
        error in prop_oneof![Just(0.001), Just(0.01), Just(0.1)],
    ) {
        let clip = arm(frames, |column, frame| wave(column, frame, &speeds));
        let last = (frames - 1) as f64;
        let mut places: Vec<f64> = inner.iter().map(|share| share * last).collect();
        places.extend([0.0, last]);
        places.sort_by(f64::total_cmp);
        places.dedup();
        let keyed = Curves { error }.fit(&clip, &sheet(&clip, &places)).unwrap();
        prop_assert!(keyed.largest <= error, "{} of {error}", keyed.largest);
        prop_assert!(keyed.mean <= keyed.largest);
        let keys = &keyed.layers[0];
        prop_assert!(keys.is_sorted_by(|a, b| a.place < b.place));
        let genga = keys.iter().filter(|key| key.drawing.is_some()).map(|key| key.place);
        prop_assert!(genga.eq(places));
        prop_assert_eq!(keyed.added() > 0, keyed.error_of_genga > error);
    }

    #[test]
    fn no_other_tangents_come_closer(
        speeds in prop::collection::vec(0.1..1.2, 3),
        gaps in prop::collection::vec(3.0..9.0, 2..5),
        axis in 0usize..4,
        by in prop_oneof![Just(0.01), Just(-0.01)],
    ) {
        let keys: Vec<f64> = std::iter::once(0.0)
            .chain(gaps.iter().scan(0.0, |place, gap| { *place += gap; Some(*place) }))
            .collect();
        let frames = keys[keys.len() - 1].ceil() as usize + 1;
        let clip = arm(frames, |column, frame| wave(column, frame, &speeds));
        let take = Take::new(&clip, 0, frames - 1);
        for path in [Path::Rotation, Path::Translation] {
            let samples = take.samples(0, path);
            let values: Vec<DVec4> = keys.iter().map(|key| samples.at(*key)).collect();
            let tangents = Tangents::new(&keys).solve(samples, &values);
            let best = loss(samples, &keys, &values, &tangents);
            for key in 0..keys.len() {
                let mut others = tangents.clone();
                others[key][axis] += by;
                prop_assert!(loss(samples, &keys, &values, &others) >= best);
            }
        }
    }
}

#[test]
fn a_cubic_needs_its_two_ends_alone() {
    let cubic = |frame: usize| {
        let u = frame as f64 / 40.0;
        100.0 * (u - 2.0 * u * u + 1.5 * u * u * u)
    };
    let clip = arm(41, |column, frame| if column < 3 { cubic(frame) } else { 0.0 });
    let keyed = Curves { error: 0.0005 }.fit(&clip, &sheet(&clip, &[0.0, 40.0])).unwrap();
    assert_eq!((keyed.keys(), keyed.added()), (2, 0));
    assert!(keyed.largest < 1e-5, "{}", keyed.largest);
    let shapes = keyed.tracks.iter().map(|track| match track.shape {
        Shape::Constant(_) => 0,
        Shape::Linear(_) => 1,
        Shape::Cubic { .. } => 2,
    });
    assert!(shapes.eq([0, 2, 0, 0, 0, 0]), "the root moves, all else is still");
}

#[test]
fn a_straight_way_is_linear() {
    let clip = arm(31, |column, frame| if column == 6 { 2.0 * frame as f64 } else { 0.0 });
    let keyed = Curves::default().fit(&clip, &sheet(&clip, &[0.0, 30.0])).unwrap();
    assert_eq!(keyed.added(), 0);
    let turning =
        keyed.tracks.iter().find(|track| (track.joint, track.path) == (1, Path::Rotation));
    assert!(matches!(turning.unwrap().shape, Shape::Linear(_)));
}

#[test]
fn a_joint_that_turns_about_its_bone_is_followed() {
    // The tip lies on the axis: no position shows the turn.
    let twist =
        |column: usize, frame: usize| if column == 11 { wave(1, frame, &[0.9]) } else { 0.0 };
    let clip = arm(40, twist);
    let keyed = Curves::default().fit(&clip, &sheet(&clip, &[0.0, 39.0])).unwrap();
    assert!(keyed.added() > 2 && keyed.largest <= 0.01, "{} {}", keyed.added(), keyed.largest);
    assert!(keyed.mean < 1e-12, "positions stay");
}

#[test]
fn fewer_than_two_genga_are_refused() {
    let clip = arm(5, |_, _| 0.0);
    let error = Curves::default().fit(&clip, &sheet(&clip, &[2.0])).unwrap_err().to_string();
    assert!(error.contains("a curve needs two genga"), "{error}");
}

#[test]
fn each_layer_of_a_sample_keeps_its_genga_and_the_body_stays_close() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    let clip = genga::motion::bvh::open(path.as_ref()).unwrap().clip;
    let mut engine = Engine::new(clip).unwrap();
    for layers in ["body", "limbs"] {
        let mut recipe = Recipe::default();
        recipe.set("layers", layers).unwrap();
        let made = engine.run(&recipe, &Edits::default()).unwrap();
        let keyed = Curves::default().fit(made.clip, made.sheet).unwrap();
        assert!(keyed.largest <= 0.01, "{layers}: {}", keyed.largest);
        for (layer, keys) in made.sheet.layers.iter().zip(&keyed.layers) {
            let genga = keys.iter().filter(|key| key.drawing.is_some()).count();
            assert_eq!(genga, layer.genga(), "{layers}, layer {}", layer.name);
        }
        let notes = Curves::default().notes(made.clip, made.sheet).unwrap();
        assert_eq!(notes.len(), usize::from(keyed.added() > 0));
    }
}

#[test]
fn motions_are_measured_frame_by_frame() {
    let still = arm(12, |_, _| 0.0);
    assert_eq!(distances(&still, &still).unwrap(), [0.0; 12]);
    let shifted = arm(12, |column, frame| f64::from(column == 0 && frame == 5));
    let off = distances(&still, &shifted).unwrap();
    assert!(off.iter().enumerate().all(|(frame, off)| (*off > 0.0) == (frame == 5)), "{off:?}");
    let higher = arm(12, |column, frame| 2.0 * f64::from(column == 0 && frame == 5));
    let twice = distances(&still, &higher).unwrap()[5];
    assert!((twice - 2.0 * off[5]).abs() < 1e-12, "{twice} {}", off[5]);
    let error = distances(&still, &arm(11, |_, _| 0.0)).unwrap_err().to_string();
    assert!(error.contains("the same joints and frames"), "{error}");
}
