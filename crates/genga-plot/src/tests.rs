//! Tests the pictures: what is on them, and that nothing makes them panic.

use glam::DVec3;
use nalgebra::DMatrix;

use super::canvas::{Align, Canvas, Type};
use super::chart::{Axis, Plot};
use super::sheet::fate::{Fate, fates};
use super::*;
use genga::error::Error;
use genga::motion::seen::view::View;
use genga::motion::{self, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::sheet::{Drawing, Exposure, Layer, Role, Sheet, Source, Why};
use genga::signal::{Quantity, Signals, Turn, TurnKind};
use genga::time::{Clock, Frame, FrameRate};

mod figures;
mod flipbook;
mod method;
#[cfg(feature = "pictures")]
mod moving;
mod print;
mod ssd;
mod study_chart;
mod versions;

const GENGA: &str = "#c83210";
const END: &str = "#30343c";

fn rate(fps: f64) -> FrameRate {
    FrameRate::new(fps).unwrap()
}

fn tags<'a>(svg: &'a str, tag: &str, holding: &str) -> Vec<&'a str> {
    let begin = format!("<{tag} ");
    svg.lines().filter(|line| line.starts_with(&begin) && line.contains(holding)).collect()
}

/// Returns the curves of a chart: its lines without the axes, which are faint and straight, and without the
/// grid.
fn curves(svg: &str) -> Vec<&str> {
    let is_axis = |line: &str| line.contains("\"#686e76\"") && line.matches(',').count() == 2;
    let is_grid = |line: &str| line.contains("\"#e4e7ea\"");
    let lines = tags(svg, "polyline", "").into_iter();
    lines.filter(|line| !is_axis(line) && !is_grid(line)).collect()
}

/// Returns the words of a picture, one item per text.
fn words<'a>(svg: &'a str) -> Vec<&'a str> {
    let text = |line: &'a str| Some(line.strip_suffix("</text>")?.rsplit_once('>')?.1);
    svg.lines().filter_map(text).collect()
}

/// Returns the number in an attribute.
fn number_of(tag: &str, name: &str) -> f64 {
    let value = tag.split_once(&format!(" {name}=\"")).unwrap().1;
    value.split('"').next().unwrap().parse().unwrap()
}

fn has_setting_error<T: std::fmt::Debug>(result: Result<T, Error>, name: &str) {
    match result.unwrap_err() {
        // The setting of a format is preceded by the format's name.
        Error::Setting { name: found, .. } => assert_eq!(found.rsplit('.').next(), Some(name)),
        other => panic!("{other}"),
    }
}

// Speed.

fn signals(frames: usize, joints: usize, value: impl Fn(usize, usize) -> f64) -> Signals {
    let values = DMatrix::from_fn(frames, joints, value);
    Signals { values, unit: Quantity::Angle, rate: rate(100.0), first: Frame(10) }
}

fn turn(frame: usize, kind: TurnKind) -> Turn {
    Turn { frame: Frame(frame), kind, confirmed_for: 5 }
}

fn draw_speed(signals: &Signals, turns: Vec<Turn>, keys: &[Frame]) -> Result<String, Error> {
    let names = vec!["<arm> & \"leg\""; signals.joints()];
    let turns = vec![turns; signals.joints()];
    let order: Vec<_> = (0..signals.joints()).map(JointId).collect();
    SpeedPlot::default().draw(&names, signals, signals, &turns, keys, &order)
}

#[test]
fn a_speed_plot_refuses_settings_that_cannot_be() {
    for (plot, name) in [
        (SpeedPlot { width: 0, ..SpeedPlot::default() }, "width"),
        (SpeedPlot { width: 20_001, ..SpeedPlot::default() }, "width"),
        (SpeedPlot { height: 299, ..SpeedPlot::default() }, "height"),
        (SpeedPlot { joints: 0, ..SpeedPlot::default() }, "joints"),
    ] {
        has_setting_error(plot.validate(), name);
        let speed = signals(3, 1, |_, _| 1.0);
        let drawn = plot.draw(&["a"], &speed, &speed, &[vec![]], &[], &[JointId(0)]);
        has_setting_error(drawn, name);
    }
}

