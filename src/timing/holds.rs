//! A person's holds (止め), applied after all omission.

use std::cmp::Ordering;

use crate::edits::Hold;
use crate::sheet::{Drawing, Exposure, Layer};
use crate::time::Clock;
use crate::timing::koma_per_drawing::STAY;

/// How close a drawing must be to the frame of its hold, in koma.
const NEAR: f64 = 2.0;

/// Applies a person's holds to a layer, each as [`Hold`] says.
///
/// `layer` shows each drawing once, in order, and its drawings are a subset of those of `spaced`, the layer before
/// omission. The same holds for the result, which keeps the length and the koma of kept drawings.
pub fn with_holds(layer: &Layer, spaced: &Layer, holds: &[Hold], clock: Clock) -> Layer {
    if holds.is_empty() {
        return layer.clone();
    }
    let mut row = Row::new(layer, spaced);
    for hold in holds {
        if let Some(index) = row.nearest(hold.frame.0 as f64, clock) {
            row.drawings[index].asked = Some(hold.koma.max(1));
        }
    }
    // From the first on, so that what a hold takes from the next drawing is restored by that drawing's own hold.
    let mut index = 0;
    while index < row.drawings.len() {
        if let Some(koma) = row.drawings[index].asked {
            row.hold(index, koma);
        }
        index += 1;
    }
    row.into_layer(layer)
}

/// Returns how many koma the drawing of a hold stays on a layer that went through [`with_holds`]; `None` if no drawing
/// is close to the frame of the hold.
pub fn held_for(layer: &Layer, hold: Hold, clock: Clock) -> Option<usize> {
    held_drawing(layer, hold, clock).map(|shown| shown.koma)
}

/// Whether a hold is of a layer's last drawing.
pub fn is_of_last(layer: &Layer, hold: Hold, clock: Clock) -> bool {
    let held = held_drawing(layer, hold, clock);
    held.is_some() && held == layer.exposures.last()
}

/// Returns where the drawing of a hold stands, as [`held_for`] finds it.
fn held_drawing(layer: &Layer, hold: Hold, clock: Clock) -> Option<&Exposure> {
    let frame = hold.frame.0 as f64;
    let away = |shown: &Exposure| (layer.drawings[shown.drawing].source.place() - frame).abs();
    let is_set = |shown: &&Exposure| layer.drawings[shown.drawing].why.hold_set;
    let set = layer.exposures.iter().filter(is_set);
    let nearest = set.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    (away(nearest) < NEAR * clock.frames_in_koma()).then_some(nearest)
}

/// Number of koma by which a layer's last drawing stays shorter than a person asked, since the layer ends there.
pub fn owed_at_end(layer: &Layer, holds: &[Hold], clock: Clock) -> usize {
    let Some(last) = layer.exposures.last() else { return 0 };
    let of_last = holds.iter().filter(|hold| is_of_last(layer, **hold, clock));
    of_last.map(|hold| hold.koma.saturating_sub(last.koma)).max().unwrap_or(0)
}

/// A drawing with its exposure.
struct OnScreen {
    drawing: Drawing,
    koma: usize,
    /// The number of koma that a person wants.
    asked: Option<usize>,
}

/// The drawings of a layer in order.
struct Row<'a> {
    drawings: Vec<OnScreen>,
    spaced: &'a Layer,
}

impl<'a> Row<'a> {
    fn new(layer: &Layer, spaced: &'a Layer) -> Self {
        let on_screen = |shown: &Exposure| OnScreen {
            drawing: layer.drawings[shown.drawing].clone(),
            koma: shown.koma,
            asked: None,
        };
        Self { drawings: layer.exposures.iter().map(on_screen).collect(), spaced }
    }

    fn place(&self, index: usize) -> f64 {
        self.drawings[index].drawing.source.place()
    }

    /// Returns the drawing nearest to a place; `None` if none is close.
    fn nearest(&self, place: f64, clock: Clock) -> Option<usize> {
        let away = |index: usize| (self.place(index) - place).abs();
        let nearest = (0..self.drawings.len()).min_by(|a, b| away(*a).total_cmp(&away(*b)))?;
        (away(nearest) < NEAR * clock.frames_in_koma()).then_some(nearest)
    }

    /// Returns the next drawing that stays on its koma; the number of drawings if there is none.
    fn next_kept(&self, index: usize) -> usize {
        let after = self.drawings.iter().skip(index + 1);
        let is_kept = |shown: &OnScreen| shown.drawing.role.is_kept();
        index + 1 + after.take_while(|shown| !is_kept(shown)).count()
    }

    /// Holds a drawing for `koma` koma.
    fn hold(&mut self, index: usize, koma: usize) {
        let why = &mut self.drawings[index].drawing.why;
        (why.hold_set, why.lengthened) = (true, 0);
        match koma.cmp(&self.drawings[index].koma) {
            Ordering::Greater => self.lengthen(index, koma),
            Ordering::Less => self.shorten(index, koma),
            Ordering::Equal => {}
        }
    }

