//! The landmarks of a body (頭・手首・足首): head, wrists and ankles, found by name, or else by shape and motion.

use std::array;
use std::collections::BTreeSet;
use std::iter;

use glam::DVec3;

use crate::motion::body::limbs::NamedLimbs;
use crate::motion::clip::lane_poser::LanePoser;
use crate::motion::clip::rig::Rig;
use crate::motion::lanes::{LANES, LaneVec, pieces, wide};
use crate::motion::{Axis, Body, Build, Clip, Joint, JointId, Members, Skeleton};
use crate::time::{Clock, Frame};

/// Number of sampled frames: enough to know which limb is usually low.
const LOOKS: usize = 200;

/// Longest hand, foot or head, as a share of the body's height: a joint with a longer chain below it is not the end
/// of a limb. A complete hand is a ninth of the height, a forearm with its hand a quarter. Real files cut off toes
/// and fingers: their feet reach up to 0.152, their forearms down to 0.157.
const LONGEST_END: f64 = 0.154;

/// Shortest limb, from the root to its end, as a share of the body's height.
const SHORTEST_LIMB: f64 = 0.15;

/// A point attached to a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The joint.
    pub joint: JointId,
    /// Vector from the joint, in the joint's own axes and in the file's unit; 0 for the joint itself.
    pub offset: DVec3,
}

impl Point {
    pub(crate) fn new(joint: usize) -> Self {
        Self { joint: JointId(joint), offset: DVec3::ZERO }
    }

    /// Returns the world position of the point.
    pub fn position(&self, body: &Body) -> DVec3 {
        body.positions()[self.joint.0] + body.rotations()[self.joint.0] * self.offset
    }
}

/// A foot (足).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// Ankle, where the foot joins the leg.
    pub ankle: Point,
    /// Point of the foot that is lowest on average: the ball or the tip of the toes.
    pub sole: Point,
}

/// Head, wrists and ankles of a body, as far as it has them.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmarks {
    /// Head, or the neck if the head is short.
    pub head: Option<Point>,
    /// Zero to two wrists, in the order of the file.
    pub wrists: Vec<Point>,
    /// Zero to two feet, in the order of the file.
    pub feet: Vec<Foot>,
    /// Axis that points up.
    pub up: Axis,
    /// Height of the body in the file's unit: that of a person with legs of this length, hip to ankle divided by
    /// 0.48. For a body without limbs, the median over the frames of the longest side of its joints' bounding box.
    pub height: f64,
}

impl Landmarks {
    /// Finds the landmarks of a clip.
    ///
    /// [Names](crate::motion::BoneMap) give limbs and head if the named limbs are whole. Otherwise a limb ends at the
    /// first joint from the root that carries no more than 15 % of the body's height. The two ends that are lowest on
    /// average are the feet. Of the others, the two furthest from the root along the bones are the hands, however
    /// high they are held, and the highest of the rest is the head. A body with fewer than three ends has no
    /// landmarks. Trees other than the body's, such as a sword, are ignored.
    pub fn new(clip: &Clip) -> Self {
        Build::new(clip).landmarks
    }

