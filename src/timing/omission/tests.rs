mod actions;
mod oracle;
mod real;

use glam::DVec3;
use proptest::prelude::*;

use self::oracle::{Outcome, Row, Rules};
use super::*;
use crate::cases::cases;
use crate::sheet::{Drawing, Exposure, Reason, Role, Source, Why};
use crate::timing::Shortfall;

/// A planned drawing: positions of two joints along a line, koma, role.
type Plan = ((i32, i32), usize, Role);

/// Builds a layer whose drawings' places are their numbers, and its stills. A genga whose second joint is at an odd
/// place is a fill.
fn laid_out(plan: &[Plan]) -> (Layer, Stills) {
    let mut stills = Stills::new(2);
    let (drawings, exposures, gone) = (vec![], vec![], vec![]);
    let mut layer = Layer { name: "A".into(), joints: vec![], drawings, exposures, gone };
    for (drawing, &((a, b), koma, role)) in plan.iter().enumerate() {
        stills.push(&[DVec3::X * f64::from(a), DVec3::Y * f64::from(b)]);
        let source = Source::At(drawing as f64);
        let is_fill = role == Role::Genga && b % 2 == 1;
        let why = Why { reason: is_fill.then_some(Reason::Fill), ..Why::default() };
        layer.drawings.push(Drawing::new(source, role, why));
        layer.exposures.push(Exposure { drawing, koma });
    }
    (layer, stills)
}

/// Builds one joint on ones, without genga, at these places along a line.
fn on_ones(places: &[i32]) -> (Layer, Stills) {
    let last = places.len().saturating_sub(1);
    let role = |at| if at == 0 || at == last { Role::End } else { Role::Inbetween };
    let plan: Vec<Plan> =
        places.iter().enumerate().map(|(at, &place)| ((place, 0), 1, role(at))).collect();
    laid_out(&plan)
}

fn counts(naka_nashi: usize, koma_dori: usize) -> Omission {
    Omission {
        naka_nashi: Amount::Count(naka_nashi),
        koma_dori: Amount::Count(koma_dori),
        ..Omission::default()
    }
}

fn left(layer: &Layer) -> Vec<(usize, usize)> {
    let drawing = |exposure: &Exposure| layer.drawings[exposure.drawing].source.place() as usize;
    layer.exposures.iter().map(|exposure| (drawing(exposure), exposure.koma)).collect()
}

fn indices(gone: &[Gone]) -> Vec<usize> {
    gone.iter().map(|gone| gone.drawing).collect()
}

fn outcome(omitted: &Omitted) -> Outcome {
    Outcome {
        left: left(&omitted.layer),
        omitted: indices(&omitted.report.naka_nashi.gone),
        taken: omitted.report.naka_nashi.done,
        replaced: indices(&omitted.report.koma_dori.gone),
    }
}

fn rows(layer: &Layer) -> Vec<Row> {
    let last = layer.drawings.len().saturating_sub(1);
    let row = |(at, drawing): (usize, &Drawing)| {
        let is_end = at == 0 || at == last;
        let kept = drawing.role.is_kept() || is_end;
        let opens = is_end || (kept && drawing.why.reason != Some(Reason::Fill));
        Row { drawing: at, koma: layer.exposures[at].koma, kept, opens }
    };
    layer.drawings.iter().enumerate().map(row).collect()
}

// Settings.

#[test]
fn settings_that_cannot_be_are_refused() {
    assert!(Omission::default().validate().is_ok());
    for share in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        let amount = Amount::Share(share);
        let naka_nashi = Omission { naka_nashi: amount, ..Omission::default() };
        let koma_dori = Omission { koma_dori: amount, ..Omission::default() };
        for (settings, name) in [(naka_nashi, "naka_nashi"), (koma_dori, "koma_dori")] {
            let message = settings.validate().unwrap_err().to_string();
            assert!(message.starts_with(&format!("omission.{name}: ")), "{message}");
        }
    }
    let no_hold = Omission { max_hold: 0, ..Omission::default() };
    let message = no_hold.validate().unwrap_err().to_string();
    assert!(message.starts_with("omission.max_hold: "), "{message}");
    let (layer, stills) = on_ones(&[0, 1]);
    assert!(no_hold.apply(&layer, &stills, 1).is_err(), "the verb checks too");
}

