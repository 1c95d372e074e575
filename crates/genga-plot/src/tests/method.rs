//! Tests the pictures that show the method: a skeleton's hierarchy, the spacing of an interval.

use super::figures::{said, walk};
use super::*;

const INBETWEEN: &str = "#969ca3";
const WALL: &str = "#0068b0";

#[test]
fn a_skeleton_has_each_joint_on_the_figure_and_in_the_tree() {
    let svg = SkeletonPlot::default().draw("walk", &walker(3)).unwrap();
    let words = said(std::slice::from_ref(&svg));
    for (at, name) in ["Hips", "Head", "LeftArm", "RArm", "LeftFoot", "RFoot"].iter().enumerate() {
        assert!(words.contains(&name.to_string()), "{name}: {words:?}");
        let number = (at + 1).to_string();
        let count = words.iter().filter(|word| **word == number).count();
        assert_eq!(count, 2, "{number} in the tree and on the figure");
    }
    assert_eq!(tags(&svg, "circle", "r=\"3.5\"").len(), 6);
    let facts = "6 joints 関節 · 1 end site · 3 channels · rest pose 基準姿勢";
    assert!(words.contains(&facts.to_owned()), "{words:?}");
    // Five children hang on the first joint, each by an elbow of three points.
    let elbows = tags(&svg, "polyline", "stroke=\"#b8bec5\"").into_iter();
    assert_eq!(elbows.filter(|line| line.matches(',').count() == 3).count(), 5);
}

#[test]
fn a_skeleton_is_shown_at_rest_wherever_the_motion_is() {
    let plot = SkeletonPlot::default();
    assert!(plot.draw("walk", &walker(1)).unwrap() == plot.draw("walk", &walker(30)).unwrap());
}

#[test]
fn numbers_that_would_lie_on_each_other_stand_in_the_tree_alone() {
    let mut joints = vec![joint("Hips", None, DVec3::ZERO, true)];
    joints.extend((0..5).map(|_| joint("Finger", Some(0), DVec3::new(0.0, 50.0, 0.0), false)));
    let clip = Clip::new(Skeleton { joints }, rate(24.0), Frame(0), 1, vec![0.0; 3]).unwrap();
    let words = said(&[SkeletonPlot::default().draw("hand", &clip).unwrap()]);
    let count = |number: &str| words.iter().filter(|word| *word == number).count();
    assert_eq!((count("2"), count("3"), count("6")), (2, 1, 1));
}

#[test]
fn a_skeleton_plot_refuses_what_cannot_be_drawn_and_says_what_it_leaves_out() {
    for (plot, name) in [
        (SkeletonPlot { figure_height: 39, ..SkeletonPlot::default() }, "figure_height"),
        (SkeletonPlot { most: 0, ..SkeletonPlot::default() }, "most"),
    ] {
        has_setting_error(plot.draw("walk", &walker(3)), name);
    }
    let message = SkeletonPlot::default().draw("walk", &walker(0)).unwrap_err().to_string();
    assert!(message.contains("no skeleton to draw"), "{message}");
    let plot = SkeletonPlot { most: 2, ..SkeletonPlot::default() };
    let words = said(&[plot.draw("walk", &walker(3)).unwrap()]);
    assert!(words.iter().any(|word| word.ends_with("the first 2 shown")), "{words:?}");
    assert!(words.contains(&"Head".to_owned()) && !words.contains(&"LeftArm".to_owned()));
}

/// Counts the circles of a look at a given x, in px.
fn circles(svg: &str, x: f64, look: &str) -> usize {
    let cx = format!("cx=\"{}\"", (10.0 * x).round() / 10.0);
    tags(svg, "circle", &cx).iter().filter(|circle| circle.contains(look)).count()
}

#[test]
fn an_inbetween_stands_at_its_place_with_a_ring_where_it_would_be_evenly() {
    let (clip, sheet) = walk();
    let ring = format!("fill=\"#ffffff\" stroke=\"{INBETWEEN}\"");
    let disc = format!("fill=\"{INBETWEEN}\"");
    // The interval lies from 108 to 716 px.
    let x = |share: f64| 108.0 + 608.0 * share;
    // From frame 0 on koma 0 to frame 4 on koma 3; frame 1 on koma 1 between them, a quarter of the way.
    let svg = SpacingPlot::default().draw(&clip, &[("walk", &sheet)], None, &[]).unwrap();
    assert_eq!(circles(&svg, x(1.0 / 3.0), &ring), 1);
    assert_eq!(circles(&svg, x(0.25), &disc), 2, "on the source and on the way");
    let genga = format!("fill=\"{GENGA}\"");
    assert_eq!((circles(&svg, x(0.0), &genga), circles(&svg, x(1.0), &genga)), (2, 2));
    // From frame 4 on koma 3 to frame 7 on koma 7; frame 5.5 on koma 6.
    let plot = SpacingPlot { genga: 2, ..SpacingPlot::default() };
    let svg = plot.draw(&clip, &[("walk", &sheet)], None, &[]).unwrap();
    assert_eq!((circles(&svg, x(0.75), &ring), circles(&svg, x(0.5), &disc)), (1, 2));
}

#[test]
fn a_row_a_sheet_and_the_walls_of_the_interval_on_the_speed() {
    let (clip, sheet) = walk();
    let mut speed = signals(8, 1, |frame, _| frame as f64);
    speed.first = Frame(0);
    let draw = |walls: &[Frame]| {
        let rows = [("one", &sheet), ("two", &sheet)];
        SpacingPlot::default().draw(&clip, &rows, Some((&speed, JointId(0))), walls).unwrap()
    };
    let svg = draw(&[Frame(2), Frame(6)]);
    let triangles = |svg: &str| tags(svg, "polygon", &format!("fill=\"{WALL}\"")).len();
    assert_eq!(triangles(&svg), 1 + 1, "that of frame 2 and of the legend");
    assert!(words(&svg).contains(&"one") && words(&svg).contains(&"two"));
    assert!(words(&svg).contains(&"speed 速度 (°/s)"));
    let svg = draw(&[Frame(6)]);
    assert_eq!(triangles(&svg), 0);
    assert!(!words(&svg).contains(&"wall 壁"));
}

#[test]
fn a_spacing_plot_refuses_an_interval_that_is_not_there() {
    let (clip, sheet) = walk();
    let rows = [("walk", &sheet)];
    for (plot, name) in [
        (SpacingPlot { width: 399, ..SpacingPlot::default() }, "width"),
        (SpacingPlot { genga: 0, ..SpacingPlot::default() }, "genga"),
        (SpacingPlot { genga: 3, ..SpacingPlot::default() }, "genga"),
    ] {
        has_setting_error(plot.draw(&clip, &rows, None, &[]), name);
    }
    let plot = SpacingPlot::default();
    assert!(plot.draw(&clip, &[], None, &[]).unwrap_err().to_string().contains("no sheet"));
    let speed = signals(8, 1, |_, _| 1.0);
    let far = plot.draw(&clip, &rows, Some((&speed, JointId(1))), &[]).unwrap_err();
    assert!(far.to_string().contains("no such joint"), "{far}");
}

#[test]
fn an_interval_in_which_nothing_moves_has_no_way() {
    let (_, sheet) = walk();
    let still = walker(1);
    let svg = SpacingPlot::default().draw(&still, &[("still", &sheet)], None, &[]).unwrap();
    let disc = format!("fill=\"{INBETWEEN}\"");
    assert_eq!(tags(&svg, "circle", &disc).len(), 1 + 1, "on the source, and in the legend");
}
