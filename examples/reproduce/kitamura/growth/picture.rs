//! Draws the largest step against both numbers, one line per clip.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters_svg::SVGBackend;

use crate::Outcome;
use crate::kitamura::growth::knee::{knee, last_within};
use crate::kitamura::growth::{Effect, Growth, KOMA_DORI, NAKA_NASHI, middle};
use crate::table::number;

/// Fonts, as in the library's pictures.
const FONTS: &str = "Noto Sans CJK JP, Hiragino Sans, Yu Gothic, sans-serif";

const CLIP: RGBColor = RGBColor(184, 190, 197);
const MIDDLE: RGBColor = RGBColor(34, 37, 43);
const PAPER: RGBColor = RGBColor(200, 50, 16);
const GRID: RGBColor = RGBColor(228, 231, 234);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// One of the two charts.
struct Panel {
    title: &'static str,
    legend: &'static str,
    below: &'static str,
    most: usize,
    highest: f64,
    /// The range that the paper finds right.
    paper: (f64, f64),
    of: fn(&Growth) -> &[Effect],
    /// Index of the dot on the median line.
    dot: fn(&[f64]) -> usize,
}

/// Draws both charts side by side.
pub(super) fn draw(clips: &[Growth]) -> Outcome<String> {
    let mut svg = String::new();
    {
        let paper = SVGBackend::with_string(&mut svg, (1200, 470)).into_drawing_area();
        paper.fill(&WHITE)?;
        let panels = [
            Panel {
                title: "Naka-nashi 中無し",
                legend: "thin: a clip · thick: the middle of all, dot: its knee · red: the paper",
                below: "drawings left out, N_io",
                most: NAKA_NASHI[0],
                highest: 8.0,
                paper: (4.0, 6.0),
                of: |clip| &clip.naka_nashi,
                dot: knee,
            },
            Panel {
                title: "Koma-dori コマ撮り",
                legend: "dot: the last without a larger step · red: the paper, a third",
                below: "koma held, N_hf, % of the length",
                most: KOMA_DORI,
                highest: 3.0,
                paper: (100.0 / 3.0, 100.0 / 3.0),
                of: |clip| &clip.koma_dori,
                dot: last_within,
            },
        ];
        for (area, panel) in paper.split_evenly((1, 2)).iter().zip(&panels) {
            panel.draw(area, clips)?;
        }
        paper.present()?;
    }
    Ok(svg)
}

impl Panel {
    fn draw(&self, area: &Area<'_>, clips: &[Growth]) -> Outcome<()> {
        let words = |size: i32| (FONTS, size).into_font().color(&MIDDLE);
        area.draw(&Text::new(self.title, (18, 14), (FONTS, 20).into_font().color(&MIDDLE)))?;
        area.draw(&Text::new(self.legend, (200, 18), words(14)))?;
        let mut chart = ChartBuilder::on(area)
            .margin(14)
            .margin_top(48)
            .x_label_area_size(46)
            .y_label_area_size(50)
            .build_cartesian_2d(0.0..self.most as f64, 0.0..self.highest)?;
        let (from, to) = self.paper;
        let band = Rectangle::new([(from, 0.0), (to, self.highest)], PAPER.mix(0.12).filled());
        chart.draw_series([band])?;
        let edge = |x: f64| PathElement::new([(x, 0.0), (x, self.highest)], PAPER.mix(0.6));
        chart.draw_series([edge(from), edge(to)])?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(MIDDLE.mix(0.6))
            .x_desc(self.below)
            .y_desc("largest step, times the source's")
            .x_labels(7)
            .x_label_formatter(&|x| number(*x, 0))
            .y_label_formatter(&|y| number(*y, 1))
            .label_style(words(13))
            .axis_desc_style(words(14))
            .draw()?;
        for clip in clips {
            chart.draw_series(LineSeries::new(self.line(clip), CLIP.stroke_width(1)))?;
        }
        let steps = middle(clips, self.of);
        let steps = &steps[..=self.most];
        let points: Vec<_> = (0..).map(f64::from).zip(steps.iter().copied()).collect();
        let dot = Circle::new(points[(self.dot)(steps)], 5, MIDDLE.filled());
        chart.draw_series(LineSeries::new(points, MIDDLE.stroke_width(3)))?;
        chart.draw_series([dot])?;
        Ok(())
    }

    fn line<'a>(&self, clip: &'a Growth) -> impl Iterator<Item = (f64, f64)> + 'a {
        let effects = (self.of)(clip).iter().take(self.most + 1).enumerate();
        effects.map(|(at, effect)| (at as f64, effect.step))
    }
}
