//! Files (ファイル): saving, exporting and choosing, and the takes of a folder.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Studio;
use super::export_settings::Order;
use super::export_task::Exporting;
use super::open_take::Take;
use super::take_list::{Mark, Takes};
use super::task::Task;
use genga::motion::bvh;

/// Names under which the desk notes the last order and its folder.
const EXPORT: &str = "export";
const INTO: &str = "export-into";

/// Name of the built-in clip.
const SAMPLE: &str = "kick.bvh";

impl Studio {
    /// Opens a clip. For a folder, lists its takes and opens the first; without takes, shows its pictures.
    pub(super) fn open_folder_or_clip(&mut self, path: &Path) {
        let clips = self.desk.clips_in(path);
        let Some(first) = clips.first().cloned() else {
            let has_pictures = !self.desk.pictures_in(path).is_empty();
            return if has_pictures { self.put_beside(path) } else { self.open(path, None) };
        };
        let marks = self.desk.read(&Takes::file(path)).ok().flatten().unwrap_or_default();
        self.takes = Takes::new(path, clips, &marks);
        self.open(&first, None);
    }

    /// Opens the take `by` places further in the folder. The current one is saved first.
    pub(super) fn step_take(&mut self, by: isize) {
        let Some(take) = &mut self.take else { return };
        let Some(clip) = self.takes.step(&take.path, by) else { return };
        let saved = if take.is_changed() { take.save(&*self.desk) } else { Ok(()) };
        match saved {
            Ok(()) => self.open(&clip, None),
            Err(text) => self.fail(text),
        }
    }

    pub(super) fn mark_take(&mut self, is_done: bool) {
        let Some(take) = self.take.as_ref().filter(|_| self.takes.is_open()) else { return };
        self.takes.mark(&take.path, if is_done { Mark::Done } else { Mark::Flagged });
        let (file, text) = self.takes.kept();
        if let Err(text) = self.desk.write(&file, &text) {
            self.fail(text);
        }
    }

    pub(super) fn save_as(&mut self, path: &Path) {
        if let Some(take) = &mut self.take {
            take.recipe = path.to_owned();
        }
        self.save();
    }

    pub(super) fn save(&mut self) {
        let Some(take) = &mut self.take else { return };
        match take.save(&*self.desk) {
            Ok(()) => {
                let recipe = take.recipe.display().to_string();
                self.say(format!("saved {recipe}"));
            }
            Err(text) => self.fail(text),
        }
    }

    /// Opens the export panel with the last order, unless an export is running.
    pub(super) fn ask_export(&mut self, is_by_pointer: bool) {
        let (Some(take), None) = (&self.take, &self.exporting) else { return };
        let folder = self.export_folder(take);
        let order = Order::remembered(&self.desk.noted(EXPORT).unwrap_or_default(), folder);
        self.player.stop();
        self.order.ask(order, &*self.desk, is_by_pointer);
    }

    /// The folder into which a take is exported unless another is chosen.
    pub(super) fn export_folder(&self, take: &Take) -> PathBuf {
        let into = self.desk.noted(INTO).filter(|into| !into.trim().is_empty());
        take.folder(into.as_deref().map(|into| Path::new(into.trim())))
    }

    /// Opens the built-in clip, and begins the tour.
    pub(super) fn open_sample(&mut self) {
        match self.desk.put_sample(SAMPLE, bvh::KICK) {
            Ok(path) => {
                self.tour.begin();
                self.open_or_ask(path);
            }
            Err(text) => self.fail(text),
        }
    }

    pub(super) fn choose_folder(&mut self) {
        let desk = Arc::clone(&self.desk);
        self.choosing_folder.get_or_insert_with(|| Task::begin(move || desk.choose_folder()));
    }

    pub(super) fn choose(&mut self) {
        let desk = Arc::clone(&self.desk);
        self.choosing.get_or_insert_with(|| Task::begin(move || desk.choose()));
    }

    /// Starts an export. Only one runs at a time, because a second would write the same files.
    pub(super) fn export(&mut self, order: Order) {
        self.order.order = None;
        self.desk.note(EXPORT, &order.text());
        // If this export does not go beside its clip, the next one goes to the same place.
        let beside = self.take.as_ref().map(|take| take.folder(None));
        let into = order.folder.parent().filter(|_| beside.as_ref() != Some(&order.folder));
        self.desk.note(INTO, &into.map(|into| into.display().to_string()).unwrap_or_default());
        if let (Some(take), None) = (&self.take, &self.exporting) {
            self.message = None;
            self.exporting = Some(Exporting::begin(&self.desk, take.parcel(order)));
        }
    }
}
