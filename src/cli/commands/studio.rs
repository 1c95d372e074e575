//! `genga studio`: the window.

#[cfg(feature = "studio")]
mod dialog;
#[cfg(feature = "studio-files")]
mod disk;
#[cfg(feature = "studio-files")]
mod pictures;
#[cfg(feature = "studio-files")]
mod sound;

use std::path::PathBuf;

use clap::Args;

use crate::cli::clip::Part;
use crate::cli::failure::Failure;

#[cfg(feature = "studio-files")]
pub use disk::Disk;

#[derive(Debug, Args)]
#[cfg_attr(not(feature = "studio"), allow(dead_code, reason = "this build has no studio"))]
pub(super) struct StudioArgs {
    /// The motion; without one the window waits for a file to be dropped on it.
    #[arg(value_name = "CLIP")]
    clip: Option<PathBuf>,
    #[command(flatten)]
    part: Part,
    /// A recipe with its corrections [default: CLIP.genga.toml beside the clip, where a save of the studio
    /// goes].
    #[arg(long, value_name = "R.toml", requires = "clip")]
    recipe: Option<PathBuf>,
}

#[cfg(not(feature = "studio"))]
pub(super) fn run(_: StudioArgs) -> Result<(), Failure> {
    let message = "this genga was built without its window; \
                   cargo install --path . --features studio --locked builds it with one";
    Err(Failure::CouldNot(message.into()))
}

#[cfg(feature = "studio")]
pub(super) use shell::run;

#[cfg(feature = "studio")]
mod shell {
    use std::env;
    use std::path::Path;
    use std::sync::Arc;

    use eframe::egui::{Ui, Vec2, ViewportBuilder, ViewportCommand};

    use super::{Disk, Failure, StudioArgs};
    use crate::cli::paths;
    use crate::studio::{Desk, Language, Studio};

    /// The window and what it was last called.
    struct Shell {
        studio: Studio,
        title: String,
        desk: Arc<Disk>,
        size: Vec2,
    }

    impl eframe::App for Shell {
        fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
            self.studio.ui(ui);
            self.size = ui.ctx().content_rect().size();
            let title = self.studio.title();
            if title != self.title {
                ui.ctx().send_viewport_cmd(ViewportCommand::Title(title.clone()));
                self.title = title;
            }
        }

        fn on_exit(&mut self) {
            self.desk.note(WINDOW, &written(self.size));
        }
    }

    /// Under what name the size of the window is noted.
    const WINDOW: &str = "window";
    /// The size that it has at first, and the least.
    const USUAL: Vec2 = Vec2::new(1440.0, 900.0);
    const LEAST: Vec2 = Vec2::new(640.0, 420.0);

    fn written(size: Vec2) -> String {
        format!("{} {}\n", size.x.round(), size.y.round())
    }

    /// The size that was noted; the usual one where that is none.
    fn size_of(text: &str) -> Vec2 {
        let mut sides = text.split_whitespace().map(|side| side.parse().ok());
        let size = sides.next().flatten().zip(sides.next().flatten());
        let size = size.map(|(wide, high)| Vec2::new(wide, high));
        size.filter(|size| size.is_finite()).map_or(USUAL, |size| size.max(LEAST))
    }

    pub(in crate::cli::commands) fn run(args: StudioArgs) -> Result<(), Failure> {
        let StudioArgs { clip, part, recipe } = args;
        if clip.as_deref().is_some_and(paths::is_stream) {
            let message = "the studio saves beside its clip: give a file, not stdin";
            return Err(Failure::AskedWrongly(message.into()));
        }
        for path in clip.iter().chain(&recipe) {
            there_is(path)?;
        }
        let desk = Arc::new(Disk::with(clip.clone(), part));
        let size = size_of(&desk.noted(WINDOW).unwrap_or_default());
        let mut studio = Studio::new(Arc::clone(&desk) as _, language());
        if let Some(clip) = &clip {
            studio.open(clip, recipe.as_deref());
        }
        let viewport = ViewportBuilder::default()
            .with_app_id("genga")
            .with_inner_size(size)
            .with_min_inner_size(LEAST);
        let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
        let shell = Shell { studio, title: String::new(), desk, size };
        let window = eframe::run_native("genga", options, Box::new(|_| Ok(Box::new(shell))));
        window.map_err(|error| Failure::CouldNot(no_window(&error)))
    }

    /// Why there is no window, and the way on.
    fn no_window(error: &eframe::Error) -> String {
        let why = match error {
            eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => {
                "there is no screen to open it on".to_owned()
            }
            eframe::Error::Wgpu(_) => {
                "no graphics driver, neither Vulkan nor OpenGL, can draw it".to_owned()
            }
            other => other.to_string(),
        };
        format!(
            "the window could not be opened: {why}; genga run with --set and --pin does the same work without one"
        )
    }

    /// Says of a slip of the hand at once, and not in a window.
    fn there_is(path: &Path) -> Result<(), Failure> {
        match path.try_exists() {
            Ok(true) => Ok(()),
            Ok(false) => {
                Err(Failure::CouldNot(format!("{}: there is no such file", path.display())))
            }
            Err(error) => Err(Failure::at(path, error)),
        }
    }

    /// Japanese where the system speaks it.
    fn language() -> Language {
        let of = |name| env::var(name).ok().filter(|value| !value.is_empty());
        let locale = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().find_map(of);
        match locale.is_some_and(|locale| locale.starts_with("ja")) {
            true => Language::Japanese,
            false => Language::English,
        }
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn the_size_of_the_window_is_read_back_and_never_too_small() {
            let size = Vec2::new(1280.0, 1024.0);
            assert_eq!(size_of(&written(size)), size);
            assert_eq!(size_of("10 2000"), Vec2::new(640.0, 2000.0));
            for text in ["", "wide", "1200", "NaN 800"] {
                assert_eq!(size_of(text), USUAL, "{text}");
            }
        }
    }
}
