//! Tests small ASCII scenes: takes, axes, units and damaged files.

use glam::{DQuat, DVec3};

use crate::tests::read_changed;
use crate::{Options, Read};
use genga::error::{Error, Place};
use genga::motion::{Body, Clip, Poser, StreamLimit};
use genga::time::{Frame, FrameRate};

/// FBX ticks in a second.
const SECOND: i64 = 46_186_158_000;

/// A take whose curve turns the knee about X, from one angle in degrees to another within a second.
fn take(at: i64, name: &str, [from, to]: [f64; 2]) -> [String; 2] {
    let [stack, layer, node, curve] = [at, at + 1, at + 2, at + 3];
    let objects = format!(
        r#"
    AnimationStack: {stack}, "AnimStack::{name}", "" {{ Properties70: {{ P: "LocalStop", "KTime", "Time", "",{SECOND} }} }}
    AnimationLayer: {layer}, "AnimLayer::Base", "" {{ }}
    AnimationCurveNode: {node}, "AnimCurveNode::R", "" {{ Properties70: {{ P: "d|X", "Number", "", "A",0 }} }}
    AnimationCurve: {curve}, "AnimCurve::", "" {{
        Default: 0
        KeyVer: 4008
        KeyTime: *2 {{ a: 0,{SECOND} }}
        KeyValueFloat: *2 {{ a: {from},{to} }}
        KeyAttrFlags: *1 {{ a: 4 }}
        KeyAttrDataFloat: *4 {{ a: 0,0,0,0 }}
        KeyAttrRefCount: *1 {{ a: 2 }}
    }}"#
    );
    let connections = format!(
        r#"
    C: "OO",{layer},{stack}
    C: "OO",{node},{layer}
    C: "OP",{node},4, "Lcl Rotation"
    C: "OP",{curve},{node}, "d|X""#
    );
    [objects, connections]
}

/// Hip, knee and foot, each 2 units above the one before it along the axis that is up, Y or Z.
fn scene(up: usize, unit: f64, takes: &[[String; 2]]) -> String {
    let front = if up == 2 { (1, -1) } else { (2, 1) };
    let bone = |at: i64, name: &str, properties: &str| {
        let along = if up == 2 { "0,0,2" } else { "0,2,0" };
        format!(
            r#"
    NodeAttribute: {}, "NodeAttribute::{name}", "LimbNode" {{ TypeFlags: "Skeleton" }}
    Model: {at}, "Model::{name}", "LimbNode" {{ Properties70: {{ P: "Lcl Translation", "Lcl Translation", "", "A",{along} {properties} }} }}"#,
            at + 90
        )
    };
    // The knee has a pre-rotation.
    let turned = r#"
        P: "RotationActive", "bool", "", "",1
        P: "PreRotation", "Vector3D", "Vector", "",30,0,0"#;
    let bones = bone(3, "Hip", "") + &bone(4, "Knee", turned) + &bone(5, "Foot", "");
    let objects: String = takes.iter().map(|[objects, _]| objects.as_str()).collect();
    let connections: String = takes.iter().map(|[_, connections]| connections.as_str()).collect();
    format!(
        r#"; FBX 7.4.0 project file
FBXHeaderExtension:  {{
    FBXHeaderVersion: 1003
    FBXVersion: 7400
}}
GlobalSettings:  {{
    Version: 1000
    Properties70:  {{
        P: "UpAxis", "int", "Integer", "",{up}
        P: "UpAxisSign", "int", "Integer", "",1
        P: "FrontAxis", "int", "Integer", "",{}
        P: "FrontAxisSign", "int", "Integer", "",{}
        P: "CoordAxis", "int", "Integer", "",0
        P: "CoordAxisSign", "int", "Integer", "",1
        P: "UnitScaleFactor", "double", "Number", "",{unit}
        P: "TimeMode", "enum", "", "",6
    }}
}}
Objects:  {{{bones}{objects}
}}
Connections:  {{
    C: "OO",3,0
    C: "OO",4,3
    C: "OO",5,4
    C: "OO",93,3
    C: "OO",94,4
    C: "OO",95,5{connections}
}}
"#,
        front.0, front.1
    )
}

