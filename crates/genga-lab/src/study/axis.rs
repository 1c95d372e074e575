//! An axis of a study: a setting with a list of values.

use std::str::FromStr;

use crate::study::noise::{NOISE, Noise, SEED};
use crate::study::range;
use genga::error::Error;
use genga::recipe::{Kind, Knob, Recipe, unknown_beside};
use genga::time::{FrameRate, Span};

/// Sections of the recipe that change the sheet and not the keys.
const OF_THE_SHEET: [&str; 2] = ["spacing", "omission"];

/// A setting and the values it takes in a study, written `filter.width=10..60:5`.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    knob: &'static Knob,
    values: Vec<String>,
}

/// Everything that an axis can vary: the recipe, and the noise on the clip.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Setting {
    /// Every setting of the chain.
    pub recipe: Recipe,
    /// The noise added to the clip.
    pub noise: Noise,
}

impl Setting {
    /// Sets a knob, or `noise` or `noise.seed`, from text.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob, or the knob does not accept the value.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
        let text = text.trim();
        match name {
            "noise" => {
                let degrees = text.parse().map_err(|_| NOISE.refusal(text))?;
                let noise = Noise { degrees, ..self.noise };
                noise.validate()?;
                self.noise = noise;
            }
            "noise.seed" => self.noise.seed = text.parse().map_err(|_| SEED.refusal(text))?,
            _ => self.recipe.set(name, text)?,
        }
        Ok(())
    }

    /// Returns a setting's value as text that [`Setting::set`] reads back.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob.
    pub fn get(&self, name: &str) -> Result<String, Error> {
        match name {
            "noise" => Ok(self.noise.degrees.to_string()),
            "noise.seed" => Ok(self.noise.seed.to_string()),
            _ => self.recipe.get(name),
        }
    }
}

impl Axis {
    /// Creates an axis from a knob (any of [`KNOBS`](genga::recipe::KNOBS), `noise` or `noise.seed`) and a list of
    /// values. In the list, a range `FROM..TO:STEP` stands for all values it passes, with its ends if the step lands on
    /// them.
    ///
    /// # Errors
    /// [`Error::Setting`] named after the knob when there is no such knob, when a value is invalid or occurs twice, or
    /// when the list cannot be parsed.
    pub fn new(name: &str, list: &str) -> Result<Self, Error> {
        let knob = find(name)?;
        let mut setting = Setting::default();
        let mut values: Vec<String> = Vec::new();
        for text in range::values(list).map_err(|message| Error::setting(name, message))? {
            setting.set(name, &text)?;
            let value = setting.get(name)?;
            if values.contains(&value) {
                return Err(Error::setting(name, format!("{value} stands twice in \"{list}\"")));
            }
            values.push(value);
        }
        Ok(Self { knob, values })
    }

    /// Returns the knob, with its name, Japanese name and unit.
    pub fn knob(&self) -> &'static Knob {
        self.knob
    }

    /// Returns the setting's name.
    pub fn name(&self) -> &'static str {
        self.knob.name
    }

    /// Whether the setting changes the sheet and not the keys.
    pub fn is_of_the_sheet(&self) -> bool {
        self.knob.path().0.is_some_and(|section| OF_THE_SHEET.contains(&section))
    }

    /// Returns the values, each as a recipe writes it.
    pub fn values(&self) -> &[String] {
        &self.values
    }

    /// Returns the number of values.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are no values, which never happens.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Returns the values as numbers with their common unit (`s`, `%` or empty); `None` if they are words or differ in
    /// unit, and so have no common scale.
    pub fn scale(&self) -> Option<(Vec<f64>, &str)> {
        let unit = unit_of(self.values.first()?);
        let numbers = self.values.iter().map(|value| number_in(value, unit));
        Some((numbers.collect::<Option<_>>()?, unit))
    }

    /// Like [`Axis::nearest`], but converts between seconds and frames at a rate.
    pub fn nearest_at(&self, value: &str, rate: FrameRate) -> Option<usize> {
        let in_other_unit = || {
            let frames = value.parse::<Span>().ok()?.frames(rate);
            let seconds = format!("{}s", frames / rate.fps());
            self.nearest(&frames.to_string()).or_else(|| self.nearest(&seconds))
        };
        let is_span = self.knob.kind == Kind::Span;
        self.nearest(value).or_else(|| is_span.then(in_other_unit)?)
    }

    /// Returns the index of a value on the axis: the same one, or on a scale the nearest if it lies between the least
    /// and the largest.
    pub fn nearest(&self, value: &str) -> Option<usize> {
        if let Some(same) = self.values.iter().position(|own| own == value) {
            return Some(same);
        }
        let (numbers, unit) = self.scale()?;
        let value = number_in(value, unit)?;
        let inside =
            numbers.iter().any(|own| *own <= value) && numbers.iter().any(|own| *own >= value);
        let distance = |at: &usize| (numbers[*at] - value).abs();
        let nearest = (0..numbers.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.filter(|_| inside)
    }
}

