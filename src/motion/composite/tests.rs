//! Tests that each joint follows its own layer's drawing, and that a root on ones follows the source time shown.

use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use crate::motion::{Poser, RowWriter, bvh, local_rotation, local_translation};
use crate::sheet::{Exposure, Role, Why};

fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh");
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

/// Creates a layer that shows some places, each with a role and a number of koma.
fn layer(name: &str, joints: &[&str], shown: &[(f64, Role, usize)]) -> Layer {
    let drawing = |(place, role, _): &(f64, Role, usize)| {
        let why = Why { omitted_before: 1, lengthened: 2, held_for: 3, ..Why::default() };
        Drawing::new(Source::At(*place), *role, why)
    };
    let exposure =
        |(drawing, (_, _, koma)): (usize, &(f64, Role, usize))| Exposure { drawing, koma: *koma };
    Layer {
        name: name.into(),
        joints: joints.iter().map(|joint| (*joint).into()).collect(),
        drawings: shown.iter().map(drawing).collect(),
        exposures: shown.iter().enumerate().map(exposure).collect(),
        gone: vec![],
    }
}

fn two_layers(clip: &Clip) -> Sheet {
    use Role::{End, Genga, Inbetween};
    let body = [(0.0, End, 4), (10.0, Inbetween, 4), (20.5, Genga, 4)];
    let arm = [(0.0, End, 2), (7.0, Genga, 2), (8.0, Genga, 4), (22.0, Inbetween, 2)];
    let layers =
        vec![layer("A", &[], &body), layer("B", &["LeftArm", "LeftForeArm", "LeftHand"], &arm)];
    Sheet::new(clip.clock(24.0), layers)
}

#[test]
fn a_single_layer_is_itself() {
    let clip = kick();
    let sheet = Sheet::on_ones(clip.clock(24.0), 5);
    let composite = Composite::new(&clip, &sheet).unwrap();
    assert_eq!(composite.layer(), &sheet.layers[0]);
    assert_eq!(composite.first_koma(), [0, 1, 2, 3, 4]);
}

#[test]
fn several_layers_have_a_drawing_wherever_one_of_them_has_a_new_one() {
    let clip = kick();
    let sheet = two_layers(&clip);
    let composite = Composite::new(&clip, &sheet).unwrap();
    let flat = composite.layer();
    let begins: Vec<usize> = flat.timed().map(|(begin, _)| begin).collect();
    assert_eq!(begins, [0, 2, 4, 8]);
    assert_eq!((flat.name.as_str(), flat.length()), ("A-B", 12));
    use Role::{End, Genga};
    let roles: Vec<Role> = flat.drawings.iter().map(|drawing| drawing.role).collect();
    assert_eq!(roles, [End, Genga, Genga, Genga], "one of theirs is");
    let places: Vec<f64> = flat.drawings.iter().map(|drawing| drawing.source.place()).collect();
    assert_eq!(places, [0.0, 7.0, 8.0, 20.5], "of the drawing that gives the role");
    assert!(
        flat.drawings.iter().all(|drawing| drawing.why == Why::default()),
        "of their layer alone"
    );
    let parts: Vec<Vec<f64>> = composite
        .drawings
        .iter()
        .map(|sources| sources.iter().map(|source| source.place()).collect())
        .collect();
    assert_eq!(parts, [[0.0, 0.0], [0.0, 7.0], [10.0, 8.0], [20.5, 22.0]]);
}

#[test]
fn what_no_layer_names_or_one_that_shows_nothing_is_of_the_first() {
    let clip = kick();
    let mut sheet = two_layers(&clip);
    sheet.layers[1].joints.clear();
    assert_eq!(Composite::new(&clip, &sheet).unwrap().layer(), &sheet.layers[0]);
    let mut sheet = two_layers(&clip);
    sheet.layers[1].exposures.clear();
    assert_eq!(Composite::new(&clip, &sheet).unwrap().layer(), &sheet.layers[0]);
}

#[test]
fn a_joint_that_the_clip_has_not_is_said_with_the_nearest_name() {
    let clip = kick();
    let mut sheet = two_layers(&clip);
    sheet.layers[1].joints[0] = "LeftAmr".into();
    let error = Composite::new(&clip, &sheet).unwrap_err().to_string();
    assert_eq!(error, "layer B: the clip has no joint LeftAmr; did you mean LeftArm?");
}

