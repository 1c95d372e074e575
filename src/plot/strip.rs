//! The two rows of the second paper's figures 4 to 7: source above, result below.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, knobs};
use crate::motion::Camera;
use crate::motion::Clip;
use crate::plot::canvas::{Align, Canvas, Inks, Type};
use crate::plot::drawings::{
    ShownDrawing, beginning, composed, drawn_poses, seconds_and_koma, shown_drawings, sliding_poses,
};
use crate::plot::figure::{Figure, FigureBody};
use crate::plot::page::{self, Head};
use crate::plot::points::Posing;
use crate::plot::px::Point;
use crate::plot::shared;
use crate::plot::stage::{Bounds, Stage, fitting, largest};
use crate::plot::style;
use crate::sheet::{Sheet, Source};

/// Source above, result below, koma by koma (\[KKMFT\] figures 4 to 7). What naka-nashi left out is
/// crossed out above and a gap below; a new drawing has a frame, and while it is held it is repeated, fainter, with a bracket under
/// it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Strip {
    /// From where it is seen; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. The setting `figures.body` is that of all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 600 to 20000; default 1280.
    pub width: u32,
    /// Height of the tallest figure in px, 40 to 2000; default 120.
    pub figure_height: u32,
    /// Koma on a line at most, 1 to 1000; default 12, half a second. Wide poses get 8 or 6.
    pub in_line: usize,
    /// Lines on a page, 1 to 1000; default 6.
    pub rows: usize,
    /// Koma at most, from the first on, 1 to 100000; default 1440, a minute.
    pub most: usize,
}

impl Default for Strip {
    fn default() -> Self {
        Self {
            camera: Camera::Auto,
            body: FigureBody::default(),
            width: 1280,
            figure_height: 120,
            in_line: 12,
            rows: 6,
            most: 1440,
        }
    }
}

/// The words on the left.
const SIDE: f64 = 62.0;
/// Koma numbers above the source, room between the rows, brackets below the result.
const NUMBERS: f64 = 24.0;
const BETWEEN: f64 = 18.0;
const BRACKETS: f64 = 34.0;
const BETWEEN_LINES: f64 = 22.0;
/// Koma on a line where poses are wide.
const FEWER: [usize; 4] = [8, 6, 4, 2];
/// How far apart figures are against the width of the widest: few are that wide, and arms may cross.
const APART: f64 = 0.8;
/// Room between a new drawing and its frame.
const FRAME: f64 = 3.0;
/// How much paper a repeated figure is mixed with.
const REPEATED: f64 = 0.72;

knobs!(strip::Strip {
    camera: shared::CAMERA,
    width: shared::WIDTH,
    figure_height: shared::FIGURE_HEIGHT,
    in_line: shared::IN_ROW.unit("koma"),
    rows: shared::ROWS,
    most: shared::MOST,
    ..body
});

