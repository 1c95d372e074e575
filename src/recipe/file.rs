//! The recipe as a file (ファイル): TOML with a comment for every knob, and a person's corrections beside it.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::knobs::KNOBS;
use super::{Recipe, value_from_text};
use crate::edits::Edits;
use crate::error::Error;
use crate::exaggerate::Exaggerate;
use crate::keys::{ActionFinder, Choose, Layers};
use crate::motion::SeenFrom;
use crate::sheet::{Feet, RootMotion};
use crate::signal::{LowPass, Speed, TurnFinder};
use crate::time::KOMA_RATE;
use crate::timing::{Omission, Spacing};

/// The knob behind which they are written: a table in a section comes after its values.
const LAST_OF_KEYS: &str = "keys.per_second";

/// What a written recipe says of them.
const ABOUT_WEIGHTS: &str = "\
# 部位の重み — How much joints count, by name or by pattern (* any letters, ? one): 0 has no say, 2 counts
# twice; a joint that none fits has 1. A whole name goes before a pattern, more letters before fewer.
";

impl Recipe {
    /// A recipe and corrections from TOML. Settings that are not named keep their defaults.
    ///
    /// # Errors
    /// [`Error::Recipe`] with line and column when it is no TOML, names a setting that does not exist
    /// or gives one a value of another kind; [`Error::Setting`] when a value is out of its range.
    ///
    /// ```
    /// use genga::recipe::Recipe;
    ///
    /// let (recipe, edits) = Recipe::parse("rate = 12\n[edits]\npins = [{ frame = 42 }]")?;
    /// assert_eq!((recipe.rate, edits.pins[0].frame.0), (12.0, 42));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<(Self, Edits), Error> {
        let file: File = toml::from_str(text).map_err(|error| located(text, &error))?;
        let recipe = file.recipe();
        recipe.validate()?;
        Ok((recipe, file.edits))
    }

    /// [`Recipe::parse`] on top of this recipe: settings that are not named keep its values.
    ///
    /// # Errors
    /// Those of [`Recipe::parse`].
    pub fn overlaid(&self, text: &str) -> Result<(Self, Edits), Error> {
        // First by itself: its errors know their place in the file.
        let (_, edits) = Self::parse(text)?;
        let mut table = self.table();
        let named: Table = toml::from_str(text).map_err(|error| located(text, &error))?;
        for (section, value) in named.into_iter().filter(|(section, _)| section != "edits") {
            match (table.get_mut(&section), value) {
                (Some(Value::Table(under)), Value::Table(over)) => under.extend(over),
                (_, value) => drop(table.insert(section, value)),
            }
        }
        let recipe = Value::Table(table).try_into().map_err(|error| located(text, &error))?;
        Ok((recipe, edits))
    }

    /// The recipe with a comment for every knob, and the corrections, as TOML that
    /// [`Recipe::parse`] reads back.
    pub fn write(&self, edits: &Edits) -> String {
        let mut text = String::from(
            "# A genga recipe: every setting of the chain. What is not named keeps its default.\n\
             # Lengths of time are source frames (20) or seconds (\"0.2s\").\n",
        );
        let mut section = None;
        for knob in KNOBS {
            let (inside, field) = knob.path();
            if inside != section {
                text.push_str(&format!("\n[{}]\n", inside.unwrap_or_default()));
                section = inside;
            } else {
                text.push('\n');
            }
            knob.comment().lines().for_each(|line| text.push_str(&format!("# {line}\n")));
            match self.get(knob.name).as_deref() {
                Ok("none") | Err(_) => text.push_str(&format!("# {field} = none\n")),
                Ok(value) => text.push_str(&format!("{field} = {}\n", value_from_text(value))),
            }
            if knob.name == LAST_OF_KEYS {
                text.push_str(&self.written_weights());
            }
        }
        if !edits.is_empty() {
            text.push_str("\n# Corrections by a person.\n");
            let edits = toml::to_string(&Corrections { edits }).unwrap_or_default();
            text.push_str(&edits);
        }
        text
    }

    /// The weights of joints; an example where there are none.
    fn written_weights(&self) -> String {
        let weights = &self.keys.weights;
        if weights.is_empty() {
            return format!("\n{ABOUT_WEIGHTS}# [keys.weights]\n# \"*Hand*\" = 2.0\n");
        }
        let lines = toml::to_string(weights).expect("names and numbers");
        format!("\n{ABOUT_WEIGHTS}[keys.weights]\n{lines}")
    }
}

/// The file: the recipe's sections and the corrections side by side.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct File {
    rate: Option<f64>,
    layers: Layers,
    root: RootMotion,
    seen_from: SeenFrom,
    feet: Feet,
    exaggerate: Exaggerate,
    speed: Speed,
    filter: LowPass,
    turns: TurnFinder,
    keys: Choose,
    actions: ActionFinder,
    spacing: Spacing,
    omission: Omission,
    edits: Edits,
}

impl File {
    fn recipe(&self) -> Recipe {
        Recipe {
            rate: self.rate.unwrap_or(KOMA_RATE),
            layers: self.layers.clone(),
            root: self.root,
            seen_from: self.seen_from,
            feet: self.feet,
            exaggerate: self.exaggerate.clone(),
            speed: self.speed.clone(),
            filter: self.filter.clone(),
            turns: self.turns.clone(),
            keys: self.keys.clone(),
            actions: self.actions.clone(),
            spacing: self.spacing.clone(),
            omission: self.omission,
        }
    }
}

#[derive(Serialize)]
struct Corrections<'a> {
    edits: &'a Edits,
}

/// An error of the TOML reader as one line with the place in the file.
fn located(text: &str, error: &toml::de::Error) -> Error {
    let place = error.span().map(|span| {
        let before = &text[..span.start.min(text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.len() - before.rfind('\n').map_or(0, |newline| newline + 1) + 1;
        format!("{line}:{column}: ")
    });
    let message = error.message().lines().next().unwrap_or_default();
    Error::Recipe { message: format!("{}{message}", place.unwrap_or_default()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edits::{Hold, LayerEdits, Move, Pin};
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
            layers: [("B".to_owned(), of_arm)].into(),
            splits: vec![Frame(40), Frame(120)],
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
    fn a_wrong_file_is_refused_with_its_place() {
        let error = Recipe::parse("rate = 24\n[filter]\nwitdh = 3\n").unwrap_err().to_string();
        assert!(error.starts_with("recipe: 3:1: unknown field `witdh`"), "{error}");
        assert!(Recipe::parse("[spacing]\non = 0\n").is_err());
        assert!(Recipe::parse("[spacing\n").is_err());
    }
}
