//! One motion has one set of keys: they follow the motion and not the rig, the rate or the noise.

use std::path::PathBuf;

use genga::edits::Edits;
use genga::keys::{AtGaits, Matching};
use genga::motion::{Clip, EndSite, Joint, JointId, Landmarks, Skeleton};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, FrameRate};
use genga_lab::study::Noise;
use glam::DVec3;

use crate::clips;
use crate::rerig::Rerig;

/// Hundredths of a koma: fine enough to compare keys of clips with different rates.
const FINE: f64 = 100.0;

/// Positions of the default recipe's keys at a price, in hundredths of a koma.
fn keys(clip: &Clip, min_price: f64) -> Vec<Frame> {
    let mut recipe = Recipe::default();
    recipe.keys.min_price = min_price;
    // Only the choice of keys: gaits come after it, and may be found or not.
    recipe.keys.gaits = AtGaits::Off;
    let mut engine = Engine::new(clip.clone()).unwrap();
    let layer = engine.find_keys(&recipe, &Edits::default()).unwrap().keys;
    let fine = |frame: Frame| FINE * (frame.0 - clip.first().0) as f64 * 24.0 / clip.rate().fps();
    layer.keys.iter().map(|key| Frame(fine(key.frame).round() as usize)).collect()
}

/// Agreement of the keys of two clips within a koma (F1), over their common frames. The first frame numbers align clips
/// cut from one take.
fn agreement(clip: &Clip, other: &Clip) -> f64 {
    let [one, two] = [clip, other].map(|clip| keys(clip, Recipe::default().keys.min_price));
    let later = other.first().0.saturating_sub(clip.first().0) as f64 / clip.rate().fps();
    let later = (FINE * 24.0 * later).round() as usize;
    let one: Vec<Frame> = one.into_iter().filter(|key| key.0 >= later).collect();
    let two: Vec<Frame> = two.iter().map(|key| Frame(key.0 + later)).collect();
    Matching::between(&one, &two, FINE + 1.0).kept()
}

/// Checks the mean agreement of the keys of real clips with those of clips made from them. On failure, the message
/// names the clips that agree least.
fn agree_on_real_clips(least: f64, other: impl Fn(&Clip) -> Clip) {
    clips::with_all(|paths| {
        let found = |path: &PathBuf| {
            let clip = clips::read(path);
            (agreement(&clip, &other(&clip)), clips::name(path))
        };
        let mut found: Vec<_> = paths.iter().map(found).collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mean = found.iter().map(|(share, _)| share).sum::<f64>() / found.len() as f64;
        assert!(mean >= least, "{mean:.3}: {:?}", &found[..4.min(found.len())]);
    });
}

/// Least mean agreement over all clips: at half the rate, under noise, and after a cut.
const LEAST: [f64; 3] = [0.97, 0.96, 0.97];

#[test]
fn the_same_take_in_two_rigs_has_the_same_keys() {
    clips::with(["cmu-05_11-dance-pirouette", "threejs-pirouette"], |paths| {
        let [one, other] = paths.map(|path| clips::read(&path));
        two_rigs_have_the_same_keys(&one, &other);
    });
}

fn two_rigs_have_the_same_keys(one: &Clip, other: &Clip) {
    // Both were cut from one take and share its frame numbers.
    let later = FINE * (other.first().0 - one.first().0) as f64 * 24.0 / one.rate().fps();
    let agreement = |price: f64| {
        let shift = |frame: &Frame| Frame(frame.0 + later.round() as usize);
        let of_other: Vec<Frame> = keys(other, price).iter().map(shift).collect();
        Matching::between(&keys(one, price), &of_other, FINE + 1.0).kept()
    };
    let prices = [6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0];
    let all = prices.map(agreement);
    assert!(all.iter().all(|share| *share > 0.75), "{all:?}");
    assert!(all.iter().sum::<f64>() / prices.len() as f64 >= 0.88, "{all:?}");
    assert!(agreement(Recipe::default().keys.min_price) >= 0.88, "{all:?}");
}

#[test]
fn joints_more_on_every_bone_change_no_key() {
    agree_on_real_clips(0.99, |clip| with_joints(clip, &Halves));
}

#[test]
fn fingers_move_few_keys() {
    agree_on_real_clips(0.9, |clip| with_joints(clip, &Fingers::new(clip)));
}

