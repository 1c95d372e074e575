//! Algorithms 1 and 2 taken literally: a list of poses, with every distance recomputed in every round.

use genga::timing::Stills;
use glam::DVec3;

/// Most times that a frame may be duplicated, or copied over the next.
const MOST: usize = 3;

/// The list that the pseudo-code works on.
pub(super) struct Frames {
    list: Vec<Frame>,
    /// Number of Algorithm 2 copies that replaced a frame by an equal one.
    pub(super) idle: usize,
}

#[derive(Clone)]
struct Frame {
    /// The koma of the source that it shows.
    koma: usize,
    joints: Vec<DVec3>,
    /// `#DUPLICATED`. A duplicate is not duplicated again: the paper counts "copies of a frame".
    duplicated: usize,
    /// `#COPIED`, counted at the index in the list, as printed.
    copied: usize,
}

impl Frames {
    /// Makes one frame per koma, with the given number of joints.
    pub(super) fn from_stills(stills: &Stills, joints: usize) -> Self {
        let frame = |koma| Frame {
            koma,
            joints: (0..joints).map(|joint| stills.position(koma, joint)).collect(),
            duplicated: 0,
            copied: 0,
        };
        Self { list: (0..stills.len()).map(frame).collect(), idle: 0 }
    }

    /// Naka-nashi: deletes the fastest frame and duplicates the one before the slowest.
    pub(super) fn algorithm_1(&mut self, times: usize) {
        for _ in 0..times {
            let Some(fastest) = argmin(self.ssd().map(|(k, ssd)| (k, -ssd))) else { return };
            self.list.remove(fastest);
            let free = self.ssd().filter(|(k, _)| self.list[k - 1].duplicated < MOST);
            let Some(slowest) = argmin(free) else { return };
            self.list[slowest - 1].duplicated += 1;
            let duplicate = Frame { duplicated: MOST, ..self.list[slowest - 1].clone() };
            self.list.insert(slowest, duplicate);
        }
    }

    /// Koma-dori: copies the frame before the slowest over it.
    pub(super) fn algorithm_2(&mut self, times: usize) {
        for _ in 0..times {
            let free = self.ssd().filter(|(k, _)| self.list[k - 1].copied < MOST);
            let Some(slowest) = argmin(free) else { return };
            self.idle += usize::from(self.list[slowest].koma == self.list[slowest - 1].koma);
            self.list[slowest - 1].copied += 1;
            let Frame { koma, ref joints, .. } = self.list[slowest - 1];
            let joints = joints.clone();
            let own = &mut self.list[slowest];
            (own.koma, own.joints) = (koma, joints);
        }
    }

    /// Movement into each frame but the first.
    fn ssd(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (1..self.list.len()).map(|k| {
            let (before, own) = (&self.list[k - 1].joints, &self.list[k].joints);
            (k, before.iter().zip(own).map(|(a, b)| a.distance_squared(*b)).sum())
        })
    }

    /// Number of frames that repeat the one before.
    pub(super) fn held(&self) -> usize {
        self.list.windows(2).filter(|pair| pair[0].koma == pair[1].koma).count()
    }
}

/// Index of the smallest value; the first one on a tie.
fn argmin(values: impl Iterator<Item = (usize, f64)>) -> Option<usize> {
    values.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kitamura::table_1::ACTIONS;
    use crate::ones::{Ones, counts};
    use crate::samples;

    impl Frames {
        /// The koma of the source that each frame shows.
        fn shown(&self) -> Vec<usize> {
            self.list.iter().map(|frame| frame.koma).collect()
        }
    }

    /// Frames of one joint at the given places on a line.
    fn line(places: &[f64]) -> Frames {
        let mut stills = Stills::new(1);
        places.iter().for_each(|x| stills.push(&[DVec3::X * *x]));
        Frames::from_stills(&stills, 1)
    }

    #[test]
    fn the_fastest_goes_and_the_slowest_is_doubled() {
        let mut frames = line(&[0.0, 1.0, 5.0, 8.0, 8.5, 10.0]);
        frames.algorithm_1(1);
        assert_eq!(frames.shown(), [0, 1, 3, 3, 4, 5]);
    }

    #[test]
    fn a_copy_is_copied_again_and_changes_nothing() {
        let mut frames = line(&[0.0, 3.0, 4.0, 7.0, 9.0]);
        frames.algorithm_2(1);
        assert_eq!((frames.shown(), frames.idle), (vec![0, 1, 1, 3, 4], 0));
        frames.algorithm_2(2);
        assert_eq!((frames.shown(), frames.idle), (vec![0, 1, 1, 3, 4], 2));
        frames.algorithm_2(1);
        assert_eq!((frames.shown(), frames.idle), (vec![0, 1, 1, 3, 3], 2));
    }

    #[test]
    fn naka_nashi_is_algorithm_1_on_the_four_actions() {
        for action in ACTIONS {
            let ones = Ones::new(samples::clip(action.sample).unwrap());
            let mut frames = Frames::from_stills(&ones.stills, ones.clip.skeleton().len());
            frames.algorithm_1(action.naka_nashi);
            let done = ones.omit(&counts(action.naka_nashi, 0)).unwrap();
            assert_eq!(frames.shown(), done.shown, "{}", action.name);
        }
    }
}