    /// Finds the landmarks among the body's joints: named limbs first, the others by shape.
    pub(super) fn of_members(
        looks: &Looks,
        members: &Members,
        limbs: &NamedLimbs,
        up: Axis,
    ) -> Self {
        let skeleton = members.skeleton();
        let is_known = |joint: usize| limbs.take(skeleton, joint);
        let ends = ends(skeleton, looks.height).into_iter().filter(|end| !is_known(*end));
        let mut ends: Vec<usize> = ends.collect();
        let mut landmarks =
            Self { head: None, wrists: vec![], feet: vec![], up, height: looks.height };
        let [mut ankles, mut wrists] = [limbs.legs, limbs.arms].map(|limbs| {
            limbs.into_iter().flatten().map(|[_, _, lower]| lower).collect::<Vec<usize>>()
        });
        if ankles.len() + wrists.len() + usize::from(limbs.head.is_some()) + ends.len() < 3 {
            return landmarks;
        }
        let level = |joint: usize| looks.means[joint].dot(up.unit());
        ends.sort_by(|a, b| level(*a).total_cmp(&level(*b)));
        ankles.extend(ends.drain(..(2 - ankles.len()).min(ends.len())));
        ankles.sort_unstable();
        let foot = |ankle| looks.foot(skeleton, limbs.end(skeleton, ankle), up.unit());
        landmarks.feet = ankles.into_iter().map(foot).collect();
        let lengths = lengths(skeleton);
        let mut longest = ends.clone();
        longest.sort_by(|a, b| lengths[*b].total_cmp(&lengths[*a]));
        // Keep one end for the head.
        let spare = ends.len() - usize::from(limbs.head.is_none()).min(ends.len());
        longest.truncate((2 - wrists.len()).min(spare));
        let highest = ends.into_iter().rfind(|end| !longest.contains(end));
        // Rigs of one performer place the last neck joint differently. The first joint with a short enough chain is
        // comparable between them.
        let named = limbs.head.map(|head| first_of_head(skeleton, looks.height, head));
        landmarks.head = named.or(highest).map(Point::new);
        wrists.extend(longest);
        wrists.sort_unstable();
        landmarks.wrists = wrists.into_iter().map(|wrist| limbs.end(skeleton, wrist)).collect();
        landmarks
    }

    /// Returns wrists, ankles and head.
    pub fn points(&self) -> Vec<Point> {
        let ankles = self.feet.iter().map(|foot| foot.ankle);
        self.wrists.iter().copied().chain(ankles).chain(self.head).collect()
    }
}

/// Computes the world positions of some points at each koma of a clock: one path per point, in the file's unit.
pub fn paths(clip: &Clip, clock: Clock, points: &[Point]) -> Vec<Vec<DVec3>> {
    let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
    let joints: Vec<usize> = points.iter().map(|point| point.joint.0).collect();
    let (rig, places) = Rig::carrying(clip.skeleton(), &joints);
    let mut poser = LanePoser::of_rig(clip, rig);
    let mut paths = vec![Vec::with_capacity(koma + LANES); points.len()];
    for piece in pieces(koma.div_ceil(LANES)) {
        wide(
            #[inline(always)]
            || {
                for block in piece {
                    poser.koma(clock, block, koma);
                    let pose = poser.stand();
                    for ((path, point), joint) in paths.iter_mut().zip(points).zip(&places) {
                        let offset = LaneVec::splat(point.offset);
                        let position =
                            pose.translations[*joint] + pose.rotations[*joint].rotate(offset);
                        path.extend((0..LANES).map(|lane| position.lane(lane)));
                    }
                }
            },
        );
    }
    paths.iter_mut().for_each(|path| path.truncate(koma));
    paths
}

/// Mean positions of joints and tips over a clip, and the height of the body.
pub(super) struct Looks {
    /// One position per joint.
    means: Vec<DVec3>,
    /// One position per End Site, in the order of the file.
    tips: Vec<(Point, DVec3)>,
    height: f64,
    /// How upright the body stands, if names give legs and head.
    upright: Option<DVec3>,
}

impl Looks {
    pub(super) fn at(clip: &Clip, members: &Members, limbs: &NamedLimbs) -> Self {
        let skeleton = members.skeleton();
        let tips = skeleton.iter().flat_map(|(joint, data)| {
            data.end_sites.iter().map(move |end| (Point { joint, offset: end.offset }, DVec3::ZERO))
        });
        let means = vec![DVec3::ZERO; skeleton.len()];
        let mut looks = Self { means, tips: tips.collect(), height: 0.0, upright: None };
        let mut sides = Vec::new();
        let mut stands = limbs.legs_and_head().map(|(legs, head)| Stands::from_legs(legs, head));
        each_look(clip, |body| {
            for (mean, position) in looks.means.iter_mut().zip(body.positions()) {
                *mean += *position;
            }
            for (tip, mean) in &mut looks.tips {
                *mean += tip.position(body);
            }
            sides.push(members.extent(body.positions()).max_element());
            stands.iter_mut().for_each(|stands| stands.look(body));
        });
        looks.height = median(sides);
        looks.upright = stands.map(|stands| stands.upright());
        looks
    }

