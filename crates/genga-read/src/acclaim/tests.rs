use std::fs;
use std::path::Path;

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::asf::{Freedom, about, in_order};
use super::*;
use crate::real;
use genga::motion::bvh::warnings::FRAMES_MISMATCH;
use genga::motion::{Body, Clip, Poser};
use genga::time::Frame;

const SKELETON: &str = "\
# a leg and a half
:version 1.10
:name test
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
   begin the story
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name lhipjoint
     direction 0.6 -0.8 0
     length 2.5
     axis 0 0 0  XYZ
  end
  begin
     id 2
     name lfemur
     direction 0 -1 0
     length 7
     axis 10 -20 30  XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-60.0 70.0)
  end
  begin
     id 3
     name ltibia
     direction 0 -1 0.1
     length 8
     axis 0 0 20  XYZ
    dof rx
    limits (-10.0 170.0)
  end
:hierarchy
  begin
    root lhipjoint
    lhipjoint lfemur
    lfemur ltibia
  end
";

const MOTION: &str = "\
#!OML:ASF C:\\somewhere\\test.ASF
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 10 20 30
lfemur 5 -6e0 7
ltibia 40
2
root 1 2 4 15 25 35
ltibia 170
lfemur 179 0 0
";

fn both(skeleton: &str, motion: &str) -> Result<Read, Error> {
    let asf = Asf::read(skeleton)?;
    let amc = Amc::read(motion, &asf)?;
    joined(&asf, amc, "test.asf")
}

/// Start and end of each bone at a frame, computed independently with matrices, from the definition of the
/// format.
fn by_definition(asf: &Asf, values: &[f64]) -> Vec<(DVec3, DVec3)> {
    let mut values = values.iter();
    let mut turns: Vec<DQuat> = Vec::new();
    let mut places: Vec<(DVec3, DVec3)> = Vec::new();
    for bone in &asf.bones {
        let (mut moved, mut own) = (DVec3::ZERO, Vec::new());
        for freedom in &bone.freedoms {
            let value = *values.next().unwrap();
            match freedom {
                Freedom::Turn(axis) => own.push(about(*axis, value.to_radians())),
                Freedom::Move(axis) => moved += value * axis.unit(),
                Freedom::Length => {}
            }
        }
        let (before, from) = bone
            .parent
            .map_or((DQuat::IDENTITY, DVec3::ZERO), |parent| (turns[parent], places[parent].1));
        let turn = before * bone.axes * in_order(own.into_iter()) * bone.axes.inverse();
        let begin = from + moved;
        let end = if bone.parent.is_some() { begin + turn * bone.way } else { begin };
        turns.push(turn);
        places.push((begin, end));
    }
    places
}

fn positions(clip: &Clip, frame: usize) -> Vec<DVec3> {
    let mut body = Body::new(clip.skeleton());
    body.place(Poser::new(clip).frame(Frame(frame)));
    body.positions().to_vec()
}

#[test]
fn joints_stand_where_the_format_puts_bones() {
    let Read { clip, warnings, found, .. } = both(SKELETON, MOTION).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!((clip.first(), clip.len(), clip.rate().fps()), (Frame(1), 2, 120.0));
    let said: Vec<&str> = found.iter().map(|found| &found.is[..]).collect();
    assert_eq!(
        said[1..],
        [
            "1 is 0.0564 m, as CMU's",
            "120 frames a second, which the file does not say (--fps N for another)"
        ]
    );
    let asf = Asf::read(SKELETON).unwrap();
    let amc = Amc::read(MOTION, &asf).unwrap();
    assert_eq!(
        amc.values[10..20],
        [1.0, 2.0, 4.0, 15.0, 25.0, 35.0, 179.0, 0.0, 0.0, 170.0],
        "bones in any order"
    );
    for (row, values) in amc.values.chunks(10).enumerate() {
        let should = by_definition(&asf, values);
        for ((joint, place), (begin, end)) in
            positions(&clip, row + 1).into_iter().enumerate().zip(&should)
        {
            assert!(place.abs_diff_eq(*begin, 1e-9), "{joint}: {place} {begin}");
            assert!(joint == 0 || (*end - *begin).length() > 1.0);
        }
    }
    assert_eq!(
        clip.row(Frame(1))[..6],
        [1.0, 2.0, 3.0, 30.0, 20.0, 10.0],
        "the root's own numbers"
    );
    let tip = &clip.skeleton().joints[3].end_sites[0];
    assert!((tip.offset.length() - 8.0).abs() < 1e-12);
}

