//! Counts of how often each condition was preferred to each other.

/// Counts of answers between conditions (対戦表).
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    conditions: usize,
    /// How often the row was preferred to the column.
    wins: Vec<f64>,
}

impl Tally {
    /// Creates a tally without answers.
    pub fn new(conditions: usize) -> Self {
        Self { conditions, wins: vec![0.0; conditions * conditions] }
    }

    /// Returns the number of conditions.
    pub fn conditions(&self) -> usize {
        self.conditions
    }

    /// Counts an answer: condition `taken` was preferred to condition `left`.
    ///
    /// # Panics
    /// If there is no condition of that number.
    pub fn count(&mut self, taken: usize, left: usize) {
        self.wins[taken * self.conditions + left] += 1.0;
    }

    /// Adds the answers of another person.
    pub fn add(&mut self, other: &Self) {
        self.wins.iter_mut().zip(&other.wins).for_each(|(all, wins)| *all += wins);
    }

    /// Returns the pooled answers of several persons.
    pub fn sum<'a>(conditions: usize, persons: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut all = Self::new(conditions);
        persons.into_iter().for_each(|person| all.add(person));
        all
    }

    /// Returns how often one condition was preferred to the other.
    pub fn wins(&self, taken: usize, left: usize) -> f64 {
        self.wins[taken * self.conditions + left]
    }

    /// Returns how often a condition was chosen, and how often it was shown.
    pub fn taken(&self, condition: usize) -> (f64, f64) {
        let others = 0..self.conditions;
        let taken: f64 = others.clone().map(|other| self.wins(condition, other)).sum();
        let left: f64 = others.map(|other| self.wins(other, condition)).sum();
        (taken, taken + left)
    }
}
