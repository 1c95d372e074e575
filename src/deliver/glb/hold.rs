//! How a hold (止め) is keyed: stepped, or for readers that know no steps.

use super::Step;

/// What part of a koma a doubled hold ends early: too short to be seen, too long to be rounded away.
const GAP: f64 = 0.01;

impl Step {
    /// glTF's word for what happens between two keys.
    pub(in crate::deliver) fn interpolation(self) -> &'static str {
        match self {
            Self::Single => "STEP",
            Self::Doubled => "LINEAR",
        }
    }

    /// The times of the keys of holds that follow one another, each from koma `begin` until before `end`. The
    /// last ends with a key: without it the last drawing would last no time and a player would begin again at once.
    pub(in crate::deliver) fn times(
        self,
        holds: impl Iterator<Item = (usize, usize)>,
        koma_rate: f64,
    ) -> Vec<[f32; 1]> {
        let second = |koma: f64| (koma / koma_rate) as f32;
        let mut times = Vec::new();
        let mut closing = None;
        for (begin, end) in holds {
            let end = end as f64;
            times.push([second(begin as f64)]);
            if self == Self::Doubled {
                // After an hour and more the gap is smaller than what a float tells apart.
                times.push([second(end - GAP).min(second(end).next_down())]);
            }
            closing = Some([second(end)]);
        }
        if self == Self::Doubled {
            times.pop();
        }
        times.extend(closing);
        times
    }

    /// The values at those times, of one value a hold.
    pub(in crate::deliver) fn values<T: Copy>(self, holds: impl Iterator<Item = T>) -> Vec<T> {
        match self {
            Self::Single => {
                let mut values: Vec<T> = holds.collect();
                values.extend(values.last().copied());
                values
            }
            Self::Doubled => holds.flat_map(|value| [value; 2]).collect(),
        }
    }
}
