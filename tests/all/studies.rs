//! `genga study`, as a person or a script uses it.

use std::fs;

use crate::program::{Place, SAMPLES, column, text};

fn numbers(table: &str, name: &str) -> Vec<f64> {
    column(table, name).iter().map(|cell| cell.parse().unwrap()).collect()
}

#[test]
fn table_1_has_a_row_a_cell_and_persistence_runs_fastest() {
    let place = Place::new();
    for name in SAMPLES {
        let table = place.done(&format!("study data/{name}.bvh"));
        let header = "clip,filter.width,turns.persistence,turns,genga,fills,union,total\n";
        assert!(table.starts_with(header), "{table}");
        assert_eq!(column(&table, "clip"), [name; 6]);
        assert_eq!(column(&table, "filter.width"), ["10", "10", "20", "20", "30", "30"]);
        assert_eq!(column(&table, "turns.persistence"), ["5", "10", "5", "10", "5", "10"]);
        let (total, union) = (numbers(&table, "total"), numbers(&table, "union"));
        assert!(total.iter().zip(&union).all(|(total, union)| total >= union));
        assert!(union.chunks(2).all(|cells| cells[1] <= cells[0]), "M costs keys");
    }
    place.done("study data/kick.bvh --out s.csv --plot s.svg --heat h.svg -q");
    for picture in ["s.svg", "h.svg"] {
        assert!(fs::read(place.path(picture)).unwrap().starts_with(b"<svg"), "{picture}");
    }
    let written = fs::read_to_string(place.path("s.csv")).unwrap();
    assert_eq!(written, place.done("study data/kick.bvh"));
}

#[test]
fn pictures_in_other_formats_are_made_or_it_is_said_how_to_get_them() {
    let place = Place::new();
    for (ending, feature, is_here, begin) in [
        ("pdf", "pdf", cfg!(feature = "pdf"), &b"%PDF"[..]),
        ("png", "pictures", cfg!(feature = "pictures"), b"\x89PNG"),
    ] {
        let study = format!("study data/kick.bvh --plot s.{ending} --quiet");
        if is_here {
            place.done(&study);
            let picture = fs::read(place.path(&format!("s.{ending}"))).unwrap();
            assert!(picture.starts_with(begin), "{ending}");
        } else {
            assert!(place.refused(2, &study).contains(&format!("--features {feature} ")));
        }
    }
}

#[test]
fn the_short_options_take_lists_and_ranges() {
    let place = Place::new();
    let table =
        place.done("study data/kick.bvh --filter-width 0.2s,7 --persistence 3 --filter ideal");
    assert_eq!(column(&table, "filter.width"), ["0.2s", "7"]);
    let short = place.done("study data/kick.bvh --filter-width 4..8:2 --persistence 2..3:1");
    assert_eq!(column(&short, "filter.width"), ["4", "4", "6", "6", "8", "8"]);
    // The same axes are the same study however they are given.
    let long = "study data/kick.bvh --x filter.width=4,6,8 --y turns.persistence=2,3";
    assert_eq!(place.done(long), short);
    let turned = place.done("study data/kick.bvh --y filter.width=4,6,8 --x turns.persistence=2,3");
    let sorted = |table: &str| {
        let mut counts = column(table, "union");
        counts.sort();
        counts
    };
    assert_eq!(sorted(&turned), sorted(&short));
    // Those of Table 1 begin with its recipe.
    let table_1 = place.done("study data/kick.bvh");
    for axes in [
        "--filter-width 10,20,30 --persistence 5,10",
        "--x filter.width=10..30:10 --y turns.persistence=5,10",
    ] {
        assert_eq!(place.done(&format!("study data/kick.bvh {axes}")), table_1, "{axes}");
    }
    let said = |args: &str| text(&place.genga(&format!("study data/kick.bvh {args}")).stderr);
    assert!(
        said("--filter-width 4 --persistence 2").contains("that of Table 1 (genga recipe --study)")
    );
    for args in ["--x filter.width=4", "--x filter.width=4,5 --y turns.persistence=2 --stability"] {
        assert!(said(args).contains("recipe      設定       that of genga run"), "{args}");
    }
    fs::write(place.path("own.toml"), "[keys]\nmin_price = 3\n").unwrap();
    assert!(said("--x filter.width=4 --recipe own.toml").contains("設定       own.toml"));
}

