//! The target of a number of drawings per second. Koma-dori adjusts it drawing by drawing; beyond its range other
//! settings of the sheet change.

use std::ops::Range;

use super::ladder::{denser, sparser, sparser_to_threes};
use super::{Outcome, Shortfall, Target, between, key_count_search, layer};
use crate::edits::Edits;
use crate::error::Error;
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::sheet::{Drawing, Reason};
use crate::timing::{Amount, On, Spacing};

/// Smallest error in drawings that whole drawings can guarantee.
const EXACT: f64 = 0.5 + 1e-9;

/// Error in drawings above which a person is told.
const NEAR: f64 = 1.0 + 1e-9;

/// Corrections of koma-dori's count. One is enough if naka-nashi goes first.
const MOST_CORRECTIONS: usize = 16;

/// Most steps of koma-dori that are tried beside a result.
const MOST_BESIDE: usize = 8;

/// Most drawings per action that naka-nashi leaves out by a share; fewer are tried if it has to give way.
const MOST_SPARED: usize = 6;

/// Largest share of genga among the requested drawings, if keys may go: two thirds. With more, no inbetweens are left
/// to take away, and slow drawings are held too long at the expense of fast ones.
const MOST_GENGA: f64 = 2.0 / 3.0;

/// Smallest share of found genga among the requested drawings, if there are as many: a quarter. The spacing gives way
/// first, as a denser one would leave the sheet without the method's genga.
const FEWEST_GENGA: f64 = 0.25;

/// Corrections of the number of found keys to meet that share.
const MOST_THINNED: usize = 16;

/// Largest distance in % of body height that the body may go while a drawing stays; at this value every drawing is as
/// slow as its range allows.
const LONGEST_STEP: f64 = 100.0;

/// Bisection steps up to that distance; nearer ones are indistinguishable.
const STEPS: usize = 10;

/// A movement threshold above every movement, in % of body height: a requested number of drawings takes precedence.
const ANY_MOVEMENT: f64 = 1000.0;

/// A number of drawings per second.
pub(super) struct Goal {
    pub(super) per_second: f64,
    /// Whether keys may be dropped to reach it.
    pub(super) keys_are_free: bool,
}

/// Settings, and how many drawings too many their sheet has.
#[derive(Clone)]
struct Found {
    recipe: Recipe,
    excess: f64,
}

struct Search<'a> {
    engine: &'a mut Engine,
    edits: &'a Edits,
    per_second: f64,
}

impl Goal {
    /// Finds settings whose sheet has the requested drawings per second, or as near as possible.
    pub(super) fn meet(
        &self,
        engine: &mut Engine,
        recipe: &Recipe,
        edits: &Edits,
    ) -> Result<(Recipe, Outcome), Error> {
        let mut search = Search { engine, edits, per_second: self.per_second };
        let as_it_is = search.look(recipe)?.0;
        let is_met = as_it_is.is_exact() && !(self.keys_are_free && search.too_many(recipe)? > 0);
        let mut found = if is_met { as_it_is } else { self.search(&mut search, recipe)? };
        // Another rung of spacing gives room to other keys, so there may again be too many.
        for _ in 0..MOST_THINNED {
            if !self.keys_are_free || search.too_many(&found.recipe)? == 0 {
                break;
            }
            found = self.search(&mut search, &found.recipe.clone())?;
        }
        let target = Target::DrawingsPerSecond(self.per_second);
        let breakdown = search.engine.run(&found.recipe, edits)?;
        let (drawings, genga) = (layer(&breakdown).shown().count(), layer(&breakdown).genga());
        let reached = layer(&breakdown).drawings_per_second(breakdown.clock.koma_rate);
        let shortfall = if found.excess.abs() <= NEAR {
            None
        } else if found.excess > 0.0 && !self.keys_are_free {
            Some(Shortfall::new(
                format!(
                    "{genga} genga are wanted, and every drawing between them that could go is gone"
                ),
                format!("原画{genga}枚が指定され、その間で抜ける画はすべて抜いた"),
            ))
        } else if found.excess > 0.0 {
            Some(Shortfall::new(
                format!("{drawings} drawings are left: ends, pins and ends of rests stay"),
                format!("{drawings}枚が残る: 両端、固定、止めの端は残す"),
            ))
        } else {
            Some(Shortfall::new(
                "no other settings of koma-dori, spacing.on and naka-nashi come nearer",
                "コマ撮り、spacing.on、中無しのどの設定でもこれ以上近づかない",
            ))
        };
        Ok((found.recipe, Outcome { target, reached, shortfall }))
    }

