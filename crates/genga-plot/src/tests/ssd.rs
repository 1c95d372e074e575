//! Tests the plot of the movement into each koma.

use super::figures::walk;
use super::*;
use crate::ssd::Moves;

/// Returns a walk on ones over six koma, and its sheets before and after omission. Drawing 1 is held in place
/// of 2 and gets one koma more; drawing 4 is left out.
fn omitted() -> (Clip, Sheet, Sheet) {
    let clip = walker(6);
    let before = Sheet::on_ones(clip.clock(24.0), 6);
    let mut after = before.clone();
    let layer = &mut after.layers[0];
    layer.drawings.remove(4);
    layer.drawings.remove(2);
    layer.drawings[1].why.held_for = 1;
    layer.drawings[1].why.lengthened = 1;
    layer.drawings[3].why.omitted_before = 1;
    let koma = [1, 3, 1, 1].into_iter().enumerate();
    layer.exposures = koma.map(|(drawing, koma)| Exposure { drawing, koma }).collect();
    (clip, before, after)
}

fn rects<'a>(svg: &'a str, color: &str) -> Vec<&'a str> {
    tags(svg, "rect", &format!("fill=\"{color}\""))
}

#[test]
fn settings_that_cannot_be_are_refused() {
    let (clip, before, after) = omitted();
    for (plot, name) in [
        (SsdPlot { width: 399, ..SsdPlot::default() }, "width"),
        (SsdPlot { height: 299, ..SsdPlot::default() }, "height"),
    ] {
        has_setting_error(plot.validate(), name);
        has_setting_error(plot.draw(&clip, &before, &after), name);
    }
}

#[test]
fn every_drawing_has_a_bar_and_its_fate_a_sign() {
    let (clip, before, after) = omitted();
    let svg = SsdPlot::default().draw(&clip, &before, &after).unwrap();
    assert_eq!(rects(&svg, "#969ca3").len(), 4, "stay");
    assert_eq!(rects(&svg, "#b8bec5").len(), 1, "held");
    assert_eq!(rects(&svg, GENGA).len(), 1 + 1, "left out, and the jump over it");
    // Bars and strokes of four drawings (the bar of the jump is red), and the legend.
    assert_eq!(rects(&svg, "#0068b0").len(), 4 + 3 + 1);
    let crosses = tags(&svg, "line", GENGA);
    assert_eq!(crosses.len(), 2 + 2, "and the legend's");
    assert_eq!(tags(&svg, "line", "#0068b0").len(), 2 + 2, "one koma given, and the legend's");
    assert!(words(&svg).contains(&"×1"), "{:?}", words(&svg));
}

#[test]
fn a_bar_is_as_high_as_the_way_is_long() {
    let (clip, before, after) = omitted();
    let plot = SsdPlot::default();
    let svg = plot.draw(&clip, &before, &after).unwrap();
    let height = |bar: &&str| {
        let (_, rest) = bar.split_once("height=\"").unwrap();
        rest.split_once('"').unwrap().0.parse::<f64>().unwrap()
    };
    // The walker goes the same distance into each koma but the first, twice as far past the drawing left out.
    let red = rects(&svg, GENGA);
    let ratio = height(&red[1]) / height(&red[0]);
    assert!((ratio - 2.0).abs() < 0.02, "{ratio}");
    let text = words(&svg).into_iter().find(|word| word.contains("largest SSD")).unwrap();
    assert!(text.contains("left out 抜いた中割 1") && text.contains(", 4.0 times"), "{text}");
}

#[test]
fn clip_and_sheets_must_have_something_to_show() {
    let (clip, before, after) = omitted();
    let plot = SsdPlot::default();
    let empty = Sheet { layers: vec![], ..before.clone() };
    assert!(plot.draw(&walker(0), &before, &after).is_err());
    assert!(plot.draw(&clip, &empty, &after).is_err());
    assert!(plot.draw(&clip, &before, &empty).is_err());
    let one = Sheet::on_ones(before.clock, 1);
    for (before, after) in [(&one, &one), (&before, &one), (&one, &after)] {
        let svg = plot.draw(&clip, before, after).unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

#[test]
fn a_sheet_with_genga_has_a_picture_as_well() {
    let (clip, sheet) = walk();
    let svg = SsdPlot::default().draw(&clip, &sheet, &sheet).unwrap();
    assert_eq!(rects(&svg, GENGA).len(), 1, "two were left out before its genga");
    assert!(words(&svg).contains(&"×2"));
}

#[test]
fn a_small_picture_looks_as_it_did() {
    let (clip, before, after) = omitted();
    let plot = SsdPlot { width: 400, height: 300, ..SsdPlot::default() };
    insta::assert_snapshot!("ssd", plot.draw(&clip, &before, &after).unwrap());
}

#[test]
fn movement_is_the_same_by_stills_of_all_drawings() {
    let (clip, before, after) = omitted();
    let (all, left) = (&before.layers[0], &after.layers[0]);
    let stills = genga::timing::Stills::from_layer(&clip, all);
    for layer in [all, left] {
        let direct = Moves::new(&clip, layer, &motion::Screen::WORLD);
        let among = Moves::among(&stills, all, layer).unwrap();
        assert_eq!(among.ssd, direct.ssd);
    }
    assert!(Moves::among(&stills, left, all).is_none(), "one is missing");
}
