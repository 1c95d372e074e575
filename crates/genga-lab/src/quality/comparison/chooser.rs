//! Computes the keys of every method at every count.

use std::sync::Arc;
use std::time::Instant;

use crate::quality::baselines::{
    LongestPolyline, Objective, Optimal, Segments, Simplified, every, uniform,
};
use crate::quality::{Compare, KomaFrames, Method};
use crate::study::table_1_recipe;
use genga::edits::Edits;
use genga::error::Error;
use genga::keys::{AtGaits, Rank};
use genga::motion::Clip;
use genga::pipeline::{Engine, Stop};
use genga::recipe::Recipe;
use genga::target::with_found;
use genga::time::Frame;

/// The keys that a method chooses.
pub(super) struct Chosen {
    pub(super) method: Method,
    /// For each count, the frames of the keys without the clip's ends.
    pub(super) keys: Vec<Vec<Frame>>,
    /// The time taken, in milliseconds.
    pub(super) ms: f64,
}

/// Chooses keys of a clip.
pub(super) struct Chooser<'a> {
    recipe: &'a Recipe,
    /// Length in koma of the longest clip on which methods with cubic work are run.
    longest: usize,
    engine: Engine,
    stop: &'a Stop,
    grid: KomaFrames,
}

impl<'a> Chooser<'a> {
    pub(super) fn new(
        clip: Arc<Clip>,
        (of, stop): (&'a Compare, &'a Stop),
        longest: usize,
    ) -> Result<Self, Error> {
        let recipe = &of.recipe;
        let mut engine = Engine::new(Arc::clone(&clip))?.with_budget(of.budget);
        engine.stop_with(stop.clone());
        let clock = clip.clock(recipe.rate);
        Ok(Self { recipe, longest, engine, stop, grid: KomaFrames::new(clip, clock) })
    }

    pub(super) fn grid(&self) -> &KomaFrames {
        &self.grid
    }

    /// Returns the number of keys that the recipe finds by itself.
    pub(super) fn own_keys(&mut self) -> Result<usize, Error> {
        Ok(self.engine.find_keys(self.recipe, &Edits::default())?.keys.keys.len())
    }

    /// Returns the keys of methods with a fixed number; methods for which the clip is too short are left out.
    pub(super) fn paces(&self) -> Vec<(Method, Vec<Frame>)> {
        let grid = &self.grid;
        let paces = Method::PACES.map(|(method, step)| {
            // Below 24 fps several koma share a frame.
            let places =
                every(grid.reference.koma(), step).into_iter().map(|koma| grid.place(koma));
            let mut places: Vec<usize> =
                places.filter(|place| (1..=grid.inner()).contains(place)).collect();
            places.dedup();
            (method, grid.frames_at(&places))
        });
        paces.into_iter().filter(|(_, keys)| !keys.is_empty()).collect()
    }

    /// Returns the keys of every method; slow methods only if the clip is not too long.
    pub(super) fn choose(&mut self, counts: &[usize]) -> Result<Vec<Chosen>, Error> {
        let mut chosen = Vec::new();
        let mut segments = None;
        let is_long = self.grid.reference.koma() > self.longest;
        for method in Method::ALL.into_iter().filter(|method| !(is_long && method.is_cubic())) {
            self.stop.check()?;
            let begin = Instant::now();
            let keys = match method {
                Method::Own => self.own(self.recipe, counts)?,
                Method::KurodaTokoi => self.own(&by_joints(self.recipe.rate), counts)?,
                optimal if optimal.is_optimal() => {
                    let measured = match segments.take() {
                        Some(measured) => measured,
                        None => Segments::until(&self.grid, self.stop)?,
                    };
                    self.optimal(segments.insert(measured), method, counts)
                }
                _ => self.simple(method, counts),
            };
            chosen.push(Chosen { method, keys, ms: 1e3 * begin.elapsed().as_secs_f64() });
        }
        Ok(chosen)
    }

