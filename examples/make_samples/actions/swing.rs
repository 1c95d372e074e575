//! The baseball swing of a right-handed batter; the pitch comes from +Z.

use super::score::Part::{Arm, Collar, Elbow, Foot, Gaze, Grip, Hips, Root, Trunk};
use super::score::Side::{L, R};
use super::score::{Key, Score, key, plant, window};

/// Positions of the pitcher's hand and of the ball at impact.
const PITCHER: [f64; 3] = [-20.0, 150.0, 1800.0];
const MET: [f64; 3] = [-70.0, 85.0, 45.0];

/// 120 frames at 24 fps: stance, waggle, load, stride, swing, finish, bat down.
pub(crate) fn score() -> Score {
    Score {
        file: "swing.bvh",
        frames: 120,
        fps: 24.0,
        seed: 0x0120,
        keys: [before(), swing(), after()].into_iter().flatten().collect(),
        plants: vec![
            plant(L, 0.0, 1.56, [-13.0, 26.0], -84.0, 0.0),
            plant(L, 1.98, 3.55, [-14.0, 46.0], -52.0, 9.0),
            plant(L, 3.92, 9.0, [-13.0, 24.0], -60.0, 6.0),
            plant(R, 0.0, 9.0, [-13.0, -28.0], -90.0, 0.0),
        ],
        swings: vec![],
        grips: vec![window(-1.0, 9.0, 0.1, 0.1)],
    }
}

fn before() -> Vec<Key> {
    vec![
        key(
            "stance",
            0.25,
            [
                (Root, [2.0, 84.0, -3.0]),
                (Hips, [14.0, 0.0, -90.0]),
                (Trunk, [14.0, 0.0, 4.0]),
                (Collar(R), [6.0, 0.0, 0.0]),
                (Collar(L), [2.0, 8.0, 0.0]),
                (Grip, [-15.0, 13.0, 24.0]),
                (Elbow(L), [0.0, 0.0, 0.0]),
                (Elbow(R), [0.0, 0.0, 0.0]),
                (Arm(L), [0.0, 20.0, 0.0]),
                (Arm(R), [0.0, 20.0, 0.0]),
                (Gaze, PITCHER),
            ],
        ),
        key(
            "waggle",
            0.6,
            [
                (Root, [2.0, 83.0, 1.0]),
                (Trunk, [15.0, 0.0, 8.0]),
                (Grip, [-10.0, 9.0, 27.0]),
                (Elbow(L), [0.0, 0.0, 22.0]),
                (Elbow(R), [0.0, 0.0, -22.0]),
            ],
        ),
        key(
            "bat back",
            0.95,
            [
                (Root, [2.0, 84.0, -4.0]),
                (Hips, [14.0, 0.0, -91.0]),
                (Trunk, [14.0, 0.0, 3.0]),
                (Grip, [-16.0, 13.0, 23.0]),
                (Elbow(L), [0.0, 0.0, -6.0]),
                (Elbow(R), [0.0, 0.0, 6.0]),
            ],
        ),
        key(
            "waits",
            1.3,
            [
                (Root, [2.0, 83.6, -3.0]),
                (Hips, [14.0, 0.0, -90.0]),
                (Trunk, [14.0, 0.0, 4.0]),
                (Grip, [-15.0, 12.0, 24.0]),
            ],
        ),
        key(
            "load",
            1.72,
            [
                (Root, [2.0, 82.5, -13.0]),
                (Hips, [12.0, 0.0, -104.0]),
                (Trunk, [15.0, 0.0, -12.0]),
                (Grip, [-24.0, 14.0, 17.0]),
                (Elbow(L), [0.0, 0.0, -15.0]),
                (Elbow(R), [0.0, 0.0, 15.0]),
                (Foot(R), [0.0, 0.0, 0.0]),
                (Gaze, PITCHER),
            ],
        ),
    ]
}

