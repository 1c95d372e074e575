//! Where an export goes (届け先): a card for each program or person, with what it writes and the next step there.

use egui::{FontId, Grid, Response, RichText, Role, Sense, StrokeKind, Ui, WidgetInfo, vec2};

use super::export_settings::Order;
use super::words::Words;
use genga_files::FORMATS;

/// Size of a card in points.
const WIDE: f32 = 172.0;
const HIGH: f32 = 62.0;
const GAP: f32 = 6.0;

/// A place that results go to.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Destination {
    english: &'static str,
    japanese: &'static str,
    /// The formats it needs beyond those that every export has.
    formats: &'static [&'static str],
    writes: &'static str,
    writes_japanese: &'static str,
    next: &'static str,
    next_japanese: &'static str,
}

/// All destinations.
static DESTINATIONS: [Destination; 8] = [
    Destination {
        english: "Clip Studio",
        japanese: "クリスタ",
        formats: &["cut"],
        writes: "a cut folder: timesheets (XDTS), numbered pictures",
        writes_japanese: "カット袋: タイムシート (XDTS) と番号付きの絵",
        next: "In Clip Studio Paint EX: put the pictures of genga/A into an animation folder A as its cels, genga 9 is \
               A_0009.png. Then File, Import, Timesheet, and choose the _genga_ts.xdts. The folder douga and the \
               _douga_ts.xdts are the same with the inbetweens, numbered anew. The timesheets call the cels \
               1, 2, 3. Each is there twice, in the cut and beside its pictures.",
        next_japanese: "CLIP STUDIO PAINT EX でアニメーションフォルダー A を作り、genga/A の絵をセルとして入れる (原画9は \
                        A_0009.png)。次に「ファイル」→「読み込み」→「タイムシート情報」で _genga_ts.xdts を選ぶ。中割りも\
                        入れるなら、動画の番号の付いた douga/A と _douga_ts.xdts を使う。シートの上のセル名は 1、2、3。同じタイムシートがカット袋と絵の隣の2か所にある。",
    },
    Destination {
        english: "OpenToonz",
        japanese: "OpenToonz",
        formats: &["cut"],
        writes: "a cut folder: timesheets (XDTS), numbered pictures",
        writes_japanese: "カット袋: タイムシート (XDTS) と番号付きの絵",
        next: "In OpenToonz: File, Load Level for the pictures of the cut folder, File, Import, Timesheet for its XDTS.",
        next_japanese: "OpenToonz でカット袋の絵をレベルとして読み込み、XDTS のタイムシートを読み込む。",
    },
    Destination {
        english: "After Effects",
        japanese: "After Effects",
        formats: &["ae", "images"],
        writes: "time remapping, numbered pictures",
        writes_japanese: "タイムリマップ、番号付きの絵",
        next: "In After Effects: import the pictures at the rate of the sheet, then copy the text of ae/A.txt and paste \
               it on the layer.",
        next_japanese: "After Effects にシートのレートで絵を読み込み、ae/A.txt の中身をコピーしてレイヤーに貼り付ける。",
    },
    Destination {
        english: "Blender",
        japanese: "Blender",
        formats: &["glb"],
        writes: "the sheet for the extension, stepped motion (GLB)",
        writes_japanese: "アドオン用のシート、コマ打ちした動き (GLB)",
        next: "In Blender: with genga's extension put sheet.json onto the armature, or import limited.glb.",
        next_japanese: "Blender で genga のアドオンを使って sheet.json をアーマチュアに適用するか、limited.glb を読み込む。",
    },
    Destination {
        english: "Paper",
        japanese: "紙",
        formats: &["xsheet"],
        writes: "an X-sheet to print, A4 or B4",
        writes_japanese: "印刷するタイムシート (A4・B4)",
        next: "Open the _xsheet.html in a browser and print it.",
        next_japanese: "_xsheet.html をブラウザーで開いて印刷する。",
    },
    Destination {
        english: "MikuMikuDance",
        japanese: "MikuMikuDance",
        formats: &["vmd"],
        writes: "a motion (VMD)",
        writes_japanese: "モーション (VMD)",
        next: "In MikuMikuDance: load your model, then drop the .vmd onto the window.",
        next_japanese: "MikuMikuDance でモデルを読み込み、.vmd をウィンドウにドロップする。",
    },
    Destination {
        english: "Game engine",
        japanese: "ゲームエンジン",
        formats: &["glb", "keys-glb"],
        writes: "stepped motion, and few keys with curves (GLB)",
        writes_japanese: "コマ打ちした動きと、カーブのキー (GLB)",
        next: "Import limited.glb; its steps stay without any smoothing.",
        next_japanese: "limited.glb を読み込む。補間せずにそのまま再生する。",
    },
    Destination {
        english: "A colleague",
        japanese: "同僚に送る",
        formats: &["flipbook", "contact"],
        writes: "a page to step through, a picture of all genga",
        writes_japanese: "コマ送りできるページ、原画の一覧",
        next: "Send flipbook.html: it opens in any browser and needs nothing else.",
        next_japanese: "flipbook.html を送る。どのブラウザーでも開き、ほかに何もいらない。",
    },
];

