//! Builds the mannequin (デッサン人形) in a pose: balls that parts are stretched over, and lines that show which
//! way a part faces.
//!
//! Lengths are in body heights and follow the usual proportions of an adult.

use std::ops::Range;

use glam::DVec3;

use genga::motion::{BodySide, Build, Clip, MannequinParts, Point as Mark};

/// Maximum radius of a limb's half relative to its length: a toy's arms are short.
const THICKEST: f64 = 0.3;

/// Radii of an arm (shoulder, elbow, wrist) and of a leg (hip, knee, ankle).
const ARM: [f64; 3] = [0.031, 0.024, 0.017];
const LEG: [f64; 3] = [0.047, 0.033, 0.021];

/// Balls of the head, skull then chin: offset up, offset ahead of the head's middle, and radius.
const HEAD: [(f64, f64, f64); 2] = [(0.012, -0.008, 0.060), (-0.042, 0.018, 0.033)];

/// Points of the nose line: offsets up and ahead of the head's middle.
const NOSE: [(f64, f64); 4] = [(0.030, 0.044), (0.008, 0.050), (-0.014, 0.068), (-0.020, 0.049)];

/// Line of the eyes: offset up, offset ahead, and half its width.
const EYES: (f64, f64, f64) = (0.012, 0.044, 0.030);

/// Index of the head's middle among the marks.
const HEAD_MARK: usize = 4;

/// Depth offsets: inner parts count as further away, a part that limbs come out of as nearer.
const BELLY: f64 = -0.1;
const THROAT: f64 = -0.08;
const PELVIS: f64 = 0.035;

/// Indices into [`Solid::fronts`].
const FACE: usize = 0;
const CHEST: usize = 1;
const HIPS: usize = 2;

/// A ball, in units of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ball {
    pub(crate) middle: DVec3,
    pub(crate) radius: f64,
}

/// A part of the figure, stretched over some balls.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    pub(crate) balls: Range<usize>,
    pub(crate) side: BodySide,
    /// Joint that turns the part.
    pub(crate) joint: usize,
    /// Depth offset: how much nearer than its middle the part counts, in units of the file.
    pub(crate) nearer: f64,
}

/// A line on a part, drawn only while a front of the figure faces the viewer enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub(crate) from: DVec3,
    pub(crate) to: DVec3,
    pub(crate) part: usize,
    /// Index into [`Solid::fronts`].
    pub(crate) front: usize,
    /// Minimum cosine between the front and the direction to the viewer.
    pub(crate) least: f64,
}

/// A mannequin in a pose. In all poses of a clip it has the same parts and lines in the same order.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Solid {
    pub(crate) balls: Vec<Ball>,
    pub(crate) parts: Vec<Part>,
    pub(crate) lines: Vec<Line>,
    /// Directions in which face, chest and hips look; of length 1.
    pub(crate) fronts: [DVec3; 3],
}

impl Solid {
    /// Returns the balls of a part.
    pub(crate) fn balls(&self, part: usize) -> &[Ball] {
        &self.balls[self.parts[part].balls.clone()]
    }

    /// Returns the middle of a part.
    pub(crate) fn middle(&self, part: usize) -> DVec3 {
        let balls = self.balls(part);
        balls.iter().map(|ball| ball.middle).sum::<DVec3>() / balls.len() as f64
    }

    /// Adds a part and returns its index.
    fn part(
        &mut self,
        (side, joint): (BodySide, usize),
        balls: impl IntoIterator<Item = (DVec3, f64)>,
    ) -> usize {
        let begin = self.balls.len();
        self.balls.extend(balls.into_iter().map(|(middle, radius)| Ball { middle, radius }));
        let balls = begin..self.balls.len();
        self.parts.push(Part { balls, side, joint, nearer: 0.0 });
        self.parts.len() - 1
    }

    /// Adds a line through points on a part.
    fn line(&mut self, part: usize, front: usize, least: f64, points: &[DVec3]) {
        let lines = points.windows(2);
        self.lines.extend(lines.map(|ends| Line {
            from: ends[0],
            to: ends[1],
            part,
            front,
            least,
        }));
    }
}

/// A mannequin that fits a rig.
#[derive(Debug, Clone)]
pub(crate) struct Mannequin {
    parts: MannequinParts,
    /// Joint that each point of a pose belongs to.
    owners: Vec<usize>,
}

/// The axes of a box: right, up and forward, each of length 1.
#[derive(Debug, Clone, Copy)]
struct Axes {
    right: DVec3,
    up: DVec3,
    ahead: DVec3,
}

impl Axes {
    /// Builds the axes of a part that extends along `up` and faces across it; `forward` is 1 or -1.
    fn new(right: DVec3, up: DVec3, forward: f64) -> Self {
        let up = up.normalize_or(DVec3::Y);
        let right = (right - up * right.dot(up)).normalize_or(up.any_orthonormal_vector());
        Self { right, up, ahead: forward * up.cross(right) }
    }

