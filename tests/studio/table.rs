//! A studio with a clip on the table.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use egui::Theme;
use egui_kittest::Harness;
use genga::edits::Edits;
use genga::recipe::Recipe;
use genga::studio::{Desk, Language, Studio};

use crate::desk::Memory;
use crate::soft::Soft;

/// The size of the window.
pub(crate) const SIZE: (usize, usize) = (1440, 900);

/// A sample.
pub(crate) fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)
}

/// A studio in a window that nobody sees.
pub(crate) struct Table {
    pub(crate) harness: Harness<'static, Studio>,
    pub(crate) desk: Arc<Memory>,
    pub(crate) soft: Soft,
}

/// Draws into all of the window, as the shell does: the harness leaves a margin.
fn whole_window(ui: &mut egui::Ui, studio: &mut Studio) {
    let window = ui.ctx().content_rect();
    let builder = egui::UiBuilder::new().max_rect(window);
    ui.scope_builder(builder, |ui| {
        ui.set_clip_rect(window);
        studio.ui(ui);
    });
}

impl Table {
    /// With a kick on it.
    pub(crate) fn with_kick() -> Self {
        Self::with(&sample("kick.bvh"), Arc::default(), Language::English, Theme::Light)
    }

    /// With a clip on it.
    pub(crate) fn with(clip: &Path, desk: Arc<Memory>, language: Language, theme: Theme) -> Self {
        let mut table = Self::empty(desk, language, theme);
        table.harness.state_mut().open(clip, None);
        table.wait();
        table
    }

    /// With nothing on it.
    pub(crate) fn empty(desk: Arc<Memory>, language: Language, theme: Theme) -> Self {
        let outside: Arc<dyn Desk> = Arc::clone(&desk) as _;
        let studio = Studio::new(outside, language);
        let soft = Soft::default();
        let builder = Harness::builder().with_size([SIZE.0 as f32, SIZE.1 as f32]);
        let builder = builder.with_theme(theme).with_max_steps(12).renderer(soft.clone());
        let builder = match language {
            Language::Japanese => builder.with_context_setup(crate::pictures::with_japanese),
            Language::English => builder,
        };
        let harness = builder.build_ui_state(whole_window, studio);
        Self { harness, desk, soft }
    }

    /// Until what is being read has been read.
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

    /// Until nothing is done in the background.
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
}
