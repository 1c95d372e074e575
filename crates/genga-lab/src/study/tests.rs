//! The sweep compared with a fresh engine per cell.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use genga::edits::Edits;
use genga::keys::Origin;
use genga::motion::{Axis as Direction, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::pipeline::{Budget, Engine};
use genga::sheet::Role;
use genga::time::FrameRate;
use genga::timing::Stills;

/// Builds a walking root and two joints of an arm that swing at different rates, at 120 frames per second.
pub(super) fn swinging(frames: usize) -> Clip {
    let [x, y, z] = [Direction::X, Direction::Y, Direction::Z];
    let positions = [x, y, z].map(Channel::Position);
    let rotations = [z, x, y].map(Channel::Rotation);
    let joint = |at: usize| Joint {
        name: format!("joint_{at}"),
        parent: at.checked_sub(1).map(JointId),
        offset: DVec3::Y * 10.0,
        channels: if at == 0 { [positions, rotations].concat() } else { rotations.to_vec() },
        first_channel: [0, 6, 9][at],
        end_sites: match at {
            2 => vec![EndSite { name: "Site".into(), offset: DVec3::Y * 5.0 }],
            _ => vec![],
        },
    };
    let skeleton = Skeleton { joints: (0..3).map(joint).collect() };
    let value = |frame: usize, channel: usize| {
        let time = frame as f64 / 120.0;
        let turn = std::f64::consts::TAU * (0.5 + 0.23 * channel as f64) * time;
        20.0 * turn.sin() * (0.7 * time + channel as f64).cos()
    };
    let values = (0..frames).flat_map(|frame| (0..12).map(move |channel| value(frame, channel)));
    let rate = FrameRate::new(120.0).unwrap();
    Clip::new(skeleton, rate, Frame(3), frames, values.collect()).unwrap()
}

pub(super) fn axis(text: &str) -> Axis {
    text.parse().unwrap()
}

/// Builds a grid that kept only keys, five frames per koma; columns from left to right, each from the bottom.
pub(super) fn grid_of_keys(columns: usize, rows: usize, keys: &[&[usize]]) -> Grid {
    assert_eq!(keys.len(), columns * rows);
    let cell = |keys: &&[usize]| Cell {
        values: vec![],
        seconds: 2.0,
        keys: Some(keys.iter().copied().map(Frame).collect()),
    };
    Grid {
        x: axis(&format!("filter.width=1..{columns}:1")),
        y: (rows > 1).then(|| axis(&format!("turns.persistence=1..{rows}:1"))),
        measures: vec![],
        frames_in_koma: 5.0,
        own: None,
        cells: keys.iter().map(cell).collect(),
    }
}

fn study(x: &str, y: Option<&str>, measures: &[Measure]) -> Study {
    Study {
        recipe: Recipe::default(),
        x: axis(x),
        y: y.map(axis),
        measures: measures.to_vec(),
        keep_keys: measures.contains(&Measure::Genga),
        budget: Budget::default(),
    }
}

/// Measures every cell by an engine of its own that runs the whole chain.
fn slow(study: &Study, clip: &Clip) -> Vec<Cell> {
    let mut cells = Vec::new();
    for x in study.x.values() {
        for y in study.y.as_ref().map_or(&[String::new()][..], Axis::values) {
            let mut setting = Setting { recipe: study.recipe.clone(), noise: Noise::default() };
            setting.set(study.x.name(), x).unwrap();
            if let Some(axis) = &study.y {
                setting.set(axis.name(), y).unwrap();
            }
            let mut engine = Engine::new(setting.noise.on(clip)).unwrap();
            let run = engine.run(&setting.recipe, &Edits::default()).unwrap();
            let layer = &run.sheet.layers[0];
            let frames: Vec<Frame> =
                run.first_layer().keys.keys.iter().map(|key| key.frame).collect();
            let mut union: Vec<Frame> = keys(run.turns).map(|turn| turn.frame).collect();
            union.sort();
            union.dedup();
            let seconds = layer.length() as f64 / run.clock.koma_rate;
            let genga =
                layer.drawings.iter().filter(|drawing| drawing.role != Role::Inbetween).count();
            let stills = Stills::from_layer(run.clip, layer);
            let steps = layer.exposures.windows(2);
            let mut steps: Vec<f64> =
                steps.map(|pair| stills.ssd(pair[0].drawing, pair[1].drawing)).collect();
            steps.sort_by(f64::total_cmp);
            let middle = steps.len() / 2;
            let value = |measure: &Measure| match measure {
                Measure::Union => union.len() as f64,
                Measure::Total => keys(run.turns).count() as f64,
                Measure::Turns => run.first_layer().body.turns.len() as f64,
                Measure::Genga => frames.len() as f64 + 2.0,
                Measure::Fills => run
                    .first_layer()
                    .keys
                    .keys
                    .iter()
                    .filter(|key| key.origin == Origin::Fill)
                    .count() as f64,
                Measure::Drawings => layer.drawings.len() as f64,
                Measure::DrawingsPerSecond => layer.drawings.len() as f64 / seconds,
                Measure::GengaPerSecond => genga as f64 / seconds,
                Measure::LongestHold => {
                    layer.exposures.iter().map(|exposure| exposure.koma).max().unwrap() as f64
                }
                Measure::HeldKoma => (layer.length() - layer.exposures.len()) as f64,
                Measure::PeakSsd => steps[steps.len() - 1],
                Measure::MedianSsd if steps.len() % 2 == 1 => steps[middle],
                Measure::MedianSsd => 0.5 * (steps[middle - 1] + steps[middle]),
            };
            cells.push(Cell {
                values: study.measures.iter().map(value).collect(),
                seconds,
                keys: study.keep_keys.then_some(frames),
            });
        }
    }
    cells
}

const COUNTS: [Measure; 2] = [Measure::Union, Measure::Total];
const KEYS: [Measure; 5] =
    [Measure::Union, Measure::Total, Measure::Turns, Measure::Genga, Measure::Fills];

/// Whether cells are the same: equal keys, and values and seconds equal up to rounding of a division.
fn are_the_same(cells: &[Cell], others: &[Cell]) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-12 * b.abs();
    let same = |(a, b): (&Cell, &Cell)| {
        let values = a.values.iter().zip(&b.values).all(near);
        values && near((&a.seconds, &b.seconds)) && a.keys == b.keys
    };
    cells.len() == others.len() && cells.iter().zip(others).all(same)
}

