//! The default recipe gives a usable sheet on every real clip.

use std::path::Path;

use genga::edits::Edits;
use genga::keys::Reference;
use genga::motion::{Clip, bvh};
use genga::pipeline::{Breakdown, Engine};
use genga::recipe::Recipe;
use genga::sheet::{Exposure, Layer, Reason, Role, Source};
use genga::time::Frame;
use genga_files::{Report, limited_bvh};

use crate::clips;

/// Runs the default recipe on every real clip, and passes the file name, the clip as read with its lead-in, and the
/// breakdown.
fn each(look: impl Fn(&str, &Clip, &Breakdown)) {
    for path in clips::all() {
        let name = clips::name(&path);
        let mut engine = Engine::new(clips::read(&path)).unwrap();
        let breakdown = engine.run(&Recipe::default(), &Edits::default()).unwrap();
        look(&name, &whole(&path), &breakdown);
    }
}

/// Largest distance of the body from a held drawing, in % of its height; and number of koma that a drawing may stay
/// beyond it, because of naka-nashi or because it and the next are small movements.
const ALIKE: f64 = 3.3;
const BESIDE: usize = 7;

/// Drawings per second where the body moves. And for every long hold, its begin and whether the body stays like it
/// meanwhile.
fn moving(breakdown: &Breakdown<'_>) -> (f64, Vec<(usize, bool)>) {
    let koma = |frame: &Frame| breakdown.clock.koma_from_frame(*frame);
    let rests =
        breakdown.first_layer().keys.rests.iter().map(|rest| koma(rest.start())..koma(rest.end()));
    let rests: Vec<_> = rests.collect();
    let is_still = |koma: usize| rests.iter().any(|rest| rest.contains(&koma));
    let layer = &breakdown.sheet.layers[0];
    let drawings = layer.timed().filter(|(begin, _)| !is_still(*begin)).count();
    let koma = (0..layer.length()).filter(|koma| !is_still(*koma)).count();
    let reference = Reference::new(breakdown.clip, breakdown.clock);
    let is_alike = |begin: usize, shown: &Exposure| {
        let place = layer.drawings[shown.drawing].source.place();
        let own = breakdown.clock.koma_from_place(place).min(reference.koma() - 1);
        let unlike = |koma: &usize| reference.unlike(own, *koma) >= ALIKE;
        (begin..begin + shown.koma).filter(unlike).count() <= BESIDE
    };
    let long = layer.timed().filter(|(_, shown)| shown.koma > BESIDE);
    let long = long.map(|(begin, shown)| (begin, is_alike(begin, &shown)));
    (24.0 * drawings as f64 / koma as f64, long.collect())
}

fn whole(path: &Path) -> Clip {
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

/// Koma, place and role of every drawing that must stay.
fn kept(layer: &Layer) -> Vec<(usize, f64, Role)> {
    layer
        .timed()
        .map(|(begin, exposure)| (begin, &layer.drawings[exposure.drawing]))
        .filter(|(_, drawing)| drawing.role.is_kept())
        .map(|(begin, drawing)| (begin, drawing.source.place(), drawing.role))
        .collect()
}

#[test]
fn the_defaults_give_a_usual_number_of_genga_and_drawings() {
    each(|name, _, breakdown| {
        let report = Report::new(breakdown, vec![]);
        let (genga, drawings) = (report.genga_per_second, report.drawings_per_second);
        let figures = format!("{name}: {genga:.2} genga, {drawings:.2} drawings a second");
        assert!((1.5..=11.0).contains(&genga), "{figures}");
        let (moving, resting) = moving(breakdown);
        assert!((5.0..=14.0).contains(&moving), "{figures}, {moving:.2} while it moves");
        assert!(drawings <= moving + 0.5, "{figures}: what rests is held");
        for (koma, held) in resting {
            assert!(held, "{name}: held from {koma} on, where the body is elsewhere");
        }
        assert_eq!(breakdown.sheet.length(), breakdown.spaced.length(), "{name}");
    });
}

#[test]
fn no_genga_is_moved_deleted_or_replaced() {
    each(|name, _, breakdown| {
        // The steps of a gait have their own rhythm.
        let steps = breakdown.spaced.layers[0].drawings.iter();
        let steps = steps.filter(|drawing| drawing.why.reason == Some(Reason::Step));
        let steps: Vec<f64> = steps.map(|drawing| drawing.source.place()).collect();
        let is_step = |place: f64| steps.contains(&place);
        let before = kept(&breakdown.spaced.layers[0]);
        let after = kept(&breakdown.sheet.layers[0]);
        assert!(before.len() > 4 && after.len() == before.len(), "{name}");
        for ((koma, place, role), (shown, own, is)) in before.into_iter().zip(after) {
            assert_eq!((place, role), (own, is), "{name}");
            // A fill lies in transit, and may come later.
            assert!((koma..=koma + 3).contains(&shown), "{name}: {shown} for {koma}");
            if role == Role::Genga && !is_step(place) {
                assert_eq!(place.fract(), 0.0, "{name}: the genga on koma {koma}");
                let late = breakdown.clock.place_from_koma(koma) - place;
                let half = 0.5 * breakdown.clock.frames_in_koma();
                assert!(late <= half + 1e-6, "{name}: the genga of frame {place} on koma {koma}");
            }
        }
    });
}

#[test]
fn source_places_run_forward_and_none_lies_in_the_lead_in() {
    each(|name, _, breakdown| {
        let first = breakdown.clip.first().0 as f64;
        for sheet in [breakdown.spaced, breakdown.sheet] {
            let places: Vec<f64> =
                sheet.layers[0].drawings.iter().map(|drawing| drawing.source.place()).collect();
            assert!(places.is_sorted_by(|a, b| a < b), "{name}: {places:?}");
            assert_eq!(places[0], first, "{name}");
        }
        let gone = breakdown
            .first_layer()
            .omission
            .naka_nashi
            .gone
            .iter()
            .chain(&breakdown.first_layer().omission.koma_dori.gone);
        for gone in gone {
            assert!(gone.place > first, "{name}: {gone:?}");
        }
    });
}

#[test]
fn limited_motion_read_back_holds_where_the_sheet_holds() {
    each(|name, whole, breakdown| {
        let layer = &breakdown.sheet.layers[0];
        let text = limited_bvh(breakdown.clip, breakdown.sheet).unwrap();
        let read = bvh::read(text.as_bytes()).unwrap();
        assert!(read.warnings.is_empty(), "{name}: {:?}", read.warnings);
        let limited = read.clip;
        assert_eq!((limited.len(), limited.rate().fps()), (layer.length(), 24.0), "{name}");
        assert_eq!(limited.skeleton(), whole.skeleton(), "{name}");
        let shown: Vec<usize> = layer.koma().collect();
        for (koma, pair) in shown.windows(2).enumerate() {
            let [before, after] = [koma, koma + 1].map(|koma| limited.row(Frame(koma)));
            assert_eq!(before == after, pair[0] == pair[1], "{name}, koma {koma}");
        }
        for (koma, drawing) in shown.iter().enumerate() {
            if let Source::At(place) = layer.drawings[*drawing].source
                && place.fract() == 0.0
            {
                // Frame numbers are those of the file, lead-in included.
                let source = whole.row(Frame(place as usize));
                assert_eq!(limited.row(Frame(koma)), source, "{name}, koma {koma}");
            }
        }
    });
}
