//! Contacts (接地) as moments for keys: a foot or a hand comes down, or leaves.

use crate::knob::choices;
use crate::motion::{Clip, ContactFinder};
use crate::time::{Clock, Frame};

/// How the begin and the end of a contact are treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtContacts {
    /// As moments like all others.
    #[default]
    Off,
    /// As candidates, also where nothing turns. If every koma may fill, this changes nothing.
    Candidates,
    /// As keys whatever they save, like the ends of rests.
    Keys,
}

choices!(AtContacts { Off: "off", Candidates: "candidates", Keys: "keys" });

/// Returns the frames on which contacts of joints with a weight begin and end, in order. A contact during the sheet's
/// first koma only ends, one during the last only begins.
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
