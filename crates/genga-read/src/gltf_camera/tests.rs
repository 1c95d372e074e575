use serde_json::{Value, json};

use super::*;
use genga::motion::{Channel, Joint, JointId, Skeleton};
use genga::time::{Frame, FrameRate};

/// A body of two joints, `up` apart, that stands at `place` in its only frame.
fn body(place: DVec3, up: DVec3) -> Clip {
    let joint = |parent: Option<usize>, offset: DVec3| Joint {
        name: "joint".into(),
        parent: parent.map(JointId),
        offset,
        channels: if parent.is_some() { vec![] } else { vec![Channel::Rotation(Axis::X)] },
        first_channel: 0,
        end_sites: vec![],
    };
    let joints = vec![joint(None, place - up / 2.0), joint(Some(0), up)];
    let rate = FrameRate::new(24.0).unwrap();
    Clip::new(Skeleton { joints }, rate, Frame(0), 1, vec![0.0]).unwrap()
}

/// A document of two cameras: the first is 5 m in front of a node that is turned to look along −X, the
/// second is orthographic.
fn document() -> Value {
    let half = 0.5f64.sqrt();
    json!({
        "asset": { "version": "2.0" },
        "cameras": [{ "type": "perspective", "name": "lens" }, { "type": "orthographic" }],
        "nodes": [
            { "name": "carrier", "translation": [1, 2, 0], "rotation": [0, half, 0, half], "children": [2] },
            { "name": "body", "mesh": 0 },
            { "name": "Camera", "camera": 0, "translation": [0, 0, 5] },
            { "camera": 1, "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 1, 4, 1] },
        ],
    })
}

fn read(document: &Value, name: Option<&str>) -> Result<GltfCamera, Error> {
    GltfCamera::read(document.to_string().as_bytes(), name)
}

fn glb(document: &Value) -> Vec<u8> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let words = [2, 20 + json.len() as u32, json.len() as u32].map(u32::to_le_bytes);
    [b"glTF", &words[0], &words[1], &words[2], &b"JSON"[..], &json].concat()
}

#[test]
fn it_stands_and_looks_as_all_that_carries_it_says() {
    let camera = read(&document(), None).unwrap();
    assert_eq!(camera.name, "Camera");
    assert!(camera.at.abs_diff_eq(DVec3::new(6.0, 2.0, 0.0), 1e-12), "{}", camera.at);
    assert!(camera.towards.abs_diff_eq(DVec3::NEG_X, 1e-12), "{}", camera.towards);
    assert!(!camera.is_orthographic && !camera.is_animated);
    assert_eq!(GltfCamera::read(&glb(&document()), None).unwrap(), camera, "as a GLB");
    assert_eq!(read(&document(), Some("lens")).unwrap(), camera, "by its own name");
}

#[test]
fn a_matrix_may_scale_and_a_camera_may_have_no_name() {
    let camera = read(&document(), Some("of node 3"));
    assert!(camera.is_err(), "that is what it is called and no name");
    let mut second = document();
    second["nodes"][2]["camera"] = Value::Null;
    let camera = read(&second, None).unwrap();
    assert_eq!((camera.name.as_str(), camera.at), ("of node 3", DVec3::new(0.0, 1.0, 4.0)));
    assert_eq!(camera.towards, DVec3::NEG_Z);
    assert!(camera.is_orthographic);
}

#[test]
fn what_moves_it_or_its_carrier_is_told() {
    for (node, is_animated) in [(0, true), (1, false), (2, true)] {
        let mut moving = document();
        moving["animations"] =
            json!([{ "channels": [{ "target": { "node": node, "path": "translation" } }] }]);
        assert_eq!(read(&moving, None).unwrap().is_animated, is_animated, "node {node}");
    }
}

#[test]
fn it_looks_at_the_middle_of_the_body_in_the_clip_s_own_unit() {
    let camera = read(&document(), None).unwrap();
    // The camera looks along −X past (x, 2, 0), so the point nearest to the body is on that line.
    let eye = camera.eye(&body(DVec3::new(-200.0, 90.0, 30.0), 170.0 * DVec3::Y)).unwrap();
    assert_eq!(
        (eye.at, eye.target),
        (DVec3::new(600.0, 200.0, 0.0), DVec3::new(-200.0, 200.0, 0.0))
    );
    // Blender writes BVH with Z up; −Z in glTF becomes Y.
    let camera = GltfCamera { at: DVec3::new(1.0, 2.0, 3.0), towards: DVec3::NEG_Z, ..camera };
    let eye = camera.eye(&body(DVec3::new(0.0, 0.0, 0.9), 1.7 * DVec3::Z)).unwrap();
    assert_eq!((eye.at, eye.target), (DVec3::new(1.0, -3.0, 2.0), DVec3::new(1.0, 0.0, 2.0)));
}

#[test]
fn without_perspective_it_stands_so_far_off_that_none_is_left() {
    let camera = GltfCamera { is_orthographic: true, ..read(&document(), None).unwrap() };
    let eye = camera.eye(&body(DVec3::new(0.0, 90.0, 0.0), 170.0 * DVec3::Y)).unwrap();
    assert_eq!(
        (eye.at, eye.target),
        (DVec3::new(600_000.0, 200.0, 0.0), DVec3::new(0.0, 200.0, 0.0))
    );
}

#[test]
fn a_body_behind_it_is_not_seen() {
    let camera = read(&document(), None).unwrap();
    let error = camera.eye(&body(DVec3::new(700.0, 90.0, 0.0), 170.0 * DVec3::Y)).unwrap_err();
    assert!(error.to_string().contains("camera Camera looks away from the body"), "{error}");
}

#[test]
fn a_file_without_the_camera_says_which_there_are() {
    let message = read(&document(), Some("Camera.001")).unwrap_err().to_string();
    assert_eq!(message, "there is no camera Camera.001; there is Camera, of node 3");
    let mut none = document();
    none["cameras"] = json!([]);
    assert!(
        read(&none, None).unwrap_err().to_string().contains("no camera that stands in its scene")
    );
    assert!(read(&none, Some("Camera")).unwrap_err().to_string().contains("export one with it"));
}

#[test]
fn a_file_that_is_no_gltf_is_refused() {
    let whole = glb(&document());
    let refused = |bytes: &[u8], why: &str| {
        let message = GltfCamera::read(bytes, None).unwrap_err().to_string();
        assert!(message.contains(why), "{message}");
    };
    refused(b"HIERARCHY", "byte 0: is no glTF: it begins neither with glTF");
    refused(b"", "is no glTF");
    refused(b"{ \"asset\": true", "1:15: is no glTF 2.0: invalid type");
    refused(&whole[..whole.len() - 8], "is cut off");
    refused(&whole[..15], "is cut off in its head");
    refused(&whole[..6], "is cut off in its head");
    let mut other = whole.clone();
    other[16..20].copy_from_slice(b"BIN\0");
    refused(&other, "does not come first");
    let mut old = whole.clone();
    old[4] = 1;
    refused(&old, "another version than 2");
    let mut circle = document();
    circle["nodes"][2]["children"] = json!([0]);
    refused(circle.to_string().as_bytes(), "carries itself");
    let mut gone = document();
    gone["nodes"][2]["scale"] = json!([0, 0, 0]);
    refused(gone.to_string().as_bytes(), "scaled away");
}