#[test]
fn a_speed_plot_refuses_tables_that_do_not_belong_together() {
    let (three, four) = (signals(3, 1, |_, _| 1.0), signals(4, 1, |_, _| 1.0));
    let plot = SpeedPlot::default();
    let one = [JointId(0)];
    for (drawn, says) in [
        (plot.draw(&["a"], &three, &four, &[vec![]], &[], &one), "differ"),
        (plot.draw(&[], &three, &three, &[vec![]], &[], &one), "0 names"),
        (plot.draw(&["a"], &three, &three, &[], &[], &one), "0 lists"),
        (plot.draw(&["a"], &three, &three, &[vec![]], &[], &[]), "no joint"),
        (plot.draw(&["a"], &three, &three, &[vec![]], &[], &[JointId(1)]), "no such joint"),
    ] {
        let message = drawn.unwrap_err().to_string();
        assert!(message.contains(says), "{message}");
    }
    let none = signals(0, 1, |_, _| 1.0);
    assert!(draw_speed(&none, vec![], &[]).unwrap_err().to_string().contains("without frames"));
}

#[test]
fn every_turn_and_every_genga_stands_on_its_frame() {
    let speed = signals(101, 2, |frame, joint| (frame * (joint + 1)) as f64 * 0.01);
    let turns = vec![turn(10, TurnKind::Key), turn(60, TurnKind::Key), turn(85, TurnKind::Wall)];
    let svg = draw_speed(&speed, turns, &[Frame(60), Frame(110)]).unwrap();
    // The legend has one dot more; a triangle has a white rim.
    assert_eq!(tags(&svg, "circle", &format!("fill=\"{GENGA}\"")).len(), 2 * 2 + 1);
    assert_eq!(tags(&svg, "polygon", "fill=\"#0068b0\"").len(), 2 + 1);
    assert_eq!(tags(&svg, "circle", &format!("stroke=\"{GENGA}\"")).len(), 2, "two numbers");
    // Frames 10 to 110 lie from 64 to 936 px: 60 is in the middle.
    let middle = (64 + 936) / 2;
    let lines = tags(&svg, "line", &format!("x1=\"{middle}\""));
    let genga = lines.iter().filter(|line| line.contains("#e89e8a")).count();
    assert_eq!(genga, 2 + 1, "a line through both panels and one down from the number");
    let dots = tags(&svg, "circle", &format!("cx=\"{middle}\""));
    assert_eq!(dots.iter().filter(|dot| dot.contains(&format!("fill=\"{GENGA}\""))).count(), 2);
}

#[test]
fn names_are_escaped_and_values_are_for_people() {
    let svg = draw_speed(&signals(50, 1, |_, _| std::f64::consts::PI), vec![], &[]).unwrap();
    assert!(words(&svg).contains(&"&lt;arm&gt; &amp; &quot;leg&quot; (°/s)"), "{:?}", words(&svg));
    assert!(words(&svg).contains(&"180"), "π rad/s is 180°/s: {:?}", words(&svg));
}

#[test]
fn no_more_panels_than_asked_for_in_the_order_given() {
    let speed = signals(20, 6, |frame, _| frame as f64);
    let names = ["a", "b", "c", "d", "e", "f"];
    let order = [JointId(5), JointId(0), JointId(3)];
    let plot = SpeedPlot { joints: 2, ..SpeedPlot::default() };
    let turns = vec![vec![]; 6];
    let svg = plot.draw(&names, &speed, &speed, &turns, &[], &order).unwrap();
    let panels: Vec<_> = words(&svg).into_iter().filter(|word| word.ends_with("(°/s)")).collect();
    assert_eq!(panels, ["f (°/s)", "a (°/s)"]);
}

#[test]
fn degenerate_speeds_give_a_picture() {
    for frames in 1..4 {
        for value in [0.0, -1.0, 1e300, f64::NAN, f64::INFINITY] {
            let speed = signals(frames, 1, |_, _| value);
            let turns =
                vec![turn(0, TurnKind::Key), turn(10, TurnKind::Wall), turn(99, TurnKind::Key)];
            let svg = draw_speed(&speed, turns, &[Frame(0), Frame(10), Frame(500)]).unwrap();
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
            assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{frames} {value}");
        }
    }
}

#[test]
fn a_long_clip_stays_small_and_keeps_its_peaks() {
    let noise = |frame: usize, joint: usize| {
        let mixed = (frame + 7 * joint).wrapping_mul(2_654_435_761) % 1000;
        if frame == 3333 { 9000.0 } else { mixed as f64 }
    };
    let keys: Vec<_> = (0..50).map(|at| Frame(10 + at * 100)).collect();
    let turns = (0..250).map(|at| turn(10 + at * 20, TurnKind::Key)).collect();
    let svg = draw_speed(&signals(5000, 4, noise), turns, &keys).unwrap();
    assert!(svg.len() < 500_000, "{} bytes for 5000 frames with 1000 marks", svg.len());
    let curve = tags(&svg, "polyline", "stroke=\"#2c3038\"")[0];
    let points = curve.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
    let heights = points.split_whitespace().map(|point| point.split(',').nth(1).unwrap());
    let mut heights: Vec<f64> = heights.map(|height| height.parse().unwrap()).collect();
    heights.sort_by(f64::total_cmp);
    assert!(heights[1] - heights[0] > 20.0, "the one peak of frame 3333 is still there");
}

