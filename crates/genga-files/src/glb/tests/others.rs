//! Tests what stands beside the body: a stage goes in, and comes out in the sheet's time.

use serde_json::{Value, json};

use super::super::Glb;
use super::reader::Read;
use crate::stage::stage;
use crate::timeline::Others;
use genga::motion::Clip;
use genga::sheet::{Blank, Exposure, Sheet};
use genga::time::FrameRate;
use genga_read::{Carrier, GltfScene, Options};

fn read(glb: &[u8]) -> Clip {
    let fps = Some(FrameRate::new(24.0).unwrap());
    Options { fps, ..Options::default() }.read(glb).unwrap().clip
}

fn scene(clip: &Clip) -> &GltfScene {
    clip.beside().unwrap().kept().unwrap()
}

/// Two seconds on threes.
fn sheet(clip: &Clip) -> Sheet {
    let mut sheet = Sheet::on_ones(clip.clock(24.0), clip.len());
    let drawings = (0..clip.len()).step_by(3);
    let koma = |drawing| Exposure { drawing, koma: 3.min(clip.len() - drawing) };
    sheet.layers[0].exposures = drawings.map(koma).collect();
    sheet
}

/// The keys of a property of a node in the first animation: seconds, numbers and interpolation.
fn keys(read: &Read, node: &str, path: &str) -> (Vec<f32>, Vec<f32>, String) {
    let nodes = read.json["nodes"].as_array().unwrap();
    let node = nodes.iter().position(|own| own["name"] == node).unwrap();
    let channels = read.json["animations"][0]["channels"].as_array().unwrap();
    let is_asked =
        |channel: &&Value| channel["target"]["node"] == node && channel["target"]["path"] == path;
    let channel = channels.iter().find(is_asked).unwrap();
    let sampler = &read.samplers(0)[channel["sampler"].as_u64().unwrap() as usize];
    let numbers = |member: &str| read.floats(&sampler[member]).concat();
    let between = sampler["interpolation"].as_str().unwrap().to_owned();
    (numbers("input"), numbers("output"), between)
}

#[test]
fn cameras_props_and_morphs_keep_their_own_keys() {
    let clip = read(&stage().glb());
    let bytes = Glb::default().write(&clip, &sheet(&clip)).unwrap();
    let written = Read::new(&bytes);
    let (seconds, places, between) = keys(&written, "eye", "translation");
    assert_eq!((&seconds[..], between.as_str()), (&[0.0, 1.0, 2.0][..], "LINEAR"));
    assert_eq!(places, [0., 1., 5., 0., 1., 5., 2., 1., 5.]);
    let (_, weights, _) = keys(&written, "balloon", "weights");
    assert_eq!(weights, [0., 0., 1., 0.5, 0., 0.]);
    assert_eq!(keys(&written, "balloon", "scale").2, "CUBICSPLINE");
    assert_eq!(keys(&written, "sword", "rotation").2, "STEP");
    assert_eq!(keys(&written, "hip", "rotation").2, "STEP", "the body is stepped");

    // Read again, it is what it was.
    let again = read(&bytes);
    let (old, new) = (scene(&clip), scene(&again));
    let tracks = |scene: &GltfScene| -> Vec<_> {
        let name = |node: usize| scene.nodes[node].json["name"].clone();
        scene
            .tracks
            .iter()
            .map(|own| (name(own.node), own.path.clone(), own.track.clone()))
            .collect()
    };
    let (old_tracks, new_tracks) = (tracks(old), tracks(new));
    assert_eq!(old_tracks.len(), new_tracks.len());
    for track in old_tracks {
        assert!(new_tracks.contains(&track), "{track:?}");
    }
    let camera = |clip: &Clip| clip.beside().unwrap().camera.clone().unwrap().poses[40];
    assert_eq!(camera(&clip), camera(&again));
    assert_eq!(written.json["cameras"][0]["perspective"]["yfov"], 0.6);
    assert_eq!(written.json["materials"][0]["name"], "steel", "before those of the bones");
    assert_eq!(written.json["extensionsUsed"], json!(["KHR_lights_punctual"]));
}

