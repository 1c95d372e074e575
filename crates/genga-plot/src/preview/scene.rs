//! Draws the picture of each koma of a preview.

use glam::DVec3;

use super::Preview;
use crate::canvas::{Align, Canvas, Inks, Type};
use crate::drawings::{ShownDrawing, drawn_poses, seconds_and_koma, shown_drawings};
use crate::figure::Figure;
use crate::paper_point::Point;
use crate::pixels::{Digits, Pixels};
use crate::points::{Posing, Showing};
use crate::stage::{Bounds, Stage};
use crate::style;
use genga::error::Error;
use genga::motion::Composite;
use genga::sheet::{Layer, Number, Role, Sheet, Source};
use genga::time::Clock;

/// Space above the figures and below the floor, in px.
const TOP: f64 = 44.0;
const BOTTOM: f64 = 70.0;
const PAD: f64 = 12.0;
/// Bars of the sheet: their height, and the distance of their top from the lower edge, in px.
const BARS: (f64, f64) = (10.0, 40.0);
/// Ratio of width to height, relative to a panel's, above which the camera follows a motion.
const FAR: f64 = 1.6;

/// The fixed parts of the pictures.
pub(super) struct Scene {
    /// Stages of source and result.
    stages: [Stage; 2],
    /// Whether the camera follows the root.
    follows: bool,
    backdrop: Pixels,
    small: Digits,
    genga: Digits,
    plain: Digits,
    size: (f64, f64),
    /// Number of koma.
    pub(super) koma: usize,
}

/// What changes from koma to koma.
pub(super) struct Moment {
    /// Koma of the cut.
    koma: usize,
    /// What is on screen; `None` on a blank koma.
    shown: Option<Shown>,
}

/// Source and result on a koma.
struct Shown {
    poses: [Vec<DVec3>; 2],
    /// Number under which the drawing is known.
    number: Number,
    is_kept: bool,
}

/// Poses the figures, koma by koma.
pub(super) struct Cast<'a> {
    posing: Posing<'a>,
    showing: Showing<'a>,
    clock: Clock,
    layer: &'a Layer,
    /// Drawing on each koma of the sheet, and the number under which it is known.
    drawings: Vec<(usize, Number)>,
    /// Blank koma before the first drawing.
    before: usize,
}

