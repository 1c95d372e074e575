//! Tests small documents: interpolation, the choice of joints, and damaged files.

use glam::DVec3;
use serde_json::{Value, json};

use super::*;
use crate::tests::read_changed;
use crate::{Options, Read};
use genga::motion::{Body, Clip, Poser, StreamLimit};
use genga::time::{Frame, FrameRate};

/// A hip that travels along X, a knee that makes a quarter turn about X, and a foot that only hangs there;
/// keys at 0, 0.5 and 1 second.
fn document(between: &str) -> Value {
    let half = 0.5f32.sqrt();
    let times = [0.0f32, 0.5, 1.0];
    let rows: Vec<f32> = match between {
        // Zero tangents make the motion ease.
        "CUBICSPLINE" => {
            [0.0f32, 1.0, 3.0].iter().flat_map(|x| [0., 0., 0., *x, 1., 0., 0., 0., 0.]).collect()
        }
        _ => [0.0f32, 1.0, 3.0].iter().flat_map(|x| [*x, 1.0, 0.0]).collect(),
    };
    let turns = [0.0f32, 0.0, 0.0, 1.0, half, 0.0, 0.0, half, half, 0.0, 0.0, half];
    let bytes: Vec<u8> =
        times.iter().chain(&rows).chain(&turns).flat_map(|number| number.to_le_bytes()).collect();
    let (first, second) = (12, 12 + 4 * rows.len());
    let rows = rows.len() / 3;
    json!({
        "asset": { "version": "2.0", "generator": "a test" },
        "nodes": [
            { "name": "scene", "children": [1, 4] },
            { "name": "hip", "translation": [0, 1, 0], "children": [2] },
            { "name": "knee", "translation": [0, 1, 0], "scale": [2, 2, 2], "children": [3] },
            { "name": "foot", "translation": [0, 0.5, 0] },
            { "name": "lamp" },
        ],
        "animations": [{
            "name": "walk",
            "channels": [
                { "sampler": 0, "target": { "node": 1, "path": "translation" } },
                { "sampler": 1, "target": { "node": 2, "path": "rotation" } },
                { "sampler": 1, "target": { "node": 2, "path": "weights" } },
            ],
            "samplers": [
                { "input": 0, "output": 1, "interpolation": between },
                { "input": 0, "output": 2 },
            ],
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR" },
            { "bufferView": 1, "componentType": 5126, "count": rows, "type": "VEC3" },
            { "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 12 },
            { "buffer": 0, "byteOffset": first, "byteLength": second - first },
            { "buffer": 0, "byteOffset": second, "byteLength": 48 },
        ],
        "buffers": [{ "byteLength": bytes.len(), "uri": data(&bytes) }],
    })
}

fn data(bytes: &[u8]) -> String {
    use base64::Engine;
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    format!("data:application/octet-stream;base64,{text}")
}

fn read(document: &Value) -> Result<Read, Error> {
    Options::default().read(document.to_string().as_bytes())
}

fn places(clip: &Clip, frame: usize) -> Vec<DVec3> {
    let mut body = Body::new(clip.skeleton());
    let mut poser = Poser::new(clip);
    body.place(poser.frame(Frame(frame)));
    body.positions().to_vec()
}

#[test]
fn what_is_between_keys_is_what_the_file_says() {
    for (between, at_18) in [("LINEAR", 2.0), ("STEP", 1.0), ("CUBICSPLINE", 2.0)] {
        let read = read(&document(between)).unwrap();
        let clip = &read.clip;
        assert_eq!((clip.len(), clip.rate().fps()), (25, 24.0), "{between}");
        let hips = [0, 6, 12, 18, 24].map(|frame| places(clip, frame)[0].x);
        let at_6 = if between == "STEP" { 0.0 } else { 0.5 };
        for (found, expected) in hips.iter().zip([0.0, at_6, 1.0, at_18, 3.0]) {
            assert!((found - expected).abs() < 1e-9, "{between}: {hips:?}");
        }
    }
    let eased = places(&read(&document("CUBICSPLINE")).unwrap().clip, 3)[0].x;
    assert!((eased - 0.15625).abs() < 1e-9, "3/16 − 2/64 of the way: {eased}");
}

#[test]
fn a_bare_tree_is_what_moves_and_what_hangs_on_it() {
    let read = read(&document("LINEAR")).unwrap();
    let clip = &read.clip;
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["hip", "knee", "foot"], "neither the scene nor the lamp");
    // A quarter turn of the knee moves the foot, a whole metre away by the scale, from above the knee to
    // its front.
    let [begin, half, end] = [0, 6, 12].map(|frame| places(clip, frame)[2]);
    assert!((begin - DVec3::new(0.0, 3.0, 0.0)).length() < 1e-6, "{begin}");
    let eighth = 0.5f64.sqrt();
    assert!((half - DVec3::new(0.5, 2.0 + eighth, eighth)).length() < 1e-6, "{half}");
    assert!((end - DVec3::new(1.0, 2.0, 1.0)).length() < 1e-6, "{end}");
    let said: Vec<&str> = read.found.iter().map(|found| found.is.as_str()).collect();
    assert_eq!(
        said,
        [
            "glTF, glTF 2.0, by a test",
            "Y up",
            "metres",
            "animation walk, sampled 24 a second",
            "left out: the morphs of knee, whose shape is the body's"
        ]
    );
    let finer = Options { fps: FrameRate::new(48.0).ok(), ..Options::default() };
    let finer = finer.read(document("LINEAR").to_string().as_bytes()).unwrap().clip;
    assert_eq!(finer.len(), 49);
}

#[test]
fn bones_of_a_skin_and_of_vrm_are_joints() {
    let mut skinned = document("LINEAR");
    skinned["skins"] = json!([{ "joints": [2, 3] }]);
    let clip = read(&skinned).unwrap().clip;
    assert_eq!(clip.skeleton().joints[0].name, "knee");
    assert!(
        (places(&clip, 12)[0] - DVec3::new(1.0, 2.0, 0.0)).length() < 1e-6,
        "carried all the same"
    );
    let bones = [
        json!({ "VRMC_vrm_animation": { "humanoid": { "humanBones": { "hips": { "node": 1 }, "leftLowerLeg": { "node": 2 } } } } }),
        json!({ "VRM": { "humanoid": { "humanBones": [{ "bone": "hips", "node": 1 }, { "bone": "leftLowerLeg", "node": 2 }, { "bone": "jaw", "node": 99 }] } } }),
        json!({ "VRM": { "humanoid": { "humanBones": [{ "bone": "leftThumbProximal", "node": 1 }, { "bone": "leftThumbIntermediate", "node": 2 }] } } }),
    ];
    let names = [["hips", "leftLowerLeg"]; 2].into_iter();
    // VRM 0 uses other names for the joints of a thumb.
    let names = names.chain([["leftThumbMetacarpal", "leftThumbProximal"]]);
    for (extensions, expected) in bones.into_iter().zip(names) {
        let mut called = document("LINEAR");
        called["extensions"] = extensions;
        let read = read(&called).unwrap();
        let joints = &read.clip.skeleton().joints;
        let names: Vec<&str> = joints.iter().map(|joint| &joint.name[..]).collect();
        assert_eq!(names, expected);
        assert!(read.found[0].is.starts_with("VRM"), "{:?}", read.found);
    }
}

#[test]
fn numbers_may_be_shares_and_rows_may_be_sparse() {
    let mut sparse = document("LINEAR");
    // The last row of the hip's translation is replaced by numbers of the rotation accessor.
    sparse["bufferViews"].as_array_mut().unwrap().push(json!({ "buffer": 1, "byteLength": 1 }));
    sparse["buffers"].as_array_mut().unwrap().push(json!({ "uri": data(&[2]) }));
    sparse["accessors"][1]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": 3, "componentType": 5121 },
        "values": { "bufferView": 2, "byteOffset": 8 },
    });
    let hip = places(&read(&sparse).unwrap().clip, 24)[0];
    let half = f64::from(0.5f32.sqrt());
    assert!((hip - DVec3::new(0.0, 1.0, half)).length() < 1e-9, "{hip}");
    let mut short = document("LINEAR");
    let turns: Vec<u8> = [[0i16, 0, 0, 32767], [32767, 0, 0, 0], [0, 0, 0, -32767]]
        .concat()
        .iter()
        .flat_map(|n| n.to_le_bytes())
        .collect();
    short["buffers"].as_array_mut().unwrap().push(json!({ "uri": data(&turns) }));
    short["bufferViews"][2] = json!({ "buffer": 1, "byteLength": 24 });
    short["accessors"][2]["componentType"] = json!(5122);
    short["accessors"][2]["normalized"] = json!(true);
    let foot = places(&read(&short).unwrap().clip, 12)[2];
    assert!((foot - DVec3::new(1.0, 1.0, 0.0)).length() < 1e-9, "half a turn: {foot}");
}

