use serde_json::json;

use super::*;
use crate::stage::{Stage, stage};
use crate::{Between, Options};
use genga::motion::{Clip, Lens};
use genga::time::FrameRate;

fn read(stage: &Stage) -> Clip {
    let fps = Some(FrameRate::new(24.0).unwrap());
    Options { fps, ..Options::default() }.read(&stage.glb()).unwrap().clip
}

fn scene(clip: &Clip) -> &GltfScene {
    clip.beside().unwrap().kept().unwrap()
}

fn name(node: &GltfNode) -> &str {
    node.json["name"].as_str().unwrap()
}

#[test]
fn what_stands_beside_the_body_is_kept_with_its_keys() {
    let clip = read(&stage());
    let joints: Vec<&str> =
        clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(joints, ["hip", "knee"]);
    let scene = scene(&clip);
    let names: Vec<&str> = scene.nodes.iter().map(name).collect();
    assert_eq!(names, ["room", "sword", "eye", "balloon", "lamp"]);
    let tracks: Vec<_> = scene
        .tracks
        .iter()
        .map(|track| {
            (name(&scene.nodes[track.node]), &*track.path, track.track.between, track.track.width)
        })
        .collect();
    let expected = [
        ("eye", "translation", Between::Linear, 3),
        ("balloon", "weights", Between::Linear, 2),
        ("sword", "rotation", Between::Step, 4),
        ("balloon", "scale", Between::Cubic, 3),
    ];
    assert_eq!(tracks, expected);
    assert_eq!(scene.tracks[0].track.places, [0.0, clip.rate().fps(), 2.0 * clip.rate().fps()]);
    assert_eq!(scene.lost, [""; 0]);
    let used = ["KHR_lights_punctual"];
    assert_eq!(scene.parts["extensionsUsed"], json!(used));
    assert_eq!(scene.parts["meshes"].as_array().unwrap().len(), 2);
    assert_eq!(scene.parts["materials"].as_array().unwrap().len(), 1, "it is shared");
}

#[test]
fn a_prop_in_a_hand_hangs_on_the_joint_as_it_does_in_the_file() {
    let clip = read(&stage());
    let scene = scene(&clip);
    assert_eq!(scene.nodes[0].carrier, Carrier::World);
    assert_eq!(scene.nodes[2].carrier, Carrier::Node(0));
    let Carrier::Joint(joint, rest) = scene.nodes[1].carrier else { panic!("the knee carries it") };
    assert_eq!(joint, 1);
    // The knee rests turned by a quarter, and twice as large: what is up in its axes is in front of it.
    let tip = rest.transform_point3(DVec3::new(0.0, 0.25, 0.0));
    assert!(tip.abs_diff_eq(DVec3::new(0.0, 0.0, 0.5), 1e-6), "{tip}");
}

#[test]
fn the_camera_that_moves_is_known_frame_by_frame() {
    let clip = read(&stage());
    let path = clip.beside().unwrap().camera.as_ref().unwrap();
    assert_eq!((path.name.as_str(), path.poses.len()), ("eye", clip.len()));
    let (first, last) = (path.poses[0], path.poses[clip.len() - 1]);
    assert_eq!((first.place, last.place), (DVec3::new(0., 1., 5.), DVec3::new(2., 1., 5.)));
    assert!(matches!(first.lens, Lens::Perspective(height) if (height - 0.61867).abs() < 1e-4));
    let mut still = stage();
    still.document["cameras"].as_array_mut().unwrap().clear();
    assert_eq!(read(&still).beside().unwrap().camera, None);
}

#[test]
fn the_body_alone_keeps_nothing_and_what_cannot_be_kept_is_named() {
    let mut bare = stage();
    for node in [3, 4, 5, 6, 7] {
        bare.document["nodes"][node] = json!({ "name": "empty" });
    }
    bare.document["animations"][0]["channels"].as_array_mut().unwrap().truncate(2);
    assert!(read(&bare).beside().is_none());

    let mut face = stage();
    let weights = face.add("SCALAR", 1, &[0.0; 6]);
    face.play(6, "weights", "LINEAR", weights);
    face.document["nodes"][6]["mesh"] = 1.into();
    face.document["meshes"][0]["primitives"][0]["extensions"] =
        json!({ "KHR_draco_mesh_compression": { "bufferView": 0 } });
    let clip = read(&face);
    let lost = &scene(&clip).lost;
    assert_eq!(lost[0], "the morphs of skin, whose shape is the body's");
    assert_eq!(lost[1], "the shape of sword (meshes: it is compressed)");
    let sword = &scene(&clip).nodes[1];
    assert!(!sword.json.contains_key("mesh"), "the node stays, and its keys");
    let found = Options::default().read(&face.glb()).unwrap().found;
    let words = |what: &str| found.iter().find(|found| found.what == what).unwrap().is.clone();
    assert!(words("left out").contains("the morphs of skin"));
    assert_eq!(
        words("beside"),
        "beside the body: cameras (1), shapes (1), nodes that move: sword, eye, balloon (3)"
    );
}

#[test]
fn a_camera_that_moves_is_no_joint_of_a_body_without_skins() {
    let mut stage = stage();
    stage.document["skins"] = json!([]);
    stage.document["nodes"][6] = json!({ "name": "empty" });
    let clip = read(&stage);
    assert!(clip.skeleton().joints.iter().all(|joint| joint.name != "eye"));
    assert!(clip.beside().unwrap().camera.as_ref().unwrap().moves());
}

#[test]
fn one_sampler_that_many_channels_name_does_not_fill_the_memory() {
    let mut many = stage();
    let weights = many.add("SCALAR", 1, &[0.0; 9000]);
    (0..20).for_each(|_| many.play(5, "weights", "LINEAR", weights));
    let limited = |bytes: u64| {
        let stream = genga::motion::StreamLimit { bytes };
        Options { stream, ..Options::default() }.read(&many.glb())
    };
    let error = limited(1 << 20).unwrap_err().to_string();
    assert!(error.contains("more numbers than are taken into memory"), "{error}");
    assert!(limited(1 << 21).is_ok());
}
