//! A synthetic motion of any length, so that a benchmark needs no file.

use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::time::{Frame, FrameRate};
use glam::DVec3;

pub(crate) const JOINTS: usize = 31;

/// A clip at 120 frames per second in which five limbs swing at different rates.
pub(crate) fn swinging(frames: usize) -> Clip {
    let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
    let joint = |joint: usize| Joint {
        name: format!("joint_{joint}"),
        parent: (joint > 0).then(|| JointId(if joint % 6 == 1 { 0 } else { joint - 1 })),
        offset: DVec3::new(0.0, 20.0, 3.0),
        channels: rotations.to_vec(),
        first_channel: 3 * joint,
        end_sites: if joint.is_multiple_of(6) {
            vec![EndSite { name: "Site".into(), offset: DVec3::Y }]
        } else {
            vec![]
        },
    };
    let skeleton = Skeleton { joints: (0..JOINTS).map(joint).collect() };
    let angle = |frame: usize, channel: usize| {
        let time = frame as f64 / 120.0;
        let rate = 0.4 + 0.07 * channel as f64;
        30.0 * libm::sin(std::f64::consts::TAU * rate * time)
            * libm::cos(0.3 * time + channel as f64)
    };
    let values = (0..frames)
        .flat_map(|frame| (0..3 * JOINTS).map(move |channel| angle(frame, channel)))
        .collect();
    let rate = FrameRate::new(120.0).expect("a rate");
    Clip::new(skeleton, rate, Frame(0), frames, values).expect("a whole table")
}
