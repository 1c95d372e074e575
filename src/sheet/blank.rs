//! Blank koma (カラ) round the drawings of a sheet: a cut in which they enter late or leave early.

use serde::{Deserialize, Serialize};

use super::{CameraWork, MOST_KOMA, Sheet, SpokenLine};
use crate::error::Error;

/// Number of koma of a cut on which nothing is shown, before the first drawing and after the last.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Blank {
    /// Koma before the first drawing.
    pub before: usize,
    /// Koma after the last drawing of the longest layer.
    pub after: usize,
}

impl Blank {
    /// Whether drawings stand on every koma of the cut.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }

    /// Returns the koma of the cut on which a motion takes the pose of a drawing that comes on `koma` of its layer. The
    /// first pose stands over the blank koma before it, since a motion has a pose on every koma.
    ///
    /// ```
    /// use genga::sheet::Blank;
    ///
    /// let blank = Blank { before: 24, after: 12 };
    /// assert_eq!((blank.pose_begins(0), blank.pose_ends(6, 36)), (0, 30));
    /// assert_eq!((blank.pose_begins(30), blank.pose_ends(36, 36)), (54, 72));
    /// ```
    pub fn pose_begins(self, koma: usize) -> usize {
        if koma == 0 { 0 } else { self.before + koma }
    }

    /// Returns the koma of the cut on which a motion leaves the pose of a drawing that ends on `koma` of its layer, of
    /// `length` koma. The last pose stands over the blank koma after it.
    pub fn pose_ends(self, koma: usize, length: usize) -> usize {
        self.before + koma + if koma == length { self.after } else { 0 }
    }
}

impl Sheet {
    /// Number of koma of the cut (尺): those of the drawings, and the blank ones round them.
    pub fn cut_length(&self) -> usize {
        self.blank.before + self.length() + self.blank.after
    }

    /// Returns the sheet with other blank koma round its drawings. Spoken lines and camera work move with the
    /// drawings; what of them falls out of the cut is cut off.
    ///
    /// ```
    /// use genga::sheet::{Blank, Sheet};
    /// use genga::time::{Clock, Frame, FrameRate};
    ///
    /// let clock = Clock { first: Frame(0), frame_rate: FrameRate::new(24.0)?, koma_rate: 24.0 };
    /// let sheet = Sheet::on_ones(clock, 36).with_blank(Blank { before: 24, after: 12 });
    /// assert_eq!((sheet.length(), sheet.cut_length()), (36, 72));
    /// # Ok::<(), genga::Error>(())
    /// ```
    #[must_use]
    pub fn with_blank(self, blank: Blank) -> Self {
        let (later, earlier) = (blank.before, self.blank.before);
        let moved = |line: &SpokenLine| {
            let begin = (line.begin + later).saturating_sub(earlier);
            let past = (line.past() + later).checked_sub(earlier)?;
            let koma = past.checked_sub(begin).filter(|koma| *koma > 0)?;
            Some(SpokenLine { begin, koma, ..line.clone() })
        };
        let lines: Vec<SpokenLine> = self.lines.iter().filter_map(moved).collect();
        let length = later + self.length() + blank.after;
        let work = |work: &CameraWork| {
            let line = moved(&work.line()).filter(|line| line.begin < length)?;
            let koma = line.koma.min(length - line.begin);
            Some(CameraWork { begin: line.begin, koma, ..work.clone() })
        };
        let camera = self.camera.iter().filter_map(work).collect();
        // The sheet's own function cuts off what lies beyond its end.
        Self { blank, lines: vec![], camera, ..self }.with_lines(&lines)
    }

    /// Returns the sheet with its first drawing on koma `at` of a cut of `length` koma, both from 1. `None` keeps the
    /// koma before, and for the length those after the drawings.
    ///
    /// # Errors
    /// [`Error::Edits`] if `at` is 0, if the drawings end after the cut, or if the cut has over a million koma.
    pub fn placed(self, at: Option<usize>, length: Option<usize>) -> Result<Self, Error> {
        let wrong = |message: String| Err(Error::Edits { message });
        let Some(before) = at.unwrap_or(self.blank.before + 1).checked_sub(1) else {
            return wrong("the first drawing stands on koma 0; koma count from 1".into());
        };
        let end = before.saturating_add(self.length());
        let Some(after) = length.map_or(Some(self.blank.after), |length| length.checked_sub(end))
        else {
            let length = length.unwrap_or_default();
            return wrong(format!(
                "the drawings stand on koma {} to {end}, and the cut is to have {length}: make it longer, let them \
                 enter earlier (--at), or draw less of the take (--trim)",
                before + 1
            ));
        };
        if end.saturating_add(after) > MOST_KOMA {
            return wrong(format!("the cut would have over {MOST_KOMA} koma"));
        }
        Ok(self.with_blank(Blank { before, after }))
    }

