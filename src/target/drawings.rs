//! A number of drawings a second: koma-dori gives single ones, and the other settings of the sheet where
//! its range ends.

use std::ops::Range;

use super::ladder::{denser, sparser, sparser_to_threes};
use super::{Outcome, Target, between, layer, room};
use crate::edits::Edits;
use crate::error::Error;
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::sheet::{Drawing, Reason};
use crate::timing::{Amount, On, Spacing};

/// Nearer than this no whole number of drawings comes.
const EXACT: f64 = 0.5 + 1e-9;

/// Further off than this, a person is told.
const NEAR: f64 = 1.0 + 1e-9;

/// Corrections of the count of koma-dori. One is enough where naka-nashi goes first.
const MOST_CORRECTIONS: usize = 16;

/// What naka-nashi may leave out of an action by a share; fewer are tried where it has to give way.
const MOST_SPARED: usize = 6;

/// Of the drawings that are asked for so many are genga at the most, where keys may go: two thirds. With more there are
/// no inbetweens left to take away, and the slow ones are held too long for the fast.
const MOST_GENGA: f64 = 2.0 / 3.0;

/// Of the drawings that are asked for at least so many stay found genga, where there are as many: a quarter. Rather
/// the spacing gives way: a denser one would leave the sheet without the genga of the method.
const FEWEST_GENGA: f64 = 0.25;

/// How often the number of found keys is corrected for it.
const MOST_THINNED: usize = 16;

/// How far the body may go while a drawing of a range stays, at the most, in % of its height: all are as slow as it lets them.
const LONGEST_STEP: f64 = 100.0;

/// Halvings of the span up to there: two steps that are nearer to each other part nothing.
const STEPS: usize = 10;

/// A movement that is small whatever it is, in % of body height: a number of drawings is a person's wish.
const ANY_MOVEMENT: f64 = 1000.0;

/// So many drawings a second.
pub(super) struct Goal {
    pub(super) per_second: f64,
    /// Whether keys may go for it.
    pub(super) keys_are_free: bool,
}

/// Settings, and by how many drawings their sheet has too many.
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
    /// Settings whose sheet has so many drawings a second, or as near as it gets.
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
        // On another rung of spacing other keys have room, and there may be too many of them again.
        for _ in 0..MOST_THINNED {
            if !self.keys_are_free || search.too_many(&found.recipe)? == 0 {
                break;
            }
            found = self.search(&mut search, &found.recipe.clone())?;
        }
        let target = Target::DrawingsPerSecond(self.per_second);
        let breakdown = search.engine.run(&found.recipe, edits)?;
        let (drawings, genga) = (layer(&breakdown).shown().count(), layer(&breakdown).genga());
        let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
        let shortfall = if found.excess.abs() <= NEAR {
            None
        } else if found.excess > 0.0 && !self.keys_are_free {
            Some(format!(
                "{genga} genga are wanted, and every drawing between them that could go is gone"
            ))
        } else if found.excess > 0.0 {
            Some(format!("{drawings} drawings are left: ends, pins and ends of rests stay"))
        } else {
            Some("no other settings of koma-dori, spacing.on and naka-nashi come nearer".into())
        };
        Ok((found.recipe, Outcome { target, reached: drawings as f64 / seconds, shortfall }))
    }

    /// The settings nearest to the recipe; a fixed number of inbetweens gives way where no number does.
    fn search(&self, search: &mut Search<'_>, recipe: &Recipe) -> Result<Found, Error> {
        let found = self.descend(search, recipe)?;
        if found.excess.abs() <= NEAR || recipe.spacing.inbetweens.is_none() {
            return Ok(found);
        }
        let mut free = recipe.clone();
        free.spacing.inbetweens = None;
        Ok(found.or(self.descend(search, &free)?))
    }

    /// No more keys than leave room for inbetweens first; then koma-dori; then the spacing, and the koma-dori for
    /// it; then naka-nashi, or keys.
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

    /// The nearer of two, of equals this one.
    fn or(self, other: Self) -> Self {
        if other.excess.abs() < self.excess.abs() { other } else { self }
    }
}

