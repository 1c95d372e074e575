//! Loops: sheets that repeat, through the program and on real walks.

use std::fs;

use genga::edits::Edits;
use genga::keys::Cycle;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Role, Sheet};
use genga::time::Frame;
use genga_files::limited;

use crate::clips;
use crate::program::{Place, column, text};

/// A correction is given by the frame that a picture names.
#[test]
fn pictures_of_a_loop_name_the_frames_of_the_clip() {
    let place = Place::new();
    let loop_of = "run data/tennis.bvh --trim 7..85 --loop --deliver contact,flipbook,xsheet";
    for cycles in [1, 2] {
        let out = format!("loop{cycles}");
        place.done(&format!("{loop_of} --cycles {cycles} --out {out}"));
        let files = place.files(&out);
        let table = text(&files["drawings.csv"]);
        let all: Vec<f64> =
            column(&table, "source_frame").iter().map(|frame| frame.parse().unwrap()).collect();
        for (file, word) in [("contact.svg", ">frame "), ("flipbook.html", "\"frame\":")] {
            let page = text(&files[file]);
            let named = page.split(word).skip(1).map(|rest| {
                let end = rest.find(|next: char| !next.is_ascii_digit() && next != '.').unwrap();
                rest[..end].parse::<f64>().unwrap()
            });
            let named: Vec<f64> = named.collect();
            let is_there = |frame: &f64| all.iter().any(|own| (own - frame).abs() <= 0.051);
            assert!(named.len() > 3 && named.iter().all(is_there), "{file}: {named:?} {all:?}");
        }
        // A drawing of a loop comes again in every round.
        let report: serde_json::Value = serde_json::from_slice(&files["report.json"]).unwrap();
        let number = |name: &str| report[name].as_f64().unwrap();
        let a_round = number("drawings") * 24.0 * f64::from(cycles) / number("koma");
        assert!((number("drawings_per_second") - a_round).abs() < 1e-9, "{report}");
        let a_round = number("genga") * 24.0 * f64::from(cycles) / number("koma");
        assert!((number("genga_per_second") - a_round).abs() < 1e-9, "{report}");
    }
}

#[test]
fn a_loop_that_stays_from_the_run_before_is_known_as_one() {
    let place = Place::new();
    let seam = "the seam of the loop may show";
    let said = place.said("run data/tennis.bvh --trim 7..60 --loop --out a");
    assert!(said.contains(seam), "{said}");
    let said = place.said("run data/tennis.bvh --trim 7..60 --pin 20 --out a");
    assert!(said.contains(seam), "{said}");
    place.done("run data/swing.bvh --trim 5..29 --loop --out b");
    let said = place.refused(2, "run data/swing.bvh --pin 20 --out b");
    assert!(said.contains("the last pose is not the first"), "{said}");
    assert!(said.contains("--trim 5..29 runs that part again"), "{said}");
}

