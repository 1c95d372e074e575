//! The oracle: legs are brought to the IK bones of a file by a solver of its own, which turns the knee about its X axis
//! until the foot is as far from the hip as its IK bone.

use std::collections::HashMap;

use glam::{DQuat, DVec3};

use super::super::{MmdModel, Vmd, VmdKey, VmdMotion};
use super::body::clips;
use super::given::{given, written};
use super::reader::read;
use super::rests::kick;
use crate::curves::Curves;
use genga::edits::Edits;
use genga::motion::{Clip, Stature};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;

const MIRROR: DVec3 = DVec3::new(1.0, 1.0, -1.0);

/// A model on one frame of a file, in MMD's axes.
struct Played<'a> {
    body: &'a MmdModel,
    bones: &'a HashMap<&'a str, Vec<&'a VmdKey>>,
    frame: u32,
}

/// Height of a Bézier curve at a share of the time, by halving.
fn eased([x1, y1, x2, y2]: [u8; 4], time: f64) -> f64 {
    let at = |t: f64, one: u8, two: u8| {
        let [one, two] = [one, two].map(|byte| f64::from(byte) / 127.0);
        3.0 * (1.0 - t).powi(2) * t * one + 3.0 * (1.0 - t) * t * t * two + t.powi(3)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        *(if at(middle, x1, x2) < time { &mut low } else { &mut high }) = middle;
    }
    at(low, y1, y2)
}

impl Played<'_> {
    fn local(&self, bone: &str) -> (DVec3, DQuat) {
        let Some(keys) = self.bones.get(bone) else { return (DVec3::ZERO, DQuat::IDENTITY) };
        let pose = |key: &VmdKey| {
            (
                DVec3::from_array(key.translation.map(f64::from)),
                DQuat::from_array(key.rotation.map(f64::from)),
            )
        };
        let next = keys.partition_point(|key| key.frame <= self.frame);
        let ((from, turn), Some(to)) = (pose(keys[next - 1]), keys.get(next)) else {
            return pose(keys[next - 1]);
        };
        let (first, last) = (keys[next - 1].frame, to.frame);
        let time = f64::from(self.frame - first) / f64::from(last - first);
        let [x, y, z, turned] = to.curves.map(|curve| eased(curve, time));
        let (place, wanted) = pose(to);
        (from + DVec3::new(x, y, z) * (place - from), turn.slerp(wanted, turned))
    }

    /// Rotation and place of a bone that no IK turns.
    fn world(&self, bone: &str) -> (DQuat, DVec3) {
        let mut chain: Vec<&str> = self.body.above(self.body.find(bone).unwrap()).collect();
        chain.insert(0, bone);
        let mut before = DVec3::ZERO;
        let (mut turn, mut place) = (DQuat::IDENTITY, DVec3::ZERO);
        for bone in chain.into_iter().rev() {
            let rest = MIRROR * self.body.place(bone).unwrap();
            let (moved, turned) = self.local(bone);
            place += turn * (rest - before + moved);
            turn *= turned;
            before = rest;
        }
        (turn, place)
    }

    /// Places of knee and ankle, and the rotation of the foot, as IK brings them.
    fn brought(&self, side: &str) -> ([DVec3; 2], DQuat) {
        let named = |bone: &str| format!("{side}{bone}");
        let way = |from: &str, to: &str| MIRROR * self.body.way(&named(from), &named(to)).unwrap();
        let (thigh, shin) = (way("足", "ひざ"), way("ひざ", "足首"));
        let (hip, at) = self.world(&named("足"));
        let target = self.world(&named("足ＩＫ")).1;
        let bent = |angle: f64| thigh + DQuat::from_rotation_x(-angle) * shin;
        // From the angle at which the leg is longest, its length falls.
        let slant = |bone: DVec3| bone.z.atan2(-bone.y);
        let (mut straight, mut folded) = (slant(thigh) - slant(shin), 3.1);
        for _ in 0..60 {
            let middle = 0.5 * (straight + folded);
            let is_far = bent(middle).length() > at.distance(target);
            *(if is_far { &mut straight } else { &mut folded }) = middle;
        }
        let knee = DQuat::from_rotation_x(-straight);
        let reached = hip * bent(straight);
        let swing = DQuat::from_rotation_arc(reached.normalize(), (target - at).normalize());
        let ankle = at + swing * reached;
        let mut foot = swing * hip * knee * self.local(&named("足首")).1;
        if let Some(ik) = self.body.find(&named("つま先ＩＫ")).map(|_| named("つま先ＩＫ"))
        {
            let toes = foot * way("足首", "つま先ＩＫ");
            let wanted = self.world(&ik).1 - ankle;
            foot = DQuat::from_rotation_arc(toes.normalize(), wanted.normalize()) * foot;
        }
        ([at + swing * hip * thigh, ankle], foot)
    }
}

