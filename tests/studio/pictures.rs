//! Pictures of the studio, the same as in the documentation.
//!
//! `GENGA_PICTURES=write cargo test --features studio-tests --test studio` writes them anew.

use std::path::Path;
use std::sync::Arc;

use egui::{Context, FontData, FontFamily, Key, Theme};
use egui_kittest::kittest::Queryable;
use genga_studio::Language;
use resvg::tiny_skia::Pixmap;
use resvg::usvg::fontdb;

use crate::harness::{Table, sample};
use crate::software_renderer::Picture;

/// Tolerance of a colour channel. Other processors may round a circle differently.
const OFF: u8 = 3;

impl Table {
    pub(crate) fn picture(&mut self) -> Picture {
        self.harness.remove_cursor();
        self.harness.run();
        let output = self.harness.output();
        let scale = output.pixels_per_point;
        let drawn = self.harness.ctx.tessellate(output.shapes.clone(), scale);
        let size = self.harness.ctx.content_rect().size();
        let size = (size.x.round() as usize, size.y.round() as usize);
        Picture::new((size, scale), &drawn, &self.soft.0.borrow())
    }

    fn press_all(&mut self, keys: &[Key]) {
        keys.iter().for_each(|key| self.harness.key_press(*key));
        self.harness.run();
    }
}

/// Converts a picture for writing.
pub(crate) fn pixmap(picture: &Picture) -> Pixmap {
    let bytes: Vec<u8> = picture.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
    let (width, height) = (picture.width as u32, picture.height as u32);
    let mut made = Pixmap::new(width, height).unwrap();
    made.data_mut().copy_from_slice(&bytes);
    made
}

/// Compares a picture with that of the documentation, or writes it anew.
fn compare(name: &str, picture: &Picture) {
    let made = pixmap(picture);
    let (width, height) = (made.width(), made.height());
    let folder = crate::real::repository().join("docs/pictures");
    let path = folder.join(format!("{name}.png"));
    if std::env::var_os("GENGA_PICTURES").is_some_and(|wish| wish == "write") {
        return made.save_png(&path).unwrap();
    }
    let meant = Pixmap::load_png(&path).unwrap();
    assert_eq!((meant.width(), meant.height()), (width, height), "{name}");
    let is_off = |(a, b): &(&u8, &u8)| a.abs_diff(**b) > OFF;
    let off = made.data().iter().zip(meant.data()).filter(is_off).count();
    if off > 0 {
        let seen = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
        made.save_png(&seen).unwrap();
        panic!("{name}: {off} values are off; what was drawn is {}", seen.display());
    }
}

/// Gives a window the system's Japanese font.
pub(crate) fn with_japanese(context: &Context) {
    let mut fonts = fontdb::Database::new();
    fonts.load_system_fonts();
    let families = [fontdb::Family::Name("Noto Sans CJK JP")];
    let query = fontdb::Query { families: &families, ..fontdb::Query::default() };
    let id = fonts.query(&query).expect("the tests need fonts-noto-cjk, as the pictures do");
    let (bytes, index) = fonts.with_face_data(id, |bytes, index| (bytes.to_vec(), index)).unwrap();
    let data = FontData { index, ..FontData::from_owned(bytes) };
    let mut all = egui::FontDefinitions::default();
    all.font_data.insert("japanese".into(), Arc::new(data));
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        all.families.entry(family).or_default().push("japanese".into());
    }
    context.set_fonts(all);
}

#[test]
fn the_studio_looks_as_it_did() {
    let mut table = Table::plain_kick();
    table.press_all(&[Key::ArrowDown; 9]);
    compare("studio", &table.picture());
}

#[test]
fn by_night_with_the_neighbours_and_from_the_side_it_looks_as_it_did() {
    let mut table =
        Table::plain(&sample("pitch.bvh"), Arc::default(), Language::English, Theme::Dark);
    table.press_all(&[Key::Num2, Key::G, Key::F]);
    table.press_all(&[Key::ArrowDown; 6]);
    compare("studio-night", &table.picture());
}

#[test]
fn in_japanese_with_the_map_it_looks_as_it_did() {
    let mut table =
        Table::plain(&sample("kick.bvh"), Arc::default(), Language::Japanese, Theme::Light);
    table.press_all(&[Key::ArrowDown; 7]);
    table.press_all(&[Key::Num7, Key::Num8, Key::H]);
    table.harness.run_steps(8);
    table.rest();
    compare("studio-map", &table.picture());
}

#[test]
fn corrected_it_looks_as_it_did() {
    let mut table = Table::plain_kick();
    table.press_all(&[Key::ArrowDown, Key::ArrowDown, Key::L, Key::ArrowDown, Key::K]);
    table.press_all(&[Key::ArrowRight; 4]);
    table.press_all(&[Key::K, Key::Home, Key::CloseBracket, Key::CloseBracket]);
    compare("studio-corrected", &table.picture());
}

#[test]
fn in_japanese_every_letter_has_a_glyph_and_english_comes_back() {
    let mut table =
        Table::plain(&sample("kick.bvh"), Arc::default(), Language::Japanese, Theme::Light);
    table.harness.get_by_label("書き出し");
    table.harness.get_by_label("TVアクション");
    table.press_all(&[Key::F1]);
    table.harness.get_by_label("素材と結果を切り替え");
    table.press_all(&[Key::Escape, Key::J]);
    table.harness.get_by_label("Export");
}

#[test]
fn without_a_japanese_font_the_labels_are_english() {
    let table = Table::empty(Arc::default(), Language::English, Theme::Light);
    table.harness.get_by_label("Open");
    let button = table.harness.get_by_label("Japanese");
    assert!(egui_kittest::kittest::NodeT::accesskit_node(&button).is_disabled());
}
