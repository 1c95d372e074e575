//! `genga studio`: the window.

#[cfg(feature = "studio")]
mod dialog;
#[cfg(feature = "studio-files")]
mod disk;
#[cfg(feature = "studio-files")]
mod pictures;
#[cfg(feature = "studio-files")]
mod sound;
#[cfg(feature = "studio-files")]
#[cfg_attr(not(feature = "studio"), allow(dead_code, reason = "this build has no window"))]
mod start;

use std::path::PathBuf;

use clap::Args;

use crate::clip::Part;
use crate::failure::Failure;

#[cfg(feature = "studio-files")]
pub use disk::Disk;

#[derive(Debug, Args)]
#[cfg_attr(not(feature = "studio"), allow(dead_code, reason = "this build has no studio"))]
pub(super) struct StudioArgs {
    /// Motion file, or a folder of takes. Without one, the window waits for a dropped file.
    #[arg(value_name = "CLIP|FOLDER")]
    clip: Option<PathBuf>,
    #[command(flatten)]
    part: Part,
    /// Recipe with corrections [default: CLIP.genga.toml beside the clip, where the studio saves].
    #[arg(long, value_name = "R.toml", requires = "clip")]
    recipe: Option<PathBuf>,
}

#[cfg(not(feature = "studio"))]
pub(super) fn run(_: StudioArgs) -> Result<(), Failure> {
    let message = "this genga was built without its window. A release has the studio as a page for browsers; from the \
                   sources, cargo install --path crates/genga-cli --features studio --locked builds the window";
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

    use super::{Disk, Failure, StudioArgs, start};
    use crate::paths;
    use genga_studio::{Host, Language, Studio};

    /// The window and its last title.
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

    /// Name of the note that stores the window's size.
    const WINDOW: &str = "window";
    /// Initial and smallest size of the window.
    const USUAL: Vec2 = Vec2::new(1440.0, 900.0);
    const LEAST: Vec2 = Vec2::new(640.0, 420.0);

    fn written(size: Vec2) -> String {
        format!("{} {}\n", size.x.round(), size.y.round())
    }

    /// Parses the stored window size. An invalid text gives the default size.
    fn size_of(text: &str) -> Vec2 {
        let mut sides = text.split_whitespace().map(|side| side.parse().ok());
        let size = sides.next().flatten().zip(sides.next().flatten());
        let size = size.map(|(wide, high)| Vec2::new(wide, high));
        size.filter(|size| size.is_finite()).map_or(USUAL, |size| size.max(LEAST))
    }

    pub(in crate::commands) fn run(args: StudioArgs) -> Result<(), Failure> {
        let StudioArgs { clip, part, recipe } = args;
        if clip.as_deref().is_some_and(paths::is_stream) {
            let message = "the studio saves beside its clip: give a file, not stdin";
            return Err(Failure::AskedWrongly(message.into()));
        }
        for path in clip.iter().chain(&recipe) {
            there_is(path)?;
        }
        if let Some(clip) = &clip {
            start::check(clip, recipe.as_deref())?;
        }
        let desk = Arc::new(Disk::with_recent(clip.clone(), part));
        let size = size_of(&desk.noted(WINDOW).unwrap_or_default());
        let mut studio = Studio::new(Arc::clone(&desk) as _, language());
        if let Some(clip) = &clip {
            start::open(&mut studio, clip, recipe.as_deref());
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

    /// Explains why there is no window, and what to do instead.
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

    /// Reports a missing file at once, before a window opens.
    fn there_is(path: &Path) -> Result<(), Failure> {
        match path.try_exists() {
            Ok(true) => Ok(()),
            Ok(false) => Err(Failure::io(path, std::io::ErrorKind::NotFound.into())),
            Err(error) => Err(Failure::io(path, error)),
        }
    }

    /// Japanese if the system's locale is.
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
