//! The captured body: where its joints are at rest, and how they turn in the clip.

use glam::{DQuat, DVec3};

use genga::motion::body::names::Found;
use genga::motion::body::names::bones::{Model, Side};
use genga::motion::{Body, Clip, JointId, Poser, Stature, local_translation};
use genga::time::Frame;

/// Maximum number of frames to sample; longer clips are sampled every second, third … frame.
const LOOKS: usize = 500;

/// Share of the body's size up to which a length counts as zero.
const NOTHING: f64 = 1e-9;

/// Share of frames in which the ankle may be lower than when standing, such as stumbles and errors.
const LOWER: f64 = 0.05;

/// The clip, as needed for retargeting.
pub(crate) struct Capture<'a> {
    clip: &'a Clip,
    model: &'a Model,
    found: &'a Found,
    /// Positions of the joints at rest, with no rotation.
    rest: Vec<DVec3>,
    /// World rotations and positions in the sampled frames.
    looks: Vec<(Vec<DQuat>, Vec<DVec3>)>,
}

impl<'a> Capture<'a> {
    pub(crate) fn new(clip: &'a Clip, model: &'a Model, found: &'a Found) -> Self {
        let skeleton = clip.skeleton();
        let mut rest: Vec<DVec3> = Vec::with_capacity(skeleton.len());
        for (_, joint) in skeleton.iter() {
            // Some files store bone lengths in position channels and have zero offsets.
            let from_parent = local_translation(joint, clip.row(clip.first()));
            let parent = joint.parent.map_or(DVec3::ZERO, |parent| rest[parent.0]);
            rest.push(if joint.parent.is_some() { parent + from_parent } else { DVec3::ZERO });
        }
        Self { clip, model, found, rest, looks: looks(clip) }
    }

    /// The axis that points up as the body stands, or as a person says.
    pub(crate) fn up(&self) -> DVec3 {
        Stature::new(self.clip).up.unit()
    }

    pub(crate) fn model(&self) -> &Model {
        self.model
    }

    /// The joint whose rotation is that of a bone: the outermost of the joints that drive it. Its world rotation
    /// includes the rotations of the inner ones.
    pub(crate) fn joint(&self, bone: usize) -> Option<JointId> {
        self.found.joints[bone].last().copied()
    }

    /// The joint at which a bone begins.
    pub(crate) fn begin(&self, name: &str) -> Option<JointId> {
        self.found.joints[self.model().find(name)?].first().copied()
    }

    fn sided(&self, side: Side, name: &str) -> Option<DVec3> {
        let bone = self.model().sided(side, name)?;
        self.found.joints[bone].first().map(|joint| self.rest[joint.0])
    }

    /// Direction of a bone in the axes of its joint; `None` if no child, End Site or mapped joint shows it.
    pub(crate) fn direction(&self, bone: usize) -> Option<DVec3> {
        let JointId(joint) = self.joint(bone)?;
        let next = self.next(bone).map(|next| self.found.joints[next].iter());
        let to = next.into_iter().flatten().map(|next| self.rest[next.0] - self.rest[joint]);
        let tip = || self.tip(joint);
        let least = NOTHING * self.extent();
        to.into_iter().find(|way| way.length() > least).or_else(tip)?.try_normalize()
    }

    /// The next driven bone along the same limb or along the spine.
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

    /// The vector to the first child or End Site of a joint that is not at the joint itself.
    fn tip(&self, joint: usize) -> Option<DVec3> {
        let least = NOTHING * self.extent();
        let skeleton = self.clip.skeleton();
        let children = skeleton.iter().filter(|(_, child)| child.parent == Some(JointId(joint)));
        let ways = children.map(|(JointId(child), _)| self.rest[child] - self.rest[joint]);
        let ends = skeleton.joints[joint].end_sites.iter().map(|end| end.offset);
        ways.chain(ends).find(|way| way.length() > least)
    }

    /// The vector from one joint to another at rest, in the file's axes.
    pub(crate) fn rest_way(&self, from: JointId, to: JointId) -> DVec3 {
        self.rest[to.0] - self.rest[from.0]
    }

    /// The vector from the legs' root to a joint at rest.
    pub(crate) fn over_legs(&self, joint: JointId) -> Option<DVec3> {
        Some(self.rest[joint.0] - self.leg_roots()?)
    }

    fn extent(&self) -> f64 {
        self.rest.iter().map(|place| place.length()).fold(0.0, f64::max)
    }

    /// The direction from right to left at rest, between the joints where the bones of that name begin.
    pub(crate) fn rest_across(&self, name: &str) -> Option<DVec3> {
        (self.sided(Side::Left, name)? - self.sided(Side::Right, name)?).try_normalize()
    }