#[test]
fn any_setting_is_an_axis_and_what_it_changes_is_counted() {
    let place = Place::new();
    let header = |args: &str| -> String {
        place.done(&format!("study data/kick.bvh {args}")).lines().next().unwrap().into()
    };
    assert_eq!(
        header("--x keys.per_second=2,4"),
        "clip,keys.per_second,turns,genga,fills,union,total"
    );
    let of_the_sheet =
        "drawings,drawings_per_second,genga_per_second,longest_hold,held_koma,peak_ssd,median_ssd";
    assert_eq!(
        header("--x omission.koma_dori=0,1/3 --y noise=0,1"),
        format!("clip,omission.koma_dori,noise,turns,genga,fills,union,total,{of_the_sheet}")
    );
    assert_eq!(
        header("--measure total,held_koma --show union"),
        "clip,filter.width,turns.persistence,total,held_koma,union"
    );
    // A cell equals a run with those settings.
    let table = place.done("study data/kick.bvh --x spacing.on=2,3 --measure drawings,held_koma");
    for (at, on) in ["2", "3"].into_iter().enumerate() {
        place.done(&format!("run data/kick.bvh --set spacing.on={on} --out run{on}"));
        let report = fs::read_to_string(place.path(&format!("run{on}/report.json"))).unwrap();
        for name in ["drawings", "held_koma"] {
            let value = &column(&table, name)[at];
            assert!(report.contains(&format!("\"{name}\": {value},")), "{name} {value}");
        }
    }
}

#[test]
fn genga_are_counted_one_way_with_the_first_and_the_last_drawing() {
    let place = Place::new();
    for name in SAMPLES {
        let said = text(&place.genga(&format!("run data/{name}.bvh --out {name}")).stderr);
        let file = |file: &str| fs::read_to_string(place.path(&format!("{name}/{file}"))).unwrap();
        let genga = column(&file("keys.csv"), "genga_no").len();
        assert!(
            said.contains(&format!("{genga}, first and last drawing among them")),
            "{name}: {said}"
        );
        assert!(file("report.json").contains(&format!("\"genga\": {genga},")), "{name}");
        assert!(file("sheet.svg").contains(&format!("  {genga} genga  ")), "{name}");
        let study = "--x rate=24 --measure genga,genga_per_second";
        let table = place.done(&format!("study data/{name}.bvh {study}"));
        assert_eq!(numbers(&table, "genga"), [genga as f64], "{name}");
        let report: serde_json::Value = serde_json::from_str(&file("report.json")).unwrap();
        assert_eq!(report["genga_per_second"], numbers(&table, "genga_per_second")[0], "{name}");
        let eval = place.done(&format!("eval {name}/sheet.json --clip data/{name}.bvh --json -"));
        let eval: serde_json::Value = serde_json::from_str(&eval).unwrap();
        assert_eq!(eval["pace"]["genga"], genga, "{name}");
    }
}

#[test]
fn a_caption_has_the_command_and_a_recipe_that_gives_the_same_table() {
    let place = Place::new();
    let study = "--x turns.persistence=0.05s,0.1s --set filter.width=0.2s --per-second";
    let args = format!("study data/kick.bvh data/pitch.bvh {study} --plot p.svg --caption c.md");
    let table = place.done(&args);
    let caption = fs::read_to_string(place.path("c.md")).unwrap();
    let begin = "**turns of the whole body** (全身の変わり目), a second of its sheet, over `turns.persistence`";
    assert!(caption.starts_with(begin), "{caption}");
    assert!(caption.contains("| kick | 3.83 |\n| pitch | "), "{caption}");
    let inside = |fence: &str| {
        let after = caption.split_once(fence).unwrap().1;
        after.split_once("```").unwrap().0.trim().to_owned()
    };
    let asked = args.split_once("pitch.bvh ").unwrap().1;
    assert!(
        inside("```sh").starts_with("genga study ") && inside("```sh").ends_with(asked),
        "{caption}"
    );
    fs::write(place.path("recipe.toml"), inside("```toml")).unwrap();
    let again =
        "study data/kick.bvh data/pitch.bvh --x turns.persistence=0.05s,0.1s --recipe recipe.toml";
    assert_eq!(place.done(again), table);
    let said = place.refused(2, "study data/kick.bvh --caption c.md");
    assert!(said.contains("--caption: is about a picture"), "{said}");
    let said = place.refused(2, "study data/kick.bvh --per-second");
    assert!(said.contains("--per-second: is about a picture"), "{said}");
    let said = place.refused(2, "study data/kick.bvh --plot p.svg --caption c.doc");
    assert!(said.contains("a caption is .md or .txt"), "{said}");
    let said = place.refused(2, "study data/kick.bvh --plot p.svg --per-second --show peak_ssd");
    assert!(said.contains("does not grow with the length of a clip"), "{said}");
}

