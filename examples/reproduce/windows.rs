//! The omission paper alone, on windows of real clips as long as its own four actions.

use genga::motion::Clip;
use genga::time::{Frame, KOMA_RATE};

use crate::Outcome;
use crate::ones::{Ones, counts};
use crate::table::{Table, number};
use crate::takes::{Take, named};

/// A window: the paper's action, the clip that stands in for it, koma, N_io, N_hf.
const WINDOWS: [(&str, &str, usize, usize, usize); 3] = [
    ("Pitch", "cmu-02_05-punch-strike", 129, 4, 33),
    ("Kick", "cmu-11_01-soccer-kick", 92, 4, 30),
    ("Baseball swing", "cmu-02_07-swordplay", 120, 6, 40),
];

/// Cuts a window of the given number of koma around the fastest step of a clip, or less if the clip is shorter.
pub(crate) fn window(clip: &Clip, koma: usize) -> Outcome<Clip> {
    let ones = Ones::new(clip.clone());
    let all = ones.koma();
    let koma = koma.min(all);
    let step = |at: &usize| ones.stills.ssd(at - 1, *at);
    let faster = |a: &usize, b: &usize| step(a).total_cmp(&step(b)).then(b.cmp(a));
    let fastest = (1..all).max_by(faster).ok_or("no movement")?;
    let begin = fastest.saturating_sub(koma / 2).min(all - koma);
    // Uses whole source frames, even if a koma is not a whole number of them.
    let clock = clip.clock(KOMA_RATE);
    let first = clock.place_from_koma(begin).floor() as usize;
    let frames = ((koma - 1) as f64 * clock.frames_in_koma()).ceil() as usize;
    Ok(clip.clone().trimmed(Frame(first), Frame(first + frames + 1))?)
}

/// A table with one row per window.
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
        let ones = Ones::new(window(&named(takes, name)?.clip, koma)?);
        let first = ones.omit(&counts(naka_nashi, 0))?;
        let both = ones.omit(&counts(naka_nashi, koma_dori))?;
        table.row(&[
            action.into(),
            name.into(),
            format!("{}–{}", ones.clip.first(), ones.clip.last()),
            ones.koma().to_string(),
            format!("{}/{}", both.report.naka_nashi.done, both.report.naka_nashi.asked),
            format!("{}/{}", both.report.koma_dori.done, both.report.koma_dori.asked),
            (both.held() - first.held()).to_string(),
            both.adjacent().to_string(),
            number(ones.peak(), 0),
            number(first.peak, 0),
            number(first.peak / ones.peak(), 1),
            both.longest_hold().to_string(),
        ]);
    }
    Ok(table.text())
}
