//! A take (テイク) on the table: a clip, the document, and the last results that could be made of them.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use web_time::Instant;

use super::counts::Counts;
use super::desk::{Desk, Opened};
use super::document::Document;
use super::exporting::Parcel;
use super::freeze;
use super::history::History;
use super::order::Order;
use super::scene::Scene;
use super::step::Step;
use super::unsaved::{Unsaved, beside, read};
use crate::error::Error;
use crate::motion::Clip;
use crate::pipeline::{Breakdown, Engine};
use crate::plot::parts::Cels;
use crate::recipe::Recipe;

/// Seconds a run may take and still be made again while something is dragged.
const QUICK: f64 = 0.04;

/// Everything that was made of a clip and its document, and what is asked for next.
pub(super) struct Results<'a> {
    pub(super) breakdown: Breakdown<'a>,
    /// All columns on one another.
    pub(super) cels: &'a Cels,
    pub(super) scene: &'a Scene,
    /// What a hand asks for: of a slow clip not yet what the results are made of.
    pub(super) wanted: &'a Document,
}

impl Results<'_> {
    /// How many columns the sheet has.
    pub(super) fn columns(&self) -> usize {
        self.breakdown.sheet.layers.len()
    }

    /// The name of a column, by which it is corrected; none of a sheet that has no other.
    pub(super) fn named(&self, column: usize) -> Option<String> {
        let layers = &self.breakdown.sheet.layers;
        let column = layers.get(column).or(layers.last()).filter(|_| layers.len() > 1);
        column.map(|layer| layer.name.clone())
    }
}

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
    pub(super) left: Option<Unsaved>,
    /// The other sheet, and whether the one that is worked on is the second.
    other: Option<Document>,
    is_second: bool,
    engine: Engine,
    /// The document of the results: one that the chain has taken.
    document: Document,
    /// All columns of its sheet on one another, as the files have them; none before the chain has run.
    cels: Option<Cels>,
    saved: Document,
    /// What was kept last in case of a crash.
    kept: Unsaved,
    is_slow: bool,
    /// Whether the chain ran last for something else than the document.
    is_elsewhere: bool,
}

impl Take {
    /// A clip that was opened, with its recipe: the one that is named, or the one saved beside it. The chain has yet to
    /// run, [step](Self::run) by step.
    pub(super) fn of(
        opened: Opened,
        desk: &dyn Desk,
        path: &Path,
        recipe: Option<&Path>,
    ) -> Result<Self, String> {
        let recipe = recipe.map_or_else(|| beside(path, ".genga.toml"), Path::to_owned);
        let saved = read(desk, &recipe)?.unwrap_or_default();
        let left = Unsaved::read(desk, path, &saved);
        let engine = Engine::new(opened.clip).map_err(|error| error.to_string())?;
        let scene = Scene::of(engine.clip());
        Ok(Self {
            path: path.to_owned(),
            recipe,
            notes: opened.notes,
            scene,
            history: History::of(&saved),
            wanted: saved.clone(),
            left,
            other: None,
            is_second: false,
            engine,
            document: saved.clone(),
            cels: None,
            kept: Unsaved::nothing(&saved),
            saved,
            is_slow: false,
            is_elsewhere: false,
        })
    }

