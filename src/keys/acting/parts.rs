//! The parts of a body that act by turning, each measured on its own scale.

use crate::motion::{Build, above, below};

/// Distance a part has to turn to act, in % of body height on its own scale: as far as a whole body would have to move.
pub(super) const SPAN: f64 = 4.0;

/// Least turns that are seen as acting, in degrees.
const HEAD: f64 = 15.0;
const FACE: f64 = 10.0;
const ARM: f64 = 30.0;
const FOREARM: f64 = 40.0;
const HAND: f64 = 30.0;
const FINGER: f64 = 75.0;
const LEG: f64 = 30.0;
const FOOT: f64 = 15.0;

/// Most face parts of a head, and most finger parts of a hand: some faces have a thousand joints.
const MOST: [usize; 2] = [48, 24];

/// A part of a body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    /// The joint that carries it, then its own joints, each turning on the one before.
    pub(crate) chain: Vec<usize>,
    /// Movement that a turn by one radian counts as, in % of body height.
    pub(crate) worth: f64,
}

impl Part {
    /// Returns the joint that carries it, and its last one.
    pub(crate) fn ends(&self) -> [usize; 2] {
        [self.chain[0], self.chain[self.chain.len() - 1]]
    }
}

/// Returns the parts of a person that have a weight. Other bodies have no parts, because nothing gives their scale. On
/// a screen, arms and legs are left out (hands and feet are not): their positions show what is seen of them.
pub(super) fn parts(build: &Build, own: &[f64], is_world: bool) -> Vec<Part> {
    let Some(mannequin) = &build.mannequin else { return Vec::new() };
    let skeleton = build.members.skeleton();
    let mut parts = Vec::new();
    let mut add = |base: usize, tip: usize, degrees: f64| {
        let up = above(skeleton, tip).take_while(|joint| *joint != base);
        let mut chain: Vec<usize> = up.chain([base]).collect();
        chain.reverse();
        if base != tip && own[tip] > 0.0 {
            parts.push(Part { chain, worth: SPAN / degrees.to_radians() });
        }
    };
    let head = mannequin.head();
    add(mannequin.chest(), head, HEAD);
    ends_below(build, head).take(MOST[0]).for_each(|end| add(head, end, FACE));
    for [upper, middle, lower] in mannequin.arms() {
        if is_world {
            add(mannequin.chest(), upper, ARM);
            add(upper, middle, FOREARM);
        }
        add(middle, lower, HAND);
        ends_below(build, lower).take(MOST[1]).for_each(|end| add(lower, end, FINGER));
    }
    for [upper, middle, lower] in mannequin.legs() {
        if let Some(hips) = skeleton.joints[upper].parent.filter(|_| is_world) {
            add(hips.0, upper, LEG);
            add(upper, middle, LEG);
        }
        add(middle, lower, FOOT);
    }
    parts
}

/// Returns the last joint of each chain that the body has below a joint.
fn ends_below(build: &Build, top: usize) -> impl Iterator<Item = usize> {
    let skeleton = build.members.skeleton();
    let carries = skeleton.carriers();
    below(skeleton, top).filter(move |joint| *joint != top && !carries[*joint])
}
