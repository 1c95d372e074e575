//! A take (テイク) on the table: a clip, its document, and the last results computed from them.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use web_time::Instant;

use super::counts::Counts;
use super::document::Document;
use super::export_settings::Order;
use super::export_task::Parcel;
use super::freeze;
use super::genga_search::GengaSearch;
use super::history::History;
use super::host::{Host, Opened};
use super::kept_numbers::KeptNumbers;
use super::opening_steps::Step;
use super::scene::Scene;
use super::unsaved::{Unsaved, beside, read};
use genga::error::Error;
use genga::motion::Clip;
use genga::pipeline::{Breakdown, Engine};
use genga::recipe::Recipe;
use genga_plot::parts::Cels;

/// Longest run, in seconds, that is still repeated during a drag.
const QUICK: f64 = 0.04;

/// The results of a clip and its document, and the document asked for next.
pub(super) struct Results<'a> {
    pub(super) breakdown: Breakdown<'a>,
    /// All columns laid on one another.
    pub(super) cels: &'a Cels,
    pub(super) scene: &'a Scene,
    /// The document asked for. The results of a slow clip may lag behind it.
    pub(super) wanted: &'a Document,
}

impl Results<'_> {
    /// Number of columns of the sheet.
    pub(super) fn columns(&self) -> usize {
        self.breakdown.sheet.layers.len()
    }

    /// Name of a column, by which it is corrected. `None` if the sheet has only one column.
    pub(super) fn named(&self, column: usize) -> Option<String> {
        let layers = &self.breakdown.sheet.layers;
        let column = layers.get(column).or(layers.last()).filter(|_| layers.len() > 1);
        column.map(|layer| layer.name.clone())
    }
}

/// A clip being worked on.
pub(super) struct Take {
    /// Path of the clip.
    pub(super) path: PathBuf,
    /// Path to which its recipe is saved.
    pub(super) recipe: PathBuf,
    /// The reader's notes on the clip.
    pub(super) notes: Vec<String>,
    pub(super) scene: Scene,
    pub(super) history: History,
    /// The document asked for. For a slow clip it is run when the pointer is released.
    pub(super) wanted: Document,
    /// Unsaved work of an earlier session.
    pub(super) left: Option<Unsaved>,
    /// The other sheet; `is_second` says whether the current sheet is the second of the two.
    other: Option<Document>,
    is_second: bool,
    engine: Engine,
    /// Document of the results, which the chain has accepted.
    document: Document,
    /// All columns of its sheet laid on one another, as in the exported files. `None` before the chain has run.
    cels: Option<Cels>,
    /// The counts of its sheet. `None` before the chain has run.
    counts: Option<Counts>,
    numbers: KeptNumbers,
    saved: Document,
    /// State last kept in case of a crash.
    kept: Unsaved,
    is_slow: bool,
    /// Whether the last search for a number of genga was slow.
    pub(super) is_slow_to_ask: bool,
    /// Whether the engine last ran for something other than `document`.
    is_elsewhere: bool,
}

impl Take {
    /// Creates a take from an opened clip and its recipe, by default the recipe saved beside the clip. The chain has
    /// yet to run, [step](Self::run) by step.
    pub(super) fn new(
        opened: Opened,
        desk: &dyn Host,
        path: &Path,
        recipe: Option<&Path>,
    ) -> Result<Self, String> {
        let recipe = recipe.map_or_else(|| beside(path, ".genga.toml"), Path::to_owned);
        let saved = read(desk, &recipe)?.unwrap_or_default();
        let left = Unsaved::read(desk, path, &saved);
        let engine = Engine::new(opened.clip).map_err(|error| error.to_string())?;
        let scene = Scene::from_clip(engine.clip());
        Ok(Self {
            path: path.to_owned(),
            recipe,
            notes: opened.notes,
            scene,
            history: History::new(&saved),
            wanted: saved.clone(),
            left,
            other: None,
            is_second: false,
            engine,
            document: saved.clone(),
            cels: None,
            counts: None,
            numbers: KeptNumbers::default(),
            kept: Unsaved::nothing(&saved),
            saved,
            is_slow: false,
            is_slow_to_ask: false,
            is_elsewhere: false,
        })
    }