    /// Returns how upright a body with these legs and head stands along each axis: see [`Stands::upright`].
    pub(super) fn upright(&self, clip: &Clip, legs: [[usize; 3]; 2], head: usize) -> DVec3 {
        self.upright.unwrap_or_else(|| {
            let mut stands = Stands::from_legs(legs, head);
            each_look(clip, |body| stands.look(body));
            stands.upright()
        })
    }

    /// Returns the foot below an ankle.
    fn foot(&self, skeleton: &Skeleton, ankle: Point, up: DVec3) -> Foot {
        let inside: BTreeSet<usize> = below(skeleton, ankle.joint.0).collect();
        let joints = inside.iter().map(|joint| (Point::new(*joint), self.means[*joint]));
        let tips = self.tips.iter().copied().filter(|(tip, _)| inside.contains(&tip.joint.0));
        let lowest = joints.chain(tips).min_by(|a, b| a.1.dot(up).total_cmp(&b.1.dot(up)));
        Foot { ankle, sole: lowest.map_or(ankle, |(sole, _)| sole) }
    }
}

/// Directions of a body's legs and of the whole body over the sampled poses.
struct Stands {
    legs: [[usize; 3]; 2],
    head: usize,
    /// Directions from the ankles to the hips, and from the ankles to the head.
    ways: [Vec<DVec3>; 2],
}

impl Stands {
    fn from_legs(legs: [[usize; 3]; 2], head: usize) -> Self {
        Self { legs, head, ways: [Vec::new(), Vec::new()] }
    }

    fn look(&mut self, body: &Body) {
        let at = |joint: usize| body.positions()[joint];
        let [left, right] = self.legs;
        let [hips, ankles] = [0, 2].map(|end| at(left[end]).midpoint(at(right[end])));
        self.ways[0].push((hips - ankles).normalize_or_zero());
        self.ways[1].push((at(self.head) - ankles).normalize_or_zero());
    }

    /// Returns how upright the body stands along each axis, as the median cosine over its poses: that of its legs or
    /// that of the whole body, whichever is larger.
    fn upright(&self) -> DVec3 {
        let middle = |ways: &Vec<DVec3>| {
            let along = |axis: DVec3| median(ways.iter().map(|way| way.dot(axis)).collect());
            DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
        };
        let [legs, all] = self.ways.each_ref().map(middle);
        legs.max(all)
    }
}

/// Samples a clip evenly, at most [`LOOKS`] frames.
fn each_look(clip: &Clip, mut look: impl FnMut(&Body)) {
    let (mut poser, mut body) = (LanePoser::new(clip), Body::new(clip.skeleton()));
    let looks = clip.len().min(LOOKS);
    let frame = |look: usize| Frame(clip.first().0 + look * clip.len() / looks);
    for first in (0..looks).step_by(LANES) {
        let rows = array::from_fn(|lane| clip.row(frame((first + lane).min(looks - 1))));
        wide(
            #[inline(always)]
            || {
                poser.rows(&rows);
                poser.stand();
            },
        );
        for lane in 0..LANES.min(looks - first) {
            body.take_lane(poser.pose(), lane);
            look(&body);
        }
    }
}

/// Returns the median of some numbers; 0 if there are none.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(0.0)
}

/// Finds the joints at which limbs end.
fn ends(skeleton: &Skeleton, height: f64) -> BTreeSet<usize> {
    let (reaches, lengths) = (skeleton.reaches(), lengths(skeleton));
    let carries = skeleton.carriers();
    let end = |leaf: usize| first_end_of(skeleton, &reaches, height, leaf);
    let body = body_root(skeleton);
    let is_of_body = |leaf: &usize| above(skeleton, *leaf).last() == body;
    let leaves = (0..skeleton.len()).filter(|joint| !carries[*joint]).filter(is_of_body);
    leaves.map(end).filter(|end| lengths[*end] >= SHORTEST_LIMB * height).collect()
}

