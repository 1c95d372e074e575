//! Curves and maps of studies.

use super::*;
use crate::study::{Cell, Grid, Measure, Plateau};

/// A grid of turns and of the total, ten times as large.
fn grid(x: &str, y: Option<&str>, union: &[f64]) -> Grid {
    let cell = |union: &f64| Cell { values: vec![*union, 10.0 * union], keys: None };
    let grid = Grid {
        x: x.parse().unwrap(),
        y: y.map(|y| y.parse().unwrap()),
        measures: vec![Measure::Turns, Measure::Total],
        frames_in_koma: 5.0,
        own: None,
        cells: union.iter().map(cell).collect(),
    };
    assert_eq!(grid.cells.len(), grid.x.len() * grid.rows());
    grid
}

fn small() -> Grid {
    grid("filter.width=10,20", Some("turns.persistence=5,10"), &[90.0, 60.0, 70.0, 40.0])
}

#[test]
fn a_study_plot_refuses_what_cannot_be() {
    for (plot, name) in [
        (StudyPlot { width: 0, ..StudyPlot::default() }, "width"),
        (StudyPlot { height: 50_000, ..StudyPlot::default() }, "height"),
    ] {
        has_setting_error(plot.validate(), name);
        has_setting_error(plot.draw(&[small()]), name);
    }
    let says = |plot: StudyPlot, grids: &[Grid], says: &str| {
        let said = plot.draw(grids).unwrap_err().to_string();
        assert!(said.contains(says), "{said}");
    };
    says(StudyPlot::default(), &[], "without a clip");
    says(StudyPlot { show: Measure::Genga, ..StudyPlot::default() }, &[small()], "genga was not");
    let paper = StudyPlot { paper: true, ..StudyPlot::default() };
    for x in ["filter.width=0.1s,0.2s", "turns.steady=10,20"] {
        let other = grid(x, Some("turns.persistence=5,10"), &[1.0; 4]);
        has_setting_error(paper.draw(std::slice::from_ref(&other)), "paper");
        has_setting_error(paper.fits(&other.x, other.y.as_ref()), "paper");
        assert!(StudyPlot::default().fits(&other.x, other.y.as_ref()).is_ok());
    }
    has_setting_error(paper.fits(&small().x, None), "paper");
    assert!(paper.fits(&small().x, small().y.as_ref()).is_ok());
}

#[test]
fn a_study_has_a_line_a_value_and_the_papers_marks_beside() {
    let plot = StudyPlot { paper: true, ..StudyPlot::default() };
    let svg = plot.draw(&[small()]).unwrap();
    assert_eq!(curves(&svg).len(), 2);
    assert_eq!(tags(&svg, "circle", "fill=\"#ffffff\"").len(), 6 + 1, "six values and the legend");
    assert!(words(&svg).contains(&"filter.width (source frames)  フィルタの適用範囲"));
    let svg = StudyPlot::default().draw(&[small()]).unwrap();
    assert_eq!(tags(&svg, "circle", "fill=\"#ffffff\"").len(), 0);
}

#[test]
fn a_mark_of_the_paper_stands_where_the_same_count_would() {
    // Widths of no order, as a list may be written.
    let table_1 = [64.0, 52.0, 99.0, 75.0, 80.0, 71.0];
    let grid = grid("filter.width=30,10,20", Some("turns.persistence=5,10"), &table_1);
    let svg = StudyPlot { paper: true, ..StudyPlot::default() }.draw(&[grid]).unwrap();
    let place = |tag: &str| ["cx", "cy"].map(|name| number_of(tag, name));
    let (rings, discs): (Vec<&str>, Vec<&str>) =
        tags(&svg, "circle", "").into_iter().partition(|tag| tag.contains("fill=\"#ffffff\""));
    // The ring of the legend has no disc.
    let color = |tag: &str, name: &str| tag.split(name).nth(1).unwrap()[..8].to_owned();
    let is_on_a_disc = |ring: &&&str| {
        discs.iter().any(|disc| {
            let way = place(ring).iter().zip(place(disc)).map(|(a, b)| (a - b).abs()).sum::<f64>();
            way < 0.3 && color(ring, "stroke=") == color(disc, "fill=")
        })
    };
    assert_eq!(rings.len(), 6 + 1);
    assert_eq!(rings.iter().filter(is_on_a_disc).count(), 6);
    for line in curves(&svg) {
        let points = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        let x = |point: &str| point.split(',').next().unwrap().parse::<f64>().unwrap();
        assert!(points.split_whitespace().map(x).is_sorted(), "a line runs to the right: {line}");
    }
}

#[test]
fn a_study_draws_the_measure_it_is_asked_for() {
    let draw = |show| StudyPlot { show, ..StudyPlot::default() }.draw(&[small()]).unwrap();
    assert!(words(&draw(Measure::Total)).contains(&"800"));
    assert!(words(&draw(Measure::Total)).contains(&"Keys of all joints  全関節の原画の合計"));
    assert!(!words(&draw(Measure::Turns)).contains(&"800"));
    let zero = grid("filter.width=0", None, &[0.0]);
    assert!(StudyPlot::default().draw(&[zero]).is_ok());
}

