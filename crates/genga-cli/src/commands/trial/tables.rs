//! Tables of a trial's plan and outcome, for people.

use crate::console::{Table, counted, two};
use genga_trial::{Difference, Interval, Plan, Verdict, Votes};

/// Renders the number of drawings in each film of a trial.
pub(super) fn planned(plan: &Plan) -> String {
    let mut table = Table::default();
    let names = plan.conditions.iter().map(|condition| condition.name.clone());
    table.row(["drawings 枚数".to_owned(), "koma".to_owned()].into_iter().chain(names));
    for clip in &plan.clips {
        let counts = plan.conditions.iter().filter_map(|planned| clip.drawings.get(&planned.name));
        let counts = counts.map(ToString::to_string);
        table.row([clip.name.clone(), clip.koma.to_string()].into_iter().chain(counts));
    }
    table.text(1).trim_end().to_owned()
}

/// Renders the outcome, beginning with the answers that do not count.
pub(super) fn verdict(found: &Verdict, files: usize) -> String {
    let counted_of = |count: usize| counted(count, "person").replace("persons", "people");
    let mut page = format!(
        "{} in {}; {} count 有効\n",
        counted_of(found.persons),
        counted(files, "file"),
        found.counted
    );
    for (eye, count) in &found.eyes {
        let eye = if eye.is_empty() { "did not say what they do with animation" } else { eye };
        page += &format!("  {count} {eye}\n");
    }
    for excluded in &found.excluded {
        page += &format!("left out 除外  {}: {}\n", excluded.person, excluded.reason);
    }
    if !found.is_enough() {
        page += &format!(
            "Too few answers: {} count, the plan asks for {}. What follows decides nothing. 回答が足りません\n",
            counted_of(found.counted),
            found.fewest
        );
    }
    for votes in found.questions.iter().filter(|votes| votes.answers > 0) {
        page += &question(votes, found.is_enough());
    }
    page
}

/// Renders the tables of a question.
fn question(votes: &Votes, is_enough: bool) -> String {
    let [english, japanese] = votes.question.words();
    let mut table = Table::default();
    table.row(["condition 条件", "score 得点", "95 %", "chosen 選ばれた"]);
    for score in &votes.scores {
        let chosen = format!(
            "{:.0} % of {}",
            100.0 * score.taken as f64 / score.shown.max(1) as f64,
            score.shown
        );
        table.row([score.condition.clone(), signed(score.score), range(score.interval), chosen]);
    }
    let mut beside = Table::default();
    beside.row(["genga minus 差", "score", "95 %", "genga is taken"]);
    for difference in &votes.differences {
        let chance = format!("{:.0} %", 100.0 * difference.chance);
        let cells = [signed(difference.score), range(difference.interval), chance];
        beside.row([difference.beside.clone()].into_iter().chain(cells));
    }
    let mut page = format!("\n{english} {japanese}\n{}", table.text(1));
    if !votes.differences.is_empty() {
        page += &format!("\n{}", beside.text(1));
    }
    if let Some(decides) = votes.differences.iter().find(|difference| difference.decides) {
        page += &format!("{}\n", decided(decides, is_enough));
    }
    page + &format!(
        "the first film was chosen in {} % of {} answers 先の映像\n",
        two(Some(100.0 * votes.first)),
        votes.answers
    )
}

/// Says whether the deciding comparison is clear, and for which condition.
fn decided(difference: &Difference, is_enough: bool) -> &'static str {
    match (is_enough, difference.is_clear(), difference.score > 0.0) {
        (false, ..) => "not decided: too few answers 未決",
        (true, false, _) => "not decided: genga and uniform cannot be told apart 未決",
        (true, true, true) => "decided: genga before uniform, with as many drawings 結果：原画",
        (true, true, false) => {
            "decided: uniform before genga, with as many drawings 結果：均等割り"
        }
    }
}

fn signed(value: f64) -> String {
    let text = format!("{value:+.2}");
    // A negative zero is printed as zero.
    if text == "-0.00" { "+0.00".into() } else { text }
}

fn range(interval: Interval) -> String {
    match interval.low.is_finite() {
        true => format!("{} … {}", signed(interval.low), signed(interval.high)),
        false => "not known".into(),
    }
}
