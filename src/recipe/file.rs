//! Recipe files (ファイル): TOML with a comment for every knob, and a person's corrections beside them.

mod scoped;
mod unquoted;

use std::collections::BTreeSet;
use std::ops::Range;

use serde::de::IntoDeserializer;
use serde::{Deserialize, Serialize};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

use super::knobs::{KNOBS, unknown_section};
use super::scopes::Scope;
use super::{Footage, Knob, Recipe, Who};
use crate::edits::Edits;
use crate::error::{Error, in_words};

/// The section of the researchers' knobs, keyed by their full names. A file may also keep them in their own sections.
const STUDIES: &str = "studies";

/// The comment above that section in a written recipe.
const ABOUT_STUDIES: &str =
    "\n# For studies (研究用): nothing here is of use to somebody who draws.";

/// The section of the joints' weights, and the knob after which it is written. TOML requires a table within a section
/// to follow the section's values.
const WEIGHTS: &str = "keys.weights";
const LAST_OF_KEYS: &str = "keys.per_second";

/// The comment above the weights in a written recipe.
const ABOUT_WEIGHTS: &str = "\
# 部位の重み — How much joints count, by name or by pattern (* any letters, ? one): 0 has no say, 2 counts
# twice; a joint that none fits has 1. A whole name goes before a pattern, more letters before fewer.
";

impl Recipe {
    /// Reads a recipe and corrections from TOML. Settings that are absent keep their defaults.
    ///
    /// # Errors
    /// [`Error::Recipe`] with line and column when the text is not TOML, names an unknown setting, names one twice, or
    /// gives one a value that it does not accept.
    ///
    /// ```
    /// use genga::recipe::Recipe;
    ///
    /// let (recipe, edits) = Recipe::parse("rate = 12\n[edits]\npins = [{ frame = 42 }]")?;
    /// assert_eq!((recipe.rate, edits.pins[0].frame.0), (12.0, 42));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<(Self, Edits), Error> {
        Self::default().overlaid(text)
    }

    /// Like [`Recipe::parse`], on top of this recipe: absent settings keep its values.
    ///
    /// # Errors
    /// As for [`Recipe::parse`].
    pub fn overlaid(&self, text: &str) -> Result<(Self, Edits), Error> {
        let not_read = |error| not_read(text, error);
        let mut table = DeTable::parse(text).map_err(not_read)?.into_inner();
        let edits = table.remove("edits");
        if let Some(date) = edits.as_ref().and_then(unquoted::find_date) {
            return Err(needs_quotes(text, date, None));
        }
        let edits = edits.map(|edits| Edits::deserialize(edits.into_deserializer()));
        let edits = edits.transpose().map_err(not_read)?.unwrap_or_default();
        // Footage is for the studio alone; parsing it here reports its errors all the same.
        take_footage(text, &mut table)?;
        let mut file = File { text, recipe: self.clone(), named: BTreeSet::new() };
        file.take_scopes(&mut table)?;
        file.take("", &table)?;
        Ok((file.recipe, edits))
    }

    /// Writes the recipe, with a comment for every knob, and the corrections as TOML that [`Recipe::parse`] reads back.
    pub fn write(&self, edits: &Edits) -> String {
        let mut text = String::from(
            "# A genga recipe: every setting of the chain. What is not named keeps its default.\n\
             # Lengths of time are source frames (20) or seconds (\"0.2s\").\n",
        );
        text.push_str(&self.scopes.written_outside());
        let mut section = None;
        for (knob, (_, value)) in KNOBS.iter().zip(self.settings()) {
            let (inside, field) = match knob.who {
                Who::Animator => knob.path(),
                Who::Researcher => (Some(STUDIES), knob.name),
            };
            if inside != section {
                let about = if inside == Some(STUDIES) { ABOUT_STUDIES } else { "" };
                text.push_str(&format!("{about}\n[{}]\n", inside.unwrap_or_default()));
                section = inside;
            } else {
                text.push('\n');
            }
            knob.comment().lines().for_each(|line| text.push_str(&format!("# {line}\n")));
            match value.as_str() {
                "none" => text.push_str(&format!("# {field} = none\n")),
                word => text.push_str(&format!("{field} = {}\n", written(word))),
            }
            if knob.name == LAST_OF_KEYS {
                text.push_str(&self.written_weights());
            }
        }
        text.push_str(&self.scopes.written());
        if !edits.is_empty() {
            text.push_str("\n# Corrections by a person.\n");
            let edits = toml::to_string(&Corrections { edits }).unwrap_or_default();
            text.push_str(&edits);
        }
        text
    }

    /// Writes the weights of joints, or a commented example if there are none.
    fn written_weights(&self) -> String {
        let weights = &self.keys.weights;
        if weights.is_empty() {
            return format!("\n{ABOUT_WEIGHTS}# [{WEIGHTS}]\n# \"*Hand*\" = 2.0\n");
        }
        let lines = toml::to_string(weights).expect("names and numbers");
        format!("\n{ABOUT_WEIGHTS}[{WEIGHTS}]\n{lines}")
    }
}

