//! Compares several ways to choose the same number of keys.

mod chooser;

use std::sync::Arc;

use serde::Serialize;

use crate::quality::hits::Hits;
use crate::quality::{Extrema, KomaFrames, Method};
use crate::study::Noise;
use chooser::Chooser;
use genga::error::Error;
use genga::keys::{Matching, Reconstruction};
use genga::motion::Clip;
use genga::pipeline::{Budget, Stop};
use genga::recipe::Recipe;
use genga::time::{Clock, Frame};

/// Largest distance at which two keys count as the same, in koma.
const TOLERANCE: f64 = 1.0;

/// The settings of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Compare {
    /// The recipe by which the program's own keys are chosen, up to the requested number.
    pub recipe: Recipe,
    /// Numbers of keys, without the clip's ends; empty: as many as the recipe finds, half and double.
    pub counts: Vec<usize>,
    /// The noise under which keys are chosen a second time.
    pub noise: Noise,
    /// Length in koma of the longest clip for which optimal sets and longest polylines are computed, as their work is
    /// cubic. With noise the limit is a third of it.
    pub longest: usize,
    /// Whether to report how long each method took. Times differ from run to run.
    pub times: bool,
    /// The memory budget of a run.
    pub budget: Budget,
}

impl Default for Compare {
    /// Noise of 0.1°, and optimal sets and polylines for up to 1,500 koma, about a minute.
    fn default() -> Self {
        Self {
            recipe: Recipe::default(),
            counts: Vec::new(),
            noise: Noise { degrees: 0.1, seed: 0 },
            longest: 1500,
            times: false,
            budget: Budget::default(),
        }
    }
}

/// Ways to choose keys of one clip, side by side (比較).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Number of koma of the clip.
    pub koma: usize,
    /// Number of keys that the recipe finds by itself.
    pub own_keys: usize,
    /// Number of moments at which the body turns in the world.
    pub extrema: usize,
    /// The rows by count, and within a count by method.
    pub rows: Vec<Row>,
    /// Keys on threes and on twos, each with a fixed number: see [`Method::PACES`].
    pub paces: Vec<Row>,
}

/// One method at one count.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The method.
    pub method: Method,
    /// The requested number of keys.
    pub asked: usize,
    /// The number of keys it chose.
    pub keys: usize,
    /// The mean error of reconstruction, in % of body height.
    pub mean: f64,
    /// The error of the worst koma.
    pub worst: f64,
    /// The mean error as a multiple of the optimum; `None` if the optimum is unknown or 0, or has fewer keys.
    pub mean_ratio: Option<f64>,
    /// The worst error as a multiple of the optimum.
    pub worst_ratio: Option<f64>,
    /// The share of the heaviest extrema that have a key within a koma; as many extrema count as keys were requested,
    /// or all. `None` without an extremum.
    pub hits: Option<f64>,
    /// The mean share when the keys are rotated around the clip by 1, 2, 3 … koma.
    pub by_chance: Option<f64>,
    /// The mean distance from one of those extrema to the nearest key, in koma; `None` if either is missing.
    pub off: Option<f64>,
    /// The share of keys that stay the same within a koma under noise (F1); `None` without noise or keys.
    pub steady: Option<f64>,
    /// Milliseconds from the clip to the keys of all counts; `None` unless requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ms: Option<f64>,
}

impl Compare {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a count of 0 and for invalid settings of recipe and noise.
    pub fn validate(&self) -> Result<(), Error> {
        self.recipe.validate()?;
        self.noise.validate()?;
        if self.counts.contains(&0) {
            return Err(Error::setting("keys", "a comparison needs a key: 1 or more"));
        }
        Ok(())
    }

