//! Numbers that stay (番号の引き継ぎ): a new sheet of a cut keeps the numbers of the drawings that it shares with the sheet
//! before.

use super::{Gone, Layer, Number, Numbers, Sheet};

/// A drawing of the sheet before, of the new sheet, or of both.
#[derive(Debug, Clone, PartialEq)]
pub struct Renumbered {
    /// The name of its layer.
    pub layer: String,
    /// Its place in the source, a fractional frame: in the new sheet, if it is there.
    pub place: f64,
    /// Its numbers in the sheet before; the default if it was not there.
    pub old: Numbers,
    /// Its numbers in the new sheet; the default if it is not there.
    pub new: Numbers,
}

/// A drawing of a layer, of any sheet of the cut so far.
#[derive(Debug, Clone, Default)]
struct Entry {
    numbers: Numbers,
    place: f64,
    /// Index in the layer of the sheet before; `None` if it was not there.
    before: Option<usize>,
    /// Index in the layer of the new sheet; `None` if it is not there.
    now: Option<usize>,
}

impl Sheet {
    /// Numbers the drawings like those of an earlier sheet of the same motion. A drawing that both share keeps its
    /// numbers. A new one gets a number between its neighbours (3a), or behind the last the next whole one. The numbers of
    /// drawings that went stay free, in [`Layer::gone`], until the drawing is back.
    ///
    /// A drawing is shared with the one nearest to it in the layer of the same name and joints, if that shows the source
    /// less than half a koma earlier or later. Other layers are numbered 1, 2, 3 ….
    pub fn keep_numbers(&mut self, before: &Self) {
        let reach = self.reach();
        for layer in &mut self.layers {
            layer.number_plainly();
            let Some(old) = before.layer_like(layer) else { continue };
            let mut row = row(known(old), layer, reach);
            number(&mut row, layer);
            give(row, layer);
        }
    }

    /// Compares the numbers of an earlier sheet of the same motion with those of this one: every drawing that either has,
    /// layer by layer and in order.
    pub fn compare_numbers(&self, before: &Self) -> Vec<Renumbered> {
        let mut all = Vec::new();
        for layer in &self.layers {
            let Some(old) = before.layer_like(layer) else { continue };
            let row = row(known(old), layer, self.reach());
            let (old, new) = (shown_numbers(old), shown_numbers(layer));
            let of = |numbers: &[Numbers], at: Option<usize>| {
                at.map(|at| numbers[at].clone()).unwrap_or_default()
            };
            let seen = row.iter().filter(|entry| entry.before.is_some() || entry.now.is_some());
            all.extend(seen.map(|entry| Renumbered {
                layer: layer.name.clone(),
                place: entry.now.map_or(entry.place, |now| layer.drawings[now].source.place()),
                old: of(&old, entry.before),
                new: of(&new, entry.now),
            }));
        }
        all
    }

    /// Distance in source frames within which two sheets may share a drawing.
    fn reach(&self) -> f64 {
        0.5 * self.clock.frames_in_koma()
    }
}

/// Returns both numbers of each drawing, as the sheet shows them.
fn shown_numbers(layer: &Layer) -> Vec<Numbers> {
    let both = layer.numbers().into_iter().zip(layer.genga_numbers());
    both.map(|(drawing, genga)| Numbers { drawing: Some(drawing), genga }).collect()
}

/// Returns the drawings of a layer and those that went before, by number.
fn known(layer: &Layer) -> Vec<Entry> {
    let shown = layer.drawings.iter().zip(shown_numbers(layer)).enumerate();
    let shown = shown.map(|(at, (drawing, numbers))| {
        let genga = numbers.genga.or_else(|| drawing.numbers.genga.clone());
        let numbers = Numbers { genga, ..numbers };
        Entry { numbers, place: drawing.source.place(), before: Some(at), now: None }
    });
    let gone = layer.gone.iter().map(|gone| {
        let numbers = Numbers { drawing: Some(gone.drawing.clone()), genga: gone.genga.clone() };
        Entry { numbers, place: gone.place, before: None, now: None }
    });
    let mut known: Vec<Entry> = shown.chain(gone).collect();
    known.sort_by(|a, b| a.numbers.drawing.cmp(&b.numbers.drawing));
    // A number that a person gave again is that of the drawing.
    known.dedup_by(|later, first| later.numbers.drawing == first.numbers.drawing);
    known
}

/// Puts the drawings of a layer in order among those that are known.
fn row(known: Vec<Entry>, layer: &Layer, reach: f64) -> Vec<Entry> {
    let shared = shared(&known, layer, reach);
    // The known drawing that the next shared one is, for each drawing.
    let mut bounds = vec![known.len(); shared.len() + 1];
    for (at, own) in shared.iter().enumerate().rev() {
        bounds[at] = own.unwrap_or(bounds[at + 1]);
    }
    let mut row = Vec::with_capacity(known.len() + shared.len());
    let mut known = known.into_iter().enumerate().peekable();
    for (now, (drawing, own)) in layer.drawings.iter().zip(&shared).enumerate() {
        let (place, bound) = (drawing.source.place(), bounds[now]);
        let goes_before =
            |(at, entry): &(usize, Entry)| *at < bound && (own.is_some() || entry.place < place);
        while let Some((_, entry)) = known.next_if(goes_before) {
            row.push(entry);
        }
        let entry = match own {
            Some(_) => known.next().map(|(_, entry)| entry).unwrap_or_default(),
            None => Entry::default(),
        };
        row.push(Entry { place, now: Some(now), ..entry });
    }
    row.extend(known.map(|(_, entry)| entry));
    row
}

