use super::*;
use crate::pipeline::tests::walking::{ROUND, walk};
use crate::sheet::{Repeat, Role, Why};

/// Height of the first joint over the floor, and its way along the walk, in a frame.
fn root(clip: &Clip, frame: usize) -> [f64; 2] {
    let row = clip.row(Frame(frame));
    [row[1], row[2]]
}

#[test]
fn rounds_follow_each_other_with_one_frame_at_a_seam_and_travel_on() {
    let clip = walk(0.3, ROUND + 1, 2.0);
    let laid = laid(&clip, 3, 1);
    assert_eq!(laid.len(), 3 * ROUND + 1);
    let way = 2.0 * ROUND as f64;
    for frame in 0..=3 * ROUND {
        let [height, z] = root(&laid, frame);
        assert!((z - (2.0 * frame as f64 - way)).abs() < 1e-9, "{frame}");
        assert!((height - root(&clip, frame % ROUND)[0]).abs() < 1e-6, "{frame}");
    }
    // The round of the clip keeps its numbers to the digit.
    assert_eq!(laid.row(Frame(ROUND + 7)), clip.row(Frame(7)));
    let again = middle_round(&super::laid(&clip, 3, 0));
    let apart = again.rows().flatten().zip(clip.rows().flatten()).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-6);
}

/// A sheet of some places, each for two koma, that repeats after a round.
fn sheet(clip: &Clip, places: &[f64], times: usize) -> Sheet {
    let drawing = |place: &f64| Drawing::new(Source::At(*place), Role::Genga, Why::default());
    let exposures: Vec<_> =
        (0..places.len()).map(|drawing| Exposure { drawing, koma: 2 }).collect();
    let layer = Layer {
        name: "A".into(),
        joints: vec![],
        drawings: places.iter().map(drawing).collect(),
        exposures: exposures.repeat(times),
        gone: vec![],
    };
    let repeat = Some(Repeat { frames: ROUND, koma: 26 });
    Sheet { repeat, ..Sheet::new(clip.clock(24.0), vec![layer]) }
}

#[test]
fn a_sheet_that_is_played_out_goes_on_in_every_round() {
    let clip = walk(0.3, ROUND + 1, 2.0);
    let looped = sheet(&clip, &[30.0, 48.0, 4.0, 20.0], 2);
    let (laid, played) = played_out(&clip, &looped);
    let places: Vec<f64> =
        played.layers[0].drawings.iter().map(|drawing| drawing.source.place()).collect();
    assert_eq!(places, [82.0, 100.0, 108.0, 124.0, 134.0, 152.0, 160.0, 176.0]);
    assert!(played.repeat.is_none() && played.length() == looped.length());
    assert_eq!(played.clock.first, Frame(82));
    // The first drawing stands where the clip has it.
    assert_eq!(laid.row(Frame(82)), clip.row(Frame(30)));
    assert!(laid.last().0 >= 176);
}

#[test]
fn a_drawing_that_is_alone_travels_on_and_a_plain_sheet_stays() {
    let clip = walk(0.3, ROUND + 1, 2.0);
    let alone = sheet(&clip, &[30.0], 3);
    let (_, played) = played_out(&clip, &alone);
    let places: Vec<f64> =
        played.layers[0].drawings.iter().map(|drawing| drawing.source.place()).collect();
    assert_eq!(places, [82.0, 134.0, 186.0]);
    let plain = Sheet::on_ones(clip.clock(24.0), 5);
    let (same, sheet) = played_out(&clip, &plain);
    assert!(matches!((same, sheet), (Cow::Borrowed(_), Cow::Borrowed(_))));
}

#[test]
fn a_layer_whose_first_drawing_is_held_over_begins_in_the_round_before() {
    let clip = walk(0.3, ROUND + 1, 2.0);
    let mut looped = sheet(&clip, &[2.0, 20.0, 40.0], 1);
    let mut arm = sheet(&clip, &[50.0, 12.0, 33.0], 1).layers.remove(0);
    arm.exposures.push(Exposure { drawing: 0, koma: 1 });
    arm.exposures = arm.exposures.repeat(2);
    looped.layers.push(arm);
    let (_, played) = played_out(&clip, &looped);
    let places: Vec<f64> =
        played.layers[1].drawings.iter().map(|drawing| drawing.source.place()).collect();
    assert_eq!(places, [50.0, 64.0, 85.0, 102.0, 116.0, 137.0, 154.0]);
}