fn swing() -> Vec<Key> {
    vec![
        key(
            "stride lands",
            1.98,
            [
                (Root, [1.0, 80.0, 4.0]),
                (Hips, [12.0, 0.0, -88.0]),
                (Trunk, [14.0, 0.0, -26.0]),
                (Grip, [-27.0, 12.0, 12.0]),
                (Foot(R), [6.0, 4.0, 0.0]),
            ],
        ),
        key(
            "hips fire",
            2.1,
            [
                (Root, [0.0, 80.0, 9.0]),
                (Hips, [8.0, -3.0, -48.0]),
                (Trunk, [12.0, -6.0, -44.0]),
                (Grip, [-21.0, 1.0, 21.0]),
                (Foot(R), [26.0, 24.0, 0.0]),
                (Elbow(L), [0.0, 0.0, -20.0]),
                (Elbow(R), [0.0, 0.0, 20.0]),
            ],
        ),
        key(
            "contact",
            2.23,
            [
                (Root, [0.0, 81.5, 12.0]),
                (Hips, [2.0, -6.0, -12.0]),
                (Trunk, [10.0, -10.0, -20.0]),
                (Grip, [-6.0, -8.0, 47.0]),
                (Collar(R), [0.0, 12.0, 0.0]),
                (Collar(L), [0.0, 4.0, 0.0]),
                (Foot(R), [46.0, 58.0, 0.0]),
                (Elbow(L), [0.0, 0.0, 5.0]),
                (Elbow(R), [0.0, 0.0, -5.0]),
                (Gaze, MET),
            ],
        ),
        key(
            "extension",
            2.32,
            [
                (Root, [0.0, 82.5, 13.0]),
                (Hips, [-1.0, -6.0, 2.0]),
                (Trunk, [6.0, -8.0, 10.0]),
                (Grip, [16.0, 4.0, 45.0]),
                (Foot(R), [52.0, 70.0, 0.0]),
                (Elbow(L), [0.0, 0.0, 30.0]),
                (Elbow(R), [0.0, 0.0, -30.0]),
            ],
        ),
        key(
            "wrap",
            2.5,
            [
                (Root, [0.0, 83.5, 13.0]),
                (Hips, [-4.0, -4.0, 14.0]),
                (Trunk, [0.0, -4.0, 34.0]),
                (Grip, [26.0, 20.0, 20.0]),
                (Collar(R), [6.0, 20.0, 0.0]),
                (Collar(L), [8.0, -4.0, 0.0]),
                (Foot(R), [56.0, 78.0, 0.0]),
            ],
        ),
        key(
            "finish",
            2.72,
            [
                (Root, [0.0, 84.0, 12.0]),
                (Hips, [-4.0, -3.0, 18.0]),
                (Trunk, [-3.0, -3.0, 40.0]),
                (Grip, [27.0, 25.0, 14.0]),
                (Gaze, [-100.0, 300.0, 1800.0]),
            ],
        ),
    ]
}

fn after() -> Vec<Key> {
    vec![
        key(
            "finish, end of the hold",
            3.15,
            [
                (Root, [0.0, 84.3, 10.0]),
                (Hips, [-3.0, -2.0, 14.0]),
                (Trunk, [-2.0, -2.0, 36.0]),
                (Grip, [26.0, 23.0, 16.0]),
                (Foot(R), [50.0, 70.0, 0.0]),
                (Elbow(L), [0.0, 0.0, 20.0]),
                (Elbow(R), [0.0, 0.0, -20.0]),
                (Gaze, [-100.0, 300.0, 1800.0]),
            ],
        ),
        key(
            "bat comes down",
            3.75,
            [
                (Root, [0.0, 88.0, 0.0]),
                (Hips, [4.0, 0.0, -40.0]),
                (Trunk, [8.0, 0.0, 4.0]),
                (Grip, [4.0, -16.0, 32.0]),
                (Collar(L), [0.0, 4.0, 0.0]),
                (Collar(R), [0.0, 4.0, 0.0]),
                (Foot(R), [6.0, 20.0, 0.0]),
                (Elbow(L), [0.0, 0.0, 0.0]),
                (Elbow(R), [0.0, 0.0, 0.0]),
            ],
        ),
        key(
            "settled",
            4.3,
            [
                (Root, [0.0, 90.0, -3.0]),
                (Hips, [4.0, 0.0, -62.0]),
                (Trunk, [8.0, 0.0, 6.0]),
                (Grip, [2.0, -22.0, 28.0]),
                (Foot(R), [0.0, 12.0, 0.0]),
                (Gaze, PITCHER),
            ],
        ),
    ]
}
