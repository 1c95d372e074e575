//! Draws the head of a page above the koma (title, cut, length, number of drawings) and the legend of the
//! marks below them.

use crate::canvas::{Align, Canvas, Type};
use crate::drawings::seconds_and_koma;
use crate::paper_point::Point;
use crate::style;
use crate::xsheet::InbetweenMark;
use crate::xsheet::grid::{FRAME, WIDTH, bottom};
use crate::xsheet::layout::Page;
use crate::xsheet::paper_layer::Leaf;
use genga::sheet::{Role, Sheet};

const TOP: f64 = 8.0;
const HIGH: f64 = 50.0;

/// Draws the boxes and the lines of counts.
pub(super) fn draw(canvas: &mut Canvas, page: &Page<'_>) {
    boxes(canvas, page);
    let base = TOP + HIGH + 18.0;
    for (at, line) in counts(page.leaves, page.sheet).into_iter().enumerate() {
        let text = style::fitted(&line, 12.0, WIDTH.1 - WIDTH.0);
        canvas.text(&text, (WIDTH.0 + 2.0, base + 16.0 * at as f64), Type::new(12.0));
    }
}

/// Draws the boxes along the upper edge.
pub(super) fn boxes(canvas: &mut Canvas, page: &Page<'_>) {
    let slate = page.slate;
    let sheet = format!("{} / {}", page.number, page.of);
    let time = seconds_and_koma(page.sheet.cut_length(), page.sheet.clock.koma_rate);
    let cut = match (slate.cut.as_str(), slate.take.as_str()) {
        ("", _) => page.cut.to_owned(),
        (cut, "") => cut.to_owned(),
        (cut, take) => format!("{cut}  take {take}"),
    };
    // Beside a number, the name of the cut's files stands small.
    let label = match cut == page.cut {
        true => "カット cut".to_owned(),
        false => style::fitted(&format!("カット cut  {}", page.cut), 9.5, 262.0),
    };
    let boxes = [
        (222.0, "作品 title", slate.title.as_str(), 15.0),
        (66.0, "話数 episode", &slate.episode, 15.0),
        (66.0, "シーン scene", &slate.scene, 15.0),
        (270.0, &label, &cut, 19.0),
        (108.0, "尺 length s+k", &time, 21.0),
        (142.0, "原画 key animator", &slate.animator, 15.0),
        (110.0, "シート sheet", &sheet, 17.0),
    ];
    let mut left = WIDTH.0;
    for (width, label, value, size) in boxes {
        canvas.line((left, TOP), (left, TOP + HIGH), FRAME, 1.5);
        canvas.text(label, (left + 5.0, TOP + 13.0), Type::new(9.5).color(style::FAINT));
        // A long name is made smaller before it is cut off.
        let size = [size, 13.0, 11.0]
            .into_iter()
            .find(|size| style::text_width(value, *size) < width - 26.0)
            .unwrap_or(11.0);
        let value = style::fitted(value, size, width - 10.0);
        let look = Type::new(size).bold().align(Align::Center);
        canvas.text(&value, (left + 0.5 * width, TOP + HIGH - 11.0), look);
        left += width;
    }
    canvas.line((left, TOP), (left, TOP + HIGH), FRAME, 1.5);
    for y in [TOP, TOP + HIGH] {
        canvas.line((WIDTH.0, y), (left, y), FRAME, 1.8);
    }
}

/// Formats the counts of drawings: a line for each layer, or for more than two layers one short line.
fn counts(leaves: &[Leaf<'_>], sheet: &Sheet) -> Vec<String> {
    let mut lines: Vec<_> = leaves.iter().map(count).collect();
    if lines.len() > 2 {
        let short = |leaf: &Leaf<'_>| {
            let (genga, drawings) = (leaf.layer.genga(), drawings(leaf));
            format!("{}: 原画 {genga} / 動画 {drawings}", leaf.layer.name)
        };
        lines = vec![leaves.iter().map(short).collect::<Vec<_>>().join("  ·  ")];
    }
    if lines.len() < 2 {
        lines.push(format!(
            "{} koma at {} a second  ·  コマ番号は1から通し koma count from 1 and run on from page to page",
            sheet.cut_length(),
            sheet.clock.koma_rate
        ));
    }
    lines
}

