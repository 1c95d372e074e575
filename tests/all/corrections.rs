//! Corrections add up from run to run into one folder, and the summary says what each did.

use std::fs;

use crate::clips::with;
use crate::folders::all;
use crate::program::{Place, column, text};

#[test]
fn corrections_of_a_folder_add_up_until_a_fresh_run() {
    let place = Place::new();
    place.done("run data/kick.bvh --pin 42:contact --set spacing.on=3 --out a");
    let second = place.said("run data/kick.bvh --forbid 50 --renumber --out a");
    let kept = "note        kept from a/recipe.toml (--fresh goes without): pin 42\n";
    assert!(second.contains(kept), "{second}");
    place.done("run data/kick.bvh --hold 60:6 --renumber --out a");
    place.done("run data/kick.bvh --out a");
    // Settings and corrections are those of all runs.
    let at_once = "--set spacing.on=3 --pin 42:contact --forbid 50 --hold 60:6 --out at-once";
    place.done(&format!("run data/kick.bvh {at_once}"));
    assert!(all(&place.path("a")) == all(&place.path("at-once")));
    // A later correction wins, and what it replaces is named.
    let third = place.said("run data/kick.bvh --forbid 40..44 --out a");
    assert!(third.contains("(--fresh goes without): forbid 50, hold 60:6\n"), "{third}");
    assert!(third.contains("of a/recipe.toml, replaced: pin 42\n"), "{third}");
    // None is lost where a run has no place for it.
    let part = place.refused(2, "run data/kick.bvh --trim 0..55 --out a");
    assert!(part.contains("would lose them: hold 60:6; --trim and --layers as before"), "{part}");
    // Settings alone leave them.
    fs::write(place.path("house.toml"), place.done("recipe")).unwrap();
    let house = place.said("run data/kick.bvh --recipe house.toml --out a");
    assert!(
        house.contains("(--fresh goes without): forbid 50, forbid 40..44, hold 60:6\n"),
        "{house}"
    );
    // A recipe that is named has the corrections that count.
    let named = place.said("run data/kick.bvh --recipe at-once/recipe.toml --renumber --out a");
    assert!(named.contains("without these of a/recipe.toml: forbid 40..44\n"), "{named}");
    place.done("run data/kick.bvh --recipe at-once/recipe.toml --out a");
    assert!(all(&place.path("a")) == all(&place.path("at-once")));
    let fresh = place.said("run data/kick.bvh --fresh --out a");
    assert!(!fresh.contains("kept from"), "{fresh}");
    place.done("run data/kick.bvh --out plain");
    assert!(all(&place.path("a")) == all(&place.path("plain")));
}

#[test]
fn a_later_move_to_a_frame_replaces_an_earlier_one() {
    let place = Place::new();
    place.done("run data/kick.bvh --move 73:75 --out a");
    let said = place.said("run data/kick.bvh --move 71:75 --out a");
    assert!(said.contains("of a/recipe.toml, replaced: move 73:75\n"), "{said}");
    assert!(said.contains("move 71:75: genga 12"), "{said}");
    let said = place.said("run data/kick.bvh --recipe a/recipe.toml --move 73:75 --out b");
    assert!(said.contains("no key is found at frame 73"), "{said}");
    let said = place.refused(2, "run data/kick.bvh --move 71:75,73:75 --out a");
    assert!(said.contains("frame 75 is pinned or moved to twice"), "{said}");
}

#[test]
fn a_pin_names_only_genga_whose_place_it_takes() {
    let place = Place::new();
    // What stood there is gone for another reason.
    let said = place.said("run data/kick.bvh --pin 12 --only-pins --out b");
    assert!(said.contains("pin 12: genga 2\n"), "{said}");
    let said = place.said("run data/kick.bvh --pin 42 --forbid 40 --out c");
    assert!(said.contains("pin 42: genga 7\n") && said.contains("genga at 41 is gone"), "{said}");
}

