//! Simulated persons with known preferences, on whom the evaluation is tested.

use crate::{BradleyTerry, Tally};
use genga::maths::Lots;

/// A crowd that answers according to the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Crowd {
    /// The score of each condition, in logits.
    pub scores: Vec<f64>,
    /// Spread of tastes: the standard deviation of each person's own scores around those of the crowd.
    pub spread: f64,
    /// Number of pairs that a person sees, each equally often as far as whole rounds go.
    pub pairs: usize,
}

impl Crowd {
    /// Returns the answers of `persons` persons.
    ///
    /// # Panics
    /// With fewer than two conditions.
    pub fn answers(&self, persons: usize, seed: u64) -> Vec<Tally> {
        let mut lots = Lots::new(seed);
        (0..persons).map(|_| self.person(&mut lots)).collect()
    }

    fn person(&self, lots: &mut Lots) -> Tally {
        let own: Vec<f64> =
            self.scores.iter().map(|score| score + self.spread * lots.normal()).collect();
        let count = own.len();
        let mut all: Vec<(usize, usize)> =
            (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect();
        let mut tally = Tally::new(count);
        for pair in 0..self.pairs {
            let at = pair % all.len();
            if at == 0 {
                shuffle(&mut all, lots);
            }
            let (a, b) = all[at];
            let takes_first = lots.share() < BradleyTerry::chance(own[a] - own[b]);
            let (taken, left) = if takes_first { (a, b) } else { (b, a) };
            tally.count(taken, left);
        }
        tally
    }
}

fn shuffle<T>(list: &mut [T], lots: &mut Lots) {
    for end in (1..list.len()).rev() {
        list.swap(end, lots.below(end + 1));
    }
}
