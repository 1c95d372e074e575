//! A law of all stages together: on twos and threes no drawing stays for one koma, unless a person asked for it.

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use crate::edits::Hold;
use crate::keys::{Key, LayerKeys, Origin, Wall};
use crate::motion::Skeleton;
use crate::sheet::Layer;
use crate::time::{Clock, Frame, FrameRate};

/// Frames of the clips, at 30 per second.
const FRAMES: usize = 150;

fn clock() -> Clock {
    Clock { first: Frame(0), frame_rate: FrameRate::new(30.0).unwrap(), koma_rate: 24.0 }
}

fn length() -> usize {
    clock().frame_rate.koma_from_frames(FRAMES, clock().koma_rate)
}

fn key((frame, (price, origin)): (usize, (f64, Origin))) -> Key {
    let (voters, weight, name) = (Vec::new(), None, None);
    let price = if origin.is_found() { price } else { f64::INFINITY };
    Key { frame: Frame(frame), strength: 0.5, price, voters, weight, name, origin }
}

fn origin() -> impl Strategy<Value = Origin> {
    prop_oneof![
        12 => Just(Origin::Turn),
        2 => Just(Origin::Rest),
        1 => Just(Origin::Contact),
        1 => Just(Origin::Pinned),
    ]
}

prop_compose! {
    /// Generates keys as close as one frame, with walls and rests anywhere; of two pins on one koma, keeps the first.
    fn layer()(
        keys in prop::collection::btree_map(0..FRAMES, (0.0..9.0, origin()), 0..60),
        walls in prop::collection::btree_set(0..FRAMES, 0..9),
        rests in prop::collection::vec((0..FRAMES, 0..40usize), 0..4),
    ) -> LayerKeys {
        let mut keys: Vec<Key> = keys.into_iter().map(key).collect();
        let koma = |key: &Key| clock().koma_from_frame(key.frame);
        let mut pinned = None;
        for key in keys.iter_mut().filter(|key| key.origin.is_set()) {
            if pinned.replace(koma(key)) == Some(koma(key)) {
                key.origin = Origin::Turn;
            }
        }
        let rest = |(begin, frames): (usize, usize)| Frame(begin)..=Frame((begin + frames).min(FRAMES - 1));
        LayerKeys {
            gaits: Vec::new(),
            keys,
            walls: walls.into_iter().map(|frame| Wall { frame: Frame(frame), strength: 1.0 }).collect(),
            rests: rests.into_iter().map(rest).collect(),
            holds_end: true,
        over_limit: 0,
            without_corrections: Vec::new(),
        }
    }
}

fn on() -> impl Strategy<Value = On> {
    let range = (1..4usize, 0..3usize).prop_map(|(least, more)| On { least, most: least + more });
    prop_oneof![(1..5usize).prop_map(On::every), range]
}

prop_compose! {
    fn omission()(
        naka_nashi in 0..9usize,
        koma_dori in 0..40usize,
        max_hold in 1..7usize,
        keep_length: bool,
        all_at_once: bool,
        koma_dori_first: bool,
    ) -> Omission {
        let [naka_nashi, koma_dori] = [naka_nashi, koma_dori].map(Amount::Count);
        let order = if koma_dori_first { Order::KomaDoriFirst } else { Order::NakaNashiFirst };
        let fast = if max_hold > 3 { 2.0 } else { 0.0 };
        let small = if all_at_once { 3.3 } else { 100.0 };
        Omission { naka_nashi, koma_dori, fast, small, max_hold, keep_length, all_at_once, order }
    }
}

/// Builds stills of a layer whose drawings lie anywhere on a line.
fn stills(layer: &Layer, places: &[f64]) -> Stills {
    let mut stills = Stills::new(1);
    let places = places.iter().cycle().take(layer.drawings.len());
    places.for_each(|place| stills.push(&[DVec3::X * *place]));
    stills
}

const NONE: [usize; 0] = [];

/// Returns the koma of drawings that stay for one koma without a reason; `may` says at which places that is allowed.
fn twitches(layer: &Layer, may: impl Fn(f64) -> bool) -> Vec<usize> {
    let shown: Vec<_> = layer.timed().collect();
    let drawing = |at: usize| &layer.drawings[shown[at].1.drawing];
    let is_set = |at: usize| {
        at < shown.len() && (drawing(at).why.pinned.is_some() || drawing(at).why.hold_set)
    };
    let twitch = |at: &usize| {
        let is_asked = is_set(*at) || is_set(at + 1) || (*at > 0 && is_set(at - 1));
        shown[*at].1.koma == 1 && !is_asked && !may(drawing(*at).source.place())
    };
    (0..shown.len()).filter(twitch).map(|at| shown[at].0).collect()
}

