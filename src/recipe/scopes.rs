//! Settings of single layers (セルごと) and passages (区間ごと), over those of the whole take.
//!
//! The recipe's own settings come first, then those of the layer, then those of each passage, the later over the
//! earlier.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::Recipe;
use crate::error::Error;
use crate::knob::{Knob, Knobs, choices};
use crate::sheet::is_default;
use crate::time::{Clock, Frame};

/// Sections whose settings a layer may have of its own.
const OF_LAYERS: [&str; 3] = ["keys", "spacing", "omission"];

/// Sections whose settings a passage may have of its own.
const OF_PASSAGES: [&str; 2] = ["spacing", "omission"];

/// The one setting of keys that a passage may have of its own: all others say how keys are found along the whole take.
pub(super) const PRICE: &str = "keys.min_price";

/// Settings of those sections that nevertheless hold for the whole take: they say how its stages run.
const OF_TAKE: [&str; 2] = ["omission.all_at_once", "omission.order"];

/// Settings that differ from the recipe's, by name, as [`Recipe::set`] takes them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Overrides(BTreeMap<String, String>);

/// Settings of single layers and of passages.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scopes {
    /// Settings of layers, by the name of the layer.
    pub layers: BTreeMap<String, Overrides>,
    /// Passages with settings of their own, the later over the earlier.
    pub passages: Vec<Passage>,
    /// What is shown outside of all passages.
    pub outside: Outside,
}

/// A passage of the take with settings of its own (区間).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Passage {
    /// Its source frames.
    pub frames: Frames,
    /// The only layer in which it holds; `None` for all.
    #[serde(default, skip_serializing_if = "is_default")]
    pub layer: Option<String>,
    /// Its settings. Without any, those of the layer hold.
    #[serde(default, skip_serializing_if = "is_default")]
    pub settings: Overrides,
}

/// A range of source frames, the last not included: `120..240`, `120..` or `..240`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Frames {
    /// The first frame.
    pub from: Frame,
    /// The frame after the last; `usize::MAX` if the range has no end.
    pub past: Frame,
}

/// What is shown outside of all passages (区間の外).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Outside {
    /// The sheet that the settings of the recipe and the layer make.
    #[default]
    Timed,
    /// The take as it is: a drawing of the source on every koma.
    Source,
}

choices!(Outside { Timed: "timed", Source: "source" });

/// The layer, the passage, or the passage of a layer for which a setting holds: `B`, `120..240`, `B/120..240`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Scope {
    pub(super) layer: Option<String>,
    pub(super) frames: Option<Frames>,
}

impl Overrides {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether a setting is among them.
    pub(super) fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// Returns each setting with its value.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(name, word)| (name.as_str(), word.as_str()))
    }

    /// Puts them over a recipe's settings. One that [`Recipe::validate`] refuses is passed over.
    pub(super) fn lay_over(&self, recipe: &mut Recipe) {
        self.iter().for_each(|(name, word)| _ = recipe.turn(name, word));
    }

    /// Sets one, or takes it back if there is no word.
    pub(super) fn put(&mut self, name: &str, word: Option<String>) {
        match word {
            Some(word) => _ = self.0.insert(name.into(), word),
            None => _ = self.0.remove(name),
        }
    }
}

impl Passage {
    /// Whether it holds in a layer.
    fn is_of(&self, layer: &str) -> bool {
        self.layer.as_deref().is_none_or(|own| own == layer)
    }

    /// Returns the price of a key within it, over a layer's recipe.
    pub(super) fn price(&self, recipe: &Recipe) -> (Range<Frame>, f64) {
        let mut own = recipe.clone();
        self.settings.lay_over(&mut own);
        (self.frames.from..self.frames.past, own.keys.min_price)
    }

    fn scope(&self) -> Scope {
        Scope { layer: self.layer.clone(), frames: Some(self.frames) }
    }
}