#[test]
fn counts_a_second_are_divided_by_the_time_of_the_sheet_everywhere() {
    let place = Place::new();
    let shown = "--measure genga,genga_per_second --per-second --show genga";
    let files = "--heat h.svg --caption c.md";
    for (study, seconds) in [
        ("kuroda-pitch.bvh --x filter.width=10,20", "4.96"),
        ("kick.bvh --x rate=4,24", "3.83 to 4.00"),
        ("tennis.bvh --trim 7..85 --set loop=true --x cycles=1,2", "3.21"),
    ] {
        let table = place.done(&format!("study data/{study} {shown} {files}"));
        let caption = fs::read_to_string(place.path("c.md")).unwrap();
        assert!(caption.contains(&format!(" | {seconds} |")), "{study}: {caption}");
        let map = fs::read_to_string(place.path("h.svg")).unwrap();
        for value in numbers(&table, "genga_per_second") {
            let tenths = (10.0 * value).round() / 10.0;
            assert!(map.contains(&format!(">{tenths}<")), "{study}: {value}");
        }
    }
}

#[test]
fn joints_of_a_loop_are_counted_in_a_round_whatever_else_is_measured() {
    let place = Place::new();
    let study = "study data/tennis.bvh --trim 7..85 --set loop=true --x cycles=1,2 --measure union";
    let alone = numbers(&place.done(study), "union");
    assert_eq!(alone, numbers(&place.done(&format!("{study},genga")), "union"));
}

#[test]
fn what_the_axes_can_change_is_drawn_unless_it_is_said() {
    let place = Place::new();
    for (axes, title) in [
        ("--x filter.width=0.1s,0.2s", "Turns of the whole body"),
        ("--filter-width 10,20 --persistence 5,10", "Frames with a key of any"),
        ("--x turns.persistence=5,10 --y filter.width=10,20", "Frames with a key of any"),
        ("--x filter.width=10,20 --y turns.persistence=5,10 --stability", "Genga  原画"),
        ("--x keys.per_second=2,4", "Genga  原画"),
        ("--x filter.width=0.1s,0.2s --y spacing.on=2,3", "Drawings on the sheet"),
        ("--x keys.per_second=2,4 --show turns", "Turns of the whole body"),
        ("--x filter.width=10,20 --y turns.persistence=5,10 --paper", "Frames with a key of any"),
    ] {
        place.done(&format!("study data/kick.bvh {axes} --plot p.svg -q"));
        let svg = fs::read_to_string(place.path("p.svg")).unwrap();
        assert!(svg.contains(&format!(">{title}")), "{axes}: {svg}");
    }
}

#[test]
fn frames_on_an_axis_are_said_in_seconds() {
    let place = Place::new();
    let said = |args: &str| text(&place.genga(&format!("study {args} --measure union")).stderr);
    let table_1 = said("data/kuroda-pitch.bvh");
    assert!(
        table_1.contains("filter.width: 10, 20, 30 frames are 0.1s, 0.2s, 0.3s at 100 a second")
    );
    assert!(table_1.contains("(the paper: 10 frames at 100 a second are 0.1s)"), "{table_1}");
    let two = said("data/kick.bvh data/kuroda-pitch.bvh --x filter.width=1..9:1");
    for says in
        ["1 to 9 frames are 0.042s to 0.375s at 24", "1 to 9 frames are 0.01s to 0.09s at 100"]
    {
        assert!(two.contains(says), "{two}");
    }
    assert!(!two.contains("the paper"), "{two}");
    let others = said("data/kick.bvh --x filter.width=0.1s,0.2s --y spacing.on=2,3");
    assert!(!others.contains("frames are"), "{others}");
}

