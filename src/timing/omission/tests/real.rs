//! Omission alone on real movements as long as those of the paper's Table 1 (KKMFT §4).

use super::*;
use crate::motion::{Clip, bvh};
use crate::real;
use crate::sheet::Sheet;
use crate::time::{Frame, KOMA_RATE};

/// A real clip, the koma of the window around its fastest movement, N_io and N_hf. Frame counts and numbers are the
/// paper's; its fourth action, 88 koma, has the numbers of the second except for one hold.
const WINDOWS: [(&str, usize, usize, usize); 3] = [
    ("cmu-02_05-punch-strike", 129, 4, 33),
    ("cmu-11_01-soccer-kick", 92, 4, 30),
    ("cmu-02_07-swordplay", 120, 6, 40),
];

/// Cuts the clip's window of `koma` koma, its fastest koma in the middle as far as the clip reaches.
fn window(clip: Clip, koma: usize) -> Clip {
    let (clip, _) = crate::motion::clean::lead_in::strip(clip);
    let (layer, stills) = ones(&clip);
    let fastest = (1..layer.drawings.len())
        .max_by(|a, b| stills.ssd(a - 1, *a).total_cmp(&stills.ssd(b - 1, *b)))
        .unwrap();
    let begin = fastest.saturating_sub(koma / 2).min(layer.drawings.len() - koma);
    let clock = clip.clock(KOMA_RATE);
    let [first, last] = [begin, begin + koma - 1].map(|koma| clock.place_from_koma(koma));
    clip.trimmed(Frame(first.ceil() as usize), Frame(last.ceil() as usize + 1)).unwrap()
}

fn ones(clip: &Clip) -> (Layer, Stills) {
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let layer = Sheet::on_ones(clip.clock(KOMA_RATE), koma).layers.remove(0);
    let stills = Stills::from_layer(clip, &layer);
    (layer, stills)
}

fn peak(clip: &Clip, layer: &Layer) -> f64 {
    let stills = Stills::from_layer(clip, layer);
    (1..stills.len()).map(|at| stills.ssd(at - 1, at)).fold(0.0, f64::max)
}

/// Runs a test on each window with its koma and the paper's counts.
fn each_window(look: impl Fn(&str, Clip, usize, [usize; 2])) {
    for (name, koma, naka_nashi, koma_dori) in WINDOWS {
        real::with([name], |[path]| {
            let clip = bvh::read(&real::bytes(&path)).unwrap().clip;
            look(name, window(clip, koma), koma, [naka_nashi, koma_dori]);
        });
    }
}

#[test]
fn real_movements_lose_and_hold_what_the_paper_asks_for() {
    each_window(|name, clip, koma, [naka_nashi, koma_dori]| {
        let settings = counts(naka_nashi, koma_dori);
        let (layer, stills) = ones(&clip);
        assert_eq!(layer.length(), koma, "{name}");
        let Omitted { layer: after, report } = settings.apply(&layer, &stills, 1).unwrap();
        assert_eq!(report.naka_nashi.done, naka_nashi, "{name}");
        assert_eq!(report.koma_dori.done, koma_dori, "{name}");
        assert_eq!(after.length(), koma, "{name}");
        assert_eq!(after.held_koma() - report.lengthened, koma_dori, "{name}");
        assert!(after.longest_hold() <= 4, "{name}");
        let mut gone = indices(&report.naka_nashi.gone);
        gone.sort_unstable();
        let gathered = gone.windows(3).any(|three| three[2] == three[0] + 2);
        assert!(gathered, "{name}: naka-nashi left out {gone:?}");
        let fewer = Omission { koma_dori: Amount::Count(0), ..settings };
        let jumping = fewer.apply(&layer, &stills, 1).unwrap().layer;
        let (was, now) = (peak(&clip, &layer), peak(&clip, &jumping));
        assert!(now > 1.5 * was, "{name}: the largest step went from {was} to {now}");
    });
}

#[test]
fn on_real_movements_it_is_algorithms_1_and_2_koma_for_koma() {
    each_window(|name, clip, _, [naka_nashi, koma_dori]| {
        let (mut layer, stills) = ones(&clip);
        // The oracle names a drawing by its number, which the helpers read from its place.
        for (number, drawing) in layer.drawings.iter_mut().enumerate() {
            drawing.source = Source::At(number as f64);
        }
        for order in [Order::NakaNashiFirst, Order::KomaDoriFirst] {
            for (all_at_once, keep_length) in [(false, true), (true, true), (false, false)] {
                for more in [counts(12, 60), counts(naka_nashi, koma_dori)] {
                    let settings = Omission { order, all_at_once, keep_length, ..more };
                    let omitted = settings.apply(&layer, &stills, 1).unwrap();
                    let expected = Rules::new(&settings, &stills, 1).by_koma(&rows(&layer));
                    assert_eq!(outcome(&omitted), expected, "{name} {settings:?}");
                }
            }
        }
    });
}