    /// Compares all methods on a clip. A method that has fewer keys than requested gives those; the others give the
    /// requested number, as far as the clip has koma.
    ///
    /// # Errors
    /// As for [`Compare::validate`], and [`Error::Clip`] for a clip without motion.
    ///
    /// ```
    /// use genga_lab::quality::{Compare, Method};
    ///
    /// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
    /// let compare = Compare { counts: vec![8], ..Compare::default() };
    /// let comparison = compare.run(clip)?;
    /// let mean = |method| comparison.row(method, 8).map(|row| row.mean);
    /// assert!(mean(Method::Own) < mean(Method::Uniform), "% of body height off");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn run(&self, clip: impl Into<Arc<Clip>>) -> Result<Comparison, Error> {
        self.run_until(clip, &Stop::default())
    }

    /// Like [`Compare::run`], until `stop` is asked.
    ///
    /// # Errors
    /// As for [`Compare::run`], and [`Error::Stopped`].
    pub fn run_until(&self, clip: impl Into<Arc<Clip>>, stop: &Stop) -> Result<Comparison, Error> {
        self.validate()?;
        let clip = clip.into();
        let noisy = Arc::new(self.noise.on(&clip));
        let mut chooser = Chooser::new(clip, (self, stop), self.longest)?;
        let own_keys = chooser.own_keys()?;
        let counts = self.counts_of(own_keys, chooser.grid().inner());
        let paces = chooser.paces();
        let all: Vec<usize> =
            counts.iter().copied().chain(paces.iter().map(|(_, keys)| keys.len())).collect();
        let chosen = chooser.choose(&all)?;
        let again = if self.noise.degrees > 0.0 {
            Some(Chooser::new(noisy, (self, stop), self.longest / 3)?.choose(&counts)?)
        } else {
            None
        };
        let grid = chooser.grid();
        let extrema = Extrema::new(&grid.clip, grid.clock());
        let mut rows = Vec::new();
        for (at, asked) in counts.iter().enumerate() {
            let own: Vec<Row> = chosen
                .iter()
                .map(|chosen| {
                    let keys = &chosen.keys[at];
                    let again = again
                        .as_ref()
                        .and_then(|again| again.iter().find(|other| other.method == chosen.method));
                    let steady = again.and_then(|again| kept(grid.clock(), keys, &again.keys[at]));
                    let ms = self.times.then_some(chosen.ms);
                    Row { steady, ms, ..row(grid, chosen.method, *asked, keys, &extrema) }
                })
                .collect();
            rows.extend(with_ratios(own));
        }
        let paced = (counts.len()..).zip(&paces).map(|(at, (method, keys))| {
            let best = chosen.iter().filter(|chosen| chosen.method.is_optimal());
            let best =
                best.map(|best| row(grid, best.method, keys.len(), &best.keys[at], &extrema));
            let own = row(grid, *method, keys.len(), keys, &extrema);
            with_ratios(best.chain([own]).collect()).pop()
        });
        let paces = paced.flatten().collect();
        let koma = chooser.grid().reference.koma();
        Ok(Comparison { koma, own_keys, extrema: extrema.moments.len(), rows, paces })
    }

    fn counts_of(&self, own: usize, inner: usize) -> Vec<usize> {
        let mut counts = self.counts.clone();
        if counts.is_empty() {
            counts = vec![own / 2, own, 2 * own];
        }
        counts.retain(|count| *count > 0 && inner > 0);
        counts.sort_unstable();
        counts.dedup();
        counts
    }
}

impl Comparison {
    /// Returns the row of a method at a count.
    pub fn row(&self, method: Method, asked: usize) -> Option<&Row> {
        self.rows.iter().find(|row| row.method == method && row.asked == asked)
    }

    /// Returns the requested counts in ascending order.
    pub fn counts(&self) -> Vec<usize> {
        let mut counts: Vec<usize> = self.rows.iter().map(|row| row.asked).collect();
        counts.dedup();
        counts
    }
}

fn row(grid: &KomaFrames, method: Method, asked: usize, keys: &[Frame], extrema: &Extrema) -> Row {
    let errors = Reconstruction::new(&grid.clip, &grid.reference, keys);
    let koma = grid.reference.koma();
    let hits = Hits::new(keys, &extrema.heaviest(asked), grid.clock(), koma);
    Row {
        method,
        asked,
        keys: keys.len(),
        mean: errors.mean(),
        worst: errors.worst(),
        mean_ratio: None,
        worst_ratio: None,
        hits: hits.map(|hits| hits.share),
        by_chance: hits.map(|hits| hits.by_chance),
        off: hits.and_then(|hits| hits.off),
        steady: None,
        ms: None,
    }
}

/// Completes the rows of one count with the ratios of their errors to the optimum. More keys than the optimum has are
/// not compared with it.
fn with_ratios(mut rows: Vec<Row>) -> Vec<Row> {
    let of = |method: Method, error: fn(&Row) -> f64| {
        let best = rows.iter().find(|row| row.method == method)?;
        Some((best.keys, error(best))).filter(|(_, least)| *least > 0.0)
    };
    let mean = of(Method::OptimalMean, |row| row.mean);
    let worst = of(Method::OptimalWorst, |row| row.worst);
    for row in &mut rows {
        let ratio = |error: f64, best: Option<(usize, f64)>| {
            best.filter(|(keys, _)| row.keys <= *keys).map(|(_, least)| error / least)
        };
        (row.mean_ratio, row.worst_ratio) = (ratio(row.mean, mean), ratio(row.worst, worst));
    }
    rows
}

