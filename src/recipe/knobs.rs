//! Every knob of the recipe by name.

use crate::error::{Error, nearest};
use crate::exaggerate::Exaggerate;
use crate::keys::{ActionFinder, Choose};
use crate::knob::{Knob, Who};
use crate::recipe::Recipe;
use crate::signal::{LowPass, Speed, TurnFinder};
use crate::timing::{Omission, Spacing};

/// Section by section, in the order of the chain.
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

/// Every knob, in the order of the chain: those of an animator, then those of studies.
pub const KNOBS: &[Knob] = &in_order::<{ count() }>();

const fn count() -> usize {
    let (mut count, mut section) = (0, 0);
    while section < SECTIONS.len() {
        count += SECTIONS[section].len();
        section += 1;
    }
    count
}

/// A constant has no iterators.
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
    /// The knob of that name.
    ///
    /// # Errors
    /// [`Error::Setting`] with the nearest name when there is none.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        KNOBS.iter().find(|knob| knob.name == name).ok_or_else(|| unknown(name))
    }

    /// Help, Japanese name and what it takes, as lines for a comment.
    pub(super) fn comment(&self) -> String {
        format!("{} — {}\n{}", self.japanese, self.help, self.takes())
    }
}

/// That there is no knob of that name, and which is meant.
pub(super) fn unknown(name: &str) -> Error {
    // A table and no knob.
    if name.starts_with("keys.weight") {
        let message =
            "there is no such setting; how much a joint counts is set by keys.weights.JOINT=2";
        return Error::setting(name, message);
    }
    let hint = nearest(name, KNOBS.iter().map(|knob| knob.name)).unwrap_or_default();
    Error::setting(name, format!("there is no such setting; did you mean {hint}?"))
}
