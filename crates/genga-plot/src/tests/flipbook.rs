//! Tests the data of the flip-book.

use serde_json::Value;

use super::figures::{looped, walk};
use super::*;

/// Returns the data of a page.
pub(super) fn take(page: &str) -> Value {
    let begin = "<script type=\"application/json\" id=\"take\">";
    let rest = page.split_once(begin).unwrap().1;
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_flip_book_has_the_sheet_and_every_pose_in_steps_of_the_height() {
    let (clip, sheet) = walk();
    let take = take(&FlipBook::default().draw("cut", &SideBySide::Source(&clip, &sheet)).unwrap());
    assert_eq!((&take["koma"], &take["length"]), (&8.into(), &"0+8".into()));
    let sheet = &take["sheets"][0];
    assert_eq!(sheet["cells"].to_string(), "[[0,0,1],[1,1,2],[2,3,3],[3,6,1],[4,7,1]]");
    assert_eq!(take["source"].as_array().unwrap().len(), 8);
    assert_eq!(
        (&sheet["drawings"][2]["genga"], &sheet["drawings"][1]["genga"]),
        (&2.into(), &Value::Null)
    );
    // The walker is 170 high from foot to tip; the root of frame 4 has gone 40 along −X and is 90 up.
    let steps = |length: f64| Value::from((length / 170.0 * 1000.0).round() as i64);
    let pose = sheet["drawings"][2]["pose"].as_array().unwrap();
    assert_eq!(pose[..3], [steps(-40.0), steps(90.0), steps(0.0)]);
    assert_eq!(take["source"][4], sheet["drawings"][2]["pose"]);
}

#[test]
fn a_flip_book_plays_the_rounds_of_a_loop_and_the_body_travels_on() {
    let (clip, sheet) = looped(3);
    let take = take(&FlipBook::default().draw("cut", &SideBySide::Source(&clip, &sheet)).unwrap());
    let sheet = &take["sheets"][0];
    assert_eq!((&take["koma"], &sheet["rounds"]), (&24.into(), &3.into()));
    // The root is counted from where the loop begins; the walker is 170 high and goes 10 a frame.
    let steps = |length: f64| Value::from((length / 170.0 * 1000.0).round() as i64);
    let cells = sheet["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 12);
    for (at, cell) in cells.iter().enumerate() {
        let drawing = &sheet["drawings"][cell[0].as_u64().unwrap() as usize];
        assert_eq!(drawing["number"], Value::from(1 + at % 4), "numbers come again");
        assert_eq!(drawing["genga"], [Some(1), None, None, Some(2)].map(Value::from)[at % 4]);
        assert_eq!(drawing["pose"][0], steps(-20.0 * at as f64), "drawing {at}");
    }
    for koma in 0..24 {
        assert_eq!(take["source"][koma][0], steps(-10.0 * koma as f64), "source, koma {koma}");
    }
}

#[test]
fn a_flip_book_has_the_reasons_in_both_languages() {
    let (clip, sheet) = walk();
    let take = take(&FlipBook::default().draw("cut", &SideBySide::Source(&clip, &sheet)).unwrap());
    let genga = &take["sheets"][0]["drawings"][2];
    assert_eq!(genga["why"], "pinned: <hit>; 2 drawings left out before it (naka-nashi)");
    assert_eq!(genga["why_japanese"], "固定「<hit>」、2枚を直前で抜いた（中無し）");
}

#[test]
fn no_name_can_end_the_script_of_a_flip_book_or_fill_another_place() {
    let (clip, sheet) = walk();
    let cut = "</script><b>{{take}}&\u{2028}日本";
    let page = FlipBook::default().draw(cut, &SideBySide::Source(&clip, &sheet)).unwrap();
    assert_eq!(take(&page)["cut"], cut);
    assert_eq!(page.matches("</script>").count(), 2);
    assert!(page.contains("<title>&lt;/script&gt;&lt;b&gt;{{take}}&amp;"));
    assert!(!page.contains("http://") && !page.contains("https://"), "it names no address");
}

#[test]
fn the_data_of_a_flip_book_are_as_they_were() {
    let (clip, sheet) = walk();
    let mut take =
        take(&FlipBook::default().draw("cut", &SideBySide::Source(&clip, &sheet)).unwrap());
    let fields = take.as_object_mut().unwrap();
    // Poses are long and say little.
    fields.remove("source");
    let mut sheets = fields.remove("sheets").unwrap();
    let sheet = sheets[0].as_object_mut().unwrap();
    let drawings = sheet.remove("drawings").unwrap();
    let mut lines: Vec<String> =
        fields.iter().chain(&*sheet).map(|(name, value)| format!("{name}: {value}")).collect();
    for mut drawing in drawings.as_array().unwrap().clone() {
        drawing.as_object_mut().unwrap().remove("pose");
        lines.push(format!("drawing: {drawing}"));
    }
    insta::assert_snapshot!("flipbook", lines.join("\n"));
}
