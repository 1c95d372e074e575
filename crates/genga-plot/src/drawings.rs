//! Labels the drawings of a sheet for pictures: numbers, koma, names.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::DVec3;

use crate::points::Showing;
use crate::style;
use genga::error::Error;
use genga::motion::{Clip, Composite, Point};
use genga::sheet::{Drawing, Exposure, Layer, Number, Reason, Sheet};

/// A drawing on screen.
#[derive(Debug, Clone, Copy)]
pub struct ShownDrawing<'a> {
    /// The drawing.
    pub drawing: &'a Drawing,
    /// Index in the layer.
    pub index: usize,
    /// Place among the kept drawings, from 1; `None` for an inbetween.
    pub genga: Option<usize>,
    /// Koma on which it begins, from 0.
    pub koma: usize,
    /// Number of koma on screen.
    pub held: usize,
    /// Place among all drawings, from 1.
    place: usize,
    /// Its sign if it is composited from several columns.
    sign: Option<&'a Sign>,
}

impl ShownDrawing<'_> {
    /// Returns the number in the CELL column.
    pub fn number(&self) -> Number {
        self.drawing.number(self.place)
    }

    /// Returns the number in the ACTION column; `None` for an inbetween.
    pub fn genga_number(&self) -> Option<Number> {
        self.genga.map(|place| self.drawing.genga_number(place))
    }

    /// Returns what a picture calls the drawing: its number, or those of the columns that draw anew, of many the first.
    pub(super) fn sign(&self) -> String {
        self.sign.map_or_else(|| self.number().to_string(), |sign| shortened(&sign.drawings))
    }

    /// Returns what a picture calls its genga, with all columns; `None` for an inbetween.
    pub(super) fn genga_sign(&self) -> Option<String> {
        self.genga_sign_by(|names| names.join(" "))
    }

    /// Returns the same for a narrow place: of many columns the first.
    pub(super) fn short_genga_sign(&self) -> Option<String> {
        self.genga_sign_by(shortened)
    }

    fn genga_sign_by(&self, joined: fn(&[String]) -> String) -> Option<String> {
        let number = self.genga_number()?.to_string();
        let genga = self.sign.map(|sign| &*sign.genga).filter(|genga| !genga.is_empty());
        Some(genga.map_or(number, joined))
    }

    /// Whether it is composited from several columns.
    pub(super) fn is_composite(&self) -> bool {
        self.sign.is_some()
    }

    /// Returns half the width of the sign of its genga, in px.
    pub(super) fn reach(&self) -> f64 {
        self.genga_sign().map_or(style::BADGE, |sign| style::badge_reach(&sign))
    }

    /// Whether a person pinned it.
    pub(super) fn is_pinned(&self) -> bool {
        self.drawing.why.pinned.is_some()
    }

    /// Returns, in a few words each, a person's name for the drawing and the reasons why it exists.
    pub(super) fn reasons(&self) -> Vec<String> {
        let why = &self.drawing.why;
        let mut reasons = Vec::new();
        match why.pinned.as_deref() {
            Some("") => reasons.push("pinned".to_owned()),
            Some(name) => reasons.push(name.to_owned()),
            None => {}
        }
        if why.hold_set {
            reasons.push("hold 止め".to_owned());
        }
        if why.omitted_before > 0 {
            reasons.push(format!("left out 抜いた中割 {}", why.omitted_before));
        }
        match why.reason {
            Some(reason @ (Reason::Fill | Reason::Rest | Reason::Contact | Reason::Step)) => {
                reasons.push(format!("{} {}", reason.word(), reason.japanese()));
            }
            Some(Reason::Turn | Reason::Pin) | None => {}
        }
        match &*why.voters {
            [] => {}
            [one] => reasons.push(one.to_string()),
            [first, others @ ..] => reasons.push(format!("{first} +{}", others.len())),
        }
        // There is no room for both.
        if let Some(price) = why.price.filter(|_| why.omitted_before == 0) {
            reasons.push(format!("{price:.1} %"));
        }
        reasons
    }
}