#[test]
fn a_glitch_of_the_filtered_speed_is_cut_under_a_sign_and_its_panel_says_how_far_it_goes() {
    let draw = |glitch: f64| {
        draw_speed(
            &signals(500, 1, |frame, _| if frame == 200 { glitch } else { 1.0 }),
            vec![],
            &[],
        )
    };
    let (plain, glitch) = (draw(1.0).unwrap(), draw(100.0).unwrap());
    let says = |svg: &str, what: &str| words(svg).iter().any(|word| word.contains(what));
    assert!(says(&glitch, "filtered goes to 5730  ·  raw goes to 5730"), "{:?}", words(&glitch));
    assert!(says(&glitch, "goes on 省略") && !says(&plain, "goes"), "{:?}", words(&plain));
    assert!(words(&glitch).contains(&"60") && !words(&glitch).contains(&"1000"), "the scale");
    // Frame 200 of 0 to 499, from 64 to 936 px; a stroke of paper below the sign's two.
    let paper = tags(&glitch, "line", "stroke-width=\"4\"");
    let middle = 0.5 * (number_of(paper[1], "x1") + number_of(paper[1], "x2"));
    assert_eq!(paper.len(), 2, "one in the legend");
    assert!((middle - (64.0 + 872.0 * 200.0 / 499.0)).abs() < 0.2, "{middle}");
}

#[test]
fn a_spike_of_the_raw_speed_does_not_flatten_the_filtered_one() {
    let raw = signals(50, 1, |frame, _| if frame == 20 { 100.0 } else { 1.0 });
    let filtered = signals(50, 1, |_, _| 1.0);
    let plot = SpeedPlot::default();
    let svg = plot.draw(&["a"], &raw, &filtered, &[vec![]], &[], &[JointId(0)]).unwrap();
    assert!(words(&svg).contains(&"raw goes to 5730"), "100 rad/s: {:?}", words(&svg));
    assert!(words(&svg).contains(&"80") && !words(&svg).contains(&"1000"), "{:?}", words(&svg));
}

/// Draws a panel of 101 frames from frame 10 on. The raw speed is 1 rad/s above the filtered one, and two
/// frames are keys.
fn draw_curves(curves: SpeedCurves) -> String {
    let raw = signals(101, 1, |frame, _| 2.0 + frame as f64 * 0.1);
    let filtered = signals(101, 1, |frame, _| 1.0 + frame as f64 * 0.1);
    let turns = [vec![turn(30, TurnKind::Key), turn(60, TurnKind::Key)]];
    let plot = SpeedPlot { curves, ..SpeedPlot::default() };
    plot.draw(&["a"], &raw, &filtered, &turns, &[], &[JointId(0)]).unwrap()
}

/// Returns the corners of the only line of a colour, in px.
fn corners(svg: &str, color: &str) -> Vec<(f64, f64)> {
    let of_color = |line: &&str| line.contains(&format!("stroke=\"{color}\""));
    let lines: Vec<_> = curves(svg).into_iter().filter(of_color).collect();
    let [line] = lines[..] else { panic!("{svg}") };
    let points = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
    let px = |unit: &str| unit.parse::<f64>().unwrap();
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| (px(x), px(y))).unwrap();
    points.split_whitespace().map(point).collect()
}

#[test]
fn a_speed_plot_shows_the_curves_it_is_asked_for_and_says_which() {
    use SpeedCurves::{Both, Filtered, Kept, Measured};
    for (curves, lines, legend) in [
        (Both, 2, vec!["raw", "filtered", "key of the joint 関節の候補"]),
        (Measured, 1, vec!["as measured", "key of the joint 関節の候補"]),
        (Filtered, 1, vec!["filtered", "key of the joint 関節の候補"]),
        (Kept, 2, vec!["filtered", "its keys alone 候補のみ", "key of the joint 関節の候補"]),
    ] {
        let svg = draw_curves(curves);
        assert_eq!(self::curves(&svg).len(), lines, "{curves:?}");
        let words = words(&svg);
        assert_eq!(words[1..=legend.len()], legend, "{curves:?}");
        assert!(!words.contains(&"wall 壁") && !words.contains(&"genga 原画 ①"));
    }
    // A key stands on the curve that is shown.
    let svg = draw_curves(Measured);
    let curve = corners(&svg, "#686e76");
    let keys = tags(&svg, "circle", &format!("fill=\"{GENGA}\""));
    let (x, y) = (number_of(keys[1], "cx"), number_of(keys[1], "cy"));
    let point = curve.iter().find(|point| (point.0 - x).abs() < 0.11).unwrap();
    assert!((point.1 - y).abs() < 0.2, "{point:?}");
}

