//! Small windows, and screens with many pixels per point: nothing is cut and nothing overlaps.
//!
//! With `GENGA_LOOK=folder` each window is written there as a picture.

use std::sync::Arc;

use egui::accesskit::{Role, Toggled};
use egui::{Key, Modifiers, Rect, Theme, pos2};
use egui_kittest::kittest::{NodeT, Queryable};
use genga_studio::Language;

use crate::harness::{Table, sample};

/// Sizes of windows in points, and pixels per point: screens of 1280 × 800 and of 1440 × 900 at 200 % first.
const WINDOWS: [((usize, usize), f32); 6] = [
    ((640, 400), 2.0),
    ((720, 450), 2.0),
    ((1024, 700), 1.0),
    ((1280, 800), 1.0),
    ((1440, 900), 2.0),
    ((1920, 1080), 1.0),
];

const CONTROLS: [Role; 6] =
    [Role::Button, Role::CheckBox, Role::ComboBox, Role::SpinButton, Role::TextInput, Role::Slider];

impl Table {
    fn in_small((size, scale): ((usize, usize), f32), language: Language) -> Self {
        // Looked at in both themes, with each language.
        let theme = if language == Language::English { Theme::Light } else { Theme::Dark };
        let mut table = Self::in_window((size, scale), Arc::default(), language, theme);
        table.open(&sample("kick.bvh"));
        (0..7).for_each(|_| table.harness.key_press(Key::ArrowDown));
        table.harness.run();
        table
    }

    fn window(&self) -> Rect {
        self.harness.ctx.content_rect()
    }

    /// The named controls of the window, with their visible rectangles.
    fn controls(&self) -> Vec<(String, Rect)> {
        let window = self.window();
        let all = self.harness.query_all_by(|node| CONTROLS.contains(&node.role()));
        let named = all.map(|node| {
            let name = node.accesskit_node().label().unwrap_or_default();
            (name, node.rect())
        });
        named.filter(|(_, rect)| rect.intersects(window) && rect.is_positive()).collect()
    }

    /// Lists the controls beyond the window's edge or on one another.
    fn faults(&self) -> Vec<String> {
        let (window, controls) = (self.window(), self.controls());
        let mut faults = Vec::new();
        for (at, (name, rect)) in controls.iter().enumerate() {
            if rect.min.x < window.min.x - 0.5 || rect.max.x > window.max.x + 0.5 {
                faults.push(format!("{name} is cut: {rect}"));
            }
            for (other, of_other) in &controls[..at] {
                let common = rect.intersect(*of_other);
                // A slider and its value share a name, and edges may touch.
                if common.width() > 1.0 && common.height() > 1.0 {
                    faults.push(format!("{name} {rect} lies on {other} {of_other}"));
                }
            }
        }
        faults
    }

    pub(crate) fn write_to_look_at(&mut self, name: &str) {
        if let Some(folder) = std::env::var_os("GENGA_LOOK") {
            let path = std::path::Path::new(&folder).join(format!("{name}.png"));
            crate::pictures::pixmap(&self.picture()).save_png(path).unwrap();
        }
    }
}

fn name_of(((wide, high), scale): ((usize, usize), f32), language: Language) -> String {
    let language = if language == Language::Japanese { "ja" } else { "en" };
    format!("{wide}x{high}-at-{scale}-{language}")
}

