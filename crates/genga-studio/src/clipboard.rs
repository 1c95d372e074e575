//! Copied genga (写し), as a text on the clipboard that can be pasted into another column or take.
//!
//! The text is a recipe file with pins and no settings, which `--recipe` reads too. A comment gives the rate at which
//! its frames are counted. By default they are counted at the rate of the take.

use std::ops::Range;

use serde::Serialize;

use super::column::Column;
use genga::edits::{Edits, Pin};
use genga::error::Error;
use genga::recipe::Recipe;
use genga::time::{Clock, Frame};

/// Beginning of the comment with the frame rate.
const RATE: &str = "# frames a second: ";

/// Writes the genga of a column, or those in some koma, as a text.
pub(super) fn text(column: &Column<'_>, koma: Option<&Range<usize>>) -> String {
    #[derive(Serialize)]
    struct Pins {
        edits: Edits,
    }
    let clock = column.clock;
    let is_wanted =
        |frame: Frame| koma.is_none_or(|koma| koma.contains(&clock.koma_from_frame(frame)));
    let keys = column.keys().iter().filter(|key| is_wanted(key.frame));
    let pins = keys.map(|key| Pin { frame: key.frame, name: key.name.clone(), weight: key.weight });
    let edits = Edits { pins: pins.collect(), ..Edits::default() };
    // Pins consist of plain strings and numbers, which TOML can always hold.
    let table = toml::to_string(&Pins { edits }).unwrap_or_default();
    format!("{RATE}{}\n{table}", clock.frame_rate.fps())
}

/// Pasted pins, and the number left out.
#[derive(Debug, PartialEq)]
pub(super) struct Pasted {
    pub(super) pins: Vec<Pin>,
    /// Number of pins outside of the clip, or on a koma that already has one.
    pub(super) left_out: usize,
}

/// Reads the pins of a text, converted to the frames of a clock. `taken` lists the koma that already have a pin.
///
/// # Errors
/// Those of [`Recipe::parse`].
pub(super) fn pins(
    text: &str,
    clock: Clock,
    last: Frame,
    taken: &[usize],
) -> Result<Pasted, Error> {
    let (_, edits) = Recipe::parse(text)?;
    let rate = text.lines().find_map(|line| line.strip_prefix(RATE)?.trim().parse().ok());
    let times = rate.map_or(1.0, |rate: f64| clock.frame_rate.fps() / rate);
    let mut taken = taken.to_vec();
    let count = edits.pins.len();
    let own = |pin: Pin| {
        let frame = Frame((pin.frame.0 as f64 * times).round() as usize);
        let koma = clock.koma_from_frame(frame);
        let fits = frame >= clock.first && frame <= last && !taken.contains(&koma);
        taken.push(koma);
        fits.then_some(Pin { frame, ..pin })
    };
    let pins: Vec<Pin> = edits.pins.into_iter().filter_map(own).collect();
    Ok(Pasted { left_out: count - pins.len(), pins })
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::time::FrameRate;

    fn clock(fps: f64) -> Clock {
        Clock { first: Frame(0), frame_rate: FrameRate::new(fps).unwrap(), koma_rate: 24.0 }
    }

    #[test]
    fn pins_come_at_the_time_they_had_and_only_where_there_is_room() {
        let text = "# frames a second: 120\n[[edits.pins]]\nframe = 50\nname = \"a: b@c\"\n\
                    [[edits.pins]]\nframe = 100\nweight = 0.5\n[[edits.pins]]\nframe = 300\n";
        let pasted = pins(text, clock(60.0), Frame(100), &[]).unwrap();
        let first = Pin { frame: Frame(25), name: Some("a: b@c".into()), weight: None };
        let second = Pin { frame: Frame(50), name: None, weight: Some(0.5) };
        assert_eq!(pasted, Pasted { pins: vec![first.clone(), second], left_out: 1 });
        let pasted = pins(text, clock(60.0), Frame(100), &[20]).unwrap();
        assert_eq!(pasted, Pasted { pins: vec![first], left_out: 2 });
        assert!(pins("a letter to a friend", clock(60.0), Frame(9), &[]).is_err());
        assert!(pins("", clock(60.0), Frame(9), &[]).unwrap().pins.is_empty());
    }
}
