use crate::keys::{Chords, Reference};
use crate::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use crate::time::{Frame, FrameRate};
use glam::DVec3;

/// An arm of one bone that swings about Z, given by its angle in degrees at each frame of 24 fps.
pub(super) fn swing(angles: &[f64]) -> Clip {
    let joint = |name: &str, parent, channels: &[Channel], end_sites| Joint {
        name: name.into(),
        parent,
        offset: DVec3::X,
        channels: channels.to_vec(),
        first_channel: 0,
        end_sites,
    };
    let tip = EndSite { name: "Site".into(), offset: DVec3::X };
    let skeleton = Skeleton {
        joints: vec![
            joint("shoulder", None, &[Channel::Rotation(Axis::Z)], vec![]),
            Joint { first_channel: 1, ..joint("hand", Some(JointId(0)), &[], vec![tip]) },
        ],
    };
    let rate = FrameRate::new(24.0).unwrap();
    Clip::new(skeleton, rate, Frame(0), angles.len(), angles.to_vec()).unwrap()
}

/// Returns the chords of a swing up to so many seconds long.
pub(super) fn chords(swing: &Clip, seconds: f64) -> Chords {
    Chords::new(swing, &Reference::new(swing, swing.clock(24.0)), &[1.0; 2], seconds)
}