fn every_window(name: &str, mut work: impl FnMut(&mut Table) -> Vec<String>) {
    let mut faults = Vec::new();
    for window in WINDOWS {
        for language in [Language::English, Language::Japanese] {
            let mut table = Table::in_small(window, language);
            let of_window = name_of(window, language);
            let found = work(&mut table);
            faults.extend(found.into_iter().map(|fault| format!("{of_window}: {fault}")));
            table.write_to_look_at(&format!("{name}-{of_window}"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn nothing_is_cut_and_nothing_lies_on_anything() {
    every_window("table", |table| table.faults());
}

#[test]
fn with_any_panel_nothing_is_cut_and_views_are_left() {
    every_window("panels", |table| {
        let mut faults = Vec::new();
        for (name, key) in [("(8)", Key::Num8), ("(9)", Key::Num9), ("(7)", Key::Num7)] {
            let is_on = |table: &Table| {
                // A window with room for every panel shows no switches, unless a panel is hidden.
                let button = table.harness.query_by_label_contains(name);
                button.is_none_or(|button| button.accesskit_node().toggled() == Some(Toggled::True))
            };
            if !is_on(table) {
                table.tap(Modifiers::NONE, key);
            }
            assert!(is_on(table), "{name}");
            let view = table.harness.query_all_by_role(Role::Canvas).map(|node| node.rect());
            let least = view.map(|rect| rect.width().min(rect.height())).fold(1e9, f32::min);
            faults.extend(table.faults());
            if least < 60.0 {
                faults.push(format!("{name}: a view has {least} points"));
            }
        }
        faults
    });
}

#[test]
fn the_tour_fits() {
    every_window("tour", |table| {
        table.tap(Modifiers::NONE, Key::F1);
        let begin = table.harness.query_by_label("Tour of six steps");
        begin
            .or_else(|| table.harness.query_by_label("6ステップの案内"))
            .unwrap()
            .click_accesskit();
        table.harness.run();
        assert!(table.harness.query_by_label("1/6").is_some());
        table.faults()
    });
}

#[test]
fn the_order_of_an_export_fits_and_its_button_stays() {
    every_window("export", |table| {
        table.tap(Modifiers::COMMAND, Key::E);
        let write = |table: &Table| {
            let english = table.harness.query_by_label("Write the files");
            english.or_else(|| table.harness.query_by_label("書き出す")).unwrap().rect()
        };
        let mut faults = Vec::new();
        let place = write(table);
        for card in ["MikuMikuDance", "OpenToonz"] {
            table.harness.get_by_label(card).click_accesskit();
            table.harness.run();
            if write(table) != place {
                faults.push(format!("{card} moves the button from {place} to {}", write(table)));
            }
        }
        let all = table.harness.query_by_label("All formats");
        let all = all.or_else(|| table.harness.query_by_label("すべての形式")).unwrap();
        all.click_accesskit();
        table.harness.run();
        for format in ["xsheet", "xdts"] {
            let own = table.harness.query_all_by_label_contains(format).next().unwrap();
            own.click_accesskit();
            table.harness.run();
        }
        let rect = write(table);
        let is_seen = table.window().contains_rect(rect);
        faults.extend((!is_seen).then(|| format!("the button stands at {rect}")));
        faults
    });
}

#[test]
fn the_list_of_keys_fits_and_is_turned_by_the_keyboard() {
    every_window("keys", |table| {
        table.tap(Modifiers::NONE, Key::F1);
        let mut all = table.harness.query_all_by_role(Role::Window).map(|node| node.rect());
        let list = all.next_back().unwrap_or(Rect::from_min_max(pos2(0.0, 0.0), pos2(9e9, 9e9)));
        let is_seen = table.window().expand(1.0).contains_rect(list);
        (!is_seen).then(|| format!("the list is {list}")).into_iter().collect()
    });
}

#[test]
fn what_is_said_before_a_clip_is_open_fits() {
    for window in WINDOWS {
        for language in [Language::English, Language::Japanese] {
            let theme = if language == Language::English { Theme::Light } else { Theme::Dark };
            let mut table = Table::in_window(window, Arc::default(), language, theme);
            table.harness.run();
            let faults = table.faults();
            assert!(faults.is_empty(), "{}: {}", name_of(window, language), faults.join("\n"));
            let first = table.harness.query_by_label("Choose a file…");
            let first =
                first.or_else(|| table.harness.query_by_label("ファイルを選ぶ…")).unwrap().rect();
            assert!(table.window().contains_rect(first), "{first}");
            table.write_to_look_at(&format!("welcome-{}", name_of(window, language)));
        }
    }
}
