//! The same body in all kinds of rest poses.

use glam::{DQuat, DVec3, EulerRot};

use super::super::{Vmd, VmdMotion};
use super::body::each_koma;
use genga::motion::bvh;
use genga::motion::{Clip, Joint, Skeleton, local_rotation, local_translation};
use genga::sheet::Sheet;
use genga::time::{Frame, FrameRate, KOMA_RATE};

pub(super) fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

/// Root position of the kicker standing with its waist, a centimetre behind the root, over the origin.
const WAIST_OVER_ORIGIN: DVec3 = DVec3::new(0.0, 92.5, 1.0);

/// The kicker in its rest pose, moved to a position.
pub(super) fn standing(at: DVec3) -> Clip {
    let skeleton = kick().skeleton().clone();
    let mut row = vec![0.0; skeleton.channels()];
    row[..3].copy_from_slice(&at.to_array());
    Clip::new(skeleton, FrameRate::new(24.0).unwrap(), Frame(0), 1, row).unwrap()
}

pub(super) fn on_ones(clip: &Clip, vmd: &Vmd) -> VmdMotion {
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    vmd.make(clip, &sheet).unwrap().motion
}

#[test]
fn a_t_pose_lifts_the_arms_by_their_angle_and_turns_nothing_else() {
    let half = (0.5f64 * 35.0).to_radians();
    for key in on_ones(&standing(WAIST_OVER_ORIGIN), &Vmd::default()).keys {
        let z = match &key.bone[..] {
            "左腕" => half.sin(),
            "右腕" => -half.sin(),
            _ => 0.0,
        };
        let should = [0.0, 0.0, z as f32, (1.0 - z * z).sqrt() as f32];
        let near = key.rotation.iter().zip(should).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near, "{}: {:?}", key.bone, key.rotation);
        assert!(key.translation.iter().all(|way| way.abs() < 1e-6), "{}", key.bone);
    }
}

#[test]
fn the_arm_angle_is_the_models() {
    let vmd = Vmd { arm_angle: 0.0, ..Vmd::default() };
    let keys = on_ones(&standing(DVec3::ZERO), &vmd).keys;
    assert!(keys.iter().all(|key| key.rotation[3] > 1.0 - 1e-6), "a T-pose for a T-pose");
}

/// A walking body still stands on the ground; only the waist's movement becomes translation.
#[test]
fn ways_are_scaled_by_the_leg_and_front_is_the_other_way() {
    let clip = kick();
    let rest = WAIST_OVER_ORIGIN;
    let mut rows = Vec::new();
    let leg = 80.5;
    for way in [DVec3::ZERO, DVec3::ZERO, DVec3::Y, DVec3::new(1.0, 0.0, 2.0)] {
        let mut row = vec![0.0; clip.skeleton().channels()];
        row[..3].copy_from_slice(&(rest + leg * way).to_array());
        rows.extend(row);
    }
    let skeleton = clip.skeleton().clone();
    let clip = Clip::new(skeleton, FrameRate::new(24.0).unwrap(), Frame(0), 4, rows).unwrap();
    let keys = on_ones(&clip, &Vmd { leg: 10.0, ..Vmd::default() }).keys;
    let ways = keys.iter().filter(|key| key.bone == "センター").map(|key| key.translation);
    let ways: Vec<_> = ways.collect();
    // At 30 frames per second, the second koma spans two frames, both keyed.
    for (way, should) in
        ways.iter().zip([[0.0; 3], [0.0; 3], [0.0; 3], [0.0, 10.0, 0.0], [10.0, 0.0, -20.0]])
    {
        assert!(way.iter().zip(should).all(|(a, b)| (a - b).abs() < 1e-5), "{ways:?}");
    }
}

/// The clip with other axes in every joint, and the same motion in the world. `turn` returns, for a joint, the rotation
/// from its new axes to its old ones.
fn rerigged(clip: &Clip, turn: impl Fn(&Skeleton, usize) -> DQuat, world: DQuat) -> Clip {
    let old = clip.skeleton();
    let turns: Vec<DQuat> = (0..old.len()).map(|joint| turn(old, joint)).collect();
    let of_parent = |joint: &Joint| joint.parent.map_or(world.inverse(), |parent| turns[parent.0]);
    let mut skeleton = old.clone();
    for (at, joint) in skeleton.joints.iter_mut().enumerate() {
        joint.offset = of_parent(&old.joints[at]).inverse() * joint.offset;
        joint.end_sites.iter_mut().for_each(|end| end.offset = turns[at].inverse() * end.offset);
    }
    let mut values = Vec::new();
    for row in clip.rows() {
        for (at, joint) in old.joints.iter().enumerate() {
            let parent = of_parent(joint).inverse();
            if joint.parent.is_none() {
                values.extend((parent * local_translation(joint, row)).to_array());
            }
            let rotation = parent * local_rotation(joint, row) * turns[at];
            let (z, x, y) = rotation.to_euler(EulerRot::ZXY);
            values.extend([z, x, y].map(f64::to_degrees));
        }
    }
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

/// The rotation from +X to the axis along which the bone lies at rest, as in LAFAN1; the pelvis keeps its axes.
fn along_x(skeleton: &Skeleton, joint: usize) -> DQuat {
    let child = skeleton.joints.iter().find(|child| child.parent.is_some_and(|p| p.0 == joint));
    let ends = &skeleton.joints[joint].end_sites;
    let way = child.map(|child| child.offset).or(ends.first().map(|end| end.offset)).unwrap();
    if joint == 0 {
        return DQuat::IDENTITY;
    }
    let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z];
    let axis = axes.into_iter().max_by(|a, b| a.dot(way).total_cmp(&b.dot(way))).unwrap();
    DQuat::from_rotation_arc(DVec3::X, axis) * DQuat::from_rotation_x(90f64.to_radians())
}