impl Scopes {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        is_default(self)
    }

    /// Returns the settings of a scope, which it adds if there are none yet.
    pub(super) fn of(&mut self, scope: &Scope) -> &mut Overrides {
        let Scope { layer, frames } = scope;
        let Some(frames) = *frames else {
            return self.layers.entry(layer.clone().unwrap_or_default()).or_default();
        };
        let is_it = |own: &Passage| own.frames == frames && own.layer == *layer;
        let at = self.passages.iter().position(is_it).unwrap_or_else(|| {
            let settings = Overrides::default();
            self.passages.push(Passage { frames, layer: layer.clone(), settings });
            self.passages.len() - 1
        });
        &mut self.passages[at].settings
    }

    /// Returns every setting with its value, in the words of [`Recipe::set`].
    pub(super) fn settings(&self) -> impl Iterator<Item = (String, String)> + '_ {
        let outside =
            (!is_default(&self.outside)).then(|| ("outside".into(), self.outside.to_string()));
        let of_layer = |(layer, own): (&String, &Overrides)| {
            let named = |(name, word): (&str, &str)| (format!("{layer}/{name}"), word.to_owned());
            own.iter().map(named).collect::<Vec<_>>()
        };
        let words: Vec<String> = self.passages.iter().map(Passage::word).collect();
        let passages = format!("[{}]", words.join(", "));
        let passages = (!words.is_empty()).then(|| ("passages".into(), passages));
        outside.into_iter().chain(self.layers.iter().flat_map(of_layer)).chain(passages)
    }

    /// Whether some part of the sheet is timed otherwise than the rest.
    pub(crate) fn has_passages(&self) -> bool {
        !self.passages.is_empty() || self.outside != Outside::Timed
    }

    /// Returns the passages of a layer.
    pub(crate) fn passages_of<'a>(&'a self, layer: &'a str) -> impl Iterator<Item = &'a Passage> {
        self.passages.iter().filter(move |own| own.is_of(layer))
    }

    /// Checks every setting and every range.
    pub(super) fn validate(&self, recipe: &Recipe) -> Result<(), Error> {
        let layers = self.layers.iter().map(|(name, own)| (Scope::of_layer(name), own));
        let passages = self.passages.iter().map(|own| (own.scope(), &own.settings));
        for (scope, own) in layers.chain(passages) {
            scope.check()?;
            let mut changed = recipe.without_scopes();
            for (name, word) in own.iter() {
                scope.admit(name)?;
                let set = changed.turn(name, word).unwrap_or(Ok(())).and_then(|()| changed.check());
                set.map_err(|error| scope.named(error))?;
            }
        }
        Ok(())
    }

    /// Checks them against the layers of a sheet and the frames of a clip.
    ///
    /// # Errors
    /// [`Error::Setting`] for a layer that does not exist, a passage outside of the clip, and if the take cannot stay
    /// as it is outside of the passages.
    pub(crate) fn check_on(
        &self,
        layers: &[&str],
        (first, last): (Frame, Frame),
        recipe: &Recipe,
    ) -> Result<(), Error> {
        let of_passages = self.passages.iter().filter_map(|own| own.layer.as_ref());
        let mut named = self.layers.keys().chain(of_passages);
        if let Some(name) = named.find(|name| !layers.contains(&name.as_str())) {
            let there = layers.join(", ");
            let message =
                format!("there is no layer {name} to set; there is {there} (see --layers)");
            return Err(Error::setting("layers", message));
        }
        if let Some(own) = self.passages.iter().find(|own| own.frames.is_outside(first, last)) {
            let message = format!("is not in the clip, which has frames {first} to {last}");
            return Err(Error::setting(own.scope().word(), message));
        }
        if self.outside == Outside::Timed {
            return Ok(());
        }
        let message = if self.passages.is_empty() {
            "source leaves everything outside of the passages as it is, and there is no passage: name one with --within"
        } else if !recipe.exaggerate.is_off() {
            "source leaves the take as it is, and exaggerate changes it everywhere: take one of the two back"
        } else if recipe.feet != crate::sheet::Feet::Free {
            "source leaves the take as it is, and feet = held moves its feet everywhere: take one of the two back"
        } else {
            return Ok(());
        };
        Err(Error::setting("outside", message))
    }
}

