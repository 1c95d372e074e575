//! Parses the command line; if that fails, suggests what to type instead.

use std::path::Path;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser};

use genga::error::did_you_mean;
use genga::recipe::KNOBS;

use super::commands::Args;
use super::paths::{first_clip, is_motion};
use super::shell::quoted;

/// Largest number of clips that a tip lists. If there are more, it lists only the first and the last.
const MOST_WORDS: usize = 4;

/// Parses this process's arguments, or exits with a tip.
pub(super) fn args() -> Args {
    Args::try_parse().unwrap_or_else(|error| with_tip(error).exit())
}

fn with_tip(mut error: clap::Error) -> clap::Error {
    drop_tips_to_pass_an_option(&mut error);
    if let Some(tip) = tip(&error) {
        let tips = vec![StyledStr::from(tip)];
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    }
    error
}

/// Drops tips to put `--` before an unknown option: no value is called like one.
fn drop_tips_to_pass_an_option(error: &mut clap::Error) {
    if error.kind() != ErrorKind::UnknownArgument {
        return;
    }
    if let Some(ContextValue::StyledStrs(mut tips)) = error.remove(ContextKind::Suggested) {
        tips.retain(|tip| !tip.to_string().contains("as a value"));
        if !tips.is_empty() {
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
        }
    }
}

fn tip(error: &clap::Error) -> Option<String> {
    let word = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.as_str()),
        _ => None,
    };
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let word = word(ContextKind::InvalidSubcommand)?;
            let is_suggested = error.get(ContextKind::SuggestedSubcommand).is_some();
            clip_of(Path::new(word)).or_else(|| (!is_suggested).then(|| command_like(word)))
        }
        ErrorKind::UnknownArgument => {
            let word = word(ContextKind::InvalidArg)?;
            if Path::new(word).exists() { Some(one_at_a_time(word)) } else { setting_like(word) }
        }
        ErrorKind::MissingRequiredArgument => {
            lacks_formats(error).then(|| "--to help lists the formats".into())
        }
        _ => None,
    }
}

/// Whether `--to` is missing.
fn lacks_formats(error: &clap::Error) -> bool {
    let Some(ContextValue::Strings(lacking)) = error.get(ContextKind::InvalidArg) else {
        return false;
    };
    lacking.iter().any(|argument| argument.starts_with("--to "))
}

/// Suggests `--set` if an option has the last part of a setting's name, as `--naka-nashi`.
fn setting_like(option: &str) -> Option<String> {
    let last = option.strip_prefix("--")?.replace('-', "_");
    let knob = KNOBS.iter().find(|knob| knob.path().1 == last)?;
    Some(format!("it is a setting: --set {}=VALUE", knob.name))
}

/// Says what a command takes, and what to do with several, if one file too many is given. A batch does not do what every
/// command does.
fn one_at_a_time(other: &str) -> String {
    let commands = Args::command();
    let is_command = |word: &String| commands.find_subcommand(word).is_some();
    let mut words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    match words.find(is_command).as_deref() {
        None | Some("run" | "keys") => many(other),
        Some("eval") => {
            "it takes one sheet at a time, and its motion after --clip; run it for each: \
                         genga eval SHEET --clip CLIP"
                .into()
        }
        Some(command @ ("deliver" | "preview")) => {
            format!("a sheet stands first, its motion second; run genga {command} for each sheet")
        }
        Some(command) => format!("it takes one clip at a time; run genga {command} for each"),
    }
}

/// Suggests the `batch` command if several clips are given where one is expected.
fn many(other: &str) -> String {
    let is_clip = |word: &String| word == other || is_motion(Path::new(word));
    let words = std::env::args_os().skip(2).map(|word| word.to_string_lossy().into_owned());
    let mut words: Vec<String> = words.filter(is_clip).map(|word| quoted(&word)).collect();
    if words.len() > MOST_WORDS {
        words.splice(1..words.len() - 1, ["…".into()]);
    }
    format!("it takes one clip at a time; of many: genga batch {} --out library", words.join(" "))
}

/// Suggests `genga run` if the first word is a clip, or a folder of them, instead of a command.
fn clip_of(path: &Path) -> Option<String> {
    let clip = if path.is_dir() { first_clip(path)? } else { path.to_owned() };
    (is_motion(&clip) || clip.is_file())
        .then(|| format!("type: genga run {}", quoted(&clip.display().to_string())))
}

/// Suggests the command that a misspelled word is like, else says where options, settings and formats are listed.
fn command_like(word: &str) -> String {
    let commands = Args::command();
    let names = commands.get_subcommands().map(clap::Command::get_name);
    match did_you_mean(word, names).strip_prefix("; ") {
        Some(meant) => meant.to_owned(),
        None => "options are in genga run --help, settings in genga recipe, formats in genga help deliver".into(),
    }
}
