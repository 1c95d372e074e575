//! A reused engine gives the results of a fresh one, and corrections hold.

mod local;
mod looped;
mod scoped;
pub(crate) mod walking;

use proptest::prelude::*;

use super::stage::Inputs;
use super::*;
use crate::cases::{cases, is_full};
use crate::edits::{Forbidden, Move, Pin};
use crate::keys::{self, Candidates, LayerKeys, Origin};
use crate::motion::bvh;
use crate::motion::lanes::narrow;
use crate::recipe::{KNOBS, Kind, Knob};
use crate::sheet::{Role, Source};
use crate::signal::Signals;
use crate::timing::{OmissionReport, On};

/// The synthetic pitch, cut to a hundred frames around the throw: 24 frames per second, 23 joints.
fn pitch() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/pitch.bvh");
    let clip = bvh::read(&std::fs::read(path).unwrap()).unwrap().clip;
    clip.trimmed(Frame(20), Frame(120)).unwrap()
}

/// Returns values of a knob that differ from its default, and the default itself.
fn values(knob: &Knob) -> Vec<String> {
    let mut values = match knob.kind {
        Kind::Number { min, max, whole, optional } => {
            let number = |share: f64| {
                let value = min + share * (max - min);
                if whole { value.round() } else { value }.to_string()
            };
            let mut values = vec![number(0.0), number(0.1), number(0.4)];
            values.extend(optional.then(|| "none".into()));
            values
        }
        Kind::Span => vec!["1".into(), "0.25s".into(), "500".into()],
        Kind::Amount => vec!["0".into(), "7".into(), "60%".into()],
        Kind::On => vec!["1".into(), "3".into(), "1-3".into()],
        Kind::SeenFrom => ["world", "auto", "1,9,40:0,5,0"].map(String::from).to_vec(),
        Kind::OrAuto => ["auto", "0.4", "1"].map(String::from).to_vec(),
        Kind::Band => vec!["0".into(), "900".into(), "20%".into()],
        Kind::Choice(words) => words.iter().map(|word| (*word).into()).collect(),
        Kind::Flag => vec!["true".into(), "false".into()],
        Kind::Text => vec!["genga".into()],
    };
    values.push(Recipe::default().get(knob.name).unwrap());
    values.dedup();
    values
}

/// Builds a recipe with some settings changed.
fn recipe(settings: &[(&str, &str)]) -> Recipe {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    recipe
}

/// The outputs by which two runs are compared.
#[derive(Debug, PartialEq)]
struct Result {
    clip: Clip,
    speed: Signals,
    filtered: Signals,
    turns: Vec<Vec<Turn>>,
    keys: LayerKeys,
    /// For each layer: candidates, keys, the number that did not fit, and the omissions.
    layers: Vec<(Candidates, LayerKeys, usize, OmissionReport)>,
    sheets: [Sheet; 2],
}

fn run(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> Result {
    let breakdown = engine.run(recipe, edits).unwrap();
    let made = |layer: LayerBreakdown<'_>| {
        let LayerBreakdown { candidates, keys, did_not_fit, omission, .. } = layer;
        (candidates.clone(), keys.clone(), did_not_fit, omission.clone())
    };
    Result {
        clip: breakdown.clip.clone(),
        speed: breakdown.speed.clone(),
        filtered: breakdown.filtered.clone(),
        turns: breakdown.turns.to_vec(),
        keys: breakdown.first_layer().keys.clone(),
        layers: breakdown.layers().map(made).collect(),
        sheets: [breakdown.spaced.clone(), breakdown.sheet.clone()],
    }
}

fn fresh(clip: &Clip, recipe: &Recipe, edits: &Edits) -> Result {
    run(&mut Engine::new(clip.clone()).unwrap(), recipe, edits)
}

/// Returns every knob of a sheet that is played once: the pitch is no cycle.
fn once() -> impl Iterator<Item = &'static Knob> {
    KNOBS.iter().filter(|knob| !["loop", "cycles"].contains(&knob.name))
}