impl Scope {
    fn of_layer(name: &str) -> Self {
        Self { layer: Some(name.into()), frames: None }
    }

    /// Splits the name of a setting, `B/120..240:spacing.on`, into scope and knob; `None` if it has no scope. The knob
    /// is empty if the name is a scope alone.
    pub(super) fn split(name: &str) -> Result<Option<(Self, &str)>, Error> {
        let (layer, rest) = match name.split_once('/') {
            Some((layer, rest)) => (Some(layer.trim().to_owned()), rest),
            None => (None, name),
        };
        let (frames, knob) = match rest.split_once(':') {
            Some((frames, knob)) => (Some(frames), knob),
            None if rest.contains("..") => (Some(rest), ""),
            None => (None, rest),
        };
        let frames = frames.map(str::parse).transpose();
        let frames = frames.map_err(|message: String| Error::setting(name, message))?;
        let is_scoped = layer.is_some() || frames.is_some();
        Ok(is_scoped.then(|| (Self { layer, frames }, knob.trim())))
    }

    /// Returns the scope alone, as on the command line.
    fn word(&self) -> String {
        self.to_string().trim_end_matches(['/', ':']).to_owned()
    }

    /// Refuses a layer without a name and a passage without a frame.
    fn check(&self) -> Result<(), Error> {
        if self.layer.as_ref().is_some_and(|name| name.is_empty()) {
            return Err(Error::setting(
                self.to_string(),
                "the name of the layer is missing: B/spacing.on",
            ));
        }
        match self.frames {
            Some(frames) if frames.from >= frames.past => {
                Err(Error::setting(self.word(), "the passage has no frame in it"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses a setting that holds for the whole take.
    pub(super) fn admit(&self, name: &str) -> Result<(), Error> {
        let whole = format!("{self}{name}");
        if name.starts_with("keys.weights") {
            let message =
                "is given joint by joint, and a joint is of one layer: keys.weights.JOINT=2";
            return Err(Error::setting(whole, message));
        }
        let knob = Knob::find(name).map_err(|error| self.named(error))?;
        let section = knob.path().0.unwrap_or_default();
        let is_passage = self.frames.is_some();
        let message = match section {
            "keys" if is_passage && name == PRICE => return Ok(()),
            "keys" if is_passage => {
                "keys are found over the whole take; a passage has its own keys.min_price, spacing and omission, and \
                 pins and forbidden frames change its keys"
            }
            _ if is_passage && (!OF_PASSAGES.contains(&section) || OF_TAKE.contains(&name)) => {
                "holds for the whole take; a passage has its own keys.min_price, spacing and omission"
            }
            _ if !OF_LAYERS.contains(&section) => {
                "holds for the whole sheet; a layer has settings of its own in spacing, omission and keys"
            }
            _ => return Ok(()),
        };
        Err(Error::setting(whole, message))
    }

    /// Names a setting of the scope in an error about it.
    pub(super) fn named(&self, error: Error) -> Error {
        match error {
            Error::Setting { name, message } => Error::setting(format!("{self}{name}"), message),
            other => other,
        }
    }
}

/// Formats the prefix of the scope's settings: `B/`, `120..240:`, `B/120..240:`.
impl fmt::Display for Scope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(layer) = &self.layer {
            write!(f, "{layer}/")?;
        }
        self.frames.map_or(Ok(()), |frames| write!(f, "{frames}:"))
    }
}

impl Frames {
    /// Returns the koma on a sheet of `length` koma, at least one; `last` is the clip's last frame.
    pub(super) fn on_sheet(self, clock: Clock, last: Frame, length: usize) -> Range<usize> {
        let begin = clock.koma_from_frame(self.from).min(length.saturating_sub(1));
        // A passage that reaches the clip's last frame reaches the last koma.
        let past = if self.past > last { length } else { clock.koma_from_frame(self.past) };
        begin..past.min(length).max(begin + 1)
    }

    /// Whether a clip from `first` to `last` has none of the frames.
    fn is_outside(self, first: Frame, last: Frame) -> bool {
        self.from > last || self.past <= first
    }
}

impl fmt::Display for Frames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, past } = self;
        if past.0 == usize::MAX { write!(f, "{from}..") } else { write!(f, "{from}..{past}") }
    }
}

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str, open: usize| match text.trim() {
            "" => Some(open),
            text => text.parse().ok(),
        };
        let ends = text.split_once("..");
        let ends =
            ends.and_then(|(from, past)| Some((number(from, 0)?, number(past, usize::MAX)?)));
        let (from, past) = ends.ok_or_else(|| {
            format!("expected source frames, as in 120..240, 120.. or ..240, found \"{text}\"")
        })?;
        Ok(Self { from: Frame(from), past: Frame(past) })
    }
}

