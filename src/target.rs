//! **Targets** (目標): goals for the sheet, from which the settings are found.
//!
//! [`meet`] searches for the settings, writes them into a recipe, and reports what stood in the way. The search is
//! deterministic: the same clip, recipe and targets give the same settings, and those settings reproduce the sheet
//! without any target.

mod counter;
mod drawings;
mod error;
mod gaits;
mod genga;
mod key_count_search;
mod ladder;
mod reasons;

use std::fmt;

use counter::{Counter, Known, OneStep};

use crate::edits::Edits;
use crate::error::Error;
use crate::keys::Layers;
use crate::pipeline::{Breakdown, Engine};
use crate::recipe::Recipe;
use crate::sheet::{Layer, Role};
pub use key_count_search::with_found;
pub use reasons::Shortfall;

/// A goal for the sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// Number of genga on the sheet, counting found keys, pins, and ends of rests and contacts, but not the clip's two
    /// ends.
    Keys(usize),
    /// Drawings per second of the sheet: above 0, and at most one per koma.
    DrawingsPerSecond(f64),
    /// Largest error in % of body height, above 0, met with few keys. The error is that of the body slerped from key to
    /// key, at the worst koma, as a root mean square over its points.
    MaxError(f64),
}

/// Settings that come as near to the targets as possible.
#[derive(Debug, Clone, PartialEq)]
pub struct Met {
    /// The recipe; only settings that had to change differ.
    pub recipe: Recipe,
    /// The outcomes of the targets, in the order they were met.
    pub outcomes: Vec<Outcome>,
}

/// The outcome of a target.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The requested target.
    pub target: Target,
    /// The value that the sheet reaches, in the target's unit.
    pub reached: f64,
    /// Why the target was missed; `None` if it is met, or as nearly as whole drawings allow.
    pub shortfall: Option<Shortfall>,
}

/// Rounds of settling keys and drawings in turn: where drawings may stand decides which keys have room.
const MOST_ROUNDS: usize = 4;

/// Finds settings with which the sheet meets the targets, or comes as near as possible.
///
/// Keys are settled before drawings: a number of drawings never changes keys that a target asked for. A recipe that
/// already meets a number of keys or drawings is left unchanged.
///
/// # Errors
/// [`Error::Setting`] named after the target when it can never be met or contradicts another. Otherwise as for
/// [`Engine::run`].
///
/// ```
/// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
/// use genga::target::{Target, meet};
///
/// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
/// let mut engine = Engine::new(clip)?;
/// let (recipe, edits) = (Recipe::default(), Edits::default());
/// let met = meet(&mut engine, &recipe, &edits, &[Target::Keys(8)])?;
/// assert_eq!(met.outcomes[0].reached, 8.0);
/// assert_ne!(met.recipe, recipe, "the settings that do it");
/// # Ok::<(), genga::Error>(())
/// ```
pub fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    targets: &[Target],
) -> Result<Met, Error> {
    check(targets, recipe)?;
    met(engine, recipe, edits, targets)
}

fn met(
    counter: &mut impl Counter,
    recipe: &Recipe,
    edits: &Edits,
    targets: &[Target],
) -> Result<Met, Error> {
    let mut met = Met { recipe: recipe.clone(), outcomes: Vec::new() };
    for _ in 0..MOST_ROUNDS {
        met.outcomes.clear();
        met.settle_all(counter, edits, targets)?;
        if met.keys_hold(counter, edits)? {
            break;
        }
    }
    Ok(met)
}

/// A search for the settings of a number of genga, one count a step: a window can be drawn between two.
///
/// ```
/// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
/// use genga::target::{Search, Target, meet};
///
/// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
/// let mut engine = Engine::new(clip)?;
/// let (recipe, edits) = (Recipe::default(), Edits::default());
/// let mut search = Search::new(&recipe, &edits, 8);
/// let met = loop {
///     if let Some(met) = search.step(&mut engine) {
///         break met?;
///     }
/// };
/// assert_eq!(met, meet(&mut engine, &recipe, &edits, &[Target::Keys(8)])?);
/// # Ok::<(), genga::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Search {
    recipe: Recipe,
    edits: Edits,
    target: Target,
    known: Known,
}

impl Search {
    /// Creates a search for a number of genga, as [`Target::Keys`] counts them.
    pub fn new(recipe: &Recipe, edits: &Edits, genga: usize) -> Self {
        let (recipe, edits, target) = (recipe.clone(), edits.clone(), Target::Keys(genga));
        Self { recipe, edits, target, known: Vec::new() }
    }

    /// Counts once more. Returns the settings of [`meet`] once they are found, else `None`.
    ///
    /// # Errors
    /// Those of [`meet`].
    pub fn step(&mut self, engine: &mut Engine) -> Option<Result<Met, Error>> {
        let (targets, known) = ([self.target], &mut self.known);
        let mut step = OneStep { engine, known, is_spent: false, is_paused: false };
        let found = check(&targets, &self.recipe)
            .and_then(|()| met(&mut step, &self.recipe, &self.edits, &targets));
        (!step.is_paused).then_some(found)
    }

    /// Number of counts so far; a search takes some tens.
    pub fn counts(&self) -> usize {
        self.known.len()
    }
}

