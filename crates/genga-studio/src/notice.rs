//! Notices (お知らせ): messages over the table. The layout below does not move when one comes or goes.

use egui::{Align2, Area, Color32, Frame, Id, Label, Order, Stroke, Ui, Vec2, vec2};

use super::command::Command;
use super::focus::Part;
use super::icon::{self, Icon};
use super::panels;
use super::theme::Look;
use super::words::Words;

/// Distance of the first notice from the top, below the goals, in points; and in a low window, which has no room to spare.
const TOP: f32 = 80.0;
const TOP_IF_LOW: f32 = 58.0;
/// Greatest width of a notice, in points.
const WIDE: f32 = 860.0;

/// A message to the person.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Message {
    pub(super) text: String,
    /// Japanese translation, if available.
    pub(super) japanese: Option<String>,
    pub(super) is_failure: bool,
}

impl Message {
    /// Creates a message about a failure.
    pub(super) fn failure(text: String) -> Self {
        Self { text, japanese: None, is_failure: true }
    }
}

/// Distance of the first notice from the top of a window.
pub(super) fn top(window: Vec2) -> f32 {
    if panels::is_low(window) { TOP_IF_LOW } else { TOP }
}

/// Shows notices one below the other, above everything else.
pub(super) fn over(ui: &Ui, add: impl FnOnce(&mut Ui)) {
    let area = Area::new(Id::unique("notices")).order(Order::Foreground);
    let window = ui.ctx().content_rect().size();
    area.anchor(Align2::CENTER_TOP, vec2(0.0, top(window))).show(ui.ctx(), |ui| {
        ui.set_max_width(WIDE.min(window.x - 40.0));
        ui.spacing_mut().item_spacing.y = 6.0;
        add(ui);
    });
}

/// Shows a notice.
pub(super) fn one(ui: &mut Ui, color: Color32, add: impl FnOnce(&mut Ui)) {
    let frame = Frame::popup(ui.style()).stroke(Stroke::new(1.5, color)).inner_margin(8);
    frame.show(ui, add);
}

/// Shows a message with a button that closes it.
pub(super) fn message(
    ui: &mut Ui,
    message: &Message,
    look: &Look,
    words: Words,
    commands: &mut Vec<Command>,
) {
    let color = if message.is_failure { look.genga } else { look.playhead };
    one(ui, color, |ui| {
        ui.horizontal_top(|ui| {
            let close = words.say("Close the message", "閉じる");
            let close = icon::button(ui, Icon::Cross, close);
            Part::Notices.begins(&close);
            if close.clicked() {
                commands.push(Command::Dismiss);
            }
            let japanese = message.japanese.as_deref().unwrap_or(&message.text);
            ui.add(Label::new(words.say(&message.text, japanese)).wrap());
        });
    });
}

/// Offers to recover the unsaved work of an earlier session.
pub(super) fn recovery(ui: &mut Ui, look: &Look, words: Words, commands: &mut Vec<Command>) {
    // An offer is no failure, so its frame is not red.
    one(ui, look.playhead, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.label(words.say(
                "Unsaved corrections from an earlier session were found.",
                "前回保存されなかった修正があります。",
            ));
            let recover = ui.button(words.say("Recover", "復元"));
            Part::Notices.begins(&recover);
            if recover.clicked() {
                commands.push(Command::Recover);
            }
            if ui.button(words.say("Discard", "破棄")).clicked() {
                commands.push(Command::Discard);
            }
        });
    });
}
