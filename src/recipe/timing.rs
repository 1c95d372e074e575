//! The timing of one layer along the sheet, from the settings of recipe, layer and passages.

use std::ops::Range;

use super::scopes::PRICE;
use super::{Outside, Recipe};
use crate::time::{Clock, Frame};
use crate::timing::{Amount, ByPassage, Omission, On, Spacing};

/// The settings by which a layer is timed, koma by koma.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerTiming {
    /// Spacing.
    pub spacing: ByPassage<Spacing>,
    /// Omission.
    pub omission: ByPassage<Omission>,
    /// Whether a koma is timed. All others show the source as it is.
    pub timed: ByPassage<bool>,
}

impl Recipe {
    /// Returns the recipe of a layer: its own settings over those of all, with the prices of its passages.
    #[must_use]
    pub fn of_layer(&self, name: &str) -> Self {
        let mut own = self.without_scopes();
        if let Some(settings) = self.scopes.layers.get(name) {
            settings.lay_over(&mut own);
        }
        let priced = self.scopes.passages_of(name).filter(|passage| passage.settings.has(PRICE));
        own.keys.prices_within = priced.map(|passage| passage.price(&own)).collect();
        own
    }

    /// Returns the timing of a layer on a sheet of `length` koma; `last` is the clip's last frame.
    pub fn timing_of(
        &self,
        layer: &str,
        (clock, last): (Clock, Frame),
        length: usize,
    ) -> LayerTiming {
        let usual = self.of_layer(layer);
        let passages: Vec<_> = self.scopes.passages_of(layer).collect();
        let koma: Vec<Range<usize>> =
            passages.iter().map(|own| own.frames.on_sheet(clock, last, length)).collect();
        let has = |at: usize| koma.iter().map(move |koma| koma.contains(&at));
        let is_timed =
            |at: usize| self.scopes.outside == Outside::Timed || has(at).any(|is_within| is_within);
        let settings = |at: usize| {
            let mut own = usual.clone();
            let within = passages.iter().zip(has(at)).filter(|(_, is_within)| *is_within);
            within.for_each(|(passage, _)| passage.settings.lay_over(&mut own));
            if !is_timed(at) {
                let (naka_nashi, koma_dori) = (Amount::Count(0), Amount::Count(0));
                own.spacing = Spacing { on: On::every(1), inbetweens: None, ..own.spacing };
                own.omission = Omission { naka_nashi, koma_dori, ..own.omission };
            }
            own
        };
        LayerTiming {
            spacing: ByPassage::new(&koma, |at| settings(at).spacing),
            omission: ByPassage::new(&koma, |at| settings(at).omission),
            timed: ByPassage::new(&koma, is_timed),
        }
    }
}