/// Maximum angle between two clips' poses of a bone, in degrees.
fn apart(a: &Clip, b: &Clip, bone: &str) -> f64 {
    let worlds = |clip: &Clip| {
        let found = std::cell::RefCell::new(Vec::new());
        each_koma(clip, &Vmd::default(), |_, model, _| found.borrow_mut().push(model.world(bone)));
        found.into_inner()
    };
    let both = worlds(a).into_iter().zip(worlds(b));
    let angle = |(a, b): (DQuat, DQuat)| 2.0 * a.dot(b).abs().min(1.0).acos().to_degrees();
    both.map(angle).fold(0.0, f64::max)
}

#[test]
fn a_rest_with_every_bone_along_one_axis_gives_the_same_body() {
    let clip = kick();
    let other = rerigged(&clip, along_x, DQuat::IDENTITY);
    let limbs = ["腕", "ひじ", "手首", "足", "ひざ"];
    let limbs = limbs.iter().flat_map(|limb| [format!("左{limb}"), format!("右{limb}")]);
    // The smallest angle that f32 resolves.
    limbs.for_each(|limb| assert!(apart(&clip, &other, &limb) < 0.1, "{limb}"));
    // The spine slants a little at rest, which a rest along an axis cannot show.
    for bone in ["下半身", "上半身", "上半身2", "首", "頭", "左肩", "右肩"] {
        assert!(apart(&clip, &other, bone) < 15.0, "{bone}: {}", apart(&clip, &other, bone));
    }
    for foot in ["左足首", "右足首"] {
        assert!(apart(&clip, &other, foot) < 15.0, "{foot}: {}", apart(&clip, &other, foot));
    }
}

#[test]
fn bones_along_one_axis_in_a_file_with_z_up_give_the_same_body() {
    let clip = kick();
    let z_up = DQuat::from_rotation_x(90f64.to_radians());
    let y = rerigged(&clip, along_x, DQuat::IDENTITY);
    let z = rerigged(&clip, along_x, z_up);
    for bone in ["下半身", "頭", "左腕", "右ひじ", "左足", "右足首"] {
        assert!(apart(&y, &z, bone) < 0.1, "{bone}: {}", apart(&y, &z, bone));
    }
}

/// A body without known legs, neither by name nor by movement, in a unit of which `in_a_metre` make a metre.
fn legless(in_a_metre: f64) -> Clip {
    let clip = standing(DVec3::ZERO);
    let mut skeleton = clip.skeleton().clone();
    let mut channels = 0;
    for joint in &mut skeleton.joints {
        joint.offset *= 0.01 * in_a_metre;
        if joint.name.contains("Leg") {
            joint.name = joint.name.replace("Leg", "Limb");
            joint.channels.clear();
        }
        joint.first_channel = channels;
        channels += joint.channels.len();
    }
    Clip::new(skeleton, clip.rate(), Frame(0), 1, vec![0.0; channels]).unwrap()
}

#[test]
fn without_legs_the_unit_is_guessed_by_the_size() {
    for in_a_metre in [1.0, 100.0, 1000.0] {
        let clip = legless(in_a_metre);
        let made = Vmd::default().make(&clip, &Sheet::on_ones(clip.clock(KOMA_RATE), 1)).unwrap();
        assert!(made.notes.iter().any(|note| note.code == "W_VMD_NO_LEGS"));
        assert!((made.report.scale * in_a_metre - 12.5).abs() < 1e-9, "{in_a_metre}");
    }
}

#[test]
fn a_rest_that_faces_elsewhere_or_stands_on_z_gives_the_same_body() {
    let clip = kick();
    let half_round = DQuat::from_rotation_y(180f64.to_radians());
    let turned = rerigged(&clip, |_, _| half_round, DQuat::IDENTITY);
    let z_up = DQuat::from_rotation_x(90f64.to_radians());
    let lying = rerigged(&clip, |_, _| z_up.inverse(), z_up);
    for other in [turned, lying] {
        for bone in ["下半身", "頭", "左腕", "右ひじ", "左足", "右足首"] {
            assert!(apart(&clip, &other, bone) < 0.1, "{bone}: {}", apart(&clip, &other, bone));
        }
    }
}
