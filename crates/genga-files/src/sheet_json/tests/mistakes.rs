//! A person's mistakes, and the messages they cause.

use super::*;

/// The error message after replacing the first `from` by `to`.
fn told(from: &str, to: &str) -> String {
    let text = text();
    assert!(text.contains(from), "{from}");
    read(text.replacen(from, to, 1).as_bytes()).unwrap_err().to_string()
}

/// Line and column of the first `what` in the sheet, from 1.
fn place(what: &str) -> String {
    let text = text();
    let before = &text[..text.find(what).unwrap()];
    let line = before.matches('\n').count() + 1;
    format!("{line}:{}: ", before.len() - before.rfind('\n').map_or(0, |at| at + 1) + 1)
}

#[test]
fn what_is_wrong_with_a_line_is_said_with_its_place() {
    let shown = "{\"drawing\": 9, \"koma\": 3}";
    let drawn = "{\"drawing\": 15, \"role\": \"inbetween\", \"frame\": 90.22222222222223}";
    for (line, wrong, words) in [
        (shown, "{\"drawing\": 40, \"koma\": 2}", "layer A has 17 drawings, none of them is 40"),
        (shown, "{\"drawing\": 9, \"koma\": 0}", "an exposure of 0 koma is not seen"),
        (shown, "{\"drawing\": 0, \"koma\": 3}", "layer A has 17 drawings, none of them is 0"),
        (
            drawn,
            "{\"drawing\": 0, \"role\": \"inbetween\", \"frame\": 21}",
            "this is drawing 0; drawings count from 1",
        ),
        (
            shown,
            "{\"drawing\": 9, \"koma\": 99999999}",
            "99999999 koma here: the layers of a sheet have 1000000",
        ),
        (
            drawn,
            "{\"drawing\": 1, \"role\": \"inbetween\", \"frame\": 21}",
            "there is a drawing 1 before",
        ),
        (
            drawn,
            "{\"drawing\": 15, \"role\": \"inbetween\"}",
            "a drawing shows a source frame, \"frame\": 42",
        ),
        (
            drawn,
            "{\"drawing\": 15, \"role\": \"inbetween\", \"frame\": 9, \"share\": 0.5}",
            "a drawing shows a source frame",
        ),
        (
            drawn,
            "{\"drawing\": 15, \"role\": \"inbetween\", \"frame\": 3.9}",
            "frame 3.9 is not in the clip, which has frames 4 to 104",
        ),
        (
            drawn,
            "{\"drawing\": 15, \"role\": \"inbetween\", \"between\": [4, 105], \"share\": 0.5}",
            "frame 105 is not in the clip",
        ),
        (
            drawn,
            "{\"drawing\": 15, \"role\": \"inbetween\", \"between\": [4, 9], \"share\": 1.5}",
            "share is 1.5; it is 0 at",
        ),
    ] {
        let error = told(line, wrong);
        assert!(error.starts_with(&(place(line) + words)), "{wrong}: {error}");
    }
}

#[test]
fn many_layers_are_no_way_round_the_longest_sheet() {
    let text = text().replacen("\"koma\": 4", "\"koma\": 600000", 1);
    assert!(read(text.as_bytes()).is_ok());
    let (head, layers) = text.split_once("  \"layers\": [").unwrap();
    let layer = layers.trim_end().strip_suffix("]\n}").unwrap();
    let error = read(format!("{head}  \"layers\": [{layer}, {layer}]\n}}").as_bytes()).unwrap_err();
    assert!(error.to_string().contains("600000 koma here: the layers of a sheet"), "{error}");
    let mut file = file();
    file.sheet.layers[0].exposures[0].koma = 600_000;
    let layer = file.sheet.layers[0].clone();
    file.sheet.layers.push(layer);
    assert!(file.write().unwrap_err().to_string().contains("600000 koma here"));
}

#[test]
fn what_is_no_such_file_is_said_with_its_place() {
    for (from, to, at, words) in [
        // The reported place is where the parser stopped: after the word.
        ("\"koma\": 4", "\"koma\": 4.5", "", "invalid type: floating point `4.5`"),
        ("\"koma\": 4", "\"koma\": -4", "", "invalid value: integer `-4`"),
        ("\"koma\": 4", "\"coma\": 4", "", "unknown field `coma`, expected `drawing` or `koma`"),
        (
            "\"role\": \"genga\"",
            "\"role\": \"key\"",
            "",
            "unknown variant `key`, expected one of `genga`",
        ),
        ("\"fps\": 24", "\"fps\": \"24\"", "5:13: ", "string \"24\", expected a number"),
        ("\"fps\": 24,", "\"fps\": 24,,", "5:13: ", "key must be a string"),
        ("  \"fps\": 24,\n", "", "", "missing field `fps`"),
        ("\"fps\": 24", "\"fps\": 0", "5:10: ", "fps is 0; a sheet has 2 to 1000 koma a second"),
        ("\"frame_base\": 0", "\"frame_base\": 1", "6:17: ", "frame_base is 0 in this schema"),
        ("\"frame_rate\": 50", "\"frame_rate\": 0", "7:11: ", "rate: 0 frames a second is no rate"),
        ("{\"drawing\": 1, \"koma\": 4}", "4", "", "expected an exposure {\"drawing\", \"koma\"}"),
        ("\"frames\": 101", "\"frames\": -1", "11:16: ", "invalid value: integer `-1`"),
    ] {
        let error = told(from, to);
        assert!(error.starts_with(at) && error.contains(words), "{to}: {error}");
        if at.is_empty() {
            let place = error.splitn(3, ':').take(2).map(|number| number.parse::<usize>());
            assert_eq!(place.filter(Result::is_ok).count(), 2, "{to}: {error}");
        }
        assert!(!error.contains(" at line "), "the place is said once: {error}");
    }
}

