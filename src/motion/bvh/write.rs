//! Writes a [`Clip`] as a BVH file.

use std::fmt::Write as _;

use glam::DVec3;

use crate::motion::{Axis, Channel, Clip, Joint, Skeleton};
use crate::time::FrameRate;

/// Tolerance of a written frame time, relative to the true one. Thus 24 frames a second become `0.041667`,
/// which other programs take for exactly 24, and 120 becomes `0.0083333`.
const NEAR: f64 = 1.5e-5;

/// Deepest indentation, so that a chain of n joints does not cost n² tabs.
const MOST_TABS: usize = 32;

/// Writes (書く) a clip as a BVH file: see [`Writer`].
///
/// A rate of one frame a second or less is written too, but BVH readers, this one included, take such a
/// frame time for a rate; [`super::Options::fps`] reads it.
///
/// ```
/// use genga::motion::bvh;
///
/// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
/// let text = bvh::write(&clip);
/// assert_eq!(bvh::read(text.as_bytes())?.clip, clip, "not a digit is lost");
/// # Ok::<(), genga::Error>(())
/// ```
pub fn write(clip: &Clip) -> String {
    let mut writer = Writer::new(clip.skeleton(), clip.rate());
    writer.rows(clip.rows());
    writer.finish()
}

/// Builds a BVH file row by row, so that a held pose can be written repeatedly.
///
/// Names, End Sites, channel orders and numbers are preserved. A number is written as the shortest decimal
/// that reads back as the same `f64`, never with an exponent; −0 becomes 0. The file is indented by tabs;
/// every line ends in LF, the last one too.
#[derive(Debug, Clone)]
pub struct Writer {
    head: String,
    rate: FrameRate,
    /// Indices of a row's values, in the order in which they are written.
    columns: Vec<usize>,
    frames: usize,
    rows: String,
}

impl Writer {
    /// Creates a writer for motions of a skeleton, with no row yet.
    pub fn new(skeleton: &Skeleton, rate: FrameRate) -> Self {
        let mut hierarchy = Hierarchy::new(skeleton);
        hierarchy.write();
        let Hierarchy { text: head, columns, .. } = hierarchy;
        Self { head, rate, columns, frames: 0, rows: String::new() }
    }

    /// Adds a frame: a row of the motion table, with one value per channel of the skeleton.
    ///
    /// # Panics
    /// If the row has another width.
    pub fn row(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.columns.len(), "a row is as wide as the skeleton has channels");
        for (written, &column) in self.columns.iter().enumerate() {
            if written > 0 {
                self.rows.push(' ');
            }
            push_number(&mut self.rows, row[column]);
        }
        self.rows.push('\n');
        self.frames += 1;
    }

    /// Adds several frames.
    ///
    /// # Panics
    /// If a row has another width.
    pub fn rows<'a>(&mut self, rows: impl IntoIterator<Item = &'a [f64]>) {
        for row in rows {
            self.row(row);
        }
    }

    /// Returns the text of the file.
    pub fn finish(self) -> String {
        let mut text = self.head;
        let time = frame_time(self.rate);
        text.push_str("MOTION\n");
        put(&mut text, format_args!("Frames: {}\nFrame Time: {time}\n", self.frames));
        text.push_str(&self.rows);
        text
    }
}

/// Builder of the HIERARCHY text; children directly follow their parent, as the format requires.
struct Hierarchy<'a> {
    skeleton: &'a Skeleton,
    children: Vec<Vec<usize>>,
    text: String,
    columns: Vec<usize>,
}

/// A remaining step of writing the joints.
enum Task {
    Open(usize, usize),
    Close(usize),
}

impl<'a> Hierarchy<'a> {
    fn new(skeleton: &'a Skeleton) -> Self {
        let mut children = vec![Vec::new(); skeleton.len()];
        for (joint, data) in skeleton.iter() {
            if let Some(parent) = data.parent {
                children[parent.0].push(joint.0);
            }
        }
        Self { skeleton, children, text: "HIERARCHY\n".to_owned(), columns: Vec::new() }
    }

