//! Draws poses in a row.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Inks, Type};
use crate::chart::number;
use crate::drawings::{ShownDrawing, Signs, composed, shown_drawings};
use crate::figure::{Figure, FigureBody};
use crate::legend::SIDES;
use crate::page_head;
use crate::paper_point::Point;
use crate::points::{Posing, Showing};
use crate::stage::{Bounds, Stage, fitting, largest};
use crate::style;
use crate::title::{self, Title};
use genga::error::Error;
use genga::motion::{Camera, Clip, first_round};
use genga::sheet::{Role, Sheet, Source};

/// Figures of some drawings, side by side, on one floor and of one scale.
///
/// Each figure stands in the middle of its own cell; its place in the world is not shown.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PoseRow {
    /// Name of the clip, below the title; default empty, not shown.
    pub clip: String,
    /// Maximum width in px, 200 to 20000; default 960.
    pub width: u32,
    /// Height of the tallest figure in px, 40 to 2000; default 170.
    pub figure_height: u32,
    /// Maximum number of figures on a line, 1 to 1000; default 12. Wide poses reduce it.
    pub in_line: usize,
    /// Maximum number of figures, counted from the first, 1 to 1000; default 300. The picture says if some
    /// are left out.
    pub most: usize,
    /// How figures are drawn; default mannequin.
    #[serde(skip)]
    pub body: FigureBody,
    /// Camera of the figures; default auto.
    pub camera: Camera,
}

impl Default for PoseRow {
    fn default() -> Self {
        Self {
            clip: String::new(),
            width: style::WIDTH,
            figure_height: 170,
            in_line: 12,
            most: 300,
            body: FigureBody::default(),
            camera: Camera::Auto,
        }
    }
}

const HEAD: f64 = title::HIGH + 4.0;
const GAP: f64 = 14.0;
/// Heights below the floor of a line's labels and of the number in a circle above them, in px.
const LABELS: f64 = 42.0;
const NUMBER: f64 = 24.0;
const BETWEEN_LINES: f64 = 16.0;
/// Minimum width of a picture in px, so that its title fits.
const NARROWEST: f64 = 380.0;

/// The words below a figure.
struct Label {
    /// Number of the genga in a circle, and whether a person pinned it.
    number: Option<(String, bool)>,
    words: String,
    frame: String,
    role: Role,
}

impl Label {
    fn new(place: f64, words: String, role: Role) -> Self {
        let frame = format!("frame {}", number((place * 10.0).round() / 10.0));
        Self { number: None, words, frame, role }
    }

    /// Returns the width in px.
    fn width(&self) -> f64 {
        let words = style::BOLDER * style::text_width(&self.words, style::WORDS);
        let sign = self.number.as_ref().map_or(0.0, |(sign, _)| 2.0 * style::badge_reach(sign));
        words.max(style::text_width(&self.frame, style::SMALL)).max(sign)
    }

    /// Draws the words in their role's colour below a point on the floor, and the frame below them.
    fn draw(&self, canvas: &mut Canvas, (x, floor): Point, width: f64) {
        let color = style::of_role(self.role);
        let below = if let Some((number, is_pinned)) = &self.number {
            canvas.badge((x, floor + 16.0), number, color, *is_pinned);
            floor + NUMBER
        } else {
            floor
        };
        let color = if self.role == Role::Inbetween { style::FAINT } else { color };
        let look = Type::new(style::WORDS).color(color).align(Align::Center);
        let look = if self.role == Role::Inbetween { look } else { look.bold() };
        let words = style::fitted(&self.words, style::BOLDER * style::WORDS, width);
        canvas.text(&words, (x, below + 18.0), look);
        let look = Type::new(style::SMALL).color(style::FAINT).align(Align::Center);
        canvas.text(&self.frame, (x, below + 34.0), look);
    }
}

