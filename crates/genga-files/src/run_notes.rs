//! Notes of a report: what a person should know about the clip, and about corrections without effect.

use std::cmp::Reverse;

use genga::edits::{Edits, Forbidden, Hold, Move};
use genga::keys::{Cycle, Key, Origin};
use genga::motion::Clip;
use genga::pipeline::{Breakdown, LayerBreakdown};
use genga::sheet::{Drawing, Exposure, Layer, Role};
use genga::time::Frame;
use genga::timing::{held_for, is_of_last};

/// Says that a clip can be repeated, or that the seam of a loop shows.
pub fn of_cycle(clip: &Clip, is_loop: bool) -> Option<String> {
    if !is_loop {
        return Cycle::note(clip).map(|note| note.to_string());
    }
    let Cycle { pose, speed, .. } = Cycle::of_clip(clip).filter(|cycle| !cycle.is_closed())?;
    Some(format!(
        "the seam of the loop may show: the last pose is {pose:.1} % of body height and {speed:.0} % a second off the first"
    ))
}

/// Seconds from which a held inbetween is told: so long a hold is seen as a pose.
const LONG: f64 = 0.5;

/// Says which inbetween stays longest, if it stays so long that a person would draw its pose as a genga.
pub fn of_held_inbetween(breakdown: &Breakdown<'_>) -> Option<String> {
    let sheet = breakdown.sheet;
    let held = sheet.layers.iter().flat_map(|layer| {
        let inbetween = |(_, shown): &(usize, Exposure)| {
            let drawing = &layer.drawings[shown.drawing];
            // Who held it by hand knows.
            drawing.role == Role::Inbetween && !drawing.why.hold_set
        };
        layer.timed().filter(inbetween).map(move |(koma, shown)| (layer, koma, shown))
    });
    let (layer, koma, shown) = held.max_by_key(|(_, koma, shown)| (shown.koma, Reverse(*koma)))?;
    if (shown.koma as f64) < LONG * sheet.clock.koma_rate {
        return None;
    }
    let of = if sheet.layers.len() > 1 { format!("{}/", layer.name) } else { String::new() };
    let (number, frame) =
        (&layer.numbers()[shown.drawing], layer.drawings[shown.drawing].source.place().round());
    let (koma, stays) = (sheet.blank.before + koma + 1, shown.koma);
    Some(format!(
        "an inbetween, drawing {of}{number}, is held for {stays} koma from koma {koma}; a pin at {of}{frame} makes its pose a \
         genga"
    ))
}

/// Returns a sentence for each correction that had no effect, or not the one that was asked for.
pub fn of_corrections(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    [unmoved(edits, breakdown), unheld(edits, breakdown), idle(edits, breakdown)].concat()
}

/// Returns a sentence for each move that found no key to move in any of its layers.
pub fn unmoved(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    let layers: Vec<_> = breakdown.layers().collect();
    let of_all = edits.moves.iter().map(|moved| (moved, None));
    let of_one = edits
        .layers
        .iter()
        .flat_map(|(name, own)| own.moves.iter().map(move |moved| (moved, Some(name.as_str()))));
    let said = of_all.chain(of_one).filter_map(|(moved, name)| {
        let meant = layers.iter().filter(|own| name.is_none_or(|name| own.layer.name == name));
        let keys: Vec<&[Key]> = meant.map(|own| own.keys.keys.as_slice()).collect();
        let is_moved = |key: &Key| key.origin == Origin::Moved { from: moved.from };
        let is_idle = !keys.iter().any(|keys| keys.iter().any(is_moved));
        is_idle.then(|| unmoved_one(moved, name, keys.first().copied().unwrap_or_default()))
    });
    said.collect()
}

/// Builds the note for a move without a key at its source; it names the nearest keys.
fn unmoved_one(moved: &Move, layer: Option<&str>, keys: &[Key]) -> String {
    let (from, to) = (moved.from, moved.to);
    let after = keys.partition_point(|key| key.frame < from);
    let round = &keys[after.saturating_sub(1)..keys.len().min(after + 1)];
    let round: Vec<String> = round.iter().map(|key| key.frame.to_string()).collect();
    let nearest = match round.as_slice() {
        [] => String::new(),
        [only] => format!(" (the nearest is at {only})"),
        both => format!(" (the nearest are at {})", both.join(" and ")),
    };
    let layer = layer.map_or_else(String::new, |name| format!("{name}/"));
    format!(
        "no key is found at frame {layer}{from}{nearest}, so none was moved to {to}; a pin at {layer}{to} makes one there"
    )
}