    /// Returns the keys of a recipe with room for each count; without gaits where their phases allow no such count.
    fn own(&mut self, recipe: &Recipe, counts: &[usize]) -> Result<Vec<Vec<Frame>>, Error> {
        let mut free = recipe.clone();
        free.keys.gaits = AtGaits::Off;
        let keys = |count: &usize| {
            let keys = self.own_of(recipe, *count)?;
            if keys.len() == *count {
                return Ok(keys);
            }
            let others = self.own_of(&free, *count)?;
            let off = |keys: &Vec<Frame>| keys.len().abs_diff(*count);
            Ok(if off(&others) < off(&keys) { others } else { keys })
        };
        counts.iter().map(keys).collect()
    }

    /// Returns as many keys of a recipe as it can have. If the count is below the number of rest ends, rests are left
    /// out, as their ends stay whatever a key saves.
    fn own_of(&mut self, recipe: &Recipe, count: usize) -> Result<Vec<Frame>, Error> {
        let edits = Edits::default();
        let layer = self.engine.find_keys(recipe, &edits)?.keys;
        let rests = layer.keys.iter().filter(|key| !key.origin.is_found()).count();
        let mut without_rests = recipe.clone();
        without_rests.keys.rest = 0.0;
        let (recipe, free) = match count.checked_sub(rests) {
            Some(free) => (recipe, free),
            None => (&without_rests, count),
        };
        let recipe = with_found(&mut self.engine, recipe, &edits, free)?;
        let layer = self.engine.find_keys(&recipe, &edits)?.keys;
        Ok(layer.keys.iter().map(|key| key.frame).collect())
    }

    fn optimal(&self, segments: &Segments, method: Method, counts: &[usize]) -> Vec<Vec<Frame>> {
        let objective =
            if method == Method::OptimalMean { Objective::Mean } else { Objective::Worst };
        let best = Optimal::new(segments, objective, most(counts));
        counts.iter().map(|count| self.grid.frames_at(&best.keys(*count))).collect()
    }

    fn simple(&self, method: Method, counts: &[usize]) -> Vec<Vec<Frame>> {
        let grid = &self.grid;
        let places: Vec<Vec<usize>> = match method {
            Method::Simplified => {
                let order = Simplified::new(grid, most(counts));
                counts.iter().map(|count| order.keys(*count)).collect()
            }
            Method::Polyline => {
                let longest = LongestPolyline::new(grid, most(counts));
                counts.iter().map(|count| longest.keys(*count)).collect()
            }
            _ => counts.iter().map(|count| uniform(grid.frames.len(), *count)).collect(),
        };
        places.iter().map(|places| grid.frames_at(places)).collect()
    }
}

fn most(counts: &[usize]) -> usize {
    counts.iter().copied().max().unwrap_or(0)
}

/// Returns the first paper's own rule: turns of any joint, those shared by most joints first.
fn by_joints(rate: f64) -> Recipe {
    let mut recipe = table_1_recipe();
    recipe.rate = rate;
    recipe.keys.rank = Rank::Strength;
    recipe.keys.rest = 0.0;
    recipe
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::tests::swing;
    use genga::motion::Clip;
    use genga::time::{Frame, FrameRate};

    #[test]
    fn twos_and_threes_go_by_koma_whatever_the_rate_of_the_source() {
        let angles: Vec<f64> = (0..13).map(|at| 9.0 * f64::from(at)).collect();
        let paces = |fps: f64| {
            let swing = swing(&angles);
            let rate = FrameRate::new(fps).unwrap();
            let skeleton = swing.skeleton().clone();
            let clip = Clip::new(skeleton, rate, Frame(0), 13, angles.clone()).unwrap();
            let asked = Compare::default();
            let stop = Stop::default();
            let chooser = Chooser::new(Arc::new(clip), (&asked, &stop), 100).unwrap();
            let numbers = |keys: Vec<Frame>| keys.iter().map(|key| key.0).collect::<Vec<_>>();
            chooser.paces().into_iter().map(|(_, keys)| numbers(keys)).collect::<Vec<_>>()
        };
        assert_eq!(paces(24.0), [vec![3, 6, 9], vec![2, 4, 6, 8, 10]]);
        // Two koma share a frame.
        assert_eq!(paces(12.0)[1], (1..12).collect::<Vec<_>>());
        assert_eq!(paces(8.0)[0], (1..12).collect::<Vec<_>>());
        assert_eq!(paces(48.0), [vec![6], vec![4, 8]]);
    }
}
