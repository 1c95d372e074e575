//! Tests the curves and maps of studies.

use super::*;
use genga_lab::study::{Cell, Grid, Measure, Plateau};

/// Returns a grid of turns, and of totals ten times as large.
fn grid(x: &str, y: Option<&str>, union: &[f64]) -> Grid {
    let cell = |union: &f64| Cell { values: vec![*union, 10.0 * union], seconds: 2.0, keys: None };
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

/// Returns the names of some clips.
fn called(clips: usize) -> Vec<String> {
    (1..=clips).map(|at| format!("clip-{at}")).collect()
}

fn curves_of(plot: &StudyPlot, grids: &[Grid]) -> Result<String, Error> {
    plot.draw(&called(grids.len()), grids)
}

fn map_of(grids: &[Grid], plateaus: Option<&[Option<Plateau>; 2]>) -> Result<String, Error> {
    HeatMap::default().draw(&called(grids.len()), grids, plateaus)
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
        has_setting_error(curves_of(&plot, &[small()]), name);
    }
    let says = |plot: StudyPlot, grids: &[Grid], says: &str| {
        let said = curves_of(&plot, grids).unwrap_err().to_string();
        assert!(said.contains(says), "{said}");
    };
    says(StudyPlot::default(), &[], "without a clip");
    says(StudyPlot { show: Measure::Genga, ..StudyPlot::default() }, &[small()], "genga was not");
    let paper = StudyPlot { paper: true, ..StudyPlot::default() };
    for x in ["filter.width=0.1s,0.2s", "turns.steady=10,20"] {
        let other = grid(x, Some("turns.persistence=5,10"), &[1.0; 4]);
        has_setting_error(curves_of(&paper, std::slice::from_ref(&other)), "paper");
        has_setting_error(paper.fits(&other.x, other.y.as_ref()), "paper");
        assert!(StudyPlot::default().fits(&other.x, other.y.as_ref()).is_ok());
    }
    has_setting_error(paper.fits(&small().x, None), "paper");
    assert!(paper.fits(&small().x, small().y.as_ref()).is_ok());
}

#[test]
fn a_study_has_a_line_a_value_and_the_papers_marks_beside() {
    let plot = StudyPlot { paper: true, ..StudyPlot::default() };
    let svg = curves_of(&plot, &[small()]).unwrap();
    assert_eq!(curves(&svg).len(), 2);
    assert_eq!(tags(&svg, "circle", "fill=\"#ffffff\"").len(), 6 + 1, "six values and the legend");
    assert!(words(&svg).contains(&"filter.width (source frames)  フィルタの適用範囲"));
    let svg = curves_of(&StudyPlot::default(), &[small()]).unwrap();
    assert_eq!(tags(&svg, "circle", "fill=\"#ffffff\"").len(), 0);
}

#[test]
fn a_mark_of_the_paper_stands_where_the_same_count_would() {
    // The widths are unordered, as a list may be written.
    let table_1 = [64.0, 52.0, 99.0, 75.0, 80.0, 71.0];
    let grid = grid("filter.width=30,10,20", Some("turns.persistence=5,10"), &table_1);
    let plot = StudyPlot { paper: true, ..StudyPlot::default() };
    let svg = curves_of(&plot, &[grid]).unwrap();
    let color = |tag: &str| tag.split("stroke=").nth(1).unwrap()[..9].to_owned();
    let points = |line: &str| -> Vec<[f64; 2]> {
        let points = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        let number = |point: &str, at: usize| point.split(',').nth(at).unwrap().parse().unwrap();
        points.split_whitespace().map(|point| [0, 1].map(|at| number(point, at))).collect()
    };
    let is_on_its_line = |ring: &&&str| {
        let at = ["cx", "cy"].map(|name| number_of(ring, name));
        let own = curves(&svg).into_iter().filter(|line| color(line) == color(ring));
        let mut places = own.flat_map(points);
        places.any(|point| (point[0] - at[0]).abs() + (point[1] - at[1]).abs() < 0.3)
    };
    // The ring in the legend is on no line.
    let rings = tags(&svg, "circle", "fill=\"#ffffff\"");
    assert_eq!(rings.len(), 6 + 1);
    assert_eq!(rings.iter().filter(is_on_its_line).count(), 6);
    for line in curves(&svg) {
        assert!(
            points(line).iter().map(|point| point[0]).is_sorted(),
            "it runs to the right: {line}"
        );
    }
}

