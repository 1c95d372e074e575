//! `genga study`: how many keys each filter width and persistence leaves.

use super::args::{Filter, StudyArgs};
use super::failure::Failure;
use super::words::Words;
use super::{io, pictures, source};
use crate::pipeline::Engine;
use crate::signal::FilterKind;
use crate::study::{self, StudyRow};

pub(super) fn run(args: &StudyArgs, words: &Words) -> Result<(), Failure> {
    for target in args.plot.iter().chain([&args.out]) {
        io::spare(&args.clip.clip, target)?;
    }
    let (mut recipe, _) = source::recipe(&args.settings, study::table_1_recipe())?;
    let listed = [("filter.width", "--filter-width"), ("turns.persistence", "--persistence")];
    for (name, list) in listed {
        if args.settings.set.iter().any(|(set, _)| set == name) {
            return Err(Failure::AskedWrongly(format!(
                "--set {name}: a study takes it from {list}"
            )));
        }
    }
    if let Some(filter) = args.filter {
        recipe.filter.kind = kind(filter);
    }
    let source = source::clip(&args.clip)?;
    source.notes.iter().for_each(|note| words.say(note));
    let mut engine = Engine::new(source.clip)?;
    let rows = study::sweep(&mut engine, &recipe, &args.filter_width, &args.persistence)?;
    let table = table(&rows);
    if let Some(path) = &args.plot {
        pictures::write_study(path, &rows, engine.clip().rate(), args.paper)?;
    }
    io::write(&args.out, table.as_bytes())
}

fn kind(filter: Filter) -> FilterKind {
    match filter {
        Filter::Box => FilterKind::Box,
        Filter::Gaussian => FilterKind::Gaussian,
        Filter::Ideal => FilterKind::Ideal,
        Filter::Butterworth => FilterKind::Butterworth,
    }
}

fn table(rows: &[StudyRow]) -> String {
    let mut table = String::from("filter_width,persistence,union,total,layer_keys\n");
    for row in rows {
        let StudyRow { filter_width, persistence, union, total, layer_keys } = row;
        table.push_str(&format!("{filter_width},{persistence},{union},{total},{layer_keys}\n"));
    }
    table
}
