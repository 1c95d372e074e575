//! The parts of a body that act by turning, each with its own measure.

use crate::motion::{Build, above, below};

/// How far a part has to turn to act, in % of body height by its own measure: as far as a whole body would have to go.
pub(super) const SPAN: f64 = 4.0;

/// The least turns that are seen as acting, in degrees.
const HEAD: f64 = 15.0;
const FACE: f64 = 10.0;
const ARM: f64 = 30.0;
const FOREARM: f64 = 40.0;
const HAND: f64 = 30.0;
const FINGER: f64 = 75.0;
const LEG: f64 = 30.0;
const FOOT: f64 = 15.0;

/// What hangs on a head, and on a hand, at the most: some faces have a thousand joints.
const MOST: [usize; 2] = [48, 24];

/// A part of a body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    /// What carries it, and the joints of it that turn on that and on each other.
    pub(crate) chain: Vec<usize>,
    /// How far a turn by one radian counts as moved, in % of body height.
    pub(crate) worth: f64,
}

impl Part {
    /// The joint that carries it, and its last one.
    pub(crate) fn ends(&self) -> [usize; 2] {
        [self.chain[0], self.chain[self.chain.len() - 1]]
    }
}

/// The parts of a person that count; none of any other body, which has no measure of its own. On a screen an arm or a leg is
/// what is seen of it, and its places say that.
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

/// The last joints of all that the body has below one of its joints.
fn ends_below(build: &Build, top: usize) -> impl Iterator<Item = usize> {
    let skeleton = build.members.skeleton();
    let carries = skeleton.carriers();
    below(skeleton, top).filter(move |joint| *joint != top && !carries[*joint])
}
