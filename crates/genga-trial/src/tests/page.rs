//! The page and its plan.

use crate::{Condition, OwnSheet, Take, Trial};
use genga::edits::Edits;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;

fn kick() -> (Clip, Sheet) {
    let clip = bvh::open(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh").as_ref())
        .unwrap()
        .clip;
    let mut engine = Engine::new(clip.clone()).unwrap();
    let made = engine.run(&Recipe::default(), &Edits::default()).unwrap();
    let sheet = made.sheet.clone();
    (clip, sheet)
}

fn take<'a>(clip: &'a Clip, sheet: &'a Sheet) -> Take<'a> {
    Take { name: "kick", source: clip, drawn: clip, sheet, own: vec![] }
}

/// Returns the text of a page outside its scripts and styles: what is visible before a script runs.
fn seen(page: &str) -> String {
    let without = |text: &str, begin: &str, end: &str| {
        let mut kept = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once(begin) {
            kept += before;
            rest = after.split_once(end).map_or("", |(_, rest)| rest);
        }
        kept + rest
    };
    without(&without(&without(page, "<script", "</script>"), "<style", "</style>"), "<", ">")
}

#[test]
fn the_page_is_one_file_that_names_no_condition_and_no_address() {
    let (clip, sheet) = kick();
    let hostile = Take { name: "</script><b>kick", ..take(&clip, &sheet) };
    let files = Trial::default().files(std::slice::from_ref(&hostile)).unwrap();
    let page = &files.page;
    assert_eq!(page.matches("</script>").count(), 2, "the data and the script");
    assert!(!page.contains("{{") && !page.contains("http:") && !page.contains("https:"));
    for condition in Condition::ALL {
        assert!(!seen(page).contains(&condition.to_string()), "{condition}");
        assert!(files.json.contains(&format!("\"name\": \"{condition}\"")), "{condition}");
    }
    assert!(files.json.contains("One comparison decides"));
    assert_eq!(Trial::default().files(&[hostile]).unwrap(), files, "the same bytes");
}

#[test]
fn the_plan_has_the_drawings_of_each_film() {
    let (clip, sheet) = kick();
    let plan = Trial::default().files(&[take(&clip, &sheet)]).unwrap().plan;
    let kick = &plan.clips[0];
    let drawings = Condition::ALL.map(|condition| kick.drawings[&condition.to_string()]);
    assert_eq!((kick.koma, drawings), (92, [92, 47, 32, 26, 26]));
    assert_eq!(plan.shown(), 2 * (20 + 3));
}

#[test]
fn what_cannot_be_laid_side_by_side_is_refused() {
    let (clip, sheet) = kick();
    let said = |trial: &Trial, take: Take<'_>| trial.files(&[take]).unwrap_err().to_string();
    let all = Trial::default();
    let few = Trial { conditions: vec![Condition::Genga], ..all.clone() };
    assert!(said(&few, take(&clip, &sheet)).contains("a pair needs two"));
    let twice = Trial { conditions: vec![Condition::Genga; 2], ..all.clone() };
    assert!(said(&twice, take(&clip, &sheet)).contains("genga is named twice"));
    for pairs in [0, 201] {
        let wrong = Trial { pairs, ..all.clone() };
        assert!(said(&wrong, take(&clip, &sheet)).contains("expected 1 to 200 pairs"));
    }
    let own = |name, sheet| OwnSheet { name, drawn: &clip, sheet };
    let with = |own| Take { own: vec![own], ..take(&clip, &sheet) };
    assert!(said(&all, with(own("hand", &sheet))).contains("genga and hand are the same films"));
    assert!(said(&all, with(own("stuck", &sheet))).contains("a condition stuck already"));
    assert!(said(&all, with(own("<b>", &sheet))).contains("a name of letters"));
    let mut short = sheet.clone();
    short.layers[0].exposures.pop();
    let error = said(&all, with(own("hand", &short)));
    assert!(error.contains("hand has 83 koma and the motion 92"), "{error}");
    let mut late = sheet.clone();
    late.clock.koma_rate = 12.0;
    assert!(said(&all, with(own("hand", &late))).contains("has another rate"));
    assert!(all.files(&[]).is_err());
}

#[test]
fn a_sheet_of_ones_own_is_one_more_film() {
    let (clip, sheet) = kick();
    let ones = Sheet::on_ones(sheet.clock, sheet.length());
    let own = OwnSheet { name: "hand", drawn: &clip, sheet: &ones };
    let conditions = vec![Condition::Genga, Condition::Twos];
    let trial = Trial { conditions, ..Trial::default() };
    let take = Take { own: vec![own], ..take(&clip, &sheet) };
    let plan = trial.files(&[take]).unwrap().plan;
    let names: Vec<&str> = plan.conditions.iter().map(|planned| &planned.name[..]).collect();
    assert_eq!(names, ["genga", "twos", "hand"]);
    assert_eq!(plan.clips[0].drawings["hand"], 92);
}

#[test]
fn films_that_are_too_long_are_refused_with_the_way_out() {
    let clip = bvh::open(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh").as_ref())
        .unwrap()
        .clip;
    let rows: Vec<f64> =
        (0..600).flat_map(|at| clip.rows().nth(at % 92).unwrap().to_vec()).collect();
    let long = Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), 600, rows).unwrap();
    let sheet = Sheet::on_ones(long.clock(24.0), 600);
    let error = Trial::default().files(&[take(&long, &sheet)]).unwrap_err().to_string();
    assert!(error.contains("600 koma, too long") && error.contains("--trim"), "{error}");
}
