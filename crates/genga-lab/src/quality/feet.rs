//! Sliding feet (足滑り): feet that move while they stand in the source.

use glam::DVec3;
use serde::Serialize;

use genga::keys::DrawnBody;
use genga::motion::Stature;
use genga::sheet::Source;
use genga::signal::{Contact, Limb};
use genga::time::Clock;

/// How far feet slide on the ground while they stand in the source, in % of body height.
///
/// A koma of a contact counts only if the drawing on it shows an instant of that contact. A foot that lands a koma late
/// because of a hold does not slide; its delay is part of the error instead.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Slip {
    /// Number of foot contacts that are shown on two koma or more.
    pub contacts: usize,
    /// The mean over those contacts of how far the foot moves along the ground from where it is first shown; `None`
    /// without a contact.
    pub mean: Option<f64>,
    /// The distance in the worst contact.
    pub worst: Option<f64>,
    /// The mean distance in the source itself over the same koma: a lower bound for anything that shows the source.
    pub source: Option<f64>,
}

impl Slip {
    /// Measures the pose shown at each koma; `contacts` are those of the source.
    pub fn new(
        body: &mut DrawnBody<'_>,
        clock: Clock,
        contacts: &[Contact],
        shown: impl Fn(usize) -> Source,
    ) -> Self {
        let place = |_: &Contact, koma| shown(koma).place();
        Self::of_poses(body, clock, contacts, place, |body, koma| body.take(shown(koma)))
    }

    /// Measures poses: `show` poses the body as shown at a koma, and `place` is the source instant of the foot of a
    /// contact there.
    pub(super) fn of_poses(
        body: &mut DrawnBody<'_>,
        clock: Clock,
        contacts: &[Contact],
        place: impl Fn(&Contact, usize) -> f64,
        mut show: impl FnMut(&mut DrawnBody<'_>, usize),
    ) -> Self {
        let up = Stature::new(body.clip()).up.unit();
        let percent = 100.0 / body.height();
        let (mut slips, mut in_source) = (Vec::new(), Vec::new());
        for contact in contacts.iter().filter(|contact| contact.limb == Limb::Foot) {
            let [begin, end] =
                [contact.koma.start(), contact.koma.end()].map(|koma| clock.place_from_koma(*koma));
            let own = |koma: &usize| (begin..=end).contains(&place(contact, *koma));
            let koma: Vec<usize> = contact.koma.clone().filter(own).collect();
            let foot =
                |body: &DrawnBody<'_>| percent * body.position(contact.point).reject_from(up);
            slips.extend(furthest(koma.iter().map(|koma| {
                show(body, *koma);
                foot(body)
            })));
            in_source.extend(furthest(koma.iter().map(|koma| {
                body.take(Source::At(clock.place_from_koma(*koma)));
                foot(body)
            })));
        }
        Self {
            contacts: slips.len(),
            mean: mean(&slips),
            worst: slips.iter().copied().reduce(f64::max),
            source: mean(&in_source),
        }
    }
}

/// Returns the largest distance of a point from its first place; `None` if the point is seen only once or never.
fn furthest(mut places: impl Iterator<Item = DVec3>) -> Option<f64> {
    let first = places.next()?;
    places.map(|place| first.distance(place)).reduce(f64::max)
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::keys::Reference;
    use genga::motion::Axis;
    use genga::motion::{Channel, Clip, Joint, JointId, Skeleton, landmarks::Point};
    use genga::time::{Frame, FrameRate};

    /// Builds a body of two points that is carried along X; 10 tall.
    fn carried(places: &[f64]) -> Clip {
        let joint = |parent: Option<usize>, channels: Vec<Channel>| Joint {
            name: "joint".into(),
            parent: parent.map(JointId),
            offset: 10.0 * DVec3::Y,
            first_channel: usize::from(channels.is_empty()),
            channels,
            end_sites: vec![],
        };
        let root = joint(None, vec![Channel::Position(Axis::X)]);
        let skeleton = Skeleton { joints: vec![root, joint(Some(0), vec![])] };
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(skeleton, rate, Frame(0), places.len(), places.to_vec()).unwrap()
    }

    fn contact(koma: std::ops::RangeInclusive<usize>, limb: Limb) -> Contact {
        Contact { limb, point: Point { joint: JointId(0), offset: DVec3::ZERO }, koma }
    }

    #[test]
    fn a_foot_slides_by_how_far_it_goes_on_screen_while_it_stands() {
        let clip = carried(&[0.0, 4.0, 8.0, 8.0, 8.0, 8.0, 12.0, 16.0]);
        let reference = Reference::new(&clip, clip.clock(24.0));
        let mut body = DrawnBody::new(&clip, &reference);
        let contacts = [contact(2..=5, Limb::Foot), contact(0..=7, Limb::Hand)];
        let clock = clip.clock(24.0);
        let slip = |body: &mut DrawnBody<'_>, places: [f64; 8]| {
            Slip::new(body, clock, &contacts, |koma| Source::At(places[koma]))
        };
        let ones = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let none = Slip { contacts: 1, mean: Some(0.0), worst: Some(0.0), source: Some(0.0) };
        assert_eq!(slip(&mut body, ones), none);
        // One koma late: the drawings before the contact and the one after it are not counted.
        let late = [0.0, 0.0, 1.0, 1.0, 3.0, 3.0, 5.0, 5.0];
        assert_eq!(slip(&mut body, late), none);
        let blend = |koma: usize| Source::Between { from: 0.0, to: 7.0, share: koma as f64 / 7.0 };
        let slid = Slip::new(&mut body, clock, &contacts, blend);
        let worst = slid.worst.unwrap();
        assert!((worst - 100.0 * (16.0 * 3.0 / 7.0) / 10.0).abs() < 1e-9, "{slid:?}");
        assert_eq!((slid.mean, slid.source), (slid.worst, Some(0.0)));
        assert_eq!(slip(&mut body, [0.0; 8]), Slip::default(), "it is never shown standing");
    }

    #[test]
    fn a_foot_that_slides_in_the_source_says_so_over_the_same_koma() {
        let clip = carried(&[0.0, 4.0, 8.0, 8.5, 9.0, 9.5, 12.0, 16.0]);
        let clock = clip.clock(24.0);
        let reference = Reference::new(&clip, clock);
        let mut body = DrawnBody::new(&clip, &reference);
        let contacts = [contact(2..=5, Limb::Foot)];
        let late = [0.0, 0.0, 1.0, 2.0, 2.0, 3.0, 3.0, 5.0];
        let found = Slip::new(&mut body, clock, &contacts, |koma| Source::At(late[koma]));
        // Koma 3 to 5 are shown: 8, 8 and 8.5 on screen, 8.5 to 9.5 in the source.
        assert_eq!((found.mean, found.source), (Some(5.0), Some(10.0)));
    }
}