#[test]
fn a_right_angle_about_an_axis_of_the_bones_own_is_known_by_hand() {
    let skeleton = ":units\n angle deg\n:root\n order TX TY TZ RX RY RZ\n axis XYZ\n:bonedata\nbegin\nname a\ndirection 1 0 0\nlength 2\n\
                    axis 0 0 90 XYZ\ndof rx\nend\nbegin\nname b\ndirection 1 0 0\nlength 1\naxis 0 0 0 XYZ\nend\n:hierarchy\nbegin\nroot a\na b\nend\n";
    // The bone's X is the world's Y, so the bone turns from +X to −Z.
    let read = both(skeleton, ":DEGREES\n0\nroot 0 0 0 0 0 0\na 90\n").unwrap();
    let places = positions(&read.clip, 0);
    assert!(places[2].abs_diff_eq(DVec3::new(0.0, 0.0, -2.0), 1e-12), "{places:?}");
    let radians = both(skeleton, ":RADIANS\n0\nroot 0 0 0 0 0 0\na 1.5707963267948966\n").unwrap();
    assert!(positions(&radians.clip, 0)[2].abs_diff_eq(places[2], 1e-9));
    assert_eq!(read.clip.skeleton().joints[2].channels.len(), 0, "a bone that is not free");
}

#[test]
fn what_is_wrong_is_refused_at_its_place() {
    let said = |skeleton: &str, motion: &str| both(skeleton, motion).unwrap_err().to_string();
    let asf = |from: &str, to: &str| said(&SKELETON.replace(from, to), MOTION);
    let amc = |from: &str, to: &str| said(SKELETON, &MOTION.replacen(from, to, 1));
    assert!(
        asf("length 7", "length x").starts_with("27:13: expected a number, found \"x\""),
        "{}",
        asf("length 7", "length x")
    );
    assert!(asf("dof rx ry rz", "dof rx rq").starts_with("29:12: expected one of rx"));
    assert!(
        asf("lfemur ltibia", "lfemur lshin")
            .contains("expected a bone of :bonedata, found \"lshin\"")
    );
    assert!(asf("    lfemur ltibia\n", "").contains("ltibia does not hang on the root"));
    assert!(asf("name ltibia", "name lfemur").contains("there are two bones lfemur"));
    assert!(asf("angle deg", "angle gon").contains("expected deg or rad"));
    assert!(
        asf("    lfemur ltibia", "    lfemur ltibia ltibia").contains("hangs on something already")
    );
    assert!(
        amc("ltibia 40", "ltibia").starts_with("7:7: expected a number, found the end of the line"),
        "{}",
        amc("ltibia 40", "ltibia")
    );
    assert!(amc("ltibia 40", "ltibia 40 1").starts_with("7:11: expected the end of the line"));
    assert!(amc("ltibia 40", "ltibia nan").starts_with("7:8: expected a number, found \"nan\""));
    assert!(
        amc("ltibia 40\n", "").starts_with("4:1: this frame has 2 of 3 bones: it lacks ltibia")
    );
    assert!(amc("lfemur 5", "rfemur 5").starts_with("6:1: expected a bone of the skeleton"));
    assert!(amc("ltibia 40", "ltibia 40\nltibia 40").starts_with("8:1: ltibia is there twice"));
    assert!(said(SKELETON, ":DEGREES\n").starts_with("1:1: there is no frame"));
    assert!(said("", MOTION).contains("no bones"));
    let cut = both(SKELETON, &MOTION[..MOTION.len() - 15]).unwrap();
    assert_eq!(
        (cut.clip.len(), cut.warnings[0].code),
        (1, FRAMES_MISMATCH),
        "a frame that is not whole"
    );
    let jump = both(SKELETON, &MOTION.replace("\n2\n", "\n5\n")).unwrap();
    assert_eq!(jump.warnings[0].code, amc::NUMBERS);
}

proptest! {
    #[test]
    fn text_of_any_kind_is_read_or_refused(cut in 0usize..1200, at in 0usize..1200, byte in any::<u8>(), which in any::<bool>()) {
        let mut texts = [SKELETON.as_bytes().to_vec(), MOTION.as_bytes().to_vec()];
        let text = &mut texts[usize::from(which)];
        text.truncate(cut);
        if let Some(there) = text.get_mut(at) {
            *there = byte;
        }
        drop(both(&super::text(&texts[0]), &super::text(&texts[1])));
    }
}

