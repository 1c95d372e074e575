//! The three goals (目標): how many genga, how many drawings a second, how snappy. Each is a slider between two small
//! pictures, with its effect written beside it. Presets set all three; everything else is in the expert settings.

mod effect;
pub(super) mod presets;
mod signs;
pub(super) mod stops;

use egui::{
    Button, Color32, ComboBox, Label, Layout, Response, RichText, Slider, SliderClamping,
    TextStyle, Ui, UiBuilder, vec2,
};

use self::presets::PRESETS;
use self::signs::End;
use self::stops::{PACE, Path, SNAP};
use super::command::Command;
use super::counts::Counts;
use super::focus::Part;
use super::panels::Side;
use super::theme::Look;
use super::words::Words;
use genga::keys::Layers;
use genga::recipe::{Frames, Recipe};

/// Width from which presets stand side by side, in points, and the room they take then and else.
const WIDE: f32 = 1100.0;
const PRESETS_WIDE: f32 = 290.0;
const PRESETS_NARROW: f32 = 112.0;
/// Height of the row, and the gap between goals, in points.
const HEIGHT: f32 = 46.0;
const GAP: f32 = 14.0;
/// Width of a goal from which its pictures are shown, in points.
const PICTURED: f32 = 190.0;
/// Width of a goal from which its effect is written in full, in points.
const ROOMY: f32 = 290.0;
/// Room for the number of genga beside its slider, in points.
const NUMBER: f32 = 52.0;
/// Fewest genga that can be asked for: both ends of the clip.
const FEWEST: usize = 2;

/// One of the three goals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Goal {
    /// How many genga (原画の枚数).
    Genga,
    /// How many drawings a second (動画の枚数).
    Pace,
    /// How snappy (メリハリ).
    Snap,
}

impl Goal {
    const ALL: [Self; 3] = [Self::Genga, Self::Pace, Self::Snap];

    /// Name of the goal.
    pub(super) fn name(self, words: Words) -> &'static str {
        match self {
            Self::Genga => words.say("How many genga", "原画の枚数"),
            Self::Pace => words.say("Drawings a second", "1秒の動画枚数"),
            Self::Snap => words.say("How snappy", "メリハリ"),
        }
    }

    fn help(self, words: Words) -> &'static str {
        match self {
            Self::Genga => words.say(
                "Few: only the strongest poses. Many: small turns too.\n(--keys: keys.min_price, keys.per_second)",
                "少ないと強いポーズだけ、多いと小さな変わり目も原画になる。\n(--keys: keys.min_price, keys.per_second)",
            ),
            Self::Pace => words.say(
                "Few: on threes with long holds. Many: on ones, nothing held.\n(spacing.on, spacing.drift, \
                 omission.koma_dori)",
                "少ないと3コマ打ちで止めが長く、多いと1コマ打ちで止めがない。\n(spacing.on, spacing.drift, \
                 omission.koma_dori)",
            ),
            Self::Snap => words.say(
                "Left: inbetweens at equal distances. Right: crowded at the genga, the fastest left out. Far right: \
                 anticipation and follow-through too.\n(spacing.weight, omission.naka_nashi, exaggerate.cartoon)",
                "左は中割りが等間隔。右ほど原画の近くに詰まり、最も速い中割りを抜く。右端では予備動作と後追いも加わる。\n\
                 (spacing.weight, omission.naka_nashi, exaggerate.cartoon)",
            ),
        }
    }
}

/// State of the goals: the number of genga that a drag asks for.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Goals {
    asked: Option<usize>,
}

/// What the goals show.
pub(super) struct Seen<'a> {
    pub(super) recipe: &'a Recipe,
    /// The passage that the recipe is of, if a marked range is one.
    pub(super) passage: Option<Frames>,
    pub(super) counts: &'a Counts,
    /// The counts before the last change.
    pub(super) before: &'a Counts,
    pub(super) is_expert: bool,
    pub(super) look: &'a Look,
    pub(super) words: Words,
}

impl Goals {
    /// Shows presets and goals in a row.
    pub(super) fn show(&mut self, ui: &mut Ui, seen: &Seen<'_>, commands: &mut Vec<Command>) {
        let (all, is_wide) = (ui.available_width(), ui.available_width() >= WIDE);
        let (_, row) = ui.allocate_space(vec2(all, HEIGHT));
        let first = if is_wide { PRESETS_WIDE } else { PRESETS_NARROW };
        let each = (all - first) / Goal::ALL.len() as f32 - GAP;
        let mut room = row;
        room.max.x = row.min.x + first;
        within(ui, room, |ui| presets(ui, is_wide, seen, commands));
        for goal in Goal::ALL {
            room.min.x = room.max.x + GAP;
            room.max.x = room.min.x + each;
            within(ui, room, |ui| self.goal(ui, goal, seen, commands));
        }
    }