#[test]
fn a_glb_has_its_numbers_in_its_second_chunk_and_a_gltf_in_a_file_beside_it() {
    use base64::Engine;
    let mut document = document("LINEAR");
    let whole = read(&document).unwrap().clip;
    let uri = document["buffers"][0]["uri"].take();
    let (_, text) = uri.as_str().unwrap().split_once(',').unwrap();
    let bytes = base64::engine::general_purpose::STANDARD.decode(text).unwrap();
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let words =
        [2, 28 + (json.len() + bytes.len()) as u32, json.len() as u32].map(u32::to_le_bytes);
    let glb = [
        b"glTF",
        &words[0],
        &words[1],
        &words[2],
        &b"JSON"[..],
        &json,
        &(bytes.len() as u32).to_le_bytes(),
        b"BIN\0",
        &bytes,
    ]
    .concat();
    assert_eq!(Options::default().read(&glb).unwrap().clip, whole);
    for end in (0..40).chain((40..glb.len()).step_by(5)) {
        let error = Options::default().read(&glb[..end]).unwrap_err();
        let has_place = match &error {
            Error::Motion { place: Place::Byte(byte), .. } => *byte <= end as u64,
            other => matches!(other, Error::Motion { .. }),
        };
        assert!(has_place, "{end}: {error}");
    }
    let place = tempfile::tempdir().unwrap();
    std::fs::write(place.path().join("a walk.bin"), &bytes).unwrap();
    document["buffers"][0]["uri"] = json!("a%20walk.bin");
    let path = place.path().join("walk.gltf");
    std::fs::write(&path, document.to_string()).unwrap();
    assert_eq!(crate::open(&path).unwrap().clip, whole);
    let alone = read(&document).unwrap_err().to_string();
    assert!(alone.starts_with("buffers[0]: it needs a walk.bin beside it"), "{alone}");
}