impl Frames {
    /// Writes the range for a recipe file.
    pub(super) fn word(self) -> String {
        let Self { from, past } = self;
        if past.0 == usize::MAX { format!("\"{self}\"") } else { format!("[{from}, {past}]") }
    }
}

/// A range as a recipe file has it.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected source frames, as in [120, 240] or \"120..\"")]
enum Written {
    Ends([usize; 2]),
    Word(String),
}

impl TryFrom<Written> for Frames {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        match written {
            Written::Ends([from, past]) => Ok(Self { from: Frame(from), past: Frame(past) }),
            Written::Word(word) => word.parse(),
        }
    }
}

impl From<Frames> for Written {
    fn from(frames: Frames) -> Self {
        match frames.past.0 {
            usize::MAX => Self::Word(frames.to_string()),
            past => Self::Ends([frames.from.0, past]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recipe(settings: &[(&str, &str)]) -> Recipe {
        let mut recipe = Recipe::default();
        settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
        recipe
    }

    #[test]
    fn a_layer_changes_what_it_names_alone() {
        let all = recipe(&[
            ("hair/spacing.on", "3"),
            ("hair/keys.min_price", "12"),
            ("spacing.weight", "0.5"),
        ]);
        let own = all.of_layer("hair");
        assert_eq!(
            ["spacing.on", "keys.min_price"].map(|name| own.get(name).unwrap()),
            ["3", "12"]
        );
        assert_eq!(own.spacing.weight, 0.5);
        assert_eq!(all.of_layer("body").spacing, all.spacing);
        let mut back = all.clone();
        back.set("hair/spacing.on", "none").unwrap();
        back.set("hair/keys.min_price", "none").unwrap();
        assert_eq!(back, recipe(&[("spacing.weight", "0.5")]));
    }

    #[test]
    fn a_setting_for_the_whole_take_is_refused_with_those_that_may_differ() {
        let mut recipe = Recipe::default();
        let mut error = |name: &str, value: &str| recipe.set(name, value).unwrap_err().to_string();
        assert_eq!(
            error("hair/rate", "12"),
            "hair/rate: holds for the whole sheet; a layer has settings of its own in spacing, omission and keys"
        );
        assert_eq!(
            error("120..240:filter.width", "12"),
            "120..240:filter.width: holds for the whole take; a passage has its own keys.min_price, spacing and omission"
        );
        assert!(error("120..240:keys.rest", "3").contains("keys are found over the whole take"));
        assert!(
            error("9..:omission.order", "koma_dori_first").contains("holds for the whole take")
        );
        assert!(error("hair/keys.weights.Head", "3").contains("a joint is of one layer"));
        assert!(
            error("hair/spacing.onn", "3")
                .starts_with("hair/spacing.onn: there is no such setting; did you mean spacing.on")
        );
        assert_eq!(
            error("B/9..20:spacing.on", "0"),
            "B/9..20:spacing.on: expected koma, 1 (ones) to 1000, or the fewest and the most (\"2-3\"), found \"0\""
        );
        assert!(error("9..x:spacing.on", "1").contains("expected source frames, as in 120..240"));
        assert!(error("20..9:spacing.on", "1").contains("has no frame in it"));
        assert!(error("/spacing.on", "1").contains("the name of the layer is missing"));
        assert_eq!(recipe, Recipe::default(), "nothing was changed");
        let mut error = |text: &str| recipe.add_passage(text).unwrap_err().to_string();
        for wrong in ["spacing.on=1", "B/spacing.on=1", "120..240:spacing.on", "120..240=1"] {
            assert!(error(wrong).contains("as in 120..240:spacing.on=1"), "{wrong}");
        }
        assert_eq!(recipe, Recipe::default());
    }

    #[test]
    fn the_same_passage_again_gets_another_setting() {
        let mut recipe = Recipe::default();
        for passage in [
            "B/120..240",
            "120..240:spacing.on=1",
            "B/120..240:omission.koma_dori=0",
            "120..240:spacing.drift=0",
        ] {
            recipe.add_passage(passage).unwrap();
        }
        assert_eq!(
            recipe.get("passages").unwrap(),
            r#"[{ frames = [120, 240], layer = "B", omission.koma_dori = 0 }, { frames = [120, 240], spacing.drift = 0, spacing.on = 1 }]"#
        );
        let mut again = Recipe::default();
        recipe.settings().iter().for_each(|(name, word)| again.set(name, word).unwrap());
        assert_eq!(again, recipe, "settings are set again as they were");
        again.set("passages", "none").unwrap();
        assert_eq!(again, Recipe::default());
    }

    #[test]
    fn a_file_has_them_beside_the_layer_or_by_its_name() {
        let own = "[[layers]]\nname = \"A\"\njoints = [\"Hips\"]\n[[layers]]\nname = \"hair\"\njoints = [\"*Hair*\"]\n[layers.spacing]\non = 3\n";
        let named = "layers = [{ name = \"A\", joints = [\"Hips\"] }, { name = \"hair\", joints = [\"*Hair*\"] }]\n[layer.hair]\nspacing.on = 3\n";
        let [own, named] = [own, named].map(|text| Recipe::parse(text).unwrap().0);
        assert_eq!(own, named);
        assert_eq!(own.of_layer("hair").spacing.on.most, 3);
        let passages = "outside = \"source\"\n[[passages]]\nframes = [120, 240]\nspacing.on = 1\n[passages.omission]\nkoma_dori = 0\n[[passages]]\nframes = \"300..\"\nlayer = \"A\"\n";
        let (read, _) = Recipe::parse(passages).unwrap();
        assert_eq!(read.scopes.passages.len(), 2);
        assert_eq!(
            read,
            recipe(&[
                (
                    "passages",
                    "[{ frames = [120, 240], omission.koma_dori = 0, spacing.on = 1 }, { frames = \"300..\", layer = \"A\" }]"
                ),
                ("outside", "source"),
            ])
        );
        for (wrong, says) in [
            ("[[passages]]\nspacing.on = 1\n", "1:1: passages: expected a list of passages"),
            ("[[passages]]\nframes = 3\n", "expected source frames, as in [120, 240]"),
            (
                "[[passages]]\nframes = [1, 9]\nspacing.on = 0\n",
                "3:14: 1..9:spacing.on: expected koma",
            ),
            (
                "[[passages]]\nframes = [1, 9]\nrate = 12\n",
                "3:8: 1..9:rate: holds for the whole take",
            ),
            ("[layer.B]\nrate = 12\n", "2:8: B/rate: holds for the whole sheet"),
            ("[layer]\nB = 12\n", "expected a table of settings"),
            ("outside = \"take\"\n", "1:1: outside: expected one of timed, source, found \"take\""),
        ] {
            let said = Recipe::parse(wrong).unwrap_err().to_string();
            assert!(said.contains(says), "{said}");
        }
    }
}