#[test]
fn a_sweep_gives_what_an_engine_of_its_own_gives_each_cell() {
    let clip = swinging(400);
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (x, y, measures) in [
        ("filter.width=1..25:4", Some("turns.persistence=1..19:3"), &COUNTS[..]),
        ("turns.persistence=1..19:3", Some("filter.width=1..25:4"), &KEYS),
        ("filter.kind=ideal,box,gaussian", Some("filter.width=0.05s..0.2s:0.05s"), &KEYS),
        ("turns.steady=0,50,5%", Some("turns.reading=event,literal"), &KEYS),
        ("noise=0..1:0.5", Some("noise.seed=0..1:1"), &KEYS),
        ("filter.width=5..25:10", Some("noise=0,0.3"), &Measure::ALL),
        ("rate=12,24", Some("omission.koma_dori=0,1/3"), &Measure::ALL[5..]),
        ("spacing.on=1..3:1", Some("keys.merge=union,vote"), &Measure::ALL),
        ("keys.min_price=0..5:1", None, &Measure::ALL),
    ] {
        let study = study(x, y, measures);
        let counted = AtomicUsize::new(0);
        let count = || {
            counted.fetch_add(1, Ordering::Relaxed);
        };
        let grid = study.run(clip.clone(), count).unwrap();
        let slow = slow(&study, &clip);
        assert!(are_the_same(&grid.cells, &slow), "{x} {y:?}: {:?} {slow:?}", grid.cells);
        // With many cores each takes a cell or two; a single one goes from cell to cell and reuses its stages.
        let again = alone.install(|| study.run(clip.clone(), || ())).unwrap();
        assert_eq!(again, grid, "{x} {y:?}");
        let mut walk = study.clone().begin(clip.clone()).unwrap();
        let walked = (0..=study.len()).find_map(|_| walk.step().unwrap());
        assert_eq!(walked.as_ref(), Some(&grid), "{x} {y:?}");
        assert_eq!(counted.into_inner(), study.len());
        assert_eq!(grid.frames_in_koma, 5.0, "120 frames a second, 24 koma");
        assert_eq!(grid.cell(1, grid.rows() - 1), &grid.cells[2 * grid.rows() - 1]);
    }
}

#[test]
fn the_literal_reading_has_the_same_cells_too() {
    let recipe = table_1_recipe();
    let study =
        Study { recipe, ..study("filter.width=5,21", Some("turns.persistence=1..30:1"), &KEYS) };
    let clip = swinging(300);
    assert_eq!(study.run(clip.clone(), || ()).unwrap().cells, slow(&study, &clip));
}

proptest! {
    #![proptest_config(cases(6, 40))]

    #[test]
    fn a_longer_persistence_never_adds_a_key(width in 1.0..40.0f64, noise in 0.0..1.0f64, literal: bool) {
        let mut recipe = Recipe::default();
        recipe.filter.width = genga::time::Span::Frames(width);
        if literal {
            recipe.turns.reading = Reading::Literal;
        }
        let clip = Noise { degrees: noise, seed: 1 }.on(&swinging(200));
        let study = Study { recipe, ..study("turns.persistence=1..40:1", None, &COUNTS) };
        let grid = study.run(clip, || ()).unwrap();
        for measure in COUNTS {
            let values = grid.values(measure).unwrap();
            prop_assert!(values.is_sorted_by(|a, b| a >= b), "{}: {:?}", measure, values);
        }
        prop_assert!(grid.values(Measure::Drawings).is_none());
    }
}

