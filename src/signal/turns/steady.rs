//! The dead band: the accelerations that count as a steady speed.

use std::fmt;
use std::str::FromStr;

use crate::knob::{Kind, Setting, as_word, by_word};

/// The largest acceleration that still counts as steady (等速): `100` or `"5%"`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steady {
    /// In °/s² for angles, else in the signal's own unit a second; 0 or more.
    Acceleration(f64),
    /// As a share of the joint's own 95th percentile of |acceleration|, 0 to 1: written `5%`.
    Share(f64),
}

impl Steady {
    /// Whether it is a valid band: finite, not below 0, and a share not above 1.
    pub fn is_band(self) -> bool {
        match self {
            Self::Acceleration(size) => size.is_finite() && size >= 0.0,
            Self::Share(share) => (0.0..=1.0).contains(&share),
        }
    }

    /// Returns the largest change from one frame to the next that is steady, in the signal's unit. `sizes` is a buffer.
    pub(super) fn step(
        self,
        speeds: &[f64],
        fps: f64,
        for_people: f64,
        sizes: &mut Vec<f64>,
    ) -> f64 {
        match self {
            Self::Acceleration(size) => size / (fps * for_people),
            Self::Share(share) => share * usual_largest(speeds, sizes),
        }
    }
}

/// Returns the 95th percentile of the changes' sizes by nearest rank: the smallest that 95 % do not exceed.
fn usual_largest(speeds: &[f64], sizes: &mut Vec<f64>) -> f64 {
    sizes.clear();
    sizes.extend(speeds.windows(2).map(|step| (step[1] - step[0]).abs()));
    let rank = (95 * sizes.len()).div_ceil(100);
    match rank.checked_sub(1) {
        Some(place) => *sizes.select_nth_unstable_by(place, f64::total_cmp).1,
        None => 0.0,
    }
}

impl fmt::Display for Steady {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Acceleration(size) => size.fmt(f),
            Self::Share(share) => {
                let exact = with_exponent_moved(&format!("{share:e}"), 2);
                let plain = exact.parse::<f64>().map(|percent| percent.to_string());
                match plain {
                    Ok(plain) if share_from_percent(&plain) == Some(*share) => {
                        write!(f, "{plain}%")
                    }
                    _ => write!(f, "{exact}%"),
                }
            }
        }
    }
}

/// Multiplies the number written in `text` by a power of ten, still as text: no digit is rounded, so that a share reads
/// back as the same number.
fn with_exponent_moved(text: &str, by: i32) -> String {
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    match exponent.parse::<i32>() {
        Ok(exponent) => format!("{digits}e{}", exponent.saturating_add(by)),
        Err(_) => text.to_owned(),
    }
}

fn share_from_percent(percent: &str) -> Option<f64> {
    with_exponent_moved(percent, -2).parse().ok()
}

impl FromStr for Steady {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let steady = match text.strip_suffix('%') {
            Some(percent) => share_from_percent(percent.trim()).map(Self::Share),
            None => text.parse().ok().map(Self::Acceleration),
        };
        steady.filter(|steady| steady.is_band()).ok_or_else(|| {
            format!("expected an acceleration in °/s² (100) or a share (5%), found \"{text}\"")
        })
    }
}

impl Setting for Steady {
    const KIND: Kind = Kind::Band;
    as_word!();
}

by_word!(Steady, or_number);

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde::{Deserialize, Serialize};

    use super::*;

    #[test]
    fn a_band_is_an_acceleration_or_a_share() {
        assert_eq!("100".parse(), Ok(Steady::Acceleration(100.0)));
        assert_eq!(" 5 % ".parse(), Ok(Steady::Share(0.05)));
        assert_eq!("7%".parse(), Ok(Steady::Share(0.07)));
        assert_eq!("1.5e1%".parse(), Ok(Steady::Share(0.15)));
        assert_eq!("0%".parse(), Ok(Steady::Share(0.0)));
        for wrong in ["", "%", "-1", "-1%", "101%", "nan", "nan%", "inf", "1e%", "5%%", "5 °/s²"]
        {
            assert!(wrong.parse::<Steady>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_band_is_written_as_people_read_it() {
        for text in ["100", "0.5", "5%", "7%", "0%", "100%", "0.1%", "12.5%"] {
            assert_eq!(text.parse::<Steady>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn a_recipe_writes_a_number_or_a_text() {
        #[derive(Debug, PartialEq, Serialize, Deserialize)]
        struct Table {
            steady: Steady,
        }
        for (text, steady) in [
            ("steady = 100", Steady::Acceleration(100.0)),
            ("steady = 0.25", Steady::Acceleration(0.25)),
            ("steady = \"5%\"", Steady::Share(0.05)),
            ("steady = \"30\"", Steady::Acceleration(30.0)),
        ] {
            assert_eq!(toml::from_str::<Table>(text).unwrap(), Table { steady }, "{text}");
        }
        let written = |steady| toml::to_string(&Table { steady }).unwrap();
        assert_eq!(written(Steady::Share(0.05)), "steady = \"5%\"\n");
        assert_eq!(written(Steady::Acceleration(100.0)), "steady = 100\n");
        for wrong in ["steady = -1", "steady = true", "steady = \"200%\"", "steady = nan"] {
            assert!(toml::from_str::<Table>(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_usual_largest_is_the_95th_percentile() {
        let speeds = |steps: &[f64]| -> Vec<f64> {
            let sum = |at: usize| steps[..at].iter().sum();
            (0..=steps.len()).map(sum).collect()
        };
        let mut steps: Vec<f64> = (1..=100).map(f64::from).collect();
        steps.swap(3, 97);
        steps[50] = -steps[50];
        assert_eq!(usual_largest(&speeds(&steps), &mut vec![]), 95.0);
        assert_eq!(usual_largest(&speeds(&[3.0, -7.0]), &mut vec![]), 7.0);
        assert_eq!(usual_largest(&[5.0], &mut vec![1.0]), 0.0, "no step at all");
        let band = Steady::Share(0.5).step(&speeds(&steps), 120.0, 57.0, &mut vec![]);
        assert_eq!(band, 47.5, "whatever rate and unit");
        assert_eq!(Steady::Acceleration(60.0).step(&[], 120.0, 2.0, &mut vec![]), 0.25);
    }

    proptest! {
        #[test]
        fn a_share_reads_back_as_the_same_number(share in 0.0..=1.0f64) {
            let text = Steady::Share(share).to_string();
            prop_assert_eq!(text.parse(), Ok(Steady::Share(share)), "{}", text);
        }
    }
}
