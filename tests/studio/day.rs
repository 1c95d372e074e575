//! A day's work on one take: a minute of motion in two columns, with a sound and a reference sequence. It is loaded,
//! tuned, pinned, held, spoken, exported and opened again. Each of ten steps leaves a picture in `target/tmp/day`;
//! `tests/others/studio/day` makes only these.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Key, Modifiers, Theme};
use egui_kittest::kittest::Queryable;
use genga::sheet::SpokenLine;
use genga_files::{sheet_json, xdts};
use genga_studio::Language;
use resvg::tiny_skia::Pixmap;
use resvg::usvg;

use crate::footage::beats;
use crate::harness::{Table, sample};
use crate::pictures::pixmap;
use crate::real;

const SECONDS: usize = 60;
/// Pictures per second of the reference, on purpose not the rate of the sheet.
const FPS: usize = 12;

/// The clips to join: captured ones if available, else one sample repeated.
fn clips() -> Vec<PathBuf> {
    let mut clips = vec![sample("pitch.bvh"); 60];
    real::with(["cmu-01_06-playground-long", "cmu-02_07-swordplay"], |real| clips = real.to_vec());
    clips
}

/// Splits a BVH into the text before the motion, the rate, and the rows.
fn parts(clip: &Path) -> (String, f64, Vec<Vec<f64>>) {
    let text = String::from_utf8_lossy(&fs::read(clip).unwrap()).into_owned();
    let (head, motion) = text.split_once("MOTION").unwrap();
    let mut lines = motion.trim_start().lines();
    lines.next();
    let time: f64 = lines.next().unwrap().split(':').nth(1).unwrap().trim().parse().unwrap();
    let row = |line: &str| -> Vec<f64> {
        line.split_whitespace().map(|value| value.parse().unwrap()).collect()
    };
    let rows = lines.filter(|line| !line.trim().is_empty()).map(row).collect();
    (head.to_owned(), (1.0 / time).round(), rows)
}

/// Writes a minute of clips of one skeleton, each beginning where the previous one ended.
fn minute(clip: &Path) {
    let (head, rate, mut joined) = parts(&clips()[0]);
    let count = SECONDS * rate as usize;
    for next in &clips()[1..] {
        let (_, _, rows) = parts(next);
        let (end, begin) = (joined[joined.len() - 1].clone(), rows[0].clone());
        assert_eq!(end.len(), begin.len(), "clips of one skeleton");
        joined.extend(rows.into_iter().map(|mut row| {
            for across in [0, 2] {
                row[across] += end[across] - begin[across];
            }
            row
        }));
    }
    joined.truncate(count);
    let row = |row: &Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let rows = joined.iter().map(row).collect::<Vec<_>>().join("\n");
    let text =
        format!("{head}MOTION\nFrames: {}\nFrame Time: {}\n{rows}\n", joined.len(), 1.0 / rate);
    fs::write(clip, text).unwrap();
}

/// Writes a reference sequence: a ball circles once a second above a bar that fills within a minute.
fn reference(folder: &Path) -> PathBuf {
    fs::create_dir_all(folder).unwrap();
    for at in 0..SECONDS * FPS {
        let turn = at as f64 / FPS as f64 * std::f64::consts::TAU;
        let ball = (160.0 + 55.0 * turn.sin(), 80.0 - 55.0 * turn.cos());
        let filled = 320.0 * at as f64 / (SECONDS * FPS) as f64;
        let picture = image::RgbImage::from_fn(320, 180, |x, y| {
            let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            image::Rgb(match (x, y) {
                (x, y) if (x - ball.0).hypot(y - ball.1) < 16.0 => [236, 170, 60],
                (x, y) if ((x - 160.0).hypot(y - 80.0) - 55.0).abs() < 1.0 => [90, 110, 130],
                (x, y) if y > 164.0 && x < filled => [90, 170, 140],
                (_, y) if y > 164.0 => [60, 70, 82],
                _ => [38, 46, 56],
            })
        });
        picture.save(folder.join(format!("take_{:04}.png", at + 1))).unwrap();
    }
    folder.join("take_0001.png")
}

/// Path of a picture to look at.
fn shown(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("day").join(name)
}

impl Table {
    /// Saves a picture of the window.
    fn leave(&mut self, name: &str) {
        self.look();
        let picture = pixmap(&self.picture());
        picture.save_png(shown(name)).unwrap();
    }
}

/// Renders the first page of an X-sheet as a picture.
fn page(svg: &Path, name: &str) {
    let mut options = usvg::Options::default();
    options.fontdb_mut().load_system_fonts();
    options.fontdb_mut().set_sans_serif_family("Noto Sans CJK JP");
    let tree = usvg::Tree::from_data(&fs::read(svg).unwrap(), &options).unwrap();
    let size = tree.size().to_int_size();
    let mut pixmap = Pixmap::new(size.width(), size.height()).unwrap();
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, usvg::Transform::identity(), &mut pixmap.as_mut());
    pixmap.save_png(shown(name)).unwrap();
}

const LAYERS: &str = r#"[{ name = "A", joints = ["Hips"] }, { name = "B", joints = ["*Arm*", "*Hand*", "*Finger*", "*Thumb*"] }]"#;

