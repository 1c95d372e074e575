//! What happens between two frames: what comes from outside is collected, and results, history and autosave follow the
//! document.

use egui::Ui;

use super::Studio;
use super::curves::Curves;
use super::difference::Before;
use super::export_task::Exporting;
use super::key_menu::KeyPanel;
use super::notice::Message;
use super::open_take::Take;
use super::opening::Opening;
use super::player::Player;
use super::strip::Strip;
use super::task::{self, Task};
use super::timesheet::Timesheet;
use super::viewport::Viewport;
use super::welcome;

impl Studio {
    /// Collects what comes from outside: a clip that was read, results that were written, files that were chosen or
    /// dropped.
    pub(super) fn receive(&mut self, ui: &Ui) {
        if let Some(read) = self.opening.as_ref().and_then(Opening::look) {
            self.opening = None;
            match read {
                Ok(take) => self.put_on_table(take),
                Err(text) => {
                    let (_, formats) = welcome::formats(self.desk.has_names());
                    let japanese = Some(format!("開けるのは {formats}\n{text}"));
                    self.message = Some(Message { japanese, ..Message::failure(text) });
                }
            }
        }
        if let Some(written) = self.exporting.as_ref().and_then(Exporting::look) {
            let to = self.exporting.take().and_then(|exporting| {
                self.number_as_exported(&exporting);
                exporting.to
            });
            match (written, to) {
                (Ok(text), Some(to)) => {
                    let (next, japanese) = to.next();
                    self.tell(&format!("{next}\n{text}"), &format!("{japanese}\n{text}"));
                }
                (Ok(text), None) => self.say(text),
                (Err(text), _) => self.fail(text),
            }
        }
        match self.choosing.as_ref().map(Task::look) {
            Some(task::Look::Done(chosen)) => {
                self.choosing = None;
                chosen.into_iter().for_each(|path| self.open_any(&path));
            }
            Some(task::Look::BrokeOff) => self.choosing = None,
            Some(task::Look::Waiting) | None => {}
        }
        match self.choosing_folder.as_ref().map(Task::look) {
            Some(task::Look::Done(chosen)) => {
                self.choosing_folder = None;
                chosen.into_iter().for_each(|path| self.order.take(&path));
            }
            Some(task::Look::BrokeOff) => self.choosing_folder = None,
            Some(task::Look::Waiting) | None => {}
        }
        self.map.receive();
        let is_waiting = self.opening.is_some()
            || self.exporting.is_some()
            || self.choosing.is_some()
            || self.choosing_folder.is_some()
            || self.is_looking()
            || self.map.is_waiting();
        if is_waiting {
            ui.ctx().request_repaint_after_secs(task::LOOK_AGAIN);
        }
        let dropped =
            ui.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.open_any(&path);
        }
    }

    /// Numbers the drawings as in the files that were just written, if they are of the clip on the table.
    fn number_as_exported(&mut self, exported: &Exporting) {
        if let Some(take) = self.take.as_mut().filter(|take| take.path == exported.clip) {
            take.number_as_in(&*self.desk, &exported.folder);
        }
    }

    fn put_on_table(&mut self, mut take: Take) {
        if let Some(before) = self.take.as_ref().filter(|_| self.takes.share) {
            take.wanted.take_settings(&before.document().recipe);
        }
        take.number_as_in(&*self.desk, &self.export_folder(&take));
        let breakdown = take.results().breakdown;
        self.curves = Curves::new(breakdown.filtered.movers_first(breakdown.clip.skeleton()));
        (self.player, self.chosen) = (Player::default(), 0);
        self.viewport = Viewport::new(&take.scene);
        self.timesheet = Timesheet::default();
        self.strip = Strip::default();
        self.key_panel = KeyPanel::default();
        self.speech.close();
        self.map.forget();
        self.desk.remember(&take.path);
        self.recent = self.desk.recent();
        (self.held, self.before, self.message) = (None, None, None);
        self.taken.clear();
        (self.difference, self.asked, self.is_before) = (None, None, false);
        self.searching = None;
        self.take = Some(take);
    }

    /// Ends a frame: updates the results and the history, and autosaves.
    pub(super) fn settle(&mut self, ui: &Ui) {
        let is_held = ui.input(|input| input.pointer.any_down());
        self.note_before(is_held);
        self.answer_keys(ui, is_held);
        let Some(take) = &mut self.take else { return };
        match take.renew(is_held) {
            Ok(false) => {}
            Ok(true) => {
                let breakdown = take.results().breakdown;
                self.difference = self.before.as_ref().map(|before| before.until(&breakdown));
                self.is_new = true;
                ui.ctx().request_repaint();
            }
            Err(error) => {
                self.message = Some(Message::failure(error.to_string()));
                ui.ctx().request_repaint();
            }
        }
        take.history.settle(&take.wanted, is_held);
        if is_held {
            return;
        }
        self.map.renew(take);
        // What was clicked without any change has no difference of its own.
        if let Some(difference) = self.difference.as_ref().filter(|_| self.is_new) {
            self.strip.reveal(difference);
        }
        (self.held, self.before, self.is_new) = (None, None, false);
        if let Err(text) = take.autosave(&*self.desk) {
            self.fail(text);
        }
    }

    /// Notes the sheet before a change: once for all that a drag changes.
    fn note_before(&mut self, is_held: bool) {
        let Some(take) = self.take.as_mut().filter(|_| self.before.is_none()) else { return };
        let is_asked = self.asked.is_some() || self.searching.is_some();
        if is_held || is_asked || take.is_behind() {
            let counts = take.counts();
            self.before = Some(Before::new(&take.results().breakdown, counts));
        }
    }
}
