//! Any small motion that the reader takes: the chain refuses it or gives a sheet of its length.

#![no_main]

use genga::deliver;
use genga::edits::Edits;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use libfuzzer_sys::fuzz_target;

const MOST_FRAMES: usize = 60;
const MOST_JOINTS: usize = 12;

fuzz_target!(|bytes: &[u8]| {
    let Ok(read) = bvh::read(bytes) else { return };
    let clip = bvh::lead_in::strip(read.clip).0;
    if clip.len() <= MOST_FRAMES && clip.skeleton().len() <= MOST_JOINTS {
        run(clip);
    }
});

fn run(clip: Clip) {
    let recipe = Recipe::default();
    let Ok(mut engine) = Engine::new(clip) else { return };
    let Ok(breakdown) = engine.run(&recipe, &Edits::default()) else { return };
    let clip = breakdown.clip;
    let koma = clip.rate().koma_from_frames(clip.len(), recipe.rate);
    assert_eq!(breakdown.spaced.length(), koma, "the spaced sheet");
    if recipe.omission.keep_length {
        assert_eq!(breakdown.sheet.length(), koma, "the sheet");
    }
    let text = deliver::limited_bvh(clip, breakdown.sheet).expect("the limited motion");
    let limited = bvh::read(text.as_bytes()).expect("the limited motion reads").clip;
    assert_eq!(limited.len(), breakdown.sheet.length(), "rows of the limited motion");
}