#[test]
fn a_minute_is_worked_on_from_loading_to_reopening() {
    drop(fs::remove_dir_all(shown("")));
    fs::create_dir_all(shown("")).unwrap();
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("minute.bvh");
    minute(&clip);
    let pictures = reference(&place.path().join("reference"));
    let sound = place.path().join("minute.wav");
    beats(&sound, SECONDS as u32);

    // Load, with Japanese labels too.
    let mut table = Table::with(&clip, Arc::default(), Language::Japanese, Theme::Light);
    table.tap(Modifiers::NONE, Key::J);
    table.leave("01-loaded.png");

    for file in [&pictures, &sound] {
        table.harness.state_mut().open_any(file);
        table.harness.run();
    }
    table.write("pictures a second", &FPS.to_string());
    table.tap(Modifiers::NONE, Key::Enter);
    table.leave("02-reference.png");
    table.tap(Modifiers::NONE, Key::Escape);
    table.tap(Modifiers::NONE, Key::Escape);
    assert_eq!(table.footage().fps, FPS as f64);

    table.harness.state_mut().turn("layers", LAYERS).unwrap();
    table.go(60);
    table.leave("03-two-columns.png");

    table.harness.state_mut().turn("keys.min_price", "8").unwrap();
    table.turn("spacing.on", "3");
    table.leave("04-tuned.png");

    table.tap(Modifiers::NONE, Key::A);
    table.go(92);
    table.tap(Modifiers::NONE, Key::K);
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::L);
    let pins = table.edits().layers["B"].pins.len();
    assert_eq!(pins, 2, "a genga where there was none, and one that stays");
    table.leave("05-pinned.png");

    table.go(120);
    (0..6).for_each(|_| table.tap(Modifiers::NONE, Key::CloseBracket));
    assert_eq!(table.edits().holds.len(), 1);
    table.leave("06-held.png");

    table.go(1);
    table.say(4, 22, "アキ", "えい、行くぞ！");
    table.say(25, 40, "Ken", "Wait for me!");
    let koma = [(3, 19), (24, 16)];
    table.harness.get_by_label("Spoken line (S)").click();
    table.harness.run();
    table.write("Words", "…");
    table.leave("07-spoken.png");
    table.tap(Modifiers::NONE, Key::Escape);
    table.tap(Modifiers::NONE, Key::Escape);
    assert_eq!(table.edits().speech.len(), 2);

    table.tap(Modifiers::NONE, Key::Num2);
    table.harness.get_by_label("Reference…").click();
    table.harness.run();
    table.harness.get_by_label("Behind the figures").click();
    table.harness.run();
    table.tap(Modifiers::NONE, Key::Escape);
    table.tap(Modifiers::NONE, Key::Escape);
    table.go(31);
    table.leave("08-behind.png");

    table.tap(Modifiers::COMMAND, Key::S);
    table.tap(Modifiers::COMMAND, Key::E);
    table.harness.get_by_label("All formats").click();
    table.harness.run();
    for format in ["xdts", "xsheet"] {
        table.harness.get_by_label(format).click();
        table.harness.run();
    }
    table.leave("09-export.png");
    table.harness.get_by_label("Write the files").click();
    (0..3).for_each(|_| table.harness.step());
    table.rest();

    let (desk, document) =
        (Arc::clone(&table.desk), table.harness.state().document().unwrap().clone());
    drop(table);
    let mut again = Table::with(&clip, desk, Language::Japanese, Theme::Dark);
    assert_eq!(*again.harness.state().document().unwrap(), document);
    again.look();
    again.go(31);
    again.leave("10-reopened.png");

    // Read the exported files again.
    let out = place.path().join("minute-genga");
    let sheet = sheet_json::read(&fs::read(out.join("sheet.json")).unwrap()).unwrap().sheet;
    let [genga, douga] = ["genga", "douga"].map(|side| {
        let file = out.join(format!("minute_{side}_ts.xdts"));
        xdts::read_cells(&fs::read(file).unwrap()).unwrap()
    });
    assert!((SECONDS * 24 - 8..=SECONDS * 24).contains(&sheet.length()), "{}", sheet.length());
    let spoken = |line: &SpokenLine| (line.begin, line.koma);
    for timesheet in [&genga, &douga] {
        assert_eq!((timesheet.length, timesheet.columns.len()), (sheet.length(), 2));
        assert_eq!(timesheet.lines, sheet.lines);
        assert_eq!(timesheet.lines.iter().map(spoken).collect::<Vec<_>>(), koma);
    }
    assert_eq!(xdts::retimed(&douga, &sheet).unwrap(), sheet);
    let html = fs::read_to_string(out.join("minute_xsheet.html")).unwrap();
    for line in ["アキ「えい、行くぞ！」", "Ken: Wait for me!"] {
        assert!(html.contains(line), "{line}");
    }
    let pages = fs::read_dir(out.join("xsheet")).unwrap().count();
    assert!(pages >= sheet.length() / 144, "{pages} pages");
    page(&out.join("xsheet/0001.svg"), "xsheet-1.png");
    let left = fs::read_dir(shown("")).unwrap().count();
    assert_eq!(left, 11, "ten pictures of the window, and a page");
}
