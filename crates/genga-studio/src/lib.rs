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

mod between_frames;
mod clipboard;
mod column;
mod command;
mod composite_poses;
mod correction_list;
mod corrections;
mod counts;
mod curves;
mod destinations;
mod difference;
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
mod genga_search;
mod goals;
mod held_key;
mod help;
mod history;
mod host;
mod icon;
mod kept_numbers;
mod key_menu;
mod keyboard;
mod knobs;
mod label_culling;
mod leaving;
mod local_corrections;
mod notice;
mod open_take;
mod opening;
mod opening_steps;
mod panels;
mod passages;
mod player;
mod playhead_edits;
mod replaced;
mod scene;
mod smoothing_map;
mod sound_track;
mod speaking;
mod speech_form;
mod spoken_lines;
mod strip;
mod table;
mod take_list;
mod task;
mod theme;
mod time_axis;
mod timesheet;
mod toolbar;
mod tour;
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

use egui::{Frame, Panel, Ui};

use curves::Curves;
use difference::{Before, Difference};
use export_panel::OrderPanel;
use export_task::Exporting;
use file_field::FileField;
use footage_cache::FrameCache;
use footage_panel::FootagePanel;
use genga_search::GengaSearch;
use goals::Goals;
use key_menu::KeyPanel;
use knobs::Knobs;
use leaving::Leaving;
use notice::Message;
use open_take::Take;
use opening::Opening;
use panels::{Arrival, Panels};
use player::Player;
use smoothing_map::Map;
use sound_track::Track;
use speech_form::SpeechForm;
use strip::Strip;
use take_list::Takes;
use task::Task;
use theme::Look;
use timesheet::Timesheet;
use toolbar::Bar;
use tour::Tour;
use view_state::Taken;
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
    /// Whether the window has the studio's colours.
    is_dressed: bool,
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
    /// What waits until it is answered what happens to unsaved work.
    leaving: Option<Leaving>,
    /// Whether the window may close with unsaved work.
    may_close: bool,
    file: FileField,
    is_help_open: bool,
    tour: Tour,
    panels: Panels,
    arrival: Arrival,
    player: Player,
    /// Index of the selected column of the sheet.
    chosen: usize,
    /// Whether source frames are counted instead of koma.
    counts_frames: bool,
    viewport: Viewport,
    timesheet: Timesheet,
    strip: Strip,
    curves: Curves,
    goals: Goals,
    /// The number of genga that is asked for and not yet found.
    asked: Option<usize>,
    searching: Option<GengaSearch>,
    /// Seconds of a search in its first frame.
    patience: f64,
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
    /// The sheet at the beginning of the change that is being made.
    before: Option<Before>,
    /// What the last change made of the sheet.
    difference: Option<Difference>,
    /// Whether the change that is being made has made one.
    is_new: bool,
    /// Whether the sheet before the last change is shown.
    is_before: bool,
    /// The genga that a person took away since the clip was opened.
    taken: Vec<Taken>,
}

impl Studio {
    /// Creates a studio with no clip on the table.
    pub fn new(desk: Arc<dyn Host>, language: Language) -> Self {
        Self {
            recent: desk.recent(),
            desk,
            language,
            is_dressed: false,
            take: None,
            takes: Takes::default(),
            opening: None,
            exporting: None,
            choosing: None,
            choosing_folder: None,
            order: OrderPanel::default(),
            message: None,
            leaving: None,
            may_close: false,
            file: FileField::default(),
            is_help_open: false,
            tour: Tour::default(),
            panels: Panels::default(),
            arrival: Arrival::default(),
            player: Player::default(),
            chosen: 0,
            counts_frames: false,
            viewport: Viewport::default(),
            timesheet: Timesheet::default(),
            strip: Strip::default(),
            curves: Curves::default(),
            goals: Goals::default(),
            asked: None,
            searching: None,
            patience: genga_search::PATIENT,
            knobs: Knobs::default(),
            map: Map::default(),
            key_panel: KeyPanel::default(),
            speech: SpeechForm::default(),
            reel: FrameCache::default(),
            track: Track::default(),
            footage: FootagePanel::default(),
            held: None,
            before: None,
            difference: None,
            is_new: false,
            is_before: false,
            taken: Vec::new(),
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
        if !std::mem::replace(&mut self.is_dressed, true) {
            theme::dress(ui.ctx());
        }
        let words = Words::from_language(self.language, ui.ctx());
        let look = Look::from_theme(ui.theme());
        self.receive(ui);
        self.stay_open(ui);
        let mut commands = keyboard::pressed(ui);
        let frame = Frame::side_top_panel(ui.style());
        Panel::top("bar").frame(frame).show(ui, |ui| {
            let (is_exporting, panels) = (self.exporting.is_some(), &self.panels);
            let before = self.difference.as_ref().map(|difference| difference.before);
            let is_before = self.is_before;
            let mut bar = Bar { words, commands: &mut commands, panels, is_exporting, is_before };
            bar.show(ui, self.take.as_ref(), before);
        });
        self.goals(ui, &look, words, &mut commands);
        if self.tour.is_shown() && self.take.is_some() {
            let frame = Frame::side_top_panel(ui.style());
            Panel::top("tour").frame(frame).show(ui, |ui| {
                self.tour.show(ui, &look, words, &mut commands);
            });
        }
        self.renew_footage(ui);
        match self.take {
            Some(_) => self.table(ui, look, words, &mut commands),
            None => {
                let has_names = self.desk.has_names();
                welcome::show(ui, &look, &self.recent, has_names, words, &mut commands);
            }
        }
        self.notices(ui, &look, words, &mut commands);
        help::show(ui, &mut self.is_help_open, words, &mut commands);
        focus::show(ui, &look);
        for command in commands {
            self.act(ui, command);
        }
        self.settle(ui);
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