    /// Returns the sheet with its last drawings held `koma` koma longer, as far as there are blank koma behind them (止メ).
    /// Those of all layers that last to the end of the drawings stay, so that no part of a body vanishes. The cut stays as
    /// long as it is.
    #[must_use]
    pub fn with_end_held(mut self, koma: usize) -> Self {
        let (end, more) = (self.length(), koma.min(self.blank.after));
        for layer in self.layers.iter_mut().filter(|layer| layer.length() == end) {
            if let Some(last) = layer.exposures.last_mut() {
                last.koma += more;
            }
        }
        self.blank.after -= more;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::{Clock, Frame, FrameRate};

    fn sheet() -> Sheet {
        let frame_rate = FrameRate::new(120.0).unwrap();
        let clock = Clock { first: Frame(0), frame_rate, koma_rate: 24.0 };
        let line = |begin, koma| SpokenLine { begin, koma, speaker: "".into(), words: "a".into() };
        Sheet { lines: vec![line(0, 4), line(30, 6)], ..Sheet::on_ones(clock, 36) }
    }

    fn lines(sheet: &Sheet) -> Vec<(usize, usize)> {
        sheet.lines.iter().map(|line| (line.begin, line.koma)).collect()
    }

    #[test]
    fn a_cut_is_as_long_as_it_is_said_to_be_and_lines_move_with_the_drawings() {
        let late = sheet().placed(Some(25), Some(72)).unwrap();
        assert_eq!(late.blank, Blank { before: 24, after: 12 });
        assert_eq!((late.length(), late.cut_length()), (36, 72));
        assert_eq!(lines(&late), [(24, 4), (54, 6)]);
        assert!(late.check().is_ok());
        assert_eq!(late.clone().placed(None, None).unwrap(), late);
        assert_eq!(late.placed(Some(1), Some(36)).unwrap(), sheet());
    }

    #[test]
    fn the_last_drawing_is_held_over_blank_koma_and_no_further() {
        let late = sheet().placed(Some(25), Some(72)).unwrap();
        for (more, held) in [(0, 0), (5, 5), (12, 12), (99, 12)] {
            let longer = late.clone().with_end_held(more);
            assert_eq!(longer.layers[0].exposures.last().unwrap().koma, 1 + held);
            assert_eq!(longer.blank, Blank { before: 24, after: 12 - held });
            assert_eq!((longer.length(), longer.cut_length()), (36 + held, 72));
            assert_eq!(lines(&longer), lines(&late));
        }
    }

    #[test]
    fn a_line_spoken_over_blank_koma_goes_with_them() {
        let mut late = sheet().placed(Some(25), Some(72)).unwrap();
        late.lines[0].begin = 10;
        late.lines[1].koma = 18;
        assert!(late.check().is_ok());
        let early = late.placed(Some(13), Some(48)).unwrap();
        assert_eq!(lines(&early), [(0, 2), (42, 6)]);
        assert_eq!(lines(&early.placed(Some(1), Some(36)).unwrap()), [(30, 6)]);
    }

    #[test]
    fn drawings_that_do_not_fit_into_the_cut_are_refused_with_their_koma() {
        let error = sheet().placed(Some(25), Some(59)).unwrap_err().to_string();
        assert!(error.contains("on koma 25 to 60, and the cut is to have 59"), "{error}");
        assert!(sheet().placed(Some(25), Some(60)).is_ok());
        assert!(sheet().placed(Some(0), None).unwrap_err().to_string().contains("count from 1"));
        for (at, length) in [(usize::MAX, None), (1, Some(usize::MAX)), (MOST_KOMA, None)] {
            assert!(sheet().placed(Some(at), length).is_err(), "{at} {length:?}");
        }
    }
}