#[test]
fn with_the_keys_alone_the_speed_stays_up_to_the_next_key_and_turns_at_right_angles() {
    let svg = draw_curves(SpeedCurves::Kept);
    let steps = corners(&svg, GENGA);
    // Frame 10 of the file is at 64 px, 110 at 936: a step at frame 30 and at 60, then on to the end.
    let x = |frame: f64| 64.0 + (frame - 10.0) * 8.72;
    let expected = [10.0, 30.0, 30.0, 60.0, 60.0, 110.0].map(x);
    for (corner, x) in steps.iter().zip(expected) {
        assert!((corner.0 - x).abs() < 0.1, "{steps:?}");
    }
    assert_eq!(steps.len(), expected.len());
    for (from, to) in [(0, 1), (2, 3), (4, 5)] {
        assert_eq!(steps[from].1, steps[to].1, "level: {steps:?}");
    }
    // The raw speed is 1 rad/s above the filtered one, which rises by as much in 10 frames.
    let filtered = corners(&svg, "#2c3038");
    let at = |frame: f64| filtered.iter().find(|point| (point.0 - x(frame)).abs() < 0.1).unwrap().1;
    assert!((steps[2].1 - at(40.0)).abs() < 0.2 && (steps[4].1 - at(70.0)).abs() < 0.2);
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let speed = signals(300, 3, |frame, joint| (frame as f64 * 0.1 + joint as f64).sin());
    let draw = || draw_speed(&speed, vec![turn(50, TurnKind::Key)], &[Frame(50)]).unwrap();
    // Not assert_eq: it would print both pictures.
    assert!(draw() == draw());
}

// Sheet.

fn drawing(place: f64, role: Role) -> Drawing {
    Drawing::new(Source::At(place), role, Why::default())
}

/// Returns a sheet of end, inbetween, genga, inbetween, end on 1, 2, 3, 1 and 1 koma.
fn sheet() -> Sheet {
    let roles = [Role::End, Role::Inbetween, Role::Genga, Role::Inbetween, Role::End];
    let drawings = roles.into_iter().enumerate().map(|(at, role)| drawing(5.0 * at as f64, role));
    let koma = [1, 2, 3, 1, 1].into_iter().enumerate();
    let layer = Layer {
        name: "A".into(),
        joints: vec![],
        drawings: drawings.collect(),
        exposures: koma.map(|(drawing, koma)| Exposure { drawing, koma }).collect(),
        gone: vec![],
    };
    let clock = Clock { first: Frame(0), frame_rate: rate(120.0), koma_rate: 24.0 };
    Sheet::new(clock, vec![layer])
}

/// Counts the bars of a colour on the sheet: all rectangles but the one in the legend.
fn bars(svg: &str, color: &str) -> usize {
    tags(svg, "rect", &format!("fill=\"{color}\"")).len() - 1
}

#[test]
fn a_sheet_plot_refuses_settings_that_cannot_be() {
    for (plot, name) in [
        (SheetPlot { width: 399, ..SheetPlot::default() }, "width"),
        (SheetPlot { koma_in_line: 5, ..SheetPlot::default() }, "koma_in_line"),
        (SheetPlot { koma_in_line: 1441, ..SheetPlot::default() }, "koma_in_line"),
    ] {
        has_setting_error(plot.validate(), name);
        has_setting_error(plot.draw(&sheet(), None, None), name);
    }
}

#[test]
fn a_sheet_has_a_bar_a_drawing_and_a_line_a_hold() {
    let svg = SheetPlot::default().draw(&sheet(), None, None).unwrap();
    assert_eq!((bars(&svg, GENGA), bars(&svg, "#969ca3"), bars(&svg, END)), (1, 2, 2));
    assert_eq!(tags(&svg, "line", "stroke-width=\"2.5\"").len(), 2 + 1, "two holds and the legend");
    let counts = "A:  8 koma (0.3 s)  ·  5 drawings  ·  3 genga  ·  15.0 drawings a second  ·  longest hold 3 koma";
    assert!(words(&svg).contains(&counts), "{:?}", words(&svg));
}