fn walk() -> [String; 2] {
    take(10, "Walk", [0.0, 90.0])
}

fn read(text: &str) -> Result<Read, Error> {
    Options::default().read(text.as_bytes())
}

/// World position of the foot.
fn foot(clip: &Clip, frame: usize) -> DVec3 {
    let mut body = Body::new(clip.skeleton());
    let mut poser = Poser::new(clip);
    body.place(poser.frame(Frame(frame)));
    body.positions()[2]
}

#[test]
fn curves_and_pre_rotations_are_sampled_at_the_rate_of_the_scene() {
    let read = read(&scene(1, 1.0, &[walk()])).unwrap();
    let clip = &read.clip;
    assert_eq!((clip.len(), clip.rate().fps()), (31, 30.0));
    for (frame, degrees) in [(0, 30.0), (15, 75.0), (30, 120.0)] {
        let angle = f64::to_radians(degrees);
        let expected = DVec3::new(0.0, 4.0 + 2.0 * angle.cos(), 2.0 * angle.sin());
        let found = foot(clip, frame);
        assert!((found - expected).length() < 1e-9, "{frame}: {found}, not {expected}");
    }
    let channels: Vec<usize> =
        clip.skeleton().joints.iter().map(|joint| joint.channels.len()).collect();
    assert_eq!(channels, [6, 3, 3]);
    let codes: Vec<&str> = read.warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(codes, ["W_FORMAT"]);
    let rate = FrameRate::new(60.0).ok();
    let finer = Options { fps: rate, ..Options::default() };
    let finer = finer.read(scene(1, 1.0, &[walk()]).as_bytes()).unwrap().clip;
    assert_eq!(finer.len(), 61);
    assert!((foot(&finer, 30) - foot(clip, 15)).length() < 1e-9);
    let fewer = Options { fps: FrameRate::new(15.0).ok(), ..Options::default() };
    let fewer = fewer.read(scene(1, 1.0, &[walk()]).as_bytes()).unwrap().clip;
    assert_eq!((fewer.len(), fewer.rate().fps()), (16, 15.0), "as long, in fewer frames");
}

#[test]
fn a_key_a_hair_beside_its_frame_is_on_it() {
    // After the key the angle makes extra full turns.
    let [objects, connections] = walk();
    let key = SECOND / 2 - 10_000;
    let turning = objects
        .replace(&format!("*2 {{ a: 0,{SECOND} }}"), &format!("*3 {{ a: 0,{key},{SECOND} }}"))
        .replace("*2 { a: 0,90 }", "*3 { a: 0,90,1e7 }")
        .replace("*1 { a: 2 }", "*1 { a: 3 }");
    let clip = read(&scene(1, 1.0, &[[turning, connections]])).unwrap().clip;
    let angle = f64::to_radians(120.0);
    let expected = DVec3::new(0.0, 4.0 + 2.0 * angle.cos(), 2.0 * angle.sin());
    let found = foot(&clip, 15);
    assert!((found - expected).length() < 1e-9, "{found}, not {expected}");
}

#[test]
fn joints_stand_limb_by_limb() {
    let text = scene(1, 1.0, &[walk()])
        .replace("\n}\nConnections:", "\n    Model: 6, \"Model::Arm\", \"LimbNode\" { }\n    NodeAttribute: 96, \"NodeAttribute::Arm\", \"LimbNode\" { TypeFlags: \"Skeleton\" }\n}\nConnections:")
        .replace("C: \"OO\",95,5", "C: \"OO\",95,5\n    C: \"OO\",6,3\n    C: \"OO\",96,6");
    let clip = read(&text).unwrap().clip;
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["Hip", "Knee", "Foot", "Arm"]);
}