    /// Runs the chain for the first time, up to the end of a step.
    pub(super) fn run(&mut self, step: Step) -> Result<(), String> {
        let (engine, Document { recipe, edits, .. }) = (&mut self.engine, &self.document);
        let ran = match step {
            // They are over where there is a take.
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
                Cels::of(breakdown.clip, breakdown.sheet).map(|cels| self.cels = Some(cels))
            }
        };
        ran.map_err(|error| format!("{}: {error}", self.recipe.display()))
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
    pub(super) fn results(&mut self) -> Results<'_> {
        let Document { recipe, edits, .. } = &self.document;
        if self.is_elsewhere {
            self.engine.run(recipe, edits).expect("the chain has taken this document");
            self.is_elsewhere = false;
        }
        let breakdown = self.engine.last(recipe).expect("the chain has run");
        let cels = self.cels.as_ref().expect("cels are laid once the chain has run");
        Results { breakdown, cels, scene: &self.scene, wanted: &self.wanted }
    }

    /// Makes the results again if something else is wanted. A clip that takes long waits for the hand.
    ///
    /// What the chain refuses is not wanted any longer, and everything stays as it was. Says whether there are
    /// other results.
    pub(super) fn renew(&mut self, is_held: bool) -> Result<bool, Error> {
        if self.wanted == self.document || is_held && self.is_slow {
            return Ok(false);
        }
        let Document { recipe, edits, footage } = &self.wanted;
        if (recipe, edits) == (&self.document.recipe, &self.document.edits) {
            // What is shown beside changes no drawing.
            self.document.footage = footage.clone();
            return Ok(true);
        }
        let begin = Instant::now();
        let before = (&self.document.recipe, self.cels.as_ref());
        self.is_elsewhere = true;
        let laid = self.engine.run(recipe, edits);
        match laid.and_then(|breakdown| laid_again(&breakdown, recipe, before)) {
            Ok(cels) => {
                (self.cels, self.document) = (Some(cels), self.wanted.clone());
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

    /// Freezes every genga, or thaws them. Says whether they are frozen now.
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

    /// Has the genga of some koma found again. What is outside is frozen as it is.
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

    /// Takes the other sheet; at first both are the one there is.
    pub(super) fn take_other(&mut self) {
        let other = self.other.take().unwrap_or_else(|| self.wanted.clone());
        self.other = Some(std::mem::replace(&mut self.wanted, other));
        self.is_second = !self.is_second;
    }

    /// Which of two sheets is worked on; none where there is one.
    pub(super) fn letter(&self) -> Option<&'static str> {
        self.other.as_ref().map(|_| if self.is_second { "B" } else { "A" })
    }

    pub(super) fn counts(&mut self) -> Counts {
        Counts::of(&self.results().breakdown)
    }

    /// Whether something would be lost without a save.
    pub(super) fn is_changed(&self) -> bool {
        self.document != self.saved
    }

    /// Saves the recipe. What was kept of it in case of a crash goes; the other sheet is still kept.
    pub(super) fn save(&mut self, desk: &dyn Desk) -> Result<(), String> {
        desk.write(&self.recipe, &self.document.text())?;
        self.saved = self.document.clone();
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
        if self.left.is_some() || self.kept.is(&self.document, self.other.as_ref(), self.is_second)
        {
            return Ok(());
        }
        self.keep(desk)
    }

    /// Keeps what is not saved, or takes away what was kept of what is.
    fn keep(&mut self, desk: &dyn Desk) -> Result<(), String> {
        let (document, other) = (self.document.clone(), self.other.clone());
        // Tried once for each document: a full disk is said once and not with every frame.
        self.kept = Unsaved { document, other, is_second: self.is_second };
        self.kept.keep(desk, &self.path, &self.saved)
    }

    /// Takes what an earlier session left.
    pub(super) fn recover(&mut self) {
        if let Some(left) = self.left.take() {
            (self.wanted, self.other, self.is_second) = (left.document, left.other, left.is_second);
        }
    }

    /// Throws away what an earlier session left.
    pub(super) fn forget(&mut self, desk: &dyn Desk) -> Result<(), String> {
        self.left = None;
        self.keep(desk)
    }

    /// Where a file is that is named beside the clip, or by its whole path; none for no name.
    pub(super) fn place_of(&self, name: &str) -> Option<PathBuf> {
        (!name.is_empty()).then(|| self.path.with_file_name("").join(name))
    }

    /// How a file is named: from the clip's folder where it lies below it, so that both can go elsewhere together.
    pub(super) fn name_of(&self, path: &Path) -> String {
        let folder = self.path.parent().filter(|folder| *folder != Path::new(""));
        let below = folder.and_then(|folder| path.strip_prefix(folder).ok()).unwrap_or(path);
        below.to_string_lossy().into_owned()
    }

    /// The folder in which results are written where nothing else is asked for: in `into`, else beside the clip.
    pub(super) fn folder(&self, into: Option<&Path>) -> PathBuf {
        let name = format!("{}-genga", self.name());
        into.map_or_else(|| self.path.with_file_name(&name), |into| into.join(&name))
    }

    /// All results as they are now, to be written elsewhere than on the table.
    pub(super) fn parcel(&self, order: Order) -> Parcel {
        Parcel {
            clip: self.path.clone(),
            order,
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

/// The columns of other results on one another. Where feet stand is looked for again only in another motion.
fn laid_again(
    breakdown: &Breakdown<'_>,
    recipe: &Recipe,
    (of, cels): (&Recipe, Option<&Cels>),
) -> Result<Cels, Error> {
    let motion = |recipe: &Recipe| (recipe.exaggerate.clone(), recipe.rate, recipe.feet);
    match cels.filter(|_| motion(of) == motion(recipe)) {
        Some(cels) => cels.again(breakdown.clip, breakdown.sheet),
        None => Cels::of(breakdown.clip, breakdown.sheet),
    }
}
