//! The map of the smoothing (表1の地図): the count for every width and persistence under the current recipe, with a ring at
//! the recipe's own values. A press on the map turns both knobs.

mod survey;

use egui::{
    Align2, CollapsingHeader, Color32, ComboBox, FontId, Painter, Pos2, Rect, Response, RichText,
    Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use self::survey::{PERSISTENCE, WIDTH};
use super::command::Command;
use super::focus;
use super::open_take::Take;
use super::task::{Look, Task};
use super::view_state::Shown;
use super::words::Words;
use genga_lab::study::{Axis, Grid, Measure, Study};
use genga_plot::parts::heat;

/// Measures on offer, in the order of the chain.
const MEASURES: [Measure; 4] = [Measure::Turns, Measure::Genga, Measure::Union, Measure::Drawings];

/// Space for the values left of the cells and below them, in points.
const LEFT: f32 = 40.0;
const BELOW: f32 = 30.0;
/// Height of the map in points.
const HEIGHT: f32 = 190.0;

/// State of the map, and the study it was computed from.
#[derive(Default)]
pub(super) struct Map {
    measure: Measure,
    is_open: bool,
    /// Request by keyboard to open or close the map.
    wants_open: Option<bool>,
    made: Option<(Study, Result<Grid, String>)>,
    waiting: Option<(Study, Task<Result<Grid, String>>)>,
}

impl Map {
    /// Opens or closes the map.
    pub(super) fn toggle(&mut self) {
        self.wants_open = Some(!self.is_open);
    }

    /// Whether the map is being computed.
    pub(super) fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Discards the map of a clip.
    pub(super) fn forget(&mut self) {
        (self.made, self.waiting) = (None, None);
    }

    /// Computes the map again if it is open and out of date.
    pub(super) fn renew(&mut self, take: &Take) {
        if !self.is_open || self.waiting.is_some() {
            return;
        }
        let clip = take.clip();
        let Some(study) = survey::study(&take.document().recipe, clip.rate(), self.measure) else {
            return;
        };
        if self.made.as_ref().is_none_or(|(of, _)| *of != study) {
            let of = study.clone();
            let errand = Task::in_steps(survey::steps(study, clip));
            self.waiting = Some((of, errand));
        }
    }

    /// Collects a finished map.
    pub(super) fn receive(&mut self) {
        let Some((study, errand)) = self.waiting.take() else { return };
        match errand.look() {
            Look::Waiting => self.waiting = Some((study, errand)),
            Look::Done(grid) => self.made = Some((study, grid)),
            Look::BrokeOff => self.made = Some((study, Err("the map was aborted".into()))),
        }
    }

    /// Shows the map under its header.
    pub(super) fn show(&mut self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let words = shown.words;
        let title = words.say("Map: width × persistence", "地図: 適用範囲 × 連続フレーム数");
        let header = CollapsingHeader::new(RichText::new(title).strong()).id_salt("map");
        let header = header.open(self.wants_open.take());
        let body = header.show_unindented(ui, |ui| {
            self.choice(ui, words);
            self.map(ui, shown, commands);
        });
        self.is_open = body.body_returned.is_some();
    }

    /// Shows the choice of measures.
    fn choice(&mut self, ui: &mut Ui, words: Words) {
        let name = |measure: Measure| {
            let (english, japanese) = measure.words();
            words.say(english, japanese)
        };
        let combo = ComboBox::from_id_salt("measure").width(220.0);
        let combo = combo.selected_text(name(self.measure)).show_ui(ui, |ui| {
            for measure in MEASURES {
                ui.selectable_value(&mut self.measure, measure, name(measure));
            }
        });
        combo.response.accessible_name(words.say("Value on the map", "地図の値"));
    }

    fn map(&self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let size = vec2(ui.available_width(), HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let look = &shown.look;
        let painter = ui.painter_at(rect);
        let inside = Rect::from_min_max(
            rect.min + vec2(LEFT, 4.0),
            pos2(rect.max.x - 6.0, rect.max.y - BELOW),
        );
        painter.rect_filled(inside, 2.0, look.ground);
        let grid = match &self.made {
            Some((_, Ok(grid))) => grid,
            Some((_, Err(text))) => return instead(&painter, inside, text, look.faint),
            None => return instead(&painter, inside, "…", look.faint),
        };
        let Some(y) = &grid.y else { return };
        let cells = Cells { x: &grid.x, y, inside };
        let values: Vec<f64> = grid.cells.iter().map(|cell| cell.values[0]).collect();
        // A map of another recipe is pale until it is computed again.
        let strength = if self.waiting.is_some() { 0.5 } else { 1.0 };
        cells.draw(&painter, &values, strength);
        cells.values(&painter, shown);
        cells.dot(&painter, shown);
        cells.turn(&response, shown, commands);
        cells.tell(response, &values, self.measure, shown);
    }
}

/// Shows a text in place of the map.
fn instead(painter: &Painter, inside: Rect, text: &str, color: Color32) {
    let font = FontId::proportional(12.0);
    painter.text(inside.center(), Align2::CENTER_CENTER, text, font, color);
}

/// Layout of the cells.
struct Cells<'a> {
    x: &'a Axis,
    y: &'a Axis,
    inside: Rect,
}

impl Cells<'_> {
    /// The middle of a cell, or a point between the middles of two. Larger `y` is higher up.
    fn middle(&self, x: f64, y: f64) -> Pos2 {
        let (columns, rows) = (self.x.len() as f64, self.y.len() as f64);
        let share = vec2(((x + 0.5) / columns) as f32, (1.0 - (y + 0.5) / rows) as f32);
        self.inside.min + share * self.inside.size()
    }

    fn size(&self) -> Vec2 {
        self.inside.size() / vec2(self.x.len() as f32, self.y.len() as f32)
    }

    fn draw(&self, painter: &Painter, values: &[f64], strength: f32) {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        for (at, value) in values.iter().enumerate() {
            let middle = self.middle((at / self.y.len()) as f64, (at % self.y.len()) as f64);
            let share = if high > low { (value - low) / (high - low) } else { 0.0 };
            let plotters::style::RGBColor(red, green, blue) = heat(share);
            let color = Color32::from_rgb(red, green, blue).gamma_multiply(strength);
            let cell = Rect::from_center_size(middle, self.size() - vec2(0.8, 0.8));
            painter.rect_filled(cell, 0.0, color);
            let ink = if share > 0.55 { Color32::WHITE } else { Color32::from_gray(60) };
            let font = FontId::proportional(8.5);
            let ink = ink.gamma_multiply(strength);
            painter.text(middle, Align2::CENTER_CENTER, value.round(), font, ink);
        }
    }

    /// Draws values and names of both axes.
    fn values(&self, painter: &Painter, shown: &Shown<'_>) {
        let (look, font) = (&shown.look, FontId::proportional(9.5));
        for (at, value) in self.x.values().iter().enumerate().skip(1).step_by(2) {
            let at = pos2(self.middle(at as f64, 0.0).x, self.inside.max.y + 2.0);
            painter.text(at, Align2::CENTER_TOP, value, font.clone(), look.faint);
        }
        for (at, value) in self.y.values().iter().enumerate().skip(1).step_by(2) {
            let at = pos2(self.inside.min.x - 4.0, self.middle(0.0, at as f64).y);
            painter.text(at, Align2::RIGHT_CENTER, value, font.clone(), look.faint);
        }
        let name =
            shown.words.say("across: width, up: persistence", "横: 適用範囲　縦: 連続フレーム数");
        let at = pos2(self.inside.center().x, self.inside.max.y + 15.0);
        painter.text(at, Align2::CENTER_TOP, name, FontId::proportional(10.5), look.faint);
    }

    /// Position of the recipe. `None` if a setting has another unit than its axis.
    fn place(&self, shown: &Shown<'_>) -> Option<Pos2> {
        let recipe = &shown.wanted.recipe;
        let place = |axis: &Axis| survey::place(axis, &recipe.get(axis.name()).ok()?);
        let (x, y) = place(self.x).zip(place(self.y))?;
        Some(self.middle(x, y))
    }

    /// Marks the position of the recipe with a ring, so that the number inside can be read.
    fn dot(&self, painter: &Painter, shown: &Shown<'_>) {
        if let Some(place) = self.place(shown) {
            painter.circle_stroke(place, 8.5, Stroke::new(4.0, Color32::WHITE));
            painter.circle_stroke(place, 8.5, Stroke::new(2.2, shown.look.genga));
        }
    }

    /// The cell at a point, or the nearest one outside of the map.
    fn under(&self, at: Pos2) -> (usize, usize) {
        let share = (at - self.inside.min) / self.inside.size();
        let index =
            |share: f32, count: usize| ((share * count as f32).max(0.0) as usize).min(count - 1);
        (index(share.x, self.x.len()), index(1.0 - share.y, self.y.len()))
    }

    /// Sets both knobs to the cell under a pressed pointer, or moves them one cell per arrow key.
    fn turn(&self, response: &Response, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let at = response.interact_pointer_pos();
        let under_hand = at.filter(|_| response.is_pointer_button_down_on());
        let (keys, _) = focus::take_arrows(response);
        let by_keys =
            || (keys != Vec2::ZERO).then(|| Some(self.place(shown)? + keys * self.size()))?;
        let Some(at) = under_hand.or_else(by_keys) else { return };
        let (x, y) = self.under(at);
        for (knob, value) in [(WIDTH, &self.x.values()[x]), (PERSISTENCE, &self.y.values()[y])] {
            if shown.wanted.recipe.get(knob).is_ok_and(|own| own != *value) {
                commands.push(Command::Set(knob, value.clone()));
            }
        }
    }

    /// Describes the recipe's position to screen readers, and the cell under a resting pointer in a tooltip.
    fn tell(&self, response: Response, values: &[f64], measure: Measure, shown: &Shown<'_>) {
        let recipe = &shown.wanted.recipe;
        let own = [WIDTH, PERSISTENCE].map(|knob| recipe.get(knob).unwrap_or_default());
        let name = shown.words.say("Map of the smoothing", "平滑化の地図");
        response.widget_info(|| WidgetInfo {
            current_text_value: Some(own.join(" × ")),
            ..WidgetInfo::labeled(Role::Canvas, true, name)
        });
        let rests = |at: &Pos2| self.inside.contains(*at) && !response.is_pointer_button_down_on();
        if let Some(at) = response.hover_pos().filter(rests) {
            let (x, y) = self.under(at);
            let value = values[x * self.y.len() + y].round();
            let (english, japanese) = measure.words();
            let what = shown.words.say(english, japanese);
            let cell = format!("{} × {}: {value} {what}", self.x.values()[x], self.y.values()[y]);
            response.on_hover_text_at_pointer(cell);
        }
    }
}
