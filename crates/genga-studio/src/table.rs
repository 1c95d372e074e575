//! The table (机の上): the clip with its panels, the goals above them, and the notices over them.

use egui::{CentralPanel, Frame, Margin, Panel, Ui};

use super::Studio;
use super::column::Column;
use super::command::Command;
use super::composite_poses::OnScreen;
use super::correction_list;
use super::goals;
use super::leaving;
use super::notice::{self, Message};
use super::open_take::Results;
use super::panels::{self, Side};
use super::passages;
use super::replaced;
use super::strip::{self, Strip};
use super::theme::Look;
use super::transport;
use super::view_state::{Beside, Shown};
use super::words::Words;

impl Studio {
    /// Shows the goals, once a clip is open.
    pub(super) fn goals(
        &mut self,
        ui: &mut Ui,
        look: &Look,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let passage = self.marked_passage();
        let Some(take) = &self.take else { return };
        let recipe = &take.wanted.recipe;
        let own = passage.map(|frames| passages::within(recipe, frames));
        let counts = take.counts();
        let window = ui.ctx().content_rect().size();
        let seen = goals::Seen {
            recipe: own.as_ref().unwrap_or(recipe),
            passage,
            counts: &counts,
            before: self.difference.as_ref().map_or(&counts, |difference| &difference.before),
            is_expert: self.panels.is_shown(Side::Knobs, window),
            look,
            words,
        };
        let frame = Frame::side_top_panel(ui.style());
        Panel::top("goals").frame(frame).show(ui, |ui| self.goals.show(ui, &seen, commands));
    }

    /// Shows the notices over the table: forms and panels, progress, messages, and the offer to recover unsaved work.
    pub(super) fn notices(
        &mut self,
        ui: &Ui,
        look: &Look,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let is_left = self.take.as_ref().is_some_and(|take| take.left.is_some());
        notice::over(ui, |ui| {
            if self.file.is_open {
                notice::one(ui, look.faint, |ui| {
                    self.file.show(ui, self.take.is_some(), &self.recent, words, commands);
                });
            }
            if let Some(take) = self.take.as_ref().filter(|_| self.order.order.is_some()) {
                let layers = take.wanted.recipe.get("layers").expect("a recipe has layers");
                notice::one(ui, look.faint, |ui| self.order.show(ui, &layers, words, commands));
            }
            if let Some(take) = self.take.as_mut().filter(|_| self.speech.is_open()) {
                let Results { breakdown, .. } = take.results();
                notice::one(ui, look.faint, |ui| {
                    let last = breakdown.clip.last();
                    self.speech.show(ui, breakdown.sheet, last, words, commands);
                });
            }
            if let Some(take) = self.take.as_ref().filter(|_| self.footage.is_open) {
                let (placement, is_silent) = (&self.viewport.placement, self.track.is_silent);
                let at = (&take.wanted.footage, placement, is_silent, self.reel.is_listing());
                notice::one(ui, look.faint, |ui| self.footage.show(ui, at, words, commands));
            }
            if let Some(opening) = &self.opening {
                notice::one(ui, look.playhead, |ui| opening.show(ui, words));
            }
            if let Some(searching) = &self.searching {
                notice::one(ui, look.playhead, |ui| searching.show(ui, words, commands));
            }
            if let Some(exporting) = &self.exporting {
                notice::one(ui, look.playhead, |ui| exporting.show(ui, words, commands));
            }
            if let Some(message) = &self.message {
                notice::message(ui, message, look, words, commands);
            }
            let changed = self.difference.as_ref().and_then(|all| all.columns.get(self.chosen));
            if let Some(changed) = changed {
                replaced::show(ui, &changed.replaced, (look, words), commands);
            }
            if let (Some(leaving), Some(take)) = (&self.leaving, &self.take) {
                leaving::ask(ui, (leaving, &take.name()), look, words, commands);
            }
            if is_left {
                notice::recovery(ui, look, words, commands);
            }
        });
    }

