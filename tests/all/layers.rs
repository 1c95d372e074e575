//! Layers with their own timing and a root on ones, through the program and on real clips.

use std::collections::BTreeSet;
use std::fs;

use genga::edits::Edits;
use genga::motion::{Axis, Channel, Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Reason, Role, RootMotion, Sheet};
use genga::time::Frame;
use genga_files::limited_bvh;

use crate::clips;
use crate::program::{Place, column, text};

/// The sheet of a clip with the default recipe and some changed settings.
fn sheet(clip: &Clip, settings: &[(&str, &str)]) -> Sheet {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.run_once(&recipe, &Edits::default()).unwrap().sheet.clone()
}

/// The poses of a sheet, one row per koma.
fn shown(clip: &Clip, sheet: &Sheet) -> Clip {
    bvh::read(limited_bvh(clip, sheet).unwrap().as_bytes()).unwrap().clip
}

#[test]
fn on_real_clips_every_joint_is_in_one_layer_and_has_its_drawing_s_numbers() {
    for path in clips::all() {
        let (name, clip) = (clips::name(&path), clips::read(&path));
        let sheet = sheet(&clip, &[("layers", "limbs")]);
        assert_eq!(sheet.layers.len(), 5, "{name}");
        let joints: Vec<&String> = sheet.layers.iter().flat_map(|layer| &layer.joints).collect();
        assert_eq!(joints.len(), clip.skeleton().len(), "{name}");
        assert_eq!(joints.iter().collect::<BTreeSet<_>>().len(), joints.len(), "{name}");
        let result = shown(&clip, &sheet);
        assert_eq!(result.len(), sheet.length(), "{name}");
        for layer in &sheet.layers {
            let alone = Sheet::new(sheet.clock, vec![layer.clone()]);
            let alone = shown(&clip, &alone);
            let own = clip.skeleton().joints.iter().filter(|own| layer.joints.contains(&own.name));
            for joint in own {
                let columns = joint.first_channel..joint.first_channel + joint.channels.len();
                for koma in (0..result.len()).map(Frame) {
                    let [both, one] =
                        [&result, &alone].map(|clip| &clip.row(koma)[columns.clone()]);
                    assert_eq!(both, one, "{name}: {} on koma {}", joint.name, koma.0 + 1);
                }
            }
        }
    }
}

/// Whether a column is one of the root's position.
fn is_root_position(clip: &Clip, column: usize) -> bool {
    let root = &clip.skeleton().joints[0];
    let channel = root.channels.get(column.wrapping_sub(root.first_channel));
    matches!(channel, Some(Channel::Position(Axis::X | Axis::Y | Axis::Z)))
}

#[test]
fn on_real_clips_a_root_on_ones_is_where_the_source_is_on_each_koma() {
    for path in clips::all() {
        let (name, clip) = (clips::name(&path), clips::read(&path));
        let ones = sheet(&clip, &[("root", "ones")]);
        assert_eq!(ones.root, RootMotion::Ones);
        let held = Sheet { root: RootMotion::Drawings, ..ones.clone() };
        let source = shown(&clip, &Sheet::on_ones(ones.clock, ones.length()));
        let (result, held) = (shown(&clip, &ones), shown(&clip, &held));
        let is_position = |column: usize| is_root_position(&clip, column);
        for koma in (0..result.len()).map(Frame) {
            for (column, value) in result.row(koma).iter().enumerate() {
                let expected = if is_position(column) { &source } else { &held };
                assert_eq!(*value, expected.row(koma)[column], "{name}: koma {}", koma.0 + 1);
            }
        }
        assert_ne!(result, held, "{name}: it travels");
    }
}

/// Checks that the take passes every genga that tells its time while that is on screen, within three koma.
fn meets_its_genga(name: &str, sheet: &Sheet) {
    let layer = &sheet.layers[0];
    let places = layer.source_places(sheet.clock);
    for (begin, exposure) in layer.timed() {
        let drawing = &layer.drawings[exposure.drawing];
        if drawing.role == Role::Genga && drawing.why.reason != Some(Reason::Fill) {
            let slack = 3.01 * sheet.clock.frames_in_koma();
            let [from, to] = [begin, begin + exposure.koma - 1].map(|koma| places[koma]);
            let place = drawing.source.place();
            let is_met = (from - slack..=to + 1.4 * slack).contains(&place);
            assert!(is_met, "{name}, koma {}: {place} from {from} to {to}", begin + 1);
        }
    }
}