#[test]
fn settings_read_back_as_written_and_know_their_knobs() {
    let text = "naka_nashi = 4\nkoma_dori = \"25%\"\nmax_hold = 3\norder = \"koma_dori_first\"";
    let settings: Omission = toml::from_str(text).unwrap();
    let expected = Omission {
        koma_dori: Amount::Share(0.25),
        max_hold: 3,
        order: Order::KomaDoriFirst,
        ..counts(4, 0)
    };
    assert_eq!(settings, expected);
    assert_eq!(toml::from_str::<Omission>("").unwrap(), Omission::default());
    assert!(toml::from_str::<Omission>("hold = 3").is_err());
}

// Input.

#[test]
fn a_layer_that_does_not_show_each_drawing_once_in_order_is_refused() {
    let (layer, stills) = on_ones(&[0, 1, 2]);
    let apply = |layer: &Layer| counts(1, 1).apply(layer, &stills, 1);
    assert!(apply(&layer).is_ok());
    let mut swapped = layer.clone();
    swapped.exposures.swap(0, 1);
    let mut unseen = layer.clone();
    unseen.exposures.pop();
    let mut again = layer.clone();
    again.exposures.push(Exposure { drawing: 2, koma: 1 });
    let mut empty = layer.clone();
    empty.exposures[1].koma = 0;
    for wrong in [swapped, unseen, again, empty] {
        assert!(matches!(apply(&wrong), Err(Error::Clip { .. })), "{:?}", wrong.exposures);
    }
    let (longer, _) = on_ones(&[0, 1, 2, 3]);
    assert!(matches!(apply(&longer), Err(Error::Clip { .. })), "a drawing without positions");
}

#[test]
fn layers_of_up_to_three_drawings_and_far_too_much_asked_do_not_break() {
    let expected: [&[_]; 4] = [&[], &[(0, 1)], &[(0, 1), (1, 1)], &[(0, 2), (2, 1)]];
    for drawings in 0..4 {
        let (layer, stills) = on_ones(&[0, 5, 6][..drawings]);
        for order in [Order::NakaNashiFirst, Order::KomaDoriFirst] {
            for all_at_once in [false, true] {
                let settings = Omission { order, all_at_once, ..counts(usize::MAX, usize::MAX) };
                let omitted = settings.apply(&layer, &stills, 1).unwrap();
                assert_eq!(left(&omitted.layer), expected[drawings]);
                let done = omitted.report.naka_nashi.done + omitted.report.koma_dori.done;
                assert_eq!(done, usize::from(drawings == 3));
                assert!(omitted.report.naka_nashi.shortfall.is_some());
                assert!(omitted.report.koma_dori.shortfall.is_some());
            }
        }
    }
}

#[test]
fn a_shortfall_says_whether_a_longer_hold_would_help() {
    let (layer, stills) = on_ones(&(0..20).collect::<Vec<_>>());
    let short = |max_hold| {
        let omission = Omission {
            naka_nashi: Amount::Count(0),
            koma_dori: Amount::Count(99),
            max_hold,
            ..Omission::default()
        };
        omission.apply(&layer, &stills, 1).unwrap().report.koma_dori.shortfall
    };
    assert_eq!(short(2), Some(Shortfall::NoRoom));
    assert_eq!(short(99), Some(Shortfall::AllHolds));
}

