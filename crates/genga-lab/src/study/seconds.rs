//! Says what frames on an axis are in seconds: a filter of 10 frames is not the same at 100 and at 30 a second.

use crate::study::{Axis, Study, is_table_1};
use genga::recipe::Kind;
use genga::time::{FrameRate, Span};

/// Most values of an axis that are listed; of more, only the first and the last are named.
const MOST: usize = 6;

impl Study {
    /// Returns a line for each axis of spans and each rate of the clips.
    pub fn in_seconds(&self, rates: &[FrameRate]) -> Vec<String> {
        let mut different: Vec<FrameRate> = Vec::new();
        for rate in rates {
            if !different.contains(rate) {
                different.push(*rate);
            }
        }
        let axes = [Some(&self.x), self.y.as_ref()].into_iter().flatten();
        let of_axis = |axis| different.iter().filter_map(move |rate| line(axis, *rate));
        let mut lines: Vec<String> = axes.flat_map(of_axis).collect();
        if let (true, Some(last)) = (is_table_1(&self.x, self.y.as_ref()), lines.last_mut()) {
            last.push_str(" (the paper: 10 frames at 100 a second are 0.1s)");
        }
        lines
    }
}

/// `None` for an axis without frames.
fn line(axis: &Axis, rate: FrameRate) -> Option<String> {
    if axis.knob().kind != Kind::Span {
        return None;
    }
    let numbers = axis.values().iter().map(|value| value.parse().ok());
    let frames: Vec<f64> = numbers.collect::<Option<_>>()?;
    let seconds = |frames: &f64| rounded(Span::Frames(*frames).frames(rate) / rate.fps());
    let (frames, seconds) =
        (frames.iter().map(f64::to_string).collect(), frames.iter().map(seconds).collect());
    let (frames, seconds) = (listed(frames), listed(seconds));
    Some(format!("{}: {frames} frames are {seconds} at {rate} a second", axis.name()))
}

/// Seconds to the millisecond.
fn rounded(seconds: f64) -> String {
    format!("{}s", (1e3 * seconds).round() / 1e3)
}

fn listed(values: Vec<String>) -> String {
    match &*values {
        [first, .., last] if values.len() > MOST => format!("{first} to {last}"),
        _ => values.join(", "),
    }
}
