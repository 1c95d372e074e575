//! **Tune** (調整する): the window in which a person sees the motion, turns knobs and corrects keys.
//!
//! The crate uses egui and no window system: [`Studio::ui`] draws into the `Ui` it is given, and reaches files and
//! dialogs through a [`Host`]. A person's decisions are one [`Document`], the recipe file. Everything else is computed
//! from it and the clip, and never stored.
//!
//! Each part of the screen has a module: `viewport`, `transport`, `timesheet`, `curves`, `knobs`, `map`, `bar`. In each
//! frame they read one `Shown`. They change only their own display state, and report what the user wants as a
//! `Command`, as the keyboard does.

#![allow(
    clippy::disallowed_methods,
    reason = "the last digits of what is on screen are in no file"
)]

mod clipboard;
mod column;
mod command;
mod composite_poses;
mod correction_list;
mod corrections;
mod counts;
mod curves;
mod dispatch;
mod document;
mod export_panel;
mod export_settings;
mod export_task;
mod file_field;
mod files;
mod focus;
mod footage;
mod footage_cache;
mod footage_panel;
mod freeze;
mod held_key;
mod help;
mod history;
mod host;
mod icon;
mod key_menu;
mod keyboard;
mod knobs;
mod label_culling;
mod local_corrections;
mod notice;
mod open_take;
mod opening;
mod opening_steps;
mod panels;
mod player;
mod playhead_edits;
mod scene;
mod smoothing_map;
mod sound_track;
mod speaking;
mod speech_form;
mod spoken_lines;
mod take_list;
mod task;
mod theme;
mod timesheet;
mod toolbar;
mod transport;
mod unsaved;
mod view_state;
mod viewport;
mod waveform;
mod welcome;
mod why;
mod words;

#[cfg(test)]
#[path = "../../../tests/real/mod.rs"]
mod real;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{CentralPanel, Frame, Panel, Ui};

use column::Column;
use command::Command;
use composite_poses::OnScreen;
use counts::Counts;
use curves::Curves;
use export_panel::OrderPanel;
use export_task::Exporting;
use file_field::FileField;
use footage_cache::FrameCache;
use footage_panel::FootagePanel;
use key_menu::KeyPanel;
use knobs::Knobs;
use notice::Message;
use open_take::{Results, Take};
use opening::Opening;
use panels::{Arrival, Panels, Side};
use player::Player;
use smoothing_map::Map;
use sound_track::Track;
use speech_form::SpeechForm;
use take_list::Takes;
use task::Task;
use theme::Look;
use timesheet::Timesheet;
use toolbar::Bar;
use view_state::{Beside, Shown};
use viewport::Viewport;
use words::Words;

pub use document::Document;
pub use host::{ClipsAlone, Export, Exported, Host, Opened, Pending, Pictures, Playing};
pub use waveform::Waveform;
pub use words::Language;

/// The studio: a clip on the table, and all panels around it.
pub struct Studio {
    desk: Arc<dyn Host>,
    language: Language,
    take: Option<Take>,
    /// The takes of the opened folder.
    takes: Takes,
    opening: Option<Opening>,
    exporting: Option<Exporting>,
    /// The system's file dialog, while it is open.
    choosing: Option<Task<Option<PathBuf>>>,
    /// The system's folder dialog, while it is open.
    choosing_folder: Option<Task<Option<PathBuf>>>,
    /// The export panel.
    order: OrderPanel,
    /// The clips opened last.
    recent: Vec<PathBuf>,
    message: Option<Message>,
    file: FileField,
    is_help_open: bool,
    panels: Panels,
    arrival: Arrival,
    player: Player,
    /// Index of the selected column of the sheet.
    chosen: usize,
    /// Whether source frames are counted instead of koma.
    counts_frames: bool,
    viewport: Viewport,
    timesheet: Timesheet,
    curves: Curves,
    knobs: Knobs,
    map: Map,
    key_panel: KeyPanel,
    /// The form for a spoken line.
    speech: SpeechForm,
    /// The reference pictures recorded beside the motion.
    reel: FrameCache,
    track: Track,
    footage: FootagePanel,
    /// The document at the beginning of a drag that corrects it.
    held: Option<Document>,
    /// The counts at the beginning of any drag.
    before: Option<Counts>,
}

impl Studio {
    /// Creates a studio with no clip on the table.
    pub fn new(desk: Arc<dyn Host>, language: Language) -> Self {
        Self {
            recent: desk.recent(),
            desk,
            language,
            take: None,
            takes: Takes::default(),
            opening: None,
            exporting: None,
            choosing: None,
            choosing_folder: None,
            order: OrderPanel::default(),
            message: None,
            file: FileField::default(),
            is_help_open: false,
            panels: Panels::default(),
            arrival: Arrival::default(),
            player: Player::default(),
            chosen: 0,
            counts_frames: false,
            viewport: Viewport::default(),
            timesheet: Timesheet::default(),
            curves: Curves::default(),
            knobs: Knobs::default(),
            map: Map::default(),
            key_panel: KeyPanel::default(),
            speech: SpeechForm::default(),
            reel: FrameCache::default(),
            track: Track::default(),
            footage: FootagePanel::default(),
            held: None,
            before: None,
        }
    }

    /// The document of the clip on the table.
    pub fn document(&self) -> Option<&Document> {
        self.take.as_ref().map(Take::document)
    }

    /// Whether a clip is being read.
    pub fn is_opening(&self) -> bool {
        self.opening.is_some()
    }