/// Reads the `[footage]` section of a file.
pub(super) fn footage(text: &str) -> Result<Footage, Error> {
    let mut table = DeTable::parse(text).map_err(|error| not_read(text, error))?.into_inner();
    take_footage(text, &mut table)
}

fn take_footage(text: &str, table: &mut DeTable<'_>) -> Result<Footage, Error> {
    let Some((key, said)) = table.remove_entry("footage") else { return Ok(Footage::default()) };
    let place = key.span();
    let footage = Footage::deserialize(said.into_deserializer());
    let footage = footage.map_err(|error| not_read(text, error))?;
    match footage.fault() {
        None => Ok(footage),
        Some(message) => {
            Err(Error::Recipe { place: Some(line_and_column(text, place)), message, source: None })
        }
    }
}

/// Formats a word as TOML: numbers, lists and booleans without quotes.
fn written(word: &str) -> String {
    let is_plain =
        word.starts_with('[') || word.parse::<f64>().is_ok() || word.parse::<bool>().is_ok();
    if is_plain { word.into() } else { Value::from(word).to_string() }
}

#[derive(Serialize)]
struct Corrections<'a> {
    edits: &'a Edits,
}

/// A file being read: its settings are set one by one, by name.
struct File<'a> {
    text: &'a str,
    recipe: Recipe,
    named: BTreeSet<String>,
}

impl File<'_> {
    /// Sets all settings in a table whose names start with `section`.
    fn take(&mut self, section: &str, table: &DeTable<'_>) -> Result<(), Error> {
        for (key, value) in table {
            let own = key.get_ref().as_ref();
            let name = if section.is_empty() { own.to_owned() } else { format!("{section}.{own}") };
            match value.get_ref() {
                DeValue::Table(table) if name == STUDIES => self.take("", table)?,
                DeValue::Table(table) if is_section(&name) => self.take(&name, table)?,
                DeValue::Table(_) => return Err(self.wrong(key.span(), unknown_section(&name))),
                _ => self.set(name, key.span(), value)?,
            }
        }
        Ok(())
    }

    fn set(
        &mut self,
        name: String,
        key: Range<usize>,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<(), Error> {
        let place = if is_known(&name) { value.span() } else { key.clone() };
        let plain = Value::deserialize(value.clone().into_deserializer());
        let word = match plain.map_err(|error| not_read(self.text, error))? {
            Value::String(word) => word,
            plain => plain.to_string(),
        };
        self.recipe.set(&name, &word).map_err(|error| self.wrong(place, error))?;
        if !self.named.insert(name.clone()) {
            return Err(self.wrong(key, Error::setting(name, "is set twice")));
        }
        Ok(())
    }

    fn wrong(&self, place: Range<usize>, error: Error) -> Error {
        let place = Some(line_and_column(self.text, place));
        Error::Recipe { place, message: error.to_string(), source: Some(error.into()) }
    }
}

/// Whether a setting of this name exists.
fn is_known(name: &str) -> bool {
    let knob = Scope::split(name).ok().flatten().map_or(name, |(_, knob)| knob);
    name.starts_with(WEIGHTS) || Knob::find(knob).is_ok()
}

/// Whether this name is a section that holds settings.
fn is_section(name: &str) -> bool {
    name == WEIGHTS || KNOBS.iter().any(|knob| knob.path().0 == Some(name))
}

/// Returns line and column of a place in a text, counted from 1.
fn line_and_column(text: &str, place: Range<usize>) -> (usize, usize) {
    let before = &text[..place.start.min(text.len())];
    let begin = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before.len() - begin + 1)
}

/// Converts an error of the TOML reader, cut to its first line.
fn not_read(text: &str, error: toml::de::Error) -> Error {
    let value = error.span().and_then(|place| unquoted::find_unquoted(text, place.start));
    if let Some(value) = value {
        return needs_quotes(text, value, Some(error));
    }
    Error::Recipe {
        place: error.span().map(|place| line_and_column(text, place)),
        message: in_words(error.message().lines().next().unwrap_or_default()),
        source: Some(error.into()),
    }
}