#[test]
fn several_clips_stand_one_under_the_other_under_names_that_tell_them_apart() {
    let place = Place::new();
    let axes = "--x filter.width=0.1s..0.2s:0.05s --measure union";
    let table =
        place.done(&format!("study data/kick.bvh data/pitch.bvh {axes} --plot p.svg --heat h.svg"));
    assert_eq!(column(&table, "clip"), ["kick", "kick", "kick", "pitch", "pitch", "pitch"]);
    let alone = ["kick", "pitch"]
        .map(|clip| numbers(&place.done(&format!("study data/{clip}.bvh {axes}")), "union"));
    assert_eq!(numbers(&table, "union"), alone.concat());
    let heat = fs::read_to_string(place.path("h.svg")).unwrap();
    assert!(heat.contains("median 中央値, number"));
    fs::create_dir(place.path("other")).unwrap();
    fs::copy(crate::clips::here("data/kick.bvh"), place.path("kick.bvh")).unwrap();
    fs::copy(place.path("kick.bvh"), place.path("other/kick.bvh")).unwrap();
    let table = place.done("study kick.bvh other/kick.bvh --x filter.width=3 --measure union");
    assert_eq!(column(&table, "clip"), ["kick.bvh", "other/kick.bvh"]);
}

#[test]
fn stability_compares_cells_and_names_the_plateau() {
    let place = Place::new();
    let args = "study data/kick.bvh --x filter.width=1..8:1 --y turns.persistence=1..4:1 --measure union,genga --set keys.merge=union --set spacing.on=1";
    let output = place.genga(&format!("{args} --stability --heat h.svg"));
    let (table, said) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(table.starts_with(
        "clip,filter.width,turns.persistence,union,genga,kept,mean_move,largest_move\n"
    ));
    assert!(numbers(&table, "kept").iter().all(|kept| (0.0..=1.0).contains(kept)));
    // A koma is a frame in this clip, and a key that moved further counts as another.
    assert!(numbers(&table, "largest_move").iter().all(|frames| *frames <= 1.0));
    let lines: Vec<&str> = said.lines().collect();
    let lines = &lines[3..];
    assert_eq!((lines.len(), lines[3]), (4, "files       h.svg"), "{said}");
    assert!(lines[1].starts_with("kick: the very same keys at filter.width "), "{said}");
    // Two cells may be further apart than each is from the one that is named.
    let within = "kick: each key within 1 koma of its place at filter.width ";
    assert!(lines[2].starts_with(within), "{said}");
    // The recipe's own 0.15 s are 3.6 frames here, so the nearest cell is 4 and 2.
    assert!(
        lines[1].contains("filter.width 1 to 2, ") && lines[1].ends_with("stand beside it"),
        "{said}"
    );
    assert!(
        lines[2].contains(", over filter.width 5 to 7, ") && lines[2].ends_with("stand beside it"),
        "{said}"
    );
    let heat = fs::read_to_string(place.path("h.svg")).unwrap();
    for words in
        ["same keys of the layer 原画が同じ", "nearly the same ほぼ同じ", "the recipe 現在のレシピ"]
    {
        assert!(heat.contains(words), "{words}");
    }
    // The compared measure is drawn.
    assert!(heat.contains("Genga"));
    // The mean move is no longer than the longest.
    let moves = numbers(&table, "mean_move").into_iter().zip(numbers(&table, "largest_move"));
    assert!(moves.clone().all(|(mean, most)| mean <= most && (mean > 0.0) == (most > 0.0)));
    assert!(numbers(&table, "kept").iter().any(|kept| *kept < 1.0));
    // With a tolerance of 0 no key may have moved.
    let exact = place.done(&format!("{args} --stability --tolerance 0 -q"));
    assert!(numbers(&exact, "largest_move").iter().all(|frames| *frames == 0.0));
    // Without --stability only the frames are said in seconds, and the keys are the same.
    fs::write(place.path("run.toml"), place.done("recipe")).unwrap();
    let plain = place.genga(&format!("{args} --recipe run.toml"));
    let is_told = |line: &str| line.starts_with("recipe ") || line.starts_with("seconds ");
    assert!(text(&plain.stderr).lines().all(is_told));
    assert_eq!(numbers(&text(&plain.stdout), "genga"), numbers(&table, "genga"));
    // The named region has a constant number of keys.
    let (columns, rows) =
        lines[1].split_once("filter.width ").unwrap().1.split_once(", turns.persistence ").unwrap();
    let ends = |text: &str| -> (f64, f64) {
        let text = text.split(':').next().unwrap();
        let (low, high) = text.split_once(" to ").unwrap_or((text, text));
        (low.parse().unwrap(), high.parse().unwrap())
    };
    let ((left, right), (low, high)) = (ends(columns), ends(rows));
    let count: f64 =
        lines[1].split(", ").find_map(|part| part.split_once(" key")?.0.parse().ok()).unwrap();
    let cells =
        numbers(&table, "filter.width").into_iter().zip(numbers(&table, "turns.persistence"));
    let held: Vec<f64> = cells
        .zip(numbers(&table, "genga"))
        .filter(|((x, y), keys)| {
            // The ends of rests need not be drawings.
            let is_named = (left..=right).contains(x) && (low..=high).contains(y);
            is_named && (count..=count + 2.0).contains(keys)
        })
        .map(|(_, keys)| keys)
        .collect();
    let said_cells: usize =
        lines[1].split(": ").nth(2).unwrap().split(" of ").next().unwrap().parse().unwrap();
    assert!(held.len() >= said_cells && said_cells > 1, "{said}");
}