#[test]
fn a_study_draws_the_measure_it_is_asked_for() {
    let draw = |show| curves_of(&StudyPlot { show, ..StudyPlot::default() }, &[small()]).unwrap();
    assert!(words(&draw(Measure::Total)).contains(&"800"));
    assert!(
        words(&draw(Measure::Total)).contains(&"Sum of the keys of all joints  全関節の候補の合計")
    );
    assert!(!words(&draw(Measure::Turns)).contains(&"800"));
    let zero = grid("filter.width=0", None, &[0.0]);
    assert!(curves_of(&StudyPlot::default(), &[zero]).is_ok());
}

#[test]
fn few_clips_are_thin_lines_behind_their_median_and_more_are_a_band() {
    let clip = |value: f64| grid("filter.width=10,20,30", None, &[value, value + 1.0, value]);
    let few = [clip(1.0), clip(9.0), clip(5.0)];
    let svg = curves_of(&StudyPlot::default(), &few).unwrap();
    assert_eq!((curves(&svg).len(), tags(&svg, "polygon", "fill-opacity").len()), (3 + 1, 0));
    assert!(words(&svg).contains(&"each clip 各素材"));
    assert!(words(&svg).contains(&"3 clips: clip-1, clip-2, clip-3"));
    let heat = map_of(&few, None).unwrap();
    assert_eq!(words(&heat).iter().filter(|word| **word == "5").count(), 2 + 1, "cells and scale");
    assert!(words(&heat).contains(&"median 中央値, number"));
    let many = [few.as_slice(), &[clip(7.0), clip(3.0)]].concat();
    let svg = curves_of(&StudyPlot::default(), &many).unwrap();
    let bands = tags(&svg, "polygon", "fill-opacity");
    assert_eq!((curves(&svg).len(), bands.len()), (1, 1 + 1), "a band, and that of the legend");
    assert!(words(&svg).contains(&"quartiles 四分位"));
    // The band reaches from 3 to 7 round 5: as far above the median as below it.
    let y = |tag: &str| -> Vec<f64> {
        let points = tag.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        points.split([' ', ',']).skip(1).step_by(2).map(|y| y.parse().unwrap()).collect()
    };
    let (band, line) = (y(bands[0]), y(curves(&svg)[0]));
    assert!((line[0] - band[0] - (band[5] - line[0])).abs() < 0.3, "{band:?} {line:?}");
    assert!(line[0] - band[0] > 20.0);
}

#[test]
fn clips_of_other_lengths_compare_by_the_second() {
    let clip = |value: f64, seconds: f64| {
        let mut grid = grid("filter.width=10,20", None, &[value; 2]);
        grid.cells.iter_mut().for_each(|cell| cell.seconds = seconds);
        grid
    };
    let clips = [clip(6.0, 2.0), clip(60.0, 20.0)];
    let plot = StudyPlot { per_second: true, ..StudyPlot::default() };
    let svg = curves_of(&plot, &clips).unwrap();
    let title = "Turns of the whole body a second  毎秒の全身の変わり目";
    assert!(words(&svg).contains(&title));
    assert!(words(&svg).contains(&format!("{title} (1/s)").as_str()));
    // All three lines coincide.
    let lines: Vec<_> = curves(&svg).iter().map(|line| line.split('"').nth(1).unwrap()).collect();
    assert_eq!((lines.len(), lines[0] == lines[1], lines[1] == lines[2]), (3, true, true));
    let map = HeatMap { per_second: true, ..HeatMap::default() };
    let svg = map.draw(&called(2), &clips, None).unwrap();
    assert_eq!(words(&svg).iter().filter(|word| **word == "3").count(), 2 + 2, "cells and scale");
    for plot in [
        StudyPlot { show: Measure::PeakSsd, ..plot.clone() },
        StudyPlot { show: Measure::GengaPerSecond, ..plot.clone() },
        StudyPlot { paper: true, ..plot },
    ] {
        has_setting_error(plot.validate(), "per_second");
    }
}

