//! Draws onion skins (オニオンスキン): neighbouring drawings through each other.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Inks, Type};
use crate::drawings::{ShownDrawing, Signs, composed, drawn_poses, shown_drawings};
use crate::figure::{Figure, FigureBody};
use crate::legend::SIDES;
use crate::page_head::{self, Head};
use crate::paper_point::Point;
use crate::shared;
use crate::stage::{Bounds, Stage, fitting};
use crate::style;
use genga::error::Error;
use genga::knob::{Knobs, knobs};
use genga::motion::seen::view::View;
use genga::motion::{Camera, Clip, first_round};
use genga::sheet::Sheet;

/// Onion skin (オニオンスキン): one panel from each genga to the next. It shows all drawings between them at their
/// place in the world, older ones fainter, and the arc (軌道) of the joint that travels furthest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OnionSkin {
    /// Camera of the figures; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. Set by `figures.body`, for all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 600 to 20000; default 960.
    pub width: u32,
    /// Height of the tallest panel's figures in px, 40 to 2000; default 220.
    pub figure_height: u32,
    /// Rows of panels on a page, 1 to 1000; default 5.
    pub rows: usize,
}

impl Default for OnionSkin {
    fn default() -> Self {
        Self {
            camera: Camera::Auto,
            body: FigureBody::default(),
            width: style::WIDTH,
            figure_height: 220,
            rows: 5,
        }
    }
}

const GAP: f64 = 10.0;
const PAD: f64 = 14.0;
/// Space above the figures in a panel, and below the floor, in px.
const TOP: f64 = 34.0;
const LABELS: f64 = 28.0;
const LEAST: f64 = 150.0;
/// Space behind the sign of a genga, in px.
const SIGN: f64 = 11.0;
/// Share of paper in the oldest drawing of a panel, and in the youngest before the key that it leads to.
const FAINT: (f64, f64) = (0.78, 0.5);

knobs!(onion::OnionSkin {
    camera: shared::CAMERA,
    width: shared::WIDTH,
    figure_height: shared::FIGURE_HEIGHT,
    rows: shared::ROWS,
    ..body
});