/// Returns every knob at every value, in a shuffled but fixed order.
fn changes(seed: u64) -> Vec<(&'static Knob, String)> {
    let mut changes: Vec<_> =
        once().flat_map(|knob| values(knob).into_iter().map(move |v| (knob, v))).collect();
    let mut state = seed;
    for at in (1..changes.len()).rev() {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        changes.swap(at, (state >> 33) as usize % (at + 1));
    }
    changes
}

fn not(frames: &[usize]) -> Vec<Forbidden> {
    frames.iter().map(|frame| Forbidden::one(Frame(*frame))).collect()
}

fn corrections(step: usize) -> Edits {
    let pin = |frame: usize| Pin::parse(&format!("{frame}:by hand")).unwrap();
    match step % 4 {
        0 => Edits::default(),
        1 => {
            let holds = vec![Hold { frame: Frame(20 + step % 100), koma: 1 + step % 7 }];
            Edits { pins: vec![pin(20 + step % 100)], holds, ..Edits::default() }
        }
        2 => Edits { pins: vec![pin(60)], forbidden: not(&[70, 90]), ..Edits::default() },
        _ => Edits { forbidden: not(&[20 + step % 100]), ..Edits::default() },
    }
}

#[test]
fn one_knob_changed_on_a_used_engine_gives_what_a_fresh_one_gives() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let apart = if is_full() { 1 } else { 3 };
    for (knob, value) in changes(1).into_iter().step_by(apart) {
        let mut recipe = Recipe::default();
        recipe.set(knob.name, &value).unwrap();
        let edits = Edits::default();
        let used = run(&mut engine, &recipe, &edits);
        assert!(used == fresh(&clip, &recipe, &edits), "{} = {value}", knob.name);
    }
}

#[test]
fn knobs_that_stay_changed_and_corrections_that_come_and_go_give_what_a_fresh_engine_gives() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let mut recipe = Recipe::default();
    // Accumulated changes make a run slow.
    let steps = if is_full() { usize::MAX } else { 40 };
    for (step, (knob, value)) in changes(2).into_iter().enumerate().take(steps) {
        recipe.set(knob.name, &value).unwrap();
        let edits = corrections(step);
        let used = run(&mut engine, &recipe, &edits);
        assert!(used == fresh(&clip, &recipe, &edits), "{} = {value}, {edits:?}", knob.name);
    }
}

#[test]
fn an_engine_that_forgot_what_it_could_runs_on_as_before() {
    let mut engine = Engine::new(pitch()).unwrap();
    let (mut recipe, edits) = (Recipe::default(), Edits::default());
    let sheet =
        |breakdown: Breakdown<'_>| (breakdown.first_layer().keys.clone(), breakdown.sheet.clone());
    let first = sheet(engine.run(&recipe, &edits).unwrap());
    assert_eq!(sheet(engine.run_once(&recipe, &edits).unwrap()), first);
    assert_eq!(sheet(engine.run(&recipe, &edits).unwrap()), first);
    recipe.set("keys.min_price", "9").unwrap();
    engine.run_once(&recipe, &edits).unwrap();
    let mut fresh = Engine::new(pitch()).unwrap();
    assert_eq!(
        sheet(engine.run(&recipe, &edits).unwrap()),
        sheet(fresh.run(&recipe, &edits).unwrap())
    );
}

#[test]
fn a_run_that_was_stopped_goes_on_as_if_it_had_not_been() {
    let (clip, recipe, edits) = (pitch(), recipe(&[("layers", "limbs")]), Edits::default());
    let mut engine = Engine::new(clip.clone()).unwrap();
    let stop = Stop::default();
    engine.stop_with(stop.clone());
    run(&mut engine, &Recipe::default(), &edits);
    stop.ask();
    assert!(matches!(engine.run(&recipe, &edits), Err(Error::Stopped)));
    assert!(matches!(engine.find_turns(&recipe), Err(Error::Stopped)));
    engine.stop_with(Stop::default());
    assert_eq!(run(&mut engine, &recipe, &edits), fresh(&clip, &recipe, &edits));
}

