//! Draws the picture of each koma of a preview.

use glam::DVec3;

use super::Preview;
use super::backdrop::{Backdrop, Room};
use crate::canvas::Inks;
use crate::drawings::drawn_poses;
use crate::figure::Figure;
use crate::paper_point::Point;
use crate::pixels::{Digits, Pixels};
use crate::points::{Posing, Showing};
use crate::side_by_side::{OnScreen, Reel, SideBySide};
use crate::stage::{Bounds, Stage};
use crate::style;
use genga::error::Error;
use genga::sheet::Source;

/// Space above the figures and below the floor, in px.
const TOP: f64 = 44.0;
pub(super) const BOTTOM: f64 = 70.0;
pub(super) const PAD: f64 = 12.0;
/// Ratio of width to height, relative to a panel's, above which the camera follows a motion.
const FAR: f64 = 1.6;
/// Distance of a number's circle from the edge of its panel, and of its middle from the base line, in px.
const NUMBER: (f64, f64) = (16.0, 5.5);

/// The fixed parts of the picture, and the pixels of the current koma.
pub(super) struct Scene<'a> {
    /// The source, if it is beside the sheet.
    source: Option<Posing<'a>>,
    reels: &'a [Reel<'a>],
    /// Poses of each reel.
    showing: Vec<Showing<'a>>,
    /// Number of the drawing on each koma of each reel.
    numbers: Vec<Vec<usize>>,
    /// Whether two versions differ, for each koma.
    differences: Vec<bool>,
    /// Stages of both panels.
    stages: [Stage; 2],
    /// Whether the camera follows the root.
    follows: bool,
    backdrop: Pixels,
    pixels: Pixels,
    small: Digits,
    genga: Digits,
    plain: Digits,
    size: (f64, f64),
    bars: Room,
}

