//! Reads a BVH file.

use super::rows::Table;
use super::scanner::Scanner;
use super::{Read, hierarchy, table};
use crate::error::Error;
use crate::motion::Clip;
use crate::time::{Frame, FrameRate};

/// Reads (読む) a BVH file: any channel order and number of channels, positions on any joint, several
/// roots, and the spellings that programs in use write.
///
/// Values are exactly the decimals of the file, correctly rounded, in degrees and the file's unit. A
/// frame time within 0.05 % of a usual rate is that rate. When the file has more or fewer frames than
/// it says, all complete ones are used, with the warning `W_FRAMES_MISMATCH`.
///
/// # Errors
/// [`Error::Bvh`] with line and column where the file stops being one, where a value is not a finite
/// number, and when there is no motion.
pub fn read(bytes: &[u8]) -> Result<Read, Error> {
    let mut scanner = Scanner::new(bytes);
    let mut warnings = Vec::new();
    let skeleton = hierarchy::read(&mut scanner, &mut warnings)?;
    let channels = skeleton.channels();
    if channels == 0 {
        let message = "no joint has a channel: there is no motion";
        return Err(scanner.error(scanner.at(), message));
    }
    let said = frames(&mut scanner)?;
    let rate = frame_rate(&mut scanner)?;
    let begin = scanner.at();
    let mut values = match table::read(scanner.rest(), channels, said) {
        Some(values) => values,
        None => values(&mut scanner, said.saturating_mul(channels))?,
    };
    let table = Table { begin, channels, said, values: values.len() };
    let (frames, warning) = table.complete_frames(&scanner)?;
    warnings.extend(warning);
    values.truncate(frames * channels);
    Ok(Read { clip: Clip::of_finite(skeleton, rate, Frame(0), frames, values), warnings })
}

fn frames(scanner: &mut Scanner) -> Result<usize, Error> {
    scanner.label(&["Frames"])?;
    let word = scanner.peek();
    match scanner.count()? {
        0 => Err(scanner.error(word.at, "the file says it has 0 frames: there is no motion")),
        frames => Ok(frames),
    }
}

fn frame_rate(scanner: &mut Scanner) -> Result<FrameRate, Error> {
    scanner.label(&["Frame", "Time"])?;
    let word = scanner.peek();
    let seconds = scanner.number()?;
    if seconds >= 1.0 {
        let time = 1.0 / seconds;
        let message = if (10.0..1000.0).contains(&seconds) {
            format!(
                "{seconds} seconds a frame looks like a rate; {seconds} frames a second is \"Frame Time: {time:.6}\""
            )
        } else {
            format!("expected a frame time below 1 second, found {seconds}")
        };
        return Err(scanner.error(word.at, message));
    }
    FrameRate::from_frame_time(seconds)
        .map_err(|_| scanner.expected("a frame time in seconds above 0, such as 0.0083333", word))
}

/// All values to the end of the file. What the file says it has is reserved, but never more than the
/// bytes left can hold: a value and its blank are two.
fn values(scanner: &mut Scanner, said: usize) -> Result<Vec<f64>, Error> {
    let most = scanner.rest().len() / 2 + 1;
    let mut values = Vec::with_capacity(said.min(most));
    while scanner.has_more() {
        values.push(scanner.number()?);
    }
    Ok(values)
}
