//! `genga keys`: the key table.

use super::args::KeysArgs;
use super::failure::Failure;
use super::words::Words;
use super::{io, pins, seen, source, targets};
use crate::deliver::{self, Drawings, Rows};
use crate::pipeline::Engine;

pub(super) fn run(args: &KeysArgs, words: &Words) -> Result<(), Failure> {
    io::spare(&args.clip.clip, &args.out)?;
    if let Some(marked) = &args.corrections.pin_from {
        io::spare_the("file with your keys", marked, &args.out)?;
    }
    if let Some(camera) = seen::file(&args.corrections.seen) {
        io::spare_the("camera", camera, &args.out)?;
    }
    targets::check(&args.targets, &args.corrections)?;
    let (mut recipe, mut edits) = source::corrected(&args.corrections)?;
    let mut source = source::clip(&args.clip)?;
    let (seen_from, notes) = seen::asked(&args.corrections.seen, &source.clip)?;
    recipe.seen_from = seen_from.unwrap_or(recipe.seen_from);
    source.notes.extend(notes);
    source.notes.iter().for_each(|note| words.say(note));
    let mut engine = Engine::new(source.clip)?;
    let marked = pins::marked(&args.corrections, &mut engine, &recipe, &mut edits)?;
    marked.iter().for_each(|note| words.say(note));
    let short = targets::meet(&args.targets, &mut engine, &mut recipe, &edits, words)?;
    short.iter().for_each(|note| words.say(note));
    let breakdown = engine.run(&recipe, &edits)?;
    pins::unmoved(&edits, &breakdown).iter().for_each(|note| words.say(note));
    let table = if args.per_joint {
        deliver::turns_csv(breakdown.clip.skeleton(), breakdown.filtered, breakdown.turns)?
    } else {
        let table = Drawings { cut: io::stem(&args.clip.clip), rows: Rows::Keys };
        table.write(breakdown.clip, breakdown.sheet)?
    };
    io::write(&args.out, table.as_bytes())
}