#[test]
fn the_joint_that_travels_is_the_first_whose_place_changes() {
    let clip = kick();
    assert_eq!(travellers(&clip), [0]);
    let still = clip.with_others_still(&vec![false; clip.skeleton().len()]);
    assert!(travellers(&still).is_empty());
    let mut sheet = Sheet::on_ones(still.clock(24.0), 3);
    sheet.root = RootMotion::Ones;
    assert!(!Composite::new(&still, &sheet).unwrap().slides(), "nothing slides that never moves");
}

#[test]
fn a_root_on_ones_never_leaves_what_the_sheet_shows() {
    let clip = kick();
    use Role::{End, Genga};
    let shown = [(20.0, End, 2), (22.0, Genga, 24), (23.0, End, 2), (50.0, Genga, 1)];
    let mut sheet = Sheet::new(clip.clock(24.0), vec![layer("A", &[], &shown)]);
    sheet.root = RootMotion::Ones;
    sheet.layers[0].exposures.pop();
    let composite = Composite::new(&clip, &sheet).unwrap();
    let (mut posed, mut source) = (CompositePoser::new(&composite), Poser::new(&clip));
    let mut at = |drawing, koma, place| {
        let root = posed.drawing(drawing, koma).translations[0];
        assert_eq!(root, source.place(place).translations[0], "koma {koma}");
    };
    at(0, 1, 21.0);
    at(1, 2, 22.0);
    at(1, 14, 22.5);
    at(2, 27, 23.0);
    at(0, 14, 22.5);
    at(3, 60, 50.0);
}

proptest! {
    #![proptest_config(cases(6, 24))]

    #[test]
    fn each_joint_is_as_the_drawing_of_its_layer_has_it(
        chosen in prop::collection::vec(0..3usize, 23),
        shown in prop::collection::vec(prop::collection::vec((0.0..400.0, 1..5usize), 1..6), 3),
        ones in any::<bool>(),
    ) {
        let clip = kick();
        let names = &clip.skeleton().joints;
        let mut sheet = Sheet::new(clip.clock(24.0), vec![]);
        for (at, shown) in shown.iter().enumerate() {
            let own = names.iter().zip(&chosen).filter(|(_, of)| **of == at);
            let own: Vec<&str> = own.map(|(joint, _)| joint.name.as_str()).collect();
            let shown: Vec<_> =
                shown.iter().map(|(place, koma)| (*place, Role::Inbetween, *koma)).collect();
            sheet.layers.push(layer(&at.to_string(), &own, &shown));
        }
        sheet.root = if ones { RootMotion::Ones } else { RootMotion::Drawings };
        let composite = Composite::new(&clip, &sheet).unwrap();
        let mut rows = CompositeRows::new(&composite);
        let mut posed = CompositePoser::new(&composite);
        let (mut row, mut own) = (vec![0.0; clip.skeleton().channels()], vec![0.0; clip.skeleton().channels()]);
        let (mut writer, mut own_pose) = (RowWriter::new(&clip), Poser::new(&clip));
        for (koma, drawing) in composite.layer().koma().enumerate() {
            rows.write(drawing, koma, &mut row);
            let shown = posed.drawing(drawing, koma);
            for (joint, data) in names.iter().enumerate() {
                let layer = &sheet.layers[chosen[joint]];
                let index = layer.koma().nth(koma).unwrap_or(layer.exposures.last().unwrap().drawing);
                let source = layer.drawings[index].source;
                writer.write(source, &mut own);
                own_pose.drawing(source);
                prop_assert_eq!(local_rotation(data, &row), local_rotation(data, &own));
                prop_assert_eq!(shown.rotations[joint], own_pose.pose().rotations[joint]);
                if ones && joint == 0 {
                    let places = layer.source_places(sheet.clock);
                    let there = Source::At(*places.get(koma).or(places.last()).unwrap());
                    writer.write(there, &mut own);
                    own_pose.drawing(there);
                }
                prop_assert_eq!(local_translation(data, &row), local_translation(data, &own));
                prop_assert_eq!(shown.translations[joint], own_pose.pose().translations[joint]);
            }
        }
    }
}
