//! Tests the pages of figures: contact sheet, onion skin, strip, flip-book.

use serde_json::Value;

use super::flipbook::take;
use super::*;
use crate::canvas::Canvas;
use crate::drawings::{ShownDrawing, Signs, composed, shown_drawings};
use crate::points::Posing;
use genga::sheet::Repeat;

/// Returns a walker and its sheet: end, inbetween, genga, inbetween, end on 1, 2, 3, 1 and 1 koma. The genga
/// comes after two drawings left out, and is pinned.
pub(super) fn walk() -> (Clip, Sheet) {
    let clip = walker(8);
    let mut sheet = sheet();
    sheet.clock.frame_rate = rate(24.0);
    for (drawing, place) in sheet.layers[0].drawings.iter_mut().zip([0.0, 1.0, 4.0, 5.5, 7.0]) {
        drawing.source = Source::At(place);
    }
    let why = &mut sheet.layers[0].drawings[2].why;
    why.omitted_before = 2;
    why.pinned = Some("<hit>".into());
    (clip, sheet)
}

/// Returns a long walk and a sheet with `genga` genga, each on two koma.
fn many(genga: usize) -> (Clip, Sheet) {
    let clip = walker(2 * genga);
    let mut sheet = Sheet::on_ones(clip.clock(24.0), genga);
    let layer = &mut sheet.layers[0];
    for (at, drawing) in layer.drawings.iter_mut().enumerate() {
        drawing.source = Source::At(2.0 * at as f64);
        drawing.role = Role::Genga;
    }
    layer.exposures.iter_mut().for_each(|exposure| exposure.koma = 2);
    (clip, sheet)
}

/// Returns a cycle that travels, and a loop of it that begins in its middle: four drawings on twos, in some rounds.
pub(super) fn looped(rounds: usize) -> (Clip, Sheet) {
    let clip = walker(9);
    let mut sheet = Sheet::on_ones(clip.clock(24.0), 4);
    sheet.repeat = Some(Repeat { frames: 8, koma: 8 });
    let layer = &mut sheet.layers[0];
    for (drawing, place) in layer.drawings.iter_mut().zip([4.0, 6.0, 0.0, 2.0]) {
        drawing.source = Source::At(place);
    }
    layer.exposures.iter_mut().for_each(|exposure| exposure.koma = 2);
    layer.exposures = layer.exposures.repeat(rounds);
    (clip, sheet)
}

/// Returns a clip of one point, on a sheet of one koma.
pub(super) fn point() -> (Clip, Sheet) {
    let skeleton = Skeleton { joints: vec![joint("root", None, DVec3::ZERO, true)] };
    let clip = Clip::new(skeleton, rate(24.0), Frame(0), 1, vec![1e7, -3.0, 0.5]).unwrap();
    let sheet = Sheet::on_ones(clip.clock(24.0), 1);
    (clip, sheet)
}

type Draw = fn(&str, &Clip, &Sheet) -> Result<Vec<String>, Error>;

/// All pages of figures, with their defaults.
const PAGES: [(&str, Draw); 4] = [
    ("contact", |cut, clip, sheet| ContactSheet::default().draw(cut, clip, sheet)),
    ("onion", |cut, clip, sheet| OnionSkin::default().draw(cut, clip, sheet)),
    ("strip", |cut, clip, sheet| Strip::default().draw(cut, clip, sheet)),
    ("flip-book", |cut, clip, sheet| {
        FlipBook::default().draw(cut, &SideBySide::Source(clip, sheet)).map(|page| vec![page])
    }),
];

/// Returns the words of pages, one item per text.
pub(super) fn said(pages: &[String]) -> Vec<String> {
    let lines = pages.iter().flat_map(|page| page.lines());
    let text = |line: &str| Some(line.strip_suffix("</text>")?.rsplit_once('>')?.1.to_owned());
    lines.filter_map(text).collect()
}

fn heads(pages: &[String]) -> usize {
    // A head is a white disc with an edge; so are numbers, but their edges are 1.2 px wide.
    let is_head = |line: &&str| {
        line.starts_with("<circle")
            && line.contains("fill=\"#ffffff\" stroke=")
            && !line.contains("stroke-width=\"1.2\"")
    };
    pages.iter().map(|page| page.lines().filter(is_head).count()).sum()
}