#[test]
fn the_last_drawing_is_held_to_the_end_of_the_cut() {
    let place = Place::new();
    let said = place.said("run data/kick.bvh --length 100 --hold 91:17 --deliver xdts,bvh --out a");
    assert!(!said.contains("was to stay") && !said.contains("カラ"), "{said}");
    let sheet = fs::read_to_string(place.path("a/sheet.csv")).unwrap();
    let koma = column(&sheet, "drawing");
    assert_eq!(koma.len(), 100);
    assert!(koma[83..].iter().all(|drawing| *drawing == koma[99]) && koma[82] != koma[99]);
    // Of several layers none ends before the others.
    place.done("run data/kick.bvh --layers limbs --length 120 --hold 91:17 --out d");
    let sheet = fs::read_to_string(place.path("d/sheet.csv")).unwrap();
    let layers = column(&sheet, "layer");
    let koma =
        ["A", "B", "C", "D", "E"].map(|own| layers.iter().filter(|name| *name == own).count());
    assert!(koma.iter().all(|other| *other == koma[0]) && koma[0] > 92, "{koma:?}");
    // What was written comes back as it is.
    place.done("deliver a/sheet.json data/kick.bvh --to csv,bvh --out b");
    place.done("deliver a/kick_douga_ts.xdts data/kick.bvh --to csv,bvh --out c");
    for file in ["sheet.csv", "limited.bvh"] {
        let written = fs::read(place.path(&format!("a/{file}"))).unwrap();
        assert!(fs::read(place.path(&format!("b/{file}"))).unwrap() == written, "{file}");
        assert!(fs::read(place.path(&format!("c/{file}"))).unwrap() == written, "{file}");
    }
}

#[test]
fn a_hold_that_is_not_kept_says_why() {
    let place = Place::new();
    let said = place.said("run data/kick.bvh --length 95 --hold 91:17 --out a");
    assert!(
        said.contains(
            "stays for 12: it is the last drawing, and the cut ends there; a greater length"
        ),
        "{said}"
    );
    let said = place.said("run data/tennis.bvh --hold 87:12 --out b");
    let ways = "that of frame 66 is on screen: a hold at 66 holds it; a pin at 87 makes one there";
    assert!(said.contains(ways), "{said}");
    let said = place.said("run data/kick.bvh --layers limbs --hold 42:6 --out c");
    assert!(
        said.contains("A/42 was to stay for 6 koma and stays for 7: none is left to follow"),
        "{said}"
    );
    let said = place.refused(2, "run data/kick.bvh --layers limbs --hold B/42:6 --out c");
    assert!(
        said.contains("a drawing is held in all layers, not in B alone: --hold 42:6"),
        "{said}"
    );
}

#[test]
fn settings_stay_in_their_folder_below_those_that_are_given() {
    let place = Place::new();
    let asked =
        "--set spacing.on=2 --root-on ones --layers limbs --set B/spacing.on=3 --seen-from side";
    place.done(&format!("run data/kick.bvh {asked} --pin 42 --out a"));
    let recipe = |folder: &str| fs::read_to_string(place.path(folder).join("recipe.toml")).unwrap();
    let before = recipe("a");
    let said = place.said("run data/kick.bvh --out a");
    let told = "settings as in a/recipe.toml (--fresh goes without): ";
    assert!(said.contains(told) && said.contains("--set spacing.on=2"), "{said}");
    assert_eq!(recipe("a"), before);
    place.done("run data/kick.bvh --set spacing.on=1 --forbid 50 --out a");
    let one = format!("{asked} --set spacing.on=1 --pin 42 --forbid 50");
    place.done(&format!("run data/kick.bvh {one} --out b"));
    assert_eq!(recipe("a"), recipe("b"));
    // A recipe has all its settings.
    fs::write(place.path("plain.toml"), place.done("recipe")).unwrap();
    let said = place.said("run data/kick.bvh --recipe plain.toml --layers limbs --out a");
    assert!(said.contains("pin 42") && !said.contains(told), "{said}");
    place.done("run data/kick.bvh --layers limbs --pin 42 --forbid 50 --out c");
    assert_eq!(recipe("a"), recipe("c"));
    place.done("run data/kick.bvh --fresh --out a");
    place.done("run data/kick.bvh --out d");
    assert_eq!(recipe("a"), recipe("d"));
    // What a target found is a setting.
    place.done("run data/kick.bvh --keys 8 --out d");
    assert!(place.said("run data/kick.bvh --out d").contains("原画       8, "));
    // A list has spaces, which a shell would part.
    place.done("run data/kick.bvh --within 20..40:spacing.on=1 --out e");
    let said = place.said("run data/kick.bvh --out e");
    assert!(
        said.contains(" --set \"passages=[{ frames = [20, 40], spacing.on = 1 }]\"\n"),
        "{said}"
    );
}

