//! **Tune** (調整する): the window in which a person sees the motion, turns knobs and corrects keys.
//!
//! It knows egui and no shell: [`Studio::ui`] draws into whatever it is given, and what it wants of the world
//! outside it asks of a [`Desk`]. A person's decisions are one [`Document`], the recipe file; all the rest is
//! made of it and the clip, and never stored.
//!
//! A file here is what is on screen: `viewport`, `transport`, `timesheet`, `curves`, `knobs`, `map`, `bar`. They read
//! one `Shown` a frame, change nothing but how they look, and say what a hand wants as a `Command`, the same
//! that keys give.

#![allow(
    clippy::disallowed_methods,
    reason = "the last digits of what is on screen are in no file"
)]

mod act;
mod bar;
mod column;
mod command;
mod copied;
mod corrected;
mod corrections;
mod counts;
mod curves;
mod desk;
mod document;
mod errand;
mod exporting;
mod file_field;
mod files;
mod focus;
mod footage;
mod footage_panel;
mod freeze;
mod held_key;
mod help;
mod here;
mod history;
mod icon;
mod key_menu;
mod keyboard;
mod knobs;
mod local;
mod look;
mod map;
mod notice;
mod on_screen;
mod opening;
mod order;
mod order_panel;
mod panels;
mod player;
mod reel;
mod room;
mod scene;
mod shown;
mod speaking;
mod speech_form;
mod spoken;
mod step;
mod take;
mod takes;
mod timesheet;
mod track;
mod transport;
mod unsaved;
mod viewport;
mod waveform;
mod welcome;
mod why;
mod words;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{CentralPanel, Frame, Panel, Ui};

use bar::Bar;
use column::Column;
use command::Command;
use counts::Counts;
use curves::Curves;
use errand::Errand;
use exporting::Exporting;
use file_field::FileField;
use footage_panel::FootagePanel;
use key_menu::KeyPanel;
use knobs::Knobs;
use look::Look;
use map::Map;
use notice::Message;
use on_screen::OnScreen;
use opening::Opening;
use order_panel::OrderPanel;
use panels::{Arrival, Panels, Side};
use player::Player;
use reel::Reel;
use shown::{Beside, Shown};
use speech_form::SpeechForm;
use take::{Results, Take};
use takes::Takes;
use timesheet::Timesheet;
use track::Track;
use viewport::Viewport;
use words::Words;

pub use desk::{ClipsAlone, Desk, Export, Exported, Opened, Pending, Pictures, Playing};
pub use document::Document;
pub use waveform::Waveform;
pub use words::Language;

/// The studio: a clip on the table, and everything a person looks at it with.
pub struct Studio {
    desk: Arc<dyn Desk>,
    language: Language,
    take: Option<Take>,
    /// The takes of the folder that was opened.
    takes: Takes,
    opening: Option<Opening>,
    exporting: Option<Exporting>,
    /// The dialog of the system for a file.
    choosing: Option<Errand<Option<PathBuf>>>,
    /// And the one for a folder.
    choosing_folder: Option<Errand<Option<PathBuf>>>,
    /// What is to be exported, while that is asked.
    order: OrderPanel,
    /// The clips that were opened last.
    recent: Vec<PathBuf>,
    message: Option<Message>,
    file: FileField,
    is_help_open: bool,
    panels: Panels,
    arrival: Arrival,
    player: Player,
    /// The column of the sheet that is worked on.
    chosen: usize,
    /// Whether frames of the source are counted, and not koma.
    counts_frames: bool,
    viewport: Viewport,
    timesheet: Timesheet,
    curves: Curves,
    knobs: Knobs,
    map: Map,
    key_panel: KeyPanel,
    /// What is spoken, while it is written.
    speech: SpeechForm,
    /// The pictures that were taken beside the motion, and the sound.
    reel: Reel,
    track: Track,
    footage: FootagePanel,
    /// The document when a hand took hold of what it corrects.
    held: Option<Document>,
    /// The counts when a hand took hold of anything.
    before: Option<Counts>,
}

impl Studio {
    /// A studio with nothing on the table.
    pub fn new(desk: Arc<dyn Desk>, language: Language) -> Self {
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
            reel: Reel::default(),
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

    /// Whether the map of the smoothing is being made.
    pub fn is_mapping(&self) -> bool {
        self.map.is_waiting()
    }

    /// Whether pictures or a sound are being read.
    pub fn is_looking(&self) -> bool {
        self.reel.is_waiting() || self.track.is_waiting()
    }

    /// What the window is called: the clip, with a star while something is not saved.
    pub fn title(&self) -> String {
        let name = |take: &Take| {
            format!("{}{} – genga", take.name(), if take.is_changed() { " *" } else { "" })
        };
        self.take.as_ref().map_or_else(|| "genga".into(), name)
    }

    /// Draws everything, and does what hand and keyboard ask for.
    pub fn ui(&mut self, ui: &mut Ui) {
        let words = Words::of(self.language, ui.ctx());
        let look = Look::of(ui.theme());
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

    /// What lies over the table: a field for files, what is read, what went wrong, what was left.
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

    /// The clip with its panels.
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
        let on_screen = OnScreen::of(breakdown.clip, cels);
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

    /// What comes from outside: a clip that was read, results that were written, files that were chosen or dropped.
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
        match self.choosing.as_ref().map(Errand::look) {
            Some(errand::Look::Done(chosen)) => {
                self.choosing = None;
                chosen.into_iter().for_each(|path| self.open_any(&path));
            }
            Some(errand::Look::BrokeOff) => self.choosing = None,
            Some(errand::Look::Waiting) | None => {}
        }
        match self.choosing_folder.as_ref().map(Errand::look) {
            Some(errand::Look::Done(chosen)) => {
                self.choosing_folder = None;
                chosen.into_iter().for_each(|path| self.order.take(&path));
            }
            Some(errand::Look::BrokeOff) => self.choosing_folder = None,
            Some(errand::Look::Waiting) | None => {}
        }
        self.map.receive();
        let is_waiting = self.opening.is_some()
            || self.exporting.is_some()
            || self.choosing.is_some()
            || self.choosing_folder.is_some()
            || self.is_looking()
            || self.map.is_waiting();
        if is_waiting {
            ui.ctx().request_repaint_after_secs(errand::LOOK_AGAIN);
        }
        let dropped =
            ui.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.open_any(&path);
        }
    }

    fn put_on_table(&mut self, mut take: Take) {
        if let Some(before) = self.take.as_ref().filter(|_| self.takes.share) {
            take.wanted.recipe = before.document().recipe.clone();
        }
        let breakdown = take.results().breakdown;
        self.curves = Curves::of(breakdown.filtered.movers_first(breakdown.clip.skeleton()));
        (self.player, self.chosen) = (Player::default(), 0);
        self.viewport = Viewport::of(&take.scene);
        self.timesheet = Timesheet::default();
        self.key_panel = KeyPanel::default();
        self.speech.close();
        self.map.forget();
        self.desk.remember(&take.path);
        self.recent = self.desk.recent();
        (self.held, self.before, self.message) = (None, None, None);
        self.take = Some(take);
    }

    /// At the end of a frame: results, history, what is kept in case of a crash.
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

    /// Says a sentence in the language of the labels.
    fn tell(&mut self, english: &str, japanese: &str) {
        self.say(english.to_owned());
        self.message.iter_mut().for_each(|said| said.japanese = Some(japanese.to_owned()));
    }

    fn say(&mut self, text: String) {
        self.message = Some(Message { text, japanese: None, is_failure: false });
    }
}
