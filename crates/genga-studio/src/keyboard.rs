//! The keyboard (キー): the table of keys and their commands. The list that `?` shows is made from it.

use egui::{Event, Key, KeyboardShortcut, Modifiers, Popup, TextEdit, Ui};

use super::command::{Command, Seen, Standard};
use super::focus::{self, Arrows};
use super::panels::Side;
use super::words::Words;

/// A key and its command.
pub(super) struct Binding {
    pub(super) modifiers: Modifiers,
    pub(super) key: Key,
    pub(super) command: Command,
    english: &'static str,
    japanese: &'static str,
}

impl Binding {
    /// Description of the command.
    pub(super) fn what(&self, words: Words) -> &'static str {
        words.say(self.english, self.japanese)
    }

    /// Name of the keys as on the keyboard. Arrows are spelled out, since fonts may lack their symbols.
    pub(super) fn keys(&self, ui: &Ui) -> String {
        let written = ui.ctx().format_shortcut(&KeyboardShortcut::new(self.modifiers, self.key));
        let sign = Some(self.key.symbol_or_name()).filter(|sign| sign.is_ascii());
        sign.map_or(written.clone(), |sign| written.replace(self.key.name(), sign))
    }
}

const fn key(
    modifiers: Modifiers,
    key: Key,
    command: Command,
    english: &'static str,
    japanese: &'static str,
) -> Binding {
    Binding { modifiers, key, command, english, japanese }
}

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const ALT: Modifiers = Modifiers::ALT;
const COMMAND: Modifiers = Modifiers::COMMAND;
const ALT_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::ALT };
const COMMAND_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// All bindings. Those with more modifiers come first, since a key alone also matches if Shift or Alt is held.
pub(super) const BINDINGS: &[Binding] = &[
    key(COMMAND_SHIFT, Key::Z, Command::Redo, "redo", "やり直す"),
    key(COMMAND, Key::Y, Command::Redo, "redo", "やり直す"),
    key(COMMAND, Key::Z, Command::Undo, "undo", "元に戻す"),
    key(COMMAND, Key::S, Command::Save, "save the recipe", "レシピを保存"),
    key(COMMAND_SHIFT, Key::O, Command::Choose, "choose a file", "ファイルを選ぶ"),
    key(COMMAND, Key::O, Command::OpenFile, "open a clip or a recipe", "クリップかレシピを開く"),
    key(COMMAND, Key::ArrowDown, Command::Take(1), "next take of the folder", "次のテイク"),
    key(COMMAND, Key::ArrowUp, Command::Take(-1), "previous take", "前のテイク"),
    key(COMMAND, Key::D, Command::Mark(true), "this take is done", "このテイクは済"),
    key(COMMAND, Key::F, Command::Mark(false), "flag this take", "このテイクは要確認"),
    key(COMMAND, Key::E, Command::AskExport, "export", "書き出す"),
    key(
        ALT_SHIFT,
        Key::ArrowLeft,
        Command::NudgeFrame(-1),
        "move genga one frame earlier",
        "原画を1フレーム前へ",
    ),
    key(
        ALT_SHIFT,
        Key::ArrowRight,
        Command::NudgeFrame(1),
        "move genga one frame later",
        "原画を1フレーム後へ",
    ),
    key(ALT, Key::ArrowLeft, Command::Nudge(-1), "move genga one koma earlier", "原画を1コマ前へ"),
    key(ALT, Key::ArrowRight, Command::Nudge(1), "move genga one koma later", "原画を1コマ後へ"),
    key(SHIFT, Key::ArrowLeft, Command::Drawing(-1), "previous drawing", "前の動画"),
    key(SHIFT, Key::ArrowRight, Command::Drawing(1), "next drawing", "次の動画"),
    key(NONE, Key::ArrowLeft, Command::Koma(-1), "previous koma", "前のコマ"),
    key(NONE, Key::ArrowRight, Command::Koma(1), "next koma", "次のコマ"),
    key(NONE, Key::ArrowUp, Command::Genga(-1), "previous genga", "前の原画"),
    key(NONE, Key::ArrowDown, Command::Genga(1), "next genga", "次の原画"),
    key(NONE, Key::Home, Command::First, "first koma", "最初のコマ"),
    key(NONE, Key::End, Command::Last, "last koma", "最後のコマ"),
    key(NONE, Key::Space, Command::Play, "play or stop", "再生・停止"),
    key(NONE, Key::I, Command::LoopFrom, "play from here", "ここから再生"),
    key(NONE, Key::O, Command::LoopTo, "play to here", "ここまで再生"),
    key(NONE, Key::P, Command::LoopAll, "play all", "全部を再生"),
    key(NONE, Key::Q, Command::Passage, "the played range is a passage", "再生範囲を区間に・解除"),
    key(NONE, Key::F, Command::Flip, "flip source and result", "素材と結果を切り替え"),
    key(NONE, Key::B, Command::See(Seen::Both), "both, side by side", "並べて表示"),
    key(NONE, Key::Num1, Command::Look(Standard::Front), "from the front", "正面から"),
    key(NONE, Key::Num2, Command::Look(Standard::Side), "from the side", "側面から"),
    key(NONE, Key::Num3, Command::Look(Standard::Top), "from above", "真上から"),
    key(NONE, Key::Num4, Command::Look(Standard::ThreeQuarter), "three-quarter", "斜めから"),
    key(NONE, Key::Num0, Command::Fit, "show the whole motion", "全体を表示"),
    key(NONE, Key::Plus, Command::Zoom(1.2), "zoom in", "拡大"),
    key(NONE, Key::Minus, Command::Zoom(1.0 / 1.2), "zoom out", "縮小"),
    key(NONE, Key::C, Command::Follow, "camera follows the body", "カメラが体を追う"),
    key(NONE, Key::G, Command::Onion, "onion skin", "オニオンスキン"),
    key(NONE, Key::T, Command::Trails, "trails of the chosen joints", "選んだ関節の軌跡"),
    key(
        NONE,
        Key::E,
        Command::Exaggerated,
        "source as captured or exaggerated",
        "素材の誇張前・誇張後",
    ),
    key(
        NONE,
        Key::H,
        Command::Map,
        "map: turns by width and persistence",
        "地図: 適用範囲と連続フレーム数",
    ),
    key(NONE, Key::M, Command::Movement, "movement into each koma", "動きの大きさ"),
    key(NONE, Key::W, Command::Freeze, "freeze or unfreeze all genga", "原画をすべて凍結・解除"),
    key(
        NONE,
        Key::Y,
        Command::FindAgain,
        "find genga again in the played range",
        "再生範囲の原画を選び直す",
    ),
    key(NONE, Key::V, Command::Compare, "before the change, or after it", "変更の前・後"),
    key(NONE, Key::Z, Command::StripZoom, "strip: this action, or the whole", "列: この動作・全体"),
    key(NONE, Key::X, Command::Other, "switch sheets (A, B)", "シートを切り替え (A/B)"),
    key(NONE, Key::U, Command::Frames, "show frames or koma", "フレーム・コマの切り替え"),
    key(NONE, Key::K, Command::ToggleKey, "pin or forbid a genga here", "ここの原画を固定・禁止"),
    key(NONE, Key::L, Command::Pin, "pin or unpin this koma", "このコマを固定・解除"),
    key(NONE, Key::OpenBracket, Command::Hold(-1), "shorten hold by a koma", "止めを1コマ短く"),
    key(NONE, Key::CloseBracket, Command::Hold(1), "lengthen hold by a koma", "止めを1コマ長く"),
    key(NONE, Key::Comma, Command::Crowd(-0.05), "spread inbetweens from the genga", "詰めを弱く"),
    key(NONE, Key::Period, Command::Crowd(0.05), "crowd inbetweens to the genga", "詰めを強く"),
    key(SHIFT, Key::R, Command::SheetZoom(1.0 / 1.25), "shrink the sheet", "シートを縮小"),
    key(NONE, Key::R, Command::SheetZoom(1.25), "enlarge the sheet", "シートを拡大"),
    key(NONE, Key::A, Command::NextColumn, "next column of the sheet", "次のセル"),
    key(NONE, Key::N, Command::FocusName, "name the genga here", "原画に名前"),
    key(NONE, Key::D, Command::Theme, "light or dark", "ライト・ダーク"),
    key(NONE, Key::J, Command::Language, "Japanese labels", "英語表示"),
    key(
        NONE,
        Key::Num7,
        Command::Panel(Side::Knobs),
        "show or hide expert settings",
        "詳細設定の表示",
    ),
    key(NONE, Key::Num8, Command::Panel(Side::Curves), "show or hide curves", "グラフの表示"),
    key(NONE, Key::Num9, Command::Panel(Side::Sheet), "show or hide the sheet", "シートの表示"),
    key(SHIFT, Key::F6, Command::Part(-1), "previous part of the window", "画面の前の部分へ"),
    key(NONE, Key::F6, Command::Part(1), "next part of the window", "画面の次の部分へ"),
    key(NONE, Key::Questionmark, Command::Help, "this list", "この一覧"),
    key(NONE, Key::F1, Command::Help, "this list", "この一覧"),
    key(NONE, Key::Escape, Command::Dismiss, "close the open panel", "閉じる"),
];

