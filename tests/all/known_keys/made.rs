//! Makes clips with a pose on every frame from a few known keys.

use genga::motion::{Body, Channel, Clip, Landmarks, Pose, RowWriter};
use genga::sheet::Source;
use genga::time::{Frame, FrameRate};
use genga_lab::study::Noise;

/// Frames in a koma of the made clips, which have 120 frames per second.
pub(crate) const FRAMES: usize = 5;

/// Share of the travel that is kept: keys come from anywhere in a clip, and a body does not leap across a stage from
/// one to the next.
const TRAVEL: f64 = 0.2;

/// Number of keys in each clip.
const KEYS: usize = 16;

/// Least distance between consecutive keys, in body heights: enough to be worth a drawing.
const APART: f64 = 0.1;

/// Largest distance in the source, in seconds, from one key's pose to the next one's, forwards or backwards.
const NEAR: f64 = 1.0;

/// Largest time by which a joint is early or late at a key, in koma.
const LATE: f64 = 1.0;

/// A seeded pseudo-random generator.
struct Lot(u64);

impl Lot {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.share()
    }
}

/// One of the poses that a clip is made from.
#[derive(Debug, Clone, Copy)]
struct Known {
    /// Place of its pose in the source clip.
    place: f64,
    /// Place of the root's pose: a body does not turn to any direction from one key to the next.
    root: f64,
    /// Koma at which it is reached, and koma for which it is held.
    at: f64,
    hold: f64,
    /// Whether the body is still moving when it gets there.
    is_passed: bool,
}

/// Draws keys 5 to 14 koma apart. About every fifth is held for half a second or more, and every third of the others is
/// passed at speed.
fn known(clip: &Clip, lot: &mut Lot) -> Vec<Known> {
    let (first, last) = (clip.first().0 as f64, clip.last().0 as f64);
    let second = clip.rate().fps();
    let middle = lot.between(first + 0.5 * second, last - 0.5 * second);
    let mut keys: Vec<Known> = Vec::new();
    let mut at = 0.0;
    for number in 0..KEYS {
        let root = lot.between(middle - 0.5 * second, middle + 0.5 * second).floor();
        let before = keys.last().map_or(middle, |key| key.place);
        let near = ((before - NEAR * second).max(first), (before + NEAR * second).min(last));
        let mut place = before;
        for _ in 0..200 {
            place = lot.between(near.0, near.1).floor();
            let is_apart =
                |key: &Known| distance(clip, (key.place, key.root), (place, root)) >= APART;
            if keys.last().is_none_or(is_apart) {
                break;
            }
        }
        let is_held = (1..KEYS - 1).contains(&number) && lot.share() < 0.2;
        let hold = if is_held { lot.between(14.0, 24.0).round() } else { 0.0 };
        let is_passed = !is_held && lot.share() < 1.0 / 3.0;
        keys.push(Known { place, root, at, hold, is_passed });
        at += hold + lot.between(5.0, 14.0).round();
    }
    keys
}

/// Distance between two poses of a clip with little travel, each given by its place and that of its root: root mean
/// square over the joints, in body heights.
fn distance(clip: &Clip, one: (f64, f64), other: (f64, f64)) -> f64 {
    let stands = [one, other].map(|(place, root)| {
        let (mut pose, mut body) = (Pose::rest(clip.skeleton()), Body::new(clip.skeleton()));
        pose.take_place(clip, root);
        let (rotation, translation) = (pose.rotations[0], pose.translations[0]);
        pose.take_place(clip, place);
        (pose.rotations[0], pose.translations[0]) = (rotation, TRAVEL * translation);
        body.place(&pose);
        body.positions().to_vec()
    });
    let ways = stands[0].iter().zip(&stands[1]).map(|(a, b)| a.distance_squared(*b));
    (ways.sum::<f64>() / stands[0].len() as f64).sqrt() / Landmarks::new(clip).height
}

/// Moves a body from known key to known key.
struct Made<'a> {
    from: &'a Clip,
    keys: &'a [Known],
    /// Koma by which each joint reaches each key later than the body as a whole.
    late: Vec<Vec<f64>>,
    /// Whether inbetweens are linear and unsmoothed.
    is_straight: bool,
}