fn check(targets: &[Target], recipe: &Recipe) -> Result<(), Error> {
    if let ([first, ..], true) = (targets, recipe.layers != Layers::Body) {
        let message = "is asked of the whole body as one layer; run without layers first, and then with them and the \
                       settings that it finds, such as keys.min_price=9";
        return Err(Error::setting(first.name(), message));
    }
    for (at, target) in targets.iter().enumerate() {
        if targets[..at].iter().any(|other| other.name() == target.name()) {
            return Err(Error::setting(target.name(), "is asked for twice"));
        }
        match *target {
            Target::DrawingsPerSecond(rate) if !(rate > 0.0 && rate <= recipe.rate) => {
                let most = recipe.rate;
                let message =
                    format!("must be above 0 and at most {most}, a drawing a koma; 8 is usual");
                return Err(Error::setting(target.name(), message));
            }
            Target::MaxError(most) if !(most > 0.0 && most.is_finite()) => {
                let message = "must be above 0, in % of body height, such as 5%";
                return Err(Error::setting(target.name(), message));
            }
            _ => {}
        }
    }
    let names: Vec<_> = targets.iter().map(Target::name).collect();
    if names.contains(&"keys") && names.contains(&"max-error") {
        let message = "cannot be asked for together with a number of keys, as each says how many keys there are; ask for \
                       one of them";
        return Err(Error::setting("max-error", message));
    }
    Ok(())
}

impl Met {
    /// Settles the keys, then the drawings.
    fn settle_all(
        &mut self,
        counter: &mut impl Counter,
        edits: &Edits,
        targets: &[Target],
    ) -> Result<(), Error> {
        let mut keys_are_free = true;
        for target in targets {
            let settled = match *target {
                Target::Keys(count) => {
                    gaits::meet(counter, &self.recipe, edits, |counter, recipe| {
                        genga::meet(counter, recipe, edits, count)
                    })?
                }
                Target::MaxError(most) => {
                    gaits::meet(counter.engine(), &self.recipe, edits, |engine, recipe| {
                        error::meet(engine, recipe, edits, most)
                    })?
                }
                Target::DrawingsPerSecond(_) => continue,
            };
            keys_are_free = false;
            self.settle(settled);
        }
        for target in targets {
            if let Target::DrawingsPerSecond(rate) = *target {
                let goal = drawings::Goal { per_second: rate, keys_are_free };
                self.settle(gaits::meet(
                    counter.engine(),
                    &self.recipe,
                    edits,
                    |engine, recipe| goal.meet(engine, recipe, edits),
                )?);
            }
        }
        Ok(())
    }

    /// Whether settling the drawings left the keys unchanged.
    fn keys_hold(&self, counter: &mut impl Counter, edits: &Edits) -> Result<bool, Error> {
        for outcome in &self.outcomes {
            let now = match outcome.target {
                Target::Keys(_) => counter.genga(&self.recipe, edits)? as f64,
                Target::MaxError(_) => {
                    counter.engine().reconstruction(&self.recipe, edits)?.worst()
                }
                Target::DrawingsPerSecond(_) => continue,
            };
            if now != outcome.reached {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn settle(&mut self, (recipe, outcome): (Recipe, Outcome)) {
        self.recipe = recipe;
        self.outcomes.push(outcome);
    }
}

impl Target {
    /// Returns the option name of the target.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Keys(_) => "keys",
            Self::DrawingsPerSecond(_) => "drawings-per-second",
            Self::MaxError(_) => "max-error",
        }
    }
}

/// Describes the requested and the reached value in a sentence.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let reached = self.reached;
        match self.target {
            Target::Keys(count) => {
                write!(f, "{count} genga were asked for, and there are {reached}")?
            }
            Target::DrawingsPerSecond(rate) => {
                write!(f, "{rate} drawings a second were asked for, and there are {reached:.2}")?;
            }
            Target::MaxError(most) => write!(
                f,
                "the body was to be {most} % of its height off at the most, and it is {reached:.2} %"
            )?,
        }
        match &self.shortfall {
            None => Ok(()),
            Some(why) => write!(f, ": {why}"),
        }
    }
}

impl Outcome {
    /// Returns the same sentence in Japanese.
    pub fn japanese(&self) -> String {
        let reached = self.reached;
        let said = match self.target {
            Target::Keys(count) => format!("原画{count}枚の指定に対して{reached}枚"),
            Target::DrawingsPerSecond(rate) => {
                format!("毎秒{rate}枚の指定に対して毎秒{reached:.2}枚")
            }
            Target::MaxError(most) => {
                format!("復元誤差は身長の{most}%以下の指定に対して{reached:.2}%")
            }
        };
        match &self.shortfall {
            None => said,
            Some(why) => format!("{said}: {}", why.japanese()),
        }
    }
}

/// Returns the layer that targets apply to.
fn layer<'a>(breakdown: &Breakdown<'a>) -> &'a Layer {
    &breakdown.sheet.layers[0]
}

/// Counts the genga on the sheet without the first and last drawing, which are always there.
fn between(breakdown: &Breakdown<'_>) -> usize {
    layer(breakdown).count(Role::Genga)
}

#[cfg(test)]
mod tests;