#[test]
fn a_long_sheet_is_wrapped_without_losing_a_bar_or_a_number() {
    let mut sheet = Sheet::on_ones(sheet().clock, 1000);
    for drawing in sheet.layers[0].drawings.iter_mut().skip(3).step_by(5) {
        drawing.role = Role::Genga;
    }
    // A hold that extends past the end of the first line.
    sheet.layers[0].exposures[143].koma = 3;
    let svg = SheetPlot::default().draw(&sheet, None, None).unwrap();
    let genga = sheet.layers[0].count(Role::Genga);
    assert_eq!(bars(&svg, GENGA), genga);
    let holds = tags(&svg, "line", "stroke-width=\"2.5\"");
    assert_eq!(holds.len(), 1 + 1, "its koma 145 and 146 on the second line, and the legend");
    assert!(holds[1].contains("x1=\"5"), "from the line's left edge: {}", holds[1]);
    for number in 1..=genga {
        assert!(words(&svg).contains(&number.to_string().as_str()), "{number}");
    }
    assert!(words(&svg).contains(&"41.75 s") || words(&svg).contains(&"41 s"));
    assert!(svg.len() < 1_000_000);
}

#[test]
fn what_omission_took_is_marked_on_the_row_above() {
    let spaced = Sheet::on_ones(sheet().clock, 6);
    let mut now = spaced.clone();
    let layer = &mut now.layers[0];
    // Drawing 1 is held in place of 2; drawing 4 is left out.
    layer.drawings.remove(4);
    layer.drawings.remove(2);
    layer.drawings[1].why.held_for = 1;
    layer.drawings[3].why.omitted_before = 1;
    let koma = [1, 2, 2, 1].into_iter().enumerate();
    layer.exposures = koma.map(|(drawing, koma)| Exposure { drawing, koma }).collect();
    use Fate::{Held, LeftOut, Stays};
    let expected = [Stays, Stays, Held, Stays, LeftOut, Stays];
    assert_eq!(fates(&spaced.layers[0], &now.layers[0]), expected);
    let svg = SheetPlot::default().draw(&now, Some(&spaced), Some(&[0.0, 1.0, 4.0])).unwrap();
    // Crosses are two lines 1.5 px wide; those of the cross in the legend are 1.8 px wide.
    let crosses = tags(&svg, "line", "stroke-width=\"1.5\"");
    assert_eq!(crosses.iter().filter(|line| line.contains(GENGA)).count(), 2);
    assert!(words(&svg).contains(&"left out 抜いた中割"));
}

#[test]
fn a_hold_by_hand_is_told_from_koma_dori() {
    let spaced = Sheet::on_ones(sheet().clock, 6);
    let mut now = spaced.clone();
    let layer = &mut now.layers[0];
    // A person holds drawing 1 in place of 2, and koma-dori holds 3 in place of 4.
    layer.drawings.remove(4);
    layer.drawings.remove(2);
    layer.drawings[1].why.held_for = 1;
    layer.drawings[1].why.hold_set = true;
    layer.drawings[2].why.held_for = 1;
    let koma = [1, 2, 2, 1].into_iter().enumerate();
    layer.exposures = koma.map(|(drawing, koma)| Exposure { drawing, koma }).collect();
    use Fate::{Held, HeldByHand, Stays};
    let expected = [Stays, Stays, HeldByHand, Stays, Held, Stays];
    assert_eq!(fates(&spaced.layers[0], &now.layers[0]), expected);
    let svg = SheetPlot::default().draw(&now, Some(&spaced), None).unwrap();
    assert_eq!(tags(&svg, "circle", "fill=\"#686e76\"").len(), 1 + 1, "and the legend's");
    assert!(words(&svg).contains(&"held by hand 手動の止め"), "{:?}", words(&svg));
    now.layers[0].drawings[1].why.hold_set = false;
    let svg = SheetPlot::default().draw(&now, Some(&spaced), None).unwrap();
    assert!(!words(&svg).contains(&"held by hand 手動の止め"), "nothing is held by hand");
}

