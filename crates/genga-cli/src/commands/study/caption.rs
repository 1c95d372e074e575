//! The caption below a study's pictures: what they show, and all that is needed to make them again.

use std::env;
use std::fmt::Write;

use super::StudyArgs;
use crate::failure::Failure;
use crate::paths;
use crate::shell::quoted;
use genga::edits::Edits;
use genga::recipe::Recipe;
use genga_lab::study::{Axis, Grid, Measure, Noise, Study};

/// Refuses `--caption` and `--per-second` without a picture.
pub(super) fn check(args: &StudyArgs) -> Result<(), Failure> {
    let has_picture = args.plot.is_some() || args.heat.is_some();
    let wants = [("caption", args.caption.is_some()), ("per-second", args.per_second)];
    if let Some((option, _)) = wants.iter().find(|(_, is_asked)| *is_asked && !has_picture) {
        let message = format!("--{option}: is about a picture; ask for one with --plot or --heat");
        return Err(Failure::AskedWrongly(message));
    }
    match args.caption.as_deref().and_then(paths::ending).as_deref() {
        Some("md" | "txt") | None => Ok(()),
        Some(other) => {
            Err(Failure::AskedWrongly(format!("--caption: a caption is .md or .txt, not .{other}")))
        }
    }
}

/// The contents of the pictures.
pub(super) struct Drawn {
    pub(super) show: Measure,
    pub(super) per_second: bool,
    pub(super) paper: bool,
    /// Whether curves are drawn, and whether a map is.
    pub(super) curves: bool,
    pub(super) map: bool,
}

impl Drawn {
    /// Renders the caption as Markdown.
    pub(super) fn caption(&self, study: &Study, names: &[String], grids: &[Grid]) -> String {
        let mut text = self.sentences(study, names.len());
        text.push_str("\n\n| clip | seconds |\n|---|---|\n");
        for (name, grid) in names.iter().zip(grids) {
            let name = name.replace('|', "\\|");
            let _ = writeln!(text, "| {name} | {} |", seconds(grid));
        }
        let axes = [Some(&study.x), study.y.as_ref()].into_iter().flatten();
        let on_axes: Vec<&str> = axes.map(Axis::name).collect();
        let version = env!("CARGO_PKG_VERSION");
        let _ = write!(text, "\nMade by genga {version}:\n\n```sh\n{}\n```\n", command());
        let _ = write!(
            text,
            "\nThe recipe, where the study does not vary it:\n\n```toml\n{}```\n",
            settings(&study.recipe, &on_axes)
        );
        text
    }

    fn sentences(&self, study: &Study, clips: usize) -> String {
        let (english, japanese) = self.show.words();
        let second = if self.per_second { ", a second of its sheet" } else { "" };
        let mut text = format!("**{english}** ({japanese}){second}, over {}.", varied(&study.x));
        if let Some(y) = &study.y {
            let rows = match (self.curves, self.map) {
                (true, true) => "line or row",
                (true, false) => "line",
                _ => "row",
            };
            let _ = write!(text, " A {rows} for each value of {}.", varied(y));
        }
        let names: Vec<&str> =
            [Some(&study.x), study.y.as_ref()].into_iter().flatten().map(Axis::name).collect();
        if names.contains(&"noise") && !names.contains(&"noise.seed") {
            let seed = Noise::default().seed;
            let _ = write!(text, " The noise is that of noise.seed {seed}.");
        }
        let over = match clips {
            0 | 1 => "",
            _ if !self.curves => " Of several clips the median.",
            2 | 3 => " Of several clips the median; each of them is a thin line.",
            _ => {
                " Of several clips the median; half of them lie in the band between the quartiles."
            }
        };
        text.push_str(over);
        if self.paper {
            text.push_str(
                " Hollow marks: Table 1 of Kuroda and Tokoi (2011), of a clip that is not public.",
            );
        }
        text
    }
}

/// The seconds by which counts are divided: from the least to the most if they differ between cells.
fn seconds(grid: &Grid) -> String {
    let (least, most) = grid.seconds();
    let (least, most) = (format!("{least:.2}"), format!("{most:.2}"));
    if least == most { least } else { format!("{least} to {most}") }
}

/// Describes a setting with its unit and its values.
fn varied(axis: &Axis) -> String {
    let knob = axis.knob();
    let unit = if knob.unit.is_empty() { String::new() } else { format!(", {}", knob.unit) };
    format!("`{}` ({}{unit}: {})", axis.name(), knob.japanese, axis.values().join(", "))
}

/// The settings as in a recipe file, without comments and without those that vary.
fn settings(recipe: &Recipe, varied: &[&str]) -> String {
    let file = recipe.write(&Edits::default());
    let mut section = String::new();
    let mut is_kept = |line: &&str| {
        if let Some(own) = line.strip_prefix('[') {
            // Settings for studies have whole names.
            section = own.replace(']', ".").replace("studies.", "");
        }
        let name = line.split(' ').next().unwrap_or_default();
        !line.is_empty()
            && !line.starts_with('#')
            && !varied.contains(&&*format!("{section}{name}"))
    };
    let lines = file.lines().filter(|line| is_kept(line));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The command as it was given, quoted for a shell.
fn command() -> String {
    let words = env::args_os().skip(1);
    let words = words.map(|word| quoted(&word.to_string_lossy()));
    ["genga".to_owned()].into_iter().chain(words).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_quoted_where_a_shell_would_take_it_apart() {
        for (word, written) in [
            ("--x", "--x"),
            ("filter.width=0.1s..0.3s:0.1s", "filter.width=0.1s..0.3s:0.1s"),
            ("two words", "\"two words\""),
            ("it's", "\"it's\""),
            ("*.bvh", "\"*.bvh\""),
            ("", "\"\""),
        ] {
            assert_eq!(quoted(word), written);
        }
    }

    #[test]
    fn the_settings_of_a_caption_are_read_back_as_the_recipe() {
        let mut recipe = Recipe::default();
        recipe.set("filter.width", "0.25s").unwrap();
        recipe.set("keys.per_second", "4.5").unwrap();
        let written = settings(&recipe, &[]);
        assert!(!written.contains('#'), "{written}");
        assert_eq!(Recipe::parse(&written).unwrap().0, recipe);
        let others = settings(&recipe, &["filter.width", "filter.kind"]);
        let expected =
            written.replace("\nwidth = \"0.25s\"\n", "\n").replace("filter.kind = \"box\"\n", "");
        assert_eq!(others, expected);
        assert_eq!(others.lines().count() + 2, written.lines().count());
    }
}
