//! Describes the effect of each correction (修正の結果), one line each. [`super::corrections`] notes corrections without
//! effect.

use genga::edits::{Edits, Forbidden, Move, Pin};
use genga::keys::{Key, Origin};
use genga::pipeline::{Breakdown, LayerBreakdown};
use genga::sheet::{Drawing, Layer, Number};
use genga::time::{Clock, Frame};
use genga::timing::held_for;

/// Furthest that a key gives way to one that a person sets, in koma.
const NEAR: f64 = 3.0;

/// Most lines; of more, the rest is counted.
const MOST: usize = 24;

/// Returns a line for each pin, ban, move and hold with an effect, in the order of frames.
pub(super) fn of_corrections(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    let layers: Vec<_> = breakdown.layers().collect();
    let mut lines: Vec<(Frame, String)> = Vec::new();
    for (own, sheet) in layers.iter().zip(&breakdown.sheet.layers) {
        let of_layer = edits.of_layer(&own.layer.name);
        let outcomes = Outcomes {
            own,
            edits: &of_layer,
            sheet,
            clock: breakdown.clock,
            before: breakdown.sheet.blank.before,
            layer: if layers.len() > 1 { format!("{}/", own.layer.name) } else { String::new() },
        };
        lines.extend(of_layer.pins.iter().filter_map(|pin| outcomes.of_pin(pin)));
        lines.extend(of_layer.forbidden.iter().filter_map(|ban| outcomes.of_ban(*ban)));
        lines.extend(of_layer.moves.iter().filter_map(|moved| outcomes.of_move(moved)));
        let holds = edits.holds.iter().filter_map(|hold| {
            let koma = held_for(sheet, *hold, breakdown.clock)?;
            Some((hold.frame, outcomes.line("hold", hold.frame, &format!("stays for {koma} koma"))))
        });
        lines.extend(holds);
    }
    lines.sort_by_key(|(frame, _)| *frame);
    let more = lines.len().saturating_sub(MOST);
    let mut lines: Vec<String> = lines.into_iter().take(MOST).map(|(_, line)| line).collect();
    lines.extend((more > 0).then(|| format!("… {more} more")));
    lines
}

fn frames(keys: &[Key]) -> impl Iterator<Item = Frame> {
    keys.iter().map(|key| key.frame)
}

/// Whether a frame is between two others, whichever comes first.
fn lies_between(frame: Frame, from: Frame, to: Frame) -> bool {
    from.min(to) < frame && frame < from.max(to)
}

/// Lists frames.
fn listed(frames: &[Frame]) -> String {
    frames.iter().map(Frame::to_string).collect::<Vec<_>>().join(" and ")
}

/// The keys of a layer before and after the corrections.
struct Outcomes<'a> {
    own: &'a LayerBreakdown<'a>,
    /// The corrections that apply to it.
    edits: &'a Edits,
    /// Its column of the sheet.
    sheet: &'a Layer,
    clock: Clock,
    /// Blank koma before the drawings.
    before: usize,
    /// Prefix of frames, if there are several layers.
    layer: String,
}