    /// Shows the clip with its panels.
    pub(super) fn table(
        &mut self,
        ui: &mut Ui,
        look: Look,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let Some(take) = &mut self.take else { return };
        let on_table = &take.path.clone();
        let Results { breakdown, cels, scene, wanted } = take.results();
        let columns = Column::all(&breakdown);
        self.chosen = self.chosen.min(columns.len() - 1);
        let column = &columns[self.chosen];
        let now = ui.input(|input| input.time);
        if let Some(wait) = self.player.advance(now, column.clock.koma_rate, column.length) {
            ui.ctx().request_repaint_after_secs(wait as f32);
        }
        let is_held = ui.input(|input| input.pointer.any_down());
        let (at, rate) = (self.player.at, column.clock.koma_rate);
        self.reel.want(&self.desk, wanted.footage.picture(at, rate));
        let second = wanted.footage.second(at as f64, rate);
        let fault = self.track.follow(&self.desk, self.player.run(), second, is_held);
        self.message = fault.map(Message::failure).or(self.message.take());
        let beside = Beside::at(&self.reel, &self.track, &wanted.footage, at, rate);
        let joints = &self.curves.chosen.clone();
        let on_screen = OnScreen::new(breakdown.clip, cels);
        let shown = Shown {
            breakdown,
            on_screen,
            columns,
            chosen: self.chosen,
            scene,
            wanted,
            taken: &self.taken,
            joints,
            at,
            counts_frames: self.counts_frames,
            beside,
            look,
            words,
        };
        if self.takes.is_open() {
            let takes = &mut self.takes;
            Panel::left("takes").default_size(168.0).size_range(120.0..=320.0).show(ui, |ui| {
                takes.show(ui, on_table, &look, words, commands);
            });
        }
        let window = ui.ctx().content_rect().size();
        let is_there = |side| self.panels.is_shown(side, window);
        let mut turns = self.arrival.turns();
        if is_there(Side::Knobs) {
            let panel = Panel::left("knobs").default_size(306.0);
            panel.size_range(Side::Knobs.range(window)).show(ui, |ui| {
                turns.fill(ui, |ui| self.knobs.show(ui, &mut self.map, &shown, commands));
            });
        }
        if is_there(Side::Sheet) {
            let panel = Panel::right("sheet").default_size(266.0);
            panel.size_range(Side::Sheet.range(window)).show(ui, |ui| {
                turns.fill(ui, |ui| {
                    self.key_panel.show(ui, &shown, commands);
                    ui.separator();
                    correction_list::below(ui, &shown, commands);
                    self.timesheet.show(ui, &shown, commands);
                });
            });
        }
        if is_there(Side::Curves) {
            let panel = Panel::bottom("curves").default_size(236.0).resizable(true);
            panel.size_range(Side::Curves.range(window)).show(ui, |ui| {
                turns.fill(ui, |ui| self.curves.show(ui, &shown, &self.player, commands));
            });
        }
        if turns.take() {
            let panel = Panel::bottom("transport").resizable(false).show_separator_line(false);
            panel.show(ui, |ui| transport::show(ui, &shown, &self.player, commands));
        }
        // Curves need the room of the strip in a low window.
        if !(panels::is_low(window) && is_there(Side::Curves)) {
            let panel = Panel::bottom("strip").default_size(Strip::usual_height(window.y));
            let high = strip::HEIGHTS;
            let high = *high.start()..=(0.5 * window.y).clamp(*high.start(), *high.end());
            let frame = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(6, 2));
            panel.size_range(high).resizable(true).frame(frame).show(ui, |ui| {
                let seen = (&shown, self.difference.as_ref());
                let by = (&self.viewport.orbit, &self.player);
                turns.fill(ui, |ui| self.strip.show(ui, seen, by, commands));
            });
        }
        let frame = Frame::central_panel(ui.style()).inner_margin(0);
        CentralPanel::default().frame(frame).show(ui, |ui| {
            turns.fill(ui, |ui| self.viewport.show(ui, &shown, commands));
        });
        self.arrival.note(turns, ui.ctx());
    }
}
