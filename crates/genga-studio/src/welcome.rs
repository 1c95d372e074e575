//! The welcome screen, shown while no clip is open: what can be opened, the words of the studio, and its first steps.

use std::path::PathBuf;

use egui::{Button, CentralPanel, Label, RichText, ScrollArea, Ui};

use super::command::Command;
use super::file_field;
use super::theme::Look;
use super::tour;
use super::words::Words;

/// Greatest width of the text in points.
const WIDE: f32 = 620.0;

/// What can be dropped.
const FORMATS: (&str, &str) = (
    "BVH, FBX, glTF and GLB, VRM animation, ASF/AMC, VMD of MikuMikuDance, or a folder of takes",
    "BVH、FBX、glTF・GLB、VRMA、ASF/AMC、MikuMikuDance の VMD、テイクのフォルダー",
);
/// What can be dropped on a page, which reads one file at a time and no FBX.
const ON_A_PAGE: (&str, &str) = (
    "BVH, glTF and GLB, VRM animation, VMD of MikuMikuDance. FBX or AMC: export it as BVH or GLB first. Nothing leaves \
     this computer.",
    "BVH、glTF・GLB、VRMA、MikuMikuDance の VMD。FBX と AMC は BVH か GLB に書き出してから。\
     ファイルはどこにも送られません。",
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
    let (english, japanese) = formats(has_names);
    let formats = RichText::new(words.say(english, japanese)).color(look.faint);
    ui.add(Label::new(formats).wrap());
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        if ui.add(Button::new(words.say("Choose a file…", "ファイルを選ぶ…"))).clicked()
        {
            commands.push(Command::Choose);
        }
        let sample = words.say("Try it with a kick", "キックで試す");
        let sample = ui.add(Button::new(sample).selected(true));
        if sample.on_hover_text(about_sample(has_names, words)).clicked() {
            commands.push(Command::Sample);
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

/// What can be opened, in English and Japanese.
pub(super) fn formats(has_names: bool) -> (&'static str, &'static str) {
    if has_names { FORMATS } else { ON_A_PAGE }
}

fn about_sample(has_names: bool, words: Words) -> &'static str {
    match has_names {
        true => words.say(
            "A built-in clip of 4 seconds. It is put into the folder genga of your home folder.",
            "内蔵の4秒のクリップ。ホームの genga フォルダーに置かれる。",
        ),
        false => words.say("A built-in clip of 4 seconds", "内蔵の4秒のクリップ"),
    }
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
    for (at, step) in tour::steps(words).enumerate() {
        line(ui, &(at + 1).to_string(), step);
    }
    ui.add_space(12.0);
}