impl Outcomes<'_> {
    fn line(&self, what: &str, frame: impl std::fmt::Display, outcome: &str) -> String {
        format!("{what} {}{frame}: {outcome}", self.layer)
    }

    fn of_pin(&self, pin: &Pin) -> Option<(Frame, String)> {
        let frame = pin.frame;
        let (drawing, number) = self.genga(frame)?;
        let mut timed = self.sheet.timed();
        let koma = timed.find(|(_, shown)| shown.drawing == drawing).map(|(koma, _)| koma);
        let instead = match (listed(&self.lost_to(frame)), koma) {
            (_, Some(koma)) if self.is_found(frame) => {
                format!(", a genga already, on koma {}", self.before + koma + 1)
            }
            (none, _) if none.is_empty() => none,
            (frames, _) => format!(" in place of {frames}"),
        };
        Some((frame, self.line("pin", frame, &format!("genga {number}{instead}"))))
    }

    fn of_ban(&self, ban: Forbidden) -> Option<(Frame, String)> {
        let koma = self.clock.frames_in_koma();
        let taken = self.own.keys.taken_by(ban, koma).filter(|at| !self.is_moved(*at));
        let is_kept = |key: &&Key| {
            key.origin.is_set() && ban.reaches(key.frame, koma) && self.is_found(key.frame)
        };
        let kept = self.own.keys.keys.iter().filter(is_kept).map(|key| key.frame);
        let mut reached: Vec<Frame> = taken.chain(kept).collect();
        reached.sort_unstable();
        let outcomes: Vec<String> = reached.iter().map(|at| self.of_banned(*at)).collect();
        let line = self.line("forbid", ban, &outcomes.join(", "));
        (!outcomes.is_empty()).then_some((ban.from, line))
    }

    /// Says what became of the key at a frame that is forbidden.
    fn of_banned(&self, frame: Frame) -> String {
        if self.has(frame) {
            let number = self.number(frame).as_ref().map(Number::to_string).unwrap_or_default();
            return format!("genga {number} stays at {frame}, as it is pinned");
        }
        match self.instead_of(frame).and_then(|to| Some((to, self.number(to)?))) {
            Some((to, number)) => {
                let others = self.own.keys.without_corrections.iter().map(|key| key.frame);
                let length = self.sheet.length();
                let none = Forbidden::instead_of(frame, others, &self.clock, length);
                format!("genga {number} moved from {frame} to {to} (--forbid {none} leaves none)")
            }
            None => format!("the genga at {frame} is gone"),
        }
    }

    fn of_move(&self, moved: &Move) -> Option<(Frame, String)> {
        let Move { from, to, .. } = *moved;
        let is_moved = |key: &&Key| key.origin == Origin::Moved { from };
        self.own.keys.keys.iter().find(is_moved)?;
        let number = self.number(to)?;
        let mut gone = self.lost_to(to);
        gone.extend((self.is_found(to) && from != to).then_some(to));
        let passed: Vec<Frame> =
            frames(&self.own.keys.keys).filter(|at| lies_between(*at, from, to)).collect();
        let mut outcome = format!("genga {number}");
        for (what, frames) in [(" in place of", gone), (", past the genga at", passed)] {
            if !frames.is_empty() {
                outcome += &format!("{what} {}", listed(&frames));
            }
        }
        Some((from, self.line("move", format!("{from}:{to}"), &outcome)))
    }

    /// The number on the sheet of the genga that shows a frame.
    fn number(&self, frame: Frame) -> Option<Number> {
        self.genga(frame).map(|(_, number)| number)
    }

    /// The genga that shows a frame: the index of its drawing, and its number.
    fn genga(&self, frame: Frame) -> Option<(usize, Number)> {
        let away = |drawing: &Drawing| (drawing.source.place() - frame.0 as f64).abs();
        let numbered = self.sheet.drawings.iter().zip(self.sheet.genga_numbers()).enumerate();
        let kept =
            numbered.filter_map(|(at, (drawing, number))| Some((away(drawing), (at, number?))));
        let (away, genga) = kept.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (away < self.clock.frames_in_koma()).then_some(genga)
    }

    /// Whether a key is at a frame now.
    fn has(&self, frame: Frame) -> bool {
        self.own.keys.keys.iter().any(|key| key.frame == frame)
    }

    /// Whether a key was at a frame before the corrections.
    fn is_found(&self, frame: Frame) -> bool {
        self.own.keys.without_corrections.iter().any(|key| key.frame == frame)
    }

    /// The keys next to a frame, of those that are there with and without corrections.
    fn between(&self, frame: Frame) -> (Option<Frame>, Option<Frame>) {
        let frames = self.own.keys.keys.iter().map(|key| key.frame);
        let both: Vec<Frame> = frames.filter(|at| *at != frame && self.is_found(*at)).collect();
        let after = both.partition_point(|at| *at < frame);
        (after.checked_sub(1).map(|at| both[at]), both.get(after).copied())
    }

    /// Keys that are gone since the corrections.
    fn lost(&self) -> impl Iterator<Item = Frame> {
        self.own.keys.without_corrections.iter().map(|key| key.frame).filter(|at| !self.has(*at))
    }

    /// Whether a key was moved away from a frame.
    fn is_moved(&self, frame: Frame) -> bool {
        let koma = self.clock.frames_in_koma();
        let from = |key: &Key| match key.origin {
            Origin::Moved { from } => Some(from),
            _ => None,
        };
        let mut begins = self.own.keys.keys.iter().filter_map(from);
        begins.any(|from| (from.0.abs_diff(frame.0) as f64) < koma)
    }

    /// Whether a rest ends at a frame: the drawing with which it begins is held there, so no genga of its own stood on
    /// the sheet.
    fn ends_rest(&self, frame: Frame) -> bool {
        let rests = &self.own.keys.rests;
        rests.iter().any(|rest| *rest.end() == frame)
            && rests.iter().all(|rest| *rest.start() != frame)
    }

    /// Frames of the keys that gave way to the one that a person set at a frame, and not to another correction.
    fn lost_to(&self, set: Frame) -> Vec<Frame> {
        if self.edits.only_pins {
            return vec![];
        }
        let koma = self.clock.frames_in_koma();
        let away = |at: Frame, from: Frame| at.0.abs_diff(from.0);
        let is_forbidden = |at: Frame| self.edits.forbidden.iter().any(|ban| ban.reaches(at, koma));
        let moved = self.edits.moves.iter().map(|moved| moved.to);
        let sets: Vec<Frame> = self.edits.pins.iter().map(|pin| pin.frame).chain(moved).collect();
        let is_its = |at: &Frame| {
            away(*at, set) as f64 <= NEAR * koma
                && sets.iter().all(|other| away(*at, set) <= away(*at, *other))
        };
        let lost = self.lost().filter(|at| is_its(at) && !is_forbidden(*at));
        lost.filter(|at| !self.is_moved(*at) && !self.ends_rest(*at)).collect()
    }

    /// The nearest new key between the neighbours of one that is gone, if nobody set it and none that is gone was
    /// nearer.
    fn instead_of(&self, frame: Frame) -> Option<Frame> {
        let (before, after) = self.between(frame);
        let is_near = |at: Frame| before.is_none_or(|b| b < at) && after.is_none_or(|a| at < a);
        let of_lost = |at: Frame| self.lost().min_by_key(|lost| at.0.abs_diff(lost.0));
        let new = self.own.keys.keys.iter().filter(|key| !key.origin.is_set());
        new.map(|key| key.frame)
            .filter(|at| is_near(*at) && !self.is_found(*at) && of_lost(*at) == Some(frame))
            .min_by_key(|at| at.0.abs_diff(frame.0))
    }
}