    /// Takes koma from the inbetweens after the drawing, as far as there are any.
    fn lengthen(&mut self, index: usize, koma: usize) {
        let mut missing = koma - self.drawings[index].koma;
        while missing > 0 && self.next_kept(index) > index + 1 {
            let next = &mut self.drawings[index + 1];
            let taken = missing.min(next.koma);
            next.koma -= taken;
            missing -= taken;
            self.drawings[index].koma += taken;
            if self.drawings[index + 1].koma == 0 {
                self.cover(index);
            }
        }
        if self.next_kept(index) > index + 1 && self.drawings[index + 1].asked.is_none() {
            self.let_stay(index);
        }
    }

    /// Replaces the inbetween after a drawing by a longer hold.
    fn cover(&mut self, index: usize) -> usize {
        let OnScreen { koma, drawing, .. } = self.drawings.remove(index + 1);
        // Drawings left out around a covered drawing are now under the hold as well.
        self.drawings[index].drawing.why.held_for +=
            drawing.why.omitted_before + 1 + drawing.why.held_for;
        koma
    }

    /// Makes the inbetween after a drawing stay as long as drawings do there. It takes koma from longer inbetweens
    /// behind it; failing that, the next one takes its place, and if there is none, the hold lasts up to the genga.
    fn let_stay(&mut self, index: usize) {
        let least = self.least(index);
        for behind in index + 2..self.next_kept(index) {
            let missing = least.saturating_sub(self.drawings[index + 1].koma);
            let given = missing.min(self.drawings[behind].koma.saturating_sub(least));
            self.drawings[behind].koma -= given;
            self.drawings[index + 1].koma += given;
        }
        if self.drawings[index + 1].koma < least {
            let heir = index + usize::from(self.next_kept(index) > index + 2);
            let koma = self.cover(index);
            self.drawings[heir].koma += koma;
        }
    }

    /// Returns the fewest koma that drawings stay between the two genga around a drawing: two, unless some were spaced
    /// for one there.
    fn least(&self, index: usize) -> usize {
        let is_kept = |shown: &&OnScreen| shown.drawing.role.is_kept();
        let opener = self.drawings[..=index].iter().rev().find(is_kept);
        let from = opener.map_or(f64::NEG_INFINITY, |opener| opener.drawing.source.place());
        let place = |shown: &Exposure| self.spaced.drawings[shown.drawing].source.place();
        let role = |shown: &Exposure| self.spaced.drawings[shown.drawing].role;
        let after = self.spaced.exposures.iter().skip_while(|shown| place(shown) < from);
        let own = after.clone().take(1);
        let inbetweens = after.skip(1).take_while(|shown| !role(shown).is_kept());
        own.chain(inbetweens).map(|shown| shown.koma).min().unwrap_or(1).min(STAY)
    }

    /// Gives the freed koma to a drawing that was left out after this one, or else to the next inbetween.
    fn shorten(&mut self, index: usize, koma: usize) {
        let freed = self.drawings[index].koma - koma;
        let left_out = self.left_out(index, koma).filter(|_| freed >= self.least(index));
        if let Some((at, drawing)) = left_out {
            self.come_back(index, at, OnScreen { drawing, koma: freed, asked: None });
        } else if self.next_kept(index) > index + 1 {
            self.drawings[index + 1].koma += freed;
        } else {
            return;
        }
        self.drawings[index].koma = koma;
    }

    /// Finds, among the drawings left out after one, the one nearest in time to the freed koma, and its number among
    /// them.
    fn left_out(&self, index: usize, koma: usize) -> Option<(usize, Drawing)> {
        let begin: usize = self.drawings[..index].iter().map(|shown| shown.koma).sum();
        let (from, to) =
            (self.place(index), self.drawings.get(index + 1).map(|_| self.place(index + 1))?);
        let between = self.spaced.timed().filter(|(_, shown)| {
            let place = self.spaced.drawings[shown.drawing].source.place();
            from + SAME < place && place < to - SAME
        });
        let nearest = between.enumerate().min_by_key(|(_, (own, _))| own.abs_diff(begin + koma));
        nearest.map(|(at, (_, shown))| (at, self.spaced.drawings[shown.drawing].clone()))
    }

    /// Puts a drawing back behind another, and splits the counts of omitted drawings between them.
    fn come_back(&mut self, index: usize, at: usize, mut back: OnScreen) {
        let held = self.drawings[index].drawing.why.held_for;
        let all = held + self.drawings[index + 1].drawing.why.omitted_before;
        let after = all.saturating_sub(at + 1);
        let held_after = held.saturating_sub(at + 1);
        self.drawings[index].drawing.why.held_for = held.min(at);
        back.drawing.why.omitted_before = at.saturating_sub(held);
        back.drawing.why.held_for = held_after;
        self.drawings[index + 1].drawing.why.omitted_before = after - held_after;
        self.drawings.insert(index + 1, back);
    }

    fn into_layer(self, like: &Layer) -> Layer {
        let koma = self.drawings.iter().map(|shown| shown.koma);
        let exposures =
            koma.enumerate().map(|(drawing, koma)| Exposure { drawing, koma }).collect();
        let drawings = self.drawings.into_iter().map(|shown| shown.drawing).collect();
        Layer {
            name: like.name.clone(),
            joints: like.joints.clone(),
            drawings,
            exposures,
            gone: vec![],
        }
    }
}

/// Places closer than this, in frames, are equal.
const SAME: f64 = 1e-6;

#[cfg(test)]
mod tests;
