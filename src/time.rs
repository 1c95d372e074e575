//! The two clocks, and the only conversions between them.
//!
//! A **frame** is an instant of the source clip; a **koma** (コマ) is a slot of the sheet, 1/24 s. F frames last (F −
//! 1)/rate; T koma last T/24 s. A frame always keeps its number from the file, even after a lead-in or a trim. Koma
//! count from 0 in code and from 1 on paper. Only frames have a type of their own: koma serve as plain indices into
//! per-koma data.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Kind, Range, Setting, as_word, by_word};

/// Default koma per second: the rate of film, and therefore of TV animation.
pub const KOMA_RATE: f64 = 24.0;

/// Usual frame rates, in frames per second, that a rounded frame time in a file stands for.
pub const USUAL_RATES: [f64; 15] = [
    23.976, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 72.0, 90.0, 100.0, 119.88, 120.0,
    240.0,
];

/// Largest relative distance from a usual rate at which that rate is meant: `.0083333` is 120.0005 frames per second,
/// while 29.97 and 30 differ by 0.1 %.
const SNAP: f64 = 0.0005;

/// Returns the usual rate within 0.05 % of `fps`, if there is one.
pub(crate) fn usual_rate(fps: f64) -> Option<f64> {
    USUAL_RATES.into_iter().find(|usual| (fps - usual).abs() < SNAP * usual)
}

/// Valid frame rates, in frames per second. A file with a rate outside them is wrong.
const RATES: RangeInclusive<f64> = 1e-3..=1e6;

/// A frame rate in frames per second, from 0.001 to 1,000,000.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct FrameRate(f64);

impl FrameRate {
    /// Creates a rate from frames per second.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] if it is outside 0.001 to 1,000,000.
    pub fn new(fps: f64) -> Result<Self, Error> {
        if RATES.contains(&fps) {
            return Ok(Self(fps));
        }
        let (least, most) = (RATES.start(), RATES.end());
        let message = format!("{fps} frames a second is no rate; it is from {least} to {most}");
        Err(Error::setting("rate", message))
    }

    /// Creates a rate from a frame time in seconds. A rate within 0.05 % of a usual one becomes that one, so that
    /// `.0083333` is exactly 120.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] if it is no valid [`FrameRate`].
    pub fn from_frame_time(seconds: f64) -> Result<Self, Error> {
        let fps = Self::new(1.0 / seconds)?;
        Ok(usual_rate(fps.0).map_or(fps, Self))
    }

    /// Frames per second.
    pub fn fps(self) -> f64 {
        self.0
    }

    /// Number of koma that hold `frames` instants: ⌊(F − 1) · 24 / rate⌋ + 1, or 0 if there is no frame.
    pub fn koma_from_frames(self, frames: usize, koma_rate: f64) -> usize {
        if frames == 0 {
            return 0;
        }
        // The small addend keeps 5/120 · 24, which is exactly 1, from being rounded to 0.999….
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

/// Formats the rate with at most four decimal places.
impl fmt::Display for FrameRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        ((self.0 * 1e4).round() / 1e4).fmt(f)
    }
}

/// A source frame, identified by its number in the file, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Frame(pub usize);

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Maps the koma of a sheet to places in the source: place = first frame + koma · rate / 24.
///
/// A *place* is an instant of the source as a fractional frame number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Source frame that koma 0 shows.
    pub first: Frame,
    /// Frames per second of the source.
    pub frame_rate: FrameRate,
    /// Koma per second of the sheet.
    pub koma_rate: f64,
}

impl Clock {
    /// Returns the place of a koma.
    pub fn place_from_koma(&self, koma: usize) -> f64 {
        self.first.0 as f64 + koma as f64 * self.frame_rate.fps() / self.koma_rate
    }

    /// Returns the koma nearest to a place: ⌊time · 24 + ½⌋, or 0 before the first frame.
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

    /// Returns the koma nearest to a source frame, rounded as in [`koma_from_place`](Self::koma_from_place).
    pub fn koma_from_frame(&self, frame: Frame) -> usize {
        self.koma_from_place(frame.0 as f64)
    }

    /// Returns the source frame nearest to a koma. It may lie beyond the end of the clip.
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

    /// Number of source frames in one koma.
    pub fn frames_in_koma(&self) -> f64 {
        self.frame_rate.fps() / self.koma_rate
    }

    /// Returns the seconds from the clip's frame 0 to a place.
    pub fn seconds_from_place(&self, place: f64) -> f64 {
        place / self.frame_rate.fps()
    }
}

/// A duration in source frames (`20`) or in seconds (`0.2s`). Seconds let one recipe serve every frame rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Span {
    /// A number of source frames.
    Frames(f64),
    /// A number of seconds.
    Seconds(f64),
}

impl Span {
    /// Returns the duration in source frames, not rounded.
    pub fn frames(self, rate: FrameRate) -> f64 {
        match self {
            Self::Frames(frames) => frames,
            Self::Seconds(seconds) => seconds * rate.fps(),
        }
    }

    /// Returns the duration in whole source frames, at least 1.
    pub fn whole_frames(self, rate: FrameRate) -> usize {
        self.frames(rate).round().max(1.0) as usize
    }

    /// Whether the duration is finite and not negative.
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
