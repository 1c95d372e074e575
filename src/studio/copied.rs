//! Genga that are copied (写し), as a text that goes through the clipboard: from column to column and from take to take.
//!
//! It is a recipe file of pins and no settings, which `--recipe` reads too. A comment says at which rate its frames
//! are counted; without one they are those of the take.

use std::ops::Range;

use serde::Serialize;

use super::column::Column;
use crate::edits::{Edits, Pin};
use crate::error::Error;
use crate::recipe::Recipe;
use crate::time::{Clock, Frame};

/// What the comment begins with.
const RATE: &str = "# frames a second: ";

/// The genga of a column, or those in some koma, as a text.
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
    // Pins are plain words and numbers, which every table takes.
    let table = toml::to_string(&Pins { edits }).unwrap_or_default();
    format!("{RATE}{}\n{table}", clock.frame_rate.fps())
}

/// What was pasted, and how much of it could not be.
#[derive(Debug, PartialEq)]
pub(super) struct Pasted {
    pub(super) pins: Vec<Pin>,
    /// Pins that lie outside of the clip, or on the koma of another.
    pub(super) left_out: usize,
}

/// The pins of a text, in the frames of a clock; `taken` are the koma that have one already.
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
    use crate::time::FrameRate;

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
