//! Measures every cell of a study once, on all cores.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::study::axis::{Axis, Setting};
use crate::study::grid::{Cell, Grid};
use crate::study::measure::{Found, Measure, Reach};
use crate::study::noise::Noise;
use crate::study::of_each;
use genga::edits::Edits;
use genga::error::Error;
use genga::motion::Clip;
use genga::pipeline::{Budget, Engine, FoundKeys};
use genga::recipe::{KNOBS, Recipe};
use genga::time::FrameRate;

/// Pieces of work per thread. With fewer, some threads would wait for the last; with more, each piece would repeat
/// stages that the one before already made.
const PIECES: usize = 4;

/// Largest number of cells of a study.
const MOST: usize = 1_000_000;

/// Sections of the recipe and top-level settings, in the order in which the chain uses them.
const CHAIN: [&str; 15] = [
    "noise",
    "exaggerate",
    "seen_from",
    "speed",
    "filter",
    "turns",
    "layers",
    "rate",
    "keys",
    "spacing",
    "omission",
    "root",
    "feet",
    "loop",
    "cycles",
];

/// A study (調査): a recipe with one or two of its settings varied, and the measures of each cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// All settings outside the axes.
    pub recipe: Recipe,
    /// The setting that is varied.
    pub x: Axis,
    /// A second setting, varied for each value of the first.
    pub y: Option<Axis>,
    /// The measures. The chain runs no further than they require: `union` and `total` need neither merge nor prices,
    /// which take most of the time.
    pub measures: Vec<Measure>,
    /// Whether each cell keeps its layer keys for comparison with others.
    pub keep_keys: bool,
    /// The memory budget of a cell's run.
    pub budget: Budget,
}

impl Study {
    /// Checks the recipe, every value in its place in it, and that there is a measure.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the knob.
    pub fn validate(&self) -> Result<(), Error> {
        self.recipe.validate()?;
        if self.measures.is_empty() {
            return Err(Error::setting("measure", "there is nothing to count; name a measure"));
        }
        if let Some(y) = self.y.as_ref().filter(|y| y.name() == self.x.name()) {
            return Err(Error::setting(y.name(), "is on both axes; vary another setting"));
        }
        let mut names = [Some(&self.x), self.y.as_ref()].into_iter().flatten().map(Axis::name);
        if self.keep_keys && names.any(|name| name == "rate") {
            let message =
                "keys of sheets at other rates are not compared: their koma differ in length";
            return Err(Error::setting("rate", message));
        }
        if self.len() > MOST {
            let message = format!("{} cells are too many; {MOST} at the most", self.len());
            return Err(Error::setting(self.x.name(), message));
        }
        for axis in [Some(&self.x), self.y.as_ref()].into_iter().flatten() {
            axis.values().iter().try_for_each(|value| self.base().set(axis.name(), value))?;
        }
        Ok(())
    }

    /// Returns the number of cells.
    pub fn len(&self) -> usize {
        self.x.len() * self.y.as_ref().map_or(1, Axis::len)
    }

