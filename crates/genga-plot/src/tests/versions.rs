//! Tests two versions of a take side by side: what is refused, where they differ, and the page.

use super::figures::walk;
use super::flipbook::take;
use super::*;
use genga::sheet::{Blank, Repeat};

/// Returns the walk on twos: drawings of frames 0, 2, 4 and 6.
pub(super) fn on_twos(clip: &Clip) -> Sheet {
    let mut sheet = Sheet::on_ones(clip.clock(24.0), 4);
    let layer = &mut sheet.layers[0];
    for (at, drawing) in layer.drawings.iter_mut().enumerate() {
        drawing.source = Source::At(2.0 * at as f64);
    }
    layer.exposures.iter_mut().for_each(|exposure| exposure.koma = 2);
    sheet
}

pub(super) fn both<'a>(clip: &'a Clip, sheets: [&'a Sheet; 2]) -> SideBySide<'a> {
    let version = |name, sheet| Version { name, clip, sheet };
    SideBySide::versions([version("<A>", sheets[0]), version("B", sheets[1])]).unwrap()
}

fn marks(differences: &[bool]) -> String {
    differences.iter().map(|differ| if *differ { '≠' } else { '=' }).collect()
}

#[test]
fn two_versions_differ_where_the_body_is_elsewhere() {
    let (clip, sheet) = walk();
    let twos = on_twos(&clip);
    // Frames 0 1 1 4 4 4 5.5 7 beside 0 0 2 2 4 4 6 6.
    let shown = both(&clip, [&sheet, &twos]);
    assert_eq!((marks(&shown.differences().unwrap()), shown.koma()), ("=≠≠≠==≠≠".into(), 8));
    assert_eq!(marks(&both(&clip, [&sheet, &sheet]).differences().unwrap()), "========");
    // Other numbers for the same frames are the same drawings, and so are poses that nobody can tell apart.
    let mut other = sheet.clone();
    let layer = &mut other.layers[0];
    layer.drawings.rotate_right(1);
    layer.exposures.iter_mut().for_each(|shown| shown.drawing = (shown.drawing + 1) % 5);
    layer.drawings[3].source = Source::At(4.03);
    assert_eq!(marks(&both(&clip, [&sheet, &other]).differences().unwrap()), "========");
    other.layers[0].drawings[3].source = Source::At(4.04);
    assert_eq!(marks(&both(&clip, [&sheet, &other]).differences().unwrap()), "===≠≠≠==");
    assert!(SideBySide::Source(&clip, &sheet).differences().unwrap().is_empty());
}

#[test]
fn the_shorter_holds_its_end_and_blank_koma_are_blank() {
    let (clip, sheet) = walk();
    let mut twos = on_twos(&clip);
    twos.layers[0].exposures.truncate(2);
    // Frames 0 0 2 2 and then 2 to the end.
    assert_eq!(marks(&both(&clip, [&sheet, &twos]).differences().unwrap()), "=≠≠≠≠≠≠≠");
    let late = sheet.clone().with_blank(Blank { before: 2, after: 1 });
    let shown = both(&clip, [&late, &sheet]);
    // Blank, blank, 0 1 1 4 4 4 5.5 7, blank beside 0 1 1 4 4 4 5.5 7 7 7 7.
    assert_eq!(marks(&shown.differences().unwrap()), "≠≠≠≠≠=≠≠≠=≠");
    assert_eq!(shown.koma(), 11);
    let page = take(&FlipBook::default().draw("cut", &shown).unwrap());
    assert_eq!((&page["koma"], &page["sheets"][0]["koma"]), (&11.into(), &11.into()));
    assert_eq!(page["sheets"][0]["cells"][0].to_string(), "[0,2,1]");
    assert_eq!(page["sheets"][1]["koma"], 8);
    assert_eq!(page["differences"].to_string(), "[[0,5],[6,3],[10,1]]");
}

#[test]
fn a_loop_runs_all_its_rounds_beside_another_under_its_own_numbers() {
    let clip = walker(9);
    let mut round = on_twos(&clip);
    round.repeat = Some(Repeat { frames: 8, koma: 8 });
    let exposures = round.layers[0].exposures.clone();
    round.layers[0].exposures = [exposures.clone(), exposures].concat();
    let sheet = on_twos(&clip);
    let shown = both(&clip, [&round, &sheet]);
    assert_eq!(shown.koma(), 16);
    // The second round goes on where the sheet beside it stands still.
    assert_eq!(marks(&shown.differences().unwrap()), "========≠≠≠≠≠≠≠≠");
    let page = take(&FlipBook::default().draw("cut", &shown).unwrap());
    let numbers = page["sheets"][0]["drawings"].as_array().unwrap().iter();
    let numbers: Vec<_> = numbers.map(|drawing| drawing["number"].as_u64().unwrap()).collect();
    assert_eq!(numbers, [1, 2, 3, 4, 1, 2, 3, 4]);
}

#[test]
fn a_page_of_two_versions_has_both_sheets_and_no_source() {
    let (clip, sheet) = walk();
    let twos = on_twos(&clip);
    let shown = both(&clip, [&sheet, &twos]);
    let page = FlipBook::default().draw("cut", &shown).unwrap();
    let take = take(&page);
    assert!(take.get("source").is_none());
    let [one, other] = [0, 1].map(|at| &take["sheets"][at]);
    assert_eq!((&one["name"], &other["name"]), (&"<A>".into(), &"B".into()));
    assert_eq!(one["cells"].to_string(), "[[0,0,1],[1,1,2],[2,3,3],[3,6,1],[4,7,1]]");
    assert_eq!(other["cells"].to_string(), "[[0,0,2],[1,2,2],[2,4,2],[3,6,2]]");
    assert_eq!(one["drawings"][2]["pose"], other["drawings"][2]["pose"], "frame 4");
    assert_eq!(take["differences"].to_string(), "[[1,3],[6,2]]");
    assert!(!page.contains("<A>"), "a name cannot be a tag");
    // The page of the first koma alone ends there.
    let short = FlipBook { most: 3, ..FlipBook::default() };
    let take = super::flipbook::take(&short.draw("cut", &shown).unwrap());
    assert_eq!((&take["koma"], take["differences"].to_string()), (&3.into(), "[[1,2]]".into()));
    assert_eq!(take["sheets"][1]["cells"].to_string(), "[[0,0,2],[1,2,1]]");
    assert!(FlipBook::default().draw("cut", &shown).unwrap() == page, "the same bytes");
}

#[test]
fn what_cannot_run_in_step_is_refused_by_name() {
    let (clip, sheet) = walk();
    let refused = |other_clip: &Clip, other: &Sheet| {
        let version = |name, clip, sheet| Version { name, clip, sheet };
        let versions = [version("one", &clip, &sheet), version("two", other_clip, other)];
        SideBySide::versions(versions).unwrap_err().to_string()
    };
    let mut other = sheet.clone();
    other.clock.koma_rate = 25.0;
    let said = refused(&clip, &other);
    assert!(said.contains("one has 24 koma a second and two has 25"), "{said}");
    let mut other = sheet.clone();
    other.clock.first = Frame(3);
    let said = refused(&clip, &other);
    assert!(said.contains("one begins with source frame 0 and two with 3"), "{said}");
    let (dot, dots) = super::figures::point();
    let said = refused(&dot, &dots);
    assert!(said.contains("one and two are of other joints or another rate"), "{said}");
}