/// The error for a value that is text without quotes.
fn needs_quotes(text: &str, value: Range<usize>, error: Option<toml::de::Error>) -> Error {
    let place = Some(line_and_column(text, value.clone()));
    let message = unquoted::describe(text, value);
    Error::Recipe { place, message, source: error.map(Into::into) }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use super::*;
    use crate::edits::{CameraCue, Hold, LayerEdits, Move, Pin, Speech};
    use crate::slate::Slate;
    use crate::time::Frame;

    #[test]
    fn the_written_recipe_reads_back_with_its_corrections() {
        let mut recipe = Recipe::default();
        for (name, value) in [
            ("rate", "25"),
            (
                "layers",
                r#"[{ name = "A", joints = ["Hips"] }, { name = "腕", joints = ["*Arm*"] }]"#,
            ),
            ("root", "ones"),
            ("seen_from", "0,150,400:0,90,0"),
            ("feet", "held"),
            ("exaggerate.cartoon", "0.7"),
            ("exaggerate.cartoon_parts", "body"),
            ("speed.measure", "displacement"),
            ("filter.width", "20"),
            ("turns.steady", "5%"),
            ("keys.min_price", "4.5"),
            ("keys.weights.*Hand*", "2"),
            ("actions.shortest", "1.5s"),
            ("keys.weights.odd \"name\" = 1", "0.1"),
            ("spacing.inbetweens", "3"),
            ("omission.max_hold", "5"),
            ("腕/spacing.on", "1-3"),
            ("A/keys.min_price", "12"),
            ("120..240:spacing.on", "1"),
            ("120..240:omission.naka_nashi", "4%"),
            ("腕/90..:spacing.inbetweens", "none"),
            ("outside", "source"),
        ] {
            let before = recipe.clone();
            recipe.set(name, value).unwrap();
            assert_ne!(recipe, before, "{name} is not its default");
        }
        let pin = Pin { weight: Some(0.5), ..Pin::parse("150:top").unwrap() };
        let of_arm = LayerEdits {
            pins: vec![Pin::parse("60:wave").unwrap()],
            forbidden: vec!["9".parse().unwrap()],
            ..LayerEdits::default()
        };
        let edits = Edits {
            pins: vec![pin],
            forbidden: vec!["7".parse().unwrap(), "20..30".parse().unwrap()],
            moves: vec![Move::parse("41:42:hit@0.2").unwrap()],
            holds: vec![Hold::parse("60:4").unwrap()],
            only_pins: true,
            again: true,
            frozen: vec![Frame(12)],
            layers: [("B".to_owned(), of_arm)].into(),
            splits: vec![Frame(40), Frame(120)],
            speech: vec![Speech::parse("12..40:アキ:\"えい\" # = 1").unwrap()],
            camera: vec![CameraCue { frames: [Frame(12), Frame(40)], text: "PAN".into() }],
            at: Some(25),
            length: Some(130),
            slate: Slate { cut: "45A".into(), animator: "アキ".into(), ..Slate::default() },
        };
        let text = recipe.write(&edits);
        assert_eq!(Recipe::parse(&text).unwrap(), (recipe, edits), "{text}");
        let default = Recipe::default().write(&Edits::default());
        assert_eq!(Recipe::parse(&default).unwrap(), (Recipe::default(), Edits::default()));
    }

    #[test]
    fn a_recipe_on_top_of_another_changes_what_it_names_alone() {
        let mut under = Recipe::default();
        under.set("filter.width", "20").unwrap();
        under.set("filter.kind", "gaussian").unwrap();
        let (recipe, edits) =
            under.overlaid("[filter]\nwidth = 30\n[[edits.pins]]\nframe = 7\n").unwrap();
        under.set("filter.width", "30").unwrap();
        assert_eq!(recipe, under);
        assert_eq!(edits.pins[0].frame, Frame(7));
        assert!(under.overlaid("[filter]\nwidht = 30\n").is_err());
    }

    #[test]
    fn a_value_is_what_toml_has_and_stands_in_any_section_that_is_its_own() {
        let same =
            |a: &str, b: &str| assert_eq!(Recipe::parse(a).unwrap(), Recipe::parse(b).unwrap());
        same("[studies]\nturns.side = \"both\"", "[turns]\nside = \"both\"");
        same("[studies.turns]\nside = \"both\"", "turns.side = \"both\"");
        same("rate = 0x18", "rate = 24.0");
        same("[keys]\nper_second = +inf", "[keys]\nper_second = \"inf\"");
        same("[omission]\nnaka_nashi = 1.0", "[omission]\nnaka_nashi = \"100%\"");
        let list = "layers = [{ name = \"A\", joints = [\"Hips\"] }]";
        same("[[layers]]\nname = \"A\"\njoints = [\"Hips\"]", list);
    }

    #[test]
    fn a_wrong_file_is_refused_with_its_place() {
        let error = Recipe::parse("rate = 24\n[filter]\nwitdh = 3\n").unwrap_err();
        let said =
            "recipe: 3:1: filter.witdh: there is no such setting; did you mean filter.width?";
        assert_eq!((error.to_string(), error.position()), (said.into(), Some((3, 1))));
        for (wrong, says) in [
            ("[spacing]\non = 0\n", "2:6: spacing.on: expected koma, 1 (ones) to 1000"),
            ("[filter]\nwidth = []\n", "2:9: filter.width: expected source frames or seconds"),
            ("[filtre]\n", "1:2: filtre: there is no such setting; did you mean filter?"),
            ("[spacng]\non = 2\n", "1:2: spacng: there is no such setting; did you mean spacing?"),
            ("[edit]\n", "did you mean edits?"),
            ("[edits]\npins = [{ frame = -3 }]\n", "`-3`, expected a whole number, 0 or more"),
            ("filter = 3\n", "1:1: filter: there is no such setting"),
            ("layers = []\n", "layers: the list has no layer"),
            ("[keys.weights]\nHips = -1\n", "2:8: keys.weights.Hips: expected a number, 0"),
            (
                "[turns]\nside = \"both\"\n[studies]\nturns.side = \"after\"\n",
                "turns.side: is set twice",
            ),
            ("[edits]\npins = 3\n", "recipe: 2:8: invalid type"),
        ] {
            let error = Recipe::parse(wrong).unwrap_err();
            assert!(error.source().is_some() && error.position().is_some(), "{error:?}");
            let said = error.to_string();
            assert!(said.contains(says), "{said}");
        }
        assert!(Recipe::parse("[spacing\n").is_err());
    }

    #[test]
    fn a_value_without_quotes_is_told_with_what_genga_writes_there() {
        let forbidden = "forbidden = [55, \"120..140\"]";
        let pins = "pins = [{ frame = 42 }]";
        let moves = "moves = [{ from = 79, to = 81 }]";
        for (wrong, value, place, writes) in [
            ("[edits]\nforbidden = [2-3]", "2-3", (2, 14), forbidden),
            ("[edits]\nforbid = [2-3]", "2-3", (2, 11), forbidden),
            ("[edits]\nforbidden = [12, 120..]", "120..", (2, 18), forbidden),
            ("[edits]\nforbidden = [\n  # 1\n  12,\n  ..40 # 2\n]", "..40", (5, 3), forbidden),
            ("edits.forbidden = [12-30]", "12-30", (1, 20), forbidden),
            ("[edits]\nforbidden = [2024-01-02]", "2024-01-02", (2, 14), forbidden),
            ("[edits]\npins = [2-3]", "2-3", (2, 9), pins),
            ("[edits]\npins = [{ frame = 2-3 }]", "2-3", (2, 19), pins),
            ("[edits]\npins = [{ frame = 2, name = top }]", "top", (2, 29), pins),
            ("[edits.layers.B]\npins = [42:top]", "42:top", (2, 9), pins),
            ("[edits]\nmoves = [12:30]", "12:30", (2, 10), moves),
            ("[edits]\nmoves = [41:42]", "41:42", (2, 10), moves),
            ("[spacing]\non = 1-3", "1-3", (2, 6), "\"1-3\""),
            ("turns.steady = 5%", "5%", (1, 16), "\"5%\""),
        ] {
            let error = Recipe::parse(wrong).unwrap_err();
            let said = error.to_string();
            let says = format!("{value} is no number, and text needs quotes");
            assert!(said.contains(&says) && said.ends_with(writes), "{wrong}: {said}");
            assert_eq!(error.position(), Some(place), "{wrong}");
        }
        for (wrong, says) in [
            ("[edits]\npins = [42]", "expected { frame = 42 }"),
            ("[edits]\nagain = True", "True is no switch; write true"),
            ("[edits]\nmoves = [\"41:42\"]", "expected { from = 79, to = 81 }"),
            ("[edits]\nholds = [4]", "expected { frame = 60, koma = 6 }"),
            ("[edits]\nforbidden = [07]", "leading zero"),
            ("[edits]\nspeech = [{ words = \"a, 1-2\\q, b\" }]", "escape"),
            ("rate = ", "1:8"),
            ("[spacing", "1:9"),
        ] {
            let said = Recipe::parse(wrong).unwrap_err().to_string();
            assert!(said.contains(says) && !said.contains("needs quotes"), "{wrong}: {said}");
        }
    }
}
