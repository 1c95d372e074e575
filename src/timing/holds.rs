//! Holds (止め) that a person sets, after everything else was left out.

use std::cmp::Ordering;

use crate::edits::Hold;
use crate::sheet::{Drawing, Exposure, Layer};
use crate::time::Clock;
use crate::timing::on::STAY;

/// How near a drawing has to be to the frame of its hold, in koma.
const NEAR: f64 = 2.0;

/// The layer with the holds of a person: every one as [`Hold`] says.
///
/// `layer` shows each drawing once, in order, and its drawings are some of those of `spaced`, the layer before anything
/// was left out; so are those of the result, which is as long and has its kept drawings on the same koma.
pub fn with_holds(layer: &Layer, spaced: &Layer, holds: &[Hold], clock: Clock) -> Layer {
    if holds.is_empty() {
        return layer.clone();
    }
    let mut row = Row::of(layer, spaced);
    for hold in holds {
        if let Some(index) = row.nearest(hold.frame.0 as f64, clock) {
            row.drawings[index].asked = Some(hold.koma.max(1));
        }
    }
    // From the first on: what a hold takes from the next drawing, that one's own hold gets back.
    let mut index = 0;
    while index < row.drawings.len() {
        if let Some(koma) = row.drawings[index].asked {
            row.hold(index, koma);
        }
        index += 1;
    }
    row.into_layer(layer)
}

/// For how many koma the drawing of a person's hold stays on a layer that has been through [`with_holds`]; none where no
/// drawing is near the frame of the hold.
pub fn held_for(layer: &Layer, hold: Hold, clock: Clock) -> Option<usize> {
    let frame = hold.frame.0 as f64;
    let away = |shown: &Exposure| (layer.drawings[shown.drawing].source.place() - frame).abs();
    let is_set = |shown: &&Exposure| layer.drawings[shown.drawing].why.hold_set;
    let set = layer.exposures.iter().filter(is_set);
    let nearest = set.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    (away(nearest) < NEAR * clock.frames_in_koma()).then_some(nearest.koma)
}

/// A drawing on screen.
struct OnScreen {
    drawing: Drawing,
    koma: usize,
    /// For how many koma a person wants it.
    asked: Option<usize>,
}

/// The drawings of a layer in their order.
struct Row<'a> {
    drawings: Vec<OnScreen>,
    spaced: &'a Layer,
}

impl<'a> Row<'a> {
    fn of(layer: &Layer, spaced: &'a Layer) -> Self {
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

    /// The drawing nearest to a place; none where there is none near it.
    fn nearest(&self, place: f64, clock: Clock) -> Option<usize> {
        let away = |index: usize| (self.place(index) - place).abs();
        let nearest = (0..self.drawings.len()).min_by(|a, b| away(*a).total_cmp(&away(*b)))?;
        (away(nearest) < NEAR * clock.frames_in_koma()).then_some(nearest)
    }

    /// The next drawing that stays on its koma; the number of drawings at the end.
    fn next_kept(&self, index: usize) -> usize {
        let after = self.drawings.iter().skip(index + 1);
        let is_kept = |shown: &OnScreen| shown.drawing.role.is_kept();
        index + 1 + after.take_while(|shown| !is_kept(shown)).count()
    }

    /// Holds a drawing for so many koma.
    fn hold(&mut self, index: usize, koma: usize) {
        let why = &mut self.drawings[index].drawing.why;
        (why.hold_set, why.lengthened) = (true, 0);
        match koma.cmp(&self.drawings[index].koma) {
            Ordering::Greater => self.lengthen(index, koma),
            Ordering::Less => self.shorten(index, koma),
            Ordering::Equal => {}
        }
    }

    /// Takes koma from the inbetweens after it, as far as there are any.
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

    /// Covers the inbetween after a drawing with it.
    fn cover(&mut self, index: usize) -> usize {
        let OnScreen { koma, drawing, .. } = self.drawings.remove(index + 1);
        // What was left out round a covered drawing is under the hold too.
        self.drawings[index].drawing.why.held_for +=
            drawing.why.omitted_before + 1 + drawing.why.held_for;
        koma
    }

    /// Sees to it that the inbetween after a drawing stays for as long as drawings do there: by koma of those behind
    /// it that have more, else the next takes its place, and where there is none the hold lasts up to the genga.
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

    /// For how many koma drawings stay at the least between the two genga round a drawing: two, unless some were
    /// spaced for one there.
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

    /// Gives koma to a drawing that was left out after it, else to the next inbetween.
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

    /// Of the drawings that were left out after one the nearest in time to what its hold gives free, and which of
    /// them it is.
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

    /// Puts a drawing back behind another, and shares out what was said of those that were left out between.
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
        Layer { name: like.name.clone(), joints: like.joints.clone(), drawings, exposures }
    }
}

/// Places nearer than this, in frames, are one.
const SAME: f64 = 1e-6;

#[cfg(test)]
mod tests;
