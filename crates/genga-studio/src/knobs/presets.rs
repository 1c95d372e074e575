//! Presets (プリセット): named sets of a few knobs, applied on top of the others.

/// A named set of knobs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Preset {
    pub(crate) english: &'static str,
    pub(crate) japanese: &'static str,
    /// Knobs and their values.
    pub(crate) settings: &'static [(&'static str, &'static str)],
}

const fn preset(
    english: &'static str,
    japanese: &'static str,
    settings: &'static [(&'static str, &'static str)],
) -> Preset {
    Preset { english, japanese, settings }
}

/// All presets.
pub(crate) const PRESETS: &[Preset] = &[
    preset("On twos", "2コマ打ち", &[("spacing.on", "2")]),
    preset("On threes", "3コマ打ち", &[("spacing.on", "3")]),
    preset("Ones to threes", "1〜3コマ打ち", &[("spacing.on", "1-3")]),
    preset("Twos and threes", "2〜3コマ打ち", &[("spacing.on", "2-3")]),
    preset("Snappy", "メリハリ", &[("spacing.weight", "0.5"), ("omission.naka_nashi", "4%")]),
    preset("Soft", "なめらか", &[("spacing.weight", "0.1"), ("omission.naka_nashi", "0")]),
    preset("Few genga", "原画少なめ", &[("keys.min_price", "16")]),
];

#[cfg(test)]
mod tests;
