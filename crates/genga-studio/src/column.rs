//! A column of the sheet (セル), with lookups by koma.

use std::ops::Deref;

use genga::edits::{Edits, Forbidden, Hold};
use genga::keys::Key;
use genga::pipeline::{Breakdown, LayerBreakdown};
use genga::recipe::Recipe;
use genga::sheet::{Layer, Source};
use genga::time::{Clock, Frame};
use genga::timing::{ByPassage, Spacing};
use genga_plot::parts;

/// A drawing as exposed on the sheet, with its key.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeyedCell<'a> {
    on_paper: parts::ShownDrawing<'a>,
    /// The key that it draws. `None` for inbetweens and ends.
    pub(super) key: Option<&'a Key>,
}

impl KeyedCell<'_> {
    /// The source frame that identifies its hold: that of the hold set by hand, else the one it shows.
    pub(super) fn hold_frame(&self, edits: &Edits) -> Frame {
        let place = self.drawing.source.place();
        let away = |hold: &&Hold| (hold.frame.0 as f64 - place).abs();
        let holds = edits.holds.iter().filter(|_| self.drawing.why.hold_set);
        let own = holds.min_by(|a, b| away(a).total_cmp(&away(b)));
        own.map_or(Frame(place.round().max(0.0) as usize), |hold| hold.frame)
    }
}

impl<'a> Deref for KeyedCell<'a> {
    type Target = parts::ShownDrawing<'a>;

    fn deref(&self) -> &parts::ShownDrawing<'a> {
        &self.on_paper
    }
}

/// A column of a sheet, as a list of exposures.
#[derive(Debug, Clone)]
pub(super) struct Column<'a> {
    pub(super) name: &'a str,
    pub(super) cells: Vec<KeyedCell<'a>>,
    pub(super) clock: Clock,
    /// Length in koma.
    pub(super) length: usize,
    /// The column on the sheet; `spaced` is the column before anything was left out.
    pub(super) layer: &'a Layer,
    pub(super) spaced: &'a Layer,
    /// Intermediate results of the column.
    pub(super) found: LayerBreakdown<'a>,
}

impl<'a> Column<'a> {
    /// Returns every column of a sheet.
    pub(super) fn all(breakdown: &Breakdown<'a>) -> Vec<Self> {
        let layers = breakdown.sheet.layers.iter().zip(&breakdown.spaced.layers);
        let found = layers.zip(breakdown.layers());
        found.map(|(sheets, found)| Self::new(sheets, found, breakdown.clock)).collect()
    }

    fn new(
        (layer, spaced): (&'a Layer, &'a Layer),
        found: LayerBreakdown<'a>,
        clock: Clock,
    ) -> Self {
        let with_key = |on_paper: parts::ShownDrawing<'a>| {
            let key = key_at(&found.keys.keys, on_paper.drawing.source);
            KeyedCell { on_paper, key }
        };
        let cells = parts::shown_drawings(layer).into_iter().map(with_key).collect();
        Self { name: &layer.name, cells, clock, length: layer.length(), layer, spaced, found }
    }

    /// The keys that were found or set by hand.
    pub(super) fn keys(&self) -> &'a [Key] {
        &self.found.keys.keys
    }

    /// The frames at which no key may be found once one is taken away: those between its neighbours.
    pub(super) fn place_of(&self, key: &Key) -> Forbidden {
        let others = self.keys().iter().map(|other| other.frame);
        let others = others.filter(|other| *other != key.frame);
        Forbidden::instead_of(key.unmoved(), others, &self.clock, self.length)
    }

    /// The spacing of the column along the sheet; `last` is the clip's last frame.
    pub(super) fn spacing(&self, recipe: &Recipe, last: Frame) -> ByPassage<Spacing> {
        recipe.timing_of(self.name, (self.clock, last), self.spaced.length()).spacing
    }

    /// The spacing weight of a key without one of its own.
    pub(super) fn usual_weight(&self, key: &Key, recipe: &Recipe, last: Frame) -> f64 {
        self.spacing(recipe, last).at(self.clock.koma_from_frame(key.frame)).weight
    }

    /// Index of the exposure on screen at a koma.
    pub(super) fn at(&self, koma: usize) -> usize {
        self.cells.partition_point(|cell| cell.koma <= koma).saturating_sub(1)
    }

    /// The exposure on screen at a koma.
    pub(super) fn cell(&self, koma: usize) -> &KeyedCell<'a> {
        &self.cells[self.at(koma)]
    }

    /// Returns the koma on which an exposure begins that is `by` exposures from `koma`, counting only `wanted` ones.
    pub(super) fn step(
        &self,
        koma: usize,
        by: isize,
        wanted: impl Fn(&KeyedCell<'_>) -> bool,
    ) -> usize {
        let begins = self.cells.iter().filter(|cell| wanted(cell)).map(|cell| cell.koma);
        let mut after: Vec<usize> = if by > 0 {
            begins.filter(|begin| *begin > koma).collect()
        } else {
            begins.filter(|begin| *begin < koma).collect()
        };
        if by < 0 {
            after.reverse();
        }
        let last = after.last().copied().unwrap_or(koma);
        after.get(by.unsigned_abs() - 1).copied().unwrap_or(last)
    }

    /// The key meant at a koma: the one whose frame falls on it, else the one whose drawing is shown.
    pub(super) fn key(&self, koma: usize) -> Option<&'a Key> {
        let cell = self.cell(koma);
        let stands_here = |cell: &&KeyedCell<'a>| {
            cell.key.is_some_and(|key| self.clock.koma_from_frame(key.frame) == koma)
        };
        self.cells.iter().find(stands_here).and_then(|cell| cell.key).or(cell.key)
    }

    /// The exposure of the key at a frame.
    pub(super) fn cell_of(&self, frame: Frame) -> Option<&KeyedCell<'a>> {
        self.cells.iter().find(|cell| cell.key.is_some_and(|key| key.frame == frame))
    }

    /// The koma on which the drawing of the key at a frame begins. Without a key, the koma nearest to the frame.
    pub(super) fn koma_of(&self, frame: Frame) -> usize {
        self.cell_of(frame).map_or_else(|| self.clock.koma_from_frame(frame), |cell| cell.koma)
    }

    /// The koma at which the drawing of a place began before anything was left out.
    pub(super) fn spaced_koma(&self, place: f64) -> Option<usize> {
        let is_it = |drawing: usize| self.spaced.drawings[drawing].source.place() == place;
        self.spaced.timed().find(|(_, shown)| is_it(shown.drawing)).map(|(koma, _)| koma)
    }
}

/// The key that a drawing shows.
fn key_at(keys: &[Key], source: Source) -> Option<&Key> {
    let Source::At(place) = source else { return None };
    let at = keys.binary_search_by(|key| (key.frame.0 as f64).total_cmp(&place)).ok()?;
    keys.get(at)
}