#[test]
fn a_mistake_within_a_line_has_the_column_of_that_line() {
    let line =
        text().lines().position(|line| line.ends_with("{\"drawing\": 1, \"koma\": 4},")).unwrap();
    let error = told("\"koma\": 4", "\"koma\": true");
    // The text in front: eight spaces and `{"drawing": 1, "koma": true`.
    assert!(error.starts_with(&format!("{}:35: invalid type: boolean", line + 1)), "{error}");
}

#[test]
fn another_version_and_other_files_are_named() {
    let error = told(SCHEMA, "genga-sheet-7");
    assert!(error.starts_with("2:13: the sheet is of the schema genga-sheet-7"), "{error}");
    assert!([SCHEMA, SCHEMA_FROM_0].iter().all(|read| error.contains(read)), "{error}");
    // The schema is checked before anything else, so the rest of a later version does not matter.
    let later = format!("{{\"schema\": \"genga-sheet-3\", \"sheets\": [{}]}}", text());
    assert!(read(later.as_bytes()).unwrap_err().to_string().contains("genga-sheet-3"));
    for (other, words) in [
        ("{}", "this is no sheet of genga: it has no \"schema\""),
        ("{\"frames\": 92}", "this is no sheet of genga"),
        ("[]", "this is no sheet of genga, which is JSON"),
        ("", "this is no sheet of genga, which is JSON"),
        (
            "HIERARCHY\nROOT Hips",
            "this is no sheet of genga, which is JSON and begins with {; a sheet stands first, its motion second",
        ),
        ("{", "1:1: EOF while parsing an object"),
    ] {
        let error = read(other.as_bytes()).unwrap_err().to_string();
        assert!(error.starts_with(words), "{other}: {error}");
    }
    let error = read(b"\xff\xfe{\x00").unwrap_err().to_string();
    assert!(error.starts_with("this is not text in UTF-8"), "{error}");
    assert!(read(&text().as_bytes()[..900]).is_err());
    assert!(read(format!("{}{}", text(), text()).as_bytes()).is_err(), "two sheets in one file");
}

#[test]
fn words_of_the_file_are_told_whole() {
    let error = told("\"cut\": ", "\"cut at line 7\": 1, \"cut\": ");
    assert!(error.contains("unknown field `cut at line 7`, expected one of "), "{error}");
    let text = text().replacen("\"cut\": ", "\"cut\": 3, \"cute\": ", 1);
    let error = read(text.as_bytes()).unwrap_err();
    assert!(std::error::Error::source(&error).is_some(), "{error}");
}

#[test]
fn blank_koma_are_said_as_the_koma_of_the_first_drawing_and_the_length_of_the_cut() {
    let placed = |words: &str| {
        let text = text().replacen("  \"layers\": [", &format!("  {words},\n  \"layers\": ["), 1);
        read(text.as_bytes())
    };
    let length = file().sheet.length();
    let sheet = placed(&format!("\"at\": 25, \"length\": {}", 24 + length + 6)).unwrap().sheet;
    assert_eq!((sheet.blank.before, sheet.blank.after), (24, 6));
    assert_eq!(placed("\"at\": 25").unwrap().sheet.cut_length(), 24 + length);
    for (words, said) in [
        ("\"at\": 0", "koma count from 1"),
        ("\"length\": 1", "the drawings end on koma"),
        ("\"at\": 99999999", "blank koma"),
        ("\"slate\": {\"cut\": \"a\\nb\"}", "the slate's cut has a line break"),
        ("\"slate\": {\"shot\": \"a\"}", "unknown field `shot`"),
    ] {
        let error = placed(words).unwrap_err().to_string();
        assert!(error.contains(said), "{words}: {error}");
    }
}

#[test]
fn a_sheet_whose_blank_koma_or_slate_were_changed_is_not_as_made() {
    let mut file = file();
    let exaggerate = file.exaggerate.clone();
    let digest = super::digest::sheet(&file.sheet, &exaggerate);
    let layers = digest.clone();
    file.made_with = Some(MadeWith { layers, ..file.made_with.unwrap_or_default() });
    assert!(file.is_as_made());
    file.sheet.blank.before = 24;
    assert!(!file.is_as_made());
    file.sheet.blank.before = 0;
    file.sheet.slate.cut = "45".into();
    assert!(!file.is_as_made());
}
