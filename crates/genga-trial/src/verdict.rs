//! The result of a trial (結果).

use std::collections::BTreeMap;

use serde::Serialize;

use crate::exclusions::{OfPerson, by_person, reason};
use crate::plan::FEWEST;
use crate::{
    Answer, Bootstrap, BradleyTerry, Condition, Excluded, Interval, Place, Question, Tally,
};
use genga::error::Error;

/// The answers of all persons, evaluated as the plan says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Number of persons who answered.
    pub persons: usize,
    /// Number of persons who count.
    pub counted: usize,
    /// Number of persons who must count before anything is decided.
    pub fewest: usize,
    /// The persons who do not count, with the reasons.
    pub excluded: Vec<Excluded>,
    /// Number of counted persons by what they do with animation.
    pub eyes: BTreeMap<String, usize>,
    /// The result of each question.
    pub questions: Vec<Votes>,
}

/// The result of a question.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Votes {
    /// The question.
    pub question: Question,
    /// Number of counted answers, without catch pairs.
    pub answers: usize,
    /// The share of answers that chose the film shown first: 0.5 if the order had no effect.
    pub first: f64,
    /// The conditions, the best first.
    pub scores: Vec<Score>,
    /// The differences between the program's sheet and each other condition.
    pub differences: Vec<Difference>,
}

/// The result of a condition.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Score {
    /// Its name.
    pub condition: String,
    /// Its score in logits; all scores have a mean of 0.
    pub score: f64,
    /// The 95 % confidence interval of the score.
    pub interval: Interval,
    /// How often the condition was chosen.
    pub taken: usize,
    /// How often the condition was shown.
    pub shown: usize,
}

/// The lead of the program's sheet over another condition.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// The other condition.
    pub beside: String,
    /// The difference of the scores.
    pub score: f64,
    /// The 95 % confidence interval of the difference.
    pub interval: Interval,
    /// The probability by the model that the program's sheet is preferred.
    pub chance: f64,
    /// Whether the plan decides by this difference.
    pub decides: bool,
}

impl Difference {
    /// Whether the interval excludes 0.
    pub fn is_clear(&self) -> bool {
        !self.interval.holds(0.0)
    }
}

impl Verdict {
    /// Evaluates answers. The order of files and rows does not matter.
    ///
    /// # Errors
    /// [`Error::Table`] when the answers belong to several trials, or a person gave two different answers to one pair.
    pub fn new(answers: Vec<Answer>, bootstrap: Bootstrap) -> Result<Self, Error> {
        let persons = by_person(answers)?;
        let mut excluded = Vec::new();
        let mut counted: Vec<&OfPerson> = Vec::new();
        for (person, answers) in &persons {
            match reason(answers) {
                Some(reason) => excluded.push(Excluded { person: person.clone(), reason }),
                None => counted.push(answers),
            }
        }
        let mut eyes = BTreeMap::new();
        for answer in counted.iter().filter_map(|person| person.values().next()) {
            *eyes.entry(answer.eye.clone()).or_default() += 1;
        }
        let names = names(&counted);
        let votes =
            |question| Ballot { question, names: &names, persons: &counted }.votes(bootstrap);
        Ok(Self {
            persons: persons.len(),
            counted: counted.len(),
            fewest: FEWEST,
            excluded,
            eyes,
            questions: Question::ALL.into_iter().map(votes).collect(),
        })
    }

    /// Whether enough persons count for a decision.
    pub fn is_enough(&self) -> bool {
        self.counted >= self.fewest
    }
}

/// Returns the shown conditions: those of every trial in their order, then a person's own by name.
fn names(persons: &[&OfPerson]) -> Vec<String> {
    let answers = persons.iter().flat_map(|person| person.values());
    let shown = answers.filter(|answer| !answer.is_catch());
    let mut names: Vec<&str> =
        shown.flat_map(|answer| [answer.first.as_str(), answer.second.as_str()]).collect();
    let place = |name: &str| {
        let own = Condition::ALL.iter().position(|condition| condition.to_string() == name);
        own.unwrap_or(Condition::ALL.len())
    };
    names.sort_by_key(|name| (place(name), *name));
    names.dedup();
    names.into_iter().map(String::from).collect()
}

/// The answers to one question.
struct Ballot<'a> {
    question: Question,
    names: &'a [String],
    persons: &'a [&'a OfPerson],
}

impl Ballot<'_> {
    fn votes(&self, bootstrap: Bootstrap) -> Votes {
        let tallies: Vec<Tally> = self.persons.iter().map(|person| self.tally(person)).collect();
        let all = Tally::sum(self.names.len(), &tallies);
        let own = self.names.iter().position(|name| *name == Condition::Genga.to_string());
        // The scores, followed by the program's score minus each.
        let figures = |tally: &Tally| {
            let scores = BradleyTerry::default().scores(tally);
            let beside = own.map(|own| scores.iter().map(|score| scores[own] - score).collect());
            [scores, beside.unwrap_or_else(Vec::new)].concat()
        };
        let found = figures(&all);
        let intervals = bootstrap.intervals(&tallies, figures);
        let rows: Vec<(f64, Interval)> = found.into_iter().zip(intervals).collect();
        let (scores, beside) = rows.split_at(rows.len().min(self.names.len()));
        let mut scores: Vec<Score> = self
            .names
            .iter()
            .zip(scores)
            .enumerate()
            .map(|(at, (name, (score, interval)))| {
                let (taken, shown) = all.taken(at);
                let (taken, shown) = (taken as usize, shown as usize);
                Score { condition: name.clone(), score: *score, interval: *interval, taken, shown }
            })
            .collect();
        scores.sort_by(|a, b| b.score.total_cmp(&a.score));
        let others = self.names.iter().zip(beside).enumerate().filter(|(at, _)| Some(*at) != own);
        let differences = others.map(|(_, (name, (score, interval)))| Difference {
            beside: name.clone(),
            score: *score,
            interval: *interval,
            chance: BradleyTerry::chance(*score),
            decides: *name == Condition::Uniform.to_string(),
        });
        let answers = self.answers().count();
        let first = self.answers().filter(|answer| answer.chosen == Place::First).count();
        Votes {
            question: self.question,
            answers,
            first: first as f64 / answers.max(1) as f64,
            scores,
            differences: differences.collect(),
        }
    }

    fn answers(&self) -> impl Iterator<Item = &Answer> {
        self.persons.iter().flat_map(|person| self.of(person))
    }

    /// Returns a person's answers to the question, without catch pairs.
    fn of<'p>(&self, person: &'p OfPerson) -> impl Iterator<Item = &'p Answer> + use<'p> {
        let question = self.question;
        person.values().filter(move |answer| answer.question == question && !answer.is_catch())
    }

    fn tally(&self, person: &OfPerson) -> Tally {
        let mut tally = Tally::new(self.names.len());
        let place = |name: &str| self.names.iter().position(|own| own == name);
        for answer in self.of(person) {
            let (taken, left) = answer.taken_and_left();
            if let (Some(taken), Some(left)) = (place(taken), place(left)) {
                tally.count(taken, left);
            }
        }
        tally
    }
}