#[test]
fn on_real_clips_of_another_length_the_root_on_ones_keeps_up_with_its_genga() {
    let mut shorter = 0;
    for path in clips::all() {
        let (name, clip) = (clips::name(&path), clips::read(&path));
        let settings =
            [("root", "ones"), ("omission.keep_length", "false"), ("omission.naka_nashi", "50%")];
        let mut ones = sheet(&clip, &settings);
        let koma = clip.rate().koma_from_frames(clip.len(), 24.0);
        shorter += usize::from(ones.length() + 6 < koma);
        meets_its_genga(&name, &ones);
        // A person holds a drawing, and has the whole shown again.
        let exposures = &mut ones.layers[0].exposures;
        let middle = exposures.len() / 2;
        exposures[middle].koma += 24;
        let once = shown(&clip, &ones);
        meets_its_genga(&name, &ones);
        ones.layers[0].exposures = ones.layers[0].exposures.repeat(2);
        let twice = shown(&clip, &ones);
        for koma in 0..once.len() {
            let row = |koma: usize| twice.row(Frame(koma)).iter();
            for (first, again) in row(koma).zip(row(koma + once.len())) {
                assert!((first - again).abs() < 1e-4, "{name}: koma {}", koma + 1);
            }
        }
    }
    assert!(clips::all().is_empty() || shorter > 0, "some sheet is shorter than its take");
}