#[test]
fn a_pinned_genga_has_a_filled_number() {
    let mut sheet = sheet();
    let badges = |sheet: &Sheet, fill: &str| {
        let svg = SheetPlot::default().draw(sheet, None, None).unwrap();
        tags(&svg, "circle", &format!("fill=\"{fill}\" stroke=\"{GENGA}\"")).len()
    };
    assert_eq!((badges(&sheet, "#ffffff"), badges(&sheet, GENGA)), (1, 0));
    sheet.layers[0].drawings[2].why.pinned = Some("hit".into());
    assert_eq!((badges(&sheet, "#ffffff"), badges(&sheet, GENGA)), (0, 1));
}

#[test]
fn degenerate_sheets_give_a_picture_or_an_error() {
    let plot = SheetPlot::default();
    let clock = sheet().clock;
    for koma in 0..4 {
        let ones = Sheet::on_ones(clock, koma);
        for ssd in [&[][..], &[0.0; 9], &[f64::NAN, f64::INFINITY, 1.0]] {
            let svg = plot.draw(&ones, Some(&ones), Some(ssd)).unwrap();
            assert!(!svg.contains("NaN"));
        }
    }
    let bare = Sheet::new(clock, vec![]);
    assert!(plot.draw(&bare, None, None).is_ok());
    assert!(plot.draw(&sheet(), Some(&bare), None).is_ok());
    let mut wrong = sheet();
    wrong.layers[0].exposures[0].drawing = 5;
    let message = plot.draw(&wrong, None, None).unwrap_err().to_string();
    assert_eq!(message, "layer A shows drawing 5 but has 5");
    assert!(plot.draw(&sheet(), Some(&wrong), None).is_err());
}

#[test]
fn a_small_sheet_looks_as_it_did() {
    let plot = SheetPlot { width: 400, koma_in_line: 6, ..SheetPlot::default() };
    insta::assert_snapshot!(plot.draw(&sheet(), None, Some(&[1.0, 4.0])).unwrap());
}

// Poses.

fn joint(name: &str, parent: Option<usize>, offset: DVec3, root: bool) -> Joint {
    let position =
        [motion::Axis::X, motion::Axis::Y, motion::Axis::Z].map(Channel::Position).to_vec();
    Joint {
        name: name.into(),
        parent: parent.map(JointId),
        offset,
        channels: if root { position } else { vec![] },
        first_channel: 0,
        end_sites: vec![],
    }
}

/// A trunk with a head, two arms and two legs that walks along X.
fn walker(frames: usize) -> Clip {
    let tip = EndSite { name: "Site".into(), offset: DVec3::new(0.0, 20.0, 0.0) };
    let mut joints = vec![
        joint("Hips", None, DVec3::ZERO, true),
        joint("Head", Some(0), DVec3::new(0.0, 60.0, 0.0), false),
        joint("LeftArm", Some(0), DVec3::new(0.0, 50.0, 40.0), false),
        joint("RArm", Some(0), DVec3::new(0.0, 50.0, -40.0), false),
        joint("LeftFoot", Some(0), DVec3::new(10.0, -90.0, 10.0), false),
        joint("RFoot", Some(0), DVec3::new(-10.0, -90.0, -10.0), false),
    ];
    joints[1].end_sites.push(tip);
    let values = (0..frames).flat_map(|frame| [-10.0 * frame as f64, 90.0, 0.0]).collect();
    Clip::new(Skeleton { joints }, rate(24.0), Frame(0), frames, values).unwrap()
}

fn frames(count: usize) -> Vec<(f64, String, Role)> {
    (0..count).map(|at| (at as f64, format!("<{at}>"), Role::Genga)).collect()
}

#[test]
fn a_pose_row_refuses_settings_that_cannot_be() {
    for (plot, name) in [
        (PoseRow { width: 199, ..PoseRow::default() }, "width"),
        (PoseRow { figure_height: 39, ..PoseRow::default() }, "figure_height"),
        (PoseRow { in_line: 0, ..PoseRow::default() }, "in_line"),
    ] {
        has_setting_error(plot.validate(), name);
        has_setting_error(plot.draw(&walker(20), &frames(3)), name);
    }
    let plot = PoseRow::default();
    assert!(plot.draw(&walker(0), &frames(1)).is_err());
    assert!(plot.draw(&walker(5), &[]).is_err());
    assert!(plot.draw(&walker(5), &[(f64::NAN, "a".into(), Role::End)]).is_err());
}

