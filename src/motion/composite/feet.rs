//! Keeps standing feet in place (接地): all drawings of one contact have the sole at one position.

use glam::DVec3;

use crate::motion::body::leg::Leg;
use crate::motion::{Body, Build, Clip, Contact, ContactFinder, Point, Pose, landmarks};
use crate::time::Clock;

/// Number of koma before and after a contact over which a foot eases into and out of its held position.
const EASE: f64 = 2.0;

/// The feet of a body and their contacts.
#[derive(Debug, Clone)]
pub(super) struct HeldFeet(Vec<HeldFoot>);

/// A foot that can be held.
#[derive(Debug, Clone)]
struct HeldFoot {
    leg: Leg,
    sole: Point,
    /// Contacts in order of time, without overlap.
    stands: Vec<Stand>,
}

/// A contact of a foot; its ends are places of the source.
#[derive(Debug, Clone, PartialEq)]
struct Stand {
    from: Edge,
    to: Edge,
    /// Held position of the sole.
    at: DVec3,
}

/// The beginning or the end of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Edge {
    place: f64,
    /// Number of frames over which the foot eases in or out.
    ease: f64,
    /// Vector from the sole's position in the source to the held one.
    way: DVec3,
}

impl HeldFeet {
    /// Finds the feet of a clip that stand at some time; `None` if there are none.
    pub(super) fn new(clip: &Clip, clock: Clock) -> Option<Self> {
        let build = Build::new(clip);
        let contacts = ContactFinder::default().find(clip, clock);
        let soles: Vec<Point> = build.landmarks.feet.iter().map(|foot| foot.sole).collect();
        let paths = landmarks::paths(clip, clock, &soles);
        let legs = Leg::both(clip, &build);
        let feet = soles.into_iter().zip(&paths).zip(legs).filter_map(|((sole, path), leg)| {
            let own = contacts.iter().filter(|contact| contact.point == sole);
            Some(HeldFoot { leg: leg?, sole, stands: stands(own, path, clock) })
        });
        let feet: Vec<HeldFoot> = feet.filter(|foot| !foot.stands.is_empty()).collect();
        (!feet.is_empty()).then_some(Self(feet))
    }

    /// Returns the joints that turn to hold the feet.
    pub(super) fn joints(&self) -> Vec<usize> {
        self.0.iter().flat_map(|foot| foot.leg.joints()).collect()
    }
}

/// Collects the contacts of one foot; `path` has one position per koma.
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
    // If two contacts follow closely, each eases only over the gap between them.
    for at in 1..stands.len() {
        let gap = stands[at].from.place - stands[at - 1].to.place;
        let ease = ease.min(gap);
        (stands[at - 1].to.ease, stands[at].from.ease) = (ease, ease);
    }
    stands
}

/// Returns the vector from `sole` to its corrected position in a drawing at `place`: to the held position during a
/// contact, and an eased share of the edge's offset near one.
fn way(stands: &[Stand], place: f64, sole: DVec3) -> DVec3 {
    let after = stands.partition_point(|stand| stand.from.place <= place);
    let before = after.checked_sub(1).map(|at| &stands[at]);
    if let Some(stand) = before.filter(|stand| place <= stand.to.place) {
        return stand.at - sole;
    }
    let leaving = before.map_or(DVec3::ZERO, |stand| stand.to.way_at(place));
    let coming = stands.get(after).map_or(DVec3::ZERO, |stand| stand.from.way_at(place));
    leaving + coming
}

impl Edge {
    /// Returns the eased rest of the offset at a place outside the contact (smoothstep).
    fn way_at(&self, place: f64) -> DVec3 {
        let off = (place - self.place).abs() / self.ease;
        let left = (1.0 - off).max(0.0);
        left * left * (3.0 - 2.0 * left) * self.way
    }
}

/// Holds the feet of poses. Reuses its buffers.
#[derive(Debug, Clone)]
pub(super) struct FootHold<'a> {
    feet: &'a HeldFeet,
    body: Body,
}

impl<'a> FootHold<'a> {
    pub(super) fn new(feet: &'a HeldFeet, clip: &Clip) -> Self {
        Self { feet, body: Body::new(clip.skeleton()) }
    }