/// Returns the exposures of a layer, labelled.
pub fn shown_drawings(layer: &Layer) -> Vec<ShownDrawing<'_>> {
    let genga = layer.genga_places();
    let cell = |(koma, exposure): (usize, Exposure)| {
        let index = exposure.drawing;
        let drawing = &layer.drawings[index];
        let (genga, held, place) = (genga[index], exposure.koma, index + 1);
        ShownDrawing { drawing, index, genga, koma, held, place, sign: None }
    };
    layer.timed().map(cell).collect()
}

/// Lists the drawings of a loop that is played out, under the numbers that its sheet gives them.
pub(super) fn shown_as<'a>(layer: &'a Layer, named: &Layer) -> Vec<ShownDrawing<'a>> {
    let (on_screen, genga) = (named.koma().collect::<Vec<_>>(), named.genga_places());
    let mut cells = shown_drawings(layer);
    for cell in &mut cells {
        let index = on_screen[cell.koma];
        (cell.place, cell.genga) = (index + 1, genga[index]);
    }
    cells
}

/// The signs of composited drawings, by their koma: the columns that draw anew there, as `A7 C5`. On the timesheet each
/// column has numbers of its own, and a composite has none.
#[derive(Debug)]
pub(super) struct Signs {
    by_koma: BTreeMap<usize, Sign>,
    /// The clip's first frame, and the frames of a round if the sheet repeats.
    first: f64,
    round: Option<f64>,
}

/// The sign of a composited drawing: what it is called in each column that draws anew.
#[derive(Debug, Default)]
struct Sign {
    drawings: Vec<String>,
    genga: Vec<String>,
}

impl Signs {
    /// Names the drawings of a sheet that is not played out; only those of several columns have signs.
    pub(super) fn new(clip: &Clip, sheet: &Sheet) -> Self {
        let columns = columns(sheet);
        let mut signs: BTreeMap<usize, Sign> = BTreeMap::new();
        for column in columns.iter().filter(|_| columns.len() > 1) {
            let between =
                if column.name.ends_with(|last: char| last.is_numeric()) { "-" } else { "" };
            let (numbers, genga) = (column.numbers(), column.genga_numbers());
            for (koma, Exposure { drawing, .. }) in column.timed() {
                let sign = signs.entry(koma).or_default();
                let named = |number: &Number| format!("{}{between}{number}", column.name);
                sign.drawings.push(named(&numbers[drawing]));
                sign.genga.extend(genga[drawing].as_ref().map(named));
            }
        }
        let round = sheet.repeat.map(|repeat| repeat.frames as f64);
        Self { by_koma: signs, first: clip.first().0 as f64, round }
    }

    /// Returns the frame of the clip that a drawing shows. If the sheet is played out, each round is further on.
    pub(super) fn frame(&self, drawing: &Drawing) -> f64 {
        let place = drawing.source.place();
        self.round.map_or(place, |frames| self.first + (place - self.first).rem_euclid(frames))
    }

    /// Whether the sheet has one column, whose drawings need no sign.
    pub(super) fn is_empty(&self) -> bool {
        self.by_koma.is_empty()
    }

    /// Gives the drawings of the composite their signs.
    pub(super) fn give<'a>(&'a self, cells: &mut [ShownDrawing<'a>]) {
        cells.iter_mut().for_each(|cell| cell.sign = self.by_koma.get(&cell.koma));
    }
}

/// Counts the genga and the drawings of all columns of a sheet.
pub(super) fn counts(sheet: &Sheet) -> [usize; 2] {
    let columns = columns(sheet);
    let genga = columns.iter().map(|column| column.genga()).sum();
    [genga, columns.iter().map(|column| column.shown().count()).sum()]
}

