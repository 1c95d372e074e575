//! Converts a frame time to a frame rate. A number too large for seconds is a rate or milliseconds; the
//! user must say which.

use crate::time::{FrameRate, USUAL_RATES, usual_rate};

/// Frame time in seconds from which frames are a list of poses; no motion is played so slowly.
const POSE: f64 = 1.0;

/// Smallest number that must be in another unit than seconds.
const OTHER_UNIT: f64 = 8.0;

/// Upper bound of the rates that people write.
const NO_RATE: f64 = 1000.0;

/// Converts a frame time in seconds to a rate.
///
/// # Errors
/// A message that says why the number is no frame time, and what to do.
pub(super) fn rate(seconds: f64) -> Result<FrameRate, String> {
    if seconds >= OTHER_UNIT || seconds >= POSE && in_milliseconds(seconds).is_some() {
        return Err(other_unit(seconds));
    }
    FrameRate::from_frame_time(seconds).map_err(|_| {
        format!("expected a frame time of at least a millionth of a second, found {seconds}; --fps gives the rate")
    })
}

/// The warning that the frames are a list of poses, if each lasts that long.
pub(super) fn poses(seconds: f64) -> Option<String> {
    let s = if seconds == 1.0 { "" } else { "s" };
    let message = format!(
        "a frame lasts {seconds} second{s}, as in a list of poses; --fps N plays N of them a second"
    );
    (seconds >= POSE).then_some(message)
}

fn other_unit(number: f64) -> String {
    // Multiples of 4 or 5, such as 12, 15 and 20, may be rates; 17, 33 and 42 are milliseconds without
    // their decimals.
    let is_round = number % 4.0 == 0.0 || number % 5.0 == 0.0;
    let may_be_rate = number < NO_RATE && (is_round || usual_rate(number).is_some());
    let frame = format!("{number} seconds a frame");
    match in_milliseconds(number) {
        Some(rate) if may_be_rate => format!(
            "{frame} looks like a rate or like milliseconds; --fps {number} reads it as a rate, --fps {rate} as milliseconds"
        ),
        Some(rate) => format!("{frame} looks like milliseconds; --fps {rate} reads it so"),
        None if number < NO_RATE => {
            format!("{frame} looks like a rate; --fps {number} reads it as one")
        }
        None => format!("expected a frame time in seconds, found {number}; --fps gives the rate"),
    }
}

/// The usual rate whose frame time is this number of milliseconds, exactly or rounded to a whole number.
fn in_milliseconds(number: f64) -> Option<f64> {
    // If two rates fit, the higher is meant: 30, not 29.97.
    let rounds = |rate: &&f64| (1000.0 / *rate).round() == number;
    let rounded = || USUAL_RATES.iter().filter(rounds).copied().reduce(f64::max);
    usual_rate(1000.0 / number).or_else(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_no_time_gets_the_advice_that_fits_it() {
        for (number, advice) in [
            (41.6667, "looks like milliseconds; --fps 24 reads it so"),
            (33.3333, "looks like milliseconds; --fps 30 reads it so"),
            (33.0, "looks like milliseconds; --fps 30 reads it so"),
            (16.667, "looks like milliseconds; --fps 60 reads it so"),
            (8.3333, "looks like milliseconds; --fps 120 reads it so"),
            (4.16667, "looks like milliseconds; --fps 240 reads it so"),
            (24.0, "looks like a rate; --fps 24 reads it as one"),
            (12.0, "looks like a rate; --fps 12 reads it as one"),
            (29.97, "looks like a rate; --fps 29.97 reads it as one"),
            (20.0, "--fps 20 reads it as a rate, --fps 50 as milliseconds"),
            (50.0, "looks like a rate; --fps 50 reads it as one"),
            (40.0, "--fps 40 reads it as a rate, --fps 25 as milliseconds"),
            (10.0, "--fps 10 reads it as a rate, --fps 100 as milliseconds"),
            (41666.7, "expected a frame time in seconds, found 41666.7"),
        ] {
            let said = rate(number).unwrap_err();
            assert!(said.contains(advice), "{number}: {said}");
        }
    }

    #[test]
    fn frames_that_last_seconds_are_poses() {
        for seconds in [1.0, 2.0, 5.0] {
            assert_eq!(rate(seconds).unwrap().fps(), 1.0 / seconds);
            assert!(poses(seconds).unwrap().contains(&format!("lasts {seconds} second")));
        }
        assert_eq!(poses(0.5), None);
        assert!(rate(0.5).is_ok());
    }
}
