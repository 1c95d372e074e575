//! Feet that stay where they stand (接地): in the drawings of one contact a sole is on one place.

use glam::DVec3;

use crate::motion::leg::Leg;
use crate::motion::{Body, Clip, Contact, ContactFinder, Landmarks, Point, Pose, landmarks};
use crate::time::Clock;

/// Koma before and after a contact in which a foot comes to its place and leaves it.
const EASE: f64 = 2.0;

/// The feet of a body and where they stand.
#[derive(Debug, Clone)]
pub(super) struct HeldFeet(Vec<HeldFoot>);

/// A foot that can be held.
#[derive(Debug, Clone)]
struct HeldFoot {
    leg: Leg,
    sole: Point,
    /// By time; none overlaps another.
    stands: Vec<Stand>,
}

/// A contact, in places of the source.
#[derive(Debug, Clone, PartialEq)]
struct Stand {
    from: Edge,
    to: Edge,
    /// Where the sole is held.
    at: DVec3,
}

/// The begin or the end of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Edge {
    place: f64,
    /// Over how many frames the foot comes here or leaves.
    ease: f64,
    /// From where the source has the sole to where it is held.
    way: DVec3,
}

impl HeldFeet {
    /// The feet of a clip that stand at some time; none where nothing can be held.
    pub(super) fn of(clip: &Clip, clock: Clock) -> Option<Self> {
        let found = Landmarks::of(clip);
        let contacts = ContactFinder::default().find(clip, clock);
        let soles: Vec<Point> = found.feet.iter().map(|foot| foot.sole).collect();
        let paths = landmarks::paths(clip, clock, &soles);
        let legs = Leg::both(clip, &found);
        let feet = soles.into_iter().zip(&paths).zip(legs).filter_map(|((sole, path), leg)| {
            let own = contacts.iter().filter(|contact| contact.point == sole);
            Some(HeldFoot { leg: leg?, sole, stands: stands(own, path, clock) })
        });
        let feet: Vec<HeldFoot> = feet.filter(|foot| !foot.stands.is_empty()).collect();
        (!feet.is_empty()).then_some(Self(feet))
    }

    /// The joints that are turned to hold them.
    pub(super) fn joints(&self) -> Vec<usize> {
        self.0.iter().flat_map(|foot| foot.leg.joints()).collect()
    }
}

/// The contacts of one foot, whose path is given koma by koma.
fn stands<'a>(
    contacts: impl Iterator<Item = &'a Contact>,
    path: &[DVec3],
    clock: Clock,
) -> Vec<Stand> {
    let ease = EASE * clock.frames_in_koma();
    let stand = |contact: &Contact| {
        let places = &path[contact.koma.clone()];
        let at = places.iter().sum::<DVec3>() / places.len() as f64;
        let edge =
            |koma: usize| Edge { place: clock.place_from_koma(koma), ease, way: at - path[koma] };
        Stand { from: edge(*contact.koma.start()), to: edge(*contact.koma.end()), at }
    };
    let mut stands: Vec<Stand> = contacts.map(stand).collect();
    // Between two contacts that follow at once there is no time for both.
    for at in 1..stands.len() {
        let gap = stands[at].from.place - stands[at - 1].to.place;
        let ease = ease.min(gap);
        (stands[at - 1].to.ease, stands[at].from.ease) = (ease, ease);
    }
    stands
}

impl HeldFoot {
    /// How far the foot is to be brought in a drawing of an instant in which its sole is somewhere: to where
    /// it is held, and near a contact some of the way that it goes at its begin or end.
    fn way(&self, place: f64, sole: DVec3) -> DVec3 {
        let after = self.stands.partition_point(|stand| stand.from.place <= place);
        let (before, after) =
            (after.checked_sub(1).map(|at| &self.stands[at]), self.stands.get(after));
        match before {
            Some(stand) if place <= stand.to.place => stand.at - sole,
            before => {
                let leaving = before.map_or(DVec3::ZERO, |stand| stand.to.way_at(place));
                let coming = after.map_or(DVec3::ZERO, |stand| stand.from.way_at(place));
                leaving + coming
            }
        }
    }
}

impl Edge {
    /// What is left of its way at a place outside of the contact.
    fn way_at(&self, place: f64) -> DVec3 {
        let off = (place - self.place).abs() / self.ease;
        let left = (1.0 - off).max(0.0);
        left * left * (3.0 - 2.0 * left) * self.way
    }
}

/// Holds the feet of poses, with its buffers.
#[derive(Debug, Clone)]
pub(super) struct FootHold<'a> {
    feet: &'a HeldFeet,
    body: Body,
    positions: Vec<DVec3>,
}

impl<'a> FootHold<'a> {
    pub(super) fn of(feet: &'a HeldFeet, clip: &Clip) -> Self {
        let positions = vec![DVec3::ZERO; clip.skeleton().len()];
        Self { feet, body: Body::new(clip.skeleton()), positions }
    }

    /// The joints that are turned to hold them.
    pub(super) fn joints(&self) -> Vec<usize> {
        self.feet.joints()
    }

    /// Brings the feet of a drawing's pose to where they are held; `place` is the instant that it shows of
    /// a joint.
    pub(super) fn hold(&mut self, place: impl Fn(usize) -> f64, pose: &mut Pose) {
        self.body.place(pose, &mut self.positions);
        for foot in &self.feet.0 {
            let sole = foot.sole.position(&self.body, &self.positions);
            let way = foot.way(place(foot.leg.ankle), sole);
            if way != DVec3::ZERO {
                foot.leg.carry(pose, &self.body, &self.positions, way);
            }
        }
    }
}
