//! Reading and writing BVH: bytes a second on files in memory.

use divan::Bencher;
use divan::counter::BytesCount;
use genga::motion::{Axis, Channel, Clip, Joint, JointId, Skeleton, bvh};
use genga::time::{Frame, FrameRate};

const JOINTS: usize = 31;
const FRAMES: [usize; 3] = [129, 5_000, 100_000];

fn main() {
    divan::main();
}

/// A chain of joints that swing, with as many decimals as motion capture files have.
fn clip(frames: usize) -> Clip {
    let rotations = [Axis::Z, Axis::Y, Axis::X].map(Channel::Rotation);
    let positions = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
    let joint = |joint: usize| Joint {
        name: format!("joint{joint}"),
        parent: joint.checked_sub(1).map(JointId),
        offset: glam::DVec3::Y,
        channels: if joint == 0 { [positions, rotations].concat() } else { rotations.to_vec() },
        first_channel: if joint == 0 { 0 } else { 3 + 3 * joint },
        end_sites: vec![],
    };
    let skeleton = Skeleton { joints: (0..JOINTS).map(joint).collect() };
    let channels = skeleton.channels();
    let value = |at: usize| {
        let (frame, channel) = ((at / channels) as f64, (at % channels) as f64);
        (60e4 * libm::sin(0.02 * frame + channel)).round() / 1e4
    };
    let values = (0..frames * channels).map(value).collect();
    let rate = FrameRate::new(120.0).expect("120 is a rate");
    Clip::new(skeleton, rate, Frame(0), frames, values).expect("the table has that shape")
}

#[divan::bench(args = FRAMES, max_time = 3)]
fn read(bencher: Bencher, frames: usize) {
    let text = bvh::write(&clip(frames));
    bencher.counter(BytesCount::of_str(&text)).bench_local(|| bvh::read(text.as_bytes()));
}

#[divan::bench(args = FRAMES, max_time = 3)]
fn write(bencher: Bencher, frames: usize) {
    let clip = clip(frames);
    let bytes = BytesCount::of_str(&bvh::write(&clip));
    bencher.counter(bytes).bench_local(|| bvh::write(&clip));
}