impl Search<'_> {
    /// By how many drawings a recipe gives too many, and how many koma-dori took.
    fn look(&mut self, recipe: &Recipe) -> Result<(Found, usize), Error> {
        let breakdown = self.engine.run(recipe, self.edits)?;
        let drawings = layer(&breakdown).shown().count() as f64;
        let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
        let excess = drawings - self.per_second * seconds;
        let done = breakdown.first_layer().omission.koma_dori.done;
        Ok((Found { recipe: recipe.clone(), excess }, done))
    }

    /// The count of koma-dori with which a recipe comes nearest.
    ///
    /// Koma-dori goes drawing by drawing, and another count takes more or fewer steps on the same way. So
    /// where naka-nashi has gone before, a drawing more is a drawing less on the sheet, and the first
    /// correction is right or as far as it goes. Where naka-nashi comes after it may take other drawings
    /// then; the corrections go on, and the nearest is kept.
    fn hold(&mut self, recipe: &Recipe) -> Result<Found, Error> {
        let mut count = 0;
        let mut best: Option<Found> = None;
        for _ in 0..MOST_CORRECTIONS {
            let (found, done) = self.look(&with_koma_dori(recipe, count))?;
            let excess = found.excess;
            // What could not be done is not asked for either.
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

    /// The same with so many found keys.
    fn hold_with(&mut self, recipe: &Recipe, count: usize) -> Result<Found, Error> {
        let recipe = room::with_found(self.engine, recipe, self.edits, count)?;
        self.hold(&recipe)
    }

    /// Rung after rung of spacing until there are too few drawings, or too many where there were too few; the nearest of
    /// all. Where that lies between two rungs, naka-nashi leaves fewer out on the one that has too few.
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

    /// On a rung of a range that has too many drawings each stays longer: the body may go further meanwhile.
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

    /// More drawings than there are with no koma-dori: denser spacing, and then no naka-nashi.
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
        // Only rests are left in which there could be more.
        recipe.spacing.drift = 0.0;
        let moving = self.hold(&recipe)?;
        if moving.excess >= -EXACT {
            return Ok(dense.or(whole).or(moving));
        }
        // A range of koma may have been dense enough while rests were held.
        recipe.spacing.on = On::every(1);
        let on_ones = self.hold(&recipe)?;
        Ok(dense.or(whole).or(moving).or(on_ones))
    }

    /// By how many genga a recipe has more than leave room for inbetweens among so many drawings, gaits apart; none where
    /// all that could go are gone.
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
        Ok(too_many.min(room::found(self.engine, recipe, self.edits)?))
    }

    /// A recipe with no more found keys than leave room for inbetweens: their price rises until so few are worth it.
    fn thinned(&mut self, recipe: &Recipe) -> Result<Recipe, Error> {
        let mut thinned = recipe.clone();
        for _ in 0..MOST_THINNED {
            let too_many = self.too_many(&thinned)?;
            if too_many == 0 {
                break;
            }
            let found = room::found(self.engine, &thinned, self.edits)?;
            thinned = room::with_found(self.engine, recipe, self.edits, found - too_many)?;
        }
        Ok(thinned)
    }

    /// Between two rungs of spacing: on the sparser one naka-nashi leaves fewer out of each action, and
    /// koma-dori takes what is too much then.
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

    /// Fewer drawings than there are with all keys on threes: fewer keys, on the first rung on which there
    /// are few enough drawings with the fewest keys. A hold has its bound, so on a denser one there are
    /// too many, unless still more keys go.
    fn fewer(&mut self, from: Found) -> Result<Found, Error> {
        let found = room::found(self.engine, &from.recipe, self.edits)?;
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

    /// Of so many found keys how many stay at least, so that a quarter of the drawings that are asked for are genga: one
    /// that is like the drawing on screen is none.
    fn fewest_found(&mut self, recipe: &Recipe, found: usize) -> Result<usize, Error> {
        let breakdown = self.engine.run(recipe, self.edits)?;
        let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
        let wanted = (FEWEST_GENGA * self.per_second * seconds).ceil() as usize;
        let mut count = wanted.min(found);
        while count < found {
            let recipe = room::with_found(self.engine, recipe, self.edits, count)?;
            let drawn = between(&self.engine.run(&recipe, self.edits)?);
            if drawn >= wanted {
                break;
            }
            count += wanted - drawn;
        }
        Ok(count.min(found))
    }

    /// The most keys with which there are few enough drawings: from the start of the span on, fewer than its end.
    ///
    /// Fewer keys are not always fewer drawings, since inbetweens come where a key was. So the bisection is
    /// a search and no proof: what it gives was looked at, that no more keys would do is not certain.
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

/// A setting as a person would write it.
fn rounded(value: f64) -> f64 {
    (100.0 * value).round() / 100.0
}
