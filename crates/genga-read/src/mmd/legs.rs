//! Solves the IK of legs: the foot is keyed; hip and knee follow.
//!
//! MMD turns joint after joint in small steps until the ankle is near enough. A leg of two bones with a
//! hinge for a knee has a closed solution, which is used here: the knee bends by the law of cosines, and
//! the leg swings to its foot by the shortest way.

use glam::{DQuat, DVec3};

use super::rig::LegIk;
use genga::motion::body::leg::reach;

/// The axis of the knee hinge relative to the thigh; bending moves the foot back.
const HINGE: DVec3 = DVec3::NEG_X;

/// Turns hip, knee and ankle in the world so that the foot reaches the position and direction of its IK.
pub(super) fn bring(leg: &LegIk, does_turn: bool, turns: &mut [DQuat], places: &mut [DVec3]) {
    let [hip, knee, ankle] = leg.joints;
    let points = leg.joints.map(|joint| places[joint]);
    let (hinge, target) = (turns[hip] * HINGE, places[leg.target]);
    if let Some(found) = reach(points, hinge, target) {
        let shin = found.swing * found.bend;
        let thigh = points[1] - points[0];
        places[knee] = points[0] + found.swing * thigh;
        places[ankle] = places[knee] + shin * (points[2] - points[1]);
        turns[hip] = found.swing * turns[hip];
        turns[knee] = shin * turns[knee];
        turns[ankle] = shin * turns[ankle];
    }
    if let Some((way, toes)) = leg.toes.filter(|_| does_turn) {
        let (now, wanted) = (turns[ankle] * way, places[toes] - places[ankle]);
        if let (Some(now), Some(wanted)) = (now.try_normalize(), wanted.try_normalize()) {
            turns[ankle] = DQuat::from_rotation_arc(now, wanted) * turns[ankle];
        }
    }
}
