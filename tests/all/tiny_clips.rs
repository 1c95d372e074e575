//! The smallest clips with any recipe give a clear error or a sensible sheet, never a panic.

use crate::cases::cases;
use genga::edits::{Edits, Forbidden, Hold, Move, Pin};
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::pipeline::Budget;
use genga::pipeline::{Breakdown, Engine};
use genga::recipe::{KNOBS, Kind, Recipe};
use genga::sheet::Role;
use genga::time::{Frame, FrameRate, Span};
use genga_files::{Drawings, Report, Rows};
use genga_lab::study::{Measure, Study};
use genga_plot::{PoseRow, SheetPlot, SpeedPlot, XSheet};
use glam::DVec3;
use proptest::prelude::*;

fn skeleton(joints: usize) -> Skeleton {
    let tip = EndSite { name: "Site".into(), offset: DVec3::X };
    let joint = |at: usize| Joint {
        name: format!("j{at}"),
        parent: at.checked_sub(1).map(JointId),
        offset: DVec3::Y * (at % 3) as f64,
        channels: match at {
            0 => vec![Channel::Position(Axis::X), Channel::Rotation(Axis::Z)],
            1 => [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation).to_vec(),
            _ => vec![Channel::Rotation(Axis::X)],
        },
        first_channel: [0, 2, 5][at],
        end_sites: if at == 2 { vec![tip.clone()] } else { vec![] },
    };
    Skeleton { joints: (0..joints).map(joint).collect() }
}

fn clip(joints: usize, frames: usize, fps: f64, values: impl Fn(usize) -> f64) -> Clip {
    let skeleton = skeleton(joints);
    let values = (0..frames * skeleton.channels()).map(values).collect();
    Clip::new(skeleton, FrameRate::new(fps).unwrap(), Frame(7), frames, values).unwrap()
}

fn any_clip() -> impl Strategy<Value = Clip> {
    let frames = prop_oneof![4 => 1..6usize, 2 => 6..60usize];
    let value = prop_oneof![
        3 => Just(0.0),
        3 => (-3..3i32).prop_map(f64::from),
        3 => -400.0..400.0,
        1 => prop::sample::select(&[1e-9, 1e9, -1e12][..]),
    ];
    let fps = prop::sample::select(&[1.0, 24.0, 29.97, 30.0, 100.0, 120.0][..]);
    (1..4usize, frames, fps).prop_flat_map(move |(joints, frames, fps)| {
        let size = frames * skeleton(joints).channels();
        prop::collection::vec(value.clone(), size)
            .prop_map(move |values| clip(joints, frames, fps, |at| values[at]))
    })
}

/// A value that a person could give a knob, sensible or not.
fn any_setting() -> impl Strategy<Value = (String, String)> {
    // A clip of random values is no cycle, and only a loop has several rounds.
    let knobs = KNOBS.iter().filter(|knob| !["loop", "cycles"].contains(&knob.name));
    prop::sample::select(knobs.collect::<Vec<_>>()).prop_flat_map(|knob| {
        let words: Vec<String> = match knob.kind {
            Kind::Number { .. } => {
                ["0", "1", "2", "3", "0.5", "0.95", "17", "1000", "1e9", "none", "-1"]
                    .map(String::from)
                    .to_vec()
            }
            Kind::Span => ["0", "1", "3.5", "0.1s", "2s", "1000", "0s", "1e6s", "1e300"]
                .map(String::from)
                .to_vec(),
            Kind::Amount => ["0", "1", "5", "1000", "4%", "100%", "1/3"].map(String::from).to_vec(),
            Kind::On => ["0", "1", "3", "1000", "1-3", "3-1", "1-1000"].map(String::from).to_vec(),
            Kind::SeenFrom => {
                ["world", "auto", "front", "0,1,9:0,1,0", "0,0,0:0,0,0"].map(String::from).to_vec()
            }
            Kind::OrAuto => ["auto", "0", "0.3", "1", "2"].map(String::from).to_vec(),
            Kind::Band => ["0", "1", "100", "1e9", "5%", "100%"].map(String::from).to_vec(),
            Kind::Choice(words) => words.iter().map(|word| (*word).into()).collect(),
            Kind::Flag => vec!["true".into(), "false".into()],
            Kind::Text => vec!["genga".into()],
        };
        (Just(knob.name.to_owned()), prop::sample::select(words))
    })
}