/// The looped sheet of a clip with some changed settings.
fn looped(clip: &Clip, settings: &[(&str, &str)]) -> Sheet {
    let mut recipe = Recipe { r#loop: true, ..Recipe::default() };
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.run_once(&recipe, &Edits::default()).unwrap().sheet.clone()
}

#[test]
fn real_walks_offer_rounds_of_two_steps_that_loop() {
    clips::with(["cmu-07_01-walk", "cmu-09_01-run"], |paths| {
        for path in paths {
            let (name, clip) = (clips::name(&path), clips::read(&path));
            let cycles = Cycle::find_all(&clip);
            assert!(!cycles.is_empty(), "{name}");
            let best = cycles[0];
            assert!(best.pose < 5.0 && best.is_repeatable(), "{name}: {best:?}");
            let round = clip.trimmed(best.first, Frame(best.last.0 + 1)).unwrap();
            let sheet = looped(&round, &[("cycles", "3"), ("root", "ones")]);
            let koma = best.koma(round.rate()).round() as usize;
            assert_eq!((sheet.length(), sheet.rounds()), (3 * koma, 3), "{name}");
            let layer = &sheet.layers[0];
            assert!(layer.drawings.iter().all(|drawing| drawing.role != Role::End), "{name}");
            assert!(layer.genga() >= 4, "{name}: two steps have genga");
            // The body goes on through both seams as it does elsewhere.
            let played = limited(&round, &sheet).unwrap();
            let places: Vec<[f64; 2]> = played.rows().map(|row| [row[0], row[2]]).collect();
            let way = |pair: &[[f64; 2]]| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
            let ways: Vec<f64> = places.windows(2).map(way).collect();
            let mean = ways.iter().sum::<f64>() / ways.len() as f64;
            let (least, most) = (
                ways.iter().copied().fold(f64::MAX, f64::min),
                ways.iter().copied().fold(0.0, f64::max),
            );
            assert!(least > 0.4 * mean && most < 2.0 * mean, "{name}: {least} {mean} {most}");
        }
    });
}

#[test]
fn a_loop_has_nearly_the_same_genga_wherever_a_real_cycle_begins() {
    clips::with(["cmu-07_01-walk"], |paths| {
        let clip = clips::read(&paths[0]);
        let cycles = Cycle::find_all(&clip);
        let frames = cycles[0].frames();
        let round = clip.trimmed(cycles[0].first, Frame(cycles[0].last.0 + 1)).unwrap();
        let count = looped(&round, &[]).layers[0].genga();
        // The same round, begun a third of it later.
        let laid = genga::motion::laid(&round, 2, 0);
        let first = laid.first().0 + frames / 3;
        let later = laid.trimmed(Frame(first), Frame(first + frames + 1)).unwrap();
        assert!(looped(&later, &[]).layers[0].genga().abs_diff(count) <= 1, "{count}");
    });
}

mod program {
    use super::*;

    fn place() -> Place {
        let place = Place::new();
        for name in ["tennis", "kick", "pitch"] {
            let motion = fs::read(clips::here(&format!("data/{name}.bvh"))).unwrap();
            fs::write(place.path(&format!("{name}.bvh")), motion).unwrap();
        }
        place
    }

    fn read(place: &Place, file: &str) -> String {
        fs::read_to_string(place.path(file)).unwrap()
    }

    #[test]
    fn a_run_says_that_a_clip_can_be_repeated_and_changes_nothing_else() {
        let place = place();
        let said = |args: &str| text(&place.genga(args).stderr);
        let hint = "the last pose is the first: the setting loop makes a sheet that repeats";
        assert!(said("run tennis.bvh --out plain").contains(&format!("{hint} [W_CYCLE]")));
        assert!(!said("run kick.bvh --out kick").contains(hint));
        let looped = said("run tennis.bvh --loop --out looped");
        assert!(!looped.contains(hint), "{looped}");
        assert!(
            looped.contains("loop        リピート   87 koma a round (87.00 in the take), 1 round;"),
            "{looped}"
        );
        assert!(!read(&place, "plain/sheet.json").contains("\"loop\": {"));
    }

    #[test]
    fn the_rounds_of_a_loop_show_the_same_drawings_in_every_file() {
        let place = place();
        place.done("run tennis.bvh --loop --cycles 3 --deliver xdts,sts,xsheet,glb --out loop");
        let sheet: serde_json::Value =
            serde_json::from_str(&read(&place, "loop/sheet.json")).unwrap();
        assert_eq!(sheet["loop"], serde_json::json!({"frames": 87, "koma": 87}));
        let table = read(&place, "loop/sheet.csv");
        let shown = column(&table, "drawing");
        assert_eq!(shown.len(), 3 * 87);
        assert_eq!(shown[..87], shown[87..174]);
        assert_eq!(shown[..87], shown[174..]);
        assert_eq!((&*shown[0], &*column(&table, "role")[0]), ("1", "genga"));
        assert_ne!(shown[86], "1");
        let motion = bvh::read(&fs::read(place.path("loop/limited.bvh")).unwrap()).unwrap().clip;
        assert_eq!(motion.len(), 3 * 87);
        let paper = read(&place, "loop/tennis_xsheet.html");
        let repeats = paper.matches(">ピ<").count();
        assert_eq!(repeats, 2, "once in ACTION, once in CELL");
        let recipe = read(&place, "loop/recipe.toml");
        assert!(
            recipe.contains("\nloop = true\n") && recipe.contains("\ncycles = 3\n"),
            "{recipe}"
        );
        place.done("run tennis.bvh --recipe loop/recipe.toml --out again");
        assert_eq!(read(&place, "again/sheet.json"), read(&place, "loop/sheet.json"));
        place.done("deliver loop/sheet.json tennis.bvh --to bvh,xdts --out delivered");
        for file in ["limited.bvh", "tennis_douga_ts.xdts"] {
            assert_eq!(
                read(&place, &format!("delivered/{file}")),
                read(&place, &format!("loop/{file}"))
            );
        }
    }

    #[test]
    fn an_exaggerated_loop_is_delivered_as_it_was_run() {
        let place = place();
        place.done("run tennis.bvh --loop --set exaggerate.cartoon=0.5 --out loop");
        place.done("deliver loop/sheet.json tennis.bvh --to bvh --out delivered");
        assert_eq!(read(&place, "delivered/limited.bvh"), read(&place, "loop/limited.bvh"));
    }

    #[test]
    fn what_cannot_repeat_is_refused_with_the_way_out() {
        let place = place();
        let refused = |args: &str| place.refused(2, args);
        assert!(
            refused("run tennis.bvh --cycles 3")
                .contains("only a loop has several rounds; --loop makes one")
        );
        assert!(refused("run tennis.bvh --loop --cycles 0").contains("1 to 1000"));
        let said = refused("run pitch.bvh --loop");
        assert!(said.contains("loop: the last pose is not the first: they are "), "{said}");
        assert!(said.contains("genga split --cycles lists the best rounds"), "{said}");
    }

    #[test]
    fn the_best_cycles_are_listed_and_written() {
        let place = place();
        let table = place.done("split tennis.bvh --cycles");
        assert!(table.starts_with("cycle 循環  --trim"), "{table}");
        place.done("split tennis.bvh --cycles --out parts");
        let csv = read(&place, "parts/tennis-cycles.csv");
        let poses: Vec<f64> =
            column(&csv, "pose").iter().map(|pose| pose.parse().unwrap()).collect();
        assert!(!poses.is_empty() && poses.iter().all(|pose| *pose < 8.0), "{csv}");
        let [from, to] =
            ["from_frame", "to_frame"].map(|name| column(&csv, name)[0].parse::<usize>().unwrap());
        let own =
            bvh::read(&fs::read(place.path("parts/tennis-cycle-01.bvh")).unwrap()).unwrap().clip;
        assert_eq!(own.len(), to - from + 1);
        place.done(&format!("run tennis.bvh --trim {from}..{} --loop --out round", to + 1));
    }
}
