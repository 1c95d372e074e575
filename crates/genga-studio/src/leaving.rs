//! Leaving (席を離れる) a take with unsaved work: another clip is opened, or the window is closed. It is asked first. What is
//! not saved is kept beside the clip in any case, and offered again when the clip is opened.

use std::path::PathBuf;

use egui::{Ui, ViewportCommand};

use super::Studio;
use super::command::Command;
use super::focus::Part;
use super::notice;
use super::theme::Look;
use super::words::Words;

/// What is to be done once the take may be left.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Leaving {
    /// Opens another clip or a folder.
    Open(PathBuf),
    /// Closes the window.
    Close,
}

impl Studio {
    /// Opens a clip or a folder; asks first if the take on the table has unsaved work.
    pub(super) fn open_or_ask(&mut self, path: PathBuf) {
        match self.is_changed() {
            true => self.leaving = Some(Leaving::Open(path)),
            false => self.open_folder_or_clip(&path),
        }
    }

    fn is_changed(&self) -> bool {
        self.take.as_ref().is_some_and(super::open_take::Take::is_changed)
    }

    /// Keeps the window open while there is unsaved work, until it is answered what happens to it.
    pub(super) fn stay_open(&mut self, ui: &Ui) {
        let is_closing = ui.input(|input| input.viewport().close_requested());
        if is_closing && !self.may_close && self.is_changed() {
            ui.ctx().send_viewport_cmd(ViewportCommand::CancelClose);
            self.leaving = Some(Leaving::Close);
        }
    }

    /// Leaves the take, with its recipe saved or not.
    pub(super) fn leave(&mut self, ui: &Ui, saves: bool) {
        let (Some(leaving), Some(take)) = (self.leaving.take(), &mut self.take) else { return };
        if saves && let Err(text) = take.save(&*self.desk) {
            return self.fail(text);
        }
        match leaving {
            Leaving::Open(path) => self.open_folder_or_clip(&path),
            Leaving::Close => {
                self.may_close = true;
                ui.ctx().send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }
}

/// Asks what happens to unsaved work. `name` is that of the take.
pub(super) fn ask(
    ui: &mut Ui,
    (leaving, name): (&Leaving, &str),
    look: &Look,
    words: Words,
    commands: &mut Vec<Command>,
) {
    notice::one(ui, look.playhead, |ui| {
        ui.label(match words.is_japanese() {
            true => format!("{name} に保存していない修正があります。"),
            false => format!("{name} has unsaved corrections."),
        });
        ui.horizontal_wrapped(|ui| {
            let (save, keep) = match leaving {
                Leaving::Open(_) => (
                    words.say("Save, then open", "保存して開く"),
                    words.say(
                        "Open, and offer them again later",
                        "保存せずに開き、次に開いたとき復元",
                    ),
                ),
                Leaving::Close => (
                    words.say("Save, then close", "保存して閉じる"),
                    words.say(
                        "Close, and offer them again later",
                        "保存せずに閉じ、次に開いたとき復元",
                    ),
                ),
            };
            let save = ui.button(save);
            Part::Notices.begins(&save);
            if save.clicked() {
                commands.push(Command::Leave { saves: true });
            }
            if ui.button(keep).clicked() {
                commands.push(Command::Leave { saves: false });
            }
            if ui.button(words.say("Stay here", "このまま続ける")).clicked() {
                commands.push(Command::Dismiss);
            }
        });
    });
}
