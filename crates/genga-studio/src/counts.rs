//! Counts (枚数): the cost of a change, shown while it is made.

use super::words::Words;
use genga::pipeline::{Breakdown, LayerBreakdown};
use genga::sheet::Layer;
use genga::timing::On;
use genga_plot::parts::{self, Moves};

/// The numbers a producer asks for, over all columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Counts {
    pub(super) genga: usize,
    pub(super) drawings: usize,
    pub(super) longest_hold: usize,
    pub(super) koma: usize,
    /// How many times the usual step between drawings the largest is (メリハリ): that of the column where it is most.
    pub(super) contrast: f64,
    koma_rate: f64,
}

impl Counts {
    pub(super) fn new(breakdown: &Breakdown<'_>) -> Self {
        let layers = &breakdown.sheet.layers;
        Self {
            genga: layers.iter().map(Layer::genga).sum(),
            drawings: layers.iter().map(|layer| layer.shown().count()).sum(),
            longest_hold: layers.iter().map(Layer::longest_hold).max().unwrap_or(0),
            koma: breakdown.sheet.length(),
            contrast: breakdown.layers().map(|own| contrast(breakdown, &own)).fold(1.0, f64::max),
            koma_rate: breakdown.clock.koma_rate,
        }
    }

    pub(super) fn a_second(&self, count: usize) -> f64 {
        count as f64 * self.koma_rate / self.koma.max(1) as f64
    }

    /// The most genga that have room on the sheet.
    pub(super) fn most_genga(&self, on: On) -> usize {
        self.koma / on.least.clamp(1, 2) + 1
    }

    /// Writes what no goal says in words, with its change since `before`.
    pub(super) fn words(&self, before: &Self, words: Words) -> [(&'static str, String); 2] {
        let hold = changed((self.longest_hold, before.longest_hold));
        let koma = self.koma;
        match words.is_japanese() {
            true => {
                let length = parts::seconds_and_koma(koma, self.koma_rate);
                [("最長の止め", format!("{hold}コマ")), ("尺", format!("{length} · {koma}コマ"))]
            }
            false => [("longest hold", format!("{hold} koma")), ("length", format!("{koma} koma"))],
        }
    }
}

/// The largest step between drawings of a column as a multiple of the usual one; 1 if nothing moves.
fn contrast(breakdown: &Breakdown<'_>, own: &LayerBreakdown<'_>) -> f64 {
    let mut steps = moves(breakdown, own, own.layer).ssd;
    steps.retain(|ssd| *ssd > 0.0);
    let middle = steps.len() / 2;
    if steps.is_empty() {
        return 1.0;
    }
    let usual = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    (steps.iter().copied().fold(0.0, f64::max) / usual).sqrt()
}

/// Measures the movement into each koma of a layer, with the stills of its column if it has any.
pub(super) fn moves(breakdown: &Breakdown<'_>, own: &LayerBreakdown<'_>, layer: &Layer) -> Moves {
    let known = own.stills.and_then(|stills| Moves::among(stills, own.spaced, layer));
    known.unwrap_or_else(|| Moves::new(breakdown.clip, layer, breakdown.screen))
}

/// Writes a count and its change.
fn changed((now, before): (usize, usize)) -> String {
    match now.cmp(&before) {
        std::cmp::Ordering::Equal => now.to_string(),
        std::cmp::Ordering::Greater => format!("{now} (+{})", now - before),
        std::cmp::Ordering::Less => format!("{now} (−{})", before - now),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_says_by_how_much_it_changed() {
        assert_eq!(changed((4, 4)), "4");
        assert_eq!(changed((5, 3)), "5 (+2)");
        assert_eq!(changed((3, 5)), "3 (−2)");
    }
}
