//! `genga deliver`: writes a sheet, edited or not, in other formats.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::clip::Reading;
use crate::console::{Words, counted};
use crate::cut_args::{self, CutArgs};
use crate::failure::Failure;
use crate::folder::{Folder, Made};
use crate::format_args::{FormatArgs, FormatName, Formats, all_made, help, long_help};
use crate::into_args::IntoArgs;
use crate::staging::Bundle;
use crate::{paths, sheets};
use genga::error::Error;
use genga_files::Cut;
use genga_files::sheet_json::SheetFile;

#[derive(Debug, Args)]
#[command(after_help = help(), after_long_help = long_help())]
pub(super) struct DeliverArgs {
    /// The sheet: a sheet.json or its folder, or a timesheet of all drawings from another program (XDTS or TDTS); - is stdin.
    #[arg(value_name = "SHEET.json")]
    sheet: PathBuf,
    /// The motion that the sheet was made of, the whole file.
    #[arg(value_name = "CLIP")]
    clip: PathBuf,
    /// Formats to write: --to remap,bvh, or all.
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', value_parser = FormatName, required_unless_present_any = ["bvh", "into"])]
    to: Vec<String>,
    /// For an XDTS or TDTS timesheet: the sheet.json with the drawings that its numbers refer to [default: the one
    /// beside it, or one or two folders above].
    #[arg(long, value_name = "SHEET.json")]
    drawings: Option<PathBuf>,
    #[command(flatten)]
    formats: FormatArgs,
    #[command(flatten)]
    into: IntoArgs,
    #[command(flatten)]
    cut: CutArgs,
    #[command(flatten)]
    reading: Reading,
    /// Output folder [default: the folder of the sheet].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &DeliverArgs, words: &Words) -> Result<(), Failure> {
    let sheet = &*sheets::file_of(&args.sheet)?;
    let mut formats =
        Formats::new("to", &args.to, &[], &args.formats, args.reading.bones()?.as_ref())?;
    if paths::is_stream(sheet) && paths::is_stream(&args.clip) {
        let message = "sheet and clip cannot both come from stdin".into();
        return Err(Failure::AskedWrongly(message));
    }
    paths::check_folder(args.out.as_deref(), "deliver", "")?;
    let folder = args.out.as_deref().unwrap_or_else(|| sheets::beside(sheet));
    formats.leave_sheet(sheet, folder)?;
    formats.spare_edited(folder)?;
    let mut file = read(args, sheet, words)?;
    file.sheet = args.cut.place(file.sheet).map_err(placed_wrongly)?;
    let bones = args.reading.bones.as_deref().map(|path| ("table of bones", path));
    let camera = args.reading.camera_work.as_deref().map(|path| ("camera", path));
    let sources = [("motion", &*args.clip), ("sheet", &*args.sheet)];
    let sources = sources.into_iter().chain(bones).chain(camera);
    for (what, path) in sources {
        formats.spare(what, path, folder, &file.cut)?;
    }
    let filled = args.into.fill(&file.sheet)?;
    if let (Some(path), false) = (args.into.file(), args.formats.over().is_forced) {
        paths::spare(&[("timesheet", Some(path))], &folder.join(paths::file_name(path)))?;
    }
    let motion = args.reading.read_for((sheet, &file), &args.clip, words)?;
    let place = Folder::look(folder, args.formats.over());
    place.check(&motion.of)?;
    let said = formats.keep(&place.settings(&motion.of), &args.formats, "--with sets others");
    said.iter().for_each(|note| words.say(format_args!("note        {note}")));
    let cut = Cut {
        name: &file.cut,
        clip_file: &paths::file_name(&args.clip),
        clip: motion.clip(),
        exaggerated: motion.drawn.is_some().then_some((&motion.source, &file.exaggerate)),
        sheet: &file.sheet,
        spaced: None,
        splits: &[],
        made_with: file.made_with.as_ref(),
    };
    let mut bundle = Bundle::begin(folder)?;
    let mut written = formats.write(&cut, &mut bundle, &|_| Ok(()))?;
    if let Some(filled) = &filled {
        if bundle.files().contains_key(&filled.name) {
            return Err(Failure::AskedWrongly(format!(
                "--to writes a {} too, over the one with your columns; leave one of the two out",
                filled.name
            )));
        }
        bundle.add(&filled.name, &filled.bytes)?;
        written.files.push(filled.name.clone());
    }
    let unmade = written.said.unmade();
    written.said.notes.iter().for_each(|note| words.warn(note));
    unmade.iter().for_each(|warning| words.lose(warning));
    let (clip, stale) = (motion.of.clone(), written.stale);
    let (there, found) = (place.formats(&clip), place.found(&clip));
    let made = Made {
        clip,
        recipe: None,
        formats: formats.names(),
        settings: formats.own_settings(),
        found,
        stale,
        adds: true,
        given: None,
        sources: vec![],
    };
    let left = place.finish(bundle, made)?;
    for layer in &file.sheet.layers {
        let (name, koma, genga) = (&layer.name, layer.length(), layer.genga());
        let drawings = counted(layer.shown().count(), "drawing");
        words.say(format_args!(
            "sheet       シート     {name}: {koma} koma, {drawings}, {genga} genga"
        ));
    }
    cut_args::lines(&file.sheet, &file.cut).iter().for_each(|line| words.say(line));
    let notes = filled.iter().flat_map(|filled| &filled.notes);
    notes.for_each(|note| words.say(format_args!("into        追記       {note}")));
    left.notes().iter().for_each(|note| words.say(note));
    let edited = of_sheet_before_edits(&there, &formats, &file)
        .filter(|_| paths::is_same(sheet, &folder.join(sheets::SHEET)));
    let timing = sheets::of_another_timing(folder, sheet, &file.sheet);
    let notes = timing.into_iter().chain(edited);
    notes.for_each(|note| words.say(format_args!("note        {note}")));
    words.say(format_args!("files       {}: {}", folder.display(), written.files.join(" ")));
    all_made(&unmade)
}

/// Reads the sheet, with the timing of an edited timesheet where the arguments name one.
fn read(args: &DeliverArgs, sheet: &Path, words: &Words) -> Result<SheetFile, Failure> {
    let way_out = "name the one that it came from with --drawings kick-genga/sheet.json";
    sheets::read(sheet, (args.drawings.as_deref(), way_out), words)
}

/// Names the formats of an edited sheet's folder that are not written now. They keep the timing that they had.
fn of_sheet_before_edits(there: &[&str], now: &Formats, file: &SheetFile) -> Option<String> {
    let is_old = |name: &&str| *name != "json" && !now.writes(name);
    let old: Vec<&str> = there.iter().copied().filter(is_old).collect();
    (!file.is_as_made() && !old.is_empty()).then(|| {
        format!(
            "the sheet was edited; formats of this folder that are not written now keep the timing that they had: \
             --to {} writes them too",
            old.join(",")
        )
    })
}

fn placed_wrongly(error: Error) -> Failure {
    match error {
        Error::Edits { message } => Failure::AskedWrongly(message),
        other => other.into(),
    }
}