#[test]
fn a_hold_changes_the_sheet_and_nothing_that_is_found() {
    let mut engine = Engine::new(pitch()).unwrap();
    let (recipe, none) = (Recipe::default(), Edits::default());
    let before = run(&mut engine, &recipe, &none);
    let held = Edits { holds: vec![Hold { frame: Frame(20), koma: 1 }], ..Edits::default() };
    let after = run(&mut engine, &recipe, &held);
    assert_ne!(after.sheets[1], before.sheets[1]);
    assert!(after.sheets[1].layers[0].drawings[0].why.hold_set);
    assert!(Result { sheets: before.sheets.clone(), ..after } == before);
    assert!(run(&mut engine, &recipe, &none) == before);
}

#[test]
fn keys_alone_do_not_make_the_sheet_old() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let (default, none) = (Recipe::default(), Edits::default());
    run(&mut engine, &default, &none);
    for (name, value) in [("filter.width", "0.3s"), ("keys.min_price", "40"), ("rate", "12")] {
        let mut recipe = default.clone();
        recipe.set(name, value).unwrap();
        engine.find_keys(&recipe, &none).unwrap();
        assert!(run(&mut engine, &recipe, &none) == fresh(&clip, &recipe, &none), "{name}");
    }
}

#[test]
fn another_persistence_needs_no_new_search() {
    let mut engine = Engine::new(pitch()).unwrap();
    let mut recipe = Recipe::default();
    let few = engine.find_turns(&recipe).unwrap().concat().len();
    let searched = (engine.joints.turning.output(),).made();
    recipe.set("turns.persistence", "1").unwrap();
    assert!(engine.find_turns(&recipe).unwrap().concat().len() > few);
    assert!((engine.joints.turning.output(),).made() == searched, "the same candidates");
    recipe.set("turns.steady", "50").unwrap();
    engine.find_turns(&recipe).unwrap();
    assert!((engine.joints.turning.output(),).made() != searched);
}

#[test]
fn turns_are_what_the_finder_finds_in_the_filtered_speeds() {
    let mut engine = Engine::new(pitch()).unwrap();
    let mut recipe = Recipe::default();
    for persistence in ["0.1s", "1", "30"] {
        recipe.set("turns.persistence", persistence).unwrap();
        let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
        let delay = recipe.filter.delay(breakdown.clip.rate());
        assert!(delay >= 1.0, "or it could be left out");
        let found = recipe.turns.find(breakdown.filtered, delay);
        assert_eq!(breakdown.turns, found, "{persistence}");
    }
}

#[test]
fn ones_to_threes_give_about_as_many_drawings_as_twos() {
    let mut engine = Engine::new(pitch()).unwrap();
    let mut drawings = |on: &str| {
        let mut recipe = Recipe::default();
        recipe.set("spacing.on", on).unwrap();
        let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
        breakdown.spaced.layers[0].drawings.len() as f64
    };
    let share = drawings("1-3") / drawings("2");
    assert!((0.7..1.4).contains(&share), "{share} of the drawings on twos");
}

#[test]
fn a_recipe_or_correction_that_is_refused_changes_nothing_afterwards() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let (default, none) = (Recipe::default(), Edits::default());
    let before = run(&mut engine, &default, &none);
    let wrong: [fn(&mut Recipe); 6] = [
        |recipe| recipe.rate = f64::NAN,
        |recipe| recipe.filter.width = crate::time::Span::Frames(-1.0),
        |recipe| recipe.keys.min_price = -1.0,
        |recipe| recipe.spacing.on = On::every(0),
        |recipe| recipe.spacing.weight = 1.0,
        |recipe| recipe.omission.max_hold = 0,
    ];
    for spoil in wrong {
        let mut recipe = Recipe::default();
        recipe.set("filter.width", "0.4s").unwrap();
        spoil(&mut recipe);
        assert!(engine.run(&recipe, &none).is_err());
        assert!(run(&mut engine, &default, &none) == before);
    }
    let outside = Edits { pins: vec![Pin::parse("19").unwrap()], ..Edits::default() };
    assert!(engine.run(&default, &outside).is_err());
    assert!(engine.find_keys(&default, &outside).is_err());
    assert!(run(&mut engine, &default, &none) == before);
}

