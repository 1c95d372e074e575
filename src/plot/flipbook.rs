//! The flip-book (パラパラ): one HTML file that plays the sheet.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, knobs};
use crate::motion::{Camera, Clip, Composite};
use crate::plot::browser::{self, PageFigure, STEPS, Steps, axes};
use crate::plot::canvas::escaped;
use crate::plot::drawings::{
    beginning, composed, drawn_poses, seconds_and_koma, shown_drawings, sliding_poses,
};
use crate::plot::figure::{Figure, FigureBody};
use crate::plot::points::Posing;
use crate::plot::shared;
use crate::sheet::{Layer, Sheet, Source};

/// A flip-book (パラパラ): source and result as one HTML file that needs nothing else, to play, to step
/// through by koma and by drawing, and to look at from every side.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FlipBook {
    /// From where it is seen first; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. The setting `figures.body` is that of all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Koma at most, from the first on, 1 to 100000; default 7200, five minutes.
    pub most: usize,
}

impl Default for FlipBook {
    fn default() -> Self {
        Self { camera: Camera::Auto, body: FigureBody::default(), most: 7200 }
    }
}

const PAGE: &str = include_str!("flipbook/page.html");
const LOOK: &str = include_str!("flipbook/look.css");
const SCRIPTS: [&str; 4] = [
    include_str!("flipbook/words.js"),
    browser::FIGURE,
    include_str!("flipbook/sheet.js"),
    include_str!("flipbook/player.js"),
];

/// What the player gets. Koma and drawings count from 0 here.
#[derive(Serialize)]
struct Take<'a> {
    cut: &'a str,
    column: &'a str,
    koma_rate: f64,
    koma: usize,
    length: String,
    height: f64,
    points: usize,
    figure: PageFigure,
    camera: &'a str,
    /// Of each camera right, up and near.
    views: Vec<(&'a str, [[f64; 3]; 3])>,
    /// Drawing, first koma, koma on screen.
    cells: Vec<[usize; 3]>,
    drawings: Vec<PageDrawing>,
    /// A pose a koma: x, y, z of each point, in steps.
    source: Vec<Vec<i32>>,
    /// The result so, where a held drawing slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    sliding: Option<Vec<Vec<i32>>>,
}

#[derive(Serialize)]
struct PageDrawing {
    role: &'static str,
    genga: Option<usize>,
    /// The place in the source, to a tenth of a frame.
    frame: f64,
    pinned: bool,
    why: String,
    omitted: usize,
    pose: Vec<i32>,
}

knobs!(flipbook::FlipBook { camera: shared::CAMERA, most: shared::MOST, ..body });

impl FlipBook {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for no koma or too many.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Makes the page; `cut` is its title.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`FlipBook::validate`]; [`Error::Sheet`] or [`Error::Picture`] when clip and
    /// sheet have nothing to show.
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
        self.validate()?;
        let composite = composed(clip, sheet)?;
        let layer = beginning(composite.layer(), self.most);
        let take = self.take(cut, &composite, sheet, &layer);
        let take = browser::json_in_script(&take)?;
        let filled = [
            ("{{title}}", escaped(cut)),
            ("{{look}}", LOOK.to_owned()),
            ("{{take}}", take),
            ("{{script}}", SCRIPTS.concat()),
        ];
        Ok(browser::fill(PAGE, &filled))
    }

    fn take<'a>(
        &'a self,
        cut: &'a str,
        composite: &Composite<'_>,
        sheet: &Sheet,
        layer: &'a Layer,
    ) -> Take<'a> {
        let clip = composite.clip();
        let koma = layer.length();
        let place = |koma| Source::At(sheet.clock.place_from_koma(koma));
        let figure = Figure::of(clip, self.body);
        let marks = figure.marks();
        let source = Posing::of(clip, marks).all((0..koma).map(place));
        let result = drawn_poses(composite, marks, layer.drawings.len());
        let sliding = sliding_poses(composite, marks, koma);
        let views = Camera::ALL.map(|camera| (camera.word(), camera.view(clip, &source)));
        let auto = views[3].1;
        let steps = Steps::of(&figure, &auto, &source);
        let cells = shown_drawings(layer);
        let drawings = layer.drawings.iter().zip(&result).zip(layer.genga_numbers());
        Take {
            cut,
            column: &layer.name,
            koma_rate: sheet.clock.koma_rate,
            koma,
            length: seconds_and_koma(koma, sheet.clock.koma_rate),
            height: STEPS,
            points: browser::points(&figure, &source[0]).len(),
            figure: PageFigure::of(&figure, &source[0], steps.unit),
            camera: self.camera.word(),
            views: views.into_iter().map(|(word, view)| (word, axes(&view))).collect(),
            cells: cells.iter().map(|cell| [cell.index, cell.koma, cell.held]).collect(),
            drawings: drawings
                .map(|((drawing, pose), genga)| PageDrawing {
                    role: drawing.role.word(),
                    genga,
                    frame: (drawing.source.place() * 10.0).round() / 10.0,
                    pinned: drawing.why.pinned.is_some(),
                    why: drawing.why.to_string(),
                    omitted: drawing.why.omitted_before,
                    pose: steps.all(&figure, pose),
                })
                .collect(),
            source: source.iter().map(|pose| steps.all(&figure, pose)).collect(),
            sliding: sliding
                .map(|poses| poses.iter().map(|pose| steps.all(&figure, pose)).collect()),
        }
    }
}