impl Destination {
    /// The formats that this build of genga can write, in the order of an [`Order`].
    fn ordered(&self) -> Vec<&'static str> {
        let all = FORMATS.iter().map(|format| format.name);
        all.filter(|name| self.formats.contains(name)).collect()
    }

    /// Whether an order asks for this and nothing else.
    fn is_of(&self, order: &Order) -> bool {
        !order.formats.is_empty() && order.formats == self.ordered()
    }

    /// Describes its files, without those of every export.
    pub(super) fn writes(&self, words: Words) -> &'static str {
        words.say(self.writes, self.writes_japanese)
    }

    /// The next step there, in English and in Japanese.
    pub(super) fn next(&self) -> (&'static str, &'static str) {
        (self.next, self.next_japanese)
    }
}

/// Returns the destination of an order. If several have its formats, it is the one that was chosen. `None` if the order
/// asks for formats of its own.
pub(super) fn of(order: &Order) -> Option<&'static Destination> {
    let fitting = || DESTINATIONS.iter().filter(|destination| destination.is_of(order));
    fitting().find(|destination| destination.english == order.to).or_else(|| fitting().next())
}

/// Shows the cards, in as many columns as fit. A click orders what its destination needs. Focuses the first on request.
pub(super) fn show(ui: &mut Ui, order: &mut Order, wants_focus: bool, words: Words) {
    let columns = ((ui.available_width() + GAP) / (WIDE + GAP)).floor().clamp(1.0, 4.0) as usize;
    Grid::new("destinations").num_columns(columns).spacing([GAP, GAP]).show(ui, |ui| {
        // A build without images cannot write for all of them.
        let all = DESTINATIONS.iter().filter(|own| !own.ordered().is_empty());
        for (at, destination) in all.enumerate() {
            let name = words.say(destination.english, destination.japanese);
            let is_on = of(order) == Some(destination);
            let card = card(ui, (name, destination.writes(words)), is_on);
            if wants_focus && at == 0 {
                card.request_focus();
            }
            if card.clicked() {
                order.formats = destination.ordered();
                order.to = destination.english.to_owned();
            }
            if at % columns == columns - 1 {
                ui.end_row();
            }
        }
    });
}

/// Shows the next step at the destination of an order. The room is that of the longest, so that nothing below moves when
/// another is chosen.
pub(super) fn show_next(ui: &mut Ui, order: &Order, words: Words) {
    let font = FontId::proportional(12.0);
    let color = ui.visuals().weak_text_color();
    let laid =
        |text: &str| ui.painter().layout(text.into(), font.clone(), color, ui.available_width());
    let said = |own: &Destination| words.say(own.next, own.next_japanese);
    let highest = DESTINATIONS.iter().map(|own| laid(said(own)).size().y).fold(0.0, f32::max);
    let none = words.say(
        "Choose a card. The next step in that program is then told here.",
        "カードを選ぶと、そのソフトでの次の手順をここに示す。",
    );
    let text = of(order).map_or(none, said);
    let size = vec2(ui.available_width(), highest);
    ui.allocate_ui(size, |ui| {
        ui.set_min_height(highest);
        ui.label(RichText::new(text).size(12.0).weak());
    });
}

/// A button with a name and what it writes.
fn card(ui: &mut Ui, (name, writes): (&str, &str), is_on: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(WIDE, HIGH), Sense::click());
    let visuals = ui.style().interact_selectable(&response, is_on);
    let faint = if is_on { visuals.text_color() } else { ui.visuals().weak_text_color() };
    let painter = ui.painter_at(rect);
    painter.rect(rect, 5.0, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
    let inside = rect.shrink2(vec2(9.0, 6.0));
    let mut at = inside.min;
    for (text, size, color) in [(name, 13.5, visuals.text_color()), (writes, 11.5, faint)] {
        let font = FontId::proportional(size);
        let galley = painter.layout(text.to_owned(), font, color, inside.width());
        let high = galley.size().y;
        painter.galley(at, galley, color);
        at.y += high + 2.0;
    }
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_on, name));
    response
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    #[test]
    fn each_destination_is_told_from_the_others() {
        // A build without pictures cannot write for all.
        for destination in DESTINATIONS.iter().filter(|own| !own.ordered().is_empty()) {
            let mut order = Order::remembered("\n\n", PathBuf::new());
            assert_eq!(of(&order), None, "nothing is for nobody");
            order.formats = destination.ordered();
            order.to = destination.english.to_owned();
            let has_all = order.formats.len() == destination.formats.len();
            assert!(!has_all || of(&order) == Some(destination), "{}", destination.english);
            order.to = String::new();
            assert!(!has_all || of(&order).is_some(), "an order of an earlier version");
            order.toggle("sts", true);
            assert_eq!(of(&order), None, "with more it is an order of its own");
        }
    }
}
