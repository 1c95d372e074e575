//! Tests the letters of all figures: in a print 180 mm wide none is too small, and no two words run together.

use super::*;
use genga::edits::Edits;
use genga::motion::{bvh, laid};
use genga::pipeline::{Breakdown, Engine};
use genga::recipe::Recipe;

/// Width of a print in points: 180 mm.
const PRINT: f64 = 180.0 / 25.4 * 72.0;
/// Size of the smallest letters that a journal prints, in points.
const SMALLEST: f64 = 6.0;

/// A text of a picture, and the box round it in px.
#[derive(Debug)]
struct Letters {
    text: String,
    size: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Letters {
    fn from_tag(line: &str, upwards: bool) -> Option<Self> {
        let (look, text) = line.strip_suffix("</text>")?.rsplit_once('>')?;
        let text = text.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">");
        let text = text.replace("&amp;", "&");
        let [x, y, size] = ["x", "y", "font-size"].map(|name| number_of(look, name));
        let bolder = if look.contains("bold") { style::BOLDER } else { 1.0 };
        let long = bolder * style::text_width(&text, size);
        let before = match () {
            () if look.contains("\"end\"") => long,
            () if look.contains("\"middle\"") => 0.5 * long,
            () => 0.0,
        };
        let (high, low) = (0.8 * size, 0.15 * size);
        let (left, right, top, bottom) = match upwards {
            true => (x - high, x + low, y - long + before, y + before),
            false => (x - before, x - before + long, y - high, y + low),
        };
        Some(Self { text, size, left, right, top, bottom })
    }

    fn meets(&self, other: &Self) -> bool {
        let apart = |(a, b): (f64, f64), (c, d): (f64, f64)| b <= c + 0.5 || d <= a + 0.5;
        !apart((self.left, self.right), (other.left, other.right))
            && !apart((self.top, self.bottom), (other.top, other.bottom))
    }
}

/// Returns the words of a picture with their boxes.
fn letters(svg: &str) -> Vec<Letters> {
    let mut upwards = false;
    let mut letters = Vec::new();
    for line in svg.lines() {
        letters.extend(Letters::from_tag(line, upwards));
        upwards = line.contains("rotate(-90");
    }
    letters
}

/// Asserts that all words of a picture can be read in print: large enough, apart, and inside.
pub(super) fn check(name: &str, svg: &str) {
    let head = svg.lines().next().unwrap();
    let [width, height] = ["width", "height"].map(|name| number_of(head, name));
    let letters = letters(svg);
    assert!(letters.len() > 3, "{name}: words are found");
    for word in &letters {
        let (text, points) = (&word.text, word.size * PRINT / width);
        assert!(points >= SMALLEST, "{name}, {width} px: {text:?} has {points:.2} points");
        let is_inside = word.left >= -0.5 && word.right <= width + 0.5;
        assert!(is_inside && word.top >= 0.0 && word.bottom <= height, "{name}: {word:?}");
    }
    let mut sorted: Vec<&Letters> = letters.iter().collect();
    sorted.sort_by(|a, b| a.top.total_cmp(&b.top));
    for (at, word) in sorted.iter().enumerate() {
        let near = sorted[at + 1..].iter().take_while(|other| other.top < word.bottom);
        for other in near {
            let (text, into) = (&word.text, &other.text);
            assert!(!word.meets(other), "{name}: {text:?} runs into {into:?}: {word:?} {other:?}");
        }
    }
}

