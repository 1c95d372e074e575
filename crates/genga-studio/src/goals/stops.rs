//! The stops (目盛り) along a goal: settings from one end to the other.

use genga::recipe::Recipe;

/// A setting and its value, as [`Recipe::set`] takes them.
pub(crate) type Setting = (&'static str, &'static str);

/// A stop: what it is called, and the settings that it makes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    pub(super) english: &'static str,
    pub(super) japanese: &'static str,
    pub(super) settings: &'static [Setting],
}

const fn stop(english: &'static str, japanese: &'static str, settings: &'static [Setting]) -> Stop {
    Stop { english, japanese, settings }
}

impl Stop {
    /// Whether a recipe has its settings.
    pub(super) fn is_in(&self, recipe: &Recipe) -> bool {
        are_in(self.settings, recipe)
    }
}

/// Whether a recipe has these settings.
pub(super) fn are_in(settings: &[Setting], recipe: &Recipe) -> bool {
    settings.iter().all(|(knob, value)| recipe.get(knob).is_ok_and(|own| own == *value))
}

/// The stops of a goal, and the measure by which a recipe at none of them is placed.
#[derive(Debug)]
pub(super) struct Path {
    pub(super) stops: [Stop; 6],
    /// Grows from stop to stop, or stays the same.
    measure: fn(&Recipe) -> f64,
}

/// Drawings a second: from threes with long holds to ones.
pub(super) const PACE: Path = Path {
    stops: [
        stop(
            "threes, long holds",
            "3コマ打ち・止め長め",
            &[("spacing.on", "3"), ("spacing.drift", "6"), ("omission.koma_dori", "60%")],
        ),
        stop(
            "on threes",
            "3コマ打ち",
            &[("spacing.on", "3"), ("spacing.drift", "3.3"), ("omission.koma_dori", "1/3")],
        ),
        stop(
            "twos and threes",
            "2〜3コマ打ち",
            &[("spacing.on", "2-3"), ("spacing.drift", "3.3"), ("omission.koma_dori", "1/3")],
        ),
        stop(
            "on twos",
            "2コマ打ち",
            &[("spacing.on", "2"), ("spacing.drift", "2"), ("omission.koma_dori", "0")],
        ),
        stop(
            "ones and twos",
            "1〜2コマ打ち",
            &[("spacing.on", "1-2"), ("spacing.drift", "1.5"), ("omission.koma_dori", "0")],
        ),
        stop(
            "on ones",
            "1コマ打ち",
            &[("spacing.on", "1"), ("spacing.drift", "0"), ("omission.koma_dori", "0")],
        ),
    ],
    measure: |recipe| {
        let on = recipe.spacing.on;
        // Longer holds than the default's are the stop below it.
        let held = if recipe.spacing.drift > 3.3 { 0.1 } else { 0.0 };
        -0.5 * (on.least + on.most) as f64 - held
    },
};

/// How snappy: from inbetweens at equal distances to crowded ones with drawings left out, and at last to exaggeration.
pub(super) const SNAP: Path = Path {
    stops: [
        stop(
            "even",
            "均等",
            &[("spacing.weight", "0"), ("omission.naka_nashi", "0"), ("exaggerate.cartoon", "0")],
        ),
        stop(
            "soft",
            "やわらか",
            &[
                ("spacing.weight", "0.15"),
                ("omission.naka_nashi", "0"),
                ("exaggerate.cartoon", "0"),
            ],
        ),
        stop(
            "usual",
            "標準",
            &[
                ("spacing.weight", "0.3"),
                ("omission.naka_nashi", "4%"),
                ("exaggerate.cartoon", "0"),
            ],
        ),
        stop(
            "snappy",
            "強め",
            &[
                ("spacing.weight", "0.45"),
                ("omission.naka_nashi", "6%"),
                ("exaggerate.cartoon", "0"),
            ],
        ),
        stop(
            "very snappy",
            "かなり強め",
            &[
                ("spacing.weight", "0.55"),
                ("omission.naka_nashi", "8%"),
                ("exaggerate.cartoon", "0"),
            ],
        ),
        stop(
            "extreme",
            "極端",
            &[
                ("spacing.weight", "0.7"),
                ("omission.naka_nashi", "10%"),
                ("exaggerate.cartoon", "0.3"),
            ],
        ),
    ],
    measure: |recipe| recipe.spacing.weight,
};

impl Path {
    /// Where a recipe stands, in stops from the first: a whole number at a stop.
    pub(super) fn place(&self, recipe: &Recipe) -> f64 {
        if let Some(at) = self.stops.iter().position(|stop| stop.is_in(recipe)) {
            return at as f64;
        }
        let measures = self.stops.map(|stop| (self.measure)(&with(stop.settings)));
        let own = (self.measure)(recipe);
        let after = measures.partition_point(|of_stop| *of_stop <= own);
        let Some(before) = after.checked_sub(1) else { return 0.0 };
        let Some(next) = measures.get(after) else { return before as f64 };
        before as f64 + (own - measures[before]) / (next - measures[before])
    }

    /// The stop that a recipe is at. `None` between stops.
    pub(super) fn stop(&self, recipe: &Recipe) -> Option<&Stop> {
        self.stops.iter().find(|stop| stop.is_in(recipe))
    }
}

/// The defaults with some settings.
fn with(settings: &[Setting]) -> Recipe {
    let mut recipe = Recipe::default();
    for (knob, value) in settings {
        recipe.set(knob, value).expect("a stop has settings that a recipe takes");
    }
    recipe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recipe_at_a_stop_stands_there_and_others_stand_between() {
        for path in [PACE, SNAP] {
            for (at, stop) in path.stops.iter().enumerate() {
                let recipe = with(stop.settings);
                assert_eq!(path.place(&recipe), at as f64, "{}", stop.english);
                for (knob, value) in stop.settings {
                    assert_eq!(recipe.get(knob).unwrap(), *value, "{}", stop.english);
                }
            }
        }
        let at = |path: &Path, knob, value| path.place(&with(&[(knob, value)]));
        assert!((at(&SNAP, "spacing.weight", "0.2") - 4.0 / 3.0).abs() < 1e-9);
        assert_eq!(at(&SNAP, "spacing.weight", "0.9"), 5.0);
        assert_eq!(at(&PACE, "spacing.on", "4"), 0.0);
        let mixed = at(&PACE, "spacing.on", "1-3");
        assert!((3.0..4.0).contains(&mixed), "{mixed}");
    }

    #[test]
    fn the_defaults_are_a_stop_of_each_path() {
        let recipe = Recipe::default();
        assert_eq!((PACE.place(&recipe), SNAP.place(&recipe)), (2.0, 2.0));
    }
}
