//! The plan of a trial: questions, participants and evaluation, fixed before anybody answers (事前登録).

use std::collections::BTreeMap;

use serde::Serialize;

use genga::knob::choices;

/// A question about a pair (質問). Each is asked about all pairs before the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Question {
    /// Which film is more like hand-drawn anime.
    Anime,
    /// Which film the person would rather use.
    Use,
}

choices!(Question { Anime: "anime", Use: "use" });

impl Question {
    /// Both questions.
    pub const ALL: [Self; 2] = [Self::Anime, Self::Use];

    /// Returns the wording of the question in English and Japanese.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::Anime => {
                ["Which is more like hand-drawn anime?", "手描きのアニメらしいのはどちらですか？"]
            }
            Self::Use => ["Which would you rather use?", "使うとしたらどちらですか？"],
        }
    }
}

/// Version of the format of answers and pages.
pub(super) const SCHEMA: &str = "genga-trial-1";

/// Number of catch pairs per question, in which one of the two films stands still.
pub(super) const CATCHES: usize = 3;
/// Number of wrong catch pairs, over both questions, that a counted person may have: anyone slips once.
pub(super) const MOST_WRONG: usize = 1;
/// Lowest refresh rate in Hz that shows 24 koma evenly enough: two refreshes per koma, with some tolerance for the
/// measurement.
pub(super) const LEAST_HZ: f64 = 47.0;
/// Largest share of measured refreshes that may come more than a koma after the one before.
pub(super) const MOST_SLOW: f64 = 0.05;
/// Largest share of koma that may never have been on screen.
pub(super) const MOST_DROPPED: f64 = 0.02;
/// Fewest counted persons for a decision: see `docs/evidence.md`.
pub(super) const FEWEST: usize = 24;

/// The columns of the answers file.
pub(super) const COLUMNS: [&str; 20] = [
    "schema",
    "trial",
    "person",
    "seed",
    "eye",
    "language",
    "hz",
    "slow",
    "of",
    "number",
    "question",
    "clip",
    "first",
    "second",
    "chosen",
    "replays",
    "seconds",
    "koma",
    "dropped",
    "koma_rate",
];

/// The method, one sentence per point.
const METHOD: [&str; 14] = [
    "A person sees two films of one motion, one after the other in the same place, and says which of the two it is.",
    "They are not shown side by side: that would let people compare drawing by drawing, and raises what they call natural.",
    "Figure, camera, size and colours of both are the same; only which drawing is on screen on which koma differs.",
    "Nothing that the person sees or hears names what a film is.",
    "There are no ties: who sees no difference guesses.",
    "Each question is asked of all pairs before the other; which of them comes first is by the person's seed.",
    "Pairs come in rounds of all of them, in an order by the seed. In a round every condition comes first as often as \
     second, or once more. Every other round and the second question have each pair the other way round.",
    "Some pairs are catch pairs, of which the person is told beforehand: one film stands still, and the other is to be chosen.",
    "A person counts who answered all pairs, had no more catch pairs wrong than catch.most_wrong, and whose screen met \
     screen.least_hz, screen.most_slow and screen.most_dropped. All others are reported with the reason.",
    "Koma that never were on screen are counted alike for every film, whether or not another drawing would have come.",
    "Scores are those of Bradley and Terry, of each question by itself, with a mean of 0; catch pairs are not among the answers.",
    "Intervals of 95 % come from a bootstrap over persons, 2000 draws, widened for few persons as Hesterberg (2015) says.",
    "One comparison decides, for each question, if both are conditions: genga minus uniform, which has as many drawings. It \
     is decided where its interval does not hold 0. All others are told and decide nothing.",
    "With fewer persons who count than fewest_persons nothing is decided.",
];

/// The whole plan, as in `trial.json` and the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    pub(super) schema: &'static str,
    /// A digest of the plan and the films, by which answers to this page are recognised.
    pub trial: String,
    /// Koma per second.
    pub koma_rate: f64,
    /// The camera of all films.
    pub camera: &'static str,
    /// The questions in English and Japanese.
    pub(super) questions: Vec<Asked>,
    /// The conditions, in the order of the films.
    pub conditions: Vec<Planned>,
    /// The motions.
    pub clips: Vec<Shown>,
    /// Number of pairs that a person sees for each question, without catch pairs.
    pub pairs: usize,
    pub(super) catch: Catch,
    pub(super) screen: Screen,
    pub(super) fewest_persons: usize,
    pub(super) method: [&'static str; 14],
    pub(super) columns: [&'static str; 20],
}

/// A question as embedded in the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Asked {
    id: Question,
    en: &'static str,
    ja: &'static str,
}

/// A condition of a plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Planned {
    /// Its name in the answers.
    pub name: String,
    /// A description in a sentence.
    pub what: String,
}

/// A motion of a plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Shown {
    /// Its name in the answers.
    pub name: String,
    /// Length of each film in koma.
    pub koma: usize,
    /// Number of drawings of each condition.
    pub drawings: BTreeMap<String, usize>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Catch {
    film: &'static str,
    per_question: usize,
    most_wrong: usize,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Screen {
    least_hz: f64,
    most_slow: f64,
    most_dropped: f64,
}

impl Plan {
    /// Creates the plan of a trial.
    pub(super) fn new(
        (koma_rate, camera): (f64, &'static str),
        conditions: Vec<Planned>,
        clips: Vec<Shown>,
        pairs: usize,
    ) -> Self {
        let asked = |id: Question| {
            let [en, ja] = id.words();
            Asked { id, en, ja }
        };
        Self {
            schema: SCHEMA,
            trial: String::new(),
            koma_rate,
            camera,
            questions: Question::ALL.map(asked).into(),
            conditions,
            clips,
            pairs,
            catch: Catch {
                film: super::conditions::STUCK,
                per_question: CATCHES,
                most_wrong: MOST_WRONG,
            },
            screen: Screen { least_hz: LEAST_HZ, most_slow: MOST_SLOW, most_dropped: MOST_DROPPED },
            fewest_persons: FEWEST,
            method: METHOD,
            columns: COLUMNS,
        }
    }

    /// Returns the total number of pairs that a person sees, for both questions and including catch pairs.
    pub fn shown(&self) -> usize {
        self.questions.len() * (self.pairs + self.catch.per_question)
    }
}