#[test]
fn another_rest_pose_order_and_unit_move_no_key() {
    let rerig = Rerig { first_order: 4, other_axes: true, scale: 2.54 };
    agree_on_real_clips(1.0, |clip| rerig.apply(clip));
}

#[test]
fn another_rate_moves_few_keys() {
    agree_on_real_clips(LEAST[0], every_other_frame);
}

#[test]
fn a_third_of_a_second_less_moves_few_keys() {
    agree_on_real_clips(LEAST[2], |clip| {
        let begin = clip.first().0 + (clip.rate().fps() / 3.0).round() as usize;
        clip.clone().trimmed(Frame(begin), Frame(clip.first().0 + clip.len())).unwrap()
    });
}

#[test]
fn a_little_noise_moves_few_keys() {
    agree_on_real_clips(LEAST[1], |clip| Noise { degrees: 0.1, seed: 1 }.on(clip));
}

/// The clip at half its rate, or unchanged if that would be less than a frame per koma.
pub(crate) fn every_other_frame(clip: &Clip) -> Clip {
    let fps = clip.rate().fps() / 2.0;
    if fps < 24.0 {
        return clip.clone();
    }
    let rows: Vec<f64> = clip.rows().step_by(2).flatten().copied().collect();
    let rate = FrameRate::new(fps).unwrap();
    Clip::new(clip.skeleton().clone(), rate, Frame(0), clip.len().div_ceil(2), rows).unwrap()
}

/// Extra joints without channels in another rig of the same body.
trait More {
    /// Whether the bone that ends at this joint is split by a joint in its middle.
    fn halves(&self, joint: JointId) -> bool;
    /// Extra chains of bones that hang on a joint, from the joint on.
    fn hang(&self, joint: JointId) -> Vec<[DVec3; 3]>;
}

struct Halves;

impl More for Halves {
    fn halves(&self, _: JointId) -> bool {
        true
    }

    fn hang(&self, _: JointId) -> Vec<[DVec3; 3]> {
        vec![]
    }
}

/// Four fingers and a thumb on each hand.
struct Fingers {
    wrists: Vec<JointId>,
    length: f64,
}

impl Fingers {
    fn new(clip: &Clip) -> Self {
        let landmarks = Landmarks::new(clip);
        let wrists = landmarks.wrists.iter().map(|wrist| wrist.joint).collect();
        Self { wrists, length: 0.03 * landmarks.height }
    }
}

impl More for Fingers {
    fn halves(&self, _: JointId) -> bool {
        false
    }

    fn hang(&self, joint: JointId) -> Vec<[DVec3; 3]> {
        if !self.wrists.contains(&joint) {
            return vec![];
        }
        let finger = |at: i32| {
            let spread = DVec3::new(f64::from(at - 2), 0.3 * f64::from(at), 1.0);
            [1.5, 1.0, 0.8].map(|bone| self.length * bone * spread.normalize())
        };
        (0..5).map(finger).collect()
    }
}

/// Converts the clip to a rig with more joints; the others move as before.
fn with_joints(clip: &Clip, more: &impl More) -> Clip {
    let mut joints: Vec<Joint> = Vec::new();
    let mut places = Vec::new();
    let channels = clip.skeleton().channels();
    let still = |parent: usize, offset: DVec3| Joint {
        name: format!("more.{parent}"),
        parent: Some(JointId(parent)),
        offset,
        channels: vec![],
        first_channel: channels,
        end_sites: vec![],
    };
    for (id, joint) in clip.skeleton().iter() {
        let mut joint = joint.clone();
        let is_still = joint
            .channels
            .iter()
            .all(|channel| !matches!(channel, genga::motion::Channel::Position(_)));
        joint.parent = joint.parent.map(|parent| JointId(places[parent.0]));
        if let Some(parent) = joint.parent
            && more.halves(id)
            && is_still
        {
            joints.push(still(parent.0, joint.offset / 2.0));
            joint.parent = Some(JointId(joints.len() - 1));
            joint.offset /= 2.0;
        }
        joints.push(joint);
        places.push(joints.len() - 1);
        for [knuckle, middle, tip] in more.hang(id) {
            joints.push(still(places[id.0], knuckle));
            joints.push(still(joints.len() - 1, middle));
            let finger = joints.last_mut().unwrap();
            finger.end_sites.push(EndSite { name: "Site".into(), offset: tip });
        }
    }
    let values = clip.rows().flatten().copied().collect();
    Clip::new(Skeleton { joints }, clip.rate(), clip.first(), clip.len(), values).unwrap()
}
