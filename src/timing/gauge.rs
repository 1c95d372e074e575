//! The spacing gauge (ツメ指示): the positions of the drawings between two keys along the path from one to the other.

use crate::motion::{Clip, JointId};
use crate::sheet::{Layer, Role};
use crate::timing::Stills;

/// A gap at an end counts as packed (詰め) if it is smaller than this share of the mean gap.
const PACKED: f64 = 0.75;

/// The fractions that an animator writes on a gauge for drawings between two keys.
const FRACTIONS: [(f64, &str); 17] = [
    (1.0 / 64.0, "1/64"),
    (1.0 / 32.0, "1/32"),
    (1.0 / 16.0, "1/16"),
    (0.125, "1/8"),
    (1.0 / 6.0, "1/6"),
    (0.25, "1/4"),
    (1.0 / 3.0, "1/3"),
    (0.375, "3/8"),
    (0.5, "1/2"),
    (0.625, "5/8"),
    (2.0 / 3.0, "2/3"),
    (0.75, "3/4"),
    (5.0 / 6.0, "5/6"),
    (0.875, "7/8"),
    (15.0 / 16.0, "15/16"),
    (31.0 / 32.0, "31/32"),
    (63.0 / 64.0, "63/64"),
];

/// The gauge between two consecutive kept drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// The exposure of the first drawing, as an index into [`Layer::exposures`].
    pub first: usize,
    /// The joint of the layer that travels furthest between the two; the gauge is measured along its path.
    pub joint: JointId,
    /// The share of the path covered at each exposure from the first to the second, from 0 to 1, never falling.
    pub shares: Vec<f64>,
}

/// The packing of a gauge's drawings: the motion is slow where they lie close.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Packing {
    /// Even spacing (均等割り).
    Even,
    /// Packed at the start (先ヅメ): slow-out.
    Sakizume,
    /// Packed at the end (後ヅメ): slow-in.
    Atozume,
    /// Packed at both ends (両ヅメ).
    Both,
}

impl Gauge {
    /// Returns the gauges of a layer by time, without those between keys with no movement.
    ///
    /// # Panics
    /// When the layer shows a drawing that it does not have.
    pub fn from_layer(clip: &Clip, layer: &Layer) -> Vec<Self> {
        let stills = Stills::from_layer(clip, layer);
        let joints = own_joints(clip, layer);
        let drawings: Vec<usize> = layer.exposures.iter().map(|shown| shown.drawing).collect();
        let kept: Vec<usize> = (0..drawings.len())
            .filter(|at| layer.drawings[drawings[*at]].role != Role::Inbetween)
            .collect();
        kept.windows(2)
            .filter_map(|pair| {
                let path = &drawings[pair[0]..=pair[1]];
                let (joint, whole) = furthest(&stills, path, &joints)?;
                let ways = steps(&stills, path, joint).scan(0.0, |way, step| {
                    *way += step;
                    Some(*way / whole)
                });
                let shares = std::iter::once(0.0).chain(ways).collect();
                Some(Self { first: pair[0], joint: JointId(joint), shares })
            })
            .collect()
    }

    /// Returns the shares of the drawings between the two.
    pub fn between(&self) -> &[f64] {
        &self.shares[1..self.shares.len() - 1]
    }

    /// Returns the packing, from the first and the last third of the gaps compared with the mean gap; `None` if nothing
    /// lies between the two.
    pub fn packing(&self) -> Option<Packing> {
        let gaps = self.shares.len() - 1;
        if gaps < 2 {
            return None;
        }
        let third = (gaps / 3).max(1);
        let even = third as f64 / gaps as f64;
        let starts = self.shares[third] < PACKED * even;
        let ends = 1.0 - self.shares[gaps - third] < PACKED * even;
        Some(match (starts, ends) {
            (false, false) => Packing::Even,
            (true, false) => Packing::Sakizume,
            (false, true) => Packing::Atozume,
            (true, true) => Packing::Both,
        })
    }
}