#[test]
fn every_pose_has_a_figure_with_a_head_and_its_label() {
    let svg = PoseRow::default().draw(&walker(30), &frames(26)).unwrap();
    assert_eq!(tags(&svg, "circle", "stroke=").len(), 26, "heads");
    let limbs = |color: &str| -> usize {
        tags(&svg, "path", color).iter().map(|path| path.matches('M').count()).sum()
    };
    assert_eq!((limbs("#0068b0"), limbs("#de8200")), (26 * 2, 26 * 2), "arm and leg of each");
    for at in 0..26 {
        assert!(words(&svg).contains(&format!("&lt;{at}&gt;").as_str()), "{at}");
        assert!(words(&svg).contains(&format!("frame {at}").as_str()), "{at}");
    }
    let floors = tags(&svg, "line", "stroke=\"#b8bec5\"");
    assert_eq!(floors.len(), 3, "26 figures on lines of at most 12");
}

#[test]
fn the_view_shows_the_way_gone_from_left_to_right() {
    let pose = |x: f64| vec![DVec3::new(x, 0.0, 0.0), DVec3::new(x, 100.0, 0.0)];
    let view = View::new(DVec3::Y, &[pose(0.0), pose(-200.0)]);
    assert!(view.right.abs_diff_eq(DVec3::NEG_X, 1e-12), "{view:?}");
    assert_eq!(view.up, DVec3::Y);
    assert!(view.near.abs_diff_eq(view.right.cross(view.up), 1e-12));
    let lying = |x: f64| vec![DVec3::new(0.0, x, 0.0), DVec3::new(0.0, x, 100.0)];
    let view = View::new(DVec3::Z, &[lying(0.0), lying(200.0)]);
    assert!(view.right.abs_diff_eq(DVec3::Y, 1e-12), "{view:?}");
}

#[test]
fn on_the_spot_the_view_shows_the_moving_joints() {
    let pose = |z: f64| vec![DVec3::ZERO, DVec3::new(30.0, 100.0, 0.0), DVec3::new(0.0, 50.0, z)];
    let view = View::new(DVec3::Y, &[pose(-40.0), pose(40.0)]);
    assert!(view.right.abs_diff_eq(DVec3::Z, 1e-12), "{view:?}");
    let still = View::new(DVec3::Y, &[pose(0.0), pose(0.0)]);
    assert!(still.right.abs_diff_eq(DVec3::X, 1e-12), "its widest side: {still:?}");
}

#[test]
fn degenerate_clips_give_a_picture() {
    let plot = PoseRow::default();
    assert!(plot.draw(&walker(1), &frames(3)).is_ok(), "places past the end are the last frame");
    let point = Skeleton { joints: vec![joint("root", None, DVec3::ZERO, true)] };
    for values in [[0.0; 3], [1e200, 0.0, -1e200]] {
        let clip = Clip::new(point.clone(), rate(24.0), Frame(0), 1, values.to_vec()).unwrap();
        let svg = plot.draw(&clip, &frames(1)).unwrap();
        assert!(svg.contains("<circle") && !svg.contains("NaN"));
    }
}

#[test]
fn a_small_pose_row_looks_as_it_did() {
    let plot = PoseRow { figure_height: 60, ..PoseRow::default() };
    insta::assert_snapshot!(plot.draw(&walker(3), &frames(2)).unwrap());
}

// Paper and px.

#[test]
fn a_canvas_takes_whatever_it_is_given() {
    let mut canvas = Canvas::new((100.0, 49.3));
    canvas.text("a\u{1}b", (10.0, 20.0), Type::new(10.0).align(Align::Center));
    canvas.line((f64::NAN, -1e300), (f64::INFINITY, 0.04), style::INK, f64::NAN);
    let svg = canvas.finish();
    assert!(svg.contains("width=\"100\" height=\"50\" viewBox=\"0 0 100 50\""), "{svg}");
    assert!(svg.contains("x1=\"0\" y1=\"-1000000\" x2=\"1000000\" y2=\"0\""), "{svg}");
    assert_eq!(words(&svg), ["a b"], "no control character may stand in XML");
    assert!(svg.contains("font-family=\"&quot;Noto Sans CJK JP&quot;"), "{svg}");
}

#[test]
fn a_mark_goes_into_the_first_lane_with_room() {
    let places = [0.0, 5.0, 12.0, 13.0, 14.0, 40.0].map(|place| (place, 5.0));
    assert_eq!(style::lanes(places, 2), [Some(0), Some(1), Some(0), None, None, Some(0)]);
    let wide = [(0.0, 5.0), (15.0, 12.0), (15.0, 5.0)];
    assert_eq!(style::lanes(wide, 2), [Some(0), Some(1), Some(0)], "a wide one needs more");
}