#[test]
fn every_knob_makes_a_difference_to_what_is_made_or_to_how() {
    // Comparing with a fresh engine would not reveal a knob that nothing reads.
    let clip = pitch();
    let mut unread: Vec<&str> = once().map(|knob| knob.name).collect();
    let (mut engine, none) = (Engine::new(clip).unwrap(), Edits::default());
    let bases = [
        vec![],
        vec![("turns.reading", "literal"), ("keys.rank", "strength")],
        vec![("spacing.on", "1-3")],
        vec![("keys.rest", "60")],
        vec![("exaggerate.cartoon", "0.5"), ("exaggerate.ease", "0.8")],
        vec![("actions.length", "0.3s"), ("omission.naka_nashi", "2"), ("spacing.on", "1")],
        vec![("spacing.on", "1"), ("omission.koma_dori", "50%"), ("spacing.weight", "0.8")],
    ];
    for base in bases {
        let mut recipe = Recipe::default();
        base.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
        let result = run(&mut engine, &recipe, &none);
        unread.retain(|name| {
            !values(Knob::find(name).unwrap()).iter().any(|value| {
                let mut changed = recipe.clone();
                changed.set(name, value).unwrap();
                run(&mut engine, &changed, &none).sheets != result.sheets
            })
        });
    }
    // The pitch contains no walking.
    assert_eq!(unread, ["keys.gaits"], "no sheet ever changed with them");
    let mut engine = Engine::new(walking::clip()).unwrap();
    let mut walked = |word: &str| {
        let mut recipe = Recipe::default();
        recipe.set("keys.gaits", word).unwrap();
        run(&mut engine, &recipe, &none).sheets
    };
    assert!(walked("steps") != walked("off"));
}

#[test]
fn two_pins_on_one_koma_are_refused_and_never_lost() {
    let pins = |frames: &[usize]| {
        let pin = |frame: &usize| Pin { frame: Frame(*frame), name: None, weight: None };
        Edits { pins: frames.iter().map(pin).collect(), ..Edits::default() }
    };
    let mut engine = Engine::new(pitch()).unwrap();
    let mut recipe = Recipe::default();
    let error = engine.run(&recipe, &pins(&[60, 61, 60])).unwrap_err().to_string();
    assert_eq!(error, "edits: frame 60 is pinned or moved to twice: once is enough");
    recipe.rate = 12.0;
    let error = engine.run(&recipe, &pins(&[62, 40, 61])).unwrap_err().to_string();
    assert_eq!(
        error,
        "edits: frames 61 and 62, pinned or moved to, fall on one koma, 22: take one of them away"
    );
    let moved = Edits { moves: vec![Move::parse("30:61").unwrap()], ..pins(&[62]) };
    let error = engine.run(&recipe, &moved).unwrap_err().to_string();
    assert!(error.contains("frames 61 and 62, pinned or moved to"), "{error}");
    let breakdown = engine.run(&recipe, &pins(&[60, 61])).unwrap();
    let pinned = |drawing: &&crate::sheet::Drawing| drawing.why.pinned.is_some();
    assert_eq!(breakdown.sheet.layers[0].drawings.iter().filter(pinned).count(), 2);
}

#[test]
fn a_layer_of_all_joints_is_the_body() {
    let clip = pitch();
    let none = Edits::default();
    let body = fresh(&clip, &Recipe::default(), &none);
    for all in [r#"[{ name = "A", joints = ["*"] }]"#, r#"[{ name = "A", joints = ["Hips"] }]"#] {
        assert!(fresh(&clip, &recipe(&[("layers", all)]), &none) == body, "{all}");
    }
}

