//! The omission paper alone, on windows of real clips as long as its own four actions.

use genga::motion::Clip;
use genga::sheet::Sheet;
use genga::time::{Frame, KOMA_RATE};
use genga::timing::{Amount, Omission, Stills};

use crate::Outcome;
use crate::table::{Table, number};
use crate::takes::{Take, named};

/// A window: the paper's action, the clip that stands for it, koma, N_io, N_hf.
const WINDOWS: [(&str, &str, usize, usize, usize); 3] = [
    ("Pitch", "cmu-02_05-punch-strike", 129, 4, 33),
    ("Kick", "cmu-11_01-soccer-kick", 92, 4, 30),
    ("Baseball swing", "cmu-02_07-swordplay", 120, 6, 40),
];

/// What omission did to a motion on ones.
pub(crate) struct Done {
    pub(crate) naka_nashi: [usize; 2],
    pub(crate) koma_dori: [usize; 2],
    /// Koma that repeat the one before, after naka-nashi and after koma-dori.
    held: [usize; 2],
    /// The most neighbours among the koma that naka-nashi left out.
    adjacent: usize,
    /// The largest SSD from drawing to drawing, before and after naka-nashi.
    peak: [f64; 2],
    longest: usize,
}

/// Takes drawings out of a clip on ones.
pub(crate) fn omit(clip: &Clip, naka_nashi: usize, koma_dori: usize) -> Outcome<Done> {
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    let layer = &sheet.layers[0];
    let stills = Stills::of(clip, layer);
    let omission = |koma_dori| Omission {
        naka_nashi: Amount::Count(naka_nashi),
        koma_dori: Amount::Count(koma_dori),
        ..Omission::default()
    };
    let first = omission(0).apply(layer, &stills, 1)?;
    let both = omission(koma_dori).apply(layer, &stills, 1)?;
    let gone = both.report.naka_nashi.gone.iter().map(|gone| gone.koma);
    Ok(Done {
        naka_nashi: [both.report.naka_nashi.done, both.report.naka_nashi.asked],
        koma_dori: [both.report.koma_dori.done, both.report.koma_dori.asked],
        held: [first.layer.held_koma(), both.layer.held_koma()],
        adjacent: longest_run(gone.collect()),
        peak: [peak(&stills), peak(&Stills::of(clip, &first.layer))],
        longest: both.layer.longest_hold(),
    })
}

/// The largest SSD from one still to the next.
fn peak(stills: &Stills) -> f64 {
    (1..stills.len()).map(|at| stills.ssd(at - 1, at)).fold(0.0, f64::max)
}

fn longest_run(mut koma: Vec<usize>) -> usize {
    koma.sort_unstable();
    koma.chunk_by(|a, b| a + 1 == *b).map(<[usize]>::len).max().unwrap_or(0)
}

/// So many koma round the fastest step of a clip, as far as it has them.
pub(crate) fn window(clip: &Clip, koma: usize) -> Outcome<Clip> {
    let clock = clip.clock(KOMA_RATE);
    let all = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    if all < koma {
        return Err(format!("a window of {koma} koma does not fit into {all}").into());
    }
    let stills = Stills::of(clip, &Sheet::on_ones(clock, all).layers[0]);
    let faster = |a: &usize, b: &usize| {
        stills.ssd(a - 1, *a).total_cmp(&stills.ssd(b - 1, *b)).then(b.cmp(a))
    };
    let fastest = (1..all).max_by(faster).ok_or("no movement")?;
    let begin = fastest.saturating_sub(koma / 2).min(all - koma);
    // Whole source frames: all of these clips have 5 a koma.
    let frame = |koma| clock.place_from_koma(koma).round() as usize;
    Ok(clip.clone().trimmed(Frame(frame(begin)), Frame(frame(begin + koma - 1) + 1))?)
}

/// A row a window.
pub(crate) fn table(takes: &[Take]) -> Outcome<String> {
    let mut table = Table::new(&[
        "in place of",
        "clip",
        ">source frames",
        ">koma",
        ">naka-nashi done/asked",
        ">koma-dori done/asked",
        ">held koma added by koma-dori",
        ">most adjacent deletions",
        ">peak SSD before",
        ">after naka-nashi",
        ">times",
        ">longest hold",
    ]);
    for (action, name, koma, naka_nashi, koma_dori) in WINDOWS {
        let window = window(&named(takes, name)?.clip, koma)?;
        let done = omit(&window, naka_nashi, koma_dori)?;
        table.row(&[
            action.into(),
            name.into(),
            format!("{}–{}", window.first(), window.last()),
            window.rate().koma_from_frames(window.len(), KOMA_RATE).to_string(),
            format!("{}/{}", done.naka_nashi[0], done.naka_nashi[1]),
            format!("{}/{}", done.koma_dori[0], done.koma_dori[1]),
            (done.held[1] - done.held[0]).to_string(),
            done.adjacent.to_string(),
            number(done.peak[0], 0),
            number(done.peak[1], 0),
            number(done.peak[1] / done.peak[0], 1),
            done.longest.to_string(),
        ]);
    }
    Ok(table.text())
}
