//! A small body for the tests of this module.

use std::sync::Arc;

use glam::DVec3;

use crate::quality::KomaFrames;
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::time::{Frame, FrameRate};

/// Builds an arm of one bone that swings about Z, from its angle in degrees at each frame of 24 fps.
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

/// Builds the grid of [`swing`], one koma per frame.
pub(super) fn grid(angles: &[f64]) -> KomaFrames {
    let clip = Arc::new(swing(angles));
    let clock = clip.clock(24.0);
    KomaFrames::new(clip, clock)
}
