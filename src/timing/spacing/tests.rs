use proptest::prelude::*;

use super::*;
use crate::keys::{Alike, Key, Origin, Wall};
use crate::sheet::{Role, Source};
use crate::time::FrameRate;

fn clock(fps: f64) -> Clock {
    Clock { first: Frame(0), frame_rate: FrameRate::new(fps).unwrap(), koma_rate: 24.0 }
}

fn key(frame: usize, price: f64) -> Key {
    Key {
        frame: Frame(frame),
        strength: 0.5,
        price,
        voters: Vec::new(),
        weight: None,
        name: None,
        origin: Origin::Turn,
    }
}

fn layer(keys: &[usize], walls: &[usize]) -> LayerKeys {
    LayerKeys {
        gaits: Vec::new(),
        keys: keys.iter().map(|frame| key(*frame, 10.0)).collect(),
        walls: walls.iter().map(|frame| Wall { frame: Frame(*frame), strength: 1.0 }).collect(),
        rests: Vec::new(),
        holds_end: true,
        over_limit: 0,
        without_corrections: vec![],
    }
}

/// Spacing on twos throughout.
fn twos() -> Spacing {
    Spacing { on: On::every(2), ..Spacing::default() }
}

/// Builds a body that always moves except in rests, at 24 frames per second.
fn moving(rests: &[RangeInclusive<Frame>]) -> Pace<'static> {
    let is_still =
        |koma: usize| rests.iter().any(|rest| rest.start().0 < koma && koma <= rest.end().0);
    Pace::of_steps((1..1000).map(move |koma| if is_still(koma) { 0.0 } else { 10.0 }))
}

fn place(spacing: &Spacing, layer: &LayerKeys, fps: f64, koma: usize) -> Layer {
    let pace = moving(&layer.rests);
    spacing.place(layer, &Skeleton::default(), clock(fps), koma, &pace).layer
}

fn places(layer: &Layer) -> Vec<f64> {
    layer.drawings.iter().map(|drawing| drawing.source.place()).collect()
}

fn begins(layer: &Layer) -> Vec<usize> {
    layer.timed().map(|(begin, _)| begin).collect()
}

#[test]
fn every_knob_out_of_range_is_named() {
    let wrong = |spacing: Spacing| spacing.validate().unwrap_err().to_string();
    for on in [0, 1001, usize::MAX] {
        let on = On::every(on);
        assert!(wrong(Spacing { on, ..Spacing::default() }).starts_with("spacing.on"));
    }
    let backwards = On { least: 3, most: 1 };
    assert!(wrong(Spacing { on: backwards, ..Spacing::default() }).starts_with("spacing.on"));
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(wrong(Spacing { step, ..Spacing::default() }).starts_with("spacing.step"));
    }
    let inbetweens = Some(usize::MAX);
    assert!(wrong(Spacing { inbetweens, ..Spacing::default() }).starts_with("spacing.inbetweens"));
    for drift in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(wrong(Spacing { drift, ..Spacing::default() }).starts_with("spacing.drift"));
    }
    for weight in [-0.1, 1.0, f64::NAN] {
        assert!(wrong(Spacing { weight, ..Spacing::default() }).starts_with("spacing.weight"));
    }
    for max_shift in [-1.0, f64::INFINITY] {
        assert!(
            wrong(Spacing { max_shift, ..Spacing::default() }).starts_with("spacing.max_shift")
        );
    }
    assert!(Spacing::default().validate().is_ok());
}

#[test]
fn even_spacing_on_threes_leaves_nothing_for_one_koma() {
    let spacing = Spacing { on: On::every(3), weight: 0.0, ..Spacing::default() };
    let on_threes = |keys: &[usize]| place(&spacing, &layer(keys, &[]), 24.0, 12);
    let short = on_threes(&[8]);
    assert_eq!(begins(&short), [0, 3, 6, 8, 10], "the last but one of two koma");
    assert_eq!(places(&short), [0.0, 3.5, 6.0, 8.0, 11.0], "the end shows the last instant");
    assert_eq!(short.length(), 12);
    assert_eq!(begins(&on_threes(&[7])), [0, 3, 7, 10], "what would stay for one is not there");
}

