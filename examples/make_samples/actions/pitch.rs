//! A baseball pitch, right-handed, towards +Z: the omission paper's from the set position, and the genga paper's with a
//! whole wind-up.

use super::score::Part::{Arm, Collar, Elbow, Foot, Gaze, Grip, Hips, Knee, Leg, Root, Trunk};
use super::score::Side::{L, R};
use super::score::{Key, Plant, Score, key, plant, window};

/// Position of the catcher's mitt.
const HOME: [f64; 3] = [0.0, 95.0, 1800.0];
/// Positions of the feet on the rubber, after the stride and after the follow-through.
const PIVOT: [f64; 2] = [-13.0, -14.0];
const STRIDE: [f64; 2] = [-9.0, 112.0];
/// Position of the back foot's toes when they leave the ground, after being dragged.
const DRAG: [f64; 2] = [-12.0, 26.0];
const FIELDING: [f64; 2] = [-42.0, 116.0];

/// 129 frames at 24 fps: set, leg lift, throw, follow-through, ready to field.
pub(crate) fn short() -> Score {
    let mut keys = vec![
        key("set", 0.3, set_pose([0.0, 91.0, 0.0], -92.0)),
        key("set, end of the hold", 1.0, set_pose([0.0, 91.2, 0.0], -92.0)),
        key(
            "sink before the lift",
            1.25,
            [
                (Root, [0.5, 87.5, 3.5]),
                (Hips, [5.0, 0.0, -90.0]),
                (Trunk, [11.0, 0.0, 4.0]),
                (Grip, [0.0, 0.0, 24.0]),
            ],
        ),
    ];
    keys.extend(throw(1.85));
    Score {
        file: "pitch.bvh",
        frames: 129,
        fps: 24.0,
        seed: 0x0129,
        keys,
        plants: throw_steps(1.85, plant(L, 0.0, 1.42, [-13.0, 14.0], -90.0, 0.0), 0.0),
        swings: throw_swings(1.85),
        grips: vec![window(-1.0, 1.85 + 0.62, 0.1, 0.3)],
    }
}

/// 496 frames at 100 fps: wait, wind-up, stride, throw, follow-through, settle.
pub(crate) fn whole() -> Score {
    let mut keys = vec![
        key("wait", 0.2, wait_pose([0.0, 91.4, -2.0])),
        key("wait, end of the hold", 0.55, wait_pose([0.0, 91.6, -2.0])),
        key(
            "rocker step",
            0.95,
            [
                (Root, [2.0, 88.5, -12.0]),
                (Hips, [6.0, 0.0, -12.0]),
                (Trunk, [12.0, 0.0, -2.0]),
                (Grip, [0.0, 0.0, 28.0]),
            ],
        ),
        key(
            "hands overhead",
            1.3,
            [
                (Root, [0.0, 90.0, -9.0]),
                (Hips, [0.0, 0.0, -35.0]),
                (Trunk, [-8.0, 0.0, -6.0]),
                (Grip, [0.0, 52.0, 12.0]),
                (Collar(L), [14.0, 0.0, 0.0]),
                (Collar(R), [14.0, 0.0, 0.0]),
            ],
        ),
        key(
            "pivot",
            1.55,
            [
                (Root, [-1.0, 89.5, -9.0]),
                (Hips, [2.0, 0.0, -80.0]),
                (Trunk, [4.0, 0.0, -6.0]),
                (Grip, [0.0, 30.0, 25.0]),
                (Collar(L), [4.0, 0.0, 0.0]),
                (Collar(R), [4.0, 0.0, 0.0]),
            ],
        ),
    ];
    let lift = 2.0;
    keys.extend(throw(lift));
    let left = [
        plant(L, 0.0, 0.62, [14.0, 11.0], 0.0, 0.0),
        plant(L, 0.92, 1.45, [20.0, -18.0], -25.0, 4.0),
    ];
    let mut plants = throw_steps(lift, left[1], 1.42);
    plants.insert(0, left[0]);
    plants.insert(0, plant(R, 0.0, 1.2, [-14.0, 8.0], -10.0, 0.0));
    Score {
        file: "kuroda-pitch.bvh",
        frames: 496,
        fps: 100.0,
        seed: 0x0496,
        keys,
        plants,
        swings: throw_swings(lift),
        grips: vec![window(-1.0, lift + 0.62, 0.1, 0.3)],
    }
}

fn set_pose(root: [f64; 3], turn: f64) -> [(super::score::Part, [f64; 3]); 5] {
    [
        (Root, root),
        (Hips, [4.0, 0.0, turn]),
        (Trunk, [8.0, 0.0, 4.0]),
        (Grip, [0.0, 2.0, 24.0]),
        (Gaze, HOME),
    ]
}

fn wait_pose(root: [f64; 3]) -> [(super::score::Part, [f64; 3]); 5] {
    [
        (Root, root),
        (Hips, [3.0, 0.0, -6.0]),
        (Trunk, [8.0, 0.0, 0.0]),
        (Grip, [0.0, 3.0, 24.0]),
        (Gaze, HOME),
    ]
}

