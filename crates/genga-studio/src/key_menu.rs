//! Actions on a key, as a menu and as a small panel.

use egui::{DragValue, Label, RichText, TextEdit, Ui, UiBuilder, vec2};

use super::column::KeyedCell;
use super::command::Command;
use super::corrections::Correction;
use super::icon::{self, Icon};
use super::knobs::is_other;
use super::playhead_edits::MOST_WEIGHT;
use super::strip::feet;
use super::view_state::Shown;
use super::why;
use super::words::Words;
use genga::keys::{Key, Origin};

/// The menu of a key.
pub(super) fn show(ui: &mut Ui, key: &Key, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    for (name, correction) in choices(key, shown) {
        if ui.button(name).clicked() {
            commands.push(Command::Correct(correction));
            ui.close();
        }
    }
}

/// The menu of a koma without a key.
pub(super) fn show_none(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    if ui.button(shown.words.say("Pin here", "ここを固定")).clicked() {
        pin_here(shown, commands);
        ui.close();
    }
}

fn pin_here(shown: &Shown<'_>, commands: &mut Vec<Command>) {
    commands.push(Command::Correct(Correction::Pin(shown.frame_of_koma(shown.at))));
}

/// Actions on a key that need no further input.
fn choices(key: &Key, shown: &Shown<'_>) -> Vec<(&'static str, Correction)> {
    let words = shown.words;
    let place = shown.column().place_of(key);
    let forbid = (words.say("Forbid", "禁止"), Correction::Forbid(key.clone(), place));
    let take_back = Correction::TakeBack(key.clone());
    match key.origin {
        Origin::Turn | Origin::Fill | Origin::Rest | Origin::Contact | Origin::Step => {
            vec![(words.say("Pin", "固定"), Correction::PinKey(key.clone())), forbid]
        }
        Origin::Pinned => vec![(words.say("Unpin", "固定を解除"), take_back), forbid],
        Origin::Moved { .. } => vec![(words.say("Move back", "元の位置へ"), take_back), forbid],
    }
}

/// Longest hold that can be set in the panel, in koma: two seconds.
const LONGEST: usize = 48;
/// Height of the panel in points. It is fixed, so that the sheet below stays in place.
const HEIGHT: f32 = 160.0;
/// Height of the reason in points: three lines.
const REASON: f32 = 42.0;

/// State of the panel of the key at the play head.
#[derive(Debug, Clone, Default)]
pub(super) struct KeyPanel {
    /// The key whose name is being typed, and the text.
    typed: Option<(Key, String)>,
    /// Whether the name field is to be focused.
    pub(super) wants_focus: bool,
}

impl KeyPanel {
    /// Shows the key, or the choice to set one.
    pub(super) fn show(&mut self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let (_, place) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
        let inside = ui.clip_rect().intersect(place.expand(2.0));
        // A child, so that what follows begins below the reserved space whatever the child contains.
        let mut child = ui.new_child(UiBuilder::new().max_rect(place));
        child.set_clip_rect(inside);
        self.inside(&mut child, shown, commands);
    }

    fn inside(&mut self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let words = shown.words;
        let cell = shown.column().cell(shown.at);
        let Some(key) = shown.column().key(shown.at) else {
            self.wants_focus = false;
            match cell.genga_number() {
                Some(number) => {
                    ui.strong(format!("{} {number}", words.say("Genga", "原画")));
                    reason(ui, &whole_reason(cell, shown));
                }
                None => _ = ui.strong(words.say("Inbetween", "中割り")),
            }
            show_none(ui, shown, commands);
            hold(ui, shown, commands);
            return;
        };
        ui.horizontal(|ui| {
            let number = cell.genga_number().map_or_else(String::new, |number| number.to_string());
            ui.strong(format!("{} {number}", words.say("Genga", "原画")));
            let (koma, frame) = (shown.column().koma_of(key.frame) + 1, key.frame);
            ui.weak(match words.is_japanese() {
                true => format!("コマ {koma} · フレーム {frame}"),
                false => format!("koma {koma} · frame {frame}"),
            });
        });
        reason(ui, &whole_reason(cell, shown));
        ui.horizontal(|ui| {
            show(ui, key, shown, commands);
            // The buttons before act on the drawing that stays; this one on the koma where the play head stands.
            let here = shown.at + 1;
            let name = match words.is_japanese() {
                true => format!("コマ{here}を固定"),
                false => format!("Pin koma {here}"),
            };
            if shown.at != cell.koma && ui.button(name).clicked() {
                pin_here(shown, commands);
            }
        });
        self.name(ui, key, words, commands);
        weight(ui, key, shown, commands);
        hold(ui, shown, commands);
    }