/// Finds the known drawing that each drawing of a layer is: each is the nearest to the other, and their order is the
/// same.
fn shared(known: &[Entry], layer: &Layer, reach: f64) -> Vec<Option<usize>> {
    let mut by_place: Vec<usize> = (0..known.len()).collect();
    by_place.sort_by(|a, b| known[*a].place.total_cmp(&known[*b].place));
    let away = |at: usize, place: f64| (known[at].place - place).abs();
    let nearest = |place: f64| {
        let after = by_place.partition_point(|at| known[*at].place < place);
        let round = &by_place[after.saturating_sub(1)..by_place.len().min(after + 1)];
        let nearest =
            round.iter().copied().min_by(|a, b| away(*a, place).total_cmp(&away(*b, place)));
        nearest.filter(|at| away(*at, place) < reach)
    };
    let places: Vec<f64> = layer.drawings.iter().map(|drawing| drawing.source.place()).collect();
    let mut shared: Vec<Option<usize>> = places.iter().map(|place| nearest(*place)).collect();
    let mut nearest: Vec<Option<usize>> = vec![None; known.len()];
    for now in 0..places.len() {
        let Some(at) = shared[now] else { continue };
        let other = nearest[at].replace(now);
        let Some(other) = other else { continue };
        if away(at, places[other]) <= away(at, places[now]) {
            (shared[now], nearest[at]) = (None, Some(other));
        } else {
            shared[other] = None;
        }
    }
    ascending(&shared)
}

/// Keeps the most of some values that ascend. Drawings of a loop that begins elsewhere than before do not all ascend.
fn ascending(values: &[Option<usize>]) -> Vec<Option<usize>> {
    let mut ends: Vec<usize> = Vec::new();
    let mut before: Vec<Option<usize>> = vec![None; values.len()];
    for (at, value) in values.iter().enumerate().filter(|(_, value)| value.is_some()) {
        let length = ends.partition_point(|end| values[*end] < *value);
        before[at] = length.checked_sub(1).map(|shorter| ends[shorter]);
        match ends.get_mut(length) {
            Some(end) => *end = at,
            None => ends.push(at),
        }
    }
    let mut kept = vec![None; values.len()];
    let mut last = ends.last().copied();
    while let Some(at) = last {
        kept[at] = values[at];
        last = before[at];
    }
    kept
}

/// Gives numbers to the drawings of a row that have none: all drawings one among the drawings, and genga one among the
/// genga.
fn number(row: &mut [Entry], layer: &Layer) {
    let is_kept = |entry: &Entry| entry.now.is_some_and(|now| layer.drawings[now].role.is_kept());
    fill(row, |entry| &mut entry.numbers.drawing, |_| true);
    fill(row, |entry| &mut entry.numbers.genga, is_kept);
}

/// Gives numbers of a series to the wanted entries that have none, each between those around it.
fn fill(
    row: &mut [Entry],
    of: impl Fn(&mut Entry) -> &mut Option<Number>,
    is_wanted: impl Fn(&Entry) -> bool,
) {
    let mut after = None;
    let nexts: Vec<Option<Number>> = row
        .iter_mut()
        .rev()
        .map(|entry| {
            let next = after.clone();
            if of(entry).is_some() {
                after.clone_from(of(entry));
            }
            next
        })
        .collect();
    let mut before: Option<Number> = None;
    for (entry, next) in row.iter_mut().zip(nexts.into_iter().rev()) {
        if of(entry).is_none() && is_wanted(entry) {
            *of(entry) = Some(Number::between(before.as_ref(), next.as_ref()));
        }
        before = of(entry).clone().or(before);
    }
}

/// Gives the numbers of a row to the drawings of its layer, which has none yet, and keeps those that are not there. If
/// the numbers are the places of the drawings anyway, none is given.
fn give(row: Vec<Entry>, layer: &mut Layer) {
    let plain = shown_numbers(layer);
    for Entry { numbers, place, now, .. } in row {
        match (now, numbers) {
            (Some(now), numbers) => layer.drawings[now].numbers = numbers,
            (None, Numbers { drawing: Some(drawing), genga }) => {
                layer.gone.push(Gone { drawing, genga, place });
            }
            (None, Numbers { drawing: None, .. }) => {}
        }
    }
    if layer.gone.is_empty() && layer.drawings.iter().map(|drawing| &drawing.numbers).eq(&plain) {
        layer.number_plainly();
    }
}

#[cfg(test)]
mod tests;
