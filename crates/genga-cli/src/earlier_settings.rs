//! The settings that stay from an earlier run in the same folder (前の設定).

use std::path::Path;

use super::failure::Failure;
use super::files;
use super::shell::quoted;
use genga::error::Error;
use genga::recipe::Recipe;

/// Settings of an earlier run that differ from the default ones.
#[derive(Debug, Clone, Default)]
pub(super) struct EarlierSettings {
    /// The recipe that has them; empty without an earlier run.
    from: String,
    settings: Vec<(String, String)>,
    /// Those that an earlier target found and that another is to find anew.
    found: Vec<(String, String)>,
    /// Whether corrections of that recipe stay too.
    has_corrections: bool,
}

impl EarlierSettings {
    /// Takes the settings of a recipe that `now` has too. Those that are not in `start`, the recipe with which a target
    /// begins, are the ones that an earlier target found.
    pub(super) fn new(from: &Path, earlier: &Recipe, start: &Recipe, now: &Recipe) -> Self {
        let [usual, start, now] = [&Recipe::default(), start, now].map(Recipe::settings);
        let settings = earlier.settings().into_iter().filter(|own| !usual.contains(own));
        let (settings, found): (Vec<_>, Vec<_>) = settings.partition(|own| start.contains(own));
        let settings = settings.into_iter().filter(|own| now.contains(own)).collect();
        Self { from: from.display().to_string(), settings, found, has_corrections: false }
    }

    /// Says which settings stay and which do not, as options for a shell; without those for which a target found
    /// others.
    pub(super) fn notes(&self, now: &Recipe) -> Vec<String> {
        let (from, now) = (&self.from, now.settings());
        let stay = self.settings.iter().filter(|own| now.contains(own));
        let gone = self.found.iter().filter(|own| !now.contains(own));
        let said = [
            (options(stay), format!("settings as in {from} (--fresh goes without)")),
            (
                options(gone),
                format!(
                    "not as in {from}, where an earlier target found them (targets hold together in one run)"
                ),
            ),
        ];
        let said = said.into_iter().filter(|(options, _)| !options.is_empty());
        said.map(|(options, what)| format!("{what}: {options}")).collect()
    }

    /// Notes that corrections stay too.
    pub(super) fn keep_corrections(&mut self, from: &Path) {
        (self.from, self.has_corrections) = (from.display().to_string(), true);
    }

    /// Adds to the error of a setting or a correction where others come from that nobody gave now, or the clip's path to
    /// another.
    pub(super) fn fault_among(&self, error: Error, clip: &Path) -> Failure {
        let stay = match &error {
            Error::Setting { .. } if !self.settings.is_empty() => "settings",
            Error::Edits { .. } if self.has_corrections => "corrections",
            _ => return files::fault_of(clip)(error),
        };
        Failure::AskedWrongly(format!(
            "{error}; {stay} stay from {}, and --fresh goes without them",
            self.from
        ))
    }
}

/// Writes settings as options for a shell.
fn options<'a>(settings: impl Iterator<Item = &'a (String, String)>) -> String {
    let options =
        settings.map(|(name, word)| format!("--set {}", quoted(&format!("{name}={word}"))));
    options.collect::<Vec<_>>().join(" ")
}