#[test]
fn words_stand_on_an_axis_one_after_the_other() {
    let kinds = grid("filter.kind=box,ideal,gaussian", None, &[3.0, 5.0, 4.0]);
    for svg in [
        curves_of(&StudyPlot::default(), std::slice::from_ref(&kinds)),
        map_of(std::slice::from_ref(&kinds), None),
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
    let svg = curves_of(&StudyPlot::default(), &[many]).unwrap();
    assert_eq!(curves(&svg).len(), 100);
    let named = ["1", "18", "35", "52", "69", "100"];
    let is_named = |y: &String| words(&svg).contains(&y.as_str());
    let found: Vec<String> = (10..=100).map(|y| y.to_string()).filter(is_named).collect();
    assert_eq!(found, named[1..]);
}

#[test]
fn a_map_has_a_number_in_each_cell_that_has_room() {
    let svg = map_of(&[small()], None).unwrap();
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
    let svg = map_of(&[fine], None).unwrap();
    assert!(words(&svg).len() < 120, "no room for numbers");
    let wide = grid("filter.width=1..5000:1", None, &[1.0; 5000]);
    assert!(map_of(&[wide], None).unwrap_err().to_string().contains("larger steps"));
    assert!(map_of(&[], None).is_err());
    assert!(
        HeatMap { show: Measure::Genga, ..HeatMap::default() }
            .draw(&called(1), &[small()], None)
            .is_err()
    );
}

#[test]
fn a_small_study_looks_as_it_did() {
    let plot = StudyPlot { width: 400, height: 300, ..StudyPlot::default() };
    insta::assert_snapshot!(curves_of(&plot, &[small()]).unwrap());
}

#[test]
fn a_plateau_is_edged_where_it_ends_and_the_recipes_cell_is_marked() {
    let mut grid = small();
    grid.own = Some(3);
    // Columns 0 1 | 2 3 from left to right, each from below: three cells in the form of an L.
    let plateau = Plateau { seed: 0, cells: vec![0, 1, 2], keys: 7 };
    let svg = map_of(&[grid], Some(&[Some(plateau), None])).unwrap();
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
    insta::assert_snapshot!(map_of(&[small()], None).unwrap());
}

#[test]
fn a_map_that_nobody_could_look_at_is_refused_before_the_work() {
    let axis = |text: &str| text.parse::<genga_lab::study::Axis>().unwrap();
    let (width, many) = (axis("filter.width=1..9:1"), axis("turns.persistence=1..1001:1"));
    assert!(HeatMap::fits(&width, None).is_ok());
    for said in [HeatMap::fits(&width, Some(&many)), HeatMap::fits(&many, None)] {
        assert!(said.unwrap_err().to_string().contains("take larger steps"));
    }
}

#[test]
fn the_letters_of_studies_can_be_read_in_print() {
    let axis = |name: &str, count: usize| {
        let values: Vec<String> = (1..=count).map(|at| (5 * at).to_string()).collect();
        format!("{name}={}", values.join(","))
    };
    for (columns, rows) in [(2, 2), (12, 6), (60, 20), (300, 3)] {
        let (x, y) = (axis("filter.width", columns), axis("turns.persistence", rows));
        let counts: Vec<f64> = (0..columns * rows).map(|at| 40.0 + (at * 37 % 90) as f64).collect();
        let grid = grid(&x, Some(&y), &counts);
        for grids in [vec![grid.clone()], vec![grid; 5]] {
            let name = format!("{columns} × {rows}, {} clips", grids.len());
            print::check(
                &format!("study {name}"),
                &curves_of(&StudyPlot::default(), &grids).unwrap(),
            );
            print::check(&format!("map {name}"), &map_of(&grids, None).unwrap());
        }
    }
}
