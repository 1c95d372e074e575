//! Spoken lines (セリフ) over a range of the take.

use serde::{Deserialize, Serialize};

use super::marks::frame_of;
use crate::error::Error;
use crate::sanitize::is_hidden;
use crate::sheet::SpokenLine;
use crate::time::{Clock, Frame};

/// A spoken line. It is written into the S column and changes no drawing.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Speech {
    /// The source frame at which the line begins, numbered as in the file.
    pub from: Frame,
    /// The frame after its last.
    pub past: Frame,
    /// The speaker; empty if unnamed.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub speaker: String,
    /// The words, on one line.
    pub words: String,
}

impl Speech {
    /// Parses `120..210:アキ:えい！` or, without a speaker, `120..210:えい！`. Frames are source frames, the last one excluded.
    /// Words with a colon need a speaker, if only an empty one: `120..210::at 10:30`.
    ///
    /// # Errors
    /// [`Error::Edits`] when the two frame numbers or the words are missing.
    ///
    /// ```
    /// use genga::edits::Speech;
    ///
    /// let line = Speech::parse("120..210:アキ:えい！")?;
    /// assert_eq!((line.past.0, &*line.speaker, &*line.words), (210, "アキ", "えい！"));
    /// assert_eq!(line.to_string(), "120..210:アキ:えい！");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        let expected = "A..B:SPEAKER:WORDS, with two frame numbers";
        let wrong = || Error::Edits { message: format!("expected {expected}, found \"{text}\"") };
        let (range, said) = text.split_once(':').ok_or_else(wrong)?;
        let (from, past) = range.split_once("..").ok_or_else(wrong)?;
        let (from, past) = (frame_of(from, expected, text)?, frame_of(past, expected, text)?);
        let (speaker, words) = said.split_once(':').unwrap_or(("", said));
        let [speaker, words] = [speaker, words].map(|part| part.trim().to_owned());
        if words.is_empty() {
            return Err(wrong());
        }
        Ok(Self { from, past, speaker, words })
    }

    /// Creates a line over a range of koma, the end excluded, on the sheet of a clip whose last frame is `last`. A clip
    /// with fewer frames than koma lacks a frame for each; the nearest frames are taken.
    pub fn over(
        (from, past): (usize, usize),
        (clock, last, length): (Clock, Frame, usize),
        speaker: &str,
        words: &str,
    ) -> Self {
        let from = clock.frame_from_koma(from).min(last);
        let end = Frame(last.0.saturating_add(1));
        let past = if past < length { clock.frame_from_koma(past).min(end) } else { end };
        let past = past.max(Frame(from.0 + 1));
        let [speaker, words] = [speaker, words].map(|text| text.trim().to_owned());
        Self { from, past, speaker, words }
    }

    /// Returns the koma on which the line is heard; `None` for an empty sheet.
    pub fn on_sheet(&self, clock: Clock, last: Frame, length: usize) -> Option<SpokenLine> {
        let begin = clock.koma_from_frame(self.from).min(length.checked_sub(1)?);
        // A line that reaches the clip's last frame reaches the last koma.
        let past = if self.past > last { length } else { clock.koma_from_frame(self.past) };
        let koma = past.min(length).saturating_sub(begin).max(1);
        let (speaker, words) = (self.speaker.clone(), self.words.clone());
        Some(SpokenLine { begin, koma, speaker, words })
    }

    /// Describes what is wrong with the line, if anything.
    pub(super) fn fault(&self) -> Option<String> {
        let Self { from, past, speaker, words } = self;
        if words.trim().is_empty() {
            return Some(format!(
                "the line at frame {from} has no words: write some, or take it out"
            ));
        }
        if speaker.chars().chain(words.chars()).any(is_hidden) {
            return Some(format!(
                "the line at frame {from} has a line break or a letter that is not seen: write it on one line"
            ));
        }
        (from >= past).then(|| format!("the line {from}..{past} has no frame in it"))
    }
}

impl std::fmt::Display for Speech {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { from, past, speaker, words } = self;
        match speaker.is_empty() && !words.contains(':') {
            true => write!(f, "{from}..{past}:{words}"),
            false => write!(f, "{from}..{past}:{speaker}:{words}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::time::FrameRate;

    fn clock(first: usize, fps: f64) -> Clock {
        Clock { first: Frame(first), frame_rate: FrameRate::new(fps).unwrap(), koma_rate: 24.0 }
    }

    #[test]
    fn a_line_is_read_as_it_is_written() {
        for text in ["120..210:アキ:えい！", "1..2:no", "1..2::at 10:30", "1..2:Aki:at 10:30"]
        {
            assert_eq!(Speech::parse(text).unwrap().to_string(), text);
        }
        for wrong in ["", "12:hello", "1..2", "1..2:", "1..2:Aki:", "1..:a:b", "a..b:c"] {
            let error = Speech::parse(wrong).unwrap_err().to_string();
            assert!(error.contains("A..B:SPEAKER:WORDS"), "{wrong}: {error}");
        }
    }

    #[test]
    fn a_line_ends_with_the_sheet_at_the_latest_and_has_a_koma() {
        let said = |from, past| Speech::parse(&format!("{from}..{past}:a")).unwrap();
        let on = |line: Speech, length| {
            line.on_sheet(clock(0, 120.0), Frame(91), length).map(|line| (line.begin, line.koma))
        };
        assert_eq!(on(said(10, 30), 19), Some((2, 4)));
        assert_eq!(on(said(10, 92), 19), Some((2, 17)), "to the last frame is to the last koma");
        assert_eq!(on(said(10, 11), 19), Some((2, 1)));
        assert_eq!(on(said(500, 900), 19), Some((18, 1)));
        assert_eq!(on(said(10, 30), 0), None);
    }

    proptest! {
        #[test]
        fn koma_come_back_from_their_frames(
            first in 0_usize..9, fps in 24.0..240.0, frames in 2_usize..4000, a in 0.0..1.0, b in 0.0..1.0,
        ) {
            let (clock, last) = (clock(first, fps), Frame(first + frames - 1));
            let length = clock.frame_rate.koma_from_frames(frames, 24.0);
            let at = |share: f64| (share * length as f64) as usize;
            let (from, past) = (at(a).min(at(b)), at(a).max(at(b)) + 1);
            let said = Speech::over((from, past), (clock, last, length), " Aki ", "no ");
            let line = said.on_sheet(clock, last, length).unwrap();
            prop_assert_eq!((line.begin, line.begin + line.koma), (from, past.min(length)));
            prop_assert_eq!((&*line.speaker, &*line.words, said.fault()), ("Aki", "no", None));
        }
    }
}
