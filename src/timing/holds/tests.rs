use proptest::prelude::*;

use super::*;
use crate::sheet::{Role, Source, Why};
use crate::time::{Frame, FrameRate};

/// Four frames per koma.
fn clock() -> Clock {
    Clock { first: Frame(0), frame_rate: FrameRate::new(96.0).unwrap(), koma_rate: 24.0 }
}

/// Builds a layer on twos with genga at some drawings.
fn spaced(drawings: usize, genga: &[usize]) -> Layer {
    let drawing = |at: usize| {
        let role = match at {
            at if at == 0 || at + 1 == drawings => Role::End,
            at if genga.contains(&at) => Role::Genga,
            _ => Role::Inbetween,
        };
        Drawing::new(Source::At(8.0 * at as f64), role, Why::default())
    };
    Layer {
        name: "A".into(),
        joints: vec![],
        drawings: (0..drawings).map(drawing).collect(),
        exposures: (0..drawings).map(|drawing| Exposure { drawing, koma: 2 }).collect(),
        gone: vec![],
    }
}

/// Removes some inbetweens from the layer; the drawing before each holds over it.
fn without(spaced: &Layer, gone: &[usize]) -> Layer {
    let mut row = Row::new(spaced, spaced);
    for drawing in gone
        .iter()
        .rev()
        .filter(|at| !row.drawings[**at].drawing.role.is_kept())
        .copied()
        .collect::<Vec<_>>()
    {
        let OnScreen { koma, drawing: covered, .. } = row.drawings.remove(drawing);
        row.drawings[drawing - 1].koma += koma;
        row.drawings[drawing - 1].drawing.why.held_for += 1 + covered.why.held_for;
    }
    row.into_layer(spaced)
}

fn held(layer: &Layer, spaced: &Layer, holds: &[&str]) -> Layer {
    let holds: Vec<Hold> = holds.iter().map(|text| Hold::parse(text).unwrap()).collect();
    with_holds(layer, spaced, &holds, clock())
}

/// Returns the frame of each drawing and its number of koma.
fn row(layer: &Layer) -> Vec<(usize, usize)> {
    let index =
        |shown: &Exposure| (layer.drawings[shown.drawing].source.place() as usize, shown.koma);
    layer.exposures.iter().map(index).collect()
}

#[test]
fn a_longer_hold_covers_inbetweens_and_ends_at_the_next_genga() {
    let all = spaced(6, &[4]);
    let longer = |koma| row(&held(&all, &all, &[&format!("8:{koma}")]));
    assert_eq!(longer(3), [(0, 2), (8, 3), (24, 3), (32, 2), (40, 2)], "and leaves none of a koma");
    assert_eq!(longer(4), [(0, 2), (8, 4), (24, 2), (32, 2), (40, 2)]);
    assert_eq!(longer(5), [(0, 2), (8, 6), (32, 2), (40, 2)], "a koma more, or one would be left");
    assert_eq!(longer(99), [(0, 2), (8, 6), (32, 2), (40, 2)]);
    let why = &held(&all, &all, &["8:99"]).drawings[1].why;
    assert_eq!((why.hold_set, why.held_for), (true, 2));
}

#[test]
fn a_shorter_hold_is_taken_on_by_the_next_inbetween_and_not_by_a_genga() {
    let all = spaced(6, &[4]);
    let shorter = |frame| row(&held(&all, &all, &[&format!("{frame}:1")]));
    assert_eq!(shorter(8), [(0, 2), (8, 1), (16, 3), (24, 2), (32, 2), (40, 2)]);
    assert_eq!(shorter(24), row(&all), "a genga stays on its koma");
    assert_eq!(shorter(40), row(&all), "and the sheet as long as it is");
}

#[test]
fn from_a_shorter_hold_a_drawing_that_was_left_out_comes_back() {
    let all = spaced(6, &[4]);
    let layer = without(&all, &[1, 2, 3]);
    assert_eq!(row(&layer), [(0, 8), (32, 2), (40, 2)]);
    let back = |koma| {
        let back = held(&layer, &all, &[&format!("0:{koma}")]);
        let held_for = back.drawings.iter().map(|drawing| drawing.why.held_for);
        (row(&back), held_for.collect::<Vec<_>>())
    };
    let nearest = vec![(0, 4), (16, 4), (32, 2), (40, 2)];
    assert_eq!(back(4), (nearest, vec![1, 1, 0, 0]), "one of the others is under each");
    let earlier = vec![(0, 3), (8, 5), (32, 2), (40, 2)];
    assert_eq!(back(3), (earlier, vec![0, 2, 0, 0]), "of two as near the one that was on screen");
}

#[test]
fn a_hold_is_of_the_drawing_nearest_to_its_frame_and_of_none_far_from_all() {
    let all = spaced(6, &[4]);
    assert_eq!(held(&all, &all, &["11:3"]), held(&all, &all, &["8:3"]));
    let layer = without(&all, &[1, 2, 3]);
    assert_eq!(held(&layer, &all, &["16:1"]), layer, "four koma from any drawing");
}

#[test]
fn what_a_hold_takes_from_the_next_that_ones_own_hold_gets_back() {
    let all = spaced(6, &[5]);
    let both = row(&held(&all, &all, &["16:3", "8:3"]));
    assert_eq!(both, [(0, 2), (8, 3), (16, 3), (32, 2), (40, 2)]);
}

proptest! {
    #[test]
    fn holds_keep_the_length_the_genga_on_their_koma_and_the_drawings_those_that_were_spaced(
        drawings in 2..20usize,
        genga in prop::collection::vec(1..20usize, 0..4),
        gone in prop::collection::btree_set(1..20usize, 0..12),
        holds in prop::collection::vec((0..160usize, 1..12usize), 0..5),
    ) {
        let all = spaced(drawings, &genga);
        let gone: Vec<usize> = gone.into_iter().filter(|at| *at < drawings).collect();
        let layer = without(&all, &gone);
        let holds: Vec<Hold> =
            holds.into_iter().map(|(frame, koma)| Hold { frame: Frame(frame), koma }).collect();
        let result = with_holds(&layer, &all, &holds, clock());
        prop_assert_eq!(result.length(), layer.length());
        prop_assert!(result.exposures.iter().all(|shown| shown.koma > 0));
        let kept = |layer: &Layer| -> Vec<(usize, f64)> {
            let drawings = layer.timed().map(|(koma, shown)| (koma, &layer.drawings[shown.drawing]));
            drawings.filter(|(_, drawing)| drawing.role.is_kept()).map(|(koma, drawing)| (koma, drawing.source.place())).collect()
        };
        prop_assert_eq!(kept(&result), kept(&layer));
        let places: Vec<f64> = result.drawings.iter().map(|drawing| drawing.source.place()).collect();
        prop_assert!(places.is_sorted_by(|a, b| a < b));
        prop_assert!(places.iter().all(|place| all.drawings.iter().any(|own| own.source.place() == *place)));
        let left = all.drawings.len() - result.drawings.len();
        let told: usize = result.drawings.iter().map(|drawing| drawing.why.held_for + drawing.why.omitted_before).sum();
        prop_assert_eq!(told, left, "every drawing that is gone is told of");
    }
}