#[test]
fn each_layer_has_keys_for_what_its_own_joints_do() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let breakdown = engine.run(&recipe(&[("layers", "limbs")]), &Edits::default()).unwrap();
    let names: Vec<&str> = breakdown.sheet.layers.iter().map(|layer| &layer.name[..]).collect();
    assert_eq!(names, ["A", "B", "C", "D", "E"]);
    let mut timings = Vec::new();
    for LayerBreakdown { keys, layer, spaced, .. } in breakdown.layers() {
        let own = |joint: &crate::motion::JointId| {
            layer.joints.contains(&clip.skeleton().joints[joint.0].name)
        };
        assert!(keys.keys.len() > 2, "{}: {:?}", layer.name, keys.keys);
        assert!(keys.keys.iter().flat_map(|key| &key.voters).all(own), "{}", layer.name);
        assert_eq!((layer.length(), spaced.length()), (100, 100));
        timings.push(layer.exposures.clone());
    }
    timings.dedup();
    assert_eq!(timings.len(), 5, "each has its own timing");
    let mut joints: Vec<&String> =
        breakdown.sheet.layers.iter().flat_map(|layer| &layer.joints).collect();
    joints.sort_unstable();
    joints.dedup();
    assert_eq!(joints.len(), clip.skeleton().len());
}

#[test]
fn a_limb_that_does_not_move_has_no_keys_however_the_body_goes() {
    let clip = pitch();
    let layers = recipe(&[("layers", "limbs")]);
    let limbs = layers.layers.split(&clip).unwrap();
    let mut moves = vec![true; clip.skeleton().len()];
    limbs[2].joints.iter().for_each(|joint| moves[joint.0] = false);
    let mut engine = Engine::new(clip.with_others_still(&moves)).unwrap();
    let breakdown = engine.run(&layers, &Edits::default()).unwrap();
    let keys: Vec<usize> = breakdown.layers().map(|layer| layer.keys.keys.len()).collect();
    assert_eq!(keys[2], 0, "{keys:?}");
    assert!(keys[0] > 2, "{keys:?}");
}

#[test]
fn a_correction_of_one_layer_leaves_the_others_alone() {
    let clip = pitch();
    let layers = recipe(&[("layers", "limbs")]);
    let mut engine = Engine::new(clip.clone()).unwrap();
    let free = run(&mut engine, &layers, &Edits::default());
    let is_free =
        |frame: &usize| free.layers[1].1.keys.iter().all(|key| key.frame.0.abs_diff(*frame) > 3);
    let frame = (30..110).find(is_free).unwrap();
    let mut edits = Edits::default();
    edits.pins_of(Some("B")).push(Pin::parse(&format!("{frame}:here")).unwrap());
    let pinned = run(&mut engine, &layers, &edits);
    assert!(pinned == fresh(&clip, &layers, &edits));
    for layer in [0, 2, 3, 4] {
        assert_eq!(pinned.sheets[1].layers[layer], free.sheets[1].layers[layer]);
    }
    let is_pinned = |key: &keys::Key| key.frame == Frame(frame) && key.origin == Origin::Pinned;
    assert!(pinned.layers[1].1.keys.iter().any(is_pinned));
    let error = engine.run(&Recipe::default(), &edits).unwrap_err().to_string();
    assert_eq!(error, "edits: there is no layer B to correct; there is A (see --layers)");
    assert!(run(&mut engine, &layers, &edits) == pinned);
}

