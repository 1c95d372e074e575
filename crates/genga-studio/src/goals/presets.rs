//! Presets (プリセット): points in the room of the three goals.

use super::stops::{PACE, SNAP, Setting, are_in};
use genga::recipe::Recipe;

/// A point: settings of the genga, a stop of the pace and a stop of the snap.
#[derive(Debug, PartialEq)]
pub(crate) struct Preset {
    pub(crate) english: &'static str,
    pub(crate) japanese: &'static str,
    pub(crate) help: &'static str,
    pub(crate) japanese_help: &'static str,
    genga: &'static [Setting],
    pace: usize,
    snap: usize,
}

/// All presets.
pub(crate) const PRESETS: &[Preset] = &[
    Preset {
        english: "TV action",
        japanese: "TVアクション",
        help: "Twos and threes, crowded at the genga, the fastest drawings left out.",
        japanese_help: "2〜3コマ打ち。原画の近くに詰め、最も速い中割りを抜く。",
        genga: &[("keys.min_price", "7.5"), ("keys.per_second", "6")],
        pace: 2,
        snap: 3,
    },
    Preset {
        english: "TV acting",
        japanese: "TV芝居",
        help: "Few genga on threes, held long between gestures.",
        japanese_help: "原画は少なめの3コマ打ち。しぐさの間は長く止める。",
        genga: &[("keys.min_price", "12"), ("keys.per_second", "4")],
        pace: 1,
        snap: 2,
    },
    Preset {
        english: "Walk and run",
        japanese: "歩き・走り",
        help: "On twos at nearly equal distances, and nothing held, so that every step is the same.",
        japanese_help: "ほぼ等間隔の2コマ打ちで、止めない。どの一歩も同じになる。",
        genga: &[("keys.min_price", "7.5"), ("keys.per_second", "6")],
        pace: 3,
        snap: 1,
    },
    Preset {
        english: "Full",
        japanese: "フル",
        help: "Many genga, a drawing on every koma, nothing left out or held.",
        japanese_help: "原画は多め、1コマ打ち。抜かず、止めない。",
        genga: &[("keys.min_price", "4"), ("keys.per_second", "12")],
        pace: 5,
        snap: 1,
    },
];

impl Preset {
    /// Every setting with its value.
    pub(crate) fn settings(&self) -> impl Iterator<Item = Setting> {
        let stops = [PACE.stops[self.pace].settings, SNAP.stops[self.snap].settings];
        self.genga.iter().chain(stops.into_iter().flatten()).copied()
    }

    /// Whether a recipe has its settings.
    pub(super) fn is_in(&self, recipe: &Recipe) -> bool {
        let stops = [PACE.stops[self.pace], SNAP.stops[self.snap]];
        are_in(self.genga, recipe) && stops.iter().all(|stop| stop.is_in(recipe))
    }
}