proptest! {
    #![proptest_config(cases(400, 2000))]

    #[test]
    fn nothing_stays_for_one_koma_where_drawings_are_not_on_ones(
        keys in layer(),
        on in on(),
        inbetweens in prop::option::weighted(0.2, 0..5usize),
        drift in prop::sample::select(vec![0.0, 1.0]),
        steps in prop::collection::vec(0.0..30.0, length() - 1),
        places in prop::collection::vec(0.0..50.0, 7),
        omission in omission(),
        holds in prop::collection::btree_map(0..FRAMES, 1..9usize, 0..4),
    ) {
        let spacing = Spacing { on, inbetweens, drift, ..Spacing::default() };
        let pace = Pace::of_steps(steps.into_iter());
        let spaced = spacing.place(&keys, &Skeleton::default(), clock(), length(), &pace).layer;
        // In a range, fast drawings are on ones; the koma before decides for the end.
        let last = length() - 1;
        let is_fast = |koma: usize| on.from(koma.min(last - 1), &pace, spacing.step) == 1;
        let fast: Vec<f64> = spaced
            .timed()
            .filter(|(begin, _)| is_fast(*begin))
            .map(|(_, shown)| spaced.drawings[shown.drawing].source.place())
            .collect();
        prop_assert_eq!(twitches(&spaced, |place| fast.contains(&place)), NONE, "{:?}", spaced.exposures);
        let course = Course { on: on.into(), height: 100.0, ..Course::default() };
        let stills = stills(&spaced, &places);
        let omitted = omission.apply_to(&spaced, &stills, &course).unwrap().layer;
        prop_assert_eq!(twitches(&omitted, |place| fast.contains(&place)), NONE, "{:?}", omitted.exposures);
        let holds: Vec<Hold> =
            holds.into_iter().map(|(frame, koma)| Hold { frame: Frame(frame), koma }).collect();
        let held = with_holds(&omitted, &spaced, &holds, clock());
        prop_assert_eq!(twitches(&held, |_| on.least == 1), NONE, "{:?}", held.exposures);
        prop_assert_eq!(held.length(), omitted.length());
    }

    #[test]
    fn nothing_stays_for_one_koma_at_the_ends_of_a_passage(
        keys in layer(),
        ons in prop::collection::vec(on(), 2..5),
        begins in prop::collection::btree_set(1..length(), 4),
        drifts in prop::collection::vec(prop::sample::select(vec![0.0, 1.0]), 4),
        steps in prop::collection::vec(0.0..30.0, length() - 1),
        places in prop::collection::vec(0.0..50.0, 7),
        omissions in prop::collection::vec(omission(), 4),
    ) {
        let begins: Vec<usize> = begins.into_iter().take(ons.len() - 1).collect();
        let ends = begins.iter().skip(1).copied().chain([length()]);
        let passages: Vec<_> = begins.iter().zip(ends).map(|(begin, end)| *begin..end).collect();
        let own = |koma: usize| begins.partition_point(|begin| *begin <= koma);
        let spacing = ByPassage::new(&passages, |koma| {
            let (on, drift) = (ons[own(koma).min(ons.len() - 1)], drifts[own(koma) % 4]);
            Spacing { on, drift, ..Spacing::default() }
        });
        let pace = Pace::of_steps(steps.into_iter());
        let spaced = spacing.place(&keys, &Skeleton::default(), clock(), length(), &pace).layer;
        let begun: Vec<f64> = spaced.drawings.iter().map(|drawing| drawing.source.place()).collect();
        prop_assert!(begun.is_sorted(), "{:?}", begun);
        // Near a change, the koma of either side may decide for a drawing that was moved there.
        let may_be_one = |koma: usize| {
            let near = koma.saturating_sub(1)..=(koma + 1).min(length() - 1);
            near.into_iter().any(|koma| spacing.at(koma).on.least == 1)
        };
        let ones: Vec<f64> = spaced
            .timed()
            .filter(|(begin, _)| may_be_one(*begin))
            .map(|(_, shown)| spaced.drawings[shown.drawing].source.place())
            .collect();
        prop_assert_eq!(twitches(&spaced, |place| ones.contains(&place)), NONE, "{:?}", spaced.exposures);
        let omission = ByPassage::new(&passages, |koma| {
            let Omission { order, .. } = omissions[0];
            Omission { order, all_at_once: false, ..omissions[own(koma) % 4] }
        });
        let on = spacing.map(|own| own.on);
        let course = Course { on, height: 100.0, ..Course::default() };
        let stills = stills(&spaced, &places);
        let omitted = omission.apply_to(&spaced, &stills, &course).unwrap().layer;
        prop_assert_eq!(twitches(&omitted, |place| ones.contains(&place)), NONE, "{:?}", omitted.exposures);
    }

    #[test]
    fn pins_are_on_the_sheet_whatever_lies_near(keys in layer(), on in on()) {
        let spacing = Spacing { on, ..Spacing::default() };
        let spaced = spacing.place(&keys, &Skeleton::default(), clock(), length(), &Pace::default()).layer;
        for pin in keys.keys.iter().filter(|key| key.origin.is_set()) {
            let is_it = |place: f64| place == pin.frame.0 as f64;
            prop_assert!(spaced.drawings.iter().any(|drawing| is_it(drawing.source.place())), "{:?}", pin);
        }
        prop_assert_eq!(spaced.length(), length());
    }
}
