//! The recipe of a command and a person's corrections.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};

use super::camera_args::SeenArgs;
use super::cut_args::CutArgs;
use super::failure::Failure;
use super::headings::{CORRECTIONS, SHEET};
use super::{camera_args, files, paths};
use genga::edits::{Edits, Forbidden, Hold, Move, Pin, Speech, layer_of};
use genga::error::Error;
use genga::recipe::Recipe;
use genga::time::Frame;
use genga_files::Run;

/// The recipe: a file, then single settings on top.
#[derive(Debug, Clone, Args)]
pub(super) struct Settings {
    /// Recipe file, or a results folder with one; see `genga recipe`.
    #[arg(long, value_name = "R.toml", value_parser = PathBufValueParser::new().map(recipe_in))]
    pub(super) recipe: Option<PathBuf>,
    /// One setting, over the recipe: --set spacing.on=3 (repeatable).
    ///
    /// B/spacing.on=3 sets it in layer B alone.
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment)]
    pub(super) set: Vec<(String, String)>,
}

/// The recipe that a path means: of a results folder it is the one in it.
fn recipe_in(path: PathBuf) -> PathBuf {
    if path.is_dir() { path.join(Run::RECIPE) } else { path }
}

/// The recipe, and a person's corrections.
#[derive(Debug, Clone, Args)]
pub(super) struct Corrections {
    #[command(flatten)]
    pub(super) settings: Settings,
    #[command(flatten)]
    layers: LayerArgs,
    #[command(flatten)]
    pub(super) seen: SeenArgs,
    #[command(flatten)]
    cut: CutArgs,
    /// Pin frames as keys: --pin 12,150:wrist-top,180@0.5
    ///
    /// Each is [LAYER/]FRAME[:NAME][@WEIGHT], with a name and a spacing weight: 200:hit@0. B/150 pins only in layer B;
    /// --forbid and --move accept a layer too.
    #[arg(long, value_name = "FRAME,…", allow_negative_numbers = true, value_delimiter = ',', help_heading = CORRECTIONS)]
    pin: Vec<String>,
    /// No keys near these frames: --forbid 12,120..140
    ///
    /// Near is within two koma. A range excludes its last frame.
    #[arg(long, value_name = "FRAME,…", allow_negative_numbers = true, value_delimiter = ',', help_heading = CORRECTIONS)]
    forbid: Vec<String>,
    /// Draw the key near FROM at TO: --move 41:42,80:84
    ///
    /// A name and a spacing weight may follow, as in --pin: 80:84:hit@0.2
    #[arg(long = "move", value_name = "FROM:TO,…", allow_negative_numbers = true, value_delimiter = ',', help_heading = CORRECTIONS)]
    moves: Vec<String>,
    /// How many koma drawings stay: --hold 42:4,60:1
    ///
    /// Each drawing is given by the source frame that it shows, in all layers.
    #[arg(long = "hold", value_name = "FRAME:KOMA,…", allow_negative_numbers = true, value_delimiter = ',', help_heading = CORRECTIONS)]
    holds: Vec<String>,
    /// Frames at which actions begin: --split 310,774
    ///
    /// They replace the detected ones, which genga split lists.
    #[arg(long, value_name = "FRAME,…", allow_negative_numbers = true, value_delimiter = ',', value_parser = frame, help_heading = CORRECTIONS)]
    split: Vec<Frame>,
    /// Add a spoken line: --say "120..210:アキ:えい！" (repeatable).
    ///
    /// A..B:[SPEAKER:]WORDS, in the S column, over source frames A up to but not including B.
    #[arg(long, value_name = "A..B:WORDS", help_heading = CORRECTIONS)]
    say: Vec<String>,
    /// Choose all keys anew around the corrections.
    ///
    /// Otherwise only the neighbours of pins and forbidden frames change. =false overrides the recipe.
    #[arg(long, help_heading = CORRECTIONS, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    again: Option<bool>,
    /// Keep the genga of an earlier run: its folder or sheet.json.
    ///
    /// Also of a sheet that you edited, and whatever the settings. Pins, moves and forbidden frames then change only
    /// their own neighbourhood.
    #[arg(long, value_name = "SHEET.json", conflicts_with = "again", help_heading = CORRECTIONS)]
    pub(super) freeze: Option<PathBuf>,
    /// Pin the keys marked in a table, a sheet or a timesheet.
    ///
    /// The genga of an edited keys.csv, drawings.csv, sheet.csv or sheet.json of this clip, or the numbers on an XDTS
    /// timesheet (only the circled ones, if there are any). Those that are genga anyway get no pin.
    #[arg(long, value_name = "FILE", help_heading = CORRECTIONS)]
    pub(super) pin_from: Option<PathBuf>,
    /// Only pinned and moved keys, and the clip's ends.
    ///
    /// =false overrides the recipe.
    #[arg(long, help_heading = CORRECTIONS, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    pub(super) only_pins: Option<bool>,
    /// Column of the --pin-from file [default: the only one, or A].
    #[arg(long, value_name = "NAME", requires = "pin_from", help_heading = CORRECTIONS)]
    pub(super) pin_column: Option<String>,
}