#[test]
fn a_target_finds_in_its_folder_what_it_finds_in_a_new_one() {
    let place = Place::new();
    let recipe = |folder: &str| fs::read_to_string(place.path(folder).join("recipe.toml")).unwrap();
    let targets = ["--drawings-per-second 6", "--keys 8", "--max-error 4%", "--keys 14"];
    for target in targets {
        let given = "--set filter.width=0.2s --pin 42";
        let before = place.path("a/recipe.toml").exists();
        let said = place.said(&format!("run data/kick.bvh {given} {target} --out a"));
        let stay = said.lines().find(|line| line.contains("settings as in")).unwrap_or_default();
        assert!(!stay.contains("keys."), "{said}");
        assert_eq!(
            said.contains("not as in a/recipe.toml, where an earlier target found"),
            before,
            "{said}"
        );
        // What was found stays while none is asked for.
        place.done("run data/kick.bvh --out a");
        place.done(&format!("run data/kick.bvh {given} {target} --fresh --out b"));
        assert_eq!(recipe("a"), recipe("b"), "{target}");
    }
    // A person's word counts, also after a target.
    place.done("run data/kick.bvh --set keys.min_price=2 --out a");
    place.done("run data/kick.bvh --drawings-per-second 6 --out a");
    let one = "--set filter.width=0.2s --set keys.min_price=2 --pin 42 --drawings-per-second 6";
    place.done(&format!("run data/kick.bvh {one} --fresh --out b"));
    assert_eq!(recipe("a"), recipe("b"));
}

#[test]
fn a_genga_that_only_moves_is_gone_after_the_range_that_is_named() {
    let place = Place::new();
    let said = place.said("run data/kick.bvh --forbid 50 --out a");
    let range = said.split("(--forbid ").nth(1).expect("it says how").split(' ').next().unwrap();
    let (from, past) = range.split_once("..").unwrap();
    let inside: std::ops::Range<usize> = from.parse().unwrap()..past.parse().unwrap();
    assert!(inside.contains(&48), "{said}");
    let genga = |folder: &str| {
        let table = fs::read_to_string(place.path(folder).join("keys.csv")).unwrap();
        column(&table, "source_frame").len()
    };
    place.done("run data/kick.bvh --out plain");
    place.done(&format!("run data/kick.bvh --forbid {range} --out b"));
    assert_eq!(genga("a"), genga("plain"));
    assert_eq!(genga("b"), genga("plain") - 1);
}

#[test]
fn a_number_of_genga_overrules_kept_switches_that_leave_none_to_find() {
    let place = Place::new();
    place.done("run data/kick.bvh --pin 42,60 --only-pins --out a");
    let first = place.said("run data/kick.bvh --pin 20 --out a");
    assert!(first.contains("pin 42, pin 60, only-pins\n"), "{first}");
    assert!(first.contains("genga       原画       5, first"), "{first}");
    let asked = place.said("run data/kick.bvh --keys 9 --out a");
    assert!(asked.contains("replaced: only-pins\n"), "{asked}");
    assert!(asked.contains("genga       原画       9, first"), "{asked}");
    place.done("run data/kick.bvh --freeze a --out a");
    let frozen = place.said("run data/kick.bvh --again --out a");
    assert!(frozen.contains("replaced: freeze\n"), "{frozen}");
}

