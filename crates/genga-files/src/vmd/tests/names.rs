//! Tests the table of dialects by the mapping of real clips' joints.

use crate::sample;
use crate::{Vmd, VmdBones};
use genga::motion::bvh;
use genga::sheet::Sheet;

#[test]
fn every_clip_speaks_a_dialect_and_what_is_left_out_is_told() {
    let fingers = "LeftFingerBase, LeftHandIndex1, LThumb";
    let expected = [
        (
            "cmu-131",
            "biped",
            20,
            "LeftToe, RightToe, lhand, LFingers, LThumb, rhand, RFingers, RThumb",
        ),
        ("cmu-135", "poser", 40, "leftEye, rightEye"),
        ("cmu-10", "poser", 40, "leftEye, rightEye"),
        ("cmu-11", "poser", 40, "leftEye, rightEye"),
        ("threejs", "poser", 40, "leftEye, rightEye"),
        ("optitrack", "biped", 19, ""),
        ("rokoko", "perception-neuron", 50, "LeftToeBase, RightToeBase"),
        ("cmu", "mixamo", 22, fingers),
    ];
    for (name, bytes) in sample::real_clips() {
        let clip = bvh::read(&bytes).unwrap().clip;
        let sheet = Sheet::on_ones(clip.clock(24.0), 1);
        let vmd = Vmd { bones: VmdBones::Semi, ..Vmd::default() };
        let made = vmd.make(&clip, &sheet).unwrap();
        let (_, dialect, bones, _) =
            expected.iter().find(|(begin, ..)| name.starts_with(begin)).unwrap();
        assert_eq!(made.report.dialect, *dialect, "{name}");
        assert_eq!(made.report.bones.len(), *bones, "{name}: {:?}", made.report);
        assert_eq!(made.notes, vmd.notes(&clip, &sheet).unwrap(), "{name}");
        let told = made.notes.iter().find(|note| note.code == "W_VMD_LEFT_OUT");
        assert_eq!(told.is_some(), !made.report.left_out.is_empty(), "{name}");
        for joint in &made.report.left_out {
            assert!(told.unwrap().message.contains(joint), "{name}: {joint}");
        }
        let used = made.report.bones.iter().flat_map(|(_, joints)| joints);
        let mut all: Vec<&String> =
            used.chain(&made.report.carried).chain(&made.report.left_out).collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), clip.skeleton().len(), "{name}: a joint is nowhere");
    }
}
