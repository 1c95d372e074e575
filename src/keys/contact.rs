//! Contacts (接地) as moments for keys: where a foot or a hand comes down, and where it leaves.

use crate::knob::choices;
use crate::motion::{Clip, ContactFinder};
use crate::time::{Clock, Frame};

/// What the begin and the end of a contact are to the keys of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtContacts {
    /// Moments like all others.
    #[default]
    Off,
    /// Candidates, also where nothing turns. Where every koma may fill this changes nothing.
    Candidates,
    /// Keys whatever they save, as the ends of rests are.
    Keys,
}

choices!(AtContacts { Off: "off", Candidates: "candidates", Keys: "keys" });

/// The frames on which contacts of joints that have a say begin and end, in order. One that is there at the
/// sheet's first or last koma only ends or only begins.
pub(crate) fn contact_ends(clip: &Clip, clock: Clock, heard: &[f64]) -> Vec<Frame> {
    let last = clip.rate().koma_from_frames(clip.len(), clock.koma_rate).saturating_sub(1);
    let contacts = ContactFinder::default().find(clip, clock).into_iter();
    let own = contacts.filter(|contact| heard[contact.point.joint.0] > 0.0);
    let ends = own.flat_map(|contact| [*contact.koma.start(), *contact.koma.end()]);
    let inner = ends.filter(|koma| (1..last).contains(koma));
    let mut ends: Vec<Frame> = inner.map(|koma| clock.frame_from_koma(koma)).collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}