#[test]
fn a_chart_stands_in_its_box_whatever_its_values_are() {
    let ranges = [(0.0, 1.0), (-7.0, 12.0), (3.0, 3.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)];
    for range in ranges.into_iter().chain([(-1e300, 1e300), (0.0, 1e-300)]) {
        let (x, y) = (Axis::round(range, 5.0), Axis::round(range, 1.0));
        let plot = Plot { from: (40.0, 10.0), to: (240.0, 90.0), x, y };
        let mut canvas = Canvas::new((300.0, 120.0));
        plot.draw(&mut canvas, |_| Ok(())).unwrap();
        let svg = canvas.finish();
        for line in tags(&svg, "line", "#e4e7ea") {
            let inside = |name, from, to| (from..=to).contains(&number_of(line, name));
            assert!(inside("x1", 40.0, 240.0) && inside("x2", 40.0, 240.0), "{range:?}: {line}");
            assert!(inside("y1", 10.0, 90.0) && inside("y2", 10.0, 90.0), "{range:?}: {line}");
        }
        assert!(!svg.contains("NaN") && words(&svg).len() <= 5 + 2, "{range:?}: {svg}");
    }
}

#[test]
fn a_chart_has_round_values_at_their_places() {
    let (x, y) = (Axis::round((0.0, 1.0), 6.0), Axis::labelled((0.0, 2.0), vec![]));
    let plot = Plot { from: (40.0, 10.0), to: (240.0, 90.0), x, y };
    assert_eq!(plot.at(0.5, 0.5), (140.0, 70.0));
    let mut canvas = Canvas::new((300.0, 120.0));
    plot.draw(&mut canvas, |_| Ok(())).unwrap();
    let svg = canvas.finish();
    assert_eq!(words(&svg), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
    let places: Vec<f64> = tags(&svg, "text", "").iter().map(|tag| number_of(tag, "x")).collect();
    assert_eq!(places, [40.0, 80.0, 120.0, 160.0, 200.0, 240.0]);
}

#[test]
fn a_text_too_wide_is_cut_with_an_ellipsis() {
    assert_eq!(style::fitted("short", 10.0, 100.0), "short");
    let cut = style::fitted("a name that is much too long", 10.0, 60.0);
    assert!(cut.ends_with('…') && style::text_width(&cut, 10.0) <= 60.0, "{cut}");
    assert_eq!(style::fitted("原画", 10.0, 3.0), "…");
}

#[test]
fn reasons_have_as_many_lines_as_they_need() {
    let lines = |reasons: &[&str], width| {
        let reasons: Vec<String> = reasons.iter().map(|reason| (*reason).into()).collect();
        style::lines(&reasons, 10.0, width)
    };
    assert_eq!(lines(&["fill", "Spine +6", "12 %"], 200.0), ["fill · Spine +6 · 12 %"]);
    assert_eq!(lines(&["fill", "Spine +6", "12 %"], 75.0), ["fill · Spine +6", "12 %"]);
    assert_eq!(lines(&["a joint of a long name"], 60.0).len(), 1, "cut, not lost");
    assert!(lines(&[], 60.0).is_empty());
}

#[cfg(feature = "pictures")]
#[test]
fn a_png_has_the_size_of_its_svg_times_the_scale() {
    let svg = SheetPlot::default().draw(&sheet(), None, None).unwrap();
    let png = png_from_svg(&svg, 0.5).unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!(png[16..20], 480u32.to_be_bytes(), "width");
    has_setting_error(png_from_svg(&svg, 0.0), "scale");
    has_setting_error(png_from_svg(&svg, f32::NAN), "scale");
    assert!(png_from_svg(&svg, 1e-6).is_err() && png_from_svg(&svg, 1e6).is_err());
    assert!(png_from_svg("no svg", 1.0).is_err());
}

#[cfg(feature = "pdf")]
#[test]
fn a_pdf_is_one_page_of_the_size_of_its_svg_and_knows_no_date() {
    let svg = SheetPlot::default().draw(&sheet(), None, None).unwrap();
    let height = number_of(svg.lines().next().unwrap(), "height");
    let pdf = pdf_from_svg(&svg).unwrap();
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.starts_with("%PDF-1."));
    let page = format!("/MediaBox[0 0 720 {}]", 0.75 * height);
    assert_eq!(text.matches(&page).count(), 1, "{page}");
    assert!(!text.contains("Date"));
    assert_eq!(pdf_from_svg(&svg).unwrap(), pdf);
    assert!(pdf_from_svg("no svg").is_err());
}