/// Returns the share of keys that two lists have in common; `None` if both are empty.
fn kept(clock: Clock, keys: &[Frame], others: &[Frame]) -> Option<f64> {
    let matching = Matching::between(keys, others, TOLERANCE * clock.frames_in_koma());
    (!matching.is_empty()).then(|| matching.kept())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::tests::swing;

    fn clip() -> Clip {
        let angle = |at: i32| {
            let time = f64::from(at) / 24.0;
            50.0 * (5.0 * time).sin() + 12.0 * (13.0 * time).sin()
        };
        swing(&(0..120).map(angle).collect::<Vec<_>>())
    }

    #[test]
    fn every_method_gives_as_many_keys_and_none_is_better_than_the_best() {
        let asked = Compare { counts: vec![12, 4, 8, 8], ..Compare::default() };
        let found = asked.run(clip()).unwrap();
        assert_eq!(found.counts(), [4, 8, 12]);
        assert_eq!(found.rows.len(), 3 * Method::ALL.len());
        for row in &found.rows {
            if ![Method::Own, Method::KurodaTokoi].contains(&row.method) {
                assert_eq!(row.keys, row.asked, "{row:?}");
            }
            assert!(row.keys <= row.asked, "{row:?}");
            let [mean, worst] = [row.mean_ratio, row.worst_ratio].map(Option::unwrap);
            // The program's own keys may stand between koma.
            let least = if row.method == Method::Own { 0.9 } else { 1.0 - 1e-12 };
            assert!(mean >= least && worst >= least, "{row:?}");
            assert_eq!(row.ms, None);
        }
        let ratio = |method| found.row(method, 8).unwrap();
        assert_eq!(ratio(Method::OptimalMean).mean_ratio, Some(1.0));
        assert_eq!(ratio(Method::OptimalWorst).worst_ratio, Some(1.0));
        assert_eq!(ratio(Method::Uniform).steady, Some(1.0), "noise moves no even distance");
        assert_eq!(asked.run(clip()).unwrap(), found, "the same again");
        let paces: Vec<_> = found.paces.iter().map(|row| (row.method, row.keys)).collect();
        assert_eq!(paces, [(Method::Threes, 39), (Method::Twos, 59)]);
        assert!(found.paces.iter().all(|row| row.mean_ratio.is_some_and(|ratio| ratio > 1.0)));
        assert!(found.paces[1].mean < found.paces[0].mean);
    }

    #[test]
    fn without_counts_it_is_as_many_as_the_recipe_finds_half_and_double() {
        let asked = Compare { times: true, ..Compare::default() };
        let found = asked.run(clip()).unwrap();
        assert!(found.own_keys > 2);
        assert_eq!(found.counts(), [found.own_keys / 2, found.own_keys, 2 * found.own_keys]);
        let own = found.row(Method::Own, found.own_keys).unwrap();
        assert_eq!(own.keys, found.own_keys);
        assert!(found.rows.iter().all(|row| row.ms.is_some_and(|ms| ms >= 0.0)));
    }

    #[test]
    fn a_clip_that_is_too_long_has_no_optimum_and_without_noise_nothing_is_steady() {
        let noise = Noise { degrees: 0.0, seed: 0 };
        let asked = Compare { counts: vec![5], longest: 100, noise, ..Compare::default() };
        let found = asked.run(clip()).unwrap();
        for method in [Method::OptimalMean, Method::OptimalWorst, Method::Polyline] {
            assert!(found.row(method, 5).is_none(), "{method}");
        }
        assert!(found.row(Method::Simplified, 5).is_some());
        assert!(found.rows.iter().all(|row| row.mean_ratio.is_none() && row.steady.is_none()));
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        let asked = |counts: &[usize]| Compare { counts: counts.to_vec(), ..Compare::default() };
        assert!(asked(&[0]).run(clip()).is_err());
        assert!(asked(&[4]).run(swing(&[])).is_err());
        assert!(asked(&[4]).run(swing(&[1.0])).unwrap().rows.is_empty(), "no key fits in");
        let noise = Noise { degrees: -1.0, seed: 0 };
        assert!(Compare { noise, ..Compare::default() }.validate().is_err());
    }

    #[test]
    fn more_keys_than_there_are_koma_stay_asked_for_and_are_not_given() {
        let asked = Compare { counts: vec![90, 200], ..Compare::default() };
        let found = asked.run(swing(&[0.0, 9.0, 0.0, 9.0])).unwrap();
        assert_eq!(found.counts(), [90, 200]);
        for count in [90, 200] {
            let given = |method| found.row(method, count).unwrap().keys;
            assert_eq!(given(Method::Uniform), 2);
            assert_eq!(given(Method::OptimalMean), 2);
            assert!(given(Method::Own) <= 2);
        }
    }

    #[test]
    fn what_cannot_be_measured_is_none() {
        let asked = Compare { counts: vec![4], ..Compare::default() };
        let still = asked.run(swing(&[5.0; 40])).unwrap();
        assert_eq!((still.extrema, still.own_keys), (0, 0));
        for row in still.rows.iter().chain(&still.paces) {
            assert_eq!((row.hits, row.by_chance, row.off), (None, None, None), "{row:?}");
            assert!(row.keys > 0 || row.steady.is_none(), "{row:?}");
        }
    }
}