/// Shortest bone from the head's joint to its top, as a share of the body's height. Some rigs end at that joint.
const SHORTEST_HEAD: f64 = 0.02;

/// Returns the first joint from the root, on the way to the head, with a chain no longer than a head. If the rig ends
/// at the head's joint, returns that joint.
fn first_of_head(skeleton: &Skeleton, height: f64, head: usize) -> usize {
    let is_long = |offset: DVec3| offset.length() >= SHORTEST_HEAD * height;
    let mut tips = skeleton.joints[head].end_sites.iter().map(|end| end.offset);
    let mut joints = skeleton.joints.iter();
    let hangs_on = |joint: &Joint| joint.parent == Some(JointId(head)) && is_long(joint.offset);
    // If the rig has no top of the head, the neck would pass as a head.
    let has_top = tips.any(is_long) || joints.any(hangs_on);
    if has_top { first_end_of(skeleton, &skeleton.reaches(), height, head) } else { head }
}

fn first_end_of(skeleton: &Skeleton, reaches: &[f64], height: f64, joint: usize) -> usize {
    // A joint that cannot turn is a point on a bone.
    let is_end =
        |joint: &usize| reaches[*joint] <= LONGEST_END * height && skeleton.joints[*joint].turns();
    above(skeleton, joint).filter(is_end).last().unwrap_or(joint)
}

/// Returns the root of the tree with the greatest sum of bone lengths; of equal trees the first.
pub(super) fn body_root(skeleton: &Skeleton) -> Option<usize> {
    let roots = skeleton.roots();
    let sizes = bones_by_tree(skeleton, &roots);
    let largest = |best: usize, other: usize| if sizes[other] > sizes[best] { other } else { best };
    roots.into_iter().reduce(largest)
}

/// Sums the bone lengths of each tree; the sum is at the index of the root.
pub(super) fn bones_by_tree(skeleton: &Skeleton, roots: &[usize]) -> Vec<f64> {
    let mut sizes = vec![0.0; skeleton.len()];
    for (joint, root) in skeleton.joints.iter().zip(roots) {
        sizes[*root] += joint.parent.map_or(0.0, |_| joint.offset.length());
    }
    sizes
}

/// Returns a joint and its ancestors, up to the root.
pub(crate) fn above(skeleton: &Skeleton, joint: usize) -> impl Iterator<Item = usize> {
    iter::successors(Some(joint), |joint| skeleton.joints[*joint].parent.map(|parent| parent.0))
}

/// Returns each joint's distance from its root along the bones. The root's own offset is no bone.
pub(super) fn lengths(skeleton: &Skeleton) -> Vec<f64> {
    let mut lengths: Vec<f64> = Vec::with_capacity(skeleton.len());
    for joint in &skeleton.joints {
        lengths.push(joint.parent.map_or(0.0, |parent| lengths[parent.0] + joint.offset.length()));
    }
    lengths
}

