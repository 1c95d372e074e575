//! Says that a pin took the place of a genga beside it, and offers to keep both.

use egui::Ui;

use super::command::Command;
use super::corrections::Correction;
use super::difference::Replaced;
use super::focus::Part;
use super::icon::{self, Icon};
use super::notice;
use super::theme::Look;
use super::words::Words;

/// Shows what was replaced, if anything was.
pub(super) fn show(
    ui: &mut Ui,
    replaced: &[Replaced],
    (look, words): (&Look, Words),
    commands: &mut Vec<Command>,
) {
    let [first, others @ ..] = replaced else { return };
    notice::one(ui, look.playhead, |ui| {
        ui.horizontal_wrapped(|ui| {
            let close = icon::button(ui, Icon::Cross, words.say("Close the message", "閉じる"));
            Part::Notices.begins(&close);
            if close.clicked() {
                commands.push(Command::Dismiss);
            }
            ui.label(sentence(*first, others.len(), words));
            if ui.button(words.say("Keep both", "両方残す")).clicked() {
                let pins = replaced.iter().map(|own| Correction::Pin(own.gone.frame()));
                commands.extend(pins.map(Command::Correct));
            }
        });
    });
}

/// Names the koma of the genga that went, and of the pin.
fn sentence(Replaced { gone, by }: Replaced, others: usize, words: Words) -> String {
    let (gone, by) = (gone.koma + 1, by + 1);
    match (words.is_japanese(), others) {
        (false, 0) => format!("The pin on koma {by} replaces the genga on koma {gone}."),
        (false, _) => format!("Pins replace {} genga beside them.", others + 1),
        (true, 0) => format!("コマ{by}の固定で、コマ{gone}の原画がなくなりました。"),
        (true, _) => format!("固定したコマの隣で、原画{}枚がなくなりました。", others + 1),
    }
}
