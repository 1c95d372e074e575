//! `genga deliver`: a sheet, as it was or edited, in the formats that are asked for.

use std::path::PathBuf;

use super::args::DeliverArgs;
use super::asked::Asked;
use super::failure::Failure;
use super::words::{Words, counted};
use super::{io, source};
use crate::deliver::{Cut, sheet_json};
use crate::sheet::Role;

pub(super) fn run(args: &DeliverArgs, words: &Words) -> Result<(), Failure> {
    let mut asked = Asked::new("to", &args.to, &[], &args.formats)?;
    if io::is_stream(&args.sheet) && io::is_stream(&args.clip) {
        let message = "sheet and clip cannot both come from stdin".into();
        return Err(Failure::AskedWrongly(message));
    }
    let folder = folder(args)?;
    asked.leave_sheet(&args.sheet, &folder)?;
    asked.spare_edited(&folder)?;
    let of_sheet = |error| Failure::of_file(&io::named(&args.sheet), error);
    let file = sheet_json::read(&io::read(&args.sheet)?).map_err(of_sheet)?;
    let bones = args.formats.bones.as_deref().map(|path| ("table of bones", path));
    let sources = [("motion", &*args.clip), ("sheet", &*args.sheet)].into_iter().chain(bones);
    for (what, path) in sources {
        asked.spare(what, path, &folder, &file.cut)?;
    }
    let read = source::whole(&args.clip, &args.reading)?;
    let (source, notes) = file.fit(read.clip).map_err(of_sheet)?;
    source.check_size().map_err(|error| Failure::of_file(&io::named(&args.clip), error))?;
    let drawn = file.drawn(&source).map_err(of_sheet)?;
    read.warnings.iter().chain(&notes).for_each(|note| words.say(note));
    let cut = Cut {
        name: &file.cut,
        clip_file: &io::file_name(&args.clip),
        clip: drawn.as_ref().unwrap_or(&source),
        exaggerated: drawn.is_some().then_some((&source, &file.exaggerate)),
        sheet: &file.sheet,
        spaced: None,
        splits: &[],
        made_with: file.made_with.as_ref(),
    };
    asked.settle(&cut)?.iter().for_each(|note| words.say(note));
    let mut bundle = io::Bundle::begin(&folder)?;
    let written = asked.write(&cut, &mut bundle, &|_| {})?;
    bundle.finish()?;
    for layer in &file.sheet.layers {
        let (name, koma, genga) = (&layer.name, layer.length(), layer.count(Role::Genga));
        let drawings = counted(layer.shown().count(), "drawing");
        words.say(format_args!(
            "sheet       シート     {name}: {koma} koma, {drawings}, {genga} genga"
        ));
    }
    written.stale.iter().for_each(|stale| words.say(stale));
    words.say(format_args!("files       {}: {}", folder.display(), written.files.join(" ")));
    Ok(())
}

/// The folder that is asked for, or the one that the sheet is in.
fn folder(args: &DeliverArgs) -> Result<PathBuf, Failure> {
    let beside = || args.sheet.parent().filter(|folder| !folder.as_os_str().is_empty());
    match &args.out {
        Some(out) if io::is_stream(out) => Err(Failure::AskedWrongly(
            "--out: deliver writes a folder of files, not to stdout".into(),
        )),
        Some(out) => Ok(out.clone()),
        None => Ok(beside().map_or_else(|| PathBuf::from("."), PathBuf::from)),
    }
}