#[test]
fn plateaus_are_named_of_each_clip_and_of_all() {
    let place = Place::new();
    let clips = "data/kick.bvh data/pitch.bvh";
    let axis = "--x keys.per_second=2,2.01,2.02,2.03 --measure genga --stability";
    let said = text(&place.genga(&format!("study {clips} {axis}")).stderr);
    let begins: Vec<&str> =
        said.lines().skip(2).map(|line| line.split(':').next().unwrap()).collect();
    assert_eq!(begins, ["kick", "kick", "pitch", "pitch", "all clips", "all clips"], "{said}");
    // A clip's lines are the same as for it alone; the line of all covers the keys of both.
    let alone = text(&place.genga(&format!("study data/pitch.bvh {axis}")).stderr);
    let lines = |said: &str, from: usize| -> Vec<String> {
        said.lines().skip(from).take(2).map(str::to_owned).collect()
    };
    assert_eq!(lines(&said, 4), lines(&alone, 2));
    assert!(lines(&said, 6).iter().all(|line| line.contains("keys.per_second ")), "{said}");
}

#[test]
fn settings_that_are_probably_not_meant_are_told() {
    let place = Place::new();
    let unit = " is in the unit of speed.measure=combined a second, and may hide";
    for args in [
        "study data/kick.bvh --set speed.measure=combined",
        "study data/kick.bvh --x speed.measure=rotation,combined --measure union",
        "keys data/kick.bvh --set speed.measure=combined --per-joint",
        "run data/kick.bvh --set speed.measure=combined --out a",
    ] {
        let said = text(&place.genga(args).stderr);
        assert_eq!(said.matches(unit).count(), 1, "{args}: {said}");
    }
    let said = text(
        &place
            .genga("study data/kick.bvh --x turns.steady=1,5% --set speed.measure=combined")
            .stderr,
    );
    assert!(!said.contains(unit), "{said}");
    let said = place.said("run data/kick.bvh --set filter.width=0.2 --out b");
    assert!(
        said.contains("filter.width: 0.2 is less than a frame; seconds are written 0.2s"),
        "{said}"
    );
    // A short recipe goes over the one that a study begins with.
    fs::write(place.path("r.toml"), "[spacing]\non = 2\n").unwrap();
    let said = text(&place.genga("study data/kick.bvh --recipe r.toml").stderr);
    assert!(said.contains("r.toml, over that of Table 1"), "{said}");
    let said = place.said("run data/kick.bvh --set exaggerate.ease=1 --deliver ae --out c");
    assert_eq!(said.matches("[W_EXAGGERATED]").count(), 1, "{said}");
}

