//! The tolerant reader of the motion table: it accepts every spelling that real programs write, and reports
//! errors with their place.

use super::columns::Columns;
use super::number_spellings::piece;
use super::scanner::{Scanner, quoted};
use super::warnings::{ROW_CUT, VALUE_HELD};
use crate::error::Error;
use crate::motion::{Axis, Channel, Skeleton};

/// The description of a motion table: its skeleton, columns and declared length.
#[derive(Clone, Copy)]
pub(super) struct Table<'h> {
    pub(super) skeleton: &'h Skeleton,
    pub(super) columns: &'h Columns,
    /// Number of frames that the file declares.
    pub(super) said: usize,
    /// Whether to repair the table: a non-finite value becomes NaN, to be held later, and surplus values in
    /// a row are dropped.
    pub(super) repair: bool,
}

/// The values of a motion table.
pub(super) struct Rows {
    /// Whole rows, with every column of the file.
    pub(super) values: Vec<f64>,
    /// Number of values in an incomplete last row, which are dropped.
    pub(super) cut: usize,
}

impl Table<'_> {
    /// Reads the table, from behind the frame time to the end of the text.
    ///
    /// A line is a frame if the number or widths of the lines suggest it. Otherwise frames may spread over
    /// lines, and only the number of values counts.
    pub(super) fn read(self, scanner: &mut Scanner) -> Result<Rows, Error> {
        let width = self.columns.width();
        scanner.takes_commas = !scanner.rest().contains(&b'.');
        // A value and its separator take at least two bytes, so a false frame count cannot reserve more
        // than that.
        let most = scanner.rest().len() / 2 + 1;
        let mut values = Vec::with_capacity(self.said.saturating_mul(width).min(most));
        let mut lines = Lines { width, ..Lines::default() };
        loop {
            let from = scanner.at();
            let has_more = scanner.has_more();
            let at = scanner.at();
            if !has_more || scanner.text()[from..at].iter().any(|byte| b"\n\r".contains(byte)) {
                lines.end(values.len(), self.repair);
            }
            if !has_more {
                break;
            }
            match scanner.value()? {
                Some(value) => values.push(value),
                None => {
                    self.note_no_value(
                        scanner,
                        at,
                        lines.is_regular(values.len()).then_some(values.len()),
                    )?;
                    values.push(f64::NAN);
                }
            }
            lines.add(at, scanner.at());
        }
        if lines.are_frames(self.said, values.len()) {
            self.check(&lines, scanner)?;
            lines.cut_extras(&mut values);
        }
        let cut = values.len() % width;
        if cut == values.len() {
            let message = format!(
                "expected {width} values for the first frame, found {cut}: there is no motion"
            );
            return Err(scanner.error(scanner.text().len(), message));
        }
        values.truncate(values.len() - cut);
        Ok(Rows { values, cut })
    }

    /// Returns an error at the first row of a wrong width, unless it is to be repaired.
    fn check(self, lines: &Lines, scanner: &mut Scanner) -> Result<(), Error> {
        let width = self.columns.width();
        let mut faults = [lines.short, lines.long.filter(|_| !self.repair)];
        faults.sort_by_key(|fault| fault.map_or(usize::MAX, |fault| fault.at));
        if let Some(Fault { at, found }) = faults[0].or(faults[1]) {
            let out = if found > width { "; --repair leaves the rest out" } else { "" };
            let message = format!("expected {width} values in this row, found {found}{out}");
            return Err(scanner.error(at, message));
        }
        for Extras { at, found, .. } in &lines.extras {
            scanner.notices.add(ROW_CUT, *at, || {
                format!("expected {width} values in this row, found {found}; the rest is left out")
            });
        }
        Ok(())
    }

    /// Handles a non-finite value: returns an error, or records a notice if repairs are on. `index` is its
    /// place in the table, if the lines so far make that certain.
    fn note_no_value(
        self,
        scanner: &mut Scanner,
        at: usize,
        index: Option<usize>,
    ) -> Result<(), Error> {
        let what = || index.map_or(String::new(), |index| self.described(index));
        if !self.repair {
            let out = "; --repair holds the value before it";
            return Err(scanner.no_value(at, &what(), out));
        }
        scanner.notices.add(VALUE_HELD, at, || {
            format!("expected a number{}, found none; the value before it is held", what())
        });
        Ok(())
    }

    /// Describes a value of the table by its index, such as ` for Zrotation of "Spine" in frame 3`.
    fn described(self, index: usize) -> String {
        let (frame, column) = (index / self.columns.width(), index % self.columns.width());
        let Some(channel) = self.columns.channel(column) else {
            return format!(" in frame {frame}");
        };
        let owner = self.skeleton.joints.iter().find_map(|joint| {
            let channel = joint.channels.get(channel.checked_sub(joint.first_channel)?)?;
            Some((joint, channel))
        });
        owner.map_or(String::new(), |(joint, channel)| {
            let name = match channel {
                Channel::Position(axis) => format!("{}position", letter(*axis)),
                Channel::Rotation(axis) => format!("{}rotation", letter(*axis)),
            };
            let joint = quoted(joint.name.as_bytes());
            format!(" for {name} of {joint} in frame {frame}")
        })
    }
}