/// The recipe with these settings; refused values are skipped.
fn recipe(settings: &[(String, String)]) -> Recipe {
    let mut recipe = Recipe::default();
    for (name, value) in settings {
        let _ = recipe.set(name, value);
    }
    recipe
}

fn is_sensible(breakdown: &Breakdown, recipe: &Recipe) {
    let Breakdown { clip, spaced, sheet, .. } = *breakdown;
    let koma = clip.rate().koma_from_frames(clip.len(), recipe.rate);
    assert_eq!(spaced.length(), koma);
    if recipe.omission.keep_length {
        assert_eq!(sheet.length(), koma);
    }
    for layer in spaced.layers.iter().chain(&sheet.layers) {
        let places: Vec<f64> =
            layer.drawings.iter().map(|drawing| drawing.source.place()).collect();
        assert!(places.is_sorted_by(|a, b| a < b), "{places:?}");
        let (first, last) = (clip.first().0 as f64, clip.last().0 as f64);
        assert!(places[0] >= first && places[places.len() - 1] <= last, "{places:?}");
        assert!(layer.exposures.iter().all(|exposure| exposure.koma > 0));
        assert_eq!(layer.drawings[0].role, Role::End);
        // The last genga may hold up to the end.
        assert!(layer.drawings[layer.drawings.len() - 1].role.is_kept());
    }
}

/// Writes and draws every output.
fn hand_over(breakdown: &Breakdown) {
    let Breakdown { clip, spaced, sheet, speed, filtered, turns, .. } = *breakdown;
    for rows in [Rows::All, Rows::Keys] {
        Drawings { cut: "tiny".into(), rows }.write(clip, sheet).unwrap();
    }
    genga_files::sheet_csv(sheet).unwrap();
    genga_files::remap_csv(sheet).unwrap();
    genga_files::turns_csv(clip.skeleton(), filtered, turns).unwrap();
    genga_files::xdts::Xdts::default().write(sheet, "tiny").unwrap();
    genga_files::xsheet(&XSheet::default(), "tiny", clip, sheet).unwrap();
    let limited = genga_files::limited_bvh(clip, sheet).unwrap();
    let read = genga::motion::bvh::read(limited.as_bytes()).unwrap();
    assert_eq!(read.clip.len(), sheet.length());
    let report = Report::new(breakdown, vec![]);
    assert!(report.genga_per_second.is_finite() && report.drawings_per_second.is_finite());
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    let keys: Vec<Frame> = breakdown.first_layer().keys.keys.iter().map(|key| key.frame).collect();
    let order: Vec<JointId> = (0..names.len()).map(JointId).collect();
    SpeedPlot::default().draw(&names, speed, filtered, turns, &keys, &order).unwrap();
    SheetPlot::default().draw(sheet, Some(spaced), None).unwrap();
    PoseRow::default().draw(clip, &[(clip.first().0 as f64, "1".into(), Role::End)]).unwrap();
}

proptest! {
    #![proptest_config(cases(150, 1500))]

    #[test]
    fn any_tiny_clip_with_any_recipe_gives_a_sheet_or_an_error(
        clip in any_clip(),
        settings in prop::collection::vec(any_setting(), 0..10),
        pin in prop::option::of(any::<prop::sample::Index>()),
        forbidden in prop::option::of((7..20usize, 1..4usize)),
        moved in prop::option::of((7..20usize, 7..20usize)),
        held in prop::option::of((7..20usize, 1..9usize)),
        (only_pins, again) in (prop::bool::weighted(0.1), any::<bool>()),
        frozen in prop::option::weighted(0.2, 7..20usize),
        split in prop::option::of(7..20usize),
    ) {
        let recipe = recipe(&settings);
        let pinned = pin.map(|pin| Frame(7 + pin.index(clip.len())));
        let pins = pinned.map(|frame| Pin { frame, name: None, weight: Some(0.9) });
        let range = |(from, length)| Forbidden { from: Frame(from), past: Frame(from + length) };
        let move_to = |(from, to)| Move { from: Frame(from), to: Frame(to), name: None, weight: None };
        let hold = |(frame, koma)| Hold { frame: Frame(frame), koma };
        let edits = Edits {
            pins: pins.into_iter().collect(),
            forbidden: forbidden.map(range).into_iter().collect(),
            moves: moved.map(move_to).into_iter().collect(),
            holds: held.map(hold).into_iter().collect(),
            only_pins,
            again,
            frozen: frozen.into_iter().map(Frame).collect(),
            splits: split.map(Frame).into_iter().collect(),
            ..Edits::default()
        };
        let mut engine = Engine::new(clip).unwrap();
        match engine.run(&recipe, &edits) {
            Ok(breakdown) => {
                is_sensible(&breakdown, &recipe);
                hand_over(&breakdown);
            }
            Err(error) => prop_assert!(error.to_string().len() > 10, "{error}"),
        }
    }
}

