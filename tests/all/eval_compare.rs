//! `genga eval` and `genga compare`, as a person or a script uses them.

use std::fs;

use crate::cases::is_full;
use crate::program::{Place, column, text};

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_sheet_is_judged_by_its_source_and_by_keys() {
    let place = Place::new();
    place.done("run data/kick.bvh --out out -q");
    let page = place.done("eval out/sheet.json --clip data/kick.bvh");
    for word in ["シート", "exposures", "keys alone", "on screen", "slip", "in source", "pops"] {
        assert!(page.contains(word), "no word of {word} in\n{page}");
    }
    assert!(!page.contains("precision"), "{page}");
    assert_eq!(place.done("eval out --clip data/kick.bvh"), page, "a results folder is its sheet");
    let found = json(&place.done("eval out/sheet.json --clip data/kick.bvh --json -"));
    let pace = &found["pace"];
    let report = json(&fs::read_to_string(place.path("out/report.json")).unwrap());
    for count in ["koma", "drawings", "genga"] {
        assert_eq!(pace[count], report[count], "{count}");
    }
    let koma = |(koma, count): (&String, &serde_json::Value)| {
        koma.parse::<u64>().unwrap() * count.as_u64().unwrap()
    };
    assert_eq!(pace["holds"].as_object().unwrap().iter().map(koma).sum::<u64>(), 92);
    let worst = |of: &str| found[of]["worst"].as_f64().unwrap();
    assert!(worst("keys") > 0.0 && worst("shown") > 0.0);
    assert!(found["timing"].is_null());
}

#[test]
fn keys_are_read_from_whatever_has_them_and_their_own_are_all_found() {
    let place = Place::new();
    place.done("run data/kick.bvh --out out -q");
    let table = fs::read_to_string(place.path("out/keys.csv")).unwrap();
    let rows = column(&table, "role").into_iter().zip(column(&table, "source_frame"));
    let genga: Vec<String> =
        rows.filter(|(role, _)| role == "genga").map(|(_, frame)| frame).collect();
    fs::write(place.path("list.txt"), genga.join("\n")).unwrap();
    fs::write(place.path("other.csv"), format!("frame\n{}\n", genga.join("\n"))).unwrap();
    for keys in ["out/keys.csv", "out/sheet.json", "list.txt", "other.csv"] {
        let eval = format!("eval out/sheet.json --clip data/kick.bvh --reference {keys}");
        let timing = &json(&place.done(&format!("{eval} --json -")))["timing"];
        assert_eq!(timing["f1"], 1.0, "{keys}");
        assert_eq!(timing["reference"], genga.len(), "{keys}");
        assert_eq!(timing["mean_off"], 0.0, "{keys}");
        let page = place.done(&format!("{eval} --tolerance 0.5 --json m.json"));
        let widest = page.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(100), "{page}");
        assert!(page.contains("precision 1.00, recall 1.00, F1 1.00"), "{page}");
        assert!(page.contains("within 0.5 koma"), "{page}");
        assert_eq!(&json(&fs::read_to_string(place.path("m.json")).unwrap())["timing"], timing);
    }
    let last: usize = genga.last().unwrap().parse().unwrap();
    fs::write(place.path("list.txt"), format!("{last}\n{last}\n")).unwrap();
    let output =
        place.genga("eval out/sheet.json --clip data/kick.bvh --reference list.txt --json -");
    let repeated = "1 reference key repeats another one and does not count";
    assert!(text(&output.stderr).contains(repeated), "{}", text(&output.stderr));
    assert_eq!(json(&text(&output.stdout))["timing"]["recall"], 1.0);
    fs::write(place.path("list.txt"), format!("{last}\n99999\n")).unwrap();
    let output =
        place.genga("eval out/sheet.json --clip data/kick.bvh --reference list.txt --json -");
    assert!(text(&output.stderr).contains("1 reference key beyond frames 0 to "));
    assert_eq!(json(&text(&output.stdout))["timing"]["reference"], 1);
    let page = place.done("eval out/sheet.json --clip data/kick.bvh --reference list.txt");
    assert!(page.contains("and 1 reference key between the ends, within 1 koma"), "{page}");
    fs::write(place.path("list.txt"), "0\n").unwrap();
    let page = place.done("eval out/sheet.json --clip data/kick.bvh --reference list.txt");
    assert!(page.contains("no key of it stands between the ends, frames 0 and "), "{page}");
    assert!(!page.contains("F1"), "{page}");
}

