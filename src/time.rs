//! The two clocks, and the only conversions between them.
//!
//! A **frame** is an instant of the source clip, a **koma** (コマ) is a slot of the sheet, 1/24 s.
//! F frames last (F − 1)/rate; T koma last T/24 s. A frame always carries the number it has in the
//! file, also after a lead-in or a trim; koma count from 0 in code and from 1 on paper.
//! Only frames have a type of their own: koma index what stands on each of them.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Kind, Range, Setting, as_word, by_word};

/// Koma a second, unless the recipe says otherwise: film, and so TV animation.
pub const KOMA_RATE: f64 = 24.0;

/// Rates that files mean when they write a rounded frame time, in frames a second.
pub(crate) const USUAL_RATES: [f64; 15] = [
    23.976, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 72.0, 90.0, 100.0, 119.88, 120.0,
    240.0,
];

/// How far from a usual rate still means that rate: `.0083333` is 120.0005 frames a second, while
/// 29.97 and 30 differ by 0.1 %.
const SNAP: f64 = 0.0005;

/// The usual rate that frames a second mean, within 0.05 %.
pub(crate) fn usual_rate(fps: f64) -> Option<f64> {
    USUAL_RATES.into_iter().find(|usual| (fps - usual).abs() < SNAP * usual)
}

/// Frames a second that a rate can be; beyond them a file lies.
const RATES: RangeInclusive<f64> = 1e-3..=1e6;

/// Frames a second, from 0.001 to 1,000,000.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct FrameRate(f64);

impl FrameRate {
    /// A rate in frames a second.
    ///
    /// # Errors
    /// [`Error::Setting`] outside that range.
    pub fn new(fps: f64) -> Result<Self, Error> {
        if RATES.contains(&fps) {
            return Ok(Self(fps));
        }
        let (least, most) = (RATES.start(), RATES.end());
        let message = format!("{fps} frames a second is no rate; it is from {least} to {most}");
        Err(Error::setting("rate", message))
    }

    /// The rate meant by a frame time in seconds: within 0.05 % of a usual rate it is that rate,
    /// so that `.0083333` is exactly 120.
    ///
    /// # Errors
    /// [`Error::Setting`] where that is no [`FrameRate`].
    pub fn from_frame_time(seconds: f64) -> Result<Self, Error> {
        let fps = Self::new(1.0 / seconds)?;
        Ok(usual_rate(fps.0).map_or(fps, Self))
    }

    /// Frames a second.
    pub fn fps(self) -> f64 {
        self.0
    }

    /// The number of koma that hold `frames` instants: ⌊(F − 1) · 24 / rate⌋ + 1, and 0 for no frame.
    pub fn koma_from_frames(self, frames: usize, koma_rate: f64) -> usize {
        if frames == 0 {
            return 0;
        }
        // A hair is added so that 5/120 · 24, which is 1, does not fall to 0.999….
        ((frames - 1) as f64 * koma_rate / self.0 + 1e-9).floor() as usize + 1
    }
}

impl TryFrom<f64> for FrameRate {
    type Error = Error;

    fn try_from(fps: f64) -> Result<Self, Error> {
        Self::new(fps)
    }
}

impl From<FrameRate> for f64 {
    fn from(rate: FrameRate) -> f64 {
        rate.0
    }
}

/// As people write it: four places at the most.
impl fmt::Display for FrameRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        ((self.0 * 1e4).round() / 1e4).fmt(f)
    }
}

/// A source frame by the number it has in the file, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Frame(pub usize);

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Where the koma of a sheet stand in the source: place = first frame + koma · rate / 24.
///
/// A *place* is an instant of the source as a fractional frame number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// The source frame that koma 0 shows.
    pub first: Frame,
    /// Frames a second of the source.
    pub frame_rate: FrameRate,
    /// Koma a second of the sheet.
    pub koma_rate: f64,
}

impl Clock {
    /// The place of a koma.
    pub fn place_from_koma(&self, koma: usize) -> f64 {
        self.first.0 as f64 + koma as f64 * self.frame_rate.fps() / self.koma_rate
    }

    /// The koma nearest to a place: ⌊time · 24 + ½⌋, and 0 for what lies before the first frame.
    ///
    /// ```
    /// use genga::time::{Clock, Frame, FrameRate};
    ///
    /// let frame_rate = FrameRate::new(120.0)?;
    /// let clock = Clock { first: Frame(0), frame_rate, koma_rate: 24.0 };
    /// assert_eq!(clock.koma_from_place(52.0), 10, "frame 50 is the nearest koma");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn koma_from_place(&self, place: f64) -> usize {
        let koma = (place - self.first.0 as f64) * self.koma_rate / self.frame_rate.fps();
        (koma + 0.5).floor().max(0.0) as usize
    }

    /// The koma nearest to a source frame, as [`koma_from_place`](Self::koma_from_place) has it.
    pub fn koma_from_frame(&self, frame: Frame) -> usize {
        self.koma_from_place(frame.0 as f64)
    }

    /// The source frame nearest to a koma. The clip may end before it.
    ///
    /// ```
    /// use genga::time::{Clock, Frame, FrameRate};
    ///
    /// let clock = Clock { first: Frame(4), frame_rate: FrameRate::new(30.0)?, koma_rate: 24.0 };
    /// assert_eq!(clock.frame_from_koma(3), Frame(8), "3.75 frames after the first");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn frame_from_koma(&self, koma: usize) -> Frame {
        Frame(self.place_from_koma(koma).round() as usize)
    }

    /// Source frames in one koma.
    pub fn frames_in_koma(&self) -> f64 {
        self.frame_rate.fps() / self.koma_rate
    }

    /// Seconds from the clip's frame 0 to a place.
    pub fn seconds_from_place(&self, place: f64) -> f64 {
        place / self.frame_rate.fps()
    }
}

