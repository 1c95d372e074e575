//! Carries out the commands of pointer and keyboard.

use std::path::Path;

use egui::{Theme, Ui};

use super::Studio;
use super::column::Column;
use super::command::{Command, Seen};
use super::corrections::Correction;
use super::export_task::Exporting;
use super::focus;
use super::footage;
use super::open_take::{Results, Take};
use super::opening::Opening;
use super::passages;
use super::playhead_edits::Here;
use super::view_state::Taken;
use super::viewport::Orbit;
use super::words::Language;
use genga::error::Error;
use genga::recipe::Recipe;

impl Studio {
    /// Opens a clip with a recipe, by default the one saved beside it. The clip is read on its own thread.
    pub fn open(&mut self, clip: &Path, recipe: Option<&Path>) {
        self.opening = Some(Opening::begin(&self.desk, clip, recipe));
        self.message = None;
    }

    /// Sets a knob of the clip on the table, as its slider does, and computes the results again. The next frame shows
    /// them.
    ///
    /// # Errors
    /// Those of [`Recipe::set`] and of the chain.
    pub fn turn(&mut self, knob: &str, value: &str) -> Result<(), Error> {
        let Some(take) = &mut self.take else { return Ok(()) };
        take.wanted.recipe.set(knob, value)?;
        take.renew(false).map(drop)
    }

    /// Opens a recipe for the clip on the table, or a clip.
    pub fn open_any(&mut self, path: &Path) {
        let is_recipe = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        match &mut self.take {
            Some(take) if is_recipe => {
                if let Err(text) = take.open_recipe(&*self.desk, path) {
                    self.fail(text);
                }
            }
            _ if footage::is_beside(path) => self.put_beside(path),
            None if is_recipe => self.fail("Open a clip first, then its recipe.".into()),
            _ => self.open_or_ask(path.to_owned()),
        }
    }

