//! A tennis forehand, right-handed, towards +Z.

use super::score::Part::{Arm, Collar, Elbow, Foot, Gaze, Grip, Hips, Root, Trunk};
use super::score::Side::{L, R};
use super::score::{Key, Score, key, plant, window};

/// Positions of the opponent, of the ball in flight, and of the ball at impact.
const NET: [f64; 3] = [0.0, 120.0, 1800.0];
const COMING: [f64; 3] = [-60.0, 110.0, 400.0];
const MET: [f64; 3] = [-75.0, 95.0, 75.0];

/// 88 frames at 24 fps: ready, split step, turn, swing, finish, ready again.
pub(crate) fn score() -> Score {
    Score {
        file: "tennis.bvh",
        frames: 88,
        fps: 24.0,
        seed: 0x0088,
        keys: [before(), stroke(), after()].into_iter().flatten().collect(),
        plants: vec![
            plant(L, 0.0, 0.4, [26.0, 0.0], 10.0, 0.0),
            plant(L, 0.56, 1.0, [30.0, 1.0], 8.0, 4.0),
            plant(L, 1.3, 2.3, [4.0, 44.0], -32.0, 7.0),
            plant(L, 2.66, 9.0, [22.0, 30.0], 10.0, 6.0),
            plant(R, 0.0, 0.4, [-26.0, 0.0], -10.0, 0.0),
            plant(R, 0.56, 0.66, [-30.0, 1.0], -12.0, 4.0),
            plant(R, 0.94, 1.78, [-44.0, -10.0], -72.0, 6.0),
            plant(R, 2.2, 9.0, [-30.0, 30.0], -8.0, 6.0),
        ],
        swings: vec![],
        grips: vec![window(-1.0, 0.98, 0.1, 0.28), window(2.45, 9.0, 0.4, 0.1)],
    }
}

fn before() -> Vec<Key> {
    vec![
        key(
            "ready",
            0.2,
            [
                (Root, [0.0, 82.0, -8.0]),
                (Hips, [18.0, 0.0, 0.0]),
                (Trunk, [16.0, 0.0, 0.0]),
                (Grip, [-2.0, -4.0, 34.0]),
                (Gaze, NET),
            ],
        ),
        key(
            "split step",
            0.48,
            [
                (Root, [0.0, 86.5, -5.0]),
                (Hips, [16.0, 0.0, 0.0]),
                (Trunk, [14.0, 0.0, 0.0]),
                (Grip, [-2.0, 0.0, 33.0]),
                (Gaze, COMING),
            ],
        ),
        key(
            "landing",
            0.64,
            [
                (Root, [-2.0, 79.0, -6.0]),
                (Hips, [20.0, 0.0, -6.0]),
                (Trunk, [17.0, 0.0, -6.0]),
                (Grip, [-5.0, -3.0, 32.0]),
                (Arm(R), [40.0, 40.0, 30.0]),
                (Elbow(R), [85.0, 0.0, 0.0]),
                (Arm(L), [60.0, 45.0, 20.0]),
                (Elbow(L), [80.0, 0.0, 0.0]),
            ],
        ),
        key(
            "shoulders turn",
            0.98,
            [
                (Root, [-20.0, 82.0, -8.0]),
                (Hips, [12.0, 0.0, -58.0]),
                (Trunk, [8.0, 0.0, -42.0]),
                (Grip, [-14.0, 6.0, 26.0]),
                (Collar(R), [4.0, -8.0, 0.0]),
                (Arm(R), [0.0, 62.0, 50.0]),
                (Elbow(R), [80.0, 0.0, 0.0]),
                (Arm(L), [42.0, 75.0, 10.0]),
                (Elbow(L), [25.0, 0.0, 0.0]),
                (Gaze, COMING),
            ],
        ),
        key(
            "racket back",
            1.26,
            [
                (Root, [-22.0, 80.0, -2.0]),
                (Hips, [10.0, -3.0, -64.0]),
                (Trunk, [8.0, -4.0, -50.0]),
                (Collar(R), [6.0, -16.0, 0.0]),
                (Arm(R), [-26.0, 68.0, 30.0]),
                (Elbow(R), [58.0, 0.0, -15.0]),
                (Arm(L), [40.0, 84.0, 5.0]),
                (Elbow(L), [15.0, 0.0, 0.0]),
            ],
        ),
    ]
}