    /// Finds the settings nearest to the recipe; a fixed number of inbetweens is given up if no koma-dori suffices.
    fn search(&self, search: &mut Search<'_>, recipe: &Recipe) -> Result<Found, Error> {
        let found = self.descend(search, recipe)?;
        let found = if found.excess.abs() > NEAR { search.beside(found)? } else { found };
        if found.excess.abs() <= NEAR || recipe.spacing.inbetweens.is_none() {
            return Ok(found);
        }
        let mut free = recipe.clone();
        free.spacing.inbetweens = None;
        Ok(found.or(self.descend(search, &free)?))
    }

    /// Tries in order: keys reduced to leave room for inbetweens; koma-dori; the spacing, with koma-dori for it; then
    /// naka-nashi or fewer keys.
    fn descend(&self, search: &mut Search<'_>, recipe: &Recipe) -> Result<Found, Error> {
        let recipe = if self.keys_are_free { &search.thinned(recipe)? } else { recipe };
        let held = search.hold(recipe)?;
        if held.is_exact() {
            return Ok(held);
        }
        if held.excess < 0.0 {
            return search.more(held);
        }
        let slow = search.climb_and_spare(held, sparser_to_threes)?;
        match slow.excess > EXACT {
            true if self.keys_are_free => Ok(slow.clone().or(search.fewer(slow)?)),
            true => search.climb_and_spare(slow, sparser),
            false => Ok(slow),
        }
    }
}

impl Found {
    fn is_exact(&self) -> bool {
        self.excess.abs() <= EXACT
    }

    /// Returns the nearer of two results; `self` on a tie.
    fn or(self, other: Self) -> Self {
        if other.excess.abs() < self.excess.abs() { other } else { self }
    }
}

