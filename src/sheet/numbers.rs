//! The numbers of drawings: each one's place in its layer, unless they come from an earlier sheet of the cut.

use serde::{Deserialize, Serialize};

use super::{Drawing, Layer, Number, Sheet};
use crate::error::Error;

/// The numbers that a drawing has from an earlier sheet. Without them, its place in the list is its number.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Numbers {
    /// Its number among all drawings of the layer, as in CELL.
    pub drawing: Option<Number>,
    /// Its number among the genga, as in ACTION. An inbetween that was a genga has one too, for when it is one again.
    pub genga: Option<Number>,
}

/// A drawing that an earlier sheet of the cut had and this one has not (欠番). No other drawing gets its numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a drawing that went {\"name\", \"frame\"}")]
pub struct Gone {
    /// Its number among the drawings.
    #[serde(rename = "name")]
    pub drawing: Number,
    /// Its number among the genga, if it was one.
    #[serde(rename = "genga_no", default, skip_serializing_if = "Option::is_none")]
    pub genga: Option<Number>,
    /// Its place in the source, a fractional frame.
    #[serde(rename = "frame")]
    pub place: f64,
}

impl Drawing {
    /// Returns its number; `place` is its place among the drawings of its layer, from 1.
    pub fn number(&self, place: usize) -> Number {
        self.numbers.drawing.clone().unwrap_or_else(|| place.into())
    }

    /// Returns its number as a genga; `place` is its place among the genga of its layer, from 1.
    pub fn genga_number(&self, place: usize) -> Number {
        self.numbers.genga.clone().unwrap_or_else(|| place.into())
    }
}

impl Layer {
    /// Returns the number of each drawing, as in CELL.
    pub fn numbers(&self) -> Vec<Number> {
        let places = (1..).zip(&self.drawings);
        places.map(|(place, drawing)| drawing.number(place)).collect()
    }

    /// Returns the number of each genga and end, which are one series, as in ACTION; `None` for inbetweens.
    pub fn genga_numbers(&self) -> Vec<Option<Number>> {
        let places = self.genga_places().into_iter().zip(&self.drawings);
        places.map(|(place, drawing)| place.map(|place| drawing.genga_number(place))).collect()
    }

    /// Counts genga and ends from 1, without thought of their numbers; `None` for inbetweens.
    pub fn genga_places(&self) -> Vec<Option<usize>> {
        let place = |kept: &mut usize, drawing: &Drawing| {
            *kept += usize::from(drawing.role.is_kept());
            Some(drawing.role.is_kept().then_some(*kept))
        };
        self.drawings.iter().scan(0, place).collect()
    }

    /// Numbers the drawings 1, 2, 3 …, without a thought of earlier sheets.
    pub(super) fn number_plainly(&mut self) {
        self.drawings.iter_mut().for_each(|drawing| drawing.numbers = Numbers::default());
        self.gone.clear();
    }

    /// Whether its drawings are numbered 1, 2, 3 …, without numbers from an earlier sheet.
    pub fn is_plainly_numbered(&self) -> bool {
        self.drawings.iter().all(|drawing| drawing.numbers == Numbers::default())
    }

    /// Checks the numbers, if there are any: every drawing and every genga has one, and they ascend.
    fn check_numbers(&self) -> Result<(), String> {
        if self.is_plainly_numbered() {
            return Ok(());
        }
        let lacks = |drawing: &Drawing| {
            let Numbers { drawing: number, genga } = &drawing.numbers;
            number.is_none() || (genga.is_none() && drawing.role.is_kept())
        };
        if let Some(place) = self.drawings.iter().position(lacks) {
            return Err(format!(
                "drawing {} has no name, or as a genga no genga_no, and others have; name it, as 3a between 3 and 4",
                place + 1
            ));
        }
        let given = self.drawings.iter().map(|drawing| &drawing.numbers);
        let genga: Vec<_> = given.clone().filter_map(|numbers| numbers.genga.as_ref()).collect();
        let drawings: Vec<_> = given.filter_map(|numbers| numbers.drawing.as_ref()).collect();
        let mut pairs = drawings.windows(2).chain(genga.windows(2));
        match pairs.find(|pair| pair[0] >= pair[1]) {
            None => Ok(()),
            Some(pair) => Err(format!(
                "number {} stands before {}; numbers ascend in the order of the drawings, as 3, 3a, 3b, 4",
                pair[0], pair[1]
            )),
        }
    }
}

impl Sheet {
    /// Checks the numbers in layers that have any: every drawing and every genga has one, and they ascend.
    ///
    /// # Errors
    /// [`Error::Sheet`] naming the layer, and what is wrong.
    pub fn check_numbers(&self) -> Result<(), Error> {
        let named = |layer: &Layer| {
            layer
                .check_numbers()
                .map_err(|message| Error::sheet(format!("layer {}: {message}", layer.name)))
        };
        self.layers.iter().try_for_each(named)
    }

    /// Returns the layer of the same name and joints.
    pub fn layer_like(&self, layer: &Layer) -> Option<&Layer> {
        self.layers.iter().find(|own| (&own.name, &own.joints) == (&layer.name, &layer.joints))
    }
}
