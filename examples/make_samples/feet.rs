//! Solves the legs: feet that stand where they were put, step from place to place, or swing freely.

use glam::{DQuat, DVec3};

use super::limb;
use super::perform::{Body, share};
use super::score::{Plant, Score, Side};
use super::skeleton::{BALL_HEIGHT, BONES, HIPS, LEGS};
use super::track::ease;

/// Target of a foot: the position of its ball, its direction, the lift of its heel.
struct Foot {
    ball: DVec3,
    yaw: f64,
    heel: f64,
}

/// The footsteps of a score.
pub(crate) struct Feet<'a> {
    score: &'a Score,
    steps: [Vec<Plant>; 2],
}

impl<'a> Feet<'a> {
    pub(crate) fn new(score: &'a Score) -> Self {
        let of = |side| score.plants.iter().filter(|plant| plant.side == side).copied().collect();
        Self { score, steps: [of(Side::L), of(Side::R)] }
    }

    /// Computes the rotations of thigh, shank, foot and toes relative to their parents. The hips must be set.
    ///
    /// `heel` and `turn` add to the standing foot; `free` and `knee` are the leg's own angles.
    pub(crate) fn leg(
        &self,
        body: &Body,
        side: Side,
        time: f64,
        [heel, turn]: [f64; 2],
        free: [f64; 3],
        knee: [f64; 3],
    ) -> [DQuat; 4] {
        let swings = self.score.swings.iter().filter(|swing| swing.0 == side);
        let swing = swings.map(|swing| share(&swing.1, time)).fold(0.0, f64::max);
        let swung = swung(side, free, knee);
        if swing == 1.0 {
            return swung;
        }
        let mut foot = self.foot(side, time);
        foot.heel += heel;
        foot.yaw += turn;
        let stood = stood(body, side, foot);
        [0, 1, 2, 3].map(|joint| stood[joint].slerp(swung[joint], swing))
    }

    fn foot(&self, side: Side, time: f64) -> Foot {
        let steps = &self.steps[side as usize];
        let next = steps.partition_point(|step| step.from <= time).max(1);
        let stand = steps[next - 1];
        let place = |step: Plant| DVec3::new(step.ball[0], BALL_HEIGHT, step.ball[1]);
        if time <= stand.to || next == steps.len() {
            return Foot { ball: place(stand), yaw: stand.yaw, heel: 0.0 };
        }
        let goal = steps[next];
        let along = ease(time, stand.to, goal.from);
        let u = (time - stand.to) / (goal.from - stand.to);
        let mut ball = place(stand).lerp(place(goal), along);
        ball.y += goal.lift * 16.0 * (u * (1.0 - u)).powi(2);
        // The heel leaves first and, on a long step, lands first.
        let length = (place(stand).distance(place(goal)) / 50.0).min(1.0);
        let (early, late) = (bump(u / 0.7), bump((u - 0.5) / 0.5));
        let yaw = stand.yaw + (goal.yaw - stand.yaw) * along;
        Foot { ball, yaw, heel: length * (40.0 * early - 14.0 * late) }
    }
}

/// Rises from 0 to 1 and falls again over 0..1.
fn bump(u: f64) -> f64 {
    libm::sin(std::f64::consts::PI * u.clamp(0.0, 1.0)).powi(2)
}

/// Computes a leg from its own angles.
fn swung(side: Side, free: [f64; 3], [bend, ankle, toes]: [f64; 3]) -> [DQuat; 4] {
    let thigh = limb::thigh(free);
    let thigh = if side == Side::L { thigh } else { limb::mirrored(thigh) };
    [thigh, limb::about_x(bend), limb::about_x(-ankle), limb::about_x(-toes)]
}

/// Computes a leg that places its foot at the target. If that is too far, the heel is lifted.
fn stood(body: &Body, side: Side, mut foot: Foot) -> [DQuat; 4] {
    let [thigh, shank, ankle, toes] = LEGS[side as usize];
    let hip = body.places[HIPS] + body.world[HIPS] * BONES[thigh].offset;
    let bones = [BONES[shank].offset.length(), BONES[ankle].offset.length()];
    let longest = 0.985 * (bones[0] + bones[1]);
    let turned = |heel: f64| limb::about_y(foot.yaw) * limb::about_x(heel);
    let target = |heel: f64| foot.ball - turned(heel) * BONES[toes].offset - hip;
    if target(foot.heel).length() > longest {
        let (mut low, mut high) = (foot.heel, 80.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if target(middle).length() > longest { low = middle } else { high = middle }
        }
        foot.heel = high;
    }
    let into_hips = body.world[HIPS].inverse();
    let (target, turned) = (into_hips * target(foot.heel), into_hips * turned(foot.heel));
    // The knee points where the toes do, and a little where the hips face.
    let pole = turned * limb::about_x(-foot.heel) * DVec3::Z + 0.25 * DVec3::Z;
    let [thigh, shank] = limb::reach_with_leg(target, pole, bones);
    // Toes stay flat on the floor while the heel is up.
    let toes = limb::about_x(-foot.heel.max(0.0));
    [thigh, thigh.inverse() * shank, shank.inverse() * turned, toes]
}
