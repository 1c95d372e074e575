//! The strip of genga: chosen, dragged, pinned, forbidden and held on the figures, and played under the pointer.

use std::sync::Arc;

use egui::{Key, Modifiers, PointerButton, Pos2, Rect, Shape, Theme, pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use genga_studio::Language;

use crate::harness::{Table, sample};

/// Room at both sides of the strip, in points.
const SIDE: f32 = 22.0;
/// Height of the circles above the lower edge of the strip, in points.
const CIRCLE: f32 = 22.0;

impl Table {
    fn strip(&self) -> Rect {
        self.canvas("Strip of genga")
    }

    /// The place on the strip at which a koma begins, at a share of the height.
    fn on_strip(&self, koma: usize, share: f32) -> Pos2 {
        let rect = self.strip();
        let wide = rect.width() - 2.0 * SIDE;
        let x = rect.min.x + SIDE + wide * koma as f32 / 92.0;
        pos2(x, rect.min.y + share * rect.height())
    }

    /// What the strip says of itself: the drawing and the koma at the play head.
    pub(crate) fn strip_says(&self) -> String {
        let role = egui::accesskit::Role::Canvas;
        let strip = self.harness.get_by_role_and_label(role, "Strip of genga");
        strip.accesskit_node().value().unwrap()
    }

    /// Room of the button on the strip whose name begins so.
    fn button_on_strip(&self, name: &str) -> Option<Rect> {
        let strip = self.strip();
        let begins = |label: Option<String>| label.is_some_and(|label| label.starts_with(name));
        let mut buttons = self.harness.query_all_by_label_contains(name);
        let button = buttons
            .find(|node| begins(node.accesskit_node().label()) && strip.intersects(node.rect()));
        button.map(|node| node.rect())
    }

    fn click_at(&mut self, at: Pos2, button: PointerButton) {
        self.harness.hover_at(at);
        self.harness.run();
        for pressed in [true, false] {
            let modifiers = Modifiers::NONE;
            self.harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        }
        self.harness.run();
    }

    /// Frames of the genga of the sheet at its default, by the keys of the window.
    fn second_genga(&mut self) -> usize {
        self.tap(Modifiers::NONE, Key::Home);
        self.tap(Modifiers::NONE, Key::ArrowDown);
        let says = self.strip_says();
        let koma: usize = says.rsplit(' ').next().unwrap().parse().unwrap();
        koma - 1
    }

    /// All points of what is drawn on the strip.
    fn drawn_on_strip(&self) -> Vec<Pos2> {
        let strip = self.strip();
        let mut points = Vec::new();
        for clipped in &self.harness.output().shapes {
            if let Shape::Path(path) = &clipped.shape {
                points.extend(path.points.iter().filter(|point| strip.contains(**point)));
            }
        }
        points
    }
}

#[test]
fn a_click_on_a_figure_goes_to_its_genga_and_says_which() {
    let mut table = Table::plain_kick();
    let koma = table.second_genga();
    table.tap(Modifiers::NONE, Key::Home);
    assert_eq!(table.strip_says(), "genga 1, koma 1");
    let beside = table.on_strip(koma, 0.5) + vec2(5.0, 0.0);
    table.click_at(beside, PointerButton::Primary);
    assert_eq!(table.strip_says(), format!("genga 2, koma {}", koma + 1));
}

#[test]
fn a_figure_is_dragged_in_one_step() {
    let mut table = Table::plain_kick();
    let koma = table.second_genga();
    let (from, to) = (table.on_strip(koma, 0.5), table.on_strip(koma + 2, 0.5) + vec2(2.0, 0.0));
    table.drag(from, to);
    let moves: Vec<(usize, usize)> =
        table.edits().moves.iter().map(|moved| (moved.from.0, moved.to.0)).collect();
    assert_eq!(moves, [(koma, koma + 2)]);
    table.tap(Modifiers::COMMAND, Key::Z);
    assert!(table.edits().is_empty(), "the whole drag was one step");
}

#[test]
fn a_figure_is_pinned_forbidden_and_let_go_where_it_stands() {
    let mut table = Table::plain_kick();
    let koma = table.second_genga();
    let at = table.on_strip(koma, 0.5);
    let press = |table: &mut Table, name: &str| {
        table.harness.hover_at(at);
        table.harness.run_steps(2);
        let button = table.button_on_strip(name);
        let middle = button.unwrap_or_else(|| panic!("{name} is not on the figure")).center();
        table.click_at(middle, PointerButton::Primary);
    };
    press(&mut table, "Pin");
    assert_eq!(table.edits().pins.len(), 1);
    press(&mut table, "Unpin");
    assert!(table.edits().is_empty());
    press(&mut table, "Forbid");
    assert_eq!(table.edits().forbidden.len(), 1);
}

#[test]
fn a_double_click_takes_one_genga_away() {
    // Narrow, so that the figures stand close.
    let mut table =
        Table::in_window(((500, 400), 1.0), Arc::default(), Language::English, Theme::Light);
    table.open(&sample("kick.bvh"));
    let genga = table.genga();
    let mut under = 0;
    for koma in &genga[1..genga.len() - 1] {
        table.harness.hover_at(table.on_strip(koma - 1, 0.5));
        table.harness.run_steps(2);
        let Some(button) = table.button_on_strip("Forbid") else { continue };
        table.click_at(button.center(), PointerButton::Primary);
        table.click_at(button.center(), PointerButton::Primary);
        assert_eq!(table.edits().forbidden.len(), 1, "koma {koma}");
        table.harness.hover_at(button.center() + vec2(0.0, 1.0));
        table.harness.run_steps(2);
        let other = ["Forbid", "Forbidden koma"].map(|name| table.button_on_strip(name));
        let is_under = |other: &Rect| other.contains(button.center());
        under += usize::from(other.into_iter().flatten().any(|other| is_under(&other)));
        table.tap(Modifiers::COMMAND, Key::Z);
        assert!(table.edits().is_empty());
    }
    assert!(under > 0, "nothing else came under the pointer, so that this shows nothing");
}

#[test]
fn a_cross_on_the_strip_says_where_no_genga_may_stand_and_lifts_the_ban() {
    let mut table = Table::plain_kick();
    let genga = table.genga();
    let koma = table.second_genga();
    table.tap(Modifiers::NONE, Key::K);
    assert_eq!(table.edits().forbidden.len(), 1);
    let name = format!("Forbidden koma {} (", koma + 1);
    let cross = table.button_on_strip(&name).expect("the ban has a cross");
    let way = cross.center().x - table.on_strip(koma, 0.0).x;
    assert!((0.0..12.0).contains(&way), "{way} from the genga that went");
    table.click_at(cross.center(), PointerButton::Primary);
    assert!(table.edits().is_empty());
    assert_eq!(table.button_on_strip("Forbidden koma"), None);
    assert_eq!(table.genga(), genga, "the genga is back");
}

#[test]
fn a_ban_names_the_koma_on_which_its_genga_was_seen() {
    let mut table = Table::plain_kick();
    // Its frame is 71, the koma of which is 72.
    table.go(70);
    assert_eq!(table.strip_says(), "genga 12, koma 70");
    table.tap(Modifiers::NONE, Key::K);
    assert!(table.button_on_strip("Forbidden koma 70 (").is_some());
}

#[test]
fn where_a_foot_comes_down_the_strip_says_so() {
    let mut table = Table::plain_kick();
    let strip = table.strip();
    let words = |table: &Table| {
        let shapes = table.harness.output().shapes.iter();
        let words = shapes.filter_map(|clipped| match &clipped.shape {
            Shape::Text(text) if ["contact", "cont.", "c."].contains(&text.galley.text()) => {
                Some(text.visual_bounding_rect().center())
            }
            _ => None,
        });
        words.filter(|at| strip.contains(*at)).collect::<Vec<Pos2>>()
    };
    let all = words(&table);
    // Feet come down at genga 3, 4, 6, 11 and 12.
    assert_eq!(all.len(), 5);
    for (at, genga) in all.iter().zip([2, 3, 5, 10, 11]) {
        let koma = table.genga()[genga] - 1;
        let own = table.on_strip(koma, 0.0).x;
        assert!((0.0..60.0).contains(&(at.x - own)), "{} after {own}", at.x);
    }
    table.harness.hover_at(all[3]);
    table.harness.run();
    assert!(table.says("The right foot stands still from koma 60"));
    // Beside the genga itself there is room for the whole word.
    let genga = table.genga();
    table.go(genga[10]);
    assert!(table.says("contact of the right foot; "), "genga 11");
    table.go(genga[8]);
    assert!(!table.says("contact of"), "genga 9");
}

#[test]
fn a_pin_says_which_genga_it_replaces_and_keeps_both() {
    let mut table = Table::plain_kick();
    let genga = table.genga();
    table.second_genga();
    let (own, pin) = (genga[1], genga[1] + 1);
    table.tap(Modifiers::NONE, Key::ArrowRight);
    table.harness.get_by_label(&format!("Pin koma {pin}")).click();
    table.harness.run();
    let says = format!("The pin on koma {pin} replaces the genga on koma {own}.");
    table.harness.get_by_label(&says);
    table.write_to_look_at("replaced");
    assert_eq!(table.genga().len(), genga.len());
    table.harness.get_by_label("Keep both").click();
    table.harness.run();
    assert!(table.harness.query_by_label(&says).is_none());
    assert_eq!(table.edits().pins.len(), 2);
    assert_eq!(table.genga()[1..3], [own, pin]);
    for _ in 0..2 {
        table.tap(Modifiers::COMMAND, Key::Z);
    }
    assert!(table.edits().is_empty(), "each was a step");
    assert_eq!(table.genga(), genga);
}

#[test]
fn a_click_at_a_number_of_a_koma_goes_to_that_koma() {
    let mut table = Table::plain_kick();
    for koma in [30, 59] {
        for beside in [-3.0, 3.0] {
            let number = pos2(table.on_strip(koma, 0.0).x + beside, table.strip().min.y + 5.0);
            table.click_at(number, PointerButton::Primary);
            let says = table.strip_says();
            assert!(says.ends_with(&format!("koma {}", koma + 1)), "{says}");
        }
    }
}

#[test]
fn a_genga_without_room_for_its_figure_has_its_buttons_all_the_same() {
    let mut table =
        Table::in_window(((640, 400), 1.0), Arc::default(), Language::English, Theme::Light);
    table.open(&sample("kick.bvh"));
    let genga = table.genga();
    for koma in &genga[1..genga.len() - 1] {
        let circle = pos2(table.on_strip(koma - 1, 0.0).x, table.strip().max.y - CIRCLE);
        table.harness.hover_at(circle);
        table.harness.run_steps(2);
        assert!(table.button_on_strip("Pin").is_some(), "koma {koma}");
    }
}

#[test]
fn a_drawing_is_held_by_its_end() {
    let mut table = Table::plain_kick();
    let held = table
        .harness
        .get_by_role_and_label(egui::accesskit::Role::SpinButton, "Hold")
        .accesskit_node()
        .value();
    let koma: usize = held.unwrap().split(' ').next().unwrap().parse().unwrap();
    let (from, to) = (table.on_strip(koma, 0.95), table.on_strip(koma + 3, 0.95));
    table.drag(from, to);
    let holds: Vec<_> = table.edits().holds.iter().map(|hold| (hold.frame.0, hold.koma)).collect();
    assert_eq!(holds, [(0, koma + 3)]);
}

#[test]
fn the_menu_of_a_figure_has_the_same_acts() {
    let mut table = Table::plain_kick();
    let koma = table.second_genga();
    table.click_at(table.on_strip(koma, 0.5), PointerButton::Secondary);
    let pins: Vec<Rect> =
        table.harness.query_all_by_label("Forbid").map(|node| node.rect()).collect();
    assert!(pins.len() >= 2, "in the menu and in the panel: {pins:?}");
    table.tap(Modifiers::NONE, Key::Escape);
}

#[test]
fn under_the_pointer_a_figure_plays_to_the_next_genga_and_the_play_head_stays() {
    let mut table = Table::plain_kick();
    let koma = table.second_genga();
    table.tap(Modifiers::NONE, Key::Home);
    table.harness.hover_at(table.on_strip(koma, 0.5));
    table.harness.step();
    table.harness.step();
    let still = table.drawn_on_strip();
    // A step of the harness is a quarter of a second, and the figure stands still for 0.8 s first.
    table.harness.run_steps(3);
    assert_ne!(table.drawn_on_strip(), still);
    assert_eq!(table.strip_says(), "genga 1, koma 1");
    table.harness.remove_cursor();
    table.harness.run();
    let rest = table.drawn_on_strip();
    table.harness.run_steps(2);
    assert_eq!(table.drawn_on_strip(), rest);
}

#[test]
fn the_strip_goes_to_an_action_and_back_to_the_whole() {
    let mut table = Table::plain_kick();
    table.turn("actions.split", "true");
    let whole = table.drawn_on_strip();
    let strip = table.strip();
    let zoom = egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 300.0),
        modifiers: Modifiers::NONE,
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
    };
    table.harness.hover_at(strip.center());
    table.harness.event(zoom);
    table.harness.remove_cursor();
    table.harness.run_steps(8);
    let near = table.drawn_on_strip();
    assert_ne!(near, whole, "the wheel comes nearer");
    table.tap(Modifiers::NONE, Key::Z);
    assert_eq!(table.drawn_on_strip(), whole, "and a key shows all of it");
    table.tap(Modifiers::NONE, Key::Z);
    table.tap(Modifiers::NONE, Key::Z);
    assert_eq!(table.drawn_on_strip(), whole);
}

#[test]
fn a_change_out_of_view_is_brought_into_view() {
    let mut table = Table::plain_kick();
    let strip = table.strip();
    let zoom = egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 500.0),
        modifiers: Modifiers::NONE,
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
    };
    table.harness.hover_at(strip.right_center() - vec2(30.0, 0.0));
    table.harness.event(zoom);
    table.harness.run_steps(8);
    table.harness.remove_cursor();
    table.harness.run();
    let end = table.drawn_on_strip();
    // A change at the beginning, made from elsewhere than the keyboard's play head.
    table.harness.state_mut().turn("keys.min_price", "7.5").unwrap();
    table.harness.run();
    assert_eq!(table.drawn_on_strip(), end, "no change moves nothing");
    let role = egui::accesskit::Role::SpinButton;
    let held = table.harness.get_by_role_and_label(role, "Hold").rect().center();
    table.drag(held, held + vec2(60.0, 0.0));
    assert!(!table.edits().holds.is_empty());
    assert_ne!(table.drawn_on_strip(), end, "the first change is in view");
}
