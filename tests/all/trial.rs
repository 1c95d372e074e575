//! `genga trial`: the page that asks people, and the evaluation of their answers.

use std::fs;

use crate::program::Place;

const COLUMNS: &str = "schema,trial,person,seed,eye,language,hz,slow,of,number,question,clip,first,second,chosen,replays,seconds,koma,dropped,koma_rate\n";

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

/// The answers of somebody who always prefers genga, and prefers the frozen film `wrong` times.
fn answers(person: &str, wrong: usize) -> String {
    let mut text = COLUMNS.to_owned();
    let mut number = 0;
    for question in ["anime", "use"] {
        for at in 0..9 {
            number += 1;
            let is_wrong = at % 3 == 2 && number / 3 <= wrong;
            let (first, chosen) = match at % 3 {
                2 => ("stuck", if is_wrong { "first" } else { "second" }),
                0 => ("uniform", "second"),
                _ => ("source", "second"),
            };
            text += &format!(
                "genga-trial-1,t,{person},1,draws,en,60,0,18,{number},{question},kick,{first},genga,{chosen},0,1,184,0,24\n"
            );
        }
    }
    text
}

#[test]
fn a_trial_is_a_page_and_its_plan_and_the_same_bytes_again() {
    let place = Place::new();
    let made = place.genga("trial data/kick.bvh data/swing.bvh --out page");
    let said = String::from_utf8(made.stderr).unwrap();
    assert!(made.status.success() && made.stdout.is_empty(), "{said}");
    assert!(said.contains("a person sees 46 pairs"), "{said}");
    let files: Vec<_> = fs::read_dir(place.path("page")).unwrap().collect();
    assert_eq!(files.len(), 2);
    let plan = json(&fs::read_to_string(place.path("page/trial.json")).unwrap());
    assert_eq!(plan["schema"], "genga-trial-1");
    for clip in plan["clips"].as_array().unwrap() {
        assert_eq!(clip["drawings"]["uniform"], clip["drawings"]["genga"], "{clip}");
        assert_eq!(clip["drawings"]["source"], clip["koma"], "{clip}");
    }
    let page = fs::read(place.path("page/index.html")).unwrap();
    place.done("trial data/kick.bvh data/swing.bvh --out page -q");
    assert_eq!(fs::read(place.path("page/index.html")).unwrap(), page);
}

#[test]
fn genga_has_as_many_drawings_as_twos_where_that_is_asked() {
    let place = Place::new();
    place.done("trial data/kick.bvh --drawings-per-second 12 --out page -q");
    let plan = json(&fs::read_to_string(place.path("page/trial.json")).unwrap());
    let drawings = &plan["clips"][0]["drawings"];
    let [genga, twos] = ["genga", "twos"].map(|name| drawings[name].as_i64().unwrap());
    assert!((genga - twos).abs() <= 2, "{drawings}");
    assert_eq!(drawings["uniform"], drawings["genga"]);
}

#[test]
fn sheets_of_ones_own_find_their_clips() {
    let place = Place::new();
    for name in ["kick", "swing"] {
        place.done(&format!("run data/{name}.bvh --set spacing.on=3 --out {name} -q"));
    }
    let sheets = "--sheet hand=swing/sheet.json --sheet hand=kick/sheet.json";
    place.done(&format!("trial data/kick.bvh data/swing.bvh {sheets} --out page -q"));
    let plan = json(&fs::read_to_string(place.path("page/trial.json")).unwrap());
    assert_eq!(plan["conditions"][5]["name"], "hand");
    assert!(plan["clips"].as_array().unwrap().iter().all(|clip| clip["drawings"]["hand"].is_u64()));
    let lone = "trial data/kick.bvh data/swing.bvh --sheet hand=kick/sheet.json --out none";
    assert!(place.refused(1, lone).contains("other sheets of your own"));
    let other = "trial data/kick.bvh data/pitch.bvh --sheet hand=swing/sheet.json --out none";
    let said = place.refused(2, other);
    assert!(said.contains("made of swing.bvh, which is not one of the clips"), "{said}");
    assert!(!place.path("none").exists());
}

#[test]
fn what_cannot_be_asked_is_refused_with_the_way_out() {
    let place = Place::new();
    for (args, said) in [
        ("trial", "CLIP"),
        ("trial data/kick.bvh", "--out"),
        ("trial data/kick.bvh --out -", "a folder of files"),
        ("trial data/kick.bvh --out o --pairs 0", "expected 1 to 200 pairs"),
        ("trial data/kick.bvh --out o --conditions genga", "a pair needs two"),
        ("trial data/kick.bvh --out o --conditions genga,ones", "expected one of source, twos"),
        ("trial data/kick.bvh --out o --sheet hand", "expected NAME=SHEET, as"),
        ("trial --read a.csv --out o", "cannot be used with"),
    ] {
        let found = place.refused(2, args);
        assert!(found.contains(said), "{args}: {found}");
    }
}

#[test]
fn answers_are_evaluated_and_who_is_left_out_is_named() {
    let place = Place::new();
    for (person, wrong) in [("aa", 0), ("bb", 0), ("cc", 6)] {
        fs::write(place.path(&format!("{person}.csv")), answers(person, wrong)).unwrap();
    }
    let page = place.done("trial --read aa.csv bb.csv cc.csv");
    for line in [
        "3 people in 3 files; 2 count 有効\n",
        "left out 除外  cc: took what stands still in 6 of 6 catch pairs\n",
        "Too few answers: 2 people count, the plan asks for 24.",
        "not decided: too few answers",
        "Which is more like hand-drawn anime? 手描きのアニメらしいのはどちらですか？\n",
    ] {
        assert!(page.contains(line), "no {line} in\n{page}");
    }
    assert_eq!(place.done("trial --read cc.csv bb.csv aa.csv"), page, "in any order");
    let found = json(&place.done("trial --read aa.csv bb.csv cc.csv --json -"));
    assert_eq!((&found["persons"], &found["counted"]), (&3.into(), &2.into()));
    assert_eq!(found["excluded"][0]["reason"]["caught"]["wrong"], 6);
    assert_eq!(found["questions"][0]["scores"][0]["condition"], "genga");

    let many: Vec<String> = (0..24).map(|person| format!("{person}.csv")).collect();
    for (person, file) in many.iter().enumerate() {
        fs::write(place.path(file), answers(&format!("p{person}"), 0)).unwrap();
    }
    let page = place.done(&format!("trial --read {}", many.join(" ")));
    assert!(page.contains("decided: genga before uniform") && !page.contains("Too few"), "{page}");
    let wrong = answers("dd", 0).replace(",second,0,", ",neither,0,");
    fs::write(place.path("dd.csv"), wrong).unwrap();
    let said = place.refused(1, "trial --read aa.csv dd.csv");
    assert!(said.contains("dd.csv: line 2: chosen: expected first or second"), "{said}");
}
