//! Tests the evaluation on crowds with known preferences and on persons who do not count, and the page on its contents.

mod made;
mod page;
mod persons;
mod read;

use proptest::prelude::*;

use crate::cases::cases;
use crate::{Answer, Bootstrap, BradleyTerry, Crowd, Interval, Question, Tally, Verdict};
use made::{NAMES, file};

/// The true score of each condition, in the order of [`NAMES`].
const WORTH: [f64; 5] = [0.9, 0.3, -0.3, -1.0, 0.1];

fn crowd(spread: f64) -> Crowd {
    Crowd { scores: WORTH.into(), spread, pairs: 20 }
}

#[test]
fn a_crowd_that_answers_in_files_is_recovered() {
    for seed in 0..3 {
        let persons = crowd(0.0).answers(120, seed);
        let files: Vec<_> =
            persons.iter().enumerate().map(|(person, own)| file(person, own)).collect();
        let read = |file: &String| Answer::read(file.as_bytes()).unwrap();
        let verdict = Verdict::new(
            files.iter().flat_map(read).collect(),
            Bootstrap { seed, ..Bootstrap::default() },
        )
        .unwrap();
        assert_eq!((verdict.persons, verdict.counted), (120, 120));
        for votes in &verdict.questions {
            assert_eq!(votes.answers, 120 * 20);
            assert!((votes.first - 0.5).abs() < 0.05, "{}", votes.first);
            let ranked: Vec<&str> = votes.scores.iter().map(|score| &score.condition[..]).collect();
            assert_eq!(ranked, ["source", "twos", "genga", "threes", "uniform"], "seed {seed}");
            for score in &votes.scores {
                let at = NAMES.iter().position(|name| *name == score.condition).unwrap();
                // With a hundred and twenty persons, none of fifteen intervals is that far off.
                let Interval { low, high } = score.interval;
                assert!((low - 0.1..high + 0.1).contains(&WORTH[at]), "{score:?}");
                assert!(high - low < 0.5, "{score:?}");
            }
            let decides: Vec<_> = votes.differences.iter().filter(|other| other.decides).collect();
            let [uniform] = decides[..] else { panic!("{decides:?}") };
            assert!(uniform.beside == "uniform" && uniform.is_clear() && uniform.score > 0.8);
        }
    }
}

/// Returns the share of intervals that contain the true score, over all conditions.
fn covered(crowd: &Crowd, truth: &[f64], persons: usize, studies: u64) -> f64 {
    let model = BradleyTerry::default();
    let (mut inside, mut all) = (0, 0);
    for seed in 0..studies {
        let answers = crowd.answers(persons, seed);
        let asked = Bootstrap { draws: 300, seed };
        let intervals = asked.intervals(&answers, |tally| model.scores(tally));
        inside += intervals.iter().zip(truth).filter(|(found, truth)| found.holds(**truth)).count();
        all += truth.len();
    }
    inside as f64 / f64::from(all as u32)
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_promise() {
    let alike = covered(&crowd(0.0), &WORTH, 40, 100);
    assert!((0.91..=0.98).contains(&alike), "{alike} of a crowd of one taste");
    // With individual tastes, the crowd as a whole is less decided than its average taste.
    let apart = crowd(0.7);
    let all = Tally::sum(5, &apart.answers(10_000, 99));
    let truth = BradleyTerry::default().scores(&all);
    let found = covered(&apart, &truth, 40, 100);
    assert!((0.90..=0.98).contains(&found), "{found} of a crowd of many tastes");
    // Resampling single answers would be overconfident here, as tastes belong to persons.
    let single = |tally: &Tally| {
        let mut all = vec![];
        for (taken, left) in (0..5).flat_map(|a| (0..5).map(move |b| (a, b))) {
            for _ in 0..tally.wins(taken, left) as usize {
                let mut one = Tally::new(5);
                one.count(taken, left);
                all.push(one);
            }
        }
        all
    };
    let width = |persons: &[Tally]| {
        let asked = Bootstrap { draws: 300, seed: 1 };
        let found = asked.intervals(persons, |tally| BradleyTerry::default().scores(tally));
        found.iter().map(|one| one.high - one.low).sum::<f64>()
    };
    let apart = Crowd { spread: 2.0, pairs: 60, ..apart }.answers(30, 5);
    let answers: Vec<Tally> = apart.iter().flat_map(single).collect();
    assert!(width(&apart) > 1.3 * width(&answers));
}

#[test]
fn who_was_never_taken_has_a_score_all_the_same() {
    let mut tally = Tally::new(3);
    (0..50).for_each(|_| tally.count(0, 1));
    let scores = BradleyTerry::default().scores(&tally);
    assert!(scores.iter().all(|score| score.is_finite()), "{scores:?}");
    assert!(scores[0] > 2.0 && scores[1] < -2.0 && scores[2].abs() < 1e-6, "{scores:?}");
    assert_eq!(BradleyTerry::default().scores(&Tally::new(2)), [0.0, 0.0]);
    assert_eq!(BradleyTerry::default().scores(&Tally::new(0)), [0.0; 0]);
}

/// Generates some answers between four conditions.
fn answers() -> impl Strategy<Value = Vec<(usize, usize)>> {
    let pair = (0..4_usize, 0..3_usize).prop_map(|(taken, other)| {
        let left = if other < taken { other } else { other + 1 };
        (taken, left)
    });
    proptest::collection::vec(pair, 1..60)
}

fn scores(answers: impl IntoIterator<Item = (usize, usize)>) -> Vec<f64> {
    let mut tally = Tally::new(4);
    answers.into_iter().for_each(|(taken, left)| tally.count(taken, left));
    BradleyTerry::default().scores(&tally)
}

proptest! {
    #![proptest_config(cases(16, 64))]

    #[test]
    fn scores_turn_round_with_the_answers(answers in answers()) {
        let found = scores(answers.clone());
        prop_assert!(found.iter().sum::<f64>().abs() < 1e-6);
        let turned = scores(answers.iter().map(|(taken, left)| (*left, *taken)));
        for (a, b) in found.iter().zip(&turned) {
            prop_assert!((a + b).abs() < 1e-4, "{found:?} {turned:?}");
        }
        let renamed = scores(answers.iter().map(|(taken, left)| (3 - taken, 3 - left)));
        for (a, b) in found.iter().zip(renamed.iter().rev()) {
            prop_assert!((a - b).abs() < 1e-4, "{found:?} {renamed:?}");
        }
    }

    #[test]
    fn one_more_win_never_costs_anything(answers in answers(), left in 1..4_usize) {
        let before = scores(answers.clone());
        let after = scores(answers.into_iter().chain([(0, left)]));
        prop_assert!(after[0] - after[left] > before[0] - before[left] - 1e-6);
    }

    #[test]
    fn a_difference_and_its_chance_are_one(chance in 0.01..0.99_f64) {
        let back = BradleyTerry::chance(BradleyTerry::difference(chance));
        prop_assert!((back - chance).abs() < 1e-9);
    }
}

#[test]
fn both_questions_are_asked() {
    assert_eq!(Question::ALL.map(|question| question.to_string()), ["anime", "use"]);
    assert!(
        Question::ALL.iter().all(|question| question.words().iter().all(|word| !word.is_empty()))
    );
}
