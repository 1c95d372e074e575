//! Tests of the S column.

use proptest::prelude::*;

use super::sheets::cut_of_24;
use crate::xdts::{Tdts, Xdts, read, read_cells, retimed};
use genga::sheet::{Blank, CameraWork, Sheet, SpokenLine};

fn line(begin: usize, koma: usize, speaker: &str, words: &str) -> SpokenLine {
    SpokenLine { begin, koma, speaker: speaker.into(), words: words.into() }
}

fn spoken(lines: &[SpokenLine]) -> Sheet {
    cut_of_24().with_lines(lines)
}

#[test]
fn a_line_is_written_as_the_format_shows_it() {
    let made = Xdts::default().write(&spoken(&[line(2, 3, "アキ", "えい！")]), "c1").unwrap();
    let field = "{\"fieldId\":3,\"tracks\":[{\"frames\":[\n\
                 {\"data\":[{\"id\":0,\"values\":[\"アキ\",\"えい！\"]}],\"frame\":2},\n\
                 {\"data\":[{\"id\":0,\"values\":[\"SYMBOL_HYPHEN\"]}],\"frame\":3},\n\
                 {\"data\":[{\"id\":0,\"values\":[\"SYMBOL_HYPHEN\"]}],\"frame\":4}],\"trackNo\":0}]}";
    for file in [&made.genga, &made.douga] {
        assert!(file.contains(field), "{file}");
        assert!(file.contains("{\"fieldId\":3,\"names\":[\"S1\"]}"), "{file}");
    }
    let silent = Xdts::default().write(&cut_of_24(), "c1").unwrap();
    assert!(!silent.douga.contains("\"fieldId\":3"), "a cut without words has no such field");
}

#[test]
fn what_other_programs_write_is_read() {
    let file = |frames: &str| {
        format!(
            "exchangeDigitalTimeSheet Save Data\n{{\"timeTables\":[{{\"duration\":24,\"name\":\"a\",\"fields\":[\
             {{\"fieldId\":3,\"tracks\":[{{\"trackNo\":0,\"frames\":[{frames}]}}]}}],\"timeTableHeaders\":[]}}],\"version\":5}}"
        )
    };
    let entry = |koma: i64, values: &str| {
        format!("{{\"data\":[{{\"id\":0,\"values\":[{values}]}}],\"frame\":{koma}}}")
    };
    let lines = |frames: &[String]| read(file(&frames.join(",")).as_bytes()).unwrap().lines;
    let hyphen = "\"SYMBOL_HYPHEN\"";
    // Entries in any order, one sign for several koma, words without a speaker, and signs that continue no line.
    let frames = [
        entry(9, hyphen),
        entry(4, "\"Aki\",\"no\""),
        entry(12, "\"SYMBOL_NULL_CELL\""),
        entry(13, hyphen),
        entry(20, "\"yes\""),
        entry(22, "\"\",\"\""),
        entry(30, "\"late\""),
        entry(-2, "\"early\""),
    ];
    assert_eq!(lines(&frames), [line(4, 6, "Aki", "no"), line(20, 1, "", "yes")]);
    assert_eq!(lines(&[entry(3, "\"A\",\"x\""), entry(3, "\"A\",\"y\"")]), [line(3, 1, "A", "y")]);
}

#[test]
fn a_timesheet_that_comes_back_says_what_is_spoken_unless_it_says_nothing() {
    let sheet = spoken(&[line(2, 3, "Aki", "no")]);
    let other = spoken(&[line(5, 9, "Aki", "yes")]);
    let back = |of: &Sheet| {
        let written = Xdts::default().write(of, "c1").unwrap().douga;
        retimed(&read_cells(written.as_bytes()).unwrap(), &sheet).unwrap().lines
    };
    assert_eq!((back(&other), back(&cut_of_24())), (other.lines, sheet.lines.clone()));
}

proptest! {
    #[test]
    fn what_is_spoken_comes_back(
        lines in prop::collection::vec((0_usize..24, 1_usize..9, "[a-cア]{0,3}", "[x-z、]{1,4}"), 0..9),
    ) {
        let line = |(begin, koma, speaker, words): &(usize, usize, String, String)| {
            line(*begin, *koma, speaker, words)
        };
        let mut lines: Vec<SpokenLine> = lines.iter().map(line).collect();
        lines.sort_by_key(|line| line.begin);
        let sheet = spoken(&lines);
        sheet.check().unwrap();
        let made = Xdts::default().write(&sheet, "c1").unwrap();
        let mut files = vec![made.genga, made.douga];
        for version in [5, 11] {
            files.push(Tdts { version, ..Tdts::default() }.write(&sheet, "c1").unwrap());
        }
        for file in files {
            prop_assert_eq!(&read(file.as_bytes()).unwrap().lines, &sheet.lines);
        }
    }
}

#[test]
fn camera_work_is_in_the_camera_column_with_its_words_first() {
    let mut sheet = super::sheets::cut_of_24();
    let work =
        |begin, koma, words: &str| CameraWork { begin, koma, words: words.into(), is_guess: false };
    sheet.camera = vec![work(2, 3, "PAN"), work(3, 2, "T.U")];
    let text = Xdts::default().write(&sheet, "c1").unwrap().genga;
    let file: serde_json::Value = serde_json::from_str(text.split_once('\n').unwrap().1).unwrap();
    let table = &file["timeTables"][0];
    assert_eq!(
        table["timeTableHeaders"][1],
        serde_json::json!({ "fieldId": 5, "names": ["CAM1", "CAM2"] })
    );
    let field = &table["fields"][1];
    assert_eq!((&field["fieldId"], field["tracks"].as_array().unwrap().len()), (&5.into(), 2));
    let frames = field["tracks"][0]["frames"].as_array().unwrap();
    let entry = |entry: &serde_json::Value| {
        (entry["frame"].as_u64().unwrap(), entry["data"][0]["values"].clone())
    };
    let written: Vec<_> = frames.iter().map(entry).collect();
    let signs = ["PAN", "SYMBOL_HYPHEN", "SYMBOL_HYPHEN"].map(|sign| serde_json::json!([sign]));
    assert_eq!(written, (2..).zip(signs).collect::<Vec<_>>());
    let late = sheet.with_blank(Blank { before: 24, after: 0 });
    assert_eq!(late.camera.iter().map(|work| work.begin).collect::<Vec<_>>(), [26, 27]);
}