/// A night's work on many clips is not lost to one of them.
#[test]
fn a_broken_clip_does_not_end_the_table_of_the_others() {
    let place = Place::new();
    fs::write(place.path("broken.bvh"), "HIERARCHY\nROOT").unwrap();
    for command in [
        "study {} --x filter.width=3,4 --out t.csv",
        "compare {} --keys 4 --out t.csv",
        "omit {} --table=t.csv",
    ] {
        let of = |clips: &str| command.replace("{}", clips);
        let output = place.genga(&of("data/kick.bvh broken.bvh none.bvh data/pitch.bvh"));
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        let told = ["genga: broken.bvh:2:", "genga: none.bvh: ", "2 of 4 clips failed"];
        assert!(told.iter().all(|told| said.contains(told)), "{said}");
        let rows = column(&fs::read_to_string(place.path("t.csv")).unwrap(), "clip");
        let is_row = |name: &str| rows.iter().any(|row| row == name);
        assert!(is_row("kick") && is_row("pitch") && !is_row("broken"), "{command}: {rows:?}");
        fs::remove_file(place.path("t.csv")).unwrap();
        // A frame that one clip lacks is its own fault.
        let output = place.genga(&format!("{} --trim 0..120", of("data/kick.bvh data/pitch.bvh")));
        let said = text(&output.stderr);
        assert!(said.contains("data/kick.bvh: --trim: cannot keep"), "{said}");
        assert_eq!(output.status.code(), Some(1), "{said}");
        fs::remove_file(place.path("t.csv")).unwrap();
        // There is no table without a clip.
        place.refused(1, &of("broken.bvh"));
        place.refused(1, &of("broken.bvh broken.bvh"));
        assert!(!place.path("t.csv").exists(), "{command}");
    }
}

#[test]
fn what_is_asked_wrongly_is_said_before_any_work() {
    let place = Place::new();
    for (args, says) in [
        ("--x filter.width=10..20", "has no step"),
        ("--x filter.widht=10", "did you mean filter.width"),
        ("--x filter.width=3 --y filter.width=4", "is on both axes"),
        ("--x filter.width=3 --filter-width 4", "cannot be used with"),
        ("--x filter.width=3 --set filter.width=4", "a study varies it already"),
        ("--x filter.kind=box --filter ideal", "a study varies it already"),
        ("--persistence 5,5", "stands twice"),
        ("--measure keys", "one of turns, genga, fills"),
        ("--x noise=-1", "0 to 180"),
        ("--x turns.steady=10 --plot s.svg --paper", "in frames alone"),
        ("--x filter.width=3 --stability", "there is one alone"),
        ("--tolerance 2", "--stability"),
        ("--stability --tolerance=-1", "expected koma"),
        ("--x spacing.on=2,3 --plot s.svg --paper", "in frames alone"),
        ("--plot s.jpg", "--plot: a picture is .svg, .pdf or .png"),
        ("--heat s.gif", "--heat: a picture is .svg, .pdf or .png"),
    ] {
        // If the clip were read first, the message would be about the missing clip.
        let said = place.refused(2, &format!("study none.bvh -o s.csv {args}"));
        assert!(said.contains(says), "{args}: {said}");
        assert!(!place.path("s.csv").exists(), "{args}");
    }
}

#[test]
fn turns_of_the_body_are_told_from_those_of_the_joints() {
    let place = Place::new();
    let counted = |args: &str| {
        let said = place.said(&format!("study data/kick.bvh --x filter.width=10 {args}"));
        said.lines().find(|line| line.starts_with("turns ")).map(str::to_owned)
    };
    let says = "turns       変わり目   turns: of the body; union, total: keys of joints (in report.json \
                turns.union, turns.total)";
    assert_eq!(counted("").as_deref(), Some(says));
    assert_eq!(counted("--measure turns,genga"), None, "nothing to confuse it with");
    assert_eq!(counted("--measure union,total"), None);
}
