use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use crate::edits::Pin;
use crate::keys::{AtGaits, AtRests, Choose};
use crate::motion::{Clip, bvh};
use crate::pipeline::tests::walking;
use crate::time::{Frame, FrameRate};
use crate::timing::On;

/// Opens a synthetic motion of `data/`.
fn sample(name: &str) -> Clip {
    let path = format!("{}/data/{name}.bvh", env!("CARGO_MANIFEST_DIR"));
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

fn engine(name: &str) -> Engine {
    Engine::new(sample(name)).unwrap()
}

/// Returns the figures of a recipe's sheet: genga with both ends, drawings, and seconds.
fn figures(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> (usize, usize, f64) {
    let breakdown = engine.run(recipe, edits).unwrap();
    let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
    (layer(&breakdown).genga(), layer(&breakdown).shown().count(), seconds)
}

/// Returns the fewest and the most genga that any price and limit per second give.
fn bounds(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> (usize, usize) {
    let bound = |min_price, per_second| {
        let keys = Choose { min_price, per_second, at_rests: AtRests::Off, ..recipe.keys.clone() };
        Recipe { keys, ..recipe.clone() }
    };
    let fewest = figures(engine, &bound(1e9, 1e-9), edits).0;
    (fewest, figures(engine, &bound(0.0, f64::INFINITY), edits).0)
}

#[test]
fn every_number_of_genga_between_those_that_stay_and_all_is_met() {
    let mut engine = engine("kick");
    let (recipe, edits) = (Recipe::default(), Edits::default());
    let (fewest, most) = bounds(&mut engine, &recipe, &edits);
    assert!(most > fewest + 20, "{fewest} to {most}");
    for count in 0..most + 3 {
        let met = meet(&mut engine, &recipe, &edits, &[Target::Keys(count)]).unwrap();
        let outcome = &met.outcomes[0];
        let (genga, ..) = figures(&mut engine, &met.recipe, &edits);
        assert_eq!(genga, count.clamp(fewest, most));
        assert_eq!(outcome.reached, genga as f64);
        assert_eq!(outcome.shortfall.is_none(), genga == count, "{outcome}");
    }
}

#[test]
fn what_stands_in_the_way_is_said() {
    let mut engine = engine("kick");
    let pins = vec![Pin::parse("30").unwrap(), Pin::parse("42").unwrap()];
    let edits = Edits { pins, ..Edits::default() };
    let recipe = Recipe::default();
    let mut said = |target| {
        let met = meet(&mut engine, &recipe, &edits, &[target]).unwrap();
        met.outcomes[0].to_string()
    };
    let few = said(Target::Keys(1));
    assert!(few.starts_with("1 genga were asked for, and there are "), "{few}");
    assert!(few.contains("all 2 between them are pins, which stay"), "{few}");
    let many = said(Target::Keys(500));
    assert!(
        many.contains(
            "there is no room for another: a drawing stays for 2 koma at the least; spacing.on=1 has more"
        ),
        "{many}"
    );
    let still = said(Target::DrawingsPerSecond(0.5));
    assert!(still.contains("0.5 drawings a second were asked for"), "{still}");
    assert!(still.contains("ends, pins and ends of rests stay"), "{still}");
}

#[test]
fn a_search_in_steps_finds_what_the_search_at_once_finds_and_counts_once_a_step() {
    for clip in ["kick", "swing"] {
        let mut engine = engine(clip);
        let edits = Edits { pins: vec![Pin::parse("42").unwrap()], ..Edits::default() };
        for count in [0, 5, 14, 900] {
            let mut search = Search::new(&Recipe::default(), &edits, count);
            let mut steps = 0;
            let met = loop {
                steps += 1;
                let met = search.step(&mut engine);
                assert!(search.counts() <= steps, "{} counts in {steps} steps", search.counts());
                if let Some(met) = met {
                    break met.unwrap();
                }
            };
            assert!(steps > 1, "it is spread over steps");
            let target = [Target::Keys(count)];
            assert_eq!(met, meet(&mut engine, &Recipe::default(), &edits, &target).unwrap());
        }
    }
}

#[test]
fn a_reason_names_what_is_so_and_nothing_else() {
    let mut engine = engine("kick");
    let mut said = |set: &str, edits: &Edits, target| {
        let mut recipe = Recipe::default();
        recipe.set("keys.rest", set).unwrap();
        let met = meet(&mut engine, &recipe, edits, &[target]).unwrap();
        met.outcomes[0].shortfall.clone().unwrap().to_string()
    };
    let pins = |texts: &[&str]| texts.iter().map(|pin| Pin::parse(pin).unwrap()).collect();
    let pinned = Edits { pins: pins(&["42"]), ..Edits::default() };
    assert_eq!(
        said("0", &pinned, Target::Keys(0)),
        "the first and the last drawing always are genga, and the one between them is a pin, which stays"
    );
    let rests = said("60", &pinned, Target::Keys(1));
    assert!(rests.ends_with("the one between them is a pin, which stays"), "rests may go: {rests}");
    let alone = Edits { only_pins: true, ..pinned.clone() };
    for target in [Target::Keys(9), Target::MaxError(2.0)] {
        let only = said("12", &alone, target);
        assert!(only.contains("only_pins wants no keys but pins and moved ones"), "{only}");
        assert!(!only.contains("joint"), "{only}");
    }
    let forbidden = Edits { forbidden: vec!["10..60".parse().unwrap()], ..Edits::default() };
    for target in [Target::Keys(900), Target::MaxError(2.0)] {
        let outside = said("12", &forbidden, target);
        assert!(outside.contains("outside what is forbidden"), "{outside}");
        assert!(!said("12", &pinned, Target::Keys(900)).contains("forbidden"));
    }
}

#[test]
fn a_reason_in_japanese_says_the_same_as_in_english() {
    let mut engine = engine("kick");
    let pinned = Edits { pins: vec![Pin::parse("42").unwrap()], ..Edits::default() };
    let mut said = |edits: &Edits, target| {
        let met = meet(&mut engine, &Recipe::default(), edits, &[target]).unwrap();
        met.outcomes[0].japanese()
    };
    assert_eq!(
        said(&pinned, Target::Keys(0)),
        "原画0枚の指定に対して3枚: 最初と最後の画は必ず原画。間の1枚は固定なので残る"
    );
    let most = said(&pinned, Target::Keys(900));
    assert!(
        most.ends_with("もう入らない: 1枚の画は最低2コマ見せる。spacing.on=1 なら増やせる"),
        "{most}"
    );
    let near = said(&Edits::default(), Target::MaxError(0.001));
    assert!(near.contains("92コマ中") && near.contains("そこを固定すると減る"), "{near}");
}

#[test]
fn the_frame_that_is_furthest_off_may_be_forbidden() {
    let mut engine = engine("kick");
    let mut recipe = Recipe::default();
    recipe.set("keys.merge", "union").unwrap();
    let mut said = |edits: &Edits| {
        let target = [Target::MaxError(0.1)];
        let met = meet(&mut engine, &recipe, edits, &target).unwrap();
        met.outcomes[0].shortfall.clone().unwrap().to_string()
    };
    let free = said(&Edits::default());
    assert!(
        free.contains(" koma no key where a joint turns comes nearer; the worst is near frame "),
        "{free}"
    );
    let worst_of = |said: &str| {
        let worst = said.split("near frame ").nth(1).unwrap().strip_suffix(": a pin there helps");
        worst.unwrap().to_owned()
    };
    let worst = worst_of(&free);
    let pinned = Edits { pins: vec![Pin::parse(&worst).unwrap()], ..Edits::default() };
    assert_ne!(worst_of(&said(&pinned)), worst, "it helps");
    // With pins alone, forbidden frames change no key.
    let alone = Edits { only_pins: true, ..pinned };
    let worst = worst_of(&said(&alone));
    let forbidden = said(&Edits { forbidden: vec![worst.parse().unwrap()], ..alone });
    assert!(forbidden.ends_with(&format!("near frame {worst}, which is forbidden")), "{forbidden}");
}

#[test]
fn a_recipe_that_meets_its_targets_is_left_as_it_is() {
    let mut engine = engine("kick");
    let (recipe, edits) = (Recipe::default(), Edits::default());
    let (genga, drawings, seconds) = figures(&mut engine, &recipe, &edits);
    let targets = [Target::DrawingsPerSecond(drawings as f64 / seconds), Target::Keys(genga)];
    let met = meet(&mut engine, &recipe, &edits, &targets).unwrap();
    assert_eq!(met.recipe, recipe);
    let names: Vec<_> = met.outcomes.iter().map(|outcome| outcome.target.name()).collect();
    assert_eq!(names, ["keys", "drawings-per-second"], "keys are settled first");
}

#[test]
fn drawings_never_cost_keys_that_were_asked_for() {
    let mut engine = engine("kick");
    let (recipe, edits) = (Recipe::default(), Edits::default());
    let targets = [Target::Keys(24), Target::DrawingsPerSecond(3.0)];
    let met = meet(&mut engine, &recipe, &edits, &targets).unwrap();
    assert_eq!(figures(&mut engine, &met.recipe, &edits).0, 24);
    let said = met.outcomes[1].to_string();
    assert!(said.contains("24 genga are wanted"), "{said}");
}

/// The same motions, also two and three times as fast, so that genga are most of what fits. With few drawings a quarter
/// stay genga, if the method has as many.
#[test]
fn genga_go_first_where_they_leave_no_room_for_inbetweens() {
    let edits = Edits::default();
    for (name, faster) in [
        ("kick", 1.0),
        ("tennis", 1.0),
        ("tennis", 2.0),
        ("swing", 2.0),
        ("pitch", 3.0),
        ("kick", 3.0),
    ] {
        let clip = sample(name);
        let rate = FrameRate::new(faster * clip.rate().fps()).unwrap();
        let mut engine = Engine::new(clip.with_rate(rate)).unwrap();
        let (mut fewer, mut genga_before) = (0, 0);
        let of_the_method = figures(&mut engine, &Recipe::default(), &edits).0;
        for per_second in [4.0, 6.0, 8.0, 10.0, 12.0] {
            let target = [Target::DrawingsPerSecond(per_second)];
            let met = meet(&mut engine, &Recipe::default(), &edits, &target).unwrap();
            let (genga, drawings, seconds) = figures(&mut engine, &met.recipe, &edits);
            let asked = per_second * seconds;
            let what = format!("{name} x{faster}: {genga} genga of {drawings}, {asked:.1} asked");
            assert!((drawings as f64 - asked).abs() <= 1.0, "{what}");
            let between = |genga: usize| genga.saturating_sub(2);
            assert!(between(genga) as f64 <= 2.0 / 3.0 * asked, "{what}");
            let least = ((asked / 4.0).ceil() as usize).min(between(of_the_method));
            assert!(genga > least, "{what}: the last drawing may be held");
            assert!(genga >= genga_before && drawings > fewer, "{what}");
            (fewer, genga_before) = (drawings, genga);
        }
    }
}

/// A rate that only a sheet of almost nothing but genga meets is met in another way.
#[test]
fn a_rate_that_genga_alone_have_is_no_rate_that_is_met() {
    let edits = Edits::default();
    let mut engine = engine("kick");
    let mut recipe = Recipe::default();
    for (knob, value) in
        [("keys.min_price", "0"), ("keys.per_second", "8"), ("spacing.inbetweens", "0")]
    {
        recipe.set(knob, value).unwrap();
    }
    let (genga, drawings, seconds) = figures(&mut engine, &recipe, &edits);
    assert!(genga == drawings, "{genga} of {drawings}");
    let per_second = drawings as f64 / seconds;
    let target = [Target::DrawingsPerSecond(per_second)];
    let met = meet(&mut engine, &recipe, &edits, &target).unwrap();
    let (genga, now, _) = figures(&mut engine, &met.recipe, &edits);
    assert!(now.abs_diff(drawings) <= 1 && 3 * (genga - 2) <= 2 * drawings, "{genga} of {now}");
}

#[test]
fn a_fixed_number_of_inbetweens_gives_way_where_no_number_will_do() {
    let mut engine = engine("kuroda-pitch");
    let mut recipe = Recipe::default();
    (recipe.keys.min_price, recipe.keys.per_second) = (2.5, 4.5);
    recipe.spacing.on = On::every(1);
    recipe.spacing.inbetweens = Some(0);
    recipe.omission.keep_length = false;
    let target = [Target::DrawingsPerSecond(5.25)];
    let met = meet(&mut engine, &recipe, &Edits::default(), &target).unwrap();
    assert_eq!(met.recipe.spacing.inbetweens, None);
    assert_eq!(met.outcomes[0].shortfall, None);
}

#[test]
fn every_koma_has_a_drawing_when_as_many_are_asked_for() {
    let mut engine = engine("kick");
    let target = [Target::DrawingsPerSecond(24.0)];
    let met = meet(&mut engine, &Recipe::default(), &Edits::default(), &target).unwrap();
    assert_eq!(figures(&mut engine, &met.recipe, &Edits::default()).1, 92);
    assert_eq!(met.recipe.get("omission.naka_nashi").unwrap(), "0");
}

#[test]
fn what_can_never_be_met_is_refused() {
    let mut engine = engine("kick");
    let mut error = |targets: &[Target]| {
        let met = meet(&mut engine, &Recipe::default(), &Edits::default(), targets);
        met.unwrap_err().to_string()
    };
    for rate in [0.0, -1.0, 24.5, f64::NAN, f64::INFINITY] {
        let said = error(&[Target::DrawingsPerSecond(rate)]);
        assert!(said.starts_with("drawings-per-second: must be above 0 and at most 24"), "{said}");
    }
    for most in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let said = error(&[Target::MaxError(most)]);
        assert!(said.starts_with("max-error: must be above 0, in % of body height"), "{said}");
    }
    let said = error(&[Target::Keys(3), Target::MaxError(4.0)]);
    assert!(
        said.starts_with("max-error: cannot be asked for together with a number of keys"),
        "{said}"
    );
    let said = error(&[Target::Keys(3), Target::Keys(4)]);
    assert_eq!(said, "keys: is asked for twice");
}

#[test]
fn the_smallest_clips_have_targets_too() {
    let pitch = sample("pitch");
    for frames in 1..5 {
        let clip = pitch.clone().trimmed(Frame(60), Frame(60 + frames)).unwrap();
        let mut engine = Engine::new(clip).unwrap();
        for target in [Target::Keys(0), Target::Keys(3), Target::DrawingsPerSecond(24.0)] {
            let met = meet(&mut engine, &Recipe::default(), &Edits::default(), &[target]).unwrap();
            assert_eq!(met.outcomes.len(), 1);
        }
    }
}

/// Counts the koma at which the body is further off than `most` with the keys of a recipe.
fn beyond(most: f64, engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> usize {
    let rebuilt = engine.reconstruction(recipe, edits).unwrap();
    rebuilt.errors.into_iter().filter(|error| *error > most).count()
}

#[test]
fn gaits_give_way_to_a_number_of_genga_that_they_do_not_have() {
    let mut engine = Engine::new(walking::clip()).unwrap();
    let mut asked = |count| {
        let targets = [Target::Keys(count)];
        let met = meet(&mut engine, &Recipe::default(), &Edits::default(), &targets).unwrap();
        (met.outcomes[0].reached, met.recipe.keys.gaits)
    };
    let (all, off) = (asked(100).0, AtGaits::Off);
    assert_eq!(asked(8), (8.0, off), "fewer");
    assert!(all >= 8.0, "{all}");
}

#[test]
fn gaits_give_way_to_a_largest_error_that_fewer_keys_meet() {
    let mut engine = Engine::new(walking::clip()).unwrap();
    let edits = Edits::default();
    let met = meet(&mut engine, &Recipe::default(), &edits, &[Target::MaxError(20.0)]).unwrap();
    assert!(met.outcomes[0].reached <= 20.0 && met.recipe.keys.gaits == AtGaits::Off);
    let mut stepping = met.recipe.clone();
    stepping.keys.gaits = AtGaits::Steps;
    let mut count = |recipe| engine.find_keys(recipe, &edits).unwrap().keys.keys.len();
    assert!(count(&met.recipe) < count(&stepping));
}

proptest! {
    #![proptest_config(cases(1, 24))]

    #[test]
    fn a_largest_error_takes_the_highest_price_that_will_do(
        name in prop::sample::select(&["kick", "pitch"][..]),
        most in prop_oneof![0.3..4.0, 4.0..40.0],
        pin in prop::option::of(5..80usize),
    ) {
        let mut engine = engine(name);
        let pins = pin.map(|frame| Pin::parse(&frame.to_string()).unwrap());
        let edits = Edits { pins: pins.into_iter().collect(), ..Edits::default() };
        let recipe = Recipe::default();
        let met = meet(&mut engine, &recipe, &edits, &[Target::MaxError(most)]).unwrap();
        let outcome = &met.outcomes[0];
        let found = key_count_search::count_found(&mut engine, &met.recipe, &edits).unwrap();
        let worst = engine.reconstruction(&met.recipe, &edits).unwrap().worst();
        prop_assert_eq!(outcome.reached, worst);
        prop_assert_eq!(outcome.shortfall.is_none(), worst <= most, "{}", outcome);
        let least = beyond(most, &mut engine, &met.recipe, &edits);
        prop_assert_eq!(least == 0, worst <= most);
        // No higher price among those tried suffices.
        for price in error::prices() {
            let mut other = recipe.clone();
            other.keys.per_second = f64::INFINITY;
            other.keys.min_price = price;
            let sparse = key_count_search::count_found(&mut engine, &other, &edits).unwrap() < found;
            prop_assert!(!sparse || beyond(most, &mut engine, &other, &edits) >= least, "{}", price);
        }
        let again = meet(&mut engine, &met.recipe, &edits, &[Target::MaxError(most)]).unwrap();
        prop_assert_eq!(again.recipe, met.recipe);
    }
}

#[test]
fn where_a_step_of_koma_dori_is_several_drawings_the_nearest_count_is_found() {
    let mut engine = engine("tennis");
    let mut recipe = Recipe::default();
    recipe.spacing.on = "1".parse::<On>().unwrap();
    recipe.set("omission.order", "koma_dori_first").unwrap();
    let targets = [Target::DrawingsPerSecond(10.444675938360787)];
    let met = meet(&mut engine, &recipe, &Edits::default(), &targets).unwrap();
    assert_eq!(met.outcomes[0].shortfall, None, "{}", met.outcomes[0]);
}

proptest! {
    #![proptest_config(cases(20, 150))]

    #[test]
    fn drawings_come_within_one_or_it_is_said_why(
        name in prop::sample::select(&["kick", "tennis", "kuroda-pitch"][..]),
        per_second in 0.3..24.0,
        on in prop::sample::select(&["1", "2", "3", "6", "1-3"][..]),
        inbetweens in prop::option::weighted(0.3, 0..6usize),
        dori_first in any::<bool>(),
        keep_length in any::<bool>(),
        keys in prop::option::weighted(0.3, 0..30usize),
    ) {
        let mut engine = engine(name);
        let (mut recipe, edits) = (Recipe::default(), Edits::default());
        recipe.spacing.on = on.parse::<On>().unwrap();
        recipe.spacing.inbetweens = inbetweens;
        recipe.omission.keep_length = keep_length;
        if dori_first {
            recipe.set("omission.order", "koma_dori_first").unwrap();
        }
        let drawings = Target::DrawingsPerSecond(per_second);
        let targets: Vec<_> = keys.map(Target::Keys).into_iter().chain([drawings]).collect();
        let met = meet(&mut engine, &recipe, &edits, &targets).unwrap();
        let outcome = met.outcomes.last().unwrap();
        let (_, drawings, seconds) = figures(&mut engine, &met.recipe, &edits);
        prop_assert!((outcome.reached - drawings as f64 / seconds).abs() < 1e-12, "{}", outcome);
        let excess = drawings as f64 - per_second * seconds;
        prop_assert_eq!(outcome.shortfall.is_none(), excess.abs() <= 1.0 + 1e-9, "{}", outcome);
        // More drawings are always possible, and fewer until only those that must stay are left.
        prop_assert!(excess > -1.0 - 1e-9, "{}", outcome);
        if outcome.shortfall.is_some() {
            let breakdown = engine.run(&met.recipe, &edits).unwrap();
            prop_assert_eq!(layer(&breakdown).count(Role::Inbetween), 0, "{}", outcome);
        }
        // Holds that could not be done are not asked for.
        let held = &engine.run(&met.recipe, &edits).unwrap().first_layer().omission.koma_dori;
        prop_assert!(met.recipe.omission.koma_dori == recipe.omission.koma_dori || held.asked == held.done);
        // The recipe alone reproduces the result, and meeting the target again does not change it.
        let again = meet(&mut engine, &met.recipe, &edits, &targets).unwrap();
        prop_assert!(again.recipe == met.recipe || excess.abs() > 0.5, "{}", outcome);
        let written = met.recipe.write(&edits);
        prop_assert_eq!(Recipe::parse(&written).unwrap().0, met.recipe);
    }

    #[test]
    fn genga_are_exact_on_any_part_of_a_clip_with_any_pins(
        begin in 0..60usize,
        length in 10..60usize,
        pins in prop::collection::vec(any::<prop::sample::Index>(), 0..4),
        count in 0..40usize,
        by_strength in any::<bool>(),
    ) {
        let clip = sample("pitch").trimmed(Frame(begin), Frame(begin + length)).unwrap();
        let frames: std::collections::BTreeSet<usize> =
            pins.iter().map(|pin| begin + pin.index(length)).collect();
        let pins = frames.iter().map(|frame| Pin::parse(&frame.to_string()).unwrap()).collect();
        let around = pins;
        let edits = Edits { pins: Vec::clone(&around), again: true, ..Edits::default() };
        let mut recipe = Recipe::default();
        if by_strength {
            recipe.set("keys.rank", "strength").unwrap();
        }
        let mut engine = Engine::new(clip).unwrap();
        let (fewest, most) = bounds(&mut engine, &recipe, &edits);
        let met = meet(&mut engine, &recipe, &edits, &[Target::Keys(count)]).unwrap();
        let wanted = count.clamp(fewest, most);
        let reached = figures(&mut engine, &met.recipe, &edits).0;
        // A pin next to an end may hold its pose to the end at some price, which is a genga fewer than at the highest.
        prop_assert!(reached == wanted || reached == count, "{} for {}", reached, wanted);
        prop_assert_eq!(met.outcomes[0].shortfall.is_none(), reached == count);
        // Pins that change only their neighbourhood replace found keys after the choice; the total counts.
        let edits = Edits { pins: around, ..Edits::default() };
        let met = meet(&mut engine, &recipe, &edits, &[Target::Keys(count)]).unwrap();
        let reached = figures(&mut engine, &met.recipe, &edits).0;
        prop_assert_eq!(met.outcomes[0].reached, reached as f64);
        prop_assert_eq!(met.outcomes[0].shortfall.is_none(), reached == count);
        let off = reached.abs_diff(wanted);
        prop_assert!(off <= frames.len().max(1), "{reached} instead of {wanted}");
    }
}