    fn write(&mut self) {
        let roots = self.skeleton.iter().rev().filter(|(_, joint)| joint.parent.is_none());
        let mut tasks: Vec<_> = roots.map(|(joint, _)| Task::Open(joint.0, 0)).collect();
        while let Some(task) = tasks.pop() {
            match task {
                Task::Open(joint, depth) => {
                    self.open(&self.skeleton.joints[joint], depth);
                    tasks.push(Task::Close(depth));
                    let children = self.children[joint].iter().rev();
                    tasks.extend(children.map(|&child| Task::Open(child, depth + 1)));
                }
                Task::Close(depth) => self.line(depth, format_args!("}}")),
            }
        }
    }

    fn open(&mut self, joint: &Joint, depth: usize) {
        let keyword = if joint.parent.is_some() { "JOINT" } else { "ROOT" };
        self.line(depth, format_args!("{keyword} {}", joint.name));
        self.line(depth, format_args!("{{"));
        self.offset(joint.offset, depth + 1);
        self.channels(joint, depth + 1);
        for end in &joint.end_sites {
            self.line(
                depth + 1,
                format_args!("{}", format!("End {}", end.name).trim_end_matches(' ')),
            );
            self.line(depth + 1, format_args!("{{"));
            self.offset(end.offset, depth + 2);
            self.line(depth + 1, format_args!("}}"));
        }
    }

    fn offset(&mut self, offset: DVec3, depth: usize) {
        self.indent(depth);
        self.text.push_str("OFFSET");
        for value in offset.to_array() {
            self.text.push(' ');
            push_number(&mut self.text, value);
        }
        self.text.push('\n');
    }

    fn channels(&mut self, joint: &Joint, depth: usize) {
        self.indent(depth);
        put(&mut self.text, format_args!("CHANNELS {}", joint.channels.len()));
        for (place, channel) in joint.channels.iter().enumerate() {
            self.text.push(' ');
            self.text.push_str(channel_name(*channel));
            self.columns.push(joint.first_channel + place);
        }
        self.text.push('\n');
    }

    fn line(&mut self, depth: usize, line: std::fmt::Arguments) {
        self.indent(depth);
        put(&mut self.text, line);
        self.text.push('\n');
    }

    fn indent(&mut self, depth: usize) {
        self.text.extend(std::iter::repeat_n('\t', depth.min(MOST_TABS)));
    }
}

fn channel_name(channel: Channel) -> &'static str {
    match channel {
        Channel::Position(Axis::X) => "Xposition",
        Channel::Position(Axis::Y) => "Yposition",
        Channel::Position(Axis::Z) => "Zposition",
        Channel::Rotation(Axis::X) => "Xrotation",
        Channel::Rotation(Axis::Y) => "Yrotation",
        Channel::Rotation(Axis::Z) => "Zrotation",
    }
}

/// Formats a frame time as the shortest decimal near the true one that reads back as the same rate.
fn frame_time(rate: FrameRate) -> String {
    let seconds = 1.0 / rate.fps();
    let reads_back = |text: &String| {
        let read = text.parse().unwrap_or(0.0);
        let near = (read - seconds).abs() <= NEAR * seconds;
        near && FrameRate::from_frame_time(read).is_ok_and(|again| again == rate)
    };
    // 1/(1/rate) may miss the rate by the last digit; then a neighbouring value is the one from which the
    // rate came.
    let near = [seconds, seconds.next_up(), seconds.next_down()].map(|time| format!("{time}"));
    let texts = (1..=24).map(|places| format!("{seconds:.places$}")).chain(near);
    texts.into_iter().find(reads_back).unwrap_or_else(|| format!("{seconds}"))
}

/// Appends the shortest decimal that reads back as the same number.
fn push_number(text: &mut String, value: f64) {
    // Adding 0 turns −0 into 0 and changes nothing else.
    put(text, format_args!("{}", value + 0.0));
}

fn put(text: &mut String, what: std::fmt::Arguments) {
    text.write_fmt(what).expect("a String takes any text");
}
