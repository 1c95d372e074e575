//! `genga keys`: the key table.

use super::args::KeysArgs;
use super::failure::Failure;
use super::words::Words;
use super::{io, source};
use crate::deliver::{self, Drawings, Rows};
use crate::pipeline::Engine;

pub(super) fn run(args: &KeysArgs, words: &Words) -> Result<(), Failure> {
    io::spare(&args.clip.clip, &args.out)?;
    let (recipe, edits) = source::corrected(&args.corrections)?;
    let source = source::clip(&args.clip)?;
    source.notes.iter().for_each(|note| words.say(note));
    let mut engine = Engine::new(source.clip)?;
    let breakdown = engine.run(&recipe, &edits)?;
    let table = if args.per_joint {
        deliver::turns_csv(breakdown.clip.skeleton(), breakdown.filtered, breakdown.turns)?
    } else {
        let table = Drawings { cut: io::stem(&args.clip.clip), rows: Rows::Keys };
        table.write(breakdown.clip, breakdown.sheet)?
    };
    io::write(&args.out, table.as_bytes())
}