#[test]
fn what_lies_is_refused_with_its_path() {
    let said = |change: &dyn Fn(&mut Value)| {
        let mut lying = document("LINEAR");
        change(&mut lying);
        read(&lying).unwrap_err().to_string()
    };
    let cases: [(&str, Value, &str); 11] = [
        (
            "/animations/0/channels/0/target/node",
            json!(9),
            "animations[0].channels[0]: there is no node 9",
        ),
        (
            "/animations/0/channels/0/sampler",
            json!(9),
            "animations[0].channels[0]: there is no sampler 9",
        ),
        (
            "/animations/0/samplers/0/input",
            json!(9),
            "animations[0].samplers[0].input: there is no accessor 9",
        ),
        (
            "/animations/0/samplers/0/interpolation",
            json!("SLOW"),
            "animations[0].samplers[0].interpolation: expected LINEAR",
        ),
        (
            "/animations/0/samplers/0/output",
            json!(2),
            "animations[0].samplers[0]: expected rows of 1 and 3",
        ),
        (
            "/animations/0/samplers/1/input",
            json!(2),
            "animations[0].samplers[1]: expected rows of 1 and 4",
        ),
        (
            "/accessors/0/count",
            json!(4_000_000_000u64),
            "accessors[0]: it says 4000000000 rows, and there is room for 3",
        ),
        ("/accessors/0/count", json!(2), "animations[0].samplers[0]: 2 keys need 2 rows, found 3"),
        ("/accessors/1/bufferView", json!(8), "accessors[1]: there is no bufferView 8"),
        ("/bufferViews/1/buffer", json!(8), "buffers[8]: there is no such buffer"),
        ("/nodes/3/children", json!([1]), "nodes[3].children[0]: node 1 is carried twice"),
    ];
    for (path, value, expected) in cases {
        let error = said(&|lying| match lying.pointer_mut(path) {
            Some(place) => *place = value.clone(),
            None => lying["nodes"][3]["children"] = value.clone(),
        });
        assert!(error.starts_with(expected), "{path}: {error}");
    }
    assert!(
        said(&|lying| lying["asset"]["version"] = json!("1.0")).contains("expected asset.version")
    );
    assert!(said(&|lying| lying["animations"] = json!([])).contains("there is no animation"));
    assert!(said(&|lying| lying["nodes"] = json!(3)).starts_with("1:"), "line and column");
    let mut back = document("LINEAR");
    back["accessors"][0]["byteOffset"] = json!(4);
    back["accessors"][0]["count"] = json!(2);
    let error = read(&back).unwrap_err().to_string();
    assert!(error.starts_with("animations[0].samplers[0]: 2 keys"), "{error}");
    let little = Options { stream: StreamLimit { bytes: 60 }, ..Options::default() };
    let error = little.read(document("LINEAR").to_string().as_bytes()).unwrap_err().to_string();
    assert!(error.contains("--memory"), "{error}");
}

