//! The takes of a folder (テイク一覧), each open, done or flagged.

use std::path::{Path, PathBuf};

use egui::{Button, RichText, ScrollArea, Ui};

use super::command::Command;
use super::focus::{self, Part};
use super::theme::Look;
use super::words::Words;

/// Name of the file in the folder that keeps the marks of its takes.
const FILE: &str = "genga-takes.txt";

/// A person's verdict on a take.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Mark {
    #[default]
    None,
    Done,
    Flagged,
}

impl Mark {
    fn word(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Done => "done",
            Self::Flagged => "flagged",
        }
    }

    fn said(self, words: Words) -> &'static str {
        match self {
            Self::None => "",
            Self::Done => words.say("done", "済"),
            Self::Flagged => words.say("flagged", "要確認"),
        }
    }
}

/// A folder of takes.
#[derive(Debug, Clone, Default)]
pub(super) struct Takes {
    folder: PathBuf,
    /// The clips and their marks.
    clips: Vec<(PathBuf, Mark)>,
    /// Whether the next take gets the settings of the previous one. Default: each has its own.
    pub(super) share: bool,
}

impl Takes {
    /// Lists the clips of a folder, with the marks of an earlier session.
    pub(super) fn new(folder: &Path, clips: Vec<PathBuf>, marks: &str) -> Self {
        let mark = |clip: &Path| {
            let name = clip.file_name().unwrap_or_default().to_string_lossy();
            let words = marks.lines().filter_map(|line| line.split_once(' '));
            let word = words.filter(|(_, of)| *of == name).map(|(word, _)| word).next_back();
            let all = [Mark::Done, Mark::Flagged];
            all.into_iter().find(|mark| Some(mark.word()) == word).unwrap_or_default()
        };
        let clips = clips.into_iter().map(|clip| (clip.clone(), mark(&clip))).collect();
        Self { folder: folder.to_owned(), clips, share: false }
    }

    /// Whether there are takes to go through.
    pub(super) fn is_open(&self) -> bool {
        !self.clips.is_empty()
    }

    /// The take `by` places after another. `None` beyond the ends.
    pub(super) fn step(&self, from: &Path, by: isize) -> Option<PathBuf> {
        let at = self.clips.iter().position(|(clip, _)| clip == from)?;
        let (clip, _) = self.clips.get(at.checked_add_signed(by)?)?;
        Some(clip.clone())
    }

    /// Sets the mark of a take, or clears it if it is set already.
    pub(super) fn mark(&mut self, clip: &Path, mark: Mark) {
        for (own, before) in &mut self.clips {
            if own == clip {
                *before = if *before == mark { Mark::None } else { mark };
            }
        }
    }

    /// The file of the marks, and its text.
    pub(super) fn kept(&self) -> (PathBuf, String) {
        let line = |(clip, mark): &(PathBuf, Mark)| {
            let name = clip.file_name().unwrap_or_default().to_string_lossy();
            (*mark != Mark::None).then(|| format!("{} {name}\n", mark.word()))
        };
        (Self::file(&self.folder), self.clips.iter().filter_map(line).collect())
    }

    /// Path of the file with the marks of a folder.
    pub(super) fn file(folder: &Path) -> PathBuf {
        folder.join(FILE)
    }

    /// Shows the list.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        on_table: &Path,
        look: &Look,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let done = self.clips.iter().filter(|(_, mark)| *mark == Mark::Done).count();
        let count = self.clips.len();
        ui.strong(format!("{} {done} / {count}", words.say("Takes", "テイク")));
        ui.horizontal_wrapped(|ui| {
            for (english, japanese, command) in [
                ("Previous", "前へ", Command::Take(-1)),
                ("Next", "次へ", Command::Take(1)),
                ("Done", "済", Command::Mark(true)),
                ("Flag", "要確認", Command::Mark(false)),
            ] {
                let button = ui.button(words.say(english, japanese));
                if command == Command::Take(-1) {
                    Part::Takes.begins(&button);
                }
                if button.clicked() {
                    commands.push(command);
                }
            }
        });
        let share = words.say("One recipe for all", "設定を共通にする");
        ui.checkbox(&mut self.share, share);
        ui.separator();
        ScrollArea::vertical().id_salt("takes").auto_shrink(false).show(ui, |ui| {
            for (clip, mark) in &self.clips {
                let name = clip.file_stem().unwrap_or_default().to_string_lossy();
                let said = mark.said(words);
                let color = match mark {
                    Mark::Flagged => look.genga,
                    Mark::Done => look.faint,
                    Mark::None => look.ink,
                };
                let text = if said.is_empty() { name.into() } else { format!("{name} · {said}") };
                let text = RichText::new(text).color(color);
                let button = Button::selectable(clip == on_table, text).truncate();
                if ui.add(button).clicked() && clip != on_table {
                    commands.push(Command::Open(clip.clone()));
                }
            }
            focus::bring_into_view(ui);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_are_stepped_through_marked_and_read_back() {
        let folder = Path::new("/shots");
        let clips: Vec<PathBuf> =
            ["a b.bvh", "c.bvh", "d.bvh"].map(|name| folder.join(name)).into();
        let mut takes = Takes::new(folder, clips.clone(), "flagged d.bvh\nlost x.bvh\n");
        assert_eq!(takes.step(&clips[0], 1), Some(clips[1].clone()));
        assert_eq!((takes.step(&clips[0], -1), takes.step(&clips[2], 1)), (None, None));
        takes.mark(&clips[0], Mark::Done);
        takes.mark(&clips[1], Mark::Done);
        takes.mark(&clips[1], Mark::Done);
        let (file, text) = takes.kept();
        assert_eq!((file, &text[..]), (Takes::file(folder), "done a b.bvh\nflagged d.bvh\n"));
        assert_eq!(Takes::new(folder, clips, &text).clips, takes.clips);
    }
}