#[test]
fn what_stays_longer_than_a_key_shows_a_later_moment() {
    let spacing = Spacing { on: On::every(4), weight: 0.0, ..Spacing::default() };
    let even = places(&place(&spacing, &layer(&[], &[]), 24.0, 18));
    assert_eq!(
        even,
        [0.0, 4.0 + 1.0, 8.0 + 1.0, 12.0 + 1.0, 17.0]
            .map(|at| at * 17.0 / 16.0)
            .map(|at: f64| at.min(17.0))
    );
}

#[test]
fn inbetweens_crowd_towards_the_nearer_key_and_the_middle_stays() {
    // Fig. 9: a ball rolls from A to B with three inbetweens.
    let layer = place(&three(), &layer(&[], &[]), 24.0, 9);
    assert_eq!(places(&layer), [0.0, 1.0, 4.0, 7.0, 8.0]);
}

/// Three inbetweens, half way to their key; drawings may stay for one koma.
fn three() -> Spacing {
    let (on, inbetweens) = (On::every(1), Some(3));
    Spacing { on, inbetweens, weight: 0.5, max_shift: 9.0, ..Spacing::default() }
}

#[test]
fn a_wall_decides_the_side() {
    // Fig. 10: the speed peak lies late, so the middle and what follows it still belong to A.
    let spacing = three();
    let with_wall = place(&spacing, &layer(&[], &[5]), 24.0, 9);
    assert_eq!(places(&with_wall), [0.0, 1.0, 2.0, 7.0, 8.0]);
    let on_wall = place(&spacing, &layer(&[], &[6]), 24.0, 9);
    assert_eq!(places(&on_wall), [0.0, 1.0, 2.0, 6.0, 8.0], "on the wall nothing moves");
    let mut strongest = layer(&[], &[1, 5]);
    strongest.walls[1].strength = 2.0;
    assert_eq!(place(&spacing, &strongest, 24.0, 9), with_wall);
}

#[test]
fn a_key_has_a_weight_of_its_own() {
    let spacing = Spacing { weight: 0.0, ..three() };
    let mut keys = layer(&[8], &[]);
    keys.keys[0].weight = Some(0.5);
    assert_eq!(places(&place(&spacing, &keys, 24.0, 17))[..5], [0.0, 2.0, 4.0, 7.0, 8.0]);
}

#[test]
fn a_place_moves_no_further_than_allowed() {
    let spacing = Spacing { on: On::every(1), weight: 0.9, max_shift: 2.0, ..Spacing::default() };
    let layer = place(&spacing, &layer(&[], &[]), 120.0, 41);
    for (koma, place) in places(&layer).iter().enumerate() {
        assert!((place - 5.0 * koma as f64).abs() <= 10.0 + 1e-9);
    }
}

