//! A time axis (時間軸) in the window: the visible part of a clip or a sheet, and the positions of its frames or koma.

use egui::{PointerButton, Rangef, Rect, Response, Ui, Vec2};

use genga::time::{Clock, Frame};

/// Fewest frames in view.
const FEWEST: f64 = 4.0;
/// Share of the view by which an arrow key moves it, and factor by which one zooms.
const A_STEP: f64 = 0.125;
const A_FACTOR: f64 = 1.25;

/// The visible part of a clip, in places (fractional source frames).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Window {
    from: f64,
    to: f64,
    /// First and last place of the clip.
    whole: (f64, f64),
}

impl Window {
    /// Adapts to a clip. Shows all of it if its range has changed.
    pub(super) fn fit(&mut self, whole: (f64, f64)) {
        if self.whole != whole {
            *self = Self { from: whole.0, to: whole.1.max(whole.0 + 1.0), whole };
        }
    }

    /// Handles pointer input. The wheel zooms around the pointer. Scrolling sideways and dragging with the secondary or
    /// middle button move the view, and a double click shows all.
    pub(super) fn handle(&mut self, ui: &Ui, response: &Response, rect: Rect) {
        if response.double_clicked() {
            self.show_whole();
        }
        let a_point = (self.to - self.from) / f64::from(rect.width().max(1.0));
        if response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
        {
            self.shift(-f64::from(response.drag_delta().x) * a_point);
        }
        if !response.contains_pointer() {
            return;
        }
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        self.shift(-f64::from(scroll.x) * a_point);
        if let Some(at) = ui.input(|input| input.pointer.hover_pos()) {
            let place = self.scale(rect).place(at.x);
            self.zoom(place, f64::from(pinch * (scroll.y * 0.004).exp()));
        }
    }

    /// Handles arrow keys: left and right move the view by an eighth, up and down zoom around a frame.
    pub(super) fn walk(&mut self, keys: Vec2, about: Frame) {
        self.shift(f64::from(keys.x) * A_STEP * (self.to - self.from));
        self.zoom(about.0 as f64, A_FACTOR.powf(-f64::from(keys.y)));
    }

    /// Whether everything is in view.
    pub(super) fn is_whole(&self) -> bool {
        self.to - self.from >= self.whole.1 - self.whole.0
    }

    /// Whether a place is in view.
    pub(super) fn has(&self, place: f64) -> bool {
        (self.from..self.to).contains(&place)
    }

    /// Shows everything.
    pub(super) fn show_whole(&mut self) {
        (self.from, self.to) = (self.whole.0, self.whole.1.max(self.whole.0 + 1.0));
    }

    /// Shows a part, with some room at both ends.
    pub(super) fn show_part(&mut self, from: f64, to: f64) {
        let length = (1.1 * (to - from)).clamp(FEWEST, (self.whole.1 - self.whole.0).max(FEWEST));
        let highest = (self.whole.1 - length).max(self.whole.0);
        self.from = (0.5 * (from + to - length)).clamp(self.whole.0, highest);
        self.to = self.from + length;
    }

    /// Moves as far as needed to bring a place into view.
    pub(super) fn reveal(&mut self, place: f64) {
        if !self.has(place) {
            self.shift(place - 0.5 * (self.from + self.to));
        }
    }

    fn shift(&mut self, by: f64) {
        let by = by.clamp(self.whole.0 - self.from, (self.whole.1 - self.to).max(0.0));
        (self.from, self.to) = (self.from + by, self.to + by);
    }

    /// Zooms around a place, which keeps its position.
    fn zoom(&mut self, place: f64, factor: f64) {
        if factor == 1.0 {
            return;
        }
        let factor = 1.0 / factor.clamp(0.01, 100.0);
        let length = ((self.to - self.from) * factor)
            .clamp(FEWEST, (self.whole.1 - self.whole.0).max(FEWEST));
        let share = ((place - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        let highest = (self.whole.1 - length).max(self.whole.0);
        self.from = (place - share * length).clamp(self.whole.0, highest);
        self.to = self.from + length;
    }

    pub(super) fn scale(&self, rect: Rect) -> Scale {
        Scale { from: self.from, to: self.to, x: rect.x_range() }
    }
}

/// Average distance of points in the window. Infinite for fewer than two.
pub(super) fn across(points: impl ExactSizeIterator<Item = f32>) -> f32 {
    let steps = points.len().saturating_sub(1);
    let bounds = points
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
    if steps == 0 { f32::INFINITY } else { (bounds.1 - bounds.0) / steps as f32 }
}

/// Mapping from places to positions in the window.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    pub(super) from: f64,
    pub(super) to: f64,
    x: Rangef,
}

impl Scale {
    pub(super) fn x(&self, place: f64) -> f32 {
        let share = (place - self.from) / (self.to - self.from);
        self.x.min + share as f32 * self.x.span()
    }