fn drawings(leaf: &Leaf<'_>) -> usize {
    leaf.layer.shown().count()
}

fn count(leaf: &Leaf<'_>) -> String {
    let (layer, drawings) = (leaf.layer, drawings(leaf));
    // A drawing of a loop comes in every round.
    let mean = layer.length() as f64 / layer.changes().count().max(1) as f64;
    format!(
        "{}:  原画 genga {} ({} ends 端 among them)  ·  動画 drawings {drawings}, inbetweens 中割り {}  ·  \
         平均 mean {mean:.1} koma a drawing  ·  最長の止め longest hold {} koma",
        layer.name,
        leaf.layer.genga(),
        layer.count(Role::End),
        layer.count(Role::Inbetween),
        layer.longest_hold()
    )
}

/// Draws the legend of the marks, below the koma.
pub(super) fn legend(canvas: &mut Canvas, page: &Page<'_>) {
    let y = bottom() + 26.0;
    let mut x = WIDTH.0 + 8.0;
    for (mark, words) in [
        (Sign::Key, "key 原画"),
        (Sign::End, "first, last 端"),
        (Sign::Pinned, "pinned 固定"),
        (Sign::Inbetween, "inbetween 中割り"),
        (Sign::Hold, "hold 止メ (over 3 koma)"),
        (Sign::Blank, "blank カラ"),
        (Sign::CarriedOver, "前段から from the half before"),
    ] {
        sign(canvas, page, mark, (x, y));
        canvas.text(words, (x + 13.0, y + 4.0), Type::new(11.0));
        x += style::text_width(words, 11.0) + 36.0;
    }
    let words = "spacing ツメ指示, on the line from key to key a tick where each drawing stands:  \
                 先 sakizume, slow-out · 後 atozume, slow-in · 両 both · 均 even · 中割なし no inbetween";
    canvas.text(words, (WIDTH.0 + 2.0, y + 23.0), Type::new(11.0).color(style::FAINT));
}

#[derive(Clone, Copy)]
enum Sign {
    Key,
    End,
    Pinned,
    Inbetween,
    Hold,
    Blank,
    CarriedOver,
}

fn sign(canvas: &mut Canvas, page: &Page<'_>, sign: Sign, (x, y): Point) {
    let look = Type::new(10.0).bold().align(Align::Center);
    match sign {
        Sign::Key => {
            canvas.ring((x, y), 7.2, style::GENGA, 1.2);
            canvas.text("2", (x, y + 3.6), look.color(style::GENGA))
        }
        Sign::End => {
            canvas.ring((x, y), 7.2, style::END, 1.2);
            canvas.text("1", (x, y + 3.6), look.color(style::END))
        }
        Sign::Pinned => {
            canvas.disc((x, y), 7.6, style::GENGA);
            canvas.text("3", (x, y + 3.6), look.color(style::PAPER))
        }
        Sign::Inbetween => match page.settings.inbetween {
            InbetweenMark::Dot => canvas.disc((x, y), 2.2, style::INK),
            InbetweenMark::Circle => canvas.ring((x, y), 4.0, style::INK, 1.1),
        },
        Sign::Hold => canvas.line((x, y - 7.0), (x, y + 7.0), style::INK, 1.1),
        Sign::Blank => canvas.cross((x, y), 4.5, style::INK, 1.4),
        Sign::CarriedOver => canvas.text(
            "(4)",
            (x, y + 3.3),
            Type::new(9.0).color(style::FAINT).align(Align::Center),
        ),
    }
}
