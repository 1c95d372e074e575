//! A motion clip: a skeleton and one flat table of channel values, frame after frame.

mod beside;
mod camera_path;
mod channels;
mod declared;
mod kinematics;
pub(crate) mod lane_poser;
mod poser;
pub(crate) mod rig;
mod skeleton;

pub use beside::Beside;
pub use camera_path::{CameraPath, CameraPose, Lens};
pub use channels::{RowWriter, set_local_rotation};
pub(crate) use channels::{rotation_axes, turn_columns};
pub use declared::{Declared, Word};
pub use kinematics::{Body, Pose, local_rotation, local_translation};
pub use poser::Poser;
pub use skeleton::{Channel, EndSite, Joint, JointId, Skeleton};

use std::sync::{Arc, OnceLock};

use crate::error::Error;
use crate::time::{Clock, Frame, FrameRate};

/// Largest absolute value in a motion: beyond it, sums of squared distances could overflow.
const LARGEST: f64 = 1e12;

/// A motion clip (モーション). The values are kept as written and never converted, so that a drawing of a source frame is
/// written back as the same numbers.
///
/// Two clips are equal if their values are; what is [declared](Declared) of them or stands [beside](Beside) the body does
/// not count.
#[derive(Debug, Clone)]
pub struct Clip {
    skeleton: Skeleton,
    rate: FrameRate,
    first: Frame,
    frames: usize,
    values: Vec<f64>,
    declared: Declared,
    beside: Option<Arc<Beside>>,
    /// Range of each column, computed on first use.
    ranges: OnceLock<Vec<f64>>,
}

impl PartialEq for Clip {
    fn eq(&self, other: &Self) -> bool {
        let shape = |clip: &Self| (clip.rate, clip.first, clip.frames);
        shape(self) == shape(other)
            && self.skeleton == other.skeleton
            && self.values == other.values
    }
}

impl Clip {
    /// Creates a clip from a table of `frames` rows, each as wide as the skeleton has channels.
    ///
    /// `first` is the number of the table's first row in its file.
    ///
    /// # Errors
    ///
    /// [`Error::Clip`] if the table does not have that shape or holds a value that is not finite.
    pub fn new(
        skeleton: Skeleton,
        rate: FrameRate,
        first: Frame,
        frames: usize,
        values: Vec<f64>,
    ) -> Result<Self, Error> {
        let channels = skeleton.channels();
        if values.len() != frames * channels {
            let found = values.len();
            return Err(Error::clip(format!(
                "{frames} frames of {channels} channels need {} values, found {found}",
                frames * channels
            )));
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            let frame = first.0 + at / channels;
            return Err(Error::clip(format!("frame {frame} holds a value that is not a number")));
        }
        Ok(Self::of_finite(skeleton, rate, first, frames, values))
    }

    /// Creates a clip from a table that is known to have that shape and only finite values: a reader that checked
    /// each value need not check again.
    pub(crate) fn of_finite(
        skeleton: Skeleton,
        rate: FrameRate,
        first: Frame,
        frames: usize,
        values: Vec<f64>,
    ) -> Self {
        debug_assert_eq!(values.len(), frames * skeleton.channels());
        debug_assert!(values.iter().all(|value| value.is_finite()));
        let (declared, ranges) = (Declared::default(), OnceLock::new());
        Self { skeleton, rate, first, frames, values, declared, beside: None, ranges }
    }

    /// Checks that no value exceeds 10¹², so that computations cannot overflow.
    ///
    /// # Errors
    /// [`Error::Clip`] naming the frame or the joint.
    pub fn check_size(&self) -> Result<(), Error> {
        let channels = self.skeleton.channels();
        // A pass over all values is cheaper than stopping at the first large one: usually there is none.
        if self.values.iter().fold(false, |any, value| any | (value.abs() > LARGEST))
            && let Some(at) = self.values.iter().position(|value| value.abs() > LARGEST)
        {
            let (frame, value) = (self.first.0 + at / channels, self.values[at]);
            return Err(Error::clip(format!("frame {frame} holds {value:e}, which is no motion")));
        }
        let is_wild = |length: &f64| length.is_nan() || length.abs() > LARGEST;
        let wild = |joint: &&Joint| {
            let tips = joint.end_sites.iter().map(|tip| tip.offset);
            tips.chain([joint.offset]).any(|offset| offset.to_array().iter().any(is_wild))
        };
        match self.skeleton.joints.iter().find(wild) {
            Some(joint) => {
                Err(Error::clip(format!("the offset of {} or of its tip is no length", joint.name)))
            }
            None => Ok(()),
        }
    }

    /// The joints.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Frames per second.
    pub fn rate(&self) -> FrameRate {
        self.rate
    }

    /// Number of the first row in the file.
    pub fn first(&self) -> Frame {
        self.first
    }