#[test]
fn inbetweens_that_always_stay_are_not_said_to_be_gone() {
    let (layer, stills) = on_ones(&(0..20).collect::<Vec<_>>());
    let report = |kept: Range<usize>, later: Vec<usize>, settings: Omission| {
        let course = Course { kept: vec![kept], later, ..Course::default() };
        settings.apply_to(&layer, &stills, &course).unwrap().report
    };
    let all = report(0..20, vec![], counts(5, 5));
    assert_eq!(all.naka_nashi.shortfall, Some(Shortfall::AllStay));
    assert_eq!(all.koma_dori.shortfall, Some(Shortfall::AllStay));
    // An action whose inbetweens are all gone is no reason if another has some.
    let ends = report(1..20, vec![1], counts(5, 0));
    assert_eq!(ends.naka_nashi.shortfall, Some(Shortfall::AllStay));
    let (layer, stills) = movement();
    let full = counts(4, 0).apply(&layer, &stills, 2).unwrap().report;
    let said: Vec<String> = full.shortfalls().collect();
    assert!(
        said[0].ends_with("any longer (omission.keep_length=false shortens the sheet instead)")
    );
}

#[test]
fn a_body_that_does_not_move_loses_nothing_to_naka_nashi() {
    let (layer, stills) = on_ones(&[7; 9]);
    let omitted = counts(3, 0).apply(&layer, &stills, 1).unwrap();
    assert_eq!(omitted.layer, layer);
    assert_eq!(omitted.report.naka_nashi.shortfall, Some(Shortfall::NoMotion));
    let held = counts(0, 100).apply(&layer, &stills, 1).unwrap();
    assert_eq!(left(&held.layer), [(0, 4), (4, 4), (8, 1)], "held to the bound from the start");
    assert_eq!(held.report.koma_dori.shortfall, Some(Shortfall::NoRoom));
}

// Output.

#[test]
fn deletions_gather_in_one_place_unless_all_are_taken_at_once() {
    // Three swings of equal speed; the first is one frame longer.
    let steps = [1, 1, 1, 9, 9, 9, 1, 1, 1, 9, 9, 1, 1, 1, 9, 9, 1, 1, 1, 1, 1];
    let places: Vec<i32> = std::iter::once(0)
        .chain(steps.iter().scan(0, |place, step| {
            *place += step;
            Some(*place)
        }))
        .collect();
    let (layer, stills) = on_ones(&places);
    let gathered = |all_at_once| {
        let settings = Omission { all_at_once, ..counts(5, 0) };
        let omitted = settings.apply(&layer, &stills, 1).unwrap();
        assert_eq!(omitted.report.naka_nashi.done, 5);
        assert_eq!(omitted.layer.length(), layer.length());
        let omitted_before = |drawing: &Drawing| drawing.why.omitted_before;
        omitted.layer.drawings.iter().map(omitted_before).max().unwrap()
    };
    assert_eq!(gathered(false), 5, "all five in the first swing");
    assert_eq!(gathered(true), 3, "three there and two in the second");
}

#[test]
fn on_ones_koma_dori_holds_as_many_koma_as_it_was_asked_for() {
    let places: Vec<i32> = (0..129).map(|k| (k * k * 7 + k * 13) % 101).collect();
    let (layer, stills) = on_ones(&places);
    let omitted = counts(0, 33).apply(&layer, &stills, 1).unwrap();
    assert_eq!(omitted.report.koma_dori.done, 33);
    assert_eq!(omitted.layer.held_koma(), 33);
    let both = counts(4, 33).apply(&layer, &stills, 1).unwrap();
    assert_eq!(both.layer.held_koma(), 37, "and the four koma that naka-nashi gave away");
    assert_eq!(both.layer.length(), 129);
}

#[test]
fn a_share_is_of_the_koma_for_naka_nashi_and_of_the_inbetweens_for_koma_dori() {
    let places: Vec<i32> = (0..100).map(|k| (k * k * 7 + k * 13) % 101).collect();
    let (layer, stills) = on_ones(&places);
    let asked = |naka_nashi, koma_dori| {
        let settings = Omission { naka_nashi, koma_dori, ..Omission::default() };
        let report = settings.apply(&layer, &stills, 1).unwrap().report;
        (report.naka_nashi.asked, report.koma_dori.asked)
    };
    assert_eq!(
        asked(Amount::Share(0.04), Amount::Share(1.0 / 3.0)),
        (4, 31),
        "a third of 94 inbetweens"
    );
    assert_eq!(asked(Amount::Share(0.5), Amount::Count(0)), (6, 0), "six an action");
    assert_eq!(asked(Amount::Count(9), Amount::Count(2)), (9, 2), "a count is taken at its word");
}