#[test]
fn the_corrections_of_another_clip_are_not_taken_over() {
    let place = Place::new();
    place.done("run data/kick.bvh --pin 42 --out a");
    let other = place.said("run data/pitch.bvh --out a --force");
    assert!(!other.contains("kept from") && !other.contains("correction"), "{other}");
    place.done("run data/pitch.bvh --pin 42 --out a");
    fs::write(place.path("a/recipe.toml"), "[edits]\npins = 3\n").unwrap();
    let broken = place.refused(2, "run data/pitch.bvh --out a");
    assert!(broken.contains("a/recipe.toml:2:") && broken.contains("--fresh"), "{broken}");
}

#[test]
fn a_clash_with_a_correction_that_stays_names_its_recipe() {
    let place = Place::new();
    place.done("run data/kuroda-pitch.bvh --pin 100 --out a");
    let said = place.refused(2, "run data/kuroda-pitch.bvh --pin 101 --out a");
    let named = "take one of them away; corrections stay from a/recipe.toml";
    assert!(said.contains(named), "{said}");
}

#[test]
fn the_summary_says_what_each_correction_did() {
    let place = Place::new();
    let corrections = "--pin 42,60 --forbid 50 --move 71:74 --hold 33:6";
    let one = place.said(&format!("run data/kick.bvh {corrections} --out a"));
    let lines: Vec<&str> =
        one.lines().filter_map(|line| line.strip_prefix("correction  修正       ")).collect();
    assert_eq!(
        lines,
        [
            "hold 33: stays for 4 koma",
            "pin 42: genga 7 in place of 41",
            "forbid 50: genga 9 moved from 48 to 47 (--forbid 47..53 leaves none)",
            "pin 60: genga 11, a genga already, on koma 61",
            "move 71:74: genga 12",
        ]
    );
    // Within a koma of the genga it is that one that moves.
    place.done("run data/kuroda-pitch.bvh --out p");
    let genga = fs::read_to_string(place.path("p/keys.csv")).unwrap();
    let frame: usize = column(&genga, "source_frame")[3].parse().unwrap();
    let said = place.said(&format!(
        "run data/kuroda-pitch.bvh --move {}:{} --out p",
        frame - 1,
        frame + 2
    ));
    assert!(!said.contains("in place of"), "{said}");
    for (to, outcome) in [(28, "genga 3 in place of 28"), (30, "genga 4, past the genga at 28")] {
        let said = place.said(&format!("run data/kick.bvh --move 21:{to} --fresh --out a"));
        assert!(said.contains(&format!("move 21:{to}: {outcome}\n")), "{said}");
    }
    let layers = place.said("run data/kick.bvh --layers limbs --pin B/42 --out b");
    assert!(layers.contains("修正       pin B/42: genga "), "{layers}");
    assert_eq!(layers.matches("修正").count(), 1, "{layers}");
}

#[test]
fn another_part_of_the_take_than_the_recipes_run_is_told() {
    let place = Place::new();
    let says = "a recipe holds no part of a take: --trim 20..60 runs that part again";
    place.done("run data/kick.bvh --trim 20..60 --out a");
    // A results folder means the recipe in it.
    for recipe in ["a/recipe.toml", "a"] {
        let said = place.said(&format!("run data/kick.bvh --recipe {recipe} --out b"));
        assert!(said.contains(says), "{said}");
    }
    assert!(place.said("run data/kick.bvh --recipe a/recipe.toml --out a").contains(says));
    let same = place.said("run data/kick.bvh --recipe b/recipe.toml --out b");
    assert!(!same.contains("part of a take"), "{same}");
    let other = place.said("run data/pitch.bvh --recipe b/recipe.toml --out c");
    assert!(!other.contains("part of a take"), "{other}");
}

#[test]
fn corrections_of_another_motion_in_a_recipe_are_told() {
    let place = Place::new();
    let says = "a/recipe.toml has corrections of another motion, kick.bvh, which are made in this one too: pin 42; ";
    place.done("run data/kick.bvh --pin 42 --out a");
    assert!(place.said("run data/pitch.bvh --recipe a/recipe.toml --out b").contains(says));
    let same = place.said("run data/kick.bvh --recipe a/recipe.toml --out c");
    assert!(!same.contains("another motion"), "{same}");
}