    /// Shows the name field. The name takes effect when the field is left, so that undo takes back a name, not a
    /// letter.
    fn name(&mut self, ui: &mut Ui, key: &Key, words: Words, commands: &mut Vec<Command>) {
        let own = key.name.clone().unwrap_or_default();
        let is_of_this = self.typed.as_ref().is_some_and(|(typed, _)| typed.frame == key.frame);
        let mut text = match &self.typed {
            Some((_, text)) if is_of_this => text.clone(),
            _ => own.clone(),
        };
        let field = TextEdit::singleline(&mut text)
            .id_salt("key name")
            .desired_width(f32::INFINITY)
            .hint_text(words.say("name", "名前"));
        let response = ui.add(field).accessible_name(words.say("Name of the genga", "原画の名前"));
        if std::mem::take(&mut self.wants_focus) {
            response.request_focus();
        }
        if response.has_focus() {
            self.typed = Some((key.clone(), text));
        } else if let Some((typed, text)) = self.typed.take()
            && text.trim() != typed.name.as_deref().unwrap_or_default()
            && !ui.input(|input| input.key_down(egui::Key::Escape))
        {
            commands.push(Command::Correct(Correction::Name(typed, text)));
        }
    }
}

/// Returns why the drawing is there, after the foot that comes down with it.
fn whole_reason(cell: &KeyedCell<'_>, shown: &Shown<'_>) -> String {
    let why = why::sentence(&cell.drawing.why, shown.words);
    let contact = feet::contact_at(cell.koma, shown).map(str::to_owned);
    let both: Vec<String> =
        contact.into_iter().chain([why]).filter(|part| !part.is_empty()).collect();
    both.join(shown.words.say("; ", "、"))
}

/// Shows why the drawing is there, in three lines, with the full text as a tooltip.
fn reason(ui: &mut Ui, text: &str) {
    let (_, place) = ui.allocate_space(vec2(ui.available_width(), REASON));
    let label = Label::new(RichText::new(text).size(11.0).weak()).wrap();
    let inside = ui.clip_rect().intersect(place);
    let mut child = ui.new_child(UiBuilder::new().max_rect(place));
    child.set_clip_rect(inside);
    child.add(label).on_hover_text(text);
}

/// Shows the spacing weight from this key on.
fn weight(ui: &mut Ui, key: &Key, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    let words = shown.words;
    let label = words.say("Own spacing weight", "この原画だけの詰め");
    ui.horizontal(|ui| {
        let mut is_own = key.weight.is_some();
        if ui.checkbox(&mut is_own, label).changed() {
            let (recipe, last) = (&shown.wanted.recipe, shown.breakdown.source.last());
            let weight = is_own.then(|| shown.column().usual_weight(key, recipe, last));
            commands.push(Command::Correct(Correction::Weight(key.clone(), weight)));
        }
        if let Some(own) = key.weight {
            let mut weight = own;
            let value = DragValue::new(&mut weight).range(0.0..=MOST_WEIGHT).speed(0.01);
            let value = ui.add(value.fixed_decimals(2)).accessible_name(label);
            if value.changed() && is_other(weight, own) {
                commands.push(Command::Correct(Correction::Weight(key.clone(), Some(weight))));
            }
        }
    });
}

/// Shows how long the drawing at the play head stays.
fn hold(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    let (words, cell) = (shown.words, shown.column().cell(shown.at));
    let frame = cell.hold_frame(&shown.wanted.edits);
    ui.horizontal(|ui| {
        let label = words.say("Hold", "止め");
        ui.label(label);
        let mut koma = cell.held;
        let value = DragValue::new(&mut koma).range(1..=LONGEST).speed(0.1);
        let value = ui.add(value.suffix(words.say(" koma", "コマ"))).accessible_name(label);
        if value.changed() {
            commands.push(Command::Correct(Correction::Hold(frame, koma)));
        }
        let back = words.say("Reset the hold", "止めを元に戻す");
        if cell.drawing.why.hold_set && icon::button(ui, Icon::Back, back).clicked() {
            commands.push(Command::Correct(Correction::LetGo(frame)));
        }
    });
}