#[test]
fn the_skeleton_is_found_by_its_name_or_because_it_is_alone() {
    let place = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(place.path().join(name), text).unwrap();
    put("02_05.amc", MOTION);
    let open = || crate::open(&place.path().join("02_05.amc"));
    let none = open().unwrap_err().to_string();
    assert!(none.starts_with("this motion needs its skeleton"), "{none}");
    put("rory.asf", SKELETON);
    assert_eq!(open().unwrap().clip.len(), 2, "it is alone");
    put("03.asf", "wrong");
    assert!(
        open()
            .unwrap_err()
            .to_string()
            .contains("which skeleton is this motion's: 03.asf, rory.asf")
    );
    put("02.ASF", SKELETON);
    let read = open().unwrap();
    assert!(read.warnings.last().unwrap().message.contains("with the skeleton 02.ASF"));
    put("02_05.asf", "");
    let wrong = open().unwrap_err().to_string();
    assert!(wrong.starts_with("02_05.asf:1:1: this skeleton has no bones"), "{wrong}");
    let skeleton = place.path().join("rory.asf");
    let alone = crate::open(&skeleton).unwrap_err().to_string();
    assert!(alone.contains("give the .amc of a take"), "{alone}");
    let options = Options { skeleton: Some(skeleton), ..Options::default() };
    assert!(options.open(&place.path().join("02_05.amc")).is_ok(), "named");
}

#[test]
fn markers_are_refused_in_a_sentence() {
    let trc =
        Options::default().read(b"PathFileType\t4\t(X/Y/Z)\twalk.trc\n").unwrap_err().to_string();
    let mut c3d = vec![2, 0x50];
    c3d.resize(512, 0);
    let c3d = Options::default().read(&c3d).unwrap_err().to_string();
    assert!(trc.starts_with("these are the paths of markers and no skeleton") && trc == c3d);
}

#[test]
fn what_is_no_motion_is_said_before_a_skeleton_is_asked_for() {
    let said = |bytes: &[u8]| {
        let path = Path::new("somewhere/walk.amc");
        let given = Given { bytes, path: Some(path) };
        read(&given, &Options::default()).unwrap_err().to_string()
    };
    assert_eq!(said(b"# nothing\n"), "1:1: there is no frame in this motion");
    let text = said(b"# a letter\n\n Dear all,\n");
    assert_eq!(
        text,
        "3:2: expected :FULLY-SPECIFIED or the number of the first frame, found \"Dear\""
    );
    assert!(said(b":DEGREES\n1\n").starts_with("this motion needs its skeleton"));
    assert!(said(b"1\nroot 0 0 0\n").starts_with("this motion needs its skeleton"));
}

/// Compares CMU's own take 05_11 with its BVH conversion. `GENGA_CMU` names a folder with `pirouette.amc`
/// and `pirouette.asf`.
#[test]
#[ignore = "needs files of CMU that are not ours to give"]
fn a_take_of_cmu_is_where_its_bvh_is() {
    let folder = std::env::var("GENGA_CMU").unwrap();
    let own = crate::open(&Path::new(&folder).join("pirouette.amc")).unwrap().clip;
    real::with(["cmu-05_11-dance-pirouette"], |[bvh]| is_where_its_bvh_is(&own, &bvh));
}

fn is_where_its_bvh_is(own: &Clip, bvh: &Path) {
    let bvh = crate::open(bvh).unwrap().clip.trimmed(Frame(1), Frame(592)).unwrap();
    assert_eq!((own.first(), own.len()), (bvh.first(), bvh.len()));
    // The BVH omits the length of the thorax below neck and arms, so these are compared relative to their
    // start.
    let pairs = [
        (["root", "ltibia"], ["Hips", "LeftLeg"]),
        (["root", "rfoot"], ["Hips", "RightFoot"]),
        (["root", "thorax"], ["Hips", "Spine1"]),
        (["lclavicle", "lwrist"], ["LeftShoulder", "LeftHand"]),
        (["rclavicle", "rradius"], ["RightShoulder", "RightForeArm"]),
        (["lowerneck", "head"], ["Neck", "Head"]),
    ];
    let way = |clip: &Clip, names: [&str; 2], frame| {
        let [from, to] =
            names.map(|name| positions(clip, frame)[clip.skeleton().find(name).unwrap().0]);
        to - from
    };
    let mut furthest: f64 = 0.0;
    for (amc, cgspeed) in pairs {
        for frame in (1..592).step_by(37) {
            furthest = furthest.max(way(own, amc, frame).distance(way(&bvh, cgspeed, frame)));
        }
    }
    assert!(furthest < 0.01, "{furthest}");
}