#[test]
fn what_lies_in_the_last_koma_is_an_end() {
    let place = Place::new();
    place.done("run data/kuroda-pitch.bvh --out out -q");
    let table = fs::read_to_string(place.path("out/keys.csv")).unwrap();
    let all = column(&table, "source_frame");
    let end = all.last().unwrap().parse::<f64>().unwrap().round() as usize;
    fs::write(place.path("all.txt"), all.join("\n")).unwrap();
    let eval = "eval out/sheet.json --clip data/kuroda-pitch.bvh --reference";
    let output = place.genga(&format!("{eval} all.txt --json -"));
    assert!(!text(&output.stderr).contains("reference key"), "{}", text(&output.stderr));
    let timing = json(&text(&output.stdout))["timing"].clone();
    assert_eq!(timing["reference"], all.len() - 2, "{timing}");
    assert_eq!(timing["f1"], 1.0, "{timing}");
    fs::write(place.path("all.txt"), format!("{}\n{}", all.join("\n"), end + 1)).unwrap();
    let output = place.genga(&format!("{eval} all.txt --json -"));
    let told = format!("or from frame {end} on, in the first or last koma, does not count");
    assert!(text(&output.stderr).contains(&told), "{}", text(&output.stderr));
    assert_eq!(json(&text(&output.stdout))["timing"], timing);
}

#[test]
fn keys_a_little_aside_are_judged_by_how_far_and_not_by_their_koma() {
    let place = Place::new();
    place.done("run data/kuroda-pitch.bvh --out out -q");
    let table = fs::read_to_string(place.path("out/keys.csv")).unwrap();
    let rows = column(&table, "role").into_iter().zip(column(&table, "source_frame"));
    let genga: Vec<usize> =
        rows.filter(|(role, _)| role == "genga").map(|(_, frame)| frame.parse().unwrap()).collect();
    let sheet = json(&fs::read_to_string(place.path("out/sheet.json")).unwrap());
    let in_koma = sheet["clip"]["frame_rate"].as_f64().unwrap() / 24.0;
    let timing = |by: f64, tolerance: &str| {
        let by = (by * in_koma).round() as usize;
        let moved: Vec<String> = genga.iter().map(|frame| (frame + by).to_string()).collect();
        fs::write(place.path("moved.txt"), moved.join("\n")).unwrap();
        let eval =
            "eval out/sheet.json --clip data/kuroda-pitch.bvh --reference moved.txt --json -";
        json(&place.done(&format!("{eval} --tolerance {tolerance}")))["timing"].clone()
    };
    let near = timing(0.4, "0.5");
    assert_eq!(near["f1"], 1.0, "{near}");
    let off = near["mean_off"].as_f64().unwrap();
    assert!((off - (0.4 * in_koma).round() / in_koma).abs() < 1e-9, "{near}");
    let far = timing(1.2, "1");
    let by = (1.2 * in_koma).round() as usize;
    let has_neighbour =
        |frame: &&usize| genga.iter().any(|other| (*frame + by).abs_diff(*other) as f64 <= in_koma);
    let neighbours = genga.iter().filter(has_neighbour).count();
    assert!(far["pairs"].as_u64().unwrap() <= neighbours as u64, "{far}");
    assert!(neighbours * 4 < genga.len() && far["f1"].as_f64().unwrap() < 0.3, "{far}");
}

