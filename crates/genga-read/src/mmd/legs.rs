//! Solves the IK of legs: the foot is keyed; hip and knee follow.
//!
//! MMD turns joint after joint in small steps until the ankle is near enough. A leg of two bones with a
//! hinge for a knee has a closed solution, which is used here: the knee bends by the law of cosines, and
//! the leg swings to its foot by the shortest way.

use glam::{DQuat, DVec3};

use genga::motion::body::leg::reach;

/// The axis of the knee hinge relative to the thigh; bending moves the foot back.
const HINGE: DVec3 = DVec3::NEG_X;

/// A leg that MMD brings to its IK bones, by the indices of bones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MmdLeg {
    /// Hip, knee and ankle.
    pub joints: [usize; 3],
    /// The bone that the ankle must reach.
    pub target: usize,
    /// The vector from ankle to toes at rest, and the bone that the toes must reach; `None` if no IK turns the foot.
    pub toes: Option<(DVec3, usize)>,
}

impl MmdLeg {
    /// Turns hip, knee and ankle in the world so that the foot reaches the position and, if `does_turn`, the direction
    /// of its IK. `turns` and `places` are those of all bones.
    pub fn bring(&self, does_turn: bool, turns: &mut [DQuat], places: &mut [DVec3]) {
        let [hip, knee, ankle] = self.joints;
        let points = self.joints.map(|joint| places[joint]);
        let (hinge, target) = (turns[hip] * HINGE, places[self.target]);
        if let Some(found) = reach(points, hinge, target) {
            let shin = found.swing * found.bend;
            let thigh = points[1] - points[0];
            places[knee] = points[0] + found.swing * thigh;
            places[ankle] = places[knee] + shin * (points[2] - points[1]);
            turns[hip] = found.swing * turns[hip];
            turns[knee] = shin * turns[knee];
            turns[ankle] = shin * turns[ankle];
        }
        if let Some((way, toes)) = self.toes.filter(|_| does_turn) {
            let (now, wanted) = (turns[ankle] * way, places[toes] - places[ankle]);
            if let (Some(now), Some(wanted)) = (now.try_normalize(), wanted.try_normalize()) {
                turns[ankle] = DQuat::from_rotation_arc(now, wanted) * turns[ankle];
            }
        }
    }
}
