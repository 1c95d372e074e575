//! Draws the two rows of the second paper's figures 4 to 7: source above, result below.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Inks, Type};
use crate::drawings::{
    ShownDrawing, Signs, beginning, composed, drawn_poses, seconds_and_koma, shown_as,
    sliding_poses,
};
use crate::figure::{Figure, FigureBody};
use crate::legend::{LEFT_OUT, SIDES};
use crate::page_head::{self, Head};
use crate::paper_point::Point;
use crate::points::Posing;
use crate::shared;
use crate::stage::{Bounds, Stage, fitting, largest};
use crate::style;
use genga::error::Error;
use genga::knob::{Knobs, knobs};
use genga::motion::{Camera, Clip, played_out};
use genga::sheet::{Sheet, Source};

/// The source above, the result below, koma by koma (\[KKMFT\] figures 4 to 7). A drawing that naka-nashi
/// left out is crossed out above and leaves a gap below. A new drawing has a frame. While it is held, it is
/// repeated, fainter, over a bracket.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Strip {
    /// Camera of the figures; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. Set by `figures.body`, for all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 600 to 20000; default 960.
    pub width: u32,
    /// Height of the tallest figure in px, 40 to 2000; default 120.
    pub figure_height: u32,
    /// Maximum number of koma on a line, 1 to 1000; default 12, half a second. Wide poses reduce it to 8, 6
    /// or fewer.
    pub in_line: usize,
    /// Lines on a page, 1 to 1000; default 6.
    pub rows: usize,
    /// Maximum number of koma, counted from the first, 1 to 100000; default 1440, a minute.
    pub most: usize,
}

impl Default for Strip {
    fn default() -> Self {
        Self {
            camera: Camera::Auto,
            body: FigureBody::default(),
            width: style::WIDTH,
            figure_height: 120,
            in_line: 12,
            rows: 6,
            most: 1440,
        }
    }
}

/// Width of the words on the left, in px.
const SIDE: f64 = 62.0;
/// Heights of the koma numbers above the source, of the space between the rows, and of the brackets below the
/// result, in px.
const NUMBERS: f64 = 24.0;
const BETWEEN: f64 = 18.0;
const BRACKETS: f64 = 34.0;
const BETWEEN_LINES: f64 = 22.0;
/// Numbers of koma on a line to try, in this order, if poses are wide.
const FEWER: [usize; 4] = [8, 6, 4, 2];
/// Distance of figures relative to the width of the widest. Few figures are that wide, and arms may cross.
const APART: f64 = 0.8;
/// Space between a new drawing and its frame, in px.
const FRAME: f64 = 3.0;
/// Share of paper in the colours of a repeated figure.
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
    /// [`Error::Setting`] if a size cannot be drawn, if a line has no koma, or if a page has no line.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Draws a sheet against its source as pages of SVG; `cut` is the name printed on them.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`Strip::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip and sheet
    /// have nothing to show.
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<Vec<String>, Error> {
        self.validate()?;
        let (named, signs) = (composed(clip, sheet)?.layer().clone(), Signs::new(clip, sheet));
        let facts = page_head::facts(sheet, &named);
        let (clip, played) = played_out(clip, sheet);
        let (clip, sheet) = (&*clip, &*played);
        let composite = composed(clip, sheet)?;
        let whole = composite.layer();
        let layer = &*beginning(whole, self.most);
        let figure = Figure::new(clip, self.body);
        let marks = figure.marks();
        let result = drawn_poses(&composite, marks, layer.drawings.len());
        let sliding = sliding_poses(&composite, marks, self.most);
        let place = |koma| sheet.clock.place_from_koma(koma);
        let koma = layer.length();
        let source = Posing::new(clip, marks).all((0..koma).map(|koma| Source::At(place(koma))));
        let mut cells = shown_as(layer, &named);
        signs.give(&mut cells);
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
        let leaves_out = drawing.cells.iter().any(|cell| cell.drawing.why.omitted_before > 0);
        let page = |at: usize| {
            let facts = facts.clone();
            let title = "Source and result 素材と結果";
            let legend = [SIDES[0], SIDES[1], LEFT_OUT];
            let legend = if leaves_out { &legend[..] } else { &SIDES[..] };
            let head = Head { title, cut, facts, legend, page: (at + 1, pages) };
            let lines = at * self.rows..((at + 1) * self.rows).min(lines);
            drawing.page(lines, f64::from(self.width), &head)
        };
        Ok((0..pages).map(page).collect())
    }

    /// Computes the stage, the number of koma on a line, and the width of one.
    fn stage(
        &self,
        clip: &Clip,
        figure: &Figure,
        source: &[Vec<DVec3>],
        result: &[Vec<DVec3>],
    ) -> (Stage, usize, f64) {
        let view = self.camera.view(clip, source);
        let floor = Bounds::new(figure, &view, source.iter().chain(result)).floor;
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

/// Finds the koma of the source that no drawing represents: those inside a gap left by naka-nashi, further than
/// half a koma from the drawings at both its ends.
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

/// The contents of all lines.
struct Lines<'a> {
    stage: Stage,
    source: Vec<Vec<DVec3>>,
    /// Pose of each drawing.
    result: Vec<Vec<DVec3>>,
    /// Pose of each koma, if held drawings slide.
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
        let height = page_head::HEAD + line * lines.len() as f64 - BETWEEN_LINES + style::MARGIN;
        let mut canvas = Canvas::new((width, height));
        head.draw(&mut canvas, width);
        for (at, number) in lines.enumerate() {
            self.line(&mut canvas, number * self.in_line, page_head::HEAD + line * at as f64);
        }
        canvas.finish()
    }

    fn x(&self, koma: usize) -> f64 {
        style::MARGIN + SIDE + self.column * (koma % self.in_line) as f64
    }

    /// Draws one line, from a koma on.
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
        // Cells are sorted by time, so those of this line are contiguous.
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

    /// Draws a drawing of the result, its repeats, its bracket and the gap before it.
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
            match cell.short_genga_sign() {
                Some(genga) => canvas.badge(label, &genga, color, cell.is_pinned()),
                None => canvas.disc(label, 3.0, color),
            }
            let look = Type::new(style::SMALL).color(style::FAINT);
            let beside = (label.0 + cell.reach() + 4.0, label.1 + 4.0);
            // A column has no room for the numbers of several.
            if !cell.is_composite() {
                canvas.text(&cell.sign(), beside, look);
            }
            self.gap(canvas, cell, floor);
        }
        if cell.held > 1 {
            let (left, right) =
                (self.x(koma.start) + 8.0, self.x(koma.end - 1) + self.column - 8.0);
            let y = floor + 29.0;
            // Leave the bracket open at an end where the hold continues on another line.
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
        canvas.text(&format!("×{omitted}"), (x, top - 6.0), look);
    }
}