/// Returns the columns of a sheet that pose joints.
pub(super) fn columns(sheet: &Sheet) -> Vec<&Layer> {
    let poses = |(at, layer): &(usize, &Layer)| *at == 0 || !layer.joints.is_empty();
    sheet.layers.iter().enumerate().filter(poses).map(|(_, layer)| layer).collect()
}

/// Joins the names of drawings; of more than three the first two, and how many others there are.
fn shortened(names: &[String]) -> String {
    match names {
        [first, second, others @ ..] if others.len() > 1 => {
            format!("{first} {second} +{}", others.len())
        }
        names => names.join(" "),
    }
}

/// Combines all layers of a sheet as figures show them, after checking that they can be shown.
///
/// # Errors
/// [`Error::Sheet`] as in [`Sheet::first_layer`], and if a joint does not exist; [`Error::Picture`] if there
/// is no frame or no joint, or if a drawing's place is not a number.
pub(super) fn composed<'a>(clip: &'a Clip, sheet: &'a Sheet) -> Result<Composite<'a>, Error> {
    check(clip, &sheet.layers)?;
    Composite::new(clip, sheet)
}

/// Returns the layer that curves show, the first, after the check of [`composed`].
///
/// # Errors
/// As [`composed`].
pub(super) fn shown<'a>(clip: &Clip, sheet: &'a Sheet) -> Result<&'a Layer, Error> {
    check(clip, &sheet.layers)?;
    sheet.first_layer()
}

fn check(clip: &Clip, layers: &[Layer]) -> Result<(), Error> {
    if clip.is_empty() || clip.skeleton().is_empty() {
        return Err(style::cannot("a clip without frames or joints has no pose to draw"));
    }
    let mut drawings = layers.iter().flat_map(|layer| &layer.drawings);
    if drawings.all(|drawing| drawing.source.place().is_finite()) {
        Ok(())
    } else {
        Err(style::cannot("a drawing's place in the source must be a number"))
    }
}

/// Returns the first `most` koma of a layer, with the drawings up to the last one seen there. Drawings keep
/// their numbers.
pub(super) fn beginning(layer: &Layer, most: usize) -> Cow<'_, Layer> {
    if layer.length() <= most {
        return Cow::Borrowed(layer);
    }
    let on_screen = layer.timed().take_while(|(koma, _)| *koma < most);
    let exposures: Vec<Exposure> = on_screen
        .map(|(koma, exposure)| Exposure { koma: exposure.koma.min(most - koma), ..exposure })
        .collect();
    let drawings = exposures.iter().map(|exposure| exposure.drawing + 1).max().unwrap_or(0);
    let drawings = layer.drawings[..drawings].to_vec();
    let (name, joints) = (layer.name.clone(), layer.joints.clone());
    Cow::Owned(Layer { name, joints, drawings, exposures, gone: vec![] })
}

/// Returns the points of the first drawings of a composite, each on its first koma on screen.
pub(super) fn drawn_poses(
    composite: &Composite<'_>,
    marks: &[Point],
    drawings: usize,
) -> Vec<Vec<DVec3>> {
    let mut showing = Showing::new(composite, marks);
    let first = composite.first_koma().into_iter().take(drawings).enumerate();
    first.map(|(drawing, koma)| showing.points(drawing, koma)).collect()
}

/// Returns the points on screen koma by koma; `None` if held drawings do not slide.
pub(super) fn sliding_poses(
    composite: &Composite<'_>,
    marks: &[Point],
    koma: usize,
) -> Option<Vec<Vec<DVec3>>> {
    let mut showing = Showing::new(composite, marks);
    let drawings = composite.layer().koma().take(koma).enumerate();
    let poses = drawings.map(|(koma, drawing)| showing.points(drawing, koma));
    composite.slides().then(|| poses.collect())
}

/// Formats a length of time as on a sheet: seconds + koma.
pub fn seconds_and_koma(koma: usize, koma_rate: f64) -> String {
    let second = koma_rate.round().max(1.0) as usize;
    format!("{}+{}", koma / second, koma % second)
}
