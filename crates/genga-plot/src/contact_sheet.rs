//! The contact sheet of the genga (原画一覧).

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Inks, Type};
use crate::chart::number;
use crate::drawings::{
    ShownDrawing, Signs, composed, drawn_poses, seconds_and_koma, shown_drawings,
};
use crate::figure::{Figure, FigureBody};
use crate::legend::SIDES;
use crate::page_head::{self, Head};
use crate::paper_point::Point;
use crate::shared;
use crate::stage::{Bounds, Stage, fitting, largest};
use crate::style;
use genga::error::Error;
use genga::knob::{Knobs, knob, knobs};
use genga::motion::{Camera, Clip, first_round};
use genga::sheet::{Role, Sheet};

/// The contact sheet (原画一覧): one card per genga with its number, koma, frame and reasons. All figures have
/// one scale and stand on one floor.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ContactSheet {
    /// Camera of the figures; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. Set by `figures.body`, for all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Maximum width in px, 600 to 20000; default 960.
    pub width: u32,
    /// Height of the tallest figure in px, 40 to 2000; default 130.
    pub figure_height: u32,
    /// Maximum number of cards in a row, 1 to 1000; default 8. Wide poses reduce it.
    pub in_row: usize,
    /// Rows on a page, 1 to 1000; default 6.
    pub rows: usize,
    /// Whether inbetweens (中割り) get cards too, in fainter lines; default no.
    pub inbetweens: bool,
}

impl Default for ContactSheet {
    fn default() -> Self {
        Self {
            camera: Camera::Auto,
            body: FigureBody::default(),
            width: style::WIDTH,
            figure_height: 130,
            in_row: 8,
            rows: 6,
            inbetweens: false,
        }
    }
}

const GAP: f64 = 10.0;
/// Space above the figure in a card, and below the floor without the reasons, in px.
const TOP: f64 = 32.0;
const LABELS: f64 = 43.0;
/// Height of a line of reasons, in px. All cards have as many lines as the card with most reasons needs.
const LINE: f64 = 15.0;

knobs!(contact::ContactSheet {
    camera: shared::CAMERA,
    width: shared::WIDTH,
    figure_height: shared::FIGURE_HEIGHT,
    in_row: shared::IN_ROW.unit("cards"),
    rows: shared::ROWS,
    inbetweens: knob(
        "中割りも",
        "Whether inbetweens get cards too, in fainter lines.",
        "中割りも薄い線で並べるか。"
    ),
    ..body
});

