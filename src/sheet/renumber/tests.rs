use std::collections::HashMap;

use proptest::prelude::*;

use crate::cases::cases;
use crate::sheet::{Drawing, Layer, Numbers, Role, Sheet, Source, Why};
use crate::time::{Clock, Frame, FrameRate};

/// Five frames a koma.
fn clock() -> Clock {
    Clock { first: Frame(0), frame_rate: FrameRate::new(120.0).unwrap(), koma_rate: 24.0 }
}

/// Creates a sheet of genga, `true`, and inbetweens at some places.
fn sheet(drawings: &[(f64, bool)]) -> Sheet {
    let mut sheet = Sheet::on_ones(clock(), 0);
    let drawing = |(place, is_genga): &(f64, bool)| {
        let role = if *is_genga { Role::Genga } else { Role::Inbetween };
        Drawing::new(Source::At(*place), role, Why::default())
    };
    sheet.layers[0].drawings = drawings.iter().map(drawing).collect();
    sheet
}

fn genga(places: &[f64]) -> Sheet {
    let drawings: Vec<(f64, bool)> = places.iter().map(|place| (*place, true)).collect();
    sheet(&drawings)
}

fn after(before: &Sheet, mut now: Sheet) -> Sheet {
    now.keep_numbers(before);
    now.check_numbers().unwrap();
    now
}

fn numbers(sheet: &Sheet) -> String {
    let numbers: Vec<String> = sheet.layers[0].numbers().iter().map(ToString::to_string).collect();
    numbers.join(" ")
}

fn genga_numbers(sheet: &Sheet) -> String {
    let numbers = sheet.layers[0].genga_numbers();
    let word = |number: &Option<_>| number.as_ref().map_or("-".into(), ToString::to_string);
    numbers.iter().map(word).collect::<Vec<String>>().join(" ")
}

#[test]
fn a_drawing_that_comes_between_gets_a_letter_and_one_that_goes_leaves_a_gap() {
    let first = genga(&[0.0, 50.0, 100.0, 150.0]);
    assert_eq!(numbers(&first), "1 2 3 4");
    let second = after(&first, genga(&[0.0, 52.0, 100.0, 120.0, 140.0, 190.0]));
    assert_eq!(numbers(&second), "1 2 3 3a 3b 5");
    assert_eq!(second.layers[0].gone.len(), 1, "4 went");
    let third =
        after(&second, genga(&[0.0, 52.0, 100.0, 110.0, 120.0, 130.0, 140.0, 145.0, 160.0]));
    assert_eq!(numbers(&third), "1 2 3 3za 3a 3aa 3b 3c 4a");
    let fourth = after(&third, genga(&[0.0, 100.0, 150.0, 190.0, 240.0]));
    assert_eq!(numbers(&fourth), "1 3 4 5 6", "4 and 5 are back");
    let earlier = after(&first, genga(&[-40.0, -20.0, 0.0]));
    assert_eq!(numbers(&earlier), "0a 0b 1");
}

#[test]
fn genga_have_numbers_of_their_own_that_stay() {
    let first = sheet(&[(0.0, true), (20.0, false), (40.0, false), (60.0, true), (80.0, true)]);
    let second = after(
        &first,
        sheet(&[(0.0, true), (20.0, true), (40.0, false), (60.0, false), (80.0, true)]),
    );
    assert_eq!(numbers(&second), "1 2 3 4 5");
    assert_eq!(genga_numbers(&second), "1 1a - - 3");
    let third = after(&second, first.clone());
    assert_eq!(genga_numbers(&third), "1 - - 2 3", "2 is a genga again");
}

#[test]
fn the_same_drawings_have_no_numbers_but_their_places() {
    let first = sheet(&[(0.0, true), (20.0, false), (40.0, true)]);
    let second = after(&first, first.clone());
    assert_eq!(second, first);
    assert!(second.layers[0].is_plainly_numbered());
}

#[test]
fn a_drawing_is_shared_with_the_nearest_and_less_than_half_a_koma_away() {
    let first = genga(&[0.0, 50.0]);
    assert_eq!(numbers(&after(&first, genga(&[2.4, 47.6]))), "1 2");
    assert_eq!(numbers(&after(&first, genga(&[2.5, 47.4]))), "1a 1b");
    assert_eq!(numbers(&after(&first, genga(&[-2.0, 1.0, 48.0, 50.0]))), "0a 1 1a 2");
    assert_eq!(numbers(&after(&first, genga(&[-1.0, 2.0, 49.0, 52.0]))), "1 1a 2 3");
}

#[test]
fn drawings_of_a_loop_that_begins_elsewhere_still_ascend() {
    let first = genga(&[10.0, 50.0, 90.0]);
    assert_eq!(numbers(&after(&first, genga(&[90.0, 10.0, 50.0]))), "0a 1 2");
    assert_eq!(numbers(&after(&first, genga(&[50.0, 90.0, 10.0]))), "2 3 4");
}

#[test]
fn a_layer_with_other_joints_begins_anew() {
    let first = genga(&[0.0, 50.0]);
    let mut now = genga(&[0.0, 20.0, 50.0]);
    now.layers[0].joints = vec!["Hand".into()];
    let now = after(&first, now);
    assert_eq!(numbers(&now), "1 2 3");
    assert!(now.compare_numbers(&first).is_empty());
}