#[test]
fn layers_that_come_and_go_give_what_a_fresh_engine_gives() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let none = Edits::default();
    let arms = r#"[{ name = "A", joints = ["Hips"] }, { name = "arms", joints = ["*Arm*"] }]"#;
    let back = r#"[{ name = "arms", joints = ["*Arm*"] }, { name = "A", joints = ["Hips"] }]"#;
    for layers in ["limbs", "body", arms, "joints", back, "limbs"] {
        let turned = [("root", "ones"), ("keys.weights.LeftArm", "3"), ("spacing.on", "3")];
        for (knob, value) in turned.into_iter().take(if is_full() { 3 } else { 2 }) {
            let recipe = recipe(&[("layers", layers), (knob, value)]);
            engine.find_keys(&recipe, &none).unwrap();
            let used = run(&mut engine, &recipe, &none);
            assert!(used == fresh(&clip, &recipe, &none), "{layers} {knob}");
        }
    }
    let once = recipe(&[("layers", "limbs")]);
    let sheet = engine.run_once(&once, &none).unwrap().sheet.clone();
    assert_eq!(sheet, fresh(&clip, &once, &none).sheets[1]);
    assert!(
        run(&mut engine, &once, &none) == fresh(&clip, &once, &none),
        "forgotten and made again"
    );
}

#[test]
fn a_layer_without_a_say_is_refused_by_its_name() {
    let mut engine = Engine::new(pitch()).unwrap();
    let arms = r#"[{ name = "A", joints = ["Hips"] }, { name = "arm", joints = ["LeftArm"] }]"#;
    let mute = recipe(&[("layers", arms), ("keys.weights.LeftArm", "0")]);
    let error = engine.run(&mute, &Edits::default()).unwrap_err().to_string();
    assert!(error.starts_with("keys.weights: every joint of layer arm has 0"), "{error}");
}

#[test]
fn nothing_is_moved_where_nothing_was_found() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let recipe = Recipe::default();
    let before = run(&mut engine, &recipe, &Edits::default());
    let is_empty =
        |frame: &usize| before.keys.keys.iter().all(|key| key.frame.0.abs_diff(*frame) >= 5);
    let from = (30..110).find(is_empty).unwrap();
    let edits = |to: usize| Edits {
        moves: vec![Move { from: Frame(from), to: Frame(to), name: None, weight: None }],
        ..Edits::default()
    };
    assert_eq!(run(&mut engine, &recipe, &edits(from + 5)), before);
}

#[test]
fn what_all_joints_weigh_is_nothing_and_what_one_weighs_is_something() {
    let mut engine = Engine::new(pitch()).unwrap();
    let mut keys = |merge: &str, weights: &[(&str, &str)]| {
        let mut recipe = Recipe::default();
        recipe.set("keys.merge", merge).unwrap();
        for (joint, weight) in weights {
            recipe.set(&format!("keys.weights.{joint}"), weight).unwrap();
        }
        engine.run(&recipe, &Edits::default()).unwrap().first_layer().keys.clone()
    };
    for merge in ["body", "union", "vote"] {
        let plain = keys(merge, &[]);
        assert_eq!(keys(merge, &[("*", "2")]), plain, "{merge}");
        assert_ne!(keys(merge, &[("*Foot", "8")]), plain, "{merge}");
        assert_ne!(keys(merge, &[("*Foot", "0")]), plain, "{merge}");
    }
}

#[test]
fn a_joint_without_a_say_is_nobody_s_reason() {
    let clip = pitch();
    let feet = |name: &str| name.contains("Foot") || name.contains("Toe");
    let mute = |joint: &crate::motion::JointId| !feet(&clip.skeleton().joints[joint.0].name);
    let mut engine = Engine::new(clip.clone()).unwrap();
    let mut recipe = Recipe::default();
    recipe.set("keys.merge", "union").unwrap();
    for (joint, weight) in [("*", "0"), ("*Foot*", "1"), ("*Toe*", "1")] {
        recipe.set(&format!("keys.weights.{joint}"), weight).unwrap();
    }
    let made = engine.run(&recipe, &Edits::default()).unwrap();
    assert!(made.first_layer().keys.keys.len() > 3, "{:?}", made.first_layer().keys);
    for key in made.first_layer().keys.keys.iter().filter(|key| key.origin.is_found()) {
        assert!(!key.voters.is_empty() && !key.voters.iter().any(mute), "{key:?}");
    }
    // The turns of every joint are still known.
    let turns = engine.find_keys(&recipe, &Edits::default()).unwrap().turns;
    assert!(turns.iter().filter(|turns| !turns.is_empty()).count() > 8);
    let error = recipe.set("keys.weights.*Foot*", "none").and_then(|()| {
        recipe.set("keys.weights.*Toe*", "0")?;
        engine.run(&recipe, &Edits::default()).map(drop)
    });
    assert!(error.unwrap_err().to_string().contains("every joint has 0"));
}

