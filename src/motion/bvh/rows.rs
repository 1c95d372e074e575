//! How many frames a table of values holds that has another size than the file says.

use super::number::is_blank;
use super::scanner::Scanner;
use crate::error::{Error, Warning};

/// A motion table as the file describes it.
#[derive(Clone, Copy)]
pub(super) struct Table {
    /// The byte it starts at.
    pub(super) begin: usize,
    /// Columns.
    pub(super) channels: usize,
    /// Frames that the file says it has.
    pub(super) said: usize,
    /// Values that it does have.
    pub(super) values: usize,
}

/// A line with values on it: how many, and where the line of the file starts.
struct Row<'a> {
    text: &'a [u8],
    at: usize,
    values: usize,
}

impl Table {
    /// The number of complete frames, with a warning when that is not what the file says.
    ///
    /// A row too short or too long is an error at that row; only a last row cut short is dropped.
    pub(super) fn complete_frames(
        self,
        scanner: &Scanner,
    ) -> Result<(usize, Option<Warning>), Error> {
        if self.said.checked_mul(self.channels) == Some(self.values) {
            return Ok((self.said, None));
        }
        let bytes = scanner.bytes();
        if self.is_one_frame_a_line(bytes) {
            self.check_lines(bytes, scanner)?;
        }
        let frames = self.values / self.channels;
        if frames == 0 {
            let message = format!(
                "expected {} values for the first frame, found {}: there is no motion",
                self.channels, self.values
            );
            return Err(scanner.error(bytes.len(), message));
        }
        Ok((frames, Some(self.mismatch(frames))))
    }

    fn mismatch(self, frames: usize) -> Warning {
        let cut = match self.values % self.channels {
            0 => String::new(),
            left => format!(" and {left} values of a cut one, left out"),
        };
        let (said, s) = (self.said, if frames == 1 { "" } else { "s" });
        let message =
            format!("the file says {said} frames and has {frames} complete frame{s}{cut}");
        Warning::new("W_FRAMES_MISMATCH", message)
    }

    /// Whether the lines mean anything: as many as frames, or at least half of them as wide as a
    /// frame. Otherwise frames are spread over lines and only the number of values counts.
    fn is_one_frame_a_line(self, bytes: &[u8]) -> bool {
        let (mut lines, mut full) = (0, 0);
        for row in self.rows(bytes) {
            lines += 1;
            full += usize::from(row.values == self.channels);
        }
        lines == self.said || 2 * full >= lines
    }

    fn check_lines(self, bytes: &[u8], scanner: &Scanner) -> Result<(), Error> {
        let mut rows = self.rows(bytes).peekable();
        while let Some(row) = rows.next() {
            let is_cut_last = rows.peek().is_none() && row.values < self.channels;
            if row.values != self.channels && !is_cut_last {
                let (expected, found) = (self.channels, row.values);
                let message = format!("expected {expected} values in this row, found {found}");
                return Err(scanner.error(row.at + row.fault(self.channels), message));
            }
        }
        Ok(())
    }

    fn rows(self, bytes: &[u8]) -> impl Iterator<Item = Row<'_>> {
        let mut at = self.begin;
        bytes[self.begin..]
            .split(|byte| matches!(byte, b'\n' | b'\r'))
            .map(move |text| {
                let row = Row { text, at, values: words(text).count() };
                at += text.len() + 1;
                row
            })
            .filter(|row| row.values > 0)
    }
}

impl Row<'_> {
    /// Where in the line a value is missing or one too many stands.
    fn fault(&self, channels: usize) -> usize {
        let (mut words, mut after_blank) = (0, true);
        for (index, &byte) in self.text.iter().enumerate() {
            words += usize::from(after_blank && !is_blank(byte));
            if words > channels {
                return index;
            }
            after_blank = is_blank(byte);
        }
        self.text.trim_ascii_end().len()
    }
}

fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|&byte| is_blank(byte)).filter(|word| !word.is_empty())
}