impl Made<'_> {
    /// The source of a joint's pose at a koma.
    fn source(&self, joint: usize, koma: f64) -> Source {
        let keys = self.keys;
        let place = |key: usize| if joint == 0 { keys[key].root } else { keys[key].place };
        let reached = |key: usize| keys[key].at + self.late[joint][key];
        let left = |key: usize| reached(key) + keys[key].hold;
        let Some(before) = (0..keys.len()).rev().find(|key| koma >= reached(*key)) else {
            return Source::At(place(0));
        };
        if koma <= left(before) || before + 1 == keys.len() {
            return Source::At(place(before));
        }
        let share = (koma - left(before)) / (reached(before + 1) - left(before));
        let [out, into] = [before, before + 1].map(|key| f64::from(keys[key].is_passed));
        // A Hermite curve: it starts and ends at rest, or at the mean pace of the segment.
        let (square, cube) = (share * share, share * share * share);
        if self.is_straight {
            return Source::Between { from: place(before), to: place(before + 1), share };
        }
        let share = out * (cube - 2.0 * square + share)
            + into * (cube - square)
            + (3.0 * square - 2.0 * cube);
        Source::Between { from: place(before), to: place(before + 1), share }
    }

    fn clip(&self) -> Clip {
        let skeleton = self.from.skeleton();
        let length = self.keys.last().map_or(0.0, |key| key.at + key.hold) as usize + 3;
        let (frames, channels) = (length * FRAMES, skeleton.channels());
        let mut values = vec![0.0; frames * channels];
        let mut whole = vec![0.0; channels];
        for (id, joint) in skeleton.iter() {
            let mut writer = RowWriter::new(self.from);
            let own = joint.first_channel..joint.first_channel + joint.channels.len();
            for (frame, row) in values.chunks_exact_mut(channels).enumerate() {
                writer.write(self.source(id.0, frame as f64 / FRAMES as f64), &mut whole);
                row[own.clone()].copy_from_slice(&whole[own.clone()]);
            }
        }
        let first = values[..channels].to_vec();
        for row in values.chunks_exact_mut(channels) {
            for (value, first) in row[..3].iter_mut().zip(&first) {
                *value = first + TRAVEL * (*value - first);
            }
        }
        let rate = FrameRate::new(24.0 * FRAMES as f64).expect("a rate");
        let values = if self.is_straight { values } else { smooth(&values, channels) };
        Clip::new(skeleton.clone(), rate, Frame(0), frames, values)
            .expect("a rate and a whole table")
    }
}

/// Averages each channel over a koma: a body has mass, and its speed does not jump.
fn smooth(values: &[f64], channels: usize) -> Vec<f64> {
    let frames = values.len() / channels;
    let mean = |frame: usize, channel: usize| {
        let near = frame.saturating_sub(FRAMES / 2)..(frame + FRAMES / 2 + 1).min(frames);
        let count = near.len() as f64;
        near.map(|frame| values[frame * channels + channel]).sum::<f64>() / count
    };
    (0..frames).flat_map(|frame| (0..channels).map(move |channel| mean(frame, channel))).collect()
}

/// Makes a clip from keys of another. Returns it with the frames of all keys but the first and the last.
pub(crate) fn made(from: &Clip, seed: u64, noise: f64) -> (Clip, Vec<Frame>) {
    let mut lot = Lot(seed);
    let keys = known(from, &mut lot);
    let late = (0..from.skeleton().len())
        .map(|_| keys.iter().map(|_| lot.between(-LATE, LATE)).collect())
        .collect();
    let clip = Made { from, keys: &keys, late, is_straight: false }.clip();
    (Noise { degrees: noise, seed }.on(&clip), frames(&keys))
}

/// Makes a clip of the same keys with a program's inbetweens: linear, and all joints on the same frame.
#[allow(dead_code, reason = "no figure of the pages is made of such clips")]
pub(crate) fn keyed(from: &Clip, seed: u64) -> (Clip, Vec<Frame>) {
    let keys = known(from, &mut Lot(seed));
    let late = vec![vec![0.0; KEYS]; from.skeleton().len()];
    (Made { from, keys: &keys, late, is_straight: true }.clip(), frames(&keys))
}

/// The frames of all keys but the first and the last.
fn frames(keys: &[Known]) -> Vec<Frame> {
    let frame = |koma: f64| Frame((koma * FRAMES as f64).round() as usize);
    let inner = keys[1..KEYS - 1].iter().flat_map(|key| [frame(key.at), frame(key.at + key.hold)]);
    let mut frames: Vec<Frame> = inner.collect();
    frames.dedup();
    frames
}

/// Estimates the noise of a clip in degrees from the third differences of its rotations, which motion hardly has: half
/// of those of a channel are smaller than √20 · 0.67 times its noise. The result is the median of the channels that
/// turn.
pub(crate) fn noise_of(clip: &Clip) -> f64 {
    let rows: Vec<&[f64]> = clip.rows().collect();
    let noise = |channel: usize| {
        let third = |rows: &[&[f64]]| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|row| rows[row][channel]);
            (d - 3.0 * c + 3.0 * b - a).abs()
        };
        middle(rows.windows(4).map(third).collect()) / (20_f64.sqrt() * 0.6745)
    };
    let joints = clip.skeleton().joints.iter();
    let channels = joints.flat_map(|joint| joint.channels.iter().zip(joint.first_channel..));
    let turning = channels.filter(|(channel, _)| matches!(channel, Channel::Rotation(_)));
    middle(turning.map(|(_, at)| noise(at)).filter(|noise| *noise > 0.0).collect())
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