    /// Runs the chain for the first time, up to and including a step.
    pub(super) fn run(&mut self, step: Step) -> Result<(), String> {
        let (engine, Document { recipe, edits, .. }) = (&mut self.engine, &self.document);
        let ran = match step {
            // These steps come before there is a take.
            Step::Read | Step::Clean | Step::Look => Ok(()),
            Step::Measure => engine.measure(recipe),
            Step::Turn => engine.find_turns(recipe).map(drop),
            Step::Follow => engine.follow(recipe),
            Step::TurnBody => engine.find_body_turns(recipe).map(drop),
            Step::Compare => engine.compare(recipe),
            Step::Choose => engine.find_keys(recipe, edits).map(drop),
            Step::Split => engine.find_actions(recipe, edits).map(drop),
            Step::Time => engine.run(recipe, edits).map(drop),
            Step::Lay => {
                let breakdown = engine.last(recipe).expect("it was timed in the step before");
                self.counts = Some(Counts::new(&breakdown));
                self.numbers.renew(breakdown.sheet);
                Cels::new(breakdown.clip, breakdown.sheet).map(|cels| self.cels = Some(cels))
            }
        };
        ran.map_err(|error| format!("{}: {error}", self.recipe.display()))
    }

    /// The clip's name, without folder and extension.
    pub(super) fn name(&self) -> String {
        self.path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
    }

    /// The document that the results were computed from.
    pub(super) fn document(&self) -> &Document {
        &self.document
    }

