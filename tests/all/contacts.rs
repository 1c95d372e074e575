//! Contacts as moments for keys, and feet that stay planted.

use genga::edits::Edits;
use genga::keys::Origin;
use genga::motion::{Clip, ContactFinder};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Feet, Reason, Sheet};
use genga::time::Frame;
use genga_files::{keys_bvh, limited_bvh};
use genga_lab::quality::Evaluation;

use crate::clips;

/// The frames on which contacts begin and end, without those at an end of the clip.
fn ends(clip: &Clip) -> Vec<Frame> {
    let clock = clip.clock(24.0);
    let last = clip.rate().koma_from_frames(clip.len(), 24.0) - 1;
    let contacts = ContactFinder::default().find(clip, clock).into_iter();
    let ends = contacts.flat_map(|contact| [*contact.koma.start(), *contact.koma.end()]);
    let inner = ends.filter(|koma| (1..last).contains(koma));
    inner.map(|koma| clock.frame_from_koma(koma)).collect()
}

fn recipe(settings: &[(&str, &str)]) -> Recipe {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    recipe
}

fn is_near(clip: &Clip, frame: Frame, others: impl IntoIterator<Item = Frame>) -> bool {
    let koma = clip.clock(24.0).frames_in_koma();
    others.into_iter().any(|other| (other.0.abs_diff(frame.0) as f64) < koma)
}

#[test]
fn where_a_foot_comes_down_or_leaves_is_a_key_if_it_is_to_be() {
    // On twos, a contact gives way to the end of a rest a koma beside it.
    let on_ones = [("keys.contacts", "keys"), ("spacing.on", "1")];
    let clip = clips::sample("kick.bvh");
    let ends = ends(&clip);
    assert!(!ends.is_empty());
    let mut engine = Engine::new(clip.clone()).unwrap();
    let made = engine.run(&recipe(&on_ones), &Edits::default()).unwrap();
    let keys = &made.first_layer().keys.keys;
    for end in &ends {
        assert!(is_near(&clip, *end, keys.iter().map(|key| key.frame)), "{end}");
    }
    let own: Vec<Frame> =
        keys.iter().filter(|key| key.origin == Origin::Contact).map(|key| key.frame).collect();
    assert!(!own.is_empty() && own.iter().all(|frame| ends.contains(frame)), "{own:?}");
    let said = made.sheet.layers[0]
        .drawings
        .iter()
        .filter(|drawing| drawing.why.reason == Some(Reason::Contact));
    let said: Vec<f64> = said.map(|drawing| drawing.source.place()).collect();
    assert_eq!(said, own.iter().map(|frame| frame.0 as f64).collect::<Vec<_>>());
    let edits = Edits { forbidden: vec![own[0].to_string().parse().unwrap()], ..Edits::default() };
    let made = engine.run(&recipe(&on_ones), &edits).unwrap();
    assert!(
        !is_near(&clip, own[0], made.first_layer().keys.keys.iter().map(|key| key.frame)),
        "forbidden"
    );
}

#[test]
fn as_candidates_contacts_count_where_joints_name_the_moments_and_nowhere_else() {
    let clip = clips::sample("kick.bvh");
    let ends = ends(&clip);
    let mut engine = Engine::new(clip.clone()).unwrap();
    let mut candidates = |merge: &str, contacts: &str| {
        let recipe = recipe(&[("keys.merge", merge), ("keys.contacts", contacts)]);
        let made = engine.run(&recipe, &Edits::default()).unwrap();
        let frames: Vec<Frame> =
            made.first_layer().candidates.keys.iter().map(|found| found.frame).collect();
        (frames, made.sheet.clone())
    };
    assert_eq!(candidates("body", "off"), candidates("body", "candidates"));
    for merge in ["union", "vote"] {
        let (before, after) = (candidates(merge, "off").0, candidates(merge, "candidates").0);
        assert!(before.iter().all(|frame| after.contains(frame)), "{merge}");
        assert!(ends.iter().all(|end| is_near(&clip, *end, after.iter().copied())), "{merge}");
        assert!(after.is_sorted());
    }
    let (before, after) = (candidates("vote", "off").0, candidates("vote", "candidates").0);
    assert!(after.len() > before.len(), "not all were there");
}

/// Mean foot slip on screen, and mean error of the body.
fn judged(clip: &Clip, sheet: &Sheet) -> (Option<f64>, f64) {
    let found = Evaluation::new(clip, sheet, None, 1.0).unwrap();
    (found.shown_slip.mean, found.shown.mean)
}

#[test]
fn on_real_clips_held_feet_hardly_slide_and_the_body_stays_what_it_was() {
    let mut with_feet = 0;
    let paths = clips::all();
    for path in &paths {
        let (clip, name) = (clips::read(path), clips::name(path));
        for root in ["drawings", "ones"] {
            let mut engine = Engine::new(clip.clone()).unwrap();
            let free = engine.run(&recipe(&[("root", root)]), &Edits::default()).unwrap();
            let free = free.sheet.clone();
            let held = Sheet { feet: Feet::Held, ..free.clone() };
            let [(Some(slides), off), (Some(slip), held_off)] =
                [&free, &held].map(|sheet| judged(&clip, sheet))
            else {
                continue;
            };
            with_feet += 1;
            assert!(slip < 0.2 * slides, "{name}, {root}: {slip} of {slides}");
            assert!(held_off < off + 0.5, "{name}, {root}: {held_off} and {off}");
        }
    }
    assert!(with_feet >= paths.len(), "feet stand in {with_feet} of {} clips", paths.len());
}

#[test]
fn a_sheet_of_held_feet_has_them_in_every_pose_and_is_read_again() {
    let clip = clips::sample("kick.bvh");
    let mut engine = Engine::new(clip.clone()).unwrap();
    let free = engine.run(&Recipe::default(), &Edits::default()).unwrap().sheet.clone();
    let held = engine.run(&recipe(&[("feet", "held")]), &Edits::default()).unwrap().sheet.clone();
    assert_eq!(Sheet { feet: Feet::Free, ..held.clone() }, free, "the drawings are the same");
    for written in [limited_bvh, keys_bvh] {
        let [free, held] = [&free, &held].map(|sheet| written(&clip, sheet).unwrap());
        assert_ne!(free, held);
        assert_eq!(free.lines().count(), held.lines().count());
    }
}
