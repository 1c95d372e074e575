//! The keying of holds (止め): stepped, or with doubled keys for readers without steps.

use super::Step;

/// Part of a koma by which a doubled hold ends early: too short to be seen, too long to be lost by rounding.
const GAP: f64 = 0.01;

impl Step {
    /// glTF's interpolation mode between two keys.
    pub(crate) fn interpolation(self) -> &'static str {
        match self {
            Self::Single => "STEP",
            Self::Doubled => "LINEAR",
        }
    }

    /// Key times of consecutive holds, each from koma `begin` until before `end`. A closing key ends the last hold:
    /// without it the last drawing would have no duration, and a looping player would skip it.
    pub(crate) fn times(
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
                // After more than an hour the gap is below the resolution of an f32.
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

    /// The values at the times of [`Step::times`], given one value per hold.
    pub(crate) fn values<T: Copy>(self, holds: impl Iterator<Item = T>) -> Vec<T> {
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