impl PoseRow {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size or a count is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 200)?;
        style::check_figure(self.figure_height)?;
        style::check_count("in_line", self.in_line, style::MOST)?;
        style::check_count("most", self.most, style::MOST)
    }

    /// Draws poses of a clip as SVG. Each is given by its place in the source, its label and its role.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`PoseRow::validate`]; [`Error::Picture`] if there is no joint, no frame or
    /// no pose, or if a place is not finite.
    pub fn draw(&self, clip: &Clip, frames: &[(f64, String, Role)]) -> Result<String, Error> {
        self.validate()?;
        if clip.is_empty() || clip.skeleton().is_empty() {
            return Err(style::cannot("a clip without frames or joints has no pose to draw"));
        }
        if !frames.iter().all(|(place, ..)| place.is_finite()) {
            return Err(style::cannot("a pose's place in the source must be a number"));
        }
        let shown = frames.iter().take(self.most);
        let figure = Figure::new(clip, self.body);
        let poses = Posing::new(clip, figure.marks()).all(shown.map(|frame| Source::At(frame.0)));
        let label =
            |(place, words, role): &(f64, String, Role)| Label::new(*place, words.clone(), *role);
        self.row(clip, &figure, &frames.iter().map(label).collect::<Vec<_>>(), &poses)
    }

    /// Draws the genga and ends of a sheet as SVG, all layers combined, numbered as in the key table. Of a sheet without
    /// any, all drawings are drawn.
    ///
    /// # Errors
    /// [`Error::Sheet`] or [`Error::Picture`] if clip and sheet have nothing to show.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// use genga_plot::PoseRow;
    ///
    /// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
    /// # let mut engine = Engine::new(clip)?;
    /// let breakdown = engine.run(&Recipe::default(), &Edits::default())?;
    /// let svg = PoseRow::default().draw_kept(breakdown.clip, breakdown.sheet)?;
    /// assert!(svg.starts_with("<svg"));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn draw_kept(&self, clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
        self.validate()?;
        let named = page_head::with_first_koma(&self.clip, sheet.blank);
        let titled = Self { clip: named, ..self.clone() };
        let signs = Signs::new(clip, sheet);
        let (clip, sheet) = first_round(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = composed(clip, sheet)?;
        let mut kept = shown_drawings(composite.layer());
        signs.give(&mut kept);
        // A loop may have no genga at all.
        if kept.iter().any(|cell| cell.genga.is_some()) {
            kept.retain(|cell| cell.genga.is_some());
        }
        let label = |cell: &ShownDrawing<'_>| {
            let (place, words) = (signs.frame(cell.drawing), format!("koma {}", cell.koma + 1));
            let number = cell.genga_sign().map(|number| (number, cell.is_pinned()));
            Label { number, ..Label::new(place, words, cell.drawing.role) }
        };
        let figure = Figure::new(clip, self.body);
        let mut showing = Showing::new(&composite, figure.marks());
        let shown = kept.iter().take(self.most);
        let poses: Vec<_> = shown.map(|cell| showing.points(cell.index, cell.koma)).collect();
        titled.row(clip, &figure, &kept.iter().map(label).collect::<Vec<_>>(), &poses)
    }

    /// Draws the row of some poses, which belong to the first of `labels`.
    fn row(
        &self,
        clip: &Clip,
        figure: &Figure,
        labels: &[Label],
        poses: &[Vec<DVec3>],
    ) -> Result<String, Error> {
        if poses.is_empty() {
            return Err(style::cannot("no pose to draw"));
        }
        let (all, labels) = (labels.len(), &labels[..poses.len()]);
        let view = self.camera.view(clip, poses);
        let floor = Bounds::new(figure, &view, poses).floor;
        let size = largest(figure, &view, poses, floor);
        let room = f64::from(self.width) - 2.0 * style::MARGIN - GAP;
        let scale = fitting(size, (room, f64::from(self.figure_height)));
        let figure = figure.clone();
        let stage = Stage { figure, view, scale, origin: (0.0, floor), at: (0.0, 0.0) };
        let high = size.1 * scale;
        let words = labels.iter().map(Label::width).fold(70.0 - GAP, f64::max).min(room);
        let least = words.max(size.0 * scale) + GAP;
        let fit = ((room + GAP) / least).floor().max(1.0) as usize;
        let in_line = fit.min(self.in_line).min(labels.len());
        let cell = if labels.len() >= in_line.max(8) {
            (room + GAP) / in_line as f64
        } else {
            least + GAP
        };
        let lines = labels.len().div_ceil(in_line);
        let numbers = if labels[0].number.is_some() { NUMBER } else { 0.0 };
        let line = high + numbers + LABELS + BETWEEN_LINES + 12.0;
        let width = (cell * in_line as f64 + 2.0 * style::MARGIN).max(NARROWEST);
        let width = width.min(f64::from(self.width).max(NARROWEST));
        let height = HEAD + line * lines as f64 + 10.0;
        let mut canvas = Canvas::new((width, height));
        self.head(&mut canvas, (labels.len(), all), width);
        for (at, row) in labels.chunks(in_line).enumerate() {
            let floor = HEAD + line * at as f64 + 12.0 + high;
            let end = style::MARGIN + cell * row.len() as f64;
            canvas.line((style::MARGIN, floor), (end, floor), style::RAW, 1.25);
            for (column, label) in row.iter().enumerate() {
                let x = style::MARGIN + cell * (column as f64 + 0.5);
                let pose = &poses[at * in_line + column];
                canvas.figure(&stage.draw_over(pose, (x, floor)), Inks::Sides);
                label.draw(&mut canvas, (x, floor), cell);
            }
        }
        Ok(canvas.finish())
    }

    /// Draws the title, the clip, how many of the figures are shown, and the legend of the sides.
    fn head(&self, canvas: &mut Canvas, (shown, all): (usize, usize), width: f64) {
        let first = if shown < all { format!("the first {shown} of {all}") } else { String::new() };
        let words = [self.clip.as_str(), &first];
        let words: Vec<&str> = words.into_iter().filter(|words| !words.is_empty()).collect();
        let clips = words.join("  ·  ");
        Title { words: "Poses ポーズ", clips: &clips, legend: &SIDES, width }.draw(canvas);
    }
}