#[test]
fn a_prop_hangs_on_its_joint_at_any_scale() {
    let clip = read(&stage().glb());
    let Carrier::Joint(knee, rest) = scene(&clip).nodes[1].carrier else { panic!("the knee") };
    for scale in [1.0, 0.5] {
        let glb = Glb { scale, ..Glb::default() };
        let written = Read::new(&glb.write(&clip, &sheet(&clip)).unwrap());
        let nodes = written.json["nodes"].as_array().unwrap();
        let find = |name: &str| nodes.iter().position(|own| own["name"] == name);
        let (sword, between) = (find("sword").unwrap(), find("sword_rest").unwrap());
        assert_eq!(nodes[between]["children"], json!([sword]));
        let children = nodes[knee]["children"].as_array().unwrap();
        assert!(children.contains(&between.into()), "{children:?}");
        let matrix = nodes[between]["matrix"].as_array().unwrap();
        let expected = glam::DMat4::from_scale(glam::DVec3::splat(scale)) * glam::DMat4::from(rest);
        for (written, expected) in matrix.iter().zip(expected.to_cols_array()) {
            assert!((written.as_f64().unwrap() - expected).abs() < 1e-6, "{matrix:?}");
        }
        // The room stands in the scene itself at its own scale.
        assert_eq!(find("room_rest").is_some(), scale != 1.0);
    }
}

#[test]
fn stepped_things_change_with_the_drawings_alone() {
    let clip = read(&stage().glb());
    let glb = Glb { others: Others::Step, ..Glb::default() };
    let late = sheet(&clip).with_blank(Blank { before: 6, after: 0 });
    let written = Read::new(&glb.write(&clip, &late).unwrap());
    let (seconds, places, between) = keys(&written, "eye", "translation");
    assert_eq!(between, "STEP");
    assert_eq!((seconds.len(), &seconds[..3]), (18, &[0.0, 0.375, 0.5][..]));
    // The drawing of frame 36 is half the way.
    let at = seconds.iter().rposition(|second| *second <= 42.0 / 24.0).unwrap();
    assert_eq!(places[3 * at], 1.0);
    assert_eq!(keys(&written, "balloon", "weights").2, "STEP");
    assert_eq!(keys(&written, "balloon", "scale").2, "STEP");
}

#[test]
fn a_sheet_that_leaves_out_time_takes_the_camera_with_it() {
    let clip = read(&stage().glb());
    let mut sheet = Sheet::on_ones(clip.clock(24.0), clip.len());
    // The first second is left out.
    sheet.layers[0].exposures.drain(..24);
    let written = Read::new(&Glb::default().write(&clip, &sheet).unwrap());
    let (seconds, places, _) = keys(&written, "eye", "translation");
    assert_eq!((&seconds[..], &places[..]), (&[0.0, 1.0][..], &[0., 1., 5., 2., 1., 5.][..]));
}

#[test]
fn keys_with_curves_take_the_things_along_and_a_body_alone_stays_as_it_was() {
    let clip = read(&stage().glb());
    let sheet = sheet(&clip);
    let mut keyed = sheet.clone();
    for at in [0, 24, 48] {
        keyed.layers[0].drawings[at].role = genga::sheet::Role::Genga;
    }
    let written = Glb::default().write_keys(&clip, &keyed, &crate::Curves::default()).unwrap();
    assert_eq!(keys(&Read::new(&written), "eye", "translation").0, [0.0, 1.0, 2.0]);
    let alone = clip.clone().with_beside(genga::motion::Beside::default());
    let written = Read::new(&Glb::default().write(&alone, &sheet).unwrap());
    assert!(written.json["cameras"].is_null() && written.json["extensionsUsed"].is_null());
}