impl<'a> Cast<'a> {
    /// Prepares the poses; `numbers` has the number of the drawing on each koma of the sheet.
    pub(super) fn new(
        (composite, figure): (&'a Composite<'a>, &'a Figure),
        sheet: &Sheet,
        numbers: impl Iterator<Item = Number>,
    ) -> Self {
        let layer = composite.layer();
        Self {
            posing: Posing::new(composite.clip(), figure.marks()),
            showing: Showing::new(composite, figure.marks()),
            clock: sheet.clock,
            layer,
            drawings: layer.koma().zip(numbers).collect(),
            before: sheet.blank.before,
        }
    }

    /// Poses the figures of a koma of the cut.
    pub(super) fn at(&mut self, koma: usize) -> Moment {
        let own = koma.checked_sub(self.before);
        let drawing = own.and_then(|own| Some((own, self.drawings.get(own)?.clone())));
        let shown = drawing.map(|(own, (drawing, number))| {
            let source = Source::At(self.clock.place_from_koma(own));
            let poses = [self.posing.points(source), self.showing.points(drawing, own)];
            Shown { poses, number, is_kept: self.layer.drawings[drawing].role.is_kept() }
        });
        Moment { koma, shown }
    }
}

impl Scene {
    /// Builds the scene of the first `koma` koma of a cut.
    pub(super) fn new(
        preview: &Preview,
        cut: &str,
        (composite, figure): (&Composite<'_>, &Figure),
        sheet: &Sheet,
        koma: usize,
    ) -> Result<Self, Error> {
        let size = (f64::from(preview.width), f64::from(preview.height));
        let layer = composite.layer();
        let (stage, follows) = stage(preview, composite, figure, size);
        let at = |panel: f64| (size.0 * (0.25 + 0.5 * panel), size.1 - BOTTOM);
        let stages = [0.0, 1.0].map(|panel| Stage { at: at(panel), ..stage.clone() });
        let mut cells = shown_drawings(layer);
        cells.iter_mut().for_each(|cell| cell.koma += sheet.blank.before);
        let backdrop = Pixels::from_svg(&backdrop(cut, sheet, layer, &cells, koma, size, follows))?;
        Ok(Self {
            stages,
            follows,
            backdrop,
            small: Digits::new(style::WORDS, style::INK),
            genga: Digits::new(style::TITLE, style::GENGA),
            plain: Digits::new(style::TITLE, style::INBETWEEN),
            size,
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
        if let Some(Shown { poses, number, is_kept }) = &moment.shown {
            poses.iter().enumerate().for_each(|(panel, pose)| self.figure(pixels, panel, pose));
            let digits = if *is_kept { &self.genga } else { &self.plain };
            digits.write(pixels, number, (self.size.0 - PAD, 28.0));
        }
        let height = self.size.1;
        self.small.write(pixels, &(moment.koma + 1).into(), (PAD + 68.0, height - 10.0));
        let bar = bar_width(self.size, self.koma);
        let x = PAD + bar * (moment.koma as f64 + 0.5);
        let (high, up) = BARS;
        let head = (x - 1.0, height - up - 4.0);
        pixels.rect(head, (2.0, high + 8.0), style::INK);
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
    composite: &Composite<'_>,
    figure: &Figure,
    size: (f64, f64),
) -> (Stage, bool) {
    let clip = composite.clip();
    let poses = drawn_poses(composite, figure.marks(), composite.layer().drawings.len());
    let view = preview.camera.view(clip, &poses);
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

fn bar_width((width, _): (f64, f64), koma: usize) -> f64 {
    (width - 2.0 * PAD) / koma as f64
}

/// Draws the parts that are the same on every koma: words, floors, the sheet as bars.
fn backdrop(
    cut: &str,
    sheet: &Sheet,
    layer: &Layer,
    cells: &[ShownDrawing<'_>],
    koma: usize,
    size: (f64, f64),
    follows: bool,
) -> String {
    let (width, height) = size;
    let half = 0.5 * width;
    let mut canvas = Canvas::new(size);
    let floor = height - BOTTOM;
    for (panel, words) in [(0.0, "source 素材"), (1.0, "result 結果")] {
        let x = panel * half;
        canvas.text(words, (x + PAD, 27.0), Type::new(style::WORDS).bold());
        canvas.line((x + PAD, floor), (x + half - PAD, floor), style::RAW, 1.25);
    }
    canvas.line((half, 12.0), (half, floor), style::GRID, 1.0);
    let look = Type::new(style::SMALL).color(style::FAINT).align(Align::Right);
    canvas.text("drawing 動画", (width - PAD - 46.0, 27.0), look);
    if follows {
        canvas.text("camera goes along", (half - PAD, 27.0), look);
    }
    bars(&mut canvas, cells, koma, size);
    let base = height - 10.0;
    canvas.text("koma", (PAD, base), Type::new(style::WORDS).color(style::FAINT));
    let whole = sheet.blank.before + layer.length() + sheet.blank.after;
    let length = seconds_and_koma(whole, sheet.clock.koma_rate);
    let more = if koma < whole { format!(", the first {koma} shown") } else { String::new() };
    let of = format!("of {whole} (尺 {length}){more}");
    let faint = Type::new(style::WORDS).color(style::FAINT);
    canvas.text(&of, (PAD + 76.0, base), faint);
    let left = PAD + 90.0 + style::text_width(&of, style::WORDS);
    let cut = style::fitted(cut, style::WORDS, width - PAD - left);
    canvas.text(&cut, (width - PAD, base), faint.align(Align::Right));
    canvas.finish()
}

/// Draws a bar for each exposure, coloured by its role.
fn bars(canvas: &mut Canvas, cells: &[ShownDrawing<'_>], koma: usize, size: (f64, f64)) {
    let one = bar_width(size, koma);
    let (high, up) = BARS;
    let y = size.1 - up;
    for cell in cells.iter().take_while(|cell| cell.koma < koma) {
        let held = cell.held.min(koma - cell.koma);
        let from: Point = (PAD + one * cell.koma as f64, y);
        let color = match cell.drawing.role {
            Role::Inbetween => style::mixed(style::INBETWEEN, style::PAPER, 0.5),
            role => style::of_role(role),
        };
        let gap = if one >= 3.0 { 1.0 } else { 0.0 };
        canvas.rect(from, (from.0 + one * held as f64 - gap, y + high), color);
    }
}
