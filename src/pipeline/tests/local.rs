//! A correction changes only its own neighbourhood.

use proptest::prelude::*;

use super::{any_recipe, not, pitch};
use crate::cases::cases;
use crate::edits::{Edits, Forbidden, Move, Pin};
use crate::motion::{Clip, bvh};
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::time::Frame;

fn keys(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> Vec<usize> {
    let breakdown = engine.run(recipe, edits).unwrap();
    breakdown.first_layer().keys.keys.iter().map(|key| key.frame.0).collect()
}

fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh");
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

fn pin(frame: usize) -> Pin {
    Pin { frame: Frame(frame), name: None, weight: None }
}

/// One correction of a frame: a pin, a forbidden frame or range, or the nearest key moved there.
#[derive(Debug, Clone, Copy)]
enum One {
    Pin(usize),
    Forbid(usize, usize),
    Move(usize, isize),
}

impl One {
    /// Adds it to the corrections; a move applies to the key nearest to its frame.
    fn put(self, edits: &mut Edits, keys: &[usize]) {
        match self {
            Self::Pin(frame) => edits.pins.push(pin(frame)),
            Self::Forbid(frame, length) => {
                edits.forbidden.push(Forbidden { from: Frame(frame), past: Frame(frame + length) });
            }
            Self::Move(near, by) => {
                let nearest = keys.iter().min_by_key(|key| key.abs_diff(near));
                if let Some(from) = nearest {
                    let to = from.saturating_add_signed(by).clamp(20, 119);
                    if to != *from {
                        let (from, to) = (Frame(*from), Frame(to));
                        edits.moves.push(Move { from, to, name: None, weight: None });
                    }
                }
            }
        }
    }

    fn alone(self, keys: &[usize]) -> Edits {
        let mut edits = Edits::default();
        self.put(&mut edits, keys);
        edits
    }

    /// Returns the range of frames it concerns, where a key is set or none may be.
    fn about(self, keys: &[usize], koma: f64) -> (usize, usize) {
        let reach = (2.0 * koma).ceil() as usize;
        match self {
            Self::Pin(frame) => (frame, frame),
            Self::Forbid(frame, length) => {
                (frame.saturating_sub(reach), frame + length - 1 + reach)
            }
            Self::Move(near, by) => {
                let from = *keys.iter().min_by_key(|key| key.abs_diff(near)).unwrap_or(&near);
                let to = from.saturating_add_signed(by).clamp(20, 119);
                (from.min(to), from.max(to))
            }
        }
    }
}

fn any_correction() -> impl Strategy<Value = One> {
    prop_oneof![
        (22..118usize).prop_map(One::Pin),
        (22..118usize, 1..6usize).prop_map(|(frame, length)| One::Forbid(frame, length)),
        (22..118usize, -5..6isize).prop_map(|(frame, by)| One::Move(frame, by)),
    ]
}

/// Returns the neighbourhood of some frames: from the key before to the key after, both far enough away to leave room
/// for two.
fn neighbourhood(keys: &[usize], (from, to): (usize, usize), apart: f64) -> (usize, usize) {
    let before = keys.iter().rev().find(|key| **key as f64 + apart <= from as f64);
    let after = keys.iter().find(|key| **key as f64 >= to as f64 + apart);
    (before.copied().unwrap_or(0), after.copied().unwrap_or(usize::MAX))
}

#[test]
fn a_key_of_the_kick_is_forbidden_and_no_other_moves() {
    let mut engine = Engine::new(kick()).unwrap();
    let recipe = Recipe::default();
    let free = keys(&mut engine, &recipe, &Edits::default());
    for at in 0..free.len() {
        let edits = Edits { forbidden: not(&[free[at]]), ..Edits::default() };
        let corrected = keys(&mut engine, &recipe, &edits);
        let begin = at.checked_sub(1).map_or(0, |at| free[at]);
        let end = free.get(at + 1).copied().unwrap_or(usize::MAX);
        // Two genga that are two koma apart give way together.
        let is_outside =
            |key: &&usize| key.abs_diff(free[at]) > 3 && !(begin < **key && **key < end);
        let outside = |keys: &[usize]| keys.iter().filter(is_outside).copied().collect::<Vec<_>>();
        assert_eq!(outside(&free), outside(&corrected), "without {}", free[at]);
        assert!(!corrected.contains(&free[at]));
        assert!(corrected.len() <= free.len(), "no more than went: {corrected:?}");
    }
    assert_eq!(keys(&mut engine, &recipe, &Edits::default()), free, "and all is as it was");
}

#[test]
fn asked_for_again_all_keys_are_chosen_around_a_correction() {
    let mut engine = Engine::new(kick()).unwrap();
    let recipe = Recipe::default();
    let free = keys(&mut engine, &recipe, &Edits::default());
    let near = Edits { forbidden: not(&[41]), ..Edits::default() };
    let again = Edits { again: true, ..near.clone() };
    let stay = |keys: &[usize]| keys.iter().filter(|key| free.contains(key)).count();
    let (near, again) = (keys(&mut engine, &recipe, &near), keys(&mut engine, &recipe, &again));
    assert_eq!((free.len(), stay(&near)), (12, 11), "only 41 goes: {near:?}");
    assert_eq!(stay(&again), 10, "37 moves as well: {again:?}");
    let none = Edits { again: true, ..Edits::default() };
    assert_eq!(keys(&mut engine, &recipe, &none), free, "with nothing to choose around");
}

#[test]
fn frozen_keys_stay_whatever_the_settings_say_and_corrections_change_them() {
    let mut engine = Engine::new(kick()).unwrap();
    let mut recipe = Recipe::default();
    let free = keys(&mut engine, &recipe, &Edits::default());
    let frozen = Edits { frozen: free.iter().copied().map(Frame).collect(), ..Edits::default() };
    let sheet = engine.run(&recipe, &Edits::default()).unwrap().sheet.clone();
    assert!(*engine.run(&recipe, &frozen).unwrap().sheet == sheet, "the very same sheet");
    recipe.set("keys.min_price", "40").unwrap();
    assert!(keys(&mut engine, &recipe, &Edits::default()).len() < free.len());
    assert_eq!(keys(&mut engine, &recipe, &frozen), free);
    let gap = free.windows(2).max_by_key(|pair| pair[1] - pair[0]).unwrap();
    let middle = usize::midpoint(gap[0], gap[1]);
    let pinned = Edits { pins: vec![pin(middle)], ..frozen.clone() };
    let mut with: Vec<usize> = free.iter().copied().chain([middle]).collect();
    with.sort_unstable();
    assert_eq!(keys(&mut engine, &recipe, &pinned), with);
    let both = Edits { again: true, ..frozen.clone() }.validate(Frame(0), Frame(91));
    assert!(both.unwrap_err().to_string().contains("frozen and to be chosen again at once"));
    let outside = frozen.validate(Frame(0), Frame(20)).unwrap_err().to_string();
    assert!(outside.contains("is not in the clip, which has frames 0 to 20"), "{outside}");
}

proptest! {
    #![proptest_config(cases(5, 60))]

    #[test]
    fn keys_outside_the_neighbourhood_of_a_correction_stay(
        recipe in any_recipe(),
        one in any_correction(),
    ) {
        let mut engine = Engine::new(pitch()).unwrap();
        let free = keys(&mut engine, &recipe, &Edits::default());
        let koma = engine.clip().clock(recipe.rate).frames_in_koma();
        let apart = koma * recipe.spacing.on.stay().max(1) as f64;
        let (begin, end) = neighbourhood(&free, one.about(&free, koma), apart);
        let corrected = keys(&mut engine, &recipe, &one.alone(&free));
        let outside = |keys: &[usize]| {
            keys.iter().copied().filter(|key| *key <= begin || *key >= end).collect::<Vec<_>>()
        };
        prop_assert_eq!(outside(&free), outside(&corrected));
        prop_assert_eq!(keys(&mut engine, &recipe, &Edits::default()), free, "undone");
    }

    #[test]
    fn corrections_far_apart_do_what_each_does_alone(
        recipe in any_recipe(),
        one in any_correction(),
        other in any_correction(),
    ) {
        let mut engine = Engine::new(pitch()).unwrap();
        let free = keys(&mut engine, &recipe, &Edits::default());
        let koma = engine.clip().clock(recipe.rate).frames_in_koma();
        let apart = koma * recipe.spacing.on.stay().max(1) as f64;
        let spans = [one, other].map(|one| neighbourhood(&free, one.about(&free, koma), apart));
        prop_assume!(spans[0].1 <= spans[1].0 || spans[1].1 <= spans[0].0);
        let mut both = one.alone(&free);
        other.put(&mut both, &free);
        let alone = [one, other].map(|one| keys(&mut engine, &recipe, &one.alone(&free)));
        let inside = |keys: &[usize], span: (usize, usize)| {
            keys.iter().copied().filter(|key| span.0 < *key && *key < span.1).collect::<Vec<_>>()
        };
        let together = keys(&mut engine, &recipe, &both);
        for (alone, span) in alone.iter().zip(spans) {
            prop_assert_eq!(inside(alone, span), inside(&together, span));
        }
    }
}