#[test]
fn what_is_packed_or_no_gltf_is_called_so() {
    let mut packed = document("LINEAR");
    packed["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
    packed["bufferViews"][2]["extensions"] = json!({ "EXT_meshopt_compression": { "buffer": 0 } });
    let error = read(&packed).unwrap_err().to_string();
    assert!(error.starts_with("bufferViews[2]: its numbers are packed by EXT_meshopt"), "{error}");
    let place = tempfile::tempdir().unwrap();
    let said = |name: &str, bytes: &[u8]| {
        let path = place.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        crate::open(&path).unwrap_err().to_string()
    };
    assert_eq!(said("walk.glb", b""), "the file is empty; expected glTF");
    assert!(said("walk.glb", b"nothing").starts_with("byte 0: is no glTF: it begins neither"));
    assert!(said("walk.gltf", b"{").starts_with("1:1: is no glTF 2.0: EOF"));
}

/// The document with the keys of both curves at other times.
fn timed(times: [f32; 3]) -> Result<Read, Error> {
    let mut document = document("LINEAR");
    let bytes: Vec<u8> = times.into_iter().flat_map(f32::to_le_bytes).collect();
    document["buffers"].as_array_mut().unwrap().push(json!({ "uri": data(&bytes) }));
    document["bufferViews"][0] = json!({ "buffer": 1, "byteLength": 12 });
    read(&document)
}

#[test]
fn of_two_keys_at_one_instant_the_second_counts() {
    let clip = timed([0.0, 0.5, 0.5]).unwrap().clip;
    assert_eq!((clip.len(), clip.rate().fps()), (13, 24.0));
    assert!((places(&clip, 11)[0].x - 11.0 / 12.0).abs() < 1e-6);
    assert!((places(&clip, 12)[0].x - 3.0).abs() < 1e-6);
    let back = timed([0.0, 0.5, 0.4]).unwrap_err().to_string();
    assert!(back.ends_with("key 2 is earlier than the one before it"), "{back}");
}

#[test]
fn keys_of_no_rate_are_sampled_as_close_as_they_lie_and_far_ones_are_left_out() {
    let fine = timed([0.0, 0.007, 0.014]).unwrap();
    assert_eq!(fine.clip.rate().fps(), 240.0);
    assert!(fine.warnings.iter().all(|warning| warning.code != "W_KEYS_FINER"));
    let finest = timed([0.0, 0.0013, 0.0026]).unwrap();
    assert!(finest.warnings[0].message.ends_with("--fps 769 reads them all"));
    let far = timed([0.0, 1.0, 40_000.0]).unwrap();
    assert_eq!((far.clip.len(), far.warnings[0].code), (25, "W_KEY_FAR"));
    let alone = timed([0.0, 39_999.0, 40_000.0]).unwrap_err().to_string();
    assert!(alone.contains("there is no key between 0 s and 39999 s"), "{alone}");
}

#[test]
fn a_document_that_was_changed_is_read_or_refused() {
    for between in ["LINEAR", "CUBICSPLINE"] {
        read_changed(document(between).to_string().as_bytes(), 1000);
    }
}

#[test]
fn what_moves_in_the_tree_of_a_skin_is_read_and_a_thing_without_its_shape_is_named() {
    let mut partly = document("LINEAR");
    // The skin has only the hip. A sword on the hip, a ball in another tree and a camera move too.
    partly["skins"] = json!([{ "joints": [1] }]);
    partly["nodes"][1]["children"] = json!([2, 5]);
    partly["nodes"].as_array_mut().unwrap().extend([
        json!({ "name": "sword", "mesh": 0 }),
        json!({ "name": "ball", "mesh": 0 }),
        json!({ "name": "eye", "camera": 0 }),
        json!({ "name": "empty" }),
    ]);
    partly["animations"][0]["channels"].as_array_mut().unwrap().extend(
        (5..9).map(|node| json!({ "sampler": 1, "target": { "node": node, "path": "rotation" } })),
    );
    let read = read(&partly).unwrap();
    let names: Vec<&str> =
        read.clip.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["hip", "knee", "foot"]);
    let bare = super::tests::read(&document("LINEAR")).unwrap();
    assert_eq!(read.clip, bare.clip, "as where no skin is");
    let left_out = read.found.iter().find(|found| found.what == "left out").unwrap();
    assert_eq!(
        left_out.is,
        "left out: the morphs of knee, whose shape is the body's, \
         the shape of sword (meshes[0]: there is none), \
         the shape of ball (meshes[0]: there is none), \
         the shape of eye (cameras[0]: there is none)"
    );
}
