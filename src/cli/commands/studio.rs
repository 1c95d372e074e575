//! `genga studio`: the window.

#[cfg(feature = "studio")]
mod dialog;
#[cfg(feature = "studio")]
mod disk;

use std::path::PathBuf;

use clap::Args;

use crate::cli::clip::Part;
use crate::cli::failure::Failure;

#[cfg(feature = "studio")]
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

    use eframe::egui::{Ui, ViewportBuilder, ViewportCommand};

    use super::{Disk, Failure, StudioArgs};
    use crate::cli::paths;
    use crate::studio::{Language, Studio};

    /// The window and what it was last called.
    struct Shell {
        studio: Studio,
        title: String,
    }

    impl eframe::App for Shell {
        fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
            self.studio.ui(ui);
            let title = self.studio.title();
            if title != self.title {
                ui.ctx().send_viewport_cmd(ViewportCommand::Title(title.clone()));
                self.title = title;
            }
        }
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
        let desk = Disk::with(clip.clone(), part);
        let mut studio = Studio::new(Arc::new(desk), language());
        if let Some(clip) = &clip {
            studio.open(clip, recipe.as_deref());
        }
        let viewport = ViewportBuilder::default()
            .with_app_id("genga")
            .with_inner_size([1440.0, 900.0])
            .with_min_inner_size([900.0, 600.0]);
        let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
        let shell = Shell { studio, title: String::new() };
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
}