    /// Whether results are being written.
    pub fn is_exporting(&self) -> bool {
        self.exporting.is_some()
    }

    /// Whether the map of the smoothing is being computed.
    pub fn is_mapping(&self) -> bool {
        self.map.is_waiting()
    }

    /// Whether pictures or a sound are being read.
    pub fn is_looking(&self) -> bool {
        self.reel.is_waiting() || self.track.is_waiting()
    }

    /// The title of the window: the clip's name, with a star if there are unsaved changes.
    pub fn title(&self) -> String {
        let name = |take: &Take| {
            format!("{}{} – genga", take.name(), if take.is_changed() { " *" } else { "" })
        };
        self.take.as_ref().map_or_else(|| "genga".into(), name)
    }

    /// Draws everything, and carries out what pointer and keyboard ask for.
    pub fn ui(&mut self, ui: &mut Ui) {
        let words = Words::from_language(self.language, ui.ctx());
        let look = Look::from_theme(ui.theme());
        self.receive(ui);
        let mut commands = keyboard::pressed(ui);
        let frame = Frame::side_top_panel(ui.style());
        Panel::top("bar").frame(frame).show(ui, |ui| {
            let (is_exporting, panels) = (self.exporting.is_some(), &self.panels);
            let mut bar = Bar { words, commands: &mut commands, panels, is_exporting };
            bar.show(ui, self.take.as_mut(), self.before);
        });
        self.renew_footage(ui);
        match self.take {
            Some(_) => self.table(ui, look, words, &mut commands),
            None => {
                let has_names = self.desk.has_names();
                welcome::show(ui, &look, &self.recent, has_names, words, &mut commands);
            }
        }
        self.notices(ui, &look, words, &mut commands);
        help::show(ui, &mut self.is_help_open, words);
        focus::show(ui, &look);
        for command in commands {
            self.act(ui, command);
        }
        self.settle(ui);
    }

    /// Shows the notices over the table: forms and panels, progress, messages, and the offer to recover unsaved work.
    fn notices(&mut self, ui: &Ui, look: &Look, words: Words, commands: &mut Vec<Command>) {
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
            if let Some(exporting) = &self.exporting {
                notice::one(ui, look.playhead, |ui| exporting.show(ui, words, commands));
            }
            if let Some(message) = &self.message {
                notice::message(ui, message, look, words, commands);
            }
            if is_left {
                notice::recovery(ui, look, words, commands);
            }
        });
    }

    /// Shows the clip with its panels.
    fn table(&mut self, ui: &mut Ui, look: Look, words: Words, commands: &mut Vec<Command>) {
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
        let mut turns = self.arrival.turns(ui.ctx());
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
        let frame = Frame::central_panel(ui.style()).inner_margin(0);
        CentralPanel::default().frame(frame).show(ui, |ui| {
            turns.fill(ui, |ui| self.viewport.show(ui, &shown, commands));
        });
    }

    /// Collects what comes from outside: a clip that was read, results that were written, files that were chosen or
    /// dropped.
    fn receive(&mut self, ui: &Ui) {
        if let Some(read) = self.opening.as_ref().and_then(Opening::look) {
            self.opening = None;
            match read {
                Ok(take) => self.put_on_table(take),
                Err(text) => self.fail(text),
            }
        }
        if let Some(written) = self.exporting.as_ref().and_then(Exporting::look) {
            self.exporting = None;
            match written {
                Ok(text) => self.say(text),
                Err(text) => self.fail(text),
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

    fn put_on_table(&mut self, mut take: Take) {
        if let Some(before) = self.take.as_ref().filter(|_| self.takes.share) {
            take.wanted.take_settings(&before.document().recipe);
        }
        let breakdown = take.results().breakdown;
        self.curves = Curves::new(breakdown.filtered.movers_first(breakdown.clip.skeleton()));
        (self.player, self.chosen) = (Player::default(), 0);
        self.viewport = Viewport::new(&take.scene);
        self.timesheet = Timesheet::default();
        self.key_panel = KeyPanel::default();
        self.speech.close();
        self.map.forget();
        self.desk.remember(&take.path);
        self.recent = self.desk.recent();
        (self.held, self.before, self.message) = (None, None, None);
        self.take = Some(take);
    }

    /// Ends a frame: updates the results and the history, and autosaves.
    fn settle(&mut self, ui: &Ui) {
        let is_held = ui.input(|input| input.pointer.any_down());
        let Some(take) = &mut self.take else { return };
        match take.renew(is_held) {
            Ok(false) => {}
            Ok(true) => ui.ctx().request_repaint(),
            Err(error) => {
                self.message = Some(Message::failure(error.to_string()));
                ui.ctx().request_repaint();
            }
        }
        take.history.settle(&take.wanted, is_held);
        if !is_held {
            self.map.renew(take);
        }
        if is_held {
            self.before = self.before.or_else(|| Some(take.counts()));
            return;
        }
        (self.held, self.before) = (None, None);
        if let Err(text) = take.autosave(&*self.desk) {
            self.fail(text);
        }
    }

    fn fail(&mut self, text: String) {
        self.message = Some(Message::failure(text));
    }

    /// Shows a sentence in the language of the labels.
    fn tell(&mut self, english: &str, japanese: &str) {
        self.say(english.to_owned());
        self.message.iter_mut().for_each(|said| said.japanese = Some(japanese.to_owned()));
    }

    fn say(&mut self, text: String) {
        self.message = Some(Message { text, japanese: None, is_failure: false });
    }
}