/// The cels and passages of the sheet, over the recipe.
#[derive(Debug, Clone, Args)]
pub(super) struct LayerArgs {
    /// Layers (セル) with their own keys: body, limbs, joints, FILE.
    ///
    /// body (one), limbs (trunk with head A, arms B and C, legs D and E), joints (one per moving joint), or a TOML file
    /// of [[layers]] with name, joints and settings.
    #[arg(long, value_name = "LAYERS", help_heading = SHEET)]
    layers: Option<String>,
    /// The body travels with its drawings (drawings), or on ones.
    ///
    /// On ones it moves on every koma as in the source, so held drawings slide (移動を1コマで).
    #[arg(long, value_name = "HOW", help_heading = SHEET)]
    root_on: Option<String>,
    /// A round that repeats (リピート): the last pose is the first.
    ///
    /// After the last drawing the first comes again, and the body travels on. genga split --cycles lists the best rounds
    /// of a take. =false overrides the recipe.
    #[arg(long = "loop", help_heading = SHEET, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    repeat: Option<bool>,
    /// Rounds of the loop on the sheet: --loop --cycles 4.
    #[arg(long, value_name = "N", help_heading = SHEET)]
    cycles: Option<String>,
    /// A setting in a passage: --within 120..240:spacing.on=1 (repeatable).
    ///
    /// [LAYER/]A..B[:KEY=VALUE], over source frames A up to but not including B. The later goes over the earlier.
    #[arg(long, value_name = "A..B:KEY=VALUE", help_heading = SHEET)]
    within: Vec<String>,
    /// Outside of passages: timed drawings (timed), or the take (source).
    #[arg(long, value_name = "WHAT", help_heading = SHEET)]
    outside: Option<String>,
}

pub(super) fn frame(text: &str) -> Result<Frame, String> {
    text.trim().parse().map(Frame).map_err(|_| "expected a source frame, as in 310".into())
}

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("expected KEY=VALUE, as in spacing.on=3")?;
    Ok((name.trim().into(), value.trim().into()))
}

impl Settings {
    /// Reads the recipe and corrections asked for, on top of `default`.
    pub(super) fn read(&self, default: Recipe) -> Result<(Recipe, Edits), Failure> {
        let (mut recipe, edits) = match &self.recipe {
            None => (default, Edits::default()),
            Some(path) if paths::is_motion(path) => {
                return Err(Failure::AskedWrongly(format!(
                    "{}: is a motion and no recipe, which is TOML as `genga recipe` prints it",
                    path.display()
                )));
            }
            Some(path) => {
                let text = String::from_utf8(files::read(path)?).map_err(|_| {
                    Failure::AskedWrongly(format!("{}: is not text", path.display()))
                })?;
                default.overlaid(&text).map_err(files::fault_of(path))?
            }
        };
        for (name, value) in &self.set {
            recipe.set(name, value).map_err(|error| of_a_format(name, value, error))?;
        }
        Ok((recipe, edits))
    }

