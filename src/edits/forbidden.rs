//! Frames at which keys are forbidden.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use crate::knob::by_word;
use crate::time::{Clock, Frame};

/// Koma around a forbidden frame in which no key is found either: any nearer, it would be the same key again.
const REACH: f64 = 2.0;

/// A frame, or a range of frames, near which no key may be found. Written `150`, `120..140`, `120..` or `..140`; the
/// last frame is excluded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Forbidden {
    /// The first frame.
    pub from: Frame,
    /// The frame after the last.
    pub past: Frame,
}

impl Forbidden {
    /// Creates a single forbidden frame.
    pub fn one(frame: Frame) -> Self {
        Self { from: frame, past: Frame(frame.0.saturating_add(1)) }
    }

    /// Creates the ban of all keys between those before and after `frame`, so that none is found in its place. Where there
    /// is no other key, it goes to the end of a sheet of `length` koma.
    pub fn instead_of(
        frame: Frame,
        others: impl Iterator<Item = Frame> + Clone,
        clock: &Clock,
        length: usize,
    ) -> Self {
        let end = Frame(clock.place_from_koma(length).ceil() as usize);
        let before = others.clone().filter(|other| *other < frame).max().unwrap_or(clock.first);
        let after = others.filter(|other| *other > frame).min().unwrap_or(end);
        Self::between(before, frame, after, clock.frames_in_koma())
    }

    /// Creates the ban of every key between two that stay, of which one stands at `frame`. Where the two are so near that
    /// any ban reaches one of them, it is that frame alone.
    pub(super) fn between(before: Frame, frame: Frame, after: Frame, koma: f64) -> Self {
        let reach = (REACH * koma + 1e-9) as usize;
        let range =
            Self { from: Frame(before.0 + reach + 1), past: Frame(after.0.saturating_sub(reach)) };
        if range.from < range.past { range } else { Self::one(frame) }
    }

    /// Whether this is a single frame.
    pub fn is_one(self) -> bool {
        self == Self::one(self.from)
    }

    /// Whether this bans a key at `frame`: within two koma of `koma` frames each.
    pub fn reaches(self, frame: Frame, koma: f64) -> bool {
        self.distance(frame) as f64 <= REACH * koma + 1e-9
    }

    /// Returns the number of frames to the nearest forbidden frame; 0 inside the range.
    pub fn distance(self, frame: Frame) -> usize {
        if frame < self.from {
            self.from.0 - frame.0
        } else {
            (frame.0 + 1).saturating_sub(self.past.0)
        }
    }
}

impl fmt::Display for Forbidden {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, past } = self;
        match (self.is_one(), past.0) {
            (true, _) => write!(f, "{from}"),
            (false, usize::MAX) => write!(f, "{from}.."),
            (false, _) => write!(f, "{from}..{past}"),
        }
    }
}

impl FromStr for Forbidden {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("expected a frame (150) or a range (120..140), found \"{text}\"");
        let number = |text: &str| text.trim().parse().map(Frame).map_err(|_| wrong());
        let Some((from, past)) = text.split_once("..") else {
            return number(text).map(Self::one);
        };
        let bound = |text: &str, open| match text.trim() {
            "" => Ok(Frame(open)),
            text => number(text),
        };
        let range = Self { from: bound(from, 0)?, past: bound(past, usize::MAX)? };
        match range.from.cmp(&range.past) {
            Ordering::Less => Ok(range),
            Ordering::Equal => Err(format!("\"{text}\" has no frame in it")),
            Ordering::Greater => Err(format!("\"{text}\" ends before it begins")),
        }
    }
}

by_word!(Forbidden, or_number);
