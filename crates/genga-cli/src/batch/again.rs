//! The formats of a batch (前回の形式): the named ones, or else those of the last batch.

use super::super::failure::Failure;
use super::super::format_args::{FormatArgs, Formats};
use super::journal::Written;
use genga_files::{BoneMap, Format};

/// Format of the first batch of a folder if it names none.
const DEFAULT: &str = "json";

/// Returns the formats to write for each clip, and what is to be said of those that the last batch wrote. A batch that
/// names no format writes them again, for it would remove them otherwise.
pub(crate) fn formats(
    named: &[String],
    args: &FormatArgs,
    bones: Option<&BoneMap>,
    before: &Written,
) -> Result<(Formats, Vec<String>), Failure> {
    let known = known(before);
    let is_again = named.is_empty() && !args.asks_for_bvh() && !known.is_empty();
    let names = match named {
        [] if is_again => known.clone(),
        [] => vec![DEFAULT.into()],
        named => named.to_vec(),
    };
    let mut formats = Formats::new("deliver", &names, &[], args, bones)?;
    let mut notes = Vec::new();
    if is_again && known != [DEFAULT] {
        let known = known.join(", ");
        notes.push(format!(
            "written again, as the folder has them: {known} (--deliver names others)"
        ));
    }
    if is_again {
        notes.extend(formats.keep(&before.with, args, "--deliver goes without"));
    }
    notes.extend(removed(&known, &formats)?);
    Ok((formats, notes))
}

/// Names of formats that the last batch wrote. One of another version of genga may be unknown.
fn known(before: &Written) -> Vec<String> {
    let is_known = |name: &&String| Format::find_all([name.as_str()]).is_ok();
    before.deliver.iter().filter(is_known).cloned().collect()
}

/// Says which formats the last batch wrote and this one does not.
fn removed(before: &[String], formats: &Formats) -> Result<Option<String>, Failure> {
    let before = Format::find_all(before.iter().map(String::as_str))?;
    let names = before.into_iter().map(|format| format.name);
    let removed: Vec<&str> = names.filter(|name| !formats.writes(name)).collect();
    let removed = Some(removed.join(", ")).filter(|names| !names.is_empty());
    Ok(removed.map(|names| format!("no longer written, and removed: {names}")))
}
