//! How many koma a drawing stays between two keys (何コマ打ち): the same everywhere, or chosen for each
//! interval by its motion (打ち分け).

use std::cell::OnceCell;
use std::fmt;
use std::str::FromStr;

use crate::keys::Reference;
use crate::knob::{Kind, Setting, as_word, by_word};

/// Koma between two drawings beyond which nobody spaces.
const MOST: usize = 1000;

/// Koma that a drawing stays at the least where drawings are not on ones.
pub(super) const STAY: usize = 2;

/// A drawing every so many koma: `2` is on twos everywhere, `1-3` on ones to threes (1〜3コマ打ち), as the
/// motion of each interval asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct On {
    /// The fewest koma, where the body is fast; 1 to 1000.
    pub least: usize,
    /// The most, where it is slow; `least` to 1000.
    pub most: usize,
}

impl On {
    /// The same everywhere.
    pub fn every(koma: usize) -> Self {
        Self { least: koma, most: koma }
    }

    /// Whether it is the same everywhere.
    pub fn is_fixed(self) -> bool {
        self.least == self.most
    }

    /// Koma that a drawing stays at the least wherever it stands: two, since one alone is a twitch, or one where
    /// there may be ones.
    pub(crate) fn stay(self) -> usize {
        self.least.min(STAY)
    }

    /// Whether it can be.
    pub fn is_spacing(self) -> bool {
        1 <= self.least && self.least <= self.most && self.most <= MOST
    }

    /// For an interval from one koma to another: the most koma for which the body goes no further than
    /// `step`, in % of its height, from drawing to drawing in the mean.
    pub(super) fn within(self, from: usize, to: usize, pace: &Pace<'_>, step: f64) -> usize {
        if self.is_fixed() {
            return self.least;
        }
        let koma = step / pace.mean(from, to);
        // Of a body that does not move this is infinite, which the bound below takes.
        (koma.floor() as usize).clamp(self.least, self.most)
    }
}

/// How far a body goes from koma to koma. Of no body it does not move.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pace<'a> {
    body: Option<&'a Reference>,
    /// How far it has gone by each koma, in % of its height, from 0 on the first; not before it is asked for.
    way: OnceCell<Vec<f64>>,
}

impl<'a> Pace<'a> {
    /// The pace of the source, koma after koma.
    pub fn of(reference: &'a Reference) -> Self {
        Self { body: Some(reference), way: OnceCell::new() }
    }

    /// The pace of no body, that would go so far into each koma from the second on, in % of its height.
    #[cfg(test)]
    pub(super) fn of_steps(steps: impl Iterator<Item = f64>) -> Self {
        Self { body: None, way: OnceCell::from(summed(steps)) }
    }

    /// How far apart the poses of two koma are, in % of the body's height: what it does on the way does not count.
    pub(super) fn apart(&self, a: usize, b: usize) -> f64 {
        let body = self.body.filter(|body| a.max(b) < body.koma());
        body.map_or(0.0, |body| body.apart(a, b))
    }

    /// How far it goes a koma between two koma, in the mean.
    fn mean(&self, from: usize, to: usize) -> f64 {
        let ways = self.way.get_or_init(|| self.body.map_or_else(Vec::new, ways));
        let way = |koma: usize| ways.get(koma).or(ways.last()).copied().unwrap_or(0.0);
        (way(to) - way(from)) / (to - from) as f64
    }
}

/// How far a body has gone by each koma.
fn ways(body: &Reference) -> Vec<f64> {
    let rate = body.clock().koma_rate;
    summed(body.speeds().into_iter().map(|speed| speed / rate))
}

/// Sums of the steps into each koma from the second on, and 0 before the first of them.
fn summed(steps: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut way = 0.0;
    let ways = steps.map(|step| {
        way += step;
        way
    });
    std::iter::once(0.0).chain(ways).collect()
}

impl fmt::Display for On {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { least, most } = self;
        if self.is_fixed() { write!(f, "{least}") } else { write!(f, "{least}-{most}") }
    }
}

impl FromStr for On {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let koma = |text: &str| text.trim().parse::<usize>().ok();
        let on = match text.split_once('-') {
            None => koma(text).map(Self::every),
            Some((least, most)) => {
                koma(least).zip(koma(most)).map(|(least, most)| Self { least, most })
            }
        };
        on.filter(|on| on.is_spacing()).ok_or_else(|| {
            format!("expected koma (2), or the fewest and the most (1-3), found \"{text}\"")
        })
    }
}

impl Setting for On {
    const KIND: Kind = Kind::On;
    as_word!();
}

by_word!(On, or_number);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_reads_back_as_written_and_refuses_what_cannot_be() {
        for text in ["1", "2", "1000", "1-3", "2-4"] {
            assert_eq!(text.parse::<On>().unwrap().to_string(), text);
        }
        assert_eq!(" 1 - 3 ".parse(), Ok(On { least: 1, most: 3 }));
        for (on, written) in [(On::every(2), "2"), (On { least: 1, most: 3 }, "\"1-3\"")] {
            assert_eq!(serde_json::to_string(&on).unwrap(), written);
            assert_eq!(serde_json::from_str::<On>(written).unwrap(), on);
        }
        for wrong in
            ["", "0", "-1", "3-1", "0-3", "1-1001", "1.5", "two", "1-", "99999999999999999999"]
        {
            assert!(wrong.parse::<On>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_faster_the_body_the_fewer_koma() {
        // 1 % a koma, then 4, then 20, then none.
        let steps = [[1.0; 4], [4.0; 4], [20.0; 4], [0.0; 4]].concat();
        let pace = Pace::of_steps(steps.into_iter());
        let on = On { least: 1, most: 3 };
        // 11 are 2.75 steps of 4: the step is no further than asked.
        let within = |from, to| on.within(from, to, &pace, 11.0);
        assert_eq!([within(0, 4), within(4, 8), within(8, 12), within(12, 16)], [3, 2, 1, 3]);
        assert_eq!(on.within(4, 8, &pace, 8.0), 2, "exactly as far as asked");
        assert_eq!(On::every(2).within(8, 12, &pace, 8.0), 2, "fixed is fixed");
        assert_eq!(on.within(0, 1, &Pace::default(), 8.0), 3, "nothing moves");
        assert_eq!(on.within(14, 40, &pace, 8.0), 3, "behind the end nothing moves");
    }
}
