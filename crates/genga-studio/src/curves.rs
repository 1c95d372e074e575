//! The curves (速度のグラフ): the speeds of the chosen joints before and after the filter, with keys and walls. Below them
//! stand the movement of the body into each koma and the loudness of the sound, above them the numbers of the genga and
//! the dots of the inbetweens. Keys can be corrected here frame by frame, and inbetweens pulled towards them.

mod joints;
mod lane;
mod movement;
mod pointer;
mod ruler;
mod sound;

use egui::{Id, Panel, Rect, Role, Sense, Stroke, Ui, WidgetInfo, vec2};

use self::pointer::Hand;
use super::command::Command;
use super::focus::{self, Part};
use super::key_menu;
use super::player::Player;
use super::time_axis::{Scale, Window};
use super::view_state::Shown;
use genga::motion::JointId;

/// Greatest and least width of the list of joints, and its share of the available width.
const LIST: f32 = 170.0;
const LEAST_LIST: f32 = 104.0;
const SHARE: f32 = 0.3;
/// Space for the values left of the curves.
const VALUES: f32 = 40.0;

/// State of the curves: which joints are shown, and which part of the clip.
#[derive(Debug, Clone, Default)]
pub(super) struct Curves {
    /// The joints whose curves and trails are drawn.
    pub(super) chosen: Vec<JointId>,
    /// Whether the movement into each koma is drawn.
    pub(super) movement: bool,
    /// All joints, those that move most first.
    order: Vec<JointId>,
    search: String,
    window: Window,
    hand: Hand,
}

impl Curves {
    /// Creates the curves of a clip, given its joints in order of movement. The first two are shown.
    pub(super) fn new(order: Vec<JointId>) -> Self {
        let chosen = order.iter().take(2).copied().collect();
        Self { chosen, movement: true, order, ..Self::default() }
    }

    /// Shows the list of joints and the curves.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        shown: &Shown<'_>,
        player: &Player,
        commands: &mut Vec<Command>,
    ) {
        let wide = (SHARE * ui.available_width()).clamp(LEAST_LIST, LIST);
        let list = Panel::left("joints").exact_size(wide).resizable(false);
        list.show(ui, |ui| {
            let name = shown.words.say("Movement (SSD)", "動きの大きさ (SSD)");
            ui.checkbox(&mut self.movement, name);
            joints::show(ui, shown, &self.order, &mut self.search, &mut self.chosen)
        });
        let rect = ui.available_rect_before_wrap();
        let response = ui.interact(rect, Id::unique("curves"), Sense::click_and_drag());
        Part::Curves.begins(&response);
        let clip = shown.breakdown.clip;
        self.window.fit((clip.first().0 as f64, clip.last().0 as f64));
        let inside = rect.with_min_x(rect.min.x + VALUES).shrink2(vec2(12.0, 0.0));
        self.window.handle(ui, &response, inside);
        self.window.walk(focus::take_arrows(&response).0, shown.frame_of_koma(shown.at));
        let time = self.window.scale(inside);
        let top = Rect::from_min_size(inside.min, vec2(inside.width(), ruler::HEIGHT));
        self.hand.handle(&response, top, &time, shown, commands);
        self.draw(ui, (rect, inside, top), &time, shown, player);
        let name = shown.words.say("Speed curves", "速度のグラフ");
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, name));
        response.context_menu(|ui| match &self.hand.asked {
            Some(key) => key_menu::show(ui, key, shown, commands),
            None => key_menu::show_none(ui, shown, commands),
        });
        ui.advance_cursor_after_rect(rect);
    }

    fn draw(
        &self,
        ui: &Ui,
        (rect, inside, top): (Rect, Rect, Rect),
        time: &Scale,
        shown: &Shown<'_>,
        player: &Player,
    ) {
        let (painter, look) = (ui.painter_at(rect), &shown.look);
        painter.rect_filled(rect, 0.0, look.paper);
        let place = |koma: usize| time.x(shown.column().clock.place_from_koma(koma));
        if let Some(range) = &player.range {
            let played = place(range.start)..=place(range.end);
            painter.rect_filled(Rect::from_x_y_ranges(played, inside.y_range()), 0.0, look.chosen);
        }
        let below = inside.with_min_y(top.max.y);
        let is_heard = shown.beside.waveform.is_some();
        let count = self.chosen.len() + usize::from(self.movement) + usize::from(is_heard);
        let high = below.height() / count.max(1) as f32;
        let lane = |at: usize| {
            let corner = below.min + vec2(0.0, high * at as f32);
            Rect::from_min_size(corner, vec2(below.width(), high)).shrink2(vec2(0.0, 3.0))
        };
        // For all joints at once: the dead band depends on the speeds of the whole body.
        let (turns, filtered) = (&shown.wanted.recipe.turns, shown.breakdown.filtered);
        let steady = turns.steady_steps(filtered, &self.chosen);
        for (at, (joint, steps)) in self.chosen.iter().zip(&steady).enumerate() {
            lane::draw(&painter, lane(at), (*joint, steps), time, shown);
        }
        if self.movement {
            movement::draw(&painter, lane(self.chosen.len()), time, shown);
        }
        if is_heard {
            sound::draw(&painter, lane(count - 1), time, shown);
        }
        painter.vline(place(shown.at), inside.y_range(), Stroke::new(2.0, look.playhead));
        ruler::draw(&painter, top, inside.max.y, time, shown);
        let names = self.names(shown);
        let titles: Vec<_> = names.enumerate().map(|(at, name)| (lane(at), name)).collect();
        lane::titles(&painter, &titles, look);
    }

    /// Titles of the lanes, from top to bottom.
    fn names<'a>(&self, shown: &Shown<'a>) -> impl Iterator<Item = &'a str> {
        let (joints, words) = (&shown.breakdown.clip.skeleton().joints, shown.words);
        let own = self.chosen.iter().map(|joint| joints[joint.0].name.as_str());
        let movement = words.say("Movement √SSD", "動きの大きさ √SSD");
        let is_heard = shown.beside.waveform.is_some();
        own.chain(self.movement.then_some(movement))
            .chain(is_heard.then(|| words.say("Sound", "音")))
    }
}