/// Returns a sentence for each hold that a layer could not keep exactly, and for each that found no drawing.
fn unheld(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    let layers = &breakdown.sheet.layers;
    let mut said = Vec::new();
    for hold in &edits.holds {
        let (frame, asked) = (hold.frame, hold.koma);
        let stays = |layer| held_for(layer, *hold, breakdown.clock);
        let found: Vec<_> = layers.iter().filter_map(|own| Some((own, stays(own)?))).collect();
        if found.is_empty() {
            said.push(unfound(*hold, layers));
        }
        for (layer, koma) in found.into_iter().filter(|(_, koma)| *koma != asked) {
            let of = if layers.len() > 1 { format!("{}/", layer.name) } else { String::new() };
            let ends =
                breakdown.sheet.repeat.is_none() && is_of_last(layer, *hold, breakdown.clock);
            let why = why_not(koma > asked, ends, next_genga(layer, frame));
            said.push(format!(
                "the drawing of frame {of}{frame} was to stay for {asked} koma and stays for {koma}: {why}"
            ));
        }
    }
    said
}

/// Says why a held drawing stays longer or shorter than asked, and what to do.
fn why_not(is_longer: bool, ends: bool, next: Option<Frame>) -> String {
    let next = next.map_or_else(String::new, |frame| format!(", of frame {frame},"));
    if is_longer {
        "none is left to follow it, or one would be on screen too briefly; pin what should follow it sooner".into()
    } else if ends {
        "it is the last drawing, and the cut ends there; a greater length makes the cut longer"
            .into()
    } else {
        format!(
            "the next genga{next} stands there or would be on screen too briefly; move or forbid it to hold longer"
        )
    }
}

/// The frame of the first genga behind a frame, in the order of the sheet.
fn next_genga(layer: &Layer, frame: Frame) -> Option<Frame> {
    let frames = layer.shown().filter(|drawing| drawing.role == Role::Genga);
    let frames = frames.map(|drawing| Frame(drawing.source.place().round() as usize));
    frames.into_iter().find(|own| *own > frame)
}

/// Builds the note for a hold without a drawing near its frame; it names the one that is on screen there.
fn unfound(hold: Hold, layers: &[Layer]) -> String {
    let Hold { frame, koma } = hold;
    let place = |drawing: &Drawing| drawing.source.place();
    let drawings = layers.iter().flat_map(|layer| &layer.drawings).map(place);
    let before = drawings.filter(|place| *place <= frame.0 as f64).max_by(f64::total_cmp);
    let shown = before.map_or_else(String::new, |place| {
        let place = place.round();
        format!("that of frame {place} is on screen: a hold at {place} holds it; ")
    });
    format!(
        "no drawing is within two koma of frame {frame}, so none stays for {koma} koma; {shown}a pin at {frame} makes one \
         there"
    )
}

/// Returns a sentence for each forbidden frame or range that changes nothing in any of its layers: no key was found
/// near it, and none was looked for elsewhere because of it.
pub fn idle(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    let koma = breakdown.clock.frames_in_koma();
    let of_all = edits.forbidden.iter().map(|frames| (frames, None));
    let of_one = edits.layers.iter().flat_map(|(name, own)| {
        own.forbidden.iter().map(move |frames| (frames, Some(name.as_str())))
    });
    let layers: Vec<_> = breakdown.layers().collect();
    let said = of_all.chain(of_one).filter(|(frames, layer)| {
        let mut meant = layers.iter().filter(|own| layer.is_none_or(|name| own.layer.name == name));
        !meant.any(|own| has_an_effect(**frames, own, koma))
    });
    said.map(|(frames, layer)| {
        let layer = layer.map_or_else(String::new, |name| format!("{name}/"));
        format!("no key is found near frame {layer}{frames}, so there was none to forbid")
    })
    .collect()
}

/// Whether the forbidden frames removed a key, or may have moved the search for one.
fn has_an_effect(frames: Forbidden, own: &LayerBreakdown<'_>, koma: f64) -> bool {
    let found = &own.keys.without_corrections;
    if found.iter().any(|key| frames.reaches(key.frame, koma)) {
        return true;
    }
    let keys = &own.keys.keys;
    let after = keys.partition_point(|key| key.frame < frames.from);
    let begin = after.checked_sub(1).map(|at| keys[at].frame);
    let end = keys.get(after).map(|key| key.frame);
    let is_inside =
        |key: &&Key| begin.is_none_or(|at| at < key.frame) && end.is_none_or(|at| key.frame < at);
    found.iter().any(|key| is_inside(&key))
}
