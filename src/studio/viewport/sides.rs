//! The bar over the views: what is seen, from which side, and what shines through.

use egui::{Button, Ui};

use super::{Seen, Standard, Viewport};
use crate::studio::keyboard::Command;
use crate::studio::shown::Shown;

/// Shows the buttons.
pub(super) fn show(
    ui: &mut Ui,
    shown: &Shown<'_>,
    viewport: &Viewport,
    commands: &mut Vec<Command>,
) {
    let words = shown.words;
    let seen = [
        (Seen::Both, words.say("Both", "並べて")),
        (Seen::Source, words.say("Source", "素材")),
        (Seen::Result, words.say("Result", "結果")),
    ];
    for (which, name) in seen {
        if ui.add(Button::selectable(viewport.seen == which, name)).clicked() {
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
        let is_so = viewport.orbit.standard() == Some(side);
        if ui.add(Button::selectable(is_so, name)).clicked() {
            commands.push(Command::Look(side));
        }
    }
    ui.separator();
    let follow = words.say("Follow", "追従");
    if ui.add(Button::selectable(viewport.orbit.follows, follow)).clicked() {
        commands.push(Command::Follow);
    }
    let onion = words.say("Onion skin", "オニオンスキン");
    if ui.add(Button::selectable(viewport.onion, onion)).clicked() {
        commands.push(Command::Onion);
    }
    let trails = words.say("Trails", "軌跡");
    if ui.add(Button::selectable(viewport.trails, trails)).clicked() {
        commands.push(Command::Trails);
    }
}
