//! Builds the flip-book (パラパラ): one HTML file that plays the sheet.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::browser::{self, PageFigure, STEPS, Steps, axes};
use crate::canvas::escaped;
use crate::drawings::{beginning, drawn_poses, seconds_and_koma, shown_as, sliding_poses};
use crate::figure::{Figure, FigureBody};
use crate::points::Posing;
use crate::shared;
use crate::side_by_side::{PlayedOut, Reel, SideBySide, differences, longest, runs};
use genga::error::Error;
use genga::knob::{Knobs, knobs};
use genga::motion::Camera;
use genga::sheet::{Layer, Number, Source};

/// A flip-book (パラパラ): what stands side by side as one self-contained HTML file. It plays, steps by koma and by
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
const SCRIPTS: [&str; 6] = [
    include_str!("flipbook/words.js"),
    browser::FIGURE,
    include_str!("flipbook/reel.js"),
    include_str!("flipbook/sheet.js"),
    include_str!("flipbook/panels.js"),
    include_str!("flipbook/player.js"),
];

/// Data for the player. Koma and drawings count from 0 here.
#[derive(Serialize)]
struct Take<'a> {
    cut: &'a str,
    koma_rate: f64,
    koma: usize,
    length: String,
    /// Koma of the cut before the first one here.
    #[serde(skip_serializing_if = "is_zero")]
    before: usize,
    height: f64,
    points: usize,
    figure: PageFigure,
    camera: &'a str,
    /// Name of each camera, and its axes: right, up, near.
    views: Vec<(&'a str, [[f64; 3]; 3])>,
    /// Source pose of each koma, if the source is beside the sheet: x, y, z of each point, in steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<Vec<Vec<i32>>>,
    sheets: Vec<PageSheet<'a>>,
    /// First koma and number of koma of each passage in which two sheets show different drawings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    differences: Vec<(usize, usize)>,
}

/// Whether nothing is before the first koma.
fn is_zero(before: &usize) -> bool {
    *before == 0
}

/// A sheet of the page.
#[derive(Serialize)]
struct PageSheet<'a> {
    /// Its name, if there are two.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'a str>,
    /// Name of its column; empty for several, whose drawings have a sign.
    column: &'a str,
    /// Genga and drawings of all its columns.
    counts: [usize; 2],
    /// Number of koma of its own cut; after them it holds what stands there.
    koma: usize,
    /// How often the exposures of a loop come again.
    rounds: usize,
    /// Drawing, first koma and number of koma on screen of each exposure.
    cells: Vec<[usize; 3]>,
    drawings: Vec<PageDrawing>,
    /// Pose of each koma from the first exposure on, if held drawings slide.
    #[serde(skip_serializing_if = "Option::is_none")]
    sliding: Option<Vec<Vec<i32>>>,
}

#[derive(Serialize)]
struct PageDrawing {
    /// Number in the CELL column, 3 or "3a", or the sign of a composite.
    number: Called,
    role: &'static str,
    genga: Option<Called>,
    /// Place in the source, to a tenth of a frame.
    frame: f64,
    pinned: bool,
    why: String,
    why_japanese: String,
    omitted: usize,
    pose: Vec<i32>,
}