    /// Shows a goal: its name and effect, and below them its slider between the pictures of its ends.
    fn goal(&mut self, ui: &mut Ui, goal: Goal, seen: &Seen<'_>, commands: &mut Vec<Command>) {
        let wide = ui.available_width();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            ui.label(RichText::new(goal.name(seen.words)).strong());
            if let Some(frames) = seen.passage.filter(|_| goal != Goal::Genga) {
                ui.label(RichText::new(frames.to_string()).color(seen.look.playhead));
            }
            let whole = effect::of(goal, seen);
            let effect = if wide < ROOMY || !fits(ui, &whole) {
                effect::in_short(goal, seen)
            } else {
                whole.clone()
            };
            let ink = if effect::is_new(goal, seen) { seen.look.playhead } else { seen.look.faint };
            ui.add(Label::new(RichText::new(&effect).color(ink)).truncate()).on_hover_text(whole);
        });
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            let is_pictured = wide >= PICTURED;
            let pictures = if is_pictured { 2.0 * (signs::WIDE + 6.0) } else { 0.0 };
            let number = if goal == Goal::Genga { NUMBER } else { 0.0 };
            ui.spacing_mut().slider_width = (wide - pictures - number).max(40.0);
            if is_pictured {
                signs::show(ui, goal, End::Few, seen);
            }
            let slider = match goal {
                Goal::Genga => self.genga(ui, seen, commands),
                Goal::Pace => along(ui, &PACE, seen, commands),
                Goal::Snap => along(ui, &SNAP, seen, commands),
            };
            slider.on_hover_text(goal.help(seen.words)).accessible_name(goal.name(seen.words));
            if is_pictured {
                signs::show(ui, goal, End::Many, seen);
            }
        });
    }

    /// The slider of the number of genga, which any number can be typed into.
    fn genga(&mut self, ui: &mut Ui, seen: &Seen<'_>, commands: &mut Vec<Command>) -> Response {
        let most = seen.counts.most_genga(seen.recipe.spacing.on).max(FEWEST + 1);
        let before = self.asked.unwrap_or(seen.counts.genga);
        let mut count = before;
        let slider = Slider::new(&mut count, FEWEST..=most).logarithmic(true).integer();
        let slider = ui.add_enabled(seen.recipe.layers == Layers::Body, slider);
        if slider.changed() && count != before {
            self.asked = Some(count);
            commands.push(Command::Keys(count));
        }
        if !ui.input(|input| input.pointer.any_down()) && !slider.changed() {
            self.asked = None;
        }
        slider.on_disabled_hover_text(seen.words.say(
            "The number is asked of the body as one layer: set it before the sheet is split.",
            "枚数は全身を1枚のセルとして決める。セルに分ける前に決めてください。",
        ))
    }
}

/// Whether a text fits into what is left of a row.
fn fits(ui: &Ui, text: &str) -> bool {
    let font = TextStyle::Body.resolve(ui.style());
    let text = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    text.size().x <= ui.available_width()
}

/// The slider along a path of stops. A recipe that is at none of them stands between the nearest.
fn along(
    ui: &mut Ui,
    path: &'static Path,
    seen: &Seen<'_>,
    commands: &mut Vec<Command>,
) -> Response {
    let own = path.place(seen.recipe);
    let mut place = own;
    let last = (path.stops.len() - 1) as f64;
    let slider = Slider::new(&mut place, 0.0..=last).show_value(false).step_by(1.0);
    let slider = ui.add(slider.clamping(SliderClamping::Never));
    signs::stops(ui, slider.rect, path.stops.len(), own, seen.look);
    let stop = place.round().clamp(0.0, last) as usize;
    if slider.changed() && !path.stops[stop].is_in(seen.recipe) {
        commands.push(Command::SetAll(path.stops[stop].settings));
    }
    slider
}

/// Shows the presets: side by side, or as a list.
fn presets(ui: &mut Ui, is_wide: bool, seen: &Seen<'_>, commands: &mut Vec<Command>) {
    let words = seen.words;
    let expert = words.say("Expert", "詳細");
    if is_wide {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
            choices(ui, seen, commands);
            expert_button(ui, expert, seen, commands);
        });
        return;
    }
    let at_one = PRESETS.iter().find(|preset| preset.is_in(seen.recipe));
    let shown = at_one.map_or(words.say("Preset", "プリセット"), |preset| {
        words.say(preset.english, preset.japanese)
    });
    let list = ComboBox::from_id_salt("presets").width(PRESETS_NARROW - 8.0).selected_text(shown);
    let list = list.truncate().show_ui(ui, |ui| choices(ui, seen, commands));
    Part::Goals.begins(&list.response);
    list.response.accessible_name(words.say("Preset", "プリセット"));
    expert_button(ui, expert, seen, commands);
}

fn expert_button(ui: &mut Ui, name: &str, seen: &Seen<'_>, commands: &mut Vec<Command>) {
    let hint = seen.words.say("All other settings (7)", "そのほかの設定 (7)");
    if ui.add(Button::selectable(seen.is_expert, name)).on_hover_text(hint).clicked() {
        commands.push(Command::Panel(Side::Knobs));
    }
}

fn choices(ui: &mut Ui, seen: &Seen<'_>, commands: &mut Vec<Command>) {
    for (at, preset) in PRESETS.iter().enumerate() {
        let name = seen.words.say(preset.english, preset.japanese);
        let button = ui.add(Button::selectable(preset.is_in(seen.recipe), name));
        if at == 0 {
            Part::Goals.begins(&button);
        }
        let hint = seen.words.say(preset.help, preset.japanese_help);
        if button.on_hover_text(hint).clicked() {
            commands.push(Command::Preset(preset));
            ui.close();
        }
    }
    let name = seen.words.say("Defaults", "初期値");
    if ui.add(Button::selectable(*seen.recipe == Recipe::default(), name)).clicked() {
        commands.push(Command::Defaults);
        ui.close();
    }
}

/// Fills a part of the row.
fn within(ui: &mut Ui, room: egui::Rect, fill: impl FnOnce(&mut Ui)) {
    let builder = UiBuilder::new().max_rect(room).layout(Layout::top_down(egui::Align::Min));
    ui.scope_builder(builder, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        fill(ui);
    });
}

#[cfg(test)]
mod tests;