#[test]
fn what_does_not_fit_is_reported() {
    let spaced = |on| {
        let spacing = Spacing { on: On::every(on), inbetweens: Some(4), ..Spacing::default() };
        let keys = layer(&[3], &[]);
        spacing.place(&keys, &Skeleton::default(), clock(24.0), 9, &moving(&[]))
    };
    assert_eq!(spaced(1).did_not_fit, 2);
    assert_eq!(begins(&spaced(1).layer), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(spaced(2).did_not_fit, 4 + 3, "on twos each stays for two");
    assert_eq!(begins(&spaced(2).layer), [0, 3, 5, 7]);
}

#[test]
fn a_blend_shows_the_keys_at_the_share_of_its_place() {
    let spacing = Spacing {
        source: InbetweenSource::Blend,
        on: On::every(1),
        inbetweens: Some(1),
        weight: 0.0,
        ..Spacing::default()
    };
    let layer = place(&spacing, &layer(&[], &[]), 24.0, 5);
    assert_eq!(layer.drawings[1].source, Source::Between { from: 0.0, to: 4.0, share: 0.5 });
}

#[test]
fn a_key_on_an_end_gives_way_and_the_dearer_of_two_on_one_koma_stays() {
    let mut keys = layer(&[1, 50, 52, 119], &[]);
    keys.keys[0].voters = vec![];
    keys.keys[2].price = 20.0;
    let layer = place(&twos(), &keys, 120.0, 25);
    let kept: Vec<_> = layer.drawings.iter().filter(|drawing| drawing.role.is_kept()).collect();
    let roles: Vec<_> = kept.iter().map(|drawing| drawing.role).collect();
    assert_eq!(roles, [Role::End, Role::Genga, Role::End]);
    assert_eq!(kept[1].source, Source::At(52.0));
    assert_eq!((kept[0].source, kept[2].source), (Source::At(0.0), Source::At(120.0)));
    assert_eq!(kept[0].why.price, Some(10.0), "the end took over the key");
}

#[test]
fn a_pin_on_an_end_is_what_the_end_shows() {
    let mut keys = layer(&[2, 118], &[]);
    for key in &mut keys.keys {
        (key.origin, key.price) = (Origin::Pinned, f64::INFINITY);
    }
    let layer = place(&twos(), &keys, 120.0, 25);
    let (first, last) = (&layer.drawings[0], &layer.drawings[layer.drawings.len() - 1]);
    assert_eq!((first.role, first.source), (Role::End, Source::At(2.0)));
    assert_eq!((last.role, last.source), (Role::End, Source::At(118.0)));
}

#[test]
fn each_drawing_stays_by_its_own_pace() {
    let steps = [[12.0; 8], [2.0; 8], [4.0; 8]].concat();
    let pace = Pace::of_steps(steps.into_iter());
    let layer = layer(&[8, 16], &[]);
    let on = On { least: 1, most: 3 };
    let spacing = Spacing { on, drift: 0.0, ..Spacing::default() };
    let layer = spacing.place(&layer, &Skeleton::default(), clock(24.0), 25, &pace).layer;
    let ones = [0, 1, 2, 3, 4, 5, 6, 7];
    assert_eq!(begins(&layer)[..8], ones);
    assert_eq!(
        begins(&layer)[8..],
        [8, 11, 14, 16, 18, 20, 23],
        "threes, twos, and the end on twos"
    );
}

#[test]
fn what_is_no_inbetween_of_a_key_cannot_be_pulled() {
    let (spacing, layer) = (twos(), layer(&[10], &[]));
    let spaced = place(&spacing, &layer, 24.0, 22);
    assert_eq!(begins(&spaced), [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20]);
    let pulled = |koma, place| spacing.pulled(&layer, &spaced, clock(24.0), koma, place);
    assert_eq!(pulled(8, 8.0), Some(Pull { key: Frame(10), weight: 0.0 }));
    assert_eq!(pulled(8, 9.0), Some(Pull { key: Frame(10), weight: 0.5 }));
    assert_eq!(pulled(8, 30.0), Some(Pull { key: Frame(10), weight: 0.95 }), "not quite the key");
    assert_eq!(pulled(8, 3.0).map(|pull| pull.weight), Some(0.0), "not away from it");
    assert_eq!(pulled(2, 1.0), None, "the clip's end is no key");
    assert_eq!(pulled(5, 4.0), None, "the middle");
    for koma in [0, 10, 20, 21, 99] {
        assert_eq!(pulled(koma, 10.5), None, "koma {koma}");
    }
}

#[test]
fn short_sheets_are_ends_alone() {
    let ends = |on, koma| {
        let spacing = Spacing { on: On::every(on), ..Spacing::default() };
        let layer = place(&spacing, &layer(&[], &[]), 24.0, koma);
        assert!(layer.drawings.iter().all(|drawing| drawing.role == Role::End));
        assert_eq!(layer.length(), koma);
        layer.drawings.len()
    };
    assert_eq!([0, 1, 2].map(|koma| ends(1, koma)), [0, 1, 2]);
    assert_eq!([0, 1, 2, 3, 4].map(|koma| ends(2, koma)), [0, 1, 1, 1, 2], "two koma each");
}

// Rests.

/// Builds keys with rests between some frames, whose ends are keys.
fn resting(keys: &[usize], rests: &[(usize, usize)]) -> LayerKeys {
    let mut layer = layer(keys, &[]);
    for (begin, end) in rests {
        for frame in [begin, end] {
            layer.keys.push(Key { origin: Origin::Rest, ..key(*frame, f64::INFINITY) });
        }
        layer.rests.push(Frame(*begin)..=Frame(*end));
    }
    layer.keys.sort_by_key(|key| key.frame);
    layer
}

#[test]
fn one_drawing_holds_through_a_rest() {
    let held = |layer: &LayerKeys| begins(&place(&twos(), layer, 24.0, 40));
    // The end of the rest marks only a time: one koma after it the body is elsewhere.
    assert_eq!(held(&resting(&[], &[(8, 32)])), [0, 2, 4, 6, 8, 33, 35, 38]);
    let with_key = held(&resting(&[20], &[(8, 32)]));
    assert_eq!(with_key, [0, 2, 4, 6, 8, 20, 33, 35, 38], "what was chosen is drawn");
    let rests = [Frame(8)..=Frame(32)];
    let pace = moving(&rests);
    let room =
        |spacing: &Spacing, frame| spacing.room(&rests, clock(24.0), 40, &pace)(Frame(frame));
    assert_eq!([8, 9, 31, 32].map(|frame| room(&twos(), frame)), [true, false, false, true]);
    assert_eq!([36, 37].map(|frame| room(&twos(), frame)), [true, false], "the end begins with 38");
    let everywhere = Spacing { drift: 0.0, ..twos() };
    assert!(room(&everywhere, 20));
    let all = begins(&place(&everywhere, &resting(&[], &[(8, 32)]), 24.0, 40));
    assert_eq!(all, (0..20).map(|at| 2 * at).collect::<Vec<_>>(), "0 holds nothing");
}

#[test]
fn a_rest_at_an_end_of_the_sheet_is_held_by_one_drawing() {
    let mut keys = layer(&[20], &[]);
    keys.keys[0].origin = Origin::Rest;
    keys.rests = vec![Frame(0)..=Frame(20)];
    let begin = place(&twos(), &keys, 24.0, 28);
    assert_eq!(begins(&begin), [0, 21, 23, 26]);
    keys.rests = vec![Frame(20)..=Frame(27)];
    let end = place(&twos(), &keys, 24.0, 28);
    let expected: Vec<usize> = (0..11).map(|at| 2 * at).collect();
    assert_eq!(begins(&end), expected, "the genga holds up to the end");
    assert_eq!(end.drawings[10].role, Role::Genga);
    keys = layer(&[], &[]);
    keys.rests = vec![Frame(0)..=Frame(27)];
    let still = place(&twos(), &keys, 24.0, 28);
    assert_eq!((begins(&still), still.length()), (vec![0], 28), "it never moves");
    assert_eq!(still.drawings[0].role, Role::End);
    keys.keys = vec![Key { origin: Origin::Pinned, ..key(27, f64::INFINITY) }];
    assert_eq!(begins(&place(&twos(), &keys, 24.0, 28)), [0, 26], "a person wants it");
}

// Holds.

/// Lays out a body that takes these steps into each koma from the second on.
fn laid_out(keys: &LayerKeys, steps: &[f64], spacing: &Spacing) -> Layer {
    let pace = Pace::of_steps(steps.iter().copied());
    spacing.place(keys, &Skeleton::default(), clock(24.0), steps.len() + 1, &pace).layer
}

/// Returns frame and begin of the genga.
fn genga(layer: &Layer) -> Vec<(usize, usize)> {
    let shown = layer.timed().map(|(begin, shown)| (&layer.drawings[shown.drawing], begin));
    let genga = shown.filter(|(drawing, _)| drawing.role == Role::Genga);
    genga.map(|(drawing, begin)| (drawing.source.place() as usize, begin)).collect()
}

#[test]
fn a_genga_holds_while_the_body_hardly_gets_away_and_stands_from_when_it_is_there() {
    // Fast, slow into frame 12 and out of it, fast.
    let steps = [vec![5.0; 8], vec![0.5; 3], vec![0.1; 2], vec![0.5; 3], vec![5.0; 8]].concat();
    let layer = laid_out(&layer(&[12], &[]), &steps, &twos());
    assert_eq!(
        genga(&layer),
        [(12, 10)],
        "it is 1.1 % away on 9, and the drawing of 8 stays two koma"
    );
    assert_eq!(begins(&layer), [0, 2, 4, 6, 8, 10, 16, 18, 20, 23], "16 is 1.6 % away");
    assert_eq!(places(&layer)[5], 12.0);
    let pinned = LayerKeys {
        keys: vec![Key { origin: Origin::Pinned, ..key(12, f64::INFINITY) }],
        ..super::tests::layer(&[], &[])
    };
    let layer = laid_out(&pinned, &steps, &twos());
    assert_eq!(genga(&layer), [(12, 12)], "a person wants it there");
    let free = Spacing { drift: 0.0, ..twos() };
    let layer = laid_out(&super::tests::layer(&[12], &[]), &steps, &free);
    assert_eq!(begins(&layer), (0..11).map(|at| 2 * at).chain([23]).collect::<Vec<_>>());
}

#[test]
fn a_sheet_ends_with_what_is_held_unless_keys_are_asked_for() {
    let steps = [vec![5.0; 8], vec![0.1; 16]].concat();
    let mut keys = layer(&[9], &[]);
    let begins_of = |keys: &LayerKeys| begins(&laid_out(keys, &steps, &twos()));
    assert_eq!(begins_of(&keys), [0, 2, 4, 6, 8]);
    keys.holds_end = false;
    assert_eq!(begins_of(&keys).last(), Some(&23));
}

#[test]
fn koma_are_alike_up_to_where_the_body_is_elsewhere_on_the_way() {
    let alike = |steps: &[f64], drift| alike(&Pace::of_steps(steps.iter().copied()), drift);
    let steps = [20.0, 1.0, 1.0, 1.0, 20.0];
    assert_eq!(alike(&steps, 3.3), Alike::from_last(vec![0, 4, 4, 4, 4, 5]));
    assert_eq!(alike(&steps, 2.5), Alike::from_last(vec![0, 3, 4, 4, 4, 5]));
    assert_eq!(alike(&steps, 0.0), Alike::from_last((0..6).collect()));
}

#[test]
fn a_slow_drift_in_a_rest_is_a_moving_hold() {
    let steps = [vec![5.0; 8], vec![0.4; 20], vec![5.0; 8]].concat();
    let keys = resting(&[], &[(8, 28)]);
    let layer = laid_out(&keys, &steps, &twos());
    assert_eq!(begins(&layer)[..7], [0, 2, 4, 6, 8, 18, 28], "4 % away each");
    let layer = laid_out(&resting(&[20], &[(8, 28)]), &steps, &twos());
    assert_eq!(
        begins(&layer)[..7],
        [0, 2, 4, 6, 8, 18, 28],
        "a genga takes the place of what is like it"
    );
    assert_eq!(genga(&layer)[1], (20, 18));
}

#[test]
fn where_hardly_anything_moves_less_is_another_pose() {
    // 4 % in all: an eighth of it is below the tremble of 0.8.
    let alike = |steps: &[f64]| alike(&Pace::of_steps(steps.iter().copied()), 3.3);
    assert_eq!(alike(&[0.5; 8]), Alike::from_last(vec![1, 2, 3, 4, 5, 6, 7, 8, 8]));
    let far = alike(&[vec![10.0; 20], vec![0.5; 8]].concat());
    assert_ne!(far, alike(&[vec![1.0; 20], vec![0.5; 8]].concat()));
}

// Nearness.

#[test]
fn of_two_that_stand_too_near_the_dearer_stays_and_pins_both() {
    let near = |on, prices: [f64; 2], pinned: bool| {
        let mut keys = layer(&[10, 11], &[]);
        for (key, price) in keys.keys.iter_mut().zip(prices) {
            key.price = price;
            key.origin = if pinned { Origin::Pinned } else { Origin::Turn };
        }
        let spacing = Spacing { on: On::every(on), ..Spacing::default() };
        let layer = place(&spacing, &keys, 24.0, 22);
        let genga = layer.drawings.iter().filter(|drawing| drawing.role == Role::Genga);
        genga.map(|drawing| drawing.source.place() as usize).collect::<Vec<_>>()
    };
    for on in [2, 3] {
        assert_eq!(near(on, [5.0, 9.0], false), [11], "the impact, and none just before it");
        assert_eq!(near(on, [9.0, 5.0], false), [10]);
        assert_eq!(near(on, [9.0, 9.0], false), [10], "of equals the earlier");
        assert_eq!(near(on, [5.0, 9.0], true), [10, 11]);
    }
    assert_eq!(near(1, [5.0, 9.0], false), [10, 11], "on ones both");
}

#[test]
fn a_key_stands_on_the_two_koma_nearest_to_it_and_on_ones_on_the_nearest() {
    let koma = |on, frame| {
        let spacing = Spacing { on: On::every(on), ..Spacing::default() };
        let layer = place(&spacing, &layer(&[frame], &[]), 120.0, 41);
        let at = layer.drawings.iter().position(|drawing| drawing.role == Role::Genga).unwrap();
        begins(&layer)[at]
    };
    assert_eq!([50, 51, 52, 53, 54, 55].map(|frame| koma(2, frame)), [10, 10, 10, 10, 10, 11]);
    assert_eq!([50, 51, 52, 53, 54, 55].map(|frame| koma(1, frame)), [10, 10, 10, 11, 11, 11]);
}

proptest! {
    #[test]
    fn an_inbetween_stands_where_a_hand_pulls_it_once_its_key_has_that_weight(
        keys in prop::collection::btree_set(10usize..290, 1..6),
        walls in prop::collection::btree_set(1usize..299, 0..6),
        on in 1usize..4,
        max_shift in 0.5f64..9.0,
        share in 0.1f64..1.0,
    ) {
        let spacing = Spacing { on: On::every(on), max_shift, ..Spacing::default() };
        let keys: Vec<_> = keys.into_iter().collect();
        let walls: Vec<_> = walls.into_iter().collect();
        let (mut layer, koma) = (layer(&keys, &walls), 300);
        let even = place(&Spacing { weight: 0.0, ..spacing.clone() }, &layer, 24.0, koma);
        for (at, (begin, shown)) in even.timed().enumerate() {
            let before = even.drawings[shown.drawing].source.place();
            let Some(pull) = spacing.pulled(&layer, &even, clock(24.0), begin, before) else { continue };
            prop_assert!(pull.weight < 1e-9, "{} where it is even", pull.weight);
            let key = pull.key.0 as f64;
            let nearest = before + (key - before).clamp(-max_shift, max_shift);
            let hand = nearest + share * (before - nearest);
            let asked = spacing.pulled(&layer, &even, clock(24.0), begin, hand).unwrap();
            prop_assert_eq!(asked.key, pull.key);
            let own = layer.keys.iter().position(|key| key.frame == pull.key).unwrap();
            layer.keys[own].weight = Some(asked.weight);
            let after = place(&spacing, &layer, 24.0, koma).drawings[at].source.place();
            prop_assert!((after - hand).abs() < 1e-9, "{} for {}", after, hand);
        }
    }

    #[test]
    fn places_never_cross_and_genga_keep_their_frames(
        keys in prop::collection::btree_set(1usize..299, 0..20),
        walls in prop::collection::btree_set(1usize..299, 0..20),
        fps in prop::sample::select(vec![24.0, 30.0, 100.0, 120.0]),
        on in 1usize..5,
        weight in 0.0f64..0.99,
        max_shift in 0.0f64..4.0,
    ) {
        let spacing = Spacing { on: On::every(on), weight, max_shift, ..Spacing::default() };
        let keys: Vec<_> = keys.into_iter().collect();
        let walls: Vec<_> = walls.into_iter().collect();
        let koma = FrameRate::new(fps).unwrap().koma_from_frames(300, 24.0);
        let layer = place(&spacing, &layer(&keys, &walls), fps, koma);
        prop_assert_eq!(layer.length(), koma);
        let places = places(&layer);
        prop_assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{:?}", places);
        for (begin, exposure) in layer.timed() {
            let drawing = &layer.drawings[exposure.drawing];
            prop_assert!(exposure.koma >= on.min(2) && exposure.koma <= on + 1 || koma < 4);
            if drawing.role == Role::Genga {
                let place = drawing.source.place();
                prop_assert!(keys.contains(&(place as usize)) && place.fract() == 0.0);
                let off = (place - clock(fps).place_from_koma(begin)) / clock(fps).frames_in_koma();
                let [early, late] = if on == 1 { [-0.5, 0.5] } else { [-1e-6, 1.0 - 1e-6] };
                prop_assert!(early <= off && off <= late, "{} koma off", off);
            }
        }
    }
}