/// What a drawing is called.
#[derive(Clone, Serialize)]
#[serde(untagged)]
enum Called {
    Number(Number),
    Sign(String),
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
    pub fn draw(&self, cut: &str, shown: &SideBySide<'_>) -> Result<String, Error> {
        self.validate()?;
        let played = match *shown {
            // The page itself plays again and again.
            SideBySide::Source(clip, sheet) => vec![PlayedOut::new(clip, sheet)?.without_blank()],
            SideBySide::Versions(_) => shown.played_out()?,
        };
        let reels = played.iter().map(PlayedOut::reel).collect::<Result<Vec<_>, _>>()?;
        let layers: Vec<_> =
            reels.iter().map(|reel| beginning(reel.composite.layer(), self.most)).collect();
        let take = browser::json_in_script(&self.take((cut, shown), &reels, &layers))?;
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
        (cut, shown): (&'a str, &SideBySide<'a>),
        reels: &'a [Reel<'_>],
        layers: &'a [Cow<'_, Layer>],
    ) -> Take<'a> {
        let clip = reels[0].composite.clip();
        let koma = longest(reels).min(self.most);
        let clock = reels[0].sheet.clock;
        let figure = Figure::new(clip, self.body);
        let source = Posing::new(clip, figure.marks())
            .all((0..koma).map(|koma| Source::At(clock.place_from_koma(koma))));
        let views = Camera::ALL.map(|camera| (camera.word(), camera.view(clip, &source)));
        let steps = Steps::new(&figure, &views[3].1, &source);
        let names = match *shown {
            SideBySide::Source(..) => [None, None],
            SideBySide::Versions(versions) => versions.map(|version| Some(version.name)),
        };
        let sheets = reels.iter().zip(layers).zip(names);
        let differences = differences(reels);
        let whole = names[0].is_none();
        Take {
            cut,
            koma_rate: clock.koma_rate,
            koma,
            length: seconds_and_koma(koma, clock.koma_rate),
            before: shown.koma_before(),
            height: STEPS,
            points: browser::points(&figure, &source[0]).len(),
            figure: PageFigure::new(&figure, &source[0], steps.unit),
            camera: self.camera.word(),
            views: views.into_iter().map(|(word, view)| (word, axes(&view))).collect(),
            source: whole.then(|| source.iter().map(|pose| steps.all(&figure, pose)).collect()),
            sheets: sheets
                .map(|((reel, layer), name)| PageSheet::new(name, reel, layer, (&figure, &steps)))
                .collect(),
            differences: runs(&differences[..koma.min(differences.len())]).collect(),
        }
    }
}

impl<'a> PageSheet<'a> {
    /// Describes a sheet of which the page shows the first koma, `layer`.
    fn new(
        name: Option<&'a str>,
        reel: &Reel<'_>,
        layer: &'a Layer,
        (figure, steps): (&Figure, &Steps),
    ) -> Self {
        let (composite, marks) = (&reel.composite, figure.marks());
        let poses = drawn_poses(composite, marks, layer.drawings.len());
        let sliding = sliding_poses(composite, marks, layer.length());
        let mut cells = shown_as(layer, reel.named);
        reel.signs.give(&mut cells);
        // A drawing that is never shown keeps its own numbers.
        let own = layer.numbers().into_iter().zip(layer.genga_numbers());
        let mut called: Vec<_> = own
            .map(|(number, genga)| (Called::Number(number), genga.map(Called::Number)))
            .collect();
        for cell in &cells {
            called[cell.index] = match cell.is_composite() {
                true => (Called::Sign(cell.sign()), cell.short_genga_sign().map(Called::Sign)),
                false => (Called::Number(cell.number()), cell.genga_number().map(Called::Number)),
            };
        }
        let before = reel.sheet.blank.before;
        let drawings = layer.drawings.iter().zip(&poses).zip(called);
        Self {
            name,
            counts: reel.counts,
            column: if reel.signs.is_empty() { &layer.name } else { "" },
            koma: reel.length(),
            rounds: reel.rounds,
            cells: cells.iter().map(|cell| [cell.index, before + cell.koma, cell.held]).collect(),
            drawings: drawings
                .map(|((drawing, pose), (number, genga))| PageDrawing {
                    number,
                    role: drawing.role.word(),
                    genga,
                    frame: (reel.signs.frame(drawing) * 10.0).round() / 10.0,
                    pinned: drawing.why.pinned.is_some(),
                    why: drawing.why.to_string(),
                    why_japanese: drawing.why.japanese(),
                    omitted: drawing.why.omitted_before,
                    pose: steps.all(figure, pose),
                })
                .collect(),
            sliding: sliding
                .map(|poses| poses.iter().map(|pose| steps.all(figure, pose)).collect()),
        }
    }
}
