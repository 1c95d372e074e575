//! Counts (枚数): the cost of a change, shown while it is made.

use super::words::Words;
use genga::pipeline::Breakdown;
use genga::sheet::Layer;

/// The numbers a producer asks for, over all columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Counts {
    pub(super) genga: usize,
    pub(super) drawings: usize,
    pub(super) longest_hold: usize,
    pub(super) koma: usize,
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
            koma_rate: breakdown.clock.koma_rate,
        }
    }

    fn a_second(&self, count: usize) -> f64 {
        count as f64 * self.koma_rate / self.koma.max(1) as f64
    }

    /// Writes the counts in words, with their change since `before`.
    pub(super) fn words(&self, before: &Self, words: Words) -> [(&'static str, String); 4] {
        let genga = (self.genga, before.genga);
        let drawings = (self.drawings, before.drawings);
        let hold = (self.longest_hold, before.longest_hold);
        let [rate, drawing_rate] = [self.genga, self.drawings].map(|count| self.a_second(count));
        let koma = self.koma;
        if words.is_japanese() {
            [
                ("原画", format!("{} 毎秒{rate:.1}", changed(genga))),
                ("動画", format!("{}枚 毎秒{drawing_rate:.1}", changed(drawings))),
                ("最長の止め", format!("{}コマ", changed(hold))),
                ("尺", format!("{koma}コマ")),
            ]
        } else {
            [
                ("genga", format!("{}, {rate:.1} a second", changed(genga))),
                ("drawings", format!("{}, {drawing_rate:.1} a second", changed(drawings))),
                ("longest hold", format!("{} koma", changed(hold))),
                ("length", format!("{koma} koma")),
            ]
        }
    }
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