    /// Names of the settings that the recipe changes, without those of `--set`.
    pub(super) fn changed(&self, read: &Recipe) -> Vec<String> {
        let usual = Recipe::default().settings();
        let is_here = |name: &str| self.set.iter().any(|(own, _)| own == name);
        let own = read.settings().into_iter().filter(|setting| !usual.contains(setting));
        own.map(|(name, _)| name).filter(|name| !is_here(name)).collect()
    }

    /// Sets those settings that are of one layer.
    fn set_layers(&self, recipe: &mut Recipe) -> Result<(), Failure> {
        let mut of_layers = self.set.iter().filter(|(name, _)| name.contains('/'));
        of_layers.try_for_each(|(name, value)| Ok(recipe.set(name, value)?))
    }
}

/// Names the right option for a setting of a format; for any other unknown setting keeps the error.
fn of_a_format(name: &str, value: &str, error: Error) -> Failure {
    match genga_files::Settings::default().names().iter().any(|own| own == name) {
        true => Failure::AskedWrongly(format!(
            "--set: {name} is a setting of the files that are written: --with {name}={value}"
        )),
        false => error.into(),
    }
}

impl Corrections {
    /// The files that are read for them, which no output may replace; without that of `--freeze`, which may be in a folder.
    pub(super) fn sources(&self) -> [(&'static str, Option<&Path>); 4] {
        let layers = self.layers.layers.as_deref().map(Path::new);
        [
            ("recipe", self.settings.recipe.as_deref()),
            ("file of layers", layers.filter(|file| file.is_file())),
            ("camera", camera_args::file(&self.seen)),
            ("file with your keys", self.pin_from.as_deref()),
        ]
    }

    /// Options of the command line that are of the frames of one clip, with their values as they were given.
    pub(super) fn of_frames(&self) -> Vec<(&'static str, String)> {
        let file =
            |path: &Option<PathBuf>| path.iter().map(|path| path.display().to_string()).collect();
        let splits: Vec<String> = self.split.iter().map(ToString::to_string).collect();
        let options = [
            ("pin", self.pin.join(",")),
            ("forbid", self.forbid.join(",")),
            ("move", self.moves.join(",")),
            ("hold", self.holds.join(",")),
            ("split", splits.join(",")),
            ("say", self.say.join(" --say ")),
            ("freeze", file(&self.freeze)),
            ("pin-from", file(&self.pin_from)),
        ];
        options.into_iter().filter(|(_, given)| !given.is_empty()).collect()
    }

    /// Puts those of the command line on top of a recipe and its corrections.
    pub(super) fn put_over(
        &self,
        (mut recipe, mut edits): (Recipe, Edits),
    ) -> Result<(Recipe, Edits), Failure> {
        self.layers.put(&mut recipe)?;
        // A file of layers may have settings of its own, and those of the command line go over them.
        self.settings.set_layers(&mut recipe)?;
        self.layers.put_passages(&mut recipe)?;
        self.put(&mut edits, recipe.rate)?;
        Ok((recipe, edits))
    }

    /// Lays corrections that were read over those of an earlier run. A switch that is off on the command line stays
    /// off.
    pub(super) fn over(&self, now: Edits, mut earlier: Edits) -> Edits {
        if self.freeze.is_some() {
            earlier = Edits { again: false, ..earlier.without_frozen() };
        }
        let mut both = now.over(earlier);
        both.again = self.again.unwrap_or(both.again);
        both.only_pins = self.only_pins.unwrap_or(both.only_pins);
        both
    }

    /// Puts the corrections of the command line on top of those of a recipe.
    fn put(&self, edits: &mut Edits, rate: f64) -> Result<(), Failure> {
        let mut keys = Edits::default();
        self.keys(&mut keys)?;
        *edits = keys.over(std::mem::take(edits));
        self.cut.put(edits, rate);
        for hold in &self.holds {
            let hold = self::hold(hold)?;
            edits.holds.retain(|other| other.frame != hold.frame);
            edits.holds.push(hold);
        }
        for line in &self.say {
            let line = Speech::parse(line).map_err(|error| wrongly("say", error))?;
            if !edits.speech.contains(&line) {
                edits.speech.push(line);
            }
        }
        if !self.split.is_empty() {
            edits.splits = self.split.clone();
        }
        edits.again = self.again.unwrap_or(edits.again);
        edits.only_pins = self.only_pins.unwrap_or(edits.only_pins);
        Ok(())
    }

    /// Reads the pins, forbidden frames and moves of the command line.
    fn keys(&self, edits: &mut Edits) -> Result<(), Failure> {
        for text in &self.pin {
            let (layer, text) = layer_of(text);
            let pin = Pin::parse(text).map_err(|error| wrongly("pin", error))?;
            let pins = edits.pins_of(layer);
            // A pin given again replaces the one on the same frame.
            pins.retain(|other| other.frame != pin.frame);
            pins.push(pin);
        }
        for text in &self.forbid {
            let (layer, text) = layer_of(text);
            let frames: Forbidden = text
                .parse()
                .map_err(|message| Failure::AskedWrongly(format!("--forbid: {message}")))?;
            let forbidden = edits.forbidden_of(layer);
            if !forbidden.contains(&frames) {
                forbidden.push(frames);
            }
        }
        for text in &self.moves {
            let (layer, text) = layer_of(text);
            let moved = Move::parse(text).map_err(|error| wrongly("move", error))?;
            let moves = edits.moves_of(layer);
            moves.retain(|other| other.from != moved.from);
            moves.push(moved);
        }
        Ok(())
    }
}

impl LayerArgs {
    /// Puts the layers and the root asked for into a recipe.
    fn put(&self, recipe: &mut Recipe) -> Result<(), Failure> {
        match self.layers.as_deref() {
            None => {}
            Some(word @ ("body" | "limbs" | "joints")) => recipe.set("layers", word)?,
            Some(file) => take_layers(recipe, Path::new(file))?,
        }
        if let Some(word) = &self.root_on {
            recipe.set("root", word)?;
        }
        recipe.r#loop = self.repeat.unwrap_or(recipe.r#loop);
        if let Some(count) = &self.cycles {
            recipe.set("cycles", count)?;
        }
        Ok(())
    }

