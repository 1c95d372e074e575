//! The notation of an action: named key poses, footsteps, and times at which the hands are together.

/// A side of the body.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Side {
    L,
    R,
}

pub(crate) const SIDES: [Side; 2] = [Side::L, Side::R];

/// A part of the body that a key pose may set to three numbers, in degrees unless stated otherwise.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Part {
    /// Position of the hips: x, y, z in centimetres of the world.
    Root,
    /// Hips: bend forward, lean to the left, turn to the left.
    Hips,
    /// The three spine joints together: bend forward, lean to the left, turn to the left.
    Trunk,
    /// Point that the eyes look at: x, y, z in centimetres of the world.
    Gaze,
    /// Position of joined hands: x, y, z in centimetres from the chest, in the chest's frame.
    Grip,
    /// Collar: raised, forward, unused.
    Collar(Side),
    /// Upper arm: azimuth (0 to the side, 90 to the front), elevation (0 hanging, 90 level),
    /// external rotation (with the arm level: 0 the forearm bends to the front, 90 upwards).
    Arm(Side),
    /// Elbow bend, forearm roll, wrist bend.
    Elbow(Side),
    /// Thigh of a free leg: bend forward, spread, turn outwards.
    Leg(Side),
    /// Free leg: knee bend, toes up at the ankle, toes up.
    Knee(Side),
    /// Standing foot: heel lifted, turned to the left, unused.
    Foot(Side),
}

/// A named key pose: the parts it sets. Other parts are interpolated between neighbouring keys.
pub(crate) struct Key {
    pub(crate) name: &'static str,
    /// Seconds from the start.
    pub(crate) at: f64,
    pub(crate) set: Vec<(Part, [f64; 3])>,
}

pub(crate) fn key<const N: usize>(name: &'static str, at: f64, set: [(Part, [f64; 3]); N]) -> Key {
    Key { name, at, set: set.to_vec() }
}

/// A standing foot: from when to when, where its ball is on the floor, which way it points. Between two of them the
/// foot steps, `lift` centimetres high on its way here.
#[derive(Clone, Copy)]
pub(crate) struct Plant {
    pub(crate) side: Side,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) ball: [f64; 2],
    pub(crate) yaw: f64,
    pub(crate) lift: f64,
}

pub(crate) const fn plant(
    side: Side,
    from: f64,
    to: f64,
    ball: [f64; 2],
    yaw: f64,
    lift: f64,
) -> Plant {
    Plant { side, from, to, ball, yaw, lift }
}

/// A time in which a leg swings by its own angles (or hands grip each other): eased in over `ease_in` seconds after
/// `from`, and out over `ease_out` before `to`.
#[derive(Clone, Copy)]
pub(crate) struct Window {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) ease_in: f64,
    pub(crate) ease_out: f64,
}

pub(crate) const fn window(from: f64, to: f64, ease_in: f64, ease_out: f64) -> Window {
    Window { from, to, ease_in, ease_out }
}

/// One sample motion.
pub(crate) struct Score {
    pub(crate) file: &'static str,
    pub(crate) frames: usize,
    pub(crate) fps: f64,
    pub(crate) seed: u64,
    pub(crate) keys: Vec<Key>,
    pub(crate) plants: Vec<Plant>,
    /// Times at which a leg swings freely.
    pub(crate) swings: Vec<(Side, Window)>,
    /// Times at which the hands are together.
    pub(crate) grips: Vec<Window>,
}
