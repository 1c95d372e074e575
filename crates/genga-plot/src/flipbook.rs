//! Builds the flip-book (パラパラ): one HTML file that plays the sheet.

use serde::{Deserialize, Serialize};

use crate::browser::{self, PageFigure, STEPS, Steps, axes};
use crate::canvas::escaped;
use crate::drawings::{
    beginning, composed, drawn_poses, seconds_and_koma, shown_as, sliding_poses,
};
use crate::figure::{Figure, FigureBody};
use crate::points::Posing;
use crate::shared;
use genga::error::Error;
use genga::knob::{Knobs, knobs};
use genga::motion::{Camera, Clip, Composite, played_out};
use genga::sheet::{Layer, Number, Sheet, Source};

/// A flip-book (パラパラ): source and result as one self-contained HTML file. It plays, steps by koma and by
/// drawing, and turns to every side. In the rounds of a loop (リピート) the body travels on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FlipBook {
    /// Camera at the start; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. Set by `figures.body`, for all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Maximum number of koma, counted from the first, 1 to 100000; default 7200, five minutes.
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

/// Data for the player. Koma and drawings count from 0 here.
#[derive(Serialize)]
struct Take<'a> {
    cut: &'a str,
    column: &'a str,
    koma_rate: f64,
    koma: usize,
    /// How often the exposures of a loop come again.
    rounds: usize,
    length: String,
    height: f64,
    points: usize,
    figure: PageFigure,
    camera: &'a str,
    /// Name of each camera, and its axes: right, up, near.
    views: Vec<(&'a str, [[f64; 3]; 3])>,
    /// Drawing, first koma and number of koma on screen of each exposure.
    cells: Vec<[usize; 3]>,
    drawings: Vec<PageDrawing>,
    /// Source pose of each koma: x, y, z of each point, in steps.
    source: Vec<Vec<i32>>,
    /// Result pose of each koma, in the same form, if held drawings slide.
    #[serde(skip_serializing_if = "Option::is_none")]
    sliding: Option<Vec<Vec<i32>>>,
}

#[derive(Serialize)]
struct PageDrawing {
    role: &'static str,
    /// Number in the CELL column, 3 or "3a".
    number: Number,
    genga: Option<Number>,
    /// Place in the source, to a tenth of a frame.
    frame: f64,
    pinned: bool,
    why: String,
    why_japanese: String,
    omitted: usize,
    pose: Vec<i32>,
}

knobs!(flipbook::FlipBook { camera: shared::CAMERA, most: shared::MOST, ..body });

impl FlipBook {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the number of koma is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Builds the page; `cut` is its title.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`FlipBook::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip and
    /// sheet have nothing to show.
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
        self.validate()?;
        let (named, rounds) = (composed(clip, sheet)?.layer().clone(), sheet.rounds());
        let (clip, sheet) = played_out(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = composed(clip, sheet)?;
        let layer = beginning(composite.layer(), self.most);
        let take = self.take(cut, &composite, sheet, (&layer, &named, rounds));
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
        (layer, named, rounds): (&'a Layer, &Layer, usize),
    ) -> Take<'a> {
        let clip = composite.clip();
        let koma = layer.length();
        let place = |koma| Source::At(sheet.clock.place_from_koma(koma));
        let figure = Figure::new(clip, self.body);
        let marks = figure.marks();
        let source = Posing::new(clip, marks).all((0..koma).map(place));
        let result = drawn_poses(composite, marks, layer.drawings.len());
        let sliding = sliding_poses(composite, marks, koma);
        let views = Camera::ALL.map(|camera| (camera.word(), camera.view(clip, &source)));
        let auto = views[3].1;
        let steps = Steps::new(&figure, &auto, &source);
        let cells = shown_as(layer, named);
        // A drawing that is never shown keeps its own numbers.
        let mut numbers: Vec<_> = layer.numbers().into_iter().zip(layer.genga_numbers()).collect();
        cells.iter().for_each(|cell| numbers[cell.index] = (cell.number(), cell.genga_number()));
        let drawings = layer.drawings.iter().zip(&result).zip(numbers);
        Take {
            cut,
            column: &layer.name,
            koma_rate: sheet.clock.koma_rate,
            koma,
            rounds,
            length: seconds_and_koma(koma, sheet.clock.koma_rate),
            height: STEPS,
            points: browser::points(&figure, &source[0]).len(),
            figure: PageFigure::new(&figure, &source[0], steps.unit),
            camera: self.camera.word(),
            views: views.into_iter().map(|(word, view)| (word, axes(&view))).collect(),
            cells: cells.iter().map(|cell| [cell.index, cell.koma, cell.held]).collect(),
            drawings: drawings
                .map(|((drawing, pose), (number, genga))| PageDrawing {
                    role: drawing.role.word(),
                    number,
                    genga,
                    frame: (drawing.source.place() * 10.0).round() / 10.0,
                    pinned: drawing.why.pinned.is_some(),
                    why: drawing.why.to_string(),
                    why_japanese: drawing.why.japanese(),
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
