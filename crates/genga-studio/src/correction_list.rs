//! The list of corrections (修正の一覧), each with a link to its place and a button to take it back.

use egui::style::ScrollStyle;
use egui::{CollapsingHeader, Panel, RichText, ScrollArea, Ui};

use super::command::Command;
use super::corrections::Correction;
use super::focus;
use super::icon::{self, Icon};
use super::view_state::Shown;
use super::words::Words;
use genga::edits::{LayerEdits, Pin};
use genga::keys::{Key, Origin};
use genga::sheet::Number;
use genga::time::Frame;

/// Height of the list in points; more is scrolled.
const HIGH: f32 = 132.0;

/// Shows the list at the lower edge, so that what is above stays in place.
pub(super) fn below(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    let edits = &shown.wanted.edits;
    if count_all(shown) == 0 && !edits.again {
        return;
    }
    Panel::bottom("corrections").exact_size(HIGH).show(ui, |ui| {
        // The bar is always drawn: it shows that the list goes on.
        ui.spacing_mut().scroll = ScrollStyle::solid();
        ScrollArea::vertical().id_salt("corrections").auto_shrink(false).show(ui, |ui| {
            show(ui, shown, commands);
            focus::bring_into_view(ui);
        });
    });
}

/// Number of corrections of keys and holds, and of passages.
fn count_all(shown: &Shown<'_>) -> usize {
    let edits = &shown.wanted.edits;
    let own = edits.layers.values().map(count).sum::<usize>();
    let keys = edits.pins.len() + edits.moves.len() + edits.forbidden.len();
    own + keys + edits.holds.len() + shown.wanted.recipe.scopes.passages.len()
}

/// Shows the list under its header.
fn show(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    let (edits, words) = (&shown.wanted.edits, shown.words);
    let all = LayerEdits {
        pins: edits.pins.clone(),
        forbidden: edits.forbidden.clone(),
        moves: edits.moves.clone(),
        frozen: vec![],
    };
    let own = edits.layers.iter().map(|(name, own)| (Some(name.as_str()), own));
    let lists: Vec<_> = [(None, &all)].into_iter().chain(own).collect();
    let title = format!("{} ({})", words.say("Corrections", "修正"), count_all(shown));
    let header = CollapsingHeader::new(RichText::new(title).strong()).id_salt("corrections");
    header.default_open(true).show_unindented(ui, |ui| {
        again(ui, shown, commands);
        for (column, own) in lists {
            keys_of(ui, column, own, shown, commands);
        }
        passages(ui, shown, commands);
        for hold in &edits.holds {
            let (held, place) = (words.say("held", "止め"), shown.named(hold.frame));
            let what = match words.is_japanese() {
                true => format!("{held} {place}: {}コマ", hold.koma),
                false => format!("{held} {place}: for {}", hold.koma),
            };
            let back = Correction::LetGo(hold.frame);
            Row { column: None, what, at: Some(hold.frame) }.show(ui, back, shown, commands);
        }
    });
}

/// Lists the passages, each with a button that dissolves it.
fn passages(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    for passage in &shown.wanted.recipe.scopes.passages {
        let what = format!("{} {}", shown.words.say("passage", "区間"), passage.frames);
        ui.horizontal(|ui| {
            let name = format!("{}: {what}", shown.words.say("Remove", "取り消す"));
            if icon::button(ui, Icon::Cross, &name).clicked() {
                commands.push(Command::Dissolve(passage.frames));
            }
            if ui.link(&what).clicked() {
                let koma = shown.column().clock.koma_from_frame(passage.frames.from);
                commands.push(Command::Go(koma));
            }
        });
    }
}

/// Number of corrected keys.
fn count(own: &LayerEdits) -> usize {
    own.pins.len() + own.moves.len() + own.forbidden.len()
}