impl Search<'_> {
    /// Runs a recipe. Returns how many drawings too many it gives, and how many koma-dori took.
    fn look(&mut self, recipe: &Recipe) -> Result<(Found, usize), Error> {
        let breakdown = self.engine.run(recipe, self.edits)?;
        let drawings = layer(&breakdown).changes().count() as f64;
        let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
        // A drawing that a loop does without is gone in every round.
        let excess = (drawings - self.per_second * seconds) / breakdown.sheet.rounds() as f64;
        let done = breakdown.first_layer().omission.koma_dori.done;
        Ok((Found { recipe: recipe.clone(), excess }, done))
    }

    /// Finds the count of koma-dori with which a recipe comes nearest.
    ///
    /// Koma-dori goes drawing by drawing, and a different count takes more or fewer steps on the same way. If
    /// naka-nashi ran before, one more step is one drawing less on the sheet, and the first correction is exact or as
    /// far as it goes. If naka-nashi runs after, it may then take other drawings; the corrections go on, and the
    /// nearest result is kept.
    fn hold(&mut self, recipe: &Recipe) -> Result<Found, Error> {
        let mut count = 0;
        let mut best: Option<Found> = None;
        for _ in 0..MOST_CORRECTIONS {
            let (found, done) = self.look(&with_koma_dori(recipe, count))?;
            let excess = found.excess;
            // Do not ask for more than could be done.
            let found = Found { recipe: with_koma_dori(recipe, count.min(done)), excess };
            let next = (done as f64 + excess.round()).max(0.0) as usize;
            let is_exact = found.is_exact();
            best = Some(match best {
                None => found,
                Some(best) => best.or(found),
            });
            if is_exact || next == count || (done < count && next > done) {
                break;
            }
            count = next;
        }
        Ok(best.expect("it was looked at once"))
    }

    /// Tries the counts of koma-dori beside that of a result. If naka-nashi runs after koma-dori, one step more of it may
    /// be several drawings less on the sheet or more, so the corrections of [`Self::hold`] may jump over the nearest.
    fn beside(&mut self, from: Found) -> Result<Found, Error> {
        let Amount::Count(count) = from.recipe.omission.koma_dori else { return Ok(from) };
        let mut best = from.clone();
        for count in count.saturating_sub(MOST_BESIDE)..=count + MOST_BESIDE {
            let (found, done) = self.look(&with_koma_dori(&from.recipe, count))?;
            best = if done < count { best } else { best.or(found) };
        }
        Ok(best)
    }

    /// Like [`Self::hold`], with a given number of found keys.
    fn hold_with(&mut self, recipe: &Recipe, count: usize) -> Result<Found, Error> {
        let recipe = key_count_search::with_found(self.engine, recipe, self.edits, count)?;
        self.hold(&recipe)
    }

    /// Climbs the rungs of spacing until the excess of drawings changes sign, and returns the nearest result. If the
    /// target lies between two rungs, naka-nashi leaves out fewer on the one with too few drawings.
    fn climb_and_spare(
        &mut self,
        from: Found,
        next: fn(&Spacing) -> Option<Spacing>,
    ) -> Result<Found, Error> {
        let was_above = from.excess > 0.0;
        let mut rung = from.recipe.spacing.clone();
        let (mut best, mut last) = (from.clone(), from);
        while let Some(spacing) = next(&rung) {
            rung = spacing;
            let found = self.hold(&Recipe { spacing: rung.clone(), ..best.recipe.clone() })?;
            best = best.or(found.clone());
            if found.is_exact() {
                break;
            }
            if (found.excess > 0.0) != was_above {
                let [many, few] = if was_above { [last, found] } else { [found, last] };
                let best = best.or(self.stretch(many)?);
                return if best.is_exact() { Ok(best) } else { Ok(best.or(self.spare(few)?)) };
            }
            last = found;
        }
        Ok(best)
    }

    /// Holds each drawing longer on a rung with a range of koma, by allowing the body to go further meanwhile.
    fn stretch(&mut self, from: Found) -> Result<Found, Error> {
        let mut recipe = from.recipe.clone();
        let mut best = from;
        if recipe.spacing.on.is_fixed() {
            return Ok(best);
        }
        let (mut low, mut high) = (recipe.spacing.step, LONGEST_STEP);
        for _ in 0..STEPS {
            if best.is_exact() {
                break;
            }
            recipe.spacing.step = rounded((low * high).sqrt());
            let found = self.hold(&recipe)?;
            *if found.excess > 0.0 { &mut low } else { &mut high } = recipe.spacing.step;
            best = best.or(found);
        }
        Ok(best)
    }

    /// Adds drawings once koma-dori is at 0: denser spacing, then no naka-nashi.
    fn more(&mut self, from: Found) -> Result<Found, Error> {
        let dense = self.climb_and_spare(from, denser)?;
        if dense.excess >= -EXACT {
            return Ok(dense);
        }
        let mut recipe = dense.recipe.clone();
        recipe.omission.naka_nashi = Amount::Count(0);
        let whole = self.hold(&recipe)?;
        if whole.excess >= -EXACT {
            return Ok(dense.or(whole));
        }
        // Only rests can still take more drawings.
        recipe.spacing.drift = 0.0;
        let moving = self.hold(&recipe)?;
        if moving.excess >= -EXACT {
            return Ok(dense.or(whole).or(moving));
        }
        // A range of koma may have sufficed while rests were held.
        recipe.spacing.on = On::every(1);
        let on_ones = self.hold(&recipe)?;
        Ok(dense.or(whole).or(moving).or(on_ones))
    }

    /// Counts the surplus genga that leave no room for inbetweens among the requested drawings, outside gaits; 0 if
    /// none of them can go.
    fn too_many(&mut self, recipe: &Recipe) -> Result<usize, Error> {
        let breakdown = self.engine.run(recipe, self.edits)?;
        let first = breakdown.first_layer();
        let in_gaits: usize = first.gaits.iter().map(ExactSizeIterator::len).sum();
        let koma = breakdown.sheet.length().saturating_sub(in_gaits);
        let room =
            (MOST_GENGA * self.per_second * koma as f64 / breakdown.clock.koma_rate) as usize;
        let is_step = |drawing: &&Drawing| drawing.why.reason == Some(Reason::Step);
        let steps = layer(&breakdown).drawings.iter().filter(is_step).count();
        let too_many = between(&breakdown).saturating_sub(steps + room);
        Ok(too_many.min(key_count_search::count_found(self.engine, recipe, self.edits)?))
    }

    /// Reduces the found keys to a number that leaves room for inbetweens, by raising their price.
    fn thinned(&mut self, recipe: &Recipe) -> Result<Recipe, Error> {
        let mut thinned = recipe.clone();
        for _ in 0..MOST_THINNED {
            let too_many = self.too_many(&thinned)?;
            if too_many == 0 {
                break;
            }
            let found = key_count_search::count_found(self.engine, &thinned, self.edits)?;
            thinned =
                key_count_search::with_found(self.engine, recipe, self.edits, found - too_many)?;
        }
        Ok(thinned)
    }

    /// Reaches a count between two rungs of spacing: naka-nashi leaves fewer out of each action on the sparser one, and
    /// koma-dori takes the rest.
    fn spare(&mut self, from: Found) -> Result<Found, Error> {
        let mut recipe = from.recipe.clone();
        let mut best = from;
        for count in (0..MOST_SPARED).rev() {
            recipe.omission.naka_nashi = Amount::Count(count);
            let found = self.hold(&recipe)?;
            best = best.or(found);
            if best.is_exact() {
                break;
            }
        }
        Ok(best)
    }

    /// Reaches fewer drawings than all keys on threes give, by dropping keys on the first rung that suffices with the
    /// fewest keys. A denser rung would have too many drawings, as holds are bounded, unless still more keys go.
    fn fewer(&mut self, from: Found) -> Result<Found, Error> {
        let found = key_count_search::count_found(self.engine, &from.recipe, self.edits)?;
        let least = self.fewest_found(&from.recipe, found)?;
        let mut best = from.clone();
        let rungs = std::iter::successors(Some(from.recipe.spacing.clone()), sparser);
        for spacing in rungs {
            let sparse = Recipe { spacing, ..from.recipe.clone() };
            let fewest = self.hold_with(&sparse, least)?;
            let is_enough = fewest.excess <= EXACT;
            best = best.or(fewest);
            if is_enough {
                return self.with_most_keys(best, least..found + 1, &sparse);
            }
        }
        Ok(best)
    }

    /// Returns how many of the found keys must stay so that a quarter of the requested drawings are genga. A key that
    /// looks like the drawing on screen adds none.
    fn fewest_found(&mut self, recipe: &Recipe, found: usize) -> Result<usize, Error> {
        let breakdown = self.engine.run(recipe, self.edits)?;
        let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
        let wanted = (FEWEST_GENGA * self.per_second * seconds).ceil() as usize;
        let mut count = wanted.min(found);
        while count < found {
            let recipe = key_count_search::with_found(self.engine, recipe, self.edits, count)?;
            let drawn = between(&self.engine.run(&recipe, self.edits)?);
            if drawn >= wanted {
                break;
            }
            count += wanted - drawn;
        }
        Ok(count.min(found))
    }

    /// Finds the most keys within the range that still give few enough drawings.
    ///
    /// Fewer keys do not always give fewer drawings, as an inbetween may replace a key. So the bisection is a
    /// heuristic: the result was verified, but more keys might also suffice.
    fn with_most_keys(
        &mut self,
        mut best: Found,
        keys: Range<usize>,
        recipe: &Recipe,
    ) -> Result<Found, Error> {
        let Range { start: mut few_enough, end: mut too_many } = keys;
        while few_enough + 1 < too_many {
            let count = usize::midpoint(few_enough, too_many);
            let found = self.hold_with(recipe, count)?;
            if found.excess <= EXACT {
                few_enough = count;
                best = if found.is_exact() { found } else { best.or(found) };
            } else {
                too_many = count;
            }
        }
        Ok(best)
    }
}

fn with_koma_dori(recipe: &Recipe, count: usize) -> Recipe {
    let mut recipe = recipe.clone();
    recipe.omission.koma_dori = Amount::Count(count);
    if count > 0 {
        recipe.omission.small = ANY_MOVEMENT;
    }
    recipe
}

/// Rounds a setting to what a person would write.
fn rounded(value: f64) -> f64 {
    (100.0 * value).round() / 100.0
}