#[test]
fn max_hold_is_koma_on_screen_and_never_below_twice_the_spacing() {
    let (layer, stills) = on_ones(&[0; 30]);
    let longest = |max_hold, on| {
        let settings = Omission { max_hold, ..counts(0, 30) };
        settings.apply(&layer, &stills, on).unwrap().layer.longest_hold()
    };
    assert_eq!([longest(3, 1), longest(4, 1), longest(6, 1)], [3, 4, 6]);
    assert_eq!([longest(1, 1), longest(4, 3)], [2, 6]);
    let by_range = |on: On| {
        let course = Course { on: on.into(), ..Course::default() };
        counts(0, 30).apply_to(&layer, &stills, &course).unwrap().layer.longest_hold()
    };
    assert_eq!(
        [On { least: 1, most: 3 }, On { least: 3, most: 4 }].map(by_range),
        [4, 6],
        "its fewest"
    );
}

#[test]
fn each_drawing_says_what_was_done_round_it() {
    let places = [0, 10, 20, 21, 23, 26, 30, 35, 90, 91, 94, 100];
    let (layer, stills) = on_ones(&places);
    let omitted = counts(1, 2).apply(&layer, &stills, 1).unwrap();
    // 8 jumps furthest and goes. 2, before the smallest step, is lengthened, so it cannot be replaced; it replaces 3,
    // and then 4 is the smallest single step left.
    assert_eq!(indices(&omitted.report.naka_nashi.gone), [8]);
    assert_eq!(omitted.report.naka_nashi.gone[0], Gone { drawing: 8, place: 8.0, koma: 8 });
    assert_eq!(omitted.report.lengthened, 1);
    assert_eq!(indices(&omitted.report.koma_dori.gone), [3, 4]);
    let why = |place: f64| {
        let at = |drawing: &&Drawing| drawing.source == Source::At(place);
        let why = &omitted.layer.drawings.iter().find(at).unwrap().why;
        (why.lengthened, why.omitted_before, why.held_for)
    };
    assert_eq!(why(2.0), (1, 0, 2));
    assert_eq!(why(9.0), (0, 1, 0));
    assert_eq!(why(5.0), (0, 0, 0));
}

/// Builds a turn, a movement with a fill in it, and another turn: places, koma, roles.
fn movement() -> (Layer, Stills) {
    use Role::{End, Genga, Inbetween};
    let slow = [(0, End), (1, Inbetween), (2, Inbetween), (3, Genga)];
    let fast =
        [(20, Inbetween), (50, Inbetween), (61, Genga), (90, Inbetween), (95, Genga), (96, End)];
    let places = slow.iter().chain(&fast);
    // Only the drawing at 61 is a fill.
    let second = |place: i32| i32::from(place == 61);
    let plan: Vec<Plan> = places.map(|&(place, role)| ((place, second(place)), 2, role)).collect();
    laid_out(&plan)
}

#[test]
fn freed_koma_go_to_the_turn_before_and_a_fill_comes_later() {
    let (layer, stills) = movement();
    let after = |naka_nashi| counts(naka_nashi, 0).apply(&layer, &stills, 2).unwrap();
    // 5 goes, as it jumps by 30; its koma go to the turn, 3, and 4 comes later.
    let once = [(0, 2), (1, 2), (2, 2), (3, 4), (4, 2), (6, 2), (7, 2), (8, 2), (9, 2)];
    assert_eq!(left(&after(1).layer), once);
    // 7 jumps by 29, but the turn has room for only one koma. The fill is never left out.
    assert_eq!(left(&after(4).layer), once);
    assert_eq!(after(4).report.naka_nashi.shortfall, Some(Shortfall::NoRoom));
}

