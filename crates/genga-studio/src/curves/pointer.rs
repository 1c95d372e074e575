//! Pointer input over the curves (手): drags a genga by its number or an inbetween by its dot, else the play head.

use egui::{PointerButton, Pos2, Rect, Response};

use crate::command::Command;
use crate::corrections::Correction;
use crate::held_key::HeldKey;
use crate::time_axis::Scale;
use crate::view_state::Shown;
use genga::keys::Key;
use genga::time::Frame;

/// Distance within which a number is grabbed, in points.
const NEAR: f32 = 10.0;
/// Distance within which the smaller dot of an inbetween is grabbed, in points.
const NEAR_DOT: f32 = 6.0;
/// Pulled weights are rounded to hundredths, as a person would write them.
const HUNDREDTHS: f64 = 100.0;

/// The object being dragged.
#[derive(Debug, Clone)]
enum Held {
    /// A key.
    Key(HeldKey),
    /// An inbetween: its koma on the sheet before anything was left out, the key on its side, and the weight last asked
    /// for.
    Inbetween { koma: usize, key: Key, weight: f64 },
}

/// Pointer state over the curves.
#[derive(Debug, Clone, Default)]
pub(super) struct Hand {
    held: Option<Held>,
    /// The key whose menu is open.
    pub(super) asked: Option<Key>,
}

impl Hand {
    /// Handles pointer input. The numbers stand in `top`.
    pub(super) fn handle(
        &mut self,
        response: &Response,
        top: Rect,
        time: &Scale,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        let Some(at) = response.interact_pointer_pos() else {
            self.held = None;
            return;
        };
        let ruler = Ruler { top, time, shown };
        if response.drag_started_by(PointerButton::Primary) {
            let origin = response.ctx.input(|input| input.pointer.press_origin());
            self.held = ruler.grasped(origin.unwrap_or(at));
        }
        if response.secondary_clicked() {
            self.asked = ruler.key(at).cloned();
        }
        let is_primary = response.clicked() || response.dragged_by(PointerButton::Primary);
        if let Some(held) = self.held.as_mut().filter(|_| response.dragged()) {
            held.follow(time.place(at.x), shown, commands);
        } else if is_primary || response.secondary_clicked() {
            let frame = ruler.key(at).map_or(shown.frame(time.place(at.x)), |key| key.frame);
            commands.extend(go(frame, shown));
        }
        if response.drag_stopped() {
            self.held = None;
        }
    }
}

impl Held {
    /// Adds the commands that bring it under the pointer.
    fn follow(&mut self, place: f64, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        match self {
            Self::Key(key) => {
                let frame = shown.frame(place);
                commands.extend(go(frame, shown));
                commands.extend(key.carry(frame).map(Command::Drag));
            }
            Self::Inbetween { koma, key, weight } => {
                let pulled = pulled(*koma, place, shown);
                let wanted = pulled.filter(|(of, _)| of.frame == key.frame);
                if let Some((_, wanted)) = wanted.filter(|(_, wanted)| wanted != weight) {
                    *weight = wanted;
                    let correction = Correction::Weight(key.clone(), Some(wanted));
                    commands.push(Command::Drag(correction));
                }
            }
        }
    }
}

/// The numbers and dots over the curves.
struct Ruler<'a> {
    top: Rect,
    time: &'a Scale,
    shown: &'a Shown<'a>,
}

impl<'a> Ruler<'a> {
    fn away(&self, place: f64, at: Pos2) -> f32 {
        (self.time.x(place) - at.x).abs()
    }

    /// The key whose number is at a position.
    fn key(&self, at: Pos2) -> Option<&'a Key> {
        let away = |key: &Key| self.away(key.frame.0 as f64, at);
        let near = |key: &&Key| away(key) < NEAR && at.y < self.top.max.y;
        let keys = self.shown.column().keys().iter();
        keys.filter(near).min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// The place of the inbetween whose dot is at a position.
    fn inbetween(&self, at: Pos2) -> Option<f64> {
        let cells = self.shown.column().cells.iter().filter(|cell| cell.genga.is_none());
        let places = cells.map(|cell| cell.drawing.source.place());
        let near = |place: &f64| self.away(*place, at) < NEAR_DOT && at.y < self.top.max.y;
        places.filter(near).min_by(|a, b| self.away(*a, at).total_cmp(&self.away(*b, at)))
    }

    /// The object grabbed at a position: the nearer of number and dot.
    fn grasped(&self, at: Pos2) -> Option<Held> {
        let key = self.key(at);
        let dot = self.inbetween(at).filter(|place| {
            key.is_none_or(|key| self.away(*place, at) < self.away(key.frame.0 as f64, at))
        });
        match dot.and_then(|place| self.shown.column().spaced_koma(place).zip(Some(place))) {
            Some((koma, place)) => {
                let (key, weight) = pulled(koma, place, self.shown)?;
                Some(Held::Inbetween { koma, key: key.clone(), weight })
            }
            None => key.map(|key| Held::Key(HeldKey::take(key))),
        }
    }
}

/// The key on the side of an inbetween, and the weight that moves the inbetween to a place.
fn pulled<'a>(koma: usize, place: f64, shown: &Shown<'a>) -> Option<(&'a Key, f64)> {
    let column = shown.column();
    let spacing = column.spacing(&shown.wanted.recipe, shown.breakdown.source.last());
    let pull = spacing.pulled(column.found.keys, column.spaced, column.clock, koma, place)?;
    let keys = column.keys();
    let at = keys.binary_search_by_key(&pull.key, |key| key.frame).ok()?;
    Some((&keys[at], (pull.weight * HUNDREDTHS).round() / HUNDREDTHS))
}

/// Moves the play head to the koma of a frame.
fn go(frame: Frame, shown: &Shown<'_>) -> Option<Command> {
    shown.go(shown.column().clock.koma_from_frame(frame))
}