    /// Carries out a command.
    pub(super) fn act(&mut self, ui: &Ui, command: Command) {
        self.tour.watch(&command);
        match command {
            Command::Play
            | Command::Koma(_)
            | Command::Drawing(_)
            | Command::Genga(_)
            | Command::First
            | Command::Last
            | Command::Go(_)
            | Command::LoopFrom
            | Command::LoopTo
            | Command::LoopAll => self.go(ui, &command),
            Command::Flip
            | Command::See(_)
            | Command::Look(_)
            | Command::Fit
            | Command::Zoom(_)
            | Command::Follow
            | Command::Onion
            | Command::Trails
            | Command::Exaggerated => self.look(&command),
            Command::ToggleKey
            | Command::Pin
            | Command::Nudge(_)
            | Command::NudgeFrame(_)
            | Command::Hold(_)
            | Command::Crowd(_) => self.correct_here(&command),
            Command::AskSpeech(koma) => self.ask_speech(koma),
            Command::EditSpeech(speech) => self.edit_speech(&speech),
            Command::AskFootage => self.ask_footage(),
            Command::Footage(footage) => self.set_footage(footage),
            Command::Place(placement) => self.viewport.placement = placement,
            Command::Silence => self.track.is_silent = !self.track.is_silent,
            Command::Freeze => self.freeze(),
            Command::FindAgain => self.find_again(),
            Command::CopyKeys => self.copy_keys(ui),
            Command::PasteKeys(text) => self.paste_keys(&text),
            Command::Other => self.take_other(),
            Command::Compare => self.compare(),
            Command::StripZoom => self.strip.zoom(),
            Command::Frames => self.counts_frames = !self.counts_frames,
            Command::SheetZoom(factor) => self.timesheet.zoom_by(factor),
            Command::Column(column) => self.chosen = column,
            Command::NextColumn => {
                let columns = self.take.iter_mut().map(|take| take.results().columns()).sum();
                self.chosen = (self.chosen + 1) % usize::max(columns, 1);
            }
            Command::Correct(_)
            | Command::CorrectOf(..)
            | Command::Drag(_)
            | Command::Set(..)
            | Command::SetAll(_)
            | Command::Preset(_)
            | Command::Defaults
            | Command::Undo
            | Command::Redo => self.change(command),
            Command::Passage => self.make_passage(),
            Command::Dissolve(frames) => self.dissolve(frames),
            Command::Keys(count) => self.ask_keys(ui, count),
            Command::StopSearch => self.searching = None,
            Command::Map => self.map.toggle(),
            Command::Movement => self.curves.movement = !self.curves.movement,
            Command::FocusName => self.key_panel.wants_focus = true,
            Command::Save => self.save(),
            Command::AskExport => self.ask_export(ui.input(|input| input.pointer.any_click())),
            Command::Export(order) => self.export(*order),
            Command::StopExport => self.exporting.iter().for_each(Exporting::stop),
            Command::ChooseFolder => self.choose_folder(),
            Command::OpenFile if !self.desk.has_names() => self.choose(),
            Command::OpenFile => {
                self.file.is_open = !self.file.is_open;
                self.file.wants_focus = self.file.is_open;
            }
            Command::Open(path) => {
                self.file.is_open = false;
                self.open_any(&path);
            }
            Command::Leave { saves } => self.leave(ui, saves),
            Command::SaveAs(path) => {
                self.file.is_open = false;
                self.save_as(&path);
            }
            Command::Take(by) => self.step_take(by),
            Command::Mark(is_done) => self.mark_take(is_done),
            Command::Choose => self.choose(),
            Command::Sample => self.open_sample(),
            Command::Tour => {
                self.tour.begin();
                self.is_help_open = false;
            }
            Command::TourStep(by) => self.tour.step(by),
            Command::EndTour => self.tour.end(),
            Command::Recover => self.take.iter_mut().for_each(Take::recover),
            Command::Discard => self.discard(),
            Command::Theme => {
                let other = if ui.theme() == Theme::Dark { Theme::Light } else { Theme::Dark };
                ui.ctx().set_theme(other);
            }
            Command::Language => {
                self.language = match self.language {
                    Language::English => Language::Japanese,
                    Language::Japanese => Language::English,
                };
            }
            Command::Panel(side) => {
                self.panels.toggle(side, ui.ctx().content_rect().size());
            }
            Command::Part(by) => focus::go(ui.ctx(), by),
            Command::Help => self.is_help_open = !self.is_help_open,
            Command::Dismiss => {
                ui.memory_mut(|memory| memory.focused().map(|id| memory.surrender_focus(id)));
                (self.message, self.is_help_open, self.file.is_open) = (None, false, false);
                self.order.order = None;
                self.speech.close();
                self.footage.is_open = false;
                (self.difference, self.leaving, self.searching) = (None, None, None);
            }
        }
        ui.ctx().request_repaint();
    }

    fn discard(&mut self) {
        let Some(take) = &mut self.take else { return };
        if let Err(text) = take.forget(&*self.desk) {
            self.fail(text);
        }
    }

    /// Moves the play head.
    fn go(&mut self, ui: &Ui, command: &Command) {
        let Some(take) = &mut self.take else { return };
        let columns = Column::all(&take.results().breakdown);
        let column = &columns[self.chosen.min(columns.len() - 1)];
        let (player, length) = (&mut self.player, column.length);
        let at = player.at;
        let now = ui.input(|input| input.time);
        match command {
            Command::Play => player.toggle(now, length),
            Command::Koma(by) => player.stop_at(at.saturating_add_signed(*by), length),
            Command::Drawing(by) => player.stop_at(column.step(at, *by, |_| true), length),
            Command::Genga(by) => {
                player.stop_at(column.step(at, *by, |cell| cell.genga.is_some()), length);
            }
            Command::First => player.stop_at(0, length),
            Command::Last => player.stop_at(length, length),
            Command::Go(koma) => player.go(*koma, length, now),
            Command::LoopFrom => player.mark(true, length),
            Command::LoopTo => player.mark(false, length),
            _ => player.range = None,
        }
    }