    /// The direction from one bone of a side to another at rest.
    pub(crate) fn rest_span(&self, side: Side, from: &str, to: &str) -> Option<DVec3> {
        (self.sided(side, to)? - self.sided(side, from)?).try_normalize()
    }

    /// The direction from the legs, or the pelvis, to neck or head at rest.
    pub(crate) fn rest_up(&self) -> Option<DVec3> {
        let of = |name: &str| self.begin(name).map(|joint| self.rest[joint.0]);
        let top = ["首", "頭", "上半身2", "上半身"].into_iter().find_map(of)?;
        let legs = self.leg_roots().or_else(|| of("下半身"))?;
        (top - legs).try_normalize()
    }

    /// The midpoint of the two leg roots at rest.
    fn leg_roots(&self) -> Option<DVec3> {
        Some((self.sided(Side::Left, "足")? + self.sided(Side::Right, "足")?) / 2.0)
    }

    /// The direction from the pelvis to the first spine joint away from it, at rest.
    pub(crate) fn spine_way(&self) -> Option<DVec3> {
        let JointId(pelvis) = self.begin("下半身")?;
        let spine = self.model().find("上半身")?;
        let ways = self.found.joints[spine].iter();
        let least = NOTHING * self.extent();
        let mut ways = ways.map(|joint| self.rest[joint.0] - self.rest[pelvis]);
        ways.find(|way| way.length() > least)?.try_normalize()
    }

    /// The joint where upper and lower body meet: where the spine leaves the pelvis.
    pub(crate) fn waist(&self) -> Option<JointId> {
        self.begin("上半身").or_else(|| self.begin("センター"))
    }

    /// The vector from the legs' root to the waist at rest.
    pub(crate) fn waist_over_legs(&self) -> Option<DVec3> {
        self.over_legs(self.waist()?)
    }

    /// Length of a leg from its root to the ankle, averaged over both legs.
    pub(crate) fn leg(&self) -> Option<f64> {
        let leg = |side| {
            let [top, knee, ankle] = ["足", "ひざ", "足首"].map(|name| self.sided(side, name));
            Some((knee? - top?).length() + (ankle? - knee?).length())
        };
        let legs: Vec<f64> = Side::BOTH.into_iter().filter_map(leg).collect();
        let mean = legs.iter().sum::<f64>() / legs.len().max(1) as f64;
        (mean > 0.0).then_some(mean)
    }

    /// Height of the lower ankle when standing, after the rotation `up`: a low percentile over the clip.
    pub(crate) fn standing_ankle(&self, up: DQuat) -> Option<f64> {
        let ankles = Side::BOTH.into_iter().filter_map(|side| self.model().sided(side, "足首"));
        let ankles: Vec<JointId> = ankles.filter_map(|bone| self.joint(bone)).collect();
        let lower = self.looks.iter().map(|(_, places)| {
            ankles.iter().map(|ankle| (up * places[ankle.0]).y).fold(f64::INFINITY, f64::min)
        });
        let mut lower: Vec<f64> = lower.filter(|height| height.is_finite()).collect();
        lower.sort_by(f64::total_cmp);
        lower.get((LOWER * lower.len() as f64) as usize).copied()
    }

    /// Mean of a world direction, such as a knee's axis, in the axes of a joint; `None` if it is undefined for
    /// most of the clip.
    pub(crate) fn mean_local(
        &self,
        joint: JointId,
        direction: impl Fn(&[DQuat]) -> DVec3,
    ) -> Option<DVec3> {
        const LEAST: f64 = 0.02;
        let local = |(world, _): &(Vec<DQuat>, _)| world[joint.0].inverse() * direction(world);
        let mean = self.looks.iter().map(local).sum::<DVec3>() / self.looks.len().max(1) as f64;
        (mean.length() > LEAST).then(|| mean.normalize())
    }

    /// The median of a value over the sampled frames.
    pub(crate) fn median(&self, value: impl Fn(&[DQuat]) -> f64) -> f64 {
        let mut values: Vec<f64> = self.looks.iter().map(|(world, _)| value(world)).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or_default()
    }
}

fn looks(clip: &Clip) -> Vec<(Vec<DQuat>, Vec<DVec3>)> {
    let (mut poser, mut body) = (Poser::new(clip), Body::new(clip.skeleton()));
    let look = |frame| {
        body.place(poser.frame(Frame(frame)));
        (body.rotations().to_vec(), body.positions().to_vec())
    };
    let frames = clip.first().0..clip.first().0 + clip.len();
    frames.step_by(clip.len().div_ceil(LOOKS).max(1)).map(look).collect()
}