/// The keys from the leg lift on; `t` is when the knee is at its highest.
fn throw(t: f64) -> Vec<Key> {
    let mut keys = vec![
        key(
            "leg lift",
            t,
            [
                (Root, [1.0, 89.5, -11.0]),
                (Hips, [-6.0, 0.0, -104.0]),
                (Trunk, [12.0, 0.0, -8.0]),
                (Grip, [2.0, 5.0, 24.0]),
                (Leg(L), [102.0, 4.0, 0.0]),
                (Knee(L), [98.0, -18.0, 0.0]),
                (Arm(R), [25.0, 28.0, 10.0]),
                (Elbow(R), [95.0, 0.0, 0.0]),
                (Arm(L), [35.0, 40.0, 20.0]),
                (Elbow(L), [90.0, 0.0, 0.0]),
                (Gaze, HOME),
            ],
        ),
        key(
            "balance",
            t + 0.22,
            [
                (Root, [1.0, 88.0, -7.0]),
                (Hips, [-3.0, 0.0, -105.0]),
                (Leg(L), [94.0, 6.0, 0.0]),
                (Knee(L), [90.0, -15.0, 0.0]),
                (Grip, [1.0, 1.0, 24.0]),
            ],
        ),
        key(
            "hands break",
            t + 0.44,
            [
                (Root, [0.0, 82.0, 8.0]),
                (Hips, [0.0, -4.0, -98.0]),
                (Trunk, [8.0, -8.0, -10.0]),
                (Grip, [0.0, -16.0, 24.0]),
                (Leg(L), [50.0, 34.0, 4.0]),
                (Knee(L), [48.0, 0.0, 0.0]),
                (Foot(R), [0.0, 0.0, 0.0]),
                (Arm(R), [5.0, 25.0, 5.0]),
                (Elbow(R), [55.0, 0.0, 0.0]),
                (Arm(L), [25.0, 45.0, 10.0]),
                (Elbow(L), [60.0, 0.0, 0.0]),
            ],
        ),
        key(
            "arms spread",
            t + 0.66,
            [
                (Root, [-2.0, 77.0, 34.0]),
                (Hips, [2.0, -4.0, -86.0]),
                (Trunk, [4.0, -10.0, -18.0]),
                (Leg(L), [38.0, 52.0, 12.0]),
                (Knee(L), [30.0, 8.0, 10.0]),
                (Foot(R), [18.0, 6.0, 0.0]),
                (Collar(R), [4.0, -8.0, 0.0]),
                (Arm(R), [-22.0, 62.0, -20.0]),
                (Elbow(R), [35.0, 0.0, 0.0]),
                (Arm(L), [8.0, 82.0, -10.0]),
                (Elbow(L), [25.0, 0.0, 0.0]),
            ],
        ),
        key(
            "foot plant",
            t + 0.84,
            [
                (Root, [-4.0, 74.5, 60.0]),
                (Hips, [4.0, -2.0, -58.0]),
                (Trunk, [0.0, -4.0, -40.0]),
                (Foot(R), [42.0, 22.0, 0.0]),
                (Collar(R), [8.0, -12.0, 0.0]),
                (Arm(R), [-24.0, 92.0, 70.0]),
                (Elbow(R), [92.0, 0.0, -15.0]),
                (Arm(L), [10.0, 88.0, 0.0]),
                (Elbow(L), [35.0, 0.0, 0.0]),
            ],
        ),
    ];
    keys.extend(delivery(t + 0.84));
    keys.extend(after(t + 0.84));
    keys
}

/// The fastest third of a second; `t` is when the striding foot lands.
fn delivery(t: f64) -> [Key; 4] {
    [
        key(
            "hips open",
            t + 0.08,
            [
                (Root, [-4.0, 75.0, 69.0]),
                (Hips, [8.0, 0.0, -16.0]),
                (Trunk, [-6.0, 2.0, -52.0]),
                (Arm(R), [-20.0, 95.0, 115.0]),
                (Elbow(R), [100.0, 0.0, -25.0]),
                (Arm(L), [25.0, 75.0, 15.0]),
                (Elbow(L), [75.0, 0.0, 0.0]),
            ],
        ),
        key(
            "arm laid back",
            t + 0.15,
            [
                (Root, [-4.0, 75.5, 75.0]),
                (Hips, [14.0, 2.0, 2.0]),
                (Trunk, [2.0, 12.0, -14.0]),
                (Foot(R), [58.0, 50.0, 0.0]),
                (Collar(R), [8.0, 0.0, 0.0]),
                (Arm(R), [2.0, 96.0, 165.0]),
                (Elbow(R), [88.0, 0.0, -30.0]),
                (Arm(L), [35.0, 55.0, 30.0]),
                (Elbow(L), [110.0, 0.0, 0.0]),
            ],
        ),
        key(
            "release",
            t + 0.21,
            [
                (Root, [-5.0, 76.0, 80.0]),
                (Hips, [22.0, 4.0, 8.0]),
                (Trunk, [22.0, 18.0, 10.0]),
                (Collar(R), [8.0, 12.0, 0.0]),
                (Arm(R), [22.0, 100.0, 100.0]),
                (Elbow(R), [26.0, 0.0, 10.0]),
                (Elbow(L), [118.0, 0.0, 0.0]),
            ],
        ),
        key(
            "arm past release",
            t + 0.28,
            [
                (Root, [-5.0, 76.5, 84.0]),
                (Hips, [32.0, 5.0, 14.0]),
                (Trunk, [38.0, 16.0, 22.0]),
                (Collar(R), [0.0, 20.0, 0.0]),
                (Arm(R), [52.0, 86.0, 42.0]),
                (Elbow(R), [14.0, 0.0, 40.0]),
                (Arm(L), [28.0, 38.0, 25.0]),
            ],
        ),
    ]
}

