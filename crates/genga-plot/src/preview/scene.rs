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
use crate::side_by_side::{Reel, SideBySide, differences};
use crate::stage::{Bounds, Stage};
use crate::style;
use genga::error::Error;
use genga::sheet::{Number, Source};

/// Space above the figures and below the floor, in px.
const TOP: f64 = 44.0;
pub(super) const BOTTOM: f64 = 70.0;
pub(super) const PAD: f64 = 12.0;
/// Ratio of width to height, relative to a panel's, above which the camera follows a motion.
const FAR: f64 = 1.6;

/// The fixed parts of the pictures.
pub(super) struct Scene {
    /// Whether two versions differ, for each koma.
    differences: Vec<bool>,
    /// Stages of both panels.
    stages: [Stage; 2],
    /// Whether the camera follows the root.
    follows: bool,
    backdrop: Pixels,
    small: Digits,
    genga: Digits,
    plain: Digits,
    /// Right end of the number in each panel, in px.
    number_ends: [f64; 2],
    size: (f64, f64),
    bars: Room,
    /// Number of koma.
    pub(super) koma: usize,
}

/// What changes from koma to koma.
pub(super) struct Moment {
    /// Koma of the film.
    koma: usize,
    /// What stands in each panel; `None` on a blank koma.
    panels: [Option<Shown>; 2],
}

/// What a panel shows on a koma.
struct Shown {
    pose: Vec<DVec3>,
    /// Number under which the drawing is known, and whether it is a key; `None` for the source and several columns.
    drawing: Option<(Number, bool)>,
}

/// Poses the figures, koma by koma.
pub(super) struct Cast<'a> {
    /// The source, if it is beside the sheet.
    source: Option<Posing<'a>>,
    reels: &'a [Reel<'a>],
    /// Poses of each reel.
    showing: Vec<Showing<'a>>,
    /// Number of the drawing on each koma of each reel; none for several columns, which have numbers of their own.
    numbers: Vec<Vec<Number>>,
}

impl<'a> Cast<'a> {
    /// Prepares the poses.
    pub(super) fn new(shown: &SideBySide<'_>, reels: &'a [Reel<'a>], figure: &'a Figure) -> Self {
        let marks = figure.marks();
        let source = matches!(shown, SideBySide::Source(..))
            .then(|| Posing::new(reels[0].composite.clip(), marks));
        let numbers = |reel: &Reel<'_>| {
            if !reel.signs.is_empty() {
                return Vec::new();
            }
            let numbers = reel.named.numbers();
            reel.named.koma().map(|drawing| numbers[drawing].clone()).collect()
        };
        Self {
            source,
            reels,
            showing: reels.iter().map(|reel| Showing::new(&reel.composite, marks)).collect(),
            numbers: reels.iter().map(numbers).collect(),
        }
    }

    /// Poses the figures of a koma of the film.
    pub(super) fn at(&mut self, koma: usize) -> Moment {
        let mut panels = [None, None];
        for (at, reel) in self.reels.iter().enumerate() {
            let Some(on_screen) = reel.at(koma) else { continue };
            if let Some(posing) = &mut self.source {
                let place = reel.sheet.clock.place_from_koma(on_screen.koma);
                panels[0] = Some(Shown { pose: posing.points(Source::At(place)), drawing: None });
            }
            let pose = self.showing[at].points(on_screen.drawing, on_screen.koma);
            let is_kept = reel.composite.layer().drawings[on_screen.drawing].role.is_kept();
            let number = self.numbers[at].get(on_screen.koma);
            let drawing = number.map(|number| (number.clone(), is_kept));
            // A sheet alone stands in the second panel, beside its source.
            panels[at + 2 - self.reels.len()] = Some(Shown { pose, drawing });
        }
        Moment { koma, panels }
    }
}

impl Scene {
    /// Builds the scene of the first `koma` koma of a film.
    pub(super) fn new(
        preview: &Preview,
        (cut, shown): (&str, &SideBySide<'_>),
        (reels, figure): (&[Reel<'_>], &Figure),
        koma: usize,
    ) -> Result<Self, Error> {
        let size = (f64::from(preview.width), f64::from(preview.height));
        let (stage, follows) = stage(preview, reels, figure, size);
        let at = |panel: f64| (size.0 * (0.25 + 0.5 * panel), size.1 - BOTTOM);
        let stages = [0.0, 1.0].map(|panel| Stage { at: at(panel), ..stage.clone() });
        let differences = differences(reels);
        let backdrop =
            Backdrop { cut, shown, reels, differences: &differences, koma, size, follows };
        let bars = backdrop.room();
        let number_ends = [0, 1].map(|panel| backdrop.number_end(panel));
        let backdrop = Pixels::from_svg(&backdrop.draw())?;
        Ok(Self {
            differences,
            stages,
            follows,
            backdrop,
            small: Digits::new(style::WORDS, style::INK),
            genga: Digits::new(style::TITLE, style::GENGA),
            plain: Digits::new(style::TITLE, style::INBETWEEN),
            number_ends,
            size,
            bars,
            koma,
        })
    }

    /// Returns the picture without figures.
    pub(super) fn backdrop(&self) -> &Pixels {
        &self.backdrop
    }

    /// Draws a koma onto pixels of the backdrop's size.
    pub(super) fn draw(&self, moment: &Moment, pixels: &mut Pixels) {
        pixels.copy(&self.backdrop);
        for (panel, shown) in moment.panels.iter().enumerate() {
            let Some(Shown { pose, drawing }) = shown else { continue };
            self.figure(pixels, panel, pose);
            if let Some((number, is_kept)) = drawing {
                let digits = if *is_kept { &self.genga } else { &self.plain };
                digits.write(pixels, number, (self.number_ends[panel], 28.0));
            }
        }
        if self.differences.get(moment.koma) == Some(&true) {
            self.unlike(pixels);
        }
        self.small.write(pixels, &(moment.koma + 1).into(), (PAD + 68.0, self.size.1 - 10.0));
        let (head, high) = self.bars.here(moment.koma);
        pixels.rect(head, (2.0, high), style::INK);
    }

    /// Marks between the panels that their drawings differ: ≠.
    fn unlike(&self, pixels: &mut Pixels) {
        let (x, y) = (0.5 * self.size.0, 24.0);
        pixels.rect((x - 11.0, y - 12.0), (22.0, 24.0), style::PAPER);
        for (from, to) in
            [((-7.0, -3.0), (7.0, -3.0)), ((-7.0, 3.0), (7.0, 3.0)), ((4.0, -9.0), (-4.0, 9.0))]
        {
            let at = |(right, down): Point| (x + right, y + down);
            pixels.line(at(from), at(to), style::INK, 2.0);
        }
    }

    fn figure(&self, pixels: &mut Pixels, panel: usize, pose: &[DVec3]) {
        let mut stage = self.stages[panel].clone();
        if self.follows {
            stage.origin.0 = stage.view.see(pose[0]).0;
            self.ticks(pixels, &stage);
        }
        pixels.figure(&stage.draw(pose), Inks::Sides);
    }

    /// Draws marks on the floor, half a body's height apart. Without them the movement would not be seen.
    fn ticks(&self, pixels: &mut Pixels, stage: &Stage) {
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
            pixels.line((x, floor), (x - 5.0, floor + 6.0), style::INBETWEEN, 1.25);
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
