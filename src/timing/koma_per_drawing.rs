//! Number of koma that a drawing stays (何コマ打ち): the same everywhere, or by the pace at each drawing (打ち分け).

use std::cell::OnceCell;
use std::fmt;
use std::str::FromStr;

use crate::keys::{Chords, Reference};
use crate::knob::{Kind, Setting, as_word, by_word};

/// Largest number of koma between two drawings.
const MOST: usize = 1000;

/// Fewest koma that a drawing stays when drawings are not on ones.
pub(super) const STAY: usize = 2;

/// Koma per drawing: `2` is on twos everywhere; `1-3` is on ones to threes (1〜3コマ打ち), chosen for each drawing by its
/// pace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct On {
    /// The fewest koma, used where the body is fast; 1 to 1000.
    pub least: usize,
    /// The most koma, used where it is slow; `least` to 1000.
    pub most: usize,
}

impl On {
    /// Creates a fixed number of koma.
    pub fn every(koma: usize) -> Self {
        Self { least: koma, most: koma }
    }

    /// Whether the number is the same everywhere.
    pub fn is_fixed(self) -> bool {
        self.least == self.most
    }

    /// Returns the least distance between keys in koma: two, since a drawing of a single koma is a twitch, or one if
    /// everything is on ones.
    pub(crate) fn stay(self) -> usize {
        self.most.min(STAY)
    }

    /// Whether the range is valid.
    pub fn is_spacing(self) -> bool {
        1 <= self.least && self.least <= self.most && self.most <= MOST
    }

    /// Returns how many koma the drawing of a koma stays: the most in which the body goes no further than `step`, in %
    /// of its height.
    pub(super) fn from(self, koma: usize, pace: &Pace<'_>, step: f64) -> usize {
        let goes_on = |koma_on: &usize| pace.way(koma, koma + koma_on) <= step;
        (self.least + 1..=self.most).rev().find(goes_on).unwrap_or(self.least)
    }
}

/// How far a body goes from koma to koma. Without a body there is no movement.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pace<'a> {
    body: Option<&'a Reference>,
    /// Distances of parts that act while the body is quiet.
    chords: Option<&'a Chords>,
    /// The distance travelled up to each koma, in % of body height, 0 on the first; computed on first use.
    way: OnceCell<Vec<f64>>,
    /// The largest distance between poses; computed on first use.
    reach: OnceCell<f64>,
}

impl<'a> Pace<'a> {
    /// Creates the pace of the source, koma by koma.
    pub fn new(reference: &'a Reference) -> Self {
        Self { body: Some(reference), ..Self::default() }
    }

    /// Also counts the movement of parts while the body is quiet.
    pub fn with_acting(self, chords: &'a Chords) -> Self {
        Self { chords: Some(chords), ..self }
    }

    /// Creates a pace from steps into each koma from the second on, in % of body height, without a body.
    #[cfg(test)]
    pub(super) fn of_steps(steps: impl Iterator<Item = f64>) -> Self {
        Self { way: OnceCell::from(summed(steps)), ..Self::default() }
    }

    /// Returns how much the poses of two koma differ, in % of body height; the path between them does not count.
    pub(super) fn unlike(&self, a: usize, b: usize) -> f64 {
        let places = match self.body {
            Some(body) if a.max(b) < body.koma() => body.unlike(a, b),
            Some(_) => 0.0,
            None => self.way(a.min(b), a.max(b)),
        };
        places.max(self.chords.map_or(0.0, |chords| chords.acted(a, b)))
    }

    /// Returns the number of koma.
    pub(super) fn koma(&self) -> usize {
        self.body.map_or(0, Reference::koma).max(self.way.get().map_or(0, Vec::len))
    }

    /// Returns how far apart the poses of the body get: the distance from the pose furthest from the first to the one
    /// furthest from that.
    pub(super) fn reach(&self) -> f64 {
        *self.reach.get_or_init(|| {
            let furthest = |from: usize| {
                let further = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
                (0..self.koma())
                    .map(|at| (at, self.unlike(from, at)))
                    .max_by(further)
                    .unwrap_or_default()
            };
            furthest(furthest(0).0).1
        })
    }

    /// Returns how far the body goes from one koma to a later one, in % of its height.
    fn way(&self, from: usize, to: usize) -> f64 {
        let ways = self.way.get_or_init(|| self.body.map_or_else(Vec::new, ways));
        let way = |koma: usize| ways.get(koma).or(ways.last()).copied().unwrap_or(0.0);
        way(to) - way(from)
    }
}

/// Returns how far a body has gone by each koma.
fn ways(body: &Reference) -> Vec<f64> {
    let rate = body.clock().koma_rate;
    summed(body.speeds().into_iter().map(|speed| speed / rate))
}

/// Sums the steps into each koma from the second on, with 0 for the first.
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
        // 1 % per koma, then 4, then 20, then 0.
        let steps = [[1.0; 4], [4.0; 4], [20.0; 4], [0.0; 4]].concat();
        let pace = Pace::of_steps(steps.into_iter());
        let on = On { least: 1, most: 3 };
        let from = |koma| on.from(koma, &pace, 8.0);
        assert_eq!([0, 1, 2, 3].map(from), [3, 3, 3, 2], "by what comes, and not by the mean");
        assert_eq!([4, 6, 7, 10, 11, 12].map(from), [2, 2, 1, 1, 1, 3], "exactly as far as asked");
        assert_eq!(On::every(2).from(9, &pace, 8.0), 2, "fixed is fixed");
        assert_eq!(on.from(0, &Pace::default(), 8.0), 3, "nothing moves");
        assert_eq!(on.from(40, &pace, 8.0), 3, "behind the end nothing moves");
    }

    #[test]
    fn poses_reach_as_far_as_the_furthest_two_are_unlike() {
        let pace = Pace::of_steps([3.0, 4.0, 0.0].into_iter());
        assert_eq!([pace.unlike(0, 1), pace.unlike(2, 0), pace.unlike(2, 3)], [3.0, 7.0, 0.0]);
        assert_eq!(pace.reach(), 7.0);
        assert_eq!(Pace::default().reach(), 0.0);
    }
}