/// Draws every figure of a result, with its name.
fn all_of(breakdown: &Breakdown<'_>) -> Vec<(String, String)> {
    let (clip, sheet, cut) = (breakdown.clip, breakdown.sheet, "c012_蹴り");
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    let order: Vec<JointId> = (0..names.len()).map(JointId).collect();
    let koma = sheet.length();
    let ssd: Vec<f64> = (0..koma).map(|koma| if koma == 9 { 90.0 } else { 1.0 }).collect();
    let splits = vec![koma / 3, koma / 2];
    let speed = SpeedPlot {
        clip: cut.into(),
        splits: splits.iter().map(|koma| sheet.clock.frame_from_koma(*koma)).collect(),
        ..SpeedPlot::default()
    };
    let keys: Vec<Frame> = breakdown.first_layer().keys.keys.iter().map(|key| key.frame).collect();
    let sheet_plot = SheetPlot { clip: cut.into(), splits, ..SheetPlot::default() };
    let mut figures = vec![
        ("poses", PoseRow::default().draw_kept(clip, sheet)),
        ("sheet", sheet_plot.draw(sheet, Some(breakdown.spaced), Some(&ssd))),
        (
            "speed",
            speed.draw(&names, breakdown.speed, breakdown.filtered, breakdown.turns, &keys, &order),
        ),
        ("movement", SsdPlot::default().draw(clip, breakdown.spaced, sheet)),
        ("spacing", SpacingPlot::default().draw(clip, &[(cut, sheet)], None, &[])),
        ("skeleton", SkeletonPlot::default().draw(cut, clip)),
    ]
    .into_iter()
    .map(|(name, svg)| (name.to_owned(), svg.unwrap()))
    .collect::<Vec<_>>();
    let pages = [
        ("contact", ContactSheet::default().draw(cut, clip, sheet)),
        ("onion", OnionSkin::default().draw(cut, clip, sheet)),
        ("strip", Strip::default().draw(cut, clip, sheet)),
    ];
    for (name, pages) in pages {
        let numbered = pages.unwrap().into_iter().enumerate();
        figures.extend(numbered.map(|(at, page)| (format!("{name} {}", at + 1), page)));
    }
    figures
}

fn check_all_of(clip: Clip) -> usize {
    check_all_with(clip, &Recipe::default())
}

fn check_all_with(clip: Clip, recipe: &Recipe) -> usize {
    let mut engine = Engine::new(clip).unwrap();
    let breakdown = engine.run(recipe, &Edits::default()).unwrap();
    let figures = all_of(&breakdown);
    figures.iter().for_each(|(name, svg)| check(name, svg));
    breakdown.sheet.layers[0].genga()
}

fn kick() -> Clip {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/kick.bvh");
    bvh::open(&path).unwrap().clip
}

#[test]
fn the_letters_of_every_figure_can_be_read_in_print() {
    check_all_of(kick());
}

#[test]
fn the_letters_of_several_columns_can_be_read_in_print() {
    let mut recipe = Recipe::default();
    recipe.set("layers", "limbs").unwrap();
    check_all_with(kick(), &recipe);
}

#[test]
fn the_letters_of_a_long_take_can_be_read_in_print() {
    let genga = check_all_of(laid(&kick(), 12, 0));
    assert!(genga >= 100, "numbers of three digits: {genga}");
}

#[test]
fn the_letters_of_real_takes_can_be_read_in_print() {
    real::with(["cmu-01_06-playground-long", "rokoko-jesse-dance"], |paths| {
        for path in paths {
            check_all_of(bvh::open(&path).unwrap().clip);
        }
    });
}

#[test]
fn a_glitch_does_not_flatten_the_lane_of_movement_and_is_marked_as_cut() {
    let sheet = Sheet::on_ones(sheet().clock, 100);
    let draw = |glitch: f64| {
        let ssd: Vec<f64> = (0..100).map(|koma| if koma == 50 { glitch } else { 4.0 }).collect();
        SheetPlot::default().draw(&sheet, None, Some(&ssd)).unwrap()
    };
    let top = |svg: &str, koma: usize| {
        let lane = tags(svg, "polygon", "#e4e7ea")[0];
        let points = lane.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        let point = points.split_whitespace().nth(1 + 2 * koma).unwrap();
        point.split_once(',').unwrap().1.parse::<f64>().unwrap()
    };
    let (plain, glitch) = (draw(4.0), draw(4e6));
    let floor = top(&plain, 10) + 30.0;
    assert_eq!(floor - top(&glitch, 10), 24.0, "the rest has four fifths of the lane");
    assert_eq!(floor - top(&glitch, 50), 30.0, "the glitch has all of it");
    assert!(words(&glitch).contains(&"goes on 省略") && !words(&plain).contains(&"goes on 省略"));
    // A stroke of paper, and one of ink on each side of it: over the glitch and in the legend.
    assert_eq!(tags(&glitch, "line", "stroke-width=\"4\"").len(), 2);
}