#[test]
fn pages_of_figures_refuse_settings_that_cannot_be() {
    let (clip, sheet) = walk();
    let contact = ContactSheet::default();
    for (page, name) in [
        (ContactSheet { width: 599, ..contact.clone() }, "width"),
        (ContactSheet { figure_height: 39, ..contact.clone() }, "figure_height"),
        (ContactSheet { in_row: 0, ..contact.clone() }, "in_row"),
        (ContactSheet { rows: 0, ..contact }, "rows"),
    ] {
        has_setting_error(page.validate(), name);
        has_setting_error(page.draw("cut", &clip, &sheet), name);
    }
    let onion = OnionSkin::default();
    for (page, name) in [
        (OnionSkin { width: 20_001, ..onion.clone() }, "width"),
        (OnionSkin { figure_height: 2001, ..onion.clone() }, "figure_height"),
        (OnionSkin { rows: 0, ..onion }, "rows"),
    ] {
        has_setting_error(page.validate(), name);
        has_setting_error(page.draw("cut", &clip, &sheet), name);
    }
    let strip = Strip::default();
    for (page, name) in [
        (Strip { width: 0, ..strip.clone() }, "width"),
        (Strip { figure_height: 0, ..strip.clone() }, "figure_height"),
        (Strip { in_line: 0, ..strip.clone() }, "in_line"),
        (Strip { rows: 0, ..strip }, "rows"),
    ] {
        has_setting_error(page.validate(), name);
        has_setting_error(page.draw("cut", &clip, &sheet), name);
    }
}

#[test]
fn clip_and_sheet_must_have_something_to_show() {
    let (clip, sheet) = walk();
    let empty = Sheet { layers: vec![], ..sheet.clone() };
    let mut wrong = sheet.clone();
    wrong.layers[0].exposures[0].drawing = 5;
    let mut nowhere = sheet.clone();
    nowhere.layers[0].drawings[0].source = Source::At(f64::NAN);
    for (name, draw) in PAGES {
        for (clip, sheet, says) in [
            (&walker(0), &sheet, "without frames or joints"),
            (&clip, &empty, "no koma"),
            (&clip, &Sheet::on_ones(sheet.clock, 0), "no koma"),
            (&clip, &wrong, "layer A shows drawing 5 but has 5"),
            (&clip, &nowhere, "must be a number"),
        ] {
            let message = draw("cut", clip, sheet).unwrap_err().to_string();
            assert!(message.contains(says), "{name}: {message}");
        }
    }
}

#[test]
fn a_contact_sheet_has_a_card_a_genga_and_inbetweens_if_asked() {
    let (clip, sheet) = walk();
    let pages = ContactSheet::default().draw("cut", &clip, &sheet).unwrap();
    assert_eq!(heads(&pages), 3);
    let words = said(&pages);
    for text in [
        "koma 1",
        "koma 4",
        "koma 8",
        "frame 4 · 3 koma",
        "&lt;hit&gt;",
        "left out 抜いた中割 2",
        "drawing 3",
        "0+3",
    ] {
        assert!(words.contains(&text.to_owned()), "{text}: {words:?}");
    }
    assert!(!words.contains(&"koma 2".to_owned()));
    let all = ContactSheet { inbetweens: true, ..ContactSheet::default() };
    assert_eq!(heads(&all.draw("cut", &clip, &sheet).unwrap()), 5);
}

#[test]
fn a_hundred_and_seventy_nine_genga_are_paged_without_losing_one() {
    let (clip, sheet) = many(179);
    let pages = ContactSheet::default().draw("cut", &clip, &sheet).unwrap();
    assert_eq!((heads(&pages), pages.len()), (179, 6), "five cards in a row, six rows");
    let words = said(&pages);
    for genga in 1..=179 {
        assert!(words.contains(&genga.to_string()), "{genga}");
    }
    assert!(words.contains(&"page 6 of 6".to_owned()));
    let onion = OnionSkin::default().draw("cut", &clip, &sheet).unwrap();
    assert_eq!(heads(&onion), 2 * 178, "from each to the next");
    assert!(onion.len() > 1);
}

#[test]
fn an_onion_skin_has_a_panel_from_each_genga_to_the_next() {
    let (clip, sheet) = walk();
    let pages = OnionSkin::default().draw("cut", &clip, &sheet).unwrap();
    assert_eq!(heads(&pages), 3 + 3, "the genga in the middle ends one panel and begins the other");
    let words = said(&pages);
    for text in ["koma 1–4", "koma 4–8", "1 between 中1枚"] {
        assert!(words.contains(&text.to_owned()), "{text}: {words:?}");
    }
}