/// Returns a joint and its descendants.
pub(crate) fn below(skeleton: &Skeleton, top: usize) -> impl Iterator<Item = usize> {
    let mut is_below = vec![false; skeleton.len()];
    for (joint, data) in skeleton.joints.iter().enumerate().skip(top) {
        is_below[joint] = joint == top || data.parent.is_some_and(|parent| is_below[parent.0]);
    }
    is_below.into_iter().enumerate().filter_map(|(joint, is_below)| is_below.then_some(joint))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Channel, EndSite};
    use crate::time::FrameRate;

    /// Name, parent, offset at rest and tip of a joint.
    type Bone = (&'static str, Option<usize>, [f64; 3], Option<[f64; 3]>);

    /// A standing body with a hand of two fingers.
    const BODY: [Bone; 17] = [
        ("a", None, [0.0, 90.0, 0.0], None),
        ("b", Some(0), [0.0, 20.0, 0.0], None),
        ("c", Some(1), [0.0, 35.0, 0.0], None),
        ("d", Some(2), [0.0, 10.0, 0.0], Some([0.0, 15.0, 0.0])),
        ("e", Some(2), [15.0, 0.0, 0.0], None),
        ("f", Some(4), [28.0, 0.0, 0.0], None),
        ("g", Some(5), [25.0, 0.0, 0.0], None),
        ("h", Some(6), [9.0, 0.0, 2.0], Some([8.0, 0.0, 0.0])),
        ("i", Some(6), [5.0, 0.0, -4.0], Some([4.0, 0.0, 0.0])),
        ("j", Some(2), [-15.0, 0.0, 0.0], None),
        ("k", Some(9), [-28.0, 0.0, 0.0], None),
        ("l", Some(10), [-25.0, 0.0, 0.0], Some([-15.0, 0.0, 0.0])),
        ("m", Some(0), [9.0, -40.0, 0.0], None),
        ("n", Some(12), [0.0, -40.0, 0.0], Some([0.0, -8.0, 15.0])),
        ("o", Some(0), [-9.0, -40.0, 0.0], None),
        ("p", Some(14), [0.0, -40.0, 0.0], None),
        ("q", Some(15), [0.0, -8.0, 12.0], Some([0.0, 0.0, 5.0])),
    ];

    /// The body standing still; `turned` maps Y up to another axis.
    fn standing(scale: f64, turned: fn(DVec3) -> DVec3) -> Clip {
        let place = |offset: [f64; 3]| turned(scale * DVec3::from_array(offset));
        let joints = BODY.iter().enumerate().map(|(at, (name, parent, offset, tip))| Joint {
            name: (*name).into(),
            parent: parent.map(JointId),
            offset: place(*offset),
            channels: vec![Channel::Rotation(Axis::X)],
            first_channel: at,
            end_sites: tip
                .iter()
                .map(|tip| EndSite { name: "Site".into(), offset: place(*tip) })
                .collect(),
        });
        let skeleton = Skeleton { joints: joints.collect() };
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(skeleton, rate, Frame(7), 3, vec![0.0; 3 * BODY.len()]).unwrap()
    }

    #[test]
    fn head_wrists_and_ankles_are_found_without_their_names_at_any_size_and_either_way_up() {
        for (scale, turned) in [
            (1.0, (|offset| offset) as fn(DVec3) -> DVec3),
            (0.01, |offset| offset),
            (12.0, |offset| DVec3::new(offset.x, -offset.z, offset.y)),
        ] {
            let clip = standing(scale, turned);
            let found = Landmarks::new(&clip);
            let joint = |point: &Point| clip.skeleton().joints[point.joint.0].name.clone();
            assert_eq!(found.head.as_ref().map(joint).as_deref(), Some("d"));
            assert_eq!(found.wrists.iter().map(joint).collect::<Vec<_>>(), ["g", "l"]);
            let ankles = found.feet.iter().map(|foot| joint(&foot.ankle));
            assert_eq!(ankles.collect::<Vec<_>>(), ["n", "p"]);
            let soles: Vec<_> = found.feet.iter().map(|foot| joint(&foot.sole)).collect();
            assert_eq!(soles, ["n", "q"], "the tip of a foot of one bone, the ball of one of two");
            assert!(found.feet[0].sole.offset.length() > 0.0);
            assert_eq!(found.points().len(), 5);
        }
    }

    #[test]
    fn a_path_has_a_place_a_koma() {
        let clip = standing(1.0, |offset| offset);
        let points = Landmarks::new(&clip).points();
        let paths = paths(&clip, clip.clock(24.0), &points);
        assert_eq!(paths.len(), 5);
        assert_eq!(paths[4], [DVec3::new(0.0, 155.0, 0.0); 3], "the head");
        assert_eq!(paths[0][0], DVec3::new(68.0, 145.0, 0.0), "a wrist");
    }

    #[test]
    fn a_body_without_limbs_has_no_landmark() {
        let mut skeleton = standing(1.0, |offset| offset).skeleton().clone();
        skeleton.joints.truncate(2);
        let rate = FrameRate::new(24.0).unwrap();
        let clip = Clip::new(skeleton, rate, Frame(0), 1, vec![0.0; 2]).unwrap();
        assert!(Landmarks::new(&clip).points().is_empty());
    }
}
