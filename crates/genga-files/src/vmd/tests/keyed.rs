//! The oracle: both the take on every frame and its few keys are read back as motions of one body, which moves its
//! bones by the curves of the file.

use super::super::Vmd;
use crate::curves::Curves;
use genga::edits::Edits;
use genga::motion::{Body, Clip, Poser, Stature, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga::time::Frame;

/// The motion of a file, as another program reads it.
fn played(file: &[u8]) -> Clip {
    genga_read::Options::default().read(file).unwrap().clip
}

fn furthest(a: &Clip, b: &Clip) -> f64 {
    let [mut first, mut second] = [a, b].map(Poser::new);
    let [mut one, mut other] = [a, b].map(|clip| Body::new(clip.skeleton()));
    let off = (0..a.len()).map(|frame| {
        one.place(first.frame(Frame(frame)));
        other.place(second.frame(Frame(frame)));
        let points = one.points().iter().zip(other.points());
        points.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    });
    off.fold(0.0, f64::max) / Stature::new(a).size
}

fn sample(name: &str) -> (Clip, Sheet) {
    let path = format!("{}/../../data/{name}.bvh", env!("CARGO_MANIFEST_DIR"));
    let clip = bvh::open(path.as_ref()).unwrap().clip;
    let mut engine = Engine::new(clip.clone()).unwrap();
    let sheet = engine.run(&Recipe::default(), &Edits::default()).unwrap().sheet.clone();
    (clip, sheet)
}

#[test]
fn between_few_keys_the_curves_stay_close_to_the_take() {
    for name in ["kick", "tennis"] {
        let (clip, sheet) = sample(name);
        let vmd = Vmd::default();
        let mut counts = Vec::new();
        for error in [0.01, 0.05] {
            let made = vmd.make_keys(&clip, &sheet, &Curves { error }).unwrap();
            let keyed = played(&made.motion.bytes().unwrap());
            let ones = Sheet::on_ones(clip.clock(30.0), keyed.len());
            let taken = played(&vmd.make(&clip, &ones).unwrap().motion.bytes().unwrap());
            assert_eq!(keyed.len(), taken.len());
            let off = furthest(&taken, &keyed);
            // The model has other proportions than the capture on which the error is measured.
            assert!(off <= 1.1 * error, "{name}: off by {off}, asked {error}");
            let mut frames: Vec<u32> = made.motion.keys.iter().map(|key| key.frame).collect();
            frames.dedup();
            counts.push(frames.len());
        }
        assert!(counts[1] < counts[0] && counts[0] < clip.len(), "{name}: {counts:?}");
    }
}

#[test]
fn genga_are_keys_and_others_are_said() {
    let (clip, sheet) = sample("kick");
    let made = Vmd::default().make_keys(&clip, &sheet, &Curves::default()).unwrap();
    let is_keyed = |frame: u32| made.motion.keys.iter().any(|key| key.frame == frame);
    let kept = sheet.layers[0].shown().filter(|drawing| drawing.role.is_kept());
    for drawing in kept {
        let seconds = (drawing.source.place() - clip.first().0 as f64) / clip.rate().fps();
        assert!(is_keyed((30.0 * seconds).round() as u32), "{drawing:?}");
    }
    assert!(made.notes.iter().any(|note| note.code == "W_KEYS_ADDED"), "{:?}", made.notes);
    let all = Vmd::default().make_keys(&clip, &sheet, &Curves { error: 1.0 }).unwrap();
    assert!(all.notes.iter().all(|note| note.code != "W_KEYS_ADDED"), "{:?}", all.notes);
}
