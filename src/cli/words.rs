//! What the program says to a person: sentences on stderr, never data, and tables that line up.

use std::fmt::Display;
use std::io::{IsTerminal, Write, stderr};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::deliver::STILL_LIMB;
use crate::error::Warning;
use crate::motion::bvh::warnings::FRAMES_MISMATCH;
use crate::motion::file::KEY_FAR;
use crate::plain::shown_lines;

/// The program's voice.
#[derive(Debug)]
pub(super) struct Words {
    quiet: bool,
}

impl Words {
    pub(super) fn new(quiet: bool) -> Self {
        Self { quiet }
    }

    /// A line, unless `--quiet`.
    pub(super) fn say(&self, line: impl Display) {
        if !self.quiet {
            write_line(&line);
        }
    }

    /// What is missing, in words: said even when quiet.
    pub(super) fn lose(&self, loss: impl Display) {
        write_line(&loss);
    }

    /// What a reader says of its file. A loss is said even when quiet.
    pub(super) fn warn(&self, warning: &Warning) {
        self.warn_of("", warning);
    }

    /// The same with a beginning that says of which file.
    pub(super) fn warn_of(&self, of: &str, warning: &Warning) {
        if !self.quiet || is_loss(warning) {
            write_line(&format_args!("{of}{warning}"));
        }
    }

    /// A loss, where nothing else will be said of it.
    pub(super) fn warn_if_quiet(&self, warning: &Warning) {
        if self.quiet {
            self.warn(warning);
        }
    }

    /// What stops the program: said even when quiet.
    pub(super) fn error(&self, error: impl Display) {
        write_line(&format_args!("genga: {error}"));
    }

    /// A sign of life for work that may take long, on a terminal alone. It goes when dropped.
    pub(super) fn working(&self) -> Bar {
        self.bar("{spinner} {msg} ({elapsed})", ProgressBar::new_spinner)
    }

    /// The same for work of which it is known how much there is.
    pub(super) fn counting(&self, count: usize, what: &str) -> Bar {
        let look = format!("{{wide_bar}} {{pos}} of {{len}} {what} ({{elapsed}}, {{eta}} left)");
        self.bar(&look, || ProgressBar::new(count as u64))
    }

    /// The same for pieces that differ in size: what is left is told by their bytes, not by their count.
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

/// Whether something is missing: of a clip, whose file ends early, in the middle of a row or before its last, or has keys
/// far behind the others; or of what is written, an arm or a leg.
pub(super) fn is_loss(warning: &Warning) -> bool {
    [FRAMES_MISMATCH, KEY_FAR, STILL_LIMB].contains(&warning.code)
}

/// What is being done, or how much of it is; several threads may count.
pub(super) struct Bar(Option<ProgressBar>);

impl Bar {
    pub(super) fn on(&self, what: &'static str) {
        self.0.iter().for_each(|bar| bar.set_message(what));
    }

    /// A piece of so many bytes is done; `what` says it.
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

/// A count with its noun: `1 drawing`, `3 drawings`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// A measure with two places; – where there is none.
pub(super) fn two(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| format!("{value:.2}"))
}

/// A closed stderr is nobody listening: that is no reason to stop.
fn write_line(line: &dyn Display) {
    let _ = writeln!(stderr(), "{}", shown_lines(&line.to_string()));
}

/// A table (表) for people: columns that line up, Japanese words among them.
#[derive(Debug, Default)]
pub(super) struct Table(Vec<Vec<String>>);

impl Table {
    /// Adds a row.
    pub(super) fn row<Cell: Into<String>>(&mut self, cells: impl IntoIterator<Item = Cell>) {
        self.0.push(cells.into_iter().map(Into::into).collect());
    }

    /// The text, two blanks between columns: the first `left` of them begin in line, the others end so.
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

/// How many places a word takes on a screen: two a letter from the Japanese kana and signs on.
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