impl ContactSheet {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn, or if a row or a page has no card.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Draws the genga of a sheet as pages of SVG; `cut` is the name printed on them.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`ContactSheet::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip
    /// and sheet have nothing to show.
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<Vec<String>, Error> {
        self.validate()?;
        let signs = Signs::new(clip, sheet);
        let (clip, sheet) = first_round(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = composed(clip, sheet)?;
        let layer = composite.layer();
        let figure = Figure::new(clip, self.body);
        let poses = drawn_poses(&composite, figure.marks(), layer.drawings.len());
        let mut cards = shown_drawings(layer);
        signs.give(&mut cards);
        cards.retain(|cell| self.inbetweens || cell.genga.is_some());
        if cards.is_empty() {
            return Err(style::cannot("the sheet has no genga to show"));
        }
        let cards: Vec<Card<'_>> = cards
            .into_iter()
            .map(|cell| Card::new(cell, signs.frame(cell.drawing), sheet.clock.koma_rate))
            .collect();
        let table = self.table(clip, figure, &poses, &cards);
        let on_page = table.columns * self.rows;
        let pages = cards.len().div_ceil(on_page);
        let page = |(at, cards): (usize, &[Card<'_>])| {
            let facts = page_head::facts(sheet, layer);
            let title = "Contact sheet 原画一覧";
            let head = Head { title, cut, facts, legend: &SIDES, page: (at + 1, pages) };
            table.draw(cards, &poses, &head)
        };
        Ok(cards.chunks(on_page).enumerate().map(page).collect())
    }

    fn table(
        &self,
        clip: &Clip,
        figure: Figure,
        poses: &[Vec<DVec3>],
        cards: &[Card<'_>],
    ) -> Table {
        let view = self.camera.view(clip, poses);
        let floor = Bounds::new(&figure, &view, poses).floor;
        let size = largest(&figure, &view, poses, floor);
        let room = f64::from(self.width) - 2.0 * style::MARGIN;
        let high = f64::from(self.figure_height);
        let scale = fitting(size, (room - 16.0, high));
        let words = cards.iter().map(Card::width).fold(size.0 * scale + 16.0, f64::max);
        let least = (words + GAP).max(110.0);
        let columns = (((room + GAP) / least).floor().max(1.0) as usize).min(self.in_row);
        let card = (room + GAP) / columns as f64 - GAP;
        let stage = Stage { figure, view, scale, origin: (0.0, floor), at: (0.0, 0.0) };
        let columns = columns.min(cards.len());
        let lines = cards.iter().map(|words| words.reasons(card).len()).max().unwrap_or_default();
        let labels = LABELS + LINE * lines.max(1) as f64;
        let width =
            (2.0 * style::MARGIN + (card + GAP) * columns as f64 - GAP).max(page_head::NARROWEST);
        Table { stage, columns, card: (card, TOP + high + labels), labels, width }
    }
}

/// The layout of the cards of a page.
struct Table {
    stage: Stage,
    columns: usize,
    /// Width and height of a card, in px.
    card: (f64, f64),
    /// Height of a card below the floor, in px.
    labels: f64,
    width: f64,
}

/// The words of a card.
struct Card<'a> {
    cell: ShownDrawing<'a>,
    /// The drawing's number in the CELL column, and when it comes.
    head: [String; 2],
    /// Where it is from and how long it stays.
    facts: String,
}

impl<'a> Card<'a> {
    fn new(cell: ShownDrawing<'a>, frame: f64, koma_rate: f64) -> Self {
        // The genga of several columns are named alone, and each has an exposure of its own.
        let drawing = match cell.is_composite() {
            true => String::new(),
            false => format!("drawing {}", cell.sign()),
        };
        let head = [drawing, seconds_and_koma(cell.koma, koma_rate)];
        let place = number((frame * 10.0).round() / 10.0);
        let held = if cell.held == 1 || cell.is_composite() {
            String::new()
        } else {
            format!(" · {} koma", cell.held)
        };
        Self { cell, head, facts: format!("frame {place}{held}") }
    }

    /// Returns the width that its words need, in px.
    fn width(&self) -> f64 {
        let small = |words: &String| style::text_width(words, style::SMALL);
        let head = 2.0 * self.cell.reach() + self.head.iter().map(small).sum::<f64>() + 36.0;
        let reasons = self.cell.reasons();
        let below = reasons.iter().chain([&self.facts]).map(small).fold(0.0, f64::max) + 16.0;
        head.max(below)
    }

    /// Returns the reasons for its drawing, wrapped to the lines of a card of a width.
    fn reasons(&self, width: f64) -> Vec<String> {
        style::lines(&self.cell.reasons(), style::SMALL, width - 14.0)
    }
}

impl Table {
    fn draw(&self, cards: &[Card<'_>], poses: &[Vec<DVec3>], head: &Head<'_>) -> String {
        let rows = cards.len().div_ceil(self.columns);
        let height = page_head::HEAD + (self.card.1 + GAP) * rows as f64 - GAP + style::MARGIN;
        let mut canvas = Canvas::new((self.width, height));
        head.draw(&mut canvas, self.width);
        for (at, card) in cards.iter().enumerate() {
            let (row, column) = (at / self.columns, at % self.columns);
            let x = style::MARGIN + (self.card.0 + GAP) * column as f64;
            let y = page_head::HEAD + (self.card.1 + GAP) * row as f64;
            self.draw_card(&mut canvas, card, &poses[card.cell.index], (x, y));
        }
        canvas.finish()
    }

    fn draw_card(&self, canvas: &mut Canvas, card: &Card<'_>, pose: &[DVec3], (x, y): Point) {
        let (width, height) = self.card;
        let cell = &card.cell;
        let (middle, right) = (x + 0.5 * width, x + width - 10.0);
        canvas.frame((x, y), self.card, style::GRID, 6.0);
        let color = style::of_role(cell.drawing.role);
        let reach = cell.reach();
        let sign = (x + 8.0 + reach, y + 18.0);
        match cell.genga_sign() {
            Some(genga) => canvas.badge(sign, &genga, color, cell.is_pinned()),
            None => canvas.disc(sign, 3.0, color),
        }
        let faint = Type::new(style::SMALL).color(style::FAINT);
        let [drawing, time] = &card.head;
        canvas.text(drawing, (sign.0 + reach + 6.0, y + 22.0), faint);
        canvas.text(time, (right, y + 22.0), faint.align(Align::Right));
        let floor = y + height - self.labels;
        canvas.line((x + 10.0, floor), (right, floor), style::GRID, 1.25);
        let inks =
            if cell.drawing.role == Role::Inbetween { Inks::Faded(0.5) } else { Inks::Sides };
        canvas.figure(&self.stage.draw_over(pose, (middle, floor)), inks);
        let look = Type::new(style::WORDS).color(color).align(Align::Center);
        let look = if cell.genga.is_some() { look.bold() } else { look };
        canvas.text(&format!("koma {}", cell.koma + 1), (middle, floor + 19.0), look);
        canvas.text(&card.facts, (middle, floor + 34.0), faint.align(Align::Center));
        let look = if cell.is_pinned() { faint.color(style::INK) } else { faint };
        for (at, line) in card.reasons(width).iter().enumerate() {
            let base = floor + 49.0 + LINE * at as f64;
            canvas.text(line, (middle, base), look.align(Align::Center));
        }
    }
}