#[test]
fn several_clips_are_thin_lines_behind_their_median() {
    let clip = |value: f64| grid("filter.width=10,20,30", None, &[value, value + 1.0, value]);
    let svg = StudyPlot::default().draw(&[clip(1.0), clip(9.0), clip(5.0)]).unwrap();
    assert_eq!(curves(&svg).len(), 3 + 1);
    let heat = HeatMap::default().draw(&[clip(1.0), clip(9.0), clip(5.0)], None).unwrap();
    let words = words(&heat);
    assert_eq!(words.iter().filter(|word| **word == "5").count(), 2 + 1, "two cells and the scale");
    assert!(words.contains(&"median of 3 clips"));
}

#[test]
fn words_stand_on_an_axis_one_after_the_other() {
    let kinds = grid("filter.kind=box,ideal,gaussian", None, &[3.0, 5.0, 4.0]);
    for svg in [
        StudyPlot::default().draw(std::slice::from_ref(&kinds)),
        HeatMap::default().draw(std::slice::from_ref(&kinds), None),
    ] {
        let svg = svg.unwrap();
        for kind in ["box", "ideal", "gaussian"] {
            assert!(words(&svg).contains(&kind), "{kind}");
        }
    }
}

#[test]
fn of_many_lines_a_few_are_named() {
    let many = grid("filter.width=1,2", Some("turns.persistence=1..100:1"), &[7.0; 200]);
    let svg = StudyPlot::default().draw(&[many]).unwrap();
    assert_eq!(curves(&svg).len(), 100);
    let named = ["1", "18", "35", "52", "69", "100"];
    let is_named = |y: &String| words(&svg).contains(&y.as_str());
    let found: Vec<String> = (10..=100).map(|y| y.to_string()).filter(is_named).collect();
    assert_eq!(found, named[1..]);
}

#[test]
fn a_map_has_a_number_in_each_cell_that_has_room() {
    let svg = HeatMap::default().draw(&[small()], None).unwrap();
    for value in ["90", "60", "70", "40"] {
        assert!(words(&svg).contains(&value), "{value}");
    }
    // The first setting runs to the right, the second upwards.
    let place = |word: &str| {
        let tag = svg.lines().find(|line| line.ends_with(&format!(">{word}</text>"))).unwrap();
        (number_of(tag, "x"), number_of(tag, "y"))
    };
    assert!(place("70").0 > place("60").0, "width 20 stands right of 10");
    assert!(place("60").1 < place("70").1, "persistence 10 stands above 5");
    let values: Vec<f64> = (0..10_000).map(f64::from).collect();
    let fine = grid("filter.width=1..100:1", Some("turns.persistence=1..100:1"), &values);
    let svg = HeatMap::default().draw(&[fine], None).unwrap();
    assert!(words(&svg).len() < 120, "no room for numbers");
    let wide = grid("filter.width=1..5000:1", None, &[1.0; 5000]);
    assert!(
        HeatMap::default().draw(&[wide], None).unwrap_err().to_string().contains("larger steps")
    );
    assert!(HeatMap::default().draw(&[], None).is_err());
    assert!(HeatMap { show: Measure::Genga }.draw(&[small()], None).is_err());
}

#[test]
fn a_small_study_looks_as_it_did() {
    let plot = StudyPlot { width: 400, height: 300, ..StudyPlot::default() };
    insta::assert_snapshot!(plot.draw(&[small()]).unwrap());
}

#[test]
fn a_plateau_is_edged_where_it_ends_and_the_recipes_cell_is_marked() {
    let mut grid = small();
    grid.own = Some(3);
    // Columns 0 1 | 2 3 from left to right, each from below: three cells in the form of an L.
    let plateau = Plateau { seed: 0, cells: vec![0, 1, 2], keys: 7 };
    let svg = HeatMap::default().draw(&[grid], Some(&[Some(plateau), None])).unwrap();
    let edge = tags(&svg, "line", &format!("stroke=\"{GENGA}\""));
    assert_eq!(edge.len(), 8 + 1, "its eight outer sides and the legend");
    let marks = tags(&svg, "circle", GENGA);
    assert_eq!(marks.len(), 2, "the cell and the legend");
    // In the upper right cell, so right of and above the middle of the four.
    let is_cell = |tag: &&str| number_of(tag, "height") > 25.0 && number_of(tag, "width") < 125.0;
    let middle = ["x", "y"].map(|name| {
        let cells = tags(&svg, "rect", "").into_iter().filter(is_cell);
        cells.map(|tag| number_of(tag, name)).fold(f64::NEG_INFINITY, f64::max)
    });
    assert!(number_of(marks[0], "cx") > middle[0] && number_of(marks[0], "cy") < middle[1]);
    assert!(words(&svg).contains(&"same keys of the layer 原画が同じ"));
    assert!(!words(&svg).contains(&"nearly the same ほぼ同じ"));
}

#[test]
fn a_small_map_looks_as_it_did() {
    insta::assert_snapshot!(HeatMap::default().draw(&[small()], None).unwrap());
}

#[test]
fn a_map_that_nobody_could_look_at_is_refused_before_the_work() {
    let axis = |text: &str| text.parse::<crate::study::Axis>().unwrap();
    let (width, many) = (axis("filter.width=1..9:1"), axis("turns.persistence=1..1001:1"));
    assert!(HeatMap::fits(&width, None).is_ok());
    for said in [HeatMap::fits(&width, Some(&many)), HeatMap::fits(&many, None)] {
        assert!(said.unwrap_err().to_string().contains("take larger steps"));
    }
}