#[test]
fn a_scene_in_metres_with_z_up_is_turned_and_measured_in_centimetres() {
    let upright = read(&scene(1, 1.0, &[walk()])).unwrap();
    let lying = read(&scene(2, 100.0, &[walk()])).unwrap();
    let said: Vec<&str> = lying.found.iter().map(|found| found.is.as_str()).collect();
    assert_eq!(said[1..3], ["Z up, turned to Y up", "a unit of 100 cm, measured in centimetres"]);
    // With Z up, the knee turns the foot from up to front: −Y in the file, Z in the clip.
    let angle = f64::to_radians(30.0);
    let expected = 100.0 * DVec3::new(0.0, 4.0 + 2.0 * angle.cos(), 2.0 * angle.sin());
    let found = foot(&lying.clip, 0);
    assert!((found - expected).length() < 1e-9, "{found}, not {expected}");
    assert!((lying.clip.skeleton().joints[1].offset - 200.0 * DVec3::Y).length() < 1e-9);
    assert!((upright.clip.skeleton().joints[1].offset - 2.0 * DVec3::Y).length() < 1e-9);
}

/// The scene with other properties of the knee, and a take with values for Y and Z too.
fn knee(properties: &str, [y, z]: [f64; 2]) -> Result<Read, Error> {
    let pre = r#"P: "PreRotation", "Vector3D", "Vector", "",30,0,0"#;
    let first = r#"P: "d|X", "Number", "", "A",0"#;
    let others = format!(
        r#"P: "d|Y", "Number", "", "A",{y}
        P: "d|Z", "Number", "", "A",{z}"#
    );
    let text = scene(1, 1.0, &[take(10, "Walk", [20.0, 80.0])]);
    let text = text.replace(pre, &format!("{pre}\n{properties}"));
    read(&text.replace(first, &format!("{first}\n{others}")))
}

#[test]
fn all_orders_of_rotation_are_read_between_what_turns_before_and_behind_them() {
    let about = |axis: DVec3, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
    // The first letter of the name is the axis that turns first.
    let orders = ["XYZ", "XZY", "YZX", "YXZ", "ZXY", "ZYX"];
    for (order, name) in orders.into_iter().enumerate() {
        let properties = format!(
            r#"
        P: "RotationOrder", "enum", "", "",{order}
        P: "PostRotation", "Vector3D", "Vector", "",0,0,25"#
        );
        let clip = knee(&properties, [30.0, 40.0]).unwrap().clip;
        for (frame, x) in [(0, 20.0), (30, 80.0)] {
            let turn = name.chars().fold(DQuat::IDENTITY, |turn, axis| match axis {
                'X' => about(DVec3::X, x) * turn,
                'Y' => about(DVec3::Y, 30.0) * turn,
                _ => about(DVec3::Z, 40.0) * turn,
            });
            let whole = about(DVec3::X, 30.0) * turn * about(DVec3::Z, -25.0);
            let expected = DVec3::new(0.0, 4.0, 0.0) + whole * (2.0 * DVec3::Y);
            let found = foot(&clip, frame);
            assert!((found - expected).length() < 1e-6, "{name}, {frame}: {found}, not {expected}");
        }
    }
}