    /// Whether there are no cells, which never happens.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Measures every cell; `done` is called after each, from several threads.
    ///
    /// # Errors
    /// As for [`Study::validate`] and [`Engine::run`].
    ///
    /// ```
    /// # use genga::recipe::Recipe;
    /// use genga::pipeline::Budget;
    /// use genga_lab::study::{Axis, Measure, Study};
    ///
    /// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
    /// let x = Axis::new("filter.width", "0.1s..0.3s:0.1s")?;
    /// let measures = vec![Measure::Turns];
    /// let study = Study { recipe: Recipe::default(), x, y: None, measures, keep_keys: false, budget: Budget::default() };
    /// let grid = study.run(clip, || {})?;
    /// assert_eq!(grid.values(Measure::Turns), Some(vec![17.0, 13.0, 11.0]));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn run(&self, clip: impl Into<Arc<Clip>>, done: impl Fn() + Sync) -> Result<Grid, Error> {
        let whole = self.run_while(clip, || {
            done();
            true
        })?;
        Ok(whole.expect("nobody ends it"))
    }

    /// Like [`Study::run`], as long as `goes_on` returns true; it is called after each cell, from several threads.
    /// `None` if the study was ended.
    ///
    /// # Errors
    /// As for [`Study::run`].
    pub fn run_while(
        &self,
        clip: impl Into<Arc<Clip>>,
        goes_on: impl Fn() -> bool + Sync,
    ) -> Result<Option<Grid>, Error> {
        let clip = clip.into();
        let measured = self.cells(&clip, goes_on, |bench, at| self.measured(bench, at))?;
        Ok(measured.map(|cells| self.grid(&clip, cells)))
    }

    /// Counts the keys of every joint in every cell, as long as `goes_on` returns true; the measures do not matter.
    /// Returns one list per cell, `y` fastest, with one count per joint; `None` if the study was ended.
    ///
    /// # Errors
    /// As for [`Study::run`].
    pub fn joints_while(
        &self,
        clip: impl Into<Arc<Clip>>,
        goes_on: impl Fn() -> bool + Sync,
    ) -> Result<Option<Vec<Vec<usize>>>, Error> {
        self.cells(&clip.into(), goes_on, |bench, at| {
            let setting = self.setting(at)?;
            Ok(of_each(bench.found(&setting, Reach::Joints)?.turns))
        })
    }

    /// Measures every cell on all cores, in the order of the cells; `None` if it was ended.
    fn cells<T: Send>(
        &self,
        clip: &Arc<Clip>,
        goes_on: impl Fn() -> bool + Sync,
        measure: impl Fn(&mut Bench, usize) -> Result<T, Error> + Sync,
    ) -> Result<Option<Vec<T>>, Error> {
        self.validate()?;
        let is_ended = AtomicBool::new(false);
        let order = self.chain_order();
        // The first cell makes the shared stages; each thread starts with a clone of them.
        let mut bench = Bench::new(Arc::clone(clip), self.budget)?;
        measure(&mut bench, order[0])?;
        let piece = order.len().div_ceil(PIECES * rayon::current_num_threads());
        let measured: Option<Vec<(usize, Result<T, Error>)>> = order
            .into_par_iter()
            .with_min_len(piece)
            .map_init(
                || bench.clone(),
                |bench, at| {
                    if is_ended.load(Ordering::Relaxed) {
                        return None;
                    }
                    let cell = measure(bench, at);
                    is_ended.fetch_or(!goes_on(), Ordering::Relaxed);
                    Some((at, cell))
                },
            )
            .collect();
        let Some(mut measured) = measured.filter(|_| !is_ended.load(Ordering::Relaxed)) else {
            return Ok(None);
        };
        measured.sort_unstable_by_key(|(at, _)| *at);
        measured.into_iter().map(|(_, cell)| cell).collect::<Result<_, _>>().map(Some)
    }

    /// Starts measuring [a cell at a time](Walk), for callers with one core and other work to do on it.
    ///
    /// # Errors
    /// As for [`Study::validate`].
    pub fn begin(self, clip: impl Into<Arc<Clip>>) -> Result<Walk, Error> {
        self.validate()?;
        let bench = Bench::new(clip.into(), self.budget)?;
        let (order, cells) = (self.chain_order().into_iter(), vec![None; self.len()]);
        Ok(Walk { study: self, bench, order, cells })
    }

    fn grid(&self, clip: &Clip, cells: Vec<Cell>) -> Grid {
        Grid {
            x: self.x.clone(),
            y: self.y.clone(),
            measures: self.measures.clone(),
            own: self.own_cell(clip.rate()),
            frames_in_koma: clip.clock(self.recipe.rate).frames_in_koma(),
            cells,
        }
    }

    fn base(&self) -> Setting {
        Setting { recipe: self.recipe.clone(), noise: Noise::default() }
    }

    /// Returns the cells in the order that recomputes the least: the setting that the chain uses first changes last.
    pub(super) fn chain_order(&self) -> Vec<usize> {
        let rows = self.y.as_ref().map_or(1, Axis::len);
        let columns = self.x.len();
        match &self.y {
            Some(y) if place(y.name()) < place(self.x.name()) => {
                (0..rows).flat_map(|y| (0..columns).map(move |x| x * rows + y)).collect()
            }
            _ => (0..rows * columns).collect(),
        }
    }

    fn setting(&self, at: usize) -> Result<Setting, Error> {
        let rows = self.y.as_ref().map_or(1, Axis::len);
        let mut setting = self.base();
        setting.set(self.x.name(), &self.x.values()[at / rows])?;
        if let Some(y) = &self.y {
            setting.set(y.name(), &y.values()[at % rows])?;
        }
        Ok(setting)
    }

    fn measured(&self, bench: &mut Bench, at: usize) -> Result<Cell, Error> {
        let setting = self.setting(at)?;
        let found = bench.found(&setting, self.reach())?;
        let values = self.measures.iter().map(|measure| measure.evaluate(&found)).collect();
        let frames =
            |keys: &genga::keys::LayerKeys| keys.keys.iter().map(|key| key.frame).collect();
        let seconds = found.seconds(&setting.recipe);
        Ok(Cell { values, seconds, keys: found.keys.filter(|_| self.keep_keys).map(frames) })
    }

    /// Returns the cell nearest to the recipe's own settings.
    fn own_cell(&self, rate: FrameRate) -> Option<usize> {
        let base = self.base();
        let place = |axis: &Axis| axis.nearest_at(&base.get(axis.name()).ok()?, rate);
        let y = self.y.as_ref().map_or(Some(0), place)?;
        Some(place(&self.x)? * self.y.as_ref().map_or(1, Axis::len) + y)
    }

    /// Returns how far the chain has to run.
    fn reach(&self) -> Reach {
        let asked = self.measures.iter().map(|measure| measure.reach());
        let keys = self.keep_keys.then_some(Reach::Keys);
        asked.chain(keys).max().unwrap_or(Reach::Joints)
    }
}

