//! Corrections in command-line form (修正の一覧), for messages.

use super::format_args::shortened;
use genga::edits::{Edits, Forbidden, Move, Pin};

/// Maximum number of corrections in a full list.
const MOST: usize = 12;

pub(super) fn shortened_list(corrections: Vec<String>) -> String {
    let count = corrections.len();
    let shown = if count > MOST { shortened(corrections) } else { corrections };
    shown.join(", ")
}

/// Lists corrections in command-line form.
pub(super) fn list(edits: &Edits) -> Vec<String> {
    let mut list = marks("", &edits.pins, &edits.forbidden, &edits.moves);
    for (name, own) in &edits.layers {
        list.extend(marks(&format!("{name}/"), &own.pins, &own.forbidden, &own.moves));
    }
    list.extend(edits.holds.iter().map(|hold| format!("hold {}:{}", hold.frame, hold.koma)));
    list.extend(edits.splits.iter().map(|split| format!("split {split}")));
    list.extend(edits.speech.iter().map(|line| format!("say {}..{}", line.from, line.past)));
    let cues = edits.camera.iter().map(|cue| cue.frames);
    list.extend(cues.map(|[from, past]| format!("camera {from}..{past}")));
    list.extend(edits.at.map(|at| format!("at {at}")));
    list.extend(edits.length.map(|length| format!("length {length}")));
    let slate = edits.slate.named().into_iter().filter(|(_, field)| !field.is_empty());
    list.extend(slate.map(|(name, field)| format!("{name} {field}")));
    let switches =
        [("only-pins", edits.only_pins), ("again", edits.again), ("freeze", edits.freeze())];
    list.extend(switches.into_iter().filter(|(_, is_on)| *is_on).map(|(name, _)| name.into()));
    list
}

fn marks(layer: &str, pins: &[Pin], forbidden: &[Forbidden], moves: &[Move]) -> Vec<String> {
    let pins = pins.iter().map(|pin| format!("pin {layer}{}", pin.frame));
    let forbidden = forbidden.iter().map(|frames| format!("forbid {layer}{frames}"));
    let moves = moves.iter().map(|moved| format!("move {layer}{}:{}", moved.from, moved.to));
    pins.chain(forbidden).chain(moves).collect()
}
