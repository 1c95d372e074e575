//! The settings of formats (形式の設定): the camera of all figures, and single ones.

use std::path::Path;

use clap::Args;

use super::corrections::assignment;
use super::failure::Failure;
use super::files;
use super::headings::FILES;
use super::shell::quoted;
use genga::error::Error;
use genga::knob::Knob;
use genga_files::{MmdModel, Settings, Vmd};
use genga_plot::Camera;

/// The last part of the names of settings that `--camera` sets.
const CAMERA: &str = ".camera";

/// Arguments of every command that writes pictures or films.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct LookArgs {
    /// Camera of the figures: front, side, three-quarter, auto.
    ///
    /// auto sees most of the movement.
    #[arg(long, value_name = "CAMERA", help_heading = FILES)]
    camera: Option<Camera>,
    /// One setting of a format: --with csv.bom=true (repeatable).
    #[arg(long, value_name = "FORMAT.KEY=VALUE", value_parser = assignment, help_heading = FILES)]
    with: Vec<(String, String)>,
}

impl LookArgs {
    /// Makes the settings of all formats.
    pub(super) fn settings(&self) -> Result<Settings, Failure> {
        let mut settings = Settings::default();
        if let Some(camera) = self.camera {
            settings.look_from(camera);
        }
        for (name, value) in &self.with {
            if Knob::find(name).is_ok() {
                return Err(Failure::AskedWrongly(format!(
                    "--with: {name} is a setting of the recipe: --set {name}={value}"
                )));
            }
            if name == "vmd.model" && !Vmd::is_file(value) && Path::new(value).exists() {
                let message = format!("{value} is no model (.pmx, .pmd), nor the name of one");
                return Err(Error::setting(name, message).into());
            }
            if name == "vmd.model" && Vmd::is_file(value) {
                settings.vmd.play(model(Path::new(value))?);
            } else {
                settings
                    .set(name, value)
                    .map_err(|error| Failure::AskedWrongly(format!("--with: {error}")))?;
            }
        }
        Ok(settings)
    }

    /// Whether a setting is given.
    pub(super) fn gives(&self, name: &str) -> bool {
        self.with.iter().any(|(given, _)| given == name)
            || (name.ends_with(CAMERA) && self.camera.is_some())
    }
}

/// Reads an MMD model from a file.
fn model(path: &Path) -> Result<MmdModel, Failure> {
    MmdModel::read(&files::read(path)?).map_err(files::fault_of(path))
}

/// Writes settings of formats as options.
pub(super) fn options(settings: &[(&String, &String)]) -> String {
    let of_all = settings.iter().find(|(name, _)| *name == "figures.camera").map(|(_, of)| *of);
    let is_of_all = |name: &str, value: &String| name.ends_with(CAMERA) && of_all == Some(value);
    let own = settings.iter().filter(|(name, value)| !is_of_all(name, value));
    let own = own.map(|(name, value)| format!("--with {}", quoted(&format!("{name}={value}"))));
    let camera = of_all.map(|camera| format!("--camera {camera}"));
    camera.into_iter().chain(own).collect::<Vec<_>>().join(" ")
}