/// A length of time: source frames (`20`) or seconds (`0.2s`), so that one recipe serves every rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Span {
    /// Source frames.
    Frames(f64),
    /// Seconds.
    Seconds(f64),
}

impl Span {
    /// The length in source frames, not rounded.
    pub fn frames(self, rate: FrameRate) -> f64 {
        match self {
            Self::Frames(frames) => frames,
            Self::Seconds(seconds) => seconds * rate.fps(),
        }
    }

    /// The length in whole source frames, at least 1.
    pub fn whole_frames(self, rate: FrameRate) -> usize {
        self.frames(rate).round().max(1.0) as usize
    }

    /// Whether the length is finite and not below 0.
    pub fn is_length(self) -> bool {
        let (Self::Frames(length) | Self::Seconds(length)) = self;
        length.is_finite() && length >= 0.0
    }
}

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Frames(frames) => write!(f, "{frames}"),
            Self::Seconds(seconds) => write!(f, "{seconds}s"),
        }
    }
}

impl FromStr for Span {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (number, span): (&str, fn(f64) -> Self) = match text.strip_suffix('s') {
            Some(seconds) => (seconds, Self::Seconds),
            None => (text, Self::Frames),
        };
        match number.trim().parse::<f64>() {
            Ok(length) if span(length).is_length() => Ok(span(length)),
            _ => Err(format!("expected frames (20) or seconds (0.2s), found \"{text}\"")),
        }
    }
}

impl Setting for Span {
    const KIND: Kind = Kind::Span;
    as_word!();

    fn is_in(&self, range: Range) -> bool {
        let (Self::Frames(length) | Self::Seconds(length)) = *self;
        self.is_length() && range.contains(length)
    }
}

by_word!(Span);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounded_frame_time_means_the_usual_rate() {
        for (seconds, fps) in [
            (0.0083333, 120.0),
            (0.00833333, 120.0),
            (0.041667, 24.0),
            (0.033333, 30.0),
            (0.01, 100.0),
        ] {
            assert_eq!(FrameRate::from_frame_time(seconds).unwrap().fps(), fps, "{seconds}");
        }
        assert_eq!(FrameRate::from_frame_time(0.02).unwrap().fps(), 50.0);
        assert_eq!(FrameRate::from_frame_time(1.0 / 29.97).unwrap().fps(), 29.97);
        assert_eq!(FrameRate::from_frame_time(0.1).unwrap().fps(), 10.0, "an unusual rate stays");
        assert!(FrameRate::from_frame_time(0.0).is_err());
        for fps in [f64::NAN, f64::INFINITY, 0.0, -24.0, 1e-4, 1e7] {
            assert!(FrameRate::new(fps).is_err(), "{fps}");
        }
    }

    #[test]
    fn a_rate_is_printed_as_people_write_it() {
        let printed = |seconds: f64| FrameRate::from_frame_time(seconds).unwrap().to_string();
        assert_eq!(
            [0.034483, 0.0083333, 1.0 / 29.97].map(printed),
            ["28.9998", "120", "29.97"].map(String::from)
        );
    }

    #[test]
    fn frames_are_instants_and_koma_are_slots() {
        let rate = |fps| FrameRate::new(fps).unwrap();
        assert_eq!(rate(120.0).koma_from_frames(0, 24.0), 0);
        assert_eq!(rate(120.0).koma_from_frames(1, 24.0), 1);
        assert_eq!(rate(120.0).koma_from_frames(5, 24.0), 1);
        assert_eq!(rate(120.0).koma_from_frames(6, 24.0), 2);
        assert_eq!(rate(24.0).koma_from_frames(129, 24.0), 129);
        assert_eq!(rate(100.0).koma_from_frames(496, 24.0), 119);
        assert_eq!(
            rate(23.976).koma_from_frames(44, 23.976),
            44,
            "43 · 23.976 / 23.976 falls short"
        );
    }

    #[test]
    fn a_koma_and_its_place_are_inverse() {
        let clock =
            Clock { first: Frame(4), frame_rate: FrameRate::new(100.0).unwrap(), koma_rate: 24.0 };
        for koma in 0..500 {
            assert_eq!(clock.koma_from_place(clock.place_from_koma(koma)), koma);
        }
        assert_eq!(clock.place_from_koma(6), 29.0, "six koma are exactly 25 frames at 100 fps");
        assert_eq!(clock.koma_from_place(0.0), 0);
    }

    #[test]
    fn a_span_is_frames_or_seconds() {
        let rate = FrameRate::new(120.0).unwrap();
        assert_eq!("20".parse::<Span>().unwrap().frames(rate), 20.0);
        assert_eq!("0.2s".parse::<Span>().unwrap().frames(rate), 24.0);
        assert_eq!("0s".parse::<Span>().unwrap().whole_frames(rate), 1);
        for wrong in ["", "s", "-1", "nan", "1m", "inf"] {
            assert!(wrong.parse::<Span>().is_err(), "{wrong}");
        }
        assert_eq!("0.10s".parse::<Span>().unwrap().to_string(), "0.1s");
    }
}
