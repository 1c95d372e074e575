//! Tests what a VMD holds beside the body: it goes in, and comes out in the sheet's time.

use super::super::{Vmd, VmdMade};
use super::rests::{kick, on_ones};
use crate::Curves;
use crate::timeline::Others;
use genga::motion::Clip;
use genga::sheet::{Blank, Exposure, Role, Sheet};
use genga_read::{Options, VmdBeside};

/// A morph's key: name, frame, weight.
const FACES: [(&str, u32, f32); 4] =
    [("あ", 0, 0.0), ("まばたき", 10, 1.0), ("あ", 30, 1.0), ("あ", 60, 0.25)];

/// A camera's key: frame, distance, x of its target, handles. The last two are a cut.
const CAMERA: [(u32, f32, f32, u8); 5] = [
    (0, -45.0, 0.0, 20),
    (30, -30.0, 5.0, 64),
    (60, -30.0, 9.0, 20),
    (61, -60.0, 0.0, 20),
    (90, -50.0, 0.0, 20),
];

/// A motion that MMD could have written, with keys of everything.
fn file() -> Vec<u8> {
    let motion = on_ones(&kick(), &Vmd::default());
    let bytes = motion.bytes().unwrap();
    let mut file = bytes[..54 + 111 * motion.keys.len()].to_vec();
    file.extend((FACES.len() as u32).to_le_bytes());
    for (name, frame, weight) in FACES {
        let mut field = encoding_rs::SHIFT_JIS.encode(name).0.into_owned();
        field.resize(15, 0);
        file.extend(field);
        file.extend(frame.to_le_bytes());
        file.extend(weight.to_le_bytes());
    }
    camera(&mut file);
    file.extend(1u32.to_le_bytes());
    file.extend(12u32.to_le_bytes());
    [0.5f32, 0.5, 0.5, -0.5, -1.0, 0.5].iter().for_each(|part| file.extend(part.to_le_bytes()));
    file.extend(1u32.to_le_bytes());
    file.extend([3, 0, 0, 0, 1]);
    file.extend(8.5f32.to_le_bytes());
    file.extend(2u32.to_le_bytes());
    for (frame, shown) in [(0u32, 0u8), (15, 1)] {
        file.extend(frame.to_le_bytes());
        file.push(shown);
        file.extend(0u32.to_le_bytes());
    }
    file
}

fn camera(file: &mut Vec<u8>) {
    file.extend((CAMERA.len() as u32).to_le_bytes());
    for (frame, distance, x, handle) in CAMERA {
        file.extend(frame.to_le_bytes());
        for number in [distance, x, 10.0, 0.0, 0.1, 0.2, 0.0] {
            file.extend(number.to_le_bytes());
        }
        file.extend([handle, 127 - handle, handle, 127 - handle].repeat(6));
        file.extend(30u32.to_le_bytes());
        file.push(0);
    }
}

fn read(bytes: &[u8]) -> Clip {
    Options::default().read(bytes).unwrap().clip
}

fn beside(clip: &Clip) -> &VmdBeside {
    clip.beside().unwrap().kept().unwrap()
}

fn made(sheet: &Sheet, vmd: &Vmd, clip: &Clip) -> VmdMade {
    vmd.make(clip, sheet).unwrap()
}

fn frames<T>(keys: &[T], frame: impl Fn(&T) -> u32) -> Vec<u32> {
    keys.iter().map(frame).collect()
}

#[test]
fn everything_is_written_as_it_was_where_the_time_is_kept() {
    let clip = read(&file());
    let sheet = Sheet::on_ones(clip.clock(30.0), clip.len());
    let made = made(&sheet, &Vmd::default(), &clip);
    let faces: Vec<(Vec<u8>, u32, f32)> =
        made.motion.faces.iter().map(|key| (key.name.clone(), key.frame, key.weight)).collect();
    let name = |name: &str| encoding_rs::SHIFT_JIS.encode(name).0.into_owned();
    let meant = FACES.map(|(own, frame, weight)| (name(own), frame, weight));
    assert_eq!(faces, meant);
    assert_eq!(made.motion.shown, [(0, false), (15, true)]);
    let camera = made.camera.unwrap();
    assert_eq!(camera.keys, beside(&clip).camera.keys, "with their curves");
    assert_eq!(camera.light, [(12, vec![0.5, 0.5, 0.5, -0.5, -1.0, 0.5])]);
    assert_eq!(camera.shadow, [(3, vec![1.0, 8.5])]);

    // Both files are read again.
    let again = read(&made.motion.bytes().unwrap());
    assert_eq!(beside(&again).faces, beside(&clip).faces);
    assert_eq!(beside(&again).shown, beside(&clip).shown);
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("camera.vmd");
    std::fs::write(&path, camera.bytes().unwrap()).unwrap();
    let options = Options { camera: Some(path), ..Options::default() };
    let both = options.read(&made.motion.bytes().unwrap()).unwrap().clip;
    assert_eq!(beside(&both), beside(&clip));
    assert_eq!(both.beside().unwrap().camera, clip.beside().unwrap().camera);
}

