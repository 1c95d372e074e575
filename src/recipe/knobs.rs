//! Every knob of the recipe by name.

use crate::error::{Error, did_you_mean};
use crate::exaggerate::Exaggerate;
use crate::keys::{ActionFinder, Choose};
use crate::knob::{Knob, Who};
use crate::recipe::Recipe;
use crate::signal::{LowPass, Speed, TurnFinder};
use crate::timing::{Omission, Spacing};

/// Sections of a recipe that hold no knobs under their own names.
const OTHER_SECTIONS: [&str; 6] = ["edits", "footage", "layer", "layers", "passages", "studies"];

/// The knobs section by section, in the order of the chain.
const SECTIONS: [&[Knob]; 9] = [
    Recipe::KNOBS,
    Exaggerate::KNOBS,
    Speed::KNOBS,
    LowPass::KNOBS,
    TurnFinder::KNOBS,
    Choose::KNOBS,
    ActionFinder::KNOBS,
    Spacing::KNOBS,
    Omission::KNOBS,
];

/// Every knob in the order of the chain: the animators' first, then the researchers'.
pub const KNOBS: &[Knob] = &in_order::<{ count() }>();

const fn count() -> usize {
    let (mut count, mut section) = (0, 0);
    while section < SECTIONS.len() {
        count += SECTIONS[section].len();
        section += 1;
    }
    count
}

/// Sorts the knobs into that order with loops, as a `const fn` cannot use iterators.
const fn in_order<const COUNT: usize>() -> [Knob; COUNT] {
    let mut knobs = [Recipe::KNOBS[0]; COUNT];
    let (mut place, mut pass) = (0, 0);
    while pass < 2 {
        let mut section = 0;
        while section < SECTIONS.len() {
            let mut at = 0;
            while at < SECTIONS[section].len() {
                let knob = SECTIONS[section][at];
                if matches!(knob.who, Who::Animator) == (pass == 0) {
                    knobs[place] = knob;
                    place += 1;
                }
                at += 1;
            }
            section += 1;
        }
        pass += 1;
    }
    knobs
}

impl Knob {
    /// Finds the knob called `name`.
    ///
    /// # Errors
    /// [`Error::Setting`] with a similar name when there is none.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        KNOBS.iter().find(|knob| knob.name == name).ok_or_else(|| unknown(name))
    }

    /// Returns help, Japanese name and accepted values as lines of a comment.
    pub(super) fn comment(&self) -> String {
        format!("{} — {}\n{}", self.japanese, self.help, self.takes())
    }
}

/// Returns the error for an unknown setting, with a similar name as a hint.
pub(super) fn unknown(name: &str) -> Error {
    unknown_beside(name, &[])
}

/// Returns the error for an unknown section, with a similar name, of the sections or of the settings, as a hint.
pub(super) fn unknown_section(name: &str) -> Error {
    let mut sections: Vec<&str> = KNOBS.iter().filter_map(|knob| knob.path().0).collect();
    sections.extend(OTHER_SECTIONS);
    sections.dedup();
    unknown_beside(name, &sections)
}

/// Returns the error for an unknown setting, with a similar name, of the settings or of `others`, as a hint.
///
/// ```
/// let error = genga::recipe::unknown_beside("nose", &["noise"]);
/// assert_eq!(error.to_string(), "nose: there is no such setting; did you mean noise?");
/// ```
pub fn unknown_beside(name: &str, others: &[&str]) -> Error {
    // `keys.weights` is a table of weights.
    if name.starts_with("keys.weight") {
        let message =
            "there is no such setting; how much a joint counts is set by keys.weights.JOINT=2";
        return Error::setting(name, message);
    }
    let hint = did_you_mean(name, others.iter().copied().chain(KNOBS.iter().map(|knob| knob.name)));
    Error::setting(name, match hint.is_empty() {
        true => "there is no such setting of the method; `genga recipe` lists them, `genga run --help` the options".into(),
        false => format!("there is no such setting{hint}"),
    })
}