#[test]
fn both_numbers_of_each_drawing_are_told() {
    let first = sheet(&[(0.0, true), (20.0, false), (40.0, true)]);
    let second = after(&first, sheet(&[(0.0, true), (30.0, true), (41.0, true)]));
    let told = |now: &Sheet| -> Vec<String> {
        let both = |numbers: &Numbers| {
            let word = |number: &Option<_>| number.as_ref().map_or("-".into(), ToString::to_string);
            let words: [String; 2] = [word(&numbers.drawing), word(&numbers.genga)];
            words.join("/")
        };
        let rows = now.compare_numbers(&first);
        rows.iter()
            .map(|row| format!("{} {}>{}", row.place, both(&row.old), both(&row.new)))
            .collect()
    };
    assert_eq!(told(&second), ["0 1/1>1/1", "20 2/->-/-", "30 -/->2a/1a", "41 3/2>3/2"]);
    let anew = sheet(&[(0.0, true), (30.0, true), (41.0, true)]);
    assert_eq!(told(&anew), ["0 1/1>1/1", "20 2/->-/-", "30 -/->2/2", "41 3/2>3/3"]);
}

#[test]
fn numbers_given_by_hand_are_for_all_and_ascend() {
    let mut sheet = genga(&[0.0, 20.0]);
    let given = |drawing: &str, genga: &str| Numbers {
        drawing: Some(drawing.parse().unwrap()),
        genga: Some(genga.parse().unwrap()),
    };
    sheet.layers[0].drawings[1].numbers = given("7", "2");
    let said = sheet.check_numbers().unwrap_err().to_string();
    assert!(said.contains("layer A: drawing 1 ") && said.contains("name"), "{said}");
    sheet.layers[0].drawings[0].numbers = given("7a", "1");
    let said = sheet.check_numbers().unwrap_err().to_string();
    assert!(said.contains("7a stands before 7"), "{said}");
    sheet.layers[0].drawings[0].numbers = given("6a", "2");
    assert!(sheet.check_numbers().unwrap_err().to_string().contains("2 stands before 2"));
    sheet.layers[0].drawings[0].numbers = given("6a", "1a");
    assert!(sheet.check_numbers().is_ok());
}

/// The drawings of a sheet by koma of the take: whether there is one and whether it is a genga, and how many frames off
/// the koma it is.
type Taken = Vec<(Option<bool>, f64)>;

fn taken() -> impl Strategy<Value = Taken> {
    prop::collection::vec((prop::option::of(any::<bool>()), -1.2..1.2), 0..24)
}

fn of_taken(taken: &Taken) -> (Sheet, Vec<usize>) {
    let shown =
        taken.iter().enumerate().filter_map(|(koma, (role, off))| Some((koma, (*role)?, off)));
    let (koma, drawings): (Vec<usize>, Vec<(f64, bool)>) =
        shown.map(|(koma, is_genga, off)| (koma, (5.0 * koma as f64 + off, is_genga))).unzip();
    (sheet(&drawings), koma)
}

proptest! {
    #![proptest_config(cases(128, 1024))]

    #[test]
    fn a_drawing_has_one_number_in_all_sheets_and_numbers_ascend(
        takes in prop::collection::vec(taken(), 1..8),
    ) {
        let (mut numbers, mut genga) = (HashMap::new(), HashMap::new());
        let (mut koma_of, mut koma_of_genga) = (HashMap::new(), HashMap::new());
        let mut before: Option<Sheet> = None;
        for taken in &takes {
            let (mut sheet, koma) = of_taken(taken);
            if let Some(before) = &before {
                sheet.keep_numbers(before);
            }
            let layer: &Layer = &sheet.layers[0];
            prop_assert!(layer.numbers().is_sorted_by(|a, b| a < b), "{:?}", layer.numbers());
            let kept: Vec<_> = layer.genga_numbers().into_iter().flatten().collect();
            prop_assert!(kept.is_sorted_by(|a, b| a < b), "{:?}", kept);
            for (koma, (number, own)) in koma.iter().zip(layer.numbers().into_iter().zip(layer.genga_numbers())) {
                prop_assert_eq!(numbers.entry(*koma).or_insert(number.clone()), &number);
                prop_assert_eq!(koma_of.entry(number).or_insert(*koma), koma);
                let Some(own) = own else { continue };
                prop_assert_eq!(genga.entry(*koma).or_insert(own.clone()), &own);
                prop_assert_eq!(koma_of_genga.entry(own).or_insert(*koma), koma);
            }
            before = Some(sheet);
        }
    }

    #[test]
    fn numbers_ascend_after_any_sheet_however_its_drawings_lie(
        sheets in prop::collection::vec(
            prop::collection::vec((0.0..60.0f64, any::<bool>()), 0..20), 1..6),
    ) {
        let mut before = Sheet::on_ones(clock(), 0);
        for drawings in &sheets {
            let now = after(&before, sheet(drawings));
            prop_assert!(now.compare_numbers(&before).len() >= drawings.len());
            let numbers = now.layers[0].numbers();
            prop_assert!(numbers.is_sorted_by(|a, b| a < b), "{:?}", numbers);
            let gone = now.layers[0].gone.iter().map(|gone| &gone.drawing);
            prop_assert!(gone.clone().all(|gone| !numbers.contains(gone)));
            before = now;
        }
    }
}