fn letter(axis: Axis) -> char {
    match axis {
        Axis::X => 'X',
        Axis::Y => 'Y',
        Axis::Z => 'Z',
    }
}

/// Counts the values in the first non-empty line, to verify a doubtful width. Consumes no input.
pub(super) fn first_line(scanner: &Scanner) -> usize {
    let mut rest = scanner.rest().trim_ascii_start();
    let mut values = 0;
    loop {
        let length = piece(rest).len();
        if length == 0 {
            return values;
        }
        values += 1;
        rest = &rest[length..];
        let blanks = rest.iter().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
        rest = &rest[blanks..];
    }
}

/// A row whose width differs from that of a frame.
#[derive(Clone, Copy)]
struct Fault {
    /// Byte of the missing value, or of the first surplus one.
    at: usize,
    /// Number of values in the row.
    found: usize,
}

/// The surplus values of a row: the byte of the first, the row's number of values, and their index range in
/// the table.
struct Extras {
    at: usize,
    found: usize,
    first: usize,
    past: usize,
}

/// Statistics of the lines with values.
#[derive(Default)]
struct Lines {
    /// Number of values in a frame.
    width: usize,
    count: usize,
    full: usize,
    too_long: usize,
    /// The first line that is too short, apart from the last line.
    short: Option<Fault>,
    long: Option<Fault>,
    /// The last line, if it is too short.
    cut: Option<Fault>,
    extras: Vec<Extras>,
    /// The current line: its number of values, the end of the last one, the start of the first surplus one.
    values: usize,
    end: usize,
    extra: usize,
}

impl Lines {
    /// Adds a value to the current line.
    fn add(&mut self, at: usize, end: usize) {
        if self.values == self.width {
            self.extra = at;
        }
        self.values += 1;
        self.end = end;
    }

    /// Ends the current line; lines without values are ignored. `total` is the number of values in the
    /// table so far.
    fn end(&mut self, total: usize, keep_extras: bool) {
        let (found, width) = (std::mem::take(&mut self.values), self.width);
        if found == 0 {
            return;
        }
        self.count += 1;
        if let Some(fault) = self.cut.take() {
            self.short.get_or_insert(fault);
        }
        if found == width {
            self.full += 1;
        } else if found < width {
            self.cut = Some(Fault { at: self.end, found });
        } else {
            self.too_long += 1;
            self.long.get_or_insert(Fault { at: self.extra, found });
            if keep_extras {
                let first = total - (found - width);
                self.extras.push(Extras { at: self.extra, found, first, past: total });
            }
        }
    }

    /// Whether every line so far is a frame, and the current line begins one.
    fn is_regular(&self, total: usize) -> bool {
        self.full == self.count && self.count * self.width + self.values == total
    }

    /// Whether each line is a frame: there are as many lines as declared frames, or at least half of the
    /// lines are wide enough. If the number of values matches the declaration, only the number of lines
    /// counts.
    fn are_frames(&self, said: usize, values: usize) -> bool {
        let fits = said.checked_mul(self.width) == Some(values);
        let are_wide = self.count > 1 && 2 * (self.full + self.too_long) >= self.count;
        self.count == said || (!fits && (are_wide || self.full == self.count))
    }

    /// Removes the surplus values from the table.
    fn cut_extras(&self, values: &mut Vec<f64>) {
        let Some(first) = self.extras.first() else { return };
        let mut length = first.first;
        let nexts = self.extras.iter().skip(1).map(|next| next.first).chain([values.len()]);
        for (extras, next) in self.extras.iter().zip(nexts) {
            values.copy_within(extras.past..next, length);
            length += next - extras.past;
        }
        values.truncate(length);
    }
}
