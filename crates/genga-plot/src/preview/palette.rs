//! Defines the few colours of a preview: each ink in steps to the paper.

use std::collections::HashMap;

use plotters::style::RGBColor;
use tiny_skia::PremultipliedColorU8;

use crate::style;

/// Number of steps from an ink to the paper, enough for smooth edges.
const STEPS: u8 = 12;
const INKS: [RGBColor; 8] = [
    style::INK,
    style::LEFT,
    style::RIGHT,
    style::GENGA,
    style::FAINT,
    style::INBETWEEN,
    style::END,
    style::GENGA_LINE,
];

/// The colours by index. The index after the last colour stands for no change.
pub(super) struct Palette {
    colors: Vec<RGBColor>,
}

impl Palette {
    pub(super) fn new() -> Self {
        let step = |ink, step| style::mixed(ink, style::PAPER, f64::from(step) / f64::from(STEPS));
        let inks = INKS.into_iter().flat_map(|ink| (0..STEPS).map(move |at| step(ink, at)));
        Self { colors: [style::PAPER].into_iter().chain(inks).collect() }
    }

    /// Returns red, green and blue of each colour, then of the index that stands for no change.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let colors = self.colors.iter().flat_map(|color| [color.0, color.1, color.2]);
        colors.chain([255, 255, 255]).collect()
    }

    /// Returns the index that stands for no change.
    pub(super) fn unchanged(&self) -> u8 {
        u8::try_from(self.colors.len()).expect("there are fewer than 256 colours")
    }

    /// Returns the index of the nearest colour for each opaque pixel.
    pub(super) fn indices(&self, pixels: &[PremultipliedColorU8]) -> Vec<u8> {
        let mut known = HashMap::new();
        let mut last = None;
        let mut index = |pixel: &PremultipliedColorU8| match last {
            // Most pixels equal the one before.
            Some((same, index)) if same == *pixel => index,
            _ => {
                let color = (pixel.red(), pixel.green(), pixel.blue());
                let index = *known.entry(color).or_insert_with(|| self.nearest(color));
                last = Some((*pixel, index));
                index
            }
        };
        pixels.iter().map(&mut index).collect()
    }

    fn nearest(&self, (red, green, blue): (u8, u8, u8)) -> u8 {
        let apart = |a: u8, b: u8| u32::from(a.abs_diff(b)).pow(2);
        let distance =
            |color: &RGBColor| apart(color.0, red) + apart(color.1, green) + apart(color.2, blue);
        let nearest =
            (0..self.unchanged()).min_by_key(|at| distance(&self.colors[usize::from(*at)]));
        nearest.unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_colour_is_the_colour_itself_where_there_is_it() {
        let palette = Palette::new();
        assert!(palette.bytes().len() <= 3 * 128, "7 bits a pixel");
        for ink in INKS.into_iter().chain([style::PAPER]) {
            let found = palette.colors[usize::from(palette.nearest((ink.0, ink.1, ink.2)))];
            assert_eq!(found, ink);
        }
        assert_eq!(palette.nearest((254, 255, 253)), 0, "nearly paper is paper");
    }
}