    /// Puts the passages asked for into a recipe.
    fn put_passages(&self, recipe: &mut Recipe) -> Result<(), Failure> {
        for text in &self.within {
            recipe.add_passage(text).map_err(|error| match error {
                Error::Setting { name, message } if name == "passages" => {
                    Failure::AskedWrongly(format!("--within: {message}"))
                }
                other => other.into(),
            })?;
        }
        self.outside.iter().try_for_each(|word| Ok(recipe.set("outside", word)?))
    }
}

fn take_layers(recipe: &mut Recipe, path: &Path) -> Result<(), Failure> {
    if !paths::is_stream(path) && !path.exists() {
        let message = format!(
            "--layers: expected body, limbs, joints or a file of layers; there is no file {}",
            path.display()
        );
        return Err(Failure::AskedWrongly(message));
    }
    files::parsed("layers", path, |text| recipe.take_layers(text))
}

fn wrongly(option: &str, error: Error) -> Failure {
    match error {
        Error::Edits { message } => Failure::AskedWrongly(format!("--{option}: {message}")),
        other => other.into(),
    }
}

/// Parses a hold, which is of all layers.
fn hold(text: &str) -> Result<Hold, Failure> {
    match layer_of(text) {
        (Some(layer), rest) => Err(Failure::AskedWrongly(format!(
            "--hold: a drawing is held in all layers, not in {layer} alone: --hold {rest}, or edit the koma in \
             sheet.json and give it to genga deliver"
        ))),
        (None, _) => Hold::parse(text).map_err(|error| wrongly("hold", error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_a_number_of_the_file() {
        assert_eq!(frame(" 310").unwrap(), Frame(310));
        for wrong in ["", "-1", "1.5", "10s", "a"] {
            assert!(frame(wrong).unwrap_err().contains("as in 310"), "{wrong}");
        }
    }
}