    /// Returns the joints that turn to hold the feet.
    pub(super) fn joints(&self) -> Vec<usize> {
        self.feet.joints()
    }

    /// Moves the feet of a drawing's pose to their held positions; `place` gives the place in the source that the
    /// drawing shows for a joint.
    pub(super) fn hold(&mut self, place: impl Fn(usize) -> f64, pose: &mut Pose) {
        self.body.place(pose);
        for foot in &self.feet.0 {
            let sole = foot.sole.position(&self.body);
            let way = way(&foot.stands, place(foot.leg.ankle), sole);
            if way != DVec3::ZERO {
                foot.leg.carry(pose, &self.body, way);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;
    use proptest::prelude::*;

    use super::*;
    use crate::cases::cases;
    use crate::motion::bvh;
    use crate::motion::composite::{Composite, CompositePoser, CompositeRows};
    use crate::sheet::{Feet, RootMotion, Sheet, Source};
    use crate::time::Frame;

    fn kick() -> Clip {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh");
        bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
    }

    fn edge(place: f64, way: f64) -> Edge {
        Edge { place, ease: 2.0, way: DVec3::X * way }
    }

    #[test]
    fn a_sole_comes_to_its_place_and_leaves_it_without_a_jump() {
        let stand = |from: (f64, f64), to: (f64, f64), at: f64| Stand {
            from: edge(from.0, from.1),
            to: edge(to.0, to.1),
            at: DVec3::X * at,
        };
        // While it stands, the source's sole drifts from 4 to 6, then from 20 to 21.
        let stands =
            [stand((10.0, 1.0), (20.0, -1.0), 5.0), stand((23.0, 0.5), (30.0, -0.5), 20.5)];
        let at = |place: f64, sole: f64| way(&stands, place, DVec3::X * sole).x;
        assert_eq!([at(10.0, 4.0), at(15.0, 5.5), at(20.0, 6.0)], [1.0, -0.5, -1.0]);
        assert_eq!(
            [at(8.0, 0.0), at(9.0, 0.0), at(21.0, 0.0)],
            [0.0, 0.5, -0.5],
            "half way at half time"
        );
        assert_eq!(
            [at(22.0, 0.0), at(32.0, 0.0), at(0.0, 0.0), at(99.0, 0.0)],
            [0.25, 0.0, 0.0, 0.0]
        );
        for (edge, sole) in [(10.0, 4.0), (20.0, 6.0), (23.0, 20.0), (30.0, 21.0)] {
            let ways = [-1e-7, 0.0, 1e-7].map(|off| at(edge + off, sole));
            assert!(ways.iter().all(|way| (way - ways[1]).abs() < 1e-6), "{edge}: {ways:?}");
        }
    }

    #[test]
    fn contacts_that_follow_at_once_share_the_time_between_them() {
        let clock = kick().clock(24.0);
        let sole = Point { joint: crate::motion::JointId(0), offset: DVec3::ZERO };
        let contact = |koma| Contact { limb: crate::motion::Limb::Foot, point: sole, koma };
        let path: Vec<DVec3> = (0..9).map(|koma| DVec3::Y * f64::from(koma)).collect();
        let found = stands([contact(0..=2), contact(3..=6)].iter(), &path, clock);
        let koma = clock.frames_in_koma();
        assert_eq!([found[0].from.ease, found[1].to.ease], [2.0 * koma; 2]);
        assert_eq!([found[0].to.ease, found[1].from.ease], [koma; 2]);
        assert_eq!([found[0].at, found[1].from.way], [DVec3::Y, 1.5 * DVec3::Y]);
    }

    /// Returns positions and world rotations of the joints, and positions of the soles.
    fn placed(pose: &Pose, clip: &Clip, feet: &HeldFeet) -> (Vec<DVec3>, Vec<DQuat>, Vec<DVec3>) {
        let mut body = Body::new(clip.skeleton());
        body.place(pose);
        let soles = feet.0.iter().map(|foot| foot.sole.position(&body)).collect();
        (body.positions().to_vec(), body.rotations().to_vec(), soles)
    }

    /// Creates a sheet on ones of some sources.
    fn sheet(clip: &Clip, sources: &[Source], root: RootMotion, feet: Feet) -> Sheet {
        let mut sheet = Sheet { root, feet, ..Sheet::on_ones(clip.clock(24.0), sources.len()) };
        let drawings = sheet.layers[0].drawings.iter_mut();
        drawings.zip(sources).for_each(|(drawing, source)| drawing.source = *source);
        sheet
    }

    fn source() -> impl Strategy<Value = Source> {
        let blend = |(from, to, share)| Source::Between { from, to, share };
        prop_oneof![
            (0.0..400.0).prop_map(Source::At),
            (0u32..400).prop_map(|frame| Source::At(f64::from(frame))),
            (0.0..400.0, 0.0..400.0, 0.0..1.0).prop_map(blend),
        ]
    }

    proptest! {
        #![proptest_config(cases(6, 24))]

        #[test]
        fn a_held_foot_stands_on_its_place_and_nothing_else_gives_way_but_its_leg(
            sources in prop::collection::vec(source(), 1..12),
            ones in any::<bool>(),
        ) {
            let clip = kick();
            let root = if ones { RootMotion::Ones } else { RootMotion::Drawings };
            let [free, held] = [Feet::Free, Feet::Held].map(|feet| sheet(&clip, &sources, root, feet));
            let [free, held] = [&free, &held].map(|sheet| Composite::new(&clip, sheet).unwrap());
            let feet = held.feet.as_ref().unwrap();
            let (mut own, mut posed) = (CompositePoser::new(&free), CompositePoser::new(&held));
            let (mut own_rows, mut rows) = (CompositeRows::new(&free), CompositeRows::new(&held));
            let (mut own_row, mut row) = (vec![0.0; clip.skeleton().channels()], vec![0.0; clip.skeleton().channels()]);
            for (koma, source) in sources.iter().enumerate() {
                let (own, posed) = (own.drawing(koma, koma), posed.drawing(koma, koma));
                own_rows.write(koma, koma, &mut own_row);
                rows.write(koma, koma, &mut row);
                let (before, turned, soles) = placed(own, &clip, feet);
                let (after, now, held_soles) = placed(posed, &clip, feet);
                for (foot, (sole, was)) in feet.0.iter().zip(held_soles.iter().zip(&soles)) {
                    let wanted = was + way(&foot.stands, source.place(), *was);
                    let [hip, knee, ankle] = foot.leg.joints();
                    for bone in [[hip, knee], [knee, ankle]] {
                        let length = |joints: &[DVec3]| joints[bone[0]].distance(joints[bone[1]]);
                        prop_assert!((length(&before) - length(&after)).abs() < 1e-9);
                    }
                    prop_assert!(after[hip].abs_diff_eq(before[hip], 1e-9), "the pelvis stays");
                    prop_assert!(now[ankle].dot(turned[ankle]).abs() > 1.0 - 1e-12, "the foot turns as it did");
                    let reach = before[hip].distance(before[knee]) + before[knee].distance(before[ankle]);
                    let is_stretched = after[hip].distance(after[ankle]) > 0.98 * reach;
                    prop_assert!(is_stretched || sole.abs_diff_eq(wanted, 1e-6), "{sole} {wanted}");
                    if wanted == *was {
                        let joint = &clip.skeleton().joints[hip];
                        let columns = joint.first_channel..joint.first_channel + joint.channels.len();
                        prop_assert_eq!(&row[columns.clone()], &own_row[columns], "the same digits");
                    }
                }
                let mut written = Pose::rest(clip.skeleton());
                written.take_row(clip.skeleton(), &row);
                let legs = feet.joints();
                for joint in 0..clip.skeleton().len() {
                    let [pose, row] = [posed, &written].map(|pose| pose.rotations[joint]);
                    prop_assert!(pose.is_finite() && pose.dot(row).abs() > 1.0 - 1e-9, "as the row has it");
                    prop_assert!(legs.contains(&joint) || pose == own.rotations[joint]);
                }
            }
        }
    }

    #[test]
    fn a_body_without_feet_or_one_that_never_stands_is_as_it_was() {
        let clip = kick();
        let clock = clip.clock(24.0);
        assert!(HeldFeet::new(&clip, clock).is_some());
        let short = clip.trimmed(Frame(0), Frame(1)).unwrap();
        assert!(HeldFeet::new(&short, clock).is_none(), "a frame is too short to stand");
    }
}
