//! A take (テイク) on the table: a clip, the document, and the last results that could be made of them.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use super::counts::Counts;
use super::desk::Desk;
use super::document::Document;
use super::exporting::Parcel;
use super::history::History;
use super::scene::Scene;
use super::step::Step;
use crate::error::Error;
use crate::motion::Clip;
use crate::pipeline::{Breakdown, Engine};

/// Seconds a run may take and still be made again while something is dragged.
const QUICK: f64 = 0.04;

/// A clip that is worked on.
pub(super) struct Take {
    /// The clip's file.
    pub(super) path: PathBuf,
    /// Where its recipe is saved.
    pub(super) recipe: PathBuf,
    /// What the reader said of it.
    pub(super) notes: Vec<String>,
    pub(super) scene: Scene,
    pub(super) history: History,
    /// What a hand asks for. Of a slow clip it is run when the hand lets go.
    pub(super) wanted: Document,
    /// What an earlier session left that was not saved.
    pub(super) left: Option<Document>,
    engine: Engine,
    /// The document of the results: one that the chain has taken.
    document: Document,
    saved: Document,
    autosaved: Document,
    is_slow: bool,
}

impl Take {
    /// Opens a clip with its recipe: the one that is named, or the one saved beside it. Each step is told when it
    /// begins.
    pub(super) fn open(
        desk: &dyn Desk,
        path: &Path,
        recipe: Option<&Path>,
        begin: impl Fn(Step),
    ) -> Result<Self, String> {
        begin(Step::Read);
        let opened = desk.open(path)?;
        let recipe = recipe.map_or_else(|| beside(path, ".genga.toml"), Path::to_owned);
        let saved = read(desk, &recipe)?.unwrap_or_default();
        let left = read(desk, &beside(path, AUTOSAVE)).ok().flatten();
        let mut engine = Engine::new(opened.clip).map_err(|error| error.to_string())?;
        let scene = Scene::of(engine.clip());
        run(&mut engine, &saved, begin)
            .map_err(|error| format!("{}: {error}", recipe.display()))?;
        Ok(Self {
            path: path.to_owned(),
            recipe,
            notes: opened.notes,
            scene,
            history: History::of(&saved),
            wanted: saved.clone(),
            left: left.filter(|left| *left != saved),
            engine,
            document: saved.clone(),
            autosaved: saved.clone(),
            saved,
            is_slow: false,
        })
    }

    /// What the clip is called.
    pub(super) fn name(&self) -> String {
        self.path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
    }

    /// The document that the results are made of.
    pub(super) fn document(&self) -> &Document {
        &self.document
    }

    /// The results, with the scene they stand in.
    pub(super) fn results(&mut self) -> (Breakdown<'_>, &Scene, &Document) {
        let Document { recipe, edits } = &self.document;
        let breakdown = self.engine.run(recipe, edits).expect("the chain has taken this document");
        (breakdown, &self.scene, &self.wanted)
    }

    /// Makes the results again if something else is wanted. A clip that takes long waits for the hand.
    ///
    /// What the chain refuses is not wanted any longer, and everything stays as it was. Says whether there are
    /// other results.
    pub(super) fn renew(&mut self, is_held: bool) -> Result<bool, Error> {
        if self.wanted == self.document || is_held && self.is_slow {
            return Ok(false);
        }
        let begin = Instant::now();
        match self.engine.run(&self.wanted.recipe, &self.wanted.edits) {
            Ok(_) => self.document = self.wanted.clone(),
            Err(error) => {
                self.wanted = self.document.clone();
                return Err(error);
            }
        }
        self.is_slow = begin.elapsed().as_secs_f64() > QUICK;
        Ok(true)
    }

    pub(super) fn counts(&mut self) -> Counts {
        Counts::of(&self.results().0)
    }

    /// Whether something would be lost without a save.
    pub(super) fn is_changed(&self) -> bool {
        self.document != self.saved
    }

    /// Saves the recipe, and takes away what was kept in case of a crash.
    pub(super) fn save(&mut self, desk: &dyn Desk) -> Result<(), String> {
        desk.write(&self.recipe, &self.document.text())?;
        self.saved = self.document.clone();
        self.left = None;
        self.forget(desk)
    }

    /// Opens another recipe for this clip.
    pub(super) fn open_recipe(&mut self, desk: &dyn Desk, path: &Path) -> Result<(), String> {
        let document = read(desk, path)?
            .ok_or_else(|| format!("{}: there is no such file", path.display()))?;
        self.wanted = document.clone();
        self.renew(false).map_err(|error| format!("{}: {error}", path.display()))?;
        self.recipe = path.to_owned();
        self.saved = document;
        Ok(())
    }

    /// Keeps what is not saved beside the clip, so that a crash takes nothing with it.
    pub(super) fn autosave(&mut self, desk: &dyn Desk) -> Result<(), String> {
        if self.document == self.autosaved || self.left.is_some() {
            return Ok(());
        }
        // Tried once for each document: a full disk is said once and not with every frame.
        self.autosaved = self.document.clone();
        if self.is_changed() {
            desk.write(&beside(&self.path, AUTOSAVE), &self.document.text())
        } else {
            desk.remove(&beside(&self.path, AUTOSAVE))
        }
    }

    /// Takes what an earlier session left.
    pub(super) fn recover(&mut self) {
        if let Some(left) = self.left.take() {
            self.wanted = left;
        }
    }

    /// Throws away what an earlier session left.
    pub(super) fn forget(&mut self, desk: &dyn Desk) -> Result<(), String> {
        self.left = None;
        self.autosaved = self.document.clone();
        desk.remove(&beside(&self.path, AUTOSAVE))
    }

    /// All results as they are now, to be written elsewhere than on the table.
    pub(super) fn parcel(&self) -> Parcel {
        Parcel {
            clip: self.path.clone(),
            folder: self.path.with_file_name(format!("{}-genga", self.name())),
            document: self.document.clone(),
            notes: self.notes.clone(),
            engine: self.engine.clone(),
        }
    }

    /// The clip, for whoever looks at it on a thread of their own.
    pub(super) fn clip(&self) -> Arc<Clip> {
        self.engine.shared_clip()
    }
}

/// Runs the chain for the first time, step by step.
fn run(engine: &mut Engine, document: &Document, begin: impl Fn(Step)) -> Result<(), Error> {
    let Document { recipe, edits } = document;
    begin(Step::Measure);
    engine.find_turns(recipe)?;
    begin(Step::Choose);
    engine.find_keys(recipe, edits)?;
    begin(Step::Time);
    engine.run(recipe, edits).map(drop)
}

/// What the file beside a clip is called that keeps what is not saved.
const AUTOSAVE: &str = ".genga-autosave.toml";

/// A file beside a clip, of its name.
fn beside(clip: &Path, ending: &str) -> PathBuf {
    let mut name = clip.file_stem().map_or_else(OsString::new, OsString::from);
    name.push(ending);
    clip.with_file_name(name)
}

fn read(desk: &dyn Desk, path: &Path) -> Result<Option<Document>, String> {
    let text = desk.read(path)?;
    let document = text.map(|text| Document::parse(&text)).transpose();
    document.map_err(|error| format!("{}: {error}", path.display()))
}