    pub(super) fn place(&self, x: f32) -> f64 {
        self.from + f64::from((x - self.x.min) / self.x.span()) * (self.to - self.from)
    }

    /// Koma in view, as places and numbers from 1. They are spaced like the lines of a sheet, at least `room` points
    /// apart.
    pub(super) fn koma(&self, room: f32, clock: Clock) -> Vec<(f64, usize)> {
        let first = clock.place_from_koma(0);
        let number = |place: f64| (place - first) / clock.frames_in_koma() + 1.0;
        let least =
            (number(self.to) - number(self.from)) * f64::from(room / self.x.span().max(1.0));
        let second = clock.koma_rate.round().max(1.0) as usize;
        let steps = [1, 2, 3, 6, 12].into_iter().filter(|step| *step < second);
        let longer =
            [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600].map(|times| times * second);
        let step = steps.chain(longer).find(|step| *step as f64 >= least).unwrap_or(second * 3600);
        let past = number(self.to).floor().max(0.0) as usize;
        let numbers = (1..=past / step).map(|times| times * step);
        let place = |number: usize| clock.place_from_koma(number - 1);
        let places = numbers.map(|number| (place(number), number));
        places.filter(|(place, _)| *place >= self.from).collect()
    }

    /// Round whole numbers in view, at least `room` points apart.
    pub(super) fn ticks(&self, room: f32) -> impl Iterator<Item = f64> + use<> {
        let least = (self.to - self.from) * f64::from(room / self.x.span().max(1.0));
        let power = 10f64.powf(least.max(1.0).log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|times| times * power);
        let step = step.into_iter().find(|step| *step >= least).unwrap_or(10.0 * power);
        let (first, last) = ((self.from / step).ceil(), (self.to / step).floor());
        (0..=(last - first).max(-1.0) as i64).map(move |at| (first + at as f64) * step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    #[test]
    fn a_place_stays_under_the_pointer_and_the_view_within_the_clip() {
        let mut window = Window::default();
        window.fit((10.0, 110.0));
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 50.0));
        window.zoom(60.0, 2.0);
        assert_eq!((window.from, window.to), (35.0, 85.0));
        assert_eq!(window.scale(rect).x(60.0), 100.0);
        assert_eq!(window.scale(rect).place(100.0), 60.0);
        window.shift(1000.0);
        assert_eq!((window.from, window.to), (60.0, 110.0));
        window.zoom(110.0, 1e-9);
        assert_eq!((window.from, window.to), (10.0, 110.0));
    }

    #[test]
    fn a_part_is_shown_with_room_around_it_and_what_is_outside_is_revealed() {
        let mut window = Window::default();
        window.fit((0.0, 1000.0));
        assert!(window.is_whole());
        window.show_part(100.0, 200.0);
        assert!(
            (window.from - 95.0).abs() < 1e-9 && (window.to - 205.0).abs() < 1e-9,
            "{window:?}"
        );
        let before = window;
        window.reveal(150.0);
        assert_eq!(window, before, "it is in view");
        window.reveal(990.0);
        assert_eq!(window.to, 1000.0);
        window.show_part(-50.0, 20.0);
        assert_eq!(window.from, 0.0);
        window.show_whole();
        assert!(window.is_whole());
    }

    #[test]
    fn points_are_so_far_apart_as_the_clip_goes() {
        assert_eq!(across([10.0, 11.0, 30.0].into_iter()), 10.0);
        assert_eq!(across([10.0].into_iter()), f32::INFINITY);
    }

    #[test]
    fn koma_are_numbered_as_on_the_sheet() {
        let rate = genga::time::FrameRate::new(120.0).unwrap();
        let clock = Clock { first: genga::time::Frame(10), frame_rate: rate, koma_rate: 24.0 };
        let window = Window { from: 10.0, to: 130.0, whole: (10.0, 130.0) };
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 50.0));
        let koma = window.scale(rect).koma(50.0, clock);
        assert_eq!(koma, [(35.0, 6), (65.0, 12), (95.0, 18), (125.0, 24)]);
        let wide = window.scale(rect).koma(2.0, clock);
        assert_eq!((wide[0], wide.len()), ((10.0, 1), 25));
    }

    #[test]
    fn ticks_are_round_and_not_too_close() {
        let window = Window { from: 0.0, to: 100.0, whole: (0.0, 100.0) };
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 50.0));
        let ticks: Vec<f64> = window.scale(rect).ticks(50.0).collect();
        assert_eq!(ticks, [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]);
    }
}
