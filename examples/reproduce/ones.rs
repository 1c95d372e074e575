//! A clip with one drawing per koma, and omission alone applied to it: the second paper without the first.

use genga::motion::Clip;
use genga::sheet::Sheet;
use genga::time::KOMA_RATE;
use genga::timing::{Amount, Omission, OmissionReport, Stills};

use crate::Outcome;

/// A clip on ones (1コマ打ち).
pub(crate) struct Ones {
    pub(crate) clip: Clip,
    pub(crate) sheet: Sheet,
    /// The body on each koma.
    pub(crate) stills: Stills,
}

/// The result of omission.
pub(crate) struct Done {
    pub(crate) sheet: Sheet,
    pub(crate) report: OmissionReport,
    /// The koma of the source that each koma shows.
    pub(crate) shown: Vec<usize>,
    /// The largest SSD from koma to koma.
    pub(crate) peak: f64,
}

/// Omission by counts, with defaults otherwise.
pub(crate) fn counts(naka_nashi: usize, koma_dori: usize) -> Omission {
    Omission {
        naka_nashi: Amount::Count(naka_nashi),
        koma_dori: Amount::Count(koma_dori),
        ..Omission::default()
    }
}

impl Ones {
    pub(crate) fn new(clip: Clip) -> Self {
        let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
        let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
        let stills = Stills::from_layer(&clip, &sheet.layers[0]);
        Self { clip, sheet, stills }
    }

    pub(crate) fn koma(&self) -> usize {
        self.stills.len()
    }

    /// SSD into each koma of what is shown; 0 for the first.
    pub(crate) fn steps(&self, shown: &[usize]) -> Vec<f64> {
        let step = |pair: &[usize]| self.stills.ssd(pair[0], pair[1]);
        [0.0].into_iter().chain(shown.windows(2).map(step)).collect()
    }

    /// The largest SSD from koma to koma of the source.
    pub(crate) fn peak(&self) -> f64 {
        largest(&self.steps(&(0..self.koma()).collect::<Vec<_>>()))
    }

    pub(crate) fn omit(&self, settings: &Omission) -> Outcome<Done> {
        let omitted = settings.apply(&self.sheet.layers[0], &self.stills, 1)?;
        let layer = omitted.layer;
        let place = |drawing: usize| layer.drawings[drawing].source.place();
        let koma = layer.koma().map(|drawing| self.sheet.clock.koma_from_place(place(drawing)));
        let shown: Vec<usize> = koma.collect();
        let peak = largest(&self.steps(&shown));
        let sheet = Sheet::new(self.sheet.clock, vec![layer]);
        Ok(Done { sheet, report: omitted.report, shown, peak })
    }
}

impl Done {
    /// Koma of the source that naka-nashi left out, in order.
    pub(crate) fn left_out(&self) -> Vec<usize> {
        let mut koma: Vec<_> = self.report.naka_nashi.gone.iter().map(|gone| gone.koma).collect();
        koma.sort_unstable();
        koma
    }

    /// The longest run of neighbouring koma that naka-nashi left out.
    pub(crate) fn adjacent(&self) -> usize {
        let runs = self.left_out();
        runs.chunk_by(|a, b| a + 1 == *b).map(<[usize]>::len).max().unwrap_or(0)
    }

    /// Number of koma that repeat the one before.
    pub(crate) fn held(&self) -> usize {
        self.sheet.layers[0].held_koma()
    }

    pub(crate) fn longest_hold(&self) -> usize {
        self.sheet.layers[0].longest_hold()
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}
