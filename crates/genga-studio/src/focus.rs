//! The focus (キーボードの届く所): frames the focused control, scrolls it into view, and moves the focus from part to part of
//! the window.

use egui::{
    Context, Event, EventFilter, Id, Key, LayerId, Order, Response, Stroke, StrokeKind, Ui, Vec2,
    vec2,
};

use super::theme::Look;

/// A part of the window, in the order in which the focus visits them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Notices,
    Bar,
    Goals,
    Takes,
    Knobs,
    Views,
    Strip,
    PlayHead,
    Curves,
    Sheet,
}

impl Part {
    const ALL: [Self; 10] = [
        Self::Notices,
        Self::Bar,
        Self::Goals,
        Self::Takes,
        Self::Knobs,
        Self::Views,
        Self::Strip,
        Self::PlayHead,
        Self::Curves,
        Self::Sheet,
    ];

    fn id(self) -> Id {
        Id::unique(("part", self as usize))
    }

    /// Registers the first control of this part.
    pub(super) fn begins(self, first: &Response) {
        first.ctx.data_mut(|data| data.insert_temp(self.id(), first.id));
    }

    /// The first control of this part. `None` while the part is hidden.
    fn first(self, context: &Context) -> Option<Id> {
        let first = context.data(|data| data.get_temp(self.id()))?;
        context.read_response(first).map(|_| first)
    }
}

/// Id under which egui stores the part focused last.
fn last_part() -> Id {
    Id::unique("last part")
}

/// Focuses the next part that is shown, or the previous one.
pub(super) fn go(context: &Context, by: isize) {
    let count = Part::ALL.len() as isize;
    let focused = context.memory(|memory| memory.focused());
    let last = focused.and_then(|_| context.data(|data| data.get_temp::<usize>(last_part())));
    let from = last.map_or(if by > 0 { -1 } else { count }, |last| last as isize);
    let others = (1..=count).map(|step| (from + by * step).rem_euclid(count) as usize);
    let there = |at: usize| Part::ALL[at].first(context).map(|first| (at, first));
    if let Some((at, first)) = others.filter_map(there).next() {
        context.data_mut(|data| data.insert_temp(last_part(), at));
        context.memory_mut(|memory| memory.request_focus(first));
    }
}

/// Recipient of the arrow keys while a control is focused that is no egui widget.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arrows {
    /// The control itself, with Shift too.
    Own,
    /// The play head, as if nothing were focused.
    PlayHead,
}

fn arrows_of(id: Id) -> Id {
    id.with("arrows")
}

/// Recipient of the arrow keys of a control. `None` if egui decides.
pub(super) fn arrows(context: &Context, id: Id) -> Option<Arrows> {
    context.data(|data| data.get_temp(arrows_of(id)))
}

/// Stops egui from moving the focus by arrow keys, and records their recipient.
fn keep(response: &Response, arrows: Arrows) {
    response.ctx.data_mut(|data| data.insert_temp(arrows_of(response.id), arrows));
    if response.has_focus() {
        let (horizontal_arrows, vertical_arrows) = (true, true);
        let filter = EventFilter { horizontal_arrows, vertical_arrows, ..EventFilter::default() };
        response.ctx.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    }
    if response.gained_focus() {
        response.ctx.request_repaint();
    }
}

/// Sends arrow keys to the play head while this control is focused.
pub(super) fn leave_arrows(response: &Response) {
    keep(response, Arrows::PlayHead);
}

/// Counts arrow presses, to the right and down, while this control is focused: without modifiers, and with Shift.
pub(super) fn take_arrows(response: &Response) -> (Vec2, Vec2) {
    keep(response, Arrows::Own);
    let (mut alone, mut with_shift) = (Vec2::ZERO, Vec2::ZERO);
    if response.has_focus() {
        response.ctx.input(|input| {
            for event in &input.events {
                let Event::Key { key, pressed: true, modifiers, .. } = event else { continue };
                let way = way_of(*key);
                if modifiers.is_none() {
                    alone += way;
                } else if modifiers.shift_only() {
                    with_shift += way;
                }
            }
        });
    }
    (alone, with_shift)
}

fn way_of(key: Key) -> Vec2 {
    match key {
        Key::ArrowLeft => vec2(-1.0, 0.0),
        Key::ArrowRight => vec2(1.0, 0.0),
        Key::ArrowUp => vec2(0.0, -1.0),
        Key::ArrowDown => vec2(0.0, 1.0),
        _ => Vec2::ZERO,
    }
}

/// Distance of the frame from its control, and its width, in points.
const OFF: f32 = 1.5;
const WIDE: f32 = 2.0;

/// Frames the focused control, above everything else.
pub(super) fn show(ui: &Ui, look: &Look) {
    let context = ui.ctx();
    let focused = context.memory(|memory| memory.focused());
    let Some(response) = focused.and_then(|id| context.read_response(id)) else { return };
    let layer = LayerId::new(Order::Tooltip, Id::unique("focus"));
    let rect = response.interact_rect.expand(OFF).intersect(context.content_rect());
    let stroke = Stroke::new(WIDE, look.playhead);
    context.layer_painter(layer).rect_stroke(rect, 3.0, stroke, StrokeKind::Inside);
}

/// Scrolls the newly focused control into view. Call it after the contents of the scroll area have been shown.
pub(super) fn bring_into_view(ui: &Ui) {
    let context = ui.ctx();
    let focused = context.memory(|memory| memory.focused());
    let Some(response) = focused.and_then(|id| context.read_response(id)) else { return };
    let is_here = response.layer_id == ui.layer_id() && ui.min_rect().contains_rect(response.rect);
    if response.gained_focus() && is_here && !ui.clip_rect().contains_rect(response.rect) {
        ui.scroll_to_rect(response.rect.expand(8.0), None);
    }
}
