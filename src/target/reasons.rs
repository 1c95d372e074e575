//! Explanations of why the keys cannot match a target.

use crate::edits::Edits;
use crate::keys::{Key, Origin};
use crate::recipe::Recipe;

/// Why no keys are found when only pins may be keys.
const ONLY_PINS: &str =
    "only_pins wants no keys but pins and moved ones; --only-pins=false lets others be found";

/// Why the keys are those of an earlier sheet.
const FROZEN: &str = "the keys are frozen; without --freeze others are found";

/// Explains why no other keys are found at all, if corrections fix the keys.
pub(super) fn settled(edits: &Edits) -> Option<&'static str> {
    match edits {
        _ if edits.only_pins => Some(ONLY_PINS),
        _ if edits.freeze() => Some(FROZEN),
        _ => None,
    }
}

/// Describes the limits that keep turns of joints from becoming keys, as words to append; empty if there are none.
pub(super) fn limits(recipe: &Recipe, edits: &Edits) -> String {
    let weak = recipe.keys.min_strength > 0.0;
    let limits = [
        (weak, " that keys.min_strength lets through"),
        (!edits.forbidden.is_empty(), " outside what is forbidden"),
    ];
    limits.into_iter().filter(|(limits, _)| *limits).map(|(_, words)| words).collect()
}

/// Explains why none of these keys can go, none of which was found; `between` is the number of genga between first and
/// last.
pub(super) fn staying(between: usize, keys: &[Key]) -> String {
    let any = |is: fn(Origin) -> bool| keys.iter().any(|key| is(key.origin));
    let rests = any(|origin| origin == Origin::Rest);
    let contacts = any(|origin| origin == Origin::Contact);
    let steps = any(|origin| origin == Origin::Step);
    let kinds: [(bool, &str, &str); 5] = [
        (any(|origin| origin == Origin::Pinned), "a pin", "pins"),
        (any(|origin| matches!(origin, Origin::Moved { .. })), "a moved key", "moved keys"),
        (rests, "the end of a rest", "ends of rests"),
        (contacts, "the end of a contact", "ends of contacts"),
        (steps, "a step of a gait", "steps of gaits"),
    ];
    let there = kinds.into_iter().filter(|(is_there, ..)| *is_there);
    let words: Vec<&str> =
        there.map(|(_, one, many)| if between == 1 { one } else { many }).collect();
    let words = listed(&words);
    let way = match (rests, contacts) {
        (true, true) => "; with keys.at_rests=off and keys.contacts=off they may go",
        (true, false) => "; with keys.at_rests=off they may go",
        (false, true) => "; with keys.contacts=off they may go",
        (false, false) => "",
    };
    let ends = "the first and the last drawing always are genga";
    match between {
        0 => ends.into(),
        1 => format!("{ends}, and the one between them is {words}, which stays{way}"),
        _ => format!("{ends}, and all {between} between them are {words}, which stay{way}"),
    }
}

/// Joins words as `a, b and c`.
fn listed(words: &[&str]) -> String {
    match words {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => words.concat(),
    }
}