fn bones(motion: &VmdMotion) -> HashMap<&str, Vec<&VmdKey>> {
    let mut bones: HashMap<&str, Vec<&VmdKey>> = HashMap::new();
    motion.keys.iter().for_each(|key| bones.entry(&key.bone).or_default().push(key));
    bones
}

fn sheet(clip: &Clip) -> Sheet {
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.run(&Recipe::default(), &Edits::default()).unwrap().sheet.clone()
}

/// The largest distances of ankles, of knees and of the skin about feet from the take, as shares of body height.
fn furthest(clip: &Clip, vmd: &Vmd, error: f64) -> [f64; 3] {
    let made = vmd.make_keys(clip, &sheet(clip), &Curves { error }).unwrap();
    let keyed = read(&made.motion.bytes().unwrap()).motion;
    assert!(keyed.ik_on.len() >= 2 && keyed.ik_off.is_empty(), "{:?}", keyed.ik_off);
    let last = keyed.keys.last().unwrap().frame;
    let ones = Sheet::on_ones(clip.clock(30.0), last as usize + 1);
    let taken = vmd.make(clip, &ones).unwrap();
    let unit = 1.0 / (taken.report.scale * Stature::new(clip).size);
    let (taken, usual) = (read(&taken.motion.bytes().unwrap()).motion, MmdModel::usual());
    let body = vmd.body.as_ref().unwrap_or(&usual);
    let [keyed, taken] = [&keyed, &taken].map(bones);
    let mut most = [0.0; 3];
    for frame in 0..=last {
        let made = Played { body, bones: &keyed, frame };
        let take = Played { body, bones: &taken, frame };
        for side in ["左", "右"] {
            let ([knee, ankle], foot) = made.brought(side);
            let [(hip, top), (_, middle), (turn, wanted)] =
                ["足", "ひざ", "足首"].map(|bone| take.world(&format!("{side}{bone}")));
            // MMD bends no knee to the front, as some captures do a little.
            let is_over = (hip * DVec3::X).dot((middle - top).cross(wanted - middle)) > 0.0;
            let off = [
                unit * ankle.distance(wanted),
                if is_over { 0.0 } else { unit * knee.distance(middle) },
                0.05 * foot.angle_between(turn),
            ];
            for (most, off) in most.iter_mut().zip(off) {
                *most = f64::max(*most, off);
            }
        }
    }
    most
}

#[test]
fn legs_are_where_the_take_has_them() {
    for (name, clip) in clips().into_iter().filter(|(_, clip)| clip.len() < 1200) {
        for (kind, vmd) in [("usual", Vmd::default()), ("given", given(&written()))] {
            let off = furthest(&clip, &vmd, 0.01);
            assert!(off.iter().all(|off| *off <= 0.01), "{name} on the {kind} body: {off:?}");
        }
    }
}

#[test]
fn ik_bones_may_hang_on_any_bone() {
    let mut written = written();
    let find = |bones: &[(&str, Option<usize>, [f32; 3])], name: &str| {
        bones.iter().position(|(bone, ..)| *bone == name).unwrap()
    };
    let center = find(&written.bones, "センター");
    for (side, foot, toes, ankle) in
        [(1.0, "左足ＩＫ", "左つま先ＩＫ", "左足首"), (-1.0, "右足ＩＫ", "右つま先ＩＫ", "右足首")]
    {
        let at = find(&written.bones, foot);
        written.bones[at].1 = Some(center);
        written.ik.push((written.bones.len(), vec![find(&written.bones, ankle)]));
        written.bones.push((toes, Some(0), [1.2 * side, 0.3, -1.2]));
    }
    let off = furthest(&kick(), &given(&written), 0.01);
    assert!(off.iter().all(|off| *off <= 0.01), "{off:?}");
}

#[test]
fn a_leg_that_no_ik_can_bring_keeps_its_own_keys() {
    let mut written = written();
    for (bone, ..) in &mut written.bones {
        match *bone {
            "左足ＩＫ" => *bone = "名前の長い左足ＩＫ",
            "右足ＩＫ" => *bone = "右足IK",
            _ => {}
        }
    }
    let made = given(&written).make_keys(&kick(), &sheet(&kick()), &Curves::default());
    let made = made.unwrap();
    let is_keyed = |bone: &str| made.motion.keys.iter().any(|key| key.bone == bone);
    assert!(is_keyed("左ひざ") && is_keyed("右足IK") && !is_keyed("右ひざ"));
    assert_eq!(made.motion.ik_on, ["右足IK"]);
    assert_eq!(made.motion.ik_off, ["名前の長い左足ＩＫ"]);
    let note = made.notes.iter().find(|note| note.code == "W_VMD_IK").unwrap();
    assert!(note.message.starts_with("keys-vmd: 右足IK have keys and are on"), "{note:?}");
}