#[test]
fn what_cannot_be_judged_is_refused_with_its_place() {
    let place = Place::new();
    place.done("run data/kick.bvh --out out -q");
    fs::write(place.path("bad.csv"), "frame,name\n12,a\nsoon,b\n").unwrap();
    fs::write(place.path("koma.csv"), "koma\n12\n").unwrap();
    let eval = "eval out/sheet.json --clip data/kick.bvh";
    let said = place.refused(1, &format!("{eval} --reference bad.csv"));
    assert_eq!(said, "genga: bad.csv:3:1: expected the number of a source frame, found \"soon\"\n");
    let said = place.refused(1, &format!("{eval} --reference koma.csv"));
    assert!(said.contains("koma.csv: the table has no column frame"), "{said}");
    let said = place.refused(1, "eval out/sheet.json --clip data/kuroda-pitch.bvh");
    assert!(said.contains("the sheet is for 24 frames a second"), "{said}");
    let said = place.refused(2, &format!("{eval} --json out/sheet.json"));
    assert!(said.contains("this is the sheet itself"), "{said}");
    let said = place.refused(2, "eval - --clip -");
    assert!(said.contains("only one of sheet, clip and reference"), "{said}");
    place.refused(2, &format!("{eval} --tolerance -1 --reference out/keys.csv"));
    place.refused(2, &format!("{eval} --tolerance 2"));
}

#[test]
fn methods_stand_side_by_side_on_as_many_keys() {
    let place = Place::new();
    let page = place.done("compare data/kick.bvh --trim 0..48 --keys 8,4");
    for word in ["genga", "optimal-mean", "optimal-worst", "rdp", "polyline", "kt11", "uniform"] {
        let rows = page.lines().filter(|line| line.contains(&format!(" {word} "))).count();
        assert!(rows >= 2, "{rows} rows of {word} in\n{page}");
    }
    assert!(
        !page.contains("ms")
            && place.done("compare data/kick.bvh --trim 0..48 --times").contains("ms")
    );
    // Noise makes it take ten times as long.
    let noise = if is_full() { "" } else { " --noise 0" };
    let both = format!("compare data/kick.bvh data/pitch.bvh --trim 0..48{noise} --out -");
    let table = place.done(&format!("{both} --keys 8,4"));
    assert_eq!(column(&table, "clip").len(), 2 * (2 * 7 + 2));
    assert_eq!(column(&table, "asked")[..8].join(" "), "4 4 4 4 4 4 4 8");
    for measure in ["hits", "by_chance"] {
        let shares: Vec<f64> =
            column(&table, measure).iter().map(|share| share.parse().unwrap()).collect();
        assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "{shares:?}");
    }
    assert!(column(&table, "ms").iter().all(String::is_empty), "times are other on each run");
    assert_eq!(table, place.done(&format!("{both} --keys 4,8")));
    let page = place.done("compare data/kick.bvh --noise 0 --keys 200");
    assert!(page.contains("  200 ") || page.contains("\n200 "), "{page}");
    assert!(page.contains("uniform (90)"), "{page}");
    place.done("compare data/kick.bvh --trim 0..48 --noise 0 --out c.csv --json c.json");
    let found = json(&fs::read_to_string(place.path("c.json")).unwrap());
    let list = |name: &str| found[0][name].as_array().unwrap().clone();
    let rows = [list("rows"), list("paces")].concat();
    let table = fs::read_to_string(place.path("c.csv")).unwrap();
    assert_eq!((&found[0]["clip"], rows.len()), (&"kick".into(), column(&table, "mean").len()));
    assert!(rows.iter().all(|row| row["steady"].is_null()));
    assert!(column(&table, "steady").iter().all(String::is_empty));
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let place = Place::new();
    for wrong in ["--keys 0", "--keys few", "--noise=-1", "--out a --json a", "--set keys.rest=x"] {
        place.refused(2, &format!("compare data/kick.bvh {wrong}"));
    }
    fs::write(place.path("a.bvh"), "").unwrap();
    let said = place.refused(2, "compare a.bvh --out a.bvh");
    assert!(said.contains("this is the motion itself"), "{said}");
}
