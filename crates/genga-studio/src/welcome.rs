//! The welcome screen, shown while no clip is open: what can be opened, the words of the studio, and its first steps.

use std::path::PathBuf;

use egui::{Button, CentralPanel, Label, RichText, ScrollArea, Ui};

use super::command::Command;
use super::file_field;
use super::theme::Look;
use super::words::Words;

/// Greatest width of the text in points.
const WIDE: f32 = 620.0;

/// What can be dropped.
const FORMATS: (&str, &str) = (
    "BVH, FBX, glTF and GLB, VRM animation, ASF/AMC, VMD of MikuMikuDance, or a folder of takes",
    "BVH、FBX、glTF・GLB、VRMアニメーション、ASF/AMC、MikuMikuDance の VMD、またはテイクのフォルダー",
);

/// Words that an animator of another school may not know.
const WORDS: [(&str, &str, &str, &str); 4] = [
    (
        "genga",
        "原画",
        "a drawing that fixes the movement: a start, an end, a turning point",
        "動きを決める画。動き始め、動き終わり、変わり目",
    ),
    ("inbetween", "中割り", "a drawing between two genga", "原画と原画の間の画"),
    (
        "koma",
        "コマ",
        "one exposure of 1/24 s; a drawing stays for one or more",
        "1/24秒の1コマ。一枚の画は1コマ以上見せる",
    ),
    (
        "wall",
        "壁",
        "where the body stops accelerating; seen on the curves",
        "体の加速が終わるところ。グラフに出る",
    ),
];

/// The first steps, in order.
const STEPS: [(&str, &str); 6] = [
    (
        "Open a clip. The strip below the views shows its genga as figures.",
        "クリップを開く。画面の下の列に、原画が小さなポーズで並ぶ。",
    ),
    (
        "Space plays. Rest the pointer on a figure to see its passage.",
        "スペースで再生。ポーズにポインターを置くと、次の原画まで動く。",
    ),
    (
        "Drag How many genga until only the poses you want are left.",
        "「原画の枚数」を動かし、残したいポーズだけにする。",
    ),
    (
        "Pin a figure that must stay, forbid one that must not.",
        "残すポーズは固定し、いらないポーズは禁止する。",
    ),
    (
        "Choose Drawings a second and How snappy. V shows before and after.",
        "「1秒の動画枚数」と「メリハリ」を決める。V で変更前と見比べる。",
    ),
    ("Export: choose where it goes.", "書き出し: 届け先を選ぶ。"),
];

/// Shows how to open a clip, and what comes then.
pub(super) fn show(
    ui: &mut Ui,
    look: &Look,
    recent: &[PathBuf],
    has_names: bool,
    words: Words,
    commands: &mut Vec<Command>,
) {
    CentralPanel::default_margins().show(ui, |ui| {
        let rect = ui.available_rect_before_wrap();
        ui.painter().rect_filled(rect, 6.0, look.ground);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let side = (0.5 * (ui.available_width() - WIDE)).max(12.0);
            ui.horizontal_top(|ui| {
                ui.add_space(side);
                ui.vertical(|ui| {
                    ui.set_max_width(WIDE.min(rect.width() - 2.0 * side));
                    ui.add_space((0.08 * rect.height()).min(60.0));
                    open(ui, look, recent, has_names, words, commands);
                    explain(ui, look, words);
                });
            });
        });
    });
}

/// Shows what can be opened, and the clips opened last.
fn open(
    ui: &mut Ui,
    look: &Look,
    recent: &[PathBuf],
    has_names: bool,
    words: Words,
    commands: &mut Vec<Command>,
) {
    let what = words.say("Drop a clip here", "ここにモーションファイルをドロップ");
    ui.label(RichText::new(what).size(24.0).color(look.ink));
    let formats = RichText::new(words.say(FORMATS.0, FORMATS.1)).color(look.faint);
    ui.add(Label::new(formats).wrap());
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        if ui.add(Button::new(words.say("Choose a file…", "ファイルを選ぶ…"))).clicked()
        {
            commands.push(Command::Choose);
        }
        let name = words.say("or open one by its name", "またはファイル名で開く");
        if has_names && ui.add(Button::new(name)).clicked() {
            commands.push(Command::OpenFile);
        }
    });
    if !recent.is_empty() {
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            ui.weak(words.say("recent", "最近のファイル"));
            file_field::recent(ui, recent, commands);
        });
    }
    ui.add_space(18.0);
}

/// Explains the words and the first steps.
fn explain(ui: &mut Ui, look: &Look, words: Words) {
    let line = |ui: &mut Ui, head: &str, text: &str| {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(head).strong().color(look.genga));
            ui.label(RichText::new(text).color(look.ink));
        });
    };
    ui.strong(words.say("Words", "用語"));
    for (english, japanese, meaning, in_japanese) in WORDS {
        match words.is_japanese() {
            true => line(ui, japanese, in_japanese),
            false if words.has_japanese => line(ui, &format!("{english} {japanese}"), meaning),
            false => line(ui, english, meaning),
        }
    }
    ui.add_space(12.0);
    ui.strong(words.say("In a minute", "1分で一通り"));
    for (at, (english, japanese)) in STEPS.into_iter().enumerate() {
        line(ui, &(at + 1).to_string(), words.say(english, japanese));
    }
    ui.add_space(12.0);
}