#[test]
fn a_strip_shows_every_koma_twice_and_marks_gaps_and_holds() {
    let (clip, sheet) = walk();
    let pages = Strip::default().draw("cut", &clip, &sheet).unwrap();
    assert_eq!(heads(&pages), 2 * 8);
    let words = said(&pages);
    assert!(words.contains(&"×2".to_owned()), "{words:?}");
    assert!(words.contains(&"left out 抜いた中割".to_owned()), "the legend: {words:?}");
    let genga = "stroke=\"#c83210\" stroke-width=\"1.8\"";
    let crosses = pages[0].lines().filter(|line| line.contains(genga)).count();
    assert_eq!(crosses, 3 * 2, "two strokes for source frames 2 and 3, and in the legend");
    let brackets = pages[0].matches("stroke-width=\"1.5\"/>").count();
    assert_eq!(brackets, 2, "the inbetween on twos, the genga on threes");
}

#[test]
fn a_long_strip_is_wrapped_and_paged_without_losing_a_koma() {
    let (clip, sheet) = many(100);
    let pages = Strip::default().draw("cut", &clip, &sheet).unwrap();
    assert_eq!(heads(&pages), 2 * 200);
    assert_eq!(pages.len(), 200usize.div_ceil(12).div_ceil(6));
    let words = said(&pages);
    assert!(words.contains(&"200".to_owned()) && words.contains(&"193 · 8+0".to_owned()));
    let bytes: usize = pages.iter().map(String::len).sum();
    assert!(bytes < 400 * 1500, "a figure of six joints takes {} bytes", bytes / 400);
}

/// Returns each drawing's number, place among the genga, and koma.
fn numbered(cells: &[ShownDrawing<'_>]) -> Vec<String> {
    let words =
        |cell: &ShownDrawing<'_>| format!("{} {:?} {}", cell.number(), cell.genga, cell.koma);
    cells.iter().map(words).collect()
}

#[test]
fn numbers_are_those_of_the_key_table() {
    let (_, sheet) = walk();
    let cells = shown_drawings(&sheet.layers[0]);
    assert_eq!(
        numbered(&cells),
        ["1 Some(1) 0", "2 None 1", "3 Some(2) 3", "4 None 6", "5 Some(3) 7"]
    );
}

#[test]
fn a_drawing_of_several_columns_has_their_numbers() {
    let (clip, mut sheet) = walk();
    let mut arms = sheet.layers[0].clone();
    arms.name = "B".into();
    arms.joints = vec![clip.skeleton().joints[1].name.clone()];
    // It begins with the first drawing, and goes on when A has drawn three.
    arms.exposures = vec![Exposure { drawing: 0, koma: 6 }, Exposure { drawing: 4, koma: 2 }];
    sheet.layers.push(arms);
    let signs = Signs::new(&clip, &sheet);
    let composite = composed(&clip, &sheet).unwrap();
    let mut cells = shown_drawings(composite.layer());
    signs.give(&mut cells);
    let named = |cell: &ShownDrawing<'_>| {
        format!("{} {} {:?}", cell.koma, cell.sign(), cell.genga_sign().as_deref())
    };
    assert_eq!(
        cells.iter().map(named).collect::<Vec<_>>(),
        [
            "0 A1 B1 Some(\"A1 B1\")",
            "1 A2 None",
            "3 A3 Some(\"A2\")",
            "6 A4 B5 Some(\"B3\")",
            "7 A5 Some(\"A3\")",
        ]
    );
    for (name, draw) in PAGES.into_iter().filter(|(name, _)| *name != "flip-book") {
        let pages = draw("cut", &clip, &sheet).unwrap();
        assert!(said(&pages).contains(&"B3".to_owned()), "{name}: {:?}", said(&pages));
    }
    let poses = PoseRow::default().draw_kept(&clip, &sheet).unwrap();
    assert!(said(&[poses]).contains(&"A1 B1".to_owned()));
    let page = FlipBook::default().draw("cut", &SideBySide::Source(&clip, &sheet)).unwrap();
    let shown = &take(&page)["sheets"][0];
    assert_eq!(shown["counts"], serde_json::json!([5, 7]), "of both columns");
    assert_eq!(
        (&shown["column"], &shown["drawings"][3]["number"], &shown["drawings"][3]["genga"]),
        (&"".into(), &"A4 B5".into(), &"B3".into())
    );
}

