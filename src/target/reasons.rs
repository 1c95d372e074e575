//! Explanations of why the keys cannot match a target, in English and Japanese.

use std::fmt;

use crate::edits::Edits;
use crate::keys::{Key, Origin};
use crate::recipe::Recipe;

/// Why a target was missed (届かない理由).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shortfall {
    english: String,
    japanese: String,
}

impl Shortfall {
    /// Creates a reason from its words in English and Japanese.
    pub fn new(english: impl Into<String>, japanese: impl Into<String>) -> Self {
        Self { english: english.into(), japanese: japanese.into() }
    }

    /// Returns the reason in Japanese; [`Display`](fmt::Display) writes it in English.
    pub fn japanese(&self) -> &str {
        &self.japanese
    }
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.english)
    }
}

/// Explains why no other keys are found at all, if corrections fix the keys.
pub(super) fn settled(edits: &Edits) -> Option<Shortfall> {
    match edits {
        _ if edits.only_pins => Some(Shortfall::new(
            "only_pins wants no keys but pins and moved ones; without that others are found",
            "only_pins では固定と移動した原画だけが残る。解除すると他も選ばれる",
        )),
        _ if edits.freeze() => Some(Shortfall::new(
            "the keys are frozen; without that others are found",
            "原画は凍結中。凍結を解くと他も選ばれる",
        )),
        _ => None,
    }
}

/// Describes the limits that keep turns of joints from becoming keys, as words to append in English and to put in front
/// in Japanese; empty if there are none.
pub(super) fn limits(recipe: &Recipe, edits: &Edits) -> Shortfall {
    let weak = recipe.keys.min_strength > 0.0;
    let limits = [
        (weak, " that keys.min_strength lets through", "keys.min_strength 以上で"),
        (!edits.forbidden.is_empty(), " outside what is forbidden", "禁止の外で"),
    ];
    let there = limits.into_iter().filter(|(limits, ..)| *limits);
    let (english, japanese): (String, String) = there.map(|(_, own, other)| (own, other)).unzip();
    Shortfall { english, japanese }
}

/// Explains why none of these keys can go, none of which was found; `between` is the number of genga between first and
/// last.
pub(super) fn staying(between: usize, keys: &[Key]) -> Shortfall {
    let any = |is: fn(Origin) -> bool| keys.iter().any(|key| is(key.origin));
    let rests = any(|origin| origin == Origin::Rest);
    let contacts = any(|origin| origin == Origin::Contact);
    let steps = any(|origin| origin == Origin::Step);
    let moved = any(|origin| matches!(origin, Origin::Moved { .. }));
    let kinds: [(bool, &str, &str, &str); 5] = [
        (any(|origin| origin == Origin::Pinned), "a pin", "pins", "固定"),
        (moved, "a moved key", "moved keys", "移動した原画"),
        (rests, "the end of a rest", "ends of rests", "止めの端"),
        (contacts, "the end of a contact", "ends of contacts", "接地の端"),
        (steps, "a step of a gait", "steps of gaits", "歩き・走りの一歩"),
    ];
    let there: Vec<_> = kinds.into_iter().filter(|(is_there, ..)| *is_there).collect();
    let words: Vec<&str> =
        there.iter().map(|(_, one, many, _)| if between == 1 { *one } else { *many }).collect();
    let words = listed(&words);
    let japanese: Vec<&str> = there.iter().map(|(.., japanese)| *japanese).collect();
    let japanese = japanese.join("、");
    let way = match (rests, contacts) {
        (true, true) => "; with keys.at_rests=off and keys.contacts=off they may go",
        (true, false) => "; with keys.at_rests=off they may go",
        (false, true) => "; with keys.contacts=off they may go",
        (false, false) => "",
    };
    let off = match (rests, contacts) {
        (true, true) => "。keys.at_rests=off と keys.contacts=off なら減らせる",
        (true, false) => "。keys.at_rests=off なら減らせる",
        (false, true) => "。keys.contacts=off なら減らせる",
        (false, false) => "",
    };
    let ends = "the first and the last drawing always are genga";
    let both = "最初と最後の画は必ず原画";
    let japanese = match between {
        0 => both.into(),
        _ => format!("{both}。間の{between}枚は{japanese}なので残る{off}"),
    };
    let english = match between {
        0 => ends.into(),
        1 => format!("{ends}, and the one between them is {words}, which stays{way}"),
        _ => format!("{ends}, and all {between} between them are {words}, which stay{way}"),
    };
    Shortfall { english, japanese }
}

/// Joins words as `a, b and c`.
fn listed(words: &[&str]) -> String {
    match words {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => words.concat(),
    }
}