impl Packing {
    /// Returns the Japanese term.
    pub fn japanese(self) -> &'static str {
        match self {
            Self::Even => "均等",
            Self::Sakizume => "先ヅメ",
            Self::Atozume => "後ヅメ",
            Self::Both => "両ヅメ",
        }
    }

    /// Returns the term and its meaning, since the term is a false friend.
    pub fn english(self) -> &'static str {
        match self {
            Self::Even => "even",
            Self::Sakizume => "sakizume: slow-out",
            Self::Atozume => "atozume: slow-in",
            Self::Both => "slow-out, slow-in",
        }
    }
}

/// Returns the nearest fraction that an animator writes: halves, thirds, quarters, sixths, eighths, and near a key
/// halves of these down to 1/64. Only a share of 0 or 1 is `0` or `1`: the drawing is then where the key is.
pub fn fraction(share: f64) -> &'static str {
    if share <= 0.0 {
        return "0";
    }
    if share >= 1.0 {
        return "1";
    }
    let apart = |fraction: &&(f64, &str)| (fraction.0 - share).abs();
    let nearest = FRACTIONS.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
    nearest.map_or("", |fraction| fraction.1)
}

/// Returns the joints that a layer names; all if it names none.
fn own_joints(clip: &Clip, layer: &Layer) -> Vec<usize> {
    let joints = clip.skeleton().joints.iter().enumerate();
    let is_own = |name: &String| layer.joints.is_empty() || layer.joints.contains(name);
    joints.filter(|(_, data)| is_own(&data.name)).map(|(joint, _)| joint).collect()
}

/// Returns the joint with the longest path over some drawings, and its length; `None` if nothing moves.
fn furthest(stills: &Stills, path: &[usize], joints: &[usize]) -> Option<(usize, f64)> {
    let way = |joint: &usize| (*joint, steps(stills, path, *joint).sum::<f64>());
    joints
        .iter()
        .map(way)
        .reduce(|a, b| if b.1 > a.1 { b } else { a })
        .filter(|(_, whole)| *whole > 0.0)
}

fn steps<'a>(
    stills: &'a Stills,
    path: &'a [usize],
    joint: usize,
) -> impl Iterator<Item = f64> + 'a {
    let position = move |drawing: usize| stills.position(drawing, joint);
    path.windows(2).map(move |pair| position(pair[0]).distance(position(pair[1])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_reads_as_the_nearest_fraction() {
        assert_eq!(fraction(0.26), "1/4");
        assert_eq!(fraction(0.34), "1/3");
        assert_eq!([0.07, 0.04, 0.99, 0.95].map(fraction), ["1/16", "1/32", "63/64", "15/16"]);
    }

    #[test]
    fn what_lies_between_two_keys_is_on_neither() {
        assert_eq!([0.0, 1.0].map(fraction), ["0", "1"]);
        assert_eq!([1e-9, 0.005].map(fraction), ["1/64"; 2]);
        assert_eq!([1.0 - 1e-9, 0.995].map(fraction), ["63/64"; 2]);
    }

    fn packing(between: &[f64]) -> Option<Packing> {
        let shares = [&[0.0], between, &[1.0]].concat();
        let gauge = Gauge { first: 0, joint: JointId(0), shares };
        assert_eq!(gauge.between(), between);
        gauge.packing()
    }

    #[test]
    fn close_ticks_at_an_end_are_packing_there() {
        use Packing::{Atozume, Both, Even, Sakizume};
        for (between, expected) in [
            (&[0.5][..], Even),
            (&[0.4], Even),
            (&[1.0 / 3.0], Sakizume),
            (&[0.75], Atozume),
            (&[1.0 / 3.0, 2.0 / 3.0], Even),
            (&[0.125, 0.25, 0.5], Sakizume),
            (&[0.5, 0.75, 0.875], Atozume),
            (&[0.125, 0.875], Both),
            (&[0.05, 0.15, 0.5, 0.85, 0.95], Both),
            (&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9], Even),
            (&[0.5, 0.5], Even),
        ] {
            assert_eq!(packing(between), Some(expected), "{between:?}");
        }
        assert_eq!(packing(&[]), None, "nothing lies between");
    }
}
