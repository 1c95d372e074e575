//! Passages (区間): the played range as a part of the sheet with settings of its own. While a range that is a passage is
//! marked, the goals are those of the passage.

use std::ops::Range;

use super::Studio;
use super::goals::stops::Setting;
use super::open_take::Take;
use genga::error::Error;
use genga::pipeline::Breakdown;
use genga::recipe::{Frames, Recipe};
use genga::time::Frame;

/// Sections whose settings a passage has of its own.
const OWN: [&str; 2] = ["spacing.", "omission."];

/// The source frames of some koma.
pub(super) fn frames(breakdown: &Breakdown<'_>, koma: &Range<usize>) -> Frames {
    let (clock, clip) = (breakdown.clock, breakdown.source);
    let frame = |koma: usize| clock.place_from_koma(koma).round().max(0.0) as usize;
    let from = frame(koma.start).clamp(clip.first().0, clip.last().0);
    let past = frame(koma.end).clamp(from + 1, clip.last().0 + 1);
    Frames { from: Frame(from), past: Frame(past) }
}

/// Whether a recipe has a passage of these frames.
pub(super) fn has(recipe: &Recipe, frames: Frames) -> bool {
    recipe.scopes.passages.iter().any(|own| own.frames == frames && own.layer.is_none())
}

/// A recipe as it holds in a passage.
pub(super) fn within(recipe: &Recipe, frames: Frames) -> Recipe {
    let mut own = recipe.clone();
    for passage in recipe.scopes.passages.iter().filter(|own| own.frames == frames) {
        for (knob, value) in passage.settings.iter() {
            // What a passage may set, a recipe takes.
            drop(own.set(knob, value));
        }
    }
    own
}

/// Sets knobs of a passage, or of the whole sheet. A passage passes over those that hold for the whole.
pub(super) fn set_all(
    recipe: &mut Recipe,
    passage: Option<Frames>,
    mut settings: impl Iterator<Item = Setting>,
) -> Result<(), Error> {
    settings.try_for_each(|(knob, value)| match passage {
        None => recipe.set(knob, value),
        Some(frames) if OWN.iter().any(|section| knob.starts_with(section)) => {
            recipe.set(&format!("{frames}:{knob}"), value)
        }
        Some(_) => Ok(()),
    })
}

impl Studio {
    /// The frames of the played range. `None` if all is played.
    pub(super) fn marked(&mut self) -> Option<Frames> {
        let (take, koma) = (self.take.as_mut()?, self.player.range.as_ref()?);
        Some(frames(&take.results().breakdown, koma))
    }

    /// The passage that is the played range. `None` if there is none.
    pub(super) fn marked_passage(&mut self) -> Option<Frames> {
        let frames = self.marked()?;
        let take = self.take.as_ref()?;
        has(&take.wanted.recipe, frames).then_some(frames)
    }

    /// Makes a passage of the played range, or dissolves the one that it is.
    pub(super) fn make_passage(&mut self) {
        let (Some(frames), Some(take)) = (self.marked(), &mut self.take) else {
            return self.tell(
                "Mark a range with I and O first. It becomes a passage with goals of its own.",
                "先に I と O で範囲を決めてください。その範囲が、目標を別に決められる区間になります。",
            );
        };
        if has(&take.wanted.recipe, frames) {
            return self.dissolve(frames);
        }
        match take.wanted.recipe.add_passage(&frames.to_string()) {
            Ok(()) => self.tell(
                "The range is a passage now: drawings a second and snap are set for it alone.",
                "この範囲は区間になりました。動画枚数とメリハリは、この区間だけに効きます。",
            ),
            Err(error) => self.fail(error.to_string()),
        }
    }

    /// Removes the passage of some frames.
    pub(super) fn dissolve(&mut self, frames: Frames) {
        let remove = |take: &mut Take| {
            take.wanted.recipe.scopes.passages.retain(|own| own.frames != frames);
        };
        self.take.iter_mut().for_each(remove);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_passage_has_its_own_spacing_and_leaves_the_rest_alone() {
        let mut recipe = Recipe::default();
        let frames = Frames { from: Frame(20), past: Frame(50) };
        recipe.add_passage("20..50").unwrap();
        assert!(has(&recipe, frames) && !has(&recipe, Frames { from: Frame(0), past: Frame(50) }));
        let settings = [("spacing.on", "1"), ("exaggerate.ease", "0.5"), ("keys.min_price", "3")];
        set_all(&mut recipe, Some(frames), settings.into_iter()).unwrap();
        assert_eq!(recipe.get("spacing.on").unwrap(), "2-3");
        assert_eq!(recipe.get("exaggerate.ease").unwrap(), "0");
        assert_eq!(within(&recipe, frames).get("spacing.on").unwrap(), "1");
        set_all(&mut recipe, None, settings.into_iter()).unwrap();
        assert_eq!(recipe.get("exaggerate.ease").unwrap(), "0.5");
    }
}
