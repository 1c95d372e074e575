//! The bar above the views, which selects motion, side and overlays.

use egui::{Button, Ui};

use super::orbit::Orbit;
use crate::command::{Command, Seen, Standard};
use crate::panels::is_low;
use crate::view_state::Shown;

/// What is selected: the motion, the camera, and whether onion skin, trails and exaggeration are shown.
pub(super) struct Selected<'a> {
    pub(super) seen: Seen,
    pub(super) orbit: &'a Orbit,
    pub(super) onion: bool,
    pub(super) trails: bool,
    pub(super) exaggerated: bool,
}

/// Shows the buttons. In a low window all but those of the motion are in a menu.
pub(super) fn show(
    ui: &mut Ui,
    shown: &Shown<'_>,
    selected: &Selected<'_>,
    commands: &mut Vec<Command>,
) {
    motions(ui, shown, selected, commands);
    ui.separator();
    if is_low(ui.ctx().content_rect().size()) {
        ui.menu_button(shown.words.say("View", "表示"), |ui| {
            sides(ui, shown, selected, commands);
            ui.separator();
            overlays(ui, shown, selected, commands);
        });
        return;
    }
    sides(ui, shown, selected, commands);
    ui.separator();
    overlays(ui, shown, selected, commands);
}

fn motions(ui: &mut Ui, shown: &Shown<'_>, selected: &Selected<'_>, commands: &mut Vec<Command>) {
    let words = shown.words;
    let choices = [
        (Seen::Both, words.say("Both", "並べて")),
        (Seen::Source, words.say("Source", "素材")),
        (Seen::Result, words.say("Result", "結果")),
    ];
    for (which, name) in choices {
        if ui.add(Button::selectable(selected.seen == which, name)).clicked() {
            commands.push(Command::See(which));
        }
    }
}

fn sides(ui: &mut Ui, shown: &Shown<'_>, selected: &Selected<'_>, commands: &mut Vec<Command>) {
    let words = shown.words;
    for (side, name) in [
        (Standard::Front, words.say("Front", "正面")),
        (Standard::Side, words.say("Side", "側面")),
        (Standard::Top, words.say("Top", "真上")),
        (Standard::ThreeQuarter, words.say("Three-quarter", "斜め")),
    ] {
        let is_so = selected.orbit.standard() == Some(side);
        if ui.add(Button::selectable(is_so, name)).clicked() {
            commands.push(Command::Look(side));
        }
    }
}

fn overlays(ui: &mut Ui, shown: &Shown<'_>, selected: &Selected<'_>, commands: &mut Vec<Command>) {
    let words = shown.words;
    if ui.button(words.say("Reference…", "参考…")).clicked() {
        commands.push(Command::AskFootage);
    }
    ui.separator();
    let shining = [
        (selected.orbit.follows, words.say("Follow", "追従"), Command::Follow),
        (selected.onion, words.say("Onion skin", "オニオンスキン"), Command::Onion),
        (selected.trails, words.say("Trails", "軌跡"), Command::Trails),
        (selected.exaggerated, words.say("Exaggerated", "誇張後"), Command::Exaggerated),
    ];
    // Without exaggeration there is nothing to compare.
    let count = shining.len() - usize::from(!shown.is_exaggerated());
    for (is_on, name, command) in shining.into_iter().take(count) {
        if ui.add(Button::selectable(is_on, name)).clicked() {
            commands.push(command);
        }
    }
}