fn stroke() -> Vec<Key> {
    vec![
        key(
            "racket drops",
            1.44,
            [
                (Root, [-17.0, 77.5, 8.0]),
                (Hips, [10.0, -3.0, -46.0]),
                (Trunk, [10.0, -4.0, -50.0]),
                (Foot(R), [12.0, 8.0, 0.0]),
                (Collar(R), [-2.0, -14.0, 0.0]),
                (Arm(R), [-30.0, 44.0, 5.0]),
                (Elbow(R), [38.0, 0.0, -40.0]),
                (Arm(L), [38.0, 74.0, 10.0]),
                (Elbow(L), [35.0, 0.0, 0.0]),
                (Gaze, MET),
            ],
        ),
        key(
            "contact",
            1.6,
            [
                (Root, [-12.0, 82.0, 18.0]),
                (Hips, [6.0, 0.0, -8.0]),
                (Trunk, [4.0, 2.0, -4.0]),
                (Foot(R), [34.0, 38.0, 0.0]),
                (Collar(R), [0.0, 10.0, 0.0]),
                (Arm(R), [40.0, 58.0, 32.0]),
                (Elbow(R), [26.0, 0.0, -25.0]),
                (Arm(L), [45.0, 48.0, 35.0]),
                (Elbow(L), [80.0, 0.0, 0.0]),
                (Gaze, MET),
            ],
        ),
        key(
            "through the ball",
            1.7,
            [
                (Root, [-10.0, 84.0, 22.0]),
                (Hips, [4.0, 0.0, 6.0]),
                (Trunk, [2.0, 2.0, 14.0]),
                (Foot(R), [44.0, 52.0, 0.0]),
                (Collar(R), [6.0, 18.0, 0.0]),
                (Arm(R), [78.0, 84.0, 34.0]),
                (Elbow(R), [38.0, 0.0, 20.0]),
            ],
        ),
        key(
            "finish",
            1.92,
            [
                (Root, [-8.0, 85.5, 26.0]),
                (Hips, [4.0, 0.0, 18.0]),
                (Trunk, [2.0, 2.0, 28.0]),
                (Foot(R), [50.0, 62.0, 0.0]),
                (Collar(R), [12.0, 20.0, 0.0]),
                (Arm(R), [108.0, 100.0, 28.0]),
                (Elbow(R), [104.0, 0.0, 30.0]),
                (Arm(L), [55.0, 55.0, 40.0]),
                (Elbow(L), [100.0, 0.0, 0.0]),
                (Gaze, NET),
            ],
        ),
    ]
}

fn after() -> Vec<Key> {
    vec![
        key(
            "finish, settled",
            2.1,
            [
                (Root, [-8.0, 84.5, 28.0]),
                (Hips, [6.0, 0.0, 16.0]),
                (Trunk, [4.0, 1.0, 24.0]),
                (Foot(R), [0.0, 0.0, 0.0]),
                (Arm(R), [106.0, 96.0, 28.0]),
                (Elbow(R), [106.0, 0.0, 25.0]),
                (Arm(L), [55.0, 50.0, 40.0]),
                (Elbow(L), [92.0, 0.0, 0.0]),
                (Grip, [4.0, -2.0, 30.0]),
            ],
        ),
        key(
            "recover",
            2.6,
            [
                (Root, [-6.0, 83.0, 26.0]),
                (Hips, [14.0, 0.0, 4.0]),
                (Trunk, [12.0, 0.0, 6.0]),
                (Collar(R), [0.0, 4.0, 0.0]),
                (Arm(R), [60.0, 45.0, 30.0]),
                (Elbow(R), [85.0, 0.0, 0.0]),
                (Arm(L), [60.0, 42.0, 30.0]),
                (Elbow(L), [80.0, 0.0, 0.0]),
                (Grip, [0.0, -3.0, 33.0]),
            ],
        ),
        key(
            "ready again",
            3.05,
            [
                (Root, [-4.0, 82.0, 22.0]),
                (Hips, [18.0, 0.0, 0.0]),
                (Trunk, [16.0, 0.0, 0.0]),
                (Grip, [-2.0, -4.0, 34.0]),
                (Gaze, NET),
            ],
        ),
    ]
}
