//! Small scenes as text: takes, axes, units, and what is damaged.

use glam::DVec3;

use crate::error::{Error, Place};
use crate::motion::file::{Options, Read};
use crate::motion::read::file::tests::read_changed;
use crate::motion::{Body, Clip, Poser, StreamLimit};
use crate::time::{Frame, FrameRate};

/// Ticks of a second.
const SECOND: i64 = 46_186_158_000;

/// A take: its curve turns the knee about X, from a number of degrees to another within a second.
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
    // The knee turns before and behind its own rotation.
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

/// Where the foot is.
fn foot(clip: &Clip, frame: usize) -> DVec3 {
    let mut body = Body::new(clip.skeleton());
    let mut poser = Poser::of(clip);
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
    let finer = Options { sample_rate: rate, ..Options::default() };
    let finer = finer.read(scene(1, 1.0, &[walk()]).as_bytes()).unwrap().clip;
    assert_eq!(finer.len(), 61);
    assert!((foot(&finer, 30) - foot(clip, 15)).length() < 1e-9);
    let slower = Options { fps: FrameRate::new(15.0).ok(), ..Options::default() };
    let slower = slower.read(scene(1, 1.0, &[walk()]).as_bytes()).unwrap().clip;
    assert_eq!((slower.len(), slower.rate().fps()), (31, 15.0), "the frames stay");
}

#[test]
fn a_scene_in_metres_with_z_up_is_turned_and_measured_in_centimetres() {
    let upright = read(&scene(1, 1.0, &[walk()])).unwrap();
    let lying = read(&scene(2, 100.0, &[walk()])).unwrap();
    let said: Vec<&str> = lying.found.iter().map(|found| found.is.as_str()).collect();
    assert_eq!(said[1..3], ["Z up, turned to Y up", "a unit of 100 cm, measured in centimetres"]);
    // Z up, the knee turns the foot from up to front, which is −Y there and Z here.
    let angle = f64::to_radians(30.0);
    let expected = 100.0 * DVec3::new(0.0, 4.0 + 2.0 * angle.cos(), 2.0 * angle.sin());
    let found = foot(&lying.clip, 0);
    assert!((found - expected).length() < 1e-9, "{found}, not {expected}");
    assert!((lying.clip.skeleton().joints[1].offset - 200.0 * DVec3::Y).length() < 1e-9);
    assert!((upright.clip.skeleton().joints[1].offset - 2.0 * DVec3::Y).length() < 1e-9);
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
                Error::Motion { .. } | Error::Bvh { .. } => true,
                _ => false,
            };
            assert!(has_place, "{end}: {error}");
        }
    }
    let error = Options::default().read(b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0").unwrap_err();
    assert!(error.to_string().starts_with("byte "), "{error}");
    let none = read(&scene(1, 1.0, &[])).unwrap_err().to_string();
    assert!(none.contains("there is no take"), "{none}");
    // A take of a century: its frames are not even counted out.
    let long = text.replace(&SECOND.to_string(), &(SECOND * 100_000_000).to_string());
    let error = read(&long).unwrap_err().to_string();
    assert!(error.starts_with("take Walk: 3 joints in "), "{error}");
}

/// A record of a binary file that begins at a byte: name, properties, and children with the empty record behind them.
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
    // 2²⁶ numbers, packed into nothing.
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
