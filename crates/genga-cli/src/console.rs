//! Messages for people, on stderr and never mixed with data, and aligned tables.

use std::fmt::Display;
use std::io::{IsTerminal, Write, stderr};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use genga::error::Warning;
use genga::motion::bvh::warnings::FRAMES_MISMATCH;
use genga::sanitize::shown_lines;
use genga_files::STILL_LIMB;
use genga_read::KEY_FAR;

/// Prints messages; `--quiet` silences all but errors and losses.
#[derive(Debug)]
pub(super) struct Words {
    quiet: bool,
}

impl Words {
    pub(super) fn new(quiet: bool) -> Self {
        Self { quiet }
    }

    /// Prints a line, unless `--quiet`.
    pub(super) fn say(&self, line: impl Display) {
        if !self.quiet {
            write_line(&line);
        }
    }

    /// Prints that something is missing, even with `--quiet`.
    pub(super) fn lose(&self, loss: impl Display) {
        write_line(&loss);
    }

    /// Prints a reader's warning about its file. A loss is printed even with `--quiet`.
    pub(super) fn warn(&self, warning: &Warning) {
        self.warn_of("", warning);
    }

    /// Prints a warning with a prefix that names the file.
    pub(super) fn warn_of(&self, of: &str, warning: &Warning) {
        if !self.quiet || is_loss(warning) {
            write_line(&format_args!("{of}{warning}"));
        }
    }

    /// Prints a loss with `--quiet`, when no other message would mention it.
    pub(super) fn warn_if_quiet(&self, warning: &Warning) {
        if self.quiet {
            self.warn(warning);
        }
    }

    /// Prints the error that stops the program, even with `--quiet`.
    pub(super) fn error(&self, error: impl Display) {
        write_line(&format_args!("genga: {error}"));
    }

    /// Shows a spinner for long work, only on a terminal. It disappears when dropped.
    pub(super) fn working(&self) -> Bar {
        self.bar("{spinner} {msg} ({elapsed})", ProgressBar::new_spinner)
    }

    /// Shows a progress bar for a known number of pieces.
    pub(super) fn counting(&self, count: usize, what: &str) -> Bar {
        let look = format!("{{wide_bar}} {{pos}} of {{len}} {what} ({{elapsed}}, {{eta}} left)");
        self.bar(&look, || ProgressBar::new(count as u64))
    }

    /// Shows a progress bar for pieces of different size: the time left is estimated from bytes, not from the count.
    pub(super) fn weighing(&self, bytes: u64) -> Bar {
        self.bar("{wide_bar} {msg} ({elapsed}, {eta} left)", || ProgressBar::new(bytes))
    }

    fn bar(&self, look: &str, begin: impl FnOnce() -> ProgressBar) -> Bar {
        Bar(self.is_watched().then(|| {
            let bar = begin();
            if let Ok(style) = ProgressStyle::with_template(look) {
                bar.set_style(style);
            }
            bar.enable_steady_tick(Duration::from_millis(120));
            bar
        }))
    }

    fn is_watched(&self) -> bool {
        !self.quiet && stderr().is_terminal()
    }
}

/// Whether a warning reports missing data: a file that ends early, in the middle of a row or before its last; keys far
/// behind the others; or an arm or a leg missing in the output.
pub(super) fn is_loss(warning: &Warning) -> bool {
    [FRAMES_MISMATCH, KEY_FAR, STILL_LIMB].contains(&warning.code)
}

/// A progress display, which several threads may update.
pub(super) struct Bar(Option<ProgressBar>);

impl Bar {
    pub(super) fn on(&self, what: &'static str) {
        self.0.iter().for_each(|bar| bar.set_message(what));
    }

    /// Marks a piece of that many bytes as done, with a message.
    pub(super) fn weigh(&self, bytes: u64, what: String) {
        if let Some(bar) = &self.0 {
            bar.set_message(what);
            bar.inc(bytes);
        }
    }

    pub(super) fn count(&self) {
        self.0.iter().for_each(|bar| bar.inc(1));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.iter().for_each(ProgressBar::finish_and_clear);
    }
}

/// Formats a count with its noun: `1 drawing`, `3 drawings`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// Formats a measure with two decimals, or as – if there is none.
pub(super) fn two(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| format!("{value:.2}"))
}

/// Writes to stderr. A closed stderr only means that nobody listens, so errors are ignored.
fn write_line(line: &dyn Display) {
    let _ = writeln!(stderr(), "{}", shown_lines(&line.to_string()));
}

/// A table (表) for people, whose columns line up even with Japanese words.
#[derive(Debug, Default)]
pub(super) struct Table(Vec<Vec<String>>);

impl Table {
    /// Adds a row.
    pub(super) fn row<Cell: Into<String>>(&mut self, cells: impl IntoIterator<Item = Cell>) {
        self.0.push(cells.into_iter().map(Into::into).collect());
    }

    /// Renders the table with two spaces between columns: the first `left` columns are left-aligned, the others
    /// right-aligned.
    pub(super) fn text(&self, left: usize) -> String {
        let columns = self.0.iter().map(Vec::len).max().unwrap_or(0);
        let widest = |column: usize| {
            self.0.iter().filter_map(|row| row.get(column)).map(|cell| width(cell)).max()
        };
        let widths: Vec<usize> = (0..columns).map(|column| widest(column).unwrap_or(0)).collect();
        let mut text = String::new();
        for row in &self.0 {
            let mut line = String::new();
            for (column, cell) in row.iter().enumerate() {
                let blanks = " ".repeat(widths[column] - width(cell));
                let gap = if column > 0 { "  " } else { "" };
                line += gap;
                line += &if column < left {
                    format!("{cell}{blanks}")
                } else {
                    format!("{blanks}{cell}")
                };
            }
            text += line.trim_end();
            text.push('\n');
        }
        text
    }
}

/// Width of a word on a screen in cells: two per character from U+2E80 (CJK) on.
fn width(word: &str) -> usize {
    word.chars().map(|letter| if letter >= '\u{2e80}' { 2 } else { 1 }).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_whatever_they_are_written_in() {
        let mut table = Table::default();
        table.row(["genga", "原画のみ", "12"]);
        table.row(["on screen", "画面", "1.25"]);
        table.row(["none"]);
        assert_eq!(table.text(2), "genga      原画のみ    12\non screen  画面      1.25\nnone\n");
        assert_eq!(Table::default().text(1), "");
    }
}