#[test]
fn each_layer_is_a_column_of_every_table_and_sheet() {
    let place = Place::new();
    let said = place.genga("run data/kick.bvh --out a --layers limbs --root-on ones --deliver \
         json,csv,remap,bvh,glb,vmd,xdts,poses,images --with images.width=160 --with images.height=90");
    assert!(said.status.success(), "{}", text(&said.stderr));
    let said = text(&said.stderr);
    for layer in ["A", "B", "C", "D", "E"] {
        assert!(said.contains(&format!("layer       セル       {layer}: ")), "{said}");
    }
    let read = |file: &str| fs::read_to_string(place.path(&format!("a/{file}"))).unwrap();
    let letters: BTreeSet<String> = ["A", "B", "C", "D", "E"].map(String::from).into();
    for (file, name) in [
        ("keys.csv", "column"),
        ("drawings.csv", "column"),
        ("sheet.csv", "layer"),
        ("remap.csv", "layer"),
    ] {
        let found: BTreeSet<String> = column(&read(file), name).into_iter().collect();
        assert_eq!(found, letters, "{file}");
    }
    assert_eq!(column(&read("remap.csv"), "koma").len(), 5 * 92);
    let drawings = read("drawings.csv");
    let leads = column(&drawings, "lead_joint").into_iter().zip(column(&drawings, "column"));
    let of_b: BTreeSet<String> = leads
        .filter(|(_, own)| own == "B")
        .map(|(lead, _)| lead)
        .filter(|lead| !lead.is_empty())
        .collect();
    assert!(!of_b.is_empty() && of_b.iter().all(|lead| lead.starts_with("Left")), "{of_b:?}");
    let report: serde_json::Value = serde_json::from_str(&read("report.json")).unwrap();
    assert_eq!(report["layers"].as_array().unwrap().len(), 5);
    assert!(read("kick_douga_ts.xdts").contains(r#""names":["A","B","C","D","E"]"#));
    assert!(read("sheet.json").contains("\n  \"root\": \"ones\",\n"));
    // What all columns draw together is known by its koma: some are held.
    assert!(place.path("a/images/A-E_0001.png").is_file());
    assert!(!place.path("a/images/A-E_0002.png").is_file());
    let again = place.genga("deliver a/sheet.json data/kick.bvh --to bvh,glb,vmd,poses --out b");
    assert!(again.status.success(), "{}", text(&again.stderr));
    for file in ["limited.bvh", "limited.glb", "kick.vmd", "poses.svg"] {
        let [a, b] = ["a", "b"].map(|out| fs::read(place.path(&format!("{out}/{file}"))).unwrap());
        assert!(a == b, "{file}: what was read back is delivered as it was made");
    }
    let eval = place.genga("eval a/sheet.json --clip data/kick.bvh");
    assert!(text(&eval.stderr).contains("of several layers"), "{}", text(&eval.stderr));
}

#[test]
fn drawings_are_counted_as_they_stand_on_the_sheet_also_where_one_is_held_by_hand() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --layers limbs --hold 30:6");
    let drawings = fs::read_to_string(place.path("a/drawings.csv")).unwrap();
    let columns = column(&drawings, "column");
    let report = fs::read_to_string(place.path("a/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    for layer in report["layers"].as_array().unwrap() {
        let rows = columns.iter().filter(|own| layer["name"] == **own).count();
        assert_eq!(layer["drawings"], rows, "{layer}");
    }
}

#[test]
fn layers_come_from_a_file_and_the_recipe_of_a_run_has_them() {
    let place = Place::new();
    let file = "[[layers]]\nname = \"A\"\njoints = [\"Hips\"]\n\n[[layers]]\nname = \"足\"\njoints = [\"*Leg\", \"*Foot\", \"*ToeBase\"]\n";
    fs::write(place.path("legs.toml"), file).unwrap();
    place.done("run data/kick.bvh --out a --layers legs.toml --pin 足/42:contact");
    place.done("run data/kick.bvh --out b --recipe a/recipe.toml");
    assert_eq!(place.files("a"), place.files("b"));
    let keys = String::from_utf8(place.files("a")["keys.csv"].clone()).unwrap();
    let pinned: Vec<&str> = keys.lines().filter(|line| line.contains("pinned: contact")).collect();
    assert_eq!(pinned.len(), 1, "{keys}");
    assert!(pinned[0].contains(",足,"), "{}", pinned[0]);
}

#[test]
fn what_cannot_be_split_says_what_would_be_right() {
    let place = Place::new();
    fs::write(place.path("twice.toml"), "[[layers]]\nname = \"A\"\njoints = [\"Left*\"]\n[[layers]]\nname = \"B\"\njoints = [\"*Arm\"]\n").unwrap();
    fs::write(place.path("none.toml"), "[[layers]]\nname = \"A\"\njoints = []\n").unwrap();
    fs::write(place.path("tail.toml"), "[[layers]]\nname = \"A\"\njoints = [\"LeftAmr\"]\n")
        .unwrap();
    for (asked, answer) in [
        (
            "--layers limb",
            "expected body, limbs, joints or a file of layers; there is no file limb",
        ),
        ("--layers twice.toml", "layers.B: LeftArm is in layer A already; a joint is of one layer"),
        ("--layers none.toml", "layers.A: has no joint; name some, or take the layer away"),
        ("--layers tail.toml", "layers.A: the clip has no joint LeftAmr; did you mean LeftArm?"),
        ("--root-on twos", "root: expected one of drawings, ones, found \"twos\""),
        ("--layers limbs --pin F/12", "there is no layer F to correct; there is A, B, C, D, E"),
        ("--layers limbs --keys 9", "--keys: is asked of the whole body as one layer"),
        ("--pin B/x", "--pin: expected FRAME, FRAME:NAME or FRAME:NAME@WEIGHT, found \"x\""),
    ] {
        let said = place.genga(&format!("run data/kick.bvh --out a {asked}"));
        assert!(!said.status.success(), "{asked}");
        let said = text(&said.stderr);
        assert!(said.contains(answer), "{asked}: {said}");
        assert!(!place.path("a").exists(), "{asked}");
    }
}

#[test]
fn a_key_of_one_column_comes_back_to_its_layer() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --layers limbs");
    fs::write(place.path("marked.csv"), "column,source_frame\nC,52\nA,12\n").unwrap();
    let again = "run data/kick.bvh --layers limbs --pin-from marked.csv --pin-column C --out b";
    let said = place.said(again);
    assert!(said.contains("1 key of column C"), "{said}");
    let recipe = String::from_utf8(place.files("b")["recipe.toml"].clone()).unwrap();
    assert!(recipe.contains("[[edits.layers.C.pins]]\nframe = 52"), "{recipe}");
    let [a, b] = ["a", "b"].map(|out| {
        let keys = String::from_utf8(place.files(out)["keys.csv"].clone()).unwrap();
        let others = keys.lines().filter(|line| !line.starts_with("kick,C,"));
        others.map(str::to_owned).collect::<Vec<_>>()
    });
    assert_eq!(a, b, "the other layers are as they were");
}