    /// Number of the last row in the file; that of the first for an empty clip.
    pub fn last(&self) -> Frame {
        Frame(self.first.0 + self.frames.saturating_sub(1))
    }

    /// Number of frames.
    pub fn len(&self) -> usize {
        self.frames
    }

    /// Whether the clip is empty.
    pub fn is_empty(&self) -> bool {
        self.frames == 0
    }

    /// Returns the seconds from the first frame to the last: (F − 1)/rate.
    pub fn seconds(&self) -> f64 {
        self.frames.saturating_sub(1) as f64 / self.rate.fps()
    }

    /// Returns the channel values of a frame, as wide as the skeleton has channels.
    ///
    /// # Panics
    ///
    /// If the clip lacks the frame.
    pub fn row(&self, frame: Frame) -> &[f64] {
        let channels = self.skeleton.channels();
        let row = frame.0 - self.first.0;
        &self.values[row * channels..(row + 1) * channels]
    }

    /// Returns all rows in order, each as wide as the skeleton has channels.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        let channels = self.skeleton.channels();
        (0..self.frames).map(move |row| &self.values[row * channels..(row + 1) * channels])
    }

    /// Whether the clip contains a frame.
    pub fn contains(&self, frame: Frame) -> bool {
        (self.first.0..self.first.0 + self.frames).contains(&frame.0)
    }

    /// Finds the joints that move: those with a channel whose value changes.
    pub(crate) fn moving_joints(&self) -> Vec<bool> {
        let changes = self.changing_channels();
        let columns = |joint: &Joint| {
            let first = joint.first_channel;
            first..first + joint.channels.len()
        };
        self.skeleton.joints.iter().map(|joint| changes[columns(joint)].contains(&true)).collect()
    }

    /// Finds the joints that turn: those with a rotation channel whose value changes.
    pub(crate) fn turning_joints(&self) -> Vec<bool> {
        let changes = self.changing_channels();
        let turns = |joint: &Joint| {
            let channels = joint.channels.iter().zip(&changes[joint.first_channel..]);
            channels
                .into_iter()
                .any(|(channel, changes)| matches!(channel, Channel::Rotation(_)) && *changes)
        };
        self.skeleton.joints.iter().map(turns).collect()
    }

    /// Finds the columns of the table whose value changes.
    pub(crate) fn changing_channels(&self) -> Vec<bool> {
        self.ranges().iter().map(|range| *range > 0.0).collect()
    }

    /// Returns the range of each column, its largest value minus its smallest; 0 if there is no frame.
    pub(crate) fn ranges(&self) -> &[f64] {
        self.ranges.get_or_init(|| {
            let first = self.rows().next().map_or_else(Vec::new, <[f64]>::to_vec);
            let (mut lows, mut highs) = (first.clone(), first);
            for row in self.rows() {
                for ((low, high), value) in lows.iter_mut().zip(&mut highs).zip(row) {
                    // No value is NaN, and the compiler vectorizes a plain comparison.
                    *low = if value < low { *value } else { *low };
                    *high = if value > high { *value } else { *high };
                }
            }
            lows.resize(self.skeleton.channels(), 0.0);
            highs.resize(self.skeleton.channels(), 0.0);
            highs.iter().zip(lows).map(|(high, low)| high - low).collect()
        })
    }

    /// Returns a copy in which only the joints in `moves` move; the others keep their pose of the first frame.
    pub(crate) fn with_others_still(&self, moves: &[bool]) -> Self {
        let mut clip = Self { ranges: OnceLock::new(), ..self.clone() };
        let Some(first) = self.rows().next() else { return clip };
        let channels = self.skeleton.channels();
        for (joint, _) in self.skeleton.joints.iter().zip(moves).filter(|(_, moves)| !**moves) {
            let columns = joint.first_channel..joint.first_channel + joint.channels.len();
            for row in clip.values.chunks_exact_mut(channels.max(1)) {
                row[columns.clone()].copy_from_slice(&first[columns.clone()]);
            }
        }
        clip
    }

    /// Returns the clock of a sheet of this clip: koma 0 shows its first frame.
    ///
    /// ```
    /// let clip = genga::motion::bvh::open("data/kuroda-pitch.bvh".as_ref())?.clip;
    /// assert_eq!(clip.rate().fps(), 100.0);
    /// assert_eq!(clip.clock(24.0).place_from_koma(6), 25.0);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn clock(&self, koma_rate: f64) -> Clock {
        Clock { first: self.first, frame_rate: self.rate, koma_rate }
    }

    /// Keeps only the frames `begin..end`, numbered as in the file. They keep their numbers.
    ///
    /// # Errors
    ///
    /// [`Error::Clip`] if a bound lies outside the clip or the range is empty.
    pub fn trimmed(mut self, begin: Frame, end: Frame) -> Result<Self, Error> {
        let (first, past) = (self.first.0, self.first.0 + self.frames);
        if begin > end {
            let message = format!("cannot keep frames {begin}..{end}: it ends before it begins");
            return Err(Error::clip(message));
        }
        if begin == end {
            return Err(Error::clip(format!(
                "cannot keep frames {begin}..{end}: it is empty, for the last number is not included; {begin}..{} is \
                 one frame",
                begin.0 + 1
            )));
        }
        if begin.0 < first || end.0 > past {
            return Err(Error::clip(format!(
                "cannot keep frames {begin}..{end}: the clip has frames {first} to {}",
                past - 1
            )));
        }
        let channels = self.skeleton.channels();
        self.values.truncate((end.0 - first) * channels);
        self.values.drain(..(begin.0 - first) * channels);
        self.frames = end.0 - begin.0;
        self.first = begin;
        self.ranges = OnceLock::new();
        Ok(self)
    }

    /// Returns a clip with the same joints and frames but other values, in rows as wide as before.
    ///
    /// # Panics
    ///
    /// If the number of values differs.
    pub fn with_values(&self, values: Vec<f64>) -> Self {
        assert_eq!(values.len(), self.values.len(), "as many values as before");
        let new =
            Self::of_finite(self.skeleton.clone(), self.rate, self.first, self.frames, values);
        new.with_declared(self.declared).with_beside_of(self)
    }

    /// What the file holds beside the body; `None` if nothing.
    pub fn beside(&self) -> Option<&Beside> {
        self.beside.as_deref()
    }

    /// Takes over what the file of another clip holds beside the body. Both have the same frames.
    pub fn with_beside_of(self, other: &Self) -> Self {
        Self { beside: other.beside.clone(), ..self }
    }

    /// Replaces what the file holds beside the body. Its frames are those of the file.
    pub fn with_beside(self, beside: Beside) -> Self {
        Self { beside: Some(Arc::new(beside)), ..self }
    }

    /// Facts about the motion that a file or a person declares.
    pub fn declared(&self) -> Declared {
        self.declared
    }

    /// Replaces the declared facts.
    pub fn with_declared(mut self, declared: Declared) -> Self {
        self.declared = declared;
        self
    }

    /// Replaces the frame rate; the frames stay.
    pub fn with_rate(mut self, rate: FrameRate) -> Self {
        self.rate = rate;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Axis, Channel};

    fn clip(values: &[f64]) -> Result<Clip, Error> {
        let root = Joint {
            name: "root".into(),
            parent: None,
            offset: glam::DVec3::ZERO,
            channels: vec![Channel::Rotation(Axis::X)],
            first_channel: 0,
            end_sites: vec![],
        };
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(Skeleton { joints: vec![root] }, rate, Frame(0), 4, values.to_vec())
    }

    #[test]
    fn a_table_of_another_shape_or_with_a_nan_is_refused() {
        assert!(clip(&[0.0; 3]).is_err());
        let error = clip(&[0.0, f64::NAN, 0.0, 0.0]).unwrap_err();
        assert_eq!(error.to_string(), "frame 1 holds a value that is not a number");
        let wild = clip(&[0.0, 0.0, 1e300, 0.0]).unwrap();
        assert!(wild.check_size().unwrap_err().to_string().starts_with("frame 2 holds"));
        let mut long = clip(&[0.0, 0.0, 1e9, 0.0]).unwrap();
        assert!(long.check_size().is_ok());
        let offset = glam::DVec3::new(0.0, 1e308, 0.0);
        long.skeleton.joints[0].end_sites = vec![EndSite { name: "Site".into(), offset }];
        let error = long.check_size().unwrap_err().to_string();
        assert_eq!(error, "the offset of root or of its tip is no length");
    }

    #[test]
    fn a_trimmed_clip_keeps_the_numbers_of_its_frames() {
        let clip = clip(&[10.0, 11.0, 12.0, 13.0]).unwrap().trimmed(Frame(1), Frame(3)).unwrap();
        assert_eq!((clip.first(), clip.last(), clip.len()), (Frame(1), Frame(2), 2));
        assert_eq!(clip.row(Frame(2)), [12.0]);
        assert!(clip.contains(Frame(1)) && !clip.contains(Frame(0)) && !clip.contains(Frame(3)));
        let again = clip.trimmed(Frame(2), Frame(3)).unwrap();
        assert_eq!(again.row(Frame(2)), [12.0]);
        assert!(again.clone().trimmed(Frame(1), Frame(3)).is_err());
        assert!(again.clone().trimmed(Frame(2), Frame(4)).is_err(), "past the end");
        assert!(again.trimmed(Frame(2), Frame(2)).is_err());
    }
}