/// The follow-through to rest; `t` is when the striding foot lands.
fn after(t: f64) -> [Key; 5] {
    [
        key(
            "follow-through",
            t + 0.46,
            [
                (Root, [-7.0, 79.0, 94.0]),
                (Hips, [46.0, 4.0, 26.0]),
                (Trunk, [44.0, 6.0, 26.0]),
                (Foot(R), [62.0, 70.0, 0.0]),
                (Leg(R), [-6.0, 18.0, 4.0]),
                (Knee(R), [58.0, -25.0, 0.0]),
                (Collar(R), [-4.0, 22.0, 0.0]),
                (Arm(R), [100.0, 46.0, 60.0]),
                (Elbow(R), [26.0, 0.0, 25.0]),
                (Arm(L), [-10.0, 42.0, 0.0]),
                (Elbow(L), [95.0, 0.0, 0.0]),
                (Gaze, HOME),
            ],
        ),
        key(
            "trailing leg swings through",
            t + 0.64,
            [(Leg(R), [52.0, 26.0, 4.0]), (Knee(R), [92.0, -5.0, 0.0])],
        ),
        key(
            "trailing foot lands",
            t + 0.8,
            [
                (Root, [-18.0, 83.0, 103.0]),
                (Hips, [28.0, 0.0, 12.0]),
                (Trunk, [28.0, 2.0, 12.0]),
                (Foot(R), [0.0, 0.0, 0.0]),
                (Leg(R), [38.0, 8.0, 4.0]),
                (Knee(R), [42.0, 0.0, 0.0]),
                (Arm(R), [80.0, 26.0, 60.0]),
                (Elbow(R), [45.0, 0.0, 5.0]),
                (Arm(L), [30.0, 30.0, 20.0]),
                (Elbow(L), [80.0, 0.0, 0.0]),
            ],
        ),
        key(
            "ready to field",
            t + 1.3,
            [
                (Root, [-24.0, 80.0, 102.0]),
                (Hips, [22.0, 0.0, 2.0]),
                (Trunk, [22.0, 0.0, 0.0]),
                (Collar(R), [0.0, 4.0, 0.0]),
                (Arm(R), [62.0, 30.0, 50.0]),
                (Elbow(R), [62.0, 0.0, 0.0]),
                (Arm(L), [60.0, 32.0, 45.0]),
                (Elbow(L), [60.0, 0.0, 0.0]),
                (Gaze, [0.0, 60.0, 1800.0]),
            ],
        ),
        key(
            "settled",
            t + 2.0,
            [
                (Root, [-24.0, 90.6, 101.0]),
                (Hips, [6.0, 0.0, 0.0]),
                (Trunk, [8.0, 0.0, 0.0]),
                (Arm(R), [20.0, 14.0, 20.0]),
                (Elbow(R), [22.0, 0.0, 0.0]),
                (Arm(L), [20.0, 15.0, 20.0]),
                (Elbow(L), [30.0, 0.0, 0.0]),
                (Gaze, [0.0, 110.0, 1800.0]),
            ],
        ),
    ]
}

/// The footsteps of a throw: `left` is the left foot's last stand before it, `pivot` the time at which the right foot
/// stands on the rubber.
fn throw_steps(t: f64, left: Plant, pivot: f64) -> Vec<Plant> {
    vec![
        left,
        plant(L, t + 0.84, 9.0, STRIDE, -8.0, 26.0),
        plant(R, pivot, t + 0.62, PIVOT, -90.0, 3.0),
        plant(R, t + 1.08, t + 1.09, DRAG, -90.0, 1.0),
        plant(R, t + 0.84 + 0.8, 9.0, FIELDING, 4.0, 24.0),
    ]
}

fn throw_swings(t: f64) -> Vec<(super::score::Side, super::score::Window)> {
    vec![(L, window(t - 0.46, t + 0.84, 0.34, 0.2)), (R, window(t + 1.05, t + 1.66, 0.16, 0.24))]
}
