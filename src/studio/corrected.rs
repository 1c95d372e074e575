//! The list of corrections (修正の一覧): every one there is, to go to or to take back.

use egui::{CollapsingHeader, RichText, Ui};

use super::command::Command;
use super::corrections::Correction;
use super::icon::{self, Icon};
use super::shown::Shown;
use super::words::Words;
use crate::edits::Pin;
use crate::keys::{Key, Origin};
use crate::time::Frame;

/// Shows the list; nothing where nothing was corrected.
pub(super) fn show(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    let (edits, words) = (&shown.wanted.edits, shown.words);
    let keys = edits.pins.len() + edits.moves.len() + edits.forbidden.len();
    let count = keys + edits.holds.len();
    if count == 0 && !edits.again {
        return;
    }
    let title = format!("{} ({count})", words.say("Corrections", "修正"));
    let header = CollapsingHeader::new(RichText::new(title).strong()).id_salt("corrections");
    header.default_open(true).show_unindented(ui, |ui| {
        again(ui, shown, commands);
        for pin in &edits.pins {
            let what = format!("{} {}", words.say("locked", "固定"), pin.frame);
            let what = with_mark(what, pin, words);
            let back = Correction::TakeBack(key(pin.frame, Origin::Pinned));
            row(ui, &what, Some(pin.frame), back, shown, commands);
        }
        for moved in &edits.moves {
            let (from, to) = (moved.from, moved.to);
            let (moves, arrow) = (words.say("moved", "移動"), words.say("to", "→"));
            let what = with_mark(format!("{moves} {from} {arrow} {to}"), &moved.pin(), words);
            let back = Correction::TakeBack(key(moved.to, Origin::Moved { from: moved.from }));
            row(ui, &what, Some(moved.to), back, shown, commands);
        }
        for range in &edits.forbidden {
            let what = format!("{} {range}", words.say("no genga", "原画にしない"));
            let at = Some(range.from).filter(|frame| shown.breakdown.clip.contains(*frame));
            row(ui, &what, at, Correction::Allow(*range), shown, commands);
        }
        for hold in &edits.holds {
            let koma = shown.words.say("koma", "コマ");
            let what =
                format!("{} {}: {} {koma}", words.say("held", "止め"), hold.frame, hold.koma);
            let back = Correction::LetGo(hold.frame);
            row(ui, &what, Some(hold.frame), back, shown, commands);
        }
    });
}

/// Whether each correction changes its neighbourhood alone, or all keys are chosen again around them.
fn again(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    if shown.wanted.edits.freeze() {
        return;
    }
    let mut again = shown.wanted.edits.again;
    let label = shown.words.say("Find all genga again", "原画を全部選び直す");
    let hint = shown.words.say(
        "On: every genga is chosen anew around the corrections. Off: each changes its own neighbourhood alone.",
        "入: 修正に合わせて原画をすべて選び直す。切: 修正した前後の原画の間だけが変わる。",
    );
    if ui.checkbox(&mut again, label).on_hover_text(hint).changed() {
        commands.push(Command::Correct(Correction::Again(again)));
    }
}

/// With the name and the spacing weight that a person gave.
fn with_mark(what: String, pin: &Pin, words: Words) -> String {
    let name = pin.name.as_ref().map(|name| format!(" {name}")).unwrap_or_default();
    let spacing = words.say("spacing", "詰め");
    let weight = pin.weight.map(|weight| format!(", {spacing} {weight:.2}")).unwrap_or_default();
    what + &name + &weight
}

fn row(
    ui: &mut Ui,
    what: &str,
    at: Option<Frame>,
    back: Correction,
    shown: &Shown<'_>,
    commands: &mut Vec<Command>,
) {
    let what = what.trim();
    ui.horizontal(|ui| {
        let name = format!("{}: {what}", shown.words.say("Take back", "取り消す"));
        if icon::button(ui, Icon::Cross, &name).clicked() {
            commands.push(Command::Correct(back));
        }
        if ui.link(what).clicked()
            && let Some(frame) = at
        {
            commands.push(Command::Go(shown.column.clock.koma_from_frame(frame)));
        }
    });
}

/// A key as a correction knows it: by frame and origin.
fn key(frame: Frame, origin: Origin) -> Key {
    let (voters, weight, name) = (Vec::new(), None, None);
    Key { frame, strength: 1.0, price: f64::INFINITY, voters, weight, name, origin }
}
