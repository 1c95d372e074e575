//! What a capture shows of its own body: where joints stand at rest, and how they turn in the clip.

use glam::{DQuat, DVec3};

use crate::motion::body::names::Found;
use crate::motion::body::names::bones::{Model, Side};
use crate::motion::{Body, Clip, JointId, Poser, Stature, local_translation};
use crate::time::Frame;

/// Frames that are looked at; of longer clips every second, third … one.
const LOOKS: usize = 500;

/// A length of this share of the body and less is none.
const NOTHING: f64 = 1e-9;

/// The share of frames in which an ankle may be lower than where it stands: a stumble, an error.
const LOWER: f64 = 0.05;

/// The clip as the retargeting sees it.
pub(super) struct Capture<'a> {
    clip: &'a Clip,
    model: &'a Model,
    found: &'a Found,
    /// Where joints stand when none is turned.
    rest: Vec<DVec3>,
    /// World rotations and positions of the frames that are looked at.
    looks: Vec<(Vec<DQuat>, Vec<DVec3>)>,
}

impl<'a> Capture<'a> {
    pub(super) fn of(clip: &'a Clip, model: &'a Model, found: &'a Found) -> Self {
        let skeleton = clip.skeleton();
        let mut rest: Vec<DVec3> = Vec::with_capacity(skeleton.len());
        for (_, joint) in skeleton.iter() {
            // Some files keep their bones in position channels, with offsets of nothing.
            let from_parent = local_translation(joint, clip.row(clip.first()));
            let parent = joint.parent.map_or(DVec3::ZERO, |parent| rest[parent.0]);
            rest.push(if joint.parent.is_some() { parent + from_parent } else { DVec3::ZERO });
        }
        Self { clip, model, found, rest, looks: looks(clip) }
    }

    /// Up in the file, for a rest that does not show it.
    pub(super) fn up(&self) -> DVec3 {
        Stature::of(self.clip).up.unit()
    }

    pub(super) fn model(&self) -> &Model {
        self.model
    }

    /// The joint whose turning is a bone's: the outermost of those that make it, which carries what
    /// the others and all joints between turn.
    pub(super) fn joint(&self, bone: usize) -> Option<JointId> {
        self.found.joints[bone].last().copied()
    }

    /// The joint where a bone begins.
    pub(super) fn begin(&self, name: &str) -> Option<JointId> {
        self.found.joints[self.model().find(name)?].first().copied()
    }

    fn sided(&self, side: Side, name: &str) -> Option<DVec3> {
        let bone = self.model().sided(side, name)?;
        self.found.joints[bone].first().map(|joint| self.rest[joint.0])
    }

    /// Where a bone points, in the axes of its joint; none when the file does not say.
    pub(super) fn direction(&self, bone: usize) -> Option<DVec3> {
        let JointId(joint) = self.joint(bone)?;
        let next = self.next(bone).map(|next| self.found.joints[next].iter());
        let to = next.into_iter().flatten().map(|next| self.rest[next.0] - self.rest[joint]);
        let tip = || self.tip(joint);
        let least = NOTHING * self.extent();
        to.into_iter().find(|way| way.length() > least).or_else(tip)?.try_normalize()
    }

    /// The bone that goes on from a bone, where one is driven.
    fn next(&self, bone: usize) -> Option<usize> {
        const LINES: [&[&str]; 4] = [
            &["上半身", "上半身2", "首", "頭"],
            &["肩", "腕", "ひじ", "手首", "中指１", "中指２", "中指３"],
            &["手首", "人指１", "人指２", "人指３"],
            &["足", "ひざ", "足首"],
        ];
        let name = &self.model().bones[bone].name;
        let side = Side::BOTH.into_iter().find(|side| name.starts_with(side.word()));
        let stem = side.map_or(&name[..], |side| &name[side.word().len()..]);
        LINES.iter().find_map(|line| {
            let at = line.iter().position(|other| *other == stem)?;
            line[at + 1..].iter().find_map(|next| {
                let next = match side {
                    Some(side) => self.model().sided(side, next)?,
                    None => self.model().find(next)?,
                };
                self.joint(next).map(|_| next)
            })
        })
    }

    /// The way to the first thing that hangs on a joint and is not where the joint is.
    fn tip(&self, joint: usize) -> Option<DVec3> {
        let least = NOTHING * self.extent();
        let skeleton = self.clip.skeleton();
        let children = skeleton.iter().filter(|(_, child)| child.parent == Some(JointId(joint)));
        let ways = children.map(|(JointId(child), _)| self.rest[child] - self.rest[joint]);
        let ends = skeleton.joints[joint].end_sites.iter().map(|end| end.offset);
        ways.chain(ends).find(|way| way.length() > least)
    }

    /// From one joint to another at rest, in the file's axes.
    pub(super) fn rest_way(&self, from: JointId, to: JointId) -> DVec3 {
        self.rest[to.0] - self.rest[from.0]
    }