#[test]
fn a_clip_without_a_frame_or_a_joint_is_refused_in_words() {
    for clip in [clip(2, 0, 24.0, |_| 0.0), clip(0, 0, 24.0, |_| 0.0), clip(0, 5, 24.0, |_| 0.0)] {
        let error = Engine::new(clip).unwrap_err().to_string();
        assert!(error.contains("needs a joint and a frame"), "{error}");
    }
}

#[test]
fn one_two_and_three_frames_are_one_two_and_three_drawings() {
    for frames in 1..=3 {
        let clip = clip(3, frames, 24.0, |at| at as f64);
        let mut engine = Engine::new(clip).unwrap();
        let mut recipe = Recipe::default();
        recipe.spacing.on = genga::timing::On::every(1);
        recipe.set("omission.koma_dori", "0").unwrap();
        let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
        assert_eq!(breakdown.sheet.layers[0].drawings.len(), frames);
        hand_over(&breakdown);
    }
}

#[test]
fn a_body_that_does_not_move_has_no_genga_and_loses_nothing_to_naka_nashi() {
    let mut engine = Engine::new(clip(3, 100, 50.0, |_| 30.0)).unwrap();
    let breakdown = engine.run(&Recipe::default(), &Edits::default()).unwrap();
    assert!(breakdown.first_layer().keys.keys.is_empty());
    assert_eq!(breakdown.first_layer().omission.naka_nashi.done, 0);
    assert_eq!(breakdown.sheet.layers[0].count(Role::Genga), 0);
    hand_over(&breakdown);
}

#[test]
fn far_too_much_asked_is_reported_and_not_done() {
    let mut engine = Engine::new(clip(2, 40, 24.0, |at| ((at * at) % 91) as f64)).unwrap();
    let mut recipe = Recipe::default();
    recipe.set("omission.naka_nashi", "1000").unwrap();
    recipe.set("omission.koma_dori", "1000").unwrap();
    recipe.set("spacing.inbetweens", "500").unwrap();
    let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
    is_sensible(&breakdown, &recipe);
    assert_eq!(breakdown.first_layer().omission.shortfalls().count(), 2);
    assert!(breakdown.first_layer().did_not_fit > 0);
    assert!(breakdown.sheet.layers[0].longest_hold() <= 4);
}

#[test]
fn a_filter_and_a_persistence_longer_than_the_clip_still_give_a_sheet() {
    for kind in ["box", "gaussian", "ideal", "butterworth"] {
        for reading in ["event", "literal"] {
            let mut recipe = Recipe::default();
            recipe.filter.width = Span::Frames(1e5);
            recipe.turns.persistence = Span::Seconds(1e5);
            recipe.set("filter.kind", kind).unwrap();
            recipe.set("turns.reading", reading).unwrap();
            let mut engine = Engine::new(clip(3, 30, 30.0, |at| (at % 17) as f64)).unwrap();
            is_sensible(&engine.run(&recipe, &Edits::default()).unwrap(), &recipe);
            let study = Study {
                recipe,
                x: "filter.width=100000".parse().unwrap(),
                y: Some("turns.persistence=1,100000s".parse().unwrap()),
                measures: Measure::ALL.to_vec(),
                keep_keys: true,
                budget: Budget::default(),
            };
            let grid = study.run(engine.clip().clone(), || ()).unwrap();
            assert!(
                grid.cells.iter().all(|cell| cell.values.iter().all(|value| value.is_finite()))
            );
        }
    }
}