#[test]
fn an_edited_sheet_keeps_the_numbers_of_its_drawings() {
    let (clip, mut sheet) = walk();
    let shown = [(4, 2), (0, 1), (4, 3), (1, 1)];
    let exposures = shown.map(|(drawing, koma)| Exposure { drawing, koma }).to_vec();
    sheet.layers[0].exposures = exposures;
    let cells = shown_drawings(&sheet.layers[0]);
    assert_eq!(numbered(&cells), ["5 Some(3) 0", "1 Some(1) 2", "5 Some(3) 3", "2 None 6"]);
    let take = take(&FlipBook::default().draw("cut", &SideBySide::Source(&clip, &sheet)).unwrap());
    let drawings = take["sheets"][0]["drawings"].as_array().unwrap();
    let genga = drawings.iter().map(|drawing| &drawing["genga"]);
    assert_eq!(
        genga.map(Value::as_u64).collect::<Vec<_>>(),
        [Some(1), None, Some(2), None, Some(3)]
    );
    for (name, draw) in PAGES {
        let pages = draw("cut", &clip, &sheet).unwrap();
        assert!(!said(&pages).contains(&"2".to_owned()) || name == "strip", "{name}");
    }
}

#[test]
fn a_blend_is_posed_as_a_blend_and_tips_follow_the_joints() {
    let (clip, _) = walk();
    let mut posing = Posing::new(&clip, &[]);
    let at = posing.points(Source::At(3.0));
    assert_eq!(at.len(), 6 + 1, "six joints and the tip of the head");
    assert!(at[6].abs_diff_eq(at[1] + 20.0 * DVec3::Y, 1e-12));
    let between = posing.points(Source::Between { from: 0.0, to: 4.0, share: 0.25 });
    let expected = posing.points(Source::At(1.0));
    assert!(between.iter().zip(&expected).all(|(a, b)| a.abs_diff_eq(*b, 1e-12)));
}

#[test]
fn degenerate_clips_give_pages_without_a_wrong_number() {
    let (walk, _) = walk();
    let one = Sheet::on_ones(walk.clock(24.0), 1);
    for (clip, sheet) in [point(), (walk, one)] {
        for (name, draw) in PAGES {
            let pages = draw("日本 \u{1}<&>", &clip, &sheet).unwrap();
            assert_eq!(pages.len(), 1, "{name}");
            assert!(!pages[0].contains("NaN") && !pages[0].contains("inf\""), "{name}");
        }
    }
}

#[test]
fn the_same_clip_and_sheet_give_the_same_pages() {
    let (clip, sheet) = walk();
    for (name, draw) in PAGES {
        assert!(
            draw("cut", &clip, &sheet).unwrap() == draw("cut", &clip, &sheet).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn a_long_row_of_poses_shows_the_first_and_says_so() {
    let row = PoseRow { most: 10, ..PoseRow::default() };
    let svg = row.draw(&walker(30), &super::frames(26)).unwrap();
    assert_eq!(tags(&svg, "circle", "fill=\"#ffffff\"").len(), 10, "heads");
    assert!(words(&svg).contains(&"the first 10 of 26"));
    let all = PoseRow::default().draw(&walker(30), &super::frames(26)).unwrap();
    assert!(!words(&all).iter().any(|word| word.starts_with("the first")));
}

#[test]
fn svg_has_no_letter_that_xml_forbids_and_no_number_that_is_none() {
    let mut svg = Canvas::new((10.2, 20.0));
    svg.text("a\u{1}<\"&", (f64::NAN, 1e300), Type::new(10.0));
    let svg = svg.finish();
    assert!(svg.contains("width=\"11\"") && svg.contains(">a &lt;&quot;&amp;</text>"), "{svg}");
    assert!(svg.contains("x=\"0\" y=\"1000000\""), "{svg}");
}

#[test]
fn small_pages_look_as_they_did() {
    let (clip, sheet) = walk();
    let contact = ContactSheet { width: 600, figure_height: 60, ..ContactSheet::default() };
    insta::assert_snapshot!("contact", contact.draw("cut", &clip, &sheet).unwrap()[0]);
    let onion = OnionSkin { width: 600, figure_height: 60, ..OnionSkin::default() };
    insta::assert_snapshot!("onion", onion.draw("cut", &clip, &sheet).unwrap()[0]);
    let strip = Strip { width: 600, figure_height: 60, ..Strip::default() };
    insta::assert_snapshot!("strip", strip.draw("cut", &clip, &sheet).unwrap()[0]);
}