/// Keys that a focused widget uses itself.
const ARROWS: [Key; 4] = [Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown];
const PRESSES: [Key; 2] = [Key::Space, Key::Enter];

/// Returns the commands of the keys pressed, one per press and in order, since a slow frame may have several. Typing
/// into a field is left to the field.
pub(super) fn pressed(ui: &Ui) -> Vec<Command> {
    let focused = ui.memory(|memory| memory.focused());
    let is_typing = focused.is_some_and(|id| TextEdit::load_state(ui.ctx(), id).is_some());
    // An open menu or list closes itself on Escape.
    let is_menu_open = Popup::is_any_open(ui.ctx());
    let arrows = focused.and_then(|id| focus::arrows(ui.ctx(), id));
    let is_of_widget = |Binding { modifiers, key, .. }: &Binding| {
        let (is_alone, is_arrow) = (modifiers.is_none(), ARROWS.contains(key));
        match arrows {
            Some(Arrows::PlayHead) => false,
            Some(Arrows::Own) => is_arrow && (is_alone || modifiers.shift_only()),
            None => is_alone && (is_arrow || PRESSES.contains(key)),
        }
    };
    let is_free = |binding: &Binding| {
        if is_menu_open && binding.key == Key::Escape {
            return false;
        }
        match focused {
            None => true,
            Some(_) if is_typing => {
                let is_for_all = matches!(binding.key, Key::Escape | Key::F1 | Key::F6);
                binding.modifiers.command || is_for_all
            }
            Some(_) => !is_of_widget(binding),
        }
    };
    let mut commands = Vec::new();
    ui.input_mut(|input| {
        input.events.retain(|event| {
            let command = command_of(event, is_typing, is_free);
            let is_kept = command.is_none();
            commands.extend(command);
            is_kept
        });
    });
    commands
}

/// The command of a key press. Copying and pasting in a field are left to the field.
fn command_of(
    event: &Event,
    is_typing: bool,
    is_free: impl Fn(&Binding) -> bool,
) -> Option<Command> {
    match event {
        Event::Copy if !is_typing => return Some(Command::CopyKeys),
        Event::Paste(text) if !is_typing => return Some(Command::PasteKeys(text.clone())),
        _ => {}
    }
    let Event::Key { key, pressed: true, modifiers, .. } = event else { return None };
    let is_meant =
        |binding: &&Binding| binding.key == *key && modifiers.matches_logically(binding.modifiers);
    let binding = BINDINGS.iter().find(is_meant).filter(|binding| is_free(binding))?;
    Some(binding.command.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things_and_a_key_alone_comes_after_those_with_modifiers() {
        for (at, binding) in BINDINGS.iter().enumerate() {
            for before in &BINDINGS[..at] {
                if before.key == binding.key {
                    assert_ne!(before.modifiers, binding.modifiers, "{:?}", binding.key);
                    assert!(!before.modifiers.is_none(), "{:?} would take the other", before.key);
                }
            }
        }
    }
}
