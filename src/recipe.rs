//! The recipe: every setting of the chain, one settings struct a stage, in one small TOML file
//! together with a person's corrections.

mod file;
mod knobs;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::error::Error;
use crate::exaggerate::Exaggerate;
use crate::keys::{ActionFinder, Choose, Layers};
use crate::motion::SeenFrom;
use crate::sheet::{Feet, RootMotion};
use crate::signal::{LowPass, Speed, TurnFinder};
use crate::time::KOMA_RATE;
use crate::timing::{Omission, Spacing};

pub use knobs::{KNOBS, Kind, Knob};

/// Koma a second that a sheet may have: fewer would be written as a frame time that reads as a rate, and
/// more are of no use and their table would not fit into memory.
pub(crate) const KOMA_RATES: std::ops::RangeInclusive<f64> = 2.0..=1000.0;

/// What the weight of a joint is set by, in front of its name.
const WEIGHTS: &str = "keys.weights.";

/// Every setting of the chain. The defaults alone give a sheet an animator can use.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Recipe {
    /// Koma a second of the sheet, 2 to 1000; default 24.
    pub rate: f64,
    /// The layers (セル) of the sheet, each with its own keys, spacing and omission. Default: one, the
    /// whole body. More of them let hands and feet hold their own time, and the body falls apart a little:
    /// on a koma not all of it is from one instant.
    pub layers: Layers,
    /// What carries the body through the room while a drawing is held. Default: its drawings. From the
    /// source, `ones`, the travel is smooth, and feet that stand slide as far as the body goes while
    /// their drawing is held.
    pub root: RootMotion,
    /// From where movement is measured; default `world`. On a camera's screen it counts for speeds of
    /// displacement, for the keys and rests of the body, and for what omission leaves out.
    pub seen_from: SeenFrom,
    /// Whether a foot stays where it stands. Default: it is where its drawing has it. Held, it does not slide
    /// as far as the leg reaches, and the legs are no longer the performer's to the last degree.
    pub feet: Feet,
    /// How the motion is exaggerated before all else. Default: not at all.
    pub exaggerate: Exaggerate,
    /// How fast a joint is.
    pub speed: Speed,
    /// How its speed is smoothed.
    pub filter: LowPass,
    /// Where its speed turns.
    pub turns: TurnFinder,
    /// Which turns are keys of the layer.
    pub keys: Choose,
    /// Which actions a take consists of.
    pub actions: ActionFinder,
    /// Where inbetweens stand and what they show.
    pub spacing: Spacing,
    /// What is left out.
    pub omission: Omission,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            rate: KOMA_RATE,
            layers: Layers::default(),
            root: RootMotion::default(),
            seen_from: SeenFrom::World,
            feet: Feet::default(),
            exaggerate: Exaggerate::default(),
            speed: Speed::default(),
            filter: LowPass::default(),
            turns: TurnFinder::default(),
            keys: Choose::default(),
            actions: ActionFinder::default(),
            spacing: Spacing::default(),
            omission: Omission::default(),
        }
    }
}