    /// Changes how the figures are shown.
    fn look(&mut self, command: &Command) {
        let viewport = &mut self.viewport;
        match command {
            Command::Flip => {
                let is_result = viewport.seen == Seen::Result;
                viewport.seen = if is_result { Seen::Source } else { Seen::Result };
            }
            Command::See(seen) => viewport.seen = *seen,
            Command::Look(side) => {
                let follows = viewport.orbit.follows;
                viewport.orbit = Orbit::from(*side);
                viewport.orbit.follows = follows;
            }
            Command::Fit => viewport.orbit.fit(),
            Command::Zoom(factor) => viewport.orbit.zoom_by(*factor),
            Command::Follow => viewport.orbit.follows = !viewport.orbit.follows,
            Command::Onion => viewport.onion = !viewport.onion,
            Command::Exaggerated => viewport.exaggerated = !viewport.exaggerated,
            _ => viewport.trails = !viewport.trails,
        }
    }

    /// Corrects the key at the play head, or the length of its drawing.
    fn correct_here(&mut self, command: &Command) {
        let Some(take) = &mut self.take else { return };
        // If two keys are pressed in one frame, the second acts on the result of the first.
        if let Err(error) = take.renew(false) {
            return self.fail(error.to_string());
        }
        let at = self.player.at;
        let Results { breakdown, wanted, .. } = take.results();
        let columns = Column::all(&breakdown);
        let column = &columns[self.chosen.min(columns.len() - 1)];
        let here = Here { clip: breakdown.clip, column, wanted, at };
        let Some(correction) = here.correction(command) else { return };
        if let Correction::Move(_, to) = &correction {
            let koma = column.clock.koma_from_frame(*to);
            self.player.stop_at(koma, column.length);
        }
        self.change(Command::Correct(correction));
    }

    /// Shows the sheet before the last change, or after it again.
    fn compare(&mut self) {
        let Some(take) = &self.take else { return };
        let (history, wanted) = (&take.history, &take.wanted);
        let can = if self.is_before { history.can_redo(wanted) } else { history.can_undo(wanted) };
        if can {
            let is_before = !self.is_before;
            self.change(if is_before { Command::Undo } else { Command::Redo });
            self.is_before = is_before;
        }
    }

    /// Changes the document.
    pub(super) fn change(&mut self, command: Command) {
        self.is_before = false;
        let passage = self.marked_passage();
        let Some(take) = &mut self.take else { return };
        let results = take.results();
        if let Command::Correct(Correction::Forbid(key, ban)) = &command
            && let Some(column) = Column::all(&results.breakdown).get(self.chosen)
        {
            let (frame, koma) = (key.unmoved(), column.koma_of(key.frame));
            self.taken.push(Taken { ban: *ban, frame, koma });
        }
        let column = results.named(self.chosen);
        let column = column.as_deref();
        let wanted = &mut take.wanted;
        let changed = match command {
            Command::Correct(correction) => {
                wanted.edits = correction.on(&wanted.edits, column);
                Ok(())
            }
            Command::CorrectOf(column, correction) => {
                wanted.edits = correction.on(&wanted.edits, column.as_deref());
                Ok(())
            }
            Command::Drag(correction) => {
                let before = self.held.get_or_insert_with(|| wanted.clone());
                wanted.edits = correction.on(&before.edits, column);
                Ok(())
            }
            Command::Set(knob, value) => wanted.recipe.set(knob, &value),
            Command::SetAll(settings) => {
                passages::set_all(&mut wanted.recipe, passage, settings.iter().copied())
            }
            Command::Preset(preset) => {
                passages::set_all(&mut wanted.recipe, passage, preset.settings())
            }
            Command::Defaults => {
                wanted.recipe = Recipe::default();
                Ok(())
            }
            Command::Undo => {
                let before = take.history.undo(wanted);
                *wanted = before.unwrap_or_else(|| wanted.clone());
                Ok(())
            }
            _ => {
                let after = take.history.redo(wanted);
                *wanted = after.unwrap_or_else(|| wanted.clone());
                Ok(())
            }
        };
        match changed {
            Ok(()) => self.message = None,
            Err(error) => self.fail(error.to_string()),
        }
    }
}
