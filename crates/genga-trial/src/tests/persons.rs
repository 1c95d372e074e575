//! Persons who count and persons who do not.

use super::made::{Made, file};
use crate::{Answer, Bootstrap, Crowd, Reason, Tally, Verdict};

fn answers() -> Tally {
    let crowd = Crowd { scores: super::WORTH.into(), spread: 0.0, pairs: 20 };
    crowd.answers(1, 1).remove(0)
}

fn verdict(files: &[String]) -> Result<Verdict, genga::Error> {
    let mut all = vec![];
    for file in files {
        all.extend(Answer::read(file.as_bytes())?);
    }
    Verdict::new(all, Bootstrap { draws: 50, seed: 0 })
}

/// Returns why the single person of a file does not count.
fn why(made: &Made) -> Option<Reason> {
    let found = verdict(&[made.file(&answers())]).unwrap();
    assert_eq!(found.counted + found.excluded.len(), 1);
    found.excluded.first().map(|excluded| excluded.reason)
}

#[test]
fn each_reason_is_found_and_one_step_less_counts() {
    let good = Made::new(1);
    assert_eq!(why(&good), None);
    assert_eq!(why(&Made { wrong: 1, ..good.clone() }), None, "a finger slips once");
    assert_eq!(why(&Made { wrong: 2, ..good.clone() }), Some(Reason::Caught { wrong: 2, of: 6 }));
    assert_eq!(why(&Made { hz: 47.0, slow: 0.05, ..good.clone() }), None);
    let slow = Made { hz: 30.0, ..good.clone() };
    assert_eq!(why(&slow), Some(Reason::Screen { hz: 30.0, slow: 0.0 }));
    let stumbles = Made { slow: 0.06, ..good.clone() };
    assert_eq!(why(&stumbles), Some(Reason::Screen { hz: 60.0, slow: 0.06 }));
    assert_eq!(why(&Made { dropped: 3, ..good.clone() }), None, "3 of 184 koma");
    let Some(Reason::Dropped { share }) = why(&Made { dropped: 4, ..good }) else { panic!() };
    assert!((share - 4.0 / 184.0).abs() < 1e-12);
}

#[test]
fn who_stopped_does_not_count_and_is_named() {
    let whole = file(3, &answers());
    let lines: Vec<&str> = whole.lines().collect();
    let half = lines[..20].join("\n");
    let found = verdict(&[half]).unwrap();
    let [only] = &found.excluded[..] else { panic!() };
    assert_eq!(only.person, "00000003");
    assert_eq!(only.reason, Reason::Stopped { answered: 19, of: 46 });
    assert_eq!(only.reason.to_string(), "answered 19 of 46 pairs");
    assert!(found.questions.iter().all(|votes| votes.answers == 0 && votes.scores.is_empty()));
}

#[test]
fn what_is_saved_twice_counts_once_and_files_come_in_any_order() {
    let whole = file(3, &answers());
    let half = whole.lines().take(20).collect::<Vec<_>>().join("\n");
    let other = file(4, &answers());
    let once = verdict(&[whole.clone(), other.clone()]).unwrap();
    assert_eq!(verdict(&[other, half, whole.clone(), whole]).unwrap(), once);
    assert_eq!((once.persons, once.counted), (2, 2));
    assert!(!once.is_enough());
}

#[test]
fn two_trials_and_two_answers_to_one_pair_are_refused() {
    let error = |files: &[String]| verdict(files).unwrap_err().to_string();
    let other = Made { trial: "t2", ..Made::new(2) }.file(&answers());
    let said = error(&[file(1, &answers()), other]);
    assert!(said.contains("two trials, t1 and t2"), "{said}");
    let turned = file(1, &answers()).replacen(",first,0,", ",second,0,", 1);
    let said = error(&[file(1, &answers()), turned]);
    assert!(said.contains("person 00000001 has two different answers"), "{said}");
}