#[test]
fn a_study_that_cannot_be_is_refused() {
    let good = study("filter.width=10", Some("turns.persistence=5"), &COUNTS);
    assert!(good.validate().is_ok());
    let says = |study: Study, says: &str| {
        let said = study.validate().unwrap_err().to_string();
        assert!(said.contains(says), "{said}");
        assert!(study.run(swinging(9), || ()).is_err());
    };
    says(Study { measures: vec![], ..good.clone() }, "measure: there is nothing to count");
    says(Study { y: Some(axis("filter.width=3")), ..good.clone() }, "is on both axes");
    let rates = Some(axis("rate=12,24"));
    assert!(Study { y: rates.clone(), ..good.clone() }.validate().is_ok());
    says(Study { y: rates, keep_keys: true, ..good.clone() }, "other rates are not compared");
    let many = [axis("filter.width=1..2000:1"), axis("turns.persistence=1..2000:1")];
    let [x, y] = many;
    says(Study { x, y: Some(y), ..good.clone() }, "4000000 cells are too many");
    let mut wrong = good.clone();
    wrong.recipe.spacing.on = genga::timing::On::every(0);
    says(wrong, "spacing.on");
    let empty = swinging(9).trimmed(Frame(3), Frame(4)).unwrap();
    assert_eq!(good.run(empty, || ()).unwrap().cells[0].values, [0.0, 0.0], "one frame has no key");
}

#[test]
fn a_study_ends_when_somebody_wants_it_to() {
    let study = study("filter.width=1..40:1", Some("turns.persistence=1..20:1"), &COUNTS);
    let measured = AtomicUsize::new(0);
    let ended = study.run_while(swinging(30), || measured.fetch_add(1, Ordering::Relaxed) < 3);
    assert!(ended.unwrap().is_none());
    let measured = measured.into_inner();
    assert!((4..study.len() / 2).contains(&measured), "{measured}: what is in work is finished");
    let whole = study.run_while(swinging(30), || true).unwrap();
    assert_eq!(whole, Some(study.run(swinging(30), || ()).unwrap()));
}

#[test]
fn the_keys_of_each_joint_add_up_to_the_total() {
    let study = study("filter.width=1,5", Some("turns.persistence=1..3:1"), &[Measure::Total]);
    let clip = swinging(60);
    let joints = study.joints_while(clip.clone(), || true).unwrap().unwrap();
    assert!(joints.iter().all(|cell| cell.len() == clip.skeleton().len()));
    let sums: Vec<f64> = joints.iter().map(|cell| cell.iter().sum::<usize>() as f64).collect();
    assert_eq!(study.run(clip, || ()).unwrap().values(Measure::Total), Some(sums));
    assert!(study.joints_while(swinging(60), || false).unwrap().is_none());
}

#[test]
fn the_axes_of_table_1_are_known_in_either_order() {
    let (width, persistence) = (axis("filter.width=10"), axis("turns.persistence=5"));
    assert!(is_table_1(&width, Some(&persistence)) && is_table_1(&persistence, Some(&width)));
    for y in [None, Some(&width), Some(&axis("spacing.on=2"))] {
        assert!(!is_table_1(&width, y));
    }
}

#[test]
fn what_the_chain_uses_first_changes_last() {
    let order = |x: &str, y: &str| study(x, Some(y), &COUNTS).chain_order();
    let (width, persistence) = ("filter.width=1..2:1", "turns.persistence=1..3:1");
    assert_eq!(order(width, persistence), [0, 1, 2, 3, 4, 5]);
    assert_eq!(order(persistence, width), [0, 2, 4, 1, 3, 5], "all of a width, then the next");
    assert_eq!(order("filter.width=1..2:1", "noise=0..2:1"), [0, 3, 1, 4, 2, 5]);
}

#[test]
fn what_nobody_asks_for_is_not_made() {
    let grid = study("filter.width=10", None, &COUNTS).run(swinging(50), || ()).unwrap();
    assert_eq!(grid.cells[0].keys, None);
    let counted = Study { keep_keys: false, ..study("filter.width=10", None, &KEYS) };
    assert_eq!(counted.run(swinging(50), || ()).unwrap().cells[0].keys, None, "counted, not kept");
    let keys = Study { keep_keys: true, ..study("filter.width=10", None, &COUNTS) };
    assert!(keys.run(swinging(50), || ()).unwrap().cells[0].keys.is_some());
}

#[test]
fn the_recipes_own_cell_is_the_nearest_one_that_is_there() {
    let own = |x: &str, y: &str| study(x, Some(y), &COUNTS).run(swinging(30), || ()).unwrap().own;
    // 0.15 s are 18 frames.
    assert_eq!(own("filter.width=5..30:5", "turns.persistence=0.05s..0.2s:0.05s"), Some(3 * 4 + 1));
    assert_eq!(own("filter.width=5,10", "turns.persistence=0.1s"), None);
    assert_eq!(own("noise=0,1", "filter.kind=gaussian,box"), Some(1));
    assert_eq!(own("noise=0,1", "filter.kind=gaussian,ideal"), None);
}