#[test]
fn a_fault_in_a_recipe_names_its_file() {
    let place = Place::new();
    for (recipe, asked, says) in [
        ("[edits]\npins = [{ frame = 900 }]\n", "", "mine.toml: edits: pinned frame 900"),
        ("[edits]\npins = [{ frame = 900 }]\n", "--pin 9", "mine.toml: edits: pinned frame 900"),
        ("[edits]\npins = [{ frame = 9 }]\n", "--pin 900", "genga: edits: pinned frame 900"),
        (
            "[[edits.layers.B.pins]]\nframe = 9\n",
            "--keys 9",
            "mine.toml: edits: there is no layer B",
        ),
        ("[keys.weights]\nHipps = 0\n", "", "mine.toml: keys.weights.Hipps: "),
        ("[keys.weights]\n\"*\" = 0\n", "", "mine.toml: keys.weights: every joint has 0"),
        ("rate = 24\n", "--set keys.weights.Hipps=0", "genga: keys.weights.Hipps: "),
    ] {
        fs::write(place.path("mine.toml"), recipe).unwrap();
        let said = place.refused(2, &format!("run data/kick.bvh --recipe mine.toml {asked}"));
        assert!(said.contains(says), "{recipe}{asked}: {said}");
    }
}

#[test]
fn a_long_held_inbetween_is_told_and_a_pin_makes_it_a_genga() {
    let place = Place::new();
    let says = "an inbetween, drawing ";
    assert!(!place.said("run data/kick.bvh --out a").contains(says));
    let held = place.said("run data/kick.bvh --set spacing.drift=1 --out b");
    assert!(
        held.contains(&format!("{says}26, is held for 13 koma from koma 78; a pin at ")),
        "{held}"
    );
    let frame = held.split("; a pin at ").nth(1).unwrap().split(' ').next().unwrap();
    let pinned =
        place.said(&format!("run data/kick.bvh --set spacing.drift=1 --pin {frame} --out c"));
    assert!(!pinned.contains(says), "{pinned}");
    // Who holds it by hand knows.
    let by_hand = place.said("run data/kick.bvh --hold 12:13 --out d");
    assert!(!by_hand.contains(says), "{by_hand}");
}

#[test]
fn a_pin_on_a_genga_names_its_koma_on_the_sheet() {
    with(["cmu-135_04-front-kick"], |clips| {
        for clip in clips {
            let place = Place::new();
            let said = place.said(&format!("run {} --pin 813 --out a", clip.display()));
            let koma = said.split("a genga already, on koma ").nth(1).unwrap();
            let koma = koma.lines().next().unwrap();
            let keys = text(&place.files("a")["keys.csv"]);
            let [frames, begins] = ["source_frame", "koma_first"].map(|name| column(&keys, name));
            let at = frames.iter().position(|frame| frame == "813").unwrap();
            assert_eq!(begins[at], koma);
        }
    });
}

#[test]
fn pins_of_a_real_clip_have_the_number_that_the_table_gives_them() {
    with(["cmu-07_01-walk", "cmu-02_05-punch-strike"], |clips| {
        for clip in clips {
            let place = Place::new();
            let said = place.said(&format!("run {} --pin 40,91 --out a", clip.display()));
            let keys = text(&place.files("a")["keys.csv"]);
            let frames = column(&keys, "source_frame");
            for (frame, number) in frames.iter().zip(column(&keys, "genga_no")) {
                let line = format!("pin {frame}: genga {number}");
                assert!(!["40", "91"].contains(&&**frame) || said.contains(&line), "{said}");
            }
            assert!(["40", "91"].iter().all(|pin| frames.contains(&(*pin).to_owned())));
        }
    });
}

#[test]
fn a_hold_by_hand_is_not_drawn_as_koma_dori() {
    let place = Place::new();
    let rings = |folder: &str| {
        let picture = text(&place.files(folder)["sheet.svg"]);
        let drawn = picture.matches("fill=\"#ffffff\" stroke=\"#686e76\"").count();
        (drawn, picture.contains("held by hand 手動の止め"))
    };
    place.done("run data/kick.bvh --out found");
    assert_eq!(rings("found"), (1, false), "the legend alone");
    place.done("run data/kick.bvh --hold 44:8 --out held");
    assert_eq!(rings("held"), (1, true));
}
