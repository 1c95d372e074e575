//! How much of a clip is drawn rather than captured: found in the clip, or set by a person.

use std::fmt;
use std::str::FromStr;

use crate::knob::{Kind, Range, Setting, as_word, by_word};
use crate::signal::{LowPass, TurnFinder};
use crate::time::{FrameRate, Span};

/// Seconds to which filter and persistence shrink for motion that is all drawn, if they are wider: a koma of film.
const NARROWEST: f64 = 1.0 / 24.0;

/// How much of a clip is drawn (描かれた動き): `auto`, or a number from 0 (captured) to 1 (drawn).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Drawn {
    /// As found in the clip, by how suddenly it changes its speed.
    #[default]
    Auto,
    /// A share from 0 to 1.
    Share(f64),
}

impl Drawn {
    /// Returns the share; `own` is the share found in the clip.
    pub fn share(self, own: f64) -> f64 {
        match self {
            Self::Auto => own,
            Self::Share(share) => share,
        }
    }
}

impl TurnFinder {
    /// Returns the filter, and the persistence in frames, with which to find turns of a body. `share` of its motion is
    /// drawn.
    pub(crate) fn of_body(&self, filter: &LowPass, share: f64, rate: FrameRate) -> (LowPass, f64) {
        let filter = LowPass { width: narrowed(share, filter.width, rate), ..filter.clone() };
        (filter, narrowed(share, self.persistence, rate).frames(rate))
    }
}

/// Narrows a span for a clip of which `share` is drawn. A capture keeps its span, in its own unit.
fn narrowed(share: f64, span: Span, rate: FrameRate) -> Span {
    let frames = span.frames(rate);
    let more = (frames - NARROWEST * rate.fps()).max(0.0);
    if share > 0.0 && more > 0.0 { Span::Frames(frames - share * more) } else { span }
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.pad("auto"),
            Self::Share(share) => share.fmt(f),
        }
    }
}

impl FromStr for Drawn {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let share = || text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
        let drawn = if text == "auto" { Some(Self::Auto) } else { share().map(Self::Share) };
        drawn.ok_or_else(|| format!("expected auto or a number from 0 to 1, found \"{text}\""))
    }
}

impl Setting for Drawn {
    const KIND: Kind = Kind::OrAuto;
    as_word!();

    fn is_in(&self, range: Range) -> bool {
        match self {
            Self::Auto => true,
            Self::Share(share) => range.contains(*share),
        }
    }
}

by_word!(Drawn, or_number);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_a_share_or_found() {
        for (text, drawn) in
            [("auto", Drawn::Auto), ("0", Drawn::Share(0.0)), ("0.25", Drawn::Share(0.25))]
        {
            assert_eq!(text.parse(), Ok(drawn));
            assert_eq!(drawn.to_string(), text);
        }
        for wrong in ["", "automatic", "-0.1", "1.1", "nan", "50%"] {
            assert!(wrong.parse::<Drawn>().is_err(), "{wrong}");
        }
        assert_eq!((Drawn::Auto.share(0.3), Drawn::Share(1.0).share(0.3)), (0.3, 1.0));
    }

    #[test]
    fn filter_and_persistence_shrink_to_a_koma_and_grow_nowhere() {
        let rate = FrameRate::new(120.0).unwrap();
        let (filter, finder) = (LowPass::default(), TurnFinder::default());
        assert_eq!(finder.of_body(&filter, 0.0, rate), (filter.clone(), 12.0));
        let half = finder.of_body(&filter, 0.5, rate);
        assert_eq!((half.0.width, half.1), (Span::Frames(11.5), 8.5));
        let all = finder.of_body(&filter, 1.0, rate);
        assert_eq!((all.0.width, all.1), (Span::Frames(5.0), 5.0));
        let narrow = LowPass { width: Span::Seconds(0.01), ..filter };
        assert_eq!(finder.of_body(&narrow, 1.0, rate).0, narrow);
    }
}