#[test]
fn blank_koma_come_first_and_a_cut_stays_a_cut_at_another_rate() {
    let clip = read(&file());
    let sheet = Sheet::on_ones(clip.clock(24.0), 74).with_blank(Blank { before: 24, after: 0 });
    let made = made(&sheet, &Vmd::default(), &clip);
    assert_eq!(frames(&made.motion.faces, |key| key.frame), [30, 40, 60, 90]);
    let camera = made.camera.unwrap().keys;
    assert_eq!(frames(&camera, |key| key.frame), [30, 60, 90, 91, 120]);

    let slow = Vmd { fps: 24.0, ..Vmd::default() };
    let sheet = Sheet::on_ones(clip.clock(24.0), 74);
    let camera = slow.make(&clip, &sheet).unwrap().camera.unwrap().keys;
    // Frame 61 of 30 a second is after frame 48 of 24, and there is no frame between.
    let at = |frame: u32| camera.iter().find(|key| key.frame == frame).map(|key| key.values[0]);
    assert_eq!(
        (at(48), at(49)),
        (Some(-30.0), Some(beside(&clip).camera.at(61.25).unwrap().values[0]))
    );
}

#[test]
fn what_is_left_out_of_the_take_is_left_out_of_the_face() {
    let clip = read(&file());
    let mut sheet = Sheet::on_ones(clip.clock(30.0), clip.len());
    sheet.layers[0].exposures.drain(..20);
    let made = made(&sheet, &Vmd::default(), &clip);
    // あ is two thirds open on the first koma, and open ten later.
    let weights: Vec<(u32, f32)> = made
        .motion
        .faces
        .iter()
        .filter(|key| key.name.len() == 2)
        .map(|key| (key.frame, key.weight))
        .collect();
    assert_eq!((weights[0].0, weights[1]), (0, (10, 1.0)));
    assert!((weights[0].1 - 2.0 / 3.0).abs() < 1e-6, "{weights:?}");
    let camera = made.camera.unwrap().keys;
    assert_eq!(camera[0].values, beside(&clip).camera.at(20.0).unwrap().values);
}

#[test]
fn stepped_faces_stay_and_jump() {
    let clip = read(&file());
    let mut sheet = Sheet::on_ones(clip.clock(30.0), clip.len());
    let koma = |drawing| Exposure { drawing, koma: 3 };
    sheet.layers[0].exposures = (0..clip.len() - 3).step_by(3).map(koma).collect();
    let vmd = Vmd { others: Others::Step, ..Vmd::default() };
    let made = made(&sheet, &vmd, &clip);
    let weight = |frame: u32| {
        let mut own = made.motion.faces.iter().filter(|key| key.name.len() == 2);
        own.find(|key| key.frame == frame).map(|key| key.weight)
    };
    let share = |frame: f32| Some(frame / 30.0);
    assert_eq!((weight(12), weight(14), weight(15)), (share(12.0), share(12.0), share(15.0)));
    let own: Vec<f32> =
        made.motion.faces.iter().filter(|key| key.name.len() == 2).map(|key| key.weight).collect();
    assert!(own.windows(3).all(|keys| keys[0] != keys[1] || keys[1] != keys[2]), "{own:?}");
    let camera = made.camera.unwrap().keys;
    let x = |frame: u32| camera.iter().rfind(|key| key.frame <= frame).unwrap().values[1];
    assert!(x(13) == x(12) && x(15) > x(12));
}

#[test]
fn keys_with_curves_take_face_and_camera_along() {
    let clip = read(&file());
    let mut sheet = Sheet::on_ones(clip.clock(30.0), clip.len());
    for at in [0, 60, clip.len() - 1] {
        sheet.layers[0].drawings[at].role = Role::Genga;
    }
    let made = Vmd::default().make_keys(&clip, &sheet, &Curves::default()).unwrap();
    assert_eq!(frames(&made.motion.faces, |key| key.frame), [0, 10, 30, 60]);
    assert_eq!(made.camera.unwrap().keys, beside(&clip).camera.keys);
}

#[test]
fn a_camera_alone_is_no_motion_and_is_found_missing_where_it_is_asked_for() {
    let clip = read(&file());
    let camera =
        made(&Sheet::on_ones(clip.clock(30.0), 90), &Vmd::default(), &clip).camera.unwrap();
    let error = Options::default().read(&camera.bytes().unwrap()).unwrap_err().to_string();
    assert!(error.contains("--camera-work"), "{error}");
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("motion.vmd");
    let motion = on_ones(&kick(), &Vmd::default()).bytes().unwrap();
    std::fs::write(&path, &motion).unwrap();
    let options = Options { camera: Some(path), ..Options::default() };
    let error = options.read(&motion).unwrap_err().to_string();
    assert!(error.contains("motion.vmd") && error.contains("no key of the camera"), "{error}");
}