/// A study in progress.
pub struct Walk {
    study: Study,
    bench: Bench,
    order: std::vec::IntoIter<usize>,
    cells: Vec<Option<Cell>>,
}

impl Walk {
    /// Measures the next cell; returns the grid when none is left.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn step(&mut self) -> Result<Option<Grid>, Error> {
        let Some(at) = self.order.next() else {
            let cells = std::mem::take(&mut self.cells);
            let cells = cells.into_iter().flatten().collect();
            return Ok(Some(self.study.grid(&self.bench.clean, cells)));
        };
        self.cells[at] = Some(self.study.measured(&mut self.bench, at)?);
        Ok(None)
    }
}

/// Returns the position of a setting in the chain.
fn place(name: &str) -> (usize, usize) {
    let section = name.split('.').next().unwrap_or_default();
    let section = CHAIN.iter().position(|own| *own == section).unwrap_or(CHAIN.len());
    (section, KNOBS.iter().position(|knob| knob.name == name).unwrap_or(0))
}

/// An engine, and the noise of its clip.
#[derive(Clone)]
struct Bench {
    clean: Arc<Clip>,
    noise: Noise,
    budget: Budget,
    engine: Engine,
}

impl Bench {
    fn new(clip: Arc<Clip>, budget: Budget) -> Result<Self, Error> {
        let engine = Engine::new(Arc::clone(&clip))?.with_budget(budget);
        Ok(Self { clean: clip, noise: Noise::default(), budget, engine })
    }

    /// Runs the chain up to `reach`; a loop to the end, where its round is cut out.
    fn found(&mut self, setting: &Setting, reach: Reach) -> Result<Found<'_>, Error> {
        if setting.noise != self.noise {
            self.engine = Engine::new(setting.noise.on(&self.clean))?.with_budget(self.budget);
            self.noise = setting.noise;
        }
        let (recipe, edits) = (&setting.recipe, Edits::default());
        let clip = &*self.clean;
        let reach = if recipe.r#loop { Reach::Sheet } else { reach };
        Ok(match reach {
            Reach::Joints => {
                let turns = self.engine.find_turns(recipe)?;
                Found { clip, turns, body: None, keys: None, layer: None }
            }
            Reach::Body => {
                let (turns, body) = self.engine.find_body_turns(recipe)?;
                Found { clip, turns, body: Some(body), keys: None, layer: None }
            }
            Reach::Keys => {
                let FoundKeys { turns, body, keys, .. } = self.engine.find_keys(recipe, &edits)?;
                Found { clip, turns, body: Some(body), keys: Some(keys), layer: None }
            }
            Reach::Sheet => {
                let run = self.engine.run(recipe, &edits)?;
                let layer = Some((&run.sheet.layers[0], run.clock.koma_rate));
                let (body, keys) = (Some(run.first_layer().body), Some(run.first_layer().keys));
                Found { clip: run.clip, turns: run.turns, body, keys, layer }
            }
        })
    }
}
