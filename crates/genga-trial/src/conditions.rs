//! The compared conditions: the source, even timings, and this program's sheet.

use genga::knob::choices;
use genga::sheet::{Exposure, Sheet};
use genga::time::Clock;
use genga_lab::quality::baselines::{every, uniform};

/// A way to time a motion, available in every trial (条件).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Condition {
    /// The capture itself, on ones (1コマ打ち).
    Source,
    /// A drawing every second koma (2コマ打ち).
    Twos,
    /// A drawing every third koma (3コマ打ち).
    Threes,
    /// As many drawings as this program's sheet, as evenly as whole koma allow (均等割り).
    Uniform,
    /// This program's sheet.
    Genga,
}

choices!(Condition {
    Source: "source",
    Twos: "twos",
    Threes: "threes",
    Uniform: "uniform",
    Genga: "genga",
});

/// The name of the motionless film in a catch pair.
pub(super) const STUCK: &str = "stuck";

impl Condition {
    /// All conditions, in the order of tables.
    pub const ALL: [Self; 5] = [Self::Source, Self::Twos, Self::Threes, Self::Uniform, Self::Genga];

    /// Describes the condition in a sentence.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Source => "The capture, a drawing every koma.",
            Self::Twos => "The capture, a drawing every second koma and the last.",
            Self::Threes => "The capture, a drawing every third koma and the last.",
            Self::Uniform => {
                "The capture, as many drawings as genga has, as evenly as whole koma allow."
            }
            Self::Genga => "The sheet of the program.",
        }
    }

    /// Returns the koma on which the drawings begin, for a motion of `koma` koma and a program's sheet of `drawings`
    /// drawings; `None` for the program's sheet itself.
    fn begins(self, koma: usize, drawings: usize) -> Option<Vec<usize>> {
        let inner = match self {
            Self::Source => every(koma, 1),
            Self::Twos => every(koma, 2),
            Self::Threes => every(koma, 3),
            Self::Uniform => uniform(koma, drawings.saturating_sub(2)),
            Self::Genga => return None,
        };
        let last = (koma > 1).then(|| koma - 1);
        Some([0].into_iter().chain(inner).chain(last).collect())
    }

    /// Returns the sheet for a motion of `koma` koma and a program's sheet of `drawings` drawings; `None` for the
    /// program's sheet itself.
    pub(super) fn sheet(self, clock: Clock, koma: usize, drawings: usize) -> Option<Sheet> {
        self.begins(koma, drawings).map(|begins| held(clock, koma, &begins))
    }
}

/// Returns the sheet of a catch pair: the first drawing stays throughout.
pub(super) fn stuck(clock: Clock, koma: usize) -> Sheet {
    held(clock, koma, &[0])
}

/// Builds a sheet whose drawings show the source at their begin and stay until the next.
fn held(clock: Clock, koma: usize, begins: &[usize]) -> Sheet {
    let mut sheet = Sheet::on_ones(clock, koma);
    let layer = &mut sheet.layers[0];
    layer.drawings = begins.iter().map(|begin| layer.drawings[*begin].clone()).collect();
    let ends = begins.iter().skip(1).copied().chain([koma]);
    let exposures = begins.iter().zip(ends).enumerate();
    layer.exposures =
        exposures.map(|(drawing, (begin, end))| Exposure { drawing, koma: end - begin }).collect();
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::time::{Frame, FrameRate};

    fn clock() -> Clock {
        Clock { first: Frame(0), frame_rate: FrameRate::new(120.0).unwrap(), koma_rate: 24.0 }
    }

    fn holds(condition: Condition, koma: usize, drawings: usize) -> Vec<usize> {
        let sheet = condition.sheet(clock(), koma, drawings).unwrap();
        assert!(sheet.check().is_ok());
        sheet.layers[0].exposures.iter().map(|exposure| exposure.koma).collect()
    }

    #[test]
    fn even_timings_hold_each_drawing_as_long() {
        assert_eq!(holds(Condition::Source, 5, 3), [1; 5]);
        assert_eq!(holds(Condition::Twos, 7, 3), [2, 2, 2, 1]);
        assert_eq!(holds(Condition::Threes, 9, 3), [3, 3, 2, 1]);
        assert_eq!(holds(Condition::Source, 1, 1), [1]);
        assert_eq!(Condition::Genga.sheet(clock(), 9, 3), None);
        let stuck = stuck(clock(), 12);
        assert_eq!(stuck.layers[0].exposures, [Exposure { drawing: 0, koma: 12 }]);
    }

    #[test]
    fn uniform_has_as_many_drawings_whatever_their_number() {
        for koma in 2..60 {
            for drawings in 2..=koma {
                let holds = holds(Condition::Uniform, koma, drawings);
                assert_eq!(holds.len(), drawings, "{koma} koma");
                assert_eq!(holds.iter().sum::<usize>(), koma);
                let inner = &holds[..holds.len() - 1];
                let [least, most] = [inner.iter().min(), inner.iter().max()];
                assert!(most.unwrap() - least.unwrap() <= 1, "{holds:?}");
            }
        }
    }

    #[test]
    fn a_drawing_shows_the_source_where_it_begins() {
        let sheet = Condition::Threes.sheet(clock(), 8, 0).unwrap();
        for (begin, exposure) in sheet.layers[0].timed() {
            let place = sheet.layers[0].drawings[exposure.drawing].source.place();
            assert_eq!(place, clock().place_from_koma(begin));
        }
    }
}