impl FromStr for Axis {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let (name, list) = text.split_once('=').ok_or_else(|| {
            Error::setting(text, "an axis is KNOB=VALUES, as in filter.width=10..60:5")
        })?;
        Self::new(name.trim(), list)
    }
}

fn find(name: &str) -> Result<&'static Knob, Error> {
    match name {
        "noise" => Ok(&NOISE),
        "noise.seed" => Ok(&SEED),
        _ => Knob::find(name).map_err(|_| unknown_beside(name, &Noise::AXES)),
    }
}

fn unit_of(value: &str) -> &str {
    match value.chars().next_back() {
        Some('s') => "s",
        Some('%') => "%",
        _ => "",
    }
}

/// Parses a value with the given unit; `None` for another unit, a word, or a number that is not finite.
fn number_in(value: &str, unit: &str) -> Option<f64> {
    let number = value.strip_suffix(unit)?.parse::<f64>().ok()?;
    number.is_finite().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::recipe::KNOBS;

    #[test]
    fn every_knob_may_be_an_axis_and_so_may_noise() {
        let recipe = Recipe::default();
        for knob in KNOBS {
            let value = recipe.get(knob.name).unwrap();
            let axis: Axis = format!("{}={value}", knob.name).parse().unwrap();
            assert_eq!((axis.name(), axis.values()), (knob.name, &[value][..]));
        }
        let axis: Axis = "noise=0..1:0.25".parse().unwrap();
        assert_eq!(axis.values(), ["0", "0.25", "0.5", "0.75", "1"]);
        assert_eq!("noise.seed=1..3:1".parse::<Axis>().unwrap().len(), 3);
    }

    #[test]
    fn values_are_written_as_a_recipe_writes_them() {
        let values = |text: &str| text.parse::<Axis>().unwrap().values().to_vec();
        assert_eq!(values("filter.width=0.10s,07,2.50"), ["0.1s", "7", "2.5"]);
        assert_eq!(values("spacing.inbetweens=none,2"), ["none", "2"]);
        assert_eq!(values("keys.per_second=3,inf"), ["3", "inf"]);
        assert_eq!(values("omission.keep_length=true,false"), ["true", "false"]);
    }

    #[test]
    fn each_way_to_be_wrong_names_the_knob_and_what_would_be_right() {
        for (wrong, says) in [
            ("filter.width", "KNOB=VALUES"),
            ("filter.widht=10", "did you mean filter.width"),
            ("nose=1", "did you mean noise?"),
            ("noise.sed=1", "did you mean noise.seed?"),
            ("filter.width=", "filter.width: a value is missing"),
            ("filter.width=10..60", "filter.width: \"10..60\" has no step"),
            ("filter.width=-5..5:5", "filter.width: expected"),
            ("filter.width=wide", "filter.width: expected"),
            ("filter.kind=box,blur", "one of box, gaussian"),
            ("filter.width=10,10.0", "filter.width: 10 stands twice"),
            ("filter.kind=box,box", "filter.kind: box stands twice"),
            ("spacing.on=1..2:0.5", "spacing.on: expected"),
            ("noise=loud", "noise: expected degrees"),
            ("noise=-1", "noise: expected degrees, 0 to 180"),
            ("noise.seed=0.5", "noise.seed: expected whole number, 0 or more"),
        ] {
            let said = wrong.parse::<Axis>().unwrap_err().to_string();
            assert!(said.contains(says), "{wrong}: {said}");
        }
    }

    #[test]
    fn a_scale_is_numbers_of_one_unit() {
        let scale = |text: &str| {
            let axis: Axis = text.parse().unwrap();
            axis.scale().map(|(numbers, unit)| (numbers, unit.to_owned()))
        };
        assert_eq!(scale("filter.width=10,20"), Some((vec![10.0, 20.0], String::new())));
        assert_eq!(scale("filter.width=0.1s,0.2s"), Some((vec![0.1, 0.2], "s".into())));
        assert_eq!(scale("omission.naka_nashi=0%,4%"), Some((vec![0.0, 4.0], "%".into())));
        for words in ["filter.width=10,0.2s", "filter.kind=box", "keys.per_second=3,inf"] {
            assert_eq!(scale(words), None, "{words}");
        }
    }

    #[test]
    fn a_value_stands_nearest_to_one_that_is_not_beyond_the_ends() {
        let widths: Axis = "filter.width=10..30:10".parse().unwrap();
        for (value, nearest) in [
            ("10", Some(0)),
            ("14", Some(0)),
            ("26", Some(2)),
            ("9", None),
            ("31", None),
            ("0.1s", None),
        ] {
            assert_eq!(widths.nearest(value), nearest, "{value}");
        }
        let rate = FrameRate::new(120.0).unwrap();
        assert_eq!(widths.nearest_at("0.1s", rate), Some(0), "12 frames");
        let seconds: Axis = "filter.width=0.1s,0.2s".parse().unwrap();
        assert_eq!(seconds.nearest_at("23", rate), Some(1));
        let kinds: Axis = "filter.kind=box,ideal".parse().unwrap();
        assert_eq!((kinds.nearest("ideal"), kinds.nearest("gaussian")), (Some(1), None));
    }
}
