//! A small body for the tests of this room.

use std::sync::Arc;

use glam::DVec3;

use crate::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use crate::quality::KomaFrames;
use crate::time::{Frame, FrameRate};

/// An arm of one bone and a tip that swings about Z, by its angle in degrees at each frame of 24 fps.
pub(super) fn swing(angles: &[f64]) -> Clip {
    let tip = EndSite { name: "Site".into(), offset: DVec3::X };
    let shoulder = Joint {
        name: "shoulder".into(),
        parent: None,
        offset: DVec3::ZERO,
        channels: vec![Channel::Rotation(Axis::Z)],
        first_channel: 0,
        end_sites: vec![],
    };
    let hand = Joint {
        name: "hand".into(),
        parent: Some(JointId(0)),
        offset: DVec3::X,
        channels: vec![],
        first_channel: 1,
        end_sites: vec![tip],
    };
    let skeleton = Skeleton { joints: vec![shoulder, hand] };
    let rate = FrameRate::new(24.0).expect("it is a rate");
    Clip::new(skeleton, rate, Frame(0), angles.len(), angles.to_vec()).expect("a row a frame")
}

/// The grid of [`swing`], a koma a frame.
pub(super) fn grid(angles: &[f64]) -> KomaFrames {
    let clip = Arc::new(swing(angles));
    let clock = clip.clock(24.0);
    KomaFrames::of(clip, clock)
}
