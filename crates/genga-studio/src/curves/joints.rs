//! The list of joints (関節) in order of movement, with a search.

use egui::{ScrollArea, TextEdit, Ui};

use crate::focus;
use crate::view_state::Shown;
use genga::motion::JointId;

/// Greatest number of joints shown. More curves could not be read.
const MOST: usize = 6;

/// Shows the list and updates the choice.
pub(super) fn show(
    ui: &mut Ui,
    shown: &Shown<'_>,
    order: &[JointId],
    search: &mut String,
    chosen: &mut Vec<JointId>,
) {
    let words = shown.words;
    let hint = words.say("Search joints", "関節を探す");
    ui.add(TextEdit::singleline(search).hint_text(hint).desired_width(f32::INFINITY))
        .accessible_name(hint);
    let wanted = search.to_lowercase();
    let joints = &shown.breakdown.clip.skeleton().joints;
    ScrollArea::vertical().id_salt("joints").auto_shrink(false).show(ui, |ui| {
        for joint in order {
            let name = &joints[joint.0].name;
            if !name.to_lowercase().contains(&wanted) {
                continue;
            }
            let at = chosen.iter().position(|other| other == joint);
            let mut is_chosen = at.is_some();
            let is_room = is_chosen || chosen.len() < MOST;
            let response = ui.add_enabled_ui(is_room, |ui| ui.checkbox(&mut is_chosen, name)).inner;
            match at {
                _ if !response.changed() => {}
                Some(at) => drop(chosen.remove(at)),
                None => chosen.push(*joint),
            }
        }
        focus::bring_into_view(ui);
    });
}