    /// From the legs' beginning to a joint at rest.
    pub(super) fn over_legs(&self, joint: JointId) -> Option<DVec3> {
        Some(self.rest[joint.0] - self.leg_roots()?)
    }

    fn extent(&self) -> f64 {
        self.rest.iter().map(|place| place.length()).fold(0.0, f64::max)
    }

    /// From right to left at rest, between the joints where the bones of that name begin.
    pub(super) fn rest_across(&self, name: &str) -> Option<DVec3> {
        (self.sided(Side::Left, name)? - self.sided(Side::Right, name)?).try_normalize()
    }

    /// From one bone of a side to another at rest.
    pub(super) fn rest_span(&self, side: Side, from: &str, to: &str) -> Option<DVec3> {
        (self.sided(side, to)? - self.sided(side, from)?).try_normalize()
    }

    /// From the legs, or the pelvis, to neck or head at rest.
    pub(super) fn rest_up(&self) -> Option<DVec3> {
        let of = |name: &str| self.begin(name).map(|joint| self.rest[joint.0]);
        let top = ["首", "頭", "上半身2", "上半身"].into_iter().find_map(of)?;
        let legs = self.leg_roots().or_else(|| of("下半身"))?;
        (top - legs).try_normalize()
    }

    /// Midway between the legs where they begin, at rest.
    fn leg_roots(&self) -> Option<DVec3> {
        Some((self.sided(Side::Left, "足")? + self.sided(Side::Right, "足")?) / 2.0)
    }

    /// From the pelvis to where the spine leaves it, at rest.
    pub(super) fn spine_way(&self) -> Option<DVec3> {
        let JointId(pelvis) = self.begin("下半身")?;
        let spine = self.model().find("上半身")?;
        let ways = self.found.joints[spine].iter();
        let least = NOTHING * self.extent();
        let mut ways = ways.map(|joint| self.rest[joint.0] - self.rest[pelvis]);
        ways.find(|way| way.length() > least)?.try_normalize()
    }

    /// The joint that stands where upper and lower body meet: where the spine leaves the pelvis.
    pub(super) fn waist(&self) -> Option<JointId> {
        self.begin("上半身").or_else(|| self.begin("センター"))
    }

    /// From the legs' beginning to the waist at rest.
    pub(super) fn waist_over_legs(&self) -> Option<DVec3> {
        self.over_legs(self.waist()?)
    }

    /// The length of a leg from where it begins to the ankle, on average of both.
    pub(super) fn leg(&self) -> Option<f64> {
        let leg = |side| {
            let [top, knee, ankle] = ["足", "ひざ", "足首"].map(|name| self.sided(side, name));
            Some((knee? - top?).length() + (ankle? - knee?).length())
        };
        let legs: Vec<f64> = Side::BOTH.into_iter().filter_map(leg).collect();
        let mean = legs.iter().sum::<f64>() / legs.len().max(1) as f64;
        (mean > 0.0).then_some(mean)
    }

    /// How high the ankle of the standing leg mostly is at its lowest, after `up`.
    pub(super) fn standing_ankle(&self, up: DQuat) -> Option<f64> {
        let ankles = Side::BOTH.into_iter().filter_map(|side| self.model().sided(side, "足首"));
        let ankles: Vec<JointId> = ankles.filter_map(|bone| self.joint(bone)).collect();
        let lower = self.looks.iter().map(|(_, places)| {
            ankles.iter().map(|ankle| (up * places[ankle.0]).y).fold(f64::INFINITY, f64::min)
        });
        let mut lower: Vec<f64> = lower.filter(|height| height.is_finite()).collect();
        lower.sort_by(f64::total_cmp);
        lower.get((LOWER * lower.len() as f64) as usize).copied()
    }

    /// The mean of a direction of the world, such as the axis of a knee, in the axes of a joint; none
    /// when it points nowhere for most of the clip.
    pub(super) fn mean_local(
        &self,
        joint: JointId,
        direction: impl Fn(&[DQuat]) -> DVec3,
    ) -> Option<DVec3> {
        const LEAST: f64 = 0.02;
        let local = |(world, _): &(Vec<DQuat>, _)| world[joint.0].inverse() * direction(world);
        let mean = self.looks.iter().map(local).sum::<DVec3>() / self.looks.len().max(1) as f64;
        (mean.length() > LEAST).then(|| mean.normalize())
    }

    /// The median of a value over the clip.
    pub(super) fn median(&self, value: impl Fn(&[DQuat]) -> f64) -> f64 {
        let mut values: Vec<f64> = self.looks.iter().map(|(world, _)| value(world)).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or_default()
    }
}

fn looks(clip: &Clip) -> Vec<(Vec<DQuat>, Vec<DVec3>)> {
    let (mut poser, mut body) = (Poser::of(clip), Body::new(clip.skeleton()));
    let look = |frame| {
        body.place(poser.frame(Frame(frame)));
        (body.rotations().to_vec(), body.positions().to_vec())
    };
    let frames = clip.first().0..clip.first().0 + clip.len();
    frames.step_by(clip.len().div_ceil(LOOKS).max(1)).map(look).collect()
}
