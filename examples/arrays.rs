//! A clip from your own arrays, and the BVH it is: `cargo run --example arrays`.

#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "for people")]

use std::error::Error;

use genga::edits::Edits;
use genga::glam::DVec3;
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, FrameRate};

fn joint(name: &str, parent: Option<usize>, offset: DVec3, first_channel: usize) -> Joint {
    let channels = vec![Channel::Rotation(Axis::Z)];
    let end_sites = vec![EndSite { name: "Site".into(), offset: DVec3::NEG_Y * 30.0 }];
    let parent = parent.map(JointId);
    Joint { name: name.into(), parent, offset, channels, first_channel, end_sites }
}

fn main() -> Result<(), Box<dyn Error>> {
    let joints = vec![
        joint("UpperArm", None, DVec3::Y * 140.0, 0),
        joint("ForeArm", Some(0), DVec3::NEG_Y * 30.0, 1),
    ];
    // One row per frame, one column per channel, in degrees: an arm that waves, its forearm lagging behind.
    let wave = |frame: usize| f64::to_radians(6.0 * frame as f64).sin();
    let rows =
        (0..120).flat_map(|frame| [60.0 * wave(frame), 30.0 * wave(frame.saturating_sub(8))]);
    let clip =
        Clip::new(Skeleton { joints }, FrameRate::new(60.0)?, Frame(0), 120, rows.collect())?;

    println!("{} lines of BVH", bvh::write(&clip).lines().count());
    let mut engine = Engine::new(clip)?;
    let found = engine.find_keys(&Recipe::default(), &Edits::default())?;
    let frames = found.keys.keys.iter().map(|key| key.frame.to_string());
    println!("genga on frames {}", frames.collect::<Vec<_>>().join(", "));
    Ok(())
}
