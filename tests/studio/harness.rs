//! A studio with a clip on the table, driven by tests.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, Rect, Theme};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use genga::edits::Edits;
use genga::recipe::Recipe;
use genga_studio::{Host, Language, Studio};

use crate::desk::Memory;
use crate::software_renderer::Soft;

/// Size of the window in points.
pub(crate) const SIZE: (usize, usize) = (1440, 900);

/// Path of a sample.
pub(crate) fn sample(name: &str) -> PathBuf {
    crate::real::repository().join("data").join(name)
}

/// A studio in an invisible window.
pub(crate) struct Table {
    pub(crate) harness: Harness<'static, Studio>,
    pub(crate) desk: Arc<Memory>,
    pub(crate) soft: Soft,
}

/// Draws into the whole window, as the shell does. The harness would leave a margin.
fn whole_window(ui: &mut egui::Ui, studio: &mut Studio) {
    let window = ui.ctx().content_rect();
    let builder = egui::UiBuilder::new().max_rect(window);
    ui.scope_builder(builder, |ui| {
        ui.set_clip_rect(window);
        studio.ui(ui);
    });
}

impl Table {
    /// A studio with a kick on the table.
    pub(crate) fn with_kick() -> Self {
        Self::with(&sample("kick.bvh"), Arc::default(), Language::English, Theme::Light)
    }

    /// A studio with a kick on the table, as it opens.
    pub(crate) fn plain_kick() -> Self {
        Self::plain(&sample("kick.bvh"), Arc::default(), Language::English, Theme::Light)
    }

    /// A studio with a clip on the table, with expert settings and curves.
    pub(crate) fn with(clip: &Path, desk: Arc<Memory>, language: Language, theme: Theme) -> Self {
        let mut table = Self::plain(clip, desk, language, theme);
        for panel in [Key::Num7, Key::Num8] {
            table.tap(Modifiers::NONE, panel);
        }
        table
    }

    /// A studio with a clip on the table, as it opens.
    pub(crate) fn plain(clip: &Path, desk: Arc<Memory>, language: Language, theme: Theme) -> Self {
        let mut table = Self::empty(desk, language, theme);
        table.open(clip);
        table
    }

    /// Sets a knob.
    pub(crate) fn turn(&mut self, knob: &str, value: &str) {
        self.harness.state_mut().turn(knob, value).unwrap();
        self.harness.run();
    }

    /// A studio with an empty table.
    pub(crate) fn empty(desk: Arc<Memory>, language: Language, theme: Theme) -> Self {
        Self::in_window((SIZE, 1.0), desk, language, theme)
    }

    /// A studio with an empty table, in a window of `size` points with `scale` pixels per point.
    pub(crate) fn in_window(
        (size, scale): ((usize, usize), f32),
        desk: Arc<Memory>,
        language: Language,
        theme: Theme,
    ) -> Self {
        let outside: Arc<dyn Host> = Arc::clone(&desk) as _;
        let studio = Studio::new(outside, language);
        let soft = Soft::default();
        let builder = Harness::builder().with_size([size.0 as f32, size.1 as f32]);
        let builder = builder.with_pixels_per_point(scale);
        let builder = builder.with_theme(theme).with_max_steps(12).renderer(soft.clone());
        let builder = match language {
            Language::Japanese => builder.with_context_setup(crate::pictures::with_japanese),
            Language::English => builder,
        };
        let harness = builder.build_ui_state(whole_window, studio);
        Self { harness, desk, soft }
    }

    /// Waits until the clip has been read.
    pub(crate) fn wait(&mut self) {
        for _ in 0..4000 {
            self.harness.step();
            if !self.harness.state().is_opening() {
                self.harness.run();
                return;
            }
            thread::sleep(Duration::from_millis(5));
        }
        panic!("the clip was not read");
    }

    /// Opens a clip.
    pub(crate) fn open(&mut self, clip: &Path) {
        self.harness.state_mut().open(clip, None);
        self.wait();
    }

    /// Waits until no export or map is in progress.
    pub(crate) fn rest(&mut self) {
        for _ in 0..4000 {
            self.harness.step();
            let studio = self.harness.state();
            if !studio.is_exporting() && !studio.is_mapping() {
                self.harness.run();
                return;
            }
            thread::sleep(Duration::from_millis(5));
        }
        panic!("what was begun did not end");
    }

    pub(crate) fn recipe(&self) -> &Recipe {
        &self.harness.state().document().unwrap().recipe
    }

    pub(crate) fn edits(&self) -> &Edits {
        &self.harness.state().document().unwrap().edits
    }

    pub(crate) fn tap(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.harness.run();
    }

    /// Goes to a koma, counted from 1, by the keyboard.
    pub(crate) fn go(&mut self, koma: usize) {
        self.tap(Modifiers::NONE, Key::Home);
        (1..koma).for_each(|_| self.harness.key_press(Key::ArrowRight));
        self.harness.run();
    }

    pub(crate) fn canvas(&self, name: &str) -> Rect {
        self.harness.get_by_role_and_label(Role::Canvas, name).rect()
    }

    pub(crate) fn drag(&mut self, from: Pos2, to: Pos2) {
        self.harness.hover_at(from);
        self.harness.drag_at(from);
        self.harness.run();
        for step in 1..=6 {
            self.harness.hover_at(from + (to - from) * (step as f32 / 6.0));
            self.harness.run();
        }
        self.harness.drop_at(to);
        self.harness.run();
    }
}