#[test]
fn only_what_is_markedly_fast_is_left_out_and_only_small_movements_are_held() {
    let (layer, stills) = movement();
    let course = Course { on: On::every(2).into(), height: 100.0, ..Course::default() };
    let report = |settings: Omission| settings.apply_to(&layer, &stills, &course).unwrap().report;
    // Steps of 1, 1, 1, 17, 30, 11, 29, 5, 1: the median is 5.
    let gone = |fast| indices(&report(Omission { fast, ..counts(9, 0) }).naka_nashi.gone);
    assert_eq!([gone(5.5), gone(6.5)], [vec![5], vec![]]);
    let slow = report(Omission { fast: 6.5, ..counts(9, 0) });
    assert_eq!(slow.naka_nashi.shortfall, Some(Shortfall::NoneFast));
    // One of two joints moves by 1, so the root mean square is 0.71.
    let held = |small| report(Omission { small, max_hold: 9, ..counts(0, 9) }).koma_dori;
    assert_eq!(indices(&held(0.8).gone), [1]);
    assert_eq!(held(0.8).shortfall, Some(Shortfall::NoneSmall));
    assert_eq!(held(0.7).gone, []);
    let share = Omission { small: 0.7, koma_dori: Amount::Share(1.0), ..counts(0, 0) };
    assert_eq!(report(share).koma_dori.shortfall, None, "a share is the most");
}

// Comparison with the oracle, and laws.

fn amounts() -> impl Strategy<Value = usize> {
    prop_oneof![4 => 0..6usize, 2 => 6..40usize, 1 => Just(1000)]
}

prop_compose! {
    fn settings()(
        (naka_nashi, koma_dori) in (amounts(), amounts()),
        max_hold in 1..7usize,
        keep_length in prop::bool::weighted(0.8),
        all_at_once in prop::bool::weighted(0.25),
        koma_dori_first: bool,
        fast in prop::sample::select(vec![0.0, 1.0, 2.0]),
        small in prop::sample::select(vec![1.0, 10.0, 100.0]),
    ) -> Omission {
        let order = if koma_dori_first { Order::KomaDoriFirst } else { Order::NakaNashiFirst };
        let counts = counts(naka_nashi, koma_dori);
        Omission { max_hold, keep_length, all_at_once, order, fast, small, ..counts }
    }
}

/// Generates few places, so that ties and rests are frequent.
fn place() -> impl Strategy<Value = (i32, i32)> {
    prop_oneof![(0..3, 0..2), (0..40, 0..40)]
}

fn ones() -> impl Strategy<Value = Vec<Plan>> {
    prop::collection::vec(place(), 0..60).prop_map(|places| {
        let last = places.len().saturating_sub(1);
        let role = |at| if at == 0 || at == last { Role::End } else { Role::Inbetween };
        places.into_iter().enumerate().map(|(at, place)| (place, 1, role(at))).collect()
    })
}

/// Generates sheets with genga and a spacing of their own; the first and last drawing need not be ends.
fn keyed() -> impl Strategy<Value = (Vec<Plan>, usize)> {
    let role =
        prop_oneof![6 => Just(Role::Inbetween), 2 => Just(Role::Genga), 1 => Just(Role::End)];
    (1..4usize).prop_flat_map(move |on| {
        let koma = prop_oneof![5 => Just(on), 1 => 1..=on];
        (prop::collection::vec((place(), koma, role.clone()), 0..60), Just(on))
    })
}