/// Generates recipes with some knobs at arbitrary values.
fn any_recipe() -> impl Strategy<Value = Recipe> {
    let turn = (prop::sample::select(once().collect::<Vec<_>>()), any::<prop::sample::Index>());
    prop::collection::vec(turn, 0..8).prop_map(|turns| {
        let mut recipe = Recipe::default();
        for (knob, value) in turns {
            let values = values(knob);
            recipe.set(knob.name, &values[value.index(values.len())]).unwrap();
        }
        recipe
    })
}

proptest! {
    #![proptest_config(cases(2, 60))]

    #[test]
    fn registers_of_any_width_give_the_same_bits(recipe in any_recipe()) {
        let clip = pitch();
        let bits = || format!("{:?}", fresh(&clip, &recipe, &Edits::default()));
        prop_assert_eq!(narrow(bits), bits());
    }

    #[test]
    fn a_pin_stands_on_its_koma_whatever_the_recipe(recipe in any_recipe(), frame in 20usize..120) {
        let clip = pitch();
        let mut engine = Engine::new(clip).unwrap();
        let pin = Pin { frame: Frame(frame), name: Some("hand".into()), weight: None };
        let edits = Edits { pins: vec![pin], ..Edits::default() };
        let breakdown = engine.run(&recipe, &edits).unwrap();
        prop_assert!(breakdown.first_layer().keys.keys.iter().any(|key| key.frame == Frame(frame)));
        for sheet in [breakdown.spaced, breakdown.sheet] {
            let layer = &sheet.layers[0];
            let pinned: Vec<_> = layer
                .timed()
                .map(|(begin, exposure)| (begin, &layer.drawings[exposure.drawing]))
                .filter(|(_, drawing)| drawing.why.pinned.as_deref() == Some("hand"))
                .collect();
            prop_assert_eq!(pinned.len(), 1, "{:?}", layer);
            let (begin, drawing) = pinned[0];
            prop_assert_eq!(drawing.source, Source::At(frame as f64));
            let last = breakdown.spaced.length() - 1;
            let koma = breakdown.clock.koma_from_frame(Frame(frame)).min(last);
            if !(recipe.omission.keep_length || sheet == breakdown.spaced) {
                continue;
            }
            if drawing.role == Role::Genga {
                let is_after = (frame as f64) < breakdown.clock.place_from_koma(koma);
                prop_assert!(begin == koma || (is_after && begin + 1 == koma), "{} for {}", begin, koma);
            } else {
                prop_assert_eq!(drawing.role, Role::End);
                prop_assert!(koma < 2 || koma + 2 > last || last < 3, "{} of {}", koma, last);
            }
        }
    }

    #[test]
    fn a_moved_key_stands_where_it_is_moved_and_the_others_as_they_were(
        recipe in any_recipe(),
        chosen in any::<prop::sample::Index>(),
        to in 22usize..118,
    ) {
        let mut engine = Engine::new(pitch()).unwrap();
        let free = engine.run(&recipe, &Edits::default()).unwrap();
        let (apart, koma) = (free.clock.frames_in_koma(), free.spaced.length());
        let found: Vec<Frame> = free.first_layer().keys.keys.iter().map(|key| key.frame).collect();
        prop_assume!(!found.is_empty());
        let from = found[chosen.index(found.len())];
        let moved = Move { from, to: Frame(to), name: Some("there".into()), weight: Some(0.9) };
        prop_assume!(from != moved.to);
        let edits = Edits { moves: vec![moved], ..Edits::default() };
        let breakdown = engine.run(&recipe, &edits).unwrap();
        let near = |a: Frame, b: Frame| (a.0.abs_diff(b.0) as f64) < apart;
        let others = |frame: &&Frame| **frame != from && !near(**frame, Frame(to));
        let mut expected: Vec<Frame> = found.iter().filter(others).copied().collect();
        expected.push(Frame(to));
        expected.sort_unstable();
        let frames: Vec<Frame> = breakdown.first_layer().keys.keys.iter().map(|key| key.frame).collect();
        prop_assert_eq!(frames, expected, "all other keys are as they were");
        for key in &breakdown.first_layer().keys.keys {
            if key.frame == Frame(to) {
                prop_assert_eq!(key.origin, keys::Origin::Moved { from });
                prop_assert_eq!((key.name.as_deref(), key.weight), (Some("there"), Some(0.9)));
            }
        }
        prop_assert!(breakdown.first_layer().keys.keys.iter().any(|key| key.frame == Frame(to)));
        let at = breakdown.clock.koma_from_place(to as f64);
        if (1..koma - 1).contains(&at) {
            let shown = |drawing: &crate::sheet::Drawing| {
                drawing.why.moved_from == Some(from.0) && drawing.source == Source::At(to as f64)
            };
            prop_assert_eq!(breakdown.sheet.layers[0].drawings.iter().filter(|d| shown(d)).count(), 1);
        }
    }

    #[test]
    fn a_forbidden_range_is_every_frame_of_it_forbidden(
        recipe in any_recipe(),
        from in 15..118usize,
        length in 6..40usize,
    ) {
        let mut engine = Engine::new(pitch()).unwrap();
        let last = (from + length).min(120);
        let single = (from.max(20)..last).map(|frame| Forbidden::one(Frame(frame)));
        let singles = Edits { forbidden: single.collect(), ..Edits::default() };
        let range = Forbidden { from: Frame(from), past: Frame(from + length) };
        let edits = Edits { forbidden: vec![range], ..Edits::default() };
        prop_assert!(run(&mut engine, &recipe, &edits) == run(&mut engine, &recipe, &singles));
    }

    #[test]
    fn where_only_pins_are_keys_there_are_no_others(
        recipe in any_recipe(),
        pins in prop::collection::btree_set(22usize..118, 1..9),
    ) {
        let mut engine = Engine::new(pitch()).unwrap();
        let pin = |frame: &usize| Pin { frame: Frame(*frame), name: None, weight: None };
        let edits =
            Edits { pins: pins.iter().map(pin).collect(), only_pins: true, ..Edits::default() };
        if let Ok(breakdown) = engine.run(&recipe, &edits) {
            let keys: Vec<usize> = breakdown.first_layer().keys.keys.iter().map(|key| key.frame.0).collect();
            prop_assert_eq!(keys, pins.into_iter().collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_key_is_found_within_two_koma_of_a_forbidden_frame(
        recipe in any_recipe(),
        chosen in any::<prop::sample::Index>(),
    ) {
        let mut engine = Engine::new(pitch()).unwrap();
        let free = engine.run(&recipe, &Edits::default()).unwrap();
        let koma = free.clock.frames_in_koma();
        let found: Vec<Frame> = free.first_layer().keys.keys.iter().map(|key| key.frame).collect();
        prop_assume!(!found.is_empty());
        let forbidden = found[chosen.index(found.len())];
        let edits = Edits { forbidden: vec![Forbidden::one(forbidden)], ..Edits::default() };
        let breakdown = engine.run(&recipe, &edits).unwrap();
        for key in &breakdown.first_layer().keys.keys {
            prop_assert!(key.frame.0.abs_diff(forbidden.0) as f64 > 2.0 * koma, "{key:?}");
        }
        let shown = |drawing: &crate::sheet::Drawing| {
            drawing.role == Role::Genga && drawing.source == Source::At(forbidden.0 as f64)
        };
        prop_assert!(!breakdown.sheet.layers[0].drawings.iter().any(shown));
    }
}