impl Recipe {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        if !KOMA_RATES.contains(&self.rate) {
            return Err(Error::setting("rate", "must be 2 to 1000 koma a second; 24 is usual"));
        }
        self.layers.validate()?;
        self.seen_from.validate()?;
        self.exaggerate.validate()?;
        self.speed.validate()?;
        self.filter.validate()?;
        self.turns.validate()?;
        self.keys.validate()?;
        self.actions.validate()?;
        self.spacing.validate()?;
        self.omission.validate()
    }

    /// Sets one knob from text, as `--set KEY=VALUE` does; `none` clears one that may be absent.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob, or the value is not one it takes.
    ///
    /// ```
    /// use genga::recipe::Recipe;
    ///
    /// let mut recipe = Recipe::default();
    /// recipe.set("filter.width", "0.2s")?;
    /// assert_eq!(recipe.get("filter.width")?, "0.2s");
    /// assert!(recipe.set("filter.width", "-1").is_err(), "and nothing is changed");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
        if let Some(joint) = name.strip_prefix(WEIGHTS).filter(|joint| !joint.is_empty()) {
            return self.set_weight(joint, text.trim());
        }
        let knob = Knob::find(name)?;
        let mut table = self.table();
        let (section, field) = knob.path();
        let target = match section {
            None => &mut table,
            Some(section) => match table.get_mut(section) {
                Some(Value::Table(table)) => table,
                _ => return Err(Error::setting(name, "is in no section of the recipe")),
            },
        };
        match text.trim() {
            "none" if knob.is_optional() => target.remove(field),
            text => target.insert(field.into(), value_from_text(text)),
        };
        let changed: Self = Value::Table(table).try_into().map_err(|_| knob.refusal(text))?;
        changed.validate()?;
        *self = changed;
        Ok(())
    }

    /// Sets how much joints of a name or pattern count; `none` takes that back.
    fn set_weight(&mut self, joint: &str, text: &str) -> Result<(), Error> {
        let mut weights = self.keys.weights.clone();
        if text == "none" {
            weights.0.remove(joint);
        } else {
            let weight = text.parse().map_err(|_| {
                let message = format!("expected a number, 0 (no say) or more, found \"{text}\"");
                Error::setting(format!("{WEIGHTS}{joint}"), message)
            })?;
            weights.0.insert(joint.into(), weight);
        }
        weights.validate()?;
        self.keys.weights = weights;
        Ok(())
    }

    /// Every setting with its value, in the words of [`Recipe::set`]: all knobs, and the weights of joints
    /// that have one.
    pub fn settings(&self) -> Vec<(String, String)> {
        let table = self.table();
        let knobs = KNOBS.iter().map(|knob| (knob.name.to_owned(), value_in(&table, knob)));
        let weights = self.keys.weights.0.iter();
        let weights =
            weights.map(|(joint, weight)| (format!("{WEIGHTS}{joint}"), weight.to_string()));
        knobs.chain(weights).collect()
    }

    /// A knob's value as text: what [`Recipe::set`] takes back.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob.
    pub fn get(&self, name: &str) -> Result<String, Error> {
        Ok(value_in(&self.table(), Knob::find(name)?))
    }

    fn table(&self) -> Table {
        Table::try_from(self).expect("a recipe is plain numbers, words and tables")
    }
}

/// A knob's value as text.
fn value_in(table: &Table, knob: &Knob) -> String {
    let (section, field) = knob.path();
    let value = match section {
        None => table.get(field),
        Some(section) => table.get(section).and_then(|section| section.get(field)),
    };
    value.map_or_else(|| "none".into(), text_from_value)
}

/// The TOML value that a word on the command line means; in brackets it is a list.
fn value_from_text(text: &str) -> Value {
    let list = || toml::from_str::<Table>(&format!("list = {text}")).ok()?.remove("list");
    if let Some(list) = text.starts_with('[').then(list).flatten() {
        return list;
    }
    match text {
        "true" => Value::Boolean(true),
        "false" => Value::Boolean(false),
        _ => match (text.parse::<i64>(), text.parse::<f64>()) {
            (Ok(whole), _) => Value::Integer(whole),
            (_, Ok(number)) => Value::Float(number),
            _ => Value::String(text.into()),
        },
    }
}

fn text_from_value(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Float(number) => number.to_string(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_knob_gives_what_it_takes() {
        let recipe = Recipe::default();
        for knob in KNOBS {
            let mut again = recipe.clone();
            let value = recipe.get(knob.name).unwrap();
            again.set(knob.name, &value).unwrap_or_else(|error| panic!("{}: {error}", knob.name));
            assert_eq!(again, recipe, "{}", knob.name);
        }
    }

    #[test]
    fn every_field_has_a_knob() {
        let table = Recipe::default().table();
        let fields: usize =
            table.values().map(|value| value.as_table().map_or(1, Table::len)).sum();
        let optional = ["spacing.inbetweens"].len();
        assert_eq!(KNOBS.len(), fields + optional);
    }

    #[test]
    fn wrong_settings_say_what_would_be_right() {
        let mut recipe = Recipe::default();
        let mut error = |name, value| recipe.set(name, value).unwrap_err().to_string();
        assert!(error("filter.widht", "1").contains("filter.width"), "the nearest name is offered");
        assert!(error("filter.kind", "blur").contains("box, gaussian, ideal, butterworth"));
        assert!(error("layers", "limb").contains("one of body, limbs, joints, found \"limb\""));
        assert!(error("layers", "[]").contains("the list has no layer"));
        assert!(error("spacing.on", "0").contains("1 (ones)"));
        assert!(error("spacing.on", "two").contains("spacing.on"));
        for rate in ["-1", "0.9", "1001", "nan"] {
            assert!(error("rate", rate).contains("2 to 1000"), "{rate}");
        }
        assert!(error("omission.naka_nashi", "none").contains("share of its koma"), "0 is none");
        assert_eq!(recipe, Recipe::default(), "nothing was changed");
    }
}