    /// Returns the results and their scene.
    pub(super) fn results(&mut self) -> Results<'_> {
        let Document { recipe, edits, .. } = &self.document;
        if self.is_elsewhere {
            self.engine.run(recipe, edits).expect("the chain has taken this document");
            self.is_elsewhere = false;
        }
        let breakdown = self.engine.last(recipe).expect("the chain has run");
        let cels = self.cels.as_ref().expect("cels are laid once the chain has run");
        let breakdown = self.numbers.on(breakdown);
        Results { breakdown, cels, scene: &self.scene, wanted: &self.wanted }
    }

    /// Numbers the drawings as on the sheet in an export folder.
    pub(super) fn number_as_in(&mut self, desk: &dyn Host, folder: &Path) {
        self.numbers = KeptNumbers::find(desk, folder, &self.path);
        let sheet = self.results().breakdown.sheet.clone();
        self.numbers.renew(&sheet);
    }

    /// Whether another document is asked for than that of the results.
    pub(super) fn is_behind(&self) -> bool {
        self.wanted != self.document
    }

    /// Computes the results again if another document is asked for. A slow clip waits until the pointer is released.
    ///
    /// If the chain refuses the document, `wanted` is reset and everything stays as it was. Returns whether anything
    /// changed.
    pub(super) fn renew(&mut self, is_held: bool) -> Result<bool, Error> {
        if !self.is_behind() || is_held && self.is_slow {
            return Ok(false);
        }
        let Document { recipe, edits, footage } = &self.wanted;
        if (recipe, edits) == (&self.document.recipe, &self.document.edits) {
            // Footage affects no drawing, so the chain need not run.
            self.document.footage = footage.clone();
            return Ok(true);
        }
        let begin = Instant::now();
        let before = (&self.document.recipe, self.cels.as_ref());
        self.is_elsewhere = true;
        let laid = self.engine.run(recipe, edits);
        let laid = laid.and_then(|breakdown| {
            let cels = laid_again(&breakdown, recipe, before)?;
            self.numbers.renew(breakdown.sheet);
            Ok((cels, Counts::new(&breakdown)))
        });
        match laid {
            Ok((cels, counts)) => {
                (self.cels, self.counts) = (Some(cels), Some(counts));
                self.document = self.wanted.clone();
                self.is_elsewhere = false;
            }
            Err(error) => {
                self.wanted = self.document.clone();
                return Err(error);
            }
        }
        self.is_slow = begin.elapsed().as_secs_f64() > QUICK;
        Ok(true)
    }

    /// Freezes every genga, or thaws them. Returns whether they are frozen now.
    pub(super) fn freeze(&mut self) -> Result<bool, Error> {
        self.renew(false)?;
        let edits = &self.wanted.edits;
        let is_frozen = edits.freeze();
        self.wanted.edits = match is_frozen {
            true => freeze::thawed(edits),
            false => freeze::frozen(&edits.clone(), &self.results().breakdown),
        };
        Ok(!is_frozen)
    }

    /// Finds the genga of some koma again, and freezes all others.
    pub(super) fn find_again(&mut self, koma: &Range<usize>) -> Result<(), Error> {
        if !self.wanted.edits.freeze() {
            self.freeze()?;
        }
        let Document { recipe, edits, .. } = &self.wanted;
        self.is_elsewhere = true;
        let fresh = self.engine.run(recipe, &freeze::thawed(edits))?;
        self.wanted.edits = freeze::found_again(edits, &fresh, koma);
        Ok(())
    }

    /// Switches to the other sheet, initially a copy of this one.
    pub(super) fn take_other(&mut self) {
        let other = self.other.take().unwrap_or_else(|| self.wanted.clone());
        self.other = Some(std::mem::replace(&mut self.wanted, other));
        self.is_second = !self.is_second;
    }

    /// Letter of the current sheet, A or B. `None` if there is only one.
    pub(super) fn letter(&self) -> Option<&'static str> {
        self.other.as_ref().map(|_| if self.is_second { "B" } else { "A" })
    }

    pub(super) fn counts(&self) -> Counts {
        self.counts.expect("sheets are counted once the chain has run")
    }

    /// Begins a search for settings with which a recipe's sheet has this many genga, or as near as possible, as `--keys`
    /// does.
    pub(super) fn search(&self, of: &Recipe, count: usize) -> GengaSearch {
        GengaSearch::new(self.engine.clone(), of, &self.wanted, count)
    }

    /// Whether there are unsaved changes.
    pub(super) fn is_changed(&self) -> bool {
        self.document != self.saved
    }

    /// Saves the recipe and removes its autosave. The other sheet is still kept.
    pub(super) fn save(&mut self, desk: &dyn Host) -> Result<(), String> {
        desk.write(&self.recipe, &self.document.text())?;
        self.saved = self.document.clone();
        self.forget(desk)
    }

    /// Opens another recipe for this clip.
    pub(super) fn open_recipe(&mut self, desk: &dyn Host, path: &Path) -> Result<(), String> {
        let document = read(desk, path)?
            .ok_or_else(|| format!("{}: there is no such file", path.display()))?;
        self.wanted = document.clone();
        self.renew(false).map_err(|error| format!("{}: {error}", path.display()))?;
        self.recipe = path.to_owned();
        self.saved = document;
        Ok(())
    }

    /// Keeps unsaved work beside the clip, so that a crash loses nothing.
    pub(super) fn autosave(&mut self, desk: &dyn Host) -> Result<(), String> {
        if self.left.is_some() || self.kept.is(&self.document, self.other.as_ref(), self.is_second)
        {
            return Ok(());
        }
        self.keep(desk)
    }

    /// Writes unsaved work, or removes the autosave if there is none.
    fn keep(&mut self, desk: &dyn Host) -> Result<(), String> {
        let (document, other) = (self.document.clone(), self.other.clone());
        // Tried once per document, so that a full disk is reported once and not in every frame.
        self.kept = Unsaved { document, other, is_second: self.is_second };
        self.kept.keep(desk, &self.path, &self.saved)
    }

    /// Recovers the unsaved work of an earlier session.
    pub(super) fn recover(&mut self) {
        if let Some(left) = self.left.take() {
            (self.wanted, self.other, self.is_second) = (left.document, left.other, left.is_second);
        }
    }

    /// Discards the unsaved work of an earlier session.
    pub(super) fn forget(&mut self, desk: &dyn Host) -> Result<(), String> {
        self.left = None;
        self.keep(desk)
    }

    /// Path of a file given relative to the clip's folder or by its whole path. `None` if the name is empty.
    pub(super) fn place_of(&self, name: &str) -> Option<PathBuf> {
        (!name.is_empty()).then(|| self.path.with_file_name("").join(name))
    }

    /// Name of a file: relative to the clip's folder if it lies below it, so that both can be moved together.
    pub(super) fn name_of(&self, path: &Path) -> String {
        let folder = self.path.parent().filter(|folder| *folder != Path::new(""));
        let below = folder.and_then(|folder| path.strip_prefix(folder).ok()).unwrap_or(path);
        below.to_string_lossy().into_owned()
    }

    /// Default folder of an export, `<clip>-genga`: inside `into`, else beside the clip.
    pub(super) fn folder(&self, into: Option<&Path>) -> PathBuf {
        let name = format!("{}-genga", self.name());
        into.map_or_else(|| self.path.with_file_name(&name), |into| into.join(&name))
    }

    /// Packs the current results for an export that runs in the background.
    pub(super) fn parcel(&self, order: Order) -> Parcel {
        Parcel {
            clip: self.path.clone(),
            order,
            document: self.document.clone(),
            notes: self.notes.clone(),
            engine: self.engine.clone(),
        }
    }

    /// The clip, shared with background threads.
    pub(super) fn clip(&self) -> Arc<Clip> {
        self.engine.shared_clip()
    }
}

/// Lays the columns of new results on one another. Planted feet are searched for again only if the motion has changed.
fn laid_again(
    breakdown: &Breakdown<'_>,
    recipe: &Recipe,
    (of, cels): (&Recipe, Option<&Cels>),
) -> Result<Cels, Error> {
    let motion = |recipe: &Recipe| (recipe.exaggerate.clone(), recipe.rate, recipe.feet);
    match cels.filter(|_| motion(of) == motion(recipe)) {
        Some(cels) => cels.again(breakdown.clip, breakdown.sheet),
        None => Cels::new(breakdown.clip, breakdown.sheet),
    }
}
