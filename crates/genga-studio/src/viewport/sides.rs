//! The bar above the views, which selects motion, side and overlays.

use egui::{Button, Ui};

use super::orbit::Orbit;
use crate::command::{Command, Seen, Standard};
use crate::view_state::Shown;

/// Shows the buttons.
pub(super) fn show(
    ui: &mut Ui,
    shown: &Shown<'_>,
    (seen, orbit): (Seen, &Orbit),
    (onion, trails, exaggerated): (bool, bool, bool),
    commands: &mut Vec<Command>,
) {
    let words = shown.words;
    let choices = [
        (Seen::Both, words.say("Both", "並べて")),
        (Seen::Source, words.say("Source", "素材")),
        (Seen::Result, words.say("Result", "結果")),
    ];
    for (which, name) in choices {
        if ui.add(Button::selectable(seen == which, name)).clicked() {
            commands.push(Command::See(which));
        }
    }
    ui.separator();
    for (side, name) in [
        (Standard::Front, words.say("Front", "正面")),
        (Standard::Side, words.say("Side", "側面")),
        (Standard::Top, words.say("Top", "真上")),
        (Standard::ThreeQuarter, words.say("Three-quarter", "斜め")),
    ] {
        let is_so = orbit.standard() == Some(side);
        if ui.add(Button::selectable(is_so, name)).clicked() {
            commands.push(Command::Look(side));
        }
    }
    ui.separator();
    if ui.button(words.say("Reference…", "参考…")).clicked() {
        commands.push(Command::AskFootage);
    }
    ui.separator();
    let shining = [
        (orbit.follows, words.say("Follow", "追従"), Command::Follow),
        (onion, words.say("Onion skin", "オニオンスキン"), Command::Onion),
        (trails, words.say("Trails", "軌跡"), Command::Trails),
        (exaggerated, words.say("Exaggerated", "誇張後"), Command::Exaggerated),
    ];
    // Without exaggeration there is nothing to compare.
    let count = shining.len() - usize::from(!shown.is_exaggerated());
    for (is_on, name, command) in shining.into_iter().take(count) {
        if ui.add(Button::selectable(is_on, name)).clicked() {
            commands.push(command);
        }
    }
}