/// Lists the corrected keys of one column, or of all columns.
fn keys_of(
    ui: &mut Ui,
    column: Option<&str>,
    own: &LayerEdits,
    shown: &Shown<'_>,
    commands: &mut Vec<Command>,
) {
    let words = shown.words;
    let mut row = |what, at, back| Row { column, what, at }.show(ui, back, shown, commands);
    for pin in &own.pins {
        let what = format!("{} {}", words.say("pinned", "固定"), shown.named(pin.frame));
        let back = Correction::TakeBack(key(pin.frame, Origin::Pinned));
        row(with_mark(what, pin, words), Some(pin.frame), back);
    }
    for moved in &own.moves {
        let (from, to) = (moved.from, moved.to);
        let (moves, arrow) = (words.say("moved", "移動"), words.arrow());
        let (from, to) = (shown.named(from), shown.named(to));
        let what = with_mark(format!("{moves} {from} {arrow} {to}"), &moved.pin(), words);
        let back = Correction::TakeBack(key(moved.to, Origin::Moved { from: moved.from }));
        row(what, Some(moved.to), back);
    }
    for range in &own.forbidden {
        let forbidden = words.say("forbidden", "禁止");
        let what = match range.is_one() {
            true => format!("{forbidden} {}", shown.named(range.from)),
            false => format!("{forbidden} {}", shown.named_ban(*range)),
        };
        let at = Some(range.from).filter(|frame| shown.breakdown.clip.contains(*frame));
        row(what, at, Correction::Allow(*range));
    }
}

/// A checkbox: whether all keys are chosen again around the corrections, or each changes only its own neighbourhood.
fn again(ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    if shown.wanted.edits.freeze() {
        return;
    }
    let mut again = shown.wanted.edits.again;
    let label = shown.words.say("Find all genga again", "原画を全部選び直す");
    let hint = shown.words.say(
        "On: all genga are chosen again around the corrections. Off: a correction only changes the genga next to it.",
        "オン: 修正に合わせて原画をすべて選び直す。オフ: 修正した前後の原画の間だけが変わる。",
    );
    if ui.checkbox(&mut again, label).on_hover_text(hint).changed() {
        commands.push(Command::Correct(Correction::Again(again)));
    }
}

/// Appends the name and the spacing weight that a person gave.
fn with_mark(what: String, pin: &Pin, words: Words) -> String {
    let name = pin.name.as_ref().map(|name| format!(" {name}")).unwrap_or_default();
    let spacing = words.say("spacing", "詰め");
    let weight = pin.weight.map(|weight| format!(", {spacing} {weight:.2}")).unwrap_or_default();
    what + &name + &weight
}

/// A correction in the list.
struct Row<'a> {
    /// The column it belongs to. `None` for all columns.
    column: Option<&'a str>,
    what: String,
    at: Option<Frame>,
}

impl Row<'_> {
    /// Shows a button that takes it back, and a link to its place.
    fn show(self, ui: &mut Ui, back: Correction, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let what = self.column.map(|name| format!("{name} ")).unwrap_or_default() + &self.what;
        let source = self.at.map_or_else(String::new, |frame| match shown.words.is_japanese() {
            true => format!("素材のフレーム {frame}"),
            false => format!("source frame {frame}"),
        });
        ui.horizontal(|ui| {
            let name = format!("{}: {what}", shown.words.say("Remove", "取り消す"));
            if icon::button(ui, Icon::Cross, &name).clicked() {
                commands.push(Command::CorrectOf(self.column.map(String::from), back));
            }
            let is_clicked = ui.link(&what).on_hover_text(source).clicked();
            if let Some(number) = self.at.and_then(|frame| self.genga_number(frame, shown)) {
                ui.weak(format!("{} {number}", shown.words.say("genga", "原画")));
            }
            if is_clicked && let Some(frame) = self.at {
                let column = shown.columns.iter().position(|own| Some(own.name) == self.column);
                commands.extend(column.and_then(|column| shown.choose(column)));
                commands.push(Command::Go(shown.column().koma_of(frame)));
            }
        });
    }

    /// The number of the genga at a frame, in the row's column or else in the selected one.
    fn genga_number(&self, frame: Frame, shown: &Shown<'_>) -> Option<Number> {
        let own = shown.columns.iter().find(|column| Some(column.name) == self.column);
        own.unwrap_or(shown.column()).cell_of(frame)?.genga_number()
    }
}

/// A key with only frame and origin, by which corrections identify keys.
fn key(frame: Frame, origin: Origin) -> Key {
    let (voters, weight, name) = (Vec::new(), None, None);
    Key { frame, strength: 1.0, price: f64::INFINITY, voters, weight, name, origin }
}