impl<'a> Scene<'a> {
    pub(super) fn new(
        preview: &Preview,
        (cut, shown): (&str, &SideBySide<'_>),
        (reels, figure): (&'a [Reel<'a>], &'a Figure),
        koma: usize,
    ) -> Result<Self, Error> {
        let size = (f64::from(preview.width), f64::from(preview.height));
        let (stage, follows) = stage(preview, reels, figure, size);
        let at = |panel: f64| (size.0 * (0.25 + 0.5 * panel), size.1 - BOTTOM);
        let stages = [0.0, 1.0].map(|panel| Stage { at: at(panel), ..stage.clone() });
        let differences = shown.differences()?;
        let backdrop =
            Backdrop { cut, shown, reels, differences: &differences, koma, size, follows };
        let bars = backdrop.room();
        let backdrop = Pixels::from_svg(&backdrop.draw())?;
        let marks = figure.marks();
        let source = matches!(shown, SideBySide::Source(..))
            .then(|| Posing::new(reels[0].composite.clip(), marks));
        let numbers = |reel: &Reel<'_>| reel.named.koma().map(|drawing| drawing + 1).collect();
        Ok(Self {
            source,
            reels,
            showing: reels.iter().map(|reel| Showing::new(&reel.composite, marks)).collect(),
            numbers: reels.iter().map(numbers).collect(),
            differences,
            stages,
            follows,
            pixels: backdrop.clone(),
            backdrop,
            small: Digits::new(style::WORDS, style::INK),
            genga: Digits::new(style::TITLE, style::GENGA),
            plain: Digits::new(style::TITLE, style::INBETWEEN),
            size,
            bars,
        })
    }

    /// Draws a koma of the film.
    pub(super) fn draw(&mut self, koma: usize) -> &Pixels {
        self.pixels.copy(&self.backdrop);
        let reels = self.reels;
        for (at, reel) in reels.iter().enumerate() {
            let Some(shown) = reel.at(koma) else { continue };
            // A sheet alone stands in the second panel, beside its source.
            let panel = at + 2 - reels.len();
            if panel != at {
                self.source(shown);
            }
            self.drawing((panel, at), shown);
        }
        if self.differences.get(koma) == Some(&true) {
            self.unlike();
        }
        self.small.write(&mut self.pixels, koma + 1, (PAD + 68.0, self.size.1 - 10.0));
        let (head, high) = self.bars.here(koma);
        self.pixels.rect(head, (2.0, high), style::INK);
        &self.pixels
    }

    /// Draws the source of a koma in the first panel.
    fn source(&mut self, shown: OnScreen) {
        let place = self.reels[0].sheet.clock.place_from_koma(shown.koma);
        if let Some(posing) = &mut self.source {
            let pose = posing.points(Source::At(place));
            self.figure(0, &pose);
        }
    }

    /// Draws the figure of a reel in a panel, and the number of its drawing.
    fn drawing(&mut self, (panel, reel): (usize, usize), shown: OnScreen) {
        let pose = self.showing[reel].points(shown.drawing, shown.koma);
        self.figure(panel, &pose);
        let drawing = &self.reels[reel].composite.layer().drawings[shown.drawing];
        let is_kept = drawing.role.is_kept();
        let number = self.numbers[reel][shown.koma];
        let digits = if is_kept { &self.genga } else { &self.plain };
        let edge = 0.5 * self.size.0 * (panel + 1) as f64;
        if self.reels.len() == 1 {
            digits.write(&mut self.pixels, number, (edge - PAD, 28.0));
            return;
        }
        let half = 0.5 * digits.width(number);
        let radius = (half + 3.0).max(12.0);
        let middle = edge - NUMBER.0 - radius;
        digits.write(&mut self.pixels, number, (middle + half, 28.0));
        if is_kept {
            self.pixels.hoop((middle, 28.0 - NUMBER.1), radius, style::GENGA, 1.5);
        }
    }

    /// Marks between the panels that their drawings differ: ≠.
    fn unlike(&mut self) {
        let (x, y) = (0.5 * self.size.0, 24.0);
        self.pixels.rect((x - 11.0, y - 12.0), (22.0, 24.0), style::PAPER);
        for (from, to) in
            [((-7.0, -3.0), (7.0, -3.0)), ((-7.0, 3.0), (7.0, 3.0)), ((4.0, -9.0), (-4.0, 9.0))]
        {
            let at = |(right, down): Point| (x + right, y + down);
            self.pixels.line(at(from), at(to), style::INK, 2.0);
        }
    }

    fn figure(&mut self, panel: usize, pose: &[DVec3]) {
        let mut stage = self.stages[panel].clone();
        if self.follows {
            stage.origin.0 = stage.view.see(pose[0]).0;
            self.ticks(&stage);
        }
        self.pixels.figure(&stage.draw(pose), Inks::Sides);
    }

    /// Draws marks on the floor, half a body's height apart. Without them the movement would not be seen.
    fn ticks(&mut self, stage: &Stage) {
        let step = 0.5 * stage.figure.height;
        let half = (0.25 * self.size.0 - PAD) / stage.scale;
        let (from, to) = ((stage.origin.0 - half) / step, (stage.origin.0 + half) / step);
        // A body without height has no step.
        let count = to - from;
        if count.is_nan() || count > 200.0 {
            return;
        }
        for tick in from.ceil() as i64..=to.floor() as i64 {
            let x = stage.at.0 + (tick as f64 * step - stage.origin.0) * stage.scale;
            let floor = stage.at.1;
            self.pixels.line((x, floor), (x - 5.0, floor + 6.0), style::INBETWEEN, 1.25);
        }
    }
}

/// Computes the stage of a panel, its middle yet to be set, and whether the camera follows the root.
fn stage(
    preview: &Preview,
    reels: &[Reel<'_>],
    figure: &Figure,
    size: (f64, f64),
) -> (Stage, bool) {
    let drawn = |reel: &Reel<'_>| {
        let composite = &reel.composite;
        drawn_poses(composite, figure.marks(), composite.layer().drawings.len())
    };
    let poses: Vec<Vec<DVec3>> = reels.iter().flat_map(drawn).collect();
    let view = preview.camera.view(reels[0].composite.clip(), &poses);
    let bounds = Bounds::new(figure, &view, &poses);
    let room = (0.5 * size.0 - 2.0 * PAD, size.1 - TOP - BOTTOM);
    let follows = bounds.width() / bounds.height().max(1e-9) > FAR * room.0 / room.1;
    let bounds = if follows { against_root(&bounds, figure, &view, &poses) } else { bounds };
    (Stage::filling(figure.clone(), view, &bounds, (0.0, 0.0), room), follows)
}

/// Computes the box round all poses, with their roots on one another.
fn against_root(
    all: &Bounds,
    figure: &Figure,
    view: &genga::motion::seen::view::View,
    poses: &[Vec<DVec3>],
) -> Bounds {
    let half = poses.iter().fold(0.0, |half: f64, pose| {
        let (bounds, root) = (Bounds::new(figure, view, [pose]), view.see(pose[0]).0);
        half.max(bounds.right - root).max(root - bounds.left)
    });
    Bounds { left: -half, right: half, ..*all }
}