proptest! {
    #![proptest_config(cases(200, 1500))]

    #[test]
    fn on_ones_without_genga_it_is_algorithms_1_and_2_koma_for_koma(
        plan in ones(),
        settings in settings(),
    ) {
        let (layer, stills) = laid_out(&plan);
        let omitted = settings.apply(&layer, &stills, 1).unwrap();
        let expected = Rules::new(&settings, &stills, 1).by_koma(&rows(&layer));
        prop_assert_eq!(outcome(&omitted), expected);
    }

    #[test]
    fn with_genga_or_longer_exposures_it_is_the_slow_rules(
        (plan, on) in keyed(),
        settings in settings(),
    ) {
        let (layer, stills) = laid_out(&plan);
        let rows = rows(&layer);
        let course = Course { on: On::every(on).into(), height: 100.0, ..Course::default() };
        let omitted = settings.apply_to(&layer, &stills, &course).unwrap();
        let slow = Rules::new(&settings, &stills, on);
        let without_genga = rows.iter().filter(|row| row.kept).count() <= 2;
        let expected =
            if on == 1 && without_genga { slow.by_koma(&rows) } else { slow.by_drawing(&rows) };
        prop_assert_eq!(outcome(&omitted), expected);
    }

    #[test]
    fn whatever_is_left_out_the_sheet_stays_a_sheet(
        (plan, on) in prop_oneof![keyed(), ones().prop_map(|plan| (plan, 1))],
        settings in settings(),
    ) {
        let (layer, stills) = laid_out(&plan);
        let Omitted { layer: after, report } = settings.apply(&layer, &stills, on).unwrap();
        let places: Vec<f64> = after.drawings.iter().map(|drawing| drawing.source.place()).collect();
        prop_assert!(places.is_sorted_by(|a, b| a < b));
        let bound = settings.max_hold.max(2 * on);
        for shown in &after.exposures {
            let why = &after.drawings[shown.drawing].why;
            prop_assert!(shown.koma <= bound || why.lengthened > 0, "{} koma", shown.koma);
            prop_assert!(why.lengthened <= 3);
        }
        if settings.keep_length {
            prop_assert_eq!(after.length(), layer.length());
        }
        let first_koma = |layer: &Layer| -> Vec<(f64, usize)> {
            let begun = layer.timed().map(|(begin, exposure)| (&layer.drawings[exposure.drawing], begin));
            begun.map(|(drawing, begin)| (drawing.source.place(), begin)).collect()
        };
        let now = first_koma(&after);
        for (at, row) in rows(&layer).iter().enumerate().filter(|(_, row)| row.kept) {
            let (place, begin) = first_koma(&layer)[at];
            let stays = now.iter().find(|(now, _)| *now == place);
            prop_assert!(stays.is_some(), "kept drawing {} is gone", row.drawing);
            let late = if row.opens { 0 } else { 3 };
            let may_stand = begin..=begin + late;
            prop_assert!(!settings.keep_length || may_stand.contains(&stays.unwrap().1), "{} moved", row.drawing);
        }
        adds_up(&layer, &after, &report, &settings)?;
    }
}

fn adds_up(
    before: &Layer,
    after: &Layer,
    report: &OmissionReport,
    settings: &Omission,
) -> Result<(), TestCaseError> {
    let OmissionReport { naka_nashi, koma_dori, lengthened } = report;
    prop_assert_eq!(
        before.drawings.len(),
        after.drawings.len() + naka_nashi.gone.len() + koma_dori.gone.len()
    );
    for stage in [naka_nashi, koma_dori] {
        prop_assert_eq!(stage.shortfall.is_some(), stage.done < stage.asked);
        prop_assert!(stage.gone.len() <= stage.done && stage.done <= stage.asked);
        for gone in &stage.gone {
            prop_assert_eq!(gone.place, gone.drawing as f64);
            let begin: usize =
                before.exposures[..gone.drawing].iter().map(|exposure| exposure.koma).sum();
            prop_assert_eq!(gone.koma, begin);
        }
    }
    prop_assert_eq!(koma_dori.gone.len(), koma_dori.done);
    let sum = |of: fn(&Why) -> usize| -> usize {
        after.drawings.iter().map(|drawing| of(&drawing.why)).sum()
    };
    prop_assert_eq!(sum(|why| why.omitted_before), naka_nashi.gone.len());
    prop_assert!(sum(|why| why.lengthened) <= *lengthened);
    if settings.order == Order::NakaNashiFirst {
        prop_assert_eq!(sum(|why| why.held_for), koma_dori.done);
    }
    prop_assert!(settings.keep_length || *lengthened == 0);
    Ok(())
}