    fn place(&self, from: DVec3, (right, up, ahead): (f64, f64, f64)) -> DVec3 {
        from + self.right * right + self.up * up + self.ahead * ahead
    }
}

impl Mannequin {
    /// Builds the mannequin of a clip; `None` if the body lacks a head, two arms or two legs.
    pub(super) fn new(clip: &Clip, build: &Build) -> Option<Self> {
        let parts = MannequinParts::of_build(clip, build)?;
        Some(Self { parts, owners: clip.skeleton().owners().collect() })
    }

    /// Returns the marks that a pose must list after its joints and tips.
    pub(super) fn marks(&self) -> &[Mark] {
        &self.parts.marks
    }

    /// Whether a part covers the bone that leads to a point (a joint or a tip).
    pub(super) fn covers(&self, point: usize) -> bool {
        let owner = self.owners[point];
        self.parts.covered[owner] || owner != point && owner == self.parts.root
    }

    /// Returns the figure of the mirrored body, in which the same points are on the other side.
    #[cfg(test)]
    pub(super) fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        mirrored.parts.forward = -self.parts.forward;
        mirrored
    }

    /// Returns how far the figure reaches beyond its points, in units of the file.
    pub(super) fn reach(&self) -> f64 {
        0.03 * self.parts.height
    }

    /// Builds the figure in a pose.
    pub(crate) fn solid(&self, pose: &[DVec3]) -> Solid {
        let mut solid = Solid::default();
        let tall = self.parts.height;
        let [[hip_l, ..], [hip_r, ..]] = self.parts.legs;
        let [[shoulder_l, ..], [shoulder_r, ..]] = self.parts.arms;
        let hips = pose[hip_l].midpoint(pose[hip_r]);
        let neck = pose[shoulder_l].midpoint(pose[shoulder_r]);
        let waist = self.parts.waist.map_or(hips.lerp(neck, 0.42), |joint| pose[joint]);
        let forward = self.parts.forward;
        let pelvis = Axes::new(pose[hip_r] - pose[hip_l], waist - hips, forward);
        let chest = Axes::new(pose[shoulder_r] - pose[shoulder_l], neck - waist, forward);
        let wide = 0.5 * pose[hip_l].distance(pose[hip_r]) / tall;
        let broad = 0.5 * pose[shoulder_l].distance(pose[shoulder_r]) / tall;

        let bend = waist.lerp(hips.midpoint(neck), 0.3);
        let middle = self.parts.waist.unwrap_or(self.parts.root);
        let belly = solid.part(
            (BodySide::Trunk, middle),
            [
                (pelvis.place(hips, (0.0, 0.03 * tall, 0.0)), 0.058 * tall),
                (bend, 0.056 * tall),
                (chest.place(neck, (0.0, -0.13 * tall, 0.0)), 0.060 * tall),
            ],
        );
        solid.parts[belly].nearer = BELLY * tall;
        self.hips(&mut solid, &pelvis, hips, wide.clamp(0.03, 0.08));
        self.ribs(&mut solid, &chest, (neck, waist), broad.clamp(0.06, 0.13));
        self.head(&mut solid, pose, neck);
        for (side, (arm, leg)) in [BodySide::Left, BodySide::Right]
            .into_iter()
            .zip(self.parts.arms.iter().zip(&self.parts.legs))
        {
            self.limb(&mut solid, side, pose, arm, ARM);
            self.hand(&mut solid, side, pose, arm);
            self.limb(&mut solid, side, pose, leg, LEG);
            self.foot(&mut solid, side, pose, leg);
        }
        solid.fronts[CHEST] = chest.ahead;
        solid.fronts[HIPS] = pelvis.ahead;
        solid
    }

    /// Adds the pelvis: a box with rounded edges, narrower below, with a V in front.
    fn hips(&self, solid: &mut Solid, axes: &Axes, hips: DVec3, wide: f64) {
        let tall = self.parts.height;
        let edge = 0.022;
        let half = [(wide + 0.028 - edge, -0.012), (wide + 0.022 - edge, 0.062)];
        let at = |right: f64, up: f64, ahead: f64| {
            axes.place(hips, (right * tall, up * tall, ahead * tall))
        };
        let corners = half.into_iter().flat_map(|(half, up)| {
            [(half, 0.030), (half, -0.032), (-half, 0.030), (-half, -0.032)]
                .map(|(right, ahead)| (at(right, up, ahead), edge * tall))
        });
        let part = solid.part((BodySide::Trunk, self.parts.root), corners);
        solid.parts[part].nearer = PELVIS * tall;
        let front = 0.030 + edge;
        let point = at(0.0, -0.030, front);
        let (left, right) = (at(-half[1].0, 0.066, front), at(half[1].0, 0.066, front));
        solid.line(part, HIPS, 0.12, &[left, point, right]);
    }

    /// Adds the ribcage: a box with rounded edges, with the breastbone and the arch of the ribs in front.
    fn ribs(&self, solid: &mut Solid, axes: &Axes, (neck, waist): (DVec3, DVec3), broad: f64) {
        let tall = self.parts.height;
        let edge = 0.026;
        let long = (neck.distance(waist) / tall).clamp(0.11, 0.17);
        let half = [
            (0.94 * broad - edge, -0.026, 0.024),
            (0.70 * broad + 0.012 - edge, 0.012 - long, 0.036),
        ];
        let at = |right: f64, up: f64, ahead: f64| {
            axes.place(neck, (right * tall, up * tall, ahead * tall))
        };
        let corners = half.into_iter().flat_map(|(half, up, deep)| {
            [(half, deep), (half, -deep), (-half, deep), (-half, -deep)]
                .map(|(right, ahead)| (at(right, up, ahead), edge * tall))
        });
        let part = solid.part((BodySide::Trunk, self.parts.chest), corners);
        let (top, low) = (at(0.0, -0.012, 0.026 + edge), 0.012 - long);
        let breast = at(0.0, 0.45 * low, 0.034 + edge);
        let arch = [-half[1].0, half[1].0].map(|right| at(right, low, 0.034 + edge));
        solid.line(part, CHEST, 0.12, &[top, breast]);
        solid.line(part, CHEST, 0.12, &[arch[0], breast, arch[1]]);
    }

    /// Adds neck, skull and chin, and the lines of nose and eyes.
    fn head(&self, solid: &mut Solid, pose: &[DVec3], neck: DVec3) {
        let tall = self.parts.height;
        let [middle, nose, crown] = self.parts.head.map(|mark| pose[mark]);
        let ahead = (nose - middle).normalize_or(DVec3::Z);
        let up = (crown - middle).normalize_or(DVec3::Y);
        let across = up.cross(ahead);
        let at = |up_by: f64, ahead_by: f64| middle + tall * (up_by * up + ahead_by * ahead);
        let throat = [(neck, 0.026 * tall), (at(-0.03, -0.012), 0.024 * tall)];
        let of_head = (BodySide::Trunk, self.parts.marks[HEAD_MARK].joint.0);
        let throat = solid.part(of_head, throat);
        solid.parts[throat].nearer = THROAT * tall;
        let balls = HEAD.map(|(up, ahead, radius)| (at(up, ahead), radius * tall));
        let part = solid.part(of_head, balls);
        solid.line(part, FACE, -0.25, &NOSE.map(|(up, ahead)| at(up, ahead)));
        let (level, ahead_by, half) = EYES;
        let eyes = [-half, half].map(|side| at(level, ahead_by) + tall * side * across);
        solid.line(part, FACE, 0.15, &eyes);
        solid.fronts[FACE] = ahead;
    }

    /// Adds the upper and the lower half of a limb; `radii` are those of its joints.
    fn limb(
        &self,
        solid: &mut Solid,
        side: BodySide,
        pose: &[DVec3],
        limb: &[usize; 4],
        radii: [f64; 3],
    ) {
        for half in 0..2 {
            let (from, to) = (pose[limb[half]], pose[limb[half + 1]]);
            let most = THICKEST * from.distance(to);
            let radius = |at: usize| (radii[at] * self.parts.height).min(most);
            solid.part((side, limb[half]), [(from, radius(half)), (to, radius(half + 1))]);
        }
    }

    /// Adds a hand: a wedge from the wrist to the fingertips.
    fn hand(&self, solid: &mut Solid, side: BodySide, pose: &[DVec3], arm: &[usize; 4]) {
        let (wrist, tips) = (pose[arm[2]], pose[arm[3]]);
        let ball = |share: f64, radius: f64| (wrist.lerp(tips, share), radius * self.parts.height);
        solid.part((side, arm[2]), [ball(0.1, 0.016), ball(0.45, 0.024), ball(0.95, 0.011)]);
    }

    /// Adds a foot: a wedge from heel to toes, below the ankle.
    fn foot(&self, solid: &mut Solid, side: BodySide, pose: &[DVec3], leg: &[usize; 4]) {
        let tall = self.parts.height;
        let [knee, ankle, toes] = [leg[1], leg[2], leg[3]].map(|point| pose[point]);
        let shin = (ankle - knee).normalize_or_zero();
        let way = (toes - ankle).normalize_or_zero();
        let sole = (way - shin * way.dot(shin).min(0.6)).normalize_or(way);
        let heel = ankle + tall * (0.018 * shin - 0.022 * sole);
        let ball = ankle.lerp(toes, 0.72);
        solid.part(
            (side, leg[2]),
            [
                (ankle, 0.022 * tall),
                (heel, 0.020 * tall),
                (ball, 0.020 * tall),
                (toes, 0.013 * tall),
            ],
        );
    }
}