impl Strip {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn, or no koma on a line or line on a page.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Draws a sheet against its source as pages of SVG; `cut` is the name on them.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Strip::validate`]; [`Error::Sheet`] or [`Error::Picture`] when clip and sheet have nothing
    /// to show.
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<Vec<String>, Error> {
        self.validate()?;
        let composite = composed(clip, sheet)?;
        let whole = composite.layer();
        let layer = &*beginning(whole, self.most);
        let figure = Figure::of(clip, self.body);
        let marks = figure.marks();
        let result = drawn_poses(&composite, marks, layer.drawings.len());
        let sliding = sliding_poses(&composite, marks, self.most);
        let place = |koma| sheet.clock.place_from_koma(koma);
        let koma = layer.length();
        let source = Posing::of(clip, marks).all((0..koma).map(|koma| Source::At(place(koma))));
        let cells = shown_drawings(layer);
        let all = sliding.as_ref().unwrap_or(&result);
        let (stage, in_line, column) = self.stage(clip, &figure, &source, all);
        let lines = koma.div_ceil(in_line);
        let passed = passed_over(&cells, (0..koma).map(place), sheet.clock.frames_in_koma());
        let drawing = Lines {
            stage,
            source,
            result,
            sliding,
            cells,
            passed,
            koma_rate: sheet.clock.koma_rate,
            in_line,
            column,
            high: f64::from(self.figure_height),
        };
        let pages = lines.div_ceil(self.rows);
        let page = |at: usize| {
            let facts = page::facts(sheet, whole);
            let title = "Source and result 素材と結果";
            let head = Head { title, cut, facts, page: (at + 1, pages) };
            let lines = at * self.rows..((at + 1) * self.rows).min(lines);
            drawing.page(lines, f64::from(self.width), &head)
        };
        Ok((0..pages).map(page).collect())
    }

    /// The stage, koma on a line, and the width of one.
    fn stage(
        &self,
        clip: &Clip,
        figure: &Figure,
        source: &[Vec<DVec3>],
        result: &[Vec<DVec3>],
    ) -> (Stage, usize, f64) {
        let view = self.camera.view(clip, source);
        let floor = Bounds::of(figure, &view, source.iter().chain(result)).floor;
        let (a, b) = (largest(figure, &view, source, floor), largest(figure, &view, result, floor));
        let size = (a.0.max(b.0), a.1.max(b.1));
        let room = f64::from(self.width) - 2.0 * style::MARGIN - SIDE;
        let high = f64::from(self.figure_height);
        let wide = size.0 * fitting(size, (room, high));
        let fits = |koma: &usize| room / *koma as f64 >= APART * wide;
        let fewer = FEWER.into_iter().filter(|koma| *koma < self.in_line);
        let in_line = [self.in_line].into_iter().chain(fewer).find(fits).unwrap_or(1);
        let column = room / in_line as f64;
        let scale = fitting(size, (column / APART, high));
        let figure = figure.clone();
        (Stage { figure, view, scale, origin: (0.0, floor), at: (0.0, 0.0) }, in_line, column)
    }
}

/// Which koma of the source nothing stands for: those further than half a koma from both of two
/// drawings between which naka-nashi left some out.
fn passed_over(
    cells: &[ShownDrawing<'_>],
    places: impl Iterator<Item = f64>,
    koma: f64,
) -> Vec<bool> {
    let place = |cell: &ShownDrawing<'_>| cell.drawing.source.place();
    let gap = |pair: &[ShownDrawing<'_>]| (place(&pair[0]), place(&pair[1]));
    let omits = |pair: &&[ShownDrawing<'_>]| pair[1].drawing.why.omitted_before > 0;
    let gaps: Vec<(f64, f64)> = cells.windows(2).filter(omits).map(gap).collect();
    let half = 0.5 * koma;
    let inside = |place: f64| gaps.iter().any(|(a, b)| place > a + half && place < b - half);
    places.map(inside).collect()
}

/// Everything on the lines.
struct Lines<'a> {
    stage: Stage,
    source: Vec<Vec<DVec3>>,
    /// A pose a drawing.
    result: Vec<Vec<DVec3>>,
    /// A pose a koma, where a held drawing slides.
    sliding: Option<Vec<Vec<DVec3>>>,
    cells: Vec<ShownDrawing<'a>>,
    passed: Vec<bool>,
    koma_rate: f64,
    in_line: usize,
    column: f64,
    high: f64,
}

impl Lines<'_> {
    fn page(&self, lines: std::ops::Range<usize>, width: f64, head: &Head<'_>) -> String {
        let line = NUMBERS + 2.0 * self.high + BETWEEN + BRACKETS + BETWEEN_LINES;
        let height = page::HEAD + line * lines.len() as f64 - BETWEEN_LINES + style::MARGIN;
        let mut canvas = Canvas::new((width, height));
        head.draw(&mut canvas, width);
        for (at, number) in lines.enumerate() {
            self.line(&mut canvas, number * self.in_line, page::HEAD + line * at as f64);
        }
        canvas.finish()
    }

    fn x(&self, koma: usize) -> f64 {
        style::MARGIN + SIDE + self.column * (koma % self.in_line) as f64
    }

    /// One line, from a koma on.
    fn line(&self, canvas: &mut Canvas, begin: usize, y: f64) {
        let end = (begin + self.in_line).min(self.source.len());
        let above = y + NUMBERS + self.high;
        let below = above + BETWEEN + self.high;
        let right = self.x(end - 1) + self.column;
        for (floor, words) in [(above, ["source", "素材"]), (below, ["result", "結果"])] {
            canvas.line((style::MARGIN + SIDE, floor), (right, floor), style::RAW, 1.0);
            let look = Type::new(style::WORDS).bold();
            canvas.text(words[0], (style::MARGIN, floor - 18.0), look);
            canvas.text(words[1], (style::MARGIN, floor - 2.0), Type::new(style::WORDS));
        }
        for koma in begin..end {
            let middle = self.x(koma) + 0.5 * self.column;
            self.koma_number(canvas, koma, (middle, y + 13.0));
            let inks = if self.passed[koma] { Inks::Faded(0.45) } else { Inks::Sides };
            canvas.figure(&self.stage.draw_over(&self.source[koma], (middle, above)), inks);
            if self.passed[koma] {
                canvas.cross((middle, above + 9.0), 4.5, style::GENGA, 1.75);
            }
        }
        // Cells in time's order: those of this line lie together.
        let from = self.cells.partition_point(|cell| cell.koma + cell.held <= begin);
        for cell in self.cells[from..].iter().take_while(|cell| cell.koma < end) {
            let on_line = cell.koma.max(begin)..(cell.koma + cell.held).min(end);
            self.exposure(canvas, cell, on_line, below);
        }
    }

    fn koma_number(&self, canvas: &mut Canvas, koma: usize, at: Point) {
        let second = self.koma_rate.round().max(1.0) as usize;
        let look = Type::new(style::SMALL).align(Align::Center);
        if koma.is_multiple_of(second) {
            let text = format!("{} · {}", koma + 1, seconds_and_koma(koma, self.koma_rate));
            canvas.text(&text, at, look.bold());
        } else {
            canvas.text(&(koma + 1).to_string(), at, look.color(style::FAINT));
        }
    }

    /// A drawing below, its repeats, its bracket and the gap before it.
    fn exposure(
        &self,
        canvas: &mut Canvas,
        cell: &ShownDrawing<'_>,
        koma: std::ops::Range<usize>,
        floor: f64,
    ) {
        for at in koma.clone() {
            let pose = self.sliding.as_ref().map_or(&self.result[cell.index], |poses| &poses[at]);
            let inks = if at == cell.koma { Inks::Sides } else { Inks::Faded(REPEATED) };
            let middle = self.x(at) + 0.5 * self.column;
            canvas.figure(&self.stage.draw_over(pose, (middle, floor)), inks);
        }
        let color = style::of_role(cell.drawing.role);
        if koma.start == cell.koma {
            let corner = (self.x(cell.koma) + FRAME, floor - self.high - FRAME);
            let size = (self.column - 2.0 * FRAME, self.high + 2.0 * FRAME);
            canvas.frame(corner, size, color, 4.0);
        }
        let label = (self.x(koma.start) + 0.5 * self.column, floor + 15.0);
        if koma.start == cell.koma {
            match cell.genga {
                Some(genga) => canvas.badge(label, genga, color, cell.is_pinned()),
                None => canvas.disc(label, 3.0, color),
            }
            let look = Type::new(style::SMALL).color(style::FAINT);
            canvas.text(&cell.number().to_string(), (label.0 + 12.0, label.1 + 4.0), look);
            self.gap(canvas, cell, floor);
        }
        if cell.held > 1 {
            let (left, right) =
                (self.x(koma.start) + 8.0, self.x(koma.end - 1) + self.column - 8.0);
            let y = floor + 29.0;
            // Open where the hold goes on over the edge of a line.
            let mut path = vec![(left, y), (right, y)];
            if koma.start == cell.koma {
                path.insert(0, (left, y - 4.0));
            }
            if koma.end == cell.koma + cell.held {
                path.push((right, y - 4.0));
            }
            canvas.path(&path, color, 1.5);
        }
    }

    fn gap(&self, canvas: &mut Canvas, cell: &ShownDrawing<'_>, floor: f64) {
        let omitted = cell.drawing.why.omitted_before;
        if omitted == 0 {
            return;
        }
        let x = self.x(cell.koma);
        let top = floor - self.high + 8.0;
        canvas.dashes((x, top), (x, floor + 24.0), style::GENGA, 1.5);
        let look = Type::new(style::SMALL).bold().color(style::GENGA).align(Align::Center);
        canvas.text(&format!("抜いた中割 {omitted}"), (x, top - 6.0), look);
    }
}
