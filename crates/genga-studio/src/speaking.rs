//! Spoken lines (セリフ): opens the form for a new line, or for an existing one.

use std::ops::Range;

use super::Studio;
use super::open_take::Results;
use super::spoken_lines;
use genga::edits::Speech;

impl Studio {
    /// Opens the form for a new line over some koma, by default over the played range. Without a range, opens the line
    /// at the play head, or a new line that begins there and lasts a second.
    pub(super) fn ask_speech(&mut self, koma: Option<Range<usize>>) {
        let Some(take) = &mut self.take else { return };
        let Results { breakdown, wanted, .. } = take.results();
        let sheet = breakdown.sheet;
        let spoken = spoken_lines::all(wanted, sheet, breakdown.clip.last());
        let at = self.player.at;
        let marked = koma.or_else(|| self.player.range.clone());
        let here =
            spoken.iter().find(|spoken| (spoken.line.begin..spoken.line.past()).contains(&at));
        if let Some(here) = here.filter(|_| marked.is_none()) {
            return self.speech.edit(here.speech, here.line.begin..here.line.past());
        }
        let second = sheet.clock.koma_rate.round().max(1.0) as usize;
        let length = sheet.length().max(1);
        let koma = marked.unwrap_or(at..at + second);
        let begin = koma.start.min(length - 1);
        let koma = begin..koma.end.clamp(begin + 1, length);
        // Most often the last speaker goes on.
        let before = spoken.iter().rfind(|spoken| spoken.line.begin <= begin);
        let speaker = before.map(|spoken| spoken.speech.speaker.clone()).unwrap_or_default();
        self.speech.ask(koma, speaker);
    }

    /// Opens the form for an existing line.
    pub(super) fn edit_speech(&mut self, speech: &Speech) {
        let Some(take) = &mut self.take else { return };
        let Results { breakdown, wanted, .. } = take.results();
        let spoken = spoken_lines::all(wanted, breakdown.sheet, breakdown.clip.last());
        if let Some(found) = spoken.iter().find(|spoken| spoken.speech == speech) {
            self.speech.edit(speech, found.line.begin..found.line.past());
        }
    }
}