#[test]
fn scales_are_inherited_in_each_of_the_three_ways() {
    // The scale acts before the quarter turn, after it, or not at all.
    for (way, along) in [(1, 6.0), (0, 4.0), (2, 2.0)] {
        let text = scene(1, 1.0, &[take(10, "Walk", [0.0, 0.1])]);
        let hip = r#""Model::Hip", "LimbNode" { Properties70: {"#;
        let knee = r#""Model::Knee", "LimbNode" { Properties70: {"#;
        assert!(text.contains(hip) && text.contains(knee));
        let text = text
            .replace(
                hip,
                &format!(
                    r#"{hip} P: "Lcl Scaling", "Lcl Scaling", "", "A",3,2,1
                "#
                ),
            )
            .replace(
                knee,
                &format!(
                    r#"{knee} P: "InheritType", "enum", "", "",{way}
                "#
                ),
            )
            .replace(r#"Vector", "",30,0,0"#, r#"Vector", "",0,0,90"#);
        let clip = read(&text).unwrap().clip;
        // The knee is 2 above the hip, times the hip's scale 2.
        let expected = DVec3::new(-along, 6.0, 0.0);
        let found = foot(&clip, 0);
        assert!((found - expected).length() < 1e-6, "{way}: {found}, not {expected}");
    }
}

#[test]
fn an_even_scale_reaches_all_below_in_two_of_the_three_ways() {
    // Tests the inherit modes of the knee below a uniformly scaled hip; the foot is 2 from the knee in the
    // file.
    let text = scene(1, 1.0, &[take(10, "Walk", [0.0, 0.1])]);
    let hip = r#""Model::Hip", "LimbNode" { Properties70: {"#;
    let scaled = format!(
        r#"{hip} P: "Lcl Scaling", "Lcl Scaling", "", "A",10,10,10
                "#
    );
    let far = |text: &str| {
        let clip = read(text).unwrap().clip;
        let joints = &clip.skeleton().joints;
        joints.iter().skip(1).map(|joint| joint.offset.length()).sum::<f64>()
    };
    let plain = far(&text);
    let text = text.replace(hip, &scaled);
    for (way, times) in [(0, 10.0), (1, 10.0)] {
        let inherit = format!(
            r#"P: "InheritType", "enum", "", "",{way}
                "#
        );
        let text = text.replace("Properties70: {", &format!("Properties70: {{ {inherit}"));
        let found = far(&text);
        assert!((found - times * plain).abs() < 1e-6, "{way}: {found} beside {plain}");
    }
}

#[test]
fn what_is_no_motion_is_counted_and_a_value_that_is_no_number_has_its_joint() {
    let text = scene(1, 1.0, &[walk()]);
    let lamp = r#"
    NodeAttribute: 70, "NodeAttribute::Lamp", "Light" { }
    Model: 71, "Model::Lamp", "Light" { }
}
Connections:  {
    C: "OO",71,0
    C: "OO",70,71"#;
    let with = read(&text.replace("\n}\nConnections:  {", lamp)).unwrap();
    let last = &with.found[with.found.len() - 1];
    assert_eq!((last.what, &last.is[..]), ("left out", "left out: lights (1)"));
    let broken = read(&text.replace("a: 0,90 }", "a: 0,nan }")).unwrap_err().to_string();
    assert!(broken.starts_with("joint Knee, frame "), "{broken}");
}

#[test]
fn the_first_take_that_moves_is_read_unless_another_is_asked_for() {
    let takes = [
        take(10, "Bind", [0.0, 0.0]),
        take(20, "Walk", [0.0, 90.0]),
        take(30, "Run", [0.0, -90.0]),
    ];
    let text = scene(1, 1.0, &takes);
    let found = read(&text).unwrap();
    let moves: Vec<(&str, bool)> =
        found.takes.iter().map(|take| (take.name.as_str(), take.moves)).collect();
    assert_eq!(moves, [("Bind", false), ("Walk", true), ("Run", true)]);
    assert_eq!(found.warnings[0].code, "W_TAKES");
    assert!(foot(&found.clip, 30).z > 1.0);
    let run = Options { take: Some("Run".into()), strict: true, ..Options::default() };
    assert!(foot(&run.read(text.as_bytes()).unwrap().clip, 30).z < -1.0);
    let strict = Options { strict: true, ..Options::default() };
    let error = strict.read(text.as_bytes()).unwrap_err().to_string();
    assert!(error.ends_with("[W_TAKES]"), "{error}");
    let none = Options { take: Some("Jump".into()), ..Options::default() };
    let error = none.read(text.as_bytes()).unwrap_err().to_string();
    assert!(
        error.starts_with("take: there is no take \"Jump\"; there is Bind, Walk, Run"),
        "{error}"
    );
}

#[test]
fn what_is_damaged_is_refused_with_a_place_and_never_more() {
    let text = scene(1, 1.0, &[walk()]);
    let whole = text.as_bytes();
    for end in (0..whole.len()).step_by(7) {
        if let Err(error) = Options::default().read(&whole[..end]) {
            let has_place = match &error {
                Error::Motion { place: Place::Byte(byte), .. } => *byte <= end as u64,
                Error::Motion { .. } => true,
                _ => false,
            };
            assert!(has_place, "{end}: {error}");
        }
    }
    let error = Options::default().read(b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0").unwrap_err();
    assert!(error.to_string().starts_with("byte "), "{error}");
    let none = read(&scene(1, 1.0, &[])).unwrap_err().to_string();
    assert!(none.contains("there is no take"), "{none}");
    // A take of a century is rejected before its frames are counted.
    let long = text.replace(&SECOND.to_string(), &(SECOND * 100_000_000).to_string());
    let error = read(&long).unwrap_err().to_string();
    assert!(error.starts_with("take Walk: there is no key between 0 s and "), "{error}");
}

/// A record of a binary file at a byte offset: name, properties, and children followed by the empty record.
fn record(
    at: usize,
    name: &str,
    properties: &[&[u8]],
    inner: impl Fn(usize) -> Vec<u8>,
) -> Vec<u8> {
    let own = properties.concat();
    let begin = at + 13 + name.len() + own.len();
    let mut inner = inner(begin);
    if !inner.is_empty() {
        inner.extend([0; 13]);
    }
    let numbers = [begin + inner.len(), properties.len(), own.len()];
    let head = numbers.iter().flat_map(|number| (*number as u32).to_le_bytes());
    head.chain([name.len() as u8]).chain(name.bytes()).chain(own).chain(inner).collect()
}

#[test]
fn an_array_that_claims_more_than_is_allowed_is_not_begun() {
    // 2²⁶ numbers that are declared but absent.
    let numbers: Vec<u8> = [1 << 26, 1, 0].into_iter().flat_map(u32::to_le_bytes).collect();
    let values = |at| record(at, "KeyValueFloat", &[&[b"f", &numbers[..]].concat()], |_| vec![]);
    let identity: &[u8] = &[b'L', 9, 0, 0, 0, 0, 0, 0, 0];
    let no_word: &[u8] = &[b'S', 0, 0, 0, 0];
    let curve = |at| record(at, "AnimationCurve", &[identity, no_word, no_word], values);
    let mut binary = b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0".to_vec();
    binary.extend(record(binary.len(), "Objects", &[], curve));
    binary.extend([0; 13]);
    let little = Options { stream: StreamLimit { bytes: 1 << 20 }, ..Options::default() };
    let error = little.read(&binary).unwrap_err().to_string();
    assert!(error.contains("memory limit exceeded"), "{error}");
}

#[test]
fn a_scene_that_was_changed_is_read_or_refused() {
    read_changed(scene(1, 1.0, &[walk()]).as_bytes(), 500);
}

#[test]
fn what_moves_in_the_tree_of_a_bone_is_read_and_other_things_are_counted() {
    let text = scene(1, 1.0, &[walk()]);
    // The knee is an empty that moves; without its foot no bone hangs on it.
    let empty = text
        .replace(
            r#"NodeAttribute: 94, "NodeAttribute::Knee", "LimbNode" { TypeFlags: "Skeleton" }"#,
            "",
        )
        .replace(
            r#"NodeAttribute: 95, "NodeAttribute::Foot", "LimbNode" { TypeFlags: "Skeleton" }"#,
            "",
        )
        .replace("    C: \"OO\",94,4\n    C: \"OO\",95,5", "")
        .replace(r#"Model::Knee", "LimbNode""#, r#"Model::Knee", "Null""#)
        .replace(r#"Model::Foot", "LimbNode""#, r#"Model::Foot", "Null""#);
    let clip = read(&empty).unwrap().clip;
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["Hip", "Knee", "Foot"]);
    assert!((foot(&clip, 15) - foot(&read(&text).unwrap().clip, 15)).length() < 1e-9);
    // A rig control is a curve, and the bones follow it.
    let control = empty.replace(r#"Model::Knee", "Null""#, r#"Model::Knee", "NurbsCurve""#);
    let curve = r#"Objects:  {
    Geometry: 94, "Geometry::Knee", "NurbsCurve" {
        Order: 4
        Form: "Open"
    }"#;
    let control = control
        .replace("Objects:  {", curve)
        .replace("    C: \"OO\",93,3", "    C: \"OO\",93,3\n    C: \"OO\",94,4");
    let read = read(&control).unwrap();
    let left_out = read.found.iter().find(|found| found.what == "left out").unwrap();
    assert_eq!(left_out.is, "left out: nodes that move beside the body: Knee (1)");
}
