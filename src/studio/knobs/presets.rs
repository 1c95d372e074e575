//! Presets (プリセット): a few knobs at once, on top of the others.

/// Knobs that together have a name.
#[derive(Debug, Clone, Copy)]
pub(in crate::studio) struct Preset {
    pub(in crate::studio) english: &'static str,
    pub(in crate::studio) japanese: &'static str,
    /// Knobs and their values.
    pub(in crate::studio) settings: &'static [(&'static str, &'static str)],
}

const fn preset(
    english: &'static str,
    japanese: &'static str,
    settings: &'static [(&'static str, &'static str)],
) -> Preset {
    Preset { english, japanese, settings }
}

/// All of them.
pub(in crate::studio) const PRESETS: &[Preset] = &[
    preset("On twos", "2コマ打ち", &[("spacing.on", "2")]),
    preset("On threes", "3コマ打ち", &[("spacing.on", "3")]),
    preset("Ones to threes", "1〜3コマ打ち", &[("spacing.on", "1-3")]),
    preset("Twos and threes", "2〜3コマ打ち", &[("spacing.on", "2-3")]),
    preset("Snappy", "メリハリ", &[("spacing.weight", "0.5"), ("omission.naka_nashi", "4%")]),
    preset("Soft", "なめらか", &[("spacing.weight", "0.1"), ("omission.naka_nashi", "0")]),
    preset("Few genga", "原画少なめ", &[("keys.min_price", "12")]),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::Recipe;

    #[test]
    fn every_preset_sets_knobs_there_are_and_reads_back_as_chosen() {
        for preset in PRESETS {
            let mut recipe = Recipe::default();
            for (knob, value) in preset.settings {
                recipe
                    .set(knob, value)
                    .unwrap_or_else(|error| panic!("{}: {error}", preset.english));
            }
            for (knob, value) in preset.settings {
                assert_eq!(recipe.get(knob).unwrap(), *value, "{}", preset.english);
            }
        }
    }
}