impl OnionSkin {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn or a page has no row.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Draws a sheet as pages of SVG; `cut` is the name printed on them.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`OnionSkin::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip and
    /// sheet have nothing to show.
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<Vec<String>, Error> {
        self.validate()?;
        let signs = Signs::new(clip, sheet);
        let (clip, sheet) = first_round(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = composed(clip, sheet)?;
        let layer = composite.layer();
        let figure = Figure::new(clip, self.body);
        let poses = drawn_poses(&composite, figure.marks(), layer.drawings.len());
        let view = self.camera.view(clip, &poses);
        let mut cells = shown_drawings(layer);
        signs.give(&mut cells);
        let ways = ways(&cells);
        let panels: Vec<Panel<'_>> =
            ways.into_iter().map(|way| Panel::new(way, &figure, &view, &poses)).collect();
        let floor = Bounds::new(&figure, &view, &poses).floor;
        let high = panels.iter().fold(0.0, |high: f64, panel| high.max(panel.bounds.top - floor));
        let wide = panels.iter().fold(0.0, |wide: f64, panel| wide.max(panel.bounds.width()));
        let room = f64::from(self.width) - 2.0 * style::MARGIN;
        let scale = fitting((wide, high), (room - 2.0 * PAD, f64::from(self.figure_height)));
        let stage = Stage { figure, view, scale, origin: (0.0, floor), at: (0.0, 0.0) };
        let rows = rows(&panels, scale, room);
        let joints = clip.skeleton().len();
        let pages = rows.len().div_ceil(self.rows);
        let page = |(at, rows): (usize, &[&[Panel<'_>]])| {
            let facts = page_head::facts(sheet, layer);
            let title = "Onion skin オニオンスキン";
            let head = Head { title, cut, facts, legend: &SIDES, page: (at + 1, pages) };
            let drawing = Page { stage: &stage, poses: &poses, joints, high: high * scale, room };
            drawing.draw(rows, &head)
        };
        Ok(rows.chunks(self.rows).enumerate().map(page).collect())
    }
}

/// Returns the exposures from each kept one to the next, both included; all exposures if only one is kept.
fn ways<'a>(cells: &'a [ShownDrawing<'a>]) -> Vec<&'a [ShownDrawing<'a>]> {
    let kept: Vec<usize> = (0..cells.len()).filter(|at| cells[*at].genga.is_some()).collect();
    let ways: Vec<_> = kept.windows(2).map(|pair| &cells[pair[0]..=pair[1]]).collect();
    if ways.is_empty() { vec![cells] } else { ways }
}

/// A panel: the way from one genga to the next.
struct Panel<'a> {
    way: &'a [ShownDrawing<'a>],
    bounds: Bounds,
}

impl<'a> Panel<'a> {
    fn new(
        way: &'a [ShownDrawing<'a>],
        figure: &Figure,
        view: &View,
        poses: &[Vec<DVec3>],
    ) -> Self {
        let bounds = Bounds::new(figure, view, way.iter().map(|cell| &poses[cell.index]));
        Self { way, bounds }
    }

    fn width(&self, scale: f64) -> f64 {
        let signs: f64 = self.ends().iter().map(|cell| 2.0 * cell.reach() + SIGN).sum();
        let words = signs + style::text_width(&self.koma(), style::SMALL) + 24.0;
        (self.bounds.width() * scale + 2.0 * PAD).max(words).max(LEAST)
    }

    /// Returns the two genga; of a panel with only one drawing, that.
    fn ends(&self) -> Vec<&ShownDrawing<'a>> {
        let ends = self.way.first().into_iter().chain(self.way[1..].last());
        ends.collect()
    }

    /// Returns the koma of the two genga, in words.
    fn koma(&self) -> String {
        let koma: Vec<String> =
            self.ends().iter().map(|cell| (cell.koma + 1).to_string()).collect();
        format!("koma {}", koma.join("–"))
    }
}

/// Splits the panels into rows, as many side by side as there is room for.
fn rows<'a, 'b>(panels: &'b [Panel<'a>], scale: f64, room: f64) -> Vec<&'b [Panel<'a>]> {
    let mut rows = Vec::new();
    let (mut begin, mut used) = (0, 0.0);
    for (at, panel) in panels.iter().enumerate() {
        let width = panel.width(scale);
        if at > begin && used + width > room + 0.5 {
            rows.push(&panels[begin..at]);
            (begin, used) = (at, 0.0);
        }
        used += width + GAP;
    }
    rows.push(&panels[begin..]);
    rows
}

/// Data that the panels of a page share.
struct Page<'a> {
    stage: &'a Stage,
    poses: &'a [Vec<DVec3>],
    joints: usize,
    /// Height of the tallest panel's figures, in px.
    high: f64,
    room: f64,
}

impl Page<'_> {
    fn draw(&self, rows: &[&[Panel<'_>]], head: &Head<'_>) -> String {
        let width = self.room + 2.0 * style::MARGIN;
        let row = TOP + self.high + LABELS;
        let height = page_head::HEAD + (row + GAP) * rows.len() as f64 - GAP + style::MARGIN;
        let mut canvas = Canvas::new((width, height));
        head.draw(&mut canvas, width);
        for (at, panels) in rows.iter().enumerate() {
            let y = page_head::HEAD + (row + GAP) * at as f64;
            let widths: f64 = panels.iter().map(|panel| panel.width(self.stage.scale) + GAP).sum();
            // A full row ends at the right edge; the last one is left as it is.
            let spare = (self.room + GAP - widths) / panels.len() as f64;
            let spare = if spare < 60.0 { spare } else { 0.0 };
            let mut x = style::MARGIN;
            for panel in *panels {
                let wide = panel.width(self.stage.scale) + spare;
                self.panel(&mut canvas, panel, (x, y), (wide, row));
                x += wide + GAP;
            }
        }
        canvas.finish()
    }

    fn panel(&self, canvas: &mut Canvas, panel: &Panel<'_>, (x, y): Point, size: (f64, f64)) {
        let floor = y + TOP + self.high;
        let middle = 0.5 * (panel.bounds.left + panel.bounds.right);
        let origin = (middle, self.stage.origin.1);
        let stage = Stage { origin, at: (x + 0.5 * size.0, floor), ..self.stage.clone() };
        canvas.frame((x, y), size, style::GRID, 6.0);
        canvas.line((x + 10.0, floor), (x + size.0 - 10.0, floor), style::GRID, 1.25);
        let last = panel.way.len() - 1;
        for (at, cell) in panel.way.iter().enumerate() {
            let drawn = stage.draw(&self.poses[cell.index]);
            canvas.figure(&drawn, inks(at, last));
        }
        self.arc(canvas, panel.way, &stage);
        words(canvas, panel, (x, y), size);
    }

    /// Draws the path of the joint that travels furthest, with a dot for each drawing.
    fn arc(&self, canvas: &mut Canvas, way: &[ShownDrawing<'_>], stage: &Stage) {
        let joint = |cell: &ShownDrawing<'_>, joint: usize| self.poses[cell.index][joint];
        let length = |at: usize| -> f64 {
            way.windows(2).map(|pair| joint(&pair[0], at).distance(joint(&pair[1], at))).sum()
        };
        let furthest = (0..self.joints)
            .map(|at| (at, length(at)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a });
        let Some((lead, _)) = furthest.filter(|(_, length)| *length > 0.0) else {
            return;
        };
        let path: Vec<Point> = way.iter().map(|cell| stage.place(joint(cell, lead))).collect();
        canvas.path(&path, style::GENGA_LINE, 1.25);
        for (cell, point) in way.iter().zip(&path) {
            let radius = if cell.genga.is_some() { 3.2 } else { 2.0 };
            canvas.spot(*point, radius, style::GENGA);
        }
    }
}

/// Writes the two genga, their koma, and the number of drawings between them.
fn words(canvas: &mut Canvas, panel: &Panel<'_>, (x, y): Point, (wide, high): (f64, f64)) {
    let mut left = x + 9.0;
    for (place, cell) in panel.ends().into_iter().enumerate() {
        if place > 0 {
            canvas.line((left - 9.0, y + 19.0), (left - 2.0, y + 19.0), style::FAINT, 1.25);
        }
        let (at, color) = ((left + cell.reach(), y + 19.0), style::of_role(cell.drawing.role));
        match cell.genga_sign() {
            Some(genga) => canvas.badge(at, &genga, color, cell.is_pinned()),
            None => canvas.disc(at, 3.0, color),
        }
        left += 2.0 * cell.reach() + SIGN;
    }
    let look = Type::new(style::SMALL).color(style::FAINT).align(Align::Right);
    canvas.text(&panel.koma(), (x + wide - 10.0, y + 23.0), look);
    let between = match panel.way.len().saturating_sub(2) {
        0 => "no inbetween 中割なし".to_owned(),
        count => format!("{count} between 中{count}枚"),
    };
    let look = Type::new(style::SMALL).color(style::INK).align(Align::Center);
    canvas.text(&between, (x + 0.5 * wide, y + high - 9.0), look);
}

/// Returns the inks of a drawing: full colours for the key that the panel leads to, fainter ones for older
/// drawings.
fn inks(at: usize, last: usize) -> Inks {
    if at == last {
        return Inks::Sides;
    }
    let age = 1.0 - at as f64 / last as f64;
    if at == 0 {
        return Inks::One(style::mixed(style::FAINT, style::PAPER, 0.35));
    }
    let (old, young) = FAINT;
    Inks::One(style::mixed(style::FAINT, style::PAPER, young + (old - young) * age))
}
