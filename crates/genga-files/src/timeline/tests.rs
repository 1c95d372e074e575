use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use genga::sheet::Blank;
use genga::time::{Clock, Frame, FrameRate};

/// A sheet at 24 koma of a take at 48 frames a second, in which the layer shows these drawings.
fn sheet(shown: &[(f64, usize)]) -> Sheet {
    let frame_rate = FrameRate::new(48.0).unwrap();
    let clock = Clock { first: Frame(0), frame_rate, koma_rate: 24.0 };
    let mut sheet = Sheet::on_ones(clock, shown.len());
    let layer = &mut sheet.layers[0];
    layer.exposures.clear();
    for (drawing, (place, koma)) in shown.iter().enumerate() {
        layer.drawings[drawing].source = genga::sheet::Source::At(*place);
        layer.exposures.push(Exposure { drawing, koma: *koma });
    }
    sheet
}

fn track(between: Between, keys: &[(f64, f64)]) -> Track {
    let rows = |value: f64| match between {
        Between::Cubic => vec![0.5, value, -0.25],
        _ => vec![value],
    };
    Track {
        places: keys.iter().map(|(place, _)| *place).collect(),
        values: keys.iter().flat_map(|(_, value)| rows(*value)).collect(),
        width: 1,
        between,
    }
}

fn at(track: &Track, place: f64) -> f64 {
    let mut value = [0.0];
    track.write_at(place, &mut value);
    value[0]
}

#[test]
fn a_sheet_that_keeps_the_time_keeps_the_keys_as_they_are() {
    let line = Timeline::new(&sheet(&[(0.0, 3), (6.0, 2), (10.0, 3)]), Others::Keep);
    assert_eq!(line.only_pace(), Some((0.0, 0.0, 2.0)));
    for between in [Between::Step, Between::Linear, Between::Cubic] {
        let own = track(between, &[(0.0, 1.0), (3.0, 4.0), (11.0, 2.0)]);
        let new = line.retimed(&own);
        assert_eq!(new.places, [0.0, 1.5, 5.5], "{between:?}");
        assert_eq!([0, 1, 2].map(|key| new.value(key)[0]), [1.0, 4.0, 2.0]);
        if between == Between::Cubic {
            assert_eq!(new.row(1, 0), [1.0], "half a frame is a koma's");
        }
    }
}

#[test]
fn blank_koma_shift_the_keys_and_a_part_of_the_take_cuts_them() {
    let own = track(Between::Linear, &[(0.0, 0.0), (20.0, 20.0)]);
    let late = sheet(&[(4.0, 2), (8.0, 2)]).with_blank(Blank { before: 3, after: 2 });
    let new = Timeline::new(&late, Others::Keep).retimed(&own);
    assert_eq!(new.places, [3.0, 5.0]);
    assert_eq!([0.0, 2.0, 4.0, 8.0].map(|koma| at(&new, koma)), [4.0, 4.0, 6.0, 8.0]);
}

#[test]
fn a_sheet_that_begins_again_shows_the_keys_again() {
    let own = track(Between::Linear, &[(0.0, 0.0), (3.0, 3.0)]);
    let line = Timeline::new(&sheet(&[(0.0, 2), (4.0, 1), (0.0, 2)]), Others::Keep);
    assert_eq!(line.only_pace(), None);
    let new = line.retimed(&own);
    assert_eq!([0.0, 1.0, 2.5, 3.0, 4.0].map(|koma| at(&new, koma)), [0.0, 2.0, 3.0, 0.0, 0.0]);
    let step = line.retimed(&track(Between::Step, &[(0.0, 0.0), (3.0, 3.0)]));
    assert_eq!([1.0, 1.5, 2.5, 3.0].map(|koma| at(&step, koma)), [0.0, 3.0, 3.0, 0.0]);
}

#[test]
fn stepped_values_stay_as_long_as_their_drawing() {
    let own = track(Between::Linear, &[(0.0, 0.0), (20.0, 20.0)]);
    let line = Timeline::new(&sheet(&[(0.0, 3), (6.0, 2), (10.0, 3)]), Others::Step);
    let new = line.retimed(&own);
    assert_eq!(new.between, Between::Step);
    assert_eq!(new.places, [0.0, 3.0, 5.0, 8.0]);
    assert_eq!(new.values, [0.0, 6.0, 10.0, 10.0]);
    assert_eq!([0.0, 2.9, 3.0, 7.0].map(|koma| line.place(koma).unwrap()), [0.0, 0.0, 6.0, 10.0]);
}

#[test]
fn the_time_of_a_take_goes_from_its_first_place_to_its_last() {
    let line = Timeline::of_take(6.0, 30.0, 2.0);
    assert_eq!((line.length(), line.place(3.0)), (12.0, Some(12.0)));
    assert_eq!(line.only_pace(), Some((0.0, 6.0, 2.0)));
}

proptest! {
    #![proptest_config(cases(64, 256))]

    #[test]
    fn a_track_has_its_values_where_the_sheet_shows_their_time(
        shown in prop::collection::vec((0.0..60.0, 1..6usize), 1..10),
        keys in prop::collection::btree_map(0..60u32, -5.0..5.0, 1..8),
        before in 0..4usize,
    ) {
        let sheet = sheet(&shown).with_blank(Blank { before, after: 1 });
        let line = Timeline::new(&sheet, Others::Keep);
        let keys: Vec<(f64, f64)> =
            keys.into_iter().map(|(place, value)| (f64::from(place), value)).collect();
        for between in [Between::Step, Between::Linear, Between::Cubic] {
            let own = track(between, &keys);
            let new = line.retimed(&own);
            prop_assert!(new.places.is_sorted_by(|a, b| a < b), "{:?}", new.places);
            prop_assert!(new.places.iter().all(|koma| (0.0..=line.length()).contains(koma)));
            for koma in (0..8 * line.length() as usize).map(|at| f64::from(at as u32) / 8.0) {
                // Within the gap before a jump, it is on its way there.
                let jumps = line.parts.windows(2).any(|pair| {
                    pair[0].to != pair[1].from && (pair[1].begin - koma).abs() < 2.0 * GAP
                });
                let expected = at(&own, line.place(koma).unwrap());
                let near_step = between == Between::Step
                    && keys.iter().any(|key| (key.0 - line.place(koma).unwrap()).abs() < 1e-6);
                prop_assert!(
                    jumps || near_step || (at(&new, koma) - expected).abs() < 1e-6,
                    "{between:?} {koma}: {} and {expected}", at(&new, koma)
                );
            }
        }
    }
}
